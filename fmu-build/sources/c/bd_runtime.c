/* The library's machine: its start, its memory, its end by a trap, and a check of the processor's arithmetic. */

#include "bd_library.h"

#include <float.h>

void bd_start(bd *s) {
    memset(s->memory.bytes, 0, (size_t)s->touched * BD_PAGE);
    s->pages = s->touched = BD_FIRST_PAGES;
    bd_library_start(s);
}

u32 memory_grow(bd *s, u32 pages) {
    u32 before = s->pages;
    if (pages > BD_PAGES - before) return 0xffffffffu;
    s->pages = before + pages;
    if (s->touched < s->pages) s->touched = s->pages;
    return before;
}

void bd_trap(bd *s, int reason) { longjmp(s->home, reason); }

/* Volatile, so that the compiler cannot evaluate anything in advance. */
static volatile f64 bd_given[3];
static f64 bd_after(f64 x, f64 y, f64 z) {
    bd_given[0] = x;
    bd_given[1] = y;
    bd_given[2] = z;
    f64 a = bd_given[0], b = bd_given[1], c = bd_given[2];
    /* one operation per statement, as in the library */
    a *= b;
    a += c;
    return a;
}

/* A difference and a sum of products side by side, which compilers may combine in a vector; the check detects fused operations. */
static volatile f64 bd_pairs[3][2] = {{1.0 + DBL_EPSILON, 1.0 + DBL_EPSILON}, {1.0 - DBL_EPSILON, 1.0 - DBL_EPSILON}, {1.0, -1.0}};
#if defined(__GNUC__)
__attribute__((noinline))
#endif
static void bd_side_by_side(const f64 *x, const f64 *y, const f64 *z, f64 *to) {
    f64 first = x[0], second = x[1];
    first *= y[0];
    second *= y[1];
    first -= z[0];
    second += z[1];
    to[0] = first;
    to[1] = second;
}

const char *bd_arithmetic_differs(void) {
    const f64 e = DBL_EPSILON;
    static const char fused[] = "products and sums are fused; compile with -ffp-contract=off, so that results equal those of other machines";
    f64 x[3][2], to[2];
    int k;
    for (k = 0; k < 6; ++k) x[k / 2][k % 2] = bd_pairs[k / 2][k % 2];
    bd_side_by_side(x[0], x[1], x[2], to);
    /* (1 + e)(1 - e) = 1 - e² rounds to 1: a remainder shows that the product was not rounded */
    if (bd_after(1.0 + e, 1.0 - e, -1.0) != 0.0) return fused;
    if (to[0] != 0.0 || to[1] != 0.0) return fused;
    if (bd_after(DBL_MIN, 0.5, 0.0) == 0.0 || bd_after(DBL_MIN * e, 1.0, 0.0) != DBL_MIN * e) return "numbers near zero are flushed to it; compile without -ffast-math, and set the processor to IEEE 754";
    /* above the middle between two numbers by less than extended precision resolves: the upper number, if rounded only once */
    if (bd_after(e * (0.5 + e), 1.0, 1.0) != 1.0 + e) return "numbers are rounded twice; on x86 compile with -msse2 -mfpmath=sse";
    if (bd_after(e * 0.75, 1.0, 1.0) != 1.0 + e || bd_after(e * 0.25, 1.0, 1.0) != 1.0 || bd_after(e * -0.75, 0.5, -1.0) != -1.0)
        return "numbers are not rounded to nearest; set the processor to IEEE 754";
    return 0;
}
