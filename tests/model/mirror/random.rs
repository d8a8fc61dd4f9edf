//! Random scenes of all kinds: gears, laws, drives, starts, inputs with derivatives, and all effects.

use std::f64::consts::TAU;

use bevel_differential::contact::errors::FaultyGear;
use bevel_differential::contact::{ContactLaw, DampingModel};
use bevel_differential::friction::FrictionLaw;
use bevel_differential::geometry::AddendumSystem;
use bevel_differential::model::{
    CarrierDrive, DogSides, GearContact, InputDerivatives, Inputs, Method, Parameters, PlanetSpin, SideDrive, Start,
};
use bevel_differential::variables::{Access, named};

use fastrand::Rng;

use super::scene::{Scene, Step};
use crate::common::random::Draws;

/// Number of communication steps of a scene.
const STEPS: usize = 14;
/// Module for which loads and sizes are given [m]. They are scaled for other modules.
const MODULE: f64 = 4.5e-3;

/// Bit of the seed for the separate generator of [`later`].
const LATER: u64 = 1 << 40;
/// Bit of the seed for the separate generator of [`commanded`].
const COMMANDED: u64 = 1 << 43;
/// Bit of the seed for the separate generator of [`disconnected`].
const DISCONNECTED: u64 = 1 << 44;
/// Bit of the seed for the separate generator of [`rolling`].
const ROLLING: u64 = 1 << 41;
/// Bit of the seed for the separate generator of [`warm`].
pub const WARM: u64 = 1 << 42;

/// Scene number `index`, or `None` if it cannot be built.
pub fn scene(index: u64) -> Option<Scene> {
    let d = &mut Rng::with_seed(index);
    let mut p = Parameters::default();
    gears(d, &mut p);
    contact(d, &mut p);
    drives(d, &mut p);
    effects(d, &mut p);
    bodies(&mut Rng::with_seed(!index), &mut p);
    let commands = commanded(&mut Rng::with_seed(index ^ COMMANDED), &mut p);
    later(&mut Rng::with_seed(index ^ LATER), &mut p);
    solver(d, &mut p);
    let inputs = inputs(d, &p);
    let duration = d.between(3e-3, 8e-3);
    let mut steps = steps(d, &p, inputs, duration);
    let dogs = disconnected(&mut Rng::with_seed(index ^ DISCONNECTED), &mut p);
    let inputs = Inputs { clutch_command: commands[0], dog_command: dogs[0], ..inputs };
    for (k, step) in steps.iter_mut().enumerate() {
        (step.inputs.clutch_command, step.inputs.dog_command) = (commands[(k / 2).min(1)], dogs[(k / 2).min(2)]);
    }
    Scene::new(p, inputs, steps).ok()
}

fn gears(d: &mut Rng, p: &mut Parameters) {
    let g = &mut p.geometry;
    g.module = d.about(MODULE, 2.0);
    g.planet_teeth = d.whole(9, 15);
    g.side_teeth = g.planet_teeth + d.whole(2, 14);
    let fitting: Vec<i32> = (2..=4).filter(|n| 2 * g.side_teeth % n == 0).collect();
    g.planet_count = d.pick(&fitting);
    g.pressure_angle = d.between(0.31, 0.42);
    let ratio = f64::from(g.side_teeth) / f64::from(g.planet_teeth);
    let cone = 0.5 * g.module * f64::from(g.planet_teeth) * (1.0 + ratio * ratio).sqrt();
    g.face_width = cone * d.between(0.15, 0.33);
    g.backlash = g.module * d.between(0.0, 0.04);
    g.addendum_system = d.pick(&[
        AddendumSystem::Standard,
        AddendumSystem::Gleason,
        AddendumSystem::Iso23509,
        AddendumSystem::Explicit,
    ]);
    g.root_fillet = d.between(0.1, 0.4);
    p.effects.teeth.backlash = d.share(0.9);
    p.effects.teeth.corner_contact = d.share(0.9);
    let growth = (g.module / MODULE).powi(5);
    p.inertia.carrier = growth * d.about(0.02, 3.0);
    p.inertia.left_end = if d.share(0.2) { 0.0 } else { growth * d.about(0.1, 5.0) };
    p.inertia.right_end = if d.share(0.2) { 0.0 } else { growth * d.about(0.1, 5.0) };
}

