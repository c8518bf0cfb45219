/* commands/design/tolerance_costs.c - what each error costs, and what errors may be. */
/* SPDX-License-Identifier: MIT */
#include "commands/design/tolerance_job.h"

#include "base/constants.h"
#include "cli/options/tolerances.h"
#include "design/tolerance/sensitivity.h"
#include "file/lens_tolerance.h"
#include "file/lens_unit.h"
#include "optics/growing.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* How wide a tolerance is, as people say it. */
struct tolerance_range {
    double scale; /* times the amount of a perturbation */
    const char *unit;
};

static struct tolerance_range tolerance_range_of(const struct perturbation *one)
{
    const double arcminutes = 60 * DEGREES_PER_RADIAN;
    switch (one->kind) {
    case TOLERANCE_TILT:
    case TOLERANCE_ELEMENT_TILT:
    case TOLERANCE_ELEMENT_ROLL:
    case TOLERANCE_WEDGE:
        return (struct tolerance_range){arcminutes, "arcmin"};
    case TOLERANCE_IRREGULARITY:
        return (struct tolerance_range){TOLERANCE_WAVE_MM / TOLERANCE_FRINGE_MM, "fringes"};
    case TOLERANCE_INDEX:
    case TOLERANCE_ABBE:
    case TOLERANCE_CONIC:
        return (struct tolerance_range){1, "1"};
    case TOLERANCE_COEFFICIENT:
        return (struct tolerance_range){1, "mm^(1-n)"};
    default:
        return (struct tolerance_range){1, one->what.kind == PARAMETER_CURVATURE ? "1/mm" : "mm"};
    }
}

/* What rows have of an error. */
#define ERROR_COLUMNS(S)                                                                           \
    ENTRY(COLUMN_NAMED(S, perturbation, COLUMN_BRIEF),                                             \
          .help = "what is wrong with the lens, and nothing else"),                                \
        ENTRY(COLUMN(S, range), .flags = COLUMN_BRIEF, .name = "tolerance", .head = "+-",          \
              .digits = 4, .label = "tolerance", .help = "plus and minus: half the range"),        \
        ENTRY(COLUMN(S, range_unit), .flags = COLUMN_BRIEF, .name = "tolerance_unit", .head = "",  \
              .label = "its unit", .help = "of the tolerance")

/* -------- sensitivity -------- */

struct sensitivity_row {
    struct tolerance_about about;
    const char *perturbation, *range_unit, *position, *criterion, *of, *unit;
    const char *moves;
    double range, field, height, linear, quadratic, plus, minus, compensation;
};

#define CHANGE(member, words)                                                                      \
    ENTRY(COLUMN_NAMED(struct sensitivity_row, member, COLUMN_BRIEF), .digits = 4, .help = words)

static const struct column sensitivity_columns[] = {
    ERROR_COLUMNS(struct sensitivity_row),
    TOLERANCE_CRITERION_COLUMNS(struct sensitivity_row),
    {COLUMN_NAMED(struct sensitivity_row, field, COLUMN_HIDDEN), .dimension = &dimension_angle,
     .unit = "deg", .help = "field angle in the y-z plane; absent for heights"},
    {COLUMN_NAMED(struct sensitivity_row, height, COLUMN_HIDDEN), .dimension = &dimension_length,
     .unit = "mm", .help = "field as a height; absent for angles"},
    CHANGE(linear, "derivative of the figure, times the tolerance; absent of a root that is 0"),
    CHANGE(quadratic, "half of the sum of both changes: what does not depend on the sign"),
    CHANGE(plus, "change of the figure with the whole tolerance; absent where the lens has none"),
    CHANGE(minus, "the same with the opposite sign"),
    {COLUMN_NAMED(struct sensitivity_row, compensation, COLUMN_BRIEF | COLUMN_SPARSE), .digits = 4,
     .dimension = &dimension_length, .unit = "mm",
     .help = "how far the image plane moves with plus; absent where something else is adjusted and "
             "--refocus is none"},
    {COLUMN_NAMED(struct sensitivity_row, moves, COLUMN_BRIEF | COLUMN_SPARSE),
     .help = "what else is adjusted, and how far with plus"},
    TOLERANCE_ABOUT_COLUMNS(struct sensitivity_row),
};

