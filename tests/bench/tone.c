/* tests/bench/tone.c - three frames of 24 megapixels merged and shown. */
/* SPDX-License-Identifier: MIT */
#include "clock.h"
#include "tone/align.h"
#include "tone/merge.h"
#include "tone/operator.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/resource.h>

/*
 * Prints one figure a line, "name value": seconds of the processor, on one thread, of what lenscalc
 * tone does with decoded frames of 8 bits, and the most memory it took as a multiple of the picture
 * of floats that it makes, the frames' own numbers among it.
 */
enum { WIDTH = 6000, HEIGHT = 4000, FRAMES = 3, CHANNELS = 3 };

static void stop(const struct error *error)
{
    fprintf(stderr, "tone: %s\n", error->message);
    exit(1);
}

/* Light of eight octaves, wavy, and what is exposed of it for a time. */
static void expose(struct tone_frame *frame, double time, const double *light, struct arena *arena)
{
    uint8_t *bytes = ARENA_ARRAY(arena, (size_t)WIDTH * HEIGHT * CHANNELS, uint8_t);
    double across[WIDTH];
    for (size_t x = 0; x < WIDTH; x++) {
        across[x] = exp2(8.0 * (double)x / WIDTH - 6) * (1 + 0.3 * sin(0.05 * (double)x));
    }
    for (size_t y = 0; y < HEIGHT; y++) {
        const double down = time * (0.5 + 0.4 * cos(0.03 * (double)y));
        for (size_t x = 0; x < WIDTH; x++) {
            const double code = 255 * sqrt(fmin(1, down * across[x]));
            for (size_t k = 0; k < CHANNELS; k++) {
                bytes[(y * WIDTH + x) * CHANNELS + k] =
                    (uint8_t)(code * (1 - 0.1 * (double)k) + 0.5);
            }
        }
    }
    *frame = (struct tone_frame){
        .width = WIDTH, .height = HEIGHT, .bits = 8, .bytes = bytes, .time = time};
    for (size_t k = 0; k < CHANNELS; k++) {
        frame->levels[k] = frame_levels_of(light, FRAME_LEVELS, arena);
    }
}

int main(void)
{
    struct arena arena = {0};
    struct tone_frame frames[FRAMES];
    struct align_step steps[FRAMES];
    const struct merge_noise noise = {20000, 5};
    const struct tone_way way = {
        .operation = TONE_WARD, .white = NAN, .gamma = 2.2, .display = {1, 100}};
    double light[FRAME_LEVELS];
    struct merged merged;
    struct toned toned;
    struct error error;
    struct rusage usage;
    for (int z = 0; z < FRAME_LEVELS; z++) {
        light[z] = z / 255.0 * (z / 255.0);
    }
    for (int i = 0; i < FRAMES; i++) {
        expose(&frames[i], exp2(-2 * i), light, &arena);
    }
    const double began = processor_time();
    align_frames(frames, FRAMES, steps);
    const double aligned = processor_time();
    if (!merge_frames(frames, FRAMES, &noise, &arena, &merged, &error)) {
        stop(&error);
    }
    const double made = processor_time();
    const struct foveal foveal = foveal_look(&merged.image, 0.785, &arena);
    if (!tone_show(&way, &foveal, &merged.image, &arena, &toned, &error)) {
        stop(&error);
    }
    const double shown = processor_time();
    getrusage(RUSAGE_SELF, &usage);
    printf("all %.9g\naligned %.9g\nmerged %.9g\nshown %.9g\nmemory %.9g\n", shown - began,
           aligned - began, made - aligned, shown - made,
           1024.0 * (double)usage.ru_maxrss / ((double)WIDTH * HEIGHT * CHANNELS * sizeof(float)));
    arena_free(&arena);
    return 0;
}
