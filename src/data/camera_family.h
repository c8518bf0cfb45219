/* data/camera_family.h - what comes nearest to a camera that no table has. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DATA_CAMERA_FAMILY_H
#define LENSCALC_DATA_CAMERA_FAMILY_H

#include "data/camera_name.h"
#include "data/lensdb.h"

/*
 * A name whose first word is one letter away from a maker, with the maker spelled right.
 *
 * Given     respelled  receives it
 * Result    it, or the name itself where no maker is so near
 */
struct text camera_family_respell(struct lensdb *db, struct text name,
                                  char respelled[MOST_CAMERA_NAME]);

/*
 * Add to an error what may have been meant by a name that no format or camera has: the nearest of
 * its family with their sizes, or the nearest word.
 *
 * Result    false
 */
bool camera_family_hint(struct lensdb *db, struct text name, struct error *error);

#endif
