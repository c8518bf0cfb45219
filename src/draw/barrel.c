/* draw/barrel.c - the depth-of-field scale of a lens barrel, drawn flat, in SVG. */
/* SPDX-License-Identifier: MIT */
#include "draw/barrel.h"

#include <math.h>

#include "base/arena.h"
#include "base/error.h"
#include "base/number.h"
#include "base/units.h"
#include "draw/svg.h"
#include "draw/ticks.h"

/* Where things lie on the page, px. */
static const double MARGIN = 24, SCALE_LEFT = 76, SCALE_RIGHT = 852;
static const double RING_TOP = 84, RING_BOTTOM = 186;    /* the focus ring that turns */
static const double FIXED_TOP = 190, FIXED_BOTTOM = 266; /* the fixed ring */
static const double AXIS = 296;

static const char *const BLACK = "#1d1d1d", *const CHROME = "#e6e6e4", *const IVORY = "#f4f1e8";
static const char *const AMBER = "#f0a830", *const RED = "#d0370a", *const BLUE = "#0060a0";

static const double LABEL_GAP = 9, WIDE_GAP = 22; /* px, least distance between numbers */
static const double TICK_GAP = 5, PAIR_GAP = 3;   /* px, and between ticks */

/*
 * Leading digits of the distances, in the order in which they get their places: those that any
 * barrel has, those that fill a gap, and those only for a wide one.
 */
static const double leading_digits[] = {1, 2, 5, 3, 1.5, 7, 4, 2.5, 1.2, 6, 8, 4.5, 3.5, 9, 1.7};
static const size_t ALWAYS_TICKED = 4, CLOSELY_SET = 8;

#define SPANS 128

/* Stretches of a row that are taken already. */
struct barrel_row {
    double from[SPANS], to[SPANS]; /* px */
    size_t count;
};

/* From 1/m to px. */
struct scale {
    double left_diopter, right_diopter;
};

static double barrel_position(const struct scale *scale, double diopter)
{
    double part = (scale->left_diopter - diopter) / (scale->left_diopter - scale->right_diopter);
    return SCALE_LEFT + part * (SCALE_RIGHT - SCALE_LEFT);
}

static bool on_scale(const struct scale *scale, double diopter)
{
    return diopter <= scale->left_diopter && diopter >= scale->right_diopter;
}

static bool barrel_is_free(const struct barrel_row *row, double middle, double width, double gap)
{
    double from = middle - width / 2, to = middle + width / 2;
    for (size_t i = 0; i < row->count; i++) {
        if (from < row->to[i] + gap && to > row->from[i] - gap) {
            return false;
        }
    }
    return row->count < SPANS;
}

static void occupy(struct barrel_row *row, double middle, double width)
{
    if (row->count == SPANS) {
        return;
    }
    row->from[row->count] = middle - width / 2;
    row->to[row->count++] = middle + width / 2;
}

/* Take a stretch of a row if it is free. */
static bool claim(struct barrel_row *row, double middle, double width, double gap)
{
    bool free = barrel_is_free(row, middle, width, gap);
    if (free) {
        occupy(row, middle, width);
    }
    return free;
}

/* Three digits, or all before the point. */
static const char *number_text(struct arena *arena, double x)
{
    char text[NUMBER_LENGTH + 1];
    bool large = x >= 1000;
    *number_write_digits(text, large ? round(x) : x, large ? 9 : 3) = '\0';
    return arena_printf(arena, "%s", text);
}

/* -------- the scale -------- */

static double nearest_of(const struct barrel *barrel)
{
    double nearest = barrel->nearest_diopter;
    for (size_t i = 0; !(barrel->nearest_diopter > 0) && i < barrel->mark_count; i++) {
        nearest = fmax(nearest, 1.1 * barrel->marks[i].near_diopter);
    }
    return nearest;
}

/* As far as the marks reach, within limits, and a little margin. */
static struct scale barrel_scale_of(const struct barrel *barrel, double nearest)
{
    struct scale scale = {nearest, 0};
    for (size_t i = 0; i < barrel->mark_count; i++) {
        scale.left_diopter = fmax(scale.left_diopter, barrel->marks[i].near_diopter);
        scale.right_diopter = fmin(scale.right_diopter, barrel->marks[i].far_diopter);
    }
    scale.left_diopter = fmin(scale.left_diopter, 1.25 * nearest) + 0.03 * nearest;
    scale.right_diopter = fmax(scale.right_diopter, -0.5 * nearest) - 0.03 * nearest;
    return scale;
}

