/* analysis/quantile.c - within which distance so much of the light of a sample lies. */
/* SPDX-License-Identifier: MIT */
#include "analysis/quantile.h"

#include <math.h>
#include <stdlib.h>

static int by_distance(const void *first, const void *second)
{
    double a = ((const struct quantile_mark *)first)->distance,
           b = ((const struct quantile_mark *)second)->distance;
    return (a > b) - (a < b);
}

/* The distance within which so much of the weight lies; half of each mark's lies before it. */
static double of_points(struct quantile_mark *marks, size_t count, double share)
{
    double total = 0, before = 0;
    qsort(marks, count, sizeof *marks, by_distance);
    for (size_t i = 0; i < count; i++) {
        total += marks[i].weight;
    }
    const struct quantile_mark *last = NULL;
    for (size_t i = 0; i < count; i++) {
        const struct quantile_mark *mark = &marks[i];
        double middle = before + mark->weight / 2;
        if (middle >= share * total) {
            double from = last != NULL ? before - last->weight / 2 : 0;
            double low = last != NULL ? last->distance : 0;
            return low + (mark->distance - low) * (share * total - from) / (middle - from);
        }
        before += mark->weight;
        last = mark;
    }
    return last->distance;
}

/* Some of the light, evenly spread between two distances. */
struct piece {
    double low, high, weight;
};

/* What a mark stands for on one side: to half-way to its neighbour, or as far the other way. */
static struct piece piece_of(const struct quantile_mark *marks, size_t i, int side)
{
    const struct quantile_mark *mark = &marks[i];
    const size_t beside = mark->beside[side], other = mark->beside[1 - side];
    const double here = mark->distance;
    double end = beside != QUANTILE_ALONE  ? (here + marks[beside].distance) / 2
                 : other != QUANTILE_ALONE ? fabs(here - (marks[other].distance - here) / 2)
                                           : here;
    return (struct piece){fmin(here, end), fmax(here, end), mark->weight / 2};
}

static double share_within(const struct piece *pieces, size_t count, double radius)
{
    double sum = 0;
    for (size_t i = 0; i < count; i++) {
        const struct piece *piece = &pieces[i];
        double width = piece->high - piece->low;
        double part = width > 0 ? (radius - piece->low) / width : radius >= piece->low;
        sum += piece->weight * fmin(fmax(part, 0), 1);
    }
    return sum;
}

/*
 * The same where rays lie on arms: along each the distance is smooth, and light between two rays
 * lies between their distances. So rings do not show as steps.
 */
static double of_arms(const struct quantile_mark *marks, size_t mark_count, double share,
                      struct arena *arena)
{
    enum { TURNS = 60 };
    const size_t count = 2 * mark_count;
    struct piece *pieces = ARENA_ARRAY(arena, count, struct piece);
    double total = 0, low = 0, high = 0;
    for (size_t i = 0; i < count; i++) {
        pieces[i] = piece_of(marks, i / 2, (int)(i % 2));
        total += pieces[i].weight;
        high = fmax(high, pieces[i].high);
    }
    double below = -share * total, above = total + below, last = high;
    for (int turn = 0; turn < TURNS && high - low > 1e-12 * last; turn++) {
        /* every third turn halves: a secant may come from one side only */
        double at = turn % 3 == 2 ? (low + high) / 2 : low - below * (high - low) / (above - below);
        double excess = share_within(pieces, count, at) - share * total;
        low = excess < 0 ? at : low;
        below = excess < 0 ? excess : below;
        high = excess < 0 ? high : at;
        above = excess < 0 ? above : excess;
    }
    return (low + high) / 2;
}

double quantile_of_marks(struct quantile_mark *marks, size_t count, bool has_arms, double share,
                         struct arena *arena)
{
    return has_arms ? of_arms(marks, count, share, arena) : of_points(marks, count, share);
}
