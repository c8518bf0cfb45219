/* tests/bench/peak.c - peak memory of a program, in KiB on standard error. */
/* SPDX-License-Identifier: MIT */
#define _DEFAULT_SOURCE /* wait4 */
#include <spawn.h>
#include <stdio.h>
#include <sys/resource.h>
#include <sys/wait.h>

extern char **environ;

/*
 * peak PROGRAM [ARGUMENT...]
 *
 * A small program has to ask: the kernel counts in what the parent had before the child's exec.
 */
int main(int argc, char **argv)
{
    pid_t child;
    int status = 1;
    struct rusage usage;
    if (argc < 2 || posix_spawn(&child, argv[1], NULL, NULL, argv + 1, environ) != 0 ||
        wait4(child, &status, 0, &usage) != child || status != 0) {
        fprintf(stderr, "peak: cannot run the program\n");
        return 1;
    }
    fprintf(stderr, "%ld\n", usage.ru_maxrss);
    return 0;
}
