//! The Jacobian of the assembled equations of motion, compared with differences of their rates, for every effect of the
//! teeth. No other test checks the sums over the meshes of all planets, because a wrong Jacobian only makes steps
//! shorter.

use bevel_differential::contact::ContactLaw;
use bevel_differential::model::{
    CarrierDrive, DogSides, GearContact, Inputs, Parameters, PlanetSpin, Simulation, Start,
};
use bevel_differential::variables::{Access, named};

/// Central differences of order 4: positions and weights.
const STENCIL: [(f64, f64); 4] = [(-2.0, 1.0 / 12.0), (-1.0, -8.0 / 12.0), (1.0, 8.0 / 12.0), (2.0, -1.0 / 12.0)];
/// Steps of a difference [rad, rad/s]: a thousandth of a deflection for angles, and a millionth of their values for
/// speeds.
const STEP: [f64; 2] = [3e-8, 3e-5];
/// Allowed error of a difference, relative to the largest derivative of its block. It results from the fourth power of
/// step over deflection, and from the rounding of forces over the step.
const WITHIN: f64 = 1e-6;

/// Turn under unequal loads, so that no two meshes are identical, changed by `change`.
fn turn(change: impl Fn(&mut Parameters)) -> (Parameters, Inputs) {
    let (mut p, mut inputs) = (Parameters::default(), Inputs::default());
    (inputs.carrier_speed, inputs.planet_spin) = (954f64.to_radians(), 200f64.to_radians());
    inputs.load_torque = [800.0, 760.0];
    (inputs.carrier_torque, p.scene.carrier_drive) = (1560.0, CarrierDrive::Torque);
    (inputs.pinion_torque, inputs.pinion_speed) = (380.0, 4.1 * inputs.carrier_speed);
    (p.inertia.left_end, p.inertia.right_end, p.scene.start) = (0.3, 0.4, Start::Equilibrium);
    (p.geometry.planet_bore, p.geometry.side_bore) = (16e-3, 30e-3);
    let (drag, clutches) = (&mut p.specs.bearing_drag, &mut p.specs.limited_slip);
    (drag.carrier_torque, drag.carrier_viscous, drag.carrier_churning) = (0.5, 5e-3, 1e-4);
    (drag.side_torque, drag.side_viscous) = (0.2, 1e-3);
    (clutches.preload, clutches.torque_coefficient) = (50.0, 0.1);
    change(&mut p);
    (p, inputs)
}

/// Scene with sliding brakes.
fn braked((p, mut inputs): (Parameters, Inputs)) -> (Parameters, Inputs) {
    inputs.brake_torque = [40.0, 60.0];
    (p, inputs)
}

/// Scene whose loads and carrier torque act in the other direction.
fn backward((p, mut inputs): (Parameters, Inputs)) -> (Parameters, Inputs) {
    inputs.carrier_torque *= -1.0;
    inputs.pinion_torque *= -1.0;
    inputs.load_torque = inputs.load_torque.map(|torque| -torque);
    (p, inputs)
}

/// Friction that decreases or increases with the sliding speed, on washers, pins, plates and linings.
fn by_speed(p: &mut Parameters) {
    (p.effects.thrust_friction, p.effects.limited_slip, p.effects.wheel_brake) = (true, true, true);
    let specs = &mut p.specs;
    (specs.thrust_friction.sliding.static_ratio, specs.limited_slip.sliding.static_ratio) = (1.6, 1.3);
    for (sliding, speed, slope) in [
        (&mut specs.thrust_friction.sliding, 0.05, -0.8),
        (&mut specs.limited_slip.sliding, 0.2, 0.3),
        (&mut specs.wheel_brake.sliding, 0.0, -0.05),
    ] {
        (sliding.stribeck_speed, sliding.slip_slope) = (speed, slope);
    }
}

/// Clutch packs with ramps, pressed by the meshes of `side` as numbered by `limited_slip.pressed_by`.
fn ramps(p: &mut Parameters, pressed_by: i32) {
    let Access::Enumeration(_, _, set) = named("limited_slip.pressed_by").unwrap().access else { panic!("no choice") };
    set(p, pressed_by);
    (p.effects.limited_slip, p.specs.limited_slip.coast_ratio) = (true, 0.25);
}

