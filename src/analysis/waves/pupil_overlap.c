/* analysis/waves/pupil_overlap.c - a pupil laid over itself: transfer at one frequency. */
/* SPDX-License-Identifier: MIT */
#include "analysis/waves/pupil_overlap.h"

#include "base/constants.h"
#include "base/turns.h"

#include <math.h>
#include <string.h>

enum { RIGHT, LEFT };

/* Gauss's rule of 0 .. 1, or of its upper half and for all of it. */
static size_t open_nodes(size_t count, bool half, struct arena *arena, double **nodes,
                         double **weights)
{
    const size_t here = half ? (2 * count + 2) / 3 : count;
    *nodes = ARENA_ARRAY(arena, here, double);
    *weights = ARENA_ARRAY(arena, here, double);
    gauss_rule(here, *nodes, *weights);
    for (size_t i = 0; i < here && half; i++) {
        (*nodes)[i] = (1 + (*nodes)[i]) / 2;
    }
    return here;
}

size_t pupil_overlap_lines(const struct pupil_form *form)
{
    const size_t orders = form->orders;
    return orders > 5 ? orders * orders * 3 / 4 : 2 * orders;
}

void pupil_overlap_open(struct pupil_wave *wave, size_t lines, struct pupil_mirrors mirrors,
                        struct arena *arena, struct pupil_overlap *overlap)
{
    *overlap = (struct pupil_overlap){.wave = wave, .mirrors = mirrors};
    overlap->lines =
        open_nodes(lines, mirrors.along, arena, &overlap->angles, &overlap->angle_weights);
    overlap->each = open_nodes(lines, mirrors.across, arena, &overlap->nodes, &overlap->weights);
    overlap->count = overlap->lines * overlap->each;
    const size_t room = pupil_room(overlap->count);
    overlap->room = room;
    overlap->x = ARENA_ARRAY(arena, 2 * room, double);
    overlap->y = ARENA_ARRAY(arena, 2 * room, double);
    overlap->weight = ARENA_ARRAY(arena, room, double);
    for (int k = 0; k < 2; k++) {
        overlap->edges[k] = ARENA_ARRAY(arena, overlap->lines, struct pupil_edge);
        overlap->value[k] = ARENA_ARRAY(arena, 2 * room, double);
        overlap->part[k] = ARENA_ARRAY(arena, room, double);
        overlap->by_value[k] = ARENA_ARRAY(arena, 2 * room, double);
        overlap->by_place[k] = ARENA_ARRAY(arena, 2 * room, double);
        for (int axis = 0; axis < 2; axis++) {
            overlap->slope[k][axis] = ARENA_ARRAY(arena, 2 * room, double);
        }
    }
}

/* -------- the edge -------- */

static double pupil_overlap_cross(const double a[2], const double b[2])
{
    return a[0] * b[1] - a[1] * b[0];
}

static double pupil_overlap_dot(const double a[2], const double b[2])
{
    return a[0] * b[0] + a[1] * b[1];
}

static void edge_find(const struct pupil_wave *wave, double turn, struct pupil_edge *edge)
{
    const size_t orders = wave->rule->form.orders;
    edge->turn = turn;
    edge->cosine[0] = 1;
    edge->sine[0] = 0;
    turns_of(turn, &edge->cosine[1], &edge->sine[1]);
    for (size_t m = 2; m < orders; m++) {
        edge->cosine[m] = edge->cosine[m - 1] * edge->cosine[1] - edge->sine[m - 1] * edge->sine[1];
        edge->sine[m] = edge->cosine[m - 1] * edge->sine[1] + edge->sine[m - 1] * edge->cosine[1];
    }
    for (int k = 0; k < 2; k++) {
        const double *rim = wave->rim[k];
        edge->at[k] = edge->slope[k] = edge->bend[k] = 0;
        for (size_t m = 0; m < orders; m++) {
            const double here = rim[2 * m] * edge->cosine[m] + rim[2 * m + 1] * edge->sine[m];
            const double way = rim[2 * m + 1] * edge->cosine[m] - rim[2 * m] * edge->sine[m];
            edge->at[k] += here;
            edge->slope[k] += (double)m * way;
            edge->bend[k] -= (double)(m * m) * here;
        }
    }
}

/* The turn of a direction, by arithmetic that is the same everywhere. */
static double pupil_overlap_turn_of(double x, double y)
{
    const double size = sqrt(x * x + y * y);
    double turn = 0.125 * (fabs(y) - fabs(x)) / size + 0.125;
    turn = x < 0 ? 0.5 - turn : turn;
    turn = y < 0 ? -turn : turn;
    for (int i = 0; i < 4; i++) {
        double c, s;
        turns_of(turn, &c, &s);
        turn += (y * c - x * s) / (size * 2 * PI);
    }
    return turn;
}

