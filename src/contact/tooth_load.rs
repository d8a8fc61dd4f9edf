//! Load of a single tooth pair at an instant: what outputs, strength and load histories are made of.

use super::{Flank, Spot};
use crate::geometry::Pair;
use crate::geometry::action::{Contact, LineOfAction};

/// Load of one tooth pair, or of one slice of it where loads differ over the face.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ToothLoad {
    /// Planet that stands for its group, from 0.
    pub planet: usize,
    /// Side, 0 left and 1 right.
    pub side: usize,
    /// Flank.
    pub flank: Flank,
    /// Kind of contact.
    pub spot: Spot,
    /// Arc Δ past the end of the path [rad]; the place on the path if on it.
    pub place: f64,
    /// Numbers of the planet's and the side gear's tooth, from 0.
    pub teeth: [usize; 2],
    /// Place on the path of contact [rad].
    pub s: f64,
    /// Cone distance at which the force acts [m].
    pub cone: f64,
    /// Share of the face that it stands for.
    pub share: f64,
    /// Normal force per width [N/m].
    pub line_load: f64,
    /// Penetration along the line of action [m].
    pub depth: f64,
    /// Normal force [N].
    pub normal: f64,
    /// Friction along the flank, positive toward the planet's root on the planet [N].
    pub friction: f64,
    /// Parts of the normal: along the planet's axis and the side gear's, away from the apex, and along the rotation.
    pub parts: [f64; 3],
    /// Where solid teeth touch, which `spot` and `place` tell of aligned ones alone.
    pub touch: Option<Touch>,
}

/// Where solid teeth touch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Touch {
    /// Direction from the side gear's apex in parts along the axes of planet and side gear, apex to heel, and along the
    /// rotation.
    pub point: [f64; 3],
    /// Polar angles on planet and side gear, each about its own axis as it stands [rad].
    pub polar: [f64; 2],
}

impl ToothLoad {
    /// Which of the mirror images of the line of action it is on: +1 where the contact moves up the path when the planet
    /// turns forward about its axis from apex to heel.
    pub fn turn(&self) -> f64 {
        if (self.side == 0) == (self.flank == Flank::Coast) { 1.0 } else { -1.0 }
    }

    /// Where it acts, in the frame of the mesh.
    pub fn contact(&self, action: &LineOfAction) -> Contact {
        action.contact(self.spot, self.place, self.turn())
    }

    /// Azimuth of the middle of its tooth of gear `i` (0 planet, 1 side gear) from that of tooth 0, about the gear's axis
    /// from apex to heel [rad].
    pub fn tooth_azimuth(&self, pair: &Pair, i: usize) -> f64 {
        // planet teeth count about the axis to the apex, side gear teeth about +x, which leads away from it on the left
        let sign = if i == 1 && self.side == 0 { 1.0 } else { -1.0 };
        sign * self.teeth[i] as f64 * pair.gears[i].tooth_pitch()
    }
}
