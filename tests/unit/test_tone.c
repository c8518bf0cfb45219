/* tests/unit/test_tone.c - merging, histogram adjustment and the eye by numbers made by hand. */
/* SPDX-License-Identifier: MIT */
#include "base/constants.h"
#include "tone/acuity.h"
#include "tone/merge.h"
#include "tone/operator.h"
#include "tone/saturation.h"
#include "tone/sight.h"
#include "tone_frames.h"

static struct error error;

static void test_levels(void)
{
    const double light[] = {0, 1, 4, 9, 10};
    const struct frame_level *levels = frame_levels_of(light, 5, arena);
    CHECK_NEAR((double)levels[0].keep, 1, 0, "dark");
    CHECK_NEAR((double)levels[2].spread, 4.0 * 4 / 12, 1e-6, "(9 - 1)/2 wide");
    CHECK_NEAR((double)levels[4].spread, 1.0 / 12, 1e-6, "the last one");
    CHECK_NEAR((double)levels[3].keep, 1, 1e-6, "nine tenths of 10");
    CHECK_NEAR((double)levels[4].keep, 0, 0, "full");
}

/*
 * Codes 51 and 102 of 255: light 0.04 in 1 s and 0.16 in 4 s, both 0.04 a second; the third pixel
 * says 0.09 (76.5 rounds to 77) and 0.16: weights by hand. The second is full in the long frame.
 */
static void test_merge(void)
{
    const uint8_t brief[] = {51, 200, 77, 255}, lengthy[] = {102, 255, 102, 255};
    struct tone_frame frames[] = {frame_of(brief, 4, 1, 1), frame_of(lengthy, 4, 1, 4)};
    const struct merge_noise noise = {1000, 10};
    struct merged merged;
    CHECK(merge_frames(frames, 2, &noise, arena, &merged, &error));
    const float *pixels = merged.image.pixels;
    CHECK_RELATIVE((double)pixels[1], 0.04, 1e-6, "two frames that agree");
    CHECK_RELATIVE((double)pixels[4], 200.0 / 255 * (200.0 / 255), 1e-6, "one that is not full");
    const double v[2] = {77.0 / 255 * (77.0 / 255), 0.16}, t[2] = {1, 4}, code[2] = {77, 102};
    const double x0 = (v[0] + v[1]) / 5;
    double above = 0, below = 0;
    for (int i = 0; i < 2; i++) {
        const double step = 2 * code[i] / (255.0 * 255);
        const double weight = t[i] * t[i] / (step * step / 12 + 1e-4 + x0 * t[i] / 1000);
        above += weight * v[i] / t[i];
        below += weight;
    }
    CHECK_RELATIVE((double)pixels[7], above / below, 1e-5, "weights by noise");
    CHECK_NEAR((double)pixels[10], 1, 1e-6, "full in both: the shorter");
    CHECK(merged.saturated == 1);
    CHECK(merged.apart == 0 && merged.looked == 4); /* noise is large */
    CHECK(merge_frames(frames, 2, &(struct merge_noise){1e6, 10}, arena, &merged, &error));
    CHECK(merged.apart == 1); /* the third */
    const uint8_t full[] = {255, 255, 255, 255};
    frames[0] = frame_of(full, 4, 1, 1);
    frames[1] = frame_of(full, 4, 1, 4);
    CHECK(!merge_frames(frames, 2, &noise, arena, &merged, &error) && error.code == ERROR_DOMAIN);
}

/* The mean that weights are made of is of the frames that keep the value, not of all frames. */
static void test_weights_of_kept(void)
{
    const uint8_t codes[3][2] = {{60, 110}, {80, 160}, {120, 255}};
    const double t[3] = {1, 2, 4};
    const struct merge_noise noise = {200, 2};
    struct tone_frame frames[3];
    struct merged merged;
    for (int f = 0; f < 3; f++) {
        frames[f] = frame_of(codes[f], 2, 1, t[f]);
    }
    CHECK(merge_frames(frames, 3, &noise, arena, &merged, &error));
    double v[2], above = 0, below = 0;
    for (int f = 0; f < 2; f++) {
        v[f] = codes[f][1] / 255.0 * (codes[f][1] / 255.0);
    }
    for (int f = 0; f < 2; f++) {
        const double step = 2 * codes[f][1] / (255.0 * 255), x0 = (v[0] + v[1]) / (t[0] + t[1]);
        const double variance = step * step / 12 + 2.0 * 2 / (200 * 200) + x0 * t[f] / 200;
        above += t[f] * v[f] / variance;
        below += t[f] * t[f] / variance;
    }
    CHECK_RELATIVE((double)merged.image.pixels[4], above / below, 1e-5, "full in the longest");
}

