/* camera/film/kernel_film.c - starting rays on the film: a lane loop for each instruction set. */
/* SPDX-License-Identifier: MIT */
#include "camera/film/film_rays.h"
#include "trace/kernel/lanes.h"

_Static_assert((int)RAYS_BLOCK == (int)SOBOL_BLOCK, "a block of rays takes a block of points");

void NAME(kernel_film_plan, KERNEL)(const struct film_plan *plan, const unsigned char *cells,
                                    uint32_t block, struct film_samples *samples)
{
    const double right = plan->left + plan->width, bottom = plan->bottom;
    const double across = plan->width / FILM_ACROSS, down = plan->height / FILM_DOWN;
    double points[FILM_DIMENSIONS][RAYS_BLOCK];
    for (int k = 0; k < FILM_DIMENSIONS; k++) {
        sobol_points(&plan->sobol[k], plan->scrambling[k], block, points[k]);
    }
    for (int i = 0; i < RAYS_BLOCK && cells == NULL; i++) {
        samples->x[i] = plan->left + plan->width * points[0][i];
        samples->y[i] = bottom + plan->height * points[1][i];
    }
    for (int i = 0; i < RAYS_BLOCK && cells != NULL; i++) {
        samples->x[i] = right - across * (cells[i] % FILM_ACROSS + points[0][i]);
        samples->y[i] = bottom + down * (cells[i] / FILM_ACROSS + points[1][i]);
    }
    memcpy(samples->u, points[2], sizeof samples->u);
    memcpy(samples->v, points[3], sizeof samples->v);
}

/*
 * Where the region is read, for each ray: as loops of their own, for what stands in tables comes by
 * one ray after another, and only the rest in vectors.
 */
struct region_lookup {
    int node[RAYS_BLOCK], corner[RAYS_BLOCK];   /* the first of two rows; the corner of it */
    double share[RAYS_BLOCK], turn[RAYS_BLOCK]; /* to the next row, and the next column */
    double w[RAYS_BLOCK];                       /* from one corner to the next */
    double lit[RAYS_BLOCK];                     /* 1 where light arrives, or 0 */
    double up_x[RAYS_BLOCK], up_y[RAYS_BLOCK];
    double middle[RAYS_BLOCK][2];                      /* x, y */
    double outer[RAYS_BLOCK][4], inner[RAYS_BLOCK][4]; /* those of both corners */
};

/* The column that a point lies in, and how far from it to the next one: struct exit_pupil_bounds.
   */
INLINE double kernel_film_column_of(double x, double y, double h)
{
    double over = 1 / (fabs(x) + fabs(y));
    double turn = y >= 0 ? 1 - x * over : 3 + x * over;
    return (h > 0 ? turn : 1) * (0.25 * FILM_COLUMNS);
}

INLINE void kernel_film_place(const struct exit_pupil_bounds *region, bool is_grid,
                              const struct film_samples *samples, struct region_lookup *reading,
                              int i)
{
    double x = samples->x[i] - region->pole[0], y = samples->y[i] - region->pole[1];
    double h = sqrt(x * x + y * y), over = 1 / h, per_mm = region->per_mm;
    bool beside = (h > 0) & region->turns;
    int first = 0;
    if (is_grid) {
        double turn = kernel_film_column_of(x, y, h);
        int column = (int)turn;
        column = column < FILM_COLUMNS - 1 ? column : FILM_COLUMNS - 1;
        double end = region->ends[column], next = region->ends[column + 1];
        reading->turn[i] = turn - column;
        per_mm = 1 / (end + (turn - column) * (next - end));
        first = column * region->rows;
    }
    double rest = 1 - h * per_mm;
    bool lit = rest >= 0;
    double rows = (region->rows - 1) * (1 - sqrt(lit ? rest : 0));
    int row = (int)rows;
    row = row < region->rows - 2 ? row : region->rows - 2;
    double sectors = samples->u[i] * FILM_SECTORS;
    int k = (int)sectors;
    k = k < FILM_SECTORS - 1 ? k : FILM_SECTORS - 1;
    reading->up_x[i] = beside ? x * over : 0;
    reading->up_y[i] = beside ? y * over : 1;
    reading->share[i] = rows - row;
    reading->w[i] = sectors - k;
    reading->lit[i] = lit ? 1 : 0;
    reading->node[i] = first + row;
    reading->corner[i] = (first + row) * FILM_CORNERS + k;
}

