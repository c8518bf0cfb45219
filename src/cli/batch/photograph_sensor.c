/* cli/batch/photograph_sensor.c - the sensor, or the part of it, that took a photograph. */
/* SPDX-License-Identifier: MIT */
#include "cli/batch/photograph_sensor.h"

#include <math.h>
#include <string.h>

/* Makers of lensdb that files have by other names, which begin so. */
static const struct {
    const char *make, *maker;
} other_makes[] = {
    {"Hasselblad", "DJI"}, /* the cameras of its larger drones */
    {"OM Digital", "OM System"},  {"OM Digital", "Olympus"}, {"Olympus", "OM System"},
    {"Ricoh", "Pentax"},          {"Pentax", "Ricoh"},       {"Asahi", "Pentax"},
    {"Konica", "Konica-Minolta"}, {"Eastman", "Kodak"},
};

/* Is it a camera of this maker? */
static bool is_by(const struct lensdb_sensor *camera, struct text make)
{
    if (camera->maker.length == 0) {
        return false; /* a format that is called like the camera */
    }
    bool found = make.length == 0 || text_contains_name(make, camera->maker);
    for (size_t i = 0; i < sizeof other_makes / sizeof other_makes[0] && !found; i++) {
        found = text_contains_name(make, text_of(other_makes[i].make)) &&
                text_same_name(camera->maker, text_of(other_makes[i].maker));
    }
    return found;
}

static bool camera_named(const struct reader *reader, struct text name, struct text make,
                         struct lensdb_sensor *camera, struct error *error)
{
    return lensdb_find_sensor(reader->db, name, camera, error) &&
           (is_by(camera, make) || fail(error, ERROR_USAGE, "a camera of another maker"));
}

/* "NIKON CORPORATION" has cameras "NIKON D850", "FUJIFILM" the "X-T4", Canon "EOS 350D DIGITAL". */
static bool camera_find(const struct reader *reader, const struct metadata *metadata,
                        struct lensdb_sensor *camera, struct error *error)
{
    static const char digital[] = " DIGITAL";
    struct text make = text_of(metadata->make), model = text_of(metadata->model);
    struct text rest = make;
    const struct text maker = text_cut(&rest, ' ');
    if (model.length > strlen(digital) &&
        text_equal(text_of(metadata->model + model.length - strlen(digital)), digital)) {
        model.length -= strlen(digital);
    }
    if (model.length == 0) {
        return fail(error, ERROR_USAGE, "no camera");
    }
    if (camera_named(reader, model, make, camera, error)) {
        return true;
    }
    if (error->code != ERROR_USAGE) {
        return false;
    }
    /* several makers may have one of that name */
    const char *both = arena_printf(reader->arena, "%.*s %.*s", (int)maker.length, maker.start,
                                    (int)model.length, model.start);
    return camera_named(reader, text_of(both), make, camera, error);
}

static double text_length(struct text text)
{
    double number;
    return text_number(text, NUMBER_UNSCALED, &number) ? number : NAN;
}

/* How far a focal length is from that of a camera's lens, as a logarithm; NaN: unknown. */
static double focal_miss(const struct lensdb_sensor *camera, double focal)
{
    return fabs(log(text_length(camera->focal) / focal));
}

/* Other cameras of a phone or drone are called like it and these. */
static bool is_module(struct text name)
{
    static const char *const modules[] = {"tele", "ultra wide", "medium tele"};
    bool found = false;
    for (size_t i = 0; i < sizeof modules / sizeof modules[0] && !found; i++) {
        found = text_equal(name, modules[i]);
    }
    return found;
}

/* Is it a module of the main camera? One has "iPhone 13 Pro", the other "iPhone 13 Pro tele". */
static bool is_module_of(const struct lensdb_sensor *module, const struct lensdb_sensor *camera)
{
    const size_t length = camera->name.length;
    return text_identical(module->maker, camera->maker) && module->name.length > length + 1 &&
           text_identical((struct text){module->name.start, length}, camera->name) &&
           is_module(
               (struct text){module->name.start + length + 1, module->name.length - length - 1});
}

