/* commands/analysis/psf_map.c - images of points, drawn and as numbers. */
/* SPDX-License-Identifier: MIT */
#include "commands/analysis/analysis_map.h"
#include "commands/analysis/psf_input.h"

#include <string.h>

static const double decades = 5;

/* The maps of a page. */
struct page {
    const struct artifact_job *job;
    const struct psf_input *input;
    struct rasters rasters;
    struct raster_map maps[RASTER_MAPS_MOST];
    const char *lenses[RASTER_MAPS_MOST]; /* whose they are */
};

static bool add(const struct analysis_case *one, size_t field, void *context, struct error *error)
{
    struct page *page = context;
    struct arena *arena = page->job->run->arena;
    struct psf psf;
    if (page->rasters.count == RASTER_MAPS_MOST) {
        return fail(error, ERROR_USAGE, "a page has room for %d maps, not for more",
                    RASTER_MAPS_MOST);
    }
    if (!psf_of_case(one, field, page->input, arena, &psf, error)) {
        return false;
    }
    page->lenses[page->rasters.count] = one->setup->lens->title;
    page->maps[page->rasters.count++] = (struct raster_map){
        .title = analysis_map_title(one, field, arena),
        .note = arena_printf(arena, "peak %.3g, %.3g %% of the light", psf.peak, 100 * psf.inside),
        .size = psf.size,
        .values = psf.values,
        .half = 1000 * psf.pitch * (double)psf.size / 2};
    page->rasters.subtitle = arena_printf(
        arena, "focus %s; %s", one->setup->focus,
        one->spectrum != NULL
            ? one->spectrum
            : arena_printf(arena, "%.6g nm", 1000 * one->setup->wavelengths[0].wavelength));
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
    const struct psf_input *first = job->inputs[0];
    page->job = job;
    page->rasters = (struct rasters){.x_label = "x (\xc2\xb5m)",
                                     .y_label = "y (\xc2\xb5m)",
                                     .scale_label = "share of the peak of the map",
                                     .colours = first->log ? RASTER_LOG : RASTER_LIGHT,
                                     .decades = decades,
                                     .own_scale = true,
                                     .columns = 3,
                                     .maps = page->maps};
    for (size_t i = 0; i < job->count; i++) {
        page->input = job->inputs[i];
        if (!analysis_each_field(&page->input->question, &psf_policy, job->run, &answers, page,
                                 error)) {
            return false;
        }
    }
    page->rasters.title = analysis_map_heads("Images of points", page->lenses, page->maps,
                                             page->rasters.count, job->run->arena);
    if (strcmp(page->rasters.title, "Images of points") == 0) {
        page->rasters.subtitle = NULL; /* that of one of them */
    }
    return page->rasters.count > 0 || fail(error, ERROR_DOMAIN, "there is no image to draw");
}

bool psf_page(const struct artifact_job *job, struct output *sink, struct error *error)
{
    struct page page = {.input = NULL};
    struct svg svg = {.arena = job->run->arena};
    return collect(job, &page, error) && rasters_draw(&page.rasters, &svg, error) &&
           drawing_write(job, &svg, sink, error);
}

bool psf_file(const struct artifact_job *job, struct output *sink, struct error *error)
{
    struct page page = {.input = NULL};
    return collect(job, &page, error) && analysis_map_write(job, &page.rasters, sink, error);
}
