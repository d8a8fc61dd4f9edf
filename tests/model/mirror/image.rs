//! Images of a scene by the table of symmetries: parameters, inputs, start, and the mapping of its outputs.

use std::f64::consts::{PI, TAU};

use bevel_differential::contact::errors::FaultyGear;
use bevel_differential::model::{DogSides, FinalDriveSpec, GearContact, Hand, Inputs, Layout, RingSide, State};
use bevel_differential::variables::{Access, Variable, named, table};

use super::scene::{Scene, output, outputs};
use super::table::{Parity, line_of, lines};
use super::teeth::{self, View};

/// Index of the first planet among the pairs that rub; side gears come first.
const PLANETS: usize = 2;
/// Index of the first wheel among the pairs that rub.
const WHEELS: usize = 6;
/// Index of the first clutch on command among the pairs that rub; the pinion comes before it.
const CLUTCHES: usize = 9;

/// Output in an image: `factor` times the value in the scene plus `added`.
#[derive(Clone, Copy)]
pub struct Mapped {
    pub output: usize,
    pub factor: f64,
    pub added: f64,
    /// True if only the magnitude of the output is known.
    pub magnitude: bool,
}

impl Scene {
    /// Image `view` of the scene, by the table of symmetries.
    pub fn image(&self, view: View) -> Self {
        let mut image = self.clone();
        image.inputs = self.image_of_inputs(view, &self.inputs);
        for step in &mut image.steps {
            step.inputs = self.image_of_inputs(view, &step.inputs);
            if let Some(derivatives) = &mut step.derivatives {
                derivatives.rates = derivatives.rates.map(|rate| self.image_of_inputs(view, &rate));
            }
        }
        let (mut from, to) = (self.parameters, &mut image.parameters);
        for row in table().rows.iter().filter(|row| !matches!(row.access, Access::Output(_))) {
            let there = variable(&self.name(view, row.name));
            let sign = self.sign(view, row.name);
            match (row.access, there.access) {
                (Access::Real(here), Access::Real(there)) => *there(to) = sign * *here(&mut from),
                (Access::Integer(here), Access::Integer(there)) => *there(to) = *here(&mut from),
                (Access::Boolean(here), Access::Boolean(there)) => *there(to) = *here(&mut from),
                (Access::Enumeration(_, get, _), Access::Enumeration(_, _, set)) => set(to, get(&from)),
                _ => {}
            }
        }
        if view == View::Reversed {
            // drive and coast ramps change places
            let clutch = &mut to.specs.limited_slip;
            clutch.torque_coefficient *= clutch.coast_ratio;
            clutch.coast_ratio = clutch.coast_ratio.recip();
        }
        if view == View::Swapped {
            let sides = &mut to.specs.disconnect.sides;
            *sides = match *sides {
                DogSides::Left => DogSides::Right,
                DogSides::Right => DogSides::Left,
                DogSides::Both => DogSides::Both,
            };
        }
        if matches!(view, View::Reversed | View::Swapped) {
            reflect_final_drive(&mut to.specs.final_drive, view == View::Reversed);
        }
        let spec = &self.parameters.geometry;
        let fault = &mut image.parameters.specs.tooth_fault;
        let (first, teeth) = match fault.gear {
            FaultyGear::Planet => (2, spec.planet_teeth),
            _ => (0, spec.side_teeth),
        };
        let broken = teeth::renumbered(view, spec, first + fault.index as usize);
        fault.index = (broken.gear - first) as i32;
        fault.tooth = broken.tooth(i64::from(fault.tooth)).rem_euclid(i64::from(teeth)) as i32;
        image.teeth = self.teeth.as_ref().map(|teeth| teeth::image(view, spec, teeth));
        image
    }

    /// Angles added to the mirrored angles of the planets and the left and right side gear [rad]. They are half a tooth
    /// pitch if sides are swapped and planet teeth are odd, a whole pitch if the image is shifted, otherwise zero. The
    /// angle of the right side gear is negative.
    pub fn added_angles(&self, view: View) -> [f64; 3] {
        let pitches = match view {
            View::Swapped if self.parameters.geometry.planet_teeth % 2 == 1 => 0.5,
            View::Shifted => 1.0,
            _ => 0.0,
        };
        let [planet, side] = self.pair().gears.map(|gear| pitches * gear.tooth_pitch());
        [planet, side, -side]
    }

    /// Start state of the image, made from the scene's `start`. `None` if the usual start of a simulation already gives
    /// this state.
    pub fn image_of_start(&self, view: View, start: &State, layout: &Layout) -> Option<State> {
        let added_angles = self.added_angles(view);
        // of two equilibria with equal energy, a start selects one by the sign of its spin angle; in a swapped image,
        // the mirrored state is the other one
        if added_angles == [0.0; 3] && view != View::Swapped {
            return None;
        }
        let mut image = *start;
        if view == View::Shifted {
            // whole pitches are stored in counters
            for (i, pitches) in [(0, 1), (1, -1)].into_iter().chain((0..layout.groups).map(|g| (layout.planet(g), 1))) {
                image.whole_periods[i] += pitches;
            }
            return Some(image);
        }
        image.q.swap(0, 1);
        image.v.swap(0, 1);
        let [seats, ends] = [[layout.seat(0), layout.seat(1)], [layout.end(0), layout.end(1)]];
        for ([left, right], _) in
            [(seats, layout.has_pins), (ends, layout.has_ends())].into_iter().filter(|(_, are)| *are)
        {
            image.q.swap(left, right);
            image.v.swap(left, right);
        }
        if let Some(actuated) = &mut image.inputs.actuated {
            actuated.states.swap(0, 1);
        }
        image.dogs.closed.swap(0, 1);
        image.dogs.commanded.swap(0, 1);
        image.friction.swap(0, 1);
        image.friction.swap(WHEELS, WHEELS + 1);
        image.friction.swap(CLUTCHES, CLUTCHES + 1);
        for g in 0..layout.groups {
            let (i, friction) = (layout.planet(g), &mut image.friction[PLANETS + g]);
            (image.q[i], image.v[i]) = (added_angles[0] - image.q[i], -image.v[i]);
            (friction.anchor, friction.mode) = (added_angles[0] - friction.anchor, friction.mode.reversed());
        }
        for s in 0..2 {
            image.q[s] += added_angles[1 + s];
            image.friction[s].anchor += added_angles[1 + s];
            image.friction[WHEELS + s].anchor += added_angles[1 + s];
            image.friction[CLUTCHES + s].anchor += added_angles[1 + s];
        }
        Some(image)
    }

