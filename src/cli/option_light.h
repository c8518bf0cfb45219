/* cli/option_light.h - values of light: filters, films, scenes, series of stops. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CLI_OPTION_LIGHT_H
#define LENSCALC_CLI_OPTION_LIGHT_H

#include "photo/reciprocity.h"

/* Light lost on the way, as filters are sold: "ND8+wratten-25". */
struct loss_value {
    double stops;     /* 0 where nothing is given */
    const char *name; /* as typed, with the stops; null = not given */
};

/* A film and how it fails in long exposures. */
struct film_value {
    const struct reciprocity *model; /* null = not given */
    const char *name, *source;
};

/* A scene and the light in it. */
struct scene_value {
    double ev100;
    const char *name, *source; /* null = not given */
};

/* Labels of one stop series: where cameras can stand. */
struct stop_labels {
    int first, count;    /* the first label's step */
    const char **labels; /* null where a step has none */
    double *values;      /* the labels as numbers */
};

/* A stop series for apertures and times. */
struct series_value {
    int per_stop; /* 1, 2 or 3 steps a stop */
    const struct stop_labels *fnumbers, *times;
};

/*
 * The place of a label in its series.
 *
 * Given     labels  of a series;  stops  Av or Tv of a setting;  per_stop  steps a stop
 * Result    index of the nearest step's label, -1 where none is near (or stops is NaN)
 */
int stop_labels_nearest(const struct stop_labels *labels, double stops, int per_stop);

/* The label of that place: "1/125"; null for -1. */
const char *stop_labels_text(const struct stop_labels *labels, int place);

#endif
