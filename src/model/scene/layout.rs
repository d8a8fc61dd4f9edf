//! Degrees of freedom: their maximum number, and the index of each.
//!
//! An attached body turns relative to another body. Its position is the twist: the angle of the other body minus its
//! own angle. Its velocity is absolute, so it is not the rate of its position. An effect declares its attached bodies
//! (`Declare::BODIES`) and requests them for a scene by their moments of inertia (`Requests`).

/// Maximum number of planets.
pub const MAX_PLANETS: usize = 4;
/// Maximum number of planet groups, which occurs if each planet is a group.
pub const MAX_GROUPS: usize = MAX_PLANETS;
/// Maximum number of degrees of freedom: side gears, carrier, seats, planets and pins of all groups, and attached
/// bodies.
pub const MAX_DOF: usize = CARRIER + 1 + 2 + 2 * MAX_GROUPS + ATTACHED_COUNT;

/// Index of the left side gear; its position is the angle α_L relative to the carrier.
pub const LEFT: usize = 0;
/// Index of the carrier; its position is θ_c.
pub const CARRIER: usize = 2;
/// Index of the first planet group in a scene whose pins do not move. Positions are spins ψ relative to the carrier.
pub const PLANET: usize = 3;

/// Number of bodies that effects may attach. The list of effects checks it.
pub const ATTACHED_COUNT: usize = 4;
/// Number of half-shaft ends, which are the first attached bodies.
pub const ENDS: usize = 2;
/// Number of attached bodies for which steps are compiled separately: the half-shaft ends, or the bodies in front of
/// the carrier.
pub const FEW: usize = 2;
/// Number of the pinion of the final drive among the attached bodies. It turns relative to the carrier.
pub const PINION: usize = 2;
/// Number of the driven end of the propeller shaft among the attached bodies.
pub const PROPELLER: usize = 3;

/// Index of each degree of freedom, in the order side gears, carrier, axial seats of the side gears, planets, their
/// pins, half-shaft ends, other attached bodies. Seats, pins, ends and other attached bodies are optional.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Layout {
    /// Number of planet groups.
    pub groups: usize,
    /// Number of planets in each group.
    pub members: [f64; MAX_GROUPS],
    /// True if pins and seats move.
    pub has_pins: bool,
    /// Degree of freedom relative to which each attached body turns; `None` if the scene does not have this body.
    pub attached: [Option<usize>; ATTACHED_COUNT],
    /// Degree of freedom relative to which each of the first attached bodies of the scene turns; for a body that it does
    /// not have, the index that this body would have. It is stored because each stage of a step reads it.
    pub first_bases: [usize; FEW],
    /// Degree of freedom on which the drive acts: the carrier, or an attached body in front of it.
    pub port: usize,
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
    /// Index of the body with which the pinion turns: its own, or the carrier if both are rigid with each other.
    #[inline]
    pub fn pinion(&self) -> usize {
        if self.attached[PINION].is_some() { self.body(PINION) } else { CARRIER }
    }
    /// Index of attached body `k`.
    #[inline]
    pub fn body(&self, k: usize) -> usize {
        let before = self.attached[..k].iter().map(|to| usize::from(to.is_some())).sum::<usize>();
        self.planet(self.groups * if self.has_pins { 2 } else { 1 } + before)
    }
    /// Indices of the attached bodies and of the bodies relative to which they turn.
    pub fn attached(&self) -> impl Iterator<Item = (usize, usize)> {
        (0..ATTACHED_COUNT).filter_map(|k| Some((self.body(k), self.attached[k]?)))
    }
    /// True if any body is attached.
    #[inline]
    pub fn is_attached(&self) -> bool {
        self.attached.iter().any(Option::is_some)
    }
    /// True if the ends of both half-shafts are degrees of freedom; otherwise, neither end is.
    #[inline]
    pub fn has_ends(&self) -> bool {
        self.attached[0].is_some()
    }
    /// Number of attached bodies, or `None` if pins and seats move.
    pub fn attached_without_pins(&self) -> Option<usize> {
        (!self.has_pins).then(|| self.attached().count())
    }
    /// Angle of the carrier or of a body `i` in front of it, as a sum: degrees of freedom and their factors.
    pub fn angle(&self, i: usize) -> impl Iterator<Item = (usize, f64)> {
        let base = |&i: &usize| self.attached().find(|&(body, _)| body == i).map(|(_, to)| to);
        std::iter::successors(Some(i), base).map(move |i| (i, if base(&i).is_some() { -1.0 } else { 1.0 }))
    }
    /// Number of bodies that degree of freedom `i` represents. The planets of a group move identically.
    pub fn bodies(&self, i: usize) -> f64 {
        let of_planet = i.checked_sub(self.planet(0)).filter(|&k| k < self.groups * if self.has_pins { 2 } else { 1 });
        of_planet.map_or(1.0, |k| self.members[k % self.groups])
    }
    /// Number of degrees of freedom.
    #[inline]
    pub fn count(&self) -> usize {
        self.body(ATTACHED_COUNT)
    }
}

/// Sum over the planet groups, added in pairs. Groups next to each other are opposite planets, which may move
/// identically.
#[inline]
pub fn over_groups(groups: usize, term: impl Fn(usize) -> f64) -> f64 {
    match groups {
        1 => term(0),
        2 => term(0) + term(1),
        3 => (term(0) + term(1)) + term(2),
        _ => (term(0) + term(1)) + (term(2) + term(3)),
    }
}
