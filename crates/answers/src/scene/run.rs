//! Runs a scene with the library's simulation and summarises its outputs.

use std::io::Write;
use std::time::{Duration, Instant};

use anyhow::{Context, Result, anyhow};
use bevel_differential::model::{HostInputs, InputDerivatives, Inputs, Parameters, Reported, Simulation};
use bevel_differential::problem::Problem;
use bevel_differential::variables::{Access, Variable, check_ranges};
use schedule::{Schedule, Step};

use super::display_units::DisplayUnits;
use super::time_mean::TimeMean;
use super::warnings::at_start;
use super::{InputTable, Scene};
use super::{off, units};
use crate::problem::Problems;
use crate::progress::Progress;
use crate::text::table::Table;

/// Running scene: it executes the schedule of its communication steps.
pub struct SceneRun<'a> {
    scene: &'a Scene,
    parameters: Parameters,
    inputs: Inputs,
    schedule: Schedule,
    /// Step that begins with a jump, if its values are set and the simulation has not advanced, with inputs that ramp.
    begun: Option<(Step, Option<HostInputs>)>,
    /// Number of points of tables between communication points, if these points make the run much longer.
    prolonged_by: Option<usize>,
    /// Number of completed steps.
    steps: usize,
    reported: Reported,
    /// Warnings since the start.
    found: Vec<Problem>,
    /// The simulation.
    pub simulation: Simulation,
}

impl<'a> SceneRun<'a> {
    /// Starts `scene` with communication steps of `step` [s].
    pub fn start(scene: &'a Scene, step: f64) -> Result<Self> {
        Self::attempt(scene, step)
            .map_err(|found| Problems(found.iter().map(Into::into).collect()))
            .with_context(|| refused(scene))
    }

    /// Starts `scene` as [`Self::start`] does. Contradictions are returned by variable.
    pub fn attempt(scene: &'a Scene, step: f64) -> Result<Self, Vec<Problem>> {
        let out_of_range = check_ranges(&scene.parameters);
        if !out_of_range.is_empty() {
            return Err(out_of_range);
        }
        let simulation = Simulation::start(&scene.parameters, &scene.inputs, 0.0)?;
        let (events, tables) = (scene.events.iter().map(|event| event.time), scene.input_tables.iter());
        let schedule = Schedule::new(scene.stop_time, Some(step), events.collect(), tables.map(|driven| &driven.table));
        let Scene { parameters, inputs, .. } = *scene;
        let (prolonged_by, begun, steps) = (schedule.points_that_prolong(), None, 0);
        let (reported, found) = (Reported::default(), Vec::new());
        Ok(Self { scene, parameters, inputs, schedule, begun, prolonged_by, steps, reported, found, simulation })
    }

    /// Time [s].
    pub fn time(&self) -> f64 {
        self.simulation.time()
    }

    /// True if the scene is finished.
    pub fn is_over(&self) -> bool {
        self.schedule.is_over() && self.begun.is_none()
    }

    /// Number of steps so far. Steps end at communication points, and at points of tables between them.
    pub fn steps(&self) -> usize {
        self.steps
    }

    /// Advances to the next row of a record: to the next communication point, or to an earlier jump of inputs. A jump
    /// has a second row, with the values after it, to which this method advances without a step in time.
    pub fn advance(&mut self) -> Result<()> {
        loop {
            let (step, ramp) = match self.begun.take() {
                Some(begun) => begun,
                None => {
                    let Some(step) = self.schedule.next() else { return Ok(()) };
                    let ramp = self.feed(&step);
                    if step.begins_with_jump {
                        self.begun = Some((step, ramp));
                        return Ok(());
                    }
                    (step, ramp)
                }
            };
            self.end_step(&step, ramp)?;
            if step.is_recorded {
                return Ok(());
            }
        }
    }

    fn end_step(&mut self, step: &Step, ramp: Option<HostInputs>) -> Result<()> {
        self.simulation.advance(step.end).map_err(|why| anyhow!("{why}")).with_context(|| refused(self.scene))?;
        self.steps += 1;
        ramp.iter().for_each(|host| self.simulation.end_ramp(host));
        self.found.extend(self.simulation.unreported(&mut self.reported));
        if self.is_over() {
            self.found.extend(self.simulation.unreported_at_end(&mut self.reported));
        }
        Ok(())
    }

