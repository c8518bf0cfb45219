/* tone/acuity.c - a picture as sharp, and as coloured, as an eye sees it in its light. */
/* SPDX-License-Identifier: MIT */
#include "tone/acuity.h"

#include "base/constants.h"
#include "tone/sight.h"

#include <math.h>

enum { CHANNELS = 3, LEVELS_MOST = 18 };

struct level {
    struct image image;
    double scale[2]; /* its pixels across and down over those of the picture */
    double octaves;  /* log2 of its pixels' side over the shorter one of the picture's */
};

/*
 * A picture, if its pixels are not square one whose are, and smaller ones of means of four pixels
 * of the one before.
 */
struct pyramid {
    struct level levels[LEVELS_MOST];
    int count;
};

/* Means of so many pixels across and down, of parts of them, too. */
static bool acuity_shrink(const struct image *from, const double box[2], struct arena *arena,
                          struct image *to, struct error *error)
{
    const double enough = 1e-9; /* of a box: less at the edge is rounding */
    const double size[] = {(double)from->width, (double)from->height};
    *to = (struct image){.width = (size_t)ceil(size[0] / box[0] - enough),
                         .height = (size_t)ceil(size[1] / box[1] - enough),
                         .channels = CHANNELS};
    if (!image_new(to, arena, error)) {
        return false;
    }
    for (size_t i = 0; i < to->width * to->height; i++) {
        const double left = (double)(i % to->width) * box[0], right = fmin(left + box[0], size[0]);
        const double top = (double)(i / to->width) * box[1], bottom = fmin(top + box[1], size[1]);
        double sum[CHANNELS] = {0};
        for (size_t y = (size_t)top; (double)y < bottom; y++) {
            const double high = fmin(bottom, (double)y + 1) - fmax(top, (double)y);
            for (size_t x = (size_t)left; (double)x < right; x++) {
                const double share = high * (fmin(right, (double)x + 1) - fmax(left, (double)x));
                for (size_t k = 0; k < CHANNELS; k++) {
                    sum[k] += share * (double)image_row(from, y)[x * CHANNELS + k];
                }
            }
        }
        for (size_t k = 0; k < CHANNELS; k++) {
            to->pixels[i * CHANNELS + k] = (float)(sum[k] / ((right - left) * (bottom - top)));
        }
    }
    return true;
}

static bool acuity_halve(const struct image *from, struct arena *arena, struct image *to,
                         struct error *error)
{
    *to = (struct image){
        .width = (from->width + 1) / 2, .height = (from->height + 1) / 2, .channels = CHANNELS};
    if (!image_new(to, arena, error)) {
        return false;
    }
    for (size_t y = 0; y < to->height; y++) {
        const float *above = image_row(from, 2 * y);
        const float *below = image_row(from, 2 * y + 1 < from->height ? 2 * y + 1 : 2 * y);
        float *row = image_row(to, y);
        for (size_t x = 0; x < to->width; x++) {
            const size_t left = 2 * x * CHANNELS;
            const size_t right = 2 * x + 1 < from->width ? left + CHANNELS : left;
            for (size_t k = 0; k < CHANNELS; k++) {
                row[x * CHANNELS + k] = 0.25F * (above[left + k] + above[right + k] +
                                                 below[left + k] + below[right + k]);
            }
        }
    }
    return true;
}

/* A share of a level's light at a pixel of the whole picture, between its pixels. */
static void acuity_add_level(const struct pyramid *pyramid, int level, const double at[2],
                             float share, float light[CHANNELS])
{
    const struct image *image = &pyramid->levels[level].image;
    const double *scale = pyramid->levels[level].scale;
    const double x = fmin(fmax((at[0] + 0.5) * scale[0] - 0.5, 0), (double)image->width - 1);
    const double y = fmin(fmax((at[1] + 0.5) * scale[1] - 0.5, 0), (double)image->height - 1);
    const size_t left = (size_t)x, above = (size_t)y;
    const size_t right = left + (left + 1 < image->width ? 1 : 0);
    const size_t below = above + (above + 1 < image->height ? 1 : 0);
    const float u = (float)(x - (double)left), v = (float)(y - (double)above);
    const float *a = image_row(image, above), *b = image_row(image, below);
    for (size_t k = 0; k < CHANNELS; k++) {
        const float up = a[left * CHANNELS + k] * (1 - u) + a[right * CHANNELS + k] * u;
        const float down = b[left * CHANNELS + k] * (1 - u) + b[right * CHANNELS + k] * u;
        light[k] += share * (up * (1 - v) + down * v);
    }
}

