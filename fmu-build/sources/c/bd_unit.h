/* Instances of the unit: each has a separate machine that runs the library. */

#ifndef BD_UNIT_H
#define BD_UNIT_H

#include "fmi2Functions.h"

#include "bd_library.h"

BD_HIDDEN

/* Maximum number of instances in a program at the same time. */
#ifndef BD_INSTANCES
#define BD_INSTANCES 4
#endif

typedef struct bd_unit {
    bd machine;
    /* the host's function for messages, NULL if there is none, and its argument */
    fmi2CallbackLogger logger;
    fmi2ComponentEnvironment environment;
    char name[128];
    int is_used, is_dead;
    /* the instance within the library */
    u32 component;
} bd_unit;

/* Creates an instance for the host that passed `functions`, with the library at its start; NULL and a message if all are in use. */
bd_unit *bd_take(const fmi2CallbackFunctions *functions, fmi2String name);

/* Room for `bytes` in the library's memory, until the next call of this function. */
u32 bd_room(bd_unit *u, size_t bytes);
/* Copies to and from the library's memory; does nothing if the host's pointer is NULL. */
void bd_put(bd_unit *u, u32 place, const void *from, size_t bytes);
void bd_get(bd_unit *u, u32 place, void *to, size_t bytes);
/* Copies a text that ends with 0, cut to `most` bytes; 0 for NULL. */
u32 bd_put_text(bd_unit *u, u32 place, const char *text, size_t most);
/* Copies a list of short texts, as pointers to them; 0 for NULL. */
u32 bd_put_texts(bd_unit *u, const char *const texts[], size_t count);
/* Converts an address in the library's memory to a pointer of the host, and back; 0 corresponds to NULL. A pointer into the memory of
   another instance becomes 1, which the library refuses. */
void *bd_to_host(bd_unit *u, u32 place);
u32 bd_from_host(bd_unit *u, const void *pointer);

/* Passes the messages of a call to the host, and returns the status. */
fmi2Status bd_ended(bd_unit *u, u32 status);
/* Passes a message about a trap to the host; the instance is dead. */
fmi2Status bd_died(bd_unit *u, int reason);

BD_SEEN

#endif
