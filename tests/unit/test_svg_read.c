/* tests/unit/test_svg_read.c - shapes read from SVG; where they lie is plain geometry. */
/* SPDX-License-Identifier: MIT */
#include "check.h"

#include "draw/terminal/cells.h"
#include "draw/terminal/page.h"
#include "draw/terminal/svg_read.h"

#include <math.h>
#include <string.h>

#define HEAD "<svg width=\"100\" height=\"50\" fill=\"none\">"

/* The only shape of a drawing. */
static struct svg_shape shape_of(const char *body, struct arena *arena)
{
    struct svg_reader reader;
    struct svg_shape shape = {.count = 0}, other;
    char drawing[1024];
    snprintf(drawing, sizeof drawing, "%s%s</svg>", HEAD, body);
    svg_read_begin(&reader, text_of(arena_string(arena, drawing, strlen(drawing))), arena);
    CHECK(svg_read(&reader, &shape));
    CHECK(!svg_read(&reader, &other));
    CHECK_NEAR(reader.width, 100, 0, "width");
    CHECK_NEAR(reader.height, 50, 0, "height");
    return shape;
}

/* Its points are those of a list of x and y. */
static void check_points(const char *body, const double *points, size_t count, struct arena *arena)
{
    const struct svg_shape shape = shape_of(body, arena);
    check_at(shape.count == count, __FILE__, __LINE__, body);
    for (size_t i = 0; i < shape.count && shape.count == count; i++) {
        if (isnan(points[2 * i])) {
            check_at(isnan(shape.x[i]), __FILE__, __LINE__, body);
        } else {
            CHECK_NEAR(shape.x[i], points[2 * i], 1e-9, body);
            CHECK_NEAR(shape.y[i], points[2 * i + 1], 1e-9, body);
        }
    }
}

#define POINTS(body, ...)                                                                          \
    check_points((body), (const double[]){__VA_ARGS__},                                            \
                 sizeof((const double[]){__VA_ARGS__}) / (2 * sizeof(double)), arena)

static void test_places(struct arena *arena)
{
    POINTS("<line x1=\"1\" y1=\"2\" x2=\"-3.5\" y2=\"4e1\"/>", 1, 2, -3.5, 40);
    POINTS("<rect x=\"1\" y=\"2\" width=\"3\" height=\"4\"/>", 1, 2, 4, 2, 4, 6, 1, 6, 1, 2);
    POINTS("<path d=\"M1 2L3 4 5 6M7,8h0\"/>", 1, 2, 3, 4, 5, 6, NAN, NAN, 7, 8, 7, 8);
    POINTS("<path d=\"m1 2 3 4l-1-1H9v2z\"/>", 1, 2, 4, 6, 3, 5, 9, 5, 9, 7, 1, 2);
    POINTS("<path d=\"M1 1V3h-1A5 5 0 0 1 8 9a5 5 0 0 1 1 2\"/>", 1, 1, 1, 3, 0, 3, 8, 9, 9, 11);
    POINTS("<path transform=\"translate(10 20)\" d=\"M0 0L6 11\"/>", 10, 20, 16, 31);
    POINTS("<g transform=\"translate(10 20) scale(2)\"><line x1=\"1\" y1=\"1\" x2=\"0\" "
           "y2=\"3\"/></g>",
           12, 22, 10, 26);
    POINTS("<line transform=\"rotate(90 10 20)\" x1=\"10\" y1=\"20\" x2=\"15\" y2=\"20\"/>", 10, 20,
           10, 25);
    POINTS("<line transform=\"matrix(0 1 -1 0 5 6)\" x1=\"1\" y1=\"2\" x2=\"0\" y2=\"0\"/>", 3, 7,
           5, 6);
    /* a cubic curve ends where it says, and is half way where de Casteljau has it */
    struct svg_shape shape = shape_of("<path d=\"M0 0C0 8 8 8 8 0\"/>", arena);
    CHECK_NEAR(shape.x[shape.count / 2], 4, 1e-9, "cubic: x half way");
    CHECK_NEAR(shape.y[shape.count / 2], 6, 1e-9, "cubic: y half way");
    shape = shape_of("<path d=\"M0 0q4 8 8 0\"/>", arena);
    CHECK_NEAR(shape.x[shape.count / 2], 4, 1e-9, "quadratic: x half way");
    CHECK_NEAR(shape.y[shape.count / 2], 4, 1e-9, "quadratic: y half way");
    CHECK_NEAR(shape.x[shape.count - 1], 8, 1e-9, "quadratic: its end");
    shape = shape_of("<circle cx=\"5\" cy=\"6\" r=\"2\"/>", arena);
    for (size_t i = 0; i < shape.count; i++) {
        CHECK_NEAR(hypot(shape.x[i] - 5, shape.y[i] - 6), 2, 1e-9, "a circle");
    }
}

