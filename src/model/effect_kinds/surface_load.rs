//! What dry friction on a body depends on: the load on its surface.

/// Loads that press the surfaces together.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SurfaceLoad {
    /// Thrust on a side gear, or on a planet [N].
    pub thrust: f64,
    /// Magnitude of the torque of the meshes on a side gear [N·m], of the force across a planet's pin [N], or limit
    /// torque of a wheel [N·m].
    pub load: f64,
}
