//! Forces, torques and powers at an instant, and the ratios that follow from them. They are computed when outputs
//! request them.

use crate::contact::ToothLoad;
use crate::geometry::Pair;
use crate::integrate::{Point, SecondOrder};
use crate::model::assembly::ideal_with_effects::IDEAL_SIZE;
use crate::model::assembly::{Model, SIGMA};
use crate::model::dynamics::ledger_rates::LedgerRates;
use crate::model::dynamics::{FrictionEquations, IdealEquations, IdealTorques, Largest, MAX_SIZE, State};
use crate::model::effect_kinds::dry_friction::SPEED_TOLERANCE;
use crate::model::effect_kinds::{BodyMotion, Changes, Instant, Warmed};
use crate::model::effects::strength::{CONTACT_TEMPERATURE, GearStrength, MeshLoad};
use crate::model::scene::{CARRIER, Inputs, MAX_GROUPS, MAX_PLANETS, Plan, RubbingKind};
use crate::model::setup::effect_outputs::{ALL_HEATS, INSTANT_READINGS, indices_of};
use crate::model::setup::{HEATS, scene_effects};
use crate::model::thermal::GEARS;
use crate::numeric::{sin, sqrt};

/// Extent to which forces are computed.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Extent {
    /// Torques, accelerations and powers of the bodies; meshes stay zero.
    Bodies,
    /// Normal forces of the meshes in addition.
    Loads,
    /// Spatial components of the normal forces in addition, which cost as much as all other forces.
    Components,
}

/// Forces, torques and accelerations from one evaluation of the tooth forces.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Forces {
    /// Carrier acceleration [rad/s²].
    pub carrier_acceleration: f64,
    /// Side gear accelerations [rad/s²].
    pub side_acceleration: [f64; 2],
    /// Torque that the drive delivers, referred to the carrier [N·m].
    pub drive_torque: f64,
    /// Torque on the carrier [N·m]: of the drive, or of the ring gear that the drive turns.
    pub carrier_torque: f64,
    /// Torque that the shaft delivers to the pinion [N·m].
    pub pinion_torque: f64,
    /// Torque of the drive at the port [N·m].
    pub port_torque: f64,
    /// Torque that the half-shafts deliver to the wheels [N·m].
    pub shaft_torque: [f64; 2],
    /// Torque of all meshes on a side gear, referred to its outer pitch circle [N].
    pub side_tangential: [f64; 2],
    /// Normal forces of all meshes of a side gear [N].
    pub side_normal: [f64; 2],
    /// Thrust of all meshes on a side gear, away from the apex [N].
    pub side_thrust: [f64; 2],
    /// Torque that imposes the spin, summed over all planets [N·m].
    pub spin_torque: f64,
    /// Forces of the meshes, by planet and side.
    pub mesh: [[MeshForces; 2]; MAX_PLANETS],
    /// Resultant of a planet's mesh forces across its pin [N].
    pub pin_force: [f64; MAX_PLANETS],
    /// Thrust of both meshes on a planet, away from the apex [N].
    pub planet_thrust: [f64; MAX_PLANETS],
    /// Power delivered by the drives [W].
    pub power_in: f64,
    /// Power delivered to the wheels [W].
    pub power_out: f64,
    /// Sum of the powers of all ports that feed power in: carrier, left wheel, right wheel and spin drive [W].
    pub power_fed: f64,
    /// Power turned into heat within the differential [W].
    pub power_loss: f64,
    /// Signed torque bias ratio T_slow/T_fast, with slow and fast in the sense of the torques. If shafts twist, it is
    /// the ratio of means over the last whole mesh cycle. It is 1 if the sum of the torques is below 1e-3 N·m.
    pub torque_bias_ratio: f64,
    /// Locking value |ΔT|/|T_L + T_R|. If shafts twist, it follows from means over the last whole mesh cycle. It is 0
    /// if the sum of the torques is below 1e-3 N·m.
    pub locking_value: f64,
    /// Readings of the effects that change at any instant.
    pub readings: [f64; INSTANT_READINGS],
    /// True if the spatial components of normal forces are included: thrusts, tangential and pin forces.
    pub has_components: bool,
}

