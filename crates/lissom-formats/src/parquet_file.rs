//! Parquet files: columns of numbers, and of structs of numbers, `struct/field`.
//!
//! The file is read page by page.
//!
//! Texts are words, such as the name of a run in each row. Time stamps and dates are seconds from the first one of their column; times of day are seconds from midnight. Nulls are
//! NaN.

use parquet::basic::{LogicalType, TimeUnit, Type};
use parquet::column::reader::{ColumnReader, ColumnReaderImpl};
use parquet::data_type::DataType;
use parquet::errors::ParquetError;
use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::schema::types::ColumnDescriptor;

use crate::channel_ref::Wanted;
use crate::collected::{Collected, LeftOut};
use crate::format::Format;
use crate::format_error::FormatError;
use crate::guard::guarded;
use crate::log_data::{Channel, LogData};
use crate::number::half;
use crate::parquet_pages::Pages;
use crate::source::Source;
use crate::words::{Words, WordsBuilder};

/// First bytes of a file.
pub(crate) const PARQUET: &[u8] = b"PAR1";
/// Rows that are decoded at once.
const BATCH_ROWS: usize = 8192;

const LISTS: LeftOut = LeftOut {
    what: "columns of lists or maps",
    way_out: "in Python: write the places as columns of their own, df[\"x1\"] = df[\"x\"].str[0]",
};
const BINARY: LeftOut = LeftOut {
    what: "columns of bytes that are no numbers",
    way_out: "in Python: df.to_csv(\"log.csv\")",
};

#[expect(clippy::needless_pass_by_value, reason = "for map_err")]
fn damaged(error: ParquetError) -> FormatError {
    FormatError::content("Parquet file", error.to_string())
}

/// Reads a file.
pub(crate) fn read(source: &Source, wanted: Wanted) -> Result<LogData, FormatError> {
    guarded(Format::Parquet, || {
        let file = SerializedFileReader::new(Pages::of(source)?).map_err(damaged)?;
        let mut found = Collected::of(wanted);
        let schema = file.metadata().file_metadata().schema_descr_ptr();
        for (index, column) in schema.columns().iter().enumerate() {
            let name = column.path().parts().join("/");
            let kind = match Kind::of(column) {
                Ok(kind) => kind,
                Err(None) => continue,
                Err(Some(why)) => {
                    found.leave_out(&name, why);
                    continue;
                }
            };
            let level = column.max_def_level();
            let mut reader = Column::new(kind, level);
            let is_wanted = wanted.has_at(&name, Some(found.channels.len() + 1));
            let read = if is_wanted {
                reader.read(&file, index, &mut found)
            } else {
                reader.begin(&file, index)
            };
            match read {
                Ok(()) => found.channels.push(reader.channel(name)),
                Err(error @ FormatError::TooLarge { .. }) => return Err(error),
                Err(error) => {
                    found.release_bytes(size_of_val(&reader.values[..]));
                    found.note(format!("column {name} is left out: {error}"));
                }
            }
        }
        found.finish(Format::Parquet)
    })
}

/// What the values of a column are.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Kind {
    Number,
    Unsigned,
    Half,
    /// Counts of a unit of time \[s\], from the first one if they are dates.
    Time {
        unit_s: Unit,
        from_first: bool,
    },
    /// Whole numbers with a number of decimals.
    Decimal {
        scale: i32,
    },
    Words,
}

/// A unit of time.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Unit {
    Day,
    Milliseconds,
    Microseconds,
    Nanoseconds,
}

impl Unit {
    fn of(unit: TimeUnit) -> Self {
        match unit {
            TimeUnit::MILLIS => Self::Milliseconds,
            TimeUnit::MICROS => Self::Microseconds,
            TimeUnit::NANOS => Self::Nanoseconds,
        }
    }

    /// A count in seconds; whole numbers are divided, so that decimals are those of the count.
    fn seconds(self, count: i64) -> f64 {
        let count = count as f64;
        match self {
            Self::Day => count * 86_400.0,
            Self::Milliseconds => count / 1e3,
            Self::Microseconds => count / 1e6,
            Self::Nanoseconds => count / 1e9,
        }
    }
}

impl Kind {
    /// The kind of a column; an error is a column of no numbers, with the reason if it is no text.
    fn of(column: &ColumnDescriptor) -> Result<Self, Option<&'static LeftOut>> {
        if column.max_rep_level() > 0 {
            return Err(Some(&LISTS));
        }
        let time = |unit_s, from_first| Ok(Self::Time { unit_s, from_first });
        let is_bytes =
            matches!(column.physical_type(), Type::BYTE_ARRAY | Type::FIXED_LEN_BYTE_ARRAY);
        match column.logical_type_ref() {
            Some(LogicalType::Timestamp(of)) => return time(Unit::of(of.unit), true),
            Some(LogicalType::Time(of)) => return time(Unit::of(of.unit), false),
            Some(LogicalType::Date) => return time(Unit::Day, true),
            Some(LogicalType::Decimal(of)) => return Ok(Self::Decimal { scale: of.scale }),
            Some(LogicalType::Integer(of)) if !of.is_signed => return Ok(Self::Unsigned),
            Some(LogicalType::Float16) => return Ok(Self::Half),
            Some(LogicalType::String | LogicalType::Enum) => return Ok(Self::Words),
            Some(LogicalType::Json) => return Err(None),
            _ => {}
        }
        match column.physical_type() {
            Type::INT96 => time(Unit::Nanoseconds, true),
            _ if is_bytes => Err(Some(&BINARY)),
            _ => Ok(Self::Number),
        }
    }
}

/// A column while it is read.
struct Column {
    kind: Kind,
    /// The level of values that are no nulls; 0 if there are no nulls.
    level: i16,
    /// The first time.
    first: Option<i64>,
    values: Vec<f64>,
    words: WordsBuilder,
}

