//! Degrees of freedom: how many there can be, and the index of each.
//!
//! Some bodies turn against another one. The position of such an attached body is the twist, the angle of the other body less its own;
//! its velocity is absolute, and so not the rate of its position. A new one is a row of [`ATTACHED`]; an effect asks for it by its
//! moment of inertia (`Requests`).

/// Largest number of planets.
pub const MAX_PLANETS: usize = 4;
/// Largest number of groups of planets: each planet a group.
pub const MAX_GROUPS: usize = MAX_PLANETS;
/// Largest number of degrees of freedom: side gears, carrier, seats, planets and pins of all groups, and
/// what is attached to these.
pub const MAX_DOF: usize = CARRIER + 1 + 2 + 2 * MAX_GROUPS + ATTACHED_COUNT;
/// Number of bodies with dry friction: side gears, groups of planets, wheels.
pub const FRICTION_BODIES: usize = FRICTION_WHEELS + 2;
/// Index of the first group of planets among them.
pub const FRICTION_PLANETS: usize = 2;
/// Index of the left wheel among them.
pub const FRICTION_WHEELS: usize = FRICTION_PLANETS + MAX_GROUPS;

/// Index of the left side gear; its position is the angle α_L relative to the carrier.
pub const LEFT: usize = 0;
/// Index of the carrier; its position is θ_c.
pub const CARRIER: usize = 2;
/// Index of the planets of a scene without pins that move; positions are spins ψ relative to the carrier.
pub const PLANET: usize = 3;

/// A body that turns against another one.
pub struct Attached {
    /// The degree of freedom it turns against.
    pub to: usize,
    /// Its name in messages.
    pub name: &'static str,
    /// What it is, in the interface.
    pub what: &'static str,
    /// What its states belong to, by name.
    pub of: &'static str,
    /// Names of its position and its velocity there.
    pub states: [&'static str; 2],
}

/// Number of ends of half-shafts, the first among these bodies.
pub const ENDS: usize = 2;

/// All attached bodies, in the order of their degrees of freedom.
pub const ATTACHED: [Attached; ENDS] = [
    Attached {
        to: LEFT,
        name: "the left wheel",
        what: "End of the left half-shaft, 0 where it does not move by itself; for the wheel read left.wheel_speed. \
               Its position is the twist, side gear ahead",
        of: "left",
        states: ["shaft_twist", "end_speed"],
    },
    Attached {
        to: LEFT + 1,
        name: "the right wheel",
        what: "End of the right half-shaft, 0 where it does not move by itself; for the wheel read right.wheel_speed. \
               Its position is the twist, side gear ahead",
        of: "right",
        states: ["shaft_twist", "end_speed"],
    },
];

/// Number of attached bodies.
pub const ATTACHED_COUNT: usize = ATTACHED.len();

/// Index of each degree of freedom: side gears, carrier, [axial seats of the side gears], planets, [their pins], [ends of the
/// half-shafts], [what else is attached].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Layout {
    /// Number of groups of planets.
    pub groups: usize,
    /// Members of each group.
    pub members: [f64; MAX_GROUPS],
    /// Whether pins and seats move.
    pub has_pins: bool,
    /// Which bodies are attached, of `ATTACHED`.
    pub attached: [bool; ATTACHED_COUNT],
}

impl Layout {
    /// Index of the carrier.
    #[inline]
    pub fn carrier(&self) -> usize {
        CARRIER
    }
    /// Index of the axial seat of side gear `s`.
    #[inline]
    pub fn seat(&self, s: usize) -> usize {
        CARRIER + 1 + s
    }
    /// Index of the planets of group `g`.
    #[inline]
    pub fn planet(&self, g: usize) -> usize {
        CARRIER + 1 + if self.has_pins { 2 } else { 0 } + g
    }
    /// Index of the pin of group `g`.
    #[inline]
    pub fn pin(&self, g: usize) -> usize {
        self.planet(self.groups + g)
    }
    /// Index of the end of the half-shaft of side `s`.
    #[inline]
    pub fn end(&self, s: usize) -> usize {
        self.body(s)
    }
    /// Index of attached body `k`.
    #[inline]
    pub fn body(&self, k: usize) -> usize {
        let before = self.attached[..k].iter().map(|&is| usize::from(is)).sum::<usize>();
        self.planet(self.groups * if self.has_pins { 2 } else { 1 } + before)
    }
    /// Indices of the attached bodies and of those that they turn against.
    pub fn attached(&self) -> impl Iterator<Item = (usize, usize)> {
        (0..ATTACHED_COUNT).filter(|&k| self.attached[k]).map(|k| (self.body(k), ATTACHED[k].to))
    }
    /// Whether any is attached.
    #[inline]
    pub fn is_attached(&self) -> bool {
        self.attached.contains(&true)
    }
    /// Whether half-shafts have ends, which both have then.
    #[inline]
    pub fn has_ends(&self) -> bool {
        self.attached[0]
    }
    /// Whether half-shafts have ends, if no pins and seats move and nothing else is attached.
    pub fn plain(&self) -> Option<bool> {
        let others = self.has_pins || self.attached[ENDS..].contains(&true);
        (!others).then(|| self.has_ends())
    }
    /// Number of bodies that degree of freedom `i` stands for: the planets of a group move alike.
    pub fn bodies(&self, i: usize) -> f64 {
        let of_planet = i.checked_sub(self.planet(0)).filter(|&k| k < self.groups * if self.has_pins { 2 } else { 1 });
        of_planet.map_or(1.0, |k| self.members[k % self.groups])
    }
    /// Degrees of freedom.
    #[inline]
    pub fn count(&self) -> usize {
        self.body(ATTACHED_COUNT)
    }
}

/// Σ over the groups of planets, in twos: opposite planets, which are adjacent, may be alike.
#[inline]
pub fn over_groups(groups: usize, term: impl Fn(usize) -> f64) -> f64 {
    match groups {
        1 => term(0),
        2 => term(0) + term(1),
        3 => (term(0) + term(1)) + term(2),
        _ => (term(0) + term(1)) + (term(2) + term(3)),
    }
}
