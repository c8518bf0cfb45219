/* file/lens_setting.h - what the positions of a .lens file set anew: the lines with `set`. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_FILE_LENS_SETTING_H
#define LENSCALC_FILE_LENS_SETTING_H

#include "file/lens_file.h"
#include "file/lens_words.h"

/*
 * Read what follows the word `set`: R3 50 52, glass2 N-BK7 N-SF5, stop 3 4, wavelength d,F,C e,
 * field 0;5 0;7.
 *
 * Given     words  the line; the lens has all its surfaces and positions
 * Errors    ERROR_DATA with line and column: no such surface or number, one value too few or many,
 *           a first value that is not that of the surface's own line, and what a cell would refuse
 */
bool lens_setting_read(struct file_words *words, const struct glass_source *glasses,
                       struct lens *lens);

/* All kinds but the index and the Abbe number, for which the medium is set as a whole. */
bool lens_setting_takes(enum parameter_kind kind);

/* What a line with `set` may set anew. */
enum set_what { SET_FIGURES, SET_MEDIA, SET_STOPS, SET_LIGHTS, SET_POINTS };

/* Is it one of the words that stand for no number of a surface: stop, wavelength, field? */
bool lens_setting_is_word(struct text name, enum set_what *what);

/* One value a position, of that kind. */
struct set_values {
    struct figure *figures;
    struct medium *media;
    size_t *stops;
    struct lens_light *lights;
    struct lens_points *points;
};

/* Room for them. */
struct set_values lens_setting_values(size_t positions, struct arena *arena);

/*
 * Put them into the lens.
 *
 * Given     parameter  of figures and media
 * Result    null, or in words why the lens cannot have them
 */
const char *lens_setting_put(struct lens *lens, enum set_what what, struct parameter parameter,
                             const struct set_values *values, struct arena *arena);

/* The wavelengths of a position as one word, "d,F:0.5,656.3nm", and back. */
bool lens_light_read(const struct file_words *words, struct text list, struct lens_light *light);
const char *lens_light_write(const struct lens_light *light, struct arena *arena);

/* A medium of a catalogue gets its glass; false with the reason at the word. */
bool lens_words_glass(const struct file_words *words, const struct glass_source *glasses,
                      struct medium *medium);

#endif