fn contact(d: &mut Rng, p: &mut Parameters) {
    let c = &mut p.contact;
    c.law = d.pick(&[ContactLaw::Impact, ContactLaw::Line, ContactLaw::LineWeber]);
    c.stiffness_from_hertz = d.share(0.5);
    c.stiffness *= d.between(0.3, 2.0);
    c.damping *= d.between(0.2, 2.0);
    c.damping_model = d.pick(&[DampingModel::Step, DampingModel::Restitution]);
    c.restitution = d.between(0.3, 0.95);
    c.mesh_stiffness_from_geometry = d.share(0.5);
    p.scene.gear_contact = match d.f64() {
        u if u < 0.08 => GearContact::Ideal,
        u if u < 0.2 => GearContact::Lumped,
        u if u < 0.26 => GearContact::Solid,
        _ => GearContact::Tooth,
    };
    p.solid.facets = d.whole(8, 16);
    if p.scene.gear_contact == GearContact::Solid {
        c.law = ContactLaw::Impact;
    }
}

fn drives(d: &mut Rng, p: &mut Parameters) {
    let s = &mut p.scene;
    let (speed, torque) = (SideDrive::Speed, SideDrive::Torque);
    let (imposed, left, right, spin) = d.pick(&[
        (true, torque, torque, PlanetSpin::Free),
        (true, torque, torque, PlanetSpin::Imposed),
        (false, torque, torque, PlanetSpin::Free),
        (false, speed, torque, PlanetSpin::Free),
        (true, torque, speed, PlanetSpin::Free),
        (false, speed, speed, PlanetSpin::Free),
        (false, torque, torque, PlanetSpin::Imposed),
    ]);
    s.carrier_drive = if imposed { CarrierDrive::Speed } else { CarrierDrive::Torque };
    (s.left_drive, s.right_drive, s.planet_spin) = (left, right, spin);
    s.start = d.pick(&[Start::Equilibrium, Start::Equilibrium, Start::Rolling, Start::Rest]);
}

fn effects(d: &mut Rng, p: &mut Parameters) {
    let contact = p.scene.gear_contact;
    let [tooth, elastic] = [contact == GearContact::Tooth, matches!(contact, GearContact::Tooth | GearContact::Lumped)];
    let m = p.geometry.module;
    let (e, s) = (&mut p.effects, &mut p.specs);
    e.tooth_errors = (tooth || contact == GearContact::Solid) && d.share(0.4);
    let t = &mut s.tooth_errors;
    t.seed = d.whole(0, 1000);
    if tooth {
        t.accuracy_grade = if d.share(0.6) { d.whole(4, 10) } else { 0 };
        t.runout_by_grade = t.accuracy_grade > 0 && d.share(0.5);
        (t.planet_runout, t.side_runout) = (m * d.between(0.0, 0.01), m * d.between(0.0, 0.01));
        (t.planet_tip_relief, t.side_tip_relief) = (m * d.between(0.0, 0.01), m * d.between(0.0, 0.01));
    }
    t.crowning = if d.share(0.5) { m * d.between(0.0, 0.01) } else { 0.0 };
    t.shaft_angle_error = if d.share(0.5) { d.between(-1e-3, 1e-3) } else { 0.0 };
    t.planet_axial_offset = if d.share(0.3) { m * d.between(-0.01, 0.01) } else { 0.0 };
    t.side_axial_offset = if d.share(0.3) { m * d.between(-0.01, 0.01) } else { 0.0 };
    t.axis_offset = if d.share(0.3) { m * d.between(-0.01, 0.01) } else { 0.0 };
    e.tooth_fault = tooth && d.share(0.25);
    let f = &mut s.tooth_fault;
    (f.gear, f.missing_fraction) = (d.pick(&[FaultyGear::Planet, FaultyGear::Side]), d.between(0.55, 1.0));
    // teeth that are in mesh at the start or soon after
    f.index = d.whole(0, 1);
    let teeth = if f.gear == FaultyGear::Planet { p.geometry.planet_teeth } else { p.geometry.side_teeth };
    f.tooth = d.whole(-2, 2).rem_euclid(teeth);
    f.at_onset = d.share(0.5);
    f.onset = if f.at_onset { d.between(0.0, 6e-3) } else { 0.0 };
    e.tooth_friction = tooth && d.share(0.3);
    s.tooth_friction.law = d.pick(&[
        FrictionLaw::CoulombStribeck,
        FrictionLaw::BenedictKelley,
        FrictionLaw::Iso14179,
        FrictionLaw::XuKahraman,
    ]);
    e.thrust_friction = elastic && d.share(0.3);
    s.thrust_friction.radii_from_geometry = true;
    s.thrust_friction.coefficient = d.between(0.0, 0.15);
    s.thrust_friction.pin_coefficient = d.between(0.0, 0.15);
    e.limited_slip = d.share(0.25);
    s.limited_slip.preload = d.between(0.0, 100.0);
    s.limited_slip.torque_coefficient = if contact == GearContact::Ideal { 0.0 } else { d.between(0.0, 0.3) };
    s.limited_slip.sliding.static_ratio = d.between(1.0, 1.5);
    e.half_shaft = d.share(0.4);
    s.half_shaft.stiffness = [d.about(1e4, 4.0), d.about(1e4, 4.0)];
    s.half_shaft.damping = [d.between(0.0, 10.0), d.between(0.0, 10.0)];
    e.pin_compliance = elastic && d.share(0.25);
    s.pin_compliance.damping_time = d.between(0.0, 1e-4);
    e.bearing_drag = d.share(0.3);
    e.final_drive = d.share(0.2);
    s.final_drive.ring_teeth = d.whole(20, 60);
    e.strength = contact != GearContact::Ideal && d.share(0.4);
    // so weak that damage is visible after a short time
    s.strength.bending_cycles = 1e5;
    s.strength.bending_strength = d.about(3e8, 2.0);
    s.strength.contact_strength = d.about(5e8, 2.0);
    e.wheel_brake = d.share(0.3);
}

