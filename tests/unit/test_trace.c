/* tests/unit/test_trace.c - exact rays: other programs, closed forms, hard cases, all kernels. */
/* SPDX-License-Identifier: MIT */
#include "base/constants.h"
#include "check.h"
#include "exchange/lens_open.h"
#include "trace/aim/beam.h"
#include "trace/dispatch.h"
#include "trace/verify.h"
#include "trace_one.h"

static const char gauss[] = "surface 58.950 7.520 1.670 50.4\nsurface 169.660 0.240 air 50.4\n"
                            "surface 38.550 8.050 1.670 46.0\nsurface 81.540 6.550 1.699 46.0\n"
                            "surface 25.500 11.410 air 36.0\nstop - 9.000 air 34.2\n"
                            "surface -28.990 2.360 1.603 34.0\nsurface 81.540 12.130 1.658 40.0\n"
                            "surface -40.770 0.380 air 40.0\nsurface 874.130 6.440 1.717 40.0\n"
                            "surface -79.460 72.228 air 40.0\n";

static bool compile(const char *text, double image, bool clip, struct arena *arena,
                    struct system *system)
{
    struct lens *lens = ARENA_NEW(arena, struct lens);
    struct error error;
    struct system_options options = system_options_default();
    options.path = true;
    options.clip = clip;
    options.image = image;
    if (!lens_read("test", text_of(text), NULL, arena, lens, &error) ||
        !system_compile(lens, 0.5875618, &options, arena, system, &error)) {
        printf("%s\n", error.message);
        return false;
    }
    return true;
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

/* Does long double have more bits than double? Not under valgrind. */
static bool has_extended(void)
{
    volatile long double one = 1, tiny = 0x1p-60L;
    return one + tiny != one;
}

/*
 * Twelve rays of the double Gauss, on the plane at the paraxial back focus: three programs agree to
 * 13 or 14 digits (50-digit program, ray-optics 0.9.8, optiland 0.6.0).
 */
static void check_golden(void)
{
    static const struct {
        const char *name;
        double start[5], end[6];
    } rays[] = {
        {"axial-10",
         {0.0, 10.0, 0.0, 0.0, 1.0},
         {0.0, -0.008851321568479689, 0.0, -0.09936398260428688, 0.99505115394185387,
          185.32490048102315}},
        {"axial-24",
         {0.0, 24.0, 0.0, 0.0, 1.0},
         {0.0, 0.062622841302978188, 0.0, -0.23768779565425643, 0.97134160406986606,
          185.30842069978478}},
        {"axial-skew",
         {12.0, -16.0, 0.0, 0.0, 1.0},
         {-0.0038935276610465496, 0.0051913702147287327, -0.11916249035750817, 0.15888332047667756,
          0.98007978826527289, 185.32376052256921}},
        {"14deg-chief",
         {0.0, -14.93, 0.0, 0.24192189559966773, 0.9702957262759965},
         {0.0, 24.995375441028831, 0.0, 0.22016049339205467, 0.97546366264939211,
          189.9818371182435}},
        {"14deg-upper",
         {0.0, 2.0, 0.0, 0.24192189559966773, 0.9702957262759965},
         {0.0, 25.111476462530048, 0.0, 0.065449403439609204, 0.99785588918911496,
          185.89601738264444}},
        {"14deg-lower",
         {0.0, -29.0, 0.0, 0.24192189559966773, 0.9702957262759965},
         {0.0, 24.901236591141657, 0.0, 0.34923766693382726, 0.93703417866938938,
          193.35498065740999}},
        {"14deg-sagittal",
         {15.0, -14.93, 0.0, 0.24192189559966773, 0.9702957262759965},
         {0.0020201280364521813, 24.987600727140888, -0.14520736350867701, 0.22019000348526883,
          0.96458860865553261, 189.97833780099583}},
        {"14deg-skew",
         {-10.0, -24.0, 0.0, 0.24192189559966773, 0.9702957262759965},
         {-0.010712956741428974, 24.952444755105395, 0.096822888881627679, 0.30348019007501001,
          0.94790564004053261, 192.16220978572212}},
        {"20deg-chief",
         {0.0, -21.8, 0.0, 0.3420201433256687, 0.9396926207859084},
         {0.0, 36.261878248012608, 0.0, 0.30144185903263733, 0.95348455971921622,
          194.94671641458279}},
        {"xy-skew",
         {-8.0, -14.0, 0.1, 0.2, 0.9746794344808964},
         {10.295706846556805, 20.587449896116218, 0.10900867116661903, 0.19854980200496127,
          0.97400979755558855, 189.81276067501237}},
        {"near-object",
         {0.0, 0.0, 0.0, 0.3, 0.9539392014169457},
         {0.0, 31.693325184150715, 0.0, 0.10419559488651324, 0.99455682492567795,
          186.99849471962864}},
        {"near-skew",
         {3.0, -4.0, -0.2, 0.25, 0.9473647660748199},
         {-21.123134248542084, 26.402724888023997, -0.094068290370184834, 0.11994712344857724,
          0.98831363661706215, 188.82074275831309}},
    };
    struct arena arena = {0};
    struct system system;
    CHECK(compile(gauss, 72.211810477084275, false, &arena, &system));
    for (size_t i = 0; i < sizeof rays / sizeof rays[0]; i++) {
        const double *s = rays[i].start;
        struct ray start = {.point = {s[0], s[1], -20}, .cosine = {s[2], s[3], s[4]}};
        struct ray end = trace_one(&system, &start);
        double figures[6] = {end.point[0],  end.point[1],  end.cosine[0],
                             end.cosine[1], end.cosine[2], end.path};
        CHECK(end.status == RAY_OK);
        for (int j = 0; j < 6; j++) {
            CHECK_NEAR(figures[j], rays[i].end[j], 2e-13, rays[i].name);
        }
        struct verification check = verify_ray(&system, &start, &end);
        if (has_extended()) {
            CHECK(check.point_error <= 1e-13 && check.path_error <= 2e-13);
            CHECK_NEAR(check.ray.point[1], rays[i].end[1], 2e-15 * (2 + fabs(rays[i].end[1])),
                       rays[i].name);
        }
    }
    if (!has_extended()) {
        printf("80-bit rays: skipped, long double has 53 bits here\n");
    }
    arena_free(&arena);
}

/* One ray more: the table's own distance. Four programs print these digits. */
static void check_table_distance(void)
{
    struct arena arena = {0};
    struct system system;
    CHECK(compile(gauss, 72.228, false, &arena, &system));
    const struct ray start = {.point = {12, -16, -20}, .cosine = {0, 0, 1}};
    struct ray end = trace_one(&system, &start);
    CHECK_NEAR(end.point[0], -0.00586192237, 6e-12, "x");
    CHECK_NEAR(end.point[1], 0.00781589649, 6e-12, "y");
    arena_free(&arena);
}

/* Surfaces that image a point exactly; what comes to the axis there must be 0. */
static void check_stigmatic(void)
{
    static const struct {
        const char *text;
        double object, image, height; /* object 0 = at infinity */
    } cases[] = {
        /* parabola: focus at R/2 */
        {"surface -200 0 mirror - k=-1\n", 0, -100, 60},
        /* plano-hyperboloid, k = -n^2: focus at R/(1 - n) behind the vertex */
        {"surface - 10 1.5 -\nsurface -50 0 air - k=-2.25\n", 0, 100, 30},
        /* ellipsoid, k = -1/n^2: focus at n R/(n - 1), inside */
        {"surface 50 0 1.5 - k=-0.44444444444444444444\n", 0, 150, 20},
        /* sphere at its aplanatic points: object R (n + 1)/n before the far vertex of the glass */
        {"medium 1.5\nsurface -30 0 1 -\n", 50, -75, 12},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct arena arena = {0};
        struct system system;
        CHECK(compile(cases[i].text, cases[i].image, false, &arena, &system));
        for (int j = 1; j <= 10; j++) {
            double height = cases[i].height * j / 10;
            const double object[3] = {0, 0, -cases[i].object};
            const double target[2] = {0.6 * height, 0.8 * height};
            struct ray start = {.point = {target[0], target[1], 0}, .cosine = {0, 0, 1}};
            if (cases[i].object > 0) {
                start = ray_through(object, target, system.index_first);
            }
            struct ray end = trace_one(&system, &start);
            CHECK(end.status == RAY_OK);
            CHECK_NEAR(end.point[0], 0, 1e-12 * fabs(cases[i].image), cases[i].text);
            CHECK_NEAR(end.point[1], 0, 1e-12 * fabs(cases[i].image), cases[i].text);
        }
        arena_free(&arena);
    }
}

/* Spherical mirror: crossing at R (1 - 1/(2 sqrt(1 - (y/R)^2))). Ball: bfl f - D/2 near the axis */
static void check_mirror_and_ball(void)
{
    struct arena arena = {0};
    struct system system;
    CHECK(compile("surface -200 0 mirror -\n", NAN, false, &arena, &system));
    for (int i = 1; i < 19; i++) {
        double y = 10 * i, sine = y / 200;
        const struct ray start = {.point = {0, y, -300}, .cosine = {0, 0, 1}};
        struct ray end = trace_one(&system, &start);
        double crossing = end.point[2] - end.point[1] * end.cosine[2] / end.cosine[1];
        CHECK_RELATIVE(crossing, -200 * (1 - 1 / (2 * sqrt(1 - sine * sine))), 1e-13, "crossing");
    }
    CHECK(compile("surface 10 20 1.5 -\nsurface -10 0 air -\n", NAN, false, &arena, &system));
    const struct ray start = {.point = {0, 1e-5, 0}, .cosine = {0, 0, 1}};
    struct ray end = trace_one(&system, &start);
    double crossing = end.point[2] - end.point[1] * end.cosine[2] / end.cosine[1];
    CHECK_NEAR(crossing, 1.5 * 20 / (4 * 0.5) - 10, 1e-10, "back focus of a ball, mm");
    arena_free(&arena);
}

/* Far objects, weak and concentric surfaces, grazing rays: as good as with 64 bits. */
static void check_hard(void)
{
    static const struct {
        const char *name, *text;
        double object, target, allowed; /* mm; the object is half as high */
    } cases[] = {
        {"object at 1e12 mm", gauss, 1e12, 8, 1e-13},
        {"object at 1e6 mm", gauss, 1e6, 8, 1e-13},
        {"R = 1e9",
         "surface 1e9 8 1.5 -\nsurface -1e9 3 air -\nsurface 60 5 1.6 -\nsurface -1e9 0 air -\n",
         1000, 9, 1e-13},
        {"nearly concentric",
         "surface 50 20 1.5 -\nsurface 30.000001 40 1.6 -\nsurface -10 0 air -\n", 200, 3, 1e-13},
    };
    struct arena arena = {0};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0] && has_extended(); i++) {
        struct system system;
        CHECK(compile(cases[i].text, 70, false, &arena, &system));
        for (int j = -10; j <= 10; j++) {
            const double object[3] = {0, 0.05 * cases[i].object, -cases[i].object};
            const double target[2] = {cases[i].target * j / 10, cases[i].target * (j - 2) / 14};
            struct ray start = ray_through(object, target, 1), end = trace_one(&system, &start);
            struct verification check = verify_ray(&system, &start, &end);
            CHECK(end.status == RAY_OK);
            CHECK_NEAR(check.point_error, 0, cases[i].allowed, cases[i].name);
            CHECK_NEAR(check.path_error, 0, 4 * cases[i].allowed, cases[i].name);
            /* started at the object itself: the point, not the path, has all its digits */
            struct ray far = start;
            memcpy(far.point, object, sizeof object);
            end = trace_one(&system, &far);
            double worst = fabs(end.point[1] - check.ray.point[1]);
            CHECK_NEAR(worst, 0, 1e-16 * cases[i].object + cases[i].allowed, cases[i].name);
        }
    }
    /* grazing: 1e-6 rad from the surface's tangent plane, at its vertex */
    struct system system;
    CHECK(compile("surface 100 0 1.5 -\n", NAN, false, &arena, &system));
    const double angle = 1e-6;
    const struct ray start = {.cosine = {0, cos(angle), sin(angle)}};
    struct ray end = trace_one(&system, &start);
    CHECK(end.status == RAY_OK);
    CHECK_NEAR(end.cosine[1], cos(angle) / 1.5, 2e-16, "Snell at grazing incidence");
    arena_free(&arena);
}

