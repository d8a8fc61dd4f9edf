//! Errors of individual teeth, drawn and given.

use bevel_differential::contact::errors::{ToothErrorSpec, ToothErrors};
use bevel_differential::geometry::{GearSpec, Pair};

fn errors(seed: i32) -> ToothErrors {
    let spec = ToothErrorSpec { accuracy_grade: 7, runout_by_grade: true, seed, ..ToothErrorSpec::default() };
    ToothErrors::new(&spec, &Pair::new(&GearSpec::default()), 2).unwrap()
}

#[test]
fn given_teeth_replace_the_drawn_ones() {
    let (one, other) = (errors(1), errors(2));
    assert_ne!(one.teeth(), other.teeth());
    assert_eq!(one.with_teeth(&other.teeth()).unwrap().teeth(), other.teeth());
}

#[test]
fn given_teeth_that_do_not_fit_the_gears_are_refused() {
    let teeth = errors(1).teeth();
    assert!(errors(1).with_teeth(&teeth[1..]).is_err());
    let mut missing = teeth.clone();
    missing[3].positions[0].pop();
    assert!(errors(1).with_teeth(&missing).is_err());
    let mut unknown = teeth;
    unknown[0].azimuth = f64::NAN;
    assert!(errors(1).with_teeth(&unknown).is_err());
}
