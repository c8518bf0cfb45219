/* tone/saturation.c - where a frame's sensor was full, below the highest number of its file. */
/* SPDX-License-Identifier: MIT */
#include "tone/saturation.h"

#include "base/number.h"
#include "base/text.h"

#include <math.h>
#include <string.h>

enum { NUMBERS = FRAME_CHANNELS * FRAME_CHANNELS };

/* From here on trust ends, as a share of full. */
static const double TRUSTED = 0.9;

/* Less of a row's largest number is rounding. */
static const double NOTHING = 1e-6;

/* -------- what a file says -------- */

static double largest_of(const double row[FRAME_CHANNELS])
{
    return fmax(fabs(row[0]), fmax(fabs(row[1]), fabs(row[2])));
}

bool saturation_read(const char *text, struct saturation *saturation, struct error *error)
{
    const char *end = text + strlen(text);
    size_t count = 0;
    for (; count < NUMBERS && text != NULL; count++) {
        double *number = &saturation->fill.at[count / FRAME_CHANNELS][count % FRAME_CHANNELS];
        text += strspn(text, " ");
        text = number_read(text, end, NUMBER_UNSCALED, number);
        if (text == NULL || !isfinite(*number)) {
            break;
        }
    }
    double scale = 1;
    for (size_t j = 0; j < FRAME_CHANNELS && count == NUMBERS; j++) {
        scale *= largest_of(saturation->fill.at[j]);
    }
    const double *a = saturation->fill.at[0], *b = saturation->fill.at[1],
                 *c = saturation->fill.at[2];
    if (count == NUMBERS && *text == '\0' && scale > 0) {
        const double determinant = a[0] * (b[1] * c[2] - b[2] * c[1]) -
                                   a[1] * (b[0] * c[2] - b[2] * c[0]) +
                                   a[2] * (b[0] * c[1] - b[1] * c[0]);
        if (fabs(determinant) > NOTHING * scale) {
            return true;
        }
    }
    return fail(error, ERROR_DATA,
                "what it says of saturation is not three rows of numbers that "
                "tell three channels apart");
}

/* -------- trust -------- */

/* Which colours each channel has a part in, and it in them. */
struct mixture {
    struct colour_matrix fill;
    bool has_part[FRAME_CHANNELS][FRAME_CHANNELS]; /* channel j in colour k */
    bool is_seen[FRAME_CHANNELS][FRAME_CHANNELS];  /* colour k by channel j, with more than 0 */
};

/* What a channel may have of a full pixel at most. */
static double saturation_most_of(const struct mixture *mixture, size_t j,
                                 const struct tone_frame *frame, size_t first)
{
    double sum = 0;
    for (size_t k = 0; k < FRAME_CHANNELS; k++) {
        const double part = mixture->fill.at[j][k];
        const struct frame_level level = frame_level_at(frame, first + k);
        const double half = 0.5 * sqrt(12 * (double)level.spread);
        if (mixture->is_seen[j][k] && frame_is_full(frame, first + k)) {
            return (double)INFINITY;
        }
        sum += part * (double)level.light + fabs(part) * half;
    }
    return sum;
}

static uint8_t trust_of(double fill)
{
    const double trust = fmax(0, fmin(1, (1 - fill) / (1 - TRUSTED)));
    return (uint8_t)(TRUST_MOST * trust);
}

static void saturation_count_full(struct tone_frame *frame)
{
    frame->full = 0;
    for (size_t i = 0; i < frame->width * frame->height * FRAME_CHANNELS; i++) {
        frame->full += frame_is_full(frame, i);
    }
}

void saturation_apply(struct tone_frame *frame, const struct saturation *saturation,
                      struct arena *arena)
{
    const size_t pixels = frame->width * frame->height;
    struct mixture mixture = {.fill = saturation->fill};
    const struct colour_matrix back = colour_inverse(&saturation->fill);
    for (size_t j = 0; j < FRAME_CHANNELS; j++) {
        for (size_t k = 0; k < FRAME_CHANNELS; k++) {
            mixture.has_part[j][k] = fabs(back.at[k][j]) > NOTHING * largest_of(back.at[k]);
            mixture.is_seen[j][k] =
                mixture.fill.at[j][k] > NOTHING * largest_of(mixture.fill.at[j]);
        }
    }
    uint8_t *trust = ARENA_ARRAY(arena, pixels * FRAME_CHANNELS, uint8_t);
    for (size_t i = 0; i < pixels * FRAME_CHANNELS; i += FRAME_CHANNELS) {
        double fill[FRAME_CHANNELS];
        for (size_t j = 0; j < FRAME_CHANNELS; j++) {
            fill[j] = saturation_most_of(&mixture, j, frame, i);
        }
        for (size_t k = 0; k < FRAME_CHANNELS; k++) {
            double most = 0;
            for (size_t j = 0; j < FRAME_CHANNELS; j++) {
                most = mixture.has_part[j][k] ? fmax(most, fill[j]) : most;
            }
            trust[i + k] = trust_of(most);
        }
    }
    frame->trust = trust;
    saturation_count_full(frame);
}

/* -------- what frames show -------- */

static float saturation_light_at(const struct tone_frame *frame, size_t i)
{
    return frame_level_at(frame, i).light;
}

