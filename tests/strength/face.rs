//! Load that differs over the face: closed forms of K_Hβ and N_F, and cases in which the factor is 1.

use crate::loads::{TORQUE, close, loads, pairs_of, reading, standing};
use crate::mesh_laws::{Built, Kind, UNDAMPED};
use crate::tooth_errors::every_kind;
use bevel_differential::contact::ContactLaw;
use bevel_differential::contact::detailed::{Detailed, Face, KnownSlice, Opening};
use bevel_differential::contact::errors::{MeshId, PairId, ToothErrorSpec, ToothErrors};
use bevel_differential::contact::pairs::Flank;
use bevel_differential::geometry::{GearSpec, Pair};
use bevel_differential::model::{Changes, GearContact, Inputs, Parameters, PlanetSpin, Simulation, readings};
use bevel_differential::numeric::Jet;
use bevel_differential::strength::RootStressFactors;
use bevel_differential::strength::face_load::{exponent, exponent_of, root_factor};

#[test]
fn the_exponent_matches_the_standard_and_wide_teeth_follow_the_load_closely() {
    // (b/h)² = 9 and 100
    close(exponent(3.0), 9.0 / 13.0, 1e-15);
    close(exponent(10.0), 100.0 / 111.0, 1e-15);
    for narrow in [2.9, 0.1, 0.0, -1.0, f64::NAN] {
        assert_eq!(exponent(narrow), exponent(3.0));
    }
    assert_eq!(root_factor(1.0, exponent(4.0)), 1.0);
    close(root_factor(4.0, 0.5), 2.0, 1e-15);
    // depth at the mean section from tip and root cones; the deeper tooth determines it
    for (module, planet_teeth, side_teeth) in [(4.5, 10, 16), (1.2, 40, 60)] {
        let spec =
            GearSpec { module: module * 1e-3, planet_teeth, side_teeth, face_width: 14e-3, ..GearSpec::default() };
        let pair = Pair::new(&spec);
        let depth = |i: usize| {
            let gear = &pair.gears[i];
            pair.mean_cone * ((gear.tip - gear.pitch).tan() + (gear.pitch - gear.root).tan())
        };
        let ratio = 14e-3 / depth(0).max(depth(1));
        println!("m = {module} mm: b/h = {ratio:.3}, N_F = {:.4}", exponent_of(&pair));
        close(exponent_of(&pair), exponent(ratio), 1e-13);
    }
    close(exponent_of(&Pair::new(&GearSpec::default())), 9.0 / 13.0, 1e-15);
}

/// A mesh under the linear law whose loads differ over the face.
fn linear_mesh(pair: &Pair) -> Detailed {
    let spring = Built::new(pair, Kind::Line).spring;
    Detailed::new(pair, spring, UNDAMPED, Face::linear(pair.inner_cone, pair.outer_cone), false, None)
}

/// An opening that is the same at every position.
fn level(even: f64, turn: f64) -> Opening {
    Opening { even: Jet { v: even, d: 0.0, dd: 0.0 }, turn, ..Opening::NONE }
}

