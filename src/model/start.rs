//! The state at the start time.

use super::ideal::Ideal;
use super::parameters::{Inputs, Start};
use super::state::{CARRIER, PLANET, State};
use super::teeth::{Equations, Teeth};
use crate::integrate::Point;
use crate::numeric::sqrt;
use crate::problem::Problem;

/// Newton steps for the static equilibrium; a handful is enough.
const MAX_ITERATIONS: usize = 200;
/// Longest Newton step [base pitches].
const LONGEST_STEP: f64 = 1.0 / 32.0;
/// Torque balance at equilibrium, relative to the loads.
const BALANCE: f64 = 1e-11;

/// Speeds at the start: imposed ones, and Willis' equation unless everything starts at rest.
fn speeds(ideal: &Ideal, inputs: &Inputs, start: Start, state: &mut State) {
    let plan = &ideal.plan;
    let rest = start == Start::Rest;
    let v = &mut state.v;
    v[CARRIER] = if rest && !plan.carrier_imposed { 0.0 } else { inputs.carrier_speed };
    for g in 0..plan.groups().len() {
        v[PLANET + g] = if plan.spin_imposed { inputs.planet_spin } else { 0.0 };
    }
    if !rest {
        ideal.constrain(state);
    }
}

/// Start of the ideal differential: its gears cannot be at rest under an imposed speed.
pub fn ideal_start(ideal: &Ideal, inputs: &Inputs, start: Start, state: &mut State) {
    speeds(ideal, inputs, start, state);
    ideal.constrain(state);
}

/// Start of the differential with teeth.
pub fn teeth_start<const N: usize>(
    teeth: &Teeth,
    ideal: &Ideal,
    inputs: &Inputs,
    start: Start,
    state: &mut State,
) -> Result<(), Problem> {
    speeds(ideal, inputs, start, state);
    if start == Start::Equilibrium {
        preload::<N>(teeth, ideal, inputs, state)?;
    }
    Ok(())
}

/// Presses the meshes together until tooth torques balance the loads.
///
/// First without rolling of the planets, as a minimum of the potential V + Σ T α near ψ = 0 (stiffness that varies along
/// the path holds small imbalances). Where there is none, the planets roll: then with the accelerations of the ideal
/// differential and ψ = 0.
fn preload<const N: usize>(teeth: &Teeth, ideal: &Ideal, inputs: &Inputs, state: &mut State) -> Result<(), Problem> {
    let inertia = &teeth.inertia;
    let held = Ideal { plan: teeth.plan.with_spin_held(), ..*ideal };
    let torque =
        |accelerations: [f64; 2]| std::array::from_fn(|s| inputs.load_torque[s] + inertia.side[s] * accelerations[s]);
    let still: [f64; 2] = torque(held.side_accelerations(&held.motion(inputs)));
    let equations = Equations::<N>::new(teeth, inputs, state);
    let mut point = Point::ZERO;
    press_sides(teeth, &equations, still, &mut point)?;
    if !teeth.plan.spin_imposed {
        let mut settled = point;
        if minimise(&equations, still, &mut settled) && within_a_tooth(teeth, &settled) {
            point = settled;
        } else {
            let rolling: [f64; 2] = torque(ideal.side_accelerations(&ideal.motion(inputs)));
            press_sides(teeth, &equations, rolling, &mut point)?;
        }
    }
    let stiffness = equations.tooth_stiffness(&point);
    let speeds = state.v;
    point.v = state.point::<N>().v;
    // quasi-static: while the planets spin, α follows the changing stiffness
    for s in 0..2 {
        if stiffness[s][s] != 0.0 {
            let by_spin: f64 =
                (0..teeth.plan.groups().len()).map(|g| stiffness[s][PLANET + g] * speeds[PLANET + g]).sum();
            point.v[s] = speeds[CARRIER] - by_spin / stiffness[s][s];
        }
    }
    state.set_point(&point);
    Ok(())
}

fn within_a_tooth<const N: usize>(teeth: &Teeth, point: &Point<N>) -> bool {
    let pitch = teeth.base_pitch / teeth.lever[0];
    (0..teeth.plan.groups().len()).all(|g| point.q[PLANET + g].abs() < pitch)
}

