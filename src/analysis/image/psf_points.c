/* analysis/image/psf_points.c - points of an exit pupil that waves are added up from. */
/* SPDX-License-Identifier: MIT */
#include "analysis/image/psf_points.h"

#include "analysis/waves/exit_lines.h"
#include "base/constants.h"
#include "trace/aim/sample.h"

#include <math.h>

enum {
    LEAST = 14, /* points along a line, and lines */
    MORE = 128, /* that a rule has more points than are wanted, at most */
    TURNS_MOST = PSF_TURNS_MOST,
    SIZE_LEAST = 8 /* of an image that says something */
};

/* More for each turn of the phase: along a line, and lines. */
static const double along_turn = 1.75, across_turn = 3.3;

/* Points at work. */
struct point_placer {
    const struct psf_plane *plane;
    struct psf_points *points;
    double *weights, turns[2];
    struct gauss_rules *rules;
};

/* Turns of the phase across the pupil in one direction, at a distance from the reference, mm. */
static double turns_across(const struct psf_plane *plane, int k, double far)
{
    return 2 * plane->pupil->half[k] * (far + plane->spread) * plane->pupil->n *
           plane->pupil->waves;
}

static double turns_at(const struct psf_plane *plane, double far)
{
    return fmax(turns_across(plane, 0, far), turns_across(plane, 1, far));
}

static double psf_points_farthest(const struct psf_plane *plane)
{
    return 0.5 * (double)plane->size * plane->pitch;
}

double psf_points_turns(const struct psf_plane *plane)
{
    return turns_at(plane, psf_points_farthest(plane));
}

bool psf_points_fit(const struct psf_plane *plane, struct error *error)
{
    const double turns = psf_points_turns(plane), own = turns_at(plane, 0);
    const double share = (TURNS_MOST - own) / (turns - own); /* of the image */
    const double size = ceil(share * (double)plane->size) - 1;
    if (turns < TURNS_MOST) {
        return true;
    }
    if (!(own < TURNS_MOST)) {
        return fail(error, ERROR_DOMAIN,
                    "the wave front is too steep for waves to be added up: its phase turns %.0f "
                    "times across the pupil, and sums take %d: a smaller aperture, or rays (spot)",
                    own, TURNS_MOST);
    }
    return size >= SIZE_LEAST
               ? fail(error, ERROR_DOMAIN,
                      "the phase turns %.0f times across the pupil at the edge of the image, and "
                      "sums take %d: at most {size} %.0f with {pitch} %.4g %s",
                      turns, TURNS_MOST, size, 1000 * plane->pitch, plane->unit)
               : fail(error, ERROR_DOMAIN,
                      "the phase turns %.0f times across the pupil at the edge of the image, and "
                      "sums take %d: at most {pitch} %.4g %s with {size} %zu",
                      turns, TURNS_MOST, 0.999 * share * 1000 * plane->pitch, plane->unit,
                      plane->size);
}

static size_t points_along(const struct point_placer *putting, double length)
{
    const double share = length / (2 * putting->plane->pupil->half[0]);
    return LEAST + (size_t)(along_turn * putting->turns[0] * fmin(share, 1));
}

static size_t lines_across(const struct point_placer *putting, const struct exit_piece *piece)
{
    const double share = (piece->high - piece->low) / (2 * putting->plane->pupil->half[1]);
    return LEAST + (size_t)(across_turn * putting->turns[1] * fmin(share, 1));
}

bool psf_points_put(const struct psf_plane *plane, struct psf_points *points, struct error *error)
{
    static const double across_x[2] = {1, 0};
    struct arena *arena = plane->arena;
    struct exit_lines *lines = ARENA_NEW(arena, struct exit_lines);
    struct point_placer putting = {.plane = plane,
                                   .points = points,
                                   .turns = {turns_across(plane, 0, psf_points_farthest(plane)),
                                             turns_across(plane, 1, psf_points_farthest(plane))},
                                   .rules = gauss_rules_new(arena)};
    if (!psf_points_fit(plane, error)) {
        return false;
    }
    exit_lines_find(plane->pupil, across_x, arena, lines);
    const size_t along = points_along(&putting, INFINITY) + EXIT_SPANS * (LEAST + MORE);
    size_t line_room = 0;
    for (size_t p = 0; p < lines->count; p++) {
        line_room += lines_across(&putting, &lines->pieces[p]) + MORE;
    }
    *putting.points =
        (struct psf_points){.at = arena_array(arena, line_room * along, sizeof(double[2])),
                            .ends = ARENA_ARRAY(arena, line_room, size_t)};
    putting.weights = ARENA_ARRAY(arena, line_room * along, double);
    for (size_t p = 0; p < lines->count; p++) {
        const struct exit_piece *piece = &lines->pieces[p];
        const struct gauss_panels rows =
            gauss_panels_of(putting.rules, (double)lines_across(&putting, piece));
        for (size_t i = 0; i < rows.each * rows.panels; i++) {
            /* The points of one line. */
            struct exit_spans spans;
            double slope;
            const double t =
                exit_piece_at(piece, PI * (gauss_panels_at(&rows, i) - 0.5), &slope, &spans);
            for (size_t j = 0; j < spans.count; j++) {
                const double low = spans.edges[2 * j], length = spans.edges[2 * j + 1] - low;
                if (!(length > 0)) {
                    continue;
                }
                const struct gauss_panels rule =
                    gauss_panels_of(putting.rules, (double)points_along(&putting, length));
                for (size_t k = 0; k < rule.each * rule.panels; k++, points->count++) {
                    points->at[points->count][0] = low + length * gauss_panels_at(&rule, k);
                    points->at[points->count][1] = t;
                    putting.weights[points->count] = (PI * gauss_panels_weight(&rows, i)) * slope *
                                                     length * gauss_panels_weight(&rule, k);
                }
            }
            points->ends[points->lines++] = points->count;
        }
    }
    points->waves = ARENA_ARRAY(arena, points->count, double);
    points->amplitudes = ARENA_ARRAY(arena, points->count, double);
    exit_pupil_values(plane->pupil, (const double(*)[2])points->at, points->count, points->waves,
                      points->amplitudes);
    for (size_t i = 0; i < points->count; i++) {
        points->amplitudes[i] *= putting.weights[i];
        points->total += points->amplitudes[i];
    }
    return true;
}
