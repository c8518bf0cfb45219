/* draw/dof_disc.c - a depth-of-field calculator to cut out: two discs, in SVG and true size. */
/* SPDX-License-Identifier: MIT */
#include "draw/dof_disc.h"

#include "base/arena.h"
#include "base/constants.h"
#include "base/number.h"
#include "photo/dof_turn.h"

#include <math.h>

/* Coordinates are tenths of a millimetre. */
static const double UNITS = 10;
static const double LARGE = 460, SMALL = 320; /* radii */
static const double LARGE_X = 510, SMALL_X = 1420, MIDDLE_Y = 620;
static const double FEET_EDGE = 238; /* radius of the inner scale of the small disc */
static const double SPAN = 5.1;      /* rad that distances take at most */
static const double WIDEST = 1.75;   /* rad from the arrow to the last f-number */
static const double FOOT = 304.8;    /* mm */
static const char *const RED = "#c0392b", *const DARK = "#1d1d1d", *const GREY = "#777777";

/* Stretches of a circle that numbers take. */
enum { SPANS = 96, ROWS = 3 };
struct disc_row {
    double from[SPANS], to[SPANS]; /* rad */
    size_t count;
};

/* A disc's middle, and radians for each unit of the scale. */
struct disc_page {
    struct svg *svg;
    const struct dof_disc_drawing *disc;
    double x, turn;
    const char *unnamed; /* f-numbers that have no room for their number; null: none */
};

static bool disc_claim(struct disc_row *row, double at, double width)
{
    const double from = at - width / 2, to = at + width / 2;
    for (size_t i = 0; i < row->count; i++) {
        if (from < row->to[i] && to > row->from[i]) {
            return false;
        }
    }
    if (row->count == SPANS) {
        return false;
    }
    row->from[row->count] = from;
    row->to[row->count++] = to;
    return true;
}

/* Angles run clockwise from the top. */
static void disc_tick(const struct disc_page *page, double angle, double from, double to)
{
    svg_line(page->svg, page->x + from * sin(angle), MIDDLE_Y - from * cos(angle),
             page->x + to * sin(angle), MIDDLE_Y - to * cos(angle));
}

/* Text along the circle, its base line at a radius. */
static void disc_text(const struct disc_page *page, double angle, double radius, double size,
                      const char *colour, const char *text)
{
    svg_text(page->svg,
             &(struct svg_label){.x = page->x + radius * sin(angle),
                                 .y = MIDDLE_Y - radius * cos(angle),
                                 .size = size,
                                 .rotation = angle * DEGREES_PER_RADIAN,
                                 .anchor = SVG_MIDDLE,
                                 .colour = colour},
             text);
}

static void disc_outline(const struct disc_page *page, double radius)
{
    svg_styled_circle(page->svg, &(struct svg_style){.stroke = GREY, .width = 2}, page->x, MIDDLE_Y,
                      radius);
    svg_styled_circle(page->svg, &(struct svg_style){.stroke = DARK, .width = 2}, page->x, MIDDLE_Y,
                      10);
    svg_styled_line(page->svg, &(struct svg_style){.stroke = DARK, .width = 2}, page->x - 18,
                    MIDDLE_Y, page->x + 18, MIDDLE_Y);
    svg_styled_line(page->svg, &(struct svg_style){.stroke = DARK, .width = 2}, page->x,
                    MIDDLE_Y - 18, page->x, MIDDLE_Y + 18);
}

/* -------- the small disc -------- */

/* A scale of distances. */
struct disc_scale {
    double unit; /* mm */
    const char *name, *colour;
    double edge, inner, base; /* radii: ticks from and to, the numbers' base line */
};

static const char *disc_number(struct arena *arena, double number)
{
    char text[NUMBER_LENGTH + 1];
    *number_write_digits(text, number, 3) = '\0';
    return arena_printf(arena, "%s", text);
}