/* Tilts by hand: a plane mirror at 45 degrees; a wedge; a bend and its contrary. */
static void check_tilts(void)
{
    struct arena arena = {0};
    struct system system;
    CHECK(compile("surface - 10 mirror - tilt=45,0\n", NAN, false, &arena, &system));
    const struct ray axis = {.point = {0, 0, -10}, .cosine = {0, 0, 1}};
    struct ray end = trace_one(&system, &axis);
    /* the mirror's normal is (0, -1, 1)/sqrt 2: light along z leaves along +y */
    CHECK_NEAR(end.cosine[1], 1, 1e-15, "folded direction");
    CHECK_NEAR(end.cosine[2], 0, 1e-15, "folded direction");
    CHECK_NEAR(end.path, 10, 1e-14, "path to the mirror");
    CHECK(compile("surface - 5 1.5 -\nsurface - 0 air - decenter=3,4 tilt=10,0\n", NAN, false,
                  &arena, &system));
    end = trace_one(&system, &axis);
    double a = 10 * RADIANS_PER_DEGREE;
    CHECK_NEAR(atan2(end.cosine[1], end.cosine[2]), asin(1.5 * sin(a)) - a, 1e-15, "prism");
    CHECK_NEAR(end.point[2], -4 * tan(a), 1e-14, "the wedge's face");
    CHECK(compile("surface 50 5 1.5 -\nbend decenter=1,2 tilt=10,0,0\nsurface - 0 1.5 -\n"
                  "bend tilt=-10,0,0\nsurface -40 0 air -\n",
                  NAN, false, &arena, &system));
    struct surface_frame frame = system_frames(&system, &arena)[2];
    CHECK_NEAR(frame.shift[0], 1, 1e-15, "frame");
    CHECK_NEAR(frame.shift[1], 2, 1e-15, "frame");
    CHECK_NEAR(frame.shift[2], 5, 1e-15, "frame");
    CHECK_NEAR(frame.turn[4], 1, 1e-15, "frame");
    arena_free(&arena);
}

