//! C interface of impactlaw: law files read at run time, and contacts pressed under them.
//!
//! Objects are made and freed here and opaque to C. A contact keeps what it remembers; it belongs to one thread at a time,
//! a law may be shared. The header `impactlaw.h` is made from this file by cbindgen.

use impactlaw::contact::pair::{Alike, Flat, Press};
use impactlaw::contact::{LawVisitor, NormalLaw};
use impactlaw::export::source::portable::Portable;
use std::ffi::{CStr, OsStr, c_char};
use std::path::Path;

/// A law read from a file.
pub struct ImpactlawLaw {
    portable: Portable,
}

/// A contact under a law, with what it remembers.
pub struct ImpactlawContact {
    held: Box<dyn Contact>,
}

/// A pressed contact, SI units.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct ImpactlawPressed {
    /// Normal force, N, repulsive and never tensile.
    pub force: f64,
    /// Tangent stiffness dF/d(overlap) of the present branch without inertia, N/m.
    pub stiffness: f64,
    /// Contact radius, m.
    pub contact_radius: f64,
    /// Flattening of the first and of the second body, m; their sum is the overlap.
    pub flattening: [f64; 2],
    /// Recoverable energy of both bodies, J.
    pub elastic_energy: f64,
}

/// A contact of one law, its type hidden.
trait Contact {
    fn press(&mut self, overlap: f64, radii: [f64; 2], rate: f64) -> ImpactlawPressed;
    fn forget(&mut self);
}

struct Held<L: NormalLaw> {
    law: L,
    history: L::History,
}

impl<L: NormalLaw> Contact for Held<L> {
    fn press(&mut self, overlap: f64, radii: [f64; 2], rate: f64) -> ImpactlawPressed {
        if overlap.is_nan() || overlap <= 0.0 {
            return ImpactlawPressed::default();
        }
        let [a, b] = radii;
        // sides: how many bodies flatten, and the radius of the sphere each is pressed like
        let (pressed, elastic_energy, sides, radius) = if b > 0.0 {
            let pair = Alike(self.law.clone());
            let pressed = pair.press(overlap, radii, &mut self.history);
            let energy = pair.elastic_energy(overlap, radii, &self.history);
            (pressed, energy, 2.0, 2.0 * a * b / (a + b))
        } else {
            let wall = Flat(self.law.clone());
            let pressed = wall.press(overlap, radii, &mut self.history);
            let energy = wall.elastic_energy(overlap, radii, &self.history);
            (pressed, energy, 1.0, a)
        };
        let (x, side_rate) = (overlap / (sides * radius), rate / sides);
        let first = self.law.largest(&self.history).is_none_or(|most| x >= most);
        let inertia = match rate > 0.0 && first {
            true => radius * radius * self.law.inertia().force(x, side_rate * side_rate),
            false => 0.0,
        };
        ImpactlawPressed {
            force: pressed.force + inertia,
            stiffness: pressed.stiffness,
            contact_radius: pressed.contact_radius,
            flattening: pressed.flattening,
            elastic_energy,
        }
    }

    fn forget(&mut self) {
        self.history = L::History::default();
    }
}

struct Begin;

impl LawVisitor for Begin {
    type Output = Box<dyn Contact>;

    fn visit<L: NormalLaw>(self, law: &L) -> Self::Output {
        Box::new(Held {
            law: law.clone(),
            history: L::History::default(),
        })
    }
}

/// Reads a law file. NULL where that fails: `message`, if not NULL, then holds the reason, cut to its `capacity` bytes.
///
/// # Safety
/// `path` must be a string that ends with 0; `message` NULL or writable for `capacity` bytes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn impactlaw_law_read(
    path: *const c_char,
    message: *mut c_char,
    capacity: usize,
) -> *mut ImpactlawLaw {
    // SAFETY: the caller gives a string that ends with 0.
    let bytes = unsafe { CStr::from_ptr(path) }.to_bytes();
    match read(bytes) {
        Ok(portable) => Box::into_raw(Box::new(ImpactlawLaw { portable })),
        Err(reason) => {
            if !message.is_null() && capacity > 0 {
                let length = reason.len().min(capacity - 1);
                // SAFETY: the caller gives `capacity` writable bytes; `length` and the final 0 are within them.
                unsafe {
                    std::ptr::copy_nonoverlapping(reason.as_ptr().cast(), message, length);
                    *message.add(length) = 0;
                }
            }
            std::ptr::null_mut()
        }
    }
}

