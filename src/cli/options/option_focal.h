/* cli/options/option_focal.h - focal lengths, real ones and those equivalent on 36 x 24 mm. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CLI_OPTIONS_OPTION_FOCAL_H
#define LENSCALC_CLI_OPTIONS_OPTION_FOCAL_H

#include "base/error.h"
#include "report/warnings.h"

#include <stdbool.h>
#include <stddef.h>

struct option;

/* A focal length as the user wrote it, mm. */
struct focal_value {
    double length;     /* NaN: not given, or an equivalent one that is not settled */
    double equivalent; /* "26mm-eq": 26; else NaN */
};

/* The options of a command that take such values, and the one that names the sensor. */
struct focal_options {
    const struct option *focal[2], *sensor;
    size_t count;
};

struct focal_options focal_options_of(const struct option *options, size_t count);

/* Refuse a list in which some are equivalent ones and some are not: one axis has one measure. */
bool focal_check_alike(const struct focal_value *values, size_t count, const struct option *option,
                       struct error *error);

/* Is it, in this input, given as an equivalent one? */
bool focal_is_equivalent(const struct option *option, const void *input);

/*
 * The real length of focal lengths that are equivalent ones, and a doubt about those of phones,
 * drones and action cameras that no main lens of them has.
 *
 * Given     input   the command's struct with all of its options
 *           doubts  null: nobody listens
 * Formula   f = equivalent x diagonal/sqrt(36^2 + 24^2)
 * Source    [Ray02]; makers state equivalents by the diagonal
 * Errors    ERROR_USAGE: nobody named a sensor, or the command has no option for one
 * Limits    The main lenses of such cameras are 15 to 35 mm equivalent, as their makers state them:
 *           what is longer than 40 is doubted where the sensor is smaller than 4/3. Drones with
 *           larger ones change lenses; compact cameras zoom to 3000 mm equivalent, so that no
 *           length is implausible there
 */
bool focal_settle(const struct focal_options *options, void *input, struct warnings *doubts,
                  struct error *error);

#endif
