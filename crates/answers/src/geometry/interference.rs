//! Interference of the gears, as text and JSON: the result of the library's check of the teeth, and a check for
//! collisions of neighbouring gears.
//!
//! Depth, gap and resolution come from `bevel_differential::geometry::solid::interference`, in millimetres at the heel
//! and at the toe. Teeth can be checked with extra thickness, which reduces the backlash by the same amount.

use std::sync::atomic::{AtomicBool, Ordering};

use anyhow::{Context, Result};
use bevel_differential::geometry::assembly::phases;
use bevel_differential::geometry::solid::Part;
use bevel_differential::geometry::solid::interference::{Approach, FACETS, Interference, POSITIONS, Stance, Verdict};
use bevel_differential::geometry::{GearSpec, Pair};
use serde_json::{Value, json};

use super::design::Design;
use crate::progress::Progress;
use crate::text::table::{labelled, wrapped};

const MM: f64 = 1e3;
const INTERFERENCE: &str = "INTERFERENCE";
const GEARS: [&str; 2] = ["planet", "side gear"];
/// Approaches farther than this fraction of the module are left out of the JSON.
const NEAR: f64 = 0.25;

/// Interference check of a design.
pub struct InterferenceCheck {
    pair: Pair,
    spec: GearSpec,
    /// Added thickness of the teeth [m], of both gears together, at the outer pitch circle.
    thicken: f64,
    /// Results with the teeth in the middle of the tooth spaces, and with all backlash taken up on one side.
    stances: [Interference; 2],
}

impl InterferenceCheck {
    /// Checks `design` with teeth thicker by `thicken` [m].
    pub fn new(design: &Design, thicken: f64) -> Result<Self> {
        Self::with_progress(design, thicken, &mut Progress::silent())
    }

    /// Checks `design` with teeth thicker by `thicken` [m]. The caller may stop the check through `progress`.
    pub fn with_progress(design: &Design, thicken: f64, progress: &mut Progress) -> Result<Self> {
        let spec = GearSpec { backlash: design.spec.backlash - thicken, ..design.spec };
        let pair = Pair::new(&spec);
        let stopped = AtomicBool::new(false);
        let look = |stance, go_on: &mut dyn FnMut() -> bool| {
            let found = Interference::stoppable(&pair, &spec, stance, go_on);
            found.context("the gears have no surface to check")
        };
        let (middle, driving) = std::thread::scope(|scope| {
            let driving = scope.spawn(|| look(Stance::Driving, &mut || !stopped.load(Ordering::Relaxed)));
            let middle = look(Stance::Middle, &mut || {
                stopped.store(progress.check_stopped().is_err(), Ordering::Relaxed);
                !stopped.load(Ordering::Relaxed)
            });
            (middle, driving.join())
        });
        progress.check_stopped()?;
        let driving = driving.map_err(|_| anyhow::anyhow!("the interference check stopped"))??;
        Ok(Self { stances: [middle?, driving], pair, spec, thicken })
    }

    /// True if teeth or neighbouring gears overlap.
    pub fn any(&self) -> bool {
        self.stances.iter().any(Interference::any)
    }

    /// Description of the results.
    pub fn text(&self) -> String {
        let mut out = String::from("interference while the gears turn, apexes in one point\n");
        if self.thicken > 0.0 {
            out += &wrapped(&format!(
                "Here teeth are {:.4} mm thicker at the outer pitch circle than they are made: backlash {:.4} mm.",
                self.thicken * MM,
                self.spec.backlash * MM
            ));
        }
        let headings =
            ["Teeth in the middle of the tooth spaces", "Backlash taken up on one side, as gears run", "Neighbours"];
        for (number, (heading, finding)) in (1..).zip(headings.iter().zip(self.findings())) {
            let (result, details) = finding.split_once('\n').unwrap_or((&finding, ""));
            out += &wrapped(&format!("{number}. {heading}: {result}."));
            out += details;
        }
        out += &wrapped(&format!(
            "Checked: {POSITIONS} positions over a tooth pitch of the planet, and more near the worst one; outlines of \
             {FACETS} facets per flank; accurate to {:.4} mm at the heel. {}",
            self.heel(self.stances[0].resolution),
            self.meshes()
        ));
        out
    }

