//! Design of gears: settings as in scenes, each with name, value and unit, and the checks of the FMU.

use bevel_differential::geometry::{GearSpec, Pair, Tredgold, assembly, checks};
use bevel_differential::model::{Inputs, Parameters};
use bevel_differential::problem::Problem;
use bevel_differential::variables::{Causality, Variable, table};

use crate::problem::{self, Problems};
use crate::scene::set::Setting;
use crate::scene::value::of_text;

/// Parameter that may be set in addition to `geometry.*`: the value false removes the backlash.
const BACKLASH_SWITCH: &str = "effects.backlash";
/// Parameters that act only with the value `explicit` of [`SYSTEM`].
const COEFFICIENTS: [&str; 4] =
    ["geometry.planet_addendum", "geometry.side_addendum", "geometry.planet_dedendum", "geometry.side_dedendum"];
const SYSTEM: &str = "geometry.addendum_system";

/// Gears that can be built.
#[derive(Clone)]
pub struct Design {
    /// All parameters. Those that do not determine the geometry have their start values.
    pub parameters: Parameters,
    /// Parameters set by the user, in the given order.
    pub settings: Vec<Setting>,
    /// Specification of the gears, with the backlash that they mesh with.
    pub spec: GearSpec,
    /// Geometry of the gears.
    pub pair: Pair,
    /// Planar approximation of the gears.
    pub planar: Tredgold,
    /// Properties that a gear engineer would question.
    pub warnings: Vec<Problem>,
    /// Properties that are usual for forged differential gears, but not for cut gears.
    pub remarks: Vec<Problem>,
}

impl Design {
    /// Changes the start values by `assignments`, each `name=value`. Fails with all their problems.
    pub fn new<T: AsRef<str>>(assignments: &[T]) -> Result<Self, Problems> {
        let settings = settings(assignments)?;
        let (mut parameters, mut inputs) = (Parameters::default(), Inputs::default());
        settings.iter().for_each(|setting| setting.apply(&mut parameters, &mut inputs));
        let spec = parameters.gears();
        let pair = Pair::new(&spec);
        let mut problems = checks::errors(&spec, &pair);
        problems.extend(assembly::phases(&spec).err());
        if !problems.is_empty() {
            let mut found = Problems::default();
            found.push("these gears cannot be built".to_owned());
            found.extend(&problems);
            return Err(found);
        }
        let planar = Tredgold::new(&pair);
        let (warnings, remarks) = (checks::warnings(&spec, &pair), checks::remarks(&spec, &pair));
        Ok(Self { parameters, settings, spec, pair, planar, warnings, remarks })
    }
}

/// Parameters that determine the geometry.
pub fn parameters() -> impl Iterator<Item = &'static Variable> {
    table().rows.iter().filter(|row| row.causality == Causality::Parameter && is_of_geometry(row.name))
}

fn is_of_geometry(name: &str) -> bool {
    name.starts_with("geometry.") || name == BACKLASH_SWITCH
}

fn settings<T: AsRef<str>>(assignments: &[T]) -> Result<Vec<Setting>, Problems> {
    let (mut found, mut problems) = (Vec::<Setting>::new(), Problems::default());
    for assignment in assignments {
        match setting(assignment.as_ref()) {
            Ok(setting) if found.iter().any(|known| known.row.name == setting.row.name) => {
                problems.push(format!("{} is set twice", setting.row.name));
            }
            Ok(setting) => found.push(setting),
            Err(problem) => problems.push(problem),
        }
    }
    let explicit = found.iter().any(|setting| setting.row.name == SYSTEM && setting.text() == "explicit");
    if !explicit {
        let unread = found.iter().filter(|setting| COEFFICIENTS.contains(&setting.row.name));
        problems
            .extend(unread.map(|setting| format!("{} changes nothing without {SYSTEM}=explicit", setting.row.name)));
    }
    problems.or(found)
}

fn setting(assignment: &str) -> Result<Setting, problem::Problem> {
    let Some((name, text)) = assignment.split_once('=') else {
        return Err(format!("\"{assignment}\" is not of the form name=value, such as geometry.module=4mm").into());
    };
    let setting = Setting::new(name.trim(), &of_text(text.trim()))?;
    if is_of_geometry(setting.row.name) {
        Ok(setting)
    } else {
        let reason = "does not change the geometry; parameters that do";
        Err(problem::Problem::of(name.trim(), text, format!("{} {reason}: {}", setting.row.name, names().join(", "))))
    }
}

fn names() -> Vec<&'static str> {
    parameters().map(|row| row.name).collect()
}
