//! Validation of gear pairs: errors for pairs that cannot be built, warnings for pairs that a gear engineer would
//! question.

use super::assembly::between_planets;
use super::solid::Foot;
use super::{GearSpec, Pair};
use crate::numeric::{cos, sin};
use crate::problem::{Problem, distinct_texts};

const NAMES: [&str; 2] = ["planet", "side gear"];
const MM: f64 = 1e3;

/// Usual maximum of the ratio of face width to outer cone distance for cut straight bevel gears (ISO 23509).
const USUAL_FACE: f64 = 1.0 / 3.0;
/// Maximum of this ratio for forged differential gears, which commonly have 0.35 to 0.5.
const WIDEST_FACE: f64 = 0.5;
/// A tip land narrower than this many modules is called pointed.
const POINTED_LAND: f64 = 0.2;
/// Smallest ratio of inner to outer cone distance. Nearer to the apex, teeth have practically no size.
const MIN_INNER_CONE: f64 = 0.1;
/// Smallest root angle [rad], because a gear needs a body.
const MIN_ROOT_ANGLE: f64 = 0.02;
/// Rims thinner than this fraction of the tooth depth should be avoided (ISO 6336-3).
const THINNEST_RIM: f64 = 0.5;
/// Rims thicker than this fraction of the tooth depth do not weaken the root (rim thickness factor Y_B = 1 of ISO
/// 6336-3).
const FULL_RIM: f64 = 1.2;
/// Admissible numbers of planets.
const PLANET_COUNTS: std::ops::RangeInclusive<i32> = 2..=4;
/// Relative reduction of a fillet that is still attributed to rounding.
const SHARE_OF_FILLET: f64 = 1e-9;

/// Reasons why the pair cannot be built; empty if it can.
pub fn errors(spec: &GearSpec, pair: &Pair) -> Vec<Problem> {
    let mut found = Vec::new();
    if pair.inner_cone <= MIN_INNER_CONE * pair.outer_cone {
        found.push(problem!(
            "geometry.face_width",
            "{:.3} mm leaves no teeth at the toe: the outer cone distance is {:.3} mm; use at most a third of it",
            spec.face_width * MM,
            pair.outer_cone * MM
        ));
    }
    for (i, gear) in pair.gears.iter().enumerate() {
        if gear.root <= MIN_ROOT_ANGLE {
            found.push(problem!(
                if i == 0 { "geometry.planet_dedendum" } else { "geometry.side_dedendum" },
                "the {}'s root cone would reach its axis: dedendum {:.3} mm",
                NAMES[i],
                gear.dedendum * MM
            ));
        }
        found.extend(thin_tooth(spec, pair, i));
        let mate = &pair.gears[1 - i];
        if gear.addendum >= mate.dedendum {
            let [tip, room] = distinct_texts([gear.addendum * MM, mate.dedendum * MM], 3);
            found.push(problem!(
                addendum(i),
                "the {}'s tip would strike the {}'s root: addendum {tip} mm, dedendum {room} mm",
                NAMES[i],
                NAMES[1 - i]
            ));
        }
        let (name, bore) = bore(spec, i);
        let toe_root = 2.0 * pair.inner_cone * sin(gear.root);
        if bore >= toe_root && pair.inner_cone > 0.0 {
            let [bore, limit] = distinct_texts([bore * MM, toe_root * MM], 3);
            found.push(problem!(name, "{bore} mm is not less than the root circle at the toe, {limit} mm"));
        }
    }
    if pair.path.contact_ratio <= 0.0 {
        found.push(Problem::new(
            "geometry.addendum_system",
            "the teeth have no path of contact: both tips are cut off by the mate's base circle",
        ));
    }
    found
}

