/* tests/truth/clear_region.h - for clear_sums.c: what passes of a beam, as a grid sees it. */
/* SPDX-License-Identifier: MIT */
#ifndef CLEAR_REGION_H
#define CLEAR_REGION_H

#include "clear_rays.h"

#include <string.h>

enum { SIDE = 160 };

struct region {
    double low[2], cell[2], middle[2], chief[2], farthest, islands;
    int part[SIDE][SIDE];
    int whole; /* the part that is summed */
};

static void cell_at(const struct region *region, int i, int j, double at[2])
{
    at[0] = region->low[0] + (i + 0.5) * region->cell[0];
    at[1] = region->low[1] + (j + 0.5) * region->cell[1];
}

/* Result: how many cells pass; `box` receives where. */
static int fill_grid(const struct beam *beam, struct region *region, int box[4])
{
    int count = 0;
    box[0] = box[1] = SIDE;
    box[2] = box[3] = -1;
    for (int i = 0; i < SIDE; i++) {
        for (int j = 0; j < SIDE; j++) {
            double at[2];
            cell_at(region, i, j, at);
            region->part[i][j] = limit_of(beam, at[0], at[1]) == 0 ? -1 : 0;
            if (region->part[i][j] != 0) {
                box[0] = i < box[0] ? i : box[0];
                box[1] = j < box[1] ? j : box[1];
                box[2] = i > box[2] ? i : box[2];
                box[3] = j > box[3] ? j : box[3];
                count++;
            }
        }
    }
    return count;
}

/* Number the cells that are joined to one by their sides. Result: how many there are. */
static int join(struct region *region, int i, int j, int number)
{
    static int stack[SIDE * SIDE][2];
    int waiting = 0, count = 0;
    stack[waiting][0] = i;
    stack[waiting++][1] = j;
    region->part[i][j] = number;
    while (waiting > 0) {
        static const int sides[4][2] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}};
        const int at[2] = {stack[waiting - 1][0], stack[waiting - 1][1]};
        waiting--;
        count++;
        for (int k = 0; k < 4; k++) {
            const int a = at[0] + sides[k][0], b = at[1] + sides[k][1];
            if (a >= 0 && a < SIDE && b >= 0 && b < SIDE && region->part[a][b] == -1) {
                region->part[a][b] = number;
                stack[waiting][0] = a;
                stack[waiting++][1] = b;
            }
        }
    }
    return count;
}

/* The ray through the middle of the stop, from the one of a part that passes nearest to it. */
static bool find_chief(const struct beam *beam, struct region *region, int part)
{
    double best = INFINITY, *at = region->chief;
    for (int i = 0; i < SIDE * SIDE; i++) {
        double here[2];
        cell_at(region, i / SIDE, i % SIDE, here);
        if (region->part[i / SIDE][i % SIDE] == part) {
            const struct passage ray = look(beam, here[0], here[1], true);
            const double miss = hypot(ray.at_stop[0], ray.at_stop[1]);
            if (miss < best) {
                best = miss;
                memcpy(at, here, sizeof here);
            }
        }
    }
    for (int turns = 0; turns < 30; turns++) {
        const double h = 1e-4 * region->cell[0];
        const struct passage here = look(beam, at[0], at[1], true);
        const struct passage a = look(beam, at[0] + h, at[1], true);
        const struct passage b = look(beam, at[0], at[1] + h, true);
        const double m[4] = {
            (a.at_stop[0] - here.at_stop[0]) / h, (b.at_stop[0] - here.at_stop[0]) / h,
            (a.at_stop[1] - here.at_stop[1]) / h, (b.at_stop[1] - here.at_stop[1]) / h};
        const double det = m[0] * m[3] - m[1] * m[2];
        best = here.arrives ? hypot(here.at_stop[0], here.at_stop[1]) : INFINITY;
        if (!(best > 1e-12 * stop_radius) || !isfinite(det)) {
            break;
        }
        at[0] -= (m[3] * here.at_stop[0] - m[1] * here.at_stop[1]) / det;
        at[1] -= (m[0] * here.at_stop[1] - m[2] * here.at_stop[0]) / det;
    }
    return best <= 1e-9 * stop_radius;
}

/* Number the parts. Result: how many; sizes: of each, from 1 on. */
static int number_parts(struct region *region, int *sizes)
{
    int count = 0;
    for (int i = 0; i < SIDE * SIDE; i++) {
        if (region->part[i / SIDE][i % SIDE] == -1) {
            count++;
            sizes[count] = join(region, i / SIDE, i % SIDE, count);
        }
    }
    return count;
}

