/* tests/unit/test_merge.c - exposures merged and full ones found, at the edges of their limits. */
/* SPDX-License-Identifier: MIT */
#include "tone/merge.h"
#include "tone/saturation.h"
#include "tone_frames.h"

static struct error error;

/* -------- merging -------- */

static double light_of(unsigned code)
{
    return code / 255.0 * (code / 255.0);
}

/* Of the squares that frame_of makes of its codes. */
static double step_variance(unsigned code)
{
    const double step = 2.0 * code / (255.0 * 255);
    return step * step / 12;
}

/* Wider than what is merged at once, and no multiple of it; moved both ways. */
static void test_wide(void)
{
    enum { WIDTH = 300, HEIGHT = 5, RIGHT = 7, DOWN = 2, ROOM = 8 };
    static uint8_t scene[HEIGHT + 2 * ROOM][WIDTH + 2 * ROOM], seen[2][HEIGHT * WIDTH];
    const struct merge_noise noise = {1000, 10};
    for (int way = -1; way <= 1; way += 2) {
        struct tone_frame frames[2];
        struct merged merged;
        for (int y = 0; y < HEIGHT + 2 * ROOM; y++) {
            for (int x = 0; x < WIDTH + 2 * ROOM; x++) {
                scene[y][x] = (uint8_t)(1 + (37 * x + 101 * y) % 200);
            }
        }
        for (int i = 0; i < HEIGHT * WIDTH; i++) {
            const int x = i % WIDTH + ROOM, y = i / WIDTH + ROOM;
            seen[0][i] = scene[y][x];
            seen[1][i] = scene[y - way * DOWN][x - way * RIGHT];
        }
        for (int f = 0; f < 2; f++) {
            frames[f] = frame_of(seen[f], WIDTH, HEIGHT, 1);
        }
        frames[1].right = way * RIGHT;
        frames[1].down = way * DOWN;
        CHECK(merge_frames(frames, 2, &noise, arena, &merged, &error));
        CHECK(merged.looked == (size_t)HEIGHT * WIDTH && merged.apart == 0);
        for (size_t i = 0; i < (size_t)3 * HEIGHT * WIDTH; i++) {
            CHECK_RELATIVE((double)merged.image.pixels[i], light_of(seen[0][i / 3]), 1e-6, "wide");
        }
    }
}

/* The same code in two frames of other times, one trusted by a fifth: its weight is a fifth. */
static void test_trust(void)
{
    const uint8_t brief[] = {60}, lengthy[] = {150};
    uint8_t trust[] = {51, 255, 0};
    const double t[] = {1, 5}, v[] = {light_of(60), light_of(150)};
    const struct merge_noise noise = {500, 3};
    struct tone_frame frames[] = {frame_of(brief, 1, 1, t[0]), frame_of(lengthy, 1, 1, t[1])};
    struct merged merged;
    frames[1].trust = trust;
    CHECK(merge_frames(frames, 2, &noise, arena, &merged, &error));
    for (int k = 0; k < 3; k++) {
        const double keep[] = {1, trust[k] / 255.0};
        const double x0 = (keep[0] * v[0] + keep[1] * v[1]) / (keep[0] * t[0] + keep[1] * t[1]);
        double above = 0, below = 0;
        for (int f = 0; f < 2; f++) {
            const double variance =
                step_variance(f == 0 ? 60 : 150) + 9.0 / (500 * 500) + x0 * t[f] / 500;
            above += keep[f] * t[f] * v[f] / variance;
            below += keep[f] * t[f] * t[f] / variance;
        }
        CHECK_RELATIVE((double)merged.image.pixels[k], above / below, 1e-6, "trusted less");
    }
}

/* Two codes of one time: what is their difference from the mean, in limits of 6 sigma and 2 %? */
static double apart_by(const uint8_t codes[2], double full_well, double read_noise)
{
    double above = 0, below = 0, most = 0;
    const double x0 = (light_of(codes[0]) + light_of(codes[1])) / 2;
    for (int f = 0; f < 2; f++) {
        const double variance = step_variance(codes[f]) +
                                read_noise * read_noise / (full_well * full_well) + x0 / full_well;
        above += light_of(codes[f]) / variance;
        below += 1 / variance;
    }
    const double mean = above / below;
    for (int f = 0; f < 2; f++) {
        const double variance = step_variance(codes[f]) +
                                read_noise * read_noise / (full_well * full_well) +
                                mean / full_well;
        most = fmax(most, fabs(light_of(codes[f]) - mean) / (6 * sqrt(variance) + 0.02 * mean));
    }
    return most;
}

