//! Elastic laws of a tooth pair. A new law implements [`Spring`] and adds one line each to the enumeration and to the
//! dispatch of [`AnySpring`].
//!
//! A pair whose flanks fit has one resultant, at a known cone distance. The penetration d = R p at this distance and
//! the damping determine its whole force. A pair whose flanks do not fit is summed over the face from the law per unit
//! of arc (`detailed`).

use super::impact::Force;
use super::stiffness::{Line, LineWeber};
use super::{Damping, Impact};

/// Elastic energy U(p, s) of a tooth pair with its derivatives. p is the penetration arc [rad on the unit sphere], s
/// the position on the path of contact [rad]. s continues beyond the ends of the path for corners in contact.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Elastic {
    /// U [J].
    pub energy: f64,
    /// Torque ∂U/∂p about the pole of the plane of action [N·m].
    pub torque: f64,
    /// ∂²U/∂p² [N·m/rad].
    pub stiffness: f64,
    /// ∂U/∂s [J/rad].
    pub by_s: f64,
    /// ∂²U/∂p∂s [N·m/rad].
    pub torque_by_s: f64,
    /// ∂²U/∂s² [J/rad²].
    pub by_s_twice: f64,
}

/// Force of a pair with one resultant, with its derivatives, including those with respect to the position on the path.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Response {
    /// Force along d with its derivatives.
    pub force: Force,
    /// ∂U/∂s [J/rad].
    pub by_s: f64,
    /// ∂²U/∂d∂s = ∂F_el/∂s [N/rad].
    pub elastic_by_s: f64,
    /// ∂F/∂s of the damped force [N/rad].
    pub total_by_s: f64,
    /// ∂²U/∂s² [J/rad²].
    pub by_s_twice: f64,
    /// U [J], if requested.
    pub energy: f64,
}

/// Resultant of a face whose flanks fit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Resultant {
    /// Cone distance at which the resultant acts [m].
    pub cone: f64,
    /// Reciprocal of the cone distance [1/m].
    pub per_cone: f64,
    /// Factor of the law: J = ∫R² dR [m³] for a law per unit of J, or 1.
    pub moment: f64,
}

impl Resultant {
    /// Returns the resultant of a face with the moment `moment` [m³], at the cone distance `cone` [m].
    pub fn new(cone: f64, moment: f64) -> Self {
        Self { cone, per_cone: 1.0 / cone, moment }
    }
}

/// Elasticity of a tooth pair.
pub trait Spring {
    /// True if the law depends on the position on the path.
    const DEPENDS_ON_POSITION: bool = true;

    /// Values of the law that depend only on the position on the path. They are the same at every cone distance.
    type Local: Copy;

    /// True if the torque is proportional to the penetration at p > 0.
    fn is_linear(&self) -> bool {
        false
    }

    /// Evaluates the law at position `s` [rad].
    fn local(&self, s: f64) -> Self::Local;

    /// Response at penetration arc `p` > 0 [rad] at the position with the values `at`.
    fn respond(&self, at: &Self::Local, p: f64) -> Elastic;

    /// Response at penetration arc `p` > 0 and position `s` [rad].
    fn at(&self, p: f64, s: f64) -> Elastic {
        self.respond(&self.local(s), p)
    }

    /// Response of a pair with one resultant at penetration `d` > 0 [m] and rate `rate` [m/s]. The energy is included
    /// if `WITH_ENERGY`.
    #[inline(always)]
    fn respond_whole<const WITH_ENERGY: bool>(
        &self,
        local: &Self::Local,
        (whole, damping): (&Resultant, &Damping),
        d: f64,
        rate: f64,
    ) -> Response {
        let e = self.respond(local, d * whole.per_cone);
        let (per_arc, per_depth) = (whole.moment, whole.moment * whole.per_cone);
        let (elastic, stiffness) = (per_depth * e.torque, per_depth * whole.per_cone * e.stiffness);
        let force = damping.apply(elastic, stiffness, d, rate);
        let elastic_by_s = per_depth * e.torque_by_s;
        // damping is either added to the elastic force or scales it
        let total_by_s = match *damping {
            _ if force.total <= 0.0 => 0.0,
            Damping::Step { .. } => elastic_by_s,
            Damping::HuntCrossley { lambda } => elastic_by_s * (1.0 + lambda * rate),
        };
        Response {
            force,
            by_s: per_arc * e.by_s,
            elastic_by_s,
            total_by_s,
            by_s_twice: per_arc * e.by_s_twice,
            energy: per_arc * e.energy,
        }
    }
}

