/* trace/kernel_tangent.c - derivatives of rays, forwards: lane loops for each instruction set. */
/* SPDX-License-Identifier: MIT */
#include "trace/kernel/lanes.h"
#include "trace/tangent.h"

/* What all tangents of a step share, a row each; letters as in trace/derivative.h. */
struct geometry {
    double x[RAYS_BLOCK], y[RAYS_BLOCK], f[RAYS_BLOCK]; /* N; its x and y */
    double G[RAYS_BLOCK], w[RAYS_BLOCK], u[RAYS_BLOCK]; /* */
    double slope[RAYS_BLOCK], bend[RAYS_BLOCK];         /* S', S'' */
    double M[RAYS_BLOCK], D[RAYS_BLOCK], g[RAYS_BLOCK]; /* */
    double over_M[RAYS_BLOCK], over_D[RAYS_BLOCK], over_E[RAYS_BLOCK], way[RAYS_BLOCK];
};

/* S and its derivatives by u of the odd powers: r P(u). */
INLINE void look_odd(const struct step *s, double u, double *S, double *slope, double *bend)
{
    double P = 0, P1 = 0, P2 = 0;
    for (int j = STEP_TERMS - 1; j >= 0; j--) {
        P2 = P2 * u + 2 * P1;
        P1 = P1 * u + P;
        P = P * u + s->odd[j];
    }
    double r = sqrt(u), over = 1 / (u > STEP_TINY ? r : 1), inverse = u > STEP_TINY ? over : 0;
    *S += r * P;
    *slope += 0.5 * inverse * P + r * P1;
    *bend += inverse * (P1 - 0.25 * inverse * inverse * P) + r * P2;
}

INLINE void kernel_tangent_look(const struct step *s, const struct ray_block *before,
                                const struct ray_block *after, int terms, bool odd,
                                struct geometry *at, int i)
{
    double X = after->x[i], Y = after->y[i], Z = after->z[i];
    double p = before->p[i], q = before->q[i], r = before->r[i];
    double u = s->weight_x * X * X + s->weight_y * Y * Y, S = 0, slope = 0, bend = 0;
    for (int j = terms - 1; j >= 0; j--) {
        bend = bend * u + 2 * slope;
        slope = slope * u + S;
        S = S * u + s->coefficient[j];
    }
    bend = bend * u + 2 * slope;
    slope = slope * u + S;
    S *= u;
    if (odd) {
        look_odd(s, u, &S, &slope, &bend);
    }
    double w = Z - S, f = 1 - s->c * s->one_k * w, G = s->c + 2 * f * slope;
    double x = -s->weight_x * G * X, y = -s->weight_y * G * Y;
    double M = x * x + y * y + f * f, D = x * p + y * q + f * r;
    double E = x * after->p[i] + y * after->q[i] + f * after->r[i];
    at->x[i] = x, at->y[i] = y, at->f[i] = f, at->G[i] = G, at->w[i] = w, at->u[i] = u;
    at->slope[i] = slope, at->bend[i] = bend, at->M[i] = M, at->D[i] = D;
    at->over_M[i] = 1 / M, at->over_D[i] = 1 / D, at->over_E[i] = 1 / E;
    at->g[i] = (E - D) * at->over_M[i];
    at->way[i] =
        ((X - before->x[i]) * p + (Y - before->y[i]) * q + (Z - (before->z[i] - s->t)) * r) *
        (1 / s->n11);
}

/* The same for spheres and planes, N = (-c X, -c Y, 1 - c Z): M is 1. */
INLINE void look_sphere(const struct step *s, const struct ray_block *before,
                        const struct ray_block *after, struct geometry *at, int i)
{
    double X = after->x[i], Y = after->y[i], Z = after->z[i];
    double p = before->p[i], q = before->q[i], r = before->r[i];
    double x = -s->c * X, y = -s->c * Y, f = 1 - s->c * Z, D = x * p + y * q + f * r;
    double E = x * after->p[i] + y * after->q[i] + f * after->r[i];
    at->x[i] = x, at->y[i] = y, at->f[i] = f;
    at->u[i] = 0.5 * (X * X + Y * Y + Z * Z);
    at->over_D[i] = 1 / D, at->over_E[i] = 1 / E;
    at->g[i] = E - D;
    at->way[i] =
        ((X - before->x[i]) * p + (Y - before->y[i]) * q + (Z - (before->z[i] - s->t)) * r) *
        (1 / s->n11);
}

