/* tests/truth/clear_sums.c - sums over what passes a lens, by other means than lenscalc's. */
/* SPDX-License-Identifier: MIT */

/*
 * Standard input has words separated by blanks:
 *
 *   lens SURFACES WAVELENGTHS STOP STOP_RADIUS TRACK
 *       then each wavelength's weight, and the surfaces:
 *       curvature conic vertex_z clear_radius blocked_radius mirror bends_in_x bends_in_y
 *       A2 A4 ... A16 n n ... behind it
 *   spot TOLERANCE ANGLE   rms, rms_x, rms_y, rms_chief (mm) of light from infinity, deg
 *   film TOLERANCE HEIGHT  irradiance per radiance at that height of the image plane, primary only
 *
 * Each question is answered by a line: the values, what they may be off (relative), and the share
 * of what passes that is not joined to the part that was summed; or "none".
 *
 * Nothing here is like lenscalc: rays start where they come nearest to a vertex; what is clear is
 * known as yes or no alone; a grid finds what is joined; in polar coordinates about its middle
 * edges are bisected and Gauss and Kronrod's rules halve intervals of the angle until they agree.
 * Equal areas of the stop are Jacobians by differences of fourth order; irradiance is an area of
 * direction cosines.
 */
#include "clear_region.h"

#include <stdio.h>
#include <stdlib.h>

enum { RADIAL = 32, NODES = 20, SUMS = 6 };
static const double pi = 3.14159265358979323846;

struct job {
    const struct beam *beam;
    const struct region *region;
    double origin[2];   /* where distances are from, mm */
    double scale[SUMS]; /* what sums are of the order of */
    double tolerance, doubt[SUMS];
};

static void gauss(int n, double *x, double *w)
{
    for (int i = 0; i < n; i++) {
        double t = cos(pi * (i + 0.75) / (n + 0.5)), slope = 1;
        for (int turns = 0; turns < 60; turns++) {
            double a = 1, b = t;
            for (int k = 2; k <= n; k++) {
                const double c = ((2 * k - 1) * t * b - (k - 1) * a) / k;
                a = b;
                b = c;
            }
            slope = n * (t * b - a) / (t * t - 1);
            t -= b / slope;
        }
        x[i] = t;
        w[i] = 2 / ((1 - t * t) * slope * slope);
    }
}

/* |d(stop)/d(u, v)|, in units of the stop. */
static double area_of(const struct beam *beam, double u, double v, double h)
{
    double m[4];
    for (int k = 0; k < 2; k++) {
        static const double at[4] = {-2, -1, 1, 2};
        static const double share[4] = {1. / 12, -8. / 12, 8. / 12, -1. / 12};
        double sum[2] = {0, 0};
        for (int i = 0; i < 4; i++) {
            const double step = at[i] * h;
            const struct passage ray =
                look(beam, u + (k == 0 ? step : 0), v + (k == 1 ? step : 0), true);
            sum[0] += share[i] * ray.at_stop[0];
            sum[1] += share[i] * ray.at_stop[1];
        }
        m[k] = sum[0] / h;
        m[2 + k] = sum[1] / h;
    }
    return fabs(m[0] * m[3] - m[1] * m[2]) / (stop_radius * stop_radius);
}

/* From one edge to the next along a line. */
static void add_piece(const struct job *job, const double way[2], double low, double high,
                      double *sums)
{
    static double x[NODES], w[NODES];
    if (w[0] == 0) {
        gauss(NODES, x, w);
    }
    if (job->beam->is_film) {
        sums[0] += (high - low) * (high + low) / 2;
        return;
    }
    for (int i = 0; i < NODES; i++) {
        const double r = (low + high) / 2 + x[i] * (high - low) / 2;
        const double *middle = job->region->middle;
        const double u = middle[0] + r * way[0], v = middle[1] + r * way[1];
        const struct passage all = look(job->beam, u, v, false);
        const double weight =
            w[i] * (high - low) / 2 * r * area_of(job->beam, u, v, 2e-3 * job->region->farthest);
        const double t = (image_z - all.ray.p[2]) / all.ray.d[2];
        const double a = all.ray.p[0] + t * all.ray.d[0] - job->origin[0];
        const double b = all.ray.p[1] + t * all.ray.d[1] - job->origin[1];
        const double add[SUMS] = {1, a, b, a * a, b * b, 0};
        for (int k = 0; k < SUMS && isfinite(weight * (a * a + b * b)); k++) {
            sums[k] += weight * add[k];
        }
    }
}

