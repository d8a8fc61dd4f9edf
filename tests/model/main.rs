//! Tests of the whole model in simulations: motion, statics, tooth forces in space, mirror images, and the values that
//! have an effect.

mod assembled_jacobian;
mod body_compliance;
mod commands;
#[path = "../common/mod.rs"]
mod common;
mod communication;
mod declaration;
mod differential;
mod effective;
mod gear_cache;
mod gear_parameters;
mod held_at_start;
mod ideal_half_shafts;
mod ideal_lines;
mod input_derivatives;
mod mesh_history;
mod messages;
mod mirror;
mod momentum;
mod motion;
mod pair_lines;
mod problem;
mod solid_loads;
mod statics;
