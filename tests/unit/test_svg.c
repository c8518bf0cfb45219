/* tests/unit/test_svg.c - SVG writer, plots and barrel scales. */
/* SPDX-License-Identifier: MIT */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/arena.h"
#include "base/error.h"
#include "check.h"
#include "draw/barrel.h"
#include "draw/plot.h"
#include "draw/svg.h"
#include "draw/ticks.h"

/* -------- reading drawings -------- */

#define DEPTH 32

static bool is_name(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '-' || c == ':' ||
           (c >= '0' && c <= '9');
}

static size_t name_length(const char *at)
{
    size_t length = 0;
    while (is_name(at[length])) {
        length++;
    }
    return length;
}

/* Behind the attributes of a tag: at '>' or '/'. Null if one is malformed or written twice. */
static const char *skip_attributes(const char *at)
{
    const char *names[DEPTH];
    size_t count = 0;
    while (*at == ' ') {
        size_t length = name_length(++at);
        for (size_t i = 0; i < count; i++) {
            if (name_length(names[i]) == length && strncmp(names[i], at, length) == 0) {
                return NULL;
            }
        }
        if (length == 0 || count == DEPTH || strncmp(at + length, "=\"", 2) != 0) {
            return NULL;
        }
        names[count++] = at;
        at = strchr(at + length + 2, '"');
        if (!at) {
            return NULL;
        }
        at++;
    }
    return at;
}

static bool is_entity(const char *at)
{
    return !strncmp(at, "&amp;", 5) || !strncmp(at, "&lt;", 4) || !strncmp(at, "&gt;", 4) ||
           !strncmp(at, "&quot;", 6);
}

/* Tags nest, attributes are quoted and single, '&' begins an entity. */
static bool well_formed(const char *text)
{
    const char *open[DEPTH];
    size_t depth = 0, roots = 0;
    const char *at = strchr(text, '\n'); /* behind the declaration */
    for (at = at ? at : text; *at; at++) {
        if (*at == '&' && !is_entity(at)) {
            return false;
        }
        if (*at != '<') {
            continue;
        }
        bool closing = at[1] == '/';
        at += closing ? 2 : 1;
        size_t length = name_length(at);
        if (closing) {
            if (depth == 0 || name_length(open[depth - 1]) != length ||
                strncmp(open[--depth], at, length) != 0 || at[length] != '>') {
                return false;
            }
            continue;
        }
        roots += depth == 0;
        if (length == 0 || depth == DEPTH) {
            return false;
        }
        open[depth++] = at;
        at = skip_attributes(at + length);
        if (!at || (*at != '>' && strncmp(at, "/>", 2) != 0)) {
            return false;
        }
        depth -= *at == '/';
    }
    return depth == 0 && roots == 1;
}

/* Does an attribute hold `word`? Titles and labels may. */
static bool in_a_tag(const char *text, const char *word)
{
    for (const char *at = strchr(text, '<'); at; at = strchr(at + 1, '<')) {
        const char *found = strstr(at, word), *end = strchr(at, '>');
        if (found && end && found < end) {
            return true;
        }
    }
    return false;
}

/* The number behind the next `name="` within the tag at `tag`; NaN if it has none. */
static double attribute(const char *tag, const char *name)
{
    const char *at = strstr(tag, name), *end = strchr(tag, '>');
    return at && end && at < end ? strtod(at + strlen(name), NULL) : NAN;
}

static bool between(double x, double low, double high)
{
    return isnan(x) || (x >= low && x <= high);
}

static bool path_inside(const char *words, double width, double height)
{
    bool inside = true, is_x = true;
    for (const char *at = words; *at && *at != '"';) {
        char *end;
        double x = strtod(at, &end);
        if (end == at) {
            at++;
            continue;
        }
        inside = inside && between(x, 0, is_x ? width : height);
        is_x = !is_x;
        at = end;
    }
    return inside;
}

