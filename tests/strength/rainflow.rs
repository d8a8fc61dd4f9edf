//! Rainflow counting, compared with ASTM's example in tests/data/golden_fatigue.json and a plain count of the whole
//! sequence.

use crate::textbook::textbook;
use bevel_differential::strength::{LoadCycle, Rainflow, SnCurve, ToothStrength, pulsating_range};
use fastrand::Rng;
use serde_json::Value;

fn golden() -> Value {
    serde_json::from_str(include_str!("../data/golden_fatigue.json")).expect("valid JSON")
}

fn close(program: f64, expected: f64, relative: f64) {
    assert!((program / expected - 1.0).abs() <= relative, "program {program}, expected {expected}");
}

fn streamed(sequence: &[f64]) -> Vec<(f64, f64, f64)> {
    let (mut history, mut counted) = (Rainflow::new(0.0), Vec::new());
    for &x in sequence {
        history.push(x, |c: LoadCycle| counted.push((c.range, c.mean, c.count)));
    }
    history.rest(|c| counted.push((c.range, c.mean, c.count)));
    counted.sort_by(|a, b| a.partial_cmp(b).unwrap());
    counted
}

#[test]
fn rainflow_counts_the_example_of_the_standard() {
    let example = &golden()["ASTM_E1049_example"];
    let sequence: Vec<f64> = example["sequence"].as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect();
    let counted = streamed(&sequence);
    let expected = example["range_counts"].as_object().unwrap();
    for (range, count) in expected {
        let range: f64 = range.parse().unwrap();
        let total: f64 = counted.iter().filter(|c| c.0 == range).map(|c| c.2).sum();
        assert_eq!(total, count.as_f64().unwrap(), "range {range}");
    }
    assert_eq!(counted.iter().map(|c| c.2).sum::<f64>(), expected.values().map(|v| v.as_f64().unwrap()).sum::<f64>());
}

#[test]
fn rainflow_streamed_equals_the_textbook_on_random_histories() {
    let mut random = Rng::with_seed(1);
    for run in 0..2000 {
        let length = 2 + random.usize(..300);
        // whole numbers, so that equal ranges occur; neighbours differ, so that the textbook detects every reversal
        let mut sequence: Vec<f64> = (0..length).map(|_| f64::from(random.u8(..41))).collect();
        sequence.dedup();
        if sequence.len() > 1 {
            assert_eq!(streamed(&sequence), textbook(&sequence), "run {run}");
        }
    }
}

#[test]
fn a_decaying_oscillation_overflows_the_stack_conservatively_and_loses_only_its_smallest_ranges() {
    let curve = SnCurve::through(100.0, 1e6, 2.0, 1e3);
    let damage =
        |counted: &[(f64, f64, f64)]| -> f64 { counted.iter().map(|c| c.2 * curve.damage_per_cycle(c.0)).sum() };
    let mut random = Rng::with_seed(7);
    for run in 0..200 {
        let decay = 0.90 + 0.0004 * f64::from(run);
        let wave = |i: i32| if i % 2 == 0 { 1.0 } else { -1.0 } * 50.0 * decay.powi(i);
        let mut sequence: Vec<f64> = (0..120).map(wave).collect();
        // afterwards it may grow again
        sequence.extend((0..random.u64(..9)).map(|i| wave(40 + 3 * i as i32)));
        let (stream, book) = (streamed(&sequence), textbook(&sequence));
        let (d_stream, d_book) = (damage(&stream), damage(&book));
        assert!(d_stream >= d_book * (1.0 - 1e-12) && d_stream < 2.0 * d_book, "{d_stream} {d_book}");
        // the 25 largest ranges equal the textbook's
        let largest = |c: &[(f64, f64, f64)]| -> Vec<f64> { c.iter().rev().take(25).map(|c| c.0).collect() };
        assert_eq!(largest(&stream), largest(&book), "run {run}");
    }
}

#[test]
fn a_growing_oscillation_after_an_overflow_closes_exactly() {
    let wave = |i: i32| if i % 2 == 0 { 1.0 } else { -1.0 } * 100.0 * 0.97f64.powi(i);
    let mut sequence: Vec<f64> = (0..33).map(wave).collect();
    sequence.push(wave(0) * 2.0);
    assert_eq!(streamed(&sequence), textbook(&sequence));
}

#[test]
fn rainflow_ignores_non_numbers_and_ranges_below_the_gate_and_survives_foreign_bytes() {
    let mut history = Rainflow::new(1.0);
    let mut seen = 0;
    for i in 0..1000 {
        history.push(100.0 + if i % 2 == 0 { 0.4 } else { -0.4 }, |_| seen += 1);
        history.push(f64::NAN, |_| seen += 1);
    }
    history.rest(|_| seen += 1);
    assert_eq!(seen, 0);
    // reversals hidden by the gate do not reduce the first range, upward or downward
    for sign in [1.0, -1.0] {
        let (mut start, mut ranges) = (Rainflow::new(1.0), Vec::new());
        for x in [10.0, 9.3, 10.2, 50.0] {
            start.push(sign * x, |_| unreachable!());
        }
        start.rest(|c| ranges.push((c.range, c.mean, c.count)));
        assert_eq!(ranges, [(50.0 - 9.3, sign * (50.0 + 9.3) / 2.0, 0.5)]);
    }
    let mut text = serde_json::to_value(history).unwrap();
    assert_eq!(serde_json::from_value::<Rainflow>(text.clone()).unwrap(), history);
    for length in [0, 1, 31, 32, 1000] {
        for direction in [-128, -1, 0, 1, 127] {
            text["points"] = vec![1.0; length].into();
            text["direction"] = direction.into();
            let mut foreign: Rainflow = serde_json::from_value(text.clone()).unwrap();
            (0..100).for_each(|i| foreign.push(f64::from(i * 37 % 11), |_| ()));
            foreign.rest(|_| ());
        }
    }
}

#[test]
fn the_cycles_of_a_gear_that_does_not_roll_become_damage_of_its_root() {
    let material = ToothStrength::default();
    let per_torque = 1e6;
    let mut history = Rainflow::new(0.0);
    let (mut damage, mut cycles) = (0.0, 0.0);
    // drive and overrun alternate: purely alternating load, the case of the idler factor
    for i in 0..=2000 {
        let torque = if i % 2 == 0 { 500.0 } else { -500.0 };
        history.push(torque, |c| {
            let range = pulsating_range(&c, material.mean_stress_sensitivity());
            damage += c.count * material.bending.damage_per_cycle(range * per_torque);
            cycles += c.count;
        });
    }
    let idler = SnCurve { strength: material.idler_factor * material.bending.strength, ..material.bending };
    close(damage, cycles * idler.damage_per_cycle(500e6), 1e-12);
    assert!(cycles > 998.0);
}
