/* data/lensdb_facts.c - films, scenes, filters and grades of tolerances of lensdb. */
/* SPDX-License-Identifier: MIT */
#include "data/lensdb_facts.h"

#include "base/number.h"
#include "photo/stops.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum {
    FILM_NAME,
    FILM_MODEL,
    FILM_PARAMETERS,
    FILM_ONSET,
    FILM_NEEDED,
    FILM_VALID_TO = FILM_NEEDED,
    FILM_MAKER,
    FILM_STATUS,
    FILM_SOURCE,
    FILM_NOTE,
    FILM_ISO,
    FILM_ALIASES,
    FILM_TYPE,
    FILM_COLUMNS
};
static const char *const films[FILM_COLUMNS] = {"film",       "model", "parameters", "onset_s",
                                                "valid_to_s", "maker", "status",     "source",
                                                "note",       "iso",   "aliases",    "type"};

enum {
    SCENE_NAME,
    SCENE_EV100,
    SCENE_NEEDED,
    SCENE_SCENE = SCENE_NEEDED,
    SCENE_CONFIDENCE,
    SCENE_SOURCE,
    SCENE_ALIASES,
    SCENE_COLUMNS
};
static const char *const scenes[SCENE_COLUMNS] = {"name",       "ev100",  "scene",
                                                  "confidence", "source", "aliases"};

enum {
    FILTER_NAME,
    FILTER_NEEDED,
    FILTER_FACTOR = FILTER_NEEDED,
    FILTER_STOPS,
    FILTER_KIND,
    FILTER_CONFIDENCE,
    FILTER_SOURCE,
    FILTER_ALIASES,
    FILTER_MIRED,
    FILTER_COLUMNS
};
static const char *const filters[FILTER_COLUMNS] = {"name",       "factor", "stops",   "kind",
                                                    "confidence", "source", "aliases", "mired"};

bool lensdb_films_open(struct lensdb_table *facts, struct lensdb *db, enum lensdb_place place,
                       struct error *error)
{
    return lensdb_table_open(facts, db, place, "films.tsv", films, FILM_COLUMNS, FILM_NEEDED,
                             error);
}

bool lensdb_films_next(struct lensdb_table *facts, struct lensdb_film *film, struct error *error)
{
    if (!tsv_next(&facts->tsv, error)) {
        return false;
    }
    *film = (struct lensdb_film){.maker = lensdb_table_cell(facts, FILM_MAKER),
                                 .name = lensdb_table_cell(facts, FILM_NAME),
                                 .aliases = lensdb_table_cell(facts, FILM_ALIASES),
                                 .model = lensdb_table_cell(facts, FILM_MODEL),
                                 .parameters = lensdb_table_cell(facts, FILM_PARAMETERS),
                                 .status = lensdb_table_cell(facts, FILM_STATUS),
                                 .source = lensdb_table_cell(facts, FILM_SOURCE),
                                 .note = lensdb_table_cell(facts, FILM_NOTE),
                                 .speeds = lensdb_table_cell(facts, FILM_ISO),
                                 .type = lensdb_table_cell(facts, FILM_TYPE),
                                 .place = facts->place,
                                 .file = facts->tsv.source,
                                 .line = facts->tsv.line};
    if (!lensdb_table_number(facts, FILM_ONSET, 0, 1e9, &film->onset, error) ||
        !lensdb_table_number(facts, FILM_VALID_TO, 0, 1e9, &film->valid_to, error)) {
        return false;
    }
    film->onset = isnan(film->onset) ? 0 : film->onset;
    return true;
}

bool lensdb_scenes_open(struct lensdb_table *facts, struct lensdb *db, enum lensdb_place place,
                        struct error *error)
{
    return lensdb_table_open(facts, db, place, "scenes.tsv", scenes, SCENE_COLUMNS, SCENE_NEEDED,
                             error);
}

