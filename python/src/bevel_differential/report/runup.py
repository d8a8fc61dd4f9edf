"""Run-up of the scene's gears: speeds rise in a constant ratio, under constant loads.

The scene's drives are kept, because they decide on the mesh orders: planets at imposed spin move together, so that with planets of
alternating phase the odd orders cancel. Two speeds must be imposed for a constant ratio. If the scene imposes fewer, the speed of
the carrier is added, and then that of the left wheel."""

from dataclasses import dataclass

import numpy as np

from ..answers import Progress
from ..drive_port import port_command, port_value
from ..progress import silent
from ..scene import Scene
from ..values import DifferentialError, Number
from ..want import mean_over_time
from . import dogs, words
from .simulated import Simulated

# lowest and highest carrier speed, rad/s: 100 and 1000 rpm
SLOWEST, FASTEST = 100.0 * np.pi / 30.0, 1000.0 * np.pi / 30.0
# spin of the planets over carrier speed if the scene has no steady ratio: a passenger car in a tight bend
USUAL_RATIO = 0.2
# planets roll if their spin is above this fraction of the carrier's speed
ROLLING = 0.02
# torque on each half-shaft if the scene has next to none, N·m, and limit below which a torque counts as next to none, N·m
USUAL_LOAD, LEAST_LOAD = 200.0, 5.0
# turns of a planet in the run-up, and fewer if they would take more evaluations of the tooth forces than `MOST`
TURNS, FEWER, MOST = 80.0, 24.0, 4e6
# time at the lowest speed until the start has died out, s; time over which the rise of the speeds then begins without a shock, s
SETTLING, BEGINNING = 3.0, 1.0
# points per turn of a planet at the highest speed, and smallest number of points per period of the highest order of theory
PER_TURN, PER_ORDER = 256, 6.0
# if a scene has none of this damping, nothing dies out
DAMPING = ("contact.damping", "half_shaft.left_damping", "half_shaft.right_damping")
# number of multiples of the mesh order, and prefixes of the names of the other orders
MULTIPLES, RING, PINION, RUNOUT, JOINT = 6, "ring gear", "pinion", "runout", "joint"
SIGNAL = "planet[1].left_transmission_error"
ANGLE = "planet[1].spin_angle"
SHAFTS = ("left.shaft_torque", "right.shaft_torque")
RECORDED = (ANGLE, "carrier.angle", "carrier.speed", SIGNAL, *SHAFTS)
SPIN = "the planets' spin"
# possible speed drives; with a final drive, that of the carrier acts on its port: variable and literal that select the drive, and its command
DRIVES = {"the carrier's speed": ("scene.carrier_drive", "speed", "carrier.speed_command"),
          "the left wheel's speed": ("scene.left_drive", "speed", "left.speed_command"),
          "the right wheel's speed": ("scene.right_drive", "speed", "right.speed_command"),
          SPIN: ("scene.planet_spin", "imposed", "spin.command")}
# number of independent speeds of a differential
INDEPENDENT = 2


@dataclass(frozen=True)
class RunUp:
    """Record of a run-up. `ratio`: spin over carrier speed; `imposed`: names of the imposed speeds in DRIVES; `loads`: mean torques of
    the half-shafts; `changed`: sentences about differences from the scene; `turns`: turns of a planet; `seconds`: duration, s;
    `is_driven_otherwise`: true if the scene imposes fewer speeds."""

    record: np.ndarray
    ratio: float
    imposed: list[str]
    loads: tuple[float, float]
    changed: list[str]
    turns: float
    seconds: float
    is_driven_otherwise: bool

    @property
    def spins_freely(self) -> bool:
        """True if the spin of the planets is not imposed."""
        return SPIN not in self.imposed


def run_up(run: Simulated, progress: Progress = silent) -> RunUp:
    """Simulates the run-up. Raises `DifferentialError` with the FMU's reason if it refuses."""
    ratio, why_ratio = ratio_of(run)
    loads, why_loads = loads_of(run)
    imposed, why_imposed = imposed_of(run)
    commands = commands_of(run, ratio, imposed)
    values, changed = _values(run, commands, imposed, loads)
    changed = [*why_imposed, *why_ratio, *why_loads, *changed]
    # enough points for the orders that theory expects
    per_turn = max(PER_TURN, int(PER_ORDER * max(theory(run, ratio).values())))
    step = 2.0 * np.pi / (abs(ratio) * FASTEST * per_turn)
    wheels = _of_wheels(run, ratio, imposed)
    for turns in (TURNS, FEWER):
        # all speeds rise at a constant rate, so the turns are mean spin times duration
        seconds = turns * 2.0 * np.pi / (abs(ratio) * 0.5 * (SLOWEST + FASTEST)) + 0.5 * BEGINNING
        record = _simulate(run.scene, values, commands, wheels, seconds, step, MOST if turns > FEWER else np.inf, progress)
        if record is not None:
            break
    left, right = (mean_over_time(record[name], record["time"]) for name in SHAFTS)
    return RunUp(record, ratio, imposed, (left, right), changed, turns, seconds, bool(why_imposed))


