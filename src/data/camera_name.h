/* data/camera_name.h - names of cameras as people shorten them. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DATA_CAMERA_NAME_H
#define LENSCALC_DATA_CAMERA_NAME_H

#include "base/text.h"

enum { MOST_CAMERA_NAME = 96 };

/*
 * What the short forms of a camera's model have in common: "EOS 5D Mark IV", "5d mk 4" and "5D4" are
 * all "5d4", "GR III" is "gr3".
 *
 * Given     model   without its maker
 *           folded  receives small letters, digits and . : / + alone: without the words of a series
 *                   (EOS, Alpha, PowerShot, Lumix), without Mark, and with Roman numbers from 2 to 9
 *                   as digits where they stand alone or behind a digit and at most one letter
 * Result    folded, that ends with its terminating NUL; of no letters where the name is too long
 */
struct text camera_name_fold(struct text model, char folded[MOST_CAMERA_NAME]);

#endif
