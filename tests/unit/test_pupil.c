/* tests/unit/test_pupil.c - beams, chief rays and clear pupils against closed forms. */
/* SPDX-License-Identifier: MIT */
#include "analysis/pupil/pupil_shape.h"
#include "base/constants.h"
#include "check.h"
#include "exchange/lens_open.h"
#include "file/lens_file.h"
#include "trace/aim/aim.h"
#include "trace/dispatch.h"
#include "trace/pupil/clear.h"

#include <string.h>

static const double pi = PI, degree = RADIANS_PER_DEGREE;

struct opened {
    struct lens lens;
    struct system system;
    struct first_order first;
    struct conjugate_object object;
};

static void compile(struct opened *opened, bool clip, struct arena *arena)
{
    struct error error;
    struct system_options options = system_options_default();
    double wavelength = lens_primary_wavelength(&opened->lens);
    options.clip = clip;
    options.path = true;
    opened->object = lens_object(&opened->lens);
    CHECK(system_compile(&opened->lens, wavelength, &options, arena, &opened->system, &error));
    CHECK(first_order_of_lens(&opened->lens, wavelength, SECTION_Y, arena, &opened->first, &error));
}

static void open_text(const char *text, bool clip, struct arena *arena, struct opened *opened)
{
    struct error error;
    bool read = lens_read("test", text_of(text), NULL, arena, &opened->lens, &error);
    if (!read) {
        printf("%s\n", error.message);
    }
    CHECK(read);
    compile(opened, clip, arena);
}

static void open_named(const char *name, bool clip, struct arena *arena, struct opened *opened)
{
    struct lensdb db = {.arena = arena};
    struct error error;
    CHECK(lens_open(&db, text_of(name), arena, &opened->lens, &error));
    compile(opened, clip, arena);
}

static struct beam beam_at(const struct opened *opened, double x, double y)
{
    struct field_point field = {opened->object.is_infinite ? FIELD_ANGLE : FIELD_HEIGHT, {x, y}};
    struct beam beam;
    struct error error;
    CHECK(beam_of_field(&field, &opened->object, &opened->first, &beam, &error));
    return beam;
}

/* Where a ray of the lens crosses the stop, in the stop's own frame. */
static struct ray in_stop(const struct opened *opened, const struct ray *start, struct arena *arena)
{
    struct rays rays = rays_new(arena, 1);
    const struct system *system = &opened->system;
    rays_set(&rays, 0, system->index_first, start);
    rays_trace_part(system, 0, system->stop + 1, &rays, NULL);
    struct ray ray = rays_get(&rays, 0, system_index_after(system, system->stop));
    system_to_own(system, system->stop, ray.point);
    return ray;
}

static void check_point(const struct opened *opened, const struct aim *aim, double x, double y,
                        double allowed, const char *what, struct arena *arena)
{
    struct ray ray = aim_ray(aim, x, y);
    CHECK(ray.status == RAY_OK);
    ray = in_stop(opened, &ray, arena);
    CHECK_NEAR(ray.point[0], x * aim->stop_radius, allowed, what);
    CHECK_NEAR(ray.point[1], y * aim->stop_radius, allowed, what);
    CHECK_NEAR(ray.point[2], 0, 1e-12, what);
}

/* -------- beams -------- */

/* beam_place undoes beam_ray, along the whole line, for fields of 90 degrees and beyond too. */
static void test_places(void)
{
    for (int t = 0; t < 180; t += 15) {
        for (int turn = 0; turn < 360; turn += 45) {
            /* of the tangents tan t sin turn, tan t cos turn; beyond 90 along one axis only */
            const double side[2] = {sin(turn * degree), cos(turn * degree)};
            double angle[2] = {atan(tan(t * degree) * side[0]), atan(tan(t * degree) * side[1])};
            if (turn % 90 == 0) {
                angle[0] = t * degree * round(side[0]);
                angle[1] = t * degree * round(side[1]);
            } else if (t >= 90) {
                continue;
            }
            struct beam beam = beam_from_infinity(angle, 1);
            struct ray ray = beam_ray(&beam, 3, -4);
            double place[2], point[3];
            CHECK_NEAR(ray.cosine[2], cos(t * degree), 5e-16, "direction of the field");
            for (int i = 0; i < 3; i++) {
                point[i] = ray.point[i] + 50 * ray.cosine[i];
            }
            beam_place(&beam, point, place);
            CHECK_NEAR(place[0], 3, 2e-14, "place, a");
            CHECK_NEAR(place[1], -4, 2e-14, "place, b");
        }
    }
}

