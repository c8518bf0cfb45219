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
 *   energy TOLERANCE ANGLE COUNT RADIUS...  shares of the light within these, up to six, of the
 *       centroid
 *
 * Each question is answered by a line: the values, what they may be off (relative), and the share
 * of what passes that is not joined to the part that was summed; or "none".
 *
 * Nothing here is like lenscalc: rays start where they come nearest to a vertex; what is clear is
 * known as yes or no alone; a grid finds what is joined; in polar coordinates about its middle
 * edges are bisected, and Gauss and Kronrod's rules halve intervals of the radius and of the angle
 * until they agree.
 * Equal areas of the stop are Jacobians by differences of fourth order; irradiance is an area of
 * direction cosines.
 */
#include "clear_fits.h"

#include <stdio.h>
#include <stdlib.h>

/* -------- along a line -------- */

/* A ray of a line and its weight: what it adds. */
static void add_ray(const struct job *job, const struct passage *all, double weight, double *sums)
{
    if (job->is_field) {
        sums[0] += isfinite(weight) ? weight : 0;
        return;
    }
    if (job->is_moved) {
        const double wave = wave_of(job->sphere, &all->ray);
        const double y = slope_of(job->sphere, &all->ray, 1);
        const double z = slope_of(job->sphere, &all->ray, 2);
        const double squares[SUMS] = {1, wave, y, z, wave * y, wave * z, y * y, y * z, z * z};
        for (int k = 0; k < SUMS && isfinite(weight * (wave + y + z)); k++) {
            sums[k] += weight * squares[k];
        }
        return;
    }
    double at[3];
    at_image(&all->ray, at);
    const double a = at[0] - job->origin[0], b = at[1] - job->origin[1];
    const double moments[SUMS] = {1, a, b, a * a, b * b};
    for (int k = 0; k < SUMS && isfinite(weight * (a * a + b * b)); k++) {
        sums[k] += weight * moments[k];
    }
}

/*
 * A stretch of a line, halved until its sums stand: where rays come to graze a surface its end is
 * steep. Before the order of the sums is known it is not halved.
 */
static void add_stretch(struct job *job, const double way[2], double low, double high, int depth,
                        double *sums)
{
    enum { DEEPEST = 40 };
    double fine[SUMS] = {0}, rough[SUMS] = {0};
    const double half = (high - low) / 2, *middle = job->region->middle;
    for (int i = 0; i < 15; i++) {
        const int k = i < 8 ? i : 14 - i;
        const double r = (low + high) / 2 + (i < 8 ? -half : half) * nodes[k];
        const double u = middle[0] + r * way[0], v = middle[1] + r * way[1];
        double here[SUMS] = {0};
        const struct passage all = look(job->beam, u, v, false);
        add_ray(job, &all, kronrod[k] * half * r * area_of(job, u, v), here);
        for (int m = 0; m < SUMS; m++) {
            fine[m] += here[m];
            rough[m] += k % 2 == 1 ? here[m] * seven[k / 2] / kronrod[k] : 0;
        }
    }
    bool good = true;
    for (int m = 0; m < SUMS && job->is_scaled; m++) {
        const double off = 2 * pi * fabs(fine[m] - rough[m]) / job->scale[m];
        good = good && !(pow(200 * off, 1.5) > fmax(job->tolerance / 20, noise));
    }
    if (!good && depth < DEEPEST) {
        add_stretch(job, way, low, (low + high) / 2, depth + 1, sums);
        add_stretch(job, way, (low + high) / 2, high, depth + 1, sums);
        return;
    }
    for (int m = 0; m < SUMS; m++) {
        sums[m] += fine[m];
        if (!good) {
            job->line_doubt += fabs(fine[m] - rough[m]) / job->scale[m];
        }
    }
}

/* From one edge to the next along a line. Result: how often discs are crossed; null: no more. */
static long add_piece(struct job *job, const double way[2], double low, double high, double *sums)
{
    if (job->disc_count > 0 || (job->sphere != NULL && !job->is_moved && sums != NULL)) {
        return add_fitted(job, way, low, high, 0, sums);
    }
    if (sums != NULL && job->beam->is_film) {
        sums[0] += (high - low) * (high + low) / 2;
    } else if (sums != NULL) {
        add_stretch(job, way, low, high, 0, sums);
    }
    return 0;
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
    return look(job->beam, at[0], at[1], false).limit;
}

/*
 * All that passes in one direction from the middle; null: it is not wanted. Result: a number for
 * the edges that it meets, in their order: it changes where the edge has a corner.
 */
