/* commands/analysis/analysis_map.c - maps as files of pictures and numbers. */
/* SPDX-License-Identifier: MIT */
#include "commands/analysis/analysis_map.h"

#include "base/image/pfm.h"
#include "commands/analysis/analysis_words.h"

#include <string.h>

static const struct file_type png_type = {{"png", "PNG, false colours"}, ".png"};
static const struct file_type pfm_type = {{"pfm", "PFM, the numbers as floats"}, ".pfm"};

const struct file_type *map_types(size_t i)
{
    return i == 0 ? &png_type : i == 1 ? &pfm_type : NULL;
}

static bool write_numbers(const struct raster_map *map, struct arena *arena, struct text *file,
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

bool analysis_map_write(const struct artifact_job *job, const struct rasters *rasters,
                        struct output *sink, struct error *error)
{
    struct arena *arena = job->run->arena;
    struct text file;
    if (rasters->count != 1) {
        return fail(error, ERROR_USAGE,
                    "{--map} has room for one map, and this makes %zu: name one {--field}",
                    rasters->count);
    }
    if (!(job->type == &pfm_type ? write_numbers(&rasters->maps[0], arena, &file, error)
                                 : raster_png(rasters, 0, arena, &file, error))) {
        return false;
    }
    output_text(sink, file.start, file.length);
    return true;
}

const char *analysis_map_title(const struct analysis_case *one, size_t field, struct arena *arena)
{
    const struct field_point *at = &one->setup->fields[field].point;
    const char *words = analysis_case_words(one, false, arena);
    const char *place = at->kind == FIELD_NONE ? "axis" : lens_field_words(at, arena);
    return words != NULL ? arena_printf(arena, "%s, %s", place, words) : place;
}

const char *analysis_map_heads(const char *what, const char *const *lenses, struct raster_map *maps,
                               size_t count, struct arena *arena)
{
    bool one = true;
    for (size_t i = 1; i < count; i++) {
        one = one && strcmp(lenses[i], lenses[0]) == 0;
    }
    for (size_t i = 0; i < count && !one; i++) {
        maps[i].note = maps[i].note == NULL
                           ? lenses[i]
                           : arena_printf(arena, "%s; %s", lenses[i], maps[i].note);
    }
    return one && count > 0 ? arena_printf(arena, "%s of %s", what, lenses[0]) : what;
}
