//! Calculated parameters of the gears, compared with closed forms, with the volume of the exported solid, and with a
//! wheel that turns through its lash.

use std::f64::consts::{FRAC_PI_2, PI};

use crate::common::{Host, assert_contains};
use bevel_differential::fmi2::Status;
use bevel_differential::geometry::solid::GearSolid;
use bevel_differential::geometry::{GearSpec, Pair};

const DENSITY: f64 = 7800.0;

fn close(program: f64, expected: f64, relative: f64) {
    assert!((program / expected - 1.0).abs() <= relative, "program {program:e}, expected {expected:e}");
}

/// Host in initialisation mode with the given gears.
fn initialising(values: &[(&str, f64)], whole: &[(&str, i32)]) -> Host {
    let host = Host::new();
    for &(name, value) in values {
        assert_eq!(host.set(name, value), Status::Ok);
    }
    for &(name, value) in whole {
        assert_eq!(host.set_integer(name, value), Status::Ok);
    }
    assert_eq!([host.setup(), host.enter()], [Status::Ok; 2]);
    host
}

#[test]
fn cones_and_contact_ratio_are_those_of_iso_23509_from_initialisation_mode_on() {
    for (module, planet, side) in [(0.0045, 10, 16), (0.003, 12, 20)] {
        let host = initialising(
            &[("geometry.module", module), ("geometry.face_width", 3.0 * module)],
            &[("geometry.planet_teeth", planet), ("geometry.side_teeth", side)],
        );
        let [z_p, z_s] = [planet, side].map(f64::from);
        let check = |host: &Host| {
            close(host.get("geometry.planet_pitch_angle"), (z_p / z_s).atan(), 1e-15);
            close(host.get("geometry.side_pitch_angle"), (z_s / z_p).atan(), 1e-15);
            close(host.get("geometry.outer_cone_distance"), 0.5 * module * z_p.hypot(z_s), 1e-14);
            let spec = GearSpec {
                module,
                planet_teeth: planet,
                side_teeth: side,
                face_width: 3.0 * module,
                ..GearSpec::default()
            };
            let pair = Pair::new(&spec);
            let path = (pair.path.high - pair.path.low) * z_p / (2.0 * PI * pair.gears[0].base.sin());
            close(host.get("geometry.contact_ratio"), path, 1e-14);
            close(host.get("geometry.wheel_lash"), 4.0 * spec.backlash / (module * z_s), 1e-14);
        };
        check(&host);
        assert_eq!(host.exit(), Status::Ok);
        check(&host);
        host.steps(0.0, 1e-3, 2);
        check(&host);
    }
}

#[test]
fn calculated_parameters_cannot_be_set_and_do_not_exist_before_initialisation() {
    let host = Host::new();
    assert_eq!(host.set("geometry.planet_mass", 1.0), Status::Error);
    assert_contains(&host.last_message(), &["geometry.planet_mass", "calculated", "cannot be set"]);
    assert_eq!(host.try_get("geometry.planet_mass").0, Status::Error);
}

#[test]
fn without_backlash_the_wheel_lash_is_zero() {
    let host = initialising(&[], &[]);
    assert_eq!(host.set_boolean("effects.backlash", 0), Status::Ok);
    assert_eq!(host.get("geometry.wheel_lash"), 0.0);
}

/// Volume of a closed surface by the divergence theorem.
fn volume(solid: &GearSolid) -> f64 {
    let tetrahedron = |t: &[u32; 3]| {
        let [a, b, c] = t.map(|i| solid.vertices[i as usize]);
        a.dot(&b.cross(&c)) / 6.0
    };
    solid.triangles.iter().map(tetrahedron).sum()
}

/// Volumes of the frustum of the root cone of gear `i`, and of the ring of teeth and gaps on it.
fn frustum_and_ring(pair: &Pair, i: usize) -> [f64; 2] {
    let [root, tip] = [pair.gears[i].root, pair.gears[i].tip];
    let length = PI / 3.0 * (pair.outer_cone.powi(3) - pair.inner_cone.powi(3));
    [length * root.sin().powi(2) * root.cos(), length * (tip - root).sin() * (tip.sin() + root.sin())]
}

#[test]
fn masses_are_density_times_the_volume_of_the_solids_for_any_given_inertias() {
    for bores in [[0.0, 0.0], [0.012, 0.03]] {
        let spec = GearSpec { planet_bore: bores[0], side_bore: bores[1], ..GearSpec::default() };
        let pair = Pair::new(&spec);
        let host = initialising(&[("geometry.planet_bore", bores[0]), ("geometry.side_bore", bores[1])], &[]);
        for (i, name) in ["geometry.planet_mass", "geometry.side_mass"].into_iter().enumerate() {
            let mass = host.get(name);
            close(mass, DENSITY * volume(&GearSolid::new(&pair, &spec, i, 400, 1)), 2e-5);
            if bores[i] == 0.0 {
                // teeth fill half of their ring
                let [frustum, ring] = frustum_and_ring(&pair, i);
                let filled = (mass / DENSITY - frustum) / ring;
                assert!((0.45..0.55).contains(&filled), "{name}: {filled}");
            }
            assert_eq!(host.set("material.density", 2.0 * DENSITY), Status::Ok);
            close(host.get(name), 2.0 * mass, 1e-14);
            assert_eq!(host.set("material.density", DENSITY), Status::Ok);
            assert_eq!(host.set_boolean("inertia.from_geometry", 0), Status::Ok);
            assert_eq!(host.set_many(&["inertia.side_gear", "inertia.planet"], &[1e-3, 1e-3]), Status::Ok);
            assert_eq!(host.get(name), mass);
        }
    }
}

/// Angle at which the left wheel stops under a small torque, with carrier and right wheel held [rad].
fn resting_angle(torque: f64) -> f64 {
    let held = [("scene.right_drive", 2), ("scene.start", 3)];
    let values = [
        ("carrier.speed_command", 0.0),
        ("left.load_torque", torque),
        ("right.speed_command", 0.0),
        ("bearing_drag.side_viscous", 0.2),
        ("bearing_drag.side_torque", 0.0),
        ("bearing_drag.carrier_viscous", 0.0),
        ("bearing_drag.carrier_torque", 0.0),
        ("bearing_drag.carrier_churning", 1e-4),
    ];
    let host = initialising(&values, &held);
    assert_eq!(host.set_boolean("effects.bearing_drag", 1), Status::Ok);
    assert_eq!(host.exit(), Status::Ok, "{:?}", host.log());
    host.steps(0.0, 1e-2, 60);
    let angle = host.get("left.angle");
    host.steps(0.6, 1e-2, 10);
    assert!((host.get("left.angle") - angle).abs() < 1e-6, "at rest");
    angle
}

#[test]
fn a_wheel_turns_through_its_lash_while_carrier_and_other_wheel_are_held() {
    let host = initialising(&[], &[]);
    let lash = host.get("geometry.wheel_lash");
    let turned = resting_angle(-0.004) - resting_angle(0.004);
    println!("lash {lash:e} rad, turned {turned:e} rad");
    // the teeth deflect a little
    assert!((0.0..2e-3).contains(&(turned / lash - 1.0)), "{turned} {lash}");
    assert!(lash < FRAC_PI_2);
}
