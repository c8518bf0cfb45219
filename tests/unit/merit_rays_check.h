/* tests/unit/merit_rays_check.h - residuals of rays and their derivatives against 113 bits. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_TESTS_UNIT_MERIT_RAYS_CHECK_H
#define LENSCALC_TESTS_UNIT_MERIT_RAYS_CHECK_H

#include "merit_truth.h"

#include "check.h"
#include "design/merit/merit.h"
#include "design/merit/merit_rays.h"
#include "file/lens_file.h"

enum { MOST_VARIABLES = 100 };

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

/* "t2@1" is that of the second position. */
static void add_variable(struct under_test *test, const char *name)
{
    struct error error;
    const char *at = strchr(name, '@');
    const size_t length = at != NULL ? (size_t)(at - name) : strlen(name);
    struct variable *variable = &test->list[test->count++];
    *variable = (struct variable){.position = at != NULL ? (size_t)(at[1] - '0') : LENS_NONE,
                                  .low = -INFINITY,
                                  .high = INFINITY,
                                  .name = name};
    if (length == 2 && strncmp(name, "n0", 2) == 0) { /* that of the object's medium */
        variable->what = (struct parameter){.surface = LENS_NONE, .kind = PARAMETER_INDEX};
        return;
    }
    CHECK(parameter_read((struct text){name, length}, NULL, &variable->what, &error));
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
                      const struct merit_question *question, enum operand_kind kind,
                      struct error *error)
{
    *test = (struct under_test){.text = text, .question = *question};
    test->operand = operand_of(kind, "spot");
    bool done = lens_read("test", text_of(text), NULL, &test->arena, &test->lens, error);
    if (done) {
        add_variables(test, names);
        test->question.lens = &test->lens;
        test->question.variables = &test->variables;
        test->question.variable_count = test->count;
        test->question.operands = &test->operand;
        test->question.operand_count = 1;
        done = variables_open(&test->lens, test->list, test->count, &test->arena, &test->variables,
                              error) &&
               merit_open(&test->question, &test->arena, &test->merit, error);
        variables_get(&test->variables, test->v);
    }
    return done;
}

/* -------- in 113 bits -------- */

/* All residuals of one slot, a position, for these numbers. */
struct truth {
    struct under_test *test;
    const struct merit_slot *slot;
    struct truth_first first;
    const struct system *systems; /* one a wavelength */
    real piston;                  /* the mean path of the first rays, wavelengths; of spots 0 */
};

static bool open_truth(struct under_test *test, const struct merit_slot *slot, const double *v,
                       struct truth *truth)
{
    const struct bundle_wish *wish = &slot->beams->bundle.wish;
    const struct lens *lens =
        variables_put(&test->variables, v, test->merit.places[slot->place].position);
    struct system *systems = ARENA_ARRAY(&test->arena, wish->wavelength_count, struct system);
    struct system primary;
    struct system_options options = system_options_default();
    struct error error;
    options.stop_radius = 1;
    *truth = (struct truth){.test = test, .slot = slot, .systems = systems};
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
    const struct merit_bundle *bundle = &truth->slot->beams->bundle;
    const bool is_joint = truth->slot->operand->kind == OPERAND_POLY;
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
            const bool counts = is_joint ? other->field == group->field : h == g;
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
static void check_column(struct under_test *test, const struct merit_slot *slot, size_t j,
                         const double *jacobian)
{
    enum { SIDES = 4 };
    static const int steps[SIDES] = {-2, -1, 1, 2}, factors[SIDES] = {1, -8, 8, -1};
    const size_t rows = slot->count, n = test->count;
    real *slopes = arena_array(&test->arena, rows, sizeof(real));
    real *side = arena_array(&test->arena, rows, sizeof(real));
    /* at least: what a variable does not change at all is rounding */
    const double least = test->operand.kind == OPERAND_OPD ? 1e-2 : 1e-5;
    double moved[MOST_VARIABLES], scale = least / test->variables.scale[j];
    real piston = 0;
    memcpy(moved, test->v, sizeof moved);
    const double h = ldexp(1, ilogb(test->variables.scale[j]) - 13);
    for (int k = 0; k < SIDES; k++) {
        struct truth truth;
        moved[j] = test->v[j] + steps[k] * h;
        CHECK(open_truth(test, slot, moved, &truth));
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

/* Every derivative of a slot, and its residuals themselves. */
static void check_slot(struct under_test *test, const struct merit_slot *slot,
                       const double *residuals, const double *jacobian)
{
    const double tolerance = test->operand.kind == OPERAND_OPD ? 1e-9 : 1e-12;
    real *expected = arena_array(&test->arena, slot->count, sizeof(real));
    struct truth truth;
    if (open_truth(test, slot, test->v, &truth)) {
        find_truth(&truth, expected);
        for (size_t i = 0; i < slot->count; i++) {
            CHECK_NEAR(residuals[i], (double)expected[i], tolerance * fmax(1, fabs(residuals[i])),
                       "a residual");
        }
    }
    for (size_t j = 0; j < test->count; j++) {
        check_column(test, slot, j, jacobian);
    }
}

/* All of it; false: the lens has no value here. */
static bool check_all(struct under_test *test)
{
    const size_t rows = test->merit.residual_count, n = test->count;
    double *residuals = ARENA_ARRAY(&test->arena, rows, double);
    double *jacobian = ARENA_ARRAY(&test->arena, rows * n, double);
    if (!merit_evaluate(&test->merit, test->v, residuals, jacobian)) {
        return false;
    }
    for (size_t k = 0; k < test->merit.slot_count; k++) {
        const struct merit_slot *slot = &test->merit.slots[k];
        check_slot(test, slot, residuals + slot->first, jacobian + slot->first * n);
    }
    return true;
}

#endif
