/* commands/design/optimize_glasses.c - optimize --glasses: model glasses end as real ones. */
/* SPDX-License-Identifier: MIT */
#include "commands/design/optimize_job.h"

#include "base/parallel.h"
#include "data/glass_catalog.h"
#include "file/lens_glass.h"

#include <math.h>
#include <string.h>

/* -------- which glasses -------- */

/* A word of --glasses. */
struct glass_word {
    struct text text;
    bool is_catalog, has_current; /* some of its glasses are said to be made */
    struct nearest nearest;       /* a catalogue's name, where it is none */
};

/* The list, while it is read. */
struct glass_list {
    struct optimize_job *job;
    struct arena *arena;
    struct lens_glasses place;
    struct glass_candidate *glasses;
    size_t count, room;
    struct glass_word *words;
    size_t word_count;
    double *wavelengths; /* um: all that the lens is looked at with */
    size_t wavelength_count, wavelength_room;
};

static void glass_list_add_wavelength(struct glass_list *list, double wavelength)
{
    list->wavelengths = arena_grow(list->arena, list->wavelengths, list->wavelength_count,
                                   &list->wavelength_room, sizeof wavelength);
    list->wavelengths[list->wavelength_count++] = wavelength;
}

/* The glass as a lens file finds it by its full name; of several that are the same to light, as one
   with higher transmittance is by another name, the first. */
static bool add_glass(struct glass_list *list, const struct glass *glass, struct error *error)
{
    const struct glass_source source = lens_glass_source(&list->place);
    const char *name =
        arena_printf(list->arena, "%.*s:%.*s", (int)glass->catalog.length, glass->catalog.start,
                     (int)glass->name.length, glass->name.start);
    struct glass_candidate one = {.medium = {.kind = MEDIUM_GLASS, .written = text_of(name)}};
    struct pair index;
    if (!source.find(source.context, &one.medium, error)) {
        return false;
    }
    for (size_t i = 0; i < list->wavelength_count; i++) {
        if (!medium_index(&one.medium, list->wavelengths[i], &index, error)) {
            return false;
        }
    }
    const struct glass_summary summary = glass_summary(lens_glass_of(&one.medium));
    one.nd = summary.nd;
    one.Vd = summary.Vd;
    one.deviation = summary.deviation;
    if (!isfinite(one.nd) || !isfinite(one.Vd)) {
        return fail(error, ERROR_DOMAIN, "glass %s has no nd and Vd to choose it by", name);
    }
    for (size_t i = 0; i < list->count; i++) {
        const struct glass_candidate *other = &list->glasses[i];
        if (other->nd == one.nd && other->Vd == one.Vd &&
            (other->deviation == one.deviation || isnan(one.deviation))) {
            return true;
        }
    }
    list->glasses = arena_grow(list->arena, list->glasses, list->count, &list->room, sizeof one);
    list->glasses[list->count++] = one;
    return true;
}

/*
 * Go through all catalogues: first which of the words name one, then for their glasses. Of one that
 * does not say what is made all but what is not made any more.
 */
static bool glass_list_read_catalogs(struct glass_list *list, bool takes, struct error *error)
{
    struct glass_catalogs catalogs;
    struct glass_record record;
    struct error ignored;
    if (!glass_catalogs_open(&catalogs, list->job->run->db, list->arena, false, error)) {
        return false;
    }
    while (glass_catalogs_next(&catalogs, &record, error)) {
        /* Is it made, as far as the catalogue says? */
        const bool current = text_equal(record.status, "current") ||
                             text_equal(record.status, "preferred") ||
                             text_equal(record.status, "standard");
        for (size_t i = 0; i < list->word_count; i++) {
            struct glass_word *word = &list->words[i];
            if (!text_same_name(word->text, record.glass.catalog)) {
                nearest_offer(&word->nearest, record.glass.catalog);
                continue;
            }
            word->is_catalog = true;
            word->has_current = word->has_current || current;
            if (takes && (word->has_current ? current : !text_equal(record.status, "obsolete"))) {
                add_glass(list, &record.glass, &ignored); /* or it does not reach far enough */
            }
        }
    }
    return error->code == ERROR_NONE;
}

