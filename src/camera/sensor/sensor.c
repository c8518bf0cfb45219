/* camera/sensor/sensor.c - light to electrons to digital numbers. */
/* SPDX-License-Identifier: MIT */
#include "camera/sensor/sensor.h"

#include "base/exponential.h"
#include "base/normal.h"
#include "base/parallel.h"
#include "base/poisson.h"
#include "base/random.h"
#include "photo/sensitometry.h"

#include <math.h>
#include <string.h>

/* that a thread takes at once */
enum { ROWS = 4 };

static const struct colour_matrix unchanged = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

const struct sensor_response_traits sensor_responses[SENSOR_RESPONSES] = {
    [SENSOR_RGB] = {"rgb", 3, 1, &unchanged, 0, {"R", "G", "B"}},
    [SENSOR_MONO] = {"mono", 1, 0, &colour_xyz_of_srgb, 1, {"Y"}},
    [SENSOR_XYZ] = {"xyz", 3, 1, &colour_xyz_of_srgb, 0, {"X", "Y", "Z"}},
};

const struct sensor_mosaic_traits sensor_mosaics[SENSOR_MOSAICS] = {
    [MOSAIC_NONE] = {"none", {{0}}},
    [MOSAIC_RGGB] = {"rggb", {{0, 1}, {1, 2}}},
    [MOSAIC_BGGR] = {"bggr", {{2, 1}, {1, 0}}},
    [MOSAIC_GRBG] = {"grbg", {{1, 0}, {2, 1}}},
    [MOSAIC_GBRG] = {"gbrg", {{1, 2}, {0, 1}}},
};

const struct sensor_response_traits *sensor_traits(const struct image_sensor *sensor)
{
    return sensor->table != NULL ? sensor->table : &sensor_responses[sensor->response];
}

struct image_sensor sensor_plain(double pitch)
{
    return (struct image_sensor){.response = SENSOR_RGB,
                                 .pitch = pitch,
                                 .fill = 1,
                                 .efficiency = {0.5, 0.5, 0.5},
                                 .full_well = (double)INFINITY,
                                 .dark_temperature = 20,
                                 .doubling = 8,
                                 .bits = 14};
}

/* A number of a sensor and what it may be. */
struct limit {
    const char *name, *unit;
    double value, low, high;
    bool above; /* low itself is too low */
};

static bool check_sensor(const struct image_sensor *sensor, const struct sensor_setting *setting,
                         struct error *error)
{
    const double most = ldexp(1, SENSOR_MOST_BITS) - 1;
    const struct limit limits[] = {
        {"pixel pitch", " mm", sensor->pitch, 0, 10, true},
        {"fill factor", "", sensor->fill, 0, 1, true},
        {"quantum efficiency", "", sensor->efficiency[0], 0, 1, true},
        {"quantum efficiency", "", sensor->efficiency[1], 0, 1, true},
        {"quantum efficiency", "", sensor->efficiency[2], 0, 1, true},
        {"full well", " electrons", sensor->full_well, 1, (double)INFINITY, false},
        {"dark current", " electrons/s", sensor->dark_current, 0, 1e9, false},
        {"temperature of the dark current", " C", sensor->dark_temperature, -273.15, 200, false},
        {"doubling of the dark current", " K", sensor->doubling, 1, 100, false},
        {"read noise", " electrons", sensor->read_noise, 0, 1e6, false},
        {"bits", "", sensor->bits, SENSOR_LEAST_BITS, SENSOR_MOST_BITS, false},
        {"black level", "", sensor->black, 0, most, false},
        {"exposure time", " s", setting->time, 0, 1e9, false},
        {"temperature", " C", setting->temperature, -273.15, 200, false},
    };
    const size_t count = sizeof limits / sizeof *limits;
    for (size_t i = 0; i < count; i++) {
        const struct limit *limit = &limits[i];
        const bool high_enough =
            limit->above ? limit->value > limit->low : limit->value >= limit->low;
        if (!(high_enough && limit->value <= limit->high)) {
            return fail(error, ERROR_DOMAIN,
                        "the %s %.6g%s of a sensor is not %s %.6g and up to %.6g", limit->name,
                        limit->value, limit->unit, limit->above ? "above" : "from", limit->low,
                        limit->high);
        }
    }
    if (!(sensor->black < ldexp(1, sensor->bits) - 1)) {
        return fail(error, ERROR_DOMAIN, "the black level %.6g is not below the largest of %d bits",
                    sensor->black, sensor->bits);
    }
    const struct sensor_response_traits *response = sensor_traits(sensor);
    const bool has_colours = sensor->table != NULL || sensor->response == SENSOR_RGB;
    if (sensor->mosaic != MOSAIC_NONE && !(has_colours && response->channels == SENSOR_CHANNELS)) {
        return fail(error, ERROR_DOMAIN,
                    "a mosaic is of red, green and blue, and the response is %s", response->word);
    }
    return true;
}

