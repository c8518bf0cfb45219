/* tests/unit/test_illumination.c - light in the image: closed forms, and values of 50 digits. */
/* SPDX-License-Identifier: MIT */
#include "analysis/rays/illumination.h"

#include "analysis/pupil/quadrature.h"
#include "base/constants.h"
#include "check.h"
#include "file/lens_file.h"
#include "optics/aperture.h"
#include "trace/aim/aim.h"

/* A lens both ways. */
struct opened {
    struct arena arena;
    struct lens lens;
    struct first_order first;
    struct conjugate_object object;
    struct system clipped, open, clipped_back, open_back;
};

static bool set_up(struct opened *opened, const char *text)
{
    struct error error;
    *opened = (struct opened){.arena = {0}};
    struct arena *arena = &opened->arena;
    struct system_options options = system_options_default();
    bool good = lens_read("test", text_of(text), NULL, arena, &opened->lens, &error);
    const double wavelength = good ? lens_primary_wavelength(&opened->lens) : 0;
    if (!good ||
        !first_order_of_lens(&opened->lens, wavelength, SECTION_Y, arena, &opened->first, &error)) {
        printf("%s\n", error.message);
        CHECK(false);
        return false;
    }
    const struct aperture_setting aperture = lens_aperture(&opened->lens);
    opened->object = lens_object(&opened->lens);
    CHECK(first_order_aperture(&opened->first, &opened->object, &aperture, FIELD_NONE, 0, &error));
    struct system *const systems[] = {&opened->open, &opened->clipped, &opened->open_back,
                                      &opened->clipped_back};
    for (int i = 0; i < 4; i++) {
        options.clip = i % 2 == 1;
        options.reverse = i >= 2;
        CHECK(system_compile(&opened->lens, wavelength, &options, arena, systems[i], &error));
    }
    return true;
}

static struct illumination film(struct opened *opened, double x, double y, double z, double error)
{
    const struct beam beam = beam_from_film((double[3]){x, y, z}, opened->open_back.index_first);
    const struct illumination_question question = {.clipped = &opened->clipped_back,
                                                   .open = &opened->open_back,
                                                   .beam = &beam,
                                                   .first = &opened->first,
                                                   .error = error};
    return illumination_of_film(&question, &opened->arena);
}

static struct illumination field(struct opened *opened, double value)
{
    const struct field_point point = {opened->object.is_infinite ? FIELD_ANGLE : FIELD_HEIGHT,
                                      {0, value}};
    struct beam beam;
    struct error error;
    struct aim aim;
    CHECK(beam_of_field(&point, &opened->object, &opened->first, &beam, &error));
    CHECK(aim_open(&opened->open, &beam, &opened->arena, &aim, &error));
    const struct illumination_question question = {.clipped = &opened->clipped,
                                                   .open = &opened->open,
                                                   .beam = &beam,
                                                   .first = &opened->first,
                                                   .inside = aim.chief,
                                                   .error = 1e-12};
    return illumination_of_field(&question, &opened->arena);
}

/* A disc of the radius tan(a), seen at the field angle t: exact, not cos^4. */
static double disc(double tan_a, double tan_t)
{
    double a2 = tan_a * tan_a, t2 = tan_t * tan_t;
    return PI / 2 * (1 - (1 + t2 - a2) / sqrt(t2 * t2 + 2 * t2 * (1 - a2) + (1 + a2) * (1 + a2)));
}

static void test_disc(void)
{
    static const double heights[] = {0, 1, 10, 50, 150};
    struct opened opened;
    if (!set_up(&opened, "lens disc\nwavelength d\nobject inf\naperture stop\nstop - 0 air 50\n")) {
        return;
    }
    for (size_t i = 0; i < sizeof heights / sizeof heights[0]; i++) {
        double h = heights[i], expected = disc(0.5, h / 50);
        struct illumination light = film(&opened, 0, h, 50, 1e-12);
        CHECK_RELATIVE(light.value, expected, 1e-13, "a disc");
        CHECK(light.is_met && light.error >= fabs(light.value - expected));
        /* and beside the y axis */
        light = film(&opened, 0.6 * h, -0.8 * h, 50, 1e-12);
        CHECK_RELATIVE(light.value, expected, 1e-13, "a disc, from beside");
    }
    arena_free(&opened.arena);
    /* within glass all the way to the film n^2 times as much comes into the same cone */
    if (set_up(&opened, "lens disc\nwavelength d\nobject inf\naperture stop\nsurface - 0 1.5 -\n"
                        "stop - 0 1.5 50\n")) {
        CHECK_RELATIVE(film(&opened, 0, 10, 50, 1e-12).value, 2.25 * disc(0.5, 0.2), 1e-13,
                       "a disc within glass");
        arena_free(&opened.arena);
    }
}

