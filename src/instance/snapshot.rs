//! FMU state: an owned copy of all data that changes, and its serialised form.
//!
//! Serialised form, little-endian: magic (8 bytes), format version (u32), hash of the interface's GUID (u64), length of
//! the payload (u64), payload (postcard), and FNV-1a checksum of everything before it (u64).

use serde::{Deserialize, Serialize};

use super::instance::tolerance_row;
use super::{CallError, CallResult, Discrete, Experiment, Interface, Kind, Phase};
use crate::model::{Accepted, GearCache, Given, InputDerivatives, Inputs, Memories, Parameters, Simulation, State};
use crate::numeric::Finite;
use crate::problem::{self, Problem};
use crate::variables::unset::SetValues;
use crate::variables::{Access, Range, check_ranges, check_value, fnv1a, guid, table};

const MAGIC: [u8; 8] = *b"BEVELDIF";
/// Format version, incremented whenever the payload changes in meaning or layout.
const VERSION: u32 = 2;
const HEADER: usize = MAGIC.len() + size_of::<u32>() + 2 * size_of::<u64>();

/// Data of an instance that change. Cloning copies the state and shares the constants.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Snapshot {
    /// Major version of FMI with which the instance was created.
    pub version: u32,
    /// Model exchange or co-simulation.
    pub kind: Kind,
    /// State of FMI's state machine.
    pub phase: Phase,
    /// Parameters as set so far.
    pub parameters: Parameters,
    /// Inputs as set so far.
    pub inputs: Inputs,
    /// Derivatives of the inputs, if the host set any.
    pub input_derivatives: Option<InputDerivatives>,
    /// Inputs whose derivatives were set since the last step, as a bit mask.
    pub derivatives_set: u32,
    /// Start time [s].
    pub start_time: f64,
    /// Stop time [s], if the host gave one.
    pub stop_time: Option<f64>,
    /// Published values of the outputs that change only at events, if the host handles events.
    pub discrete: Option<Discrete>,
    /// True if the host set the solver's tolerance as a parameter.
    pub tolerance_chosen: bool,
    /// Variables that the host has set.
    pub set: SetValues,
    /// The simulation; `None` before initialisation, or if a value was set since it was built.
    #[serde(skip)] // rebuilt from the parameters and `Running`
    pub simulation: Option<Simulation>,
}

impl Snapshot {
    /// Creates the snapshot of a new instance.
    pub fn new(interface: &Interface, kind: Kind) -> Self {
        Self {
            version: interface.version,
            kind,
            phase: Phase::Instantiated,
            parameters: Parameters::default(),
            inputs: Inputs::default(),
            input_derivatives: None,
            derivatives_set: 0,
            start_time: 0.0,
            stop_time: None,
            discrete: None,
            tolerance_chosen: false,
            set: SetValues::default(),
            simulation: None,
        }
    }
}

/// Data of a simulation that are serialised after its snapshot: everything that does not follow from the parameters.
/// The data are boxed, because they are large for a small stack. The inputs are those of the simulation, which may
/// differ from the host's values.
type Running = (Option<Box<((State, Memories), Inputs)>>, Option<Box<Accepted>>);

impl Snapshot {
    /// Starts a simulation from these parameters and inputs. Fails with every problem found.
    pub fn start_from(
        &self,
        parameters: &Parameters,
        inputs: &Inputs,
        cache: &GearCache,
    ) -> Result<Simulation, Vec<Problem>> {
        let problems = check_ranges(parameters);
        if !problems.is_empty() {
            return Err(problems);
        }
        Simulation::start_with(&self.effective(parameters), inputs, self.start_time, &given(cache))
    }

    /// Adopts the stop time and the tolerance of `experiment`, if they are given. A tolerance that was set as a
    /// parameter stays.
    pub fn follow(&mut self, experiment: &Experiment, cache: &GearCache) -> CallResult {
        self.stop_time = experiment.stop.or(self.stop_time);
        let (Some(requested), false, Some((row, slot))) =
            (experiment.tolerance, self.tolerance_chosen, tolerance_row())
        else {
            return Ok(());
        };
        let Range { min, max } = row.range.unwrap_or(Range { min: requested, max: requested });
        let (tolerance, requested) = (slot(&mut self.parameters), requested.clamp(min, max));
        if *tolerance != requested {
            *tolerance = requested;
            self.rebuild(cache).map_err(CallError::error)?;
        }
        Ok(())
    }

