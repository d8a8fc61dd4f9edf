//! Access to a value within a group of values, and to a group within a larger group.

use crate::spec::EnumType;
use crate::static_memory::store;

/// Access to a value of type `T` in a group `P`. Rows are created once and exist as long as the library.
pub type Field<P, T> = &'static (dyn for<'a> Fn(&'a mut P) -> &'a mut T + Send + Sync);
/// Getter of an enumeration in a group `P`.
pub type GetChoice<P> = &'static (dyn Fn(&P) -> i32 + Send + Sync);
/// Setter of an enumeration in a group `P`.
pub type SetChoice<P> = &'static (dyn Fn(&mut P, i32) + Send + Sync);

/// Access to a parameter in a group `P` of parameters, by its FMI type.
#[derive(Clone, Copy)]
pub enum Parameter<P: 'static> {
    /// A real.
    Real(Field<P, f64>),
    /// An integer.
    Integer(Field<P, i32>),
    /// A Boolean.
    Boolean(Field<P, bool>),
    /// An enumeration: its type, getter, and setter for a value that is one of its choices.
    Enumeration(&'static EnumType, GetChoice<P>, SetChoice<P>),
}

fn project<P, Q, T>(field: Field<P, T>, group: fn(&mut Q) -> &mut P) -> Field<Q, T> {
    store(move |q| field(group(q)))
}

impl<P> Parameter<P> {
    /// Returns the parameter as a member of a larger group that contains its group.
    pub fn within<Q: Copy>(self, group: fn(&mut Q) -> &mut P) -> Parameter<Q> {
        match self {
            Self::Real(field) => Parameter::Real(project(field, group)),
            Self::Integer(field) => Parameter::Integer(project(field, group)),
            Self::Boolean(field) => Parameter::Boolean(project(field, group)),
            Self::Enumeration(kind, get, set) => Parameter::Enumeration(
                kind,
                store(move |q: &Q| get(group(&mut { *q }))),
                store(move |q: &mut Q, value| set(group(q), value)),
            ),
        }
    }
}
