/* commands/camera/tone_light.c - the light of a scene from its frames, and what is said of them. */
/* SPDX-License-Identifier: MIT */
#include "camera/sensor/develop.h"
#include "commands/camera/tone.h"
#include "commands/tables.h"
#include "photo/sensitometry.h"
#include "report/spoken.h"
#include "tone/align.h"
#include "tone/saturation.h"
#include "tone/sight.h"

#include <math.h>
#include <string.h>

/* Electrons, where nobody says: those of pixels of a usual camera. */
static const double usual_full = 20000, usual_noise = 5;

/* -------- cd/m2 -------- */

/* A picture by itself needs no time: its values are what they are. */
static double plain_unit(struct tone_frames *frames, double unit, bool is_known,
                         struct text_buffer *remarks)
{
    const bool is_single = frames->count == 1 && !frames->is_timed;
    frames->frames[0].time = is_single ? 1 : frames->frames[0].time;
    growing_format(remarks, "a value of 1%s is %s%.4g cd/m2%s\n", is_single ? "" : " in 1 s",
                   is_known ? "" : "taken for ", unit,
                   is_known ? "" : ": --calibrate says what it is");
    return unit;
}

/* By f-number and ISO speed, as ISO 12232 has it. */
static double standard_unit(const struct tone_frames *frames, struct text_buffer *remarks)
{
    const double N = frames->fnumber, S = frames->iso;
    const bool is_light = frames->frames[0].bits == 0;
    const double full = is_light ? 1 : saturation_exposure(S) / DEVELOP_HEADROOM;
    const double unit = full * N * N / LENS_Q_STANDARD;
    growing_format(remarks, "exposed for 1 s, %s is %.4g cd/m2: f/%.4g%s, L = H N^2/(%g t)\n",
                   is_light ? "1 lx s" : "white", unit, N,
                   is_light ? "" : arena_printf(remarks->arena, ", ISO %.4g", S), LENS_Q_STANDARD);
    if (frames->filter != NULL) {
        growing_format(remarks,
                       "warning: the f-number knows nothing of the filter that %s was taken "
                       "through, %s\n",
                       frames->filtered, frames->filter);
    }
    return unit;
}

static bool is_unit(const struct tone_frames *frames, const char *unit)
{
    return frames->unit != NULL && strcmp(frames->unit, unit) == 0;
}

/* What one of a merged picture's values is, cd/m^2, and why. */
static bool unit_of_light(const struct tone_input *input, struct tone_frames *frames,
                          struct text_buffer *remarks, double *unit, struct error *error)
{
    const struct tone_frame *first = &frames->frames[0];
    const bool is_asked = !isnan(input->iso) || !isnan(input->fnumber);
    const bool has_speed = first->bits == 0 ? is_unit(frames, "lx s") : !isnan(frames->iso);
    const bool is_standard = has_speed && !isnan(frames->fnumber) && !isnan(first->time);
    if (!isnan(input->calibrate)) {
        *unit = plain_unit(frames, input->calibrate, true, remarks);
    } else if (is_asked && !is_standard) {
        /* Luminance by what was asked for, but something is missing. */
        const bool has_light = frames->frames[0].bits == 0;
        if (has_light && !is_unit(frames, "lx s")) {
            return fail(
                error, ERROR_USAGE,
                "{--aperture} and {--iso} say nothing of %.200s, whose values are no exposures",
                frames->frames[0].name);
        }
        return fail(error, ERROR_USAGE,
                    "luminance takes the exposure time, the f-number and%s: %s is missing",
                    has_light ? " lx s" : " the ISO speed",
                    SAID_FIRST({isnan(frames->frames[0].time), "the time"},
                               {isnan(frames->fnumber), "{--aperture}"}, {true, "{--iso}"}));
    } else if (is_unit(frames, "cd/m2") && frames->count == 1) {
        *unit = plain_unit(frames, 1, true, remarks);
    } else if (!isnan(frames->white) && !isnan(first->time) && !is_asked) {
        *unit = frames->white * first->time;
        growing_format(remarks, "exposed for 1 s, %s is %.4g cd/m2, as %s says\n",
                       first->bits == 0 ? "1 lx s" : "white", *unit, first->name);
    } else {
        *unit =
            is_standard ? standard_unit(frames, remarks) : plain_unit(frames, 1, false, remarks);
    }
    return true;
}

/* -------- the frames -------- */

