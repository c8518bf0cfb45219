/* commands/design/fit_prescription.c - what of a lens must change to give what was measured. */
/* SPDX-License-Identifier: MIT */
#include "base/watch.h"
#include "cli/options/goals.h"
#include "cli/options/vary.h"
#include "commands/design/fit.h"
#include "design/fit/prescription.h"
#include "file/lens_file.h"
#include "report/output.h"
#include "report/warnings.h"

#include <string.h>

enum { MOST_GOALS = 64 };

/* Of a goal that states none, mm: what a nodal bench measures to. */
static const double usual_deviation = 0.01;

struct fit_goal_row {
    const char *position, *goal, *lens, *status, *warning;
    double target, deviation, reached, off; /* mm */
};

static const struct column columns[] = {
    {COLUMN_NAMED(struct fit_goal_row, position, 0), .help = "zoom or focus position"},
    {COLUMN_NAMED(struct fit_goal_row, goal, COLUMN_BRIEF), .help = "what was measured"},
    {COLUMN_NAMED(struct fit_goal_row, target, COLUMN_BRIEF), .dimension = &dimension_length,
     .unit = "mm", .digits = 8, .help = "as measured"},
    {COLUMN_NAMED(struct fit_goal_row, deviation, 0), .dimension = &dimension_length, .unit = "mm",
     .help = "the standard deviation behind the colon, or 0.01 mm: a goal that is missed by more "
             "fails"},
    {COLUMN_NAMED(struct fit_goal_row, reached, COLUMN_BRIEF | COLUMN_INFINITE),
     .dimension = &dimension_length, .unit = "mm", .digits = 8, .help = "what the fitted lens has"},
    {COLUMN_NAMED(struct fit_goal_row, off, COLUMN_BRIEF | COLUMN_INFINITE),
     .dimension = &dimension_length, .unit = "mm", .help = "reached less target"},
    {COLUMN_NAMED(struct fit_goal_row, status, 0),
     .help = "converged, or why the fit ended otherwise"},
    {COLUMN_NAMED(struct fit_goal_row, lens, COLUMN_EXTRA | COLUMN_ASSUMED), .depends = "lens",
     .help = "title of the lens"},
    {COLUMN_NAMED(struct fit_goal_row, warning, COLUMN_NOTE),
     .help = "that the goal is missed, and what is doubtful about the fitted lens"},
};

const struct sheet fit_goal_sheet = SHEET(columns, struct fit_goal_row);

/* What was asked. */
struct wishes {
    struct prescription_goal goals[MOST_GOALS];
    const char *goal_names[MOST_GOALS];
    size_t goal_count;
    struct prescription_part *parts;
    const char **part_names;
    size_t part_count;
};

/* What fit takes, of all that goals may be of. */
static const enum goal_kind goal_kinds[OPERAND_KINDS + 1] = {
    [OPERAND_EFL] = GOAL_EFL + 1,       [OPERAND_BFL] = GOAL_BFL + 1,
    [OPERAND_FFL] = GOAL_FFL + 1,       [OPERAND_HEIGHT] = GOAL_HEIGHT + 1,
    [OPERAND_LENGTH] = GOAL_LENGTH + 1,
};

static bool fit_read_goals(const char *list, struct run *run, double wavelength,
                           struct wishes *wishes, struct error *error)
{
    const struct goals_reader reader = {run->db, NULL, run->arena, "--prescription",
                                        usual_deviation};
    struct goals goals;
    if (!goals_read(&reader, text_of(list), &goals, error)) {
        return false;
    }
    if (goals.count > MOST_GOALS) {
        return fail(error, ERROR_USAGE, "{--prescription} has more than %d goals", MOST_GOALS);
    }
    for (size_t i = 0; i < goals.count; i++) {
        struct text rest = text_of(goals.list[i].name);
        const struct text name = text_trim(text_cut(&rest, '='));
        wishes->goal_names[i] = arena_string(run->arena, name.start, name.length);
        const struct operand *operand = &goals.list[i];
        struct prescription_goal *goal = &wishes->goals[i];
        if (goal_kinds[operand->kind] == 0) {
            fail(error, ERROR_USAGE, "the goal '%s' in {--prescription} is nothing that fit takes",
                 operand->name);
            return error_hint(error,
                              "goals are efl=50.2, bfl=38.1:0.02, ffl, length, height@10deg=8.8");
        }
        if (operand->relation != OPERAND_NEAR) {
            return fail(error, ERROR_USAGE,
                        "the goal '%s' in {--prescription}: what was measured stands behind '='",
                        operand->name);
        }
        *goal = (struct prescription_goal){
            goal_kinds[operand->kind] - 1, operand->target, operand->deviation,
            isnan(operand->wavelength) ? wavelength : operand->wavelength, NAN};
        if (operand->field != NULL) {
            goal->field = operand->field->point.value[1];
        }
        if (!(operand->field == NULL || operand->field->point.kind == FIELD_ANGLE)) {
            return fail(error, ERROR_USAGE,
                        "the goal '%s' in {--prescription}: its field is an angle", operand->name);
        }
    }
    wishes->goal_count = goals.count;
    return true;
}

