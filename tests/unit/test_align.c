/* tests/unit/test_align.c - how far a camera has moved, by pictures that are moved. */
/* SPDX-License-Identifier: MIT */
#include "base/constants.h"
#include "tone/align.h"
#include "tone_frames.h"

/* Frames of floats are aligned by the order of their pixels; nothing is told of even ones. */
static void test_align(void)
{
    enum { SIDE = 64 };
    float first[SIDE * SIDE * 3], second[SIDE * SIDE * 3];
    struct align_step steps[2];
    for (int i = 0; i < SIDE * SIDE * 3; i++) {
        const int x = i / 3 % SIDE, y = i / 3 / SIDE;
        first[i] = (float)(1.2 + sin(x * 0.31) * cos(y * 0.23) + 0.1 * sin(0.7 * x + 0.4 * y));
        second[i] = (float)(0.25 * (1.2 + sin((x - 3) * 0.31) * cos((y + 2) * 0.23) +
                                    0.1 * sin(0.7 * (x - 3) + 0.4 * (y + 2))));
    }
    struct tone_frame frames[] = {
        {.name = "a", .width = SIDE, .height = SIDE, .values = first, .time = 4},
        {.name = "b", .width = SIDE, .height = SIDE, .values = second, .time = 1}};
    align_frames(frames, 2, steps);
    CHECK(frames[0].right == 0 && frames[0].down == 0);
    CHECK(frames[1].right == 3 && frames[1].down == -2);
    CHECK(steps[1].is_told && steps[1].now < 0.5 * steps[1].before);
    for (int i = 0; i < SIDE * SIDE * 3; i++) {
        const int x = i / 3 % SIDE, y = i / 3 / SIDE - 32; /* a hill, further on than is looked */
        first[i] = (float)exp(-((x - 22) * (x - 22) + y * y) / 300.0);
        second[i] = (float)exp(-((x - 42) * (x - 42) + y * y) / 300.0);
    }
    align_frames(frames, 2, steps);
    CHECK(steps[1].is_beyond && frames[1].right == 0 && frames[1].down == 0);
    for (int i = 0; i < SIDE * SIDE * 3; i++) {
        first[i] = second[i] = 1;
    }
    align_frames(frames, 2, steps);
    CHECK(frames[1].right == 0 && frames[1].down == 0 && !steps[1].is_told);
}

/*
 * Squares of 2 x 2 pixels of 104 and 105 are 105 when halved, clear of the median of 100, as their
 * mean of 104.5 is rounded; cut off they would be 104, and nothing of the halved picture would tell
 * of a shift by 2 pixels.
 */
static void test_align_rounds(void)
{
    enum { SIDE = 48, ROOM = 4, CELLS = (SIDE + ROOM) / 2 };
    uint8_t cell[CELLS][CELLS], first[SIDE * SIDE], second[SIDE * SIDE];
    struct align_step steps[2];
    uint32_t word = 1;
    for (int i = 0; i < CELLS * CELLS; i++) {
        word = word * 1664525U + 1013904223U;
        cell[i / CELLS][i % CELLS] = (uint8_t)((word >> 24) % 5);
    }
    for (int i = 0; i < SIDE * SIDE; i++) {
        const int x = i % SIDE, y = i / SIDE;
        for (int shift = 0; shift < 2; shift++) {
            const int kind = cell[y / 2][(x + 2 * shift) / 2];
            const int bright = x % 2 == y % 2 ? 104 : 105;
            (shift == 0 ? first : second)[i] = (uint8_t)(kind < 2 ? bright : kind < 4 ? 90 : 100);
        }
    }
    struct tone_frame frames[] = {frame_of(first, SIDE, SIDE, 1), frame_of(second, SIDE, SIDE, 1)};
    align_frames(frames, 2, steps);
    CHECK(frames[1].right == -2 && frames[1].down == 0 && steps[1].is_told);
}

/*
 * A disc over half of the picture, 20 shades a pixel steep at its edge, since what is within 4 of
 * the median is left out; with its middle moved by half of the shift each way. 126 pixels are
 * found, to the pixel, and 127, the sum of 1, 2, 4 .. 64, may as well be more.
 */
