/* trace/aim/continuation.c - Newton's method from place to place of a line in the stop. */
/* SPDX-License-Identifier: MIT */
#include "trace/aim/continuation.h"

#include "trace/aim/chief.h"

#include <math.h>

enum { TURNS = 12 };

/* Steps of a way, in shares of it. */
static const double first_step = 0.25, least_step = 1e-4;

/* What rounding leaves, in radii of the stop. */
static const double exact = 1e-14;

/* One step of a way: Newton's method to a place of the line. */
struct stride {
    double step, share; /* how long, and how far it leads */
    double target[2];   /* in the stop, mm */
    double here[2];     /* what is tried */
    double near[2];     /* the best so far */
    double left[2];     /* its miss, and that of what is tried */
    double before;      /* the length of the former */
    int turn;
};

/* All of a block, with room for what is asked of several at once. */
struct continuation_set {
    const struct aim *aim;
    struct continuation *leads;
    struct stride strides[RAYS_BLOCK];
    size_t open[RAYS_BLOCK], count; /* who is on the way */
    size_t nearer[RAYS_BLOCK], nearer_count;
    double places[RAYS_BLOCK][2], slopes[RAYS_BLOCK][4];
    bool has_slope[RAYS_BLOCK];
};

static void continuation_begin(struct continuation_set *leading, size_t i)
{
    const struct continuation *lead = &leading->leads[i];
    struct stride *stride = &leading->strides[i];
    stride->share = fmin(lead->done + stride->step, 1);
    for (int k = 0; k < 2; k++) {
        const double centre = leading->aim->centre[k];
        stride->target[k] = centre + stride->share * (lead->goal[k] - centre);
        stride->here[k] = lead->at[k];
    }
    stride->before = INFINITY;
    stride->turn = 0;
}

static bool continuation_is_open(const struct continuation_set *leading, size_t i)
{
    return leading->leads[i].done < 1 && leading->strides[i].step > least_step;
}

/* A step has led there, or nowhere: another. */
static void continuation_end_step(struct continuation_set *leading, size_t i, bool succeeds)
{
    struct continuation *lead = &leading->leads[i];
    struct stride *stride = &leading->strides[i];
    if (succeeds) {
        for (int k = 0; k < 2; k++) {
            lead->at[k] = stride->near[k];
            lead->miss[k] = stride->left[k];
        }
        lead->done = stride->share;
    }
    stride->step *= succeeds ? 1.5 : 0.5;
    continuation_begin(leading, i);
}

/* Who comes nearer by what is tried? The steps of others end. */
static void continuation_judge(struct continuation_set *leading)
{
    const struct ray_block *block = leading->aim->work.blocks;
    for (size_t k = 0; k < leading->count; k++) {
        const double *here = leading->strides[leading->open[k]].here;
        leading->places[k][0] = here[0];
        leading->places[k][1] = here[1];
    }
    chief_trace(leading->aim, (const double(*)[2])leading->places, leading->count);
    leading->nearer_count = 0;
    for (size_t k = 0; k < leading->count; k++) {
        const size_t i = leading->open[k];
        struct stride *stride = &leading->strides[i];
        const double miss[2] = {stride->target[0] - block->x[k], stride->target[1] - block->y[k]};
        const double after = hypot(miss[0], miss[1]);
        if (ray_block_status(block, k) != RAY_OK || !(after < stride->before)) {
            continuation_end_step(leading, i,
                                  stride->before <= lead_reached * leading->aim->stop_radius);
            continue;
        }
        leading->nearer[leading->nearer_count++] = i;
        stride->left[0] = miss[0];
        stride->left[1] = miss[1];
        stride->before = after;
    }
}

static double continuation_determinant(const double m[4])
{
    return m[0] * m[3] - m[1] * m[2];
}

/* Newton's step on the sheet of the chief ray; what has left it ends. */
static void continuation_advance(struct continuation_set *leading, size_t i, const double slope[4],
                                 bool has_slope)
{
    const double radius = leading->aim->stop_radius, det = continuation_determinant(slope);
    struct stride *stride = &leading->strides[i];
    if (!has_slope || !(det * continuation_determinant(leading->aim->slope) > 0)) {
        continuation_end_step(leading, i, false);
        return;
    }
    stride->near[0] = stride->here[0];
    stride->near[1] = stride->here[1];
    stride->here[0] += (slope[3] * stride->left[0] - slope[1] * stride->left[1]) / det;
    stride->here[1] += (slope[0] * stride->left[1] - slope[2] * stride->left[0]) / det;
    stride->turn++;
    if (stride->before <= exact * radius || stride->turn == TURNS) {
        continuation_end_step(leading, i, stride->before <= lead_reached * radius);
    }
}

static void list_open(struct continuation_set *leading, size_t count)
{
    leading->count = 0;
    for (size_t i = 0; i < count; i++) {
        if (continuation_is_open(leading, i)) {
            leading->open[leading->count++] = i;
        }
    }
}

void continuation_rays(const struct aim *aim, struct continuation *leads, size_t count)
{
    struct continuation_set leading;
    leading.aim = aim;
    leading.leads = leads;
    for (size_t i = 0; i < count; i++) {
        leads[i] = (struct continuation){.goal = {leads[i].goal[0], leads[i].goal[1]},
                                         .at = {aim->chief[0], aim->chief[1]}};
        leading.strides[i].step = first_step;
        continuation_begin(&leading, i);
    }
    for (list_open(&leading, count); leading.count > 0; list_open(&leading, count)) {
        continuation_judge(&leading);
        for (size_t k = 0; k < leading.nearer_count; k++) {
            const double *here = leading.strides[leading.nearer[k]].here;
            leading.places[k][0] = here[0];
            leading.places[k][1] = here[1];
        }
        chief_slopes(aim, (const double(*)[2])leading.places, leading.nearer_count, leading.slopes,
                     leading.has_slope);
        for (size_t k = 0; k < leading.nearer_count; k++) {
            continuation_advance(&leading, leading.nearer[k], leading.slopes[k],
                                 leading.has_slope[k]);
        }
    }
}
