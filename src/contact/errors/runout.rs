//! Runout: the teeth of a gear are eccentric to its axis of rotation.
//!
//! The radial runout F_r is the peak-to-peak reading of a radial probe over one revolution. It is twice the
//! eccentricity ε (ISO/TR 10064-2, runout of an eccentric gear). The teeth are displaced by ε along the direction ê ⟂
//! a, fixed to the gear. Any displacement ε ê opens the gap e = −T·ε ê on the planet and +T·ε ê on the side gear:
//!
//!   e = ∓ε (cosχ T·u + sinχ T·t)
//!
//! with v instead of u for the side gear, and the azimuth χ of ê from the plane of the axes. The gap has one period per
//! revolution and the amplitude ε √(1 − (T·a)²) on both flanks. The phase difference between the flanks is that between
//! their normals.
//!
//! The contact position s of a tooth determines the position of its gear. The centre of the tooth is at the azimuth
//! ±(s/sinδ_bp − γ_p) on the planet and ±(s/sinδ_bs + γ_s) on the side gear (+ drive, − coast). ê is at a fixed angle
//! from the tooth. Two pairs that touch at the same time therefore have nearly the same e, as a displacement of the
//! whole gear requires.

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
    /// Azimuths of ê from tooth 0 on planets and side gears, positive in the direction of the tooth count [rad].
    direction: [Box<[f64]>; 2],
    /// Angular pitches of planets and side gears [rad].
    pitch: [f64; 2],
    /// −γ_p of planets and +γ_s of side gears [rad].
    half_tooth: [f64; 2],
    /// 1/sinδ_b of planets and side gears.
    per_lever: [f64; 2],
}

impl Runout {
    /// Returns gears with the peak-to-peak runouts `runout` of planets and side gears [m], with phases drawn from
    /// `seed`, or `None` if both runouts are 0.
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

    /// Eccentricity [m] of planet (`gear` = 0) or side gear (1) number `index`, and the azimuth of ê from tooth 0 in
    /// the direction of the tooth count [rad]. `index` must be in range.
    pub fn eccentricity(&self, gear: usize, index: usize) -> [f64; 2] {
        [self.eccentricity[gear], self.direction[gear][index]]
    }

    /// Upper bound of the excess material of a pair [m].
    pub fn max_excess(&self) -> f64 {
        self.eccentricity[0].abs() + self.eccentricity[1].abs()
    }

    /// Azimuth of ê on gear `number`: side gears left and right, then planets. `number` must be in range.
    pub fn azimuth(&self, number: usize) -> f64 {
        if number < 2 { self.direction[1][number] } else { self.direction[0][number - 2] }
    }

    /// Replaces the azimuths by those of `gears`, one entry per gear. Fails if a value is not finite.
    pub fn set_azimuths(&mut self, gears: &[GearTeeth]) -> Result<(), Problem> {
        let [planets, sides] = &mut self.direction;
        for (number, (azimuth, gear)) in sides.iter_mut().chain(planets.iter_mut()).zip(gears).enumerate() {
            if !gear.azimuth.is_finite() {
                let name = if number < 2 { "tooth_errors.side_runout" } else { "tooth_errors.planet_runout" };
                return Err(Problem::new(name, "a given azimuth is not finite"));
            }
            *azimuth = gear.azimuth;
        }
        Ok(())
    }

    /// Gap of a pair [m] at the position `s` with the normal `n`. The indices of mesh and pair must be in range.
    #[inline]
    pub fn gap(&self, mesh: MeshId, pair: PairId, s: Jet, n: &Normal) -> Jet {
        // planet teeth are counted in the direction of spin: along t at the left mesh, against t at the right mesh
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
