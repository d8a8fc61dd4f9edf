//! Everything derived from the parameters before the first step: geometry, plan, inertias, meshes.

use super::bodies::Inertias;
use super::ideal::Ideal;
use super::parameters::{GearContact, Parameters};
use super::plan::Plan;
use super::state::{CARRIER, LEFT, MAX_DOF};
use super::teeth::Teeth;
use crate::contact::impact::Impact;
use crate::contact::mesh::Mesh;
use crate::contact::{ContactSpec, hertz};
use crate::geometry::{Pair, checks};
use crate::numeric::TAU;
use crate::problem::Problem;

/// Everything derived from the parameters; it does not change while a simulation runs, but for tunable parameters.
#[derive(Clone, Debug)]
pub struct Model {
    /// Parameters it was made from.
    pub parameters: Parameters,
    /// Geometry of the pair.
    pub pair: Pair,
    /// Ideal differential of the same scene.
    pub ideal: Ideal,
    /// Differential with teeth, where the scene asks for them.
    pub teeth: Option<Teeth>,
    /// Periods of the positions: a tooth pitch, for the carrier a turn [rad].
    pub periods: [f64; MAX_DOF],
    /// What is unusual about the gears.
    pub warnings: Vec<Problem>,
}

impl Model {
    /// Model of the scene, or all that is wrong with it; values must be within the ranges of the interface.
    pub fn new(parameters: &Parameters) -> Result<Self, Vec<Problem>> {
        let mut spec = parameters.geometry;
        if !parameters.effects.backlash {
            spec.backlash = 0.0;
        }
        if !Pair::is_right_angle(spec.shaft_angle) {
            return Err(vec![Problem::new(
                "geometry.shaft_angle",
                format!(
                    "{:.4} deg: two equal coaxial side gears mesh with one planet only at 90 deg; \
                     small errors of assembly are not a nominal shaft angle",
                    spec.shaft_angle.to_degrees()
                ),
            )]);
        }
        let pair = Pair::new(&spec);
        let mut problems = checks::errors(&spec, &pair);
        if parameters.contact.stiffness_from_hertz && parameters.contact.exponent != hertz::EXPONENT {
            problems.push(Problem::new(
                "contact.exponent",
                format!(
                    "{} does not go with contact.stiffness_from_hertz, whose law has the exponent {}",
                    parameters.contact.exponent,
                    hertz::EXPONENT
                ),
            ));
        }
        let plan = match Plan::new(parameters, &pair) {
            Ok(plan) if problems.is_empty() => plan,
            Ok(_) => return Err(problems),
            Err(problem) => {
                problems.push(problem);
                return Err(problems);
            }
        };
        let inertia = Inertias::new(parameters, &pair);
        let ratio = f64::from(spec.planet_teeth) / f64::from(spec.side_teeth);
        let mut periods = [pair.gears[0].tooth_pitch(); MAX_DOF];
        periods[LEFT..CARRIER].fill(pair.gears[1].tooth_pitch());
        periods[CARRIER] = TAU;
        let teeth = (plan.contact == GearContact::Tooth).then(|| {
            // neither may a tooth bend by the working depth nor reach the next gap
            let working_depth = (pair.gears[0].addendum + pair.gears[1].addendum) / pair.outer_cone;
            let jump = working_depth.min(0.5 * pair.base_pitch);
            let mesh = Mesh::new(&pair, law(parameters, &pair), parameters.effects.corner_contact, jump);
            Teeth::new(&pair, mesh, plan, inertia, jump)
        });
        Ok(Self {
            parameters: *parameters,
            ideal: Ideal { plan, inertia, ratio },
            teeth,
            periods,
            warnings: checks::warnings(&spec, &pair),
            pair,
        })
    }
}

fn law(parameters: &Parameters, pair: &Pair) -> Impact {
    let ContactSpec { stiffness, exponent, damping, penetration_depth, .. } = parameters.contact;
    let hertz = || {
        let radius = |i| 0.5 * pair.outer_pitch_diameter(i);
        let material = &parameters.material;
        hertz::stiffness(radius(0), radius(1), material.young_modulus, material.poisson_ratio)
    };
    Impact {
        stiffness: if parameters.contact.stiffness_from_hertz { hertz() } else { stiffness },
        exponent,
        damping,
        per_full_depth: 1.0 / penetration_depth,
    }
}
