/* camera/sensor/sensor.h - what a sensor makes of light: electrons, noise, digital numbers. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CAMERA_SENSOR_SENSOR_H
#define LENSCALC_CAMERA_SENSOR_SENSOR_H

#include "base/arena.h"
#include "base/error.h"
#include "base/image/image.h"
#include "light/colour.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { SENSOR_CHANNELS = 3, SENSOR_LEAST_BITS = 8, SENSOR_MOST_BITS = 16 };

/* Photons of 555 nm on 1 mm^2 in 1 lx s: 10^-6 m^2 (555e-9 m/(h c))/(683.002 lm/W). */
#define SENSOR_PHOTONS 4.0906683948e9

/* What a pixel's channels see of red, green and blue: a row of sensor_responses. */
enum sensor_response {
    SENSOR_RGB,  /* these */
    SENSOR_MONO, /* one channel: the luminous exposure */
    SENSOR_XYZ,  /* the CIE's X, Y, Z */
    SENSOR_RESPONSES
};

struct sensor_response_traits {
    const char *word;
    size_t channels;
    size_t reference;                 /* the channel whose speed counts */
    const struct colour_matrix *seen; /* of (R, G, B) by each channel, */
    size_t row;                       /* the first one by this row */
    const char *names[SENSOR_CHANNELS];
};
extern const struct sensor_response_traits sensor_responses[SENSOR_RESPONSES];

/* Which channel each pixel of 2 x 2 has; without one all pixels have all channels. */
enum sensor_mosaic {
    MOSAIC_NONE,
    MOSAIC_RGGB,
    MOSAIC_BGGR,
    MOSAIC_GRBG,
    MOSAIC_GBRG,
    SENSOR_MOSAICS
};

struct sensor_mosaic_traits {
    const char *word;
    unsigned char channel[2][2]; /* in row, column from the top left */
};
extern const struct sensor_mosaic_traits sensor_mosaics[SENSOR_MOSAICS];

struct image_sensor {
    enum sensor_response response;
    const struct sensor_response_traits *table; /* in place of it; null: none */
    enum sensor_mosaic
        mosaic;   /* other than NONE only with red, green and blue, or a table of three */
    double pitch; /* of the pixels, mm, > 0: the root of their area */
    double fill;  /* share of the pixel that takes light, above 0, to 1 */
    double efficiency[SENSOR_CHANNELS]; /* electrons a photon, filters included, above 0, to 1 */
    double full_well;                   /* electrons a pixel holds, 1 and more; infinite: no end */
    double dark_current;                /* electrons a second at dark_temperature, >= 0 */
    double dark_temperature;            /* deg C */
    double doubling;                    /* of the dark current with temperature, K, 1 to 100 */
    double read_noise;                  /* standard deviation in the dark, electrons, >= 0 */
    double black;                       /* digital number of no electrons, >= 0 */
    int bits;                           /* of a digital number */
};

/* What its channels see. */
const struct sensor_response_traits *sensor_traits(const struct image_sensor *sensor);

/* A plain one: RGB, pixels of `pitch`, all light becomes electrons at efficiency 0.5, 14 bits. */
struct image_sensor sensor_plain(double pitch);

/* How it is used. */
struct sensor_setting {
    double iso;         /* saturation speed; NaN: `gain` is given */
    double gain;        /* K, digital numbers an electron; NaN: from the speed */
    double time;        /* of the exposure, s, >= 0 */
    double temperature; /* of the sensor, deg C */
    bool noiseless;     /* means in place of chance: quantisation stays */
    bool is_unfinished; /* black is not taken yet: it has means, and none of its chance is drawn */
    uint64_t seed;
    int threads; /* that expose it; no number depends on them */
};

