/* commands/analysis/analysis_map.h - maps as files of pictures and numbers. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_COMMANDS_ANALYSIS_ANALYSIS_MAP_H
#define LENSCALC_COMMANDS_ANALYSIS_ANALYSIS_MAP_H

#include "commands/analysis/analysis_cursor.h"
#include "draw/raster.h"

/* .png, false colours; .pfm, the numbers, 0 where there is nothing. */
file_types map_types;

/* The maps of a job. */
struct map_page {
    const struct artifact_job *job;
    struct rasters rasters;
    struct raster_map maps[RASTER_MAPS_MOST];
    const char *lenses[RASTER_MAPS_MOST]; /* whose they are */
};

/* A page without maps. Its rasters want all but title, maps and count. */
void map_page_begin(struct map_page *page, const struct artifact_job *job);

/* Add a map of a case. Errors: ERROR_USAGE, there is no room. */
bool map_page_add(struct map_page *page, const struct analysis_case *one,
                  const struct raster_map *map, struct error *error);

/*
 * All maps are added.
 *
 * Given     what  "Wave fronts": the title is that "of LENS"; of several lenses it is that alone,
 *                 and they stand below the maps
 * Errors    ERROR_DOMAIN: there is nothing to draw
 */
bool map_page_end(struct map_page *page, const char *what, struct error *error);

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

#endif
