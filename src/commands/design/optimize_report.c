/* commands/design/optimize_report.c - optimize --report: start and end side by side. */
/* SPDX-License-Identifier: MIT */
#include "commands/analysis/report_page.h"
#include "commands/design/optimize_job.h"
#include "file/lens_file.h"
#include "optics/growing.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Of variables, and of the positions of a zoom that are drawn. */
enum { MOST_SHOWN = 15, MOST_PLACES = 3, MOST_PARTS = 4 * MOST_PLACES + 8 };

/* A goal counts as at its limit from so many deviations before it on. */
static const double at_limit = 1e-3;

/* The page, and the lens before and after as it was seen. */
struct optimize_page {
    const struct optimize_job *job;
    struct run *run;
    struct page page;
    struct lens_value lenses[2];
};

/* -------- lenses as they were seen -------- */

/* With the fields, wavelengths and f-number that were asked for in place of its own. */
static const struct lens *optimize_lens_seen(const struct optimize_job *job,
                                             const struct lens *lens, struct arena *arena)
{
    const struct merit_question *question = &job->merit.question;
    struct lens *seen = ARENA_NEW(arena, struct lens);
    *seen = *lens;
    if (question->field_count > 0) {
        seen->field_kind = question->fields[0].point.kind;
        seen->field_count = question->field_count;
        seen->fields = ARENA_ARRAY(arena, question->field_count, struct lens_field);
        for (size_t i = 0; i < question->field_count; i++) {
            seen->fields[i] = lens_field_none;
            seen->fields[i].weight = question->fields[i].weight;
            for (int k = 0; k < 2; k++) {
                seen->fields[i].at[k].value = pair_of(question->fields[i].point.value[k]);
            }
        }
    }
    if (question->wavelength_count > 0) {
        seen->wavelength_count = question->wavelength_count;
        seen->wavelengths = ARENA_ARRAY(arena, question->wavelength_count, struct lens_wavelength);
        for (size_t i = 0; i < question->wavelength_count; i++) {
            seen->wavelengths[i] =
                (struct lens_wavelength){.wavelength = question->wavelengths[i].wavelength,
                                         .weight = question->wavelengths[i].weight};
        }
    }
    if (!isnan(question->fnumber)) {
        seen->aperture_kind = APERTURE_FNUMBER;
        seen->apertures = NULL;
        seen->aperture = figure_number(pair_of(question->fnumber));
    }
    return seen;
}

/* At the start: plates have no f-number, and take the beam of the focal length that is wanted. */
static const struct lens *optimize_start_seen(const struct optimize_job *job, struct arena *arena)
{
    struct merit wanted = job->merit;
    struct lens *seen = ARENA_NEW(arena, struct lens);
    *seen = *optimize_lens_seen(job, job->lens, arena);
    wanted.places = ARENA_ARRAY(arena, wanted.place_count, struct merit_place);
    memcpy(wanted.places, job->merit.places, wanted.place_count * sizeof *wanted.places);
    if (merit_aperture_of_wanted(&wanted)) {
        seen->aperture_kind = wanted.places[0].aperture.kind;
        seen->apertures = NULL;
        seen->aperture = figure_number(pair_of(wanted.places[0].aperture.value));
    }
    return seen;
}

/* -------- parts -------- */

static struct page_part *optimize_page_add(struct optimize_page *page, const char *title)
{
    struct page_part *part = &page->page.parts[page->page.count++];
    *part = (struct page_part){.title = title};
    return part;
}

