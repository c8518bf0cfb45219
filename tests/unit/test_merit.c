/* tests/unit/test_merit.c - operands of paraxial rays and of shapes, by everything. */
/* SPDX-License-Identifier: MIT */
#include "analysis/rays/chromatic.h"
#include "double_gauss.h"
#include "merit_check.h"
#include "optics/seidel.h"
#include "trace/aim/aim.h"
#include "trace/dispatch.h"

static const char double_gauss[] = "wavelength d F C\n"
                                   "object inf\n"
                                   "aperture stop\n"
                                   "field angle 0 10 14\n" DOUBLE_GAUSS("34.2");

static const char relay[] = "wavelength d F C\n"
                            "object 120\n"
                            "aperture na 0.08\n"
                            "field height 0 8\n"
                            "surface 60 6 1.6/50 30 k=-0.5 A2=1e-4 A4=2e-6\n"
                            "surface -80 20 air 30 k=0.7\n"
                            "stop - 15 air 12\n"
                            "surface 90 5 1.65 30\n"
                            "surface -50 100 1.33 30 A4=-1e-6\n";

static const char mirrors[] = "wavelength d F\n"
                              "object inf\n"
                              "aperture f/4\n"
                              "field image 5\n"
                              "surface -400 -120 mirror 100 k=-1 stop\n"
                              "surface -220 140 mirror 50 k=-3\n"
                              "surface 90 8 1.52/64 40\n"
                              "surface -300 60 air 40\n";

/* Without diameters: as large as the light. */
static const char bare[] = "wavelength d\n"
                           "object inf\n"
                           "aperture epd 20\n"
                           "field angle 0 8\n"
                           "surface 60 6 1.6/50 - k=-0.5 A4=2e-6 A6=1e-9\n"
                           "surface -80 3 1.7/30 -\n"
                           "surface 200 8 air - A3=1e-6\n"
                           "stop - 5 air -\n"
                           "surface -40 5 1.65 - k=2 A4=-1e-6\n"
                           "surface -50 100 air -\n";

static const char zoom[] = "wavelength d F\n"
                           "object inf\n"
                           "aperture f/5\n"
                           "field angle 0 6\n"
                           "position wide tele\n"
                           "let gap 20 6\n"
                           "surface 60 4 1.6/50 30\n"
                           "surface -900 gap air 30\n"
                           "stop - 2 air 20\n"
                           "surface -70 2 1.7/35 -\n"
                           "surface 90 12 air -\n"
                           "surface 50 5 1.62/60 30\n"
                           "surface -40 50 air 30\n";

static const char ideal[] = "wavelength d F\n"
                            "object 300\n"
                            "aperture f/5\n"
                            "field angle 3\n"
                            "stop - 5 air 20\n"
                            "thick 80 10 air 30 hiatus=2\n"
                            "surface 90 5 1.62/40 30\n"
                            "surface -400 50 air 30\n";

static const char telecentric[] = "wavelength d F\n"
                                  "object 80 telecentric\n"
                                  "aperture na 0.05\n"
                                  "field height 0 5\n"
                                  "surface 60 6 1.62/45 40\n"
                                  "surface -80 40 air -\n"
                                  "surface 50 5 1.65 30\n"
                                  "surface -70 100 air 30\n";

