/* tests/unit/test_tolerance_trial.c - lenses as they may be made, adjusted and judged. */
/* SPDX-License-Identifier: MIT */
#include "any_errors.h"
#include "check.h"
#include "design/tolerance/tolerance_run.h"
#include "design/tolerance/tolerance_trial.h"
#include "double_gauss.h"
#include "lens_of.h"
#include "optics/lens_indices.h"
#include "trace/dispatch.h"

#include <math.h>
#include <string.h>

static const char double_gauss[] = "wavelength d F C\n"
                                   "object inf\n"
                                   "aperture stop\n"
                                   "field angle 0 10 14\n"
                                   "focus paraxial\n" DOUBLE_GAUSS("34.2");

static struct arena arena;

static size_t list_all(const struct lens *lens, struct perturbation *list)
{
    const struct spread spread = spread_of(DISTRIBUTION_UNIFORM, DISTRIBUTION_SIGMAS);
    const size_t count = sizeof any_errors / sizeof any_errors[0];
    CHECK(lens->surface_count == 11);
    for (size_t i = 0; i < count; i++) {
        list[i] = any_errors[i];
        list[i].spread = spread;
    }
    return count;
}

enum { MOST = 16 };

struct under_test {
    struct lens lens;
    struct perturbation list[MOST];
    struct tolerance_question question;
    struct tolerance tolerance;
    double figures[MOST], moves[MOST];
    struct tolerance_trial trial;
};

static bool open_test(struct under_test *test)
{
    struct error error = {.code = ERROR_NONE};
    test->question.view.lens = &test->lens;
    test->question.view.fnumber = NAN;
    test->question.view.pattern = PATTERN_GAUSS;
    test->question.view.rays = 12;
    test->question.perturbations = test->list;
    test->trial = (struct tolerance_trial){.figures = test->figures, .moves = test->moves};
    const bool done = tolerance_open(&test->question, &arena, &test->tolerance, &error);
    CHECK(done);
    if (!done) {
        printf("%s\n", error.message);
    }
    return done;
}

static bool try(struct under_test *test, const double *errors)
{
    const bool done = tolerance_trial(&test->tolerance, errors, &test->trial);
    CHECK(done);
    if (!done) {
        printf("%s\n", test->trial.why.message);
    }
    return done;
}

/* A trial is the same whatever came before it; without errors it is the nominal lens to the bit. */
static void check_trials(enum criterion_kind kind, enum tolerance_refocus refocus, bool aims)
{
    static struct under_test test;
    double errors[MOST] = {0}, first[MOST], moves[MOST];
    test = (struct under_test){.lens = lens_of(double_gauss, &arena)};
    test.question.perturbation_count = list_all(&test.lens, test.list);
    test.question.criterion = (struct criterion){.kind = kind, .frequency = NAN, .name = "it"};
    test.question.refocus = refocus;
    test.question.aims = aims;
    if (!open_test(&test)) {
        return;
    }
    const size_t bytes = test.tolerance.figure_count * sizeof(double);
    for (size_t i = 0; i < test.question.perturbation_count; i++) {
        errors[i] = i % 2 == 0 ? 0.7 : -0.4;
    }
    if (!try(&test, errors)) {
        return;
    }
    memcpy(first, test.figures, bytes);
    memcpy(moves, test.moves, sizeof moves[0]);
    CHECK(memcmp(first, test.tolerance.nominal, bytes) != 0);
    for (size_t i = 0; i < test.question.perturbation_count; i++) {
        double other[MOST] = {0};
        other[i] = 1;
        try(&test, other);
    }
    try(&test, errors);
    CHECK(memcmp(first, test.figures, bytes) == 0 && moves[0] == test.moves[0]);
    memset(errors, 0, sizeof errors);
    try(&test, errors);
    CHECK(memcmp(test.tolerance.nominal, test.figures, bytes) == 0);
    CHECK(test.tolerance.nominal_moves[0] == test.moves[0]);
    arena_free(&arena);
}

