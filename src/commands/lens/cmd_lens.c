/* commands/lens/cmd_lens.c - lenscalc lens: first-order data of a lens. */
/* SPDX-License-Identifier: MIT */
#include "commands/lens/lens_options.h"
#include "commands/tables.h"

struct lens_input {
    struct lens_question question;
};

static const struct lens_policy policy = {.wavelengths = WAVELENGTHS_ALL,
                                          .fields = FIELDS_LARGEST,
                                          .telecentric = true,
                                          .is_narrow = true};

#define INPUT struct lens_input

static const struct option options[] = {
    LENS_OPTION(INPUT, question),
    LENS_WAVELENGTH_OPTION(INPUT, question, LENS_ALL_WAVELENGTHS),
    LENS_FNUMBER_OPTION(INPUT, question),
    LENS_FIELD_OPTIONS(INPUT, question),
    LENS_POSITION_OPTION(INPUT, question),
    LENS_SECTION_OPTION(INPUT, question),
};

struct lens_command_row {
    double wavelength; /* um */
    const char *position, *warning, *lens, *places;
    double track;
    struct first_order first;
};

#define ROW struct lens_command_row

#define PLACE(member_name, more)  LENGTH(member_name, "mm"), .flags = (more)
#define NUMBER(member_name, more) SHOWN(member_name), .flags = (more)

static const struct column columns[] = {
    LENS_WAVELENGTH_COLUMN(ROW, wavelength),
    LENS_POSITION_COLUMN(ROW, position, COLUMN_BRIEF),
    {MEASURED(first.power, vergence, "per_m"), .name = "power", .symbol = "P",
     .help = "power, from before the first to "
             "behind the last surface"},
    {PLACE(first.efl, COLUMN_BRIEF | COLUMN_INFINITE), .name = "efl", .symbol = "f",
     .label = "focal length", .help = "effective focal length, 1/power in any media"},
    {PLACE(first.bfl, COLUMN_BRIEF | COLUMN_INFINITE), .name = "bfl", .symbol = "F'",
     .label = "back focus F'", .help = "rear focal point, from the last vertex"},
    {PLACE(first.ffl, COLUMN_BRIEF | COLUMN_INFINITE), .name = "ffl", .symbol = "F",
     .label = "front focus F", .help = "front focal point, from the first vertex"},
    {PLACE(first.front_focal, COLUMN_INFINITE), .name = "front_focal",
     .label = "front focal length, H to F", .help = "front focal length, H to F: -n/power"},
    {PLACE(first.rear_focal, COLUMN_INFINITE), .name = "rear_focal",
     .label = "rear focal length, H' to F'", .help = "rear focal length, H' to F': n'/power"},
    {PLACE(first.front_principal, COLUMN_BRIEF | COLUMN_INFINITE), .name = "front_principal",
     .symbol = "H", .label = "principal point H",
     .help = "front principal point, from the first vertex"},
    {PLACE(first.rear_principal, COLUMN_BRIEF | COLUMN_INFINITE), .name = "rear_principal",
     .symbol = "H'", .label = "principal point H'",
     .help = "rear principal point, from the last vertex"},
    {PLACE(first.front_nodal, COLUMN_INFINITE), .name = "front_nodal", .label = "nodal point N",
     .help = "front nodal point, from the first vertex"},
    {PLACE(first.rear_nodal, COLUMN_INFINITE), .name = "rear_nodal", .label = "nodal point N'",
     .help = "rear nodal point, from the last vertex"},
    {PLACE(first.entrance_pupil, COLUMN_BRIEF | COLUMN_INFINITE), .name = "entrance_pupil",
     .label = "entrance pupil",
     .help = "entrance pupil, from the first vertex; absent without a "
             "stop"},
    {PLACE(first.entrance_diameter, COLUMN_INFINITE), .name = "entrance_pupil_diameter",
     .symbol = "D", .label = "entrance pupil, diameter", .help = "diameter of the entrance pupil"},
    {PLACE(first.exit_pupil, COLUMN_BRIEF | COLUMN_INFINITE), .name = "exit_pupil",
     .label = "exit pupil", .help = "exit pupil, from the last vertex"},
    {PLACE(first.exit_diameter, COLUMN_INFINITE), .name = "exit_pupil_diameter",
     .label = "exit pupil, diameter", .help = "diameter of the exit pupil"},
    {NUMBER(first.pupil_magnification, COLUMN_INFINITE), .name = "pupil_magnification",
     .label = "pupil magnification",
     .help = "exit over entrance pupil, negative where one is "
             "upside down"},
    {NUMBER(first.fnumber, COLUMN_BRIEF | COLUMN_INFINITE), .name = "fnumber", .symbol = "N",
     .label = "f-number", .help = "rear focal length over the diameter of the entrance pupil"},
    {NUMBER(first.working_fnumber, COLUMN_INFINITE), .name = "working_fnumber",
     .label = "working f-number", .help = "1/(2 n' |u'|) of the paraxial marginal ray"},
    {NUMBER(first.na_image, 0), .name = "na_image", .label = "aperture of the image",
     .help = "numerical aperture n' sin u' of the paraxial marginal ray"},
    {NUMBER(first.magnification, COLUMN_INFINITE), .name = "magnification", .symbol = "m",
     .help = "n u/(n' u'); 0 for an object at infinity"},
    {PLACE(first.lagrange, COLUMN_WITH), .name = "lagrange", .with = "field",
     .label = "Lagrange invariant", .help = "n (y ubar - ybar u) at the largest field"},
    {NUMBER(first.angular_magnification, COLUMN_SPARSE), .name = "angular_magnification",
     .label = "angular magnification",
     .help = "u'/u of an afocal system, a telescope; absent for others"},
    {PLACE(first.petzval_radius, COLUMN_INFINITE), .name = "petzval_radius",
     .label = "Petzval radius", .help = "radius of the Petzval surface at the image"},
    {PLACE(track, COLUMN_INFINITE), .name = "track", .help = "first vertex to the image plane"},
    LENS_TITLE_COLUMN(ROW, lens),
    {SHOWN(places), .name = "places_from", .flags = COLUMN_EXTRA | COLUMN_ASSUMED,
     .label = "places from", .help = "where places on the axis are measured from"},
    LENS_WARNING_COLUMN(ROW, warning),
};

