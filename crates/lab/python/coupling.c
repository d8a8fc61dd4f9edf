/* A car that accelerates with its left wheel on ice, coupled with the differential: wheels stand on the shafts of the differential; the
   tyres' forces, the car's speed and the drive torque are the host's:

     F = uN tanh(C k/uN),  k = (w r - v)/v,   m dv/dt = F_L + F_R,   T_c = T0 + (T1 - T0) sin^2(pi t/2 t1)

   A tyre that grips is a damper of C r^2/v between wheel and car, by far the stiffest thing that crosses the interface; the teeth do not.

   coupling LIBRARY GUID SET HOW STEP RUNS STATES INPUT*3 SPEED*2 FORCE*2 COUNT*2
   HOW: 0, 1, 2: inputs held over steps, each taken back and repeated so many times with the mean of its inputs at both ends; constant: no
   coupling; whole: differential, wheels and car in one piece by the classical Runge-Kutta method, from the equations of motion alone.
   INPUT: value references of the torque on the carrier and of both loads. Prints speeds and forces at each time of comparison, then for
   each run counts of the solver and the seconds of the processor. */

#include <math.h>

#include "host.h"

/* kg, m, N, N, s, rad/s; grip of left and right tyre: ice and dry road; torque [N m] at the start and at the end of its rise */
static const double MASS = 1400.0, RADIUS = 0.3, STIFFNESS = 6e4, LOAD = 3500.0, RISE = 0.3, SPEED = 70.0;
static const double GRIP[2] = {0.15, 0.9}, TORQUE[2] = {50.0, 400.0};
/* how long runs take, and when they are compared [s] */
static const double TIMES[4] = {0.1, 0.2, 0.3, 0.4};
static const double CONSTANT[3] = {400.0, 150.0, 200.0};

static Component it;
static Reference inputs[3], speeds[2], compared[4], counts[2];
static double car;

/* Torque on the carrier and loads of the wheels at a time, wheels and car at these speeds. */
static void drive(double time, const double *wheels, double speed, double *found) {
    double rise = sin(0.5 * M_PI * fmin(time / RISE, 1.0));
    found[0] = TORQUE[0] + (TORQUE[1] - TORQUE[0]) * rise * rise;
    for (int side = 0; side < 2; ++side) {
        double most = GRIP[side] * LOAD;
        found[1 + side] = RADIUS * most * tanh(STIFFNESS * (wheels[side] * RADIUS - speed) / (speed * most));
    }
}

static double acceleration(const double *given) { return (given[1] + given[2]) / (RADIUS * MASS); }

static void set(const double *given) { check(fmi.set_real(it, inputs, 3, given), "inputs"); }

static void read_speeds(double *wheels) { check(fmi.get_real(it, speeds, 2, wheels), "speeds"); }

/* Prints what is compared, under the inputs of this instant where there is a coupling. */
static void sample(double time, int is_constant) {
    double wheels[2], given[3], values[4];
    read_speeds(wheels);
    drive(time, wheels, car, given);
    if (!is_constant) set(given);
    check(fmi.get_real(it, compared, 4, values), "sample");
    printf("%.17g %.17g %.17g %.17g\n", values[0], values[1], values[2], values[3]);
}

static void one_step(double begin, double end, int again, void **state) {
    double wheels[2], given[3], found[3], h = end - begin, before = car;
    read_speeds(wheels);
    drive(begin, wheels, car, given);
    if (again) check(fmi.get_state(it, state), "get state");
    set(given);
    check(fmi.step(it, begin, h, 0), "step");
    car = before + h * acceleration(given);
    while (again-- > 0) {
        read_speeds(wheels);
        drive(end, wheels, car, found);
        for (int k = 0; k < 3; ++k) found[k] = 0.5 * (given[k] + found[k]);
        check(fmi.set_state(it, *state), "set state");
        set(found);
        check(fmi.step(it, begin, h, 0), "step");
        car = before + h * acceleration(found);
    }
}

