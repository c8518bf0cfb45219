/* commands/analysis/field_map.h - what an analysis finds of a field, over the image format. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_COMMANDS_ANALYSIS_FIELD_MAP_H
#define LENSCALC_COMMANDS_ANALYSIS_FIELD_MAP_H

#include "commands/analysis/analysis_cursor.h"

/* What --over-field may be written as: a drawing, or the numbers of one map as PFM. */
file_types field_map_types;

/* Numbers of a field at most: of a map each is a map of its own; of bars see below. */
enum { FIELD_MAP_VALUES = 3, FIELD_MAP_TANGENTIAL = 0, FIELD_MAP_SAGITTAL, FIELD_MAP_TURN };

/* How a command maps its fields. */
struct field_map_kind {
    const struct analysis_policy *policy;
    analysis_find *find; /* of one field: `values` doubles, those below */
    size_t values;       /* 1, or 2: tangential and sagittal; of bars 3: mm, mm, and by how much
                              the tangential section is turned, rad */
    const char *what;    /* the title is that "over the image of LENS" */
    const char *scale;   /* what the colours are, with units */
    const char *angular; /* the same of an image infinitely far away; null: there are none */
    double highest;      /* of the scale at least; 0: from the values */
    bool is_bars;        /* both foci, as bars */
    /* What else tells maps of one case apart, as a frequency; null: nothing. */
    const char *(*words)(const void *input, struct arena *arena);
};

/*
 * Draw the maps of all inputs of a job: of each lens and case one, whatever fields it is asked for.
 *
 * Result    out to the --sensor, or to the circle of the chief ray that lands farthest out of all
 *           fields that are asked for. Of a lens that is the same all round, along one radius: the
 *           points are doubled until they are met to 1/200 of the range by cubics through those of
 *           before; else at 25 points across and up, between which it is interpolated. Points
 *           without rays stay blank, and the note below the map says where and how many
 * Formula   places are those of the real image: FIELD_REAL; of an image infinitely far away angles
 * Errors    ERROR_DOMAIN: no field lies off the axis, no point has rays; ERROR_USAGE: a sensor of
 *           an image at infinity, several maps as numbers
 */
bool field_map_make(const struct artifact_job *job, const struct field_map_kind *kind,
                    struct output *sink, struct error *error);

#endif