/* Every line, circle, rectangle, text and absolute path lies on the page. */
static bool all_inside(const char *text, double width, double height)
{
    static const char *const across[] = {" x=\"", " x1=\"", " x2=\"", " cx=\""};
    static const char *const down[] = {" y=\"", " y1=\"", " y2=\"", " cy=\""};
    for (const char *tag = strchr(text, '<'); tag; tag = strchr(tag + 1, '<')) {
        for (size_t i = 0; i < 4; i++) {
            if (!between(attribute(tag, across[i]), 0, width) ||
                !between(attribute(tag, down[i]), 0, height)) {
                return false;
            }
        }
        if (!strncmp(tag, "<path d=\"", 9) && strchr(tag, '"')[1] == 'M' && !strstr(tag, "h0\"") &&
            !path_inside(tag + 9, width, height)) {
            return false;
        }
    }
    return true;
}

/* The tag of the n-th text that reads exactly `words`. */
static const char *find_text(const char *text, const char *words, int n)
{
    for (const char *tag = strstr(text, "<text"); tag; tag = strstr(tag + 1, "<text")) {
        const char *start = strchr(tag, '>') + 1;
        if (!strncmp(start, words, strlen(words)) && start[strlen(words)] == '<' && n-- == 0) {
            return tag;
        }
    }
    return NULL;
}

static double text_x(const char *text, const char *words, int n)
{
    const char *tag = find_text(text, words, n);
    return tag ? attribute(tag, " x=\"") : NAN;
}

static void check_drawing(const struct svg *svg, double width, double height)
{
    CHECK(well_formed(svg->data));
    CHECK(strlen(svg->data) == svg->length);
    CHECK(!in_a_tag(svg->data, "nan"));
    CHECK(!in_a_tag(svg->data, "inf"));
    CHECK(!in_a_tag(svg->data, "e+"));
    CHECK(!in_a_tag(svg->data, "-0\""));
    CHECK(all_inside(svg->data, width, height));
}

/* -------- the writer -------- */

static void test_checker(void)
{
    CHECK(well_formed("<?xml?>\n<a><b c=\"1\" d=\"2\"/>&lt;</a>\n"));
    CHECK(!well_formed("<?xml?>\n<a><b></a></b>\n"));
    CHECK(!well_formed("<?xml?>\n<a b=\"1\" b=\"2\"/>\n"));
    CHECK(!well_formed("<?xml?>\n<a>&</a>\n"));
    CHECK(!well_formed("<?xml?>\n<a>\n"));
    CHECK(in_a_tag("<a b=\"nan\"/>", "nan") && !in_a_tag("<a>nan</a>", "nan"));
    CHECK(!all_inside("<line x1=\"5\"/><line x1=\"11\"/>", 10, 10));
    CHECK(!all_inside("<path d=\"M1 2L3 11\"/>", 10, 10));
}

static void test_text(struct arena *arena)
{
    static const struct {
        const char *given, *written;
    } cases[] = {
        {"a<b & \"c\">d", ">a&lt;b &amp; &quot;c&quot;&gt;d</text>"},
        {"5 \xc2\xb5m \xe2\x88\x9e", ">5 \xc2\xb5m \xe2\x88\x9e</text>"},
        {"bell\a", ">bell?</text>"},
        {"latin \xb5m", ">latin ?m</text>"},
        {"cut \xe2\x88", ">cut ?"
                         "?</text>"},
        {"overlong \xc0\xaf", ">overlong ?"
                              "?</text>"},
        {"surrogate \xed\xa0\x80", ">surrogate ?"
                                   "?"
                                   "?</text>"},
        {"no character \xef\xbf\xbf", ">no character ?</text>"},
    };
    for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
        struct svg svg = {.arena = arena};
        svg_begin(&svg, 100, 50, cases[i].given);
        svg_text(&svg, &(struct svg_label){.x = 1, .y = 2, .size = 10}, cases[i].given);
        svg_end(&svg);
        CHECK(well_formed(svg.data));
        if (strstr(cases[i].given, "no character")) {
            CHECK(strstr(svg.data, "\xef\xbf\xbf") == NULL);
        } else {
            CHECK(strstr(svg.data, cases[i].written) != NULL);
        }
    }
}