/* A block filled at once holds the bits of rays put in one by one. */
static void test_fill(struct arena *arena)
{
    struct rays one = rays_new(arena, RAYS_BLOCK), all = rays_new(arena, RAYS_BLOCK);
    struct beam beams[2] = {beam_from_infinity((double[2]){0.3, 0.7}, 1.33)};
    struct error error;
    double at[RAYS_BLOCK][2];
    CHECK(beam_from_point((double[3]){1, -7, -90}, 1.33, &beams[1], &error));
    for (size_t k = 0; k < 2; k++) {
        for (size_t i = 0; i < RAYS_BLOCK; i++) {
            at[i][0] = 0.37 * (double)i - 11;
            at[i][1] = 5 - 0.11 * (double)i;
            struct ray ray = beam_ray(&beams[k], at[i][0], at[i][1]);
            rays_set(&one, i, beams[k].n, &ray);
        }
        beam_fill(&beams[k], (const double(*)[2])at, RAYS_BLOCK, all.blocks);
        CHECK(memcmp(one.blocks, all.blocks, sizeof *one.blocks) == 0);
    }
}

/* All rays of a near or virtual point go through it; path + way is the same for all of them. */
static void test_sampler(void)
{
    const double points[][3] = {
        {0, 0, -100}, {0, 30, -100}, {-20, 5, -3}, {0, 0, 80}, {10, -20, 60}};
    struct error error;
    struct beam beam;
    for (size_t k = 0; k < sizeof points / sizeof points[0]; k++) {
        const double *object = points[k], n = 1.5;
        CHECK(beam_from_point(object, n, &beam, &error));
        CHECK(beam.axis[2] > 0);
        double away = sqrt(object[0] * object[0] + object[1] * object[1] + object[2] * object[2]);
        double sign = object[2] > 0 ? -1 : 1;
        for (int i = 0; i < 4; i++) {
            struct ray ray = beam_ray(&beam, 2 * i, 5 - 3 * i);
            double way = 0, missed = 0, along = 0;
            for (int j = 0; j < 3; j++) {
                double d = ray.point[j] - object[j];
                way += d * d;
                along += d * ray.cosine[j];
            }
            for (int j = 0; j < 3; j++) {
                missed = fmax(missed, fabs(ray.point[j] - along * ray.cosine[j] - object[j]));
            }
            CHECK(missed < 1e-13);
            CHECK(along * sign > 0);
            CHECK_NEAR(ray.path, sign * n * (sqrt(way) - away), 1e-13, "path from the point");
        }
    }
    CHECK(!beam_from_point((double[3]){0, 0, 0}, 1, &beam, &error));
    CHECK(error.code == ERROR_DOMAIN);
}

/* So far away that it cannot be told from infinity: the same to the last digits. */
static void test_far_object(void)
{
    struct error error;
    struct beam near, far = beam_from_infinity((double[2]){0, 0.3}, 1);
    for (double distance = 1e12; distance < 1e22; distance *= 1e3) {
        const double object[3] = {0, -distance * sin(0.3), -distance * cos(0.3)};
        CHECK(beam_from_point(object, 1, &near, &error));
        struct ray a = beam_ray(&near, 7, 11), b = beam_ray(&far, 7, 11);
        double slope = 13.1 / distance + 3e-16;
        for (int i = 0; i < 3; i++) {
            CHECK_NEAR(a.point[i], b.point[i], 5e-15, "far: point");
            CHECK_NEAR(a.cosine[i], b.cosine[i], slope, "far: cosine");
        }
        CHECK_NEAR(a.path - b.path, (7 * 7 + 11 * 11) / (2 * distance), 1e-15, "far: path");
    }
}

