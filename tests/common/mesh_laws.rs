//! Contact laws built as a scene builds them, in both forms: for a plain mesh, and for a mesh in detail.

#![allow(dead_code)] // each test binary uses its own part

use bevel_differential::contact::ContactSpec;
use bevel_differential::contact::damping::Damping;
use bevel_differential::contact::detailed::Slice;
use bevel_differential::contact::impact::Impact;
use bevel_differential::contact::law::{DampedImpact, FaceLaw, Lumped};
use bevel_differential::contact::laws::AnySpring;
use bevel_differential::contact::mesh::Law;
use bevel_differential::contact::spring;
use bevel_differential::contact::stiffness::{PairStiffness, RootSpec};
use bevel_differential::geometry::{GearSpec, Pair};

/// 1/d_max [1/m].
pub const PER_FULL_DEPTH: f64 = 1e4;
/// No damping, that of IMPACT, and Hunt and Crossley's of a coefficient of restitution of 0.8 at 0.1 m/s.
pub const UNDAMPED: Damping = Damping::Step { coefficient: 0.0, per_full_depth: PER_FULL_DEPTH };
pub const STEP: Damping = Damping::Step { coefficient: 5e4, per_full_depth: PER_FULL_DEPTH };
pub const RESTITUTION: Damping = Damping::HuntCrossley { lambda: 3.6 };

/// Gears with these teeth of planet and side gear, exponent of the law, and backlash.
pub fn gears((planet_teeth, side_teeth, _, backlash): (i32, i32, f64, f64)) -> Pair {
    Pair::new(&GearSpec { planet_teeth, side_teeth, backlash, ..GearSpec::default() })
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kind {
    Impact,
    DampedImpact,
    Line,
    LineWeber,
    Lumped,
}

impl Kind {
    /// Whether the law acts on tooth pairs.
    pub fn has_pairs(self) -> bool {
        self != Kind::Lumped
    }
}

pub fn impact(exponent: f64, damping: f64) -> Impact {
    Impact { stiffness: 1.8e10, exponent, damping, per_full_depth: PER_FULL_DEPTH }
}

/// One law in both forms.
pub struct Built {
    pub law: Law,
    pub spring: AnySpring,
    /// The face as one slice.
    pub whole: Slice,
    pub cone: f64,
}

impl Built {
    pub fn new(pair: &Pair, kind: Kind, exponent: f64, damping: Damping) -> Self {
        let line_load = ContactSpec::default().line_load;
        let stiffness = PairStiffness::new(pair, &RootSpec::default(), 2.07e11, 0.25, line_load).unwrap();
        Self::of(pair, &stiffness, kind, exponent, damping)
    }

    /// The law `kind` on teeth of known stiffness.
    pub fn of(pair: &Pair, stiffness: &PairStiffness, kind: Kind, exponent: f64, damping: Damping) -> Self {
        let (outer, inner) = (pair.outer_cone, pair.inner_cone);
        let moment = (outer.powi(3) - inner.powi(3)) / 3.0;
        let centroid = 2.0 * moment / (outer.powi(2) - inner.powi(2));
        let per_cone = 1.0 / centroid;
        let elastic = impact(exponent, 0.0);
        let (law, spring, cone, weight) = match kind {
            Kind::Impact => {
                let Damping::Step { coefficient, .. } = damping else { panic!("IMPACT has its own damping") };
                let law = Law::Impact(impact(exponent, coefficient));
                (
                    law,
                    AnySpring::Impact(spring::ImpactSpring { law: elastic, cone: pair.mean_cone }),
                    pair.mean_cone,
                    1.0,
                )
            }
            Kind::DampedImpact => {
                let law = Law::DampedImpact(DampedImpact { elastic, damping });
                (
                    law,
                    AnySpring::Impact(spring::ImpactSpring { law: elastic, cone: pair.mean_cone }),
                    pair.mean_cone,
                    1.0,
                )
            }
            Kind::Line => {
                let specific = stiffness.line();
                let spring = AnySpring::Line(specific.clone());
                (Law::Line(FaceLaw { specific, moment, per_cone, damping }), spring, centroid, moment)
            }
            Kind::LineWeber => {
                let specific = stiffness.line_weber();
                let spring = AnySpring::LineWeber(specific.clone());
                (Law::LineWeber(FaceLaw { specific, moment, per_cone, damping }), spring, centroid, moment)
            }
            Kind::Lumped => {
                let k = stiffness.mesh_mean() * moment / (centroid * centroid);
                (
                    Law::Lumped(Lumped { stiffness: k, damping }),
                    AnySpring::Impact(spring::ImpactSpring::linear(k, centroid)),
                    centroid,
                    1.0,
                )
            }
        };
        let width = (pair.outer_cone - pair.inner_cone) * pair.mean_cone / cone;
        Self { law, spring, whole: Slice { cone, weight, width }, cone }
    }
}
