/* exchange/codev/codev_mode.c - whether the numbers of a CODE V file's surfaces are curvatures. */
/* SPDX-License-Identifier: MIT */
#include "exchange/codev/codev.h"
#include "file/lens_solve.h"
#include "file/lens_words.h"

#include <math.h>

/* What speaks against one reading of the numbers; above a weight of 1 there is no such lens. */
struct codev_mode_doubt {
    double most;      /* of all weights */
    double weight;    /* of the first above 1, else of the most */
    const char *what; /* of that one: the words for `length` */
    double length;    /* mm */
    size_t surface;   /* of the file */
};

/* How far from the axis a ray meets each surface, mm; 0 where it is not known. */
static const double *ray_heights(const struct lens *lens, enum solve_ray ray, struct arena *arena)
{
    double *heights = ARENA_ARRAY(arena, lens->surface_count, double);
    struct error ignored;
    bool is_known =
        lens->aperture_kind != APERTURE_NONE && solve_heights(lens, ray, arena, heights, &ignored);
    for (size_t i = 0; i < lens->surface_count; i++) {
        heights[i] = is_known && isfinite(heights[i]) ? fabs(heights[i]) : 0;
    }
    return heights;
}

/*
 * Nothing meets a sphere farther off than its radius: no beam, no clear aperture. With an f-number
 * the beams shrink with the focal length, and only the distances stay: they are at most 10 radii in
 * glass, 100 behind a mirror, 1000 in air.
 */
static void doubt_surface(const struct lens *lens, size_t at, size_t number, double marginal,
                          double chief, struct codev_mode_doubt *worst)
{
    const struct surface *surface = &lens->surfaces[at];
    double c = fabs(surface_curvature(surface, SECTION_Y).hi);
    /* How many radii long a distance may well be: more of them in air, and from a mirror. */
    double radii_of_gap = medium_is_air(&surface->medium) ? 1000 : 10;
    if (surface_reflects(surface)) {
        radii_of_gap = 100;
    }
    bool behind_glass = at > 0 && !medium_is_air(&surface[-1].medium);
    const struct {
        const char *what;
        double length, radii;
    } all[] = {
        {"a beam of", 2 * marginal, 2},
        {"a field of", 2 * chief, 2},
        {"a clear aperture of", surface->has_diameter ? surface->diameter.value.hi : 0, 2},
        {"a glass of", behind_glass ? fabs(surface[-1].thickness.value.hi) : 0, 10},
        {"a distance of", fabs(surface->thickness.value.hi), radii_of_gap},
    };
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++) {
        double weight = all[i].length * c / all[i].radii;
        worst->most = fmax(worst->most, weight);
        if (weight > worst->weight && !(worst->weight > 1)) {
            *worst =
                (struct codev_mode_doubt){worst->most, weight, all[i].what, all[i].length, number};
        }
    }
}

/* Is the number of a surface one that RDM would decide about? */
static bool is_number_open(const struct sequence_surface *surface)
{
    return !surface->is_radius && surface->curve.value.hi != 0 && !surface->curvature_solve.is_set;
}

static struct codev_mode_doubt codev_mode_doubt_of(const struct sequence *sequence,
                                                   const struct lens *lens)
{
    struct arena *arena = sequence->job->arena;
    const double *marginal = ray_heights(lens, SOLVE_MARGINAL, arena);
    const double *chief = ray_heights(lens, SOLVE_CHIEF, arena);
    struct codev_mode_doubt worst = {0};
    for (size_t i = 1; i + 1 < sequence->count; i++) {
        const size_t at = sequence->surfaces[i].place;
        if (is_number_open(&sequence->surfaces[i])) {
            doubt_surface(lens, at, i, marginal[at], chief[at], &worst);
        }
    }
    return worst;
}

/* The same lens with the numbers as radii. */
static struct lens lens_of_radii(const struct sequence *sequence, const struct lens *lens)
{
    struct lens other = *lens;
    struct pair units = lens_words_per_length(pair_of(1), sequence->commands->scale, 2);
    other.surfaces = ARENA_COPY(sequence->job->arena, lens->surfaces, lens->surface_count, 0);
    for (size_t i = 1; i + 1 < sequence->count; i++) {
        struct surface *surface = &other.surfaces[sequence->surfaces[i].place];
        if (is_number_open(&sequence->surfaces[i])) {
            surface->is_plane = surface->has_curvature = false;
            surface->radius = sequence->surfaces[i].curve;
            surface->radius.value = pair_divide(surface->radius.value, units);
        }
    }
    return other;
}

bool codev_check_mode(struct codev *codev)
{
    const struct sequence *sequence = &codev->sequence;
    if (codev->mode_is_given) {
        return true;
    }
    const struct lens *lens = lens_at_position(codev->build.lens, 0, codev->job->arena);
    const struct lens other = lens_of_radii(sequence, lens);
    const struct codev_mode_doubt as_read = codev_mode_doubt_of(sequence, lens),
                                  as_radius = codev_mode_doubt_of(sequence, &other);
    if (!(as_read.most > as_radius.most)) {
        return true;
    }
    const struct sequence_surface *surface = &sequence->surfaces[as_read.surface];
    double c = surface->curve.value.hi;
    commands_fail(&codev->commands, &surface->at,
                  "without RDM the number of a surface is its curvature, but %s %.6g mm fits a "
                  "radius of %.6g mm better than one of %.3g mm",
                  as_read.what, as_read.length,
                  fabs(c) / lens_words_per_length(pair_of(1), sequence->commands->scale, 2).hi,
                  1 / fabs(c));
    return error_hint(codev->commands.error,
                      "put a line before the surfaces: RDM if they are radii, RDM N if they "
                      "are curvatures");
}
