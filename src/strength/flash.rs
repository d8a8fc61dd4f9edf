//! Flash temperature of two flanks that slide on each other (H. Blok, 1937).
//!
//! ```text
//! θ_fl = C μ w |v₁ − v₂| / (√b (B√|v₁| + B√|v₂|)),     C = 2M/π^1.5 = 0.7860
//! ```
//!
//! with the line load w, half the contact width b = √(4 w R/(π E*)), the flanks' speeds v₁, v₂ along the profile and
//! the thermal contact coefficient B = √(λ ρ c) of both flanks. The heat flow is distributed over the contact like
//! Hertz's pressure and enters both flanks perpendicularly. M = 2.1883 is the largest value of ∫ √(1 − s²)/√(x − s) ds
//! from −1 to x. ISO/TR 13989-1 and ISO/TS 10300-20 write C as 1.11/√2.

use crate::contact::tooth_friction::Sliding;
use crate::numeric::{PI, sqrt};

/// C for a heat flow distributed as a half ellipse.
const ELLIPSE: f64 = 0.785_983_4;

/// Constants of the formula.
#[derive(Clone, Copy, Debug)]
pub struct Flash {
    /// E* of the contact [Pa].
    pub modulus: f64,
    /// Thermal contact coefficient B of both flanks [W·√s/(m²·K)].
    pub coefficient: f64,
}

impl Flash {
    /// Flash temperature under the coefficient of friction `mu` [K].
    pub fn temperature(&self, at: &Sliding<f64>, mu: f64) -> f64 {
        let speeds = [1.0, -1.0].map(|sign| 0.5 * (at.sum_speed + sign * at.sliding));
        let carried = self.coefficient * (sqrt(speeds[0].abs()) + sqrt(speeds[1].abs()));
        let half_width = sqrt(4.0 * at.load * at.radius / (PI * self.modulus));
        let heat = mu.abs() * at.load * at.sliding.abs();
        if heat > 0.0 && carried > 0.0 && half_width > 0.0 {
            ELLIPSE * heat / (sqrt(half_width) * carried)
        } else {
            0.0
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Dimensionless temperature at x of a half-space over which a heat flow √(1 − s²) has moved, by Simpson's rule in
    /// the root of the distance.
    fn warmed(x: f64) -> f64 {
        let (most, n) = ((x + 1.0_f64).sqrt(), 4000);
        let f = |k: usize| {
            let u = most * k as f64 / n as f64;
            2.0 * (1.0 - (x - u * u).powi(2)).max(0.0).sqrt()
        };
        let sum: f64 = (0..=n).map(|k| f(k) * if k == 0 || k == n { 1.0 } else { 2.0 + 2.0 * (k % 2) as f64 }).sum();
        sum * most / (3.0 * n as f64)
    }

    #[test]
    fn the_constant_matches_a_moving_source() {
        let largest = (0..=4000).map(|k| warmed(-1.0 + k as f64 / 2000.0)).fold(0.0, f64::max);
        assert!((2.0 * largest / PI.powf(1.5) / ELLIPSE - 1.0).abs() < 1e-5, "{}", 2.0 * largest / PI.powf(1.5));
        // the standard's constant has three digits
        assert!((ELLIPSE * 2f64.sqrt() - 1.11).abs() < 2e-3);
    }

    #[test]
    fn a_contact_by_hand() {
        // steel, 400 N/mm, R = 10 mm, 3 and 1 m/s, μ = 0.05: b = 0.2122 mm, 40 kW/m
        let flash = Flash { modulus: 1.130_769e11, coefficient: 13_800.0 };
        let at = Sliding { sliding: 2.0, sum_speed: 4.0, load: 4e5, radius: 0.01 };
        let b: f64 = (4.0 * 4e5 * 0.01 / (PI * 1.130_769e11)).sqrt();
        let expected = 0.785_983_4 * 0.05 * 4e5 * 2.0 / (b.sqrt() * 13_800.0 * (3f64.sqrt() + 1.0));
        assert!((b - 2.1223e-4).abs() < 1e-8);
        assert!((flash.temperature(&at, -0.05) / expected - 1.0).abs() < 1e-12);
        assert_eq!(flash.temperature(&Sliding { sliding: 0.0, ..at }, 0.05), 0.0);
    }
}
