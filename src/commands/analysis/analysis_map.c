/* commands/analysis/analysis_map.c - maps as files of pictures and numbers. */
/* SPDX-License-Identifier: MIT */
#include "commands/analysis/analysis_map.h"

#include "base/image/pfm.h"

#include <string.h>

static const struct file_type png_type = {{"png", "PNG, false colours"}, ".png"};
static const struct file_type pfm_type = {{"pfm", "PFM, the numbers as floats"}, ".pfm"};

const struct file_type *map_types(size_t i)
{
    static const struct file_type *const types[] = {&png_type, &pfm_type, NULL};
    return types[i];
}

bool map_is_drawing(const struct artifact_job *job)
{
    return job->type != &png_type && job->type != &pfm_type;
}

static bool map_numbers(const struct raster_map *map, struct arena *arena, struct text *file,
                        struct error *error)
{
    struct image image = {.width = map->size, .height = map->size, .channels = 1};
    if (!image_new(&image, arena, error)) {
        return false;
    }
    for (size_t y = 0; y < map->size; y++) {
        float *row = image_row(&image, map->size - 1 - y);
        for (size_t x = 0; x < map->size; x++) {
            const double value = map->values[y * map->size + x];
            row[x] = isnan(value) ? 0 : (float)value;
        }
    }
    return pfm_write(&image, arena, file, error);
}

bool map_page_add(struct map_page *page, const struct analysis_case *one,
                  const struct raster_map *map, const char *subtitle, struct error *error)
{
    struct rasters *rasters = &page->rasters;
    if (rasters->count == RASTER_MAPS_MOST) {
        return fail(error, ERROR_USAGE, "a page has room for %d maps, not for more",
                    RASTER_MAPS_MOST);
    }
    const char *before = rasters->subtitle;
    rasters->subtitle = before == NULL || strcmp(before, subtitle) == 0 ? subtitle : "";
    page->lenses[rasters->count] = one->setup->lens->title;
    page->maps[rasters->count++] = *map;
    return true;
}

bool map_page_make(struct map_page *page, const char *what, struct output *sink,
                   struct error *error)
{
    const struct artifact_job *job = page->job;
    struct rasters *rasters = &page->rasters;
    struct arena *arena = job->run->arena;
    bool one = true;
    if (rasters->count == 0) {
        return fail(error, ERROR_DOMAIN, "there is nothing to draw");
    }
    rasters->maps = page->maps;
    for (size_t i = 1; i < rasters->count; i++) {
        one = one && strcmp(page->lenses[i], page->lenses[0]) == 0;
    }
    rasters->title = one ? arena_printf(arena, "%s of %s", what, page->lenses[0]) : what;
    for (size_t i = 0; i < rasters->count && !one; i++) {
        const char *title = page->maps[i].title;
        page->maps[i].title =
            title != NULL ? ARENA_JOIN(arena, page->lenses[i], ", ", title) : page->lenses[i];
        rasters->subtitle = "";
    }
    if (map_is_drawing(job)) {
        struct svg svg = {.arena = arena};
        return rasters_draw(rasters, &svg, error) && drawing_write(job, &svg, sink, error);
    }
    struct text file;
    if (rasters->count != 1) {
        return fail(error, ERROR_USAGE,
                    "{--map} has room for one map, and this makes %zu: name one {--field}",
                    rasters->count);
    }
    if (!(job->type == &pfm_type ? map_numbers(&rasters->maps[0], arena, &file, error)
                                 : raster_png(rasters, 0, arena, &file, error))) {
        return false;
    }
    output_text(sink, file.start, file.length);
    return true;
}
