/* tests/unit/test_follow.c - a ray at every surface: Snell's law, straight lines, cylinders. */
/* SPDX-License-Identifier: MIT */
#include "check.h"
#include "file/lens_file.h"
#include "trace/follow.h"

enum { SURFACES = 4 };

/* Thickness and index behind, curvature in x and in y. */
struct face {
    double t, n, cx, cy;
};

static const struct face faces[SURFACES] = {
    {4, 1.5, 0.02, 0}, {30, 1, -0.0125, -0.0125}, {5, 1.6, 0, 0.025}, {9, 1.33, -0.02, -0.02}};
static const char *const text = "object inf\nsurface 50 4 1.5 - cyl=x\nsurface -80 30 air -\n"
                                "surface 40 5 1.6 - cyl=y\nsurface -50 9 1.33 -\n";
/* of f = 40 with H' 3 behind H: between the lens and the image */
static const char *const ideal = "object inf\nthick 40 20 air - hiatus=3\nsurface - 5 air -\n";

static void open_text(const char *from, double image, struct arena *arena, struct lens *lens,
                      struct system *system)
{
    struct error error;
    struct system_options options = system_options_default();
    options.image = image;
    CHECK(lens_read("t.lens", text_of(from), NULL, arena, lens, &error));
    CHECK(system_compile(lens, 0.55, &options, arena, system, &error));
}

