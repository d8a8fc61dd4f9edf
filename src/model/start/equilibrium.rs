//! Static equilibrium of loaded teeth: stable positions at which the meshes carry their loads.

use nalgebra::{DMatrix, DVector};

use super::carried::Carried;
use crate::contact::FlankGaps;
use crate::declaration::SIDES;
use crate::integrate::Point;
use crate::model::assembly::{Model, SIGMA};
use crate::model::dynamics::{FrictionEquations, Largest, MAX_SIZE};
use crate::model::run::failure::limit_name;
use crate::model::run::{LedgerEquations, hints};
use crate::model::scene::RubbingKind;
use crate::numeric::{Landscape, Search, TAU, rising_root, sqrt};
use crate::problem::Problem;

/// Longest step of the search for an equilibrium [base pitches]. Unequal loads tilt the potential, so that a longer
/// step would leave the nearest minimum.
const LONGEST_STEP: f64 = 1.0 / 32.0;
/// Imbalance of torques allowed in an equilibrium, relative to the loads.
const BALANCE: f64 = 1e-11;
/// Number of rounds in which actual teeth are pressed on both sides in turn, if no minimum is found.
pub const ROUNDS: usize = 12;
/// Loads below this value count as zero [N·m].
const LEAST_LOAD: f64 = 1e-6;

/// Turns each side gear until plain teeth carry `torque` [N·m], while planets keep their spin angles. Unloaded sides
/// stay in the middle of the gap. Fails if teeth would bend beyond their limit.
pub fn press_sides(
    model: &Model,
    equations: &Largest,
    torque: [f64; 2],
    point: &mut Point<MAX_SIZE>,
) -> Result<(), Problem> {
    press(equations, torque, point, |s, at| equations.torque_of_plain_teeth(s, at)).map_err(|s| {
        let bent = format!(
            "tooth deflection exceeds {}; reduce the load or {}",
            limit_name(model),
            hints::stiffer_teeth(&model.parameters)
        );
        not_carried(equations, torque, s, &bent)
    })
}

/// Error of a start whose `torque` on side `s` bends teeth too far. It names the input that causes this torque: the
/// largest of both loads and half of the drive's torque, as far as they act.
fn not_carried(equations: &Largest, torque: [f64; 2], s: usize, bent: &str) -> Problem {
    let (plan, inputs) = (&equations.teeth.plan, &equations.applied().inputs);
    let load = |s: usize| {
        let acting = if plan.side_imposed[s] { 0.0 } else { inputs.load_torque[s] };
        (["left.load_torque", "right.load_torque"][s], inputs.load_torque[s], acting)
    };
    let (name, given) = match plan.drive_ratio {
        None => ("carrier.torque_command", inputs.carrier_torque),
        Some(_) => ("pinion.torque_command", inputs.pinion_torque),
    };
    let drive = (name, given, if plan.drive_imposed { 0.0 } else { 0.5 * inputs.drive_torque });
    let larger = |a: (_, _, f64), b: (_, _, f64)| if b.2.abs() > a.2.abs() { b } else { a };
    let (name, given, _) = larger(larger(load(s), load(1 - s)), drive);
    let on_side = format!("puts {:.6} N.m on the {} side gear", torque[s], SIDES[s]);
    problem!(name, "{given:.6} N.m {on_side}, which cannot be carried at the start: {bent}")
}

/// Fails if teeth at the equilibrium `point` under `torque` bend beyond the limit of their law. This is possible
/// because actual teeth may be softer than the plain teeth that were pressed first.
pub fn check_settled(
    model: &Model,
    equations: &Largest,
    torque: [f64; 2],
    point: &Point<MAX_SIZE>,
) -> Result<(), Problem> {
    equations
        .check_deflection(point)
        .map(drop)
        .map_err(|bent| not_carried(equations, torque, bent.side, &bent.message(model)))
}