static void test_align_far(void)
{
    enum { SIDE = 2048 };
    static const int shifts[][2] = {{126, -126}, {-127, 0}};
    uint8_t *greys[2] = {ARENA_ARRAY(arena, SIDE * SIDE, uint8_t),
                         ARENA_ARRAY(arena, SIDE * SIDE, uint8_t)};
    const double radius = SIDE / sqrt(2 * PI), middle = (SIDE - 1) / 2.0, steep = 20;
    for (size_t k = 0; k < sizeof shifts / sizeof *shifts; k++) {
        struct align_step steps[2];
        for (int i = 0; i < SIDE * SIDE; i++) {
            const int column = i % SIDE, row = i / SIDE;
            for (int f = 0; f < 2; f++) {
                const double x = column - middle + (0.5 - f) * shifts[k][0];
                const double y = row - middle + (0.5 - f) * shifts[k][1];
                const double grey = 125 + steep * (radius - sqrt(x * x + y * y));
                greys[f][i] = (uint8_t)fmin(fmax(grey, 40), 210);
            }
        }
        struct tone_frame frames[] = {frame_of(greys[0], SIDE, SIDE, 1),
                                      frame_of(greys[1], SIDE, SIDE, 1)};
        align_frames(frames, 2, steps);
        CHECK(steps[1].limit == 127 && steps[1].is_told && steps[1].is_beyond == (k > 0));
        CHECK(frames[1].right == (k == 0 ? shifts[k][0] : 0));
        CHECK(frames[1].down == (k == 0 ? shifts[k][1] : 0));
    }
}

/* -------- too small to be halved: a shift by one pixel is seen, and may be more -------- */

enum { SMALL = 24, SMALL_PIXELS = SMALL * SMALL };

static uint32_t word = 1;

static unsigned random_below(unsigned count)
{
    word = word * 1664525U + 1013904223U;
    return (word >> 16) % count;
}

/* Greys of a picture and of the same one pixel further left; is the shift seen? */
static bool is_shift_seen(uint8_t greys[][SMALL + 1], struct align_step *step)
{
    uint8_t first[SMALL_PIXELS], second[SMALL_PIXELS];
    struct align_step steps[2];
    for (int i = 0; i < SMALL_PIXELS; i++) {
        first[i] = greys[i / SMALL][i % SMALL];
        second[i] = greys[i / SMALL][i % SMALL + 1];
    }
    struct tone_frame frames[] = {frame_of(first, SMALL, SMALL, 1),
                                  frame_of(second, SMALL, SMALL, 1)};
    align_frames(frames, 2, steps);
    CHECK(frames[1].right == 0 && frames[1].down == 0);
    CHECK(steps[1].limit == 1 || !steps[1].is_told);
    *step = steps[1];
    return steps[1].is_beyond;
}

/*
 * [Ward03]: the grey that is compared is 54/256 of red, 183 of green and 19 of blue, what is cut
 * off left out, and what lies within 4 of the median is not looked at. Of a median of 100 and of
 * dark pixels, bright ones of 105 show a shift; those whose sum is one less do not.
 */
static void test_align_grey(void)
{
    static const unsigned weight[3] = {54, 183, 19};
    uint8_t kinds[SMALL][SMALL + 1];
    for (int i = 0; i < SMALL * (SMALL + 1); i++) {
        kinds[i / (SMALL + 1)][i % (SMALL + 1)] = (uint8_t)random_below(5);
    }
    for (unsigned below = 0; below < 2; below++) {
        const unsigned sum = 105 * 256 - below;
        size_t found = 0;
        for (unsigned red = 0; red < 256; red += 5) {
            for (unsigned green = 0; green < 256; green++) {
                const unsigned rest = sum - weight[0] * red - weight[1] * green;
                if (weight[0] * red + weight[1] * green > sum || rest % weight[2] != 0 ||
                    rest / weight[2] > 255) {
                    continue;
                }
                const uint8_t bright[3] = {(uint8_t)red, (uint8_t)green,
                                           (uint8_t)(rest / weight[2])};
                uint8_t bytes[2][3 * SMALL_PIXELS];
                struct align_step steps[2];
                for (int i = 0; i < 3 * SMALL_PIXELS; i++) {
                    for (int shift = 0; shift < 2; shift++) {
                        const int kind = kinds[i / 3 / SMALL][i / 3 % SMALL + shift];
                        const uint8_t dull = kind < 4 ? 90 : 100;
                        bytes[shift][i] = kind < 2 ? bright[i % 3] : dull;
                    }
                }
                struct tone_frame frames[2];
                for (int f = 0; f < 2; f++) {
                    frames[f] = (struct tone_frame){.name = "x",
                                                    .width = SMALL,
                                                    .height = SMALL,
                                                    .bits = 8,
                                                    .bytes = bytes[f],
                                                    .time = 1};
                }
                align_frames(frames, 2, steps);
                CHECK(steps[1].is_beyond == (below == 0));
                found++;
            }
        }
        CHECK(found > 20);
    }
}

