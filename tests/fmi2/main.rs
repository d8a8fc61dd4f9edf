//! Tests of the C functions as hosts call them, with one topic per file. They form one program, so that it is linked
//! once.

#[path = "../common/mod.rs"]
mod common;

mod aliasing;
mod allocation;
mod calls;
mod derivatives;
mod directional_derivatives;
mod exchange;
mod exchange_errors;
mod exchange_events;
mod experiment;
mod held_inputs;
mod hostile_states;
mod input_ramp;
mod instances;
mod logging;
mod set_states;
mod solver;
mod stack;
mod states;
mod stepping;
mod straight_case;
mod values;

/// Allocator with counters per thread, for the tests of allocations.
#[global_allocator]
static ALLOCATOR: common::counting_allocator::CountingAllocator = common::counting_allocator::CountingAllocator;