static void test_long_text(struct arena *arena)
{
    struct svg svg = {.arena = arena};
    struct svg_label label = {.x = 1, .y = 2, .size = 10, .width = 60};
    svg_text(&svg, &label,
             "\xc3\xa4\xc3\xa4\xc3\xa4\xc3\xa4\xc3\xa4\xc3\xa4\xc3\xa4\xc3\xa4"
             "\xc3\xa4\xc3\xa4\xc3\xa4\xc3\xa4");
    CHECK(strstr(svg.data, "\xc3\xa4\xe2\x80\xa6</text>") != NULL);
    CHECK(strchr(svg.data, '?') == NULL);
    CHECK(svg_text_width("12", 10) < svg_text_width("123", 10));
    CHECK_NEAR(svg_text_width("12", 20), 2 * svg_text_width("12", 10), 1e-12, "width of text");
}

static void test_numbers(struct arena *arena)
{
    struct svg svg = {.arena = arena};
    svg_line(&svg, 1.0 / 3, -0.001, 2.5, 1e9);
    CHECK_TEXT(svg.data, "<line x1=\"0.33\" y1=\"0\" x2=\"2.5\" y2=\"1000000\"/>\n");
    size_t length = svg.length;
    svg_line(&svg, NAN, 0, 0, 0);
    svg_circle(&svg, 0, INFINITY, 1);
    svg_rect(&svg, 0, 0, -1, 1);
    svg_path(&svg, 0, NAN, "M0 0");
    svg_text(&svg, &(struct svg_label){.x = -INFINITY, .size = 1}, "x");
    svg_polyline(&svg, NULL, NULL, 0);
    CHECK(svg.length == length);
}

static void test_polyline(struct arena *arena)
{
    const double x[] = {NAN, 0, 1, 2, 3, 4, 5, 6};
    const double y[] = {0, 0, 1, INFINITY, 3, NAN, 5, 6};
    struct svg line = {.arena = arena}, area = {.arena = arena};
    svg_polyline(&line, x, y, 8);
    CHECK_TEXT(line.data, "<path d=\"M0 0L1 1M3 3h0M5 5L6 6\"/>\n");
    svg_polygon(&area, x, y, 3);
    CHECK_TEXT(area.data, "<path d=\"M0 0L1 1z\"/>\n");
}

static void test_groups(struct arena *arena)
{
    struct svg svg = {.arena = arena};
    svg_begin(&svg, 100, 50, NULL);
    svg_group_begin(&svg, &(struct svg_style){.stroke = "#123456", .dash = "3 2", .width = 1.5});
    for (int i = 0; i < 2; i++) {
        svg_clip_begin(&svg, 1, 2, 3, 4);
        svg_circle(&svg, 2, 3, 1);
        svg_group_end(&svg);
    }
    svg_path(&svg, 10, 10, "M0 0L1 1z");
    svg_group_end(&svg);
    svg_end(&svg);
    check_drawing(&svg, 100, 50);
    const char *first = strstr(svg.data, "id=\"clip");
    const char *second = strstr(first + 1, "id=\"clip");
    CHECK(strtod(first + 8, NULL) < strtod(second + 8, NULL));
}

/* -------- ticks -------- */

static void check_plot(struct arena *arena, const struct plot *plot)
{
    struct svg once = {.arena = arena}, twice = {.arena = arena};
    struct error error;
    CHECK(plot_draw(plot, &once, &error));
    CHECK(plot_draw(plot, &twice, &error));
    CHECK_TEXT(twice.data, once.data);
    check_drawing(&once, PLOT_WIDTH, PLOT_HEIGHT);
}

