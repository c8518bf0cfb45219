/* commands/camera/tone_picture.c - light as an eye sees it, as a display shows it, in false colours. */
/* SPDX-License-Identifier: MIT */
#include "base/constants.h"
#include "base/image/srgb.h"
#include "commands/camera/render.h"
#include "commands/camera/tone.h"
#include "draw/lettering.h"
#include "draw/palette.h"
#include "file/image_file.h"
#include "report/version.h"
#include "tone/acuity.h"
#include "tone/sight.h"

#include <assert.h>
#include <math.h>
#include <string.h>

enum { FEW_CELLS = 64 };
static const double LARGE_CELL = 1.5; /* degrees */

const struct file_type *tone_picture_types(size_t i)
{
    return image_file_types(i);
}

static bool is_png(const struct artifact_job *job)
{
    return strcmp(job->type->ending, ".png") == 0;
}

/* What --operator asks for, or what the kind of file is for. */
static int asked_of(const struct artifact_job *job)
{
    const struct tone_input *input = job->inputs[0];
    if (input->operation != ASKED_AUTO) {
        return input->operation;
    }
    return is_png(job) ? ASKED_FIRST + (int)TONE_WARD : ASKED_NONE;
}

/* Two luminances, the first smaller: "1,100". */
static bool read_luminances(const char *option, const char *text, double range[2],
                            struct error *error)
{
    struct text rest = text_of(text);
    for (int i = 0; i < 2; i++) {
        const struct text word = text_trim(text_cut(&rest, ','));
        if (rest.start == NULL && i == 0) {
            return fail(error, ERROR_USAGE, "{--%s} '%.60s': two luminances, as 1,100", option,
                        text);
        }
        if (!quantity_read(word, &dimension_luminance, NULL, &range[i], NULL, error)) {
            return error_prefix(error, "{--%s}: ", option);
        }
    }
    return (rest.start == NULL && range[0] > 0 && range[1] > range[0] && range[1] <= 1e12) ||
           fail(error, ERROR_USAGE,
                "{--%s} '%.60s': two luminances, the first above 0, the second above the first and "
                "at most 1e12 cd/m2",
                option, text);
}

/* -------- what is refused -------- */

/* Options that say something of one operator alone. */
static bool check_operator(const struct artifact_job *job, struct error *error)
{
    const int asked = asked_of(job);
    static const struct {
        const char *option;
        unsigned serves; /* 1 << what is asked */
        const char *whom;
    } of[] = {{"ceiling", 1U << (ASKED_FIRST + TONE_WARD), "ward"},
              {"gamma", 1U << (ASKED_FIRST + TONE_GAMMA), "gamma"},
              {"white",
               1U << (ASKED_FIRST + TONE_LINEAR) | 1U << (ASKED_FIRST + TONE_GAMMA) |
                   1U << (ASKED_FIRST + TONE_FILMIC),
               "linear, gamma or filmic"},
              {"display", ~(1U << ASKED_NONE), "linear, gamma, filmic or ward"}};
    for (size_t i = 0; i < sizeof of / sizeof of[0]; i++) {
        if (asking_given(job->asking, of[i].option) && (of[i].serves & 1U << asked) == 0) {
            return fail(error, ERROR_USAGE, "{--%s} works only with {--operator} %s%s",
                        of[i].option, of[i].whom,
                        asked == ASKED_NONE ? ": this writes the light itself" : "");
        }
    }
    return !(asked == ASKED_NONE && is_png(job)) ||
           fail(error, ERROR_USAGE, "{--operator} none: a .png has no room for light itself");
}

static bool check_colours(const struct artifact_job *job, struct error *error)
{
    const struct tone_input *input = job->inputs[0];
    double range[2];
    return (is_png(job) || fail(error, ERROR_USAGE, "{--falsecolor} is written as .png, not %s",
                                job->type->ending)) &&
           (input->scale == NULL || read_luminances("scale", input->scale, range, error));
}

/* Is anything asked of places of one degree? */
static bool needs_view(const struct artifact_job *job)
{
    const struct tone_input *input = job->inputs[0];
    return input->glare || input->acuity ||
           (!input->falsecolor && asked_of(job) != ASKED_NONE && isnan(input->white));
}

