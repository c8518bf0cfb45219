/* analysis/image/line_spread.c - line spread and edge spread functions of a field. */
/* SPDX-License-Identifier: MIT */
#include "analysis/image/line_spread.h"

#include "analysis/image/psf_light.h"
#include "base/constants.h"
#include "base/lagrange.h"

#include <math.h>

enum { TAPS = LAGRANGE_MOST, LINES_MOST = 1 << 15 };

/* Steps in resolved lengths. */
static const double fine = 0.125;

/* What sums over the pupil leave of an edge. */
static const double least = 1e-5;

/* The light of one wavelength in one direction: added to `line`, times `weight`. */
static void line_spread_add(const struct psf_plane *plane, const struct psf_points *points,
                            double weight, const struct line_spread_image *image, double *line)
{
    const double wave = plane->pupil->n * plane->pupil->waves * image->step;
    const double across_place[2] = {wave * plane->along[0], wave * plane->along[1]};
    const struct nufft nufft = nufft_open(image->count, plane->arena);
    struct psf_cells cells = psf_cells_new(&nufft, plane->arena);
    for (size_t first = 0, count; first < points->lines; first += count) {
        count = psf_lines_transform(&nufft, points, across_place, first, &cells);
        for (size_t l = 0; l < count; l++) {
            const double share = weight / points->widths[first + l];
            const double *re = cells.re + l * nufft.fft.length;
            const double *im = cells.im + l * nufft.fft.length;
            for (size_t x = 0; x < image->count; x++) {
                const size_t cell = nufft_cell(&nufft, x);
                line[x] += share * (re[cell] * re[cell] + im[cell] * im[cell]) /
                           (nufft.left[x] * nufft.left[x]);
            }
        }
    }
}

/* The edge of a line, and its error. */
static void line_spread_integrate(struct line_spread_image *image, size_t k)
{
    const double *line = image->line[k];
    double *edge = image->edge[k];
    const size_t count = image->count, tenth = count / 20;
    double tails[2] = {0, 0};
    edge[0] = 0;
    for (size_t i = 0; i + 1 < count; i++) {
        edge[i + 1] =
            edge[i] + image->step * lagrange_integral(line, count, (double)i, (double)i + 1, TAPS);
    }
    /* beyond x a tail of c/x^2 has x times the light there */
    for (size_t i = 0; i < tenth; i++) {
        const double far = (double)(count / 2) * image->step / (double)tenth;
        tails[0] += far * line[i];
        tails[1] += far * line[count - 1 - i];
    }
    const double left = 1 - edge[count - 1], before = left * tails[0] / (tails[0] + tails[1]);
    for (size_t i = 0; i < count; i++) {
        edge[i] += before;
    }
    image->error[k] = least + fabs(before - left / 2);
}

bool line_spread_open(const struct line_spread_question *question, struct arena *arena,
                      struct line_spread_image *image, struct error *error)
{
    struct exit_pupils *pupils = ARENA_NEW(arena, struct exit_pupils);
    struct psf look;
    double along[2], light = 0;
    if (!psf_look(&question->bundle, arena, &look, error) ||
        !exit_pupils_open(&question->bundle, arena, pupils, error)) {
        return false;
    }
    if (look.is_angular) {
        return fail(error, ERROR_DOMAIN,
                    "the image lies infinitely far away: its lines have no width in mm");
    }
    const double usual = look.spread + 4 * look.finest;
    const double reach = fmax(1.5 * usual, isnan(question->farthest) ? 0 : question->farthest);
    const double half = ceil(reach / (fine * look.finest)) + TAPS;
    if (half > LINES_MOST) {
        return fail(error, ERROR_DOMAIN,
                    "{offset} %.4g um is too far from the chief ray for lines %.4g um fine",
                    1000 * question->farthest, 1000 * look.finest);
    }
    *image = (struct line_spread_image){.step = fine * look.finest,
                                        .count = 2 * (size_t)half + 1,
                                        .usual = usual,
                                        .islands = pupils->islands};
    wave_section(question->bundle.field, along);
    for (size_t k = 0; k < MTF_DIRECTIONS; k++) {
        image->line[k] = ARENA_ARRAY(arena, image->count, double);
        image->edge[k] = ARENA_ARRAY(arena, image->count, double);
    }
    for (size_t g = 0; g < pupils->lights.count; g++) {
        const struct exit_pupil *pupil = &pupils->list[g];
        const double weight = exit_pupil_weight(pupil), waves = pupil->n * pupil->waves;
        const struct arena_mark mark = arena_mark(arena);
        for (size_t k = 0; k < MTF_DIRECTIONS && pupils->lights.list[g].weight > 0; k++) {
            const struct psf_plane plane = {.pupil = pupil,
                                            .size = image->count,
                                            .pitch = image->step,
                                            .spread = look.spread,
                                            .unit = "um",
                                            .along = {k == MTF_TANGENTIAL ? along[0] : along[1],
                                                      k == MTF_TANGENTIAL ? along[1] : -along[0]},
                                            .arena = arena};
            struct psf_points points;
            if (!psf_points_put(&plane, &points, error)) {
                return false;
            }
            line_spread_add(&plane, &points, weight * waves, image, image->line[k]);
        }
        light += pupils->lights.list[g].weight > 0 ? weight * pupil->energy : 0;
        arena_reset(arena, mark);
    }
    for (size_t k = 0; k < MTF_DIRECTIONS; k++) {
        for (size_t i = 0; i < image->count; i++) {
            image->line[k][i] /= light;
        }
        line_spread_integrate(image, k);
    }
    return true;
}