bool lensdb_scenes_next(struct lensdb_table *facts, struct lensdb_scene *scene, struct error *error)
{
    if (!tsv_next(&facts->tsv, error)) {
        return false;
    }
    *scene = (struct lensdb_scene){.name = lensdb_table_cell(facts, SCENE_NAME),
                                   .aliases = lensdb_table_cell(facts, SCENE_ALIASES),
                                   .scene = lensdb_table_cell(facts, SCENE_SCENE),
                                   .confidence = lensdb_table_cell(facts, SCENE_CONFIDENCE),
                                   .source = lensdb_table_cell(facts, SCENE_SOURCE),
                                   .place = facts->place};
    if (!lensdb_table_number(facts, SCENE_EV100, -100, 100, &scene->ev100, error)) {
        return false;
    }
    return !isnan(scene->ev100) ||
           tsv_fail(&facts->tsv, facts->columns[SCENE_EV100], error, "is missing");
}

bool lensdb_filters_open(struct lensdb_table *facts, struct lensdb *db, enum lensdb_place place,
                         struct error *error)
{
    return lensdb_table_open(facts, db, place, "filters.tsv", filters, FILTER_COLUMNS,
                             FILTER_NEEDED, error);
}

bool lensdb_filters_next(struct lensdb_table *facts, struct lensdb_filter *filter,
                         struct error *error)
{
    if (!tsv_next(&facts->tsv, error)) {
        return false;
    }
    *filter = (struct lensdb_filter){.name = lensdb_table_cell(facts, FILTER_NAME),
                                     .aliases = lensdb_table_cell(facts, FILTER_ALIASES),
                                     .kind = lensdb_table_cell(facts, FILTER_KIND),
                                     .confidence = lensdb_table_cell(facts, FILTER_CONFIDENCE),
                                     .source = lensdb_table_cell(facts, FILTER_SOURCE),
                                     .place = facts->place};
    if (!lensdb_table_number(facts, FILTER_FACTOR, 1, 1e30, &filter->factor, error) ||
        !lensdb_table_number(facts, FILTER_STOPS, 0, 100, &filter->stops, error) ||
        !lensdb_table_number(facts, FILTER_MIRED, -1000, 1000, &filter->mired, error)) {
        return false;
    }
    return !isnan(filter->factor) || !isnan(filter->stops) ||
           tsv_fail(&facts->tsv, facts->columns[FILTER_NAME], error,
                    "has neither factor nor stops");
}

enum { GRADE, QUANTITY, VALUE, UNIT, DISTRIBUTION, CONFIDENCE, SOURCE, COLUMNS, NEEDED = UNIT + 1 };

bool lensdb_grades_open(struct lensdb_table *grades, struct lensdb *db, enum lensdb_place place,
                        struct error *error)
{
    static const char *const names[COLUMNS] = {"grade",        "quantity",   "value", "unit",
                                               "distribution", "confidence", "source"};
    return lensdb_table_open(grades, db, place, "tolerances.tsv", names, COLUMNS, NEEDED, error);
}

bool lensdb_grades_next(struct lensdb_table *grades, struct lensdb_tolerance *row,
                        struct error *error)
{
    if (!tsv_next(&grades->tsv, error)) {
        return false;
    }
    *row = (struct lensdb_tolerance){.grade = lensdb_table_cell(grades, GRADE),
                                     .quantity = lensdb_table_cell(grades, QUANTITY),
                                     .amount = lensdb_table_cell(grades, VALUE),
                                     .unit = lensdb_table_cell(grades, UNIT),
                                     .distribution = lensdb_table_cell(grades, DISTRIBUTION),
                                     .confidence = lensdb_table_cell(grades, CONFIDENCE),
                                     .source = lensdb_table_cell(grades, SOURCE),
                                     .place = grades->place,
                                     .file = grades->tsv.source,
                                     .line = grades->tsv.line};
    if (!tsv_number(&grades->tsv, grades->columns[VALUE], &row->value, error)) {
        return false;
    }
    return row->value > 0 ||
           tsv_fail(&grades->tsv, grades->columns[VALUE], error, "is not above 0");
}

