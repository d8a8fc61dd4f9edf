//! What builds the FMU: its description, the libraries for each platform and their tool chains, licences, documentation,
//! and the archive. Commands: `package`, `describe`, `toolchains`.

pub mod describe;
pub mod documentation;
pub mod libraries;
pub mod licences;
pub mod package;
pub mod plain_types;
pub mod toolchains;
pub mod xml;
