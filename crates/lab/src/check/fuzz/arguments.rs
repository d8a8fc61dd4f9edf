//! Arguments as hosts hand them over, mostly right; now and then NULL, misaligned, or of an absurd length. And the result of a call
//! with them.

use bevel_differential::fmi3::variables::{Item, added, planet_count};
use bevel_differential::instance::Status;
use bevel_differential::variables::{Access, Causality, Variability, Variable, table};
use fastrand::Rng;

use crate::tools::random::Draws;

/// One pointer in so many is NULL or misaligned.
const FLAWED: usize = 50;

/// Faults of the arguments of one call.
#[derive(Default)]
pub struct Flaws {
    /// A pointer that FMI needs is NULL or misaligned, or a count is wrong: the call must be refused.
    pub any: bool,
}

impl Flaws {
    /// `pointer`, or one that must be refused if it is `needed`.
    pub fn pointer<T>(&mut self, r: &mut Rng, pointer: *const T, needed: bool) -> *const T {
        if !r.chance(FLAWED) {
            return pointer;
        }
        self.any |= needed;
        if align_of::<T>() == 1 || r.chance(2) { std::ptr::null() } else { pointer.wrapping_byte_add(1) }
    }

    /// Place to write to, or one that must be refused if it is `needed`.
    pub fn place<T>(&mut self, r: &mut Rng, pointer: *mut T, needed: bool) -> *mut T {
        self.pointer(r, pointer, needed).cast_mut()
    }

    /// `n`, or more than any memory holds.
    pub fn count(&mut self, r: &mut Rng, n: usize) -> usize {
        if !r.chance(FLAWED) {
            return n;
        }
        self.any = true;
        r.pick(&[usize::MAX, usize::MAX - 7])
    }

    /// Counts of references and of values: equal, or such as must be refused. There is room for `n + 1` values.
    pub fn counts(&mut self, r: &mut Rng, n: usize) -> [usize; 2] {
        let count = self.count(r, n);
        if self.any || !r.chance(FLAWED) {
            return [count, count];
        }
        self.any = true;
        [n, n + 1]
    }
}

/// Kind of variables that a call is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum VariableKind {
    /// Real variables to read.
    Real,
    /// Real variables that can be set while a simulation runs.
    Settable,
    /// Integers and choices, which FMI 2.0 does not distinguish.
    Integer,
    /// Switches.
    Boolean,
    /// Outputs.
    Output,
    /// Inputs.
    Input,
    /// Continuous states.
    State,
    /// FMI 3.0: numbers, including the time, event indicators and the time of the last event.
    Float64,
    /// FMI 3.0: arrays over planets and tooth pairs.
    Array,
    /// FMI 3.0: integers, and place and number of the last event.
    Int32,
    /// FMI 3.0: choices, and the kind of the last event.
    Enumeration,
    /// FMI 3.0: the number of planets.
    Structural,
    /// FMI 3.0: the text of the last event.
    Text,
}

impl VariableKind {
    fn fits(self, i: usize, row: &Variable) -> bool {
        let is_structural = i == planet_count() as usize;
        match self {
            Self::Real | Self::Float64 => matches!(row.access, Access::Real(_) | Access::Input(_) | Access::Output(_)),
            Self::Settable => {
                matches!(row.access, Access::Input(_))
                    || matches!(row.access, Access::Real(_)) && row.variability == Variability::Tunable
            }
            Self::Integer => matches!(row.access, Access::Integer(_) | Access::Enumeration(..)),
            Self::Boolean => matches!(row.access, Access::Boolean(_)),
            Self::Output => matches!(row.access, Access::Output(_)) && row.causality == Causality::Output,
            Self::Input => matches!(row.access, Access::Input(_)),
            Self::State => table().states.contains(&i),
            Self::Int32 => matches!(row.access, Access::Integer(_)) && !is_structural,
            Self::Enumeration => matches!(row.access, Access::Enumeration(..)),
            Self::Structural => is_structural,
            Self::Array | Self::Text => false,
        }
    }

    /// True if a variable that only FMI 3.0 has is of this kind.
    fn fits_added(self, item: &Item) -> bool {
        match item {
            Item::Row(_) => false,
            Item::Time | Item::EventTime | Item::Indicator(_) => self == Self::Float64,
            Item::EventPlace | Item::EventCount => self == Self::Int32,
            Item::EventKind => self == Self::Enumeration,
            Item::EventText => self == Self::Text,
            Item::Planets(_) | Item::Pairs(_) => self == Self::Array,
        }
    }

    /// References of all variables of this kind.
    pub fn all(self) -> Vec<u32> {
        let rows = &table().rows;
        let own = rows.iter().enumerate().filter(|(i, row)| self.fits(*i, row)).map(|(i, _)| i);
        let added = added().iter().enumerate().filter(|(_, added)| self.fits_added(&added.item));
        own.chain(added.map(|(i, _)| rows.len() + i)).map(|i| i as u32).collect()
    }
}

/// Value references: none to four of the right kind, now and then any, now and then all.
pub fn references(r: &mut Rng, wanted: VariableKind) -> Vec<u32> {
    let fitting = wanted.all();
    if r.chance(16) {
        return fitting;
    }
    let wild = r.chance(12);
    let known = table().rows.len() + added().len();
    let reference = |r: &mut Rng| match r.below(4) {
        0 if wild => r.u32(..),
        1 if wild => r.below(known) as u32,
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
    /// True if it had to be refused for its arguments.
    pub must_fail: bool,
    /// Bytes of the state that the instance must be in now.
    pub restored: Option<Vec<u8>>,
    /// Broken promise that the driver has already seen.
    pub broken: Option<String>,
}

impl CallResult {
    /// Result with `status`, for arguments with `flaws`.
    pub fn of(status: Status, flaws: &Flaws) -> Self {
        Self { status, numbers: Vec::new(), must_fail: flaws.any, restored: None, broken: None }
    }

    /// Result with the numbers that the call wrote.
    pub fn with(self, numbers: &[f64]) -> Self {
        Self { numbers: numbers.to_vec(), ..self }
    }

    /// Result with a broken promise, if a successful call `is_broken`.
    pub fn unless(mut self, is_broken: bool, what: &str) -> Self {
        if self.status == Status::Ok && is_broken {
            self.broken = Some(what.into());
        }
        self
    }
}
