//! Beds by hand: a scene stepped from Python, its grains shown without a copy.

use crate::array::{Shown, floats, numpy, wholes};
use crate::border::{on_threads, short};
use crate::law::Law;
use crate::values::columns;
use impactlaw::bed::run::hand::Hand;
use impactlaw::bed::scene::Scene;
use impactlaw::dem::dynamics::contact::{ContactRow, Other};
use impactlaw::dem::grains::{Motion, Sphere};
use impactlaw::law::LawFile;
use pyo3::exceptions::PyRuntimeError;
use pyo3::ffi;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyString};
use std::ffi::{c_int, c_void};
use std::mem::{offset_of, size_of};
use std::path::PathBuf;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError, Weak};
use std::time::{Duration, Instant};

/// How often a bed under way looks for Ctrl-C.
const LOOK: Duration = Duration::from_millis(50);

/// A bed by hand. See the stubs.
#[pyclass(frozen, module = "impactlaw")]
pub struct Bed {
    inside: Mutex<Inside>,
}

struct Inside {
    hand: Hand,
    /// Memory of the grains that views may show; theirs once the bed has moved on.
    shared: Weak<Memory>,
}

/// Where grains stand that views show: in the bed, as long as it has not moved on since, then here.
struct Memory {
    spheres: *const Sphere,
    motions: *const Motion,
    grains: usize,
    kept: Mutex<Option<(Vec<Sphere>, Vec<Motion>)>>,
}

// SAFETY: what the pointers point to is not changed by anyone as long as this lives: the bed goes on with a copy (`Inside::part`).
unsafe impl Send for Memory {}
// SAFETY: as above.
unsafe impl Sync for Memory {}

impl Inside {
    /// Leaves what views show to them, if there are any, before the bed changes it or goes.
    fn part(&mut self) {
        if let Some(memory) = std::mem::take(&mut self.shared).upgrade() {
            let kept = self.hand.bed_mut().renewed();
            *memory.kept.lock().unwrap_or_else(PoisonError::into_inner) = Some(kept);
        }
    }

    /// The grains as they stand, for views.
    fn memory(&mut self) -> Arc<Memory> {
        if let Some(memory) = self.shared.upgrade() {
            return memory;
        }
        let grains = self.hand.bed().grains();
        let memory = Arc::new(Memory {
            spheres: grains.spheres.as_ptr(),
            motions: grains.motions.as_ptr(),
            grains: grains.len(),
            kept: Mutex::new(None),
        });
        self.shared = Arc::downgrade(&memory);
        memory
    }
}

impl Drop for Inside {
    fn drop(&mut self) {
        self.part();
    }
}

/// A view of grains: it shows them as they stood when it was taken.
#[pyclass(frozen, module = "impactlaw._impactlaw")]
struct View {
    /// What keeps the memory.
    _memory: Arc<Memory>,
    first: *const c_void,
    bytes: usize,
    shape: Vec<isize>,
    strides: Vec<isize>,
}

// SAFETY: it is read only, and `memory` keeps what it points to.
unsafe impl Send for View {}
// SAFETY: as above.
unsafe impl Sync for View {}

#[pymethods]
impl View {
    unsafe fn __getbuffer__(
        slf: Bound<'_, Self>,
        view: *mut ffi::Py_buffer,
        flags: c_int,
    ) -> PyResult<()> {
        let own = slf.get();
        let shown = Shown {
            memory: own.first.cast_mut(),
            bytes: own.bytes,
            writable: false,
            format: c"d",
            shape: &own.shape,
            strides: &own.strides,
        };
        // SAFETY: Python gives a view to be filled; `slf`, which the view holds, keeps memory, shape and strides.
        unsafe { shown.fill(slf.clone().into_any(), view, flags) }
    }
}

/// Which part of a grain is shown.
#[derive(Clone, Copy)]
enum Part {
    Centre,
    Radius,
    Velocity,
}