    fn image_of_inputs(&self, view: View, inputs: &Inputs) -> Inputs {
        let (mut from, mut image) = (*inputs, Inputs::ZERO);
        for row in table().rows {
            let Access::Input(here) = row.access else { continue };
            if let Access::Input(there) = variable(&self.name(view, row.name)).access {
                *there(&mut image) = self.sign(view, row.name) * *here(&mut from);
            }
        }
        image
    }

    /// Parity of a variable in the reflection `view`; even in a rotation or a shift.
    fn parity(&self, view: View, name: &str) -> Parity {
        let line = &lines()[line_of(name).unwrap_or_else(|| panic!("{name} is in no table"))];
        match view {
            View::Reversed => line.parity[0],
            View::Swapped => line.parity[1],
            View::Renumbered | View::Shifted => Parity::Even,
        }
    }

    /// Factor of a variable in the image.
    fn sign(&self, view: View, name: &str) -> f64 {
        // to renumber two planets is to turn the carrier by half a turn, which reverses the offset of the axes
        if view == View::Renumbered && self.planets() == 2 && name == "tooth_errors.axis_offset" {
            return -1.0;
        }
        match self.parity(view, name) {
            Parity::Odd | Parity::Lash => -1.0,
            _ => 1.0,
        }
    }

    /// Name of a variable in the image.
    fn name(&self, view: View, name: &str) -> String {
        let n = self.planets();
        match (view, planet_of(name)) {
            (View::Swapped, _) => name.replace("left", "LEFT").replace("right", "left").replace("LEFT", "right"),
            (View::Reversed | View::Renumbered, Some(i)) if i <= n => {
                let to = teeth::renumbered(view, &self.parameters.geometry, 1 + i).gear - 1;
                name.replace(&format!("planet[{i}]"), &format!("planet[{to}]"))
            }
            _ => name.into(),
        }
    }

    /// Mapping of each output to the image.
    pub fn map(&self, view: View) -> Vec<Mapped> {
        let pair = self.pair();
        let (lash, [spin, left, right]) = (pair.normal_backlash * pair.mean_cone, self.added_angles(view));
        outputs()
            .iter()
            .map(|row| {
                // missing planets and ideal gears have no backlash
                let planet = planet_of(row.name).is_some_and(|i| i <= self.planets());
                let meshes = planet && self.parameters.scene.gear_contact != GearContact::Ideal;
                let lash_shift = if meshes && self.parity(view, row.name) == Parity::Lash { -lash } else { 0.0 };
                let image = self.name(view, row.name);
                let added = match image.as_str() {
                    "left.angle" | "left.wheel_angle" | "left.relative_angle" => left,
                    "right.angle" | "right.wheel_angle" | "right.relative_angle" => right,
                    name if name.ends_with(".spin_angle") && planet => spin,
                    _ => lash_shift,
                };
                let mapped =
                    Mapped { output: output(&image), factor: self.sign(view, row.name), added, magnitude: false };
                if view == View::Renumbered && row.name == "mesh.frequency" {
                    // the frequency follows from the spin of planet 1, which is planet 2 in the image
                    let factor = TAU / f64::from(self.parameters.geometry.planet_teeth);
                    return Mapped { output: output("planet[2].spin_speed"), factor, magnitude: true, ..mapped };
                }
                mapped
            })
            .collect()
    }
}

/// Reflects the final drive in the plane of axle and mesh if `reversed`, otherwise in the plane of the planets.
fn reflect_final_drive(drive: &mut FinalDriveSpec, reversed: bool) {
    drive.hand = if drive.hand == Hand::Right { Hand::Left } else { Hand::Right };
    if !reversed {
        drive.ring_side = if drive.ring_side == RingSide::Left { RingSide::Right } else { RingSide::Left };
        return;
    }
    std::mem::swap(&mut drive.drive_pressure_angle, &mut drive.coast_pressure_angle);
    std::mem::swap(&mut drive.drive_loss, &mut drive.coast_loss);
    // e(θ) becomes −e(−θ), and −cos(−nθ + ψ) = cos(nθ + π − ψ)
    for phase in [
        &mut drive.error_phase_1,
        &mut drive.error_phase_2,
        &mut drive.error_phase_3,
        &mut drive.pinion_runout_phase,
        &mut drive.ring_runout_phase,
    ] {
        *phase = PI - *phase;
    }
}

/// Number of the planet in a name, from 1.
fn planet_of(name: &str) -> Option<usize> {
    let at = name.find("planet[")? + "planet[".len();
    name[at..at + 1].parse().ok()
}

fn variable(name: &str) -> &'static Variable {
    named(name).unwrap_or_else(|| panic!("no variable {name}"))
}
