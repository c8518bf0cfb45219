/* tests/unit/test_pupil_boundary.c - lists of edges and corners, and what lies between them. */
/* SPDX-License-Identifier: MIT */
#include "base/constants.h"
#include "check.h"
#include "trace/aim/sample.h"
#include "trace/pupil/clear.h"
#include "trace/pupil/pupil_boundary_search.h"

/* Angles from 0.3 on, no two gaps alike; the radius a line in each gap. */
static const double angles[] = {0.3, 0.9, 1.3, 2.8, 3.6, 4.1, 5.5, 6.2};
static const double radii[] = {1, 2, 0.5, 1.5, 3, 2.5, 0.75, 1.25};
/* which of them are corners */
static const bool is_corner[] = {false, true, true, false, true, false, false, true};
enum { KNOTS = sizeof angles / sizeof *angles };

static struct pupil_boundary boundary;

/* Edges are entered in any order. */
static void fill(size_t first)
{
    boundary.count = boundary.corner_count = 0;
    for (size_t k = 0; k < KNOTS; k++) {
        const size_t i = (first + 5 * k) % KNOTS;
        const struct edge edge = {radii[i], i};
        if (!is_corner[i]) {
            pupil_boundary_enter(&boundary, angles[i], &edge);
        }
        if (is_corner[k]) {
            boundary.corners[boundary.corner_count] = angles[k];
            boundary.radii[boundary.corner_count++] = radii[k];
        }
    }
    pupil_boundary_join(&boundary);
}

static void test_lists(void)
{
    for (size_t first = 0; first < KNOTS; first++) {
        fill(first);
        size_t edge = 0;
        CHECK(boundary.knot_count == KNOTS && boundary.count == 4);
        for (size_t i = 0; i < KNOTS; i++) {
            CHECK(boundary.knots[i] == angles[i] && boundary.knot_radii[i] == radii[i]);
            if (!is_corner[i]) {
                CHECK(boundary.angles[edge] == angles[i]);
                CHECK(boundary.edges[edge].radius == radii[i] && boundary.edges[edge].limit == i);
                edge++;
            }
        }
        CHECK_NEAR(pupil_boundary_gap(&boundary, 0), 2.5, 1e-15, "0.3 .. 2.8");
        CHECK_NEAR(pupil_boundary_gap(&boundary, 1), 1.3, 1e-15, "2.8 .. 4.1");
        CHECK_NEAR(pupil_boundary_gap(&boundary, 2), 1.4, 1e-15, "4.1 .. 5.5");
        CHECK_NEAR(pupil_boundary_gap(&boundary, 3), 0.3 + 2 * PI - 5.5, 1e-15, "and round");
    }
}

/* On the line between two neighbours, however many turns the angle has. */
static void test_near(void)
{
    fill(0);
    for (size_t i = 0; i < KNOTS; i++) {
        const size_t next = (i + 1) % KNOTS;
        const double gap = angles[next] + (next == 0 ? 2 * PI : 0) - angles[i];
        for (double share = 0; share < 1; share += 0.125) {
            for (int turn = -3; turn <= 3; turn++) {
                /* at a knot itself the turns are rounding: either side has the same radius */
                const double angle = angles[i] + share * gap + 2 * PI * turn;
                CHECK_NEAR(pupil_boundary_near(&boundary, angle),
                           radii[i] + share * (radii[next] - radii[i]), 3e-13, "between knots");
            }
        }
    }
    /* two knots in one place: a step */
    boundary.knots[3] = boundary.knots[2];
    CHECK_NEAR(pupil_boundary_near(&boundary, 1.1), 1.25, 1e-15, "before a step");
    CHECK_NEAR(pupil_boundary_near(&boundary, 2.45), 2.25, 1e-14, "behind a step");
    CHECK_NEAR(pupil_boundary_near(&boundary, boundary.knots[2]), 1.5, 1e-14, "at a step");
    /* one alone */
    boundary.knot_count = 1;
    CHECK_NEAR(pupil_boundary_near(&boundary, 4), 1, 1e-15, "one knot");
}

/* -------- how far a curve through arms reaches -------- */

/* An ellipse turned by an angle reaches sqrt(a^2 cos^2 + b^2 sin^2) along x, likewise along y. */
static void test_smooth_curve(void)
{
    enum { ARMS = 128 };
    static const double sizes[] = {1e-5, 1, 1e5};
    for (int i = 0; i < 3 * 20; i++) {
        const double size = sizes[i % 3], a = 1.5 * size, b = size, turn = 0.17 * i;
        const double reach[2] = {hypot(a * cos(turn), b * sin(turn)),
                                 hypot(a * sin(turn), b * cos(turn))};
        const struct clear_pupil pupil = {.arm_count = ARMS};
        double points[ARMS][2];
        for (size_t k = 0; k < ARMS; k++) {
            const double t = 2 * PI * ((double)k + 0.3) / ARMS;
            points[k][0] = 3 * size + a * cos(t) * cos(turn) - b * sin(t) * sin(turn);
            points[k][1] = -size + a * cos(t) * sin(turn) + b * sin(t) * cos(turn);
        }
        for (int k = 0; k < 4; k++) {
            const double sign = k % 2 == 0 ? 1 : -1, middle = k < 2 ? 3 * size : -size;
            size_t which = ARMS, best = 0;
            for (size_t m = 0; m < ARMS; m++) {
                best = sign * points[m][k / 2] > sign * points[best][k / 2] ? m : best;
            }
            CHECK_NEAR(clear_extreme(&pupil, (const double(*)[2])points, k / 2, sign, &which),
                       middle + sign * reach[k / 2], 1e-12 * size, "an ellipse");
            CHECK(which == best);
        }
    }
}