/// Torques of clutch packs over slip: of sheared oil, and of a measured curve that starts at `breakaway` [N·m].
fn slip_torques(p: &mut Parameters, breakaway: f64) {
    let clutch = &mut p.specs.limited_slip;
    (p.effects.limited_slip, clutch.preload, clutch.torque_coefficient) = (true, 0.0, 0.0);
    (clutch.viscous_torque, clutch.viscous_speed, clutch.viscous_exponent) = (40.0, 3.0, 0.6);
    let points = [(0.0, breakaway), (0.5, 45.0), (2.0, 60.0), (8.0, 50.0)];
    let given = points.into_iter().filter(|&(slip, torque)| slip > 0.0 || torque > 0.0);
    for (point, (slip, torque)) in clutch.curve.iter_mut().zip(given) {
        (point.slip, point.torque) = (slip, torque);
    }
}

/// Clutches on command, whose shafts turn faster and slower than the carrier, by `more`.
fn clutches((mut p, mut inputs): (Parameters, Inputs), more: f64) -> (Parameters, Inputs) {
    p.effects.clutches = true;
    (p.specs.clutches.ratio, p.specs.clutches.torque) = ([1.0 + more, 1.0 - more], 200.0);
    let sliding = &mut p.specs.clutches.sliding;
    (sliding.static_ratio, sliding.stribeck_speed, sliding.slip_slope) = (1.2, 0.3, -0.01);
    inputs.clutch_command = [0.3, 0.6];
    (p, inputs)
}

/// Dog clutches on both sides, under these commands.
fn disconnected((mut p, mut inputs): (Parameters, Inputs), commands: [f64; 2]) -> (Parameters, Inputs) {
    p.effects.disconnect = true;
    p.specs.disconnect.sides = DogSides::Both;
    (p.inertia.left_end, p.inertia.right_end) = (0.5, 0.7);
    inputs.dog_command = commands;
    (p, inputs)
}

/// Final drive with all its losses, and with an error of its mesh if this is elastic.
fn final_drive(p: &mut Parameters, elastic: bool) {
    let drive = &mut p.specs.final_drive;
    (p.effects.final_drive, drive.elastic_mesh) = (true, elastic);
    (drive.error_1, drive.error_2, drive.ring_runout, drive.pinion_runout) = (6e-6, 3e-6, 8e-6, 4e-6);
    (drive.friction_torque, drive.drive_loss, drive.coast_loss, drive.viscous) = (2.0, 0.05, 0.08, 0.01);
}

/// Propeller shaft with a joint.
fn propeller(p: &mut Parameters) {
    (p.effects.propeller_shaft, p.specs.propeller_shaft.joint_angle) = (true, 0.3);
}

