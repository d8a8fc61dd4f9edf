//! The face of a tooth pair as its load has it: the part that carries, and the points over which loads are summed.
//!
//! A slice at cone distance R penetrates by the arc p = A − e(R, s)/R with the opening e = E + turn R + bend R² of the
//! flanks ([`Opening`]). R p is a polynomial of second degree and bend is not negative, so that the part of the face that
//! carries is one interval, on each side of a broken tooth's edge. Its ends follow in closed form.
//!
//! Under a linear law the energy is a polynomial of fourth degree in R, for which four of Gauss's points on that interval are
//! exact: the load grows and falls as smoothly as flanks come together, and force and energy belong to each other to the last
//! digit.
//!
//! Under any other law the load is smooth where it is not near zero, and eight of Gauss's points have it to 5·10⁻¹⁰. Where it
//! falls to zero at an end, or would within a quarter of the part's length past it, a law such as `line_weber` goes as
//! x/ln(1/x) there. Twelve points that crowd at the ends have the load to 10⁻⁸, at every length of the part. With
//! R = middle + half g(t), g = (15t − 10t³ + 3t⁵)/8, x goes as (1 ∓ t)³ at the ends and dR as (1 − t²)², and t runs over
//! Gauss's points for that weight (Jacobi's polynomials P⁽²'²⁾). The ends of a part move with the load and take its points
//! along; a sum's derivative contains how they do ([`Moves`]).

use super::{Opening, Slice};
use crate::numeric::sqrt;

/// Gauss–Legendre points and weights on [−1, 1], four of them (M. Abramowitz, I. A. Stegun, table 25.4).
const GAUSS: [(f64, f64); POINTS] = [
    (-0.861_136_311_594_052_6, 0.347_854_845_137_453_86),
    (-0.339_981_043_584_856_26, 0.652_145_154_862_546_1),
    (0.339_981_043_584_856_26, 0.652_145_154_862_546_1),
    (0.861_136_311_594_052_6, 0.347_854_845_137_453_86),
];
/// Points over the part of a face that carries under a linear law.
const POINTS: usize = 4;

/// The same, eight of them.
const GAUSS_EIGHT: [(f64, f64); EIGHT] = [
    (-0.960_289_856_497_536_3, 0.101_228_536_290_376_26),
    (-0.796_666_477_413_626_7, 0.222_381_034_453_374_47),
    (-0.525_532_409_916_329, 0.313_706_645_877_887_3),
    (-0.183_434_642_495_649_8, 0.362_683_783_378_362),
    (0.183_434_642_495_649_8, 0.362_683_783_378_362),
    (0.525_532_409_916_329, 0.313_706_645_877_887_3),
    (0.796_666_477_413_626_7, 0.222_381_034_453_374_47),
    (0.960_289_856_497_536_3, 0.101_228_536_290_376_26),
];
/// Points over a whole face.
const EIGHT: usize = 8;

/// Twelve that crowd at the ends: g and its weights at the zeros t of P₁₂⁽²'²⁾.
const CROWDED: [(f64, f64); MOST] = [
    (-0.999_419_541_897_761_4, 0.002_228_893_991_661_38),
    (-0.990_150_086_695_944_9, 0.021_049_674_820_056_04),
    (-0.943_761_930_424_009_3, 0.080_007_531_037_234_99),
    (-0.813_705_964_245_024_4, 0.186_861_689_141_318_19),
    (-0.563_589_241_954_168_3, 0.311_993_103_696_458_38),
    (-0.202_934_027_166_751_85, 0.397_859_107_313_271_01),
    (0.202_934_027_166_751_85, 0.397_859_107_313_271_01),
    (0.563_589_241_954_168_3, 0.311_993_103_696_458_38),
    (0.813_705_964_245_024_4, 0.186_861_689_141_318_19),
    (0.943_761_930_424_009_3, 0.080_007_531_037_234_99),
    (0.990_150_086_695_944_9, 0.021_049_674_820_056_04),
    (0.999_419_541_897_761_4, 0.002_228_893_991_661_38),
];
/// Points near whose ends loads vanish.
const MOST: usize = 12;
/// How far past the ends of a face its load is still not zero where eight points serve, by the face's length.
const CLEAR: f64 = 0.25;

