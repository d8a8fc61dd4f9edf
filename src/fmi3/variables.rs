//! Variables of FMI 3.0: the rows of the table with the same value references, followed by the variables that only FMI
//! 3.0 has.

use std::ffi::CStr;
use std::sync::OnceLock;

use crate::instance::EVENT_INDICATORS;
use crate::model::{HELD, Happening, MAX_PLANETS, Parameters};
use crate::static_memory::{store_all, store_text};
use crate::variables::{Access, index_of, table};

/// Prefix of the variables of the first planet.
const FIRST: &str = "planet[1].";
/// Prefix of the variables of loaded tooth pairs between planet 1 and the left side gear.
const PAIR: &str = "mesh.pair[";

/// Source of a variable's value.
#[derive(Clone, Copy, Debug)]
pub enum Item {
    /// A row of the table.
    Row(usize),
    /// Time, the independent variable.
    Time,
    /// Kind of the last event, as a number of [`Happening`].
    EventKind,
    /// Position of the last event: number of the side gear, wheel or group of planets, from 1; 0 for teeth or no event.
    EventBody,
    /// Time of the last event.
    EventTime,
    /// Text of the last event.
    EventText,
    /// Number of events from the start up to the last event.
    EventCount,
    /// An event indicator.
    Indicator(usize),
    /// One row of the table for each planet of the scene.
    Planets(&'static [usize]),
    /// One row of the table for each loaded tooth pair.
    Pairs(&'static [usize]),
}

/// A variable that only FMI 3.0 has.
#[derive(Clone, Copy, Debug)]
pub struct Added {
    /// Dotted name.
    pub name: &'static str,
    /// Description of the variable.
    pub description: &'static str,
    /// Source of the value.
    pub item: Item,
}

/// Name and text of each [`Happening`], in the order of their numbers.
pub const HAPPENINGS: [(&str, &CStr, Happening); 8] = [
    ("nothing", c"nothing has happened yet", Happening::Nothing),
    ("wheel_stops", c"a brake begins to hold a wheel", Happening::WheelStops),
    ("wheel_breaks_loose", c"a brake no longer holds a wheel", Happening::WheelBreaksLoose),
    ("clutch_sticks", c"a clutch, a washer or the lock begins to hold", Happening::ClutchSticks),
    ("clutch_slips", c"a clutch, a washer or the lock no longer holds", Happening::ClutchSlips),
    ("tooth_breaks", c"the tooth of the tooth fault breaks", Happening::ToothBreaks),
    ("dog_engages", c"a dog clutch engages", Happening::DogEngages),
    ("dog_disengages", c"a dog clutch disengages", Happening::DogDisengages),
];

/// Index of the row `name`; `usize::MAX` if no row has this name.
fn known_index(name: &str) -> usize {
    index_of(name).unwrap_or(usize::MAX)
}

/// Value reference of the number of planets, on which sizes of arrays depend.
pub fn planet_count() -> u32 {
    static INDEX: OnceLock<u32> = OnceLock::new();
    *INDEX.get_or_init(|| known_index("geometry.planet_count") as u32)
}

/// If row `index` is one of the `held.*` outputs, its index among them (sides, planets, wheels, clutches). These outputs
/// change only at events.
pub fn held(index: usize) -> Option<usize> {
    static INDICES: OnceLock<[usize; HELD]> = OnceLock::new();
    let held = INDICES.get_or_init(|| ["held.sides", "held.planets", "held.wheels", "held.clutches"].map(known_index));
    held.iter().position(|&one| one == index)
}

/// Variables that only FMI 3.0 has. Their value references follow those of the rows.
pub fn added() -> &'static [Added] {
    static ADDED: OnceLock<&[Added]> = OnceLock::new();
    ADDED.get_or_init(|| {
        let own = |name, description, item| Added { name, description, item };
        let mut added = vec![
            own("time", "Simulation time", Item::Time),
            own("event.kind", "Kind of the last event", Item::EventKind),
            own(
                "event.place",
                "Side (1 left, 2 right) or group of planets of the last event; 0 = none",
                Item::EventBody,
            ),
            own("event.time", "Time of the last event", Item::EventTime),
            own("event.text", "Text of the last event", Item::EventText),
        ];
        added.extend((0..EVENT_INDICATORS).map(|k| Added {
            name: store_text(&format!("event.indicator[{}]", k + 1)),
            description: "Changes its sign at an event: flanks touch or part, dry friction sticks or slips",
            item: Item::Indicator(k),
        }));
        added.extend(arrays());
        // at the end, so that all others keep their value references
        added.push(own(
            "event.count",
            "Number of events from the start up to the last event; 0 = none",
            Item::EventCount,
        ));
        store_all(&added)
    })
}

/// Variable with texts that are stored as long as the library.
fn stored(name: &str, description: &str, item: Item) -> Added {
    Added { name: store_text(name), description: store_text(description), item }
}

/// Arrays over planets, and over the loaded tooth pairs of the first planet.
fn arrays() -> Vec<Added> {
    let outputs = table().rows.iter().filter(|row| matches!(row.access, Access::Output(_)));
    let mut arrays = Vec::new();
    for row in outputs {
        if let Some(pair) = row.name.strip_prefix(PAIR).and_then(|rest| rest.strip_prefix("1].")) {
            let members: Vec<usize> = (1..).map_while(|k| index_of(&format!("{PAIR}{k}].{pair}"))).collect();
            let (name, description) =
                (format!("mesh.pairs_{pair}"), format!("{}, for each loaded pair", row.description));
            arrays.push(stored(&name, &description, Item::Pairs(store_all(&members))));
        } else if let Some(quantity) = row.name.strip_prefix(FIRST).filter(|rest| !rest.contains('[')) {
            let members: Vec<usize> =
                (1..=MAX_PLANETS).filter_map(|k| index_of(&format!("planet[{k}].{quantity}"))).collect();
            if members.len() == MAX_PLANETS {
                let (name, description) =
                    (format!("planets.{quantity}"), format!("{}, for each planet", row.description));
                arrays.push(stored(&name, &description, Item::Planets(store_all(&members))));
            }
        }
    }
    arrays
}

/// Returns the variable of a value reference.
pub fn item(reference: u32) -> Option<Item> {
    let (index, rows) = (reference as usize, table().rows.len());
    if index < rows { Some(Item::Row(index)) } else { added().get(index - rows).map(|added| added.item) }
}

impl Item {
    /// Number of values that the variable has with these `parameters`.
    pub fn len(&self, parameters: &Parameters) -> usize {
        if matches!(self, Self::Planets(_) | Self::Pairs(_)) { self.rows(parameters).len() } else { 1 }
    }

    /// Rows of the table behind the variable; empty if there are none. The number of rows depends on the `parameters`.
    pub fn rows<'a>(&'a self, parameters: &Parameters) -> &'a [usize] {
        match self {
            Self::Row(index) => std::slice::from_ref(index),
            Self::Pairs(rows) => rows,
            Self::Planets(rows) => {
                &rows[..usize::try_from(parameters.geometry.planet_count).unwrap_or(0).min(rows.len())]
            }
            _ => &[],
        }
    }
}
