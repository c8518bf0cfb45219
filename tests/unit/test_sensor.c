/* tests/unit/test_sensor.c - electrons, noise, digital numbers and mosaics by closed forms. */
/* SPDX-License-Identifier: MIT */
#include "camera/sensor/demosaic.h"
#include "camera/sensor/sensor.h"
#include "check.h"

enum { SIDE = 200 };

static struct arena memory;
static struct arena *const arena = &memory;
static struct error error;

static const struct sensor_place whole = {0, 0, SIDE};

static struct sensor_setting by_gain(double gain)
{
    return (struct sensor_setting){.iso = NAN, .gain = gain, .temperature = 20, .seed = 9};
}

static struct sensor_setting by_speed(double iso)
{
    return (struct sensor_setting){.iso = iso, .gain = NAN, .temperature = 20, .seed = 9};
}

static struct image_sensor mono(void)
{
    struct image_sensor sensor = sensor_plain(0.005);
    sensor.response = SENSOR_MONO;
    sensor.black = 200;
    return sensor;
}

/* Light of one colour everywhere. */
static struct image even(size_t width, size_t height, double r, double g, double b)
{
    struct image light = {.width = width, .height = height, .channels = 3};
    CHECK(image_new(&light, arena, &error));
    const double colour[3] = {r, g, b};
    for (size_t i = 0; i < width * height * 3; i++) {
        light.pixels[i] = (float)colour[i % 3];
    }
    return light;
}

/* Mean and variance of one channel. */
static void moments(const struct image *raw, size_t channel, double *mean, double *variance)
{
    double sum = 0, sum2 = 0;
    const double count = (double)(raw->width * raw->height);
    for (size_t i = 0; i < raw->width * raw->height; i++) {
        sum += (double)raw->pixels[i * raw->channels + channel];
    }
    *mean = sum / count;
    for (size_t i = 0; i < raw->width * raw->height; i++) {
        const double d = (double)raw->pixels[i * raw->channels + channel] - *mean;
        sum2 += d * d;
    }
    *variance = sum2 / (count - 1);
}

/*
 * 25 um^2 in 1 lx s of 555 nm: 25e-12 m^2/(683.002 lm/W)/(6.62607015e-34 299792458/555e-9 J)
 * = 102266.7099 photons; half of them are electrons. The largest number of 14 bits at 78/100 lx s.
 */
static void test_electrons(void)
{
    struct image_sensor sensor = mono();
    struct sensor_setting setting = by_speed(100);
    struct sensor_model model;
    CHECK(sensor_open(&sensor, &setting, &model, &error));
    CHECK_RELATIVE(model.electrons[0], 51133.35494, 1e-9, "electrons");
    CHECK_RELATIVE(model.gain, (16383 - 200) / (0.78 * 51133.35494), 1e-9, "gain");
    CHECK_RELATIVE(model.saturation, 0.78, 1e-12, "saturation");
    sensor.fill = 0.25;
    sensor.efficiency[0] = 0.8;
    CHECK(sensor_open(&sensor, &setting, &model, &error));
    CHECK_RELATIVE(model.electrons[0], 0.25 * 0.8 * 102266.70988, 1e-9, "fill and efficiency");
    CHECK_RELATIVE(model.saturation, 0.78, 1e-12, "the speed is kept");
    /* dark current: 16 K are two doublings of 8 K: 3 e/s for 10 s become 120 */
    sensor.dark_current = 3;
    setting.time = 10;
    setting.temperature = 36;
    CHECK(sensor_open(&sensor, &setting, &model, &error));
    CHECK_RELATIVE(model.dark, 120.0, 1e-14, "dark electrons");
}

