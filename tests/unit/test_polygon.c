/* tests/unit/test_polygon.c - polygons as triangles: their area, and that none covers another. */
/* SPDX-License-Identifier: MIT */
#include "base/constants.h"
#include "check.h"
#include "file/polygon.h"

enum { CORNERS_MOST = 30000 };

static struct vector corners[CORNERS_MOST];
static size_t triangles[CORNERS_MOST][3];

/* Twice the area as the normal has it, and the sum of all areas, whichever way they lie. */
static struct vector twice_area(const size_t triangle[3])
{
    const struct vector a = corners[triangle[0]];
    return vector_cross(vector_minus(corners[triangle[1]], a),
                        vector_minus(corners[triangle[2]], a));
}

/*
 * Cut the first corners, in this plane: u and v for x and y. A cut along diagonals has the area of
 * the polygon, all triangles wound as it is.
 */
static void check_cut(size_t count, enum polygon_cut wanted, double area, const char *name)
{
    struct arena arena = {0};
    struct vector sum = {0, 0, 0};
    double all = 0;
    CHECK(polygon_triangles(corners, count, triangles, &arena) == wanted);
    for (size_t i = 0; i < count - 2; i++) {
        const struct vector own = twice_area(triangles[i]);
        sum = vector_along(sum, 0.5, own);
        all += vector_length(own) / 2;
    }
    CHECK_NEAR(vector_length(sum), area, 1e-9 * area, name);
    CHECK_NEAR(all, area, 1e-9 * area, name);
    arena_free(&arena);
}

/* Also the other way round, from each corner on, and upright. */
static void check_shape(const double (*xy)[2], size_t count, enum polygon_cut wanted, double area,
                        const char *name)
{
    for (size_t start = 0; start < count; start++) {
        for (size_t way = 0; way < 6; way++) {
            for (size_t i = 0; i < count; i++) {
                const double *at = xy[(start + (way % 2 == 0 ? i : count - i)) % count];
                corners[i] = way < 2   ? (struct vector){at[0], at[1], 7}
                             : way < 4 ? (struct vector){at[1], 7, at[0]}
                                       : (struct vector){7 + at[0], at[1] - at[0], at[0]};
            }
            const double slant = way < 4 ? 1 : sqrt(2);
            check_cut(count, wanted, slant * area, name);
        }
    }
}