/* Round distances, the roundest first; a number where there is room, else a tick if there is. */
static void disc_distances(const struct disc_page *page, const struct disc_scale *scale)
{
    static const double leading[] = {1,   2,   5,   3,   1.5, 7,   4,   2.5, 1.2,
                                     6,   8,   4.5, 3.5, 9,   1.7, 5.5, 6.5, 7.5,
                                     8.5, 9.5, 1.1, 1.3, 1.4, 1.6, 1.8, 2.2, 2.7};
    const struct dof_disc_drawing *disc = page->disc;
    struct disc_row numbers = {.count = 0}, ticks = {.count = 0};
    const double closest = disc->nearest / scale->unit, size = 27;
    svg_group_begin(page->svg, &(struct svg_style){.stroke = scale->colour, .width = 2.4});
    disc_tick(page, 0, scale->edge, scale->inner);
    disc_text(page, 0, scale->base, 40, scale->colour, "∞");
    disc_claim(&numbers, 0, 50 / scale->base);
    disc_claim(&ticks, 0, 10 / scale->edge);
    for (size_t rank = 0; rank < sizeof leading / sizeof leading[0]; rank++) {
        for (int decade = 0; decade < 5; decade++) {
            const double distance = leading[rank] * pow(10, floor(log10(closest)) + decade);
            if (!(distance >= closest * (1 - 1e-9))) {
                continue;
            }
            const double s = distance * scale->unit;
            const double at = -page->turn * dof_turn_place(disc->f, disc->P, s);
            const char *text = disc_number(page->svg->arena, distance);
            const double width = (svg_text_width(text, size) + 14) / scale->base;
            if (!disc_claim(&ticks, at, 10 / scale->edge)) {
                continue;
            }
            const bool room = disc_claim(&numbers, at, width);
            disc_tick(page, at, scale->edge,
                      room ? scale->inner : (scale->edge + scale->inner) / 2);
            if (room) {
                disc_text(page, at, scale->base, size, scale->colour, text);
            }
        }
    }
    /* the unit, in the gap behind infinity */
    disc_text(page, 0.32, scale->base, size, scale->colour, scale->name);
    svg_group_end(page->svg);
}

static void disc_draw_small(const struct disc_page *page)
{
    const struct disc_scale metres = {1000, "m", DARK, SMALL, SMALL - 24, SMALL - 54};
    const struct disc_scale feet = {FOOT, "ft", RED, FEET_EDGE, FEET_EDGE - 22, FEET_EDGE - 50};
    disc_outline(page, SMALL);
    svg_styled_circle(page->svg, &(struct svg_style){.stroke = GREY, .width = 1.2}, page->x,
                      MIDDLE_Y, FEET_EDGE);
    disc_distances(page, &metres);
    disc_distances(page, &feet);
    svg_text(page->svg,
             &(struct svg_label){.x = page->x,
                                 .y = MIDDLE_Y - 50,
                                 .size = 34,
                                 .anchor = SVG_MIDDLE,
                                 .width = 300,
                                 .bold = true},
             page->disc->lens);
    svg_text(page->svg,
             &(struct svg_label){.x = page->x,
                                 .y = MIDDLE_Y + 70,
                                 .size = 24,
                                 .anchor = SVG_MIDDLE,
                                 .width = 300,
                                 .colour = "#444444"},
             page->disc->sharpness);
}

/* -------- the large disc -------- */

/* The marks of one f-number, in the row where there is room; else without a number. */
static void disc_pair(struct disc_page *page, double N, struct disc_row rows[ROWS],
                      struct disc_row *ticks)
{
    static const double bases[ROWS] = {366, 400, 434}, size = 23;
    const struct dof_disc_drawing *disc = page->disc;
    const char *text = disc_number(page->svg->arena, N);
    double near, far;
    dof_turn_limits(disc->f, N, disc->c, disc->P, &near, &far);
    const double at[] = {-page->turn * near, page->turn * far};
    size_t row = 0;
    for (; row < ROWS; row++) {
        const double width = (svg_text_width(text, size) + 8) / bases[row];
        const struct disc_row before[ROWS] = {rows[0], rows[1], rows[2]};
        bool room = disc_claim(&rows[row], at[0], width) && disc_claim(&rows[row], at[1], width);
        /* its ticks pass between the numbers of the rows below */
        for (size_t k = 0; room && k < 2 * row; k++) {
            room = disc_claim(&rows[k / 2], at[k % 2], 6 / bases[0]);
        }
        if (room) {
            break;
        }
        for (size_t k = 0; k < ROWS; k++) {
            rows[k] = before[k];
        }
    }
    if (row == ROWS) {
        page->unnamed = page->unnamed == NULL
                            ? ARENA_JOIN(page->svg->arena, "f/", text)
                            : ARENA_JOIN(page->svg->arena, "f/", text, ", ", page->unnamed);
    }
    for (size_t side = 0; side < 2; side++) {
        if (row == ROWS && !disc_claim(ticks, at[side], 6 / SMALL)) {
            continue;
        }
        disc_tick(page, at[side], SMALL + 2, row == ROWS ? SMALL + 24 : bases[row] - 8);
        if (row < ROWS) {
            disc_text(page, at[side], bases[row], size, DARK, text);
            disc_claim(ticks, at[side], 6 / SMALL);
        }
    }
}

