//! Addendum systems, which divide the working depth between the gears and define the clearance.
//!
//! Gleason's long-and-short addenda give the smaller gear the larger addendum, so that it is not undercut. With the
//! outer module m, h_a2 = (0.540 + 0.460/u_v) m with u_v = z₂ cosδ₁ / (z₁ cosδ₂), the working depth is 2 m, and the
//! whole depth is 2.188 m + 0.05 mm. ISO 23509:2016 divides the working depth differently: h_a2 = 2 m c_ham with the
//! mean addendum factor c_ham = 0.21 + 0.29/u_v. Both systems result in h_a2 = m at u_v = 1.

use super::{AddendumSystem, GearSpec};

/// Addendum and dedendum at the outer cone distance [m].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ToothHeights {
    /// Planet and side gear addenda h_a [m].
    pub addendum: [f64; 2],
    /// Planet and side gear dedenda h_f [m].
    pub dedendum: [f64; 2],
}

/// Gleason's constant part of the clearance [m].
const GLEASON_CLEARANCE: f64 = 0.05e-3;

/// Tooth heights of the pair `spec` with ratio of virtual teeth `u_v` ≥ 1 (larger over smaller gear).
pub fn tooth_heights(spec: &GearSpec, u_v: f64) -> ToothHeights {
    let m = spec.module;
    // [smaller gear, larger gear] from the larger gear's addendum, working depth 2 m and whole depth
    let long_and_short = |large: f64, whole: f64| {
        let addendum = [2.0 * m - large, large];
        ToothHeights { addendum, dedendum: [whole - addendum[0], whole - addendum[1]] }
    };
    let heights = match spec.addendum_system {
        AddendumSystem::Standard => ToothHeights { addendum: [m, m], dedendum: [1.25 * m, 1.25 * m] },
        AddendumSystem::Gleason => long_and_short((0.540 + 0.460 / u_v) * m, 2.188 * m + GLEASON_CLEARANCE),
        AddendumSystem::Iso23509 => long_and_short(2.0 * m * (0.21 + 0.29 / u_v), 2.25 * m),
        AddendumSystem::Explicit => {
            return ToothHeights {
                addendum: [spec.planet_addendum * m, spec.side_addendum * m],
                dedendum: [spec.planet_dedendum * m, spec.side_dedendum * m],
            };
        }
    };
    if spec.planet_teeth <= spec.side_teeth { heights } else { swap(heights) }
}

fn swap(h: ToothHeights) -> ToothHeights {
    ToothHeights { addendum: [h.addendum[1], h.addendum[0]], dedendum: [h.dedendum[1], h.dedendum[0]] }
}
