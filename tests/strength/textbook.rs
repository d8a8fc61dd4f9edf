//! Rainflow counting of a whole sequence, and the damage of its cycles, written from the standards.

use bevel_differential::strength::{LoadCycle, ToothStrength, pulsating_range};

/// Rainflow counting of a whole sequence as in ASTM E1049, 5.4.4, on a growing list.
pub fn textbook(sequence: &[f64]) -> Vec<(f64, f64, f64)> {
    let mut turning: Vec<f64> = Vec::new();
    for (i, &x) in sequence.iter().enumerate() {
        let inner = i > 0 && i + 1 < sequence.len();
        if !inner || (x - sequence[i - 1]) * (sequence[i + 1] - x) < 0.0 {
            turning.push(x);
        }
    }
    let (mut counted, mut kept) = (Vec::new(), Vec::new());
    let mut count = |a: f64, b: f64, n: f64| counted.push(((a - b).abs(), (a + b) / 2.0, n));
    for x in turning {
        kept.push(x);
        while let [.., a, b, c] = kept[..] {
            if (c - b).abs() < (b - a).abs() {
                break;
            }
            let start = kept.len() - 3;
            if start == 0 {
                count(a, b, 0.5);
                kept.remove(0);
            } else {
                count(a, b, 1.0);
                kept.drain(start..start + 2);
            }
        }
    }
    kept.windows(2).for_each(|p| count(p[0], p[1], 0.5));
    counted.sort_by(|a, b| a.partial_cmp(b).unwrap());
    counted
}

/// Miner sum of the worse fillet of a tooth with the history `stress` [Pa], positive under load on one flank, and the
/// largest stress of a pulsating cycle that does the damage of one of its cycles [Pa]. Ranges below 1 % of the strength
/// are left out.
pub fn root(stress: &[f64], material: &ToothStrength) -> (f64, f64) {
    let (mut sums, mut largest) = ([0.0; 2], 0.0f64);
    // a plateau is one turning point
    let mut stress = stress.to_vec();
    stress.dedup();
    for (range, mean, count) in textbook(&stress) {
        if range > 0.01 * material.bending.strength {
            for (sum, mean) in sums.iter_mut().zip([mean, -mean]) {
                let pulsating = pulsating_range(&LoadCycle { range, mean, count }, material.mean_stress_sensitivity());
                *sum += count * material.bending.damage_per_cycle(pulsating);
                largest = largest.max(pulsating);
            }
        }
    }
    (sums[0].max(sums[1]), largest)
}
