/* base/parallel.c - threads that take pieces of a loop until none is left. */
/* SPDX-License-Identifier: MIT */
#include "base/parallel.h"

#include <pthread.h>
#include <stdatomic.h>

struct loop {
    parallel_function *function;
    void *context;
    size_t count, piece;
    atomic_size_t next;
};

static void *take_pieces(void *argument)
{
    struct loop *loop = argument;
    for (;;) {
        size_t begin = atomic_fetch_add(&loop->next, loop->piece);
        if (begin >= loop->count) {
            return NULL;
        }
        size_t left = loop->count - begin;
        loop->function(loop->context, begin, begin + (left < loop->piece ? left : loop->piece));
    }
}

void parallel_for(int threads, size_t count, size_t piece, parallel_function *function,
                  void *context)
{
    struct loop loop = {.function = function, .context = context, .count = count, .piece = piece};
    pthread_t others[PARALLEL_MOST];
    size_t pieces = count / piece + (count % piece != 0), started = 0;
    int most = threads > PARALLEL_MOST ? PARALLEL_MOST : threads;
    for (int i = 1; i < most && (size_t)i < pieces; i++) {
        if (pthread_create(&others[started], NULL, take_pieces, &loop) == 0) {
            started++;
        }
    }
    take_pieces(&loop);
    for (size_t i = 0; i < started; i++) {
        pthread_join(others[i], NULL);
    }
}
