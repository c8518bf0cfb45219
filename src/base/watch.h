/* base/watch.h - long work tells how far it is, and is told to stop. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_BASE_WATCH_H
#define LENSCALC_BASE_WATCH_H

#include <stdatomic.h>
#include <stdbool.h>
#include <stddef.h>

/*
 * Somebody who looks at long work now and then. Who starts the work sets the first three members,
 * who looks the others; work without anybody gets a null pointer.
 */
struct watch {
    const char *unit; /* what is counted: "rays", "files" */
    size_t total;     /* so many in all; 0 = nobody knows */
    atomic_size_t done;
    atomic_size_t next;   /* look when so many are done */
    atomic_flag is_busy;  /* a thread is looking */
    atomic_bool is_ended; /* the work is to stop */
    /* Called from one thread at a time; sets `next`, may set is_ended. Where it is not yet time
       to look, neither by `next` nor by the clock, it may leave both. */
    void (*look)(struct watch *watch);
    void *looker; /* its own */
    /* What else is to be said of the work now, into words of so much room; from any thread. Or
       null */
    void (*tell)(const void *context, char *words, size_t room);
    const void *told_of; /* its context */
};

/* Begin to count; there is nothing else to be said. */
void watch_begin(struct watch *watch, const char *unit, size_t total);

/* Say something else too, until something else is counted. Before the work begins. */
void watch_tell(struct watch *watch, void (*tell)(const void *context, char *words, size_t room),
                const void *context);

/*
 * So many more are done. From any thread; worth it every 50 us or so.
 *
 * Result    false: stop, and say that the result is incomplete
 */
bool watch_add(struct watch *watch, size_t more);

/*
 * Look, however much is done: within an item that takes long. From any thread; worth it every 200
 * us or so.
 *
 * Result    as watch_add
 */
bool watch_ask(struct watch *watch);

/* Is the work to stop? */
bool watch_is_ended(struct watch *watch);

#endif
