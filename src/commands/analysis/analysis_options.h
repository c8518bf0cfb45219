/* commands/analysis/analysis_options.h - the options that analyses share, and what they ask for. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_COMMANDS_ANALYSIS_ANALYSIS_OPTIONS_H
#define LENSCALC_COMMANDS_ANALYSIS_ANALYSIS_OPTIONS_H

#include "analysis/pupil/bundle.h"
#include "base/parallel.h"
#include "commands/lens/lens_options.h"

/* What the options say. */
struct analysis_question {
    struct lens_value lens;
    const char *position;
    struct wavelength_value wavelength;
    struct spectrum_value spectrum;
    double fnumber;          /* NaN = that of the lens */
    long threads;            /* 0 = one per core */
    double field, field_x;   /* rad; NaN = not given */
    double height, height_x; /* mm at the image; NaN = not given */
    bool real;               /* the heights are those of the real image */
    int section;             /* enum lens_section: LENS_SECTION_OPTION */
    struct plane_value focus;
    double object;  /* before the first vertex, mm; NaN = that of the lens */
    double defocus; /* mm; NaN = none */
    /* how the pupil is filled: ANALYSIS_PUPIL_OPTIONS */
    int aim, weight, pattern;
    long rays, seed; /* rays: NO_INTEGER = as many as the error wants */
    double error;    /* relative */
    bool clip, no_clip;
    struct sensor_value format; /* that --over-field maps; sides NaN: that of the fields */
};

/* What a row says of its place. */
struct analysis_point {
    const char *position, *spectrum, *focus, *lens, *warning;
    double wavelength;       /* um; NaN: several at once */
    double field, field_x;   /* rad; NaN: a height */
    double height, height_x; /* mm; NaN: an angle */
    double image, defocus;   /* mm; NaN: no image plane, no defocus */
};

/* Inputs of analyses begin with their question, and their rows with their point. */
struct analysis_input {
    struct analysis_question question;
};

/* What a command takes of a lens where the options ask for nothing else. */
struct analysis_policy {
    enum wavelength_policy wavelengths;
    enum field_policy fields;
    bool one_wavelength; /* answers are those of one: a spectrum is refused */
    bool no_image;       /* no image plane is needed */
    bool is_narrow;      /* as of the command: how wide the stop is does not count */
};

enum { ANALYSIS_AIM_STOP, ANALYSIS_AIM_ENTRANCE };
enum { ANALYSIS_WEIGHT_PUPIL, ANALYSIS_WEIGHT_BEAM };

extern const struct word analysis_aims[], analysis_weights[];

#define ANALYSIS_LENGTH(S, member)                                                                 \
    OPTION(S, member), .dimension = &dimension_length, .unit = "mm", .value = "LENGTH"

#define ANALYSIS_OBJECT_OPTION                                                                     \
    ENTRY(ANALYSIS_LENGTH(struct analysis_question, object), .name = "object", .column = "object", \
          .flags = OPTION_ABOVE_LOWEST, .lowest = 0, .highest = INFINITY,                          \
          .help =                                                                                  \
              "distance of the object in front of the first vertex, in place of the lens's own")

/* `wavelengths`: which a command takes without -w; `parts`: ", or ..." that threads share */
#define ANALYSIS_OPTIONS(wavelengths, parts) ANALYSIS_OPTIONS_FOR(wavelengths, parts, NULL)
/* `plane_use`: what the image plane needs, as `wants` of an option has it */
#define ANALYSIS_OPTIONS_FOR(wavelengths, parts, plane_use)                                        \
    LENS_OPTION(struct analysis_input, question),                                                  \
        LENS_WAVELENGTH_OPTION(struct analysis_input, question, wavelengths),                      \
        LENS_FNUMBER_OPTION(struct analysis_input, question),                                      \
        LENS_POSITION_OPTION(struct analysis_input, question),                                     \
        ANALYSIS_PLANE_OPTIONS_FOR(struct analysis_input, question, plane_use),                    \
        ANALYSIS_OBJECT_OPTION,                                                                    \
        ENTRY(OPTION(struct analysis_question, threads), .name = "threads", .lowest = 0,           \
              .highest = PARALLEL_MOST, .value = "N", .fallback = "1", .flags = OPTION_ASIDE,      \
              .help = "threads that share the combinations of a sweep" parts "; 0 = one per core")

/* Where the image is caught. */
#define ANALYSIS_PLANE_OPTIONS(S, member) ANALYSIS_PLANE_OPTIONS_FOR(S, member, NULL)
#define ANALYSIS_PLANE_OPTIONS_FOR(S, member, use)                                                 \
    ENTRY(OPTION(S, member.focus), .wants = (use), .name = "focus",                                \
          .dimension = &dimension_length, .unit = "mm", .value = "PLANE",                          \
          .help = "the image plane: paraxial, table, best, or mm from the last vertex; default "   \
                  "that of the lens"),                                                             \
        ENTRY(ANALYSIS_LENGTH(S, member.defocus), .name = "defocus", .column = "defocus",          \
              .wants = (use), .flags = OPTION_NO_INFINITY,                                         \
              .help = "defocus behind that plane; a list steps through focus")