static void align_merged_frames(const struct tone_input *input, struct tone_frames *frames,
                                struct text_buffer *remarks)
{
    struct align_step steps[FRAMES_MOST];
    align_frames(frames->frames, frames->count, steps);
    /* A camera that moved, and frames that cannot be told from. */
    bool is_silent = input->align;
    for (size_t i = 0; i < frames->count; i++) {
        const struct tone_frame *frame = &frames->frames[i];
        is_silent = is_silent && frame->right == 0 && frame->down == 0 && !steps[i].is_beyond &&
                    steps[i].is_told;
        if (frame->right != 0 || frame->down != 0) {
            growing_format(remarks, "%s%s lies %ld pixels to the right of %s and %ld below it%s\n",
                           input->align ? "" : "warning: the camera has moved: ", frame->name,
                           frame->right, frames->frames[0].name, frame->down,
                           input->align ? ": shifted back" : ": --align shifts it back");
        }
        if (steps[i].is_beyond) {
            growing_format(remarks,
                           "warning: the camera has moved: %s lies %ld pixels or more beside the "
                           "frame that is next longer, too far to be aligned\n",
                           frame->name, steps[i].limit);
        }
        if (input->align && !steps[i].is_told) {
            growing_format(remarks,
                           "%s is too dark or too bright to be aligned: it goes with the frame "
                           "that is next longer\n",
                           frame->name);
        }
    }
    if (is_silent) {
        growing_format(remarks, "the frames lie on one another: none is shifted\n");
    }
    for (size_t i = 0; i < frames->count && !input->align; i++) {
        frames->frames[i].right = frames->frames[i].down = 0;
    }
}

static bool recover(struct tone_frames *frames, struct tone_light *light,
                    struct text_buffer *remarks, struct error *error)
{
    static const char *const names[FRAME_CHANNELS] = {"red", "green", "blue"};
    if (!debevec_recover(frames->frames, frames->count, remarks->arena, light->curves, error)) {
        return false;
    }
    for (size_t k = 0; k < FRAME_CHANNELS; k++) {
        const struct response_curve *curve = &light->curves[k];
        const struct frame_level *levels =
            frame_levels_of(curve->light, FRAME_LEVELS, remarks->arena);
        for (size_t i = 0; i < frames->count; i++) {
            frames->frames[i].levels[k] = levels;
        }
        growing_format(remarks,
                       "response of %s: codes 32, 64, 128, 192, 224 are light of %.4f, %.4f, %.4f, "
                       "%.4f, %.4f; frames differ by %.2g %%\n",
                       names[k], curve->light[32], curve->light[64], curve->light[128],
                       curve->light[192], curve->light[224], 100 * curve->rms);
        if (curve->held > 0) {
            growing_format(remarks,
                           "warning: the response of %s falls at %zu codes, which are taken for "
                           "the ones before\n",
                           names[k], curve->held);
        }
    }
    return true;
}

static double given_or_noted(double given, double noted, double usual)
{
    if (!isnan(given)) {
        return given;
    }
    return !isnan(noted) ? noted : usual;
}

/* As asked for, noted or usual; floats have that of photons alone. */
static struct merge_noise noise_of(const struct tone_input *input, const struct tone_frames *frames,
                                   struct text_buffer *remarks)
{
    const struct merge_noise noise = {
        given_or_noted(input->full_well, frames->full_well, usual_full),
        given_or_noted(input->read_noise, frames->read_noise, usual_noise)};
    const bool is_guess = isnan(input->full_well) && isnan(frames->full_well);
    if (frames->frames[0].bits == 0) {
        growing_format(remarks, "weights by the noise of photons\n");
    } else {
        growing_format(remarks,
                       "weights by noise: %.4g electrons at white%s, read noise %.3g, steps of %d "
                       "bits\n",
                       noise.full_well, is_guess ? " (assumed)" : "", noise.read_noise,
                       frames->frames[0].bits);
    }
    return noise;
}

static void say_frames(const struct tone_frames *frames, struct text_buffer *remarks)
{
    char least[SPOKEN_LENGTH], most[SPOKEN_LENGTH];
    const struct tone_frame *first = &frames->frames[0];
    double shortest = first->time, longest = first->time;
    for (size_t i = 0; i < frames->count; i++) {
        const struct tone_frame *frame = &frames->frames[i];
        shortest = fmin(shortest, frame->time);
        longest = fmax(longest, frame->time);
        if (frame->remark != NULL) {
            growing_format(remarks, "%s\n", frame->remark);
        }
        if (frame->bits != 0 && frame->full == FRAME_CHANNELS * frame->width * frame->height) {
            growing_format(remarks, "warning: every pixel of %s is saturated: it tells nothing\n",
                           frame->name);
        }
    }
    if (frames->count == 1) {
        return;
    }
    for (size_t i = 0; i < frames->count; i++) {
        if (frames->frames[i].is_by_white) {
            spoken_time(least, frames->frames[i].time, 4);
            growing_format(remarks, "%s counts as %s, by what it says its white is\n",
                           frames->frames[i].name, least);
        }
    }
    spoken_time(least, shortest, 4);
    spoken_time(most, longest, 4);
    growing_format(remarks, "%zu frames of %zu x %zu pixels, %s to %s\n", frames->count,
                   first->width, first->height, least, most);
}

