//! Values for the host's solver: continuous states, their rates, and event indicators. The states are the same in every
//! scene: position and velocity of each body. Positions are unwrapped.

use crate::model::dynamics::FrictionEquations;
use crate::model::dynamics::dogs::DogEquations;
use crate::model::dynamics::with_equations;
use crate::model::run::Simulation;
use crate::model::scene::{CARRIER, MAX_DOF, MAX_GROUPS, MAX_PLANETS, PAIRS, Plan, RubbingKind};

/// Body whose position and velocity are states.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Body {
    /// Side gear; its angle is relative to the carrier.
    Side(usize),
    /// Carrier.
    Carrier,
    /// Axial seat of a side gear.
    Seat(usize),
    /// Planet on its pin.
    Planet(usize),
    /// Pin; its angle is relative to the carrier, but its speed is absolute.
    Pin(usize),
    /// Attached body, such as the wheel-side end of a half-shaft; its position is the twist, but its speed is absolute.
    Attached(usize),
}

/// Bodies in the order of the states.
pub const BODIES: [Body; MAX_DOF] = {
    use Body::*;
    let mut all = [Carrier; MAX_DOF];
    let pairs = [(0, Side(0)), (1, Side(1)), (3, Seat(0)), (4, Seat(1))];
    let mut i = 0;
    while i < pairs.len() {
        all[pairs[i].0] = pairs[i].1;
        i += 1;
    }
    i = 0;
    while i < MAX_PLANETS {
        (all[5 + i], all[5 + MAX_PLANETS + i]) = (Planet(i), Pin(i));
        i += 1;
    }
    i = 5 + 2 * MAX_PLANETS;
    while i < MAX_DOF {
        all[i] = Attached(i - 5 - 2 * MAX_PLANETS);
        i += 1;
    }
    all
};

/// Number of states: positions of all bodies, then their velocities.
pub const STATES: usize = 2 * MAX_DOF;
/// Number of event indicators: touch of drive and coast flanks of each mesh, then dry friction by the numbers of the
/// pairs, with each planet instead of each group, then both dog clutches.
pub const INDICATORS: usize = 4 * MAX_PLANETS + PAIRS + 2;
// otherwise planets would need more indicators than groups of planets
const _: () = assert!(MAX_PLANETS == MAX_GROUPS);
/// Value of an indicator whose event cannot occur.
const NEVER: f64 = 1.0;

impl Body {
    /// Degree of freedom of the body in a scene, or `None` if it does not move independently.
    fn freedom(self, plan: &Plan) -> Option<usize> {
        let layout = plan.layout();
        match self {
            Self::Side(s) => Some(s),
            Self::Carrier => Some(CARRIER),
            Self::Seat(s) => plan.has_pins.then(|| layout.seat(s)),
            Self::Planet(i) => (i < plan.planets).then(|| layout.planet(plan.group_of[i])),
            Self::Pin(i) => (plan.has_pins && i < plan.planets).then(|| layout.pin(plan.group_of[i])),
            Self::Attached(k) => plan.attached(k),
        }
    }
}

impl Simulation {
    /// All states; 0 for bodies that do not move independently.
    pub fn states(&self) -> [f64; STATES] {
        let state = &self.with_inputs_applied().state;
        self.states_of(|i| state.position(i, &self.model.periods), &state.v)
    }

    /// Rates of all states.
    pub fn state_rates(&self) -> [f64; STATES] {
        let [mut dq, mut dv] = [[0.0; MAX_DOF]; 2];
        let simulation = self.with_inputs_applied();
        simulation.rates(&simulation.state.q, &simulation.state.v, [&mut dq, &mut dv]);
        self.states_of(|i| dq[i], &dv)
    }

    /// States from positions and velocities by degree of freedom.
    pub fn states_of(&self, position: impl Fn(usize) -> f64, v: &[f64; MAX_DOF]) -> [f64; STATES] {
        let mut states = [0.0; STATES];
        for (k, body) in BODIES.iter().enumerate() {
            if let Some(i) = body.freedom(&self.model.ideal.plan) {
                (states[k], states[MAX_DOF + k]) = (position(i), v[i]);
            }
        }
        states
    }

    /// Sets positions and velocities by degree of freedom from states. If planets move as one group, the first of them
    /// counts.
    pub(super) fn set_from_states(&self, states: &[f64; STATES], q: &mut [f64; MAX_DOF], v: &mut [f64; MAX_DOF]) {
        let plan = &self.model.ideal.plan;
        for (k, body) in BODIES.iter().enumerate().rev() {
            if let Some(i) = body.freedom(plan) {
                (q[i], v[i]) = (states[k], states[MAX_DOF + k]);
            }
        }
    }

    /// Event indicators: approach of flanks [m], positive if they press on each other; distance of dry friction from
    /// its switch [N·m while stuck, rad/s while sliding], and of dog clutches from theirs, relative to the limits.
    pub fn indicators(&self) -> [f64; INDICATORS] {
        let mut indicators = [NEVER; INDICATORS];
        let (model, inputs, state) = (&*self.model, &self.inputs, &self.state);
        let plan = &model.ideal.plan;
        if let Some(equations) = self.teeth_equations() {
            let (mesh, point) = (&equations.teeth.contact.mesh, state.point());
            for i in 0..plan.planets {
                for s in 0..2 {
                    let position = equations.mesh_state(&point, plan.group_of[i], s).position[0];
                    let drive = mesh.drive_approach(position);
                    let coast = -2.0 * mesh.half_backlash() - drive;
                    indicators[4 * i + 2 * s] = drive * model.pair.mean_cone;
                    indicators[4 * i + 2 * s + 1] = coast * model.pair.mean_cone;
                }
            }
        }
        with_equations!(model, state, inputs, |equations| {
            let margins = equations.friction_margins(&state.point());
            let (friction, dogs) = indicators[4 * MAX_PLANETS..].split_at_mut(PAIRS);
            for (number, indicator) in friction.iter_mut().enumerate() {
                let of = match RubbingKind::of(number) {
                    (RubbingKind::Planet, i) if i >= plan.planets => continue,
                    (RubbingKind::Planet, i) => RubbingKind::Planet.number(plan.group_of[i]),
                    _ => number,
                };
                *indicator = margins[of].unwrap_or(NEVER);
            }
            for (indicator, margin) in dogs.iter_mut().zip(equations.dog_margins(&state.point())) {
                *indicator = margin.unwrap_or(NEVER);
            }
        });
        indicators
    }
}
