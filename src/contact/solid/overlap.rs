//! How deep two faceted flanks overlap in one section.
//!
//! Both sections are polygons in the plane of projection of [`super::pose`]: the planet's surface h_p(u), the side gear's
//! h_s(u), material of the planet below, of the side gear above. Their overlap at u is the distance of one surface inside
//! the other, as an arc
//!
//!   δ = (h_p − h_s) c / (1 + u² + h_p h_s),   c = n_h √(1 + u² + h²), n_h the part along h of the normal,
//!
//! negative where the flanks stand apart, at the corners of both polygons and linear between them. On the path of contact
//! both normals are the same; a tip corner is measured along that of the flank it meets: c passes from the side gear's at
//! the planet's tip to the planet's at the side gear's tip. The depth of a section is its greatest overlap,
//! taken softly over the patch around it:
//!
//!   p = ε ln( ∫ exp(δ(u)/ε) du / √(2π ρ ε) ),   ∂p = ∫ w ∂δ du with the weights w ∝ exp(δ/ε), ∫ w du = 1
//!
//! Every facet under the patch takes its part w du of the load, along its own normal, so that force and torque are
//! continuous where the deepest corner changes; with the deepest point alone they would jump at each facet. The patch
//! has the half-width √(ρ ε) between flanks of relative radius of curvature ρ (Laplace's method: for δ = p − u²/2ρ the
//! formula returns p exactly); ε follows the heights of the arcs over their facets and vanishes with them, as the square
//! of the facets' length. What is left for ε → 0 is the greatest overlap, which on involutes is the approach less the gap
//! of the tip corners, a − g, and not an approximation of it.

use super::flank::Ray;
use super::pose::Pose;
use crate::numeric::{Partials, Smooth, sqrt};

/// Most facets of a flank.
pub const MOST_FACETS: usize = 256;
/// Most rays of a flank: both ends, and one below the base circle.
const MOST_RAYS: usize = MOST_FACETS + 2;

/// Weights below e to this power are nothing in double precision.
const NEGLIGIBLE: f64 = -40.0;

/// How softly the greatest overlap is taken.
#[derive(Clone, Copy, Debug)]
pub struct Softness {
    /// ε [rad].
    pub width: f64,
    /// √(2π ρ ε) [rad].
    pub measure: f64,
}

/// A ray in the plane of projection.
#[derive(Clone, Copy, Default)]
struct Seen<T> {
    u: T,
    h: T,
    /// n_h √(1 + u² + h²).
    metric: T,
}

impl<T: Smooth> Seen<T> {
    fn new(ray: &Ray, relief: f64, pose: &Pose<T>, offset: [f64; 3]) -> Self {
        let Ray { direction, normal } = ray;
        let at = direction - normal * relief;
        let [across, along, toward]: [T; 3] = std::array::from_fn(|i| {
            let row = &pose[i];
            row[0] * at.x + row[1] * at.y + row[2] * at.z + offset[i]
        });
        let row = &pose[1];
        let part = row[0] * normal.x + row[1] * normal.y + row[2] * normal.z;
        let per = toward.reciprocal();
        let (u, h) = (across * per, along * per);
        let square = u * u + h * h + 1.0;
        let root = sqrt(square.value());
        let root = square.through([root, 0.5 / root, -0.25 / (root * square.value())]);
        Self { u, h, metric: part * root }
    }

    /// Point and metric of the facet from `self` to `next` at `u`.
    #[inline(always)]
    fn until(&self, next: &Self, u: T) -> [T; 2] {
        let share = (u - self.u) * (next.u - self.u).reciprocal();
        [self.h + share * (next.h - self.h), self.metric + share * (next.metric - self.metric)]
    }
}

/// From the planet's tip to the side gear's.
#[derive(Clone, Copy)]
struct Span<T> {
    low: T,
    per_length: T,
}

impl<T: Smooth> Span<T> {
    fn new(planet_tip: T, side_tip: T) -> Self {
        Self { low: planet_tip, per_length: (side_tip - planet_tip).reciprocal() }
    }