static const struct merit_case cases[] = {
    {"telecentric", telecentric, "R1 c2 t1 t2 n1 V1 n3 k3 A4_4",
     "efl=50,bfl=40,magnification=-0.5,S1,S2@3mm,S3,S4,S5@F,axial,edge=1", 1e-9},
    {"zoom", zoom, "R1 c2 t1 t3 n1 V4 k6 A4_7",
     "efl=80,efl@tele=70:2,bfl@wide@F=60,axial,S1,S3@tele,fnumber=4,length=30,edge=2,air=3", 1e-9},
    {"ideal", ideal, "f2 t1 t2 R3 n3",
     "efl=80,bfl=70,magnification=-0.5,fnumber=4,length=20,axial,petzval=-150,S1,S2,S3,S4,S5",
     1e-9},
    {"double Gauss", double_gauss, "R1 R2 c3 R5 c6 t1 t5 t6 t11 n1 n3 V3 V4 A2_2 A4_1 k7 A4_6 k1",
     "efl=100,efl@F>101,efl@C<90,bfl=70,bfl@C=71,ffl=-50,length=60,fnumber=3,fnumber@F=3,petzval=-"
     "450,"
     "axial,axial@F=0.1:0.01,S1,S2,S3,S4,S5,S1@F=0.1,S3@5deg=0.1,S5@C@10deg",
     1e-9},
    {"relay", relay, "R1 c2 t1 t2 t3 n1 V1 n4 n5 k1 k2 A2_1 A4_1 A4_5 R5 t5",
     "magnification=-1,efl=60,bfl=80,fnumber=4,length=40,axial,S1,S2,S3,S4,S5,S2@F,S3@4mm,"
     "S3@3deg,magnification@C=-1.2",
     1e-9},
    {"mirrors", mirrors, "R1 R2 c3 t1 t2 t3 n3 V3 k1 k2",
     "efl=500,bfl=60,fnumber=4,petzval=-200,length=20,axial,S1,S2,S3,S4,S5,S5@F,edge=1,center=2,"
     "air=10",
     1e-9},
    {"bare", bare, "R1 R2 c3 R5 t1 t2 t3 t4 t5 n1 V2 k1 k5 A2_1 A4_1 A6_1 A3_3 A4_5",
     "edge=1,center 1..2 = 2,air=1,edge 5 = 3:0.1", 1e-9},
    {"double Gauss, shape", double_gauss, "R1 R2 c3 R5 t1 t5 t6 t7 k7",
     "edge=1,center=2,air=1,air 5=1,edge 3..4 < 0.1", 1e-9},
};

/* With the fields of the lens, or that of the operand. */
static bool open_setup(const struct lens *lens, const struct operand *operand, struct arena *arena,
                       struct setup *setup)
{
    struct error error;
    const struct setup_question question = {.lens = lens,
                                            .wavelength = NAN,
                                            .wavelengths = WAVELENGTHS_ALL,
                                            .fnumber = NAN,
                                            .field_policy = FIELDS_ALL,
                                            .takes_telecentric = true,
                                            .fields = operand->field,
                                            .field_count = operand->field != NULL};
    return setup_open(&question, arena, setup, &error);
}

/* As lenscalc lens has it. */
static struct first_order first_at(const struct setup *setup, double wavelength)
{
    const struct setup one = setup_at_wavelength(setup, wavelength, setup->arena);
    struct setup_light light;
    struct error error;
    CHECK(setup_light(&one, 0, &light, &error));
    return light.first;
}

/* As lenscalc color has it. */
static double axial_of(const struct setup *setup, const struct operand *operand)
{
    struct chromatic_focus focus[2];
    struct error error;
    const double all[2] = {isnan(operand->wavelength) ? 0.4861327 : operand->wavelength,
                           !isnan(operand->wavelength) || setup->wavelength_count == 2 ? 0.5875618
                                                                                       : 0.6562725};
    for (int i = 0; i < 2; i++) {
        CHECK(chromatic_focus(setup, all[i], &focus[i], &error));
    }
    return focus[0].image - focus[1].image;
}

/* As lenscalc seidel has it. */
static double seidel_of(struct setup *setup, const struct operand *operand, double wavelength)
{
    struct setup_light light;
    struct seidel seidel;
    struct error error;
    const struct setup one = setup_at_wavelength(setup, wavelength, setup->arena);
    CHECK(setup_light(&one, 0, &light, &error));
    const struct field_point edge = setup_edge_in_object(setup);
    const struct seidel_question question = {.lens = setup->lens,
                                             .system = &light.system,
                                             .section = SECTION_Y,
                                             .object = &setup->object,
                                             .first = &light.first,
                                             .field_kind = edge.kind,
                                             .field = edge.value[1]};
    CHECK(seidel_compute(&question, setup->arena, &seidel, &error));
    return seidel.total.sum[operand->kind - OPERAND_S1];
}

/* -------- thicknesses -------- */

/* Where the ray of a field comes that goes through the stop there. */
static double height_at(const struct setup *setup, size_t surface, const struct field_point *field,
                        double pupil)
{
    struct error error;
    const struct system *system = setup_system(setup, 0, SETUP_OPEN, &error);
    struct beam beam;
    struct aim aim;
    CHECK(system != NULL && setup_beam(setup, field, &beam, &error) &&
          aim_open(system, &beam, setup->arena, &aim, &error));
    const struct ray start = aim_ray(&aim, 0, pupil);
    struct rays rays = rays_new(setup->arena, 1);
    rays_set(&rays, 0, system->index_first, &start);
    rays_trace_part(system, 0, system_place(system, surface) + 1, &rays, NULL);
    return hypot(rays.blocks->x[0], rays.blocks->y[0]);
}

