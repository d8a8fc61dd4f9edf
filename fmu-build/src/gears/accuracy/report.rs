//! The answer in words.

use super::answer::{Answer, Role};
use super::bench::Trial;
use super::gears::Gears;
use super::knowledge;
use super::switches::Switch;
use super::words::{count, difference, percent, setting, three, two};
use crate::gears::scene::units;
use crate::tools::table::labelled;

/// Width of the first column.
const INDENT: usize = 11;
/// So many wanted quantities are listed by name.
const LISTED: usize = 6;

/// All of it.
pub fn text(answer: &Answer) -> String {
    let mut out = format!("{}: {}\n\n", answer.scene.name, answer.scene.description);
    for (title, line) in lines(answer) {
        out.push_str(&labelled(&format!("{title:<INDENT$}"), &line));
    }
    out
}

/// The lines with their titles.
fn lines(answer: &Answer) -> Vec<(&'static str, String)> {
    let mut lines = vec![("Wanted", wanted(answer))];
    match answer.choice() {
        Some(chosen) => {
            lines.push(("Use", format!("{}.", setting(&chosen.scene.parameters))));
            let certain = if answer.is_uncertain() { " NOT CERTAIN, see the reference." } else { "" };
            lines.push(("", format!("{}.{certain}", told(answer, chosen, 0))));
        }
        None => lines.push(("Use", "nothing that was tried comes to its end; see the reference.".into())),
    }
    for (title, run, place) in [("Cheaper", answer.cheaper, 1), ("Richer", answer.richer, 2)] {
        if let (Some(run), Some(chosen)) = (run.map(|run| &answer.trials[run]), answer.choice()) {
            let what = difference(&chosen.scene.parameters, &run.scene.parameters);
            lines.push((title, format!("{what}: {}.", told(answer, run, place))));
        }
    }
    lines.push(("Reference", reference(answer)));
    lines.push(("Gears", gears(answer)));
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
            let row = answer.scene.outputs[want.output];
            match want.statistic {
                super::statistic::Statistic::TimeOfPeak => format!("{} s", three(value)),
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
    let from = if answer.from > 0.0 { format!(" from {} s on", units::digits(answer.from)) } else { String::new() };
    format!("{names} within {} %{from}.", units::digits(100.0 * answer.within))
}

/// Error and cost of a run.
fn told(answer: &Answer, run: &Trial, place: usize) -> String {
    let (want, error) = run.worst();
    let mut text = format!("error {}", percent(error));
    if answer.wants.len() > 1 && error > 0.0 {
        text.push_str(&format!(" ({})", answer.wants[want].text(&answer.scene)));
    }
    let per_millisecond = run.cost / (answer.scene.stop_time * 1e3);
    if let Some(seconds) = answer.seconds[place] {
        text.push_str(&format!("; {} x real time", two(answer.scene.stop_time / seconds)));
    }
    text.push_str(&format!("; about {} instructions per ms", count(per_millisecond)));
    let ratio = answer.reference.cost / run.cost;
    let times = if ratio >= 1.0 {
        format!("{} times cheaper", two(ratio))
    } else {
        format!("{} times dearer", two(1.0 / ratio))
    };
    text.push_str(&format!("; {times} than the reference"));
    text
}

fn reference(answer: &Answer) -> String {
    let reference = &answer.reference;
    let mut text = format!("{}; strays by {}", setting(&reference.scene.parameters), percent(reference.stray()));
    if let Some(seconds) = answer.seconds[3] {
        text.push_str(&format!("; {} x real time", two(answer.scene.stop_time / seconds)));
    }
    text.push('.');
    if answer.is_uncertain() {
        let worst = (0..reference.strays.len()).max_by(|&a, &b| reference.strays[a].total_cmp(&reference.strays[b]));
        let name = worst.map_or(String::new(), |i| answer.wants[i].text(&answer.scene));
        text.push_str(&format!(
            " NOT CERTAIN: {name} strays by more than a third of the accuracy when only the integrator's steps change, as in \
             motions with blows. Nothing below twice that can be told: ask for a steadier statistic (mean, rms), a later \
             --from, or less accuracy."
        ));
    }
    text
}

/// Error of each plainer level and law.
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
    format!("{}.", errors.join(", "))
}

/// Why effects are in or out, those of one reason together.
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
    push("Kept", join("with the others, or as leaving it out saves nothing: ", names(&acts(true, false))));
    push(
        "Out, though",
        join(
            "it changes the richest model by more than wanted; what is chosen has been run and is accurate: ",
            names(&acts(false, true)),
        ),
    );
    push("Out", join("acts below the accuracy: ", names(&acts(false, false))));
    for (switch, role) in &answer.effects {
        if let Role::Neutral { typical, by } = role {
            let values: Vec<String> =
                typical.iter().map(|(row, value)| format!("{} = {}", row.name, units::text(row, *value))).collect();
            let effect = match by {
                Some(by) if *by > answer.within => {
                    format!("would change a wanted quantity by {}: set what your gears have", percent(*by))
                }
                Some(by) => format!("would change a wanted quantity by {}", percent(*by)),
                None => "were not tried".into(),
            };
            push(
                "Neutral",
                format!(
                    "{} acts on nothing, as the scene leaves its values at zero; typical ones, {}, {effect}",
                    switch.name(),
                    values.join(", ")
                ),
            );
        }
    }
    push(
        "Not there",
        join(
            "part of the question, judged only where the scene has it: ",
            names(&|s, role| matches!(role, Role::NotThere).then(|| s.name().into())),
        ),
    );
    push("Set off", join("by the scene: ", names(&|s, role| matches!(role, Role::SetOff).then(|| s.name().into()))));
    push(
        "Not asked",
        join(
            "gives outputs alone, and none of them is wanted: ",
            names(&|s, role| matches!(role, Role::NotAsked).then(|| s.name().into())),
        ),
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

fn join(before: &str, names: String) -> String {
    if names.is_empty() { names } else { format!("{before}{names}") }
}
