//! What is simulated: three motions at four fidelities, each with the times at which results are compared.
//!
//! Results are compared seldom, as fixed steps end at every communication point: points that lie closer than steps want to be
//! long would dictate them, and the figure would show the host's step instead of the solver's. Other methods answer between the
//! ends of their steps.

use anyhow::{Result, anyhow};
use bevel_differential::contact::{ContactLaw, DampingModel};
use bevel_differential::integrate::Statistics;
use bevel_differential::model::{GearContact, Inputs, Method, Parameters, PlanetSpin, Simulation, SolverSpec, Start};
use bevel_differential::problem;
use cpu_time::ThreadTime;

use answers::scene;
use answers::study::published;

/// A motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CaseMotion {
    /// The study's turn, teeth preloaded: smooth, but for the hand-over of the load from pair to pair.
    Turn,
    /// The same started in the middle of the gaps: the teeth strike.
    Blow,
    /// The scene `clunk` with the study's gears, damped by restitution: the whole lash is crossed, half-shafts wind up. With
    /// gears as light and undamped as the scene has them, teeth rattle on and solutions that differ by rounding part
    /// within its 20 ms, so that nothing could be compared.
    Clunk,
}

/// How the meshes are represented.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fidelity {
    /// Willis' equation as a constraint.
    Ideal,
    /// One spring per mesh.
    Lumped,
    /// Teeth, pair by pair, with Adams' IMPACT.
    Impact,
    /// Teeth, pair by pair, with stiffness from their geometry.
    Line,
}

/// A motion at a fidelity.
#[derive(Clone)]
pub struct CostCase {
    /// The motion.
    pub motion: CaseMotion,
    /// The fidelity.
    pub fidelity: Fidelity,
    /// Parameters, but for the solver.
    pub parameters: Parameters,
    /// Inputs of the start.
    pub inputs: Inputs,
    /// Inputs from then on.
    pub then: Inputs,
    /// Times at which results are compared [s].
    pub times: Vec<f64>,
}

/// What is compared at a time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// Speeds of the side gears [rad/s].
    pub speed: [f64; 2],
    /// Normal forces of the first planet's meshes [N].
    pub force: [f64; 2],
}

impl CaseMotion {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Turn, Self::Blow, Self::Clunk];

    /// Its name in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Turn => "turn",
            Self::Blow => "blow",
            Self::Clunk => "clunk",
        }
    }

    /// Ends and steps of the stretches of its times [s]. A turn is one tooth long.
    fn stretches(self) -> &'static [(f64, f64)] {
        match self {
            Self::Turn => &[(0.18, 10e-3)],
            Self::Blow => &[(2e-3, 250e-6), (20e-3, 2e-3)],
            Self::Clunk => &[(20e-3, 1e-3)],
        }
    }

    fn times(self) -> Vec<f64> {
        let (mut times, mut begin) = (Vec::new(), 0.0);
        for &(end, step) in self.stretches() {
            let count = ((end - begin) / step).round() as usize;
            times.extend((1..=count).map(|k| begin + step * k as f64));
            begin = end;
        }
        times
    }
}

impl Fidelity {
    /// All of them, plainest first.
    pub const ALL: [Self; 4] = [Self::Ideal, Self::Lumped, Self::Impact, Self::Line];

    /// Its name in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Ideal => "ideal",
            Self::Lumped => "lumped",
            Self::Impact => "impact",
            Self::Line => "line",
        }
    }

    /// `parameters` with it.
    pub fn of(self, mut parameters: Parameters) -> Parameters {
        parameters.scene.gear_contact = match self {
            Self::Ideal => GearContact::Ideal,
            Self::Lumped => GearContact::Lumped,
            Self::Impact | Self::Line => GearContact::Tooth,
        };
        parameters.contact.law = if self == Self::Line { ContactLaw::Line } else { ContactLaw::Impact };
        parameters
    }
}

/// Inertia of a side gear and of a planet of the references in tests/data [kg·m²].
const GIVEN: [f64; 2] = [9e-5, 2e-5];

/// The study's turn, with inertias as given and not from solids, which other programs would have to take over.
pub fn turn() -> (Parameters, Inputs) {
    let mut parameters = Parameters::default();
    parameters.inertia.from_geometry = false;
    [parameters.inertia.side_gear, parameters.inertia.planet] = GIVEN;
    parameters.scene.planet_spin = PlanetSpin::Imposed;
    let inputs = Inputs {
        carrier_speed: published::CARRIER_SPEED[1].to_radians(),
        planet_spin: published::PLANET_SPIN.to_radians(),
        load_torque: [published::LOAD; 2],
        ..Inputs::default()
    };
    (parameters, inputs)
}

