/* commands/photo/pixels.c - the pixels of a sensor: its own, counted, or by their pitch. */
/* SPDX-License-Identifier: MIT */
#include "commands/photo/pixels.h"

#include <math.h>

/* So many pixels of that pitch. */
static bool size_of_pixels(const struct pixels_question *a, struct sensor_value *sensor,
                           struct arena *arena, struct error *error)
{
    const double wide = a->pixels.wide, high = a->is_line ? 1 : a->pixels.high;
    if (!sensor->is_fallback) {
        return fail(error, ERROR_USAGE,
                    "{--sensor}, {--pixels} and {--pitch}: two of them give the third");
    }
    if (isnan(wide) || isnan(high)) {
        fail(error, ERROR_USAGE, "{--pixels} with {--pitch} needs both numbers, as in 2448x2048");
        return error_hint(error, "{--line-scan} is for a line of pixels");
    }
    *sensor =
        (struct sensor_value){.size = {wide * a->pitch, high * a->pitch, a->pitch}, .focal = NAN};
    /* the size first, so that it reads back as one */
    sensor->name =
        arena_printf(arena, "%.6g x %.6g mm (%.15g x %.15g pixels of %.4g um)", sensor->size.width,
                     sensor->size.height, wide, high, 1000 * a->pitch);
    return true;
}

/* A sensor of that size with so many pixels. */
static void count_pixels(const struct pixels_question *a, struct sensor_value *sensor,
                         struct arena *arena, struct warnings *doubts)
{
    static const double SQUARE = 0.02; /* sizes are rounded to 0.1 mm, and formats nominal */
    const struct pixels_value *pixels = &a->pixels;
    struct sensor *size = &sensor->size;
    sensor->pitch_note = NULL;
    if (!isnan(pixels->total)) {
        size->pitch = sensor_pitch_of(size, pixels->total);
        return;
    }
    const bool has_shape = !isnan(pixels->high) && !a->is_line;
    const double shape = has_shape ? pixels->wide / pixels->high : size->width / size->height,
                 stretch = shape * size->height / size->width;
    if (fabs(stretch - 1) > SQUARE && sensor->is_optical) {
        const double diagonal = sensor_diagonal(size);
        size->height = diagonal / hypot(shape, 1);
        size->width = shape * size->height;
        struct text rest = text_of(sensor->name);
        const struct text format = text_trim(text_cut(&rest, '('));
        sensor->name = arena_printf(
            arena,
            "%.6g x %.6g mm (%.*s: its nominal diagonal, %.4g mm, in the shape of %.15gx%.15g)",
            size->width, size->height, text_shown(format), format.start, diagonal, pixels->wide,
            pixels->high);
    } else if (fabs(stretch - 1) > SQUARE) {
        warnings_add(doubts,
                     "%.15gx%.15g pixels would not be square on %s: the pitch is that across",
                     pixels->wide, pixels->high, sensor->name);
    }
    size->pitch = size->width / pixels->wide;
}

bool pixels_settle(const struct pixels_question *question, struct sensor_value *sensor,
                   struct arena *arena, struct warnings *doubts, struct error *error)
{
    const bool is_counted = pixels_given(&question->pixels), has_pitch = !isnan(question->pitch);
    if (question->is_line && question->pixels.high > 1) {
        return fail(error, ERROR_USAGE,
                    "{--line-scan} is one line: {--pixels} is the number across alone");
    }
    if (is_counted && has_pitch) {
        return size_of_pixels(question, sensor, arena, error);
    }
    if (is_counted && sensor->is_fallback) {
        return fail(error, ERROR_USAGE,
                    "pixels need a size: give {--pitch} 3um, or the size of the sensor as "
                    "{--sensor} 1/2.8in");
    }
    if (is_counted) {
        count_pixels(question, sensor, arena, doubts);
    } else if (has_pitch) {
        sensor->size.pitch = question->pitch;
        sensor->pitch_note = NULL;
    }
    if (!question->is_line) {
        return true;
    }
    if (isnan(sensor->size.pitch)) {
        return fail(error, ERROR_USAGE,
                    "{--line-scan} needs pixels: give {--pixels} and {--pitch}, or {--sensor} and "
                    "one of them");
    }
    sensor->size.height = sensor->size.pitch;
    sensor->name = arena_printf(arena, "%.6g x %.6g mm (a line of %s)", sensor->size.width,
                                sensor->size.height, sensor->name);
    return true;
}
