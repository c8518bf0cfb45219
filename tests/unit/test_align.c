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

int main(void)
{
    test_align();
    test_align_rounds();
    test_align_far();
    arena_free(arena);
    return check_report();
}
