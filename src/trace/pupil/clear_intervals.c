/* trace/pupil/clear_intervals.c - where lines enter and leave what blocks light. */
/* SPDX-License-Identifier: MIT */
#include "trace/pupil/clear_intervals.h"

#include <math.h>

const struct clear_intervals clear_intervals_whole = {.count = 1, .low = {0}, .high = {1}};

enum { CHANGES = 2 * CLEAR_INTERVALS_MOST, CLOSER = 8 };

/* A point of a line, and how deep it lies within what blocks. */
struct line_point {
    double t, depth;
    size_t part;
};

/* Between two points of a line the light changes. */
struct light_change {
    size_t line;
    double low, high; /* shares of the way */
    bool darkens;
    size_t part; /* of the edge that is crossed: of the point that is dark */
};

/* Lines being cut. */
struct line_cut {
    const struct clearances *margins;
    const double *centre;
    const double (*ends)[2];
    struct light_change changes[RAYS_BLOCK];
    size_t count;
};

static void cut_place(const struct line_cut *cutting, size_t line, double t, double at[2])
{
    for (int k = 0; k < 2; k++) {
        at[k] = cutting->centre[k] + t * (cutting->ends[line][k] - cutting->centre[k]);
    }
}

/* As many points as a block has, from one share of the way to another. */
static void cut_trace_points(const struct line_cut *cutting, size_t line, double from, double to,
                             struct line_point *spots)
{
    double at[RAYS_BLOCK][2], depth[RAYS_BLOCK];
    size_t part[RAYS_BLOCK];
    for (int i = 0; i < RAYS_BLOCK; i++) {
        spots[i].t = from + (to - from) * ((double)i / (RAYS_BLOCK - 1));
        cut_place(cutting, line, spots[i].t, at[i]);
    }
    clearances_depth(cutting->margins, (const double(*)[2])at, RAYS_BLOCK, depth, part);
    for (int i = 0; i < RAYS_BLOCK; i++) {
        spots[i].depth = depth[i];
        spots[i].part = part[i];
    }
}

/* May the light change and change back between the neighbours of this point? */
static bool may_hide(const struct line_point *spot)
{
    double sign = spot->depth > 0 ? -1 : 1, here = sign * spot->depth;
    double before = sign * spot[-1].depth, after = sign * spot[1].depth;
    double steepest = fmax(here - before, here - after);
    return before <= here && after <= here && here + steepest > 0;
}

/* The changes from point to point; `most` of them at most. */
static void note_changes(struct line_cut *cutting, size_t line, const struct line_point *spots,
                         size_t count, size_t most)
{
    for (size_t i = 0; i + 1 < count && cutting->count < most; i++) {
        const struct line_point *a = &spots[i], *b = &spots[i + 1];
        bool dark = a->depth > 0, darkens = b->depth > 0;
        if (dark != darkens) {
            cutting->changes[cutting->count++] =
                (struct light_change){line, a->t, b->t, darkens, darkens ? b->part : a->part};
        }
    }
}

static void add_margin_number(size_t *all, size_t number)
{
    *all = *all * 1000003 + number;
}

/* From the changes of one line to its clear parts. */
static void clear_intervals_join(const struct light_change *changes, size_t count, size_t begins,
                                 struct clear_intervals *intervals)
{
    double from = 0;
    bool dark = begins > 0;
    *intervals = (struct clear_intervals){.part = 0};
    if (dark) {
        add_margin_number(&intervals->part, 1);
    }
    for (size_t i = 0; i < count; i++) {
        double t = changes[i].darkens ? changes[i].low : changes[i].high;
        add_margin_number(&intervals->part, 2 * changes[i].part + changes[i].darkens);
        if (changes[i].darkens && intervals->count < CLEAR_INTERVALS_MOST) {
            intervals->low[intervals->count] = from;
            intervals->high[intervals->count++] = t;
        }
        from = t;
        dark = changes[i].darkens;
    }
    if (!dark && intervals->count < CLEAR_INTERVALS_MOST) {
        intervals->low[intervals->count] = from;
        intervals->high[intervals->count++] = 1;
    }
}

void clear_intervals_find(const struct clearances *margins, const double centre[2],
                          const double (*ends)[2], size_t count, struct clear_intervals *intervals)
{
    struct line_cut cutting = {.margins = margins, .centre = centre, .ends = ends};
    size_t found[RAYS_BLOCK], begins[RAYS_BLOCK];
    for (size_t done = 0; done < count;) {
        size_t lines = 0;
        cutting.count = 0;
        /* as many lines as there is room for the changes of */
        while (done + lines < count && lines < RAYS_BLOCK &&
               cutting.count + CHANGES <= RAYS_BLOCK) {
            /* one line: coarse, and again where something may hide; it may begin dark */
            const size_t line = done + lines;
            struct line_point spots[RAYS_BLOCK], closer[RAYS_BLOCK];
            size_t first = cutting.count, most = first + CHANGES, from = 0, closely = 0;
            cut_trace_points(&cutting, line, 0, 1, spots);
            begins[lines] = spots[0].depth > 0 ? spots[0].part : 0;
            for (size_t i = 1; i + 1 < RAYS_BLOCK && closely < CLOSER; i++) {
                if (i > from && may_hide(&spots[i])) {
                    note_changes(&cutting, line, spots + from, i - from, most);
                    cut_trace_points(&cutting, line, spots[i - 1].t, spots[i + 1].t, closer);
                    note_changes(&cutting, line, closer, RAYS_BLOCK, most);
                    from = i + 1;
                    closely++;
                }
            }
            note_changes(&cutting, line, spots + from, RAYS_BLOCK - from, most);
            found[lines] = cutting.count - first;
            lines++;
        }
        /* all changes at once */
        double at[RAYS_BLOCK][2], depth[RAYS_BLOCK];
        size_t part[RAYS_BLOCK];
        /* from 1/127 of the line to 1e-15 of it */
        for (int step = 0; step < 43 && cutting.count > 0; step++) {
            for (size_t i = 0; i < cutting.count; i++) {
                const struct light_change *change = &cutting.changes[i];
                cut_place(&cutting, change->line, (change->low + change->high) / 2, at[i]);
            }
            clearances_depth(cutting.margins, (const double(*)[2])at, cutting.count, depth, part);
            for (size_t i = 0; i < cutting.count; i++) {
                struct light_change *change = &cutting.changes[i];
                double middle = (change->low + change->high) / 2;
                bool dark = depth[i] > 0;
                change->part = dark ? part[i] : change->part;
                if (dark == change->darkens) {
                    change->high = middle;
                } else {
                    change->low = middle;
                }
            }
        }
        const struct light_change *changes = cutting.changes;
        for (size_t i = 0; i < lines; i++) {
            clear_intervals_join(changes, found[i], begins[i], &intervals[done + i]);
            changes += found[i];
        }
        done += lines;
    }
}
