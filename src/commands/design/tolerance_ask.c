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
static bool tolerance_ask_read_range(struct text *text, double *low, double *high,
                                     struct error *error)
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
    if (!tolerance_ask_read_range(&text, &compensator->low, &compensator->high, error) ||
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

/* Two that move one thing would share its movement as they like. */
static bool check_twice(const struct compensator *list, size_t count, struct error *error)
{
    const struct compensator *last = &list[count - 1];
    for (size_t i = 0; i + 1 < count; i++) {
        for (size_t a = 0; a < list[i].part_count; a++) {
            for (size_t b = 0; b < last->part_count; b++) {
                const struct compensator_part *one = &list[i].parts[a], *other = &last->parts[b];
                const bool meets = one->position == other->position || one->position == LENS_NONE ||
                                   other->position == LENS_NONE;
                if (meets && parameter_is_same(one->what, other->what)) {
                    return fail(error, ERROR_USAGE,
                                "{--adjust} %s is adjusted already, by %s: once is enough",
                                last->name, list[i].name);
                }
            }
        }
    }
    return true;
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
        struct compensator_part *part = ARENA_NEW(arena, struct compensator_part);
        *part = (struct compensator_part){one->what, one->position, 1};
        list[(*count)++] =
            (struct compensator){part, 1, one->low - now, one->high - now, one->name};
        if (!check_twice(list, *count, error)) {
            return false;
        }
    }
    return true;
}

static bool ask_compensators(struct tolerance_job *job, struct error *error)
{
    struct compensator *list =
        ARENA_ARRAY(job->run->arena, TOLERANCE_COMPENSATORS + 1, struct compensator);
    size_t count = 0;
    if (job->input->gap != NULL && !add_gaps(job, &list[count++], error)) {
        return false;
    }
    if (job->input->adjust != NULL && !add_adjusted(job, list, &count, error)) {
        return false;
    }
    job->question.compensators = list;
    job->question.compensator_count = count;
    return true;
}

/* -------- the criterion -------- */

/* Numbers have no units: that of a criterion, as it is printed, is for people. */
static struct text without_unit(struct text text, const struct criterion_type *type)
{
    const char *unit = strcmp(type->unit, "1") == 0 ? "%" : type->unit;
    const size_t length = strlen(unit);
    if (type->dimension == &dimension_number && text.length > length &&
        memcmp(text.start + text.length - length, unit, length) == 0) {
        text.length -= length;
    }
    return text;
}

/* A figure above 0; by the name of what it is. */
static bool tolerance_ask_read_figure(const char *what, struct text text, enum criterion_kind kind,
                                      double *figure, struct error *error)
{
    const struct criterion_type *type = criterion_type(kind);
    const bool is_length = type->dimension == &dimension_length;
    const struct unit *unit = is_length ? unit_find(type->dimension, text_of(type->unit)) : NULL;
    const double most = kind == CRITERION_MTF ? 1 : INFINITY;
    if (!quantity_read(without_unit(text, type), type->dimension, unit, figure, NULL, error)) {
        return false;
    }
    *figure /=
        kind == CRITERION_MTF && (text.length > 0 && text.start[text.length - 1] == '%') ? 100 : 1;
    return (*figure > 0 && *figure < most && isfinite(*figure)) ||
           fail(error, ERROR_USAGE, "{--%s} '%.*s' must be %s", what, text_shown(text), text.start,
                kind == CRITERION_MTF ? "a contrast above 0 and below 1" : "finite and above 0");
}

/* "worst:3", "trial:17". */
static bool ask_saved(struct tolerance_job *job, struct error *error)
{
    double number = 1;
    if (job->input->save == NULL) {
        return true;
    }
    struct text rest = text_of(job->input->save);
    const struct text word = text_cut(&rest, ':');
    const bool is_worst = text_equal(word, "worst"), is_trial = text_equal(word, "trial");
    const double most = is_worst ? TOLERANCE_WORST_MOST : (double)job->input->trials;
    if ((!is_worst && !is_trial) || (is_trial && rest.start == NULL) ||
        (rest.start != NULL &&
         !quantity_read(rest, &dimension_number, NULL, &number, NULL, error)) ||
        !(number >= 1 && number <= most && number == floor(number))) {
        return fail(error, ERROR_USAGE,
                    "{--save} '%s' must be worst:COUNT, up to %d, or trial:NUMBER, up to %ld",
                    job->input->save, TOLERANCE_WORST_MOST, job->input->trials);
    }
    job->save_count = is_worst ? (long)number : 0;
    job->save_trial = is_trial ? (long)number : 0;
    return true;
}

/* Rows of single errors are not of trials. */
static bool ask_show(const struct tolerance_job *job, struct error *error)
{
    const struct tolerance_input *input = job->input;
    const char *wrong = input->limit != NULL                      ? "limit"
                        : input->save != NULL                     ? "save"
                        : input->part.count > 0                   ? "part"
                        : input->method == TOLERANCE_DIFFERENTIAL ? "method"
                                                                  : NULL;
    return input->show < TOLERANCE_SENSITIVITY || wrong == NULL ||
           fail(error, ERROR_USAGE,
                "{--%s} is for trials, not for {--show} sensitivity, inverse and offenders", wrong);
}

