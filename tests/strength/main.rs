//! Strength: pressure, root stress, load over the face, damage along steps.

mod along_steps;
mod carried_loads;
#[path = "../common/mod.rs"]
mod common;
mod face;
mod fatigue;
mod flash;
mod hertz;
mod loads;
mod mean_stress;
#[path = "../common/mesh_laws.rs"]
mod mesh_laws;
mod rainflow;
mod safety;
mod slices;
mod standing;
mod textbook;
mod tooth_by_tooth;
#[path = "../common/tooth_errors.rs"]
mod tooth_errors;