/* A plane plate whose second surface is tilted by a deviates light by (n - 1) a. */
static void check_wedge(void)
{
    static const char plate[] = "wavelength d\nobject inf\naperture epd 4\nfield angle 0\n"
                                "focus table\nstop - 0 air -\nsurface - 5 1.5 20\n"
                                "surface - 1000 air 20\n";
    static struct under_test test;
    const double wedge = 1e-5;
    const double errors[] = {1};
    test = (struct under_test){.lens = lens_of(plate, &arena)};
    test.question.perturbation_count = 1;
    test.list[0] = (struct perturbation){.kind = TOLERANCE_WEDGE,
                                         .what = {2, PARAMETER_TILT_X, 0},
                                         .axis = PERTURBATION_X,
                                         .amount = wedge,
                                         .name = "wedge"};
    test.question.criterion =
        (struct criterion){.kind = CRITERION_BORESIGHT, .frequency = NAN, .name = "boresight"};
    test.question.refocus = REFOCUS_NONE;
    if (open_test(&test) && try(&test, errors)) {
        CHECK_NEAR(test.figures[0], 0.5 * wedge * 1000, 1e-9 * test.figures[0], "derived");
    }
    arena_free(&arena);
}

/* What has moved is written by what it is now, not by what was typed; the rest as it was typed. */
static void check_typed(void)
{
    static const char text[] = "wavelength d\nobject inf\naperture epd 4\nfield angle 0\n"
                               "focus table\nstop - 1 air -\n"
                               "surface 50 5 1.5 20 decenter=0.25,0.50 tilt=1.0,2.00\n"
                               "surface -50 2 air 20 decenter=0.250,0.5 tilt=1.50,2.0\n"
                               "surface 60 3 1.6 20 decenter=0.10,0.20\n"
                               "surface -60 50 air 20\n";
    static struct under_test test;
    const double errors[] = {1};
    test = (struct under_test){.lens = lens_of(text, &arena)};
    test.question.perturbation_count = 1;
    test.list[0] = (struct perturbation){.kind = TOLERANCE_ELEMENT_DECENTER,
                                         .first = 1,
                                         .last = 2,
                                         .what.kind = PARAMETER_KINDS,
                                         .axis = PERTURBATION_X,
                                         .amount = 0.125,
                                         .name = "decentre"};
    if (!open_test(&test) || !try(&test, errors)) {
        return;
    }
    const struct lens *made = tolerance_lens(&test.tolerance, &test.trial, &arena);
    for (size_t i = 1; i < 4; i++) {
        const struct displacement *at = made->surfaces[i].decentre;
        const struct displacement *was = test.lens.surfaces[i].decentre;
        for (int k = 0; k < 2; k++) {
            CHECK((at->decenter[k].typed.length == 0) == (i < 3));
            CHECK((at->tilt[k].typed.length == 0) == (i < 3 || was->tilt[k].typed.length == 0));
        }
        CHECK_NEAR(at->decenter[0].value.hi, was->decenter[0].value.hi + (i < 3 ? 0.125 : 0), 1e-15,
                   "x");
        CHECK_NEAR(at->decenter[1].value.hi, was->decenter[1].value.hi, 1e-15, "y");
    }
    CHECK(test.lens.surfaces[1].decentre->decenter[0].typed.length == 4);
    arena_free(&arena);
}

/* Rays that miss a lens far off its axis: no figures, and why; the next lens is as it was. */
static void check_lost(enum tolerance_refocus refocus)
{
    static struct under_test test;
    const double errors[] = {1}, none[] = {0};
    test = (struct under_test){.lens = lens_of(double_gauss, &arena)};
    test.question.perturbation_count = 1;
    test.question.refocus = refocus;
    test.list[0] = (struct perturbation){.kind = TOLERANCE_ELEMENT_DECENTER,
                                         .first = 2,
                                         .last = 4,
                                         .what.kind = PARAMETER_KINDS,
                                         .axis = PERTURBATION_Y,
                                         .amount = 300,
                                         .name = "decentre"};
    if (open_test(&test)) {
        CHECK(!tolerance_trial(&test.tolerance, errors, &test.trial));
        CHECK(test.trial.why.code == ERROR_DOMAIN && test.trial.why.message[0] != '\0');
        try(&test, none);
        CHECK(memcmp(test.figures, test.tolerance.nominal,
                     test.tolerance.figure_count * sizeof(double)) == 0);
    }
    arena_free(&arena);
}