#[test]
fn a_displaced_gear_shifts_the_load_as_in_its_closed_form() {
    let pair = Pair::new(&GearSpec { backlash: 1e-4, ..GearSpec::default() });
    let (inner, outer) = (pair.inner_cone, pair.outer_cone);
    let mesh = linear_mesh(&pair);
    let centroid = 2.0 / 3.0 * (outer.powi(3) - inner.powi(3)) / (outer.powi(2) - inner.powi(2));
    let (s, approach) = (0.05, 1e-3);
    let factor = |opening: Opening, cone: f64| {
        let known = KnownSlice { cone, arc: approach - opening.at(cone) / cone, s };
        mesh.face_load_factor(&known, &opening)
    };
    for e in [8e-6, -8e-6, 15e-6] {
        // ω ∝ a − e/R on the whole face; the mean of 1/R with the weight R² is 1/R_F
        assert!(approach * inner > e);
        let end = if e > 0.0 { outer } else { inner };
        let expected = (approach - e / end) / (approach - e / centroid);
        for cone in [inner, 30e-3, outer] {
            close(factor(level(e, 0.0), cone), expected, 1e-12);
        }
    }
    // lifted off the toe, the face is loaded from R₀ = e/a on: ∫(aR² − eR)dR = a(R_e³ − R₀³)/3 − e(R_e² − R₀²)/2
    let e = 30e-6;
    let from = e / approach;
    let torque = approach * (outer.powi(3) - from.powi(3)) / 3.0 - e * (outer.powi(2) - from.powi(2)) / 2.0;
    let expected = (approach - e / outer) * (outer.powi(3) - inner.powi(3)) / 3.0 / torque;
    close(factor(level(e, 0.0), outer), expected, 1e-12);
    // a rotation about the apex and a pitch deviation open every section by the same arc
    for slope in [2e-4, -5e-4] {
        close(factor(level(0.0, slope), inner), 1.0, 1e-12);
    }
    // without the heel, the remaining face is loaded evenly, over a smaller moment
    let edge = inner + 0.6 * (outer - inner);
    let broken = Opening { edge: Some((edge, 1e-3)), ..Opening::NONE };
    let known = KnownSlice { cone: inner, arc: approach, s };
    let left = (outer.powi(3) - inner.powi(3)) / (edge.powi(3) - inner.powi(3));
    close(mesh.face_load_factor(&known, &broken), left, 1e-12);
}

/// Largest root stress of all pairs without face load factors [Pa]. A mesh with a `single` spring has the stress of method
/// B1.
fn even_stress(simulation: &Simulation, root: &RootStressFactors, single: bool) -> f64 {
    let all = loads(simulation);
    let stress = |mesh: &(usize, usize, Flank, f64)| {
        let of = all.iter().filter(|l| (l.planet, l.side, l.flank, l.s) == *mesh);
        let force = of.map(|l| l.normal * l.cone).sum::<f64>() / simulation.pair().mean_cone;
        force * if single { root.per_force } else { root.per_force_at(mesh.3) }
    };
    pairs_of(&all).iter().map(stress).fold(0.0, f64::max)
}

#[test]
fn aligned_unmodified_teeth_have_the_root_stress_of_their_mean_load() {
    for (detail, law, contact) in [
        (0, ContactLaw::Impact, GearContact::Tooth),
        (0, ContactLaw::Line, GearContact::Tooth),
        (0, ContactLaw::Line, GearContact::Lumped),
        (0, ContactLaw::Impact, GearContact::Solid),
        (1, ContactLaw::Impact, GearContact::Tooth),
        (1, ContactLaw::Line, GearContact::Tooth),
        (2, ContactLaw::LineWeber, GearContact::Tooth),
        (3, ContactLaw::Line, GearContact::Tooth),
        (4, ContactLaw::LineWeber, GearContact::Tooth),
    ] {
        let mut p = Parameters::default();
        p.effects.strength = true;
        p.scene.gear_contact = contact;
        p.contact.law = law;
        // detailed for other reasons; a tooth that has not broken yet also requires slices
        p.effects.tooth_friction = detail == 1 || detail == 2;
        p.effects.tooth_fault = detail == 2 || detail == 3;
        p.effects.tooth_errors = detail == 4;
        // errors that are uniform over the face
        p.specs.tooth_errors.accuracy_grade = if detail == 4 { 8 } else { 0 };
        p.specs.tooth_errors.shaft_angle_error = if detail == 4 { 2e-3 } else { 0.0 };
        p.scene.planet_spin = PlanetSpin::Imposed;
        let inputs = Inputs { planet_spin: 20.0, load_torque: [TORQUE; 2], ..Inputs::default() };
        let mut simulation = Simulation::start(&p, &inputs, 0.0).expect("a scene");
        let pair = *simulation.pair();
        let roots = [0, 1].map(|i| RootStressFactors::new(&pair, i, 0.25).unwrap());
        for k in 1..=20 {
            simulation.advance(f64::from(k) * 1e-3).expect("a step");
            for (name, root) in ["stress.root_planet_max", "stress.root_side_max"].iter().zip(&roots) {
                let expected = even_stress(&simulation, root, contact == GearContact::Lumped);
                close(reading(&mut simulation, name), expected, 1e-12);
            }
        }
    }
}

