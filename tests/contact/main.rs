//! Teeth in contact: laws, stiffness, and meshes of every kind, checked against explicit flanks, finite elements and
//! closed forms.

mod bench;
mod damping;
mod errors;
mod errors_explicit;
mod friction;
mod golden_pairs;
mod impact;
mod kinks;
mod mesh_conjugacy;
mod mesh_explicit;
#[path = "../common/mesh_laws.rs"]
mod mesh_laws;
mod mesh_rotated_flanks;
mod planet_contact;
mod profiles;
#[path = "../common/random.rs"]
mod random;
mod root_loads;
mod solid_contact;
mod stiffness_pairs;
mod tooth_bodies;
mod tooth_corner_stiffness;
#[path = "../common/tooth_errors.rs"]
mod tooth_errors;
mod tooth_finite_elements;
mod tooth_integrals;
mod tooth_laws;
mod tooth_load_points;
mod tooth_stiffness;
