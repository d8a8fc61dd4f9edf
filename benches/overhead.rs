//! Measures the cost of the FMI interface: a step of the ideal level with the calls of a host around it, and a start.
//! The start consists of the calls from instantiation to the first step, the first time and after fmi2Reset. The
//! functions are looked up in the shared library, as a C host does.

#[path = "../tests/common/mod.rs"]
mod common;

use std::ffi::{CString, c_char, c_void};
use std::hint::black_box;
use std::mem::transmute_copy;
use std::path::PathBuf;
use std::time::Instant;

use bevel_differential::fmi2::{CO_SIMULATION, Status};
use bevel_differential::variables::guid;
use common::reference;

type Component = *mut c_void;

/// Number of steps of a run.
const STEPS: u32 = 20_000;
/// Number of runs. The median is reported.
const RUNS: usize = 41;

const INPUTS: [&str; 3] = ["carrier.speed_command", "left.load_torque", "right.load_torque"];
const OUTPUTS: [&str; 10] = [
    "carrier.angle",
    "carrier.speed",
    "left.angle",
    "left.speed",
    "right.angle",
    "right.speed",
    "carrier.torque",
    "left.shaft_torque",
    "right.shaft_torque",
    "planet[1].spin_speed",
];

macro_rules! functions {
    ($($field:ident = $name:literal: ($($type:ty),*) $(-> $result:ty)?;)+) => {
        /// Used functions, with their C types.
        struct Fmu { $($field: unsafe extern "C" fn($($type),*) $(-> $result)?),+ }

        impl Fmu {
            /// Looks up the functions with `find`, by name.
            fn found(find: impl Fn(&str) -> *mut c_void) -> Self {
                // SAFETY: the functions have the types defined by FMI
                unsafe { Self { $($field: transmute_copy(&find($name))),+ } }
            }
        }
    };
}

functions! {
    instantiate = "fmi2Instantiate": (*const c_char, i32, *const c_char, *const c_char, *const c_void, i32, i32) -> Component;
    free = "fmi2FreeInstance": (Component);
    setup = "fmi2SetupExperiment": (Component, i32, f64, f64, i32, f64) -> Status;
    enter = "fmi2EnterInitializationMode": (Component) -> Status;
    exit = "fmi2ExitInitializationMode": (Component) -> Status;
    reset = "fmi2Reset": (Component) -> Status;
    set_real = "fmi2SetReal": (Component, *const u32, usize, *const f64) -> Status;
    set_integer = "fmi2SetInteger": (Component, *const u32, usize, *const i32) -> Status;
    get_real = "fmi2GetReal": (Component, *const u32, usize, *mut f64) -> Status;
    do_step = "fmi2DoStep": (Component, f64, f64, i32) -> Status;
}

impl Fmu {
    fn load() -> Self {
        let path = library();
        let name = CString::new(path.as_os_str().as_encoded_bytes()).unwrap();
        // SAFETY: a path that ends with NUL
        let library = unsafe { libc::dlopen(name.as_ptr(), libc::RTLD_NOW | libc::RTLD_LOCAL) };
        assert!(!library.is_null(), "{} cannot be loaded", path.display());
        Self::found(|name| {
            let text = CString::new(name).unwrap();
            // SAFETY: a loaded library and a name that ends with NUL
            let address = unsafe { libc::dlsym(library, text.as_ptr()) };
            assert!(!address.is_null(), "{name:?} is missing");
            address
        })
    }

    /// Creates an initialised instance on a level: 1 ideal, 2 lumped, 3 tooth, 4 solid.
    fn ready(&self, level: i32) -> Component {
        let guid = CString::new(guid()).unwrap();
        // SAFETY: texts that end with NUL, no callbacks, and arrays of these lengths
        unsafe {
            let c = (self.instantiate)(
                c"overhead".as_ptr(),
                CO_SIMULATION,
                guid.as_ptr(),
                c"".as_ptr(),
                std::ptr::null(),
                0,
                0,
            );
            assert!(!c.is_null());
            self.initialise(c, level);
            c
        }
    }

    /// Initialises `c` on a level.
    fn initialise(&self, c: Component, level: i32) {
        // SAFETY: a live component, one value
        unsafe {
            let ok = (self.set_integer)(c, &reference("scene.gear_contact"), 1, &level);
            let started = [(self.setup)(c, 0, 0.0, 0.0, 0, 0.0), (self.enter)(c), (self.exit)(c)];
            assert_eq!((ok, started), (Status::Ok, [Status::Ok; 3]));
        }
    }
}

/// Path of the shared library built with this program.
fn library() -> PathBuf {
    let here = std::env::current_exe().unwrap();
    let name = format!("{}bevel_differential{}", std::env::consts::DLL_PREFIX, std::env::consts::DLL_SUFFIX);
    let found = here.ancestors().skip(1).take(2).map(|folder| folder.join(&name)).find(|path| path.is_file());
    found.unwrap_or_else(|| panic!("{name} is not next to {}", here.display()))
}

fn median(mut times: Vec<f64>) -> f64 {
    times.sort_by(f64::total_cmp);
    times[times.len() / 2]
}

fn main() {
    let fmu = Fmu::load();
    let [inputs, outputs] = [INPUTS.to_vec(), OUTPUTS.to_vec()].map(|names| names.into_iter().map(reference).collect());
    let (inputs, outputs): (Vec<u32>, Vec<u32>) = (inputs, outputs);
    let times = (0..RUNS).map(|_| {
        let c = fmu.ready(1);
        let (mut values, mut ok) = ([0.0; OUTPUTS.len()], true);
        let begin = Instant::now();
        for k in 0..STEPS {
            let command = [50.0, 835.0 + f64::from(k % 7), 835.0];
            // SAFETY: a live component and arrays of these lengths
            unsafe {
                ok &= (fmu.set_real)(c, inputs.as_ptr(), inputs.len(), command.as_ptr()) == Status::Ok;
                ok &= (fmu.do_step)(c, f64::from(k) * 1e-3, 1e-3, 1) == Status::Ok;
                ok &= (fmu.get_real)(c, outputs.as_ptr(), outputs.len(), values.as_mut_ptr()) == Status::Ok;
            }
            black_box(&values);
        }
        let time = begin.elapsed().as_secs_f64();
        assert!(ok);
        // SAFETY: a live component
        unsafe { (fmu.free)(c) };
        time / f64::from(STEPS)
    });
    let step = median(times.collect());
    println!("3 inputs set, a step of the ideal level, 10 outputs got: {:.3} us", step * 1e6);
    for (level, name) in [(1, "ideal"), (2, "lumped"), (3, "tooth"), (4, "solid")] {
        let (first, again) = (0..RUNS)
            .map(|_| {
                let begin = Instant::now();
                let c = fmu.ready(level);
                let first = begin.elapsed().as_secs_f64();
                let begin = Instant::now();
                // SAFETY: a live component
                assert_eq!(unsafe { (fmu.reset)(c) }, Status::Ok);
                fmu.initialise(c, level);
                let again = begin.elapsed().as_secs_f64();
                // SAFETY: a live component
                unsafe { (fmu.free)(c) };
                (first, again)
            })
            .unzip();
        println!("instantiated and initialised, {name}: {:.3} ms", median(first) * 1e3);
        println!("reset and initialised again, {name}: {:.3} ms", median(again) * 1e3);
    }
}