static void test_shapes(void)
{
    static const double square[][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    check_shape(square, 4, POLYGON_CONVEX, 1, "a square");
    static const double house[][2] = {{0, 0}, {2, 0}, {2, 1}, {2, 2}, {1, 3}, {0, 2}};
    check_shape(house, 6, POLYGON_CONVEX, 5, "a house");
    static const double dart[][2] = {{0, 0}, {2, -1}, {1, 0}, {2, 1}};
    check_shape(dart, 4, POLYGON_EARS, 1, "a dart");
    static const double ell[][2] = {{0, 1}, {0, 0}, {1, 0}, {1, 0.25}, {0.25, 0.25}, {0.25, 1}};
    check_shape(ell, 6, POLYGON_EARS, 0.25 + 0.75 * 0.25, "an L");
    static const double straight[][2] = {{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}, {0, 1}};
    check_shape(straight, 7, POLYGON_EARS, 3, "an L with a corner on a side");
    static const double arrow[][2] = {{0, 0}, {3, 0}, {3, 3}, {2, 3},
                                      {2, 1}, {1, 1}, {1, 3}, {0, 3}};
    check_shape(arrow, 8, POLYGON_EARS, 7, "a U");
    /* a square hole within a square, reached along one line */
    static const double hole[][2] = {{0, 0}, {3, 0}, {3, 3}, {0, 3}, {0, 0},
                                     {1, 1}, {1, 2}, {2, 2}, {2, 1}, {1, 1}};
    check_shape(hole, 10, POLYGON_EARS, 8, "a hole");
    /* two squares that meet in a point */
    static const double touching[][2] = {{0, 0}, {1, 0}, {1, 1}, {2, 1},
                                         {2, 2}, {1, 2}, {1, 1}, {0, 1}};
    check_shape(touching, 8, POLYGON_EARS, 2, "two squares");
}

/* Whose triangles are the fan about the first corner. */
static void test_crossed(void)
{
    static const double bows[3][5][2] = {
        {{0, 0}, {1, 1}, {1, 0}, {0, 1}},                /* no area */
        {{0, 0}, {1, 1}, {1, 0}, {0, 3}},                /* turns that make nothing */
        {{0, 0}, {3, 0}, {0.5, 2}, {1.5, -1}, {2.5, 2}}, /* a star of five points: twice around */
    };
    struct arena arena = {0};
    for (size_t i = 0; i < 3; i++) {
        const size_t count = i == 2 ? 5 : 4;
        for (size_t k = 0; k < count; k++) {
            corners[k] = (struct vector){bows[i][k][0], bows[i][k][1], 0};
        }
        CHECK(polygon_triangles(corners, count, triangles, &arena) == POLYGON_CROSSED);
        for (size_t k = 0; k + 2 < count; k++) {
            CHECK(triangles[k][0] == 0 && triangles[k][1] == k + 1 && triangles[k][2] == k + 2);
        }
    }
    arena_free(&arena);
}

static struct vector polar(double radius, double turns)
{
    return (struct vector){radius * cos(2 * PI * turns), radius * sin(2 * PI * turns), 0};
}

/* Many corners, which would take a while if each ear were looked at by all. */
static void test_many(void)
{
    const size_t n = CORNERS_MOST;
    const double step = 2 * PI / (double)n;
    for (size_t i = 0; i < n; i++) { /* a star: 2 triangles of sides 1 and 1/2 a spike */
        corners[i] = polar(i % 2 == 0 ? 1 : 0.5, (double)i / (double)n);
    }
    check_cut(n, POLYGON_EARS, (double)n * 0.5 * 0.5 * sin(step), "a star");
    for (size_t i = 0; i < n; i++) { /* a comb, turned by an eighth: teeth of 1 x 2 on 1 */
        const double x = (double)(i / 2), y = i % 4 == 1 || i % 4 == 2 ? 3 : 1;
        corners[i] = (struct vector){x - y, x + y, 0};
    }
    corners[n - 2] = (struct vector){(double)(n / 2) - 1, (double)(n / 2) - 1, 0};
    corners[n - 1] = (struct vector){0, 0, 0};
    /* n/4 - 1 teeth, half of one, and a bar of height 1 and length n/2 - 2; twice by the turn */
    const double length = (double)(n / 2) - 2;
    check_cut(n, POLYGON_EARS, 2 * (length + 2 * ((double)(n / 4) - 1) + 1.5), "a comb");
    for (size_t i = 0; i < n / 2; i++) { /* out along a spiral of 20 turns and back beside it */
        const double turns = 20 * (double)i / (double)(n / 2 - 1);
        corners[i] = polar(2 + turns, turns);
        corners[n - 1 - i] = polar(2.5 + turns, turns);
    }
    double area = 0; /* of each piece between two rays: (b^2 - a^2) sin/2, with a and b rising */
    for (size_t i = 0; i + 1 < n / 2; i++) {
        const struct vector a = corners[i], b = corners[i + 1];
        const struct vector c = corners[n - 2 - i], d = corners[n - 1 - i];
        area += 0.5 * (vector_cross(d, c).z - vector_cross(a, b).z);
    }
    check_cut(n, POLYGON_EARS, area, "a spiral");
}

/* Of a polygon of n corners a corner has at most two triangles each time n is halved. */
static void test_round(void)
{
    enum { COUNT = 1000, HALVINGS = 10 };
    static size_t uses[COUNT];
    for (size_t i = 0; i < COUNT; i++) {
        const double angle = 2 * PI * (double)i / COUNT;
        corners[i] = (struct vector){cos(angle), sin(angle), 0};
    }
    check_cut(COUNT, POLYGON_CONVEX, COUNT / 2 * sin(2 * PI / COUNT), "a disc");
    for (size_t i = 0; i < COUNT - 2; i++) {
        for (int k = 0; k < 3; k++) {
            uses[triangles[i][k]]++;
        }
    }
    for (size_t i = 0; i < COUNT; i++) {
        CHECK(uses[i] <= 2 * HALVINGS);
    }
}

int main(void)
{
    test_round();
    test_shapes();
    test_crossed();
    test_many();
    return check_report();
}