enum { STEPS = 20 };
static const double enough = 1e-13;

/* The edge across from a point of it, along the shift. */
static bool find_left(const struct pupil_overlap *overlap, const struct pupil_edge *right,
                      double turn, struct pupil_edge *left)
{
    const double *shift = overlap->moved, size = sqrt(pupil_overlap_dot(shift, shift));
    for (int i = 0; i < STEPS; i++) {
        edge_find(overlap->wave, turn, left);
        const double way[2] = {left->at[0] - right->at[0], left->at[1] - right->at[1]};
        const double miss = pupil_overlap_cross(shift, way) / size;
        const double step = miss / (pupil_overlap_cross(shift, left->slope) / size);
        if (!(fabs(step) < 1)) {
            return false;
        }
        if (fabs(miss) <= enough) {
            return true;
        }
        turn -= step / (2 * PI);
    }
    return false;
}

/* Where the edge and the shifted one cross: right - left = shift. */
static bool find_corner(const struct pupil_overlap *overlap, double right, double left,
                        struct pupil_edge *corner)
{
    const double *shift = overlap->moved;
    for (int i = 0; i < STEPS; i++) {
        edge_find(overlap->wave, right, &corner[RIGHT]);
        edge_find(overlap->wave, left, &corner[LEFT]);
        const double miss[2] = {shift[0] - corner[RIGHT].at[0] + corner[LEFT].at[0],
                                shift[1] - corner[RIGHT].at[1] + corner[LEFT].at[1]};
        const double area = pupil_overlap_cross(corner[RIGHT].slope, corner[LEFT].slope);
        if (fabs(miss[0]) + fabs(miss[1]) <= enough) {
            return true;
        }
        const double step[2] = {pupil_overlap_cross(miss, corner[LEFT].slope) / area,
                                pupil_overlap_cross(miss, corner[RIGHT].slope) / area};
        const double most = fmax(fabs(step[0]), fabs(step[1]));
        if (!(most < 100)) {
            return false;
        }
        /* near the cut-off Newton's steps are too long at first */
        const double share = most > 0.3 ? 0.3 / most : 1;
        right += share * step[0] / (2 * PI);
        left += share * step[1] / (2 * PI);
    }
    return false;
}

/* Both corners, and whether there are any. */
static bool find_corners(struct pupil_overlap *overlap, struct error *error)
{
    const double *shift = overlap->moved, size = sqrt(pupil_overlap_dot(shift, shift));
    const double middle = pupil_overlap_turn_of(shift[0], shift[1]);
    struct pupil_edge right, left;
    edge_find(overlap->wave, middle, &right);
    if (!find_left(overlap, &right, middle + 0.5, &left)) {
        return fail(error, ERROR_DOMAIN, "the pupil is too distorted for the diffraction MTF");
    }
    const double way[2] = {right.at[0] - left.at[0], right.at[1] - left.at[1]};
    const double chord = pupil_overlap_dot(way, shift) / size;
    overlap->cutoff = chord / size * sqrt(pupil_overlap_dot(overlap->shift, overlap->shift));
    overlap->is_empty = !(size < chord);
    if (overlap->is_empty) {
        return true;
    }
    const double half = fmin(size / chord, 1);
    const double angle = pupil_overlap_turn_of(half, sqrt((1 - half) * (1 + half)));
    for (int side = 0; side < 2; side++) {
        const double beta = side == 0 ? -angle : angle;
        if (!find_corner(overlap, middle + beta, middle + 0.5 - beta, overlap->corners[side])) {
            return fail(error, ERROR_DOMAIN, "the pupil is too distorted for the diffraction MTF");
        }
    }
    return true;
}

/* -------- the sum -------- */

/* From the left edge to where the right one is, less the shift. */
static void pupil_overlap_line_of(const struct pupil_overlap *overlap, size_t i, double along[2])
{
    for (int k = 0; k < 2; k++) {
        along[k] =
            overlap->edges[RIGHT][i].at[k] - overlap->edges[LEFT][i].at[k] - overlap->moved[k];
    }
}

