/* tests/unit/test_aperture_shapes.c - edges, pieces, hulls and soundness of apertures. */
/* SPDX-License-Identifier: MIT */
#include "base/constants.h"
#include "check.h"
#include "optics/aperture.h"

#include <complex.h>

static struct arena arena;

static double draw(void)
{
    static unsigned long long state = 1;
    state = state * 6364136223846793005ULL + 1442695040888963407ULL;
    return (double)(state >> 11) * 0x1p-53;
}

static double draw_between(double low, double high)
{
    return low + (high - low) * draw();
}

static struct figure number_of(double value)
{
    return (struct figure){.value = pair_of(value), .variable = LENS_NONE};
}

static struct aperture shape_of(enum aperture_shape shape, bool blocks, double first, double second)
{
    struct aperture aperture = aperture_of(shape, blocks);
    aperture.size[0] = number_of(first);
    aperture.size[1] = number_of(second);
    return aperture;
}

static struct aperture spider_of(unsigned arms, double width)
{
    struct aperture spider = shape_of(SHAPE_SPIDER, true, width, 0);
    spider.arms = arms;
    return spider;
}

static struct aperture polygon_of(const double (*corners)[2], size_t count)
{
    struct aperture polygon = aperture_of(SHAPE_POLYGON, false);
    struct figure(*points)[2] = arena_array(&arena, count + 1, sizeof *points);
    for (size_t i = 0; i < 2 * count; i++) {
        points[i / 2][i % 2] = number_of(corners[i / 2][i % 2]);
    }
    points[count][0] = number_of(1e100); /* is none of its corners */
    points[count][1] = number_of(0);
    polygon.points = (const struct figure(*)[2])points;
    polygon.point_count = count;
    return polygon;
}

/* A star about (3, -2): every so manieth of the corners of a regular polygon, out of line. */
static struct aperture star_of(size_t count, size_t every)
{
    double(*corners)[2] = arena_array(&arena, count, sizeof *corners);
    for (size_t i = 0; i < count; i++) {
        const double angle = 0.123 + 2 * PI * (double)(i * every % count) / (double)count;
        corners[i][0] = 3 + 7 * cos(angle) + sin(angle);
        corners[i][1] = -2 + 5 * sin(angle);
    }
    return polygon_of((const double(*)[2])corners, count);
}

/* -------- what is sound -------- */

static void check_sound(struct aperture aperture, const char *words)
{
    struct error error = {0};
    const bool sound = aperture_check(&aperture, &error);
    CHECK_TEXT(sound ? "" : error.message, words);
    CHECK(sound || error.code == ERROR_DATA);
}

static void test_sizes(void)
{
    static const char below[] = "the inner diameter of a ring, 4 mm, is not below the outer, 3 mm";
    static const char many[] = "a spider has 1 to 64 arms";
    const struct aperture even = shape_of(SHAPE_RING, false, 3, 3);
    struct error error = {0};
    check_sound(shape_of(SHAPE_CIRCLE, false, 1e-300, 0), "");
    check_sound(shape_of(SHAPE_CIRCLE, true, 9.9e99, NAN), "");
    check_sound(shape_of(SHAPE_CIRCLE, false, 0, 1),
                "the diameter of the circle must be above 0, and is 0");
    check_sound(shape_of(SHAPE_CIRCLE, false, 1e100, 1),
                "the diameter of the circle must be above 0, and is 1e+100");
    check_sound(shape_of(SHAPE_CIRCLE, false, NAN, 1),
                "the diameter of the circle must be above 0, and is nan");
    check_sound(shape_of(SHAPE_RECTANGLE, false, 2, 0.5), "");
    check_sound(shape_of(SHAPE_RECTANGLE, false, 2, -3),
                "the width along y of the rectangle must be above 0, and is -3");
    check_sound(shape_of(SHAPE_ELLIPSE, false, -2, 3),
                "the width along x of the ellipse must be above 0, and is -2");
    check_sound(shape_of(SHAPE_RING, false, 2.999, 3), "");
    check_sound(shape_of(SHAPE_RING, false, 4, 3), below);
    CHECK(!aperture_check(&even, &error));
    check_sound(shape_of(SHAPE_ELLIPSE, true, 3, 3), "");
    check_sound(spider_of(1, 0.5), "");
    check_sound(spider_of(64, 0.5), "");
    check_sound(spider_of(0, 0.5), many);
    check_sound(spider_of(65, 0.5), many);
    struct aperture passing = spider_of(3, 1);
    passing.blocks = false;
    check_sound(passing, "a spider blocks light: it lets none pass");
    for (int i = 0; i < 6; i++) {
        struct aperture aperture = shape_of(SHAPE_CIRCLE, false, 5, 0);
        struct figure *places[] = {&aperture.decenter[0], &aperture.decenter[1], &aperture.turn};
        *places[i / 2] = number_of(i % 2 == 0 ? 9.9e99 : -1e100);
        check_sound(aperture, i % 2 == 0 ? "" : "a decentre or turn beyond 1e100");
    }
}

