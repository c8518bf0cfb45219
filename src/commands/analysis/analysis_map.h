/* commands/analysis/analysis_map.h - maps as files of pictures and numbers. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_COMMANDS_ANALYSIS_ANALYSIS_MAP_H
#define LENSCALC_COMMANDS_ANALYSIS_ANALYSIS_MAP_H

#include "commands/analysis/analysis_cursor.h"
#include "draw/raster.h"

/* .png, false colours; .pfm, the numbers, 0 where there is nothing. */
file_types map_types;

/* Is a page of maps asked for, whatever its format, and not one of those files? */
bool map_is_drawing(const struct artifact_job *job);

/* The maps of a job; its rasters want all but title, maps and count. */
struct map_page {
    const struct artifact_job *job;
    struct rasters rasters;
    struct raster_map maps[RASTER_MAPS_MOST];
    const char *lenses[RASTER_MAPS_MOST]; /* whose they are */
};

/*
 * Add a map of a case.
 *
 * Given     subtitle  what stands below the title, if it is the same for all maps
 * Errors    ERROR_USAGE, there is no room
 */
bool map_page_add(struct map_page *page, const struct analysis_case *one,
                  const struct raster_map *map, const char *subtitle, struct error *error);

/*
 * All maps are added: write them as a drawing, or the one there is as a file of map_types.
 *
 * Given     what  "Wave fronts": the title is that "of LENS"; of several lenses it is that alone,
 *                 and they stand above the maps
 * Errors    ERROR_DOMAIN: there is nothing to draw; ERROR_USAGE: several for one file; as
 *           rasters_draw, raster_png and pfm_write
 */
bool map_page_make(struct map_page *page, const char *what, struct output *sink,
                   struct error *error);

#endif
