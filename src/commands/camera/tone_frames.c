/* commands/camera/tone_frames.c - the files of a bracket, and what they say of themselves. */
/* SPDX-License-Identifier: MIT */
#include "commands/camera/render.h"
#include "commands/camera/tone.h"
#include "file/image_file.h"
#include "report/place.h"
#include "tone/saturation.h"

#include <math.h>
#include <string.h>

/* Exposure times, s. */
static const double TIME_LEAST = 1e-9, TIME_MOST = 1e9;

/* Frames as they are read, one after the other. */
struct frame_reader {
    const struct tone_input *input;
    struct arena *arena;
    struct tone_frames *frames;
    double *iso, *fnumber, *white; /* of each; NaN = not noted */
    struct text times;             /* what is left of --times */
};

static const char *frame_note(const struct image *image, const char *key)
{
    for (size_t i = 0; i < image->note_count; i++) {
        if (strcmp(image->notes[i].key, key) == 0) {
            return image->notes[i].value;
        }
    }
    return NULL;
}

/* NaN: it is not noted, or nothing that can be read. */
static double noted_number(const struct image *image, const char *key,
                           const struct dimension *dimension)
{
    const char *note = frame_note(image, key);
    struct error ignored;
    double value = NAN;
    return note != NULL && quantity_read(text_of(note), dimension, NULL, &value, NULL, &ignored) &&
                   value > 0
               ? value
               : NAN;
}

/* FILE=1/60 is a name and a time where a time stands behind the last '='; else all is a name. */
static void cut_time(struct text word, struct arena *arena, const char **path, double *time)
{
    size_t at = word.length;
    struct error ignored;
    *time = NAN;
    while (at > 0 && word.start[at - 1] != '=') {
        at--;
    }
    const struct text behind = {word.start + at, word.length - at};
    if (at > 1 && quantity_read(behind, &dimension_time, NULL, time, NULL, &ignored)) {
        *path = arena_string(arena, word.start, at - 1);
        return;
    }
    *time = NAN;
    *path = arena_string(arena, word.start, word.length);
}

/* The next of --times. */
static bool next_time(struct frame_reader *reading, double *time, struct error *error)
{
    if (reading->input->times == NULL) {
        return true;
    }
    if (!isnan(*time)) {
        return fail(error, ERROR_USAGE, "{--times} and FILE=TIME exclude each other");
    }
    if (reading->times.start == NULL) {
        return fail(error, ERROR_USAGE, "{--times} '%.100s' has fewer times than there are frames",
                    reading->input->times);
    }
    return quantity_read(text_trim(text_cut(&reading->times, ',')), &dimension_time, NULL, time,
                         NULL, error) ||
           error_prefix(error, "{--times}: ");
}

/* What cannot be light. */
static bool check_kind(const struct image *image, struct error *error)
{
    const char *unit = frame_note(image, "Unit");
    if (frame_note(image, "CFA pattern") != NULL) {
        return fail(error, ERROR_DATA, "raw data of a sensor: develop it first");
    }
    return unit == NULL || strcmp(unit, "density") != 0 ||
           fail(error, ERROR_DATA, "densities of a film, not light");
}

static bool check_like_first(const struct tone_frames *frames, const struct tone_frame *frame,
                             struct error *error)
{
    const double enough = 1e-6; /* between the digits of formats */
    const struct tone_frame *first = &frames->frames[0];
    const double aspect = frame->aspect > 0 ? frame->aspect : 1;
    const double of_first = first->aspect > 0 ? first->aspect : 1;
    if (frame->width != first->width || frame->height != first->height) {
        return fail(error, ERROR_DATA, "%zu x %zu pixels, and %.200s has %zu x %zu", frame->width,
                    frame->height, first->name, first->width, first->height);
    }
    if (!(fabs(aspect / of_first - 1) <= enough)) {
        return fail(error, ERROR_DATA,
                    "its pixels are %.6g times as wide as high, and those of %.200s %.6g times",
                    aspect, first->name, of_first);
    }
    /* whole numbers and floats measure noise by different things */
    return (frame->bits == 0) == (first->bits == 0) ||
           fail(error, ERROR_DATA, "it holds %s, and %.200s %s",
                frame->bits == 0 ? "floats" : "whole numbers", first->name,
                first->bits == 0 ? "floats" : "whole numbers");
}

