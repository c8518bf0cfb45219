/* tests/truth/clear_fits.h - for clear_sums.c: what is summed, and polynomials along lines. */
/* SPDX-License-Identifier: MIT */
#ifndef CLEAR_FITS_H
#define CLEAR_FITS_H

#include "clear_region.h"
#include "clear_waves.h"

enum { RADIAL = 32, SUMS = 9, RADII = 6 };
static const double pi = 3.14159265358979323846;

/* What differences of fourth order leave of a share of a sum. */
static const double noise = 5e-13;

struct job {
    const struct beam *beam;
    const struct region *region;
    const struct sphere *sphere; /* of wave fronts */
    bool is_field;               /* areas behind the lens */
    bool is_moved;               /* sums that say where a sphere fits better */
    double middle[2];            /* of discs that light is counted within, mm */
    double discs[RADII];         /* their radii */
    int disc_count;
    double origin[2];   /* where distances are from, mm */
    double scale[SUMS]; /* what sums are of the order of */
    bool is_scaled;     /* that is known */
    double tolerance, doubt[SUMS];
    double line_doubt, lines_doubt; /* what stretches leave that do not stand: of a line, of all */
};

/* |d(stop)/d(u, v)| in units of the stop, or of the direction behind the lens, by differences over
   steps of h. off: the share of it by which those of second order are away from those of fourth. */
static double area_by(const struct job *job, double u, double v, double h, double *off)
{
    double m[2][4];
    for (int k = 0; k < 2; k++) {
        static const double at[4] = {-2, -1, 1, 2};
        static const double share[2][4] = {{1. / 12, -8. / 12, 8. / 12, -1. / 12},
                                           {0, -1. / 2, 1. / 2, 0}};
        double sum[2][2] = {{0, 0}, {0, 0}};
        for (int i = 0; i < 4; i++) {
            const double step = at[i] * h;
            const struct passage ray =
                look(job->beam, u + (k == 0 ? step : 0), v + (k == 1 ? step : 0), !job->is_field);
            const double *of = job->is_field ? ray.ray.d : ray.at_stop;
            for (int order = 0; order < 2; order++) {
                sum[order][0] += share[order][i] * (job->is_field && !ray.arrives ? NAN : of[0]);
                sum[order][1] += share[order][i] * of[1];
            }
        }
        for (int order = 0; order < 2; order++) {
            m[order][k] = sum[order][0] / h;
            m[order][2 + k] = sum[order][1] / h;
        }
    }
    double area[2];
    for (int order = 0; order < 2; order++) {
        area[order] = fabs(m[order][0] * m[order][3] - m[order][1] * m[order][2]);
    }
    *off = fabs(area[1] - area[0]) / area[0];
    return area[0] / (job->is_field ? 1 : stop_radius * stop_radius);
}

/*
 * Directions behind a lens turn ever faster where rays come to graze a surface, or are lost one
 * step farther: the steps shorten with the way to there.
 */
static double area_of(const struct job *job, double u, double v)
{
    const double farthest = job->region->farthest, shortest = 1e-13;
    const double enough = fmax(1e-5, sqrt(job->tolerance) / 4);
    double h = 2e-3 * farthest, off, area = area_by(job, u, v, h, &off);
    while (job->is_field && !(off <= enough) && h > shortest * farthest) {
        h /= 4;
        area = area_by(job, u, v, h, &off);
    }
    return area;
}

/* Kronrod's rule of 15 points and Gauss's of 7 among them: QUADPACK's qk15. */
static const double nodes[8] = {0.99145537112081263, 0.94910791234275852, 0.86486442335976907,
                                0.74153118559939443, 0.58608723546769113, 0.40584515137739716,
                                0.20778495500789846, 0.00000000000000000};
static const double kronrod[8] = {0.02293532201052922, 0.06309209262997855, 0.10479001032225018,
                                  0.14065325971552591, 0.16900472663926790, 0.19035057806478540,
                                  0.20443294007529889, 0.20948214108472782};
static const double seven[4] = {0.12948496616886969, 0.27970539148927666, 0.38183005050511894,
                                0.41795918367346938};

