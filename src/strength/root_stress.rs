//! Root stress of a straight bevel tooth by ISO 10300-3:2001, method B1.
//!
//! ```text
//! σ_F = F_mt/(b m_m) · Y_Fa Y_Sa Y_ε Y_K Y_LS · K_A K_v K_Fβ K_Fα,      F_mt = F_n cosα at R_m
//! ```
//!
//! F_n is the normal force of the whole mesh, including load factors. A simulated force already contains the dynamic
//! load (K_v = 1). The caller multiplies it by K_A and K_Fβ ([`super::face_load`]).
//!
//! The tooth form is that for a load at the tip. Y_ε converts the stress to a load at the outer point of single
//! contact, where one pair transmits the whole load: Y_ε = 0.25 + 0.75/ε_vα, not below 0.625. Y_K = ¼ (1 + l/b)² b/l
//! accounts for a middle line of contact shorter than the face, with l = 2 b √(ε_vα − 1)/ε_vα for straight teeth. Y_LS
//! = 1 for contact ratios up to 2. The 2014 edition has Y_BS instead of Y_K. The tooth thickness includes the thinning
//! for backlash. The standard would use the nominal thickness, which reduces the stress by 0.8 % for the default gears.
//!
//! If the force of each tooth pair is simulated, its stress follows from the position of the pair, without Y_ε:
//!
//! ```text
//! σ_F = F_mt/(b m_m) · Y_F Y_S Y_K Y_LS · K_A K_Fβ,      F_mt = F cosα of the pair
//! ```
//!
//! Y_F and Y_S are those of ISO 6336-3, method B, for a load at the diameter at which the pair touches. On the virtual
//! gear, the path of contact reaches from tip to tip, and positions in between are proportional.
//!
//! Everything is linear in the force.

use serde::{Deserialize, Serialize};

use super::{Profile, ToothForm};
use crate::geometry::{Pair, Tredgold};
use crate::numeric::{cos, sqrt};

/// Smallest contact ratio for Y_K, whose line of contact would shrink to a point at 1.
const MIN_RATIO: f64 = 1.05;
/// Number of positions along the path at which the stress of a pair is tabulated. Straight lines between them are
/// within 1e-3 of the formula.
const POSITIONS: usize = 32;

/// Root stress of one gear of a pair per force, with the factors of the standard.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct RootStressFactors {
    /// Form under load at the tip: Y_Fa and Y_Sa.
    pub tip: ToothForm,
    /// Form under load at the outer point of single contact: Y_F and Y_S of ISO 6336-3, method B.
    pub single: ToothForm,
    /// Contact ratio factor Y_ε.
    pub contact_ratio: f64,
    /// Bevel gear factor Y_K.
    pub bevel: f64,
    /// Load sharing factor Y_LS.
    pub load_sharing: f64,
    /// Stress per normal force of the mesh by method B1 [Pa/N].
    pub per_force: f64,
    /// Stress per normal force of one tooth pair at its outer point of single contact, without Y_ε [Pa/N], for
    /// comparison with method B1.
    pub per_single_force: f64,
    /// Stress per normal force of one tooth pair at equally spaced positions from the lower to the upper end of the
    /// path [Pa/N].
    per_pair_force: [f64; POSITIONS],
    /// Ends of the path [rad].
    path: [f64; 2],
}

impl RootStressFactors {
    /// Returns the factors of gear `i` of `pair` (0 planet, 1 side gear), whose root is cut by a tool of tip radius
    /// `tool_radius` modules. Returns `None` if the tooth has no valid root section, or if the stress per force is not
    /// positive and finite.
    pub fn new(pair: &Pair, i: usize, tool_radius: f64) -> Option<Self> {
        let profile = Profile::of(pair, i, tool_radius);
        let mate = Profile::of(pair, 1 - i.min(1), tool_radius);
        let tip = ToothForm::new(&profile, profile.tip_diameter())?;
        let single = ToothForm::new(&profile, profile.outer_single_contact(&mate))?;
        let ratio = Tredgold::new(pair).contact_ratio;
        let contact_ratio = contact_ratio_factor(ratio);
        let (bevel, load_sharing) = (bevel_factor(ratio), 1.0);
        let mean_module = pair.module * pair.mean_cone / pair.outer_cone;
        let face_width = pair.outer_cone - pair.inner_cone;
        let nominal = cos(pair.pressure_angle) / (face_width * mean_module);
        let per_force = nominal * tip.product() * contact_ratio * bevel * load_sharing;
        let per_single_force = nominal * single.product() * bevel * load_sharing;
        let per_pair_force = along_path(&profile, &mate, i).map(|product| nominal * product * bevel * load_sharing);
        let path = [pair.path.low, pair.path.high];
        let sound = per_force > 0.0 && per_force.is_finite();
        sound.then_some(Self {
            tip,
            single,
            contact_ratio,
            bevel,
            load_sharing,
            per_force,
            per_single_force,
            per_pair_force,
            path,
        })
    }

    /// Stress per normal force of one tooth pair at position `s` on the path [rad], without Y_ε [Pa/N]. Corner contact
    /// beyond an end of the path has the value of this end.
    pub fn per_force_at(&self, s: f64) -> f64 {
        let [low, high] = self.path;
        let scaled = ((s - low) / (high - low)).clamp(0.0, 1.0) * (POSITIONS - 1) as f64;
        let index = (scaled as usize).min(POSITIONS - 2);
        let [before, after] = [self.per_pair_force[index], self.per_pair_force[index + 1]];
        before + (scaled - index as f64) * (after - before)
    }

    /// Stress [Pa] under the normal force of the mesh [N], including load factors; 0 without force.
    pub fn stress(&self, force: f64) -> f64 {
        if force > 0.0 && force.is_finite() { self.per_force * force } else { 0.0 }
    }
}

/// Y_F Y_S of gear `i` (0 planet, 1 side gear) with `profile` at equally spaced positions along the path of contact
/// with `mate`, from the tip of the side gear to the tip of the planet.
fn along_path(profile: &Profile, mate: &Profile, i: usize) -> [f64; POSITIONS] {
    let [lowest, highest] = profile.contact_lengths(mate);
    let mut products = [0.0; POSITIONS];
    // from the tip of this gear to its root: a load below the root section has no lever and keeps the last stress
    let mut last = 0.0;
    for k in (0..POSITIONS).rev() {
        let length = lowest + (highest - lowest) * k as f64 / (POSITIONS - 1) as f64;
        last = ToothForm::new(profile, profile.diameter_at(length)).map_or(last, |form| form.product());
        products[if i == 0 { k } else { POSITIONS - 1 - k }] = last;
    }
    products
}

/// Y_ε for teeth without overlap at the contact ratio `ratio`.
pub fn contact_ratio_factor(ratio: f64) -> f64 {
    (0.25 + 0.75 / ratio.max(1.0)).max(0.625)
}

/// Y_K for straight teeth at the contact ratio `ratio`.
pub fn bevel_factor(ratio: f64) -> f64 {
    let ratio = ratio.clamp(MIN_RATIO, 2.0);
    let line = 2.0 * sqrt(ratio - 1.0) / ratio;
    0.25 * (1.0 + line) * (1.0 + line) / line
}
