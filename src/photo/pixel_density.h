/* photo/pixel_density.h - pixels along the subject, and how many surveillance wants. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_PHOTO_PIXEL_DENSITY_H
#define LENSCALC_PHOTO_PIXEL_DENSITY_H

#include <stddef.h>

/* What an operator is to make of a picture, and the least pixel density for it. */
struct viewing_task {
    const char *name;
    double density; /* px/mm */
};

/*
 * The tasks of IEC 62676-4:2014 (DORI) and behind them those of its edition of 2025.
 *
 * Source    [IEC14] 2014: 80, 40, 16, 8, 4 and 1 mm per pixel, table 3 of EN 62676-4:2015, too;
 *           2025: 20, 40, 80, 125, 250, 500 and 1500 px/m, of which 500 and the names have a second
 *           printed source, the others only that of [IEC14]. EN 50132-7:2012 has the 2014 tasks but
 *           in percent of the height of a screen
 * Limits    of the pixels alone: what light, compression and motion take is not in them
 */
extern const struct viewing_task viewing_tasks[];

enum { DORI_TASKS = 6, VIEWING_TASKS = 13 };

/*
 * Pixel density on the subject, in the middle of the picture.
 *
 * Given     m  magnification, >= 0;  pitch  of the pixels, mm, > 0, or NaN;  squeeze  > 0
 * Result    px/mm across; NaN without a pitch
 * Formula   m/(pitch squeeze)
 */
double pixel_density(double m, double pitch, double squeeze);

/*
 * Lines a second that keep the pixels of a line-scan camera square on what passes.
 *
 * Given     speed  of what passes, mm/s, > 0;  density  px/mm along the line, > 0
 * Result    Hz
 * Formula   speed density
 * Source    [SukHamburg14] f_L = V_O b/W_P
 */
double line_rate(double speed, double density);

#endif
