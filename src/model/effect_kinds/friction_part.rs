//! Part of the dry friction on a body that one source contributes, and what it depends on: the load on the surface, and how the
//! body moves against it.

use super::SlipLaw;

/// Limit torque of one source, and its heat.
#[derive(Clone, Copy, Debug)]
pub struct FrictionPart {
    /// Constant part [N·m].
    pub constant: f64,
    /// Per thrust [m].
    pub per_thrust: f64,
    /// Per load.
    pub per_load: f64,
    /// Limit while stuck over limit while sliding.
    pub static_ratio: f64,
    /// What the limit while sliding becomes at speed.
    pub law: SlipLaw,
    /// Index of its heat.
    pub heat_index: usize,
}

impl FrictionPart {
    /// No friction.
    pub const NONE: Self = Self {
        constant: 0.0,
        per_thrust: 0.0,
        per_load: 0.0,
        static_ratio: 1.0,
        law: SlipLaw::CONSTANT,
        heat_index: 0,
    };

    /// The same pressed `factor` times as much.
    pub fn times(self, factor: f64) -> Self {
        let Self { constant, per_thrust, per_load, .. } = self;
        Self { constant: factor * constant, per_thrust: factor * per_thrust, per_load: factor * per_load, ..self }
    }

    /// Kinetic limit torque [N·m].
    pub(super) fn at(&self, by: &SurfaceLoad) -> f64 {
        self.constant + self.per_thrust * by.thrust + self.per_load * by.load
    }
}

/// Loads that press the surfaces together.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SurfaceLoad {
    /// Thrust on a side gear, or on a planet [N].
    pub thrust: f64,
    /// Magnitude of the torque of the meshes on a side gear [N·m], of the force across a planet's pin [N], or limit
    /// torque of a wheel [N·m].
    pub load: f64,
}

/// Motion of a body against the surface it rubs on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slip {
    /// Position [rad].
    pub position: f64,
    /// Speed [rad/s].
    pub speed: f64,
}