/* A sensor in use: read-only. */
struct sensor_model {
    struct image_sensor sensor;
    struct sensor_setting setting;
    double electrons[SENSOR_CHANNELS]; /* of 1 lx s */
    double of_white;                   /* electrons of it in the reference channel */
    double dark;                       /* mean electrons in the dark */
    double gain;                       /* K, digital numbers an electron */
    double white;                      /* the largest digital number */
    double clip;                       /* the electrons that reach it, or the full well */
    double full_number;                /* the least digital number that a full pixel may have */
    double saturation;                 /* lx s at which the reference channel clips */
};

/*
 * Make a sensor ready.
 *
 * Result    model   electrons = fill efficiency pitch^2 SENSOR_PHOTONS; dark = current time
 *                   2^((temperature - dark_temperature)/doubling); K as given, or so that the
 *                   reference channel reaches the largest number at H_sat = 78/S of white light;
 *                   full_number is half a number below that of a full well, and four deviations of
 *                   the read noise, which is added to what the well holds; at least half of it
 * Source    [EMVA16] 2.1 (photons, K), 3 (dark current); [IsoSpeed06] 6.2 (H_sat); photons of
 *           light of other colours by lumens: an efficiency is that of light of 555 nm which gives
 *           as many lumens
 * Errors    ERROR_DOMAIN naming the number and its range; neither speed nor gain, or both; a
 *           mosaic of what is not RGB
 */
bool sensor_open(const struct image_sensor *sensor, const struct sensor_setting *setting,
                 struct sensor_model *model, struct error *error);

/* Where a picture lies in the whole frame: its own pixels have their own noise in any crop. */
struct sensor_place {
    size_t column, row; /* of its first pixel */
    size_t width;       /* of the frame, pixels */
};

/* What there is to warn of. */
struct sensor_sums {
    size_t values, saturated;  /* numbers made; those that are the largest, or of a full well */
    double brightest, darkest; /* largest and smallest mean of electrons made by light */
};

struct sensor_raw {
    struct image image;
    struct sensor_sums sums;
};

/*
 * Is it light for a sensor or film: 1 or 3 channels, finite and not below 0?
 *
 * Errors    ERROR_DOMAIN: another number of channels; ERROR_DATA naming column and row
 */
bool sensor_check_light(const struct image *light, struct error *error);

/* Luminous exposure of a pixel, lx s: what SENSOR_MONO sees. */
double sensor_luminous(const float *pixel, size_t channels);

/*
 * Expose the sensor.
 *
 * Given     light   H in lx s of each pixel: R, G, B where white has the same H in each, or one
 *                   channel, which is white light
 *           place   of its first pixel
 * Result    raw     digital numbers, as floats: one channel with a mosaic or mono, else three
 * Formula   y = round(black + K (min(n, full well) + sigma z)), n of a Poisson distribution with
 *           mean mu = H electrons + dark, z normal, cut to 0..white; so that off the ends
 *           variance = K^2 (sigma^2 + mu) + 1/12. Chance is of (seed, pixel of the frame, channel)
 * Source    [EMVA16] 2.1, 2.2
 * Errors    as sensor_check_light; ERROR_DATA: too many pixels
 * Limits    pixels know nothing of each other: no blooming, no crosstalk, no pixel better than
 *           others
 */
bool sensor_expose(const struct sensor_model *model, const struct image *light,
                   const struct sensor_place *place, struct arena *arena, struct sensor_raw *raw,
                   struct error *error);

/*
 * Digital numbers as a file of raw data holds them.
 *
 * Given     place  of its first pixel, where the pattern that is noted begins
 *           raw    of sensor_expose; its numbers are divided by 65535 in place, so that a PNG of 16
 *                  bits with IMAGE_CODES has them as they are; noted are "CFA pattern" (the
 *                  mosaic's word, or "none"), "Black level", "White level", "Saturation level", the
 *                  least number that a full pixel may have, and "Gain" in numbers an electron
 */
void sensor_codes(const struct sensor_model *model, const struct sensor_place *place,
                  struct image *raw, struct arena *arena);

#endif