/// Torque bias ratio and locking value of shaft torques at given speeds; 1 and 0 if the sum of the torques is below
/// [`LEAST_TORQUE`]. The sign of the sum decides which side is fast. For a sum near 0, rounding would decide, and the
/// result would depend on the representation of gear contact.
///
/// The fast side is ahead in the sense of the torques: the left side is fast if (ω_L − ω_R)(T_L + T_R) > 0. This is
/// valid forward and backward, in drive and overrun, and with the carrier turning or at rest. Friction turns the power
/// (T_R − T_L)(ω_L − ω_R)/2 ≥ 0 into heat. It therefore always takes torque from the fast side, and a bias by friction
/// is at least 1. If the speeds of both sides differ by less than the tolerance of dry friction, the side with less
/// torque counts as the fast one. It would be ahead if it slipped.
pub fn bias(torque: [f64; 2], speed: [f64; 2]) -> (f64, f64) {
    let sum = torque[0] + torque[1];
    // a torque that is NaN has no bias
    if sum.abs().is_nan() || sum.abs() < LEAST_TORQUE {
        return (1.0, 0.0);
    }
    let ahead = (speed[0] - speed[1]) * sum.signum();
    let is_left_fast = if ahead.abs() > ALIKE { ahead > 0.0 } else { torque[0].abs() < torque[1].abs() };
    let [slow, fast] = if is_left_fast { [torque[1], torque[0]] } else { torque };
    // a fast side without torque would make the ratio infinite
    let ratio = if fast != 0.0 { (slow / fast).clamp(-MOST_BIAS, MOST_BIAS) } else { MOST_BIAS };
    (ratio, ((torque[0] - torque[1]).abs() / sum.abs()).min(MOST_BIAS))
}

/// Difference of speeds up to which both sides count as equally fast [rad/s].
const ALIKE: f64 = SPEED_TOLERANCE;
/// Sum of the shaft torques below which no bias is computed [N·m].
const LEAST_TORQUE: f64 = 1e-3;
/// Largest magnitude of the torque bias ratio and of the locking value.
const MOST_BIAS: f64 = 1e6;

/// Fraction of the power fed in that is not lost, at least 0; 1 if no power is fed in. Energy that bodies and teeth
/// store and return is not lost.
pub fn efficiency(forces: &Forces) -> f64 {
    let fed = forces.power_fed;
    if fed > 0.0 { (1.0 - forces.power_loss / fed).max(0.0) } else { 1.0 }
}

/// Forces of one mesh (a planet with one side gear).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct MeshForces {
    /// Sum of the normal forces of its tooth pairs [N].
    pub normal: f64,
    /// Number of loaded tooth pairs.
    pub pairs: f64,
    /// Thrust on the side gear, along its axis away from the apex [N].
    pub side_thrust: f64,
    /// Thrust on the planet, along its axis away from the apex [N].
    pub planet_thrust: f64,
    /// Force on the side gear along the carrier's direction of rotation [N]; negative on the coast flank.
    pub tangential: f64,
    /// Transmission error: approach of the drive flanks at the mean cone distance [m].
    pub transmission_error: f64,
}

impl MeshForces {
    fn add(&mut self, load: &ToothLoad) {
        let [planet, side, forward] = load.components;
        self.normal += load.normal;
        // a slice counts with its share of the face, so pairs are whole numbers if loads do not differ over the face
        self.pairs += if load.normal > 0.0 { load.share } else { 0.0 };
        self.side_thrust += load.normal * side;
        self.planet_thrust += load.normal * planet;
        self.tangential += load.normal * forward;
    }
}

/// Computes the sums over meshes and sides from `out.mesh` of all planets, for all representations of gear contact.
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

/// Computes the powers from torques, speeds and the given `heat` [W].
fn add_powers(out: &mut Forces, plan: &Plan, state: &State, heat: f64) {
    let v = &state.v;
    let drives = [out.drive_torque * v[plan.layout().port], out.spin_torque * v[plan.layout().planet(0)]];
    let wheels = [0, 1].map(|s| out.shaft_torque[s] * v[if plan.shafts[s] { plan.layout().end(s) } else { s }]);
    (out.power_in, out.power_out) = (drives[0] + drives[1], wheels[0] + wheels[1]);
    out.power_fed = drives.iter().map(|power| power.max(0.0)).sum::<f64>()
        + wheels.iter().map(|power| (-power).max(0.0)).sum::<f64>();
    out.power_loss = heat;
    let torque = state.sums.torque_means.mean().filter(|_| plan.layout().has_ends()).unwrap_or(out.shaft_torque);
    (out.torque_bias_ratio, out.locking_value) = bias(torque, [v[0], v[1]]);
}

