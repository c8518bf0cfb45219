/* design/tolerance/perturbation.c - what may be wrong with a lens: independent numbers. */
/* SPDX-License-Identifier: MIT */
#include "design/tolerance/perturbation.h"

#include "base/turns.h"
#include "design/tolerance/perturbation_place.h"
#include "optics/growing.h"

#include <stdlib.h>

/* Which tolerance of one thing counts: the highest. */
enum perturbation_rank { RANK_GRADE, RANK_GRADE_AIR, RANK_RANGE, RANK_AIR, RANK_SINGLE };

/* A thing of the lens, with a tolerance of it. */
struct perturbation_entry {
    struct tolerance_place place;
    enum perturbation_rank rank;
    size_t number; /* in the order of the lines */
    bool won;      /* over the grade's */
};

/* Ranges of all surfaces again and again are no tolerances but a mistake, or mischief. */
enum { MOST_ENTRIES = 1000000 };

struct work {
    struct tolerance_site site;
    const char *grade;
    struct perturbation_entry *entries;
    size_t count, room;
    struct text_buffer left_out;
};

/* A mark names its line, a grade itself. Returns false. */
static bool perturbation_refuse(const struct work *work, const struct perturbation_entry *entry,
                                const char *why, struct error *error)
{
    const char *name = tolerance_place_name(&work->site, &entry->place);
    const struct lens_tolerance *from = entry->place.from;
    if (entry->rank <= RANK_GRADE_AIR) {
        fail(error, ERROR_DOMAIN, "the tolerance of %s in grade %s cannot be: %s", name,
             work->grade, why);
        return from->unit == TOLERANCE_FRINGES
                   ? error_hint(error,
                                "the diameter in the line of a surface is what it takes; or lines "
                                "'tolerance ...' without such in the lens or in a file "
                                "of their own, in place of the grade")
                   : error_hint(error, "a line 'tolerance %s ...' of its own goes before the grade",
                                name);
    }
    fail_at(error, ERROR_DATA, from->text, from->column, "the tolerance of %s cannot be: %s", name,
            why);
    return from->source != NULL && error_locate(error, from->source, from->line, from->column);
}

static bool put_entry(struct work *work, struct perturbation_entry entry, struct error *error)
{
    if (work->count == MOST_ENTRIES) {
        return perturbation_refuse(work, &entry, "there are more than a million", error);
    }
    work->entries = arena_grow(work->site.arena, work->entries, work->count, &work->room,
                               sizeof work->entries[0]);
    entry.number = work->count;
    work->entries[work->count++] = entry;
    return true;
}

/* One thing of a tolerance. */
static bool perturbation_add(struct work *work, struct perturbation_entry entry,
                             struct error *error)
{
    const struct tolerance_site *site = &work->site;
    const struct lens_tolerance *from = entry.place.from;
    if (from->kind == TOLERANCE_THICKNESS) {
        entry.place.kind = tolerance_place_space(site, entry.place.first);
    }
    entry.place.space = entry.place.first;
    /* an airspace that a stop divides has one error */
    if (entry.place.kind == TOLERANCE_AIR && !tolerance_place_find_airspace(site, &entry.place) &&
        from->is_range) {
        return true;
    }
    const char *wrong = tolerance_place_wrong(site, &entry.place);
    if (wrong != NULL && from->is_range) {
        /* a glass of which only the Abbe number is not known is said */
        struct tolerance_place glass = entry.place;
        glass.kind = TOLERANCE_INDEX;
        if (entry.place.kind == TOLERANCE_ABBE && tolerance_place_wrong(site, &glass) == NULL) {
            growing_format(&work->left_out, "%s%s", work->left_out.length > 0 ? ", " : "",
                           tolerance_place_name(site, &entry.place));
        }
        return true;
    }
    return wrong != NULL ? perturbation_refuse(work, &entry, wrong, error)
                         : put_entry(work, entry, error);
}

