//! Stress of roots and flanks whose load differs over the face, compared with separate calculations. The flanks are
//! opened by the formulas of the theory, and slices that the program does not use are balanced with the torque of the
//! mesh.

use crate::loads::{TORQUE, close, loads, middles, pairs_of, reading, standing};
use crate::mesh_laws::{Built, Kind};
use bevel_differential::contact::AnySpring;
use bevel_differential::contact::ContactLaw;
use bevel_differential::contact::errors::ToothErrorSpec;
use bevel_differential::contact::pairs::Flank;
use bevel_differential::contact::spring::Spring;
use bevel_differential::geometry::{GearSpec, Pair};
use bevel_differential::model::{GearContact, Inputs, Parameters, Simulation, ToothLoad};
use bevel_differential::strength::{LineContact, RootStressFactors};

/// Opening of the flanks by errors [m] in a mesh of planet 1 or the opposite planet 2, from section 5 of the theory.
fn opening(pair: &Pair, e: &ToothErrorSpec, planet: usize, side: usize, r: f64, s: f64) -> f64 {
    let [dp, ds] = pair.gears.map(|gear| gear.pitch);
    let alpha = pair.pressure_angle;
    let x = (r - pair.mean_cone) / (0.5 * (pair.outer_cone - pair.inner_cone));
    // drive flanks; a planet on the other side of the axis is offset in the opposite direction
    let across = if planet == 0 { -e.axis_offset } else { e.axis_offset };
    let tilt = if side == 0 { e.shaft_angle_error } else { -e.shaft_angle_error };
    e.crowning * x * x
        + e.planet_axial_offset * (alpha.sin() * dp.sin() * s.cos() + dp.cos() * s.sin())
        + e.side_axial_offset * (alpha.sin() * ds.sin() * s.cos() - ds.cos() * s.sin())
        + across * alpha.cos() * s.cos()
        + r * alpha.sin() * tilt
}

/// N_F of the default gears. Their teeth are less than three depths wide, so the standard uses 3.
const EXPONENT: f64 = 9.0 / 13.0;

/// Root stress and Hertzian pressure [Pa], each the largest of all meshes, from 64 slices of each pair balanced with
/// its torque.
fn expected(pair: &Pair, spring: &AnySpring, e: &ToothErrorSpec, loads: &[ToothLoad]) -> [f64; 2] {
    let (cones, width) = middles(pair, 64);
    let area = (pair.outer_cone.powi(3) - pair.inner_cone.powi(3)) / 3.0;
    let contact = LineContact::new(pair, 2.07e11, 0.25);
    let root = RootStressFactors::new(pair, 0, 0.25).unwrap();
    let (mut stress, mut pressure) = (0.0f64, 0.0f64);
    for (planet, side, flank, s) in pairs_of(loads) {
        let of = loads.iter().filter(|l| (l.planet, l.side, l.flank, l.s) == (planet, side, flank, s));
        let torque: f64 = of.map(|l| l.normal * l.cone).sum();
        assert!(flank == Flank::Drive && torque > 0.0);
        // w/R of each slice at the approach `a`
        let omega = |a: f64| {
            cones.clone().map(move |r| {
                let arc = a - opening(pair, e, planet, side, r, s) / r;
                (r, if arc > 0.0 { spring.at(arc, s).torque } else { 0.0 })
            })
        };
        let moment = |a: f64| omega(a).map(|(r, w)| w * r * r * width).sum::<f64>();
        let (mut low, mut high) = (-0.01, 0.02);
        for _ in 0..60 {
            let a = 0.5 * (low + high);
            if moment(a) < torque { low = a } else { high = a }
        }
        let largest = omega(high).map(|(_, w)| w).fold(0.0, f64::max);
        let force = torque / pair.mean_cone * (largest * area / torque).powf(EXPONENT);
        stress = stress.max(force * root.per_force_at(s));
        let line_load = largest * pair.mean_cone;
        pressure = pressure.max(contact.pressure_at(line_load, pair.mean_cone, s).unwrap());
    }
    [stress, pressure]
}