/* K from the speed, or as given. */
static bool find_gain(struct sensor_model *model, struct error *error)
{
    const struct sensor_setting *setting = &model->setting;
    const bool has_iso = !isnan(setting->iso), has_gain = !isnan(setting->gain);
    if (has_iso == has_gain) {
        return fail(error, ERROR_DOMAIN, "a sensor takes a speed or a gain, %s",
                    has_iso ? "not both" : "and has neither");
    }
    const double span = model->white - model->sensor.black;
    model->gain =
        has_gain ? setting->gain : span / (saturation_exposure(setting->iso) * model->of_white);
    if (!(model->gain > 0 && model->gain < 1e12 && (has_gain || setting->iso > 0))) {
        return fail(error, ERROR_DOMAIN, "the %s %.6g of a sensor is not above 0 and below 1e12",
                    has_gain ? "gain" : "ISO", has_gain ? setting->gain : setting->iso);
    }
    return true;
}

/* Noise is added to what a well holds; of numbers it makes no difference above the largest. */
static double full_number_of(const struct sensor_model *model)
{
    static const double deviations = 4;
    const struct image_sensor *sensor = &model->sensor;
    const double noise = model->setting.noiseless ? 0 : deviations * sensor->read_noise;
    const double electrons = fmax(sensor->full_well - noise, sensor->full_well / 2);
    return fmin(model->white, rint(sensor->black + model->gain * electrons)) - 0.5;
}

bool sensor_open(const struct image_sensor *sensor, const struct sensor_setting *setting,
                 struct sensor_model *model, struct error *error)
{
    *model = (struct sensor_model){.sensor = *sensor, .setting = *setting};
    if (!check_sensor(sensor, setting, error)) {
        return false;
    }
    const struct sensor_response_traits *response = sensor_traits(sensor);
    for (size_t c = 0; c < SENSOR_CHANNELS; c++) {
        model->electrons[c] =
            sensor->fill * sensor->efficiency[c] * sensor->pitch * sensor->pitch * SENSOR_PHOTONS;
    }
    for (size_t j = 0; j < SENSOR_CHANNELS; j++) {
        model->of_white += model->electrons[response->reference] *
                           response->seen->at[response->row + response->reference][j];
    }
    model->white = ldexp(1, sensor->bits) - 1;
    if (!find_gain(model, error)) {
        return false;
    }
    const double doublings = (setting->temperature - sensor->dark_temperature) / sensor->doubling;
    model->dark =
        sensor->dark_current * setting->time * exponential(doublings * 0.69314718055994530942);
    if (!(model->dark < POISSON_MOST)) {
        return fail(error, ERROR_DOMAIN,
                    "a dark current of %.6g electrons in the exposure is too much", model->dark);
    }
    model->full_number = full_number_of(model);
    model->clip = fmin(sensor->full_well, (model->white - sensor->black) / model->gain);
    model->saturation = fmax(0, model->clip - model->dark) / model->of_white;
    return true;
}

