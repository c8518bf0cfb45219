/* draw/plot_sample.c - curves sampled as finely as a plot of them shows. */
/* SPDX-License-Identifier: MIT */
#include "draw/plot_sample.h"

#include <math.h>

#include "base/arena.h"
#include "draw/plot_frame.h"

static const double WIDTH = 600, HEIGHT = 352; /* px, of the frame */
static const double BENT = 0.1;                /* px off the chord that are seen */
static const double CLOSE = 0.3;               /* px between points of a curve */
static const double EXACT = 0.002;             /* px: where it ends or jumps */
static const double JUMP = 30;                 /* px up or down, within CLOSE */
static const double WIDE = 8;                  /* px that are halved twice in any case */

enum { ROUNDS = 40 };

/* A point of all curves, and what is known of the interval behind it. */
struct curve_node {
    double x, at; /* at: px */
    double *y;    /* values */
    bool is_sample, is_open;
    int depth;
};

struct curve_sampler {
    const struct plot *plot;
    const struct plot_source *source;
    struct plot_axis x, y;
    struct arena *arena;
    struct curve_node *nodes;
    size_t count, asked;
    bool is_over;
};

/* How a value is drawn: nowhere, off an edge, or on the page. */
enum plot_sample_state { STATE_NONE, STATE_BELOW, STATE_ABOVE, STATE_FINITE };

static enum plot_sample_state state_of(const struct curve_sampler *sampler, double y)
{
    const double v = plot_drawable(y, sampler->plot->log_y);
    if (isfinite(v)) {
        return STATE_FINITE;
    }
    if (isnan(v)) {
        return STATE_NONE;
    }
    return v < 0 ? STATE_BELOW : STATE_ABOVE;
}

/* Where a finite value lies, px from the lower edge, hardly beyond what is seen. */
static double sampled_height(const struct curve_sampler *sampler, double y)
{
    const double at = plot_page_at(&sampler->y, plot_drawable(y, sampler->plot->log_y));
    return fmin(fmax(at, -HEIGHT / 2), HEIGHT * 1.5);
}

static bool nodes_are_alike(const struct curve_sampler *sampler, const struct curve_node *a,
                            const struct curve_node *b)
{
    bool alike = true;
    for (size_t k = 0; k < sampler->source->curves && alike; k++) {
        alike = state_of(sampler, a->y[k]) == state_of(sampler, b->y[k]);
    }
    return alike;
}

/* The longest way up or down from one point to the next, px, of curves that both have. */
static double leap_of(const struct curve_sampler *sampler, const struct curve_node *a,
                      const struct curve_node *b)
{
    double leap = 0;
    for (size_t k = 0; k < sampler->source->curves; k++) {
        if (state_of(sampler, a->y[k]) == STATE_FINITE &&
            state_of(sampler, b->y[k]) == STATE_FINITE) {
            leap = fmax(leap,
                        fabs(sampled_height(sampler, a->y[k]) - sampled_height(sampler, b->y[k])));
        }
    }
    return leap;
}

/* How far the middle is off the chord, px. */
static double nodes_bend(const struct curve_sampler *sampler, const struct curve_node *a,
                         const struct curve_node *m, const struct curve_node *b)
{
    double bend = 0;
    for (size_t k = 0; k < sampler->source->curves; k++) {
        if (state_of(sampler, a->y[k]) == STATE_FINITE &&
            state_of(sampler, m->y[k]) == STATE_FINITE &&
            state_of(sampler, b->y[k]) == STATE_FINITE) {
            const double chord =
                (sampled_height(sampler, a->y[k]) + sampled_height(sampler, b->y[k])) / 2;
            bend = fmax(bend, fabs(sampled_height(sampler, m->y[k]) - chord));
        }
    }
    return bend;
}

/* Is half of an interval worth a look? `bent`: the whole was. */
static bool half_is_open(const struct curve_sampler *sampler, const struct curve_node *a,
                         const struct curve_node *b, bool bent, int depth)
{
    const double width = fabs(b->at - a->at);
    const double jump = sampler->source->is_stepped ? 0.5 : JUMP;
    if (!nodes_are_alike(sampler, a, b) || leap_of(sampler, a, b) > jump) {
        return width > EXACT;
    }
    return width > CLOSE && (bent || (depth < 2 && width > WIDE / 2));
}

