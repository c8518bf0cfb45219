/* scene/environment_light.c - environment lights: skies and pictures, importance sampled. */
/* SPDX-License-Identifier: MIT */
#include "scene/environment_light.h"

#include "base/constants.h"
#include "light/colour.h"
#include "scene/discrete.h"
#include "scene/sky.h"

/* Of a sky; its horizon lies between two rows. */
enum { SKY_ROWS = 90, SKY_COLUMNS = 180 };

bool is_environment_light(const struct scene_light *light)
{
    return (light->kind == LIGHT_SKY || light->kind == LIGHT_ENVIRONMENT) && light->amount > 0;
}

/* -------- where a direction lies -------- */

/* In the picture's own axes, and back: turned about y. */
static struct vector environment_turned(const struct environment_light *around, struct vector a,
                                        double sign)
{
    const double c = around->cosine, s = sign * around->sine;
    return (struct vector){c * a.x + s * a.z, a.y, c * a.z - s * a.x};
}

/* From the left and from the top, 0 to 1. */
static void environment_place(const struct environment_light *around, struct vector direction,
                              double place[2])
{
    const struct vector own = environment_turned(around, direction, -1);
    const double across = sqrt(own.x * own.x + own.z * own.z);
    place[0] = 0.5 + atan2(own.x, -own.z) / (2 * PI);
    place[1] = atan2(across, own.y) / PI;
}

static struct vector way_at(const struct environment_light *around, double left, double cosine)
{
    const double sine = sqrt(fmax(0, 1 - cosine * cosine)), angle = 2 * PI * (left - 0.5);
    const struct vector own = {sine * sin(angle), cosine, -sine * cos(angle)};
    return environment_turned(around, vector_unit(own), 1);
}

/* Cosine of the zenith distance above a row; exact in the middle and at the ends. */
static double cosine_above(const struct environment_light *around, size_t row)
{
    return sin(PI * (0.5 - (double)row / (double)around->rows));
}

static double cell_solid_angle(const struct environment_light *around, size_t row)
{
    return 2 * PI / (double)around->columns *
           (cosine_above(around, row) - cosine_above(around, row + 1));
}

/* -------- how bright it is there -------- */

static const float *environment_pixel(const struct image *picture, long column, long row)
{
    const long width = (long)picture->width, height = (long)picture->height;
    const long above = row < height ? row : height - 1, y = above > 0 ? above : 0;
    return image_row(picture, (size_t)y) + (size_t)((column + width) % width) * picture->channels;
}

/* Between the middles of four pixels, all round; beyond the first and last row as these are. */
static void environment_bilinear(const struct image *picture, const double place[2], double rgb[3])
{
    const double x = place[0] * (double)picture->width - 0.5;
    const double y = place[1] * (double)picture->height - 0.5;
    const long left = (long)floor(x), top = (long)floor(y);
    const double shares[2] = {x - (double)left, y - (double)top};
    const float *corners[4];
    for (int i = 0; i < 4; i++) {
        corners[i] = environment_pixel(picture, left + i % 2, top + i / 2);
    }
    for (int c = 0; c < 3; c++) {
        const double upper = corners[0][c] + shares[0] * ((double)corners[1][c] - corners[0][c]);
        const double lower = corners[2][c] + shares[0] * ((double)corners[3][c] - corners[2][c]);
        rgb[c] = upper + shares[1] * (lower - upper);
    }
}

/* Mean over a pixel of what lies between it and its neighbours: nowhere 0 where there is light. */
static double picture_mean(const struct image *picture, size_t row, size_t column)
{
    static const double shares[3] = {0.125, 0.75, 0.125};
    double mean = 0;
    for (int y = 0; y < 3; y++) {
        for (int x = 0; x < 3; x++) {
            const float *rgb = environment_pixel(picture, (long)column + x - 1, (long)row + y - 1);
            mean +=
                shares[y] * shares[x] * colour_luminance((const double[3]){rgb[0], rgb[1], rgb[2]});
        }
    }
    return mean;
}

static double sky_mean(const struct environment_light *around, size_t row, size_t column)
{
    double mean = 0;
    for (int i = 0; i < 4; i++) {
        const double left = ((double)column + 0.25 + 0.5 * (i % 2)) / (double)around->columns;
        const double down = ((double)row + 0.25 + 0.5 * (i / 2)) / (double)around->rows;
        const struct vector direction = way_at(around, left, cos(PI * down));
        mean += sky_share(around->light->sky, around->light->direction, direction) / 4;
    }
    return mean;
}

