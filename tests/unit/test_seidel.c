/* tests/unit/test_seidel.c - Seidel and chromatic sums. */
/* SPDX-License-Identifier: MIT */
#include "check.h"
#include "double_gauss.h"
#include "file/lens_file.h"
#include "optics/seidel.h"
#include "optics/wavelength.h"

/* Of one surface, from 1; 0 is the sum: S1 .. S5, CI, CII, mm. */
struct expected {
    size_t surface;
    double sum[SEIDEL_TERMS];
};

enum { MOST_ROWS = 3 };

struct truth {
    const char *name, *text;
    double lagrange, slope;
    struct expected rows[MOST_ROWS]; /* the sum first */
};

/* By an independent program in 50-digit arithmetic: ../shared/reference/truth, golden.md. */
static const struct truth truths[] = {
    {"Cartesian ellipsoid k=-1/n^2",
     "object inf\n"
     "aperture epd 20\n"
     "field angle 2\n"
     "surface 20 0 1.5 - k=-0.4444444444444444444444444444444444444444 stop\n",
     0.34920769491747733,
     -0.25,
     {{0,
       {0.0, 0.019400427495415404, 0.0013549557132175323, 0.0020324335698262983,
        0.00023658048066398045, 0, 0}}}},
    {"Cooke triplet",
     "object inf\n"
     "aperture epd 10\n"
     "field angle 20\n"
     "surface 22.01359 3.25896 1.62041/60.32 19\n"
     "surface -435.76044 6.00755 air 18\n"
     "surface -22.21328 0.99998 1.62004/36.37 11\n"
     "surface 20.29192 2.2 air 10\n"
     "surface - 2.55041 air 10 stop\n"
     "surface 79.68360 2.95208 1.62041/60.32 15\n"
     "surface -18.39533 42.20778 air 16\n",
     1.8198511713310117,
     -0.09995736451743377,
     {{0,
       {0.007144071791981834, -0.003135467500652544, -0.007878254434858888, 0.02582761117800027,
        -0.0018327709421573737, 0.000800743796851638, -0.00012118200191134514}},
      {1,
       {0.013843195641760578, 0.006919906153402003, 0.0034591074496871646, 0.05760162641925537,
        0.03052290518500536, 0.007208446456507033, 0.0036033423410107867}},
      {3,
       {-0.051820307242697594, 0.0946725204451455, -0.17296088356750378, -0.05706279288597965,
        0.4202391373312187, -0.012897744676387655, 0.023563387821164378}}}},
    {"double Gauss",
     "object inf\n"
     "aperture stop\n"
     "field angle 14\n" DOUBLE_GAUSS("34.2"),
     6.184607128894919,
     -0.2462868076047645,
     {{0,
       {0.08386294723304945, -0.005523420125285414, -0.014540369908296151, 0.060614206722886844,
        0.052366441569342226, 0.007631629805450519, -0.0006766776548757355}},
      {1,
       {0.4439710641383018, 0.08504327775539083, 0.016290158696305474, 0.2603147372124064,
        0.052984054348050404, 0.08890695410699583, 0.017030251300683228}},
      {3,
       {0.10447452678177468, 0.02880649020022792, 0.00794273880167109, 0.39806883939484716,
        0.11194851901963697, 0.08411071539553504, 0.02319162932258732}}}},
    {"double Gauss at 1500 mm",
     "object 1500\n"
     "aperture stop\n"
     "field height 300\n" DOUBLE_GAUSS("16"),
     -2.260818273348002,
     -0.10817806942057737,
     {{0,
       {0.004905007214036282, 0.0021624921869509268, -0.0012911262937255876, 0.00809993440501534,
        -0.016008768444541993, 0.0016616250316484206, -2.205142612548656e-05}},
      {1,
       {0.022853361075567246, -0.007222034180943145, 0.002282280384852166, 0.03478610725236388,
        -0.011714214012687837, 0.019189597275680353, -0.006064225169559968}},
      {3,
       {0.0071491151979011, -0.0032346673859588474, 0.0014635479787565436, 0.05319431965050197,
        -0.02473033612024112, 0.018312902251944492, -0.008285801251881946}}}},
    {"retrofocus wide angle",
     "object inf\n"
     "aperture stop\n"
     "field angle 70\n"
     "surface 60 2.5 1.62041/60.3 -\n"
     "surface 18 14 air -\n"
     "surface 80 2 1.62041/60.3 -\n"
     "surface 14 12 air -\n"
     "surface 30 6 1.7552/27.6 -\n"
     "surface -80 5 air -\n"
     "surface - 2 air 2.4 stop\n"
     "surface -60 1.5 1.80518/25.4 -\n"
     "surface 18 5 1.62041/60.3 -\n"
     "surface -16 0.3 air -\n"
     "surface 40 4 1.62041/60.3 -\n"
     "surface -30 0 air -\n",
     1.4748401934227673,
     -0.06790478431081295,
     {{0,
       {0.001072465629546859, -0.0023711931623548854, 0.00387969378102371, 0.03825957654986412,
        7.364934135027736, 0.0007721350682874203, 0.010276176303317208}},
      {1,
       {9.08277468527604e-08, 1.9115523903275853e-05, 0.004023035545394081, 0.01388009868467759,
        3.7678771320098017, 3.0493479161857216e-05, 0.006417629524130494}},
      {3,
       {3.2267582120318804e-06, 0.00020702722788200215, 0.013282765632915972, 0.010410074013508193,
        1.5201209977128367, 9.618271684829491e-05, 0.006171036046336806}}}},
    {"Galilean telescope",
     "object inf\n"
     "aperture epd 20\n"
     "field angle 1\n"
     "surface 80 6 1.5 - stop\n"
     "surface -400 101.7453426970445207189186476171016693115234375 air -\n"
     "surface -30 2 1.6 -\n"
     "surface 40 0 air -\n",
     0.17455064928217587,
     9.999999990317754e-09,
     {{0,
       {0.005883685601161257, -0.001213152518648999, -0.0004814070557551829, -0.000514146304656492,
        -0.001989170852878483, 0.0, 0.0}},
      {1,
       {0.004340277777777778, 0.0006060786433408884, 8.463313656896989e-05, 0.00012694970485345483,
        2.954553787780151e-05, 0.0, 0.0}},
      {3,
       {-0.0028721676805515753, -0.0008606184877207513, -0.00025787637205934816,
        -0.0003808491145603645, -0.0001913881860329941, 0.0, 0.0}}}},
    {"concentric meniscus",
     "object inf\n"
     "aperture epd 5\n"
     "field angle 12\n"
     "surface - 30 air - stop\n"
     "surface -30 15 1.5 -\n"
     "surface -45 0 air -\n",
     0.5313914041750553,
     0.009259259259259259,
     {{0, {-0.00023814967230605092, 0.0, 0.0, -0.0010458400904856926, 0.0, 0.0, 0.0}},
      {1, {0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0}},
      {3, {8.335238530711782e-05, 0.0, 0.0, 0.0020916801809713853, 0.0, 0.0, 0.0}}}},
    {"Cassegrain-like",
     "object inf\n"
     "aperture epd 200\n"
     "field angle 0.2\n"
     "surface -1000 -375 mirror - k=-1 stop\n"
     "surface -300 0 mirror - k=-2.5\n",
     0.349067268159625,
     -0.03333333333333333,
     {{0,
       {0.015625, 0.0006242001496604406, 0.00018499312327954932, 0.0005686238026019767,
        -2.6998571212359044e-05, 0, 0}},
      {1, {0.0, -0.0069813453631925, 0.00024369591540084715, -0.00024369591540084715, 0.0, 0, 0}}}},
};

