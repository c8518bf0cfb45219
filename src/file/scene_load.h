/* file/scene_load.h - what a scene names beside it: pictures, tables, meshes. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_FILE_SCENE_LOAD_H
#define LENSCALC_FILE_SCENE_LOAD_H

#include "file/scene_reader.h"

/* What a picture is for. */
enum scene_picture {
    PICTURE_OF_SURFACE, /* shares of light that are reflected: three channels, at most 1 */
    PICTURE_OF_CARD,    /* the same; a fourth channel, alpha, says what there is */
    PICTURE_OF_LIGHT,   /* three channels of at least 0 */
    PICTURE_THAT_SHINES /* the same with alpha */
};

/*
 * The picture that is the value of a key, and its mean; one file is read once.
 *
 * Errors    ERROR_DATA at the key: no such file, no picture, a number that is none or out of its
 *           range, an alpha that means nothing here
 */
bool scene_load_picture(struct scene_reader *reader, const struct scene_line *line,
                        enum scene_key key, enum scene_picture kind, struct scene_loaded *loaded,
                        struct error *error);

/*
 * A spectrum out of a table whose first column is wavelength_nm, and the second its values; one
 * file is read once.
 *
 * Errors    ERROR_DATA: no such file, less than two rows, wavelengths that do not rise, values
 *           below 0
 */
bool scene_load_table(struct scene_reader *reader, const struct scene_line *line,
                      struct spectrum *spectrum, struct error *error);

/*
 * The mesh of file= in the size of scale=.
 *
 * Given     has_texture  its material has one: what has no place in it is noted
 * Errors    as obj_read; more triangles than may be
 */
bool scene_load_mesh(struct scene_reader *reader, const struct scene_line *line, bool has_texture,
                     const struct scene_mesh **mesh, struct error *error);

#endif