static bool check_barrel(const struct barrel *barrel, struct error *error)
{
    double focus = barrel->focus_diopter, nearest = barrel->nearest_diopter;
    if (!(focus >= 0 && isfinite(focus))) {
        return fail(error, ERROR_DOMAIN, "focus of %g 1/m is not 0 or above", focus);
    }
    if (barrel->chosen >= barrel->mark_count) {
        return fail(error, ERROR_DOMAIN, "barrel mark %zu of %zu cannot be chosen",
                    barrel->chosen + 1, barrel->mark_count);
    }
    for (size_t i = 0; i < barrel->mark_count; i++) {
        const struct barrel_mark *mark = &barrel->marks[i];
        if (!(mark->fnumber > 0 && isfinite(mark->fnumber))) {
            return fail(error, ERROR_DOMAIN, "f-number %g of a barrel mark is not above 0",
                        mark->fnumber);
        }
        /* rounding may put the limits of a tiny aperture on the wrong side of the focus */
        double slack = 1e-9 * focus;
        if (!(mark->near_diopter >= focus - slack && isfinite(mark->near_diopter))) {
            return fail(error, ERROR_DOMAIN,
                        "near limit of f/%g, %g 1/m, is behind the focus, %g 1/m", mark->fnumber,
                        mark->near_diopter, focus);
        }
        if (!(mark->far_diopter <= focus + slack && isfinite(mark->far_diopter))) {
            return fail(error, ERROR_DOMAIN,
                        "far limit of f/%g, %g 1/m, is in front of the focus, %g 1/m",
                        mark->fnumber, mark->far_diopter, focus);
        }
    }
    if (!(nearest >= 0 && isfinite(nearest)) || (nearest > 0 && nearest < focus)) {
        return fail(error, ERROR_DOMAIN, "closest distance at %g 1/m is behind the focus, %g 1/m",
                    nearest, focus);
    }
    return (nearest_of(barrel) > 1e-9 && nearest_of(barrel) < 1e9) ||
           fail(error, ERROR_DOMAIN, "barrel scale of %g 1/m is not within 1e-9 .. 1e9",
                nearest_of(barrel));
}

/* -------- the focus ring -------- */

/* One engraved row of distances. */
struct engraved_row {
    double unit; /* m */
    const char *name;
    const char *colour;
    double base_line;    /* px, of the numbers */
    double edge, inward; /* px, where ticks begin, and which way they go: 1 = down, -1 = up */
};

static double metres_in_foot(void)
{
    return unit_to_own(unit_find(&dimension_length, text_of("ft")), 1) / 1000;
}

static void engrave(struct svg *svg, const struct engraved_row *row, double x, const char *text,
                    double size)
{
    if (text) {
        svg_words(svg, x, row->base_line + (size - 15) / 4, size, SVG_MIDDLE, row->colour, text);
    }
    svg_line(svg, x, row->edge, x, row->edge + row->inward * (text ? 13 : 7));
}

/* A distance's number with its tick where there is room; a very round one gets a tick at least. */
static void engrave_distance(struct svg *svg, const struct scale *scale,
                             const struct engraved_row *row, double distance, size_t rank,
                             struct barrel_row *numbers, struct barrel_row *ticks)
{
    double x = barrel_position(scale, 1 / (distance * row->unit));
    const char *text = number_text(svg->arena, distance);
    double gap = rank < CLOSELY_SET ? LABEL_GAP : WIDE_GAP;
    bool room = claim(numbers, x, svg_text_width(text, 15), gap);
    bool tick = rank < ALWAYS_TICKED && barrel_is_free(ticks, x, 0, TICK_GAP);
    if (!room && !tick) {
        return;
    }
    occupy(ticks, x, 0);
    engrave(svg, row, x, room ? text : NULL, 15);
}

static void draw_focus_ring(struct svg *svg, const struct scale *scale, double nearest)
{
    const struct engraved_row rows[] = {
        {metres_in_foot(), "ft", AMBER, RING_TOP + 34, RING_TOP, 1},
        {1, "m", IVORY, RING_BOTTOM - 24, RING_BOTTOM, -1},
    };
    for (size_t i = 0; i < 2; i++) {
        /* round distances, the roundest first, so that these get their numbers */
        const struct engraved_row *row = &rows[i];
        svg_group_begin(svg, &(struct svg_style){.stroke = row->colour, .width = 1.5});
        struct barrel_row numbers = {.count = 0}, ticks = {.count = 0};
        double closest = 1 / (nearest * row->unit);
        double x = barrel_position(scale, 0);
        occupy(&numbers, x, 24);
        occupy(&ticks, x, 0);
        engrave(svg, row, x, "∞", 24);
        for (size_t rank = 0; rank < sizeof(leading_digits) / sizeof(leading_digits[0]); rank++) {
            /* four decades are far more than a barrel has room for */
            for (double decade = floor(log10(closest)), k = 0; k < 5; k++) {
                double distance = leading_digits[rank] * pow(10, decade + k);
                if (distance >= closest * (1 - 1e-9)) {
                    engrave_distance(svg, scale, row, distance, rank, &numbers, &ticks);
                }
            }
        }
        svg_words(svg, MARGIN + 22, row->base_line, 13, SVG_MIDDLE, row->colour, row->name);
        svg_group_end(svg);
    }
}

