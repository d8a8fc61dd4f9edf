"""Instruction counts of benches/steps.rs, a program that only executes communication steps, by callgrind.

Two builds of the same arithmetic differ in the order of their blocks and in the use of registers. Counts of all instructions therefore
differ by about 1 %. Counts of work do not differ: arithmetic, comparisons, branches and calls."""

import json
import os
import shutil
from collections import Counter
from pathlib import Path

from tools import WORKSPACE, completed

# communication steps of the two runs whose difference is counted, so that the start cancels
COUNTED = (100, 300)
# kinds of instructions: conditional jumps, calls and returns; arithmetic and comparisons of floating-point numbers; moves and copies of
# memory, unconditional jumps, padding, and integer arithmetic, most of it for addresses
BRANCH, FLOAT, ARRANGED = "branches and calls", "floating-point operations", "arranged"
MOVES = ("mov", "xor", "broadcast", "unpck", "perm", "insert", "extract", "shuf", "blend")
# prevents wider vectors, because old versions of valgrind do not know all of their instructions
NARROW = {"BEVEL_DIFFERENTIAL_VECTORS": "narrow"}


def stepping(folder, effects, name):
    """Builds the stepping program, with or without effects, and returns the path of a copy named `name`."""
    # settings of the FMU's library, independent of other builds, with function names for callgrind
    settings = {"CARGO_PROFILE_BENCH_CODEGEN_UNITS": "1", "CARGO_PROFILE_RELEASE_CODEGEN_UNITS": "1",
                "CARGO_PROFILE_BENCH_STRIP": "debuginfo"}
    printed = completed([os.environ.get("CARGO", "cargo"), "build", "--package", "bevel-differential", "--bench", "steps", "--profile", "bench",
                         "--quiet", *([] if effects else ["--no-default-features", "--features", "full"]), "--message-format", "json",
                         "--target-dir", folder], env=os.environ | settings, cwd=WORKSPACE).stdout
    built = [message["executable"] for message in map(json.loads, printed.splitlines())
             if message.get("executable") and message["target"]["name"] == "steps"]
    if not built:
        raise SystemExit("cargo named no executable")
    # the next build replaces this one; copies need names of equal length, because names move the stack and thereby change the cost of
    # filling memory
    return Path(shutil.copy(built[0], Path(folder, name)))


def callgrind(program, arguments, options=(), out="/dev/null"):
    """Runs a program under callgrind and returns callgrind's report."""
    command = ["valgrind", "--tool=callgrind", f"--callgrind-out-file={out}", *options, program, *arguments]
    return completed(command, "valgrind counts the instructions: install it (apt-get install valgrind)", env=os.environ | NARROW).stderr


def counts(folder, first=2):
    """Instruction counts of the steps from number `first` on. Callgrind writes a file after each step, `count.1`, `count.2`, …, and `count`
    at the end of the program. Unless counting begins at a step, the first file also contains the start of the program."""
    found = []
    for file in folder.iterdir():
        if file.suffix[1:].isdigit() and int(file.suffix[1:]) >= first:
            summary = [line for line in file.read_text(encoding="utf-8").splitlines() if line.startswith("summary:")]
            if not summary:
                raise SystemExit(f"{file} has no count")
            found.append(int(summary[0].split()[1]))
    if len(found) < 2:
        raise SystemExit("callgrind found no separate steps: does the stepping program have its symbols?")
    return found


def per_step(count, arguments):
    """Applies `count(arguments)` to a scene with options, and returns its result per communication step."""
    scene, *options = arguments
    few, many = (count([scene, str(steps), "unread", *options]) for steps in COUNTED)
    return {kind: (many[kind] - few.get(kind, 0)) / (COUNTED[1] - COUNTED[0]) for kind in many}


def instructions(program, *arguments):
    """Number of instructions per communication step in a scene with options."""
    def count(words):
        report = callgrind(program, words)
        found = [line.partition("Collected :")[2] for line in report.splitlines() if "Collected :" in line]
        if not found:
            raise SystemExit("valgrind reported no count")
        return {"all": float(found[0])}

    return per_step(count, arguments)["all"]


def executed(program, *arguments):
    """Numbers of instructions by kind, {kind: number}, per communication step in a scene with options."""
    named = mnemonics(program)

    def count(words):
        out = program.with_name("executed.callgrind")
        callgrind(program, words, ["--dump-instr=yes", "--compress-pos=no", "--compress-strings=no"], out)
        found = of_profile(out.read_text(encoding="utf-8"), str(program), named)
        out.unlink()
        if not found[FLOAT]:
            raise SystemExit(f"{words}: callgrind named no instruction of the program itself")
        return found

    return per_step(count, arguments)


def of_profile(profile, program, named):
    """Parses a profile of callgrind, see its manual, "Callgrind Format Specification"."""
    counts, inside, is_of_call = Counter(), False, False
    for line in profile.splitlines():
        if line.startswith("ob="):
            inside = line[3:] == program
        elif line.startswith("calls="):
            # the next line contains the count of the called function, which is counted there
            is_of_call = True
        elif line.startswith("0x"):
            if not is_of_call:
                address, _, count = line.split()[:3]
                # other libraries copy memory, whose cost depends on its address
                counts[kind_of(named.get(int(address, 16), "")) if inside else ARRANGED] += int(count)
            is_of_call = False
    return counts


def kind_of(mnemonic):
    """Kind of an instruction of the program itself."""
    # v is the prefix of instructions on wide registers
    plain = mnemonic.removeprefix("v")
    if plain.startswith(("call", "ret")) or (plain.startswith("j") and plain != "jmp"):
        return BRANCH
    return FLOAT if plain.endswith(("sd", "pd", "ss", "ps")) and not plain.startswith(MOVES) else ARRANGED


def mnemonics(program):
    """Name of the instruction at each address of a program."""
    listing = completed(["objdump", "--disassemble", "--no-show-raw-insn", program],
                        "objdump names the instructions: install it (apt-get install binutils)").stdout
    return dict(filter(None, map(disassembled, listing.splitlines())))


def disassembled(line):
    """Address and name in a line such as `4a10: vaddsd %xmm0,%xmm1,%xmm2`; None for other lines."""
    address, _, rest = line.partition(":")
    try:
        return int(address, 16), rest.split()[0]
    except (ValueError, IndexError):
        return None