/// A point of the sum over the face.
#[derive(Clone, Copy, Debug, Default)]
pub struct Node {
    /// Cone distance R [m].
    pub cone: f64,
    /// 1/R [1/m].
    pub per_cone: f64,
    /// Its share of ∫R² dR [m³] (of the whole where the law has one resultant for the face).
    pub weight: f64,
    /// Width over which its force is spread [m].
    pub width: f64,
}

impl From<Slice> for Node {
    fn from(slice: Slice) -> Self {
        Self { cone: slice.cone, per_cone: 1.0 / slice.cone, weight: slice.weight, width: slice.width }
    }
}

/// The face of a tooth pair.
#[derive(Clone, Copy, Debug)]
pub enum Face {
    /// A law with one resultant for the face.
    Whole(Node),
    /// A linear law that holds at every cone distance between two ends [m]; its points where all of it carries.
    Cut([f64; 2], [Node; POINTS]),
    /// Any law that holds at every cone distance between two ends [m]; its points where all of it carries by far.
    Sliced([f64; 2], [Node; EIGHT]),
}

/// The points of a rule over a part of the face.
#[inline(always)]
fn nodes<const N: usize>(rule: &[(f64, f64); N], [from, to]: [f64; 2]) -> [Node; N] {
    let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
    rule.map(|(x, w)| {
        let (cone, width) = (middle + half * x, half * w);
        Node { cone, per_cone: 1.0 / cone, weight: width * cone * cone, width }
    })
}

impl Face {
    /// A face between cone distances `inner` and `outer` [m] under a linear law.
    pub fn cut(inner: f64, outer: f64) -> Self {
        Self::Cut([inner, outer], nodes(&GAUSS, [inner, outer]))
    }

    /// A face between cone distances `inner` and `outer` [m] under any law.
    pub fn sliced(inner: f64, outer: f64) -> Self {
        Self::Sliced([inner, outer], Self::gauss_points([inner, outer]))
    }

    /// Eight of Gauss's points over a whole face between two cone distances [m].
    pub fn gauss_points(ends: [f64; 2]) -> [Node; EIGHT] {
        nodes(&GAUSS_EIGHT, ends)
    }

    /// A face whose law has its resultant at one slice.
    pub fn whole(slice: Slice) -> Self {
        Self::Whole(slice.into())
    }

    /// Whether loads differ over it.
    pub fn is_cut(&self) -> bool {
        self.ends().is_some()
    }

    /// Its ends [m], where loads differ over it.
    pub fn ends(&self) -> Option<[f64; 2]> {
        match self {
            Self::Whole(_) => None,
            Self::Cut(ends, _) | Self::Sliced(ends, _) => Some(*ends),
        }
    }

    /// Points of the sum over all of it.
    pub fn points(&self) -> usize {
        match self {
            Self::Whole(_) => 1,
            Self::Cut(..) => POINTS,
            Self::Sliced(..) => EIGHT,
        }
    }

    /// Its innermost cone distance that carries [m].
    pub fn inner(&self) -> f64 {
        match self {
            Self::Whole(node) => node.cone,
            Self::Cut([inner, _], _) | Self::Sliced([inner, _], _) => *inner,
        }
    }

    /// Sum of all weights, and the cone distance of the resultant of error-free teeth [m].
    pub fn moment(&self) -> (f64, f64) {
        match self {
            Self::Whole(node) => (node.weight, node.cone),
            Self::Cut([inner, outer], _) | Self::Sliced([inner, outer], _) => {
                let moment = (outer * outer * outer - inner * inner * inner) / 3.0;
                (moment, moment / (0.5 * (outer * outer - inner * inner)))
            }
        }
    }