/// Sets the torque on the carrier, and the readings of the effects that follow from the motion. `held` is the torque with
/// which dry friction holds the pinion back [N·m].
fn read_effects(
    out: &mut Forces,
    model: &Model,
    (inputs, state): (&Inputs, &State),
    (held, clutches): (f64, [f64; 2]),
) {
    let (p, plan, layout) = (&model.parameters, &model.ideal.plan, &model.layout);
    let oil_viscosity = model.body_effects().oil_viscosity(&state.sums.thermal.used);
    let (State { q, v, dogs, .. }, input_rates) = (state, &Inputs::ZERO);
    let motion = BodyMotion { q, v, layout, inputs, input_rates, dogs, oil_viscosity };
    let (ratio, effects) = (plan.drive_ratio.unwrap_or(1.0), &model.body_effects().forces);
    let on_pinion = effects.iter().find_map(|effect| effect.shaft_torque(&motion)).unwrap_or(out.drive_torque);
    (out.pinion_torque, out.port_torque) = (on_pinion / ratio, out.drive_torque / ratio);
    let driven = on_pinion - held - plan.on_carrier * out.carrier_acceleration;
    out.carrier_torque = effects.iter().fold(driven, |torque, effect| effect.carrier_torque(&motion, torque));
    let at = Instant {
        on: false,
        plan,
        motion: &motion,
        shaft_torque: out.shaft_torque,
        carrier_torque: out.carrier_torque,
        // the clutch drives its side gear forward against the friction of their slip
        clutch_torque: clutches.map(|torque| -torque),
    };
    scene_effects::read(&p.effects, &p.specs, &at, &mut out.readings);
    // without a computed flash temperature, flanks are as warm as their gears
    let strength = &mut out.readings[const { indices_of("strength", Changes::Always) }];
    strength[CONTACT_TEMPERATURE] = state.sums.thermal.temperatures()[GEARS];
}

/// Raises the readings of p·v to the largest value over each effect's surfaces. It is `inline(never)` to keep stack
/// frames small.
#[inline(never)]
fn read_pv<const N: usize>(out: &mut Forces, equations: &impl FrictionEquations<N>, at: &Point<N>) {
    equations.each_pv(at, |surface, _, pv| {
        if let Some(index) = indices_of(surface.effect, Changes::Always).next() {
            out.readings[index] = out.readings[index].max(pv);
        }
    });
}

/// Power turned into heat within the differential [W].
fn lost(heat: &[f64; HEATS]) -> f64 {
    heat.iter().zip(&ALL_HEATS).map(|(heat, of)| if of.warms == Warmed::Wheels { 0.0 } else { *heat }).sum()
}

/// Forces of the differential with teeth, to the requested `extent`.
pub fn teeth_forces(model: &Model, equations: &Largest, inputs: &Inputs, (state, extent): (&State, Extent)) -> Forces {
    let has_components = extent == Extent::Components;
    let (teeth, point, pair) = (equations.teeth, &state.point(), &model.pair);
    let plan = &teeth.plan;
    let ForcesAtInstant { acceleration: a, on_sides, drive_torque, spin_torque, ledger_rates } =
        equations.instant(point);
    let mut out = Forces {
        carrier_acceleration: a[CARRIER],
        side_acceleration: [a[0], a[1]],
        has_components,
        ..Forces::default()
    };
    (out.drive_torque, out.spin_torque) = (drive_torque, spin_torque);
    let brakes = equations.commanded_torques(RubbingKind::Wheel, point);
    for s in 0..2 {
        out.shaft_torque[s] = if plan.shafts[s] {
            equations.shaft_torque(point, s)
        } else {
            inputs.load_torque[s] + brakes[s] + teeth.rigid_end[s] * a[s]
        };
        out.side_tangential[s] = on_sides[s] / (0.5 * pair.outer_pitch_diameter(1));
    }
    let clutches = equations.commanded_torques(RubbingKind::Clutch, point);
    read_effects(&mut out, model, (inputs, state), (equations.pinion_friction(point), clutches));
    read_pv(&mut out, equations, point);
    add_powers(&mut out, plan, state, lost(&ledger_rates.heat));
    if extent == Extent::Bodies {
        return out;
    }
    let mut groups = [[MeshForces::default(); 2]; MAX_GROUPS];
    for (g, meshes) in groups[..plan.groups().len()].iter_mut().enumerate() {
        for (s, mesh) in meshes.iter_mut().enumerate() {
            mesh.transmission_error =
                teeth.contact.mesh.drive_approach(equations.mesh_state(point, g, s).position[0]) * pair.mean_cone;
            let add = &mut |load: &ToothLoad| mesh.add(load);
            if has_components {
                equations.tooth_loads(pair, point, g, s, add);
            } else {
                equations.loads_over_the_face(point, g, s, |load, _| add(load));
            }
        }
    }
    if let Some(strength) = &model.strength {
        read_stresses(&mut out, (model, strength), equations, state);
    }
    for i in 0..plan.planets {
        out.mesh[i] = groups[plan.group_of[i]];
    }
    add_up(&mut out, plan.planets);
    out
}

