//! Random arguments of calls: mostly valid, sometimes NULL, misaligned or of an absurd length. Also the results of
//! calls.

use bevel_differential::fmi3::variables::{Item, added, planet_count};
use bevel_differential::instance::Status;
use bevel_differential::variables::{Access, Causality, Variability, Variable, table};
use fastrand::Rng;

use crate::random::Draws;

/// One pointer out of this number is NULL or misaligned.
const FLAWED: usize = 50;

/// Faults of the arguments of one call.
#[derive(Default)]
pub struct Flaws {
    /// True if a pointer that FMI requires is NULL or misaligned, or a count is wrong: the call must be refused.
    pub any: bool,
}

impl Flaws {
    /// Returns `pointer`, or sometimes one that must be refused if the pointer is `needed`.
    pub fn pointer<T>(&mut self, r: &mut Rng, pointer: *const T, needed: bool) -> *const T {
        if !r.chance(FLAWED) {
            return pointer;
        }
        self.any |= needed;
        if align_of::<T>() == 1 || r.chance(2) { std::ptr::null() } else { pointer.wrapping_byte_add(1) }
    }

    /// Returns a pointer to write to, or sometimes one that must be refused if it is `needed`.
    pub fn place<T>(&mut self, r: &mut Rng, pointer: *mut T, needed: bool) -> *mut T {
        self.pointer(r, pointer, needed).cast_mut()
    }

    /// Returns `n`, or sometimes more than any memory can hold.
    pub fn count(&mut self, r: &mut Rng, n: usize) -> usize {
        if !r.chance(FLAWED) {
            return n;
        }
        self.any = true;
        r.pick(&[usize::MAX, usize::MAX - 7])
    }

    /// Counts of references and of values: equal, or sometimes counts that must be refused. There is room for `n + 1`
    /// values.
    pub fn counts(&mut self, r: &mut Rng, n: usize) -> [usize; 2] {
        let count = self.count(r, n);
        if self.any || !r.chance(FLAWED) {
            return [count, count];
        }
        self.any = true;
        [n, n + 1]
    }
}

/// Kind of variables for a call.
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
    /// FMI 3.0: integers, and position and number of the last event.
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
            Self::Real | Self::Float64 => {
                matches!(row.access, Access::Real(_) | Access::Input(_) | Access::Output(_))
                    && row.access.enumeration().is_none()
            }
            Self::Settable => {
                matches!(row.access, Access::Input(_))
                    || matches!(row.access, Access::Real(_)) && row.variability == Variability::Tunable
            }
            Self::Integer => matches!(row.access, Access::Integer(_)) || row.access.enumeration().is_some(),
            Self::Boolean => matches!(row.access, Access::Boolean(_)),
            Self::Output => matches!(row.access, Access::Output(_)) && row.causality == Causality::Output,
            Self::Input => matches!(row.access, Access::Input(_)),
            Self::State => table().states.contains(&i),
            Self::Int32 => matches!(row.access, Access::Integer(_)) && !is_structural,
            Self::Enumeration => row.access.enumeration().is_some(),
            Self::Structural => is_structural,
            Self::Array | Self::Text => false,
        }
    }

    /// True if a variable that exists only in FMI 3.0 is of this kind.
    fn fits_added(self, item: &Item) -> bool {
        match item {
            Item::Row(_) => false,
            Item::Time | Item::EventTime | Item::Indicator(_) => self == Self::Float64,
            Item::EventBody | Item::EventCount => self == Self::Int32,
            Item::EventKind => self == Self::Enumeration,
            Item::EventText => self == Self::Text,
            Item::Planets(_) | Item::Pairs(_) => self == Self::Array,
        }
    }

    /// Value references of all variables of this kind.
    pub fn all(self) -> Vec<u32> {
        let rows = &table().rows;
        let own = rows.iter().enumerate().filter(|(i, row)| self.fits(*i, row)).map(|(i, _)| i);
        let added = added().iter().enumerate().filter(|(_, added)| self.fits_added(&added.item));
        own.chain(added.map(|(i, _)| rows.len() + i)).map(|i| i as u32).collect()
    }
}

/// Value references: up to four of the right kind, sometimes any, sometimes all.
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

/// Row of a value reference.
pub fn row(reference: u32) -> Option<&'static Variable> {
    table().rows.get(reference as usize)
}

/// Result of a call.
pub struct CallResult {
    /// Status of the call.
    pub status: Status,
    /// Numbers that the call wrote. They are checked only if it succeeded.
    pub numbers: Vec<f64>,
    /// True if the call must be refused because of its arguments.
    pub must_fail: bool,
    /// Bytes of the state that the instance must have now.
    pub restored: Option<Vec<u8>>,
    /// Broken promise that the driver already found.
    pub broken: Option<String>,
}

impl CallResult {
    /// Creates a result with `status`, for arguments with `flaws`.
    pub fn of(status: Status, flaws: &Flaws) -> Self {
        Self { status, numbers: Vec::new(), must_fail: flaws.any, restored: None, broken: None }
    }

    /// Adds the numbers that the call wrote.
    pub fn with(self, numbers: &[f64]) -> Self {
        Self { numbers: numbers.to_vec(), ..self }
    }

    /// Adds a broken promise if `is_broken` after a successful call.
    pub fn unless(mut self, is_broken: bool, what: &str) -> Self {
        if self.status == Status::Ok && is_broken {
            self.broken = Some(what.into());
        }
        self
    }
}