/* See push for the steps; (D/E - 1) D. = -(g/E) D. */
INLINE void push_sphere(const struct step *s, const struct ray_block *restrict before,
                        const struct ray_block *restrict after, const struct geometry *restrict at,
                        const struct tangent_seed *seed, struct ray_block *restrict tangent, int i)
{
    const double c = s->c, half = 0.5 * seed->dn;
    double p = before->p[i], q = before->q[i], r = before->r[i];
    double tp = tangent->p[i], tq = tangent->q[i], tr = tangent->r[i];
    double d = at->way[i], Nx = at->x[i], Ny = at->y[i], Nz = at->f[i], g = at->g[i];
    double x = tangent->x[i] + d * tp, y = tangent->y[i] + d * tq;
    double z = tangent->z[i] - seed->t + d * tr;
    double more = (seed->c * at->u[i] - (Nx * x + Ny * y + Nz * z)) * at->over_D[i];
    x += more * p, y += more * q, z += more * r;
    double nx = -(c * x + seed->c * after->x[i]), ny = -(c * y + seed->c * after->y[i]);
    double nz = -(c * z + seed->c * after->z[i]);
    double tD = (nx * p + ny * q + nz * r) + (Nx * tp + Ny * tq + Nz * tr);
    double tg = at->over_E[i] * (half - g * tD);
    tangent->x[i] = x, tangent->y[i] = y, tangent->z[i] = z;
    tangent->p[i] = tp + tg * Nx + g * nx;
    tangent->q[i] = tq + tg * Ny + g * ny;
    tangent->r[i] = tr + tg * Nz + g * nz;
    tangent->path[i] += s->n11 * more + seed->n11 * d;
}

INLINE void kernel_tangent_sphere(const struct step *restrict step,
                                  const struct ray_block *restrict before,
                                  const struct ray_block *restrict after,
                                  const struct tangent_seeds *seeds,
                                  struct ray_block *restrict tangents)
{
    const struct step s = *step;
    const int lanes = seeds->lanes;
    struct geometry at;
    for (int i = 0; i < LANES_OF(lanes); i++) {
        look_sphere(&s, before, after, &at, i);
    }
    for (size_t j = 0; j < seeds->count; j++) {
        const struct tangent_seed seed = seeds->list[j];
        struct ray_block *restrict tangent = &tangents[j];
        for (int i = 0; i < LANES_OF(lanes); i++) {
            push_sphere(&s, before, after, &at, &seed, tangent, i);
        }
    }
}

/* What the parameter itself does to S and S' at u. */
INLINE void series_seed(const struct tangent_seed *seed, bool odd, double u, double *S,
                        double *slope)
{
    double value = 0, growth = 0;
    if (odd) {
        for (int j = STEP_TERMS - 1; j >= 0; j--) {
            value = value * u + seed->odd[j];
            growth = growth * u + (j + 0.5) * seed->odd[j];
        }
        double r = sqrt(u), over = 1 / (u > STEP_TINY ? r : 1);
        *S = r * value;
        *slope = (u > STEP_TINY ? over : 0) * growth;
        return;
    }
    for (int j = STEP_TERMS - 1; j >= 0; j--) {
        value = (value + seed->coefficient[j]) * u;
        growth = growth * u + (j + 1) * seed->coefficient[j];
    }
    *S = value;
    *slope = growth;
}

/* Which derivatives a loop is for: constants of each copy. */
struct what {
    bool series, odd; /* by a coefficient, by one of an odd power */
    bool reflects;
};

