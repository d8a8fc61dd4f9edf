//! Loaded tooth pairs as outputs: their sum, their motion along the flank, their pressure, and mirror images.

use std::collections::HashMap;
use std::f64::consts::PI;

use bevel_differential::contact::ContactLaw;
use bevel_differential::contact::pairs::Spot;
use bevel_differential::geometry::Pair;
use bevel_differential::geometry::action::LineOfAction;
use bevel_differential::model::{GearContact, Inputs, PairLine, Parameters, PlanetSpin, Simulation, Start};

/// Turn that starts in equilibrium.
fn turn(law: ContactLaw, sense: f64) -> (Parameters, Inputs) {
    let mut p = Parameters::default();
    p.contact.law = law;
    p.scene.planet_spin = PlanetSpin::Imposed;
    p.scene.start = Start::Equilibrium;
    let inputs = Inputs {
        carrier_speed: sense * 10.0,
        planet_spin: sense * 200f64.to_radians(),
        load_torque: [sense * 835.0; 2],
        ..Inputs::default()
    };
    (p, inputs)
}

/// Runs the scene and calls `look` every millisecond.
fn watch((p, inputs): (Parameters, Inputs), points: usize, mut look: impl FnMut(&mut Simulation, Vec<PairLine>)) {
    let mut simulation = Simulation::start(&p, &inputs, 0.0).expect("a scene");
    for k in 1..=points {
        simulation.advance(k as f64 * 1e-3).expect("a step");
        let lines = simulation.pair_lines();
        look(&mut simulation, lines.into_iter().filter(|line| line.tooth >= 0.0).collect());
    }
}

/// Hertz pressure of two cylinders under a load per width [N/m], from their radii [m].
fn hertz(p: &Parameters, line_load: f64, radii: [f64; 2]) -> f64 {
    let modulus = p.material.young_modulus / (2.0 * (1.0 - p.material.poisson_ratio.powi(2)));
    let radius = 1.0 / (1.0 / radii[0] + 1.0 / radii[1]);
    (line_load * modulus / (PI * radius)).sqrt()
}

/// Arc from the base circle's tangent point to the contact [rad]: cosφ = cosδ_b cosψ.
fn arc(pair: &Pair, line: &PairLine) -> f64 {
    let planet = &pair.gears[0];
    let polar = planet.pitch + line.height / pair.mean_cone;
    (polar.cos() / planet.base.cos()).acos()
}

/// Kind of contact and polar angle on the planet [rad] for each planet tooth, from the points of the line of action.
fn contacts(simulation: &Simulation, pair: &Pair) -> HashMap<usize, (Spot, f64)> {
    let action = LineOfAction::new(pair);
    let mut all = HashMap::new();
    simulation.tooth_loads(|load| {
        if (load.planet, load.side) == (0, 0) {
            let point = load.contact(&action).point;
            all.insert(load.teeth[0], (load.spot, point.z.acos()));
        }
    });
    all
}

#[test]
fn pairs_add_up_to_the_mesh_and_move_along_the_flank_as_the_planet_turns() {
    for law in [ContactLaw::Impact, ContactLaw::Line, ContactLaw::LineWeber] {
        let mut before: Vec<(f64, f64, f64)> = Vec::new();
        let (mut moved, mut corners) = (0, 0);
        watch(turn(law, 1.0), 400, |simulation, lines| {
            let pair = *simulation.pair();
            let forces = *simulation.forces();
            let sum: f64 = lines.iter().map(|line| line.force.abs()).sum();
            assert!((sum / forces.mesh[0][0].normal - 1.0).abs() < 1e-12);
            assert_eq!(lines.len() as f64, forces.mesh[0][0].pairs);
            assert!(lines.windows(2).all(|two| two[0].height < two[1].height));
            let spin = simulation.motion().spin_angle[0];
            let contacts = contacts(simulation, &pair);
            let mut now = Vec::new();
            for line in &lines {
                let (spot, polar) = contacts[&(line.tooth as usize)];
                assert!((line.height - pair.mean_cone * (polar - pair.gears[0].pitch)).abs() < 1e-12, "{spot:?}");
                corners += usize::from(spot != Spot::Path);
                if spot == Spot::Path {
                    now.push((line.tooth, arc(&pair, line), spin));
                }
            }
            for &(tooth, psi, spin) in &now {
                let Some(&(_, psi_before, spin_before)) = before.iter().find(|old| old.0 == tooth) else { continue };
                // a base circle of sinδ_b unrolls as the planet turns
                let unrolled = pair.gears[0].base.sin() * (spin - spin_before);
                assert!(((psi - psi_before).abs() - unrolled.abs()).abs() < 1e-9, "{psi} {psi_before} {unrolled}");
                moved += 1;
            }
            before = now;
        });
        assert!(moved > 200 && corners > 0, "{moved} on the path, {corners} at corners");
    }
}