/* -------- chances -------- */

/* Sums of what comes before, as shares of all; nothing of a row without light. */
static double sums_of(const double *weights, size_t count, float *sums)
{
    double all = 0, before = 0;
    for (size_t i = 0; i < count; i++) {
        all += weights[i];
    }
    for (size_t i = 0; i < count; i++) {
        sums[i] = (float)(all > 0 ? before / all : (double)i / (double)count);
        before += weights[i];
    }
    sums[count] = 1;
    return all;
}

struct environment_light environment_light_open(const struct scene_light *light,
                                                const struct banded *unit, struct arena *arena)
{
    const double turn = light->kind == LIGHT_SKY ? 0 : light->turn;
    struct environment_light around = {
        .light = light, .unit = unit, .cosine = cos(turn), .sine = sin(turn)};
    const bool is_sky = around.light->kind == LIGHT_SKY;
    around.rows = is_sky ? SKY_ROWS : around.light->picture->height;
    around.columns = is_sky ? SKY_COLUMNS : around.light->picture->width;
    const size_t line = around.columns + 1;
    float *across = arena_buffer_array(arena, around.rows, line * sizeof(float));
    float *down = ARENA_ARRAY(arena, around.rows + 1, float);
    struct arena spare = arena_within(arena);
    double *weights = ARENA_ARRAY(&spare, around.columns, double);
    double *of_rows = ARENA_ARRAY(&spare, around.rows, double);
    for (size_t row = 0; row < around.rows; row++) {
        for (size_t column = 0; column < around.columns; column++) {
            weights[column] =
                around.light->amount * (around.light->kind == LIGHT_SKY
                                            ? sky_mean(&around, row, column)
                                            : picture_mean(around.light->picture, row, column));
        }
        of_rows[row] =
            sums_of(weights, around.columns, across + row * line) * cell_solid_angle(&around, row);
    }
    around.total = sums_of(of_rows, around.rows, down);
    around.down = down;
    around.across = across;
    arena_free(&spare);
    return around;
}

/* As pick_of. */
static struct discrete_sample pick_share(const float *sums, size_t count, double u)
{
    size_t low = 0, high = count;
    while (high - low > 1) {
        const size_t middle = low + (high - low) / 2;
        if ((double)sums[middle] <= u) {
            low = middle;
        } else {
            high = middle;
        }
    }
    return (struct discrete_sample){
        low, discrete_remainder(u, (double)sums[low], (double)sums[low + 1])};
}

struct vector environment_light_sample(const struct environment_light *around, double u, double v)
{
    const struct discrete_sample row = pick_share(around->down, around->rows, v);
    const float *across = around->across + row.index * (around->columns + 1);
    const struct discrete_sample column = pick_share(across, around->columns, u);
    const double top = cosine_above(around, row.index);
    const double bottom = cosine_above(around, row.index + 1);
    return way_at(around, ((double)column.index + column.remainder) / (double)around->columns,
                  top + row.remainder * (bottom - top));
}

double environment_light_pdf(const struct environment_light *around, struct vector direction)
{
    double place[2];
    environment_place(around, direction, place);
    const size_t row = discrete_step(place[1], around->rows);
    const float *at =
        around->across + row * (around->columns + 1) + discrete_step(place[0], around->columns);
    const float *down = around->down + row;
    return ((double)down[1] - (double)down[0]) * ((double)at[1] - (double)at[0]) /
           cell_solid_angle(around, row);
}

void environment_light_add(const struct environment_light *around, const struct bands *bands,
                           struct vector direction, const struct lanes *lanes,
                           struct radiance *light)
{
    double rgb[3] = {1, 1, 1}, share = 1;
    if (around->light->kind == LIGHT_SKY) {
        share = sky_share(around->light->sky, around->light->direction, direction);
    } else {
        double place[2];
        environment_place(around, direction, place);
        environment_bilinear(around->light->picture, place, rgb);
    }
    for (size_t k = 0; k < lanes->count; k++) {
        const double *basis = bands->basis[lanes->band[k]];
        light->of[k] += share * (around->unit->of[lanes->band[k]] * around->light->amount) *
                        (rgb[0] * basis[0] + rgb[1] * basis[1] + rgb[2] * basis[2]);
    }
}