INLINE void push(const struct step *s, const struct ray_block *before,
                 const struct ray_block *after, const struct geometry *at,
                 const struct tangent_seed *seed, struct what what, struct ray_block *tangent,
                 int i)
{
    const double c = s->c, K = s->one_k;
    double p = before->p[i], q = before->q[i], r = before->r[i];
    double tp = tangent->p[i], tq = tangent->q[i], tr = tangent->r[i];
    double d = at->way[i], w = at->w[i], f = at->f[i], S = 0, slope = 0;
    if (what.series) {
        series_seed(seed, what.odd, at->u[i], &S, &slope);
    }
    /* the point: F = 0 holds on, and -N is its gradient */
    double x = tangent->x[i] + d * tp, y = tangent->y[i] + d * tq;
    double z = tangent->z[i] - seed->t + d * tr;
    double F = seed->c * 0.5 * (at->u[i] + K * w * w) + seed->k * 0.5 * c * w * w + f * S;
    double more = (F - (at->x[i] * x + at->y[i] * y + f * z)) * at->over_D[i];
    x += more * p, y += more * q, z += more * r;
    /* the normal there */
    double u = 2 * (s->weight_x * after->x[i] * x + s->weight_y * after->y[i] * y);
    slope += at->bend[i] * u;
    double tw = z - at->slope[i] * u - S;
    double tf = -(seed->c * K * w + c * seed->k * w + c * K * tw);
    double tG = seed->c + 2 * (tf * at->slope[i] + f * slope);
    double nx = -s->weight_x * (tG * after->x[i] + at->G[i] * x);
    double ny = -s->weight_y * (tG * after->y[i] + at->G[i] * y);
    /* the law of refraction */
    double tD = nx * p + ny * q + tf * r + at->x[i] * tp + at->y[i] * tq + f * tr;
    double tM = at->x[i] * nx + at->y[i] * ny + f * tf, E_less_D = -2 * tD; /* half of M's */
    if (!what.reflects) {
        double tE = (at->D[i] * tD + s->dn * tM + 0.5 * seed->dn * at->M[i]) * at->over_E[i];
        E_less_D = tE - tD;
    }
    double g = at->g[i], tg = (E_less_D - 2 * g * tM) * at->over_M[i];
    tangent->x[i] = x, tangent->y[i] = y, tangent->z[i] = z;
    tangent->p[i] = tp + tg * at->x[i] + g * nx;
    tangent->q[i] = tq + tg * at->y[i] + g * ny;
    tangent->r[i] = tr + tg * f + g * tf;
    tangent->path[i] += s->n11 * more + seed->n11 * d;
}

INLINE void kernel_tangent_surface(const struct step *restrict step,
                                   const struct ray_block *restrict before,
                                   const struct ray_block *restrict after,
                                   const struct tangent_seeds *seeds, int terms, bool odd,
                                   bool reflects, struct ray_block *restrict tangents)
{
    const struct step s = *step;
    const int lanes = seeds->lanes;
    struct geometry at;
    for (int i = 0; i < LANES_OF(lanes); i++) {
        kernel_tangent_look(&s, before, after, terms, odd, &at, i);
    }
    for (size_t j = 0; j < seeds->count; j++) {
        const struct tangent_seed seed = seeds->list[j];
        struct ray_block *restrict tangent = &tangents[j];
        if (seed.is_odd) {
            for (int i = 0; i < LANES_OF(lanes); i++) {
                push(&s, before, after, &at, &seed, (struct what){true, true, reflects}, tangent,
                     i);
            }
        } else if (seed.series) {
            for (int i = 0; i < LANES_OF(lanes); i++) {
                push(&s, before, after, &at, &seed, (struct what){true, false, reflects}, tangent,
                     i);
            }
        } else {
            for (int i = 0; i < LANES_OF(lanes); i++) {
                push(&s, before, after, &at, &seed, (struct what){false, false, reflects}, tangent,
                     i);
            }
        }
    }
}

/* X' = turn (X - shift). */
static void tangent_move(const struct step *s, const struct tangent_seed *seed, int lanes,
                         struct ray_block *restrict tangent)
{
    double m[9];
    memcpy(m, s->turn, sizeof m);
    const double t = seed->t, t_behind = seed->t_behind;
    for (int i = 0; i < LANES_OF(lanes); i++) {
        double x = tangent->x[i], y = tangent->y[i], z = tangent->z[i] - t;
        double p = tangent->p[i], q = tangent->q[i], r = tangent->r[i];
        tangent->x[i] = m[0] * x + m[1] * y + m[2] * z;
        tangent->y[i] = m[3] * x + m[4] * y + m[5] * z;
        tangent->z[i] = m[6] * x + m[7] * y + m[8] * z + t_behind;
        tangent->p[i] = m[0] * p + m[1] * q + m[2] * r;
        tangent->q[i] = m[3] * p + m[4] * q + m[5] * r;
        tangent->r[i] = m[6] * p + m[7] * q + m[8] * r;
    }
}

