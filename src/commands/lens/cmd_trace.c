/* commands/lens/cmd_trace.c - lenscalc trace: exact rays through a lens. */
/* SPDX-License-Identifier: MIT */
#include "commands/lens/trace_answer.h"
#include "commands/tables.h"
#include "optics/wavelength.h"

#include "base/constants.h"

#include <string.h>

static const struct word aims[] = {
    {"stop", "real rays that cross the stop there"},
    {"entrance", "through the paraxial entrance pupil"},
    {NULL, NULL},
};

static const struct word pattern_words[] = {
    {"few", "the chief ray, both edges of the pupil in the plane of the field, one beside it"},
    {"gauss",
     "Gauss points in r^2, equal arms: a quadrature over the whole pupil, not over a part of it"},
    {"hexapolar", "centre and rings of 6, 12, 18 ... rays, as in other programs"},
    {"square", "a grid"},
    {"fan", "along x and y"},
    {"sobol", "a scrambled low-discrepancy sequence"},
    {NULL, NULL},
};

#define INPUT struct trace_input

#define COORDINATE(member)                                                                         \
    MEASURE(member, length, "mm", "LENGTH"), .flags = OPTION_NO_INFINITY | OPTION_SETTING
#define COSINE(member) MEASURE(member, number, NULL, "NUMBER"), .flags = OPTION_NO_INFINITY

static const struct option options[] = {
    LENS_OPTION(INPUT, question),
    {MEASURE(wavelength, wavelength_um, "nm", "WAVE"), REPEATED("wavelength"), .letter = 'w',
     .lowest = WAVELENGTH_SHORTEST, .highest = WAVELENGTH_LONGEST,
     .help = "wavelength in nm, or a line: d F C e g; default the primary of the lens"},
    LENS_FNUMBER_OPTION(INPUT, question),
    {MEASURE(field, angle, "deg", "ANGLE"), REPEATED("field"), .lowest = -PI, .highest = PI,
     .flags = OPTION_GOAL | OPTION_FIELD | OPTION_ABOVE_LOWEST | OPTION_BELOW_HIGHEST,
     .help = "field angle in object space, a list is swept; default all fields of the lens"},
    {MEASURE(height, length, "mm", "LENGTH"), REPEATED("height"),
     .flags = OPTION_NO_INFINITY | OPTION_GOAL,
     .help = "field by the height of its paraxial image"},
    LENS_FIELD_X_OPTION(INPUT, field_x),
    {MEASURE(height_x, length, "mm", "LENGTH"), .name = "height-x", .column = "height_x",
     .flags = OPTION_NO_INFINITY, .help = "offset from the axis in x"},
    {ASKED(real), .name = "real", .wants = "height|height-x",
     .help = "the height is that of the real image: where the chief ray meets the image plane"},
    {MEASURE(pupil, number, NULL, "X:Y"), .name = "pupil-point",
     .help = "one ray of the field, through this point of the pupil of radius 1"},
    {MEASURE(pupil_at[0], number, NULL, "NUMBER"), .name = "pupil-x", .column = "pupil_x",
     .flags = OPTION_NO_INFINITY, .help = "the same as two numbers: x"},
    {MEASURE(pupil_at[1], number, NULL, "NUMBER"), .name = "pupil-y", .column = "pupil_y",
     .flags = OPTION_NO_INFINITY, .help = "its y"},
    {ASKED(pattern), .name = "pattern", .words = pattern_words, .fallback = "few",
     .value = "PATTERN", .help = "rays of each field"},
    {ASKED(rays), .name = "rays", .lowest = 1, .highest = 1e7, .fallback = "72", .value = "COUNT",
     .wants = "pattern!=few",
     .help = "approximate number of rays: the pattern takes the next number that it allows"},
    {ASKED(seed), .name = "seed", .lowest = 0, .highest = 1e9, .fallback = "0", .value = "NUMBER",
     .wants = "pattern=sobol", .help = "seed of the sobol pattern"},
    {ASKED(aim), .name = "aim", .words = aims, .fallback = "stop", .value = "WHERE",
     .excludes = "point direction x y z cos-x cos-y cos-z",
     .help = "pupil that the ray points lie in"},
    {MEASURE(point, length, "mm", "X:Y:Z"), .name = "point",
     .help = "one ray that starts here, z from the first vertex; in place of a field"},
    {MEASURE(direction, number, NULL, "X:Y:Z"), .name = "direction",
     .help = "direction of that ray, of any length; default 0:0:1"},
    {COORDINATE(at[0]), .name = "x", .column = "x",
     .help = "the starting point as three numbers: x"},
    {COORDINATE(at[1]), .name = "y", .column = "y", .help = "its y"},
    {COORDINATE(at[2]), .name = "z", .column = "z",
     .help = "its z coordinate, from the first vertex"},
    {COSINE(cosine[0]), .name = "cos-x", .column = "cos_x",
     .help = "the direction as three numbers: cosine with the x axis"},
    {COSINE(cosine[1]), .name = "cos-y", .column = "cos_y", .help = "cosine with the y axis"},
    {COSINE(cosine[2]), .name = "cos-z", .column = "cos_z", .help = "cosine with the z axis"},
    LENS_POSITION_OPTION(INPUT, question),
    {ASKED(question.to), .name = "to", .value = "WHERE",
     .help = "where rays end: image, last (surface), or the number of a surface; default image"},
    RAY_FOCUS_OPTION(INPUT, question),
    RAY_CLIP_OPTIONS(INPUT, question),
    {ASKED(all), .name = "all", .help = "a row for every surface, with the angles there"},
    {ASKED(paraxial), .name = "paraxial", .help = "add heights and slopes of the paraxial ray"},
    {ASKED(verify), .name = "verify",
     .help = "trace again in 80-bit arithmetic and print the error of the ray"},
};