/* Frames differ where the noise is less than a limit, and do not where it is more. */
static void test_apart(void)
{
    static const struct {
        uint8_t codes[2];
        bool is_read; /* noise of reading, or of photons */
    } cases[] = {{{100, 110}, true},  {{20, 30}, true},    {{200, 212}, true},
                 {{200, 212}, false}, {{100, 110}, false}, {{20, 30}, false}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        double low = 1e-6, high = 1e6; /* of 1/n, and of the read noise over n */
        const bool is_read = cases[i].is_read;
        while (high > low * (1 + 1e-9)) {
            const double noise = sqrt(low * high);
            const double by = is_read ? apart_by(cases[i].codes, 1e12, noise * 1e12)
                                      : apart_by(cases[i].codes, 1 / noise, 0);
            *(by > 1 ? &low : &high) = noise;
        }
        for (int side = 0; side < 2; side++) {
            const double noise = low * (side == 0 ? 0.995 : 1.005);
            struct tone_frame frames[] = {frame_of(&cases[i].codes[0], 1, 1, 1),
                                          frame_of(&cases[i].codes[1], 1, 1, 1)};
            struct merged merged;
            CHECK(merge_frames(frames, 2,
                               is_read ? &(struct merge_noise){1e12, noise * 1e12}
                                       : &(struct merge_noise){1 / noise, 0},
                               arena, &merged, &error));
            CHECK(merged.looked == 1 && merged.apart == (side == 0));
        }
    }
}

/* A frame that is kept by half and less is not asked whether it differs. */
static void test_apart_kept(void)
{
    const uint8_t codes[] = {100, 200, 100};
    const struct merge_noise noise = {1e9, 1};
    for (int trusted = 127; trusted <= 128; trusted++) {
        uint8_t trust[] = {0, (uint8_t)trusted, 0};
        struct tone_frame frames[3];
        struct merged merged;
        for (int f = 0; f < 3; f++) {
            frames[f] = frame_of(&codes[f], 1, 1, 1);
        }
        /* without noise the two that agree have most of the weight */
        frames[1].trust = trust;
        for (size_t k = 0; k < FRAME_CHANNELS; k++) {
            struct frame_level *levels = ARENA_ARRAY(arena, FRAME_LEVELS, struct frame_level);
            for (size_t c = 0; c < FRAME_LEVELS; c++) {
                levels[c] = (struct frame_level){(float)light_of((unsigned)c), 1, 1};
            }
            frames[1].levels[k] = levels;
        }
        CHECK(merge_frames(frames, 3, &noise, arena, &merged, &error));
        CHECK(merged.looked == 1 && merged.apart == 0); /* its own spread is wide */
        for (size_t k = 0; k < FRAME_CHANNELS; k++) {
            struct frame_level *levels = ARENA_ARRAY(arena, FRAME_LEVELS, struct frame_level);
            for (size_t c = 0; c < FRAME_LEVELS; c++) {
                levels[c] = (struct frame_level){(float)light_of((unsigned)c), 1, 1e-3F};
            }
            frames[1].levels[k] = levels;
        }
        CHECK(merge_frames(frames, 3, &noise, arena, &merged, &error));
        CHECK(merged.looked == 1 && merged.apart == (trusted > 127));
    }
}

/* Of a large picture rows are left out: about 2^20 pixels are looked at. */
static void test_looked(void)
{
    enum { WIDTH = 1024, HEIGHT = 1025 };
    float *values = ARENA_ARRAY(arena, (size_t)3 * WIDTH * HEIGHT, float);
    struct tone_frame frames[2];
    struct merged merged;
    for (size_t i = 0; i < (size_t)3 * WIDTH * HEIGHT; i++) {
        values[i] = 1;
    }
    for (int f = 0; f < 2; f++) {
        frames[f] = (struct tone_frame){
            .name = "f", .width = WIDTH, .height = HEIGHT, .values = values, .time = 1};
    }
    CHECK(merge_frames(frames, 2, &(struct merge_noise){1000, 1}, arena, &merged, &error));
    CHECK(merged.looked == (size_t)WIDTH * (HEIGHT / 2 + 1));
    frames[0].height = frames[1].height = HEIGHT - 2;
    CHECK(merge_frames(frames, 2, &(struct merge_noise){1000, 1}, arena, &merged, &error));
    CHECK(merged.looked == (size_t)WIDTH * (HEIGHT - 2));
}

/* -------- what piles up -------- */

/* Pixels of one kind: how many, of what light in the longer frame and in the shorter one. */
struct kind_of_pixel {
    size_t count;
    double light[2];
};