/* A thick lens: to the plane of H, the slopes behind it, and on in that of H'; see kernel.c. */
static void tangent_thick(const struct step *s, const struct ray_block *restrict before,
                          const struct ray_block *restrict after, const struct tangent_seed *seed,
                          int lanes, struct ray_block *restrict tangent)
{
    const double near = s->near_object, ratio = s->ratio, bend = s->bend;
    const double d1 = s->coefficient[0], d2 = s->coefficient[1], d3 = s->coefficient[2];
    for (int i = 0; i < LANES_OF(lanes); i++) {
        double p = before->p[i], q = before->q[i], r = before->r[i], over = 1 / r;
        double tp = tangent->p[i], tq = tangent->q[i], tr = tangent->r[i];
        double d = -(before->z[i] - s->t) * over;
        double td = -(tangent->z[i] - seed->t + d * tr) * over;
        double x = tangent->x[i] + d * tp + td * p, y = tangent->y[i] + d * tq + td * q;
        double u = p * over, tu = (tp - u * tr) * over, v = q * over, tv = (tq - v * tr) * over;
        double wu = u - after->x[i] * near, wv = v - after->y[i] * near;
        double twu = tu - x * near, twv = tv - y * near;
        double w2 = wu * wu + wv * wv, tw2 = 2 * (wu * twu + wv * twv);
        double e = w2 * (d1 + w2 * (d2 + w2 * d3)), te = tw2 * (d1 + w2 * (2 * d2 + 3 * w2 * d3));
        double behind = after->r[i], inverse = 1 / behind;
        u = after->p[i] * inverse;
        v = after->q[i] * inverse;
        tu = ratio * (tu + twu * e + wu * te) - bend * x;
        tv = ratio * (tv + twv * e + wv * te) - bend * y;
        tr = -behind * (u * tu + v * tv) / (1 + (u * u + v * v));
        tangent->x[i] = x;
        tangent->y[i] = y;
        tangent->z[i] = 0;
        tangent->p[i] = tu * behind + u * tr;
        tangent->q[i] = tv * behind + v * tr;
        tangent->r[i] = tr;
        tangent->path[i] += s->n11 * td + seed->n11 * d;
    }
}

/* Is k or the polynomial of a sphere to be derived by? */
static bool seeds_shape(const struct tangent_seeds *seeds)
{
    bool any = false;
    for (size_t j = 0; j < seeds->count; j++) {
        any = any || seeds->list[j].k != 0 || seeds->list[j].series;
    }
    return any;
}

void NAME(kernel_tangent, KERNEL)(const struct step *s, const struct ray_block *before,
                                  const struct ray_block *after, const struct tangent_seeds *seeds,
                                  struct ray_block *tangents)
{
    if (s->kind == STEP_MOVE) {
        for (size_t j = 0; j < seeds->count; j++) {
            tangent_move(s, &seeds->list[j], seeds->lanes, &tangents[j]);
        }
    } else if (s->kind == STEP_THICK) {
        for (size_t j = 0; j < seeds->count; j++) {
            tangent_thick(s, before, after, &seeds->list[j], seeds->lanes, &tangents[j]);
        }
    } else if (s->kind <= STEP_SPHERE && s->action != ACTION_REFLECT && !seeds_shape(seeds)) {
        kernel_tangent_sphere(s, before, after, seeds, tangents);
    } else if (s->kind == STEP_ODD && s->action == ACTION_REFLECT) {
        kernel_tangent_surface(s, before, after, seeds, STEP_TERMS, true, true, tangents);
    } else if (s->action == ACTION_REFLECT) {
        kernel_tangent_surface(s, before, after, seeds, STEP_TERMS, false, true, tangents);
    } else if (s->kind == STEP_ODD) {
        kernel_tangent_surface(s, before, after, seeds, STEP_TERMS, true, false, tangents);
    } else if (s->kind >= STEP_ASPHERE) {
        kernel_tangent_surface(s, before, after, seeds, STEP_TERMS, false, false, tangents);
    } else {
        kernel_tangent_surface(s, before, after, seeds, 0, false, false, tangents);
    }
}
