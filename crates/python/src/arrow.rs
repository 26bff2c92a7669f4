//! Tables for pandas, polars, pyarrow and DuckDB without a copy in Python: Arrow's PyCapsule interface
//! (<https://arrow.apache.org/docs/format/CDataInterface/PyCapsuleInterface.html>).

use std::sync::Arc;

use arrow_array::ffi_stream::FFI_ArrowArrayStream;
use arrow_array::{
    ArrayRef, BooleanArray, Float64Array, RecordBatch, RecordBatchIterator, StringArray,
};
use numpy::PyReadonlyArray1;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyCapsule;

/// Numbers, truth values or words; NaN and None are no value.
#[derive(FromPyObject)]
pub enum Column<'py> {
    Numbers(PyReadonlyArray1<'py, f64>),
    Truths(PyReadonlyArray1<'py, bool>),
    Words(Vec<Option<String>>),
}

/// stream(columns: list[tuple[str, numpy.ndarray | list[str | None]]]) -> PyCapsule
/// --
///
/// An `arrow_array_stream` of one batch.
#[pyfunction]
pub fn stream<'py>(
    py: Python<'py>,
    columns: Vec<(String, Column<'py>)>,
) -> PyResult<Bound<'py, PyCapsule>> {
    let wrong = |error: arrow_schema::ArrowError| PyValueError::new_err(error.to_string());
    let array = |column: &Column<'_>| -> PyResult<ArrayRef> {
        Ok(match column {
            Column::Numbers(numbers) => {
                let numbers = numbers.as_slice()?.iter();
                Arc::new(Float64Array::from_iter(
                    numbers.map(|it| Some(*it).filter(|it| !it.is_nan())),
                ))
            }
            Column::Truths(truths) => Arc::new(BooleanArray::from(truths.as_slice()?.to_vec())),
            Column::Words(words) => {
                Arc::new(StringArray::from_iter(words.iter().map(Option::as_deref)))
            }
        })
    };
    let arrays = columns
        .iter()
        .map(|(name, column)| Ok((name.as_str(), array(column)?, true)));
    let arrays: Vec<_> = arrays.collect::<PyResult<_>>()?;
    let batch = RecordBatch::try_from_iter_with_nullable(arrays).map_err(wrong)?;
    let schema = batch.schema();
    let batches = RecordBatchIterator::new([Ok(batch)], schema);
    let stream = FFI_ArrowArrayStream::new(Box::new(batches));
    PyCapsule::new_with_value(py, stream, c"arrow_array_stream")
}