#[test]
fn laws_with_one_resultant_and_solids_on_their_apex_have_an_even_load_by_definition() {
    let crowned = ToothErrorSpec { crowning: 60e-6, ..ToothErrorSpec::default() };
    let pair = Pair::new(&GearSpec::default());
    let root = RootStressFactors::new(&pair, 0, 0.25).unwrap();
    let mut simulation = standing(ContactLaw::Impact, &crowned);
    let expected = even_stress(&simulation, &root, false);
    close(reading(&mut simulation, "stress.root_planet_max"), expected, 1e-12);
    // a leaning shaft turns solids about their apex, so one section represents all
    let mut p = Parameters::default();
    (p.effects.strength, p.effects.tooth_errors) = (true, true);
    p.scene.gear_contact = GearContact::Solid;
    p.specs.tooth_errors.shaft_angle_error = 2e-3;
    let inputs = Inputs { load_torque: [TORQUE; 2], ..Inputs::default() };
    let mut solid = Simulation::start(&p, &inputs, 0.0).expect("a scene");
    let expected = even_stress(&solid, &root, false);
    close(reading(&mut solid, "stress.root_planet_max"), expected, 1e-12);
}

#[test]
fn an_application_factor_multiplies_the_load() {
    let by_step = || readings().filter(|reading| reading.changes == Changes::ByStep);
    let rated = |factor: f64| {
        let mut p = Parameters::default();
        p.effects.strength = true;
        p.specs.strength.application_factor = factor;
        p.scene.planet_spin = PlanetSpin::Imposed;
        let inputs = Inputs { planet_spin: 20.0, load_torque: [TORQUE; 2], ..Inputs::default() };
        let mut simulation = Simulation::start(&p, &inputs, 0.0).expect("a scene");
        simulation.advance(0.5).expect("a step");
        let names = ["stress.root_planet_max", "stress.root_side_max", "stress.contact_max", "stress.contact_pitch"];
        let stresses = names.map(|name| reading(&mut simulation, name));
        let ledger = simulation.ledger().readings;
        let damage = ["damage.planet", "damage.planet_flank"]
            .map(|name| ledger[by_step().position(|r| r.name == name).unwrap()]);
        (stresses, damage)
    };
    let ((one, harm), (more, harms)) = (rated(1.0), rated(1.3));
    for i in 0..4 {
        close(more[i] / one[i], if i < 2 { 1.3 } else { 1.3f64.sqrt() }, 1e-12);
    }
    // slopes of the S–N curves from the life factors 2.5 at 10³ of 3·10⁶ cycles and 1.6 at 10⁵ of 5·10⁷ cycles
    close(harms[0] / harm[0], 1.3f64.powf(3000f64.ln() / 2.5f64.ln()), 1e-9);
    close(harms[1] / harm[1], 1.3f64.powf(0.5 * 500f64.ln() / 1.6f64.ln()), 1e-9);
}

#[test]
fn openings_are_parabolas_over_the_face_so_that_their_largest_load_is_found() {
    let pair = Pair::new(&GearSpec::default());
    let errors = ToothErrors::new(&every_kind(), &pair, 2).unwrap();
    for (planet, side, flank) in [(0, 0, Flank::Drive), (1, 1, Flank::Coast)] {
        for s in [-0.15, 0.0, 0.2] {
            let teeth = PairId { planet_tooth: 4, side_tooth: 7, flank };
            let e = |k: f64| errors.gap(MeshId { planet, side }, teeth, pair.inner_cone + 6e-3 * k, s);
            let third = e(3.0) - 3.0 * e(2.0) + 3.0 * e(1.0) - e(0.0);
            assert!(e(1.0).abs() > 1e-7 && third.abs() < 1e-18, "{third:e}");
        }
    }
}
