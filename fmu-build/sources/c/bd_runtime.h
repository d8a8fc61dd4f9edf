/* Runtime of the library in C: an instance with its memory, the operations of WebAssembly, and traps.

   The library is a program for a machine of WebAssembly. Here the machine is a struct: its memory has a fixed size, so nothing is
   allocated and no operating system is needed. An access outside of it, or anything else that the machine forbids, is a trap. A trap
   ends only the present call of FMI and its instance. */

#ifndef BD_RUNTIME_H
#define BD_RUNTIME_H

/* Products and sums must be rounded individually, because a fused operation gives other bits. Some compilers fuse by default, as gcc
   does in its default dialect. These lines prevent it, and bd_arithmetic_differs checks the result. Vectorised statements are also
   switched off: gcc 12 fuses alternating sums and differences of products in vectors even if fusing is forbidden. */
#if defined(__clang__)
#pragma STDC FP_CONTRACT OFF
#elif defined(__GNUC__)
#pragma GCC optimize("fp-contract=off", "no-tree-slp-vectorize", "no-tree-loop-vectorize")
#elif defined(_MSC_VER)
#pragma fp_contract(off)
#endif

#if defined(__BYTE_ORDER__) && __BYTE_ORDER__ != __ORDER_LITTLE_ENDIAN__
#error "The memory of the library is little-endian, and so must the processor be."
#endif

#include <math.h>
#include <setjmp.h>
#include <stdint.h>
#include <string.h>

/* Hides internal functions: a library exports only the functions of FMI. */
#if defined(__ELF__) || defined(__APPLE__)
#define BD_HIDDEN _Pragma("GCC visibility push(hidden)")
#define BD_SEEN _Pragma("GCC visibility pop")
#else
#define BD_HIDDEN
#define BD_SEEN
#endif

typedef uint8_t u8;
typedef uint16_t u16;
typedef uint32_t u32;
typedef uint64_t u64;
typedef int8_t s8;
typedef int16_t s16;
typedef int32_t s32;
typedef int64_t s64;
typedef float f32;
typedef double f64;

BD_HIDDEN

#define BD_PAGE 65536u
/* Maximum memory of an instance, in pages of 64 KiB. */
#ifndef BD_PAGES
#define BD_PAGES 32u
#endif
#define BD_MEMORY (BD_PAGES * BD_PAGE)

typedef struct bd {
    union { u8 bytes[BD_MEMORY]; f64 aligned; } memory;
    /* pages in use, and their maximum so far: memory beyond contains zeros */
    u32 pages, touched;
    BD_GLOBALS
    /* destination of the jump after a trap */
    jmp_buf home;
} bd;

/* Reasons of a trap. */
enum { BD_UNREACHABLE = 1, BD_OUT_OF_BOUNDS, BD_DIVISION, BD_WRONG_CALL };

#if defined(__GNUC__)
#define BD_NO_RETURN __attribute__((noreturn, cold))
#define BD_UNLIKELY(x) __builtin_expect(!!(x), 0)
#elif defined(_MSC_VER)
#define BD_NO_RETURN __declspec(noreturn)
#define BD_UNLIKELY(x) (x)
#else
#define BD_NO_RETURN
#define BD_UNLIKELY(x) (x)
#endif

BD_NO_RETURN void bd_trap(bd *s, int reason);

/* Initialises an instance, including its memory. */
void bd_start(bd *s);
/* Initial content of memory and globals; generated from the library. */
void bd_library_start(bd *s);
/* Reason why this program's arithmetic gives other bits than step-by-step IEEE 754; NULL if the bits agree. */
const char *bd_arithmetic_differs(void);

/* Pointer to `count` bytes at `place` + `offset`. */
static inline u8 *bd_at(bd *s, u32 place, u32 offset, u32 count) {
    if (BD_UNLIKELY((u64)place + offset + count > BD_MEMORY)) bd_trap(s, BD_OUT_OF_BOUNDS);
    return s->memory.bytes + ((size_t)place + offset);
}

#define BD_LOAD(name, in_memory, as) \
    static inline as name(bd *s, u32 place, u32 offset) { \
        in_memory value; \
        memcpy(&value, bd_at(s, place, offset, sizeof value), sizeof value); \
        return (as)value; \
    }
#define BD_STORE(name, in_memory, as) \
    static inline void name(bd *s, u32 place, u32 offset, as given) { \
        in_memory value = (in_memory)given; \
        memcpy(bd_at(s, place, offset, sizeof value), &value, sizeof value); \
    }

