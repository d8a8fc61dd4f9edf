//! Symmetries of the forces, and equivalent kinds of contact.

use std::ops::Range;

use bevel_differential::contact::detailed::SliceLoad;
use bevel_differential::contact::{Flank, Spot, ToothLoad};
use bevel_differential::geometry::action::LineOfAction;
use nalgebra::Vector3;

use super::kinds::{At, Contact, Face, Forces, Planet, READINGS, Teeth};
use super::points::{for_each_point, those};
use crate::mesh_laws::{Kind, impact};

fn is_perfect(of: &Contact) -> bool {
    matches!(of.teeth, Teeth::Perfect)
}

#[track_caller]
fn same(a: f64, b: f64, limit: f64) {
    assert!((a - b).abs() <= limit, "{a} is not {b} within {limit:e}");
}

fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |most, value| most.max(value.abs()))
}

/// Checks that two contacts have the same energy, heat and `rows` of readings, and the same derivatives with respect to
/// the first `coordinates`, within `limit` of the largest. `sign` is the sign of a row and of a coordinate.
fn compare([a, b]: [(&Planet, At); 2], (rows, coordinates): (Range<usize>, usize), sign: [f64; READINGS], limit: f64) {
    let resting = a.0.scale(&a.1.at_rest());
    let [(a, da), (b, db)] = [a, b].map(|(planet, at)| planet.linearised(&at));
    same(da.energy, db.energy, limit * da.energy);
    for side in 0..2 {
        let scale = limit * (resting + largest(&a.readings[side]) + largest(&a.heat[side]));
        let steep = limit * largest(da.by[side].as_flattened());
        (0..2).for_each(|i| same(a.heat[side][i], b.heat[side][i], scale));
        for row in rows.clone() {
            same(a.readings[side][row], sign[row] * b.readings[side][row], scale);
            for i in (0..12).filter(|i| i % 3 < coordinates) {
                same(da.by[side][row][i], sign[row] * sign[i % 3] * db.by[side][row][i], steep);
            }
        }
    }
}

#[test]
fn coasting_is_the_mirror_image_of_driving() {
    for_each_point(5, 40, those(is_perfect), |planet, at| {
        // an elastic planet needs teeth of one body; side gears displaced outward stay displaced outward
        let at = if planet.contact.is_elastic { planet.joined(*at) } else { *at };
        let turned = |values: [[f64; 3]; 2]| values.map(|[q, x, w]| [-q, -x, w]);
        let mirror = At { position: turned(at.position), rate: turned(at.rate), ..at };
        // pairs on both flanks, pressed by displaced gears and elastic bodies, are summed in a different order
        let (mirror, limit) = match planet.contact {
            // the teeth at both meshes' lines are not opposite
            Contact { is_elastic: true, .. } => (mirror.moved(4, planet.off_opposite()), 1e-10),
            Contact { is_displaced, .. } => (mirror, if is_displaced { 1e-12 } else { 0.0 }),
        };
        compare([(planet, at), (planet, mirror)], (0..READINGS, 3), [-1.0, -1.0, 1.0, 1.0, 1.0, -1.0], limit);
        true
    });
}

#[test]
fn contact_is_the_same_a_base_pitch_further() {
    for_each_point(6, 40, those(is_perfect), |planet, at| {
        // the planet turns up the path on the left, down on the right
        let pitch = planet.gears.pair.base_pitch;
        let next = at.moved(1, pitch).moved(4, -pitch);
        same(planet.energy(at), planet.energy(&next), 1e-11 * planet.energy(at));
        true
    });
}

#[test]
fn contact_does_not_depend_on_the_number_of_pairs_by_which_the_position_is_wrapped() {
    // a mesh with one spring has no teeth
    for_each_point(13, 40, those(|of| of.law != Kind::Lumped), |planet, at| {
        let further = 2.0 * planet.gears.pair.base_pitch;
        let mut next = at.moved(1, further).moved(4, -further);
        next.wrapped = [at.wrapped[0] - 2, at.wrapped[1] + 2];
        let loads = |at| {
            let mut loads = Vec::new();
            planet.loaded(at, |load, _| loads.push((load.side, load.flank, load.teeth, load.spot)));
            loads
        };
        assert_eq!(loads(at), loads(&next));
        same(planet.energy(at), planet.energy(&next), 1e-11 * planet.energy(at));
        true
    });
}

#[test]
fn flanks_that_do_not_touch_are_not_loaded() {
    for_each_point(7, 40, those(|of| is_perfect(of) && !of.is_displaced), |planet, at| {
        let (mut at, half) = (*at, planet.gears.pair.normal_backlash / 2.0);
        at.position.iter_mut().for_each(|[q, ..]| *q = 0.999_999 * half * q.signum());
        assert_eq!((planet.energy(&at), planet.forces(&at)), (0.0, Forces::default()));
        true
    });
}