/// Presses both sides as [`press_sides`] does. `carry` returns the torque of the teeth on a side at a point, and its
/// derivative with respect to the side's angle. The error is the side that cannot be pressed.
fn press(
    equations: &Largest,
    torque: [f64; 2],
    point: &mut Point<MAX_SIZE>,
    carry: impl Fn(usize, &Point<MAX_SIZE>) -> [f64; 2],
) -> Result<(), usize> {
    let teeth = equations.teeth;
    let largest = (teeth.deflection_limit + teeth.contact.mesh.half_backlash()) / teeth.sin_base[1];
    for s in 0..2 {
        point.q[s] = 0.0;
        if torque[s] == 0.0 {
            continue;
        }
        let (load, against) = (torque[s].abs(), -torque[s].signum());
        let carry = |angle: f64| {
            let mut turned = *point;
            turned.q[s] = against * angle;
            let [carried, by_angle] = carry(s, &turned);
            [-against * carried - load, -by_angle]
        };
        point.q[s] = against * rising_root(carry, largest, BALANCE * load).ok_or(s)?;
    }
    Ok(())
}

/// Minimum of the potential under `loads`, searched from the point `pressed`, at which plain teeth carry the loads.
///
/// At this point, teeth with errors may still be separated, so that no force guides the search. Elastic gear bodies may
/// deflect far beyond this point, so that the search may find no minimum. In both cases, the search starts again from a
/// point at which actual teeth carry the loads. Actual teeth have errors, and their gear bodies are elastic. Returns
/// `None` if no minimum is found.
pub fn settle(equations: &Largest, loads: &Carried, pressed: &Point<MAX_SIZE>) -> Option<Point<MAX_SIZE>> {
    let is_other = equations.is_open_or_elastic();
    let touches = || {
        let sum = equations.statics(pressed).0;
        (0..2).all(|s| loads.teeth[s] == 0.0 || sum[s] != 0.0)
    };
    let found = if !is_other || touches() { minimum(equations, loads, pressed, false) } else { None };
    if found.is_some() || !is_other { found } else { settle_actual_teeth(equations, loads) }
}

/// Minimum of the potential under `loads`, searched from a point at which actual teeth carry the loads. Unloaded
/// planets roll with the others. Returns `None` if no minimum is found.
pub fn settle_actual_teeth(equations: &Largest, loads: &Carried) -> Option<Point<MAX_SIZE>> {
    minimum(equations, loads, &press_actual_teeth(equations, loads, 1)?, true)
}

/// Point at which each side gear is turned until actual teeth carry `loads`, while planets keep their spin angles.
/// Both sides are pressed `rounds` times, because elastic planet bodies couple them. Returns `None` if a side cannot
/// carry its load.
pub fn press_actual_teeth(equations: &Largest, loads: &Carried, rounds: usize) -> Option<Point<MAX_SIZE>> {
    let mut pressed = Point::ZERO;
    let carry = |s: usize, at: &Point<MAX_SIZE>| {
        let (sum, by_position) = equations.statics(at);
        [sum[s], by_position[s][s]]
    };
    for _ in 0..rounds {
        press(equations, loads.teeth, &mut pressed, carry).ok()?;
    }
    Some(pressed)
}

/// Position of the minimum of V + Σ T_s α_s near `point`, over all free positions except the carrier's. The minimum
/// must be within a tooth pitch or, if `along_valley`, within a turn of planets whose teeth differ; otherwise, the
/// result is `None`. Bodies that accelerate add their inertial torques to the loads.
///
/// Under equal loads, only V decides, and a minimum and its mirror image are equivalent. The planets then have positive
/// angles under loads that drive forward, and negative angles under the mirrored loads.
fn minimum(
    equations: &Largest,
    loads: &Carried,
    point: &Point<MAX_SIZE>,
    along_valley: bool,
) -> Option<Point<MAX_SIZE>> {
    let (teeth, torque) = (equations.teeth, loads.teeth);
    let mut against = [0.0; MAX_SIZE];
    against[..2].copy_from_slice(&torque);
    for g in 0..equations.groups() {
        against[teeth.layout.planet(g)] = teeth.inertia[teeth.layout.planet(g)] * loads.acceleration.spin
            + loads.friction.torque[RubbingKind::Planet.number(g)];
        if equations.has_pins() {
            against[teeth.layout.pin(g)] = teeth.inertia[teeth.layout.pin(g)] * loads.acceleration.carrier;
        }
    }
    // identical teeth are in balance in each pitch or in none
    let repeats = equations.gaps().is_none_or(FlankGaps::repeat_every_pitch);
    let farthest_spin_angle = if along_valley && !repeats { TAU } else { teeth.base_pitch / teeth.sin_base[0] };
    let well = Well { equations, against, point, unknowns: unknowns(equations), farthest_spin_angle };
    let load = torque[0].abs() + torque[1].abs();
    let forward = torque[0] + torque[1];
    let forward = if forward == 0.0 { torque[0] } else { forward };
    let lean = if forward < 0.0 { -1.0 } else { 1.0 };
    let is_planet = |i: usize| (0..teeth.layout.groups).any(|g| i == teeth.layout.planet(g));
    let balance = BALANCE * load.max(LEAST_LOAD);
    let search = Search {
        longest: LONGEST_STEP * teeth.base_pitch,
        balance,
        rough: balance.max(sqrt(f64::EPSILON) * load),
        lean: well.unknowns_from(|i| if is_planet(i) { lean } else { 0.0 }),
        valley: along_valley.then(|| {
            let ratio = teeth.sin_base[0] / teeth.sin_base[1];
            well.unknowns_from(|i| if i < 2 { SIGMA[i] * ratio } else { f64::from(is_planet(i)) })
        }),
    };
    Some(well.at(&search.minimum(&well, well.unknowns_from(|i| point.q[i]))?))
}

