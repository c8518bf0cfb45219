/* tests/unit/test_quadrature.c - integrals over what is clear of a stop, in closed form. */
/* SPDX-License-Identifier: MIT */
#include "analysis/pupil/quadrature.h"
#include "analysis/setup/setup.h"
#include "base/constants.h"
#include "check.h"
#include "exchange/lens_open.h"
#include "file/lens_file.h"
#include "trace/aim/aim.h"
#include "trace/dispatch.h"
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
        const struct stop_beam stop = stop_beam_of_stop(&aim, &opened.clipped, WEIGHT_PUPIL);
        const struct quadrature all = quadrature_make(&stop, rays, &arena);
        CHECK(all.is_empty == (shift > STOP + RIM));
        if (!all.is_empty) {
            const struct region region =
                region_of((struct disc){0, 0, STOP}, (struct disc){px, py, RIM});
            double share = region.area / (PI * STOP * STOP);
            sum_up(&all.sample, sums);
            CHECK(all.sample.count >= rays && 2 * all.sample.count < 3 * rays);
            CHECK_NEAR(sums[0], share, 5e-8, "clear share of the stop");
            CHECK_NEAR(sums[1], share * region.centre[0] / STOP, 3e-7, "first moment in x");
            CHECK_NEAR(sums[2], share * region.centre[1] / STOP, 3e-7, "first moment in y");
            check_rays(&all, GAP, STOP);
            if (shift <= RIM - STOP) {
                CHECK_NEAR(sums[3], 0.5, 1e-9, "mean of r^2");
            }
        }
        arena_free(&arena);
    }
}