    /// Width over which the force of the whole face is spread [m].
    pub fn width(&self) -> f64 {
        match self {
            Self::Whole(node) => node.width,
            // a load ωR has the line load ω R_F at the resultant
            Self::Cut([inner, outer], _) | Self::Sliced([inner, outer], _) => {
                0.5 * (outer * outer - inner * inner) / self.moment().1
            }
        }
    }

    /// The parts that carry at the approach `arc` [rad]: sound, and broken. `cut` is room for the points of what is cut.
    #[inline(always)]
    pub fn loaded<'a>(&'a self, arc: f64, opening: &Opening, cut: &'a mut Cut) -> [Part<'a>; 2] {
        let a = arc - opening.turn;
        let [even, bend] = [opening.even.v, opening.bend];
        match self {
            Self::Whole(node) => {
                let even = match opening.edge {
                    Some((edge, depth)) if node.cone > edge => even + depth,
                    _ => even,
                };
                let all: &[Node] = if carries(a, even, bend, node.cone) { std::slice::from_ref(node) } else { &[] };
                [Part { nodes: all, even, moves: None }, Part::NONE]
            }
            Self::Cut(ends, all) => parts(*ends, opening, a, &mut cut.exact, |even, span, room| match span {
                Some(span) if span.ends == *ends => Part { nodes: all, even, moves: None },
                // the sums are exact wherever their points are
                Some(span) => Part { nodes: room.insert(nodes(&GAUSS, span.ends)), even, moves: None },
                None => Part::NONE,
            }),
            Self::Sliced(ends, all) => parts(*ends, opening, a, &mut cut.crowded, |even, span, room| {
                let Some(span) = span else { return Part::NONE };
                let past = CLEAR * (ends[1] - ends[0]);
                let is_clear = |r: f64| carries(a, even, bend, r);
                if span.ends == *ends && is_clear(ends[0] - past) && is_clear(ends[1] + past) {
                    return Part { nodes: all, even, moves: None };
                }
                let moves = (span.by_arc != [0.0; 2]).then(|| Moves::new(&span));
                Part { nodes: room.insert(nodes(&CROWDED, span.ends)), even, moves }
            }),
        }
    }
}

/// The sound and the broken part of a face between `ends` at the approach `a` less the turn, each as `part` makes it of E,
/// what carries, and its room.
#[inline(always)]
fn parts<'a, R>(
    ends: [f64; 2],
    opening: &Opening,
    a: f64,
    [first, second]: &'a mut [R; 2],
    part: impl Fn(f64, Option<Span>, &'a mut R) -> Part<'a>,
) -> [Part<'a>; 2] {
    let [even, bend] = [opening.even.v, opening.bend];
    let Some((edge, depth)) = opening.edge else {
        return [part(even, carrying(a, even, bend, ends), first), Part::NONE];
    };
    let ([inner, outer], edge) = (ends, edge.clamp(ends[0], ends[1]));
    let sound = if inner < edge { carrying(a, even, bend, [inner, edge]) } else { None };
    let beyond = even + depth;
    let broken = if edge < outer { carrying(a, beyond, bend, [edge, outer]) } else { None };
    [part(even, sound, first), part(beyond, broken, second)]
}

/// Room for points of parts that are cut.
#[derive(Clone, Copy, Debug, Default)]
pub struct Cut {
    exact: [Option<[Node; POINTS]>; 2],
    crowded: [Option<[Node; MOST]>; 2],
}

/// What carries of a face.
#[derive(Clone, Copy, Debug)]
struct Span {
    /// Its ends [m].
    ends: [f64; 2],
    /// By how much they move with the approach, ∂R/∂A [m/rad]; 0 at an edge.
    by_arc: [f64; 2],
}

/// How the points of a part move with its ends, by the approach A and the opening E of the pair.
///
/// At an end that the load moves p(R; A, E) = 0, so that it moves by dR = −(dA − dE/R)/p′.
#[derive(Clone, Copy, Debug)]
pub struct Moves {
    from: f64,
    per_length: f64,
    /// ∂R/∂A and ∂R/∂E of both ends.
    ends: [[f64; 2]; 2],
    /// By how much the part stretches, by its length.
    stretch: [f64; 2],
}

