//! C function of the schedule, for Python and the page.

use std::{iter, slice};

use crate::{MOST, Rule, Schedule, Step, Table};

/// Number of numbers in a row before those of the tables.
const OWN: usize = 6;

/// Writes the schedule of a run: one row for its start and one for each of its steps, up to `room` numbers in total.
///
/// A row contains the start and size of the step for `fmi2DoStep`, its end (s), and the total number of changes made
/// before it. The next number is 1 if values jump at the start, so that outputs are recorded after values are set. The
/// next is 1 if outputs are recorded at the end, and 0 if only the slope of a table changes there. The value of each
/// table just after the start and the slope of each table per second follow. The row of the start contains the values
/// at the start. Its first number is the number of points between communication points if they make the run much
/// longer, or else 0.
///
/// The `count` numbers of `question` are the end of the run, the step or 0 for none (s), the number of changes, and
/// their ascending times. For each table follow the number of points, the period or 0 for none, a rule, the times and
/// the values. The rule is 0 for an input that is linear within steps, 1 for values that are held up to the next point,
/// or 2 for values that are linear between points and held within a step.
///
/// Returns the number of rows; rows without room are not written. Returns 0 if the question cannot be read, -1 if the
/// run has more than 1e8 steps, and -2 - i if table i has more than 1e8 jumps and points at which steps end.
///
/// # Safety
/// `question` points to `count` numbers and `rows` to room for `room` numbers. Neither may be null, even if its size is
/// 0.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bd_schedule(question: *const f64, count: usize, rows: *mut f64, room: usize) -> isize {
    // SAFETY: the caller's promise
    let (question, rows) = unsafe { (slice::from_raw_parts(question, count), slice::from_raw_parts_mut(rows, room)) };
    let Some((schedule, tables)) = read(question) else { return 0 };
    if schedule.step.is_some_and(|step| schedule.stop / step > MOST) {
        return -1;
    }
    if let Some(table) = schedule.table_with_too_many_stops() {
        return -2 - table as isize;
    }
    let mut rows = rows.chunks_exact_mut(OWN + 2 * tables.len());
    let mut count = 0;
    let points = schedule.points_that_prolong().unwrap_or_default();
    let start = Step { begin: 0.0, end: 0.0, changes: 0..0, begins_with_jump: false, is_recorded: true, slack: 0.0 };
    for step in iter::once(start).chain(schedule) {
        count += 1;
        let Some(row) = rows.next() else { continue };
        let [begin, size] = step.call();
        let begin = if count == 1 { points as f64 } else { begin };
        let flags = [step.begins_with_jump, step.is_recorded].map(|is| f64::from(u8::from(is)));
        row[..OWN].copy_from_slice(&[begin, size, step.end, step.changes.end as f64, flags[0], flags[1]]);
        for (i, table) in tables.iter().enumerate() {
            [row[OWN + i], row[OWN + tables.len() + i]] = step.follow(table);
        }
    }
    count
}

/// Parses a question into its schedule and tables.
fn read(question: &[f64]) -> Option<(Schedule, Vec<Table>)> {
    let (&[stop, step, changes], rest) = question.split_first_chunk()?;
    let (changes, mut rest) = rest.split_at_checked(changes as usize)?;
    let mut tables = Vec::new();
    while let Some((&[points, period, rule], after)) = rest.split_first_chunk() {
        let (times, after) = after.split_at_checked(points as usize)?;
        let (values, after) = after.split_at_checked(points as usize).filter(|(values, _)| !values.is_empty())?;
        let period = (period > 0.0).then_some(period);
        let rule = [Rule::Linear, Rule::Held, Rule::Sampled].get(rule as usize).copied()?;
        tables.push(Table { times: times.to_vec(), values: values.to_vec(), period, rule });
        rest = after;
    }
    let schedule = Schedule::new(stop, (step > 0.0).then_some(step), changes.to_vec(), tables.iter());
    (stop.is_finite() && rest.is_empty()).then_some((schedule, tables))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn asked(question: &[f64]) -> Result<Vec<f64>, isize> {
        // SAFETY: the lengths match both slices
        let count = unsafe { bd_schedule(question.as_ptr(), question.len(), [].as_mut_ptr(), 0) };
        let mut rows = vec![f64::NAN; (OWN + 2) * usize::try_from(count).ok().filter(|&count| count > 0).ok_or(count)?];
        assert_eq!(unsafe { bd_schedule(question.as_ptr(), question.len(), rows.as_mut_ptr(), rows.len()) }, count);
        Ok(rows)
    }

    #[test]
    fn rows_contain_the_steps() {
        // a ramp of 8 per second that falls back at 0.75 s, and a change at 0.25 s
        let ramp = [1.0, 0.25, 3.0, 0.0, 0.0, 0.0, 0.75, 0.75, 0.0, 6.0, 1.0];
        let rows = asked(&[&[1.0, 0.5, 1.0], &ramp[1..2], &ramp[2..]].concat()).expect("rows");
        let close = |a: &f64, b: &f64| (a - b).abs() < 1e-7;
        let wanted = [
            [0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0],
            [0.0, 0.25, 0.25, 0.0, 0.0, 1.0, 0.0, 8.0],
            [0.25, 0.25, 0.5, 1.0, 1.0, 1.0, 2.0, 8.0],
            [0.5, 0.25, 0.75, 1.0, 0.0, 1.0, 4.0, 8.0],
            [0.75, 0.25, 1.0, 1.0, 1.0, 1.0, 1.0, 0.0],
        ];
        assert!(rows.len() == 40 && rows.iter().zip(wanted.as_flattened()).all(|(a, b)| close(a, b)), "{rows:?}");
        // without a step
        assert_eq!(asked(&[&[1.0, 0.0, 0.0], &ramp[2..]].concat()).map(|rows| [rows[10], rows[18]]), Ok([0.75, 1.0]));
    }

    #[test]
    fn a_question_that_is_invalid_or_needs_too_many_steps_is_refused() {
        let square = [3.0, 1e-9, 0.0, 0.0, 5e-10, 5e-10, 1.0, 1.0, 0.0];
        for (question, why) in [
            (vec![1.0, 0.1], 0),
            (vec![f64::NAN, 0.0, 0.0], 0),
            (vec![1.0, 0.1, 2.0, 0.5], 0),
            (vec![1.0, 0.1, 0.0, 1.0, 0.0, 0.0, 0.0], 0),
            (vec![1.0, 0.1, 0.0, 0.0, 0.0, 0.0], 0),
            (vec![1.0, 1e-9, 0.0], -1),
            ([&[1.0, 0.1, 0.0], &square[..]].concat(), -2),
        ] {
            assert_eq!(asked(&question), Err(why), "{question:?}");
        }
    }
}
