//! A tooth's load on the root cone: of its root section, spread as in a beam.
//!
//! Over the root section of half width a the force across the tooth is spread as a parabola, the force along it evenly, and
//! the moment linearly, as in Weber's foundation. The section stands on the root cone over azimuths ±ζ_F; all its tractions
//! point one way, along or across the tooth's middle.

use crate::contact::stiffness::ToothSection;
use crate::geometry::Pair;
use crate::numeric::{TAU, asin, cos, sin, sqrt};

/// Gauss points per panel (Abramowitz & Stegun, table 25.4), on half of it.
const POINTS: [(f64, f64); 4] = [
    (0.183_434_642_495_649_8, 0.362_683_783_378_362),
    (0.525_532_409_916_329, 0.313_706_645_877_887_3),
    (0.796_666_477_413_626_7, 0.222_381_034_453_374_48),
    (0.960_289_856_497_536_3, 0.101_228_536_290_376_26),
];
/// Harmonics per panel of a root: four points on half a panel follow a wave.
const PER_PANEL: f64 = 4.0;

/// Force across the tooth, force along it, and moment: of a unit load, per ω.
pub type RootLoad = [f64; 3];

/// A load's parts along R, φ and ζ of one harmonic: U, V, w. Those of a force along the tooth are even in ζ, the others odd.
pub type Waves = [[f64; 3]; 3];

/// The root of a tooth on its root cone.
#[derive(Clone, Copy, Debug)]
pub struct RootPatch {
    /// Polar angle φ of the root cone [rad].
    pub polar: f64,
    /// Half the azimuth that the root takes, ζ_F [rad].
    pub half_azimuth: f64,
    /// Means of cos ζ over the spread of a force across and of one along the tooth, and of sin ζ over that of a moment.
    means: [f64; 3],
    /// sin δ_b, the arm of every load on the flank.
    arm: f64,
}

impl RootPatch {
    /// The root of the teeth of gear `i` of `pair` with the section `section`.
    pub fn new(pair: &Pair, i: usize, section: &ToothSection) -> Self {
        let gear = &pair.gears[i];
        // an angle of the virtual gear is one of the gear over cos δ
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

    /// The load at the root of a unit load on the flank at the angle `angle` to the chord [rad], negative toward the tip. The
    /// stresses between slices have no moment about the apex, so that both loads have the same. The load crosses the
    /// tooth's middle at the polar angle φ_c, sin φ_c = sin δ_b/cos τ.
    pub fn load(&self, angle: f64) -> RootLoad {
        let (s, c) = (sin(self.polar), cos(self.polar));
        let [across, along, turn] = self.means;
        let flat = sqrt((cos(angle) * cos(angle) - self.arm * self.arm).max(0.0));
        let force = (s * self.arm + c * flat) / (c * c + s * s * across);
        // cos τ sin(φ_c − δ_f), and what the spread of the force across takes of it
        let lever = self.arm * c - flat * s + force * s * c * (1.0 - across);
        [force, sin(angle) / (c * c + s * s * along), lever / (s * turn)]
    }

    /// Calls `visit` at Gauss points of one half of the root with ζ, the weight of both halves, and the spread of a unit force
    /// across, one along, and a unit moment. As many as follow harmonic `n`.
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

    /// Part `n` of the Fourier series of the unit loads, per area.
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
                // w of a force along the tooth is odd and turns its sign, for W = i w
                waves[1][k] += weight * constant * along[k] * if k < 2 { even } else { -odd };
                waves[2][k] += weight * linear * along[k] * if k < 2 { odd } else { even };
            }
        });
        waves
    }
}
