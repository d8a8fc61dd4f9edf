//! A start in equilibrium with dry friction: brakes, clutches, packs and washers that hold or slide carry their share of the
//! loads from the first instant on, so that nothing swings.

use bevel_differential::model::{ALL_HEATS, CarrierDrive, GearContact, Inputs, Parameters, SideDrive, Simulation};

const LEVELS: [GearContact; 3] = [GearContact::Ideal, GearContact::Lumped, GearContact::Tooth];
const WITH_TEETH: [GearContact; 2] = [GearContact::Lumped, GearContact::Tooth];
/// Torque on the carrier [N·m].
const DRIVE: f64 = 300.0;

/// Gears with half-shafts and wheels of 1 kg·m², driven by torque.
fn parameters(contact: GearContact) -> Parameters {
    let mut p = Parameters::default();
    (p.scene.gear_contact, p.scene.carrier_drive) = (contact, CarrierDrive::Torque);
    p.effects.half_shaft = true;
    (p.inertia.left_end, p.inertia.right_end) = (1.0, 1.0);
    p
}

fn inputs(speed: f64, load_torque: [f64; 2]) -> Inputs {
    Inputs { carrier_speed: speed, carrier_torque: DRIVE, load_torque, ..Inputs::default() }
}

/// The inputs with all signs negated; commands have none.
fn mirrored(inputs: &Inputs) -> Inputs {
    Inputs {
        carrier_speed: -inputs.carrier_speed,
        carrier_torque: -inputs.carrier_torque,
        pinion_speed: -inputs.pinion_speed,
        pinion_torque: -inputs.pinion_torque,
        side_speed: inputs.side_speed.map(|speed| -speed),
        load_torque: inputs.load_torque.map(|load| -load),
        ..*inputs
    }
}

/// Starts `inputs` and their mirror image. Calls `check` with each simulation and the sign of its inputs.
fn both_ways(p: &Parameters, inputs: &Inputs, check: impl Fn(&mut Simulation, f64)) {
    for (inputs, sign) in [(*inputs, 1.0), (mirrored(inputs), -1.0)] {
        check(&mut Simulation::start(p, &inputs, 0.0).unwrap(), sign);
    }
}

/// Checks that the half-shafts transmit `torque` at the start and until 0.1 s, while speeds do not change.
fn stays(p: &Parameters, inputs: &Inputs, torque: [f64; 2]) {
    both_ways(p, inputs, |s, sign| {
        let label = format!("{:?} {sign}", p.scene.gear_contact);
        assert!(s.warnings().iter().all(|warning| warning.variable != "scene.start"), "{label}: {:?}", s.warnings());
        let speed = s.motion().side_speed;
        for time in [0.0, 1e-4, 1e-3, 0.01, 0.1] {
            if time > 0.0 {
                s.advance(time).unwrap();
            }
            let (found, now) = (s.forces().shaft_torque, s.motion().side_speed);
            for side in 0..2 {
                let off = (found[side] - sign * torque[side]).abs();
                assert!(off < 1e-6 * DRIVE, "{label} at {time}: {} for {}", found[side], sign * torque[side]);
                assert!((now[side] - speed[side]).abs() < 1e-6, "{label} at {time}: {now:?} after {speed:?}");
            }
        }
    });
}

#[test]
fn packs_clutches_and_lock_hold_unequal_loads() {
    for contact in LEVELS {
        for speed in [0.0, 10.0] {
            let (mut packs, loads) = (parameters(contact), [200.0, 100.0]);
            packs.effects.limited_slip = true;
            packs.specs.limited_slip.preload = 300.0;
            stays(&packs, &inputs(speed, loads), loads);
            let mut clutches = parameters(contact);
            clutches.effects.clutches = true;
            stays(&clutches, &Inputs { clutch_command: [0.2; 2], ..inputs(speed, loads) }, loads);
            // a single clutch holds the whole difference
            stays(&clutches, &Inputs { clutch_command: [0.2, 0.0], ..inputs(speed, loads) }, loads);
            stays(&parameters(contact), &Inputs { lock: 1.0, ..inputs(speed, loads) }, loads);
        }
    }
}

