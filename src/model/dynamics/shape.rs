//! Shapes of the equations with teeth: their degrees of freedom, and the index of each.
//!
//! If the sizes of a shape are known at compile time, loops unroll and need no tests. Steps of frequent scenes are
//! monomorphised for such shapes. For all other scenes, the layout gives the sizes at run time.

use std::ops::{Index, IndexMut};

use crate::model::scene::{ATTACHED_COUNT, CARRIER, FEW, Layout, MAX_DOF, MAX_GROUPS, PLANET};

/// Number of degrees of freedom of plain teeth with identical planets.
pub const PLAIN_SIZE: usize = 4;
/// Number of degrees of freedom of plain teeth with two planets that differ.
pub const TWO_GROUPS_SIZE: usize = 5;
/// Number of degrees of freedom with identical planets and two attached bodies: the ends of both half-shafts, or the
/// pinion and its propeller shaft.
pub const FEW_SIZE: usize = 6;
/// Matrix size for identical planets with any attached bodies, and for other shapes with at most this number of degrees
/// of freedom. It is a multiple of any vector width.
pub const MEDIUM_SIZE: usize = 8;
/// Matrix size that fits every scene. It is a multiple of any vector width.
pub const MAX_SIZE: usize = 20;

// otherwise another attached body could exceed these numbers unnoticed
const _: () =
    assert!(MAX_DOF <= MAX_SIZE && PLANET + 1 + ATTACHED_COUNT <= MEDIUM_SIZE && PLANET + 1 + FEW == FEW_SIZE);

/// A value for each planet group.
pub trait ByGroup<T>: Copy + Index<usize, Output = T> + IndexMut<usize> {
    /// `value` for each group.
    fn filled(value: T) -> Self;
}

impl<T: Copy, const G: usize> ByGroup<T> for [T; G] {
    #[inline(always)]
    fn filled(value: T) -> Self {
        [value; G]
    }
}

/// Shape of equations with at most `N` degrees of freedom.
pub trait Shape<const N: usize>: Copy {
    /// Values of the planet groups.
    type ByGroup<T: Copy>: ByGroup<T>;
    /// True if effects may act.
    const MAY_ACT: bool;
    /// True if inputs may change with time.
    const MAY_CHANGE: bool;
    /// True if half-shafts may have ends.
    const MAY_HAVE_ENDS: bool;
    /// True if steps are monomorphised for this shape, with the meshes inlined.
    const HAS_OWN_STEPS: bool;
    /// True if steps of fixed size are compiled.
    const HAS_FIXED_STEPS: bool;
    /// True if the method `radau` is compiled.
    const HAS_RADAU: bool;

    /// Number of degrees of freedom.
    fn count(layout: &Layout) -> usize;
    /// Number of planet groups.
    fn groups(layout: &Layout) -> usize;
    /// Index of the planets of group `g`.
    fn planet(layout: &Layout, g: usize) -> usize;
    /// True if pins and axial seats move.
    fn has_pins(layout: &Layout) -> bool;
    /// Index of the end of the half-shaft of side `s`.
    fn end(layout: &Layout, s: usize) -> usize;
    /// Index of the body on which the drive acts.
    fn port(layout: &Layout) -> usize;
    /// True if a body is attached.
    fn is_attached(layout: &Layout) -> bool;
    /// Sets the twist rates of attached bodies from the velocities `v`.
    fn set_twist_rates(layout: &Layout, v: &[f64; N], rates: &mut [f64; N]);
    /// Converts derivatives with respect to twist rates, in a row, to derivatives with respect to velocities.
    fn turn_twist_rates(layout: &Layout, row: &mut [f64; N]);
}

/// Shape with planets in `G` groups, and with the bodies `ATTACHED`: [`NONE`], [`SHAFT_ENDS`] or [`IN_FRONT`]. Effects
/// may act if `ACT`, and inputs may change with time if `CHANGE`. There are no other degrees of freedom.
#[derive(Clone, Copy)]
pub struct Compact<const G: usize, const ATTACHED: u8, const ACT: bool, const CHANGE: bool>;

/// No attached bodies.
pub const NONE: u8 = 0;
/// The ends of both half-shafts.
pub const SHAFT_ENDS: u8 = 1;
/// One or two bodies in front of the carrier: pinion and propeller shaft. A second body that the scene does not have is
/// a row of zeros.
pub const IN_FRONT: u8 = 2;

/// Shape whose sizes are known at run time, with at most `G` planet groups. Pins and seats may move if `PINS`, and steps
/// are monomorphised for it if `OWN_STEPS`.
#[derive(Clone, Copy)]
pub struct Loose<const G: usize, const PINS: bool, const OWN_STEPS: bool>;

/// Shape of any teeth.
pub type Any = Loose<MAX_GROUPS, true, false>;

/// Plain teeth with planets in `G` groups, on which no effect acts.
pub type Plain<const G: usize> = Compact<G, NONE, false, false>;
/// Plain teeth with identical planets, under inputs that change with time.
pub type PlainDriven = Compact<1, NONE, false, true>;
/// Teeth with effects and planets in `G` groups.
pub type WithEffects<const G: usize> = Compact<G, NONE, true, true>;
/// Teeth with effects, identical planets, and half-shafts that twist.
pub type WithEnds = Compact<1, SHAFT_ENDS, true, true>;
/// Teeth with effects, identical planets, and a pinion or a propeller shaft that turns by itself.
pub type WithPinion = Compact<1, IN_FRONT, true, true>;
/// Teeth with effects, identical planets, and any attached bodies.
pub type WithBodies = Loose<1, false, true>;

