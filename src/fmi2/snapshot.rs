//! The FMU state: an owned copy of all that changes, and its form as bytes.
//!
//! Bytes, little-endian: magic (8), format version (u32), hash of the interface's GUID (u64), length of the payload (u64),
//! payload (postcard), FNV-1a checksum of all before (u64).

use serde::{Deserialize, Serialize};

use super::calls::Phase;
use crate::model::{Inputs, Parameters, Simulation, State};
use crate::problem::{self, Problem};
use crate::variables::{Access, check_ranges, check_value, fnv1a, guid, table};

const MAGIC: [u8; 8] = *b"BEVELDIF";
/// Grows whenever the payload changes its meaning or layout.
const VERSION: u32 = 4;
const HEADER: usize = MAGIC.len() + size_of::<u32>() + 2 * size_of::<u64>();

/// What an instance is at an instant. Cloning copies the state and shares the constants.
#[derive(Clone, Debug)]
pub struct Snapshot {
    /// State as FMI counts states.
    pub phase: Phase,
    /// Parameters as set so far.
    pub parameters: Parameters,
    /// Inputs as set so far.
    pub inputs: Inputs,
    /// Start time [s].
    pub start_time: f64,
    /// Stop time [s], if the host gave one.
    pub stop_time: Option<f64>,
    /// Whether the host set the solver's tolerance itself.
    pub tolerance_chosen: bool,
    /// The simulation; none before initialisation, or when something was set since it was built.
    pub simulation: Option<Simulation>,
}

impl Default for Snapshot {
    fn default() -> Self {
        Self {
            phase: Phase::Instantiated,
            parameters: Parameters::default(),
            inputs: Inputs::default(),
            start_time: 0.0,
            stop_time: None,
            tolerance_chosen: false,
            simulation: None,
        }
    }
}

/// What is written of a snapshot: all but what follows from the parameters.
#[derive(Serialize, Deserialize)]
struct Payload {
    phase: Phase,
    parameters: Parameters,
    inputs: Inputs,
    start_time: f64,
    stop_time: Option<f64>,
    tolerance_chosen: bool,
    state: Option<State>,
}

impl Snapshot {
    /// Starts a simulation from the parameters and inputs; otherwise tells everything that is wrong with them.
    pub fn start(&self) -> Result<Simulation, Vec<Problem>> {
        let problems = check_ranges(&self.parameters);
        if !problems.is_empty() {
            return Err(problems);
        }
        Simulation::start(&self.parameters, &self.inputs, self.start_time)
    }

    /// The snapshot as bytes.
    pub fn to_bytes(&self) -> Result<Vec<u8>, String> {
        let payload = postcard::to_allocvec(&Payload {
            phase: self.phase,
            parameters: self.parameters,
            inputs: self.inputs,
            start_time: self.start_time,
            stop_time: self.stop_time,
            tolerance_chosen: self.tolerance_chosen,
            state: self.simulation.as_ref().map(|s| *s.state()),
        })
        .map_err(|e| format!("the state cannot be serialised: {e}"))?;
        let mut bytes = Vec::with_capacity(HEADER + payload.len() + size_of::<u64>());
        bytes.extend(MAGIC);
        bytes.extend(VERSION.to_le_bytes());
        bytes.extend(fnv1a(guid().bytes()).to_le_bytes());
        bytes.extend((payload.len() as u64).to_le_bytes());
        bytes.extend(payload);
        bytes.extend(fnv1a(bytes.iter().copied()).to_le_bytes());
        Ok(bytes)
    }

    /// The snapshot that `bytes` hold, or why they cannot be used.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, String> {
        let payload = open(bytes)?;
        let (payload, rest) =
            postcard::take_from_bytes::<Payload>(payload).map_err(|e| format!("the state cannot be read: {e}"))?;
        if !rest.is_empty() {
            return Err(format!("the state has {} bytes too many", rest.len()));
        }
        payload.check()?;
        let Payload { phase, parameters, inputs, start_time, stop_time, tolerance_chosen, state } = payload;
        let resume = |state| Simulation::resume(&parameters, &inputs, state).map_err(|p| problem::list(&p));
        let simulation = state.map(resume).transpose()?;
        Ok(Self { phase, parameters, inputs, start_time, stop_time, tolerance_chosen, simulation })
    }
}

impl Payload {
    /// A checksum does not tell whether values make sense.
    fn check(&self) -> Result<(), String> {
        let needs_state = !matches!(self.phase, Phase::Instantiated | Phase::Initialization | Phase::Error);
        if needs_state && self.state.is_none() {
            return Err(format!("the state of a simulation is missing in the phase \"{}\"", self.phase.name()));
        }
        if !self.start_time.is_finite() || self.state.is_some_and(|s| !s.is_valid()) {
            return Err("the state has values that are not finite".into());
        }
        let mut inputs = self.inputs;
        for row in &table().rows {
            if let Access::Input(slot) = row.access {
                check_value(row, *slot(&mut inputs)).map_err(|p| p.to_string())?;
            }
        }
        let problems = if self.state.is_some() { check_ranges(&self.parameters) } else { Vec::new() };
        if problems.is_empty() { Ok(()) } else { Err(problem::list(&problems)) }
    }
}

/// Checks everything around the payload and returns it.
fn open(bytes: &[u8]) -> Result<&[u8], String> {
    let truncated = || format!("the serialised state is truncated at {} bytes", bytes.len());
    let mut rest = bytes;
    if *take::<8>(&mut rest).ok_or_else(truncated)? != MAGIC {
        return Err("these bytes are no serialised state of this FMU".into());
    }
    let version = u32::from_le_bytes(*take(&mut rest).ok_or_else(truncated)?);
    if version != VERSION {
        return Err(format!("the serialised state has format {version}, this FMU reads format {VERSION}"));
    }
    if u64::from_le_bytes(*take(&mut rest).ok_or_else(truncated)?) != fnv1a(guid().bytes()) {
        return Err(format!("the serialised state belongs to another version of this FMU than {}", guid()));
    }
    let length = u64::from_le_bytes(*take(&mut rest).ok_or_else(truncated)?);
    let (payload, rest) = usize::try_from(length).ok().and_then(|n| rest.split_at_checked(n)).ok_or_else(truncated)?;
    let (sum, surplus) = rest.split_first_chunk().ok_or_else(truncated)?;
    if !surplus.is_empty() {
        return Err(format!("the serialised state is followed by {} bytes that do not belong to it", surplus.len()));
    }
    if u64::from_le_bytes(*sum) != fnv1a(bytes[..HEADER + payload.len()].iter().copied()) {
        return Err("the serialised state is damaged: its checksum does not fit".into());
    }
    Ok(payload)
}

fn take<'a, const N: usize>(rest: &mut &'a [u8]) -> Option<&'a [u8; N]> {
    let (head, tail) = rest.split_first_chunk()?;
    *rest = tail;
    Some(head)
}
