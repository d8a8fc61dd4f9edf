//! State of a mesh, and its forces with their derivatives.

/// Mesh state: q, x and their rates.
#[derive(Clone, Copy, Debug, Default)]
pub struct MeshState {
    /// Relative position and planet travel [rad].
    pub position: [f64; 2],
    /// Their rates [rad/s].
    pub rate: [f64; 2],
    /// Indices of planet and side (0 left, 1 right), because solid teeth may be placed differently in each mesh.
    pub which: [usize; 2],
}

/// Forces of a mesh conjugate to (q, x) [N·m per rad on the unit sphere], and heat.
#[derive(Clone, Copy, Debug, Default)]
pub struct MeshForce {
    /// −∂V/∂(q, x) with damping [N·m].
    pub force: [f64; 2],
    /// Power turned into heat [W].
    pub heat: f64,
}

/// Derivatives of the forces of a mesh, and the mesh's energy, which is computed along with them.
#[derive(Clone, Copy, Debug, Default)]
pub struct MeshJacobian {
    /// ∂force/∂(q, x) [N·m/rad].
    pub by_position: [[f64; 2]; 2],
    /// ∂force/∂(q̇, ẋ) [N·m·s/rad].
    pub by_rate: [[f64; 2]; 2],
    /// Elastic energy V [J].
    pub energy: f64,
}