/* Where the marginal and the chief ray of the edge come, paraxially. */
static double paraxial_reach_at(const struct setup *setup, size_t surface)
{
    struct setup_light light;
    struct error error;
    CHECK(setup_light(setup, 0, &light, &error));
    struct paraxial_ray *rays = ARENA_ARRAY(setup->arena, light.system.count, struct paraxial_ray);
    const struct first_order *first = &light.first;
    paraxial_follow(&light.system, pair_of(first->marginal_y), pair_of(first->marginal_v), rays);
    const double marginal = fabs(rays[surface].y);
    paraxial_follow(&light.system, pair_of(first->chief_y), pair_of(first->chief_v), rays);
    return marginal + fabs(rays[surface].y);
}

/* Where the marginal ray comes, and the upper and lower one of the edge; without a stop those of
   paraxial optics. */
static double reach_at(const struct setup *setup, size_t surface)
{
    static const struct field_point axis = {.kind = FIELD_NONE};
    const struct surface *at = &setup->lens->surfaces[surface];
    if (at->has_diameter) {
        return at->diameter.value.hi / 2;
    }
    if (setup->lens->stop == LENS_NONE) {
        return paraxial_reach_at(setup, surface);
    }
    const double wavelength = lens_primary_wavelength(setup->lens);
    struct setup *one = ARENA_NEW(setup->arena, struct setup);
    *one = setup_at_wavelength(setup, wavelength, setup->arena);
    const double upper = height_at(one, surface, &one->edge, 1);
    const double lower = height_at(one, surface, &one->edge, -1);
    return fmax(fmax(upper, lower), height_at(one, surface, &axis, 1));
}

/* What a surface adds to the thickness of an edge at r, `sign` times its sag: beyond its own
   semi-diameter that of its curve or, flat, that of its rim, whichever is less. */
static double end_of(const struct surface *surface, double own, double r, double sign)
{
    const double curve = sign * surface_sag(surface, r);
    return r > own ? fmin(curve, sign * surface_sag(surface, own)) : curve;
}

/* The figures of an operand, written out for the lenses of this test: left, right, at the edge? */
static double shape_of(const struct setup *setup, const struct operand *operand, size_t at)
{
    const struct lens *lens = setup->lens;
    const bool is_air = operand->kind == OPERAND_AIR;
    const size_t end = operand->first == LENS_NONE ? lens->surface_count : operand->last + 1;
    double direction = 1;
    size_t found = 0;
    for (size_t i = 0; i + 1 < lens->surface_count && i < end; i++) {
        const struct surface *left = &lens->surfaces[i], *right = left + 1;
        double gap = left->thickness.value.hi;
        direction *= left->kind == SURFACE_REFLECT ? -1 : 1;
        if (right->kind == SURFACE_STOP) {
            gap += right->thickness.value.hi;
            right++;
        }
        if (left->kind == SURFACE_STOP || medium_is_air(&left->medium) != is_air ||
            (operand->first != LENS_NONE && i < operand->first)) {
            continue;
        }
        const double a = reach_at(setup, i), b = reach_at(setup, (size_t)(right - lens->surfaces));
        const double r = is_air ? fmin(a, b) : fmax(a, b);
        const double edge =
            direction * gap + end_of(right, b, r, direction) + end_of(left, a, r, -direction);
        if (is_air && found++ == at) {
            return direction * gap;
        }
        if (found++ == at) {
            return operand->kind == OPERAND_CENTER ? direction * gap : edge;
        }
    }
    return NAN;
}

static double analyse(const struct lens *lens, const struct operand *operand, size_t at,
                      struct arena *arena)
{
    struct setup setup;
    CHECK(open_setup(lens, operand, arena, &setup));
    if (operand->kind >= OPERAND_EDGE && operand->kind <= OPERAND_AIR) {
        return shape_of(&setup, operand, at);
    }
    const double wavelength =
        isnan(operand->wavelength) ? lens_primary_wavelength(lens) : operand->wavelength;
    if (operand->kind >= OPERAND_S1 && operand->kind <= OPERAND_S5) {
        return seidel_of(&setup, operand, wavelength);
    }
    if (operand->kind == OPERAND_AXIAL) {
        return axial_of(&setup, operand);
    }
    const struct first_order first = first_at(&setup, wavelength);
    const double figures[OPERAND_KINDS] = {[OPERAND_EFL] = first.efl,
                                           [OPERAND_BFL] = first.bfl,
                                           [OPERAND_FFL] = first.ffl,
                                           [OPERAND_LENGTH] = first.length,
                                           [OPERAND_FNUMBER] = first.fnumber,
                                           [OPERAND_MAGNIFICATION] = first.magnification,
                                           [OPERAND_PETZVAL] = first.petzval_radius};
    return figures[operand->kind];
}

