//! Solid teeth of a scene: sections across the face, tooth errors, and displacements of the gears.

use crate::contact::errors::ToothErrorSpec;
use crate::contact::solid::Displacement;
use crate::contact::solid::mesh::{SolidMesh, SolidSlice, SolidSpec};
use crate::contact::{Damping, Impact};
use crate::geometry::assembly::azimuth;
use crate::geometry::{GearSpec, Pair};
use crate::model::assembly::face::gauss_slices;
use crate::model::scene::SolidTeeth;
use crate::model::setup::Parameters;
use crate::numeric::{cos, sin};

/// Mesh of `pair` with the gears `spec`, the facets of `teeth`, the tooth errors `errors`, and the elastic law and
/// damping of a tooth pair.
pub fn mesh(
    pair: &Pair,
    (spec, teeth, errors): (&GearSpec, &SolidTeeth, &ToothErrorSpec),
    elastic: Impact,
    damping: Damping,
) -> SolidMesh {
    let displaced = displaced(errors, spec.planet_count);
    let width = pair.outer_cone - pair.inner_cone;
    let alike = errors.crowning == 0.0 && displaced.iter().flatten().all(|d| d.along == [0.0; 2] && d.across == 0.0);
    let slice = |(cone, part): (f64, f64)| {
        let x = (cone - pair.mean_cone) / (0.5 * width);
        let share = part * cone / (width * pair.mean_cone);
        SolidSlice { cone, share, width: part, relief: errors.crowning * x * x }
    };
    let (slices, edges) = if alike {
        (vec![slice((pair.mean_cone, width))], Vec::new())
    } else {
        let sections = gauss_slices(pair.inner_cone, pair.outer_cone).into_iter().map(|s| slice((s.cone, s.width)));
        // the load is also evaluated at its possible maxima: both ends of the face and the crest of the crowning
        let edges = [pair.inner_cone, pair.mean_cone, pair.outer_cone].map(|cone| slice((cone, 0.0)));
        (sections.collect(), edges.to_vec())
    };
    let solids = SolidSpec {
        fillet: spec.root_fillet * pair.module / pair.outer_cone,
        facets: usize::try_from(teeth.facets).unwrap_or(1).max(1),
        smoothing: teeth.smoothing,
        slices,
        displaced,
    };
    let slack = errors.planet_axial_offset.abs()
        + errors.side_axial_offset.abs()
        + 2.0 * errors.axis_offset.abs()
        + pair.outer_cone * errors.shaft_angle_error.abs();
    SolidMesh::new(pair, &solids, elastic, damping, slack).with_edges(&edges)
}

/// True if the displacements of the planets differ, so each planet must be simulated.
pub fn is_individual(p: &Parameters) -> bool {
    let displaced = displaced(&errors(p), p.geometry.planet_count);
    displaced.iter().any(|d| *d != displaced[0])
}

/// Tooth errors of the scene `p`; none if their effect is off.
pub fn errors(p: &Parameters) -> ToothErrorSpec {
    if p.effects.tooth_errors { p.specs.tooth_errors } else { ToothErrorSpec::default() }
}

/// Displacements in the left and the right mesh of each planet.
fn displaced(errors: &ToothErrorSpec, planets: i32) -> Vec<[Displacement; 2]> {
    let of_planet = |i: i32| {
        // the pins move along t of planet 0; at the planet with the azimuth φ that direction is sinφ r̂ + cosφ t
        let at = azimuth(usize::try_from(i).unwrap_or(0), planets);
        let outward = errors.planet_axial_offset + errors.axis_offset * sin(at);
        [1.0, -1.0].map(|side| Displacement {
            along: [outward, -errors.side_axial_offset],
            across: errors.axis_offset * cos(at),
            lean: side * errors.shaft_angle_error,
        })
    };
    (0..planets).map(of_planet).collect()
}
