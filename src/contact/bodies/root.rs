//! Load of a tooth on the root cone, spread over the root section as in a beam.
//!
//! Over the root section of half width a, the force across the tooth is spread as a parabola, the force along the tooth
//! evenly, and the moment linearly, as in Weber's foundation. The section covers azimuths ±ζ_F of the root cone. All
//! its tractions are parallel: along or across the tooth's middle.

use crate::contact::stiffness::ToothSection;
use crate::geometry::Pair;
use crate::numeric::{TAU, asin, cos, sin, sqrt};

/// Gauss points and weights on one half of a panel (Abramowitz & Stegun, table 25.4).
const POINTS: [(f64, f64); 4] = [
    (0.183_434_642_495_649_8, 0.362_683_783_378_362),
    (0.525_532_409_916_329, 0.313_706_645_877_887_3),
    (0.796_666_477_413_626_7, 0.222_381_034_453_374_48),
    (0.960_289_856_497_536_3, 0.101_228_536_290_376_26),
];
/// Harmonics per panel of a root: four points on half a panel resolve a wave.
const PER_PANEL: f64 = 4.0;

/// Force across the tooth, force along it, and moment, caused by a unit load per ω.
pub type RootLoad = [f64; 3];

/// Components U, V, w along R, φ and ζ of one harmonic of each load. The components of a force along the tooth are even
/// in ζ, the others are odd.
pub type Waves = [[f64; 3]; 3];

/// The root of a tooth on its root cone.
#[derive(Clone, Copy, Debug)]
pub struct RootPatch {
    /// Polar angle φ of the root cone [rad].
    pub polar: f64,
    /// Half the azimuth of the root, ζ_F [rad].
    pub half_azimuth: f64,
    /// Means of cos ζ over the spread of a force across and a force along the tooth, and of sin ζ over the spread of a
    /// moment.
    means: [f64; 3],
    /// sin δ_b, the arm of every load on the flank.
    arm: f64,
}

impl RootPatch {
    /// Returns the root of the teeth of gear `i` of `pair` with the section `section`.
    pub fn new(pair: &Pair, i: usize, section: &ToothSection) -> Self {
        let gear = &pair.gears[i];
        // an angle of the virtual gear, divided by cos δ, is an angle of the gear
        let half_azimuth = asin(0.5 * section.root_chord / section.root_radius) / cos(gear.pitch);
        let mut patch = Self { polar: gear.root, half_azimuth, means: [0.0; 3], arm: sin(gear.base) };
        let mut means = [0.0; 3];
        patch.spread(1, |zeta, weight, [parabola, constant, linear]| {
            means[0] += weight * parabola * cos(zeta);
            means[1] += weight * constant * cos(zeta);
            means[2] -= weight * linear * sin(zeta);
        });
        patch.means = means;
        patch
    }

    /// Root load under a unit load on the flank at `angle` to the chord [rad], negative toward the tip. The stresses
    /// between slices have no moment about the apex, so both loads have the same moment. The line of the flank load
    /// crosses the tooth's middle at the polar angle φ_c, with sin φ_c = sin δ_b/cos τ.
    pub fn load(&self, angle: f64) -> RootLoad {
        let (s, c) = (sin(self.polar), cos(self.polar));
        let [across, along, turn] = self.means;
        let flat = sqrt((cos(angle) * cos(angle) - self.arm * self.arm).max(0.0));
        let force = (s * self.arm + c * flat) / (c * c + s * s * across);
        // cos τ sin(φ_c − δ_f), less the contribution of the spread force across the tooth
        let lever = self.arm * c - flat * s + force * s * c * (1.0 - across);
        [force, sin(angle) / (c * c + s * s * along), lever / (s * turn)]
    }

    /// Calls `visit` at Gauss points of one half of the root with ζ, the weight of both halves, and the spread of a
    /// unit force across, a unit force along, and a unit moment. There are enough points to resolve harmonic `n`.
    fn spread(&self, n: usize, mut visit: impl FnMut(f64, f64, [f64; 3])) {
        let width = self.half_azimuth * sin(self.polar);
        let panels = (1.0 + n as f64 * self.half_azimuth / PER_PANEL) as usize;
        let half = 0.5 / panels as f64;
        for panel in 0..panels {
            for (x, weight) in POINTS {
                for x in [-x, x] {
                    let y = (2.0 * panel as f64 + 1.0 + x) * half;
                    let spread = [0.75 * (1.0 - y * y) / width, 0.5 / width, -1.5 * y / (width * width)];
                    visit(y * self.half_azimuth, 2.0 * weight * half * width, spread);
                }
            }
        }
    }

    /// Term `n` of the Fourier series of the unit loads, per area.
    pub fn waves(&self, n: usize) -> Waves {
        let (s, c) = (sin(self.polar), cos(self.polar));
        let mut waves = [[0.0; 3]; 3];
        self.spread(n, |zeta, weight, [parabola, constant, linear]| {
            let (sin_z, cos_z) = (sin(zeta), cos(zeta));
            let (odd, even) = (sin(n as f64 * zeta), cos(n as f64 * zeta));
            let weight = weight / (TAU * s);
            let across = [s * sin_z * odd, c * sin_z * odd, cos_z * even];
            let along = [s * c * (cos_z - 1.0), c * c * cos_z + s * s, -c * sin_z];
            for k in 0..3 {
                waves[0][k] += weight * parabola * across[k];
                // w of a force along the tooth is odd and changes its sign, because W = i w
                waves[1][k] += weight * constant * along[k] * if k < 2 { even } else { -odd };
                waves[2][k] += weight * linear * along[k] * if k < 2 { odd } else { even };
            }
        });
        waves
    }
}
