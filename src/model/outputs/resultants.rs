//! Forces, torques and powers at an instant: what outputs read, computed when asked for.

use super::forces::{Extent, Forces, MeshForces, bias};
use super::pv::each_pv;
use crate::contact::ToothLoad;
use crate::geometry::Pair;
use crate::integrate::{Point, SecondOrder};
use crate::model::assembly::{Model, SIGMA};
use crate::model::dynamics::ledger_rates::LedgerRates;
use crate::model::dynamics::{Acted, IdealEquations, IdealTorques, LARGEST, Largest, State};
use crate::model::effect_kinds::{BodyMotion, Changes, Instant};
use crate::model::effects::strength::{CONTACT_TEMPERATURE, MeshLoad};
use crate::model::scene::{CARRIER, Inputs, MAX_GROUPS, Plan};
use crate::model::setup::effect_outputs::{HEATS_WITHIN, places_of};
use crate::model::setup::{HEATS, scene_effects};
use crate::model::thermal::GEARS;
use crate::numeric::{sin, sqrt};

impl MeshForces {
    fn add(&mut self, load: &ToothLoad) {
        let [planet, side, forward] = load.parts;
        self.normal += load.normal;
        // a slice counts by its share of the face, so that pairs stay whole numbers where loads do not differ over it
        self.pairs += if load.normal > 0.0 { load.share } else { 0.0 };
        self.side_thrust += load.normal * side;
        self.planet_thrust += load.normal * planet;
        self.tangential += load.normal * forward;
    }
}

/// Sums over meshes and sides that all levels share, from `out.mesh` of all planets.
fn add_up(out: &mut Forces, planets: usize) {
    for i in 0..planets {
        let mesh = out.mesh[i];
        let (mut across, mut along) = (0.0, 0.0);
        for s in 0..2 {
            out.side_normal[s] += mesh[s].normal;
            out.side_thrust[s] += mesh[s].side_thrust;
            out.planet_thrust[i] += mesh[s].planet_thrust;
            across += mesh[s].tangential;
            along += SIGMA[s] * mesh[s].side_thrust;
        }
        out.pin_force[i] = sqrt(across * across + along * along);
    }
}

/// Powers from torques and speeds; heat is given. `ends` are the speeds at which torques are handed to the wheels.
fn add_powers(out: &mut Forces, plan: &Plan, state: &State, ends: [f64; 2], heat: f64) {
    let v = &state.v;
    let drives = [out.carrier_torque * v[CARRIER], out.spin_torque * v[plan.layout().planet(0)]];
    let wheels = [out.shaft_torque[0] * ends[0], out.shaft_torque[1] * ends[1]];
    (out.power_in, out.power_out) = (drives[0] + drives[1], wheels[0] + wheels[1]);
    out.power_fed = drives.iter().map(|power| power.max(0.0)).sum::<f64>()
        + wheels.iter().map(|power| (-power).max(0.0)).sum::<f64>();
    out.power_loss = heat;
    let torque = state.torque_means.mean().filter(|_| plan.layout().has_ends()).unwrap_or(out.shaft_torque);
    (out.torque_bias_ratio, out.locking_value) = bias(torque, [v[0], v[1]]);
}

/// Speeds of the wheel-side ends.
fn end_speeds(plan: &Plan, state: &State) -> [f64; 2] {
    [0, 1].map(|s| if plan.shafts[s] { state.v[plan.layout().end(s)] } else { state.v[s] })
}

/// Sets the readings of the effects that follow from the motion.
fn read_effects(out: &mut Forces, model: &Model, inputs: &Inputs, state: &State) {
    let (p, plan, layout) = (&model.parameters, &model.ideal.plan, &model.layout);
    let oil_viscosity = model.body_effects().oil_viscosity(&state.thermal.felt);
    let motion = BodyMotion { q: &state.q, v: &state.v, layout, inputs, input_rates: &Inputs::ZERO, oil_viscosity };
    let at = Instant { on: false, plan, motion: &motion, shaft_torque: out.shaft_torque };
    scene_effects::read(&p.effects, &p.specs, &at, &mut out.readings);
    // flanks without a flash, or with one that nobody computes, are as warm as their gears
    let strength = &mut out.readings[const { places_of("strength", Changes::Always) }];
    strength[CONTACT_TEMPERATURE] = state.thermal.temperatures()[GEARS];
}

/// Raises the readings of p·v to the largest of each effect's surfaces. Apart, for small stacks.
#[inline(never)]
fn read_pv<const N: usize>(out: &mut Forces, model: &Model, equations: &impl Acted<N>, at: &Point<N>) {
    each_pv(equations, &model.body_effects().friction, at, |source, _, pv| {
        if let Some(place) = places_of(source.effect, Changes::Always).next() {
            out.readings[place] = out.readings[place].max(pv);
        }
    });
}