static void test_odd_values(struct arena *arena)
{
    static const double values[][4] = {
        {5, 5, 5, 5},
        {0, 0, 0, 0},
        {1e-12, 1, 1e6, 1e18},
        {-3, -2, NAN, -1},
        {1, INFINITY, 2, -INFINITY},
        {INFINITY, INFINITY, 3, NAN},
        {NAN, 1e-320, 1, 0},
        {1e308, -1e308, 1, 2},
        {-1e18, 1e18, 1e-12, 0},
    };
    static const double x[] = {1, 2, 4, 8};
    for (size_t i = 0; i < sizeof(values) / sizeof(values[0]); i++) {
        const struct plot_series series[] = {{.label = "a", .y = values[i], .style = i},
                                             {.y = values[0], .style = i + 1}};
        const struct plot_band band = {0, 1};
        for (int axes = 0; axes < 4; axes++) {
            struct plot plot = {.title = "nan & inf",
                                .x = x,
                                .count = 4,
                                .series = series,
                                .series_count = 2,
                                .bands = &band,
                                .band_count = 1,
                                .log_x = axes & 1,
                                .log_y = axes & 2};
            check_plot(arena, &plot); /* never empty, because of the second series */
            plot.count = 1;
            check_plot(arena, &plot);
        }
    }
}

static void test_nothing(struct arena *arena)
{
    static const double x[] = {1, 2}, y[] = {NAN, INFINITY};
    const struct plot_series series = {.label = "far", .y = y};
    struct plot plot = {.x = x, .count = 2, .series = &series, .series_count = 1};
    struct svg svg = {.arena = arena};
    struct error error;
    CHECK(!plot_draw(&plot, &svg, &error));
    CHECK(error.code == ERROR_DOMAIN);
    plot.series_count = 0;
    CHECK(!plot_draw(&plot, &svg, &error));
}

/* An infinite stretch gets one arrow, at the last finite x. */
static void test_infinite(struct arena *arena)
{
    static const double x[] = {0, 1, 2, 3, 4}, y[] = {1, 2, 4, INFINITY, INFINITY};
    const struct plot_series series = {.label = "far", .y = y};
    struct plot plot = {.x = x, .count = 5, .series = &series, .series_count = 1};
    struct svg svg = {.arena = arena};
    struct error error;
    CHECK(plot_draw(&plot, &svg, &error));
    double left = text_x(svg.data, "0", 0), right = text_x(svg.data, "4.0", 0);
    const double half = svg_text_width("∞", 16) / 2;
    CHECK_NEAR(text_x(svg.data, "∞", 0) + half, (left + right) / 2, 0.011, "x of the arrow");
    CHECK(find_text(svg.data, "∞", 1) == NULL);
}

/* A value far above the rest does not flatten it: its arrow at the edge says how far. */
static void test_far(struct arena *arena)
{
    static const double x[] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10};
    double y[] = {-1, 1, 2, 3, 900, 4, 3, 2, 1, 0, 1};
    const struct plot_series series = {.label = "far", .y = y};
    struct plot plot = {.x = x, .count = 11, .series = &series, .series_count = 1};
    struct error error;
    plot_choose_axes(&plot);
    CHECK(plot.is_limited && plot.y_most < 10 && plot.y_least <= -1);
    struct svg svg = {.arena = arena};
    CHECK(plot_draw(&plot, &svg, &error));
    CHECK(find_text(svg.data, "900", 0) != NULL && find_text(svg.data, "900", 1) == NULL);
    CHECK(find_text(svg.data, "5", 0) != NULL || find_text(svg.data, "6", 0) != NULL);
    for (size_t i = 0; i < 11; i++) {
        y[i] = -y[i];
    }
    plot_choose_axes(&plot);
    struct svg lower = {.arena = arena};
    CHECK(plot.is_limited && plot.y_least > -10);
    CHECK(plot_draw(&plot, &lower, &error) && find_text(lower.data, "−900", 0) != NULL);
    y[4] = -12; /* this far the axis reaches */
    plot_choose_axes(&plot);
    CHECK(!plot.is_limited);
}

