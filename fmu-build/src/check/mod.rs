//! What checks: commands that fail if the library breaks a promise about calls, memory, effects that are off, steps in real
//! time, other hosts or other platforms.

pub mod fuzz;
pub mod hosts;
pub mod memcheck;
pub mod platforms;
pub mod real_time;
pub mod stepping;
pub mod zero_cost;