/* Floats of 4 s and of 1 s; is their green found to be full? */
static bool is_found(const struct kind_of_pixel *kinds, size_t count)
{
    size_t pixels = 0;
    for (size_t i = 0; i < count; i++) {
        pixels += kinds[i].count;
    }
    struct tone_frame frames[2];
    for (size_t f = 0; f < 2; f++) {
        float *values = ARENA_ARRAY(arena, FRAME_CHANNELS * pixels, float);
        size_t at = 0;
        for (size_t i = 0; i < count; i++) {
            for (size_t k = 0; k < kinds[i].count; k++, at++) {
                values[FRAME_CHANNELS * at] = values[FRAME_CHANNELS * at + 2] = 0;
                values[FRAME_CHANNELS * at + 1] = (float)kinds[i].light[f];
            }
        }
        frames[f] = (struct tone_frame){.name = f == 0 ? "long" : "short",
                                        .width = pixels,
                                        .height = 1,
                                        .values = values,
                                        .time = f == 0 ? 4 : 1};
    }
    struct saturation_found found;
    saturation_find(frames, 2, arena, &found);
    CHECK(!found.is_found[0] && !found.is_found[2]);
    if (found.is_found[1]) {
        CHECK_RELATIVE((double)found.light[1], kinds[0].light[0], 1e-6, "its light");
        CHECK_TEXT(found.name, "long");
    }
    return found.is_found[1];
}

/* 40 pixels at 1 that the shorter frame shows brighter, 10 just below, others; to both sides. */
static void test_piles(void)
{
    static const struct {
        struct kind_of_pixel kinds[4];
        bool is_found;
    } cases[] = {
        {{{40, {1, 0.5}}, {10, {0.97, 0.97 / 4}}, {1000, {0.4, 0.1}}}, true},
        /* 32 at least, and a thousandth */
        {{{32, {1, 0.5}}, {1000, {0.4, 0.1}}}, true},
        {{{31, {1, 0.5}}, {1000, {0.4, 0.1}}}, false},
        {{{40, {1, 0.5}}, {39950, {0.4, 0.1}}}, true},
        {{{40, {1, 0.5}}, {39970, {0.4, 0.1}}}, false},
        /* four times as many as just below, from 0.96 to 0.99 */
        {{{40, {1, 0.5}}, {11, {0.97, 0.97 / 4}}, {1000, {0.4, 0.1}}}, false},
        {{{40, {1, 0.5}}, {11, {0.9595, 0.2398}}, {1000, {0.4, 0.1}}}, true},
        {{{40, {1, 0.5}}, {11, {0.9605, 0.2401}}, {1000, {0.4, 0.1}}}, false},
        {{{40, {1, 0.5}}, {11, {0.9905, 0.5}}, {1000, {0.4, 0.1}}}, true},
        {{{40, {1, 0.5}}, {11, {0.9895, 0.5}}, {1000, {0.4, 0.1}}}, false},
        {{{20, {100, 50}}, {12, {99, 50}}, {1000, {40, 10}}}, true},
        {{{20, {100, 50}}, {12, {98.99, 50}}, {1000, {40, 10}}}, false},
        /* 1.15 times the light elsewhere, */
        {{{40, {1, 0.2885}}, {1000, {0.4, 0.1}}}, true},
        {{{40, {1, 0.2865}}, {1000, {0.4, 0.1}}}, false},
        /* which is that from 0.1 to 0.8, here of a quarter each; another there would hide it */
        {{{40, {1, 0.2885}}, {1000, {0.0995, 0.09}}, {9, {0.4, 0.1}}}, true},
        {{{40, {1, 0.2885}}, {1000, {0.1005, 0.09}}, {9, {0.4, 0.1}}}, false},
        {{{40, {1, 0.2885}}, {1000, {0.8005, 0.7}}, {9, {0.4, 0.1}}}, true},
        {{{40, {1, 0.2885}}, {1000, {0.7995, 0.7}}, {9, {0.4, 0.1}}}, false},
        /* nothing elsewhere: by the times, 1 to 4 */
        {{{40, {1, 0.2885}}, {1000, {0, 0}}}, true},
        {{{40, {1, 0.2865}}, {1000, {0, 0}}}, false},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        if (is_found(cases[i].kinds, 4) != cases[i].is_found) {
            printf("case %zu\n", i);
        }
        CHECK(is_found(cases[i].kinds, 4) == cases[i].is_found);
    }
}

/*
 * The same in frames that are moved against each other: what the shorter one does not have, or has
 * elsewhere, is dark and would hide the pile.
 */
