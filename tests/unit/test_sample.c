/* tests/unit/test_sample.c - points of the pupil: moments of the disc, nets, counts. */
/* SPDX-License-Identifier: MIT */
#include "base/constants.h"
#include "check.h"
#include "trace/aim/sample.h"

#include <stdlib.h>

static struct sample make(enum pattern pattern, size_t rays, uint64_t seed, struct arena *arena)
{
    struct sample sample = {0};
    struct error error;
    CHECK(sample_make(pattern, rays, seed, arena, &sample, &error));
    return sample;
}

/* (k - 1)!!, for even k */
static double odd_product(int k)
{
    double product = 1;
    for (int i = k - 1; i > 1; i -= 2) {
        product *= i;
    }
    return product;
}

/* Mean of x^a y^b over the disc: 2/(a + b + 2) of r, (a-1)!! (b-1)!!/(a + b)!! of the angle. */
static double moment(int a, int b)
{
    if (a % 2 != 0 || b % 2 != 0) {
        return 0;
    }
    double even = 1;
    for (int i = a + b; i > 1; i -= 2) {
        even *= i;
    }
    return 2.0 / (a + b + 2) * odd_product(a) * odd_product(b) / even;
}

static double sampled(const struct sample *sample, int a, int b)
{
    double sum = 0;
    for (size_t i = 0; i < sample->count; i++) {
        sum += sample->points[i].weight * pow(sample->points[i].x, a) * pow(sample->points[i].y, b);
    }
    return sum;
}

/* k rings with 2k + 1 arms: exact up to the degree 2k, and no farther. */
static void test_gauss_moments(struct arena *arena)
{
    char what[100];
    for (size_t rings = 1; rings <= 12; rings++) {
        size_t count = rings * (2 * rings + 1);
        struct sample sample = make(PATTERN_GAUSS, count, 0, arena);
        int degree = 2 * (int)rings;
        CHECK(sample.count == count);
        for (int a = 0; a <= degree; a++) {
            for (int b = 0; a + b <= degree; b++) {
                snprintf(what, sizeof what, "%zu rings: mean of x^%d y^%d", rings, a, b);
                CHECK_NEAR(sampled(&sample, a, b), moment(a, b), 4e-16 * (double)(1 + rings), what);
            }
        }
        /* the arms are 2k + 1: y^(2k + 1) is seen where it should vanish */
        CHECK(fabs(sampled(&sample, 0, degree + 1)) > 1e-10);
    }
}

/* Gauss and Legendre on 0..1: x^m to degree 2n - 1, and the points mirrored about 1/2. */
static void test_gauss_rule(void)
{
    double x[200], w[200];
    char what[100];
    for (size_t n = 1; n <= 200; n += n < 20 ? 1 : 60) {
        gauss_rule(n, x, w);
        for (size_t m = 0; m < 2 * n; m++) {
            double sum = 0;
            for (size_t i = 0; i < n; i++) {
                sum += w[i] * pow(x[i], (double)m);
            }
            snprintf(what, sizeof what, "%zu points: integral of x^%zu", n, m);
            CHECK_NEAR(sum, 1 / (double)(m + 1), 1e-14, what);
        }
        for (size_t i = 0; i < n; i++) {
            CHECK_NEAR(x[i] + x[n - 1 - i], 1, 4e-16, "mirrored abscissas");
            CHECK(w[i] > 0 && x[i] > 0 && x[i] < 1 && (i == 0 || x[i] > x[i - 1]));
        }
    }
    /* Abramowitz and Stegun, table 25.4, n = 5: 0.906179845938664 and 0.236926885056189 on -1..1 */
    gauss_rule(5, x, w);
    CHECK_NEAR(2 * x[4] - 1, 0.906179845938664, 5e-16, "n = 5, x");
    CHECK_NEAR(2 * w[4], 0.236926885056189, 5e-16, "n = 5, w");
}

static void test_weights(struct arena *arena)
{
    for (int pattern = 0; pattern < PATTERNS; pattern++) {
        for (size_t rays = 1; rays <= 3000; rays = rays * 3 / 2 + 1) {
            struct sample sample = make((enum pattern)pattern, rays, 7, arena);
            double sum = 0, farthest = 0;
            for (size_t i = 0; i < sample.count; i++) {
                sum += sample.points[i].weight;
                farthest = fmax(farthest, hypot(sample.points[i].x, sample.points[i].y));
                CHECK(sample.points[i].weight > 0);
            }
            CHECK_NEAR(sum, 1, 1e-13, "weights");
            CHECK(farthest <= 1 + 2e-16);
            CHECK(sample.count >= rays || pattern == PATTERN_FAN);
        }
    }
}

/* Back from the disc to the square. */
static void to_square(const struct pupil_point *point, double square[2])
{
    double angle = atan2(point->x, point->y) / (2 * PI);
    square[0] = point->x * point->x + point->y * point->y;
    square[1] = angle < 0 ? angle + 1 : angle;
}

/*
 * 2^m points are a (0, m, 2)-net in base 2: one in each of the 2^m boxes of sides 2^-i and
 * 2^-(m-i), for every i; scrambling keeps that, for every seed, and so do later stretches of 2^m
 * points.
 */
