"""Courses of ordinary drives: inputs over time, written phase by phase, and the holds that each course requires.

A course estimates the speeds of both wheels from its inputs. The estimate determines how long a stop lasts, and it is the
command of a speed-driven carrier. It assumes rigid wheels on ideal gears without friction: with the inertia J of a wheel, J_c of
the carrier, the torque T_c on the carrier, and load T_s and brake B_s of a wheel

    (J + J_c/4) ω̇_s + J_c/4 ω̇_other = T_c/2 − T_s − B_s sgn ω_s.
"""

# step of the estimate relative to the pace of the course [s]
ESTIMATED = 0.01
# maximum number of steps of the estimate in a phase, because parking needs few
PHASE = 300
# longest stop for which the estimate waits, relative to the pace [s], and fraction by which real wheels may take longer
LONGEST_STOP, LATER = 20.0, 0.3
# Brake torque of a hold over the sum of all acting torques. With a locked differential, all of them may act on one wheel.
FIRM = 1.5
# time after which a held wheel must be at rest [s], because oscillations of carrier and half-shafts have faded
SETTLING = 1.0
SIDES = ("left", "right")
DRIVE, LOCK, SPEED = "carrier.torque_command", "lock.command", "carrier.speed_command"
NAMES = {"drive": [DRIVE], "lock": [LOCK], "load": [f"{side}.load_torque" for side in SIDES],
         "brake": [f"{side}.brake_torque" for side in SIDES],
         **{f"{side}_{what}": [f"{side}.{what}_torque"] for side in SIDES for what in ("load", "brake")}}


class Course:
    """Inputs over time: lines between points, with two points at the same time where an input jumps.

    `pace` multiplies all durations: a short course has the same phases in a tenth of the time."""

    def __init__(self, random, vehicle, pace=1.0):
        self.random, self.vehicle, self.pace = random, vehicle, pace
        self.time, self.speeds, self.begin = 0.0, [0.0, 0.0], 0.0
        self.now = {name: 0.0 for names in NAMES.values() for name in names}
        self.points = {name: [] for name in self.now}
        self.track, self.holds = [[0.0, 0.0]], []
        inertia = vehicle.wheel + 0.5 * vehicle.carrier
        self.pull, self.slope = 2.0 * inertia * vehicle.pull, vehicle.wheel * vehicle.slope
        self.grip = vehicle.wheel * vehicle.grip

    def drawn(self, low, high):
        return float(self.random.uniform(low, high))

    def starts(self, **inputs):
        """Sets inputs, by their short names, at the start of the course."""
        for short, value in inputs.items():
            for name in NAMES[short]:
                self.now[name], self.points[name] = value, [[0.0, value]]

    def rolls(self, speed):
        """Lets the course start at a speed of both wheels [rad/s]."""
        self.begin = speed * self.pace
        self.speeds, self.track = [self.begin] * 2, [[0.0, self.begin]]

    def go(self, seconds, over=0.0, **inputs):
        """Phase in which inputs, by their short names, change within `over` and then remain constant."""
        over, seconds = over * self.pace, max(over, seconds) * self.pace
        for short, value in inputs.items():
            for name in NAMES[short]:
                if value != self.now[name]:
                    self.points[name] += [[self.time, self.now[name]], [self.time + over, value]]
        changed = {name: value for short, value in inputs.items() for name in NAMES[short]}
        first, count = dict(self.now), min(max(round(seconds / (ESTIMATED * self.pace)), 1), PHASE)
        for k in range(1, count + 1):
            reached = min(seconds * (k - 0.5) / count / over, 1.0) if over else 1.0
            self.now |= {name: first[name] + reached * (value - first[name]) for name, value in changed.items()}
            self._estimate(seconds / count)
            self.track.append([self.time + seconds * k / count, 0.5 * sum(self.speeds)])
        self.now |= changed
        self.time += seconds

    def _estimate(self, step):
        """Advances the estimated speeds under the present inputs."""
        whole, shared = self.vehicle.wheel + 0.25 * self.vehicle.carrier, 0.25 * self.vehicle.carrier
        pushed = [0.5 * self.now[DRIVE] - self.now[f"{side}.load_torque"] for side in SIDES]
        brakes = [self.now[f"{side}.brake_torque"] for side in SIDES]
        moves = [speed != 0.0 or abs(push) > brake for speed, push, brake in zip(self.speeds, pushed, brakes)]
        torques = [push - (brake if (speed or push) > 0.0 else -brake) for speed, push, brake in zip(self.speeds, pushed, brakes)]
        for s in (0, 1):
            if not moves[s]:
                continue
            both = (whole * torques[s] - shared * torques[1 - s]) / (whole**2 - shared**2)
            after = self.speeds[s] + step * (both if moves[1 - s] else torques[s] / whole)
            # a braked wheel does not turn back within the step
            self.speeds[s] = 0.0 if brakes[s] and after * self.speeds[s] < 0.0 else after

    def until_still(self):
        """Keeps the inputs until both wheels are at rest, and somewhat longer."""
        begin = self.time
        while any(self.speeds) and self.time - begin < LONGEST_STOP * self.pace:
            self.go(5 * ESTIMATED)
        self.go(LATER * (self.time - begin) / self.pace + 0.1)

    def firm(self, drive=None):
        """Brake torque that certainly holds a wheel under the present loads and the given or present drive torque."""
        acting = [self.now[DRIVE] if drive is None else drive, *(self.now[f"{side}.load_torque"] for side in SIDES)]
        return FIRM * sum(map(abs, acting)) + self.vehicle.bias + 0.1 * self.vehicle.wheel

    def hold(self, seconds, sides=SIDES):
        """Holds wheels by their brakes, and requires that they are at rest after `SETTLING`."""
        firm = self.firm()
        brakes = {f"{side}_brake": max(firm, self.now[f"{side}.brake_torque"]) for side in sides}
        self.go(max(seconds, 0.1), over=0.05, **brakes)
        begin = self.time - max(seconds, 0.1) * self.pace + 0.05 * self.pace + SETTLING
        if self.time > begin:
            self.holds.append({"from": begin, "to": self.time, "wheels": list(sides)})


