/* Questions to the library of answers. Made from crates/answers/src/ask/c.rs and crates/schedule/src/c.rs; do not edit. */

#ifndef BD_ANSWERS_H
#define BD_ANSWERS_H

#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

/**
 * Callback that receives the completed fraction of the work, from 0 to 1, and the name of the present task. `context`
 * is the pointer passed to `bd_ask`. Any result other than 0 stops the work.
 */
typedef int (*bd_progress)(void *context, double done, const char *what);

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

/**
 * Answers a question.
 *
 * `question` is a JSON object in UTF-8 that ends with a zero byte; `numbers` are `count` numbers that belong to it.
 * `progress` may be null. The reply is JSON that ends with a zero byte, and `bd_free` must free it. The reply is
 * `{"answer": ...}`, or `{"kind": "use" | "failed" | "stopped" | "internal", "problems": [...]}`. Both contain
 * `"warnings": [...]`, texts about the scene or its gears without repetitions. The reply is null only if there is not
 * enough memory.
 *
 * # Safety
 * `question` is null or points to a text with a zero byte at its end. `numbers` points to `count` numbers, or is null
 * with a count of 0. Both stay unchanged until the function returns. Several threads may call at the same time.
 */
char *bd_ask(const char *question,
             const double *numbers,
             size_t count,
             bd_progress progress,
             void *context);

/**
 * Frees a reply; null is ignored.
 *
 * # Safety
 * `reply` was returned by `bd_ask` and is not used again.
 */
void bd_free(char *reply);

/**
 * Writes the schedule of a run: one row for its start and one for each of its steps, up to `room` numbers in total.
 *
 * A row contains the start and size of the step for `fmi2DoStep`, its end (s), and the total number of changes made
 * before it. The next number is 1 if values jump at the start, so that outputs are recorded after values are set. The
 * next is 1 if outputs are recorded at the end, and 0 if only the slope of a table changes there. The value of each
 * table just after the start and the slope of each table per second follow. The row of the start contains the values
 * at the start. Its first number is the number of points between communication points if they make the run much
 * longer, or else 0.
 *
 * The `count` numbers of `question` are the end of the run, the step or 0 for none (s), the number of changes, and
 * their ascending times. For each table follow the number of points, the period or 0 for none, a rule, the times and
 * the values. The rule is 0 for an input that is linear within steps, 1 for values that are held up to the next point,
 * or 2 for values that are linear between points and held within a step.
 *
 * Returns the number of rows; rows without room are not written. Returns 0 if the question cannot be read, -1 if the
 * run has more than 1e8 steps, and -2 - i if table i has more than 1e8 jumps and points at which steps end.
 *
 * # Safety
 * `question` points to `count` numbers and `rows` to room for `room` numbers. Neither may be null, even if its size is
 * 0.
 */
ptrdiff_t bd_schedule(const double *question,
                      size_t count,
                      double *rows,
                      size_t room);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif  /* BD_ANSWERS_H */
