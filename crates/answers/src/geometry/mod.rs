//! Gears for drawings and CAD: dimensions in the terms of ISO 23509, curves, solids, interference.

pub mod assembly;
pub mod design;
pub mod dimension;
pub mod dimensions;
mod gear_rows;
pub mod interference;
pub mod json;
mod pair_rows;
pub mod shape;
pub mod text;
mod tooth_rows;
pub mod tredgold;
pub mod xyz;
