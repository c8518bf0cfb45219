/* tests/unit/test_film_rays.c - rays from the film: closed forms, nothing lost, the same bits. */
/* SPDX-License-Identifier: MIT */
#include "camera/film/film_rays.h"

#include "analysis/setup/setup.h"
#include "base/constants.h"
#include "base/sobol.h"
#include "check.h"
#include "exchange/lens_open.h"
#include "file/lens_file.h"
#include "trace/dispatch.h"

/* A lens and its film. */
struct opened {
    struct arena arena;
    struct lens lens;
    struct setup setup;
    const struct system *systems[8];
    struct exit_pupil_bounds region;
};

static bool open_region(struct opened *opened, double film, double reach)
{
    struct error error;
    const struct setup_question question = {
        .lens = &opened->lens, .wavelength = NAN, .wavelengths = WAVELENGTHS_ALL, .fnumber = NAN};
    bool good = setup_open(&question, &opened->arena, &opened->setup, &error);
    for (size_t w = 0; good && w < opened->setup.wavelength_count; w++) {
        opened->systems[w] =
            setup_system(&opened->setup, w, SETUP_CLIPPED | SETUP_REVERSED, &error);
        good = opened->systems[w] != NULL;
    }
    const struct film_lens lens = {.systems = opened->systems,
                                   .count = opened->setup.wavelength_count,
                                   .first = &opened->setup.first,
                                   .film = film,
                                   .reach = reach};
    good = good && exit_pupil_bounds_open(&lens, &opened->arena, &opened->region, &error);
    if (!good) {
        printf("%s\n", error.message);
    }
    CHECK(good);
    return good;
}

static bool read_lens(struct opened *opened, const char *text)
{
    struct error error;
    *opened = (struct opened){.arena = {0}};
    const bool good = lens_read("test", text_of(text), NULL, &opened->arena, &opened->lens, &error);
    CHECK(good);
    return good;
}

static bool find_lens(struct opened *opened, const char *name)
{
    struct error error;
    *opened = (struct opened){.arena = {0}};
    struct lensdb db = {.arena = &opened->arena};
    const bool good = lens_open(&db, text_of(name), &opened->arena, &opened->lens, &error);
    CHECK(good);
    return good;
}

/* E/L of the point (x, y) by 2^18 rays, and the share of them that arrives. */
static double irradiance(struct opened *opened, size_t wavelength, double x, double y,
                         double *share)
{
    enum { BLOCKS = 2048 };
    const struct system *system = opened->systems[wavelength];
    struct rays rays = rays_new(&opened->arena, RAYS_BLOCK);
    static struct film_samples samples;
    static struct sobol sobol[2];
    double sum = 0, passed = 0;
    for (uint32_t k = 0; k < 2; k++) {
        sobol_open(k, &sobol[k]);
    }
    for (uint32_t block = 0; block < BLOCKS; block++) {
        sobol_points(&sobol[0], sobol_scrambling(1, 0, 0), block, samples.u);
        sobol_points(&sobol[1], sobol_scrambling(1, 0, 1), block, samples.v);
        for (int i = 0; i < RAYS_BLOCK; i++) {
            samples.x[i] = x;
            samples.y[i] = y;
        }
        film_rays_start(&opened->region, &samples, SET_BEST, rays.blocks);
        rays_trace(system, &rays, NULL);
        for (int i = 0; i < RAYS_BLOCK; i++) {
            const bool passes = rays.blocks->lost[i] == 0;
            sum += passes ? samples.weight[i] : 0;
            passed += passes ? 1 : 0;
        }
    }
    *share = passed / (BLOCKS * RAYS_BLOCK);
    const double n = opened->region.index / system->index_last;
    return n * n * sum / (BLOCKS * RAYS_BLOCK);
}

/* A disc of the radius tan(a), seen at the field angle t: exact, not cos^4. */
static double disc(double tan_a, double tan_t)
{
    double a2 = tan_a * tan_a, t2 = tan_t * tan_t;
    return PI / 2 * (1 - (1 + t2 - a2) / sqrt(t2 * t2 + 2 * t2 * (1 - a2) + (1 + a2) * (1 + a2)));
}

