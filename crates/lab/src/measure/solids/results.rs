//! All facet numbers in the study's turn: records, errors and times.

use anyhow::Result;
use bevel_differential::contact::solid::flank::Flanks;
use bevel_differential::integrate::Statistics;
use bevel_differential::model::Simulation;

use super::errors::{self, Errors, ForceSummary};
use super::run::{self, STEP, Solid, Teeth, TeethPoint, TeethRecord, Window};
use crate::measure::cost::measure::{self, TimedJob};
use answers::study::published;
use answers::text::numbers::Spread;

/// `solid.smoothing`: nearly the deepest point alone, which is what a general program does with faceted solids, and the
/// patch that is the default.
pub const SMOOTHINGS: [f64; 2] = [0.02, 1.0];
/// Tolerance at which integration hides nothing of the facets.
const TIGHT: f64 = 1e-9;
/// The default.
const USUAL: f64 = 1e-6;

/// How much is measured.
#[derive(Clone, Copy, Debug)]
pub struct SolidsPlan {
    /// Facet numbers.
    pub facets: &'static [i32],
    /// When runs settle and end.
    pub window: Window,
    /// Runs that are timed.
    pub runs: usize,
}

/// One kind of teeth.
pub struct TeethResult {
    /// What they are.
    pub teeth: Teeth,
    /// Errors at the tight tolerance and at the usual one; of exact teeth those of integration.
    pub errors: [Errors; 2],
    /// What its record shows.
    pub look: ForceSummary,
    /// Greatest distance of the force from its mean while teeth are on the path of contact [N].
    pub path_ripple: f64,
    /// Time of a run at the usual tolerance [s].
    pub seconds: Spread,
    /// Work of a run at the usual tolerance.
    pub statistics: Statistics,
    /// Close record at the tight tolerance.
    pub close: Vec<TeethPoint>,
}

/// All of it.
pub struct SolidsResults {
    /// Exact teeth first.
    pub rows: Vec<TeethResult>,
    /// How much was measured.
    pub form: SolidsPlan,
    /// Heights of the flanks' arcs over their facets, planet and side gear together at the mean cone distance, by
    /// [`SolidsPlan::facets`] [m].
    pub arcs: Vec<f64>,
    /// Overlap by the study's K of one pair under the whole load of a mesh [m].
    pub overlap: f64,
}

impl TeethResult {
    /// Simulated time over time on the processor.
    pub fn real_time(&self, form: &SolidsPlan) -> f64 {
        form.window.end / self.seconds.median
    }
}

impl SolidsResults {
    /// The row of `facets` at `SMOOTHINGS[which]`.
    pub fn solid(&self, facets: i32, which: usize) -> Option<&TeethResult> {
        let teeth = Teeth(Some(Solid { facets, smoothing: SMOOTHINGS[which] }));
        self.rows.iter().find(|row| row.teeth == teeth)
    }

    /// Exact teeth.
    pub fn tooth(&self) -> &TeethResult {
        &self.rows[0]
    }

    /// Facets and error `quantity` by which, at the tight tolerance.
    pub fn series(&self, quantity: usize, which: usize) -> Vec<(f64, f64)> {
        let of = |&n: &i32| Some((f64::from(n), self.solid(n, which)?.errors[0][quantity]));
        self.form.facets.iter().filter_map(of).collect()
    }
}

/// Measures; `report` receives the fraction done and the current job.
pub fn measure(form: SolidsPlan, report: &mut dyn FnMut(f64, &str)) -> Result<SolidsResults> {
    let solids = SMOOTHINGS
        .iter()
        .flat_map(|&smoothing| form.facets.iter().map(move |&facets| Teeth(Some(Solid { facets, smoothing }))));
    let all: Vec<Teeth> = [Teeth(None)].into_iter().chain(solids).collect();
    let mut records: Vec<[TeethRecord; 2]> = Vec::new();
    let mut ready: Vec<Simulation> = Vec::new();
    for (i, teeth) in all.iter().enumerate() {
        report(0.5 * i as f64 / all.len() as f64, &teeth.name());
        records.push([teeth.record(TIGHT, form.window, true)?, teeth.record(USUAL, form.window, false)?]);
        ready.push(teeth.start(USUAL)?);
    }
    let end = run::steps(form.window.end);
    let mut jobs: Vec<TimedJob> = ready
        .iter()
        .map(|simulation| TimedJob {
            run: Box::new(move || {
                let mut simulation = simulation.clone();
                for k in 1..=end {
                    // it has run to its end before
                    let _ = simulation.advance(f64::from(k) * STEP);
                }
            }),
            first: 0.1,
        })
        .collect();
    let times = measure::time(&mut jobs, form.runs, &mut |done| report(0.5 + 0.5 * done, "times"));
    drop(jobs);
    let willis = willis(ready.first());
    let exact = records[0][0].points.clone();
    let at_points: Vec<TeethPoint> = exact.iter().filter(|p| p.communicates).copied().collect();
    let close = form.window.close;
    let rows = all
        .iter()
        .zip(records)
        .zip(times)
        .map(|((&teeth, [tight, usual]), seconds)| TeethResult {
            teeth,
            errors: [
                errors::errors(&tight.points, &exact, close, willis),
                errors::errors(&usual.points, &at_points, close, willis),
            ],
            look: errors::look(&tight.points, close),
            path_ripple: errors::path_ripple(&tight.points, &exact, close, willis),
            seconds,
            statistics: usual.statistics,
            close: tight.points.into_iter().filter(|p| p.time > close).collect(),
        })
        .collect();
    let (arcs, overlap) = ready.first().map_or((Vec::new(), f64::NAN), |s| (arcs(s, form.facets), overlap(s)));
    Ok(SolidsResults { rows, form, arcs, overlap })
}

/// Speeds of the side gears by Willis' equation [deg/s].
fn willis(simulation: Option<&Simulation>) -> [f64; 2] {
    let ratio = simulation.map_or(f64::NAN, |s| {
        let [planet, side] = &s.pair().gears;
        f64::from(planet.teeth) / f64::from(side.teeth)
    });
    [1.0, -1.0].map(|sign| published::CARRIER_SPEED[1] + sign * ratio * published::PLANET_SPIN)
}

fn arcs(simulation: &Simulation, facets: &[i32]) -> Vec<f64> {
    let pair = simulation.pair();
    let fillet = Teeth(None).parameters(USUAL).geometry.root_fillet * pair.module / pair.outer_cone;
    let height = |&n: &i32| {
        let flanks = Flanks::new(pair, fillet, usize::try_from(n).unwrap_or(1));
        pair.mean_cone * (flanks.sagitta[0] + flanks.sagitta[1])
    };
    facets.iter().map(height).collect()
}

/// d of K d^e = F for a pair that carries alone what a mesh has.
fn overlap(simulation: &Simulation) -> f64 {
    let (pair, p) = (simulation.pair(), Teeth(None).parameters(USUAL));
    let planets = f64::from(p.geometry.planet_count);
    let force = published::LOAD / (planets * pair.mean_cone * pair.sin_base()[1]);
    (force / p.contact.stiffness).powf(1.0 / p.contact.exponent)
}
