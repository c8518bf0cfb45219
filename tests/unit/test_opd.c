/* tests/unit/test_opd.c - optical path differences against a program of 50 digits. */
/* SPDX-License-Identifier: MIT */
#include "analysis/setup/setup.h"
#include "analysis/waves/opd.h"
#include "base/constants.h"
#include "check.h"
#include "file/lens_file.h"
#include "trace/aim/aim.h"
#include "trace/dispatch.h"

#include <stdlib.h>

/*
 * tests/truth/opd.txt: systems in the notation of a .lens file, the place of the image plane, then
 *     fan   field, point of the stop / radius = W, dx, dy
 */
struct reading {
    char line[8192], name[256];
    struct arena arena;
    struct setup setup;
    const struct system *open, *whole;
    double length; /* of the way through the lens, mm: what rounding is counted in */
    double field;  /* of the aim */
    struct aim aim;
    struct ray chief;
    struct opd_reference reference;
};

static bool say(const struct reading *reading, bool good, const struct error *error)
{
    if (!good) {
        printf("%s: %s\n", reading->name, error->message);
    }
    CHECK(good);
    return good;
}

static bool read_lens(struct reading *reading, FILE *file)
{
    static char text[65536];
    size_t length = 0;
    snprintf(reading->name, sizeof reading->name, "%.200s", reading->line + 5);
    reading->name[strcspn(reading->name, "\n")] = '\0';
    while (fgets(reading->line, sizeof reading->line, file) != NULL &&
           strcmp(reading->line, "end\n") != 0) {
        length += (size_t)snprintf(text + length, sizeof text - length, "%s", reading->line);
    }
    struct error error;
    struct lens *lens = ARENA_NEW(&reading->arena, struct lens);
    struct setup_question question = {.lens = lens, .wavelength = NAN, .fnumber = NAN};
    bool good = lens_read("truth", text_of(text), NULL, &reading->arena, lens, &error) &&
                setup_open(&question, &reading->arena, &reading->setup, &error);
    reading->length = 1;
    for (size_t i = 0; good && i < lens->surface_count; i++) {
        reading->length += fabs(lens->surfaces[i].thickness.value.hi);
    }
    reading->field = NAN;
    return say(reading, good, &error);
}

static void place_image(struct reading *reading, double distance)
{
    struct error error;
    const struct plane_value at = {PLANE_AT, distance};
    bool good = setup_place_image(&reading->setup, &at, &error);
    reading->length += fabs(distance);
    reading->open = good ? setup_system(&reading->setup, 0, SETUP_OPEN, &error) : NULL;
    reading->whole = reading->open != NULL
                         ? setup_system(&reading->setup, 0, SETUP_IMAGE | SETUP_PATH, &error)
                         : NULL;
    say(reading, reading->whole != NULL, &error);
}

static struct ray trace_to(const struct system *system, struct ray start, struct arena *arena)
{
    struct rays rays = rays_new(arena, 1);
    rays_set(&rays, 0, system->index_first, &start);
    rays_trace(system, &rays, NULL);
    return rays_get(&rays, 0, system->index_last);
}

static bool open_field(struct reading *reading, double field)
{
    struct error error;
    struct setup *setup = &reading->setup;
    bool far = setup->object.is_infinite;
    const struct field_point point = {far ? FIELD_ANGLE : FIELD_HEIGHT,
                                      {0, far ? field * RADIANS_PER_DEGREE : field}};
    struct beam beam;
    bool good = setup_beam(setup, &point, &beam, &error) &&
                aim_open(reading->open, &beam, &reading->arena, &reading->aim, &error);
    if (good) {
        reading->field = field;
        reading->chief = trace_to(reading->whole, aim_chief(&reading->aim), &reading->arena);
        good = opd_sphere(&reading->chief, setup->first.exit_pupil - setup->image,
                          reading->whole->index_last, NULL, &reading->reference, &error);
    }
    return say(reading, good, &error);
}

