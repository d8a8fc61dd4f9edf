//! Gears as data for programs that create solids, meshes and drawings: curves on the unit sphere, blanks, faceted
//! surfaces, masses, and the orientation of each gear in the assembly. Units are metres and radians.
//!
//! All faces of teeth are cones with their apex in the pitch apex, so a curve on the unit sphere describes a face. The
//! ends are those of `geometry::solid::manifold`. At each azimuth, they are a straight line from the outline on the
//! sphere down to the root circle, followed by the plane of the root circle to the bore.

use bevel_differential::geometry::involute::direction;
use bevel_differential::geometry::solid::mass::gear_mass;
use bevel_differential::geometry::solid::{GearSolid, Outline, Part};
use bevel_differential::geometry::{GearSpec, Pair};
use bevel_differential::numeric::cos;
use bevel_differential::problem::Problem;
use serde_json::{Value, json};

use super::assembly::{Body, Position, bodies, turned};
use super::xyz::NAMES;

/// Facets per flank for the nodes of splines. The splines are then accurate to 0.01 µm at modules up to 10 mm.
const NODES: usize = 48;

/// A vector in the frame of a gear: z along its axis from apex to heel, tooth 0 centred on azimuth 0.
type Point = [f64; 3];

/// Returns both gears of `pair`, built from `spec` with `density` [kg/m³], and their assembly. Fails if they cannot be
/// assembled. Faceted surfaces have `facets` per flank.
pub fn shape(pair: &Pair, spec: &GearSpec, density: f64, facets: usize) -> Result<Value, Problem> {
    let bodies = bodies(spec, &Position::default())?;
    let gears = [0, 1].map(|i| gear(pair, spec, i, density, facets));
    Ok(json!({
        // cone distances of heel and toe [m]
        "outer_cone": pair.outer_cone,
        "inner_cone": pair.inner_cone,
        // planet and side gear
        "gears": gears,
        // the planets' pins, if planets have bores
        "pins": (spec.planet_bore > 0.0).then(|| pins(pair, spec, &bodies)),
        // oriented gears of the assembly
        "bodies": bodies,
    }))
}

/// Pins of the planets in the frame of the assembly.
fn pins(pair: &Pair, spec: &GearSpec, bodies: &[Body]) -> Value {
    let length = pair.outer_cone * cos(pair.gears[0].root);
    let opposite = spec.planet_count % 2 == 0;
    let count = spec.planet_count as usize / if opposite { 2 } else { 1 };
    let arms = bodies.iter().filter(|body| body.gear == 0).map(|body| turned(&body.rotation, [0.0, 0.0, length]));
    let rods = arms.take(count).map(|end| [end.map(|x| if opposite { -x } else { 0.0 }), end]);
    json!({
        // radius of the bores [m]
        "radius": spec.planet_bore / 2.0,
        // both ends of each pin [m]: at the heel faces of opposite planets, or at the heel face of one planet and the
        // apex
        "rods": rods.collect::<Vec<[Point; 2]>>(),
    })
}

/// Gear `i` of the pair.
fn gear(pair: &Pair, spec: &GearSpec, i: usize, density: f64, facets: usize) -> Value {
    let gear = &pair.gears[i];
    let Outline { foot: f, nodes } = Outline::new(gear, spec.root_fillet * pair.module / pair.outer_cone, NODES);
    // by rising polar angle
    let of = |parts: &[Part]| -> Vec<Point> {
        let side = nodes.iter().rev().filter(|node| node.azimuth > 0.0 && parts.contains(&node.part));
        side.map(|node| direction(node.polar, node.azimuth).into()).collect()
    };
    let (mut foot, flank) = (of(&[Part::Fillet, Part::Meridian]), of(&[Part::Flank]));
    if !f.has_meridian(gear) {
        foot.extend(flank.first());
    }
    let mass = gear_mass(pair, spec, i, density);
    let solid = GearSolid::new(pair, spec, i, facets, 1);
    let bores = [spec.planet_bore, spec.side_bore];
    json!({
        "name": NAMES[i],
        "teeth": gear.teeth,
        // polar angles of pitch, tip and root cone [rad]
        "pitch": gear.pitch,
        "tip": gear.tip,
        "root": gear.root,
        // diameter of the bore, 0 without one [m]
        "bore": bores[i],
        // foot and flank of a tooth on the unit sphere, on the side of positive azimuth; the other side mirrors them.
        // If the foot ends below the start of the flank, a meridian connects them. Without a fillet, the foot is one
        // point.
        "foot": foot,
        "flank": flank,
        // direction of the axis of the fillet's cone, and half its angle [rad]
        "fillet_axis": Point::from(direction(f.floor + f.radius, f.centre)),
        "fillet": f.radius,
        // mass properties in the simulation
        "mass": {
            // [kg/m³]
            "density": density,
            // [kg]
            "mass": mass.mass,
            // distance of the centre of mass from the apex [m]
            "centre": mass.centre,
            // moments of inertia about the axis, and about any transverse axis through the apex [kg·m²]
            "axial": mass.axial,
            "transverse_at_apex": mass.transverse_at_apex,
        },
        // a closed surface: vertices [m], and triangles by the indices of their vertices, counter-clockwise from
        // outside
        "mesh": {
            "vertices": solid.vertices.iter().map(|&v| v.into()).collect::<Vec<Point>>(),
            "triangles": solid.triangles,
        },
    })
}