/* An element that turns about the centre of one of its surfaces leaves that one where it was. */
static void check_pivot(void)
{
    static struct under_test test;
    const double errors[] = {1};
    test = (struct under_test){.lens = lens_of(double_gauss, &arena)};
    test.question.perturbation_count = 1;
    const double radius = test.lens.surfaces[2].radius.value.hi;
    test.list[0] = (struct perturbation){.kind = TOLERANCE_ELEMENT_TILT,
                                         .first = 2,
                                         .last = 4,
                                         .what.kind = PARAMETER_KINDS,
                                         .axis = PERTURBATION_Y,
                                         .amount = 0.02,
                                         .pivot = radius,
                                         .name = "tilt"};
    if (!open_test(&test) || !try(&test, errors)) {
        return;
    }
    const struct lens *made = &test.tolerance.perturbed.lenses[0].lens;
    const struct surface *surface = &made->surfaces[2];
    const double x = surface->decentre->decenter[0].value.hi,
                 tilt = surface->decentre->tilt[1].value.hi;
    /* its centre: the vertex and the radius along its axis, from where the vertex was */
    const double z =
        made->surfaces[1].thickness.value.hi - test.lens.surfaces[1].thickness.value.hi;
    CHECK_NEAR(x + radius * sin(tilt), 0, 1e-13, "derived");
    CHECK_NEAR(z + radius * cos(tilt), radius, 1e-13, "derived");
    CHECK_NEAR(tilt, 0.02, 1e-15, "as asked");
    arena_free(&arena);
}

/* A turn by Ry(b), then by Rx(a). */
static void turn_by(double a, double b, double v[3])
{
    const double x = v[0] * cos(b) + v[2] * sin(b), z = v[2] * cos(b) - v[0] * sin(b);
    const double y = v[1] * cos(a) - z * sin(a), along = v[1] * sin(a) + z * cos(a);
    memcpy(v, (const double[]){x, y, along}, 3 * sizeof *v);
}

/*
 * One motion after the other: what is off the axis and tilted turns with what it is part of, its
 * vertex about the pivot and its normal.
 */
static void check_turned(void)
{
    static struct under_test test;
    const double pivot = 7, errors[] = {1, 1, 1, 1, 1, 1};
    static const double amounts[6] = {0.4, -0.3, 0.02, -0.04, 0.03, 0.05};
    test = (struct under_test){.lens = lens_of(double_gauss, &arena)};
    test.question.perturbation_count = 6;
    for (int i = 0; i < 6; i++) {
        test.list[i] = (struct perturbation){.kind = i < 2 ? TOLERANCE_ELEMENT_DECENTER
                                                           : TOLERANCE_ELEMENT_TILT,
                                             .axis = i % 2 == 0 ? PERTURBATION_X : PERTURBATION_Y,
                                             .first = i < 4 ? 2 : 1,
                                             .last = 4,
                                             .what.kind = PARAMETER_KINDS,
                                             .amount = amounts[i],
                                             .pivot = i < 4 ? 0 : pivot,
                                             .name = "motion"};
    }
    if (!open_test(&test) || !try(&test, errors)) {
        return;
    }
    const struct lens *lens = &test.lens, *made = &test.tolerance.perturbed.lenses[0].lens;
    const struct displacement *at = made->surfaces[2].decentre;
    const double from = lens->surfaces[1].thickness.value.hi - pivot;
    double vertex[3] = {amounts[0], amounts[1], 0}, normal[3] = {0, 0, 1}, moved = 0;
    turn_by(amounts[2], amounts[3], vertex);
    turn_by(amounts[2], amounts[3], normal);
    vertex[2] += from;
    turn_by(amounts[4], amounts[5], vertex);
    turn_by(amounts[4], amounts[5], normal);
    for (int i = 0; i < 2; i++) {
        moved += made->surfaces[i].thickness.value.hi - lens->surfaces[i].thickness.value.hi;
    }
    CHECK_NEAR(at->decenter[0].value.hi, vertex[0], 1e-13, "x");
    CHECK_NEAR(at->decenter[1].value.hi, vertex[1], 1e-13, "y");
    CHECK_NEAR(moved, vertex[2] - from, 1e-13, "along the axis");
    CHECK_NEAR(sin(at->tilt[1].value.hi), normal[0], 1e-14, "normal, x");
    CHECK_NEAR(tan(at->tilt[0].value.hi), -normal[1] / normal[2], 1e-14, "normal, y");
    arena_free(&arena);
}

