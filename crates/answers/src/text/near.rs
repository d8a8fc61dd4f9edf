//! Suggestions for wrong names, compared word by word.

use std::collections::HashMap;

use strsim::{jaro_winkler, normalized_damerau_levenshtein};

/// Maximum number of suggested names. If more names are equally similar, none is suggested.
const MOST: usize = 3;
/// Similarity above which two words count as the same word with a typing error, an abbreviation or another plural.
const SAME_WORD: f64 = 0.79;
/// Similarity of all letters above which two names are similar without equal words.
const SAME_LETTERS: f64 = 0.7;
/// Similarity of the letters after the last point that is needed in addition. Otherwise, a long group that is equal would
/// hide a quantity that is not.
const SAME_QUANTITY: f64 = 0.4;
/// Share of the wrong name, weighted by words, that a suggested name must contain.
const SHARE: f64 = 0.65;
/// Names whose scores differ from the best one by less than this are equally similar.
const TIE: f64 = 0.03;
/// Weight of the words before the last point, which name the group, because users often mistake the group.
const GROUP: f64 = 0.5;
/// Deduction from the score if the user wrote no word of a name; proportional if some words match.
const EXTRA_WORDS: f64 = 0.3;

/// Returns the names that `wrong` probably means, the most similar first, at most three.
///
/// As in a search, rare words weigh more than frequent ones: `module` says more than `planet`.
pub fn near<'a>(wrong: &str, names: impl IntoIterator<Item = &'a str>) -> Vec<&'a str> {
    let names: Vec<(&str, Vec<String>)> = names.into_iter().map(|name| (name, words(name))).collect();
    // the last part of too many names
    if names.iter().filter(|(name, _)| name.split_once('.').is_some_and(|(_, last)| last == wrong)).count() > MOST {
        return Vec::new();
    }
    let weights = Weights::of(&names);
    let quantity_of = |name: &str| words(name.rsplit('.').next().unwrap_or_default());
    let (meant, quantity) = (words(wrong), quantity_of(wrong));
    let letters = meant.concat();
    let group = meant.len() - quantity.len();
    let has_similar_quantity = |name: &str| {
        let [given, other] = [quantity.concat(), quantity_of(name).concat()];
        group == 0 || normalized_damerau_levenshtein(&given, &other) >= SAME_QUANTITY
    };
    let mut scored: Vec<(f64, &str)> = names
        .iter()
        .filter_map(|(name, words)| {
            let by_letters = normalized_damerau_levenshtein(&letters, &words.concat());
            let is_similar = by_letters >= SAME_LETTERS && has_similar_quantity(name);
            let by_letters = if is_similar { by_letters } else { 0.0 };
            let score = by_words((&meant[..group], &meant[group..]), words, &weights).max(by_letters);
            (score > 0.0).then_some((score, *name))
        })
        .collect();
    scored.sort_by(|(a, _), (b, _)| b.total_cmp(a));
    let best = scored.first().map_or(0.0, |(score, _)| *score);
    let tied: Vec<&str> = scored.iter().take_while(|(score, _)| best - score < TIE).map(|(_, name)| *name).collect();
    if tied.len() > MOST { Vec::new() } else { tied }
}

/// Returns `; did you mean …?` with the names that `wrong` probably means; empty if there are none.
pub fn hint<'a>(wrong: &str, names: impl IntoIterator<Item = &'a str>) -> String {
    let found = near(wrong, names);
    if found.is_empty() { String::new() } else { format!("; did you mean {}?", found.join(" or ")) }
}

/// Words of a name in lower case, without punctuation.
pub fn words(name: &str) -> Vec<String> {
    let parts = name.split(|letter: char| !letter.is_alphanumeric()).filter(|word| !word.is_empty());
    parts.map(str::to_lowercase).collect()
}

/// Weights of words: rare words have more weight.
struct Weights {
    by_word: HashMap<String, f64>,
    /// Weight of a word that occurs in no name.
    unknown: f64,
}