#define ROW struct trace_row

#define MM(member, more)      LENGTH(member, "mm"), .flags = (more)
#define DEGREES(member, more) ANGLE(member), .flags = (more)
#define PLAIN(member, more)   SHOWN(member), .flags = (more)

static const struct column columns[] = {
    LENS_POSITION_COLUMN(ROW, position, COLUMN_BRIEF),
    {COLUMN_OF_WAVELENGTH(ROW, wavelength), .flags = COLUMN_ECHO, .with = "wavelength",
     .name = "wavelength", .help = "wavelength"},
    {DEGREES(field, COLUMN_ECHO | COLUMN_BRIEF | COLUMN_SPARSE), .with = "field", .name = "field",
     .help = "field angle; absent for a height and for a ray as given"},
    {MM(height, COLUMN_ECHO | COLUMN_BRIEF | COLUMN_SPARSE), .with = "height", .name = "height",
     .label = "field height",
     .help = "height of the field, at the object or at the image as the lens has it"},
    {DEGREES(field_x, COLUMN_ECHO | COLUMN_BRIEF | COLUMN_EXTRA), .with = "field-x",
     .name = "field_x", .label = "field x",
     .help = "its angle in the x-z plane; on request, and where some is not 0"},
    {MM(height_x, COLUMN_ECHO | COLUMN_BRIEF | COLUMN_EXTRA), .with = "height-x",
     .name = "height_x", .label = "field height x", .help = "of a height the same in x"},
    {PLAIN(ray, COLUMN_BRIEF | COLUMN_SPARSE), .name = "ray",
     .help = "chief, upper, lower or sagittal"},
    {PLAIN(pupil[0], COLUMN_ECHO | COLUMN_SPARSE), .with = "pupil-x", .name = "pupil_x",
     .tells = "pupil-point", .label = "pupil x",
     .help = "where the ray crosses the pupil, in units of its radius"},
    {PLAIN(pupil[1], COLUMN_ECHO | COLUMN_SPARSE), .with = "pupil-y", .name = "pupil_y",
     .label = "pupil y", .help = "the same upwards"},
    {PLAIN(weight, COLUMN_EXTRA), .with = "pattern", .name = "weight",
     .help = "of the ray in its pattern; over the whole pupil they add up to 1"},
    {MM(start[0], COLUMN_ECHO), .with = "x", .name = "x", .tells = "point",
     .help = "where the ray starts, from the first vertex"},
    {MM(start[1], COLUMN_ECHO | COLUMN_BRIEF), .with = "y", .name = "y", .help = "upwards"},
    {MM(start[2], COLUMN_ECHO), .with = "z", .name = "z", .help = "along the axis, with the light"},
    {PLAIN(start_cosine[0], COLUMN_ECHO), .with = "cos-x", .name = "cos_x", .tells = "direction",
     .label = "cos x", .symbol = "L", .help = "direction cosines at the start"},
    {PLAIN(start_cosine[1], COLUMN_ECHO), .with = "cos-y", .name = "cos_y", .label = "cos y",
     .symbol = "M", .help = "cosine with the y axis"},
    {PLAIN(start_cosine[2], COLUMN_ECHO), .with = "cos-z", .name = "cos_z", .label = "cos z",
     .symbol = "N", .help = "cosine with the z axis"},
    {MM(point[0], COLUMN_BRIEF), .name = "x_out", .label = "x out",
     .help = "where the ray ends, from the last vertex (--all and --to N: that of the surface); "
             "absent for a lost ray"},
    {MM(point[1], COLUMN_BRIEF), .name = "y_out", .label = "y out", .help = "upwards"},
    {MM(point[2], 0), .name = "z_out", .label = "z out", .help = "along the axis"},
    {PLAIN(cosine[0], COLUMN_BRIEF), .name = "cos_x_out", .label = "cos x out",
     .help = "direction cosines at the end"},
    {PLAIN(cosine[1], COLUMN_BRIEF), .name = "cos_y_out", .label = "cos y out",
     .help = "cosine with the y axis"},
    {PLAIN(cosine[2], 0), .name = "cos_z_out", .label = "cos z out",
     .help = "cosine with the z axis"},
    {MM(path, COLUMN_BRIEF), .name = "path", .symbol = "OPL", .label = "optical path",
     .help = "n times length: from the point where a ray as given starts; else from the wave "
             "front through the first vertex"},
    {DEGREES(incidence, COLUMN_EXTRA | COLUMN_BRIEF), .with = "all", .name = "incidence",
     .symbol = "I", .help = "angle of incidence, with the surface normal"},
    {DEGREES(refraction, COLUMN_EXTRA | COLUMN_BRIEF), .with = "all", .name = "refraction",
     .symbol = "I'", .help = "angle of refraction"},
    {MM(paraxial[0], COLUMN_EXTRA), .with = "paraxial", .name = "paraxial_x", .label = "paraxial x",
     .help = "where the paraxial ray is there"},
    {MM(paraxial[1], COLUMN_EXTRA | COLUMN_BRIEF), .with = "paraxial", .name = "paraxial_y",
     .label = "paraxial y", .help = "upwards"},
    {PLAIN(slope[0], COLUMN_EXTRA), .with = "paraxial", .name = "paraxial_slope_x",
     .label = "paraxial slope x", .help = "dx/dz of the paraxial ray behind the surface"},
    {PLAIN(slope[1], COLUMN_EXTRA | COLUMN_BRIEF), .with = "paraxial", .name = "paraxial_slope_y",
     .symbol = "u", .label = "paraxial slope y",
     .help = "dy/dz of the paraxial ray behind the surface"},
    {MM(point_error, COLUMN_EXTRA | COLUMN_BRIEF), .with = "verify", .name = "point_error",
     .label = "point error", .help = "distance from the point found with 80-bit arithmetic"},
    {PLAIN(cosine_error, COLUMN_EXTRA | COLUMN_BRIEF), .with = "verify", .name = "cosine_error",
     .label = "cosine error", .help = "the largest of the three direction cosines"},
    {MM(path_error, COLUMN_EXTRA | COLUMN_BRIEF), .with = "verify", .name = "path_error",
     .label = "path error", .help = "of the optical path"},
    {PLAIN(status, COLUMN_BRIEF), .name = "status",
     .help = "ok, miss, total_reflection, clipped or not_converged"},
    {PLAIN(surface, COLUMN_BRIEF | COLUMN_SPARSE), .name = "surface",
     .help = "where the ray was lost, from 1, the stop counted; with --all that of the row, the "
             "image plane last"},
    {PLAIN(focus, COLUMN_EXTRA | COLUMN_ASSUMED), .depends = "focus lens", .name = "focus",
     .help = "how the image plane was found"},
    {MM(image, COLUMN_EXTRA | COLUMN_ASSUMED), .depends = "focus lens position", .name = "image",
     .label = "image plane at", .help = "from the last vertex"},
    LENS_TITLE_COLUMN(ROW, lens),
    LENS_WARNING_COLUMN(ROW, warning),
};

