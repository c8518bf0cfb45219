/* tests/unit/test_panels.c - many small plots on one page. */
/* SPDX-License-Identifier: MIT */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/arena.h"
#include "base/error.h"
#include "check.h"
#include "draw/panels.h"
#include "draw/svg.h"
#include "draw/ticks.h"

/* How often `word` occurs. */
static int occurrences(const char *text, const char *word)
{
    int count = 0;
    for (const char *at = strstr(text, word); at; at = strstr(at + 1, word)) {
        count++;
    }
    return count;
}

static bool draw(const struct panels *panels, struct arena *arena, struct svg *svg,
                 struct error *error)
{
    *svg = (struct svg){.arena = arena};
    *error = (struct error){0};
    return panels_draw(panels, svg, error);
}

/* The value of an attribute of the first tag at or behind `at`. */
static double attribute(const char *at, const char *name)
{
    const char *found = at ? strstr(at, name) : NULL;
    return found ? strtod(found + strlen(name), NULL) : NAN;
}

/* The path with the curve of a colour: its first words. */
static const char *path_of(const char *svg, const char *colour)
{
    char group[64];
    snprintf(group, sizeof group, "stroke=\"%s\"", colour);
    const char *at = strstr(svg, "clip-path"); /* behind the legend */
    at = at ? strstr(at, group) : NULL;
    at = at ? strstr(at, "<path d=\"") : NULL;
    return at ? at + strlen("<path d=\"") : "";
}

static const double pupil[] = {-1, -0.5, 0, 0.5, 1};
static const double blue[] = {NAN, -2, 0, 2, 8}, *const red = pupil;

static const char *const wavelengths[] = {"486.1 nm", "656.3 nm"};
static const char *const sections[] = {"tangential", "sagittal"};
static const char *const fields[] = {"0°", "14°"};

/* Four panels of two curves: frames, clips, curves, words and the legend are all there. */
static void test_fan(struct arena *arena)
{
    const struct panel_series curves[] = {{pupil, blue, 5, 0, false}, {pupil, red, 5, 1, false}};
    const struct panel panels[] = {{.series = curves, .count = 2},
                                   {.series = curves, .count = 1},
                                   {.series = curves + 1, .count = 1, .note = "half of it <lost>"},
                                   {.note = "no ray arrives"}};
    const struct panels page = {.title = "Ray fan",
                                .subtitle = "f/2",
                                .x_label = "pupil",
                                .y_label = "error (µm)",
                                .column_heads = sections,
                                .row_heads = fields,
                                .keys = wavelengths,
                                .key_count = 2,
                                .light = true,
                                .x_low = -1,
                                .x_high = 1,
                                .columns = 2,
                                .panels = panels,
                                .count = 4};
    struct svg svg;
    struct error error;
    CHECK(draw(&page, arena, &svg, &error));
    CHECK(occurrences(svg.data, "<g ") == occurrences(svg.data, "</g>"));
    CHECK(occurrences(svg.data, "<clipPath") == 3);     /* words alone need none */
    CHECK(occurrences(svg.data, "<rect") == 4 + 3 + 1); /* frames, clips and the page */
    CHECK(occurrences(svg.data, "<path") == 4 + 2);     /* curves, and two in the legend */
    static const char *const words[] = {">Ray fan</text>",
                                        ">f/2</text>",
                                        ">pupil</text>",
                                        ">error (µm)</text>",
                                        ">14°</text>",
                                        ">sagittal</text>",
                                        ">486.1 nm</text>",
                                        ">656.3 nm</text>",
                                        ">−1.0</text>",
                                        ">8</text>",
                                        ">half of it &lt;lost&gt;</text>",
                                        ">no ray arrives</text>"};
    for (size_t i = 0; i < sizeof words / sizeof words[0]; i++) {
        check_at(strstr(svg.data, words[i]) != NULL, __FILE__, __LINE__, words[i]);
    }
    CHECK(occurrences(svg.data, ">8</text>") == 2);    /* once a row */
    CHECK(occurrences(svg.data, ">−1.0</text>") == 2); /* once a column; y goes by twos */
}