/* The answers of a command to both lenses, in a position; `plot` its drawing, or null. */
static void optimize_page_compare(struct optimize_page *page, const char *title,
                                  const char *command, const char *position, const char *plot)
{
    static const char *const which[] = {"start", "end"};
    struct arena *arena = page->run->arena;
    for (int i = 0; i < 2; i++) {
        char *words[6] = {arena_printf(arena, "%s", which[i])};
        size_t count = 1;
        if (position != NULL) {
            words[count++] = arena_printf(arena, "--position");
            words[count++] = arena_printf(arena, "%s", position);
        }
        if (plot != NULL) {
            words[count++] = arena_printf(arena, "--plot");
            words[count++] = arena_printf(arena, "%s", plot);
        }
        struct page_part *part = optimize_page_add(
            page, arena_printf(arena, "%s%s%s, %s", title, position != NULL ? " at " : "",
                               position != NULL ? position : "", which[i]));
        part->is_paired = true;
        part->is_right = i == 1;
        part->is_drawing = true;
        const struct page_question question = {command, words, count, &page->lenses[i], 1};
        page_ask(&question, page->run, part);
    }
}

/* The spots of both lenses in one drawing, so that they have one scale. */
static void optimize_page_add_spots(struct optimize_page *page, const char *position)
{
    static const char *const both[] = {"start", "end", "--plot", "spot.svg", "--position"};
    struct arena *arena = page->run->arena;
    char *words[6];
    size_t count = 0;
    for (; count < 5; count++) {
        words[count] = arena_string(arena, both[count], strlen(both[count]));
    }
    count = position != NULL ? count : count - 1;
    if (position != NULL) {
        words[count++] = arena_string(arena, position, strlen(position));
    }
    struct page_part *part = optimize_page_add(
        page, arena_printf(arena, "Spots%s%s, start and end", position != NULL ? " at " : "",
                           position != NULL ? position : ""));
    part->is_drawing = true;
    const struct page_question question = {"spot", words, count, page->lenses, 2};
    page_ask(&question, page->run, part);
}

/* "1.234", of what is not there a dash. */
static const char *page_number(double value, struct arena *arena)
{
    return isnan(value) ? "-" : arena_printf(arena, "%.5g", value);
}

/* Goal by goal, before and after. */
static struct text page_merit_lines(const struct optimize_job *job, struct arena *arena)
{
    const struct merit *merit = &job->merit;
    struct text_buffer lines = {.arena = arena};
    growing_format(&lines, "%-34s %12s %12s %-5s %12s %12s\n", "goal", "start", "end", "",
                   "merit start", "merit end");
    for (size_t i = 0; i < merit->slot_count; i++) {
        const struct merit_slot *slot = &merit->slots[i];
        const struct optimize_state *before = &job->answer.before, *after = &job->answer.after;
        const char *position = optimize_position_of(merit, slot);
        if (optimize_is_quiet(job, slot)) {
            continue;
        }
        const char *name = position != NULL
                               ? arena_printf(arena, "%s, %s", slot->operand->name, position)
                               : slot->operand->name;
        growing_format(&lines, "%-34s %12s %12s %-5s %12s %12s\n", name,
                       page_number(optimize_value_of(before, slot), arena),
                       page_number(optimize_value_of(after, slot), arena),
                       operand_unit(slot->operand).label,
                       page_number(optimize_merit_of(before, slot), arena),
                       page_number(optimize_merit_of(after, slot), arena));
    }
    growing_format(&lines, "%-34s %12s %12s %-5s %12s %12s\n", "all", "", "", "",
                   page_number(job->answer.before.merit, arena),
                   page_number(job->answer.after.merit, arena));
    return growing_done(&lines);
}

/* A variable, and how far it moved, in natural scales. */
struct page_move {
    size_t variable;
    double distance;
};

static int page_move_compare(const void *one, const void *other)
{
    const struct page_move *a = one, *b = other;
    const int farther = (a->distance < b->distance) - (a->distance > b->distance);
    return farther != 0 ? farther : (a->variable > b->variable) - (a->variable < b->variable);
}

/* Of radii and focal lengths by their reciprocals; of glasses in 0.1 of nd and 10 of Vd, whatever
   the solver had in their place. */