def launch(c):
    """Launch from rest to cruising."""
    c.go(0.2)
    c.go(c.drawn(1.0, 2.0), over=c.drawn(0.05, 0.5), drive=c.pull)
    resistance = c.drawn(0.05, 0.3) * c.pull
    c.go(c.drawn(1.0, 2.0), over=0.2, drive=resistance, load=0.5 * resistance)


def reversal(c):
    """Drive, coast, overrun, and drive again: the torque crosses the backlash several times."""
    c.rolls(c.drawn(10.0, 60.0))
    for share in (c.drawn(0.2, 1.0), 0.0, -c.drawn(0.1, 0.6), c.drawn(0.2, 1.0), -c.drawn(0.1, 0.6)):
        c.go(c.drawn(0.3, 0.8), over=c.drawn(0.02, 0.2), drive=share * c.pull)


def stop(c, uneven=1.0):
    """Braking to a stop, from a speed or after a launch, and waiting at rest."""
    if c.drawn(0.0, 1.0) < 0.5:
        c.rolls(c.drawn(3.0, 30.0))
        c.go(0.2, drive=0.1 * c.pull)
    else:
        c.go(c.drawn(0.5, 1.5), over=0.1, drive=c.pull)
    c.go(c.drawn(0.1, 0.4), over=0.05, drive=0.0)
    hard = c.drawn(0.3, 1.0) * c.grip
    c.go(0.3, over=c.drawn(0.02, 0.3), left_brake=hard, right_brake=uneven * hard)
    c.until_still()
    c.hold(c.drawn(1.5, 3.0))


def uneven_stop(c):
    """Braking to a stop with different brake torques: the wheels stop one after the other."""
    stop(c, c.drawn(0.4, 0.9))


def hill(c):
    """Hill hold: holding on a slope by the brakes, starting up or down the slope, and stopping on it again."""
    c.starts(load=c.slope, brake=c.grip + 3.0 * abs(c.slope))
    c.hold(c.drawn(1.5, 2.5))
    drive = 2.0 * c.slope + c.drawn(0.3, 1.0) * c.pull
    c.go(0.5, over=0.3, drive=drive)
    c.go(c.drawn(0.5, 1.0), over=0.1, brake=0.0)
    c.go(c.drawn(0.2, 0.5), over=0.1, drive=2.0 * c.slope)
    c.go(0.3, over=0.1, brake=c.grip + abs(c.slope))
    c.until_still()
    c.go(0.2, over=0.1, brake=c.firm())
    c.go(0.3, over=0.2, drive=0.0)
    c.hold(c.drawn(1.5, 3.0))


