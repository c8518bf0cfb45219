/* design/optimize_begin.c - from a lens that cannot be judged to one that can. */
/* SPDX-License-Identifier: MIT */
#include "design/optimize.h"

#include "base/constants.h"
#include "design/merit/merit_beams.h"

#include <math.h>
#include <string.h>

enum { STAGES = 40, ITERATIONS = 24 };

/* A way on which so many stages bring less than this of aperture and field does not end in time. */
enum { CRAWL = 6 };
static const double least_growth = 0.05;

/* Of aperture and fields at first, the largest first; below the last there is nothing to see. */
static const double shares[] = {1, 0.85, 0.7, 0.55, 0.4, 0.28, 0.2, 0.1, 0.05};

/* How much more is tried, and what is too little to be tried. */
static const double first_step = 0.15, least_step = 0.01;

/* What is left of the pupil at the edge of the field where nothing goes on without vignetting. */
static const double vignetted[] = {0.75, 0.5};

/* The largest angle of rays on the way, rad. */
static const double most_grazing = 70 * RADIANS_PER_DEGREE;

/* Which numbers of aspheres vary: one that bends the edge of a small aperture well tells nothing
   of a larger one. */
enum easing_freedom { FREE_SPHERES, FREE_FOURTH_ORDER, FREE_ALL };

/* What of a lens is judged: shares of the whole. */
enum easing_part { PART_APERTURE, PART_FIELD, PART_PUPIL_AT_EDGE, EASING_PARTS };
struct easing_share {
    double of[EASING_PARTS];
};

/* Continuation from a merit of less of the lens to the real one, and how far it is. */
struct continuation {
    const struct optimize_task *task;
    struct arena *arena;
    double *numbers;   /* where it is */
    struct arena room; /* of that merit: emptied for the next */
    struct merit merit;
    struct easing_share share;   /* of that merit; 0: none with all goals has had a value */
    double step;                 /* of the shares: grows and shrinks */
    enum easing_freedom freedom; /* of the numbers */
    bool *is_held;               /* the others */
    double *residuals;           /* of the real merit */
    bool is_done, is_stopped;    /* the real one has a value; by the caller */
    double refused;              /* share of the fields tried last of which a goal cannot be had */
    bool has_wanted_beam;        /* that of the focal length that is wanted, for the lens's own */
};

/* -------- a merit of less -------- */

/* The same goals, with rays kept as far from loss as a step more of the lens needs it, unless they
   are not to be kept at all. */
static struct operand *easing_operands(const struct operand *operands, size_t count,
                                       struct arena *arena)
{
    struct operand *list = ARENA_ARRAY(arena, count, struct operand);
    for (size_t i = 0; i < count; i++) {
        list[i] = operands[i];
        if (list[i].kind == OPERAND_GRAZING && list[i].target < 90 * RADIANS_PER_DEGREE) {
            list[i].target = fmin(list[i].target, most_grazing);
        }
    }
    return list;
}

/* Some goals of some of the lens. */
static bool easing_open(struct continuation *easing, const struct easing_share *share,
                        const struct operand *operands, size_t count, struct error *error)
{
    const struct merit *merit = easing->task->merit;
    const struct setup *setup = &merit->places[0].setup;
    struct merit_question question = merit->question;
    arena_reset(&easing->room, (struct arena_mark){NULL, 0});
    struct setup_field *fields =
        ARENA_ARRAY(&easing->room, setup->field_count + 1, struct setup_field);
    for (size_t i = 0; i < setup->field_count; i++) {
        fields[i] = setup->fields[i];
        fields[i].point.value[0] *= share->of[PART_FIELD];
        fields[i].point.value[1] *= share->of[PART_FIELD];
    }
    question.fields = fields;
    question.field_count = setup->field_count;
    question.operands = easing_operands(operands, count, &easing->room);
    question.operand_count = count;
    question.vignetting = 1 - share->of[PART_PUPIL_AT_EDGE];
    if (!merit_open(&question, &easing->room, &easing->merit, error)) {
        return false;
    }
    easing->has_wanted_beam = merit_aperture_of_wanted(&easing->merit);
    easing->merit.forgets = merit->forgets;
    for (size_t i = 0; i < easing->merit.place_count; i++) {
        struct aperture_setting *aperture = &easing->merit.places[i].aperture;
        aperture->value *= aperture->kind == APERTURE_FNUMBER ? 1 / share->of[PART_APERTURE]
                                                              : share->of[PART_APERTURE];
    }
    return true;
}

