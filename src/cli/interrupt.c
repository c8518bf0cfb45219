/* cli/interrupt.c - Ctrl-C ends long work with what there is, a second one ends the program. */
/* SPDX-License-Identifier: MIT */
#include "cli/interrupt.h"

#include <errno.h>
#include <pthread.h>
#include <semaphore.h>
#include <signal.h>
#include <stdatomic.h>
#include <stddef.h>
#include <time.h>
#include <unistd.h>

/* What work gets to notice a signal: so long, of which so much in processors; on a machine that
   others use, too, up to the most. Work that has noticed gets as long as files may take. s */
static const double time_least = 0.5, busy_least = 0.5, time_most = 8, noticed_most = 30;

/* C has no other way for a signal's handler to tell anybody: 0, or which (C17 7.14.1.1). */
static atomic_int came;
static sem_t arrived;

/* Of the one thread that looks after it. */
static struct watcher {
    bool is_there;
    interrupt_break_off *break_off;
    void *context;
} watcher;
static atomic_bool is_noticed;

/* Even: the answer is held by who writes it; odd: it is released. Rows come by the million, so that
   a lock would be felt: see answer_take. */
static atomic_uint phase;
static atomic_bool is_taken;

static void interrupt_note(int signal)
{
    const int before = errno;
    atomic_store(&came, signal);
    sem_post(&arrived);
    errno = before;
}

/* s */
static double clock_of(clockid_t which)
{
    struct timespec time;
    clock_gettime(which, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

static void sleep_for(long milliseconds)
{
    const struct timespec time = {0, milliseconds * 1000 * 1000};
    nanosleep(&time, NULL);
}

/*
 * Take the answer from where it is released: say so, and look whether it stays so while what either
 * thread has written reaches the other, which takes less than a microsecond. False: it is held for
 * a second, as where nobody reads it.
 */
static bool answer_take(void)
{
    enum { ATTEMPTS = 50 };
    for (int i = 0; i < ATTEMPTS; i++) {
        const unsigned before = atomic_load(&phase);
        atomic_store(&is_taken, before % 2 == 1);
        sleep_for(20);
        if (before % 2 == 1 && atomic_load(&phase) == before) {
            return true;
        }
        atomic_store(&is_taken, false);
    }
    return false;
}

static void *end_work(void *argument)
{
    const struct watcher *own = argument;
    while (sem_wait(&arrived) != 0) {
    }
    /* until the work has had its time */
    const double began = clock_of(CLOCK_MONOTONIC), before = clock_of(CLOCK_PROCESS_CPUTIME_ID);
    for (bool is_over = false; !is_over;) {
        sleep_for(20);
        const double time = clock_of(CLOCK_MONOTONIC) - began;
        const double busy = clock_of(CLOCK_PROCESS_CPUTIME_ID) - before;
        is_over = atomic_load(&is_noticed)
                      ? time > noticed_most
                      : time > time_most || (time > time_least && busy > busy_least);
    }
    if (answer_take()) {
        own->break_off(own->context);
    }
    signal(atomic_load(&came), SIG_DFL);
    kill(getpid(), atomic_load(&came));
    return NULL;
}

void interrupt_watch(interrupt_break_off *break_off, void *context)
{
    static const int signals[] = {SIGINT, SIGTERM};
    if (watcher.is_there) { /* a second command of the same process */
        watcher = (struct watcher){true, break_off, context};
        return;
    }
    watcher = (struct watcher){true, break_off, context};
    /* signals are for the others: system calls of these return */
    pthread_t thread;
    sigset_t all, before;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before);
    watcher.is_there = sem_init(&arrived, 0, 0) == 0 &&
                       pthread_create(&thread, NULL, end_work, &watcher) == 0 &&
                       pthread_detach(thread) == 0;
    pthread_sigmask(SIG_SETMASK, &before, NULL);
    for (size_t i = 0; i < sizeof signals / sizeof signals[0]; i++) {
        struct sigaction old,
            action = {.sa_handler = interrupt_note, .sa_flags = (int)SA_RESETHAND};
        sigemptyset(&action.sa_mask);
        if (sigaction(signals[i], &action, &old) == 0 && old.sa_handler == SIG_IGN) {
            sigaction(signals[i], &old, NULL);
        }
    }
}

/* One thread alone writes it. */
static void phase_next(void)
{
    const unsigned now = atomic_load_explicit(&phase, memory_order_relaxed);
    atomic_store_explicit(&phase, now + 1, memory_order_release);
}

void interrupt_release(void)
{
    if (watcher.is_there) {
        phase_next();
    }
}

void interrupt_hold(void)
{
    if (watcher.is_there) {
        phase_next();
        while (atomic_load_explicit(&is_taken, memory_order_acquire)) {
            sleep_for(1); /* until the program has ended */
        }
    }
}

bool interrupt_came(void)
{
    const bool is_there = atomic_load(&came) != 0;
    if (is_there) {
        atomic_store(&is_noticed, true);
    }
    return is_there;
}

bool interrupt_fail(struct error *error)
{
    return fail(error, ERROR_DOMAIN, "interrupted: what would follow is missing");
}