/// Power turned into heat within the differential [W].
fn lost(heat: &[f64; HEATS]) -> f64 {
    heat.iter().zip(HEATS_WITHIN).map(|(heat, within)| if within { *heat } else { 0.0 }).sum()
}

/// Forces of the differential with teeth, as far as they are asked for.
pub fn teeth_forces(model: &Model, equations: &Largest, inputs: &Inputs, (state, extent): (&State, Extent)) -> Forces {
    let has_parts = extent == Extent::Parts;
    let (teeth, point, pair) = (equations.teeth, &state.point(), &model.pair);
    let plan = &teeth.plan;
    let ForcesAtInstant { acceleration: a, on_sides, carrier_torque, spin_torque, ledger_rates } =
        equations.instant(point);
    let mut out =
        Forces { carrier_acceleration: a[CARRIER], side_acceleration: [a[0], a[1]], has_parts, ..Forces::default() };
    (out.carrier_torque, out.spin_torque) = (carrier_torque, spin_torque);
    let brakes = equations.brake_torques(point);
    for s in 0..2 {
        out.shaft_torque[s] = if plan.shafts[s] {
            equations.shaft_torque(point, s)
        } else {
            inputs.load_torque[s] + brakes[s] + teeth.rigid_end[s] * a[s]
        };
        out.side_tangential[s] = on_sides[s] / (0.5 * pair.outer_pitch_diameter(1));
    }
    read_effects(&mut out, model, inputs, state);
    read_pv(&mut out, model, equations, point);
    if extent == Extent::Bodies {
        add_powers(&mut out, plan, state, end_speeds(plan, state), lost(&ledger_rates.heat));
        return out;
    }
    let mut groups = [[MeshForces::default(); 2]; MAX_GROUPS];
    let mut stress = [[MeshLoad::default(); 2]; MAX_GROUPS];
    let mut flash = 0.0f64;
    for g in 0..plan.groups().len() {
        if let Some(strength) = model.strength() {
            equations.pair_loads(pair, point, g, |s, load| {
                strength.add_load(&mut stress[g][s], load);
                strength.add_pressure(&mut stress[g][s], load);
            });
        }
        for s in 0..2 {
            let mesh = &mut groups[g][s];
            mesh.transmission_error =
                teeth.contact.mesh.drive_approach(equations.mesh_state(point, g, s).position[0]) * pair.mean_cone;
            let add = &mut |load: &ToothLoad| mesh.add(load);
            if has_parts {
                equations.tooth_loads(pair, point, g, s, add);
            } else {
                equations.loads_over_the_face(point, g, s, |load, _| add(load));
            }
            if let Some(strength) = model.strength() {
                // damping is spread over the face in another way than the elastic load
                equations.loads_over_the_face(point, g, s, |load, line_load| {
                    if let Some(line_load) = line_load {
                        strength.add_pressure_at_ends(&mut stress[g][s], load, line_load);
                    }
                });
                if let Some(law) = equations.flank_friction() {
                    // one slice stands for its pair, whose whole face is searched
                    let mut last = None;
                    equations.slices(point, g, s, |slice| {
                        if last.replace(slice.name) != Some(slice.name) {
                            flash = flash.max(strength.flash(&teeth.contact.detailed, &law, slice));
                        }
                    });
                }
            }
        }
    }
    if let Some(strength) = model.strength() {
        let meshes = stress[..plan.groups().len()].iter().flatten().copied();
        let readings = &mut out.readings[const { places_of("strength", Changes::Always) }];
        strength.read_stresses(meshes, readings);
        strength.read_flash(flash, &state.thermal.temperatures(), readings);
    }
    for i in 0..plan.planets {
        out.mesh[i] = groups[plan.group_of[i]];
    }
    add_up(&mut out, plan.planets);
    add_powers(&mut out, plan, state, end_speeds(plan, state), lost(&ledger_rates.heat));
    out
}

/// Accelerations and torques at an instant, of one evaluation.
struct ForcesAtInstant {
    acceleration: [f64; LARGEST],
    /// Torques of the meshes on the side gears, alone [N·m].
    on_sides: [f64; 2],
    /// Torque of the carrier's drive [N·m].
    carrier_torque: f64,
    /// Torque of what imposes the spin, all planets together [N·m].
    spin_torque: f64,
    ledger_rates: LedgerRates,
}

