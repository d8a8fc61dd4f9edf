//! Tooth forces in space and masses of the gears, computed independently of the program: from the geometry of the teeth
//! and from the surfaces of the exported solids. `tests/python/momentum.py` balances the angular momentum with them.

mod centrifugal;
mod forces;
mod solids;
mod space;
