/* data/lensdb_sensors.c - formats and cameras of lensdb, and how they are found. */
/* SPDX-License-Identifier: MIT */
#include "data/lensdb.h"

#include "data/camera_name.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum {
    NAME,
    WIDTH,
    HEIGHT,
    NEEDED,
    MAKER = NEEDED,
    ALIASES,
    CLASS,
    PIXELS_WIDE,
    PIXELS_HIGH,
    PITCH,
    PITCH_FROM,
    FOCAL,
    EQUIVALENT,
    FNUMBER,
    CONFIDENCE,
    SOURCE,
    COLUMNS
};

bool lensdb_sensors_open(struct lensdb_table *sensors, struct lensdb *db, enum lensdb_place place,
                         bool cameras, struct error *error)
{
    const char *const names[COLUMNS] = {cameras ? "model" : "name",
                                        "width_mm",
                                        "height_mm",
                                        "maker",
                                        "aliases",
                                        "class",
                                        "px_w",
                                        "px_h",
                                        "pitch_um",
                                        "pitch_from",
                                        "focal_mm",
                                        "equivalent_mm",
                                        "fnumber",
                                        "confidence",
                                        "source"};
    return lensdb_table_open(sensors, db, place, cameras ? "cameras.tsv" : "formats.tsv", names,
                             COLUMNS, NEEDED, error);
}

/* A number of the present row that must be positive if it is there; absent columns give NaN. */
static bool read_positive(const struct lensdb_table *sensors, int column, double *value,
                          struct error *error)
{
    const size_t at = sensors->columns[column];
    if (!tsv_number(&sensors->tsv, at, value, error)) {
        return false;
    }
    return isnan(*value) || (*value > 0 && !isinf(*value)) ||
           tsv_fail(&sensors->tsv, at, error, "must be a number above 0");
}

static bool read_sensor_row(struct lensdb_table *sensors, struct lensdb_sensor *sensor,
                            struct error *error)
{
    double pitch_um;
    if (!read_positive(sensors, WIDTH, &sensor->size.width, error) ||
        !read_positive(sensors, HEIGHT, &sensor->size.height, error) ||
        !read_positive(sensors, PIXELS_WIDE, &sensor->pixels_wide, error) ||
        !read_positive(sensors, PIXELS_HIGH, &sensor->pixels_high, error) ||
        !read_positive(sensors, PITCH, &pitch_um, error)) {
        return false;
    }
    sensor->size.pitch = pitch_um / 1000;
    if (isnan(sensor->size.width) || isnan(sensor->size.height)) {
        const int missing = isnan(sensor->size.width) ? WIDTH : HEIGHT;
        return tsv_fail(&sensors->tsv, sensors->columns[missing], error, "is missing");
    }
    return true;
}

/* The next row's words, without its numbers. */
static bool next_words(struct lensdb_table *sensors, struct lensdb_sensor *sensor,
                       struct error *error)
{
    if (!tsv_next(&sensors->tsv, error)) {
        return false;
    }
    *sensor = (struct lensdb_sensor){
        .maker = lensdb_table_cell(sensors, MAKER),
        .name = lensdb_table_cell(sensors, NAME),
        .aliases = lensdb_table_cell(sensors, ALIASES),
        .class = lensdb_table_cell(sensors, CLASS),
        .pitch_from = lensdb_table_cell(sensors, PITCH_FROM),
        .focal = lensdb_table_cell(sensors, FOCAL),
        .equivalent = lensdb_table_cell(sensors, EQUIVALENT),
        .fnumber = lensdb_table_cell(sensors, FNUMBER),
        .confidence = lensdb_table_cell(sensors, CONFIDENCE),
        .source = lensdb_table_cell(sensors, SOURCE),
        .place = sensors->place,
    };
    return true;
}

bool lensdb_sensors_next(struct lensdb_table *sensors, struct lensdb_sensor *sensor,
                         struct error *error)
{
    return next_words(sensors, sensor, error) && read_sensor_row(sensors, sensor, error);
}