bool tone_picture_check(const struct artifact_job *job, struct error *error)
{
    const struct tone_input *input = job->inputs[0];
    double range[2];
    if (input->files == NULL) {
        fail(error, ERROR_USAGE, "no picture is given");
        return error_hint(error, "name one, or a bracket: a.jpg=1/60 b.jpg=1/15");
    }
    if (input->response == RESPONSE_DEBEVEC &&
        strchr(input->files, OPTION_MANY_SEPARATOR) == NULL) {
        return fail(error, ERROR_USAGE, "{--response} debevec needs at least two frames");
    }
    if (asking_given(job->asking, "fov") && !needs_view(job)) {
        return fail(error, ERROR_USAGE,
                    "{--fov} has no effect here: only {--glare}, {--acuity}, ward and an operator "
                    "that chooses its white use it");
    }
    const bool is_exr = strcmp(job->type->ending, ".exr") == 0;
    const bool fits = is_png(job) ? input->bits == 8 || input->bits == 16
                                  : is_exr && (input->bits == 16 || input->bits == 32);
    return (input->bits == 0 || fits ||
            fail(error, ERROR_USAGE,
                 "{--bits} %ld: a .png has 8 or 16, an .exr 16 or 32, others have no choice",
                 input->bits)) &&
           (input->falsecolor ? check_colours(job, error) : check_operator(job, error)) &&
           (input->display == NULL || read_luminances("display", input->display, range, error));
}

/* -------- what a display shows -------- */

static bool picture_show(const struct artifact_job *job, const struct foveal *foveal,
                         struct image *image, struct text_buffer *remarks, struct error *error)
{
    const struct tone_input *input = job->inputs[0];
    struct tone_way way = {.operation = (enum tone_operator)(asked_of(job) - ASKED_FIRST),
                           .ceiling = (enum histogram_ceiling)input->ceiling,
                           .white = input->white,
                           .gamma = input->gamma,
                           .display = {1, 100},
                           .as_light = !is_png(job)};
    struct toned toned;
    double range[2];
    if (input->display != NULL) {
        if (!read_luminances("display", input->display, range, error)) {
            return false;
        }
        way.display = (struct display){range[0], range[1]};
    }
    if (!tone_show(&way, foveal, image, remarks->arena, &toned, error)) {
        return false;
    }
    size_t pixels = image->width * image->height;
    static const char *const names[] = {"linear", "gamma", "filmic", "ward"};
    const struct histogram *histogram = &toned.histogram;
    const char *name = names[way.operation];
    if (way.operation != TONE_WARD) {
        growing_format(remarks, "%s: %.4g cd/m2 become white; %.3g %% of the pixels are brighter\n",
                       name, toned.white, 100 * (double)toned.clipped / (double)pixels);
        if (!isnan(toned.log_mean)) {
            growing_format(remarks, "the mean by logarithms is %.4g cd/m2\n", toned.log_mean);
        }
    } else if (histogram->is_linear) {
        growing_format(
            remarks,
            "ward: the ceiling leaves nothing to compress: linear, %.4g of the luminance\n",
            histogram->factor);
    } else {
        growing_format(
            remarks,
            "ward: %.3g to %.4g cd/m2 onto %.4g to %.4g; %zu passes, the last cut %.2g %% "
            "of the histogram\n",
            exp(histogram->low), exp(histogram->high), way.display.least, way.display.most,
            histogram->passes, 100 * histogram->trimmed);
    }
    return true;
}

/* Percent of the pixels that have the colour of an end. */
static double share_beyond(const struct image *image, const double range[2])
{
    const size_t pixels = image->width * image->height;
    size_t count = 0;
    for (size_t i = 0; i < pixels; i++) {
        const double luminance = (double)sight_luminance(image->pixels + FRAME_CHANNELS * i);
        count += luminance < range[0] || luminance > range[1];
    }
    return 100 * (double)count / (double)pixels;
}

/* -------- a scale -------- */

enum { CHANNELS = 3, LEAST_HEIGHT = 20 };

/* A digit, of the picture's height; px that can be read, and the most of a low picture that these
   may take. In digits' heights: the parts of the scale. */
static const double DIGIT = 0.032, DIGIT_LEGIBLE = 9, DIGIT_MOST = 0.22;
static const double BESIDE = 0.8, BAR = 1.5, BEFORE_MARKS = 0.7, TICK = 0.35, BEHIND = 0.6;
static const double UNIT_LINE = 1.5, TOP = 2.7, BOTTOM = 1.1, APART = 1.7;

/* The scale beside a picture. */
struct tone_scale {
    const double *range; /* cd/m^2 */
    double digit;        /* height of a digit, px */
    double top, bottom;  /* of its bar, px */
    double left, right;
};

/* The colour of a place on the scale. */
static void put_colour(double share, float *pixel)
{
    double colour[CHANNELS];
    palette_scale(false, share, colour);
    for (int k = 0; k < CHANNELS; k++) {
        pixel[k] = (float)srgb_light(colour[k]);
    }
}

static double scale_share(double luminance, const double range[2])
{
    return luminance > 0 ? log(luminance / range[0]) / log(range[1] / range[0]) : 0;
}