impl Largest<'_> {
    fn instant(&self, at: &Point<LARGEST>) -> ForcesAtInstant {
        let plan = &self.teeth.plan;
        let (mut sum, mut imposed, mut ledger_rates) = ([0.0; LARGEST], [0.0; LARGEST], LedgerRates::default());
        let on_sides = self.act_of_teeth(at, &mut sum, &mut ledger_rates);
        self.act_on_bodies(at, &mut sum, &mut imposed, &mut ledger_rates);
        let carrier_torque = if plan.carrier_imposed {
            self.teeth.inertia[CARRIER] * imposed[CARRIER] - sum[CARRIER]
        } else {
            self.acting.inputs.carrier_torque + ledger_rates.drive
        };
        let inertial = self.teeth.inertia[self.planet(0)] * self.acting.input_derivatives.rates[0].planet_spin;
        let spin_torque =
            if plan.spin_imposed { self.sum(|g| self.members(g) * (inertial - sum[self.planet(g)])) } else { 0.0 };
        self.finish(at, &mut sum, &imposed, &mut ledger_rates);
        ForcesAtInstant { acceleration: sum, on_sides, carrier_torque, spin_torque, ledger_rates }
    }
}

/// Meshes of gears without teeth: a side gear's torque shared equally, acting at the pitch point.
fn pitch_point_meshes(out: &mut Forces, pair: &Pair, planets: usize, torque: [f64; 2]) {
    let mut mesh = [MeshForces::default(); 2];
    for s in 0..2 {
        out.side_tangential[s] = torque[s] / (0.5 * pair.outer_pitch_diameter(1));
        let normal = torque[s] / (planets as f64 * pair.mean_cone * pair.sin_base()[1]);
        let (alpha, pitch) = (pair.pressure_angle, [pair.gears[0].pitch, pair.gears[1].pitch]);
        mesh[s] = MeshForces {
            normal: normal.abs(),
            pairs: if normal == 0.0 { 0.0 } else { 1.0 },
            side_thrust: normal.abs() * sin(alpha) * sin(pitch[1]),
            planet_thrust: normal.abs() * sin(alpha) * sin(pitch[0]),
            tangential: normal * crate::numeric::cos(alpha),
            transmission_error: 0.0,
        };
    }
    out.mesh[..planets].fill(mesh);
    add_up(out, planets);
}

/// Forces of gears without teeth from the accelerations of carrier and sides, and torques.
fn without_teeth(
    model: &Model,
    (inputs, state): (&Inputs, &State),
    (carrier_acceleration, side_acceleration): (f64, [f64; 2]),
    (torques, shaft_torque): (&IdealTorques, [f64; 2]),
    heat: f64,
) -> Forces {
    let plan = &model.ideal.plan;
    let (carrier_torque, spin_torque) = (torques.carrier, torques.spin);
    let mut out = Forces {
        carrier_acceleration,
        side_acceleration,
        carrier_torque,
        spin_torque,
        shaft_torque,
        has_parts: true,
        ..Forces::default()
    };
    read_effects(&mut out, model, inputs, state);
    pitch_point_meshes(&mut out, &model.pair, plan.planets, torques.gears);
    add_powers(&mut out, plan, state, end_speeds(plan, state), heat);
    out
}

/// Forces of the ideal differential.
pub fn ideal_forces(model: &Model, inputs: &Inputs, state: &State) -> Forces {
    let (ideal, inertia) = (&model.ideal, &model.ideal.inertia);
    let motion = ideal.motion(inputs);
    let a = ideal.side_accelerations(&motion);
    let with = |inertia: &[f64; 2]| [0, 1].map(|s| inputs.load_torque[s] + inertia[s] * a[s]);
    let torques = IdealTorques { carrier: motion.carrier_torque, spin: motion.spin_torque, gears: with(&inertia.side) };
    without_teeth(model, (inputs, state), (motion.carrier, a), (&torques, with(&inertia.end)), 0.0)
}

/// Forces of the ideal differential with effects on bodies.
pub fn ideal_forces_with_effects(model: &Model, equations: &IdealEquations, inputs: &Inputs, state: &State) -> Forces {
    let (plan, point) = (&model.ideal.plan, &state.point());
    let (a, ledger_rates) = equations.evaluate(point);
    let brakes = equations.brake_torques(point);
    let by_rigid = |s: usize| inputs.load_torque[s] + brakes[s] + equations.ideal.rigid_end[s] * a[s];
    let shafts = [0, 1].map(|s| if plan.shafts[s] { ledger_rates.shaft[s] } else { by_rigid(s) });
    let heat = lost(&ledger_rates.heat);
    let torques = equations.torques(point);
    let mut out = without_teeth(model, (inputs, state), (a[CARRIER], [a[0], a[1]]), (&torques, shafts), heat);
    read_pv(&mut out, model, equations, point);
    out
}
