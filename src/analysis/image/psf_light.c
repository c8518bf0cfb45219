/* analysis/image/psf_light.c - the light of one wavelength, as a sum of waves. */
/* SPDX-License-Identifier: MIT */
#include "analysis/image/psf_light.h"

#include "analysis/image/psf_points.h"
#include "base/constants.h"
#include "base/instruction_set.h"
#include "base/parallel.h"

#include <math.h>
#include <string.h>

/* Wavelets may be off so many turns. */
static const double fine = 1e-8;

static const struct psf_kernels *kernels(void)
{
    static const struct psf_kernels *const sets[] = {NULL, &psf_kernels_sse2, &psf_kernels_avx2,
                                                     &psf_kernels_avx512};
    return sets[instruction_set_best(SET_BEST)];
}

/* Room for a row of pixels, and as many more as a kernel wants. */
static struct psf_row new_row(size_t size, struct arena *arena)
{
    const size_t count = (size + PSF_LANES - 1) / PSF_LANES * PSF_LANES;
    return (struct psf_row){ARENA_ARRAY(arena, count, double), ARENA_ARRAY(arena, count, double),
                            count};
}

static void clear_row(const struct psf_row *row)
{
    memset(row->re, 0, row->count * sizeof row->re[0]);
    memset(row->im, 0, row->count * sizeof row->im[0]);
}

/* -------- plane waves -------- */

/* A wave is that of its x times that of its y: rows of a line's points, then lines of rows. */
bool psf_by_plane(struct psf_plane *plane, struct error *error)
{
    const struct psf_kernels *kernel = kernels();
    const size_t size = plane->size;
    const double wave = plane->pupil->n * plane->pupil->waves * plane->pitch;
    const double first = -(double)(size / 2);
    struct psf_points points;
    if (!psf_points_put(plane, &points, error)) {
        return false;
    }
    const struct psf_row line = new_row(size, plane->arena), up = new_row(size, plane->arena);
    const struct psf_row used = {line.re, line.im, size};
    for (size_t k = 0, i = 0; k < points.lines; k++) {
        if (i == points.ends[k]) {
            continue;
        }
        const double t = points.at[i][1] * wave;
        clear_row(&line);
        for (; i < points.ends[k]; i++) {
            const double s = points.at[i][0] * wave;
            const struct psf_wave one = {points.amplitudes[i], points.waves[i] - s * first, -s};
            kernel->add_wave(&one, &line);
        }
        clear_row(&up);
        kernel->add_wave(&(struct psf_wave){1, -t * first, -t}, &up);
        for (size_t y = 0; y < size; y++) {
            const struct psf_row row = {plane->re + y * size, plane->im + y * size, size};
            kernel->add_row(&used, up.re[y], up.im[y], &row);
        }
    }
    plane->perfect = points.total;
    return true;
}

/* -------- wavelets -------- */

/* Cubics through Chebyshev's nodes. */
static struct psf_steps steps_of(size_t rows)
{
    /* differences at 0 of 1, j, j^2 and j^3 */
    static const double powers[PSF_NODES][PSF_NODES] = {
        {1, 0, 0, 0}, {0, 1, 1, 1}, {0, 0, 2, 6}, {0, 0, 0, 6}};
    struct psf_steps steps = {.rows = rows};
    for (size_t k = 0; k < PSF_NODES; k++) {
        const double node = cos(PI * ((double)k + 0.5) / PSF_NODES);
        steps.at[k] = ((double)rows * (1 + node) - 1) / 2;
    }
    for (size_t k = 0; k < PSF_NODES; k++) {
        double monomials[PSF_NODES];
        /* Monomials of the Lagrange polynomial of one of the nodes. */
        double over = 1, sums[PSF_NODES] = {1}; /* of the products of other nodes, by how many */
        for (size_t i = 0, count = 0; i < PSF_NODES; i++) {
            if (i != k) {
                over *= steps.at[k] - steps.at[i];
                count++;
                for (size_t j = count; j > 0; j--) {
                    sums[j] += sums[j - 1] * steps.at[i];
                }
            }
        }
        for (size_t j = 0; j < PSF_NODES; j++) {
            const size_t others = PSF_NODES - 1 - j;
            monomials[j] = (others % 2 == 0 ? 1 : -1) * sums[others] / over;
        }
        for (size_t m = 0; m < PSF_NODES; m++) {
            for (size_t power = 0; power < PSF_NODES; power++) {
                steps.differences[m][k] += powers[m][power] * monomials[power];
            }
        }
    }
    return steps;
}

