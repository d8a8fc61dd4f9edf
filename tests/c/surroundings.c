/* The library leaves the host's process as it was: working directory, environment, locale, signals, floating-point mode,
   files, threads, standard output and error. The program also measures how the host's floating-point mode changes results.
   Usage: surroundings LIBRARY GUID LOAD SPEED INERTIA. The last three are value references. */

#define _GNU_SOURCE
#include <dirent.h>
#include <fenv.h>
#include <locale.h>
#include <math.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>
#include <xmmintrin.h>

#include "fmi2.h"

extern char **environ;

static const char *guid;
static unsigned input, output, inertia;

enum { SIGNALS = 64, STEPS = 50 };
/* Control bits of the SSE unit: flush to zero, trap masks and rounding. The other bits are exception flags. */
static const unsigned CONTROL = 0xffc0;

typedef struct {
    char folder[4096], locale[256], environment[65536];
    void (*handlers[SIGNALS + 1])(int);
    int flags[SIGNALS + 1], blocked[SIGNALS + 1];
    unsigned sse;
    unsigned short x87;
    int rounding, files, threads;
    mode_t mask;
} Surroundings;

static int entries(const char *folder)
{
    int n = 0;
    DIR *open = opendir(folder);
    MUST(open);
    while (readdir(open))
        ++n;
    closedir(open);
    return n;
}

static Surroundings inspect(void)
{
    Surroundings s;
    memset(&s, 0, sizeof s);
    MUST(getcwd(s.folder, sizeof s.folder));
    snprintf(s.locale, sizeof s.locale, "%s", setlocale(LC_ALL, NULL));
    for (char **entry = environ; *entry; ++entry)
        strncat(s.environment, *entry, sizeof s.environment - strlen(s.environment) - 1);
    sigset_t blocked;
    MUST(sigprocmask(SIG_BLOCK, NULL, &blocked) == 0);
    for (int i = 1; i <= SIGNALS; ++i) {
        struct sigaction action;
        s.blocked[i] = sigismember(&blocked, i);
        if (sigaction(i, NULL, &action) == 0) {
            s.handlers[i] = action.sa_handler;
            s.flags[i] = action.sa_flags;
        }
    }
    s.sse = _mm_getcsr() & CONTROL;
    __asm__("fnstcw %0" : "=m"(s.x87));
    s.rounding = fegetround();
    s.files = entries("/proc/self/fd");
    s.threads = entries("/proc/self/task");
    s.mask = umask(0);
    umask(s.mask);
    return s;
}

/* Runs with refused calls, a failed step, states and a failed initialisation. Returns the speed after the steps. */
static double run(void)
{
    long lines = 0;
    Callbacks callbacks = counting(&lines);
    void *c = Instantiate("run", CO_SIMULATION, guid, NULL, &callbacks, 0, 1), *state = NULL;
    /* without inertia at its end, the side gear would rattle, and rounding errors would determine the impacts */
    double speed, end = 0.5, load = 1e7, none = NAN, module = 4.5;
    unsigned first = 0;
    MUST(c && !Instantiate("run", CO_SIMULATION, "{wrong}", NULL, &callbacks, 0, 1));
    MUST(SetReal(c, &inertia, 1, &end) == OK && SetupExperiment(c, 0, 0.0, 0.0, 0, 0.0) == OK);
    MUST(EnterInitializationMode(c) == OK && ExitInitializationMode(c) == OK);
    for (int i = 0; i < STEPS; ++i) {
        double wave = 800.0 + i;
        MUST(SetReal(c, &input, 1, &wave) == OK && DoStep(c, i * 1e-3, 1e-3, 1) == OK);
    }
    MUST(GetReal(c, &output, 1, &speed) == OK && GetFMUstate(c, &state) == OK);
    MUST(SetReal(c, &input, 1, &none) == DISCARD && DoStep(c, 0.0, -1.0, 1) == ERROR);
    MUST(SetFMUstate(c, state) == OK && FreeFMUstate(c, &state) == OK && Terminate(c) == OK && Reset(c) == OK);
    /* this load bends the teeth too far */
    MUST(EnterInitializationMode(c) == OK && ExitInitializationMode(c) == OK && SetReal(c, &input, 1, &load) == OK);
    MUST(DoStep(c, 0.0, 1e-2, 1) == DISCARD && Reset(c) == OK);
    MUST(SetReal(c, &first, 1, &module) == OK && EnterInitializationMode(c) == OK);
    MUST(ExitInitializationMode(c) == ERROR && lines > 0);
    FreeInstance(c);

    c = Instantiate("exchange", MODEL_EXCHANGE, guid, NULL, &callbacks, 0, 1);
    double rates[STATES];
    EventInfo info;
    MUST(c && SetupExperiment(c, 0, 0.0, 0.0, 0, 0.0) == OK);
    MUST(EnterInitializationMode(c) == OK && ExitInitializationMode(c) == OK);
    MUST(NewDiscreteStates(c, &info) == OK && EnterContinuousTimeMode(c) == OK);
    MUST(GetDerivatives(c, rates, STATES) == OK);
    FreeInstance(c);
    return speed;
}