static void coupled(double h, int again, int is_constant, int print) {
    void *state = NULL;
    double done = 0.0;
    for (int k = 0; k < 4; ++k) {
        for (double steps = round(TIMES[k] / h); done < steps; done += 1.0) {
            if (is_constant) {
                set(CONSTANT);
                check(fmi.step(it, done * h, (done + 1.0) * h - done * h, 0), "step");
            } else one_step(done * h, (done + 1.0) * h, again, &state);
        }
        if (print) sample(TIMES[k], is_constant);
    }
}

/* Rates of states and car at a time. */
static void rates(double time, const double *at, size_t n, double *found) {
    double wheels[2], given[3];
    check(fmi.set_states(it, at, n), "set states");
    read_speeds(wheels);
    drive(time, wheels, at[n], given);
    set(given);
    check(fmi.get_rates(it, found, n), "rates");
    found[n] = acceleration(given);
}

static void whole(double h, size_t n) {
    double y[MOST], at[MOST], k[4][MOST], done = 0.0;
    const double part[4] = {0.0, 0.5, 0.5, 1.0};
    char info[64];
    check(fmi.events(it, info), "events");
    check(fmi.continuous(it), "continuous time");
    check(fmi.get_states(it, y, n), "states");
    y[n] = car;
    for (int compare = 0; compare < 4; ++compare) {
        for (double steps = round(TIMES[compare] / h); done < steps; done += 1.0) {
            for (int stage = 0; stage < 4; ++stage) {
                for (size_t i = 0; i <= n; ++i) at[i] = stage ? y[i] + part[stage] * h * k[stage - 1][i] : y[i];
                rates(done * h + part[stage] * h, at, n, k[stage]);
            }
            for (size_t i = 0; i <= n; ++i) y[i] += h / 6.0 * (k[0][i] + 2.0 * (k[1][i] + k[2][i]) + k[3][i]);
        }
        check(fmi.set_states(it, y, n), "set states");
        car = y[n];
        sample(done * h, 0);
    }
}

int main(int count, char **given) {
    if (count != 17) { fprintf(stderr, "coupling LIBRARY GUID SET HOW STEP RUNS STATES INPUT*3 SPEED*2 FORCE*2 COUNT*2\n"); return 2; }
    int is_whole = !strcmp(given[4], "whole"), is_constant = !strcmp(given[4], "constant"), runs = atoi(given[6]);
    double h = atof(given[5]), wheels[2] = {SPEED, SPEED}, first[3], steps[2];
    for (int k = 0; k < 9; ++k) {
        Reference reference = (Reference)atoi(given[8 + k]);
        if (k < 3) inputs[k] = reference;
        else if (k < 5) speeds[k - 3] = compared[k - 3] = reference;
        else if (k < 7) compared[k - 3] = reference;
        else counts[k - 7] = reference;
    }
    read_start(given[3]);
    it = made(given[1], given[2], !is_whole);
    for (int run = 0; run < runs; ++run) {
        if (run) check(fmi.reset(it), "reset");
        /* the car's speed at which the tyres carry the torque of the start: the right one, far below its grip, is all but linear */
        car = RADIUS * SPEED / (1.0 + 0.5 * TORQUE[0] / RADIUS / STIFFNESS);
        drive(0.0, wheels, car, first);
        set(first);
        initialise(it, TIMES[3]);
        double begin = now(CLOCK_PROCESS_CPUTIME_ID);
        if (is_whole) whole(h, (size_t)atoi(given[7]));
        else coupled(h, atoi(given[4]), is_constant, run == 0);
        begin = now(CLOCK_PROCESS_CPUTIME_ID) - begin;
        if (is_whole) return 0;
        check(fmi.get_real(it, counts, 2, steps), "counts");
        printf("run %.0f %.0f %.9f\n", steps[0], steps[1], begin);
    }
    return 0;
}
