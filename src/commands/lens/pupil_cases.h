/* commands/lens/pupil_cases.h - the points that lenscalc pupil is asked for, and their shapes. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_COMMANDS_LENS_PUPIL_CASES_H
#define LENSCALC_COMMANDS_LENS_PUPIL_CASES_H

#include "analysis/pupil/pupil_shape.h"
#include "commands/lens/lens_options.h"

struct pupil_input {
    struct lens_question question;
    double height, height_x; /* mm in the film */
    struct plane_value focus;
    int side;
    long outline;
};

/* Does it ask for a point of the film? */
static inline bool pupil_is_from_film(const struct pupil_input *input)
{
    return !isnan(input->height) || !isnan(input->height_x);
}

/* A point and what it sees. */
struct pupil_case {
    const struct lens_case *one;
    bool from_film;
    double angle;  /* of the beam in object space, rad; NaN from the film */
    double object; /* height of the object point, mm; NaN at infinity and from the film */
    double height; /* in the film, mm; NaN from the object */
    double angle_x, object_x, height_x; /* the same in the x-z plane */
    double film; /* where it stands, from the last vertex, mm; NaN from the object */
    const struct pupil_shape *shape;
    const struct pupil_shape *axis; /* of the point on the axis, by the same lens */
};

/* The points on the axis that were found, for the inputs that ask again. */
struct pupil_memo;

struct pupil_memo *pupil_memo_new(struct arena *arena);

/* Edges that an outline is drawn or chosen from. */
enum { PUPIL_EDGES = 512 };

/* Goes through all points of an input: positions, wavelengths, fields. */
struct pupil_cursor {
    const struct pupil_input *input;
    struct pupil_memo *memo; /* null = nothing is kept */
    size_t edges;            /* of each point: none, or a multiple of 4 */
    struct pupil_case point; /* where it is */
    /* its own: what one lens at one wavelength needs for all its points */
    struct lens_policy policy;
    struct lens_cursor lens;
    const struct system *clipped, *open;
    double film; /* from the last vertex, mm; NaN for fields */
    struct beam axis_beam;
    struct pupil_shape axis, shape;
    size_t next, count; /* of its points */
};

/* Before the first point; the cursor stays where it is. */
void pupil_begin(struct pupil_cursor *at, const struct pupil_input *input, struct pupil_memo *memo,
                 size_t edges, struct arena *arena);

/*
 * On to the next point.
 *
 * Result    false: that was the last one, and error->code is ERROR_NONE; else it failed
 * Errors    ERROR_DOMAIN: no stop, no image plane, a point on the lens; as lens_next
 */
bool pupil_next(struct pupil_cursor *at, struct error *error);

/* In words: "14 deg", "object -5 mm", "film 3, 10 mm" of x and y. */
const char *pupil_point_words(const struct pupil_case *point, struct arena *arena);

#endif
