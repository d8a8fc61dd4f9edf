//! Solid teeth against the path of contact.

use bevel_differential::contact::damping::Damping;
use bevel_differential::contact::impact::Impact;
use bevel_differential::contact::mesh::MeshState;
use bevel_differential::contact::pairs::{Engagement, Flank};
use bevel_differential::contact::solid::mesh::{Slice, SolidMesh, SolidSpec};
use bevel_differential::geometry::{GearSpec, Pair};

const IMPACT: Impact = Impact { stiffness: 1.82463e10, exponent: 1.5, damping: 5e4, per_full_depth: 1e4 };
const DAMPING: Damping = Damping::Step { coefficient: 5e4, per_full_depth: 1e4 };

fn solid(pair: &Pair, facets: usize, smoothing: f64) -> SolidMesh {
    let spec = SolidSpec {
        facets,
        smoothing,
        slices: vec![Slice { cone: pair.mean_cone, share: 1.0, width: pair.outer_cone - pair.inner_cone, relief: 0.0 }],
        displaced: vec![Default::default()],
    };
    SolidMesh::new(pair, &spec, IMPACT, DAMPING, 0.0)
}

#[test]
fn explore() {
    let pair = Pair::new(&GearSpec::default());
    let engagement = Engagement::new(&pair, true, 0.1);
    for facets in [4, 8, 16, 32, 64, 128] {
        for smoothing in [1.0, 0.05] {
            let mesh = solid(&pair, facets, smoothing);
            let a = 0.1e-3 / pair.mean_cone;
            let q = -a - pair.normal_backlash / 2.0;
            let (mut worst, mut place) = (0.0f64, 0.0);
            let mut worst_path = 0.0f64;
            let mut count = [0; 2];
            for i in 0..400 {
                let x = (f64::from(i) / 400.0 - 0.5) * pair.base_pitch;
                let state = MeshState { position: [q, x], ..Default::default() };
                let mut expected: Vec<(i64, f64, bool)> = Vec::new();
                engagement.pairs([q, x], |p| expected.push((p.number, p.depth, p.place == p.s)));
                count[0] += expected.len();
                mesh.loaded(&state, |l| {
                    count[1] += 1;
                    assert_eq!(l.flank, Flank::Drive);
                    let found = expected.iter().find(|e| e.0 == l.number);
                    let (e, path) = found.map_or((0.0, false), |e| (e.1, e.2));
                    let off = (l.depth - e) * pair.mean_cone * 1e6;
                    if off.abs() > worst.abs() {
                        (worst, place) = (off, l.s);
                    }
                    if path && off.abs() > worst_path.abs() {
                        worst_path = off;
                    }
                });
            }
            println!(
                "{facets} {smoothing}: eps {:.3} um worst {worst:.3} um at s {place:.4} of {:.4}..{:.4}, on path {worst_path:.3}, pairs {count:?}",
                mesh.softness() * pair.mean_cone * 1e6,
                pair.path.low,
                pair.path.high
            );
        }
    }
}