static bool perturbation_add_tolerance(struct work *work, const struct lens_tolerance *from,
                                       bool is_grade, struct error *error)
{
    const bool is_air = from->kind == TOLERANCE_AIR;
    const enum perturbation_rank ranks[] = {is_air ? RANK_AIR : RANK_RANGE,
                                            is_air ? RANK_GRADE_AIR : RANK_GRADE};
    struct perturbation_entry entry = {
        .place = {from, from->kind, from->first, from->last, from->first},
        .rank = is_grade || from->is_range ? ranks[is_grade] : RANK_SINGLE};
    const enum tolerance_owner owner = tolerance_type(from->kind)->owner;
    if (owner == TOLERANCE_OF_SURFACE) {
        for (size_t i = from->first; i <= from->last; i++) {
            entry.place.first = entry.place.last = i;
            if (!perturbation_add(work, entry, error)) {
                return false;
            }
        }
        return true;
    }
    if (owner != TOLERANCE_OF_ELEMENT || !from->is_range) {
        return perturbation_add(work, entry, error);
    }
    /* the elements from `first` to `last`: all of each */
    const char *wrong = tolerance_place_wrong(&work->site, &entry.place);
    if (wrong != NULL) {
        return perturbation_refuse(work, &entry, wrong, error);
    }
    for (size_t i = 0; i < work->site.element_count; i++) {
        const struct element *one = &work->site.elements[i];
        if (one->first >= from->first && one->last <= from->last) {
            entry.place.first = entry.place.space = one->first;
            entry.place.last = one->last;
            if (!put_entry(work, entry, error)) {
                return false;
            }
        }
    }
    return true;
}

/* -------- as numbers -------- */

static int by_thing(const struct perturbation_entry *a, const struct perturbation_entry *b)
{
    const struct tolerance_place *left = &a->place, *right = &b->place;
    const size_t keys[][2] = {{left->kind, right->kind},
                              {left->space, right->space},
                              {left->last - left->first, right->last - right->first},
                              {(size_t)left->from->order, (size_t)right->from->order}};
    for (size_t i = 0; i < sizeof keys / sizeof keys[0]; i++) {
        if (keys[i][0] != keys[i][1]) {
            return keys[i][0] < keys[i][1] ? -1 : 1;
        }
    }
    return 0;
}

/* Of one thing that first which counts: of a grade fringes are for what nothing else is of. */
static int by_rank(const void *left, const void *right)
{
    const struct perturbation_entry *a = left, *b = right;
    const int thing = by_thing(a, b);
    const bool a_last = a->rank <= RANK_GRADE_AIR && a->place.from->unit == TOLERANCE_FRINGES;
    const bool b_last = b->rank <= RANK_GRADE_AIR && b->place.from->unit == TOLERANCE_FRINGES;
    if (thing != 0) {
        return thing;
    }
    if (a->rank != b->rank) {
        return a->rank > b->rank ? -1 : 1;
    }
    if (a_last != b_last) {
        return a_last ? 1 : -1;
    }
    return (a->number > b->number) - (a->number < b->number);
}

/* Keep of each thing the one that counts. */
static bool perturbation_keep_first(struct work *work, struct error *error)
{
    size_t kept = 0;
    qsort(work->entries, work->count, sizeof work->entries[0], by_rank);
    for (size_t i = 0; i < work->count; i++) {
        const struct perturbation_entry *one = &work->entries[i];
        struct perturbation_entry *counts = kept > 0 ? &work->entries[kept - 1] : NULL;
        if (counts == NULL || by_thing(counts, one) != 0) {
            work->entries[kept++] = *one;
            continue;
        }
        if (counts->rank == one->rank && one->rank > RANK_GRADE_AIR) {
            const struct lens_tolerance *first = counts->place.from;
            const bool is_gap = counts->place.first != one->place.first;
            return perturbation_refuse(
                work, one,
                arena_printf(work->site.arena, "%s has one already, in line %ld%s%s",
                             is_gap ? "its airspace, which the stop does not divide," : "it",
                             first->line, first->source != NULL ? " of " : "",
                             first->source != NULL ? first->source : ""),
                error);
        }
        counts->won = counts->won || (counts->rank > RANK_GRADE_AIR && one->rank <= RANK_GRADE_AIR);
    }
    work->count = kept;
    return true;
}

/* Null: there are none. */
static const char *names_or_none(struct text_buffer *names)
{
    const struct text all = growing_done(names);
    return all.length > 0 ? arena_string(names->arena, all.start, all.length) : NULL;
}

