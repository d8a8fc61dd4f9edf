//! Contact patterns: engagements are complete, the load is where the offset moves it, and files have no gaps.

use answers::pattern::cases::{PatternCase, turn};
use answers::pattern::envelope::Envelope;
use answers::pattern::findings::{PatternFindings, centroid, markdown};
use answers::pattern::sample::Engagement;
use answers::pattern::sections::LoadedSection;
use answers::progress::Progress;
use bevel_differential::contact::ContactLaw;
use bevel_differential::contact::errors::ToothErrorSpec;
use bevel_differential::model::{GearContact, PlanetSpin};

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
    // little load at both ends, and one pair transmits the whole load of the mesh at the pitch point
    let pitch = record.at_pitch_point();
    let force = |line: &[LoadedSection]| line.iter().map(LoadedSection::force).sum::<f64>();
    assert!(first.line_load < 0.1 * pitch[0].line_load && last.line_load < 0.1 * pitch[0].line_load);
    let torque = force(&pitch) * record.pair.mean_cone * record.pair.sin_base()[1];
    assert!((torque / (835.0 / 2.0) - 1.0).abs() < 0.01, "{torque}");
    assert!((centroid(&pitch) - record.pair.mean_cone).abs() < 1e-9);
    // p² ρ is constant over the face, and the load of the strip is that of Hertz's half-ellipse
    for c in &pitch {
        assert!((c.pressure.powi(2) * c.radius / (pitch[0].pressure.powi(2) * pitch[0].radius) - 1.0).abs() < 1e-9);
        assert!((0.5 * std::f64::consts::PI * c.pressure * c.half_width / c.line_load - 1.0).abs() < 1e-9);
        // on the path, the arcs of both flanks add up to the line of action
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
    // the root was not touched
    assert!(envelope.pressure.iter().all(|column| column[0] == 0.0));
}

#[test]
fn a_pin_moved_forward_shifts_the_load_to_the_toe_and_files_are_complete() {
    let errors = ToothErrorSpec { axis_offset: 3e-5, ..ToothErrorSpec::default() };
    let record = record(&errors);
    let found = PatternFindings::new(&case(&errors), &record).expect("findings");
    assert!(found.is_drive && found.centroid < -2e-4 && found.ends[0] > 1.1 * found.ends[1], "{found:?}");
    // e = −ε cosα on planet 1 and +ε cosα on planet 2 under a common approach a: (a + e)^1.5 shares the torque
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
        let mut rows = csv::Reader::from_reader(text.as_bytes());
        let rows: Vec<csv::StringRecord> = rows.records().collect::<Result<_, _>>().expect("rows of one length");
        assert!(!rows.is_empty());
        let is_hole = |cell: &str| ["", "-", "NaN", "inf"].contains(&cell);
        assert!(!rows.iter().any(|row| row.iter().any(is_hole)), "{text}");
    }
}

/// Torque of one mesh: half of the torque of a side gear with two planets [N·m].
const TORQUE: f64 = 835.0 / 2.0;

/// The turn with teeth that have the linear law over the face and `crowning` [m].
fn crowned(crowning: f64) -> Engagement {
    let mut scene = turn(&ToothErrorSpec { crowning, ..ToothErrorSpec::default() }).expect("a scene");
    scene.parameters.scene.gear_contact = GearContact::Tooth;
    scene.parameters.contact.law = ContactLaw::Line;
    Engagement::new(&scene, &mut Progress::silent()).expect("an engagement")
}

/// Torque of sections about the side gear's axis [N·m].
fn torque(record: &Engagement, line: &[LoadedSection]) -> f64 {
    line.iter().map(|c| c.force() * c.cone).sum::<f64>() * record.pair.sin_base()[1]
}

/// Gap of crowned teeth at cone distance `cone`: a parabola that reaches `crowning` at toe and heel [m].
fn opening(record: &Engagement, crowning: f64, cone: f64) -> f64 {
    let face = record.pair.outer_cone - record.pair.inner_cone;
    crowning * ((cone - record.pair.mean_cone) / (0.5 * face)).powi(2)
}

