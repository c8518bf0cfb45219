/* commands/data/glass_search.h - the glasses that fulfil wishes, and the Abbe diagram of them. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_COMMANDS_DATA_GLASS_SEARCH_H
#define LENSCALC_COMMANDS_DATA_GLASS_SEARCH_H

#include "base/arena.h"
#include "cli/options/option_glass.h"
#include "data/glass_catalog.h"
#include "draw/svg.h"

/* What is asked, NaN and null where it is not; of a search what is wanted of a glass. */
struct glass_input {
    struct glass_value glass, like;
    double wavelength, thickness;      /* mm; NaN = not given */
    double temperature, pressure;      /* C, Pa; NaN = not given */
    struct interval_value nd, Vd, PgF; /* nd and Vd may be values to be near to */
    const char *catalog, *status, *label;
    int air;
    long count; /* of the nearest; 0 = not given */
};

/* A glass that was found. */
struct glass_match {
    struct glass_record record;
    struct glass_summary summary;
    double away; /* what it is ranked by: from `like`, or the distance; NaN without */
};

/* Called for every match; false ends the search. */
typedef bool glass_found(const struct glass_match *match, void *context);

/*
 * Go through all catalogues.
 *
 * Errors    as glass_catalogs_next; ERROR_DOMAIN: nothing fulfils the wishes
 */
bool glass_search(const struct glass_input *wishes, struct lensdb *db, struct arena *arena,
                  glass_found *found, void *context, struct error *error);

/* Draw the Abbe diagram of what fulfils the wishes, glasses of `label` large. */
bool glass_diagram(const struct glass_input *wishes, struct lensdb *db, struct svg *svg,
                   struct error *error);

#endif