    /// Summary of the result in one line.
    pub fn verdict(&self) -> String {
        if !self.any() {
            return "verdict: no interference, the gears turn freely".into();
        }
        let numbered = (1..).zip(self.findings()).filter(|(_, finding)| finding.starts_with(INTERFERENCE));
        let struck: Vec<String> = numbered.map(|(number, _): (u8, String)| number.to_string()).collect();
        format!("verdict: {INTERFERENCE}, the gears do not turn freely: see {} above", struck.join(" and "))
    }

    /// Findings of the text, in its order. Indented lines with details may follow the first line.
    fn findings(&self) -> [String; 3] {
        let [middle, driving] = &self.stances;
        [self.middle(middle), self.driving(driving), self.neighbours()]
    }

    fn middle(&self, found: &Interference) -> String {
        let Some(worst) = found.worst() else { return "no interference: nothing comes near".into() };
        match found.verdict(worst.gap) {
            Verdict::Interfering => self.entered(found),
            Verdict::Touching => format!("no interference: {} touch within the accuracy of this check", parts(worst)),
            Verdict::Clear => format!(
                "no interference; smallest gap between {}\n{}",
                parts(worst),
                self.details("gap", worst.gap, worst)
            ),
        }
    }

    fn driving(&self, found: &Interference) -> String {
        match found.worst() {
            _ if self.spec.backlash <= 0.0 => "there is no backlash".into(),
            Some(worst) if found.verdict(worst.gap) == Verdict::Interfering => self.entered(found),
            _ => "no interference: flanks only touch".into(),
        }
    }

    /// Parts that penetrate each other, the deepest first.
    fn entered(&self, found: &Interference) -> String {
        let mut entering = found.approaches.iter().filter(|a| found.verdict(a.gap) == Verdict::Interfering);
        let Some(worst) = entering.next() else { return String::new() };
        let mut text = format!("{INTERFERENCE}: {}\n{}", sentence(worst), self.details("depth", -worst.gap, worst));
        for other in entering {
            let depth = -self.heel(other.gap);
            text += &labelled("   ", &format!("Also, {} by up to {depth:.4} mm.", sentence(other)));
        }
        text
    }

    /// Indented lines below a result: the `length` per cone distance, called `what`, at toe and heel, and the position
    /// of the approach.
    fn details(&self, what: &str, length: f64, a: &Approach) -> String {
        let ends = [("toe", self.pair.inner_cone), ("heel", self.pair.outer_cone)].map(|(end, cone)| {
            let label = format!("{what} at {end}:");
            format!("   {label:<15}{:.4} mm (R = {:.4} mm)\n", length * cone * MM, cone * MM)
        });
        ends.concat() + &position(a)
    }

    fn neighbours(&self) -> String {
        let [planets, sides] = self.stances[0].between_tips;
        let mut struck = Vec::new();
        for (angle, what) in [(planets, "neighbouring planets"), (sides, "the two side gears")] {
            if angle < 0.0 {
                let degrees = -angle.to_degrees();
                struck.push(format!("{INTERFERENCE}: the tip cones of {what} overlap by {degrees:.4} deg"));
            }
        }
        if !struck.is_empty() {
            return struck.join("; ");
        }
        let least = planets.min(sides);
        let who = if planets <= sides { "planets" } else { "side gears" };
        format!("no interference; the tip cones of {who} are {:.4} deg apart", least.to_degrees())
    }

