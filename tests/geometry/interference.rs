//! Interference of teeth, checked against closed forms and against parry3d's verdict on the whole solids.

use crate::solid::specs;
use bevel_differential::geometry::solid::interference::{Approach, Interference, Stance, Verdict};
use bevel_differential::geometry::solid::{GearSolid, Part};
use bevel_differential::geometry::{AddendumSystem, GearSpec, Pair};
use nalgebra::Vector3;
use parry3d_f64::math::{Pose, Vector};
use parry3d_f64::query::intersection_test;
use parry3d_f64::shape::TriMesh;

const MM: f64 = 1e3;

fn look(spec: &GearSpec, stance: Stance) -> (Pair, Interference) {
    let pair = Pair::new(spec);
    let found = Interference::new(&pair, spec, stance).expect("gears have a surface");
    (pair, found)
}

fn of(found: &Interference, parts: [Part; 2]) -> &Approach {
    found.approaches.iter().find(|a| a.parts == parts).expect("these parts come near")
}

#[test]
fn teeth_in_the_middle_of_their_gaps_are_half_the_normal_backlash_apart() {
    for (planet_teeth, side_teeth, bore, counts) in
        [(10, 16, 0.0, &[2][..]), (9, 15, 0.012, &[3]), (14, 14, 0.0, &[2, 4])]
    {
        for &planet_count in counts {
            let teeth = GearSpec { planet_teeth, side_teeth, planet_count, ..GearSpec::default() };
            let spec = GearSpec { planet_bore: bore, side_bore: bore, ..teeth };
            let (pair, found) = look(&spec, Stance::Middle);
            let worst = of(&found, [Part::Flank; 2]);
            assert!((worst.gap - pair.normal_backlash / 2.0).abs() < found.resolution, "{spec:?}: {worst:?}");
            assert_eq!(found.verdict(found.approaches[0].gap), Verdict::Clear);
            // four planets as large as the side gears overlap each other
            assert_eq!(found.any(), planet_teeth == side_teeth && planet_count == 4, "{spec:?}: {found:?}");
            // the resolution is below a micrometre, and the gap is more accurate than that
            assert!(found.resolution * pair.outer_cone < 1e-6);
            assert!((worst.gap / pair.normal_backlash - 0.5).abs() < 1e-3, "{worst:?}");
        }
    }
}

#[test]
fn teeth_that_are_too_thick_overlap_on_the_flanks_by_half_of_the_excess() {
    for backlash in [-2e-6, -2e-5, -1e-4, -3e-4] {
        let spec = GearSpec { backlash, ..GearSpec::default() };
        let (pair, found) = look(&spec, Stance::Middle);
        let worst = &found.approaches[0];
        assert_eq!((worst.parts, found.verdict(worst.gap)), ([Part::Flank; 2], Verdict::Interfering), "{worst:?}");
        assert!(found.any());
        assert!((worst.gap - pair.normal_backlash / 2.0).abs() < found.resolution, "{backlash}: {worst:?}");
    }
}

#[test]
fn flanks_without_backlash_touch_and_so_do_driving_flanks() {
    let without = GearSpec { backlash: 0.0, ..GearSpec::default() };
    for (spec, stance) in [(without, Stance::Middle), (GearSpec::default(), Stance::Driving)] {
        let (_, found) = look(&spec, stance);
        assert_eq!(found.verdict(found.approaches[0].gap), Verdict::Touching, "{:?}", found.approaches[0]);
        assert!(!found.any());
    }
}

/// Smallest distance per cone distance of the side gear's tip corner from the meridian below the planet's base circle,
/// by spherical trigonometry. The corner turns about the side gear's axis, the meridian about the planet's axis.
fn corner_to_meridian(pair: &Pair, lag: f64) -> f64 {
    let [planet, side] = &pair.gears;
    let ratio = f64::from(side.teeth) / f64::from(planet.teeth);
    let mut least = f64::INFINITY;
    for k in 0..200_000 {
        // η: azimuth of the corner about the side gear's axis while it moves toward the plane of both axes
        let eta = -0.5 + f64::from(k) * 5e-6;
        let own = Vector3::new(side.tip.sin() * eta.cos(), side.tip.sin() * eta.sin(), side.tip.cos());
        let point = Vector3::new(own.z, -own.y, own.x);
        if point.z.acos() > planet.base || point.z.acos() < planet.root {
            continue;
        }
        // the tooth of the side gear is centred at this azimuth, with a corner on either side
        let centre = eta - side.half_angle(side.tip);
        let turn = -(centre - side.tooth_pitch() / 2.0 - lag) * ratio;
        // it is in the gap between teeth 0 and -1 of the planet: the right flank of the first, the left flank of the
        // second
        let half = planet.half_angle(planet.base);
        for (meridian, outward) in [(turn - half, -1.0), (turn - planet.tooth_pitch() + half, 1.0)] {
            let across = -point.x * meridian.sin() + point.y * meridian.cos();
            least = least.min((outward * across).asin());
        }
    }
    least
}

