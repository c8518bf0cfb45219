/* tests/truth/clear_sums.c - sums over what passes a lens, by other means than lenscalc's. */
/* SPDX-License-Identifier: MIT */

/*
 * Standard input has words separated by blanks, lengths in mm:
 *
 *   lens SURFACES WAVELENGTHS STOP STOP_RADIUS TRACK
 *       then each wavelength's weight, and the surfaces:
 *       curvature conic vertex_z clear_radius blocked_radius mirror bends_in_x bends_in_y
 *       A2 A4 ... A16 n n ... behind it
 *   spot TOLERANCE ANGLE   rms, rms_x, rms_y, rms_chief (mm) of light from infinity, deg
 *   film TOLERANCE HEIGHT  irradiance per radiance at that height of the image plane, primary only
 *   field TOLERANCE ANGLE  area in direction cosines behind the lens, times n^2, primary only
 *   wave TOLERANCE ANGLE WAVELENGTH PUPIL BEST  rms, Strehl ratio and rms about the chief ray's
 *       image; wavelength in mm, the exit pupil's z or inf, BEST 1: about the sphere that fits best
 *   energy TOLERANCE ANGLE RADIUS RADIUS  shares of the light within these of the centroid
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
#include "clear_waves.h"

#include <stdio.h>
#include <stdlib.h>

enum { RADIAL = 32, NODES = 20, SUMS = 6, SHEAF = 1 << 20 };
static const double pi = 3.14159265358979323846;

struct job {
    const struct beam *beam;
    const struct region *region;
    const struct sphere *sphere; /* of wave fronts */
    bool is_field;               /* areas behind the lens */
    struct sheaf *sheaf;         /* rays are kept: `panels` pieces of a line and one that is cut */
    int panels;
    double cut;             /* where, so that no two lines have the same radii */
    double disc, middle[2]; /* where above 0, light beyond so far from there is left out */
    int finer;              /* looks then: a circle may be met in a narrow band of the pupil */
    double origin[2];       /* where distances are from, mm */
    double scale[SUMS];     /* what sums are of the order of */
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

/* |d(stop)/d(u, v)| in units of the stop, or of the direction behind the lens. */
static double area_of(const struct job *job, double u, double v)
{
    const double h = 2e-3 * job->region->farthest;
    double m[4];
    for (int k = 0; k < 2; k++) {
        static const double at[4] = {-2, -1, 1, 2};
        static const double share[4] = {1. / 12, -8. / 12, 8. / 12, -1. / 12};
        double sum[2] = {0, 0};
        for (int i = 0; i < 4; i++) {
            const double step = at[i] * h;
            const struct passage ray =
                look(job->beam, u + (k == 0 ? step : 0), v + (k == 1 ? step : 0), !job->is_field);
            const double *of = job->is_field ? ray.ray.d : ray.at_stop;
            sum[0] += share[i] * (job->is_field && !ray.arrives ? NAN : of[0]);
            sum[1] += share[i] * of[1];
        }
        m[k] = sum[0] / h;
        m[2 + k] = sum[1] / h;
    }
    return fabs(m[0] * m[3] - m[1] * m[2]) / (job->is_field ? 1 : stop_radius * stop_radius);
}

/* -------- along a line -------- */

/* Pieces of it so short that a rule of NODES points follows the phase. */
static int panels_of(const struct job *job, const double way[2], double low, double high)
{
    enum { LOOKS = 64 };
    double turns = 0, last = 0;
    for (int i = 0; i <= LOOKS && job->sphere != NULL; i++) {
        const double r = low + (high - low) * i / LOOKS, *middle = job->region->middle;
        const struct passage all =
            look(job->beam, middle[0] + r * way[0], middle[1] + r * way[1], false);
        const double wave = all.arrives ? wave_of(job->sphere, &all.ray) : last;
        turns += i > 0 ? fabs(wave - last) : 0;
        last = wave;
    }
    return 1 + (int)turns;
}