/* Losses by name and place; what they hold. */
static void check_losses(void)
{
    static const struct {
        double y, v;
        enum ray_status status;
        size_t surface;
    } cases[] = {{0, 0, RAY_OK, 0},
                 {26, 0, RAY_CLIPPED, 1},
                 {60, 0, RAY_MISS, 1},
                 {25.1, 0, RAY_CLIPPED, 3}};
    struct arena arena = {0};
    struct system system;
    CHECK(compile(gauss, 72, true, &arena, &system));
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        double length = sqrt(1 + cases[i].v * cases[i].v);
        const struct ray start = {.point = {0, cases[i].y, 0},
                                  .cosine = {0, cases[i].v / length, 1 / length}};
        struct ray end = trace_one(&system, &start);
        bool right = end.status == cases[i].status && end.surface == cases[i].surface;
        if (!right) {
            printf("y %g: %s at %zu\n", cases[i].y, ray_status_name(end.status), end.surface);
        }
        CHECK(right);
        CHECK((end.status == RAY_MISS) == isnan(end.point[0]) || end.status == RAY_CLIPPED);
    }
    CHECK(compile("medium 1.5\nsurface - 0 air -\n", NAN, true, &arena, &system));
    const struct ray steep = {.cosine = {0, 0.8, 0.6}};
    struct ray end = trace_one(&system, &steep);
    CHECK(end.status == RAY_TOTAL_REFLECTION && end.surface == 1 && isnan(end.cosine[2]));
    arena_free(&arena);
}