def reverse(c):
    """Launch in reverse, stop, and a launch ahead."""
    c.go(c.drawn(0.5, 1.5), over=0.1, drive=-c.drawn(0.3, 0.8) * c.pull)
    c.go(0.2, over=0.05, drive=0.0)
    c.go(0.2, over=0.1, brake=c.drawn(0.3, 1.0) * c.grip)
    c.until_still()
    c.hold(1.5)
    c.go(0.1, over=0.05, brake=0.0)
    c.go(c.drawn(0.5, 1.0), over=0.2, drive=c.pull)


def stop_and_go(c):
    """Stop and go: short launches, each with a stop."""
    for _ in range(2 + int(c.drawn(0.0, 2.0))):
        c.go(c.drawn(0.3, 0.8), over=0.1, brake=0.0, drive=c.drawn(0.3, 1.0) * c.pull)
        c.go(0.1, over=0.1, drive=0.0)
        c.go(0.1, over=c.drawn(0.02, 0.2), brake=c.drawn(0.5, 1.0) * c.grip)
        c.until_still()
        c.hold(c.drawn(0.5, 1.5))


def park(c):
    """Parking on a slope, or on level ground: loads change now and then, as people get out."""
    c.starts(load=c.drawn(0.0, 1.0) * c.slope, brake=c.grip + 3.0 * abs(c.slope))
    c.hold(c.drawn(1.5, 3.0))
    for _ in range(int(c.drawn(0.0, 3.0))):
        c.go(1.0, over=0.5, load=c.drawn(0.0, 1.0) * c.slope)
        c.hold(c.drawn(2.0, 20.0))
    c.hold(c.drawn(20.0, 60.0))


def park_for_an_hour(c):
    """Parking for an hour."""
    c.starts(load=c.slope, brake=c.grip + 3.0 * abs(c.slope))
    c.hold(3600.0)


def blocked(c):
    """One wheel is blocked by its brake, the other one is driven and then braked."""
    side, other = SIDES if c.drawn(0.0, 1.0) < 0.5 else SIDES[::-1]
    drive = c.drawn(0.1, 0.5) * c.pull
    c.starts(**{f"{side}_brake": c.firm(drive) + FIRM * abs(drive)})
    c.go(0.5, over=0.3, drive=drive)
    c.go(0.3, over=0.2, **{f"{other}_load": c.drawn(0.3, 0.5) * drive})
    c.hold(c.drawn(1.5, 2.5), [side])
    c.go(0.3, over=0.1, drive=0.0, **{f"{other}_load": 0.0, f"{other}_brake": 0.5 * c.grip})
    c.until_still()
    c.hold(1.5)


def creep(c):
    """Idling with creep torque against the brakes, creeping as they are released, and stopping again."""
    torque = c.drawn(0.05, 0.3) * c.pull
    c.starts(brake=c.firm(torque))
    c.go(0.4, over=0.2, drive=torque)
    c.hold(c.drawn(1.5, 3.0))
    c.go(c.drawn(1.0, 2.0), over=c.drawn(0.5, 1.0), brake=0.0)
    c.go(1.0, over=0.5, brake=torque + 0.3 * c.grip)
    c.until_still()
    c.hold(2.0)


def turn(c):
    """Turns to both sides under drive: loads differ, and the side gears roll on the planets."""
    c.rolls(c.drawn(10.0, 50.0))
    resistance = c.drawn(0.1, 0.5) * c.pull
    c.go(0.5, over=0.2, drive=resistance, load=0.5 * resistance)
    change = c.drawn(0.02, 0.2) * c.pull
    for sign in (1.0, 0.0, -1.0, -1.0, 0.0):
        shares = 0.5 * resistance + sign * change, 0.5 * resistance - sign * change
        c.go(c.drawn(0.3, 0.6), over=0.2, left_load=shares[0], right_load=shares[1])
    c.go(0.5, over=0.2, load=0.5 * resistance)


def locked(c):
    """Launch with a closed lock, which opens while the car rolls."""
    c.go(0.1, lock=1.0)
    c.go(c.drawn(0.5, 1.0), over=0.2, drive=c.pull, right_load=0.3 * c.pull)
    c.go(0.3, over=0.1, right_load=0.0)
    c.go(0.5, lock=0.0)
    c.go(0.5, over=0.1, drive=0.0)


MANOEUVRES = (launch, reversal, stop, uneven_stop, hill, reverse, stop_and_go, park, blocked, creep, turn, locked)
