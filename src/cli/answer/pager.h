/* cli/answer/pager.h - long text on a terminal, a screen at a time. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CLI_ANSWER_PAGER_H
#define LENSCALC_CLI_ANSWER_PAGER_H

#include "base/text.h"

#include <stdbool.h>

/*
 * Show a text by the pager, as git does: the command in LENSCALC_PAGER, else in PAGER, else less,
 * which without LESS in the environment ends by itself where one screen holds all (FRX).
 *
 * Result    false: nothing was shown, since standard output is no terminal or a dumb one, the
 *           command is empty or cat, or it does not start; the text is still to be written
 */
bool pager_show(struct text text);

#endif