/* Catalogues, and words that are none of them: those that are named come first. */
static bool glass_list_read(struct glass_list *list, const char *typed, struct error *error)
{
    size_t most = 1;
    for (const char *at = typed; *at != '\0'; at++) {
        most += *at == ',';
    }
    list->words = ARENA_ARRAY(list->arena, most, struct glass_word);
    for (struct text rest = text_of(typed); rest.start != NULL;) {
        const struct text word = text_trim(text_cut(&rest, ','));
        if (word.length == 0) {
            return fail(error, ERROR_USAGE, "a name is missing in '%s'", typed);
        }
        list->words[list->word_count++] =
            (struct glass_word){.text = word, .nearest = {.typed = word}};
    }
    if (!glass_list_read_catalogs(list, false, error)) {
        return false;
    }
    for (size_t i = 0; i < list->word_count; i++) {
        const struct text word = list->words[i].text, meant = list->words[i].nearest.best;
        struct glass_record record;
        if (list->words[i].is_catalog) {
            continue;
        }
        if (glass_find(list->job->run->db, word, GLASS_OWN_NAMES, list->arena, &record, error)) {
            if (!add_glass(list, &record.glass, error)) {
                return false;
            }
            continue;
        }
        if (error->code == ERROR_USAGE && meant.start != NULL) {
            fail(error, ERROR_USAGE, "'%.*s' is neither a catalogue nor a glass of one",
                 text_shown(word), word.start);
            error_hint(error, "did you mean '%.*s'?", (int)meant.length, meant.start);
        }
        return false;
    }
    return glass_list_read_catalogs(list, true, error) &&
           (list->count > 0 || fail(error, ERROR_DOMAIN,
                                    "'%s' has no glass that is made, has nd and Vd, and reaches "
                                    "to all wavelengths",
                                    typed));
}

bool optimize_glasses_open(struct optimize_job *job, struct error *error)
{
    const struct optimize_input *input = job->input;
    struct arena *arena = job->run->arena;
    struct glass_list list = {.job = job, .arena = arena, .place = {job->run->db, arena}};
    size_t *surfaces = ARENA_ARRAY(arena, job->variables.count + 1, size_t);
    if (input->glasses == NULL && input->show != OPTIMIZE_GLASSES) {
        return true;
    }
    if (input->glasses == NULL) {
        return fail(error, ERROR_USAGE, "{--show} glasses needs {--glasses}");
    }
    if (glass_choice_models(&job->variables, surfaces) == 0) {
        fail(error, ERROR_DOMAIN, "{--glasses}: no model glass nd/Vd varies");
        return error_hint(error, "those that do are replaced: {--vary} glass3, or the mark glass~");
    }
    /* of the merit, and of the lens in all its positions: it is to be usable */
    for (size_t p = 0; p == 0 || p < job->lens->position_count; p++) {
        const struct lens *lens = lens_at_position(job->lens, p, arena);
        for (size_t i = 0; i < lens->wavelength_count; i++) {
            glass_list_add_wavelength(&list, lens->wavelengths[i].wavelength);
        }
    }
    for (size_t p = 0; p < job->merit.place_count; p++) {
        for (size_t i = 0; i < job->merit.places[p].light_count; i++) {
            glass_list_add_wavelength(&list, job->merit.places[p].lights[i].wavelength);
        }
    }
    if (!glass_list_read(&list, input->glasses, error)) {
        return error_prefix(error, "{--glasses}: ");
    }
    job->glasses = list.glasses;
    job->glass_count = list.count;
    return true;
}

/* -------- what they do -------- */

void optimize_answer_join(struct optimize_job *job, const struct optimize_answer *last,
                          const size_t *origin, size_t variables)
{
    struct arena *arena = job->run->arena;
    struct optimize_answer *answer = &job->answer;
    const struct solver_summary first = answer->summary;
    const size_t count = job->variables.count;
    double *history = ARENA_ARRAY(arena, answer->history_count + last->history_count + 1, double);
    memcpy(history, answer->history, answer->history_count * sizeof(double));
    memcpy(history + answer->history_count, last->history, last->history_count * sizeof(double));
    answer->history = history;
    answer->history_count += last->history_count;
    answer->after = last->after;
    answer->summary = last->summary;
    answer->summary.evaluations = first.evaluations;
    answer->summary.iterations = first.iterations;
    answer->summary.at_bound = ARENA_ARRAY(arena, count, bool);
    bool *is_idle = ARENA_ARRAY(arena, count, bool); /* what varies no more is not */
    for (size_t i = 0; i < variables; i++) {
        const size_t at = origin[i];
        answer->summary.at_bound[at] = last->summary.at_bound[i];
        is_idle[at] = answer->is_idle[at] && last->is_idle[i];
    }
    answer->is_idle = is_idle;
}

