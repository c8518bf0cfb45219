/* file/lens_json.h - a lens as JSON, for other programs and scripts. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_FILE_LENS_JSON_H
#define LENSCALC_FILE_LENS_JSON_H

#include "file/foreign.h"

/*
 * One JSON object; its keys are told in lenscalc-convert.1. Lengths are in mm, angles in degrees,
 * numbers have the shortest digits that read back to the same double. What differs between the
 * positions of the lens is an array, one number a position; indices are an array, one a wavelength.
 *
 * Reading   there is none: it refuses every JSON file with a message
 * Errors    writing, ERROR_DOMAIN: a glass without index at a wavelength of the lens
 */
extern const struct foreign_format lens_json_format;

#endif
