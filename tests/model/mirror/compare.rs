//! Compares a course with the course of an image, as long as twins that are disturbed by 1e-15 stay close.

use bevel_differential::variables::Variable;

use super::image::Mapped;
use super::scene::{Course, Scene, output, outputs};
use super::table::{line_of, lines};

/// Allowed deviation of an output, as a fraction of its scale.
pub const CLOSE: f64 = 1e-9;
/// Allowed deviation after a switch of dry friction.
pub const CLOSE_AT_SWITCHES: f64 = 1e-6;
/// Allowed deviation of the step size after a switch of dry friction. The step size depends on the difference of two
/// solutions, which has only a few significant digits.
const CLOSE_IN_SIZE: f64 = 1e-4;
/// Fraction of the allowed deviation within which the twins must stay.
const TWIN: f64 = 0.01;
/// Allowed deviation of motions that result from different steps, in tolerances of the solver.
const TOLERANCES: f64 = 10.0;
/// Allowed deviation of quantities that follow from accelerations, if steps differ. Meshes ring at 8 kHz, which
/// amplifies errors of speeds a hundred times.
const RINGING: f64 = 1000.0;
/// Units whose outputs share a scale, the largest value among them. Other outputs have the scale of their entry in the
/// table.
const SHARED: [&str; 7] = ["rad/s", "rad/s2", "N", "N.m", "W", "J", "Pa"];

/// Findings of a comparison.
#[derive(Default)]
pub struct Findings {
    /// Number of scenes compared.
    pub scenes: usize,
    /// Number of values compared and number of all values, by line of the table.
    pub compared: Vec<[usize; 2]>,
    /// Number of compared values that are not 0, by line of the table.
    pub telling: Vec<usize>,
    /// Number of scenes whose image takes other steps than the scene and its twins.
    pub with_other_steps: usize,
    /// Descriptions of outputs that do not map.
    pub wrong: Vec<String>,
    /// Largest accepted deviations: before switches of dry friction, after switches, and after different steps.
    pub largest: [f64; 3],
}

impl Findings {
    pub fn new() -> Self {
        Self { compared: vec![[0; 2]; lines().len()], telling: vec![0; lines().len()], ..Self::default() }
    }

    /// Fraction of all values that was compared.
    pub fn share(&self) -> f64 {
        let [compared, all] = self.compared.iter().fold([0; 2], |[a, b], [c, d]| [a + c, b + d]);
        compared as f64 / all.max(1) as f64
    }

    pub fn add(&mut self, other: Self) {
        for i in 0..self.compared.len() {
            self.telling[i] += other.telling[i];
            (0..2).for_each(|k| self.compared[i][k] += other.compared[i][k]);
        }
        self.scenes += other.scenes;
        self.with_other_steps += other.with_other_steps;
        self.wrong.extend(other.wrong);
        (0..3).for_each(|k| self.largest[k] = self.largest[k].max(other.largest[k]));
    }
}

fn unit(row: &Variable) -> &'static str {
    row.unit.map_or("", |unit| unit.name)
}

/// Kind of quantity of an output: its unit, or its entry in the table.
fn kind(row: &Variable) -> &'static str {
    let shared = SHARED.iter().find(|&&shared| shared == unit(row));
    shared.copied().unwrap_or_else(|| line_of(row.name).map_or("", |line| lines()[line].pattern))
}

/// Scale of each output: the largest magnitude of its kind of quantity over the run.
fn scales(scene: &Scene, course: &Course) -> Vec<f64> {
    let largest = |i: usize| course.values.iter().fold(0.0f64, |most, values| most.max(values[i].abs()));
    let kinds: Vec<&str> = outputs().iter().map(|row| kind(row)).collect();
    // the scale of energies includes the converted energy and the kinetic energy of the carrier
    let power = [output("power.in"), output("power.out")];
    let turned: f64 = (1..course.times.len())
        .map(|k| (course.times[k] - course.times[k - 1]) * power.map(|i| course.values[k][i].abs()).iter().sum::<f64>())
        .sum();
    let carried = 0.5 * scene.parameters.inertia.carrier * largest(output("carrier.speed")).powi(2);
    (0..kinds.len())
        .map(|i| {
            let of_kind = (0..kinds.len()).filter(|&j| kinds[j] == kinds[i]).map(largest).fold(0.0, f64::max);
            if kinds[i] == "J" { of_kind.max(turned + carried) } else { of_kind }
        })
        .collect()
}

