/* draw/marks.h - marks of groups of points, and labels beside them that keep off each other. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DRAW_MARKS_H
#define LENSCALC_DRAW_MARKS_H

#include "draw/svg.h"

#include <stdbool.h>
#include <stddef.h>

/* A disc, a square or a triangle, about as large as the others: by seven groups each. */
void mark_draw(struct svg *svg, size_t group, double x, double y, double radius);

/* What of a page labels may not cover, and where they end. */
struct label_page {
    struct svg_box frame;
    struct svg_box *taken; /* marks and labels, with room for all */
    size_t taken_count;
};

/* Keep labels off a place. */
void label_page_take(struct label_page *page, double x, double y, double radius);

/*
 * A label beside a point, where there is room: right, left, above, below, then the corners.
 *
 * Given     point   x, y: the point; size and colour of the label
 *           gap     between the point and the label
 *           forced  where there is none it stands farther off, at the end of a line
 * Result    false: it stands nowhere
 */
bool label_put(struct label_page *page, struct svg *svg, const struct svg_label *point, double gap,
               bool forced, const char *text);

/* A label at a point, or as near as there is room, within its own width; else it is left out. */
void label_put_about(struct label_page *page, struct svg *svg, const struct svg_label *point,
                     const char *text);

#endif
