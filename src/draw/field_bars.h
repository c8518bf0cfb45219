/* draw/field_bars.h - astigmatism over an image format, as bars along both sections, in SVG. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DRAW_FIELD_BARS_H
#define LENSCALC_DRAW_FIELD_BARS_H

#include <stdbool.h>
#include <stddef.h>

struct error;
struct svg;

/* Both foci of one place of the image. */
struct field_bar {
    double at[2];                /* mm */
    double direction;            /* of the tangential section in the image, from x, rad */
    double tangential, sagittal; /* from the image plane, mm */
};

struct field_bars_panel {
    const char *title, *note; /* above and below; null = none */
    const struct field_bar *bars;
    size_t count;
    double half[2], spacing; /* of the format; between bars; mm */
    bool is_disc;
};

struct field_bars {
    const char *title, *subtitle;
    const struct field_bars_panel *panels;
    size_t count;
};

/*
 * Draw the bars as a whole SVG document into `svg`, which must be empty: at each place one along
 * the tangential section as long as its focus is far from the image plane, and one across it for
 * the sagittal focus, thick where the focus lies behind the plane; one scale for all, which a bar
 * tells.
 *
 * Errors    ERROR_DOMAIN: there are none
 */
bool field_bars_draw(const struct field_bars *page, struct svg *svg, struct error *error);

#endif
