/* tests/unit/test_merit_rays.c - spots of a lens with variables, against 113 bits. */
/* SPDX-License-Identifier: MIT */
#include "merit_truth.h"

#include "base/constants.h"
#include "check.h"
#include "design/merit.h"
#include "design/merit_rays.h"
#include "file/lens_file.h"

enum { MOST_VARIABLES = 40 };

struct under_test {
    struct arena arena;
    struct lens lens;
    struct variable list[MOST_VARIABLES];
    size_t count;
    struct variables variables;
    struct operand operand;
    struct merit_question question;
    struct merit merit;
    double v[MOST_VARIABLES];
    const char *text;
    double worst;
};

static struct operand operand_of(enum operand_kind kind)
{
    return (struct operand){.kind = kind,
                            .deviation = 1,
                            .wavelength = NAN,
                            .position = LENS_NONE,
                            .first = LENS_NONE,
                            .last = LENS_NONE,
                            .frequency = NAN,
                            .name = "spot"};
}

static void add_variable(struct under_test *test, const char *name)
{
    struct error error;
    struct variable *variable = &test->list[test->count++];
    *variable =
        (struct variable){.position = LENS_NONE, .low = -INFINITY, .high = INFINITY, .name = name};
    CHECK(parameter_read(text_of(name), NULL, &variable->what, &error));
}

/* Names one behind the other, with blanks between. */
static void add_variables(struct under_test *test, const char *names)
{
    while (*names != '\0') {
        const size_t length = strcspn(names, " ");
        add_variable(test, arena_string(&test->arena, names, length));
        names += length + strspn(names + length, " ");
    }
}

static bool open_test(struct under_test *test, const char *text, const char *names,
                      const struct merit_question *question, enum operand_kind kind)
{
    struct error error = {0};
    *test = (struct under_test){.text = text, .question = *question};
    test->operand = operand_of(kind);
    bool done = lens_read("test", text_of(text), NULL, &test->arena, &test->lens, &error);
    if (done) {
        add_variables(test, names);
        test->question.lens = &test->lens;
        test->question.variables = &test->variables;
        test->question.variable_count = test->count;
        test->question.operands = &test->operand;
        test->question.operand_count = 1;
        done = variables_open(&test->lens, test->list, test->count, &test->arena, &test->variables,
                              &error) &&
               merit_open(&test->question, &test->arena, &test->merit, &error);
        variables_get(&test->variables, test->v);
    }
    CHECK(done);
    if (!done) {
        printf("%s\n%s\n", text, error.message);
    }
    return done;
}

/* -------- in 113 bits -------- */

/* All residuals of the only slot, for these numbers. */
struct truth {
    struct under_test *test;
    struct truth_first first;
    const struct system *systems; /* one a wavelength */
    real piston;                  /* the mean path of the first rays, wavelengths; of spots 0 */
};

static bool open_truth(struct under_test *test, const double *v, struct truth *truth)
{
    const struct merit_rays_look look = merit_rays_look(&test->merit.slots[0]);
    const struct bundle_wish *wish = &look.bundle->wish;
    const struct lens *lens = variables_put(&test->variables, v, 0);
    struct system *systems = ARENA_ARRAY(&test->arena, wish->wavelength_count, struct system);
    struct system primary;
    struct system_options options = system_options_default();
    struct error error;
    options.stop_radius = 1;
    *truth = (struct truth){.test = test, .systems = systems};
    bool done = system_compile(lens, lens_primary_wavelength(lens), &options, &test->arena,
                               &primary, &error);
    for (size_t i = 0; i < wish->wavelength_count && done; i++) {
        done = system_compile(lens, wish->wavelengths[i].wavelength, &options, &test->arena,
                              &systems[i], &error);
    }
    CHECK(done);
    truth->first = truth_first_of(&primary, test->question.fnumber);
    return done;
}

/* One ray; of the chief ray the point is null. */
static void trace_one(const struct truth *truth, const struct merit_bundle *bundle, size_t number,
                      const size_t *point, struct precise_ray *end)
{
    const struct bundle_group *group = &bundle->groups[number];
    const struct pupil_point middle = {0, 0, 1};
    const struct pupil_point *at = point != NULL ? &group->points.points[*point] : &middle;
    struct truth_question question = {.system = &truth->systems[point != NULL ? group->light : 0],
                                      .first = &truth->first,
                                      .field = &bundle->wish.fields[group->field].point,
                                      .from_entrance = point != NULL && bundle->wish.from_entrance,
                                      .x = (real)at->x,
                                      .y = (real)at->y};
    double start[2];
    merit_bundle_start(bundle, number, point != NULL ? *point : 0, start);
    question.begin[0] = start[0];
    question.begin[1] = start[1];
    CHECK(truth_end(&question, end));
}

