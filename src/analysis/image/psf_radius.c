/* analysis/image/psf_radius.c - the radius that holds a share of the light of a point's image. */
/* SPDX-License-Identifier: MIT */
#include "analysis/image/psf_radius.h"

#include "base/constants.h"
#include "base/lagrange.h"

#include <math.h>

enum {
    STEPS = 64,     /* a radius at least, where pixels are fine */
    MOST_FINE = 32, /* steps a pixel at most */
    TAPS = LAGRANGE_MOST,
    FEW_TAPS = LAGRANGE_FEW,
    HALVINGS = 30
};

/* What steps and the sums of the waves leave, of the radius. */
static const double least = 1e-4;

/* Values about the centroid; a step may be a pixel. */
struct field {
    const double *values; /* side * side */
    size_t side;
    double middle[2]; /* of the circle, steps from the first value */
    double light;     /* that is sought, in these values */
};

static double field_square(const struct field *field, size_t column, size_t row)
{
    const double x = (double)column - field->middle[0], y = (double)row - field->middle[1];
    return x * x + y * y;
}

/* The values that the rim may cut. */
struct psf_rim {
    double *distances, *values, inner; /* steps; inner: sum of the values within */
    size_t count;
};

/* The ring, a step wide, that the light sought ends in. */
static size_t field_ring(const struct field *field, struct arena *arena)
{
    const size_t side = field->side, rings = 2 * side + 4;
    double *sums = ARENA_ARRAY(arena, rings, double), sum = 0;
    size_t ring = 0;
    for (size_t y = 0; y < side; y++) {
        for (size_t x = 0; x < side; x++) {
            sums[(size_t)sqrt(field_square(field, x, y))] += field->values[y * side + x];
        }
    }
    while (ring < rings && sum + sums[ring] < field->light) {
        sum += sums[ring++];
    }
    return ring;
}

/* The radius, steps, among all values that the rim may cut about that ring. */
static double field_radius(const struct field *field, struct arena *arena)
{
    const struct arena_mark mark = arena_mark(arena);
    const size_t side = field->side, ring = field_ring(field, arena);
    double low = fmax((double)ring - 1, 0.5), high = (double)ring + 2;
    const double within = pow(low - 0.5, 2), beyond = pow(high + 0.5, 2);
    /* no more lie in a ring of 4 steps' width than its area and its edges have room for */
    const size_t room = (size_t)fmin((double)(side * side), 32 * PI * (high + 2));
    struct psf_rim rim = {ARENA_ARRAY(arena, room, double), ARENA_ARRAY(arena, room, double), 0, 0};
    for (size_t y = 0; y < side; y++) {
        for (size_t x = 0; x < side; x++) {
            const double square = field_square(field, x, y), value = field->values[y * side + x];
            if (square <= within) {
                rim.inner += value;
            } else if (square < beyond && rim.count < room) {
                rim.distances[rim.count] = sqrt(square);
                rim.values[rim.count++] = value;
            }
        }
    }
    for (int i = 0; i < HALVINGS; i++) {
        const double middle = (low + high) / 2;
        double sum = rim.inner;
        for (size_t j = 0; j < rim.count; j++) {
            sum += rim.values[j] * fmax(fmin(middle - rim.distances[j] + 0.5, 1), 0);
        }
        const bool is_less = sum < field->light;
        low = is_less ? middle : low;
        high = is_less ? high : middle;
    }
    arena_reset(arena, mark);
    return (low + high) / 2;
}

/* `steps` a pixel within `half` pixels of the middle, by polynomials through `taps` pixels. */
static struct field field_between(const struct field *pixels, size_t steps, double half,
                                  size_t taps, struct arena *arena)
{
    const size_t reach = (size_t)ceil(half * (double)steps), side = 2 * reach + 1;
    const double step = 1 / (double)steps;
    double *rows = ARENA_ARRAY(arena, pixels->side * side, double), factors[TAPS];
    double *values = ARENA_ARRAY(arena, side * side, double);
    const double room = half + TAPS;
    const size_t lowest = (size_t)fmax(pixels->middle[1] - room, 0);
    const size_t end = (size_t)fmin(pixels->middle[1] + room, (double)pixels->side);
    for (size_t x = 0; x < side; x++) {
        const double at = pixels->middle[0] + ((double)x - (double)reach) * step;
        const size_t first = lagrange_factors(at, pixels->side, taps, factors);
        for (size_t y = lowest; y < end; y++) {
            double sum = 0;
            for (size_t j = 0; j < taps; j++) {
                sum += factors[j] * pixels->values[y * pixels->side + first + j];
            }
            rows[y * side + x] = sum;
        }
    }
    for (size_t y = 0; y < side; y++) {
        const double at = pixels->middle[1] + ((double)y - (double)reach) * step;
        const size_t first = lagrange_factors(at, pixels->side, taps, factors);
        for (size_t x = 0; x < side; x++) {
            double sum = 0;
            for (size_t j = 0; j < taps; j++) {
                sum += factors[j] * rows[(first + j) * side + x];
            }
            values[y * side + x] = sum;
        }
    }
    return (struct field){
        values, side, {(double)reach, (double)reach}, pixels->light * (double)(steps * steps)};
}

/* How the radius changes where the circle is about another point, which may be the centroid of all
   light: steps; 0: the point lies as good as there. */
static double change_about(const struct psf *psf, const struct field *pixels, double radius,
                           struct arena *arena)
{
    double most = 0;
    if (!(hypot(psf->centroid_error[0], psf->centroid_error[1]) > least * radius * psf->pitch)) {
        return 0;
    }
    for (int side = -1; side <= 1; side += 2) {
        struct field moved = *pixels;
        for (int k = 0; k < 2; k++) {
            moved.middle[k] += side * psf->centroid_error[k] / psf->pitch;
        }
        most = fmax(most, fabs(field_radius(&moved, arena) - radius));
    }
    return most;
}

void psf_radius_find(struct psf *psf, double light, struct arena *arena)
{
    const struct arena_mark mark = arena_mark(arena);
    const double half = (double)(psf->size / 2);
    const struct field pixels = {
        psf->values,
        psf->size,
        {half + psf->centroid[0] / psf->pitch, half + psf->centroid[1] / psf->pitch},
        light};
    /* From the middle to the nearest side of the image, pixels. */
    double room = INFINITY;
    for (int k = 0; k < 2; k++) {
        const double before = pixels.middle[k] + 0.5;
        room = fmin(room, fmin(before, (double)pixels.side - before));
    }
    const double by_pixels = field_radius(&pixels, arena);
    double radius = by_pixels, error = 2 / sqrt(2 * PI * radius);
    if (!(radius <= room)) {
        arena_reset(arena, mark);
        return;
    }
    if (psf->pitch <= psf->finest / 2 && psf->size >= TAPS) {
        const double steps = fmin(ceil(STEPS / radius), MOST_FINE);
        const double reach = fmin(radius + 2, room - 0.5);
        const struct field fine = field_between(&pixels, (size_t)steps, reach, TAPS, arena);
        const struct field rough = field_between(&pixels, (size_t)steps, reach, FEW_TAPS, arena);
        radius = field_radius(&fine, arena) / steps;
        error = fabs(field_radius(&rough, arena) / steps - radius);
    }
    error += least * radius + change_about(psf, &pixels, by_pixels, arena);
    arena_reset(arena, mark);
    psf->radius80 = radius * psf->pitch;
    psf->radius80_error = error * psf->pitch;
}
