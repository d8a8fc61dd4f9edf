//! Text of the answer for the user.

use bevel_differential::model::{GearContact, Method};

use super::answer::{Answer, Role};
use super::bench::Trial;
use super::gears::Gears;
use super::knowledge;
use super::record::Effort;
use super::switches::Switch;
use super::words::{difference, percent, setting, three_digits, two_digits};
use crate::scene::units;
use crate::text::table::labelled;

/// Width of the first column.
const INDENT: usize = 11;
/// Errors cancel if the chosen setting is this many times closer to the reference than the same gears with all effects.
const CANCELLED: f64 = 2.0;
/// Maximum number of wanted quantities that the text lists by name.
const LISTED: usize = 6;

/// Complete text.
pub fn text(answer: &Answer) -> String {
    let mut out = format!("{}: {}\n\n", answer.scene.name, answer.scene.description);
    for (title, line) in lines(answer) {
        out.push_str(&labelled(&format!("{title:<INDENT$}"), &line));
    }
    out
}

/// Lines of the text, each with its title.
fn lines(answer: &Answer) -> Vec<(&'static str, String)> {
    let mut lines = vec![("Wanted", wanted(answer))];
    match answer.choice() {
        Some(chosen) => {
            lines.push(("Use", format!("{}.", setting(&chosen.scene.parameters))));
            let certain = if answer.is_uncertain() { " NOT CERTAIN, see the reference." } else { "" };
            lines.push(("", format!("{}.{certain}", error_and_cost(answer, chosen))));
            let Effort { start, seconds, .. } = chosen.effort;
            let [start, all] = [start, start + seconds].map(|time| two_digits(time * 1e3));
            let time = format!(
                "The start takes {start} of the {all} ms of a run; later starts with the same gears are faster."
            );
            lines.push(("", time));
            if let Some(by) = cancelled(answer, chosen) {
                lines.push(("", by));
            }
        }
        None => lines.push(("Use", nothing(answer))),
    }
    if answer.scene.parameters.solver.method == Method::Radau {
        lines.push(("", "The setting is adaptive: the scene's method radau is for comparison.".into()));
    }
    for (title, run) in [("Too coarse", answer.too_coarse), ("Richer", answer.richer)] {
        if let (Some(run), Some(chosen)) = (run.map(|run| &answer.trials[run]), answer.choice()) {
            let changes = difference(&chosen.scene.parameters, &run.scene.parameters);
            lines.push((title, format!("{changes}: {}.", error_and_cost(answer, run))));
        }
    }
    lines.push(("Reference", reference(answer)));
    lines.push(("Gears", gears(answer)));
    if answer.scene.parameters.scene.gear_contact == GearContact::Solid {
        lines.push((
            "",
            "The solid teeth of the scene are not judged: faceted flanks are a worse model than the exact flanks above."
                .into(),
        ));
    }
    lines.extend(effects(answer));
    for bound in knowledge::bounds(&answer.scene.outputs, &answer.wants) {
        lines.push(("Not known", format!("{bound}.")));
    }
    lines
}

fn wanted(answer: &Answer) -> String {
    let texts: Vec<String> = answer.wants.iter().map(|want| want.text(&answer.scene)).collect();
    let names = if texts.len() > LISTED {
        format!("mean, rms, min and max of {} outputs", answer.scene.outputs.len())
    } else {
        let values = answer.wants.iter().zip(&answer.reference.values).map(|(want, &value)| {
            let row = &answer.scene.display_units.row(answer.scene.outputs[want.output]);
            match want.statistic {
                super::statistic::Statistic::TimeOfPeak => format!("{} s", three_digits(value)),
                statistic if statistic.is_difference() => units::difference_text(row, value),
                _ => units::text(row, value),
            }
        });
        texts
            .iter()
            .zip(values)
            .map(|(text, value)| format!("{text} (reference {value})"))
            .collect::<Vec<_>>()
            .join(", ")
    };
    let from = if answer.from > 0.0 { format!(" from {} s on", units::six_digits(answer.from)) } else { String::new() };
    format!("{names} within {} %{from}.", units::six_digits(100.0 * answer.within))
}

/// Reason for the lack of an accurate setting.
fn nothing(answer: &Answer) -> String {
    let is_fixed = |run: &&Trial| run.scene.parameters.solver.method == Method::FixedStep;
    let fixed = answer.trials.iter().filter(is_fixed).min_by(|a, b| a.error().total_cmp(&b.error()));
    match fixed {
        Some(nearest) => format!(
            "no setting: no fixed steps that were tested are accurate enough, and shorter steps cost too much. The most accurate are {}, \
             with an error of {}. Set solver.method = adaptive, or allow a larger error.",
            setting(&nearest.scene.parameters),
            percent(nearest.error())
        ),
        None => "no setting runs to its end; see the reference.".into(),
    }
}

/// Error and cost of `run`.
fn error_and_cost(answer: &Answer, run: &Trial) -> String {
    let (want, error) = run.worst();
    let mut text = format!("error {}", percent(error));
    if answer.wants.len() > 1 && error > 0.0 {
        text.push_str(&format!(" ({})", answer.wants[want].text(&answer.scene)));
    }
    let per_millisecond = run.cost / (answer.scene.stop_time * 1e3);
    text.push_str(&real_time(answer, run));
    text.push_str(&format!("; costs {} plain evaluations per ms", two_digits(per_millisecond)));
    let ratio = answer.reference.cost / run.cost;
    let times = if ratio >= 1.0 {
        format!("{} times cheaper", two_digits(ratio))
    } else {
        format!("{} times more expensive", two_digits(1.0 / ratio))
    };
    text.push_str(&format!("; {times} than the reference"));
    text
}