const struct sheet tolerance_sensitivity_sheet = SHEET(sensitivity_columns, struct sensitivity_row);

static bool is_angle(const struct tolerance_figure *figure)
{
    return figure->field != NULL && figure->field->point.kind == FIELD_ANGLE;
}

bool tolerance_emit_sensitivity(struct tolerance_job *job, struct error *error)
{
    struct arena *arena = job->run->arena;
    const struct tolerance *tolerance = &job->tolerance;
    const struct criterion_type *type = criterion_type(job->question.criterion.kind);
    const struct tolerance_about about = tolerance_about_of(job);
    double *moves = ARENA_ARRAY(arena, tolerance_moves(tolerance), double);
    const char *failure;
    double *nominal;
    (void)error;
    const struct second_order_problem problem =
        tolerance_problem(&job->tolerance, job->run->watch, arena, &nominal);
    const size_t n = problem.error_count, figures = problem.figure_count;
    struct sensitivity *table = ARENA_ARRAY(arena, n * figures, struct sensitivity);
    const size_t done = sensitivity_find(&problem, nominal, arena, table, &failure);
    if (done < n) {
        fail(&job->run->shortfall, ERROR_DOMAIN,
             "interrupted after %zu of %zu errors: those so far, incomplete", done, n);
    }
    if (failure != NULL) {
        warnings_add(job->run->doubts, "%s", failure);
    }
    for (size_t i = 0; i < done; i++) {
        const struct perturbation *one = &job->question.perturbations[i];
        const struct tolerance_range range = tolerance_range_of(one);
        for (size_t m = 0; m < tolerance_moves(tolerance); m++) {
            moves[m] = table[i * figures + tolerance->figure_count + m].plus;
        }
        for (size_t f = 0; f < tolerance->figure_count; f++) {
            const struct sensitivity *at = &table[i * figures + f];
            const struct tolerance_figure *figure = &tolerance->figures[f];
            const double y = figure->field != NULL ? figure->field->point.value[1] : NAN;
            const struct sensitivity_row row = {.about = about,
                                                .perturbation = one->name,
                                                .range = one->amount * range.scale,
                                                .range_unit = range.unit,
                                                .position = tolerance_position_of(job, figure),
                                                .criterion = job->question.criterion.name,
                                                .of = tolerance_name_of(job, figure),
                                                .unit = type->unit,
                                                .field = is_angle(figure) ? y : NAN,
                                                .height = is_angle(figure) ? NAN : y,
                                                .linear = type->scale * at->linear,
                                                .quadratic = type->scale * at->quadratic,
                                                .plus = type->scale * at->plus,
                                                .minus = type->scale * at->minus,
                                                .moves = tolerance_moves_in_words(job, moves),
                                                .compensation =
                                                    tolerance_refocus_of(job, moves[0])};
            if (!run_emit(job->run, &row)) {
                return true;
            }
        }
    }
    return true;
}

/* -------- inverse -------- */

struct inverse_row {
    struct tolerance_about about;
    const char *perturbation, *range_unit, *criterion, *of, *unit, *limited, *line;
    double range, proposed, factor, cost, together;
};

static const struct column inverse_columns[] = {
    ERROR_COLUMNS(struct inverse_row),
    {COLUMN_NAMED(struct inverse_row, proposed, COLUMN_BRIEF), .digits = 4,
     .help = "the tolerance that costs an equal share of the drop"},
    {COLUMN_NAMED(struct inverse_row, factor, COLUMN_HIDDEN),
     .help = "of the tolerance that was given"},
    {COLUMN_NAMED(struct inverse_row, cost, COLUMN_BRIEF), .digits = 4,
     .help = "what the proposed one costs alone, the worse of both signs; of two directions the "
             "root of the sum of the squares"},
    {COLUMN_NAMED(struct inverse_row, unit, COLUMN_BRIEF), .help = "of the cost"},
    {COLUMN_NAMED(struct inverse_row, limited, COLUMN_BRIEF | COLUMN_SPARSE),
     .help = "high: no published grade is tighter, and so it costs more; commercial: no shop has "
             "to be worse, and so it costs less"},
    {COLUMN_NAMED(struct inverse_row, criterion, COLUMN_HIDDEN),
     .help = "what lenses are judged by"},
    {COLUMN_NAMED(struct inverse_row, of, COLUMN_HIDDEN),
     .help = "worst or mean of all fields and positions"},
    {COLUMN_NAMED(struct inverse_row, line, COLUMN_EXTRA),
     .help = "the proposal as a line of a lens or a file of --tolerances"},
    {COLUMN(struct inverse_row, together), .flags = COLUMN_EXTRA | COLUMN_ASSUMED,
     .name = "together", .depends = "drop", .label = "cost together",
     .help = "what all of them cost: the root of the sum of the squares"},
    TOLERANCE_ABOUT_COLUMNS(struct inverse_row),
};