/* -------- the fixed ring -------- */

/* One tick with its number, or without (null), beside the tick if so anchored. */
static void barrel_draw_mark(struct svg *svg, double x, const char *text, enum svg_anchor anchor,
                             bool chosen)
{
    static const double beside[] = {[SVG_START] = 4, [SVG_MIDDLE] = 0, [SVG_END] = -4};
    const struct svg_label label = {.x = x + beside[anchor],
                                    .y = FIXED_TOP + 42,
                                    .size = 15,
                                    .anchor = anchor,
                                    .colour = chosen ? "#000" : "#222",
                                    .bold = chosen};
    svg_line(svg, x, FIXED_TOP, x, FIXED_TOP + (text ? 22 : 12));
    svg_text(svg, &label, text);
}

/* Take the places of a pair in one row: both or none, but only those on the scale. */
static bool claim_pair(struct barrel_row *row, const struct scale *scale, const double limit[2],
                       double width, double gap)
{
    struct barrel_row before = *row;
    for (size_t i = 0; i < 2; i++) {
        if (on_scale(scale, limit[i]) &&
            !claim(row, barrel_position(scale, limit[i]), width, gap)) {
            *row = before;
            return false;
        }
    }
    return true;
}

/* The pair of one f-number; the chosen one's numbers move outwards if they have no room. */
static void draw_pair(struct svg *svg, const struct scale *scale, const struct barrel_mark *mark,
                      bool chosen, struct barrel_row *numbers, struct barrel_row *ticks)
{
    const char *text = number_text(svg->arena, mark->fnumber);
    double limit[] = {mark->near_diopter, mark->far_diopter};
    double width = svg_text_width(text, 15);
    bool room = claim_pair(numbers, scale, limit, width, LABEL_GAP / 2);
    bool ticked = claim_pair(ticks, scale, limit, 0, PAIR_GAP);
    if (!room && !ticked && !chosen) {
        return;
    }
    for (size_t i = 0; i < 2; i++) {
        double x = barrel_position(scale, limit[i]);
        enum svg_anchor outward = i == 0 ? SVG_END : SVG_START;
        if (!on_scale(scale, limit[i])) {
            continue;
        }
        if (chosen && !room) {
            occupy(numbers, x + (i == 0 ? -1 : 1) * (width / 2 + 4), width);
        }
        barrel_draw_mark(svg, x, room || chosen ? text : NULL, room ? SVG_MIDDLE : outward, chosen);
    }
}

/* The mark with the largest f-number below `limit`; mark_count if there is none. */
static size_t next_mark(const struct barrel *barrel, double limit)
{
    size_t next = barrel->mark_count;
    for (size_t i = 0; i < barrel->mark_count; i++) {
        double N = barrel->marks[i].fnumber;
        if (N < limit && (next == barrel->mark_count || N > barrel->marks[next].fnumber)) {
            next = i;
        }
    }
    return next;
}

/* The chosen pair first, then by falling f-number: so numbers are lost where it is crowded. */
static void draw_pairs(struct svg *svg, const struct scale *scale, const struct barrel *barrel)
{
    struct barrel_row numbers = {.count = 0}, ticks = {.count = 0}; /* of what is there already */
    occupy(&numbers, barrel_position(scale, barrel->focus_diopter), 10);
    svg_group_begin(svg, &(struct svg_style){.stroke = BLUE, .width = 2.4});
    draw_pair(svg, scale, &barrel->marks[barrel->chosen], true, &numbers, &ticks);
    svg_group_end(svg);
    svg_group_begin(svg, &(struct svg_style){.stroke = "#222", .width = 1.3});
    for (size_t i = next_mark(barrel, INFINITY); i < barrel->mark_count;
         i = next_mark(barrel, barrel->marks[i].fnumber)) {
        if (i != barrel->chosen) {
            draw_pair(svg, scale, &barrel->marks[i], false, &numbers, &ticks);
        }
    }
    svg_group_end(svg);
}

/* -------- the page -------- */

static void barrel_draw_area(struct svg *svg, const struct svg_style *style, double left,
                             double top, double right, double bottom)
{
    svg_styled_rect(svg, style, left, top, right - left, bottom - top);
}

