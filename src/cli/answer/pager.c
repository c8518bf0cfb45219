/* cli/answer/pager.c - long text on a terminal, a screen at a time. */
/* SPDX-License-Identifier: MIT */
#include "cli/answer/pager.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

extern char **environ; /* POSIX leaves its declaration to the program */

/* The command; null: there is to be none. */
static const char *pager_command(void)
{
    static const char *const variables[] = {"LENSCALC_PAGER", "PAGER"};
    const char *terminal = getenv("TERM"), *command = NULL;
    for (size_t i = 0; i < sizeof variables / sizeof variables[0] && command == NULL; i++) {
        command = getenv(variables[i]);
    }
    if (command == NULL) {
        /* a machine without it says nothing of that */
        command = "command -v less >/dev/null 2>&1 || exit 127; exec less";
    }
    const bool is_none = command[0] == '\0' || strcmp(command, "cat") == 0 || terminal == NULL ||
                         strcmp(terminal, "dumb") == 0 || isatty(STDOUT_FILENO) != 1;
    return is_none ? NULL : command;
}

/* Start the command by the shell, which splits its words, with standard input from `from`. */
static bool pager_start(const char *command, int from, pid_t *child)
{
    char *const words[] = {(char *)"sh", (char *)"-c", (char *)command, NULL};
    posix_spawn_file_actions_t files;
    posix_spawnattr_t attributes;
    sigset_t usual; /* this program ignores broken pipes; a pager need not */
    if (posix_spawn_file_actions_init(&files) != 0) {
        return false;
    }
    if (posix_spawnattr_init(&attributes) != 0) {
        posix_spawn_file_actions_destroy(&files);
        return false;
    }
    sigemptyset(&usual);
    sigaddset(&usual, SIGPIPE);
    sigaddset(&usual, SIGINT);
    posix_spawnattr_setsigdefault(&attributes, &usual);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF);
    posix_spawn_file_actions_adddup2(&files, from, STDIN_FILENO);
    const bool done = posix_spawn(child, "/bin/sh", &files, &attributes, words, environ) == 0;
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&files);
    return done;
}

/* Who leaves the pager early closes the pipe: the rest is not wanted. */
static void pager_feed(int to, struct text text)
{
    while (text.length > 0) {
        const ssize_t written = write(to, text.start, text.length);
        if (written < 0 && errno != EINTR) {
            return;
        }
        text.start += written > 0 ? written : 0;
        text.length -= written > 0 ? (size_t)written : 0;
    }
}

bool pager_show(struct text text)
{
    enum { NOT_FOUND = 127 };
    const char *command = pager_command();
    int ends[2], status = 0;
    pid_t child;
    if (command == NULL || pipe(ends) != 0) {
        return false;
    }
    fcntl(ends[0], F_SETFD, FD_CLOEXEC);
    fcntl(ends[1], F_SETFD, FD_CLOEXEC); /* else it would wait for the end of its own pipe */
    setenv("LESS", "FRX", 0);
    setenv("LV", "-c", 0);
    signal(SIGCHLD, SIG_DFL);
    signal(SIGINT, SIG_IGN); /* Ctrl-C is the pager's */
    bool done = pager_start(command, ends[0], &child);
    close(ends[0]);
    if (done) {
        pager_feed(ends[1], text);
    }
    close(ends[1]);
    while (done && waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    signal(SIGINT, SIG_DFL);
    return done && !(WIFEXITED(status) && WEXITSTATUS(status) == NOT_FOUND);
}