/* Is `name` one of the words between separators? */
static bool is_one_of(struct text name, struct text words, char separator)
{
    while (words.start != NULL && words.length > 0) {
        if (text_same_name(text_trim(text_cut(&words, separator)), name)) {
            return true;
        }
    }
    return false;
}

/* What makers are called besides their names in cameras.tsv. */
static const struct {
    const char *typed, *maker;
} maker_names[] = {
    {"Fuji", "Fujifilm"},
    {"Blackmagic Design", "Blackmagic"},
    {"BMD", "Blackmagic"},
    {"Olympus", "OM System"},
};

static bool cut_word(struct text *name, struct text word)
{
    for (size_t i = 1; word.length > 0 && i < name->length; i++) {
        if (text_same_name((struct text){name->start, i}, word)) {
            *name = (struct text){name->start + i, name->length - i};
            return true;
        }
    }
    return false;
}

/* Does `name` begin with the maker? Then cut the maker off. */
static bool cut_maker(struct text *name, struct text maker)
{
    bool cut = cut_word(name, maker);
    for (size_t i = 0; i < sizeof maker_names / sizeof maker_names[0] && !cut; i++) {
        cut = text_equal(maker, maker_names[i].maker) &&
              cut_word(name, text_of(maker_names[i].typed));
    }
    return cut;
}

struct lensdb_sensors_search {
    struct text name;
    struct text maker, model; /* of the last row; the name without this maker */
    bool by_maker;            /* is the maker part of the name? */
    struct lensdb_sensor found, second;
    int quality; /* of found */
    bool ambiguous;
};

/* How well does a sensor answer to a name? 0 not at all, 1 by model, 2 fully. */
static int sensor_answers_to(const struct lensdb_sensor *sensor,
                             struct lensdb_sensors_search *search)
{
    if (sensor->maker.length == 0) {
        return text_same_name(sensor->name, search->name) ||
                       is_one_of(search->name, sensor->aliases, ',')
                   ? 2
                   : 0;
    }
    if (!text_identical(sensor->maker, search->maker)) {
        search->maker = sensor->maker;
        search->model = search->name;
        search->by_maker = cut_maker(&search->model, sensor->maker);
    }
    if (text_same_name(sensor->name, search->model)) {
        return search->by_maker ? 2 : 1;
    }
    if (is_one_of(search->model, sensor->aliases, ',') ||
        (search->by_maker && is_one_of(search->name, sensor->aliases, ','))) {
        return 2;
    }
    return is_one_of(search->model, sensor->name, '/') ? 1 : 0;
}

/* Look through one table; stops at a full match. What is not found is not read as numbers, but in
   the user's own table, whose faults are to be told. */
static bool search_table(struct lensdb *db, enum lensdb_place place, bool cameras,
                         struct lensdb_sensors_search *search, struct error *error)
{
    struct lensdb_table sensors;
    struct lensdb_sensor sensor;
    if (!lensdb_sensors_open(&sensors, db, place, cameras, error)) {
        return error->code == ERROR_NONE;
    }
    while (search->quality < 2 && next_words(&sensors, &sensor, error)) {
        int quality = sensor_answers_to(&sensor, search);
        bool counts = quality > search->quality || (quality == 1 && search->quality == 1);
        if ((counts || place == LENSDB_USER) && !read_sensor_row(&sensors, &sensor, error)) {
            return false;
        }
        if (quality > search->quality) {
            search->found = sensor;
            search->quality = quality;
        } else if (counts) {
            search->ambiguous = true;
            search->second = sensor;
        }
    }
    return search->quality == 2 || error->code == ERROR_NONE;
}

/* Is a folded name that of a camera, or one of its other names, by their short forms? */
static bool is_short_for(struct text folded, const struct lensdb_sensor *camera)
{
    char own[MOST_CAMERA_NAME];
    bool is_it = text_identical(camera_name_fold(camera->name, own), folded);
    struct text aliases = camera->aliases;
    while (!is_it && aliases.start != NULL && aliases.length > 0) {
        is_it = text_identical(camera_name_fold(text_cut(&aliases, ','), own), folded);
    }
    return is_it;
}