/* --vary, or the marks of the lens that fit takes. */
static bool fit_read_parts(const struct fit_input *input, const struct lens *lens, struct run *run,
                           struct wishes *wishes, struct error *error)
{
    const struct vary_reader reader = {.lens = lens,
                                       .arena = run->arena,
                                       .takes = prescription_fits,
                                       .only = "fit varies radii, thicknesses and indices"};
    struct variable *list;
    const char *ignored = NULL;
    if (!(input->vary != NULL
              ? vary_list(&reader, input->vary, NULL, &list, &wishes->part_count, error)
              : vary_marks(&reader, &list, &wishes->part_count, &ignored, error))) {
        return false;
    }
    if (ignored != NULL) {
        warnings_add(run->doubts, "fit varies radii and thicknesses, not what is marked %s",
                     ignored);
    }
    if (wishes->part_count == 0) {
        fail(error, ERROR_DOMAIN,
             "nothing may change: give {--vary}, or mark R~ and t~ in the lens");
        return ignored != NULL && error_hint(error, "fit does not vary %s", ignored);
    }
    wishes->parts = ARENA_ARRAY(run->arena, wishes->part_count, struct prescription_part);
    wishes->part_names = ARENA_ARRAY(run->arena, wishes->part_count, const char *);
    for (size_t i = 0; i < wishes->part_count; i++) {
        const struct parameter what = list[i].what, glass = {what.surface, PARAMETER_GLASS, 0};
        const bool is_medium = what.kind == PARAMETER_INDEX;
        wishes->parts[i] = (struct prescription_part){what, list[i].low, list[i].high};
        wishes->part_names[i] = list[i].name;
        /* a pick-up would have to follow what is fitted, and keep what it sets */
        for (size_t k = 0; k < lens->pickup_count; k++) {
            const struct parameter to = lens->pickups[k].what, from = lens->pickups[k].from;
            if (parameter_is_same(to, what) || parameter_is_same(from, what) ||
                (is_medium && (parameter_is_same(to, glass) || parameter_is_same(from, glass)))) {
                return fail(error, ERROR_DOMAIN,
                            "%s has to do with the pick-up of %c%zu, which fit does not follow",
                            list[i].name, parameter_type(to.kind)->name[0], to.surface + 1);
            }
        }
    }
    return true;
}

/* A goal that is off by more than its deviation, in words; null: it is met. */
static const char *fit_goal_miss(const struct wishes *wishes, const struct prescription_fit *fit,
                                 size_t g, struct arena *arena)
{
    const struct prescription_goal *goal = &wishes->goals[g];
    double off = fit->reached[g] - goal->value;
    return fabs(off) <= goal->deviation
               ? NULL
               : arena_printf(arena, "%s is missed by %.4g mm, its deviation is %.4g mm",
                              wishes->goal_names[g], fabs(off), goal->deviation);
}

/* A mark whose bounds the fitted value violates is left without them: no fit would take it. */
static void free_marks(struct lens *fitted, const struct wishes *wishes,
                       const struct prescription_fit *fit, struct run *run, const char **freed)
{
    for (size_t j = 0; j < wishes->part_count; j++) {
        const struct parameter what = wishes->parts[j].what;
        struct surface *surface = &fitted->surfaces[what.surface];
        struct vary *copy = ARENA_ARRAY(run->arena, surface->vary_count + 1, struct vary);
        for (size_t i = 0; i < surface->vary_count; i++) {
            struct vary *mark = &copy[i];
            *mark = surface->varies[i];
            double low = mark->low.value.hi, high = mark->high.value.hi, value = fit->values[j];
            bool within = low <= high ? low <= value && value <= high
                                      : low <= value || value <= high; /* through a plane */
            if (mark->kind != what.kind || !mark->has_bounds || within) {
                continue;
            }
            mark->has_bounds = false;
            const char *unit = what.kind == PARAMETER_INDEX ? "" : " mm";
            const char *words = arena_printf(
                run->arena,
                "%s = %.6g%s is outside of [%.10g,%.10g]%s, the bounds of its mark %s~: they are "
                "left out",
                wishes->part_names[j], value, unit, low, high, unit,
                parameter_type(what.kind)->name);
            warnings_add(run->doubts, "%s", words);
            *freed = lens_warnings_join(*freed, words, run->arena);
        }
        surface->varies = copy;
    }
}

