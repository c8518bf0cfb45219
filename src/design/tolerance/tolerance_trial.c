/* design/tolerance/tolerance_trial.c - one lens as it may be made, adjusted and judged. */
/* SPDX-License-Identifier: MIT */
#include "design/tolerance/tolerance_trial.h"

#include "design/merit/merit_mtf.h"
#include "design/merit/merit_paraxial.h"

#include <math.h>
#include <string.h>

/* Figures of rays, which are found with the quality. */
static bool is_of_rays(const struct tolerance *tolerance)
{
    return criterion_type(tolerance->question.criterion.kind)->operand == OPERAND_KINDS;
}

static struct parameter last_gap(const struct lens *lens)
{
    return (struct parameter){lens->surface_count - 1, PARAMETER_THICKNESS, 0};
}

/* -------- adjusting -------- */

/* The image plane goes on by s, in every position. */
static void shift_image(struct tolerance *tolerance, double s)
{
    const struct parameter last = last_gap(tolerance->lens);
    for (size_t p = 0; p < tolerance->perturbed.position_count && s != 0; p++) {
        struct lens_numbers *lens = &tolerance->variables.lenses[p];
        lens_numbers_set(lens, last, parameter_get(&lens->lens, last) + s);
    }
}

/* The numbers that compensators change, as the lens was made. */
static void read_base(struct tolerance *tolerance)
{
    for (size_t i = 0; i < tolerance->variables.count; i++) {
        const struct variable *one = &tolerance->variables.list[i];
        const size_t position = one->position != LENS_NONE ? one->position : 0;
        tolerance->base[i] = parameter_get(&tolerance->variables.lenses[position].lens, one->what);
    }
}

/* And with movements: one number may be part of several. */
static void set_numbers(struct tolerance *tolerance, const double *moves)
{
    size_t at = 0;
    memcpy(tolerance->numbers, tolerance->base, tolerance->variables.count * sizeof(double));
    for (size_t i = 0; i < tolerance->mover_count; i++) {
        for (size_t k = 0; k < tolerance->movers[i].part_count; k++) {
            const struct compensator_part *part = &tolerance->movers[i].parts[k];
            tolerance->numbers[tolerance->of_part[at++]] += part->weight * moves[i];
        }
    }
}

/* solver_function of the movements. */
static bool adjusted(void *context, const double *moves, double *residuals, double *jacobian)
{
    struct tolerance *tolerance = context;
    const size_t count = tolerance->variables.count;
    set_numbers(tolerance, moves);
    if (!merit_evaluate(&tolerance->quality, tolerance->numbers, residuals,
                        jacobian != NULL ? tolerance->jacobian : NULL)) {
        return false;
    }
    for (size_t r = 0; jacobian != NULL && r < tolerance->quality.residual_count; r++) {
        const double *row = tolerance->jacobian + r * count;
        size_t at = 0;
        for (size_t i = 0; i < tolerance->mover_count; i++) {
            double slope = 0;
            for (size_t k = 0; k < tolerance->movers[i].part_count; k++) {
                slope += tolerance->movers[i].parts[k].weight * row[tolerance->of_part[at++]];
            }
            jacobian[r * tolerance->mover_count + i] = slope;
        }
    }
    return true;
}

/* Changes that are alike: 1 mm, and half a degree. */
static double alike_change(const struct compensator *mover)
{
    const bool is_angle = (parameter_type(mover->parts[0].what.kind)->is & PARAMETER_IS_ANGLE) != 0;
    return is_angle ? 0.01 : 1;
}

bool tolerance_check_movers(struct tolerance *tolerance, struct arena *arena, struct error *error)
{
    static const double least = 1e-9; /* mm, or waves, of the root of the sum of squares */
    const size_t count = tolerance->mover_count, rows = tolerance->quality.residual_count;
    double *jacobian = ARENA_ARRAY(arena, rows * count + 1, double);
    double moves[1 + TOLERANCE_COMPENSATORS] = {0};
    read_base(tolerance);
    if (count == 0) {
        return true;
    }
    if (!adjusted(tolerance, moves, tolerance->residuals, jacobian)) {
        *error = tolerance->quality.why;
        return false;
    }
    for (size_t i = 0; i < count; i++) {
        double sum = 0;
        for (size_t r = 0; r < rows; r++) {
            sum += jacobian[r * count + i] * jacobian[r * count + i];
        }
        if (!(sqrt(sum) * alike_change(&tolerance->movers[i]) > least)) {
            return fail(error, ERROR_DOMAIN, "%s cannot adjust anything: rays do not depend on it",
                        tolerance->movers[i].name);
        }
    }
    return true;
}

