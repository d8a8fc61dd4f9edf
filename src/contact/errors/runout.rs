//! Runout: the teeth of a gear stand eccentric to the axis it turns about.
//!
//! Radial runout F_r, the peak-to-peak reading of a probe across the axis over one revolution, is twice the
//! eccentricity ε (so ISO/TR 10064-2 on the runout of an eccentric gear). The teeth are displaced by ε along a direction
//! ê ⟂ a that turns with the gear, and as with any displacement e = −T·ε ê for the planet, +T·ε ê for the side gear:
//!
//!   e = ∓ε (cosβ T·u + sinβ T·t)
//!
//! (v instead of u for the side gear) with β the azimuth of ê from the plane of the axes: one period per revolution of
//! amplitude ε √(1 − (T·a)²) on both flanks, at phases as far apart as their normals. For tooth j in contact at s the gear's position is known: the
//! tooth's centre stands at ±(s/sinδ_bp − γ_p) on the planet, at ±(s/sinδ_bs + γ_s) on the side gear (+ drive,
//! − coast), and ê at a fixed angle from it. Two pairs in contact at once thus see nearly the same e, as they must.

use super::normals::push;
use super::{GearTeeth, MeshId, Normal, PairId, Random};
use crate::geometry::Pair;
use crate::numeric::{Jet, Scalar, TAU, sin_cos};
use crate::problem::Problem;

/// Eccentricity of all gears.
#[derive(Clone, Debug)]
pub struct Runout {
    /// Eccentricity of planets and side gears [m].
    eccentricity: [f64; 2],
    /// Azimuths of ê on each planet and on both side gears, in the direction in which teeth are counted [rad].
    direction: [Box<[f64]>; 2],
    pitch: [f64; 2],
    half_tooth: [f64; 2],
    per_lever: [f64; 2],
}

impl Runout {
    /// Gears with runout `runout` of planets and side gears [m], peak to peak, if any; phases are drawn from `seed`.
    pub fn new(runout: [f64; 2], seed: i32, pair: &Pair, planets: usize) -> Option<Self> {
        (runout != [0.0; 2]).then(|| {
            let phase = |gear: usize| TAU * Random::new(seed, gear, 0).unit();
            Self {
                eccentricity: runout.map(|r| r / 2.0),
                direction: [(0..planets).map(|i| phase(2 + i)).collect(), [phase(0), phase(1)].into()],
                pitch: pair.gears.map(|g| g.tooth_pitch()),
                half_tooth: [-pair.gears[0].half_pitch, pair.gears[1].half_pitch],
                per_lever: pair.sin_base().map(|l| 1.0 / l),
            }
        })
    }

    /// Eccentricity [m] of planet (`gear` = 0) or side gear (1) number `index`, in range, and the azimuth of ê from tooth
    /// 0 in the direction in which teeth are counted [rad].
    pub fn eccentricity(&self, gear: usize, index: usize) -> [f64; 2] {
        [self.eccentricity[gear], self.direction[gear][index]]
    }

    /// Most excess material of a pair [m].
    pub fn most_excess(&self) -> f64 {
        self.eccentricity[0].abs() + self.eccentricity[1].abs()
    }

    /// Azimuth of ê on gear `number`, in range: side gears left and right, then planets.
    pub fn azimuth(&self, number: usize) -> f64 {
        if number < 2 { self.direction[1][number] } else { self.direction[0][number - 2] }
    }

    /// Takes the azimuths of `gears`, as many as there are.
    pub fn turn(&mut self, gears: &[GearTeeth]) -> Result<(), Problem> {
        let [planets, sides] = &mut self.direction;
        for (azimuth, gear) in sides.iter_mut().chain(planets.iter_mut()).zip(gears) {
            if !gear.azimuth.is_finite() {
                return Err(Problem::new("tooth_errors.planet_runout", "an azimuth that is given is not finite"));
            }
            *azimuth = gear.azimuth;
        }
        Ok(())
    }

    /// Gap [m] of a pair, its indices in range, at `s` where the normal is `n`.
    #[inline]
    pub fn gap(&self, mesh: MeshId, pair: PairId, s: Jet, n: &Normal) -> Jet {
        // planet teeth are counted with the spin, which runs along t at the left mesh and against it at the right one
        let sense = if mesh.side == 0 { 1.0 } else { -1.0 };
        let from_tooth =
            |gear: usize, index: usize, tooth: usize| self.direction[gear][index] - self.pitch[gear] * tooth as f64;
        let along_ecc = |gear: usize, from_tooth: f64| {
            let centre = (s * self.per_lever[gear] + self.half_tooth[gear]) * push(pair.flank);
            let beta = centre + from_tooth;
            let (sin, cos) = sin_cos(beta.v);
            let towards = beta.through([cos, -sin, -cos]) * n.radial[gear] + beta.through([sin, cos, -sin]) * n.across;
            towards * self.eccentricity[gear]
        };
        along_ecc(1, from_tooth(1, mesh.side, pair.side_tooth))
            - along_ecc(0, sense * from_tooth(0, mesh.planet, pair.planet_tooth))
    }
}
