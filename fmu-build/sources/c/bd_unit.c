/* Instances of the unit, and what passes between their machines and the host. */

#include "bd_unit.h"

static bd_unit units[BD_INSTANCES];

static void append(char *text, size_t most, const char *more) {
    size_t length = strlen(text);
    while (*more && length + 1 < most) text[length++] = *more++;
    text[length] = 0;
}

void bd_say(const bd_host *host, int status, const char *category, const char *text) {
    if (host->logger) host->log(host, status, category, text);
}

bd_unit *bd_take(const bd_host *host, const char *name) {
    const char *differs = bd_arithmetic_differs();
    bd_unit *u = 0;
    int k;
    if (differs) {
        bd_say(host, BD_ERROR, "logStatusError", differs);
        return 0;
    }
    for (k = 0; k < BD_INSTANCES && !u; ++k)
        if (!units[k].is_used) u = &units[k];
    if (!u) {
        bd_say(host, BD_ERROR, "logStatusError", "all instances are in use; compile the sources with a larger BD_INSTANCES for more");
        return 0;
    }
    u->host = *host;
    u->host.name[0] = 0;
    append(u->host.name, sizeof u->host.name, name ? name : "");
    u->is_used = 1;
    u->is_dead = 0;
    u->component = 0;
    bd_start(&u->machine);
    return u;
}

void bd_give_back(bd_unit *u) { u->is_used = 0; }

u32 bd_room(bd_unit *u, size_t bytes) {
    /* more than memory holds is a trap of its own */
    if (bytes > BD_MEMORY) bd_trap(&u->machine, BD_OUT_OF_BOUNDS);
    return bd_source_room_0(&u->machine, (u32)bytes);
}

void bd_put(bd_unit *u, u32 place, const void *from, size_t bytes) {
    if (from && bytes) memcpy(bd_at(&u->machine, place, 0, (u32)bytes), from, bytes);
}

void bd_get(bd_unit *u, u32 place, void *to, size_t bytes) {
    if (to && bytes) memcpy(to, bd_at(&u->machine, place, 0, (u32)bytes), bytes);
}

u32 bd_put_text(bd_unit *u, u32 place, const char *text, size_t most) {
    size_t length = 0;
    if (!text) return 0;
    while (length + 1 < most && text[length]) ++length;
    bd_put(u, place, text, length);
    i32_store8(&u->machine, place + (u32)length, 0, 0);
    return place;
}

u32 bd_put_texts(bd_unit *u, const char *const texts[], size_t count) {
    enum { MOST = 64 };
    const u32 list = bd_room(u, count * (sizeof(u32) + MOST)), first = list + (u32)(count * sizeof(u32));
    size_t k;
    for (k = 0; texts && k < count; ++k)
        i32_store(&u->machine, list, (u32)(k * sizeof(u32)), bd_put_text(u, first + (u32)(k * MOST), texts[k], MOST));
    return texts ? list : 0;
}

void *bd_to_host(bd_unit *u, u32 place) { return place ? u->machine.memory.bytes + place : 0; }

u32 bd_from_host(bd_unit *u, const void *pointer) {
    const uintptr_t at = (uintptr_t)pointer, memory = (uintptr_t)u->machine.memory.bytes;
    if (!pointer) return 0;
    return at > memory && at - memory < BD_MEMORY ? (u32)(at - memory) : 1;
}

/* A pointer to a state, in the library's memory and then the host's. */
static void put_state(bd_unit *u, u32 place, void *const *state) {
    if (state) i32_store(&u->machine, place, 0, bd_from_host(u, *state));
}
static void get_state(bd_unit *u, u32 place, u32 status, void **state) {
    if (state && status <= BD_WARNING) *state = bd_to_host(u, i32_load(&u->machine, place, 0));
}

int bd_get_or_free_state(bd_unit *u, bd_state_call *call, void **state) {
    const u32 room = bd_room(u, sizeof(u32));
    u32 status;
    put_state(u, room, state);
    status = call(&u->machine, u->component, state ? room : 0);
    get_state(u, room, status, state);
    return bd_ended(u, status);
}

int bd_size_of_state(bd_unit *u, bd_size_call *call, const void *state, size_t *size) {
    const u32 room = bd_room(u, sizeof(u32)), status = call(&u->machine, u->component, bd_from_host(u, state), size ? room : 0);
    if (size && status <= BD_WARNING) *size = i32_load(&u->machine, room, 0);
    return bd_ended(u, status);
}

int bd_serialize_state(bd_unit *u, bd_bytes_call *call, const void *state, void *bytes, size_t size) {
    const u32 room = bd_room(u, size), status = call(&u->machine, u->component, bd_from_host(u, state), bytes ? room : 0, (u32)size);
    if (status <= BD_WARNING) bd_get(u, room, bytes, size);
    return bd_ended(u, status);
}

int bd_deserialize_state(bd_unit *u, bd_bytes_call *call, const void *bytes, size_t size, void **state) {
    const u32 room = bd_room(u, sizeof(u64) + size);
    u32 status;
    bd_put(u, room + 8, bytes, size);
    put_state(u, room, state);
    status = call(&u->machine, u->component, bytes ? room + 8 : 0, (u32)size, state ? room : 0);
    get_state(u, room, status, state);
    return bd_ended(u, status);
}

int bd_ended(bd_unit *u, u32 status) {
    const u32 count = bd_room(u, sizeof(u32)), first = bd_source_messages_0(&u->machine, count);
    u32 bytes = i32_load(&u->machine, count, 0), at = first;
    const char *memory = (const char *)u->machine.memory.bytes;
    while (at < first + bytes) {
        const char *category = memory + at + 1, *text = category + strlen(category) + 1;
        bd_say(&u->host, (int)i32_load8_u(&u->machine, at, 0), category, text);
        at = (u32)(text + strlen(text) + 1 - memory);
    }
    return (int)status;
}

int bd_died(bd_unit *u, int reason) {
    static const char *const reasons[] = {"", "the library stopped itself", "access outside of its memory", "division by zero", "call of no function"};
    char text[768] = "internal error, please report: ";
    u->is_dead = 1;
    append(text, sizeof text, reasons[reason]);
    /* the library's own words, unless it is so broken that it cannot even say where they are */
    reason = setjmp(u->machine.home);
    if (!reason) {
        const char *words = (const char *)u->machine.memory.bytes + bd_source_reason_0(&u->machine);
        append(text, sizeof text, *words ? ": " : "");
        append(text, sizeof text, words);
    }
    append(text, sizeof text, "; this instance is lost, others live on");
    bd_say(&u->host, BD_FATAL, "logStatusError", text);
    return BD_FATAL;
}
