/* exchange/lens_json.h - a lens as JSON, for other programs and scripts. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_EXCHANGE_LENS_JSON_H
#define LENSCALC_EXCHANGE_LENS_JSON_H

#include "exchange/foreign.h"

/*
 * One JSON object; its keys are told in lenscalc-convert.1. Lengths are in mm, angles in degrees,
 * numbers have all digits of a pair, so that reading gives the same bits. What differs between the
 * positions of the lens is an array, one number a position; indices are an array, one a wavelength.
 *
 * Reading   lenscalc's own JSON, in any order of keys; indices follow from the media. JSON of
 *           another program is refused, a key that lenscalc does not know is a loss
 * Errors    writing, ERROR_DOMAIN: a glass without index at a wavelength of the lens
 */
extern const struct foreign_format lens_json_format;

/* foreign_format.read. */
bool lens_json_read(struct foreign_job *job, struct text content, struct lens *lens,
                    struct error *error);

#endif
