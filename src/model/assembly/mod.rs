//! From parameters to constants: inertias, contact laws, meshes, effects, gathered in `Model`.

pub mod body_effects;
pub mod face;
pub mod ideal;
pub mod inertias;
pub mod kept;
pub mod laws;
pub mod model;
pub mod rigid;
mod shelf;
mod solid;
pub mod teeth;

pub use body_effects::BodyEffects;
pub use ideal::{Ideal, IdealMotion};
pub use inertias::Inertias;
pub use model::{Gears, Given, Model, Watch};
pub use teeth::{Additions, SIGMA, Teeth};