static void test_corners(void)
{
    static const double line[][2] = {{1, 0}, {2, 1}, {3, 2}, {5, 4}};
    static const double aside[][2] = {{1, 0}, {2, 1}, {3, 2.5}, {5, 4}};
    static const double bow[][2] = {{-1, -1}, {1, 1}, {1, -1}, {-1, 1}};
    static const double back[][2] = {{0, 0}, {2, 1}, {3, 5}, {2, 1}};
    static const double far[][2] = {{9.9e99, 0}, {0, 1}, {0, -9.9e99}};
    check_sound(polygon_of(line, 3), "a polygon without any area");
    check_sound(polygon_of(line, 4), "a polygon without any area");
    check_sound(polygon_of(aside, 3), "");
    check_sound(polygon_of(aside, 4), "");
    check_sound(polygon_of(far, 3), "");
    /* two halves gone round in opposite senses have area; a way there and back has none */
    check_sound(polygon_of(bow, 4), "");
    check_sound(polygon_of(back, 4), "a polygon without any area");
    check_sound(polygon_of(aside, 2), "a polygon has three corners and more");
    for (size_t i = 0; i < 6; i++) {
        double beyond[3][2] = {{1, 2}, {2, 5}, {3, -1}};
        beyond[i / 2][i % 2] = i % 3 == 0 ? (double)NAN : 1e100;
        check_sound(polygon_of((const double(*)[2])beyond, 3),
                    "a polygon with a corner beyond 1e100");
    }
    for (size_t count = 3; count < 30; count++) {
        check_sound(star_of(count, 1), "");
    }
    check_sound(star_of(4096, 1), "");
    check_sound(star_of(4097, 1), "a polygon of 4097 corners: it may have up to 4096");
}

/*
 * How many sides cross within both: a + t (b - a) = c + u (d - c) has 0 < t, u < 1. In whole
 * numbers, so that what touches is told from what crosses.
 */
static size_t crossings_of(const double (*corners)[2], size_t count)
{
    size_t found = 0;
    for (size_t i = 0; i < count; i++) {
        for (size_t j = 0; j < i; j++) {
            const double *a = corners[i], *b = corners[(i + 1) % count];
            const double *c = corners[j], *d = corners[(j + 1) % count];
            const double p[2] = {b[0] - a[0], b[1] - a[1]}, q[2] = {d[0] - c[0], d[1] - c[1]};
            const double r[2] = {c[0] - a[0], c[1] - a[1]};
            const double all = p[0] * q[1] - p[1] * q[0], sign = all > 0 ? 1 : -1;
            const double t = sign * (r[0] * q[1] - r[1] * q[0]);
            const double u = sign * (r[0] * p[1] - r[1] * p[0]);
            found += t > 0 && t < fabs(all) && u > 0 && u < fabs(all);
        }
    }
    return found;
}

