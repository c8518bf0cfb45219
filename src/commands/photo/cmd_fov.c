/* cli/cmd_fov.c - lenscalc fov: field of view. */
/* SPDX-License-Identifier: MIT */
#include "commands/photo/photo_lens.h"
#include "photo/fov.h"

#include <math.h>
#include <string.h>

struct input {
    double focal, distance, pupil, squeeze, wavelength;
    struct photo_lens_question lens;
    struct sensor_value sensor;
    int projection;
    double horizontal, vertical, diagonal;            /* wanted angles, rad */
    double field_width, field_height, field_diagonal; /* wanted fields, mm */
};

#define ANGLE_GOAL(member_name)                                                                    \
    OPTION(struct input, member_name), .name = #member_name, .column = #member_name,               \
                                       .dimension = &dimension_angle, .unit = "deg", .lowest = 0,  \
                                       .highest = 6.283185307179586, .value = "ANGLE",             \
                                       .flags = OPTION_ABOVE_LOWEST | OPTION_GOAL
#define FIELD_GOAL(member_name)                                                                    \
    OPTION(struct input, member_name),                                                             \
        .dimension = &dimension_length, .unit = "m", OPTION_POSITIVE, .value = "LENGTH",           \
        .flags = OPTION_ABOVE_LOWEST | OPTION_NO_INFINITY | OPTION_GOAL

static const struct option options[] = {
    OPTION_FOCAL_LENGTH(struct input, focal, OPTION_SETTING),
    PHOTO_LENS_OPTIONS(struct input, lens),
    OPTION_WAVELENGTH_OF_LENS(struct input, wavelength),
    OPTION_SENSOR(struct input, sensor),
    {OPTION(struct input, distance), .name = "distance", .letter = 's', .column = "distance",
     .dimension = &dimension_length, .unit = "m", OPTION_POSITIVE, .flags = OPTION_ABOVE_LOWEST,
     .fallback = "inf", .value = "LENGTH",
     .help = "distance the lens is focused at; the field there is reported"},
    {OPTION(struct input, projection), .name = "projection", .column = "projection",
     .words = projections, .fallback = "rectilinear", .value = "KIND",
     .help = "how the lens maps angles"},
    OPTION_PUPIL_OF_LENS(struct input, pupil),
    {OPTION(struct input, squeeze), .name = "squeeze", .column = "squeeze",
     .dimension = &dimension_ratio, OPTION_POSITIVE,
     .flags = OPTION_ABOVE_LOWEST | OPTION_NO_INFINITY, .fallback = "1", .value = "FACTOR",
     .help = "anamorphic squeeze: 2 doubles the width that is seen"},
    {ANGLE_GOAL(horizontal), .help = "wanted horizontal angle: solves for the focal length"},
    {ANGLE_GOAL(vertical), .help = "wanted vertical angle"},
    {ANGLE_GOAL(diagonal), .help = "wanted diagonal angle"},
    {FIELD_GOAL(field_width), .name = "field-width", .column = "field_width",
     .help = "wanted width of the field at --distance: solves for the focal length"},
    {FIELD_GOAL(field_height), .name = "field-height", .column = "field_height",
     .help = "wanted height of the field"},
    {FIELD_GOAL(field_diagonal), .name = "field-diagonal", .column = "field_diagonal",
     .help = "wanted diagonal of the field"},
};

struct row {
    struct fov_setting setting;
    struct fov fov;
    double magnification, width, height, crop, image, sensor_distance;
    struct photo_real real;
    const char *sensor, *projection;
};

#define LENGTH(member_name, in_unit)                                                               \
    COLUMN(struct row, member_name), .dimension = &dimension_length, .unit = in_unit
#define ANGLE(member_name)                                                                         \
    COLUMN(struct row, member_name), .dimension = &dimension_angle, .unit = "deg"

