/* commands/lens/lens_options.h - options that lens commands share, and the cases they ask for. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_COMMANDS_LENS_LENS_OPTIONS_H
#define LENSCALC_COMMANDS_LENS_LENS_OPTIONS_H

#include "analysis/setup/setup.h"
#include "base/constants.h"
#include "cli/question/command.h"
#include "exchange/lens_formats.h"
#include "trace/pupil/pupil_islands.h"

#include <math.h>

/* What the options of a lens command say. */
struct lens_question {
    struct lens_value lens;
    struct wavelength_value wavelength;
    double fnumber;             /* NaN = not given */
    double field, field_x;      /* rad; NaN = not given */
    struct fields_value fields; /* of a command that takes a set of them */
    const char *position;
    int section;
};

/* What a command takes of a lens where the options ask for nothing else. */
struct lens_policy {
    enum wavelength_policy wavelengths;
    enum field_policy fields;
    bool telecentric;                /* it has answers for a telecentric object space */
    const struct plane_value *focus; /* what --focus says; null: no image plane is needed */
    bool is_narrow;                  /* as of the command: how wide the stop is does not count */
};

/* One lens in one position at one wavelength. */
struct lens_case {
    const struct setup *setup;
    size_t index; /* of the wavelength in the setup */
    struct setup_light light;
    const char *warning; /* null = all is well */
};

extern const struct word section_words[];

/* The last operand: all words that are left are lenses. */
#define LENS_OPTION(S, member)                                                                     \
    ENTRY(OPTION(S, member.lens), .name = "lens", .letter = 'l', .value = "LENS",                  \
          .column = "lens_name", .flags = OPTION_OPERAND | OPTION_FILE | OPTION_MANY,              \
          .types = lens_types,                                                                     \
          .help = "a lens of lensdb (list lenses), a file, or - for "                              \
                  "standard input")

/* `without`: which wavelengths a command takes without the option */
#define LENS_WAVELENGTH_OPTION(S, member, without)                                                 \
    ENTRY(OPTION(S, member.wavelength), .name = "wavelength", .letter = 'w',                       \
          .column = "wavelength", .value = "WAVE", .dimension = &dimension_wavelength_um,          \
          .unit = "nm", .help = "wavelength in nm, or a line: d F C e g; default " without)
#define LENS_ALL_WAVELENGTHS    "all of the lens, the primary first"
#define LENS_PRIMARY_WAVELENGTH "the primary one of the lens"

/* Diameters from the beams: a margin, which may be left out. */
#define LENS_DIAMETERS_OPTION                                                                      \
    .dimension = &dimension_ratio, .unit = "%", .name = "set-diameters", .lowest = 0,              \
    .highest = 1, .bare = "2", .value = "[MARGIN]",                                                \
    .help = "set diameters to those of the beams of all fields, wavelengths and positions and "    \
            "this margin; default 2 %"

#define LENS_FNUMBER_OPTION(S, member)                                                             \
    ENTRY(OPTION(S, member.fnumber), .name = "aperture", .quantity = "f-number", .letter = 'N',    \
          .column = "fnumber", .dimension = &dimension_fnumber, .lowest = 0, .highest = INFINITY,  \
          .flags = OPTION_ABOVE_LOWEST | OPTION_NO_INFINITY, .value = "NUMBER",                    \
          .help = "f-number in place of the lens's own aperture", OPTION_USUAL_FNUMBER)

#define LENS_FIELD_OPTIONS(S, member)                                                              \
    ENTRY(OPTION(S, member.field), .name = "field", .column = "field",                             \
          .dimension = &dimension_angle, .unit = "deg", .lowest = -1.5706217938696971,             \
          .highest = 1.5706217938696971, .flags = OPTION_FIELD, .value = "ANGLE",                  \
          .help =                                                                                  \
              "field angle in object space; default the largest of the lens; a list is swept"),    \
        LENS_FIELD_X_OPTION(S, member.field_x)

/* Beside --field, which is then the angle in the y-z plane. */
#define LENS_FIELD_X_OPTION(S, member) LENS_FIELD_X_OPTION_FOR(S, member, NULL)
#define LENS_FIELD_X_OPTION_FOR(S, member, use)                                                    \
    ENTRY(OPTION(S, member), .name = "field-x", .column = "field_x",                               \
          .dimension = &dimension_angle, .unit = "deg", .lowest = -PI, .highest = PI,              \
          .flags = OPTION_FIELD | OPTION_ABOVE_LOWEST | OPTION_BELOW_HIGHEST, .value = "ANGLE",    \
          .wants = (use),                                                                          \
          .help = "field angle in the x-z plane; light travels along (tan x, tan y, 1)")

/* Of a command that judges a lens by all fields at once. */
#define LENS_FIELDS_OPTION(S, member)                                                              \
    ENTRY(OPTION(S, member.fields), .name = "field", .value = "ANGLES",                            \
          .help = "one set of fields, each optionally weighted: "                                  \
                  "0,10:2,14deg; for an object nearby heights in mm; "                             \
                  "otherwise those of the lens")

#define LENS_POSITION_OPTION(S, member)                                                            \
    ENTRY(OPTION(S, member.position), .name = "position", .value = "NAME",                         \
          .help = "a name or focal length (135mm), a list, or all; default the first")

#define LENS_SECTION_OPTION(S, member)                                                             \
    ENTRY(OPTION(S, member.section), .name = "section", .words = section_words, .fallback = "y",   \
          .value = "SECTION", .help = "section of a lens with cylinders")

