//! What to simulate for the study, and what comes out.

use bevel_differential::model::{Inputs, Parameters, PlanetSpin, Start};
use serde::Deserialize;
use serde_json::{Value, json};

use crate::study::stated;
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

/// What to simulate for the study: its two cases, from rolling, unloaded teeth.
pub fn request(theory: &Theory) -> Value {
    // what to set, each with its unit, empty for that of the interface; and theory for the figures
    let case = |i: usize, spin: f64| {
        let carrier = stated::CARRIER_SPEED[i];
        json!({
            "start_values": {
                "scene.start": [f64::from(Start::Rolling as i32), ""],
                "carrier.speed_command": [carrier, "deg/s"],
                "left.load_torque": [stated::LOAD, ""],
                "right.load_torque": [stated::LOAD, ""],
            },
            // [km/h]
            "vehicle_speed": stated::VEHICLE_SPEED[i],
            // [deg/s]
            "carrier_speed": carrier,
            // of left and right side gear [deg/s]
            "side_speeds": theory.side_speeds(carrier, spin),
            // at the outer pitch circle [N]
            "tangential_force": theory.outer_tangential_force(stated::LOAD),
            // of one mesh [N]
            "normal_force": theory.normal_force(stated::LOAD),
            // [Hz]
            "mesh_frequency": theory.mesh_frequency(spin),
        })
    };
    let (straight, mut turning) = (case(0, 0.0), case(1, stated::PLANET_SPIN));
    turning["start_values"]["scene.planet_spin"] = json!([f64::from(PlanetSpin::Imposed as i32), ""]);
    turning["start_values"]["spin.command"] = json!([stated::PLANET_SPIN, "deg/s"]);
    json!({
        // length of the records for the spectra, of the study's own record, and its output interval [s]
        "record": RECORD,
        "duration": stated::DURATION,
        "interval": stated::INTERVAL,
        // length of the records of the starts, and their output interval [s]
        "start_record": START_RECORD,
        "start_interval": START_INTERVAL,
        // length of the window of the spectra [s]
        "spectrum_window": SPECTRUM_PERIODS / theory.mesh_frequency(stated::PLANET_SPIN),
        // speeds within this fraction of theory count as settled
        "settled_band": SETTLED_BAND,
        // meshing frequency that the study claims for driving straight ahead [Hz]
        "claimed_frequency": stated::MESH_FREQUENCY,
        // ripple of the speeds that the study shows, either way [%]
        "claimed_ripple": stated::RIPPLE,
        // on each half-shaft [N·m]
        "load": stated::LOAD,
        "planet_teeth": Parameters::default().geometry.planet_teeth,
        "straight": straight,
        "turning": turning,
    })
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
