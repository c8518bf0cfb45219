/* data/camera_family.c - what comes nearest to a camera that no table has. */
/* SPDX-License-Identifier: MIT */
#include "data/camera_family.h"

#include <stdio.h>
#include <string.h>

enum { MOST_RELATIVES = 3, MOST_NAME = MOST_CAMERA_NAME, SHORTEST_MAKER = 4 };

/* The cameras whose names begin most like the one that was typed. */
struct camera_family {
    struct text typed;
    struct text maker; /* where the maker alone was typed; else its start is null */
    struct nearest format, nearest;
    char
        nearest_name[MOST_NAME]; /* a copy of what `nearest` found, if that is no text of a table */
    struct camera_relative {
        struct lensdb_sensor sensor;
        size_t shared; /* letters in common */
        double apart;  /* of the numbers that follow them */
    } relatives[MOST_RELATIVES];
    size_t count;
};

/* Is the first more like the typed name than the second? */
static bool is_closer_relative(const struct camera_relative *a, const struct camera_relative *b)
{
    if (a->shared != b->shared) {
        return a->shared > b->shared;
    }
    return a->apart < b->apart ||
           (!(a->apart > b->apart) && a->sensor.name.length < b->sensor.name.length);
}

/* Keep it among the relatives: the longest beginnings first, then the nearest numbers, then the
   shortest names. */
static void offer_relative(struct camera_family *family, const struct lensdb_sensor *sensor)
{
    struct text model = family->typed;
    bool by_maker = sensor->maker.length > 0 && camera_name_cut_maker(&model, sensor->maker);
    char typed[MOST_NAME], own[MOST_NAME];
    const size_t folded =
        text_shared_name(camera_name_fold(model, typed), camera_name_fold(sensor->name, own));
    size_t shared = text_shared_name(model, sensor->name);
    shared = folded > shared ? folded : shared;
    if (shared < (by_maker ? 1 : 3)) {
        return;
    }
    const struct camera_relative relative = {*sensor, shared,
                                             camera_name_numbers_apart(model, sensor->name)};
    size_t at = family->count;
    while (at > 0 && is_closer_relative(&relative, &family->relatives[at - 1])) {
        at--;
    }
    if (at == MOST_RELATIVES) {
        return;
    }
    family->count += family->count < MOST_RELATIVES;
    for (size_t i = family->count - 1; i > at; i--) {
        family->relatives[i] = family->relatives[i - 1];
    }
    family->relatives[at] = relative;
}

/* Offer all names of one table. */
static void offer_sensors(struct lensdb *db, enum lensdb_place place, bool cameras,
                          struct camera_family *family)
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
static void name_relatives(const struct camera_family *family, char *words, size_t room)
{
    size_t used = 0;
    words[0] = '\0';
    for (size_t i = 0; i < family->count; i++) {
        const struct lensdb_sensor *sensor = &family->relatives[i].sensor;
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

struct text camera_family_respell(struct lensdb *db, struct text name,
                                  char respelled[MOST_CAMERA_NAME])
{
    struct text model = name;
    struct nearest nearest = {.typed = text_cut(&model, ' ')};
    struct lensdb_table cameras;
    struct lensdb_sensor camera;
    struct error ignored;
    if (model.start == NULL || nearest.typed.length < SHORTEST_MAKER) {
        return name;
    }
    for (enum lensdb_place place = LENSDB_USER; place < LENSDB_PLACES; place++) {
        if (lensdb_sensors_open(&cameras, db, place, true, &ignored)) {
            while (lensdb_sensors_words(&cameras, &camera, &ignored)) {
                camera_name_offer_maker(&nearest, camera.maker);
            }
        }
    }
    if (nearest.best.start == NULL || nearest.distance != 1) {
        return name;
    }
    int length = snprintf(respelled, MOST_CAMERA_NAME, "%.*s %.*s", (int)nearest.best.length,
                          nearest.best.start, (int)model.length, model.start);
    return length > 0 && length < MOST_CAMERA_NAME ? text_of(respelled) : name;
}

bool camera_family_hint(struct lensdb *db, struct text name, struct error *error)
{
    char relatives[140];
    struct camera_family family = {
        .typed = name, .format = {.typed = name}, .nearest = {.typed = name}};
    for (enum lensdb_place place = LENSDB_USER; place < LENSDB_PLACES; place++) {
        offer_sensors(db, place, false, &family);
        offer_sensors(db, place, true, &family);
    }
    name_relatives(&family, relatives, sizeof relatives);
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
