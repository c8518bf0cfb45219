/* file/lens_surface.h - one surface line of a .lens file. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_FILE_LENS_SURFACE_H
#define LENSCALC_FILE_LENS_SURFACE_H

#include "file/lens_words.h"

/* Finds or makes the variable of this name and gives its index. */
typedef size_t lens_variable_function(void *context, struct text name);

/*
 * Read what follows the word `surface`, `stop` or `thick`.
 *
 * Given     kind      SURFACE_REFRACT for `surface`, SURFACE_STOP, SURFACE_THICK
 *           before    the medium before the surface; what a mirror leaves it in
 *           variable  for cells that are names
 */
bool lens_surface_read(struct lens_words *words, enum surface_kind kind,
                       const struct medium *before, lens_variable_function *variable, void *context,
                       struct surface *surface, struct error *error);

/* Read what follows `bend`. */
bool lens_bend_read(struct lens_words *words, const struct displacement **bend,
                    struct error *error);

#endif
