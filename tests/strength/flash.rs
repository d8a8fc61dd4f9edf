//! Flash temperature over the whole face of rolling teeth, compared with a separate evaluation of Blok's formula.

use crate::loads::{TORQUE, close, loads, pairs_of, reading};
use crate::mesh_laws::{Built, Kind};
use bevel_differential::contact::AnySpring;
use bevel_differential::contact::errors::ToothErrorSpec;
use bevel_differential::contact::spring::Spring;
use bevel_differential::contact::{ContactLaw, Spot, ToothLoad};
use bevel_differential::friction::FrictionLaw;
use bevel_differential::geometry::{GearSpec, Pair};
use bevel_differential::model::{Inputs, Motion, Parameters, PlanetSpin, Simulation};
use std::f64::consts::PI;

/// Spin rate of the planets relative to the carrier [rad/s].
const SPIN: f64 = 15.0;
/// Modulus of the contact of steel with E = 207 GPa and ν = 0.25 [Pa], and thermal contact coefficient [W·√s/(m²·K)].
const MODULUS: f64 = 2.07e11 / (2.0 * (1.0 - 0.0625));
const EFFUSIVITY: f64 = 13_800.0;
/// Coefficient of friction, and the speed over which friction changes its sign [m/s].
const COEFFICIENT: f64 = 0.05;
const REGULARISATION: f64 = 1e-3;

/// Sets one error to a size [m].
type Set = fn(&mut ToothErrorSpec, f64);

/// Rolling teeth with friction, and with errors if given.
fn rolling(law: ContactLaw, errors: Option<&ToothErrorSpec>, change: impl Fn(&mut Parameters)) -> Simulation {
    let mut p = Parameters::default();
    (p.effects.strength, p.effects.tooth_friction) = (true, true);
    if let Some(errors) = errors {
        p.effects.tooth_errors = true;
        p.specs.tooth_errors = *errors;
    }
    p.contact.law = law;
    p.scene.planet_spin = PlanetSpin::Imposed;
    p.solver.relative_tolerance = 1e-9;
    change(&mut p);
    let inputs = Inputs { load_torque: [TORQUE; 2], planet_spin: SPIN, ..Inputs::default() };
    Simulation::start(&p, &inputs, 0.0).expect("a scene")
}

/// Blok's formula [K] for a pair at the position `s` with the load per width `load` [N/m] at cone distance `r` [m].
fn blok(pair: &Pair, motion: &Motion, (side, s): (usize, f64), r: f64, load: f64) -> f64 {
    let arcs = [pair.pitch_arc[0] + s, pair.pitch_arc[1] - s];
    let spins = [motion.spin_speed[0].abs(), (motion.side_speed[side] - motion.carrier_speed).abs()];
    let v = [0, 1].map(|i| r * spins[i] * pair.gears[i].base.cos() * arcs[i].sin());
    let radius = r * arcs[0].sin() * arcs[1].sin() / (arcs[0] + arcs[1]).sin();
    let half_width = (4.0 * load * radius / (PI * MODULUS)).sqrt();
    let sliding = (v[0] - v[1]).abs();
    let mu = COEFFICIENT * sliding / sliding.hypot(REGULARISATION);
    0.785_983 * mu * load * sliding / (half_width.sqrt() * EFFUSIVITY * (v[0].sqrt() + v[1].sqrt()))
}

/// Torque of a pair about the pole of the plane of action [N·m].
fn torque(all: &[ToothLoad], mesh: &(usize, usize, bevel_differential::contact::pairs::Flank, f64)) -> f64 {
    let of = all.iter().filter(|l| (l.planet, l.side, l.flank, l.s) == *mesh);
    of.map(|l| l.normal * l.cone).sum()
}

#[test]
fn flash_temperature_of_aligned_teeth_is_largest_at_the_heel_and_matches_blok_s_formula() {
    let pair = Pair::new(&GearSpec::default());
    let (inner, outer) = (pair.inner_cone, pair.outer_cone);
    for law in [ContactLaw::Line, ContactLaw::LineWeber] {
        let mut simulation = rolling(law, None, |_| {});
        let (mut checked, mut hottest) = (0, 0.0f64);
        for step in 1..=60 {
            simulation.advance(1e-3 * f64::from(step)).expect("a step");
            let (all, motion) = (loads(&simulation), simulation.motion());
            if all.iter().any(|load| load.spot != Spot::Path) {
                continue;
            }
            // w = ωR with the same ω over the whole face
            let moment = (outer.powi(3) - inner.powi(3)) / 3.0;
            let heel = |mesh: &(usize, usize, _, f64)| {
                blok(&pair, &motion, (mesh.1, mesh.3), outer, outer * torque(&all, mesh) / moment)
            };
            let expected = pairs_of(&all).iter().map(heel).fold(0.0, f64::max);
            let flash = reading(&mut simulation, "temperature.flash");
            close(flash, expected, 1e-5);
            let contact = reading(&mut simulation, "temperature.contact");
            assert!((contact - flash - 353.15).abs() < 1e-9, "{contact} {flash}");
            (checked, hottest) = (checked + 1, hottest.max(flash));
        }
        println!("{law:?}: {checked} instants, hottest {hottest:.3} K");
        assert!(checked > 20 && hottest > 30.0, "{checked} {hottest}");
    }
}