/* Where the rays of a group meet the image plane; of waves the path of each. */
static void trace_group(const struct truth *truth, const struct merit_bundle *bundle, size_t number,
                        real (*at)[2])
{
    const struct bundle_group *group = &bundle->groups[number];
    const struct truth_first first =
        truth_first_of(&truth->systems[0], truth->test->question.fnumber);
    struct precise_ray chief, end;
    if (bundle->wish.path) {
        trace_one(truth, bundle, number, NULL, &chief);
    }
    for (size_t i = 0; i < group->points.count; i++) {
        trace_one(truth, bundle, number, &i, &end);
        at[i][0] = end.x[0];
        at[i][1] = end.x[1];
        if (bundle->wish.path) {
            const struct system *system = &truth->systems[group->light];
            at[i][0] = truth_path(&chief, &end, first.exit - truth->first.image,
                                  precise_of(system->n[system->lens->surface_count]));
        }
    }
}

static void find_truth(struct truth *truth, real *residuals)
{
    const struct merit_rays_look look = merit_rays_look(&truth->test->merit.slots[0]);
    const struct merit_bundle *bundle = look.bundle;
    static real at[64][256][2];
    for (size_t g = 0; g < bundle->group_count; g++) {
        trace_group(truth, bundle, g, at[g]);
    }
    for (size_t g = 0; g < bundle->group_count; g++) {
        const struct bundle_group *group = &bundle->groups[g];
        const bool is_wave = bundle->wish.path;
        const bool is_round = !is_wave && group->points.symmetry == SYMMETRY_ROUND;
        real mean[2] = {0, 0}, sum = 0;
        for (size_t h = 0; h < bundle->group_count; h++) {
            const struct bundle_group *other = &bundle->groups[h];
            const bool counts = look.is_joint ? other->field == group->field : h == g;
            for (size_t i = 0; i < other->points.count && counts; i++) {
                const real weight = (real)other->weight * (real)other->points.points[i].weight;
                sum += weight;
                const bool leans = is_wave || other->points.symmetry == SYMMETRY_NONE;
                mean[0] += leans ? weight * at[h][i][0] : 0;
                mean[1] += other->points.symmetry == SYMMETRY_ROUND ? 0 : weight * at[h][i][1];
            }
        }
        for (int k = is_round ? 1 : 0; k < (is_wave ? 1 : 2); k++) {
            for (size_t i = 0; i < group->points.count; i++) {
                const size_t row =
                    group->row + (is_round ? 0 : (size_t)k * group->points.count) + i;
                const real weight = (real)group->weight * (real)group->points.points[i].weight;
                const double wavelength = bundle->lights[group->light].wavelength;
                const real unit = is_wave ? (real)wavelength / 1000 : 1;
                truth->piston = is_wave ? mean[0] / sum / unit : 0;
                residuals[row] = precise_root(weight) * (at[g][i][k] - mean[k] / sum) / unit;
            }
        }
    }
}

/*
 * One column against differences whose error is of fourth order. The variables' own numbers have 53
 * bits, and so steps must not be small.
 */
static void check_column(struct under_test *test, size_t j, const double *jacobian)
{
    enum { SIDES = 4 };
    static const int steps[SIDES] = {-2, -1, 1, 2}, factors[SIDES] = {1, -8, 8, -1};
    const size_t rows = test->merit.residual_count, n = test->count;
    real *slopes = arena_array(&test->arena, rows, sizeof(real));
    real *side = arena_array(&test->arena, rows, sizeof(real));
    double moved[MOST_VARIABLES], scale = 0;
    real piston = 0;
    memcpy(moved, test->v, sizeof moved);
    const double h = ldexp(1, ilogb(test->variables.scale[j]) - 13);
    for (int k = 0; k < SIDES; k++) {
        struct truth truth;
        moved[j] = test->v[j] + steps[k] * h;
        CHECK(open_truth(test, moved, &truth));
        find_truth(&truth, side);
        piston += factors[k] * truth.piston / (12 * (real)h);
        for (size_t i = 0; i < rows; i++) {
            slopes[i] += factors[k] * side[i] / (12 * (real)h);
        }
    }
    for (size_t i = 0; i < rows; i++) {
        scale = fmax(scale, fabs((double)slopes[i]));
    }
    /* of long paths small differences are left, with the rounding of those */
    scale = fmax(scale, 1e-3 * fabs((double)piston));
    for (size_t i = 0; i < rows; i++) {
        const double off = fabs(jacobian[i * n + j] - (double)slopes[i]) / scale;
        test->worst = fmax(test->worst, off);
        if (!(off <= 1e-9)) {
            printf("%s\nresidual %zu by %s: %.15g, expected %.15g\n", test->text, i,
                   test->list[j].name, jacobian[i * n + j], (double)slopes[i]);
        }
        CHECK(off <= 1e-9);
    }
}