static void disc_draw_large(struct disc_page *page)
{
    const struct dof_disc_drawing *disc = page->disc;
    struct disc_row rows[ROWS] = {{.count = 0}, {.count = 0}, {.count = 0}}, ticks = {.count = 0};
    disc_outline(page, LARGE);
    svg_styled_circle(page->svg, &(struct svg_style){.stroke = GREY, .width = 1.2, .dash = "8 6"},
                      page->x, MIDDLE_Y, SMALL);
    /* the arrow keeps the numbers off */
    disc_claim(&rows[0], 0, 40 / SMALL);
    disc_claim(&rows[1], 0, 30 / SMALL);
    disc_claim(&rows[2], 0, 30 / SMALL);
    svg_group_begin(page->svg, &(struct svg_style){.fill = RED});
    svg_path(page->svg, page->x, MIDDLE_Y - SMALL - 2, "M0 0L16 -34 -16 -34z");
    svg_group_end(page->svg);
    svg_styled_line(page->svg, &(struct svg_style){.stroke = RED, .width = 5}, page->x,
                    MIDDLE_Y - SMALL - 30, page->x, MIDDLE_Y - LARGE + 12);
    svg_group_begin(page->svg, &(struct svg_style){.stroke = DARK, .width = 2.4});
    for (size_t i = disc->fnumber_count; i-- > 0;) {
        disc_pair(page, disc->fnumbers[i], rows, &ticks);
    }
    svg_group_end(page->svg);
    const struct svg_label low = {.x = page->x,
                                  .y = MIDDLE_Y + 384,
                                  .size = 30,
                                  .anchor = SVG_MIDDLE,
                                  .width = 380,
                                  .bold = true};
    svg_text(page->svg, &low, disc->lens);
    svg_words(page->svg, page->x, MIDDLE_Y + 424, 22, SVG_MIDDLE, "#444444", disc->sharpness);
    svg_words(page->svg, page->x, MIDDLE_Y + 200, 24, SVG_MIDDLE, GREY, "near limits left,");
    svg_words(page->svg, page->x, MIDDLE_Y + 232, 24, SVG_MIDDLE, GREY, "far limits right");
    svg_words(page->svg, page->x, MIDDLE_Y - 200, 24, SVG_MIDDLE, GREY, "the small disc lies here");
}

bool dof_disc_draw(const struct dof_disc_drawing *disc, struct svg *svg, struct error *error)
{
    double near, far;
    dof_turn_limits(disc->f, disc->fnumbers[disc->fnumber_count - 1], disc->c, disc->P, &near,
                    &far);
    const double range = dof_turn_place(disc->f, disc->P, disc->nearest);
    struct disc_page page = {.svg = svg, .disc = disc};
    page.turn = fmin(SPAN / range, WIDEST / near);
    if (!(range > 0 && page.turn > 0 && page.turn * range > 0.2)) {
        return fail(error, ERROR_DOMAIN,
                    "a disc has no room for distances from %.4g m on at f/%.4g",
                    disc->nearest / 1000, disc->fnumbers[disc->fnumber_count - 1]);
    }
    svg_begin_mm(svg, DOF_DISC_WIDTH, DOF_DISC_HEIGHT, UNITS, disc->title);
    svg_heading(svg, 60, 80, 44, 1780, disc->title);
    svg_subheading(svg, 60, 118, 27, 1780, NULL);
    page.x = LARGE_X;
    disc_draw_large(&page);
    page.x = SMALL_X;
    disc_draw_small(&page);
    svg_words_within(svg, 60, 1166, 27, 1780, "#222222",
                     "Cut out both discs and pin the small one on the large one. Turn the distance "
                     "in focus to the arrow:");
    svg_words_within(svg, 60, 1204, 27, 1780, "#222222",
                     "what lies between the two marks of an f-number is sharp. Distances from the "
                     "front principal plane.");
    svg_scale_bar(svg, "#000000", 60, 560, 1246);
    svg_words_within(svg, 590, 1256, 27, 1250, "#222222",
                     "50 mm where it is printed in true size (100 %)");
    if (page.unnamed != NULL) {
        svg_words_within(svg, 60, 150, 24, 1780, "#444444",
                         ARENA_JOIN(svg->arena, "no room for the numbers of ", page.unnamed));
    }
    svg_end(svg);
    return true;
}
