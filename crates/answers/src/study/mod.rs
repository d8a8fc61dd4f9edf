//! The study that this program replaces: what to simulate for it, and the comparison with it and with theory.

pub mod comparison;
pub mod evaluation;
pub mod published;
pub mod report;
pub mod theory;

/// The rows of the comparison that a short table has.
pub const EXCERPT: [&str; 5] = [
    "straight: left, deg/s",
    "turn: left, deg/s",
    "turn: right, deg/s",
    "T/r_p, all planets, outer, N",
    "straight: mesh frequency, Hz",
];