/// Gear bodies, drawn with a separate generator.
fn bodies(d: &mut Rng, p: &mut Parameters) {
    let m = p.geometry.module;
    p.effects.body_compliance =
        p.scene.gear_contact == GearContact::Tooth && p.contact.law != ContactLaw::Impact && d.share(0.5);
    p.geometry.planet_bore = if d.share(0.5) { m * d.between(0.5, 3.0) } else { 0.0 };
    p.geometry.side_bore = if d.share(0.5) { m * d.between(0.5, 5.0) } else { 0.0 };
}

/// Effects that were added later, drawn with a separate generator, so that all other values of the scenes are
/// unchanged.
fn later(d: &mut Rng, p: &mut Parameters) {
    p.effects.mesh_history = p.scene.gear_contact != GearContact::Ideal && d.share(0.5);
    clutches(d, p);
    final_drive(d, p);
}

/// Sets clutches on command and the thrust of the gears on their packs, drawn with a separate generator. Returns the
/// first commands and the later ones.
fn commanded(d: &mut Rng, p: &mut Parameters) -> [[f64; 2]; 2] {
    p.effects.clutches = d.share(0.25);
    let clutches = &mut p.specs.clutches;
    clutches.torque = d.about(200.0, 3.0) * (p.geometry.module / MODULE).powi(3);
    clutches.ratio = d.pick(&[[1.0, 1.0], [1.125, 0.875], [0.0, 1.0], [1.2, 1.1], [-0.5, 2.0]]);
    clutches.damping_time = d.pick(&[0.0, 1e-5, 1e-4]);
    // a stop is found within 1e-6 rad/s, and a steep fall of the friction with speed would magnify this
    (clutches.sliding.static_ratio, clutches.sliding.stribeck_speed) = (d.between(1.0, 1.4), d.between(0.1, 0.3));
    (clutches.sliding.pv_limit, clutches.sliding.beyond_limit) = (d.about(3e4, 10.0), d.between(0.5, 1.5));
    let has_thrust = matches!(p.scene.gear_contact, GearContact::Lumped | GearContact::Tooth);
    // a pack breaks loose within 1e-5 of its limit, which accelerates a light side gear
    p.specs.limited_slip.thrust_arm = if has_thrust && d.share(0.3) { d.between(2e-4, 2e-3) } else { 0.0 };
    let mut command = || [d.f64(), d.f64()].map(|u| if u < 0.3 { 0.0 } else { u });
    [command(), command()]
}

