//! Points of a measured clutch torque over slip. They become a curve (`effect_kinds::torque_curve`).

use crate::declaration::units::{self, RPM};
use crate::declaration::{Parameter, Row, row};
use crate::model::effect_kinds::TorqueCurve;
use crate::model::effect_kinds::torque_curve::POINTS;
use crate::problem::Problem;

use super::LimitedSlipSpec;

spec! {
    /// Point of the curve. A point with slip 0 and torque 0 is unset.
    pub struct CurvePoint {
        /// Slip speed [rad/s].
        pub slip: f64 = 0.0,
        /// Torque [N·m].
        pub torque: f64 = 0.0,
    }
}

/// Condition under which the slips of points have an effect.
macro_rules! any_torque {
    () => {
        "limited_slip.curve[1].torque > 0 or limited_slip.curve[2].torque > 0 or limited_slip.curve[3].torque > 0 or \
         limited_slip.curve[4].torque > 0 or limited_slip.curve[5].torque > 0 or limited_slip.curve[6].torque > 0 or \
         limited_slip.curve[7].torque > 0 or limited_slip.curve[8].torque > 0"
    };
}

/// Names of the slip and the torque of each point, and their rows.
macro_rules! points {
    ($($number:literal)+) => {
        /// Names of the slips.
        const SLIPS: [&str; POINTS] = [$(concat!("limited_slip.curve[", $number, "].slip")),+];

        /// Rows of all points.
        pub fn rows() -> Vec<Row<Parameter<LimitedSlipSpec>>> {
            vec![$(
                row(
                    concat!("limited_slip.curve[", $number, "].slip"),
                    "Slip speed of this point of the measured clutch torque; a point is unset if slip and torque are 0",
                )
                .when(any_torque!())
                .real((units::RAD_PER_S, RPM), (0.0, 1e4), |p| &mut p.curve[$number - 1].slip),
                row(
                    concat!("limited_slip.curve[", $number, "].torque"),
                    "Torque of each clutch pack at this point, in addition to preload and mesh torque",
                )
                .real(units::NEWTON_METRE, (0.0, 1e6), |p| &mut p.curve[$number - 1].torque),
            )+]
        }
    };
}

points! { 1 2 3 4 5 6 7 8 }

/// Number of points up to the last one that is set.
fn count(points: &[CurvePoint; POINTS]) -> usize {
    points.iter().rposition(|point| point.slip > 0.0 || point.torque > 0.0).map_or(0, |last| last + 1)
}

/// Problem of the first point whose slip does not rise.
pub fn problem(points: &[CurvePoint; POINTS]) -> Option<Problem> {
    let set = &points[..count(points)];
    let i = (1..set.len()).find(|&i| set[i].slip <= set[i - 1].slip)?;
    Some(problem!(
        SLIPS[i],
        "{} rad/s is not above the slip of point {}, {} rad/s; slips must rise from point to point, and a point with \
         slip 0 and torque 0 is unset only after all others",
        set[i].slip,
        i,
        set[i - 1].slip
    ))
}

/// Curve through the points; `None` if no point has a torque. Points must be free of problems.
pub fn curve(points: &[CurvePoint; POINTS]) -> Option<TorqueCurve> {
    let set = &points[..count(points)];
    let points: Vec<[f64; 2]> = set.iter().map(|point| [point.slip, point.torque]).collect();
    TorqueCurve::new(&points).filter(|_| set.iter().any(|point| point.torque > 0.0))
}