#[test]
fn an_actuator_passes_the_command_that_holds() {
    for contact in LEVELS {
        let mut p = parameters(contact);
        p.effects.clutches = true;
        (p.specs.clutches.actuator.dead_band, p.specs.clutches.actuator.response_time) = (0.1, 0.05);
        let loads = [200.0, 100.0];
        stays(&p, &Inputs { clutch_command: [0.3; 2], ..inputs(10.0, loads) }, loads);
    }
}

#[test]
fn packs_pressed_by_the_teeth_hold_as_much_as_these_press() {
    for contact in WITH_TEETH {
        let mut p = parameters(contact);
        p.effects.limited_slip = true;
        // both sides hold 0.4 · 150 N·m, so the loads may differ by 120 N·m
        p.specs.limited_slip.torque_coefficient = 0.4;
        let loads = [205.0, 95.0];
        stays(&p, &inputs(10.0, loads), loads);
        both_ways(&p, &inputs(10.0, [225.0, 75.0]), |s, _| {
            assert!(s.warnings().iter().any(|warning| warning.message.contains("the planets start to roll")));
        });
    }
}

#[test]
fn washers_hold_small_differences() {
    for contact in WITH_TEETH {
        let mut p = parameters(contact);
        p.effects.thrust_friction = true;
        let loads = [152.0, 148.0];
        stays(&p, &inputs(10.0, loads), loads);
    }
}

#[test]
fn brakes_hold_a_standing_car() {
    for contact in LEVELS {
        let mut p = parameters(contact);
        p.effects.wheel_brake = true;
        let held = Inputs { brake_torque: [1e3; 2], ..inputs(0.0, [0.0; 2]) };
        stays(&p, &held, [0.5 * DRIVE; 2]);
        // on a slope
        stays(&p, &Inputs { load_torque: [80.0, 20.0], ..held }, [0.5 * DRIVE; 2]);
    }
}

#[test]
fn brakes_and_lock_share_a_difference_by_their_stiffnesses() {
    for contact in LEVELS {
        let mut p = parameters(contact);
        p.effects.wheel_brake = true;
        let held = Inputs { brake_torque: [1e3; 2], lock: 1.0, carrier_torque: 0.0, ..inputs(0.0, [300.0, 100.0]) };
        // a wheel that yields to its load of ±100 N·m turns its half-shaft and the lock behind it
        let (brake, shaft, lock) = (1e-5, 1e-4, 1e-6);
        let share = 100.0 * brake / (brake + shaft + lock);
        stays(&p, &held, [share, -share]);
    }
}

#[test]
fn one_brake_leaves_the_other_wheel_to_accelerate() {
    for contact in LEVELS {
        let mut p = parameters(contact);
        p.effects.wheel_brake = true;
        let inputs = Inputs { brake_torque: [1e3, 0.0], ..inputs(0.0, [0.0; 2]) };
        both_ways(&p, &inputs, |s, sign| {
            // the right wheel turns twice as fast as the carrier
            let (j, ratio) = (*s.inertias(), 10.0 / 16.0);
            let planets = j.planets * j.planet / (ratio * ratio);
            let carrier = DRIVE / (j.carrier + 4.0 * j.side[1] + planets);
            let right = sign * 2.0 * j.end[1] * carrier;
            // the teeth on the left side also accelerate the planets
            let left = sign * (2.0 * j.side[1] + planets) * carrier;
            let found = s.forces().shaft_torque;
            assert!((found[0] - left).abs() < 1e-6 * DRIVE, "{contact:?}: {found:?} for {left}");
            assert!((found[1] - right).abs() < 1e-6 * DRIVE, "{contact:?}: {found:?} for {right}");
        });
    }
}

#[test]
fn packs_at_their_limit_slow_the_planets_down() {
    for contact in LEVELS {
        let mut p = parameters(contact);
        p.effects.limited_slip = true;
        p.specs.limited_slip.preload = 30.0;
        both_ways(&p, &inputs(10.0, [200.0, 100.0]), |s, sign| {
            let (j, ratio) = (*s.inertias(), 10.0 / 16.0);
            // both packs take 30 N·m off the difference of 100 N·m
            let spin = -sign * ratio * 40.0 / (2.0 * ratio * ratio * j.side[0] + j.planets * j.planet);
            let found = s.forces();
            for (side, sigma) in [(0, 1.0), (1, -1.0)] {
                let expected = sigma * ratio * spin;
                let off = (found.side_acceleration[side] - expected).abs();
                assert!(off < 1e-5 * expected.abs(), "{contact:?}: {:?} for {expected}", found.side_acceleration);
            }
        });
    }
}

