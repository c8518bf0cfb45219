/* cli/interrupt.h - Ctrl-C ends long work with what there is, a second one ends the program. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CLI_INTERRUPT_H
#define LENSCALC_CLI_INTERRUPT_H

#include "base/error.h"

#include <stdbool.h>

/* Finish the answer with what there is, and end the program. */
typedef void interrupt_break_off(void *context);

/*
 * From here on SIGINT and SIGTERM, which batch queues send, are noted, once each, unless they are
 * ignored; system calls that wait return.
 *
 * Given     break_off  called by a thread of its own where the work has not noticed a signal in
 *                      0.5 s, on a busy machine of its own time: work that has nothing
 *                      to keep need not look. Where that cannot be either, for want of somebody
 *                      who reads the answer, the signal ends the program
 */
void interrupt_watch(interrupt_break_off *break_off, void *context);

/*
 * From interrupt_release to interrupt_hold work goes on that does not touch the answer, so that it
 * can be broken off. The caller of interrupt_watch holds the answer; only that thread may call
 * these. Nothing where nobody watches.
 */
void interrupt_release(void);
void interrupt_hold(void);

/* Has one come? Who asks sees to the end of the work. */
bool interrupt_came(void);

/* Fail with that. Returns false. */
bool interrupt_fail(struct error *error);

#endif
