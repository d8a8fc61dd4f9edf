//! Effects, each with one file and one line in the list. Parameters, switches, rows, heat, readings and the terms that
//! act in a scene follow from this list. `effect_kinds` defines what an effect may declare and do;
//! `docs/inside/architecture.md` shows how to add one.

mod bearing_drag;
mod body_compliance;
mod clutches;
pub mod coupling_advice;
mod disconnect;
mod final_drive;
pub mod half_shaft;
mod limited_slip;
mod lock;
pub mod mesh_history;
mod pin_compliance;
mod propeller_shaft;
pub mod strength;
mod thrust_friction;
mod tooth_errors;
mod tooth_fault;
mod tooth_friction;
pub mod warm_up;
mod wheel_brake;

pub use disconnect::DogSides;
pub use final_drive::{FinalDriveSpec, Hand, RingSide};

use std::any::{Any, TypeId};

use serde::{Deserialize, Serialize};

use crate::contact::errors::{ToothErrorSpec, ToothFaultSpec};
use crate::declaration::{Condition, Field, Need, Parameter, Row, Rows, RowsOf, Setting, row};
use crate::friction::ToothFrictionSpec;
use crate::geometry::PlainTeeth;
use crate::model::effect_kinds::{
    Attached, Class, Declare, Effect, Heat, InputField, Memory, Needs, Reading, Refinement, Remembered,
};

/// Entry of an effect in the list [`EFFECTS`].
#[derive(Clone, Copy, Debug)]
pub struct EffectEntry {
    /// Name, as in `effects.NAME` and `NAME.parameter`.
    pub name: &'static str,
    /// Description in the interface.
    pub description: &'static str,
    /// Name of its switch; `None` if an input commands the effect.
    pub switch: Option<&'static str>,
    /// Representations of tooth contact that the effect needs. With `None`, it works with all of them.
    pub needs: Option<Needs>,
    /// Switch of another effect that it needs.
    pub needs_effect: Option<&'static str>,
    /// Its meaning for a user who asks how accurate a model must be.
    pub class: Class,
    /// Parts of its model that a plainer model leaves out.
    pub refinements: &'static [Refinement],
    /// True if the effect may act although its switch is off.
    pub may_act_unswitched: bool,
    /// Name of its limit of p·v, if it has one.
    pub pv_limit: Option<&'static str>,
    /// Heat in the ledger; `None` if the effect dissipates nothing.
    pub heat: Option<Heat>,
    /// Outputs in addition to the heat.
    pub readings: &'static [Reading],
    /// Bodies that it may attach.
    pub bodies: &'static [Attached],
    /// Values that make the effect visible in an example.
    pub example: &'static [(&'static str, f64)],
}

impl EffectEntry {
    const fn new<E: Declare>(name: &'static str, switch: Option<&'static str>) -> Self {
        Self {
            name,
            description: E::DESCRIPTION,
            switch,
            needs: E::NEEDS,
            needs_effect: E::NEEDS_EFFECT,
            class: E::CLASS,
            refinements: E::REFINEMENTS,
            may_act_unswitched: E::MAY_ACT_UNSWITCHED,
            pv_limit: E::PV_LIMIT,
            heat: E::HEAT,
            readings: E::READINGS,
            bodies: E::BODIES,
            example: E::EXAMPLE,
        }
    }
}

/// Rows of an effect's parameters within the parameters of all effects. Without its switch, they have no influence.
fn within<E: Declare>(
    switch: Option<Condition>,
    group: fn(&mut EffectParameters) -> &mut E,
) -> impl Iterator<Item = Row<Parameter<EffectParameters>>> {
    let switch = switch.filter(|_| !E::MAY_ACT_UNSWITCHED);
    E::rows().into_iter().map(move |row| Row { switch, ..row.map(|at| at.within(group)) })
}

/// Row of the switch of an effect.
fn switch<E: Declare>(name: &'static str, at: Field<Effects, bool>) -> Row<Parameter<Effects>> {
    Row { when: E::when(), ..row(name, E::DESCRIPTION).map(|()| bool::parameter(at)) }
}