/* "3 m (9.84 ft)", or the infinity sign. */
static const char *distance_text(struct arena *arena, double diopter)
{
    return diopter > 1e-9 ? arena_printf(arena, "%s m (%s ft)", number_text(arena, 1 / diopter),
                                         number_text(arena, 1 / diopter / metres_in_foot()))
                          : "∞";
}

/* A triangle that points to the place of the focus. */
static void draw_index(struct svg *svg, double x, double y)
{
    svg_group_begin(svg, &(struct svg_style){.fill = RED});
    svg_path(svg, x, y, "M0 0L6 11 -6 11z");
    svg_group_end(svg);
}

static void barrel_draw_legend(struct svg *svg, const struct barrel *barrel)
{
    const struct barrel_mark *mark = &barrel->marks[barrel->chosen];
    struct arena *arena = svg->arena;
    double y = BARREL_HEIGHT - 22;
    draw_index(svg, MARGIN + 6, y - 11);
    svg_words_within(
        svg, MARGIN + 20, y, 13, 280, NULL,
        arena_printf(arena, "focused at %s", distance_text(arena, barrel->focus_diopter)));
    barrel_draw_area(svg, &(struct svg_style){.fill = "#56b4e9", .stroke = BLUE, .opacity = 0.5},
                     330, y - 11, 352, y + 1);
    svg_words_within(svg, 360, y, 13, 510, NULL,
                     arena_printf(arena, "sharp at f/%s: %s to %s",
                                  number_text(arena, mark->fnumber),
                                  distance_text(arena, mark->near_diopter),
                                  distance_text(arena, mark->far_diopter)));
}

bool barrel_draw(const struct barrel *barrel, struct svg *svg, struct error *error)
{
    if (!check_barrel(barrel, error)) {
        return false;
    }
    double nearest = nearest_of(barrel);
    struct scale scale = barrel_scale_of(barrel, nearest);
    svg_begin(svg, BARREL_WIDTH, BARREL_HEIGHT, barrel->title);
    double width = BARREL_WIDTH - 2 * MARGIN;
    svg_heading(svg, MARGIN, 36, 18, width, barrel->title);
    svg_subheading(svg, MARGIN, 60, 13, width, barrel->subtitle);
    /* Both rings, and over them what is sharp at the chosen f-number. */
    const struct barrel_mark *mark = &barrel->marks[barrel->chosen];
    double left = fmax(barrel_position(&scale, mark->near_diopter), MARGIN);
    double right = fmin(barrel_position(&scale, mark->far_diopter), BARREL_WIDTH - MARGIN);
    struct svg_style black = {.fill = BLACK}, chrome = {.fill = CHROME, .stroke = "#999"};
    struct svg_style dim = {.fill = "#4fa3d8", .opacity = 0.45};
    struct svg_style tint = {.fill = "#56b4e9", .opacity = 0.4};
    barrel_draw_area(svg, &black, MARGIN, RING_TOP, BARREL_WIDTH - MARGIN, RING_BOTTOM);
    barrel_draw_area(svg, &chrome, MARGIN, FIXED_TOP, BARREL_WIDTH - MARGIN, FIXED_BOTTOM);
    barrel_draw_area(svg, &dim, left, RING_TOP, right, RING_BOTTOM);
    barrel_draw_area(svg, &tint, left, FIXED_TOP, right, FIXED_BOTTOM);
    draw_focus_ring(svg, &scale, nearest);
    draw_pairs(svg, &scale, barrel);
    double x = barrel_position(&scale, barrel->focus_diopter);
    svg_styled_line(svg, &(struct svg_style){.stroke = RED, .width = 2.6}, x, FIXED_TOP + 2, x,
                    FIXED_BOTTOM - 12);
    draw_index(svg, x, FIXED_TOP);
    /* the axis below: distances are even in dioptres */
    struct ticks ticks;
    ticks_linear(scale.right_diopter, scale.left_diopter, &ticks);
    svg_group_begin(svg, &(struct svg_style){.stroke = "#555", .width = 1});
    svg_line(svg, MARGIN, AXIS, BARREL_WIDTH - MARGIN, AXIS);
    for (size_t i = 0; i < ticks.count; i++) {
        double at = barrel_position(&scale, ticks.value[i]);
        if (!on_scale(&scale, ticks.value[i])) {
            continue;
        }
        svg_line(svg, at, AXIS, at, AXIS + 5);
        svg_words(svg, at, AXIS + 19, 12, SVG_MIDDLE, "#444", ticks_text(svg->arena, &ticks, i));
    }
    svg_group_end(svg);
    svg_words(svg, BARREL_WIDTH / 2, AXIS + 40, 13, SVG_MIDDLE, "#444",
              "1 / distance (dioptres, 1/m)");
    barrel_draw_legend(svg, barrel);
    svg_end(svg);
    return true;
}
