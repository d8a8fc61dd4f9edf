//! Twists of attached bodies: the rates of these positions are differences of two velocities.

use crate::model::scene::Layout;

/// Sets the rates of the twists of `attached` bodies, each with the one it turns against, from the velocities `v`.
#[inline(always)]
pub fn set(attached: impl Iterator<Item = (usize, usize)>, v: &[f64], rates: &mut [f64]) {
    for (i, to) in attached {
        rates[i] = v[to] - v[i];
    }
}

/// Turns derivatives by these rates into those by velocities, in a row.
#[inline(always)]
pub fn turn(attached: impl Iterator<Item = (usize, usize)>, row: &mut [f64]) {
    for (i, to) in attached {
        row[to] += row[i];
        row[i] = -row[i];
    }
}

/// For any number of them, compiled once.
impl Layout {
    /// [`set`] for all there are.
    #[inline(never)]
    pub fn set_twist_rates(&self, v: &[f64], rates: &mut [f64]) {
        set(self.attached(), v, rates);
    }

    /// [`turn`] for all there are.
    #[inline(never)]
    pub fn turn_twist_rates(&self, row: &mut [f64]) {
        turn(self.attached(), row);
    }
}