/* The same with something dark in its middle. */
static double ring(double tan_hole, double tan_t)
{
    return disc(0.5, tan_t) - (tan_hole > 0 ? disc(tan_hole, tan_t) : 0);
}

static void test_closed_forms(void)
{
    static const double heights[] = {0, 0.3, 7, 20, 40};
    static const struct {
        const char *text;
        double hole;
    } lenses[] = {
        {"lens disc\nwavelength d\nobject inf\naperture stop\nstop - 0 air 50\n", 0},
        {"lens ring\nwavelength d\nobject inf\naperture stop\nstop - 0 air 50\nblock circle 20\n",
         0.2},
    };
    for (size_t k = 0; k < sizeof lenses / sizeof lenses[0]; k++) {
        struct opened opened;
        if (!read_lens(&opened, lenses[k].text) || !open_region(&opened, 50, 50)) {
            return;
        }
        CHECK(opened.region.has_hole == (lenses[k].hole > 0));
        for (size_t i = 0; i < sizeof heights / sizeof heights[0]; i++) {
            const double h = heights[i], expected = ring(lenses[k].hole, h / 50);
            double share;
            CHECK_NEAR(irradiance(&opened, 0, 0.6 * h, -0.8 * h, &share), expected,
                       1e-4 * ring(lenses[k].hole, 0), "irradiance behind a hole");
            CHECK(share > 0.97);
        }
        arena_free(&opened.arena);
    }
}

/*
 * E/L of a polygon, its corners seen from the film, which looks along -z: Lambert's sum over its
 * sides, half the angle of each times the cosine between the normals of film and triangle.
 */
static double polygon(const double (*corners)[2], size_t count, double distance, double x, double y)
{
    double sum = 0;
    for (size_t i = 0; i < count; i++) {
        const double *p = corners[i], *q = corners[(i + 1) % count];
        const double a[3] = {p[0] - x, p[1] - y, distance}, b[3] = {q[0] - x, q[1] - y, distance};
        const double normal[3] = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                                  a[0] * b[1] - a[1] * b[0]};
        const double size =
            sqrt(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]);
        sum += atan2(size, a[0] * b[0] + a[1] * b[1] + a[2] * b[2]) * normal[2] / size / 2;
    }
    return fabs(sum);
}

/* Stops that are not round, without a lens: a rectangle, a pentagon, a triangle beside the axis. */
static void test_polygons(void)
{
    static const struct {
        const char *shape;
        double corners[5][2];
        size_t count;
        double share; /* that arrives, at least */
    } stops[] = {
        {"rectangle 40 24", {{-20, -12}, {20, -12}, {20, 12}, {-20, 12}}, 4, 0.95},
        {"polygon 20,0 6.18034,19.02113 -16.18034,11.75571 -16.18034,-11.75571 6.18034,-19.02113",
         {{20, 0},
          {6.18034, 19.02113},
          {-16.18034, 11.75571},
          {-16.18034, -11.75571},
          {6.18034, -19.02113}},
         5,
         0.93},
        {"polygon 5,5 20,7 9,18", {{5, 5}, {20, 7}, {9, 18}}, 3, 0.9},
    };
    static const double points[][2] = {{0, 0}, {1, -0.5}, {9, 4}, {-12, 16}, {3, -19}};
    for (size_t k = 0; k < sizeof stops / sizeof stops[0]; k++) {
        struct opened opened;
        char text[256];
        snprintf(text, sizeof text,
                 "lens stop\nwavelength d\nobject inf\naperture stop\nstop - 0 air 50\npass %s\n",
                 stops[k].shape);
        if (!read_lens(&opened, text) || !open_region(&opened, 50, 21)) {
            return;
        }
        CHECK(opened.region.is_grid);
        for (size_t i = 0; i < sizeof points / sizeof points[0]; i++) {
            double share;
            const double x = points[i][0], y = points[i][1];
            const double axis = polygon(stops[k].corners, stops[k].count, 50, 0, 0);
            CHECK_NEAR(irradiance(&opened, 0, x, y, &share),
                       polygon(stops[k].corners, stops[k].count, 50, x, y), 1.5e-4 * axis,
                       stops[k].shape);
            CHECK(share > stops[k].share);
        }
        arena_free(&opened.arena);
    }
}

