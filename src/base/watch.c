/* base/watch.c - long work tells how far it is, and is told to stop. */
/* SPDX-License-Identifier: MIT */
#include "base/watch.h"

void watch_begin(struct watch *watch, const char *unit, size_t total)
{
    if (watch == NULL) {
        return;
    }
    watch->unit = unit;
    watch->total = total;
    watch->tell = NULL;
    atomic_store(&watch->done, 0);
    atomic_store(&watch->next, 1);
}

void watch_tell(struct watch *watch, void (*tell)(const void *context, char *words, size_t room),
                const void *context)
{
    if (watch != NULL) {
        watch->tell = tell;
        watch->told_of = context;
    }
}

static bool is_time(struct watch *watch)
{
    return atomic_load(&watch->done) >= atomic_load(&watch->next);
}

/* Unless another thread does; where `always` is false only if it still is time: another thread may
   have looked since that was asked. */
static void watch_look(struct watch *watch, bool always)
{
    if (!atomic_flag_test_and_set(&watch->is_busy)) {
        if (always || is_time(watch)) {
            watch->look(watch);
        }
        atomic_flag_clear(&watch->is_busy);
    }
}

bool watch_add(struct watch *watch, size_t more)
{
    if (watch == NULL) {
        return true;
    }
    atomic_fetch_add(&watch->done, more);
    if (is_time(watch)) {
        watch_look(watch, false);
    }
    return !atomic_load(&watch->is_ended);
}

bool watch_ask(struct watch *watch)
{
    if (watch != NULL) {
        watch_look(watch, true);
    }
    return !watch_is_ended(watch);
}

bool watch_is_ended(struct watch *watch)
{
    return watch != NULL && atomic_load(&watch->is_ended);
}