/* A ray of a line and its weight: what it adds. */
static void add_ray(const struct job *job, const struct passage *all, double weight, double *sums)
{
    if (job->is_field) {
        sums[0] += isfinite(weight) ? weight : 0;
        return;
    }
    if (job->sheaf != NULL) {
        struct sheaf *sheaf = job->sheaf;
        if (sheaf->count == SHEAF) {
            exit(3);
        }
        sheaf->rays[sheaf->count] = all->ray;
        sheaf->weights[sheaf->count++] = weight;
    }
    double at[3];
    at_image(&all->ray, at);
    const double a = at[0] - job->origin[0], b = at[1] - job->origin[1];
    const double wave = job->sphere != NULL ? wave_of(job->sphere, &all->ray) : 0;
    const double moments[SUMS] = {1, a, b, a * a, b * b, 0};
    const double waves[SUMS] = {1, wave, wave * wave, cos(2 * pi * wave), sin(2 * pi * wave), 0};
    const double *add = job->sphere != NULL ? waves : moments;
    for (int k = 0; k < SUMS && isfinite(weight * (a * a + b * b + wave)); k++) {
        sums[k] += weight * add[k];
    }
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
    const int panels = panels_of(job, way, low, high);
    const double half = (high - low) / panels / 2;
    for (int i = 0; i < panels * NODES; i++) {
        const double r = low + (2 * (i / NODES) + 1 + x[i % NODES]) * half;
        const double *middle = job->region->middle;
        const double u = middle[0] + r * way[0], v = middle[1] + r * way[1];
        const struct passage all = look(job->beam, u, v, false);
        add_ray(job, &all, w[i % NODES] * half * r * area_of(job, u, v), sums);
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
    if (!is_own(job->region, at)) {
        return SURFACES + 1;
    }
    double image[3];
    const struct passage all = look(job->beam, at[0], at[1], false);
    if (all.limit != 0 || !(job->disc > 0)) {
        return all.limit;
    }
    at_image(&all.ray, image);
    return hypot(image[0] - job->middle[0], image[1] - job->middle[1]) > job->disc ? SURFACES + 2
                                                                                   : 0;
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
    const int looks = job->disc > 0 ? job->finer * RADIAL : RADIAL;
    for (int i = 1; i <= looks; i++) {
        double low = far * (i - 1) / looks, high = far * i / looks;
        int beyond = i < looks ? ending(job, way, high) : SURFACES + 1;
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
        edges = edges * (SURFACES + 3) + (here == 0 ? beyond : before);
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
    const double size = job->sphere != NULL ? job->scale[2] : job->scale[3] + job->scale[4];
    for (int m = 1; m < SUMS; m++) {
        job->scale[m] = m < 3 ? sqrt(size * job->scale[0]) : size;
        if (job->sphere != NULL) {
            job->scale[m] = m == 2 ? size : m > 2 ? job->scale[0] : job->scale[m];
        }
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
static bool is_new_lens;

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

static void answer_field(double tolerance, double angle)
{
    const struct beam beam = {.sine = sin(angle * pi / 180), .cosine = cos(angle * pi / 180)};
    struct job job = {.beam = &beam, .region = &region, .tolerance = tolerance, .is_field = true};
    double sums[SUMS] = {0};
    bool has_chief;
    if (!find_region(&beam, widest(), &region, &has_chief) || !has_chief) {
        puts("none");
        return;
    }
    const double doubt = sum_all(&job, sums), n = surfaces[surface_count - 1].n[0];
    printf("%.17g %.3g %.4g\n", n * n * sums[0], doubt, region.islands);
}

/* The sphere about the chief ray's image point, through its crossing of the exit pupil. */
static struct sphere sphere_of(const struct beam *beam, double wavelength, double pupil)
{
    const struct passage chief = look(beam, region.chief[0], region.chief[1], false);
    struct sphere sphere = {.wavelength = wavelength,
                            .n = surfaces[surface_count - 1].n[beam->wave],
                            .is_plane = isinf(pupil)};
    at_image(&chief.ray, sphere.centre);
    const double t = (pupil - chief.ray.p[2]) / chief.ray.d[2];
    for (int k = 0; k < 3; k++) {
        sphere.crossing[k] = sphere.is_plane ? 0 : chief.ray.p[k] + t * chief.ray.d[k];
    }
    sphere.zero = path_to(&sphere, &chief.ray);
    return sphere;
}

/* Rays over all of the part, along lines between corners that are not looked for. */
static void fill_sheaf(struct job *job, struct sheaf *sheaf)
{
    enum { LINES = 720 };
    double sums[SUMS] = {0};
    sheaf->count = 0;
    job->sheaf = sheaf;
    for (int i = 0; i < LINES; i++) {
        sum_line(job, 2 * pi * (i + 0.5) / LINES, sums);
    }
    job->sheaf = NULL;
}

static struct sheaf sheaf;

static void open_sheaf(void)
{
    if (sheaf.rays == NULL) {
        sheaf.rays = malloc(SHEAF * sizeof *sheaf.rays);
        sheaf.weights = malloc(SHEAF * sizeof *sheaf.weights);
    }
}

static void answer_wave(double tolerance, double angle, double wavelength, double pupil, bool best)
{
    const struct beam beam = {.sine = sin(angle * pi / 180), .cosine = cos(angle * pi / 180)};
    double sums[SUMS] = {0};
    bool has_chief;
    if (!find_region(&beam, widest(), &region, &has_chief) || !has_chief) {
        puts("none");
        return;
    }
    struct sphere sphere = sphere_of(&beam, wavelength, pupil);
    struct job job = {.beam = &beam, .region = &region, .tolerance = tolerance};
    if (best) {
        open_sheaf();
        fill_sheaf(&job, &sheaf);
        if (!find_best(&sheaf, &sphere)) {
            puts("none");
            return;
        }
        const struct passage chief = look(&beam, region.chief[0], region.chief[1], false);
        sphere.zero = path_to(&sphere, &chief.ray);
    }
    job.sphere = &sphere;
    const double doubt = sum_all(&job, sums), mean = sums[1] / sums[0];
    printf("%.17g %.17g %.3g %.4g\n", sqrt(fmax(sums[2] / sums[0] - mean * mean, 0)),
           (sums[3] * sums[3] + sums[4] * sums[4]) / (sums[0] * sums[0]), doubt, region.islands);
}

/* Moments of all wavelengths about the first one's chief ray; false: there is none. */
static bool add_moments(double tolerance, double angle, double disc, int finer,
                        const double *middle, double *sums, double *doubt)
{
    double origin[2] = {0, 0};
    memset(sums, 0, SUMS * sizeof *sums);
    for (int g = 0; g < wave_count; g++) {
        const struct beam beam = {
            .sine = sin(angle * pi / 180), .cosine = cos(angle * pi / 180), .wave = g};
        double own[SUMS] = {0};
        bool has_chief;
        if (!find_region(&beam, widest(), &region, &has_chief) || (g == 0 && !has_chief)) {
            return false;
        }
        if (g == 0) {
            const struct passage chief = look(&beam, region.chief[0], region.chief[1], false);
            double at[3];
            at_image(&chief.ray, at);
            memcpy(origin, at, sizeof origin);
        }
        struct job job = {.beam = &beam,
                          .region = &region,
                          .origin = {origin[0], origin[1]},
                          .disc = disc,
                          .finer = finer,
                          .tolerance = tolerance};
        if (disc > 0) {
            memcpy(job.middle, middle, sizeof job.middle);
        }
        *doubt = fmax(*doubt, sum_all(&job, own));
        for (int m = 0; m < SUMS; m++) {
            sums[m] += weights[g] * own[m];
        }
    }
    sums[1] += sums[0] * origin[0];
    sums[2] += sums[0] * origin[1];
    return true;
}

static void answer_energy(double tolerance, double angle, const double radii[2])
{
    static double lens_angle = NAN, lens_middle[2], all[SUMS], known;
    double shares[2];
    if (is_new_lens || !(lens_angle == angle)) {
        known = 0;
        if (!add_moments(tolerance, angle, 0, 1, NULL, all, &known)) {
            puts("none");
            return;
        }
        lens_middle[0] = all[1] / all[0];
        lens_middle[1] = all[2] / all[0];
        lens_angle = angle;
        is_new_lens = false;
    }
    double doubt = known;
    for (int i = 0; i < 2; i++) {
        double sums[SUMS], few[SUMS];
        add_moments(tolerance, angle, radii[i], 4, lens_middle, few, &doubt);
        add_moments(tolerance, angle, radii[i], 12, lens_middle, sums, &doubt);
        shares[i] = sums[0] / all[0];
        doubt = fmax(doubt, fabs(sums[0] - few[0]) / all[0]);
    }
    printf("%.17g %.17g %.3g\n", shares[0], shares[1], doubt);
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
            is_new_lens = true;
            continue;
        }
        const double tolerance = number(), value = number();
        if (strcmp(word, "film") == 0) {
            answer_film(tolerance, value);
        } else if (strcmp(word, "spot") == 0) {
            answer_spot(tolerance, value);
        } else if (strcmp(word, "field") == 0) {
            answer_field(tolerance, value);
        } else if (strcmp(word, "energy") == 0) {
            const double first = number();
            answer_energy(tolerance, value, (double[2]){first, number()});
        } else if (strcmp(word, "wave") == 0) {
            const double wavelength = number(), pupil = number();
            answer_wave(tolerance, value, wavelength, pupil, number() != 0);
        } else {
            return 2;
        }
        fflush(stdout);
    }
    return 0;
}