/* A curve by itself needs no label; of several, those that have one label have it once. */
static void test_labels(struct arena *arena)
{
    static const double x[] = {0, 1, 2}, a[] = {0, 1, 2}, b[] = {0, 2, 4}, c[] = {0, 3, 9};
    struct plot_series series[] = {{.label = "one", .y = a},
                                   {.label = "one", .y = c},
                                   {.label = "two", .y = b, .style = 1},
                                   {.label = "two", .y = c, .style = 1}};
    struct plot plot = {.x = x, .count = 3, .series = series, .series_count = 1};
    struct error error;
    struct svg alone = {.arena = arena}, both = {.arena = arena};
    CHECK(plot_draw(&plot, &alone, &error) && find_text(alone.data, "one", 0) == NULL);
    plot.series_count = 4;
    CHECK(plot_draw(&plot, &both, &error));
    CHECK(find_text(both.data, "one", 0) != NULL && find_text(both.data, "one", 1) == NULL);
    CHECK(find_text(both.data, "two", 0) != NULL && find_text(both.data, "two", 1) == NULL);
}

/* A million points become at most 2000, and a single peak among them is kept. */
static void test_million(struct arena *arena)
{
    const size_t count = 1000000;
    double *x = ARENA_ARRAY(arena, count, double), *y = ARENA_ARRAY(arena, count, double);
    for (size_t i = 0; i < count; i++) {
        x[i] = (double)i;
        y[i] = i % 2 == 0 ? 0.25 : -0.25;
    }
    y[654321] = 1;
    const struct plot_series series = {.y = y};
    struct plot plot = {.x = x, .count = count, .series = &series, .series_count = 1};
    check_plot(arena, &plot);
    struct svg svg = {.arena = arena};
    struct error error;
    CHECK(plot_draw(&plot, &svg, &error));
    CHECK(svg.length < 2000 * 15 + 8000);
    CHECK(strstr(svg.data, " 88 ") != NULL); /* the upper edge of the frame is at 88 px */
}

static void test_choose_axes(void)
{
    static const double x[] = {1, 10, 51}, y[] = {1, 49, INFINITY}, z[] = {-1, 60, NAN};
    struct plot_series series = {.label = "y", .y = y};
    struct plot plot = {.x = x, .count = 3, .series = &series, .series_count = 1};
    plot_choose_axes(&plot);
    CHECK(plot.log_x && !plot.log_y);
    series.y = z;
    plot_choose_axes(&plot);
    CHECK(!plot.log_x && !plot.log_y); /* the third x has no y */
    series.y = x;
    plot_choose_axes(&plot);
    CHECK(plot.log_x && plot.log_y);
}

/* -------- barrel scales -------- */

/* Marks at focus +- width * N, in 1/m. */
static struct barrel make_barrel(struct barrel_mark marks[7], double focus, double width)
{
    static const double fnumbers[] = {2.8, 4, 5.6, 8, 11, 16, 22};
    for (size_t i = 0; i < 7; i++) {
        marks[i] = (struct barrel_mark){fnumbers[i], focus + width * fnumbers[i],
                                        focus - width * fnumbers[i]};
    }
    return (struct barrel){
        .title = "50 mm", .focus_diopter = focus, .marks = marks, .mark_count = 7, .chosen = 3};
}

/* x of every number on the scale follows one straight line in 1/distance. */
static void test_positions(struct arena *arena)
{
    static const struct {
        const char *text;
        int which; /* of the texts that read so */
        double diopter;
    } cases[] = {
        {"5", 0, 1 / 5.0},
        {"20", 1, 1 / 20.0},
        {"20", 0, 1 / (20 * 0.3048)},
        {"30", 0, 1 / (30 * 0.3048)},
        {"22", 0, 1 / 3.0 + 0.2508},
        {"22", 1, 1 / 3.0 - 0.2508},
        {"8", 1, 1 / 3.0 + 0.0912},
        {"8", 2, 1 / 3.0 - 0.0912},
        {"0.3", 0, 0.3},
        {"0.6", 0, 0.6},
    };
    struct barrel_mark marks[7];
    struct barrel barrel = make_barrel(marks, 1 / 3.0, 0.0114);
    struct svg svg = {.arena = arena};
    struct error error;
    CHECK(barrel_draw(&barrel, &svg, &error));
    check_drawing(&svg, BARREL_WIDTH, BARREL_HEIGHT);
    double infinity_x = text_x(svg.data, "\xe2\x88\x9e", 0);
    double slope = (text_x(svg.data, "0.5", 0) - infinity_x) / 0.5;
    CHECK(slope < 0);
    for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
        CHECK_NEAR(text_x(svg.data, cases[i].text, cases[i].which),
                   infinity_x + slope * cases[i].diopter, 0.03, cases[i].text);
    }
}