static double scale_place(const struct tone_scale *scale, double luminance)
{
    return scale->bottom - scale_share(luminance, scale->range) * (scale->bottom - scale->top);
}

/*
 * A mark: mark 0 is the lower end, mark 1 the upper one, and others whole decades.
 *
 * Result    its luminance; NaN: no such mark, or another one is too near
 */
static double scale_mark(const struct tone_scale *scale, int mark)
{
    const double *range = scale->range;
    const int first = (int)ceil(log10(range[0]) - 1e-9), last = (int)floor(log10(range[1]) + 1e-9);
    const double least = APART * scale->digit;
    const double decade = scale_place(scale, 1) - scale_place(scale, 10);
    const int step = (int)fmax(1, ceil(least / decade));
    if (mark > 1) {
        const int at = first + (mark - 2) * step;
        return at <= last ? pow(10, at) : (double)NAN;
    }
    const int nearest = mark == 0 ? first : first + (last - first) / step * step;
    const double away =
        first > last ? INFINITY
                     : fabs(scale_place(scale, pow(10, nearest)) - scale_place(scale, range[mark]));
    return away > least ? range[mark] : (double)NAN;
}

enum { MARKS_MOST = 700 }; /* decades that a double has */

static const char *mark_words(double luminance, struct arena *arena)
{
    return arena_printf(arena, "%.6g", luminance);
}

/* How wide the scale of a picture is, px. */
static double scale_width(const struct tone_scale *scale, struct arena *arena)
{
    double widest = lettering_width("cd/m²", scale->digit);
    for (int mark = 0; mark < MARKS_MOST; mark++) {
        const double luminance = scale_mark(scale, mark);
        if (!isnan(luminance)) {
            widest = fmax(widest, lettering_width(mark_words(luminance, arena), scale->digit));
        } else if (mark > 1) {
            break;
        }
    }
    return ceil((BESIDE + BAR + BEFORE_MARKS + BEHIND) * scale->digit + widest);
}

/* The bar beside the picture: its lower end is the lowest luminance. */
static void draw_colour_scale(struct image *picture, const struct tone_scale *scale,
                              struct arena *arena)
{
    const double digit = scale->digit, words = scale->right + BEFORE_MARKS * digit;
    for (size_t y = (size_t)scale->top; (double)y < scale->bottom; y++) {
        const double share = (scale->bottom - (double)y - 0.5) / (scale->bottom - scale->top);
        for (size_t x = (size_t)scale->left; (double)x < scale->right; x++) {
            put_colour(share, image_row(picture, y) + CHANNELS * x);
        }
    }
    lettering_write(picture, words, UNIT_LINE * digit, digit, "cd/m²");
    for (int mark = 0; mark < MARKS_MOST; mark++) {
        const double luminance = scale_mark(scale, mark);
        if (isnan(luminance)) {
            if (mark > 1) {
                break;
            }
            continue;
        }
        const double y = scale_place(scale, luminance);
        const size_t line = (size_t)fmin(fmax(y, 0), (double)picture->height - 1);
        for (size_t x = (size_t)scale->right; (double)x < scale->right + TICK * digit; x++) {
            for (size_t k = 0; k < CHANNELS; k++) {
                image_row(picture, line)[CHANNELS * x + k] = 1;
            }
        }
        lettering_write(picture, words, y + digit / 2, digit, mark_words(luminance, arena));
    }
}

/*
 * Luminance in false colours, with a scale beside it.
 *
 * Given     range    of the scale, cd/m^2
 * Result    picture  as wide as the light where it is too low for a scale
 */
static bool tone_falsecolor(const struct image *light, const double range[2], struct arena *arena,
                            struct image *picture, struct error *error)
{
    const double high = (double)light->height, legible = fmin(DIGIT_LEGIBLE, DIGIT_MOST * high);
    const double digit = fmax(legible, round(DIGIT * high));
    struct tone_scale scale = {.range = range,
                               .digit = digit,
                               .top = round(TOP * digit),
                               .bottom = round(high - BOTTOM * digit)};
    const bool has_scale = light->height >= LEAST_HEIGHT;
    scale.left = (double)light->width + round(BESIDE * digit);
    scale.right = scale.left + round(BAR * digit);
    *picture = *light;
    picture->width += has_scale ? (size_t)scale_width(&scale, arena) : 0;
    if (!image_new(picture, arena, error)) {
        return false;
    }
    for (size_t y = 0; y < light->height; y++) {
        const float *from = image_row(light, y);
        float *to = image_row(picture, y);
        for (size_t x = 0; x < light->width; x++) {
            put_colour(scale_share((double)sight_luminance(from + CHANNELS * x), range),
                       to + CHANNELS * x);
        }
    }
    if (has_scale) {
        draw_colour_scale(picture, &scale, arena);
    }
    return true;
}