macro_rules! effects {
    (switched { $($name:ident: $effect:ty $([$memory:ty])?,)+ } commanded { $($command:ident: $commanded:ty,)+ }) => {
        /// Switches of plain teeth and of the effects.
        #[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
        pub struct Effects {
            /// Switches of plain teeth.
            pub teeth: PlainTeeth,
            $(#[allow(missing_docs)] pub $name: bool,)+
        }

        impl Effects {
            /// All switches, by their names.
            pub fn switches(&self) -> impl Iterator<Item = (&'static str, bool)> {
                let teeth = [("effects.backlash", self.teeth.backlash), ("effects.corner_contact", self.teeth.corner_contact)];
                let effects = [$((concat!("effects.", stringify!($name)), self.$name)),+];
                teeth.into_iter().chain(effects)
            }

            /// Names of all switches that are on.
            pub fn active(&self) -> impl Iterator<Item = &'static str> {
                self.switches().filter_map(|(name, on)| on.then_some(name))
            }

            /// True if an effect that is on biases the torque by friction.
            pub fn bias_torque(&self) -> bool {
                false $(|| self.$name && <$effect>::BIASES_TORQUE)+
            }

            /// True if an effect that is on records steps.
            pub fn record_steps(&self) -> bool {
                false $(|| self.$name && <$effect>::RECORDS_STEPS)+
            }

            /// The switches under the integration of the host, which computes the motion between completed steps.
            pub fn without_own_steps(&self) -> Self {
                Self { $($name: self.$name && !matches!(<$effect>::when(), Some(Condition::OwnSteps)),)+ ..*self }
            }

            /// True if the effect with the parameters of type `kind` is on; `None` if there is no such effect.
            pub fn is_on(&self, kind: TypeId) -> Option<bool> {
                $(if kind == TypeId::of::<$effect>() {
                    return Some(self.$name);
                })+
                None
            }
        }

        /// Parameters of all effects.
        #[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
        #[allow(missing_docs)]
        pub struct EffectParameters {
            $(pub $name: $effect,)+
            $(pub $command: $commanded,)+
        }

        /// Memories of the effects that are on.
        #[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
        #[allow(missing_docs)]
        pub struct Memories {
            $($(pub $name: Remembered<$memory>,)?)+
        }

        /// What [`Memories::roll_back`] needs in addition to what the memories keep themselves.
        #[derive(Clone, Copy)]
        pub struct Checkpoints {
            $($($name: Option<<$memory as Memory>::Checkpoint>,)?)+
        }

        impl Memories {
            /// True if a simulation can continue from these memories.
            pub fn is_valid(&self) -> bool {
                true $($(&& self.$name.get().is_none_or(<$memory>::is_valid))?)+
            }

            /// Name of an effect whose memory cannot replace that at the `start` of a new run of the same scene.
            pub fn misfit(&self, start: &Self) -> Option<&'static str> {
                $($(if !Remembered::<$memory>::fits(&self.$name, &start.$name) {
                    return Some(concat!("effects.", stringify!($name)));
                })?)+
                None
            }

            /// Remembers the present values for [`Self::roll_back`].
            pub fn checkpoint(&mut self) -> Checkpoints {
                Checkpoints { $($($name: self.$name.get_mut().map(<$memory>::checkpoint),)?)+ }
            }

            /// Returns to the values at the last checkpoint.
            pub fn roll_back(&mut self, to: Checkpoints) {
                $($(if let (Some(memory), Some(to)) = (self.$name.get_mut(), to.$name) {
                    <$memory>::roll_back(memory, to);
                })?)+
            }

            /// Forgets what depends on tunable parameters, because they have changed.
            pub fn tuned(&mut self) {
                $($(if let Some(memory) = self.$name.get_mut() {
                    <$memory>::tuned(memory);
                })?)+
            }
        }

        /// All effects, in the order in which they are set up.
        pub const EFFECTS: &[EffectEntry] = &[
            $(EffectEntry::new::<$effect>(stringify!($name), Some(concat!("effects.", stringify!($name)))),)+
            $(EffectEntry::new::<$commanded>(stringify!($command), None),)+
        ];

        /// Returns each effect with the state of its switch and its parameters.
        pub fn configured<'a>(
            effects: &Effects,
            parameters: &'a EffectParameters,
        ) -> [(&'static EffectEntry, bool, &'a dyn Effect); EFFECTS.len()] {
            let mut index = 0..EFFECTS.len();
            let mut next = |on: bool, effect: &'a dyn Effect| (&EFFECTS[index.next().unwrap_or(0)], on, effect);
            [$(next(effects.$name, &parameters.$name),)+ $(next(true, &parameters.$command),)+]
        }

        impl Rows for Effects {
            fn rows() -> RowsOf<Self> {
                let teeth = PlainTeeth::rows().into_iter().map(|row| row.map(|at| at.within(|e: &mut Self| &mut e.teeth)));
                let effects = [$(switch::<$effect>(concat!("effects.", stringify!($name)), &|e| &mut e.$name)),+];
                teeth.chain(effects).collect()
            }

            fn find(&self, kind: TypeId) -> Option<&dyn Any> {
                self.teeth.find(kind)
            }
        }

        impl Rows for EffectParameters {
            fn rows() -> RowsOf<Self> {
                let mut rows = Vec::new();
                $(rows.extend(within(Some(switched!($effect, stringify!($name), true)), |p| &mut p.$name));)+
                $(rows.extend(within(None, |p| &mut p.$command));)+
                rows
            }

            fn find(&self, kind: TypeId) -> Option<&dyn Any> {
                None $(.or_else(|| self.$name.find(kind)))+ $(.or_else(|| self.$command.find(kind)))+
            }
        }

        /// Needs of all effects, each with its condition.
        pub fn needs() -> Vec<(Need, Condition)> {
            [$(<$effect>::needs(),)+ $(<$commanded>::needs(),)+].concat()
        }

        /// Rows of the inputs of the effect `name`.
        pub fn inputs_of(name: &str) -> Vec<Row<InputField>> {
            match name {
                $(stringify!($name) => <$effect>::inputs(),)+
                $(stringify!($command) => <$commanded>::inputs(),)+
                _ => Vec::new(),
            }
        }

        /// Rows of the inputs of all effects.
        pub fn inputs() -> Vec<Row<InputField>> {
            let mut rows = Vec::new();
            $(rows.extend(<$effect>::inputs().into_iter().map(|row| Row { switch: Some(switched!($effect, stringify!($name), true)), ..row }));)+
            $(rows.extend(<$commanded>::inputs());)+
            rows
        }
    };
}

effects! {
    switched {
        tooth_errors: ToothErrorSpec,
        tooth_fault: ToothFaultSpec,
        tooth_friction: ToothFrictionSpec,
        thrust_friction: thrust_friction::ThrustFrictionSpec,
        limited_slip: limited_slip::LimitedSlipSpec,
        clutches: clutches::ClutchesSpec,
        disconnect: disconnect::DisconnectSpec,
        half_shaft: half_shaft::HalfShaftSpec,
        pin_compliance: pin_compliance::PinComplianceSpec,
        bearing_drag: bearing_drag::BearingDragSpec,
        final_drive: final_drive::FinalDriveSpec,
        propeller_shaft: propeller_shaft::PropellerShaftSpec,
        strength: strength::StrengthSpec [strength::Fatigue],
        wheel_brake: wheel_brake::WheelBrakeSpec,
        body_compliance: body_compliance::BodyComplianceSpec,
        mesh_history: mesh_history::MeshHistorySpec [mesh_history::MeshHistory],
        warm_up: warm_up::WarmUpSpec,
        coupling_advice: coupling_advice::CouplingAdviceSpec [coupling_advice::Coupling],
    }
    commanded {
        lock: lock::LockSpec,
    }
}