/// Sets the actuators of clutches and lock, and dog clutches at wheels that turn apart from their side gears, drawn with a
/// separate generator. Returns three commands of the dog clutches: the first two act for two steps each.
fn disconnected(d: &mut Rng, p: &mut Parameters) -> [[f64; 2]; 3] {
    for actuator in [&mut p.specs.clutches.actuator, &mut p.specs.lock.actuator] {
        actuator.dead_band = if d.share(0.5) { d.between(0.0, 0.2) } else { 0.0 };
        actuator.stroke_time = if d.share(0.5) { d.about(5e-3, 3.0) } else { 0.0 };
        actuator.response_time = if d.share(0.5) { d.about(1e-3, 3.0) } else { 0.0 };
        actuator.response_damping = d.between(0.3, 2.0);
    }
    let dog = &mut p.specs.disconnect;
    // teeth so fine that some pass within milliseconds
    dog.teeth = d.whole(60, 300);
    dog.lash = d.between(0.1, 0.4) * TAU / f64::from(dog.teeth);
    (dog.most_speed, dog.most_torque) = (d.about(30.0, 10.0), d.about(50.0, 5.0));
    dog.ratchet_torque = d.between(0.0, 5.0);
    let drives = [p.scene.left_drive, p.scene.right_drive];
    let turns = |s: usize, inertia: f64| drives[s] == SideDrive::Speed || p.effects.half_shaft && inertia > 0.0;
    let sides = match [turns(0, p.inertia.left_end), turns(1, p.inertia.right_end)] {
        [true, true] => Some(d.pick(&[DogSides::Left, DogSides::Right, DogSides::Both])),
        [true, false] => Some(DogSides::Left),
        [false, true] => Some(DogSides::Right),
        [false, false] => None,
    };
    p.effects.disconnect = sides.is_some() && d.share(0.4);
    p.specs.disconnect.sides = sides.unwrap_or(DogSides::Both);
    let mut command = || [d.f64(), d.f64()].map(f64::round);
    [command(), command(), command()]
}

/// Sets mesh, error, losses and shaft of the final drive.
fn final_drive(d: &mut Rng, p: &mut Parameters) {
    let drive = &mut p.specs.final_drive;
    drive.pinion_teeth = d.whole(7, 14);
    drive.elastic_mesh = d.share(0.6);
    (drive.stiffness, drive.damping) = (d.about(1e8, 3.0), d.about(3e3, 3.0));
    (drive.backlash, drive.mean_radius) = (d.between(0.0, 2e-4), d.between(0.07, 0.12));
    (drive.error_1, drive.error_2) = (d.between(0.0, 1e-5), d.between(0.0, 5e-6));
    (drive.error_phase_1, drive.error_phase_2) = (d.between(-3.0, 3.0), d.between(-3.0, 3.0));
    (drive.pinion_runout, drive.ring_runout) = (d.between(0.0, 1e-5), d.between(0.0, 1e-5));
    (drive.pinion_runout_phase, drive.ring_runout_phase) = (d.between(-3.0, 3.0), d.between(-3.0, 3.0));
    drive.friction_torque = if d.share(0.5) { d.between(0.0, 3.0) } else { 0.0 };
    drive.drive_loss = if d.share(0.5) { d.between(0.0, 0.1) } else { 0.0 };
    drive.coast_loss = d.between(0.0, 0.1);
    drive.viscous = d.between(0.0, 0.02);
    (drive.drive_pressure_angle, drive.coast_pressure_angle) = (d.between(0.2, 0.4), d.between(0.2, 0.4));
    (drive.spiral_angle, drive.azimuth) = (d.between(0.0, 0.7), d.between(-3.0, 3.0));
    p.effects.propeller_shaft = p.effects.final_drive && d.share(0.5);
    p.specs.propeller_shaft.joint_angle = if d.share(0.5) { d.between(0.0, 0.4) } else { 0.0 };
}

/// Sets ramps, sheared oil and measured torques of clutches. Powers of two as coast ratios make the product with the
/// torque coefficient exact, which the reversed image needs.
fn clutches(d: &mut Rng, p: &mut Parameters) {
    if let Some(Access::Enumeration(literals, _, set)) = named("limited_slip.pressed_by").map(|row| row.access) {
        set(p, d.pick(&(1..=literals.choices.len() as i32).collect::<Vec<_>>()));
    }
    let clutch = &mut p.specs.limited_slip;
    clutch.coast_ratio = d.pick(&[0.25, 0.5, 1.0, 2.0]);
    clutch.viscous_torque = if d.share(0.3) { d.about(30.0, 3.0) } else { 0.0 };
    clutch.viscous_speed = d.about(10.0, 3.0);
    clutch.viscous_exponent = d.between(0.3, 2.0);
    let (points, mut slip) = (if d.share(0.4) { d.below(clutch.curve.len()) + 1 } else { 0 }, 0.0);
    for (i, point) in clutch.curve.iter_mut().take(points).enumerate() {
        // half of the curves have a breakaway torque
        slip += if i == 0 && d.share(0.5) { 0.0 } else { d.about(3.0, 3.0) };
        (point.slip, point.torque) = (slip, d.about(40.0, 2.0));
    }
    p.specs.lock.damping_time = d.pick(&[0.0, 1e-4, 1e-3]);
}