    /// Meshes that are in phase.
    fn meshes(&self) -> String {
        // a design has been checked for assembly
        let phases = phases(&self.spec).unwrap_or_default();
        let named = |wanted: f64| -> Vec<String> {
            let all = phases.iter().enumerate().flat_map(|(i, phase)| {
                [(i, "left", phase[0]), (i, "right", phase[1])].into_iter().filter(|mesh| mesh.2 == wanted)
            });
            all.map(|(i, side, _)| format!("planet {} {side}", i + 1)).collect()
        };
        let (first, second) = (named(0.0), named(0.5));
        let same = "All meshes pass through the same positions, so one represents all";
        if second.is_empty() {
            return format!("{same}; they are in step.");
        }
        format!("{same}; in step are {}, and half a pitch later {}.", first.join(", "), second.join(", "))
    }

    /// Converts a length per cone distance into a length at the heel [mm].
    fn heel(&self, per_cone_distance: f64) -> f64 {
        per_cone_distance * self.pair.outer_cone * MM
    }

    /// Results for programs: lengths in mm, angles in degrees.
    pub fn report(&self) -> Value {
        let [middle, driving] = &self.stances;
        let [planets, sides] = middle.between_tips.map(f64::to_degrees);
        json!({
            "found": self.any(),
            "thicken": self.thicken * MM,
            "backlash": self.spec.backlash * MM,
            "middle": self.stance_report(middle),
            "driving": self.stance_report(driving),
            "between_tip_cones_of_neighbouring_planets": planets,
            "between_tip_cones_of_side_gears": sides,
        })
    }

    fn stance_report(&self, found: &Interference) -> Value {
        let near = |a: &&Approach| a.gap * self.pair.outer_cone < NEAR * self.pair.module;
        let verdict = match found.worst().map_or(Verdict::Clear, |worst| found.verdict(worst.gap)) {
            Verdict::Clear => "clear",
            Verdict::Touching => "touching",
            Verdict::Interfering => "interfering",
        };
        let approaches: Value = found.approaches.iter().filter(near).map(|a| self.approach_report(a)).collect();
        json!({"verdict": verdict, "resolution": self.heel(found.resolution), "approaches": approaches})
    }

    fn approach_report(&self, a: &Approach) -> Value {
        json!({
            "planet": part(a.parts[0]),
            "side_gear": part(a.parts[1]),
            "at_heel": self.heel(a.gap),
            "at_toe": a.gap * self.pair.inner_cone * MM,
            "angle_from_planet_axis": a.polar[0].to_degrees(),
            "angle_from_side_gear_axis": a.polar[1].to_degrees(),
            "angle_from_plane_of_axes": a.azimuth.to_degrees(),
            "planet_turned": a.turn.to_degrees(),
            "planet_tooth": a.teeth[0],
            "side_gear_tooth": a.teeth[1],
        })
    }
}

fn part(part: Part) -> &'static str {
    match part {
        Part::Root => "root",
        Part::Fillet => "root fillet",
        Part::Meridian => "flank below the base circle",
        Part::Flank => "flank",
        Part::Tip => "tip",
    }
}

/// Names of the two parts that come near each other.
fn parts(a: &Approach) -> String {
    format!("the planet's {} and the side gear's {}", part(a.parts[0]), part(a.parts[1]))
}

/// Sentence about the penetrating part.
fn sentence(a: &Approach) -> String {
    if a.parts[0] == a.parts[1] {
        return format!("the {}s of planet and side gear overlap", part(a.parts[0]));
    }
    // a tip penetrates; without a tip, the gear whose ray is within the other
    let own = a.parts.iter().position(|&part| part == Part::Tip).unwrap_or(a.ray);
    let mate = 1 - own;
    format!("the {}'s {} enters the {}'s {}", GEARS[own], part(a.parts[own]), GEARS[mate], part(a.parts[mate]))
}

/// Lines about the position of the approach.
fn position(a: &Approach) -> String {
    format!(
        "   position:      {:.2} deg from the planet's axis, {:.2} deg from the side gear's, {:.2} deg out of their plane\n   \
         planet turned: {:.2} deg from a tooth in that plane (planet tooth {}, side gear tooth {})\n",
        a.polar[0].to_degrees(),
        a.polar[1].to_degrees(),
        a.azimuth.to_degrees(),
        a.turn.to_degrees(),
        a.teeth[0],
        a.teeth[1]
    )
}
