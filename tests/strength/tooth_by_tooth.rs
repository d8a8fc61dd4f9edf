//! Damage of the worst tooth, compared with a count that follows every tooth through the pair forces of short steps.

use crate::textbook::root;
use bevel_differential::contact::ContactLaw;
use bevel_differential::contact::pairs::Flank;
use bevel_differential::model::{
    Changes, GearContact, Inputs, Parameters, PlanetSpin, Simulation, ToothLoad, readings,
};
use bevel_differential::strength::{LineContact, Rating, RootStressFactors, ToothStrength};
use std::collections::HashMap;

const TORQUE: f64 = 835.0;
/// Step at which the pair forces are read [s].
const STEP: f64 = 2e-4;

/// Damage of the worst teeth: roots of planet and side gear, then their flanks.
fn damage(simulation: &mut Simulation) -> [f64; 4] {
    let ledger = simulation.ledger().readings;
    let by_step = |name: &str| {
        readings()
            .filter(|reading| reading.changes == Changes::ByStep)
            .position(|reading| reading.name == name)
            .unwrap()
    };
    ["damage.planet", "damage.side", "damage.planet_flank", "damage.side_flank"].map(|name| ledger[by_step(name)])
}

/// A tooth: gear (left, right, then planets) and number.
type Tooth = (usize, usize);

/// Root stress of every loaded tooth [Pa], positive under load on one flank, and the loaded pairs by mesh, flank and
/// teeth with their force at the cone distance of the resultant [N] and position [rad].
struct Now {
    stress: HashMap<Tooth, f64>,
    pairs: HashMap<(usize, usize, bool, [usize; 2]), (f64, f64)>,
}

fn now(simulation: &Simulation, factors: &[RootStressFactors; 2]) -> Now {
    let (mut stress, mut pairs) = (HashMap::new(), HashMap::new());
    let mean_cone = simulation.pair().mean_cone;
    simulation.tooth_loads(|load: &ToothLoad| {
        let drives = load.flank == Flank::Drive;
        let ToothLoad { planet, side, teeth, s, .. } = *load;
        let at_mean = load.normal * load.cone / mean_cone;
        let signs = [drives == (side == 0), drives].map(|first| if first { 1.0 } else { -1.0 });
        *stress.entry((2 + planet, teeth[0])).or_insert(0.0) += signs[0] * at_mean * factors[0].per_force_at(s);
        *stress.entry((side, teeth[1])).or_insert(0.0) += signs[1] * at_mean * factors[1].per_force_at(s);
        pairs.entry((planet, side, drives, teeth)).or_insert((0.0, s)).0 += load.normal;
    });
    Now { stress, pairs }
}

