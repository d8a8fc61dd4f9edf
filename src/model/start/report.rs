//! Warnings about a start: it is not in equilibrium, or planets carry unequal loads.

use super::preload::Preload;
use crate::declaration::SIDES;
use crate::integrate::SecondOrder;
use crate::model::assembly::Teeth;
use crate::model::dynamics::{Largest, State};
use crate::model::scene::{CARRIER, Inputs, MAX_DOF, MAX_GROUPS, Plan};
use crate::problem::Problem;

/// Fraction of the loads that may be unbalanced in an equilibrium.
const BALANCED: f64 = 1e-6;
/// Fraction of its equal share below which the load of a planet causes a warning.
const LITTLE: f64 = 0.5;
/// Loads below this value count as zero [N·m].
const LEAST_LOAD: f64 = 1e-6;

/// Accelerations and tooth torques at the start.
struct Found {
    /// Accelerations by degree of freedom [rad/s²; seats m/s²].
    acceleration: [f64; MAX_DOF],
    /// Torques of the teeth of one planet of each group on both side gears [N·m].
    torque: [[f64; 2]; MAX_GROUPS],
}

/// Result of the check of a start.
pub struct Outcome {
    /// True if the start is in equilibrium.
    pub in_equilibrium: bool,
    /// Warnings about the start.
    pub warnings: Vec<Problem>,
}

/// Checks the start `state` that `preload` has produced.
pub fn judge(teeth: &Teeth, inputs: &Inputs, state: &State, preload: &Preload) -> Outcome {
    let mut found = Found { acceleration: [0.0; MAX_DOF], torque: [[0.0; 2]; MAX_GROUPS] };
    let (equations, point) = (Largest::new(teeth, inputs, state), state.point());
    found.acceleration.copy_from_slice(&equations.evaluate(&point).0[..MAX_DOF]);
    for g in 0..teeth.plan.groups().len() {
        found.torque[g] = equations.planet_torques(&point, g);
    }
    let rolls = !preload.settled && rolls(teeth, preload);
    let balance =
        if rolls { Some(rolling(&teeth.plan, state, &found)) } else { unbalanced(teeth, state, preload, &found) };
    let in_equilibrium = balance.is_none();
    let messages = balance.into_iter().chain(unequal(&teeth.plan, &found));
    Outcome { in_equilibrium, warnings: messages.map(|message| Problem::new("scene.start", message)).collect() }
}

/// True if the torques accelerate the side gears against each other, beyond rounding.
fn rolls(teeth: &Teeth, Preload { carried, .. }: &Preload) -> bool {
    let [left, right] = carried.acceleration.side;
    teeth.inertia[0] * (left - right).abs() > BALANCED * (carried.teeth[0].abs() + carried.teeth[1].abs())
}

/// Warning that planets start to roll.
fn rolling(plan: &Plan, state: &State, found: &Found) -> String {
    let cause = match (0..2).find(|&s| state.dogs.is_open(&plan.dogs, s)) {
        Some(s) => format!("the {} dog clutch is open, so that its side gear turns freely", SIDES[s]),
        None => "neither teeth nor friction hold the planets against the difference of both sides".into(),
    };
    format!(
        "not an equilibrium: {cause}; the planets start to roll, and the gears accelerate like ideal gears, while their \
         teeth transmit {}",
        found.carried(plan)
    )
}

/// Warning if no equilibrium was found, or if torques on planets at rest are not balanced.
fn unbalanced(teeth: &Teeth, state: &State, preload: &Preload, found: &Found) -> Option<String> {
    let (layout, carried) = (&teeth.layout, &preload.carried);
    let load = carried.teeth[0].abs() + carried.teeth[1].abs();
    let planets = (0..layout.groups).map(|g| layout.planet(g));
    // torques on spinning planets change all the time
    let at_rest = planets.clone().all(|i| state.v[i] == 0.0);
    let sides = (0..2).map(|s| (s, carried.acceleration.side[s]));
    let left_over = sides
        .chain(planets.map(|i| (i, carried.acceleration.spin)))
        .chain([(CARRIER, carried.acceleration.carrier)])
        // the inverse inertia of imposed motions is zero
        .filter(|&(i, _)| at_rest && teeth.inverse_inertia[i] > 0.0)
        .map(|(i, expected)| (teeth.inertia[i] * (found.acceleration[i] - expected)).abs())
        .fold(0.0, f64::max);
    (load > LEAST_LOAD && (!preload.settled || left_over > BALANCED * load)).then(|| {
        format!(
            "no equilibrium was found: the teeth carry {} of {:.3} and {:.3} N.m, and the unbalanced torque accelerates the \
             gears immediately; peaks and ratings of the run include this",
            found.carried(&teeth.plan),
            carried.teeth[0],
            carried.teeth[1]
        )
    })
}

impl Found {
    /// Text with the torques that the teeth carry on each side.
    fn carried(&self, plan: &Plan) -> String {
        let on =
            |s: usize| plan.groups().iter().zip(&self.torque).map(|(group, torque)| group.members * torque[s]).sum();
        let [left, right]: [f64; 2] = [on(0), on(1)];
        format!("{left:.3} N.m left and {right:.3} N.m right")
    }
}

/// Warning if planets carry very unequal shares of the loads.
fn unequal(plan: &Plan, found: &Found) -> Option<String> {
    // planets that are jammed by errors push against the others
    let total = [0, 1].map(|s| (0..plan.planets).map(|i| found.torque[plan.group_of[i]][s]).sum::<f64>());
    let part = |planet: usize| {
        let [left, right] = found.torque[plan.group_of[planet]];
        left * total[0].signum() + right * total[1].signum()
    };
    let parts: Vec<f64> = (0..plan.planets).map(part).collect();
    let sum: f64 = parts.iter().sum();
    let equal = sum / plan.planets as f64;
    (sum > 2.0 * LEAST_LOAD && parts.iter().any(|&part| part < LITTLE * equal)).then(|| {
        let shares = parts.iter().enumerate().map(|(i, part)| format!("planet[{}] {:.3}", i + 1, part / sum));
        format!(
            "the planets carry unequal parts of the load at the start: {} of it",
            shares.collect::<Vec<_>>().join(", ")
        )
    })
}