/* Look through the cameras of one place for what the name is short for. Two of one size are as good
   as one. */
static bool search_short(struct lensdb *db, enum lensdb_place place,
                         struct lensdb_sensors_search *search, struct error *error)
{
    struct lensdb_table cameras;
    struct lensdb_sensor camera;
    char short_form[MOST_CAMERA_NAME];
    if (!lensdb_sensors_open(&cameras, db, place, true, error)) {
        return error->code == ERROR_NONE;
    }
    while (next_words(&cameras, &camera, error)) {
        struct text model = search->name;
        cut_maker(&model, camera.maker);
        const struct text folded = camera_name_fold(model, short_form);
        if (folded.length < 2 || !is_short_for(folded, &camera)) {
            continue;
        }
        if (!read_sensor_row(&cameras, &camera, error)) {
            return false;
        }
        if (search->quality == 0) {
            search->found = camera;
            search->quality = 1;
        } else if (camera.size.width != search->found.size.width ||
                   camera.size.height != search->found.size.height) {
            search->ambiguous = true;
            search->second = camera;
        }
    }
    return error->code == ERROR_NONE;
}

/* -------- what to say where there is no such name -------- */

enum { MOST_RELATIVES = 3, MOST_NAME = MOST_CAMERA_NAME };

/* The cameras whose names begin most like the one that was typed. */
struct lensdb_sensors_family {
    struct text typed;
    struct text maker; /* where the maker alone was typed; else its start is null */
    struct nearest format, nearest;
    char
        nearest_name[MOST_NAME]; /* a copy of what `nearest` found, if that is no text of a table */
    struct lensdb_sensor relatives[MOST_RELATIVES];
    size_t shared[MOST_RELATIVES]; /* letters in common; falling */
    size_t count;
};

/* Keep it among the relatives, the longest beginnings first, then the shortest names. */
static void offer_relative(struct lensdb_sensors_family *family, const struct lensdb_sensor *sensor)
{
    struct text model = family->typed;
    bool by_maker = sensor->maker.length > 0 && cut_maker(&model, sensor->maker);
    char typed[MOST_NAME], own[MOST_NAME];
    const size_t folded =
        text_shared_name(camera_name_fold(model, typed), camera_name_fold(sensor->name, own));
    size_t shared = text_shared_name(model, sensor->name);
    shared = folded > shared ? folded : shared;
    if (shared < (by_maker ? 1 : 3)) {
        return;
    }
    size_t at = family->count;
    while (at > 0 && (shared > family->shared[at - 1] ||
                      (shared == family->shared[at - 1] &&
                       sensor->name.length < family->relatives[at - 1].name.length))) {
        at--;
    }
    if (at == MOST_RELATIVES) {
        return;
    }
    family->count += family->count < MOST_RELATIVES;
    for (size_t i = family->count - 1; i > at; i--) {
        family->relatives[i] = family->relatives[i - 1];
        family->shared[i] = family->shared[i - 1];
    }
    family->relatives[at] = *sensor;
    family->shared[at] = shared;
}

/* Offer all names of one table. */
static void offer_sensors(struct lensdb *db, enum lensdb_place place, bool cameras,
                          struct lensdb_sensors_family *family)
{
    struct lensdb_table sensors;
    struct lensdb_sensor sensor;
    struct error ignored;
    if (!lensdb_sensors_open(&sensors, db, place, cameras, &ignored)) {
        return;
    }
    while (lensdb_sensors_next(&sensors, &sensor, &ignored)) {
        struct text aliases = sensor.aliases;
        struct nearest *nearest = cameras ? &family->nearest : &family->format;
        nearest_offer(nearest, sensor.name);
        while (aliases.start != NULL && aliases.length > 0) {
            nearest_offer(nearest, text_cut(&aliases, ','));
        }
        if (cameras) {
            family->maker =
                text_same_name(family->typed, sensor.maker) ? sensor.maker : family->maker;
            /* "maker model" stands nowhere in one piece; a name that is kept is copied. */
            char name[MOST_NAME];
            snprintf(name, sizeof name, "%.*s %.*s", (int)sensor.maker.length, sensor.maker.start,
                     (int)sensor.name.length, sensor.name.start);
            nearest_offer(&family->nearest, text_of(name));
            if (family->nearest.best.start == name) {
                memcpy(family->nearest_name, name, sizeof name);
                family->nearest.best = text_of(family->nearest_name);
            }
            offer_relative(family, &sensor);
        }
    }
}