/// Reads stresses and flash temperatures of all teeth.
fn read_stresses(out: &mut Forces, (model, strength): (&Model, &GearStrength), equations: &Largest, state: &State) {
    let (point, groups) = (&state.point(), equations.teeth.plan.groups().len());
    let mut stress = [[MeshLoad::default(); 2]; MAX_GROUPS];
    let mut flash = 0.0f64;
    for (g, stress) in stress[..groups].iter_mut().enumerate() {
        equations.pair_loads(&model.pair, point, g, |s, load| {
            strength.add_load(&mut stress[s], load);
            strength.add_pressure(&mut stress[s], load);
        });
        for (s, stress) in stress.iter_mut().enumerate() {
            // damping is distributed over the face differently from the elastic load
            equations.loads_over_the_face(point, g, s, |load, line_load| {
                if let Some(line_load) = line_load {
                    strength.add_pressure_at_ends(stress, load, line_load);
                }
            });
            let Some(law) = equations.flank_friction() else { continue };
            // one slice represents its pair, because the whole face is searched
            let mut last = None;
            equations.slices(point, g, s, |slice| {
                if last.replace(slice.name) != Some(slice.name) {
                    flash = flash.max(strength.flash(&equations.teeth.contact.detailed, &law, slice));
                }
            });
        }
    }
    let readings = &mut out.readings[const { indices_of("strength", Changes::Always) }];
    strength.read_stresses(stress[..groups].iter().flatten().copied(), readings);
    strength.read_flash(flash, &state.sums.thermal.temperatures(), readings);
}

/// Accelerations and torques at an instant, from one evaluation.
struct ForcesAtInstant {
    /// Accelerations by degree of freedom [rad/s²; seats m/s²].
    acceleration: [f64; MAX_SIZE],
    /// Torques on the side gears from the meshes only [N·m].
    on_sides: [f64; 2],
    /// Torque of the drive, referred to the carrier [N·m].
    drive_torque: f64,
    /// Torque that imposes the spin, summed over all planets [N·m].
    spin_torque: f64,
    ledger_rates: LedgerRates,
}

impl Largest<'_> {
    fn instant(&self, at: &Point<MAX_SIZE>) -> ForcesAtInstant {
        let plan = &self.teeth.plan;
        let (mut sum, mut ledger_rates) = ([0.0; MAX_SIZE], LedgerRates::default());
        let on_sides = self.add_mesh_forces(at, &mut sum, &mut ledger_rates);
        self.act_on_bodies(at, &mut sum, &mut ledger_rates);
        let rates = &self.applied.input_derivatives.rates[0];
        let mut braked = sum;
        self.brake_pinion(at, &mut braked, &mut LedgerRates::default());
        let drive_torque = self.drive_under(&braked);
        let inertial = self.teeth.inertia[self.planet(0)] * rates.planet_spin;
        let spin_torque =
            if plan.spin_imposed { self.sum(|g| self.members(g) * (inertial - sum[self.planet(g)])) } else { 0.0 };
        self.finish(at, &mut sum, &mut ledger_rates);
        ForcesAtInstant { acceleration: sum, on_sides, drive_torque, spin_torque, ledger_rates }
    }
}

/// Computes the meshes of gears without teeth. The torque of a side gear is shared equally between its meshes and acts
/// at the pitch points.
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

/// Forces of gears without teeth, from torques and the accelerations of carrier and sides. `held` is the torque
/// with which dry friction holds the pinion back, and `clutches` are those with which clutches hold the side gears back
/// [N·m].
fn without_teeth(
    model: &Model,
    (inputs, state): (&Inputs, &State),
    (carrier_acceleration, side_acceleration): (f64, [f64; 2]),
    (torques, shaft_torque): (&IdealTorques, [f64; 2]),
    (held, clutches, heat): (f64, [f64; 2], f64),
) -> Forces {
    let plan = &model.ideal.plan;
    let (drive_torque, spin_torque) = (torques.drive, torques.spin);
    let mut out = Forces {
        carrier_acceleration,
        side_acceleration,
        drive_torque,
        spin_torque,
        shaft_torque,
        has_components: true,
        ..Forces::default()
    };
    read_effects(&mut out, model, (inputs, state), (held, clutches));
    pitch_point_meshes(&mut out, &model.pair, plan.planets, torques.gears);
    add_powers(&mut out, plan, state, heat);
    out
}

