/* cli/relay.h - hand a command over to lenscalc-ceres, the program with the solver. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CLI_RELAY_H
#define LENSCALC_CLI_RELAY_H

#include "base/arena.h"
#include "base/error.h"

#include <stdbool.h>

/*
 * Run lenscalc-ceres with the same arguments, and end as it ends. It is looked for beside this
 * program, then in ../libexec/lenscalc from there. Nothing may have been read from standard input
 * before.
 *
 * Given     argv  of this program, ends with null
 * Result    true: this program has the solver. Else it only comes back with an error
 * Errors    ERROR_DOMAIN: there is none, it does not start (a library is missing), or what goes by
 *           that name is without Ceres
 */
bool relay_to_ceres(char **argv, struct arena *arena, struct error *error);

#endif
