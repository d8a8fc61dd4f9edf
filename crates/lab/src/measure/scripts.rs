//! The commands that measure by a Python script. The scripts are in crates/lab/python, benches and examples.

use crate::tools::script::{DEFAULTS, Given, Needs, Script, flag, number, path};

/// Cost of accuracy: methods over tolerances and steps, the cheapest setting by quantity, contact laws, and levels of gear contact.
pub const COST: Script = Script {
    name: "cost",
    about: "Measures what accuracy costs: methods, levels of gear contact and settings",
    options: || {
        vec![
            flag("quick", "Take under a minute: fewer tolerances, steps and runs"),
            flag("decisions", "Make only the tables of decisions and laws").conflicts_with("quick"),
            flag("write", "Also renew the tables in docs/accuracy.md and docs/inside/cost.md, and their figures"),
        ]
    },
    file: "crates/lab/python/cost.py",
    folder: Some("cost"),
    given: &[Given::Fmu, Given::Folder, Given::Named("quick"), Given::Named("decisions")],
    sections: &[("docs/accuracy.md", "decisions", "decisions.md"), ("docs/inside/cost.md", "cost", "summary.md")],
    has_pictures: true,
    ..DEFAULTS
};

/// Error and time of faceted solid teeth against exact teeth, in the study's turn.
pub const SOLIDS: Script = Script {
    name: "solids",
    about: "Measures how the number of facets of solid teeth affects accuracy and time",
    more: Some("Fails if solids miss the mean force of exact teeth."),
    options: || {
        vec![
            flag("quick", "Only 4 to 32 facets over 0.1 s").conflicts_with("write"),
            flag("write", "Also renew the tables in docs/inside/cost.md and docs/study.md and the figures"),
        ]
    },
    file: "crates/lab/python/solids.py",
    folder: Some("solids"),
    given: &[Given::Fmu, Given::Folder, Given::Named("quick")],
    sections: &[("docs/inside/cost.md", "solids", ""), ("docs/study.md", "solids", "study.md")],
    has_pictures: true,
    ..DEFAULTS
};

/// Check of the command `accuracy`. For random scenes each chosen setting runs in the packaged FMU and is compared with another
/// method. For the shipped scenes the time of an answer is measured.
pub const SURVEY: Script = Script {
    name: "survey",
    about: "Checks answers of `accuracy` on random scenes, in the FMU, against another method",
    options: || {
        vec![
            number("scenes", "SCENES", "60", "Number of scenes").value_parser(clap::value_parser!(u64).range(1..)),
            number("seed", "SEED", "1", "Seed of the scenes"),
            flag("shipped", "Answer for the shipped scenes instead (all outputs to 1 %), and time the answers"),
            flag("write", "Also renew the section in docs/accuracy.md"),
        ]
    },
    file: "crates/lab/python/survey.py",
    doing: "answering",
    folder: Some("survey"),
    given: &[Given::Fmu, Given::Folder, Given::Value("scenes"), Given::Value("seed"), Given::Named("shipped")],
    sections: &[("docs/accuracy.md", "survey", "survey.md"), ("docs/accuracy.md", "shipped", "shipped.md")],
    ..DEFAULTS
};

/// This program against other simulators, on the study's two cases.
pub const SIMULATORS: Script = Script {
    name: "compare-simulators",
    about: "Compares MuJoCo and Drake with this program on the study's cases (a few minutes)",
    options: || vec![flag("quick", "A few rows, once"), flag("write", "Also renew docs/inside/compare.md")],
    needs: Needs::Own(["benches/peers", "peers/venv", "MuJoCo, Drake, fmpy"]),
    file: "benches/peers/run.py",
    doing: "comparing",
    folder: Some("peers"),
    given: &[Given::Fmu, Given::Folder, Given::Named("quick")],
    sections: &[("docs/inside/compare.md", "peers", "")],
    has_pictures: true,
    ..DEFAULTS
};