static void test_ring(void)
{
    static const double heights[] = {0, 5, 40};
    struct opened opened;
    if (!set_up(&opened, "lens ring\nwavelength d\nobject inf\naperture stop\nstop - 0 air 50\n"
                         "block circle 20\n")) {
        return;
    }
    for (size_t i = 0; i < sizeof heights / sizeof heights[0]; i++) {
        double h = heights[i], expected = disc(0.5, h / 50) - disc(0.2, h / 50);
        struct illumination light = film(&opened, 0, h, 50, 1e-10);
        CHECK_RELATIVE(light.value, expected, 1e-9, "a ring");
        CHECK(light.error >= fabs(light.value - expected) - 1e-14);
    }
    arena_free(&opened.arena);
}

/* On the axis only the marginal ray counts: pi n'^2 sin^2; a sphere refracting at its centre. */
static void test_axis(void)
{
    struct opened opened;
    /* from its focus in front of a paraboloid mirror: parallel light behind it, sin = known */
    if (!set_up(&opened, "lens paraboloid\nwavelength d\nobject inf\naperture stop\n"
                         "surface -200 -100 mirror 80 k=-1 stop\n")) {
        return;
    }
    /* h = 2 f tan(u/2), f = 100 */
    const double u = 2 * atan(40.0 / 200);
    struct illumination light = film(&opened, 0, 0, -100, 1e-12);
    CHECK_RELATIVE(light.value, PI * sin(u) * sin(u), 1e-13, "a mirror from its focus");
    light = field(&opened, 0);
    CHECK_RELATIVE(light.value, PI * sin(u) * sin(u), 1e-13, "a mirror towards its focus");
    arena_free(&opened.arena);
}

/* Relative to the axis, the stop alone limits: an independent program. */
static const struct {
    const char *text;
    double field, height, plane, at_point, of_field; /* rad or mm, mm, mm */
} known[] = {
    {"lens Smith's double Gauss\nwavelength d\nobject inf\naperture stop\n"
     "surface 58.95 7.52 1.67/47.1 -\nsurface 169.66 0.24 air -\n"
     "surface 38.55 8.05 1.67/47.1 -\nsurface 81.54 6.55 1.699/30.1 -\n"
     "surface 25.5 11.41 air -\nstop - 9 air 34.2\nsurface -28.99 2.36 1.603/38 -\n"
     "surface 81.54 12.13 1.658/57.3 -\nsurface -40.77 0.38 air -\n"
     "surface 874.13 6.44 1.717/48 -\nsurface -79.46 72.228 air -\n",
     14 * RADIANS_PER_DEGREE, 24.99567298304572989117, 72.21181047708427469653,
     0.915876739096261577027, 0.8682914830785470003942},
};

static void test_known(void)
{
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++) {
        struct opened opened;
        if (!set_up(&opened, known[i].text)) {
            return;
        }
        struct illumination axis = film(&opened, 0, 0, known[i].plane, 1e-12);
        struct illumination light = film(&opened, 0, known[i].height, known[i].plane, 1e-12);
        CHECK_RELATIVE(light.value / axis.value, known[i].at_point, 1e-12, "at the point");
        axis = field(&opened, 0);
        light = field(&opened, known[i].field);
        CHECK_RELATIVE(light.value / axis.value, known[i].of_field, 1e-12, "of the field");
        arena_free(&opened.arena);
    }
}

