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

static bool analysis_map_write_numbers(const struct raster_map *map, struct arena *arena,
                                       struct text *file, struct error *error)
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

bool map_page_write(const struct map_page *page, struct output *sink, struct error *error)
{
    const struct rasters *rasters = &page->rasters;
    struct arena *arena = page->job->run->arena;
    struct text file;
    if (rasters->count != 1) {
        return fail(error, ERROR_USAGE,
                    "{--map} has room for one map, and this makes %zu: name one {--field}",
                    rasters->count);
    }
    const bool made = page->job->type == &pfm_type
                          ? analysis_map_write_numbers(&rasters->maps[0], arena, &file, error)
                          : raster_png(rasters, 0, arena, &file, error);
    if (!made) {
        return false;
    }
    output_text(sink, file.start, file.length);
    return true;
}

bool map_page_draw(const struct map_page *page, struct output *sink, struct error *error)
{
    struct svg svg = {.arena = page->job->run->arena};
    return rasters_draw(&page->rasters, &svg, error) && drawing_write(page->job, &svg, sink, error);
}

void map_page_begin(struct map_page *page, const struct artifact_job *job)
{
    page->job = job;
    page->rasters = (struct rasters){.maps = page->maps};
}

bool map_page_add(struct map_page *page, const struct analysis_case *one,
                  const struct raster_map *map, struct error *error)
{
    if (page->rasters.count == RASTER_MAPS_MOST) {
        return fail(error, ERROR_USAGE, "a page has room for %d maps, not for more",
                    RASTER_MAPS_MOST);
    }
    page->lenses[page->rasters.count] = one->setup->lens->title;
    page->maps[page->rasters.count++] = *map;
    return true;
}

void map_page_subtitle(struct map_page *page, const char *words)
{
    const char *before = page->rasters.subtitle;
    page->rasters.subtitle = before == NULL || strcmp(before, words) == 0 ? words : "";
}

/* The title; several lenses stand below their maps. */
static void set_heads(struct map_page *page, const char *what)
{
    struct arena *arena = page->job->run->arena;
    bool one = true;
    for (size_t i = 1; i < page->rasters.count; i++) {
        one = one && strcmp(page->lenses[i], page->lenses[0]) == 0;
    }
    page->rasters.title = one ? arena_printf(arena, "%s of %s", what, page->lenses[0]) : what;
    for (size_t i = 0; i < page->rasters.count && !one; i++) {
        const char *note = page->maps[i].note;
        page->maps[i].note = arena_printf(arena, "%s; %s", page->lenses[i], note);
        page->rasters.subtitle = "";
    }
}

bool map_page_end(struct map_page *page, const char *what, struct error *error)
{
    if (page->rasters.count == 0) {
        return fail(error, ERROR_DOMAIN, "there is nothing to draw");
    }
    set_heads(page, what);
    return true;
}