/*
 * Light has 48 shades an octave: beside a median of 1 what is 5 shades brighter shows a shift, and
 * what is a little less than that does not.
 */
static void test_align_octaves(void)
{
    static const double shades[] = {5.05, 4.95, -4.05, -3.95};
    uint8_t kinds[SMALL][SMALL + 1];
    for (int i = 0; i < SMALL * (SMALL + 1); i++) {
        kinds[i / (SMALL + 1)][i % (SMALL + 1)] = (uint8_t)random_below(5);
    }
    for (int s = 0; s < 4; s++) {
        static float light[2][3 * SMALL_PIXELS];
        const float other = s < 2 ? 0.5F : 2, value = (float)exp2(shades[s] / 48);
        struct tone_frame frames[2];
        struct align_step steps[2];
        for (int f = 0; f < 2; f++) {
            for (int i = 0; i < 3 * SMALL_PIXELS; i++) {
                const int kind = kinds[i / 3 / SMALL][i / 3 % SMALL + f];
                const float clear = kind < 2 ? value : other;
                light[f][i] = kind < 4 ? clear : 1;
            }
            frames[f] = (struct tone_frame){
                .name = "x", .width = SMALL, .height = SMALL, .values = light[f], .time = 1};
        }
        align_frames(frames, 2, steps);
        CHECK(steps[1].is_beyond == (s % 2 == 0));
    }
}

/* The first of seven quantiles that is neither black nor white: each where no other one is. */
static void test_align_quantiles(void)
{
    static const double shares[] = {0.5, 0.67, 0.33, 0.83, 0.17, 0.92, 0.08};
    static const struct {
        uint8_t grey;
        bool is_exposed;
    } middles[] = {{100, true}, {10, true}, {9, false}, {245, true}, {246, false}};
    struct align_step step;
    uint8_t greys[SMALL][SMALL + 1];
    for (size_t s = 0; s < sizeof shares / sizeof *shares; s++) {
        for (size_t m = 0; m < sizeof middles / sizeof *middles; m++) {
            const uint8_t grey = middles[m].grey;
            const unsigned from = (unsigned)(1000 * shares[s]) - 25, to = from + 50;
            for (unsigned i = 0; i < SMALL * (SMALL + 1); i++) {
                const unsigned place = i * 7919U % 1000; /* each share of the picture, mixed */
                const uint8_t brighter = place < to ? grey : 255;
                greys[i / (SMALL + 1)][i % (SMALL + 1)] = place < from ? 0 : brighter;
            }
            is_shift_seen(greys, &step);
            CHECK(step.is_told == middles[m].is_exposed);
        }
    }
    for (int black = 0; black < 2; black++) { /* none at all */
        memset(greys, black != 0 ? 0 : 255, sizeof greys);
        CHECK(!is_shift_seen(greys, &step) && !step.is_told);
    }
}

/* Something is told where more than a hundredth of the pixels is clear of the median: 6 of 576. */
static void test_align_seen(void)
{
    for (int count = 5; count <= 6; count++) {
        uint8_t greys[SMALL][SMALL + 1];
        struct align_step step;
        memset(greys, 100, sizeof greys);
        for (int i = 0; i < count; i++) {
            greys[3 * i + 2][7] = greys[3 * i + 2][8] = i % 2 == 0 ? 120 : 80;
        }
        CHECK(!is_shift_seen(greys, &step));
        CHECK(step.is_told == (count > 5));
    }
}

/*
 * A shift is taken if less than four fifths of the pixels differ that do without: of pictures that
 * have more and more of their pixels anew, the last that is taken and the first that is not are
 * close by.
 */
