//! Load swings while teeth are in mesh: teeth that do not roll, teeth that roll, and all cases between.

use bevel_differential::geometry::{GearSpec, Pair};
use bevel_differential::strength::{LoadCycle, Rating, TeethInMesh, ToothStrength, ToothSums, pulsating_range};
use std::f64::consts::{PI, TAU};

const PLANETS: usize = 2;
const PER_SWING: u32 = 40;

fn rating() -> Rating {
    let pair = Pair::new(&GearSpec::default());
    Rating::new(&pair, (2.07e11, 0.25), &ToothStrength::default(), 0.25).expect("sound teeth")
}

/// Both sides under a force that oscillates `swings` times about `mean` with `amplitude` [N], while planets roll by
/// `pitches` and wind up by `windup` pitches with the force.
fn swung(rating: &Rating, [mean, amplitude]: [f64; 2], swings: u32, pitches: f64, windup: f64) -> TeethInMesh {
    let mut teeth = TeethInMesh::default();
    let steps = swings * PER_SWING;
    let wave = |at: f64| (TAU * at / f64::from(PER_SWING)).sin();
    let angle = |at: f64| rating.pitch[0] * (pitches * at / f64::from(steps) + windup * wave(at));
    for step in 0..steps {
        let at = [0.0, 0.5, 1.0].map(|part| f64::from(step) + part);
        let forces = at.map(|at| mean + amplitude * wave(at));
        teeth.add(rating, PLANETS, angle(at[2]) - angle(at[0]), [forces; 2]);
    }
    teeth
}

/// Damage of one swing to planet and side gear, at the roots in tension and in compression.
fn of_swing(rating: &Rating, [mean, amplitude]: [f64; 2]) -> [[f64; 2]; 2] {
    rating.root.map(|root| {
        [mean, -mean].map(|mean| {
            let cycle = LoadCycle { range: 2.0 * amplitude, mean, count: 1.0 };
            rating.bending[1].damage_per_cycle(root.per_force * pulsating_range(&cycle, rating.sensitivity))
        })
    })
}

fn worst(rating: &Rating, teeth: &TeethInMesh) -> [f64; 2] {
    let (planet, sides) = teeth.worst(rating, PLANETS);
    [planet, sides[0]].map(|roots| roots[0].max(roots[1]))
}

fn close(program: f64, expected: f64, relative: f64) {
    assert!((program / expected - 1.0).abs() <= relative, "program {program:e}, expected {expected:e}");
}

const LOADS: [[f64; 2]; 3] = [[8e3, 7e3], [0.0, 9e3], [-6e3, 8e3]];

#[test]
fn teeth_that_do_not_roll_count_every_swing_and_wind_up_is_not_rolling() {
    let rating = rating();
    for load in LOADS {
        for windup in [0.0, 0.1, -0.1] {
            let found = worst(&rating, &swung(&rating, load, 200, 0.0, windup));
            for (gear, [tension, compression]) in of_swing(&rating, load).into_iter().enumerate() {
                close(found[gear], 200.0 * tension.max(compression), 0.01);
            }
        }
    }
}

#[test]
fn rolling_teeth_count_all_swings_of_a_passage_but_one() {
    let rating = rating();
    // 30 swings per pitch, over 5 revolutions of the planets after the half pitch of the first tooth
    let (swings, pitches) = (1515, 50.5);
    for load in LOADS {
        for windup in [0.0, 0.1, -0.1] {
            for way in [1.0, -1.0] {
                let found = worst(&rating, &swung(&rating, load, swings, way * pitches, windup));
                let [[tension, compression], [side, other]] = of_swing(&rating, load);
                // a planet's tooth meshes once with either side gear; teeth in mesh at the start have half a passage
                // more
                let first = 15.0 * tension.max(compression);
                close(found[0], 5.0 * 29.0 * (tension + compression) + first, 0.03);
                // some of the 8 pairs of teeth have 7 of the 50 passages
                close(found[1], 7.0 * 29.0 * side.max(other), 0.03);
            }
        }
    }
}