/* The scale that is asked for, or the decades that hold the picture, down to six below the top. */
static bool colour(const struct tone_input *input, struct image *image, struct text_buffer *remarks,
                   struct error *error)
{
    struct image picture;
    double range[2] = {INFINITY, 0};
    for (size_t i = 0; i < image->width * image->height; i++) {
        const double luminance = (double)sight_luminance(image->pixels + FRAME_CHANNELS * i);
        range[0] = luminance > 0 ? fmin(range[0], luminance) : range[0];
        range[1] = fmax(range[1], luminance);
    }
    if (!(range[1] > 0) && input->scale == NULL) {
        return fail(error, ERROR_DOMAIN, "all is black: there is no luminance to be shown");
    }
    range[1] = pow(10, ceil(log10(range[1]) - 1e-9));
    range[0] = fmin(fmax(pow(10, floor(log10(range[0]) + 1e-9)), range[1] * 1e-6), range[1] / 10);
    if (input->scale != NULL && !read_luminances("scale", input->scale, range, error)) {
        return false;
    }
    growing_format(remarks,
                   "colours from %.6g to %.6g cd/m2, by the logarithm; %.3g %% of the pixels lie "
                   "beyond\n",
                   range[0], range[1], share_beyond(image, range));
    if (!tone_falsecolor(image, range, remarks->arena, &picture, error)) {
        return false;
    }
    if (picture.width == image->width) {
        growing_format(remarks, "warning: the picture is too low for a scale beside it\n");
    }
    *image = picture;
    return true;
}

/* -------- a file -------- */

static bool picture_make(const struct artifact_job *job, struct image *image,
                         struct text_buffer *remarks, struct error *error)
{
    const struct tone_input *input = job->inputs[0];
    const bool is_shown = !input->falsecolor && asked_of(job) != ASKED_NONE;
    struct foveal foveal = {.columns = 0};
    if (is_shown || input->glare || input->acuity) {
        foveal = foveal_look(image, input->view, remarks->arena);
    }
    if (needs_view(job)) {
        /* In places of about a degree; no place is smaller than a pixel. */
        const double across =
            2 * atan(fmax(foveal.cell[0], foveal.cell[1]) / 2) / RADIANS_PER_DEGREE;
        growing_format(
            remarks,
            "the eye looks about in %zu x %zu places of %.2g deg; the view is %.4g deg wide\n",
            foveal.columns, foveal.rows, across, input->view / RADIANS_PER_DEGREE);
        if (across > LARGE_CELL) {
            growing_format(remarks,
                           "warning: the picture has too few pixels for places of 1 degree\n");
        } else if (foveal.columns * foveal.rows < FEW_CELLS) {
            growing_format(remarks, "warning: so small a view has few places of 1 degree\n");
        }
    }
    /* In the order in which the eye does it. */
    struct arena *const arena = remarks->arena;
    struct image seen;
    if (input->acuity) {
        if (!acuity_blur(&foveal, image, arena, &seen, error)) {
            return false;
        }
        *image = seen;
    }
    if (input->glare) {
        const struct foveal_grid grid = foveal_veil(&foveal, image, remarks->arena);
        if (grid.columns != foveal.columns || grid.rows != foveal.rows) {
            growing_format(remarks,
                           "light is scattered between %zu x %zu larger places, to save time\n",
                           grid.columns, grid.rows);
        }
    }
    if (input->color_loss) {
        acuity_fade(image);
    }
    render_note(image, remarks->arena, "Software", "lenscalc " LENSCALC_VERSION);
    if (!is_png(job)) {
        render_note(image, remarks->arena, "Unit", "cd/m2");
    }
    return input->falsecolor ? colour(input, image, remarks, error)
                             : !is_shown || picture_show(job, &foveal, image, remarks, error);
}

bool tone_picture(const struct artifact_job *job, struct output *sink, struct error *error)
{
    const struct tone_input *input = job->inputs[0];
    struct tone_light *light;
    struct text_buffer remarks = {.arena = job->run->kept};
    struct text bytes;
    if (!tone_light_of(job, &light, error)) {
        return false;
    }
    const struct image_way way = {.bits = input->bits == 0 ? 8 : (int)input->bits,
                                  .half = input->bits == 16,
                                  .values = IMAGE_LIGHT,
                                  .packed = true};
    assert(!light->is_taken);
    light->is_taken = true;
    struct image image = light->image;
    growing_text(&remarks, light->remarks);
    if (!picture_make(job, &image, &remarks, error) ||
        !image_file_bytes(&image, job->type, &way, job->run->kept, &bytes, error)) {
        return false;
    }
    output_text(sink, bytes.start, bytes.length);
    sink->remarks = growing_done(&remarks);
    return true;
}