impl Column {
    fn new(kind: Kind, level: i16) -> Self {
        Self { kind, level, first: None, values: Vec::new(), words: WordsBuilder::default() }
    }

    /// Reads the column of all groups of rows.
    fn read(
        &mut self,
        file: &SerializedFileReader<Pages>,
        index: usize,
        found: &mut Collected,
    ) -> Result<(), FormatError> {
        for group in 0..file.num_row_groups() {
            let group = file.get_row_group(group).map_err(damaged)?;
            let rows = usize::try_from(group.metadata().num_rows()).unwrap_or(0);
            let reader = group.get_column_reader(index).map_err(damaged)?;
            self.group(reader, rows, found)?;
        }
        Ok(())
    }

    /// Reads the first value: a column that cannot be read is left out, whether it is wanted or not.
    fn begin(&self, file: &SerializedFileReader<Pages>, index: usize) -> Result<(), FormatError> {
        if file.num_row_groups() == 0 {
            return Ok(());
        }
        let group = file.get_row_group(0).map_err(damaged)?;
        let reader = group.get_column_reader(index).map_err(damaged)?;
        let rows = group.metadata().num_rows().clamp(0, 1) as usize;
        let mut first = Self::new(self.kind, self.level);
        first.group(reader, rows, &mut Collected::new())
    }

    fn group(
        &mut self,
        reader: ColumnReader,
        rows: usize,
        found: &mut Collected,
    ) -> Result<(), FormatError> {
        match reader {
            ColumnReader::BoolColumnReader(reader) => {
                self.values(reader, rows, found, |_, value| f64::from(u8::from(*value)))
            }
            ColumnReader::Int32ColumnReader(reader) => {
                self.values(reader, rows, found, |column, value| match column.kind {
                    Kind::Unsigned => f64::from(value.cast_unsigned()),
                    _ => column.integer(i64::from(*value)),
                })
            }
            ColumnReader::Int64ColumnReader(reader) => {
                self.values(reader, rows, found, |column, value| column.integer(*value))
            }
            ColumnReader::Int96ColumnReader(reader) => {
                self.values(reader, rows, found, |column, value| column.integer(value.to_nanos()))
            }
            ColumnReader::FloatColumnReader(reader) => {
                self.values(reader, rows, found, |_, value| f64::from(*value))
            }
            ColumnReader::DoubleColumnReader(reader) => {
                self.values(reader, rows, found, |_, value| *value)
            }
            ColumnReader::ByteArrayColumnReader(reader) => {
                self.values(reader, rows, found, |column, value| column.bytes(value.data()))
            }
            ColumnReader::FixedLenByteArrayColumnReader(reader) => {
                self.values(reader, rows, found, |column, value| column.bytes(value.data()))
            }
        }
    }

    /// Appends the values of a group of rows.
    fn values<T: DataType>(
        &mut self,
        mut reader: ColumnReaderImpl<T>,
        rows: usize,
        found: &mut Collected,
        number: impl Fn(&mut Self, &T::T) -> f64,
    ) -> Result<(), FormatError> {
        let (mut left, mut values, mut levels) = (rows, Vec::new(), Vec::new());
        while left > 0 {
            values.clear();
            levels.clear();
            let batch = left.min(BATCH_ROWS);
            let read = reader.read_records(batch, Some(&mut levels), None, &mut values);
            let (records, ..) = read.map_err(damaged)?;
            if records == 0 {
                let reason = format!("{left} rows are missing");
                return Err(FormatError::content("Parquet file", reason));
            }
            found.take_bytes(records * size_of::<f64>())?;
            left -= records.min(left);
            let mut present = values.iter();
            for row in 0..records {
                let is_there = levels.get(row).is_none_or(|level| *level == self.level);
                let value = if is_there { present.next() } else { None };
                let value = value.map_or(f64::NAN, |value| number(self, value));
                self.values.push(value);
            }
        }
        Ok(())
    }

    fn integer(&mut self, value: i64) -> f64 {
        match self.kind {
            Kind::Unsigned => value.cast_unsigned() as f64,
            Kind::Time { unit_s, from_first } => {
                let first = *self.first.get_or_insert(if from_first { value } else { 0 });
                unit_s.seconds(value.wrapping_sub(first))
            }
            Kind::Decimal { scale } => value as f64 / 10_f64.powi(scale),
            Kind::Number | Kind::Half | Kind::Words => value as f64,
        }
    }

    /// A number of 16 bits, a whole number with its highest byte first, or a word.
    fn bytes(&mut self, bytes: &[u8]) -> f64 {
        match self.kind {
            Kind::Words => {
                self.words.push(self.values.len(), String::from_utf8_lossy(bytes).trim());
                f64::NAN
            }
            Kind::Half => bytes.first_chunk().map_or(f64::NAN, |b| half(u16::from_le_bytes(*b))),
            Kind::Decimal { scale } if (1..=16).contains(&bytes.len()) => {
                let sign = if bytes.first().is_some_and(|byte| byte & 0x80 != 0) { -1 } else { 0 };
                let whole = bytes.iter().fold(sign, |whole, byte| whole << 8 | i128::from(*byte));
                whole as f64 / 10_f64.powi(scale)
            }
            _ => f64::NAN,
        }
    }

    fn channel(self, name: String) -> Channel {
        let rows = self.values.len();
        let mut channel = Channel::of(name, self.values);
        channel.words = self.words.finish(rows);
        let first = channel.words.as_ref().and_then(Words::first);
        channel.not_a_number = first.map(|word| (0, word.to_owned()));
        if matches!(self.kind, Kind::Time { .. }) {
            channel.unit = Some("s".to_owned());
        }
        channel
    }
}