/* -------- chief rays -------- */

/* A stop that is not on the axis, alone in air: rays go through it on straight lines. */
static void test_decentred_stop(struct arena *arena)
{
    struct opened opened;
    struct aim aim;
    struct error error;
    open_text("lens stop\nobject inf\naperture stop\nsurface - 20 air -\n"
              "stop - 10 air 6 decenter=1,-2\nsurface - 10 air -\n",
              false, arena, &opened);
    for (int t = -40; t <= 40; t += 20) {
        double slope = tan(t * degree);
        struct beam beam = beam_at(&opened, 0, t * degree);
        bool open = aim_open(&opened.system, &beam, arena, &aim, &error);
        CHECK(open);
        if (!open) {
            continue;
        }
        struct ray ray = aim_chief(&aim);
        double way = -ray.point[2] / ray.cosine[2];
        CHECK_NEAR(ray.point[0] + way * ray.cosine[0], 1, 1e-13, "decentred stop: chief x");
        CHECK_NEAR(ray.point[1] + way * ray.cosine[1], -2 - 20 * slope, 1e-13,
                   "decentred stop: chief y");
        check_point(&opened, &aim, 0.6, -0.8, 1e-12, "decentred stop", arena);
    }
}

/* A tilted stop: its own plane counts, of which the far side is reached at another z. */
static void test_tilted_stop(struct arena *arena)
{
    struct opened opened;
    struct aim aim;
    struct error error;
    open_text("lens stop\nobject inf\naperture stop\nsurface - 20 air -\n"
              "stop - 10 air 6 tilt=30,0\nsurface - 10 air -\n",
              false, arena, &opened);
    struct beam beam = beam_at(&opened, 0, 0);
    CHECK(aim_open(&opened.system, &beam, arena, &aim, &error));
    struct ray ray = aim_ray(&aim, 0, 1);
    CHECK_NEAR(ray.point[1], 3 * cos(30 * degree), 1e-13, "tilted stop: its edge, foreshortened");
    check_point(&opened, &aim, 0.6, -0.8, 1e-12, "tilted stop", arena);
}

/* A plane plate at an angle shifts the ray by t sin a (1 - cos a/sqrt(n^2 - sin^2 a)). */
static void test_tilted_plate(struct arena *arena)
{
    struct opened opened;
    struct aim aim;
    struct error error;
    const double n = 1.5, t = 8, a = 35 * degree;
    open_text("lens plate\nobject inf\naperture stop\nbend tilt=35,0\nsurface - 8 1.5 -\n"
              "surface - 0 air -\nbend tilt=-35,0\nsurface - 30 air -\nstop - 10 air 6\n",
              false, arena, &opened);
    struct beam beam = beam_at(&opened, 0, 0);
    CHECK(aim_open(&opened.system, &beam, arena, &aim, &error));
    struct ray ray = aim_chief(&aim);
    double shift = t * sin(a) * (1 - cos(a) / sqrt(n * n - sin(a) * sin(a)));
    /* the axis bends with the plate and back: the stop lies t sin a beside the first vertex */
    double across = hypot(ray.point[0], ray.point[1]);
    CHECK_NEAR(across, t * sin(a) - shift, 1e-12, "tilted plate: shift of the chief ray");
    check_point(&opened, &aim, 0, 0.5, 1e-12, "tilted plate", arena);
}

/* Telecentric to the last bit: the stop lies where the front part has its focus (a = 0). */
static void test_telecentric(struct arena *arena)
{
    struct opened opened;
    struct aim aim;
    struct error error;
    open_text("lens telecentric\nobject 80\naperture stop\nsurface 50 100 2 -\n"
              "stop - 20 2 6\nsurface - 10 air -\n",
              false, arena, &opened);
    CHECK(!isfinite(opened.first.entrance_pupil));
    for (double height = 0.01; height < 30; height *= 10) {
        struct beam beam = beam_at(&opened, 0, height);
        bool open = aim_open(&opened.system, &beam, arena, &aim, &error);
        CHECK(open);
        if (open) {
            struct ray ray = aim_chief(&aim);
            double slope = ray.cosine[1] / ray.cosine[2];
            /* parallel to the axis but for the aberration of the surface, of third order */
            CHECK(fabs(slope) <= 1e-4 * height * height * height + 1e-15);
            check_point(&opened, &aim, 0.3, -0.9, 1e-12, "telecentric", arena);
        }
    }
}

