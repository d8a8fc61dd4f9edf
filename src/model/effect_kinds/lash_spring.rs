//! Spring and damper with lash: T = max(0, k (x − b/2) + c ẋ) on one flank, and the mirror image on the other. A flank
//! damps only in contact and never pulls.

use crate::contact::WORTHWHILE;
use crate::numeric::Scalar;

/// Rate below which flanks may creep [rad/s], and displacement within a step, relative to half of the lash, up to which they
/// creep.
const SLOW: f64 = 1e-3;
const CREEPING: f64 = 1e-4;

/// Spring and damper with lash.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LashSpring {
    /// Stiffness k [N·m/rad].
    pub stiffness: f64,
    /// Damping c [N·m·s/rad].
    pub damping: f64,
    /// Half of the lash, b/2 [rad].
    pub half_lash: f64,
}

impl LashSpring {
    /// Depth of the flanks in contact, positive, and the direction in which they drive; `None` within the lash.
    fn contact<T: Scalar>(&self, x: T) -> Option<(T, f64)> {
        let direction = if x.value() < 0.0 { -1.0 } else { 1.0 };
        let depth = x * direction - self.half_lash;
        (depth.value() > 0.0).then_some((depth, direction))
    }

    /// Torque at the displacement `x` and its rate.
    pub fn torque<T: Scalar>(&self, x: T, rate: T) -> T {
        let Some((depth, direction)) = self.contact(x) else { return T::constant(0.0) };
        let pressing = depth * self.stiffness + rate * (direction * self.damping);
        if pressing.value() > 0.0 { pressing * direction } else { T::constant(0.0) }
    }

    /// Power that damping turns into heat [W].
    pub fn heat(&self, x: f64, rate: f64) -> f64 {
        let spring = self.contact(x).map_or(0.0, |(depth, direction)| direction * self.stiffness * depth);
        (self.torque(x, rate) - spring) * rate
    }

    /// Elastic energy [J].
    pub fn energy(&self, x: f64) -> f64 {
        let depth = self.contact(x).map_or(0.0, |(depth, _)| depth);
        0.5 * self.stiffness * depth * depth
    }

    /// Displacement at which the spring transmits the `torque` [N·m]; the middle of the lash without torque.
    pub fn displacement(&self, torque: f64) -> f64 {
        torque / self.stiffness + if torque == 0.0 { 0.0 } else { self.half_lash.copysign(torque) }
    }

    /// Fraction of a step of `h` [s] after which flanks touch or separate, if the displacement keeps its rate. Flanks that
    /// only creep at the edge of the lash need no step of their own.
    pub fn kink(&self, x: f64, rate: f64, h: f64) -> Option<f64> {
        if rate.abs() < SLOW && (rate * h).abs() <= CREEPING * self.half_lash {
            return None;
        }
        let fraction = |edge: f64| (edge - x) / (rate * h);
        [self.half_lash, -self.half_lash]
            .map(fraction)
            .into_iter()
            .filter(|fraction| (WORTHWHILE.0..WORTHWHILE.1).contains(fraction))
            .reduce(f64::min)
    }
}
