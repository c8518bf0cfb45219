/* file/scene_reader.h - a .scene file while it is read, and who reads which of its lines. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_FILE_SCENE_READER_H
#define LENSCALC_FILE_SCENE_READER_H

#include "base/name_table.h"
#include "file/scene_file.h"
#include "file/scene_words.h"

/* A colour that has a name. */
struct scene_colour {
    struct spectrum spectrum;
    bool is_light; /* that of a light: no surface may have it */
};

/* A picture that was read. */
struct scene_loaded {
    const struct image *image;
    double mean; /* its luminance in the mean over that of white */
};

/* A mesh that was read. */
struct scene_model {
    const struct scene_mesh *mesh;
    size_t unplaced; /* triangles without places in a texture, of which nothing is said yet */
};

/* Arrays grow by doubling in the arena of the words; names are texts of the content. */
struct scene_reader {
    struct file_words words;
    struct scene *scene;
    const struct scene_files *files; /* null: none may be named */
    struct scene_units units;
    struct digest digest;
    struct name_table colours, materials, images, meshes, tables;
    struct scene_colour *spectra; /* of the colours */
    struct scene_loaded *loaded;  /* of the images */
    struct spectrum *tabled;      /* of the tables */
    struct scene_model *models;   /* of the meshes */
    size_t spectrum_room, material_room, thing_room, light_room, note_room, image_room, mesh_room,
        table_room;
    size_t triangles; /* of all meshes */
    bool has_camera, has_unit;
    /* the first clear sky that does not say where the sun stands, and its line; null: none */
    struct text sunless;
    struct file_words sunless_words;
};

/*
 * `at`, `normal` and `up`, or for a camera `look` and `up`, `turn`, `move`, `spin` and `axis`.
 *
 * Errors    ERROR_DATA: a direction without length, up along the normal or the view, an axis of
 *           what does not spin
 */
bool scene_place_read(const struct scene_line *line, struct scene_place *place,
                      struct error *error);
#define SCENE_MOTION_KEYS                                                                          \
    (SCENE_BIT(KEY_AT) | SCENE_BIT(KEY_UP) | SCENE_BIT(KEY_TURN) | SCENE_BIT(KEY_MOVE) |           \
     SCENE_BIT(KEY_SPIN) | SCENE_BIT(KEY_AXIS))

/* What a spectrum is of. */
enum scene_colour_use { COLOUR_OF_SURFACE, COLOUR_OF_LIGHT };

/* A line with a colour, behind its first word. */
bool scene_colour_read(struct scene_reader *reader, struct text head, struct error *error);

/*
 * The colour that is the value of a key: a grey, red, green and blue, #rrggbb, a name; of light
 * also what spectrum_named knows.
 *
 * Result    white where the key is not given
 */
bool scene_colour_of(const struct scene_reader *reader, const struct scene_line *line,
                     enum scene_key key, enum scene_colour_use use, struct spectrum *spectrum,
                     struct error *error);

/* Lines with a material, a thing of some shape, a light. */
bool scene_material_read(struct scene_reader *reader, struct text head, struct error *error);
bool scene_thing_read(struct scene_reader *reader, struct text head, struct error *error);
bool scene_light_read(struct scene_reader *reader, struct text head, struct error *error);

/* What begins a line with a thing: the first is 0, null behind the last. */
const char *scene_shape_word(size_t i);

/* Of a clear sky whose line does not say where the sun stands. */
bool scene_lights_finish(struct scene_reader *reader, struct error *error);

#endif
