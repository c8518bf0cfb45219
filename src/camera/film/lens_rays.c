/* camera/film/lens_rays.c - blocks of samples, each traced from the film to the scene. */
/* SPDX-License-Identifier: MIT */
#include "camera/film/lens_rays.h"

#include <math.h>

/* The first `count` rays of a block that pass; each weight is multiplied. */
static size_t lens_rays_collect(struct lens_rays *stream, const struct system *system, size_t count,
                                double by)
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

/* Begin the rays of a wavelength, which stand for a share of the light. */
static void lens_rays_begin(struct lens_rays *stream, size_t w)
{
    const struct setup *setup = stream->question->film.setup;
    double all = 0, before = 0;
    for (size_t i = 0; i < setup->wavelength_count; i++) {
        all += setup->wavelengths[i].weight;
    }
    for (size_t i = 0; i <= w; i++) {
        before += setup->wavelengths[i].weight / all;
    }
    const uint64_t samples = stream->question->samples, seed = stream->question->seed;
    const bool is_last = w + 1 == setup->wavelength_count;
    const uint64_t until = is_last ? samples : (uint64_t)llround(before * (double)samples);
    stream->wavelength = w;
    stream->share = setup->wavelengths[w].weight / all;
    stream->done = 0;
    stream->samples_of = until > stream->sent ? until - stream->sent : 0;
    stream->sent = until;
    stream->when = sobol_scrambling(seed, w, FILM_DIMENSIONS);
    for (uint32_t k = 0; k < FILM_DIMENSIONS; k++) {
        stream->plan.scrambling[k] = sobol_scrambling(seed, w, k);
    }
}

bool lens_rays_open(const struct lens_rays_question *question, struct arena *arena,
                    struct lens_rays *stream, struct error *error)
{
    *stream = (struct lens_rays){.question = question};
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
    lens_rays_begin(stream, 0);
    return true;
}

size_t lens_rays_next(struct lens_rays *stream)
{
    const struct lens_rays_question *question = stream->question;
    while (stream->done >= stream->samples_of) {
        if (stream->wavelength + 1 == question->film.setup->wavelength_count) {
            return 0;
        }
        lens_rays_begin(stream, stream->wavelength + 1);
    }
    const struct system *system = stream->film.models[stream->wavelength].system;
    const double n = stream->film.region.index / system->index_last;
    const double lit =
        stream->plan.width * stream->plan.height / (question->film.width * question->film.height);
    const double by = stream->share * lit * n * n;
    size_t kept = 0;
    while (stream->done < stream->samples_of && kept == 0) {
        const uint64_t left = stream->samples_of - stream->done;
        const uint32_t block = (uint32_t)(stream->done / RAYS_BLOCK);
        film_rays_plan(&stream->plan, NULL, block, SET_BEST, &stream->samples);
        sobol_points(&stream->sobol_time, stream->when, block, stream->times);
        lens_film_start(&stream->film, &stream->samples, stream->rays.blocks);
        lens_film_trace(&stream->film, stream->wavelength, &stream->samples, &stream->rays);
        /* when, within what the shutter leaves of the exposure to each */
        const struct shutter *shutter = stream->film.shutter;
        const double *begin = stream->samples.begin, *end = stream->samples.end;
        for (size_t i = 0; shutter != NULL && i < RAYS_BLOCK; i++) {
            const double time = begin[i] + stream->times[i] * (end[i] - begin[i]);
            stream->times[i] = time / shutter->time + 0.5;
        }
        kept = lens_rays_collect(stream, system, left < RAYS_BLOCK ? (size_t)left : RAYS_BLOCK,
                                 by / (double)stream->samples_of);
        stream->arrived += kept;
        stream->done += RAYS_BLOCK;
    }
    return kept > 0 ? kept : lens_rays_next(stream);
}