/* By damped least squares. */
static bool adjust(struct tolerance *tolerance, double *moves, struct error *error)
{
    enum { ITERATIONS = 50 };
    double low[1 + TOLERANCE_COMPENSATORS], high[1 + TOLERANCE_COMPENSATORS];
    double found[1 + TOLERANCE_COMPENSATORS] = {0}, scale[1 + TOLERANCE_COMPENSATORS];
    const size_t count = tolerance->mover_count;
    const size_t first = tolerance->question.refocus == REFOCUS_BEST ? 0 : 1;
    struct solver_summary summary;
    for (size_t i = 0; i < count; i++) {
        low[i] = tolerance->movers[i].low;
        high[i] = tolerance->movers[i].high;
        scale[i] = alike_change(&tolerance->movers[i]);
    }
    const struct solver_problem problem = {.parameter_count = count,
                                           .residual_count = tolerance->quality.residual_count,
                                           .evaluate = adjusted,
                                           .context = tolerance,
                                           .low = low,
                                           .high = high,
                                           .scale = scale};
    const struct solver_options options = {.iterations = ITERATIONS, .lean = true};
    arena_reset(&tolerance->within, (struct arena_mark){NULL, 0});
    if (!solver_run(&problem, &options, found, &tolerance->within, &summary, error)) {
        if (tolerance->quality.why.code != ERROR_NONE) {
            *error = tolerance->quality.why;
        }
        return false;
    }
    memcpy(moves + first, found, count * sizeof *found);
    set_numbers(tolerance, found);
    return merit_evaluate(&tolerance->quality, tolerance->numbers, tolerance->residuals, NULL) ||
           (*error = tolerance->quality.why, false);
}

/* -------- figures -------- */

/* Spots of all places, with the image plane where it is. */
static bool find_spots(struct tolerance *tolerance, struct error *error)
{
    struct merit *merit = &tolerance->quality;
    struct merit_spot *spots = tolerance->spots;
    for (size_t i = 0; i < merit->slot_count; i++) {
        if (!merit_spots_find(merit, &merit->slots[i], tolerance->lines[i], spots)) {
            *error = merit->why;
            return false;
        }
        spots += merit->slots[i].beams->bundle.wish.field_count;
    }
    return true;
}

/* From the image plane to the paraxial image of the first position. */
static bool paraxial_shift(struct merit *merit, double *s, struct error *error)
{
    const struct merit_figures *figures = merit_figures(merit, &merit->slots[0], NAN);
    if (figures == NULL) {
        *error = merit->why;
        return false;
    }
    const struct lens *lens = merit->places[0].lens;
    *s = figures->first.image.value - parameter_get(lens, last_gap(lens));
    return isfinite(*s) || fail(error, ERROR_DOMAIN, "the paraxial image is infinitely far away");
}

/* RMS of fields from the residuals of wave fronts. */
static void sum_waves(const struct tolerance *tolerance, double *figures)
{
    const struct merit *merit = &tolerance->quality;
    for (size_t i = 0; i < merit->slot_count; i++) {
        const struct merit_bundle *bundle = &merit->slots[i].beams->bundle;
        const struct bundle_wish *wish = &bundle->wish;
        const double *residuals = tolerance->residuals + merit->slots[i].first;
        double weights = 0;
        for (size_t k = 0; k < wish->wavelength_count; k++) {
            weights += wish->wavelengths[k].weight;
        }
        memset(figures, 0, wish->field_count * sizeof *figures);
        for (size_t g = 0; g < bundle->group_count; g++) {
            const struct bundle_group *group = &bundle->groups[g];
            for (size_t k = 0; k < group->points.count; k++) {
                const double r = residuals[group->row + k];
                figures[group->field] += r * r;
            }
        }
        for (size_t f = 0; f < wish->field_count; f++) {
            figures[f] = sqrt(figures[f] / (weights * wish->fields[f].weight));
        }
        figures += wish->field_count;
    }
}

