//! Stiffness of the contact laws compared with 3-D finite elements of several gears on two supports.

use anyhow::{Context, Result, bail};
use bevel_differential::contact::bodies::{MeshOnBodies, Support};
use bevel_differential::contact::stiffness::{PairStiffness, RootSpec};
use bevel_differential::geometry::{AddendumSystem, GearSpec, Pair};

use answers::text::table::Table;

/// Reference values.
const ROWS: &str = include_str!("../../../tests/data/golden_fe3d_pairs.csv");
/// Fillet radius of the reference [modules].
const FILLET: f64 = 0.40;
/// Young's modulus of the reference [Pa].
const YOUNG: f64 = 2.07e11;
/// Poisson's ratio of the reference.
const POISSON: f64 = 0.25;
/// Line load of the reference [N/m].
const LINE_LOAD: f64 = 400e3;
/// Stiffness of IMPACT in the study [N/m^1.5], and its exponent.
const IMPACT: [f64; 2] = [5.77e5 * 31_622.776_601_683_79, 1.5];
/// Number of Pa in 1 N/(mm·µm).
const PER_MM_UM: f64 = 1e9;

/// Rows of one gear set on one support.
struct Set {
    /// Cells that describe the gear set and its support.
    columns: Vec<String>,
    /// Position s on the path of contact [rad] and stiffness c [Pa] of single pairs.
    single: Vec<[f64; 2]>,
    /// Position s of the first of two pairs [rad], stiffness c of both [Pa], and the ratio of c to the stiffness of two
    /// separate pairs.
    double: Vec<[f64; 3]>,
}

/// A gear set in the representation of this program.
struct Gears {
    spec: GearSpec,
    pair: Pair,
    stiffness: PairStiffness,
    mesh: MeshOnBodies,
}

/// Prints the tables as Markdown.
pub fn run() -> Result<()> {
    print!("{}", page(&sets()?)?);
    Ok(())
}

fn sets() -> Result<Vec<Set>> {
    let mut reader = csv::ReaderBuilder::new().comment(Some(b'#')).from_reader(ROWS.as_bytes());
    let mut sets: Vec<Set> = Vec::new();
    for row in reader.records() {
        let row = row?;
        let number = |i: usize| -> Result<f64> { row[i].parse().with_context(|| format!("column {i} of {row:?}")) };
        let columns: Vec<String> = row.iter().take(9).map(str::to_owned).collect();
        if sets.last().is_none_or(|set| set.columns != columns) {
            sets.push(Set { columns, single: Vec::new(), double: Vec::new() });
        }
        let Some(set) = sets.last_mut() else { continue };
        let s = number(10)?.to_radians();
        match &row[9] {
            "one" => set.single.push([s, number(14)? * PER_MM_UM]),
            "two" => set.double.push([s, number(15)? * PER_MM_UM, number(15)? / number(16)?]),
            other => bail!("no kind \"{other}\""),
        }
    }
    Ok(sets)
}

impl Set {
    /// Gears of the set on their supports.
    fn gears(&self) -> Result<Gears> {
        let number = |i: usize| -> Result<f64> { Ok(self.columns[i].parse()?) };
        let spec = GearSpec {
            module: number(0)? * 1e-3,
            planet_teeth: number(1)? as i32,
            side_teeth: number(2)? as i32,
            pressure_angle: number(3)?.to_radians(),
            addendum_system: match self.columns[5].as_str() {
                "gleason" => AddendumSystem::Gleason,
                "iso" => AddendumSystem::Iso23509,
                other => bail!("no addenda \"{other}\""),
            },
            ..GearSpec::default()
        };
        let spec = GearSpec { face_width: number(4)? * Pair::new(&spec).outer_cone, ..spec };
        let pair = Pair::new(&spec);
        let root = RootSpec { fillet: FILLET };
        let stiffness = PairStiffness::new(&pair, &root, YOUNG, POISSON, LINE_LOAD)
            .map_err(|problem| anyhow::anyhow!("{problem}"))?;
        let supports = match self.columns[6].as_str() {
            "tooth" => [Support::NearRoot; 2],
            // the reference contains radii
            "full" => [Support::Bore(2e-3 * number(7)?), Support::Bore(2e-3 * number(8)?)],
            other => bail!("no support \"{other}\""),
        };
        let mesh =
            MeshOnBodies::new(&pair, &stiffness.teeth, supports, 1).map_err(|problem| anyhow::anyhow!("{problem}"))?;
        Ok(Gears { spec, pair, stiffness, mesh })
    }

