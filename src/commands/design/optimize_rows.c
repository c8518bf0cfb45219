/* commands/design/optimize_rows.c - what was found, as rows of --show. */
/* SPDX-License-Identifier: MIT */
#include "analysis/rays/spot.h"
#include "commands/analysis/analysis_options.h"
#include "commands/design/optimize_job.h"
#include "design/merit/expression.h"
#include "file/lens_glass.h"

#include <string.h>

/* -------- the answer -------- */

struct answer_row {
    struct optimize_about about;
    double merit_before, merit_after;
    long hits, evaluations, iterations, variables, residuals;
    const char *solver, *status, *goals, *made, *search, *plates;
};

static const struct column answer_columns[] = {
    OPTIMIZE_SWEPT_COLUMNS(struct answer_row),
    {COLUMN(struct answer_row, merit_before), .flags = COLUMN_BRIEF, .name = "merit_before",
     .digits = 6, .label = "merit before",
     .help = "sum of squares of all goals, as the lens was; absent where it has none"},
    {COLUMN(struct answer_row, merit_after), .flags = COLUMN_BRIEF, .name = "merit_after",
     .digits = 6, .label = "merit after", .help = "and as it was found"},
    {COLUMN(struct answer_row, hits), .flags = COLUMN_EXTRA, .name = "starts", .with = "global",
     .label = "starts", .help = "those that led to this lens"},
    {COLUMN_NAMED(struct answer_row, evaluations, COLUMN_BRIEF),
     .help = "of the merit, with or without derivatives; of a search those of all its starts"},
    {COLUMN_NAMED(struct answer_row, iterations, COLUMN_BRIEF),
     .help = "steps, those that were taken back among them; of a search those of its last descent"},
    {COLUMN_NAMED(struct answer_row, solver, COLUMN_BRIEF), .help = "what made the steps"},
    {COLUMN_NAMED(struct answer_row, status, COLUMN_BRIEF),
     .help = "converged, or why it ended otherwise"},
    {COLUMN_NAMED(struct answer_row, variables, COLUMN_HIDDEN), .help = "numbers that may change"},
    {COLUMN_NAMED(struct answer_row, residuals, COLUMN_HIDDEN), .help = "squares in the sum"},
    {COLUMN_NAMED(struct answer_row, goals, COLUMN_EXTRA | COLUMN_ASSUMED), .depends = "goals lens",
     .help = "what is wanted, as --goals takes it"},
    {COLUMN(struct answer_row, made), .flags = COLUMN_EXTRA | COLUMN_ASSUMED, .name = "tolerances",
     .depends = "grade tolerances lens goals", .label = "tolerances",
     .help = "of the goal asbuilt, how many independent errors, and where they are from"},
    {COLUMN_NAMED(struct answer_row, search, COLUMN_EXTRA | COLUMN_ASSUMED),
     .depends = "global start escapes relocate spread seed",
     .help = "how many starts there were, and where"},
    {COLUMN_NAMED(struct answer_row, plates, COLUMN_EXTRA | COLUMN_ASSUMED),
     .depends = "test-plates lens vary hold",
     .help = "how many radii became those of test plates, and what that cost of the merit"},
    OPTIMIZE_LENS_COLUMNS(struct answer_row),
};

static const struct sheet answer_sheet = SHEET(answer_columns, struct answer_row);

static bool optimize_emit_answer(struct optimize_job *job, struct error *error)
{
    (void)error;
    const struct optimize_answer *answer = &job->answer;
    const struct answer_row row = {.about = optimize_about_of(job, true),
                                   .hits = job->hits,
                                   .merit_before = answer->before.merit,
                                   .merit_after = answer->after.merit,
                                   .evaluations = job->rank > 0 ? job->evaluations
                                                                : answer->summary.evaluations,
                                   .iterations = answer->summary.iterations,
                                   .variables = (long)job->variables.count,
                                   .residuals = (long)job->merit.residual_count,
                                   .solver = job->input->solver == SOLVER_CERES ? "ceres" : "dls",
                                   .status = job->status,
                                   .goals = job->goals,
                                   .made = job->made,
                                   .search = job->search,
                                   .plates = optimize_plates_words(job)};
    run_emit(job->run, &row);
    return true;
}

/* -------- goals -------- */

struct optimize_goal_row {
    struct optimize_about about;
    const char *position, *goal, *unit;
    double before, after, share_before, share_after;
    double part;
};