    /// Warnings about the scene and its run so far.
    pub fn warnings(&self) -> Vec<String> {
        let found = self.found.iter().map(Problem::to_string);
        let prolonged = self.prolonged_by.map(|points| {
            format!(
                "the run ends a step at each of {points} points of tables between its communication points, which makes it much \
                 longer; tables with fewer points make it shorter"
            )
        });
        at_start(self.scene, &self.simulation).into_iter().chain(prolonged).chain(found).collect()
    }

    /// Warnings about the run so far.
    pub fn warnings_since_start(&self) -> &[Problem] {
        &self.found
    }

    /// Sets values that are due before `step`, and inputs that follow tables. Returns the inputs if jumping ones ramp
    /// over the step.
    fn feed(&mut self, step: &Step) -> Option<HostInputs> {
        let mut tuned = false;
        for setting in self.scene.events[step.changes.clone()].iter().flat_map(|event| &event.settings) {
            setting.apply(&mut self.parameters, &mut self.inputs);
            tuned |= !matches!(setting.row.access, Access::Input(_));
        }
        let (mut derivatives, mut follow) = (InputDerivatives::ZERO, Inputs::ZERO);
        // if two tables name one input, the last one applies
        for InputTable { row, table } in &self.scene.input_tables {
            if let Access::Input(access) = row.access {
                [*access(&mut self.inputs), *access(&mut derivatives.rates[0])] = step.follow(table);
                *access(&mut follow) = f64::from(self.scene.input_slopes);
            }
        }
        let ramps = self.simulation.ramps_inputs();
        if !ramps {
            self.simulation.set_inputs(&self.inputs);
        }
        if tuned {
            self.simulation.tune(&self.parameters);
        }
        if ramps {
            let host = HostInputs { values: self.inputs, derivatives, follow };
            self.simulation.ramp_inputs(&host, step.end);
            return Some(host);
        }
        if self.scene.input_slopes {
            self.simulation.set_input_derivatives((derivatives != InputDerivatives::ZERO).then_some(derivatives));
        }
        None
    }

    /// Value of an output, or of an input.
    pub fn read(&mut self, row: &Variable) -> f64 {
        match row.access {
            Access::Output(source) => source.read(&mut self.simulation),
            // after a jump, the simulation may approach the value on a ramp
            Access::Input(slot) if self.begun.is_some() => *slot(&mut self.inputs),
            Access::Input(slot) => *slot(&mut { *self.simulation.inputs() }),
            _ => f64::NAN,
        }
    }
}

fn refused(scene: &Scene) -> String {
    format!("scene {}", scene.name)
}

/// Statistics of an output over time.
#[derive(Clone, Copy)]
pub struct Summary {
    /// The output.
    pub row: &'static Variable,
    /// Smallest value at a communication point.
    pub min: f64,
    /// Largest value at a communication point.
    pub max: f64,
    /// Mean over time, interpolated linearly between the rows of the record.
    pub mean: f64,
    /// Final value.
    pub end: f64,
}

/// Result of a run.
#[derive(Clone)]
pub struct SceneResult {
    /// Summary of each output of the scene.
    pub outputs: Vec<Summary>,
    /// Text about steps and evaluations of the solver.
    pub account: String,
    /// Residual of the energy balance at the end [J].
    pub residual: f64,
    /// Energy throughput: the energy exchanged with drives and wheels, or the energy in the ledger, whichever is larger
    /// [J].
    pub throughput: f64,
    /// Computing time.
    pub took: Duration,
}