static bool solve_in(enum lens_section section, const char *text, struct arena *arena,
                     struct seidel *seidel, struct error *error)
{
    struct lens lens;
    struct paraxial_system system, blue, red;
    struct paraxial_trace trace;
    struct first_order first;
    struct lens_warnings warnings;
    *seidel = (struct seidel){0};
    if (!lens_read("test", text_of(text), NULL, arena, &lens, error) ||
        !lens_check(&lens, arena, &warnings, error) ||
        !paraxial_compile(&lens, WAVELENGTH_D, section, arena, &system, error) ||
        !paraxial_compile(&lens, 0.4861327, section, arena, &blue, error) ||
        !paraxial_compile(&lens, 0.6562725, section, arena, &red, error)) {
        return false;
    }
    const struct conjugate_object object = lens_object(&lens);
    const struct aperture_setting aperture = lens_aperture(&lens);
    const struct seidel_question question = {
        .lens = &lens,
        .system = &system,
        .blue_n = blue.index,
        .red_n = red.index,
        .section = section,
        .object = &object,
        .first = &first,
        .field_kind = lens.field_count > 0 ? lens.field_kind : FIELD_NONE,
        .field = lens.field_count > 0 ? lens.fields[0].at[1].value.hi : (double)NAN};
    paraxial_trace(&system, &trace);
    first_order_compute(&system, &trace, &object, &first);
    return first_order_aperture(&first, &object, &aperture, question.field_kind, question.field,
                                error) &&
           seidel_compute(&question, arena, seidel, error);
}