/* Shifted by one: what the second frame does not have comes from the first. */
static void test_shifted(void)
{
    const uint8_t first[] = {10, 60, 120, 90}, second[] = {60, 120, 90, 30};
    struct tone_frame frames[] = {frame_of(first, 4, 1, 1), frame_of(second, 4, 1, 1)};
    const struct merge_noise noise = {1000, 10};
    struct merged merged;
    frames[1].right = -1;
    CHECK(merge_frames(frames, 2, &noise, arena, &merged, &error));
    for (size_t i = 0; i < 4; i++) {
        CHECK_RELATIVE((double)merged.image.pixels[3 * i], first[i] / 255.0 * (first[i] / 255.0),
                       1e-6, "the same picture");
    }
    CHECK(merged.apart == 0);
}

/* Full in all that have it, and beyond the edge of the shortest: what the next longer one has. */
static void test_edge(void)
{
    const uint8_t brief[] = {20, 30, 40, 50}, middle[] = {102, 255, 255, 255};
    const uint8_t lengthy[] = {255, 255, 255, 255};
    struct tone_frame frames[] = {frame_of(lengthy, 4, 1, 4), frame_of(brief, 4, 1, 1),
                                  frame_of(middle, 4, 1, 2)};
    const struct merge_noise noise = {1000, 10};
    struct merged merged;
    frames[1].right = 2; /* it begins and ends two pixels further left */
    CHECK(merge_frames(frames, 3, &noise, arena, &merged, &error));
    const float *pixels = merged.image.pixels;
    CHECK_RELATIVE((double)pixels[3], 50.0 / 255 * (50.0 / 255), 1e-6, "the shortest has it");
    CHECK_RELATIVE((double)pixels[6], 0.5, 1e-6, "the middle one, full in 2 s");
    CHECK_RELATIVE((double)pixels[9], 0.5, 1e-6, "the outermost");
    CHECK(merged.saturated == 2);
}

/* Red is full everywhere: green and blue tell all the same. */
static void test_full_channel(void)
{
    const uint8_t greys[] = {255, 255, 255, 255};
    struct tone_frame frame = frame_of(greys, 4, 1, 1);
    uint8_t bytes[] = {255, 51, 0, 255, 51, 0, 255, 51, 0, 255, 51, 0};
    const struct merge_noise noise = {1, 0};
    struct merged merged;
    frame.bytes = bytes;
    CHECK(merge_frames(&frame, 1, &noise, arena, &merged, &error) && merged.saturated == 4);
    CHECK_RELATIVE((double)merged.image.pixels[0], 1.0, 1e-6, "red, too little");
    CHECK_RELATIVE((double)merged.image.pixels[1], 0.04, 1e-6, "green");
    frame.bytes = frame_of(greys, 4, 1, 1).bytes;
    CHECK(!merge_frames(&frame, 1, &noise, arena, &merged, &error));
    CHECK(strstr(error.message, "every frame") == NULL);
}

/* A picture of two rows: 100 shades and 100 pixels that are full at code 200. */
static struct tone_frame full_at_200(double time)
{
    enum { WIDTH = 100 };
    uint8_t greys[2 * WIDTH];
    for (int i = 0; i < 2 * WIDTH; i++) {
        const double light = (i < WIDTH ? 0.002 * i : 0.5) * time;
        const double code = rint(255 * sqrt(light));
        greys[i] = (uint8_t)(code < 200 ? code : 200);
    }
    return frame_of(greys, WIDTH, 2, time);
}