/* What a noiseless pixel says is the rounded mean; ends; a full well below the largest number. */
static void test_numbers(void)
{
    struct image_sensor sensor = mono();
    struct sensor_setting setting = by_gain(0.25);
    setting.noiseless = true;
    struct sensor_model model;
    struct sensor_raw raw;
    struct image light = even(4, 4, 0.1, 0.1, 0.1);
    CHECK(sensor_open(&sensor, &setting, &model, &error) &&
          sensor_expose(&model, &light, &whole, arena, &raw, &error));
    /* 200 + 0.25 5113.3355 = 1478.3339 */
    CHECK(raw.image.channels == 1 && raw.image.pixels[0] == 1478 && raw.image.pixels[15] == 1478);
    CHECK(raw.sums.values == 16 && raw.sums.saturated == 0);
    CHECK_RELATIVE(raw.sums.brightest, 5113.335494, 1e-6, "brightest");
    CHECK_RELATIVE(raw.sums.darkest, 5113.335494, 1e-6, "darkest");
    light = even(4, 4, 2, 2, 2); /* 102267 electrons: beyond 14 bits */
    CHECK(sensor_expose(&model, &light, &whole, arena, &raw, &error));
    CHECK(raw.image.pixels[0] == 16383 && raw.sums.saturated == 16);
    sensor.full_well = 30000;
    CHECK(sensor_open(&sensor, &setting, &model, &error) &&
          sensor_expose(&model, &light, &whole, arena, &raw, &error));
    CHECK(raw.image.pixels[0] == 7700 && raw.sums.saturated == 16);
    CHECK_RELATIVE(model.saturation, 30000 / 51133.35494, 1e-9, "of the full well");
    CHECK_NEAR(model.full_number, 7699.5, 0, "200 + 0.25 30000, less half a number");
    sensor.read_noise = 100;
    setting.noiseless = false;
    CHECK(sensor_open(&sensor, &setting, &model, &error));
    CHECK_NEAR(model.full_number, 7599.5, 0, "four deviations of the noise below");
    sensor.read_noise = 0;
    setting.noiseless = true;
    light = even(4, 4, 3e38, 3e38, 3e38);
    setting.noiseless = false;
    CHECK(sensor_open(&sensor, &setting, &model, &error) &&
          sensor_expose(&model, &light, &whole, arena, &raw, &error));
    CHECK(raw.image.pixels[7] == 7700 && raw.sums.saturated == 16);
    /* luminous exposure of pure red, green, blue: the weights of IEC 61966-2-1 */
    setting.noiseless = true;
    CHECK(sensor_open(&sensor, &setting, &model, &error));
    light = even(1, 1, 0, 0.1, 0);
    CHECK(sensor_expose(&model, &light, &whole, arena, &raw, &error));
    CHECK(raw.image.pixels[0] == 1114); /* 200 + 0.7152 1278.3339 = 1114.26 */
}

/* Mean K mu and variance K^2 (sigma^2 + mu) + 1/12, within 4 sigma of 40000 pixels. */
static void check_noise(double exposure, double read_noise, double gain, double *mean,
                        double *variance)
{
    struct image_sensor sensor = mono();
    sensor.read_noise = read_noise;
    sensor.dark_current = 2;
    struct sensor_setting setting = by_gain(gain);
    setting.time = 3;
    struct sensor_model model;
    const struct image light = even(SIDE, SIDE, exposure, exposure, exposure);
    struct sensor_raw raw;
    CHECK(sensor_open(&sensor, &setting, &model, &error) &&
          sensor_expose(&model, &light, &whole, arena, &raw, &error));
    const double mu = (double)(float)exposure * 51133.35494 + 6, count = SIDE * SIDE;
    const double expected = gain * gain * (read_noise * read_noise + mu) + 1.0 / 12;
    moments(&raw.image, 0, mean, variance);
    CHECK_NEAR(*mean, 200 + gain * mu, 4 * sqrt(expected / count), "mean");
    CHECK_NEAR(*variance, expected, 4 * expected * sqrt((2 + 1 / (mu + 1)) / count), "variance");
}

static void test_noise(void)
{
    static const double exposures[] = {0, 1e-4, 5e-4, 2e-3, 0.01, 0.03, 0.1};
    enum { COUNT = sizeof exposures / sizeof *exposures };
    double mean[COUNT], variance[COUNT];
    for (size_t i = 0; i < COUNT; i++) {
        check_noise(exposures[i], 3, 1.7, &mean[i], &variance[i]);
    }
    /* the photon transfer: variance over mean has the slope K, here between its ends */
    const double slope = (variance[COUNT - 1] - variance[0]) / (mean[COUNT - 1] - mean[0]);
    CHECK_RELATIVE(slope, 1.7, 4 * sqrt(2.0) / SIDE, "slope of variance over mean");
    check_noise(0.05, 20, 0.8, &mean[0], &variance[0]);
    check_noise(0.02, 12, 4, &mean[0], &variance[0]);
}