/* What tolerances may cost together, for those that are looked for. */
static bool ask_drop(struct tolerance_job *job, struct error *error)
{
    const char *drop = job->input->drop;
    const bool wants = job->input->show == TOLERANCE_INVERSE;
    job->drop = NAN;
    if (drop == NULL) {
        return !wants || fail(error, ERROR_USAGE,
                              "{--show} inverse needs {--drop}: how much worse a lens may be than "
                              "the nominal one");
    }
    return wants ? tolerance_ask_read_figure("drop", text_of(drop), job->question.criterion.kind,
                                             &job->drop, error)
                 : fail(error, ERROR_USAGE, "{--drop} is for {--show} inverse");
}

static bool ask_criterion(struct tolerance_job *job, struct error *error)
{
    struct criterion *criterion = &job->question.criterion;
    if (!criterion_read(text_of(job->input->criterion), job->run->arena, criterion, error)) {
        return error_prefix(error, "{--criterion}: ");
    }
    job->limit = NAN;
    return (job->input->limit == NULL ||
            tolerance_ask_read_figure("limit", text_of(job->input->limit), criterion->kind,
                                      &job->limit, error)) &&
           ask_show(job, error) && ask_drop(job, error) && ask_saved(job, error);
}

/* -------- the view -------- */

/* Focal lengths are of the axis and the primary wavelength; what is adjusted looks at all. */
static bool check_focal(const struct tolerance_job *job, struct error *error)
{
    const struct tolerance_input *input = job->input;
    const enum criterion_kind kind = job->question.criterion.kind;
    const bool has_fields = input->question.fields.count > 0, has_waves = input->waves.count > 0;
    if ((kind != CRITERION_EFL && kind != CRITERION_BFL) || input->gap != NULL ||
        input->adjust != NULL || !(has_fields || has_waves)) {
        return true;
    }
    return fail(error, ERROR_USAGE,
                has_waves ? "{--criterion} %s is of the primary wavelength of the lens: no {--%s}"
                          : "{--criterion} %s is of the axis: no {--%s}",
                criterion_type(kind)->name, has_waves ? "wavelength" : "field");
}

/* Trials look for no object of a real image: rays would be aimed from another one than spot has. */
static bool check_aim(const struct tolerance_job *job, struct error *error)
{
    const struct lens_question *asked = &job->input->question;
    if (!job->question.aims || asked->fields.count > 0 || job->lens->field_kind != FIELD_REAL) {
        return true;
    }
    fail(error, ERROR_DOMAIN,
         "{--aim} stop: the fields are heights of the real image, and trials have the directions "
         "of those from the nominal lens");
    return error_hint(error, "{--aim} nominal, or angles by {--field}");
}

static bool ask_view(struct tolerance_job *job, struct error *error)
{
    const struct tolerance_input *input = job->input;
    const struct lens_question *question = &input->question;
    struct arena *arena = job->run->arena;
    struct merit_question *view = &job->question.view;
    const char *names = question->position != NULL ? question->position : "all";
    struct setup_field *fields = ARENA_ARRAY(arena, question->fields.count + 1, struct setup_field);
    if (!check_focal(job, error) || !check_aim(job, error)) {
        return false;
    }
    /* the transfer function of a pupil that is cut is not there */
    const bool is_contrast = job->question.criterion.kind == CRITERION_MTF;
    if (is_contrast && input->clip) {
        return fail(
            error, ERROR_USAGE,
            "{--clip} is not for {--criterion} mtf: contrast is that of the whole pupil, as "
            "with {--no-clip}");
    }
    *view = (struct merit_question){.lens = job->lens,
                                    .wavelengths = input->waves.items,
                                    .wavelength_count = input->waves.count,
                                    .fields = fields,
                                    .field_count = question->fields.count,
                                    .section = (enum lens_section)question->section,
                                    .fnumber = question->fnumber,
                                    .clip = input->clip || (!input->no_clip && !is_contrast),
                                    .pattern = (enum pattern)input->pattern,
                                    .rays = (size_t)input->rays, /* the same for any seed */
                                    .watch = job->run->watch};
    return lens_positions(question->lens.lens, names, arena, &view->positions,
                          &view->position_count, error) &&
           lens_fields_asked(question, view->positions[0], fields, error);
}

bool tolerance_ask(struct tolerance_job *job, struct error *error)
{
    const struct tolerance_input *input = job->input;
    job->lens = input->question.lens.lens;
    job->question.refocus = (enum tolerance_refocus)input->refocus;
    job->question.aims = input->aim == TOLERANCE_AIM_STOP;
    if (!ask_criterion(job, error) || !ask_view(job, error) || !ask_compensators(job, error)) {
        return false;
    }
    const struct tolerances_reader reader = {job->lens, job->run->db, job->run->arena};
    const char *grade = tolerances_grade(job->lens, input->grade, input->tolerances);
    if (!tolerances_of(&reader, grade, input->tolerances, &job->perturbations, &job->made, error)) {
        return false;
    }
    job->question.perturbations = job->perturbations.list;
    job->question.perturbation_count = job->perturbations.count;
    job->trials = (struct tolerance_run){.question = &job->question,
                                         .of = (enum tolerance_of)input->of,
                                         .limit = job->limit,
                                         .seed = (uint64_t)input->seed,
                                         .end = (uint64_t)input->trials,
                                         .total = (uint64_t)input->trials,
                                         .threads = parallel_threads(input->threads),
                                         .watch = job->run->watch};
    return true;
}
