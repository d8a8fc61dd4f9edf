"""Requirements on every ordinary drive: it finishes, its energy balances, held wheels do not move, and it takes few steps.

`judge` plays a drive and returns its measures and violated requirements. Numbers of steps are attempts, accepted plus rejected
ones, because both cost the same."""

from dataclasses import dataclass, field

import numpy as np
import ordinary_drives
from drive_player import BODIES, SIDES, mesh_forces, play

# Energy residual over the throughput of energy plus the stored energy, in tolerances. A step is repeated if its energy error is above
# four tolerances of the energy exchanged in the step; errors of steps have both signs.
ENERGY = 10.0
TOLERANCE = 1e-6
# The method of fixed steps has no error control, so this limit only detects gross errors of its step of 0.1 ms.
ENERGY_OF_FIXED_STEPS = 0.02
# Speed below which the kinetic energy of a body is not reduced further [rad/s]: the solver resolves speeds relative to it.
RESOLVED = 1.0
# Speed of a wheel at standstill [rad/s], and total creep of a held wheel [rad]. At a tyre radius of 0.3 m, these are half a
# millimetre per second and a hundredth of a millimetre. The spring of the brake also yields to the torque of the half-shaft, which
# oscillates with the carrier; its factor is that of a suddenly applied load.
STANDS, CREEP, AT_ONCE = 2e-3, 3e-5, 2.0
# Speed below which a body is at rest [rad/s]: ten times the smallest speed that the solver resolves. Shortest checked time at rest
# [s].
REST, RESTING = 1e-5, 0.2
# Allowed attempts at steps. At rest nothing changes, so a step can be as long as the interval between communication points; 200 per
# second is far below one step per period of any vibration of the model.
PER_SECOND_AT_REST = 200.0
# Factor if a dog clutch may be open: the side gear behind it then floats in the backlash, and each touch of its teeth takes some steps.
FLOATING = 4.0
# In motion, a period of shuffle (5 to 30 Hz) takes some 50 steps. A new input begins with a step of 1 µs, and a decaying vibration of
# the teeth follows. Each passing tooth, of planets or ring gear, has two load transfers. An impact is a half-wave with two kinks; then
# the teeth ring, and the friction of the planets sticks and slips. An imposed speed that jumps also causes impacts of the teeth.
PER_SECOND, PER_POINT, PER_CHANGE, PER_CYCLE, PER_IMPACT = 2000.0, 1.0, 100.0, 60.0, 400.0
# Time in which the teeth stop ringing [s]: impacts of an imposed speed that jumps more often do not add up. Elastic pins, whose default
# damping is 3 % at 5 kHz, ring until the next jump.
RINGING, PER_JUMP_OF_PINS = 0.01, 2000.0
# Processor time [s] per simulated second with communication steps of 1 ms or more, and for the start. The limit does not apply to solid
# teeth, whose facets take longer, and to fixed steps, whose number the user sets.
SECONDS, SECONDS_OF_START, FROM_STEP = 0.5, 0.5, 0.999e-3


@dataclass
class Verdict:
    """Measures of a drive.

    `problems`: violated requirements; `steps`: attempts at steps; `granted`: allowed attempts without impacts. `impacts`: number of times
    that a mesh closes; `swings`: number of maxima of a mesh force, which distinguish vibration from steps without a cause; both are None if
    they do not matter. `residual`: relative energy residual; `seconds`: processor time."""

    problems: list = field(default_factory=list)
    steps: int = 0
    granted: int = 0
    impacts: int | None = None
    swings: int | None = None
    residual: float = 0.0
    seconds: float | None = None

    def demand(self, holds, what):
        if not holds:
            self.problems.append(what)


def judge(fmu, drive, seconds=None, played=None):
    """Plays a drive, unless `played` is given, and returns the verdict. `seconds`: its processor time, if the time is limited."""
    played = played or play(fmu, drive)
    verdict = Verdict(seconds=seconds)
    verdict.steps = int(attempts(played)[-1]) if len(played.time) else 0
    verdict.demand(played.failure is None, f"does not finish: {played.failure}")
    verdict.demand(not played.not_finite, f"outputs are not finite: {', '.join(played.not_finite)}")
    if played.failure is None:
        energy(drive, played, verdict)
        for hold in drive["holds"]:
            standing(drive, played, hold, verdict)
        if method(drive) != "fixed_step":
            steps_at_rest(drive, played, verdict)
            steps(fmu, drive, played, verdict)
        if seconds is not None and has_limited_time(drive):
            limit = SECONDS * drive["stop"] + SECONDS_OF_START
            verdict.demand(seconds <= limit, f"takes {seconds:.1f} s of processor time, granted are {limit:.1f} s")
    return verdict


def has_limited_time(drive):
    return drive["step"] >= FROM_STEP and drive["start"]["scene.gear_contact"] != "solid" and method(drive) != "fixed_step"


def method(drive):
    return drive["start"].get("solver.method", "adaptive")


def attempts(played):
    return played.values["solver.steps"] + played.values["solver.rejected"]


def energy(drive, played, verdict):
    """Compares the residual with heat, work in and out, and the largest kinetic and elastic energy of bodies with given data."""
    values, start = played.values, drive["start"]
    through = float(np.trapezoid(np.abs(values["power.in"]) + np.abs(values["power.out"]), played.time)) + abs(played.heat)
    stored = kinetic(start["inertia.carrier"], values["carrier.speed"])
    stored = stored + kinetic(start.get("inertia.pinion", 0.0), values["pinion.speed"])
    stored = stored + kinetic(start.get("inertia.propeller_end", 0.0), values["propeller.speed"])
    for side in SIDES:
        stored = stored + kinetic(start[f"inertia.{side}_end"], values[f"{side}.wheel_speed"]) + wound(drive, values, side)
    verdict.residual = float(np.max(np.abs(values["solver.energy_residual"]))) / (through + float(np.max(stored)))
    limit = ENERGY_OF_FIXED_STEPS if method(drive) == "fixed_step" else ENERGY * TOLERANCE
    verdict.demand(verdict.residual <= limit, f"energy residual of {verdict.residual:.1e} of what went through, granted are {limit:.0e}")