static long sum_line(struct job *job, double angle, double *sums)
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
        if (here == 0) {
            edges = 1009 * edges + add_piece(job, way, from, low, sums);
        }
        edges = edges * (SURFACES + 3) + (here == 0 ? beyond : before);
        from = high;
        here = next;
    }
    return edges;
}

/* A corner of the edge between two angles; `high` if there is none. */
static double corner(struct job *job, double low, double high)
{
    const long first = sum_line(job, low, NULL);
    double from = low, to = high;
    if (first == sum_line(job, high, NULL)) {
        return high;
    }
    for (int turns = 0; turns < 60 && to - from > 1e-13; turns++) {
        const double middle = (from + to) / 2;
        if (sum_line(job, middle, NULL) == first) {
            from = middle;
        } else {
            to = middle;
        }
    }
    return (from + to) / 2;
}

/* Both rules agree, too, where a corner lies between an end and the node next to it: what ends
   edges counts. */
static void integrate(struct job *job, double low, double high, int depth, double *sums)
{
    enum { DEEPEST = 40 };
    /* rad: a corner so near to an end changes less than what is asked for */
    const double narrow = fmax(1e-5, 10 * job->tolerance);
    double fine[SUMS] = {0}, rough[SUMS] = {0}, here[SUMS], lines = 0;
    const double half = (high - low) / 2, beside = 1e-7 * (high - low);
    const long first = sum_line(job, low + beside, NULL);
    bool is_smooth = sum_line(job, high - beside, NULL) == first;
    for (int i = 0; i < 15; i++) {
        const int k = i < 8 ? i : 14 - i;
        memset(here, 0, sizeof here);
        const double angle = (low + high) / 2 + (i < 8 ? -half : half) * nodes[k];
        job->line_doubt = 0;
        is_smooth = sum_line(job, angle, here) == first && is_smooth;
        lines += half * kronrod[k] * job->line_doubt;
        for (int m = 0; m < SUMS; m++) {
            fine[m] += half * kronrod[k] * here[m];
            rough[m] += k % 2 == 1 ? half * seven[k / 2] * here[m] : 0;
        }
    }
    bool good = is_smooth || high - low < narrow;
    for (int m = 0; m < SUMS; m++) {
        const double off = fabs(fine[m] - rough[m]) / job->scale[m];
        good = good && !(pow(200 * off, 1.5) > job->tolerance / 20);
    }
    if (!good && depth < DEEPEST) {
        const double least = 1e-9 * (high - low), found = corner(job, low, high);
        const bool is_between = found > low + least && found < high - least;
        const double middle = is_between ? found : (low + high) / 2;
        integrate(job, low, middle, depth + 1, sums);
        integrate(job, middle, high, depth + 1, sums);
        return;
    }
    job->lines_doubt += lines;
    for (int m = 0; m < SUMS; m++) {
        sums[m] += fine[m];
        /* so often halved is where edges have corners */
        const double off = fabs(fine[m] - rough[m]) / job->scale[m];
        job->doubt[m] += depth < 5 ? fmin(off, pow(200 * off, 1.5)) : off;
    }
}

/* What each sum may be at most by the others: roots of products of squares. */
static void set_scales(struct job *job)
{
    double *scale = job->scale;
    const double light = scale[0];
    if (job->is_moved) {
        for (int m = 1; m < 4; m++) {
            scale[m] = scale[m] > 0 ? scale[m] : light;
        }
        for (int m = 4; m < SUMS; m++) {
            static const int of[SUMS][2] = {[4] = {1, 2}, {1, 3}, {2, 2}, {2, 3}, {3, 3}};
            scale[m] = scale[of[m][0]] * scale[of[m][1]] / light;
        }
        return;
    }
    const double size = job->sphere != NULL ? scale[2] : scale[3] + scale[4];
    for (int m = 1; m < SUMS; m++) {
        scale[m] = m < 3 ? sqrt(size * light) : size;
        scale[m] = job->disc_count > 0 ? light : scale[m];
        if (job->sphere != NULL) {
            scale[m] = m == 2 ? size : m > 2 ? light : scale[m];
        }
        scale[m] = scale[m] > 0 ? scale[m] : 1;
    }
}