/* Repeats the run in another floating-point mode, which the library must not change. Prints the relative change of the result. */
static void in_mode(const char *name, unsigned sse, int rounding, double plain)
{
    unsigned before = _mm_getcsr();
    fesetround(rounding);
    _mm_setcsr((_mm_getcsr() & ~0x8040u) | sse);
    Surroundings mode = inspect();
    double speed = run();
    Surroundings after = inspect();
    fesetround(FE_TONEAREST);
    _mm_setcsr(before);
    MUST(!memcmp(&mode, &after, sizeof mode));
    printf("%s %.3g\n", name, fabs(speed / plain - 1.0));
}

/* Runs in a child process that traps floating-point exceptions, and prints if the process survives. */
static void trapping(const char *name, int exceptions)
{
    fflush(stdout);
    pid_t child = fork();
    if (child == 0) {
        feclearexcept(FE_ALL_EXCEPT);
        feenableexcept(exceptions);
        run();
        _exit(0);
    }
    int status = 0;
    MUST(child > 0 && waitpid(child, &status, 0) == child);
    printf("trapping %s %s\n", name, WIFEXITED(status) && WEXITSTATUS(status) == 0 ? "runs" : "stopped");
}

int main(int count, char **arguments)
{
    if (count != 6) {
        fprintf(stderr, "usage: surroundings LIBRARY GUID LOAD SPEED INERTIA\n");
        return 2;
    }
    guid = arguments[2];
    input = (unsigned)atoi(arguments[3]);
    output = (unsigned)atoi(arguments[4]);
    inertia = (unsigned)atoi(arguments[5]);
    /* unusual settings, so that a library that overwrites them is noticed */
    setlocale(LC_ALL, "C.UTF-8");
    setenv("BEVEL_TEST", "%s 1,5", 1);
    umask(027);
    signal(SIGPIPE, SIG_DFL);

    /* before opening the library, so that the check includes its loading */
    Surroundings before = inspect();
    open_library(arguments[1]);
    FILE *output_file = tmpfile();
    MUST(output_file && fflush(stdout) == 0 && fflush(stderr) == 0);
    int out = dup(1), err = dup(2);
    setvbuf(reports = fdopen(dup(2), "w"), NULL, _IONBF, 0);
    MUST(dup2(fileno(output_file), 1) == 1 && dup2(fileno(output_file), 2) == 2);
    double plain = run();
    fflush(NULL);
    struct stat written;
    int known = fstat(fileno(output_file), &written);
    dup2(out, 1), dup2(err, 2);
    close(out), close(err), fclose(output_file), fclose(reports);
    reports = NULL;
    MUST(known == 0 && written.st_size == 0);
    Surroundings after = inspect();
    MUST(!strcmp(before.folder, after.folder));
    MUST(!strcmp(before.environment, after.environment));
    MUST(!strcmp(before.locale, after.locale));
    MUST(!memcmp(before.handlers, after.handlers, sizeof before.handlers));
    MUST(!memcmp(before.flags, after.flags, sizeof before.flags));
    MUST(!memcmp(before.blocked, after.blocked, sizeof before.blocked));
    MUST(before.sse == after.sse && before.x87 == after.x87 && before.rounding == after.rounding);
    MUST(before.files == after.files && before.threads == after.threads && before.mask == after.mask);

    in_mode("flush_to_zero", 0x8040, FE_TONEAREST, plain);
    in_mode("upward", 0, FE_UPWARD, plain);
    in_mode("downward", 0, FE_DOWNWARD, plain);
    in_mode("toward_zero", 0, FE_TOWARDZERO, plain);
    trapping("invalid", FE_INVALID);
    trapping("division", FE_DIVBYZERO);
    trapping("overflow", FE_OVERFLOW);
    MUST(run() == plain);
    return 0;
}