static bool solve(const char *text, struct arena *arena, struct seidel *seidel, struct error *error)
{
    return solve_in(SECTION_Y, text, arena, seidel, error);
}

static bool good(const char *text, struct arena *arena, struct seidel *seidel)
{
    struct error error;
    bool done = solve(text, arena, seidel, &error);
    if (!done) {
        printf("%s: %s\n", text, error.message);
    }
    return done;
}

/* Within a few roundings of the value itself, whatever was subtracted on the way. */
static void check_truth(void)
{
    for (size_t i = 0; i < sizeof truths / sizeof truths[0]; i++) {
        const struct truth *truth = &truths[i];
        struct arena arena = {0};
        struct seidel seidel;
        struct error error;
        if (!solve(truth->text, &arena, &seidel, &error)) {
            printf("%s: %s\n", truth->name, error.message);
            CHECK(false);
            continue;
        }
        CHECK_RELATIVE(seidel.lagrange, truth->lagrange, 1e-15, truth->name);
        CHECK_RELATIVE(seidel.slope, truth->slope, 1e-15, truth->name);
        for (size_t k = 0; k < MOST_ROWS && (k == 0 || truth->rows[k].surface > 0); k++) {
            const struct expected *row = &truth->rows[k];
            const struct seidel_part *part =
                row->surface == 0 ? &seidel.total : &seidel.parts[row->surface - 1];
            for (size_t term = 0; term < SEIDEL_TERMS; term++) {
                CHECK_NEAR(part->sum[term], row->sum[term], 4e-15 * fabs(row->sum[term]) + 1e-28,
                           truth->name);
            }
        }
        arena_free(&arena);
    }
}

/* A paraboloid of focal length 100 with the stop on it: S1 = 0, by -1/8 c^3 of the conic. */
static void check_asphere(void)
{
    static const char *const same[] = {
        "aperture epd 20\nfield angle 3\nsurface 50 3 1.5 -\nstop - 2 1.5 10\n"
        "surface -50 0 air - A4=1e-6\n",
        /* the vertex curvature 0.02 by A2, and what the sphere has of r^4: 0.02^3/8 */
        "aperture epd 20\nfield angle 3\nsurface - 3 1.5 - A2=0.01 A4=1e-6\nstop - 2 1.5 10\n"
        "surface 50 0 air - A2=-0.02\n",
    };
    struct arena arena = {0};
    struct seidel parabola, sphere, other;
    CHECK(good("aperture epd 50\nfield angle 1\nsurface -200 0 mirror - k=-1 stop\n", &arena,
               &parabola));
    CHECK(fabs(parabola.total.sum[SEIDEL_SPHERICAL]) < 1e-30);
    /* y^4 c^3 (n' - n) k of the conic: 25^4 (1/200)^3 2 */
    CHECK_RELATIVE(parabola.total.asphere[SEIDEL_SPHERICAL], -2 * 390625.0 / 8e6, 1e-15, "asphere");
    CHECK_NEAR(parabola.total.asphere[SEIDEL_COMA], 0, 1e-30, "the chief ray goes through 0");
    CHECK(good(same[0], &arena, &sphere));
    CHECK(good(same[1], &arena, &other));
    /* first surface: 1e-6 alone is all that r^4 has; of the sphere it is c^3/8 = 1e-6 */
    CHECK_RELATIVE(other.parts[0].sum[SEIDEL_SPHERICAL], sphere.parts[0].sum[SEIDEL_SPHERICAL],
                   4e-15, "a sphere by A2 and A4");
    CHECK_RELATIVE(other.parts[0].sum[SEIDEL_DISTORTION], sphere.parts[0].sum[SEIDEL_DISTORTION],
                   4e-15, "a sphere by A2 and A4");
    CHECK_RELATIVE(other.parts[0].sum[SEIDEL_PETZVAL], sphere.parts[0].sum[SEIDEL_PETZVAL], 4e-15,
                   "its Petzval term");
    CHECK(other.parts[0].asphere[SEIDEL_SPHERICAL] == 0);
    /* second: c = 0.02 - 0.04 = -0.02, r^4 of the conic 0.02^3/8 = 1e-6; the other -1e-6 + 1e-6 */
    CHECK_RELATIVE(other.parts[2].asphere[SEIDEL_COMA], 2 * sphere.parts[2].asphere[SEIDEL_COMA],
                   4e-15, "an asphere by A2");
    arena_free(&arena);
}

