//! Friction in proportion to the torque of a mesh.

/// Coefficients c₁ of friction over the torque of the mesh, for torques that drive forward and backward.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Loss(pub [f64; 2]);

impl Loss {
    /// c₁ of the flank that carries `torque`.
    pub fn coefficient(&self, torque: f64) -> f64 {
        self.0[usize::from(torque < 0.0)]
    }

    /// c₁ |T| [N·m].
    pub fn of(&self, torque: f64) -> f64 {
        self.coefficient(torque) * torque.abs()
    }
}