static void test_styles(struct arena *arena)
{
    struct svg_shape shape = shape_of(
        "<g fill=\"#08f\" stroke=\"none\" opacity=\"0.5\"><g stroke=\"#ff8000\" "
        "stroke-dasharray=\"6 4\" opacity=\"0.5\"><rect width=\"1\" height=\"1\"/></g></g>",
        arena);
    CHECK_NEAR(shape.opacity, 0.25, 1e-12, "opacity of groups");
    CHECK(shape.is_dashed && !shape.stroke.is_none && !shape.fill.is_none);
    CHECK_NEAR(shape.stroke.part[1], 128 / 255.0, 1e-12, "green of the stroke");
    CHECK_NEAR(shape.fill.part[1], 136 / 255.0, 1e-12, "green of the fill");
    shape =
        shape_of("<clipPath id=\"a\"><rect x=\"1\" y=\"2\" width=\"3\" height=\"4\"/></clipPath>"
                 "<g clip-path=\"url(#a)\"><line x1=\"0\" x2=\"9\"/></g>",
                 arena);
    CHECK_NEAR(shape.clip.left, 1, 0, "clip");
    CHECK_NEAR(shape.clip.right, 4, 0, "clip");
    CHECK_NEAR(shape.clip.top, 2, 0, "clip");
    CHECK_NEAR(shape.clip.bottom, 6, 0, "clip");
    shape =
        shape_of("<text x=\"3\" y=\"4\" font-size=\"14\" text-anchor=\"end\" font-weight=\"bold\" "
                 "transform=\"rotate(-90 3 4)\">a &lt;&amp; n<tspan dy=\"2\">d</tspan></text>",
                 arena);
    CHECK(shape.kind == SVG_SHAPE_WORDS && text_equal(shape.words, "a <& nd"));
    CHECK(shape.anchor == 1 && shape.is_bold);
    CHECK_NEAR(shape.turn, -90, 1e-9, "turn of words");
    CHECK_NEAR(shape.size, 14, 0, "size of words");
}

/* Braille's dots by their numbers (Unicode, U+2800): 1 2 3 7 on the left, 4 5 6 8 on the right. */
static void test_cells(struct arena *arena)
{
    struct cells cells;
    struct text_buffer lines = {.arena = arena};
    const struct cell_ink red = {.is_set = true, .part = {255, 0, 0}}, none = {.is_set = false};
    cells_new(&cells, 4, 3, CELL_PLAIN, arena);
    cells_dot(&cells, 0, 0, true, NULL); /* 1 */
    cells_dot(&cells, 1, 3, true, NULL); /* 8 */
    cells_dot(&cells, 3, 1, true, NULL); /* 5 */
    cells_dot(&cells, 2, 2, true, NULL); /* 3, and not */
    cells_dot(&cells, 2, 2, false, NULL);
    cells_dot(&cells, -1, 0, true, NULL);
    cells_dot(&cells, 8, 0, true, NULL);
    cells_write(&cells, 2, 2, text_of("x\033\xe4\xb8\xad"), false, &none);
    CHECK(cells_are_free(&cells, 2, 0, 2, true) && !cells_are_free(&cells, 1, 0, 1, true));
    CHECK(cells_are_free(&cells, 1, 0, 1, false) && !cells_are_free(&cells, 2, 2, 1, false));
    CHECK(!cells_are_free(&cells, 3, 0, 2, false));
    cells_put(&cells, &lines);
    CHECK_TEXT(arena_string(arena, lines.data, lines.length), "⢁⠐\n\n  x?\n");
    struct text_buffer coloured = {.arena = arena};
    cells_new(&cells, 3, 1, CELL_TRUE, arena);
    cells_dot(&cells, 0, 0, true, &red);
    cells_dot(&cells, 4, 0, true, &red); /* behind a letter */
    cells_write(&cells, 2, 0, text_of("b"), true, &none);
    cells_put(&cells, &coloured);
    CHECK_TEXT(arena_string(arena, coloured.data, coloured.length),
               "\033[38;2;255;0;0m⠁ \033[0m\033[1mb\033[0m\n");
    struct text_buffer few = {.arena = arena};
    cells_new(&cells, 1, 1, CELL_256, arena);
    cells_dot(&cells, 0, 0, true, &red);
    cells_put(&cells, &few);
    /* xterm's cube: 16 + 36 x 5 */
    CHECK_TEXT(arena_string(arena, few.data, few.length), "\033[38;5;196m⠁\033[0m\n");
}

int main(void)
{
    struct arena arena = {0};
    test_places(&arena);
    test_styles(&arena);
    test_cells(&arena);
    arena_free(&arena);
    return check_report();
}