BD_LOAD(i32_load, u32, u32)
BD_LOAD(i64_load, u64, u64)
BD_LOAD(f32_load, f32, f32)
BD_LOAD(f64_load, f64, f64)
BD_LOAD(i32_load8_s, s8, u32)
BD_LOAD(i32_load8_u, u8, u32)
BD_LOAD(i32_load16_s, s16, u32)
BD_LOAD(i32_load16_u, u16, u32)
BD_LOAD(i64_load8_s, s8, u64)
BD_LOAD(i64_load8_u, u8, u64)
BD_LOAD(i64_load16_s, s16, u64)
BD_LOAD(i64_load16_u, u16, u64)
BD_LOAD(i64_load32_s, s32, u64)
BD_LOAD(i64_load32_u, u32, u64)
BD_STORE(i32_store, u32, u32)
BD_STORE(i64_store, u64, u64)
BD_STORE(f32_store, f32, f32)
BD_STORE(f64_store, f64, f64)
BD_STORE(i32_store8, u8, u32)
BD_STORE(i32_store16, u16, u32)
BD_STORE(i64_store8, u8, u64)
BD_STORE(i64_store16, u16, u64)
BD_STORE(i64_store32, u32, u64)

static inline void memory_copy(bd *s, u32 to, u32 from, u32 count) {
    memmove(bd_at(s, to, 0, count), bd_at(s, from, 0, count), count);
}
static inline void memory_fill(bd *s, u32 to, u32 value, u32 count) {
    memset(bd_at(s, to, 0, count), (int)(value & 255u), count);
}
/* Adds `pages`. Returns the previous number of pages, or -1 if there is not enough room. */
u32 memory_grow(bd *s, u32 pages);

/* Table of functions; functions of one type have the same type number. */
typedef void bd_function(void);
typedef struct { bd_function *function; u32 type; } bd_entry;
extern const bd_entry bd_table[];
extern const u32 bd_table_size;

static inline bd_function *bd_entry_of(bd *s, u32 type, u32 place) {
    if (BD_UNLIKELY(place >= bd_table_size || !bd_table[place].function || bd_table[place].type != type)) bd_trap(s, BD_WRONG_CALL);
    return bd_table[place].function;
}
#define bd_call(of, type, place) ((of)bd_entry_of(s, type, place))

/* Integers. */
static inline u32 bd_div_u32(bd *s, u32 x, u32 y) { if (!y) bd_trap(s, BD_DIVISION); return x / y; }
static inline u32 bd_rem_u32(bd *s, u32 x, u32 y) { if (!y) bd_trap(s, BD_DIVISION); return x % y; }
static inline u64 bd_div_u64(bd *s, u64 x, u64 y) { if (!y) bd_trap(s, BD_DIVISION); return x / y; }
static inline u64 bd_rem_u64(bd *s, u64 x, u64 y) { if (!y) bd_trap(s, BD_DIVISION); return x % y; }
#define DIV_U(x, y) (sizeof(x) == 8 ? bd_div_u64(s, x, y) : bd_div_u32(s, (u32)(x), (u32)(y)))
#define REM_U(x, y) (sizeof(x) == 8 ? bd_rem_u64(s, x, y) : bd_rem_u32(s, (u32)(x), (u32)(y)))
static inline u32 bd_div_s32(bd *s, s32 x, s32 y) {
    if (!y || (x == INT32_MIN && y == -1)) bd_trap(s, BD_DIVISION);
    return (u32)(x / y);
}
static inline u64 bd_div_s64(bd *s, s64 x, s64 y) {
    if (!y || (x == INT64_MIN && y == -1)) bd_trap(s, BD_DIVISION);
    return (u64)(x / y);
}
static inline u32 bd_rem_s32(bd *s, s32 x, s32 y) { if (!y) bd_trap(s, BD_DIVISION); return y == -1 ? 0 : (u32)(x % y); }
static inline u64 bd_rem_s64(bd *s, s64 x, s64 y) { if (!y) bd_trap(s, BD_DIVISION); return y == -1 ? 0 : (u64)(x % y); }
#define I32_DIV_S(x, y) bd_div_s32(s, (s32)(x), (s32)(y))
#define I64_DIV_S(x, y) bd_div_s64(s, (s64)(x), (s64)(y))
#define I32_REM_S(x, y) bd_rem_s32(s, (s32)(x), (s32)(y))
#define I64_REM_S(x, y) bd_rem_s64(s, (s64)(x), (s64)(y))
static inline u32 I32_ROTL(u32 x, u32 y) { y &= 31u; return y ? x << y | x >> (32u - y) : x; }
static inline u32 I32_ROTR(u32 x, u32 y) { return I32_ROTL(x, 32u - (y & 31u)); }
static inline u64 I64_ROTL(u64 x, u64 y) { y &= 63u; return y ? x << y | x >> (64u - y) : x; }
static inline u64 I64_ROTR(u64 x, u64 y) { return I64_ROTL(x, 64u - (y & 63u)); }
#if defined(__GNUC__)
static inline u32 I32_CLZ(u32 x) { return x ? (u32)__builtin_clz(x) : 32u; }
static inline u32 I32_CTZ(u32 x) { return x ? (u32)__builtin_ctz(x) : 32u; }
static inline u64 I64_CLZ(u64 x) { return x ? (u64)__builtin_clzll(x) : 64u; }
static inline u64 I64_CTZ(u64 x) { return x ? (u64)__builtin_ctzll(x) : 64u; }
#else
static inline u64 I64_CLZ(u64 x) { u64 n = 0; if (!x) return 64u; while (!(x >> 63)) { x <<= 1; ++n; } return n; }
static inline u64 I64_CTZ(u64 x) { u64 n = 0; if (!x) return 64u; while (!(x & 1u)) { x >>= 1; ++n; } return n; }
static inline u32 I32_CLZ(u32 x) { return x ? (u32)I64_CLZ(x) - 32u : 32u; }
static inline u32 I32_CTZ(u32 x) { return x ? (u32)I64_CTZ(x) : 32u; }
#endif
static inline u32 I32_POPCNT(u32 x) { u32 n = 0; for (; x; x &= x - 1) ++n; return n; }
static inline u64 I64_POPCNT(u64 x) { u64 n = 0; for (; x; x &= x - 1) ++n; return n; }