/*
 * How many rows a cubic is good for: it leaves L^4/3072 of the fourth slope of r over a length L,
 * which is 3/r^3 at most, as r^2 is c^2 + s^2 along a line, and the slope 3 c^2 (4 s^2 - c^2)/r^7.
 */
static size_t rows_at_once(const struct psf_plane *plane, double radius, double waves)
{
    const double half = 0.5 * (double)plane->size * plane->pitch;
    const double near = fmax(radius - sqrt(2) * half, 0);
    const double length = sqrt(sqrt(1024 * fine * near * near * near / waves));
    const double rows = floor(fmin(length / plane->pitch, PSF_ROWS_MOST));
    const size_t parts = (plane->size + (size_t)fmax(rows, 1) - 1) / (size_t)fmax(rows, 1);
    return (plane->size + parts - 1) / parts;
}

/* All wavelets over some columns. */
static void add_strip(const struct psf_plane *plane, const struct psf_points *points,
                      const struct psf_strip *strip)
{
    const struct psf_kernels *kernel = kernels();
    const struct opd_reference *sphere = &plane->pupil->reference->opd;
    const double waves = plane->pupil->n * plane->pupil->waves;
    const size_t rows = rows_at_once(plane, sphere->radius, waves);
    for (size_t first = 0; first < plane->size; first += rows) {
        const size_t left = plane->size - first;
        const struct psf_steps steps = steps_of(left < rows ? left : rows);
        const struct psf_strip part = {strip->x, strip->y + (double)first * plane->pitch,
                                       plane->pitch, strip->re + first * PSF_LANES,
                                       strip->im + first * PSF_LANES};
        for (size_t i = 0; i < points->count; i++) {
            const struct psf_wavelet one = {
                .amplitude = points->amplitudes[i],
                .turns = points->waves[i],
                .waves = sphere->side * waves,
                .radius = sphere->radius,
                .bx = sphere->side * sphere->radius * points->at[i][0],
                .by = sphere->side * sphere->radius * points->at[i][1],
            };
            kernel->add_wavelet(&one, &steps, &part);
        }
    }
}

/* What threads add to a plane. */
struct psf_light_columns {
    struct psf_plane *plane;
    const struct psf_points *points;
};

/* Strips of columns. */
static void psf_light_add_columns(void *context, const struct parallel_piece *piece)
{
    const struct psf_light_columns *columns = context;
    const struct psf_plane *plane = columns->plane;
    const size_t size = plane->size, room = size * PSF_LANES;
    const double first = -(double)(size / 2) * plane->pitch;
    const struct arena_mark mark = arena_mark(piece->arena);
    for (size_t i = piece->begin; i < piece->end; i++) {
        const size_t x = i * PSF_LANES;
        const struct psf_strip strip = {.x = first + (double)x * plane->pitch,
                                        .y = first,
                                        .re = ARENA_ARRAY(piece->arena, room, double),
                                        .im = ARENA_ARRAY(piece->arena, room, double)};
        add_strip(plane, columns->points, &strip);
        for (size_t y = 0; y < size; y++) {
            for (size_t l = 0; l < PSF_LANES && x + l < size; l++) {
                plane->re[y * size + x + l] = strip.re[y * PSF_LANES + l];
                plane->im[y * size + x + l] = strip.im[y * PSF_LANES + l];
            }
        }
        arena_reset(piece->arena, mark);
    }
}

bool psf_by_huygens(struct psf_plane *plane, struct error *error)
{
    struct psf_points points;
    const struct opd_reference *reference = &plane->pupil->reference->opd;
    if (reference->is_plane || isinf(reference->radius)) {
        return fail(error, ERROR_DOMAIN,
                    "the %s lies infinitely far away, wavelets are plane: {method} plane",
                    reference->is_plane ? "image" : "exit pupil");
    }
    if (!psf_points_put(plane, &points, error)) {
        return false;
    }
    struct parallel *parallel = ARENA_NEW(plane->arena, struct parallel);
    struct psf_light_columns columns = {plane, &points};
    parallel->threads = plane->threads;
    parallel_pieces(parallel, (plane->size + PSF_LANES - 1) / PSF_LANES, 1, psf_light_add_columns,
                    &columns);
    parallel_free(parallel);
    plane->perfect = points.total;
    return true;
}
