/* cli/interrupt.c - Ctrl-C ends long work with what there is, a second one ends the program. */
/* SPDX-License-Identifier: MIT */
#include "cli/interrupt.h"

#include <signal.h>
#include <stddef.h>

/* C has no other way for a signal's handler to tell anybody (C17 7.14.1.1). */
static volatile sig_atomic_t came;

static void note(int signal)
{
    (void)signal;
    came = 1;
}

void interrupt_watch(void)
{
    struct sigaction before, action = {.sa_handler = note, .sa_flags = (int)SA_RESETHAND};
    sigemptyset(&action.sa_mask);
    if (sigaction(SIGINT, &action, &before) == 0 && before.sa_handler == SIG_IGN) {
        sigaction(SIGINT, &before, NULL);
    }
}

bool interrupt_came(void)
{
    return came != 0;
}

bool interrupt_fail(struct error *error)
{
    return fail(error, ERROR_DOMAIN, "interrupted: what would follow is missing");
}