/* Numbers: operations that C leaves undefined or defines differently. */
static inline u64 i64_reinterpret_f64(f64 x) { u64 y; memcpy(&y, &x, sizeof y); return y; }
static inline f64 f64_reinterpret_i64(u64 x) { f64 y; memcpy(&y, &x, sizeof y); return y; }
static inline u32 i32_reinterpret_f32(f32 x) { u32 y; memcpy(&y, &x, sizeof y); return y; }
static inline f32 f32_reinterpret_i32(u32 x) { f32 y; memcpy(&y, &x, sizeof y); return y; }
#define wasm_fabs fabs
#define wasm_sqrt sqrt
#define wasm_floor floor
#define wasm_ceil ceil
#define wasm_trunc trunc
#define wasm_nearbyint nearbyint
#define wasm_quiet(x) (x)
static inline f64 bd_min(f64 x, f64 y) {
    if (x != x || y != y) return f64_reinterpret_i64(0x7ff8000000000000u);
    return x == 0 && y == 0 ? (signbit(x) ? x : y) : x < y ? x : y;
}
static inline f64 bd_max(f64 x, f64 y) {
    if (x != x || y != y) return f64_reinterpret_i64(0x7ff8000000000000u);
    return x == 0 && y == 0 ? (signbit(x) ? y : x) : x > y ? x : y;
}
#define FMIN bd_min
#define FMAX bd_max
/* Conversions that saturate at the ends of the range; NaN becomes 0. */
static inline u32 I32_TRUNC_SAT_S_F64(f64 x) {
    return x != x ? 0 : x <= -2147483649.0 ? 0x80000000u : x >= 2147483648.0 ? 0x7fffffffu : (u32)(s32)x;
}
static inline u64 I64_TRUNC_SAT_S_F64(f64 x) {
    return x != x ? 0 : x < -9223372036854775808.0 ? 0x8000000000000000u : x >= 9223372036854775808.0 ? 0x7fffffffffffffffu : (u64)(s64)x;
}
static inline u32 I32_TRUNC_SAT_U_F64(f64 x) { return !(x > -1.0) ? 0 : x >= 4294967296.0 ? 0xffffffffu : (u32)x; }
static inline u64 I64_TRUNC_SAT_U_F64(f64 x) {
    return !(x > -1.0) ? 0 : x >= 18446744073709551616.0 ? 0xffffffffffffffffu : (u64)x;
}

BD_SEEN

#endif
