use bevel_differential::contact::damping::Damping;
use bevel_differential::contact::impact::Impact;
use bevel_differential::contact::mesh::MeshState;
use bevel_differential::contact::solid::mesh::{Slice, SolidMesh, SolidSpec};
use bevel_differential::geometry::{GearSpec, Pair};
const IMPACT: Impact = Impact { stiffness: 1.82463e10, exponent: 1.5, damping: 5e4, per_full_depth: 1e4 };
#[test]
fn explore() {
    let pair = Pair::new(&GearSpec::default());
    for facets in [32] {
        let spec = SolidSpec {
            facets,
            smoothing: 1.0,
            slices: vec![Slice { cone: pair.mean_cone, share: 1.0, width: 0.02, relief: 0.0 }],
            displaced: vec![Default::default()],
        };
        let mesh = SolidMesh::new(&pair, &spec, IMPACT, Damping::Step { coefficient: 5e4, per_full_depth: 1e4 }, 0.0);
        let a = 0.09e-3 / pair.mean_cone;
        let q = -a - pair.normal_backlash / 2.0;

        for x in [0.0610305 - 3e-6, 0.0610305 - 1e-6] {
            println!("==== {x} {}", mesh.energy([0, 0], [q, x * pair.base_pitch]));
        }
    }
    let _ = MeshState::default();
}