/// This program's methods against solvers of other authors, on the same equations.
pub const SOLVERS: Script = Script {
    name: "compare-solvers",
    about: "Compares scipy's LSODA and Radau and CVODE with this program's method on the same equations (many minutes)",
    options: || vec![flag("quick", "Two cases, once"), flag("write", "Also renew docs/inside/compare.md")],
    needs: Needs::Own(["benches/foreign", "foreign", "scipy, scikit-SUNDAE"]),
    file: "benches/foreign/compare.py",
    doing: "comparing",
    folder: Some("cost"),
    given: &[Given::Equations, Given::Folder, Given::Named("quick")],
    sections: &[("docs/inside/compare.md", "foreign", "")],
    ..DEFAULTS
};

/// A drivetrain coupled from FMUs against one system with all its equations. The FMU has integers in the place of enumerations,
/// because libcosim cannot set enumerations.
pub const DRIVETRAIN: Script = Script {
    name: "drivetrain",
    about: "Couples a drivetrain of FMUs and compares it with one integration of all equations (many minutes)",
    options: || {
        vec![
            flag("quick", "Ideal gears only, in a minute and a half").conflicts_with("write"),
            flag("write", "Also renew docs/inside/hosts.md and docs/coupling.md"),
        ]
    },
    needs: Needs::Own(["examples/drivetrain", "drivetrain/venv", "pythonfmu, fmpy, libcosim, pyssp-standard"]),
    file: "examples/drivetrain/run.py",
    doing: "coupling",
    folder: Some("drivetrain"),
    given: &[Given::PlainFmu, Given::Equations, Given::Folder, Given::Named("quick")],
    sections: &[("docs/inside/hosts.md", "drivetrain", ""), ("docs/coupling.md", "drivetrain", "summary.md")],
    has_pictures: true,
    ..DEFAULTS
};

/// The contact patterns of the documentation, by the command `pattern` of the Python package.
pub const PATTERNS: Script = Script {
    name: "patterns",
    about: "Shows the contact patterns of docs/geometry.md: aligned teeth, and one deviation at a time",
    options: || vec![flag("write", "Also renew docs/geometry.md and its figures")],
    file: "bevel_differential",
    doing: "simulating",
    folder: Some("pattern"),
    given: &[
        Given::Word("pattern"),
        Given::Word("--progress"),
        Given::Word("lines"),
        Given::Word("--out"),
        Given::Folder,
    ],
    sections: &[("docs/geometry.md", "pattern", "findings.md")],
    has_pictures: true,
    ..DEFAULTS
};

/// Times of levels, laws and effects: each separately, each pair, and all together; or the ratios of the times of two builds.
/// The command `accuracy` and the page use the separate prices.
pub const PRICES: Script = Script {
    name: "prices",
    about: "Times levels, laws and effects, or compares the FMUs of two builds (an idle machine, some minutes)",
    options: || {
        vec![
            path("against", "FMU", "The FMU of another build: prints the ratios of this build's times to its own")
                .conflicts_with("write"),
            flag("quick", "Three runs of each instead of nine, and no pairs").conflicts_with("write"),
            flag("write", "Also renew the tables in docs/accuracy.md and the prices that `accuracy` uses"),
        ]
    },
    file: "crates/lab/python/prices.py",
    doing: "timing",
    folder: Some("prices"),
    given: &[Given::Named("against"), Given::Fmu, Given::Folder, Given::Named("quick")],
    sections: &[("docs/accuracy.md", "prices", ""), ("crates/answers/data/prices.csv", "", "prices.csv")],
    ..DEFAULTS
};

/// Wording that readers stumble over, counted in doc comments and pages. It is a tool for writers and never fails.
pub const WORDS: Script = Script {
    name: "words",
    about: "Counts wording that readers stumble over: openings of doc comments, compressed phrases, long sentences",
    options: || {
        vec![
            path("within", "PATH", "Only this folder or file of the repository"),
            flag("places", "Also print each place"),
        ]
    },
    file: "crates/lab/python/words.py",
    doing: "reading",
    given: &[Given::Named("within"), Given::Named("places")],
    ..DEFAULTS
};