/* What --output saves. */
struct fitted {
    struct lens lens;
    const char *missed; /* null: no goal is */
    const char *freed;  /* marks that lose their bounds, in words; null: none does */
};

static bool fit_prescription_of(const struct fit_input *input, const struct lens_case *one,
                                struct run *run, struct error *error)
{
    struct arena *arena = run->arena;
    const struct lens *lens = one->setup->lens;
    struct wishes *wishes = ARENA_NEW(arena, struct wishes);
    struct fitted *fitted = ARENA_NEW(arena, struct fitted);
    struct prescription_fit fit;
    struct lens_warnings warnings;
    const char *doubt = NULL; /* what is odd about the fitted lens */
    if (one->setup->position != NULL) {
        return fail(error, ERROR_DOMAIN,
                    "a lens with positions: its prescription is not that of one of them");
    }
    if (!fit_read_goals(input->goals, run, one->light.wavelength, wishes, error) ||
        !fit_read_parts(input, lens, run, wishes, error)) {
        return false;
    }
    const struct prescription_task task = {
        .goals = wishes->goals,
        .goal_count = wishes->goal_count,
        .parts = wishes->parts,
        .part_count = wishes->part_count,
        .options = {.progress = fit_goes_on, .progress_context = run->watch}};
    watch_begin(run->watch, "iterations", 0);
    if (!prescription_fit(lens, &task, arena, &fit, error)) {
        return false;
    }
    fitted->lens = prescription_apply(lens, wishes->parts, wishes->part_count, &fit, arena);
    if (!lens_check(&fitted->lens, arena, &warnings, error)) {
        return error_prefix(error, "the fitted lens: ");
    }
    for (size_t i = 0; i < warnings.count; i++) {
        doubt = lens_warnings_join(doubt, warnings.texts[i], arena);
    }
    for (size_t g = 0; g < wishes->goal_count; g++) {
        fitted->missed =
            lens_warnings_join(fitted->missed, fit_goal_miss(wishes, &fit, g, arena), arena);
    }
    free_marks(&fitted->lens, wishes, &fit, run, &fitted->freed);
    const bool is_of_goals = input->show == FIT_ANSWER || input->show == FIT_RESIDUALS;
    bool goes_on = is_of_goals;
    for (size_t g = 0; g < wishes->goal_count && goes_on; g++) {
        const struct prescription_goal *goal = &wishes->goals[g];
        const struct fit_goal_row row = {
            .goal = wishes->goal_names[g],
            .lens = fitted->lens.title,
            .status = fit_status(&fit.summary),
            .warning = lens_warnings_join(fit_goal_miss(wishes, &fit, g, arena), doubt, arena),
            .target = goal->value,
            .deviation = goal->deviation,
            .reached = fit.reached[g],
            .off = fit.reached[g] - goal->value};
        goes_on = run_emit(run, &row);
    }
    if (!is_of_goals) {
        memcpy(fit.summary.standard_error, fit.errors, wishes->part_count * sizeof(double));
        fit_emit(NULL, wishes->part_count, wishes->part_names, fit.values, &fit.summary,
                 (enum fit_show)input->show, run);
    }
    run->state = fitted;
    /* rows that fall short of what was asked stand, with exit status 1 */
    if (fitted->missed != NULL || fit.summary.status != SOLVER_CONVERGED) {
        fail(&run->shortfall, ERROR_DOMAIN, "%s",
             fitted->missed != NULL ? fitted->missed : fit_status(&fit.summary));
    }
    return true;
}

/* A lens that misses its goals says so, and what became of its marks. */
bool fit_save_prescription(const struct artifact_job *job, struct output *sink, struct error *error)
{
    const struct fitted *fitted = job->run->state;
    struct arena *arena = job->run->arena;
    struct lens lens = fitted->lens;
    (void)error;
    design_note(&lens, fitted->missed, arena);
    design_note(&lens, fitted->freed, arena);
    struct text text = lens_write(&lens, arena);
    output_text(sink, text.start, text.length);
    return true;
}

bool fit_prescription(const struct fit_input *input, struct run *run, struct error *error)
{
    static const struct lens_policy policy = {.wavelengths = WAVELENGTHS_PRIMARY,
                                              .is_narrow = true};
    struct lens_question question = input->question;
    question.field = question.field_x = NAN;
    struct lens_cursor at = lens_begin(&question, &policy, run->arena);
    while (lens_next(&at, error)) {
        if (!fit_prescription_of(input, &at.one, run, error)) {
            return false;
        }
    }
    return error->code == ERROR_NONE;
}