/* Is a place within the part, or beside it? */
static bool is_own(const struct region *region, const double at[2])
{
    const int x = (int)floor((at[0] - region->low[0]) / region->cell[0]);
    const int y = (int)floor((at[1] - region->low[1]) / region->cell[1]);
    bool own = false;
    for (int i = x - 1; i <= x + 1; i++) {
        for (int j = y - 1; j <= y + 1; j++) {
            own = own ||
                  (i >= 0 && j >= 0 && i < SIDE && j < SIDE && region->part[i][j] == region->whole);
        }
    }
    return own;
}

/* What ends the light in a place; 0: nothing. */
static int ending(const struct job *job, const double way[2], double r)
{
    const double at[2] = {job->region->middle[0] + r * way[0], job->region->middle[1] + r * way[1]};
    return is_own(job->region, at) ? limit_of(job->beam, at[0], at[1]) : SURFACES + 1;
}

/*
 * All that passes in one direction from the middle; null: it is not wanted. Result: a number for
 * the edges that it meets, in their order: it changes where the edge has a corner.
 */
static long sum_line(const struct job *job, double angle, double *sums)
{
    const double way[2] = {cos(angle), sin(angle)}, far = job->region->farthest;
    int here = ending(job, way, 0);
    long edges = 0;
    double from = 0;
    for (int i = 1; i <= RADIAL; i++) {
        double low = far * (i - 1) / RADIAL, high = far * i / RADIAL;
        int beyond = i < RADIAL ? ending(job, way, high) : SURFACES + 1;
        const int next = beyond;
        if ((here == 0) == (next == 0)) {
            continue;
        }
        int before = here;
        for (int turns = 0; turns < 46; turns++) {
            const double middle = (low + high) / 2;
            const int limit = ending(job, way, middle);
            if ((limit == 0) == (here == 0)) {
                low = middle;
                before = limit;
            } else {
                high = middle;
                beyond = limit;
            }
        }
        if (here == 0 && sums != NULL) {
            add_piece(job, way, from, low, sums);
        }
        edges = edges * (SURFACES + 2) + (here == 0 ? beyond : before);
        from = high;
        here = next;
    }
    return edges;
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

/* A corner of the edge between two angles; `high` if there is none. */
static double corner(const struct job *job, double low, double high)
{
    const long first = sum_line(job, low, NULL);
    double from = low, to = high;
    if (first == sum_line(job, high, NULL)) {
        return high;
    }
    for (int turns = 0; turns < 60 && to - from > 1e-15; turns++) {
        const double middle = (from + to) / 2;
        if (sum_line(job, middle, NULL) == first) {
            from = middle;
        } else {
            to = middle;
        }
    }
    return (from + to) / 2;
}

static void integrate(struct job *job, double low, double high, int depth, double *sums)
{
    double fine[SUMS] = {0}, rough[SUMS] = {0}, here[SUMS];
    const double half = (high - low) / 2;
    for (int i = 0; i < 15; i++) {
        const int k = i < 8 ? i : 14 - i;
        memset(here, 0, sizeof here);
        sum_line(job, (low + high) / 2 + (i < 8 ? -half : half) * nodes[k], here);
        for (int m = 0; m < SUMS; m++) {
            fine[m] += half * kronrod[k] * here[m];
            rough[m] += k % 2 == 1 ? half * seven[k / 2] * here[m] : 0;
        }
    }
    bool good = true;
    for (int m = 0; m < SUMS; m++) {
        const double off = fabs(fine[m] - rough[m]) / job->scale[m];
        good = good && !(pow(200 * off, 1.5) > job->tolerance / 20);
    }
    if (!good && depth < 40) {
        const double least = 1e-9 * (high - low), found = corner(job, low, high);
        const bool is_between = found > low + least && found < high - least;
        const double middle = is_between ? found : (low + high) / 2;
        integrate(job, low, middle, depth + 1, sums);
        integrate(job, middle, high, depth + 1, sums);
        return;
    }
    for (int m = 0; m < SUMS; m++) {
        sums[m] += fine[m];
        /* so often halved is where edges have corners */
        const double off = fabs(fine[m] - rough[m]) / job->scale[m];
        job->doubt[m] += depth < 5 ? fmin(off, pow(200 * off, 1.5)) : off;
    }
}

static double sum_all(struct job *job, double *sums)
{
    enum { PIECES = 40 };
    double doubt = 0;
    /* the order of the sums first, by few lines */
    memset(job->scale, 0, sizeof job->scale);
    for (int i = 0; i < 4 * PIECES; i++) {
        double here[SUMS] = {0};
        sum_line(job, 2 * pi * (i + 0.5) / (4 * PIECES), here);
        for (int m = 0; m < SUMS; m++) {
            job->scale[m] += 2 * pi / (4 * PIECES) * fabs(here[m]);
        }
    }
    const double size = job->beam->is_film ? 0 : job->scale[3] + job->scale[4];
    for (int m = 1; m < SUMS; m++) {
        job->scale[m] = m < 3 ? sqrt(size * job->scale[0]) : size;
        job->scale[m] = job->scale[m] > 0 ? job->scale[m] : 1;
    }
    for (int i = 0; i < PIECES; i++) {
        integrate(job, 2 * pi * (i + 0.3) / PIECES, 2 * pi * (i + 1.3) / PIECES, 0, sums);
    }
    for (int m = 0; m < SUMS; m++) {
        doubt = fmax(doubt, job->doubt[m]);
    }
    return doubt;
}

/* -------- questions -------- */

static struct region region;

static double widest(void)
{
    const double clear = surfaces[0].clear;
    return isfinite(clear) ? 2.5 * clear : 12 * stop_radius + fabs(surfaces[surface_count - 1].z);
}

static void answer_film(double tolerance, double height)
{
    const struct beam beam = {.is_film = true, .height = height};
    struct job job = {.beam = &beam, .region = &region, .tolerance = tolerance};
    double sums[SUMS] = {0};
    bool has_chief;
    if (!find_region(&beam, 1, &region, &has_chief)) {
        puts("none");
        return;
    }
    const double doubt = sum_all(&job, sums);
    const double n = surfaces[surface_count - 1].n[0];
    printf("%.17g %.3g %.4g\n", n * n * sums[0], doubt, region.islands);
}

static void answer_spot(double tolerance, double angle)
{
    double sums[SUMS] = {0}, origin[2] = {0, 0}, doubt = 0, islands = 0;
    for (int g = 0; g < wave_count; g++) {
        const struct beam beam = {
            .sine = sin(angle * pi / 180), .cosine = cos(angle * pi / 180), .wave = g};
        double own[SUMS] = {0};
        bool has_chief;
        if (!find_region(&beam, widest(), &region, &has_chief) || (g == 0 && !has_chief)) {
            puts("none");
            return;
        }
        if (g == 0) {
            const struct passage chief = look(&beam, region.chief[0], region.chief[1], false);
            const double t = (image_z - chief.ray.p[2]) / chief.ray.d[2];
            origin[0] = chief.ray.p[0] + t * chief.ray.d[0];
            origin[1] = chief.ray.p[1] + t * chief.ray.d[1];
            islands = region.islands;
        }
        struct job job = {.beam = &beam,
                          .region = &region,
                          .origin = {origin[0], origin[1]},
                          .tolerance = tolerance};
        doubt = fmax(doubt, sum_all(&job, own));
        for (int m = 0; m < SUMS; m++) {
            sums[m] += weights[g] * own[m];
        }
    }
    const double x = sums[1] / sums[0], y = sums[2] / sums[0];
    const double xx = sums[3] / sums[0] - x * x, yy = sums[4] / sums[0] - y * y;
    printf("%.17g %.17g %.17g %.17g %.3g %.4g\n", sqrt(fmax(xx + yy, 0)), sqrt(fmax(xx, 0)),
           sqrt(fmax(yy, 0)), sqrt((sums[3] + sums[4]) / sums[0]), doubt, islands);
}

static double number(void)
{
    char word[64];
    return scanf("%63s", word) == 1 ? strtod(word, NULL) : NAN;
}

static void read_lens(void)
{
    surface_count = (int)number();
    wave_count = (int)number();
    stop = (int)number();
    stop_radius = number();
    image_z = number();
    if (!(surface_count > 0 && surface_count <= SURFACES && wave_count <= WAVES)) {
        exit(2);
    }
    for (int g = 0; g < wave_count; g++) {
        weights[g] = number();
    }
    for (int i = 0; i < surface_count; i++) {
        struct surface *s = &surfaces[i];
        s->c = number();
        s->k = number();
        s->z = number();
        s->clear = number();
        s->blocked = number();
        s->is_mirror = number() != 0;
        s->bends[0] = number();
        s->bends[1] = number();
        for (int k = 0; k < TERMS; k++) {
            s->terms[k] = number();
        }
        for (int g = 0; g < wave_count; g++) {
            s->n[g] = number();
        }
    }
}

int main(void)
{
    char word[64];
    while (scanf("%63s", word) == 1) {
        if (strcmp(word, "lens") == 0) {
            read_lens();
            continue;
        }
        const double tolerance = number(), value = number();
        if (strcmp(word, "film") == 0) {
            answer_film(tolerance, value);
        } else if (strcmp(word, "spot") == 0) {
            answer_spot(tolerance, value);
        } else {
            return 2;
        }
        fflush(stdout);
    }
    return 0;
}