static double page_distance(const struct optimize_job *job, size_t which)
{
    const enum parameter_kind kind = job->variables.list[which].what.kind;
    double from = optimize_variable_in(job, job->lens, which);
    double to = optimize_variable_in(job, job->found, which);
    double scale = job->variables.scale[which];
    if (kind == PARAMETER_RADIUS || kind == PARAMETER_FOCAL) {
        from = 1 / from;
        to = 1 / to;
    }
    if (parameter_is_of_medium(kind)) {
        scale = kind == PARAMETER_INDEX ? 0.1 : 10;
    }
    return fabs(to - from) / scale;
}

/* The variables that moved most. */
static struct text page_variable_lines(const struct optimize_job *job, struct arena *arena)
{
    const struct variables *variables = &job->variables;
    struct text_buffer lines = {.arena = arena};
    struct page_move *moves = ARENA_ARRAY(arena, variables->count + 1, struct page_move);
    for (size_t i = 0; i < variables->count; i++) {
        const double distance = page_distance(job, i);
        moves[i] = (struct page_move){i, isnan(distance) ? 0 : distance};
    }
    qsort(moves, variables->count, sizeof *moves, page_move_compare);
    growing_format(&lines, "%-12s %14s %14s %14s  %s\n", "variable", "start", "end", "moved", "");
    for (size_t k = 0; k < variables->count && k < MOST_SHOWN; k++) {
        const size_t i = moves[k].variable;
        bool is_at_bound;
        const char *note = optimize_variable_note(job, i, &is_at_bound);
        growing_format(&lines, "%-12s %14s %14s %14.4f  %s\n", variables->list[i].name,
                       page_number(optimize_variable_in(job, job->lens, i), arena),
                       page_number(optimize_variable_in(job, job->found, i), arena),
                       moves[k].distance, note != NULL ? note : "");
    }
    if (variables->count > MOST_SHOWN) {
        growing_format(&lines, "and %zu others\n", variables->count - MOST_SHOWN);
    }
    growing_string(&lines, "mm, 1/mm, rad or 1; moved: in natural scales, 1/f of curvatures, f/10 "
                           "of thicknesses\n");
    return growing_done(&lines);
}

/* How many residuals of a slot are at the limit that the goal sets, or beyond it. */
static size_t page_limited(const struct optimize_job *job, const struct merit_slot *slot)
{
    const struct operand *operand = slot->operand;
    size_t count = 0;
    for (size_t k = slot->first; k < slot->first + slot->count; k++) {
        const double by = optimize_wrong_by(operand, job->answer.after.values[k]);
        count += by > -at_limit * operand->deviation;
    }
    return operand->kind == OPERAND_GRAZING ? job->answer.after.residuals[slot->first] > 0 : count;
}

/* Bounds and goals that hold it where it is. */
static struct text page_binding_lines(const struct optimize_job *job, struct arena *arena)
{
    const struct variables *variables = &job->variables;
    const struct merit *merit = &job->merit;
    struct text_buffer lines = {.arena = arena};
    for (size_t i = 0; i < variables->count; i++) {
        const struct variable *one = &variables->list[i];
        const double at = optimize_variable_in(job, job->found, i);
        bool is_at_bound;
        optimize_variable_note(job, i, &is_at_bound);
        if (is_at_bound) {
            const bool is_low = !(fabs(at - one->low) > fabs(at - one->high));
            growing_format(&lines, "%-34s %s bound, %s\n", one->name, is_low ? "lower" : "upper",
                           page_number(at, arena));
        }
    }
    for (size_t i = 0; i < merit->slot_count; i++) {
        const struct merit_slot *slot = &merit->slots[i];
        const struct operand *operand = slot->operand;
        const size_t limited = page_limited(job, slot);
        const char *value = page_number(optimize_value_of(&job->answer.after, slot), arena);
        if (operand->relation == OPERAND_EXACT) {
            growing_format(&lines, "%-34s met exactly, %s %s\n", operand->name, value,
                           operand_unit(operand).label);
        } else if (operand->relation != OPERAND_NEAR && limited > 0) {
            growing_format(&lines, "%-34s at its limit%s, %s %s\n", operand->name,
                           slot->count > 1
                               ? arena_printf(arena, " %zu of %zu times", limited, slot->count)
                               : "",
                           value, operand_unit(operand).label);
        }
    }
    if (growing_done(&lines).length == 0) {
        growing_string(&lines, "nothing: no variable is at a bound, no goal with <, > or == at its "
                               "limit\n");
    }
    return growing_done(&lines);
}