fn read(path: &[u8]) -> Result<Portable, String> {
    #[cfg(unix)]
    let path: &OsStr = std::os::unix::ffi::OsStrExt::from_bytes(path);
    #[cfg(not(unix))]
    let path: &OsStr = OsStr::new(std::str::from_utf8(path).map_err(|e| e.to_string())?);
    Portable::read(Path::new(path), None).map_err(|error| error.to_string())
}

/// Frees a law; NULL is allowed. Contacts made of it live on.
///
/// # Safety
/// `law` must come from `impactlaw_law_read` and not be used again.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn impactlaw_law_free(law: *mut ImpactlawLaw) {
    if !law.is_null() {
        // SAFETY: the caller hands back what `impactlaw_law_read` gave, once.
        drop(unsafe { Box::from_raw(law) });
    }
}

/// Largest flattening over radius that the law's impacts support; beyond, it is extrapolated.
///
/// # Safety
/// `law` must come from `impactlaw_law_read`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn impactlaw_law_valid_to(law: *const ImpactlawLaw) -> f64 {
    // SAFETY: the caller gives a living law.
    let law = unsafe { &*law };
    law.portable.file.valid.displacement_over_radius_max
}

/// Suggested time step (s) for bodies of at least this radius (m).
///
/// # Safety
/// `law` must come from `impactlaw_law_read`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn impactlaw_law_time_step(law: *const ImpactlawLaw, radius: f64) -> f64 {
    // SAFETY: the caller gives a living law.
    let law = unsafe { &*law };
    law.portable.time_step_over_radius * radius
}

/// A contact under the law that has not been pressed yet; free it with `impactlaw_contact_free`.
///
/// # Safety
/// `law` must come from `impactlaw_law_read`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn impactlaw_contact_new(law: *const ImpactlawLaw) -> *mut ImpactlawContact {
    // SAFETY: the caller gives a living law.
    let law = unsafe { &*law };
    let held = law.portable.full.visit(Begin);
    Box::into_raw(Box::new(ImpactlawContact { held }))
}

/// Presses a body on a rigid wall (`radius_2` 0) or two bodies of the law's material (m), and remembers it. `rate` (m/s) is
/// that of the overlap and serves the inertia of fast first loading alone; 0 leaves that out, as beds do.
///
/// # Safety
/// `contact` must come from `impactlaw_contact_new` and be used by no other thread meanwhile.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn impactlaw_contact_press(
    contact: *mut ImpactlawContact,
    overlap: f64,
    radius_1: f64,
    radius_2: f64,
    rate: f64,
) -> ImpactlawPressed {
    // SAFETY: the caller gives a living contact that nobody else uses.
    let contact = unsafe { &mut *contact };
    contact.held.press(overlap, [radius_1, radius_2], rate)
}

/// Begins a contact anew: call it when the bodies no longer overlap.
///
/// # Safety
/// As `impactlaw_contact_press`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn impactlaw_contact_forget(contact: *mut ImpactlawContact) {
    // SAFETY: the caller gives a living contact that nobody else uses.
    let contact = unsafe { &mut *contact };
    contact.held.forget();
}

/// Frees a contact; NULL is allowed.
///
/// # Safety
/// `contact` must come from `impactlaw_contact_new` and not be used again.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn impactlaw_contact_free(contact: *mut ImpactlawContact) {
    if !contact.is_null() {
        // SAFETY: the caller hands back what `impactlaw_contact_new` gave, once.
        drop(unsafe { Box::from_raw(contact) });
    }
}
