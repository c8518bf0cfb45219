/* base/parallel.c - threads that take pieces of a loop until none is left. */
/* SPDX-License-Identifier: MIT */
#include "base/parallel.h"

#include <pthread.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdlib.h>
#include <unistd.h>

struct loop {
    parallel_work *work;
    void *context;
    size_t count, piece;
    atomic_size_t next;
};

/* What one thread knows. */
struct parallel_worker {
    struct loop *loop;
    size_t thread;
    struct arena *arena;
};

static void *take_pieces(void *argument)
{
    const struct parallel_worker *worker = argument;
    struct loop *loop = worker->loop;
    for (;;) {
        size_t begin = atomic_fetch_add(&loop->next, loop->piece);
        if (begin >= loop->count) {
            return NULL;
        }
        size_t left = loop->count - begin;
        const struct parallel_piece piece = {.begin = begin,
                                             .end =
                                                 begin + (left < loop->piece ? left : loop->piece),
                                             .number = begin / loop->piece,
                                             .thread = worker->thread,
                                             .arena = worker->arena};
        loop->work(loop->context, &piece);
    }
}

/* bytes of a thread's work that are looked after, of so many threads */
enum { ROOM = 16 * 1024 * 1024, MOST_ROOMS = 4 };

/* `arenas` is null where the work needs none. */
static void parallel_run(int threads, struct loop *loop, struct arena *arenas)
{
    pthread_t others[PARALLEL_MOST];
    struct parallel_worker workers[PARALLEL_MOST];
    size_t pieces = loop->count / loop->piece + (loop->count % loop->piece != 0), started = 0;
    size_t most = threads > 1 ? (size_t)threads : 1;
    most = most < PARALLEL_MOST ? most : PARALLEL_MOST;
    for (size_t i = 0; i < most; i++) {
        workers[i] = (struct parallel_worker){loop, i, arenas != NULL ? &arenas[i] : NULL};
    }
    for (size_t i = 1; i < most && i < pieces; i++) {
        /*
         * A thread starts where memory is left for the work of all that then there are, up to 16
         * MiB each, 64 MiB in all: so much its stack does not take from the others. Bigger work may
         * still want for memory.
         */
        const size_t count = started + 2;
        /* never touched, so that it costs next to nothing; volatile, so that it is asked for */
        void *volatile room = malloc((count < MOST_ROOMS ? count : MOST_ROOMS) * ROOM);
        const bool done =
            room != NULL && pthread_create(&others[started], NULL, take_pieces, &workers[i]) == 0;
        free(room);
        started += done;
    }
    take_pieces(&workers[0]);
    for (size_t i = 0; i < started; i++) {
        pthread_join(others[i], NULL);
    }
}

/* A loop that needs neither arenas nor numbers. */
struct plain {
    parallel_function *function;
    void *context;
};

static void call_function(void *context, const struct parallel_piece *piece)
{
    const struct plain *plain = context;
    plain->function(plain->context, piece->begin, piece->end);
}

void parallel_for(int threads, size_t count, size_t piece, parallel_function *function,
                  void *context)
{
    struct plain plain = {function, context};
    struct loop loop = {.work = call_function, .context = &plain, .count = count, .piece = piece};
    parallel_run(threads, &loop, NULL);
}

/* macOS and the BSDs hide the number where POSIX of 2008 is asked for, which lacks it: then one. */
static long processors_online(void)
{
#ifdef _SC_NPROCESSORS_ONLN
    return sysconf(_SC_NPROCESSORS_ONLN);
#else
    return 1;
#endif
}

int parallel_threads(long asked)
{
    long cores = asked > 0 ? asked : processors_online();
    if (cores < 1) {
        return 1;
    }
    if (cores > PARALLEL_MOST) {
        return PARALLEL_MOST;
    }
    return (int)cores;
}

void parallel_pieces(struct parallel *parallel, size_t count, size_t piece, parallel_work *work,
                     void *context)
{
    struct loop loop = {.work = work, .context = context, .count = count, .piece = piece};
    parallel_run(parallel->threads, &loop, parallel->arenas);
}

void parallel_free(struct parallel *parallel)
{
    for (size_t i = 0; i < PARALLEL_MOST; i++) {
        arena_free(&parallel->arenas[i]);
    }
}
