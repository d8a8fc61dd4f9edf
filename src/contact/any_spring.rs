//! All elastic laws behind one interface, for the detailed mesh.

use super::impact::Impact;
use super::spring::{Elastic, Spring};
use super::stiffness::{Line, LineWeber};

/// Any elastic law of a tooth pair or of a mesh.
#[derive(Clone, Debug)]
pub enum AnySpring {
    /// K dᵉ.
    Power(Power),
    /// A linear spring.
    Linear(Linear),
    /// Stiffness of the teeth, per unit of ∫R² dR.
    Line(Line),
    /// The same with the Hertz part by load.
    LineWeber(LineWeber),
}

/// Evaluates an expression with `law` bound to the elastic law in use.
macro_rules! with_spring {
    ($of:expr, $law:ident => $body:expr) => {
        match $of {
            $crate::contact::any_spring::AnySpring::Power($law) => $body,
            $crate::contact::any_spring::AnySpring::Linear($law) => $body,
            $crate::contact::any_spring::AnySpring::Line($law) => $body,
            $crate::contact::any_spring::AnySpring::LineWeber($law) => $body,
        }
    };
}
pub(crate) use with_spring;

/// What of any law follows from the place alone.
#[derive(Clone, Copy, Debug)]
pub enum AnyPlace {
    /// Nothing.
    Anywhere,
    /// What [`Line`] has there.
    Line(<Line as Spring>::Place),
    /// What [`LineWeber`] has there.
    LineWeber(<LineWeber as Spring>::Place),
}

/// The law is asked for at each response: for sums that steps do not take, which thus are compiled once for all laws.
impl Spring for AnySpring {
    type Place = AnyPlace;

    #[inline(always)]
    fn place(&self, s: f64) -> AnyPlace {
        match self {
            Self::Power(_) | Self::Linear(_) => AnyPlace::Anywhere,
            Self::Line(law) => AnyPlace::Line(law.place(s)),
            Self::LineWeber(law) => AnyPlace::LineWeber(law.place(s)),
        }
    }

    fn respond(&self, place: &AnyPlace, p: f64) -> Elastic {
        match (self, place) {
            (Self::Power(law), _) => law.respond(&Anywhere, p),
            (Self::Linear(law), _) => law.respond(&Anywhere, p),
            (Self::Line(law), AnyPlace::Line(place)) => law.respond(place, p),
            (Self::LineWeber(law), AnyPlace::LineWeber(place)) => law.respond(place, p),
            // of another law than this
            (Self::Line(_) | Self::LineWeber(_), _) => Elastic::default(),
        }
    }
}

/// The place of a law that is the same everywhere.
#[derive(Clone, Copy, Debug)]
pub struct Anywhere;

/// K dᵉ of the penetration at a cone distance, whatever the place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Power {
    /// The law; its damping is not used.
    pub law: Impact,
    /// Cone distance at which it acts [m].
    pub cone: f64,
}

impl Spring for Power {
    type Place = Anywhere;

    #[inline(always)]
    fn place(&self, _: f64) -> Anywhere {
        Anywhere
    }

    #[inline(always)]
    fn respond(&self, _: &Anywhere, p: f64) -> Elastic {
        let d = p * self.cone;
        let force = self.law.force(d, 0.0);
        Elastic {
            energy: self.law.energy(d),
            torque: self.cone * force.elastic,
            stiffness: self.cone * self.cone * force.by_depth,
            ..Elastic::default()
        }
    }
}

/// A linear spring at a cone distance, whatever the place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Linear {
    /// Stiffness about the pole of the plane of action [N·m/rad].
    pub stiffness: f64,
}

impl Linear {
    /// A spring of stiffness `k` [N/m] at the cone distance `cone` [m].
    pub fn new(k: f64, cone: f64) -> Self {
        Self { stiffness: k * cone * cone }
    }
}

impl Spring for Linear {
    type Place = Anywhere;

    #[inline(always)]
    fn place(&self, _: f64) -> Anywhere {
        Anywhere
    }

    #[inline(always)]
    fn respond(&self, _: &Anywhere, p: f64) -> Elastic {
        let torque = self.stiffness * p;
        Elastic { energy: 0.5 * torque * p, torque, stiffness: self.stiffness, ..Elastic::default() }
    }
}