    /// Rebuilds the simulation with the present parameters. A running simulation continues; any other one starts again
    /// on demand.
    #[cold]
    #[inline(never)] // its frame is large for a small stack
    fn rebuild(&mut self, cache: &GearCache) -> Result<(), String> {
        let running = self.simulation.as_ref().filter(|_| self.phase != Phase::Initialization);
        let state = running.map(|s| Box::new(((*s.state(), s.memories().clone()), *s.inputs())));
        let accepted = running.and_then(Simulation::accepted).map(|accepted| Box::new(*accepted));
        self.simulation = None;
        self.resume((state, accepted), cache)
    }

    /// Continues a `running` simulation, if there is one, with the present parameters.
    fn resume(&mut self, running: Running, cache: &GearCache) -> Result<(), String> {
        if let (Some(running), accepted) = running {
            let ((state, memories), inputs) = *running;
            let parameters = self.effective(&self.parameters);
            let resumed = Simulation::resume_with(&parameters, &inputs, (state, Some(memories)), &given(cache));
            let mut resumed = resumed.map_err(|p| problem::list(&p))?;
            // steps with input ramps pass the derivatives themselves
            if self.kind == Kind::CoSimulation && !resumed.ramps_inputs() {
                resumed.set_input_derivatives(self.input_derivatives);
            }
            self.simulation = Some(resumed.from_accepted(accepted.map(|accepted| *accepted)));
        }
        Ok(())
    }

    /// Returns the `parameters` of the simulation. In model exchange, every planet has its own states. The host
    /// computes the motion between completed steps, so mesh history, advice about the step and input ramps are off.
    fn effective(&self, parameters: &Parameters) -> Parameters {
        let mut parameters = *parameters;
        let own_steps = self.kind == Kind::CoSimulation;
        parameters.solver.merge_planets &= own_steps;
        if !own_steps {
            parameters.effects = parameters.effects.without_own_steps();
        }
        parameters.solver.input_ramp &= own_steps;
        parameters
    }

    /// Serialises the snapshot.
    pub fn to_bytes(&self) -> Result<Vec<u8>, String> {
        // same layout as `Running`
        let simulation = self.simulation.as_ref();
        let running =
            (simulation.map(|s| ((s.state(), s.memories()), s.inputs())), simulation.and_then(Simulation::accepted));
        let payload =
            postcard::to_allocvec(&(self, running)).map_err(|e| format!("the state cannot be serialised: {e}"))?;
        let mut bytes = Vec::with_capacity(HEADER + payload.len() + size_of::<u64>());
        bytes.extend(MAGIC);
        bytes.extend(VERSION.to_le_bytes());
        bytes.extend(fnv1a(guid().bytes()).to_le_bytes());
        bytes.extend((payload.len() as u64).to_le_bytes());
        bytes.extend(payload);
        bytes.extend(fnv1a(bytes.iter().copied()).to_le_bytes());
        Ok(bytes)
    }

    /// Reads a snapshot from `bytes`. Fails with the reason if they cannot be used.
    pub fn from_bytes(bytes: &[u8], cache: &GearCache) -> Result<Self, String> {
        let (mut snapshot, running) = Self::read(open(bytes)?)?;
        snapshot.check(&running)?;
        snapshot.resume(running, cache)?;
        Ok(*snapshot)
    }

    /// Reads a payload.
    #[inline(never)]
    fn read(payload: &[u8]) -> Result<(Box<Self>, Running), String> {
        let read = postcard::take_from_bytes(payload);
        let (content, rest) = read.map_err(|e| format!("the state cannot be read: {e}"))?;
        if rest.is_empty() { Ok(content) } else { Err(format!("the state has {} bytes too many", rest.len())) }
    }

