//! Forces of a mesh.

/// One mesh (a planet with one side gear).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct MeshForces {
    /// Sum of the normal forces of its tooth pairs [N].
    pub normal: f64,
    /// Tooth pairs carrying load.
    pub pairs: f64,
    /// Thrust on the side gear, along its axis away from the apex [N].
    pub side_thrust: f64,
    /// Thrust on the planet, along its axis away from the apex [N].
    pub planet_thrust: f64,
    /// Force on the side gear along the carrier's direction of rotation [N]; negative on the coast flank.
    pub tangential: f64,
    /// Transmission error: approach of the drive flanks at the mean cone distance [m].
    pub transmission_error: f64,
}