impl Weights {
    fn of(names: &[(&str, Vec<String>)]) -> Self {
        let mut counts = HashMap::<String, usize>::new();
        for (_, words) in names {
            let mut words: Vec<&String> = words.iter().collect();
            words.sort_unstable();
            words.dedup();
            words.into_iter().for_each(|word| *counts.entry(word.clone()).or_default() += 1);
        }
        let all = names.len() as f64;
        let by_word: HashMap<_, _> =
            counts.into_iter().map(|(word, count)| (word, ((all + 1.0) / count as f64).ln())).collect();
        let unknown = by_word.values().sum::<f64>() / (by_word.len() as f64).max(1.0);
        Self { by_word, unknown }
    }

    fn of_word(&self, word: &str) -> f64 {
        self.by_word.get(word).copied().unwrap_or(self.unknown)
    }
}

/// Similarity of the given words of group and quantity to the words of a name, from 0 to 1; 0 if they are too
/// different. The order does not matter.
fn by_words((group, quantity): (&[String], &[String]), words: &[String], weights: &Weights) -> f64 {
    let mut left: Vec<&String> = words.iter().collect();
    let (mut found, mut all) = (0.0, 0.0);
    for (word, factor) in group.iter().map(|word| (word, GROUP)).chain(quantity.iter().map(|word| (word, 1.0))) {
        let alike = left.iter().map(|other| alike(word, other)).enumerate().max_by(|(_, a), (_, b)| a.total_cmp(b));
        match alike {
            Some((place, likeness)) if likeness >= SAME_WORD => {
                let other = left.swap_remove(place);
                let weight = factor * weights.of_word(if weights.by_word.contains_key(word) { word } else { other });
                found += weight * likeness;
                all += weight;
            }
            _ => all += factor * weights.of_word(word),
        }
    }
    if found < SHARE * all || all == 0.0 {
        return 0.0;
    }
    found / all * (1.0 - EXTRA_WORDS * left.len() as f64 / words.len() as f64)
}

/// Similarity of two words from 0 to 1.
fn alike(a: &str, b: &str) -> f64 {
    // one letter is not an abbreviation, and 1 is not 11
    if a.len() < 3 || b.len() < 3 || a.bytes().chain(b.bytes()).any(|letter| letter.is_ascii_digit()) {
        return f64::from(u8::from(a == b));
    }
    // a long word is not a misspelt short one unless it begins with it
    let letters = normalized_damerau_levenshtein(a, b);
    if letters >= 0.5 || a.starts_with(b) || b.starts_with(a) { jaro_winkler(a, b) } else { letters }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_most_similar_names_are_suggested_if_they_are_similar_enough() {
        let literals = ["line", "line_weber", "point"];
        for (wrong, expected) in [("lin", vec!["line"]), ("webber", vec!["line_weber"]), ("xyz", vec![]), ("", vec![])]
        {
            assert_eq!(near(wrong, literals), expected, "{wrong}");
        }
    }

    #[test]
    fn the_same_group_alone_suggests_nothing() {
        let names = ["final_drive.hand", "final_drive.damping", "final_drive.ring_teeth"];
        assert_eq!(near("final_drive.ratio", names), Vec::<&str>::new());
        for (wrong, meant) in [("final_drive.hamd", 0), ("final_drive.dampning", 1), ("finaldrive.ringteeth", 2)] {
            assert_eq!(near(wrong, names), [names[meant]], "{wrong}");
        }
    }

    #[test]
    fn too_many_equally_similar_names_give_no_suggestion() {
        let names = ["a.torque", "b.torque", "c.torque", "d.torque", "e.speed"];
        assert_eq!(near("torque", names), Vec::<&str>::new());
        assert_eq!(near("torque", names[1..4].iter().copied()), names[1..4]);
        assert_eq!(hint("torque", names[2..4].iter().copied()), "; did you mean c.torque or d.torque?");
        assert_eq!(hint("speed", names), "; did you mean e.speed?");
    }
}
