//! Everything that changes while a simulation runs: small, `Copy`, and complete, so that a snapshot is an assignment.

use serde::{Deserialize, Serialize};

use crate::integrate::{Control, Point, Statistics};
use crate::model::assembly::additions::BodyEffects;
use crate::model::effect_kinds::dry_friction::FrictionState;
use crate::model::effects::strength::Fatigue;
use crate::model::scene::layout::{CARRIER, HELD_PLANETS, HOLDS, MAX_DOF, PLANET, WHEELS};
use crate::model::scene::{Course, Inputs, Layout};
use crate::model::setup::effect_outputs::HEATS;

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
    pub heat: [f64; HEATS],
    /// State of the dry friction: side gears, groups of planets, wheels.
    pub friction: [FrictionState; HOLDS],
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
            heat: [0.0; HEATS],
            friction: [FrictionState::default(); HOLDS],
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
    /// The anchors of dry friction move along with their bodies.
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
                self.move_anchors(i, turns * period, layout);
            }
        }
    }

    /// Moves the anchors of all friction whose position includes that of degree of freedom `i`.
    fn move_anchors(&mut self, i: usize, by: f64, layout: &Layout) {
        let planet = i.wrapping_sub(layout.planet(0));
        if i < CARRIER {
            self.friction[i].anchor -= by;
            self.friction[WHEELS + i].anchor -= by;
        } else if i == CARRIER {
            self.friction[WHEELS].anchor -= by;
            self.friction[WHEELS + 1].anchor -= by;
        } else if planet < layout.groups {
            self.friction[HELD_PLANETS + planet].anchor -= by;
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
        let anchors = self.friction.map(|f| f.anchor);
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

impl BodyEffects {
    /// Whether effects act in `state`: those of the scene, a lock that is commanded or still holds, or inputs that
    /// change.
    pub fn act_in(&self, state: &State) -> bool {
        self.always
            || state.course.is_some()
            || state.lock > 0.0
            || state.friction.iter().any(|friction| friction.stiffness > 0.0)
    }
}