/// Runs `scene` to its end and writes each communication point to `csv`, if given.
pub fn run(scene: &Scene, csv: Option<&mut dyn Write>, progress: &mut Progress) -> Result<SceneResult> {
    let begun = Instant::now();
    progress.begin_task(0.0, "simulating");
    let mut run = SceneRun::start(scene, scene.step)?;
    let recorded: Vec<Variable> = scene.outputs.iter().map(|row| scene.display_units.row_in_files(row)).collect();
    let mut csv = csv.map(|out| record(scene, &recorded, out).context("the record cannot be written")).transpose()?;
    let mut values: Vec<f64> = scene.outputs.iter().map(|row| run.read(row)).collect();
    let of_start = |(&row, &value)| Summary { row, min: value, max: value, mean: value, end: value };
    let mut outputs: Vec<Summary> = scene.outputs.iter().zip(&values).map(of_start).collect();
    let mut means = vec![TimeMean::default(); values.len()];
    means.iter_mut().zip(&values).for_each(|(mean, &value)| mean.add(0.0, value));
    line(&mut csv, 0.0, &recorded, &values)?;
    let (mut exchanged, mut seen) = (0.0, 0.0);
    let (mut power, mut work) = (exchange(&mut run), run.simulation.state().sums.work);
    while !run.is_over() {
        let before = run.time();
        run.advance()?;
        let span = run.time() - before;
        for ((summary, mean), last) in outputs.iter_mut().zip(&mut means).zip(&mut values) {
            let value = run.read(summary.row);
            mean.add(run.time(), value);
            let (min, max) = (summary.min.min(value), summary.max.max(value));
            *summary = Summary { row: summary.row, min, max, mean: mean.value(), end: value };
            *last = value;
        }
        let now = exchange(&mut run);
        exchanged += 0.5 * span * (power + now);
        seen += (run.simulation.state().sums.work - work).abs();
        (power, work) = (now, run.simulation.state().sums.work);
        line(&mut csv, run.time(), &recorded, &values)?;
        progress.advance(run.time() / scene.stop_time)?;
    }
    if let Some(rows) = &mut csv {
        rows.flush().context("the record cannot be written")?;
    }
    progress.warn(off::warnings(scene).into_iter().chain(run.warnings()));
    Ok(SceneResult {
        outputs,
        account: run.simulation.account(),
        residual: run.simulation.ledger().energy_residual,
        throughput: f64::max(exchanged, seen),
        took: begun.elapsed(),
    })
}

/// Total of the powers that drives and wheels exchange with the differential, regardless of direction [W].
fn exchange(run: &mut SceneRun) -> f64 {
    let forces = run.simulation.forces();
    forces.power_in.abs() + forces.power_out.abs()
}

/// Starts the record of a scene with its header, before a row for each communication point.
fn record<'a>(scene: &Scene, outputs: &[Variable], out: &'a mut dyn Write) -> Result<csv::Writer<&'a mut dyn Write>> {
    let mut rows = csv::Writer::from_writer(out);
    // SI columns keep their plain names
    let headers = |row: &Variable| if scene.display_units.is_empty() { row.name.into() } else { units::header(row) };
    let time = if scene.display_units.is_empty() { "time" } else { "time [s]" };
    rows.write_record(std::iter::once(time.to_owned()).chain(outputs.iter().map(headers)))?;
    Ok(rows)
}

fn line(rows: &mut Option<csv::Writer<&mut dyn Write>>, time: f64, outputs: &[Variable], values: &[f64]) -> Result<()> {
    let Some(rows) = rows else { return Ok(()) };
    let shown = outputs.iter().zip(values).map(|(row, &value)| units::shown(row, value));
    let cells = std::iter::once(time).chain(shown).map(|value| value.to_string());
    rows.write_record(cells).context("the record cannot be written")
}

impl SceneResult {
    /// Energy residual divided by the throughput.
    pub fn relative_residual(&self) -> f64 {
        if self.throughput > 0.0 { self.residual.abs() / self.throughput } else { self.residual.abs() }
    }

    /// Text for the terminal, in `display_units`.
    pub fn text(&self, display_units: &DisplayUnits) -> String {
        let mut table = Table::new(["output", "unit", "min", "mean", "max", "end"]).left([0, 1]);
        for o in &self.outputs {
            let row = display_units.row(o.row);
            let numbers = [o.min, o.mean, o.max, o.end].map(|value| units::six_digits(units::shown(&row, value)));
            table.push([row.name, units::name(&row)].map(str::to_owned).into_iter().chain(numbers));
        }
        let mut out = table.terminal();
        out.push_str(&format!(
            "\n{}\nenergy residual {} of the {} J that went through; computed in {:.2} s\n",
            self.account,
            units::six_digits(self.relative_residual()),
            units::six_digits(self.throughput),
            self.took.as_secs_f64()
        ));
        out
    }
}