/* Noise belongs to the pixel of the frame, the channel and the seed. */
static void test_places(void)
{
    struct image_sensor sensor = sensor_plain(0.005);
    struct sensor_setting setting = by_speed(400);
    sensor.read_noise = 5;
    sensor.black = 64;
    struct sensor_model model, other;
    const struct image light = even(40, 30, 0.02, 0.02, 0.02), part = even(7, 5, 0.02, 0.02, 0.02);
    const struct sensor_place frame = {0, 0, 40}, crop = {11, 13, 40};
    struct sensor_raw raw, cropped, reseeded;
    CHECK(sensor_open(&sensor, &setting, &model, &error));
    setting.seed = 10;
    CHECK(sensor_open(&sensor, &setting, &other, &error));
    CHECK(sensor_expose(&model, &light, &frame, arena, &raw, &error) &&
          sensor_expose(&other, &light, &frame, arena, &reseeded, &error) &&
          sensor_expose(&model, &part, &crop, arena, &cropped, &error));
    size_t equal = 0, equal_seeds = 0, equal_channels = 0;
    for (size_t y = 0; y < 5; y++) {
        for (size_t k = 0; k < 21; k++) {
            const float here = image_row(&raw.image, y + 13)[33 + k];
            equal += image_row(&cropped.image, y)[k] == here;
            equal_seeds += image_row(&reseeded.image, y + 13)[33 + k] == here;
            equal_channels += k % 3 != 2 && image_row(&raw.image, y + 13)[34 + k] == here;
        }
    }
    CHECK(equal == 105 && equal_seeds < 10 && equal_channels < 10);
    model.setting.threads = 3;
    CHECK(sensor_expose(&model, &light, &frame, arena, &reseeded, &error));
    CHECK(memcmp(raw.image.pixels, reseeded.image.pixels, 3600 * sizeof(float)) == 0);
    CHECK(raw.sums.values == 3600 && reseeded.sums.values == 3600);
}

/* What is black of an unfinished picture has the mean of the dark, all else its own chance. */
static void test_unfinished(void)
{
    struct image_sensor sensor = mono();
    struct sensor_setting setting = by_gain(0.25);
    struct sensor_model model;
    struct sensor_raw whole_raw, part;
    struct image light = even(8, 8, 0, 0, 0);
    for (size_t i = 0; i < 3 * 24; i++) {
        light.pixels[i] = 0.1F;
    }
    sensor.read_noise = 40;
    CHECK(sensor_open(&sensor, &setting, &model, &error) &&
          sensor_expose(&model, &light, &whole, arena, &whole_raw, &error));
    setting.is_unfinished = true;
    CHECK(sensor_open(&sensor, &setting, &model, &error) &&
          sensor_expose(&model, &light, &whole, arena, &part, &error));
    CHECK(memcmp(part.image.pixels, whole_raw.image.pixels, 24 * sizeof(float)) == 0);
    size_t calm = 0, other = 0;
    for (size_t i = 24; i < 64; i++) {
        calm += part.image.pixels[i] == 200; /* the black level */
        other += whole_raw.image.pixels[i] != 200;
    }
    CHECK(calm == 40 && other > 20 && part.sums.values == 64 && part.sums.darkest == 0);
}

/* Colours by mosaic, from an odd first pixel too, and the file of raw data. */
static void test_mosaic(void)
{
    struct image_sensor sensor = sensor_plain(0.005);
    struct sensor_setting setting = by_gain(0.1);
    setting.noiseless = true;
    sensor.mosaic = MOSAIC_GRBG;
    struct sensor_model model;
    struct sensor_raw raw;
    const struct image light = even(4, 2, 0.1, 0.2, 0.3);
    const struct sensor_place odd = {1, 2, 10};
    CHECK(sensor_open(&sensor, &setting, &model, &error) &&
          sensor_expose(&model, &light, &odd, arena, &raw, &error));
    /* 511.3, 1022.7, 1534.0; the frame's rows begin G R and B G, this one's a column later */
    const float expected[2][4] = {{511, 1023, 511, 1023}, {1023, 1534, 1023, 1534}};
    CHECK(raw.image.channels == 1 && memcmp(raw.image.pixels, expected, sizeof expected) == 0);
    sensor_codes(&model, &odd, &raw.image, arena);
    CHECK(rint((double)raw.image.pixels[1] * 65535) == 1023 && raw.image.note_count == 5);
    CHECK_TEXT(raw.image.notes[0].value, "rggb");
    CHECK_TEXT(raw.image.notes[2].value, "16383");
    CHECK_TEXT(raw.image.notes[3].value, "16383");
}