static void test_piles_moved(void)
{
    enum { SIDE = 40, RIGHT = 3, DOWN = -2 };
    for (int way = -1; way <= 1; way += 2) {
        struct tone_frame frames[2];
        float *values[2];
        for (int f = 0; f < 2; f++) {
            values[f] = ARENA_ARRAY(arena, (size_t)3 * SIDE * SIDE, float);
            frames[f] = (struct tone_frame){.name = "x",
                                            .width = SIDE,
                                            .height = SIDE,
                                            .values = values[f],
                                            .time = f == 0 ? 4 : 1};
        }
        /* what lies at (x, y) of the longer one lies at (x + right, y + down) of the shorter one */
        const int right = way * RIGHT, down = way * DOWN;
        for (int i = 0; i < SIDE * SIDE; i++) {
            const int x = i % SIDE, y = i / SIDE, there = SIDE * (y + down) + x + right;
            const bool is_full = (7 * x + 11 * y) % 13 < 4;
            const bool is_both =
                x + right >= 0 && x + right < SIDE && y + down >= 0 && y + down < SIDE;
            values[0][3 * i + 1] = is_full ? 1 : 0.4F;
            if (is_both) {
                values[1][3 * there + 1] = is_full ? 0.2885F : 0.1F;
            }
        }
        frames[0].right = 5;
        frames[0].down = -7;
        frames[1].right = 5 + right;
        frames[1].down = -7 + down;
        struct saturation_found found;
        saturation_find(frames, 2, arena, &found);
        CHECK(found.is_found[1]);
    }
}

/* A channel that is full is known by its own sum of colours, each with its half step. */
static void test_mixed(void)
{
    static const char *const text = "0.9 0.3 -0.1 0.2 0.7 0.1 0 0.1 1.3";
    static const double fill[3][3] = {{0.9, 0.3, -0.1}, {0.2, 0.7, 0.1}, {0, 0.1, 1.3}};
    uint8_t bytes[3 * 60];
    for (size_t i = 0; i < sizeof bytes; i++) {
        bytes[i] = (uint8_t)(180 + i * 37 % 73);
    }
    struct saturation saturation;
    struct tone_frame frame = frame_of(bytes, 60, 1, 1);
    frame.bytes = bytes;
    CHECK(saturation_read(text, &saturation, &error));
    saturation_apply(&frame, &saturation, arena);
    size_t between = 0, full = 0;
    for (size_t i = 0; i < 60; i++) {
        double most = 0; /* all channels have a part in all colours */
        for (int j = 0; j < 3; j++) {
            double sum = 0;
            for (int k = 0; k < 3; k++) {
                const unsigned code = bytes[3 * i + (size_t)k];
                sum += fill[j][k] * light_of(code) + fabs(fill[j][k]) * code / (255.0 * 255);
            }
            most = fmax(most, sum);
        }
        const double trust = fmax(0, fmin(1, (1 - most) / 0.1));
        for (size_t k = 0; k < 3; k++) {
            CHECK_NEAR(frame.trust[3 * i + k], floor(255 * trust + 1e-4), 1, "by the fullest");
            full += trust == 0;
        }
        between += trust > 0 && trust < 1;
    }
    CHECK(between > 5 && frame.full == full && full > 0);
}

/* A part of a channel in a colour that is rounding, beside its largest, is none. */
static void test_rounding_parts(void)
{
    uint8_t bytes[] = {100, 255, 100};
    struct saturation saturation;
    struct tone_frame frame = frame_of(bytes, 1, 1, 1);
    frame.bytes = bytes;
    CHECK(saturation_read("1e-4 1e-12 0 0 1e-4 0 0 0 1e-4", &saturation, &error));
    saturation_apply(&frame, &saturation, arena);
    CHECK(frame.trust[0] == TRUST_MOST && frame.trust[1] == 0 && frame.trust[2] == TRUST_MOST);
    CHECK(saturation_read("1e-4 1e-9 0 0 1e-4 0 0 0 1e-4", &saturation, &error));
    saturation_apply(&frame, &saturation, arena);
    CHECK(frame.trust[0] == 0 && frame.trust[1] == 0 && frame.trust[2] == TRUST_MOST);
    /* rows, or columns, that are nearly one tell no channels apart */
    CHECK(saturation_read("1e-4 0 0 0 1e-4 0 0 0 1e-4", &saturation, &error));
    CHECK(saturation_read("1e4 0 0 0 1e4 0 0 0 1e4", &saturation, &error));
    CHECK(!saturation_read("1e4 1e4 0 1e4 10000.001 0 0 0 1e4", &saturation, &error));
    CHECK(saturation_read("1e4 1e4 0 1e4 10000.1 0 0 0 1e4", &saturation, &error));
    CHECK(!saturation_read("0 0 0 0 1 0 0 0 1", &saturation, &error));
}

int main(void)
{
    test_wide();
    test_trust();
    test_apart();
    test_apart_kept();
    test_looked();
    test_piles();
    test_piles_moved();
    test_mixed();
    test_rounding_parts();
    arena_free(arena);
    return check_report();
}