/* The node in the middle of an interval; false if there is none. */
static bool nodes_halve(struct curve_sampler *sampler, struct curve_node *a,
                        const struct curve_node *b, struct curve_node *m)
{
    const double at = (a->at + b->at) / 2, x = plot_value_at(&sampler->x, at);
    if (sampler->is_over || sampler->asked == sampler->source->most ||
        !((a->x < x && x < b->x) || (b->x < x && x < a->x))) {
        return false;
    }
    *m = (struct curve_node){.x = x,
                             .at = at,
                             .y = ARENA_ARRAY(sampler->arena, sampler->source->curves, double),
                             .depth = a->depth + 1};
    sampler->asked++;
    if (!sampler->source->at(sampler->source->context, x, m->y)) {
        sampler->is_over = true;
        return false;
    }
    const bool bent = nodes_bend(sampler, a, m, b) > BENT;
    a->depth++;
    a->is_open = half_is_open(sampler, a, m, bent, a->depth);
    m->is_open = half_is_open(sampler, m, b, bent, m->depth);
    return true;
}

/* Halve every interval that is open. */
static bool sample_round(struct curve_sampler *sampler)
{
    struct curve_node *nodes = ARENA_ARRAY(sampler->arena, 2 * sampler->count, struct curve_node);
    size_t count = 0;
    bool any = false;
    for (size_t i = 0; i < sampler->count; i++) {
        struct curve_node *here = &sampler->nodes[i], middle;
        const bool was_open = here->is_open && i + 1 < sampler->count;
        here->is_open = false;
        const bool has = was_open && nodes_halve(sampler, here, &sampler->nodes[i + 1], &middle);
        nodes[count++] = *here;
        if (has) {
            nodes[count++] = middle;
            any = true;
        }
    }
    sampler->nodes = nodes;
    sampler->count = count;
    return any;
}

/* Does a curve leave the page at one edge and come back at the other? */
static bool has_pole(const struct curve_sampler *sampler, size_t curve, const struct curve_node *a,
                     const struct curve_node *b)
{
    if (state_of(sampler, a->y[curve]) != STATE_FINITE ||
        state_of(sampler, b->y[curve]) != STATE_FINITE || fabs(b->at - a->at) > 2 * EXACT) {
        return false;
    }
    const double from = sampled_height(sampler, a->y[curve]),
                 to = sampled_height(sampler, b->y[curve]);
    return fmin(from, to) < 0 && fmax(from, to) > HEIGHT;
}

/* Does a curve become infinite, or has a pole, between a sample and the next? */
static bool is_steep(const struct curve_sampler *sampler, size_t first, size_t last)
{
    bool steep = false;
    for (size_t i = first; i <= last && !steep; i++) {
        for (size_t k = 0; k < sampler->source->curves; k++) {
            const enum plot_sample_state state = state_of(sampler, sampler->nodes[i].y[k]);
            steep = steep || state == STATE_ABOVE || state == STATE_BELOW ||
                    (i > first && has_pole(sampler, k, &sampler->nodes[i - 1], &sampler->nodes[i]));
        }
    }
    return steep;
}

/* Is any curve as far off the page as its height here? */
static bool node_is_far(const struct curve_sampler *sampler, const struct curve_node *node)
{
    bool far = false;
    for (size_t k = 0; k < sampler->source->curves && !far; k++) {
        const double height = sampled_height(sampler, node->y[k]);
        far = state_of(sampler, node->y[k]) == STATE_FINITE &&
              (height <= -HEIGHT / 2 || height >= HEIGHT * 1.5);
    }
    return far;
}

/* Add a point to the curves. */
static void curves_add(struct plot_curves *curves, const struct curve_node *node, size_t count,
                       enum plot_place place)
{
    curves->x[curves->count] = node->x;
    curves->places[curves->count] = (unsigned char)place;
    for (size_t k = 0; k < count; k++) {
        curves->y[k][curves->count] = node->y[k];
    }
    curves->count++;
}

