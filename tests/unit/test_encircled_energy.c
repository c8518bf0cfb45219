/* tests/unit/test_encircled_energy.c - the distance within which a share of the light lies. */
/* SPDX-License-Identifier: MIT */
#include "analysis/pupil/encircled_energy.h"
#include "base/constants.h"
#include "check.h"
#include "trace/aim/sample.h"

#include <math.h>

enum { MOST = 4096 };

/* An even disc of radius 1 whose middle lies `beside` the point that distances count from. */
struct disc {
    struct encircled_energy_mark marks[MOST];
    struct encircled_energy_sample sample;
    size_t arcs[2]; /* which the sample's sheets point to */
};

/* Given: arcs  0: equal arms all around; else so many arcs of `arms` arms each
          lost  every so many-th ray; 0: none */
static void make_disc(struct disc *disc, double beside, size_t rings, size_t arms, size_t arc_count,
                      size_t lost, struct arena *arena)
{
    disc->arcs[0] = disc->arcs[1] = arms;
    const struct bundle bundle = {.rings = rings,
                                  .arms = arc_count > 0 ? arms * arc_count : arms,
                                  .arcs = {arc_count > 0 ? disc->arcs : NULL, arc_count}};
    double places[64], shares[64], angles[256], parts[256];
    gauss_rule(rings, places, shares);
    gauss_rule(arms, angles, parts);
    struct encircled_energy_arms all = encircled_energy_arms_open(&bundle, NULL, arena);
    size_t count = 0;
    for (size_t i = 0; i < rings * bundle.arms; i++) {
        const size_t ring = i / bundle.arms, arm = i % bundle.arms;
        const double around = arc_count > 0
                                  ? ((double)(arm / arms) + angles[arm % arms]) / (double)arc_count
                                  : (double)arm / (double)arms;
        const double r = sqrt(places[ring]);
        if (lost > 0 && i % lost == 0) {
            encircled_energy_arms_add(&all, i, disc->marks, ENCIRCLED_ENERGY_ALONE);
            continue;
        }
        disc->marks[count] = (struct encircled_energy_mark){
            .at = {beside + r * sin(2 * PI * around), r * cos(2 * PI * around)},
            .weight = shares[ring] *
                      (arc_count > 0 ? parts[arm % arms] / (double)arc_count : 1 / (double)arms)};
        encircled_energy_arms_add(&all, i, disc->marks, count);
        count++;
    }
    disc->sample = (struct encircled_energy_sample){disc->marks, count, true, all.sheets};
}

/* The share of it within a distance: two circles overlap in two segments. */
static double overlap(double distance, double beside)
{
    const double d = beside, r = distance;
    if (r <= fabs(1 - d)) {
        return r <= 1 - d ? r * r : d >= 1 ? 0 : 1;
    }
    if (r >= 1 + d) {
        return 1;
    }
    const double a = acos((d * d + r * r - 1) / (2 * d * r)),
                 b = acos((d * d + 1 - r * r) / (2 * d));
    return (r * r * (a - sin(2 * a) / 2) + b - sin(2 * b) / 2) / PI;
}

static void test_disc(const char *what, double beside, size_t rings, size_t arms, size_t arc_count,
                      size_t lost, double tolerance)
{
    static struct disc disc;
    struct arena arena = {0};
    make_disc(&disc, beside, rings, arms, arc_count, lost, &arena);
    CHECK((disc.sample.sheets != NULL) == (lost == 0));
    for (int percent = 10; percent < 100; percent += 20) {
        const double distance = encircled_energy_find(&disc.sample, percent / 100.0, &arena);
        CHECK_NEAR(overlap(distance, beside), percent / 100.0, tolerance, what);
    }
    arena_free(&arena);
}

