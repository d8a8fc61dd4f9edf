//! The runs that solvers are compared on, and the start of each.

use bevel_differential::contact::ContactLaw;
use bevel_differential::integrate::{Control, Statistics};
use bevel_differential::model::{CarrierDrive, GearContact, Inputs, Method, Parameters, PlanetSpin, Simulation, Start};

/// First step tried by this program's methods, as after any start [s].
const FIRST_STEP: f64 = 1e-6;
/// When the clunk's torque comes [s]; until then the coast flanks lie against each other.
const BLOW: f64 = 1e-5;
/// The clunk's stretch before the blow is a start like any other: integrated as closely as can be.
const CLOSELY: f64 = 1e-11;
/// Natural magnitude of the gears' positions: how far loaded teeth come closer, as an angle of a gear [rad].
const APPROACH: f64 = 2e-3;
/// The same of a half-shaft's twist [rad], and of the carrier's angle [rad].
const TWIST: f64 = 1e-2;
const TURN: f64 = 1.0;
/// Index of the carrier among the degrees of freedom, and of the first end of a half-shaft in the clunk.
const CARRIER: usize = 2;
const ENDS: usize = 4;

/// A run: parameters, inputs, and when it starts.
pub struct Case {
    /// The simulation at its start.
    pub start: Simulation,
    /// Natural magnitudes of positions and velocities; solvers see each divided by its own.
    pub magnitudes: Vec<f64>,
}

/// The case called `name`, with teeth at `level`, for `method` at `tolerance` where this program's methods run it.
pub fn case(name: &str, level: &str, method: &str, tolerance: f64) -> Result<Case, String> {
    let (mut p, mut i) = (Parameters::default(), Inputs::default());
    match level {
        "lumped" => p.scene.gear_contact = GearContact::Lumped,
        "tooth_impact" => {}
        "tooth_line" => p.contact.law = ContactLaw::Line,
        _ => return Err(format!("there is no level {level}")),
    }
    p.solver.relative_tolerance = tolerance;
    p.solver.method = match method {
        "adaptive" => Method::Adaptive,
        "radau" => Method::Radau,
        "rodas4" => Method::Rodas4,
        "dormand_prince" => Method::DormandPrince,
        _ => return Err(format!("there is no method {method}")),
    };
    match name {
        "straight_rolling" => p.scene.start = Start::Rolling,
        "turn_rolling" | "turn_equilibrium" => {
            if name == "turn_rolling" {
                p.scene.start = Start::Rolling;
            }
            p.scene.planet_spin = PlanetSpin::Imposed;
            (i.carrier_speed, i.planet_spin) = (954f64.to_radians(), 200f64.to_radians());
        }
        "clunk" => return clunk(p),
        _ => return Err(format!("there is no case {name}")),
    }
    let start = started(&p, &i)?;
    let speed = 2.0 * i.carrier_speed + i.planet_spin;
    Ok(Case { magnitudes: magnitudes(&start, speed), start })
}

/// scenes/clunk.toml from the blow on.
fn clunk(mut p: Parameters) -> Result<Case, String> {
    p.scene.carrier_drive = CarrierDrive::Torque;
    p.geometry.backlash = 0.1885e-3;
    p.effects.half_shaft = true;
    p.specs.half_shaft.stiffness = [1e4; 2];
    p.specs.half_shaft.damping = [0.0; 2];
    p.inertia.from_geometry = false;
    (p.inertia.carrier, p.inertia.side_gear, p.inertia.planet) = (0.05, 1e-5, 1e-6);
    (p.inertia.left_end, p.inertia.right_end) = (0.5, 0.5);
    p.contact.damping = 0.0;
    let mut i = Inputs { carrier_speed: 0.0, carrier_torque: -0.002, load_torque: [-0.001; 2], ..Inputs::default() };
    let mut before = started(&Parameters { solver: closely(&p), ..p }, &i)?;
    before.advance(BLOW).map_err(|failure| failure.message)?;
    (i.carrier_torque, i.load_torque) = (100.0, [0.0; 2]);
    let mut state = *before.state();
    (state.control, state.statistics) = (Control::new(FIRST_STEP), Statistics::default());
    let start = Simulation::resume(&p, &i, state).map_err(|problems| bevel_differential::problem::list(&problems))?;
    // a blow of 100 N·m through the lash brings gears to some 10 rad/s
    Ok(Case { magnitudes: magnitudes(&start, 10.0), start })
}

fn closely(p: &Parameters) -> bevel_differential::model::SolverSpec {
    bevel_differential::model::SolverSpec { method: Method::Adaptive, relative_tolerance: CLOSELY, ..p.solver }
}

fn started(p: &Parameters, i: &Inputs) -> Result<Simulation, String> {
    Simulation::start(p, i, 0.0).map_err(|problems| bevel_differential::problem::list(&problems))
}

fn magnitudes(start: &Simulation, speed: f64) -> Vec<f64> {
    let n = start.freedoms();
    let position = (0..n).map(|i| match i {
        CARRIER => TURN,
        i if i >= ENDS && n > ENDS => TWIST,
        _ => APPROACH,
    });
    position.chain(std::iter::repeat_n(speed, n)).collect()
}