/* What small errors change first, against what they change. */
static void check_links(void)
{
    static struct under_test test;
    const double small = 1e-4;
    test = (struct under_test){.lens = lens_of(double_gauss, &arena)};
    test.question.perturbation_count = list_all(&test.lens, test.list);
    if (!open_test(&test)) {
        return;
    }
    const struct lens *made = &test.tolerance.perturbed.lenses[0].lens;
    for (size_t i = 0; i < test.question.perturbation_count; i++) {
        double errors[MOST] = {0};
        struct perturbed_link links[2 * 11];
        const size_t count = perturbed_links(&test.tolerance.perturbed, i, links);
        errors[i] = small;
        try(&test, errors);
        for (size_t k = 0; k < count; k++) {
            const bool is_medium =
                links[k].what.kind == PARAMETER_INDEX || links[k].what.kind == PARAMETER_ABBE;
            const double was = parameter_get(test.tolerance.lens, links[k].what);
            const double by = is_medium ? made->surfaces[links[k].what.surface].medium.index.hi +
                                              made->surfaces[links[k].what.surface].medium.abbe.hi
                                        : parameter_get(made, links[k].what) - was;
            CHECK_NEAR(by, links[k].slope * small, 1e-12, test.list[i].name);
        }
        CHECK(count > 0);
    }
    const struct lens *written = tolerance_lens(&test.tolerance, &test.trial, &arena);
    CHECK_NEAR(written->surfaces[10].thickness.value.hi,
               test.tolerance.lens->surfaces[10].thickness.value.hi + 0.1 * small + test.moves[0],
               1e-12, "focus and refocus");
    arena_free(&arena);
}

static bool same_tally(const struct trial_statistics *one, const struct trial_statistics *other)
{
    const struct trial_statistics_moments a = trial_statistics_moments(one);
    const struct trial_statistics_moments b = trial_statistics_moments(other);
    return one->count == other->count && a.mean == b.mean && a.sd == b.sd &&
           one->lowest == other->lowest && one->highest == other->highest;
}

