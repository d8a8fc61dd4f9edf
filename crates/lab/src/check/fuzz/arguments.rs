//! Arguments as hosts hand them over, mostly right; now and then NULL, misaligned, or of an absurd length. And what a call with them
//! gives.

use bevel_differential::fmi2::Status;
use bevel_differential::variables::{Access, Causality, Variability, Variable, table};

use super::random::Random;

/// One pointer in so many is NULL or misaligned.
const FLAWED: usize = 50;

/// How the arguments of one call come out.
#[derive(Default)]
pub struct Flaws {
    /// A pointer that FMI needs is NULL or misaligned, or a count is absurd: the call must be refused.
    pub any: bool,
}

impl Flaws {
    /// `pointer`, or one that must be refused where `needed`.
    pub fn pointer<T>(&mut self, r: &mut Random, pointer: *const T, needed: bool) -> *const T {
        if !r.chance(FLAWED) {
            return pointer;
        }
        self.any |= needed;
        if align_of::<T>() == 1 || r.chance(2) { std::ptr::null() } else { pointer.wrapping_byte_add(1) }
    }

    /// The same for a place to write to.
    pub fn place<T>(&mut self, r: &mut Random, pointer: *mut T, needed: bool) -> *mut T {
        self.pointer(r, pointer, needed).cast_mut()
    }

    /// `n`, or more than any memory holds.
    pub fn count(&mut self, r: &mut Random, n: usize) -> usize {
        if !r.chance(FLAWED) {
            return n;
        }
        self.any = true;
        r.pick(&[usize::MAX, usize::MAX - 7])
    }
}

/// What kind of variables a call is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum VariableKind {
    /// Real ones to read.
    Real,
    /// Real ones that can be set while a simulation runs.
    Settable,
    /// Integers and choices.
    Integer,
    /// Switches.
    Boolean,
    /// Outputs.
    Output,
    /// Inputs.
    Input,
    /// Continuous states.
    State,
}

impl VariableKind {
    fn fits(self, i: usize, row: &Variable) -> bool {
        match self {
            Self::Real => matches!(row.access, Access::Real(_) | Access::Input(_) | Access::Output(_)),
            Self::Settable => {
                matches!(row.access, Access::Input(_))
                    || matches!(row.access, Access::Real(_)) && row.variability == Variability::Tunable
            }
            Self::Integer => matches!(row.access, Access::Integer(_) | Access::Enumeration(..)),
            Self::Boolean => matches!(row.access, Access::Boolean(_)),
            Self::Output => matches!(row.access, Access::Output(_)) && row.causality == Causality::Output,
            Self::Input => matches!(row.access, Access::Input(_)),
            Self::State => table().states.contains(&i),
        }
    }
}

/// Value references: none to four of the right kind, now and then any, now and then all.
pub fn references(r: &mut Random, wanted: VariableKind) -> Vec<u32> {
    let rows = &table().rows;
    let fitting: Vec<u32> =
        rows.iter().enumerate().filter(|(i, row)| wanted.fits(*i, row)).map(|(i, _)| i as u32).collect();
    if r.chance(16) {
        return fitting;
    }
    let wild = r.chance(12);
    let reference = |r: &mut Random| match r.below(4) {
        0 if wild => r.bits() as u32,
        1 if wild => r.below(rows.len()) as u32,
        _ => r.pick(&fitting),
    };
    (0..r.below(5)).map(|_| reference(r)).collect()
}

/// The row of a value reference.
pub fn row(reference: u32) -> Option<&'static Variable> {
    table().rows.get(reference as usize)
}

/// The result of a call.
pub struct CallResult {
    /// Its status.
    pub status: Status,
    /// Numbers that it wrote; looked at only if it was carried out.
    pub numbers: Vec<f64>,
    /// Whether it had to be refused for its arguments.
    pub must_fail: bool,
    /// Bytes of the state that the instance is to be in now.
    pub restored: Option<Vec<u8>>,
    /// What is wrong, seen by the driver already.
    pub broken: Option<String>,
}

impl CallResult {
    /// With `status`, for arguments with `flaws`.
    pub fn of(status: Status, flaws: &Flaws) -> Self {
        Self { status, numbers: Vec::new(), must_fail: flaws.any, restored: None, broken: None }
    }

    /// With the numbers that the call wrote.
    pub fn with(self, numbers: &[f64]) -> Self {
        Self { numbers: numbers.to_vec(), ..self }
    }
}
