//! Symmetry of the whole program: a differential and its mirror images must behave identically.
//!
//! A reflected differential, with all speeds and torques reflected as well, could be built, and its motion must be the
//! reflected motion. `tests/data/symmetry.csv` describes how each variable maps. The images of a scene are simulated,
//! and every output is compared. In a chaotic motion, rounding errors grow until a comparison is meaningless. Twins,
//! which are disturbed by 1e-15, show how long a comparison is valid.

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

/// Number of random scenes of a survey.
const SCENES: usize = 50;
/// Number of scenes of a survey that are compared in all views; the others are compared only in the first view.
const IN_ALL_VIEWS: usize = 10;
/// Number of random scenes whose planets change places.
const RENUMBERED: usize = 20;
/// Number of scenes whose planets roll over some teeth.
const ROLLING: usize = 10;
/// Minimum fraction of all values that the twins allow to compare.
const SHARE: f64 = 0.7;
/// Minimum fraction of the values of each output that the twins allow to compare.
const SHARE_OF_ONE: f64 = 0.2;

/// Expected fraction of images that take other steps than the scene, although its twins do not.
const WITH_OTHER_STEPS: f64 = 0.05;
/// Standard deviations by which the number of such images may exceed its expected value.
const DEVIATIONS: f64 = 2.0;

/// Compares a scene with its images in `views`. Returns `None` if the scene cannot be built.
fn compared(scene: &Scene, views: &[View]) -> Option<Vec<Findings>> {
    let mut base = scene.run().ok()?;
    let mut scene = scene.clone();
    if base.cheap_steps + 1 < base.times.len() {
        scene.steps.truncate(base.cheap_steps.max(1));
        base = scene.run().ok()?;
    }
    let scene = &scene;
    let twins = [1.0, -1.0].map(|sign| scene.disturbed(sign).run());
    let twins: Vec<_> = twins.into_iter().collect::<Result<_, _>>().ok()?;
    let found = views.iter().map(|&view| {
        let mut image = scene.image(view);
        image.from = scene.image_of_start(view, &base.start, &base.layout);
        let image = image.run().unwrap_or_else(|problems| panic!("the image cannot be built: {problems:?}"));
        compare(scene, &base, &twins, &image, &scene.map(view))
    });
    Some(found.collect())
}

/// Compares `count` scenes of `draw`, from number `first` on, with their images in the first view. The first
/// [`IN_ALL_VIEWS`] of these scenes are compared with their images in all `views`. Returns the findings of each view.
fn survey<const N: usize>(draw: fn(u64) -> Option<Scene>, first: u64, count: usize, views: [View; N]) -> [Findings; N] {
    let mut all = views.map(|_| Findings::new());
    for index in first.. {
        if all[0].scenes >= count {
            break;
        }
        let views = if all[0].scenes < IN_ALL_VIEWS { &views[..] } else { &views[..1] };
        let Some(found) = draw(index).and_then(|scene| compared(&scene, views)) else { continue };
        for (all, mut found) in all.iter_mut().zip(found) {
            found.wrong = found.wrong.iter().map(|wrong| format!("scene {index}: {wrong}")).collect();
            all.add(found);
        }
    }
    all
}

/// Scene number `index` with nodes that warm up, and with friction that depends on speed and temperature.
fn warm(index: u64) -> Option<Scene> {
    let Scene { mut parameters, inputs, steps, .. } = random::scene(index)?;
    random::warm(&mut fastrand::Rng::with_seed(index ^ random::WARM), &mut parameters);
    Scene::new(parameters, inputs, steps).ok()
}

/// Scene number `index` whose planets may change places.
fn renumberable(index: u64) -> Option<Scene> {
    let mut scene = random::scene(index)?;
    let p = &mut scene.parameters;
    p.solver.merge_planets = false;
    let n = p.geometry.planet_count;
    if n > 2 {
        // the pins are displaced in the direction of planet 1
        p.specs.tooth_errors.axis_offset = 0.0;
    }
    // otherwise, the meshes of neighbours differ by half a pitch
    (2 * p.geometry.side_teeth / n % 2 == 0).then_some(scene)
}

fn report(view: View, found: &Findings) {
    println!("{view:?}: {} scenes, {:.3} of all values, largest {:?}", found.scenes, found.share(), found.largest);
    assert!(found.wrong.is_empty(), "{} differ\n{}", found.wrong.len(), found.wrong.join("\n"));
    assert!(found.share() > SHARE, "{}", found.share());
    let expected = WITH_OTHER_STEPS * found.scenes as f64;
    let most = expected + DEVIATIONS * expected.sqrt();
    assert!(
        found.with_other_steps as f64 <= most,
        "{} images take other steps than their scenes",
        found.with_other_steps
    );
}

#[test]
fn a_reversed_a_swapped_and_a_shifted_differential_do_the_same() {
    // a start that is shifted by one tooth changes nothing
    const VIEWS: [View; 3] = [View::Reversed, View::Swapped, View::Shifted];
    let mut found = std::thread::scope(|scope| {
        let other = scope.spawn(|| survey(warm, 1000, SCENES, VIEWS));
        let rolling = scope.spawn(|| survey(random::rolling, 5000, ROLLING, [View::Reversed]));
        let mut found = survey(random::scene, 0, SCENES, VIEWS);
        let other = other.join().expect("a survey that ends");
        found.iter_mut().zip(other).for_each(|(found, other)| found.add(other));
        let [rolling] = rolling.join().expect("a survey that ends");
        found[0].add(rolling);
        found
    });
    // every output is compared, and is not always 0; hosts that react have a mirror test in `test_coupling_advice.py`
    let reversed = &found[0];
    let is_expected = |pattern: &str| !pattern.starts_with("coupling.");
    for (i, line) in lines().iter().enumerate().filter(|&(i, _)| reversed.compared[i][1] > 0) {
        let [compared, all] = reversed.compared[i].map(|count| count as f64);
        assert!(compared > SHARE_OF_ONE * all, "{} is compared in {compared} of {all} values", line.pattern);
        assert!(reversed.telling[i] > 0 || !is_expected(line.pattern), "{} is always 0", line.pattern);
    }
    found.iter_mut().for_each(|found| found.wrong.sort());
    VIEWS.iter().zip(&found).for_each(|(&view, found)| report(view, found));
}

#[test]
fn planets_that_change_places_do_what_the_others_did() {
    let [found] = survey(renumberable, 3000, RENUMBERED, [View::Renumbered]);
    report(View::Renumbered, &found);
}
