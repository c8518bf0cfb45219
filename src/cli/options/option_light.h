/* cli/options/option_light.h - values of light: filters, films, scenes, series of stops. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CLI_OPTIONS_OPTION_LIGHT_H
#define LENSCALC_CLI_OPTIONS_OPTION_LIGHT_H

#include "data/lensdb.h"
#include "photo/reciprocity.h"

#include <stdbool.h>
#include <stddef.h>

/* Light lost on the way, as filters are sold: "ND8+wratten-25". */
struct loss_value {
    double stops;     /* 0 where nothing is given */
    double mired;     /* shift of the colour temperature; NaN = a colour that is none of light */
    const char *name; /* as typed, with the stops; null = not given */
};

/* Filters that somebody has: ND8,ND64,ND1000. */
struct filters_value {
    const struct loss_value *items; /* null = not given; names as typed, without stops */
    size_t count;
};

/* A film and how it fails in long exposures. */
struct film_value {
    const struct reciprocity *model; /* null = not given */
    const char *name, *source;
    double speed;           /* ISO, of the box; NaN = several, or not known */
    const char *type;       /* "panchromatic", "colour negative"; null = not known */
    const char *speed_note; /* "ISO 400, the film's box speed"; of several: which; else null */
};

/* A scene and the light in it. */
struct scene_value {
    double ev100;
    const char *name, *source; /* null = not given */
};

/* Labels of one stop series: where cameras can stand. */
enum { STOP_FIRST = -64, STOP_COUNT = 192 };
struct stop_labels {
    const char *labels[STOP_COUNT]; /* of step STOP_FIRST + i; null where a step has none */
};

/* A stop series for apertures and times. */
struct series_value {
    int per_stop; /* 1, 2 or 3 steps a stop */
    const struct stop_labels *fnumbers, *times;
    struct lensdb *db; /* where its speeds are, which few questions need */
};

/*
 * The nearest ISO speed that cameras of a series have; thirds of a stop for those with half stops.
 *
 * Result    label  as it is printed; null: none within half a step of S
 *           exact  the speed behind it
 */
const char *series_speed(const struct series_value *series, double S, double *exact);

/* The label of a step, a whole number (or NaN): "1/125"; null where it has none. */
static inline const char *stop_label(const struct stop_labels *labels, double step)
{
    bool inside = step >= STOP_FIRST && step < STOP_FIRST + STOP_COUNT;
    return inside ? labels->labels[(int)step - STOP_FIRST] : NULL;
}

#endif
