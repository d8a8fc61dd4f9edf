//! Load of a single tooth pair at an instant, used by outputs, strength and load histories.

use super::{Flank, Spot};
use crate::geometry::Pair;
use crate::geometry::action::{Contact, LineOfAction};

/// Load of one tooth pair, or of one slice of it if loads differ over the face.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ToothLoad {
    /// Planet that represents its group, from 0.
    pub planet: usize,
    /// Side, 0 left and 1 right.
    pub side: usize,
    /// Flank.
    pub flank: Flank,
    /// Kind of contact.
    pub spot: Spot,
    /// Arc Δ past the end of the path, or the position on the path if the pair is on it [rad].
    pub spot_arc: f64,
    /// Numbers of the planet's and the side gear's tooth, from 0.
    pub teeth: [usize; 2],
    /// Position on the path of contact [rad].
    pub s: f64,
    /// Cone distance at which the force acts [m].
    pub cone: f64,
    /// Share of the face that this load represents.
    pub share: f64,
    /// Normal force per width [N/m].
    pub line_load: f64,
    /// Penetration along the line of action [m].
    pub depth: f64,
    /// Normal force [N].
    pub normal: f64,
    /// Friction along the flank, positive toward the planet's root on the planet [N].
    pub friction: f64,
    /// Components of the unit normal: along the planet's axis and the side gear's axis, both away from the apex, and
    /// along the rotation.
    pub components: [f64; 3],
    /// Point of contact of solid teeth. `spot` and `spot_arc` describe only aligned teeth.
    pub touch: Option<Touch>,
}

/// Point of contact of solid teeth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Touch {
    /// Direction from the side gear's apex: components along the axes of planet and side gear, from apex to heel, and
    /// along the rotation.
    pub point: [f64; 3],
    /// Polar angles on planet and side gear, each about the gear's own displaced axis [rad].
    pub polar: [f64; 2],
}

impl ToothLoad {
    /// Sign of the mirror image of the line of action: +1 if the contact moves up the path when the planet turns
    /// forward about its axis from apex to heel, else −1.
    pub fn turn(&self) -> f64 {
        if (self.side == 0) == (self.flank == Flank::Coast) { 1.0 } else { -1.0 }
    }

    /// Point of contact in the frame of the mesh.
    pub fn contact(&self, action: &LineOfAction) -> Contact {
        action.contact(self.spot, self.spot_arc, self.turn())
    }

    /// Azimuth of the middle of the loaded tooth of gear `i` (0 planet, 1 side gear), measured from tooth 0 about the
    /// gear's axis from apex to heel [rad].
    pub fn tooth_azimuth(&self, pair: &Pair, i: usize) -> f64 {
        // planet teeth count about the axis toward the apex, side gear teeth about +x, which points away from the apex
        // on the left
        let sign = if i == 1 && self.side == 0 { 1.0 } else { -1.0 };
        sign * self.teeth[i] as f64 * pair.gears[i].tooth_pitch()
    }
}
