//! Arrays: numbers from Python, and memory of Rust's as NumPy arrays.

use crate::border::{raised, refused};
use impactlaw::unit::{Dimension, Units, argument};
use pyo3::buffer::PyBuffer;
use pyo3::exceptions::PyBufferError;
use pyo3::ffi;
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::{PyFloat, PyInt, PyString, PyTuple};
use std::ffi::{CStr, c_int, c_void};
use std::ptr::null_mut;

/// A number, or an array of them with its shape.
pub struct Numbers {
    /// The numbers, last index fastest.
    pub values: Vec<f64>,
    /// Shape of the array; none of a number.
    shape: Option<Py<PyAny>>,
}

impl Numbers {
    /// From a number, an array or whatever NumPy takes for one, or a text with unit; `name` is what messages call it.
    pub fn of<D: Dimension>(name: &str, given: &Bound<'_, PyAny>) -> PyResult<Self> {
        let py = given.py();
        if let Ok(text) = given.cast::<PyString>() {
            let value = argument::<D>(name, &text.to_string_lossy());
            return Ok(Self::one(value.map_err(|error| raised(py, error))?));
        }
        if let Some(magnitude) = magnitude(name, given, &Units::of::<D>())? {
            return Self::of::<D>(name, &magnitude);
        }
        if given.is_instance_of::<PyFloat>() || given.is_instance_of::<PyInt>() {
            let value = given
                .extract::<f64>()
                .map_err(|_| no_numbers(name, given))?;
            return Ok(Self::one(value));
        }
        let array = numpy(py)?.call_method1("asarray", (given,));
        let array = array.map_err(|_| no_numbers(name, given))?;
        let kind: String = array.getattr("dtype")?.getattr("kind")?.extract()?;
        // whole or floating, nothing that would lose a part or be read as a number
        if !["i", "u", "f"].contains(&kind.as_str()) {
            return Err(no_numbers(name, given));
        }
        let shape = array.getattr("shape")?;
        let flat = array.call_method1("astype", ("float64", "C"))?;
        let flat = flat.call_method1("reshape", (-1,))?;
        let values = PyBuffer::<f64>::get(&flat)?.to_vec(py)?;
        Ok(Self {
            values,
            shape: (shape.len()? > 0).then(|| shape.unbind()),
        })
    }

    fn one(value: f64) -> Self {
        Self {
            values: vec![value],
            shape: None,
        }
    }

    /// `values` in the form that these came in: a float, or an array of the same shape.
    pub fn like<'py>(&self, py: Python<'py>, values: Vec<f64>) -> PyResult<Bound<'py, PyAny>> {
        match &self.shape {
            None => Ok(PyFloat::new(py, values[0]).into_any()),
            Some(shape) => floats(py, values)?.call_method1("reshape", (shape,)),
        }
    }
}

/// A number with unit as text, or in SI.
pub fn number<D: Dimension>(name: &str, given: &Bound<'_, PyAny>) -> PyResult<f64> {
    let numbers = Numbers::of::<D>(name, given)?;
    match (numbers.shape, &numbers.values[..]) {
        (None, [value]) => Ok(*value),
        _ => Err(no_numbers(name, given)),
    }
}

/// The same, refused if it is not positive.
pub fn positive<D: Dimension>(name: &str, given: &Bound<'_, PyAny>) -> PyResult<f64> {
    let value = number::<D>(name, given)?;
    match value > 0.0 && value.is_finite() {
        true => Ok(value),
        false => {
            let error = refused(name, shown(given), "must be positive and finite");
            Err(raised(given.py(), error))
        }
    }
}

/// SI unit of a dimension: the one that is 1.
pub fn si(units: &Units) -> &'static str {
    let is_one = |unit: &&&str| (units.parse)(&format!("1 {unit}")).is_ok_and(|one| one == 1.0);
    units.units.iter().find(is_one).copied().unwrap_or("")
}

/// Number in SI units of a quantity that knows its unit as those of pint do; none of anything else.
pub fn magnitude<'py>(
    name: &str,
    given: &Bound<'py, PyAny>,
    units: &Units,
) -> PyResult<Option<Bound<'py, PyAny>>> {
    if !(given.hasattr("magnitude")? && given.hasattr("to")?) {
        return Ok(None);
    }
    let powers = [("m3", "m**3"), ("m2", "m**2"), ("s2", "s**2")];
    let unit = powers
        .iter()
        .fold(si(units).to_owned(), |unit, (ours, theirs)| {
            unit.replace(ours, theirs)
        });
    let magnitude = given.call_method1("to", (unit,));
    let magnitude = magnitude.and_then(|quantity| quantity.getattr("magnitude"));
    magnitude.map(Some).map_err(|_| {
        let allowed = format!("must be {}", units.name);
        raised(given.py(), refused(name, shown(given), &allowed))
    })
}

fn no_numbers(name: &str, given: &Bound<'_, PyAny>) -> PyErr {
    let allowed = "must be a number in SI units, a text with a unit, or an array of numbers";
    raised(given.py(), refused(name, shown(given), allowed))
}

/// What was given, as messages show it.
pub fn shown(given: &Bound<'_, PyAny>) -> String {
    const LONGEST: usize = 80;
    let text = given.repr();
    let text = text.map_or_else(|_| "something".to_owned(), |text| text.to_string());
    match text.char_indices().nth(LONGEST) {
        None => text,
        Some((end, _)) => format!("{}...", &text[..end]),
    }
}

