//! Motion of a body against the surface it rubs on.

/// Motion of a body against the surface it rubs on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slip {
    /// Position [rad].
    pub position: f64,
    /// Speed [rad/s].
    pub speed: f64,
}