impl Bed {
    /// The bed, if no other thread steps it.
    fn inside(&self) -> PyResult<MutexGuard<'_, Inside>> {
        self.inside.try_lock().map_err(|_| {
            PyRuntimeError::new_err("this bed is being stepped by another thread, or has fallen")
        })
    }

    fn view<'py>(&self, py: Python<'py>, part: Part) -> PyResult<Bound<'py, PyAny>> {
        let memory = self.inside()?.memory();
        let (base, stride, offset, wide): (*const c_void, usize, usize, bool) = match part {
            Part::Centre => (
                memory.spheres.cast(),
                size_of::<Sphere>(),
                offset_of!(Sphere, centre),
                true,
            ),
            Part::Radius => (
                memory.spheres.cast(),
                size_of::<Sphere>(),
                offset_of!(Sphere, radius),
                false,
            ),
            Part::Velocity => (
                memory.motions.cast(),
                size_of::<Motion>(),
                offset_of!(Motion, velocity),
                true,
            ),
        };
        let mut shape = vec![memory.grains as isize];
        let mut strides = vec![stride as isize];
        if wide {
            shape.push(3);
            strides.push(size_of::<f64>() as isize);
        }
        let view = View {
            // SAFETY: the offset is that of a field of what `base` points to; without grains it is not followed.
            first: unsafe { base.byte_add(if memory.grains > 0 { offset } else { 0 }) },
            bytes: shape.iter().product::<isize>() as usize * size_of::<f64>(),
            _memory: memory,
            shape,
            strides,
        };
        numpy(py)?.call_method1("asarray", (Py::new(py, view)?,))
    }
}

#[pymethods]
impl Bed {
    #[new]
    #[pyo3(signature = (scene, *, law = None, fitted = None, seed = None))]
    fn new(
        scene: &Bound<'_, PyAny>,
        law: Option<&str>,
        fitted: Option<&Law>,
        seed: Option<u64>,
    ) -> PyResult<Self> {
        let py = scene.py();
        let text = scene.cast::<PyString>().ok();
        let text = text.map(|text| text.to_string_lossy().into_owned());
        let text = text.filter(|text| text.contains('\n'));
        let path = match &text {
            Some(_) => PathBuf::from("scene.toml"),
            None => scene.extract::<PathBuf>()?,
        };
        let given: Option<&LawFile> = fitted.map(|law| law.file(py)).transpose()?;
        let hand = on_threads(py, || {
            let scene = match text {
                Some(text) => Scene::parse(&text, &path)?,
                None => Scene::read(&path)?,
            };
            Hand::new(scene, law, given, seed)
        })?;
        Ok(Bed {
            inside: Mutex::new(Inside {
                hand,
                shared: Weak::new(),
            }),
        })
    }

    /// Up to `steps` steps through the scene's stages; fewer only at their end. Returns how many.
    #[pyo3(signature = (steps = 1))]
    fn step(&self, py: Python<'_>, steps: u64) -> PyResult<u64> {
        let mut inside = self.inside()?;
        inside.part();
        let (mut done, mut slice) = (0, 64);
        loop {
            let begun = Instant::now();
            let hand = &mut inside.hand;
            let wanted = slice.min(steps - done);
            let made = on_threads(py, || hand.step(wanted))?;
            done += made;
            if made < wanted || done == steps {
                return Ok(done);
            }
            py.check_signals()?;
            match begun.elapsed() < LOOK {
                true => slice = slice.saturating_mul(2),
                false => slice = (slice / 2).max(1),
            }
        }
    }

    /// Runs the stages that are left; returns how many steps that took.
    fn run(&self, py: Python<'_>) -> PyResult<u64> {
        self.step(py, u64::MAX)
    }

    /// Time of the positions, s.
    #[getter]
    fn time(&self) -> PyResult<f64> {
        Ok(self.inside()?.hand.bed().clock().1)
    }

    /// Time step, s.
    #[getter]
    fn time_step(&self) -> PyResult<f64> {
        Ok(self.inside()?.hand.bed().clock().0)
    }

    /// Steps done under the present law.
    #[getter]
    fn steps(&self) -> PyResult<u64> {
        Ok(self.inside()?.hand.bed().clock().2)
    }