/// Forces of the ideal differential.
pub fn ideal_forces(model: &Model, inputs: &Inputs, state: &State) -> Forces {
    let (ideal, inertia) = (&model.ideal, &model.ideal.inertia);
    let motion = ideal.motion(inputs);
    let a = ideal.side_accelerations(&motion);
    let with = |inertia: &[f64; 2]| [0, 1].map(|s| inputs.load_torque[s] + inertia[s] * a[s]);
    let torques = IdealTorques { drive: motion.carrier_torque, spin: motion.spin_torque, gears: with(&inertia.side) };
    without_teeth(model, (inputs, state), (motion.carrier, a), (&torques, with(&inertia.end)), (0.0, [0.0; 2], 0.0))
}

/// Forces of the ideal differential with effects on bodies.
pub fn ideal_forces_with_effects(
    model: &Model,
    equations: &IdealEquations<IDEAL_SIZE>,
    inputs: &Inputs,
    state: &State,
) -> Forces {
    let (plan, point) = (&model.ideal.plan, &state.point());
    let (a, ledger_rates) = equations.evaluate(point);
    let brakes = equations.commanded_torques(RubbingKind::Wheel, point);
    let by_rigid = |s: usize| inputs.load_torque[s] + brakes[s] + equations.ideal.rigid_end[s] * a[s];
    let shafts = [0, 1].map(|s| if plan.shafts[s] { ledger_rates.shaft[s] } else { by_rigid(s) });
    let heat = lost(&ledger_rates.heat);
    let torques = equations.torques(point);
    let accelerations = (a[CARRIER], [a[0], a[1]]);
    let held = equations.pinion_friction(point);
    let clutches = equations.commanded_torques(RubbingKind::Clutch, point);
    let mut out = without_teeth(model, (inputs, state), accelerations, (&torques, shafts), (held, clutches, heat));
    read_pv(&mut out, equations, point);
    out
}

#[cfg(test)]
mod tests {
    use super::bias;

    #[test]
    fn a_bias_by_friction_is_the_same_in_drive_and_overrun_forward_and_backward_and_from_side_to_side() {
        // the wheels share 1000 N·m; friction moves 27.5 N·m from the wheel that is ahead to the other wheel
        for torque in [1000.0, -1000.0] {
            for carrier in [50.0, -50.0, 0.0] {
                for spin in [2.5, -2.5] {
                    let speed = [carrier + spin, carrier - spin];
                    let moved = 27.5 * f64::signum(spin);
                    let (ratio, locking) = bias([0.5 * torque - moved, 0.5 * torque + moved], speed);
                    assert!((locking - 0.055).abs() < 1e-15, "{locking}");
                    assert!(
                        (ratio - (1.0 + 0.055) / (1.0 - 0.055)).abs() < 1e-14,
                        "{torque} {carrier} {spin}: {ratio}"
                    );
                }
            }
        }
    }

    #[test]
    fn a_bias_against_friction_is_below_one_and_torques_of_opposite_signs_have_a_negative_one() {
        assert_eq!(bias([600.0, 400.0], [2.0, 1.0]).0, 400.0 / 600.0);
        assert_eq!(bias([-600.0, -400.0], [-2.0, -1.0]).0, 400.0 / 600.0);
        assert_eq!(bias([-100.0, 400.0], [2.0, 1.0]).0, -4.0);
        assert_eq!(bias([100.0, -400.0], [-2.0, -1.0]).0, -4.0);
    }

    #[test]
    fn sides_of_equal_speed_have_the_ratio_of_the_larger_to_the_smaller_torque() {
        for torque in [[900.0, 100.0], [100.0, 900.0], [-900.0, -100.0], [-100.0, -900.0]] {
            // the speeds of a locked differential differ by small vibrations
            for apart in [0.0, 1e-9, -1e-9] {
                assert_eq!(bias(torque, [3.0 + apart, 3.0]), (9.0, 0.8));
            }
        }
    }

    #[test]
    fn zero_torque_has_no_bias_and_a_side_without_torque_has_the_largest_bias() {
        assert_eq!(bias([0.0, 0.0], [1.0, 2.0]), (1.0, 0.0));
        for rounding in [1e-13, -1e-9, 9e-4] {
            assert_eq!(bias([-50.0, 50.0 + rounding], [22.0, 20.0]), (1.0, 0.0));
        }
        assert_eq!(bias([f64::NAN, 1.0], [1.0, 2.0]), (1.0, 0.0));
        assert_eq!(bias([-1e6, 1e6 + 0.002], [2.0, 1.0]).1, super::MOST_BIAS);
        assert_eq!(bias([0.0, 5.0], [2.0, 1.0]), (super::MOST_BIAS, 1.0));
        assert_eq!(bias([0.0, -5.0], [-2.0, -1.0]), (super::MOST_BIAS, 1.0));
    }
}
