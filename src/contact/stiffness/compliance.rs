//! Compliance of a loaded tooth pair per unit of width: bending, shear, compression and root of both teeth, and
//! Hertzian contact.
//!
//! C. Weber, K. Banaschek: Formänderung und Profilrücknahme bei gerad- und schrägverzahnten Rädern (1953), in plane
//! strain: E' = E/(1−ν²), ν' = ν/(1−ν). s(y) is the chord of the true profile, including the fillet. The load is at an
//! angle τ to the chord and crosses the tooth's middle at y_c, at a lever l above the root section with the chord s_F:
//!
//! q = cos²τ/E' { 12∫(y_c−y)²/s³ dy + (2.4(1+ν') + tan²τ)∫dy/s
//! + 18/π (l/s_F)² + 2(1−ν') l/s_F + 4.8/π (1 + tan²τ/(2.4(1+ν'))) }, integrals from y₀ to y_c.
//!
//! The Hertz part q_H is the approach of the middles of both teeth due to local deformation, divided by the load per
//! width w. The middles are at the depths t₁, t₂ below the flanks. With half the contact width b,
//! b² = 8w(1−ν²)/(πE) ρ₁ρ₂/(ρ₁+ρ₂), q_H = 2(1−ν²)/(πE) [ln(4t₁t₂/b²) − ν/(1−ν)].

use super::{FlankLoad, ToothSection};
use crate::numeric::{PI, sqrt};

/// Elastic constants of both gears.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Elasticity {
    /// Young's modulus E [Pa].
    pub young: f64,
    /// Poisson's ratio ν.
    pub poisson: f64,
}

impl Elasticity {
    /// Modulus in plane strain E' = E/(1−ν²) [Pa].
    pub fn plane_modulus(&self) -> f64 {
        self.young / (1.0 - self.poisson * self.poisson)
    }

    /// Factor B = 2(1−ν²)/(πE) of the Hertz compliance [1/Pa].
    pub fn hertz_factor(&self) -> f64 {
        2.0 / (PI * self.plane_modulus())
    }
}

/// Compliances of a tooth pair per unit of width [1/Pa], and its contact.
#[derive(Clone, Copy, Debug)]
pub struct PairCompliance {
    /// Compliances of the teeth q₁, q₂ [1/Pa].
    pub gear: [f64; 2],
    /// Hertz compliance q_H [1/Pa].
    pub hertz: f64,
    /// Half the contact width b [m].
    pub half_width: f64,
}

impl PairCompliance {
    /// q₁ + q₂ + q_H [1/Pa].
    pub fn total(&self) -> f64 {
        self.gear[0] + self.gear[1] + self.hertz
    }

    /// Stiffness c per unit of width [Pa]; 1e9 Pa = 1 N/(mm·µm).
    pub fn stiffness(&self) -> f64 {
        1.0 / self.total()
    }
}

impl ToothSection {
    /// Compliance q of the tooth per unit of width [1/Pa] under a load at roll length `roll` [m].
    pub fn compliance(&self, roll: f64, elasticity: &Elasticity) -> f64 {
        let load = self.load(roll);
        let nu = elasticity.poisson / (1.0 - elasticity.poisson);
        let (cos_squared, tan_squared) = self.squares(&load);
        let shear_factor = 2.4 * (1.0 + nu);
        let [bending, shear] = self.beam(&load);
        let lever_ratio = load.lever / self.root_chord;
        let root = 18.0 / PI * lever_ratio * lever_ratio
            + 2.0 * (1.0 - nu) * lever_ratio
            + 4.8 / PI * (1.0 + tan_squared / shear_factor);
        cos_squared / elasticity.plane_modulus() * (12.0 * bending + (shear_factor + tan_squared) * shear + root)
    }

    /// Compliance of the tooth [1/Pa] without its root, which is rigid. Bending and compression in plane strain are
    /// multiplied by `softening`.
    pub fn beam_compliance(&self, roll: f64, elasticity: &Elasticity, softening: f64) -> f64 {
        let load = self.load(roll);
        let nu = elasticity.poisson / (1.0 - elasticity.poisson);
        let (cos_squared, tan_squared) = self.squares(&load);
        let [bending, shear] = self.beam(&load);
        cos_squared / elasticity.plane_modulus()
            * (softening * (12.0 * bending + tan_squared * shear) + 2.4 * (1.0 + nu) * shear)
    }

    /// ∫(y_c−y)²/s³ dy and ∫dy/s from the root section to the point at which `load` crosses the middle.
    fn beam(&self, load: &FlankLoad) -> [f64; 2] {
        if load.lever < 0.0 {
            // the load crosses the middle below the root section: integrals of a tooth of constant chord
            let lever_ratio = load.lever / self.root_chord;
            return [lever_ratio * lever_ratio * lever_ratio / 3.0, lever_ratio];
        }
        self.bending.at(load.height)
    }

    /// cos²τ and tan²τ of `load`, from y_c = r_b/cosτ.
    fn squares(&self, load: &FlankLoad) -> (f64, f64) {
        let per_cosine = load.height / self.base_radius;
        (1.0 / (per_cosine * per_cosine), (per_cosine - 1.0) * (per_cosine + 1.0))
    }
}

/// Two sections in mesh without backlash, with their elastic constants.
#[derive(Clone, Debug)]
pub struct SectionPair {
    /// Sections of gear 1 and 2.
    pub sections: [ToothSection; 2],
    /// Elastic constants.
    pub elasticity: Elasticity,
}

impl SectionPair {
    /// Roll lengths of both gears [m] at the distance `distance` [m] from the pitch point along the line of action,
    /// positive toward gear 1's tip.
    pub fn rolls(&self, distance: f64) -> [f64; 2] {
        [self.sections[0].pitch_roll + distance, self.sections[1].pitch_roll - distance]
    }

    /// Compliances at the distance `distance` [m] from the pitch point under the load `line_load` [N/m].
    pub fn at(&self, distance: f64, line_load: f64) -> PairCompliance {
        self.at_rolls(self.rolls(distance), line_load)
    }

    /// Compliances at roll lengths `rolls` [m] under the load `line_load` [N/m].
    pub fn at_rolls(&self, rolls: [f64; 2], line_load: f64) -> PairCompliance {
        let gear = [0, 1].map(|i| self.sections[i].compliance(rolls[i], &self.elasticity));
        PairCompliance {
            gear,
            hertz: self.hertz_compliance(rolls, line_load),
            half_width: sqrt(self.half_width_squared(rolls, line_load)),
        }
    }

    /// Hertz compliance q_H [1/Pa] at roll lengths `rolls` [m] under `line_load` [N/m].
    pub fn hertz_compliance(&self, rolls: [f64; 2], line_load: f64) -> f64 {
        let depth = [0, 1].map(|i| self.sections[i].load(rolls[i]).depth);
        let b2 = self.half_width_squared(rolls, line_load);
        let nu = self.elasticity.poisson;
        self.elasticity.hertz_factor() * (libm::log(4.0 * depth[0] * depth[1] / b2) - nu / (1.0 - nu))
    }

    /// b² [m²] at roll lengths `rolls` [m] under `line_load` [N/m].
    pub fn half_width_squared(&self, rolls: [f64; 2], line_load: f64) -> f64 {
        4.0 * self.elasticity.hertz_factor() * line_load * (rolls[0] * rolls[1] / (rolls[0] + rolls[1]))
    }
}
