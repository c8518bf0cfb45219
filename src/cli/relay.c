/* cli/relay.c - hand a command over to lenscalc-ceres, the program with the solver. */
/* SPDX-License-Identifier: MIT */
#include "cli/relay.h"

#include "design/solver/solver.h"
#include "report/version.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { LONGEST_PATH = 4096 };

/*
 * Set while handing over, to the version of who does: a lenscalc-ceres of another version says so,
 * and one that is without Ceres, as it must not be, does not hand over to itself.
 */
static const char marker[] = "LENSCALC_RELAYED";

/* The folder of the running program; null where the system does not tell (Linux does). */
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

bool relay_to_ceres(char **argv, struct arena *arena, struct error *error)
{
    static const char *const places[] = {"lenscalc-ceres", "../libexec/lenscalc/lenscalc-ceres"};
    const char *const from = getenv(marker), *const folder = own_folder(arena);
    if (solver_has(SOLVER_CERES)) {
        return from == NULL || strcmp(from, LENSCALC_VERSION) == 0 ||
               fail(error, ERROR_DOMAIN,
                    "lenscalc-ceres in %s is version " LENSCALC_VERSION ", and lenscalc is %s: "
                    "install both from one build",
                    folder, from);
    }
    if (from != NULL) {
        return fail(error, ERROR_DOMAIN,
                    "lenscalc-ceres in %s is a lenscalc without the solver Ceres: install both "
                    "programs from one build",
                    folder);
    }
    for (size_t i = 0; i < 2 && folder != NULL; i++) {
        char *path = arena_printf(arena, "%s/%s", folder, places[i]);
        if (access(path, X_OK) != 0) {
            continue;
        }
        /* the libraries under Ceres would start threads of their own */
        setenv("OMP_NUM_THREADS", "1", 1);
        setenv("OPENBLAS_NUM_THREADS", "1", 1);
        setenv(marker, LENSCALC_VERSION, 1);
        execv(path, argv);
        return fail(error, ERROR_DOMAIN, "%s does not start: %s", path, strerror(errno));
    }
    return fail(error, ERROR_DOMAIN,
                "this needs the solver Ceres, which this lenscalc is built without: install "
                "libceres-dev and g++ (as 'make deps' does), then 'make' and 'make install' again");
}
