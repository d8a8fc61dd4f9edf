//! Everything that changes while a simulation runs: small, `Copy`, and complete, so that a snapshot is an assignment.

use serde::{Deserialize, Serialize};

use super::causes::CAUSES;
use super::course::Course;
use super::dry::Hold;
use super::layout::{CARRIER, HOLDS, Layout, MAX_DOF, MAX_GROUPS, PLANET};
use super::parameters::Inputs;
use crate::integrate::{Control, Point, Statistics};
use crate::strength::{Damage, Rainflow, ToothDamage};

/// Turns beyond which whole ones are no longer told apart.
const MOST_TURNS: u64 = 1 << 53;

/// State of a simulation.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct State {
    /// Time [s].
    pub time: f64,
    /// Positions; angles of gears are wrapped into one tooth pitch, the carrier's into one turn [rad; seats m].
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
    /// Heat since the start by cause [J].
    pub heat: [f64; CAUSES],
    /// What dry friction holds.
    pub holds: [Hold; HOLDS],
    /// Shaft torques over whole mesh cycles.
    pub bias: Bias,
    /// Whether the tooth fault has come about.
    pub fault: bool,
    /// Command of the lock that acts since the last step.
    pub lock: f64,
    /// Command of the carrier's speed that acts since the last step [rad/s].
    pub carrier_command: f64,
    /// How inputs go on, where the host told it.
    pub course: Option<Course>,
    /// Damage of the teeth.
    pub fatigue: Fatigue,
    /// Kinetic and elastic energy at the start [J].
    pub energy_at_start: f64,
}

/// The end of the last step that a solver of the host's completed.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Accepted {
    /// Time [s].
    pub time: f64,
    /// Positions.
    pub q: [f64; MAX_DOF],
    /// Velocities.
    pub v: [f64; MAX_DOF],
    /// Inputs.
    pub inputs: Inputs,
    /// Commands whose jumps free speeds have followed.
    pub followed: Inputs,
}

impl Accepted {
    /// `state` as it was there.
    pub fn of(&self, state: &State) -> State {
        State { time: self.time, q: self.q, v: self.v, ..*state }
    }

    /// Whether all numbers are finite.
    pub fn is_valid(&self) -> bool {
        self.q.iter().chain(&self.v).chain([&self.time]).all(|x| x.is_finite()) && self.inputs.is_finite()
    }
}

/// Damage of the teeth so far.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Fatigue {
    /// Planets, by group.
    pub planets: [ToothDamage; MAX_GROUPS],
    /// Side gears.
    pub sides: [ToothDamage; 2],
    /// Force on the teeth that stand in mesh on each side.
    pub standing: [Rainflow; 2],
    /// Damage that it did to the roots of planet and side gear, by side.
    pub stood: [[Damage; 2]; 2],
}

impl Bias {
    /// Means over the last whole mesh cycle [N·m], unless rolling has all but stopped since.
    pub fn mean(&self) -> Option<[f64; 2]> {
        self.last.filter(|(_, took)| self.time <= 2.0 * took).map(|(mean, _)| mean)
    }
}

/// Time integrals of the shaft torques, kept mesh cycle by mesh cycle.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Bias {
    /// ∫T dt of left and right since the mesh cycle began [N·m·s].
    pub sum: [f64; 2],
    /// How long that is [s].
    pub time: f64,
    /// Whether it was seen to begin.
    pub whole: bool,
    /// Cycles rolled since it began, backward negative.
    pub rolled: f64,
    /// Means over the last whole mesh cycle [N·m], and how long it took [s].
    pub last: Option<([f64; 2], f64)>,
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
            heat: [0.0; CAUSES],
            holds: [Hold::default(); HOLDS],
            bias: Bias::default(),
            fault: false,
            lock: 0.0,
            carrier_command: 0.0,
            course: None,
            fatigue: Fatigue::default(),
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
    ///
    /// What dry friction holds is moved along with its body.
    pub fn wrap(&mut self, periods: &[f64; MAX_DOF], layout: &Layout) {
        for (i, period) in periods.iter().enumerate().take(layout.count()) {
            // rarely anything to do
            if self.q[i].abs() < *period {
                continue;
            }
            let turns = libm::rint(self.q[i] / period);
            if turns != 0.0 {
                self.q[i] -= turns * period;
                self.turns[i] = self.turns[i].saturating_add(turns as i64);
                let planet = i.wrapping_sub(layout.planet(0));
                let held = if i < CARRIER { Some(i) } else { (planet < layout.groups).then_some(2 + planet) };
                if let Some(hold) = held.and_then(|h| self.holds.get_mut(h)) {
                    hold.anchor -= turns * period;
                }
            }
        }
    }

    /// Position `i` with its whole periods.
    pub fn position(&self, i: usize, periods: &[f64; MAX_DOF]) -> f64 {
        let turns = self.turns[i];
        if turns == 0 { self.q[i] } else { self.q[i] + turns as f64 * periods[i] }
    }

    /// Whether positions, speeds and work are finite numbers.
    pub fn moves(&self) -> bool {
        // a sum is not finite if a term is not
        let sum = |x: &[f64]| x.iter().sum::<f64>();
        (sum(&self.q[..PLANET + 1]) + sum(&self.v[..PLANET + 1]) + self.work).is_finite()
    }

    /// Whether all numbers are what a simulation can go on with.
    pub fn is_valid(&self) -> bool {
        let numbers =
            [self.time, self.work, self.energy_at_start, self.control.last_error, self.bias.time, self.carrier_command];
        let anchors = self.holds.map(|h| h.anchor);
        let course = self.course.is_none_or(|course| course.is_finite());
        self.q.iter().chain(&self.v).chain(&numbers).chain(&self.heat).chain(&anchors).all(|x| x.is_finite())
            && course
            && self.turns.iter().all(|turns| turns.unsigned_abs() < MOST_TURNS)
            && (0.0..=1.0).contains(&self.lock)
            && self.control.next > 0.0
            && self.control.next.is_finite()
            && self.control.last >= 0.0
            && self.control.after_kink > 0.0
    }
}
