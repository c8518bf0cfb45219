/* commands/design/tolerance_ask.c - the question of tolerance, from its options. */
/* SPDX-License-Identifier: MIT */
#include "base/parallel.h"
#include "base/quantity.h"
#include "cli/options/tolerances.h"
#include "cli/options/vary.h"
#include "commands/design/tolerance_job.h"
#include "commands/lens/focus_gaps.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* -------- what is adjusted -------- */

/* "[a,b]" behind the gaps: how far they may go, mm. */
static bool read_gap_range(struct text *text, double *low, double *high, struct error *error)
{
    const char *open = text->start + text->length;
    while (open > text->start && open[-1] != '[') {
        open--;
    }
    *low = -INFINITY;
    *high = INFINITY;
    if (open == text->start) {
        return true;
    }
    struct text inside = {open, (size_t)(text->start + text->length - open)};
    if (inside.length == 0 || inside.start[inside.length - 1] != ']') {
        return fail(error, ERROR_USAGE, "{--gap} '%.*s': a range ends with ']'", text_shown(*text),
                    text->start);
    }
    inside.length--;
    struct text first = text_cut(&inside, ',');
    if (inside.start == NULL || !quantity_read(first, &dimension_length, NULL, low, NULL, error) ||
        !quantity_read(inside, &dimension_length, NULL, high, NULL, error) ||
        !(*low <= 0 && *high >= 0)) {
        return fail(error, ERROR_USAGE,
                    "{--gap} '%.*s': a range is [a,b] in mm with a <= 0 and b >= 0",
                    text_shown(*text), text->start);
    }
    text->length = (size_t)(open - 1 - text->start);
    return true;
}

/* Gaps that move together. */
static bool add_gaps(struct tolerance_job *job, struct compensator *compensator,
                     struct error *error)
{
    struct arena *arena = job->run->arena;
    struct text text = text_of(job->input->gap);
    struct named_gap gaps[FOCUS_GAPS];
    size_t count;
    *compensator = (struct compensator){.name = job->input->gap};
    if (!read_gap_range(&text, &compensator->low, &compensator->high, error) ||
        !focus_gaps_read(text, job->lens, gaps, &count, error)) {
        return false;
    }
    const size_t positions = job->lens->position_count > 0 ? job->lens->position_count : 1;
    compensator->parts = ARENA_ARRAY(arena, count * positions, struct compensator_part);
    for (size_t i = 0; i < count; i++) {
        const size_t surface = gaps[i].gap.surface;
        const bool is_word = job->lens->surfaces[surface].thickness.variable != LENS_NONE;
        for (size_t p = 0; p < (is_word ? positions : 1); p++) {
            compensator->parts[compensator->part_count++] =
                (struct compensator_part){.what = {surface, PARAMETER_THICKNESS, 0},
                                          .position = is_word ? p : LENS_NONE,
                                          .weight = gaps[i].gap.weight};
        }
    }
    return true;
}

/* What can be adjusted in a lens that is there: gaps, decentres and tilts. */
static bool is_adjusted(enum parameter_kind kind)
{
    return kind == PARAMETER_THICKNESS || (kind >= PARAMETER_DECENTER_X && kind < PARAMETER_KINDS);
}

static bool add_adjusted(struct tolerance_job *job, struct compensator *list, size_t *count,
                         struct error *error)
{
    struct arena *arena = job->run->arena;
    const struct vary_reader reader = {.lens = job->lens,
                                       .arena = arena,
                                       .option = "adjust",
                                       .takes = is_adjusted,
                                       .only =
                                           "tolerance adjusts thicknesses, decentres and tilts"};
    struct variable *variables;
    size_t found;
    if (!vary_list(&reader, job->input->adjust, NULL, &variables, &found, error)) {
        return false;
    }
    for (size_t i = 0; i < found; i++) {
        const struct variable *one = &variables[i];
        const size_t position = one->position != LENS_NONE ? one->position : 0;
        const double now = parameter_get(lens_at_position(job->lens, position, arena), one->what);
        if (*count == TOLERANCE_COMPENSATORS) {
            return fail(error, ERROR_USAGE, "{--adjust}: at most %d things are adjusted",
                        TOLERANCE_COMPENSATORS);
        }
        if (!(one->low <= now && now <= one->high)) {
            return fail(error, ERROR_DOMAIN, "{--adjust} %s: it is %g, outside of its range",
                        one->name, now);
        }
        /* two that move one thing would share its movement as they like */
        for (size_t k = 0; k < *count; k++) {
            for (size_t a = 0; a < list[k].part_count; a++) {
                const struct compensator_part *other = &list[k].parts[a];
                const bool meets = one->position == other->position || one->position == LENS_NONE ||
                                   other->position == LENS_NONE;
                if (meets && parameter_is_same(other->what, one->what)) {
                    return fail(error, ERROR_USAGE,
                                "{--adjust} %s is adjusted already, by %s: once is enough",
                                one->name, list[k].name);
                }
            }
        }
        struct compensator_part *part = ARENA_NEW(arena, struct compensator_part);
        *part = (struct compensator_part){one->what, one->position, 1};
        list[(*count)++] =
            (struct compensator){part, 1, one->low - now, one->high - now, one->name};
    }
    return true;
}