bool optimize_glasses_choose(struct optimize_job *job, struct error *error)
{
    struct arena *arena = job->run->arena;
    struct glass_choice *choice = ARENA_NEW(arena, struct glass_choice);
    const struct glass_choice_task task = {
        .question = &job->merit.question,
        .how = &job->task,
        .candidates = job->glasses,
        .candidate_count = job->glass_count,
        .lens = job->found,
        .merit = job->answer.after.merit,
        .missed = job->answer.summary.excess,
        /* the other solver is not known to be at home in several */
        .threads = job->task.engine == SOLVER_DLS ? parallel_threads(job->input->threads) : 1};
    if (job->input->glasses == NULL) {
        return true;
    }
    if (!glass_choose(&task, arena, choice, error)) {
        return error_prefix(error, "{--glasses}: ");
    }
    job->choice = choice;
    if (choice->count > 0) {
        optimize_answer_join(job, &choice->answer, choice->origin, choice->variables.count);
        job->found = choice->lens;
        job->merit = choice->merit;
        job->look = NULL;
    }
    job->answer.summary.evaluations += choice->evaluations;
    job->answer.summary.iterations += choice->iterations;
    if (choice->is_stopped) {
        job->answer.summary.status = SOLVER_STOPPED;
    }
    /* model glasses that were left as they are, as they do not vary */
    const char *names = NULL;
    for (size_t i = 0; i < job->found->surface_count; i++) {
        const struct surface *surface = &job->found->surfaces[i];
        if (surface->medium.kind == MEDIUM_MODEL && !surface_reflects(surface)) {
            names = arena_printf(arena, "%s%sglass%zu", names == NULL ? "" : names,
                                 names == NULL ? "" : ", ", i + 1);
        }
    }
    if (names != NULL && choice->missing == 0) {
        optimize_warn(job, "model glasses that do not vary stay as they are: %s", names);
    }
    return true;
}

/* -------- rows -------- */

struct optimize_glass_row {
    struct optimize_about about;
    const char *glass, *replaced;
    double model_nd, model_Vd, nd, Vd, distance, before, after, loss;
    long surface;
};

static const struct column glass_columns[] = {
    OPTIMIZE_SWEPT_COLUMNS(struct optimize_glass_row),
    {COLUMN_NAMED(struct optimize_glass_row, surface, COLUMN_BRIEF),
     .help = "that the glass lies behind, in the order of the exchanges"},
    {COLUMN(struct optimize_glass_row, model_nd), .flags = COLUMN_BRIEF, .digits = 5,
     .name = "model_nd", .label = "model nd", .help = "of the model glass, as it was optimised"},
    {COLUMN(struct optimize_glass_row, model_Vd), .flags = COLUMN_BRIEF, .name = "model_vd",
     .label = "model Vd", .help = "its Abbe number"},
    {COLUMN_NAMED(struct optimize_glass_row, replaced, COLUMN_BRIEF | COLUMN_SPARSE),
     .help = "the real glass whose place was taken afterwards; absent: it was the model"},
    {COLUMN_NAMED(struct optimize_glass_row, glass, COLUMN_BRIEF),
     .help = "what took its place; absent: there was no time"},
    {COLUMN_NAMED(struct optimize_glass_row, nd, COLUMN_BRIEF), .digits = 5,
     .help = "of that glass"},
    {COLUMN(struct optimize_glass_row, Vd), .flags = COLUMN_BRIEF, .name = "vd", .label = "Vd",
     .help = "its Abbe number"},
    {COLUMN_NAMED(struct optimize_glass_row, distance, 0),
     .help = "between the two: sqrt((dnd/0.1)^2 + (dVd/10)^2 + (dP/0.02)^2), dP of PgF from the "
             "normal line"},
    {COLUMN(struct optimize_glass_row, before), .flags = COLUMN_BRIEF, .name = "merit_before",
     .label = "merit before", .help = "before this exchange"},
    {COLUMN(struct optimize_glass_row, after), .flags = COLUMN_BRIEF, .name = "merit_after",
     .label = "merit after", .help = "after it, everything else optimised again"},
    {COLUMN_NAMED(struct optimize_glass_row, loss, COLUMN_BRIEF),
     .help = "how much the merit has grown; of two exchanged at once in the row of the second"},
    OPTIMIZE_LENS_COLUMNS(struct optimize_glass_row),
};

const struct sheet optimize_glass_sheet = SHEET(glass_columns, struct optimize_glass_row);

bool optimize_emit_glasses(struct optimize_job *job, struct error *error)
{
    (void)error;
    const struct glass_choice *choice = job->choice;
    for (size_t i = 0; i < choice->count; i++) {
        const struct glass_exchange *exchange = &choice->exchanges[i];
        const struct optimize_glass_row row = {
            .about = optimize_about_of(job, i == 0),
            .surface = (long)exchange->surface + 1,
            .model_nd = exchange->nd,
            .model_Vd = exchange->Vd,
            .replaced = exchange->replaced,
            .glass = exchange->glass->medium.written.start,
            .nd = exchange->glass->nd,
            .Vd = exchange->glass->Vd,
            .distance = exchange->distance,
            .before = exchange->before,
            .after = exchange->after,
            .loss = exchange->is_joined ? (double)NAN : exchange->after - exchange->before};
        if (!run_emit(job->run, &row)) {
            break;
        }
    }
    return true;
}