/// Indices of the unknown positions, and the number of identical bodies that each represents.
fn unknowns(equations: &Largest) -> Vec<(usize, f64)> {
    let teeth = equations.teeth;
    let layout = &teeth.layout;
    let mut unknowns = vec![(0, 1.0), (1, 1.0)];
    for g in 0..equations.groups() {
        if !teeth.plan.spin_imposed {
            unknowns.push((layout.planet(g), layout.members[g]));
        }
        if equations.has_pins() {
            unknowns.push((layout.pin(g), layout.members[g]));
        }
    }
    if equations.has_pins() {
        unknowns.extend([(layout.seat(0), 1.0), (layout.seat(1), 1.0)]);
    }
    unknowns
}

/// Potential V + Σ T_i q_i around `point` as a function of the unknown positions.
struct Well<'a> {
    equations: &'a Largest<'a>,
    /// Torques T_i on each body [N·m].
    against: [f64; MAX_SIZE],
    point: &'a Point<MAX_SIZE>,
    /// Indices of the unknown positions, and the number of identical bodies that each represents.
    unknowns: Vec<(usize, f64)>,
    /// Largest spin angle that a planet may have in either direction [rad].
    farthest_spin_angle: f64,
}

impl Well<'_> {
    fn unknowns_from(&self, value: impl Fn(usize) -> f64) -> DVector<f64> {
        DVector::from_iterator(self.unknowns.len(), self.unknowns.iter().map(|&(i, _)| value(i)))
    }

    fn at(&self, x: &DVector<f64>) -> Point<MAX_SIZE> {
        let mut point = *self.point;
        self.unknowns.iter().zip(x.iter()).for_each(|(&(i, _), &value)| point.q[i] = value);
        point
    }
}

impl Landscape for Well<'_> {
    fn value(&self, x: &DVector<f64>) -> f64 {
        let energy = self.equations.stored_energy(&self.at(x), false);
        self.unknowns.iter().zip(x.iter()).fold(energy, |sum, (&(i, members), q)| sum + members * self.against[i] * q)
    }

    fn is_near(&self, x: &DVector<f64>) -> bool {
        let (at, layout) = (self.at(x), &self.equations.teeth.layout);
        (0..layout.groups).all(|g| at.q[layout.planet(g)].abs() < self.farthest_spin_angle)
    }

    fn slopes(&self, x: &DVector<f64>) -> (DVector<f64>, DMatrix<f64>) {
        let (sum, by_position) = self.equations.statics(&self.at(x));
        // forces on the unknowns, times the number of bodies, are the negative gradient of the potential
        let force = |&(i, members): &(usize, f64)| members * (sum[i] - self.against[i]);
        let n = self.unknowns.len();
        let gradient = DVector::from_iterator(n, self.unknowns.iter().map(|unknown| -force(unknown)));
        let hessian = DMatrix::from_fn(n, n, |a, b| {
            let ((i, members), (j, _)) = (self.unknowns[a], self.unknowns[b]);
            -members * by_position[i][j]
        });
        (gradient, hessian)
    }
}
