//! The elastic body of one gear: displacement of its teeth under a load on one of them.
//!
//! Displacements of a root are work-conjugate to its loads. The compliance between two teeth, `angle` apart, is a sum
//! over harmonics n. Entries between loads of like parity in ζ use cos(n·angle), the others sin(n·angle).

use nalgebra::Matrix3;

use super::cone::HollowCone;
use super::{RootLoad, RootPatch, Support};
use crate::contact::stiffness::{Elasticity, ToothSection};
use crate::geometry::Pair;
use crate::numeric::{PI, TAU, sin, sin_cos, sqrt};
use crate::problem::Problem;

/// Number of waves over half the width of a root at the last harmonic of the series.
const WAVES: f64 = 4.0;
/// Harmonics up to which free ends of the face are computed. On shorter waves their effect falls with the wavelength.
const FINITE: usize = 8;
/// Number of nodes across a finite face.
const ACROSS: usize = 3;
/// Harmonics up to which the cone's curvature is computed exactly. For shorter waves the compliance is that of a
/// half-space with a first-order correction.
const CURVED: usize = 24;

/// The body of a gear under its teeth.
#[derive(Clone, Debug)]
pub struct GearBody {
    /// The teeth's roots.
    pub root: RootPatch,
    /// Compliance between unit loads of each harmonic: across, along, moment [1/Pa].
    harmonics: Vec<[[f64; 3]; 3]>,
}

impl GearBody {
    /// Returns the body of gear `i` of `pair`, whose teeth have the section `section`, held by `support`. Errors about
    /// the support name the variable `name`.
    pub fn new(
        pair: &Pair,
        i: usize,
        (section, elasticity): (&ToothSection, &Elasticity),
        support: Support,
        name: &'static str,
    ) -> Result<Self, Problem> {
        let root = RootPatch::new(pair, i, section);
        let held = support.held(pair, i, name)?;
        let face = [pair.inner_cone, pair.outer_cone];
        let cone = HollowCone { surface: root.polar, held, face, elasticity: *elasticity };
        let area = TAU * sin(root.polar) * sin(root.polar);
        let last = (WAVES * TAU / root.half_azimuth) as usize;
        let inelastic = || Problem::new("material.poisson_ratio", "the gear bodies have no stiffness");
        let compliance =
            |n: usize, across: usize| cone.compliance(n, support.is_free_to_turn(), across).ok_or_else(inelastic);
        let [finite, endless] = [compliance(FINITE, ACROSS)?, compliance(FINITE, 1)?];
        let ends = [0, 1, 2].map(|k| finite[(k, k)] / endless[(k, k)] - 1.0);
        let correction = compliance(CURVED, 1)? - cone.half_space(CURVED);
        let of = |n: usize| -> Result<Matrix3<f64>, Problem> {
            if n <= FINITE {
                return compliance(n, ACROSS);
            }
            let ratio = CURVED as f64 / n as f64;
            let endless =
                if n <= CURVED { compliance(n, 1)? } else { cone.half_space(n) + correction * (ratio * ratio) };
            let softer = ends.map(|end| sqrt(1.0 + end * FINITE as f64 / n as f64));
            Ok(Matrix3::from_fn(|i, j| endless[(i, j)] * softer[i] * softer[j]))
        };
        let harmonics = (0..=last)
            .map(|n| {
                let compliance = of(n)?;
                let waves = root.waves(n);
                let factor = if n == 0 { area } else { 2.0 * area };
                let displacements =
                    waves.map(|load| [0, 1, 2].map(|k| (0..3).map(|j| compliance[(k, j)] * load[j]).sum::<f64>()));
                Ok(waves
                    .map(|by| [0, 1, 2].map(|of| factor * (0..3).map(|k| by[k] * displacements[of][k]).sum::<f64>())))
            })
            .collect::<Result<_, Problem>>()?;
        Ok(Self { root, harmonics })
    }

    /// Compliance between the load on one tooth (column) and the displacement of a tooth `angle` [rad] further toward
    /// positive ζ (row) [1/Pa].
    pub fn compliance_between(&self, angle: f64) -> [[f64; 3]; 3] {
        let mut sum = [[0.0; 3]; 3];
        // angle-addition formulas: one sine and one cosine serve all harmonics
        let (step_sin, step_cos) = sin_cos(angle.rem_euclid(TAU) - if angle.rem_euclid(TAU) > PI { TAU } else { 0.0 });
        let (mut odd, mut even) = (0.0, 1.0);
        for part in &self.harmonics {
            for (row, by) in part.iter().enumerate() {
                for (column, compliance) in by.iter().enumerate() {
                    sum[row][column] += compliance
                        * match (row == ALONG, column == ALONG) {
                            (true, false) => odd,
                            (false, true) => -odd,
                            _ => even,
                        };
                }
            }
            (odd, even) = (odd * step_cos + even * step_sin, even * step_cos - odd * step_sin);
        }
        sum
    }

    /// Displacement of one tooth along the load `measured`, caused by the load `acting` on another tooth. `compliance`
    /// is the compliance between the two teeth [1/Pa].
    pub fn displacement(compliance: &[[f64; 3]; 3], measured: &RootLoad, acting: &RootLoad) -> f64 {
        (0..3).map(|i| measured[i] * (0..3).map(|j| compliance[i][j] * acting[j]).sum::<f64>()).sum()
    }
}

/// Index of the force along the tooth.
const ALONG: usize = 1;

#[cfg(test)]
#[path = "tests/body.rs"]
mod tests;
