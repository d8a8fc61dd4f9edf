/* Questions to the library of answers. Made from crates/answers/src/ask/c.rs and crates/schedule/src/c.rs; do not edit. */

#ifndef BD_ANSWERS_H
#define BD_ANSWERS_H

#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

/**
 * Told the part of the work that is done, from 0 to 1, and what is being done; `context` is what the caller of `bd_ask` gave.
 * Another value than 0 stops the work.
 */
typedef int (*bd_progress)(void *context, double done, const char *what);

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

/**
 * Answers a question.
 *
 * `question` is an object of JSON in UTF-8 that ends with a zero byte; `numbers` are the numbers that belong to it, `count` of
 * them. `progress` may be null. The reply is JSON that ends with a zero byte, to be freed by `bd_free`: `{"answer": ...}`, or
 * `{"kind": "use" | "failed" | "stopped" | "internal", "problems": [...]}`. Both have `"warnings": [...]`, texts about the scene or
 * its gears, each once. It is null only where there is no memory.
 *
 * # Safety
 * `question` is null or points to a text with a zero byte at its end, `numbers` to `count` numbers or is null with a count of 0;
 * both stay as they are until this returns. Any thread may call, several at a time.
 */
char *bd_ask(const char *question,
             const double *numbers,
             size_t count,
             bd_progress progress,
             void *context);

/**
 * Frees a reply; null is nothing to free.
 *
 * # Safety
 * `reply` is what `bd_ask` gave, and is not used again.
 */
void bd_free(char *reply);

/**
 * Writes the schedule of a run: a row of numbers for its start and for each of its steps, up to `room` numbers in all.
 *
 * A row has the beginning and size of the step as they are passed to `fmi2DoStep`, its end (s), the number of changes that are made
 * before it, counted from the first one, the value of each table just after its beginning, and the slope of each table per second.
 * The row of the start has zeros and the values at the start.
 *
 * The `count` numbers of `question` are: end of the run, step or 0 for none (s), number of changes, their times, rising; then of each table:
 * number of points, period or 0 for none, 1 if values are held and 0 if they are straight between points, times, values.
 *
 * Returns the number of rows, of which those without room are not written; 0 if the question cannot be read; -1 if the run has
 * more than 1e8 steps; -2 - i if table i has more than 1e8 jumps, or more than 1e8 points in a run without a step.
 *
 * # Safety
 * `question` points to `count` numbers and `rows` to room for `room` numbers. Neither is null, whatever these are.
 */
ptrdiff_t bd_schedule(const double *question,
                      size_t count,
                      double *rows,
                      size_t room);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif  /* BD_ANSWERS_H */