static bool lens_run(const void *data, struct run *run, struct error *error)
{
    struct lens_cursor at =
        lens_begin(&((const struct lens_input *)data)->question, &policy, run->arena);
    const struct lens_case *one = &at.one;
    while (lens_next(&at, error)) {
        struct lens_command_row row = {
            .wavelength = one->light.wavelength,
            .position = one->setup->position,
            .lens = one->setup->lens->title,
            .places =
                "the first vertex (F, H, N, entrance pupil) or the last (F', H', N', exit pupil)",
            .warning = one->warning,
            .first = one->light.first,
            .track = one->light.first.length +
                     setup_paraxial_image(one->setup->lens, &one->light.first).hi,
        };
        if (!run_emit(run, &row)) {
            return true;
        }
    }
    return error->code == ERROR_NONE;
}

static bool lens_command_makes_many(const void *data)
{
    return lens_makes_many(&((const struct lens_input *)data)->question, &policy);
}

static const struct explanation explanations[] = {
    {"efl", "f = 1/{P}", "[Smith05]; (y, v) matrices, P = -c", "paraxial"},
    {"fnumber", "N = |n' {f}|/{D}", "[Smith05]",
     "paraxial; an aplanatic lens obeys "
     "1/(2 n' sin u')"},
    {NULL, NULL, NULL, NULL},
};

static const struct example examples[] = {
    {"lens double-gauss", "cardinal points and pupils, at each of its wavelengths"},
    {"lens double-gauss -w d", "one wavelength"},
    {"lens double-gauss -N 4 --field 14deg --json", "stopped down, for a script"},
    {"lens canon-nfd-70-210 --position all", "a zoom in all its positions"},
    {"lens double-gauss wide-35 telephoto-200 -w d", "several lenses side by side"},
    {"lens double-gauss -w 400..700:50 --columns wavelength_nm,bfl_mm", "chromatic focal shift"},
    {NULL, NULL},
};

const struct command command_lens = {
    .name = "lens",
    .stop_size_wants = "",
    COMMAND_OF("a lens", "first-order data: focal length, cardinal points, pupils"),
    .run = lens_run,
    .makes_many = lens_command_makes_many,
    .plot = "bfl_mm|entrance_pupil_diameter_mm|na_image",
    .plot_titles = "Back focal distance|Entrance pupil diameter|Image-side numerical aperture",
    .cell = "efl_mm",
};