enum { FEW_RAYS = 4 };

static bool trace_makes_many(const void *data)
{
    const struct trace_input *input = data;
    const struct lens *lens = input->question.lens.lens;
    bool field = trace_has_field(input) || (lens != NULL && lens->field_count <= 1);
    bool one = trace_is_explicit(input) || (trace_has_pupil(input) && field);
    return !one || input->all ||
           lens_positions_several(input->question.lens.lens, input->question.position);
}

/* The rays of all its fields, each with a row a surface where all are shown. */
static double trace_weight(const void *data)
{
    const struct trace_input *input = data;
    const struct lens *lens = input->question.lens.lens;
    if (lens == NULL || !trace_makes_many(data)) {
        return 1;
    }
    double rays = input->pattern == TRACE_FEW ? FEW_RAYS : (double)input->rays;
    if (trace_is_explicit(input) || trace_has_pupil(input)) {
        rays = 1;
    }
    const size_t fields = trace_has_field(input) || lens->field_count < 1 ? 1 : lens->field_count;
    return rays * (double)fields * (input->all ? (double)lens->surface_count : 1);
}

static bool trace_brings(const void *data, const char *option)
{
    const struct trace_input *input = data;
    return !trace_has_field(input) && !trace_is_explicit(input) &&
           lens_brings(input->question.lens.lens, option);
}