/* Shared scales: -1 and 1 lie at the edges of the frame, the greatest value at its upper end. */
static void test_scale(struct arena *arena)
{
    const struct panel_series curve = {pupil, blue, 5, 0, false};
    const struct panel panel = {.series = &curve, .count = 1};
    const struct panels page = {.x_low = -1,
                                .x_high = 1,
                                .y_low = -8,
                                .y_high = 8,
                                .key_count = 1,
                                .columns = 1,
                                .panels = &panel,
                                .count = 1};
    struct svg svg;
    struct error error;
    CHECK(draw(&page, arena, &svg, &error));
    const char *clip = strstr(svg.data, "<clipPath");
    double left = attribute(clip, " x=\"") + 1, top = attribute(clip, " y=\"") + 1;
    double width = attribute(clip, "width=\"") - 2, height = attribute(clip, "height=\"") - 2;
    const char *path = path_of(svg.data, "#0072b2");
    double x, y, end_x = NAN, end_y = NAN;
    CHECK(sscanf(path, "M%lf %lfL%*f %*f %*f %*f %lf %lf", &x, &y, &end_x, &end_y) == 4);
    CHECK_NEAR(x, left + width / 4, 0.01, "x of the first point behind the gap");
    CHECK_NEAR(y, top + height * 10 / 16, 0.01, "its y");
    CHECK_NEAR(end_x, left + width, 0.01, "x of the last point");
    CHECK_NEAR(end_y, top, 0.01, "its y");
}

/* Spots: one dot each, square, a circle, a bar of round length; the legend shows dots. */
static void test_spots(struct arena *arena)
{
    const struct panel_series spots = {blue, pupil, 5, 0, true};
    const struct panel panels[] = {
        {.title = "first", .series = &spots, .count = 1, .circle = 2, .note = "rms 4 µm"},
        {.title = "second", .circle = 2}};
    const char *const key[] = {"587.6 nm"};
    const struct panels page = {.title = "Spots",
                                .unit = "µm",
                                .keys = key,
                                .key_count = 1,
                                .circle_label = "Airy disc",
                                .columns = 2,
                                .panels = panels,
                                .count = 2};
    struct svg svg;
    struct error error;
    CHECK(draw(&page, arena, &svg, &error));
    CHECK(occurrences(svg.data, "h0") == 4 + 1);
    CHECK(occurrences(svg.data, "<circle") == 1 + 1); /* of the panel with points, of the legend */
    CHECK(strstr(svg.data, ">5 µm</text>") != NULL);
    CHECK(strstr(svg.data, ">Airy disc</text>") != NULL);
    CHECK(strstr(svg.data, ">rms 4 µm</text>") != NULL);
    const char *clip = strstr(svg.data, "<clipPath"), *circle = strstr(clip, "<circle");
    double width = attribute(clip, "width=\"") - 2, height = attribute(clip, "height=\"") - 2;
    CHECK_NEAR(width, height, 1e-9, "a square panel");
    CHECK_NEAR(attribute(circle, " r=\"") / width, 2 / (2 * 1.06 * 8), 1e-3, "radius of the disc");
    CHECK_NEAR(attribute(circle, " cx=\""), attribute(clip, " x=\"") + 1 + width / 2, 0.01,
               "centre of the disc");
}