static void check_fan(struct reading *reading, const double *n)
{
    static const char names[][3] = {"W", "dx", "dy"};
    if (n[0] != reading->field && !open_field(reading, n[0])) {
        return;
    }
    char what[400];
    struct ray ray = aim_ray(&reading->aim, n[1], n[2]);
    ray = trace_to(reading->whole, ray, &reading->arena);
    double path =
        opd_path(&reading->reference, &reading->chief) - opd_path(&reading->reference, &ray);
    /* rounding of each surface's way, and of the place of the ray in the stop */
    double ulp = 1.1102230246251565e-16 * reading->length, allowed = 1e-13 + 16 * ulp;
    const double found[] = {path, ray.point[0] - reading->chief.point[0],
                            ray.point[1] - reading->chief.point[1]};
    CHECK(ray.status == RAY_OK);
    check_source("opd", "mm");
    for (int i = 0; i < 3; i++) {
        snprintf(what, sizeof what, "%s, field %g, stop at (%g, %g): %s", reading->name, n[0], n[1],
                 n[2], names[i]);
        CHECK_NEAR(found[i], n[3 + i], i == 0 ? 1e-13 + 2 * ulp : allowed, what);
    }
    check_source(NULL, "");
}

static void read_line(struct reading *reading)
{
    double n[12];
    size_t count = 0;
    char word[128];
    int used = 0, past = (int)strcspn(reading->line, " ");
    for (const char *at = reading->line + past;
         count < 12 && sscanf(at, "%127s%n", word, &used) == 1; at += used) {
        if (strcmp(word, "=") != 0) {
            n[count++] = strtod(word, NULL);
        }
    }
    if (strncmp(reading->line, "focus", 5) == 0) {
        CHECK(count == 1);
        place_image(reading, n[0]);
    } else if (reading->whole != NULL) {
        CHECK(count == 6);
        check_fan(reading, n);
    }
}

static void test_truth(void)
{
    struct reading reading = {0};
    FILE *file = fopen("tests/truth/opd.txt", "r");
    CHECK(file != NULL);
    while (file != NULL && fgets(reading.line, sizeof reading.line, file) != NULL) {
        if (strncmp(reading.line, "case ", 5) == 0) {
            reading.whole = NULL;
            read_lens(&reading, file);
        } else if (reading.line[0] != '#') {
            read_line(&reading);
        }
    }
    if (file != NULL) {
        fclose(file);
    }
    arena_free(&reading.arena);
}

/* A ray from a point of the wave front of a point image, to the plane z = 0, of n = 1.5. */
static struct ray to_image(const double front[3], const double image[3], double path)
{
    double way = 0;
    struct ray ray = {.path = path};
    for (int i = 0; i < 3; i++) {
        ray.cosine[i] = image[i] - front[i];
        way += ray.cosine[i] * ray.cosine[i];
    }
    way = sqrt(way);
    double on = -front[2] / (image[2] - front[2]);
    for (int i = 0; i < 3; i++) {
        ray.cosine[i] /= way;
        ray.point[i] = front[i] + on * (image[i] - front[i]);
    }
    ray.path += 1.5 * on * way;
    return ray;
}

/*
 * A perfect wave to a point 1 mm behind the plane: at the angle t of the sphere R = 100 it is
 * n (d - 101) late, d from there to the point by the law of cosines.
 */
static void test_defocus(void)
{
    static const double centre[3] = {0, 0, -100}, image[3] = {0, 0, 1};
    struct ray chief = to_image(centre, image, 0);
    struct opd_reference reference;
    struct error error;
    CHECK(opd_sphere(&chief, -100, 1.5, NULL, &reference, &error));
    CHECK_NEAR(reference.radius, 100, 1e-13, "radius");
    for (int i = 1; i < 5; i++) {
        double t = 0.1 * i;
        const double front[3] = {0, 100 * sin(t), -100 * cos(t)};
        double d = sqrt(100 * 100 + 1 + 2 * 100 * cos(t));
        struct ray ray = to_image(front, image, 1.5 * (101 - d));
        double W = opd_path(&reference, &chief) - opd_path(&reference, &ray);
        CHECK_NEAR(W, 1.5 * (d - 101), 1e-13, "W of a defocus");
        CHECK(W < 0);
    }
}

