/* Host for libraries of other processors: it runs in an emulator and reads calls from standard input.
   far LIBRARY GUID
   A call consists of a letter and a count, then value references and values; the answer is the status, then the requested values.
   All numbers are in memory format: both machines are little-endian.
   R N B: set Reals, Integers, Booleans; r n b: get them; E: set up and enter initialisation; L: leave it; S: a step with two
   numbers, time and size; X: reset. The program ends with its input. */

#include "host.h"

static void take(void *to, size_t size) {
    if (size && fread(to, size, 1, stdin) != 1) exit(feof(stdin) ? 0 : 1);
}

static void give(const void *from, size_t size) {
    if (size && fwrite(from, size, 1, stdout) != 1) exit(1);
}

static int called(Component it, char call, const Reference *of, unsigned count, void *values) {
    const double *step = values;
    switch (call) {
    case 'R': return fmi.set_real(it, of, count, values);
    case 'N': return fmi.set_integer(it, of, count, values);
    case 'B': return fmi.set_boolean(it, of, count, values);
    case 'r': return fmi.get_real(it, of, count, values);
    case 'n': return fmi.get_integer(it, of, count, values);
    case 'b': return fmi.get_boolean(it, of, count, values);
    case 'E': { int status = fmi.setup(it, 0, 0.0, 0.0, 0, 0.0); return status > 1 ? status : fmi.enter(it); }
    case 'L': return fmi.leave(it);
    case 'S': return fmi.step(it, step[0], step[1], 1);
    case 'X': return fmi.reset(it);
    default: fprintf(stderr, "no call %c\n", call); exit(1);
    }
}

int main(int count, char **given) {
    if (count != 3) return fprintf(stderr, "far LIBRARY GUID\n"), 2;
    Component it = made(given[1], given[2]);
    for (char call;;) {
        unsigned many;
        take(&call, 1);
        take(&many, sizeof many);
        int gets = call >= 'a', step = call == 'S';
        size_t size = call == 'R' || call == 'r' || step ? sizeof(double) : sizeof(int);
        Reference *of = malloc(many * sizeof *of + 1);
        void *values = malloc(many * size + 1);
        if (!of || !values) return fprintf(stderr, "no memory\n"), 1;
        if (!step) take(of, many * sizeof *of);
        if (!gets) take(values, many * size);
        int status = called(it, call, of, many, values);
        give(&status, sizeof status);
        if (gets) give(values, many * size);
        fflush(stdout);
        free(of);
        free(values);
    }
}