static void test_nets(struct arena *arena)
{
    enum { BITS = 8, COUNT = 1 << BITS };
    for (uint64_t seed = 0; seed < 20; seed++) {
        struct sample sample = make(PATTERN_SOBOL, (size_t)4 * COUNT, seed, arena);
        for (size_t from = 0; from < sample.count; from += COUNT) {
            for (int bits = 0; bits <= BITS; bits++) {
                unsigned char seen[COUNT] = {0};
                size_t filled = 0;
                for (size_t i = 0; i < COUNT; i++) {
                    double square[2];
                    to_square(&sample.points[from + i], square);
                    size_t column = (size_t)(square[0] * (double)(1 << bits));
                    size_t row = (size_t)(square[1] * (double)(1 << (BITS - bits)));
                    size_t box = (column << (BITS - bits)) + row;
                    CHECK(box < COUNT);
                    filled += box < COUNT && !seen[box] ? 1 : 0;
                    seen[box < COUNT ? box : 0] = 1;
                }
                CHECK(filled == COUNT);
            }
        }
    }
}

/* Two seeds give two point sets; the same seed the same. */
static void test_seeds(struct arena *arena)
{
    struct sample a = make(PATTERN_SOBOL, 64, 1, arena), b = make(PATTERN_SOBOL, 64, 1, arena);
    struct sample c = make(PATTERN_SOBOL, 64, 2, arena),
                  longer = make(PATTERN_SOBOL, 128, 1, arena);
    size_t same = 0;
    for (size_t i = 0; i < 64; i++) {
        CHECK(a.points[i].x == b.points[i].x && a.points[i].y == b.points[i].y);
        CHECK(a.points[i].x == longer.points[i].x && a.points[i].y == longer.points[i].y);
        same += a.points[i].x == c.points[i].x ? 1 : 0;
    }
    CHECK(same < 4);
}

static void test_refused(struct arena *arena)
{
    struct sample sample;
    struct error error;
    CHECK(!sample_make(PATTERN_GAUSS, 0, 0, arena, &sample, &error) && error.code == ERROR_USAGE);
    CHECK(!sample_make(PATTERN_FAN, 2000000000, 0, arena, &sample, &error));
    CHECK(strstr(error.message, "1 to 1e9") != NULL);
}

/* Rings of 6 i rays at i/k of the radius, evenly from the top clockwise; a fan; a square grid. */
static void test_places(struct arena *arena)
{
    for (size_t rings = 1; rings <= 6; rings++) {
        size_t count = 1 + 3 * rings * (rings + 1), at = 1;
        struct sample sample = make(PATTERN_HEXAPOLAR, count, 0, arena);
        CHECK(sample.count == count && make(PATTERN_HEXAPOLAR, count + 1, 0, arena).count > count);
        CHECK(sample.points[0].x == 0 && sample.points[0].y == 0);
        for (size_t i = 1; i <= rings && sample.count == count; i++) {
            for (size_t k = 0; k < 6 * i; k++, at++) {
                double degrees = 60 * (double)k / (double)i, r = (double)i / (double)rings;
                CHECK_NEAR(sample.points[at].x, r * sin(degrees * PI / 180), 1e-15, "ring, x");
                CHECK_NEAR(sample.points[at].y, r * cos(degrees * PI / 180), 1e-15, "ring, y");
                CHECK_NEAR(sample.points[at].weight, 1 / (double)count, 1e-17, "ring, weight");
            }
        }
        CHECK(at == count);
    }
    /* 11 asked for: twice 2 * 3 + 1, of x first */
    struct sample fan = make(PATTERN_FAN, 11, 0, arena);
    CHECK(fan.count == 14);
    for (int i = 0; i < 14 && fan.count == 14; i++) {
        double along = (i % 7 - 3) / 3.0;
        CHECK_NEAR(fan.points[i].x, i < 7 ? along : 0, 1e-16, "fan, x");
        CHECK_NEAR(fan.points[i].y, i < 7 ? 0 : along, 1e-16, "fan, y");
        CHECK_NEAR(fan.points[i].weight, 1 / 14.0, 1e-17, "fan, weight");
    }
    CHECK(make(PATTERN_FAN, 5, 0, arena).count == 6 && make(PATTERN_FAN, 6, 0, arena).count == 6);
    CHECK(make(PATTERN_FAN, 7, 0, arena).count == 10);
    /* sides 2, 4 and 5: of 4 x 4 the corners lie outside, of 5 x 5 too: 0.8^2 + 0.8^2 > 1 */
    CHECK(make(PATTERN_SQUARE, 4, 0, arena).count == 4);
    CHECK(make(PATTERN_SQUARE, 12, 0, arena).count == 12);
    struct sample square = make(PATTERN_SQUARE, 21, 0, arena);
    size_t at = 0;
    CHECK(square.count == 21);
    for (int i = -2; i <= 2 && square.count == 21; i++) {
        for (int k = -2; k <= 2; k++) {
            if (i * i + k * k < 8) {
                CHECK_NEAR(square.points[at].x, 0.4 * k, 1e-16, "grid, x");
                CHECK_NEAR(square.points[at].y, 0.4 * i, 1e-16, "grid, y");
                CHECK_NEAR(square.points[at++].weight, 1 / 21.0, 1e-17, "grid, weight");
            }
        }
    }
}

int main(void)
{
    struct arena arena = {0};
    test_places(&arena);
    test_gauss_rule();
    test_gauss_moments(&arena);
    test_weights(&arena);
    test_nets(&arena);
    test_seeds(&arena);
    test_refused(&arena);
    arena_free(&arena);
    return check_report();
}