#[test]
fn a_load_that_does_not_swing_within_a_passage_is_not_counted_here() {
    let rating = rating();
    for load in [[8e3, 0.0], [8e3, 7e3], [0.0, 9e3]] {
        // 30 or more passages per swing
        for pitches in [900.5, 1e4, 1e7] {
            let swings = if load[1] > 0.0 { 30 } else { 1 };
            let found = worst(&rating, &swung(&rating, load, swings, pitches, 0.0));
            // except in the first tooth, which was in mesh without rolling
            let one = of_swing(&rating, [8e3, 8e3]);
            for gear in 0..2 {
                assert!(found[gear] < 1e-4 * one[gear][0], "{load:?} {pitches}: {found:?} {one:?}");
            }
        }
    }
}

#[test]
fn between_no_rolling_and_rolling_damage_changes_by_single_swings() {
    let rating = rating();
    for load in LOADS {
        let one = of_swing(&rating, load).map(|[a, b]| a + b);
        let mut before = worst(&rating, &swung(&rating, load, 150, 0.0, 0.01));
        let mut pitches = 0.1;
        while pitches < 150.0 {
            let found = worst(&rating, &swung(&rating, load, 150, pitches, 0.01));
            for gear in 0..2 {
                // one swing more or less in each passage, and 5 % of all swings
                let passages = [0.2 * pitches, 0.125 * pitches][gear] + 2.0;
                let step = (found[gear] - before[gear]).abs();
                assert!(step < (passages + 0.05 * 150.0) * one[gear], "{load:?} {pitches} {gear}: {step:e} {one:?}");
            }
            before = found;
            pitches *= 1.05;
        }
    }
}

#[test]
fn the_mirror_image_and_a_saved_copy_are_the_same() {
    let rating = rating();
    let one = swung(&rating, [5e3, 7e3], 333, 21.7, 0.02);
    let mirrored = swung(&rating, [5e3, 7e3], 333, -21.7, -0.02);
    for gear in 0..2 {
        close(worst(&rating, &mirrored)[gear], worst(&rating, &one)[gear], 1e-12);
    }
    let flanks = swung(&rating, [-5e3, -7e3], 333, 21.7, 0.02);
    close(worst(&rating, &flanks)[0], worst(&rating, &one)[0], 1e-12);
    let saved = postcard::to_allocvec(&one).unwrap();
    assert_eq!(postcard::from_bytes::<TeethInMesh>(&saved).unwrap(), one);
    assert!(saved.len() < 3000, "{} bytes", saved.len());
    let too_many = postcard::to_allocvec(&vec![[1.0; 2]; 65]).unwrap();
    assert!(postcard::from_bytes::<ToothSums>(&too_many).is_err());
}

#[test]
fn gears_of_many_teeth_share_sums_of_neighbours() {
    let mut sums = ToothSums::default();
    for _ in 0..3 {
        (0..200).for_each(|tooth| sums.add((tooth, 200), [1.0, 2.0]));
    }
    assert_eq!((sums.worst(), sums.of((0, 200)), sums.of((199, 200))), ([3.0, 6.0], [3.0, 6.0], [3.0, 6.0]));
    sums.add((9, 10), [9.0, 0.0]);
    sums.add((999, 10), [99.0, 0.0]);
    assert_eq!((sums.worst(), sums.of((999, 10))), ([12.0, 6.0], [0.0; 2]));
}

#[test]
fn hostile_numbers_leave_finite_sums() {
    let rating = rating();
    let mut teeth = TeethInMesh::default();
    for angle in [f64::NAN, f64::INFINITY, 1e300, -1e300, 1e-300, PI] {
        for force in [f64::NAN, f64::INFINITY, 1e300, -1e300, 0.0, 1e4] {
            teeth.add(&rating, PLANETS, angle, [[force, -force, 0.5 * force]; 2]);
        }
    }
    assert!(worst(&rating, &teeth).into_iter().all(f64::is_finite));
    assert_eq!(TeethInMesh::default().worst(&rating, 0), ([0.0; 2], [[0.0; 2]; 2]));
}