/* -------- polynomials along a line, where phases or discs want many points -------- */

enum { FIT = 24, WAVE_OF, X_OF, Y_OF, LIGHT_OF, OF_ALL };
enum { OF = OF_ALL - WAVE_OF, LOOKS = 96 };

/* Waves, places in the image and light of a stretch as sums of Chebyshev's polynomials. */
struct fit {
    double low, high, of[FIT][OF];
};

/* is_lit: light too, which takes the most rays. */
static void value_of(const struct job *job, const double way[2], double r, bool is_lit,
                     double value[OF])
{
    const double u = job->region->middle[0] + r * way[0], v = job->region->middle[1] + r * way[1];
    const struct passage all = look(job->beam, u, v, false);
    double at[3];
    at_image(&all.ray, at);
    value[0] = all.arrives && job->sphere != NULL ? wave_of(job->sphere, &all.ray) : 0;
    value[X_OF - WAVE_OF] = at[0] - job->middle[0];
    value[Y_OF - WAVE_OF] = at[1] - job->middle[1];
    value[LIGHT_OF - WAVE_OF] = all.arrives ? is_lit ? r * area_of(job, u, v) : 0 : NAN;
}

/* Clenshaw's recurrence. */
static void fitted(const struct fit *fit, double r, double value[OF])
{
    const double x = (2 * r - fit->low - fit->high) / (fit->high - fit->low);
    double one[OF] = {0}, two[OF] = {0};
    for (int i = FIT - 1; i > 0; i--) {
        for (int k = 0; k < OF; k++) {
            const double next = fit->of[i][k] + 2 * x * one[k] - two[k];
            two[k] = one[k];
            one[k] = next;
        }
    }
    for (int k = 0; k < OF; k++) {
        value[k] = fit->of[0][k] + x * one[k] - two[k];
    }
}

static void transform(const double value[FIT][OF], struct fit *fit)
{
    static double cosines[FIT][FIT];
    for (int j = 0; j < FIT && cosines[0][0] == 0; j++) {
        for (int i = 0; i < FIT; i++) {
            cosines[FIT - 1 - j][i] =
                (i > 0 ? 2.0 : 1.0) / FIT * cos(pi * i * (FIT - 1 - j + 0.5) / FIT);
        }
    }
    memset(fit->of, 0, sizeof fit->of);
    for (int j = 0; j < FIT; j++) {
        for (int i = 0; i < FIT; i++) {
            for (int k = 0; k < OF; k++) {
                fit->of[i][k] += cosines[j][i] * value[j][k];
            }
        }
    }
}

/* Result: it is right to a share of 1e-9, waves to 1e-8. */
static bool make_fit(const struct job *job, const double way[2], double low, double high,
                     bool is_lit, struct fit *fit)
{
    static const double tries[] = {0.003, 0.021, 0.347, 0.618, 0.985, 0.998};
    double most[OF] = {0}, at[FIT][OF];
    fit->low = low;
    fit->high = high;
    for (int i = 0; i < FIT; i++) {
        const double x = cos(pi * (i + 0.5) / FIT);
        value_of(job, way, (low + high + (high - low) * x) / 2, is_lit, at[i]);
        for (int k = 0; k < OF; k++) {
            most[k] = fmax(most[k], fabs(at[i][k]));
        }
    }
    transform((const double(*)[OF])at, fit);
    most[0] = 10;
    bool good = true;
    for (int i = 0; i < 6 && good; i++) {
        const double r = low + tries[i] * (high - low);
        double is[OF], should[OF];
        fitted(fit, r, is);
        value_of(job, way, r, is_lit, should);
        for (int k = 0; k < OF; k++) {
            good = good && fabs(is[k] - should[k]) <= 1e-9 * most[k];
        }
    }
    return good;
}