def imposed_of(run: Simulated) -> tuple[list[str], list[str]]:
    """Names of the speeds in DRIVES that the run-up imposes, and a sentence about added ones. They are those of the scene, and others
    until the ratio is fixed."""
    imposed = [name for name, (drive, literal, _) in DRIVES.items() if run.literal(drive) == literal]
    added = [name for name in DRIVES if name not in imposed][:INDEPENDENT - len(imposed)]
    if not added:
        return imposed, []
    sides = [side for side in ("left", "right") if DRIVES[added[-1]][0] == f"scene.{side}_drive"]
    stiffness = [words.quantity(float(run.value(f"half_shaft.{side}_stiffness")), "N·m/rad") for side in sides]
    through = f" through its half-shaft of {stiffness[0]}" if sides else ""
    return [*imposed, *added], [f"{words.listed(added)} {'is' if len(added) == 1 else 'are'} imposed{through}, because torques would not "
                                "hold the ratio of the speeds"]


def commands_of(run: Simulated, ratio: float, imposed: list[str]) -> dict[str, float]:
    """Commands of the imposed speeds over the speed of the carrier."""
    speeds = _speeds(run, ratio)
    commands = {DRIVES[name][2]: speeds[name] for name in imposed}
    return {port_command(run.value, name): port_value(run.value, name, value) for name, value in commands.items()}


def _speeds(run: Simulated, ratio: float) -> dict[str, float]:
    """Speeds of DRIVES over the speed of the carrier, by Willis' equation."""
    difference = ratio * float(run.value("geometry.planet_teeth")) / float(run.value("geometry.side_teeth"))
    return dict(zip(DRIVES, (1.0, 1.0 + difference, 1.0 - difference, ratio)))


def _of_wheels(run: Simulated, ratio: float, imposed: list[str]) -> dict[str, float]:
    """Torque that accelerates each wheel driven by torque over the acceleration of the carrier, by the name of its load, kg·m²."""
    speeds = _speeds(run, ratio)
    return {f"{side}.load_torque": speeds[name] * float(run.value(f"inertia.{side}_end"))
            for side in ("left", "right") if (name := f"the {side} wheel's speed") not in imposed}


def ratio_of(run: Simulated) -> tuple[float, list[str]]:
    """Spin over carrier speed if the scene's planets roll steadily. Otherwise returns the usual ratio, and a sentence about it."""
    spin, carrier = run.series("planet[1].spin_speed"), run.series("carrier.speed")
    rolls = np.abs(spin) > ROLLING * np.max(np.abs(carrier), initial=1e-9)
    one_way = np.all(carrier > 0.0) or np.all(carrier < 0.0)
    rolling, spins, speeds, sizes = (mean_over_time(rolls * values, run.time) for values in (1.0, spin, carrier, np.abs(spin)))
    if one_way and rolling > 0.1 and abs(spins) > 0.9 * sizes:
        return spins / speeds, []
    reason = "the carrier turns to and fro" if not one_way else "the planets of the scene do not roll steadily"
    return USUAL_RATIO, [f"the planets spin at {USUAL_RATIO:g} of the carrier's speed, as {reason}"]


def loads_of(run: Simulated) -> tuple[tuple[float, float], list[str]]:
    """Mean torques of the half-shafts in the scene, or else usual loads and a sentence about them."""
    means = [run.mean(f"{side}.shaft_torque") for side in ("left", "right")]
    if min(abs(mean) for mean in means) >= LEAST_LOAD and means[0] * means[1] > 0.0:
        return (means[0], means[1]), []
    return (USUAL_LOAD, USUAL_LOAD), [f"each half-shaft carries {USUAL_LOAD:g} N·m, as in the scene at least one of them has "
                                      "next to no load on the mean and its teeth would lift"]


