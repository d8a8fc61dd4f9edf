//! Rows of parameters, from the lines of `parameters!`.

use std::any::{Any, TypeId};
use std::ops::RangeInclusive;

use super::{Condition, Field, Parameter, Range, Row, Shown, Unit, Variability, row};
use crate::spec::Choices;
use crate::static_memory::{store, store_text};

/// Value of a parameter.
pub trait Setting: Copy + PartialEq + 'static {
    /// The value as a number.
    fn number(self) -> f64;
    /// The parameter with the access `at`, which exists as long as the library.
    fn parameter<P: Copy + 'static>(at: Field<P, Self>) -> Parameter<P>;
}

macro_rules! settings {
    ($($type:ty: $kind:ident, |$value:ident| $number:expr;)+) => {
        $(impl Setting for $type {
            fn number(self) -> f64 {
                let $value = self;
                $number
            }
            fn parameter<P>(at: Field<P, Self>) -> Parameter<P> {
                Parameter::$kind(at)
            }
        })+
    };
}

settings! {
    f64: Real, |value| value;
    i32: Integer, |value| f64::from(value);
    bool: Boolean, |value| f64::from(u8::from(value));
}

impl<E: Choices + PartialEq> Setting for E {
    fn number(self) -> f64 {
        f64::from(self.value())
    }
    fn parameter<P: Copy + 'static>(at: Field<P, Self>) -> Parameter<P> {
        let get = move |p: &P| at(&mut { *p }).value();
        let set = move |p: &mut P, value| {
            if let Some(choice) = E::of(value) {
                *at(p) = choice;
            }
        };
        Parameter::Enumeration(E::TYPE, store(get), store(set))
    }
}

/// Rows of parameters in the group, or groups, `P`.
pub type RowsOf<P> = Vec<Row<Parameter<P>>>;

/// Group, or groups, with rows of their parameters.
pub trait Rows: Sized {
    /// Rows of the parameters.
    fn rows() -> RowsOf<Self>;
    /// Group of the type `kind`; `None` if there is no such group.
    fn find(&self, kind: TypeId) -> Option<&dyn Any>;
}

/// Adds the rows of a field, with `details`, to `rows`.
#[inline(never)]
pub fn add<A>(rows: &mut Vec<Row<A>>, mut of_field: Vec<Row<A>>, details: &[&dyn Detail<A>]) {
    for (i, row) in of_field.iter_mut().enumerate() {
        details.iter().for_each(|detail| detail.add(i, row));
    }
    rows.append(&mut of_field);
}

/// Type of a field of a group of parameters `P`: one parameter, or a pair.
pub trait Declared: Sized {
    /// Rows of the field `name` of the group `group`.
    fn rows<P: Copy + 'static>(group: &str, name: &str, description: &'static str, at: Field<P, Self>) -> RowsOf<P>;
}

impl<T: Setting> Declared for T {
    fn rows<P: Copy + 'static>(group: &str, name: &str, description: &'static str, at: Field<P, Self>) -> RowsOf<P> {
        vec![row(name_within(group, name), description.trim_start()).map(|()| T::parameter(at))]
    }
}

/// Names of the sides.
pub const SIDES: [&str; 2] = ["left", "right"];

/// One parameter for each side. Its description contains `{side}`.
impl<T: Setting> Declared for [T; 2] {
    fn rows<P: Copy + 'static>(group: &str, name: &str, description: &'static str, at: Field<P, Self>) -> RowsOf<P> {
        let of = |s: usize| {
            let description = filled(description, |_| SIDES[s]);
            T::rows(group, &format!("{}_{name}", SIDES[s]), description, store(move |p| &mut at(p)[s]))
        };
        [of(0), of(1)].concat()
    }
}

/// Returns the name of the parameter `name` in the group `group`.
#[inline(never)]
pub fn name_within(group: &str, name: &str) -> &'static str {
    store_text(&[group, ".", name].concat())
}

/// Returns `text` with the value of each placeholder `{…}`.
pub fn filled<'a>(text: &'static str, value: impl Fn(&str) -> &'a str) -> &'static str {
    let Some((before, mut rest)) = text.split_once('{') else { return text };
    let mut found = String::from(before);
    while let Some((placeholder, behind)) = rest.split_once('}') {
        found += value(placeholder);
        let (plain, next) = behind.split_once('{').unwrap_or((behind, ""));
        found += plain;
        rest = next;
    }
    store_text(&found)
}

/// Starts the rows of a variable of each side. The description contains `{side}`.
#[inline(never)]
pub fn sides(name: &str, description: &'static str) -> [Row<()>; 2] {
    SIDES.map(|side| row(name_within(side, name), filled(description, |_| side)))
}

/// Property of a parameter, as written behind its start value.
pub trait Detail<A> {
    /// Adds the property to the row of a parameter, which is number `i` of the rows of its field.
    fn add(&self, i: usize, row: &mut Row<A>);
}

impl<A> Detail<A> for Unit {
    fn add(&self, _: usize, row: &mut Row<A>) {
        row.unit = Some(*self);
    }
}

impl<A> Detail<A> for Shown {
    fn add(&self, _: usize, row: &mut Row<A>) {
        (row.unit, row.display) = (Some(self.0), self.1);
    }
}

impl<A> Detail<A> for Range {
    fn add(&self, _: usize, row: &mut Row<A>) {
        row.range = Some(*self);
    }
}

impl<A, T: Setting> Detail<A> for RangeInclusive<T> {
    fn add(&self, _: usize, row: &mut Row<A>) {
        row.range = Some(Range { min: self.start().number(), max: self.end().number() });
    }
}

impl<A> Detail<A> for Variability {
    fn add(&self, _: usize, row: &mut Row<A>) {
        row.variability = *self;
    }
}

/// The parameter may also be changed while a simulation runs.
pub const TUNABLE: Variability = Variability::Tunable;

/// Condition under which a parameter, or each parameter of a pair, has an effect.
pub struct When([Condition; 2]);

/// Property of a parameter that has an effect only under the condition.
pub fn when(condition: Condition) -> When {
    When([condition; 2])
}

impl<A> Detail<A> for When {
    fn add(&self, i: usize, row: &mut Row<A>) {
        row.when = row.when.or(Some(self.0[i.min(1)]));
    }
}

/// Property of a pair of parameters whose conditions differ.
pub fn when_each(conditions: [Condition; 2]) -> When {
    When(conditions)
}

/// Condition under which more than outputs that repeat a parameter depend on it.
pub struct ActsWhen(Condition);

/// Property of a parameter that outputs repeat, but that changes anything else only under `condition`.
pub fn acts_when(condition: Condition) -> ActsWhen {
    ActsWhen(condition)
}

impl<A> Detail<A> for ActsWhen {
    fn add(&self, _: usize, row: &mut Row<A>) {
        row.acts_when = Some(self.0);
    }
}