/* Of a star that knows one of two rims alone edges show the corners: those of two circles. */
static void test_learning(void)
{
    enum { WAYS = 24 };
    const double shift = 6;
    struct arena arena = {0};
    struct opened opened;
    struct aim aim;
    struct error error;
    open_text("object inf\naperture stop\nsurface - 20 air 16\nstop - 10 air 10\n", &arena,
              &opened);
    const struct beam beam = beam_from_infinity((double[2]){0, atan(shift / GAP)}, 1);
    CHECK(aim_open(&opened.open, &beam, &arena, &aim, &error));
    const struct stop_beam stop = stop_beam_of_stop(&aim, &opened.clipped, WEIGHT_PUPIL);
    struct quadrature_region region = quadrature_open(&stop, &arena);
    const struct pupil_boundary *found = quadrature_boundary(&region, &arena);
    struct pupil_boundary boundary = *found;
    double angles[WAYS];
    struct edge edges[WAYS];
    size_t rim = found->edges[0].limit;
    boundary.count = boundary.corner_count = 0;
    for (size_t i = 0; i < found->count; i++) {
        if (found->edges[i].limit == rim) {
            boundary.angles[boundary.count] = found->angles[i];
            boundary.edges[boundary.count++] = found->edges[i];
        }
    }
    pupil_boundary_join(&boundary);
    CHECK(boundary.count > 0 && boundary.count < found->count);
    for (size_t i = 0; i < WAYS; i++) {
        angles[i] = 2 * PI * (double)i / WAYS;
    }
    edges_find(&region.margins, &boundary.frame, angles, NULL, WAYS, 0, 1e-13, edges);
    CHECK(pupil_boundary_learn(&region.margins, angles, WAYS, edges, &boundary));
    CHECK(!pupil_boundary_learn(&region.margins, angles, WAYS, edges, &boundary));
    CHECK(boundary.corner_count == 2);
    /* of the circles x^2 + y^2 = 25 and x^2 + (y - 6)^2 = 64 in the stop: y = -1/4 */
    for (size_t k = 0; k < boundary.corner_count; k++) {
        double at[2], place[2];
        edge_point(&boundary.frame, boundary.corners[k], boundary.radii[k], at);
        stop_beam_place(&stop, at[0], at[1], place);
        const struct ray ray = beam_ray(&beam, place[0], place[1]);
        const double t = (GAP - ray.point[2]) / ray.cosine[2];
        CHECK_NEAR(fabs(ray.point[0] + t * ray.cosine[0]), sqrt(25 - 1. / 16), 1e-9,
                   "x of a corner");
        CHECK_NEAR(ray.point[1] + t * ray.cosine[1], -0.25, 1e-9, "y of a corner");
    }
    arena_free(&arena);
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
        const struct stop_beam stop = {
            .system = &opened.clipped,
            .beam = &beam,
            .origin = {places[0][0], places[0][1]},
            .axes = {places[1][0] - places[0][0], places[2][0] - places[0][0],
                     places[1][1] - places[0][1], places[2][1] - places[0][1]},
            .radius = NAN};
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

/*
 * A near object off the axis sees the disc of the entrance pupil as an ellipse, which equal areas
 * of the beam fill evenly: its centre and its semi-axis lie between two ends.
 */
static void test_projection(void)
{
    for (int is_beam = 0; is_beam < 2; is_beam++) {
        struct arena arena = {0};
        struct opened opened;
        struct error error;
        struct beam beam;
        struct stop_beam pupil;
        double sums[4], ends[2][2], mean = 0, square = 0;
        open_text("object 60\naperture stop\nsurface - 20 air 60\nstop - 10 air 40\n", &arena,
                  &opened);
        const struct conjugate_object object = lens_object(&opened.lens);
        const struct aperture_setting aperture = lens_aperture(&opened.lens);
        CHECK(first_order_aperture(&opened.first, &object, &aperture, FIELD_NONE, NAN, &error));
        CHECK(beam_from_point((double[3]){0, 45, -60}, 1, &beam, &error));
        CHECK(stop_beam_of_entrance(&opened.open, &beam, &opened.first,
                                    is_beam ? WEIGHT_BEAM : WEIGHT_PUPIL, &pupil, &error));
        const struct quadrature all = quadrature_make(&pupil, 900, &arena);
        sum_up(&all.sample, sums);
        CHECK_NEAR(sums[0], 1, 1e-10, "share");
        check_rays(&all, 20, 20);
        if (!is_beam) {
            CHECK_NEAR(sums[2], 0, 1e-14, "even in the pupil");
            CHECK_NEAR(sums[3], 0.5, 1e-10, "even in the pupil");
        }
        for (size_t i = 0; i < all.sample.count; i++) {
            double at[2];
            const struct ray ray = rays_get(&all.rays, i, 1);
            beam_place(&beam, ray.point, at);
            mean += all.sample.points[i].weight * at[1];
            square += all.sample.points[i].weight * at[1] * at[1];
        }
        beam_place(&beam, (double[3]){0, 20, 20}, ends[0]);
        beam_place(&beam, (double[3]){0, -20, 20}, ends[1]);
        double centre = (ends[0][1] + ends[1][1]) / 2, half = (ends[0][1] - ends[1][1]) / 2;
        bool is_even =
            fabs(mean - centre) < 1e-9 && fabs(square - mean * mean - half * half / 4) < 1e-9;
        CHECK(is_even == (is_beam == 1));
        arena_free(&arena);
    }
}

/* -------- spots -------- */

struct spot_case {
    const char *lens;
    double fnumber, field; /* NaN = the lens's own; degrees */
    bool clip, to_entrance;
    enum stop_weight weight;
    size_t rays;
    double rms, tolerance; /* um */
};

/* RMS about the centroid of weighted points. */
static double rms_of(const struct sample *sample, const struct rays *rays, double n)
{
    double sum = 0, at[2] = {0, 0}, square = 0;
    for (size_t i = 0; i < sample->count; i++) {
        const struct ray ray = rays_get(rays, i, n);
        CHECK(ray.status == RAY_OK);
        sum += sample->points[i].weight;
        at[0] += sample->points[i].weight * ray.point[0];
        at[1] += sample->points[i].weight * ray.point[1];
    }
    for (size_t i = 0; i < sample->count; i++) {
        const struct ray ray = rays_get(rays, i, n);
        double x = ray.point[0] - at[0] / sum, y = ray.point[1] - at[1] / sum;
        square += sample->points[i].weight * (x * x + y * y);
    }
    return sqrt(square / sum);
}

/* At the d line, in the paraxial image plane; um. */
static double spot_of(const struct spot_case *one, size_t rays, struct arena *arena)
{
    struct lensdb db = {.arena = arena};
    struct lens lens;
    struct setup setup;
    struct error error;
    struct beam beam;
    struct aim aim;
    struct stop_beam pupil;
    const struct setup_field field = {{FIELD_ANGLE, {0, one->field * RADIANS_PER_DEGREE}}, 1};
    CHECK(lens_open(&db, text_of(one->lens), arena, &lens, &error));
    const struct setup_question question = {.lens = &lens,
                                            .wavelength = 0.5875618,
                                            .fnumber = one->fnumber,
                                            .fields = &field,
                                            .field_count = 1};
    CHECK(setup_open(&question, arena, &setup, &error));
    CHECK(setup_place_image(&setup, &(struct plane_value){.kind = PLANE_PARAXIAL}, &error));
    const struct system *open = setup_system(&setup, 0, SETUP_OPEN | SETUP_IMAGE, &error);
    const struct system *clear =
        setup_system(&setup, 0, (one->clip ? SETUP_CLIPPED : SETUP_OPEN) | SETUP_IMAGE, &error);
    CHECK(setup_beam(&setup, &field.point, &beam, &error));
    if (one->to_entrance) {
        CHECK(stop_beam_of_entrance(clear, &beam, &setup.first, one->weight, &pupil, &error));
    } else {
        CHECK(aim_open(open, &beam, arena, &aim, &error));
        pupil = stop_beam_of_stop(&aim, clear, one->weight);
    }
    const struct quadrature all = quadrature_make(&pupil, rays, arena);
    rays_trace(clear, &all.rays, NULL);
    return 1e3 * rms_of(&all.sample, &all.rays, clear->index_last);
}

/*
 * The paraxial entrance pupil whole: golden values of an independent program with 50 digits. With
 * rims, equal areas of the stop and of the beam: a prototype's, converged to all digits here.
 */
static void test_spots(void)
{
    static const struct spot_case cases[] = {
        {"double-gauss", 2, 0, false, true, WEIGHT_PUPIL, 600, 31.500230, 6e-7},
        {"double-gauss", 2, 10, false, true, WEIGHT_PUPIL, 600, 206.056176, 6e-7},
        {"double-gauss", 2, 14, false, true, WEIGHT_PUPIL, 600, 374.155069, 6e-7},
        {"double-gauss", NAN, 14, true, false, WEIGHT_PUPIL, 400, 74.5987, 6e-5},
        {"double-gauss", NAN, 14, true, false, WEIGHT_BEAM, 162, 74.843921, 7e-5},
        {"double-gauss", NAN, 14, true, false, WEIGHT_BEAM, 338, 74.843921, 6e-7},
        {"cs348b-dgauss-50", NAN, 22, true, false, WEIGHT_BEAM, 162, 48.428111, 5e-5},
        {"cs348b-dgauss-50", NAN, 22, true, false, WEIGHT_BEAM, 338, 48.428111, 1e-6},
        {"nikkor-z-58-f095", NAN, 18, true, false, WEIGHT_BEAM, 648, 8.701232, 9e-6},
        {"nikkor-z-58-f095", NAN, 18, true, false, WEIGHT_BEAM, 1300, 8.701232, 6e-7},
        {"fisheye-16", NAN, 60, true, false, WEIGHT_BEAM, 162, 16.821149, 4e-5},
        {"fisheye-16", NAN, 60, true, false, WEIGHT_BEAM, 338, 16.821149, 6e-7}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct arena arena = {0};
        double rms = spot_of(&cases[i], cases[i].rays, &arena);
        CHECK_NEAR(rms, cases[i].rms, cases[i].tolerance, cases[i].lens);
        arena_free(&arena);
    }
}

int main(void)
{
    test_two_holes(300);
    test_two_holes(9000); /* more directions than a block of rays has */
    test_learning();
    test_no_stop();
    test_projection();
    test_spots();
    return check_report();
}
