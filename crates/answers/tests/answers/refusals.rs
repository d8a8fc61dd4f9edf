//! Questions that make no sense are answered with their problems.

use answers::ask::{Question, Refusal, ask};
use answers::progress::Progress;
use serde_json::{Value, json};

use crate::folder;

fn refused(question: Value) -> Refusal {
    let question: Question = serde_json::from_value(question).expect("a question");
    ask(&question, &[], &mut Progress::silent()).err().map(Refusal::from).expect("a refusal")
}

fn about(name: &str, set: &[&str]) -> Value {
    json!({"name": name, "scenes": folder(), "set": set})
}

#[test]
fn a_question_of_accuracy_that_makes_no_sense_is_a_problem_in_one_line() {
    for (want, within, from, parts) in [
        ("left.sped:mean", "1%", None, &["left.sped", "did you mean left.speed?"][..]),
        ("left.speed:meen", "1%", None, &["meen", "did you mean mean?"]),
        ("geometry.module:mean", "1%", None, &["is a parameter"]),
        // no teeth mesh while driving straight
        ("left.speed:mesh_order_1", "1%", None, &["mesh_order_1", "period"]),
        ("left.speed:mean", "0", None, &["above 0"]),
        ("left.speed:mean", "200%", None, &["below 100 %"]),
        ("left.speed:mean", "1%", Some("2s"), &["from", "0.5 s"]),
        ("left.speed:mean", "1%", Some("2m"), &["from", "unit m"]),
    ] {
        let of = about("study_straight", &[]);
        let found = refused(json!({"ask": "accuracy", "of": of, "want": [want], "within": within, "from": from}));
        let message = &found.problems[0].message;
        assert!(found.kind == "use" && found.problems.len() == 1, "{found:?}");
        assert!(!message.contains('\n') && parts.iter().all(|part| message.contains(part)), "{message}");
    }
    let set = ["scene.gear_contact=lumped", "effects.tooth_friction=true"];
    let found = refused(json!({"ask": "accuracy", "of": about("study_straight", &set), "within": "1%"}));
    assert_eq!((found.kind, found.problems[0].variable.as_deref()), ("use", Some("effects.tooth_friction")));
}

#[test]
fn a_missing_or_too_long_scene_is_refused_by_name() {
    let found = refused(json!({"ask": "plan", "of": about("study_strait", &[])}));
    assert_eq!(found.problems[0].hint.as_deref(), Some("study_straight"));
    let found = refused(json!({"ask": "plan", "of": about("study_straight", &["stop_time=1e9", "step=1e-9"])}));
    assert!(found.problems[0].message.contains("more than"), "{found:?}");
    let found =
        refused(json!({"ask": "plan", "of": about("study_straight", &["geometry.module=1 m", "stop_time=-1"])}));
    assert_eq!(found.problems.len(), 2);
    assert_eq!((found.problems[0].variable.as_deref(), found.problems[0].unit), (Some("geometry.module"), Some("m")));
}

#[test]
fn gears_that_cannot_be_built_are_refused_with_all_reasons() {
    let set = ["geometry.face_width=41mm", "geometry.planet_count=3", "geometry.planet_bore=60mm"];
    let found = refused(json!({"ask": "geometry", "set": set, "facets": 0, "thicken": "1 kg"}));
    let messages: Vec<&str> = found.problems.iter().map(|problem| problem.message.as_str()).collect();
    let messages = messages.join("\n");
    for reason in
        ["no teeth at the toe", "cannot be assembled", "root circle at the toe", "facets 0: must be", "thicken 1 kg"]
    {
        assert!(messages.contains(reason), "{reason}: {messages}");
    }
}

#[test]
fn statistics_need_numbers_that_fit() {
    let question =
        |points: usize| json!({"ask": "statistics", "points": points, "figures": [{"statistic": "mean", "series": 0}]});
    let asked = |points: usize, numbers: &[f64]| {
        ask(&serde_json::from_value(question(points)).expect("a question"), numbers, &mut Progress::silent())
    };
    // linear from 0 to 2 and from 2 to 4, over unequal steps
    let answer = asked(3, &[0.0, 1.0, 3.0, 0.0, 2.0, 4.0]).expect("a figure");
    assert_eq!(answer["figures"], json!([7.0 / 3.0]));
    for (points, numbers) in [(4, &[0.0, 1.0, 3.0, 0.0, 2.0, 4.0][..]), (0, &[]), (3, &[]), (3, &[0.0, 1.0, 2.0])] {
        assert!(asked(points, numbers).is_err(), "{points} {numbers:?}");
    }
}