/// Sets small nodes, which warm up quickly, and friction that depends on speed, temperature and p·v.
pub fn warm(d: &mut Rng, p: &mut Parameters) {
    p.effects.warm_up = d.share(0.3);
    let s = &mut p.specs;
    (s.warm_up.clutch_capacity, s.warm_up.washer_capacity) = (d.about(3.0, 3.0), d.about(1.0, 3.0));
    for sliding in [&mut s.limited_slip.sliding, &mut s.thrust_friction.sliding, &mut s.wheel_brake.sliding] {
        (sliding.stribeck_speed, sliding.slip_slope) = (d.between(0.0, 0.2), d.between(-0.02, 0.02));
        (sliding.cold_factor, sliding.hot_factor) = (d.between(0.8, 1.3), d.between(0.5, 1.1));
    }
    (s.thrust_friction.sliding.static_ratio, s.wheel_brake.sliding.static_ratio) =
        (d.between(1.0, 1.5), d.between(1.0, 1.5));
    s.bearing_drag.viscosity_from_oil = d.share(0.5);
    s.tooth_friction.viscosity_from_oil = d.share(0.5);
    (p.oil.temperature, s.wheel_brake.temperature) = (d.between(250.0, 400.0), d.between(250.0, 600.0));
    let warm_up = &mut s.warm_up;
    for above in [
        &mut warm_up.gears_above_oil,
        &mut warm_up.clutch_above_oil,
        &mut warm_up.washers_above_oil,
        &mut warm_up.case_above_oil,
    ] {
        *above = d.between(-20.0, 20.0);
    }
    warm_up.cycle = d.between(2e-3, 1e-2);
    // cycles of fixed steps would take a minute
    if p.effects.warm_up && d.share(0.2) && p.solver.method != Method::FixedStep {
        p.scene.start = Start::SteadyHeat;
    }
    let drag = &mut s.bearing_drag;
    (drag.carrier_torque, drag.carrier_viscous, drag.carrier_churning) = (0.5, 5e-3, 1e-4);
    (drag.side_torque, drag.side_viscous) = (0.2, 1e-3);
    drag.churning_from_geometry = d.share(0.5);
    drag.oil_level = if d.share(0.8) { d.f64() } else { 0.0 };
    drag.seal_diameter = if d.share(0.5) { d.between(0.01, 0.05) } else { 0.0 };
    drag.bearing_load = if d.share(0.5) { d.between(0.0, 1e4) } else { 0.0 };
    let s = &mut p.specs;
    for (sliding, middle) in
        [(&mut s.limited_slip.sliding, 1e5), (&mut s.thrust_friction.sliding, 1e5), (&mut s.wheel_brake.sliding, 1e6)]
    {
        sliding.pv_limit = if d.share(0.5) { d.about(middle, 30.0) } else { 0.0 };
        sliding.beyond_limit = d.between(0.5, 1.5);
    }
}

/// Scene number `index` with planets that roll over some teeth.
pub fn rolling(index: u64) -> Option<Scene> {
    let d = &mut Rng::with_seed(index ^ ROLLING);
    let Scene { parameters: mut p, mut inputs, mut steps, .. } = scene(index)?;
    if p.scene.gear_contact == GearContact::Ideal {
        return None;
    }
    p.effects.mesh_history = true;
    warm(&mut Rng::with_seed(index ^ WARM), &mut p);
    p.scene.carrier_drive = CarrierDrive::Speed;
    (p.scene.left_drive, p.scene.right_drive) = (SideDrive::Torque, SideDrive::Torque);
    p.scene.planet_spin = PlanetSpin::Imposed;
    let spin = d.between(200.0, 300.0) * if d.share(0.5) { 1.0 } else { -1.0 };
    inputs.planet_spin = spin;
    for step in &mut steps {
        step.inputs.planet_spin = spin;
        if let Some(derivatives) = &mut step.derivatives {
            derivatives.rates.iter_mut().for_each(|rates| rates.planet_spin = 0.0);
        }
    }
    Scene::new(p, inputs, steps).ok()
}

