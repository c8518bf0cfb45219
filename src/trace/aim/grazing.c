/* trace/aim/grazing.c - rays that surfaces are about to lose. */
/* SPDX-License-Identifier: MIT */
#include "trace/aim/grazing.h"

#include "trace/kernel/step.h"

#include <math.h>
#include <string.h>

/* One surface that bends light. */
struct bend {
    const struct step *step;
    const struct ray_block *before, *behind;
    size_t place;
    bool is_rare_before; /* or as rare */
};

/* Does the place bend? */
static bool open_bend(const struct system *system, const struct derivative_tape *tape, size_t place,
                      struct bend *bend)
{
    for (size_t i = system->begin[place]; i < system->begin[place + 1]; i++) {
        const struct step *step = &system->steps[i];
        if (step->kind == STEP_MOVE || step->kind == STEP_THICK || step->action == ACTION_PASS ||
            (step->action == ACTION_REFRACT && step->dn == 0)) {
            continue;
        }
        *bend = (struct bend){.step = step,
                              .before = &tape->blocks[i],
                              .behind = &tape->blocks[i + 1],
                              .place = place,
                              .is_rare_before = step->action == ACTION_REFLECT || step->dn > 0};
        return true;
    }
    return false;
}

/*
 * The least margin of all rays. S and L, n cos I of the rarer and the denser side: L^2 - S^2 = dn,
 * |g| = L - S, so S falls as |g| grows; of a mirror |g| = 2 S.
 */
static double least_margin(const struct bend *bend, size_t count)
{
    const struct step *step = bend->step;
    const double dn = fabs(step->dn), rare = fmin(step->n11, step->n22);
    /* the least and the largest square of g = p' - p */
    const struct ray_block *restrict a = bend->before, *restrict b = bend->behind;
    double smallest = INFINITY, largest = 0;
    for (size_t i = 0; i < count; i++) {
        const double p = b->p[i] - a->p[i], q = b->q[i] - a->q[i], r = b->r[i] - a->r[i];
        const double square = p * p + q * q + r * r;
        smallest = square < smallest ? square : smallest;
        largest = square > largest ? square : largest;
    }
    if (step->action == ACTION_REFLECT) {
        return smallest / (4 * step->n11);
    }
    const double S = fmax((dn - largest) / (2 * sqrt(largest)), 0);
    return S * S / rare;
}

/* The margin of one ray, and its derivatives by p and p'. */
static double margin_of(const struct bend *bend, size_t i, double by_before[3], double by_behind[3])
{
    const struct ray_block *a = bend->before, *b = bend->behind;
    const double p[3] = {a->p[i], a->q[i], a->r[i]}, q[3] = {b->p[i], b->q[i], b->r[i]};
    const double *rare = bend->is_rare_before ? p : q;
    double along = 0, square = 0, size = 0;
    for (int k = 0; k < 3; k++) {
        const double g = q[k] - p[k];
        along += rare[k] * g;
        square += g * g;
        size += rare[k] * rare[k];
    }
    const double m = along * along / (square * size);
    for (int k = 0; k < 3; k++) {
        const double g = q[k] - p[k];
        /* dm = 2 s ds/(g.g p.p) - m (d(g.g)/g.g + d(p.p)/p.p), s = p.g */
        const double by_g = 2 * along * rare[k] / (square * size) - 2 * m * g / square;
        const double by_rare = 2 * along * g / (square * size) - 2 * m * rare[k] / size;
        by_before[k] = -by_g + (bend->is_rare_before ? by_rare : 0);
        by_behind[k] = by_g + (bend->is_rare_before ? 0 : by_rare);
    }
    return m;
}

/* What keeps a ray that is lost from counting infinitely, of the limit. */
static const double least = 0.01;

void grazing_find(const struct aimed *aimed, double limit, bool derives, struct arena *arena,
                  struct grazing_penalty *grazing)
{
    const struct system *system = aimed->system;
    const size_t count = (size_t)aimed->count;
    *grazing = (struct grazing_penalty){.margin = 1};
    for (size_t place = 0; place < system->places; place++) {
        struct derivative_seed *seed = NULL;
        struct bend bend;
        if (!open_bend(system, &aimed->work->tape, place, &bend)) {
            continue;
        }
        const double margin = least_margin(&bend, count);
        grazing->margin = fmin(grazing->margin, margin);
        if (!(margin < limit)) {
            continue;
        }
        grazing->any = true;
        if (derives) {
            /* room for one more, of so many places */
            struct derivative_seeds *seeds = &grazing->seeds;
            if (seeds->list == NULL) {
                seeds->list = ARENA_ARRAY(arena, system->places, struct derivative_seed);
            }
            seed = &seeds->list[seeds->count++];
            seed->place = place;
        }
        /* what the rays of one surface count */
        for (size_t i = 0; i < count; i++) {
            double before[3], behind[3];
            const double m = margin_of(&bend, i, before, behind);
            if (!(m < limit)) {
                continue;
            }
            const double off = limit - m, over = 1 / (limit * (m + least * limit));
            const double slope =
                -off * (limit + m + 2 * least * limit) * over / (m + least * limit);
            grazing->value[i] += off * off * over;
            for (int k = 0; k < 3 && seed != NULL; k++) {
                seed->before[k][i] = slope * before[k];
                seed->behind[k][i] = slope * behind[k];
            }
        }
    }
}
