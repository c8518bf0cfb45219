/* camera/sensor/develop.c - black level, colours and white balance of raw data. */
/* SPDX-License-Identifier: MIT */
#include "camera/sensor/develop.h"

#include <math.h>
#include <string.h>

/* Channels whose matrix magnifies errors so much tell no colours apart. */
#define ALIKE 1e4

/* What makes light of digital numbers, and linear sRGB of channels. */
struct raw_conversion {
    const struct sensor_model *model;
    double per_number[SENSOR_CHANNELS]; /* light, 1 is white, of one digital number */
    double zero;                        /* digital number of no light */
    struct colour_matrix to_srgb;
};

/* Not a number where one of them is none. */
static double sum_of_sizes(const struct colour_matrix *matrix)
{
    double sum = 0;
    for (size_t i = 0; i < SENSOR_CHANNELS; i++) {
        for (size_t j = 0; j < SENSOR_CHANNELS; j++) {
            sum += fabs(matrix->at[i][j]);
        }
    }
    return sum;
}

static struct colour srgb_of(const struct raw_conversion *developing, const float *raw,
                             size_t channels)
{
    struct colour light;
    for (size_t k = 0; k < SENSOR_CHANNELS; k++) {
        const size_t from = channels == 1 ? 0 : k;
        light.part[k] = ((double)raw[from] - developing->zero) * developing->per_number[from];
    }
    return colour_turned(&developing->to_srgb, light);
}

/* The mean of what is not saturated. */
static bool mean_white(const struct raw_conversion *developing, const struct image *raw,
                       struct colour *white, struct error *error)
{
    struct colour sum = {{0}};
    size_t count = 0;
    for (size_t i = 0; i < raw->width * raw->height; i++) {
        const float *pixel = raw->pixels + i * raw->channels;
        bool within = true;
        for (size_t k = 0; k < raw->channels; k++) {
            within = within && (double)pixel[k] < developing->model->full_number;
        }
        if (within) {
            const struct colour colour = srgb_of(developing, pixel, raw->channels);
            for (int k = 0; k < 3; k++) {
                sum.part[k] += colour.part[k];
            }
            count++;
        }
    }
    if (count == 0) {
        return fail(error, ERROR_DOMAIN,
                    "no white balance of a picture that is saturated everywhere");
    }
    for (int k = 0; k < 3; k++) {
        sum.part[k] /= (double)count;
    }
    *white = colour_turned(&colour_xyz_of_srgb, sum);
    return true;
}

static bool find_white(const struct raw_conversion *developing, const struct image *raw,
                       const struct develop_way *way, struct colour *white, struct error *error)
{
    switch (way->white) {
    case BALANCE_TUNGSTEN:
        *white = colour_tungsten();
        return true;
    case BALANCE_KELVIN:
        return colour_white(way->kelvin, white, error);
    case BALANCE_AUTO:
        return mean_white(developing, raw, white, error);
    case BALANCE_DAYLIGHT:
        break;
    }
    *white = colour_daylight();
    return true;
}

bool develop_picture(const struct sensor_model *model, const struct image *raw,
                     const struct develop_way *way, struct arena *arena, struct developed *made,
                     struct error *error)
{
    const size_t channels = sensor_traits(&model->sensor)->channels;
    if (raw->channels != channels) {
        return fail(error, ERROR_DOMAIN, "raw data of %zu channels: the sensor has %zu",
                    raw->channels, channels);
    }
    const struct sensor_response_traits *response = sensor_traits(&model->sensor);
    struct raw_conversion developing = {.model = model,
                                        .zero = model->sensor.black + model->gain * model->dark};
    const double most = (model->white - model->sensor.black) / (model->gain * model->of_white);
    struct colour_matrix seen;
    for (size_t i = 0; i < SENSOR_CHANNELS; i++) {
        developing.per_number[i] = way->headroom / (model->gain * model->electrons[i] * most);
        for (size_t j = 0; j < SENSOR_CHANNELS; j++) {
            const double own = i == j ? model->of_white / model->electrons[0] : 0;
            seen.at[i][j] = response->channels == 1 ? own : response->seen->at[i][j];
        }
    }
    developing.to_srgb = colour_inverse(&seen);
    if (!(sum_of_sizes(&developing.to_srgb) * sum_of_sizes(&seen) < ALIKE)) {
        return fail(error, ERROR_DOMAIN,
                    "the channels of the sensor see too much the same to make colours of them");
    }
    made->white = colour_daylight();
    if (channels > 1) {
        struct colour_matrix balance;
        if (!find_white(&developing, raw, way, &made->white, error) ||
            !colour_balance(made->white, &balance, error)) {
            return false;
        }
        developing.to_srgb = colour_product(&balance, &developing.to_srgb);
    }
    /* of a developed colour, what a channel has of a full pixel's light */
    const double darkness = 1e-6; /* where the dark alone fills the pixel, any light is full */
    struct colour_matrix fill = colour_inverse(&developing.to_srgb);
    for (size_t j = 0; j < SENSOR_CHANNELS; j++) {
        const double full = (developing.model->full_number - developing.zero) *
                            developing.per_number[channels == 1 ? 0 : j];
        for (size_t k = 0; k < SENSOR_CHANNELS; k++) {
            fill.at[j][k] /= fmax(full, darkness);
        }
    }
    made->fill = fill;
    struct image *picture = &made->picture;
    *picture =
        (struct image){.width = raw->width, .height = raw->height, .channels = SENSOR_CHANNELS};
    if (!image_new(picture, arena, error)) {
        return false;
    }
    for (size_t i = 0; i < raw->width * raw->height; i++) {
        const float *from = raw->pixels + i * channels;
        float *to = picture->pixels + i * SENSOR_CHANNELS;
        /* one like that before it, as in what is black or white throughout */
        if (i > 0 && memcmp(from, from - channels, channels * sizeof *from) == 0) {
            memcpy(to, to - SENSOR_CHANNELS, SENSOR_CHANNELS * sizeof *to);
            continue;
        }
        const struct colour colour = srgb_of(&developing, from, channels);
        for (size_t k = 0; k < SENSOR_CHANNELS; k++) {
            to[k] = (float)colour.part[k];
        }
    }
    return true;
}
