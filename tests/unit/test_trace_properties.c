/* tests/unit/test_trace_properties.c - what every exact ray obeys, on real and random lenses. */
/* SPDX-License-Identifier: MIT */
#include "check.h"
#include "exchange/lens_open.h"
#include "trace/aim/beam.h"
#include "trace/dispatch.h"
#include "trace_one.h"

#include <stdint.h>

/* Numbers that look random, the same on every machine. */
static uint64_t state = 12345;

static double random_between(double low, double high)
{
    state = state * 6364136223846793005u + 1442695040888963407u;
    return low + (high - low) * (double)(state >> 11) / 9007199254740992.0;
}

static bool compile(const struct lens *lens, bool reverse, struct arena *arena,
                    struct system *system)
{
    struct error error;
    struct system_options options = system_options_default();
    options.path = true;
    options.reverse = reverse;
    bool good =
        system_compile(lens, lens_primary_wavelength(lens), &options, arena, system, &error);
    if (!good) {
        printf("%s\n", error.message);
    }
    CHECK(good);
    return good;
}

static struct ray ray_at(double x, double y, double u, double v)
{
    double length = sqrt(1 + u * u + v * v);
    return (struct ray){.point = {x, y, 0}, .cosine = {u / length, v / length, 1 / length}};
}

static double first_radius(const struct lens *lens)
{
    const struct surface *surface = &lens->surfaces[0];
    return surface->has_diameter ? surface->diameter.value.hi / 2 : 5;
}

static double length_of(const struct lens *lens)
{
    double length = 1;
    for (size_t i = 0; i < lens->surface_count; i++) {
        length += fabs(lens->surfaces[i].thickness.value.hi);
    }
    return length;
}

/* There and back: the same line, the same path. */
static void check_reversal(const struct system *there, const struct system *back,
                           const struct ray *start, const char *name)
{
    struct ray end = trace_one(there, start);
    if (end.status != RAY_OK) {
        return;
    }
    struct ray turned = {.point = {end.point[0], end.point[1], end.point[2]}};
    for (int i = 0; i < 3; i++) {
        turned.cosine[i] = -end.cosine[i];
    }
    struct ray home = trace_one(back, &turned);
    CHECK(home.status == RAY_OK);
    /* the ray ends on the first surface; go on to where it started */
    double way = (start->point[2] - home.point[2]) / home.cosine[2];
    double scale = length_of(there->lens) + fabs(end.point[0]) + fabs(end.point[1]);
    for (int i = 0; i < 3; i++) {
        CHECK_NEAR(home.point[i] + way * home.cosine[i], start->point[i], 1e-12 * scale, name);
        CHECK_NEAR(home.cosine[i], -start->cosine[i], 1e-12, name);
    }
    CHECK_NEAR(home.path + way * there->index_first, end.path, 1e-12 * scale, name);
}

/* n (x M - y L) is the same before and behind a lens with an axis. */
static void check_skew(const struct system *system, const struct ray *start, const char *name)
{
    struct ray end = trace_one(system, start);
    if (end.status == RAY_OK) {
        double before = start->point[0] * start->cosine[1] - start->point[1] * start->cosine[0];
        double behind = end.point[0] * end.cosine[1] - end.point[1] * end.cosine[0];
        double scale =
            fabs(end.point[0]) + fabs(end.point[1]) + fabs(start->point[0]) + fabs(start->point[1]);
        CHECK_NEAR(system->index_last * behind, system->index_first * before, 1e-13 * (1 + scale),
                   name);
    }
}

/* The state (x, y, n L, n M) on the vertex plane behind the lens. */
static bool phase(const struct system *system, const double in[4], double out[4])
{
    double n = system->index_first, p = in[2] / n, q = in[3] / n;
    const struct ray start = {.point = {in[0], in[1], 0},
                              .cosine = {p, q, sqrt(1 - p * p - q * q)}};
    struct ray end = trace_one(system, &start);
    double way = -end.point[2] / end.cosine[2];
    out[0] = end.point[0] + way * end.cosine[0];
    out[1] = end.point[1] + way * end.cosine[1];
    out[2] = system->index_last * end.cosine[0];
    out[3] = system->index_last * end.cosine[1];
    return end.status == RAY_OK;
}

