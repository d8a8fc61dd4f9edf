//! Solid teeth of a scene: their law, where their gears stand, and what does not go with them.

use super::face::gauss_slices;
use super::parameters::Parameters;
use crate::contact::ContactLaw;
use crate::contact::damping::Damping;
use crate::contact::errors::ToothErrorSpec;
use crate::contact::impact::Impact;
use crate::contact::solid::mesh::{SolidMesh, SolidSlice, SolidSpec};
use crate::contact::solid::pose::Displacement;
use crate::geometry::Pair;
use crate::geometry::assembly::azimuth;
use crate::numeric::{cos, sin};

/// Mesh of the scene `p` with the elastic law and damping of a pair.
pub fn mesh(p: &Parameters, pair: &Pair, elastic: Impact, damping: Damping) -> SolidMesh {
    let errors = errors(p);
    let displaced = displaced(&errors, p.geometry.planet_count);
    let width = pair.outer_cone - pair.inner_cone;
    let alike = errors.crowning == 0.0 && displaced.iter().flatten().all(|d| d.along == [0.0; 2] && d.across == 0.0);
    let slices = if alike {
        vec![SolidSlice { cone: pair.mean_cone, share: 1.0, width, relief: 0.0 }]
    } else {
        let slice = |s: crate::contact::detailed::Slice| {
            let x = (s.cone - pair.mean_cone) / (0.5 * width);
            let share = s.width * s.cone / (width * pair.mean_cone);
            SolidSlice { cone: s.cone, share, width: s.width, relief: errors.crowning * x * x }
        };
        gauss_slices(pair.inner_cone, pair.outer_cone).into_iter().map(slice).collect()
    };
    let spec = SolidSpec {
        fillet: p.geometry.root_fillet * pair.module / pair.outer_cone,
        facets: usize::try_from(p.solid.facets).unwrap_or(1).max(1),
        smoothing: p.solid.smoothing,
        slices,
        displaced,
    };
    let slack = errors.planet_axial_offset.abs()
        + errors.side_axial_offset.abs()
        + 2.0 * errors.axis_offset.abs()
        + pair.outer_cone * errors.shaft_angle_error.abs();
    SolidMesh::new(pair, &spec, elastic, damping, slack)
}

/// Whether planets stand differently before their side gears.
pub fn is_individual(p: &Parameters) -> bool {
    let displaced = displaced(&errors(p), p.geometry.planet_count);
    displaced.iter().any(|d| *d != displaced[0])
}

fn errors(p: &Parameters) -> ToothErrorSpec {
    if p.effects.tooth_errors { p.tooth_errors } else { ToothErrorSpec::default() }
}

/// Displacements of each planet before the left and the right side gear.
fn displaced(errors: &ToothErrorSpec, planets: i32) -> Vec<[Displacement; 2]> {
    let of_planet = |i: i32| {
        // pins move along t of planet 0, which is sinφ r̂ + cosφ t of the planet at φ
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

/// Calls `refuse` with what the scene `p` asks for that solid teeth do not have.
pub fn problems(p: &Parameters, mut refuse: impl FnMut(bool, &'static str, &'static str)) {
    let e = &p.effects;
    refuse(
        p.contact.law != ContactLaw::Impact,
        "contact.law",
        "solid teeth are pressed together by Adams' IMPACT as in the study: with scene.gear_contact = solid choose impact",
    );
    refuse(
        !e.corner_contact,
        "effects.corner_contact",
        "solid teeth have corners: with scene.gear_contact = solid corner contact cannot be switched off",
    );
    let what = "is not known of solid teeth: it needs scene.gear_contact = tooth";
    refuse(e.tooth_fault, "effects.tooth_fault", what);
    refuse(e.tooth_friction, "effects.tooth_friction", what);
    let what = "is not worked out for solid teeth: it needs scene.gear_contact = lumped or tooth";
    refuse(e.thrust_friction, "effects.thrust_friction", what);
    refuse(e.pin_compliance, "effects.pin_compliance", what);
    refuse(
        e.limited_slip && p.specs.limited_slip.torque_coefficient != 0.0,
        "limited_slip.torque_coefficient",
        "a torque-proportional clutch is not worked out for solid teeth: with scene.gear_contact = solid it must be 0 \
         (preload alone), or choose lumped or tooth",
    );
    let t = &p.tooth_errors;
    let what = "solid teeth take crowning and misalignment alone: it must be 0, or choose scene.gear_contact = tooth";
    refuse(e.tooth_errors && t.accuracy_grade != 0, "tooth_errors.accuracy_grade", what);
    refuse(e.tooth_errors && t.planet_runout != 0.0, "tooth_errors.planet_runout", what);
    refuse(e.tooth_errors && t.side_runout != 0.0, "tooth_errors.side_runout", what);
    refuse(e.tooth_errors && t.planet_tip_relief != 0.0, "tooth_errors.planet_tip_relief", what);
    refuse(e.tooth_errors && t.side_tip_relief != 0.0, "tooth_errors.side_tip_relief", what);
}
