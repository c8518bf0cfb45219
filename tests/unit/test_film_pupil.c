/* tests/unit/test_film_pupil.c - pupils by film radius: they hold all light, and little else. */
/* SPDX-License-Identifier: MIT */
#include "analysis/illumination.h"
#include "base/sobol.h"
#include "camera/film_pupil.h"
#include "check.h"
#include "data/whole_file.h"
#include "file/lens_file.h"
#include "optics/aperture.h"
#include "trace/dispatch.h"

#include <stdlib.h>

/* A lens from the film's side. */
struct opened {
    struct arena arena;
    struct lens lens;
    struct first_order first;
    struct system clipped, open;
    struct film_pupil pupil;
};

static bool set_up(struct opened *opened, const char *path, double reach, struct error *error)
{
    struct text text;
    struct arena *arena = &opened->arena;
    struct system_options options = system_options_default();
    if (!whole_file(path, arena, &text, error) ||
        !lens_read(path, text, NULL, arena, &opened->lens, error)) {
        return false;
    }
    const double wavelength = lens_primary_wavelength(&opened->lens);
    const struct aperture_setting aperture = lens_aperture(&opened->lens);
    const struct conjugate_object object = lens_object(&opened->lens);
    options.reverse = true;
    if (!first_order_of_lens(&opened->lens, wavelength, SECTION_Y, arena, &opened->first, error) ||
        !first_order_aperture(&opened->first, &object, &aperture, FIELD_NONE, 0, error) ||
        !system_compile(&opened->lens, wavelength, &options, arena, &opened->open, error)) {
        return false;
    }
    options.clip = true;
    if (!system_compile(&opened->lens, wavelength, &options, arena, &opened->clipped, error)) {
        return false;
    }
    const struct system *systems[] = {&opened->clipped};
    const struct film_pupil_question question = {systems, 1, &opened->first, opened->first.image,
                                                 reach};
    return film_pupil_open(&question, arena, &opened->pupil, error);
}

/* Irradiance by `count` rays of the table, the share of them that arrives. */
struct sampled {
    double value, survivors;
};

static struct sampled sample(struct opened *opened, double radius, size_t count)
{
    struct sobol sobol[2];
    struct sampled sum = {0, 0};
    const struct arena_mark mark = arena_mark(&opened->arena);
    const struct rays rays = rays_new(&opened->arena, count);
    double *weights = ARENA_ARRAY(&opened->arena, count, double);
    for (uint32_t d = 0; d < 2; d++) {
        sobol_open(d, &sobol[d]);
    }
    for (size_t i = 0; i < count; i++) {
        const double u = sobol_point(&sobol[0], sobol_scrambling(1, 0, 0), (uint32_t)i);
        const double v = sobol_point(&sobol[1], sobol_scrambling(1, 0, 1), (uint32_t)i);
        const struct film_direction way = film_pupil_direction(&opened->pupil, radius, u, v);
        const double z = -sqrt(1 - way.x * way.x - way.y * way.y);
        const struct ray ray = {.point = {0, radius, opened->pupil.image},
                                .cosine = {way.x, way.y, z}};
        rays_set(&rays, i, opened->clipped.index_first, &ray);
        weights[i] = way.weight;
    }
    rays_trace(&opened->clipped, &rays, NULL);
    for (size_t i = 0; i < count; i++) {
        const bool arrives =
            ray_block_status(&rays.blocks[i / RAYS_BLOCK], i % RAYS_BLOCK) == RAY_OK;
        sum.value += arrives ? weights[i] / (double)count : 0;
        sum.survivors += arrives ? 1 / (double)count : 0;
    }
    arena_reset(&opened->arena, mark);
    return sum;
}

static struct illumination truth_at(struct opened *opened, double radius)
{
    const struct beam beam = beam_to_pupil((double[3]){0, radius, opened->pupil.image},
                                           opened->first.exit_pupil, opened->clipped.index_first);
    const struct illumination_question question = {.clipped = &opened->clipped,
                                                   .open = &opened->open,
                                                   .beam = &beam,
                                                   .first = &opened->first,
                                                   .error = 1e-7};
    return illumination_of_film(&question, &opened->arena);
}

/*
 * Light in the film, at the paraxial focus, as the table samples it.
 *
 * golden: the reference's quadrature of 3000^2 rays, about 1e-4 accurate; NaN: it has none there
 */