/* A star of n corners, every k-th, crosses itself n (k - 1) times. Then any polygons. */
static void test_crossings(void)
{
    enum { CORNERS = 31, SIDE = 40 };
    static const char many[] = "a polygon whose sides cross each other more than 100 times";
    size_t at_limit = 0, beyond = 0;
    check_sound(star_of(50, 3), "");
    check_sound(star_of(99, 2), "");
    check_sound(star_of(101, 2), many);
    check_sound(star_of(17, 7), many); /* 102 */
    for (int i = 0; i < 1000; i++) {
        double corners[CORNERS][2];
        for (size_t k = 0; k < CORNERS; k++) {
            corners[k][0] = floor(draw_between(-SIDE, SIDE));
            corners[k][1] = floor(draw_between(0, SIDE / 4.0));
        }
        const size_t crossings = crossings_of((const double(*)[2])corners, CORNERS);
        check_sound(polygon_of((const double(*)[2])corners, CORNERS), crossings > 100 ? many : "");
        at_limit += crossings == 100;
        beyond += crossings == 101;
    }
    CHECK(at_limit > 5 && beyond > 5);
    /* corners along straight sides, as far as rounding lets them: no side crosses another */
    enum { EACH = 1300 };
    static const double tips[][2] = {{-1, 0.3}, {2, 1 / 3.0}, {0.1, 5}, {-1, 0.3}};
    double along[3 * EACH][2];
    for (size_t i = 0; i < (size_t)3 * EACH; i++) {
        for (int axis = 0; axis < 2; axis++) {
            const double from = tips[i / EACH][axis], to = tips[i / EACH + 1][axis];
            along[i][axis] = from + (to - from) * (double)(i % EACH) / EACH;
        }
    }
    check_sound(polygon_of((const double(*)[2])along, (size_t)3 * EACH), "");
}

/* -------- edges -------- */

/* Beyond the edge of a polygon, mm, and the number of the side that is nearest. */
static double beyond_sides(const double (*corners)[2], size_t count, double complex at,
                           size_t *side)
{
    double nearest = INFINITY, turn = 0;
    for (size_t i = 0; i < count; i++) {
        const double *p = corners[i], *q = corners[(i + 1) % count];
        const double complex a = p[0] + I * p[1] - at, b = q[0] + I * q[1] - at;
        /* seen along the side: from an end, or across it */
        const double complex unit = (b - a) / cabs(b - a);
        const double complex from = a * conj(unit), to = b * conj(unit);
        const bool across = creal(from) < 0 && creal(to) > 0;
        const double distance = across ? fabs(cimag(from)) : fmin(cabs(from), cabs(to));
        if (distance < nearest) {
            nearest = distance;
            *side = i;
        }
        turn += carg(b / a);
    }
    return fabs(remainder(rint(turn / (2 * PI)), 2)) > 0.5 ? -nearest : nearest;
}

/* A shape somewhere, turned; a point about it in its own frame. */
static double complex place_shape(struct aperture *aperture, double x, double y)
{
    const double complex centre = draw_between(-3, 3) + I * draw_between(-3, 3);
    const double turn = draw_between(-7, 7);
    aperture->decenter[0] = number_of(creal(centre));
    aperture->decenter[1] = number_of(cimag(centre));
    aperture->turn = number_of(turn);
    return centre + (x + I * y) * cexp(I * turn);
}

static void check_edge(const struct aperture *aperture, double complex at, double excess,
                       size_t part)
{
    const struct aperture_form form = aperture_form_of(aperture, &arena);
    CHECK_NEAR(aperture_excess(&form, creal(at), cimag(at)), excess, 4e-14 * (1 + fabs(excess)),
               aperture_shapes[aperture->shape].word);
    CHECK(aperture_part(&form, creal(at), cimag(at)) == part);
    CHECK(aperture_passes(&form, creal(at), cimag(at)) == (excess <= 0) || aperture->blocks);
    CHECK(aperture_passes(&form, creal(at), cimag(at)) == (excess >= 0) || !aperture->blocks);
}

