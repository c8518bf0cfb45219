/* tests/unit/test_clear_cross.c - edges across a beam, against closed forms. */
/* SPDX-License-Identifier: MIT */
#include "base/constants.h"
#include "check.h"
#include "exchange/lens_open.h"
#include "file/lens_file.h"
#include "trace/dispatch.h"
#include "trace/pupil/clear_cross.h"

static const double degree = RADIANS_PER_DEGREE;

/* A lens, and what its rims let through of a beam; looked for from a ray so much aside, mm. */
struct crossed {
    struct lens lens;
    struct system system;
    struct beam beam;
    struct clear_cross cross;
};

static void cross(struct crossed *crossed, double x, double y, double aside, struct arena *arena)
{
    struct error error;
    struct first_order first;
    struct system_options options = system_options_default();
    const struct field_point field = {FIELD_ANGLE, {x * degree, y * degree}};
    struct conjugate_object object = lens_object(&crossed->lens);
    double wavelength = lens_primary_wavelength(&crossed->lens);
    options.clip = true;
    CHECK(system_compile(&crossed->lens, wavelength, &options, arena, &crossed->system, &error));
    CHECK(first_order_of_lens(&crossed->lens, wavelength, SECTION_Y, arena, &first, &error));
    CHECK(beam_of_field(&field, &object, &first, &crossed->beam, &error));
    struct clear_guess guess = clear_guess_of(&crossed->system, &crossed->beam, &first);
    guess.centre[0] += aside;
    clear_across(&crossed->system, &crossed->beam, &guess, lens_is_round(&crossed->lens), arena,
                 &crossed->cross);
    CHECK(!crossed->cross.is_empty);
}

static void cross_text(struct crossed *crossed, const char *text, double t, double aside,
                       struct arena *arena)
{
    struct error error;
    CHECK(lens_read("test", text_of(text), NULL, arena, &crossed->lens, &error));
    cross(crossed, 0, t, aside, arena);
}

/* In order: towards +a, +b, -a, -b. */
static void check_ends(const struct clear_cross *cross, const double ends[4], const char *what)
{
    for (size_t i = 0; i < 4; i++) {
        CHECK_NEAR(cross->ends[i].at[i % 2], ends[i], 1e-14 * fabs(ends[i]) + 4e-15, what);
        CHECK_NEAR(cross->ends[i].at[1 - i % 2], i == 1 || i == 3 ? 0 : cross->centre[1], 0, what);
    }
}

/* Two holes in air, seen aside: the nearer rim on each side. */
static void test_holes(struct arena *arena)
{
    static struct crossed crossed;
    for (int t = 0; t <= 22; t += 2) {
        double d = 20 * tan(t * degree), high = fmin(5, 4 - d), low = fmax(-5, -4 - d);
        double y = (high + low) / 2;
        double x = fmin(sqrt(25 - y * y), sqrt(16 - (y + d) * (y + d)));
        cross_text(&crossed,
                   "lens two\nobject inf\naperture stop\nsurface - 20 air 10\nstop - 10 air 8\n"
                   "surface - 10 air -\n",
                   t, t % 4 == 0 ? 0 : 0.5, arena);
        const struct clear_cross *cross = &crossed.cross;
        const double c = cos(t * degree), ends[4] = {x, high * c, -x, low * c};
        check_ends(cross, ends, "two holes");
        CHECK_NEAR(cross->centre[1], y * c, 4e-15, "two holes: the middle");
        CHECK(cross->ends[1].status == RAY_CLIPPED && cross->ends[1].surface == 2);
        CHECK(cross->ends[3].status == RAY_CLIPPED && cross->ends[3].surface == (d < 1 ? 2 : 1));
    }
}