bool pupil_overlap_find(struct pupil_overlap *overlap, bool derives, struct error *error)
{
    const double *inverse = overlap->wave->inverse, *shift = overlap->shift;
    overlap->moved[0] = inverse[0] * shift[0] + inverse[1] * shift[1];
    overlap->moved[1] = inverse[2] * shift[0] + inverse[3] * shift[1];
    overlap->re = overlap->im = 0;
    if (!find_corners(overlap, error)) {
        return false;
    }
    /* lines from edge to edge, and Gauss's points along them */
    for (size_t i = 0; i < overlap->lines && !overlap->is_empty; i++) {
        const struct pupil_edge(*corners)[2] = (const struct pupil_edge(*)[2])overlap->corners;
        const double from = corners[0][RIGHT].turn, range = corners[1][RIGHT].turn - from;
        const double other = corners[0][LEFT].turn, back = corners[1][LEFT].turn - other;
        struct pupil_edge *right = &overlap->edges[RIGHT][i], *left = &overlap->edges[LEFT][i];
        double along[2];
        edge_find(overlap->wave, from + range * overlap->angles[i], right);
        if (!find_left(overlap, right, other + back * overlap->angles[i], left)) {
            return fail(error, ERROR_DOMAIN, "the pupil is too distorted for the diffraction MTF");
        }
        pupil_overlap_line_of(overlap, i, along);
        const double area =
            pupil_overlap_cross(along, right->slope) * 2 * PI * range * overlap->angle_weights[i];
        for (size_t k = 0; k < overlap->each; k++) {
            const size_t at = i * overlap->each + k, shifted = overlap->room + at;
            overlap->x[at] = left->at[0] + overlap->nodes[k] * along[0];
            overlap->y[at] = left->at[1] + overlap->nodes[k] * along[1];
            overlap->x[shifted] = overlap->x[at] + overlap->moved[0];
            overlap->y[shifted] = overlap->y[at] + overlap->moved[1];
            overlap->weight[at] = area * overlap->weights[k];
        }
    }
    if (!overlap->is_empty) {
        /* the sum over them of the wave front times itself at the moved points */
        const struct pupil_wave *wave = overlap->wave;
        const size_t room = overlap->room;
        struct pupil_look look = {.count = 2 * room,
                                  .x = overlap->x,
                                  .y = overlap->y,
                                  .value = {overlap->value[0], overlap->value[1]}};
        if (derives) {
            memcpy(look.slope, overlap->slope, sizeof look.slope);
        }
        pupil_look(&wave->rule->form, (const double *const *)wave->c, &look);
        const struct pupil_cross terms = {
            .count = room,
            .waves = {overlap->value[0] + room, overlap->value[0]},
            .amplitudes = {overlap->value[1] + room, overlap->value[1]},
            .weights = overlap->weight,
            .re = overlap->part[0],
            .im = overlap->part[1]};
        pupil_cross(&terms);
        for (size_t i = 0; i < overlap->count; i++) {
            overlap->re += overlap->part[0][i];
            overlap->im += overlap->part[1][i];
        }
        overlap->im = overlap->mirrors.across ? 0 : overlap->im;
    }
    return true;
}

/* -------- backwards -------- */

/* To the coefficients of the edge, from derivatives by a point of it and by its slope. */
static void edge_back(struct pupil_wave *wave, const struct pupil_edge *edge, const double by_at[2],
                      const double by_slope[2])
{
    for (size_t m = 0; m < wave->rule->form.orders; m++) {
        for (int k = 0; k < 2; k++) {
            const double steep = (double)m * by_slope[k];
            wave->by_rim[k][2 * m] += by_at[k] * edge->cosine[m] - steep * edge->sine[m];
            wave->by_rim[k][2 * m + 1] += by_at[k] * edge->sine[m] + steep * edge->cosine[m];
        }
    }
}

/* What the sum is by, on its way back. */
struct backwards {
    double by_moved[2];       /* the shift in places */
    double by_from, by_range; /* angle of the first corner, and from it to the other, rad */
};

/*
 * A line: its right end at an angle, its left where cross(shift, left - right) = 0.
 *
 * Given     by_area  the derivative by the logarithm of its area
 */
static void line_back(struct pupil_overlap *overlap, size_t i, double by_area,
                      struct backwards *all)
{
    static const double none[2] = {0, 0};
    const struct pupil_edge *right = &overlap->edges[RIGHT][i], *left = &overlap->edges[LEFT][i];
    const double *shift = overlap->moved;
    const double range =
        2 * PI * (overlap->corners[1][RIGHT].turn - overlap->corners[0][RIGHT].turn);
    double along[2], by_left[2] = {0}, by_along[2] = {0}, by_right[2];
    /* points of a line, and what they are by */
    for (size_t k = 0; k < overlap->each; k++) {
        const size_t at = i * overlap->each + k, shifted = overlap->room + at;
        for (int axis = 0; axis < 2; axis++) {
            const double here = overlap->by_place[axis][at];
            const double there = overlap->by_place[axis][shifted];
            by_left[axis] += here + there;
            by_along[axis] += overlap->nodes[k] * (here + there);
            all->by_moved[axis] += there;
        }
    }
    pupil_overlap_line_of(overlap, i, along);
    const double share = by_area / pupil_overlap_cross(along, right->slope);
    const double by_slope[2] = {-share * along[1], share * along[0]};
    by_along[0] += share * right->slope[1];
    by_along[1] -= share * right->slope[0];
    for (int k = 0; k < 2; k++) {
        by_right[k] = by_along[k];
        by_left[k] -= by_along[k];
        all->by_moved[k] -= by_along[k];
    }
    const double slips =
        -pupil_overlap_dot(by_left, left->slope) / pupil_overlap_cross(shift, left->slope);
    const double way[2] = {left->at[0] - right->at[0], left->at[1] - right->at[1]};
    all->by_moved[0] += slips * way[1];
    all->by_moved[1] -= slips * way[0];
    by_left[0] -= slips * shift[1];
    by_left[1] += slips * shift[0];
    by_right[0] += slips * shift[1];
    by_right[1] -= slips * shift[0];
    edge_back(overlap->wave, left, by_left, none);
    edge_back(overlap->wave, right, by_right, by_slope);
    const double by_angle =
        pupil_overlap_dot(by_right, right->slope) + pupil_overlap_dot(by_slope, right->bend);
    all->by_from += by_angle;
    all->by_range += overlap->angles[i] * by_angle + by_area / range;
}

