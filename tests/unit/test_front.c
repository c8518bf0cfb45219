/* tests/unit/test_front.c - the drawing of what costs more and errs less. */
/* SPDX-License-Identifier: MIT */
#include "base/arena.h"
#include "base/error.h"
#include "check.h"
#include "draw/front.h"
#include "draw/svg.h"

#include <stdlib.h>

enum { COUNT = 40 };

/* The boxes of labels L00 .. L39 in a drawing, as wide as they may be; how many there are. */
static size_t label_boxes(const char *svg, struct svg_box *boxes)
{
    size_t count = 0;
    for (const char *at = strstr(svg, "<text"); at != NULL; at = strstr(at + 1, "<text")) {
        const char *end = strstr(at, "</text>"), *x = strstr(at, "x=\""), *y = strstr(at, "y=\"");
        if (end == NULL || end[-3] != 'L' || x == NULL || y == NULL) {
            continue;
        }
        char text[4] = {end[-3], end[-2], end[-1], 0};
        const double half = svg_text_width(text, 10.5) / 2, middle = strtod(x + 3, NULL);
        const double base = strtod(y + 3, NULL);
        boxes[count++] = (struct svg_box){middle - half, base - 7.5, middle + half, base + 0.5};
    }
    return count;
}

int main(void)
{
    struct arena arena = {0};
    struct svg svg = {.arena = &arena};
    struct error error = {.code = ERROR_NONE};
    struct front_point points[COUNT];
    const struct front_group groups[] = {{"models", false}, {"exact", true}};
    for (int i = 0; i < COUNT; i++) { /* many of them on one heap */
        points[i] = (struct front_point){.x = i % 3 == 0 ? exp(0.3 * i) : 2 + 0.01 * i,
                                         .y = i % 3 == 0 ? exp(-0.9 * i) : 1e-3 * (1 + 0.1 * i),
                                         .label = arena_printf(&arena, "L%02d", i),
                                         .group = (size_t)(i % 2),
                                         .is_best = i % 3 == 0};
    }
    points[5].x = NAN; /* its time is not known */
    points[7].y = 0;
    const struct front front = {.title = "A lens",
                                .subtitle = "rays",
                                .x_label = "time (µs)",
                                .y_label = "error (um)",
                                .points = points,
                                .count = COUNT,
                                .groups = groups,
                                .group_count = 2};
    CHECK(front_draw(&front, &svg, &error));
    CHECK(strstr(svg.data, "A lens") != NULL && strstr(svg.data, "time (µs)") != NULL);
    CHECK(strstr(svg.data, ">L05<") == NULL && strstr(svg.data, ">L07<") == NULL);
    struct svg_box boxes[COUNT];
    const size_t count = label_boxes(svg.data, boxes);
    CHECK(count >= 20);
    for (size_t i = 0; i < count; i++) {
        CHECK(svg_is_free(boxes, i, &boxes[i]));
    }
    for (int i = 0; i < COUNT; i++) {
        points[i].y = NAN;
    }
    struct svg empty = {.arena = &arena};
    CHECK(!front_draw(&front, &empty, &error));
    CHECK(error.code == ERROR_DOMAIN);
    arena_free(&arena);
    return check_report();
}