#[test]
fn packs_hold_while_clutches_on_other_shafts_slide() {
    for contact in LEVELS {
        let mut p = parameters(contact);
        (p.inertia.carrier, p.inertia.left_end, p.inertia.right_end) = (0.1, 2.0, 2.0);
        (p.effects.limited_slip, p.specs.limited_slip.preload) = (true, 100.0);
        (p.effects.clutches, p.specs.clutches.ratio) = (true, [0.0, 0.875]);
        let inputs = Inputs { carrier_torque: 200.0, clutch_command: [0.01; 2], ..inputs(0.0, [200.0, 300.0]) };
        both_ways(&p, &inputs, |s, sign| {
            // both clutches hold the backward motion up by 10 N·m, the right one with a shaft that pushes the carrier back
            let j = *s.inertias();
            let expected = sign * (200.0 - 500.0 + 20.0 - 8.75) / (j.carrier + j.side[0] + j.side[1]);
            let found = s.forces().side_acceleration;
            for side in 0..2 {
                assert!(
                    (found[side] - expected).abs() < 1e-5 * expected.abs(),
                    "{contact:?}: {found:?} for {expected}"
                );
            }
        });
    }
}

#[test]
fn a_stiff_lock_leaves_the_pinion_its_whole_share() {
    for contact in LEVELS {
        let mut p = parameters(contact);
        p.effects.final_drive = true;
        (p.specs.final_drive.friction_torque, p.specs.final_drive.holding_stiffness) = (20.0, 1.0);
        p.specs.lock.stiffness = 1e9;
        let inputs = Inputs { pinion_speed: 0.0, pinion_torque: 7.0, lock: 1.0, ..inputs(0.0, [0.0; 2]) };
        stays(&p, &inputs, [0.0; 2]);
    }
}

#[test]
fn a_brake_behind_an_open_dog_clutch_holds_the_load_of_its_wheel() {
    for contact in LEVELS {
        let mut p = parameters(contact);
        (p.effects.disconnect, p.effects.wheel_brake) = (true, true);
        p.scene.carrier_drive = CarrierDrive::Speed;
        let inputs = Inputs { dog_command: [1.0, 0.0], brake_torque: [0.0, 500.0], ..inputs(0.0, [0.0, 300.0]) };
        both_ways(&p, &inputs, |s, _| {
            for time in [1e-4, 1e-3, 0.01] {
                s.advance(time).unwrap();
                let speed = s.motion().wheel_speed[1];
                assert!(speed.abs() < 1e-6, "{contact:?} at {time}: {speed}");
            }
        });
    }
}

#[test]
fn a_brake_at_a_wheel_of_imposed_speed_starts_relaxed() {
    for contact in LEVELS {
        let mut p = parameters(contact);
        (p.effects.wheel_brake, p.scene.left_drive) = (true, SideDrive::Speed);
        let inputs = Inputs { side_speed: [0.0; 2], brake_torque: [1e3, 0.0], ..inputs(0.0, [835.0, 0.5 * DRIVE]) };
        both_ways(&p, &inputs, |s, _| {
            // what a spring has stored becomes heat when the brake is released
            let released = Inputs { brake_torque: [0.0; 2], ..*s.inputs() };
            s.set_inputs(&released);
            s.advance(1e-4).unwrap();
            let heat = ALL_HEATS.iter().zip(s.ledger().heat).find(|(heat, _)| heat.output == "heat.brake").unwrap().1;
            assert!(heat.abs() < 1e-9, "{contact:?}: {heat} J");
        });
    }
}

#[test]
fn a_clutch_of_superposition_slides_from_the_start() {
    for contact in LEVELS {
        let mut p = parameters(contact);
        p.effects.clutches = true;
        p.specs.clutches.ratio[0] = 1.125;
        // T_L − T_R = C and T_L + T_R = T_c + (1 − σ) C with C = 100 N·m
        let sum = DRIVE + (1.0 - 1.125) * 100.0;
        let loads = [0.5 * (sum + 100.0), 0.5 * (sum - 100.0)];
        stays(&p, &Inputs { clutch_command: [0.1, 0.0], ..inputs(10.0, loads) }, loads);
    }
}

