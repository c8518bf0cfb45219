/* file/lens_surface.h - one surface line of a .lens file. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_FILE_LENS_SURFACE_H
#define LENSCALC_FILE_LENS_SURFACE_H

#include "file/file_words.h"
#include "optics/lens.h"

/* Finds or makes the variable of this name and gives its index. */
typedef size_t lens_variable_function(void *context, struct text name);

/* What the line stands in. */
struct lens_surface_line {
    enum surface_kind kind;      /* SURFACE_REFRACT for `surface`, SURFACE_STOP, SURFACE_THICK */
    const struct medium *before; /* the surface; what a mirror leaves it in */
    lens_variable_function *variable; /* for cells that are names */
    void *context;                    /* of variable */
};

/* Read what follows the word `surface`, `stop` or `thick`. */
bool lens_surface_read(struct file_words *words, const struct lens_surface_line *line,
                       struct surface *surface, struct error *error);

/* Read what follows `bend`, a coordinate break. */
bool lens_coordinate_break_read(struct file_words *words,
                                const struct displacement **coordinate_break, struct error *error);

#endif
