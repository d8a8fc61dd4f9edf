/* The calls of runs without anything around them: reset, set, initialise, step, get, as a host in C makes them.
   calls LIBRARY GUID SET STRETCHES RUNS INPUT [OUTPUT...]
   SET: a file of start values; STRETCHES: END:STEP,... of the run, STEP 0: one long step; OUTPUT: value references of Reals.
   INPUT: "constant", or HOW:REFERENCE:MEAN:AMPLITUDE:FREQUENCY for a Real input that follows a sine [Hz] and is set before each step.
   HOW is "held" (constant through the step) or "lines" (with its slope, so that it reaches the value of the next step).
   Prints a line for each run: its seconds, and the seconds of the processor that its steps took. */

#include <math.h>

#include "host.h"

/* The input that moves; without one, `is_driven` is 0. */
static struct {
    int is_driven, has_slope;
    Reference input;
    double mean, amplitude, frequency;
} drive;

static void read_drive(const char *given) {
    char how[16];
    if (!strcmp(given, "constant")) return;
    drive.is_driven = 5 == sscanf(given, "%15[a-z]:%u:%lf:%lf:%lf", how, &drive.input, &drive.mean, &drive.amplitude, &drive.frequency);
    drive.has_slope = !strcmp(how, "lines");
    if (!drive.is_driven || (!drive.has_slope && strcmp(how, "held"))) fprintf(stderr, "%s is not an input that moves\n", given), exit(2);
}

static double driven(double time) { return drive.mean + drive.amplitude * sin(6.283185307179586 * drive.frequency * time); }

/* Sets the moving input for the step from `from` to `to` [s]. */
static void drive_input(Component it, double from, double to) {
    static const int first = 1;
    double value = driven(from);
    check(fmi.set_real(it, &drive.input, 1, &value), "input");
    if (!drive.has_slope) return;
    double slope = (driven(to) - value) / (to - from);
    check(fmi.slopes(it, &drive.input, 1, &first, &slope), "slope");
}

int main(int count, char **given) {
    if (count < 7) { fprintf(stderr, "calls LIBRARY GUID SET STRETCHES RUNS INPUT [OUTPUT...]\n"); return 2; }
    Reference outputs[MOST];
    double values[MOST], ends[MOST], sizes[MOST];
    size_t n_outputs = 0;
    int n_stretches = 0, runs = atoi(given[5]);
    read_start(given[3]);
    read_drive(given[6]);
    for (char *part = strtok(given[4], ","); part && n_stretches < MOST; part = strtok(NULL, ","), ++n_stretches)
        if (sscanf(part, "%lf:%lf", &ends[n_stretches], &sizes[n_stretches]) != 2) return fprintf(stderr, "%s is not END:STEP\n", part), 2;
    for (int k = 7; k < count && n_outputs < MOST; ++k) outputs[n_outputs++] = (Reference)atoi(given[k]);

    Component it = made(given[1], given[2]);
    for (int run = 0; run < runs; ++run) {
        double begin = now(CLOCK_MONOTONIC);
        if (run) check(fmi.reset(it), "reset");
        initialise(it, ends[n_stretches - 1]);
        check(fmi.get_real(it, outputs, n_outputs, values), "get");
        double stepping = now(CLOCK_PROCESS_CPUTIME_ID);
        for (int stretch = 0; stretch < n_stretches; ++stretch) {
            double first = stretch ? ends[stretch - 1] : 0.0, length = ends[stretch] - first;
            long steps = sizes[stretch] > 0.0 ? (long)(length / sizes[stretch] + 0.5) : 1;
            for (long k = 0; k < steps; ++k) {
                double from = first + k * length / steps, to = first + (k + 1) * length / steps;
                if (drive.is_driven) drive_input(it, from, to);
                check(fmi.step(it, from, to - from, 1), "step");
                if (n_outputs) check(fmi.get_real(it, outputs, n_outputs, values), "get");
            }
        }
        stepping = now(CLOCK_PROCESS_CPUTIME_ID) - stepping;
        printf("%.9f %.9f\n", now(CLOCK_MONOTONIC) - begin, stepping);
    }
    return 0;
}
