//! Everything that changes while a simulation runs: small, `Copy`, and complete, so that a snapshot is an assignment.

use serde::{Deserialize, Serialize};

use super::plan::MAX_GROUPS;
use crate::integrate::{Control, Point, Statistics};

/// Largest number of degrees of freedom: two side gears, the carrier, the groups of planets.
pub const MAX_DOF: usize = PLANET + MAX_GROUPS;

/// Index of the left side gear; its position is the angle α_L relative to the carrier.
pub const LEFT: usize = 0;
/// Index of the carrier; its position is θ_c.
pub const CARRIER: usize = 2;
/// Index of the first group of planets; positions are spins ψ relative to the carrier.
pub const PLANET: usize = 3;

/// State of a simulation.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct State {
    /// Time [s].
    pub time: f64,
    /// Positions, wrapped into one tooth pitch (carrier: one turn) [rad].
    pub q: [f64; MAX_DOF],
    /// Velocities [rad/s].
    pub v: [f64; MAX_DOF],
    /// Whole tooth pitches (carrier: turns) taken out of the positions.
    pub turns: [i64; MAX_DOF],
    /// Step-size control.
    pub control: Control,
    /// Solver statistics.
    pub statistics: Statistics,
    /// Work of all inputs since the start [J].
    pub work: f64,
    /// Heat since the start [J].
    pub heat: f64,
    /// Kinetic and elastic energy at the start [J].
    pub energy_at_start: f64,
}

impl State {
    /// A state at `time` with everything at rest and zero.
    pub fn at_rest(time: f64, first_step: f64) -> Self {
        Self {
            time,
            q: [0.0; MAX_DOF],
            v: [0.0; MAX_DOF],
            turns: [0; MAX_DOF],
            control: Control::new(first_step),
            statistics: Statistics::default(),
            work: 0.0,
            heat: 0.0,
            energy_at_start: 0.0,
        }
    }

    /// The first `N` degrees of freedom.
    pub fn point<const N: usize>(&self) -> Point<N> {
        Point { q: std::array::from_fn(|i| self.q[i]), v: std::array::from_fn(|i| self.v[i]) }
    }

    /// Takes over the first `N` degrees of freedom.
    pub fn set_point<const N: usize>(&mut self, point: &Point<N>) {
        self.q[..N].copy_from_slice(&point.q);
        self.v[..N].copy_from_slice(&point.v);
    }

    /// Moves whole periods of each position into its counter.
    pub fn wrap(&mut self, periods: &[f64; MAX_DOF], dof: usize) {
        for (i, period) in periods.iter().enumerate().take(dof) {
            let turns = libm::rint(self.q[i] / period);
            if turns != 0.0 {
                self.q[i] -= turns * period;
                self.turns[i] += turns as i64;
            }
        }
    }

    /// Position `i` with its whole periods.
    pub fn position(&self, i: usize, periods: &[f64; MAX_DOF]) -> f64 {
        self.q[i] + self.turns[i] as f64 * periods[i]
    }

    /// Whether all numbers are what a simulation can go on with.
    pub fn is_valid(&self) -> bool {
        let numbers = [self.time, self.work, self.heat, self.energy_at_start, self.control.last_error];
        self.q.iter().chain(&self.v).chain(&numbers).all(|x| x.is_finite())
            && self.control.next > 0.0
            && self.control.next.is_finite()
            && self.control.last >= 0.0
    }
}