/* Figures of spots that lie s behind the image plane. */
static void judge_spots(const struct tolerance *tolerance, double s, double *figures)
{
    for (size_t i = 0; i < tolerance->figure_count; i++) {
        const struct merit_spot *spot = &tolerance->spots[tolerance->figures[i].spot];
        const double *rest = tolerance->rest[i];
        if (tolerance->question.criterion.kind == CRITERION_BORESIGHT) {
            figures[i] = hypot(spot->centroid[0] + s * spot->drift[0] - rest[0],
                               spot->centroid[1] + s * spot->drift[1] - rest[1]);
        } else {
            const double square = spot->at + s * (2 * spot->by + s * spot->bend);
            figures[i] = sqrt(fmax(square, 0));
        }
    }
}

static bool judge_operands(struct tolerance *tolerance, double *figures, struct error *error)
{
    struct merit *merit = &tolerance->judge;
    merit->forgets = true; /* chief rays do not depend on the lens before */
    if (!merit_evaluate(merit, tolerance->numbers, tolerance->judged, NULL)) {
        *error = merit->why;
        return false;
    }
    const bool is_contrast = tolerance->question.criterion.kind == CRITERION_MTF;
    for (size_t f = 0; f < tolerance->figure_count; f++) {
        figures[f] = is_contrast ? merit_mtf_contrast(merit->values[f]) : merit->values[f];
    }
    return true;
}

/* -------- a trial -------- */

/* The image plane alone. */
static bool try_closed(struct tolerance *tolerance, struct tolerance_trial *trial)
{
    const enum tolerance_refocus refocus = tolerance->question.refocus;
    struct merit *merit = &tolerance->quality;
    double s = 0, by = 0, bend = 0;
    if (merit->slot_count > 0) {
        merit_put_lens(merit, tolerance->numbers, false);
        if (!find_spots(tolerance, &trial->why) ||
            (refocus == REFOCUS_PARAXIAL && !paraxial_shift(merit, &s, &trial->why))) {
            return false;
        }
        /* where spots are best by least squares; weights are those of fields */
        const struct merit_spot *spot = tolerance->spots;
        for (size_t i = 0; i < merit->slot_count; i++) {
            const struct bundle_wish *wish = &merit->slots[i].beams->bundle.wish;
            for (size_t f = 0; f < wish->field_count; f++, spot++) {
                by += wish->fields[f].weight * spot->by;
                bend += wish->fields[f].weight * spot->bend;
            }
        }
        s = refocus == REFOCUS_BEST ? -by / bend : s;
        if (!isfinite(s)) {
            return fail(&trial->why, ERROR_DOMAIN, "there is no best focus");
        }
    }
    trial->moves[0] = s;
    if (is_of_rays(tolerance)) {
        judge_spots(tolerance, s, trial->figures);
        return true;
    }
    shift_image(tolerance, s);
    return judge_operands(tolerance, trial->figures, &trial->why);
}

static bool try_open(struct tolerance *tolerance, struct tolerance_trial *trial)
{
    struct merit *merit = &tolerance->quality;
    read_base(tolerance);
    if (tolerance->question.refocus == REFOCUS_PARAXIAL) {
        merit_put_lens(merit, tolerance->base, false);
        if (!paraxial_shift(merit, &trial->moves[0], &trial->why)) {
            return false;
        }
        shift_image(tolerance, trial->moves[0]);
        read_base(tolerance);
    }
    if (tolerance->mover_count > 0) {
        if (!adjust(tolerance, trial->moves, &trial->why)) {
            return false;
        }
    } else if (!merit_evaluate(merit, tolerance->base, tolerance->residuals, NULL)) {
        trial->why = merit->why;
        return false;
    }
    if (!is_of_rays(tolerance)) {
        return judge_operands(tolerance, trial->figures, &trial->why);
    }
    if (tolerance_looks_at_waves(&tolerance->question)) {
        sum_waves(tolerance, trial->figures);
        return true;
    }
    if (!find_spots(tolerance, &trial->why)) {
        return false;
    }
    judge_spots(tolerance, 0, trial->figures);
    return true;
}