/* Of the cameras of a phone the one whose lens has this focal length, where one has. */
static void camera_choose(const struct reader *reader, double focal, struct lensdb_sensor *camera)
{
    static const double alike = 0.04; /* focal lengths in files are rounded to 0.1 mm */
    const struct lensdb_sensor main = *camera;
    struct lensdb_table cameras;
    struct lensdb_sensor other;
    struct error ignored;
    double least = focal_miss(&main, focal);
    if (isnan(focal) || !(least > alike) ||
        !(text_equal(main.class, "phone") || text_equal(main.class, "drone")) ||
        !lensdb_sensors_open(&cameras, reader->db, main.place, true, &ignored)) {
        return;
    }
    while (lensdb_sensors_next(&cameras, &other, &ignored)) {
        const double miss = focal_miss(&other, focal);
        if (miss < alike && miss < least && is_module_of(&other, &main)) {
            least = miss;
            *camera = other;
        }
    }
}

/* mm, to 0.01 as it is printed. */
static struct sensor size_of_diagonal(double diagonal, double ratio)
{
    const double height = diagonal / hypot(ratio, 1);
    return (struct sensor){round(100 * ratio * height) / 100, round(100 * height) / 100, NAN};
}

static void sensor_by_focal(const struct reader *reader, const struct metadata *metadata,
                            const char *camera, double ratio, struct sensor_value *sensor)
{
    static const struct sensor film = {36, 24, NAN};
    const double diagonal = sensor_diagonal(&film) * metadata->focal / metadata->equivalent;
    const struct sensor size = size_of_diagonal(diagonal, ratio);
    *sensor = (struct sensor_value){.size = size, .focal = NAN, .fnumber = NAN};
    /* what is before the brackets reads back as this size */
    sensor->name =
        arena_printf(reader->arena, "%.6g x %.6g mm (%s: %.4g mm is %.4gmm-eq)", size.width,
                     size.height, camera, metadata->focal, metadata->equivalent);
}

/* The shape of an unknown camera's sensor: that of the picture, where no more than its edges is cut
   off, else that of most sensors of such a size. */
static double picture_ratio(const struct metadata *metadata)
{
    static const double shapes[] = {4.0 / 3, 3.0 / 2}, alike = 0.03, aps_c = 1.8;
    const double ratio = metadata->long_side / metadata->low_side;
    for (size_t i = 0; i < sizeof shapes / sizeof shapes[0]; i++) {
        if (fabs(ratio / shapes[i] - 1) < alike) {
            return ratio;
        }
    }
    return metadata->equivalent / metadata->focal < aps_c ? shapes[1] : shapes[0];
}

/* How much smaller than 35 mm film the file says that the picture is; NaN: nothing, or nonsense. */
static double stated_crop(const struct metadata *metadata)
{
    static const double least = 0.2, most = 40; /* plates of 8 x 10 inches, endoscopes */
    const double crop = metadata->equivalent / metadata->focal;
    return crop > least && crop < most ? crop : NAN;
}

bool photograph_sensor(const struct reader *reader, const struct metadata *metadata,
                       struct sensor_value *sensor, struct warnings *doubts, struct error *error)
{
    struct lensdb_sensor camera;
    const double crop = stated_crop(metadata);
    /* equivalents are whole mm, short focal lengths have one decimal, and makers round sizes */
    const double slack = 0.06 + 0.6 / metadata->equivalent + 0.05 / metadata->focal;
    if (!camera_find(reader, metadata, &camera, error)) {
        if (error->code != ERROR_USAGE) {
            return false;
        }
        const bool has_name = metadata->model[0] != '\0';
        if (isnan(crop)) {
            return has_name ? fail(error, ERROR_USAGE,
                                   "'%s' is no camera of lensdb, and no equivalent focal length "
                                   "says how large it is: {--sensor} missing",
                                   metadata->model)
                            : fail(error, ERROR_USAGE,
                                   "no camera is named, and no equivalent focal length says how "
                                   "large it is: {--sensor} missing");
        }
        sensor_by_focal(reader, metadata, has_name ? metadata->model : "unknown camera",
                        picture_ratio(metadata), sensor);
        return true;
    }
    camera_choose(reader, metadata->focal, &camera);
    option_sensor_of(reader, &camera, sensor);
    const double known = sensor_crop(&camera.size);
    if (crop > known * (1 + slack)) {
        const char *name =
            arena_printf(reader->arena, "%.*s %.*s", (int)camera.maker.length, camera.maker.start,
                         (int)camera.name.length, camera.name.start);
        sensor_by_focal(reader, metadata, name, camera.size.width / camera.size.height, sensor);
    } else if (crop < known / (1 + slack)) {
        warnings_add(doubts,
                     "%s: a photograph's %.4g mm is to be %.4gmm-eq, which takes a sensor larger "
                     "than that",
                     sensor->name, metadata->focal, metadata->equivalent);
    }
    return true;
}