    /// Overlap at `u` of the surfaces with height and metric of `planet` and `side`.
    #[inline(always)]
    fn overlap(&self, u: T, planet: [T; 2], side: [T; 2]) -> T {
        let share = (u - self.low) * self.per_length;
        let metric = side[1] + share * (planet[1] - side[1]);
        (planet[0] - side[0]) * metric * (u * u + planet[0] * side[0] + 1.0).reciprocal()
    }
}

/// A corner of either polygon within both.
#[derive(Clone, Copy, Default)]
struct Stop {
    /// The last ray of planet and side gear at or before it.
    after: [u16; 2],
    /// Whether it is the side gear's.
    of_side: bool,
    /// Overlap [rad].
    overlap: f64,
}

/// Where the patch of a section lies.
#[derive(Clone, Copy, Debug, Default)]
pub struct Patch {
    /// Place in the plane of projection [rad].
    pub place: [f64; 2],
    /// Mean normal into the side gear, in rows of a pose.
    pub normal: [f64; 3],
}

/// A section of both flanks.
pub struct Section<'a> {
    /// Rays of planet and side gear.
    pub rays: [&'a [Ray]; 2],
    /// Material missing on the planet's flank [rad].
    pub relief: f64,
    /// Displacement of the planet, in rows of a pose [rad].
    pub offset: [f64; 3],
}