bool tolerance_trial(struct tolerance *tolerance, const double *errors,
                     struct tolerance_trial *trial)
{
    trial->why.code = ERROR_NONE;
    memset(trial->moves, 0, tolerance_moves(tolerance) * sizeof *trial->moves);
    perturbed_put(&tolerance->perturbed, errors);
    for (size_t i = 0; i < tolerance->irregularity_count; i++) {
        const size_t from = tolerance->irregular[i];
        tolerance->irregular_amounts[i] =
            errors[from] * tolerance->question.perturbations[from].amount * TOLERANCE_WAVE_MM;
    }
    const bool found =
        tolerance->closed ? try_closed(tolerance, trial) : try_open(tolerance, trial);
    bool is_finite = found;
    for (size_t i = 0; i < tolerance->figure_count && is_finite; i++) {
        is_finite = isfinite(trial->figures[i]);
    }
    return is_finite || (found && fail(&trial->why, ERROR_DOMAIN, "a figure is not finite"));
}

struct lens *tolerance_lens(struct tolerance *tolerance, const struct tolerance_trial *trial,
                            struct arena *arena)
{
    const struct setup *setup = &tolerance_view(tolerance)->places[0].setup;
    const struct lens *lens = tolerance->lens;
    double *wavelengths =
        ARENA_ARRAY(arena, setup->wavelength_count + lens->wavelength_count + 1, double);
    size_t count = 0;
    wavelengths[count++] = lens_primary_wavelength(lens);
    for (size_t i = 0; i < setup->wavelength_count; i++) {
        wavelengths[count++] = setup->wavelengths[i].wavelength;
    }
    for (size_t i = 0; i < lens->wavelength_count; i++) {
        wavelengths[count++] = lens->wavelengths[i].wavelength;
    }
    if (tolerance->closed && is_of_rays(tolerance)) {
        shift_image(tolerance, trial->moves[0]);
    }
    return perturbed_lens(&tolerance->perturbed, wavelengths, count, arena);
}

/* second_order_problem.trial */
static bool try_errors(void *context, const double *errors, double *figures, struct error *why)
{
    struct tolerance *tolerance = context;
    struct tolerance_trial trial = {.figures = figures, .moves = figures + tolerance->figure_count};
    if (!tolerance_trial(tolerance, errors, &trial)) {
        *why = trial.why;
        return false;
    }
    return true;
}

struct second_order_problem tolerance_problem(struct tolerance *tolerance, struct watch *watch,
                                              struct arena *arena, double **nominal)
{
    const struct tolerance_question *question = &tolerance->question;
    const enum criterion_kind kind = question->criterion.kind;
    const size_t figures = tolerance->figure_count, all = figures + tolerance_moves(tolerance);
    bool *roots = ARENA_ARRAY(arena, all, bool);
    const char **names = ARENA_ARRAY(arena, question->perturbation_count + 1, const char *);
    for (size_t f = 0; f < figures; f++) {
        roots[f] =
            kind == CRITERION_SPOT || kind == CRITERION_WAVEFRONT || kind == CRITERION_BORESIGHT;
    }
    for (size_t i = 0; i < question->perturbation_count; i++) {
        names[i] = question->perturbations[i].name;
    }
    if (nominal != NULL) {
        *nominal = ARENA_ARRAY(arena, all, double);
        memcpy(*nominal, tolerance->nominal, figures * sizeof(double));
        memcpy(*nominal + figures, tolerance->nominal_moves, (all - figures) * sizeof(double));
    }
    watch_begin(watch, "trials", 0);
    return (struct second_order_problem){.trial = try_errors,
                                         .context = tolerance,
                                         .error_count = question->perturbation_count,
                                         .figure_count = all,
                                         .judged_count = figures,
                                         .is_root = roots,
                                         .names = names,
                                         .watch = watch};
}
