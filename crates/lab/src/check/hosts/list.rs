//! The hosts and their properties.

/// How a host is started.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum HostStart {
    /// A script in tests/hosts, with its arguments.
    Script(&'static str, &'static [&'static str]),
    /// The program of tests/hosts/rust with the host's name.
    Rust(&'static str),
}

/// A host.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Host {
    /// Its name in the table.
    pub name: &'static str,
    /// How it is started.
    pub start: HostStart,
    /// Language it is used from, and the one it is written in.
    pub language: &'static str,
    /// What imports the FMU.
    pub import: &'static str,
    /// Whether it sets Enumerations; one that does not gets the FMU described with Integers.
    pub enumerations: bool,
    /// Whether it lets outputs be read before the first step.
    pub reads_start: bool,
    /// What it sets before initialisation and at communication points.
    pub sets: &'static str,
    /// What to do if it cannot be loaded.
    pub hint: &'static str,
}

const PACKAGES: &str = "pip install -r tests/hosts/requirements.txt";

/// All hosts; the others are compared with the first one.
pub const HOSTS: [Host; 9] = [
    Host {
        name: "fmpy",
        start: HostStart::Script("with_fmpy.py", &[]),
        language: "Python",
        import: "its own, ctypes",
        enumerations: true,
        reads_start: true,
        sets: "all types; inputs at any point",
        hint: PACKAGES,
    },
    Host {
        name: "fmuloader",
        start: HostStart::Script("with_fmuloader.py", &[]),
        language: "Python",
        import: "its own, ctypes",
        enumerations: true,
        reads_start: true,
        sets: "all types, by reference; inputs at any point",
        hint: PACKAGES,
    },
    Host {
        name: "libcosim",
        start: HostStart::Script("with_libcosim.py", &[]),
        language: "Python, C++",
        import: "FMI Library",
        enumerations: false,
        reads_start: false,
        sets: "initial values but no Enumerations; inputs by manipulator",
        hint: PACKAGES,
    },
    Host {
        name: "ecos",
        start: HostStart::Script("with_ecos.py", &[]),
        language: "Python, C++",
        import: "fmi4c",
        enumerations: false,
        reads_start: true,
        sets: "a parameter set but no Enumerations; inputs at any point",
        hint: "apt install libtbb12",
    },
    Host {
        name: "ecos, process",
        start: HostStart::Script("with_ecos.py", &["--process"]),
        language: "Python, C++",
        import: "fmi4c, proxyfmu",
        enumerations: false,
        reads_start: true,
        sets: "the same; the FMU in a separate process",
        hint: "apt install libtbb12",
    },
    Host {
        name: "fmucontainer",
        start: HostStart::Script("with_fmu_container.py", &[]),
        language: "Python, C",
        import: "its own, an FMU around it",
        enumerations: true,
        reads_start: true,
        sets: "all types, as Integers; inputs at any point",
        hint: PACKAGES,
    },
    Host {
        name: "fmu-runner",
        start: HostStart::Rust("fmu-runner"),
        language: "Rust",
        import: "libfmi",
        enumerations: true,
        reads_start: true,
        sets: "all types; inputs at any point",
        hint: "cargo must reach crates.io",
    },
    Host {
        name: "fmi-rs",
        start: HostStart::Rust("fmi-rs"),
        language: "Rust",
        import: "its own",
        enumerations: true,
        reads_start: true,
        sets: "all types; inputs at any point",
        hint: "cargo must reach crates.io, and a C compiler is needed",
    },
    Host {
        name: "fmi-sim",
        start: HostStart::Script("with_fmi_sim.py", &[]),
        language: "Rust",
        import: "fmi",
        enumerations: true,
        reads_start: true,
        sets: "Reals, Integers, Booleans by --init-values; inputs by file",
        hint: "cargo must reach crates.io, and libclang is needed",
    },
];
