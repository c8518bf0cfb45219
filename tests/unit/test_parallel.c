/* tests/unit/test_parallel.c - loops on several threads, each with its arena. */
/* SPDX-License-Identifier: MIT */
#include "base/parallel.h"
#include "base/watch.h"
#include "check.h"

#include <string.h>

enum { ITEMS = 1000 };

struct job {
    int seen[ITEMS];
    const char *texts[ITEMS];
    size_t piece_of[ITEMS];
};

/* Each item once, in its piece; what is kept in the arenas lives on. */
static void work(void *context, const struct parallel_piece *piece)
{
    struct job *job = context;
    for (size_t i = piece->begin; i < piece->end; i++) {
        job->seen[i]++;
        job->piece_of[i] = piece->number;
        job->texts[i] = arena_printf(piece->arena, "item %zu", i);
    }
}

static void check_loop(int threads, size_t count, size_t piece)
{
    struct arena arena = {0};
    struct parallel *parallel = ARENA_NEW(&arena, struct parallel);
    struct job *job = ARENA_NEW(&arena, struct job);
    size_t wrong = 0;
    parallel->threads = threads;
    parallel_pieces(parallel, count, piece, work, job);
    for (size_t i = 0; i < ITEMS; i++) {
        char text[30];
        snprintf(text, sizeof text, "item %zu", i);
        wrong += i < count ? job->seen[i] != 1 || job->piece_of[i] != i / piece ||
                                 strcmp(job->texts[i], text) != 0
                           : job->seen[i] != 0;
    }
    CHECK(wrong == 0);
    parallel_free(parallel);
    arena_free(&arena);
}

/* What was adopted lives until the arena goes back; both arenas can be used as before. */
static void check_adopted(void)
{
    struct arena arena = {0}, other = {0};
    const char *early = arena_printf(&arena, "early");
    const struct arena_mark mark = arena_mark(&arena);
    const char *large = memset(arena_array(&other, 1000000, 1), 'x', 999999);
    const char *adopted = arena_printf(&other, "adopted");
    arena_adopt(&arena, &other);
    CHECK(other.block == NULL && other.spare == NULL);
    arena_adopt(&arena, &other);
    const char *late = arena_printf(&arena, "late");
    const char *again = arena_printf(&other, "again");
    CHECK(strcmp(early, "early") == 0 && strcmp(adopted, "adopted") == 0 &&
          strlen(large) == 999999);
    CHECK(strcmp(late, "late") == 0 && strcmp(again, "again") == 0);
    arena_reset(&arena, mark);
    CHECK(strcmp(early, "early") == 0 && arena.block == mark.block);
    arena_free(&arena);
    arena_adopt(&arena, &other);
    CHECK(strcmp(again, "again") == 0);
    arena_free(&arena);
}

static void add(void *context, size_t begin, size_t end)
{
    int *seen = context;
    for (size_t i = begin; i < end; i++) {
        seen[i]++;
    }
}

static void check_plain(int threads)
{
    int seen[ITEMS] = {0}, wrong = 0;
    parallel_for(threads, ITEMS, 7, add, seen);
    for (size_t i = 0; i < ITEMS; i++) {
        wrong += seen[i] != 1;
    }
    CHECK(wrong == 0);
}

/* Who looks: how often, whether ever two at once, and when to end. */
struct looker {
    atomic_int looking;
    int looks, together;
    size_t every, ends_at;
};

static void look(struct watch *watch)
{
    struct looker *looker = watch->looker;
    looker->together += atomic_fetch_add(&looker->looking, 1) > 0;
    looker->looks++;
    atomic_store(&watch->next, atomic_load(&watch->done) + looker->every);
    if (atomic_load(&watch->done) >= looker->ends_at) {
        atomic_store(&watch->is_ended, true);
    }
    atomic_fetch_sub(&looker->looking, 1);
}

static void watched(void *context, size_t begin, size_t end)
{
    struct watch *watch = context;
    for (size_t i = begin; i < end && !watch_is_ended(watch); i++) {
        watch_add(watch, 1);
    }
}

/* All items are counted, by one look at a time; work that is to end does so soon. Others go on
   while who looks is kept from its processor: only one thread's count is known. */
static void check_watch(int threads)
{
    struct looker looker = {.every = 100, .ends_at = 10 * ITEMS};
    struct watch watch = {.is_busy = ATOMIC_FLAG_INIT, .look = look, .looker = &looker};
    watch_begin(&watch, "items", 5 * ITEMS);
    parallel_for(threads, 5 * ITEMS, 7, watched, &watch);
    CHECK(atomic_load(&watch.done) == 5 * ITEMS && looker.together == 0);
    CHECK(looker.looks > (threads == 1) && looker.looks <= 5 * ITEMS / 100 + 1);
    looker.ends_at = 500;
    watch_begin(&watch, "items", 0);
    parallel_for(threads, 5 * ITEMS, 7, watched, &watch);
    CHECK(atomic_load(&watch.done) >= 500 && (atomic_load(&watch.done) < 600 || threads > 1));
    CHECK(!watch_add(&watch, 1) && watch_is_ended(&watch));
    watch_begin(NULL, "items", 0);
    CHECK(watch_add(NULL, 1) && !watch_is_ended(NULL)); /* nobody looks */
}

int main(void)
{
    check_adopted();
    check_watch(1);
    check_watch(2);
    static const int threads[] = {0, 1, 2, 3, 16, PARALLEL_MOST, 1000};
    for (size_t i = 0; i < sizeof threads / sizeof threads[0]; i++) {
        check_loop(threads[i], ITEMS, 1);
        check_loop(threads[i], ITEMS, 7);
        check_loop(threads[i], ITEMS, 5000);
        check_loop(threads[i], 3, 1);
        check_loop(threads[i], 0, 1);
        check_plain(threads[i]);
    }
    CHECK(parallel_threads(3) == 3);
    CHECK(parallel_threads(1000) == PARALLEL_MOST);
    CHECK(parallel_threads(0) >= 1);
    return check_report();
}