const struct sheet tolerance_inverse_sheet = SHEET(inverse_columns, struct inverse_row);

/* How much worse a lens is than the nominal one: by its worst figure, or its mean. */
static double tolerance_cost_of(void *context, const double *figures)
{
    const struct tolerance_job *job = context;
    const struct tolerance *tolerance = &job->tolerance;
    const enum criterion_kind kind = job->question.criterion.kind;
    double worst = -INFINITY, before = -INFINITY;
    if (job->trials.of == TOLERANCE_OF_MEAN) {
        const double is = tolerance_judged(tolerance, TOLERANCE_OF_MEAN, figures);
        const double was = tolerance_judged(tolerance, TOLERANCE_OF_MEAN, tolerance->nominal);
        return criterion_badness(kind, is, was) - criterion_badness(kind, was, was);
    }
    for (size_t f = 0; f < tolerance->figure_count; f++) {
        worst = fmax(worst, criterion_badness(kind, figures[f], tolerance->nominal[f]));
        before =
            fmax(before, criterion_badness(kind, tolerance->nominal[f], tolerance->nominal[f]));
    }
    return worst - before;
}

/* The errors that a grade has of the lens; none where it cannot be had. */
static struct perturbations errors_of_grade(const struct tolerance_job *job, const char *grade)
{
    const struct run *run = job->run;
    struct lens *bare = ARENA_NEW(run->arena, struct lens);
    struct perturbations perturbations = {NULL, 0, NULL, NULL};
    const char *assumed;
    struct error ignored;
    *bare = *job->lens;
    bare->tolerances = NULL;
    bare->tolerance_count = 0;
    const struct tolerances_reader reader = {.lens = bare, .db = run->db, .arena = run->arena};
    if (!tolerances_of(&reader, grade, NULL, &perturbations, &assumed, &ignored)) {
        perturbations.count = 0;
    }
    return perturbations;
}

/* The same error in a grade, in units of half the range here; NaN: the grade has none such. */
static double error_in_grade(const struct perturbations *grade, const struct perturbation *one)
{
    for (size_t i = 0; i < grade->count; i++) {
        const struct perturbation *other = &grade->list[i];
        if (strcmp(other->name, one->name) == 0 && other->what.kind == one->what.kind) {
            return other->amount / one->amount;
        }
    }
    return NAN;
}

/* Tolerances, each of one error or of several directions and forms. */
struct things {
    size_t *of;    /* each error */
    size_t *first; /* error of each thing */
    size_t count;
    double *low, *high;
};

/* The tightest and the loosest published tolerances. */
static struct things things_of(const struct tolerance_job *job)
{
    const double least = 1e-6, most = 1e6; /* of what no grade has */
    const struct perturbations tight = errors_of_grade(job, "high"),
                               loose = errors_of_grade(job, "commercial");
    const struct tolerance_question *question = &job->question;
    const size_t n = question->perturbation_count + 1;
    struct arena *arena = job->run->arena;
    struct things things = {ARENA_ARRAY(arena, n, size_t), ARENA_ARRAY(arena, n, size_t), 0,
                            ARENA_ARRAY(arena, n, double), ARENA_ARRAY(arena, n, double)};
    for (size_t i = 0; i < question->perturbation_count; i++) {
        const struct perturbation *one = &question->perturbations[i];
        const bool is_new = i == 0 || one[-1].thing != one->thing;
        if (is_new) {
            const double best = error_in_grade(&tight, one), worst = error_in_grade(&loose, one);
            things.low[things.count] = isnan(best) ? least : best;
            things.high[things.count] = isnan(worst) ? most : worst;
            things.first[things.count++] = i;
        }
        things.of[i] = things.count - 1;
    }
    return things;
}