impl CostCase {
    /// `motion` at `fidelity`.
    pub fn new(motion: CaseMotion, fidelity: Fidelity) -> Result<Self> {
        let (mut parameters, inputs, then) = match motion {
            CaseMotion::Turn | CaseMotion::Blow => {
                let (parameters, inputs) = turn();
                (parameters, inputs, inputs)
            }
            CaseMotion::Clunk => {
                let scene = scene::find("clunk", &fmu_build::tools::paths::scenes())?;
                let (mut parameters, mut then) = (scene.parameters, scene.inputs);
                for setting in scene.events.iter().flat_map(|event| &event.settings) {
                    setting.apply(&mut parameters, &mut then);
                }
                let study = Parameters::default();
                parameters.contact.damping_model = DampingModel::Restitution;
                parameters.inertia.side_gear = study.inertia.side_gear;
                parameters.inertia.planet = study.inertia.planet;
                (parameters, scene.inputs, then)
            }
        };
        if motion == CaseMotion::Blow {
            parameters.scene.start = Start::Rolling;
        }
        Ok(Self { motion, fidelity, parameters: fidelity.of(parameters), inputs, then, times: motion.times() })
    }

    /// All cases; a blow needs teeth to strike.
    pub fn all() -> Result<Vec<Self>> {
        let pairs = CaseMotion::ALL.into_iter().flat_map(|motion| Fidelity::ALL.map(|fidelity| (motion, fidelity)));
        let there = pairs.filter(|pair| *pair != (CaseMotion::Blow, Fidelity::Ideal));
        there.map(|(motion, fidelity)| Self::new(motion, fidelity)).collect()
    }

    /// Its name in files.
    pub fn name(&self) -> String {
        format!("{}/{}", self.motion.name(), self.fidelity.name())
    }

    /// Ready to run.
    pub fn start(&self, method: Method, tolerance: f64, fixed_step: f64) -> Result<Simulation> {
        let solver = SolverSpec { method, relative_tolerance: tolerance, fixed_step, merge_planets: true };
        let parameters = Parameters { solver, ..self.parameters };
        let simulation = Simulation::start(&parameters, &self.inputs, 0.0);
        let mut simulation = simulation.map_err(|found| anyhow!("case {}: {}", self.name(), problem::list(&found)))?;
        simulation.set_inputs(&self.then);
        Ok(simulation)
    }

    /// Runs to the end, for at most `patience` seconds on the processor, and hands the simulation over at each time; or
    /// returns why it does not run to its end.
    pub fn run(
        &self,
        mut simulation: Simulation,
        patience: f64,
        mut visit: impl FnMut(&mut Simulation),
    ) -> Result<Statistics, String> {
        let begun = ThreadTime::now();
        for &time in &self.times {
            simulation.advance(time).map_err(|failure| failure.to_string())?;
            visit(&mut simulation);
            // asking a clock takes longer than a step in closed form
            if patience.is_finite() && begun.elapsed().as_secs_f64() > patience {
                return Err(format!("given up at {time} s, after {patience} s on the processor"));
            }
        }
        Ok(simulation.state().statistics)
    }

    /// What is compared, at all times, and what it took to get there.
    pub fn samples(&self, simulation: Simulation, patience: f64) -> Result<(Vec<Sample>, Statistics), String> {
        let mut samples = Vec::new();
        let statistics = self.run(simulation, patience, |simulation| samples.push(Sample::of(simulation)))?;
        Ok((samples, statistics))
    }
}

impl Sample {
    /// That of the present.
    pub fn of(simulation: &mut Simulation) -> Self {
        let speed = simulation.motion().side_speed;
        Self { speed, force: simulation.forces().mesh[0].map(|mesh| mesh.normal) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cases_run_and_end_on_time() {
        for case in CostCase::all().expect("cases") {
            let simulation = case.start(Method::Adaptive, 1e-3, 1e-4).expect("starts");
            let (samples, statistics) = case.samples(simulation, f64::INFINITY).expect("runs");
            assert_eq!(samples.len(), case.times.len(), "{}", case.name());
            // steps do not depend on the times of samples, and one that leads beyond the last of them is not completed
            assert!(statistics.accepted + statistics.evaluations > 0, "{}", case.name());
            assert!(samples.iter().all(|s| s.speed.iter().chain(&s.force).all(|x| x.is_finite())));
        }
    }
}