/// Damage by the program and by this count. The planets spin at `spin(t)` [rad/s], held over each step, under equal
/// `loads` [N·m] for `stop` seconds.
fn counted(mut p: Parameters, loads: [f64; 2], spin: impl Fn(f64) -> f64, stop: f64) -> ([f64; 4], [f64; 4]) {
    p.effects.strength = true;
    // every planet is simulated, so that every tooth is visible
    p.solver.merge_planets = false;
    p.scene.gear_contact = GearContact::Tooth;
    p.contact.law = ContactLaw::Line;
    p.scene.planet_spin = PlanetSpin::Imposed;
    let inputs = |t: f64| Inputs { carrier_speed: 20.0, planet_spin: spin(t), load_torque: loads, ..Inputs::default() };
    let mut simulation = Simulation::start(&p, &inputs(0.0), 0.0).expect("a scene");
    let pair = *simulation.pair();
    let material = ToothStrength::default();
    let rating = Rating::new(&pair, (2.07e11, 0.25), &material, 0.25).unwrap();
    let rated = LineContact::new(&pair, 2.07e11, 0.25).rated_position();
    let (mut histories, mut flanks) = (HashMap::<Tooth, Vec<f64>>::new(), HashMap::<(usize, usize, bool), f64>::new());
    let mut before = now(&simulation, &rating.root);
    for (&tooth, &stress) in &before.stress {
        histories.insert(tooth, vec![stress]);
    }
    for k in 1..=(stop / STEP).round() as usize {
        simulation.set_inputs(&inputs((k as f64 - 0.5) * STEP));
        simulation.advance(k as f64 * STEP).expect("a step");
        let after = now(&simulation, &rating.root);
        for tooth in before.stress.keys().chain(after.stress.keys()) {
            histories.entry(*tooth).or_insert_with(|| vec![0.0]).push(after.stress.get(tooth).copied().unwrap_or(0.0));
        }
        // a pair on both sides of the rated point has passed it, under the whole force of its mesh
        for (key, (_, s)) in &after.pairs {
            let Some((_, from)) = before.pairs.get(key) else { continue };
            if (s - rated) * (from - rated) < 0.0 {
                let &(planet, side, drives, teeth) = key;
                let of_mesh =
                    after.pairs.iter().filter(|(other, _)| (other.0, other.1, other.2) == (planet, side, drives));
                let force = of_mesh.map(|(_, (force, _))| force).sum::<f64>();
                let cycle = rating.pitting.damage_per_cycle(rating.contact.rated_pressure(force).unwrap());
                *flanks.entry((2 + planet, teeth[0], drives == (side == 0))).or_insert(0.0) += cycle;
                *flanks.entry((side, teeth[1], drives)).or_insert(0.0) += cycle;
            }
        }
        before = after;
    }
    let worst = |is_planet: bool| {
        let of = histories.iter().filter(|((gear, _), _)| (*gear > 1) == is_planet);
        of.map(|(_, history)| root(history, &material).0).fold(0.0, f64::max)
    };
    let worst_flank = |is_planet: bool| {
        let of = flanks.iter().filter(|((gear, ..), _)| (*gear > 1) == is_planet);
        of.map(|(_, damage)| *damage).fold(0.0, f64::max)
    };
    let expected = [worst(true), worst(false), worst_flank(true), worst_flank(false)];
    (damage(&mut simulation), expected)
}

fn close(found: [f64; 4], expected: [f64; 4], relative: f64, case: &str) {
    println!("{case}: {found:?} {expected:?}");
    for (found, expected) in found.into_iter().zip(expected) {
        assert!((found - expected).abs() <= relative * expected, "{case}: {found:e}, expected {expected:e}");
    }
}

/// Roll to and fro without jumps of the speed, by `pitches` pitches in a second.
fn to_and_fro(pitches: f64) -> impl Fn(f64) -> f64 {
    let pitch = std::f64::consts::TAU / 10.0;
    move |t| 0.5 * pitches * pitch * std::f64::consts::TAU * (std::f64::consts::TAU * t).sin()
}

#[test]
fn teeth_that_roll_to_and_fro_are_counted_each_time() {
    for (pitches, loads) in [
        (0.5, [835.0; 2]),
        (0.8, [835.0; 2]),
        (1.4, [600.0, 900.0]),
        (2.0, [-835.0; 2]),
        (3.3, [835.0; 2]),
        (5.0, [700.0, 500.0]),
    ] {
        let (found, expected) = counted(Parameters::default(), loads, to_and_fro(pitches), 2.0);
        close(found, expected, 0.05, &format!("{pitches} pitches"));
    }
}

#[test]
fn the_worst_tooth_of_gears_with_pitch_errors_counts() {
    for (grade, seed) in [(5, 1), (7, 3), (9, 2)] {
        let mut p = Parameters::default();
        p.effects.tooth_errors = true;
        (p.specs.tooth_errors.accuracy_grade, p.specs.tooth_errors.seed) = (grade, seed);
        let (found, expected) = counted(p, [TORQUE; 2], |_| 12.0, 1.2);
        close(found, expected, 0.05, &format!("grade {grade}"));
    }
}
