/* file/scene_words.h - one line of a .scene file: key=value words, each read as its kind. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_FILE_SCENE_WORDS_H
#define LENSCALC_FILE_SCENE_WORDS_H

#include "base/name_table.h"
#include "base/units.h"
#include "file/file_words.h"
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
                     struct scene_keys keys, struct scene_line *line, struct error *error);

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
bool scene_line_direction(const struct scene_line *line, enum scene_key key, struct vector *way,
                          struct error *error);

/* Report something wrong with the value of a key, or with the line if it is not given. */
bool scene_line_fail(const struct scene_line *line, enum scene_key key, struct error *error,
                     const char *format, ...) __attribute__((format(printf, 4, 5)));

/* Of a word that is none of a list: the nearest is offered. */
bool scene_word_fail(const struct file_words *words, struct text word, const struct nearest *meant,
                     const char *what, struct error *error);

/* May this be the name of another one of a list? */
bool scene_name_check(const struct file_words *words, const struct name_table *index,
                      struct text name, const char *what, struct error *error);

#endif
