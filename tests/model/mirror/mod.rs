//! Symmetry of the whole program: a differential and its mirror images must do the same.
//!
//! A differential that is reflected, with all speeds and torques reflected too, is one that could be built, and it must do
//! what the other does. How each variable maps stands in `tests/data/symmetry.csv`; the images of a scene are simulated,
//! and every output is compared. Where a motion is chaotic, rounding grows until nothing can be said: twins that are
//! disturbed by 1e-15 show how far a comparison reaches.

mod bias;
mod compare;
mod image;
pub mod random;
pub mod scene;
mod table;
mod teeth;

use compare::{Findings, compare};
use scene::Scene;
use table::lines;
use teeth::View;

/// Random scenes that are reversed, and that are looked at otherwise.
const REVERSED: usize = 100;
const OTHERWISE: usize = 20;
/// Scenes among the reversed ones whose planets roll over some teeth.
const ROLLING: usize = 10;
/// Least part of all values that twins let compare, and of the values of any one output.
const SHARE: f64 = 0.7;
const SHARE_OF_ONE: f64 = 0.2;

/// Per scene, images that take steps of their own where their twins do not: one in twenty, as far as so few scenes tell,
/// to two standard deviations.
const ALONE: f64 = 0.05;
const DEVIATIONS: f64 = 2.0;

/// Compares a scene with its image; `None` if there is no such scene.
fn compared(scene: &Scene, view: View) -> Option<Findings> {
    let base = scene.run().ok()?;
    let twins = [1.0, -1.0].map(|sign| scene.disturbed(sign).run());
    let twins: Vec<_> = twins.into_iter().collect::<Result<_, _>>().ok()?;
    let mut image = scene.image(view);
    image.from = scene.image_of_start(view, &base.start, &base.layout);
    let image = image.run().unwrap_or_else(|problems| panic!("the image cannot be built: {problems:?}"));
    Some(compare(scene, &base, &twins, &image, &scene.map(view)))
}

/// Compares `count` random scenes, from number `first` on, with their images.
fn survey(view: View, first: u64, count: usize) -> Findings {
    survey_of(random::scene, view, first, count)
}

/// Scene number `index` with parts that warm up, and with friction that depends on speed and temperature.
fn warm(index: u64) -> Option<Scene> {
    let Scene { mut parameters, inputs, steps, .. } = random::scene(index)?;
    random::warm(&mut random::Draw::new(index ^ random::WARM), &mut parameters);
    Scene::new(parameters, inputs, steps).ok()
}

/// Compares `count` of the scenes that `draw` gives, from number `first` on, with their images.
fn survey_of(draw: fn(u64) -> Option<Scene>, view: View, first: u64, count: usize) -> Findings {
    let mut all = Findings::new();
    for index in first.. {
        if all.scenes >= count {
            break;
        }
        let Some(scene) = draw(index).and_then(|scene| fitting(scene, view)) else { continue };
        let Some(mut found) = compared(&scene, view) else { continue };
        found.wrong = found.wrong.iter().map(|wrong| format!("scene {index}: {wrong}")).collect();
        all.add(found);
    }
    all
}

/// The scene as it can be looked at, if it can.
fn fitting(mut scene: Scene, view: View) -> Option<Scene> {
    if view == View::Renumbered {
        let p = &mut scene.parameters;
        p.solver.merge_planets = false;
        let n = p.geometry.planet_count;
        if n > 2 {
            // the pins are displaced in the direction of planet 1
            p.specs.tooth_errors.axis_offset = 0.0;
        }
        // otherwise neighbours are half a pitch apart
        return (2 * p.geometry.side_teeth / n % 2 == 0).then_some(scene);
    }
    Some(scene)
}

fn report(view: View, found: &Findings) {
    println!("{view:?}: {} scenes, {:.3} of all values, largest {:?}", found.scenes, found.share(), found.largest);
    assert!(found.wrong.is_empty(), "{} differ\n{}", found.wrong.len(), found.wrong.join("\n"));
    assert!(found.share() > SHARE, "{}", found.share());
    let expected = ALONE * found.scenes as f64;
    let most = expected + DEVIATIONS * expected.sqrt();
    assert!(found.alone as f64 <= most, "{} images take steps of their own", found.alone);
}

#[test]
fn a_reversed_differential_does_the_same_in_reverse() {
    let half = REVERSED / 2;
    let mut found = std::thread::scope(|scope| {
        let other = scope.spawn(|| survey_of(warm, View::Reversed, 1000, half));
        let rolling = scope.spawn(|| survey_of(random::rolling, View::Reversed, 5000, ROLLING));
        let mut found = survey(View::Reversed, 0, half);
        found.add(other.join().expect("a survey that ends"));
        found.add(rolling.join().expect("a survey that ends"));
        found
    });
    // every output takes part, and is something else than 0 at times
    for (i, line) in lines().iter().enumerate().filter(|&(i, _)| found.compared[i][1] > 0) {
        let [compared, all] = found.compared[i].map(|count| count as f64);
        assert!(compared > SHARE_OF_ONE * all, "{} is compared in {compared} of {all} values", line.pattern);
        assert!(found.telling[i] > 0, "{} is always 0", line.pattern);
    }
    found.wrong.sort();
    report(View::Reversed, &found);
}

#[test]
fn sides_that_change_places_do_what_the_other_did() {
    report(View::Swapped, &survey_of(warm, View::Swapped, 2000, OTHERWISE));
}

#[test]
fn planets_that_change_places_do_what_the_others_did() {
    report(View::Renumbered, &survey(View::Renumbered, 3000, OTHERWISE));
}

#[test]
fn a_start_one_tooth_further_changes_nothing() {
    report(View::Shifted, &survey(View::Shifted, 4000, OTHERWISE));
}
