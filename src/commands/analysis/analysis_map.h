/* commands/analysis/analysis_map.h - maps as files of pictures and numbers. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_COMMANDS_ANALYSIS_ANALYSIS_MAP_H
#define LENSCALC_COMMANDS_ANALYSIS_ANALYSIS_MAP_H

#include "commands/analysis/analysis_options.h"
#include "draw/raster.h"

/* .png, false colours; .pfm, the numbers, 0 where there is nothing. */
file_types map_types;

/*
 * The one map of a job.
 *
 * Errors    ERROR_USAGE: there are several; as raster_png and pfm_write
 */
bool analysis_map_write(const struct artifact_job *job, const struct rasters *rasters,
                        struct output *sink, struct error *error);

/* What a map of a field is called: "14 deg, f/4, defocus 0.1 mm". */
const char *analysis_map_title(const struct analysis_case *one, size_t field, struct arena *arena);

/* The title of a page: "WHAT of LENS"; of several lenses WHAT, and they stand over the maps. */
const char *analysis_map_heads(const char *what, const char *const *lenses, struct raster_map *maps,
                               size_t count, struct arena *arena);

#endif
