/* tests/bench/spawn.c - median times of starting programs, in turns. */
/* SPDX-License-Identifier: MIT */
#include "clock.h"

#include <fcntl.h>
#include <spawn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

/*
 * spawn ROUNDS PROGRAM [ARGUMENT...] [-- PROGRAM [ARGUMENT...]]...
 *
 * In every round each program runs once, so that whatever disturbs the machine disturbs all alike.
 * Prints the median of each in microseconds, one a line.
 */

enum { MOST_PROGRAMS = 64, MOST_ROUNDS = 2000 };

static double times[MOST_PROGRAMS][MOST_ROUNDS];

extern char **environ;

/* Time from the call to the end of the program, whose output goes nowhere. */
static double run(char **words, const posix_spawn_file_actions_t *actions)
{
    pid_t child;
    int status = 1;
    double start = 1e6 * clock_time();
    int failure = posix_spawn(&child, words[0], actions, NULL, words, environ);
    if (failure != 0 || waitpid(child, &status, 0) != child || status != 0) {
        fprintf(stderr, "spawn: %s failed\n", words[0]);
        exit(1);
    }
    return 1e6 * clock_time() - start;
}

/* Cut the words into programs at each "--". */
static int cut_programs(char **words, char ***programs)
{
    int count = 0;
    programs[count++] = words;
    for (; *words != NULL && count < MOST_PROGRAMS; words++) {
        if (strcmp(*words, "--") == 0) {
            *words = NULL;
            programs[count++] = words + 1;
        }
    }
    return count;
}

static int ascending(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

int main(int argc, char **argv)
{
    char **programs[MOST_PROGRAMS];
    int rounds = argc > 2 ? atoi(argv[1]) : 0;
    if (rounds < 1 || rounds > MOST_ROUNDS) {
        fprintf(stderr, "usage: spawn ROUNDS PROGRAM [ARGUMENT...] [-- PROGRAM...]...\n");
        return 2;
    }
    int count = cut_programs(argv + 2, programs);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    for (int round = 0; round < rounds; round++) {
        for (int i = 0; i < count; i++) {
            times[i][round] = run(programs[i], &actions);
        }
    }
    for (int i = 0; i < count; i++) {
        qsort(times[i], (size_t)rounds, sizeof times[i][0], ascending);
        printf("%.1f\n", times[i][rounds / 2]);
    }
    return 0;
}
