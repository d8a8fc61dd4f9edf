//! Calls by function: counts, statuses and times.

use std::time::Duration;

use bevel_differential::fmi2::Status;
use serde_json::{Value, json};

use super::functions::Function;

/// Statuses that are counted: OK, warning, discard, error.
const STATUSES: usize = 4;

/// Counts, by function in the order of the list.
#[derive(Clone, Debug)]
pub struct Tally {
    rows: Vec<FunctionTally>,
    /// Instances brought to a running simulation.
    pub started_instances: u64,
    /// Calls before and after which states were compared.
    pub compared: u64,
    /// The call that took longest.
    longest: LongestCall,
}

/// A call by its place: seed of its round, and its number there.
#[derive(Clone, Copy, Debug, Default)]
struct LongestCall {
    took: Duration,
    function: &'static str,
    seed: u64,
    at: u64,
}

#[derive(Clone, Copy, Debug, Default)]
struct FunctionTally {
    statuses: [u64; STATUSES],
    total: Duration,
    longest: Duration,
}

impl Default for Tally {
    fn default() -> Self {
        Self {
            rows: vec![FunctionTally::default(); Function::ALL.len()],
            started_instances: 0,
            compared: 0,
            longest: LongestCall::default(),
        }
    }
}

impl Tally {
    /// Counts a call of `function`. Its place is the seed of its round and its number there.
    pub fn count(&mut self, function: Function, status: Status, took: Duration, (seed, at): (u64, usize)) {
        if took > self.longest.took {
            self.longest = LongestCall { took, function: function.name(), seed, at: at as u64 };
        }
        let row = &mut self.rows[function as usize];
        row.statuses[(status as usize).min(STATUSES - 1)] += 1;
        row.total += took;
        row.longest = row.longest.max(took);
    }

    /// Calls so far.
    pub fn calls(&self) -> u64 {
        self.rows.iter().flat_map(|row| row.statuses).sum()
    }

    /// Calls of `function` that returned fmi2OK.
    pub fn returned_ok(&self, function: Function) -> u64 {
        self.rows[function as usize].statuses[0]
    }

    /// All of it as JSON, for the process that starts workers; times in seconds.
    pub fn json(&self) -> Value {
        let LongestCall { took, function, seed, at } = self.longest;
        let rows = Function::ALL.iter().zip(&self.rows).map(|(function, row)| {
            json!({"function": function.name(), "statuses": row.statuses, "seconds": row.total.as_secs_f64(),
                "longest": row.longest.as_secs_f64()})
        });
        json!({"scenes": self.started_instances, "compared": self.compared, "rows": rows.collect::<Vec<_>>(),
            "longest": {"seconds": took.as_secs_f64(), "function": function, "seed": seed, "at": at}})
    }
}