static bool trace_varies(const void *data, const char *option)
{
    const struct ray_question *question = &((const struct trace_input *)data)->question;
    return strcmp(option, "position") == 0 &&
           lens_positions_several(question->lens.lens, question->position);
}

/* Rays by point and direction, all through the lens of the command line. */
static bool takes_blocks(const void *data, const struct option_query *asking)
{
    static const char *const constant[] = {"lens", "position", "paraxial", "verify", "all"};
    static const char *const single[] = {"field",       "field-x", "height",  "height-x", "real",
                                         "pupil-point", "pupil-x", "pupil-y", "pattern"};
    const struct trace_input *input = data;
    bool ray = asking_given(asking, "x") && asking_given(asking, "y") && asking_given(asking, "z");
    bool takes = input->question.lens.lens != NULL && ray && !input->all &&
                 !lens_positions_several(input->question.lens.lens, input->question.position);
    for (size_t i = 0; i < sizeof constant / sizeof constant[0]; i++) {
        takes = takes && !asking_in_rows(asking, constant[i]);
    }
    for (size_t i = 0; i < sizeof single / sizeof single[0]; i++) {
        takes = takes && !asking_given(asking, single[i]);
    }
    return takes;
}

static const struct explanation explanations[] = {
    {"x_out", "n' p' = n p + (n' cos I' - n cos I) N at every surface: p direction, N normal",
     "Snell's law in vectors, [Welford86]", "light meets the surfaces in their order"},
    {"path", "{OPL} = sum of n times length", "[Welford86]", NULL},
    {"incidence", "tan {I} = |N x p|/|N . p|: normal N, direction p", NULL, NULL},
    {"paraxial_y", "v' = v - y (n' - n)/R, y' = y + t v'/n', {u} = v/n", "[Smith05]",
     "small angles and heights; decentred parts count as centred"},
    {NULL, NULL, NULL, NULL},
};

static const struct example examples[] = {
    {"trace double-gauss", "four rays of each field of the lens"},
    {"trace double-gauss --point 0:10:-20 --all",
     "one ray along the axis, 10 mm above it, at every surface"},
    {"trace double-gauss --point 0:2:-20 --direction 0:0.24192:0.97030 --no-clip --paraxial",
     "the same at 14 deg, with the paraxial ray"},
    {"trace double-gauss --field 0,7deg,14deg --pattern gauss --rays 18 --csv",
     "a small spot of rays for three fields"},
    {NULL, NULL},
};

const struct command command_trace = {
    .name = "trace",
    .group = "a lens",
    .summary = "exact rays through a lens: one, a bundle, or a file of them",
    COMMAND_ASKS(INPUT),
    .sheet = SHEET(columns, ROW),
    .explanations = explanations,
    .run = trace_answer,
    .run_block = trace_block,
    .takes_blocks = takes_blocks,
    .makes_many = trace_makes_many,
    .varies = trace_varies,
    .brings = trace_brings,
    .plot = "y_out",
    .plot_titles = "Ray height",
    .weight = trace_weight,
};