/* Its own word for it: half of the light of code 200 is trusted, from nine tenths on less. */
static void test_saturation(void)
{
    const double top = 200.0 / 255 * (200.0 / 255);
    struct saturation saturation;
    char text[200];
    snprintf(text, sizeof text, "%.9g 0 0 0 %.9g 0 0 0 %.9g", 1 / top, 1 / top, 1 / top);
    CHECK(saturation_read(text, &saturation, &error));
    struct tone_frame frame = full_at_200(4);
    const size_t shade = 3 * 35; /* light of 0.28 */
    CHECK(!frame_is_full(&frame, 3 * 150));
    saturation_apply(&frame, &saturation, arena);
    CHECK(frame_is_full(&frame, 3 * 150) && frame.trust[shade] == TRUST_MOST);
    /* code 195 and half a step more is 0.5877 of 0.6151, which is (1 - 0.9554)/0.1 of trust */
    const uint8_t near[] = {195, 200, 199, 10};
    frame = frame_of(near, 4, 1, 1);
    saturation_apply(&frame, &saturation, arena);
    CHECK_NEAR(frame.trust[0] / 255.0, (1 - 195.5 * 195.5 / 40000) / 0.1, 5e-3, "near the end");
    CHECK(frame.trust[3] == 0 && frame.full == 3 &&
          frame.trust[6] < 26); /* of 199 little is left */
    /* colours that are mixed of all channels: one that is full spoils all three */
    CHECK(saturation_read("0.5 0.3 0.2 0.2 0.7 0.1 0 0.1 4", &saturation, &error));
    frame = frame_of(near, 4, 1, 1);
    saturation_apply(&frame, &saturation, arena);
    CHECK(frame.trust[0] == 0 && frame.trust[1] == 0 && frame.trust[2] == 0);
    CHECK(frame.trust[9] == TRUST_MOST);
    static const char *const bad[] = {"", "1 0 0 0 1 0 0 0", "1 0 0 0 1 0 0 0 x", "1 0",
                                      "1 0 0 0 1 0 0 0 1 0", "1 0 0 1 0 0 0 0 1",
                                      /* a row, or a column, is the sum of the others */
                                      "0.5 0.3 0.2 0.1 0.7 0.2 0.6 1 0.4",
                                      "0.5 0.3 0.8 0.1 0.7 0.8 0.6 0.1 0.7"};
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        CHECK(!saturation_read(bad[i], &saturation, &error) && error.code == ERROR_DATA);
    }
}

/* Nobody says so: what the shorter frame shows does, and what all frames show alike does not. */
static void test_saturation_found(void)
{
    struct tone_frame frames[] = {full_at_200(4), full_at_200(1)};
    const struct merge_noise noise = {1e6, 1};
    struct saturation_found found;
    struct merged merged;
    saturation_find(frames, 2, arena, &found);
    CHECK(found.is_found[0] && found.is_found[1] && found.is_found[2]);
    CHECK_NEAR((double)found.light[1], 40000.0 / 65025, 1e-6, "code 200");
    CHECK_NEAR(found.share, 0.5 + 0.12, 0.02, "half of the picture, and the lightest shades");
    CHECK(merge_frames(frames, 2, &noise, arena, &merged, &error));
    CHECK_RELATIVE((double)merged.image.pixels[3 * 150], 0.5, 0.01, "full in the longer frame");
    CHECK_RELATIVE((double)merged.image.pixels[3 * 90], 0.18, 0.02, "and a shade");
    struct tone_frame even[] = {full_at_200(1), full_at_200(0.25)};
    saturation_find(even, 2, arena, &found);
    CHECK(found.name == NULL && even[0].trust == NULL && even[1].trust == NULL);
}

/* Steep levels near black are narrower than single precision has; without noise nothing is 0/0. */
static void test_steep(void)
{
    const uint8_t greys[] = {0, 1, 2, 200};
    double light[FRAME_LEVELS];
    struct tone_frame frame = frame_of(greys, 4, 1, 1);
    struct merged merged;
    for (int i = 0; i < FRAME_LEVELS; i++) {
        light[i] = pow(i / 255.0, 20);
    }
    for (size_t k = 0; k < FRAME_CHANNELS; k++) {
        frame.levels[k] = frame_levels_of(light, FRAME_LEVELS, arena);
    }
    CHECK(merge_frames(&frame, 1, &(struct merge_noise){1000, 0}, arena, &merged, &error));
    CHECK_NEAR((double)merged.image.pixels[0], 0, 0, "black");
    CHECK_NEAR((double)merged.image.pixels[3], 0, 1e-30, "hardly more");
    CHECK_RELATIVE((double)merged.image.pixels[9], light[200], 1e-6, "light");
    CHECK(merged.saturated == 0);
}