static bool easing_has_value(struct continuation *easing)
{
    double *residuals = ARENA_ARRAY(&easing->room, easing->merit.residual_count + 1, double);
    return merit_evaluate(&easing->merit, easing->numbers, residuals, NULL);
}

/* All goals. Result: they have a value; else nothing has changed but the merit */
static bool easing_try(struct continuation *easing, struct easing_share share, struct error *error)
{
    const struct merit_question *question = &easing->task->merit->question;
    const bool is_open =
        easing_open(easing, &share, question->operands, question->operand_count, error);
    easing->refused = is_open ? 0 : share.of[PART_FIELD];
    if (!is_open) {
        return false;
    }
    if (!easing_has_value(easing)) {
        *error = easing->merit.why;
        return false;
    }
    easing->share = share;
    return true;
}

static bool easing_is_whole(const struct continuation *easing)
{
    return easing->share.of[PART_APERTURE] > 0;
}

/* Goals that have a value by themselves. */
static bool easing_open_some(struct continuation *easing, struct error *error)
{
    const struct merit_question *question = &easing->task->merit->question;
    struct operand *some = ARENA_ARRAY(easing->arena, question->operand_count, struct operand);
    size_t count = 0;
    bool has_rays = false;
    const double least = shares[sizeof shares / sizeof shares[0] - 1];
    const struct easing_share little = {{least, least, 1}};
    for (size_t i = 0; i < question->operand_count; i++) {
        some[count] = question->operands[i];
        /* one of a position that is not optimised is none */
        if (some[count].kind != OPERAND_GRAZING &&
            easing_open(easing, &little, &some[count], 1, error) && easing_has_value(easing)) {
            has_rays = has_rays || (operand_type(some[count].kind)->is & OPERAND_TRACES) != 0;
            count++;
        }
    }
    /* What keeps rays from loss looks at those of other goals. */
    for (size_t i = 0; i < question->operand_count && has_rays; i++) {
        if (question->operands[i].kind == OPERAND_GRAZING) {
            some[count++] = question->operands[i];
        }
    }
    return count > 0 && easing_open(easing, &little, some, count, error) &&
           easing_has_value(easing);
}

/* -------- as much as goes -------- */

/* The largest share of aperture and field that has a value, and is more than there was. */
static bool easing_open_most(struct continuation *easing, double pupil, struct error *error)
{
    const double had = easing->share.of[PART_APERTURE] + easing->share.of[PART_FIELD];
    for (size_t i = 0; i < sizeof shares / sizeof shares[0]; i++) {
        const struct easing_share share = {{shares[i], shares[i], pupil}}, before = easing->share;
        if (!(2 * shares[i] > had)) {
            break;
        }
        const bool has_value = easing_try(easing, share, error);
        /* all of it is what has no value, but for a beam that is another */
        if (has_value && (shares[i] * pupil < 1 || easing->has_wanted_beam)) {
            return true;
        }
        easing->share = before;
        if (easing->refused > 0) {
            break;
        }
    }
    return false;
}

/* A step more of the first parts of a share together, or of one of them, as small as need be. */
static bool easing_step(struct continuation *easing, struct easing_share from, int parts)
{
    struct easing_share all = from;
    struct error ignored;
    for (; easing->step >= least_step; easing->step /= 2) {
        bool found = false;
        for (int i = 0; i < parts; i++) {
            all.of[i] = fmin(1, from.of[i] + easing->step);
            found = found || all.of[i] > from.of[i]; /* there is more */
        }
        found = found && easing_try(easing, all, &ignored);
        for (int i = 0; i < parts && !found; i++) {
            struct easing_share one = from;
            one.of[i] = all.of[i];
            found = one.of[i] > from.of[i] && easing_try(easing, one, &ignored);
        }
        if (found) {
            easing->step *= 2;
            return true;
        }
    }
    easing->step = first_step;
    return false;
}

/* More of aperture and field, with vignetting. */
static bool easing_vignette(struct continuation *easing)
{
    struct easing_share from = easing->share;
    struct error ignored;
    for (size_t i = 0; i < sizeof vignetted / sizeof vignetted[0]; i++) {
        if (!(vignetted[i] < easing->share.of[PART_PUPIL_AT_EDGE])) {
            continue;
        }
        from.of[PART_PUPIL_AT_EDGE] = vignetted[i];
        if (easing_open_most(easing, vignetted[i], &ignored) ||
            easing_step(easing, from, PART_PUPIL_AT_EDGE)) {
            return true;
        }
    }
    return false;
}