/// Problem of a tooth of gear `i` that has no thickness at the pitch circle or at the tip. It names the parameter without
/// which the tooth would have some.
fn thin_tooth(spec: &GearSpec, pair: &Pair, i: usize) -> Option<Problem> {
    let gear = &pair.gears[i];
    let z = f64::from(gear.teeth);
    let (thinned, shifted) = (spec.backlash / (2.0 * spec.module * z), -spec.thickening(i) / z);
    let cause = |half: f64| match half + thinned {
        unthinned if unthinned > 0.0 => "geometry.backlash",
        unthinned if unthinned + shifted > 0.0 => "geometry.thickness_shift",
        _ => addendum(i),
    };
    let (tooth, tip, name) = (gear.half_pitch, gear.half_angle(gear.tip), NAMES[i]);
    if tooth <= 0.0 && tooth + thinned > 0.0 {
        return Some(problem!(cause(tooth), "{:.3} mm is more than the {name}'s whole tooth", spec.backlash * MM));
    }
    if tooth <= 0.0 {
        return Some(problem!(
            cause(tooth),
            "the split between the gears leaves the {name} no tooth at the pitch circle; use a more equal split"
        ));
    }
    (tip <= 0.0).then(|| {
        problem!(
            cause(tip),
            "the {name}'s flanks meet below its tip cone: addendum {:.3} mm, tooth thinned by {:.3} mm",
            gear.addendum * MM,
            (thinned + shifted) * spec.module * z * MM
        )
    })
}

/// Warnings about a pair that can be built.
pub fn warnings(spec: &GearSpec, pair: &Pair) -> Vec<Problem> {
    let mut found = Vec::new();
    let m = pair.module;
    // at an end clipped at a gear's base circle, the mate's tip would cut or jam
    for (i, mate) in pair.gears.iter().rev().enumerate() {
        if pair.path.clipped[i] {
            let what = if i == 0 { "undercut of the planet" } else { "tip interference in the side gear" };
            let [modules, limit] = distinct_texts([mate.addendum / m, pair.limit_addendum(1 - i) / m], 3);
            found.push(problem!(
                "geometry.addendum_system",
                "{what}: the {}'s addendum {:.3} mm = {modules} modules exceeds the limit of {limit} modules at {:.1} \
                 deg; the path of contact ends at the {}'s base circle",
                NAMES[1 - i],
                mate.addendum * MM,
                pair.pressure_angle.to_degrees(),
                NAMES[i]
            ));
        }
        let land = land(pair, i);
        if land < POINTED_LAND * m {
            found.push(problem!(
                "geometry.addendum_system",
                "pointed {} teeth: tip land {:.3} mm = {:.3} modules at the heel",
                NAMES[i],
                land * MM,
                land / m
            ));
        }
        if let Some([rim, depth]) = rim(spec, pair, i).filter(|[rim, depth]| *rim < THINNEST_RIM * depth) {
            let [rim, least] = distinct_texts([rim * MM, THINNEST_RIM * depth * MM], 2);
            found.push(problem!(
                bore(spec, i).0,
                "the {}'s rim at the toe is {rim} mm, thinner than half the tooth depth there ({least} mm): ISO 6336-3 \
                 gives no root stress for it",
                NAMES[i]
            ));
        }
    }
    found.extend((0..2).filter_map(|i| cut_fillet(spec, pair, i)));
    found.extend(striking_planets(spec, pair));
    let share = spec.face_width / pair.outer_cone;
    if share > WIDEST_FACE {
        let [width, widest] = distinct_texts([spec.face_width * MM, pair.outer_cone * WIDEST_FACE * MM], 2);
        found.push(problem!(
            "geometry.face_width",
            "{width} mm is {share:.3} R_e, wider than differential gears are made (R_e/2 = {widest} mm)"
        ));
    }
    if pair.path.contact_ratio < 1.0 && pair.path.contact_ratio > 0.0 {
        found.push(problem!(
            "geometry.addendum_system",
            "contact ratio {:.3} is below 1: tip corners transmit the motion in between",
            pair.path.contact_ratio
        ));
    }
    found
}

