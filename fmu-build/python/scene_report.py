"""Writes reports of scenes with the packaged FMU.

usage: scene_report.py FMU QUICK SCENE FILE [NAME=VALUE...] [-- SCENE FILE ...]

QUICK is "quick" or "full"; SCENE is the name or file of a scene. A line "progress FRACTION WHAT" on standard error reports progress.
"""

import sys

from bevel_differential import DifferentialError, Scene
from bevel_differential.command.arguments import assignment, once
from bevel_differential.report.write import write


def main():
    fmu, quick, *rest = sys.argv[1:]
    orders = [[]]
    for word in rest:
        if word == "--":
            orders.append([])
        else:
            orders[-1].append(word)
    for place, (name, file, *settings) in enumerate(orders):

        def progress(done, what, place=place, name=name):
            print(f"progress {(place + done) / len(orders):.4f} report of {name}: {what}", file=sys.stderr, flush=True)

        with Scene.load(name, fmu=fmu) as scene:
            write(scene.set(once("--set", map(assignment, settings))), file, quick == "quick", progress)


if __name__ == "__main__":
    try:
        main()
    except DifferentialError as error:
        raise SystemExit(str(error)) from None