impl<const N: usize, const G: usize, const ATTACHED: u8, const ACT: bool, const CHANGE: bool> Shape<N>
    for Compact<G, ATTACHED, ACT, CHANGE>
{
    type ByGroup<T: Copy> = [T; G];
    const MAY_ACT: bool = ACT;
    const MAY_CHANGE: bool = CHANGE;
    const MAY_HAVE_ENDS: bool = ATTACHED == SHAFT_ENDS;
    const HAS_OWN_STEPS: bool = true;
    const HAS_FIXED_STEPS: bool = ACT && G == 1 && ATTACHED == NONE || ACT && !crate::FULL;
    const HAS_RADAU: bool = false;

    #[inline(always)]
    fn count(_: &Layout) -> usize {
        N
    }
    #[inline(always)]
    fn groups(_: &Layout) -> usize {
        G
    }
    #[inline(always)]
    fn planet(_: &Layout, g: usize) -> usize {
        PLANET + g
    }
    #[inline(always)]
    fn has_pins(_: &Layout) -> bool {
        false
    }
    #[inline(always)]
    fn end(_: &Layout, s: usize) -> usize {
        PLANET + G + s
    }
    #[inline(always)]
    fn port(layout: &Layout) -> usize {
        if ATTACHED == IN_FRONT { layout.port } else { CARRIER }
    }
    #[inline(always)]
    fn is_attached(_: &Layout) -> bool {
        ATTACHED != NONE
    }
    #[inline(always)]
    fn set_twist_rates(layout: &Layout, v: &[f64; N], rates: &mut [f64; N]) {
        set_twist_rates(bodies::<G, ATTACHED>(layout), v, rates);
    }
    #[inline(always)]
    fn turn_twist_rates(layout: &Layout, row: &mut [f64; N]) {
        turn_twist_rates(bodies::<G, ATTACHED>(layout), row);
    }
}

impl<const N: usize, const G: usize, const PINS: bool, const OWN_STEPS: bool> Shape<N> for Loose<G, PINS, OWN_STEPS> {
    type ByGroup<T: Copy> = [T; G];
    const MAY_ACT: bool = true;
    const MAY_CHANGE: bool = true;
    const MAY_HAVE_ENDS: bool = true;
    const HAS_OWN_STEPS: bool = OWN_STEPS;
    const HAS_FIXED_STEPS: bool = !OWN_STEPS;
    const HAS_RADAU: bool = crate::FULL && !OWN_STEPS;

    #[inline]
    fn count(layout: &Layout) -> usize {
        layout.count().min(N)
    }
    #[inline]
    fn groups(layout: &Layout) -> usize {
        layout.groups.min(G)
    }
    #[inline]
    fn planet(layout: &Layout, g: usize) -> usize {
        if PINS { layout.planet(g) } else { PLANET + g }
    }
    #[inline]
    fn has_pins(layout: &Layout) -> bool {
        PINS && layout.has_pins
    }
    #[inline]
    fn end(layout: &Layout, s: usize) -> usize {
        layout.end(s)
    }
    #[inline]
    fn port(layout: &Layout) -> usize {
        layout.port
    }
    #[inline]
    fn is_attached(layout: &Layout) -> bool {
        layout.is_attached()
    }
    #[inline]
    fn set_twist_rates(layout: &Layout, v: &[f64; N], rates: &mut [f64; N]) {
        if layout.is_attached() {
            layout.set_twist_rates(v, rates);
        }
    }
    #[inline]
    fn turn_twist_rates(layout: &Layout, row: &mut [f64; N]) {
        layout.turn_twist_rates(row);
    }
}

/// Indices of the attached bodies of a [`Compact`] shape, and of the bodies relative to which they turn.
#[inline(always)]
fn bodies<const G: usize, const ATTACHED: u8>(layout: &Layout) -> impl Iterator<Item = (usize, usize)> {
    let base = |k: usize| if ATTACHED == SHAFT_ENDS { k } else { layout.first_bases[k] };
    (0..if ATTACHED == NONE { 0 } else { FEW }).map(move |k| (PLANET + G + k, base(k)))
}

/// Sets the twist rates of `attached` bodies from the velocities `v`. Each body comes with the body against which it
/// turns.
#[inline(always)]
pub fn set_twist_rates(attached: impl Iterator<Item = (usize, usize)>, v: &[f64], rates: &mut [f64]) {
    for (i, to) in attached {
        rates[i] = v[to] - v[i];
    }
}

/// Converts derivatives with respect to the twist rates of `attached` bodies, in a row, to derivatives with respect to
/// velocities.
#[inline(always)]
pub fn turn_twist_rates(attached: impl Iterator<Item = (usize, usize)>, row: &mut [f64]) {
    for (i, to) in attached {
        row[to] += row[i];
        row[i] = -row[i];
    }
}

/// Twist rates of any number of attached bodies, compiled once.
impl Layout {
    /// Sets all twist rates from the velocities `v`.
    #[inline(never)]
    pub fn set_twist_rates(&self, v: &[f64], rates: &mut [f64]) {
        set_twist_rates(self.attached(), v, rates);
    }

    /// Converts derivatives with respect to twist rates, in a row, to derivatives with respect to velocities.
    #[inline(never)]
    pub fn turn_twist_rates(&self, row: &mut [f64]) {
        turn_twist_rates(self.attached(), row);
    }
}