#[test]
fn without_corner_contact_each_pair_on_the_path_has_the_whole_approach() {
    for_each_point(8, 4000, those(|of| of.law == Kind::Impact && !of.has_corners), |planet, at| {
        let (at, pair) = (at.at_rest().only(0), &planet.gears.pair);
        let [q, x, _] = at.position[0];
        let approach = (q.abs() - pair.normal_backlash / 2.0).max(0.0);
        // teeth on the path, counted one by one: s = γ_p sinδ_bp ± x + k p_b
        let start = pair.centred_position() - q.signum() * x;
        let [high, low] = [0, 1].map(|i| planet.constants.mesh.engagement.corner[i].end);
        let on_path = |k: &i32| (-low..=high).contains(&(start + f64::from(*k) * pair.base_pitch));
        let count = (-20..=20).filter(on_path).count() as f64;
        let e = planet.gears.exponent;
        let expected = count * impact(e).stiffness * (pair.mean_cone * approach).powf(e + 1.0) / (e + 1.0);
        same(planet.energy(&at), expected, 1e-12 * expected);
        // straight along the path, there is no force along x
        assert_eq!(planet.forces(&at).readings[0][1], 0.0);
        true
    });
}

#[test]
fn kinds_without_effects_are_the_plain_mesh() {
    let (mut spots, mut coast) = ([0; 3], 0);
    let wanted = |of: &Contact| is_perfect(of) && of.friction.is_none();
    for_each_point(9, 100, those(|of| wanted(of) && of.face != Face::Plain), |planet, at| {
        let mut at = *at;
        (0..2).for_each(|side| (at.position[side][2], at.rate[side][2]) = (0.0, 0.0));
        let plain = Planet::new(Contact { face: Face::Plain, is_displaced: false, ..planet.contact }, &planet.gears);
        let whole = Planet::new(Contact { face: Face::Whole, ..planet.contact }, &planet.gears);
        planet.loaded(&at, |point, _| {
            spots[point.spot as usize] += 1;
            coast += usize::from(point.flank == Flank::Coast);
        });
        // own arcs on elastic bodies are solved iteratively, not summed
        let limit = if planet.contact.is_elastic { 1e-10 } else { 1e-12 };
        compare([(planet, at), (&plain, at)], (0..2, 2), [1.0; READINGS], limit);
        // thrusts and the force on side gears are compared with one resultant
        compare([(planet, at), (&whole, at)], (2..READINGS, 2), [1.0; READINGS], limit);
        let scale = limit * plain.scale(&at).max(plain.scale(&at.at_rest())) / plain.cone();
        let loads_are_the_same = |a: &ToothLoad, _: Option<&SliceLoad>| {
            let is_of_pair = |b: &ToothLoad| (a.side, a.flank, a.teeth, a.spot) == (b.side, b.flank, b.teeth, b.spot);
            same(planet.normal(&at, is_of_pair), plain.normal(&at, is_of_pair), scale);
        };
        [planet, &plain].iter().for_each(|planet| planet.loaded(&at, loads_are_the_same));
        assert_eq!(planet.forces(&at).heat.map(|[_, friction]| friction), [0.0; 2]);
        true
    });
    assert!(spots.iter().all(|&n| n > 500) && coast > 500, "[path, planet tip, side tip]: {spots:?}, coast {coast}");
}

#[test]
fn components_of_a_normal_force_match_the_normal_in_space() {
    let mut spots = [0; 3];
    let wanted = |of: &Contact| is_perfect(of) && of.face != Face::Distributed && of.law == Kind::Line;
    for_each_point(10, 200, those(wanted), |planet, at| {
        let action = LineOfAction::new(&planet.gears.pair);
        let shaft_angle = planet.gears.pair.shaft_angle;
        let side_axis = Vector3::new(shaft_angle.sin(), 0.0, shaft_angle.cos());
        planet.loaded(at, |point, _| {
            // the first cell of a corner's table of gaps has slopes accurate to 2e-8
            if point.spot != Spot::Path && point.spot_arc < 1e-6 {
                return;
            }
            spots[point.spot as usize] += 1;
            // the normal from the planet into the side gear; its reaction pushes the planet back
            let normal = action.contact(point.spot, point.spot_arc, 1.0).normal;
            let [planet, side] = [-normal.z, normal.dot(&side_axis)];
            // the remaining component is along the rotation, in which drive flanks push the side gear
            let left = (1.0 - planet * planet - side * side).sqrt();
            let expected = [planet, side, if point.flank == Flank::Drive { left } else { -left }];
            (0..3).for_each(|i| same(point.components[i], expected[i], 1e-8));
        });
        true
    });
    assert!(spots.iter().all(|&n| n > 100), "{spots:?}");
}
