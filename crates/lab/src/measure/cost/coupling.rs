//! A coupled run: the differential steps from one communication point to the next with inputs held, the host does the rest.
//!
//! Held as they are at the begin of a step, inputs are late by half a step on average: the run is of order 1. A host that
//! can take the step back (fmi2GetFMUstate, fmi2SetFMUstate) repeats it with the mean of the inputs at both ends: order 2.

use anyhow::{Result, anyhow};
use bevel_differential::model::{Inputs, Simulation};
use bevel_differential::problem;

use super::cases::{Fidelity, Sample};
use super::vehicle;

/// How a run is coupled.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Coupling {
    /// Inputs held as they are at the begin of a step.
    Plain,
    /// The same, then each step taken back and repeated so many times with the mean of its inputs.
    Rollback(u32),
    /// No coupling: constant inputs.
    None,
}

/// The differential with its car.
#[derive(Clone)]
pub struct CoupledSystem {
    /// The differential.
    pub simulation: Simulation,
    /// Speed of the car [m/s].
    car: f64,
}

/// How long runs take, and when they are compared [s].
pub const TIMES: [f64; 4] = [0.1, 0.2, 0.3, 0.4];
/// Step of the run in one piece [s], by whether there are teeth: an explicit method has to resolve their damping.
const IN_ONE_PIECE: [f64; 2] = [1e-4, 1e-6];

fn started(fidelity: Fidelity, tolerance: f64, inputs: &Inputs) -> Result<Simulation> {
    let mut parameters = vehicle::parameters(fidelity);
    parameters.solver.relative_tolerance = tolerance;
    Simulation::start(&parameters, inputs, 0.0).map_err(|found| anyhow!("{}", problem::list(&found)))
}

impl CoupledSystem {
    /// At the start.
    pub fn start(fidelity: Fidelity, tolerance: f64) -> Result<Self> {
        let car = vehicle::speed_at_start();
        let simulation = started(fidelity, tolerance, &vehicle::inputs(0.0, [vehicle::SPEED; 2], car))?;
        Ok(Self { simulation, car })
    }

    /// One step to `end`.
    pub fn step(&mut self, end: f64, coupling: Coupling) -> Result<(), String> {
        let begin = self.simulation.time();
        let h = end - begin;
        let given = vehicle::inputs(begin, self.simulation.motion().side_speed, self.car);
        let before = self.clone();
        self.take(end, &given)?;
        self.car = before.car + h * vehicle::acceleration(&given);
        let Coupling::Rollback(corrections) = coupling else { return Ok(()) };
        for _ in 0..corrections {
            let found = vehicle::inputs(end, self.simulation.motion().side_speed, self.car);
            let mean = Inputs {
                carrier_torque: 0.5 * (given.carrier_torque + found.carrier_torque),
                load_torque: [0, 1].map(|s| 0.5 * (given.load_torque[s] + found.load_torque[s])),
                ..given
            };
            *self = before.clone();
            self.take(end, &mean)?;
            self.car = before.car + h * vehicle::acceleration(&mean);
        }
        Ok(())
    }

    fn take(&mut self, end: f64, inputs: &Inputs) -> Result<(), String> {
        self.simulation.set_inputs(inputs);
        self.simulation.advance(end).map_err(|failure| failure.to_string())
    }

    /// What is compared, under the inputs of this instant.
    fn sample(&self) -> Sample {
        let mut simulation = self.simulation.clone();
        simulation.set_inputs(&vehicle::inputs(simulation.time(), simulation.motion().side_speed, self.car));
        Sample::of(&mut simulation)
    }

    /// Runs to the end in communication steps of `h` [s], calling `visit` at [`TIMES`].
    pub fn run(&mut self, h: f64, coupling: Coupling, mut visit: impl FnMut(&Self)) -> Result<(), String> {
        let mut done = 0.0;
        for time in TIMES {
            let steps = (time / h).round();
            while done < steps {
                done += 1.0;
                let end = done * h;
                match coupling {
                    Coupling::None => self.take(end, &constant())?,
                    coupling => self.step(end, coupling)?,
                }
            }
            visit(self);
        }
        Ok(())
    }

    /// Samples of a run, and what the solver did: steps and evaluations.
    pub fn samples(mut self, h: f64, coupling: Coupling) -> Result<(Vec<Sample>, [u64; 2]), String> {
        let mut samples = Vec::new();
        self.run(h, coupling, |coupled| samples.push(coupled.sample()))?;
        let statistics = self.simulation.state().statistics;
        Ok((samples, [statistics.accepted, statistics.evaluations]))
    }
}

