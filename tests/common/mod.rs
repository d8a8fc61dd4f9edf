//! An FMI host for tests. It calls the C functions as a C program does, and records their log messages.
#![allow(dead_code)] // each test program uses only some items

pub mod counting_allocator;
pub mod random;
pub mod recorder;

use std::ffi::CString;
use std::ptr;

use bevel_differential::fmi2::*;
use bevel_differential::variables::{self, Access, table};
use libc::c_char;
use recorder::{Line, Recorder};

/// Value reference of a variable.
pub fn reference(name: &str) -> u32 {
    table().rows.iter().position(|row| row.name == name).unwrap_or_else(|| panic!("no variable {name}")) as u32
}

/// An instance with its log.
pub struct Host {
    pub c: ComponentPointer,
    recorder: Box<Recorder>,
}

impl Drop for Host {
    fn drop(&mut self) {
        // SAFETY: the component belongs to this host
        unsafe { fmi2FreeInstance(self.c) }
    }
}

impl Host {
    /// Creates an instance for co-simulation with logging on.
    pub fn new() -> Self {
        Self::with_logging(1)
    }

    /// Creates an instance for co-simulation with logging on (1) or off (0).
    pub fn with_logging(on: Boolean) -> Self {
        let host = Self::instantiate_with((Some("test"), CO_SIMULATION, Some(variables::guid()), None), on);
        assert!(!host.c.is_null(), "{:?}", host.log());
        host
    }

    /// Calls fmi2Instantiate with logging on and any arguments; `c` is NULL if the call is refused.
    pub fn instantiate(name: Option<&str>, kind: i32, guid: Option<&str>, resources: Option<&str>) -> Self {
        Self::instantiate_with((name, kind, guid, resources), 1)
    }

    fn instantiate_with(
        (name, kind, guid, resources): (Option<&str>, i32, Option<&str>, Option<&str>),
        logging: Boolean,
    ) -> Self {
        let recorder = Box::<Recorder>::default();
        let owned = |text: Option<&str>| text.map(|t| CString::new(t).unwrap());
        let pointer = |text: &Option<CString>| text.as_ref().map_or(ptr::null(), |t| t.as_ptr());
        let (name, guid, resources) = (owned(name), owned(guid), owned(resources));
        let (callbacks, [name, guid, resources]) = (recorder.callbacks(), [&name, &guid, &resources].map(pointer));
        // SAFETY: all pointers are NULL or valid during the call
        let c = unsafe { fmi2Instantiate(name, kind, guid, resources, &callbacks, 0, logging) };
        Self { c, recorder }
    }

    /// Creates an instance for model exchange.
    pub fn for_exchange() -> Self {
        let host = Self::instantiate(Some("test"), MODEL_EXCHANGE, Some(variables::guid()), None);
        assert!(!host.c.is_null(), "{:?}", host.log());
        host
    }

    /// Initialises the instance and enters continuous-time mode.
    pub fn start_exchange(&self) {
        self.start();
        self.update();
        // SAFETY: a live component
        assert_eq!(unsafe { fmi2EnterContinuousTimeMode(self.c) }, Status::Ok);
    }

    /// Calls fmi2NewDiscreteStates.
    pub fn update(&self) -> EventInfo {
        let mut info = EventInfo::default();
        // SAFETY: a live component and memory for the result
        assert_eq!(unsafe { fmi2NewDiscreteStates(self.c, &mut info) }, Status::Ok, "{:?}", self.log());
        info
    }

    /// Creates an instance with gear contact `level`: 1 ideal, 3 tooth. The wheels have inertia, so that loads may
    /// differ.
    pub fn on_level(level: i32) -> Self {
        let host = Self::new();
        assert_eq!(host.set_integer("scene.gear_contact", level), Status::Ok);
        assert_eq!(host.set("inertia.left_end", 0.5), Status::Ok);
        assert_eq!(host.set("inertia.right_end", 0.5), Status::Ok);
        host
    }

    pub fn setup(&self) -> Status {
        // SAFETY: a live component
        unsafe { fmi2SetupExperiment(self.c, 0, 0.0, 0.0, 0, 0.0) }
    }

    pub fn enter(&self) -> Status {
        // SAFETY: a live component
        unsafe { fmi2EnterInitializationMode(self.c) }
    }

    pub fn exit(&self) -> Status {
        // SAFETY: a live component
        unsafe { fmi2ExitInitializationMode(self.c) }
    }

    pub fn reset(&self) -> Status {
        // SAFETY: a live component
        unsafe { fmi2Reset(self.c) }
    }

    pub fn terminate(&self) -> Status {
        // SAFETY: a live component
        unsafe { fmi2Terminate(self.c) }
    }

    /// Initialises the instance and enters step mode.
    pub fn start(&self) {
        let statuses = [self.setup(), self.enter(), self.exit()];
        assert_eq!(statuses, [Status::Ok; 3], "{:?}", self.log());
    }

    pub fn step(&self, t: f64, h: f64) -> Status {
        // SAFETY: a live component
        unsafe { fmi2DoStep(self.c, t, h, 1) }
    }

    /// Takes `n` steps of size `h` from time `t`; all must succeed.
    pub fn steps(&self, t: f64, h: f64, n: usize) {
        for i in 0..n {
            assert_eq!(self.step(t + i as f64 * h, h), Status::Ok, "{:?}", self.log());
        }
    }

