/* cli/ray_case.h - the options of exact rays, and a lens made ready for them. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CLI_RAY_CASE_H
#define LENSCALC_CLI_RAY_CASE_H

#include "commands/lens/lens_options.h"
#include "trace/system.h"

/* What the options say of lens and rays. Compared byte by byte: values only, set by copying. */
struct ray_question {
    struct lens_value lens;
    const char *position;
    double fnumber; /* NaN = that of the lens */
    struct plane_value focus;
    struct target_value to;
    bool clip, no_clip;
};

/* One lens in one position, with its stop and its image plane. */
struct ray_case {
    const struct lens *lens;
    const char *position; /* null = the only one */
    struct conjugate_object object;
    struct first_order first; /* at the primary wavelength, with the aperture */
    double stop_radius;       /* mm, for system_options: NaN = what the lens says */
    double image;             /* behind the last vertex, mm; NaN = none */
    const char *focus;        /* "paraxial"; null = no image plane */
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
    {OPTION(S, member.clip), .name = "clip",                                                       \
     .help = "clear apertures and the stop lose rays (so they do anyway)"},                        \
    {                                                                                              \
        OPTION(S, member.no_clip), .name = "no-clip", .help = "rays pass beyond all rims"          \
    }

/*
 * The positions of the lens that are asked for; see lens_positions.
 *
 * Errors    ERROR_USAGE: no lens, an unknown position
 */
bool ray_positions(const struct ray_question *question, struct arena *arena,
                   const size_t **positions, size_t *count, struct error *error);

/*
 * Make a lens ready.
 *
 * Given     position  of the lens, from 0
 *           arena     for all that the case points to
 * Errors    ERROR_USAGE: --clip and --no-clip, a surface that is not there; ERROR_DOMAIN: as
 *           first_order_aperture and image_plane_find, no image plane where rays are to end there,
 *           no stop for the f-number
 */
bool ray_case_open(const struct ray_question *question, size_t position, struct arena *arena,
                   struct ray_case *one, struct error *error);

/* The system of a case at a wavelength in um; `image`: with its image plane, if it has one. */
bool ray_case_compile(const struct ray_case *one, double wavelength, bool clip, bool image,
                      struct arena *arena, struct system *system, struct error *error);

#endif