/* The other apertures go, the stop's stay; and the lens that was given keeps all. */
static void test_stop_only(void)
{
    struct opened opened;
    if (!set_up(&opened, "lens stop\nwavelength d\nobject inf\naperture stop\n"
                         "surface 50 5 1.5 10\nblock circle 2\nstop - 0 air 4\npass rectangle 3 3\n"
                         "block circle 1\n")) {
        return;
    }
    const struct lens *bare = illumination_stop_only(&opened.lens, &opened.arena);
    CHECK(!bare->surfaces[0].has_diameter && bare->surfaces[0].aperture_count == 0);
    CHECK(bare->surfaces[1].has_diameter && bare->surfaces[1].aperture_count == 1);
    CHECK(!bare->surfaces[1].apertures[0].blocks);
    CHECK(opened.lens.surfaces[1].aperture_count == 2);
    CHECK(opened.lens.surfaces[0].has_diameter && opened.lens.surfaces[0].aperture_count == 1);
    arena_free(&opened.arena);
}

/* -------- what a value may be off -------- */

/* Both sides of a beam, of which one value after the other is asked for, each twice the rays. */
struct convergence {
    struct opened *opened;
    struct beam beam;
    const double *inside; /* null: of the film */
    double (*pass)(const struct system *open, const struct ray *start, struct arena *arena);
};

static struct illumination asked(const struct convergence *of, double error)
{
    struct opened *opened = of->opened;
    const bool is_film = of->inside == NULL;
    const struct illumination_question question = {
        .clipped = is_film ? &opened->clipped_back : &opened->clipped,
        .open = is_film ? &opened->open_back : &opened->open,
        .beam = &of->beam,
        .first = &opened->first,
        .inside = of->inside,
        .pass = of->pass,
        .error = error};
    return is_film ? illumination_of_film(&question, &opened->arena)
                   : illumination_of_field(&question, &opened->arena);
}

/*
 * A value's error by its last change and those before it: where each change is at most a tenth of
 * the one before, twice the next, of which at least a share of the last is believed; else four
 * times as much, at least half the last, or twice the geometric series that goes on, which falls
 * by a tenth at least.
 */
static double error_by_changes(const double changes[3], double share)
{
    const double ratio = fmin(changes[2] / changes[1], 0.9);
    if (changes[1] <= changes[0] / 10 && changes[2] <= changes[1] / 10) {
        return 2 * fmax(changes[2], share * changes[1]);
    }
    return fmax(fmax(4 * changes[2], changes[1] / 2), 2 * changes[2] / (1 - ratio));
}

/* Result    how many errors were of each kind: believed, held up by the last change, slow */
static void check_errors_follow(const struct convergence *of, double share, size_t kinds[3])
{
    enum { MOST = 10 };
    struct illumination found[MOST];
    size_t count = 0;
    for (double error = (double)INFINITY; count < MOST; count++) {
        found[count] = asked(of, error);
        if (!found[count].is_met || found[count].error < 1e-13 * found[count].value) {
            break;
        }
        error = found[count].error / found[count].value * (1 - 1e-9);
    }
    for (size_t i = 2; i + 1 < count; i++) {
        const double changes[3] = {fabs(found[i - 1].value - found[i - 2].value),
                                   fabs(found[i].value - found[i - 1].value),
                                   fabs(found[i + 1].value - found[i].value)};
        const double expected = error_by_changes(changes, share);
        const bool is_slow = changes[1] > changes[0] / 10 || changes[2] > changes[1] / 10;
        CHECK_NEAR(found[i].error, expected, 1e-9 * expected + 1e-15 * found[i].value,
                   "by its changes");
        kinds[is_slow ? 2 : changes[2] < share * changes[1]]++;
    }
}

/* Rays of each sum end with this call; they have this share of their light. */
enum { SUMS = 11 };
static size_t call, ends[SUMS];
static double shares[SUMS];

static double pass_share(const struct system *open, const struct ray *start, struct arena *arena)
{
    (void)open;
    (void)start;
    (void)arena;
    size_t k = 0;
    for (; k + 1 < SUMS && call >= ends[k]; k++) {
    }
    call++;
    return shares[k];
}

