//! Scenes and their courses in time.

use std::sync::OnceLock;

use bevel_differential::contact::errors::{GearTeeth, ToothErrors};
use bevel_differential::geometry::Pair;
use bevel_differential::model::{
    BODIES, Body, GearContact, Given, InputDerivatives, Inputs, Layout, Parameters, Simulation, State,
};
use bevel_differential::problem::Problem;
use bevel_differential::variables::{Access, OutputSource, Variable, table};

/// Communication step.
#[derive(Clone, Copy, Debug)]
pub struct Step {
    pub size: f64,
    pub inputs: Inputs,
    pub derivatives: Option<InputDerivatives>,
}

/// Scene from its start to its end.
#[derive(Clone, Debug)]
pub struct Scene {
    pub parameters: Parameters,
    pub inputs: Inputs,
    pub steps: Vec<Step>,
    /// Teeth of all gears, if they differ.
    pub teeth: Option<Vec<GearTeeth>>,
    /// State from which the scene continues, instead of a start.
    pub from: Option<State>,
    /// Angle by which gears are displaced before every step [rad].
    pub nudge: f64,
}

/// Number of evaluations after which a course is long enough. Few scenes need more, and they would take most of the time.
const MOST_EVALUATIONS: u64 = 40_000;

/// Values of all outputs at the start and after each step.
pub struct Course {
    pub times: Vec<f64>,
    pub values: Vec<Vec<f64>>,
    /// State at the start.
    pub start: State,
    /// Indices of the bodies in this state.
    pub layout: Layout,
    /// Index of the first values after dry friction has switched.
    pub switched: usize,
    /// Error message, if the course ended early.
    pub failure: Option<String>,
    /// Number of steps within which the solver has evaluated the tooth forces at most [`MOST_EVALUATIONS`] times.
    pub cheap_steps: usize,
}

/// Rows of outputs and local variables, except single tooth pairs. Those are read from only one mesh, which has no
/// image; `tests/model/pair_lines.rs` reverses them.
pub fn outputs() -> &'static [&'static Variable] {
    static OUTPUTS: OnceLock<Vec<&'static Variable>> = OnceLock::new();
    let is_mapped = |row: &&'static Variable| matches!(row.access, Access::Output(source) if !matches!(source, OutputSource::Pair(..)));
    OUTPUTS.get_or_init(|| table().rows.iter().filter(is_mapped).collect())
}

/// Index of the output `name`.
pub fn output(name: &str) -> usize {
    outputs().iter().position(|row| row.name == name).unwrap_or_else(|| panic!("no output {name}"))
}

impl Scene {
    /// Scene whose teeth are listed individually if they differ.
    pub fn new(parameters: Parameters, inputs: Inputs, steps: Vec<Step>) -> Result<Self, Vec<Problem>> {
        let mut scene = Self { parameters, inputs, steps, teeth: None, from: None, nudge: 0.0 };
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
        let (p, i) = (&self.parameters, &self.inputs);
        let given = Given { teeth: self.teeth.as_deref(), ..Given::default() };
        let mut simulation = match self.from {
            Some(state) => Simulation::resume_with(p, i, (state, None), &given)?,
            None => Simulation::start_with(p, i, 0.0, &given)?,
        };
        let read = |simulation: &mut Simulation| -> Vec<f64> {
            let value =
                |row: &&Variable| if let Access::Output(of) = row.access { of.read(simulation) } else { f64::NAN };
            outputs().iter().map(value).collect()
        };
        let (start, layout) = (*simulation.state(), simulation.plan().layout());
        let values = vec![read(&mut simulation)];
        let mut course =
            Course { times: vec![0.0], values, start, layout, switched: usize::MAX, failure: None, cheap_steps: 0 };
        self.nudge(&mut simulation);
        let mut time = 0.0;
        for step in &self.steps {
            simulation.set_inputs(&step.inputs);
            simulation.set_input_derivatives(step.derivatives);
            time += step.size;
            if let Err(failure) = simulation.advance(time) {
                course.failure = Some(failure.message);
                break;
            }
            let state = simulation.state();
            if state.statistics.evaluations <= MOST_EVALUATIONS {
                course.cheap_steps += 1;
            }
            let modes = state.friction.iter().zip(&start.friction).all(|(now, then)| now.mode == then.mode);
            if !modes || state.statistics.rejected_switch > 0 {
                course.switched = course.switched.min(course.times.len());
            }
            course.times.push(time);
            course.values.push(read(&mut simulation));
            self.nudge(&mut simulation);
        }
        Ok(course)
    }

    /// Displaces side gears and planets alternately by `nudge`. This restarts the integration of a twin. Other courses
    /// are displaced by zero, so that they restart as well.
    fn nudge(&self, simulation: &mut Simulation) {
        let mut states = simulation.states();
        for (k, body) in BODIES.iter().enumerate() {
            if matches!(body, Body::Side(_) | Body::Planet(_)) {
                states[k] += if k % 3 == 1 { -self.nudge } else { self.nudge };
            }
        }
        simulation.set_states(&states);
    }

    /// Twin of the scene, disturbed up or down (`sign` = ±1) by 1e-15, which is the size of rounding errors in an
    /// image. Inputs and pressure angle change by this fraction of their values, the angles of the gears by 1e-15 rad
    /// before every step.
    pub fn disturbed(&self, mut sign: f64) -> Self {
        const BY: f64 = 1e-15;
        let mut twin = Self { nudge: sign * BY, ..self.clone() };
        twin.parameters.geometry.pressure_angle *= 1.0 + sign * BY;
        let mut inputs = vec![&mut twin.inputs];
        inputs.extend(twin.steps.iter_mut().map(|step| &mut step.inputs));
        for inputs in inputs {
            for row in table().rows {
                if let Access::Input(field) = row.access {
                    *field(inputs) *= 1.0 + sign * BY;
                    sign = -sign;
                }
            }
            *inputs = inputs.limited();
        }
        twin
    }
}