fn scenes() -> Vec<(&'static str, (Parameters, Inputs))> {
    let line = |p: &mut Parameters| p.contact.law = ContactLaw::Line;
    let bodies = |p: &mut Parameters| (p.contact.law, p.effects.body_compliance) = (ContactLaw::LineWeber, true);
    let errors = |p: &mut Parameters| {
        p.effects.tooth_errors = true;
        (p.specs.tooth_errors.accuracy_grade, p.specs.tooth_errors.crowning) = (7, 5e-6);
    };
    let friction = |p: &mut Parameters| (p.effects.tooth_friction, p.effects.thrust_friction) = (true, true);
    let pins = |p: &mut Parameters| p.effects.pin_compliance = true;
    // a large carrier in cold oil
    let dragged = |p: &mut Parameters| {
        (p.effects.bearing_drag, p.oil.temperature) = (true, 263.15);
        let drag = &mut p.specs.bearing_drag;
        (drag.churning_from_geometry, drag.viscosity_from_oil, drag.carrier_diameter) = (true, true, 0.4);
        (drag.seal_diameter, drag.bearing_load, drag.breakaway_speed) = (0.04, 2e4, 30.0);
    };
    vec![
        ("plain", turn(|_| {})),
        ("lumped", turn(|p| p.scene.gear_contact = GearContact::Lumped)),
        ("line", turn(line)),
        ("imposed spin", turn(|p| p.scene.planet_spin = PlanetSpin::Imposed)),
        ("errors", turn(|p| (line(p), errors(p)).0)),
        ("friction", turn(|p| (line(p), friction(p)).0)),
        ("pins", turn(|p| (line(p), pins(p)).0)),
        ("by speed", braked(turn(by_speed))),
        ("by speed, bodies, pins", braked(turn(|p| (bodies(p), by_speed(p), pins(p)).0))),
        ("bodies", turn(bodies)),
        ("bodies, errors", turn(|p| (bodies(p), errors(p)).0)),
        ("bodies, friction", turn(|p| (bodies(p), friction(p)).0)),
        ("bodies, pins", turn(|p| (bodies(p), pins(p)).0)),
        ("bodies, errors, friction, pins", turn(|p| (bodies(p), errors(p), friction(p), pins(p)).0)),
        ("shafts and drag", turn(|p| (p.effects.half_shaft, p.effects.bearing_drag) = (true, true))),
        ("drag by size and load", turn(dragged)),
        ("final drive", turn(|p| final_drive(p, false))),
        ("elastic final drive", turn(|p| final_drive(p, true))),
        ("elastic final drive in coast", backward(turn(|p| final_drive(p, true)))),
        ("final drive, shafts", turn(|p| (final_drive(p, false), propeller(p), p.effects.half_shaft = true).0)),
        (
            "elastic final drive, shafts, lumped",
            turn(|p| {
                final_drive(p, true);
                propeller(p);
                p.effects.half_shaft = true;
                p.scene.gear_contact = GearContact::Lumped;
            }),
        ),
        (
            "final drive, ideal",
            turn(|p| (final_drive(p, false), p.effects.half_shaft = true, p.scene.gear_contact = GearContact::Ideal).0),
        ),
        (
            "elastic final drive, ideal",
            backward(turn(|p| (final_drive(p, true), propeller(p), p.scene.gear_contact = GearContact::Ideal).0)),
        ),
        (
            "final drive, propeller shaft, ideal",
            turn(|p| (final_drive(p, false), propeller(p), p.scene.gear_contact = GearContact::Ideal).0),
        ),
        ("clutches", clutches(turn(|_| {}), 0.125)),
        ("clutch and brake", clutches(turn(|p| p.effects.half_shaft = true), 1.0)),
        (
            "clutches, ideal",
            clutches(turn(|p| (p.effects.half_shaft, p.scene.gear_contact) = (true, GearContact::Ideal)), 0.3),
        ),
        ("clutches that hold", clutches(turn(|p| (by_speed(p), p.specs.clutches.torque = 1e4).0), 0.0)),
        ("dog clutches", disconnected(turn(|p| p.effects.half_shaft = true), [1.0, 0.0])),
        (
            "dog clutches, ideal",
            disconnected(turn(|p| (p.effects.half_shaft, p.scene.gear_contact) = (true, GearContact::Ideal)), [1.0; 2]),
        ),
        ("gears press the packs", turn(|p| (by_speed(p), p.specs.limited_slip.thrust_arm = 5e-3).0)),
        ("ramps", turn(|p| (ramps(p, 1), p.scene.gear_contact = GearContact::Lumped).0)),
        ("ramps of both sides", turn(|p| ramps(p, 2))),
        ("ramps in coast", backward(turn(|p| ramps(p, 2)))),
        ("torque over slip", turn(|p| slip_torques(p, 0.0))),
        ("torque over slip with breakaway", turn(|p| slip_torques(p, 30.0))),
    ]
}

/// Derivatives of the rates with respect to coordinate `k` of positions and velocities, by differences.
fn difference(simulation: &Simulation, at: &[Vec<f64>; 2], k: usize) -> Vec<f64> {
    let n = at[0].len();
    let (kind, place) = (k / n, k % n);
    let mut slope = vec![0.0; 2 * n];
    for (position, weight) in STENCIL {
        let mut moved = at.clone();
        moved[kind][place] += position * STEP[kind];
        let mut rates = [vec![0.0; n], vec![0.0; n]];
        let [dq, dv] = &mut rates;
        simulation.rates(&moved[0], &moved[1], [dq, dv]);
        slope.iter_mut().zip(rates.concat()).for_each(|(sum, rate)| *sum += weight * rate / STEP[kind]);
    }
    slope
}

