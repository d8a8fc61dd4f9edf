/* Instances of the unit: each has a machine of its own that runs the library. */

#ifndef BD_UNIT_H
#define BD_UNIT_H

#include "fmi2Functions.h"

#include "bd_library.h"

BD_HIDDEN

/* Instances that a program may have at once. */
#ifndef BD_INSTANCES
#define BD_INSTANCES 4
#endif

typedef struct bd_unit {
    bd machine;
    /* the host's function for messages, NULL if there is none, and what it is called with */
    fmi2CallbackLogger logger;
    fmi2ComponentEnvironment environment;
    char name[128];
    int is_used, is_dead;
    /* the instance within the library */
    u32 component;
} bd_unit;

/* An instance for the host that gave `functions`, with the library at its start; NULL where there is none, which is said. */
bd_unit *bd_take(const fmi2CallbackFunctions *functions, fmi2String name);

/* Room for `bytes` in the library's memory, until the next call of this. */
u32 bd_room(bd_unit *u, size_t bytes);
/* Copies to and from the library's memory; nothing where the host's pointer is NULL. */
void bd_put(bd_unit *u, u32 place, const void *from, size_t bytes);
void bd_get(bd_unit *u, u32 place, void *to, size_t bytes);
/* A text that ends with 0, cut to what fits in `most` bytes; 0 for NULL. */
u32 bd_put_text(bd_unit *u, u32 place, const char *text, size_t most);
/* A list of short texts, as pointers to them; 0 for NULL. */
u32 bd_put_texts(bd_unit *u, const char *const texts[], size_t count);
/* The host's pointer to something in the library's memory, and back; 0 and NULL go together. A pointer into the memory of another
   instance becomes 1, which is no place that the library takes. */
void *bd_to_host(bd_unit *u, u32 place);
u32 bd_from_host(bd_unit *u, const void *pointer);

/* Passes on the messages of a call, and returns its status. */
fmi2Status bd_ended(bd_unit *u, u32 status);
/* The same after a trap: the instance is dead. */
fmi2Status bd_died(bd_unit *u, int reason);

BD_SEEN

#endif