static void test_smooth_edges(void)
{
    for (int i = 0; i < 200; i++) {
        const double a = draw_between(0.5, 4), b = draw_between(0.5, 4);
        const double x = draw_between(-5, 5), y = draw_between(-5, 5);
        const double r2 = x * x + y * y;
        struct aperture circle = shape_of(SHAPE_CIRCLE, i % 2 == 0, 2 * a, NAN);
        struct aperture ellipse = shape_of(SHAPE_ELLIPSE, i % 2 == 1, 2 * a, 2 * b);
        struct aperture box = shape_of(SHAPE_RECTANGLE, i % 2 == 0, 2 * a, 2 * b);
        check_edge(&circle, place_shape(&circle, x, y), r2 / (a * a) - 1, 0);
        check_edge(&ellipse, place_shape(&ellipse, x, y), x * x / (a * a) + y * y / (b * b) - 1, 0);
        const double u = fabs(x) / a, v = fabs(y) / b;
        const size_t sides[] = {x > 0 ? 0 : 2, y > 0 ? 1 : 3};
        check_edge(&box, place_shape(&box, x, y), fmax(u, v) - 1, sides[u > v ? 0 : 1]);
        /* which circle of a ring decides is asked within a tenth of one of them */
        const double inner = a, outer = a * draw_between(1.3, 5);
        const bool is_outer = draw() > 0.5;
        const double share = draw_between(0.9, 1.1), r = share * (is_outer ? outer : inner);
        struct aperture ring = shape_of(SHAPE_RING, i % 2 == 1, 2 * inner, 2 * outer);
        const double complex way = cexp(I * draw_between(-PI, PI));
        check_edge(&ring, place_shape(&ring, r * creal(way), r * cimag(way)),
                   fmax(r * r / (outer * outer) - 1, 1 - r * r / (inner * inner)),
                   is_outer ? 0 : 1);
    }
}

static void test_polygons(void)
{
    enum { CORNERS = 9 };
    for (int i = 0; i < 400; i++) {
        const size_t count = 3 + (size_t)i % (CORNERS - 2);
        double corners[CORNERS][2], radius = 0;
        for (size_t k = 0; k < 2 * count; k++) {
            corners[k / 2][k % 2] = draw_between(-4, 4);
        }
        for (size_t k = 0; k < count; k++) {
            radius = fmax(radius, hypot(corners[k][0], corners[k][1]));
        }
        const double x = draw_between(-5, 5), y = draw_between(-5, 5);
        struct aperture polygon = polygon_of((const double(*)[2])corners, count);
        polygon.blocks = i % 2 == 0;
        size_t side = 0;
        const double beyond = beyond_sides((const double(*)[2])corners, count, x + I * y, &side);
        /* beyond an end two sides are as far, to the last bit or not: one of them */
        const double complex at = place_shape(&polygon, x, y);
        const struct aperture_form form = aperture_form_of(&polygon, &arena);
        const size_t part = aperture_part(&form, creal(at), cimag(at));
        const double *end = corners[(side + 1) % count], *end_too = corners[side];
        const bool at_end =
            hypot(x - end[0], y - end[1]) - fabs(beyond) < 1e-9 && part == (side + 1) % count;
        const bool at_start = hypot(x - end_too[0], y - end_too[1]) - fabs(beyond) < 1e-9 &&
                              (part + 1) % count == side;
        check_edge(&polygon, at, beyond / radius, at_end || at_start ? part : side);
        CHECK(isnan(aperture_shapes[SHAPE_POLYGON].excess(&form, NAN, 0)));
        CHECK(isnan(aperture_shapes[SHAPE_POLYGON].excess(&form, 0, NAN)));
        /* what is decided without a look at the sides */
        const double centre = beyond_sides((const double(*)[2])corners, count, 0, &side);
        CHECK_RELATIVE(form.within2, centre < 0 ? centre * centre : 0, 2e-9, "all inside");
        CHECK(form.within2 <= centre * centre && form.beyond2 >= radius * radius);
        CHECK_RELATIVE(form.beyond2, radius * radius, 2e-9, "all outside");
        CHECK_RELATIVE(form.radius, radius, 1e-15, "radius");
    }
}

