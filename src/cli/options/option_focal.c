/* cli/options/option_focal.c - focal lengths, real ones and those equivalent on 36 x 24 mm. */
/* SPDX-License-Identifier: MIT */
#include "cli/options/option.h"

#include "base/number.h"

#include <math.h>
#include <string.h>

/* mm: the longest equivalent of a main lens; and cameras of larger sensors have other lenses too */
static const double LONGEST_MAIN = 40, LARGEST_DIAGONAL = 21;

static void focal_set_number(void *member, double number, const struct unit *unit)
{
    const bool is_equivalent = unit_is_equivalent(unit);
    struct focal_value *focal = member; /* what an earlier row took from a camera stays known */
    focal->length = is_equivalent ? (double)NAN : number;
    focal->equivalent = is_equivalent ? number : (double)NAN;
    focal->of_camera = false;
}

static bool focal_read(const struct reader *reader, const struct option *option, struct text text,
                       void *member, struct error *error)
{
    double value;
    const struct unit *typed;
    if (!quantity_read(text, option->dimension, option_unit(option), &value, &typed, error)) {
        option_blame(option, text, error);
        /* "26-eq", "26 eq." and the like: an equivalent whose unit is not whole */
        const char *const end = text.start + text.length;
        double number;
        const char *rest = number_read(text.start, end, NUMBER_UNSCALED, &number);
        const int digits = rest != NULL ? (int)(rest - text.start) : 0;
        while (digits > 0 && rest < end && (*rest == ' ' || *rest == '-' || *rest == 'm')) {
            rest++;
        }
        return digits > 0 && end - rest >= 2 && memcmp(rest, "eq", 2) == 0 &&
               error_hint(error, "did you mean '%.*smm-eq'?", digits, text.start);
    }
    if (!option_check_range(option, value, error)) {
        return false;
    }
    option_doubt(reader, option, value);
    focal_set_number(member, value, typed != NULL ? typed : option_unit(option));
    return true;
}

static double focal_number(const void *member)
{
    const struct focal_value *focal = member;
    return isnan(focal->equivalent) ? focal->length : focal->equivalent;
}

const struct option_kind kind_focal = {
    .name = "quantity",
    .size = sizeof(struct focal_value),
    .is_list = true,
    .read = focal_read,
    .number_of = focal_number,
    .set_number = focal_set_number,
    .nan_count = 2,
};

struct focal_options focal_options_of(const struct option *options, size_t count)
{
    struct focal_options found = {.all = options, .all_count = count};
    for (size_t i = 0; i < count; i++) {
        if (options[i].kind == &kind_focal &&
            found.count < sizeof found.focal / sizeof found.focal[0]) {
            found.focal[found.count++] = &options[i];
        } else if (options[i].kind == &kind_sensor &&
                   text_equal(text_of(options[i].name), "sensor")) {
            found.sensor = &options[i];
        } else if (options[i].kind == &kind_lens) {
            found.lens = &options[i];
        } else if (text_equal(text_of(options[i].name), "aperture")) {
            found.fnumber = &options[i];
        }
    }
    return found;
}

bool focal_check_alike(const struct focal_value *values, size_t count, const struct option *option,
                       struct error *error)
{
    for (size_t i = 1; i < count; i++) {
        if (isnan(values[i].equivalent) != isnan(values[0].equivalent)) {
            return fail(error, ERROR_USAGE,
                        "--%s: give all as equivalent focal lengths, 24mm-eq, or none",
                        option->name);
        }
    }
    return true;
}

bool focal_is_equivalent(const struct option *option, const void *input)
{
    const struct focal_value *focal = (const void *)((const char *)input + option->offset);
    return option->kind == &kind_focal && !isnan(focal->equivalent);
}

/* Is something given that a focal length may be solved for, or a lens that has its own? */
static bool focal_has_other(const struct focal_options *options, const void *input)
{
    const char *members = input;
    for (size_t i = 0; i < options->all_count; i++) {
        const struct option *option = &options->all[i];
        if ((option->flags & OPTION_GOAL) != 0 && option->kind == &kind_quantity &&
            !isnan(*(const double *)(const void *)(members + option->offset))) {
            return true;
        }
    }
    return options->lens != NULL &&
           ((const struct lens_value *)(const void *)(members + options->lens->offset))->lens !=
               NULL;
}

/* The camera's own lens where none is given; what an earlier row took from its camera goes. */
static void focal_take_camera(const struct focal_options *options, void *input,
                              struct focal_value *focal, struct sensor_value *sensor)
{
    double none = NAN;
    double *fnumber = options->fnumber != NULL && options->fnumber->kind == &kind_quantity
                          ? (void *)((char *)input + options->fnumber->offset)
                          : &none;
    if (focal->fnumber > 0 && *fnumber == focal->fnumber) {
        *fnumber = NAN;
    }
    focal->fnumber = NAN;
    if (focal->of_camera) {
        focal->length = NAN;
        focal->of_camera = false;
    }
    if (sensor != NULL && sensor->with_lens != NULL) {
        sensor->name = sensor->bare_name;
    }
    if (sensor == NULL || sensor->with_lens == NULL || sensor->is_fallback ||
        !isnan(focal->length) || !isnan(focal->equivalent) || focal_has_other(options, input)) {
        return;
    }
    focal->of_camera = true;
    focal->length = sensor->focal;
    focal->fnumber = isnan(*fnumber) ? sensor->fnumber : (double)NAN;
    if (!isnan(focal->fnumber)) {
        *fnumber = focal->fnumber;
    }
    sensor->name = sensor->with_lens;
}

bool focal_settle(const struct focal_options *options, void *input, struct warnings *doubts,
                  struct error *error)
{
    for (size_t i = 0; i < options->count; i++) {
        const struct option *option = options->focal[i];
        struct focal_value *focal = (void *)((char *)input + option->offset);
        struct sensor_value *sensor =
            options->sensor != NULL ? (void *)((char *)input + options->sensor->offset) : NULL;
        if ((option->flags & OPTION_OF_CAMERA) != 0) {
            focal_take_camera(options, input, focal, sensor);
        }
        const bool has_sensor = sensor != NULL && sensor->name != NULL && !sensor->is_fallback;
        if (!isnan(focal->equivalent)) {
            if (!has_sensor) {
                fail(error, ERROR_USAGE, "{--%s} %.6gmm-eq needs {--sensor}", option->name,
                     focal->equivalent);
                return sensor != NULL
                           ? error_hint(error, "name the camera, or 'list formats': the real focal "
                                               "length follows from the sensor's diagonal")
                           : error_hint(
                                 error,
                                 "this command has none: give the focal length that is engraved "
                                 "on the lens, or that 'lenscalc fov -f %.6gmm-eq --sensor "
                                 "CAMERA' prints",
                                 focal->equivalent);
            }
            focal->length = focal->equivalent / sensor_crop(&sensor->size);
        } else if (has_sensor && sensor->is_wide) {
            /* a maker's equivalent where the real length is meant? */
            const double crop = sensor_crop(&sensor->size);
            if (focal->length * crop > LONGEST_MAIN &&
                sensor_diagonal(&sensor->size) < LARGEST_DIAGONAL) {
                warnings_add(
                    doubts,
                    "%s %.6g mm on %s is as narrow as %.3g mm on 35 mm film, longer than the main "
                    "lens of such a camera: if it is the maker's equivalent, write %.6gmm-eq (%.4g "
                    "mm)",
                    CALLED(option), focal->length, sensor->name, focal->length * crop,
                    focal->length, focal->length / crop);
            }
        }
    }
    return true;
}
