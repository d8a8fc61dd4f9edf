//! Contribution of one surface to the dry friction on a body. It depends on the load on the surface and on the slip of
//! the body.

use super::{FrictionSource, SurfaceKind};

/// Limit torque of one surface. The law of sliding is in its source.
#[derive(Clone, Copy, Debug)]
pub struct FrictionPart {
    /// Constant torque [N·m].
    pub constant: f64,
    /// Torque per thrust [m].
    pub per_thrust: f64,
    /// Torque per load, in N·m over the unit of the load.
    pub per_load: f64,
    /// Index of its heat in the ledger.
    pub heat_index: usize,
    /// Number of its source.
    pub source: u16,
    /// Surface of the source.
    pub surface: SurfaceKind,
}

impl FrictionPart {
    /// No friction.
    pub const NONE: Self =
        Self { constant: 0.0, per_thrust: 0.0, per_load: 0.0, heat_index: 0, source: 0, surface: SurfaceKind::Side };

    /// Returns the part with `factor` times the friction.
    pub fn times(self, factor: f64) -> Self {
        let Self { constant, per_thrust, per_load, .. } = self;
        Self { constant: factor * constant, per_thrust: factor * per_thrust, per_load: factor * per_load, ..self }
    }

    /// Kinetic limit torque [N·m].
    pub(super) fn at(&self, by: &SurfaceLoad) -> f64 {
        self.constant + self.per_thrust * by.thrust + self.per_load * by.load
    }

    /// Limit torque while stuck [N·m].
    pub(super) fn breakaway(&self, source: &FrictionSource, by: &SurfaceLoad) -> f64 {
        if self.surface == SurfaceKind::SideCurve { self.constant } else { source.sliding.static_ratio * self.at(by) }
    }

    /// Limit torque of a surface of `source` [N·m] while the body slides at `speed` [rad/s] in its direction, and the
    /// derivative with respect to speed. It is `inline(never)` to keep the code of friction without slip dependence
    /// small.
    #[inline(never)]
    pub(super) fn sliding(&self, source: &FrictionSource, speed: f64, by: &SurfaceLoad) -> [f64; 2] {
        if self.surface == SurfaceKind::SideCurve {
            return source.side.curve.map_or([0.0; 2], |curve| curve.at(speed));
        }
        let ([value, slope], kinetic) = (source.law(self.surface).factor(speed), self.at(by));
        let [torque, by_speed] = [value * kinetic, slope * kinetic];
        let Some(limit) = source.pv_limit() else { return [torque, by_speed] };
        let pressure = source.pressed(self.surface).at(by);
        let [factor, by_pv] = limit.factor(pressure * speed);
        [factor * torque, factor * by_speed + by_pv * pressure * torque]
    }

    /// Derivatives of the torque of [`Self::sliding`] with respect to thrust and load.
    #[inline(never)]
    pub(super) fn slopes(&self, source: &FrictionSource, speed: f64, by: &SurfaceLoad) -> [f64; 2] {
        if self.surface == SurfaceKind::SideCurve {
            return [0.0; 2];
        }
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
    /// Mesh torque that presses the pack of a side gear [N·m], magnitude of the force across a planet's pin
    /// [N], or limit torque of a wheel [N·m].
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
