/* analysis/image/psf_energy.c - encircled and ensquared energy by diffraction. */
/* SPDX-License-Identifier: MIT */
#include "analysis/image/psf_energy.h"

#include "base/constants.h"
#include "base/lagrange.h"

#include <math.h>

enum { TAPS = LAGRANGE_MOST, FEW_TAPS = LAGRANGE_FEW, SMALL = 160, MARGIN = 2 * TAPS };

/* A pixel's side in resolved lengths: of a small image, and at most, see psf_radius_find. */
static const double fine = 0.25, coarse = 0.45;

/* What sums over the pupil and over the pixels leave of a share. */
static const double least = 1e-5;

/* -------- images -------- */

/* The pixels of an image that reaches so far from the chief ray. */
static bool energy_pixels_choose(double reach, double finest, struct psf_question *question,
                                 const char *unit, struct error *error)
{
    const double by_fine = ceil(2 * reach / (fine * finest)) + MARGIN;
    question->pitch = (by_fine <= SMALL ? fine : coarse) * finest;
    const double size = ceil(2 * reach / question->pitch) + MARGIN;
    if (size > PSF_SIZE_MOST) {
        return fail(error, ERROR_DOMAIN,
                    "an image %.4g %s from side to side wants %.0f pixels a side, and has at most "
                    "%d: a smaller radius, a smaller aperture, or rays (spot)",
                    2000 * reach, unit, size, PSF_SIZE_MOST);
    }
    question->size = (size_t)size;
    return true;
}

bool psf_energy_open(const struct psf_energy_question *question, struct arena *arena,
                     struct psf_energy_image *image, struct error *error)
{
    struct psf_question asked = {
        .bundle = question->bundle, .method = PSF_PLANE, .threads = question->threads};
    struct psf look;
    if (!psf_look(&question->bundle, arena, &look, error)) {
        return false;
    }
    const double usual = look.spread + 8 * look.finest;
    const double farthest = isnan(question->farthest) ? usual : question->farthest;
    /* the centroid of a coma lies a third of its length from the chief ray */
    const double aside = question->about_chief ? 0 : 0.4 * look.spread;
    const double reach = fmax(farthest + aside, 12 * look.finest);
    const char *unit = look.is_angular ? "mrad" : "um";
    *image = (struct psf_energy_image){.usual = usual};
    if (!energy_pixels_choose(reach, look.finest, &asked, unit, error) ||
        !psf_find(&asked, arena, &image->psf, error)) {
        return false;
    }
    for (int k = 0; k < 2; k++) {
        image->centre[k] = question->about_chief ? 0 : image->psf.centroid[k];
        image->off[k] = question->about_chief ? 0 : image->psf.centroid_error[k];
    }
    asked.is_perfect = true; /* about the chief ray */
    return !question->has_limit || (energy_pixels_choose(fmax(farthest, 12 * look.finest),
                                                         look.finest, &asked, unit, error) &&
                                    psf_find(&asked, arena, &image->perfect, error));
}

/* -------- light between pixels -------- */

/* Of a place in pixels from the first. */
static double energy_light_at(const struct psf *psf, double x, double y, size_t taps)
{
    double across[TAPS], up[TAPS], sum = 0;
    const size_t first_x = lagrange_factors(x, psf->size, taps, across);
    const size_t first_y = lagrange_factors(y, psf->size, taps, up);
    for (size_t j = 0; j < taps; j++) {
        const double *row = psf->values + (first_y + j) * psf->size + first_x;
        double of_row = 0;
        for (size_t k = 0; k < taps; k++) {
            of_row += across[k] * row[k];
        }
        sum += up[j] * of_row;
    }
    return sum;
}

/* Between two circles, in values of pixels; their centre and radii in pixels. */
static double energy_of_ring(const struct psf *psf, const double centre[2], const double radii[2],
                             size_t taps)
{
    const double panels = ceil((radii[1] - radii[0]) / 2), width = (radii[1] - radii[0]) / panels;
    double sum = 0;
    for (double panel = 0; panel < panels; panel++) {
        for (int i = 0; i < LAGRANGE_NODES; i++) {
            const double r = radii[0] + (panel + lagrange_nodes[i]) * width,
                         steps = 16 + ceil(4 * r);
            double around = 0;
            for (double j = 0; j < steps; j++) {
                const double angle = 2 * PI * j / steps;
                around += energy_light_at(psf, centre[0] + r * cos(angle),
                                          centre[1] + r * sin(angle), taps);
            }
            sum += width * lagrange_weights[i] * r * (2 * PI / steps) * around;
        }
    }
    return sum;
}

