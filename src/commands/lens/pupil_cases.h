/* cli/pupil_cases.h - the points that lenscalc pupil is asked for, and their shapes. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CLI_PUPIL_CASES_H
#define LENSCALC_CLI_PUPIL_CASES_H

#include "analysis/pupil_shape.h"
#include "commands/lens/lens_options.h"

struct pupil_input {
    struct lens_question question; /* its field stays absent */
    double field, height;          /* rad; mm in the film */
    struct plane_value focus;
    int side;
    long outline;
};

/* A point and what it sees. */
struct pupil_case {
    const struct lens_case *one;
    bool from_film;
    double angle;  /* of the beam in object space, rad; NaN from the film */
    double object; /* height of the object point, mm; NaN at infinity and from the film */
    double height; /* in the film, mm; NaN from the object */
    double film;   /* where it stands, from the last vertex, mm; NaN from the object */
    const struct pupil_shape *shape;
    const struct pupil_shape *axis; /* of the point on the axis, by the same lens */
};

/*
 * Visit all points of an input: positions, wavelengths, fields.
 *
 * Errors    ERROR_DOMAIN: no stop, no image plane, a point on the lens; as lens_each
 */
bool pupil_each(const struct pupil_input *input, struct run *run,
                bool (*visit)(const struct pupil_case *point, struct run *run, const void *context,
                              struct error *error),
                const void *context, struct error *error);

/* In words: "14 deg", "object -5 mm", "film 10 mm". */
const char *pupil_point_words(const struct pupil_case *point, struct arena *arena);

#endif
