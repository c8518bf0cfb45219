/* draw/svg.h - SVG 1.1 drawings as text in memory. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DRAW_SVG_H
#define LENSCALC_DRAW_SVG_H

#include "base/text.h"
#include "draw/palette.h"

#include <stdbool.h>
#include <stddef.h>

struct arena;

enum svg_anchor { SVG_START, SVG_MIDDLE, SVG_END };

struct svg_label {
    double x, y;            /* of the anchor, on the base line */
    double size;            /* of the font, px */
    double rotation;        /* degrees, clockwise, about the anchor */
    double width;           /* px; a longer text is cut and ends in an ellipsis; 0 = any length */
    enum svg_anchor anchor; /* which point of the text lies on x, y */
    const char *colour;     /* null = black */
    bool bold;
};

/* The title of a drawing, or its subtitle; a null text is an empty one. */
struct svg_slot {
    bool is_there;
    size_t start, end; /* bytes of data: all of <text ...>...</text>, none of an empty one */
    struct svg_label label;
};

/*
 * The drawing so far: well-formed after svg_end. Start with { .arena = ... }. All coordinates are
 * pixels, x to the right, y down. They are written with at most two decimals and held within
 * +-10^6; an element with a coordinate that is not finite is left out. The same calls give the
 * same bytes on every run, in every locale.
 */
struct svg {
    struct arena *arena; /* owns data; what it outgrows stays there until the arena is freed */
    char *data;          /* UTF-8, a NUL behind; null before svg_begin */
    size_t length, capacity;
    /* What svg_dress may change; of the name the bytes between <title> and </title>. */
    struct svg_slot name, title, subtitle;
};

/* How the shapes of a group are drawn; { 0 } draws nothing. */
struct svg_style {
    const char *stroke; /* colour of lines; null = none */
    const char *fill;   /* colour of areas; null = none */
    const char *dash;   /* lengths of dashes and gaps, px, as "6 4"; null = solid */
    double width;       /* of lines, px; 0 = 1 */
    double opacity;     /* 0 < opacity <= 1; 0 = 1 */
};

/* The head, with the drawing's title (null = none) and a white page. */
void svg_begin(struct svg *svg, double width, double height, const char *title);

/* The same of a page in millimetres, each of so many units of all other coordinates. */
void svg_begin_mm(struct svg *svg, double width, double height, double units, const char *title);
void svg_end(struct svg *svg);

/* Shapes inherit the style of the innermost group; outside of groups they are not drawn. */
void svg_group_begin(struct svg *svg, const struct svg_style *style);

/* A group of which only the part inside a rectangle is seen. */
void svg_clip_begin(struct svg *svg, double x, double y, double width, double height);

/* Close the innermost group or clip. */
void svg_group_end(struct svg *svg);

void svg_line(struct svg *svg, double x1, double y1, double x2, double y2);
void svg_rect(struct svg *svg, double x, double y, double width, double height);
void svg_circle(struct svg *svg, double x, double y, double radius);

/* A line through `count` points, broken where a coordinate is not finite. */
void svg_polyline(struct svg *svg, const double *x, const double *y, size_t count);

/* The same, every part closed to an area. */
void svg_polygon(struct svg *svg, const double *x, const double *y, size_t count);

/* A path in SVG's own words ("M0 0L4 8z"), its origin moved to x, y. */
void svg_path(struct svg *svg, double x, double y, const char *words);

/* A picture, the bytes of a PNG file, over a rectangle. */
void svg_image(struct svg *svg, double x, double y, double width, double height, struct text png);

/*
 * Text in UTF-8, escaped, as draw/typeset.h sets it: "_{d}" is a subscript. What XML cannot hold is
 * shown as '?'. Null or empty: nothing is written.
 */
void svg_text(struct svg *svg, const struct svg_label *label, const char *text);

/* The same of the picture's title and subtitle, as the first are; a null text is an empty one. */
void svg_title(struct svg *svg, const struct svg_label *label, const char *text);
void svg_subtitle(struct svg *svg, const struct svg_label *label, const char *text);

/* The same of a label with these alone; a null text is an empty one, a null colour black. */
void svg_words(struct svg *svg, double x, double y, double size, enum svg_anchor anchor,
               const char *colour, const char *text);
void svg_words_within(struct svg *svg, double x, double y, double size, double width,
                      const char *colour, const char *text);

/* Turned to run upwards about its middle. */
void svg_words_upwards(struct svg *svg, double x, double y, double size, const char *text);

/* A title in bold from x on, and a grey subtitle, neither wider than `width`. */
void svg_heading(struct svg *svg, double x, double y, double size, double width, const char *text);
void svg_subheading(struct svg *svg, double x, double y, double size, double width,
                    const char *text);

/* One shape that is a group by itself. */
void svg_styled_line(struct svg *svg, const struct svg_style *style, double x1, double y1,
                     double x2, double y2);
void svg_styled_rect(struct svg *svg, const struct svg_style *style, double x, double y,
                     double width, double height);
void svg_styled_circle(struct svg *svg, const struct svg_style *style, double x, double y,
                       double radius);
void svg_styled_polyline(struct svg *svg, const struct svg_style *style, const double *x,
                         const double *y, size_t count);
void svg_styled_polygon(struct svg *svg, const struct svg_style *style, const double *x,
                        const double *y, size_t count);

/* A line with both its ends marked. */
void svg_scale_bar(struct svg *svg, const char *colour, double left, double right, double y);

/* A place on the page, px; does one of several that are taken touch it? */
struct svg_box {
    double left, top, right, bottom;
};
bool svg_is_free(const struct svg_box *taken, size_t count, const struct svg_box *box);

/* How wide a text will be at most, px, by typeset_width; of the first, set as svg_text sets it. */
double svg_text_width(const char *text, double size);

/* What a user wants otherwise of any picture. */
struct svg_dress {
    enum palette_theme theme;
    const char *title, *subtitle; /* null: its own */
};

/*
 * A finished drawing in another dress: the colours of its theme, see palette_in_theme, and other
 * words for title and subtitle, cut where its own would be.
 *
 * Result    a drawing in the arena of the first, which it is where nothing changes
 */
struct svg svg_dress(const struct svg *drawing, const struct svg_dress *dress);

#endif
