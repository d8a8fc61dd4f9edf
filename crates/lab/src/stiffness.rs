//! Stiffness of the contact laws compared with 3-D finite elements of several gears on two supports.

use anyhow::{Result, anyhow};
use bevel_differential::contact::bodies::{MeshOnBodies, Support};
use bevel_differential::contact::stiffness::{PairStiffness, RootSpec};
use bevel_differential::geometry::{AddendumSystem, Pair};

use answers::text::table::Table;
use golden_pairs::{FILLET, Set, sets};

/// Reference values, which the tests of the library share.
#[path = "../../../tests/contact/golden_pairs.rs"]
#[allow(dead_code)] // each program uses only some items
mod golden_pairs;

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

/// Prints the tables as Markdown.
pub fn run() -> Result<()> {
    let head = ["gears", "b/R_e", "held", "`impact`", "`lumped`", "`line`", "bodies"];
    let mut single = Table::new(head).left([0, 2]);
    let head = ["gears", "b/R_e", "held", "`line`", "bodies", "coupling, reference", "coupling, bodies"];
    let mut double = Table::new(head).left([0, 2]);
    for set in sets() {
        let pair = Pair::new(&set.spec);
        let stiffness = PairStiffness::new(&pair, &RootSpec { fillet: FILLET }, YOUNG, POISSON, LINE_LOAD)
            .map_err(|problem| anyhow!("{problem}"))?;
        let mesh =
            MeshOnBodies::new(&pair, &stiffness.teeth, set.supports, 1).map_err(|problem| anyhow!("{problem}"))?;
        let reference = LINE_LOAD / pair.mean_cone;
        let line = |s: f64| stiffness.exact(s, reference).stiffness();
        let impact = impact(&set, &pair);
        let lumped = stiffness.mesh_mean() * pair.base_pitch / (pair.path.high - pair.path.low);
        let offs = |c: &dyn Fn(f64) -> f64| off(set.single.iter().map(|row| c(row[0]) / (row[4] * PER_MM_UM)));
        single.push(name(&set, &pair).into_iter().chain([
            offs(&|_| impact),
            offs(&|_| lumped),
            offs(&line),
            offs(&|s| mesh.alone(s, reference).stiffness()),
        ]));
        let both = |c: &dyn Fn(f64, [f64; 2]) -> f64| {
            off(set.double.iter().map(|&[s, coupled, free]| c(s, [coupled * PER_MM_UM, free * PER_MM_UM])))
        };
        double.push(name(&set, &pair).into_iter().chain([
            both(&|s, [coupled, _]| (line(s) + line(s + pair.base_pitch)) / coupled),
            both(&|s, [coupled, _]| mesh.two_pairs(s, reference)[0] / coupled),
            both(&|_, [coupled, free]| coupled / free),
            both(&|s, _| {
                let [coupled, free] = mesh.two_pairs(s, reference);
                coupled / free
            }),
        ]));
    }
    println!("Single pairs along the path: deviation of c in %, mean (smallest…largest).\n\n{}", single.markdown());
    println!("Two pairs that share a rotation: deviation of c in %, and how much coupling softens them, in %.\n");
    print!("{}", double.markdown());
    Ok(())
}

/// Labels of a set: gears, face width, and support.
fn name(set: &Set, pair: &Pair) -> [String; 3] {
    let spec = &set.spec;
    let system = if spec.addendum_system == AddendumSystem::Iso23509 { "ISO" } else { "Gleason" };
    let held = match set.supports {
        [Support::Bore(planet), Support::Bore(side)] => format!("bores {:.0}/{:.0}", 1e3 * planet, 1e3 * side),
        _ => "root".to_owned(),
    };
    let gears = format!("{}/{} {system}", spec.planet_teeth, spec.side_teeth);
    [gears, format!("{:.2}", spec.face_width / pair.outer_cone), held]
}

/// Secant stiffness of IMPACT under the reference load [Pa]: torque divided by the arc and by ∫R²dR. IMPACT has a
/// single force, which acts at the mean cone distance.
fn impact(set: &Set, pair: &Pair) -> f64 {
    let &Pair { mean_cone, outer_cone, inner_cone, .. } = pair;
    let force = LINE_LOAD * set.spec.face_width;
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
