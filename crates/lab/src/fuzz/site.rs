//! A prepared call: its instance, its arguments, and the states that all instances share.

use bevel_differential::instance::{ComponentPointer, FmuState, Status};
use bevel_differential::model::STATES;
use bevel_differential::variables::table;
use fastrand::Rng;

use super::arguments::{CallResult, Flaws, VariableKind, row};
use super::instance::FuzzedInstance;
use super::interface::Interface;
use super::random::{real, value_for};
use crate::random::Draws;

/// Room for arrays of states and event indicators, and the largest announced count.
pub const ROOM: usize = 64;

/// Saved states, which may be passed to any instance.
#[derive(Default)]
pub struct HeldStates {
    /// States, each with its serialised bytes.
    pub states: Vec<(FmuState, Vec<u8>)>,
    /// Serialised states.
    pub blobs: Vec<Vec<u8>>,
}

/// A prepared call.
pub struct Site<'a> {
    /// Functions of the called FMI version. The instance may have another version.
    pub interface: &'static Interface,
    /// The component, or a pointer that must be refused.
    pub c: ComponentPointer,
    /// Random generator.
    pub r: &'a mut Rng,
    /// Faults of the arguments so far.
    pub flaws: Flaws,
    /// The instance.
    pub instance: &'a mut FuzzedInstance,
    /// States of all instances.
    pub held: &'a mut HeldStates,
}

impl Site<'_> {
    /// Returns `pointer`, or sometimes one that must be refused if the pointer is `needed`.
    pub fn read<T>(&mut self, pointer: *const T, needed: bool) -> *const T {
        self.flaws.pointer(self.r, pointer, needed)
    }

    /// Returns a pointer to write to, or sometimes one that must be refused if it is `needed`.
    pub fn place<T>(&mut self, pointer: *mut T, needed: bool) -> *mut T {
        self.flaws.place(self.r, pointer, needed)
    }

    /// Counts of references and values, or sometimes counts that must be refused.
    pub fn counts(&mut self, n: usize) -> [usize; 2] {
        if self.interface.number == 2 { [self.flaws.count(self.r, n); 2] } else { self.flaws.counts(self.r, n) }
    }

    /// Creates a result with `status`.
    pub fn result(&self, status: Status) -> CallResult {
        CallResult::of(status, &self.flaws)
    }

    /// Advances the instance's states by an Euler step, sometimes with an extreme value among them.
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

    /// Draws values for `references`; for states, the values of a next step.
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
