/* data/lensdb.c - the program's data, and the user's own in front of it. */
/* SPDX-License-Identifier: MIT */
#include "data/lensdb.h"

#include "base/number.h"
#include "data/embedded.h"
#include "data/whole_file.h"

#include <dirent.h>
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

/* A file of the user's folder, or the knowledge that there is none. */
struct lensdb_file {
    const char *name, *path;
    struct text content; /* start is null where there is no such file */
    struct lensdb_file *next;
};

static bool check_directory(const char *directory, struct error *error)
{
    struct stat status;
    if (stat(directory, &status) != 0) {
        return fail(error, ERROR_IO, "cannot read the folder %s: %s", directory, strerror(errno));
    }
    if (!S_ISDIR(status.st_mode)) {
        return fail(error, ERROR_IO, "cannot read %s: not a folder", directory);
    }
    return true;
}

static bool ends_with(const char *name, const char *ending)
{
    size_t length = strlen(name), last = strlen(ending);
    return name[0] != '.' && length > last && text_same(text_of(name + length - last), ending);
}

bool lensdb_list(const struct lensdb *db, const char *folder, const char *ending,
                 struct arena *arena, const char *const **names, struct error *error)
{
    static const char *const none[] = {NULL};
    const char **all = NULL;
    size_t count = 0, room = 0;
    *names = none;
    if (db->directory == NULL) {
        return true;
    }
    const char *path = arena_printf(arena, "%s/%s", db->directory, folder);
    DIR *directory = opendir(path);
    if (directory == NULL) {
        return errno == ENOENT || errno == ENOTDIR
                   ? check_directory(db->directory, error)
                   : fail(error, ERROR_IO, "cannot read the folder %s: %s", path, strerror(errno));
    }
    for (struct dirent *entry = readdir(directory); entry != NULL; entry = readdir(directory)) {
        if (ends_with(entry->d_name, ending)) {
            all = arena_grow(arena, all, count, &room, sizeof all[0]);
            all[count++] = arena_printf(arena, "%s/%s", folder, entry->d_name);
        }
    }
    closedir(directory);
    if (count > 0) {
        qsort(all, count, sizeof all[0], text_order);
        all = arena_grow(arena, all, count, &room, sizeof all[0]);
        all[count] = NULL;
        *names = all;
    }
    return true;
}

static bool load(struct lensdb *db, const char *name, struct lensdb_file **found,
                 struct error *error)
{
    for (struct lensdb_file *file = db->loaded; file != NULL; file = file->next) {
        if (strcmp(file->name, name) == 0) {
            *found = file;
            return true;
        }
    }
    struct lensdb_file *file = ARENA_NEW(db->arena, struct lensdb_file);
    file->name = arena_string(db->arena, name, strlen(name));
    file->path = arena_printf(db->arena, "%s/%s", db->directory, name);
    if (!whole_file(file->path, db->arena, &file->content, error) &&
        (error->code != ERROR_NONE || !check_directory(db->directory, error))) {
        return false;
    }
    file->next = db->loaded;
    db->loaded = file;
    *found = file;
    return true;
}

static bool open_user(struct lensdb *db, const char *name, struct tsv *tsv, struct error *error)
{
    struct lensdb_file *file = NULL;
    if (db->directory == NULL || !load(db, name, &file, error) || file->content.start == NULL) {
        return false;
    }
    return tsv_open(tsv, file->path, file->content, error);
}

bool lensdb_open(struct lensdb *db, enum lensdb_place place, const char *file, struct tsv *tsv,
                 struct error *error)
{
    error->code = ERROR_NONE;
    if (place == LENSDB_USER) {
        return open_user(db, file, tsv, error);
    }
    for (const struct embedded_file *at = embedded_files; at->name != NULL; at++) {
        if (strcmp(at->name, file) == 0) {
            return tsv_open(tsv, at->name, (struct text){at->data, at->length}, error);
        }
    }
    return false;
}

/* A column that a user's table may leave out. */
static size_t column_or_none(const struct tsv *tsv, const char *name)
{
    struct error ignored;
    size_t column;
    return tsv_column(tsv, name, &column, &ignored) ? column : TSV_MOST_COLUMNS;
}

