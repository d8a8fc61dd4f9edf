"""Runs this program, MuJoCo and Drake on the study's two cases and writes the table that compares them.

usage: run.py FMU FOLDER [--quick]

FOLDER receives table.md, results.csv, results.json and peers.png. Each run is a separate process. Repetitions alternate
between all rows, so that a slow period of the machine affects every tool. Costs are medians. A tool that is not installed
is left out. Lines "progress FRACTION WHAT" on standard error report progress; the table is written to standard output.
`python3 crates/lab/lab.py compare-simulators` creates the environment and runs all of it.
"""

import contextlib
import importlib.metadata
import importlib.util
import json
import os
import platform
import statistics
import subprocess
import sys
from pathlib import Path

import cases
import picture
import plan
import table

HERE = Path(__file__).resolve().parent
sys.path.append(str(HERE.parents[1] / "crates" / "lab" / "python"))
from tools import machine as computer  # noqa: E402

# names of the tools by the required package
TOOLS = {"mujoco": "MuJoCo", "pydrake": "Drake"}
# a run that takes longer counts as hanging [s]
LIMIT = 300.0


def main():
    arguments = [argument for argument in sys.argv[1:] if argument != "--quick"]
    if len(arguments) != 2:
        raise SystemExit("usage: run.py FMU FOLDER [--quick]")
    quick, fmu, folder = "--quick" in sys.argv, Path(arguments[0]).resolve(), Path(arguments[1])
    if not fmu.is_file():
        raise SystemExit(f"{fmu} is not there; build it: cargo run --release -- package")
    folder.mkdir(parents=True, exist_ok=True)
    missing = [name for package, name in TOOLS.items() if importlib.util.find_spec(package) is None]
    for name in missing:
        print(f"{name} is not installed: its rows are left out (pip install -r benches/peers/requirements.txt)",
              file=sys.stderr)
    rows = [row for row in plan.ROWS if (row.quick or not quick) and TOOLS.get(row.needs) not in missing]
    results = measured(rows, fmu, 1 if quick else max(row.repeats for row in rows))
    text = table.markdown(results, machine(), missing)
    (folder / "table.md").write_text(text, encoding="utf-8")
    table.write_csv(folder / "results.csv", results)
    picture.draw(folder / "peers.png", [result for result in results if table.keeps_teeth(result)])
    plain = [result | {"row": vars(result["row"])} for result in results]
    (folder / "results.json").write_text(json.dumps({"machine": machine(), "results": plain}, indent=1) + "\n")
    print(text, end="")


def measured(rows, fmu, rounds):
    """All rows with their cases: values of the first run, and the costs of all runs."""
    runs = [(row, case) for count in range(rounds) for row in rows if count < row.repeats for case in cases.CASES]
    results = {(row.group, row.label): {"row": row, "cases": {}} for row in rows}
    for done, (row, case) in enumerate(runs):
        print(f"progress {done / len(runs):.4f} {row.group}, {row.label}, {case}", file=sys.stderr, flush=True)
        found = one_run(row, case, fmu)
        kept = results[row.group, row.label]["cases"].setdefault(case, found | {"costs": []})
        kept["costs"].append(found["cost"])
        kept["cost"] = statistics.median(kept["costs"])
    return list(results.values())


def one_run(row, case, fmu):
    settings = row.settings | {"case": case, "fmu": str(fmu)}
    # one thread each: costs are CPU time, and the tools themselves work serially
    threads = {name: "1" for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")}
    try:
        ended = subprocess.run([sys.executable, str(HERE / row.script), json.dumps(settings)], capture_output=True,
                               text=True, timeout=LIMIT, env=os.environ | threads)
    except subprocess.TimeoutExpired:
        raise SystemExit(f"{row.group}, {row.label}, {case}: no end after {LIMIT:.0f} s") from None
    if ended.returncode != 0:
        raise SystemExit(f"{row.group}, {row.label}, {case} fails:\n{ended.stderr.strip()}")
    # a tool may have printed something before
    return json.loads(ended.stdout.strip().splitlines()[-1])


def machine():
    """Processor, cores and versions."""
    versions = [f"Python {platform.python_version()}"]
    for package, name in [("mujoco", "MuJoCo"), ("drake", "Drake"), ("FMPy", "FMPy")]:
        with contextlib.suppress(importlib.metadata.PackageNotFoundError):
            versions.append(f"{name} {importlib.metadata.version(package)}")
    return f"{computer()}; {', '.join(versions)}"


if __name__ == "__main__":
    main()
