//! Points of a measured clutch torque over slip. They become a curve (`effect_kinds::torque_curve`).

use serde::{Deserialize, Serialize};

use crate::declaration::units::{NEWTON_METRE, RAD_PER_S, RPM};
use crate::declaration::{Condition, Declared, Field, RowsOf, add, all, any, when};
use crate::model::effect_kinds::TorqueCurve;
use crate::model::effect_kinds::torque_curve::POINTS;
use crate::problem::Problem;
use crate::static_memory::store;

use super::LimitedSlipSpec;

/// Point of the curve. A point with slip 0 and torque 0 is unset.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct CurvePoint {
    /// Slip speed [rad/s].
    pub slip: f64,
    /// Torque [N·m].
    pub torque: f64,
}

impl CurvePoint {
    /// Point that is unset.
    pub const UNSET: Self = Self { slip: 0.0, torque: 0.0 };
}

/// Names of the slips and torques in the interface.
macro_rules! names {
    ($($number:literal)+) => {
        /// Names of the slips.
        const SLIPS: [&str; POINTS] = [$(concat!("limited_slip.curve[", $number, "].slip")),+];
        /// Names of the torques, without the name of their group.
        const TORQUES: [&str; POINTS] = [$(concat!("curve[", $number, "].torque")),+];

        /// Condition that any point has a torque.
        fn has_torque() -> Condition {
            any([$(test!(LimitedSlipSpec, TORQUES[$number - 1], ">", |g| g.curve[$number - 1].torque > 0.0, [0.0])),+])
        }
    };
}

names! { 1 2 3 4 5 6 7 8 }

/// Condition that the curve holds the packs at standstill.
pub fn holds() -> Condition {
    all([
        test!(LimitedSlipSpec, "curve[1].slip", "=", |g| g.curve[0].slip == 0.0, [0.0]),
        test!(LimitedSlipSpec, TORQUES[0], ">", |g| g.curve[0].torque > 0.0, [0.0]),
    ])
}

impl Declared for [CurvePoint; POINTS] {
    fn rows<P: Copy + 'static>(group: &str, _: &str, _: &'static str, at: Field<P, Self>) -> RowsOf<P> {
        let has_torque = has_torque();
        let mut rows = Vec::new();
        for i in 0..POINTS {
            let slip =
                "Slip speed of this point of the measured clutch torque; a point is unset if slip and torque are 0";
            let slips = f64::rows(group, &SLIPS[i][group.len() + 1..], slip, store(move |p| &mut at(p)[i].slip));
            add(&mut rows, slips, &[&(RAD_PER_S | RPM), &(0.0..=1e4), &when(has_torque)]);
            let torque = "Torque of each clutch pack at this point, in addition to preload and mesh torque";
            let torques = f64::rows(group, TORQUES[i], torque, store(move |p| &mut at(p)[i].torque));
            add(&mut rows, torques, &[&NEWTON_METRE, &(0.0..=1e6)]);
        }
        rows
    }
}

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