bool lensdb_sensors_open(struct lensdb_sensors *sensors, struct lensdb *db, enum lensdb_place place,
                         bool cameras, struct error *error)
{
    const char *file = cameras ? "cameras.tsv" : "formats.tsv";
    sensors->place = place;
    sensors->cameras = cameras;
    struct tsv *tsv = &sensors->tsv;
    if (!lensdb_open(db, place, file, tsv, error) ||
        !tsv_column(tsv, cameras ? "model" : "name", &sensors->name, error) ||
        !tsv_column(tsv, "width_mm", &sensors->width, error) ||
        !tsv_column(tsv, "height_mm", &sensors->height, error)) {
        return false;
    }
    sensors->maker = column_or_none(tsv, "maker");
    sensors->aliases = column_or_none(tsv, "aliases");
    sensors->class = column_or_none(tsv, "class");
    sensors->pixels_wide = column_or_none(tsv, "px_w");
    sensors->pixels_high = column_or_none(tsv, "px_h");
    sensors->pitch = column_or_none(tsv, "pitch_um");
    sensors->pitch_from = column_or_none(tsv, "pitch_from");
    sensors->confidence = column_or_none(tsv, "confidence");
    sensors->source = column_or_none(tsv, "source");
    return true;
}

static struct text cell_of(const struct tsv *tsv, size_t column)
{
    return column < TSV_MOST_COLUMNS ? tsv->cells[column] : (struct text){"", 0};
}

/* A number of the present row that must be positive if it is there; absent columns give NaN. */
static bool read_positive(const struct tsv *tsv, size_t column, double *value, struct error *error)
{
    *value = NAN;
    if (column >= TSV_MOST_COLUMNS) {
        return true;
    }
    if (!tsv_number(tsv, column, value, error)) {
        return false;
    }
    if (!isnan(*value) && (!(*value > 0) || isinf(*value))) {
        return tsv_fail(tsv, column, error, "must be a number above 0");
    }
    return true;
}

static bool read_sensor(struct lensdb_sensors *sensors, struct lensdb_sensor *sensor,
                        struct error *error)
{
    const struct tsv *tsv = &sensors->tsv;
    double pitch_um;
    if (!read_positive(tsv, sensors->width, &sensor->size.width, error) ||
        !read_positive(tsv, sensors->height, &sensor->size.height, error) ||
        !read_positive(tsv, sensors->pixels_wide, &sensor->pixels_wide, error) ||
        !read_positive(tsv, sensors->pixels_high, &sensor->pixels_high, error) ||
        !read_positive(tsv, sensors->pitch, &pitch_um, error)) {
        return false;
    }
    if (isnan(sensor->size.width) || isnan(sensor->size.height)) {
        return tsv_fail(tsv, isnan(sensor->size.width) ? sensors->width : sensors->height, error,
                        "is missing");
    }
    sensor->size.pitch = pitch_um / 1000;
    return true;
}