/// Compares the image of `base` with the values expected by `map`, as long as the twins stay close.
pub fn compare(scene: &Scene, base: &Course, twins: &[Course], image: &Course, map: &[Mapped]) -> Findings {
    let mut found = Findings { scenes: 1, ..Findings::new() };
    let scales = scales(scene, base);
    let steps = base.values.len();
    let reached = twins.iter().map(|twin| twin.values.len()).fold(steps, usize::min);
    let same_end = twins.iter().all(|twin| twin.values.len() == steps);
    if same_end && image.values.len() != steps {
        found.wrong.push(format!("ends at {:?}, not at {:?}", image.times.last(), base.times.last()));
    }
    let reached = reached.min(image.values.len());
    // rounding may decide whether a step is repeated; from then on, results agree within the accuracy of the solver
    let counts = [output("solver.steps"), output("solver.rejected")];
    let differs = |other: &Course, k: usize| counts.iter().any(|&i| other.values[k][i] != base.values[k][i]);
    let apart = (0..reached).find(|&k| differs(image, k)).unwrap_or(reached);
    found.with_other_steps =
        usize::from(apart < reached && !twins.iter().any(|twin| (0..=apart).any(|k| differs(twin, k))));
    let switched = twins.iter().chain([base, image]).fold(usize::MAX, |first, course| first.min(course.switched));
    // a kink is located to some 1e-5 of a step, so rounding may also change the size of a step
    let size = output("solver.step_size");
    let is_resized = |k: usize| {
        image.values[k][size] != 0.0 && (base.values[k][size] / image.values[k][size] - 1.0).abs() > CLOSE_AT_SWITCHES
    };
    let resized = (switched..apart).find(|&k| is_resized(k)).unwrap_or(apart);
    let close = |k: usize| if k < switched { CLOSE } else { CLOSE_AT_SWITCHES };
    // number of values for which the twins stay close in an output
    let near = |i: usize| {
        let far = |k: usize, twin: &Course| {
            (twin.values[k][i] - base.values[k][i]).abs() > TWIN * close(k) * scales[i].max(f64::MIN_POSITIVE)
        };
        (0..reached).find(|&k| twins.iter().any(|twin| far(k, twin))).unwrap_or(reached)
    };
    for (i, row) in outputs().iter().enumerate() {
        let Some(line) = line_of(row.name) else { continue };
        let Mapped { output: to, factor, added, magnitude } = map[i];
        // the number of pairs is uncertain if a mesh is almost unloaded, and after different steps: slices of a face
        // come and go simultaneously, even under very small forces
        let load = row.name.strip_suffix("_pairs").map(|mesh| output(&format!("{mesh}_normal_force")));
        let carries = |k: usize, load: usize| base.values[k][load] > close(k) * scales[load];
        let certain = |k: usize| load.is_none_or(|load| k < apart && carries(k, load));
        let scale = scales[i].max(f64::MIN_POSITIVE);
        let is_motion = matches!(unit(row), "rad" | "rad/s");
        let tolerances = if is_motion { TOLERANCES } else { RINGING };
        let promised = tolerances * scene.parameters.solver.relative_tolerance;
        // counts of steps do not show how close the twins are, but the step size does
        let is_count = row.name.starts_with("solver.");
        let window = if is_count { near(i).min(near(output("solver.step_size"))).min(apart) } else { near(i) };
        found.compared[line][0] += window;
        found.compared[line][1] += steps;
        for k in (0..window).filter(|&k| certain(k)) {
            let (expected, actual) = (factor * base.values[k][i] + added, image.values[k][to]);
            let actual = if magnitude { actual.abs() } else { actual };
            found.telling[line] += usize::from(base.values[k][i] != 0.0);
            let deviation = (actual - expected).abs() / (factor.abs() * scale);
            let limit = match row.name {
                "solver.step_size" if k >= switched => CLOSE_IN_SIZE,
                _ if k < resized => close(k),
                _ => close(k).max(promised),
            };
            if deviation > limit || deviation.is_nan() {
                found.wrong.push(format!(
                    "{} at {:.5} s: {actual:e} in place of {expected:e}, {deviation:.1e} of its scale",
                    row.name, base.times[k]
                ));
                break;
            }
            let at = if k >= apart { 2 } else { usize::from(k >= switched) };
            found.largest[at] = found.largest[at].max(deviation);
        }
    }
    found
}
