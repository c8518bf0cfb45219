/* file/zemax.h - Zemax sequential lens files, .zmx. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_FILE_ZEMAX_H
#define LENSCALC_FILE_ZEMAX_H

#include "exchange/foreign.h"

/*
 * .zmx as OpticStudio and its forerunners write it.
 *
 * Source    the format is not published; what is known comes from public files and from readers
 *           such as ray-optics (zmxread.py) and optiland (zemax_handler). [OpticStudio25] says what
 *           the surface types mean
 * Limits    which surfaces, apertures and solves there are is told in lenscalc-convert.1
 */
extern const struct foreign_format zemax_format;

bool zemax_write(struct foreign_job *job, const struct lens *lens, struct text *text,
                 struct error *error);

#endif