/* Counts as lines of text: all is read back and added, and nothing that is cut short. */
static void check_lines(void)
{
    static struct under_test test;
    struct tolerance_result made, read;
    struct error error = {.code = ERROR_NONE};
    test = (struct under_test){.lens = lens_of(double_gauss, &arena)};
    test.question.perturbation_count = list_all(&test.lens, test.list);
    test.question.refocus = REFOCUS_PARAXIAL;
    if (!open_test(&test)) {
        return;
    }
    const struct tolerance_run run = {.question = &test.question,
                                      .of = TOLERANCE_OF_EACH,
                                      .limit = 0.03,
                                      .seed = 7,
                                      .end = 20,
                                      .total = 20,
                                      .threads = 1,
                                      .ready = &test.tolerance};
    tolerance_result_open(&run, &test.tolerance, 3, &arena, &made);
    tolerance_result_open(&run, &test.tolerance, 3, &arena, &read);
    CHECK(tolerance_run(&run, &made, &error));
    CHECK(made.done == 20 && made.failed == 0 && made.worst_count == 3);
    made.failed = 9;
    made.reasons[0] = (struct tolerance_reason){5, 12, "no ray, of three"};
    made.reasons[1] = (struct tolerance_reason){2, 4, "none at all"};
    made.reason_count = 2;
    made.others = (struct tolerance_reason){.count = 2, .first = 17};
    const struct text lines = tolerance_result_write(&made, &arena);
    CHECK(strncmp(lines.start, "20 9 3 2 2 17\n", 14) == 0);
    for (size_t i = 0; i < lines.length; i++) {
        struct tolerance_result cut;
        tolerance_result_open(&run, &test.tolerance, 3, &arena, &cut);
        if (lines.start[i] == '\n' && i + 1 < lines.length) {
            CHECK(!tolerance_result_read((struct text){lines.start, i + 1}, &cut));
        }
    }
    for (uint64_t times = 1; times < 3; times++) {
        CHECK(tolerance_result_read(lines, &read));
        CHECK(read.done == 20 * times && read.failed == 9 * times && read.reason_count == 2);
        CHECK(read.reasons[0].count == 5 * times && read.reasons[0].first == 12);
        CHECK_TEXT(read.reasons[0].why, "no ray, of three");
        CHECK(read.reasons[1].count == 2 * times && read.reasons[1].first == 4);
        CHECK_TEXT(read.reasons[1].why, "none at all");
        CHECK(read.others.count == 2 * times && read.others.first == 17);
        for (size_t i = 0; i < made.column_count; i++) {
            CHECK(read.columns[i].passed == made.columns[i].passed * times);
        }
        for (size_t i = 0; i < 3 && times == 1; i++) {
            CHECK(read.worst[i].trial == made.worst[i].trial &&
                  read.worst[i].badness == made.worst[i].badness);
            CHECK(i == 0 || made.worst[i].badness <= made.worst[i - 1].badness);
        }
        for (size_t i = 0; i < made.column_count && times == 1; i++) {
            CHECK(same_tally(&read.columns[i].tally, &made.columns[i].tally));
            CHECK(same_tally(&read.columns[i].badness, &made.columns[i].badness));
        }
        CHECK(times > 1 || same_tally(&read.moves[0], &made.moves[0]));
    }
    /* where nothing was without room the first of those stays */
    made.others.count = 0;
    made.others.first = 0;
    CHECK(tolerance_result_read(tolerance_result_write(&made, &arena), &read));
    CHECK(read.others.count == 4 && read.others.first == 17);
    arena_free(&arena);
}

/* Figures and movements that are quadratic in errors, each in its own way. */
static size_t sloped_figures, sloped_errors;

static bool sloped(void *context, const double *p, double *figures, struct error *why)
{
    (void)context;
    (void)why;
    for (size_t f = 0; f < sloped_figures; f++) {
        figures[f] = 0.02 + 0.002 * (double)f + 1e-3 * p[0] * p[1];
        for (size_t i = 0; i < sloped_errors; i++) {
            figures[f] += 1e-3 * ((double)((i * 7 + f * 3) % 5) - 2) * p[i];
        }
    }
    return true;
}

