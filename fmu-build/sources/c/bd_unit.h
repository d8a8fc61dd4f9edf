/* Instances of the unit: each has a machine of its own that runs the library. What both versions of FMI share. */

#ifndef BD_UNIT_H
#define BD_UNIT_H

#include "bd_library.h"

BD_HIDDEN

/* Instances that a program may have at once. */
#ifndef BD_INSTANCES
#define BD_INSTANCES 4
#endif

enum { BD_OK, BD_WARNING, BD_DISCARD, BD_ERROR, BD_FATAL };

/* Who made an instance: its function for messages, NULL if there is none, and how this version of FMI calls that. */
typedef struct bd_host {
    void (*logger)(void);
    void *environment;
    void (*log)(const struct bd_host *host, int status, const char *category, const char *text);
    char name[128];
} bd_host;

typedef struct bd_unit {
    bd machine;
    bd_host host;
    int is_used, is_dead;
    /* the instance within the library */
    u32 component;
} bd_unit;

void bd_say(const bd_host *host, int status, const char *category, const char *text);
/* An instance that no host has, with the library at its start; NULL where there is none, which is said. */
bd_unit *bd_take(const bd_host *host, const char *name);
void bd_give_back(bd_unit *u);

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
int bd_ended(bd_unit *u, u32 status);
/* The same after a trap: the instance is dead. */
int bd_died(bd_unit *u, int reason);

/* States, which lie in the memory of the instance that they belong to: the host's pointers point there. `call` is the function of the
   library, whose name depends on the version of FMI. Each returns the status of the call. */
typedef u32 bd_state_call(bd *, u32, u32);
typedef u32 bd_size_call(bd *, u32, u32, u32);
typedef u32 bd_bytes_call(bd *, u32, u32, u32, u32);
int bd_get_or_free_state(bd_unit *u, bd_state_call *call, void **state);
int bd_size_of_state(bd_unit *u, bd_size_call *call, const void *state, size_t *size);
int bd_serialize_state(bd_unit *u, bd_bytes_call *call, const void *state, void *bytes, size_t size);
int bd_deserialize_state(bd_unit *u, bd_bytes_call *call, const void *bytes, size_t size, void **state);

/* The begin of every call: `u` is the instance of the component `c`. A trap returns from the function that this stands in. */
#define BD_BEGIN(c, status) \
    bd_unit *const u = (bd_unit *)(c); \
    int bd_reason; \
    if (!u || !u->is_used) return (status)BD_ERROR; \
    if (u->is_dead) return (status)BD_FATAL; \
    bd_reason = setjmp(u->machine.home); \
    if (bd_reason) return (status)bd_died(u, bd_reason)

BD_SEEN

#endif
