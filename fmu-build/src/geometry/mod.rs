//! The gears on paper: derived dimensions with the terms of ISO 23509, as a table and as JSON, for drawings and CAD.

pub mod command;
pub mod design;
pub mod dimensions;
mod gear_rows;
pub mod json;
mod pair_rows;
pub mod text;
mod tooth_rows;
pub mod tredgold;