#[test]
fn the_jacobian_of_every_scene_equals_differences_of_its_rates() {
    for (name, (parameters, inputs)) in scenes() {
        let mut simulation = Simulation::start(&parameters, &inputs, 0.0).expect(name);
        for stop in [1e-3, 4e-3, 9e-3] {
            simulation.advance(stop).expect(name);
            compare(&simulation, (name, stop));
        }
    }
}

/// Largest p·v of washers and pins, of clutch packs and of linings [W/m²].
fn largest_pv(simulation: &mut Simulation) -> [f64; 3] {
    ["pv.washers", "pv.clutch", "pv.brake"].map(|name| {
        let Access::Output(of) = named(name).unwrap().access else { panic!("{name} is not an output") };
        of.read(simulation)
    })
}

#[test]
fn the_jacobian_of_frictions_within_and_beyond_the_band_of_their_limit_equals_differences() {
    for (name, pins) in [("limits", false), ("limits, pins", true)] {
        let (mut parameters, mut inputs) = braked(turn(|p| (by_speed(p), p.effects.pin_compliance = pins).0));
        // loads so unequal that washers and plates slide with increasing speed
        inputs.load_torque = [1400.0, 160.0];
        let mut reached = |limits: [f64; 3], stop: f64| {
            let specs = &mut parameters.specs;
            (specs.thrust_friction.sliding.pv_limit, specs.thrust_friction.sliding.beyond_limit) = (limits[0], 0.98);
            (specs.limited_slip.sliding.pv_limit, specs.limited_slip.sliding.beyond_limit) = (limits[1], 0.98);
            (specs.wheel_brake.sliding.pv_limit, specs.wheel_brake.sliding.beyond_limit) = (limits[2], 0.98);
            let mut simulation = Simulation::start(&parameters, &inputs, 0.0).expect(name);
            simulation.advance(stop).expect(name);
            simulation
        };
        for stop in [2e-3, 6e-3] {
            let pv = largest_pv(&mut reached([0.0; 3], stop));
            assert!(pv.iter().all(|pv| *pv > 0.0), "{name} at {stop} s: {pv:?}");
            for over in [1.01, 1.025, 1.5] {
                let mut simulation = reached(pv.map(|pv| pv / over), stop);
                let found = largest_pv(&mut simulation);
                let shares: Vec<f64> = found.iter().zip(pv).map(|(found, pv)| found / pv).collect();
                assert!(shares.iter().all(|share| (share - 1.0).abs() < 8e-3), "{name} at {stop} s: {shares:?}");
                compare(&simulation, (name, stop));
            }
        }
    }
}

/// Compares the Jacobian of `simulation` with differences.
fn compare(simulation: &Simulation, (name, stop): (&str, f64)) {
    let (state, n) = (simulation.state(), simulation.degrees_of_freedom());
    let at = [state.q[..n].to_vec(), state.v[..n].to_vec()];
    let mut rows = vec![0.0; 4 * n * n];
    simulation.slopes(&at[0], &at[1], &mut rows);
    let columns: Vec<Vec<f64>> = (0..2 * n).map(|k| difference(simulation, &at, k)).collect();
    for block in 0..2 {
        let entries = || (0..2 * n).flat_map(|i| (block * n..(block + 1) * n).map(move |k| (i, k)));
        let largest = entries().fold(0.0f64, |most, (i, k)| most.max(columns[k][i].abs()));
        for (i, k) in entries() {
            let (exact, found) = (rows[2 * n * i + k], columns[k][i]);
            assert!(
                (exact - found).abs() < WITHIN * largest,
                "{name} at {stop} s: row {i}, column {k}: {exact:e}, by differences {found:e}, largest {largest:e}"
            );
        }
    }
}