/* Of commands that ask field by field; and of those that ask for the edge of the field alone. */
#define ANALYSIS_FIELD_OPTIONS                                                                     \
    ANALYSIS_FIELDS_BY("default all fields of the lens", NULL), ANALYSIS_REAL
#define ANALYSIS_EDGE_OPTIONS(use)                                                                 \
    ANALYSIS_FIELDS_BY("default the largest of the lens; without one 5 deg", use)
#define ANALYSIS_FIELDS_BY(without, use)                                                           \
    ENTRY(OPTION(struct analysis_question, field), .name = "field", .wants = (use),                \
          .column = "field", .dimension = &dimension_angle, .unit = "deg", .lowest = -PI,          \
          .highest = PI, .flags = OPTION_FIELD | OPTION_ABOVE_LOWEST | OPTION_BELOW_HIGHEST,       \
          .value = "ANGLE", .help = "field angle in object space, a list is swept; " without),     \
        LENS_FIELD_X_OPTION_FOR(struct analysis_question, field_x, use),                           \
        ENTRY(ANALYSIS_LENGTH(struct analysis_question, height), .name = "height",                 \
              .column = "height", .wants = (use), .flags = OPTION_NO_INFINITY,                     \
              .help = "field by the height of its paraxial image"),                                \
        ENTRY(ANALYSIS_LENGTH(struct analysis_question, height_x), .name = "height-x",             \
              .column = "height_x", .wants = (use), .flags = OPTION_NO_INFINITY,                   \
              .help = "offset from the axis in x")
/* Of heights in the image of real rays. */
#define ANALYSIS_REAL                                                                              \
    ENTRY(OPTION(struct analysis_question, real), .name = "real", .wants = "height|height-x",      \
          .help = "the height is that of the real image: where the chief "                         \
                  "ray meets the image plane")

/* Of commands that take several wavelengths at once. */
#define ANALYSIS_SPECTRUM_OPTION(S, member)                                                        \
    ENTRY(OPTION(S, member.spectrum), .name = "spectrum", .dimension = &dimension_wavelength_um,   \
          .unit = "nm", .value = "WAVES", .excludes = "wavelength",                                \
          .help = "several wavelengths at once, each with a weight: "                              \
                  "d:1,F:0.5; or photopic: 450 to 650 nm as the eye "                              \
                  "sees them")

/* Which pupil: `use` is what it needs, `what` its help. */
#define ANALYSIS_AIM_OPTION(use, what)                                                             \
    ENTRY(OPTION(struct analysis_question, aim), .name = "aim", .words = analysis_aims,            \
          .fallback = "stop", .value = "WHERE", .wants = (use), .help = what)

/* How the pupil is filled with rays. */
#define ANALYSIS_PUPIL_OPTIONS                                                                     \
    ANALYSIS_AIM_OPTION(NULL, "pupil that the ray points lie in"),                                 \
        ENTRY(OPTION(struct analysis_question, weight), .name = "weight",                          \
              .words = analysis_weights, .fallback = "pupil", .value = "WHAT",                     \
              .help = "areas by which rays are weighted"),                                         \
        ENTRY(OPTION(struct analysis_question, pattern), .name = "pattern", .words = patterns,     \
              .fallback = "gauss", .value = "PATTERN", .help = "sampling pattern of the pupil"),   \
        ENTRY(OPTION(struct analysis_question, rays), .name = "rays", .column = "rays_wanted",     \
              .lowest = 1, .highest = 1e7, .value = "COUNT",                                       \
              .help =                                                                              \
                  "approximate number of rays per wavelength; default: as many as --error needs"), \
        ENTRY(OPTION(struct analysis_question, seed), .name = "seed", .lowest = 0, .highest = 1e9, \
              .fallback = "0", .value = "NUMBER", .wants = "pattern=sobol",                        \
              .help = "seed of the sobol pattern"),                                                \
        ENTRY(OPTION(struct analysis_question, error), .name = "error", .column = "error_wanted",  \
              .dimension = &dimension_number, .lowest = 1e-13, .highest = 1, .fallback = "1e-4",   \
              .value = "NUMBER", .excludes = "rays",                                               \
              .help = "rays are doubled until the relative error is below this"),                  \
        ANALYSIS_CLIP_OPTIONS

#define ANALYSIS_CLIP_OPTIONS ANALYSIS_CLIP_OPTIONS_FOR(NULL)
#define ANALYSIS_CLIP_OPTIONS_FOR(use)                                                             \
    ENTRY(OPTION(struct analysis_question, clip), .name = "clip", .wants = (use),                  \
          .help = "clip rays at apertures and stop (default)"),                                    \
        ENTRY(OPTION(struct analysis_question, no_clip), .name = "no-clip", .wants = (use),        \
              .excludes = "clip", .help = "do not clip rays at clear apertures")