impl Moves {
    fn new(span: &Span) -> Self {
        let [from, to] = span.ends;
        let per_length = 1.0 / (to - from);
        let [low, high] = [0, 1].map(|i| [span.by_arc[i], -span.by_arc[i] / span.ends[i]]);
        let stretch = [0, 1].map(|by| (high[by] - low[by]) * per_length);
        Self { from, per_length, ends: [low, high], stretch }
    }

    /// By A and by E: how far the point at `cone` moves, and by how much the width that it stands for grows.
    #[inline(always)]
    pub fn at(&self, cone: f64) -> [[f64; 2]; 2] {
        let along = (cone - self.from) * self.per_length;
        let [low, high] = self.ends;
        [0, 1].map(|by| [low[by] + along * (high[by] - low[by]), self.stretch[by]])
    }
}

/// A part of the face that carries.
#[derive(Clone, Copy, Debug)]
pub struct Part<'a> {
    /// Its points.
    pub nodes: &'a [Node],
    /// E there [m].
    pub even: f64,
    /// How they move, where sums over them are not exact.
    pub moves: Option<Moves>,
}

impl<'a> Part<'a> {
    /// Nothing.
    pub const NONE: Self = Self { nodes: &[], even: 0.0, moves: None };

    /// All of it in one point.
    #[inline(always)]
    pub fn of(node: &'a Node) -> Self {
        Self { nodes: std::slice::from_ref(node), even: 0.0, moves: None }
    }

    /// Whether nothing carries.
    #[inline(always)]
    pub fn is_empty(&self) -> bool {
        self.nodes.is_empty()
    }
}

/// Whether the face carries at the cone distance `r`.
#[inline(always)]
fn carries(a: f64, even: f64, bend: f64, r: f64) -> bool {
    a * r - even - bend * r * r > 0.0
}

/// The part of [from, to] on which a R − E − bend R² is positive, bend ≥ 0.
#[inline(always)]
fn carrying(a: f64, even: f64, bend: f64, [from, to]: [f64; 2]) -> Option<Span> {
    match (carries(a, even, bend, from), carries(a, even, bend, to)) {
        (true, true) => Some(Span { ends: [from, to], by_arc: [0.0; 2] }),
        (lower, upper) => part(a, even, bend, [from, to], [lower, upper]),
    }
}

