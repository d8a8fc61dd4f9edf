//! Dimensions of a design as text: aligned tables, Tredgold's planar approximation, warnings and remarks.

use bevel_differential::problem::Problem;

use super::design::Design;
use super::dimensions::{Dimension, DimensionGroup, of_gears, of_pair};
use super::tredgold::comparisons;
use crate::text::table::{Table, wrapped};

/// Dimensions, planar approximation, warnings and remarks of `design`.
pub fn text(design: &Design) -> String {
    format!("{}\n{}{}", dimensions(design), listed("warnings", &design.warnings), listed("remarks", &design.remarks))
}

/// Dimensions and planar approximation of `design`.
pub fn dimensions(design: &Design) -> String {
    let mut out = String::from("Straight bevel gears of a differential, spherical-involute flanks\n");
    out.push_str(&wrapped(&set(design)));
    out.push_str(&wrapped(
        "Lengths in mm, angles in deg, outer = at the heel (large end), inner = at the toe (small end). Column ISO: the \
         standard that the term is taken from, ISO 23509:2016 for bevel gears or ISO 10300-1 for virtual cylindrical gears.",
    ));
    let gears = of_gears();
    out.push_str(&grouped(&["symbol", "planet", "side gear", "unit", "ISO", "meaning"], &gears, |row| {
        [0, 1].map(|i| row.kind.text(row.shown(design, i))).to_vec()
    }));
    let pair = of_pair();
    out.push_str(&grouped(&["symbol", "pair", "unit", "ISO", "meaning"], &pair, |row| {
        vec![row.kind.text(row.shown(design, 0))]
    }));
    out.push('\n');
    out.push_str(&planar(design));
    out
}

/// Sentence that names the parameters set by the user.
fn set(design: &Design) -> String {
    if design.settings.is_empty() {
        return "All parameters have the FMU's start values.".into();
    }
    let set: Vec<String> =
        design.settings.iter().map(|setting| format!("{} = {}", setting.row.name, setting.text())).collect();
    format!("Set: {}. All others have the FMU's start values.", set.join(", "))
}

/// Rows of all groups in common columns, each group under its title.
fn grouped(head: &[&str], groups: &[DimensionGroup], values: impl Fn(&Dimension) -> Vec<String>) -> String {
    let last = head.len() - 1;
    let mut table = Table::new(head.iter().copied()).left([0, last - 2, last - 1, last]);
    for row in groups.iter().flat_map(|group| &group.rows) {
        let mut cells = vec![row.symbol.to_owned()];
        cells.extend(values(row));
        cells.extend([unit(row), standard(row), format!("{}: {}", row.term(), row.meaning)]);
        table.push(cells);
    }
    let all = table.terminal();
    let mut lines = all.lines();
    let mut out = String::new();
    let mut copy =
        |out: &mut String, count: usize| lines.by_ref().take(count).for_each(|line| *out += &format!("{line}\n"));
    out.push('\n');
    copy(&mut out, 2);
    for group in groups {
        out.push_str(&format!("\n{}\n", group.title));
        copy(&mut out, group.rows.len());
    }
    out
}

fn unit(row: &Dimension) -> String {
    row.kind.unit().replace('1', "")
}

fn standard(row: &Dimension) -> String {
    row.standard.map_or_else(|| "-".into(), |name| name.trim_start_matches("ISO ").into())
}

fn planar(design: &Design) -> String {
    let mut table = Table::new(["quantity", "exact", "Tredgold", "unit", "error"]).left([0, 3]);
    for found in comparisons(design) {
        let show = |value: f64| found.kind.text(found.kind.shown(value));
        table.push([
            found.key.replace('_', " "),
            show(found.exact),
            show(found.planar),
            found.kind.unit().replace('1', ""),
            found.error().map_or_else(|| "-".into(), |error| format!("{:+.2} %", error * 100.0)),
        ]);
    }
    let title = wrapped(
        "Tredgold's approximation (virtual spur gears on the back cones) and the exact geometry on the sphere. Lengths are at \
         the heel. A negative start of the active profile means undercut.",
    );
    format!("{title}\n{}", table.terminal())
}

/// A numbered list of `found` under a title.
fn listed(title: &str, found: &[Problem]) -> String {
    if found.is_empty() {
        return format!("no {title}\n");
    }
    let lines = found.iter().enumerate().map(|(i, problem)| wrapped(&format!("{}. {problem}", i + 1)));
    format!("{title}\n{}", lines.collect::<String>())
}
