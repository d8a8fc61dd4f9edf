//! Part of the dry friction on a body that one surface contributes, and what it depends on: the load on the surface, and how the
//! body moves against it.

use super::{FrictionSource, SurfaceKind};

/// Limit torque of one surface. How it slides is known to its source.
#[derive(Clone, Copy, Debug)]
pub struct FrictionPart {
    /// Constant part [N·m].
    pub constant: f64,
    /// Per thrust [m].
    pub per_thrust: f64,
    /// Per load.
    pub per_load: f64,
    /// Index of its heat.
    pub heat_index: usize,
    /// Number of its source.
    pub source: u16,
    /// Which surface of it.
    pub surface: SurfaceKind,
}

impl FrictionPart {
    /// No friction.
    pub const NONE: Self =
        Self { constant: 0.0, per_thrust: 0.0, per_load: 0.0, heat_index: 0, source: 0, surface: SurfaceKind::Side };

    /// The same with `factor` times the friction.
    pub fn times(self, factor: f64) -> Self {
        let Self { constant, per_thrust, per_load, .. } = self;
        Self { constant: factor * constant, per_thrust: factor * per_thrust, per_load: factor * per_load, ..self }
    }

    /// Kinetic limit torque [N·m].
    pub(super) fn at(&self, by: &SurfaceLoad) -> f64 {
        self.constant + self.per_thrust * by.thrust + self.per_load * by.load
    }

    /// Limit torque of a surface of `source` while the body slides at `speed` in its direction [N·m], and its slope by speed.
    /// Apart: friction that does not change with slip has no need of it.
    #[inline(never)]
    pub(super) fn sliding(&self, source: &FrictionSource, speed: f64, by: &SurfaceLoad) -> [f64; 2] {
        let ([value, slope], kinetic) = (source.law(self.surface).factor(speed), self.at(by));
        let [torque, by_speed] = [value * kinetic, slope * kinetic];
        let Some(limit) = source.pv_limit() else { return [torque, by_speed] };
        let pressure = source.pressed(self.surface).at(by);
        let [factor, by_pv] = limit.factor(pressure * speed);
        [factor * torque, factor * by_speed + by_pv * pressure * torque]
    }

    /// Slopes of the same by thrust and load.
    #[inline(never)]
    pub(super) fn slopes(&self, source: &FrictionSource, speed: f64, by: &SurfaceLoad) -> [f64; 2] {
        let [value, _] = source.law(self.surface).factor(speed);
        let [by_thrust, by_load] = [value * self.per_thrust, value * self.per_load];
        let Some(limit) = source.pv_limit() else { return [by_thrust, by_load] };
        let pressed = source.pressed(self.surface);
        let [factor, by_pv] = limit.factor(pressed.at(by) * speed);
        let by_pressure = by_pv * speed * value * self.at(by);
        [factor * by_thrust + by_pressure * pressed.per_thrust, factor * by_load + by_pressure * pressed.per_load]
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