    /// Stage under way; `end` after the last one.
    #[getter]
    fn stage(&self) -> PyResult<String> {
        Ok(self.inside()?.hand.stage().to_owned())
    }

    #[getter]
    fn is_over(&self) -> PyResult<bool> {
        Ok(self.inside()?.hand.is_over())
    }

    fn __len__(&self) -> PyResult<usize> {
        Ok(self.inside()?.hand.bed().grains().len())
    }

    /// Centres of the grains, m, as they stand: a view, three columns.
    #[getter]
    fn positions<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.view(py, Part::Centre)
    }

    /// Velocities of the grains half a step before, m/s: a view, three columns.
    #[getter]
    fn velocities<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.view(py, Part::Velocity)
    }

    /// Radii of the grains, m: a view.
    #[getter]
    fn radii<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.view(py, Part::Radius)
    }

    /// Names of the grains: they stay when the order changes.
    #[getter]
    fn ids<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let ids = self.inside()?.hand.bed().grains().ids.clone();
        wholes(py, ids.into_iter().map(i64::from).collect())
    }

    /// Contacts that carry force, as columns.
    fn contacts<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let rows = {
            let mut inside = self.inside()?;
            let hand = &mut inside.hand;
            short(py, || Ok(hand.bed_mut().contact_rows()))?
        };
        contact_columns(py, &rows)
    }

    /// Rows of `bed.csv` so far, as columns; of the packing or of the stages under the law.
    #[pyo3(signature = (*, packing = false))]
    fn rows<'py>(&self, py: Python<'py>, packing: bool) -> PyResult<Bound<'py, PyDict>> {
        let inside = self.inside()?;
        match packing {
            true => columns(py, inside.hand.packing_rows()),
            false => columns(py, inside.hand.rows()),
        }
    }

    fn __repr__(&self) -> PyResult<String> {
        let inside = self.inside()?;
        let (hand, (_, time, step)) = (&inside.hand, inside.hand.bed().clock());
        Ok(format!(
            "<impactlaw.Bed {}: {} grains, stage {}, step {step}, {time:.4e} s>",
            hand.scene().name,
            hand.bed().grains().len(),
            hand.stage()
        ))
    }
}

/// Contacts as columns; vectors have three.
fn contact_columns<'py>(py: Python<'py>, rows: &[ContactRow]) -> PyResult<Bound<'py, PyDict>> {
    let columns = PyDict::new(py);
    let whole = |of: &dyn Fn(&ContactRow) -> i64| wholes(py, rows.iter().map(of).collect());
    columns.set_item("grain", whole(&|row| i64::from(row.first))?)?;
    let grain = |row: &ContactRow| match row.other {
        Other::Grain(grain) => i64::from(grain),
        Other::Body(_) => -1,
    };
    let body = |row: &ContactRow| match row.other {
        Other::Grain(_) => -1,
        Other::Body(body) => body as i64,
    };
    columns.set_item("other_grain", whole(&grain)?)?;
    columns.set_item("body", whole(&body)?)?;
    type Three = fn(&ContactRow) -> [f64; 3];
    let vectors: [(&str, Three); 3] = [
        ("position_m", |row| row.ends[0].to_array()),
        ("normal", |row| row.normal.to_array()),
        ("force_N", |row| row.force.to_array()),
    ];
    for (name, of) in vectors {
        let all = floats(py, rows.iter().flat_map(of).collect())?;
        columns.set_item(name, all.call_method1("reshape", ((rows.len(), 3),))?)?;
    }
    type One = fn(&ContactRow) -> f64;
    let numbers: [(&str, One); 3] = [
        ("overlap_m", |row| row.overlap),
        ("largest_overlap_m", |row| {
            row.largest_overlap.unwrap_or(f64::NAN)
        }),
        ("plastic_J", |row| row.plastic),
    ];
    for (name, of) in numbers {
        columns.set_item(name, floats(py, rows.iter().map(of).collect())?)?;
    }
    Ok(columns)
}