/* Every derivative, and the residuals themselves. */
static void check_all(struct under_test *test)
{
    const size_t rows = test->merit.residual_count, n = test->count;
    double *residuals = ARENA_ARRAY(&test->arena, rows, double);
    double *jacobian = ARENA_ARRAY(&test->arena, rows * n, double);
    real *expected = arena_array(&test->arena, rows, sizeof(real));
    const bool done = merit_evaluate(&test->merit, test->v, residuals, jacobian);
    CHECK(done);
    if (!done) {
        printf("%s\n%s\n", test->text, test->merit.why.message);
        return;
    }
    struct truth truth;
    if (open_truth(test, test->v, &truth)) {
        const bool is_wave = test->operand.kind == OPERAND_OPD;
        find_truth(&truth, expected);
        for (size_t i = 0; i < rows; i++) {
            CHECK_NEAR(residuals[i], (double)expected[i], is_wave ? 1e-9 : 1e-12, "a residual");
        }
    }
    for (size_t j = 0; j < n; j++) {
        check_column(test, j, jacobian);
    }
}

static void check_lens(const char *text, const char *names, const struct merit_question *question,
                       enum operand_kind kind)
{
    static struct under_test test;
    if (open_test(&test, text, names, question, kind)) {
        check_all(&test);
        printf("%s: worst error %.2g of scale\n", names, test.worst);
    }
    arena_free(&test.arena);
}

/* Every kind of variable, aim, aperture, image plane and field. */
static void check_derivatives(void)
{
    static const struct merit_question stop = {.fnumber = NAN, .pattern = PATTERN_GAUSS, .rays = 3};
    struct merit_question entrance = stop, fast = stop;
    entrance.from_entrance = true;
    fast.fnumber = 6;
    static const char *const round = "wavelength d F\nfield angle 0 9\naperture epd 8\n"
                                     "focus paraxial\nsurface 50 6 1.6/55 -\nsurface -80 3 air -\n"
                                     "surface -40 2 1.7/30 -\nstop - 5 air 8\n"
                                     "surface 70 4 1.5 - k=-1 A4=1e-6\nsurface -35 40 air -\n";
    static const char *const all_round = "R1 c2 t1 t4 n1 V1 n5 k5 A4_5 A6_6 R6";
    check_lens(round, all_round, &stop, OPERAND_SPOT);
    check_lens(round, all_round, &entrance, OPERAND_POLY);
    check_lens(round, all_round, &fast, OPERAND_POLY);
    check_lens(round, all_round, &fast, OPERAND_OPD);
    static const char *const table = "wavelength e\nfield image 0 5,3\naperture stop\n"
                                     "focus table\nsurface 50 6 1.6 -\nsurface -80 3 air -\n"
                                     "surface -40 2 1.7 -\nstop - 5 air 7\n"
                                     "surface 70 4 1.5 -\nsurface -35 40 air -\n";
    check_lens(table, "R1 t3 t6 decenter_x2 decenter_y1 tilt_x3 tilt_y5 decenter_y4", &stop,
               OPERAND_SPOT);
    check_lens(table, "R1 t2 R5", &entrance, OPERAND_SPOT);
    check_lens(table, "R1 t2 R5 tilt_y3", &entrance, OPERAND_OPD);
    static const char *const near = "wavelength e C\nobject 150\nfield height 0 6\n"
                                    "aperture na 0.02\nfocus paraxial\nmedium 1.1\n"
                                    "surface 40 6 1.6 -\nsurface - 3 1.2 -\nstop - 2 1.2 -\n"
                                    "surface -60 5 1.8 - k=2 A4=1e-5\nsurface 90 60 1.1 -\n";
    check_lens(near, "R1 t2 n4 A4_4", &stop, OPERAND_SPOT);
    check_lens(near, "R1 t2 n4 A4_4", &entrance, OPERAND_POLY);
    check_lens(near, "R1 t2 n4 A4_4", &stop, OPERAND_OPD);
    static const char *const near_image = "object 150\nfield image 0 4\naperture na 0.02\n"
                                          "focus paraxial\nsurface 40 6 1.6 -\nsurface - 3 1 -\n"
                                          "stop - 2 1 -\nsurface -60 5 1.8 -\nsurface -90 0 1 -\n";
    check_lens(near_image, "R1 t2 n4", &stop, OPERAND_SPOT);
    check_lens(near_image, "R1 t2 n4", &entrance, OPERAND_SPOT);
    check_lens(near_image, "R1 t2 n4", &entrance, OPERAND_OPD);
    static const char *const mirrors = "field angle 0 0.5\naperture f/12\nfocus paraxial\n"
                                       "stop - 0 air -\n"
                                       "surface -160 -50 mirror - k=-1\n"
                                       "surface -100 60 mirror - A4=1e-7\n"
                                       "surface 90 3 1.5 -\nsurface 400 10 air -\n";
    check_lens(mirrors, "R2 t2 k2 R3 A4_3 t3 n4", &stop, OPERAND_SPOT);
    check_lens(mirrors, "R2 t2 k2 R3 A4_3 t3 n4", &stop, OPERAND_OPD);
    check_lens(mirrors, "R2 t2 tilt_x3 bend_tilt_y3 bend_decenter_x4", &stop, OPERAND_SPOT);
    /* light goes through one glass twice */
    static const char *const mangin = "field angle 0 1\naperture f/8\nfocus paraxial\n"
                                      "stop - 10 air -\n"
                                      "surface -150 8 1.52 -\n"
                                      "surface -200 -8 mirror -\n"
                                      "surface -150 -60 air -\n";
    check_lens(mangin, "R2 n2 t2", &stop, OPERAND_SPOT);
}

