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

/* Which rows a point of the film lies between, and where. */
struct between {
    int node, next; /* the first row of two, in a column and in the next one */
    double share, turn;
};

/* What stands at `place` of each row, `stride` numbers apart; `is_grid`: has columns. */
INLINE double between(bool is_grid, const struct between *at, const double *all, int stride,
                      int place)
{
    int i = at->node * stride + place;
    double from = all[i], here = from + at->share * (all[i + stride] - from);
    if (is_grid) {
        int j = at->next * stride + place;
        double other = all[j], beside = other + at->share * (all[j + stride] - other);
        here += at->turn * (beside - here);
    }
    return here;
}

/* A direction, its y outwards from the pole, and how much of all a unit of u and v is. */
struct direction {
    double x, y, area;
};

/* A ring of the region and a place in it: a sector from a to b, its share w. */
struct place {
    int k;
    double w, v;
};

/* Between a centre and the polygon. */
INLINE struct direction in_sector(const struct film_region *region, bool is_grid,
                                  const struct between *at, struct place to)
{
    double x = is_grid ? between(is_grid, at, region->centre[0], 1, 0) : 0;
    double y = between(is_grid, at, region->centre[1], 1, 0);
    double ax = between(is_grid, at, region->outer[0], FILM_CORNERS, to.k) - x;
    double ay = between(is_grid, at, region->outer[1], FILM_CORNERS, to.k) - y;
    double bx = between(is_grid, at, region->outer[0], FILM_CORNERS, to.k + 1) - x;
    double by = between(is_grid, at, region->outer[1], FILM_CORNERS, to.k + 1) - y;
    double t = sqrt(to.v);
    return (struct direction){x + t * (ax + to.w * (bx - ax)), y + t * (ay + to.w * (by - ay)),
                              0.5 * FILM_SECTORS * fabs(ax * by - bx * ay)};
}

/* Between two polygons. */
INLINE struct direction in_ring(const struct film_region *region, bool is_grid,
                                const struct between *at, struct place to)
{
    double ax = between(is_grid, at, region->inner[0], FILM_CORNERS, to.k);
    double ay = between(is_grid, at, region->inner[1], FILM_CORNERS, to.k);
    double bx = between(is_grid, at, region->inner[0], FILM_CORNERS, to.k + 1);
    double by = between(is_grid, at, region->inner[1], FILM_CORNERS, to.k + 1);
    double cx = between(is_grid, at, region->outer[0], FILM_CORNERS, to.k) - ax;
    double cy = between(is_grid, at, region->outer[1], FILM_CORNERS, to.k) - ay;
    double dx = between(is_grid, at, region->outer[0], FILM_CORNERS, to.k + 1) - bx;
    double dy = between(is_grid, at, region->outer[1], FILM_CORNERS, to.k + 1) - by;
    double hole = region->ratio, w = to.w, r = sqrt(hole * hole + (1 - hole * hole) * to.v);
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

/* The column that a point lies in, and how far from it to the next one: struct film_region. */
INLINE double column_of(double x, double y, double h)
{
    double over = 1 / (fabs(x) + fabs(y));
    double turn = y >= 0 ? 1 - x * over : 3 + x * over;
    return (h > 0 ? turn : 1) * (0.25 * FILM_COLUMNS);
}

INLINE void start(const struct film_region *region, bool is_grid, bool has_hole,
                  const struct film_samples *samples, struct started *started, int i)
{
    double x = samples->x[i] - region->pole[0], y = samples->y[i] - region->pole[1];
    double h = sqrt(x * x + y * y), over = 1 / h, end = region->ends[0];
    bool beside = (h > 0) & region->turns;
    double up_x = beside ? x * over : 0, up_y = beside ? y * over : 1;
    struct between at = {0, 0, 0, 0};
    if (is_grid) {
        double turn = column_of(x, y, h);
        int column = (int)turn;
        column = column < FILM_COLUMNS - 1 ? column : FILM_COLUMNS - 1;
        at.turn = turn - column;
        at.node = column * region->rows;
        end = region->ends[column] + at.turn * (region->ends[column + 1] - region->ends[column]);
    }
    double rest = 1 - h / end;
    bool lit = rest >= 0;
    double rows = (region->rows - 1) * (1 - sqrt(lit ? rest : 0));
    int row = (int)rows;
    row = row < region->rows - 2 ? row : region->rows - 2;
    at.share = rows - row;
    at.node += row;
    at.next = at.node + region->rows;
    double sectors = samples->u[i] * FILM_SECTORS;
    int k = (int)sectors;
    k = k < FILM_SECTORS - 1 ? k : FILM_SECTORS - 1;
    struct place to = {k, sectors - k, samples->v[i]};
    struct direction way =
        has_hole ? in_ring(region, is_grid, &at, to) : in_sector(region, is_grid, &at, to);
    if (is_grid) {
        way.x += region->slope[0] * (x * up_y - y * up_x);
        way.y += region->slope[1] * (x * up_x + y * up_y);
    }
    double left = 1 - (way.x * way.x + way.y * way.y), n = region->index;
    double back = region->film > 0 ? -n : n;
    started->p[i] = n * (way.x * up_y + way.y * up_x);
    started->q[i] = n * (way.y * up_y - way.x * up_x);
    started->r[i] = back * sqrt(left > 0 ? left : 0);
    started->weight[i] = lit ? way.area : 0;
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

INLINE void start_all(const struct film_region *region, bool is_grid, bool has_hole,
                      const struct film_samples *samples, struct started *started)
{
    for (int i = 0; i < RAYS_BLOCK; i++) {
        start(region, is_grid, has_hole, samples, started, i);
    }
}

void NAME(kernel_film, KERNEL)(const struct film_region *region, struct film_samples *samples,
                               struct ray_block *block)
{
    const struct film_region all = *region;
    struct started started;
    if (all.is_grid && all.has_hole) {
        start_all(&all, true, true, samples, &started);
    } else if (all.is_grid) {
        start_all(&all, true, false, samples, &started);
    } else if (all.has_hole) {
        start_all(&all, false, true, samples, &started);
    } else {
        start_all(&all, false, false, samples, &started);
    }
    store(samples, all.film, &started, block);
}
