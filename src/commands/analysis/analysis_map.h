/* commands/analysis/analysis_map.h - maps as files of pictures and numbers. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_COMMANDS_ANALYSIS_ANALYSIS_MAP_H
#define LENSCALC_COMMANDS_ANALYSIS_ANALYSIS_MAP_H

#include "commands/analysis/analysis_fields.h"
#include "draw/raster.h"

/* .png, false colours; .pfm, the numbers, 0 where there is nothing. */
file_types map_types;

/* The maps of a job. */
struct map_page {
    const struct artifact_job *job;
    const void *input; /* the one at hand, which begins with its struct analysis_question */
    struct rasters rasters;
    struct raster_map maps[RASTER_MAPS_MOST];
    const char *lenses[RASTER_MAPS_MOST]; /* whose they are */
};

/*
 * Fill a page.
 *
 * Given     page    its rasters but for title, maps and count
 *           what    "Wave fronts": the title is that "of LENS"; of several lenses it is that alone,
 *                   and they stand below the maps
 *           answer  adds the map of a field by map_page_add; its context is the page
 * Errors    as analysis_each_field; ERROR_DOMAIN: there is nothing to draw
 */
bool map_page_collect(struct map_page *page, const struct artifact_job *job,
                      const struct analysis_policy *policy, const struct analysis_answers *answers,
                      const char *what, struct error *error);

/* Add a map of a case. Errors: ERROR_USAGE, there is no room. */
bool map_page_add(struct map_page *page, const struct analysis_case *one,
                  const struct raster_map *map, struct error *error);

/* What stands below the title, if it is the same for all maps. */
void map_page_subtitle(struct map_page *page, const char *words);

/* As a drawing. Errors as rasters_draw. */
bool map_page_draw(const struct map_page *page, struct output *sink, struct error *error);

/*
 * The one map of a page as a file of map_types.
 *
 * Errors    ERROR_USAGE: there are several; as raster_png and pfm_write
 */
bool map_page_write(const struct map_page *page, struct output *sink, struct error *error);

/* What a map of a field is called: "14 deg, f/4, defocus 0.1 mm". */
const char *analysis_map_title(const struct analysis_case *one, size_t field, struct arena *arena);

#endif
