/* Instances of the unit, and the data passed between their machines and the host. */

#include "bd_unit.h"

static bd_unit units[BD_INSTANCES];

static void append(char *text, size_t most, const char *more) {
    size_t length = strlen(text);
    while (*more && length + 1 < most) text[length++] = *more++;
    text[length] = 0;
}

/* messages contain no conversions, so each one is a format for printf that prints itself */
static void say(const bd_unit *u, fmi2Status status, const char *category, const char *text) {
    if (u->logger) u->logger(u->environment, u->name, status, category, text);
}

static bd_unit *refused(const fmi2CallbackFunctions *functions, fmi2String name, const char *text) {
    if (functions && functions->logger) functions->logger(functions->componentEnvironment, name ? name : "", fmi2Error, "logStatusError", text);
    return 0;
}

bd_unit *bd_take(const fmi2CallbackFunctions *functions, fmi2String name) {
    const char *differs = bd_arithmetic_differs();
    bd_unit *u = units;
    if (differs) return refused(functions, name, differs);
    while (u < units + BD_INSTANCES && u->is_used) ++u;
    if (u == units + BD_INSTANCES)
        return refused(functions, name, "all instances are in use; compile the sources with a larger BD_INSTANCES for more");
    u->logger = functions ? functions->logger : 0;
    u->environment = functions ? functions->componentEnvironment : 0;
    u->name[0] = 0;
    append(u->name, sizeof u->name, name ? name : "");
    u->is_used = 1;
    u->is_dead = 0;
    u->component = 0;
    bd_start(&u->machine);
    return u;
}

u32 bd_room(bd_unit *u, size_t bytes) {
    /* more than memory holds is a separate trap */
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

fmi2Status bd_ended(bd_unit *u, u32 status) {
    const u32 count = bd_room(u, sizeof(u32)), first = bd_source_messages_0(&u->machine, count);
    u32 bytes = i32_load(&u->machine, count, 0), at = first;
    const char *memory = (const char *)u->machine.memory.bytes;
    while (at < first + bytes) {
        const char *category = memory + at + 1, *text = category + strlen(category) + 1;
        say(u, (fmi2Status)i32_load8_u(&u->machine, at, 0), category, text);
        at = (u32)(text + strlen(text) + 1 - memory);
    }
    return (fmi2Status)status;
}

fmi2Status bd_died(bd_unit *u, int reason) {
    static const char *const reasons[] = {"", "the library stopped itself", "access outside of its memory", "division by zero", "call of no function"};
    char text[768] = "internal error, please report: ";
    u->is_dead = 1;
    append(text, sizeof text, reasons[reason]);
    /* the library's own message, unless the library is so damaged that it cannot return its position */
    reason = setjmp(u->machine.home);
    if (!reason) {
        const char *words = (const char *)u->machine.memory.bytes + bd_source_reason_0(&u->machine);
        append(text, sizeof text, *words ? ": " : "");
        append(text, sizeof text, words);
    }
    append(text, sizeof text, "; this instance is lost, the others still work");
    say(u, fmi2Fatal, "logStatusError", text);
    return fmi2Fatal;
}