/* Runs of lenses to second order, counted one by one; in parts and by two threads the same. */
static void check_second_order(enum tolerance_of of)
{
    enum { TRIALS = 75, CUT = 41, WORST = 4 };
    static const bool none[MOST] = {false};
    static const char *names[MOST] = {"error"};
    static struct under_test test;
    struct error error = {.code = ERROR_NONE};
    test = (struct under_test){.lens = lens_of(double_gauss, &arena)};
    test.question.perturbation_count = list_all(&test.lens, test.list);
    test.question.refocus = REFOCUS_PARAXIAL;
    if (!open_test(&test)) {
        return;
    }
    const size_t figures = test.tolerance.figure_count, moves = tolerance_moves(&test.tolerance);
    sloped_figures = figures + moves;
    sloped_errors = test.question.perturbation_count;
    const struct second_order_problem problem = {.trial = sloped,
                                                 .error_count = sloped_errors,
                                                 .figure_count = sloped_figures,
                                                 .judged_count = figures,
                                                 .is_root = none,
                                                 .names = names};
    struct second_order differential;
    CHECK(second_order_open(&problem, &arena, &differential, &error));
    struct tolerance_run run = {.question = &test.question,
                                .of = of,
                                .limit = 0.023,
                                .seed = 11,
                                .end = TRIALS,
                                .total = TRIALS,
                                .threads = 2,
                                .differential = &differential};
    struct tolerance_result whole, parts;
    tolerance_result_open(&run, &test.tolerance, WORST, &arena, &whole);
    tolerance_result_open(&run, &test.tolerance, WORST, &arena, &parts);
    CHECK(tolerance_run(&run, &whole, &error));
    run.end = CUT;
    CHECK(tolerance_run(&run, &parts, &error));
    run.begin = CUT;
    run.end = TRIALS;
    CHECK(tolerance_run(&run, &parts, &error));
    /* each by itself, as the functions have it */
    const size_t columns = of == TOLERANCE_OF_EACH ? figures : 1;
    double sums[MOST] = {0}, moved = 0, judged[TRIALS];
    uint64_t passed[MOST] = {0};
    for (uint64_t trial = 0; trial < TRIALS; trial++) {
        double errors[MOST], at[MOST], worst = -INFINITY;
        tolerance_errors(&test.question, 11, trial, errors);
        sloped(NULL, errors, at, &error);
        for (size_t f = 0; f < figures; f++) {
            worst = fmax(worst, at[f]);
        }
        judged[trial] = worst;
        for (size_t c = 0; c < columns; c++) {
            const double figure = of == TOLERANCE_OF_EACH ? at[c] : worst;
            sums[c] += figure / TRIALS;
            passed[c] += figure <= run.limit;
        }
        moved += at[figures] / TRIALS;
    }
    CHECK(whole.done == TRIALS && whole.failed == 0 && whole.column_count == columns);
    CHECK(parts.done == TRIALS && parts.worst_count == WORST && whole.worst_count == WORST);
    for (size_t c = 0; c < columns; c++) {
        CHECK_RELATIVE(trial_statistics_moments(&whole.columns[c].tally).mean, sums[c], 1e-12,
                       "the mean of a figure");
        CHECK(whole.columns[c].passed == passed[c] && passed[c] > 0 && passed[c] < TRIALS);
        CHECK(parts.columns[c].passed == passed[c]);
        CHECK(same_tally(&parts.columns[c].tally, &whole.columns[c].tally));
    }
    CHECK(moves == 1);
    CHECK_RELATIVE(trial_statistics_moments(&whole.moves[0]).mean, moved, 1e-12, "of a movement");
    CHECK(same_tally(&parts.moves[0], &whole.moves[0]));
    for (size_t k = 0; k < WORST; k++) {
        size_t worse = 0;
        for (size_t trial = 0; trial < TRIALS; trial++) {
            worse += judged[trial] > judged[whole.worst[k].trial];
        }
        CHECK(worse == k);
        CHECK_RELATIVE(whole.worst[k].badness, judged[whole.worst[k].trial], 1e-12, "how bad");
        CHECK(parts.worst[k].trial == whole.worst[k].trial);
    }
    arena_free(&arena);
}

/* Errors of even spread have the second moment 1/3, and none goes with another. */
static void check_independence(void)
{
    enum { TRIALS = 4000, COUNT = 5 };
    struct perturbation list[COUNT];
    double sums[COUNT][COUNT] = {{0}};
    for (int i = 0; i < COUNT; i++) {
        list[i] = (struct perturbation){.kind = TOLERANCE_RADIUS,
                                        .spread = spread_of(DISTRIBUTION_UNIFORM, 2)};
    }
    const struct tolerance_question question = {.perturbations = list, .perturbation_count = COUNT};
    for (uint64_t trial = 0; trial < TRIALS; trial++) {
        double errors[COUNT];
        tolerance_errors(&question, 1, trial, errors);
        for (int i = 0; i < COUNT * COUNT; i++) {
            sums[i / COUNT][i % COUNT] += errors[i / COUNT] * errors[i % COUNT] / TRIALS;
        }
    }
    for (int i = 0; i < COUNT * COUNT; i++) { /* within four deviations of 1/3 and of 0 */
        const bool is_same = i / COUNT == i % COUNT;
        CHECK_NEAR(sums[i / COUNT][i % COUNT], is_same ? 1.0 / 3 : 0,
                   4 * (is_same ? sqrt(4.0 / 45) : 1.0 / 3) / sqrt(TRIALS), "a moment");
    }
}