/* Every instruction set, any number of threads and any neighbours give the same bits. */
static void check_sets(const struct system *system, struct arena *arena, const char *name)
{
    enum { COUNT = 1000 };
    struct rays first = rays_new(arena, COUNT), others = rays_new(arena, COUNT);
    double radius = 0;
    for (size_t i = 0; i < system->lens->surface_count; i++) {
        radius = fmax(radius, system->lens->surfaces[i].diameter.value.hi / 2);
    }
    for (size_t i = 0; i < COUNT; i++) {
        double u = (double)(i % 32) / 16 - 1, v = (double)(i / 32) / 16 - 1, angle = 0.5 * v * u;
        struct ray ray = {.point = {radius * u, radius * v, 0},
                          .cosine = {0, sin(angle), cos(angle)}};
        rays_set(&first, i, system->index_first, &ray);
    }
    size_t bytes = rays_blocks(&first) * sizeof(struct ray_block);
    struct ray_block *start = arena_array(arena, rays_blocks(&first), sizeof(struct ray_block));
    memcpy(start, first.blocks, bytes);
    const struct trace_way plain = {SET_SSE2, 1};
    rays_trace(system, &first, &plain);
    for (enum instruction_set set = SET_BEST; set <= SET_AVX512; set++) {
        for (int threads = 1; threads <= 3 && instruction_set_works(set); threads++) {
            const struct trace_way way = {set, threads};
            memcpy(others.blocks, start, bytes);
            rays_trace(system, &others, &way);
            bool same = memcmp(first.blocks, others.blocks, bytes) == 0;
            if (!same) {
                printf("%s: %s differs from sse2\n", name, instruction_set_name(set));
            }
            CHECK(same);
        }
    }
    /* one by one, and surface by surface */
    for (size_t i = 0; i < COUNT; i += 97) {
        struct rays alone = rays_new(arena, 1);
        size_t block = i / RAYS_BLOCK, lane = i % RAYS_BLOCK;
        alone.blocks[0].x[0] = start[block].x[lane];
        alone.blocks[0].y[0] = start[block].y[lane];
        alone.blocks[0].q[0] = start[block].q[lane];
        alone.blocks[0].r[0] = start[block].r[lane];
        for (size_t place = 0; place < system->places; place++) {
            rays_trace_part(system, place, place + 1, &alone, NULL);
        }
        const double *a = alone.blocks[0].x, *b = first.blocks[block].x + lane;
        for (size_t member = 0; member < 8; member++) {
            CHECK(memcmp(a + member * RAYS_BLOCK, b + member * RAYS_BLOCK, sizeof *a) == 0);
        }
    }
    /* a few at a time, for which there are kernels of their own, and parts of blocks */
    static const size_t counts[] = {1, 5, RAYS_FEW, RAYS_FEW + 1, 49, 100};
    for (size_t k = 0; k < sizeof counts / sizeof counts[0]; k++) {
        const size_t block = k % rays_blocks(&first);
        memcpy(others.blocks, &start[block], sizeof *start);
        const struct rays few = {others.blocks, counts[k]};
        rays_trace(system, &few, NULL);
        const double *a = few.blocks->x, *b = first.blocks[block].x;
        for (size_t member = 0; member < 8; member++) {
            CHECK(memcmp(a + member * RAYS_BLOCK, b + member * RAYS_BLOCK, counts[k] * sizeof *a) ==
                  0);
        }
    }
    for (size_t i = 0; i < COUNT; i++) {
        struct ray ray = rays_get(&first, i, 1);
        double sum = ray.point[0] + ray.point[1] + ray.cosine[2] + ray.path;
        CHECK(ray.status != RAY_OK || isfinite(sum));
    }
}

