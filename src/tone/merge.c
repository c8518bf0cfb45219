/* tone/merge.c - the exposures of a bracket as one picture of light. */
/* SPDX-License-Identifier: MIT */
#include "tone/merge.h"

#include <math.h>
#include <string.h>

/* Values at once: a stretch of a row, three a pixel; constant, so that loops become vectors. */
enum { STRETCH = 384, LOOK_MOST = 1 << 20 };

/* Frames differ where green does by so many standard deviations and such a share. */
static const float DEVIATIONS = 6, SHARE = 0.02F;

/* A frame's values of a stretch. */
struct merge_stretch {
    float light[STRETCH], keep[STRETCH], spread[STRETCH];
};

/* A frame's part in the sums. */
struct merge_part {
    float time, fixed, photon; /* s; variance in the dark, and of light 1 */
};

struct merge_sums {
    float first[STRETCH], first_time[STRETCH]; /* keep v, keep t */
    float above[STRETCH], below[STRETCH];      /* w v/t, w; both over t */
};

/* What a picture is merged from. */
struct merge_job {
    const struct tone_frame *frames;
    size_t count;
    const size_t *order; /* the longest first */
    struct merge_part parts[FRAMES_MOST];
    struct merged *merged;
    size_t look; /* rows from one that is looked at to the next */
};

/* A part of the picture: so many pixels from a column on in a row. */
struct merge_place {
    size_t row, column, pixels;
};

/* The pixels of a place that the frame has: from..to, of which the first is its pixel `at`. */
static void merge_overlap(const struct tone_frame *frame, const struct merge_place *place,
                          size_t *from, size_t *to, size_t *at)
{
    const long row = (long)place->row + frame->down, left = (long)place->column + frame->right;
    const long begin = left < 0 ? -left : 0, room = (long)frame->width - left;
    const long end = room < (long)place->pixels ? room : (long)place->pixels;
    const bool is_there = row >= 0 && row < (long)frame->height && begin < end;
    *from = is_there ? (size_t)begin : place->pixels;
    *to = is_there ? (size_t)end : place->pixels;
    *at = is_there ? (size_t)row * frame->width + (size_t)(left + begin) : 0;
}

static void merge_put(struct merge_stretch *stretch, size_t i, const struct frame_level *level)
{
    stretch->light[i] = level->light;
    stretch->keep[i] = level->keep;
    stretch->spread[i] = level->spread;
}

/* What a frame has there; where it has nothing, nothing is kept. */
static void fetch(const struct tone_frame *frame, const struct merge_place *place,
                  struct merge_stretch *stretch)
{
    size_t from, to, at;
    merge_overlap(frame, place, &from, &to, &at);
    if (from > 0 || to < STRETCH / FRAME_CHANNELS) {
        memset(stretch, 0, sizeof *stretch);
    }
    const size_t first = at * FRAME_CHANNELS;
    for (size_t i = FRAME_CHANNELS * from, j = first; i < FRAME_CHANNELS * to;
         i += FRAME_CHANNELS, j += FRAME_CHANNELS) {
        for (size_t k = 0; k < FRAME_CHANNELS; k++) {
            if (frame->bytes != NULL) {
                merge_put(stretch, i + k, &frame->levels[k][frame->bytes[j + k]]);
            } else if (frame->codes != NULL) {
                merge_put(stretch, i + k, &frame->levels[k][frame->codes[j + k]]);
            } else {
                merge_put(stretch, i + k, &(struct frame_level){frame->values[j + k], 1, 0});
            }
        }
        for (size_t k = 0; frame->trust != NULL && k < FRAME_CHANNELS; k++) {
            stretch->keep[i + k] *= (float)frame->trust[j + k] / TRUST_MOST;
        }
    }
}

/* There what the shortest has of those that have the pixel, which is too little. */
static void fill_full(const struct merge_job *merging, const struct merge_place *place,
                      struct merge_sums *sums)
{
    struct merge_stretch stretch;
    for (size_t f = merging->count; f-- > 0;) {
        const struct tone_frame *frame = &merging->frames[merging->order[f]];
        size_t from, to, at;
        merge_overlap(frame, place, &from, &to, &at);
        fetch(frame, place, &stretch);
        for (size_t k = FRAME_CHANNELS * from; k < FRAME_CHANNELS * to; k++) {
            if (!(sums->below[k] > 0)) {
                sums->above[k] = stretch.light[k];
                sums->below[k] = (float)frame->time;
            }
        }
    }
}