#[test]
fn root_stress_and_pressure_match_64_separately_computed_slices() {
    let none = ToothErrorSpec::default();
    let cases = [
        ("crowned", ToothErrorSpec { crowning: 20e-6, ..none }),
        ("crowned by the deflection", ToothErrorSpec { crowning: 60e-6, ..none }),
        ("planet outward", ToothErrorSpec { planet_axial_offset: 1e-4, ..none }),
        ("planet inward", ToothErrorSpec { planet_axial_offset: -1e-4, ..none }),
        ("side gear outward", ToothErrorSpec { side_axial_offset: 1e-4, ..none }),
        ("axes off each other", ToothErrorSpec { axis_offset: 15e-6, ..none }),
        ("axes off the other way", ToothErrorSpec { axis_offset: -20e-6, ..none }),
        ("leaning shafts", ToothErrorSpec { shaft_angle_error: 2e-3, ..none }),
        (
            "all",
            ToothErrorSpec {
                crowning: 40e-6,
                side_axial_offset: -1e-4,
                shaft_angle_error: 1e-3,
                axis_offset: -1e-5,
                ..none
            },
        ),
    ];
    let pair = Pair::new(&GearSpec::default());
    let mut largest = 0.0f64;
    for (law, kind) in [(ContactLaw::Line, Kind::Line), (ContactLaw::LineWeber, Kind::LineWeber)] {
        let spring = Built::new(&pair, kind).spring;
        let even = reading(&mut standing(law, &none), "stress.root_planet_max");
        for (name, errors) in &cases {
            let mut simulation = standing(law, errors);
            let loads = loads(&simulation);
            let [root, pressure] = expected(&pair, &spring, errors, &loads);
            let stress = reading(&mut simulation, "stress.root_planet_max");
            let contact = reading(&mut simulation, "stress.contact_max");
            println!(
                "{law:?}, {name}: root stress {:.4} of that of an even load, expected {:.4}; pressure {:.1} MPa, expected {:.1}",
                stress / even,
                root / even,
                contact * 1e-6,
                pressure * 1e-6
            );
            close(stress, root, 0.02);
            close(contact, pressure, 0.01);
            largest = largest.max(stress / even);
        }
    }
    assert!(largest > 1.3, "{largest}");
}

#[test]
fn solid_teeth_have_the_face_load_factor_of_their_overlap() {
    let none = ToothErrorSpec::default();
    let pair = Pair::new(&GearSpec::default());
    let root = RootStressFactors::new(&pair, 0, 0.25).unwrap();
    for (errors, least) in [
        (ToothErrorSpec { crowning: 60e-6, ..none }, 1.2),
        (ToothErrorSpec { side_axial_offset: 1e-4, ..none }, 1.05),
        (ToothErrorSpec { side_axial_offset: -1e-4, crowning: 10e-6, ..none }, 1.04),
    ] {
        let mut p = Parameters::default();
        (p.effects.strength, p.effects.tooth_errors) = (true, true);
        p.specs.tooth_errors = errors;
        p.scene.gear_contact = GearContact::Solid;
        let inputs = Inputs { load_torque: [TORQUE; 2], ..Inputs::default() };
        let mut simulation = Simulation::start(&p, &inputs, 0.0).expect("a scene");
        let all = loads(&simulation);
        let (mut stress, mut even) = (0.0f64, 0.0f64);
        for planet in 0..2 {
            for side in 0..2 {
                for mesh in pairs_of(&all).iter().filter(|m| (m.0, m.1) == (planet, side)) {
                    let of: Vec<&ToothLoad> =
                        all.iter().filter(|l| (l.planet, l.side, l.flank, l.s) == *mesh).collect();
                    // R p is a parabola in R, determined from three of its sections
                    let [a, b, c] = [0, of.len() / 2, of.len() - 1].map(|i| (of[i].cone, of[i].depth));
                    let overlap = |r: f64| {
                        let part = |(x, y): (f64, f64), (u, _): (f64, f64), (v, _): (f64, f64)| {
                            y * (r - u) * (r - v) / ((x - u) * (x - v))
                        };
                        ((part(a, b, c) + part(b, c, a) + part(c, a, b)) / r).max(0.0)
                    };
                    // the load per width of IMPACT is proportional to the overlap to the power 1.5
                    let (cones, width) = middles(&pair, 64);
                    let load = cones.map(|r| (r, overlap(r).powf(1.5)));
                    let largest = load.clone().map(|(_, w)| w).fold(0.0, f64::max);
                    let area = (pair.outer_cone - pair.inner_cone) * pair.mean_cone;
                    let mean = load.map(|(r, w)| w * r * width).sum::<f64>() / area;
                    let force: f64 = of.iter().map(|l| l.normal * l.cone).sum::<f64>() / pair.mean_cone;
                    even = even.max(force * root.per_force_at(mesh.3));
                    stress = stress.max(force * (largest / mean).powf(EXPONENT) * root.per_force_at(mesh.3));
                }
            }
        }
        let program = reading(&mut simulation, "stress.root_planet_max");
        println!("{errors:?}: {:.4} of an even load, expected {:.4}", program / even, stress / even);
        close(program, stress, 0.02);
        assert!(program > least * even);
    }
}
