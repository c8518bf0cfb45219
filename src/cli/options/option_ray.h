/* cli/options/option_ray.h - values of ray commands: points, directions, planes. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CLI_OPTIONS_OPTION_RAY_H
#define LENSCALC_CLI_OPTIONS_OPTION_RAY_H

#include "analysis/setup/setup_question.h"

#include <stdbool.h>

/* A point or a direction: x:y:z. */
struct vector_value {
    bool is_given;
    double at[3]; /* mm, or plain numbers */
};

/* A point of the pupil: x:y, in units of its radius. */
struct pupil_value {
    bool is_given;
    double at[2];
};

/* Where rays end. */
enum target_kind { TARGET_USUAL, TARGET_IMAGE, TARGET_LAST, TARGET_SURFACE };

struct target_value {
    enum target_kind kind; /* TARGET_USUAL: not given */
    long surface;          /* TARGET_SURFACE: from 1 */
};

#endif
