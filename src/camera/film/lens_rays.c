/* camera/film/lens_rays.c - blocks of samples, each traced from the film to the scene. */
/* SPDX-License-Identifier: MIT */
#include "camera/film/lens_rays.h"

#include <math.h>

/* All that blocks have in common. */
struct lens_rays_stream {
    const struct lens_rays_question *question;
    struct lens_film film;
    struct film_plan plan; /* of the part of the film that may be lit */
    struct film_samples samples;
    struct sobol sobol_time; /* of one more dimension than the film has */
    double times[RAYS_BLOCK];
    struct rays rays;
    struct lens_ray passed[RAYS_BLOCK];
};

static bool open_stream(const struct lens_rays_question *question, struct arena *arena,
                        struct lens_rays_stream *stream, struct error *error)
{
    stream->question = question;
    if (!lens_film_open(&question->film, arena, &stream->film, error)) {
        return false;
    }
    const double largest = stream->film.region.largest;
    const double width = fmin(question->film.width, 2 * largest);
    const double height = fmin(question->film.height, 2 * largest);
    stream->plan = (struct film_plan){.sobol = stream->film.sobol,
                                      .left = -width / 2,
                                      .bottom = -height / 2,
                                      .width = width,
                                      .height = height};
    stream->rays = rays_new(arena, RAYS_BLOCK);
    sobol_open(FILM_DIMENSIONS, &stream->sobol_time);
    return true;
}

/* When, within what the shutter leaves of the exposure to each. */
static void lens_rays_time_rays(struct lens_rays_stream *stream)
{
    const struct shutter *shutter = stream->film.shutter;
    const double *begin = stream->samples.begin, *end = stream->samples.end;
    for (size_t i = 0; shutter != NULL && i < RAYS_BLOCK; i++) {
        const double time = begin[i] + stream->times[i] * (end[i] - begin[i]);
        stream->times[i] = time / shutter->time + 0.5;
    }
}

/* The first `count` rays of a block that pass; each weight is multiplied. */
static size_t lens_rays_collect(struct lens_rays_stream *stream, const struct system *system,
                                size_t count, double by)
{
    size_t kept = 0;
    for (size_t i = 0; i < count; i++) {
        const struct ray ray = rays_get(&stream->rays, i, system->index_last);
        const double weight = stream->samples.weight[i] * by;
        if (ray.status == RAY_OK && weight > 0) {
            struct lens_ray *passed = &stream->passed[kept++];
            *passed = (struct lens_ray){.film = {stream->samples.x[i], stream->samples.y[i]},
                                        .wavelength = system->wavelength,
                                        .time = stream->times[i],
                                        .weight = weight};
            for (int k = 0; k < 3; k++) {
                passed->point[k] = ray.point[k];
                passed->cosine[k] = ray.cosine[k];
            }
        }
    }
    return kept;
}

/* All rays of a wavelength, which stand for a share of the light. */
static bool send(struct lens_rays_stream *stream, size_t w, uint64_t samples, double share,
                 lens_rays_visit *visit, void *context, uint64_t *arrived, struct error *error)
{
    const struct system *system = stream->film.systems[w];
    const struct lens_rays_question *question = stream->question;
    const double n = stream->film.region.index / system->index_last;
    const double lit =
        stream->plan.width * stream->plan.height / (question->film.width * question->film.height);
    const double by = share * lit * n * n;
    const uint32_t when = sobol_scrambling(question->seed, w, FILM_DIMENSIONS);
    for (uint32_t k = 0; k < FILM_DIMENSIONS; k++) {
        stream->plan.scrambling[k] = sobol_scrambling(question->seed, w, k);
    }
    for (uint64_t done = 0; done < samples; done += RAYS_BLOCK) {
        const uint64_t left = samples - done;
        const uint32_t block = (uint32_t)(done / RAYS_BLOCK);
        film_rays_plan(&stream->plan, NULL, block, SET_BEST, &stream->samples);
        sobol_points(&stream->sobol_time, when, block, stream->times);
        lens_film_start(&stream->film, &stream->samples, stream->rays.blocks);
        lens_film_trace(&stream->film, w, &stream->samples, &stream->rays);
        lens_rays_time_rays(stream);
        const size_t kept = lens_rays_collect(
            stream, system, left < RAYS_BLOCK ? (size_t)left : RAYS_BLOCK, by / (double)samples);
        *arrived += kept;
        if (kept > 0 && !visit(context, stream->passed, kept, error)) {
            return false;
        }
    }
    return true;
}

bool lens_rays_make(const struct lens_rays_question *question, struct arena *arena,
                    lens_rays_visit *visit, void *context, struct lens_rays *result,
                    struct error *error)
{
    const struct setup *setup = question->film.setup;
    struct lens_rays_stream *stream = ARENA_NEW(arena, struct lens_rays_stream);
    if (!open_stream(question, arena, stream, error)) {
        return false;
    }
    const struct lens_film *film = &stream->film;
    *result = (struct lens_rays){.largest = film->lit,
                                 .corner = film->corner,
                                 .lit_at = {film->region.pole[0], film->region.pole[1]}};
    double all = 0, before = 0;
    for (size_t w = 0; w < setup->wavelength_count; w++) {
        all += setup->wavelengths[w].weight;
    }
    uint64_t sent = 0;
    for (size_t w = 0; w < setup->wavelength_count; w++) {
        const double share = setup->wavelengths[w].weight / all;
        before += share;
        const bool is_last = w + 1 == setup->wavelength_count;
        const uint64_t until =
            is_last ? question->samples : (uint64_t)llround(before * (double)question->samples);
        if (until > sent &&
            !send(stream, w, until - sent, share, visit, context, &result->arrived, error)) {
            return false;
        }
        sent = until;
    }
    return true;
}
