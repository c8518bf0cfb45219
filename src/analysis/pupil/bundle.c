/* analysis/pupil/bundle.c - the rays of one field at one wavelength, and what each of them counts. */
/* SPDX-License-Identifier: MIT */
#include "analysis/pupil/bundle.h"

#include "analysis/pupil/quadrature.h"
#include "trace/dispatch.h"
#include "trace/pupil/pupil_inside.h"

#include <math.h>

/* A ray aimed at the very edge of the stop passes it, whichever way its last bit falls. */
static const double within = 1 - 1e-12;

/* The lens as it clips, if it is to, or as it does not. */
static const struct system *system_of(const struct bundle_question *question, bool clip,
                                      struct error *error)
{
    unsigned which = SETUP_IMAGE | (clip ? (unsigned)SETUP_CLIPPED : 0);
    return setup_system(question->setup, question->wavelength, which, error);
}

bool bundle_prepare(const struct bundle_question *question, struct error *error)
{
    return system_of(question, question->clip, error) != NULL &&
           system_of(question, false, error) != NULL;
}

/* The ray through the centre of the stop. */
static bool open_chief(struct bundle_source *source, struct arena *arena, struct error *error)
{
    source->has_chief = aim_open_near(source->open, &source->beam, source->question->near, arena,
                                      &source->aim, error);
    if (source->has_chief) {
        source->chief = aim_chief(&source->aim);
    }
    return source->has_chief;
}

static bool open_stop(struct bundle_source *source, struct arena *arena, struct error *error)
{
    if (open_chief(source, arena, error)) {
        source->pupil = stop_beam_of_stop(&source->aim, source->system, source->question->weight);
        return true;
    }
    /* other patterns have no centre to be counted from */
    if (source->question->pattern != PATTERN_GAUSS || !(source->open->stop_radius > 0)) {
        return false;
    }
    /* Without a chief ray others may pass: those about where the paraxial pupil is seen. */
    const struct bundle_question *question = source->question;
    const struct clear_guess guess =
        clear_guess_of(source->system, &source->beam, &question->setup->first);
    source->pupil = (struct stop_beam){
        .system = source->system,
        .beam = &source->beam,
        .origin = {guess.centre[0], guess.centre[1]},
        .axes = {guess.radius, 0, 0, guess.radius},
        .radius = fabs(source->open->stop_radius),
        .weight = question->weight,
    };
    error->code = ERROR_NONE;
    return true;
}

/* What is near the chief ray is so of the real one, whatever the rays are aimed at. */
static bool open_entrance(struct bundle_source *source, bool has_stop, struct arena *arena,
                          struct error *error)
{
    const struct first_order *first = &source->question->setup->first;
    struct error ignored;
    if (!stop_beam_of_entrance(source->system, &source->beam, first, source->question->weight,
                               &source->pupil, error)) {
        return false;
    }
    if (!has_stop || !open_chief(source, arena, &ignored)) {
        source->has_chief = aim_at_entrance(&source->beam, first, 0, 0, &source->chief, error);
        return source->has_chief;
    }
    return true;
}

/* A lens without a stop: its aperture is a disc in the plane of the first vertex. */
static bool bundle_open_disc(struct bundle_source *source, struct error *error)
{
    double radius = source->question->setup->first.entrance_diameter / 2, place[2];
    if (!(radius > 0 && isfinite(radius))) {
        fail(
            error, ERROR_DOMAIN,
            "the lens has neither a stop with a diameter nor an aperture: the size of its pupil is "
            "not known");
        return error_hint(error, "give an f-number, or a diameter in the file");
    }
    source->pupil = (struct stop_beam){.system = source->system,
                                       .beam = &source->beam,
                                       .radius = NAN,
                                       .weight = source->question->weight,
                                       .has_disc = true,
                                       .extent = radius};
    stop_beam_place(&source->pupil, 0, 0, place);
    source->chief = beam_ray(&source->beam, place[0], place[1]);
    source->has_chief = true;
    return true;
}

bool bundle_open(const struct bundle_question *question, struct arena *arena,
                 struct bundle_source *source, struct error *error)
{
    const struct setup *setup = question->setup;
    *source = (struct bundle_source){.question = question};
    source->system = system_of(question, question->clip, error);
    source->through = source->system;
    source->open = source->system != NULL ? system_of(question, false, error) : NULL;
    if (source->open == NULL || !setup_beam(setup, question->field, &source->beam, error)) {
        return false;
    }
    bool has_stop = source->open->stop != LENS_NONE && source->open->stop_radius > 0;
    /* a telecentric object space has its pupil where it says, not where the stop is seen */
    bool opened;
    if (question->from_entrance || setup->first.is_telecentric) {
        opened = open_entrance(source, has_stop, arena, error);
    } else if (has_stop) {
        opened = open_stop(source, arena, error);
    } else {
        opened = bundle_open_disc(source, error);
    }
    if (opened && question->pattern == PATTERN_GAUSS) {
        source->region = ARENA_NEW(arena, struct quadrature_region);
        *source->region = quadrature_open(&source->pupil, arena);
    }
    return opened;
}

