//! Load of a tooth pair over its whole face: what its strength is rated by.

use super::{Flank, ToothLoad};

/// Load of one tooth pair, all slices of its face together.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PairLoad {
    /// Flank.
    pub flank: Flank,
    /// Place on the path of contact [rad].
    pub s: f64,
    /// Sum of the slices' normal forces times their cone distances [N·m].
    pub moment: f64,
    /// Cone distance at which the resultant of an even load acts [m].
    pub cone: f64,
    /// Largest load per width over cone distance w/R [N/m²], to which the pressure's square is proportional.
    pub steepest: f64,
    /// Face load factor K_Hβ: the largest load on the face over its mean.
    pub face_factor: f64,
}

impl PairLoad {
    /// A pair of which `first` is the first slice, under a law whose even load has its resultant at `cone` [m].
    pub fn new(first: &ToothLoad, cone: f64, face_factor: f64) -> Self {
        let mut pair = Self { flank: first.flank, s: first.s, moment: 0.0, cone, steepest: 0.0, face_factor };
        pair.add(first);
        pair
    }

    /// Adds another slice of the pair.
    pub fn add(&mut self, slice: &ToothLoad) {
        self.moment += slice.normal * slice.cone;
        self.steepest = self.steepest.max(slice.line_load / slice.cone);
    }
}