double lensdb_filter_stops(const struct lensdb_filter *filter)
{
    return isnan(filter->factor) ? filter->stops : stops_from_factor(filter->factor);
}

bool lensdb_nearest_conversion(struct lensdb *db, double mired, struct arena *arena,
                               const char **name, double *shift, struct error *error)
{
    *name = NULL;
    *shift = NAN;
    for (enum lensdb_place place = LENSDB_USER; place < LENSDB_PLACES; place++) {
        struct lensdb_table facts;
        struct lensdb_filter filter;
        bool open = lensdb_filters_open(&facts, db, place, error);
        while (open && lensdb_filters_next(&facts, &filter, error)) {
            /* one that shifts nothing is no conversion; NaN is never nearer */
            if (fabs(filter.mired) > 0 && !(fabs(filter.mired - mired) >= fabs(*shift - mired))) {
                *shift = filter.mired;
                *name = arena_string(arena, filter.name.start, filter.name.length);
            }
        }
        if (error->code != ERROR_NONE) {
            return false;
        }
    }
    return true;
}

/* Is `typed` the name or one of the aliases? */
static bool answers_to_name(struct text name, struct text aliases, struct text typed)
{
    bool same = text_same_name(name, typed);
    while (!same && aliases.start != NULL && aliases.length > 0) {
        same = text_same_name(text_trim(text_cut(&aliases, ',')), typed);
    }
    return same;
}

static void offer_all_names(struct nearest *nearest, struct text name, struct text aliases)
{
    nearest_offer(nearest, name);
    while (aliases.start != NULL && aliases.length > 0) {
        nearest_offer(nearest, text_trim(text_cut(&aliases, ',')));
    }
}

/* Cut the next word off a name: blanks, '/', ',' and parentheses are between words. */
static bool next_film_word(struct text *rest, struct text *word)
{
    static const char between[] = " /,()";
    while (rest->length > 0 && memchr(between, rest->start[0], sizeof between - 1) != NULL) {
        *rest = (struct text){rest->start + 1, rest->length - 1};
    }
    size_t length = 0;
    while (length < rest->length &&
           memchr(between, rest->start[length], sizeof between - 1) == NULL) {
        length++;
    }
    *word = (struct text){rest->start, length};
    *rest = (struct text){rest->start + length, rest->length - length};
    return length > 0;
}

static bool has_whole_word(struct text name, struct text wanted)
{
    struct text word;
    while (next_film_word(&name, &word)) {
        if (text_same_name(word, wanted)) {
            return true;
        }
    }
    return false;
}

/* Are all typed words the maker's, the only speed, or those of one name, at least one of them? */
static bool has_words_of(const struct lensdb_film *film, struct text name, struct text typed)
{
    struct text rest = typed, word;
    bool one_speed = memchr(film->speeds.start, ' ', film->speeds.length) == NULL;
    bool all = true, any = false;
    while (all && next_film_word(&rest, &word)) {
        bool here = has_whole_word(name, word);
        any = any || here;
        all = here || has_whole_word(film->maker, word) ||
              (one_speed && text_identical(film->speeds, word));
    }
    return all && any;
}

/* Are the typed words those of one of the names between commas, or of an alias? */
static bool has_all_words(const struct lensdb_film *film, struct text typed)
{
    struct text names = film->name, aliases = film->aliases;
    bool found = false;
    while (!found && names.start != NULL) {
        found = has_words_of(film, text_cut(&names, ','), typed);
    }
    while (!found && aliases.start != NULL && aliases.length > 0) {
        found = has_words_of(film, text_cut(&aliases, ','), typed);
    }
    return found;
}

/* Does a number stand in a text, not as a part of a longer one? */
static bool has_number(struct text text, struct text number)
{
    for (size_t i = 0; i + number.length <= text.length; i++) {
        const char *at = text.start + i, *behind = at + number.length;
        bool starts = i == 0 || at[-1] < '0' || at[-1] > '9';
        bool ends = behind == text.start + text.length || *behind < '0' || *behind > '9';
        if (starts && ends && memcmp(at, number.start, number.length) == 0) {
            return true;
        }
    }
    return false;
}

