//! Shapes of the equations with teeth: which degrees of freedom there are, and the index of each.
//!
//! A shape whose sizes are known at compile time lets loops unroll and needs no tests; the layout of a scene gives the sizes of any
//! other. The steps of frequent scenes are compiled for shapes of their own.

use std::ops::{Index, IndexMut};

use crate::model::scene::{ENDS, Layout, MAX_DOF, MAX_GROUPS, PLANET};

/// Degrees of freedom of plain teeth with planets that are alike.
pub const LEAST: usize = 4;
/// Degrees of freedom of plain teeth with two planets that differ.
pub const DIFFERENT: usize = 5;
/// Degrees of freedom with planets that are alike and half-shafts that twist.
pub const WITH_ENDS: usize = 6;
/// Degrees of freedom up to which teeth of other shapes need only small matrices, a whole number of vectors of any width.
pub const MEDIUM: usize = 8;
/// Degrees of freedom that every scene fits in, a whole number of vectors of any width.
pub const LARGEST: usize = 16;

// another attached body may need a larger number, which no scene would report
const _: () = assert!(MAX_DOF <= LARGEST);

/// A value of each group of planets.
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

/// A shape with at most `N` degrees of freedom.
pub trait Shape<const N: usize>: Copy {
    /// Values of the groups of planets.
    type ByGroup<T: Copy>: ByGroup<T>;
    /// True if effects may act.
    const MAY_ACT: bool;
    /// True if inputs may change while they act.
    const MAY_CHANGE: bool;
    /// True if the steps are compiled for this shape, with the meshes as a part of them.
    const HAS_OWN_STEPS: bool;
    /// True if steps of fixed size are compiled.
    const HAS_FIXED_STEPS: bool;
    /// True if the method `radau` is compiled.
    const HAS_RADAU: bool;

    /// Degrees of freedom.
    fn count(layout: &Layout) -> usize;
    /// Groups of planets.
    fn groups(layout: &Layout) -> usize;
    /// Index of the planets of group `g`.
    fn planet(layout: &Layout, g: usize) -> usize;
    /// True if pins and axial seats move.
    fn has_pins(layout: &Layout) -> bool;
    /// True if half-shafts have ends.
    fn has_ends(layout: &Layout) -> bool;
    /// Index of the end of the half-shaft of side `s`.
    fn end(layout: &Layout, s: usize) -> usize;
    /// True if a body is attached.
    fn is_attached(layout: &Layout) -> bool;
    /// Sets the rates of the twists of attached bodies from the velocities `v`.
    fn set_twist_rates(layout: &Layout, v: &[f64; N], rates: &mut [f64; N]);
    /// Turns the derivatives by these rates, in a row, into those by velocities.
    fn turn_twist_rates(layout: &Layout, row: &mut [f64; N]);
}

/// Planets in `G` groups, with ends of half-shafts or without; effects act if `ACT`, and inputs change while they act if `CHANGE`. Nothing
/// else moves.
#[derive(Clone, Copy)]
pub struct Compact<const G: usize, const HAS_ENDS: bool, const ACT: bool, const CHANGE: bool>;

/// Any teeth.
#[derive(Clone, Copy)]
pub struct Any;

/// Plain teeth with planets in `G` groups, on which no effect acts.
pub type Plain<const G: usize> = Compact<G, false, false, false>;
/// The same with planets that are alike, under inputs that change.
pub type PlainDriven = Compact<1, false, false, true>;
/// Teeth with effects and planets in `G` groups.
pub type WithEffects<const G: usize> = Compact<G, false, true, true>;
/// Teeth with effects, planets that are alike, and half-shafts that twist.
pub type WithEnds = Compact<1, true, true, true>;

impl<const N: usize, const G: usize, const HAS_ENDS: bool, const ACT: bool, const CHANGE: bool> Shape<N>
    for Compact<G, HAS_ENDS, ACT, CHANGE>
{
    type ByGroup<T: Copy> = [T; G];
    const MAY_ACT: bool = ACT;
    const MAY_CHANGE: bool = CHANGE;
    const HAS_OWN_STEPS: bool = true;
    const HAS_FIXED_STEPS: bool = ACT && G == 1 && !HAS_ENDS || ACT && !crate::FULL;
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
    fn has_ends(_: &Layout) -> bool {
        HAS_ENDS
    }
    #[inline(always)]
    fn end(_: &Layout, s: usize) -> usize {
        PLANET + G + s
    }
    #[inline(always)]
    fn is_attached(_: &Layout) -> bool {
        HAS_ENDS
    }
    #[inline(always)]
    fn set_twist_rates(_: &Layout, v: &[f64; N], rates: &mut [f64; N]) {
        set_twist_rates((0..if HAS_ENDS { ENDS } else { 0 }).map(|s| (PLANET + G + s, s)), v, rates);
    }
    #[inline(always)]
    fn turn_twist_rates(_: &Layout, row: &mut [f64; N]) {
        turn_twist_rates((0..if HAS_ENDS { ENDS } else { 0 }).map(|s| (PLANET + G + s, s)), row);
    }
}

impl<const N: usize> Shape<N> for Any {
    type ByGroup<T: Copy> = [T; MAX_GROUPS];
    const MAY_ACT: bool = true;
    const MAY_CHANGE: bool = true;
    const HAS_OWN_STEPS: bool = false;
    const HAS_FIXED_STEPS: bool = true;
    const HAS_RADAU: bool = crate::FULL;

    #[inline]
    fn count(layout: &Layout) -> usize {
        layout.count().min(N)
    }
    #[inline]
    fn groups(layout: &Layout) -> usize {
        layout.groups.min(MAX_GROUPS)
    }
    #[inline]
    fn planet(layout: &Layout, g: usize) -> usize {
        layout.planet(g)
    }
    #[inline]
    fn has_pins(layout: &Layout) -> bool {
        layout.has_pins
    }
    #[inline]
    fn has_ends(layout: &Layout) -> bool {
        layout.has_ends()
    }
    #[inline]
    fn end(layout: &Layout, s: usize) -> usize {
        layout.end(s)
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

/// Sets the rates of the twists of `attached` bodies, each with the one it turns against, from the velocities `v`.
#[inline(always)]
fn set_twist_rates(attached: impl Iterator<Item = (usize, usize)>, v: &[f64], rates: &mut [f64]) {
    for (i, to) in attached {
        rates[i] = v[to] - v[i];
    }
}

/// Turns derivatives by these rates into those by velocities, in a row.
#[inline(always)]
fn turn_twist_rates(attached: impl Iterator<Item = (usize, usize)>, row: &mut [f64]) {
    for (i, to) in attached {
        row[to] += row[i];
        row[i] = -row[i];
    }
}

/// For any number of attached bodies, compiled once.
impl Layout {
    /// Sets the rates of all twists from the velocities `v`.
    #[inline(never)]
    pub fn set_twist_rates(&self, v: &[f64], rates: &mut [f64]) {
        set_twist_rates(self.attached(), v, rates);
    }

    /// Turns the derivatives by these rates, in a row, into those by velocities.
    #[inline(never)]
    pub fn turn_twist_rates(&self, row: &mut [f64]) {
        turn_twist_rates(self.attached(), row);
    }
}