/* -------- the focal length through no power -------- */

static const char singlet[] = "wavelength d\n"
                              "object inf\n"
                              "surface 51.68 3 1.5168 20\n"
                              "surface - 100 air 20\n";

/* One residual of one lens with a curvature; its slope. */
static double residual_at(struct merit_bench *bench, double curvature, double *slope)
{
    double residual = NAN;
    CHECK(merit_evaluate(&bench->merit, &curvature, &residual, slope));
    return residual;
}

/*
 * A plano-convex lens has 1/f = 0.5168 c, whatever its thickness: f = 100 mm at c = 0.01934985.
 * Within a factor of 2 the residual is f - 100; beyond it goes on along its tangent in the power
 * P: (200 - 4e4 (P - 0.005)) - 100, and (50 - 2500 (P - 0.02)) - 100.
 */
static void test_power(void)
{
    static const struct {
        double power, residual, slope; /* by P */
    } all[] = {
        {0.01, 0, -1e4},    {0.008, 25, -15625}, {0.0125, -20, -6400},
        {0.005, 100, -4e4}, {0.004, 140, -4e4},  {0, 300, -4e4},
        {-0.01, 700, -4e4}, {0.02, -50, -2500},  {0.03, -75, -2500},
    };
    const struct merit_case of = {"singlet", singlet, "c1", "efl=100", 0};
    struct arena arena = {0};
    struct error error;
    struct merit_bench *bench = ARENA_NEW(&arena, struct merit_bench);
    CHECK(merit_bench_open(bench, &of, &arena, &error));
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++) {
        double slope;
        const double residual = residual_at(bench, all[i].power / 0.5168, &slope);
        CHECK_NEAR(residual, all[i].residual, 1e-10, "residual");
        CHECK_RELATIVE(slope, all[i].slope * 0.5168, 1e-12, "slope");
        if (all[i].power != 0) {
            CHECK_RELATIVE(bench->merit.values[0], 1 / all[i].power, 1e-12, "efl");
        }
    }
    arena_free(&arena);
}

/* -------- relations -------- */

/* What is met counts for nothing; constraints stand last. */
static void test_relations(void)
{
    const struct merit_case of = {"singlet", singlet, "c1 t1",
                                  "length==2,efl>90,efl<90:10,efl>110,length<5,center==4:2", 0};
    static const double expected[] = {0, 1, -10, 0, 1, -0.5};
    struct arena arena = {0};
    struct error error;
    struct merit_bench *bench = ARENA_NEW(&arena, struct merit_bench);
    double residuals[6], jacobian[12];
    const double v[2] = {0.01 / 0.5168, 3};
    CHECK(merit_bench_open(bench, &of, &arena, &error));
    CHECK(bench->merit.exact_count == 2 && bench->merit.residual_count == 6);
    CHECK(merit_evaluate(&bench->merit, v, residuals, jacobian));
    for (size_t i = 0; i < 6; i++) {
        CHECK_NEAR(residuals[i], expected[i], 1e-11, "residual");
        CHECK((jacobian[2 * i] == 0 && jacobian[2 * i + 1] == 0) == (expected[i] == 0));
    }
    CHECK_TEXT(bench->merit.slots[4].operand->name, "length == 2");
    arena_free(&arena);
}

/* -------- what cannot be had -------- */

static const char axis_only[] = "wavelength d\n"
                                "object inf\n"
                                "surface 50 3 1.5168 -\n"
                                "surface -50 10 air -\n"
                                "surface - - air 20\n";

static const char plate[] = "wavelength d\n"
                            "object inf\n"
                            "aperture f/4\n"
                            "surface - 3 1.5168 20\n"
                            "surface - 10 air 20\n";

static const char astray[] = "wavelength d\n"
                             "object inf\n"
                             "aperture na 0.1\n"
                             "surface 50 3 1.5168 20\n"
                             "surface - 10 air 20\n";

