//! Contact laws as a scene builds them.

#![allow(dead_code)] // each test program uses only some items

use bevel_differential::contact::damping::Damping;
use bevel_differential::contact::detailed::{Face, Slice};
use bevel_differential::contact::spring::{ImpactSpring, Resultant};
use bevel_differential::contact::stiffness::{PairStiffness, RootSpec};
use bevel_differential::contact::{AnySpring, ContactSpec, Impact};
use bevel_differential::geometry::Pair;

/// 1/d_max [1/m].
pub const PER_FULL_DEPTH: f64 = 1e4;
/// No damping.
pub const UNDAMPED: Damping = Damping::Step { coefficient: 0.0, per_full_depth: PER_FULL_DEPTH };
/// Damping of IMPACT.
pub const STEP: Damping = Damping::Step { coefficient: 5e4, per_full_depth: PER_FULL_DEPTH };
/// Damping of Hunt and Crossley for a coefficient of restitution of 0.8 at 0.1 m/s.
pub const RESTITUTION: Damping = Damping::HuntCrossley { lambda: 3.6 };

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kind {
    Impact,
    Line,
    LineWeber,
    Lumped,
}

pub fn impact(exponent: f64) -> Impact {
    Impact { stiffness: 1.8e10, exponent, damping: 0.0, per_full_depth: PER_FULL_DEPTH }
}

/// An elastic law with the face on which it acts.
pub struct Built {
    pub spring: AnySpring,
    /// Point at which the resultant of a pair acts.
    pub whole: Resultant,
    /// Face concentrated in one point.
    pub face: Face,
    /// Face at many points, if the law is valid at every cone distance.
    pub distributed: Option<Face>,
}

impl Built {
    /// Creates the law `kind` for steel teeth.
    pub fn new(pair: &Pair, kind: Kind) -> Self {
        let line_load = ContactSpec::default().reference_line_load;
        let stiffness = PairStiffness::new(pair, &RootSpec::default(), 2.07e11, 0.25, line_load).unwrap();
        Self::of(pair, &stiffness, kind, 1.5)
    }

    /// Creates the law `kind` for teeth of known stiffness. The exponent applies to IMPACT.
    pub fn of(pair: &Pair, stiffness: &PairStiffness, kind: Kind, exponent: f64) -> Self {
        let (outer, inner) = (pair.outer_cone, pair.inner_cone);
        let moment = (outer.powi(3) - inner.powi(3)) / 3.0;
        let centroid = 2.0 * moment / (outer.powi(2) - inner.powi(2));
        let (spring, cone, weight, distributed) = match kind {
            Kind::Impact => {
                let cone = pair.mean_cone;
                (AnySpring::Impact(ImpactSpring { law: impact(exponent), cone }), cone, 1.0, None)
            }
            Kind::Line => (AnySpring::Line(stiffness.line()), centroid, moment, Some(Face::linear(inner, outer))),
            Kind::LineWeber => {
                (AnySpring::LineWeber(stiffness.line_weber()), centroid, moment, Some(Face::general(inner, outer)))
            }
            Kind::Lumped => {
                let k = stiffness.mesh_mean() * moment / (centroid * centroid);
                (AnySpring::Impact(ImpactSpring::linear(k, centroid)), centroid, 1.0, None)
            }
        };
        let width = (outer - inner) * pair.mean_cone / cone;
        Self {
            spring,
            whole: Resultant::new(cone, weight),
            face: Face::whole(Slice { cone, weight, width }),
            distributed,
        }
    }
}