static void blur_pixel(const struct pyramid *pyramid, const double at[2], double samples,
                       float light[CHANNELS])
{
    const struct level *levels = pyramid->levels;
    const double octaves = fmin(fmax(log2(samples), 0), levels[pyramid->count - 1].octaves);
    int below = 0;
    while (below + 1 < pyramid->count && levels[below + 1].octaves <= octaves) {
        below++;
    }
    const double beyond = octaves - levels[below].octaves;
    const float rest =
        beyond > 0 ? (float)(beyond / (levels[below + 1].octaves - levels[below].octaves)) : 0;
    light[0] = light[1] = light[2] = 0;
    acuity_add_level(pyramid, below, at, 1 - rest, light);
    if (rest > 0) {
        acuity_add_level(pyramid, below + 1, at, rest, light);
    }
}

static void blur_row(const struct foveal *foveal, const float *samples,
                     const struct pyramid *pyramid, size_t y, float *row)
{
    const struct image *image = &pyramid->levels[0].image;
    for (size_t x = 0; x < image->width; x++) {
        const struct foveal_between place =
            foveal_between(foveal, ((double)x + 0.5) / (double)image->width,
                           ((double)y + 0.5) / (double)image->height);
        float wanted = 0;
        for (int c = 0; c < 4; c++) {
            wanted += place.shares[c] * samples[place.cells[c]];
        }
        blur_pixel(pyramid, (double[]){(double)x, (double)y}, (double)wanted, row + CHANNELS * x);
    }
}

/* Can its smallest picture be made smaller, and is it to be, for so many pixels a sample? */
static bool is_too_fine(const struct pyramid *pyramid, double most)
{
    const struct level *last = &pyramid->levels[pyramid->count - 1];
    return pyramid->count < LEVELS_MOST && last->octaves < log2(most) &&
           (last->image.width > 1 || last->image.height > 1);
}

bool acuity_blur(const struct foveal *foveal, const struct image *image, struct arena *arena,
                 struct image *made, struct error *error)
{
    struct pyramid pyramid = {.levels = {{.image = *image, .scale = {1, 1}}}, .count = 1};
    const double wide = foveal->cell[0] * (double)foveal->columns / (double)image->width;
    const double pixel = image->aspect > 1 ? wide / image->aspect : wide; /* its shorter side */
    /* pixels a sample that a cell's light asks for: at least 1 */
    double most = 1;
    const double pixels_a_degree = RADIANS_PER_DEGREE / pixel;
    const size_t count = foveal->columns * foveal->rows;
    float *samples = ARENA_ARRAY(arena, count, float);
    for (size_t i = 0; i < count; i++) {
        const double wanted = pixels_a_degree / (2 * sight_acuity(foveal_luminance(foveal, i)));
        samples[i] = (float)fmax(wanted, 1);
        most = fmax(most, wanted);
    }
    *made = *image;
    if (!image_new(made, arena, error)) {
        return false;
    }
    while (is_too_fine(&pyramid, most)) {
        /* the next smaller one, of half as many pixels each way, or of square ones at first */
        const struct level *last = &pyramid.levels[pyramid.count - 1];
        struct level *next = &pyramid.levels[pyramid.count];
        const double aspect = last->image.aspect > 0 ? last->image.aspect : 1;
        const double box[] = {fmax(1 / aspect, 1), fmax(aspect, 1)};
        const bool is_square = last->image.aspect == 0;
        *next = (struct level){.octaves = last->octaves + (is_square ? 1 : log2(box[0] * box[1]))};
        for (int i = 0; i < 2; i++) {
            next->scale[i] = last->scale[i] / (is_square ? 2 : box[i]);
        }
        pyramid.count++;
        if (!(is_square ? acuity_halve(&last->image, arena, &next->image, error)
                        : acuity_shrink(&last->image, box, arena, &next->image, error))) {
            return false;
        }
    }
    for (size_t y = 0; y < image->height; y++) {
        blur_row(foveal, samples, &pyramid, y, image_row(made, y));
    }
    return true;
}

void acuity_fade(struct image *image)
{
    for (size_t i = 0; i < image->width * image->height; i++) {
        float *pixel = image->pixels + CHANNELS * i;
        const double luminance = (double)sight_luminance(pixel);
        if (luminance >= SIGHT_PHOTOPIC) {
            continue;
        }
        const double share =
            fmax(0, (luminance - SIGHT_SCOTOPIC) / (SIGHT_PHOTOPIC - SIGHT_SCOTOPIC));
        const double grey =
            sight_scotopic((double[]){(double)pixel[0], (double)pixel[1], (double)pixel[2]});
        for (int k = 0; k < CHANNELS; k++) {
            pixel[k] = (float)(share * (double)pixel[k] + (1 - share) * grey);
        }
    }
}