static void check_criteria(void)
{
    struct criterion criterion;
    struct error error = {.code = ERROR_NONE};
    CHECK(criterion_read(text_of("efl"), &arena, &criterion, &error));
    CHECK(!criterion_read(text_of("mtf"), &arena, &criterion, &error));
    CHECK(!criterion_read(text_of("sport"), &arena, &criterion, &error));
    CHECK_TEXT(error.hint, "did you mean 'spot'?");
    CHECK(criterion_badness(CRITERION_EFL, 99, 100) == 1);
    CHECK(criterion_badness(CRITERION_DISTORTION, -2, 1) == 2);
    CHECK(criterion_passes(CRITERION_MTF, -0.5, 0.4));
    CHECK(!criterion_passes(CRITERION_MTF, -0.3, 0.4));
    CHECK(!criterion_passes(CRITERION_SPOT, 0.03, 0.02));
    arena_free(&arena);
}

/* A system at another wavelength is the one that is compiled for it, to the bit. */
static void check_recolour(void)
{
    const struct lens lens = lens_of(double_gauss, &arena);
    struct pair d[12], F[12];
    struct error error = {.code = ERROR_NONE};
    struct system first, other, compiled;
    struct system_options options = system_options_default();
    options.image = 72;
    options.indices = d;
    CHECK(lens_indices(&lens, 0.5875618, NULL, d, &error));
    CHECK(lens_indices(&lens, 0.4861327, NULL, F, &error));
    CHECK(system_compile(&lens, 0.5875618, &options, &arena, &first, &error));
    options.indices = F;
    CHECK(system_compile(&lens, 0.4861327, &options, &arena, &compiled, &error));
    system_recolour(&first, 0.4861327, F, &arena, &other);
    const struct rays rays[2] = {rays_new(&arena, 20), rays_new(&arena, 20)};
    for (int k = 0; k < 2; k++) {
        for (size_t i = 0; i < 20; i++) {
            const struct ray ray = {.point = {(double)i - 10, 0.5 * (double)i, 0},
                                    .cosine = {0, 0, 1}};
            rays_set(&rays[k], i, 1, &ray);
        }
        rays_trace(k == 0 ? &compiled : &other, &rays[k], NULL);
    }
    for (size_t i = 0; i < 20; i++) {
        const struct ray a = rays_get(&rays[0], i, compiled.index_last);
        const struct ray b = rays_get(&rays[1], i, other.index_last);
        CHECK(a.status == RAY_OK && memcmp(a.point, b.point, sizeof a.point) == 0 &&
              memcmp(a.cosine, b.cosine, sizeof a.cosine) == 0);
    }
    CHECK(other.wavelength == compiled.wavelength);
    arena_free(&arena);
}

int main(void)
{
    check_recolour();
    check_links();
    check_criteria();
    check_trials(CRITERION_SPOT, REFOCUS_BEST, false);
    check_trials(CRITERION_SPOT, REFOCUS_PARAXIAL, false);
    check_trials(CRITERION_SPOT, REFOCUS_NONE, true);
    check_trials(CRITERION_WAVEFRONT, REFOCUS_BEST, false);
    check_trials(CRITERION_WAVEFRONT, REFOCUS_BEST, true);
    check_trials(CRITERION_EFL, REFOCUS_BEST, false);
    check_trials(CRITERION_BFL, REFOCUS_NONE, false);
    check_trials(CRITERION_DISTORTION, REFOCUS_BEST, false);
    check_trials(CRITERION_BORESIGHT, REFOCUS_BEST, false);
    check_trials(CRITERION_COLOR, REFOCUS_BEST, false);
    check_wedge();
    check_typed();
    check_lost(REFOCUS_BEST);
    check_lost(REFOCUS_PARAXIAL);
    check_pivot();
    check_turned();
    check_lines();
    check_second_order(TOLERANCE_OF_EACH);
    check_second_order(TOLERANCE_OF_WORST);
    check_independence();
    return check_report();
}
