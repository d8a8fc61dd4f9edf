//! The state at the start time.

use super::excessive_deflection::limit_name;
use super::hints;
use super::imposed::body_effects;
use crate::integrate::{Matrix, Point};
use crate::model::assembly::ideal::Ideal;
use crate::model::assembly::model::Model;
use crate::model::assembly::teeth::{SIGMA, Teeth};
use crate::model::dynamics::equations::Equations;
use crate::model::dynamics::state::State;
use crate::model::effects::half_shaft::HalfShafts;
use crate::model::scene::layout::CARRIER;
use crate::model::scene::{GearContact, InputDerivatives, Inputs, Start};
use crate::numeric::sqrt;
use crate::problem::Problem;

/// Newton steps for the static equilibrium; a handful is enough.
const MAX_ITERATIONS: usize = 200;
/// Longest Newton step [base pitches].
const LONGEST_STEP: f64 = 1.0 / 32.0;
/// Torque balance at equilibrium, relative to the loads.
const BALANCE: f64 = 1e-11;

/// Speeds at the start: imposed ones, and Willis' equation unless everything starts at rest.
pub fn speeds(model: &Model, inputs: &Inputs, state: &mut State) {
    let (plan, ratio) = (&model.ideal.plan, model.ideal.ratio);
    let layout = plan.layout();
    let rest = model.parameters.scene.start == Start::Rest;
    let mut carrier = if rest && !plan.carrier_imposed { 0.0 } else { inputs.carrier_speed };
    let mut spin = if plan.spin_imposed { inputs.planet_spin } else { 0.0 };
    let [left, right] = inputs.side_speed;
    match plan.side_imposed {
        [true, true] => (carrier, spin) = (0.5 * (left + right), 0.5 * (left - right) / ratio),
        [false, false] => {}
        [imposed_left, _] => {
            let s = usize::from(!imposed_left);
            let (speed, sigma) = (inputs.side_speed[s], SIGMA[s]);
            if plan.spin_imposed {
                carrier = speed - sigma * ratio * spin;
            } else {
                spin = sigma * (speed - carrier) / ratio;
            }
        }
    }
    let v = &mut state.v;
    // gears without teeth cannot be at rest against an imposed speed
    let follow = !rest || plan.contact == GearContact::Ideal;
    if follow || plan.carrier_imposed {
        v[CARRIER] = carrier;
    }
    for g in (0..layout.groups).filter(|_| follow || plan.spin_imposed) {
        v[layout.planet(g)] = spin;
        if layout.pins {
            v[layout.pin(g)] = v[CARRIER];
        }
    }
    for s in 0..2 {
        if follow {
            v[s] = carrier + SIGMA[s] * ratio * spin;
        }
        if layout.ends {
            let own = plan.shafts[s] && plan.side_imposed[s];
            v[layout.end(s)] = if own { inputs.side_speed[s] } else { v[s] };
        }
    }
}

/// `inputs` with the brakes of wheels that turn among the loads.
fn with_sliding_brakes(model: &Model, inputs: &Inputs, state: &State) -> Inputs {
    let friction = body_effects(model).friction(state.lock, inputs, &InputDerivatives::ZERO);
    let brakes = friction.wheel_loads(inputs);
    let (plan, layout) = (&model.ideal.plan, &model.layout);
    let load_torque = [0, 1].map(|s| {
        let speed = state.v[if plan.shafts[s] { layout.end(s) } else { s }];
        let direction = if speed == 0.0 { 0.0 } else { speed.signum() };
        inputs.load_torque[s] + direction * brakes[s].load
    });
    Inputs { load_torque, ..*inputs }
}

/// Torques that the side gears carry at the start, from accelerations where they are free to accelerate.
fn loads(model: &Model, ideal: &Ideal, inputs: &Inputs) -> [f64; 2] {
    let load = inputs.load_torque;
    match ideal.plan.side_imposed {
        // a differential shares the torque of its carrier equally
        [true, true] => [0.5 * inputs.carrier_torque; 2],
        [true, false] => [load[1]; 2],
        [false, true] => [load[0]; 2],
        [false, false] => {
            // what shafts carry is quasi-static: wheels at their ends accelerate with their side gears
            let mut together = *ideal;
            together.plan.shafts = [false; 2];
            let a = together.side_accelerations(&together.motion(inputs));
            [0, 1].map(|s| load[s] + model.ideal.inertia.side[s] * a[s])
        }
    }
}