/* A virtual object: light converges towards a point behind the first vertex. */
static void test_virtual(struct arena *arena)
{
    struct opened opened;
    struct aim aim;
    struct error error;
    open_text("lens virtual\nobject inf\naperture stop\nsurface -80 3 1.6 -\nsurface 80 5 air -\n"
              "stop - 20 air 6\nsurface - 10 air -\n",
              false, arena, &opened);
    for (int i = -5; i <= 5; i++) {
        struct beam beam;
        CHECK(beam_from_point((double[3]){0, i, 60}, 1, &beam, &error));
        bool open = aim_open(&opened.system, &beam, arena, &aim, &error);
        CHECK(open && beam.distance < 0);
        if (open) {
            check_point(&opened, &aim, 0, 0, 1e-13, "virtual object, chief ray", arena);
            check_point(&opened, &aim, -0.7, 0.7, 1e-12, "virtual object", arena);
        }
    }
}

/* From the axis to beyond 90 degrees in steps of one: chief rays that move without a jump. */
static void test_wide_fields(struct arena *arena)
{
    static const struct {
        const char *name;
        int last;
    } lenses[] = {{"fisheye-270", 125}, {"minolta-fisheye-1", 95}, {"laikin114-wide170", 105}};
    char what[100];
    for (size_t k = 0; k < sizeof lenses / sizeof lenses[0]; k++) {
        struct opened opened;
        struct aim aim;
        struct error error;
        double before[2] = {0, 0};
        open_named(lenses[k].name, false, arena, &opened);
        for (int t = 0; t <= lenses[k].last; t++) {
            struct beam beam = beam_at(&opened, 0, t * degree);
            bool open = aim_open(&opened.system, &beam, arena, &aim, &error);
            snprintf(what, sizeof what, "%s at %d deg", lenses[k].name, t);
            if (!open) {
                printf("%s: %s\n", what, error.message);
            }
            CHECK(open);
            if (!open) {
                continue;
            }
            check_point(&opened, &aim, 0, 0, 1e-9 * aim.stop_radius, what, arena);
            double bend = aim.chief[1] - 2 * before[1] + before[0];
            if (t > 2 && !(fabs(bend) < 0.3)) {
                printf("%s: the chief ray jumps by %g mm\n", what, bend);
            }
            CHECK(t <= 2 || fabs(bend) < 0.3);
            before[0] = before[1];
            before[1] = aim.chief[1];
        }
    }
}

/* -------- clear pupils -------- */

static struct clear_pupil clear_of(const struct opened *opened, const struct beam *beam,
                                   size_t directions, struct arena *arena)
{
    struct clear_pupil pupil;
    struct clear_guess guess = clear_guess_of(&opened->system, beam, &opened->first);
    clear_find(&opened->system, beam, &guess, directions, arena, &pupil);
    return pupil;
}

static void test_discs(struct arena *arena)
{
    struct opened opened;
    open_text("lens stop\nobject inf\naperture stop\nsurface - 20 air -\n"
              "stop - 10 air 6 decenter=1,-2\nsurface - 10 air -\n",
              true, arena, &opened);
    for (int t = 0; t <= 60; t += 20) {
        struct beam beam = beam_at(&opened, 0, t * degree);
        for (size_t directions = 64; directions <= 1024; directions *= 4) {
            struct clear_pupil pupil = clear_of(&opened, &beam, directions, arena);
            CHECK(!pupil.is_empty);
            CHECK_RELATIVE(pupil.area, 9 * pi * cos(t * degree), t < 50 ? 1e-12 : 1e-9,
                           "decentred disc: area");
            CHECK_NEAR(pupil.high[0] - pupil.low[0], 6, 2e-6, "decentred disc: width");
            CHECK_NEAR(pupil.centre[0], beam.across[0][0], 0.01, "decentred disc: centre");
        }
    }
}