/* A corner: right - left = shift. */
static void corner_back(struct pupil_overlap *overlap, size_t side, double by_angle,
                        struct backwards *all)
{
    static const double none[2] = {0, 0};
    const struct pupil_edge *right = &overlap->corners[side][RIGHT];
    const struct pupil_edge *left = &overlap->corners[side][LEFT];
    const double share = by_angle / pupil_overlap_cross(right->slope, left->slope);
    const double by[2] = {share * left->slope[1], -share * left->slope[0]};
    const double less[2] = {-by[0], -by[1]};
    all->by_moved[0] += by[0];
    all->by_moved[1] += by[1];
    edge_back(overlap->wave, right, less, none);
    edge_back(overlap->wave, left, by, none);
}

/* d(shift in places) = -inverse d(matrix) (shift in places). */
static void matrix_back(struct pupil_overlap *overlap, const double by_moved[2])
{
    struct pupil_wave *wave = overlap->wave;
    for (int k = 0; k < 2; k++) {
        const double by = wave->inverse[k] * by_moved[0] + wave->inverse[2 + k] * by_moved[1];
        wave->by_matrix[2 * k] -= by * overlap->moved[0];
        wave->by_matrix[2 * k + 1] -= by * overlap->moved[1];
    }
}

void pupil_overlap_back(struct pupil_overlap *overlap, const double by[2])
{
    struct pupil_wave *wave = overlap->wave;
    const size_t terms = wave->rule->form.terms;
    struct backwards all = {.by_from = 0};
    if (overlap->is_empty) {
        return;
    }
    /* Of each point: by the two functions, and by its place. Part 0 becomes that by ln of its
       size. */
    const size_t room = overlap->room;
    const double by_im = overlap->mirrors.across ? 0 : by[1];
    double *by_wave = overlap->by_value[0], *by_amplitude = overlap->by_value[1];
    for (size_t i = 0; i < room; i++) {
        const bool is_point = i < overlap->count;
        const double re = is_point ? overlap->part[0][i] : 0;
        const double im = is_point ? overlap->part[1][i] : 0;
        const double size = by[0] * re + by_im * im;
        const double turned = 2 * PI * (by_im * re - by[0] * im);
        overlap->part[0][i] = size;
        by_wave[i] = -turned;
        by_wave[room + i] = turned;
        by_amplitude[i] = is_point ? size / overlap->value[1][i] : 0;
        by_amplitude[room + i] = is_point ? size / overlap->value[1][room + i] : 0;
    }
    for (int axis = 0; axis < 2; axis++) {
        for (size_t i = 0; i < 2 * room; i++) {
            overlap->by_place[axis][i] = by_wave[i] * overlap->slope[0][axis][i] +
                                         by_amplitude[i] * overlap->slope[1][axis][i];
        }
    }
    const struct pupil_look look = {.count = 2 * overlap->room,
                                    .x = overlap->x,
                                    .y = overlap->y,
                                    .value = {overlap->by_value[0], overlap->by_value[1]}};
    pupil_gather(&wave->rule->form, &look, wave->sums);
    for (size_t i = 0; i < 2 * terms; i++) {
        wave->by_c[i / terms][i % terms] += wave->sums[i / terms][i % terms];
    }
    for (size_t i = 0; i < overlap->lines; i++) {
        double by_area = 0;
        for (size_t k = 0; k < overlap->each; k++) {
            by_area += overlap->part[0][i * overlap->each + k];
        }
        line_back(overlap, i, by_area, &all);
    }
    corner_back(overlap, 0, all.by_from - all.by_range, &all);
    corner_back(overlap, 1, all.by_range, &all);
    matrix_back(overlap, all.by_moved);
}