/// Speed of `run` on this machine, unless the run was too short for the clock.
fn real_time(answer: &Answer, run: &Trial) -> String {
    let seconds = run.effort.seconds;
    if seconds > 0.0 {
        format!("; {} x real time", two_digits(answer.scene.stop_time / seconds))
    } else {
        String::new()
    }
}

fn reference(answer: &Answer) -> String {
    let reference = &answer.reference;
    let mut text = format!(
        "{}; uncertainty from the tolerance {}",
        setting(&reference.scene.parameters),
        percent(reference.error())
    );
    text.push_str(&real_time(answer, reference));
    text.push('.');
    if answer.is_uncertain() {
        let name = answer.wants[reference.worst().0].text(&answer.scene);
        text.push_str(&format!(
            " NOT CERTAIN: {name} changes by more than a third of the accuracy if only the integrator's steps \
             change, as in motions with impacts. Differences below twice this uncertainty mean nothing. Request a \
             steadier statistic (mean, rms), a later --from, or less accuracy."
        ));
    }
    text
}

/// Warning if the chosen setting is closer to the reference than the same gears with all effects. Then the missing
/// effects compensate for the errors of the gears, but only in this scene.
fn cancelled(answer: &Answer, chosen: &Trial) -> Option<String> {
    let own = Gears::of(&chosen.scene.parameters);
    let (_, full) = answer.gears.iter().find(|(gears, _)| *gears == own)?;
    let full = answer.trials[*full.as_ref().ok()?].error();
    (full > answer.within / CANCELLED && full > CANCELLED * chosen.error()).then(|| {
        format!(
            "Errors cancel: with all effects, the error of these gears is {}. Repeat the question at other loads and \
             speeds.",
            percent(full)
        )
    })
}

/// Error of each plainer level and law with all its effects.
fn gears(answer: &Answer) -> String {
    let errors = answer.gears.iter().map(|(gears, run)| match run {
        Ok(run) => format!("{} is off by {}", gears.text(), percent(answer.trials[*run].error())),
        Err(why) => format!("{} does not run ({})", gears.text(), why.split(';').next().unwrap_or(why)),
    });
    let errors: Vec<String> = errors.collect();
    if errors.is_empty() {
        let own = Gears::of(&answer.reference.scene.parameters).text();
        return format!("{own} is set by the scene and part of the question.");
    }
    format!("with all their effects: {}.", errors.join(", "))
}

/// Role of each effect, one line for each reason.
fn effects(answer: &Answer) -> Vec<(&'static str, String)> {
    let mut lines = Vec::new();
    let names = |pick: &dyn Fn(&Switch, &Role) -> Option<String>| {
        let mut found: Vec<String> = answer.effects.iter().filter_map(|(switch, role)| pick(switch, role)).collect();
        found.dedup();
        found.join(", ")
    };
    let mut push = |title: &'static str, names: String| {
        if !names.is_empty() {
            lines.push((title, format!("{names}.")));
        }
    };
    let acts = |in_setting: bool, beyond: bool| {
        move |switch: &Switch, role: &Role| match role {
            Role::Acts { by, chosen } if *chosen == in_setting && (*by > answer.within) == beyond => {
                let on = if in_setting && !switch.is_on(&answer.scene.parameters) { ", off in the scene" } else { "" };
                Some(format!("{} ({}{on})", switch.name(), percent(*by)))
            }
            _ => None,
        }
    };
    push("Needed", names(&acts(true, true)));
    push("Kept", prefixed("needed together, or no cheaper without: ", names(&acts(true, false))));
    match answer.choice() {
        Some(_) => push(
            "Left out",
            prefixed(
                "changes the richest model by more than the accuracy, but the chosen setting is accurate without: ",
                names(&acts(false, true)),
            ),
        ),
        None => push("Needed", names(&acts(false, true))),
    }
    push("Left out", prefixed("acts below the accuracy: ", names(&acts(false, false))));
    for (switch, role) in &answer.effects {
        if let Role::Neutral { typical, by, now } = role {
            let values: Vec<String> = typical
                .iter()
                .map(|(row, value)| {
                    format!("{} = {}", row.name, units::text(&answer.scene.display_units.row(row), *value))
                })
                .collect();
            let effect = match by {
                Some(by) if *by > answer.within => {
                    format!("would change a wanted quantity by {}: set what your gears have", percent(*by))
                }
                Some(by) => format!("would change a wanted quantity by {}", percent(*by)),
                None => "were not tried".into(),
            };
            let acts = if *now > 0.0 {
                format!("changes {} only through other steps of the integrator", percent(*now))
            } else {
                "changes nothing".into()
            };
            push(
                "Neutral",
                format!(
                    "{} {acts}: its values are zero in the scene; typical values, {}, {effect}",
                    switch.name(),
                    values.join(", ")
                ),
            );
        }
    }
    let of = |is: fn(&Role) -> bool| names(&|switch, role| is(role).then(|| switch.name().into()));
    push("Not judged", prefixed("not in the scene: ", of(|role| matches!(role, Role::NotInScene))));
    push("Set off", prefixed("by the scene: ", of(|role| matches!(role, Role::SetOff))));
    push(
        "Not asked",
        prefixed("only add outputs, and none of them is wanted: ", of(|role| matches!(role, Role::NotAsked))),
    );
    push(
        "Kept",
        names(&|s, role| match role {
            Role::Kept(why) => Some(format!("{} ({why})", s.name())),
            _ => None,
        }),
    );
    push(
        "Refused",
        names(&|s, role| match role {
            Role::Refused(why) => Some(format!("{} ({})", s.name(), why.split(';').next().unwrap_or(why))),
            _ => None,
        }),
    );
    lines
}

fn prefixed(before: &str, names: String) -> String {
    if names.is_empty() { names } else { format!("{before}{names}") }
}