static void test_align_taken(void)
{
    double last = 0, next = 1;
    for (unsigned noise = 0; noise < 1000; noise += 5) {
        uint8_t first[SMALL_PIXELS], second[SMALL_PIXELS];
        struct align_step steps[2];
        word = noise + 1;
        for (int i = 0; i < SMALL_PIXELS; i++) {
            const unsigned kind = random_below(5);
            const uint8_t bright = kind < 2 ? 130 : 70;
            first[i] = kind < 4 ? bright : 100;
        }
        for (int i = 0; i < SMALL_PIXELS; i++) {
            const unsigned kind = random_below(5);
            const uint8_t bright = kind < 2 ? 130 : 70, anew = kind < 4 ? bright : 100;
            const bool is_new = i % SMALL == SMALL - 1 || random_below(1000) < noise;
            second[i] = is_new ? anew : first[i + 1];
        }
        double before = 0, now = 1;
        for (int shift = 0; shift < 9; shift++) {
            const int right = shift % 3 - 1, down = shift / 3 - 1;
            size_t differ = 0, clear = 0;
            for (int i = 0; i < SMALL_PIXELS; i++) {
                const int x = i % SMALL + right, y = i / SMALL + down;
                if (x >= 0 && x < SMALL && y >= 0 && y < SMALL && first[i] != 100 &&
                    second[SMALL * y + x] != 100) {
                    clear++;
                    differ += first[i] != second[SMALL * y + x];
                }
            }
            const double share = (double)differ / (double)clear;
            before = shift == 4 ? share : before;
            now = fmin(now, share);
        }
        struct tone_frame frames[] = {frame_of(first, SMALL, SMALL, 1),
                                      frame_of(second, SMALL, SMALL, 1)};
        align_frames(frames, 2, steps);
        CHECK(steps[1].is_told && frames[1].right == 0 && frames[1].down == 0);
        CHECK_NEAR(steps[1].before, before, 1e-15, "without the shift");
        CHECK(steps[1].now == steps[1].before);
        if (steps[1].is_beyond) {
            last = fmax(last, now / before);
        } else {
            next = fmin(next, now / before);
        }
    }
    CHECK(last > 0.77 && last < 0.8 && next >= 0.8 && next < 0.83);
}

/* Halved while both sides keep 16 pixels: how far a shift may be looked for. */
static void test_align_sizes(void)
{
    static const struct {
        size_t width, height;
        long limit;
    } sizes[] = {{64, 31, 1}, {31, 64, 1}, {64, 8, 1},    {8, 64, 1},
                 {32, 32, 3}, {32, 63, 3}, {80, 1000, 7}, {1000, 80, 7}};
    for (size_t s = 0; s < sizeof sizes / sizeof *sizes; s++) {
        const size_t count = sizes[s].width * sizes[s].height;
        uint8_t *greys = ARENA_ARRAY(arena, count, uint8_t);
        struct align_step steps[2];
        for (size_t i = 0; i < count; i++) {
            greys[i] = (uint8_t)(60 + 130 * random_below(2));
        }
        struct tone_frame frames[] = {frame_of(greys, sizes[s].width, sizes[s].height, 1),
                                      frame_of(greys, sizes[s].width, sizes[s].height, 1)};
        align_frames(frames, 2, steps);
        CHECK(steps[1].is_told && steps[1].limit == sizes[s].limit && steps[1].now == 0);
    }
}

/* All eight neighbours, and three frames in a row: each goes with the one that is next longer. */
static void test_align_ways(void)
{
    enum { SIDE = 64, ROOM = 8, WIDE = SIDE + 2 * ROOM };
    static const double times[] = {1, 4, 2};
    static uint8_t greys[WIDE][WIDE];
    for (int i = 0; i < WIDE * WIDE; i++) {
        const int x = i % WIDE, y = i / WIDE;
        greys[y][x] = (uint8_t)(120 + 50 * sin(x * 0.31) * cos(y * 0.23) + 20 * sin(0.7 * x + y) +
                                random_below(20));
    }
    for (int way = 0; way < 9; way++) {
        const int right = way % 3 - 1, down = way / 3 - 1;
        const int shifts[3][2] = {{0, 0}, {right, down}, {2 * right - 1, 3 * down + 1}};
        struct tone_frame frames[3];
        struct align_step steps[3];
        for (int f = 0; f < 3; f++) {
            uint8_t seen[SIDE * SIDE];
            for (int i = 0; i < SIDE * SIDE; i++) {
                seen[i] = greys[i / SIDE + ROOM - shifts[f][1]][i % SIDE + ROOM - shifts[f][0]];
            }
            frames[f] = frame_of(seen, SIDE, SIDE, times[f]);
        }
        align_frames(frames, 3, steps);
        for (int f = 0; f < 3; f++) {
            CHECK(frames[f].right == shifts[f][0] && frames[f].down == shifts[f][1]);
            CHECK(steps[f].is_told && !steps[f].is_beyond);
        }
        CHECK(steps[1].limit == 0); /* the longest goes with none */
    }
}

int main(void)
{
    test_align();
    test_align_rounds();
    test_align_far();
    test_align_grey();
    test_align_octaves();
    test_align_quantiles();
    test_align_seen();
    test_align_taken();
    test_align_sizes();
    test_align_ways();
    arena_free(arena);
    return check_report();
}
