//! A call that is to be made: its instance, its arguments, and the states that all instances share.

use bevel_differential::instance::{ComponentPointer, FmuState, Status};
use bevel_differential::model::STATES;
use bevel_differential::variables::table;
use fastrand::Rng;

use super::arguments::{CallResult, Flaws, VariableKind, row};
use super::instance::FuzzedInstance;
use super::interface::Interface;
use super::random::{real, value_for};
use crate::tools::random::Draws;

/// Room for arrays of states and event indicators, and the largest count announced for it.
pub const ROOM: usize = 64;

/// Saved states that any instance may be given.
#[derive(Default)]
pub struct HeldStates {
    /// States, each with its bytes.
    pub states: Vec<(FmuState, Vec<u8>)>,
    /// Serialised states.
    pub blobs: Vec<Vec<u8>>,
}

/// A call that is to be made.
pub struct Site<'a> {
    /// Version of FMI of the function. The instance may have another one.
    pub interface: &'static Interface,
    /// The component, or a pointer that must be refused.
    pub c: ComponentPointer,
    /// The generator.
    pub r: &'a mut Rng,
    /// Faults of the arguments so far.
    pub flaws: Flaws,
    /// The instance.
    pub instance: &'a mut FuzzedInstance,
    /// States of all instances.
    pub held: &'a mut HeldStates,
}

impl Site<'_> {
    /// `pointer`, or one that must be refused if it is `needed`.
    pub fn read<T>(&mut self, pointer: *const T, needed: bool) -> *const T {
        self.flaws.pointer(self.r, pointer, needed)
    }

    /// Place to write to, or one that must be refused if it is `needed`.
    pub fn place<T>(&mut self, pointer: *mut T, needed: bool) -> *mut T {
        self.flaws.place(self.r, pointer, needed)
    }

    /// Counts of references and values, or such as must be refused.
    pub fn counts(&mut self, n: usize) -> [usize; 2] {
        if self.interface.number == 2 { [self.flaws.count(self.r, n); 2] } else { self.flaws.counts(self.r, n) }
    }

    /// Result with a status.
    pub fn result(&self, status: Status) -> CallResult {
        CallResult::of(status, &self.flaws)
    }

    /// A step of Euler's from where the instance is, now and then with something wild in it.
    pub fn next_states(&mut self) -> [f64; ROOM] {
        let (mut x, mut rates) = ([0.0; ROOM], [0.0; STATES]);
        let interface = self.instance.interface;
        // SAFETY: a live component and places for all states
        unsafe {
            (interface.get_states)(self.instance.component, x.as_mut_ptr(), STATES);
            (interface.get_rates)(self.instance.component, rates.as_mut_ptr(), STATES);
        }
        self.instance.take_log();
        let h = self.r.pick(&[0.0, 1e-7, 1e-6]);
        x.iter_mut().zip(rates).for_each(|(x, rate)| *x += h * rate);
        if self.r.chance(8) {
            x[self.r.below(STATES)] = real(self.r);
        }
        x
    }

    /// Values for `references`, for states those of a next step.
    pub fn reals(&mut self, references: &[u32], wanted: VariableKind) -> Vec<f64> {
        let share = |r: &mut Rng| if r.chance(2) { 1.0 } else { 0.9 };
        let drawn = |&v: &u32| row(v).map_or(0.0, |row| value_for(self.r, row)) * share(self.r);
        let mut values: Vec<f64> = references.iter().map(drawn).collect();
        if wanted == VariableKind::State {
            let x = self.next_states();
            let states = references.iter().map(|&v| table().state(v));
            values.iter_mut().zip(states).for_each(|(value, k)| *value = k.map_or(*value, |k| x[k]));
        }
        values
    }
}
