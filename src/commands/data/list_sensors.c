/* commands/data/list_sensors.c - lenscalc list: formats and cameras. */
/* SPDX-License-Identifier: MIT */
#include "commands/data/list.h"
#include "commands/tables.h"

struct sensor_row {
    const char *name, *aliases, *class, *pitch_from, *confidence, *source, *place;
    const char *focal, *equivalent, *fnumber;
    double width, height, diagonal, crop, coc, pixels_wide, pixels_high, pitch;
};

#define ROW struct sensor_row

#define SENSOR_SIZE                                                                                \
    ENTRY(LENGTH(width, "mm"), .name = "width", BRIEF | COLUMN_ECHO,                               \
          .help = "width of the picture area"),                                                    \
        ENTRY(LENGTH(height, "mm"), .name = "height", BRIEF | COLUMN_ECHO,                         \
              .help = "height of the picture area"),                                               \
        ENTRY(LENGTH(diagonal, "mm"), .name = "diagonal", BRIEF,                                   \
              .help = "diagonal of the picture area"),                                             \
        ENTRY(SHOWN(crop), .name = "crop_factor", BRIEF, .label = "crop factor",                   \
              .help = "43.27 mm over the diagonal")

#define SENSOR_ORIGIN                                                                              \
    ENTRY(SHOWN(confidence), .name = "confidence", BRIEF, .help = "sourced or approx"),            \
        ENTRY(SHOWN(source), .name = "source", .help = "where the figures are from"),              \
        ENTRY(SHOWN(place), .name = "database", .help = "embedded, or the user's own folder")

static const struct column format_columns[] = {
    {SHOWN(name), .name = "format", BRIEF, .help = "name of the format"},
    {SHOWN(aliases), .name = "aliases", BRIEF, .label = "also called",
     .help = "other names of the format"},
    SENSOR_SIZE,
    {LENGTH(coc, "mm"), .name = "coc", BRIEF, .label = "d/1500",
     .help = "circle of confusion, diagonal / 1500"},
    {SHOWN(class), .name = "class", BRIEF, .help = "kind of format"},
    SENSOR_ORIGIN,
};

static const struct column camera_columns[] = {
    {SHOWN(name), .name = "camera", BRIEF, .help = "maker and model"},
    {SHOWN(aliases), .name = "aliases", BRIEF | COLUMN_SPARSE, .label = "also called",
     .help = "other names: short, in EXIF, of sensor modes"},
    {SHOWN(class), .name = "class", BRIEF,
     .help = "dslr, mirrorless, rangefinder, compact, cine, phone, drone, action, sensor or "
             "astronomy"},
    SENSOR_SIZE,
    {SHOWN(pixels_wide), .name = "pixels_wide", BRIEF | COLUMN_ECHO, .label = "pixels wide",
     .help = "pixel count along the width"},
    {SHOWN(pixels_high), .name = "pixels_high", BRIEF | COLUMN_ECHO, .label = "pixels high",
     .help = "pixel count along the height"},
    {LENGTH(pitch, "um"), .name = "pitch", BRIEF, .label = "pixel pitch",
     .help = "spacing of the pixels"},
    {SHOWN(pitch_from), .name = "pitch_from", BRIEF, .label = "pitch from",
     .help = "published, counts (width over pixels), or estimate (from an estimated count)"},
    {SHOWN(focal), .name = "focal_mm", BRIEF, .label = "lens mm",
     .help = "focal length of a fixed lens; of a zoom both ends, as 24-70"},
    {SHOWN(equivalent), .name = "equivalent_mm", BRIEF, .label = "on 35 mm film",
     .help = "focal length with the same field on 35 mm film, as the maker rounds it"},
    {SHOWN(fnumber), .name = "fnumber", .label = "f-number",
     .help = "largest aperture of a fixed lens; of a zoom at both ends"},
    SENSOR_ORIGIN,
};

static bool list_sensors(struct list *list, struct error *error)
{
    const bool cameras = list->topic == &topic_cameras;
    struct lensdb_table sensors;
    struct lensdb_sensor sensor;
    if (!lensdb_sensors_open(&sensors, list->run->db, list->place, cameras, error)) {
        return error->code == ERROR_NONE;
    }
    while (lensdb_sensors_next(&sensors, &sensor, error)) {
        struct sensor_row row = {
            .name = list_string(list, sensor.name),
            .aliases = list_string(list, sensor.aliases),
            .class = list_string(list, sensor.class),
            .pitch_from = list_string(list, sensor.pitch_from),
            .focal = list_string(list, sensor.focal),
            .equivalent = list_string(list, sensor.equivalent),
            .fnumber = list_string(list, sensor.fnumber),
            .confidence = list_string(list, sensor.confidence),
            .source = list_string(list, sensor.source),
            .place = list_place(list->place),
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
        list_offer(list, &row, kind, (const char *[]){row.name, row.aliases, row.class}, 3);
    }
    return error->code == ERROR_NONE;
}

const struct topic topic_formats = {SHEET(format_columns, struct sensor_row), list_sensors, true};
const struct topic topic_cameras = {SHEET(camera_columns, struct sensor_row), list_sensors, true};
