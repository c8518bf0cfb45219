/* cli/progress.c - how far long work is, on a terminal, and whether it shall go on. */
/* SPDX-License-Identifier: MIT */
#include "cli/progress.h"

#include "cli/interrupt.h"
#include "report/terminal.h"

#include <math.h>
#include <stdio.h>
#include <time.h>
#include <unistd.h>

/* s */
static const double first_after = 0.5, shown_every = 0.1, looked_every = 0.02;

enum { LINE = 200, MOST_BETWEEN = 1 << 24 };

double progress_clock(void)
{
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

/* Twice as many until the next look if this one came soon, half as many if it came late. */
static size_t adapted(size_t every, double elapsed)
{
    if (elapsed < looked_every) {
        return every < MOST_BETWEEN ? 2 * every : every;
    }
    return elapsed > 2 * looked_every && every > 1 ? every / 2 : every;
}

/* Rows, or what one row that takes long counts. */
static void progress_show(struct progress *progress, double time)
{
    const struct progress_state state = progress->state(progress->context);
    struct watch *watch = &progress->watch;
    const size_t watched = atomic_load(&watch->done);
    const bool is_one = isnan(state.share) && state.rows <= 1 && watch->unit != NULL;
    const double done = (double)(is_one ? watched : state.rows), elapsed = time - progress->started;
    const char *unit = is_one ? watch->unit : "rows";
    double share = state.share;
    if (is_one) {
        share = watch->total > 0 ? done / (double)watch->total : NAN;
    }
    char line[LINE];
    int used = snprintf(line, sizeof line, "lenscalc %s: %.0f %s", progress->command, done, unit);
    if (share >= 0 && share <= 1) {
        used += snprintf(line + used, LINE - (size_t)used, "  %.0f %%", 100 * share);
    }
    if (is_one && watch->tell != NULL) {
        char words[LINE / 2] = "";
        watch->tell(watch->told_of, words, sizeof words);
        used += snprintf(line + used, LINE - (size_t)used, "  %s", words);
    }
    /* "2.1 M rays/s" */
    double rate = done / elapsed;
    static const char *const prefixes[] = {"", "k ", "M ", "G "};
    size_t i = 0;
    for (; rate >= 1000 && i < 3; i++) {
        rate /= 1000;
    }
    int decimals = rate < 10 ? 1 : 0;
    used += snprintf(line + used, LINE - (size_t)used, "  %.*f %s%s/s", decimals, rate, prefixes[i],
                     unit);
    size_t width = terminal_width(STDERR_FILENO);
    size_t length = (size_t)used < width ? (size_t)used : width - 1;
    size_t behind = progress->width > length ? progress->width - length : 0;
    fprintf(stderr, "\r%.*s%*s", (int)length, line, (int)behind, "");
    progress->width = length + behind;
    progress->shown = time;
}

void progress_look(struct progress *progress)
{
    double time = progress_clock();
    progress->every = adapted(progress->every, time - progress->looked);
    progress->until = progress->every;
    progress->looked = time;
    const bool is_due =
        time - progress->started > first_after && time - progress->shown > shown_every;
    if (is_due && progress->terminal == PROGRESS_UNKNOWN) {
        progress->terminal = isatty(STDERR_FILENO) ? PROGRESS_SEEN : PROGRESS_UNSEEN;
        progress->is_shared = isatty(STDOUT_FILENO) != 0;
    }
    if (is_due && progress->terminal == PROGRESS_SEEN) {
        progress_show(progress, time);
    }
    atomic_store(&progress->watch.is_ended, interrupt_came());
}

/* A look out of the work on one row. */
static void look_inside(struct watch *watch)
{
    struct progress *progress = watch->looker;
    const double elapsed = progress_clock() - progress->looked;
    if (atomic_load(&watch->done) < atomic_load(&watch->next) && elapsed < looked_every) {
        return;
    }
    progress->watched = adapted(progress->watched, elapsed);
    atomic_store(&watch->next, atomic_load(&watch->done) + progress->watched);
    size_t until = progress->until, every = progress->every;
    progress_look(progress);
    progress->until = until; /* no row has come */
    progress->every = every;
}

void progress_begin(struct progress *progress, const char *command,
                    struct progress_state (*state)(const void *context), const void *context)
{
    double time = progress_clock();
    *progress = (struct progress){
        .until = 1,
        .every = 1,
        .started = time,
        .looked = time,
        .watched = 1,
        .command = command,
        .state = state,
        .context = context,
        .watch = {.is_busy = ATOMIC_FLAG_INIT, .look = look_inside, .looker = progress}};
}

void progress_erase(struct progress *progress)
{
    if (progress->width > 0) {
        fprintf(stderr, "\r%*s\r", (int)progress->width, "");
        progress->width = 0;
    }
}

void progress_make_way(void *context)
{
    struct progress *progress = context;
    if (progress->is_shared) {
        progress_erase(progress);
    }
}