/* -------- which numbers vary -------- */

static enum easing_freedom easing_freedom_of(struct parameter what)
{
    if (what.kind == PARAMETER_CONIC || (what.kind == PARAMETER_COEFFICIENT && what.order <= 4)) {
        return FREE_FOURTH_ORDER;
    }
    return what.kind == PARAMETER_COEFFICIENT ? FREE_ALL : FREE_SPHERES;
}

/* Hold what is not free. Result: how many are held */
static size_t easing_hold(struct continuation *easing)
{
    const struct variables *variables = easing->task->merit->question.variables;
    size_t count = 0;
    for (size_t j = 0; j < variables->count; j++) {
        easing->is_held[j] = easing_freedom_of(variables->list[j].what) > easing->freedom;
        count += easing->is_held[j];
    }
    return count;
}

/* Let more of them vary. */
static bool easing_free(struct continuation *easing)
{
    const size_t held = easing_hold(easing);
    for (size_t left = held; left == held && left > 0;) {
        easing->freedom++;
        left = easing_hold(easing);
    }
    return held > 0;
}

/* The merit for the solver, to which what is held does nothing. */
static bool easing_measure(void *context, const double *numbers, double *residuals,
                           double *jacobian)
{
    struct continuation *easing = context;
    const size_t columns = easing->merit.variable_count;
    const bool has_value = merit_measure(&easing->merit, numbers, residuals, jacobian);
    for (size_t i = 0; i < easing->merit.residual_count && has_value && jacobian != NULL; i++) {
        for (size_t j = 0; j < columns; j++) {
            jacobian[i * columns + j] *= easing->is_held[j] ? 0 : 1;
        }
    }
    return has_value;
}

/* -------- stages -------- */

struct solver_problem optimize_problem(struct merit *merit)
{
    const struct variables *variables = merit->question.variables;
    return (struct solver_problem){.parameter_count = merit->variable_count,
                                   .residual_count = merit->residual_count,
                                   .exact_count = merit->exact_count,
                                   .evaluate = merit_measure,
                                   .sides = merit->sides,
                                   .context = merit,
                                   .low = variables->low,
                                   .high = variables->high,
                                   .scale = variables->scale};
}

/* Until the real merit has a value. */
static bool easing_goes_on(void *context, const struct solver_progress *progress)
{
    struct continuation *easing = context;
    const struct optimize_task *task = easing->task;
    if (merit_evaluate(task->merit, progress->parameters, easing->residuals, NULL)) {
        memcpy(easing->numbers, progress->parameters, task->merit->variable_count * sizeof(double));
        easing->is_done = true;
        return false;
    }
    easing->is_stopped = task->goes_on != NULL && !task->goes_on(task->context);
    return !easing->is_stopped;
}

static bool easing_descend(struct continuation *easing, struct error *error)
{
    struct merit *merit = &easing->merit;
    const struct solver_options options = {.iterations = ITERATIONS,
                                           .function = 1e-4,
                                           .lean = true,
                                           .progress = easing_goes_on,
                                           .progress_context = easing};
    struct solver_problem problem = optimize_problem(merit);
    double *numbers = ARENA_ARRAY(&easing->room, merit->variable_count + 1, double);
    struct solver_summary summary;
    problem.evaluate = easing_measure;
    problem.context = easing;
    memcpy(numbers, easing->numbers, merit->variable_count * sizeof(double));
    if (!solver_run(&problem, &options, numbers, &easing->room, &summary, error)) {
        return false;
    }
    if (!easing->is_done) {
        memcpy(easing->numbers, numbers, merit->variable_count * sizeof(double));
    }
    return true;
}

/* What is judged next: more than before, or the same with more that varies. Result: false: nothing
   is left */
static bool easing_go_on(struct continuation *easing)
{
    const bool is_whole = easing_is_whole(easing);
    struct error ignored;
    return easing_open_most(easing, is_whole ? easing->share.of[PART_PUPIL_AT_EDGE] : 1,
                            &ignored) ||
           (is_whole &&
            (easing_step(easing, easing->share, EASING_PARTS) || easing_vignette(easing) ||
             (easing_free(easing) && easing_try(easing, easing->share, &ignored))));
}

