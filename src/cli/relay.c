/* cli/relay.c - hand a command over to lenscalc-ceres, the program with the solver. */
/* SPDX-License-Identifier: MIT */
#include "cli/relay.h"

#include "design/solver.h"

#include <errno.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

enum { LONGEST_PATH = 4096 };

/* Set while handing over, so that a wrong lenscalc-ceres does not hand over to itself. */
static const char marker[] = "LENSCALC_RELAYED";

/* The folder of the running program; null where the system does not tell. */
static char *own_folder(struct arena *arena)
{
    char *path = arena_array(arena, LONGEST_PATH, 1);
    ssize_t length = readlink("/proc/self/exe", path, LONGEST_PATH - 1);
    char *slash = length > 0 ? strrchr(path, '/') : NULL;
    if (slash == NULL) {
        return NULL;
    }
    *slash = '\0';
    return path;
}

/*
 * Run it, and end as it ends. An exec alone would leave the last word to the dynamic linker where a
 * library is missing: it ends with 127, which no lenscalc does.
 */
static bool run(const char *path, char **argv, struct error *error)
{
    pid_t parent = getpid(), child = fork();
    int status = 0;
    if (child < 0) {
        return fail(error, ERROR_DOMAIN, "%s does not start: %s", path, strerror(errno));
    }
    if (child == 0) {
        prctl(PR_SET_PDEATHSIG, SIGTERM);
        if (getppid() == parent) {
            execv(path, argv);
        }
        _exit(126);
    }
    /* the terminal's signals reach both: it is for the child to end on them */
    signal(SIGINT, SIG_IGN);
    signal(SIGQUIT, SIG_IGN);
    while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    signal(SIGINT, SIG_DFL);
    signal(SIGQUIT, SIG_DFL);
    if (WIFSIGNALED(status)) {
        raise(WTERMSIG(status));
    }
    if (WIFEXITED(status) && WEXITSTATUS(status) < 126) {
        _exit(WEXITSTATUS(status)); /* nothing has been written here that would be lost */
    }
    return fail(error, ERROR_DOMAIN,
                "%s does not start: the solver Ceres is not installed as it was when lenscalc was "
                "built; 'make deps' installs it, then 'make' and 'make install' again",
                path);
}

bool relay_to_ceres(char **argv, struct arena *arena, struct error *error)
{
    static const char *const places[] = {"lenscalc-ceres", "../libexec/lenscalc/lenscalc-ceres"};
    if (solver_is_present) {
        return true;
    }
    const char *folder = own_folder(arena);
    bool relayed = getenv(marker) != NULL;
    for (size_t i = 0; i < 2 && folder != NULL && !relayed; i++) {
        char *path = arena_printf(arena, "%s/%s", folder, places[i]);
        if (access(path, X_OK) != 0) {
            continue;
        }
        /* the libraries under Ceres would start threads of their own */
        setenv("OMP_NUM_THREADS", "1", 1);
        setenv("OPENBLAS_NUM_THREADS", "1", 1);
        setenv(marker, "1", 1);
        run(path, argv, error);
        unsetenv(marker);
        return false;
    }
    return fail(error, ERROR_DOMAIN,
                "this needs the solver Ceres, which this lenscalc is built without: install "
                "libceres-dev and g++ (as 'make deps' does), then 'make' and 'make install' again");
}
