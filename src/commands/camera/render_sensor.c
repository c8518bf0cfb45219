/* commands/camera/render_sensor.c - a picture as a sensor sees it. */
/* SPDX-License-Identifier: MIT */
#include "base/constants.h"
#include "base/number.h"
#include "camera/sensor/demosaic.h"
#include "camera/sensor/develop.h"
#include "camera/sensor/response.h"
#include "commands/camera/render.h"
#include "data/number_table.h"
#include "photo/sensitometry.h"

#include <math.h>
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

/* A number at the beginning of a text, and what follows it; null: there is none. */
static const char *leading_number(const char *text, double *value)
{
    return number_read(text, text + strlen(text), NUMBER_UNSCALED, value);
}

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
    const char *end = leading_number(text, &way->kelvin);
    way->white = BALANCE_KELVIN;
    return (end != NULL && (strcmp(end, "K") == 0 || strcmp(end, "k") == 0) && way->kelvin > 0) ||
           fail(error, ERROR_USAGE,
                "{--white} '%.40s': daylight, tungsten, auto or a colour temperature, as 5600K",
                text);
}

bool render_senses(const struct render_input *input)
{
    const double numbers[] = {input->pitch,        input->read_noise, input->full_well,
                              input->dark_current, input->fill,       input->efficiency,
                              input->gain,         input->black};
    bool any = input->noise || input->raw || input->mosaic != 0 || input->white != NULL ||
               input->response != NULL || input->adc != 0;
    for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; i++) {
        any = any || !isnan(numbers[i]);
    }
    return any;
}

static double or_else(double given, double usual)
{
    return isnan(given) ? usual : given;
}

/* "rgb", "mono", "xyz", or a file. */
static bool read_response(const struct render_input *input, struct arena *arena,
                          struct image_sensor *sensor, struct error *error)
{
    for (int i = 0; i < SENSOR_RESPONSES; i++) {
        if (input->response == NULL || strcmp(input->response, sensor_responses[i].word) == 0) {
            sensor->response = (enum sensor_response)i;
            return true;
        }
    }
    struct number_table file;
    const char *other =
        SAID_FIRST({!isnan(input->efficiency), "efficiency"},
                   {input->question.wavelength.name != NULL, "wavelength"},
                   {input->question.spectrum.count > 0, "spectrum"}, {!isnan(input->band), "band"});
    if (other != NULL) {
        return fail(error, ERROR_USAGE, "{--%s} and a table of {--response} exclude each other",
                    other);
    }
    if (!number_table_read(input->response, "wavelength_nm", arena, &file, error)) {
        return error_hint(error, "{--response} is rgb, mono, xyz or the name of a file");
    }
    struct response_table table = {.channels = file.columns - 1, .rows = file.rows};
    for (size_t i = 0; i < file.rows; i++) {
        file.column[0][i] /= 1000;
    }
    table.wavelength = file.column[0];
    for (size_t k = 0; k < table.channels && k < SENSOR_CHANNELS; k++) {
        table.efficiency[k] = file.column[k + 1];
        table.names[k] = file.names[k + 1];
        sensor->efficiency[k] = 1;
    }
    return response_open(&table, arena, &sensor->table, error) ||
           error_prefix(error, "%.200s: ", input->response);
}