#[test]
fn aligned_teeth_with_a_law_are_loaded_over_face_and_path_in_proportion_to_the_cone_distance() {
    let record = crowned(0.0);
    let (pair, all) = (&record.pair, record.engagement().collect::<Vec<_>>());
    let (first, last) = (all[0], all[all.len() - 1]);
    assert!(first.is_corner && last.is_corner && first.s < pair.path.low && last.s > pair.path.high);
    let pitch = record.at_pitch_point();
    assert!((torque(&record, &pitch) / TORQUE - 1.0).abs() < 1e-3, "{}", torque(&record, &pitch));
    for c in &all {
        // on the path, the aligned flanks touch at equal arcs all over the face
        let arcs: f64 = (0..2).map(|i| pair.gears[i].action_arc(c.polar[i])).sum();
        assert!(c.is_corner || (arcs - pair.line_of_action()).abs() < 1e-9, "{arcs}");
    }
    for c in &pitch {
        let at_first = pitch[0].line_load / pitch[0].cone;
        assert!((c.line_load / c.cone / at_first - 1.0).abs() < 1e-9);
        // w and ρ are proportional to R, so the pressure is constant
        assert!((c.pressure / pitch[0].pressure - 1.0).abs() < 1e-9);
    }
    let envelope = Envelope::new(&record);
    let gear = &pair.gears[0];
    // from the start of rigid contact to the tip, all of the face has been touched, and nothing below
    let start = gear.polar_at(pair.pitch_arc[0] + pair.path.low);
    for column in &envelope.pressure {
        for (polar, pressure) in envelope.polars.iter().zip(column) {
            if *polar > start + 2e-3 {
                assert!(*pressure > 0.0, "{polar}");
            } else if *polar < start - 5e-3 {
                assert_eq!(*pressure, 0.0, "{polar}");
            }
        }
    }
}

#[test]
fn the_length_of_contact_of_crowned_teeth_follows_from_the_equilibrium_of_the_load() {
    // linear law: w = k (a R − e), with k from light crowning
    let (light, strong) = (20e-6, 300e-6);
    let record = crowned(light);
    let pitch = record.at_pitch_point();
    let [one, two] = [pitch[2], pitch[pitch.len() - 3]];
    let [e1, e2] = [one, two].map(|c| opening(&record, light, c.cone));
    // from w₁ R₂ − w₂ R₁ = k (e₂ R₁ − e₁ R₂)
    let k = (one.line_load * two.cone - two.line_load * one.cone) / (e2 * one.cone - e1 * two.cone);
    let turned = (one.line_load / k + e1) / one.cone;
    for c in &pitch {
        let wanted = k * (turned * c.cone - opening(&record, light, c.cone));
        // the damping of the moving teeth, which is missing in this formula, adds a little
        assert!((c.line_load / wanted - 1.0).abs() < 1e-4, "{} {wanted}", c.line_load);
    }
    assert!((torque(&record, &pitch) / TORQUE - 1.0).abs() < 1e-3);
    // with this k, the approach that balances the torque of strongly crowned teeth, and the ends of their contact
    let record = crowned(strong);
    let [inner, outer] = [record.pair.inner_cone, record.pair.outer_cone];
    let cones: Vec<f64> = (0..20000).map(|i| inner + (outer - inner) * (f64::from(i) + 0.5) / 20000.0).collect();
    let line_load = |turned: f64, cone: f64| k * (turned * cone - opening(&record, strong, cone)).max(0.0);
    let held = |turned: f64| {
        let sum: f64 = cones.iter().map(|&cone| line_load(turned, cone) * cone).sum();
        sum * (outer - inner) / 20000.0 * record.pair.sin_base()[1]
    };
    let (mut low, mut high) = (0.0, 0.1);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if held(middle) < TORQUE { low = middle } else { high = middle }
    }
    let loaded: Vec<f64> = cones.iter().copied().filter(|&cone| line_load(low, cone) > 0.0).collect();
    let pitch = record.at_pitch_point();
    let (first, last) = (pitch[0], pitch[pitch.len() - 1]);
    assert!(loaded.len() < 19000, "the contact does not end within the face");
    assert!((first.cone - 0.5 * first.width - loaded[0]).abs() < first.width, "{} {}", first.cone, loaded[0]);
    let end = loaded[loaded.len() - 1];
    assert!((last.cone + 0.5 * last.width - end).abs() < last.width, "{} {end}", last.cone);
    for c in &pitch {
        let wanted = line_load(low, c.cone);
        assert!(
            (c.line_load - wanted).abs() < 0.01 * line_load(low, record.pair.mean_cone),
            "{} {wanted}",
            c.line_load
        );
    }
}