/* So many numbers side by side, between two rows and with columns between two of these. */
INLINE void kernel_film_interpolate(bool is_grid, const double *all, int stride, int rows,
                                    int count, double share, double turn, double *found)
{
    for (int j = 0; j < count; j++) {
        double from = all[j], to = all[j + stride], here = from + share * (to - from);
        if (is_grid) {
            double low = all[j + rows * stride], high = all[j + (rows + 1) * stride];
            here += turn * (low + share * (high - low) - here);
        }
        found[j] = here;
    }
}

INLINE void kernel_film_look_up(const struct exit_pupil_bounds *region, bool is_grid, bool has_hole,
                                struct region_lookup *reading)
{
    const int rows = region->rows, stride = 2 * FILM_CORNERS;
    for (int i = 0; i < RAYS_BLOCK; i++) {
        double share = reading->share[i], turn = is_grid ? reading->turn[i] : 0;
        int corner = 2 * reading->corner[i];
        kernel_film_interpolate(is_grid, region->outer_xy + corner, stride, rows, 4, share, turn,
                                reading->outer[i]);
        if (has_hole) {
            kernel_film_interpolate(is_grid, region->inner_xy + corner, stride, rows, 4, share,
                                    turn, reading->inner[i]);
        } else {
            kernel_film_interpolate(is_grid, region->centre_xy + 2 * reading->node[i], 2, rows, 2,
                                    share, turn, reading->middle[i]);
        }
    }
}

/* A direction, its y outwards from the pole, and how much of all a unit of u and v is. */
struct direction {
    double x, y, area;
};

/* Between a centre and the polygon. */
INLINE struct direction in_sector(const struct region_lookup *reading, double v, int i)
{
    double x = reading->middle[i][0], y = reading->middle[i][1], w = reading->w[i];
    double ax = reading->outer[i][0] - x, ay = reading->outer[i][1] - y;
    double bx = reading->outer[i][2] - x, by = reading->outer[i][3] - y;
    double t = sqrt(v);
    return (struct direction){x + t * (ax + w * (bx - ax)), y + t * (ay + w * (by - ay)),
                              0.5 * FILM_SECTORS * fabs(ax * by - bx * ay)};
}