/* By hand from the formulas; they meet where one follows the other, within their own rounding. */
static void test_sight(void)
{
    static const double meet[] = {-3.94, -1.44, -0.0184, 1.9};
    CHECK_RELATIVE(sight_threshold(100), pow(10, 0.745), 1e-12, "100 cd/m2");
    CHECK_RELATIVE(sight_threshold(0.1), pow(10, -1.395), 1e-12, "0.1 cd/m2");
    CHECK_RELATIVE(sight_threshold(1e-5), 0.0013803842646, 1e-9, "1e-5 cd/m2: 10^-2.86");
    CHECK_RELATIVE(sight_threshold(1), pow(10, pow(0.65, 2.7) - 0.72), 1e-12, "1 cd/m2");
    for (size_t i = 0; i < sizeof meet / sizeof meet[0]; i++) {
        const double below = sight_threshold(pow(10, meet[i] - 1e-6));
        const double above = sight_threshold(pow(10, meet[i] + 1e-6));
        CHECK_RELATIVE(above, below, 0.03, "where two meet");
    }
    CHECK_NEAR(sight_acuity(1), 17.25 * 0.33667481938672716 + 25.72, 1e-12, "atan(0.35)");
    CHECK_RELATIVE(sight_acuity(1e-9), sight_acuity(1e-4), 1e-12, "no darker than 1e-4");
    CHECK_RELATIVE(sight_scotopic((double[]){3, 3, 3}), 3.0, 1e-12, "white");
    CHECK(sight_scotopic((double[]){1, 0, 0}) < 0.2126 / 2); /* red turns dark */
}

/* A picture whose places of one degree are its pixels. */
static struct foveal places(const double *luminances, size_t count)
{
    struct foveal foveal = {.columns = count, .rows = 1, .cell = {0.0175, 0.0175}};
    foveal.light = ARENA_ARRAY(arena, 3 * count, float);
    for (size_t i = 0; i < 3 * count; i++) {
        foveal.light[i] = (float)luminances[i / 3];
    }
    return foveal;
}

/*
 * Half of 1000 samples in one bin of 100, the others even over four decades; a display of two:
 * in the end less than 2.5 % is cut, no bin is above the ceiling, and the others are whole.
 */
static void test_histogram(void)
{
    enum { SAMPLES = 1000 };
    const struct display display = {1, 100};
    double luminances[SAMPLES];
    struct histogram made;
    for (int i = 0; i < SAMPLES; i++) {
        luminances[i] = i % 2 == 0 ? 10.01 : pow(10, -1 + 4.0 * i / (SAMPLES - 1));
    }
    const struct foveal foveal = places(luminances, SAMPLES);
    CHECK(histogram_adjust(&foveal, &display, CEILING_LINEAR, &made, &error));
    double left = 0, most = 0;
    for (int i = 0; i < HISTOGRAM_BINS; i++) {
        left += made.bins[i];
        most = fmax(most, made.bins[i]);
        CHECK(made.bins[i] >= 4 && made.bins[i] <= 500);
    }
    CHECK(!made.is_linear && made.trimmed < HISTOGRAM_TOLERANCE && made.passes > 1);
    /* T db/(ln Ldmax - ln Ldmin), db a hundredth of four decades */
    CHECK(most <= (left + made.trimmed * SAMPLES) * (4.0 / 100) / 2 * 1.001);
    CHECK_NEAR(left, 500 - 5 + most, 3, "only the one bin is cut");
    CHECK_RELATIVE(histogram_shown(&made, 0.05), 1.0, 1e-12, "darker than all");
    CHECK_RELATIVE(histogram_shown(&made, 5000), 100.0, 1e-12, "brighter than all");
    const double even[] = {3, 4, 5};
    const struct foveal dull = places(even, 3);
    CHECK(histogram_adjust(&dull, &display, CEILING_LINEAR, &made, &error) && made.is_linear);
    CHECK_RELATIVE(made.factor, 10 / cbrt(60), 1e-6, "the mean of logarithms to the middle");
    const double dark[] = {1e-6, 1e-5, 0};
    const struct foveal night = places(dark, 3);
    CHECK(!histogram_adjust(&night, &display, CEILING_LINEAR, &made, &error));
    CHECK(error.code == ERROR_DOMAIN);
}

