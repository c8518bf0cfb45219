/* draw/section.h - cross-section of a lens on a page, in SVG. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DRAW_SECTION_H
#define LENSCALC_DRAW_SECTION_H

#include "analysis/layout/layout.h"

#include <stdbool.h>

struct error;
struct svg;

/* A cross-section. All of it belongs to the caller. */
struct section {
    const char *title, *subtitle; /* null = none */
    const struct layout *layout;  /* each of its glasses has a tint of its own; notes: below */
    bool faint;                   /* elements only hinted at, behind a construction */
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
