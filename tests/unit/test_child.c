/* tests/unit/test_child.c - other programs: what they print, how they end, and that they end. */
/* SPDX-License-Identifier: MIT */
#include "cli/child.h"

#include "check.h"

#include <signal.h>
#include <time.h>

static double elapsed(const struct timespec *since)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)(now.tv_sec - since->tv_sec) + 1e-9 * (double)(now.tv_nsec - since->tv_nsec);
}

static bool shell(const char *script, double seconds, size_t most, struct child_end *end,
                  struct arena *arena)
{
    char *const words[] = {(char *)"sh", (char *)"-c", (char *)script, NULL};
    const struct child child = {.words = words, .is_read = true, .seconds = seconds, .most = most};
    struct error error = {0};
    return child_run(&child, end, arena, &error);
}

static void test_output(struct arena *arena)
{
    struct child_end end;
    CHECK(
        shell("cat; printf 'a\\nb'; echo said >&2; echo more >&2; exit 3", 60, 1000, &end, arena));
    CHECK(text_equal(end.output, "a\nb") && text_equal(end.said, "said"));
    CHECK(strcmp(child_status(&end, arena), "status 3") == 0 && !end.is_late && !end.is_missing);
    CHECK(shell("kill -15 $$", 60, 1000, &end, arena));
    CHECK(strcmp(child_status(&end, arena), "signal 15") == 0 && end.output.length == 0);
    /* more than a pipe holds, on both streams */
    CHECK(
        shell("head -c 300000 /dev/zero; head -c 300000 /dev/zero >&2", 60, 1000000, &end, arena));
    CHECK(end.output.length == 300000 && end.status == 0 && !end.is_long);
    CHECK(shell("yes", 60, 100000, &end, arena));
    CHECK(end.is_long && !end.is_late);
}

static void test_missing(struct arena *arena)
{
    char *const none[] = {(char *)"lenscalc-no-such-program", NULL};
    char *const folder[] = {(char *)"/", NULL};
    struct child_end end;
    struct error error = {0};
    struct child child = {.words = none, .is_read = true, .seconds = 60, .most = 100};
    CHECK(child_run(&child, &end, arena, &error) && end.is_missing);
    child.words = folder;
    CHECK(!child_run(&child, &end, arena, &error) && error.code == ERROR_IO);
    child = (struct child){.words = none};
    CHECK(!child_run(&child, &end, arena, &error) && error.code == ERROR_IO);
}

/* Late ones are ended with all that they started, though they have closed what is read of them. */
static void test_late(struct arena *arena)
{
    static const char *const scripts[] = {"sleep 100", "sleep 100 & exec sleep 100",
                                          "exec >&- 2>&-; sleep 100",
                                          "trap '' TERM HUP INT; sleep 100; sleep 100"};
    for (size_t i = 0; i < sizeof scripts / sizeof scripts[0]; i++) {
        struct timespec begun;
        struct child_end end;
        clock_gettime(CLOCK_MONOTONIC, &begun);
        CHECK(shell(scripts[i], 0.1, 1000, &end, arena) && end.is_late);
        CHECK(elapsed(&begun) < 50);
    }
}

static volatile sig_atomic_t terminated;

static void note(int number)
{
    terminated = number;
}

/* A signal that ends this program ends the other one first, and takes effect then. */
static void test_signal(struct arena *arena)
{
    struct timespec begun;
    struct child_end end;
    const struct sigaction noting = {.sa_handler = note};
    struct sigaction before;
    sigaction(SIGTERM, &noting, &before);
    clock_gettime(CLOCK_MONOTONIC, &begun);
    CHECK(shell("kill -15 $PPID; sleep 100", 90, 1000, &end, arena));
    CHECK(terminated == SIGTERM && !end.is_late && elapsed(&begun) < 50);
    /* one that is ignored is no reason */
    signal(SIGTERM, SIG_IGN);
    CHECK(shell("kill -15 $PPID; echo done", 90, 1000, &end, arena));
    CHECK(text_equal(end.output, "done\n") && end.status == 0);
    sigaction(SIGTERM, &before, NULL);
}

int main(void)
{
    struct arena arena = {0};
    test_output(&arena);
    test_missing(&arena);
    test_late(&arena);
    test_signal(&arena);
    arena_free(&arena);
    return check_report();
}