/* The image at the pupil's other side, a pupil at infinity, a plane, and what is refused. */
static void test_kinds(void)
{
    static const double centre[3] = {0, 0, 50}, image[3] = {0, 0, 0}, axis[3] = {0, 0, -100};
    struct opd_reference behind, far, plane;
    struct error error;
    struct ray chief = to_image(axis, image, 0);
    CHECK(opd_sphere(&chief, centre[2], 1.5, NULL, &behind, &error));
    CHECK(behind.side < 0);
    CHECK_NEAR(behind.radius, 50, 1e-13, "radius");
    CHECK(opd_sphere(&chief, INFINITY, 1.5, NULL, &far, &error) && isinf(far.radius));
    CHECK(opd_sphere(&chief, NAN, 1.5, NULL, &far, &error) && isinf(far.radius));
    CHECK(opd_plane(&chief, 50, 1.5, &plane, &error) && plane.is_plane);
    /* a ray that misses the point by 0.01 along y, 0.3 rad steep, on its way for nothing */
    struct ray ray = {.point = {0, 0.01, 0}, .cosine = {0, -sin(0.3), cos(0.3)}, .path = 0};
    double foot = -1.5 * 0.01 * sin(0.3), q = pow(0.01 * cos(0.3), 2);
    CHECK_NEAR(-opd_path(&far, &ray), foot, 1e-15, "from the foot of the perpendicular");
    CHECK_NEAR(-opd_path(&behind, &ray), foot + 1.5 * (50 - sqrt(2500 - q)), 2e-14,
               "to a sphere behind the image");
    CHECK_NEAR(opd_path(&plane, &ray), 1.5 * 50 * (1 / cos(0.3) - 1), 1e-13, "to a plane");
    ray.point[1] = 60;
    CHECK(isnan(opd_path(&behind, &ray)));
    ray.status = RAY_MISS;
    CHECK(isnan(opd_path(&plane, &ray)));
    CHECK(!opd_sphere(&chief, 0, 1.5, NULL, &behind, &error) && error.code == ERROR_DOMAIN);
    CHECK(!opd_sphere(&ray, 50, 1.5, NULL, &behind, &error) && error.code == ERROR_DOMAIN);
    CHECK(!opd_plane(&ray, 50, 1.5, &plane, &error) && error.code == ERROR_DOMAIN);
}

/* Moving the centre by a small dy tilts: W changes by -n dy times the difference of the slopes. */
static void test_centre(void)
{
    static const double axis[3] = {0, 0, -100}, image[3] = {0, 0, 0};
    const double front[3] = {0, 100 * sin(0.3), -100 * cos(0.3)}, moved[3] = {0, 1e-3, 0};
    struct ray chief = to_image(axis, image, 0), ray = to_image(front, image, 0);
    struct opd_reference reference;
    struct error error;
    CHECK(opd_sphere(&chief, -100, 1.5, moved, &reference, &error));
    double W = opd_path(&reference, &chief) - opd_path(&reference, &ray);
    /* exactly: both rays to the sphere of radius R about the moved centre */
    double R = hypot(100, 1e-3), b = 1e-3 * sin(0.3), q = pow(1e-3 * cos(0.3), 2);
    double t_chief = -sqrt(R * R - 1e-6), t_ray = -b - sqrt(R * R - q);
    CHECK_NEAR(W, 1.5 * (t_chief - t_ray), 1e-13, "W about a moved centre");
    CHECK_NEAR(W, 1.5 * b, 1e-8, "a tilt");
}

/* Differences of the path about moved spheres through the same crossing of the pupil. */
static void test_slopes(void)
{
    static const double pupils[] = {-40, 55, INFINITY};
    const struct ray chief = {.point = {0.1, 3, 0}, .cosine = {0, 0.28, 0.96}, .path = 70};
    const struct ray ray = {
        .point = {0.3, 2.6, 0}, .cosine = {0.12, 0.48, sqrt(0.7552)}, .path = 71};
    const double centre[3] = {0.2, 3.1, -0.3}, step = 1e-4;
    for (size_t i = 0; i < sizeof pupils / sizeof pupils[0]; i++) {
        struct opd_reference reference, moved;
        struct error error;
        double slope[3];
        CHECK(opd_sphere(&chief, pupils[i], 1.5, centre, &reference, &error));
        opd_path_by_centre(&reference, &ray, slope);
        for (int k = 0; k < 3; k++) {
            double paths[2];
            for (int side = 0; side < 2; side++) {
                double there[3] = {centre[0], centre[1], centre[2]};
                there[k] += side == 0 ? -step : step;
                CHECK(opd_sphere(&chief, pupils[i], 1.5, there, &moved, &error));
                paths[side] = opd_path(&moved, &ray);
            }
            CHECK_NEAR(slope[k], (paths[1] - paths[0]) / (2 * step), 1e-9, "slope of a path");
        }
    }
}

int main(void)
{
    test_slopes();
    test_truth();
    test_defocus();
    test_kinds();
    test_centre();
    return check_report();
}