/* Spots of two colours that lie on one another take turns, and the last is not always the same. */
static void test_turns(struct arena *arena)
{
    enum { MANY = 480 };
    double x[MANY], y[MANY];
    for (size_t i = 0; i < MANY; i++) {
        x[i] = y[i] = (double)(i % 7);
    }
    const struct panel_series both[] = {{x, y, MANY, 0, true}, {x, y, MANY, 1, true}};
    const struct panel panels[] = {{.series = both, .count = 2}, {.is_absent = true}};
    static const char *const captions[] = {"a lens: f/2"};
    const struct panels page = {.unit = "µm",
                                .row_captions = captions,
                                .key_count = 2,
                                .columns = 2,
                                .panels = panels,
                                .count = 2};
    struct svg svg;
    struct error error;
    CHECK(draw(&page, arena, &svg, &error));
    CHECK(occurrences(svg.data, "h0") == 2 * MANY);
    CHECK(occurrences(svg.data, "<clipPath") == 1); /* nothing is drawn of the absent one */
    CHECK(strstr(svg.data, ">a lens: f/2</text>") != NULL);
    const char *at = strstr(svg.data, "clip-path");
    char last = '\0';
    int turns = 0;
    for (at = strstr(at, "stroke=\"#"); at != NULL; at = strstr(at + 1, "stroke=\"#")) {
        const char colour = at[strlen("stroke=\"#00")];
        turns += colour != last;
        last = colour;
    }
    CHECK(turns > 10);
}

/* Two of a hundred far off are left outside, three are not; a few values all count. */
static void test_bulk(void)
{
    static const double reaches[] = {1, 1.3 * 0.99, 1.3, 9};
    double values[100];
    for (size_t far = 0; far < 4; far++) {
        for (size_t i = 0; i < 100; i++) {
            values[i] = i < far ? 9 : (double)(i + 1) / 100;
        }
        const double expected = reaches[far];
        CHECK_NEAR(ticks_reach(values, 100), expected, 1e-12, "reach of the bulk");
    }
    double few[] = {9, 0.5, 1};
    CHECK_NEAR(ticks_reach(few, 3), 9, 1e-12, "reach of a few");
    CHECK_NEAR(ticks_reach(few, 0), 0, 1e-12, "reach of none");
}

/* An axis of its own: numbers of 1 and of 1000 stand under their own panels. */
static void test_own(struct arena *arena)
{
    static const double wide[] = {-1000, -500, 0, 500, 1000};
    const struct panel_series small = {pupil, pupil, 5, 0, false},
                              great = {wide, pupil, 5, 0, false};
    const struct panel panels[] = {{.series = &small, .count = 1, .x_label = "mm"},
                                   {.series = &great, .count = 1, .x_label = "%"}};
    const struct panels page = {
        .own_x = true, .key_count = 1, .columns = 2, .panels = panels, .count = 2};
    struct svg svg;
    struct error error;
    CHECK(draw(&page, arena, &svg, &error));
    CHECK(occurrences(svg.data, ">1000</text>") == 1);
    CHECK(strstr(svg.data, ">mm</text>") != NULL && strstr(svg.data, ">%</text>") != NULL);
    CHECK(strstr(svg.data, ">−0.5</text>") != NULL);
}

static void test_errors(struct arena *arena)
{
    static const double far[] = {1e13, 0, 0, 0, 0};
    const struct panel_series lost = {pupil, blue, 1, 0, false}, beyond = {far, far, 5, 0, false};
    const struct panel empty = {.series = &lost, .count = 1},
                       distant = {.series = &beyond, .count = 1};
    struct panels page = {.key_count = 1, .columns = 1, .panels = &empty, .count = 1};
    struct svg svg;
    struct error error;
    CHECK(!draw(&page, arena, &svg, &error) && error.code == ERROR_DOMAIN);
    page.panels = &distant;
    CHECK(!draw(&page, arena, &svg, &error) && error.code == ERROR_DOMAIN);
    page.count = 401;
    CHECK(!draw(&page, arena, &svg, &error) && error.code == ERROR_USAGE);
    page.count = page.columns = 21;
    CHECK(!draw(&page, arena, &svg, &error) && error.code == ERROR_USAGE);
}

int main(void)
{
    struct arena arena = {0};
    test_fan(&arena);
    test_scale(&arena);
    test_spots(&arena);
    test_turns(&arena);
    test_bulk();
    test_own(&arena);
    test_errors(&arena);
    arena_free(&arena);
    return check_report();
}
