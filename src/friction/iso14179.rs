//! ISO/TR 14179-2: μ = 0.048 · (w/(v_Σ ρ))^0.2 · η^−0.05 · R_a^0.25 · X_L.
//!
//! w is in N/mm, v_Σ in m/s, ρ in mm, η in mPa·s, R_a in µm. The report defines the average over a mesh from the load
//! F_bt/b, the sum speed and the curvature at the pitch point, measured on test gears. Here the formula is used with
//! the values of each pair. The line load is at least 150 N/mm. The speed is at most that of 50 m/s on the pitch
//! circle; for a pressure angle of 20° this is v_Σ = 2·50·sin 20° = 34.2 m/s. Both bounds are smoothed over a tenth.
//!
//! Source: ISO/TR 14179-2:2001, after Schlenk (1994) and Niemann, Winter, Maschinenelemente II.

use super::{Conditions, Outside, ToothFrictionSpec, smooth};
use crate::numeric::{Scalar, sqrt};

/// Smallest line load [N/m].
const MIN_LOAD: f64 = 150e3;

/// Largest sum speed [m/s].
const FASTEST: f64 = 34.2;

const SOURCE: &str = "ISO/TR 14179-2";

/// Coefficient at positive speeds, load and radius.
pub fn coefficient<T: Scalar>(spec: &ToothFrictionSpec, at: &Conditions<T>) -> T {
    let load = smooth::floor(at.line_load, MIN_LOAD, 0.1 * MIN_LOAD) * 1e-3; // N/mm
    let speed = smooth::ceiling(at.sum_speed, FASTEST, 0.1 * FASTEST);
    let radius = at.radius * 1e3; // mm
    // η^−0.05 is combined with the fifth root, and R_a^0.25 is a root of a root: one power instead of three
    let fourth_root = |x: f64| sqrt(sqrt(x));
    let constant = 0.048 * fourth_root(spec.micrometres()) * spec.lubricant_factor.clamp(0.0, 10.0);
    (load / (speed * radius * fourth_root(spec.centipoise()))).powf(0.2) * constant
}

/// Returns the quantity outside the published range of the formula, or `None`.
pub fn outside(at: &Conditions<f64>) -> Option<Outside> {
    Outside::test(("line load w", "N/mm"), at.line_load * 1e-3, [MIN_LOAD * 1e-3, f64::INFINITY], SOURCE)
        .or_else(|| Outside::test(("sum speed v_Σ", "m/s"), at.sum_speed, [0.0, FASTEST], SOURCE))
}