/* A hole beside the axis: no edge mirrors another. */
static void test_beside(struct arena *arena)
{
    static const struct {
        const char *decenter;
        double ends[4];
    } holes[] = {{"1,-2", {4, 1, -2, -5}}, {"1,0", {4, 3, -2, -3}}, {"0,-2", {3, 1, -3, -5}}};
    static struct crossed crossed;
    char text[200];
    for (size_t k = 0; k < sizeof holes / sizeof holes[0]; k++) {
        snprintf(text, sizeof text,
                 "lens hole\nobject inf\naperture stop\nsurface - 20 air -\n"
                 "stop - 10 air 6 decenter=%s\nsurface - 10 air -\n",
                 holes[k].decenter);
        cross_text(&crossed, text, 0, 0, arena);
        const struct clear_cross *cross = &crossed.cross;
        const double *ends = holes[k].ends;
        for (size_t i = 0; i < 4; i++) {
            CHECK_NEAR(cross->ends[i].at[i % 2], ends[i], 4e-15, "a hole beside the axis");
        }
        CHECK_NEAR(cross->centre[0], (ends[0] + ends[2]) / 2, 4e-15, "its middle");
        CHECK_NEAR(cross->centre[1], (ends[1] + ends[3]) / 2, 4e-15, "its middle");
    }
}

/*
 * Edges that no rim makes. A ball of glass is missed beyond its radius. Behind a sphere a plane
 * reflects all where i - i' = C, sin C = 1/n: tan i' = sin C/(n - cos C), height n R sin i'.
 */
static void test_lost(struct arena *arena)
{
    static struct crossed crossed;
    const double n = 1.5, within = atan(1 / n / (n - sqrt(1 - 1 / (n * n))));
    const double ball[4] = {10, 10, -10, -10}, h = n * 10 * sin(within), plane[4] = {h, h, -h, -h};
    cross_text(&crossed,
               "lens ball\nobject inf\naperture stop\nstop - 5 air -\nsurface 10 20 1.5 -\n"
               "surface -10 10 air -\n",
               0, 0, arena);
    check_ends(&crossed.cross, ball, "ball");
    CHECK(crossed.cross.ends[0].status == RAY_MISS && crossed.cross.ends[0].surface == 2);
    cross_text(&crossed,
               "lens dome\nobject inf\naperture stop\nstop - 5 air -\nsurface 10 12 1.5 -\n"
               "surface - 10 air -\n",
               0, 0, arena);
    check_ends(&crossed.cross, plane, "dome");
    CHECK(crossed.cross.ends[3].status == RAY_TOTAL_REFLECTION);
    CHECK(crossed.cross.ends[3].surface == 3);
}

static enum ray_status fate(const struct crossed *crossed, const double at[2], struct arena *arena)
{
    const struct rays rays = rays_new(arena, 1);
    const struct ray start = beam_ray(&crossed->beam, at[0], at[1]);
    rays_set(&rays, 0, crossed->beam.n, &start);
    rays_trace(&crossed->system, &rays, NULL);
    return ray_block_status(rays.blocks, 0);
}

/* Each edge is the last ray that passes: a step of rounding outwards it is lost. */
static void test_last(const char *name, struct arena *arena)
{
    static struct crossed crossed;
    struct lensdb db = {.arena = arena};
    struct error error;
    for (int t = 0; t < 3; t++) {
        CHECK(lens_open(&db, text_of(name), arena, &crossed.lens, &error));
        cross(&crossed, t == 2 ? 3 : 0, 5 * t, 0, arena);
        for (size_t i = 0; i < 4; i++) {
            const struct clear_edge *edge = &crossed.cross.ends[i];
            double out[2] = {edge->at[0], edge->at[1]};
            out[i % 2] += (i < 2 ? 1e-13 : -1e-13) * fabs(crossed.cross.ends[i % 2].at[i % 2]);
            CHECK(fate(&crossed, edge->at, arena) == RAY_OK);
            CHECK(fate(&crossed, out, arena) == edge->status);
        }
    }
}

int main(void)
{
    struct arena arena = {0};
    test_holes(&arena);
    test_beside(&arena);
    test_lost(&arena);
    test_last("double-gauss", &arena);
    test_last("angenieux-dgauss-100", &arena);
    test_last("laikin75-petzval", &arena);
    arena_free(&arena);
    return check_report();
}