/* The line of the tolerance, so many times as wide, in the unit that it was written in. */
static const char *tolerance_line_of(const struct tolerance_job *job,
                                     const struct perturbation *one, double factor)
{
    static const char *const endings[TOLERANCE_UNITS] = {"mm", "arcmin", "", "%", "fringes"};
    const double arcminutes = 60 * DEGREES_PER_RADIAN;
    struct lens_tolerance now = *one->line;
    struct text_buffer text = {.arena = job->run->arena};
    double scale = 1;
    if (now.unit == TOLERANCE_ANGLE) {
        scale = arcminutes;
    } else if (now.kind == TOLERANCE_COEFFICIENT && now.unit == TOLERANCE_NUMBER) {
        scale =
            pow(lens_unit_mm(job->lens->unit), -parameter_length(PARAMETER_COEFFICIENT, now.order));
    }
    const double amount = now.amount.value.hi * factor * scale;
    const char *typed = arena_printf(job->run->arena, "%.4g%s", amount, endings[now.unit]);
    now.amount.typed = text_of(typed);
    growing_string(&text, "tolerance ");
    lens_tolerance_write(&now, job->lens->unit, &text);
    const struct text line = growing_done(&text);
    return arena_string(job->run->arena, line.start, line.length);
}

bool tolerance_emit_inverse(struct tolerance_job *job, struct error *error)
{
    struct arena *arena = job->run->arena;
    const struct criterion_type *type = criterion_type(job->question.criterion.kind);
    const struct things things = things_of(job);
    struct inverse *answers = ARENA_ARRAY(arena, things.count + 1, struct inverse);
    const struct second_order_problem problem =
        tolerance_problem(&job->tolerance, job->run->watch, arena, NULL);
    const struct inverse_question question = {.problem = &problem,
                                              .cost = tolerance_cost_of,
                                              .context = job,
                                              .drop = job->drop,
                                              .thing = things.of,
                                              .thing_count = things.count,
                                              .low = things.low,
                                              .high = things.high};
    const double together = inverse_find(&question, arena, answers);
    if (watch_is_ended(job->run->watch)) {
        return fail(error, ERROR_DOMAIN,
                    "interrupted before the tolerances were found: none is proposed");
    }
    if (isnan(together)) {
        return fail(error, ERROR_DOMAIN,
                    "one of the tightest published tolerances leaves a lens without figures");
    }
    if (together > job->drop * (1 + 1e-6)) {
        warnings_add(job->run->doubts,
                     "the tightest published tolerances together cost %.4g %s, more than the drop "
                     "of %.4g %s",
                     type->scale * together, type->unit, type->scale * job->drop, type->unit);
    }
    static const char *const limits[] = {
        [INVERSE_TIGHTEST] = "high", [INVERSE_LOOSEST] = "commercial"};
    const struct tolerance_about about = tolerance_about_of(job);
    bool goes_on = true;
    for (size_t i = 0; i < things.count && goes_on; i++) {
        const struct perturbation *one = &job->question.perturbations[things.first[i]];
        const struct tolerance_range range = tolerance_range_of(one);
        const double proposed = one->amount * range.scale * answers[i].factor;
        /* "element 3..5 tilt" of "element 3..5 tilt x" where it has both */
        const char *name = one->name, *end = strrchr(name, ' ');
        const size_t next =
            i + 1 < things.count ? things.first[i + 1] : job->question.perturbation_count;
        if (next != things.first[i] + 1 && end != NULL) {
            name = arena_string(arena, name, (size_t)(end - name));
        }
        const struct inverse_row row = {.about = about,
                                        .perturbation = name,
                                        .range = one->amount * range.scale,
                                        .range_unit = range.unit,
                                        .criterion = job->question.criterion.name,
                                        .of =
                                            job->trials.of == TOLERANCE_OF_MEAN ? "mean" : "worst",
                                        .unit = type->unit,
                                        .limited = limits[answers[i].limit],
                                        .line = tolerance_line_of(job, one, answers[i].factor),
                                        .proposed = proposed,
                                        .factor = answers[i].factor,
                                        .cost = type->scale * answers[i].cost,
                                        .together = type->scale * together};
        goes_on = run_emit(job->run, &row);
    }
    return true;
}