double lensdb_film_speed(const struct lensdb_film *film, struct text typed)
{
    struct text rest = film->speeds;
    double speed = NAN, only = NAN, value;
    size_t count = 0, named = 0;
    while (rest.start != NULL) {
        struct text word = text_cut(&rest, ' ');
        if (text_number(word, NUMBER_UNSCALED, &value) && value > 0 && value < INFINITY) {
            count++;
            only = value;
            if (has_number(typed, word)) {
                named++;
                speed = value;
            }
        }
    }
    if (count == 1) {
        return only;
    }
    return named == 1 ? speed : (double)NAN;
}

static bool is_film_called(const struct lensdb_film *film, struct text typed)
{
    if (answers_to_name(film->name, film->aliases, typed)) {
        return true;
    }
    for (size_t i = 1; film->maker.length > 0 && i < typed.length; i++) {
        if (text_same_name((struct text){typed.start, i}, film->maker)) {
            return answers_to_name(film->name, film->aliases,
                                   text_trim((struct text){typed.start + i, typed.length - i}));
        }
    }
    return false;
}

/* Films that answer to a name; the words name all of them. */
struct candidates {
    struct text typed;
    struct nearest nearest;
    struct lensdb_film first;
    struct lensdb_film own; /* of a maker's own data, where `owns` is 1 */
    size_t count, owns;
    char words[400];
};

static int shown_length(struct text text, size_t most)
{
    return (int)(text.length < most ? text.length : most);
}

static void add_candidate(struct candidates *found, const struct lensdb_film *film)
{
    size_t used = strlen(found->words);
    if (found->count++ == 0) {
        found->first = *film;
    }
    if (!text_equal(film->maker, "generic")) {
        found->own = *film;
        found->owns++;
    }
    snprintf(found->words + used, sizeof found->words - used, "%s'%.*s %.*s' (%.*s)",
             used > 0 ? ", " : "", shown_length(film->maker, 30), film->maker.start,
             shown_length(film->name, 40), film->name.start, shown_length(film->source, 48),
             film->source.start);
}

static bool search_films(struct lensdb *db, enum lensdb_place place,
                         bool (*answers)(const struct lensdb_film *film, struct text typed),
                         struct candidates *found, struct error *error)
{
    struct lensdb_table facts;
    struct lensdb_film film;
    if (!lensdb_films_open(&facts, db, place, error)) {
        return error->code == ERROR_NONE;
    }
    while (lensdb_films_next(&facts, &film, error)) {
        offer_all_names(&found->nearest, film.name, film.aliases);
        if (answers(&film, found->typed)) {
            add_candidate(found, &film);
        }
    }
    return error->code == ERROR_NONE;
}

static bool unknown_fact(const char *what, const char *topic, struct nearest *nearest,
                         struct error *error)
{
    struct text typed = nearest->typed;
    fail(error, ERROR_USAGE, "there is no %s '%.*s'", what, shown_length(typed, 80), typed.start);
    if (nearest->best.start != NULL) {
        return error_hint(error, "did you mean '%.*s'?", (int)nearest->best.length,
                          nearest->best.start);
    }
    return error_hint(error, "see 'lenscalc list %s'", topic);
}

bool lensdb_find_film(struct lensdb *db, struct text name, struct lensdb_film *film,
                      struct error *error)
{
    struct text typed = text_trim(name);
    struct candidates found = {.typed = typed, .nearest = {.typed = typed}};
    for (int i = 0; i < 4 && found.count == 0; i++) { /* the user's, the embedded, twice */
        if (!search_films(db, i % 2 == 0 ? LENSDB_USER : LENSDB_EMBEDDED,
                          i < 2 ? is_film_called : has_all_words, &found, error)) {
            return false;
        }
    }
    if (found.count == 0) {
        return unknown_fact("film", "films", &found.nearest, error);
    }
    if (found.count > 1 &&
        found.owns == 1) { /* the others are measurements of it by someone else */
        *film = found.own;
        return true;
    }
    if (found.count > 1) {
        fail(error, ERROR_USAGE, "'%.*s' names %zu films: %s", shown_length(typed, 60), typed.start,
             found.count, found.words);
        return error_hint(error, "say which by its full name; see 'lenscalc list films'");
    }
    *film = found.first;
    return true;
}