/* Luminance needs no exposure, and pictures of it are no bracket. */
static bool check_unit(const struct frame_reader *reading, const struct image *image, bool is_timed,
                       size_t i, struct error *error)
{
    const char *const units[] = {frame_note(image, "Unit"), reading->frames->unit};
    for (size_t k = 0; k < sizeof units / sizeof units[0]; k++) {
        if (units[k] != NULL && strcmp(units[k], "cd/m2") == 0 && (is_timed || i > 0)) {
            return fail(
                error, ERROR_DATA,
                "%.200s holds luminance, cd/m2: it takes no exposure time, and is no frame of "
                "a bracket",
                k == 0 ? "it" : reading->frames->frames[0].name);
        }
    }
    return true;
}

static void take_notes(struct frame_reader *reading, const struct image *image, size_t i)
{
    struct tone_frames *frames = reading->frames;
    const char *unit = frame_note(image, "Unit"), *filter = frame_note(image, "Filter");
    if (filter != NULL && frames->filter == NULL) {
        frames->filtered = frames->frames[i].name;
        frames->filter = arena_string(reading->arena, filter, strlen(filter));
    }
    reading->iso[i] = noted_number(image, "ISO", &dimension_iso);
    reading->fnumber[i] = noted_number(image, "Aperture", &dimension_fnumber);
    reading->white[i] = noted_number(
        image, image->bits == 0 ? RENDER_NOTE_LIGHT : RENDER_NOTE_WHITE, &dimension_luminance);
    if (i == 0) {
        frames->full_well = noted_number(image, RENDER_NOTE_FULL, &dimension_number);
        frames->read_noise = noted_number(image, RENDER_NOTE_READ, &dimension_number);
        frames->white = reading->white[0];
        frames->unit = unit != NULL ? arena_string(reading->arena, unit, strlen(unit)) : NULL;
    }
}

/* Where the sensor was full, if it says so. */
static bool take_saturation(const struct frame_reader *reading, const struct image *image,
                            struct tone_frame *frame, struct error *error)
{
    const char *note = frame_note(image, RENDER_NOTE_SATURATION);
    struct saturation saturation;
    if (note == NULL) {
        return true;
    }
    if (!saturation_read(note, &saturation, error)) {
        return false;
    }
    saturation_apply(frame, &saturation, reading->arena);
    return true;
}

/* Its noise would count as if it were another's. */
static bool check_once(const struct frame_reader *reading, const char *path, struct error *error)
{
    for (size_t i = 0; i < reading->frames->count; i++) {
        const char *other = reading->frames->frames[i].name;
        if (place_is_same(other, path, reading->arena)) {
            return strcmp(other, path) == 0
                       ? fail(error, ERROR_USAGE, "%.200s is given twice", path)
                       : fail(error, ERROR_USAGE, "%.200s and %.200s are the same file", other,
                              path);
        }
    }
    return true;
}

static bool frame_file_read(struct frame_reader *reading, const char *path, double time, size_t i,
                            struct error *error)
{
    struct arena scratch = {0};
    const struct image_wish wish = {IMAGE_CODES, IMAGE_VALUES_MOST / FRAME_CHANNELS};
    struct image image;
    struct tone_frame *frame = &reading->frames->frames[i];
    bool done = image_file_read(path, &wish, &scratch, &image, error);
    if (done) {
        done = check_kind(&image, error) && frame_take(&image, reading->arena, frame, error) &&
               take_saturation(reading, &image, frame, error);
        frame->name = path;
        frame->remark = image_file_remark(path, &image, reading->arena);
        frame->time = isnan(time) ? noted_number(&image, "Exposure time", &dimension_time) : time;
        done = done && check_unit(reading, &image, !isnan(time), i, error) &&
               check_like_first(reading->frames, frame, error);
        done = done || error_locate(error, path, 0, 0);
        take_notes(reading, &image, i);
    }
    arena_free(&scratch);
    return done;
}

/*
 * What one setting of all frames is: that of the option or of the first; times change with it where
 * frames differ, so that light over time is the same in all.
 */
static bool settle_setting(const struct tone_frames *frames, const double *values, double power,
                           const char *name, double *setting, struct error *error)
{
    if (!isnan(*setting)) {
        return true; /* an option says so of all */
    }
    *setting = values[0];
    for (size_t i = 1; i < frames->count; i++) {
        if (isnan(values[i]) != isnan(*setting)) {
            return fail(error, ERROR_DATA, "%.100s says its %s, and %.100s does not: give it",
                        frames->frames[isnan(values[i]) ? 0 : i].name, name,
                        frames->frames[isnan(values[i]) ? i : 0].name);
        }
        if (!isnan(values[i])) {
            frames->frames[i].time *= pow(values[i] / *setting, power);
        }
    }
    return true;
}