/*
 * Two polygons in one: a way between them that is gone there and back is no edge of either. Inside
 * of both is outside, as the sides are counted. And one that goes twice along its own diagonal.
 */
static void test_joined(void)
{
    enum { EACH = 5, ALL = 2 * EACH + 2 };
    for (int i = 0; i < 2000; i++) {
        double corners[ALL][2], parts[2][EACH][2];
        size_t side;
        for (size_t k = 0; k < ALL; k++) {
            const size_t part = k / (EACH + 1), corner = k % (EACH + 1) % EACH;
            for (int axis = 0; axis < 2; axis++) {
                if (k % (EACH + 1) < EACH) {
                    parts[part][corner][axis] = draw_between(-4, 4);
                }
                corners[k][axis] = parts[part][corner][axis];
            }
        }
        const double x = draw_between(-5, 5), y = draw_between(-5, 5);
        const struct aperture polygon = polygon_of((const double(*)[2])corners, ALL);
        const struct aperture_form form = aperture_form_of(&polygon, &arena);
        const double one = beyond_sides((const double(*)[2])parts[0], EACH, x + I * y, &side);
        const double other = beyond_sides((const double(*)[2])parts[1], EACH, x + I * y, &side);
        const double nearest = fmin(fabs(one), fabs(other));
        CHECK_NEAR(aperture_excess(&form, x, y) * form.radius,
                   (one < 0) != (other < 0) ? -nearest : nearest, 1e-13, "two polygons");
        const size_t part = aperture_part(&form, x, y);
        CHECK(part != EACH && part != ALL - 1 && part / (EACH + 1) == (fabs(other) < fabs(one)));
    }
    /* sides that have one end and one coordinate of the other in common are two */
    for (int i = 0; i < 100; i++) {
        double triangle[3][2];
        for (int k = 0; k < 6; k++) {
            triangle[k / 2][k % 2] = 10 * (k / 2) + floor(draw_between(0, 3));
        }
        triangle[1 + i % 2][i / 2 % 2] = triangle[i / 4 % 2 == 0 ? 0 : 2 - i % 2][i / 2 % 2];
        const struct aperture sides = polygon_of((const double(*)[2])triangle, 3);
        CHECK(aperture_form_of(&sides, &arena).seams == NULL);
    }
    static const double rhombus[][2] = {{0, -2}, {0, 2}, {3, 0}, {0, -2}, {0, 2}, {-3, 0}};
    const struct aperture polygon = polygon_of(rhombus, 6);
    const struct aperture_form form = aperture_form_of(&polygon, &arena);
    CHECK_NEAR(aperture_excess(&form, 0, 5), 1, 1e-15, "above");
    CHECK_NEAR(aperture_excess(&form, 0, -5), 1, 1e-15, "below");
    CHECK_NEAR(aperture_excess(&form, 0, 0), -2 / sqrt(13), 1e-15, "within");
}

