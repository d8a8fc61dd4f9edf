//! The laws there are, in both their forms: those of a plain mesh with their damping, and the elastic parts alone, of which a mesh
//! in detail is made. A new law is a line in each list and in each dispatch.

use super::law::{DampedImpact, FaceLaw, Lumped, PairLaw};
use super::solid::mesh::SolidMesh;
use super::spring::{self, Anywhere};
use super::stiffness::{Line, LineWeber};
use super::{Damping, Elastic, Impact, Spring};

/// Law of a mesh.
#[derive(Clone, Debug)]
pub enum Law {
    /// Adams IMPACT.
    Impact(Impact),
    /// Its elastic part with another damping.
    DampedImpact(DampedImpact),
    /// Stiffness of the teeth, linear.
    Line(FaceLaw<Line>),
    /// Stiffness of the teeth with the Hertz part by load.
    LineWeber(FaceLaw<LineWeber>),
    /// One spring per mesh.
    Lumped(Lumped),
    /// Solid teeth.
    Solid(Box<SolidMesh>),
}

/// Evaluates an expression with `law` bound to the law in use, or another with `solid` bound to a mesh of solid teeth.
macro_rules! with_law {
    ($of:expr, $law:ident => $body:expr, $solid:ident => $other:expr) => {
        match $of {
            $crate::contact::laws::Law::Impact($law) => $body,
            $crate::contact::laws::Law::DampedImpact($law) => $body,
            $crate::contact::laws::Law::Line($law) => $body,
            $crate::contact::laws::Law::LineWeber($law) => $body,
            $crate::contact::laws::Law::Lumped($law) => $body,
            $crate::contact::laws::Law::Solid($solid) if $crate::FULL => $other,
            // refused when the scene was checked
            $crate::contact::laws::Law::Solid(_) => unreachable!(),
        }
    };
}
pub(crate) use with_law;

/// Whether a law depends on the place of a pair.
pub(super) const fn is_placed<L: PairLaw>(_: &L) -> bool {
    L::PLACED
}

impl Law {
    /// Whether loads are spread over the face, growing with the cone distance.
    pub fn is_over_face(&self) -> bool {
        with_law!(self, law => is_placed(law), _solid => false)
    }

    /// Replaces the damping by one of the same kind.
    pub fn set_damping(&mut self, new: Damping) {
        with_law!(self, law => law.set_damping(new), solid => solid.damping = new);
    }
}

/// Any elastic law of a tooth pair or of a mesh.
#[derive(Clone, Debug)]
pub enum AnySpring {
    /// K dᵉ.
    Impact(spring::ImpactSpring),
    /// Stiffness of the teeth, per unit of ∫R² dR.
    Line(Line),
    /// The same with the Hertz part by load.
    LineWeber(LineWeber),
}

/// Evaluates an expression with `law` bound to the elastic law in use.
macro_rules! with_spring {
    ($of:expr, $law:ident => $body:expr) => {
        match $of {
            $crate::contact::laws::AnySpring::Impact($law) => $body,
            $crate::contact::laws::AnySpring::Line($law) => $body,
            $crate::contact::laws::AnySpring::LineWeber($law) => $body,
        }
    };
}
pub(crate) use with_spring;

/// What follows from the place alone, for any law.
#[derive(Clone, Copy, Debug)]
pub enum AnyPlace {
    /// Nothing.
    Anywhere,
    /// What [`Line`] has there.
    Line(<Line as Spring>::Place),
    /// What [`LineWeber`] has there.
    LineWeber(<LineWeber as Spring>::Place),
}

/// The law is looked up at each response, so that sums outside the steps are compiled once for all laws.
impl Spring for AnySpring {
    type Place = AnyPlace;

    #[inline(always)]
    fn place(&self, s: f64) -> AnyPlace {
        match self {
            Self::Impact(_) => AnyPlace::Anywhere,
            Self::Line(law) => AnyPlace::Line(law.place(s)),
            Self::LineWeber(law) => AnyPlace::LineWeber(law.place(s)),
        }
    }

    fn respond(&self, place: &AnyPlace, p: f64) -> Elastic {
        match (self, place) {
            (Self::Impact(law), _) => law.respond(&Anywhere, p),
            (Self::Line(law), AnyPlace::Line(place)) => law.respond(place, p),
            (Self::LineWeber(law), AnyPlace::LineWeber(place)) => law.respond(place, p),
            // of another law than this
            (Self::Line(_) | Self::LineWeber(_), _) => Elastic::default(),
        }
    }
}