bool bundle_open_beside(const struct bundle_question *question, const struct bundle_source *before,
                        struct arena *arena, struct bundle_source *source, struct error *error)
{
    if (!bundle_open(question, arena, source, error)) {
        return false;
    }
    if (before != NULL && source->region != NULL) {
        source->region->near = before->region->boundary;
    }
    return true;
}

/* -------- filling the pupil -------- */

void bundle_aim(const struct bundle_source *source, const struct pupil_point *points, size_t count,
                const struct rays *rays)
{
    if (!source->pupil.has_disc && !isnan(source->pupil.radius)) {
        aim_rays(&source->aim, points, count, rays);
        return;
    }
    for (size_t i = 0; i < count; i++) {
        double at[2];
        stop_beam_place(&source->pupil, points[i].x, points[i].y, at);
        const struct ray ray = beam_ray(&source->beam, at[0], at[1]);
        rays_set(rays, i, source->system->index_first, &ray);
    }
}

bool bundle_fail_dark(const struct bundle_source *source, size_t count, struct arena *arena,
                      struct error *error)
{
    const struct rays one = rays_new(arena, 1);
    struct ray ray = source->has_chief ? source->chief
                                       : beam_ray(&source->beam, source->pupil.origin[0],
                                                  source->pupil.origin[1]);
    rays_set(&one, 0, source->system->index_first, &ray);
    rays_trace(source->system, &one, NULL);
    ray = rays_get(&one, 0, source->system->index_last);
    if (count > 0) {
        return fail(error, ERROR_DOMAIN, "none of %zu rays arrives", count);
    }
    if (ray.status == RAY_OK) {
        return fail(error, ERROR_DOMAIN, "no ray arrives");
    }
    return fail(error, ERROR_DOMAIN,
                "no ray arrives: at the middle of the pupil it ends at surface %zu (%s)",
                ray.surface, ray_status_name(ray.status));
}

bool bundle_fill(const struct bundle_source *source, size_t rays, struct arena *arena,
                 struct bundle *bundle, struct error *error)
{
    const struct bundle_question *question = source->question;
    *bundle = (struct bundle){.count = 0};
    if (question->pattern == PATTERN_GAUSS) {
        const struct quadrature all = quadrature_fill(source->region, rays, arena);
        bundle->points = all.sample.points;
        bundle->count = all.is_empty ? 0 : all.sample.count;
        bundle->rays = all.rays;
        bundle->arms = all.arms;
        bundle->rings = all.rings;
        bundle->arcs = all.arcs;
    } else { /* points of the whole pupil, whether rays arrive or not */
        struct sample sample;
        if (!sample_make(question->pattern, rays, question->seed, arena, &sample, error)) {
            return false;
        }
        for (size_t i = 0; i < sample.count && question->clip; i++) {
            sample.points[i].x *= within;
            sample.points[i].y *= within;
        }
        bundle->points = sample.points;
        bundle->count = sample.count;
        bundle->rays = rays_new(arena, sample.count);
        bundle_aim(source, sample.points, sample.count, &bundle->rays);
        if (question->weight == WEIGHT_BEAM) {
            quadrature_weigh_beam(&source->pupil, &bundle->rays, sample.points, arena);
        }
    }
    return true;
}

bool bundle_trace(const struct bundle_source *source, size_t rays, size_t to, struct arena *arena,
                  struct bundle *bundle, struct error *error)
{
    if (!bundle_fill(source, rays, arena, bundle, error)) {
        return false;
    }
    rays_trace_part(source->through, 0, to, &bundle->rays, NULL);
    for (size_t i = 0; i < bundle->count; i++) {
        const struct ray_block *block = &bundle->rays.blocks[i / RAYS_BLOCK];
        bool arrives = ray_block_status(block, i % RAYS_BLOCK) == RAY_OK;
        bundle->lost += !arrives;
        bundle->clear += arrives ? bundle->points[i].weight : 0;
    }
    return bundle->clear > 0 || bundle_fail_dark(source, bundle->count, arena, error);
}

struct ray bundle_chief(const struct bundle_source *source, size_t to, struct arena *arena)
{
    const struct rays one = rays_new(arena, 1);
    rays_set(&one, 0, source->open->index_first, &source->chief);
    rays_trace_part(source->open, 0, to, &one, NULL);
    return rays_get(&one, 0,
                    to == 0 ? source->open->index_first : system_index_after(source->open, to - 1));
}

struct pupil_islands bundle_islands(const struct bundle_source *source, struct arena *arena)
{
    if (!source->question->clip) {
        return (struct pupil_islands){0};
    }
    if (source->region != NULL) {
        return quadrature_islands(source->region, arena);
    }
    struct quadrature_region region = quadrature_open(&source->pupil, arena);
    return quadrature_islands(&region, arena);
}