static double determinant(double m[4][4])
{
    double result = 1;
    for (int i = 0; i < 4; i++) {
        int pivot = i;
        for (int j = i + 1; j < 4; j++) {
            pivot = fabs(m[j][i]) > fabs(m[pivot][i]) ? j : pivot;
        }
        for (int k = 0; k < 4; k++) {
            double kept = m[i][k];
            m[i][k] = m[pivot][k];
            m[pivot][k] = kept;
        }
        result *= (pivot == i ? 1 : -1) * m[i][i];
        for (int j = i + 1; j < 4; j++) {
            double factor = m[j][i] / m[i][i];
            for (int k = 0; k < 4; k++) {
                m[j][k] -= factor * m[i][k];
            }
        }
    }
    return result;
}

/* Etendue: the map of (x, y, n L, n M) keeps volume. Differences of fourth order. */
static void check_etendue(const struct system *system, double radius, const char *name)
{
    const double center[4] = {0.2 * radius, -0.1 * radius, 0.02, 0.03};
    double m[4][4];
    for (int j = 0; j < 4; j++) {
        double at[4][4], step = j < 2 ? 2e-4 * radius : 1e-4;
        const int steps[4] = {-2, -1, 1, 2};
        for (int k = 0; k < 4; k++) {
            double in[4] = {center[0], center[1], center[2], center[3]};
            in[j] += steps[k] * step;
            if (!phase(system, in, at[k])) {
                return;
            }
        }
        for (int i = 0; i < 4; i++) {
            m[i][j] = (at[0][i] - at[3][i] + 8 * (at[2][i] - at[1][i])) / (12 * step);
        }
    }
    CHECK_NEAR(fabs(determinant(m)), 1, 2e-6, name);
}

/* Exact minus its linear part falls with the third power of the opening. */
static void check_order(const struct system *system, double radius, const char *name)
{
    double out[3][4], error[2];
    const double scales[3] = {1e-5, 0.01, 0.02};
    for (int k = 0; k < 3; k++) {
        double h = scales[k];
        const double in[4] = {0.3 * radius * h, radius * h, 0.1 * h, -0.2 * h};
        if (!phase(system, in, out[k])) {
            return;
        }
        for (int i = 0; i < 4; i++) {
            out[k][i] /= h;
        }
    }
    for (int k = 0; k < 2; k++) {
        error[k] = 0;
        for (int i = 0; i < 4; i++) {
            error[k] += fabs(out[k + 1][i] - out[0][i]);
        }
    }
    /* divided by h the error is of second order: 4 times for twice the opening */
    if (error[0] > 1e-7) {
        CHECK_NEAR(log2(error[1] / error[0]), 2, 0.2, name);
    }
}

/* The ray from an object point through a point of the first vertex plane. */
static struct ray ray_through(const double object[3], const double target[2], double n)
{
    const double point[3] = {target[0], target[1], 0};
    struct beam beam;
    struct error error;
    double at[2];
    CHECK(beam_from_point(object, n, &beam, &error));
    beam_place(&beam, point, at);
    return beam_ray(&beam, at[0], at[1]);
}

/*
 * Malus and Dupin: rays from one point stay normal to a surface of equal path. Then the path to the
 * plane behind changes from ray to ray as d path = n (L dx + M dy).
 */
static void check_normals(const struct system *system, double radius, const char *name)
{
    enum { STEPS = 2 };
    double path[2 * STEPS + 1], x[2 * STEPS + 1], y[2 * STEPS + 1];
    const double object[3] = {0.1 * radius, -0.3 * radius, -10 * radius}, h = 2e-3 * radius;
    struct ray middle = {.surface = 0};
    for (int k = -STEPS; k <= STEPS; k++) {
        const double target[2] = {0.1 * radius + k * h, 0.2 * radius + 0.5 * k * h};
        struct ray start = ray_through(object, target, system->index_first);
        struct ray end = trace_one(system, &start);
        if (end.status != RAY_OK) {
            return;
        }
        double way = -end.point[2] / end.cosine[2];
        int i = k + STEPS;
        path[i] = end.path + way * system->index_last;
        x[i] = end.point[0] + way * end.cosine[0];
        y[i] = end.point[1] + way * end.cosine[1];
        middle = k == 0 ? end : middle;
    }
    double derivative[3];
    const double *values[3] = {path, x, y};
    for (int j = 0; j < 3; j++) {
        const double *v = values[j];
        derivative[j] = (v[0] - v[4] + 8 * (v[3] - v[1])) / 12;
    }
    double along = middle.cosine[0] * derivative[1] + middle.cosine[1] * derivative[2];
    double scale = fabs(derivative[1]) + fabs(derivative[2]) + 1e-3 * h;
    CHECK_NEAR(derivative[0], system->index_last * along, 1e-5 * scale, name);
}