struct line_spread line_spread_at(const struct line_spread_image *image, double place)
{
    const double at = place / image->step + (double)(image->count / 2);
    const bool is_within = at >= 0 && at <= (double)(image->count - 1);
    struct line_spread spread = {{NAN, NAN}, {NAN, NAN}};
    for (size_t k = 0; k < MTF_DIRECTIONS && is_within; k++) {
        spread.line[k] = lagrange_value(image->line[k], image->count, at, TAPS);
        spread.edge[k] = lagrange_value(image->edge[k], image->count, at, TAPS);
    }
    return spread;
}

/* -------- widths -------- */

/* Where values cross a level between two neighbours, in steps. */
static double line_spread_crossing(const double *values, size_t count, size_t before, double level)
{
    enum { HALVINGS = 40 };
    double low = (double)before, high = low + 1;
    const bool rises = values[before] < level;
    for (int i = 0; i < HALVINGS; i++) {
        const double middle = (low + high) / 2;
        const bool is_below = lagrange_value(values, count, middle, TAPS) < level;
        low = is_below == rises ? middle : low;
        high = is_below == rises ? high : middle;
    }
    return (low + high) / 2;
}

/* The first place where an edge passes a level, in steps; NaN: none. */
static double line_spread_passing(const double *edge, size_t count, double level)
{
    for (size_t i = 0; i + 1 < count; i++) {
        if (edge[i] < level && edge[i + 1] >= level) {
            return line_spread_crossing(edge, count, i, level);
        }
    }
    return NAN;
}

struct line_spread_widths line_spread_widths_find(const struct line_spread_image *image)
{
    struct line_spread_widths widths;
    const size_t count = image->count;
    for (size_t k = 0; k < MTF_DIRECTIONS; k++) {
        const double *line = image->line[k];
        size_t top = 0, low, high;
        for (size_t i = 0; i < count; i++) {
            top = line[i] > line[top] ? i : top;
        }
        /* the highest of a parabola through three */
        const bool is_inside = top > 0 && top + 1 < count;
        const double slope = is_inside ? (line[top + 1] - line[top - 1]) / 2 : 0;
        const double bend = is_inside ? line[top - 1] - 2 * line[top] + line[top + 1] : -1;
        const double level = (line[top] - (bend < 0 ? slope * slope / bend / 2 : 0)) / 2;
        for (low = top; low > 0 && line[low] > level;) {
            low--;
        }
        for (high = top; high + 1 < count && line[high] > level;) {
            high++;
        }
        const bool is_found = line[low] <= level && line[high] <= level;
        widths.line[k] = is_found
                             ? image->step * (line_spread_crossing(line, count, high - 1, level) -
                                              line_spread_crossing(line, count, low, level))
                             : (double)NAN;
        widths.edge[k] = image->step * (line_spread_passing(image->edge[k], count, 0.9) -
                                        line_spread_passing(image->edge[k], count, 0.1));
    }
    return widths;
}
