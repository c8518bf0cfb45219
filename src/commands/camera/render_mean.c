/* commands/camera/render_mean.c - what a scene's picture and its meter make of the same light. */
/* SPDX-License-Identifier: MIT */
#include "commands/camera/render_world.h"
#include "light/colour.h"

/* Of all pixels, lx. */
static double render_mean_of(const struct image *image)
{
    const size_t pixels = image->width * image->height;
    double sum = 0;
    for (size_t i = 0; i < pixels; i++) {
        const float *pixel = &image->pixels[i * image->channels];
        const double rgb[PHOTOGRAPH_CHANNELS] = {(double)pixel[0], (double)pixel[1],
                                                 (double)pixel[2]};
        sum += colour_luminance(rgb);
    }
    return sum / (double)pixels;
}

/*
 * The share that the pixels may have less than the meter finds: four times what is known of its
 * error, and of that of so many more or fewer rays, beside what it leaves out. More they may have:
 * what shines near the lens is larger for the rim of its pupil.
 */
static double allowed_loss(const struct photograph *photograph)
{
    static const double left_out = 0.05, metering_rays = 16384;
    const double traced = (double)photograph->counts[PHOTOGRAPH_TRACED];
    const double rays = fmax(1, traced / (double)photograph->passes);
    return left_out + 4 * photograph->mean_error * sqrt(1 + metering_rays / rays);
}

void render_say_mean(const struct photograph_question *question,
                     const struct photograph *photograph, struct text_buffer *remarks)
{
    const double doubtful = 0.1; /* a sixth of a stop */
    const struct image *image = &photograph->image;
    const bool is_whole = image->width == question->columns && image->height == question->rows &&
                          !photograph->is_incomplete;
    const double metered = colour_luminance(photograph->mean);
    if (photograph->mean_error > doubtful) {
        growing_format(remarks,
                       "warning: the light on the film on average is known to %.2g %% only: few "
                       "rays find what makes it\n",
                       100 * photograph->mean_error);
    }
    const double shown = is_whole ? render_mean_of(image) : NAN;
    if (photograph->is_metered_directly && shown > 0 &&
        shown < (1 - allowed_loss(photograph)) * metered) {
        growing_format(
            remarks,
            "warning: the pixels have %.4g lx on average, and rays straight to what "
            "shines find %.4g lx: small lights are missed, and more --samples find them, "
            "or are blurred beyond the film\n",
            shown, metered);
    }
}
