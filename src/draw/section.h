/* draw/section.h - cross-sections of a lens on a page, in SVG. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DRAW_SECTION_H
#define LENSCALC_DRAW_SECTION_H

#include "analysis/layout/layout.h"

#include "draw/svg.h"

#include <stdbool.h>

struct error;

/* A lens in one of its positions. */
struct section_view {
    const char *name,
        *caption; /* of the position; what it is like there. Null: there is one only */
    const struct layout *layout; /* each of its glasses has a tint of its own; notes: below */
};

/* A table under the drawing. */
struct section_table {
    size_t columns, rows;     /* 0: none */
    const char *const *heads; /* one a column */
    const char *const *cells; /* row after row; null: empty */
};

/* Cross-sections under each other. All of it belongs to the caller. */
struct section {
    const char *title, *subtitle; /* null = none */
    const struct section_view *views;
    size_t view_count;
    struct section_table list;
    bool faint; /* elements only hinted at, behind a construction */
};

/* Width of the page, px; the height follows from the lens. */
#define SECTION_WIDTH 1000.0

/*
 * Draw the sections as a whole SVG document into `svg`, which must be empty: one scale for all of
 * them and both directions, a scale bar in mm, the number and glass of each element, and a legend
 * of the rays that occur. Several stand with their image planes under each other; where one has
 * none, with their first vertices.
 *
 * Errors    ERROR_DOMAIN: no part has an extent, or one is beyond 1e12 mm
 */
bool section_draw(const struct section *section, struct svg *svg, struct error *error);

/* -------- internal to draw/section*.c -------- */

#define SECTION_SMALL 12.0 /* size of labels */

/* Millimetres to px: x = x0 + scale z, y = y0 - scale y. */
struct section_page {
    struct svg *svg;
    const struct section *section;
    const struct layout *layout; /* of the view that is drawn */
    double x0, y0, scale;
    struct svg_box *taken; /* by labels */
    size_t taken_count;
};

/* How parts of a kind are drawn. */
const struct svg_style *section_style(enum layout_kind kind);

/* A label; one that starts at x ends within the page. */
void section_write_text(const struct section_page *page, double x, double y, enum svg_anchor anchor,
                        const char *colour, const char *text);

/* Labels of planes, pupils, points and the image plane, each clear of the others. */
void section_write_labels(struct section_page *page);

/* Have the labels of all elements room side by side? Else none is labelled. */
bool section_labels_elements(const struct layout *layout);

/* How far below the glass the labels of elements reach, px; 0: there are none. */
double section_element_room(const struct layout *layout);

/* Number and glass of each element, upright below it. */
void section_write_elements(struct section_page *page);

#endif
