/* commands/camera/tone_curves.c - recovered responses, drawn and as numbers. */
/* SPDX-License-Identifier: MIT */
#include "commands/camera/tone.h"
#include "draw/plot.h"

#include <math.h>
#include <string.h>

static const char *const names[FRAME_CHANNELS] = {"red", "green", "blue"};

const struct file_type *tone_curve_types(size_t i)
{
    static const struct file_type types[] = {
        {{"svg", "SVG drawing"}, ".svg"},
        {{"csv", "numbers: code, light of red, green and blue"}, ".csv"},
    };
    return i < sizeof types / sizeof types[0] ? &types[i] : NULL;
}

static void tone_curves_write_numbers(const struct tone_light *light, struct output *sink)
{
    output_string(sink, "code,red,green,blue\n");
    for (int z = 0; z < FRAME_LEVELS; z++) {
        output_printf(sink, "%d,%.6g,%.6g,%.6g\n", z, light->curves[0].light[z],
                      light->curves[1].light[z], light->curves[2].light[z]);
    }
}

/* As Debevec and Malik draw them: the logarithm of light over the codes. */
static bool tone_curves_draw_curves(const struct tone_light *light, const struct artifact_job *job,
                                    struct output *sink, struct error *error)
{
    struct svg drawing = {.arena = job->run->arena};
    struct plot_series series[FRAME_CHANNELS];
    double codes[FRAME_LEVELS], stops[FRAME_CHANNELS][FRAME_LEVELS];
    for (size_t k = 0; k < FRAME_CHANNELS; k++) {
        for (int z = 0; z < FRAME_LEVELS; z++) {
            codes[z] = z;
            stops[k][z] = log2(light->curves[k].light[z]);
        }
        series[k] = (struct plot_series){.label = names[k], .y = stops[k], .style = k};
    }
    const struct plot plot = {.title = "Response of the camera",
                              .subtitle = "recovered from the bracket; code 128 as sRGB has it",
                              .x_label = "code",
                              .y_label = "log2 of light",
                              .x = codes,
                              .count = FRAME_LEVELS,
                              .series = series,
                              .series_count = FRAME_CHANNELS};
    return plot_draw(&plot, &drawing, error) && drawing_write(job, &drawing, sink, error);
}

bool tone_curves(const struct artifact_job *job, struct output *sink, struct error *error)
{
    struct tone_light *light;
    if (!tone_light_of(job, &light, error)) {
        return false;
    }
    sink->remarks = light->remarks;
    if (strcmp(job->type->ending, ".csv") == 0) {
        tone_curves_write_numbers(light, sink);
        return true;
    }
    return tone_curves_draw_curves(light, job, sink, error);
}
