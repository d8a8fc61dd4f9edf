//! The study's turn with teeth of one kind, recorded.

use anyhow::{Result, anyhow};
use bevel_differential::integrate::Statistics;
use bevel_differential::model::{GearContact, Parameters, PlanetSpin, Simulation};
use bevel_differential::problem;

use crate::measure::cost::cases;

/// Communication step [s].
pub const STEP: f64 = 1e-3;
/// Records between communication points where one mesh cycle is looked at closely.
const CLOSE: u32 = 10;

/// Teeth: `None` for pairs on the path of contact, or solids.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Teeth(pub Option<Solid>);

/// Solid teeth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Solid {
    /// Facets per flank.
    pub facets: i32,
    /// `solid.smoothing`.
    pub smoothing: f64,
}

/// When a run settles, when it is looked at closely and when it ends [s].
#[derive(Clone, Copy, Debug)]
pub struct Window {
    /// From here on results count.
    pub settled: f64,
    /// From here on they are recorded closely.
    pub close: f64,
    /// End.
    pub end: f64,
}

/// A line of a record. Two values are of the left and the right side gear.
#[derive(Clone, Copy, Debug, Default)]
pub struct TeethPoint {
    /// Time [s].
    pub time: f64,
    /// Whether the host communicates here every [`STEP`].
    pub communicates: bool,
    /// Speeds [deg/s].
    pub speed: [f64; 2],
    /// Normal forces of all planets [N].
    pub force: [f64; 2],
    /// T/r_p of all planets [N].
    pub tangential: [f64; 2],
    /// Transmission errors [m].
    pub error: [f64; 2],
    /// Loaded pairs of a mesh.
    pub pairs: [f64; 2],
}

/// A record and what it took.
#[derive(Clone, Debug)]
pub struct TeethRecord {
    /// All times from the settled state on.
    pub points: Vec<TeethPoint>,
    /// Steps and evaluations of the whole run.
    pub statistics: Statistics,
}

impl Teeth {
    /// Parameters of the study's turn with these teeth.
    pub fn parameters(self, tolerance: f64) -> Parameters {
        let mut p = Parameters::default();
        p.scene.planet_spin = PlanetSpin::Imposed;
        p.solver.relative_tolerance = tolerance;
        match self.0 {
            None => p.scene.gear_contact = GearContact::Tooth,
            Some(solid) => {
                p.scene.gear_contact = GearContact::Solid;
                p.solid.facets = solid.facets;
                p.solid.smoothing = solid.smoothing;
            }
        }
        p
    }

    /// Their name.
    pub fn name(self) -> String {
        match self.0 {
            None => "tooth".into(),
            Some(solid) => format!("solid, {} facets, smoothing {}", solid.facets, solid.smoothing),
        }
    }

    /// Ready to run.
    pub fn start(self, tolerance: f64) -> Result<Simulation> {
        Simulation::start(&self.parameters(tolerance), &cases::turn().1, 0.0)
            .map_err(|found| anyhow!("{}: {}", self.name(), problem::list(&found)))
    }

    /// Runs through `window`, with close records if `close`.
    pub fn record(self, tolerance: f64, window: Window, close: bool) -> Result<TeethRecord> {
        let mut simulation = self.start(tolerance)?;
        let mut points = Vec::new();
        for k in 1..=steps(window.end) {
            let from = f64::from(k - 1) * STEP;
            let parts = if close && from >= window.close - 0.5 * STEP { CLOSE } else { 1 };
            for part in 1..=parts {
                let time = from + STEP * f64::from(part) / f64::from(parts);
                simulation.advance(time).map_err(|failure| anyhow!("{}: {failure}", self.name()))?;
                if time > window.settled + 0.5 * STEP / f64::from(CLOSE) {
                    points.push(TeethPoint { communicates: part == parts, ..TeethPoint::of(&mut simulation) });
                }
            }
        }
        Ok(TeethRecord { points, statistics: simulation.state().statistics })
    }
}

/// Communication steps until `end`.
pub fn steps(end: f64) -> u32 {
    (end / STEP).round() as u32
}

impl TeethPoint {
    /// That of the present.
    fn of(simulation: &mut Simulation) -> Self {
        let (time, speed) = (simulation.time(), simulation.motion().side_speed.map(f64::to_degrees));
        let forces = simulation.forces();
        let mesh = forces.mesh[0];
        Self {
            time,
            communicates: false,
            speed,
            force: forces.side_normal,
            tangential: forces.side_tangential,
            error: mesh.map(|mesh| mesh.transmission_error),
            pairs: mesh.map(|mesh| mesh.pairs),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_record_has_its_times() {
        let window = Window { settled: 0.002, close: 0.004, end: 0.005 };
        let record = Teeth(None).record(1e-6, window, true).expect("runs");
        let times: Vec<f64> = record.points.iter().map(|p| (p.time * 1e4).round()).collect();
        assert_eq!(times, [30.0, 40.0, 41.0, 42.0, 43.0, 44.0, 45.0, 46.0, 47.0, 48.0, 49.0, 50.0]);
        assert_eq!(record.points.iter().filter(|p| p.communicates).count(), 3);
    }
}