/* Rays by themselves: half of the light of each lies before it. Weights 1, 1, 2 at 1, 2 and 3. */
static void test_points(void)
{
    static const struct encircled_energy_mark marks[] = {{.at = {-1.8, 2.4}, .weight = 2},
                                                         {.at = {0.6, -0.8}, .weight = 1},
                                                         {.at = {0, 2}, .weight = 1}};
    static const double rows[][2] = {{0, 0},   {0.25, 0.5}, {0.5, 1}, {0.75, 1.25}, {1, 1.5},
                                     {1.5, 2}, {2, 7 / 3.}, {3, 3},   {3.5, 3},     {4, 3}};
    const struct encircled_energy_sample sample = {marks, 3, false, NULL};
    struct arena arena = {0};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        CHECK_NEAR(encircled_energy_find(&sample, rows[i][0] / 4, &arena), rows[i][1], 1e-15,
                   "of points");
    }
    arena_free(&arena);
}

/*
 * Arms that end early: of an even disc about its middle, cut off behind or before a ring, light
 * goes as far as that ring's own share of the area. Of the whole arm d^2 lies within d.
 */
static void test_cut_arms(void)
{
    enum { RINGS = 6, ARMS = 3 };
    static struct encircled_energy_mark marks[RINGS * ARMS];
    struct arena arena = {0};
    double places[RINGS], shares[RINGS];
    gauss_rule(RINGS, places, shares);
    for (size_t cut = 0; cut < 2 * RINGS - 1; cut++) {
        const size_t first = cut < RINGS ? 0 : cut - RINGS + 1, end = cut < RINGS ? cut + 1 : RINGS;
        const struct bundle bundle = {.rings = RINGS, .arms = ARMS};
        struct encircled_energy_arms all = encircled_energy_arms_open(&bundle, NULL, &arena);
        size_t count = 0;
        for (size_t i = 0; i < RINGS * ARMS; i++) {
            const size_t ring = i / ARMS;
            if (ring < first || ring >= end) {
                encircled_energy_arms_add(&all, i, marks, ENCIRCLED_ENERGY_ALONE);
                continue;
            }
            const double r = sqrt(places[ring]), turn = 2 * PI * (double)(i % ARMS) / ARMS;
            marks[count] = (struct encircled_energy_mark){.at = {r * sin(turn), r * cos(turn)},
                                                          .weight = shares[ring] / ARMS};
            encircled_energy_arms_add(&all, i, marks, count++);
        }
        if (end - first < 2) {
            continue; /* of one ring it is not known where its light goes */
        }
        const struct encircled_energy_sample sample = {marks, count, true, all.sheets};
        CHECK((all.sheets != NULL) == (count == RINGS * ARMS));
        const double from = fmax(places[first] - shares[first], 0);
        const double to = fmin(places[end - 1] + shares[end - 1], 1);
        for (int percent = 10; percent < 100; percent += 20) {
            const double share = percent / 100.0;
            CHECK_NEAR(encircled_energy_find(&sample, share, &arena),
                       sqrt(from + share * (to - from)), 1e-12, "of arms that are cut");
        }
    }
    arena_free(&arena);
}

int main(void)
{
    test_points();
    test_cut_arms();
    test_disc("with an arm lost", 0, 12, 25, 0, 25, 1e-12);
    test_disc("in its middle", 0, 4, 9, 0, 0, 1e-12);
    test_disc("in its middle, of arcs", 0, 8, 12, 2, 0, 1e-5);
    /* circles that touch rays' arms from within: what is missed falls as the power 3/2 of arms */
    test_disc("in it", 0.7, 12, 25, 0, 0, 1e-3);
    test_disc("in it, finely", 0.7, 32, 101, 0, 0, 1e-4);
    test_disc("in it, of arcs", 0.7, 12, 20, 2, 0, 1e-3);
    test_disc("beside it", 1.8, 12, 25, 0, 0, 3e-3);
    test_disc("beside it, finely", 1.8, 32, 101, 0, 0, 1e-3);
    test_disc("with rays lost", 0.7, 20, 41, 0, 97, 0.02);
    return check_report();
}