static double sum_all(struct job *job, double *sums)
{
    enum { PIECES = 40 };
    const double *middle = job->region->middle;
    double doubt = 0;
    /* fields lie in y, and what is summed is one half of what mirrors itself */
    const int halves = middle[0] == 0 ? 2 : 1;
    /* the order of the sums first, by few lines */
    memset(job->scale, 0, sizeof job->scale);
    for (int i = 0; i < 4 * PIECES; i++) {
        double here[SUMS] = {0};
        sum_line(job, 2 * pi * (i + 0.5) / (4 * PIECES), here);
        for (int m = 0; m < SUMS; m++) {
            job->scale[m] += 2 * pi / (4 * PIECES) * fabs(here[m]);
        }
    }
    set_scales(job);
    job->is_scaled = true;
    const double first = halves == 2 ? -pi / 2 : 0.6 * pi / PIECES;
    for (int i = 0; i < PIECES / halves; i++) {
        integrate(job, first + 2 * pi * i / PIECES, first + 2 * pi * (i + 1) / PIECES, 0, sums);
    }
    for (int m = 0; m < SUMS; m++) {
        sums[m] *= halves;
        doubt = fmax(doubt, halves * job->doubt[m]);
    }
    if (halves == 2 && job->sphere == NULL && job->disc_count == 0) {
        sums[1] = 0; /* of x */
    }
    return doubt + halves * job->lines_doubt;
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

/*
 * Gauss and Newton's steps to the least mean square in y and z of the centre; fields lie in y.
 * False: they do not end.
 */
static bool fit_sphere(const struct beam *beam, double tolerance, struct sphere *sphere)
{
    enum { STEPS = 30 };
    double rough = fmax(tolerance, 1e-4); /* while it is far from there */
    for (int turns = 0; turns < STEPS; turns++) {
        struct job job = {.beam = beam,
                          .region = &region,
                          .sphere = sphere,
                          .is_moved = true,
                          .tolerance = rough};
        double s[SUMS] = {0};
        sum_all(&job, s);
        const double w = s[1] / s[0], y = s[2] / s[0], z = s[3] / s[0];
        const double wy = s[4] / s[0] - w * y, wz = s[5] / s[0] - w * z;
        const double yy = s[6] / s[0] - y * y, yz = s[7] / s[0] - y * z, zz = s[8] / s[0] - z * z;
        const double det = yy * zz - yz * yz;
        if (!(det > 0)) {
            return false;
        }
        const double dy = -(zz * wy - yz * wz) / det, dz = -(yy * wz - yz * wy) / det;
        sphere->centre[1] += dy;
        sphere->centre[2] += dz;
        /* what that changes of the waves */
        const double change = sqrt(yy * dy * dy + 2 * yz * dy * dz + zz * dz * dz);
        if (change < 1e-8 && rough <= tolerance) {
            return true;
        }
        rough = change < 1e-4 ? tolerance : rough;
    }
    return false;
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
        if (!fit_sphere(&beam, tolerance, &sphere)) {
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

/* Of all wavelengths moments about the first one's chief ray, or the light within discs about
   `middle`; false: there is none. */
static bool add_waves(double tolerance, double angle, const double *middle, const double *discs,
                      int disc_count, double *sums, double *doubt)
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
                          .disc_count = disc_count,
                          .tolerance = tolerance};
        if (disc_count > 0) {
            memcpy(job.middle, middle, sizeof job.middle);
            memcpy(job.discs, discs, (size_t)disc_count * sizeof *discs);
        }
        *doubt = fmax(*doubt, sum_all(&job, own));
        for (int m = 0; m < SUMS; m++) {
            sums[m] += weights[g] * own[m];
        }
    }
    if (disc_count == 0) {
        sums[1] += sums[0] * origin[0];
        sums[2] += sums[0] * origin[1];
    }
    return true;
}

static void answer_energy(double tolerance, double angle, const double *radii, int count)
{
    double all[SUMS], sums[SUMS], doubt = 0;
    if (!add_waves(tolerance, angle, NULL, NULL, 0, all, &doubt)) {
        puts("none");
        return;
    }
    const double middle[2] = {all[1] / all[0], all[2] / all[0]};
    add_waves(tolerance, angle, middle, radii, count, sums, &doubt);
    for (int i = 0; i < count; i++) {
        printf("%.17g ", sums[1 + i] / sums[0]);
    }
    printf("%.3g\n", doubt);
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
        *s = (struct surface){.c = number()};
        s->k = number();
        s->z = number();
        s->clear = number();
        s->blocked = number();
        s->is_mirror = number() != 0;
        s->bends[0] = number();
        s->bends[1] = number();
        for (int k = 0; k < TERMS; k++) {
            s->terms[k] = number();
            s->has_terms = s->has_terms || s->terms[k] != 0;
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
        } else if (strcmp(word, "field") == 0) {
            answer_field(tolerance, value);
        } else if (strcmp(word, "energy") == 0) {
            double radii[RADII];
            const int count = (int)number();
            for (int i = 0; i < count && i < RADII; i++) {
                radii[i] = number();
            }
            answer_energy(tolerance, value, radii, count < RADII ? count : RADII);
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
