/* commands/lens/conjugate_ideal.h - what conjugate asks and answers, of thin lenses and mirrors. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_COMMANDS_LENS_CONJUGATE_IDEAL_H
#define LENSCALC_COMMANDS_LENS_CONJUGATE_IDEAL_H

#include "commands/lens/ideal_lens.h"
#include "commands/lens/lens_options.h"
#include "optics/conjugates.h"

struct svg;

enum { FOCUS_BY_NOTHING, FOCUS_BY_LENS };

enum { FROM_LENS = CONJUGATE_FROMS };

struct conjugate_input {
    struct lens_question question;
    struct ideal_question ideal;
    double object, image, magnification; /* at most one, two where a focal length is wanted */
    double height, image_height, near_point;
    bool steps;
    int from, focus_by;
    const char *gap;
    struct glass_value object_medium, image_medium;
};

struct conjugate_row {
    double wavelength; /* um */
    const char *position, *from, *focus_by, *gaps, *lens, *warning;
    const char *object_kind, *image_kind, *orientation;
    double object, image, movement, efl;
    double working_fnumber, na_object, na_image;
    struct conjugate_points all;
    double object_height, image_height; /* NaN = not asked for */
    const char *step, *mirror, *signs;  /* null of real lenses, as the figures below */
    double focal, power, radius, magnifier, near_point;
};

#define OBJECT_HEIGHT_COLUMN                                                                       \
    ENTRY(LENGTH(object_height, "mm"), .name = "object_height", ECHO_WITH("height image-height"),  \
          .repeats = "height", .symbol = "h", .label = "object height",                            \
          .help = "height of the object")
#define IMAGE_HEIGHT_COLUMN                                                                        \
    ENTRY(LENGTH(image_height, "mm"), .name = "image_height",                                      \
          BRIEF_WITH("height image-height") | COLUMN_INFINITE, .symbol = "h'",                     \
          .label = "image height", .help = "height of the image; negative upside down")

/* The rows of thin lenses and mirrors. */
extern const struct sheet conjugate_ideal_sheet;

/* The word of an origin of distances, by enum conjugate_from and FROM_LENS. */
extern const struct word conjugate_froms[];

/*
 * Make the thin lenses or the mirror that a question names no lens beside.
 *
 * Given     asked  receives the question with that lens; of two distances that gave its focal
 *                  length only the one that says where the object is
 * Errors    ERROR_USAGE: options that such lenses have not; as ideal_lens_make
 */
bool conjugate_make_ideal(const struct conjugate_input *input, struct conjugate_input *asked,
                          struct arena *arena, struct error *error);

/*
 * What is said of thin lenses and mirrors alone, with images where the light goes.
 *
 * Given     lens  the row's: all of it, or one of its lenses, by the name `step`
 */
void conjugate_fill_ideal(const struct conjugate_input *input, const struct lens *lens,
                          const char *step, struct conjugate_row *row);

/*
 * Draw how their rays make the image of an object.
 *
 * Given     system  the lenses of `input`, compiled
 *           object  distance in front of the first, mm
 * Errors    more lenses than a drawing shows; as ray_diagram_draw
 */
bool conjugate_diagram(const struct conjugate_input *input, const struct paraxial_system *system,
                       double object, struct svg *svg, struct error *error);

#endif