static const struct column goal_columns[] = {
    OPTIMIZE_SWEPT_COLUMNS(struct optimize_goal_row),
    LENS_POSITION_COLUMN(struct optimize_goal_row, position, COLUMN_BRIEF),
    {COLUMN_NAMED(struct optimize_goal_row, goal, COLUMN_BRIEF), .help = "what is wanted"},
    {COLUMN(struct optimize_goal_row, before), .flags = COLUMN_BRIEF | COLUMN_INFINITE,
     .name = "value_before", .label = "value before",
     .help = "what the lens had, of many surfaces the worst; of rays the root of their sum of "
             "squares"},
    {COLUMN(struct optimize_goal_row, after), .flags = COLUMN_BRIEF | COLUMN_INFINITE,
     .name = "value_after", .label = "value after", .help = "what the lens that was found has"},
    {COLUMN_NAMED(struct optimize_goal_row, unit, COLUMN_BRIEF),
     .help = "of the two values; a plain number has none"},
    {COLUMN(struct optimize_goal_row, share_before), .flags = COLUMN_BRIEF, .name = "merit_before",
     .label = "merit before", .help = "its part of the sum of squares"},
    {COLUMN(struct optimize_goal_row, share_after), .flags = COLUMN_BRIEF, .name = "merit_after",
     .label = "merit after", .help = "the same afterwards"},
    {COLUMN(struct optimize_goal_row, part), .dimension = &dimension_ratio, .unit = "%",
     .flags = COLUMN_BRIEF, .name = "share", .label = "share",
     .help = "of the merit afterwards; absent of what is met exactly"},
    OPTIMIZE_LENS_COLUMNS(struct optimize_goal_row),
};

static const struct sheet goal_sheet = SHEET(goal_columns, struct optimize_goal_row);

double optimize_merit_of(const struct optimize_state *state, const struct merit_slot *slot)
{
    double sum = 0;
    for (size_t i = slot->first; i < slot->first + slot->count; i++) {
        sum += state->residuals[i] * state->residuals[i];
    }
    return sum;
}

double optimize_value_of(const struct optimize_state *state, const struct merit_slot *slot)
{
    const struct operand *operand = slot->operand;
    const struct operand_unit unit = operand_unit(operand);
    double worst = state->values[slot->first];
    for (size_t i = slot->first; i < slot->first + slot->count; i++) {
        if (optimize_wrong_by(operand, state->values[i]) > optimize_wrong_by(operand, worst)) {
            worst = state->values[i];
        }
    }
    if ((operand_type(operand->kind)->is & OPERAND_OF_RAYS) != 0) {
        worst = sqrt(optimize_merit_of(state, slot)) * operand->deviation;
    }
    return unit_from_own(unit_find(unit.dimension, text_of(unit.unit)), worst);
}

const char *optimize_position_of(const struct merit *merit, const struct merit_slot *slot)
{
    const struct operand *operand = slot->operand;
    const bool compares = operand->kind == OPERAND_EXPRESSION &&
                          expression_is_fixed(operand->expression) &&
                          expression_position(operand->expression) == LENS_NONE;
    return compares ? NULL : merit->places[slot->place].setup.position;
}

bool optimize_is_quiet(const struct optimize_job *job, const struct merit_slot *slot)
{
    return job->guards && slot->operand->kind == OPERAND_GRAZING &&
           !(optimize_merit_of(&job->answer.before, slot) > 0) &&
           !(optimize_merit_of(&job->answer.after, slot) > 0);
}

static bool emit_merit(struct optimize_job *job, struct error *error)
{
    (void)error;
    const struct merit *merit = &job->merit;
    const struct optimize_answer *answer = &job->answer;
    for (size_t i = 0; i < merit->slot_count; i++) {
        const struct merit_slot *slot = &merit->slots[i];
        const double before = optimize_merit_of(&answer->before, slot);
        const double after = optimize_merit_of(&answer->after, slot);
        const char *unit = operand_unit(slot->operand).label;
        const bool is_exact = slot->operand->relation == OPERAND_EXACT;
        const struct optimize_goal_row row = {.about = optimize_about_of(job, i == 0),
                                              .position = optimize_position_of(merit, slot),
                                              .goal = slot->operand->name,
                                              .unit = *unit != '\0' ? unit : NULL,
                                              .before = optimize_value_of(&answer->before, slot),
                                              .after = optimize_value_of(&answer->after, slot),
                                              .share_before = before,
                                              .share_after = after,
                                              .part = is_exact ? NAN : after / answer->after.merit};
        if (!optimize_is_quiet(job, slot) && !run_emit(job->run, &row)) {
            break;
        }
    }
    return true;
}

/* -------- variables -------- */