static void check_lensdb(void)
{
    struct arena all = {0};
    struct lensdb db = {.arena = &all};
    const char *const *names;
    struct error error;
    CHECK(lens_open_names(&db, LENSDB_EMBEDDED, &all, &names, &error));
    for (size_t i = 0; names != NULL && names[i] != NULL; i++) {
        struct arena arena = {0};
        struct lens *lens = ARENA_NEW(&arena, struct lens);
        struct system system;
        CHECK(lens_open(&db, text_of(names[i]), &arena, lens, &error));
        const struct lens *first = lens_at_position(lens, 0, &arena);
        for (int path = 0; path < 2; path++) {
            struct system_options options = system_options_default();
            options.clip = true;
            options.path = path != 0;
            bool good = system_compile(first, lens_primary_wavelength(first), &options, &arena,
                                       &system, &error);
            if (!good) {
                printf("%s: %s\n", names[i], error.message);
            }
            CHECK(good);
            if (good) {
                check_sets(&system, &arena, names[i]);
            }
        }
        arena_free(&arena);
    }
    arena_free(&all);
}

int main(void)
{
    check_golden();
    check_table_distance();
    check_stigmatic();
    check_mirror_and_ball();
    check_hard();
    check_tilts();
    check_losses();
    check_lensdb();
    return check_report();
}
