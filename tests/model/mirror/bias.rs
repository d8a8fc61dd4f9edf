//! Torque bias and locking value of a differential with friction, for all directions of drive.

use bevel_differential::model::{CarrierDrive, GearContact, Inputs, Parameters, SideDrive};

use super::scene::{Course, Scene, Step, output};
use super::teeth::View;

/// Scene with wheels held at different speeds, a carrier driven by torque, and friction of washers, pins and flanks.
fn held_apart(torque: f64, carrier: f64, apart: f64) -> Scene {
    let mut p = Parameters::default();
    p.scene.carrier_drive = CarrierDrive::Torque;
    (p.scene.left_drive, p.scene.right_drive) = (SideDrive::Speed, SideDrive::Speed);
    p.effects.thrust_friction = true;
    p.effects.tooth_friction = true;
    let inputs = Inputs {
        carrier_torque: torque,
        carrier_speed: carrier,
        side_speed: [carrier + apart, carrier - apart],
        ..Inputs::default()
    };
    let steps = vec![Step { size: 4e-3, inputs, derivatives: None }; 100];
    Scene::new(p, inputs, steps).expect("a scene")
}

fn readings(course: &Course, name: &str) -> Vec<f64> {
    course.values.iter().map(|values| values[output(name)]).collect()
}

#[test]
fn a_bias_by_friction_is_above_one_in_every_sense() {
    // sum of 0.055 at the pitch point (theory.md, section 9); over the path, it is some per cent less
    let expected = (1.0 + 0.055) / (1.0 - 0.055) - 1.0;
    for torque in [1670.0, -1670.0] {
        for (carrier, apart) in [(50.0, 2.5), (-50.0, 2.5), (50.0, -2.5), (0.0, 2.5), (0.0, -2.5)] {
            let course = held_apart(torque, carrier, apart).run().expect("a scene that starts");
            assert_eq!(course.failure, None);
            let ratio = readings(&course, "torque_bias_ratio");
            // after the first mesh cycle, which takes 0.157 s, the ratio is the mean over a cycle
            let settled = &ratio[60..];
            assert!(settled.iter().all(|ratio| *ratio >= 1.0), "{torque} {carrier} {apart}: {settled:?}");
            let last = settled[settled.len() - 1];
            assert!((last - 1.0 - expected).abs() < 0.1 * expected, "{torque} {carrier} {apart}: {last}");
        }
    }
}

#[test]
fn the_means_of_a_mesh_cycle_are_the_same_forward_backward_and_with_swapped_sides_at_every_instant() {
    let scene = held_apart(1670.0, 50.0, 2.5);
    let forward = scene.run().expect("a scene that starts");
    for view in [View::Reversed, View::Swapped] {
        let image = scene.image(view).run().expect("an image that starts");
        for name in ["locking_value", "torque_bias_ratio"] {
            let (one, other) = (readings(&forward, name), readings(&image, name));
            for (k, (a, b)) in one.iter().zip(&other).enumerate() {
                assert!((a - b).abs() < 1e-9, "{view:?} {name} at {} s: {a} and {b}", forward.times[k]);
            }
        }
    }
}

#[test]
fn ramps_lock_by_their_ratio_and_a_reversed_differential_has_them_exchanged() {
    for (torque, locking) in [(1670.0, 0.4), (-1670.0, 0.1)] {
        let mut scene = held_apart(torque, 50.0, 2.5);
        let p = &mut scene.parameters;
        (p.scene.gear_contact, p.effects.thrust_friction, p.effects.tooth_friction) =
            (GearContact::Lumped, false, false);
        p.effects.limited_slip = true;
        (p.specs.limited_slip.torque_coefficient, p.specs.limited_slip.coast_ratio) = (0.4, 0.25);
        let image = scene.image(View::Reversed);
        assert_eq!(image.parameters.specs.limited_slip.torque_coefficient, 0.1);
        for scene in [scene, image] {
            let course = scene.run().expect("a scene that starts");
            let last = *readings(&course, "locking_value").last().expect("a value");
            assert!((last.abs() - locking).abs() < 1e-6, "{torque}: {last}");
        }
    }
}