/// Inputs of the run without coupling: the drive at its end, the left wheel beyond its grip.
fn constant() -> Inputs {
    Inputs { carrier_torque: vehicle::drive_torque(1.0), load_torque: [150.0, 200.0], ..Inputs::default() }
}

/// The coupled system in one piece: differential, wheels and car by the classical Runge–Kutta method, from the equations
/// of motion alone, so that neither communication points nor the program's solver have a part in it.
pub fn in_one_piece(fidelity: Fidelity) -> Result<Vec<Sample>> {
    let CoupledSystem { mut simulation, car } = CoupledSystem::start(fidelity, 1e-6)?;
    let n = simulation.freedoms();
    let state = *simulation.state();
    let mut y: Vec<f64> = state.q[..n].iter().chain(&state.v[..n]).copied().chain([car]).collect();
    let pitches = pitches(&vehicle::parameters(fidelity), n);
    let h = IN_ONE_PIECE[usize::from(fidelity != Fidelity::Ideal)];
    let mut rates = [(); 4].map(|()| vec![0.0; 2 * n + 1]);
    let mut at = y.clone();
    let mut samples = Vec::new();
    let (mut done, mut time) = (0.0, 0.0);
    for end in TIMES {
        let steps = (end / h).round();
        while done < steps {
            for stage in 0..4 {
                let part = [0.0, 0.5, 0.5, 1.0][stage] * h;
                for i in 0..y.len() {
                    at[i] = if stage == 0 { y[i] } else { y[i] + part * rates[stage - 1][i] };
                }
                let inputs = vehicle::inputs(time + part, [at[n], at[n + 1]], at[2 * n]);
                simulation.set_inputs(&inputs);
                let (positions, others) = rates[stage].split_at_mut(n);
                let (velocities, car) = others.split_at_mut(n);
                simulation.rates(&at[..n], &at[n..2 * n], [positions, velocities]);
                car[0] = vehicle::acceleration(&inputs);
            }
            for (i, y) in y.iter_mut().enumerate() {
                *y += h / 6.0 * (rates[0][i] + 2.0 * (rates[1][i] + rates[2][i]) + rates[3][i]);
            }
            // teeth are alike: positions stay within one pitch, where the equations expect them
            for (q, pitch) in y.iter_mut().zip(&pitches) {
                *q -= pitch * (*q / pitch).trunc();
            }
            done += 1.0;
            time = done * h;
        }
        simulation.set_inputs(&vehicle::inputs(time, [y[n], y[n + 1]], y[2 * n]));
        samples.push(Sample::of(&mut simulation.moved(&y[..n], &y[n..2 * n])));
    }
    Ok(samples)
}

/// Tooth pitches of side gears and planets, a turn of the carrier [rad].
fn pitches(parameters: &bevel_differential::model::Parameters, n: usize) -> Vec<f64> {
    let turn = std::f64::consts::TAU;
    let [side, planet] =
        [parameters.geometry.side_teeth, parameters.geometry.planet_teeth].map(|z| turn / f64::from(z));
    (0..n).map(|i| [side, side, turn].get(i).copied().unwrap_or(planet)).collect()
}

#[cfg(test)]
mod tests {
    use super::super::reference::errors;
    use super::*;

    /// Order between two steps.
    fn order(coupling: Coupling, steps: [f64; 2]) -> f64 {
        // ideal gears are a closed form between communication points: all error is that of the coupling
        let reference = in_one_piece(Fidelity::Ideal).expect("runs");
        let error = |h: f64| {
            let coupled = CoupledSystem::start(Fidelity::Ideal, 1e-6).expect("starts");
            errors(&reference, &coupled.samples(h, coupling).expect("runs").0)[0]
        };
        (error(steps[1]) / error(steps[0])).ln() / (steps[1] / steps[0]).ln()
    }

    #[test]
    fn plain_stepping_is_of_order_one_and_rollback_of_order_two() {
        let steps = [1e-4, 2e-4];
        let [plain, rollback] = [Coupling::Plain, Coupling::Rollback(2)].map(|coupling| order(coupling, steps));
        assert!((plain - 1.0).abs() < 0.1, "{plain}");
        assert!((rollback - 2.0).abs() < 0.1, "{rollback}");
    }

    #[test]
    fn constant_inputs_need_no_communication() {
        let run = |h: f64| {
            CoupledSystem::start(Fidelity::Ideal, 1e-6).expect("starts").samples(h, Coupling::None).expect("runs").0
        };
        assert!(errors(&run(0.1), &run(1e-3))[0] < 1e-12);
    }
}