struct variable_row {
    struct optimize_about about;
    const char *variable, *note;
    double before, after, low, high;
};

static const struct column variable_columns[] = {
    OPTIMIZE_SWEPT_COLUMNS(struct variable_row),
    {COLUMN_NAMED(struct variable_row, variable, COLUMN_BRIEF), .help = "what may change"},
    {COLUMN_NAMED(struct variable_row, before, COLUMN_BRIEF | COLUMN_INFINITE), .digits = 8,
     .help = "as the lens was; lengths in mm, angles in rad"},
    {COLUMN_NAMED(struct variable_row, after, COLUMN_BRIEF | COLUMN_INFINITE), .digits = 8,
     .help = "as it was found"},
    {COLUMN_NAMED(struct variable_row, low, COLUMN_BRIEF | COLUMN_SPARSE),
     .help = "its lower bound; absent if there is none"},
    {COLUMN_NAMED(struct variable_row, high, COLUMN_BRIEF | COLUMN_SPARSE),
     .help = "its upper bound"},
    {COLUMN_NAMED(struct variable_row, note, COLUMN_BRIEF),
     .help = "at its bound, of a test plate, or that no goal depends on it; else absent"},
    OPTIMIZE_LENS_COLUMNS(struct variable_row),
};

static const struct sheet variable_sheet = SHEET(variable_columns, struct variable_row);

static double bound_or_none(double bound)
{
    return isfinite(bound) ? bound : NAN;
}

/* The real glass that a number was of a model of; null: it was none. */
static const struct medium *exchanged_glass(const struct lens *lens,
                                            const struct variable *variable)
{
    const enum parameter_kind kind = variable->what.kind;
    const struct medium *medium = &lens->surfaces[variable->what.surface].medium;
    return parameter_is_of_medium(kind) && medium->kind == MEDIUM_GLASS ? medium : NULL;
}

double optimize_variable_in(const struct optimize_job *job, const struct lens *lens, size_t which)
{
    const struct variable *variable = &job->variables.list[which];
    const size_t position = variable->position != LENS_NONE ? variable->position : 0;
    const struct medium *glass = exchanged_glass(lens, variable);
    if (glass != NULL) {
        const struct glass_abbe real = glass_abbe(lens_glass_of(glass));
        return variable->what.kind == PARAMETER_INDEX ? real.nd : real.Vd;
    }
    return parameter_get(lens_at_position(lens, position, job->run->arena), variable->what);
}

const char *optimize_variable_note(const struct optimize_job *job, size_t which, bool *is_at_bound)
{
    const struct optimize_answer *answer = &job->answer;
    const struct variable *variable = &job->variables.list[which];
    const struct medium *glass = exchanged_glass(job->found, variable);
    *is_at_bound = false;
    if (glass != NULL) {
        return glass->written.start;
    }
    if (optimize_plates_hold(job, variable)) {
        return "of a test plate";
    }
    if (answer->is_idle[which]) {
        return "no goal depends on it";
    }
    *is_at_bound = answer->summary.at_bound[which];
    return *is_at_bound ? "at its bound" : NULL;
}

static bool emit_variables(struct optimize_job *job, struct error *error)
{
    (void)error;
    for (size_t i = 0; i < job->variables.count; i++) {
        const struct variable *variable = &job->variables.list[i];
        bool is_at_bound;
        const struct variable_row row = {.about = optimize_about_of(job, i == 0),
                                         .variable = variable->name,
                                         .before = optimize_variable_in(job, job->lens, i),
                                         .after = optimize_variable_in(job, job->found, i),
                                         .low = bound_or_none(variable->low),
                                         .high = bound_or_none(variable->high),
                                         .note = optimize_variable_note(job, i, &is_at_bound)};
        if (!run_emit(job->run, &row)) {
            break;
        }
    }
    return true;
}

/* -------- spots -------- */

struct spot_row {
    struct optimize_about about;
    const char *position;
    double field, height, wavelength, before, after; /* rad, mm, um, mm */
};

