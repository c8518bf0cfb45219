/* commands/data/list_sensors.c - lenscalc list: formats and cameras. */
/* SPDX-License-Identifier: MIT */
#include "commands/data/list.h"

struct sensor_row {
    const char *name, *aliases, *class, *pitch_from, *confidence, *source, *place;
    double width, height, diagonal, crop, coc, pixels_wide, pixels_high, pitch;
};

#define SENSOR(member) COLUMN(struct sensor_row, member)
#define SENSOR_LENGTH(member, in_unit)                                                             \
    SENSOR(member), .dimension = &dimension_length, .unit = in_unit

#define SENSOR_SIZE                                                                                \
    {SENSOR_LENGTH(width, "mm"), .name = "width", .flags = COLUMN_BRIEF | COLUMN_ECHO,             \
     .label = "width", .help = "width of the picture area"},                                       \
        {SENSOR_LENGTH(height, "mm"), .name = "height", .flags = COLUMN_BRIEF | COLUMN_ECHO,       \
         .label = "height", .help = "height of the picture area"},                                 \
        {SENSOR_LENGTH(diagonal, "mm"), .name = "diagonal", .flags = COLUMN_BRIEF,                 \
         .label = "diagonal", .help = "diagonal of the picture area"},                             \
    {                                                                                              \
        SENSOR(crop), .name = "crop_factor", .flags = COLUMN_BRIEF, .label = "crop factor",        \
                      .help = "43.27 mm over the diagonal"                                         \
    }

#define SENSOR_ORIGIN                                                                              \
    {SENSOR(confidence), .name = "confidence", .flags = COLUMN_BRIEF, .label = "confidence",       \
     .help = "sourced, recall (from memory) or approx"},                                           \
        {SENSOR(source), .name = "source", .label = "source",                                      \
         .help = "where the figures are from"},                                                    \
    {                                                                                              \
        SENSOR(place), .name = "database", .label = "database",                                    \
                       .help = "embedded, or the user's own folder"                                \
    }

static const struct column format_columns[] = {
    {SENSOR(name), .name = "format", .flags = COLUMN_BRIEF, .label = "format",
     .help = "name of the format"},
    {SENSOR(aliases), .name = "aliases", .flags = COLUMN_BRIEF, .label = "also called",
     .help = "other names of the format"},
    SENSOR_SIZE,
    {SENSOR_LENGTH(coc, "mm"), .name = "coc", .flags = COLUMN_BRIEF, .label = "d/1500",
     .help = "circle of confusion, diagonal / 1500"},
    {SENSOR(class), .name = "class", .flags = COLUMN_BRIEF, .label = "class",
     .help = "kind of format"},
    SENSOR_ORIGIN,
};

static const struct column camera_columns[] = {
    {SENSOR(name), .name = "camera", .flags = COLUMN_BRIEF, .label = "camera",
     .help = "maker and model"},
    {SENSOR(aliases), .name = "aliases", .label = "also called",
     .help = "other names: short, in EXIF, of sensor modes"},
    {SENSOR(class), .name = "class", .flags = COLUMN_BRIEF, .label = "class",
     .help = "dslr, mirrorless, rangefinder, compact, cine, phone, drone or action"},
    SENSOR_SIZE,
    {SENSOR(pixels_wide), .name = "pixels_wide", .flags = COLUMN_BRIEF | COLUMN_ECHO,
     .label = "pixels wide", .help = "pixel count along the width"},
    {SENSOR(pixels_high), .name = "pixels_high", .flags = COLUMN_BRIEF | COLUMN_ECHO,
     .label = "pixels high", .help = "pixel count along the height"},
    {SENSOR_LENGTH(pitch, "um"), .name = "pitch", .flags = COLUMN_BRIEF, .label = "pixel pitch",
     .help = "spacing of the pixels"},
    {SENSOR(pitch_from), .name = "pitch_from", .flags = COLUMN_BRIEF, .label = "pitch from",
     .help = "published, counts (width over pixels), or estimate (from an estimated count)"},
    SENSOR_ORIGIN,
};

static bool list_sensors(struct list *list, enum lensdb_place place, bool cameras,
                         struct error *error)
{
    struct lensdb_sensors sensors;
    struct lensdb_sensor sensor;
    if (!lensdb_sensors_open(&sensors, list->run->db, place, cameras, error)) {
        return error->code == ERROR_NONE;
    }
    while (lensdb_sensors_next(&sensors, &sensor, error)) {
        struct sensor_row row = {
            .name = list_string(list, sensor.name),
            .aliases = list_string(list, sensor.aliases),
            .class = list_string(list, sensor.class),
            .pitch_from = list_string(list, sensor.pitch_from),
            .confidence = list_string(list, sensor.confidence),
            .source = list_string(list, sensor.source),
            .place = list_place(place),
            .width = sensor.size.width,
            .height = sensor.size.height,
            .diagonal = sensor_diagonal(&sensor.size),
            .crop = sensor_crop(&sensor.size),
            .coc = sensor_diagonal(&sensor.size) / 1500,
            .pixels_wide = sensor.pixels_wide,
            .pixels_high = sensor.pixels_high,
            .pitch = sensor.size.pitch,
        };
        if (sensor.maker.length > 0) {
            row.name = arena_printf(list->run->arena, "%.*s %s", (int)sensor.maker.length,
                                    sensor.maker.start, row.name);
        }
        const char *kind = cameras ? list_string(list, sensor.maker) : row.class;
        if (list_matches(list, kind, (const char *[]){row.name, row.aliases, row.class}, 3)) {
            list_row(list, &row);
        }
    }
    return error->code == ERROR_NONE;
}

static bool list_sensors_list_formats(struct list *list, struct error *error)
{
    return list_sensors(list, LENSDB_USER, false, error) &&
           list_sensors(list, LENSDB_EMBEDDED, false, error);
}

static bool list_cameras(struct list *list, struct error *error)
{
    return list_sensors(list, LENSDB_USER, true, error) &&
           list_sensors(list, LENSDB_EMBEDDED, true, error);
}

const struct topic topic_formats = {SHEET(format_columns, struct sensor_row),
                                    list_sensors_list_formats};
const struct topic topic_cameras = {SHEET(camera_columns, struct sensor_row), list_cameras};