/* A gap in the curves that have a pole between two points. */
static void curves_break(struct plot_curves *curves, const struct curve_sampler *sampler, size_t i)
{
    const struct curve_node *here = &sampler->nodes[i];
    bool any = false;
    for (size_t k = 0; k < sampler->source->curves; k++) {
        const bool pole = has_pole(sampler, k, here, here + 1);
        curves->y[k][curves->count] = pole ? (double)NAN : here->y[k];
        any = any || pole;
    }
    if (any) {
        curves->x[curves->count] = here->x;
        curves->places[curves->count++] = PLOT_BEYOND;
    }
}

static void sampler_collect(const struct curve_sampler *sampler, struct plot_curves *curves)
{
    const size_t room = 2 * sampler->count, kinds = sampler->source->curves;
    *curves = (struct plot_curves){ARENA_ARRAY(sampler->arena, room, double),
                                   ARENA_ARRAY(sampler->arena, kinds, double *),
                                   ARENA_ARRAY(sampler->arena, room, unsigned char), 0};
    for (size_t k = 0; k < kinds; k++) {
        curves->y[k] = ARENA_ARRAY(sampler->arena, room, double);
    }
    for (size_t first = 0; first < sampler->count;) {
        size_t last = first + 1; /* the next sample */
        bool far = false;
        while (last < sampler->count && !sampler->nodes[last].is_sample) {
            far = far || node_is_far(sampler, &sampler->nodes[last]);
            last++;
        }
        const bool steep = far || (last < sampler->count && is_steep(sampler, first, last));
        const enum plot_place between = steep ? PLOT_BEYOND : PLOT_BETWEEN;
        for (size_t i = first; i < last; i++) {
            curves_add(curves, &sampler->nodes[i], kinds, i == first ? PLOT_SAMPLE : between);
            if (i + 1 < sampler->count) {
                curves_break(curves, sampler, i);
            }
        }
        first = last;
    }
}

/* The page as the samples have it. */
static bool find_page(struct curve_sampler *sampler)
{
    sampler->x = (struct plot_axis){.log = sampler->plot->log_x, .kind = sampler->plot->x_kind};
    sampler->y = (struct plot_axis){.log = sampler->plot->log_y, .kind = sampler->plot->y_kind};
    if (!plot_find_range(sampler->plot, &sampler->x, &sampler->y)) {
        return false;
    }
    plot_set_x_axis(&sampler->x);
    plot_axis_to_ticks(&sampler->y);
    sampler->x.stop = WIDTH;
    sampler->y.stop = HEIGHT;
    return true;
}

void plot_sample(const struct plot *plot, const double *x, const double *const *y, size_t count,
                 const struct plot_source *source, struct plot_curves *curves, struct arena *arena)
{
    struct curve_sampler sampler = {.plot = plot,
                                    .source = source,
                                    .arena = arena,
                                    .nodes = ARENA_ARRAY(arena, count, struct curve_node),
                                    .count = count};
    const bool has_page = find_page(&sampler);
    for (size_t i = 0; i < count; i++) {
        struct curve_node *node = &sampler.nodes[i];
        *node =
            (struct curve_node){.x = x[i],
                                .at = plot_page_at(&sampler.x, plot_drawable(x[i], plot->log_x)),
                                .y = ARENA_ARRAY(arena, source->curves, double),
                                .is_sample = true};
        for (size_t k = 0; k < source->curves; k++) {
            node->y[k] = isfinite(node->at) ? y[k][i] : (double)NAN;
        }
    }
    for (size_t i = 0; i + 1 < count && has_page; i++) {
        struct curve_node *node = &sampler.nodes[i];
        const double width = fabs(node[1].at - node->at);
        node->is_open = width < INFINITY && half_is_open(&sampler, node, node + 1, true, 0);
    }
    for (int i = 0; i < ROUNDS && has_page && sample_round(&sampler); i++) {
    }
    sampler_collect(&sampler, curves);
}