static const struct column spot_columns[] = {
    OPTIMIZE_SWEPT_COLUMNS(struct spot_row),
    LENS_POSITION_COLUMN(struct spot_row, position, COLUMN_BRIEF),
    {COLUMN_NAMED(struct spot_row, field, COLUMN_ECHO | COLUMN_BRIEF | COLUMN_SPARSE),
     .dimension = &dimension_angle, .unit = "deg", .help = "field angle; absent for a height"},
    {COLUMN(struct spot_row, height), .name = "height", .dimension = &dimension_length,
     .unit = "mm", .flags = COLUMN_ECHO | COLUMN_BRIEF | COLUMN_SPARSE, .label = "field height",
     .help = "height of the field, at the object or at the image as the lens has it"},
    {COLUMN_NAMED(struct spot_row, wavelength, COLUMN_ECHO | COLUMN_BRIEF),
     .dimension = &dimension_wavelength_um, .unit = "nm", .help = "wavelength"},
    {COLUMN(struct spot_row, before), .name = "rms_before", .dimension = &dimension_length,
     .unit = "um", .flags = COLUMN_BRIEF, .label = "RMS before",
     .help = "root mean square distance from the centroid, converged; absent: no ray arrives"},
    {COLUMN(struct spot_row, after), .name = "rms_after", .dimension = &dimension_length,
     .unit = "um", .flags = COLUMN_BRIEF, .label = "RMS after",
     .help = "of the lens that was found"},
    OPTIMIZE_LENS_COLUMNS(struct spot_row),
};

static const struct sheet spot_sheet = SHEET(spot_columns, struct spot_row);

/* mm; NaN: none. */
static double optimize_spot_of(const struct optimize_job *job, const struct setup *setup,
                               size_t field)
{
    const struct spot_question question = {
        .bundle = {.setup = setup,
                   .field = &setup->fields[field].point,
                   .clip = job->input->clip,
                   .from_entrance = job->input->aim == ANALYSIS_AIM_ENTRANCE,
                   .pattern = PATTERN_GAUSS},
        .error = 1e-4,
        .no_radius = true,
        .energy = NAN};
    struct spot spot;
    struct error ignored;
    const bool found = spot_find(&question, job->run->arena, &spot, &ignored);
    return found && !spot.is_angular ? spot.rms : NAN;
}

static bool emit_spots(struct optimize_job *job, struct error *error)
{
    bool goes_on = true, is_first = true;
    for (size_t p = 0; p < job->merit.place_count; p++) {
        const struct setup *setup = &job->merit.places[p].setup;
        for (size_t w = 0; w < setup->wavelength_count && goes_on; w++) {
            /* whatever it counted for */
            const struct setup_wavelength alone = {setup->wavelengths[w].wavelength, 1};
            struct setup before, after;
            struct error ignored; /* plates have no f-number, and no spots */
            const bool had_spots =
                optimize_open_setup(job, job->lens, p, &alone, 1, false, &before, &ignored);
            if (!optimize_open_setup(job, job->found, p, &alone, 1, false, &after, error)) {
                return false;
            }
            for (size_t f = 0; f < after.field_count && goes_on; f++) {
                const struct field_point *point = &after.fields[f].point;
                const double at = point->value[setup_axis(&after)];
                const bool is_angle = point->kind == FIELD_ANGLE || point->kind == FIELD_NONE;
                const struct spot_row row = {.about = optimize_about_of(job, is_first),
                                             .position = after.position,
                                             .field = is_angle ? at : NAN,
                                             .height = is_angle ? NAN : at,
                                             .wavelength = alone.wavelength,
                                             .before = had_spots ? optimize_spot_of(job, &before, f)
                                                                 : NAN,
                                             .after = optimize_spot_of(job, &after, f)};
                goes_on = run_emit(job->run, &row);
                is_first = false;
            }
        }
    }
    return true;
}

const struct sheet *const optimize_sheets[] = {
    [OPTIMIZE_ANSWER] = &answer_sheet,
    [OPTIMIZE_MERIT] = &goal_sheet,
    [OPTIMIZE_VARIABLES] = &variable_sheet,
    [OPTIMIZE_SPOTS] = &spot_sheet,
    [OPTIMIZE_GLASSES] = &optimize_glass_sheet,
    [OPTIMIZE_PLATES] = &optimize_plate_sheet,
    [OPTIMIZE_SHOWS] = NULL,
};

bool optimize_emit(struct optimize_job *job, struct error *error)
{
    static bool (*const emits[])(struct optimize_job *, struct error *) = {
        [OPTIMIZE_ANSWER] = optimize_emit_answer,   [OPTIMIZE_MERIT] = emit_merit,
        [OPTIMIZE_VARIABLES] = emit_variables,      [OPTIMIZE_SPOTS] = emit_spots,
        [OPTIMIZE_GLASSES] = optimize_emit_glasses, [OPTIMIZE_PLATES] = optimize_emit_plates};
    bool done = job->search != NULL || emits[job->input->show](job, error);
    for (size_t i = 0; i < job->kept_count && done; i++) {
        done = emits[job->input->show](&job->kept[i], error);
    }
    return done;
}