/// Largest flash temperature of teeth with crowning and tilted shafts, by a fine search over each face. The approach is
/// chosen so that the torque of the pair is balanced.
fn searched(pair: &Pair, spring: &AnySpring, e: &ToothErrorSpec, simulation: &Simulation) -> (f64, f64) {
    let (all, motion) = (loads(simulation), simulation.motion());
    let (inner, outer) = (pair.inner_cone, pair.outer_cone);
    let count = 4000;
    let width = (outer - inner) / f64::from(count);
    let opening = |side: usize, r: f64| {
        let x = (r - pair.mean_cone) / (0.5 * (outer - inner));
        let tilt = if side == 0 { e.shaft_angle_error } else { -e.shaft_angle_error };
        e.crowning * x * x + r * pair.pressure_angle.sin() * tilt
    };
    let mut hottest = (0.0, 0.0);
    for mesh in pairs_of(&all) {
        let (side, s) = (mesh.1, mesh.3);
        let omega = |a: f64, r: f64| {
            let arc = a - opening(side, r) / r;
            if arc > 0.0 { spring.at(arc, s).torque } else { 0.0 }
        };
        let cone = |j: i32| inner + (f64::from(j) + 0.5) * width;
        let moment = |a: f64| (0..count).map(|j| omega(a, cone(j)) * cone(j).powi(2) * width).sum::<f64>();
        let (torque, mut low, mut high) = (torque(&all, &mesh), -0.01, 0.02);
        for _ in 0..60 {
            let a = 0.5 * (low + high);
            if moment(a) < torque { low = a } else { high = a }
        }
        for r in (0..=count).map(|j| inner + f64::from(j) * width) {
            let flash = blok(pair, &motion, (side, s), r, r * omega(high, r));
            if flash > hottest.0 {
                hottest = (flash, r);
            }
        }
    }
    hottest
}

#[test]
fn the_largest_flash_temperature_matches_a_fine_search_inside_the_face_and_at_both_ends() {
    let pair = Pair::new(&GearSpec::default());
    let none = ToothErrorSpec::default();
    let cases = [
        ("aligned", none),
        ("crowned", ToothErrorSpec { crowning: 40e-6, ..none }),
        ("leaning", ToothErrorSpec { shaft_angle_error: 4e-3, ..none }),
        ("leaning and crowned", ToothErrorSpec { shaft_angle_error: -2e-3, crowning: 60e-6, ..none }),
    ];
    let (mut inside, mut at_the_end) = (false, false);
    for (law, kind) in [(ContactLaw::Line, Kind::Line), (ContactLaw::LineWeber, Kind::LineWeber)] {
        let spring = Built::new(&pair, kind).spring;
        for (name, errors) in &cases {
            let mut simulation = rolling(law, Some(errors), |p| p.contact.damping = 0.0);
            simulation.advance(3.7e-3).expect("a step");
            if loads(&simulation).iter().any(|load| load.spot != Spot::Path) {
                simulation.advance(8.7e-3).expect("a step");
            }
            assert!(loads(&simulation).iter().all(|load| load.spot == Spot::Path), "{name}");
            let (expected, cone) = searched(&pair, &spring, errors, &simulation);
            let flash = reading(&mut simulation, "temperature.flash");
            println!("{law:?}, {name}: {flash:.4} K, expected {expected:.4} K at {:.2} mm", 1e3 * cone);
            close(flash, expected, 2e-4);
            inside |= cone > pair.inner_cone + 1e-3 && cone < pair.outer_cone - 1e-3;
            at_the_end |= cone == pair.outer_cone;
        }
    }
    assert!(inside && at_the_end);
}

#[test]
fn temperatures_are_continuous_in_every_error() {
    // Flanks with a deflection of 10 μm that come nearer by 1e-12 m are loaded more by 1e-7, which is 4e-6 K of 40 K.
    // An offset of the axes moves whole flanks.
    let errors: [(&str, Set); 9] = [
        ("nothing", |_, _| {}),
        ("crowning", |e, x| e.crowning = x),
        ("planet relief", |e, x| e.planet_tip_relief = x),
        ("side relief", |e, x| e.side_tip_relief = x),
        ("planet runout", |e, x| e.planet_runout = x),
        ("side runout", |e, x| e.side_runout = x),
        ("side offset", |e, x| e.side_axial_offset = x),
        ("axis offset", |e, x| e.axis_offset = -0.2 * x),
        ("shaft angle", |e, x| e.shaft_angle_error = x / 0.04),
    ];
    for law in [ContactLaw::Line, ContactLaw::LineWeber] {
        // the published law is more sensitive: 1e-12 m of crowning changes temperatures by 3e-6 K, and a tenth of it by
        // a tenth
        for (friction, largest) in [(FrictionLaw::CoulombStribeck, 1e-12), (FrictionLaw::BenedictKelley, 1e-13)] {
            let course = |errors: Option<&ToothErrorSpec>| -> Vec<[f64; 3]> {
                let mut simulation = rolling(law, errors, |p| p.specs.tooth_friction.law = friction);
                (1..=20)
                    .map(|step| {
                        simulation.advance(2e-3 * f64::from(step)).expect("a step");
                        ["temperature.flash", "temperature.contact", "safety.scuffing"]
                            .map(|name| reading(&mut simulation, name))
                    })
                    .collect()
            };
            let plain = course(None);
            assert!(plain.iter().any(|reading| reading[0] > 10.0));
            for (name, set) in errors {
                for size in [1e-14, largest] {
                    let mut spec = ToothErrorSpec::default();
                    set(&mut spec, size);
                    let jump = course(Some(&spec)).iter().zip(&plain).fold([0.0f64; 3], |largest, (a, b)| {
                        std::array::from_fn(|i| largest[i].max((a[i] - b[i]).abs()))
                    });
                    assert!(jump.iter().all(|jump| *jump < 1e-6), "{law:?}, {friction:?}, {name}: {jump:?}");
                }
            }
        }
    }
}