/* The steepest wave by wave. */
static void add_phases(const struct fit *fit, double *sums)
{
    double steepest = 0, last = 0, value[OF];
    for (int i = 0; i <= LOOKS; i++) {
        fitted(fit, fit->low + (fit->high - fit->low) * i / LOOKS, value);
        steepest = i > 0 ? fmax(steepest, fabs(value[0] - last)) : 0;
        last = value[0];
    }
    const int panels = 1 + (int)(LOOKS * steepest);
    const double half = (fit->high - fit->low) / panels / 2;
    for (int i = 0; i < 15 * panels; i++) {
        const int j = i % 15, k = j < 8 ? j : 14 - j;
        fitted(fit, fit->low + (2 * (i / 15) + 1 + (j < 8 ? -1 : 1) * nodes[k]) * half, value);
        const double wave = value[0], weight = kronrod[k] * half * value[LIGHT_OF - WAVE_OF];
        const double waves[SUMS] = {1, wave, wave * wave, cos(2 * pi * wave), sin(2 * pi * wave)};
        for (int m = 0; m < SUMS; m++) {
            sums[m] += weight * waves[m];
        }
    }
}

/* How far out a ray comes. */
static double out_at(const struct fit *fit, double r)
{
    double value[OF];
    fitted(fit, r, value);
    return hypot(value[X_OF - WAVE_OF], value[Y_OF - WAVE_OF]);
}

static double light_between(const struct fit *fit, double low, double high)
{
    double sum = 0;
    for (int i = 0; i < 15; i++) {
        const int k = i < 8 ? i : 14 - i;
        double value[OF];
        fitted(fit, (low + high + (high - low) * (i < 8 ? -1 : 1) * nodes[k]) / 2, value);
        sum += kronrod[k] * (high - low) / 2 * value[LIGHT_OF - WAVE_OF];
    }
    return sum;
}

/* Light within a disc, from how far out rays come; result: how often its edge is crossed. */
static int add_disc(const struct fit *fit, const double *out, double disc, double *sum)
{
    double from = fit->low;
    int crossed = 0;
    for (int i = 1; i <= LOOKS; i++) {
        double low = fit->low + (fit->high - fit->low) * (i - 1) / LOOKS;
        double high = fit->low + (fit->high - fit->low) * i / LOOKS;
        const bool was_beyond = out[i - 1] > disc;
        if (was_beyond == (out[i] > disc)) {
            continue;
        }
        for (int turns = 0; turns < 36; turns++) {
            const double middle = (low + high) / 2;
            const bool is_beyond = out_at(fit, middle) > disc;
            low = is_beyond == was_beyond ? middle : low;
            high = is_beyond == was_beyond ? high : middle;
        }
        *sum += was_beyond ? 0 : light_between(fit, from, low);
        from = high;
        crossed++;
    }
    *sum += out[LOOKS] > disc ? 0 : light_between(fit, from, fit->high);
    return crossed;
}

static long add_discs(const struct job *job, const struct fit *fit, double *sums)
{
    double unused[SUMS] = {0};
    sums = sums != NULL ? sums : unused;
    double out[LOOKS + 1];
    long crossed = 0;
    for (int i = 0; i <= LOOKS; i++) {
        out[i] = out_at(fit, fit->low + (fit->high - fit->low) * i / LOOKS);
    }
    for (int i = 0; i < job->disc_count; i++) {
        crossed = 7 * crossed + add_disc(fit, out, job->discs[i], &sums[1 + i]);
    }
    sums[0] += light_between(fit, fit->low, fit->high);
    return crossed;
}

/* Halves where one polynomial does not follow. Result: how often discs are crossed; null: that
   alone is asked. */
static long add_fitted(const struct job *job, const double way[2], double low, double high,
                       int depth, double *sums)
{
    enum { DEEPEST = 24 };
    struct fit fit;
    if (!make_fit(job, way, low, high, sums != NULL, &fit)) {
        const double middle = (low + high) / 2;
        return depth == DEEPEST ? 0
                                : add_fitted(job, way, low, middle, depth + 1, sums) +
                                      add_fitted(job, way, middle, high, depth + 1, sums);
    }
    if (job->sphere != NULL) {
        add_phases(&fit, sums);
    }
    return job->disc_count > 0 ? add_discs(job, &fit, sums) : 0;
}

#endif
