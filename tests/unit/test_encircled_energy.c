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

int main(void)
{
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