/* The sensor, ready for an exposure of `time`, s. */
static bool open_sensor(const struct render_input *input, const struct render_frame *frame,
                        double time, struct arena *arena, struct sensor_model *model,
                        struct error *error)
{
    struct image_sensor sensor =
        sensor_plain(or_else(input->pitch, render_frame_pitch(input, frame)));
    sensor.mosaic = (enum sensor_mosaic)input->mosaic;
    sensor.read_noise = or_else(input->read_noise, sensor.read_noise);
    sensor.full_well = or_else(input->full_well, sensor.full_well);
    sensor.dark_current = or_else(input->dark_current, sensor.dark_current);
    sensor.fill = or_else(input->fill, sensor.fill);
    sensor.black = or_else(input->black, sensor.black);
    sensor.bits = input->adc != 0 ? (int)input->adc : sensor.bits;
    for (size_t k = 0; k < SENSOR_CHANNELS; k++) {
        sensor.efficiency[k] = or_else(input->efficiency, sensor.efficiency[k]);
    }
    const struct sensor_setting setting = {.iso = isnan(input->gain) ? input->iso : NAN,
                                           .gain = input->gain,
                                           .time = time,
                                           .temperature = sensor.dark_temperature,
                                           .noiseless = !input->noise && isnan(input->read_noise),
                                           .seed = (uint64_t)input->seed,
                                           .threads = parallel_threads(input->threads)};
    return read_response(input, arena, &sensor, error) &&
           sensor_open(&sensor, &setting, model, error);
}

bool render_check_sensor(const struct artifact_job *job, const struct render_frame *frame,
                         struct error *error)
{
    const struct render_input *input = job->inputs[0];
    struct develop_way way;
    struct sensor_model model;
    if (!read_white(input->white, &way, error)) {
        return false;
    }
    if (way.white == BALANCE_AUTO && input->crop != NULL) {
        return fail(
            error, ERROR_USAGE,
            "{--white} auto is the mean of a whole picture, which a {--crop} does not have");
    }
    return !render_senses(input) ||
           (open_sensor(input, frame, or_else(input->time, 0), job->run->arena, &model, error) &&
            (input->white == NULL || sensor_traits(&model.sensor)->channels > 1 ||
             fail(error, ERROR_USAGE,
                  "{--white} balances colours, which a sensor of one channel does not have")));
}

bool render_speed(const struct render_input *input, const struct render_frame *frame,
                  struct arena *arena, double *iso, struct error *error)
{
    struct sensor_model model;
    *iso = render_is_film(input) ? input->film.speed : input->iso;
    if (isnan(input->gain)) {
        return true;
    }
    if (!open_sensor(input, frame, 0, arena, &model, error)) {
        return false;
    }
    *iso = saturation_speed((model.white - model.sensor.black) / (model.gain * model.of_white));
    return true;
}

bool render_acceptance(const struct render_input *input, struct arena *arena,
                       const struct acceptance **acceptance, struct error *error)
{
    *acceptance = NULL;
    if (input->acceptance == NULL) {
        return true;
    }
    struct acceptance *made = ARENA_NEW(arena, struct acceptance);
    *acceptance = made;
    double power;
    const char *end = leading_number(input->acceptance, &power);
    if (end != NULL && *end == '\0') {
        return acceptance_power(power, made, error);
    }
    struct number_table file;
    if (!number_table_read(input->acceptance, "angle_deg", arena, &file, error)) {
        return error_hint(error, "{--acceptance} is a power of the cosine or the name of a file");
    }
    if (file.columns != 2) {
        return fail(error, ERROR_DATA, "%.200s: %zu columns, not angle_deg and a share",
                    input->acceptance, file.columns);
    }
    for (size_t i = 0; i < file.rows; i++) {
        file.column[0][i] *= RADIANS_PER_DEGREE;
    }
    return acceptance_table(file.column[0], file.column[1], file.rows, made, error) ||
           error_prefix(error, "%.200s: ", input->acceptance);
}

/*
 * Too much light, or too little. Of a picture what its file cannot hold counts too: `lost` is the
 * share of its pixels, and white lies by `headroom` below the largest number.
 */
