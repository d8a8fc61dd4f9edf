//! The contact law of a scene: from parameters to what a mesh, plain or in detail, follows.

use std::sync::Arc;

use crate::FULL;
use crate::contact::bodies::PairCouplings;
use crate::contact::damping::{self};
use crate::contact::detailed::{Face as CutFace, Slice};
use crate::contact::law::{DampedImpact, FaceLaw, Lumped};
use crate::contact::spring;
use crate::contact::stiffness::PairStiffness;
use crate::contact::{AnySpring, ContactLaw, Damping, DampingModel, Impact, Law, hertz};
use crate::geometry::Pair;
use crate::model::assembly::face::centroid;
use crate::model::assembly::gear_cache::GearCache;
use crate::model::assembly::solid;
use crate::model::effect_kinds::ToothEffects;
use crate::model::scene::GearContact;
use crate::model::setup::Parameters;
use crate::problem::Problem;

/// One law in its two forms.
pub struct Laws {
    /// For a plain mesh.
    pub law: Law,
    /// For a mesh in detail: the elastic part alone,
    pub spring: AnySpring,
    /// and the face it acts on.
    pub face: CutFace,
    /// The face over which flanks rub, if the law is valid at every cone distance.
    pub rubbed: Option<CutFace>,
    /// Cone distance at which the resultant of a pair acts [m].
    pub cone: f64,
    /// The bodies that pairs share, where they are elastic.
    pub bodies: Option<Arc<PairCouplings>>,
}

impl Laws {
    /// Law of the scene with what effects do to the teeth: loads that differ over the face, where the law holds at every cone
    /// distance, and elastic bodies.
    pub fn new(p: &Parameters, pair: &Pair, tooth: &ToothEffects, cache: &GearCache) -> Result<Self, Problem> {
        let cut = tooth.sliced;
        let damping = Self::damping(p);
        let (outer, inner) = (pair.outer_cone, pair.inner_cone);
        let moment = (outer * outer * outer - inner * inner * inner) / 3.0;
        let centroid = centroid(pair);
        // a resultant at `cone` of a load that grows with R, spread so that the line load is the one there
        let width = |cone: f64| (outer - inner) * pair.mean_cone / cone;
        let whole = |cone: f64, weight: f64| CutFace::whole(Slice { cone, weight, width: width(cone) });
        if p.scene.gear_contact == GearContact::Lumped {
            let per_width = if p.contact.mesh_stiffness_from_geometry {
                cache.mesh_mean(p, pair)?
            } else {
                p.contact.mesh_stiffness
            };
            let k = per_width * moment / (centroid * centroid);
            return Ok(Self {
                law: Law::Lumped(Lumped { stiffness: k, damping }),
                spring: AnySpring::Impact(spring::ImpactSpring::linear(k, centroid)),
                face: whole(centroid, 1.0),
                rubbed: None,
                cone: centroid,
                bodies: None,
            });
        }
        if FULL && p.scene.gear_contact == GearContact::Solid {
            let impact = impact(p, pair);
            let solids = cache.solid(pair, (&p.geometry, &p.solid, &solid::errors(p)), impact, damping);
            return Ok(Self {
                law: Law::Solid(Box::new(solids)),
                spring: AnySpring::Impact(spring::ImpactSpring { law: impact, cone: pair.mean_cone }),
                face: whole(pair.mean_cone, 1.0),
                rubbed: None,
                cone: pair.mean_cone,
                bodies: None,
            });
        }
        Ok(match p.contact.law {
            ContactLaw::Impact => {
                let impact = impact(p, pair);
                let law = match damping {
                    Damping::Step { .. } => Law::Impact(impact),
                    Damping::HuntCrossley { .. } => Law::DampedImpact(DampedImpact { elastic: impact, damping }),
                };
                let spring = AnySpring::Impact(spring::ImpactSpring { law: impact, cone: pair.mean_cone });
                let face = whole(pair.mean_cone, 1.0);
                Self { law, spring, face, rubbed: None, cone: pair.mean_cone, bodies: None }
            }
            ContactLaw::Line => {
                let (specific, bodies) = of_teeth(p, pair, tooth, cache, PairStiffness::line)?;
                let spring = AnySpring::Line(specific.clone());
                let law = Law::Line(FaceLaw { specific, moment, per_cone: 1.0 / centroid, damping });
                let rubbed = CutFace::cut(inner, outer);
                let face = if cut { rubbed } else { whole(centroid, moment) };
                Self { law, spring, face, rubbed: Some(rubbed), cone: centroid, bodies }
            }
            ContactLaw::LineWeber => {
                let (specific, bodies) = of_teeth(p, pair, tooth, cache, PairStiffness::line_weber)?;
                let spring = AnySpring::LineWeber(specific.clone());
                let law = Law::LineWeber(FaceLaw { specific, moment, per_cone: 1.0 / centroid, damping });
                let rubbed = CutFace::sliced(inner, outer);
                let face = if cut { rubbed } else { whole(centroid, moment) };
                Self { law, spring, face, rubbed: Some(rubbed), cone: centroid, bodies }
            }
        })
    }

    /// Damping of a tooth pair.
    pub fn damping(p: &Parameters) -> Damping {
        match p.contact.damping_model {
            DampingModel::Step => {
                Damping::Step { coefficient: p.contact.damping, per_full_depth: 1.0 / p.contact.penetration_depth }
            }
            // a restitution that has no damping to go with it is refused before
            DampingModel::Restitution => Damping::HuntCrossley {
                lambda: damping::dimensionless_damping(p.contact.restitution).unwrap_or(0.0) / p.contact.impact_speed,
            },
        }
    }
}

/// A law by the stiffness of the teeth, and the bodies that pairs share, where they are elastic.
fn of_teeth<S>(
    p: &Parameters,
    pair: &Pair,
    tooth: &ToothEffects,
    cache: &GearCache,
    law: impl Fn(&PairStiffness) -> S,
) -> Result<(S, Option<Arc<PairCouplings>>), Problem> {
    if !tooth.on_bodies {
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
