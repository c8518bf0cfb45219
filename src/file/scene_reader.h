/* file/scene_reader.h - a scene while it is read: its words, what it names beside it, its parts. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_FILE_SCENE_READER_H
#define LENSCALC_FILE_SCENE_READER_H

#include "base/name_table.h"
#include "base/units.h"
#include "file/file_words.h"
#include "file/scene_file.h"
#include "scene/vector.h"
#include <stdint.h>

/* Every key that a line may have. */
enum scene_key {
    KEY_AT,
    KEY_LOOK,
    KEY_UP,
    KEY_NORMAL,
    KEY_TURN,
    KEY_MOVE,
    KEY_SPIN,
    KEY_AXIS,
    KEY_FOCUS,
    KEY_FROM,
    KEY_RADIUS,
    KEY_SIZE,
    KEY_REPEAT,
    KEY_SCALE,
    KEY_RGB,
    KEY_SRGB,
    KEY_SPECTRUM,
    KEY_TABLE,
    KEY_COLOUR,
    KEY_TEXTURE,
    KEY_ROUGHNESS,
    KEY_INDEX,
    KEY_EMISSION,
    KEY_LUMINANCE,
    KEY_MATERIAL,
    KEY_FILE,
    KEY_ILLUMINANCE,
    KEY_INTENSITY,
    KEY_POWER,
    KEY_MAGNITUDE,
    KEY_DIAMETER,
    KEY_TOWARDS,
    KEY_ELEVATION,
    KEY_AZIMUTH,
    SCENE_KEYS
};

#define SCENE_BIT(key) ((uint64_t)1 << (key))

/* What a bare number means. */
struct scene_units {
    struct unit length, speed;
};

struct scene_line {
    const struct file_words *words; /* of the line, for messages */
    struct text head;               /* its first words: "light sun" */
    uint64_t given;                 /* bits of the keys */
    struct text value[SCENE_KEYS];  /* without quotation marks */
    double number[SCENE_KEYS][3];   /* mm, mm/s, rad, rad/s, cd/m^2, lx, cd, lm */
    size_t count[SCENE_KEYS];       /* of numbers */
};

/*
 * Read the words up to the end of the line.
 *
 * Given     words    behind the line's first words
 *           head     those
 *           allowed  bits of the keys that may stand here
 *           needed   and of those that must
 * Errors    ERROR_DATA with line and column: no key, one twice, a value that is missing, too many
 *           numbers, no number, one beyond its range, a needed key that is missing
 */
struct scene_keys {
    uint64_t allowed, needed;
};
bool scene_line_read(struct file_words *words, const struct scene_units *units, struct text head,
                     struct scene_keys keys, struct scene_line *line);

static inline bool scene_line_has(const struct scene_line *line, enum scene_key key)
{
    return (line->given & SCENE_BIT(key)) != 0;
}

/* Three numbers; those of a key that is not given are 0. */
static inline struct vector scene_line_vector(const struct scene_line *line, enum scene_key key)
{
    return (struct vector){line->number[key][0], line->number[key][1], line->number[key][2]};
}

/*
 * The same as a direction, of length 1.
 *
 * Errors    ERROR_DATA: it has no length
 */
bool scene_line_direction(const struct scene_line *line, enum scene_key key, struct vector *way);

/* Report something wrong with the value of a key, or with the line if it is not given. */
#define scene_line_fail(line, key, ...)                                                            \
    file_words_fail((line)->words,                                                                 \
                    scene_line_has((line), (key)) ? (line)->value[key] : (line)->head,             \
                    __VA_ARGS__)

/* Of a word that is none of a list: the nearest is offered. */
bool scene_word_fail(const struct file_words *words, struct text word, const struct nearest *meant,
                     const char *what);

/* May this be the name of another one of a list? */
bool scene_name_check(const struct file_words *words, const struct name_table *index,
                      struct text name, const char *what);

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
bool scene_place_read(const struct scene_line *line, struct scene_place *place);
#define SCENE_MOTION_KEYS                                                                          \
    (SCENE_BIT(KEY_AT) | SCENE_BIT(KEY_UP) | SCENE_BIT(KEY_TURN) | SCENE_BIT(KEY_MOVE) |           \
     SCENE_BIT(KEY_SPIN) | SCENE_BIT(KEY_AXIS))

/* What a spectrum is of. */
enum scene_colour_use { COLOUR_OF_SURFACE, COLOUR_OF_LIGHT };

/* A line with a colour, behind its first word. */
bool scene_colour_read(struct scene_reader *reader, struct text head);

/*
 * The colour that is the value of a key: a grey, red, green and blue, #rrggbb, a name; of light
 * also what spectrum_named knows.
 *
 * Result    white where the key is not given
 */
bool scene_colour_of(const struct scene_reader *reader, const struct scene_line *line,
                     enum scene_key key, enum scene_colour_use use, struct spectrum *spectrum);

/* Lines with a material, a thing of some shape, a light. */
bool scene_material_read(struct scene_reader *reader, struct text head);
bool scene_thing_read(struct scene_reader *reader, struct text head);
bool scene_light_read(struct scene_reader *reader, struct text head);

/* What begins a line with a thing: the first is 0, null behind the last. */
const char *scene_shape_word(size_t i);

/* Of a clear sky whose line does not say where the sun stands. */
bool scene_lights_finish(struct scene_reader *reader);

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
                        enum scene_key key, enum scene_picture kind, struct scene_loaded *loaded);

/*
 * A spectrum out of a table whose first column is wavelength_nm, and the second its values; one
 * file is read once.
 *
 * Errors    ERROR_DATA: no such file, less than two rows, wavelengths that do not rise, values
 *           below 0
 */
bool scene_load_table(struct scene_reader *reader, const struct scene_line *line,
                      struct spectrum *spectrum);

/*
 * The mesh of file= in the size of scale=.
 *
 * Given     has_texture  its material has one: what has no place in it is noted
 * Errors    as obj_read; more triangles than may be
 */
bool scene_load_mesh(struct scene_reader *reader, const struct scene_line *line, bool has_texture,
                     const struct scene_mesh **mesh);

#endif
