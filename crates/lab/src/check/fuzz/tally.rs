//! Calls by function: counts, statuses and times.

use std::fmt::Write as _;
use std::time::Duration;

use bevel_differential::fmi2::Status;

use super::functions::Function;
use answers::text::table::{Table, wrapped};

/// Statuses that are counted, as heads of the table.
const HEADS: [&str; 4] = ["OK", "warning", "discard", "error"];

/// Counts, by function in the order of the list.
#[derive(Clone, Debug)]
pub struct Tally {
    rows: Vec<FunctionTally>,
    /// Instances brought to a running simulation.
    pub scenes: u64,
    /// Calls before and after which states were compared.
    pub compared: u64,
    /// The call that took longest.
    longest: LongestCall,
}

/// A call by its place: seed of its round, and its number there.
#[derive(Clone, Copy, Debug, Default)]
struct LongestCall {
    took: Duration,
    function: usize,
    seed: u64,
    at: u64,
}

#[derive(Clone, Copy, Debug, Default)]
struct FunctionTally {
    statuses: [u64; HEADS.len()],
    total: Duration,
    longest: Duration,
}

impl Default for Tally {
    fn default() -> Self {
        Self {
            rows: vec![FunctionTally::default(); Function::ALL.len()],
            scenes: 0,
            compared: 0,
            longest: LongestCall::default(),
        }
    }
}

impl Tally {
    /// A call of `function`, at its place: the seed of its round and its number there.
    pub fn count(&mut self, function: Function, status: Status, took: Duration, (seed, at): (u64, usize)) {
        self.keep_longest(LongestCall { took, function: function as usize, seed, at: at as u64 });
        let row = &mut self.rows[function as usize];
        row.statuses[(status as usize).min(HEADS.len() - 1)] += 1;
        row.total += took;
        row.longest = row.longest.max(took);
    }

    fn keep_longest(&mut self, call: LongestCall) {
        if call.took > self.longest.took {
            self.longest = call;
        }
    }

    /// Calls so far.
    pub fn calls(&self) -> u64 {
        self.rows.iter().flat_map(|row| row.statuses).sum()
    }

    /// Calls of `function` that were carried out.
    pub fn done(&self, function: Function) -> u64 {
        self.rows[function as usize].statuses[0]
    }

    /// As lines of numbers, for another process.
    pub fn lines(&self) -> String {
        let LongestCall { took, function, seed, at } = self.longest;
        let mut out = format!("{} {} {} {function} {seed} {at}\n", self.scenes, self.compared, took.as_nanos());
        for row in &self.rows {
            let [a, b, c, d] = row.statuses;
            let _ = writeln!(out, "{a} {b} {c} {d} {} {}", row.total.as_nanos(), row.longest.as_nanos());
        }
        out
    }

    /// What [`Self::lines`] wrote.
    pub fn read(text: &str) -> Option<Self> {
        let mut tally = Self::default();
        let mut lines =
            text.lines().map(|line| line.split(' ').map(|n| n.parse::<u64>().ok()).collect::<Option<Vec<_>>>());
        let [scenes, compared, took, function, seed, at] = lines.next()??[..] else { return None };
        (tally.scenes, tally.compared) = (scenes, compared);
        tally.longest = LongestCall { took: Duration::from_nanos(took), function: function as usize, seed, at };
        for row in &mut tally.rows {
            let [a, b, c, d, total, longest] = lines.next()??[..] else { return None };
            let [total, longest] = [total, longest].map(Duration::from_nanos);
            *row = FunctionTally { statuses: [a, b, c, d], total, longest };
        }
        Some(tally)
    }

    /// Adds what another process counted.
    pub fn add(&mut self, other: &Self) {
        self.scenes += other.scenes;
        self.compared += other.compared;
        self.keep_longest(other.longest);
        for (row, more) in self.rows.iter_mut().zip(&other.rows) {
            row.add(more);
        }
    }

    /// The table.
    pub fn table(&self) -> String {
        let cells = |name: &str, row: &FunctionTally| {
            let calls: u64 = row.statuses.iter().sum();
            let mean = row.total.as_secs_f64() * 1e6 / calls.max(1) as f64;
            let mut cells = vec![name.to_owned(), calls.to_string()];
            cells.extend(row.statuses.map(|count| count.to_string()));
            cells.extend([format!("{mean:.1}"), format!("{:.1}", row.longest.as_secs_f64() * 1e3)]);
            cells
        };
        let head = ["function", "calls"].into_iter().chain(HEADS).chain(["mean, µs", "longest, ms"]);
        let mut table = Table::new(head).left([0]);
        Function::ALL.iter().zip(&self.rows).for_each(|(function, row)| table.push(cells(function.name(), row)));
        let mut all = FunctionTally::default();
        self.rows.iter().for_each(|row| all.add(row));
        table.push(cells("all", &all));
        let LongestCall { took, function, seed, at } = self.longest;
        format!(
            "{}\n{}",
            table.terminal(),
            wrapped(&format!(
                "longest call: {}, {:.3} s of the processor (call {at} of the round with seed {seed}); simulations started: {}; communication steps done: {}; steps completed in model exchange: {}; states \
                 compared before and after a call: {}",
                Function::ALL.get(function).map_or("none", |f| f.name()),
                took.as_secs_f64(),
                self.scenes,
                self.done(Function::fmi2DoStep),
                self.done(Function::fmi2CompletedIntegratorStep),
                self.compared
            ))
        )
    }
}

impl FunctionTally {
    fn add(&mut self, more: &Self) {
        self.statuses.iter_mut().zip(more.statuses).for_each(|(count, n)| *count += n);
        self.total += more.total;
        self.longest = self.longest.max(more.longest);
    }
}
