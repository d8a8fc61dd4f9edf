//! All elastic laws behind one interface, for the detailed mesh.

use super::impact::Impact;
use super::spring::{Elastic, Spring};
use super::stiffness::{Line, LineWeber};

/// Any elastic law of a tooth pair or of a mesh.
#[derive(Clone, Debug)]
pub enum AnySpring {
    /// K dᵉ at a cone distance [m].
    Power(Impact, f64),
    /// A linear spring [N/m] at a cone distance [m].
    Linear(f64, f64),
    /// Stiffness of the teeth, per unit of ∫R² dR.
    Line(Line),
    /// The same with the Hertz part by load.
    LineWeber(LineWeber),
}

impl Spring for AnySpring {
    #[inline]
    fn at(&self, p: f64, s: f64) -> Elastic {
        match self {
            AnySpring::Line(law) => law.at(p, s),
            AnySpring::LineWeber(law) => law.at(p, s),
            AnySpring::Power(law, cone) => {
                let d = p * cone;
                let force = law.force(d, 0.0).elastic;
                Elastic {
                    energy: law.energy(d),
                    torque: cone * force,
                    stiffness: cone * cone * law.exponent * force / d,
                    ..Elastic::default()
                }
            }
            AnySpring::Linear(stiffness, cone) => {
                let k = stiffness * cone * cone;
                Elastic { energy: 0.5 * k * p * p, torque: k * p, stiffness: k, ..Elastic::default() }
            }
        }
    }
}