/* The numbers of a tolerance of one thing: along two axes, or in three forms. */
static bool perturbation_emit(const struct work *work, const struct perturbation_entry *entry,
                              struct perturbations *perturbations, struct error *error)
{
    static const struct component {
        enum perturbation_axis axis;
        const char *words;
    } whole[] = {{PERTURBATION_ROUND, ""}},
      axes[] = {{PERTURBATION_X, " x"}, {PERTURBATION_Y, " y"}},
      forms[] = {{PERTURBATION_X, " 0deg"},
                 {PERTURBATION_Y, " 45deg"},
                 {PERTURBATION_ROUND, " spherical"}};
    const struct lens_tolerance *from = entry->place.from;
    struct lens_tolerance *line = ARENA_NEW(work->site.arena, struct lens_tolerance);
    *line = *from;
    line->is_range = false;
    line->first = entry->place.first;
    line->last = entry->place.last;
    struct perturbation one = {.spread = spread_of(from->distribution, from->sigmas),
                               .name = tolerance_place_name(&work->site, &entry->place),
                               .thing = (size_t)(entry - work->entries),
                               .line = line};
    const char *wrong = tolerance_place_amount(&work->site, &entry->place, &one);
    if (wrong != NULL) {
        return perturbation_refuse(work, entry, wrong, error);
    }
    const bool is_tilt = one.kind == TOLERANCE_TILT || one.kind == TOLERANCE_WEDGE;
    const bool is_decentre = one.kind == TOLERANCE_DECENTER;
    const bool is_motion =
        one.kind == TOLERANCE_ELEMENT_TILT || one.kind == TOLERANCE_ELEMENT_DECENTER;
    const struct component *components = whole;
    int count = 1;
    if (is_tilt || is_decentre || is_motion) {
        components = axes;
        count = 2;
    } else if (one.kind == TOLERANCE_IRREGULARITY) {
        components = forms;
        count = 3;
    }
    for (int i = 0; i < count; i++) {
        struct perturbation part = one;
        part.axis = components[i].axis;
        part.name = ARENA_JOIN(work->site.arena, one.name, components[i].words);
        if (is_tilt || is_decentre) {
            const int kind = (is_tilt ? PARAMETER_TILT_X : PARAMETER_DECENTER_X) + i;
            part.what = (struct parameter){one.first, (enum parameter_kind)kind, 0};
        }
        perturbations->list[perturbations->count++] = part;
    }
    return true;
}

bool perturbations_of(const struct lens *lens, const struct perturbation_wish *wish,
                      struct arena *arena, struct perturbations *perturbations, struct error *error)
{
    struct work work = {.grade = wish->grade, .left_out = {.arena = arena}};
    struct text_buffer won = {.arena = arena};
    struct element *elements;
    work.site = (struct tolerance_site){.all = lens,
                                        .lens = lens_at_position(lens, 0, arena),
                                        .element_count = elements_of(lens, arena, &elements),
                                        .arena = arena};
    work.site.elements = elements;
    for (size_t i = 0; i < wish->of_grade.count + wish->marks.count; i++) {
        const bool is_grade = i < wish->of_grade.count;
        const struct lens_tolerance *from =
            is_grade ? &wish->of_grade.list[i] : &wish->marks.list[i - wish->of_grade.count];
        if (!perturbation_add_tolerance(&work, from, is_grade, error)) {
            return false;
        }
    }
    if (work.count == 0) {
        fail(error, ERROR_DOMAIN, "nothing of the lens has a tolerance");
        return error_hint(error,
                          "give a grade, or lines 'tolerance R1 0.1%% uniform' in the lens or "
                          "in a file of their own");
    }
    if (!perturbation_keep_first(&work, error)) {
        return false;
    }
    *perturbations =
        (struct perturbations){.list = ARENA_ARRAY(arena, 3 * work.count, struct perturbation)};
    for (size_t i = 0; i < work.count; i++) {
        if (work.entries[i].won) {
            growing_format(&won, "%s%s", won.length > 0 ? ", " : "",
                           tolerance_place_name(&work.site, &work.entries[i].place));
        }
        if (!perturbation_emit(&work, &work.entries[i], perturbations, error)) {
            return false;
        }
    }
    perturbations->won = names_or_none(&won);
    perturbations->left_out = names_or_none(&work.left_out);
    return true;
}

/* -------- as random numbers -------- */

void perturbation_errors(const struct perturbation *list, size_t count, const double *even,
                         double *errors)
{
    for (size_t i = 0; i < count; i++) {
        errors[i] = spread_quantile(&list[i].spread, even[i]);
        if ((list[i].kind == TOLERANCE_IRREGULARITY && list[i].axis == PERTURBATION_X) &&
            i + 1 < count) {
            const double size = errors[i], turn = even[i + 1];
            double cosine, sine;
            turns_of(turn, &cosine, &sine);
            errors[i++] = size * cosine;
            errors[i] = size * sine;
        }
    }
}

struct perturbation_moments perturbation_moments(const struct perturbation *one)
{
    const bool shares = one->kind == TOLERANCE_IRREGULARITY && one->axis != PERTURBATION_ROUND;
    return (struct perturbation_moments){
        .second = spread_variance(&one->spread) * (shares ? 1.0 / 2 : 1),
        .fourth = spread_fourth(&one->spread) * (shares ? 3.0 / 8 : 1)};
}
