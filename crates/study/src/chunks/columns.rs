//! `variants.parquet`: the columns of `variants.csv` in Apache Parquet, for programs that read tables by column.
//!
//! ```text
//! variant INT64, status BYTE_ARRAY (UTF8), inputs and responses DOUBLE, null where there is none
//! ```
//!
//! Pages are plain and not compressed, so that the same rows give the same bytes. Some chunks together make a row group.

use std::io::Write;
use std::sync::Arc;

use parquet::basic::{ConvertedType, Repetition, Type as Physical};
use parquet::data_type::{ByteArray, ByteArrayType, DoubleType, Int64Type};
use parquet::errors::ParquetError;
use parquet::file::metadata::KeyValue;
use parquet::file::properties::{EnabledStatistics, WriterProperties};
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::types::{Type, TypePtr};

use super::rows::Rows;
use super::store::Identity;

/// Rows of a row group, at least, but for the last.
const GROUP: usize = 100_000;

/// A file that takes rows.
pub struct Columns<W: Write + Send> {
    writer: SerializedFileWriter<W>,
    variants: Vec<i64>,
    status: Vec<ByteArray>,
    /// Values of each input and response, NaN where there is none.
    values: Vec<Vec<f64>>,
}

impl<W: Write + Send> Columns<W> {
    /// Begins a file of a study.
    pub fn begin(identity: &Identity, out: W) -> Result<Self, ParquetError> {
        let told = |key: &str, value: &str| KeyValue::new(key.to_owned(), value.to_owned());
        let properties = WriterProperties::builder()
            .set_created_by(format!("linkdyn version {}", identity.engine))
            .set_dictionary_enabled(false)
            .set_statistics_enabled(EnabledStatistics::Chunk)
            .set_key_value_metadata(Some(vec![told("study", &identity.study)]))
            .build();
        let values = identity.inputs.len() + identity.responses.len();
        Ok(Columns {
            writer: SerializedFileWriter::new(out, schema(identity)?, Arc::new(properties))?,
            variants: Vec::new(),
            status: Vec::new(),
            values: vec![Vec::new(); values],
        })
    }

    /// Takes the rows of a chunk.
    pub fn take(&mut self, rows: &Rows) -> Result<(), ParquetError> {
        for row in rows.iter() {
            self.variants.push(row.variant as i64);
            self.status.push(row.reason.unwrap_or("ok").into());
            let values = row.inputs.iter().chain(row.responses);
            for (column, value) in self.values.iter_mut().zip(values) {
                column.push(*value);
            }
        }
        match self.variants.len() >= GROUP {
            true => self.write_group(),
            false => Ok(()),
        }
    }

    /// Ends the file.
    pub fn finish(mut self) -> Result<(), ParquetError> {
        if !self.variants.is_empty() {
            self.write_group()?;
        }
        self.writer.close().map(|_| ())
    }

    fn write_group(&mut self) -> Result<(), ParquetError> {
        let missing = || ParquetError::General("a column is missing".to_owned());
        let mut group = self.writer.next_row_group()?;
        let mut column = group.next_column()?.ok_or_else(missing)?;
        let variants = column.typed::<Int64Type>();
        variants.write_batch(&self.variants, None, None)?;
        column.close()?;
        let mut column = group.next_column()?.ok_or_else(missing)?;
        let status = column.typed::<ByteArrayType>();
        status.write_batch(&self.status, None, None)?;
        column.close()?;
        for values in &mut self.values {
            let levels = values.iter().map(|value| i16::from(value.is_finite()));
            let levels: Vec<i16> = levels.collect();
            values.retain(|value| value.is_finite());
            let mut column = group.next_column()?.ok_or_else(missing)?;
            let doubles = column.typed::<DoubleType>();
            doubles.write_batch(values, Some(&levels), None)?;
            column.close()?;
            values.clear();
        }
        group.close()?;
        self.variants.clear();
        self.status.clear();
        Ok(())
    }
}

fn schema(identity: &Identity) -> Result<TypePtr, ParquetError> {
    let field = |name: &str, physical, repetition, converted| {
        let column = Type::primitive_type_builder(name, physical)
            .with_repetition(repetition)
            .with_converted_type(converted)
            .build()?;
        Ok::<_, ParquetError>(Arc::new(column))
    };
    let (required, optional) = (Repetition::REQUIRED, Repetition::OPTIONAL);
    let mut fields = vec![
        field("variant", Physical::INT64, required, ConvertedType::NONE)?,
        field(
            "status",
            Physical::BYTE_ARRAY,
            required,
            ConvertedType::UTF8,
        )?,
    ];
    for name in identity.inputs.iter().chain(&identity.responses) {
        fields.push(field(
            name,
            Physical::DOUBLE,
            optional,
            ConvertedType::NONE,
        )?);
    }
    let group = Type::group_type_builder("variants").with_fields(fields);
    group.build().map(Arc::new)
}

#[cfg(test)]
mod tests {
    use super::*;
    use parquet::file::reader::{FileReader, SerializedFileReader};
    use parquet::record::Field;

    #[test]
    fn rows_are_read_back() {
        let identity = Identity {
            study: "a study".to_owned(),
            engine: "linkdyn 0".to_owned(),
            inputs: vec!["r[m]".to_owned()],
            responses: vec!["stroke[m]".to_owned(), "peak[N*m]".to_owned()],
        };
        let mut out = Vec::new();
        let mut columns = Columns::begin(&identity, &mut out).expect("begun");
        let values = [
            [0.1, 0.2, -0.0],
            [0.3, f64::NAN, 1e-300],
            [0.5, 0.7, f64::INFINITY],
        ];
        let mut rows = Rows::new(7, 1, 2);
        for (index, [input, first, second]) in values.iter().enumerate() {
            let reason = (index == 1).then_some("dead_centre, or worse");
            rows.push(reason, &[*input], &[*first, *second]);
        }
        columns.take(&rows).expect("taken");
        columns.finish().expect("written");
        let reader = SerializedFileReader::new(bytes::Bytes::from(out)).expect("a file");
        let names = reader.metadata().file_metadata().schema_descr();
        let names: Vec<&str> = names.columns().iter().map(|column| column.name()).collect();
        assert_eq!(
            names,
            ["variant", "status", "r[m]", "stroke[m]", "peak[N*m]"]
        );
        let told = |value: f64| match value.is_finite() {
            true => Field::Double(value),
            false => Field::Null,
        };
        for (index, row) in reader.get_row_iter(None).expect("rows").enumerate() {
            let row = row.expect("a row");
            let found: Vec<&Field> = row.get_column_iter().map(|(_, field)| field).collect();
            let status = if index == 1 {
                "dead_centre, or worse"
            } else {
                "ok"
            };
            assert_eq!(found[0], &Field::Long(7 + index as i64));
            assert_eq!(found[1], &Field::Str(status.to_owned()));
            for (field, value) in found[2..].iter().zip(values[index]) {
                assert_eq!(**field, told(value));
            }
        }
    }
}