#[test]
fn a_tip_beyond_the_limit_penetrates_the_flank_below_the_base_circle_when_the_backlash_is_closed() {
    let standard = GearSpec { addendum_system: AddendumSystem::Standard, ..GearSpec::default() };
    let parts = [Part::Meridian, Part::Tip];
    for (backlash, stance, enters) in
        [(1e-4, Stance::Middle, false), (1e-4, Stance::Driving, true), (0.0, Stance::Middle, true)]
    {
        let (pair, found) = look(&GearSpec { backlash, ..standard }, stance);
        let corner = of(&found, parts);
        let lag = if stance == Stance::Driving { pair.normal_backlash / 2.0 / pair.sin_base()[1] } else { 0.0 };
        // turned by `lag` on one side, and mirrored on the other
        let exact = corner_to_meridian(&pair, lag).min(corner_to_meridian(&pair, -lag));
        println!(
            "{backlash} {stance:?}: {:.4} mm, exact {:.4} mm",
            corner.gap * pair.outer_cone * MM,
            exact * pair.outer_cone * MM
        );
        assert!((corner.gap - exact).abs() < found.resolution, "{stance:?}: {} {exact}", corner.gap);
        assert_eq!(found.any(), enters);
        assert_eq!(found.verdict(corner.gap) == Verdict::Interfering, enters);
        if enters {
            assert_eq!(found.approaches[0].parts, parts);
            // the side gear's own tip, below the planet's base circle
            assert!((corner.polar[1] - pair.gears[1].tip).abs() < 1e-9 && corner.polar[0] < pair.gears[0].base);
        }
    }
}

#[test]
fn a_tip_that_strikes_a_large_fillet_is_found() {
    let spec = GearSpec {
        addendum_system: AddendumSystem::Explicit,
        planet_addendum: 0.6,
        side_addendum: 0.6,
        planet_dedendum: 0.7,
        side_dedendum: 0.7,
        ..GearSpec::default()
    };
    for (root_fillet, enters) in [(0.4, true), (0.1, false)] {
        let (_, found) = look(&GearSpec { root_fillet, ..spec }, Stance::Middle);
        assert_eq!(found.any(), enters, "{:?}", found.approaches[0]);
        if enters {
            assert_eq!(found.approaches[0].parts, [Part::Fillet, Part::Tip]);
        }
    }
}

/// The whole solid in millimetres for parry3d.
fn mesh(pair: &Pair, spec: &GearSpec, i: usize) -> TriMesh {
    let solid = GearSolid::new(pair, spec, i, 32, 1);
    let vertices = solid.vertices.iter().map(|v| Vector::new(v.x * MM, v.y * MM, v.z * MM)).collect();
    TriMesh::new(vertices, solid.triangles).expect("triangles")
}

/// Pose of the side gear in the planet's frame, with the side gear turned by `side` and the planet turned back by
/// `planet`.
fn pose(pair: &Pair, planet: f64, side: f64) -> Pose {
    // x of the side gear points toward the planet's axis, and its y is opposite to the planet's y
    let half_turn = Pose::rotation(Vector::new(0.0, 0.0, std::f64::consts::PI));
    let tilt = Pose::rotation(Vector::new(0.0, pair.shaft_angle, 0.0));
    let about = |angle: f64| Pose::rotation(Vector::new(0.0, 0.0, angle));
    about(-planet) * tilt * half_turn * about(side)
}

#[test]
fn the_verdict_agrees_with_the_whole_solids_facet_by_facet() {
    let few = [("thick", GearSpec { backlash: -1e-5, ..GearSpec::default() })];
    let names = ["default", "bored", "odd", "mitre", "few teeth", "flat 10 degrees", "standard", "stub", "obtuse"];
    for (name, spec) in specs().into_iter().filter(|(name, _)| names.contains(name)).chain(few) {
        let (pair, found) = look(&spec, Stance::Middle);
        let teeth = found.verdict(found.approaches[0].gap);
        let meshes = [0, 1].map(|i| mesh(&pair, &spec, i));
        let pitch = pair.gears[0].tooth_pitch();
        let turns = (0..3).map(|k| pitch * f64::from(k) / 3.0).chain([found.approaches[0].turn]);
        let mut any = false;
        for turn in turns {
            let ratio = f64::from(pair.gears[0].teeth) / f64::from(pair.gears[1].teeth);
            let at = pose(&pair, turn, pair.gears[1].tooth_pitch() / 2.0 - turn * ratio);
            let met = intersection_test(&Pose::IDENTITY, &meshes[0], &at, &meshes[1]).expect("both are meshes");
            any |= met.intersecting;
        }
        assert_eq!(any, teeth == Verdict::Interfering, "{name}: {:?}", found.approaches[0]);
    }
}