/* Points by the arm that is nearest: so far out along it, so far to its left. */
static void test_spiders(void)
{
    for (int i = 0; i < 200; i++) {
        const unsigned arms = 1 + (unsigned)i % 9;
        const double half = draw_between(0.2, 2);
        const size_t arm = (size_t)(draw() * arms);
        /* in the sector of that arm */
        const double out = draw_between(3, 9);
        const double most = arms > 2 ? out * tan(PI / arms) * 0.95 : 4;
        const double left = draw_between(-fmin(most, 4), fmin(most, 4));
        const double complex along = cexp(2 * I * PI * (double)arm / arms);
        const double complex own = (out + I * left) * along;
        struct aperture spider = spider_of(arms, 2 * half);
        check_edge(&spider, place_shape(&spider, creal(own), cimag(own)), fabs(left) / half - 1,
                   3 * arm + (left > 0 ? 1 : 0));
    }
    /* behind the only one */
    for (int i = 0; i < 50; i++) {
        const double half = draw_between(0.2, 2), behind = draw_between(0, 4);
        const double left = draw_between(-3, 3), across = fabs(left) - half;
        struct aperture spider = spider_of(1, 2 * half);
        const double complex at = place_shape(&spider, -behind, left);
        check_edge(&spider, at, fmax(behind, across) / half,
                   across < behind ? 2
                   : left > 0      ? 1
                                   : 0);
    }
    for (unsigned arms = 1; arms <= 8; arms++) {
        struct aperture spider = spider_of(arms, 1);
        const struct aperture_form form = aperture_form_of(&spider, &arena);
        CHECK(form.point_count == arms && isinf(form.radius));
        for (unsigned k = 0; k < arms; k++) {
            CHECK_NEAR(form.points[k][0], cos(2 * PI * k / arms), 1e-15, "an arm along x");
            CHECK_NEAR(form.points[k][1], sin(2 * PI * k / arms), 1e-15, "an arm along y");
            CHECK(4 * k % arms != 0 || fabs(form.points[k][0]) + fabs(form.points[k][1]) == 1);
        }
    }
}

/* Quarters of a turn without rounding, others as they are. */
static void test_turns(void)
{
    static const double ways[4][2] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
    for (int k = -9; k <= 9; k++) {
        struct aperture box = shape_of(SHAPE_RECTANGLE, false, 2, 3);
        box.turn = number_of(k * (PI / 2));
        const struct aperture_form form = aperture_form_of(&box, &arena);
        CHECK(form.cosine == ways[(k + 12) % 4][0] && form.sine == ways[(k + 12) % 4][1]);
        const double nearby = k * (PI / 2) * (1 + 1.5e-15), other = k * 0.7 + 0.1;
        box.turn = number_of(nearby);
        const struct aperture_form beside = aperture_form_of(&box, &arena);
        CHECK_NEAR(beside.cosine, cos(nearby), 1e-16, "beside a quarter");
        CHECK_NEAR(beside.sine, sin(nearby), 1e-16, "beside a quarter");
        box.turn = number_of(other);
        const struct aperture_form turned = aperture_form_of(&box, &arena);
        CHECK_NEAR(turned.cosine, cos(other), 1e-15, "cosine");
        CHECK_NEAR(turned.sine, sin(other), 1e-15, "sine");
    }
}

/* -------- about them -------- */

static double turned_left(const double *p, const double *q, const double *r)
{
    return (q[0] - p[0]) * (r[1] - q[1]) - (q[1] - p[1]) * (r[0] - q[0]);
}

