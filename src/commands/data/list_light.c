/* commands/data/list_light.c - lenscalc list: films, scenes and filters. */
/* SPDX-License-Identifier: MIT */
#include "commands/data/list.h"
#include "commands/tables.h"
#include "data/lensdb_facts.h"

#include <math.h>

#define ORIGIN                                                                                     \
    ENTRY(SHOWN(confidence), .name = "confidence", BRIEF,                                          \
          .help = "published or sourced, third-party, or approx"),                                 \
        ENTRY(SHOWN(source), .name = "source", BRIEF, .help = "where the figures are from"),       \
        ENTRY(SHOWN(place), .name = "database", .help = "embedded, or the user's own folder")

struct film_row {
    const char *film, *maker, *aliases, *speeds, *type, *model, *confidence, *source, *note, *place;
    double onset, longest, at_1, at_10, at_100;
};

#define ROW struct film_row

static const struct column film_columns[] = {
    {SHOWN(film), .name = "film", BRIEF, .help = "maker and film"},
    {SHOWN(maker), .name = "maker", .help = "of the film"},
    {SHOWN(aliases), .name = "aliases", .label = "also called", .help = "other names of the film"},
    {SHOWN(speeds), .name = "iso", BRIEF, .label = "ISO",
     .help = "speed on the box; several where the row is for several films"},
    {SHOWN(type), .name = "type",
     .help = "panchromatic, orthochromatic, colour negative or colour reversal"},
    {TIME(onset), .name = "onset", .flags = COLUMN_ECHO, .help = "no correction up to here"},
    {TIME(longest), .name = "longest", .flags = COLUMN_INFINITE | COLUMN_ECHO,
     .help = "longest metered time the source covers; inf where none is stated"},
    {TIME(at_1), .name = "for_1", BRIEF | COLUMN_ECHO, .label = "for 1 s",
     .help = "corrected time for a metered second"},
    {TIME(at_10), .name = "for_10", BRIEF, .label = "for 10 s", .help = "corrected time for 10 s"},
    {TIME(at_100), .name = "for_100", BRIEF, .label = "for 100 s",
     .help = "corrected time for 100 s"},
    {SHOWN(model), .name = "model", BRIEF, .help = "how the correction is published"},
    ORIGIN,
    {SHOWN(note), .name = "note", .help = "remarks and conflicts"},
};

/* The model in words. */
static const char *model_words(const struct list *list, const struct reciprocity *model)
{
    struct arena *arena = list->run->arena;
    switch (model->model) {
    case RECIPROCITY_POWER:
        return arena_printf(arena, "t^%.6g above %.6g s", model->p, model->onset);
    case RECIPROCITY_GAINER:
        return arena_printf(arena, "t + %.6g t^1.62", model->a);
    case RECIPROCITY_TABLE:
        return arena_printf(arena, "%d points, %.6g s to %.6g s", model->points, model->onset,
                            model->valid_to);
    case RECIPROCITY_NONE:
        break;
    }
    return arena_printf(arena, "none up to %.6g s", model->valid_to);
}

/* The corrected time; NaN beyond what the source covers. */
static double time_with_reciprocity(const struct reciprocity *model, double metered)
{
    double time;
    struct error ignored;
    return reciprocity_corrected(model, metered, &time, &ignored) ? time : NAN;
}

static bool list_films(struct list *list, struct error *error)
{
    struct lensdb_table facts;
    struct lensdb_film film;
    bool open = lensdb_films_open(&facts, list->run->db, list->place, error);
    while (open && lensdb_films_next(&facts, &film, error)) {
        struct reciprocity model;
        if (!lensdb_film_model(&film, &model, error)) {
            return false;
        }
        struct film_row row = {
            .film = arena_printf(list->run->arena, "%.*s%s%.*s", (int)film.maker.length,
                                 film.maker.start, film.maker.length > 0 ? " " : "",
                                 (int)film.name.length, film.name.start),
            .maker = list_string(list, film.maker),
            .aliases = list_string(list, film.aliases),
            .speeds = list_string(list, film.speeds),
            .type = list_string(list, film.type),
            .model = model_words(list, &model),
            .confidence = list_string(list, film.status),
            .source = list_string(list, film.source),
            .note = list_string(list, film.note),
            .place = list_place(film.place),
            .onset = model.onset,
            .longest = model.valid_to,
            .at_1 = time_with_reciprocity(&model, 1),
            .at_10 = time_with_reciprocity(&model, 10),
            .at_100 = time_with_reciprocity(&model, 100),
        };
        list_offer(list, &row, row.maker, (const char *[]){row.film, row.aliases, row.source}, 3);
    }
    return error->code == ERROR_NONE;
}

