//! What the messages of a Parquet file have in their fields: <https://github.com/apache/parquet-format/blob/master/src/main/thrift/parquet.thrift>.

/// Fields of a struct by their numbers.
pub(crate) type Fields = &'static [(i16, Is)];

/// What a field or an element of a list is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Is {
    Truth,
    Byte,
    I16,
    I32,
    I64,
    Double,
    /// Bytes or a text.
    Bytes,
    List(&'static Self),
    Struct(Fields),
    /// A field that is in no layout; the library skips it.
    Unknown,
}

const NONE: Is = Is::Struct(&[]);

/// End of a file.
pub(crate) const FILE_META_DATA: Fields = &[
    (1, Is::I32),
    (2, Is::List(&Is::Struct(SCHEMA_ELEMENT))),
    (3, Is::I64),
    (4, Is::List(&Is::Struct(ROW_GROUP))),
    (5, Is::List(&Is::Struct(KEY_VALUE))),
    (6, Is::Bytes),
    (7, Is::List(&Is::Struct(COLUMN_ORDER))),
];
/// Before each page.
pub(crate) const PAGE_HEADER: Fields = &[
    (1, Is::I32),
    (2, Is::I32),
    (3, Is::I32),
    (4, Is::I32),
    (5, Is::Struct(DATA_PAGE_HEADER)),
    (6, NONE),
    (7, Is::Struct(DICTIONARY_PAGE_HEADER)),
    (8, Is::Struct(DATA_PAGE_HEADER_V2)),
];

const SCHEMA_ELEMENT: Fields = &[
    (1, Is::I32),
    (2, Is::I32),
    (3, Is::I32),
    (4, Is::Bytes),
    (5, Is::I32),
    (6, Is::I32),
    (7, Is::I32),
    (8, Is::I32),
    (9, Is::I32),
    (10, Is::Struct(LOGICAL_TYPE)),
];
const LOGICAL_TYPE: Fields = &[
    (5, Is::Struct(&[(1, Is::I32), (2, Is::I32)])),
    (7, Is::Struct(TIME_TYPE)),
    (8, Is::Struct(TIME_TYPE)),
    (10, Is::Struct(&[(1, Is::Byte), (2, Is::Truth)])),
    (16, Is::Struct(&[(1, Is::Byte)])),
    (17, Is::Struct(&[(1, Is::Bytes)])),
    (18, Is::Struct(&[(1, Is::Bytes), (2, Is::I32)])),
];
const TIME_TYPE: Fields = &[(1, Is::Truth), (2, Is::Struct(&[(1, NONE), (2, NONE), (3, NONE)]))];
const ROW_GROUP: Fields = &[
    (1, Is::List(&Is::Struct(COLUMN_CHUNK))),
    (2, Is::I64),
    (3, Is::I64),
    (4, Is::List(&Is::Struct(&[(1, Is::I32), (2, Is::Truth), (3, Is::Truth)]))),
    (5, Is::I64),
    (6, Is::I64),
    (7, Is::I16),
];
const KEY_VALUE: Fields = &[(1, Is::Bytes), (2, Is::Bytes)];
const COLUMN_ORDER: Fields = &[(1, NONE), (2, NONE)];
const COLUMN_CHUNK: Fields = &[
    (1, Is::Bytes),
    (2, Is::I64),
    (3, Is::Struct(COLUMN_META_DATA)),
    (4, Is::I64),
    (5, Is::I32),
    (6, Is::I64),
    (7, Is::I32),
];
const COLUMN_META_DATA: Fields = &[
    (1, Is::I32),
    (2, Is::List(&Is::I32)),
    (3, Is::List(&Is::Bytes)),
    (4, Is::I32),
    (5, Is::I64),
    (6, Is::I64),
    (7, Is::I64),
    (8, Is::List(&Is::Struct(KEY_VALUE))),
    (9, Is::I64),
    (10, Is::I64),
    (11, Is::I64),
    (12, Is::Struct(STATISTICS)),
    (13, Is::List(&Is::Struct(&[(1, Is::I32), (2, Is::I32), (3, Is::I32)]))),
    (14, Is::I64),
    (15, Is::I32),
    (16, Is::Struct(&[(1, Is::I64), (2, Is::List(&Is::I64)), (3, Is::List(&Is::I64))])),
    (17, Is::Struct(&[(1, Is::Struct(BOUNDING_BOX)), (2, Is::List(&Is::I32))])),
];
const STATISTICS: Fields = &[
    (1, Is::Bytes),
    (2, Is::Bytes),
    (3, Is::I64),
    (4, Is::I64),
    (5, Is::Bytes),
    (6, Is::Bytes),
    (7, Is::Truth),
    (8, Is::Truth),
    (9, Is::I64),
];
const BOUNDING_BOX: Fields = &[
    (1, Is::Double),
    (2, Is::Double),
    (3, Is::Double),
    (4, Is::Double),
    (5, Is::Double),
    (6, Is::Double),
    (7, Is::Double),
    (8, Is::Double),
];
const DATA_PAGE_HEADER: Fields =
    &[(1, Is::I32), (2, Is::I32), (3, Is::I32), (4, Is::I32), (5, Is::Struct(STATISTICS))];
const DICTIONARY_PAGE_HEADER: Fields = &[(1, Is::I32), (2, Is::I32), (3, Is::Truth)];
const DATA_PAGE_HEADER_V2: Fields = &[
    (1, Is::I32),
    (2, Is::I32),
    (3, Is::I32),
    (4, Is::I32),
    (5, Is::I32),
    (6, Is::I32),
    (7, Is::Truth),
    (8, Is::Struct(STATISTICS)),
];