/* More places than light is scattered between: even green stays even, and red of a lamp is kept. */
static void test_veil(void)
{
    enum { SIDE = 100, LAMP = 3 * (SIDE * 20 + 15), FAR = 3 * (SIDE * 30 + 30) };
    float *pixels = ARENA_ARRAY(arena, SIDE * SIDE * 3, float);
    struct image image = {.width = SIDE, .height = SIDE, .channels = 3, .pixels = pixels};
    double before = 0, after = 0, off = 0;
    for (size_t i = 0; i < SIDE * SIDE * 3; i++) {
        pixels[i] = i == LAMP ? 1e5F : 2;
        before += i % 3 == 0 ? (double)pixels[i] : 0;
    }
    struct foveal foveal = foveal_look(&image, 2.0, arena);
    const struct foveal_grid grid = foveal_veil(&foveal, &image, arena);
    CHECK(foveal.columns == SIDE && foveal.rows == SIDE);
    CHECK(grid.columns == 89 && grid.rows == 89); /* 100 sqrt(8000/10000) = 89.4 */
    for (size_t i = 0; i < SIDE * SIDE * 3; i += 3) {
        after += (double)pixels[i];
        off = fmax(off, fabs((double)pixels[i + 1] - 2));
    }
    CHECK_RELATIVE(after, before, 1e-5, "light");
    CHECK_NEAR(off, 0, 0.01, "even");
    CHECK(pixels[LAMP + 9] > pixels[FAR] && pixels[FAR] > 2);
    CHECK_RELATIVE((double)foveal.light[FAR], (double)pixels[FAR], 1e-3, "places of one pixel");
}

/* Waves along x, 0, or y, 1, that become finer and finer. */
static struct image waves(size_t width, size_t height, double aspect, int axis)
{
    struct image image = {.width = width, .height = height, .channels = 3, .aspect = aspect};
    CHECK(image_new(&image, arena, &error));
    for (size_t i = 0; i < 3 * width * height; i++) {
        const size_t pixel = i / 3, at = axis == 0 ? pixel % width : pixel / width;
        image.pixels[i] = (float)(0.01 * (1.1 + sin(5e-3 * (double)(at * at))));
    }
    return image;
}

/*
 * The same view in square pixels and in ones twice as long across the waves has the same places,
 * and is as unsharp.
 */
static void test_long_pixels(void)
{
    enum { SIDE = 192 };
    for (int axis = 0; axis < 2; axis++) {
        const size_t width = axis == 0 ? SIDE : SIDE / 2, height = axis == 0 ? SIDE / 2 : SIDE;
        const struct image square = waves(SIDE, SIDE, 0, axis);
        const struct image flat = waves(width, height, axis == 0 ? 0.5 : 2, axis);
        const struct foveal looks[] = {foveal_look(&square, 0.14, arena),
                                       foveal_look(&flat, 0.14, arena)};
        struct image made[2];
        double off = 0, changed = 0;
        CHECK(looks[1].columns == 8 && looks[1].rows == 8); /* 2 tan 0.07 is 8.03 degrees */
        CHECK_NEAR(looks[1].cell[1], looks[0].cell[1], 1e-15, "as high as wide");
        CHECK(acuity_blur(&looks[0], &square, arena, &made[0], &error));
        CHECK(acuity_blur(&looks[1], &flat, arena, &made[1], &error));
        for (size_t i = 0; i < width * height; i++) {
            const size_t x = i % width * (SIDE / width), y = i / width * (SIDE / height);
            const double a = (double)image_row(&made[0], y)[3 * x];
            const double b = (double)made[1].pixels[3 * i];
            off = fmax(off, fabs(a - b));
            changed = fmax(changed, fabs(b - (double)flat.pixels[3 * i]));
        }
        CHECK_NEAR(off, 0, 1e-7, "as sharp");
        CHECK(changed > 1e-3);
    }
}

