/* commands/lens/ray_case.h - the options of exact rays, and a lens made ready for them. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_COMMANDS_LENS_RAY_CASE_H
#define LENSCALC_COMMANDS_LENS_RAY_CASE_H

#include "commands/lens/lens_options.h"

/* What the options say of lens and rays. Compared byte by byte: values only, set by copying. */
struct ray_question {
    struct lens_value lens;
    const char *position;
    double fnumber; /* NaN = that of the lens */
    struct plane_value focus;
    struct target_value to;
    bool clip, no_clip;
};

/* One lens in one position at one wavelength, and where its rays end. */
struct ray_case {
    struct setup setup;
    bool clip;
    bool to_image;       /* rays end on the image plane */
    size_t surfaces;     /* else behind so many surfaces */
    const char *warning; /* null = all is well */
};

#define RAY_FOCUS_OPTION(S, member)                                                                \
    {                                                                                              \
        OPTION(S, member.focus), .name = "focus", .dimension = &dimension_length, .unit = "mm",    \
                                 .value = "PLANE",                                                 \
                                 .help = "the image plane: paraxial, table, best, or mm from the " \
                                         "last vertex; default that of the lens"                   \
    }

#define RAY_CLIP_OPTIONS(S, member)                                                                \
    {OPTION(S, member.clip), .name = "clip", .help = "clip rays at apertures and stop (default)"}, \
    {                                                                                              \
        OPTION(S, member.no_clip), .name = "no-clip",                                              \
                                   .help = "do not clip rays at clear apertures"                   \
    }

/* What of the lens. */
struct ray_choice {
    size_t position;                 /* from 0 */
    double wavelength;               /* um; NaN = primary */
    const struct setup_field *field; /* in place of those of the lens; null = those */
};

/*
 * Make a lens ready.
 *
 * Given     arena       for all that the case points to
 * Errors    ERROR_USAGE: --clip and --no-clip, a surface that is not there; ERROR_DOMAIN: as
 *           setup_open and setup_place_image, no image plane where rays are to end there, no stop
 *           for the f-number
 */
bool ray_case_open(const struct ray_question *question, const struct ray_choice *choice,
                   struct arena *arena, struct ray_case *one, struct error *error);

/* The case's own system, clipped as the question says, with the image plane if rays end there. */
const struct system *ray_case_system(const struct ray_case *one, struct error *error);

#endif
