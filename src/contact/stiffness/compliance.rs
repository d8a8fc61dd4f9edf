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
//! The Hertz part is the approach between the flank and the teeth's middles at depths t₁, t₂. With the load per width w
//! and half the contact width b,
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
    pub fn local(&self) -> f64 {
        2.0 / (PI * self.plane_modulus())
    }
}

/// Compliances of a tooth pair per unit of width [1/Pa], and its contact.
#[derive(Clone, Copy, Debug)]
pub struct PairCompliance {
    /// Compliances of the teeth q₁, q₂ [1/Pa].
    pub gear: [f64; 2],
    /// Hertz compliance q_H [1/Pa].
    pub local: f64,
    /// Half the contact width b [m].
    pub half_width: f64,
}

impl PairCompliance {
    /// q₁ + q₂ + q_H [1/Pa].
    pub fn total(&self) -> f64 {
        self.gear[0] + self.gear[1] + self.local
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
        let slide = 2.4 * (1.0 + nu);
        let [bending, shear] = self.beam(&load);
        let share = load.lever / self.root_chord;
        let root = 18.0 / PI * share * share + 2.0 * (1.0 - nu) * share + 4.8 / PI * (1.0 + tan_squared / slide);
        cos_squared / elasticity.plane_modulus() * (12.0 * bending + (slide + tan_squared) * shear + root)
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
            // a load that crosses the middle below the root section is extrapolated with a tooth of constant chord
            let share = load.lever / self.root_chord;
            return [share * share * share / 3.0, share];
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
    /// Roll lengths of both gears at `place` [m] from the pitch point along the line of action, toward gear 1's tip.
    pub fn rolls(&self, place: f64) -> [f64; 2] {
        [self.sections[0].pitch_roll + place, self.sections[1].pitch_roll - place]
    }

    /// Compliances at `place` [m] from the pitch point under the load `line_load` [N/m].
    pub fn at(&self, place: f64, line_load: f64) -> PairCompliance {
        self.at_rolls(self.rolls(place), line_load)
    }

    /// Compliances at roll lengths `rolls` [m] under the load `line_load` [N/m].
    pub fn at_rolls(&self, rolls: [f64; 2], line_load: f64) -> PairCompliance {
        let gear = [0, 1].map(|i| self.sections[i].compliance(rolls[i], &self.elasticity));
        PairCompliance {
            gear,
            local: self.local(rolls, line_load),
            half_width: sqrt(self.half_width_squared(rolls, line_load)),
        }
    }

    /// Hertz compliance q_H [1/Pa] at roll lengths `rolls` [m] under `line_load` [N/m].
    pub fn local(&self, rolls: [f64; 2], line_load: f64) -> f64 {
        let depth = [0, 1].map(|i| self.sections[i].load(rolls[i]).depth);
        let b2 = self.half_width_squared(rolls, line_load);
        let nu = self.elasticity.poisson;
        self.elasticity.local() * (libm::log(4.0 * depth[0] * depth[1] / b2) - nu / (1.0 - nu))
    }

    /// b² [m²] at roll lengths `rolls` [m] under `line_load` [N/m].
    pub fn half_width_squared(&self, rolls: [f64; 2], line_load: f64) -> f64 {
        4.0 * self.elasticity.local() * line_load * (rolls[0] * rolls[1] / (rolls[0] + rolls[1]))
    }
}
