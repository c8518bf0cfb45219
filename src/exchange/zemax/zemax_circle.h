/* exchange/zemax/zemax_circle.h - pick-ups of a .zmx file that go in a circle. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_EXCHANGE_ZEMAX_ZEMAX_CIRCLE_H
#define LENSCALC_EXCHANGE_ZEMAX_ZEMAX_CIRCLE_H

#include "exchange/zemax/zemax_parse.h"

/*
 * Are the pick-ups without circles: thicknesses, curvatures, semi-diameters, parameters?
 *
 * Given     file  parsed, its numbers of surfaces without gaps
 * Errors    ERROR_DATA at a pick-up that follows itself, through however many others
 */
bool zemax_check_circles(const struct zemax_file *file, struct error *error);

#endif
