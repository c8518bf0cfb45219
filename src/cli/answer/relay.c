/* cli/answer/relay.c - hand a command over to lenscalc-ceres, the program with the solver. */
/* SPDX-License-Identifier: MIT */
#include "cli/answer/relay.h"

#include "cli/child.h"
#include "cli/question/arguments.h"
#include "cli/question/command.h"
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

/*
 * Does the program start? A loader that does not find a library, or no memory for one, ends it
 * after execv, when nobody is left to give that a status; the loader says itself what it lacks.
 */
static bool can_start(const char *path, struct arena *arena, struct error *error)
{
    char *const words[] = {(char *)path, (char *)"--version", NULL};
    const struct child child = {.words = words};
    struct child_end end;
    return child_run(&child, &end, arena, error) &&
           (end.status == 0 ||
            fail(error, ERROR_IO,
                 "%s, the program with the solver Ceres, does not start: it ended with %s", path,
                 child_status(&end, arena)));
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
        if (!can_start(path, arena, error)) {
            return false;
        }
        execv(path, argv);
        return fail(error, ERROR_IO, "%s does not start: %s", path, strerror(errno));
    }
    return fail(error, ERROR_DOMAIN,
                "this needs the solver Ceres, which this lenscalc is built without: install "
                "libceres-dev and g++ (as 'make deps' does), then 'make' and 'make install' again");
}

bool relay_is_wanted(const struct command *command, const struct arguments *arguments)
{
    const char *when = command->needs_ceres;
    if (when == NULL || *when == '\0') {
        return when != NULL;
    }
    const char *word = strchr(when, '=');
    const struct argument *argument = arguments_find(arguments, text_between(when, word));
    struct text list = argument->text;
    bool found = false;
    while (argument->is_given && list.start != NULL && !found) {
        found = text_same(text_cut(&list, ','), word + 1);
    }
    return found;
}