static const struct known {
    const char *name;
    double reach;
    double radius[4], golden[4];
} known[] = {
    {"cs348b-dgauss-50", 21.633, {0, 5, 10, 20}, {.192512, .167216, .125716, .042577}},
    {"cs348b-wide-22", 17, {0, 5, 10, 13.5}, {.101025, .086408, .062632, .045164}},
    {"cs348b-telephoto-250", 21.633, {0, 10, 20, 21.633}, {.025110, .024934, .024410, .024148}},
    {"cs348b-fisheye-10", 12, {0, 4, 8, 12}, {.049239, .041914, .027329, .012785}},
    /* aspheres */
    {"phone-80deg", 2.8, {0, 1, 2, 2.8}, {NAN, NAN, NAN, NAN}},
};

static void test_known(const struct known *lens)
{
    enum { COUNT = 1 << 18 };
    struct opened *opened = calloc(1, sizeof *opened);
    struct error error = {0};
    char path[100], what[150];
    snprintf(path, sizeof path, "lensdb/lenses/%s.lens", lens->name);
    if (!set_up(opened, path, lens->reach, &error)) {
        CHECK_TEXT(error.message, lens->name);
    }
    for (int i = 0; i < 4 && error.code == ERROR_NONE; i++) {
        const double radius = lens->radius[i];
        const struct sampled got = sample(opened, radius, COUNT);
        snprintf(what, sizeof what, "%s at %g mm", lens->name, radius);
        CHECK_RELATIVE(got.value, truth_at(opened, radius).value, 1e-4, what);
        CHECK_NEAR(got.survivors, 1, 0.01, what);
        if (!isnan(lens->golden[i])) {
            CHECK_RELATIVE(got.value, lens->golden[i], 2e-4, what);
        }
    }
    arena_free(&opened->arena);
    free(opened);
}

/* Beyond the circle of light there is none; at its edge little is left out. */
static void test_beyond(void)
{
    struct opened *opened = calloc(1, sizeof *opened);
    struct error error;
    CHECK(set_up(opened, "lensdb/lenses/cs348b-dgauss-50.lens", 60, &error));
    for (double radius = 0; radius <= 60; radius += 60 / 17.0) {
        const struct sampled got = sample(opened, radius, 1 << 14);
        const double truth = truth_at(opened, radius).value;
        CHECK_NEAR(got.value, truth, 2e-3 * truth + 1e-6, "over the circle of light");
    }
    arena_free(&opened->arena);
    free(opened);
}

/* The union of wavelengths: what any of them sends through lies within. */
static void test_union(void)
{
    struct opened *opened = calloc(1, sizeof *opened);
    struct error error;
    struct system_options options = system_options_default();
    struct system blue, red;
    CHECK(set_up(opened, "lensdb/lenses/cs348b-fisheye-10.lens", 12, &error));
    options.reverse = options.clip = true;
    CHECK(system_compile(&opened->lens, 0.42, &options, &opened->arena, &blue, &error));
    CHECK(system_compile(&opened->lens, 0.70, &options, &opened->arena, &red, &error));
    const struct system *systems[] = {&blue, &red};
    const struct film_pupil_question question = {systems, 2, &opened->first, opened->first.image,
                                                 12};
    CHECK(film_pupil_open(&question, &opened->arena, &opened->pupil, &error));
    for (int i = 0; i < 2; i++) {
        opened->clipped = *systems[i];
        CHECK(system_compile(
            &opened->lens, systems[i]->wavelength,
            &(struct system_options){.reverse = true, .image = NAN, .stop_radius = NAN},
            &opened->arena, &opened->open, &error));
        for (double radius = 0; radius <= 12; radius += 4) {
            const struct sampled got = sample(opened, radius, 1 << 18);
            CHECK_RELATIVE(got.value, truth_at(opened, radius).value, 1e-4, "union");
            CHECK(got.survivors > 0.97);
        }
    }
    arena_free(&opened->arena);
    free(opened);
}

static void check_refused(const char *path, const char *message)
{
    struct opened *opened = calloc(1, sizeof *opened);
    struct error error = {0};
    CHECK(!set_up(opened, path, 3, &error) && error.code == ERROR_DOMAIN);
    CHECK_TEXT(error.message, message);
    arena_free(&opened->arena);
    free(opened);
}

int main(void)
{
    for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
        test_known(&known[i]);
    }
    test_beyond();
    test_union();
    check_refused("lensdb/lenses/phone-6p.lens",
                  "the stop has no diameter: the amount of light is unknown");
    check_refused("lensdb/lenses/cooke-anamorphic-bad.lens",
                  "the lens is not the same in all directions");
    return check_report();
}
