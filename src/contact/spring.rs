//! Elasticity of one tooth pair: the interface that all laws share, and the laws that are the same everywhere on the path.

use super::Impact;

/// Elastic energy U(p, s) of a tooth pair with its derivatives: p the penetration arc [rad on the unit sphere], s the
/// place on the path of contact [rad]. s continues beyond the path's ends for corners in contact.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Elastic {
    /// U [J].
    pub energy: f64,
    /// Torque ∂U/∂p about the pole of the plane of action [N·m].
    pub torque: f64,
    /// ∂²U/∂p² [N·m/rad].
    pub stiffness: f64,
    /// ∂U/∂s [J/rad].
    pub by_place: f64,
    /// ∂²U/∂p∂s [N·m/rad].
    pub torque_by_place: f64,
    /// ∂²U/∂s² [J/rad²].
    pub by_place_twice: f64,
}

/// Elasticity of a tooth pair.
pub trait Spring {
    /// Whether the torque is proportional to the penetration, or zero.
    const LINEAR: bool = false;

    /// What of it follows from the place alone: the same at every cone distance.
    type Place: Copy;

    /// The law at place `s` [rad].
    fn place(&self, s: f64) -> Self::Place;

    /// Response at penetration arc `p` > 0 [rad] there.
    fn respond(&self, at: &Self::Place, p: f64) -> Elastic;

    /// Response at penetration arc `p` > 0 and place `s`.
    fn at(&self, p: f64, s: f64) -> Elastic {
        self.respond(&self.place(s), p)
    }
}

/// The place of a law that is the same everywhere.
#[derive(Clone, Copy, Debug)]
pub struct Anywhere;

/// K dᵉ of the penetration at a cone distance, whatever the place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ImpactSpring {
    /// The law; its damping is not used.
    pub law: Impact,
    /// Cone distance at which it acts [m].
    pub cone: f64,
}

impl ImpactSpring {
    /// A linear spring of stiffness `k` [N/m]: K d.
    pub fn linear(k: f64, cone: f64) -> Self {
        Self { law: Impact { stiffness: k, exponent: 1.0, damping: 0.0, per_full_depth: 0.0 }, cone }
    }
}

impl Spring for ImpactSpring {
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
