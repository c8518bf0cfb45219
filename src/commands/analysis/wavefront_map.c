/* commands/analysis/wavefront_map.c - wave fronts over the pupil, drawn and as numbers. */
/* SPDX-License-Identifier: MIT */
#include "commands/analysis/analysis_map.h"
#include "commands/analysis/analysis_words.h"
#include "commands/analysis/wavefront_input.h"

#include <string.h>

/* The maps of a page. */
struct page {
    const struct artifact_job *job;
    const struct wavefront_input *input;
    struct rasters rasters;
    struct raster_map maps[RASTER_MAPS_MOST];
    const char *lenses[RASTER_MAPS_MOST]; /* whose they are */
};

static const char *note_of(const double *values, size_t count, struct arena *arena)
{
    double low = INFINITY, high = -INFINITY;
    for (size_t i = 0; i < count; i++) {
        low = fmin(low, values[i]);
        high = fmax(high, values[i]);
    }
    return high >= low ? arena_printf(arena, "lowest to highest %.3g waves", high - low)
                       : "no ray arrives";
}

/* Without the piston: about the mean of the map. */
static const double *level(const double *values, size_t count, struct arena *arena)
{
    double sum = 0, some = 0, *levelled = ARENA_ARRAY(arena, count, double);
    for (size_t i = 0; i < count; i++) {
        sum += isnan(values[i]) ? 0 : values[i];
        some += isnan(values[i]) ? 0 : 1;
    }
    for (size_t i = 0; i < count; i++) {
        levelled[i] = values[i] - sum / some;
    }
    return levelled;
}

static bool add(const struct analysis_case *one, size_t field, void *context, struct error *error)
{
    struct page *page = context;
    struct arena *arena = page->job->run->arena;
    struct wavefront_source source;
    const size_t size = (size_t)page->input->size;
    if (page->rasters.count == RASTER_MAPS_MOST) {
        return fail(error, ERROR_USAGE, "a page has room for %d maps, not for more",
                    RASTER_MAPS_MOST);
    }
    if (!wavefront_of_case(one, field, page->input, arena, &source, error)) {
        return false;
    }
    const double *values = level(wavefront_map(&source, size, arena), size * size, arena);
    page->maps[page->rasters.count++] =
        (struct raster_map){.title = analysis_map_title(one, field, arena),
                            .note = note_of(values, size * size, arena),
                            .size = size,
                            .values = values,
                            .half = 1};
    page->lenses[page->rasters.count - 1] = one->setup->lens->title;
    page->rasters.subtitle =
        arena_printf(arena, "against %s; %s",
                     wave_reference_words(one, (enum wave_about)page->input->reference, arena),
                     analysis_case_words(one, true, arena));
    return true;
}

static bool skip(const struct analysis_point *point, void *context)
{
    (void)point;
    (void)context;
    return true;
}

/* The maps of all inputs of a job. */
static bool collect(const struct artifact_job *job, struct page *page, struct error *error)
{
    static const struct analysis_answers answers = {add, skip};
    const struct wavefront_input *first = job->inputs[0];
    const bool entrance = first->question.aim == ANALYSIS_AIM_ENTRANCE;
    page->job = job;
    page->rasters =
        (struct rasters){.x_label = entrance ? "x in the entrance pupil" : "x in the stop",
                         .y_label = entrance ? "y in the entrance pupil" : "y in the stop",
                         .scale_label = "W - mean (waves)",
                         .colours = RASTER_SIGNED,
                         .columns = 3,
                         .maps = page->maps};
    for (size_t i = 0; i < job->count; i++) {
        page->input = job->inputs[i];
        if (!analysis_each_field(&page->input->question, &wavefront_policy, job->run, &answers,
                                 page, error)) {
            return false;
        }
    }
    page->rasters.title = analysis_map_heads("Wave fronts", page->lenses, page->maps,
                                             page->rasters.count, job->run->arena);
    if (strcmp(page->rasters.title, "Wave fronts") == 0) {
        page->rasters.subtitle = NULL; /* that of one of them */
    }
    return page->rasters.count > 0 || fail(error, ERROR_DOMAIN, "there is no wave front to draw");
}

bool wavefront_page(const struct artifact_job *job, struct output *sink, struct error *error)
{
    struct page page = {.input = NULL};
    struct svg svg = {.arena = job->run->arena};
    return collect(job, &page, error) && rasters_draw(&page.rasters, &svg, error) &&
           drawing_write(job, &svg, sink, error);
}

bool wavefront_file(const struct artifact_job *job, struct output *sink, struct error *error)
{
    struct page page = {.input = NULL};
    return collect(job, &page, error) && analysis_map_write(job, &page.rasters, sink, error);
}