/* Frames of who knows which camera, whose full pixels are not the highest number. */
static void find_saturation(struct tone_frames *frames, struct arena *arena,
                            struct text_buffer *remarks)
{
    static const char *const names[FRAME_CHANNELS] = {"red", "green", "blue"};
    struct saturation_found found;
    struct text_buffer which = {.arena = remarks->arena};
    saturation_find(frames->frames, frames->count, arena, &found);
    for (size_t k = 0; k < FRAME_CHANNELS; k++) {
        if (found.is_found[k]) {
            growing_format(&which, "%s%s %.4g of white", which.length > 0 ? ", " : "", names[k],
                           (double)found.light[k]);
        }
    }
    if (found.name != NULL) {
        growing_format(remarks,
                       "warning: %.3g %% of the pixels in %s share the highest value, where a "
                       "shorter frame shows more light: %.*s are taken for a full sensor, of which "
                       "the files do not say where that is\n",
                       100 * found.share, found.name, (int)which.length,
                       growing_done(&which).start);
    }
}

static double percent_of(size_t part, size_t whole)
{
    return 100 * (double)part / (double)whole;
}

static void say_merged(const struct merged *merged, size_t count, struct text_buffer *remarks)
{
    const size_t pixels = merged->image.width * merged->image.height;
    const double saturated = percent_of(merged->saturated, pixels);
    if (saturated > 0) { /* a few are lights and their reflections; of them it is said too */
        growing_format(remarks, "%s%.3g %% of the pixels are saturated in %s\n",
                       saturated >= 1 ? "warning: " : "", saturated,
                       count > 1 ? "all frames" : "some channel");
    }
    if (merged->looked > 0 && percent_of(merged->apart, merged->looked) >= 1) {
        growing_format(remarks,
                       "warning: in %.3g %% of the pixels frames differ by more than noise: "
                       "something has moved, or the response is another\n",
                       percent_of(merged->apart, merged->looked));
    }
}

/* -------- the light -------- */

/* Of frames that lie in an arena of their own. */
static bool make_light(const struct tone_input *input, struct arena *frames_arena,
                       struct arena *arena, struct tone_light *light, struct error *error)
{
    struct text_buffer remarks = {.arena = arena};
    struct merge_noise noise = {1, 0}; /* of a picture alone it says nothing */
    struct tone_frames frames;
    struct merged merged;
    double unit = 1;
    if (!tone_frames_read(input, frames_arena, &frames, error)) {
        return false;
    }
    /* What is of several frames, and of their noise. */
    const bool has_noise = !isnan(input->full_well) || !isnan(input->read_noise);
    if (frames.count == 1 && (has_noise || input->align)) {
        return fail(error, ERROR_USAGE, "{--%s} needs several frames",
                    SAID_FIRST({input->align, "align"}, {!isnan(input->full_well), "full-well"},
                               {true, "read-noise"}));
    }
    if (has_noise && frames.frames[0].bits == 0) {
        return fail(error, ERROR_USAGE,
                    "{--%s} works only with whole numbers, and %.200s holds floats",
                    !isnan(input->full_well) ? "full-well" : "read-noise", frames.frames[0].name);
    }
    say_frames(&frames, &remarks);
    if (frames.count > 1) {
        align_merged_frames(input, &frames, &remarks);
        find_saturation(&frames, frames_arena, &remarks);
        noise = noise_of(input, &frames, &remarks);
    }
    if ((input->response == RESPONSE_DEBEVEC && !recover(&frames, light, &remarks, error)) ||
        !unit_of_light(input, &frames, &remarks, &unit, error) ||
        !merge_frames(frames.frames, frames.count, &noise, arena, &merged, error)) {
        return false;
    }
    for (size_t i = 0; i < merged.image.width * merged.image.height * FRAME_CHANNELS; i++) {
        merged.image.pixels[i] *= (float)unit;
    }
    if (!image_check(&merged.image, IMAGE_FINITE, error)) {
        return false;
    }
    say_merged(&merged, frames.count, &remarks);
    float least = INFINITY, most = 0;
    for (size_t i = 0; i < merged.image.width * merged.image.height; i++) {
        const float luminance = sight_luminance(merged.image.pixels + FRAME_CHANNELS * i);
        least = fminf(least, luminance);
        most = fmaxf(most, luminance);
    }
    growing_format(&remarks, "luminance %.3g to %.3g cd/m2\n", (double)least, (double)most);
    light->image = merged.image;
    light->remarks = growing_done(&remarks);
    return true;
}

bool tone_light_of(const struct artifact_job *job, struct tone_light **light, struct error *error)
{
    if (job->run->state == NULL) {
        struct tone_light *made = ARENA_NEW(job->run->kept, struct tone_light);
        struct arena scratch = {0};
        const bool done = make_light(job->inputs[0], &scratch, job->run->kept, made, error);
        arena_free(&scratch);
        if (!done) {
            return false;
        }
        job->run->state = made;
    }
    *light = job->run->state;
    return true;
}
