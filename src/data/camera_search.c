/* data/camera_search.c - formats and cameras by their names. */
/* SPDX-License-Identifier: MIT */
#include "data/camera_family.h"
#include "data/camera_name.h"
#include "data/lensdb.h"

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
        search->by_maker = camera_name_cut_maker(&search->model, sensor->maker);
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
    while (search->quality < 2 && lensdb_sensors_words(&sensors, &sensor, error)) {
        int quality = sensor_answers_to(&sensor, search);
        bool counts = quality > search->quality || (quality == 1 && search->quality == 1);
        if ((counts || place == LENSDB_USER) && !lensdb_sensors_numbers(&sensors, &sensor, error)) {
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

/* Is a folded name the short form of one of the words between separators? */
static bool is_short_of_one(struct text folded, struct text words, char separator)
{
    char own[MOST_CAMERA_NAME];
    bool is_it = false;
    while (!is_it && words.start != NULL && words.length > 0) {
        is_it = text_identical(camera_name_fold(text_cut(&words, separator), own), folded);
    }
    return is_it;
}

/* Is a folded name that of a camera, or one of its other names, by their short forms? */
static bool is_short_for(struct text folded, const struct lensdb_sensor *camera)
{
    return is_short_of_one(folded, camera->name, '/') ||
           is_short_of_one(folded, camera->aliases, ',');
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
    while (lensdb_sensors_words(&cameras, &camera, error)) {
        struct text model = search->name;
        camera_name_cut_maker(&model, camera.maker);
        const struct text folded = camera_name_fold(model, short_form);
        if (folded.length < 2 || !is_short_for(folded, &camera)) {
            continue;
        }
        if (!lensdb_sensors_numbers(&cameras, &camera, error)) {
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

/* Look through all places, by names first and then by short forms. */
static bool search_places(struct lensdb *db, struct lensdb_sensors_search *search,
                          struct error *error)
{
    for (enum lensdb_place place = LENSDB_USER; place < LENSDB_PLACES && search->quality == 0;
         place++) {
        if (!search_table(db, place, false, search, error) ||
            (search->quality == 0 && !search_table(db, place, true, search, error))) {
            return false;
        }
    }
    for (enum lensdb_place place = LENSDB_USER; place < LENSDB_PLACES && search->quality == 0;
         place++) {
        if (!search_short(db, place, search, error)) {
            return false;
        }
    }
    return true;
}

/* Is there a camera of this name if its maker is spelled right? Else the nearest names are told. */
static bool sensor_missing(struct lensdb *db, struct text name, struct error *error)
{
    char respelled[MOST_CAMERA_NAME];
    struct error ignored;
    struct lensdb_sensors_search meant = {.name = camera_family_respell(db, name, respelled)};
    const bool is_respelled = meant.name.start == respelled;
    fail(error, ERROR_USAGE, "there is no format or camera '%.*s'", text_shown(name), name.start);
    if (is_respelled && search_places(db, &meant, &ignored) && meant.quality > 0) {
        return error_hint(error, "did you mean '%.*s %.*s'?", (int)meant.found.maker.length,
                          meant.found.maker.start, (int)meant.found.name.length,
                          meant.found.name.start);
    }
    return camera_family_hint(db, is_respelled ? text_of(respelled) : name, error);
}

bool lensdb_find_sensor(struct lensdb *db, struct text name, struct lensdb_sensor *sensor,
                        struct error *error)
{
    struct lensdb_sensors_search search = {.name = text_trim(name)};
    if (!search_places(db, &search, error)) {
        return false;
    }
    if (search.quality == 0) {
        return sensor_missing(db, search.name, error);
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
