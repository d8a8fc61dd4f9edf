//! Memory of an effect: values that survive a step, such as damage, histories, or the record of an exchange. It changes
//! only with completed steps.

use std::fmt::Debug;
use std::sync::Arc;

use serde::de::DeserializeOwned;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// Values of an effect that survive a step.
pub trait Memory: Clone + Debug + PartialEq + Serialize + DeserializeOwned {
    /// What [`Self::roll_back`] needs in addition to what the memory keeps itself.
    type Checkpoint: Copy;

    /// Remembers the present values for [`Self::roll_back`].
    fn checkpoint(&mut self) -> Self::Checkpoint;

    /// Returns to the values at the last checkpoint.
    fn roll_back(&mut self, to: Self::Checkpoint);

    /// True if a simulation can continue from these values.
    fn is_valid(&self) -> bool;

    /// True if this memory can replace `start`, that of a new run of the same scene.
    fn fits(&self, _start: &Self) -> bool {
        true
    }

    /// Forgets what depends on tunable parameters, because they have changed.
    fn tuned(&mut self) {}
}

/// Memory of an effect that is on. Copies share it until one of them changes it.
#[derive(Clone, Debug, PartialEq)]
pub struct Remembered<M>(Option<Arc<M>>);

impl<M: Memory> Remembered<M> {
    /// Memory, if the effect is on.
    #[inline]
    pub fn get(&self) -> Option<&M> {
        self.0.as_deref()
    }

    /// Memory to be changed, if the effect is on. It is copied if another copy of the simulation shares it.
    #[inline]
    pub fn get_mut(&mut self) -> Option<&mut M> {
        self.0.as_mut().map(Arc::make_mut)
    }

    /// True if the effect is on.
    #[inline]
    pub fn is_on(&self) -> bool {
        self.0.is_some()
    }

    /// True if this memory can replace that at the `start` of a new run of the same scene.
    pub fn fits(&self, start: &Self) -> bool {
        match (self.get(), start.get()) {
            (Some(memory), Some(start)) => memory.fits(start),
            (memory, start) => memory.is_none() && start.is_none(),
        }
    }
}

impl<M> From<Option<M>> for Remembered<M> {
    fn from(memory: Option<M>) -> Self {
        Self(memory.map(Arc::new))
    }
}

impl<M> Default for Remembered<M> {
    fn default() -> Self {
        Self(None)
    }
}

impl<M: Serialize> Serialize for Remembered<M> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.0.as_deref().serialize(serializer)
    }
}

impl<'de, M: DeserializeOwned> Deserialize<'de> for Remembered<M> {
    #[inline(never)] // its frame is large for a small stack
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        Option::<M>::deserialize(from).map(Self::from)
    }
}
