//! Tape: the state of a run in progress as a row of numbers, so that it can be stopped and resumed bit for bit.
//!
//! Only what changes is kept; grid, points and couplings are built again from the plan, and the file names the plan and the
//! program it belongs to. Numbers are kept as their bits.

use crate::lanes::{Lanes, WIDTH};

mod checkpoint;

pub use checkpoint::{Checkpoint, Keeper, TakenUp, VERSION, contents, sealed, unsealed};

/// Numbers written one after the other, and read back in the same order.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Tape {
    bytes: Vec<u8>,
    at: usize,
}

impl Tape {
    /// The next `N` bytes.
    fn next<const N: usize>(&mut self) -> Option<[u8; N]> {
        let bytes = self.bytes.get(self.at..self.at + N)?;
        self.at += N;
        bytes.try_into().ok()
    }

    /// What has been written, for a file.
    #[must_use]
    pub fn as_bytes(&self) -> &[u8] {
        &self.bytes
    }

    /// Whether everything has been read.
    #[must_use]
    pub fn is_at_end(&self) -> bool {
        self.at == self.bytes.len()
    }

    /// Tape of the bytes of another one, at its beginning.
    #[must_use]
    pub fn from_bytes(bytes: Vec<u8>) -> Self {
        Tape { bytes, at: 0 }
    }

    /// Writes `items`, most of which are as they began, at a byte for each of those.
    pub fn save_few<T: Keep + Default>(&mut self, items: &[T]) {
        let mut usual = Tape::default();
        T::default().save(&mut usual);
        for item in items {
            let flag = self.bytes.len();
            self.bytes.push(1);
            item.save(self);
            if self.bytes[flag + 1..] == usual.bytes {
                self.bytes.truncate(flag + 1);
                self.bytes[flag] = 0;
            }
        }
    }

    /// Takes back what [`Tape::save_few`] wrote of as many items.
    pub fn load_few<T: Keep + Default>(&mut self, items: &mut [T]) -> Option<()> {
        for item in items {
            match self.next()? {
                [0] => *item = T::default(),
                [_] => item.load(self)?,
            }
        }
        Some(())
    }
}

/// What can be kept on a tape.
pub trait Keep {
    /// Write what changes in a run.
    fn save(&self, tape: &mut Tape);
    /// Take back what [`Keep::save`] wrote; `None` when the tape does not fit.
    fn load(&mut self, tape: &mut Tape) -> Option<()>;
}

impl Keep for () {
    fn save(&self, _: &mut Tape) {}
    fn load(&mut self, _: &mut Tape) -> Option<()> {
        Some(())
    }
}

impl Keep for u64 {
    fn save(&self, tape: &mut Tape) {
        tape.bytes.extend(self.to_le_bytes());
    }
    fn load(&mut self, tape: &mut Tape) -> Option<()> {
        *self = u64::from_le_bytes(tape.next()?);
        Some(())
    }
}

impl Keep for f64 {
    fn save(&self, tape: &mut Tape) {
        tape.bytes.extend(self.to_le_bytes());
    }
    fn load(&mut self, tape: &mut Tape) -> Option<()> {
        *self = f64::from_le_bytes(tape.next()?);
        Some(())
    }
}

impl Keep for f32 {
    fn save(&self, tape: &mut Tape) {
        self.to_bits().save(tape);
    }
    fn load(&mut self, tape: &mut Tape) -> Option<()> {
        let mut bits = 0u32;
        bits.load(tape)?;
        *self = f32::from_bits(bits);
        Some(())
    }
}

impl Keep for String {
    fn save(&self, tape: &mut Tape) {
        let letters: Vec<u32> = self.chars().map(u32::from).collect();
        letters.save(tape);
    }
    fn load(&mut self, tape: &mut Tape) -> Option<()> {
        let mut letters: Vec<u32> = Vec::new();
        letters.load(tape)?;
        *self = letters
            .into_iter()
            .map(char::from_u32)
            .collect::<Option<_>>()?;
        Some(())
    }
}

impl Keep for bool {
    fn save(&self, tape: &mut Tape) {
        tape.bytes.push(u8::from(*self));
    }
    fn load(&mut self, tape: &mut Tape) -> Option<()> {
        *self = tape.next()? != [0];
        Some(())
    }
}

/// Elements whose number does not change.
impl<T: Keep> Keep for [T] {
    fn save(&self, tape: &mut Tape) {
        self.iter().for_each(|x| x.save(tape));
    }
    fn load(&mut self, tape: &mut Tape) -> Option<()> {
        self.iter_mut().try_for_each(|x| x.load(tape))
    }
}

