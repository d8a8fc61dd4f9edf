//! Which effects stay: they are left out of the fullest scene one by one while its outputs stay within their limits.

use std::fmt;

use super::bench::{Bench, FULL};
use super::change::Change;
use super::switches::{Standing, Switch};
use super::{Finding, Work};

/// Without an effect, a scene that takes more evaluations than this many times those with it is dearer, if its steps are
/// of the same class of cost; what the effect itself takes in one evaluation is less.
const DEARER: f64 = 1.1;

/// What a scene calls for.
#[derive(Clone, Debug, PartialEq)]
pub enum Verdict {
    /// Called for: without it an output changes beyond its limit.
    Needed,
    /// Called for: within the limits by itself, but not with the others that are left out.
    NeededToo,
    /// Called for: the scene asks for outputs that it gives.
    Asked,
    /// Kept: without it the scene is within the limits, and dearer.
    Dearer,
    /// Kept: without it the scene does not come to its end.
    Fails(String),
    /// Left out: changes all outputs within the accuracy.
    Within,
    /// Left out: changes some output by more than the accuracy and by less than two runs stray.
    Untold,
    /// Left out: changes nothing.
    Nothing,
    /// Left out with the teeth, whose level would do without.
    WithTheLevel,
    /// A level that would do.
    WouldDo,
    /// A level that is too plain.
    TooPlain,
    /// Not looked at: part of the question, which the scene itself has to ask.
    NotThere,
    /// Not looked at: the scene sets it off.
    SetOff,
    /// Cannot be.
    Refused(String),
}

impl Verdict {
    /// Whether the reduced scene has it.
    pub fn is_kept(&self) -> bool {
        matches!(self, Self::Needed | Self::NeededToo | Self::Asked | Self::Dearer | Self::Fails(_))
    }

    /// Whether it was looked at and left out.
    pub fn is_left_out(&self) -> bool {
        matches!(self, Self::Within | Self::Untold | Self::Nothing | Self::WithTheLevel)
    }

    /// For the terminal, where a scene stands to the effect as `standing` says.
    pub fn text(&self, standing: Standing) -> String {
        let on = standing == Standing::On;
        let base = match self {
            Self::Needed => "needed",
            Self::NeededToo => "needed with the others",
            Self::Asked => "needed: its outputs are asked for",
            Self::Dearer => "off would do, but is dearer",
            Self::Fails(_) => "needed: fails without",
            Self::Within if on => "off would do",
            Self::Within => "may stay off",
            Self::Untold if on => "off would do: not told from strays",
            Self::Untold => "may stay off: not told from strays",
            Self::Nothing => "changes nothing",
            Self::WithTheLevel if on => "off would do on the plainer level",
            Self::WithTheLevel => "may stay off on the plainer level",
            Self::WouldDo => "would do",
            Self::TooPlain => "too plain",
            Self::NotThere => "not in this scene",
            Self::SetOff => "set off by the scene",
            Self::Refused(_) => "refused",
        };
        if self.is_kept() && *self != Self::Dearer && !on {
            format!("{base}; off in the scene")
        } else {
            base.to_owned()
        }
    }
}

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.text(Standing::On))
    }
}

/// Writes the verdicts into `rows` and returns the number of the reduced scene's run.
pub fn decide(bench: &mut Bench, rows: &mut [Finding], limits: &[f64], accuracy: f64, work: &mut Work) -> usize {
    let outputs = bench.runs[FULL].scene.outputs.clone();
    let asked: Vec<&str> =
        rows.iter().map(|row| &row.switch).filter(|s| s.is_asked_for(&outputs)).map(Switch::name).collect();
    let mut current = FULL;
    let mut gone: Vec<&str> = Vec::new();
    for row in rows.iter_mut().filter(|row| matches!(row.switch, Switch::Level(_))) {
        row.verdict = match (&row.among.run, row.among.change(bench)) {
            (Ok(run), Some(change)) => {
                let does = change.is_within(limits) && !row.among.without.iter().any(|name| asked.contains(name));
                if does && current == FULL {
                    current = *run;
                    gone.clone_from(&row.among.without);
                }
                if does { Verdict::WouldDo } else { Verdict::TooPlain }
            }
            (outcome, _) => Verdict::Refused(outcome.as_ref().err().cloned().unwrap_or_default()),
        };
    }
    let lowered = current != FULL;
    let mut effects: Vec<&mut Finding> =
        rows.iter_mut().filter(|row| matches!(row.switch, Switch::Effect(_))).collect();
    let size = |row: &Finding| row.among.change(bench).map_or(f64::INFINITY, Change::largest);
    effects.sort_by(|a, b| size(a).total_cmp(&size(b)));
    for row in effects {
        row.verdict = if !row.in_full {
            absent(row)
        } else if asked.contains(&row.switch.name()) {
            Verdict::Asked
        } else if gone.contains(&row.switch.name()) {
            Verdict::WithTheLevel
        } else {
            match (&row.among.run, row.among.change(bench).cloned()) {
                (Ok(_), Some(change)) => {
                    work.next(&format!("without {}", row.switch.name()));
                    let whether = Whether { limits, accuracy, lowered, on: row.standing == Standing::On };
                    leave_out(bench, &row.switch, &change, &whether, &mut current)
                }
                (outcome, _) => Verdict::Fails(outcome.as_ref().err().cloned().unwrap_or_default()),
            }
        };
    }
    current
}

/// Why the fullest scene does not have an effect.
fn absent(row: &Finding) -> Verdict {
    match (&row.among.run, row.standing) {
        (Err(why), _) => Verdict::Refused(why.clone()),
        (_, Standing::SetOff) => Verdict::SetOff,
        _ => Verdict::NotThere,
    }
}

/// What decides whether an effect may be left out.
struct Whether<'a> {
    limits: &'a [f64],
    accuracy: f64,
    /// Whether the level of tooth contact is plainer than that of the scene.
    lowered: bool,
    /// Whether the scene as written has the effect on.
    on: bool,
}

/// Leaves an effect out of the run `current` if that may be.
fn leave_out(bench: &mut Bench, switch: &Switch, change: &Change, whether: &Whether, current: &mut usize) -> Verdict {
    let Whether { limits, accuracy, lowered, on } = *whether;
    let beyond = !change.is_within(limits);
    if beyond && !lowered {
        return Verdict::Needed;
    }
    let less = match switch.turned(&bench.runs[*current].scene) {
        Ok(less) => bench.run(&less.scene),
        Err(problems) => Err(super::bench::told(&problems)),
    };
    let less = match less {
        Ok(less) => less,
        Err(why) => return Verdict::Fails(why),
    };
    let (with, without) = (&bench.runs[*current], &bench.runs[less]);
    // the plainer level may not know the effect at all
    let same = with.changes == without.changes;
    let may = same || !beyond && without.changes[FULL].is_within(limits);
    if !may {
        return if beyond { Verdict::Needed } else { Verdict::NeededToo };
    }
    // what the scene does not have on is not put in to save time
    if on && !same && with.class == without.class && without.evaluations > DEARER * with.evaluations {
        return Verdict::Dearer;
    }
    *current = less;
    if change.is_none() {
        Verdict::Nothing
    } else if change.largest() > accuracy {
        Verdict::Untold
    } else {
        Verdict::Within
    }
}