/* Shared by many: so many pixels, and such a share; and that many times as many as just below. */
enum { SHARED_LEAST = 32, PILE_LEAST = 4 };
static const double SHARE_LEAST = 1e-3, NEAR = 0.99, BELOW = 0.96;

/* The shorter frame shows so many times the light that it shows elsewhere. */
static const double MORE_LEAST = 1.15;

/* A channel of a frame, and what piles up at its end. */
struct pile {
    float top;
    size_t shared, below;
};

static struct pile pile_of(const struct tone_frame *frame, size_t channel)
{
    const size_t end = frame->width * frame->height * FRAME_CHANNELS;
    struct pile pile = {0};
    for (size_t i = channel; i < end; i += FRAME_CHANNELS) {
        pile.top = fmaxf(pile.top, saturation_light_at(frame, i));
    }
    for (size_t i = channel; i < end; i += FRAME_CHANNELS) {
        const double share = (double)saturation_light_at(frame, i) / (double)pile.top;
        pile.shared += share >= NEAR;
        pile.below += share >= BELOW && share < NEAR;
    }
    return pile;
}

static bool is_pile(const struct pile *pile, const struct tone_frame *frame)
{
    const double pixels = (double)(frame->width * frame->height);
    return pile->top > 0 && pile->shared >= SHARED_LEAST &&
           (double)pile->shared >= SHARE_LEAST * pixels && pile->shared >= PILE_LEAST * pile->below;
}

/* Where the same pixel lies in another frame; false: it has none. */
static bool place_in(const struct tone_frame *from, const struct tone_frame *to, size_t pixel,
                     size_t *found)
{
    const long row = (long)(pixel / from->width) - from->down + to->down;
    const long column = (long)(pixel % from->width) - from->right + to->right;
    *found = (size_t)row * to->width + (size_t)column;
    return row >= 0 && column >= 0 && row < (long)to->height && column < (long)to->width;
}

/* Does the shorter frame show more light where this one has its highest than elsewhere? */
static bool shows_more(const struct tone_frame *frame, const struct tone_frame *shorter,
                       size_t channel, float top)
{
    double own[2] = {0}, other[2] = {0}; /* elsewhere, and there */
    size_t place;
    for (size_t pixel = 0; pixel < frame->width * frame->height; pixel++) {
        const float light = saturation_light_at(frame, pixel * FRAME_CHANNELS + channel);
        const bool is_there = (double)light >= NEAR * (double)top;
        const bool is_elsewhere = light > 0.1F * top && light < 0.8F * top;
        if ((is_there || is_elsewhere) && place_in(frame, shorter, pixel, &place)) {
            own[is_there] += (double)light;
            other[is_there] +=
                (double)saturation_light_at(shorter, place * FRAME_CHANNELS + channel);
        }
    }
    const double elsewhere = own[0] > 0 ? other[0] / own[0] : shorter->time / frame->time;
    return own[1] > 0 && other[1] / own[1] > MORE_LEAST * elsewhere;
}

/* Trust a channel up to a light that all frames of the bracket have where they are full. */
static void distrust(struct tone_frame *frame, size_t channel, float full, struct arena *arena)
{
    const size_t end = frame->width * frame->height * FRAME_CHANNELS;
    uint8_t *trust = ARENA_ARRAY(arena, end, uint8_t);
    for (size_t i = 0; i < end; i++) {
        trust[i] = frame->trust != NULL ? frame->trust[i] : TRUST_MOST;
        trust[i] = i % FRAME_CHANNELS == channel
                       ? trust_of((double)saturation_light_at(frame, i) / (double)full)
                       : trust[i];
    }
    frame->trust = trust;
    saturation_count_full(frame);
}

static void find_channel(struct tone_frame *const *frames, size_t count, size_t channel,
                         struct saturation_found *found)
{
    for (size_t f = 0; f + 1 < count && !found->is_found[channel]; f++) {
        const struct tone_frame *frame = frames[f];
        const struct pile pile = pile_of(frame, channel);
        const bool is_below_end =
            frame->bits == 0 ||
            pile.top < frame->levels[channel][frame_levels(frame->bits) - 1].light;
        if (is_below_end && is_pile(&pile, frame) &&
            shows_more(frame, frames[f + 1], channel, pile.top)) {
            found->is_found[channel] = true;
            found->light[channel] = pile.top;
            const double share = (double)pile.shared / (double)(frame->width * frame->height);
            found->name = share > found->share ? frame->name : found->name;
            found->share = fmax(share, found->share);
        }
    }
}

void saturation_find(struct tone_frame *frames, size_t count, struct arena *arena,
                     struct saturation_found *found)
{
    size_t order[FRAMES_MOST], silent = 0;
    struct tone_frame *those[FRAMES_MOST];
    *found = (struct saturation_found){.name = NULL};
    frames_order(frames, count, order);
    for (size_t f = 0; f < count; f++) {
        if (frames[order[f]].trust == NULL) {
            those[silent++] = &frames[order[f]];
        }
    }
    for (size_t k = 0; k < FRAME_CHANNELS; k++) {
        find_channel(those, silent, k, found);
    }
    for (size_t f = 0; f < silent; f++) {
        for (size_t k = 0; k < FRAME_CHANNELS; k++) {
            if (found->is_found[k]) {
                distrust(those[f], k, (float)NEAR * found->light[k], arena);
            }
        }
    }
}