/* The area that two circles of radii r and s, d apart, have in common. */
static double lens_area(double r, double s, double d)
{
    double a = acos((d * d + r * r - s * s) / (2 * d * r));
    double b = acos((d * d + s * s - r * r) / (2 * d * s));
    return r * r * (a - sin(2 * a) / 2) + s * s * (b - sin(2 * b) / 2);
}

/* Two holes in air see each other aside: a cat's eye, with two corners. */
static void test_cats_eyes(struct arena *arena)
{
    struct opened opened;
    open_text("lens two\nobject inf\naperture stop\nsurface - 20 air 10\nstop - 10 air 8\n"
              "surface - 10 air -\n",
              true, arena, &opened);
    const double r = 5, s = 4;
    for (int t = 4; t <= 22; t += 3) {
        struct beam beam = beam_at(&opened, 0, t * degree);
        double d = 20 * tan(t * degree);
        double corner = (d * d + r * r - s * s) / (2 * d), half = sqrt(r * r - corner * corner);
        double width = corner < d ? half : s;
        for (size_t directions = 64; directions <= 512; directions *= 2) {
            struct clear_pupil pupil = clear_of(&opened, &beam, directions, arena);
            CHECK(pupil.arcs == 2);
            CHECK_RELATIVE(pupil.area, lens_area(r, s, d) * cos(t * degree), 1e-10,
                           "cat's eye: area");
            CHECK_NEAR(pupil.high[0], width, 1e-7 + (corner < d ? 0 : 2e-5), "cat's eye: width");
        }
    }
}

/* In air nothing bends the beam: its section with any plane across the axis is the same eye. */
static void test_sections(struct arena *arena)
{
    const char *text = "lens two\nobject inf\naperture stop\nsurface - 20 air 10\n"
                       "stop - 10 air 8\nsurface - 10 air -\n";
    struct opened clipped, open;
    struct pupil_shape shape;
    struct error error;
    open_text(text, true, arena, &clipped);
    open_text(text, false, arena, &open);
    for (int t = 4; t <= 22; t += 6) {
        struct beam beam = beam_at(&open, 0, t * degree);
        const struct pupil_question question = {&clipped.system, &open.system, &beam, &open.first,
                                                512};
        double d = 20 * tan(t * degree), area = lens_area(5, 4, d);
        CHECK(pupil_shape(&question, arena, &shape, &error));
        CHECK_RELATIVE(shape.entrance.vertex.area, area, 1e-10, "section: entrance, vertex");
        CHECK_RELATIVE(shape.entrance.pupil.area, area, 1e-10, "section: entrance, pupil");
        CHECK_RELATIVE(shape.exit.vertex.area, area, 1e-9, "section: exit, vertex");
        CHECK_RELATIVE(shape.exit.pupil.area, area, 1e-9, "section: exit, pupil");
        CHECK_NEAR(shape.exit.vertex.centre[0], 0, 1e-12, "section: centroid");
        CHECK_NEAR(shape.exit.pupil.centre[1] - shape.entrance.pupil.centre[1], 0, 1e-9,
                   "section: the pupils are one");
    }
}

/* The sliver that two holes leave when they all but turn away: found, and nothing behind it. */
static void test_slivers(struct arena *arena)
{
    struct opened opened;
    open_text("lens two\nobject inf\naperture stop\nsurface - 100 air 10\nstop - 10 air 8\n"
              "surface - 10 air -\n",
              true, arena, &opened);
    for (double part = 1e-2; part > 1e-9; part /= 10) {
        double d = 9 * (1 - part), t = atan(d / 100);
        struct beam beam = beam_at(&opened, 0, t);
        struct clear_pupil pupil = clear_of(&opened, &beam, 64, arena);
        CHECK(!pupil.is_empty);
        CHECK_RELATIVE(pupil.area, lens_area(5, 4, d) * cos(t), 1e-6 + 1e-15 / part / part,
                       "sliver: area");
        beam = beam_at(&opened, 0, atan(9 * (1 + part) / 100));
        pupil = clear_of(&opened, &beam, 64, arena);
        CHECK(pupil.is_empty);
    }
}