/* A strip of one column is as unsharp as its transpose, of one row. */
static void test_strips(void)
{
    enum { LENGTH = 512 };
    const struct image column = waves(1, LENGTH, 0, 1), row = waves(LENGTH, 1, 0, 0);
    const double pixel = 0.07 / LENGTH; /* on the plane at distance 1 */
    const struct foveal looks[] = {foveal_look(&column, 2 * atan(pixel / 2), arena),
                                   foveal_look(&row, 2 * atan(LENGTH * pixel / 2), arena)};
    struct image made[2];
    double off = 0, changed = 0;
    CHECK(looks[0].rows == 4 && looks[1].columns == 4); /* 0.07 is 4.01 degrees */
    CHECK(acuity_blur(&looks[0], &column, arena, &made[0], &error));
    CHECK(acuity_blur(&looks[1], &row, arena, &made[1], &error));
    for (size_t i = 0; i < (size_t)3 * LENGTH; i++) {
        off = fmax(off, fabs((double)(made[0].pixels[i] - made[1].pixels[i])));
        changed = fmax(changed, fabs((double)(made[1].pixels[i] - row.pixels[i])));
    }
    CHECK_NEAR(off, 0, 1e-7, "as sharp");
    CHECK(changed > 1e-3);
}

/* One pixel has no smaller picture: it stays as it is. */
static void test_one_pixel(void)
{
    float pixels[] = {1, 2, 3};
    const struct image image = {.width = 1, .height = 1, .channels = 3, .pixels = pixels};
    const struct foveal look = foveal_look(&image, 1.0, arena);
    struct image made;
    CHECK(acuity_blur(&look, &image, arena, &made, &error));
    for (int k = 0; k < 3; k++) {
        CHECK_RELATIVE((double)made.pixels[k], (double)pixels[k], 1e-6, "one pixel");
    }
}

/* Colours that the display does not have keep their luminance. */
static void test_colours(void)
{
    float pixels[] = {90, 5, 5, 10, 10, 10, -2, 20, 1, 400, 300, 500};
    struct image image = {.width = 4, .height = 1, .channels = 3, .pixels = pixels};
    const struct tone_way way = {.operation = TONE_LINEAR, .white = 50, .display = {1e-9, 100}};
    const struct foveal foveal = places((double[]){1, 2}, 2);
    struct toned toned;
    CHECK(tone_show(&way, &foveal, &image, arena, &toned, &error));
    CHECK_NEAR((double)pixels[0], 1, 1e-6, "red is full");
    CHECK_NEAR((double)sight_luminance(pixels), (0.2126 * 90 + 0.7874 * 5) / 50, 1e-5, "luminance");
    CHECK_NEAR((double)pixels[4], 0.2, 1e-5, "grey");
    CHECK_NEAR((double)pixels[6], 0, 1e-6, "no less than black");
    CHECK_NEAR((double)pixels[9], 1, 1e-5, "brighter than white");
    CHECK_NEAR((double)pixels[11], 1, 1e-5, "white");
    CHECK(toned.clipped == 1);
}

/* What has no luminance, whatever its channels are, is black in all of them. */
static void test_black(void)
{
    for (int as_light = 0; as_light < 2; as_light++) {
        float pixels[] = {-5, 1, 3, 3, -1.5F, 2, 10, 10, 10};
        struct image image = {.width = 3, .height = 1, .channels = 3, .pixels = pixels};
        const struct tone_way way = {.operation = TONE_LINEAR,
                                     .white = 50,
                                     .as_light = as_light != 0,
                                     .display = {0.5, 100}};
        const struct foveal foveal = places((double[]){1, 2}, 2);
        struct toned toned;
        CHECK(tone_show(&way, &foveal, &image, arena, &toned, &error));
        for (int i = 0; i < 6; i++) {
            CHECK_NEAR((double)pixels[i], as_light ? 0.5 : 0, 1e-6, "black");
        }
        CHECK(pixels[6] > 0.1F);
    }
}