/* -------- the criterion -------- */

/* A figure above 0, of --limit or --drop. Numbers have no units: that of a criterion, as it is
   printed, is for people. */
static bool read_figure(const char *what, const char *typed, enum criterion_kind kind,
                        double *figure, struct error *error)
{
    const struct criterion_type *type = criterion_type(kind);
    const struct text text = text_of(typed);
    const bool is_length = type->dimension == &dimension_length;
    const struct unit *unit = is_length ? unit_find(type->dimension, text_of(type->unit)) : NULL;
    const double most = kind == CRITERION_MTF ? 1 : INFINITY;
    const char *printed = strcmp(type->unit, "1") == 0 ? "%" : type->unit;
    struct text bare = text;
    const size_t length = strlen(printed);
    if (type->dimension == &dimension_number && text.length > length &&
        memcmp(text.start + text.length - length, printed, length) == 0) {
        bare.length -= length;
    }
    if (!quantity_read(bare, type->dimension, unit, figure, NULL, error)) {
        return false;
    }
    *figure /= kind == CRITERION_MTF && bare.length < text.length ? 100 : 1;
    return (*figure > 0 && *figure < most && isfinite(*figure)) ||
           fail(error, ERROR_USAGE, "{--%s} '%.*s' must be %s", what, text_shown(text), text.start,
                kind == CRITERION_MTF ? "a contrast above 0 and below 1" : "finite and above 0");
}

/* "worst:3", "trial:17". */
static bool ask_saved(struct tolerance_job *job, struct error *error)
{
    const struct tolerance_input *input = job->input;
    double number = 1;
    struct text rest = text_of(input->save);
    const struct text word = text_cut(&rest, ':');
    const bool is_worst = text_equal(word, "worst"), is_trial = text_equal(word, "trial");
    const double most = is_worst ? TOLERANCE_WORST_MOST : (double)input->trials;
    if ((!is_worst && !is_trial) || (is_trial && rest.start == NULL) ||
        (rest.start != NULL &&
         !quantity_read(rest, &dimension_number, NULL, &number, NULL, error)) ||
        !(number >= 1 && number <= most && number == floor(number))) {
        return fail(error, ERROR_USAGE,
                    "{--save} '%s' must be worst:COUNT, up to %d, or trial:NUMBER, up to %ld",
                    input->save, TOLERANCE_WORST_MOST, input->trials);
    }
    job->save_count = is_worst ? (long)number : 0;
    job->save_trial = is_trial ? (long)number : 0;
    return true;
}

/* What lenses are judged by, what passes, what tolerances may cost together, what is saved. */
static bool ask_criterion(struct tolerance_job *job, struct error *error)
{
    const struct tolerance_input *input = job->input;
    struct criterion *criterion = &job->question.criterion;
    const bool is_inverse = input->show == TOLERANCE_INVERSE;
    if (!criterion_read(text_of(input->criterion), job->run->arena, criterion, error)) {
        return error_prefix(error, "{--criterion}: ");
    }
    job->limit = job->drop = NAN;
    if (input->limit != NULL &&
        !read_figure("limit", input->limit, criterion->kind, &job->limit, error)) {
        return false;
    }
    const struct {
        bool is_asked;
        const char *option;
    } of_trials[] = {{input->limit != NULL, "limit"},
                     {input->save != NULL, "save"},
                     {input->part.count > 0, "part"},
                     {input->method == TOLERANCE_DIFFERENTIAL, "method"}};
    for (size_t i = 0; i < sizeof of_trials / sizeof of_trials[0]; i++) {
        if (input->show >= TOLERANCE_SENSITIVITY && of_trials[i].is_asked) {
            return fail(error, ERROR_USAGE,
                        "{--%s} is for trials, not for {--show} sensitivity, inverse and offenders",
                        of_trials[i].option);
        }
    }
    if (input->drop == NULL && is_inverse) {
        return fail(error, ERROR_USAGE,
                    "{--show} inverse needs {--drop}: how much worse a lens may be than "
                    "the nominal one");
    }
    if (input->drop != NULL && !is_inverse) {
        return fail(error, ERROR_USAGE, "{--drop} is for {--show} inverse");
    }
    if (input->drop != NULL &&
        !read_figure("drop", input->drop, criterion->kind, &job->drop, error)) {
        return false;
    }
    return input->save == NULL || ask_saved(job, error);
}