/* A film close behind its stop, which sees it up to 89 degrees off the normal. */
static void test_steep(void)
{
    static const double angles[] = {60, 76, 80, 83, 86, 88, 88.9};
    static const struct {
        const char *text;
        double hole, end; /* mm; degrees that the corner of the film is at */
    } stops[] = {
        {"", 0, 80},
        {"", 0, 82.1},
        {"", 0, 88.95},
        {"block circle 1\n", 0.2, 82.1},
        {"block circle 1\n", 0.2, 88.95},
    };
    for (size_t k = 0; k < sizeof stops / sizeof stops[0]; k++) {
        struct opened opened;
        char text[256];
        const double reach = 2.5 * tan(stops[k].end * PI / 180);
        snprintf(text, sizeof text,
                 "lens disc\nwavelength d\nobject inf\naperture stop\nstop - 0 air 2.5\n%s",
                 stops[k].text);
        if (!read_lens(&opened, text) || !open_region(&opened, 2.5, reach)) {
            return;
        }
        for (size_t i = 0; i < sizeof angles / sizeof angles[0] && angles[i] < stops[k].end; i++) {
            const double tan_t = tan(angles[i] * PI / 180), h = 2.5 * tan_t;
            double share;
            CHECK_RELATIVE(irradiance(&opened, 0, 0.6 * h, -0.8 * h, &share),
                           ring(stops[k].hole, tan_t), 2e-4, "irradiance at grazing incidence");
            CHECK(share > 0.95);
        }
        arena_free(&opened.arena);
    }
}

/* The same behind a rectangle; what goes farther is refused. */
static void test_steep_rectangle(void)
{
    static const double corners[4][2] = {{-1.2, -0.8}, {1.2, -0.8}, {1.2, 0.8}, {-1.2, 0.8}};
    static const double angles[] = {60, 76, 82, 85};
    static const char text[] = "lens stop\nwavelength d\nobject inf\naperture stop\n"
                               "stop - 0 air 6\npass rectangle 2.4 1.6\n";
    struct opened opened;
    if (!read_lens(&opened, text) || !open_region(&opened, 2.5, 2.5 * tan(85.5 * PI / 180))) {
        return;
    }
    for (size_t i = 0; i < sizeof angles / sizeof angles[0]; i++) {
        const double h = 2.5 * tan(angles[i] * PI / 180), x = 0.6 * h, y = -0.8 * h;
        double share;
        CHECK_RELATIVE(irradiance(&opened, 0, x, y, &share), polygon(corners, 4, 2.5, x, y), 2e-4,
                       "irradiance of a rectangle at grazing incidence");
        CHECK(share > 0.95);
    }
    struct error error;
    const struct film_lens lens = {opened.systems, 1, &opened.setup.first, 2.5, 150};
    CHECK(!exit_pupil_bounds_open(&lens, &opened.arena, &opened.region, &error));
    CHECK_TEXT(error.message, "light reaches the film 89.05 degrees off its normal, looked at up "
                              "to 86 degrees for a lens that is not round");
    arena_free(&opened.arena);
}

/* A lens beside the axis, as a whole: the same light as of the round one, about another point. */
static void test_decentred(void)
{
    struct opened opened;
    if (!read_lens(&opened, "lens beside\nwavelength d\nobject inf\naperture stop\n"
                            "surface 29.475 3.76 1.67 25.2 decenter=3,-2\n"
                            "surface 84.83 0.12 air 25.2 decenter=3,-2\n"
                            "surface 19.275 4.025 1.67 23 decenter=3,-2\n"
                            "surface 40.77 3.275 1.699 23 decenter=3,-2\n"
                            "surface 12.75 5.705 air 18 decenter=3,-2\n"
                            "stop - 4.5 air 17.1 decenter=3,-2\n"
                            "surface -14.495 1.18 1.603 17 decenter=3,-2\n"
                            "surface 40.77 6.065 1.658 20 decenter=3,-2\n"
                            "surface -20.385 0.19 air 20 decenter=3,-2\n"
                            "surface 437.065 3.22 1.717 20 decenter=3,-2\n"
                            "surface -39.73 36.105905 air 20 decenter=3,-2\n") ||
        !open_region(&opened, 36.105905, 21.6333)) {
        return;
    }
    /* the irradiance of the round one, as in test_lenses */
    static const double known[][3] = {{3, -2, .192512}, {9, 6, .125716}, {-9, 14, .042577}};
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++) {
        double share;
        CHECK_NEAR(irradiance(&opened, 0, known[i][0], known[i][1], &share), known[i][2],
                   1e-4 * .192512, "irradiance of a decentred lens");
        CHECK(share > 0.9);
    }
    arena_free(&opened.arena);
}