/* The largest part that has a ray through the middle of the stop within it, else the largest. */
static bool choose(const struct beam *beam, struct region *region)
{
    static int sizes[SIDE * SIDE / 2 + 2];
    const int count = number_parts(region, sizes);
    bool has_chief = false, any_chief = false;
    int all = 0, own = 0, largest = 1;
    double chief[2] = {0, 0};
    region->whole = 0;
    for (int part = 1; part <= count; part++) {
        all += sizes[part];
        largest = sizes[part] > sizes[largest] ? part : largest;
        const bool found = find_chief(beam, region, part);
        const double x = (region->chief[0] - region->low[0]) / region->cell[0];
        const double y = (region->chief[1] - region->low[1]) / region->cell[1];
        const bool within = found && x >= 0 && y >= 0 && x < SIDE && y < SIDE &&
                            region->part[(int)x][(int)y] == part;
        const bool is_larger = !has_chief || sizes[part] > sizes[region->whole];
        if ((found && !any_chief) || (within && is_larger)) {
            memcpy(chief, region->chief, sizeof chief);
            region->whole = within ? part : 0;
            has_chief = has_chief || within;
            any_chief = true;
        }
    }
    memcpy(region->chief, chief, sizeof chief);
    region->whole = region->whole > 0 ? region->whole : largest;
    double sum[2] = {0, 0}, at[2];
    for (int i = 0; i < SIDE * SIDE; i++) {
        if (region->part[i / SIDE][i % SIDE] == region->whole) {
            cell_at(region, i / SIDE, i % SIDE, at);
            sum[0] += at[0];
            sum[1] += at[1];
            own++;
        }
    }
    /* what mirrors itself is seen so but for single cells */
    region->middle[0] = fabs(sum[0] / own) < 2 * region->cell[0] ? 0 : sum[0] / own;
    region->middle[1] = sum[1] / own;
    region->islands = (double)(all - own) / all;
    region->farthest = 0;
    for (int i = 0; i < SIDE * SIDE; i++) {
        if (region->part[i / SIDE][i % SIDE] == region->whole) {
            cell_at(region, i / SIDE, i % SIDE, at);
            region->farthest =
                fmax(region->farthest, hypot(at[0] - region->middle[0], at[1] - region->middle[1]));
        }
    }
    region->farthest += 1.5 * hypot(region->cell[0], region->cell[1]);
    return any_chief;
}

/* The whole width at once; where nothing passes tile by tile, ever finer: some pupils are small. */
static bool begin(const struct beam *beam, double width, struct region *region)
{
    int box[4];
    for (int tiles = 1; tiles <= 16; tiles *= 4) {
        for (int i = 0; i < tiles * tiles; i++) {
            region->cell[0] = region->cell[1] = 2 * width / tiles / SIDE;
            region->low[0] = -width + i / tiles * 2 * width / tiles;
            region->low[1] = -width + i % tiles * 2 * width / tiles;
            if (fill_grid(beam, region, box) == 0) {
                continue;
            }
            /* a tile about what passes of this one: it may go on beyond its sides */
            for (int k = 0; k < 2 && tiles > 1; k++) {
                region->low[k] += ((box[k] + box[2 + k] + 1) / 2.0 - SIDE / 2.0) * region->cell[k];
            }
            return true;
        }
    }
    return false;
}

/* Coarse to fine, until what passes fills most of the grid. */
static bool find_region(const struct beam *beam, double width, struct region *region,
                        bool *has_chief)
{
    if (!begin(beam, width, region)) {
        return false;
    }
    for (int turns = 0; turns < 24; turns++) {
        int box[4];
        if (fill_grid(beam, region, box) == 0) {
            return false;
        }
        bool is_cut = false;
        for (int k = 0; k < 2; k++) {
            const bool is_below = box[k] == 0, is_above = box[2 + k] == SIDE - 1;
            region->low[k] -= is_below ? SIDE / 2 * region->cell[k] : 0;
            region->cell[k] *= 1 + (is_below ? 0.5 : 0) + (is_above ? 0.5 : 0);
            is_cut = is_cut || is_below || is_above;
        }
        if (is_cut) {
            continue;
        }
        if (box[2] - box[0] > SIDE / 2 && box[3] - box[1] > SIDE / 2) {
            break;
        }
        for (int k = 0; k < 2; k++) {
            const double from = region->low[k] + (box[k] - 2) * region->cell[k];
            region->cell[k] *= (double)(box[2 + k] - box[k] + 5) / SIDE;
            region->low[k] = from;
        }
    }
    *has_chief = choose(beam, region);
    return true;
}

#endif
