//! Derivatives of the forces of a scene with effects.

use crate::integrate::Matrix;

/// Derivatives of forces and of the carrier's imposed acceleration.
pub struct Jacobian<'a, const N: usize> {
    /// ∂force/∂position.
    pub by_position: &'a mut Matrix<N>,
    /// ∂force/∂(rate of position).
    pub by_rate: Matrix<N>,
    /// ∂force/∂velocity.
    pub by_velocity: &'a mut Matrix<N>,
    /// ∂(imposed acceleration of the carrier)/∂position and velocity.
    pub of_imposed: [[f64; N]; 2],
    /// Elastic energy of all meshes, which is found along with them [J].
    pub elastic_energy: f64,
}

impl<'a, const N: usize> Jacobian<'a, N> {
    /// Nothing yet; what is by position and velocity is added to these.
    #[inline]
    pub fn new([by_position, by_velocity]: [&'a mut Matrix<N>; 2]) -> Self {
        Self { by_position, by_rate: [[0.0; N]; N], by_velocity, of_imposed: [[0.0; N]; 2], elastic_energy: 0.0 }
    }
}