impl Section<'_> {
    #[inline(always)]
    fn see<T: Smooth>(&self, poses: &[Pose<T>; 2], gear: usize, i: usize) -> Seen<T> {
        let ray = &self.rays[gear][i];
        if gear == 0 {
            Seen::new(ray, self.relief, &poses[0], self.offset)
        } else {
            Seen::new(ray, 0.0, &poses[1], [0.0; 3])
        }
    }

    /// The rays of a gear in the plane of projection, as far as they are in order: the first of them, and how many.
    fn outline(&self, poses: &[Pose<f64>; 2], gear: usize, out: &mut [Seen<f64>; MOST_RAYS]) -> (usize, usize) {
        let (mut first, mut n) = (0, 0);
        for i in 0..self.rays[gear].len().min(MOST_RAYS) {
            let seen = self.see(poses, gear, i);
            let in_order = n == 0 || seen.u > out[n - 1].u;
            if !(seen.u.is_finite() && seen.h.is_finite()) || !in_order && seen.u > 0.0 {
                break;
            }
            if !in_order {
                // far from the line of action a flank may still be turned away
                (first, n) = (i, 0);
            }
            out[n] = seen;
            n += 1;
        }
        (first, n)
    }

    /// The corners of both polygons where both are, in order, and the greatest overlap.
    fn scan<T: Smooth>(&self, poses: &[Pose<T>; 2], stops: &mut Stops) -> Option<f64> {
        let values = poses.map(|pose| pose.map(|row| row.map(Smooth::value)));
        let mut seen = [[Seen::default(); MOST_RAYS]; 2];
        let [(p0, p), (s0, s)] = [0, 1].map(|gear| self.outline(&values, gear, &mut seen[gear]));
        let (planet, side) = (&seen[0][..p], &seen[1][..s]);
        let span = Span::new(planet.first()?.u, side.last()?.u);
        let (mut i, mut k, mut greatest) = (0, 0, f64::NEG_INFINITY);
        while i < p && k < s {
            let of_side = side[k].u < planet[i].u;
            // a corner counts where the other polygon has begun
            let found = if of_side {
                (i > 0).then(|| {
                    let Seen { u, h, metric } = side[k];
                    ([i - 1, k], span.overlap(u, planet[i - 1].until(&planet[i], u), [h, metric]))
                })
            } else {
                (k > 0).then(|| {
                    let Seen { u, h, metric } = planet[i];
                    ([i, k - 1], span.overlap(u, [h, metric], side[k - 1].until(&side[k], u)))
                })
            };
            if let Some(([i, k], overlap)) = found {
                let after = [(p0 + i) as u16, (s0 + k) as u16];
                stops.list[stops.count] = Stop { after, of_side, overlap };
                stops.count += 1;
                stops.ends = [p0, s0 + s - 1];
                greatest = greatest.max(overlap);
            }
            if of_side { k += 1 } else { i += 1 }
        }
        (stops.count > 1).then_some(greatest)
    }

    /// Calls `visit` with each stretch between corners whose overlap comes up to `floor`: the corners, with place and overlap
    /// of each.
    #[inline(always)]
    fn stretches<T: Smooth>(
        &self,
        poses: &[Pose<T>; 2],
        stops: &Stops,
        floor: f64,
        mut visit: impl FnMut([&Stop; 2], [(T, T); 2]),
    ) {
        let [tip, other] = [0, 1].map(|gear| self.see(poses, gear, stops.ends[gear]).u);
        let span = Span::new(tip, other);
        // the facets that the place lies on, the rays before and after it
        let mut facets: [Option<(usize, [Seen<T>; 2])>; 2] = [None; 2];
        let mut facet = |gear: usize, i: usize| match facets[gear] {
            Some((at, ends)) if at == i => ends,
            known => {
                let from = match known {
                    Some((at, [_, end])) if at + 1 == i => end,
                    _ => self.see(poses, gear, i),
                };
                let ends = [from, self.see(poses, gear, i + 1)];
                facets[gear] = Some((i, ends));
                ends
            }
        };
        let mut place = |stop: &Stop| {
            let [i, k] = stop.after.map(usize::from);
            let (own, mate) = if stop.of_side { ((1, k), (0, i)) } else { ((0, i), (1, k)) };
            // the last ray has no facet after it
            let at =
                if own.1 + 1 < self.rays[own.0].len() { facet(own.0, own.1)[0] } else { facet(own.0, own.1 - 1)[1] };
            let [from, to] = facet(mate.0, mate.1);
            let (here, there) = ([at.h, at.metric], from.until(&to, at.u));
            let (planet, side) = if stop.of_side { (there, here) } else { (here, there) };
            (at.u, span.overlap(at.u, planet, side))
        };
        let mut last = None;
        for pair in stops.as_slice().windows(2) {
            if pair[0].overlap.max(pair[1].overlap) < floor {
                last = None;
                continue;
            }
            let from = match last {
                Some(from) => from,
                None => place(&pair[0]),
            };
            let to = place(&pair[1]);
            visit([&pair[0], &pair[1]], [from, to]);
            last = Some(to);
        }
    }

    /// Depth p [rad], negative where the flanks stand apart; none where they do not face each other.
    pub fn depth<T: Smooth>(&self, poses: &[Pose<T>; 2], soft: &Softness) -> Option<T> {
        let mut stops = Stops { list: [Stop::default(); 2 * MOST_RAYS], count: 0, ends: [0; 2] };
        let greatest = self.scan(poses, &mut stops)?;
        let per = 1.0 / soft.width;
        let mut sum = T::constant(0.0);
        self.stretches(poses, &stops, greatest + NEGLIGIBLE * soft.width, |_, [(u0, d0), (u1, d1)]| {
            let (a, b) = ((d0 - greatest) * per, (d1 - greatest) * per);
            sum = sum + (u1 - u0) * T::through_both(a, b, &mean_exponential(a.value(), b.value()));
        });
        (sum.value() > 0.0).then(|| {
            let r = 1.0 / sum.value();
            sum.through([libm::log(sum.value() / soft.measure), r, -r * r]) * soft.width + greatest
        })
    }

    /// Where the patch lies.
    pub fn patch(&self, poses: &[Pose<f64>; 2], soft: &Softness) -> Option<Patch> {
        let mut stops = Stops { list: [Stop::default(); 2 * MOST_RAYS], count: 0, ends: [0; 2] };
        let greatest = self.scan(poses, &mut stops)?;
        let (mut sum, mut out) = (0.0, Patch::default());
        self.stretches(poses, &stops, greatest + NEGLIGIBLE * soft.width, |ends, at| {
            let [a, b] = at.map(|(_, d)| (d - greatest) / soft.width);
            let weight = (at[1].0 - at[0].0) * mean_exponential(a, b).v;
            sum += weight;
            for (stop, (u, _)) in ends.into_iter().zip(at) {
                // the flank that the corner is pressed into
                let mate = usize::from(!stop.of_side);
                let i = usize::from(stop.after[mate]);
                let seen = self.see(poses, mate, i);
                let normal = self.rays[mate][i].normal;
                out.place[0] += 0.5 * weight * u;
                out.place[1] += 0.5 * weight * seen.until(&self.see(poses, mate, i + 1), u)[0];
                for (sum, row) in out.normal.iter_mut().zip(&poses[mate]) {
                    *sum += 0.5 * weight * (row[0] * normal.x + row[1] * normal.y + row[2] * normal.z);
                }
            }
        });
        let [x, y, z] = out.normal;
        let length = sqrt(x * x + y * y + z * z);
        (sum > 0.0 && length > 0.0)
            .then(|| Patch { place: out.place.map(|p| p / sum), normal: out.normal.map(|n| n / length) })
    }
}