/// Turns each side gear with planets held at their spin until the teeth carry `torque`; unloaded sides stay in mid-gap.
fn press_sides<const N: usize>(
    teeth: &Teeth,
    equations: &Equations<N>,
    torque: [f64; 2],
    point: &mut Point<N>,
) -> Result<(), Problem> {
    for s in 0..2 {
        point.q[s] = 0.0;
        if torque[s] == 0.0 {
            continue;
        }
        // Q_α falls steadily with α: bracket between mid-gap and the angle at which a tooth would jump
        let mut free = 0.0;
        let mut pressed = -torque[s].signum() * (teeth.jump + teeth.mesh.half_backlash()) / teeth.lever[1];
        let excess = |alpha: f64, point: &mut Point<N>| {
            point.q[s] = alpha;
            (equations.tooth_torques(point).0[s] - torque[s]) * torque[s].signum()
        };
        if excess(pressed, point) < 0.0 {
            let name = if s == 0 { "left.load_torque" } else { "right.load_torque" };
            return Err(Problem::new(
                name,
                format!(
                    "{:.6} N.m cannot be carried at the start: a tooth would be bent beyond the working depth; \
                     reduce the load or raise contact.stiffness",
                    torque[s]
                ),
            ));
        }
        for _ in 0..200 {
            let middle = 0.5 * (free + pressed);
            if middle == free || middle == pressed {
                break;
            }
            if excess(middle, point) < 0.0 { free = middle } else { pressed = middle }
        }
        point.q[s] = pressed;
    }
    Ok(())
}

/// Damped Newton descent of V + Σ T_s α_s over side gears and planets; whether it reached a balance.
fn minimise<const N: usize>(equations: &Equations<N>, torque: [f64; 2], point: &mut Point<N>) -> bool {
    let teeth = equations.teeth;
    let groups = teeth.plan.groups().len();
    let unknowns: Vec<usize> = (0..2).chain(PLANET..PLANET + groups).collect();
    let members = |i: usize| if i < 2 { 1.0 } else { teeth.plan.groups()[i - PLANET].members };
    let potential = |p: &Point<N>| equations.elastic_energy(p) + torque[0] * p.q[0] + torque[1] * p.q[1];
    // ascent of the potential: torque on each unknown, planets counted by their members
    let force = |p: &Point<N>| {
        let sum = equations.tooth_torques(p).0;
        nalgebra::DVector::from_iterator(
            unknowns.len(),
            unknowns.iter().map(|&i| if i < 2 { sum[i] - torque[i] } else { members(i) * sum[i] }),
        )
    };
    let scale = BALANCE * (torque[0].abs() + torque[1].abs()).max(1e-6);
    let mut damping = 0.0;
    let mut residual = force(point);
    for _ in 0..MAX_ITERATIONS {
        if residual.amax() <= scale {
            return true;
        }
        let stiffness = equations.tooth_stiffness(point);
        let hessian = nalgebra::DMatrix::from_fn(unknowns.len(), unknowns.len(), |a, b| {
            -members(unknowns[a]) * stiffness[unknowns[a]][unknowns[b]]
        });
        let size = hessian.diagonal().amax().max(1e-9);
        let mut moved = false;
        for _ in 0..60 {
            let mut damped = hessian.clone();
            for i in 0..unknowns.len() {
                damped[(i, i)] += damping * size;
            }
            let step = damped.cholesky().map(|c| c.solve(&residual));
            // the potential tilts under unequal loads: a long step would leave the nearest well
            if let Some(step) = step.filter(|step| step.amax() < LONGEST_STEP * teeth.base_pitch) {
                let mut trial = *point;
                unknowns.iter().zip(step.iter()).for_each(|(&i, d)| trial.q[i] += d);
                let trial_residual = force(&trial);
                let closer = trial_residual.norm() < residual.norm();
                let lower = potential(&trial) < potential(point);
                if lower || closer && potential(&trial) <= potential(point) + 1e-12 * size {
                    (*point, residual, moved) = (trial, trial_residual, true);
                    damping = if damping < 1e-14 { 0.0 } else { damping * 0.1 };
                    break;
                }
            }
            damping = if damping == 0.0 { 1e-12 } else { damping * 10.0 };
        }
        if !moved {
            break;
        }
    }
    residual.amax() <= scale.max(sqrt(f64::EPSILON) * (torque[0].abs() + torque[1].abs()))
}