/* -------- exposure -------- */

/* The digital number of a mean of electrons; `which` number of this pixel's chance. */
static double digital(const struct sensor_model *model, double mean, uint64_t pixel, uint32_t which,
                      bool *saturated)
{
    double electrons = fmin(mean, POISSON_MOST), noise = 0;
    if (!model->setting.noiseless) {
        const struct random_words words =
            random_words(RANDOM_NOISE, model->setting.seed, pixel, which);
        electrons = poisson_quantile(electrons, random_unit_of(words.w[0], words.w[1]));
        if (model->sensor.read_noise > 0) {
            noise =
                model->sensor.read_noise * normal_quantile(random_unit_of(words.w[2], words.w[3]));
        }
    }
    const bool full = electrons >= model->sensor.full_well;
    electrons = full ? model->sensor.full_well : electrons;
    const double number = rint(model->sensor.black + model->gain * (electrons + noise));
    *saturated = full || number >= model->white;
    if (number >= model->white) {
        return model->white;
    }
    if (number > 0) {
        return number;
    }
    return 0;
}

/* Lux seconds of a channel, by what it sees. */
static double seen_by(const double seen[SENSOR_CHANNELS], const float *pixel, size_t channels)
{
    double sum = 0;
    for (size_t j = 0; j < SENSOR_CHANNELS; j++) {
        sum += seen[j] * (double)pixel[channels == 1 ? 0 : j];
    }
    return sum;
}

double sensor_luminous(const float *pixel, size_t channels)
{
    return seen_by(colour_xyz_of_srgb.at[1], pixel, channels);
}

bool sensor_check_light(const struct image *light, struct error *error)
{
    if (light->channels != 1 && light->channels != SENSOR_CHANNELS) {
        return fail(error, ERROR_DOMAIN, "light of %zu channels: a sensor takes 1 or %d",
                    light->channels, SENSOR_CHANNELS);
    }
    return image_check(light, IMAGE_POSITIVE, error);
}

/* What sensor_expose has in common for all rows. */
struct sensor_job {
    const struct sensor_model *model;
    const struct image *light;
    const struct sensor_place *place;
    const struct image *image;      /* receives numbers */
    struct sensor_sums *rows;       /* and what is counted of each row */
    float untaken[SENSOR_CHANNELS]; /* numbers of a pixel that is not there yet */
};

static bool pixel_is_black(const float *pixel, size_t channels)
{
    bool black = true;
    for (size_t k = 0; k < channels; k++) {
        black = black && !(pixel[k] > 0);
    }
    return black;
}

static void expose_pixel(const struct sensor_job *exposing, size_t x, size_t y)
{
    const struct sensor_model *model = exposing->model;
    const struct sensor_place *place = exposing->place;
    const struct image *light = exposing->light;
    struct sensor_sums *sums = &exposing->rows[y];
    const size_t column = place->column + x, row = place->row + y;
    const uint64_t pixel = (uint64_t)row * place->width + column;
    const float *from = image_row(light, y) + x * light->channels;
    float *to = image_row(exposing->image, y) + x * exposing->image->channels;
    const bool mosaic = model->sensor.mosaic != MOSAIC_NONE;
    const struct sensor_response_traits *response = sensor_traits(&model->sensor);
    if (model->setting.is_unfinished && pixel_is_black(from, light->channels)) {
        memcpy(to, exposing->untaken, exposing->image->channels * sizeof *to);
        sums->values += exposing->image->channels;
        sums->darkest = 0;
        return;
    }
    for (size_t k = 0; k < exposing->image->channels; k++) {
        const size_t channel =
            mosaic ? sensor_mosaics[model->sensor.mosaic].channel[row % 2][column % 2] : k;
        const double mean =
            seen_by(response->seen->at[response->row + channel], from, light->channels) *
            model->electrons[channel];
        bool saturated;
        to[k] = (float)digital(model, mean + model->dark, pixel, (uint32_t)channel, &saturated);
        sums->values++;
        sums->saturated += saturated;
        sums->brightest = fmax(sums->brightest, mean);
        sums->darkest = fmin(sums->darkest, mean);
    }
}

