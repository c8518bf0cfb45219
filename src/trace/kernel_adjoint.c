/* trace/kernel_adjoint.c - derivatives of rays, backwards: lane loops for each instruction set. */
/* SPDX-License-Identifier: MIT */
#include "trace/adjoint.h"

#include <math.h>

/* See trace/kernel/lanes.h for the rules of these loops. */
#define LANES_OF(lanes)  ((lanes) / RAYS_FEW * RAYS_FEW)
#define NAME_(name, set) name##_##set
#define NAME(name, set)  NAME_(name, set)
#define INLINE           static inline __attribute__((always_inline))

struct lane_vector {
    double x, y, z;
};

INLINE double kernel_adjoint_dot(struct lane_vector a, struct lane_vector b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

INLINE struct lane_vector kernel_adjoint_cross(struct lane_vector a, struct lane_vector b)
{
    return (struct lane_vector){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z,
                                a.x * b.y - a.y * b.x};
}

/* a + f b */
INLINE struct lane_vector plus(struct lane_vector a, double f, struct lane_vector b)
{
    return (struct lane_vector){a.x + f * b.x, a.y + f * b.y, a.z + f * b.z};
}

INLINE struct lane_vector kernel_adjoint_point_of(const struct ray_block *block, int i)
{
    return (struct lane_vector){block->x[i], block->y[i], block->z[i]};
}

INLINE struct lane_vector kernel_adjoint_direction_of(const struct ray_block *block, int i)
{
    return (struct lane_vector){block->p[i], block->q[i], block->r[i]};
}

/* S, S', S'' of the polynomial. */
struct even_series {
    double value, slope, bend;
};

INLINE struct even_series series_of(const double *coefficient, int terms, double u)
{
    struct even_series s = {0, 0, 0};
    for (int i = terms - 1; i >= 0; i--) {
        s.bend = s.bend * u + 2 * s.slope;
        s.slope = s.slope * u + s.value;
        s.value = s.value * u + coefficient[i];
    }
    /* of u times what Horner's rule gave */
    return (struct even_series){s.value * u, s.slope * u + s.value, s.bend * u + 2 * s.slope};
}

/* The same with odd powers: r P(u) besides. */
INLINE struct even_series odd_series_of(const struct step *s, double u)
{
    struct even_series even = series_of(s->coefficient, STEP_TERMS, u), P = {0, 0, 0};
    for (int i = STEP_TERMS - 1; i >= 0; i--) {
        P.bend = P.bend * u + 2 * P.slope;
        P.slope = P.slope * u + P.value;
        P.value = P.value * u + s->odd[i];
    }
    double r = sqrt(u), inverse = u > STEP_TINY ? 1 / r : 0;
    even.value += r * P.value;
    even.slope += 0.5 * inverse * P.value + r * P.slope;
    even.bend += inverse * (P.slope - 0.25 * inverse * inverse * P.value) + r * P.bend;
    return even;
}

/* A place on a surface: w = z - S, f = 1 - c K w, G = c + 2 f S'; the normal is (-G x, -G y, f). */
struct at {
    double c, K, wx, wy, w, f, G;
    struct even_series S;
};

/* What the normal says of the point, of curvature, k, S and S'. */
struct normal_adjoint {
    struct lane_vector point;
    double c, k, w, slope;
};

/* The normal as a function of the point and of the shape. */
INLINE struct normal_adjoint through_normal(struct lane_vector X, struct lane_vector N_bar,
                                            const struct at *at)
{
    double G_bar = -(at->wx * X.x * N_bar.x + at->wy * X.y * N_bar.y);
    double f_bar = N_bar.z + 2 * G_bar * at->S.slope, slope_bar = 2 * at->f * G_bar;
    double w_bar = -at->c * at->K * f_bar;
    double u_bar = -w_bar * at->S.slope + slope_bar * at->S.bend;
    const struct lane_vector point = {at->wx * (2 * X.x * u_bar - at->G * N_bar.x),
                                      at->wy * (2 * X.y * u_bar - at->G * N_bar.y), w_bar};
    return (struct normal_adjoint){point, G_bar - at->K * at->w * f_bar, -at->c * at->w * f_bar,
                                   w_bar, slope_bar};
}

INLINE void kernel_adjoint_put(struct ray_block *block, int i, struct lane_vector a,
                               struct lane_vector b)
{
    block->x[i] = a.x;
    block->y[i] = a.y;
    block->z[i] = a.z;
    block->p[i] = b.x;
    block->q[i] = b.y;
    block->r[i] = b.z;
}

/* What S and S' of a surface have, and its u. */
struct of_series {
    double value[RAYS_BLOCK], slope[RAYS_BLOCK], square[RAYS_BLOCK];
};

/* Rows of coefficients one after the other; of the first, u^power is in S already. */
INLINE void kernel_adjoint_put_terms(double *restrict rows, int terms, double power, int lanes,
                                     struct of_series *of)
{
    for (int j = 0; j < terms; j++) {
        for (int i = 0; i < LANES_OF(lanes); i++) {
            rows[j * RAYS_BLOCK + i] = of->value[i] + of->slope[i] * (j + power);
            of->value[i] *= of->square[i];
            of->slope[i] *= of->square[i];
        }
    }
}

/* S gains A2 u + ..; and r (A1 + ..), of which the slope is u^(j + 1/2) (j + 1/2)/u. */
INLINE void kernel_adjoint_put_series(const struct adjoint_rows *rows, int terms, bool odd,
                                      struct of_series *of)
{
    const int lanes = rows->lanes;
    if (odd) {
        struct of_series first;
        for (int i = 0; i < LANES_OF(lanes); i++) {
            double r = sqrt(of->square[i]), over = of->square[i] > STEP_TINY ? 1 / r : 0;
            first.value[i] = of->value[i] * r;
            first.slope[i] = of->slope[i] * over;
            first.square[i] = of->square[i];
        }
        kernel_adjoint_put_terms(rows->odd, terms, 0.5, lanes, &first);
    }
    for (int i = 0; i < LANES_OF(lanes); i++) {
        of->value[i] *= of->square[i];
    }
    kernel_adjoint_put_terms(rows->coefficient, terms, 1, lanes, of);
}

/*
 * A surface that moves by itself, rays at rest. Shifted by e, F at the ray grows by N.e and the
 * normal there is that at X - e; turned by w about the vertex, as by w x X, and N turns too:
 * (share N - v).e and (X x (share N - v) + N x N_bar).w, v what the normal gave to a. The change
 * of the rays' own adjoints, which says the same, loses all digits of a flat or idle surface.
 */
INLINE void kernel_adjoint_put_motion(const struct adjoint_motion *motion, int i,
                                      struct lane_vector shift, struct lane_vector turn)
{
    double *restrict rows = motion->rows;
    for (int k = 0; k < 3; k++) {
        const double *e = motion->shift + 3 * k, *axis = motion->turn + 3 * k;
        const int at = k < 2 ? k : 5;
        rows[at * RAYS_BLOCK + i] = e[0] * shift.x + e[1] * shift.y + e[2] * shift.z;
        rows[(2 + k) * RAYS_BLOCK + i] = axis[0] * turn.x + axis[1] * turn.y + axis[2] * turn.z;
    }
}

/* Kinds of a surface as far as derivatives are concerned. */
enum depth { DEPTH_SPHERE, DEPTH_CONIC, DEPTH_SERIES, DEPTH_ODD };

INLINE struct even_series shape_series(const struct step *s, enum depth depth, int terms, double u)
{
    if (depth == DEPTH_ODD) {
        return odd_series_of(s, u);
    }
    return depth == DEPTH_SERIES ? series_of(s->coefficient, terms, u)
                                 : (struct even_series){0, 0, 0};
}

/*
 * One surface. a and b are the adjoints of point and direction behind it, then before it; bars of
 * the text are _bar here. N is the normal, M its square, D = N.p, E = N.p', p' = p + g N.
 */
INLINE void
kernel_adjoint_surface(const struct step *restrict s, const struct ray_block *restrict before,
                       const struct ray_block *restrict after, struct ray_block *restrict adjoint,
                       const struct adjoint_rows *rows, enum depth depth, bool reflects, bool moves)
{
    const int terms = depth >= DEPTH_SERIES ? STEP_TERMS : 0;
    const struct adjoint_motion motion = moves ? *rows->motion : (struct adjoint_motion){.rows = 0};
    const double c = s->c, K = s->one_k, dn = s->dn, n11 = s->n11, t = s->t;
    const double wx = depth == DEPTH_SPHERE ? 1 : s->weight_x;
    const double wy = depth == DEPTH_SPHERE ? 1 : s->weight_y;
    const double n1 = 2 * sqrt(s->n11), n2 = 2 * sqrt(s->n22), sign = rows->thickness_sign;
    struct of_series of;
    double *restrict c_row = rows->curvature, *restrict k_row = rows->conic;
    double *restrict t_row = rows->thickness;
    double *restrict before_row = rows->index_before, *restrict after_row = rows->index_after;
    const int lanes = rows->lanes;
    for (int i = 0; i < LANES_OF(lanes); i++) {
        struct lane_vector X = kernel_adjoint_point_of(after, i),
                           p = kernel_adjoint_direction_of(before, i);
        struct lane_vector out = kernel_adjoint_direction_of(after, i),
                           X0 = kernel_adjoint_point_of(before, i);
        struct lane_vector a = kernel_adjoint_point_of(adjoint, i),
                           b = kernel_adjoint_direction_of(adjoint, i);
        double path = adjoint->path[i], u = wx * X.x * X.x + wy * X.y * X.y;
        struct even_series S = shape_series(s, depth, terms, u);
        double w = X.z - S.value, f = 1 - c * K * w, G = c + 2 * f * S.slope;
        const struct at at = {c, K, wx, wy, w, f, G, S};
        struct lane_vector N = {-wx * G * X.x, -wy * G * X.y, f};
        double D = kernel_adjoint_dot(N, p), E = kernel_adjoint_dot(N, out),
               g_bar = kernel_adjoint_dot(N, b), M = 1, inverse = 1;
        if (depth != DEPTH_SPHERE) {
            M = kernel_adjoint_dot(N, N);
            inverse = 1 / M;
        }
        /* what does not bend has no share at all, not that of rounding */
        double g = reflects || dn != 0 ? (E - D) * inverse : 0, over = 1 / E;
        double D_bar = reflects ? -2 * g_bar * inverse : -g_bar * g * over;
        double n_bar = reflects ? 0 : 0.5 * g_bar * over; /* of dn */
        struct lane_vector N_bar = {g * b.x, g * b.y, g * b.z};
        N_bar = plus(N_bar, D_bar, p);
        b = plus(b, D_bar, N);
        if (depth != DEPTH_SPHERE) {
            double M_bar = (n_bar * dn - g_bar * g) * inverse;
            N_bar = plus(N_bar, 2 * M_bar, N);
        }
        struct normal_adjoint bars = through_normal(X, N_bar, &at);
        a = plus(a, 1, bars.point);
        /* the point as where the ray meets the surface: X = X0 + d p, F = 0 */
        X0.z -= t;
        double d = kernel_adjoint_dot(plus(X, -1, X0), p) / n11,
               share = (kernel_adjoint_dot(a, p) + path * n11) / D;
        bars.c += share * 0.5 * (u + K * w * w);
        bars.k += share * 0.5 * c * w * w;
        if (moves) {
            const struct lane_vector shift = {
                share * N.x - bars.point.x, share * N.y - bars.point.y, share * N.z - bars.point.z};
            const struct lane_vector turn =
                plus(kernel_adjoint_cross(X, shift), 1, kernel_adjoint_cross(N, N_bar));
            kernel_adjoint_put_motion(&motion, i, shift, turn);
        }
        a = plus(a, -share, N);
        b = plus(b, d, a);
        if (depth >= DEPTH_SERIES) {
            of.value[i] = share * f - bars.w;
            of.slope[i] = bars.slope;
            of.square[i] = u;
        }
        if (depth != DEPTH_SPHERE) {
            k_row[i] = bars.k;
        }
        c_row[i] = bars.c;
        t_row[i] = sign * a.z;
        before_row[i] += n1 * (path * d - n_bar);
        after_row[i] += n2 * n_bar;
        kernel_adjoint_put(adjoint, i, a, b);
    }
    if (depth >= DEPTH_SERIES) {
        kernel_adjoint_put_series(rows, terms, depth == DEPTH_ODD, &of);
    }
}

/* X' = turn (X - shift): the adjoint turns back. */
static void adjoint_move(const struct step *s, struct ray_block *adjoint,
                         const struct adjoint_rows *rows)
{
    double m[9], sign = rows->thickness_sign;
    for (int i = 0; i < 9; i++) {
        m[i] = s->turn[i];
    }
    double *restrict t_row = rows->thickness;
    const int lanes = rows->lanes;
    for (int i = 0; i < LANES_OF(lanes); i++) {
        struct lane_vector a = kernel_adjoint_point_of(adjoint, i),
                           b = kernel_adjoint_direction_of(adjoint, i);
        adjoint->x[i] = m[0] * a.x + m[3] * a.y + m[6] * a.z;
        adjoint->y[i] = m[1] * a.x + m[4] * a.y + m[7] * a.z;
        double z = m[2] * a.x + m[5] * a.y + m[8] * a.z;
        adjoint->z[i] = z;
        t_row[i] = sign * (rows->along_behind ? a.z : z);
        adjoint->p[i] = m[0] * b.x + m[3] * b.y + m[6] * b.z;
        adjoint->q[i] = m[1] * b.x + m[4] * b.y + m[7] * b.z;
        adjoint->r[i] = m[2] * b.x + m[5] * b.y + m[8] * b.z;
    }
}

/* A thick lens has no derivatives here: NaN, so that nobody takes them for numbers. */
static void no_derivatives(struct ray_block *adjoint, const struct adjoint_motion *motion)
{
    for (int i = 0; i < RAYS_BLOCK; i++) {
        adjoint->x[i] = adjoint->y[i] = adjoint->z[i] = (double)NAN;
        adjoint->p[i] = adjoint->q[i] = adjoint->r[i] = (double)NAN;
    }
    for (int i = 0; motion != NULL && i < 6 * RAYS_BLOCK; i++) {
        motion->rows[i] = (double)NAN;
    }
}

INLINE void kernel_adjoint_of_depth(const struct step *s, const struct ray_block *before,
                                    const struct ray_block *after, struct ray_block *adjoint,
                                    const struct adjoint_rows *rows, enum depth depth)
{
    const bool reflects = s->action == ACTION_REFLECT, moves = rows->motion != NULL;
    if (reflects && moves) {
        kernel_adjoint_surface(s, before, after, adjoint, rows, depth, true, true);
    } else if (reflects) {
        kernel_adjoint_surface(s, before, after, adjoint, rows, depth, true, false);
    } else if (moves) {
        kernel_adjoint_surface(s, before, after, adjoint, rows, depth, false, true);
    } else {
        kernel_adjoint_surface(s, before, after, adjoint, rows, depth, false, false);
    }
}

void NAME(kernel_adjoint, KERNEL)(const struct step *s, const struct ray_block *before,
                                  const struct ray_block *after, struct ray_block *adjoint,
                                  const struct adjoint_rows *rows)
{
    if (s->kind == STEP_MOVE) {
        adjoint_move(s, adjoint, rows);
    } else if (s->kind == STEP_THICK) {
        no_derivatives(adjoint, rows->motion);
    } else if (rows->odd != NULL) {
        kernel_adjoint_of_depth(s, before, after, adjoint, rows, DEPTH_ODD);
    } else if (rows->coefficient != NULL) {
        kernel_adjoint_of_depth(s, before, after, adjoint, rows, DEPTH_SERIES);
    } else if (rows->conic != NULL) {
        kernel_adjoint_of_depth(s, before, after, adjoint, rows, DEPTH_CONIC);
    } else {
        kernel_adjoint_of_depth(s, before, after, adjoint, rows, DEPTH_SPHERE);
    }
}
