/* data/camera_name.h - names of cameras as people shorten them. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DATA_CAMERA_NAME_H
#define LENSCALC_DATA_CAMERA_NAME_H

#include "base/text.h"

#include <stdbool.h>

enum { MOST_CAMERA_NAME = 96 };

/*
 * What the short forms of a camera's model have in common: "EOS 5D Mark IV", "5d mk 4" and "5D4"
 * are all "5d4", "GR III" is "gr3".
 *
 * Given     model   without its maker
 *           folded  receives it in small letters without blanks, '-' and '_', without the words of
 *                   a series (EOS, Rebel, Alpha, Lumix, Galaxy) and Mark, and with Roman numbers
 *                   from 2 to 9 as digits where they stand alone, behind Mark, or behind a digit
 *                   and at most one letter; what is longer than it is cut
 * Result    folded, which also ends with NUL
 */
struct text camera_name_fold(struct text model, char folded[MOST_CAMERA_NAME]);

/* Cut the maker, by one of the names that it has, off a name that begins with it. */
bool camera_name_cut_maker(struct text *name, struct text maker);

/* Offer every name of a maker. */
void camera_name_offer_maker(struct nearest *nearest, struct text maker);

/* How far apart are the numbers in which two names begin to differ? "HERO 14" and "HERO12" are 2,
   names that differ in letters 0 apart. */
double camera_name_numbers_apart(struct text a, struct text b);

#endif
