//! Symmetry of the whole program: a differential and its mirror images must do the same.
//!
//! A differential that is reflected, with all speeds and torques reflected too, is one that could be built, and it must do
//! what the other does. How each variable maps stands in `tests/data/symmetry.csv`; the images of a scene are simulated,
//! and every output is compared. Where a motion is chaotic, rounding grows until nothing can be said: a twin that is
//! disturbed by 1e-15 shows how far a comparison reaches.

mod compare;
mod random;
mod scene;
mod table;
mod teeth;

use std::sync::Mutex;
use std::sync::atomic::{AtomicU64, Ordering};

use compare::{CLOSE, CLOSE_AT_SWITCHES, Findings, compare};
use scene::Scene;
use table::lines;
use teeth::View;

/// Compares a scene with its image.
fn mirrored(scene: &Scene, view: View) -> Option<Findings> {
    let base = scene.run().ok()?;
    let twin = scene.disturbed().run().ok()?;
    let image = scene.image(view).run().unwrap_or_else(|problems| panic!("the image cannot be built: {problems:?}"));
    let e = &scene.parameters.effects;
    let sticks = e.thrust_friction || e.limited_slip || e.wheel_brake || scene.steps.iter().any(|s| s.inputs.lock > 0.0);
    let close = if sticks { CLOSE_AT_SWITCHES } else { CLOSE };
    Some(compare(scene, [&base, &twin, &image], &scene.map(view), close))
}

#[test]
fn random_scenes_mirror() {
    const SCENES: usize = 100;
    let (next, all) = (AtomicU64::new(0), Mutex::new((0, Findings::new(), Vec::new())));
    let work = || {
        loop {
            let index = next.fetch_add(1, Ordering::Relaxed);
            if all.lock().unwrap().0 >= SCENES || index > 1000 {
                break;
            }
            let Some(scene) = random::scene(index) else { continue };
            let begin = std::time::Instant::now();
            let Some(found) = mirrored(&scene, View::Reversed) else { continue };
            let mut all = all.lock().unwrap();
            all.0 += 1;
            println!("{index}: {:?} {} share {:.2} largest {:.1e} in {:.2} s: {:?}", scene.parameters.scene.gear_contact, scene.parameters.effects.active().skip(2).collect::<Vec<_>>().join(" "), found.share(), found.largest, begin.elapsed().as_secs_f64(), found.wrong.iter().take(3).collect::<Vec<_>>());
            if !found.wrong.is_empty() {
                all.2.push(index);
            }
            all.1.add(found);
        }
    };
    std::thread::scope(|s| {
        s.spawn(work);
        s.spawn(work);
    });
    let (count, found, wrong) = all.into_inner().unwrap();
    println!("{count} scenes, share {}, largest {:e}", found.share(), found.largest);
    for (line, [compared, all]) in lines().iter().zip(&found.compared) {
        if *all > 0 { println!("{} {:.3}", line.pattern, *compared as f64 / *all as f64); }
    }
    assert!(found.wrong.is_empty(), "{wrong:?}");
}