/// The module `numpy`.
pub fn numpy(py: Python<'_>) -> PyResult<&Bound<'_, PyAny>> {
    static NUMPY: PyOnceLock<Py<PyAny>> = PyOnceLock::new();
    let numpy = NUMPY.get_or_try_init(py, || {
        py.import("numpy").map(|module| module.into_any().unbind())
    })?;
    Ok(numpy.bind(py))
}

/// Floats as an array that owns them.
pub fn floats(py: Python<'_>, values: Vec<f64>) -> PyResult<Bound<'_, PyAny>> {
    array(py, Column::of(values, c"d"))
}

/// Whole numbers as an array that owns them.
pub fn wholes(py: Python<'_>, values: Vec<i64>) -> PyResult<Bound<'_, PyAny>> {
    array(py, Column::of(values, c"q"))
}

fn array(py: Python<'_>, column: Column) -> PyResult<Bound<'_, PyAny>> {
    numpy(py)?.call_method1("asarray", (Py::new(py, column)?,))
}

/// Numbers of eight bytes that an array shows and may change.
#[pyclass(frozen, module = "impactlaw._impactlaw")]
struct Column {
    memory: *mut u64,
    length: usize,
    format: &'static CStr,
    shape: [isize; 1],
    strides: [isize; 1],
}

// SAFETY: the memory belongs to this object alone, which never looks at it: who changes it is Python, under Python's rules.
unsafe impl Send for Column {}
// SAFETY: as above.
unsafe impl Sync for Column {}

impl Column {
    fn of<T: Word>(values: Vec<T>, format: &'static CStr) -> Self {
        let memory: Box<[u64]> = values.into_iter().map(T::word).collect();
        let length = memory.len();
        Column {
            memory: Box::into_raw(memory).cast(),
            length,
            format,
            shape: [length as isize],
            strides: [8],
        }
    }
}

/// A number of eight bytes.
trait Word: Copy {
    fn word(self) -> u64;
}

impl Word for f64 {
    fn word(self) -> u64 {
        self.to_bits()
    }
}

impl Word for i64 {
    fn word(self) -> u64 {
        self.cast_unsigned()
    }
}

impl Drop for Column {
    fn drop(&mut self) {
        let memory = std::ptr::slice_from_raw_parts_mut(self.memory, self.length);
        // SAFETY: it came from a box of this length, and goes back once.
        drop(unsafe { Box::from_raw(memory) });
    }
}

#[pymethods]
impl Column {
    unsafe fn __getbuffer__(
        slf: Bound<'_, Self>,
        view: *mut ffi::Py_buffer,
        flags: c_int,
    ) -> PyResult<()> {
        let column = slf.get();
        let shown = Shown {
            memory: column.memory.cast(),
            bytes: 8 * column.length,
            writable: true,
            format: column.format,
            shape: &column.shape,
            strides: &column.strides,
        };
        // SAFETY: Python gives a view to be filled; what it points to lives as long as `slf`, which the view holds.
        unsafe { shown.fill(slf.clone().into_any(), view, flags) }
    }
}

/// Memory as a view shows it. Shape and strides belong to the object that holds the memory.
pub struct Shown<'a> {
    /// First byte.
    pub memory: *mut c_void,
    /// Bytes of all items.
    pub bytes: usize,
    /// Whether items may be changed.
    pub writable: bool,
    /// Format of an item, of eight bytes.
    pub format: &'static CStr,
    /// Items along each axis.
    pub shape: &'a [isize],
    /// Bytes between items along each axis.
    pub strides: &'a [isize],
}

impl Shown<'_> {
    /// Fills a view of `owner`.
    ///
    /// # Safety
    /// `view` must be one that Python wants filled, or null; memory, shape and strides must live as long as `owner`.
    pub unsafe fn fill(
        &self,
        owner: Bound<'_, PyAny>,
        view: *mut ffi::Py_buffer,
        flags: c_int,
    ) -> PyResult<()> {
        if view.is_null() {
            return Err(PyBufferError::new_err("view is null"));
        }
        if flags & ffi::PyBUF_WRITABLE == ffi::PyBUF_WRITABLE && !self.writable {
            return Err(PyBufferError::new_err("what is shown must not be changed"));
        }
        let compact = self.strides == [8];
        if flags & ffi::PyBUF_STRIDES != ffi::PyBUF_STRIDES && !compact {
            return Err(PyBufferError::new_err("items do not lie side by side"));
        }
        let wanted = |flag: c_int| flags & flag == flag;
        let shape = self.shape.as_ptr().cast_mut();
        let strides = self.strides.as_ptr().cast_mut();
        let format = self.format.as_ptr().cast_mut();
        // SAFETY: the caller gives a view to be filled.
        unsafe {
            (*view).obj = owner.into_ptr();
            (*view).buf = self.memory;
            (*view).len = self.bytes as isize;
            (*view).readonly = c_int::from(!self.writable);
            (*view).itemsize = 8;
            (*view).format = if wanted(ffi::PyBUF_FORMAT) {
                format
            } else {
                null_mut()
            };
            (*view).ndim = self.shape.len() as c_int;
            (*view).shape = if wanted(ffi::PyBUF_ND) {
                shape
            } else {
                null_mut()
            };
            (*view).strides = if wanted(ffi::PyBUF_STRIDES) {
                strides
            } else {
                null_mut()
            };
            (*view).suboffsets = null_mut();
            (*view).internal = null_mut();
        }
        Ok(())
    }
}

/// A tuple of two numbers.
pub fn pair(py: Python<'_>, [first, second]: [f64; 2]) -> PyResult<Bound<'_, PyTuple>> {
    PyTuple::new(py, [first, second])
}
