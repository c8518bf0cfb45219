/* tests/unit/test_element_sheet.c - dimensions in the drawing of an element. */
/* SPDX-License-Identifier: MIT */
#include "base/arena.h"
#include "check.h"
#include "draw/element_sheet.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { POINTS = 201 };

/* The outline of a biconvex lens: two spheres of radius R, 20 mm across, 6 mm thick. */
static const double R = 40, HALF = 10, THICK = 6;

static void outline(double *z, double *y)
{
    for (size_t i = 0; i < POINTS; i++) {
        const double height = HALF * (1 - 2 * (double)i / (POINTS - 1));
        const double sag = R - sqrt(R * R - height * height);
        z[i] = sag;
        y[i] = height;
        z[2 * POINTS - 1 - i] = THICK - sag;
        y[2 * POINTS - 1 - i] = height;
    }
}

/* The black triangle that follows: its tip, the middle of its other side; null: there is none. */
static const char *next_arrow(const char *from, double tip[2], double behind[2])
{
    const char *at = strstr(from, "<g fill=\"#000000\" stroke=\"none\">");
    const char *path = at != NULL ? strpbrk(strstr(at + 1, "<"), "0123456789-") : NULL;
    if (path == NULL) {
        return NULL;
    }
    double number[6];
    char *end = NULL;
    for (size_t i = 0; i < 6; i++) {
        path += strcspn(path, "0123456789-.");
        number[i] = strtod(path, &end);
        path = end;
    }
    for (size_t k = 0; k < 2; k++) {
        tip[k] = number[k];
        behind[k] = (number[2 + k] + number[4 + k]) / 2;
    }
    return end;
}

int main(void)
{
    struct arena arena = {0};
    struct svg svg = {.arena = &arena};
    static double z[2 * POINTS], y[2 * POINTS];
    outline(z, y);
    const struct element_sheet sheet = {.title = "lens",
                                        .part = "element 1 of 1",
                                        .z = z,
                                        .y = y,
                                        .count = (size_t)(2 * POINTS),
                                        .vertex = {0, THICK},
                                        .edge = {z[0], z[2 * POINTS - 1]},
                                        .diameter = 2 * HALF,
                                        .thickness = "6",
                                        .across = "20",
                                        .radius = {"R 40", "R 41"}};
    element_sheet_draw(&sheet, &svg);
    /* tenths of a millimetre about the middle of the element at 1050, 560; scale 2 : 1 */
    CHECK(strstr(svg.data, ">scale 2 : 1</text>") != NULL);
    CHECK(strstr(svg.data, ">R 40</text>") != NULL && strstr(svg.data, ">R 41</text>") != NULL);
    const double unit = 20;
    size_t met = 0;
    double tip[2], behind[2];
    for (const char *at = svg.data; (at = next_arrow(at, tip, behind)) != NULL;) {
        for (int side = -1; side <= 1; side += 2) {
            /* a sphere's centre, and the arrow that points at it */
            const double centre = 1050 - side * unit * (R - THICK / 2);
            const double x = tip[0] - centre, up = tip[1] - 560;
            const double from = behind[0] - centre, high = behind[1] - 560;
            const double turn = x * high - up * from; /* 0: tip, arrow and centre in one line */
            if (fabs(hypot(x, up) - unit * R) < 0.3 && fabs(up) > 50) {
                CHECK(hypot(from, high) > unit * R); /* it comes from outside */
                CHECK(fabs(turn) < 0.02 * hypot(from, high) * hypot(from - x, high - up));
                CHECK(side * (tip[0] - 1050) > 0);
                met++;
            }
        }
    }
    CHECK(met == 2);
    arena_free(&arena);
    return check_report();
}