static void sensor_expose_rows(void *context, size_t begin, size_t end)
{
    const struct sensor_job *exposing = context;
    for (size_t y = begin; y < end; y++) {
        exposing->rows[y] = (struct sensor_sums){.darkest = (double)INFINITY};
        for (size_t x = 0; x < exposing->light->width; x++) {
            expose_pixel(exposing, x, y);
        }
    }
}

bool sensor_expose(const struct sensor_model *model, const struct image *light,
                   const struct sensor_place *place, struct arena *arena, struct sensor_raw *raw,
                   struct error *error)
{
    const struct sensor_response_traits *response = sensor_traits(&model->sensor);
    const bool mosaic = model->sensor.mosaic != MOSAIC_NONE;
    *raw = (struct sensor_raw){.image = {.width = light->width,
                                         .height = light->height,
                                         .channels = mosaic ? 1 : response->channels,
                                         .names = mosaic ? NULL : response->names}};
    if (!sensor_check_light(light, error) || !image_new(&raw->image, arena, error)) {
        return false;
    }
    struct sensor_job exposing = {.model = model,
                                  .light = light,
                                  .place = place,
                                  .image = &raw->image,
                                  .rows = ARENA_ARRAY(arena, light->height, struct sensor_sums)};
    for (size_t k = 0; k < SENSOR_CHANNELS; k++) {
        /* the digital number of the dark without chance */
        struct sensor_model calm = *model;
        bool saturated;
        calm.setting.noiseless = true;
        exposing.untaken[k] = (float)digital(&calm, model->dark, 0, 0, &saturated);
    }
    parallel_for(model->setting.threads, light->height, ROWS, sensor_expose_rows, &exposing);
    const struct sensor_sums *rows = exposing.rows;
    struct sensor_sums all = {.darkest = (double)INFINITY};
    for (size_t y = 0; y < light->height; y++) {
        all.values += rows[y].values;
        all.saturated += rows[y].saturated;
        all.brightest = fmax(all.brightest, rows[y].brightest);
        all.darkest = fmin(all.darkest, rows[y].darkest);
    }
    raw->sums = all;
    return true;
}

static void note_number(struct image *image, struct arena *arena, const char *key, double value)
{
    image_note(image, arena, text_of(key), text_of(arena_printf(arena, "%.9g", value)));
}

void sensor_codes(const struct sensor_model *model, const struct sensor_place *place,
                  struct image *raw, struct arena *arena)
{
    const size_t count = raw->width * raw->height * raw->channels;
    for (size_t i = 0; i < count; i++) {
        raw->pixels[i] = (float)((double)raw->pixels[i] / 65535);
    }
    /* the mosaic as it looks from a pixel of the frame on */
    const enum sensor_mosaic mosaic = model->sensor.mosaic;
    const struct sensor_mosaic_traits *traits = &sensor_mosaics[mosaic], *other = traits;
    const size_t row = place->row % 2, column = place->column % 2;
    for (int i = MOSAIC_NONE + 1; i < SENSOR_MOSAICS && mosaic != MOSAIC_NONE; i++) {
        const bool same = sensor_mosaics[i].channel[0][0] == traits->channel[row][column] &&
                          sensor_mosaics[i].channel[0][1] == traits->channel[row][1 - column] &&
                          sensor_mosaics[i].channel[1][0] == traits->channel[1 - row][column];
        other = same ? &sensor_mosaics[i] : other;
    }
    image_note(raw, arena, text_of("CFA pattern"), text_of(other->word));
    note_number(raw, arena, "Black level", model->sensor.black);
    note_number(raw, arena, "White level", model->white);
    note_number(raw, arena, "Saturation level", ceil(model->full_number));
    note_number(raw, arena, "Gain", model->gain);
}
