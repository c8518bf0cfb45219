/* trace/pupil/pupil_parts.c - a grid of rays, and which of its cells touch. */
/* SPDX-License-Identifier: MIT */
#include "trace/pupil/pupil_parts.h"

#include "base/constants.h"

#include <math.h>

enum { CELLS = PUPIL_PARTS_SIDE * PUPIL_PARTS_SIDE };

/* A block of rays is a piece of the grid as compact as can be: many of them are dark throughout. */
enum {
    TILE_WIDTH = 16,
    TILE_HEIGHT = RAYS_BLOCK / TILE_WIDTH,
    TILES = PUPIL_PARTS_SIDE / TILE_WIDTH
};

/* Where the pupil lies and no less than twice as far; where the object's side is not limited 4. */
static const double least = 2, unlimited = 4;

void pupil_parts_bound(const struct clearances *margins, double low[2], double high[2])
{
    enum { AROUND = 16 };
    const struct stop_beam *beam = margins->beam;
    const struct clearance *first = &margins->all[0];
    bool limited = first->place == 1 && isfinite(first->clear2) && !beam->has_disc;
    for (int k = 0; k < 2; k++) {
        double far = limited ? least : unlimited;
        if (beam->has_disc) {
            far = 1;
        }
        low[k] = -far;
        high[k] = far;
    }
    for (int i = 0; i < AROUND && limited; i++) {
        double angle = 2 * PI * i / AROUND, radius = sqrt(first->clear2);
        double at[2], point[2];
        beam_place(beam->beam, (double[3]){1.1 * radius * cos(angle), 1.1 * radius * sin(angle), 0},
                   at);
        /* from coordinates in the beam to u and v, for rays named by them */
        const double *m = beam->axes, det = m[0] * m[3] - m[1] * m[2];
        const double a = at[0] - beam->origin[0], b = at[1] - beam->origin[1];
        point[0] = (m[3] * a - m[1] * b) / det;
        point[1] = (m[0] * b - m[2] * a) / det;
        for (int k = 0; k < 2 && isfinite(point[0] + point[1]); k++) {
            low[k] = fmin(low[k], point[k]);
            high[k] = fmax(high[k], point[k]);
        }
    }
}

void pupil_parts_point(const struct pupil_parts *parts, size_t cell, double point[2])
{
    point[0] = parts->low[0] + (double)(cell % PUPIL_PARTS_SIDE) * parts->step[0];
    point[1] = parts->low[1] + (double)(cell / PUPIL_PARTS_SIDE) * parts->step[1];
}

/* Give the number of a part to all clear cells that touch one of it. */
static void pupil_parts_flood(struct pupil_parts *parts, size_t first, unsigned short number)
{
    unsigned short waiting[CELLS];
    size_t count = 0;
    parts->part[first] = number;
    waiting[count++] = (unsigned short)first;
    while (count > 0) {
        const size_t cell = waiting[--count], x = cell % PUPIL_PARTS_SIDE,
                     y = cell / PUPIL_PARTS_SIDE;
        for (size_t i = 0; i < 9; i++) {
            const size_t beside = x + i % 3, below = y + i / 3; /* more by one */
            if (beside < 1 || beside > PUPIL_PARTS_SIDE || below < 1 || below > PUPIL_PARTS_SIDE) {
                continue;
            }
            const size_t other = (below - 1) * PUPIL_PARTS_SIDE + beside - 1;
            if (parts->excess[other] <= 0 && parts->part[other] == 0) {
                parts->part[other] = number;
                waiting[count++] = (unsigned short)other;
            }
        }
    }
}

static void number_parts(struct pupil_parts *parts)
{
    parts->count = 0;
    for (size_t i = 0; i < CELLS; i++) {
        parts->part[i] = 0;
    }
    for (size_t i = 0; i < CELLS; i++) {
        if (parts->excess[i] <= 0 && parts->part[i] == 0) {
            pupil_parts_flood(parts, i, (unsigned short)++parts->count);
        }
    }
}

/* The i-th cell of a tile. */
static size_t tile_cell(size_t tile, size_t i)
{
    size_t x = tile % TILES * TILE_WIDTH + i % TILE_WIDTH;
    size_t y = tile / TILES * TILE_HEIGHT + i / TILE_WIDTH;
    return y * PUPIL_PARTS_SIDE + x;
}

void pupil_parts_find(const struct clearances *margins, const double low[2], const double high[2],
                      struct pupil_parts *parts)
{
    double from[2], to[2], points[RAYS_BLOCK][2];
    pupil_parts_bound(margins, from, to);
    for (int k = 0; k < 2; k++) {
        from[k] = low != NULL ? low[k] : from[k];
        to[k] = high != NULL ? high[k] : to[k];
        parts->step[k] = (to[k] - from[k]) / PUPIL_PARTS_SIDE;
        parts->low[k] = from[k] + parts->step[k] / 2;
    }
    for (size_t tile = 0; tile < CELLS / RAYS_BLOCK; tile++) {
        for (size_t i = 0; i < RAYS_BLOCK; i++) {
            pupil_parts_point(parts, tile_cell(tile, i), points[i]);
        }
        clearances_sift(margins, (const double(*)[2])points, RAYS_BLOCK);
        for (size_t i = 0; i < RAYS_BLOCK; i++) {
            parts->excess[tile_cell(tile, i)] = margins->excess[i];
        }
    }
    number_parts(parts);
}

bool pupil_parts_middle(const struct pupil_parts *parts, double point[2])
{
    size_t sizes[CELLS + 1] = {0};
    size_t largest = 0, best = CELLS;
    for (size_t i = 0; i < CELLS; i++) {
        sizes[parts->part[i]]++;
    }
    sizes[0] = 0; /* dark */
    for (size_t i = 1; i <= parts->count; i++) {
        largest = sizes[i] > sizes[largest] ? i : largest;
    }
    for (size_t i = 0; i < CELLS && largest > 0; i++) {
        if (parts->part[i] == largest &&
            (best == CELLS || parts->excess[i] < parts->excess[best])) {
            best = i;
        }
    }
    if (largest > 0) {
        pupil_parts_point(parts, best, point);
    }
    return largest > 0;
}
