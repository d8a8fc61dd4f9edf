//! Pairs of bodies that rub on each other: side gears on the carrier, planets on their pins, wheels in their brakes, the pinion
//! in its bearings, side gears on shafts that the carrier drives through a gearing.
//!
//! The slip of a pair is a sum of positions. Its rate is the speed of the body minus the speed of its base times a
//! ratio σ. Friction with the torque T pushes the body back with T and the base forward with σ T; the housing of the
//! gearing supports the rest. A new kind of pair is a line in each function of [`RubbingKind`], and its
//! bodies in [`Plan::rubbing`].

use std::ops::Range;

use super::{CARRIER, MAX_GROUPS, Plan};
use crate::declaration::SIDES;

/// Kind of pairs that rub on each other.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RubbingKind {
    /// Side gear on the carrier.
    Side,
    /// Planet on its pin and seat.
    Planet,
    /// Wheel in its brake.
    Wheel,
    /// Pinion of the final drive in its bearings, at the carrier's speed.
    Pinion,
    /// Side gear on a shaft at a multiple of the carrier's speed, by a clutch.
    Clutch,
}

/// Largest number of pairs.
pub const PAIRS: usize = RubbingKind::ALL[RubbingKind::ALL.len() - 1].numbers().end;

/// Number of the pair of the pinion.
pub const PINION_PAIR: usize = RubbingKind::Pinion.number(0);

impl RubbingKind {
    /// All kinds, in the order of their numbers.
    pub const ALL: [Self; 5] = [Self::Side, Self::Planet, Self::Wheel, Self::Pinion, Self::Clutch];

    /// Largest number of pairs of this kind.
    const fn count(self) -> usize {
        match self {
            Self::Side | Self::Wheel | Self::Clutch => 2,
            Self::Planet => MAX_GROUPS,
            Self::Pinion => 1,
        }
    }

    /// True if all pairs of this kind have the same friction. Otherwise, each pair has its own command and damping.
    pub const fn is_alike(self) -> bool {
        match self {
            Self::Side | Self::Planet | Self::Pinion => true,
            Self::Wheel | Self::Clutch => false,
        }
    }

    /// True if inputs command the limit torques.
    pub const fn is_commanded(self) -> bool {
        matches!(self, Self::Wheel | Self::Clutch)
    }

    /// Numbers of the pairs of this kind.
    pub const fn numbers(self) -> Range<usize> {
        let (mut start, mut k) = (0, 0);
        while k < self as usize {
            start += Self::ALL[k].count();
            k += 1;
        }
        start..start + self.count()
    }

    /// Number of pair `k` of this kind: a side, or a group of planets.
    pub const fn number(self, k: usize) -> usize {
        self.numbers().start + k
    }

    /// Kind of the pair with this number, and the side or the group of planets to which it belongs.
    pub const fn of(number: usize) -> (Self, usize) {
        let mut k = 0;
        while number >= Self::ALL[k].numbers().end {
            k += 1;
        }
        (Self::ALL[k], number - Self::ALL[k].numbers().start)
    }
}

/// A body that rubs on its base.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RubbingPair {
    /// Number of the pair.
    pub number: usize,
    /// Degree of freedom of the body.
    pub body: usize,
    /// Degree of freedom of the base. `None` for the housing; also for planets, whose speed is relative to the carrier.
    pub base: Option<usize>,
    /// Ratio σ of the speed of the surface on which the body rubs to the speed of the base.
    pub ratio: f64,
    /// Number of identical pairs.
    pub count: f64,
    position: [(usize, f64); 3],
    terms: usize,
}

impl RubbingPair {
    /// Pair of a body with its base. Degrees of freedom whose positions, times a factor, add up to the slip are in
    /// `position`, at most three. There are `count` identical pairs.
    pub fn new(number: usize, (body, base): (usize, Option<usize>), position: &[(usize, f64)], count: f64) -> Self {
        let terms = std::array::from_fn(|k| position.get(k).copied().unwrap_or((body, 0.0)));
        Self { number, body, base, ratio: 1.0, count, position: terms, terms: position.len() }
    }

    /// Degrees of freedom whose positions, times a factor, add up to the slip.
    #[inline]
    pub fn position(&self) -> &[(usize, f64)] {
        &self.position[..self.terms]
    }
}

impl Plan {
    /// Pairs that may rub on each other, by their numbers. Without teeth, planets have no pairs of their own, because
    /// they stick together with the side gears.
    pub fn rubbing(&self, has_teeth: bool) -> [Option<RubbingPair>; PAIRS] {
        let (layout, mut pairs) = (self.layout(), [None; PAIRS]);
        let mut add = |pair: RubbingPair| pairs[pair.number] = Some(pair);
        for s in 0..2 {
            add(RubbingPair::new(RubbingKind::Side.number(s), (s, Some(CARRIER)), &[(s, 1.0)], 1.0));
            // angle of the wheel = angle of the carrier + relative angle of the side gear − twist
            let (end, angle) = (layout.end(s), [(CARRIER, 1.0), (s, 1.0), (layout.end(s), -1.0)]);
            let (body, angle) = if self.shafts[s] { (end, &angle[..]) } else { (s, &angle[..2]) };
            add(RubbingPair::new(RubbingKind::Wheel.number(s), (body, None), angle, 1.0));
        }
        for (s, ratio) in self.clutch_ratio.into_iter().enumerate() {
            let Some(ratio) = ratio else { continue };
            // angle of the side gear = angle of the carrier + relative angle of the side gear
            let angle = [(s, 1.0), (CARRIER, 1.0 - ratio)];
            let pair = RubbingPair::new(RubbingKind::Clutch.number(s), (s, Some(CARRIER)), &angle, 1.0);
            add(RubbingPair { ratio, ..pair });
        }
        let pinion = layout.pinion();
        let angle: Vec<(usize, f64)> = layout.angle(pinion).collect();
        add(RubbingPair::new(PINION_PAIR, (pinion, None), &angle, 1.0));
        for g in (0..layout.groups).filter(|_| has_teeth) {
            let (number, planet) = (RubbingKind::Planet.number(g), layout.planet(g));
            add(RubbingPair::new(number, (planet, None), &[(planet, 1.0)], self.group(g).members));
        }
        pairs
    }

    /// Name of the body of the pair with this `number` in messages.
    pub fn rubbing_body(&self, number: usize) -> String {
        match RubbingKind::of(number) {
            (RubbingKind::Side, s) => format!("the {} side gear", SIDES[s]),
            (RubbingKind::Planet, g) => format!("planet[{}]", self.group(g).planet + 1),
            (RubbingKind::Pinion, _) => "the pinion".into(),
            (RubbingKind::Wheel, s) => format!("the {} wheel", SIDES[s]),
            (RubbingKind::Clutch, s) => format!("the {} clutch", SIDES[s]),
        }
    }
}