#[test]
fn packs_slide_between_wheels_of_imposed_speeds() {
    for contact in [GearContact::Ideal, GearContact::Lumped] {
        let mut p = parameters(contact);
        (p.scene.left_drive, p.scene.right_drive) = (SideDrive::Speed, SideDrive::Speed);
        p.effects.limited_slip = true;
        p.specs.limited_slip.preload = 50.0;
        let inputs = Inputs { side_speed: [12.0, 8.0], ..inputs(10.0, [0.0; 2]) };
        // each pack acts against the slip of its side gear
        stays(&p, &inputs, [0.5 * DRIVE - 50.0, 0.5 * DRIVE + 50.0]);
    }
}

#[test]
fn friction_holds_a_pinion() {
    for contact in LEVELS {
        for is_elastic in [false, true] {
            let mut p = parameters(contact);
            p.effects.final_drive = true;
            (p.inertia.pinion, p.specs.final_drive.elastic_mesh) = (0.002, is_elastic);
            p.specs.final_drive.friction_torque = 5.0;
            let inputs = Inputs { pinion_speed: 0.0, pinion_torque: 3.0, ..inputs(0.0, [0.0; 2]) };
            stays(&p, &inputs, [0.0; 2]);
        }
    }
}

#[test]
fn joint_and_viscous_friction_of_the_pinion_take_their_share() {
    for contact in LEVELS {
        for (is_elastic, angle, viscous) in [(false, 0.3, 0.0), (true, 0.3, 0.0), (false, 0.0, 0.05), (true, 0.0, 0.05)]
        {
            let mut p = parameters(contact);
            (p.effects.final_drive, p.effects.propeller_shaft) = (true, true);
            (p.inertia.pinion, p.inertia.propeller_end) = (0.002, 0.01);
            (p.specs.final_drive.elastic_mesh, p.specs.final_drive.viscous) = (is_elastic, viscous);
            p.specs.propeller_shaft.joint_angle = angle;
            let (ratio, torque, speed) = (4.1, 200.0, 50.0 * 4.1);
            // the joint begins at its angle 0, where tan θ₂ = cos β tan θ₁
            let pinion = torque / angle.cos() - viscous * speed * angle.cos();
            let load = 0.5 * ratio * pinion;
            let inputs = Inputs { pinion_speed: speed, pinion_torque: torque, ..inputs(0.0, [load; 2]) };
            both_ways(&p, &inputs, |s, sign| {
                let found = s.forces().shaft_torque;
                for side in 0..2 {
                    let off = (found[side] - sign * load).abs();
                    assert!(off < 1e-6 * load, "{contact:?} {is_elastic} {angle} {viscous}: {found:?} for {load}");
                }
            });
        }
    }
}

#[test]
fn an_open_dog_clutch_transmits_nothing_from_the_start() {
    for contact in LEVELS {
        let mut p = parameters(contact);
        p.effects.disconnect = true;
        let inputs = Inputs { dog_command: [1.0, 0.0], ..inputs(10.0, [200.0, 100.0]) };
        both_ways(&p, &inputs, |s, sign| {
            // the right side gear has its own inertia only
            let (j, r) = (*s.inertias(), 10.0 / 16.0);
            let (left, right) = (j.side[0], j.side[1] - j.end[1]);
            let mass = [j.carrier + left + right, r * (left - right), r * r * (left + right) + j.planets * j.planet];
            let (f1, f2) = (DRIVE - 200.0, -r * 200.0);
            let determinant = mass[0] * mass[2] - mass[1] * mass[1];
            let carrier = (f1 * mass[2] - f2 * mass[1]) / determinant;
            let spin = (f2 * mass[0] - f1 * mass[1]) / determinant;
            let expected = sign * (200.0 + j.end[0] * (carrier + r * spin));
            let found = s.forces().shaft_torque;
            assert!((found[0] - expected).abs() < 1e-6 * DRIVE, "{contact:?}: {found:?} for {expected}");
            assert_eq!(found[1], 0.0);
        });
    }
}