    /// Checks that all values are valid, which the checksum cannot show.
    fn check(&self, (state, accepted): &Running) -> Result<(), String> {
        let Self {
            version,
            kind,
            phase,
            parameters,
            inputs,
            input_derivatives,
            derivatives_set: _,
            start_time,
            stop_time,
            discrete,
            tolerance_chosen: _,
            set: _,
            simulation: _,
        } = self;
        let needs_state =
            !matches!(phase, Phase::Instantiated | Phase::Configuration | Phase::Initialization | Phase::Error);
        if needs_state && state.is_none() {
            return Err(format!("the state of the simulation is missing in the FMI state \"{}\"", phase.name()));
        }
        if !start_time.is_finite()
            || stop_time.is_some_and(|stop| stop.is_nan() || stop < *start_time)
            || state.as_ref().is_some_and(|both| !both.0.0.is_valid() || !both.0.1.is_valid())
            || !(accepted.as_deref().is_none_or(Finite::is_finite)
                && input_derivatives.is_finite()
                && discrete.is_finite())
        {
            return Err("the state has values that are not finite or out of range".into());
        }
        if accepted.is_some() && *kind != Kind::ModelExchange {
            return Err("a step completed by the host's solver does not belong to an instance for co-simulation".into());
        }
        let steps = matches!(phase, Phase::StepComplete | Phase::StepFailed | Phase::IntermediateUpdate);
        let events_of_steps = *phase == Phase::Event && *kind == Kind::CoSimulation && *version > 2;
        let exchanges = matches!(phase, Phase::Event | Phase::ContinuousTime) && !events_of_steps;
        if exchanges && (*kind != Kind::ModelExchange || accepted.is_none()) || steps && *kind != Kind::CoSimulation {
            return Err(format!("the state \"{}\" does not belong to this kind of instance", phase.name()));
        }
        for mut inputs in [Some(*inputs), state.as_deref().map(|running| running.1)].into_iter().flatten() {
            for row in table().rows {
                if let Access::Input(slot) = row.access {
                    check_value(row, *slot(&mut inputs)).map_err(|p| p.to_string())?;
                }
            }
        }
        let problems = if state.is_some() { check_ranges(parameters) } else { Vec::new() };
        if problems.is_empty() { Ok(()) } else { Err(problem::list(&problems)) }
    }
}

fn given(cache: &GearCache) -> Given<'_> {
    Given { cache: Some(cache), ..Given::default() }
}

/// Checks header and checksum, and returns the payload.
fn open(bytes: &[u8]) -> Result<&[u8], String> {
    let truncated = || format!("the serialised state is truncated at {} bytes", bytes.len());
    let mut rest = bytes;
    if *take::<8>(&mut rest).ok_or_else(truncated)? != MAGIC {
        return Err("these bytes are not a serialised state of this FMU".into());
    }
    let version = u32::from_le_bytes(*take(&mut rest).ok_or_else(truncated)?);
    if version != VERSION {
        return Err(format!("the serialised state has format {version}, but this FMU reads format {VERSION}"));
    }
    if u64::from_le_bytes(*take(&mut rest).ok_or_else(truncated)?) != fnv1a(guid().bytes()) {
        return Err(format!("the serialised state belongs to another version of this FMU than {}", guid()));
    }
    let length = u64::from_le_bytes(*take(&mut rest).ok_or_else(truncated)?);
    let (payload, rest) = usize::try_from(length).ok().and_then(|n| rest.split_at_checked(n)).ok_or_else(truncated)?;
    let (sum, surplus) = rest.split_first_chunk().ok_or_else(truncated)?;
    if !surplus.is_empty() {
        return Err(format!("the serialised state is followed by {} surplus bytes", surplus.len()));
    }
    if u64::from_le_bytes(*sum) != fnv1a(bytes[..HEADER + payload.len()].iter().copied()) {
        return Err("the serialised state is damaged: its checksum is wrong".into());
    }
    Ok(payload)
}

fn take<'a, const N: usize>(rest: &mut &'a [u8]) -> Option<&'a [u8; N]> {
    let (head, tail) = rest.split_first_chunk()?;
    *rest = tail;
    Some(head)
}