    /// Labels of the set: gears, face width, and support.
    fn name(&self, gears: &Gears) -> [String; 3] {
        let c = &self.columns;
        let face = gears.spec.face_width / gears.pair.outer_cone;
        let held = match c[6].as_str() {
            "tooth" => "root".to_owned(),
            _ => format!("bores {}/{}", diameter(&c[7]), diameter(&c[8])),
        };
        let system = if c[5] == "iso" { "ISO" } else { "Gleason" };
        [format!("{}/{} {system}", c[1], c[2]), format!("{face:.2}"), held]
    }
}

/// Diameter as text, from the text of a radius.
fn diameter(radius: &str) -> String {
    radius.parse().map_or_else(|_| radius.to_owned(), |radius: f64| format!("{}", 2.0 * radius))
}

/// All tables.
fn page(sets: &[Set]) -> Result<String> {
    let head = ["gears", "b/R_e", "held", "`impact`", "`lumped`", "`line`", "bodies"];
    let mut single = Table::new(head).left([0, 2]);
    let mut double =
        Table::new(["gears", "b/R_e", "held", "`line`", "bodies", "coupling, reference", "coupling, bodies"])
            .left([0, 2]);
    for set in sets {
        let gears = set.gears()?;
        let reference = LINE_LOAD / gears.pair.mean_cone;
        let impact = impact(&gears);
        let lumped = gears.stiffness.mesh_mean() * gears.pair.base_pitch / (gears.pair.path.high - gears.pair.path.low);
        let offs = |c: &dyn Fn(f64) -> f64| off(set.single.iter().map(|&[s, expected]| c(s) / expected));
        single.push(set.name(&gears).into_iter().chain([
            offs(&|_| impact),
            offs(&|_| lumped),
            offs(&|s| gears.stiffness.exact(s, reference).stiffness()),
            offs(&|s| gears.mesh.alone(s, reference).stiffness()),
        ]));
        let both: Vec<[f64; 3]> = set
            .double
            .iter()
            .map(|&[s, ..]| {
                let by_line: f64 = [s, s + gears.pair.base_pitch]
                    .iter()
                    .map(|&s| gears.stiffness.exact(s, reference).stiffness())
                    .sum();
                let [coupled, uncoupled] = gears.mesh.two_pairs(s, reference);
                [by_line, coupled, coupled / uncoupled]
            })
            .collect();
        let ratio = |k: usize| off(both.iter().zip(&set.double).map(|(found, expected)| found[k] / expected[1]));
        let coupling = |values: Vec<f64>| off(values.into_iter());
        double.push(set.name(&gears).into_iter().chain([
            ratio(0),
            ratio(1),
            coupling(set.double.iter().map(|row| row[2]).collect()),
            coupling(both.iter().map(|found| found[2]).collect()),
        ]));
    }
    Ok(format!(
        "Single pairs along the path: deviation of c in %, mean (smallest…largest).\n\n{}\n\
         Two pairs that share a rotation: deviation of c in %, and how much coupling softens them, in %.\n\n{}",
        single.markdown(),
        double.markdown()
    ))
}

/// Secant stiffness of IMPACT under the reference load [Pa]: torque divided by the arc and by ∫R²dR. IMPACT has a
/// single force, which acts at the mean cone distance.
fn impact(gears: &Gears) -> f64 {
    let Pair { mean_cone, outer_cone, inner_cone, .. } = gears.pair;
    let force = LINE_LOAD * gears.spec.face_width;
    let depth = (force / IMPACT[0]).powf(1.0 / IMPACT[1]);
    let moment = (outer_cone.powi(3) - inner_cone.powi(3)) / 3.0;
    force * mean_cone * mean_cone / (depth * moment)
}

/// Mean, smallest and largest value of ratios, as differences from 1 in per cent.
fn off(ratios: impl Iterator<Item = f64> + Clone) -> String {
    let percent = ratios.map(|ratio| 100.0 * (ratio - 1.0));
    let count = percent.clone().count() as f64;
    let (low, high, sum) =
        percent.fold((f64::INFINITY, f64::NEG_INFINITY, 0.0), |(low, high, sum), x| (low.min(x), high.max(x), sum + x));
    format!("{:+.1} ({low:+.1}…{high:+.1})", sum / count)
}