static struct ray start_at(double x, double y, double z, double ux, double uy)
{
    double length = sqrt(1 + ux * ux + uy * uy);
    return (struct ray){.point = {x, y, z}, .cosine = {ux / length, uy / length, 1 / length}};
}

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Heights and slopes of each section by itself: n' u' = n u - (n' - n) c h, h' = h + t u'. */
static void test_paraxial(void)
{
    struct arena arena = {0};
    struct lens lens;
    struct system system;
    struct error error;
    struct paraxial_intersection found[SURFACES];
    const struct ray start = start_at(1.5, -2.25, 0.75, 0.05, 0.125);
    open_text(text, NAN, &arena, &lens, &system);
    CHECK(ray_follow_paraxially(&lens, 0.55, &start, &arena, found, &error));
    double x = 1.5 - 0.75 * 0.05, u = 0.05, y = -2.25 - 0.75 * 0.125, v = 0.125, n = 1;
    for (size_t i = 0; i < SURFACES; i++) {
        const struct face *face = &faces[i];
        u = (n * u - (face->n - n) * face->cx * x) / face->n;
        v = (n * v - (face->n - n) * face->cy * y) / face->n;
        n = face->n;
        CHECK_NEAR(found[i].x, x, 1e-14, "x");
        CHECK_NEAR(found[i].y, y, 1e-14, "y");
        CHECK_NEAR(found[i].slope_x, u, 1e-15, "slope of x");
        CHECK_NEAR(found[i].slope_y, v, 1e-15, "slope of y");
        x += face->t * u;
        y += face->t * v;
    }
    /* one that runs the other way, or across */
    struct ray back = start;
    back.cosine[2] = -back.cosine[2];
    CHECK(ray_follow_paraxially(&lens, 0.55, &back, &arena, found, &error));
    CHECK(isnan(found[0].x) && isnan(found[3].slope_y));
    back.cosine[2] = 0;
    CHECK(ray_follow_paraxially(&lens, 0.55, &back, &arena, found, &error));
    CHECK(isnan(found[0].x) && isnan(found[3].slope_y));
    arena_free(&arena);
}

/* On the surface, along the line before, bent in the plane of the normal by Snell's law. */
static void test_exact(void)
{
    struct arena arena = {0};
    struct lens lens;
    struct system system;
    struct ray_intersection found[SURFACES + 1];
    const struct ray start = start_at(1.5, -2.25, -0.75, 0.05, 0.125);
    open_text(text, 9.5, &arena, &lens, &system);
    CHECK(system.places == SURFACES + 1);
    ray_follow(&system, &start, &arena, found);
    double from[3] = {1.5, -2.25, -0.75}, n = 1;
    const double *along = start.cosine;
    for (size_t i = 0; i <= SURFACES; i++) {
        const struct ray *ray = &found[i].ray;
        const double *p = ray->point;
        const double way[3] = {p[0] - from[0], p[1] - from[1], p[2] - from[2]};
        double d = dot(way, along), N[3] = {0, 0, 1}, next = n;
        CHECK(ray->status == RAY_OK);
        CHECK_NEAR(dot(way, way), d * d, 1e-12 * d * d, "straight");
        if (i < SURFACES) {
            double cx = faces[i].cx, cy = faces[i].cy, c = cx != 0 ? cx : cy;
            double u = (cx != 0) * p[0] * p[0] + (cy != 0) * p[1] * p[1];
            CHECK_NEAR(c * (u + p[2] * p[2]), 2 * p[2], 1e-14, "on the sphere or cylinder");
            N[0] = -cx * p[0];
            N[1] = -cy * p[1];
            N[2] = 1 - c * p[2];
            next = faces[i].n;
            CHECK_NEAR(dot(N, N), 1, 1e-14, "normal");
        } else {
            CHECK_NEAR(p[2], 0, 1e-14, "in the image plane");
        }
        const double *after = ray->cosine;
        double in = dot(N, along), out = dot(N, after);
        CHECK_NEAR(dot(after, after), 1, 1e-14, "a direction");
        for (int k = 0; k < 3; k++) {
            CHECK_NEAR(next * (after[k] - out * N[k]), n * (along[k] - in * N[k]), 1e-14, "Snell");
        }
        CHECK(out > 0);
        CHECK_NEAR(cos(found[i].angles.incidence), in, 1e-14, "incidence");
        CHECK_NEAR(cos(found[i].angles.refraction), out, 1e-14, "refraction");
        for (int k = 0; k < 3; k++) {
            from[k] = p[k] - (k == 2 && i < SURFACES ? i + 1 < SURFACES ? faces[i].t : 9.5 : 0);
        }
        along = after;
        n = next;
    }
    arena_free(&arena);
}

/* With a turned axis angles stay those between rays: a mirror at 30 degrees, the axis at 60. */
static void test_turned(void)
{
    struct arena arena = {0};
    struct lens lens;
    struct system system;
    struct ray_intersection found[4];
    const struct ray start = start_at(0, 1, -5, 0, 0);
    open_text("object inf\nbend tilt=30,0,0\nsurface - 0 mirror -\nbend tilt=30,0,0\n"
              "surface - -40 1.5 -\nsurface - -5 air - tilt=10,0\n",
              NAN, &arena, &lens, &system);
    ray_follow(&system, &start, &arena, found);
    const double degree = 3.141592653589793 / 180;
    CHECK_NEAR(found[0].angles.incidence, 30 * degree, 1e-14, "at the mirror");
    CHECK_NEAR(found[0].angles.refraction, 30 * degree, 1e-14, "and from it");
    CHECK_NEAR(found[1].angles.incidence, 0, 1e-12, "along the new axis");
    CHECK_NEAR(found[2].angles.incidence, 10 * degree, 1e-12, "a tilted face");
    CHECK_NEAR(sin(found[2].angles.refraction), 1.5 * sin(10 * degree), 1e-12, "out of the glass");
    arena_free(&arena);
}

/* From a loss on all is NaN, and says where it was. */
static void test_lost(void)
{
    struct arena arena = {0};
    struct lens lens;
    struct system system;
    struct ray_intersection found[3];
    const struct ray start = start_at(0, 5, 0, 0, 0);
    open_text("object inf\nsurface - 5 1.5 -\nsurface 4 5 air -\nsurface - 5 air -\n", NAN, &arena,
              &lens, &system);
    ray_follow(&system, &start, &arena, found);
    CHECK(found[0].ray.status == RAY_OK && found[0].ray.point[1] == 5);
    for (size_t i = 1; i < 3; i++) {
        CHECK(found[i].ray.status == RAY_MISS && found[i].ray.surface == 2);
        CHECK(isnan(found[i].ray.point[0]) && isnan(found[i].ray.cosine[2]));
        CHECK(isnan(found[i].angles.incidence) && isnan(found[i].angles.refraction));
        CHECK(isnan(found[i].ray.path));
    }
    open_text(ideal, NAN, &arena, &lens, &system);
    ray_follow(&system, &start, &arena, found);
    CHECK_NEAR(found[0].ray.point[2], 3, 1e-15, "leaves H'");
    CHECK_NEAR(found[1].ray.point[1], 2.5, 1e-14, "halfway to the focus");
    arena_free(&arena);
}

int main(void)
{
    test_paraxial();
    test_exact();
    test_turned();
    test_lost();
    return check_report();
}