/* Whole numbers of a file of 8 and of 16 bits, and how many are the highest. */
static void test_codes(void)
{
    static const float codes[] = {0, 1, 127, 128, 254, 255};
    for (int bits = 8; bits <= 16; bits += 8) {
        float pixels[6];
        struct image image = {
            .width = 2, .height = 1, .channels = 3, .bits = bits, .pixels = pixels};
        struct tone_frame frame;
        for (int i = 0; i < 6; i++) {
            pixels[i] = bits == 8 ? codes[i] / 255 : (codes[i] + 65280) / 65535;
        }
        CHECK(frame_take(&image, arena, &frame, &error) && frame.full == 1);
        for (size_t i = 0; i < 6; i++) {
            CHECK((bits == 8 ? frame.bytes[i] : frame.codes[i] - 65280) == (int)codes[i]);
            CHECK(frame_is_full(&frame, i) == (i == 5));
        }
    }
}

/* Floats beside whole numbers: they weigh by their time, t^2 over t. */
static void test_merge_floats(void)
{
    const uint8_t greys[] = {102, 102};
    float values[] = {0.2F, 0.3F, 0.4F, 0.5F, 0.6F, 0.7F};
    struct tone_frame frames[] = {frame_of(greys, 2, 1, 1),
                                  {.name = "f", .width = 2, .height = 1, .time = 3}};
    const struct merge_noise noise = {100, 40};
    struct merged merged;
    frames[1].values = values;
    CHECK(merge_frames(frames, 2, &noise, arena, &merged, &error));
    for (size_t i = 0; i < 6; i++) {
        const double light = 0.16, value = (double)values[i], step = 2 * 102 / (255.0 * 255);
        const double variance =
            step * step / 12 + 40.0 * 40 / (100 * 100) + (light + value) / (1 + 3) / 100;
        const double above = light / variance + value, below = 1 / variance + 3;
        CHECK_RELATIVE((double)merged.image.pixels[i], above / below, 1e-6, "both kinds");
    }
}

/*
 * Below 0.0056 cd/m2 as rods see, Y (1.33 (1 + (Y + Z)/X) - 1.68) over that of white, from 5.6 on
 * as it is, a share of both between them; and no pixel more than the picture has.
 */
static void test_fade(void)
{
    static const double rgb[] = {1.8, 0.6, 2.5}, luminances[] = {0.001, 0.0056, 2, 30, 0.001};
    static const double to_xyz[3][3] = {
        {0.4124, 0.3576, 0.1805}, {0.2126, 0.7152, 0.0722}, {0.0193, 0.1192, 0.9505}};
    float pixels[5 * 3];
    struct image image = {.width = 2, .height = 2, .channels = 3, .pixels = pixels};
    double seen[2] = {0};
    for (int white = 0; white < 2; white++) {
        double xyz[3] = {0};
        for (int i = 0; i < 9; i++) {
            xyz[i / 3] += to_xyz[i / 3][i % 3] * (white > 0 ? 1 : rgb[i % 3]);
        }
        seen[white] = 1.33 * (1 + (xyz[1] + xyz[2]) / xyz[0]) - 1.68; /* of luminance 1 */
    }
    const double all = to_xyz[1][0] * rgb[0] + to_xyz[1][1] * rgb[1] + to_xyz[1][2] * rgb[2];
    for (size_t i = 0; i < 15; i++) {
        pixels[i] = (float)(rgb[i % 3] / all * luminances[i / 3]);
    }
    acuity_fade(&image);
    for (size_t i = 0; i < 15; i++) {
        const double luminance = luminances[i / 3];
        const double share =
            i / 3 == 4 ? 1 : fmin(fmax((luminance - 0.0056) / (5.6 - 0.0056), 0), 1);
        const double expected = share * rgb[i % 3] / all + (1 - share) * seen[0] / seen[1];
        CHECK_RELATIVE((double)pixels[i], luminance * expected, 1e-6, "colour and grey");
    }
}

int main(void)
{
    test_levels();
    test_merge();
    test_weights_of_kept();
    test_shifted();
    test_edge();
    test_full_channel();
    test_saturation();
    test_saturation_found();
    test_steep();
    test_sight();
    test_histogram();
    test_veil();
    test_long_pixels();
    test_strips();
    test_one_pixel();
    test_colours();
    test_black();
    test_codes();
    test_merge_floats();
    test_fade();
    arena_free(arena);
    return check_report();
}
