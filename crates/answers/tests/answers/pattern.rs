//! Contact patterns: an engagement is whole, the load lies where the offset brings it, and files have no holes.

use answers::pattern::cases::{PatternCase, turn};
use answers::pattern::envelope::Envelope;
use answers::pattern::findings::{PatternFindings, centroid, markdown};
use answers::pattern::sample::{Engagement, LoadedSection};
use answers::progress::Progress;
use bevel_differential::contact::errors::ToothErrorSpec;
use bevel_differential::model::GearContact;

fn record(errors: &ToothErrorSpec) -> Engagement {
    Engagement::new(&turn(errors).expect("a scene"), &mut Progress::silent()).expect("an engagement")
}

fn case(errors: &ToothErrorSpec) -> PatternCase {
    PatternCase { name: "case".into(), title: "a case, shown".into(), scene: turn(errors).expect("a scene") }
}

#[test]
fn an_engagement_goes_from_foot_to_tip_and_aligned_teeth_bear_evenly() {
    let errors = ToothErrorSpec::default();
    let record = record(&errors);
    let gear = &record.pair.gears[0];
    let all: Vec<&LoadedSection> = record.engagement().collect();
    let (first, last) = (all[0], all[all.len() - 1]);
    assert!(first.is_corner && last.is_corner && first.s < record.pair.path.low && last.s > record.pair.path.high);
    assert!(first.polar[0] < gear.pitch && (last.polar[0] - gear.tip).abs() < 0.01);
    // light at both ends, and one pair bears all of the mesh at the pitch point
    let pitch = record.at_pitch_point();
    let force = |line: &[LoadedSection]| line.iter().map(LoadedSection::force).sum::<f64>();
    assert!(first.line_load < 0.1 * pitch[0].line_load && last.line_load < 0.1 * pitch[0].line_load);
    let torque = force(&pitch) * record.pair.mean_cone * record.pair.sin_base()[1];
    assert!((torque / (835.0 / 2.0) - 1.0).abs() < 0.01, "{torque}");
    assert!((centroid(&pitch) - record.pair.mean_cone).abs() < 1e-9);
    // p² ρ is the same over the face, and the strip's load that of Hertz's half-ellipse
    for c in &pitch {
        assert!((c.pressure.powi(2) * c.radius / (pitch[0].pressure.powi(2) * pitch[0].radius) - 1.0).abs() < 1e-9);
        assert!((0.5 * std::f64::consts::PI * c.pressure * c.half_width / c.line_load - 1.0).abs() < 1e-9);
        // on the path the arcs of both flanks fill the line of action
        let arcs: f64 = (0..2).map(|i| record.pair.gears[i].action_arc(c.polar[i])).sum();
        assert!((arcs - record.pair.line_of_action()).abs() < 2e-3, "{arcs}");
    }
    let found = PatternFindings::new(&case(&errors), &record).expect("findings");
    assert!(found.is_drive && found.bearing > 0.999 && (found.ends[0] / found.ends[1] - 1.0).abs() < 1e-9);
    assert!(markdown(&[found]).contains("| a case, shown | drive |"));
    let envelope = Envelope::new(&record);
    let most = envelope.pressure.iter().flatten().fold(0.0, |a: f64, &b| a.max(b));
    let greatest = all.iter().map(|c| c.pressure).fold(0.0, f64::max);
    assert!(most > 0.7 * greatest && most < 1.05 * greatest, "{most} {greatest}");
    // nothing has touched the root
    assert!(envelope.pressure.iter().all(|column| column[0] == 0.0));
}

#[test]
fn a_pin_moved_forward_takes_load_to_the_toe_and_files_are_whole() {
    let errors = ToothErrorSpec { axis_offset: 3e-5, ..ToothErrorSpec::default() };
    let record = record(&errors);
    let found = PatternFindings::new(&case(&errors), &record).expect("findings");
    assert!(found.is_drive && found.centroid < -2e-4 && found.ends[0] > 1.1 * found.ends[1], "{found:?}");
    // e = −ε cosα on planet 1 and +ε cosα on planet 2 under one approach a: (a + e)^1.5 shares the torque
    let record = &record;
    let pitch = record.at_pitch_point();
    let line = pitch.iter().map(LoadedSection::force).sum::<f64>();
    assert!(line > 1.35 * 16.0e3 && line < 1.6 * 16.0e3, "{line}");
    let (mut contacts, mut envelope) = (Engagement::file().expect("a file"), Envelope::file().expect("a file"));
    record.rows("case", &mut contacts).expect("rows");
    Envelope::new(record).rows("case", &mut envelope).expect("rows");
    let summary = answers::pattern::findings::csv(&[found]);
    for text in [contacts.text(), envelope.text(), summary] {
        let text = text.expect("a file");
        let mut rows = csv::ReaderBuilder::new().comment(Some(b'#')).from_reader(text.as_bytes());
        let rows: Vec<csv::StringRecord> = rows.records().collect::<Result<_, _>>().expect("rows of one length");
        assert!(!rows.is_empty());
        let is_hole = |cell: &str| ["", "-", "NaN", "inf"].contains(&cell);
        assert!(!rows.iter().any(|row| row.iter().any(is_hole)), "{text}");
    }
}

#[test]
fn scenes_without_solid_teeth_and_scenes_too_short_are_refused() {
    let mut scene = turn(&ToothErrorSpec::default()).expect("a scene");
    scene.stop_time = 0.1;
    assert!(
        Engagement::new(&scene, &mut Progress::silent()).expect_err("too short").to_string().contains("parted again")
    );
    scene.parameters.scene.gear_contact = GearContact::Tooth;
    assert!(
        Engagement::new(&scene, &mut Progress::silent())
            .expect_err("no solids")
            .to_string()
            .contains("scene.gear_contact")
    );
}