/* A cylinder with an asphere is the round one in its section, and a plane across it. */
static void check_cylinder(void)
{
    static const char round[] = "aperture epd 20\nfield angle 3\nsurface 50 3 1.5 - A4=1e-6 stop\n"
                                "surface - 90 air -\n";
    static const char cylinder[] = "aperture epd 20\nfield angle 3\n"
                                   "surface 50 3 1.5 - A4=1e-6 cyl=y stop\nsurface - 90 air -\n";
    struct arena arena = {0};
    struct seidel whole, curved, flat;
    struct error error;
    CHECK(good(round, &arena, &whole) && whole.parts[0].asphere[SEIDEL_SPHERICAL] != 0);
    CHECK(solve_in(SECTION_Y, cylinder, &arena, &curved, &error));
    CHECK(solve_in(SECTION_X, cylinder, &arena, &flat, &error));
    for (size_t term = 0; term < SEIDEL_TERMS; term++) {
        CHECK(curved.parts[0].sum[term] == whole.parts[0].sum[term]);
        CHECK(curved.parts[0].asphere[term] == whole.parts[0].asphere[term]);
        CHECK(flat.parts[0].asphere[term] == 0);
    }
    CHECK(flat.parts[0].sum[SEIDEL_SPHERICAL] == 0);
    arena_free(&arena);
}

/* It images every point: only the glass behind it, as through a plane, has colour. */
static void check_thick(void)
{
    struct arena arena = {0};
    struct seidel thick, plane;
    CHECK(good("object 200\naperture na 0.1\nfield height 10\nstop - 5 air -\n"
               "thick 60 4 1.5/40 -\nsurface - 0 air -\n",
               &arena, &thick));
    CHECK(good("object 200\naperture na 0.1\nfield height 10\nstop - 5 air -\n"
               "thick 60 0 air -\nsurface - 4 1.5/40 -\nsurface - 0 air -\n",
               &arena, &plane));
    for (size_t term = 0; term <= SEIDEL_DISTORTION; term++) {
        CHECK(thick.parts[1].sum[term] == 0 && thick.parts[1].asphere[term] == 0);
    }
    for (size_t term = SEIDEL_AXIAL_COLOR; term < SEIDEL_TERMS; term++) {
        CHECK(plane.total.sum[term] != 0);
        CHECK_RELATIVE(thick.total.sum[term], plane.total.sum[term], 1e-14, "colour");
    }
    CHECK(thick.distorting == LENS_NONE);
    arena_free(&arena);
}

static void check_forms(void)
{
    const struct seidel_part part = {{8, 2, 2, 2, 2, 2, 1}, {0}};
    double values[SEIDEL_TERMS];
    static const double waves[] = {1, 1, 1, 1, 1, 1, 1}, across[] = {4, 1, 1, 1, 1, 2, 1};
    seidel_convert(&part, SEIDEL_WAVES, 1000, values);
    for (size_t i = 0; i < SEIDEL_TERMS; i++) {
        CHECK_RELATIVE(values[i], 1000 * waves[i], 1e-15, "waves");
    }
    seidel_convert(&part, SEIDEL_TRANSVERSE, -5, values);
    for (size_t i = 0; i < SEIDEL_TERMS; i++) {
        CHECK_RELATIVE(values[i], -5 * across[i], 1e-15, "transverse");
    }
}