/*
 * Over the film of the course's lenses, and of one with a smaller stop: an independent program
 * on a grid of 3000^2, about 1e-4, and so are these.
 */
static void test_lenses(void)
{
    static const struct {
        const char *name;
        double film, stop;  /* mm; stop: its diameter, 0 the lens's own */
        double known[7][2]; /* height, mm; E/L */
    } lenses[] = {
        {"cs348b-dgauss-50",
         36.105905,
         0,
         {{0, .192512},
          {5, .167216},
          {10, .125716},
          {15, .082428},
          {18, .057826},
          {20, .042577},
          {21.633, .031036}}},
        {"cs348b-dgauss-50",
         36.105905,
         4.275,
         {{0, .011921}, {10, .011215}, {20, .009499}, {21.633, .009179}}},
        {"cs348b-wide-22",
         14.318263,
         0,
         {{0, .101025}, {5, .086408}, {10, .062632}, {13.5, .045164}, {17, .029989}}},
        {"cs348b-telephoto-250",
         105.070394,
         0,
         {{0, .025110}, {10, .024934}, {20, .024410}, {21.633, .024148}}},
        {"cs348b-fisheye-10",
         23.160539,
         0,
         {{0, .049239}, {4, .041914}, {8, .027329}, {12, .012785}}},
    };
    for (size_t i = 0; i < sizeof lenses / sizeof lenses[0]; i++) {
        struct opened opened;
        if (!find_lens(&opened, lenses[i].name)) {
            return;
        }
        if (lenses[i].stop > 0) {
            opened.lens.surfaces[opened.lens.stop].diameter.value.hi = lenses[i].stop;
        }
        if (!open_region(&opened, lenses[i].film, 21.6333)) {
            return;
        }
        for (size_t k = 0; k < 7 && lenses[i].known[k][1] > 0; k++) {
            const double expected = lenses[i].known[k][1];
            double share;
            CHECK_NEAR(irradiance(&opened, 0, lenses[i].known[k][0], 0, &share), expected,
                       2e-4 * expected + 5e-7, lenses[i].name);
            CHECK(share > 0.969);
        }
        arena_free(&opened.arena);
    }
}

/* A square about the region at a distance from the axis, a third wider than it. */
struct box {
    double across, middle, half; /* direction cosines: x and y of its middle */
};

static struct box box_of(const struct exit_pupil_bounds *region, size_t row)
{
    double low = INFINITY, high = -INFINITY;
    for (size_t k = 0; k < FILM_CORNERS; k++) {
        low = fmin(low, fmin(region->outer[0][row * FILM_CORNERS + k],
                             region->outer[1][row * FILM_CORNERS + k]));
        high = fmax(high, fmax(region->outer[0][row * FILM_CORNERS + k],
                               region->outer[1][row * FILM_CORNERS + k]));
    }
    return (struct box){0, (low + high) / 2, 0.67 * (high - low)};
}