/* Convex, nothing beyond it, all of its corners are theirs: in whole numbers. */
static void test_hulls(void)
{
    enum { CORNERS = 20 };
    for (int i = 0; i < 200; i++) {
        double corners[CORNERS][2];
        const size_t count = 3 + (size_t)i % (CORNERS - 2);
        for (size_t k = 0; k < 2 * count; k++) {
            corners[k / 2][k % 2] = floor(draw_between(-5, 6));
        }
        corners[0][0] = -6; /* not all on one line */
        corners[0][1] = floor(draw_between(-5, 6));
        corners[1][0] = 6;
        corners[1][1] = floor(draw_between(-5, 6));
        corners[2][0] = floor(draw_between(-5, 6));
        corners[2][1] = 7;
        const struct aperture polygon = polygon_of((const double(*)[2])corners, count);
        const struct aperture_form hull = aperture_hull(&polygon, &arena);
        CHECK(hull.point_count >= 3 && hull.point_count <= count && hull.seams == NULL);
        for (size_t k = 0; k < hull.point_count; k++) {
            const double *here = hull.points[k], *next = hull.points[(k + 1) % hull.point_count];
            bool own = false, left = true;
            for (size_t m = 0; m < count; m++) {
                own = own || (here[0] == corners[m][0] && here[1] == corners[m][1]);
                left = left && turned_left(here, next, corners[m]) >= 0;
            }
            CHECK(own && left);
            CHECK(turned_left(here, next, hull.points[(k + 2) % hull.point_count]) > 0);
        }
    }
    const struct aperture ring = shape_of(SHAPE_RING, false, 2, 6);
    const struct aperture_form disc = aperture_hull(&ring, &arena);
    CHECK(disc.shape == SHAPE_CIRCLE && disc.half[0] == 3 && disc.half[1] == 3);
    const struct aperture box = shape_of(SHAPE_RECTANGLE, false, 2, 6);
    const struct aperture_form same = aperture_hull(&box, &arena);
    CHECK(same.shape == SHAPE_RECTANGLE && same.half[0] == 1 && same.half[1] == 3);
}

/* The farthest point that passes; its centre is (3, 4) or (-3, -4), 5 from the vertex. */
static void test_reach(void)
{
    static const double corners[][2] = {{1, 1}, {-1, 2}, {3, -4}, {0.5, -2}};
    const struct {
        struct aperture aperture;
        double reach;
    } cases[] = {
        {shape_of(SHAPE_CIRCLE, false, 4, 0), 7},       {shape_of(SHAPE_RING, false, 2, 8), 9},
        {shape_of(SHAPE_ELLIPSE, false, 3, 10), 10},    {shape_of(SHAPE_ELLIPSE, false, 10, 3), 10},
        {shape_of(SHAPE_RECTANGLE, false, 6, 8), 10},   {polygon_of(corners, 4), 10},
        {shape_of(SHAPE_CIRCLE, true, 4, 0), INFINITY}, {spider_of(3, 1), INFINITY}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const struct aperture block = shape_of(SHAPE_CIRCLE, true, 1, 0);
        struct aperture listed[4] = {block, block, block, shape_of(SHAPE_CIRCLE, false, 0.1, 0)};
        struct surface surface = {.apertures = listed, .aperture_count = 3};
        struct aperture *own = &listed[i % 3];
        const double sign = i % 2 == 0 ? 1 : -1;
        *own = cases[i].aperture;
        own->decenter[0] = number_of(3 * sign);
        own->decenter[1] = number_of(4 * sign);
        CHECK_RELATIVE(aperture_reach(&surface), cases[i].reach, 1e-15, "reach");
        surface.has_diameter = true;
        for (double radius = 1; radius < 16; radius += 2.5) {
            surface.diameter = number_of(2 * radius);
            CHECK_RELATIVE(aperture_reach(&surface), fmin(radius, cases[i].reach), 1e-15,
                           "reach within a diameter");
        }
        CHECK(!aperture_is_round(own));
        own->decenter[1] = number_of(0);
        CHECK(!aperture_is_round(own));
        own->decenter[0] = number_of(0);
        CHECK(aperture_is_round(own) == (own->shape == SHAPE_CIRCLE || own->shape == SHAPE_RING));
        own->decenter[1] = number_of(4);
        CHECK(!aperture_is_round(own));
    }
}

int main(void)
{
    test_sizes();
    test_corners();
    test_crossings();
    test_smooth_edges();
    test_polygons();
    test_joined();
    test_spiders();
    test_turns();
    test_hulls();
    test_reach();
    arena_free(&arena);
    return check_report();
}
