//! Positions at which a straight motion makes flanks touch or separate.

use bevel_differential::contact::pairs::Engagement;
use bevel_differential::geometry::{GearSpec, Pair};

/// Approach of the flanks at the start or end of a motion, as a fraction of half the backlash.
const INTO: f64 = 0.25;
/// Accuracy of a found fraction.
const FOUND: f64 = 1e-4;

fn teeth() -> (Engagement, f64) {
    let pair = Pair::new(&GearSpec::default());
    (Engagement::new(&pair, true, 0.1), pair.normal_backlash / 2.0)
}

/// First kink of a motion from `from` to `to`, both as fractions of half the backlash, at a position at which one pair
/// is deep in its path.
fn found(from: f64, to: f64) -> [Option<f64>; 2] {
    let (engagement, half) = teeth();
    let (q, change) = (half * from, half * (to - from));
    [engagement.kink::<false>([q, 0.0], [change, 0.0], |_, _, _| 0.0), engagement.kink_of_touch(q, change)]
}

#[test]
fn flanks_touch_and_separate_at_the_ends_of_the_backlash_on_both_sides() {
    for side in [-1.0, 1.0] {
        let outside = side * (1.0 + INTO);
        // from the middle of the backlash to the flank, and back
        for (from, to, wanted) in [(0.0, outside, 1.0 / (1.0 + INTO)), (outside, 0.0, INTO / (1.0 + INTO))] {
            for part in found(from, to) {
                assert!((part.unwrap() - wanted).abs() < FOUND, "{from} to {to}: {part:?}");
            }
        }
        // both positions within the backlash, and both on one flank
        assert_eq!(found(0.9 * side, -0.9 * side), [None; 2]);
        assert_eq!(found(outside, 1.1 * outside)[1], None);
    }
}

#[test]
fn a_step_to_a_touch_ends_just_before_it() {
    let (engagement, half) = teeth();
    for side in [-1.0, 1.0] {
        for (from, to) in [(0.0, 1.5), (-0.999, 1.001), (0.3, 40.0)] {
            let (q, change) = (side * half * from, side * half * (to - from));
            let end = q + engagement.kink_of_touch(q, change).unwrap() * change;
            let gap = half - side * end;
            assert!(gap > 0.0 && gap < 1e-7 * half, "{side} from {from} to {to}: {gap:e}");
        }
    }
}

#[test]
fn across_the_whole_backlash_the_flanks_that_touched_first_separate_first() {
    for side in [-1.0, 1.0] {
        let (from, to) = (side * (1.0 + INTO), -side * (1.0 + INTO));
        for part in found(from, to) {
            assert!((part.unwrap() - INTO / (from - to).abs()).abs() < FOUND, "{side}: {part:?}");
        }
    }
}