/// Winds the half-shafts of an ideal differential up.
pub fn wind(model: &Model, shafts: &HalfShafts, inputs: &Inputs, state: &mut State) {
    let carried = loads(model, &model.ideal, &with_sliding_brakes(model, inputs, state));
    let plan = &model.ideal.plan;
    for s in (0..2).filter(|&s| plan.shafts[s]) {
        state.q[plan.layout().end(s)] = shafts.static_twist(s, carried[s]);
    }
}

/// Presses the meshes together until tooth torques balance the loads, and winds the half-shafts up.
///
/// First without rolling of the planets, as a minimum of the potential V + Σ T α near ψ = 0 (stiffness that varies along
/// the path holds small imbalances). Where there is none, the planets roll: then with the accelerations of the ideal
/// differential and ψ = 0.
pub fn preload<const N: usize, const G: usize, const P: usize, const WITH_EFFECTS: bool>(
    equations: &Equations<N, G, P, WITH_EFFECTS>,
    model: &Model,
    inputs: &Inputs,
    state: &mut State,
) -> Result<(), Problem> {
    let (teeth, ideal) = (equations.teeth, &model.ideal);
    let plan = &teeth.plan;
    let inputs = &with_sliding_brakes(model, inputs, state);
    let held = Ideal { plan: plan.with_spin_held(), ..*ideal };
    let still = loads(model, &held, inputs);
    let mut point = Point::ZERO;
    press_sides(model, teeth, equations, still, &mut point)?;
    let mut carried = still;
    let in_detail = WITH_EFFECTS && (teeth.additions.in_detail || P > 0);
    if !plan.spin_imposed || in_detail {
        let mut settled = point;
        if minimise(equations, still, &mut settled) && within_a_tooth(teeth, &settled) {
            point = settled;
        } else if !plan.spin_imposed {
            carried = loads(model, ideal, inputs);
            press_sides(model, teeth, equations, carried, &mut point)?;
        }
    }
    let (_, stiffness) = equations.statics(&point);
    let speeds = state.v;
    point.v = state.point::<N>().v;
    // quasi-static: while the planets spin, α follows the changing stiffness
    for s in 0..2 {
        if stiffness[s][s] != 0.0 {
            let spin = |g: usize| teeth.layout.planet(g);
            let by_spin: f64 = (0..G).map(|g| stiffness[s][spin(g)] * speeds[spin(g)]).sum();
            if !plan.shafts[s] || !plan.side_imposed[s] {
                point.v[s] = speeds[CARRIER] - by_spin / stiffness[s][s];
            }
        }
        if plan.shafts[s] {
            point.q[teeth.layout.end(s)] = teeth.additions.bodies.half_shafts.static_twist(s, carried[s]);
        }
    }
    state.set_point(&point);
    Ok(())
}

fn within_a_tooth<const N: usize>(teeth: &Teeth, point: &Point<N>) -> bool {
    let pitch = teeth.base_pitch / teeth.sin_base[0];
    (0..teeth.layout.groups).all(|g| point.q[teeth.layout.planet(g)].abs() < pitch)
}

impl<const N: usize, const G: usize, const P: usize, const WITH_EFFECTS: bool> Equations<'_, N, G, P, WITH_EFFECTS> {
    /// Forces of meshes and structure at rest, with their derivatives by position.
    fn statics(&self, at: &Point<N>) -> ([f64; N], Matrix<N>) {
        if WITH_EFFECTS && (self.teeth.additions.in_detail || P > 0) {
            return self.structure(at);
        }
        let still = Point { q: at.q, v: [0.0; N] };
        (self.tooth_torques(&still).0, self.tooth_stiffness(at))
    }

    /// Energy that belongs to [`Self::statics`].
    fn static_energy(&self, at: &Point<N>) -> f64 {
        if WITH_EFFECTS && (self.teeth.additions.in_detail || P > 0) {
            self.stored(at, false)
        } else {
            self.elastic_energy(at)
        }
    }
}