    pub fn set_many(&self, names: &[&str], values: &[f64]) -> Status {
        let references: Vec<u32> = names.iter().map(|n| reference(n)).collect();
        // SAFETY: a live component and arrays of that length
        unsafe { fmi2SetReal(self.c, references.as_ptr(), references.len(), values.as_ptr()) }
    }

    pub fn set(&self, name: &str, value: f64) -> Status {
        self.set_many(&[name], &[value])
    }

    pub fn set_integer(&self, name: &str, value: i32) -> Status {
        // SAFETY: a live component and one value
        unsafe { fmi2SetInteger(self.c, &reference(name), 1, &value) }
    }

    pub fn set_boolean(&self, name: &str, value: i32) -> Status {
        // SAFETY: a live component and one value
        unsafe { fmi2SetBoolean(self.c, &reference(name), 1, &value) }
    }

    pub fn try_get(&self, name: &str) -> (Status, f64) {
        let mut value = f64::NAN;
        // SAFETY: a live component and memory for one value
        let status = unsafe { fmi2GetReal(self.c, &reference(name), 1, &mut value) };
        (status, value)
    }

    pub fn get(&self, name: &str) -> f64 {
        let (status, value) = self.try_get(name);
        assert_eq!(status, Status::Ok, "{name}: {:?}", self.log());
        value
    }

    pub fn get_integer(&self, name: &str) -> i32 {
        let mut value = 0;
        // SAFETY: a live component and memory for one value
        assert_eq!(unsafe { fmi2GetInteger(self.c, &reference(name), 1, &mut value) }, Status::Ok);
        value
    }

    /// Returns all outputs as bits.
    pub fn outputs(&self) -> Vec<u64> {
        let references: Vec<u32> = table().real_outputs().collect();
        let mut values = vec![f64::NAN; references.len()];
        // SAFETY: a live component and memory for all values
        let status = unsafe { fmi2GetReal(self.c, references.as_ptr(), references.len(), values.as_mut_ptr()) };
        assert_eq!(status, Status::Ok, "{:?}", self.log());
        values.into_iter().map(f64::to_bits).collect()
    }

    /// Takes `n` steps of 1 ms from step `first` on, with a varying load. Returns the outputs after each step as bits.
    pub fn record_steps(&self, first: usize, n: usize) -> Vec<Vec<u64>> {
        (first..first + n)
            .map(|i| {
                let t = i as f64 * 1e-3;
                let load = 800.0 + 70.0 * (300.0 * t).sin();
                assert_eq!(self.set("left.load_torque", load), Status::Ok);
                assert_eq!(self.step(t, 1e-3), Status::Ok, "{:?}", self.log());
                self.outputs()
            })
            .collect()
    }

    pub fn get_state(&self) -> FmuState {
        let mut state = ptr::null_mut();
        // SAFETY: a live component and memory for a pointer
        assert_eq!(unsafe { fmi2GetFMUstate(self.c, &mut state) }, Status::Ok, "{:?}", self.log());
        state
    }

    pub fn set_state(&self, state: FmuState) -> Status {
        // SAFETY: a live component and a live state
        unsafe { fmi2SetFMUstate(self.c, state) }
    }

    pub fn free_state(&self, mut state: FmuState) {
        // SAFETY: a live component and a live state
        assert_eq!(unsafe { fmi2FreeFMUstate(self.c, &mut state) }, Status::Ok);
        assert!(state.is_null());
    }

    pub fn serialize(&self, state: FmuState) -> Vec<u8> {
        let mut size = 0;
        // SAFETY: a live component and a live state
        assert_eq!(unsafe { fmi2SerializedFMUstateSize(self.c, state, &mut size) }, Status::Ok);
        let mut bytes = vec![0u8; size];
        // SAFETY: as above, and memory for `size` bytes
        let status = unsafe { fmi2SerializeFMUstate(self.c, state, bytes.as_mut_ptr().cast::<c_char>(), size) };
        assert_eq!(status, Status::Ok, "{:?}", self.log());
        bytes
    }

    pub fn deserialize(&self, bytes: &[u8]) -> (Status, FmuState) {
        let mut state = ptr::null_mut();
        // SAFETY: a live component, the bytes, and memory for a pointer
        let status = unsafe { fmi2DeSerializeFMUstate(self.c, bytes.as_ptr().cast(), bytes.len(), &mut state) };
        (status, state)
    }

    pub fn log(&self) -> Vec<Line> {
        self.recorder.lines().clone()
    }

    /// Number of lines in the log.
    pub fn log_length(&self) -> usize {
        self.recorder.lines().len()
    }

    /// Returns the last message; empty without any message.
    pub fn last_message(&self) -> String {
        self.recorder.lines().last().map_or_else(String::new, |line| line.message.clone())
    }

    pub fn clear_log(&self) {
        self.recorder.lines().clear();
    }
}

/// Checks that a text contains all of `words`.
pub fn assert_contains(text: &str, words: &[&str]) {
    for word in words {
        assert!(text.contains(word), "{word:?} is missing in {text:?}");
    }
}

/// True if a variable is a real parameter.
pub fn is_real_parameter(access: &Access) -> bool {
    matches!(access, Access::Real(_))
}