/* What the rows of lens commands say of their case. */
#define LENS_WAVELENGTH_COLUMN(S, member)                                                          \
    ENTRY(COLUMN_OF_WAVELENGTH(S, member), .name = "wavelength",                                   \
          .flags = COLUMN_ECHO | COLUMN_BRIEF, .help = "wavelength; the primary one first")

#define LENS_POSITION_COLUMN(S, member, more)                                                      \
    ENTRY(COLUMN(S, member), .name = "position", .when = "where a lens has several positions",     \
          .flags = COLUMN_SPARSE | (more),                                                         \
          .help = "zoom or focus position; absent where there is only one")

#define LENS_WARNING_COLUMN(S, member)                                                             \
    ENTRY(COLUMN(S, member), .name = "warning", .flags = COLUMN_NOTE,                              \
          .help = "what is doubtful about the lens; absent if nothing is")

#define LENS_TITLE_COLUMN(S, member)                                                               \
    ENTRY(COLUMN(S, member), .name = "lens", .flags = COLUMN_EXTRA | COLUMN_ASSUMED,               \
          .depends = "lens", .help = "title of the lens")

/* Of rows that a sweep over f-numbers or seeds tells apart. */
#define LENS_FNUMBER_COLUMN(S, member)                                                             \
    ENTRY(COLUMN(S, member), .name = "fnumber", .dimension = &dimension_fnumber,                   \
          .flags = COLUMN_ECHO | COLUMN_EXTRA, .with = "aperture", .label = "f-number",            \
          .help = "f-number in place of the lens's own aperture")
#define LENS_SEED_COLUMN(S, member, words)                                                         \
    ENTRY(COLUMN(S, member), .name = "seed", .label = "seed", .flags = COLUMN_ECHO | COLUMN_EXTRA, \
          .with = "seed", .help = (words))

/* Two warnings as one; null = nothing to say. */
const char *lens_warnings_join(const char *first, const char *second, struct arena *arena);

/* That there is light which the figures leave out; null = there is none. */
const char *lens_island_warning(const struct pupil_islands *islands, struct arena *arena);

/* Will the question have several answers? */
bool lens_makes_many(const struct lens_question *question, const struct lens_policy *policy);

/*
 * A field as options have it.
 *
 * Given     x, y     NaN = not given; y alone lies on the axis of the section
 */
struct setup_field lens_field(enum field_kind kind, double x, double y, int section);

/*
 * The set of fields that --field names, LENS_FIELDS_OPTION: bare numbers are degrees of a far
 * object, mm of a near one.
 *
 * Given     list  receives question->fields.count
 * Errors    ERROR_USAGE: a height where the object is far
 */
bool lens_fields_asked(const struct lens_question *question, size_t position,
                       struct setup_field *list, struct error *error);

/* A field in words, for messages: "field 14 deg". */
const char *lens_field_words(const struct field_point *field, struct arena *arena);

/*
 * The position of a name, or of a focal length with a unit ("135mm"): the nearest to it by ratio.
 * A lens says nothing of what is between its positions.
 *
 * Given     position  receives its place in the lens's list
 * Errors    ERROR_USAGE: no such position, or a focal length more than 5 % beyond the ends of the
 *           zoom, with the positions there are
 */
bool lens_position_named(const struct lens *lens, struct text name, struct arena *arena,
                         size_t *position, struct error *error);

/*
 * The positions that --position names.
 *
 * Given     names      null = the first; "all"; or a list with commas, of what lens_position_named
 *                      takes
 *           positions  receives an array in the arena, of `count`
 * Errors    ERROR_USAGE: no lens; no such position, with a suggestion
 */
bool lens_positions(const struct lens *lens, const char *names, struct arena *arena,
                    const size_t **positions, size_t *count, struct error *error);

/* Do fields of the lens bring the columns of --field-x or --height-x? */
bool lens_brings(const struct lens *lens, const char *option);

/* Does --position name several? */
bool lens_positions_several(const struct lens *lens, const char *names);

/*
 * Goes through the cases of a question: positions, and within each the wavelengths, primary first.
 *
 *     struct lens_cursor at = lens_begin(&input->question, &policy, run->arena);
 *     while (lens_next(&at, error)) {
 *         ... at.one ...
 *     }
 *     return error->code == ERROR_NONE;
 */
struct lens_cursor {
    const struct lens_question *question;
    const struct lens_policy *policy;
    struct arena *arena;  /* of all that the cases point to */
    struct lens_case one; /* where it is */
    const size_t *positions;
    size_t position_count, next_position;
};

/* Before the first case. */
struct lens_cursor lens_begin(const struct lens_question *question,
                              const struct lens_policy *policy, struct arena *arena);

/*
 * On to the next case; or to the next position, whatever its wavelengths: then `one` has no light.
 *
 * Result    false: that was the last one, and error->code is ERROR_NONE; else it failed
 * Errors    ERROR_USAGE: no lens, an unknown position; as setup_open and setup_light
 */
bool lens_next(struct lens_cursor *at, struct error *error);
bool lens_next_setup(struct lens_cursor *at, struct error *error);

/*
 * Find the image plane that --focus asks for.
 *
 * Errors    as setup_place_image, with the option's name
 */
bool lens_place_image(struct setup *setup, const struct plane_value *focus, struct error *error);

#endif
