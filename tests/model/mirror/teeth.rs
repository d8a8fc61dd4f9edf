//! Numbers of the teeth in the images of a differential.
//!
//! Planet teeth are counted with positive spin, side gear teeth forward. At the start, tooth 0 of a planet is in its
//! left mesh. It is half a pitch ahead if the meshes are shifted by half a pitch (`assembly::phases`).

use bevel_differential::contact::errors::GearTeeth;
use bevel_differential::geometry::GearSpec;

/// View of a differential.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum View {
    /// Reflection in the plane of the axes of carrier and planet 1.
    Reversed,
    /// Reflection in the plane across the carrier's axis; with an odd number of planet teeth, half a pitch later.
    Swapped,
    /// Rotation about the carrier's axis, so that each planet takes the place of the next one.
    Renumbered,
    /// Shift of tooth 0 of each gear by a pitch: planets and the left side gear are a pitch ahead, the right side gear
    /// is a pitch behind.
    Shifted,
}

/// Number of a gear: side gears 0 left and 1 right, then planets.
pub type Number = usize;

/// Numbers of the teeth of one gear in an image.
pub struct Renumbered {
    /// Number of the gear in the image.
    pub gear: Number,
    /// True if teeth are counted in the opposite direction.
    backward: bool,
    /// Number of tooth 0 in the image.
    first: i64,
}

impl Renumbered {
    /// Number of tooth `j` in the image, before the modulo operation with the number of teeth.
    pub fn tooth(&self, j: i64) -> i64 {
        if self.backward { self.first - j } else { self.first + j }
    }
}

/// Numbers of gear `gear` in the image `view` of the gears `spec`.
pub fn renumbered(view: View, spec: &GearSpec, gear: Number) -> Renumbered {
    let [z_p, z_s, n] = [spec.planet_teeth, spec.side_teeth, spec.planet_count].map(i64::from);
    let planet = gear as i64 - 2;
    // 1 if the planet's meshes are shifted by half a pitch
    let shifted = if planet > 0 { 2 * z_s * planet / n % 2 } else { 0 };
    match (view, gear) {
        (View::Reversed, 0) => Renumbered { gear, backward: true, first: -1 },
        (View::Reversed, 1) => Renumbered { gear, backward: true, first: -1 - z_p % 2 },
        (View::Reversed, _) => Renumbered { gear: 2 + ((n - planet) % n) as usize, backward: true, first: -shifted },
        (View::Swapped, 0 | 1) => Renumbered { gear: 1 - gear, backward: false, first: 0 },
        (View::Swapped, _) => Renumbered { gear, backward: true, first: z_p / 2 - shifted },
        (View::Renumbered, 0 | 1) => Renumbered { gear, backward: false, first: z_s / n },
        (View::Renumbered, _) => Renumbered { gear: 2 + ((planet + 1) % n) as usize, backward: false, first: 0 },
        (View::Shifted, 1) => Renumbered { gear, backward: false, first: 1 },
        (View::Shifted, _) => Renumbered { gear, backward: false, first: -1 },
    }
}

/// Teeth of all gears in the image `view`.
pub fn image(view: View, spec: &GearSpec, gears: &[GearTeeth]) -> Vec<GearTeeth> {
    let mut images = vec![GearTeeth::default(); gears.len()];
    for (number, teeth) in gears.iter().enumerate() {
        let to = renumbered(view, spec, number);
        let count = i64::from(if number < 2 { spec.side_teeth } else { spec.planet_teeth });
        let pitch = std::f64::consts::TAU / count as f64;
        let image = &mut images[to.gear];
        image.positions = teeth.positions.clone();
        for flank in 0..2 {
            for (j, position) in teeth.positions[flank].iter().enumerate() {
                let tooth = to.tooth(j as i64).rem_euclid(count) as usize;
                // flanks change sides and position errors change signs if teeth are counted in the opposite direction
                let (flank, position) = if to.backward { (1 - flank, -position) } else { (flank, *position) };
                image.positions[flank][tooth] = position;
            }
        }
        image.azimuth = if to.backward { -teeth.azimuth } else { teeth.azimuth } + to.first as f64 * pitch;
    }
    images
}