/* Sums of 50, 100 .. 51200 rays of a disc, whose values are as they are here made to be. */
static void test_errors_of_values(void)
{
    static const double last[][4] = {{1, 1.1, 1.101, 1.1010001}, /* believed */
                                     {1, 1.1, 1.101, 1.10102},   /* a tenth and a tenth */
                                     {1, 1.1, 1.115, 1.1151},    /* the one before is too large */
                                     {1, 1.1, 1.104, 1.1044008}, /* the last is, by little */
                                     {1, 1.1, 1.14, 1.165},      /* slow */
                                     {1, 1.1, 1.19, 1.11},       /* grows again but little */
                                     {1, 1.1, 1.12, 1.2},        /* grows */
                                     {1, 1.1, 1.05, 1.0032},     /* hardly falls: 0.936 */
                                     {1, 1.1, 1.2, 1.2}};        /* by chance the same */
    struct opened opened;
    if (!set_up(&opened, "lens disc\nwavelength d\nobject inf\naperture stop\nstop - 0 air 50\n")) {
        return;
    }
    struct convergence of = {.opened = &opened, .pass = pass_share};
    of.beam = beam_from_film((double[3]){0, 10, 50}, opened.open_back.index_first);
    struct stop_beam disc_of = {.system = &opened.clipped_back,
                                .beam = &of.beam,
                                .axes = {25, 0, 0, 25},
                                .radius = opened.clipped_back.stop_radius,
                                .weight = WEIGHT_BEAM};
    struct quadrature_region region = quadrature_open(&disc_of, &opened.arena);
    region.in_r = region.in_beam = region.in_half = true;
    for (size_t k = 0; k < SUMS; k++) {
        ends[k] = (k > 0 ? ends[k - 1] : 0) +
                  quadrature_fill(&region, (size_t)50 << k, &opened.arena).sample.count;
    }
    for (size_t i = 0; i < sizeof last / sizeof *last; i++) {
        const double whole = disc(0.5, 0.2);
        for (size_t k = 0; k < SUMS; k++) {
            shares[k] = k < SUMS - 4 ? 0.5 - 0.01 * (double)k : last[i][k + 4 - SUMS];
        }
        call = 0;
        const struct illumination light = asked(&of, 0);
        const double changes[3] = {fabs(last[i][1] - last[i][0]), fabs(last[i][2] - last[i][1]),
                                   fabs(last[i][3] - last[i][2])};
        CHECK(!light.is_met && call == ends[SUMS - 1]);
        CHECK_RELATIVE(light.value, last[i][2] * whole, 1e-12, "the one before the last");
        CHECK_RELATIVE(light.error, error_by_changes(changes, 0.002) * whole, 1e-9, "its error");
    }
    arena_free(&opened.arena);
}

/* Discs nearer and nearer to the film, and beams that fill more and more of a lens. */
static void test_errors(void)
{
    static const double sizes[] = {39.2, 39.6, 40,   40.2, 40.4, 40.6,
                                   40.8, 41,   41.2, 41.4, 41.6, 41.8};
    size_t kinds[2][3] = {{0}};
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        char text[200];
        struct opened opened;
        snprintf(text, sizeof text,
                 "lens disc\nwavelength d\nobject inf\naperture stop\nstop - 0 air %g\n",
                 20 * pow(1.3, (double)i));
        if (!set_up(&opened, text)) {
            return;
        }
        struct convergence of = {.opened = &opened};
        of.beam = beam_from_film((double[3]){0, 10, 50}, opened.open_back.index_first);
        check_errors_follow(&of, 0.002, kinds[0]);
        arena_free(&opened.arena);
        snprintf(text, sizeof text,
                 "lens ball\nwavelength d\nobject inf\naperture stop\nstop - 1 air %g\n"
                 "surface 50 20 1.6 -\nsurface -50 30 air -\n",
                 sizes[i]);
        if (!set_up(&opened, text)) {
            return;
        }
        const struct field_point point = {FIELD_ANGLE, {0, 0.1}};
        struct error error;
        struct aim aim;
        of.opened = &opened;
        CHECK(beam_of_field(&point, &opened.object, &opened.first, &of.beam, &error));
        CHECK(aim_open(&opened.open, &of.beam, &opened.arena, &aim, &error));
        of.inside = aim.chief;
        check_errors_follow(&of, 0.05, kinds[1]);
        arena_free(&opened.arena);
    }
    CHECK(kinds[0][0] > 1 && kinds[0][1] > 1 && kinds[0][2] > 1 && kinds[1][1] > 8);
}

int main(void)
{
    test_disc();
    test_ring();
    test_axis();
    test_known();
    test_stop_only();
    test_errors();
    test_errors_of_values();
    return check_report();
}