/// Values of a law that is the same everywhere.
#[derive(Clone, Copy, Debug)]
pub struct Anywhere;

/// K dᵉ of the penetration at a cone distance, independent of the position on the path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ImpactSpring {
    /// The law; its damping is unused.
    pub law: Impact,
    /// Cone distance at which the law acts [m].
    pub cone: f64,
}

impl ImpactSpring {
    /// A linear spring of stiffness `k` [N/m]: K d.
    pub fn linear(k: f64, cone: f64) -> Self {
        Self { law: Impact { stiffness: k, exponent: 1.0, damping: 0.0, per_full_depth: 0.0 }, cone }
    }
}

impl Spring for ImpactSpring {
    const DEPENDS_ON_POSITION: bool = false;

    type Local = Anywhere;

    #[inline(always)]
    fn local(&self, _: f64) -> Anywhere {
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

    /// Uses the law directly, because it is a function of d already.
    #[inline(always)]
    fn respond_whole<const WITH_ENERGY: bool>(
        &self,
        _: &Anywhere,
        (_, damping): (&Resultant, &Damping),
        d: f64,
        rate: f64,
    ) -> Response {
        let energy = if WITH_ENERGY { self.law.energy(d) } else { 0.0 };
        Response { force: self.law.damped_by(damping, d, rate), energy, ..Response::default() }
    }
}

/// Any elastic law of a tooth pair or of a mesh.
#[derive(Clone, Debug)]
pub enum AnySpring {
    /// K dᵉ.
    Impact(ImpactSpring),
    /// Stiffness of the teeth, per unit of ∫R² dR.
    Line(Line),
    /// Stiffness of the teeth with a Hertz part that depends on the load.
    LineWeber(LineWeber),
}

/// Evaluates an expression with `law` bound to the elastic law in use. The second form evaluates `single` instead if
/// one spring replaces the tooth pairs.
macro_rules! with_spring {
    ($of:expr, $law:ident => $body:expr) => {
        match $of {
            $crate::contact::spring::AnySpring::Impact($law) => $body,
            $crate::contact::spring::AnySpring::Line($law) => $body,
            $crate::contact::spring::AnySpring::LineWeber($law) => $body,
        }
    };
    ($of:expr, $law:ident => $body:expr, if $is_single:expr => $single:expr) => {
        match $of {
            $crate::contact::spring::AnySpring::Impact($law) if $is_single => $single,
            $crate::contact::spring::AnySpring::Impact($law) => $body,
            $crate::contact::spring::AnySpring::Line($law) => $body,
            $crate::contact::spring::AnySpring::LineWeber($law) => $body,
        }
    };
}
pub(crate) use with_spring;

/// True if a law depends on the position of a pair.
pub(super) const fn depends_on_position<S: Spring>(_: &S) -> bool {
    S::DEPENDS_ON_POSITION
}

/// Part of any law that depends only on the position on the path.
#[derive(Clone, Copy, Debug)]
pub enum AnyLocal {
    /// Nothing.
    Anywhere,
    /// Values of [`Line`].
    Line(<Line as Spring>::Local),
    /// Values of [`LineWeber`].
    LineWeber(<LineWeber as Spring>::Local),
}

/// Dispatches to the law at each response, so that sums outside the steps are compiled once for all laws.
impl Spring for AnySpring {
    type Local = AnyLocal;

    fn is_linear(&self) -> bool {
        matches!(self, Self::Line(_))
    }

    #[inline(always)]
    fn local(&self, s: f64) -> AnyLocal {
        match self {
            Self::Impact(_) => AnyLocal::Anywhere,
            Self::Line(law) => AnyLocal::Line(law.local(s)),
            Self::LineWeber(law) => AnyLocal::LineWeber(law.local(s)),
        }
    }

    fn respond(&self, local: &AnyLocal, p: f64) -> Elastic {
        match (self, local) {
            (Self::Impact(law), _) => law.respond(&Anywhere, p),
            (Self::Line(law), AnyLocal::Line(local)) => law.respond(local, p),
            (Self::LineWeber(law), AnyLocal::LineWeber(local)) => law.respond(local, p),
            // values of a different law
            (Self::Line(_) | Self::LineWeber(_), _) => Elastic::default(),
        }
    }
}