struct scene_row {
    const char *scene, *aliases, *meaning, *confidence, *source, *place;
    double ev100;
};

#undef ROW
#define ROW struct scene_row

static const struct column scene_columns[] = {
    {SHOWN(scene), .name = "scene", BRIEF, .help = "name to ask by"},
    {SHOWN(aliases), .name = "aliases", .label = "also called", .help = "other names of the scene"},
    {SHOWN(ev100), .name = "ev100", BRIEF | COLUMN_ECHO, .label = "EV at ISO 100",
     .help = "exposure value at ISO 100"},
    {SHOWN(meaning), .name = "meaning", BRIEF, .help = "in words, with ranges and conflicts"},
    ORIGIN,
};

static bool list_scenes(struct list *list, struct error *error)
{
    struct lensdb_table facts;
    struct lensdb_scene scene;
    bool open = lensdb_scenes_open(&facts, list->run->db, list->place, error);
    while (open && lensdb_scenes_next(&facts, &scene, error)) {
        struct scene_row row = {
            .scene = list_string(list, scene.name),
            .aliases = list_string(list, scene.aliases),
            .meaning = list_string(list, scene.scene),
            .confidence = list_string(list, scene.confidence),
            .source = list_string(list, scene.source),
            .place = list_place(scene.place),
            .ev100 = scene.ev100,
        };
        list_offer(list, &row, NULL, (const char *[]){row.scene, row.aliases, row.meaning}, 3);
    }
    return error->code == ERROR_NONE;
}

struct filter_row {
    const char *filter, *aliases, *kind, *confidence, *source, *place;
    double factor, stops, mired, used;
};

#undef ROW
#define ROW struct filter_row

static const struct column filter_columns[] = {
    {SHOWN(filter), .name = "filter", BRIEF, .help = "name to ask by"},
    {SHOWN(aliases), .name = "aliases", .label = "also called",
     .help = "other names of the filter"},
    {SHOWN(kind), .name = "kind", BRIEF, .help = "what it is for; bw: contrast in black and white"},
    {SHOWN(factor), .name = "factor", BRIEF | COLUMN_ECHO,
     .help = "published factor of the exposure time"},
    {STOPS(stops), .name = "published", .flags = COLUMN_ECHO, .label = "published stops",
     .help = "published stops to open up"},
    {SHOWN(mired), .name = "mired", BRIEF | COLUMN_SPARSE | COLUMN_ECHO, .label = "mired shift",
     .help = "of the colour temperature: + amber, - blue; absent for other colours"},
    {STOPS(used), .name = "loss", BRIEF, .label = "light loss",
     .help = "what --filter takes: log2 of the factor where there is one"},
    ORIGIN,
};

static bool list_filters(struct list *list, struct error *error)
{
    struct lensdb_table facts;
    struct lensdb_filter filter;
    bool open = lensdb_filters_open(&facts, list->run->db, list->place, error);
    while (open && lensdb_filters_next(&facts, &filter, error)) {
        struct filter_row row = {
            .filter = list_string(list, filter.name),
            .aliases = list_string(list, filter.aliases),
            .kind = list_string(list, filter.kind),
            .confidence = list_string(list, filter.confidence),
            .source = list_string(list, filter.source),
            .place = list_place(filter.place),
            .factor = filter.factor,
            .mired = filter.mired,
            .stops = filter.stops,
            .used = lensdb_filter_stops(&filter),
        };
        list_offer(list, &row, row.kind, (const char *[]){row.filter, row.aliases, row.kind}, 3);
    }
    return error->code == ERROR_NONE;
}

const struct topic topic_films = {SHEET(film_columns, struct film_row), list_films, true};
const struct topic topic_scenes = {SHEET(scene_columns, struct scene_row), list_scenes, true};
const struct topic topic_filters = {SHEET(filter_columns, struct filter_row), list_filters, true};
