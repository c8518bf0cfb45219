/* data/lensdb_sensors.c - formats and cameras of lensdb, row by row. */
/* SPDX-License-Identifier: MIT */
#include "data/lensdb.h"

#include <math.h>

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

bool lensdb_sensors_numbers(struct lensdb_table *sensors, struct lensdb_sensor *sensor,
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

bool lensdb_sensors_words(struct lensdb_table *sensors, struct lensdb_sensor *sensor,
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
    return lensdb_sensors_words(sensors, sensor, error) &&
           lensdb_sensors_numbers(sensors, sensor, error);
}
