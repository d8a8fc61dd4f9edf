//! S–N curves of carburised steel by ISO 6336-5 and ISO 6336-2/-3 for quality MQ.
//!
//! N_f = N_ref (S/σ)^k. The knee is at N_ref and the strength S. The slope k is computed from the life factor at the
//! low-cycle end, k = ln(N_ref/N_static)/ln Y_NT.

use serde::{Deserialize, Serialize};

use crate::numeric::pow;

/// Strength as a function of cycles.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct SnCurve {
    /// Strength S at the knee [Pa].
    pub strength: f64,
    /// Slope k for stresses above the knee.
    pub slope: f64,
    /// Number of cycles N_ref at the knee.
    pub reference_cycles: f64,
    /// Number of cycles N_static at the low-cycle end. At fewer cycles, the strength of the standard is constant.
    pub static_cycles: f64,
    /// Slope for stresses below the knee. `None` means an endurance limit. The slope k continued below the knee is
    /// Miner's rule in its elementary form.
    pub endurance_slope: Option<f64>,
}

impl SnCurve {
    /// Returns the curve through `strength` [Pa] at `reference_cycles` and through `life_factor` × `strength` at
    /// `static_cycles`. Below the knee the slope continues, which is conservative.
    pub fn through(strength: f64, reference_cycles: f64, life_factor: f64, static_cycles: f64) -> Self {
        let slope = libm::log(reference_cycles / static_cycles) / libm::log(life_factor);
        Self { strength, slope, reference_cycles, static_cycles, endurance_slope: Some(slope) }
    }

    /// Damage of one cycle at `stress` [Pa], 1/N_f: 0 without stress, at most 1.
    ///
    /// The standard states no life above the static strength. The slope continues in that range, so that damage sums
    /// stay smooth.
    pub fn damage_per_cycle(&self, stress: f64) -> f64 {
        let ratio = stress / self.strength;
        if ratio.is_nan() || ratio <= 0.0 {
            return 0.0;
        }
        let slope = if ratio >= 1.0 { Some(self.slope) } else { self.endurance_slope };
        match slope {
            Some(k) => (pow(ratio, k) / self.reference_cycles).clamp(0.0, 1.0),
            None => 0.0,
        }
    }
}

/// Strength of a gear's teeth.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ToothStrength {
    /// Root bending, pulsating load.
    pub bending: SnCurve,
    /// Pitting of the flanks.
    pub pitting: SnCurve,
    /// Idler factor Y_M: fraction of the bending strength that remains under reversed bending.
    pub idler_factor: f64,
}

impl Default for ToothStrength {
    /// Carburised steel like 20CrMnTi, MQ (ISO 6336-5): σ_FE = 2 σ_Flim with σ_Flim = 500 MPa, knee at 3·10⁶, Y_NT =
    /// 2.5 at 10³ (ISO 6336-3); σ_Hlim = 1500 MPa, knee at 5·10⁷, Z_NT = 1.6 at 10⁵ (ISO 6336-2); Y_M = 0.7.
    fn default() -> Self {
        Self {
            bending: SnCurve::through(2.0 * 500e6, 3e6, 2.5, 1e3),
            pitting: SnCurve::through(1500e6, 5e7, 1.6, 1e5),
            idler_factor: 0.7,
        }
    }
}

impl ToothStrength {
    /// Mean stress sensitivity M that is consistent with the idler factor: Y_M = (1 + M)/2 for purely alternating load
    /// (ISO 6336-3, annex B, with the stress ratio −1).
    pub fn mean_stress_sensitivity(&self) -> f64 {
        (2.0 * self.idler_factor - 1.0).clamp(0.0, 1.0)
    }
}
