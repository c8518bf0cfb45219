/* tests/unit/test_disc_rays.c - rays through a disc: its irradiance, the same bits. */
/* SPDX-License-Identifier: MIT */
#include "camera/film/film_rays.h"

#include "base/constants.h"
#include "check.h"

#include <string.h>

enum { BLOCKS = 128 };

/* E/L of a disc of half angle a, seen from off its axis by the angle t. */
static double irradiance(double t, double a)
{
    const double t2 = tan(t) * tan(t), a2 = tan(a) * tan(a);
    return PI / 2 * (1 - (1 + t2 - a2) / sqrt(t2 * t2 + 2 * t2 * (1 - a2) + (1 + a2) * (1 + a2)));
}

/* Samples of one point of the film, at x, y. */
static void look(double x, double y, uint32_t block, struct film_samples *samples)
{
    struct sobol sobol[2];
    for (uint32_t k = 0; k < 2; k++) {
        sobol_open(k, &sobol[k]);
        sobol_points(&sobol[k], sobol_scrambling(1, 2, k), block, k == 0 ? samples->u : samples->v);
    }
    for (int i = 0; i < RAYS_BLOCK; i++) {
        samples->x[i] = x;
        samples->y[i] = y;
    }
}

/* The mean of weights of rays within the disc; all rays are of unit length and hit the polygon. */
static double mean(const struct disc *disc, double x, double y, double radius)
{
    static struct film_samples samples;
    static struct ray_block block;
    double sum = 0, longest = 0, farthest = 0;
    for (uint32_t b = 0; b < BLOCKS; b++) {
        look(x, y, b, &samples);
        disc_start(disc, &samples, SET_BEST, &block);
        for (int i = 0; i < RAYS_BLOCK; i++) {
            const double p = block.p[i], q = block.q[i], r = block.r[i];
            const double way = (disc->place - block.z[i]) / r;
            const double out = hypot(block.x[i] + way * p, block.y[i] + way * q);
            longest = fmax(longest, fabs(p * p + q * q + r * r - disc->index * disc->index));
            farthest = fmax(farthest, out);
            sum += out <= radius ? samples.weight[i] : 0;
            CHECK(r < 0);
        }
    }
    CHECK(longest < 1e-14 && farthest < radius * 1.00031);
    return sum / BLOCKS / RAYS_BLOCK;
}

static void test_irradiance(void)
{
    static const double places[] = {-40, 300}; /* before the film, and behind it */
    for (int k = 0; k < 2; k++) {
        struct disc disc = {.film = 20, .place = places[k], .index = 1};
        const double z = fabs(disc.place - disc.film), radius = 0.3 * z;
        disc_open(radius, &disc);
        for (int i = 0; i < 5; i++) {
            const double h = 2 * i * z, angle = atan(h / z);
            CHECK_RELATIVE(mean(&disc, 0.6 * h, 0.8 * h, radius), irradiance(angle, atan(0.3)),
                           1e-3, "the disc's closed form");
        }
    }
}

static void test_pinhole(void)
{
    struct disc disc = {.film = 50, .place = 0, .index = 1.33};
    struct film_samples samples;
    struct ray_block block;
    disc_open_pinhole(2, &disc);
    look(3, -4, 0, &samples);
    disc_start(&disc, &samples, SET_BEST, &block);
    const double p = sqrt(2525), cosine = 50 / p;
    for (int i = 0; i < RAYS_BLOCK; i++) {
        CHECK_RELATIVE(samples.weight[i], 4 * PI * pow(cosine, 4) / 2500, 1e-14, "A cos^4/z^2");
        CHECK_NEAR(block.p[i], -1.33 * 3 / p, 1e-15, "through the middle");
        CHECK_NEAR(block.q[i], 1.33 * 4 / p, 1e-15, "through the middle");
    }
}

static void test_sets(void)
{
    static const enum instruction_set sets[] = {SET_AVX2, SET_AVX512};
    struct disc disc = {.film = 20, .place = -3, .index = 1};
    disc_open(5, &disc);
    struct film_samples samples, others;
    struct ray_block block, other;
    look(7, 11, 3, &samples);
    samples.x[0] = samples.y[0] = 0;
    others = samples;
    disc_start(&disc, &samples, SET_SSE2, &block);
    for (int i = 0; i < 2; i++) {
        if (instruction_set_works(sets[i])) {
            disc_start(&disc, &others, sets[i], &other);
            CHECK(memcmp(&block, &other, sizeof block) == 0);
            CHECK(memcmp(samples.weight, others.weight, sizeof others.weight) == 0);
        }
    }
}

int main(void)
{
    test_irradiance();
    test_pinhole();
    test_sets();
    return check_report();
}
