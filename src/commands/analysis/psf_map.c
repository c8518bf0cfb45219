/* commands/analysis/psf_map.c - images of points, drawn and as numbers. */
/* SPDX-License-Identifier: MIT */
#include "commands/analysis/analysis_map.h"
#include "commands/analysis/psf_input.h"

#include <math.h>
#include <string.h>

static const double decades = 5;

static bool psf_map_check(const struct analysis_case *one, const void *context, struct error *error)
{
    const struct map_page *page = context;
    return psf_check(one, page->input, error);
}

static bool psf_map_find(const struct analysis_case *one, size_t field, const void *context,
                         void *found, struct error *error)
{
    const struct map_page *page = context;
    return psf_of_case(one, field, page->input, one->setup->arena, found, error);
}

static bool psf_map_add(const struct analysis_case *one, size_t field, const void *found,
                        void *context, struct error *error)
{
    struct map_page *page = context;
    struct arena *arena = page->job->run->arena;
    const struct psf *psf = found;
    const char *labels[] = {psf->is_angular ? "x (mrad)" : "x (\xc2\xb5m)",
                            psf->is_angular ? "y (mrad)" : "y (\xc2\xb5m)"};
    if (page->rasters.count > 0 && strcmp(page->rasters.x_label, labels[0]) != 0) {
        return fail(error, ERROR_USAGE,
                    "a page has no room for images in \xc2\xb5m and others infinitely far away");
    }
    page->rasters.x_label = labels[0];
    page->rasters.y_label = labels[1];
    const struct raster_map map = {
        .title = analysis_map_title(one, field, arena),
        .note = isnan(psf->inside) ? arena_printf(arena, "peak %.3g", psf->peak)
                                   : arena_printf(arena, "peak %.3g, %.3g %% of the light",
                                                  psf->peak, 100 * psf->inside),
        .size = psf->size,
        .values = psf->values,
        .half = 1000 * psf->pitch * (double)psf->size / 2};
    map_page_subtitle(
        page, arena_printf(arena, "%s%s; %s", psf->is_angular ? "" : "focus ",
                           psf->is_angular ? "angles of an afocal image" : one->setup->focus,
                           one->spectrum != NULL
                               ? one->spectrum
                               : arena_printf(arena, "%.6g nm",
                                              1000 * one->setup->wavelengths[0].wavelength)));
    return map_page_add(page, one, &map, error);
}

/* The maps of all inputs of a job. */
static bool psf_map_collect(const struct artifact_job *job, struct map_page *page,
                            struct error *error)
{
    static const struct analysis_answers answers = {.check = psf_map_check,
                                                    .find = psf_map_find,
                                                    .found_size = sizeof(struct psf),
                                                    .take = psf_map_add,
                                                    .lost = analysis_skip};
    const struct psf_input *first = job->inputs[0];
    page->rasters = (struct rasters){
        .scale_label = "share of the peak of the map",
        .colours = first->log ? RASTER_LOG : RASTER_LIGHT,
        .decades = decades,
        .own_scale = true,
        .columns = 3,
    };
    return map_page_collect(page, job, &psf_policy, &answers, "Images of points", error);
}

bool psf_page(const struct artifact_job *job, struct output *sink, struct error *error)
{
    struct map_page page = {.input = NULL};
    return psf_map_collect(job, &page, error) && map_page_draw(&page, sink, error);
}

bool psf_file(const struct artifact_job *job, struct output *sink, struct error *error)
{
    struct map_page page = {.input = NULL};
    return psf_map_collect(job, &page, error) && map_page_write(&page, sink, error);
}
