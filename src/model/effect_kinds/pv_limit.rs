//! Pressure times speed of a rubbing surface, and the change of friction beyond a limit of p v.
//!
//! ```text
//! p v = ω (P + P_F F + P_L L)      friction × g(p v),   g = 1 up to the limit,   g = b from 1.05 × the limit
//! ```
//!
//! with the slip speed ω, the thrust F and the load L on the surface. A normal force N on the area A at the radius r
//! has p = N/A and v = ω r. A friction torque T = μ N r therefore has p v = T ω/(μ A). From the limit (u = 0) to 1.05 ×
//! the limit (u = 1), the factor is g = 1 + (b − 1) u² (3 − 2u). It is differentiable everywhere. Temperature changes μ
//! but not N, so it does not change p v.
//!
//! Source: J. E. Shigley, Mechanical Engineering Design, on boundary-lubricated bearings: p v limits what a surface can
//! bear.

/// Width of the band in which friction changes, as a fraction of the limit.
const BAND: f64 = 0.05;

/// Limit of p·v.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PvLimit {
    /// Largest p·v at which friction has its given value [W/m²].
    pub limit: f64,
    /// b: friction beyond the band over friction up to the limit.
    pub beyond: f64,
}

impl PvLimit {
    /// True if friction changes at the limit.
    pub fn acts(&self) -> bool {
        self.limit > 0.0 && self.beyond != 1.0
    }

    /// g at `pv` [W/m²], and its derivative [m²/W].
    pub fn factor(&self, pv: f64) -> [f64; 2] {
        let width = BAND * self.limit;
        let u = (pv - self.limit) / width;
        if u <= 0.0 {
            return [1.0, 0.0];
        }
        if u >= 1.0 {
            return [self.beyond, 0.0];
        }
        let change = self.beyond - 1.0;
        [1.0 + change * u * u * (3.0 - 2.0 * u), change * 6.0 * u * (1.0 - u) / width]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::effect_kinds::{ActingSurface, ByLoad, RubbingSurface, SlipSpec, SurfaceLoad};
    use crate::model::scene::RubbingKind;

    const PRESSED: ByLoad = ByLoad { constant: 2e3, per_thrust: 9.0, per_load: 40.0 };
    const LIMIT: PvLimit = PvLimit { limit: 1e6, beyond: 0.6 };
    const PART: ActingSurface =
        ActingSurface { limit: ByLoad { constant: 30.0, per_thrust: 1e-3, per_load: 0.1 }, ..ActingSurface::NONE };

    fn source() -> RubbingSurface {
        let PvLimit { limit: pv_limit, beyond: beyond_limit } = LIMIT;
        RubbingSurface {
            radius: 0.05,
            pressed: PRESSED,
            sliding: SlipSpec {
                static_ratio: 1.2,
                stribeck_speed: 0.3,
                slip_slope: -0.01,
                pv_limit,
                beyond_limit,
                ..SlipSpec::default()
            },
            ..RubbingSurface::new(RubbingKind::Side, 0)
        }
    }

    /// Loads, and the speed at which p·v is `share` of the limit.
    fn at_share(share: f64) -> (SurfaceLoad, f64) {
        let by = SurfaceLoad { thrust: 4e3, load: 600.0 };
        (by, share * 1e6 / (2e3 + 9.0 * 4e3 + 40.0 * 600.0))
    }

    #[test]
    fn the_factor_runs_from_one_at_the_limit_to_its_value_beyond_without_a_kink() {
        for (pv, factor) in [(0.0, 1.0), (1e6, 1.0), (1.025e6, 0.8), (1.05e6, 0.6), (1e9, 0.6)] {
            assert!((LIMIT.factor(pv)[0] - factor).abs() < 1e-12, "{pv}");
        }
        let steepest = LIMIT.factor(1.025e6)[1].abs();
        for end in [1e6, 1.05e6] {
            for beside in [1.0 - 1e-9, 1.0 + 1e-9] {
                assert!(LIMIT.factor(end * beside)[1].abs() < 1e-6 * steepest, "{end} × {beside}");
            }
        }
        assert!(!PvLimit { limit: 0.0, ..LIMIT }.acts() && !PvLimit { beyond: 1.0, ..LIMIT }.acts() && LIMIT.acts());
    }

    #[test]
    fn torque_matches_its_formula_and_slopes_match_differences_below_within_and_beyond_the_band() {
        let source = source();
        for (share, factor) in [(0.7, 1.0), (1.01, 0.9584), (1.025, 0.8), (1.04, 0.6416), (2.0, 0.6)] {
            let (by, speed) = at_share(share);
            let v = 0.05 * speed;
            let curve = 1.0 + 0.2 * (-v / 0.3_f64).exp() - 0.01 * v;
            let expected = (30.0 + 1e-3 * 4e3 + 0.1 * 600.0) * curve * factor;
            let [torque, by_speed] = PART.sliding(&source, speed, &by);
            assert!((torque - expected).abs() < 1e-11, "{torque} for {expected}");
            let difference = |of: &dyn Fn(f64) -> f64, h: f64| (of(h) - of(-h)) / (2.0 * h);
            let [by_thrust, by_load] = PART.slopes(&source, speed, &by);
            for (slope, found) in [
                (by_speed, difference(&|h| PART.sliding(&source, speed + h, &by)[0], 1e-5 * speed)),
                (
                    by_thrust,
                    difference(&|h| PART.sliding(&source, speed, &SurfaceLoad { thrust: 4e3 + h, ..by })[0], 4e-2),
                ),
                (
                    by_load,
                    difference(&|h| PART.sliding(&source, speed, &SurfaceLoad { load: 600.0 + h, ..by })[0], 6e-3),
                ),
            ] {
                assert!((slope - found).abs() < 1e-6 * slope.abs(), "{share}: {slope} for {found}");
            }
        }
    }

    #[test]
    fn temperature_changes_torque_but_not_pressure() {
        let source = source();
        for share in [0.9, 1.02, 1.2] {
            let (by, speed) = at_share(share);
            let hot = ActingSurface { limit: PART.limit.times(0.5), ..PART };
            assert_eq!(hot.sliding(&source, speed, &by), PART.sliding(&source, speed, &by).map(|of| 0.5 * of));
            assert_eq!(hot.slopes(&source, speed, &by), PART.slopes(&source, speed, &by).map(|of| 0.5 * of));
        }
    }
}