static void test_refused(void)
{
    static const struct {
        const char *text, *goals, *message;
    } all[] = {
        {astray, "length=2", "an object at infinity has no numerical aperture"},
        {singlet, "efl=0", "goal efl = 0: a finite length that is not 0 must be its target"},
        {singlet, "fnumber=2",
         "goal fnumber = 2: the lens has no aperture: state one, or give f-number"},
        {singlet, "magnification=-1",
         "goal magnification = -1: the object is infinitely far away, its magnification 0"},
        {singlet, "axial", "goal axial: there is only one wavelength, and so no colour"},
        {singlet, "S1", "goal S1: the lens has no aperture: state one, or give f-number"},
        {axis_only, "edge=1",
         "goal edge = 1: surfaces without a diameter are as large as the light: the lens has "
         "no aperture: state one, or give f-number"},
        {singlet, "center 2=1", "goal center 2 = 1: no glass lies behind these surfaces"},
        {singlet, "air=1", "goal air = 1: no air lies behind these surfaces"},
        {singlet, "distortion",
         "goal distortion: the lens states no field off its axis: say which, as in "
         "distortion@10deg"},
        {singlet, "distortion@0deg", "goal distortion@0deg: there is no distortion on the axis"},
        {singlet, "telecentric@3deg",
         "goal telecentric@3deg: the lens has no stop: it has no chief rays"},
        {double_gauss, "height@3mm=2",
         "goal height@3mm = 2: an object at infinity has no height: give an angle"},
        {double_gauss, "incidence 6=2", "goal incidence 6 = 2: none of these surfaces bends light"},
    };
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++) {
        const struct merit_case of = {"refused", all[i].text, "c1", all[i].goals, 0};
        struct arena arena = {0};
        struct error error = {.code = ERROR_NONE};
        struct merit_bench *bench = ARENA_NEW(&arena, struct merit_bench);
        CHECK(!merit_bench_open(bench, &of, &arena, &error));
        CHECK_TEXT(error.message, all[i].message);
        arena_free(&arena);
    }
}

/* A plate has no f-number, but may become a lens that has one: 1/f = 0.5168 c. */
static void test_plate(void)
{
    const struct merit_case of = {"plate", plate, "c1", "efl=100,fnumber=4,length=3", 0};
    struct arena arena = {0};
    struct error error;
    struct merit_bench *bench = ARENA_NEW(&arena, struct merit_bench);
    double residuals[3], curvature = 0.01 / 0.5168;
    CHECK(merit_bench_open(bench, &of, &arena, &error));
    CHECK(!merit_evaluate(&bench->merit, bench->v, residuals, NULL));
    CHECK_TEXT(bench->merit.why.message, "fnumber = 4 is not there");
    CHECK(merit_evaluate(&bench->merit, &curvature, residuals, NULL));
    for (size_t i = 0; i < 3; i++) {
        CHECK_NEAR(residuals[i], 0, 1e-11, "residual");
    }
    arena_free(&arena);
}

/* A lens that has no such number on its way says so. */
static void test_nothing(void)
{
    const struct merit_case of = {"singlet", singlet, "c1", "bfl=100", 0};
    struct arena arena = {0};
    struct error error;
    struct merit_bench *bench = ARENA_NEW(&arena, struct merit_bench);
    double residual, curvature = 0;
    CHECK(merit_bench_open(bench, &of, &arena, &error));
    CHECK(!merit_evaluate(&bench->merit, &curvature, &residual, NULL));
    CHECK_TEXT(bench->merit.why.message, "bfl = 100 is infinite");
    curvature = NAN;
    CHECK(!merit_evaluate(&bench->merit, &curvature, &residual, NULL));
    arena_free(&arena);
}

/* Of a zoom one position may be asked for, or all. */
static void test_position(void)
{
    static const struct merit_case of = {"zoom", zoom, "R1", "efl=80,bfl=60", 0};
    static const size_t tele[] = {1};
    struct arena arena = {0};
    struct merit_bench bench;
    struct merit merit;
    struct error error;
    CHECK(merit_bench_open(&bench, &of, &arena, &error) && bench.merit.place_count == 2);
    struct merit_question question = bench.merit.question;
    question.positions = tele;
    question.position_count = 1;
    CHECK(merit_open(&question, &arena, &merit, &error) && merit.place_count == 1 &&
          merit.places[0].position == 1);
    arena_free(&arena);
}

int main(void)
{
    test_position();
    test_power();
    test_relations();
    test_refused();
    test_nothing();
    test_plate();
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        merit_check(&cases[i], analyse);
    }
    merit_check_random("bfl=100,bfl@F=90,ffl=50,length=20,axial,S1,S2,S3@3deg,S4,S5@C,edge=1,air=1",
                       false, analyse);
    return check_report();
}