/*
 * Light over time is the same in all frames whose own whites say how much each of them got: through
 * which shutter and filter, too. Who asks for times, or for light by f-number and speed, has these.
 */
static bool settle_whites(const struct frame_reader *reading, struct error *error)
{
    const double rounding = 1e-4; /* of what is noted, and a little more */
    const struct tone_input *input = reading->input;
    const struct tone_frames *frames = reading->frames;
    const double *white = reading->white;
    const bool is_asked = frames->is_timed || !isnan(input->iso) || !isnan(input->fnumber);
    for (size_t i = 1; i < frames->count && !is_asked; i++) {
        struct tone_frame *frame = &frames->frames[i];
        if (isnan(white[i]) != isnan(white[0])) {
            fail(error, ERROR_DATA, "%.100s says what its white is, and %.100s does not",
                 frames->frames[isnan(white[i]) ? 0 : i].name,
                 frames->frames[isnan(white[i]) ? i : 0].name);
            return error_hint(error, "{--times} of all frames make them comparable");
        }
        const double time = frames->frames[0].time * white[0] / white[i];
        frame->is_by_white = fabs(time / frame->time - 1) > rounding; /* not if none has one */
        frame->time = frame->is_by_white ? time : frame->time;
    }
    return true;
}

/* Weights go with squares of times, in single precision. */
static bool check_frame_times(const struct tone_frames *frames, struct error *error)
{
    for (size_t i = 0; i < frames->count; i++) {
        const struct tone_frame *frame = &frames->frames[i];
        if (!isnan(frame->time) && !(frame->time >= TIME_LEAST && frame->time <= TIME_MOST)) {
            return fail(error, frames->is_timed ? ERROR_USAGE : ERROR_DATA,
                        "the exposure time of %.200s is %.6g s: it must be from %g to %g s",
                        frame->name, frame->time, TIME_LEAST, TIME_MOST);
        }
    }
    return true;
}

bool tone_frames_read(const struct tone_input *input, struct arena *arena,
                      struct tone_frames *frames, struct error *error)
{
    struct frame_reader reading = {.input = input,
                                   .arena = arena,
                                   .frames = frames,
                                   .iso = ARENA_ARRAY(arena, FRAMES_MOST, double),
                                   .fnumber = ARENA_ARRAY(arena, FRAMES_MOST, double),
                                   .white = ARENA_ARRAY(arena, FRAMES_MOST, double)};
    *frames = (struct tone_frames){.frames = ARENA_ARRAY(arena, FRAMES_MOST, struct tone_frame),
                                   .iso = input->iso,
                                   .fnumber = input->fnumber};
    reading.times = input->times != NULL ? text_of(input->times) : reading.times;
    for (struct text rest = text_of(input->files); rest.start != NULL; frames->count++) {
        const struct text word = text_cut(&rest, OPTION_MANY_SEPARATOR);
        const char *path;
        double time;
        if (frames->count == FRAMES_MOST) {
            return fail(error, ERROR_USAGE, "at most %d frames can be merged", FRAMES_MOST);
        }
        cut_time(word, arena, &path, &time);
        if (!next_time(&reading, &time, error)) {
            return false;
        }
        frames->is_timed = frames->is_timed || !isnan(time);
        if (!check_once(&reading, path, error) ||
            !frame_file_read(&reading, path, time, frames->count, error)) {
            return false;
        }
    }
    if (reading.times.start != NULL) {
        return fail(error, ERROR_USAGE, "{--times} '%.100s' has more times than the %zu frame%s",
                    input->times, frames->count, frames->count == 1 ? "" : "s");
    }
    /* One needs no time to be looked at; of several each has its own. */
    for (size_t i = 0; i < frames->count; i++) {
        const struct tone_frame *frame = &frames->frames[i];
        if (isnan(frame->time) && frames->count > 1) {
            fail(error, ERROR_USAGE, "nothing says how long %.200s was exposed", frame->name);
            return error_hint(error, "write FILE=1/60 for each, or {--times} 1/15,1/60");
        }
    }
    return check_frame_times(frames, error) &&
           settle_setting(frames, reading.iso, 1, "ISO speed", &frames->iso, error) &&
           settle_setting(frames, reading.fnumber, -2, "f-number", &frames->fnumber, error) &&
           settle_whites(&reading, error) && check_frame_times(frames, error);
}
