/* commands/photo/dof_carry.c - depth of field to print and carry: a disc, a card. */
/* SPDX-License-Identifier: MIT */
#include "commands/photo/dof_carry.h"

#include "base/arena.h"
#include "cli/question/command.h"
#include "commands/photo/dof_question.h"
#include "draw/dof_card.h"
#include "draw/dof_disc.h"
#include "photo/dof.h"

#include <math.h>
#include <string.h>

static const double usual[] = {2, 2.8, 4, 5.6, 8, 11, 16, 22};
static const double CLOSEST = 11; /* focal lengths: a tenth of life size */

/* One of the questions, solved. */
struct carried {
    struct dof_setting setting;
    const char *lens; /* "50 mm", or its title */
};

static bool dof_carried(const void *question, struct arena *arena, struct carried *one,
                        struct error *error)
{
    struct dof_question own = *(const struct dof_question *)question;
    struct photo_lens lens, room;
    struct attached_lens attached;
    if (!sharpness_settle(&own.sharp, PITCH_FOR_COC, NULL, error) ||
        !photo_lens_single(&own.lens, dof_question_use(&own), arena, &lens, error) ||
        !dof_question_open(&own, &lens, &room, &attached, &one->setting, error) ||
        !dof_question_solve(&own, &attached, &one->setting, error)) {
        return false;
    }
    one->lens = lens.real->title != NULL ? lens.real->title
                                         : arena_printf(arena, "%.4g mm", one->setting.f);
    return true;
}

/* Rows of a magnification alone need no lens, what is drawn does. */
static bool dof_check_lens(const struct artifact_job *job, struct error *error)
{
    for (size_t i = 0; i < job->count; i++) {
        const struct dof_question *input = job->inputs[i];
        const struct dof_targets *t = &input->targets;
        const bool has_lens = !photo_lens_is_thin(&input->lens) ||
                              !isnan(input->lens.focal.length) ||
                              !isnan(input->lens.focal.equivalent);
        const bool has_more = !isnan(input->distance) || !isnan(t->near) || !isnan(t->far) ||
                              !isnan(t->total) || !isnan(t->hyperfocal);
        if (t->magnification > 0 && !has_lens && !has_more) {
            return fail(error, ERROR_USAGE, "{--%s} draws a lens: {--focal-length} is missing",
                        job->artifact->option.name);
        }
    }
    return true;
}

bool dof_check_scale(const struct artifact_job *job, struct error *error)
{
    const struct dof_question *input = job->inputs[0];
    if (!dof_check_lens(job, error)) {
        return false;
    }
    return !input->lens.rays.exact ||
           fail(error, ERROR_USAGE, "{--scale} draws what formulas say: it excludes {--exact}");
}

bool dof_check_carry(const struct artifact_job *job, struct error *error)
{
    const struct dof_question *input = job->inputs[0];
    const char *option = job->artifact->option.name;
    const char *other = SAID_FIRST({input->lens.rays.exact, "exact"}, {input->stack, "stack"},
                                   {input->model != DOF_EXACT, "model"});
    if (other != NULL) {
        return fail(error, ERROR_USAGE, "{--%s} excludes {--%s}", option, other);
    }
    return dof_check_lens(job, error);
}

/* A number's place in a rising list, where it is put if it is new; lists have room. */
static void list_put(double *list, size_t *count, double value)
{
    size_t place = 0;
    while (place < *count && list[place] < value) {
        place++;
    }
    if (place < *count && !(list[place] > value)) {
        return;
    }
    for (size_t i = *count; i > place; i--) {
        list[i] = list[i - 1];
    }
    list[place] = value;
    ++*count;
}

static size_t list_find(const double *list, size_t count, double value)
{
    size_t place = 0;
    while (place < count && list[place] < value) {
        place++;
    }
    return place;
}