/* Where the edge steps there is no peak between arms: the farthest of them, whatever the size. */
static void test_step(void)
{
    enum { ARMS = 128 };
    static const double sizes[] = {1e-5, 1, 1e5};
    for (int i = 0; i < 3 * ARMS; i++) {
        const double size = sizes[i % 3];
        const struct clear_pupil pupil = {.arm_count = ARMS};
        double points[ARMS][2], highest = -INFINITY, lowest = INFINITY;
        size_t which = ARMS;
        for (size_t k = 0; k < ARMS; k++) {
            const double t = 2 * PI * (double)k / ARMS;
            const double r = (k + (size_t)i) % ARMS < ARMS / 2 ? size : 0.7 * size;
            points[k][0] = 9 * size + r * cos(t);
            points[k][1] = r * sin(t);
            highest = fmax(highest, points[k][0]);
            lowest = fmin(lowest, points[k][0]);
        }
        /* of a peak between arms what a circle has there, and a thousandth that tells no step */
        const double most = size * (1 - cos(PI / ARMS)) + 1.1e-3 * (highest - lowest);
        const double high = clear_extreme(&pupil, (const double(*)[2])points, 0, 1, &which);
        const double low = clear_extreme(&pupil, (const double(*)[2])points, 0, -1, &which);
        CHECK(high >= highest && high <= highest + most);
        CHECK(low <= lowest && low >= lowest - most);
    }
}

/*
 * Three pieces with arms at Gauss's points, and corners: a lens of two circles of radius 1 about
 * (-+0.6, 0), and the lower of its arcs cut in two; all of it turned. In a direction that an arc
 * has it reaches as far as its circle, else as far as the farther tip, (0, 0.8) or (0, -0.8).
 */
enum { PIECES = 3, ARMS = PIECES * CLEAR_ARC, TIPS = 2 * PIECES };

static void put_pieces(double size, double turn, struct clear_pupil *pupil, double (*points)[2])
{
    const double half = atan2(0.8, 0.6);
    /* centre, first and last angle about it */
    const double pieces[PIECES][3] = {
        {-0.6, -half, half}, {0.6, PI - half, PI - 0.05}, {0.6, PI - 0.05, PI + half}};
    double gauss[CLEAR_ARC];
    *pupil = (struct clear_pupil){.arcs = PIECES, .arm_count = ARMS, .corner_count = TIPS};
    gauss_rule(CLEAR_ARC, pupil->nodes, gauss);
    for (size_t piece = 0; piece < PIECES; piece++) {
        const double *one = pieces[piece];
        for (size_t k = 0; k < CLEAR_ARC + 2; k++) {
            const double share = k < CLEAR_ARC ? pupil->nodes[k] : (double)(k - CLEAR_ARC);
            const double t = one[1] + share * (one[2] - one[1]);
            const double x = one[0] + cos(t), y = sin(t);
            const size_t tip = k == CLEAR_ARC ? 2 * piece + 1 : 2 * ((piece + 1) % PIECES);
            double *point = points[k < CLEAR_ARC ? TIPS + piece * CLEAR_ARC + k : tip];
            point[0] = size * (x * cos(turn) - y * sin(turn));
            point[1] = size * (x * sin(turn) + y * cos(turn));
        }
    }
}

static void test_pieces(void)
{
    static const double sizes[] = {1e-5, 1, 1e5};
    struct clear_pupil pupil;
    double points[TIPS + ARMS][2];
    const double(*all)[2] = (const double(*)[2])points;
    size_t which;
    for (int i = 0; i < 900; i++) {
        const double size = sizes[i % 3], turn = 0.007 * i;
        put_pieces(size, turn, &pupil, points);
        for (int k = 0; k < 4; k++) {
            /* the direction before the turn */
            const double angle = k * PI / 2 - turn, x = cos(angle), y = sin(angle);
            const double reach = fabs(x) > 0.6 ? 1 - 0.6 * fabs(x) : 0.8 * fabs(y);
            const double sign = k < 2 ? 1 : -1;
            CHECK_NEAR(clear_extreme(&pupil, all, k % 2, sign, &which), sign * reach * size,
                       1e-13 * size, "two arcs");
            const size_t piece = (which - TIPS) / CLEAR_ARC;
            CHECK(fabs(x) < 0.61 || (which >= TIPS && (piece == 0) == (x > 0)));
        }
    }
    /* tips that stand out */
    put_pieces(1, 0, &pupil, points);
    for (size_t tip = 0; tip < TIPS; tip++) {
        const double before[2] = {points[tip][0], points[tip][1]};
        points[tip][0] = 0.41;
        points[tip][1] = -0.81;
        CHECK(clear_extreme(&pupil, all, 0, 1, &which) == 0.41 && which == tip);
        CHECK(clear_extreme(&pupil, all, 1, -1, &which) == -0.81 && which == tip);
        points[tip][0] = before[0];
        points[tip][1] = before[1];
    }
    struct clear_edge corners[TIPS];
    struct clear_arm arms[ARMS];
    pupil.corners = corners;
    pupil.arms = arms;
    for (size_t k = 0; k < TIPS + ARMS; k++) {
        CHECK(clear_edge_at(&pupil, k) == (k < TIPS ? &corners[k] : &arms[k - TIPS].edge));
    }
}

int main(void)
{
    test_lists();
    test_near();
    test_smooth_curve();
    test_step();
    test_pieces();
    return check_report();
}
