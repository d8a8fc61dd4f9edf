"""Commands that measure time and error of this program's fidelities and methods, of solid teeth, of couplings of FMUs, and of other
programs on the same cases."""

from .command import command, flag, number, path, write
from .paths import equations, packaged, plain, printed
from .terminal import for_terminal

PEERS = ("benches/peers", "peers/venv", "MuJoCo, Drake, fmpy")
SOLVERS = ("benches/foreign", "foreign", "scipy, scikit-SUNDAE")
DRIVETRAIN = ("examples/drivetrain", "drivetrain/venv", "pythonfmu, fmpy, libcosim, pyssp-standard")


@command(flag("quick", "Take under a minute: fewer tolerances, steps and runs"),
         flag("decisions", "Make only the tables of decisions and laws", without=["quick"]),
         write("the tables in docs/accuracy.md and docs/inside/cost.md, and their figures"))
def cost(work):
    """Measures what accuracy costs: methods, levels of gear contact and settings."""
    work.run("crates/lab/python/cost.py", packaged, work.folder("cost"), *work.given("quick", "decisions"), pictures=True,
             sections=[("docs/accuracy.md", "decisions", "decisions.md"), ("docs/inside/cost.md", "cost", "summary.md")])


@command(flag("quick", "Only 4 to 32 facets over 0.1 s"),
         write("the tables in docs/inside/cost.md and docs/study.md and the figures", without=["quick"]))
def solids(work):
    """Measures how the number of facets of solid teeth affects accuracy and time.

    Fails if solids miss the mean force of exact teeth."""
    work.run("crates/lab/python/solids.py", packaged, work.folder("solids"), *work.given("quick"), pictures=True,
             sections=[("docs/inside/cost.md", "solids", ""), ("docs/study.md", "solids", "study.md")])


@command(write("the tables in docs/inside/stiffness.md"))
def stiffness(work):
    """Compares the stiffness of each law with 3-D finite elements of several gears."""
    page = printed("lab", "stiffness")
    print(for_terminal(page))
    if work.options.write:
        work.renew(page, [("docs/inside/stiffness.md", "stiffness", "")])


@command(number("scenes", 60, "Number of scenes", least=1), number("seed", 1, "Seed of the scenes"),
         flag("shipped", "Answer for the shipped scenes instead (all outputs to 1 %%), and time the answers"),
         write("the section in docs/accuracy.md"), short=["--scenes", "20"])
def survey(work):
    """Checks answers of `accuracy` on random scenes, in the FMU, against another method."""
    options = work.options
    work.run("crates/lab/python/survey.py", packaged, work.folder("survey"), options.scenes, options.seed, *work.given("shipped"),
             doing="answering", sections=[("docs/accuracy.md", name, f"{name}.md") for name in ("survey", "shipped")])


@command(flag("quick", "A few rows, once"), write("docs/inside/compare.md"))
def compare_simulators(work):
    """Compares MuJoCo and Drake with this program on the study's cases (a few minutes)."""
    work.run("benches/peers/run.py", packaged, work.folder("peers"), *work.given("quick"), environment=PEERS, doing="comparing",
             sections=[("docs/inside/compare.md", "peers", "")], pictures=True)


@command(flag("quick", "Two cases, once"), write("docs/inside/compare.md"))
def compare_solvers(work):
    """Compares scipy's LSODA and Radau and CVODE with this program's method on the same equations (many minutes)."""
    work.run("benches/foreign/compare.py", equations, work.folder("cost"), *work.given("quick"), environment=SOLVERS, doing="comparing",
             sections=[("docs/inside/compare.md", "foreign", "")])


@command(flag("quick", "Ideal gears only, in a minute and a half"), write("docs/inside/hosts.md and docs/coupling.md", without=["quick"]))
def drivetrain(work):
    """Couples a drivetrain of FMUs and compares it with one integration of all equations (many minutes)."""
    # libcosim cannot set enumerations
    work.run("examples/drivetrain/run.py", plain, equations, work.folder("drivetrain"), *work.given("quick"), environment=DRIVETRAIN,
             doing="coupling", sections=[("docs/inside/hosts.md", "drivetrain", ""), ("docs/coupling.md", "drivetrain", "summary.md")],
             pictures=True)


@command()
def four_wheel_drive(work):
    """Runs the car with four-wheel drive as an SSP archive and compares it with its script (a minute).

    Fails if they differ by 1 %."""
    work.run("examples/four_wheel_drive/ssp/compare.py", packaged, work.folder("four_wheel_drive"), environment=DRIVETRAIN, doing="coupling")


@command(write("docs/geometry.md and its figures"))
def patterns(work):
    """Shows the contact patterns of docs/geometry.md: aligned teeth, and one deviation at a time."""
    work.run("bevel_differential", "pattern", "--progress", "lines", "--out", work.folder("pattern"), doing="simulating",
             sections=[("docs/geometry.md", "pattern", "findings.md")], pictures=True)


@command(path("against", "FMU", "The FMU of another build: prints the ratios of this build's times to its own"),
         flag("quick", "Three runs of each instead of nine, and no pairs"),
         write("the tables in docs/accuracy.md and the prices that `accuracy` uses", without=["against", "quick"]))
def prices(work):
    """Times levels, laws and effects, or compares the FMUs of two builds (an idle machine, some minutes)."""
    work.run("crates/lab/python/prices.py", *work.given("against"), packaged, work.folder("prices"), *work.given("quick"), doing="timing",
             sections=[("docs/accuracy.md", "prices", ""), ("crates/answers/data/prices.csv", "", "prices.csv")])


@command(path("within", "PATH", "Only this folder or file of the repository"), flag("places", "Also print each place"))
def words(work):
    """Counts wording that readers stumble over: openings of doc comments, compressed phrases, long sentences.

    It is a tool for writers and never fails."""
    work.run("crates/lab/python/words.py", *work.given("within", "places"), doing="reading")
