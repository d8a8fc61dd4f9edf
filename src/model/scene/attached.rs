//! Bodies that turn against another one. Each is a degree of freedom. Its position is the twist, the angle of the other body less
//! its own; its velocity is absolute, and so not the rate of its position. A new one is a row here; an effect asks for it by its
//! moment of inertia (`Requests`).

use super::layout::LEFT;

/// A body that turns against another one.
pub struct Attached {
    /// The degree of freedom it turns against.
    pub to: usize,
    /// What it is, in the interface.
    pub what: &'static str,
    /// What its states belong to, by name.
    pub of: &'static str,
    /// Names of its position and its velocity there.
    pub states: [&'static str; 2],
}

/// Number of ends of half-shafts, the first among these bodies.
pub const ENDS: usize = 2;

/// Those there can be, in the order of their degrees of freedom.
pub const ATTACHED: [Attached; ENDS] = [
    Attached {
        to: LEFT,
        what: "End of the left half-shaft, 0 where it does not move by itself; for the wheel read left.wheel_speed. \
               Its position is the twist, side gear ahead",
        of: "left",
        states: ["shaft_twist", "end_speed"],
    },
    Attached {
        to: LEFT + 1,
        what: "End of the right half-shaft, 0 where it does not move by itself; for the wheel read right.wheel_speed. \
               Its position is the twist, side gear ahead",
        of: "right",
        states: ["shaft_twist", "end_speed"],
    },
];

/// Their number.
pub const COUNT: usize = ATTACHED.len();