static void sensor_add_warnings(const struct sensor_model *model, const struct sensor_raw *raw,
                                double headroom, double lost, struct text_buffer *remarks)
{
    const struct sensor_sums *sums = &raw->sums;
    const double white = (model->white - model->sensor.black) / model->gain / headroom;
    const double end = fmin(model->clip - model->dark, white);
    if (end > 0) {
        const double share = (double)sums->saturated / (double)sums->values;
        const struct clipping_share clipping = {fmax(share, lost), sums->darkest / end,
                                                sums->brightest / end};
        render_say_clipping(&clipping, remarks);
    } else {
        growing_format(remarks, "warning: the dark current alone saturates: %.3g electrons\n",
                       model->dark);
    }
    if (sums->brightest < 1 && sums->brightest > 0) {
        growing_format(remarks,
                       "warning: the brightest pixel has %.2g electrons: it takes %.3g times the "
                       "time or the light for one\n",
                       sums->brightest, 1 / sums->brightest);
    }
}

bool render_sense(const struct render_input *input, double time, const struct render_shot *shot,
                  struct image *image, struct text_buffer *remarks, struct error *error)
{
    const struct render_frame *frame = &shot->frame;
    struct arena *arena = remarks->arena;
    const struct sensor_place place = {frame->taken.left, frame->taken.top, frame->columns};
    struct sensor_model model;
    struct sensor_raw raw;
    struct develop_way way;
    struct developed made;
    struct image full;
    if (!read_white(input->white, &way, error) ||
        !open_sensor(input, frame, time, arena, &model, error)) {
        return false;
    }
    model.setting.seed = render_frame_seed(input, frame);
    model.setting.is_unfinished = shot->photograph.is_incomplete;
    if (!sensor_expose(&model, image, &place, arena, &raw, error)) {
        return false;
    }
    const char *said =
        arena_printf(arena, "%.4g electrons saturate a pixel of %.4g um, %.3g numbers an electron",
                     model.clip, 1000 * model.sensor.pitch, model.gain);
    growing_format(remarks, "%s\n", said);
    struct image sensed = raw.image;
    if (input->raw) {
        sensor_add_warnings(&model, &raw, 1, 0, remarks);
        sensor_codes(&model, &place, &sensed, arena);
    } else {
        if (model.sensor.mosaic != MOSAIC_NONE) {
            if (!demosaic_bilinear(&raw.image, model.sensor.mosaic, &place, arena, &full, error)) {
                return false;
            }
            sensed = full;
        }
        if (!develop_picture(&model, &sensed, &way, arena, &made, error)) {
            return false;
        }
        sensed = made.picture;
        const double lost = render_clipping_of(&sensed, 1, RENDER_OVER_WHITE).share;
        sensor_add_warnings(&model, &raw, way.headroom, lost, remarks);
        if (input->white != NULL) {
            /* Which light became white. */
            const double *xyz = made.white.part, sum = xyz[0] + xyz[1] + xyz[2];
            const char *became = arena_printf(
                remarks->arena, "x %.4f, y %.4f becomes white, by Bradford's adaptation",
                xyz[0] / sum, xyz[1] / sum);
            growing_format(remarks, "%s\n", became);
            image_note(&sensed, remarks->arena, text_of("White balance"), text_of(became));
        }
    }
    *image = sensed;
    image_note(image, arena, text_of("Sensor"), text_of(said));
    if (!input->raw) { /* for who weighs pixels by their noise */
        const double electrons = (model.white - model.sensor.black) / model.gain / way.headroom;
        const char *white = arena_printf(arena, "%.6g", electrons);
        const char *noise = arena_printf(arena, "%.6g", model.sensor.read_noise);
        image_note(image, arena, text_of(RENDER_NOTE_FULL), text_of(white));
        image_note(image, arena, text_of(RENDER_NOTE_READ), text_of(noise));
        /* Where the sensor is full, which need not be the largest number of the file. */
        struct text_buffer words = {.arena = arena};
        for (size_t i = 0; i < SENSOR_CHANNELS * SENSOR_CHANNELS; i++) {
            const double share = made.fill.at[i / SENSOR_CHANNELS][i % SENSOR_CHANNELS];
            growing_format(&words, "%s%.6g", i > 0 ? " " : "", share + 0.0); /* no -0 */
        }
        image_note(image, arena, text_of(RENDER_NOTE_SATURATION), growing_done(&words));
    }
    return true;
}