/* E/L by rays through the middles of an even grid over the box. */
static double grid_irradiance(struct opened *opened, size_t wavelength, const double point[2],
                              struct box box)
{
    enum { SIDE = 512 };
    const struct exit_pupil_bounds *region = &opened->region;
    const struct system *system = opened->systems[wavelength];
    const struct rays rays = rays_new(&opened->arena, SIDE);
    const double step = 2 * box.half / SIDE;
    double sum = 0;
    for (int row = 0; row < SIDE; row++) {
        const double y = box.middle - box.half + (row + 0.5) * step;
        for (int i = 0; i < SIDE; i++) {
            const double x = box.across - box.half + (i + 0.5) * step;
            const struct ray ray = {.point = {point[0], point[1], region->film},
                                    .cosine = {x, y, -sqrt(fmax(1 - x * x - y * y, 0))}};
            rays_set(&rays, (size_t)i, region->index, &ray);
        }
        rays_trace(system, &rays, NULL);
        for (int i = 0; i < SIDE; i++) {
            sum += rays_get(&rays, (size_t)i, 1).status == RAY_OK ? step * step : 0;
        }
    }
    return sum;
}

/* Nothing passes beside the regions: a mirror lens with its hole, a zoom, cat's eyes. */
static void test_nothing_lost(void)
{
    static const char *const names[] = {"questar-35", "nikkor-z-14-24", "nikkor-z-58-f095"};
    for (size_t k = 0; k < sizeof names / sizeof names[0]; k++) {
        struct opened opened;
        if (!find_lens(&opened, names[k]) || !open_region(&opened, 40, 21.6333)) {
            return;
        }
        for (size_t row = 3; row < FILM_RADII; row += 20) {
            const size_t w = row % opened.setup.wavelength_count;
            const double rest = 1 - (double)row / (FILM_RADII - 1);
            const double h = opened.region.largest * (1 - rest * rest);
            double share;
            CHECK_RELATIVE(
                irradiance(&opened, w, 0, h, &share),
                grid_irradiance(&opened, w, (double[2]){0, h}, box_of(&opened.region, row)), 1.5e-3,
                names[k]);
        }
        arena_free(&opened.arena);
    }
}

/* Cylinders, whose pupils are not round and whose image circle is none. */
static void test_cylinders(void)
{
    static const struct {
        double point[2];
        struct box box; /* about the pupil, seen in a coarse grid over all directions */
    } known[] = {
        {{0, 0}, {0, 0, 0.3}},
        {{6, 8}, {-0.12, -0.16, 0.35}},
        {{-11.65, 3.03}, {0.23, -0.06, 0.35}},
        {{14.23, -6.46}, {-0.3, 0.15, 0.3}},
    };
    struct opened opened;
    if (!find_lens(&opened, "schneider-anamorphic-31") || !open_region(&opened, 43.3809, 18)) {
        return;
    }
    double axis = 0;
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++) {
        const double *at = known[i].point;
        double share;
        const double found = irradiance(&opened, i % 3, at[0], at[1], &share);
        axis = i == 0 ? found : axis;
        CHECK_NEAR(found, grid_irradiance(&opened, i % 3, at, known[i].box), 5e-4 * axis,
                   "irradiance behind cylinders");
        CHECK(share > 0.92);
    }
    arena_free(&opened.arena);
}

/* Six blades in a round lens, of which half is looked at; seven, and six beside the axis: all. */
static void test_blades(void)
{
    static const double points[][2] = {{0, 0}, {7, 3}, {-11, 5}, {-8, -9}, {9, -12}};
    static const char *const shapes[] = {
        "8.5,0 4.25,7.36 -4.25,7.36 -8.5,0 -4.25,-7.36 4.25,-7.36",
        "8.5,0 5.3,6.65 -1.89,8.29 -7.66,3.69 -7.66,-3.69 -1.89,-8.29 5.3,-6.65",
        "8.5,0 4.25,7.36 -4.25,7.36 -8.5,0 -4.25,-7.36 4.25,-7.36 decenter=0.5,0.2"};
    for (size_t k = 0; k < sizeof shapes / sizeof shapes[0]; k++) {
        struct opened opened;
        char text[1024];
        snprintf(text, sizeof text,
                 "lens bladed\nwavelength d\nobject inf\naperture stop\n"
                 "surface 29.475 3.76 1.67 25.2\nsurface 84.83 0.12 air 25.2\n"
                 "surface 19.275 4.025 1.67 23\nsurface 40.77 3.275 1.699 23\n"
                 "surface 12.75 5.705 air 18\nstop - 4.5 air 17.1\npass polygon %s\n"
                 "surface -14.495 1.18 1.603 17\nsurface 40.77 6.065 1.658 20\n"
                 "surface -20.385 0.19 air 20\nsurface 437.065 3.22 1.717 20\n"
                 "surface -39.73 36.105905 air 20\n",
                 shapes[k]);
        if (!read_lens(&opened, text) || !open_region(&opened, 36.105905, 21.6333)) {
            return;
        }
        double axis = 0;
        for (size_t i = 0; i < sizeof points / sizeof points[0]; i++) {
            const double *at = points[i];
            double share;
            const double found = irradiance(&opened, 0, at[0], at[1], &share);
            axis = i == 0 ? found : axis;
            CHECK_NEAR(
                found,
                grid_irradiance(&opened, 0, at, (struct box){-0.02 * at[0], -0.02 * at[1], 0.35}),
                5e-4 * axis, shapes[k]);
            CHECK(share > 0.93);
        }
        arena_free(&opened.arena);
    }
}