#[test]
fn pressure_is_that_of_two_cylinders_with_the_radii_of_both_flanks() {
    for law in [ContactLaw::Impact, ContactLaw::Line] {
        let (p, inputs) = turn(law, 1.0);
        watch((p, inputs), 100, |simulation, lines| {
            let pair = *simulation.pair();
            for line in lines {
                if contacts(simulation, &pair)[&(line.tooth as usize)].0 != Spot::Path {
                    continue;
                }
                let psi = arc(&pair, &line);
                let other = pair.pitch_arc[0] + pair.pitch_arc[1] - psi;
                let (inner, outer) = (pair.inner_cone, pair.outer_cone);
                for (cone, pressure) in [inner, pair.mean_cone, outer].into_iter().zip(line.pressure) {
                    let even = line.force / (outer - inner);
                    // penetration of a line law grows with the cone distance, and so does its load
                    let line_load = if law == ContactLaw::Line { even * cone / pair.mean_cone } else { even };
                    let wanted = hertz(&p, line_load, [cone * psi.tan(), cone * other.tan()]);
                    assert!((pressure / wanted - 1.0).abs() < 1e-9, "{law:?} at {cone}: {pressure} {wanted}");
                }
            }
        });
    }
}

#[test]
fn crowned_teeth_press_in_the_middle_and_displaced_ones_at_an_end() {
    let ends = |crowning: f64, offset: f64, solid: bool| {
        let (mut p, inputs) = turn(ContactLaw::Line, 1.0);
        p.effects.tooth_errors = true;
        p.specs.tooth_errors.crowning = crowning;
        p.specs.tooth_errors.side_axial_offset = offset;
        if solid {
            p.contact.law = ContactLaw::Impact;
            p.scene.gear_contact = GearContact::Solid;
        }
        let mut sums = [0.0; 3];
        watch((p, inputs), 20, |_, lines| {
            for line in lines {
                (0..3).for_each(|i| sums[i] += line.pressure[i]);
            }
        });
        sums
    };
    for solid in [false, true] {
        let [toe, middle, heel] = ends(4e-5, 0.0, solid);
        assert!(middle > toe && middle > heel, "{toe} {middle} {heel}");
        // if the side gear is displaced outward, the heel carries more than if it is displaced inward
        let ([toe, _, heel], [toe_in, _, heel_in]) = (ends(0.0, 5e-5, solid), ends(0.0, -5e-5, solid));
        assert!(heel / toe > heel_in / toe_in, "{heel} {toe} {heel_in} {toe_in}");
    }
}

#[test]
fn the_mirrored_turn_is_on_the_other_flank_at_the_same_heights_and_pressures() {
    let record = |sense: f64| {
        let mut all = Vec::new();
        watch(turn(ContactLaw::LineWeber, sense), 50, |_, lines| all.push(lines));
        all
    };
    let (drive, coast) = (record(1.0), record(-1.0));
    assert!(drive.iter().flatten().all(|line| line.force > 0.0));
    for (one, other) in drive.iter().zip(&coast) {
        assert_eq!(one.len(), other.len());
        for (a, b) in one.iter().zip(other) {
            assert_eq!((a.force, a.height, a.pressure), (-b.force, b.height, b.pressure));
        }
    }
}

#[test]
fn without_teeth_there_are_no_pairs() {
    for level in [GearContact::Ideal, GearContact::Lumped] {
        let (mut p, inputs) = turn(ContactLaw::Line, 1.0);
        p.scene.gear_contact = level;
        watch((p, inputs), 3, |simulation, lines| {
            assert!(simulation.forces().mesh[0][0].normal > 0.0);
            assert!(lines.is_empty());
        });
    }
}
