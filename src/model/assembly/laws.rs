//! Contact law of a scene, from parameters to the laws of plain and detailed meshes.

use std::sync::Arc;

use crate::FULL;
use crate::contact::bodies::PairCouplings;
use crate::contact::damping::{self};
use crate::contact::detailed::{Face as DetailedFace, Slice};
use crate::contact::solid::mesh::SolidMesh;
use crate::contact::spring::{ImpactSpring, Resultant};
use crate::contact::stiffness::PairStiffness;
use crate::contact::{AnySpring, ContactLaw, Damping, DampingModel, Impact, hertz};
use crate::geometry::Pair;
use crate::model::assembly::face::centroid;
use crate::model::assembly::gear_cache::GearCache;
use crate::model::assembly::solid;
use crate::model::effect_kinds::ToothEffects;
use crate::model::scene::GearContact;
use crate::model::setup::Parameters;
use crate::problem::Problem;

/// Contact law of a scene, and the faces and bodies on which it acts.
pub struct Laws {
    /// Elastic law of a tooth pair, or of a mesh.
    pub spring: AnySpring,
    /// Position of the resultant of a pair.
    pub whole: Resultant,
    /// Mesh of solid teeth, if the scene has them.
    pub solid: Option<Box<SolidMesh>>,
    /// Face over which loads are summed in detail.
    pub face: DetailedFace,
    /// Face over which friction is summed, if the law is valid at every cone distance.
    pub friction_face: Option<DetailedFace>,
    /// Gear bodies that pairs share, if they are elastic.
    pub bodies: Option<Arc<PairCouplings>>,
}

impl Laws {
    /// Law of the scene with the influence of effects on the teeth: elastic bodies, and loads that differ over the face
    /// if the law is valid at every cone distance. Fails if the stiffness of teeth or gear bodies cannot be computed.
    pub fn new(p: &Parameters, pair: &Pair, tooth: &ToothEffects, cache: &GearCache) -> Result<Self, Problem> {
        let distributed = tooth.distributed;
        let (outer, inner) = (pair.outer_cone, pair.inner_cone);
        let moment = (outer * outer * outer - inner * inner * inner) / 3.0;
        let centroid = centroid(pair);
        // a single slice at `cone` stands for the whole face; if the load per width grows with R, force over this width
        // is the load per width at `cone`
        let width = |cone: f64| (outer - inner) * pair.mean_cone / cone;
        let whole = |cone: f64, weight: f64| DetailedFace::whole(Slice { cone, weight, width: width(cone) });
        if p.scene.gear_contact == GearContact::Lumped {
            let per_width = if p.contact.mesh_stiffness_from_geometry {
                cache.mesh_mean(p, pair)?
            } else {
                p.contact.mesh_stiffness
            };
            let k = per_width * moment / (centroid * centroid);
            return Ok(Self::of_depth(ImpactSpring::linear(k, centroid), whole(centroid, 1.0)));
        }
        if FULL && p.scene.gear_contact == GearContact::Solid {
            let impact = impact(p, pair);
            let damping = Self::damping(p);
            let solids = cache.solid(pair, (&p.geometry, &p.solid, &solid::errors(p)), impact, damping);
            let laws = Self::of_depth(ImpactSpring { law: impact, cone: pair.mean_cone }, whole(pair.mean_cone, 1.0));
            return Ok(Self { solid: Some(Box::new(solids)), ..laws });
        }
        let of_face = |(spring, bodies), face: DetailedFace| Self {
            spring,
            whole: Resultant::new(centroid, moment),
            solid: None,
            face: if distributed { face } else { whole(centroid, moment) },
            friction_face: Some(face),
            bodies,
        };
        Ok(match p.contact.law {
            ContactLaw::Impact => {
                let spring = ImpactSpring { law: impact(p, pair), cone: pair.mean_cone };
                Self::of_depth(spring, whole(pair.mean_cone, 1.0))
            }
            ContactLaw::Line => {
                let law = of_teeth(p, pair, tooth, cache, |pairs| AnySpring::Line(pairs.line()))?;
                of_face(law, DetailedFace::linear(inner, outer))
            }
            ContactLaw::LineWeber => {
                let law = of_teeth(p, pair, tooth, cache, |pairs| AnySpring::LineWeber(pairs.line_weber()))?;
                of_face(law, DetailedFace::general(inner, outer))
            }
        })
    }

    /// Law that depends on the penetration at one cone distance.
    fn of_depth(spring: ImpactSpring, face: DetailedFace) -> Self {
        let whole = Resultant::new(spring.cone, 1.0);
        Self { spring: AnySpring::Impact(spring), whole, solid: None, face, friction_face: None, bodies: None }
    }

    /// Damping of a tooth pair.
    pub fn damping(p: &Parameters) -> Damping {
        match p.contact.damping_model {
            DampingModel::Step => {
                Damping::Step { coefficient: p.contact.damping, per_full_depth: 1.0 / p.contact.penetration_depth }
            }
            // a restitution without a corresponding damping was rejected before
            DampingModel::Restitution => Damping::HuntCrossley {
                lambda: damping::dimensionless_damping(p.contact.restitution).unwrap_or(0.0) / p.contact.impact_speed,
            },
        }
    }
}

/// Law from the stiffness of the teeth, and the gear bodies that pairs share, if they are elastic. Fails if their
/// stiffness cannot be computed.
fn of_teeth<S>(
    p: &Parameters,
    pair: &Pair,
    tooth: &ToothEffects,
    cache: &GearCache,
    law: impl Fn(&PairStiffness) -> S,
) -> Result<(S, Option<Arc<PairCouplings>>), Problem> {
    if !tooth.elastic_bodies {
        return Ok((law(&*cache.stiffness(p, pair)?), None));
    }
    let gears = cache.on_bodies(p, pair)?;
    Ok((law(&gears.stiffness), Some(gears.couplings.clone())))
}

fn impact(p: &Parameters, pair: &Pair) -> Impact {
    let hertz = || {
        let radius = |i| 0.5 * pair.outer_pitch_diameter(i);
        hertz::stiffness(radius(0), radius(1), p.material.young_modulus, p.material.poisson_ratio)
    };
    Impact {
        stiffness: if p.contact.stiffness_from_hertz { hertz() } else { p.contact.stiffness },
        exponent: p.contact.exponent,
        damping: p.contact.damping,
        per_full_depth: 1.0 / p.contact.penetration_depth,
    }
}
