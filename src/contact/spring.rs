//! Elasticity of one tooth pair: the interface that all laws share.

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
