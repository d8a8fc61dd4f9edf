//! Derivatives of the forces of a scene with effects.

use crate::integrate::Matrix;

/// Derivatives of forces and of the carrier's imposed acceleration.
pub struct Jacobian<const N: usize> {
    /// ∂force/∂position.
    pub by_position: Matrix<N>,
    /// ∂force/∂(rate of position).
    pub by_rate: Matrix<N>,
    /// ∂force/∂velocity.
    pub by_velocity: Matrix<N>,
    /// ∂(imposed acceleration of the carrier)/∂position and velocity.
    pub of_imposed: [[f64; N]; 2],
    /// Elastic energy of all meshes, which is found along with them [J].
    pub elastic_energy: f64,
}

impl<const N: usize> Default for Jacobian<N> {
    fn default() -> Self {
        Self {
            by_position: [[0.0; N]; N],
            by_rate: [[0.0; N]; N],
            by_velocity: [[0.0; N]; N],
            of_imposed: [[0.0; N]; 2],
            elastic_energy: 0.0,
        }
    }
}
