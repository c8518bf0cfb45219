/* draw/ticks.h - round numbers along an axis, and how they are written. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DRAW_TICKS_H
#define LENSCALC_DRAW_TICKS_H

#include <stddef.h>

struct arena;

/* Ticks of an axis, ascending. */
#define TICKS_MOST 12
struct ticks {
    double value[TICKS_MOST];
    const char *text[TICKS_MOST]; /* of a stop series: "f/5.6", "1/125"; null: as numbers */
    size_t count;
    double step; /* between two ticks; 0 on a logarithmic axis */
};

/*
 * Round numbers for a linear axis: multiples of 1, 2 or 5 x 10^n.
 *
 * Given     low, high  the range, low <= high, absolute values 0 or 1e-200 .. 1e200
 * Result    4 to 11 ticks, the first at or below low, the last at or above high. A range below
 *           1e-9 of the values is widened to 10 % on both sides
 */
void ticks_linear(double low, double high, struct ticks *ticks);

/*
 * Round numbers for a logarithmic axis: 1, 2 and 5 in every decade as long as at most 12 are
 * needed, then decades, then every second decade and so on; below a factor of 4 as a linear axis.
 *
 * Given     low, high  the range, 1e-200 <= low <= high <= 1e200
 */
void ticks_log(double low, double high, struct ticks *ticks);

/* What an axis counts: numbers, or the stops of a camera by their labels. */
enum ticks_kind { TICKS_NUMBERS, TICKS_FNUMBER, TICKS_TIME, TICKS_ISO };

/*
 * Labels of a series of whole stops for a logarithmic axis: all, or every second, third ... of
 * them.
 *
 * Given     low, high  the range, above 0; times in s
 * Result    2 to 12 ticks, the first at or below low, the last at or above high; as ticks_log
 *           where the series does not reach so far, and for numbers
 * Source    labels: ISO 517:2008 (f-numbers), ISO 516:2019 (times), ISO 12232:2019 (speeds)
 */
void ticks_stops(enum ticks_kind kind, double low, double high, struct ticks *ticks);

/* How tick i is written: the same number of decimals on all, powers of ten where shorter. */
const char *ticks_text(struct arena *arena, const struct ticks *ticks, size_t i);

/* Make a range below 1e-9 of its values 10 % wider on both sides; 0 becomes -1 to 1. */
void ticks_widen(double *low, double *high);

/* A number with so many decimals at least, in fixed notation. */
const char *ticks_fixed(struct arena *arena, double x, int decimals);

/* Of the widest of their texts, px, at a size of letters. */
double ticks_width(struct arena *arena, const struct ticks *ticks, double size);

/* 1, 2 or 5 times a power of ten: the largest that is not above `most`, which is above 0. */
double ticks_round_below(double most);

/*
 * How far an axis has to reach for the bulk of values that are not negative, which are put in
 * order: to the largest, or where one in fifty at most is more than twice as large as all others,
 * to 1.3 times the largest of those.
 */
double ticks_reach(double *values, size_t count);

#endif
