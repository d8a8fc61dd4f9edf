//! Load of a tooth pair over its whole face, from which its strength is rated.

use super::{Flank, ToothLoad};

/// Load of one tooth pair, summed over all slices of its face.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PairLoad {
    /// Flank.
    pub flank: Flank,
    /// Numbers of the planet's and the side gear's tooth, from 0.
    pub teeth: [usize; 2],
    /// Position on the path of contact [rad].
    pub s: f64,
    /// Sum of the slices' normal forces times their cone distances [N·m].
    pub moment: f64,
    /// Cone distance at which the resultant of an even load acts [m].
    pub cone: f64,
    /// Largest load per width and cone distance w/R [N/m²]. The square of the contact pressure is proportional to it.
    pub steepest: f64,
    /// Face load factor K_Hβ: ratio of the largest load on the face to the mean load.
    pub face_factor: f64,
}

impl PairLoad {
    /// Starts a pair with its slice `first`. The law's resultant under an even load is at `cone` [m].
    pub fn new(first: &ToothLoad, cone: f64, face_factor: f64) -> Self {
        let ToothLoad { flank, teeth, s, .. } = *first;
        let mut pair = Self { flank, teeth, s, moment: 0.0, cone, steepest: 0.0, face_factor };
        pair.add(first);
        pair
    }

    /// Adds another slice of the pair.
    pub fn add(&mut self, slice: &ToothLoad) {
        self.moment += slice.normal * slice.cone;
        self.steepest = self.steepest.max(slice.line_load / slice.cone);
    }
}