/* What each pixel of a row counts in an integral from low to high. */
static double *energy_row_weights(double low, double high, size_t size, size_t taps,
                                  struct arena *arena)
{
    double *weights = ARENA_ARRAY(arena, size, double), factors[TAPS];
    for (double cell = floor(low); cell < high; cell++) {
        const double from = fmax(cell, low), width = fmin(cell + 1, high) - from;
        for (int i = 0; i < LAGRANGE_NODES; i++) {
            const size_t first =
                lagrange_factors(from + lagrange_nodes[i] * width, size, taps, factors);
            for (size_t k = 0; k < taps; k++) {
                weights[first + k] += lagrange_weights[i] * width * factors[k];
            }
        }
    }
    return weights;
}

/* Within a square, alike. */
static double energy_of_square(const struct psf *psf, const double centre[2], double half,
                               size_t taps, struct arena *arena)
{
    const struct arena_mark mark = arena_mark(arena);
    const double *across =
        energy_row_weights(centre[0] - half, centre[0] + half, psf->size, taps, arena);
    const double *up =
        energy_row_weights(centre[1] - half, centre[1] + half, psf->size, taps, arena);
    double sum = 0;
    for (size_t y = 0; y < psf->size; y++) {
        double of_row = 0;
        for (size_t x = 0; x < psf->size && !(up[y] == 0); x++) {
            of_row += across[x] * psf->values[y * psf->size + x];
        }
        sum += up[y] * of_row;
    }
    arena_reset(arena, mark);
    return sum;
}

/* -------- shares -------- */

/* All light, in values of pixels. */
static double energy_of_all(const struct psf *psf)
{
    double sum = 0;
    for (size_t i = 0; i < psf->size * psf->size; i++) {
        sum += psf->values[i];
    }
    return sum / psf->inside;
}

/* How many circles of these radii are within an image, and the shares that they enclose. */
static size_t energy_circles(const struct psf *psf, const double off[2], const double *radii,
                             size_t count, size_t taps, double *shares)
{
    const double half = (double)(psf->size / 2), side = (double)(psf->size - 1);
    const double centre[2] = {half + off[0] / psf->pitch, half + off[1] / psf->pitch};
    const double room = fmin(fmin(centre[0], side - centre[0]), fmin(centre[1], side - centre[1]));
    const double all = energy_of_all(psf);
    double sum = 0, before = 0;
    for (size_t i = 0; i < count; i++) {
        const double ends[2] = {before, radii[i] / psf->pitch};
        if (!(ends[1] <= room)) {
            return i;
        }
        sum += energy_of_ring(psf, centre, ends, taps);
        before = ends[1];
        shares[i] = sum / all;
    }
    return count;
}

void psf_energy_find(const struct psf_energy_image *image, const double *radii, size_t count,
                     struct psf_energy *shares, struct arena *arena)
{
    enum { WHOLE, ROUGH, BEFORE, BEHIND, PERFECT, KINDS };
    static const size_t taps[KINDS] = {TAPS, FEW_TAPS, FEW_TAPS, FEW_TAPS, TAPS};
    const struct psf *psf = &image->psf;
    const double all = energy_of_all(psf), half = (double)(psf->size / 2);
    const double *about = image->centre, *off = image->off;
    const bool is_moved = count > 0 && hypot(off[0], off[1]) > least * psf->pitch;
    const double centres[KINDS][2] = {[WHOLE] = {about[0], about[1]},
                                      [ROUGH] = {about[0], about[1]},
                                      [BEFORE] = {about[0] - off[0], about[1] - off[1]},
                                      [BEHIND] = {about[0] + off[0], about[1] + off[1]}};
    const double middle[2] = {half + about[0] / psf->pitch, half + about[1] / psf->pitch};
    double *circles[KINDS];
    size_t within[KINDS];
    for (size_t k = 0; k < KINDS; k++) {
        const struct psf *of = k == PERFECT ? &image->perfect : psf;
        const bool is_wanted = of->values != NULL && (is_moved || k < BEFORE || k > BEHIND);
        circles[k] = ARENA_ARRAY(arena, count + 1, double);
        within[k] =
            is_wanted ? energy_circles(of, centres[k], radii, count, taps[k], circles[k]) : 0;
    }
    for (size_t i = 0; i < count; i++) {
        struct psf_energy *share = &shares[i];
        const double radius = radii[i] / psf->pitch;
        *share = (struct psf_energy){NAN, NAN, NAN, NAN};
        share->limit = i < within[PERFECT] ? circles[PERFECT][i] : (double)NAN;
        if (i >= within[WHOLE]) {
            continue;
        }
        share->encircled = circles[WHOLE][i];
        share->ensquared = energy_of_square(psf, middle, radius, TAPS, arena) / all;
        const double rough = energy_of_square(psf, middle, radius, FEW_TAPS, arena) / all;
        double moved = 0;
        for (size_t k = BEFORE; k <= BEHIND; k++) {
            moved = i < within[k] ? fmax(moved, fabs(circles[k][i] - circles[ROUGH][i])) : moved;
        }
        share->error =
            least + moved +
            fmax(fabs(circles[ROUGH][i] - share->encircled), fabs(rough - share->ensquared));
    }
}