def _values(run, commands, imposed, loads):
    """Values that differ from the scene's, and sentences about differences that a reader would not expect."""
    # the start uses the speed of a carrier that is driven by torque; gearings of clutches give a part of the torque to the housing
    drive = {"carrier.torque_command": sum(loads) + run.mean("clutches.housing_torque"), "carrier.speed_command": SLOWEST}
    values: dict[str, Number | str] = {
        "scene.start": "rolling", "left.load_torque": loads[0], "right.load_torque": loads[1],
        **{port_command(run.value, name): port_value(run.value, name, value) for name, value in drive.items()},
        **{name: part * SLOWEST for name, part in commands.items()}}
    for name in imposed:
        drive, literal, _ = DRIVES[name]
        values[drive] = literal
    changed = []
    undamped = [name for name in (*DAMPING, *_damping_of_drive(run)) if run.value(name) == 0.0]
    if undamped:
        values.update({name: run.scene.fmu.variable(name).start for name in undamped})
        changed.append(f"{' and '.join(undamped)} {'has its' if len(undamped) == 1 else 'have their'} start value"
                       f"{'' if len(undamped) == 1 else 's'}, as without damping the start would ring through all speeds")
    if max(abs(run.series("lock.command"))) > 0.0:
        values["lock.command"] = 0.0
        changed.append("the lock is open")
    for side in ("left", "right"):
        if max(abs(run.series(f"{side}.brake_torque"))) > 0.0:
            values[f"{side}.brake_torque"] = 0.0
            changed.append(f"the {side} brake is released")
        if min(run.series(f"{side}.dog_phase")) < dogs.CLOSED:
            values[f"{side}.dog_command"] = 1.0
            changed.append(f"the {side} dog clutch is closed")
        command = run.series(f"{side}.clutch_command")
        if np.ptp(command) > 0.0:
            values[f"{side}.clutch_command"] = run.mean(f"{side}.clutch_command")
            changed.append(f"the command of the {side} clutch is constant at its mean of {words.number(values[f'{side}.clutch_command'])}")
    return values, changed


def theory(run: Simulated, ratio: float) -> dict[str, float]:
    """Orders per turn of a planet that theory predicts, by name."""
    teeth = int(run.value("geometry.planet_teeth"))
    found = {f"mesh {k} × {teeth}": float(k * teeth) for k in range(1, MULTIPLES + 1)}
    return found | {f"{name} {words.number(order)} per carrier turn": order / abs(ratio) for name, order in _of_drive(run).items()}


def _of_drive(run):
    """Orders per turn of the carrier that the final drive and its propeller shaft excite. A joint excites twice per turn."""
    ring, pinion = (float(run.value(f"final_drive.{name}_teeth")) for name in ("ring", "pinion"))
    found = {}
    if has_errors(run):
        found[RING] = ring
        if run.value("final_drive.pinion_runout") > 0.0:
            found[PINION] = ring / pinion
        if run.value("final_drive.ring_runout") > 0.0:
            found[RUNOUT] = 1.0
    if run.value("effects.propeller_shaft") and run.value("propeller_shaft.joint_angle") > 0.0:
        found[JOINT] = 2.0 * ring / pinion
    return found


def _damping_of_drive(run):
    mesh = ["final_drive.damping"] if has_errors(run) else []
    return [*mesh, "propeller_shaft.damping"] if run.value("effects.propeller_shaft") else mesh


def has_errors(run: Simulated) -> bool:
    """True if the mesh of the final drive excites the carrier: a rigid mesh has no transmission error."""
    return bool(run.value("effects.final_drive") and run.value("final_drive.elastic_mesh"))


def _simulate(scene: Scene, values, commands, wheels, seconds, step, most, progress):
    """Simulates with inputs that change linearly, which the FMU follows between communication points. `wheels`: by load, the torque that
    accelerates its wheel over the carrier's acceleration; the load is that much smaller. Returns None if the first tenth predicts more
    than `most` evaluations."""
    points = int(np.ceil(seconds / step))
    rate = (FASTEST - SLOWEST) / (seconds - 0.5 * BEGINNING)
    record = np.empty(points + 1, [("time", float), *((name, float) for name in RECORDED)])
    with scene.fmu.open() as instance:
        instance.initialise({**scene.values, **values})
        instance.step(SETTLING)
        record[0] = (instance.time, *instance.read(RECORDED))
        for point in range(1, points + 1):
            if (point - 1) * step <= BEGINNING + step:
                slope = rate * 0.5 * (1.0 - np.cos(np.pi * min((point - 0.5) * step / BEGINNING, 1.0)))
                instance.set_slopes({name: part * slope for name, part in commands.items()})
                instance.set({name: values[name] - inertia * slope for name, inertia in wheels.items()})
            instance.step(step)
            record[point] = (instance.time, *instance.read(RECORDED))
            if point % 1000 == 0:
                progress(point / points, "the run-up")
            if point == points // 10 and 10.0 * instance.get("solver.rhs_calls") > most:
                return None
    if not np.all(np.diff(np.abs(record[ANGLE])) > 0.0):
        raise DifferentialError("the planets do not roll one way in the run-up", kind="failed")
    return record