/* Does a frame say something else than the mean? Green, the middle one of each three. */
static void merge_look(const struct merge_job *merging, const struct merge_place *place,
                       const struct merge_sums *sums)
{
    struct merge_stretch stretch;
    bool apart[STRETCH / FRAME_CHANNELS] = {false};
    for (size_t f = 0; f < merging->count; f++) {
        const struct merge_part *part = &merging->parts[f];
        fetch(&merging->frames[f], place, &stretch);
        for (size_t i = 0; i < place->pixels; i++) {
            const size_t k = FRAME_CHANNELS * i + 1;
            const float mean = sums->above[k] / sums->below[k] * part->time;
            const float variance = stretch.spread[k] + part->fixed + part->photon * fmaxf(mean, 0);
            const float off = fabsf(stretch.light[k] - mean);
            apart[i] = apart[i] || (stretch.keep[k] > 0.5F &&
                                    off > DEVIATIONS * sqrtf(variance) + SHARE * mean);
        }
    }
    merging->merged->looked += place->pixels;
    for (size_t i = 0; i < place->pixels; i++) {
        merging->merged->apart += apart[i];
    }
}

static void merge_place(const struct merge_job *merging, const struct merge_place *place)
{
    struct merge_stretch stretch;
    struct merge_sums sums = {.first = {0}};
    for (size_t f = 0; f < merging->count; f++) {
        fetch(&merging->frames[f], place, &stretch);
        for (int i = 0; i < STRETCH; i++) {
            sums.first[i] += stretch.keep[i] * stretch.light[i];
            sums.first_time[i] += stretch.keep[i] * merging->parts[f].time;
        }
    }
    /* the mean where the weights do not follow the noise; 0 where nothing is kept */
    for (int i = 0; i < STRETCH; i++) {
        const float mean = sums.first[i] / (sums.first_time[i] > 0 ? sums.first_time[i] : 1);
        sums.first[i] = mean > 0 ? mean : 0;
    }
    for (size_t f = 0; f < merging->count; f++) {
        if (merging->count > 1) {
            fetch(&merging->frames[f], place, &stretch);
        }
        /* w v/t = keep t v/var, w = keep t^2/var: both over t */
        const struct merge_part *part = &merging->parts[f];
        const float photon = part->photon * part->time;
        for (int i = 0; i < STRETCH; i++) {
            const float variance = stretch.spread[i] + part->fixed + photon * sums.first[i];
            const float weight = stretch.keep[i] * part->time / variance;
            sums.above[i] += weight * stretch.light[i];
            sums.below[i] += weight * part->time;
        }
    }
    /* where no frame keeps anything; counted as pixels and as values */
    const size_t before = merging->merged->full;
    for (size_t i = 0; i < place->pixels; i++) {
        size_t full = 0;
        for (size_t k = FRAME_CHANNELS * i; k < FRAME_CHANNELS * (i + 1); k++) {
            full += sums.below[k] > 0 ? 0 : 1;
        }
        merging->merged->full += full;
        merging->merged->saturated += full > 0;
    }
    if (merging->merged->full > before) {
        fill_full(merging, place, &sums);
    }
    if (merging->count > 1 && place->row % merging->look == 0) {
        merge_look(merging, place, &sums);
    }
    float *to = image_row(&merging->merged->image, place->row) + place->column * FRAME_CHANNELS;
    for (size_t i = 0; i < FRAME_CHANNELS * place->pixels; i++) {
        to[i] = sums.above[i] / sums.below[i];
    }
}

bool merge_frames(const struct tone_frame *frames, size_t count, const struct merge_noise *noise,
                  struct arena *arena, struct merged *merged, struct error *error)
{
    size_t order[FRAMES_MOST];
    struct merge_job merging = {.frames = frames, .count = count, .order = order, .merged = merged};
    *merged = (struct merged){.image = {.width = frames->width,
                                        .height = frames->height,
                                        .channels = FRAME_CHANNELS,
                                        .aspect = frames->aspect}};
    if (!image_new(&merged->image, arena, error)) {
        return false;
    }
    const size_t width = frames->width, height = frames->height;
    frames_order(frames, count, order);
    for (size_t f = 0; f < merging.count; f++) {
        const struct tone_frame *frame = &merging.frames[f];
        const double read = noise->read_noise / noise->full_well;
        /* of floats the variance is some number times the mean: weights by time */
        merging.parts[f] = frame->bits == 0
                               ? (struct merge_part){(float)frame->time, (float)frame->time, 0}
                               : (struct merge_part){(float)frame->time, (float)(read * read),
                                                     (float)(1 / noise->full_well)};
    }
    merging.look = width * height / LOOK_MOST + 1;
    for (size_t row = 0; row < height; row++) {
        for (size_t column = 0; column < width; column += STRETCH / FRAME_CHANNELS) {
            const size_t rest = width - column, most = STRETCH / FRAME_CHANNELS;
            merge_place(&merging, &(struct merge_place){row, column, rest < most ? rest : most});
        }
    }
    return merged->full < FRAME_CHANNELS * width * height ||
           fail(error, ERROR_DOMAIN,
                "every pixel is saturated%s: there is no light to be told from",
                count > 1 ? " in every frame" : "");
}