/* -------- the view -------- */

static bool ask_view(struct tolerance_job *job, struct error *error)
{
    const struct tolerance_input *input = job->input;
    const struct lens_question *asked = &input->question;
    struct merit_question *view = &job->question.view;
    const enum criterion_kind kind = job->question.criterion.kind;
    const bool has_fields = asked->fields.count > 0, has_waves = input->waves.count > 0;
    /* focal lengths are of the axis and the primary wavelength; what is adjusted looks at all */
    if ((kind == CRITERION_EFL || kind == CRITERION_BFL) && input->gap == NULL &&
        input->adjust == NULL && (has_fields || has_waves)) {
        return fail(error, ERROR_USAGE,
                    has_waves
                        ? "{--criterion} %s is of the primary wavelength of the lens: no {--%s}"
                        : "{--criterion} %s is of the axis: no {--%s}",
                    criterion_type(kind)->name, has_waves ? "wavelength" : "field");
    }
    /* trials look for no object of a real image: rays would be aimed from another than spot has */
    if (job->question.aims && !has_fields && job->lens->field_kind == FIELD_REAL) {
        fail(error, ERROR_DOMAIN,
             "{--aim} stop: the fields are heights of the real image, and trials have the "
             "directions of those from the nominal lens");
        return error_hint(error, "{--aim} nominal, or angles by {--field}");
    }
    /* the transfer function of a pupil that is cut is not there */
    if (kind == CRITERION_MTF && input->clip) {
        return fail(
            error, ERROR_USAGE,
            "{--clip} is not for {--criterion} mtf: contrast is that of the whole pupil, as "
            "with {--no-clip}");
    }
    if (!design_view(asked, &input->waves, job->run->arena, view, error)) {
        return false;
    }
    view->clip = input->clip || (!input->no_clip && kind != CRITERION_MTF);
    view->pattern = (enum pattern)input->pattern;
    view->rays = (size_t)input->rays; /* the same for any seed */
    view->watch = job->run->watch;
    return true;
}

/* -------- the job -------- */

bool tolerance_ask(struct tolerance_job *job, struct error *error)
{
    const struct tolerance_input *input = job->input;
    struct tolerance_question *question = &job->question;
    struct arena *arena = job->run->arena;
    struct compensator *list = ARENA_ARRAY(arena, TOLERANCE_COMPENSATORS + 1, struct compensator);
    job->lens = input->question.lens.lens;
    question->refocus = (enum tolerance_refocus)input->refocus;
    question->aims = input->aim == TOLERANCE_AIM_STOP;
    question->compensators = list;
    if (!ask_criterion(job, error) || !ask_view(job, error) ||
        (input->gap != NULL && !add_gaps(job, &list[question->compensator_count++], error)) ||
        (input->adjust != NULL && !add_adjusted(job, list, &question->compensator_count, error))) {
        return false;
    }
    const struct tolerances_reader reader = {job->lens, job->run->db, arena};
    const char *grade = tolerances_grade(job->lens, input->grade, input->tolerances);
    if (!tolerances_of(&reader, grade, input->tolerances, &job->perturbations, &job->made, error)) {
        return false;
    }
    question->perturbations = job->perturbations.list;
    question->perturbation_count = job->perturbations.count;
    job->trials = (struct tolerance_run){.question = question,
                                         .of = (enum tolerance_of)input->of,
                                         .limit = job->limit,
                                         .seed = (uint64_t)input->seed,
                                         .end = (uint64_t)input->trials,
                                         .total = (uint64_t)input->trials,
                                         .threads = parallel_threads(input->threads),
                                         .watch = job->run->watch};
    return true;
}