static void check_lens(const struct lens *lens, const char *name, bool has_axis)
{
    struct arena arena = {0};
    struct system there, back;
    if (compile(lens, false, &arena, &there) && compile(lens, true, &arena, &back)) {
        double radius = 0.5 * first_radius(lens);
        for (int i = 0; i < 20; i++) {
            struct ray start =
                ray_at(random_between(-radius, radius), random_between(-radius, radius),
                       random_between(-0.1, 0.1), random_between(-0.1, 0.1));
            check_reversal(&there, &back, &start, name);
            if (has_axis) {
                check_skew(&there, &start, name);
            }
        }
        check_etendue(&there, radius, name);
        check_normals(&there, radius, name);
        if (has_axis) {
            check_order(&there, 0.5 * radius, name);
        }
    }
    arena_free(&arena);
}

static bool has_axis(const struct lens *lens)
{
    for (size_t i = 0; i < lens->surface_count; i++) {
        const struct surface *surface = &lens->surfaces[i];
        if (surface->curved != CURVED_BOTH || surface->decentre != NULL ||
            surface->coordinate_break != NULL) {
            return false;
        }
    }
    return true;
}

static void check_lensdb(void)
{
    struct arena all = {0};
    struct lensdb db = {.arena = &all};
    const char *const *names = NULL;
    struct error error;
    CHECK(lens_open_names(&db, LENSDB_EMBEDDED, &all, &names, &error));
    for (size_t i = 0; names != NULL && names[i] != NULL; i++) {
        struct lens *lens = ARENA_NEW(&all, struct lens);
        CHECK(lens_open(&db, text_of(names[i]), &all, lens, &error));
        check_lens(lens_at_position(lens, 0, &all), names[i], has_axis(lens));
    }
    arena_free(&all);
}

/* Lenses of random surfaces: conics, aspheres, cylinders, tilts. Scaled by 2 they give twice. */
static void check_random(void)
{
    for (int trial = 0; trial < 200; trial++) {
        struct arena arena = {0};
        char text[2][2048];
        size_t used[2] = {0, 0};
        int count = 2 + trial % 5, kind = trial % 4;
        for (int i = 0; i < count; i++) {
            double R = random_between(20, 200) * (random_between(-1, 1) < 0 ? -1 : 1);
            double t = random_between(1, 8), k = kind > 0 ? random_between(-2, 1) : 0;
            double n = i % 2 == 0 ? random_between(1.4, 1.9) : 1, A4 = random_between(-1e-6, 1e-6);
            double tilt = kind == 3 ? random_between(-5, 5) : 0;
            for (int scale = 1; scale <= 2; scale++) {
                char *to = text[scale - 1] + used[scale - 1];
                size_t room = sizeof text[0] - used[scale - 1];
                int length = snprintf(to, room,
                                      "surface %.17g %.17g %.17g - k=%.17g A4=%.17g%s"
                                      " tilt=%.17g,%.17g\n",
                                      R * scale, t * scale, n, k, kind < 2 ? 0 : A4 / pow(scale, 3),
                                      kind == 3 && i == 1 ? " cyl=x" : "", tilt, -tilt / 2);
                used[scale - 1] += (size_t)length;
            }
        }
        struct lens lens[2];
        struct error error;
        struct system system[2];
        bool good = true;
        for (int i = 0; i < 2; i++) {
            good = good && lens_read("random", text_of(text[i]), NULL, &arena, &lens[i], &error) &&
                   compile(&lens[i], false, &arena, &system[i]);
        }
        CHECK(good);
        if (good) {
            check_lens(&lens[0], "random lens", kind < 3);
            struct ray start = ray_at(1, 2, 0.05, -0.03), twice = ray_at(2, 4, 0.05, -0.03);
            struct ray one = trace_one(&system[0], &start), two = trace_one(&system[1], &twice);
            CHECK(one.status == two.status);
            for (int i = 0; i < 3 && one.status == RAY_OK; i++) {
                CHECK_NEAR(two.point[i], 2 * one.point[i], 1e-12, text[0]);
                CHECK_NEAR(two.cosine[i], one.cosine[i], 1e-13, text[0]);
            }
        }
        arena_free(&arena);
    }
}

int main(void)
{
    check_lensdb();
    check_random();
    return check_report();
}