/* -------- offenders -------- */

struct offender_row {
    struct tolerance_about about;
    const char *perturbation, *range_unit, *criterion;
    double range, first, total;
    long rank;
};

static const struct column offender_columns[] = {
    {COLUMN_NAMED(struct offender_row, rank, COLUMN_BRIEF), .help = "from the worst, 1, on"},
    ERROR_COLUMNS(struct offender_row),
    {COLUMN(struct offender_row, first), .flags = COLUMN_BRIEF, .digits = 4, .name = "share_first",
     .head = "first", .label = "by itself",
     .help = "share of the variance of the figure, of a root of its square, that it makes by "
             "itself; the mean of all fields and positions"},
    {COLUMN(struct offender_row, total), .flags = COLUMN_BRIEF, .digits = 4, .name = "share_total",
     .head = "total", .label = "in all",
     .help = "with what it makes together with others, which count it too"},
    {COLUMN_NAMED(struct offender_row, criterion, COLUMN_HIDDEN),
     .help = "what lenses are judged by"},
    TOLERANCE_ABOUT_COLUMNS(struct offender_row),
};

const struct sheet tolerance_offenders_sheet = SHEET(offender_columns, struct offender_row);

static int costs_by_share(const void *a, const void *b)
{
    const struct tolerance_offender *left = a, *right = b;
    if (left->share.total != right->share.total) {
        return left->share.total > right->share.total ? -1 : 1;
    }
    return left->perturbation < right->perturbation ? -1 : 1;
}

bool tolerance_offenders(struct tolerance_job *job, struct tolerance_offender **offenders,
                         struct error *error)
{
    struct arena *arena = job->run->arena;
    const size_t n = job->question.perturbation_count;
    const double rounding = 1e-9; /* of second differences */
    struct second_order differential;
    struct second_order_share *shares = ARENA_ARRAY(arena, n + 1, struct second_order_share);
    struct perturbation_moments *moments = ARENA_ARRAY(arena, n + 1, struct perturbation_moments);
    double *nominal, sum = 0;
    const struct second_order_problem problem =
        tolerance_problem(&job->tolerance, job->run->watch, arena, &nominal);
    if (!second_order_open(&problem, arena, &differential, error)) {
        return false;
    }
    for (size_t i = 0; i < n; i++) {
        moments[i] = perturbation_moments(&job->question.perturbations[i]);
    }
    const double deviation = second_order_shares(&differential, moments, LENS_NONE, shares);
    /* what figures, of roots their squares, spread by rounding alone */
    for (size_t f = 0; f < problem.judged_count; f++) {
        sum += problem.is_root[f] ? nominal[f] * nominal[f] : fabs(nominal[f]);
    }
    if (deviation <= rounding * sum / (double)problem.judged_count) {
        memset(shares, 0, n * sizeof *shares);
    }
    *offenders = ARENA_ARRAY(arena, n + 1, struct tolerance_offender);
    for (size_t i = 0; i < n; i++) {
        (*offenders)[i] = (struct tolerance_offender){i, shares[i]};
    }
    qsort(*offenders, n, sizeof **offenders, costs_by_share);
    return true;
}

bool tolerance_emit_offenders(struct tolerance_job *job, struct error *error)
{
    const struct tolerance_about about = tolerance_about_of(job);
    struct tolerance_offender *offenders;
    if (!tolerance_offenders(job, &offenders, error)) {
        return false;
    }
    for (size_t i = 0; i < job->question.perturbation_count; i++) {
        const struct perturbation *one = &job->question.perturbations[offenders[i].perturbation];
        const struct tolerance_range range = tolerance_range_of(one);
        const struct offender_row row = {.about = about,
                                         .rank = (long)i + 1,
                                         .perturbation = one->name,
                                         .range = one->amount * range.scale,
                                         .range_unit = range.unit,
                                         .criterion = job->question.criterion.name,
                                         .first = offenders[i].share.first,
                                         .total = offenders[i].share.total};
        if (!run_emit(job->run, &row)) {
            break;
        }
    }
    return true;
}
