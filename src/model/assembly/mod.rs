//! From parameters to constants: inertias, contact laws, meshes, effects, gathered in `Model`.

pub mod body_effects;
mod cache;
pub mod face;
pub mod gear_cache;
pub mod ideal;
pub mod ideal_with_effects;
pub mod inertias;
pub mod laws;
pub mod model;
mod solid;
pub mod teeth;

pub use body_effects::BodyEffects;
pub use ideal::{Ideal, IdealMotion};
pub use inertias::Inertias;
pub use model::{Gears, Given, Model};
pub use teeth::{EffectTerms, SIGMA, Teeth};