/* Against counting: the cells of a fine grid whose middle arrives. */
static void test_counted(const char *name, double field, struct arena *arena)
{
    enum { SIDE = 1024 };
    struct opened opened;
    size_t arrived = 0;
    char what[100];
    open_named(name, true, arena, &opened);
    struct beam beam = beam_at(&opened, 0, field * degree);
    struct clear_pupil pupil = clear_of(&opened, &beam, 1024, arena);
    CHECK(!pupil.is_empty);
    struct rays rays = rays_new(arena, SIDE);
    double size[2] = {1.1 * (pupil.high[0] - pupil.low[0]), 1.1 * (pupil.high[1] - pupil.low[1])};
    double middle[2] = {(pupil.high[0] + pupil.low[0]) / 2, (pupil.high[1] + pupil.low[1]) / 2};
    for (size_t i = 0; i < SIDE; i++) {
        for (size_t k = 0; k < SIDE; k++) {
            double a = middle[0] + size[0] * (((double)k + 0.5) / SIDE - 0.5);
            double b = middle[1] + size[1] * (((double)i + 0.5) / SIDE - 0.5);
            struct ray ray = beam_ray(&beam, a, b);
            rays_set(&rays, k, beam.n, &ray);
        }
        rays_trace(&opened.system, &rays, NULL);
        for (size_t k = 0; k < SIDE; k++) {
            arrived += rays_get(&rays, k, 1).status == RAY_OK ? 1 : 0;
        }
    }
    /* cells at the edge decide by chance: perimeter^(1/2) of them */
    double cell = size[0] * size[1] / ((double)SIDE * SIDE);
    snprintf(what, sizeof what, "%s at %g deg: area by counting", name, field);
    CHECK_NEAR(pupil.area, (double)arrived * cell, 4 * sqrt(4.0 * SIDE) * cell, what);
}

/*
 * A Tessar without clear apertures, whose rays end where they are reflected totally or miss: light
 * passes again beyond a gap, 1 % of it as a grid counts, which is none of the pupil.
 */
static void test_second_strip(struct arena *arena)
{
    struct opened opened;
    open_named("rudolph-tessar-100", true, arena, &opened);
    struct beam beam = beam_at(&opened, 0, 32.5 * degree);
    struct clear_pupil pupil = clear_of(&opened, &beam, 0, arena);
    CHECK_NEAR(pupil.islands.share, 3.11 / (330.48 + 3.11), 0.003, "the second strip");
    test_counted("rudolph-tessar-100", 32.5, arena);
}

/* Nothing arrives through two holes that do not face each other. */
static void test_empty(struct arena *arena)
{
    struct opened opened;
    open_text("lens two\nobject inf\naperture stop\nsurface - 50 air 4 decenter=0,9\n"
              "stop - 10 air 4\nsurface - 10 air -\n",
              true, arena, &opened);
    struct beam beam = beam_at(&opened, 0, 0);
    struct clear_pupil pupil = clear_of(&opened, &beam, 64, arena);
    CHECK(pupil.is_empty);
    beam = beam_at(&opened, 0, -atan(9.0 / 50));
    pupil = clear_of(&opened, &beam, 64, arena);
    CHECK(!pupil.is_empty);
    CHECK_RELATIVE(pupil.area, 4 * pi * cos(atan(9.0 / 50)), 1e-9, "two holes in line");
}

int main(void)
{
    struct arena arena = {0};
    test_places();
    test_sampler();
    test_fill(&arena);
    test_far_object();
    test_decentred_stop(&arena);
    test_tilted_stop(&arena);
    test_tilted_plate(&arena);
    test_telecentric(&arena);
    test_virtual(&arena);
    test_wide_fields(&arena);
    test_discs(&arena);
    test_cats_eyes(&arena);
    test_sections(&arena);
    test_slivers(&arena);
    test_counted("double-gauss", 14, &arena);
    test_counted("fisheye-16", 54, &arena);
    test_second_strip(&arena);
    test_empty(&arena);
    arena_free(&arena);
    return check_report();
}
