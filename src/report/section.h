/* report/section.h - cross-section of a lens on a page, in SVG. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_REPORT_SECTION_H
#define LENSCALC_REPORT_SECTION_H

#include <stdbool.h>
#include <stddef.h>

struct error;
struct svg;

/* What a part is; those later in the list are drawn over the earlier ones. */
enum section_kind {
    SECTION_ELEMENT,  /* the closed outline of a piece of glass */
    SECTION_AXIS,     /* dash-dotted */
    SECTION_AXIAL,    /* a ray from the axial object point */
    SECTION_OBLIQUE,  /* a ray from the edge of the field */
    SECTION_CHIEF,    /* the one through the middle of the stop */
    SECTION_GAUSS,    /* a ray of the construction with the cardinal points */
    SECTION_EXTENDED, /* its extension to where it is not */
    SECTION_ARROW,    /* object or image; the last point is the tip */
    SECTION_HATCH,    /* strokes behind a mirror */
    SECTION_MIRROR,
    SECTION_STOP,
    SECTION_IMAGE,
    SECTION_PLANE, /* a principal plane, from bottom to top */
    SECTION_PUPIL, /* likewise a pupil */
    SECTION_POINT, /* a point on the axis */
    SECTION_KINDS
};

/* A line in mm: z along the axis to the right, y up; broken where a coordinate is NaN. */
struct section_part {
    enum section_kind kind;
    size_t glass; /* of an element: index of its glass */
    const double *z, *y;
    size_t count;
    const char *label; /* null = none; above a plane, pupil or image, below a point */
};

/* A cross-section. All of it belongs to the caller. */
struct section {
    const char *title, *subtitle; /* null = none */
    const struct section_part *parts;
    size_t part_count;
    const char *const *glasses; /* names, each with a tint of its own */
    size_t glass_count;
    const char *const *notes; /* a line each below the legend */
    size_t note_count;
    bool faint; /* elements only hinted at, behind a construction */
};

/* Width of the page, px; the height follows from the lens. */
#define SECTION_WIDTH 1000.0

/*
 * Draw the section as a whole SVG document into `svg`, which must be empty: one scale for both
 * directions, a scale bar in mm, and a legend of the glasses and rays that occur.
 *
 * Errors    ERROR_DOMAIN: no part has an extent, or one is beyond 1e12 mm
 */
bool section_draw(const struct section *section, struct svg *svg, struct error *error);

#endif