/* Of commands with --over-field. */
#define ANALYSIS_OVER_FIELD_OPTIONS                                                                \
    ENTRY(OPTION(struct analysis_question, format), .name = "sensor", .wants = "over-field",       \
          .value = "NAME|WxH",                                                                     \
          .help = "format that --over-field maps, by name or size: 36x24mm; default: out to the "  \
                  "largest field")

/* What rows begin with: position and field. */
#define ANALYSIS_POINT_COLUMNS                                                                     \
    LENS_POSITION_COLUMN(struct analysis_point, position, COLUMN_BRIEF),                           \
        ENTRY(COLUMN_OF_ANGLE(struct analysis_point, field, "deg"), .name = "field",               \
              .flags = COLUMN_ECHO | COLUMN_BRIEF | COLUMN_SPARSE, .with = "field",                \
              .help = "field angle; absent for a height"),                                         \
        ENTRY(COLUMN_OF_LENGTH(struct analysis_point, height, "mm"), .name = "height",             \
              .flags = COLUMN_ECHO | COLUMN_BRIEF | COLUMN_SPARSE, .with = "height",               \
              .label = "field height",                                                             \
              .help = "height of the field, at the object or at the image as the lens has it"),    \
        ENTRY(COLUMN_OF_ANGLE(struct analysis_point, field_x, "deg"), .name = "field_x",           \
              .flags = COLUMN_ECHO | COLUMN_BRIEF | COLUMN_EXTRA, .with = "field-x",               \
              .label = "field x",                                                                  \
              .help = "its angle in the x-z plane; on request, and where some is not 0"),          \
        ENTRY(COLUMN_OF_LENGTH(struct analysis_point, height_x, "mm"), .name = "height_x",         \
              .flags = COLUMN_ECHO | COLUMN_BRIEF | COLUMN_EXTRA, .with = "height-x",              \
              .label = "field height x", .help = "of a height the same in x")

/* Then, where several are possible. */
#define ANALYSIS_WAVELENGTH_COLUMN                                                                 \
    ENTRY(COLUMN_OF_WAVELENGTH(struct analysis_point, wavelength), .name = "wavelength",           \
          .flags = COLUMN_ECHO | COLUMN_BRIEF | COLUMN_SPARSE, .with = "wavelength",               \
          .help = "wavelength; absent where several count at once")

#define ANALYSIS_DEFOCUS_COLUMN                                                                    \
    ENTRY(COLUMN_OF_LENGTH(struct analysis_point, defocus, "mm"), .name = "defocus",               \
          .flags = COLUMN_ECHO | COLUMN_BRIEF | COLUMN_EXTRA, .with = "defocus",                   \
          .help = "defocus: shift of the image plane away from the lens")

#define ANALYSIS_ROW_COLUMNS                                                                       \
    ANALYSIS_POINT_COLUMNS, ANALYSIS_DEFOCUS_COLUMN, ANALYSIS_WAVELENGTH_COLUMN

/* And end with: what is assumed, and what is doubtful. */
#define ANALYSIS_SPECTRUM_COLUMN                                                                   \
    ENTRY(COLUMN(struct analysis_point, spectrum), .name = "spectrum",                             \
          .when = "where several wavelengths count", .flags = COLUMN_ASSUMED | COLUMN_SPARSE,      \
          .depends = "lens spectrum", .label = "wavelengths",                                      \
          .help = "wavelengths that count, nm, each with its weight")

#define ANALYSIS_TAIL_COLUMNS                                                                      \
    ENTRY(COLUMN(struct analysis_point, focus), .name = "focus", .flags = COLUMN_ASSUMED,          \
          .depends = "focus lens", .help = "how the image plane was found"),                       \
        ENTRY(COLUMN_OF_LENGTH(struct analysis_point, image, "mm"), .name = "image",               \
              .flags = COLUMN_EXTRA | COLUMN_ASSUMED,                                              \
              .depends = "focus lens position defocus object aperture", .label = "image plane at", \
              .help = "from the last vertex"),                                                     \
        LENS_TITLE_COLUMN(struct analysis_point, lens),                                            \
        LENS_WARNING_COLUMN(struct analysis_point, warning)

/* Is a field or a height given, in either coordinate? NaN = not given. */
bool analysis_is_given(double first, double second);

/* What the rays count by, in words. */
const char *analysis_weight_words(const struct analysis_question *question);

/* Doubt an f-number where only chief rays and what is next to them are asked. */
void analysis_doubt_aperture(const struct analysis_question *question, struct warnings *doubts);

/* Does the question have several rows? */
bool analysis_makes_many(const struct analysis_question *question, enum field_policy fields);

/*
 * For struct command, whose inputs begin with their struct analysis_question. analysis_several: for
 * makes_many, where a field makes one row.
 */
#define ANALYSIS_COMMAND                                                                           \
    .group = "analyses", .brings = analysis_brings, .threads = analysis_threads,                   \
    .varies = analysis_varies
bool analysis_several(const void *input);
bool analysis_brings(const void *input, const char *option);
bool analysis_varies(const void *input, const char *option);
int analysis_threads(const void *input);

/* And for `weight`: by the rays that are asked for. */
double analysis_weight(const void *input);

#endif
