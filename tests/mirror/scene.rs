//! A scene, its course in time, and its images.

use std::sync::OnceLock;

use bevel_differential::contact::errors::{FaultyGear, GearTeeth, ToothErrors};
use bevel_differential::geometry::Pair;
use bevel_differential::model::{
    CarrierDrive, GearContact, InputDerivatives, Inputs, Parameters, Simulation, State,
};
use bevel_differential::problem::Problem;
use bevel_differential::variables::{Access, Variable, table};

use crate::table::{Parity, line_of, lines};
use crate::teeth::{self, View};

/// A communication step.
#[derive(Clone, Copy, Debug)]
pub struct Step {
    pub size: f64,
    pub inputs: Inputs,
    pub derivatives: Option<InputDerivatives>,
}

/// A scene from its start to its end.
#[derive(Clone, Debug)]
pub struct Scene {
    pub parameters: Parameters,
    pub inputs: Inputs,
    pub steps: Vec<Step>,
    /// Teeth of all gears, where they differ.
    pub teeth: Option<Vec<GearTeeth>>,
    /// Where it goes on from, instead of starting.
    pub from: Option<State>,
}

/// Values of all outputs at the start and after each step.
pub struct Course {
    pub times: Vec<f64>,
    pub values: Vec<Vec<f64>>,
    /// State at the start.
    pub start: State,
    /// Why it ended before its time.
    pub failure: Option<String>,
}

/// Rows of the outputs and local variables, and the way to their values.
pub fn outputs() -> &'static [&'static Variable] {
    static OUTPUTS: OnceLock<Vec<&'static Variable>> = OnceLock::new();
    OUTPUTS.get_or_init(|| table().rows.iter().filter(|row| matches!(row.access, Access::Output(_))).collect())
}

/// Index of an output.
pub fn output(name: &str) -> usize {
    outputs().iter().position(|row| row.name == name).unwrap_or_else(|| panic!("no output {name}"))
}

impl Scene {
    /// A scene whose teeth, where they differ, are listed one by one.
    pub fn new(parameters: Parameters, inputs: Inputs, steps: Vec<Step>) -> Result<Self, Vec<Problem>> {
        let mut scene = Self { parameters, inputs, steps, teeth: None, from: None };
        if parameters.effects.tooth_errors && parameters.scene.gear_contact == GearContact::Tooth {
            let count = usize::try_from(parameters.geometry.planet_count).unwrap_or(0);
            let errors = ToothErrors::new(&parameters.specs.tooth_errors, &scene.pair(), count);
            scene.teeth = Some(errors.map_err(|problem| vec![problem])?.teeth());
        }
        Ok(scene)
    }

    pub fn pair(&self) -> Pair {
        Pair::new(&self.parameters.gears())
    }

    pub fn planets(&self) -> usize {
        self.parameters.geometry.planet_count as usize
    }

    /// Simulates the scene.
    pub fn run(&self) -> Result<Course, Vec<Problem>> {
        let (p, i, given) = (&self.parameters, &self.inputs, self.teeth.as_deref());
        let mut simulation = match self.from {
            Some(state) => Simulation::resume_with(p, i, state, given)?,
            None => Simulation::start_with(p, i, 0.0, given)?,
        };
        let read = |simulation: &mut Simulation| -> Vec<f64> {
            let value = |row: &&Variable| if let Access::Output(of) = row.access { of.read(simulation) } else { f64::NAN };
            outputs().iter().map(value).collect()
        };
        let start = *simulation.state();
        let mut course = Course { times: vec![0.0], values: vec![read(&mut simulation)], start, failure: None };
        let mut time = 0.0;
        for step in &self.steps {
            simulation.set_inputs(&step.inputs);
            simulation.set_input_derivatives(step.derivatives);
            time += step.size;
            if let Err(failure) = simulation.advance(time) {
                course.failure = Some(failure.message);
                break;
            }
            course.times.push(time);
            course.values.push(read(&mut simulation));
        }
        Ok(course)
    }

