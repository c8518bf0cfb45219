/* tests/unit/test_wedge.c - the drawing of a tilted lens: well-formed, complete, on its page. */
/* SPDX-License-Identifier: MIT */
#include "base/arena.h"
#include "base/constants.h"
#include "base/error.h"
#include "draw/svg.h"
#include "draw/wedge.h"

#include <stdlib.h>

#include "check.h"

static const double degree = RADIANS_PER_DEGREE;

/* A thin lens focused at `distance` straight ahead: A = f/distance (inf: level plane), B = sin. */
static struct wedge camera(double f, double N, double c, double tilt, double distance)
{
    double A = f / distance, B = sin(tilt), ratio = cos(tilt) - A;
    double image = f / ratio, blur = ratio * N * c / f;
    return (struct wedge){.title = "title",
                          .f = f,
                          .tilt = tilt,
                          .image = image,
                          .hinge = f / B,
                          .scheimpflug = image / tan(tilt),
                          .A = A,
                          .A_near = A + blur,
                          .A_far = A - blur,
                          .B = B,
                          .sensor_height = 24,
                          .lens_diameter = 20};
}

/* Every tag that opens is closed, in order; depth at the end 0. */
static bool nests(const char *text)
{
    char open[64];
    size_t depth = 0;
    for (const char *at = strstr(text, "<svg"); at != NULL; at = strchr(at + 1, '<')) {
        const char *end = strchr(at, '>');
        if (end == NULL) {
            return false;
        }
        if (at[1] == '/') {
            if (depth == 0 || open[--depth] != at[2]) {
                return false;
            }
        } else if (end[-1] != '/') {
            if (depth == sizeof open) {
                return false;
            }
            open[depth++] = at[1];
        }
    }
    return depth == 0;
}

static bool on_page(double x, double most)
{
    return x >= 0 && x <= most;
}

/* Pairs of numbers in a path of absolute lines. */
static bool path_on_page(const char *at)
{
    bool good = true;
    for (size_t i = 0; *at != '"' && *at != '\0';) {
        char *end;
        double value = strtod(at, &end);
        if (end == at) {
            at++;
            continue;
        }
        good = good && on_page(value, i % 2 == 0 ? WEDGE_WIDTH : WEDGE_HEIGHT);
        i++;
        at = end;
    }
    return good;
}

/* All coordinates of one tag. */
static bool tag_on_page(const char *tag)
{
    static const struct {
        const char *name;
        double most;
    } names[] = {{" x=\"", WEDGE_WIDTH},   {" x1=\"", WEDGE_WIDTH}, {" x2=\"", WEDGE_WIDTH},
                 {" cx=\"", WEDGE_WIDTH},  {" y=\"", WEDGE_HEIGHT}, {" y1=\"", WEDGE_HEIGHT},
                 {" y2=\"", WEDGE_HEIGHT}, {" cy=\"", WEDGE_HEIGHT}};
    const char *end = strchr(tag, '>');
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        const char *at = strstr(tag, names[i].name);
        if (at != NULL && at < end &&
            !on_page(strtod(at + strlen(names[i].name), NULL), names[i].most)) {
            return false;
        }
    }
    const char *path = strstr(tag, " d=\"");
    return path == NULL || path > end || path_on_page(path + 4);
}

/* All that is not clipped lies on the page. */
static bool stays_on_page(const char *text)
{
    size_t depth = 0, clipped = 0;
    for (const char *at = strstr(text, "<title"); at != NULL; at = strchr(at + 1, '<')) {
        depth += strncmp(at, "<g", 2) == 0;
        clipped = strncmp(at, "<g clip-path", 12) == 0 ? depth : clipped;
        if (strncmp(at, "</g", 3) == 0) {
            clipped = depth == clipped ? 0 : clipped;
            depth--;
        } else if (clipped == 0 && at[1] != '/' && !tag_on_page(at)) {
            printf("%.90s\n", at);
            return false;
        }
    }
    return true;
}

static bool holds(const char *text, const char *words)
{
    return strstr(text, words) != NULL;
}

static void test_pages(void)
{
    static const struct {
        double f, N, c, tilt, distance, depth;
        bool shows_hinge;
        const char *what;
    } rows[] = {
        {150, 22, 0.1, 5, INFINITY, 0, true, "a meadow"},
        {90, 8, 0.03, 5, 600, 0, true, "a product on a table"},
        {90, 16, 0.03, 2, 5000, 0, true, "a landscape"},
        {90, 11, 0.03, 30, 500, 0, true, "a steep tilt"},
        {90, 11, 0.03, 80, 2000, 0, true, "nearly a right angle"},
        {90, 11, 0.03, -8, 1200, 0, true, "tilted back"},
        {90, 11, 0.03, 0, 2000, 0, false, "not tilted"},
        {90, 11, 0.03, 0.01, 2000, 0, false, "hardly tilted: the hinge is far below"},
        {90, 11, 0, 8, 1200, 0, true, "no blur allowed: the wedge is a line"},
        {90, 11, 0.03, 8, 1200, 1, false, "a millimetre deep"},
        {90, 11, 0.03, 8, 1200, 1e6, true, "a kilometre deep"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        struct wedge wedge =
            camera(rows[i].f, rows[i].N, rows[i].c, rows[i].tilt * degree, rows[i].distance);
        struct arena arena = {0};
        struct svg svg = {.arena = &arena};
        struct error error;
        wedge.depth = rows[i].depth;
        bool drawn = wedge_draw(&wedge, &svg, &error);
        bool good = drawn && nests(svg.data) && stays_on_page(svg.data) &&
                    holds(svg.data, "distance from the lens (m)") &&
                    holds(svg.data, ">hinge line<") == rows[i].shows_hinge &&
                    !holds(svg.data, "nan");
        check_at(good, __FILE__, __LINE__, rows[i].what);
        arena_free(&arena);
    }
}

/* The legend has the numbers: J = 150/sin 5 = 1.721 m; level plane at 90 degrees. */
static void test_legend(void)
{
    struct wedge wedge = camera(150, 22, 0.1, 5 * degree, INFINITY);
    struct arena arena = {0};
    struct svg svg = {.arena = &arena};
    struct error error;
    CHECK(wedge_draw(&wedge, &svg, &error));
    CHECK(holds(svg.data, "plane of focus, 90\xc2\xb0 to sensor"));
    CHECK(holds(svg.data, "hinge line, 1.721 m below"));
    CHECK(holds(svg.data, "v' = 150.6 mm"));
    CHECK(holds(svg.data, ">near limit<") && holds(svg.data, ">far limit<"));
    arena_free(&arena);
}

static void test_refusals(void)
{
    static const double bad[] = {NAN, 0, -1, INFINITY};
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        struct wedge wedge = camera(90, 8, 0.03, 5 * degree, 600);
        struct arena arena = {0};
        struct svg svg = {.arena = &arena};
        struct error error;
        wedge.sensor_height = bad[i];
        CHECK(!wedge_draw(&wedge, &svg, &error));
        CHECK(error.code == ERROR_DOMAIN);
        arena_free(&arena);
    }
    struct wedge wedge = camera(90, 8, 0.03, 5 * degree, 600);
    struct svg svg = {0};
    struct error error;
    wedge.tilt = 2;
    CHECK(!wedge_draw(&wedge, &svg, &error));
    wedge.tilt = 5 * degree;
    wedge.A_far = NAN;
    CHECK(!wedge_draw(&wedge, &svg, &error));
}

int main(void)
{
    test_pages();
    test_legend();
    test_refusals();
    return check_report();
}
