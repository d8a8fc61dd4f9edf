//! Statistics of calls by function: counts, statuses and times.

use std::collections::BTreeMap;
use std::time::Duration;

use bevel_differential::instance::Status;
use serde_json::{Value, json};

use super::choice::VERSIONS;

/// Number of counted statuses: OK, warning, discard, error.
const STATUSES: usize = 4;

/// Statistics by function.
#[derive(Clone, Debug, Default)]
pub struct Tally {
    rows: BTreeMap<&'static str, FunctionTally>,
    /// Instances brought to a running simulation.
    pub started_instances: u64,
    /// Number of calls for which states were compared.
    pub compared: u64,
    /// Number of updates during steps.
    pub updates: u64,
    /// Call that took longest.
    longest: LongestCall,
}

/// A call, identified by the seed of its round and its index in the round.
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

impl Tally {
    /// Counts a call of `function`. The call is identified by the seed of its round and its index in the round.
    pub fn count(&mut self, function: &'static str, status: Status, took: Duration, (seed, at): (u64, usize)) {
        if took > self.longest.took {
            self.longest = LongestCall { took, function, seed, at: at as u64 };
        }
        let row = self.rows.entry(function).or_default();
        row.statuses[(status as usize).min(STATUSES - 1)] += 1;
        row.total += took;
        row.longest = row.longest.max(took);
    }

    /// Number of calls so far.
    pub fn calls(&self) -> u64 {
        self.rows.values().flat_map(|row| row.statuses).sum()
    }

    /// Number of successful calls of `function`.
    pub fn returned_ok(&self, function: &str) -> u64 {
        self.rows.get(function).map_or(0, |row| row.statuses[0])
    }

    /// Statistics as JSON, for the process that starts workers; times in seconds.
    pub fn json(&self) -> Value {
        let LongestCall { took, function, seed, at } = self.longest;
        let functions = VERSIONS.iter().flat_map(|version| version.functions);
        let called = functions.filter_map(|function| self.rows.get_key_value(function.name));
        let rows = called.map(|(function, row)| {
            json!({"function": function, "statuses": row.statuses, "seconds": row.total.as_secs_f64(),
                "longest": row.longest.as_secs_f64()})
        });
        json!({"scenes": self.started_instances, "compared": self.compared, "updates": self.updates,
            "rows": rows.collect::<Vec<_>>(),
            "longest": {"seconds": took.as_secs_f64(), "function": function, "seed": seed, "at": at}})
    }
}