/* Between two polygons; `hole`: how much one is of the other. */
INLINE struct direction in_ring(const struct region_lookup *reading, double hole, double v, int i)
{
    double ax = reading->inner[i][0], ay = reading->inner[i][1];
    double bx = reading->inner[i][2], by = reading->inner[i][3], w = reading->w[i];
    double cx = reading->outer[i][0] - ax, cy = reading->outer[i][1] - ay;
    double dx = reading->outer[i][2] - bx, dy = reading->outer[i][3] - by;
    double r = sqrt(hole * hole + (1 - hole * hole) * v);
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

INLINE void kernel_film_start(const struct exit_pupil_bounds *region, bool is_grid, bool has_hole,
                              const struct film_samples *samples,
                              const struct region_lookup *reading, struct started *started, int i)
{
    double up_x = reading->up_x[i], up_y = reading->up_y[i], v = samples->v[i];
    struct direction way =
        has_hole ? in_ring(reading, region->ratio, v, i) : in_sector(reading, v, i);
    if (is_grid) {
        double x = samples->x[i] - region->pole[0], y = samples->y[i] - region->pole[1];
        way.x += region->slope[0] * (x * up_y - y * up_x);
        way.y += region->slope[1] * (x * up_x + y * up_y);
    }
    double left = 1 - (way.x * way.x + way.y * way.y), n = region->index;
    double back = region->film > 0 ? -n : n;
    started->p[i] = n * (way.x * up_y + way.y * up_x);
    started->q[i] = n * (way.y * up_y - way.x * up_x);
    started->r[i] = back * sqrt(left > 0 ? left : 0);
    started->weight[i] = reading->lit[i] * way.area;
}

/* What was found are tangents: cosines of them, and their areas as projected solid angles. */
INLINE void turn_tangents(const struct exit_pupil_bounds *region, struct started *started)
{
    double n = region->index, back = region->film > 0 ? -n : n;
    for (int i = 0; i < RAYS_BLOCK; i++) {
        double x = started->p[i] / n, y = started->q[i] / n;
        double cosine2 = 1 / (1 + x * x + y * y), cosine = sqrt(cosine2);
        started->p[i] *= cosine;
        started->q[i] *= cosine;
        started->r[i] = back * cosine;
        started->weight[i] *= cosine2 * cosine2;
    }
}

INLINE void kernel_film_store(struct film_samples *samples, double film,
                              const struct started *started, struct ray_block *block)
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

INLINE void kernel_film_start_all(const struct exit_pupil_bounds *region, bool is_grid,
                                  bool has_hole, const struct film_samples *samples,
                                  struct started *started)
{
    struct region_lookup reading;
    for (int i = 0; i < RAYS_BLOCK; i++) {
        kernel_film_place(region, is_grid, samples, &reading, i);
    }
    kernel_film_look_up(region, is_grid, has_hole, &reading);
    for (int i = 0; i < RAYS_BLOCK; i++) {
        kernel_film_start(region, is_grid, has_hole, samples, &reading, started, i);
    }
}

void NAME(kernel_film, KERNEL)(const struct exit_pupil_bounds *region, struct film_samples *samples,
                               struct ray_block *block)
{
    const struct exit_pupil_bounds all = *region;
    struct started started;
    if (all.is_grid && all.has_hole) {
        kernel_film_start_all(&all, true, true, samples, &started);
    } else if (all.is_grid) {
        kernel_film_start_all(&all, true, false, samples, &started);
    } else if (all.has_hole) {
        kernel_film_start_all(&all, false, true, samples, &started);
    } else {
        kernel_film_start_all(&all, false, false, samples, &started);
    }
    if (all.tangent > 0) {
        turn_tangents(&all, &started);
    }
    kernel_film_store(samples, all.film, &started, block);
}

/* -------- through a disc -------- */

INLINE void kernel_disc_aim(const struct disc *disc, const struct film_samples *samples,
                            struct started *aimed, int i)
{
    double x = samples->x[i], y = samples->y[i], h = sqrt(x * x + y * y), over = 1 / h;
    bool beside = h > 0;
    double up_x = beside ? x * over : 0, up_y = beside ? y * over : 1;
    double sectors = samples->u[i] * DISC_SECTORS, t = sqrt(samples->v[i]);
    int k = (int)sectors;
    k = k < DISC_SECTORS - 1 ? k : DISC_SECTORS - 1;
    const double *from = disc->corners[k], *to = disc->corners[k + 1];
    double w = sectors - k;
    double right = t * (from[0] + w * (to[0] - from[0]));
    double up = t * (from[1] + w * (to[1] - from[1]));
    double dx = right * up_y + up * up_x - x, dy = up * up_y - right * up_x - y;
    double z = disc->place - disc->film, p2 = dx * dx + dy * dy + z * z;
    /* towards the lens, also where the pupil lies on the other side of the film */
    double n = (disc->film * z > 0 ? -disc->index : disc->index) / sqrt(p2);
    aimed->p[i] = dx * n;
    aimed->q[i] = dy * n;
    aimed->r[i] = z * n;
    aimed->weight[i] = disc->area * (z * z) / (p2 * p2);
}

void NAME(kernel_disc, KERNEL)(const struct disc *disc, struct film_samples *samples,
                               struct ray_block *block)
{
    struct started aimed;
    for (int i = 0; i < RAYS_BLOCK; i++) {
        kernel_disc_aim(disc, samples, &aimed, i);
    }
    kernel_film_store(samples, disc->film, &aimed, block);
}
