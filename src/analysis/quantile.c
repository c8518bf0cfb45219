/* analysis/quantile.c - within which distance so much of the light of a sample lies. */
/* SPDX-License-Identifier: MIT */
#include "analysis/quantile.h"

#include "trace/sample.h"

#include <math.h>
#include <stdlib.h>

struct quantile_arms quantile_arms_open(size_t arms, size_t rings, struct arena *arena)
{
    struct quantile_arms all = {.arms = arms, .rings = rings};
    if (arms > 0) {
        all.places = ARENA_ARRAY(arena, rings, double);
        all.shares = ARENA_ARRAY(arena, rings, double);
        all.last = ARENA_ARRAY(arena, arms, size_t);
        gauss_rule(rings, all.places, all.shares);
    }
    return all;
}

void quantile_arms_add(const struct quantile_arms *arms, size_t ray, struct quantile_mark *marks,
                       size_t mark)
{
    if (mark != QUANTILE_ALONE) {
        marks[mark].beside[0] = marks[mark].beside[1] = QUANTILE_ALONE;
    }
    if (arms->arms == 0) {
        return;
    }
    const size_t ring = ray / arms->arms % arms->rings;
    size_t *last = &arms->last[ray % arms->arms];
    if (mark != QUANTILE_ALONE) {
        marks[mark].place = arms->places[ring];
        marks[mark].share = arms->shares[ring];
        if (ring > 0 && *last != QUANTILE_ALONE) {
            marks[mark].beside[0] = *last;
            marks[*last].beside[1] = mark;
        }
    }
    *last = mark;
}

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

/* Light between two distances; along it the radius in the pupil goes as evenly as the distance. */
struct piece {
    double low, high, weight;
    double radius[2]; /* where the distance is low, and high */
};

static struct piece piece_between(double here, double there, double radius, double other,
                                  double weight)
{
    return here < there ? (struct piece){here, there, weight, {radius, other}}
                        : (struct piece){there, here, weight, {other, radius}};
}

/* What lies between a mark and its neighbour, or the end of the arm. */
static struct piece piece_of(const struct quantile_mark *marks, size_t i, int side)
{
    const struct quantile_mark *mark = &marks[i];
    const size_t beside = mark->beside[side], other = mark->beside[1 - side];
    const double density = mark->weight / mark->share, radius = sqrt(mark->place);
    if (beside != QUANTILE_ALONE) {
        /* from both sides: half of it each time */
        const struct quantile_mark *next = &marks[beside];
        const double mean = (density + next->weight / next->share) / 2;
        return piece_between(mark->distance, next->distance, radius, sqrt(next->place),
                             mean * fabs(next->place - mark->place) / 2);
    }
    /* as far as the arm goes; where a ray beside it is lost, as far as its own share */
    const double left = fmin(side == 1 ? 1 - mark->place : mark->place, mark->share);
    const double edge = sqrt(fmax(mark->place + (side == 1 ? left : -left), 0));
    double end = mark->distance;
    if (other != QUANTILE_ALONE) {
        const struct quantile_mark *last = &marks[other];
        const double slope = (mark->distance - last->distance) / (radius - sqrt(last->place));
        end = fabs(end + slope * (edge - radius));
    }
    return piece_between(mark->distance, end, radius, edge, density * left);
}

/* How much of a piece lies within a distance: light goes by the area in the pupil. */
static double part_within(const struct piece *piece, double distance)
{
    if (!(distance < piece->high)) {
        return 1;
    }
    if (!(distance > piece->low)) {
        return 0;
    }
    const double from = piece->radius[0], to = piece->radius[1];
    const double gone = (to - from) * (distance - piece->low) / (piece->high - piece->low);
    return gone * (2 * from + gone) / ((to - from) * (to + from));
}

static double share_within(const struct piece *pieces, size_t count, double distance)
{
    double sum = 0;
    for (size_t i = 0; i < count; i++) {
        sum += pieces[i].weight * part_within(&pieces[i], distance);
    }
    return sum;
}

/* The same where rays lie on arms. */
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
