/* cli/options/option_glass.h - values of options about glasses. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CLI_OPTIONS_OPTION_GLASS_H
#define LENSCALC_CLI_OPTIONS_OPTION_GLASS_H

struct glass_record;

/* A glass as the user named it. */
struct glass_value {
    const struct glass_record *record; /* null = not given */
    const char *name;                  /* as printed: "N-BK7" */
};

/* A wanted range, 1.5..1.52, or a value that others are to be near; NaN where an end is open or
   nothing is given. */
struct interval_value {
    double low, high, near;
};

#endif
