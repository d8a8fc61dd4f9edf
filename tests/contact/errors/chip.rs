//! A chipped tooth.

use bevel_differential::contact::errors::*;
use bevel_differential::contact::pairs::Flank;
use bevel_differential::geometry::{GearSpec, Pair};

#[test]
fn only_the_broken_tooth_misses_material_and_only_from_the_heel() {
    let pair = Pair::new(&GearSpec::default());
    let spec = ToothFaultSpec {
        gear: FaultyGear::Side,
        index: 1,
        tooth: 5,
        missing_fraction: 0.25,
        depth: 2e-3,
        ..ToothFaultSpec::default()
    };
    let chip = Chip::new(&spec, &pair, 2).unwrap().unwrap();
    let id = |side_tooth| PairId { planet_tooth: 3, side_tooth, flank: Flank::Coast };
    let (left, right) = (MeshId { planet: 0, side: 0 }, MeshId { planet: 1, side: 1 });
    let edge = pair.outer_cone - 0.25 * (pair.outer_cone - pair.inner_cone);
    assert_eq!(chip.edge(right, id(5)), Some((edge, 2e-3)));
    assert_eq!(chip.edge(right, id(4)), None);
    assert_eq!(chip.edge(left, id(5)), None);
    assert_eq!(Chip::new(&ToothFaultSpec { gear: FaultyGear::None, ..spec }, &pair, 2), Ok(None));
    assert!(Chip::new(&ToothFaultSpec { index: 2, ..spec }, &pair, 2).is_err());
}

#[test]
fn any_time_may_be_an_onset_and_without_an_onset_only_the_trigger_breaks_the_tooth() {
    for onset in [0.0, -3.0, 0.2, 1.7e9, f64::MIN] {
        let spec = ToothFaultSpec { gear: FaultyGear::Planet, at_onset: true, onset, ..ToothFaultSpec::default() };
        assert!(spec.check([10, 16], 2).is_ok());
        assert_eq!([spec.time(), ToothFaultSpec { at_onset: false, ..spec }.time()], [Some(onset), None]);
    }
}