/*
 * The sum of squares of nine spots of the lecture's double Gauss and of what its focal length is
 * off from 100 mm, by a program of its own: 127 rays in rings, and Gauss's 36.
 */
static void check_starts(void)
{
    static const char *const text =
        "wavelength d F C\nfield angle 0 10 14\naperture epd 50\nfocus table\n"
        "surface 58.950 7.520 1.670/47.1 50.4\nsurface 169.660 0.240 air 50.4\n"
        "surface 38.550 8.050 1.670/47.1 46.0\nsurface 81.540 6.550 1.699/30.1 46.0\n"
        "surface 25.500 11.410 air 36.0\nstop - 9.000 air 34.2\n"
        "surface -28.990 2.360 1.603/38.0 34.0\nsurface 81.540 12.130 1.658/57.3 40.0\n"
        "surface -40.770 0.380 air 40.0\nsurface 874.130 6.440 1.717/48.0 40.0\n"
        "surface -79.460 72.228 air 40.0\n";
    static const struct {
        enum pattern pattern;
        size_t rays;
        double sum;
    } cases[] = {{PATTERN_HEXAPOLAR, 127, 1.56763}, {PATTERN_GAUSS, 36, 1.00147}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        static struct under_test test;
        const struct merit_question question = {.fnumber = NAN,
                                                .from_entrance = true,
                                                .pattern = cases[i].pattern,
                                                .rays = cases[i].rays};
        if (open_test(&test, text, "R1", &question, OPERAND_SPOT)) {
            double *residuals = ARENA_ARRAY(&test.arena, test.merit.residual_count, double);
            struct truth truth;
            CHECK(merit_evaluate(&test.merit, test.v, residuals, NULL) &&
                  open_truth(&test, test.v, &truth));
            const double off = (double)(1 / truth.first.power) - 100;
            double sum = off * off;
            for (size_t k = 0; k < test.merit.residual_count; k++) {
                sum += residuals[k] * residuals[k];
            }
            CHECK_NEAR(sum, cases[i].sum, 6e-6, "nine spots");
        }
        arena_free(&test.arena);
    }
}

int main(void)
{
    if (sizeof(real) == sizeof(double)) {
        printf("spots: skipped, no number has more than 53 bits\n");
        return check_report();
    }
    check_starts();
    check_derivatives();
    return check_report();
}
