//! Parts, and other tables, as Parquet files.

use std::path::Path;
use std::sync::Arc;

use bytes::Bytes;
use parquet::basic::{Compression, LogicalType, Repetition, TimeUnit, Type as Physical, ZstdLevel};
use parquet::column::reader::{ColumnReader, ColumnReaderImpl};
use parquet::data_type::{ByteArray, ByteArrayType, DataType, DoubleType, Int64Type};
use parquet::errors::ParquetError;
use parquet::file::properties::WriterProperties;
use parquet::file::reader::{FileReader as _, SerializedFileReader};
use parquet::file::writer::{SerializedFileWriter, SerializedRowGroupWriter};
use parquet::schema::types::{ColumnDescriptor, Type};

use super::part_columns::Values;
use crate::fleet_error::FleetError;

/// The bytes of a part.
pub(super) fn part_bytes(columns: &[(String, Values)]) -> Result<Vec<u8>, ParquetError> {
    let mut writer = ParquetWriter::new(columns)?;
    writer.add(columns.iter().map(|(_, values)| values))?;
    writer.bytes()
}

/// Writes a table, some rows at a time.
pub(super) struct ParquetWriter {
    writer: SerializedFileWriter<Vec<u8>>,
}

impl ParquetWriter {
    /// Begins a table with columns of these names and kinds.
    pub(super) fn new(columns: &[(String, Values)]) -> Result<Self, ParquetError> {
        let fields: Result<Vec<_>, _> =
            columns.iter().map(|(name, values)| field(name, values)).collect();
        let schema = Type::group_type_builder("lissom_fleet").with_fields(fields?).build()?;
        let compression = Compression::ZSTD(ZstdLevel::default());
        let properties = WriterProperties::builder().set_compression(compression).build();
        let writer = SerializedFileWriter::new(Vec::new(), Arc::new(schema), Arc::new(properties))?;
        Ok(Self { writer })
    }

    /// Adds rows: the values of each column.
    pub(super) fn add<'a>(
        &mut self,
        columns: impl IntoIterator<Item = &'a Values>,
    ) -> Result<(), ParquetError> {
        let mut group = self.writer.next_row_group()?;
        for values in columns {
            match values {
                Values::Text(texts) => {
                    let of = |text: &String| ByteArray::from(text.as_str());
                    put::<ByteArrayType, _>(&mut group, texts, of)?;
                }
                Values::Number(numbers) => {
                    put::<DoubleType, _>(&mut group, numbers, |n| *n)?;
                }
                Values::Time(times) => put::<Int64Type, _>(&mut group, times, |t| *t)?,
            }
        }
        group.close()?;
        Ok(())
    }

    /// The bytes of the table.
    pub(super) fn bytes(self) -> Result<Vec<u8>, ParquetError> {
        self.writer.into_inner()
    }
}

fn field(name: &str, values: &Values) -> Result<Arc<Type>, ParquetError> {
    let (physical, logical) = match values {
        Values::Text(_) => (Physical::BYTE_ARRAY, Some(LogicalType::String)),
        Values::Number(_) => (Physical::DOUBLE, None),
        Values::Time(_) => (Physical::INT64, Some(utc_microseconds())),
    };
    let builder = Type::primitive_type_builder(name, physical).with_logical_type(logical);
    Ok(Arc::new(builder.with_repetition(Repetition::OPTIONAL).build()?))
}

fn utc_microseconds() -> LogicalType {
    LogicalType::timestamp(true, TimeUnit::MICROS)
}

/// Writes the next column.
fn put<D: DataType, T>(
    group: &mut SerializedRowGroupWriter<'_, Vec<u8>>,
    values: &[Option<T>],
    of: impl Fn(&T) -> D::T,
) -> Result<(), ParquetError> {
    let Some(mut column) = group.next_column()? else {
        return Err(ParquetError::General("there is no further column".to_owned()));
    };
    let levels: Vec<i16> = values.iter().map(|value| i16::from(value.is_some())).collect();
    let known: Vec<D::T> = values.iter().flatten().map(of).collect();
    column.typed::<D>().write_batch(&known, Some(&levels), None)?;
    column.close()
}

/// The names of a part's columns.
pub(super) fn part_names(path: &Path) -> Result<Vec<String>, FleetError> {
    let reader = opened(path)?;
    let schema = reader.metadata().file_metadata().schema_descr_ptr();
    Ok(schema.columns().iter().map(|column| column.name().to_owned()).collect())
}

/// Reads one column of a part; none if it has no such column.
pub(super) fn part_column(path: &Path, name: &str) -> Result<Option<Values>, FleetError> {
    let reader = opened(path)?;
    let damaged = |error: ParquetError| damage(path, &error);
    let schema = reader.metadata().file_metadata().schema_descr_ptr();
    let Some(index) = schema.columns().iter().position(|column| column.name() == name) else {
        return Ok(None);
    };
    let mut values = empty(schema.columns()[index].as_ref());
    for group in 0..reader.num_row_groups() {
        let group = reader.get_row_group(group).map_err(damaged)?;
        let rows = usize::try_from(group.metadata().num_rows()).unwrap_or_default();
        read_values(group.get_column_reader(index).map_err(damaged)?, rows, &mut values)
            .map_err(damaged)?;
    }
    Ok(Some(values))
}

fn opened(path: &Path) -> Result<SerializedFileReader<Bytes>, FleetError> {
    let read = |source| FleetError::Read { path: path.to_owned(), source };
    let bytes = Bytes::from(std::fs::read(path).map_err(read)?);
    SerializedFileReader::new(bytes).map_err(|error| damage(path, &error))
}

fn damage(path: &Path, error: &ParquetError) -> FleetError {
    FleetError::Damaged { path: path.to_owned(), problem: error.to_string() }
}

/// No values yet, of the kind of a column.
fn empty(column: &ColumnDescriptor) -> Values {
    match (column.physical_type(), column.logical_type_ref()) {
        (Physical::DOUBLE, _) => Values::Number(Vec::new()),
        (Physical::INT64, Some(LogicalType::Timestamp { .. })) => Values::Time(Vec::new()),
        _ => Values::Text(Vec::new()),
    }
}

fn read_values(reader: ColumnReader, rows: usize, values: &mut Values) -> Result<(), ParquetError> {
    match (reader, values) {
        (ColumnReader::ByteArrayColumnReader(reader), Values::Text(texts)) => {
            take(reader, rows, texts, |bytes| String::from_utf8_lossy(bytes.data()).into_owned())
        }
        (ColumnReader::DoubleColumnReader(reader), Values::Number(numbers)) => {
            take(reader, rows, numbers, |n| *n)
        }
        (ColumnReader::Int64ColumnReader(reader), Values::Time(times)) => {
            take(reader, rows, times, |t| *t)
        }
        _ => Err(ParquetError::General("a column of another type".to_owned())),
    }
}

/// Appends the values of a column.
fn take<D: DataType, T>(
    mut reader: ColumnReaderImpl<D>,
    rows: usize,
    values: &mut Vec<Option<T>>,
    of: impl Fn(&D::T) -> T,
) -> Result<(), ParquetError> {
    let mut left = rows;
    while left > 0 {
        let (mut levels, mut known) = (Vec::new(), Vec::new());
        let (records, _, _) = reader.read_records(left, Some(&mut levels), None, &mut known)?;
        if records == 0 {
            return Err(ParquetError::EOF(format!("{left} rows are missing")));
        }
        left -= records;
        let mut known = known.iter();
        values.extend(
            levels.iter().map(|level| (*level > 0).then(|| known.next().map(&of)).flatten()),
        );
    }
    Ok(())
}
