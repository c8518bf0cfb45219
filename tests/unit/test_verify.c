/* tests/unit/test_verify.c - the kernels against the other trace, over every kind of surface. */
/* SPDX-License-Identifier: MIT */
#include "base/constants.h"
#include "check.h"
#include "file/lens_file.h"
#include "trace/verify.h"
#include "trace_one.h"

/* Two traces that share no code must agree to what the kernels' 53 bits can. */
static const struct {
    const char *text;
    double image;
} cases[] = {
    {"surface 50 6 1.5 -\nsurface -40 60 air -\n", 60},
    {"surface 50 6 1.5 -\nsurface -40 60 air -\n", NAN},
    {"surface 50 6 1.5 - k=-0.7 A2=1e-3 A4=2e-5 A6=-3e-7\nsurface -40 60 air - k=2\n", 20},
    {"surface 50 6 1.5 - k=0.5 A1=0.01 A3=-4e-4 A4=2e-5 A5=1e-6\nsurface -40 60 air -\n", 20},
    {"surface 50 6 1.5 - cyl=x\nsurface -40 60 air - cyl=y\n", 60},
    {"surface 50 6 1.5 - cyl=y A4=2e-5\nsurface - 60 air -\n", 60},
    {"surface 50 6 1.5 - decenter=1,-2 tilt=5,-8\nsurface -40 60 air - tilt=-3,11\n", 60},
    {"surface 50 6 1.5 -\nbend decenter=0.5,1.25 tilt=10,-20,30\nsurface -40 60 air -\n", 60},
    {"surface 50 6 1.5 -\nbend tilt=45,0,0\nsurface - 0 mirror -\nbend tilt=45,0,0\n"
     "surface - -40 air -\nsurface -40 -6 1.62 -\nsurface 80 -30 air -\n",
     -30},
    {"surface -200 -70 mirror - k=-1\nsurface -90 90 mirror - k=-3\n", 90},
    {"surface 50 6 1.5 -\nbend decenter=1,2 tilt=3,-4,120\nsurface 90 -5 mirror - tilt=2,3 "
     "decenter=0.5,0.25\nsurface 60 -40 air - k=-0.5 A4=1e-6\n",
     -40},
    {"object inf\nthick 50 40 1.2 - hiatus=3 distortion=0.1,-0.2,0.3\nsurface 90 9 air -\n", 9},
    {"object 120\nthick 50 40 1.2 - hiatus=-3 distortion=0.1,-0.2,0.3\nsurface 90 9 air -\n", 9},
    {"object 120\nsurface 70 8 1.5 -\nsurface -90 12 air -\n"
     "thick -50 40 air - hiatus=2 distortion=0.05,0.2,-0.3 \nsurface 90 9 1.4 -\n",
     9},
    {"thick 50 40 1.2 - hiatus=3\nsurface 90 9 air -\nthick -80 30 air - hiatus=-2\n", 9},
    {"medium 1.33\nobject inf\nsurface - 5 1.8 -\nsurface 30 -7 mirror -\nsurface - 5 1.33 -\n",
     NAN},
};