static void compare_bits(struct opened *opened)
{
    static const enum instruction_set sets[] = {SET_SSE2, SET_AVX2, SET_AVX512};
    static struct film_samples samples[3];
    struct rays rays[3];
    struct sobol sobol;
    for (size_t k = 0; k < 3 && instruction_set_works(sets[k]); k++) {
        rays[k] = rays_new(&opened->arena, RAYS_BLOCK);
        double *const rows[] = {samples[k].x, samples[k].y, samples[k].u, samples[k].v};
        for (uint32_t d = 0; d < 4; d++) {
            sobol_open(d, &sobol);
            sobol_points(&sobol, sobol_scrambling(7, 0, d), 3, rows[d]);
        }
        for (int i = 0; i < RAYS_BLOCK; i++) {
            samples[k].x[i] = 44 * samples[k].x[i] - 22;
            samples[k].y[i] = 44 * samples[k].y[i] - 22;
        }
        film_rays_start(&opened->region, &samples[k], sets[k], rays[k].blocks);
        CHECK(memcmp(&samples[k], &samples[0], sizeof samples[0]) == 0);
        CHECK(memcmp(rays[k].blocks, rays[0].blocks, sizeof *rays[0].blocks) == 0);
    }
    arena_free(&opened->arena);
}

static void check_same_bits(const char *name, double film)
{
    struct opened opened;
    if (find_lens(&opened, name) && open_region(&opened, film, 21.6333)) {
        compare_bits(&opened);
    }
}

/* With a hole, without, with columns, and with tangents. */
static void test_same_bits(void)
{
    check_same_bits("questar-35", 40);
    check_same_bits("double-gauss-50", 36);
    check_same_bits("schneider-anamorphic-31", 43.3809);
    struct opened steep;
    if (read_lens(&steep,
                  "lens disc\nwavelength d\nobject inf\naperture stop\nstop - 0 air 2.5\n") &&
        open_region(&steep, 2.5, 21.6333)) {
        CHECK(steep.region.tangent > 0);
        compare_bits(&steep);
    }
}

/* Where light ends the weight does, and a film in the last vertex is none. */
static void test_ends(void)
{
    struct opened opened;
    double share;
    if (find_lens(&opened, "fisheye-16") && open_region(&opened, 35, 30)) {
        CHECK(opened.region.largest > 15 && opened.region.largest < 30);
        CHECK(irradiance(&opened, 0, 0, opened.region.largest * 1.001, &share) == 0);
        CHECK(irradiance(&opened, 0, 0, opened.region.largest * 0.99, &share) > 0);
        struct error error;
        const struct film_lens lens = {opened.systems, 1, &opened.setup.first, 0, 20};
        CHECK(!exit_pupil_bounds_open(&lens, &opened.arena, &opened.region, &error));
        CHECK_TEXT(error.message, "the film lies in the last vertex");
        arena_free(&opened.arena);
    }
}

int main(void)
{
    test_closed_forms();
    test_polygons();
    test_steep();
    test_steep_rectangle();
    test_decentred();
    test_lenses();
    test_cylinders();
    test_blades();
    test_nothing_lost();
    test_same_bits();
    test_ends();
    return check_report();
}
