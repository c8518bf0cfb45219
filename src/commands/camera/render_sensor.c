/* commands/camera/render_sensor.c - a picture as a sensor sees it. */
/* SPDX-License-Identifier: MIT */
#include "camera/demosaic.h"
#include "camera/develop.h"
#include "commands/camera/render.h"

#include <stdlib.h>
#include <string.h>

const struct word render_mosaics[] = {
    {"none", "all colours in every pixel"},         {"rggb", "red and green above green and blue"},
    {"bggr", "blue and green above green and red"}, {"grbg", "green and red above blue and green"},
    {"gbrg", "green and blue above red and green"}, {NULL, NULL},
};

static const struct {
    const char *word;
    enum white_balance balance;
} balances[] = {
    {"daylight", BALANCE_DAYLIGHT}, {"tungsten", BALANCE_TUNGSTEN}, {"auto", BALANCE_AUTO}};

/* "daylight", "tungsten", "auto" or a colour temperature: 5600K. */
static bool read_white(const char *text, struct develop_way *way, struct error *error)
{
    *way = (struct develop_way){.white = BALANCE_DAYLIGHT, .headroom = DEVELOP_HEADROOM};
    if (text == NULL) {
        return true;
    }
    for (size_t i = 0; i < sizeof balances / sizeof balances[0]; i++) {
        if (strcmp(text, balances[i].word) == 0) {
            way->white = balances[i].balance;
            return true;
        }
    }
    char *end;
    way->white = BALANCE_KELVIN;
    way->kelvin = strtod(text, &end);
    return (end != text && (strcmp(end, "K") == 0 || strcmp(end, "k") == 0) && way->kelvin > 0) ||
           fail(error, ERROR_USAGE,
                "{--white} '%.40s': daylight, tungsten, auto or a colour temperature, as 5600K",
                text);
}

bool render_senses(const struct render_input *input)
{
    return input->noise || input->raw || input->mosaic != 0 || input->white != NULL ||
           !isnan(input->pitch) || !isnan(input->read_noise) || !isnan(input->full_well) ||
           !isnan(input->dark_current);
}

bool render_check_sensor(const struct render_input *input, struct error *error)
{
    struct develop_way way;
    if (input->raw && input->white != NULL) {
        return fail(error, ERROR_USAGE,
                    "{--raw} and {--white} exclude each other: raw numbers "
                    "have no white balance");
    }
    if (!read_white(input->white, &way, error)) {
        return false;
    }
    return way.white != BALANCE_AUTO || input->crop == NULL ||
           fail(error, ERROR_USAGE,
                "{--white} auto is the mean of a whole picture, which a {--crop} does not have");
}

static double or_else(double given, double usual)
{
    return isnan(given) ? usual : given;
}

static struct image_sensor sensor_of(const struct render_input *input, size_t columns)
{
    struct image_sensor sensor =
        sensor_plain(or_else(input->pitch, input->sensor.size.width / (double)columns));
    sensor.mosaic = (enum sensor_mosaic)input->mosaic;
    sensor.read_noise = or_else(input->read_noise, sensor.read_noise);
    sensor.full_well = or_else(input->full_well, sensor.full_well);
    sensor.dark_current = or_else(input->dark_current, sensor.dark_current);
    return sensor;
}

static void add_remarks(const struct sensor_model *model, const struct sensor_raw *raw,
                        struct growing *remarks)
{
    growing_format(remarks,
                   "%.4g electrons saturate a pixel of %.4g um, %.3g numbers an electron\n",
                   model->clip, 1000 * model->sensor.pitch, model->gain);
    const struct sensor_sums *sums = &raw->sums;
    if (sums->saturated == sums->values) {
        growing_format(remarks,
                       "warning: every pixel is saturated: %.3g electrons in the darkest one\n",
                       sums->darkest + model->dark);
    }
    if (sums->brightest < 1 && sums->brightest > 0) {
        growing_format(remarks,
                       "warning: the brightest pixel has %.2g electrons: it takes %.3g times the "
                       "time or the light for one\n",
                       sums->brightest, 1 / sums->brightest);
    }
}

bool render_sense(const struct render_input *input, double time, const struct render_frame *frame,
                  struct image *image, struct growing *remarks, struct error *error)
{
    struct arena *arena = remarks->arena;
    const struct image_sensor sensor = sensor_of(input, frame->columns);
    const struct sensor_setting setting = {.iso = input->iso,
                                           .gain = NAN,
                                           .time = time,
                                           .temperature = sensor.dark_temperature,
                                           .noiseless = !input->noise && isnan(input->read_noise),
                                           .seed = (uint64_t)input->seed,
                                           .threads = parallel_threads(input->threads)};
    const struct sensor_place place = {frame->taken.left, frame->taken.top, frame->columns};
    struct sensor_model model;
    struct sensor_raw raw;
    struct develop_way way;
    struct developed made;
    struct image full;
    if (!read_white(input->white, &way, error) || !sensor_open(&sensor, &setting, &model, error) ||
        !sensor_expose(&model, image, &place, arena, &raw, error)) {
        return false;
    }
    add_remarks(&model, &raw, remarks);
    struct image sensed = raw.image;
    if (input->raw) {
        sensor_codes(&model, &place, &sensed, arena);
    } else {
        if (sensor.mosaic != MOSAIC_NONE) {
            if (!demosaic_bilinear(&raw.image, sensor.mosaic, &place, arena, &full, error)) {
                return false;
            }
            sensed = full;
        }
        if (!develop_picture(&model, &sensed, &way, arena, &made, error)) {
            return false;
        }
        sensed = made.picture;
    }
    *image = sensed;
    return true;
}
