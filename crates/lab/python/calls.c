/* The calls of runs without anything around them: reset, set, initialise, step, get, as a host in C makes them.
   calls LIBRARY GUID SET STRETCHES RUNS [OUTPUT...]
   SET: a file of start values; STRETCHES: END:STEP,... of the run, STEP 0: one long step; OUTPUT: value references of Reals.
   Prints a line for each run: its seconds, and the seconds of the processor that its steps took. */

#include "host.h"

int main(int count, char **given) {
    if (count < 6) { fprintf(stderr, "calls LIBRARY GUID SET STRETCHES RUNS [OUTPUT...]\n"); return 2; }
    Reference outputs[MOST];
    double values[MOST], ends[MOST], sizes[MOST];
    size_t n_outputs = 0;
    int n_stretches = 0, runs = atoi(given[5]);
    read_start(given[3]);
    for (char *part = strtok(given[4], ","); part && n_stretches < MOST; part = strtok(NULL, ","), ++n_stretches)
        if (sscanf(part, "%lf:%lf", &ends[n_stretches], &sizes[n_stretches]) != 2) return fprintf(stderr, "%s is no stretch\n", part), 2;
    for (int k = 6; k < count && n_outputs < MOST; ++k) outputs[n_outputs++] = (Reference)atoi(given[k]);

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
                check(fmi.step(it, from, to - from, 1), "step");
                if (n_outputs) check(fmi.get_real(it, outputs, n_outputs, values), "get");
            }
        }
        stepping = now(CLOCK_PROCESS_CPUTIME_ID) - stepping;
        printf("%.9f %.9f\n", now(CLOCK_MONOTONIC) - begin, stepping);
    }
    return 0;
}
