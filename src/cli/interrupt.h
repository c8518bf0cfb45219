/* cli/interrupt.h - Ctrl-C ends long work with what there is, a second one ends the program. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CLI_INTERRUPT_H
#define LENSCALC_CLI_INTERRUPT_H

#include "base/error.h"

#include <stdbool.h>

/* From here on SIGINT is noted, once, unless it is ignored; system calls that wait return. */
void interrupt_watch(void);

/* Has it come? */
bool interrupt_came(void);

/* Fail with that. Returns false. */
bool interrupt_fail(struct error *error);

#endif
