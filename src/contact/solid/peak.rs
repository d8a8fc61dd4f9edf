//! The corner at which two faceted flanks overlap most, by heights alone.
//!
//! Both flanks are convex, so that the difference of their heights has a single maximum in the plane of projection: where
//! the slopes of their facets change order. Contacts of involutes lie near u = 0 or at a tip, and there the search begins.

use super::flank::Ray;
use super::overlap::FlankSection;
use super::pose::Pose;

/// A corner of one flank over a facet of the other.
#[derive(Clone, Copy, Debug)]
pub struct Peak {
    /// The gear of the corner.
    pub own: usize,
    /// Its ray.
    pub ray: usize,
    /// The lower ray of its mate's facet.
    pub facet: usize,
    /// Difference of heights [rad].
    pub overlap: f64,
}

/// A facet by the places and heights of its ends [rad].
#[derive(Clone, Copy)]
struct Facet {
    index: usize,
    ends: [[f64; 2]; 2],
}

impl Facet {
    /// Length and rise.
    #[inline(always)]
    fn extent(&self) -> [f64; 2] {
        let [from, to] = self.ends;
        [to[0] - from[0], to[1] - from[1]]
    }

    /// Height at `u`.
    #[inline(always)]
    fn height(&self, u: f64) -> f64 {
        let [length, rise] = self.extent();
        self.ends[0][1] + (u - self.ends[0][0]) * rise / length
    }
}

impl FlankSection<'_> {
    #[inline(always)]
    fn heights(&self, poses: &[Pose; 2], gear: usize, ray: &Ray) -> [f64; 2] {
        self.place::<0>(poses, gear, ray).map(|at| at.v)
    }

    /// The next facet toward higher (`up`) or lower places.
    #[inline(always)]
    fn neighbour(&self, poses: &[Pose; 2], gear: usize, of: &Facet, up: bool) -> Option<Facet> {
        let (index, ray) = if up { (of.index + 1, of.index + 2) } else { (of.index.wrapping_sub(1), of.index.wrapping_sub(1)) };
        let new = self.heights(poses, gear, self.rays[gear].get(ray)?);
        let [from, to] = of.ends;
        let ends = if up { [to, new] } else { [new, from] };
        (ends[0][0] < ends[1][0]).then_some(Facet { index, ends })
    }

    /// The facet of `gear` at the place `u`, or the one nearest to it.
    #[inline(always)]
    fn facet_at(&self, poses: &[Pose; 2], gear: usize, u: f64) -> Option<Facet> {
        let rays = self.rays[gear];
        let index = (self.start[gear].max(0.0) as usize).min(rays.len().checked_sub(2)?);
        let ends = [index, index + 1].map(|i| self.heights(poses, gear, &rays[i]));
        let mut facet = (ends[0][0] < ends[1][0]).then_some(Facet { index, ends })?;
        while facet.ends[1][0] < u
            && let Some(next) = self.neighbour(poses, gear, &facet, true)
        {
            facet = next;
        }
        while facet.ends[0][0] > u
            && let Some(next) = self.neighbour(poses, gear, &facet, false)
        {
            facet = next;
        }
        Some(facet)
    }

    /// The corner of the greatest overlap between tips at the places `planet_tip` and `side_tip` [rad].
    #[inline(always)]
    pub(super) fn peak(&self, poses: &[Pose; 2], [planet_tip, side_tip]: [f64; 2]) -> Option<Peak> {
        let u = 0.0f64.max(planet_tip).min(side_tip);
        let mut facets = [self.facet_at(poses, 0, u)?, self.facet_at(poses, 1, u)?];
        let mut upward = None;
        loop {
            let [[planet_length, planet_rise], [side_length, side_rise]] = [0, 1].map(|i| facets[i].extent());
            let rising = planet_rise * side_length > side_rise * planet_length;
            // the corner just passed, now on the other side, is the peak
            let turned = upward.is_some_and(|up| up != rising);
            let up = rising;
            upward = Some(up);
            let [planet, side] = [0, 1].map(|i| facets[i].ends[usize::from(up)][0]);
            let own = usize::from((side < planet) == up);
            let at = facets[own].ends[usize::from(up)];
            let next = if turned { None } else { self.neighbour(poses, own, &facets[own], up) };
            match next {
                Some(next) => facets[own] = next,
                None => {
                    let there = facets[1 - own].height(at[0]);
                    return Some(Peak {
                        own,
                        ray: facets[own].index + usize::from(up),
                        facet: facets[1 - own].index,
                        overlap: if own == 0 { at[1] - there } else { there - at[1] },
                    });
                }
            }
        }
    }
}