static const struct column columns[] = {
    PHOTO_LENS_COLUMNS(struct row, real),
    PHOTO_LENS_WAVELENGTH_COLUMN(struct row, real),
    COLUMN_FOCAL(struct row, setting.f, COLUMN_BRIEF),
    {LENGTH(setting.s, "m"), .name = "distance", .flags = COLUMN_ECHO | COLUMN_INFINITE,
     .with = "distance", .symbol = "s", .label = "focused at",
     .help = "distance the lens is focused at, from the front principal plane"},
    {ANGLE(fov.horizontal), .name = "horizontal", .flags = COLUMN_BRIEF, .symbol = "hfov",
     .label = "horizontal angle", .help = "full horizontal angle of view"},
    {ANGLE(fov.vertical), .name = "vertical", .flags = COLUMN_BRIEF, .symbol = "vfov",
     .label = "vertical angle", .help = "full vertical angle of view"},
    {ANGLE(fov.diagonal), .name = "diagonal", .flags = COLUMN_BRIEF, .symbol = "dfov",
     .label = "diagonal angle", .help = "full diagonal angle of view"},
    {LENGTH(fov.width_at_s, "m"), .name = "field_width", .flags = COLUMN_INFINITE,
     .with = "distance", .symbol = "W", .label = "field width",
     .help = "width seen in the plane of focus"},
    {LENGTH(fov.height_at_s, "m"), .name = "field_height", .flags = COLUMN_INFINITE,
     .with = "distance", .label = "field height", .help = "height seen in the plane of focus"},
    {LENGTH(fov.diagonal_at_s, "m"), .name = "field_diagonal", .flags = COLUMN_INFINITE,
     .with = "distance", .label = "field diagonal", .help = "diagonal seen in the plane of focus"},
    COLUMN_MAGNIFICATION(struct row, magnification, 0),
    {COLUMN(struct row, fov.kind), .name = "class", .flags = COLUMN_BRIEF, .label = "kind of lens",
     .help = "narrow, medium, normal, wide or ultra-wide, by the diagonal angle"},
    {LENGTH(width, "mm"), .name = "sensor_width", .flags = COLUMN_HIDDEN, .symbol = "w",
     .label = "sensor width", .help = "width of the sensor"},
    {LENGTH(height, "mm"), .name = "sensor_height", .flags = COLUMN_HIDDEN, .symbol = "h",
     .label = "sensor height", .help = "height of the sensor"},
    {COLUMN(struct row, crop), .name = "crop_factor", .label = "crop factor",
     .help = "43.27 mm over the sensor's diagonal"},
    {LENGTH(sensor_distance, "m"), .name = "distance_sensor",
     .flags = COLUMN_EXTRA | COLUMN_INFINITE, .with = "lens", .symbol = "Ds",
     .label = "distance from the sensor",
     .help = "distance the lens is focused at, from the sensor"},
    {LENGTH(image, "mm"), .name = "image", .flags = COLUMN_EXTRA | COLUMN_INFINITE, .symbol = "v",
     .label = "image distance", .help = "sensor from the rear principal plane"},
    PHOTO_LENS_HIATUS_COLUMN(struct row, real.hiatus),
    COLUMN_SENSOR(struct row, sensor),
    {COLUMN(struct row, projection), .name = "projection", .flags = COLUMN_ASSUMED | COLUMN_EXTRA,
     .depends = "projection", .label = "projection", .help = "how the lens maps angles"},
    COLUMN_PUPIL(struct row, setting.P),
    {COLUMN(struct row, setting.squeeze), .name = "squeeze", .symbol = "q",
     .flags = COLUMN_ASSUMED | COLUMN_EXTRA | COLUMN_ECHO, .depends = "squeeze", .label = "squeeze",
     .help = "anamorphic squeeze"},
    PHOTO_LENS_WARNING_COLUMN(struct row, real),
};

/* The focal length from the one goal that is given. */
static bool solve(const struct input *input, const struct fov_setting *setting, double *f,
                  struct error *error)
{
    const struct fov_goals goals = {input->horizontal,  input->vertical,     input->diagonal,
                                    input->field_width, input->field_height, input->field_diagonal};
    return fov_solve(setting, &input->sensor.size, &goals, f, error);
}