/* No two numbers of a row overlap, were they as narrow as Helvetica's (0.55 em a character). */
static void check_apart(const char *text)
{
    struct {
        double from, to, y;
    } seen[64];
    size_t count = 0;
    for (const char *tag = strstr(text, "<text"); tag; tag = strstr(tag + 1, "<text")) {
        double length = (double)strcspn(strchr(tag, '>') + 1, "<");
        double half = 0.55 * 15 * length / 2, x = attribute(tag, " x=\"");
        if (!(fabs(attribute(tag, "font-size=\"") - 15) < 0.1) || count == 64) {
            continue;
        }
        const char *anchor = strstr(tag, "text-anchor=\"");
        bool anchored = anchor && anchor < strchr(tag, '>');
        x += !anchored ? half : anchor[13] == 'e' ? -half : 0;
        seen[count].from = x - half;
        seen[count].to = x + half;
        seen[count++].y = attribute(tag, " y=\"");
    }
    for (size_t i = 0; i < count; i++) {
        for (size_t k = 0; k < i; k++) {
            CHECK(fabs(seen[i].y - seen[k].y) > 1 || seen[i].from >= seen[k].to ||
                  seen[i].to <= seen[k].from);
        }
    }
}

static void test_barrels(struct arena *arena)
{
    for (double focus = 0; focus < 3; focus += 0.37) {
        for (double width = 1e-5; width < 1; width *= 7) {
            for (size_t chosen = 0; chosen < 7; chosen++) {
                struct barrel_mark marks[7];
                struct barrel barrel = make_barrel(marks, focus, width);
                struct svg svg = {.arena = arena};
                struct error error;
                barrel.chosen = chosen;
                barrel.nearest_diopter = chosen % 2 == 0 ? 0 : 3;
                CHECK(barrel_draw(&barrel, &svg, &error));
                check_drawing(&svg, BARREL_WIDTH, BARREL_HEIGHT);
                check_apart(svg.data);
            }
        }
    }
}

static void test_refused_barrels(struct arena *arena)
{
    struct barrel_mark marks[7];
    struct svg svg = {.arena = arena};
    struct error error;
    struct barrel barrel = make_barrel(marks, 0.3, 0.01);
    barrel.chosen = 7;
    CHECK(!barrel_draw(&barrel, &svg, &error) && error.code == ERROR_DOMAIN);
    barrel = make_barrel(marks, 0.3, 0.01);
    barrel.nearest_diopter = 0.2;
    CHECK(!barrel_draw(&barrel, &svg, &error));
    barrel = make_barrel(marks, NAN, 0.01);
    CHECK(!barrel_draw(&barrel, &svg, &error));
    barrel = make_barrel(marks, 0.3, 0.01);
    marks[2].far_diopter = 0.4;
    CHECK(!barrel_draw(&barrel, &svg, &error));
    barrel = make_barrel(marks, 0.3, 0.01);
    marks[2].near_diopter = INFINITY;
    CHECK(!barrel_draw(&barrel, &svg, &error));
    CHECK(svg.length == 0);
}

int main(void)
{
    struct arena arena = {0};
    test_checker();
    test_text(&arena);
    test_long_text(&arena);
    test_numbers(&arena);
    test_polyline(&arena);
    test_groups(&arena);
    test_odd_values(&arena);
    test_nothing(&arena);
    test_infinite(&arena);
    test_far(&arena);
    test_labels(&arena);
    test_million(&arena);
    test_choose_axes();
    test_positions(&arena);
    test_barrels(&arena);
    test_refused_barrels(&arena);
    arena_free(&arena);
    return check_report();
}