/* One a line. */
static struct text page_doubt_lines(const char *warning, struct arena *arena)
{
    struct text_buffer lines = {.arena = arena};
    for (const char *at = warning; *at != '\0'; at++) {
        const bool ends = at[0] == ';' && at[1] == ' ';
        growing_put(&lines, ends ? "\n" : at, 1);
        at += ends;
    }
    return growing_done(&lines);
}

/* -------- the page -------- */

static void optimize_page_fill(struct optimize_page *page)
{
    const struct optimize_job *job = page->job;
    const struct merit *merit = &job->merit;
    struct arena *arena = page->run->arena;
    const size_t places = merit->place_count, shown = places < MOST_PLACES ? places : MOST_PLACES;
    for (size_t i = 0; i < shown; i++) { /* the first, one between, the last */
        const struct merit_place *place =
            &merit->places[shown > 1 ? i * (places - 1) / (shown - 1) : 0];
        optimize_page_compare(page, "Cross-section", "draw", place->setup.position, NULL);
        optimize_page_add_spots(page, place->setup.position);
    }
    optimize_page_add(page, "Variables that moved most")->text = page_variable_lines(job, arena);
    optimize_page_add(page, "Merit by goal")->text = page_merit_lines(job, arena);
    optimize_page_add(page, "What binds")->text = page_binding_lines(job, arena);
    if (job->warning != NULL) {
        optimize_page_add(page, "Doubts")->text = page_doubt_lines(job->warning, arena);
    }
    for (int i = 0; i < 2; i++) {
        struct page_part *part =
            optimize_page_add(page, i == 0 ? "Prescription, start" : "Prescription, end");
        part->is_paired = true;
        part->is_right = i == 1;
        part->text = lens_write(page->lenses[i].lens, arena);
    }
}

bool optimize_report(const struct artifact_job *asked, struct output *sink, struct error *error)
{
    const struct optimize_job *all = asked->run->state;
    const struct optimize_job *job = all->search != NULL ? all->kept : all;
    struct arena *arena = asked->run->arena;
    if (all->search != NULL && all->kept_count == 0) {
        return fail(error, ERROR_DOMAIN, "no lens was found that a page could show");
    }
    const struct optimize_about about = optimize_about_of(job, true);
    const struct lens end = optimize_lens_written(job);
    const char *before =
        isnan(job->answer.before.merit) ? "none" : page_number(job->answer.before.merit, arena);
    struct optimize_page page = {
        .job = job,
        .run = asked->run,
        .page = {.title = job->lens->title != NULL ? job->lens->title : "lens",
                 .subtitle =
                     arena_printf(arena,
                                  "optimized: %s; merit %s at the start, %s at the end; goals %s; "
                                  "fields %s; wavelengths %s; rays %s",
                                  job->status, before, page_number(job->answer.after.merit, arena),
                                  job->goals, about.fields, about.wavelengths, about.rays),
                 .parts = ARENA_ARRAY(arena, MOST_PARTS, struct page_part)},
        .lenses = {{.lens = optimize_start_seen(job, arena), .name = "start"},
                   {.lens = optimize_lens_seen(job, &end, arena), .name = "end"}}};
    optimize_page_fill(&page);
    page_write(&page.page, asked, sink);
    return true;
}