/// The same where not all of it carries.
#[inline(never)]
fn part(a: f64, even: f64, bend: f64, [from, to]: [f64; 2], carries: [bool; 2]) -> Option<Span> {
    let square = a * a - 4.0 * bend * even;
    // between the ends it carries where the parabola's top is
    if carries == [false; 2] && !(square > 0.0 && a > 2.0 * bend * from && a < 2.0 * bend * to) {
        return None;
    }
    // roots without cancellation; where there is but one, the other is not asked for
    let root = sqrt(square.max(0.0));
    let larger = 0.5 * (a.abs() + root);
    let [low, high] = if a > 0.0 { [even / larger, larger / bend] } else { [f64::NEG_INFINITY, -even / larger] };
    let end = |at_edge: bool, edge: f64, way: f64, r: f64| {
        if at_edge || !(r > from && r < to) {
            return [if at_edge { edge } else { r.clamp(from, to) }, 0.0];
        }
        // R p has the slope ±√square at its roots
        [r, if root > 0.0 { way * r / root } else { 0.0 }]
    };
    let [low, high] = [end(carries[0], from, -1.0, low), end(carries[1], to, 1.0, high)];
    (low[0] < high[0]).then_some(Span { ends: [low[0], high[0]], by_arc: [low[1], high[1]] })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numeric::{Jet, Scalar};

    const FACE: [f64; 2] = [22.4e-3, 42.4e-3];

    fn opening(even: f64, turn: f64, bend: f64, edge: Option<(f64, f64)>) -> Opening {
        Opening { even: Jet::constant(even), turn, bend, edge }
    }

    /// ∫R² max(p, 0)^n dR by many middles.
    fn fine(a: f64, o: &Opening, n: i32) -> f64 {
        let count = 200_000;
        let width = (FACE[1] - FACE[0]) / f64::from(count);
        (0..count)
            .map(|i| {
                let r = FACE[0] + width * (f64::from(i) + 0.5);
                let p = a - o.at(r) / r;
                if p > 0.0 { width * r * r * p.powi(n) } else { 0.0 }
            })
            .sum()
    }

    #[test]
    fn torque_and_energy_of_linear_teeth_are_those_of_a_fine_sum_wherever_the_face_carries() {
        let face = Face::cut(FACE[0], FACE[1]);
        let mut parts = [0; 3];
        for a in [-4e-4, 2e-4, 6e-4, 1e-3] {
            for even in [-3e-5, 0.0, 1e-5, 2.5e-5] {
                for turn in [-2e-4, 0.0, 3e-4] {
                    for bend in [0.0, 5e-3, 0.1] {
                        for edge in [None, Some((30e-3, 5e-6)), Some((35e-3, 1e-3))] {
                            let o = opening(even, turn, bend, edge);
                            for n in [1, 2] {
                                let (mut sum, mut visits) = (0.0, 0);
                                for part in face.loaded(a, &o, &mut Cut::default()) {
                                    visits += usize::from(!part.is_empty());
                                    for j in part.nodes {
                                        let p = a - turn - part.even * j.per_cone - bend * j.cone;
                                        assert!(p > -1e-15);
                                        sum += j.weight * p.powi(n);
                                    }
                                }
                                parts[visits] += 1;
                                let fine = fine(a, &o, n);
                                let scale = fine + 1e-8 * face.moment().0 * 1e-3f64.powi(n);
                                assert!((sum - fine).abs() < 2e-5 * scale, "{a} {o:?} {n}: {sum:e} {fine:e}");
                            }
                        }
                    }
                }
            }
        }
        assert!(parts.iter().all(|&n| n > 20), "{parts:?}");
    }

    #[test]
    fn points_that_crowd_at_the_ends_are_those_of_gauss_s_rule_for_their_weight() {
        let g = |t: f64| (15.0 * t - 10.0 * t.powi(3) + 3.0 * t.powi(5)) / 8.0;
        // with twelve points powers of t up to the 23rd are exact: ∫t^k dg = 15/8 ∫t^k (1 − t²)² dt
        let exact = |k: f64| 3.75 * (1.0 / (k + 1.0) - 2.0 / (k + 3.0) + 1.0 / (k + 5.0));
        for power in 0..24 {
            let sum: f64 = CROWDED
                .iter()
                .map(|&(x, w)| {
                    let (mut low, mut high) = (-1.0, 1.0);
                    for _ in 0..80 {
                        let t = 0.5 * (low + high);
                        if g(t) < x { low = t } else { high = t }
                    }
                    w * low.powi(power)
                })
                .sum();
            let exact = if power % 2 == 0 { exact(f64::from(power)) } else { 0.0 };
            assert!((sum - exact).abs() < 1e-14, "{power}: {sum:e} {exact:e}");
        }
    }

    #[test]
    fn the_whole_face_has_the_closed_form_of_its_moments() {
        let face = Face::cut(FACE[0], FACE[1]);
        let (moment, cone) = face.moment();
        let mut cut = Cut::default();
        let [whole, _] = face.loaded(1e-3, &opening(0.0, 0.0, 0.0, None), &mut cut);
        let sum: f64 = whole.nodes.iter().map(|j| j.weight).sum();
        let force: f64 = whole.nodes.iter().map(|j| j.weight / j.cone).sum();
        assert!((sum / moment - 1.0).abs() < 1e-14 && (sum / force / cone - 1.0).abs() < 1e-14);
    }
}