static void add_step_point(struct reciprocity *model, double metered, double stops)
{
    model->metered[model->points] = metered;
    model->corrected[model->points++] = metered * exp2(stops);
}

/* "0:0;120:0.5": stops that hold from that time to the next one, the last to valid_to. */
static bool read_steps(const struct lensdb_film *film, struct reciprocity *model,
                       struct error *error)
{
    struct text rest = film->parameters;
    double stops = 0;
    *model = (struct reciprocity){.model = RECIPROCITY_TABLE, .valid_to = film->valid_to};
    while (rest.start != NULL) {
        struct text item = text_cut(&rest, ';');
        const char *end = item.start + item.length, *colon;
        double from, more;
        colon = number_read(item.start, end, NUMBER_UNSCALED, &from);
        if (colon == NULL || colon == end || *colon != ':' ||
            number_read(colon + 1, end, NUMBER_UNSCALED, &more) != end || !(more >= stops) ||
            model->points + 3 > RECIPROCITY_POINTS || !(from < film->valid_to) ||
            (model->points > 0 && !(from > model->metered[model->points - 1]))) {
            return fail(error, ERROR_DATA,
                        "'%.*s' is no ascending list of TIME:STOPS up to "
                        "valid_to_s",
                        shown_length(film->parameters, 60), film->parameters.start);
        }
        if (from > 0) {
            add_step_point(model, nextafter(from, 0), stops); /* the step before ends here */
            add_step_point(model, from, more);
        }
        stops = more;
    }
    add_step_point(model, film->valid_to, stops);
    model->onset = model->metered[0];
    return true;
}

bool lensdb_film_model(const struct lensdb_film *film, struct reciprocity *model,
                       struct error *error)
{
    bool read = text_equal(film->model, "step")
                    ? read_steps(film, model, error)
                    : reciprocity_parse(film->model, film->parameters, film->onset, film->valid_to,
                                        model, error);
    return read || error_locate(error, film->file, film->line, 0);
}

bool lensdb_find_scene(struct lensdb *db, struct text name, struct lensdb_scene *scene,
                       struct error *error)
{
    struct nearest nearest = {.typed = text_trim(name)};
    for (enum lensdb_place place = LENSDB_USER; place < LENSDB_PLACES; place++) {
        struct lensdb_table facts;
        bool open = lensdb_scenes_open(&facts, db, place, error);
        while (open && lensdb_scenes_next(&facts, scene, error)) {
            if (answers_to_name(scene->name, scene->aliases, nearest.typed)) {
                return true;
            }
            offer_all_names(&nearest, scene->name, scene->aliases);
        }
        if (error->code != ERROR_NONE) {
            return false;
        }
    }
    return unknown_fact("scene", "scenes", &nearest, error);
}

bool lensdb_find_filter(struct lensdb *db, struct text name, struct lensdb_filter *filter,
                        struct error *error)
{
    struct nearest nearest = {.typed = text_trim(name)};
    for (enum lensdb_place place = LENSDB_USER; place < LENSDB_PLACES; place++) {
        struct lensdb_table facts;
        bool open = lensdb_filters_open(&facts, db, place, error);
        while (open && lensdb_filters_next(&facts, filter, error)) {
            if (answers_to_name(filter->name, filter->aliases, nearest.typed)) {
                return true;
            }
            offer_all_names(&nearest, filter->name, filter->aliases);
        }
        if (error->code != ERROR_NONE) {
            return false;
        }
    }
    return unknown_fact("filter", "filters", &nearest, error);
}