static void check_refused(void)
{
    static const struct {
        const char *text, *words;
    } cases[] = {
        {"aperture epd 5\nfield angle 3\nsurface 50 0 1.5 -\n",
         "the lens has no stop: it has no chief rays"},
        {"field angle 3\nsurface 50 0 1.5 - stop\n",
         "the lens has no aperture: the height of its marginal ray is not known"},
        {"aperture epd 5e-324\nfield angle 3\nsurface 50 0 1.5 - stop\n", /* 0 from the axis */
         "the lens has no aperture: the height of its marginal ray is not known"},
        {"aperture epd 5\nfield angle 3\nsurface 50 0 1.5 - stop A3=1e-5\n",
         "surface 1: A3 r^3 makes an aberration of lower order than the Seidel sums have"},
        /* the stop in the focus of what is before it, in the image of the object */
        {"object 50\naperture stop\nfield angle 3\nthick 50 100 air -\n"
         "stop - 50 air 5\n",
         NULL},
        {"object 100\naperture stop\nfield height 3\nthick 50 100 air -\n"
         "stop - 50 air 5\n",
         "no paraxial chief ray of the field reaches the stop"},
        /* in the focus: chief rays are parallel to the axis, none of them slopes */
        {"object 100\naperture stop\nfield angle 3\nthick 50 50 air -\n"
         "stop - 50 air 5\n",
         "no paraxial chief ray of the field reaches the stop"},
        /* there light of the axis from afar is a point: none of it is at the stop's edge */
        {"aperture stop\nthick 50 50 air -\nstop - 50 air 5\n",
         "no paraxial marginal ray of the field reaches the stop"},
        {"object 100\naperture stop\nthick 50 100 air -\nstop - 50 air 5\n",
         "no paraxial marginal ray of the field reaches the stop"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct arena arena = {0};
        struct seidel seidel;
        struct error error = {0};
        bool done = solve(cases[i].text, &arena, &seidel, &error);
        CHECK(done == (cases[i].words == NULL));
        if (!done && cases[i].words != NULL) {
            CHECK_TEXT(error.message, cases[i].words);
        }
        arena_free(&arena);
    }
}

/* Without a field what the marginal ray alone makes; fifth powers are beyond third order. */
static void check_partial(void)
{
    struct arena arena = {0};
    struct seidel seidel, odd, narrow;
    CHECK(good("aperture epd 5\nsurface 50 0 1.5/60 - stop\n", &arena, &seidel));
    CHECK(seidel.total.sum[SEIDEL_SPHERICAL] > 0 && seidel.total.sum[SEIDEL_AXIAL_COLOR] > 0);
    CHECK(isnan(seidel.total.sum[SEIDEL_COMA]) && isnan(seidel.total.sum[SEIDEL_PETZVAL]) &&
          isnan(seidel.total.sum[SEIDEL_LATERAL_COLOR]) && isnan(seidel.lagrange));
    CHECK(good("aperture epd 5\nsurface 50 0 1.5/60 - stop A5=1e-5\n", &arena, &odd));
    CHECK(odd.total.sum[SEIDEL_SPHERICAL] == seidel.total.sum[SEIDEL_SPHERICAL]);
    /* as the fourth power and the square of the aperture, small as it may be */
    CHECK(good("aperture epd 0.005\nsurface 50 0 1.5/60 - stop\n", &arena, &narrow));
    CHECK_RELATIVE(narrow.total.sum[SEIDEL_SPHERICAL] * 1e12, seidel.total.sum[SEIDEL_SPHERICAL],
                   4e-15, "of a thousandth of the aperture");
    CHECK_RELATIVE(narrow.total.sum[SEIDEL_AXIAL_COLOR] * 1e6, seidel.total.sum[SEIDEL_AXIAL_COLOR],
                   4e-15, "of a thousandth of the aperture");
    arena_free(&arena);
}

int main(void)
{
    check_truth();
    check_asphere();
    check_cylinder();
    check_thick();
    check_forms();
    check_refused();
    check_partial();
    return check_report();
}