/* What changes linearly is kept within, what is constant everywhere. */
static void test_demosaic(void)
{
    enum { W = 9, H = 8 };
    for (int mosaic = MOSAIC_RGGB; mosaic < SENSOR_MOSAICS; mosaic++) {
        struct image raw = {.width = W, .height = H, .channels = 1}, full;
        CHECK(image_new(&raw, arena, &error));
        const struct sensor_place place = {3, 4, 100};
        for (size_t i = 0; i < W * H; i++) {
            const size_t x = i % W, y = i / W;
            const size_t channel =
                sensor_mosaics[mosaic].channel[(y + place.row) % 2][(x + place.column) % 2];
            raw.pixels[i] = (float)(100 * (channel + 1) + 2 * x + 3 * y);
        }
        CHECK(demosaic_bilinear(&raw, (enum sensor_mosaic)mosaic, &place, arena, &full, &error));
        int right = 0;
        for (size_t i = 0; i < W * H * 3; i++) {
            const size_t x = i / 3 % W, y = i / 3 / W;
            const double expected = 100.0 * (double)(i % 3 + 1) + 2.0 * (double)x + 3.0 * (double)y;
            const double off = fabs((double)full.pixels[i] - expected);
            const bool within = x > 0 && y > 0 && x + 1 < W && y + 1 < H;
            right += within ? off < 1e-4 : off <= 5; /* a step along x, one along y */
        }
        CHECK(right == W * H * 3);
    }
    /* the least there can be has one red, two green and one blue */
    static const size_t sizes[][3] = {{2, 2, 1}, {3, 2, 1}, {2, 3, 1}, {1, 2, 0}, {2, 1, 0}};
    const struct sensor_place place = {0, 0, 100};
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        float values[] = {1, 2, 4, 8, 16, 32};
        const struct image raw = {
            .width = sizes[i][0], .height = sizes[i][1], .channels = 1, .pixels = values};
        struct image full;
        CHECK(demosaic_bilinear(&raw, MOSAIC_RGGB, &place, arena, &full, &error) ==
              (sizes[i][2] > 0));
        if (i == 0) {
            const float expected[] = {1, 3, 8, 1, 2, 8, 1, 4, 8, 1, 3, 8};
            CHECK(memcmp(full.pixels, expected, sizeof expected) == 0);
        }
    }
    CHECK_TEXT(error.message, "a mosaic has one channel and 2 x 2 pixels at least, not 1 of 2 x 1");
}

static void refused(struct image_sensor sensor, struct sensor_setting setting, const char *word)
{
    struct sensor_model model;
    CHECK(!sensor_open(&sensor, &setting, &model, &error) && error.code == ERROR_DOMAIN);
    check_at(strstr(error.message, word) != NULL, __FILE__, __LINE__, error.message);
}

static void test_refused(void)
{
    const struct image_sensor plain = sensor_plain(0.005);
    struct image_sensor sensor = plain;
    refused(plain, (struct sensor_setting){.iso = NAN, .gain = NAN}, "neither");
    refused(plain, (struct sensor_setting){.iso = 100, .gain = 1}, "not both");
    refused(plain, (struct sensor_setting){.iso = 0, .gain = NAN}, "ISO 0");
    refused(plain, (struct sensor_setting){.iso = -100, .gain = NAN}, "ISO -100");
    refused(plain, (struct sensor_setting){.iso = NAN, .gain = -1}, "gain -1");
    refused(plain, (struct sensor_setting){.iso = 100, .gain = NAN, .time = NAN}, "time nan");
    sensor.pitch = 0;
    refused(sensor, by_speed(100), "pixel pitch 0 mm");
    sensor = plain;
    sensor.fill = 1.5;
    refused(sensor, by_speed(100), "fill factor 1.5");
    sensor = plain;
    sensor.efficiency[2] = 0;
    refused(sensor, by_speed(100), "quantum efficiency 0");
    sensor = plain;
    sensor.bits = 17;
    refused(sensor, by_speed(100), "bits 17");
    sensor = plain;
    sensor.black = 16383;
    refused(sensor, by_speed(100), "black level 16383");
    sensor = plain;
    sensor.response = SENSOR_XYZ;
    sensor.mosaic = MOSAIC_RGGB;
    refused(sensor, by_speed(100), "mosaic");
    struct sensor_setting setting = by_speed(100);
    struct sensor_model model;
    CHECK(sensor_open(&plain, &setting, &model, &error));
    struct image light = even(2, 2, 0, 0, 0), full;
    struct sensor_raw raw;
    light.pixels[4] = -1e-9F;
    CHECK(!sensor_expose(&model, &light, &whole, arena, &raw, &error));
    light.pixels[4] = NAN;
    CHECK(!sensor_expose(&model, &light, &whole, arena, &raw, &error));
    light.channels = 2;
    CHECK(!sensor_expose(&model, &light, &whole, arena, &raw, &error));
    light = even(1, 2, 1, 1, 1);
    CHECK(!demosaic_bilinear(&light, MOSAIC_RGGB, &whole, arena, &full, &error));
}

int main(void)
{
    test_electrons();
    test_numbers();
    test_noise();
    test_places();
    test_unfinished();
    test_mosaic();
    test_demosaic();
    test_refused();
    arena_free(arena);
    return check_report();
}
