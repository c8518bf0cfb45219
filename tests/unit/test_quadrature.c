/* tests/unit/test_quadrature.c - integrals over what is clear of a stop, in closed form. */
/* SPDX-License-Identifier: MIT */
#include "analysis/quadrature.h"
#include "check.h"
#include "file/lens_file.h"
#include "trace/aim.h"
#include "two_discs.h"

static const double STOP = 5, RIM = 8, GAP = 20; /* mm */

struct opened {
    struct lens lens;
    struct system open, clipped;
    struct first_order first;
};

static void open_text(const char *text, struct arena *arena, struct opened *opened)
{
    struct error error = {0};
    struct system_options options = system_options_default();
    CHECK(lens_read("test", text_of(text), NULL, arena, &opened->lens, &error));
    CHECK(system_compile(&opened->lens, 0.55, &options, arena, &opened->open, &error));
    options.clip = true;
    CHECK(system_compile(&opened->lens, 0.55, &options, arena, &opened->clipped, &error));
    CHECK(first_order_of_lens(&opened->lens, 0.55, SECTION_Y, arena, &opened->first, &error));
}

/* Sums of w, w x, w y and w r^2. */
static void sum_up(const struct sample *sample, double sums[4])
{
    sums[0] = sums[1] = sums[2] = sums[3] = 0;
    for (size_t i = 0; i < sample->count; i++) {
        const struct pupil_point *p = &sample->points[i];
        sums[0] += p->weight;
        sums[1] += p->weight * p->x;
        sums[2] += p->weight * p->y;
        sums[3] += p->weight * (p->x * p->x + p->y * p->y);
        CHECK(p->weight > 0 && hypot(p->x, p->y) <= 1 + 1e-9);
    }
}

/* Rays cross the stop, `z` behind where they start from, at their points. */
static void check_rays(const struct quadrature *all, double z, double radius)
{
    CHECK(all->rays.count == all->sample.count);
    for (size_t i = 0; i < all->sample.count; i++) {
        const struct ray ray = rays_get(&all->rays, i, 1);
        double t = (z - ray.point[2]) / ray.cosine[2];
        double x = ray.point[0] + t * ray.cosine[0], y = ray.point[1] + t * ray.cosine[1];
        CHECK_NEAR(x / radius, all->sample.points[i].x, 1e-12, "x in the stop");
        CHECK_NEAR(y / radius, all->sample.points[i].y, 1e-12, "y in the stop");
    }
}

/*
 * A hole of 16 mm, 20 mm before a stop of 10: fields in all directions, from those that pass whole
 * to those whose chief ray is lost and to those from which nothing passes.
 */
static void test_two_holes(size_t rays)
{
    static const double shifts[] = {0, 1, 2.9, 4, 6, 7.5, 8.5, 9.5, 11, 13.5};
    for (size_t i = 0; i < 3 * sizeof shifts / sizeof shifts[0]; i++) {
        struct arena arena = {0};
        struct opened opened;
        struct aim aim;
        struct error error;
        double shift = shifts[i / 3], t = atan(shift / GAP), turn = 0.4 + 1.9 * (double)i;
        double px = shift * sin(turn), py = shift * cos(turn), sums[4];
        const double angle[2] = {atan(tan(t) * sin(turn)), atan(tan(t) * cos(turn))};
        open_text("object inf\naperture stop\nsurface - 20 air 16\nstop - 10 air 10\n", &arena,
                  &opened);
        const struct beam beam = beam_from_infinity(angle, 1);
        CHECK(aim_open(&opened.open, &beam, &arena, &aim, &error));
        const double *m = aim.slope, k = STOP / (m[0] * m[3] - m[1] * m[2]);
        const struct stop_beam stop = {&opened.clipped,
                                       &aim.beam,
                                       {aim.chief[0], aim.chief[1]},
                                       {m[3] * k, -m[1] * k, -m[2] * k, m[0] * k},
                                       STOP};
        const struct quadrature all = quadrature_make(&stop, rays, &arena);
        CHECK(all.is_empty == (shift > STOP + RIM));
        if (!all.is_empty) {
            const struct region region =
                region_of((struct disc){0, 0, STOP}, (struct disc){px, py, RIM});
            double share = region.area / (PI * STOP * STOP);
            sum_up(&all.sample, sums);
            CHECK(all.sample.count >= rays && 2 * all.sample.count < 3 * rays);
            CHECK_NEAR(sums[0], share, 3e-7, "clear share of the stop");
            /* along an arm it goes with r, the root of what Gauss's points are spaced in */
            CHECK_NEAR(sums[1], share * region.centre[0] / STOP, 2e-5, "first moment in x");
            CHECK_NEAR(sums[2], share * region.centre[1] / STOP, 2e-5, "first moment in y");
            check_rays(&all, GAP, STOP);
            if (shift <= RIM - STOP) {
                CHECK_NEAR(sums[3], 0.5, 1e-9, "mean of r^2");
            }
        }
        arena_free(&arena);
    }
}

/* Without a stop the disc of u and v counts: here 6 or 10 mm wide, of which a hole leaves 8. */
static void test_no_stop(void)
{
    for (int i = 0; i < 2; i++) {
        struct arena arena = {0};
        struct opened opened;
        double radius = i == 0 ? 6 : 10, sums[4];
        const double angle[2] = {0.1, -0.2};
        open_text("object inf\nsurface - 20 air 16\nsurface - 10 air 60\n", &arena, &opened);
        const struct beam beam = beam_from_infinity(angle, 1);
        double places[3][2];
        for (int k = 0; k < 3; k++) {
            beam_place(&beam, (double[3]){k == 1 ? radius : 0, k == 2 ? radius : 0, 0}, places[k]);
        }
        const struct stop_beam stop = {&opened.clipped,
                                       &beam,
                                       {places[0][0], places[0][1]},
                                       {places[1][0] - places[0][0], places[2][0] - places[0][0],
                                        places[1][1] - places[0][1], places[2][1] - places[0][1]},
                                       NAN};
        const struct quadrature all = quadrature_make(&stop, 60, &arena);
        double clear = i == 0 ? 1 : 0.64;
        sum_up(&all.sample, sums);
        CHECK_NEAR(sums[0], clear, 1e-9, "clear share");
        CHECK_NEAR(sums[1], 0, 1e-9, "centred");
        CHECK_NEAR(sums[2], 0, 1e-9, "centred");
        CHECK_NEAR(sums[3], clear * clear / 2, 1e-9, "mean of r^2");
        check_rays(&all, 0, radius);
        arena_free(&arena);
    }
}

int main(void)
{
    test_two_holes(300);
    test_two_holes(9000); /* more directions than a block of rays has */
    test_no_stop();
    return check_report();
}