/* A fisheye maps angles in another way than most lenses. */
static const char *warn(const struct input *input, const struct photo_lens *lens,
                        struct arena *arena)
{
    const struct photo_real *real = lens->real;
    if (input->projection != RECTILINEAR || real->kind == NULL ||
        strstr(real->kind, "fisheye") == NULL) {
        return real->warning;
    }
    return arena_printf(arena, "%s%sthe lens is a fisheye: give its --projection",
                        real->warning != NULL ? real->warning : "",
                        real->warning != NULL ? "; " : "");
}

static bool answer(const void *data, const struct photo_lens *lens, struct run *run,
                   struct error *error)
{
    const struct input *input = data;
    struct row row = {
        .setting = {(enum projection)input->projection, lens->f, input->distance, lens->P,
                    input->squeeze},
        .width = input->sensor.size.width,
        .height = input->sensor.size.height,
        .sensor = input->sensor.name,
        .projection = projections[input->projection].word,
        .real = *lens->real,
    };
    if (!photo_lens_check_subject(lens, input->distance, error) ||
        !solve(input, &row.setting, &row.setting.f, error) ||
        !fov_compute(&row.setting, &input->sensor.size, &row.fov, error)) {
        return false;
    }
    row.real.warning = warn(input, lens, run->arena);
    row.magnification = row.setting.f / (row.setting.s - row.setting.f);
    row.crop = sensor_crop(&input->sensor.size);
    row.image = distance_image(row.setting.f, row.setting.s);
    row.sensor_distance = row.setting.s + row.image + lens->measuring.hiatus;
    run_emit(run, &row);
    return true;
}

static bool run(const void *data, struct run *run, struct error *error)
{
    const struct input *input = data;
    const struct photo_given given = {
        .f = input->focal, .N = NAN, .P = input->pupil, .wavelength = input->wavelength};
    return photo_lens_each(&input->lens, given, run, answer, input, error);
}

static const struct explanation explanations[] = {
    {"horizontal", "hfov = 2 atan({q} {w}/(2 {f} (1 + {m}/{P})))",
     "[Ray02]; rectilinear, breathing included",
     "the other projections: f t, 2 f sin(t/2), 2 f tan(t/2), f sin t in place of f tan t"},
    {"vertical", "vfov = 2 atan({h}/(2 {f} (1 + {m}/{P})))", "[Ray02]; rectilinear", NULL},
    {"magnification", "m = {f}/({s} - {f})", "thin lens 1/f = 1/s + 1/v", NULL},
    {"distance_sensor", "Ds = {s} + {v} + {HH'}",
     "[Gauss41] HH' from the front to the rear principal plane", NULL},
    {"field_width", "W = {q} {w}/{m}", "similar triangles", "rectilinear only"},
    {NULL, NULL, NULL, NULL},
};

static const struct example examples[] = {
    {"fov -f 24mm --sensor aps-c", "a lens on a crop sensor"},
    {"fov -f 14,20,24,28,35,50,85,135,200", "the classes of lenses on 35 mm film"},
    {"fov -f 100mm -s 40cm", "how much is in the picture close up"},
    {"fov --horizontal 90deg", "the focal length for an angle"},
    {"fov -f 8mm --projection equisolid --sensor mft", "a fisheye"},
    {"fov --lens double-gauss -s 0.5m", "a real lens, close up"},
    {"fov -f 50mm --squeeze 2 --sensor scope", "anamorphic cinema"},
    {NULL, NULL},
};

const struct command command_fov = {
    .name = "fov",
    .group = "photography",
    .summary = "field of view, and the focal length for a wanted one",
    COMMAND_ASKS(struct input),
    COMMAND_ANSWERS(struct row),
    .lens = offsetof(struct input, lens),
    .plot = "horizontal_deg,vertical_deg,diagonal_deg",
    .cell = "horizontal_deg",
};