/// Remarks about a pair that a gear engineer would not question, for reports on its geometry.
pub fn remarks(spec: &GearSpec, pair: &Pair) -> Vec<Problem> {
    let mut found = Vec::new();
    for i in 0..2 {
        let is_thin = |[rim, depth]: &[f64; 2]| (THINNEST_RIM * depth..FULL_RIM * depth).contains(rim);
        if let Some([rim, depth]) = rim(spec, pair, i).filter(is_thin) {
            found.push(problem!(
                bore(spec, i).0,
                "the {}'s rim at the toe is {:.2} mm, below 1.2 tooth depths there ({:.2} mm), which weakens the root",
                NAMES[i],
                rim * MM,
                FULL_RIM * depth * MM
            ));
        }
    }
    let share = spec.face_width / pair.outer_cone;
    if share > USUAL_FACE && share <= WIDEST_FACE {
        let [width, usual] = distinct_texts([spec.face_width * MM, pair.outer_cone * USUAL_FACE * MM], 2);
        found.push(problem!(
            "geometry.face_width",
            "{width} mm is {share:.3} R_e: usual for forged differential gears, wide for cut gears (R_e/3 = {usual} mm)"
        ));
    }
    found
}

/// Thickness of gear `i`'s rim between root and bore at the toe, along the front cone, and its tooth depth there [m];
/// `None` without a bore.
fn rim(spec: &GearSpec, pair: &Pair, i: usize) -> Option<[f64; 2]> {
    let (gear, (_, bore)) = (&pair.gears[i], bore(spec, i));
    let rim = (pair.inner_cone * sin(gear.root) - bore / 2.0) / cos(gear.root);
    let depth = (gear.addendum + gear.dedendum) * pair.inner_cone / pair.outer_cone;
    (bore > 0.0).then_some([rim, depth])
}

fn striking_planets(spec: &GearSpec, pair: &Pair) -> Option<Problem> {
    let (count, between) = (spec.planet_count, between_planets(pair, spec.planet_count));
    if between >= 0.0 {
        return None;
    }
    let room = |&n: &i32| 2 * spec.side_teeth % n == 0 && between_planets(pair, n) >= 0.0;
    let fitting: Vec<String> = PLANET_COUNTS.filter(room).map(|n| n.to_string()).collect();
    let hint = if fitting.is_empty() { "no planet count has room".into() } else { fitting.join(", ") + " have room" };
    Some(problem!(
        "geometry.planet_count",
        "{count} planets strike each other: the tip cones of neighbours overlap by {:.3} deg, tip angle {:.3} deg, \
         at most {:.3} deg; use fewer planets ({hint}) or more side gear teeth",
        -between.to_degrees(),
        pair.gears[0].tip.to_degrees(),
        180.0 / f64::from(count)
    ))
}

/// Returns a warning if the root fillet of gear `i` does not fit into the tooth spaces.
fn cut_fillet(spec: &GearSpec, pair: &Pair, i: usize) -> Option<Problem> {
    let wanted = spec.root_fillet * pair.module / pair.outer_cone;
    let foot = Foot::new(&pair.gears[i], wanted);
    let got = foot.radius;
    (got < wanted * (1.0 - SHARE_OF_FILLET)).then(|| {
        let why = if foot.floor > pair.gears[i].root {
            "flanks meet above the root cone"
        } else if foot.centre >= foot.middle {
            "the whole tooth space is rounded"
        } else {
            "it would end above the pitch cone"
        };
        problem!(
            "geometry.root_fillet",
            "the {}'s root fillet is cut to {:.3} mm = {:.3} modules at the heel, not {:.3} mm = {:.3} modules: {why}",
            NAMES[i],
            got * pair.outer_cone * MM,
            got * pair.outer_cone / pair.module,
            wanted * pair.outer_cone * MM,
            spec.root_fillet
        )
    })
}

/// Width of the tip land of gear `i` at the heel [m].
fn land(pair: &Pair, i: usize) -> f64 {
    let gear = &pair.gears[i];
    2.0 * gear.half_angle(gear.tip) * sin(gear.tip) * pair.outer_cone
}

fn addendum(i: usize) -> &'static str {
    if i == 0 { "geometry.planet_addendum" } else { "geometry.side_addendum" }
}

fn bore(spec: &GearSpec, i: usize) -> (&'static str, f64) {
    if i == 0 { ("geometry.planet_bore", spec.planet_bore) } else { ("geometry.side_bore", spec.side_bore) }
}
