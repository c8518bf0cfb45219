/* camera/kernel_film.c - starting rays on the film: a lane loop for each instruction set. */
/* SPDX-License-Identifier: MIT */
#include "camera/film_rays.h"
#include "trace/lanes.h"

_Static_assert((int)RAYS_BLOCK == (int)SOBOL_BLOCK, "a block of rays takes a block of points");

void NAME(kernel_film_plan, KERNEL)(const struct film_plan *plan, uint32_t block,
                                    struct film_samples *samples)
{
    double points[FILM_DIMENSIONS][RAYS_BLOCK];
    for (int k = 0; k < FILM_DIMENSIONS; k++) {
        sobol_points(&plan->sobol[k], plan->scrambling[k], block, points[k]);
    }
    for (int i = 0; i < RAYS_BLOCK; i++) {
        samples->x[i] = plan->left + plan->width * points[0][i];
        samples->y[i] = plan->bottom + plan->height * points[1][i];
    }
    memcpy(samples->u, points[2], sizeof samples->u);
    memcpy(samples->v, points[3], sizeof samples->v);
}

/* A corner of the region between two of its rows. */
INLINE double between(const double *corners, int place, double share)
{
    double from = corners[place];
    return from + share * (corners[place + FILM_CORNERS] - from);
}

/* A direction from (0, h), and how much of all a unit of u and v is. */
struct direction {
    double x, y, area;
};

/* Between a centre and the polygon. */
INLINE struct direction in_sector(const struct film_region *region, int row, int k, double share,
                                  double w, double v)
{
    int place = row * FILM_CORNERS + k;
    double from = region->centre[row];
    double middle = from + share * (region->centre[row + 1] - from);
    double ax = between(region->outer[0], place, share);
    double ay = between(region->outer[1], place, share) - middle;
    double bx = between(region->outer[0], place + 1, share);
    double by = between(region->outer[1], place + 1, share) - middle;
    double t = sqrt(v);
    return (struct direction){t * (ax + w * (bx - ax)), middle + t * (ay + w * (by - ay)),
                              0.5 * FILM_SECTORS * fabs(ax * by - bx * ay)};
}

/* Between two polygons. */
INLINE struct direction in_ring(const struct film_region *region, int row, int k, double share,
                                double w, double v)
{
    int place = row * FILM_CORNERS + k;
    double ax = between(region->inner[0], place, share);
    double ay = between(region->inner[1], place, share);
    double bx = between(region->inner[0], place + 1, share);
    double by = between(region->inner[1], place + 1, share);
    double cx = between(region->outer[0], place, share) - ax;
    double cy = between(region->outer[1], place, share) - ay;
    double dx = between(region->outer[0], place + 1, share) - bx;
    double dy = between(region->outer[1], place + 1, share) - by;
    double hole = region->ratio, r = sqrt(hole * hole + (1 - hole * hole) * v);
    double t = (r - hole) / (1 - hole), slope = 0.5 * (1 + hole) / r;
    double out_x = cx + w * (dx - cx), out_y = cy + w * (dy - cy);
    double along_x = bx - ax + t * (dx - cx), along_y = by - ay + t * (dy - cy);
    return (struct direction){ax + w * (bx - ax) + t * out_x, ay + w * (by - ay) + t * out_y,
                              FILM_SECTORS * slope * fabs(along_x * out_y - along_y * out_x)};
}

/* Own copies, which the compiler knows to lie apart from all tables. */
struct started {
    double p[RAYS_BLOCK], q[RAYS_BLOCK], r[RAYS_BLOCK], weight[RAYS_BLOCK];
};

INLINE void start(const struct film_region *region, bool has_hole,
                  const struct film_samples *samples, struct started *started, int i)
{
    double x = samples->x[i], y = samples->y[i], h = sqrt(x * x + y * y), over = 1 / h;
    bool beside = h > 0;
    double up_x = beside ? x * over : 0, up_y = beside ? y * over : 1;
    double sectors = samples->u[i] * FILM_SECTORS, rest = 1 - h * region->per_mm;
    bool lit = rest >= 0;
    double rows = (FILM_RADII - 1) * (1 - sqrt(lit ? rest : 0));
    int row = (int)rows, k = (int)sectors;
    row = row < FILM_RADII - 2 ? row : FILM_RADII - 2;
    k = k < FILM_SECTORS - 1 ? k : FILM_SECTORS - 1;
    double share = rows - row, w = sectors - k, v = samples->v[i];
    struct direction at =
        has_hole ? in_ring(region, row, k, share, w, v) : in_sector(region, row, k, share, w, v);
    double left = 1 - (at.x * at.x + at.y * at.y), n = region->index;
    double back = region->film > 0 ? -n : n;
    started->p[i] = n * (at.x * up_y + at.y * up_x);
    started->q[i] = n * (at.y * up_y - at.x * up_x);
    started->r[i] = back * sqrt(left > 0 ? left : 0);
    started->weight[i] = lit ? at.area : 0;
}

INLINE void store(struct film_samples *samples, double film, const struct started *started,
                  struct ray_block *block)
{
    memcpy(block->x, samples->x, sizeof block->x);
    memcpy(block->y, samples->y, sizeof block->y);
    memcpy(block->p, started->p, sizeof block->p);
    memcpy(block->q, started->q, sizeof block->q);
    memcpy(block->r, started->r, sizeof block->r);
    memcpy(samples->weight, started->weight, sizeof samples->weight);
    for (int i = 0; i < RAYS_BLOCK; i++) {
        block->z[i] = film;
        block->path[i] = 0;
        block->lost[i] = 0;
    }
}

void NAME(kernel_film, KERNEL)(const struct film_region *region, struct film_samples *samples,
                               struct ray_block *block)
{
    const struct film_region all = *region;
    struct started started;
    if (all.has_hole) {
        for (int i = 0; i < RAYS_BLOCK; i++) {
            start(&all, true, samples, &started, i);
        }
    } else {
        for (int i = 0; i < RAYS_BLOCK; i++) {
            start(&all, false, samples, &started, i);
        }
    }
    store(samples, all.film, &started, block);
}