/// Corners of both polygons.
struct Stops {
    list: [Stop; 2 * MOST_RAYS],
    count: usize,
    /// The rays at the planet's tip and the side gear's.
    ends: [usize; 2],
}

impl Stops {
    fn as_slice(&self) -> &[Stop] {
        &self.list[..self.count]
    }
}

/// Mean of e^x for x from a to b, with its derivatives.
#[inline(always)]
fn mean_exponential(a: f64, b: f64) -> Partials {
    // e^m f(z) with the middle m and half the difference z, f = sinh z / z
    let z = 0.5 * (b - a);
    let (f, f1, f2);
    if z.abs() < 0.5 {
        let e = libm::exp(0.5 * (a + b));
        let y = z * z;
        // Taylor series; the first term left out is 1e-16 of the sum
        f = e * (1.0 + y / 6.0 * (1.0 + y / 20.0 * (1.0 + y / 42.0 * (1.0 + y / 72.0 * (1.0 + y / 110.0)))));
        f1 = e * z / 3.0 * (1.0 + y / 10.0 * (1.0 + y / 28.0 * (1.0 + y / 54.0 * (1.0 + y / 88.0))));
        f2 = e / 3.0 * (1.0 + y * (0.3 + y * (5.0 / 280.0 + y * (7.0 / 15120.0 + y * (9.0 / 1_330_560.0)))));
    } else {
        let (ea, eb) = (libm::exp(a), libm::exp(b));
        let cosh = 0.5 * (ea + eb);
        f = 0.5 * (eb - ea) / z;
        f1 = (cosh - f) / z;
        f2 = f - 2.0 * f1 / z;
    }
    Partials {
        v: f,
        d: [0.5 * (f - f1), 0.5 * (f + f1)],
        dd: [0.25 * (f - 2.0 * f1 + f2), 0.25 * (f - f2), 0.25 * (f + 2.0 * f1 + f2)],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_mean_exponential_and_its_derivatives_are_exact() {
        // by Gauss-Legendre over the interval, five points on short pieces
        let points = [
            (0.0, 0.568_888_888_888_888_9),
            (0.538_469_310_105_683_1, 0.478_628_670_499_366_47),
            (-0.538_469_310_105_683_1, 0.478_628_670_499_366_47),
            (0.906_179_845_938_664, 0.236_926_885_056_189_08),
            (-0.906_179_845_938_664, 0.236_926_885_056_189_08),
        ];
        let mean = |a: f64, b: f64, f: &dyn Fn(f64) -> f64| {
            let n = 200;
            let mut sum = 0.0;
            for piece in 0..n {
                for (x, w) in points {
                    let t = (f64::from(piece) + 0.5 * (1.0 + x)) / f64::from(n);
                    sum += 0.5 * w / f64::from(n) * f(t) * (a + t * (b - a)).exp();
                }
            }
            sum
        };
        for (a, b) in [(-1.0, -1.0), (-0.3, 0.0), (0.0, -0.99), (-1.01, 0.0), (0.0, -7.0), (-30.0, -2.0)] {
            let got = mean_exponential(a, b);
            let exact = [
                mean(a, b, &|_| 1.0),
                mean(a, b, &|t| 1.0 - t),
                mean(a, b, &|t| t),
                mean(a, b, &|t| (1.0 - t) * (1.0 - t)),
                mean(a, b, &|t| t * (1.0 - t)),
                mean(a, b, &|t| t * t),
            ];
            let found = [got.v, got.d[0], got.d[1], got.dd[0], got.dd[1], got.dd[2]];
            for (x, y) in found.into_iter().zip(exact) {
                assert!((x - y).abs() < 1e-14 * exact[0].max(1e-3), "{a} {b}: {x} {y}");
            }
        }
    }
}
