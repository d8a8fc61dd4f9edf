//! Walks along both polygons of a section, corner by corner, as long as the overlap contributes to the load.

use super::polygon::{Measure, ProjectedFacet, ProjectedRay, position_of};
use super::turned::Both;
use super::{SineCosine, Softness, TurningRay};

/// Smallest ratio of the flanks' distance to their height difference near contact.
const MIN_METRIC: f64 = 0.8;

/// A corner of one flank over a facet of the other.
#[derive(Clone, Copy, Default)]
pub struct Corner<const N: usize> {
    /// Position [rad].
    pub u: Both<N>,
    /// Overlap [rad].
    pub overlap: Both<N>,
    /// Gear to which the facet belongs.
    pub mate: usize,
    /// Lower ray of the facet.
    pub ray: usize,
    /// Height of the facet at the corner [rad].
    pub height: f64,
}

/// Visitor of the corners that the walks pass.
pub trait Follow<const N: usize> {
    /// Starts a walk at this corner. Both walks start at the same corner.
    fn begin(&mut self, at: &Corner<N>);
    /// Passes the next corner.
    fn pass(&mut self, at: &Corner<N>);
}

/// State of a walk along both polygons.
struct Walk<'a, const N: usize> {
    section: &'a FlankSection<'a>,
    measures: &'a [Measure<N>; 2],
    /// Direction: 1 toward higher positions, −1 toward lower positions.
    sense: f64,
    /// Facets of planet and side gear at the present position.
    facets: [ProjectedFacet<N>; 2],
    /// Rays at which these facets end.
    ahead: [ProjectedRay<N>; 2],
    /// Indices of these rays.
    index: [usize; 2],
}

impl<const N: usize> Walk<'_, N> {
    /// Returns the next corner, and the gear to which it belongs.
    #[inline(always)]
    fn corner(&self) -> (usize, Corner<N>) {
        let own = usize::from((self.ahead[1].u.v - self.ahead[0].u.v) * self.sense < 0.0);
        let (at, mate) = (&self.ahead[own], 1 - own);
        let (overlap, height) = self.measures[own].overlap(at, &self.facets[mate]);
        let u = Both::of_first(at.u);
        let (u, overlap) = if own == 0 { (u, overlap * -1.0) } else { (u.exchanged(), overlap.exchanged()) };
        let ray = self.index[mate].wrapping_sub(usize::from(self.sense > 0.0));
        (own, Corner { u, overlap, mate, ray, height })
    }

    /// Passes the next corner, of gear `own`. Returns false if the flank of this gear ends.
    #[inline(always)]
    fn advance(&mut self, own: usize) -> bool {
        let i = self.index[own].wrapping_add(if self.sense > 0.0 { 1 } else { usize::MAX });
        let Some(to) = self.section.projected(own, i) else { return false };
        let from = self.ahead[own];
        self.facets[own] = ProjectedFacet::new(&from, &to);
        (self.ahead[own], self.index[own]) = (to, i);
        (to.u.v - from.u.v) * self.sense > 0.0
    }
}

/// A section of both flanks.
pub struct FlankSection<'a> {
    /// Rays of planet (from tip to root) and side gear (from root to tip).
    pub rays: [&'a [TurningRay]; 2],
    /// Angles of the teeth of planet and side gear.
    pub angles: [SineCosine; 2],
    /// Start of the walks: indices of the rays that would be closest on exact flanks.
    pub start: [f64; 2],
}

impl FlankSection<'_> {
    #[inline(always)]
    fn projected<const N: usize>(&self, gear: usize, i: usize) -> Option<ProjectedRay<N>> {
        self.rays[gear].get(i).map(|ray| ProjectedRay::new(ray, self.angles[gear]))
    }

    /// Rays on both sides of the position `u` on a flank, and the index of the lower ray. `None` if `u` is outside the
    /// flank.
    #[inline(always)]
    fn around<const N: usize>(&self, gear: usize, u: f64) -> Option<(usize, [ProjectedRay<N>; 2])> {
        let last = self.rays[gear].len().checked_sub(2)?;
        let mut i = (self.start[gear] as u32 as usize).min(last);
        let mut rays = [self.projected::<N>(gear, i)?, self.projected(gear, i + 1)?];
        if !(rays[0].u.v <= u && u <= rays[1].u.v) {
            // neighbouring facets have nearly the same length
            let facets_ahead = (u - rays[0].u.v) / (rays[1].u.v - rays[0].u.v);
            i = ((i as f64 + facets_ahead) as u32 as usize).min(last);
            let at = |i: usize| self.rays[gear].get(i).map(|ray| position_of::<0>(ray, self.angles[gear]).v);
            while at(i + 1)? < u {
                i += 1;
            }
            while at(i)? > u {
                i = i.checked_sub(1)?;
            }
            rays = [self.projected(gear, i)?, self.projected(gear, i + 1)?];
        }
        Some((i, rays))
    }

    /// Walks along the contributing corners in both directions from a position inside both flanks. The first walk
    /// follows the direction in which the overlap grows; the second starts at the same corner in the other direction.
    /// Returns `None` if the flanks are apart.
    #[inline(always)]
    pub fn walk<const N: usize>(&self, soft: &Softness, follow: &mut impl Follow<N>) -> Option<()> {
        let planet_tip = position_of::<N>(self.rays[0].first()?, self.angles[0]);
        let side_tip = position_of::<N>(self.rays[1].last()?, self.angles[1]);
        // involutes touch at u = 0 or at a tip
        let u = 0.0f64.max(planet_tip.v).min(side_tip.v);
        let (planet, side) = (self.around::<N>(0, u)?, self.around::<N>(1, u)?);
        let facets = [ProjectedFacet::new(&planet.1[0], &planet.1[1]), ProjectedFacet::new(&side.1[0], &side.1[1])];
        let grows_up = facets[0].slope() > facets[1].slope();
        // between convex flanks, the overlap initially grows fastest
        let room = if grows_up { side_tip.v - u } else { planet_tip.v - u };
        let (reach, least) = (soft.deep(), -soft.excess / MIN_METRIC);
        let farthest = facets[0].height(u) - facets[1].height(u) + (facets[0].slope() - facets[1].slope()) * room;
        if farthest.is_nan() || farthest <= least {
            return None;
        }
        let measures = Measure::of_both(planet_tip, side_tip);
        let walk = |up: bool| {
            let (sense, end) = (if up { 1.0 } else { -1.0 }, usize::from(up));
            let (ahead, index) = ([planet.1[end], side.1[end]], [planet.0 + end, side.0 + end]);
            Walk { section: self, measures: &measures, sense, facets, ahead, index }
        };
        let (mut forward, mut back) = (walk(grows_up), walk(!grows_up));
        let (own, begin) = back.corner();
        let goes_back = back.advance(own);
        let floor_of = |greatest: f64| if greatest > least { greatest - reach } else { greatest };
        let mut greatest = begin.overlap.v;
        let mut floor = floor_of(greatest);
        for (walk, mut goes_on) in [(&mut forward, true), (&mut back, goes_back)] {
            follow.begin(&begin);
            while goes_on {
                let (own, at) = walk.corner();
                follow.pass(&at);
                if at.overlap.v > greatest {
                    greatest = at.overlap.v;
                    floor = floor_of(greatest);
                }
                // between convex flanks, the overlap has a single maximum
                goes_on = at.overlap.v >= floor && walk.advance(own);
            }
            if greatest.is_nan() || greatest <= least {
                return None;
            }
        }
        Some(())
    }
}