impl<T: Keep, const N: usize> Keep for [T; N] {
    fn save(&self, tape: &mut Tape) {
        self.as_slice().save(tape);
    }
    fn load(&mut self, tape: &mut Tape) -> Option<()> {
        self.as_mut_slice().load(tape)
    }
}

impl Keep for usize {
    fn save(&self, tape: &mut Tape) {
        (*self as u64).save(tape);
    }
    fn load(&mut self, tape: &mut Tape) -> Option<()> {
        *self = usize::try_from(u64::from_le_bytes(tape.next()?)).ok()?;
        Some(())
    }
}

impl Keep for u32 {
    fn save(&self, tape: &mut Tape) {
        tape.bytes.extend(self.to_le_bytes());
    }
    fn load(&mut self, tape: &mut Tape) -> Option<()> {
        *self = u32::from_le_bytes(tape.next()?);
        Some(())
    }
}

impl Keep for u8 {
    fn save(&self, tape: &mut Tape) {
        tape.bytes.push(*self);
    }
    fn load(&mut self, tape: &mut Tape) -> Option<()> {
        let [byte] = tape.next()?;
        *self = byte;
        Some(())
    }
}

impl<A: Keep, B: Keep> Keep for (A, B) {
    fn save(&self, tape: &mut Tape) {
        self.0.save(tape);
        self.1.save(tape);
    }
    fn load(&mut self, tape: &mut Tape) -> Option<()> {
        self.0.load(tape)?;
        self.1.load(tape)
    }
}

impl<T: Keep + Default + Clone> Keep for Vec<T> {
    fn save(&self, tape: &mut Tape) {
        (self.len() as u64).save(tape);
        self.iter().for_each(|x| x.save(tape));
    }
    fn load(&mut self, tape: &mut Tape) -> Option<()> {
        let mut length = 0usize;
        length.load(tape)?;
        // a damaged length must not fill the memory
        if length > tape.bytes.len() {
            return None;
        }
        self.resize(length, T::default());
        self.iter_mut().try_for_each(|x| x.load(tape))
    }
}

impl<T: Keep + Default> Keep for Option<T> {
    fn save(&self, tape: &mut Tape) {
        self.is_some().save(tape);
        if let Some(x) = self {
            x.save(tape);
        }
    }
    fn load(&mut self, tape: &mut Tape) -> Option<()> {
        *self = match tape.next()? {
            [0] => None,
            [_] => {
                let mut x = T::default();
                x.load(tape)?;
                Some(x)
            }
        };
        Some(())
    }
}

impl Keep for Lanes {
    fn save(&self, tape: &mut Tape) {
        self.array().save(tape);
    }
    fn load(&mut self, tape: &mut Tape) -> Option<()> {
        let mut numbers = [0.0; WIDTH];
        numbers.load(tape)?;
        *self = Lanes::new(numbers);
        Some(())
    }
}

/// Keeps a structure by its fields, in the order given: `keep_fields!(Type: a, b)`, or with generics
/// `keep_fields!(impl [T: Keep] Type<T>: a, b)`. Fields that are built again, from the scene or the plan, are named behind:
/// `keep_fields!(Type: a, b; rebuilt c)`. A field that is not named at all does not compile.
///
/// Around the structure itself, all of its fields are kept: `keep_fields! { struct Type { a: f64, b: u64 } }`.
macro_rules! keep_fields {
    (
        $(#[$attribute:meta])*
        $visibility:vis struct $structure:ident {
            $($(#[$note:meta])* $seen:vis $field:ident: $kind:ty,)+
        }
    ) => {
        $(#[$attribute])*
        $visibility struct $structure {
            $($(#[$note])* $seen $field: $kind,)+
        }
        $crate::tape::keep_fields!($structure: $($field),+);
    };
    (
        impl [$($generics:tt)*] $structure:ty:
        $($field:ident),+ $(,)? $(; rebuilt $($rebuilt:ident),+ $(,)?)?
    ) => {
        impl<$($generics)*> $crate::tape::Keep for $structure {
            fn save(&self, tape: &mut $crate::tape::Tape) {
                let Self { $($field,)+ $($($rebuilt: _,)+)? } = self;
                $($field.save(tape);)+
            }
            fn load(&mut self, tape: &mut $crate::tape::Tape) -> Option<()> {
                let Self { $($field,)+ $($($rebuilt: _,)+)? } = self;
                $($field.load(tape)?;)+
                Some(())
            }
        }
    };
    ($structure:ty: $($field:ident),+ $(,)? $(; rebuilt $($rebuilt:ident),+ $(,)?)?) => {
        $crate::tape::keep_fields!(impl [] $structure: $($field),+ $(; rebuilt $($rebuilt),+)?);
    };
}
pub(crate) use keep_fields;