#[test]
fn solid_teeth_and_teeth_with_a_law_touch_the_same_flank() {
    // solid teeth spread the load evenly, so a law over the face has the arm R_F > R_m and a smaller force
    let [law, solid] = [crowned(0.0), record(&ToothErrorSpec::default())];
    let force = |record: &Engagement| record.at_pitch_point().iter().map(LoadedSection::force).sum::<f64>();
    let [inner, outer] = [law.pair.inner_cone, law.pair.outer_cone];
    let arm = (outer.powi(3) - inner.powi(3)) / 3.0 / (0.5 * (outer * outer - inner * inner));
    assert!((force(&law) / force(&solid) * arm / law.pair.mean_cone - 1.0).abs() < 0.01);
    let ends = |record: &Engagement| {
        let angles = || record.engagement().map(|c| c.polar[0]);
        [angles().fold(f64::INFINITY, f64::min), angles().fold(0.0, f64::max)]
    };
    // equal foot and tip within 0.05 mm at the mean cone distance: a step of the solid run, and the shape of its tip
    for (a, b) in ends(&law).into_iter().zip(ends(&solid)) {
        assert!((a - b).abs() * law.pair.mean_cone < 5e-5, "{a} {b}");
    }
}

#[test]
fn standing_teeth_and_a_law_with_one_resultant_have_a_pattern_and_a_warning() {
    let mut scene = turn(&ToothErrorSpec::default()).expect("a scene");
    scene.parameters.scene.gear_contact = GearContact::Tooth;
    scene.parameters.scene.planet_spin = PlanetSpin::Free;
    scene.stop_time = 0.05;
    scene.parameters.geometry.face_width = 22e-3;
    let mut progress = Progress::silent();
    let record = Engagement::new(&scene, &mut progress).expect("a pattern");
    let said = |part: &str| progress.warnings().iter().filter(|text| text.contains(part)).count();
    assert_eq!([said("impact has one resultant"), said("parted again"), said("geometry.face_width")], [1; 3]);
    let pitch = record.at_pitch_point();
    assert!(pitch.iter().all(|c| c.line_load > 0.0 && (c.line_load / pitch[0].line_load - 1.0).abs() < 1e-9));
}

#[test]
fn scenes_without_tooth_pairs_and_scenes_of_solids_too_short_are_refused() {
    let mut scene = turn(&ToothErrorSpec::default()).expect("a scene");
    scene.stop_time = 0.1;
    assert!(
        Engagement::new(&scene, &mut Progress::silent()).expect_err("too short").to_string().contains("parted again")
    );
    scene.parameters.scene.gear_contact = GearContact::Lumped;
    assert!(
        Engagement::new(&scene, &mut Progress::silent())
            .expect_err("no pairs")
            .to_string()
            .contains("scene.gear_contact = tooth")
    );
}

#[test]
fn a_pair_that_does_not_part_is_described_at_its_largest_force() {
    let mut scene = turn(&ToothErrorSpec::default()).expect("a scene");
    let whole = record(&ToothErrorSpec::default());
    // the wheels hardly turn against each other
    scene.inputs.planet_spin *= 1e-3;
    (scene.parameters.scene.gear_contact, scene.parameters.contact.law) = (GearContact::Tooth, ContactLaw::Line);
    let part = Engagement::new(&scene, &mut Progress::silent()).expect("a pair");
    assert!(whole.is_whole && !part.is_whole);
    let force = |line: &[LoadedSection]| line.iter().map(LoadedSection::force).sum::<f64>();
    let case = PatternCase { name: "part".into(), title: "part".into(), scene };
    let found = PatternFindings::new(&case, &part).expect("findings");
    let times: Vec<f64> = part.engagement().map(|section| section.time).collect();
    let at = |time: f64| part.engagement().filter(|section| section.time == time).copied().collect::<Vec<_>>();
    let largest = times.iter().map(|&time| force(&at(time))).fold(0.0, f64::max);
    assert!(found.force == largest && largest > 1e3, "{} {largest}", found.force);
    assert!(markdown(&[found]).contains("of its largest force"));
}