    /// The same scene disturbed by 1e-15 of itself: its inputs, and the pressure angle, by which positions round differently.
    pub fn disturbed(&self) -> Self {
        const BY: f64 = 1e-15;
        let mut twin = self.clone();
        twin.parameters.geometry.pressure_angle *= 1.0 + BY;
        let mut sign = 1.0;
        let mut inputs = vec![&mut twin.inputs];
        inputs.extend(twin.steps.iter_mut().map(|step| &mut step.inputs));
        for inputs in inputs {
            for row in &table().rows {
                if let Access::Input(field) = row.access {
                    *field(inputs) *= 1.0 + sign * BY;
                    sign = -sign;
                }
            }
            *inputs = inputs.limited();
        }
        twin
    }

    /// The scene in the image `view`, by the table.
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
        for row in &table().rows {
            let there = same(&self.name(view, row.name));
            let sign = self.sign(view, row.name);
            match (row.access, there.access) {
                (Access::Real(here), Access::Real(there)) => *there(to) = sign * *here(&mut from),
                (Access::Integer(here), Access::Integer(there)) => *there(to) = *here(&mut from),
                (Access::Boolean(here), Access::Boolean(there)) => *there(to) = *here(&mut from),
                (Access::Enumeration(_, get, _), Access::Enumeration(_, _, set)) => set(to, get(&from)),
                _ => {}
            }
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

    fn image_of_inputs(&self, view: View, inputs: &Inputs) -> Inputs {
        let (mut from, mut image) = (*inputs, Inputs::ZERO);
        for row in &table().rows {
            if let (Access::Input(here), Access::Input(there)) = (row.access, same(&self.name(view, row.name)).access) {
                *there(&mut image) = self.sign(view, row.name) * *here(&mut from);
            }
        }
        image
    }

    /// How a variable maps.
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
        let by_torque = self.parameters.scene.carrier_drive == CarrierDrive::Torque;
        match self.parity(view, name) {
            Parity::Odd | Parity::Lash => -1.0,
            Parity::Wave if by_torque => -1.0,
            _ => 1.0,
        }
    }

    /// Name of a variable in the image.
    fn name(&self, view: View, name: &str) -> String {
        let n = self.planets();
        match (view, planet_of(name)) {
            (View::Swapped, _) => {
                name.replace("left", "LEFT").replace("right", "left").replace("LEFT", "right")
            }
            (View::Reversed | View::Renumbered, Some(i)) if i <= n => {
                let to = teeth::renumbered(view, &self.parameters.geometry, 1 + i).gear - 1;
                name.replace(&format!("planet[{i}]"), &format!("planet[{to}]"))
            }
            _ => name.into(),
        }
    }

    /// For each output its index in the image, its factor, and what is added there.
    pub fn map(&self, view: View) -> Vec<(usize, f64, f64)> {
        let pair = self.pair();
        let lash = pair.normal_backlash * pair.mean_cone;
        outputs()
            .iter()
            .map(|row| {
                // planets that there are not have no lash, nor have gears without teeth
                let planet = planet_of(row.name).is_some_and(|i| i <= self.planets());
                let meshes = planet && self.parameters.scene.gear_contact != GearContact::Ideal;
                let added = if meshes && self.parity(view, row.name) == Parity::Lash { -lash } else { 0.0 };
                (output(&self.name(view, row.name)), self.sign(view, row.name), added)
            })
            .collect()
    }
}

/// Number of the planet in a name, from 1.
fn planet_of(name: &str) -> Option<usize> {
    let at = name.find("planet[")? + "planet[".len();
    name[at..at + 1].parse().ok()
}

fn same(name: &str) -> &'static Variable {
    table().rows.iter().find(|row| row.name == name).unwrap_or_else(|| panic!("no variable {name}"))
}