/// Turns each side gear with planets held at their spin until the teeth carry `torque`; unloaded sides stay in mid-gap.
fn press_sides<const N: usize, const G: usize, const P: usize, const WITH_EFFECTS: bool>(
    model: &Model,
    teeth: &Teeth,
    equations: &Equations<N, G, P, WITH_EFFECTS>,
    torque: [f64; 2],
    point: &mut Point<N>,
) -> Result<(), Problem> {
    for s in 0..2 {
        point.q[s] = 0.0;
        if torque[s] == 0.0 {
            continue;
        }
        // Q_α falls steadily with α: bracket between mid-gap and the angle of the largest deflection
        let mut free = 0.0;
        let mut pressed =
            -torque[s].signum() * (teeth.deflection_limit + teeth.mesh.half_backlash()) / teeth.sin_base[1];
        let excess = |alpha: f64, point: &mut Point<N>| {
            point.q[s] = alpha;
            (equations.tooth_torques(point).0[s] - torque[s]) * torque[s].signum()
        };
        if excess(pressed, point) < 0.0 {
            let name = if s == 0 { "left.load_torque" } else { "right.load_torque" };
            return Err(Problem::new(
                name,
                format!(
                    "{:.6} N.m cannot be carried at the start: tooth deflection exceeds {}; reduce the load or {}",
                    torque[s],
                    limit_name(model),
                    hints::stiffer_teeth(&model.parameters)
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

/// Damped Newton descent of V + Σ T_s α_s over all that is free but the carrier; whether it reached a balance.
fn minimise<const N: usize, const G: usize, const P: usize, const WITH_EFFECTS: bool>(
    equations: &Equations<N, G, P, WITH_EFFECTS>,
    torque: [f64; 2],
    point: &mut Point<N>,
) -> bool {
    let teeth = equations.teeth;
    let layout = &teeth.layout;
    // bodies and how many each stands for; a group without members has nothing to find
    let mut unknowns: Vec<(usize, f64)> = vec![(0, 1.0), (1, 1.0)];
    for g in (0..G).filter(|&g| layout.members[g] > 0.0) {
        if !teeth.plan.spin_imposed {
            unknowns.push((layout.planet(g), layout.members[g]));
        }
        if P > 0 {
            unknowns.push((layout.pin(g), layout.members[g]));
        }
    }
    if P > 0 {
        unknowns.extend([(layout.seat(0), 1.0), (layout.seat(1), 1.0)]);
    }
    let n = unknowns.len();
    let potential = |p: &Point<N>| equations.static_energy(p) + torque[0] * p.q[0] + torque[1] * p.q[1];
    // ascent of the potential: force on each unknown, counted by its members
    let ascent = |p: &Point<N>| {
        let (sum, stiffness) = equations.statics(p);
        let force = nalgebra::DVector::from_iterator(
            n,
            unknowns.iter().map(|&(i, m)| if i < 2 { sum[i] - torque[i] } else { m * sum[i] }),
        );
        let hessian = nalgebra::DMatrix::from_fn(n, n, |a, b| {
            let ((i, m), (j, _)) = (unknowns[a], unknowns[b]);
            -m * stiffness[i][j]
        });
        (force, hessian)
    };
    let scale = BALANCE * (torque[0].abs() + torque[1].abs()).max(1e-6);
    let mut damping = 0.0;
    let (mut residual, mut hessian) = ascent(point);
    for _ in 0..MAX_ITERATIONS {
        if residual.amax() <= scale {
            return true;
        }
        let size = hessian.diagonal().amax().max(1e-9);
        let mut moved = false;
        for _ in 0..60 {
            let mut damped = hessian.clone();
            for i in 0..n {
                damped[(i, i)] += damping * size;
            }
            let step = damped.cholesky().map(|c| c.solve(&residual));
            // the potential tilts under unequal loads: a long step would leave the nearest well
            if let Some(step) = step.filter(|step| step.amax() < LONGEST_STEP * teeth.base_pitch) {
                let mut trial = *point;
                unknowns.iter().zip(step.iter()).for_each(|(&(i, _), d)| trial.q[i] += d);
                let (trial_residual, trial_hessian) = ascent(&trial);
                let closer = trial_residual.norm() < residual.norm();
                let lower = potential(&trial) < potential(point);
                if lower || closer && potential(&trial) <= potential(point) + 1e-12 * size {
                    (*point, residual, hessian, moved) = (trial, trial_residual, trial_hessian, true);
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