/* With what it is begun. */
static const char *easing_words(const struct continuation *easing)
{
    if (!easing_is_whole(easing)) {
        return "not all goals have a value at the start: it was begun with those that have one";
    }
    if (!(easing->share.of[PART_APERTURE] < 1)) {
        return "the lens has no power at the start: it was begun with the beam of the focal length "
               "that is wanted";
    }
    return arena_printf(easing->arena,
                        "rays were lost at the start: it was begun with %.0f %% of aperture and "
                        "field",
                        100 * easing->share.of[PART_APERTURE]);
}

/* Why the lens cannot be judged: no goal has a value, or not enough of them have. */
static bool fail_partial(const struct continuation *easing, const struct error *why,
                         struct error *error)
{
    if (merit_lacks_power(easing->task->merit)) {
        fail(error, ERROR_DOMAIN,
             "the lens has no power, and nothing says what its focal length is to be");
        return error_hint(error, "give a goal such as efl = 100, or the line 'stated efl 100'");
    }
    *error = *why;
    return error_prefix(error, "the lens cannot be judged as it is: ");
}

/*
 * The first merit that has a value.
 *
 * Given     why  the lens cannot be judged
 * Errors    a goal that cannot be had of less of the lens; that
 */
static bool easing_begin(struct continuation *easing, const struct error *why, struct error *error)
{
    if (easing_open_most(easing, 1, error)) {
        return true;
    }
    if (easing->refused > 0) {
        return error_prefix(error,
                            "the lens cannot be judged as it is: %s; with %.0f %% of the "
                            "field: ",
                            why->message, 100 * easing->refused);
    }
    return easing_open_some(easing, error) || fail_partial(easing, why, error);
}

/* Numbers of aspheres as the lens has them: by chance they bend surfaces beyond all use. Result:
   they were others */
static bool easing_reset_aspheres(const struct variables *variables, double *numbers)
{
    bool changed = false;
    for (size_t j = 0; j < variables->count; j++) {
        if (easing_freedom_of(variables->list[j].what) != FREE_SPHERES) {
            changed = changed || numbers[j] != variables->start[j];
            numbers[j] = variables->start[j];
        }
    }
    return changed;
}

/* Why it cannot be judged, though it was begun. */
static bool fail_easing(const struct continuation *easing, const struct error *why,
                        struct error *error)
{
    *error = *why;
    if (easing->is_stopped) {
        return error_prefix(error, "stopped before the lens became one that can be judged: ");
    }
    if (!easing_is_whole(easing)) {
        return fail_partial(easing, why, error);
    }
    if (error->hint[0] == '\0') {
        error_hint(error, "begin with a larger f-number, smaller fields or other numbers");
    }
    return error_prefix(error, "the lens cannot be judged as it is, nor after it was made better "
                               "with less aperture and field: ");
}

/* From stage to stage, until the real merit has a value. */
static bool easing_run(struct continuation *easing, const struct error *why, const char **words,
                       struct error *error)
{
    if (!easing_begin(easing, why, error)) {
        return false;
    }
    *words = easing_words(easing);
    bool goes_on = true;
    double reached[STAGES];
    for (int stage = 0; stage < STAGES && goes_on; stage++) {
        if (!easing_descend(easing, error)) {
            return false;
        }
        reached[stage] = easing->share.of[PART_APERTURE] + easing->share.of[PART_FIELD];
        const bool crawls =
            stage >= CRAWL && reached[stage] - reached[stage - CRAWL] < least_growth;
        goes_on = !easing->is_done && !easing->is_stopped && !crawls && easing_go_on(easing);
    }
    return easing->is_done || fail_easing(easing, why, error);
}

bool optimize_begin(const struct optimize_task *task, double *numbers, struct arena *arena,
                    const char **words, struct error *error)
{
    struct merit *merit = task->merit;
    const struct variables *variables = merit->question.variables;
    struct continuation easing = {.task = task,
                                  .arena = arena,
                                  .numbers = numbers,
                                  .step = first_step,
                                  .is_held = ARENA_ARRAY(arena, merit->variable_count + 1, bool),
                                  .residuals =
                                      ARENA_ARRAY(arena, merit->residual_count + 1, double)};
    struct error why;
    *words = NULL;
    if (merit_evaluate(merit, numbers, easing.residuals, NULL)) {
        return true;
    }
    why = merit->why;
    if (easing_reset_aspheres(variables, numbers) &&
        merit_evaluate(merit, numbers, easing.residuals, NULL)) {
        return true;
    }
    easing_hold(&easing);
    const bool done = easing_run(&easing, &why, words, error);
    arena_free(&easing.room);
    return done;
}