/* "'EOS R5' (36 x 24 mm), 'EOS R50' (22.3 x 14.9 mm)": the family, with its formats. */
static void name_relatives(const struct lensdb_sensors_family *family, char *words, size_t room)
{
    size_t used = 0;
    words[0] = '\0';
    for (size_t i = 0; i < family->count; i++) {
        const struct lensdb_sensor *sensor = &family->relatives[i];
        int length = snprintf(words + used, room - used, "%s'%.*s' (%g x %g mm)", i > 0 ? ", " : "",
                              (int)sensor->name.length, sensor->name.start, sensor->size.width,
                              sensor->size.height);
        if (length < 0 || used + (size_t)length >= room) {
            words[used] = '\0';
            return;
        }
        used += (size_t)length;
    }
}

static bool not_found(struct lensdb *db, struct text name, struct error *error)
{
    char relatives[140];
    struct lensdb_sensors_family family = {
        .typed = name, .format = {.typed = name}, .nearest = {.typed = name}};
    for (enum lensdb_place place = LENSDB_USER; place < LENSDB_PLACES; place++) {
        offer_sensors(db, place, false, &family);
        offer_sensors(db, place, true, &family);
    }
    name_relatives(&family, relatives, sizeof relatives);
    fail(error, ERROR_USAGE, "there is no format or camera '%.*s'", text_shown(name), name.start);
    if (family.maker.start != NULL) {
        return error_hint(error, "say which: see 'lenscalc list cameras %.*s'",
                          (int)family.maker.length, family.maker.start);
    }
    bool is_slip = family.format.best.start != NULL && family.format.distance <= 1;
    if (relatives[0] != '\0' && !is_slip) {
        return error_hint(error, "nearest of its family: %s", relatives);
    }
    struct text best =
        is_slip || family.nearest.best.start == NULL ? family.format.best : family.nearest.best;
    if (best.start != NULL) {
        return error_hint(error, "did you mean '%.*s'?", (int)best.length, best.start);
    }
    return error_hint(error, "see 'lenscalc list formats' and 'lenscalc list cameras', or give a "
                             "size such as 36x24mm");
}

bool lensdb_find_sensor(struct lensdb *db, struct text name, struct lensdb_sensor *sensor,
                        struct error *error)
{
    struct lensdb_sensors_search search = {.name = text_trim(name)};
    for (enum lensdb_place place = LENSDB_USER; place < LENSDB_PLACES && search.quality == 0;
         place++) {
        if (!search_table(db, place, false, &search, error) ||
            (search.quality == 0 && !search_table(db, place, true, &search, error))) {
            return false;
        }
    }
    for (enum lensdb_place place = LENSDB_USER; place < LENSDB_PLACES && search.quality == 0;
         place++) {
        if (!search_short(db, place, &search, error)) {
            return false;
        }
    }
    if (search.quality == 0) {
        return not_found(db, search.name, error);
    }
    if (search.ambiguous && search.quality == 1) {
        return fail(error, ERROR_USAGE, "'%.*s' is '%.*s %.*s' and '%.*s %.*s': say which",
                    (int)search.name.length, search.name.start, (int)search.found.maker.length,
                    search.found.maker.start, (int)search.found.name.length,
                    search.found.name.start, (int)search.second.maker.length,
                    search.second.maker.start, (int)search.second.name.length,
                    search.second.name.start);
    }
    *sensor = search.found;
    return true;
}