static void check_case(size_t which, bool reverse, const struct ray *start, size_t *arrived)
{
    struct arena arena = {0};
    struct lens lens;
    struct system system;
    struct error error = {0};
    struct system_options options = system_options_default();
    options.path = true;
    options.reverse = reverse;
    options.image = reverse ? (double)NAN : cases[which].image;
    bool good = lens_read("t.lens", text_of(cases[which].text), NULL, &arena, &lens, &error) &&
                system_compile(&lens, 0.55, &options, &arena, &system, &error);
    bool refused = reverse && strstr(cases[which].text, "distortion") != NULL;
    CHECK(good != refused);
    if (!good) {
        arena_free(&arena);
        return;
    }
    const struct ray out = trace_one(&system, start);
    const struct verification seen = verify_ray(&system, start, &out);
    CHECK(seen.ray.status == out.status && seen.ray.surface == out.surface);
    if (out.status == RAY_OK) {
        ++*arrived;
        CHECK_NEAR(seen.point_error, 0, 1e-12, cases[which].text);
        CHECK_NEAR(seen.cosine_error, 0, 1e-14, cases[which].text);
        CHECK_NEAR(seen.path_error, 0, 1e-12, cases[which].text);
        for (int k = 0; k < 3; k++) {
            CHECK_NEAR(seen.ray.point[k], out.point[k], 1e-12, cases[which].text);
            CHECK_NEAR(seen.ray.cosine[k], out.cosine[k], 1e-14, cases[which].text);
        }
        CHECK_NEAR(seen.ray.path, out.path, 1e-12, cases[which].text);
        /* what is off by so much is said to be */
        struct ray off = out;
        off.point[1] += 0.125;
        off.cosine[0] -= 0.25;
        off.path += 0.5;
        const struct verification wrong = verify_ray(&system, start, &off);
        CHECK_NEAR(wrong.point_error, 0.125, 1e-12, "point");
        CHECK_NEAR(wrong.cosine_error, 0.25, 1e-12, "cosine");
        CHECK_NEAR(wrong.path_error, 0.5, 1e-12, "path");
    } else {
        CHECK(isnan(seen.point_error) && isnan(seen.cosine_error) && isnan(seen.path_error));
        CHECK(isnan(seen.ray.point[0]) && isnan(seen.ray.cosine[1]) && isnan(seen.ray.path));
    }
    arena_free(&arena);
}

static struct ray start_at(double x, double y, double ux, double uy, double towards)
{
    double length = sqrt(1 + ux * ux + uy * uy);
    return (struct ray){
        .point = {x, y, 0}, .cosine = {ux / length, uy / length, towards / length}, .path = 3};
}

/* What is not finite is lost, at the latest at the last surface of the part that is traced. */
static void test_overflow(void)
{
    struct arena arena = {0};
    struct lens lens;
    struct system system;
    struct error error;
    struct system_options options = system_options_default();
    options.path = true;
    CHECK(lens_read("t.lens",
                    text_of("surface 50 5 1.5 -\nsurface - 5 air -\nsurface 50 3 1.6 -\n"
                            "surface - 9 air -\n"),
                    NULL, &arena, &lens, &error));
    CHECK(system_compile(&lens, 0.55, &options, &arena, &system, &error));
    for (size_t to = 1; to <= 4; to++) {
        struct rays rays = rays_new(&arena, 1);
        struct ray start = start_at(1, 2, 0, 0, 1);
        start.path = INFINITY;
        rays_set(&rays, 0, 1, &start);
        rays_trace_part(&system, 0, to, &rays, NULL);
        const struct ray end = rays_get(&rays, 0, 1);
        CHECK(end.status == RAY_MISS && end.surface == to);
        CHECK(isnan(end.point[0]) && isnan(end.cosine[2]) && isnan(end.path));
    }
    arena_free(&arena);
}

int main(void)
{
    test_overflow();
    static const double places[][4] = {
        {0, 0, 0, 0},          {0, 0, 0.1, -0.05},       {3, -2, 0, 0},
        {-1.5, 4, 0.08, 0.12}, {0.25, -0.5, -0.2, 0.15}, {5, 7, -0.1, -0.2},
        {0, -9, 0, 0.3},       {45, 3, 0.1, 0.2},        {0, 24, 0, -0.9}};
    size_t count = sizeof cases / sizeof cases[0], arrived[2] = {0, 0};
    for (size_t i = 0; i < count; i++) {
        for (size_t k = 0; k < sizeof places / sizeof places[0]; k++) {
            for (int reverse = 0; reverse < 2; reverse++) {
                const double *p = places[k];
                /* light runs back through what has an odd number of mirrors forward */
                bool mirrored = i == 8 || i == 10 || i == 15;
                const struct ray start =
                    start_at(p[0], p[1], p[2], p[3], reverse && !mirrored ? -1 : 1);
                check_case(i, reverse != 0, &start, &arrived[reverse]);
            }
        }
    }
    CHECK(arrived[0] >= 6 * count && arrived[1] >= 4 * count);
    return check_report();
}