fn solver(d: &mut Rng, p: &mut Parameters) {
    p.solver.method = d.pick(&[
        Method::Adaptive,
        Method::Adaptive,
        Method::Adaptive,
        Method::Adaptive,
        Method::Adaptive,
        Method::FixedStep,
        Method::Radau,
        // the number of entries is fixed, because the seeds were chosen for it
        Method::Adaptive,
    ]);
    p.solver.relative_tolerance = 10f64.powf(d.between(-6.5, -4.5));
    p.solver.fixed_step = 2e-5;
    p.solver.merge_planets = d.share(0.8);
}

fn inputs(d: &mut Rng, p: &Parameters) -> Inputs {
    let load = 800.0 * (p.geometry.module / MODULE).powi(3);
    let mut i = Inputs::ZERO;
    i.carrier_speed = d.between(-120.0, 120.0);
    i.planet_spin = d.between(-60.0, 60.0);
    i.carrier_torque = 2.0 * load * d.between(-1.0, 1.0);
    let common = load * d.between(-1.0, 1.0);
    let difference = if d.share(0.5) { 0.0 } else { 0.2 * load * d.between(-1.0, 1.0) };
    i.load_torque = if d.share(0.15) { [0.0; 2] } else { [common + difference, common - difference] };
    i.side_speed = [i.carrier_speed + d.between(-10.0, 10.0), i.carrier_speed + d.between(-10.0, 10.0)];
    (i.pinion_speed, i.pinion_torque) = (4.0 * i.carrier_speed, 0.25 * i.carrier_torque);
    i.brake_torque = if d.share(0.5) { [0.0; 2] } else { [load * d.f64(), 0.5 * load * d.f64()] };
    i.lock = if d.share(0.15) { d.f64() } else { 0.0 };
    // without separate draws, so that all other values are unchanged
    (i.ambient_change, i.sump_change) = (i.side_speed[0] / 6.0, i.planet_spin / 3.0);
    i
}

/// Irregular steps. At some of them, inputs jump or start to change with time.
fn steps(d: &mut Rng, p: &Parameters, mut inputs: Inputs, duration: f64) -> Vec<Step> {
    let sizes: Vec<f64> = (0..STEPS).map(|_| d.between(0.2, 1.0)).collect();
    let whole: f64 = sizes.iter().sum();
    let mut steps = Vec::new();
    for size in sizes {
        let size = duration * size / whole;
        if d.share(0.1) {
            inputs.load_torque[d.whole(0, 1) as usize] *= d.between(-0.5, 1.5);
        }
        if d.share(0.1) {
            let factor = d.between(-1.0, 1.0);
            inputs.carrier_torque *= factor;
            inputs.pinion_torque *= factor;
        }
        if d.share(0.05) {
            inputs.brake_torque = [inputs.brake_torque[1], 0.0];
        }
        if d.share(0.05) {
            inputs.lock = if inputs.lock > 0.0 { 0.0 } else { 1.0 };
        }
        if p.effects.tooth_fault && d.share(0.1) {
            inputs.fault = 1.0;
        }
        let derivatives = d.share(0.15).then(|| {
            let mut rate = Inputs::ZERO;
            rate.load_torque = [inputs.load_torque[0] * d.between(-50.0, 50.0), 0.0];
            rate.carrier_torque = inputs.carrier_torque * d.between(-50.0, 50.0);
            rate.carrier_speed = inputs.carrier_speed * d.between(-5.0, 5.0);
            (rate.pinion_torque, rate.pinion_speed) = (0.25 * rate.carrier_torque, 4.0 * rate.carrier_speed);
            rate.planet_spin = inputs.planet_spin * d.between(-5.0, 5.0);
            rate.brake_torque = [0.0, inputs.brake_torque[1] * d.between(-50.0, 50.0)];
            InputDerivatives { rates: [rate, Inputs::ZERO.plus(-40.0, &rate)] }
        });
        steps.push(Step { size, inputs, derivatives });
        if let Some(derivatives) = derivatives {
            // the next step starts with the inputs at the end of this one
            inputs = derivatives.after(size, &inputs).0;
        }
    }
    steps
}
