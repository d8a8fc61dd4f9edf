//! What to simulate for the study, and what comes out.

use std::collections::BTreeMap;

use bevel_differential::model::{Inputs, Parameters, PlanetSpin, Start};
use serde::{Deserialize, Serialize};

use crate::study::published;
use crate::study::theory::Theory;

/// Length of the record for the spectrum [s]; its window is the end of it, a whole number of mesh periods.
const RECORD: f64 = 2.0;
/// Mesh periods in the window of the spectrum.
const SPECTRUM_PERIODS: f64 = 10.0;

/// Length of the record of the start [s]: the teeth meet and settle within it.
const START_RECORD: f64 = 1e-3;
/// Output interval of the record of the start [s]: fine enough for the teeth's own motion at some 10 kHz.
const START_INTERVAL: f64 = 1e-6;

/// After the start, speeds within this fraction of theory count as settled.
pub const SETTLED_BAND: f64 = 0.01;

/// Start value and its unit, empty for the unit of the interface.
type StartValue = (f64, &'static str);

/// What to simulate.
#[derive(Serialize)]
pub struct SimulationRequest {
    /// Length of the records for the spectra [s].
    record: f64,
    /// Length of the study's own record [s].
    duration: f64,
    /// Output interval [s].
    interval: f64,
    /// Length of the records of the starts [s], and their output interval [s].
    start_record: f64,
    start_interval: f64,
    /// Length of the window of the spectra [s].
    spectrum_window: f64,
    /// Speeds within this fraction of theory count as settled.
    settled_band: f64,
    /// Meshing frequency that the study claims for driving straight ahead [Hz].
    claimed_frequency: f64,
    /// Ripple of the speeds that the study shows, either way [%].
    claimed_ripple: f64,
    /// Load on each half-shaft [N·m].
    load: f64,
    /// Teeth of a planet.
    planet_teeth: i32,
    /// Both cases.
    straight: CaseRequest,
    turning: CaseRequest,
}

/// One case: what to set, and theory for the figures.
#[derive(Serialize)]
struct CaseRequest {
    start_values: BTreeMap<&'static str, StartValue>,
    /// Vehicle speed [km/h].
    vehicle_speed: f64,
    /// Carrier speed [deg/s].
    carrier_speed: f64,
    /// Speeds of left and right side gear [deg/s].
    side_speeds: [f64; 2],
    /// Tangential force at the outer pitch circle [N].
    tangential_force: f64,
    /// Normal force of one mesh [N].
    normal_force: f64,
    /// Meshing frequency [Hz].
    mesh_frequency: f64,
}

impl SimulationRequest {
    /// The study's two cases, from rolling, unloaded teeth.
    pub fn new(theory: &Theory) -> Self {
        let rolling = ("scene.start", (f64::from(Start::Rolling as i32), ""));
        let case = |vehicle_speed: f64, carrier: f64, spin: f64, extra: &[(&'static str, StartValue)]| {
            let loads = ["left.load_torque", "right.load_torque"].map(|name| (name, (published::LOAD, "")));
            let mut start_values = BTreeMap::from([rolling, ("carrier.speed_command", (carrier, "deg/s"))]);
            start_values.extend(loads);
            start_values.extend(extra.iter().copied());
            CaseRequest {
                start_values,
                vehicle_speed,
                carrier_speed: carrier,
                side_speeds: theory.side_speeds(carrier, spin),
                tangential_force: theory.outer_tangential_force(published::LOAD),
                normal_force: theory.normal_force(published::LOAD),
                mesh_frequency: theory.mesh_frequency(spin),
            }
        };
        let turn = [
            ("scene.planet_spin", (f64::from(PlanetSpin::Imposed as i32), "")),
            ("planet.spin_command", (published::PLANET_SPIN, "deg/s")),
        ];
        Self {
            record: RECORD,
            duration: published::DURATION,
            interval: published::INTERVAL,
            start_record: START_RECORD,
            start_interval: START_INTERVAL,
            spectrum_window: SPECTRUM_PERIODS / theory.mesh_frequency(published::PLANET_SPIN),
            settled_band: SETTLED_BAND,
            claimed_frequency: published::MESH_FREQUENCY,
            claimed_ripple: published::RIPPLE,
            load: published::LOAD,
            planet_teeth: Parameters::default().geometry.planet_teeth,
            straight: case(published::VEHICLE_SPEED[0], published::CARRIER_SPEED[0], 0.0, &[]),
            turning: case(published::VEHICLE_SPEED[1], published::CARRIER_SPEED[1], published::PLANET_SPIN, &turn),
        }
    }
}

/// Default inputs of the FMU: carrier speed [deg/s], load [N·m], stiffness [N/mm^1.5].
pub fn defaults() -> [f64; 3] {
    let (parameters, inputs) = (Parameters::default(), Inputs::default());
    [inputs.carrier_speed.to_degrees(), inputs.load_torque[0], parameters.contact.stiffness / 1e3f64.powf(1.5)]
}

/// What came out.
#[derive(Clone, Debug, Deserialize)]
pub struct Results {
    /// Straight ahead.
    pub straight: CaseResults,
    /// In the turn.
    pub turning: CaseResults,
}

/// Results of one case; means over the settled part of the study's own record.
#[derive(Clone, Debug, Deserialize)]
pub struct CaseResults {
    /// Mean speeds of left and right side gear [deg/s].
    pub side_speeds: [f64; 2],
    /// Peak-to-peak ripple of them over their means [%].
    pub ripple: [f64; 2],
    /// Mean carrier speed [deg/s].
    pub carrier_speed: f64,
    /// Mean normal force of one mesh of each side [N].
    pub normal_force: [f64; 2],
    /// Mean tangential force at the outer pitch circle, left and right [N].
    pub tangential_force: [f64; 2],
    /// Largest tangential force at the outer pitch circle when the teeth meet at the start [N], and when [s].
    pub peak_tangential_force: f64,
    /// When the teeth meet [s].
    pub peak_time: f64,
    /// Mean of the FMU's mesh frequency [Hz].
    pub mesh_frequency: f64,
    /// First line of the spectrum of the mesh forces [Hz]; none where no line stands out.
    pub first_line: Option<f64>,
    /// Time after which both speeds are within [`SETTLED_BAND`] of theory [s].
    pub settled_after: f64,
    /// Steps of the integrator in the study's own record.
    pub steps: f64,
    /// Energy residual over the energy that went through [-].
    pub relative_energy_residual: f64,
    /// Seconds of computing for one simulated second, the whole record.
    pub seconds_per_second: f64,
}