bool lensdb_sensors_next(struct lensdb_sensors *sensors, struct lensdb_sensor *sensor,
                         struct error *error)
{
    const struct tsv *tsv = &sensors->tsv;
    if (!tsv_next(&sensors->tsv, error)) {
        return false;
    }
    *sensor = (struct lensdb_sensor){
        .maker = cell_of(tsv, sensors->maker),
        .name = cell_of(tsv, sensors->name),
        .aliases = cell_of(tsv, sensors->aliases),
        .class = cell_of(tsv, sensors->class),
        .pitch_from = cell_of(tsv, sensors->pitch_from),
        .confidence = cell_of(tsv, sensors->confidence),
        .source = cell_of(tsv, sensors->source),
        .place = sensors->place,
    };
    return read_sensor(sensors, sensor, error);
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

/* Does `name` begin with the maker? Then cut the maker off. */
static bool cut_maker(struct text *name, struct text maker)
{
    for (size_t i = 1; maker.length > 0 && i < name->length; i++) {
        if (text_same_name((struct text){name->start, i}, maker)) {
            *name = (struct text){name->start + i, name->length - i};
            return true;
        }
    }
    return false;
}

/* How well does a sensor answer to a name? 0 not at all, 1 by model, 2 fully. */
static int answers_to(const struct lensdb_sensor *sensor, struct text name)
{
    if (sensor->maker.length == 0) {
        return text_same_name(sensor->name, name) || is_one_of(name, sensor->aliases, ',') ? 2 : 0;
    }
    bool full = cut_maker(&name, sensor->maker);
    if (text_same_name(sensor->name, name)) {
        return full ? 2 : 1;
    }
    return is_one_of(name, sensor->name, '/') ? 1 : 0;
}

struct search {
    struct text name;
    struct nearest nearest;
    char full_name[128]; /* of the nearest camera */
    struct lensdb_sensor found, second;
    int quality; /* of found */
    bool ambiguous;
};

/* Look through one table; stops at a full match. */
static bool search_table(struct lensdb *db, enum lensdb_place place, bool cameras,
                         struct search *search, struct error *error)
{
    struct lensdb_sensors sensors;
    struct lensdb_sensor sensor;
    if (!lensdb_sensors_open(&sensors, db, place, cameras, error)) {
        return error->code == ERROR_NONE;
    }
    while (search->quality < 2 && lensdb_sensors_next(&sensors, &sensor, error)) {
        int quality = answers_to(&sensor, search->name);
        if (quality == 1 && search->quality == 1) {
            search->ambiguous = true;
            search->second = sensor;
        } else if (quality > search->quality) {
            search->found = sensor;
            search->quality = quality;
        }
    }
    return search->quality == 2 || error->code == ERROR_NONE;
}

/* Offer "maker model", which stands nowhere in one piece; a name that is kept is copied. */
static void offer_camera(struct search *search, const struct lensdb_sensor *sensor)
{
    char name[sizeof search->full_name];
    snprintf(name, sizeof name, "%.*s %.*s", (int)sensor->maker.length, sensor->maker.start,
             (int)sensor->name.length, sensor->name.start);
    nearest_offer(&search->nearest, text_of(name));
    if (search->nearest.best.start == name) {
        memcpy(search->full_name, name, sizeof name);
        search->nearest.best = text_of(search->full_name);
    }
}

/* Offer all names of one table to the search for the nearest. */
static void offer_names(struct lensdb *db, enum lensdb_place place, bool cameras,
                        struct search *search)
{
    struct lensdb_sensors sensors;
    struct lensdb_sensor sensor;
    struct error ignored;
    if (!lensdb_sensors_open(&sensors, db, place, cameras, &ignored)) {
        return;
    }
    while (lensdb_sensors_next(&sensors, &sensor, &ignored)) {
        nearest_offer(&search->nearest, sensor.name);
        while (sensor.aliases.start != NULL && sensor.aliases.length > 0) {
            nearest_offer(&search->nearest, text_cut(&sensor.aliases, ','));
        }
        if (cameras) {
            offer_camera(search, &sensor);
        }
    }
}

static bool not_found(struct lensdb *db, struct search *search, struct error *error)
{
    struct text name = search->name;
    for (enum lensdb_place place = LENSDB_USER; place < LENSDB_PLACES; place++) {
        offer_names(db, place, false, search);
        offer_names(db, place, true, search);
    }
    fail(error, ERROR_USAGE, "there is no format or camera '%.*s'",
         (int)(name.length < 80 ? name.length : 80), name.start);
    if (search->nearest.best.start != NULL) {
        error_hint(error, "did you mean '%.*s'?", (int)search->nearest.best.length,
                   search->nearest.best.start);
    } else {
        error_hint(error, "see 'lenscalc list formats' and 'lenscalc list cameras', or give a size "
                          "such as 36x24mm");
    }
    return false;
}

bool lensdb_find_sensor(struct lensdb *db, struct text name, struct lensdb_sensor *sensor,
                        struct error *error)
{
    struct search search = {.name = text_trim(name), .nearest = {.typed = text_trim(name)}};
    for (enum lensdb_place place = LENSDB_USER; place < LENSDB_PLACES && search.quality == 0;
         place++) {
        if (!search_table(db, place, false, &search, error) ||
            (search.quality == 0 && !search_table(db, place, true, &search, error))) {
            return false;
        }
    }
    if (search.quality == 0) {
        return not_found(db, &search, error);
    }
    if (search.ambiguous && search.quality == 1) {
        return fail(error, ERROR_USAGE, "'%.*s' is a camera of %.*s and of %.*s: say which",
                    (int)search.name.length, search.name.start, (int)search.found.maker.length,
                    search.found.maker.start, (int)search.second.maker.length,
                    search.second.maker.start);
    }
    *sensor = search.found;
    return true;
}

/* "1/125" or "0.3" or "5.6". */
static bool label_value(struct text label, double *value)
{
    const char *end = label.start + label.length;
    const char *after = number_read(label.start, end, NUMBER_UNSCALED, value);
    if (after != NULL && after < end && *after == '/') {
        double denominator;
        after = number_read(after + 1, end, NUMBER_UNSCALED, &denominator);
        *value /= denominator;
    }
    return after == end && *value > 0;
}

static double exact_stop(const char *file, int step, int divisor)
{
    double stops = (double)step / divisor;
    if (strcmp(file, "fstops.tsv") == 0) {
        return exp2(stops / 2);
    }
    return strcmp(file, "shutters.tsv") == 0 ? exp2(-stops) : 3.125 * exp2(stops);
}

static int divisor_of(const char *series)
{
    return strcmp(series, "full") == 0 ? 1 : strcmp(series, "half") == 0 ? 2 : 3;
}

static bool read_stop(const struct tsv *tsv, const size_t *columns, const char *file,
                      const char *series, struct lensdb_stop *stop, struct error *error)
{
    double step;
    if (!tsv_number(tsv, columns[1], &step, error)) {
        return false;
    }
    if (!(fabs(step) <= 1000) || step != floor(step)) {
        return tsv_fail(tsv, columns[1], error, "must be a whole number from -1000 to 1000");
    }
    *stop = (struct lensdb_stop){.label = tsv->cells[columns[2]],
                                 .note = tsv->cells[columns[3]],
                                 .step = (int)step,
                                 .divisor = divisor_of(series)};
    stop->exact = exact_stop(file, stop->step, stop->divisor);
    if (!label_value(stop->label, &stop->value)) {
        return tsv_fail(tsv, columns[2], error, "is no label of a stop series");
    }
    return true;
}

/* Read one table's rows of the series behind those already there. */
static bool add_stops(struct lensdb *db, enum lensdb_place place, const char *file,
                      const char *series, struct lensdb_stop *stops, size_t most, size_t *count,
                      struct error *error)
{
    static const char *const names[] = {"series", "step", "label", "note"};
    struct tsv tsv;
    size_t columns[4];
    if (!lensdb_open(db, place, file, &tsv, error)) {
        return error->code == ERROR_NONE;
    }
    for (size_t i = 0; i < 4; i++) {
        if (!tsv_column(&tsv, names[i], &columns[i], error)) {
            return false;
        }
    }
    while (*count < most && tsv_next(&tsv, error)) {
        if (text_equal(tsv.cells[columns[0]], series) &&
            !read_stop(&tsv, columns, file, series, &stops[(*count)++], error)) {
            return false;
        }
    }
    return error->code == ERROR_NONE;
}

/* A series is read once: a batch asks for it in every row. */
struct lensdb_series {
    const char *file, *name;
    struct lensdb_stop *stops;
    size_t count;
    struct lensdb_series *next;
};

bool lensdb_stops(struct lensdb *db, const char *file, const char *series,
                  struct lensdb_stop **stops, size_t *count, struct error *error)
{
    enum { MOST_STOPS = 512 };
    error->code = ERROR_NONE;
    for (const struct lensdb_series *at = db->series; at != NULL; at = at->next) {
        if (strcmp(at->file, file) == 0 && strcmp(at->name, series) == 0) {
            *stops = at->stops;
            *count = at->count;
            return true;
        }
    }
    *stops = ARENA_ARRAY(db->arena, MOST_STOPS, struct lensdb_stop);
    *count = 0;
    /* the user's series replaces the embedded one: two in one would not be a series */
    for (enum lensdb_place place = LENSDB_USER; place < LENSDB_PLACES && *count == 0; place++) {
        if (!add_stops(db, place, file, series, *stops, MOST_STOPS, count, error)) {
            return false;
        }
    }
    struct lensdb_series *read = ARENA_NEW(db->arena, struct lensdb_series);
    *read = (struct lensdb_series){arena_string(db->arena, file, strlen(file)),
                                   arena_string(db->arena, series, strlen(series)), *stops, *count,
                                   db->series};
    db->series = read;
    return true;
}