bool dof_draw_disc(const struct artifact_job *job, struct output *sink, struct error *error)
{
    struct svg svg = {.arena = job->run->arena};
    struct arena *arena = svg.arena;
    const size_t room = job->count + sizeof usual / sizeof usual[0];
    double *fnumbers = ARENA_ARRAY(arena, room, double);
    size_t count = 0;
    struct carried first = {{0}, NULL}, one;
    double nearest = INFINITY;
    for (size_t i = 0; i < job->count; i++) {
        if (!dof_carried(job->inputs[i], arena, &one, error)) {
            return false;
        }
        first = i == 0 ? one : first;
        const struct dof_setting *a = &first.setting, *b = &one.setting;
        if (fabs(a->f - b->f) + fabs(a->c - b->c) + fabs(a->P - b->P) > 1e-9 * (a->f + a->c)) {
            return fail(error, ERROR_USAGE,
                        "a disc is for one lens and one circle of confusion: one "
                        "{--focal-length} for each {--disc}");
        }
        list_put(fnumbers, &count, b->N);
        nearest = fmin(nearest, b->s);
    }
    if (count == 1) {
        for (size_t i = 0; i < sizeof usual / sizeof usual[0]; i++) {
            list_put(fnumbers, &count, usual[i]);
        }
    }
    const struct dof_setting *setting = &first.setting;
    const struct dof_disc_drawing disc = {
        .title = arena_printf(arena, "Depth-of-field calculator, %s", first.lens),
        .lens = arena_printf(arena, "%.4g mm", setting->f),
        .sharpness = arena_printf(arena, "c = %.3g mm", setting->c),
        .f = setting->f,
        .P = setting->P,
        .c = setting->c,
        .nearest = fmin(nearest, CLOSEST * setting->f),
        .fnumbers = fnumbers,
        .fnumber_count = count,
    };
    return dof_disc_draw(&disc, &svg, error) && drawing_write(job, &svg, sink, error);
}

/* -------- the card -------- */

/* The lens of a question among those before. */
static size_t card_lens(const struct carried *all, const size_t *firsts, size_t *count, size_t i)
{
    for (size_t k = 0; k < *count; k++) {
        const struct carried *one = &all[firsts[k]];
        if (strcmp(one->lens, all[i].lens) == 0 && !(fabs(one->setting.f - all[i].setting.f) > 0)) {
            return k;
        }
    }
    return (*count)++;
}

static struct dof_card_cell card_cell_of(const struct dof_setting *setting)
{
    struct error ignored;
    struct dof dof;
    if (!dof_compute(setting, DOF_EXACT, &dof, &ignored)) {
        return (struct dof_card_cell){NAN, NAN, NAN};
    }
    return (struct dof_card_cell){dof.hyperfocal / 1000, dof.near / 1000, dof.far / 1000};
}

bool dof_draw_card(const struct artifact_job *job, struct output *sink, struct error *error)
{
    struct svg svg = {.arena = job->run->arena};
    struct arena *arena = svg.arena;
    struct carried *all = ARENA_ARRAY(arena, job->count, struct carried);
    double *fnumbers = ARENA_ARRAY(arena, job->count, double);
    double *distances = ARENA_ARRAY(arena, job->count, double);
    size_t *firsts = ARENA_ARRAY(arena, job->count, size_t);
    size_t *of = ARENA_ARRAY(arena, job->count, size_t);
    const char **names = ARENA_ARRAY(arena, job->count, const char *);
    struct dof_card card = {
        .title = "Depth of field", .lenses = names, .fnumbers = fnumbers, .distances = distances};
    double smallest = INFINITY, largest = 0;
    size_t count = 0;
    for (size_t i = 0; i < job->count; i++) {
        if (!dof_carried(job->inputs[i], arena, &all[count], error)) {
            continue; /* the row says so; its place stays empty */
        }
        const struct dof_setting *setting = &all[count].setting;
        of[count] = card_lens(all, firsts, &card.lens_count, count);
        if (of[count] + 1 == card.lens_count) {
            firsts[of[count]] = count;
            names[of[count]] = all[count].lens;
        }
        list_put(fnumbers, &card.fnumber_count, setting->N);
        list_put(distances, &card.distance_count, setting->s / 1000);
        smallest = fmin(smallest, setting->c);
        largest = fmax(largest, setting->c);
        count++;
    }
    if (count == 0) {
        return false;
    }
    const size_t cells = card.lens_count * card.distance_count * card.fnumber_count;
    struct dof_card_cell *table = ARENA_ARRAY(arena, cells, struct dof_card_cell);
    for (size_t i = 0; i < cells; i++) {
        table[i] = (struct dof_card_cell){NAN, NAN, NAN};
    }
    for (size_t i = 0; i < count; i++) {
        const struct dof_setting *setting = &all[i].setting;
        size_t row = list_find(distances, card.distance_count, setting->s / 1000);
        size_t column = list_find(fnumbers, card.fnumber_count, setting->N);
        table[(of[i] * card.distance_count + row) * card.fnumber_count + column] =
            card_cell_of(setting);
    }
    card.cells = table;
    card.subtitle =
        largest > smallest
            ? arena_printf(arena, "circle of confusion %.3g to %.3g mm", smallest, largest)
            : arena_printf(arena, "circle of confusion %.3g mm", largest);
    return dof_card_draw(&card, &svg, error) && drawing_write(job, &svg, sink, error);
}