def kinetic(inertia, speed):
    return 0.5 * inertia * np.maximum(np.abs(speed), RESOLVED) ** 2


def wound(drive, values, side):
    """Elastic energy of a half-shaft, and of the brake spring that holds the load."""
    start = drive["start"]
    load = np.max(np.abs([value for _, value in drive["inputs"][f"{side}.load_torque"]]))
    shaft = start.get(f"half_shaft.{side}_stiffness", 1e4) if "effects.half_shaft" in start else 0.0
    return 0.5 * shaft * values[f"{side}.twist"] ** 2 + 0.5 * load**2 / brake_stiffness(drive)


def brake_stiffness(drive):
    return drive["start"].get("wheel_brake.stiffness", 1e5)


def standing(drive, played, hold, verdict):
    """Demands that wheels whose brakes exceed all acting torques do not move, are held, and do not creep."""
    inside = (played.time >= hold["from"]) & (played.time <= hold["to"])
    if np.count_nonzero(inside) < 2:
        return
    when = f"from {hold['from']:.3g} to {hold['to']:.3g} s"
    held = played.values["held.wheels"][inside]
    verdict.demand(held.min() >= len(hold["wheels"]), f"held.wheels = {held.min():g} {when}, where brakes hold {len(hold['wheels'])}")
    for side in hold["wheels"]:
        speeds, angles, torques = (played.values[f"{side}.{name}"][inside] for name in ("wheel_speed", "wheel_angle", "shaft_torque"))
        yields = AT_ONCE * np.ptp(torques) / brake_stiffness(drive)
        rate = AT_ONCE * np.max(np.abs(np.diff(torques))) / (drive["step"] * brake_stiffness(drive))
        speed, creep = np.max(np.abs(speeds)), abs(angles[-1] - angles[0])
        verdict.demand(speed <= STANDS + rate, f"the {side} wheel moves at {speed:.1e} rad/s {when}, where its brake holds it")
        verdict.demand(creep <= CREEP + yields, f"the {side} wheel creeps by {creep:.1e} rad {when}, where its brake holds it")


def steps_at_rest(drive, played, verdict):
    """Demands few steps while all bodies are at rest under constant inputs."""
    resting = np.all([np.abs(played.values[name]) < REST for name in BODIES], axis=0)
    calm = np.append(~changes(drive), True)[: len(resting)] & resting
    taken = attempts(played)
    edges = np.flatnonzero(np.diff(np.concatenate(([False], calm, [False])).astype(int)))
    for first, last in zip(edges[::2], edges[1::2] - 1):
        duration = played.time[last] - played.time[first]
        floating = FLOATING if "effects.disconnect" in drive["start"] else 1.0
        granted = floating * PER_SECOND_AT_REST * duration + PER_POINT * (last - first)
        done = taken[last] - taken[first]
        verdict.demand(duration < RESTING or done <= granted, f"{done:.0f} steps at rest from {played.time[first]:.3g} to "
                       f"{played.time[last]:.3g} s, granted are {granted:.0f}")


def steps(fmu, drive, played, verdict):
    """Demands few steps over the whole drive. Impacts are counted only if nothing else explains the number of steps."""
    values, start = played.values, drive["start"]
    cycles = np.trapezoid(values["mesh.frequency"], played.time)
    if "effects.final_drive" in start:
        # only the errors of an elastic mesh excite it; each harmonic adds its cycles
        orders = sum(n for n in (1, 2, 3) if start.get(f"final_drive.error_{n}", 0.0) > 0.0)
        cycles += orders * start["final_drive.ring_teeth"] * np.trapezoid(np.abs(values["carrier.speed"]), played.time) / (2.0 * np.pi)
    per_change = PER_CHANGE
    if start["scene.carrier_drive"] == "speed" and not drive["slopes"]:
        blow = PER_JUMP_OF_PINS if "effects.pin_compliance" in start else PER_IMPACT
        per_change = max(blow * min(drive["step"] / RINGING, 1.0), PER_CHANGE)
    verdict.granted = int(PER_SECOND * drive["stop"] + PER_POINT * len(played.time) + per_change * np.count_nonzero(changes(drive))
                          + PER_CYCLE * cycles)
    if verdict.steps > verdict.granted:
        forces = mesh_forces(fmu, drive)
        verdict.impacts = int(np.count_nonzero((forces[:-1] == 0.0) & (forces[1:] != 0.0)))
        rising = np.diff(forces, axis=0) > 0.0
        verdict.swings = int(np.count_nonzero(rising[:-1] & ~rising[1:]))
        granted = verdict.granted + int(PER_IMPACT * verdict.impacts)
        verdict.demand(verdict.steps <= granted, f"{verdict.steps} steps in {drive['stop']:.3g} s with {verdict.impacts} impacts and "
                       f"{verdict.swings} swings of mesh forces, granted are {granted}")


def changes(drive):
    """Mask of the communication steps at whose start an input changes, or in which it changes by its derivative."""
    rows = np.column_stack(list(ordinary_drives.sampled(drive).values()))
    moved = np.any(np.diff(rows, axis=0) != 0.0, axis=1)
    return moved if drive["slopes"] else np.concatenate(([False], moved[:-1]))
