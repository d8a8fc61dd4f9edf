//! What effects are made of: what one may declare (`effect`), and the kinds of things one may do: forces on bodies
//! (`body_effect`), dry friction that sticks (`friction_source`, `dry_friction`, `friction`), changes to single teeth (`teeth`).

pub mod body_effect;
pub mod dry_friction;
#[cfg(test)]
mod dry_friction_tests;
pub mod effect;
pub mod friction;
pub mod friction_part;
pub mod friction_source;
pub mod friction_state;
pub mod slip;
pub mod surface_load;
pub mod teeth;
