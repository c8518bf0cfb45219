/* commands/photo/cmd_tilt.c - lenscalc tilt: tilted lenses and the wedge of sharpness. */
/* SPDX-License-Identifier: MIT */
#include "base/arena.h"
#include "base/constants.h"
#include "cli/question/command.h"
#include "commands/photo/sharpness.h"
#include "commands/tables.h"
#include "draw/wedge.h"
#include "photo/tilt.h"

#include <math.h>

struct tilt_input {
    struct focal_value focal;
    double fnumber;
    double tilt, hinge;
    double image, distance, angle;
    const char *through; /* two points */
    struct sharpness sharp;
    double sight;
    double rise, shift, circle;
    double depth;
};

#define INPUT struct tilt_input

static const struct option options[] = {
    OPTION_FOCAL_LENGTH(focal, OPTION_OF_CAMERA),
    OPTION_APERTURE(fnumber, 0),
    {MEASURE(tilt, angle, "deg", "ANGLE"), REPEATED("tilt"),
     .flags = OPTION_NO_INFINITY | OPTION_SETTING,
     .help =
         "tilt of the lens relative to the sensor, -90 to 90 deg; positive turns its top forward"},
    {MEASURE(hinge, length, "m", "LENGTH"), REPEATED("hinge"),
     .flags = OPTION_NO_INFINITY | OPTION_GOAL,
     .help = "wanted depth of the hinge line below the lens: solves for the tilt"},
    {MEASURE(image, length, "mm", "LENGTH"), REPEATED("image"), .quantity = "image distance",
     ABOVE_0 | OPTION_SETTING, .help = "distance from lens to sensor, along the sensor's normal"},
    {MEASURE(distance, length, "m", "LENGTH"), REPEATED("distance"), .letter = 's',
     ABOVE_0_OR_INFINITE | OPTION_GOAL,
     .help = "distance of the sharp point straight ahead, along the sensor's normal"},
    {MEASURE(angle, angle, "deg", "ANGLE"), REPEATED("angle"),
     .quantity = "angle of the plane of focus", .flags = OPTION_NO_INFINITY | OPTION_GOAL,
     .help = "angle of the plane of sharp focus to the sensor: 90deg for level ground"},
    {ASKED(through), .name = "through", .value = "POINT,POINT",
     .help = "two points that must be sharp, as distance:height: 2m:-1.5m,30m:0m, inf:5deg"},
    SHARPNESS_OPTIONS(sharp, 0, "d/1500", coc_is_pixels),
    {MEASURE(sight, angle, "deg", "ANGLE"), REPEATED("sight"), .flags = OPTION_NO_INFINITY,
     .fallback = "0",
     .help = "near, sharp and far points along a line of sight at this angle above the sensor's "
             "normal"},
    {MEASURE(rise, length, "mm", "LENGTH"), .name = "rise", .flags = OPTION_NO_INFINITY,
     .fallback = "0", .help = "rise of the lens above the centre of the sensor"},
    {MEASURE(shift, length, "mm", "LENGTH"), .name = "shift", .flags = OPTION_NO_INFINITY,
     .fallback = "0", .help = "sideways shift of the lens"},
    {MEASURE(circle, length, "mm", "LENGTH"), .name = "circle", .quantity = "image circle", ABOVE_0,
     .help = "image circle of the lens at infinity: is it large enough?"},
    {MEASURE(depth, length, "m", "LENGTH"), .name = "depth", ABOVE_0, .wants = "wedge",
     .help = "how far the drawing reaches; default: chosen to fit"},
};

struct tilt_row {
    struct tilt camera;
    struct tilt_reach reach;
    double sight, height, rise, shift;
    double coverage, needed, circle, rise_limit, shift_limit;
    const char *covers, *sensor, *criterion;
};

#define ROW struct tilt_row

static const struct column columns[] = {
    COLUMN_FOCAL(camera.f, 0),
    COLUMN_FNUMBER(camera.N, COLUMN_SPARSE),
    {ANGLE(camera.tilt), .name = "tilt", BRIEF, .symbol = "a",
     .help = "of the lens against the sensor"},
    {LENGTH(camera.hinge, "m"), .name = "hinge", BRIEF | COLUMN_INFINITE, .symbol = "J",
     .label = "hinge line below the lens",
     .help = "where all planes of focus meet as the lens is focused; negative above the lens"},
    {LENGTH(camera.image, "mm"), .name = "image", .symbol = "v", .label = "image distance",
     .help = "lens to sensor along the sensor's normal"},
    {LENGTH(camera.scheimpflug, "m"), .name = "scheimpflug", .flags = COLUMN_INFINITE,
     .symbol = "S", .label = "Scheimpflug line below the lens",
     .help = "where lens, sensor and plane of focus meet, in the sensor's plane"},
    {ANGLE(camera.angle), .name = "angle", BRIEF, .symbol = "psi",
     .label = "angle of the plane of focus", .help = "its angle against the sensor"},
    {ANGLE(camera.near_angle), .name = "near_angle", BRIEF | COLUMN_SPARSE, .symbol = "psin",
     .label = "near limit, plane", .help = "angle of the near limit against the sensor"},
    {ANGLE(camera.far_angle), .name = "far_angle", BRIEF | COLUMN_SPARSE, .symbol = "psif",
     .label = "far limit, plane", .help = "angle of the far limit against the sensor"},
    {SHOWN(camera.half_height), .name = "half_height", .flags = COLUMN_INFINITE | COLUMN_SPARSE,
     .symbol = "q", .label = "half height of the wedge per distance",
     .help = "near limit above, far limit below the plane of focus, over the distance"},
    {LENGTH(camera.hyperfocal, "m"), .name = "hyperfocal", .flags = COLUMN_INFINITE | COLUMN_SPARSE,
     .symbol = "H", .label = "hyperfocal distance, without + f",
     .help = "f^2/(N c): where the half height is about that of the lens above the hinge"},
    {LENGTH(camera.distance, "m"), .name = "distance", BRIEF | COLUMN_INFINITE, .symbol = "u",
     .label = "distance straight ahead", .help = "distance of the sharp point straight ahead"},
    {ANGLE(sight), .name = "sight", ECHO_WITH("sight"), .symbol = "b", .label = "line of sight",
     .help = "above the sensor's normal"},
    {LENGTH(height, "mm"), .name = "image_height", BRIEF_WITH("sight"),
     .label = "image height above the middle",
     .help = "where that line of sight meets the sensor, above the lens axis"},
    {LENGTH(reach.near, "m"), .name = "near", BRIEF | COLUMN_INFINITE | COLUMN_SPARSE,
     .symbol = "n", .label = "near limit", .help = "nearest sharp distance on the line of sight"},
    {LENGTH(reach.sharp, "m"), .name = "sharp", WITH("sight") | COLUMN_INFINITE,
     .help = "distance of the plane of focus on that line"},
    {LENGTH(reach.far, "m"), .name = "far", BRIEF | COLUMN_INFINITE | COLUMN_SPARSE, .symbol = "r",
     .label = "far limit", .help = "farthest sharp distance on the line of sight"},
    {LENGTH(reach.front, "m"), .name = "front", .flags = COLUMN_INFINITE | COLUMN_HIDDEN,
     .label = "in front of the plane", .help = "sharp before the plane of focus"},
    {LENGTH(reach.behind, "m"), .name = "behind", .flags = COLUMN_INFINITE | COLUMN_HIDDEN,
     .label = "behind the plane", .help = "sharp behind the plane of focus"},
    {LENGTH(needed, "mm"), .name = "needed_circle", .flags = COLUMN_INFINITE, .symbol = "D",
     .label = "image circle needed", .help = "diameter at infinity that holds all corners"},
    {ANGLE(coverage), .name = "coverage", .flags = COLUMN_HIDDEN, .symbol = "w",
     .label = "coverage needed", .help = "half angle from the lens axis to the worst corner"},
    {SHOWN(covers), .name = "covers", WITH("circle"), .label = "the circle covers the frame",
     .help = "is --circle large enough"},
    {LENGTH(rise_limit, "mm"), .name = "rise_limit", WITH("circle"),
     .label = "largest rise or fall", .help = "how far the untilted lens may be raised or lowered"},
    {LENGTH(shift_limit, "mm"), .name = "shift_limit", WITH("circle"), .label = "largest shift",
     .help = "how far the untilted lens may be moved sideways"},
    COLUMN_SENSOR(sensor),
    COLUMN_COC(camera.c, 0, ""),
    COLUMN_CRITERION(criterion),
};

/* -------- two points that shall be sharp -------- */

/* "2m:-1.5m", "inf:5deg": distance along the sensor's normal, and height or elevation. */
static bool tilt_read_point(struct text text, struct tilt_point *point, struct error *error)
{
    struct text height = text, distance = text_cut(&height, ':');
    const struct unit *metre = unit_find(&dimension_length, text_of("m")), *typed;
    struct error ignored;
    double value;
    if (height.start == NULL) {
        return fail(error, ERROR_USAGE, "bad point in {--through} '%.*s': write distance:height",
                    text_shown(text), text.start);
    }
    if (!quantity_read(distance, &dimension_length, metre, &point->distance, NULL, error)) {
        return error_prefix(error, "bad point in {--through}: ");
    }
    if (quantity_read(height, &dimension_angle, NULL, &value, &typed, &ignored) && typed != NULL) {
        point->rise = tan(value);
        return true;
    }
    if (!quantity_read(height, &dimension_length, metre, &value, NULL, error)) {
        return error_prefix(error, "bad point in {--through}: ");
    }
    if (isinf(point->distance) && fabs(value) > 0) {
        return fail(error, ERROR_USAGE,
                    "a point of {--through} at infinity has an elevation: inf:5deg, or inf:0");
    }
    point->rise = value / point->distance;
    return true;
}

static bool solve_through(const struct tilt_input *input, struct tilt_given *given,
                          struct error *error)
{
    struct text second = text_of(input->through), first = text_cut(&second, ',');
    struct tilt_point a, b;
    if (!isnan(given->tilt) || !isnan(given->hinge) || !isnan(given->image) ||
        !isnan(given->distance) || !isnan(given->angle)) {
        return fail(error, ERROR_USAGE,
                    "{--through} says it all: no {--tilt}, {--hinge}, {--image}, "
                    "{--distance} or {--angle} with it");
    }
    if (second.start == NULL) {
        return fail(error, ERROR_USAGE, "{--through} needs two points: 2m:-1.5m,30m:0m");
    }
    return tilt_read_point(first, &a, error) && tilt_read_point(second, &b, error) &&
           tilt_through(given->f, &a, &b, &given->tilt, &given->image, error);
}

/* Tilt, hinge and plane of focus need no f-number; the limits of sharpness do. */
static bool tilt_solve_without_limits(struct tilt_given *given, bool is_through,
                                      const struct tilt_input *input, struct tilt *camera,
                                      struct error *error)
{
    given->N = 1;
    given->c = 0;
    if ((is_through && !solve_through(input, given, error)) || !tilt_solve(given, camera, error)) {
        return false;
    }
    camera->N = camera->c = camera->near_angle = camera->far_angle = camera->half_height = NAN;
    camera->hyperfocal = camera->A_near = camera->A_far = NAN;
    return true;
}

static bool tilt_row_solve(const struct tilt_input *input, struct tilt *camera, struct error *error)
{
    struct tilt_given given = {
        .f = input->focal.length,
        .N = input->fnumber,
        .tilt = input->tilt,
        .hinge = input->hinge,
        .image = input->image,
        .distance = input->distance,
        .angle = input->angle,
    };
    if (isnan(given.f)) {
        return fail(error, ERROR_USAGE, "{--focal-length} is missing");
    }
    if (isnan(given.N)) {
        return tilt_solve_without_limits(&given, input->through != NULL, input, camera, error);
    }
    if (!sharpness_resolve(&input->sharp, input->fnumber, &given.c, error) ||
        (input->through != NULL && !solve_through(input, &given, error)) ||
        !tilt_solve(&given, camera, error)) {
        return false;
    }
    if (!sharpness_is_airy(&input->sharp)) {
        return true;
    }
    /* the image distance does not depend on what counts as sharp */
    double working = diffracting_fnumber(input->fnumber, camera->image / camera->f - 1, 1);
    return sharpness_resolve(&input->sharp, working, &given.c, error) &&
           tilt_solve(&given, camera, error);
}

/* Who says nothing of the plane of focus has it level. */
static void tilt_take_level(struct tilt_input *own, struct warnings *doubts)
{
    const bool is_open = isnan(own->image) && isnan(own->distance) && isnan(own->angle);
    const double size = isnan(own->tilt) ? own->hinge : own->tilt;
    if (is_open && own->through == NULL && fabs(size) > 0) {
        own->angle = copysign(PI / 2, size);
        warnings_add(doubts, "no --angle, --distance or --image: the plane of focus is taken "
                             "level, --angle 90deg, the sensor upright");
    }
}

static bool tilt_run(const void *data, struct run *run, struct error *error)
{
    struct tilt_input own = *(const struct tilt_input *)data;
    const struct tilt_input *input = &own;
    if (!sharpness_settle(&own.sharp, PITCH_FOR_COC, run->doubts, error)) {
        return false;
    }
    struct tilt_row row = {
        .sight = input->sight,
        .sensor = input->sharp.sensor.name,
        .criterion = input->sharp.coc.criterion,
    };
    double slope = tan(input->sight);
    if (!(cos(input->sight) > 0)) {
        return fail(error, ERROR_DOMAIN,
                    "{--sight} lies beside the camera or behind it (-90 to 90 deg, exclusive)");
    }
    tilt_take_level(&own, run->doubts);
    if (!tilt_row_solve(input, &row.camera, error)) {
        return false;
    }
    row.height = -row.camera.image * slope;
    row.reach = tilt_along(&row.camera, slope);
    if (isnan(row.camera.N)) {
        row.reach.near = row.reach.far = row.reach.front = row.reach.behind = NAN;
        row.criterion = NULL;
    }
    /* The image circle that is needed, and how much one that is given leaves. */
    const struct sensor *size = &input->sharp.sensor.size;
    const struct tilt_frame frame = {size->width, size->height, input->rise, input->shift};
    const struct tilt_frame turned = {.width = size->height, .height = size->width};
    const struct tilt *camera = &row.camera;
    struct tilt_coverage coverage = {NAN, INFINITY};
    struct error ignored;
    bool untilted = !(fabs(camera->tilt) > 0);
    if (!tilt_coverage(camera, &frame, &coverage, &ignored)) {
        coverage = (struct tilt_coverage){NAN, INFINITY}; /* no circle is large enough */
    }
    row.coverage = coverage.angle;
    row.needed = coverage.circle;
    if (!isnan(input->circle)) {
        row.covers = input->circle >= coverage.circle ? "yes" : "no";
    }
    row.rise_limit = row.shift_limit = NAN;
    if (untilted && !isnan(input->circle)) {
        tilt_shift_limit(camera, input->circle, &frame, &row.rise_limit, &ignored);
        tilt_shift_limit(camera, input->circle, &turned, &row.shift_limit, &ignored);
    }
    run_emit(run, &row);
    return true;
}

static bool draw_wedge(const struct artifact_job *job, struct output *sink, struct error *error)
{
    struct tilt_input own = *(const struct tilt_input *)job->inputs[0];
    const struct tilt_input *input = &own;
    struct svg svg = {.arena = job->run->arena};
    struct tilt camera;
    tilt_take_level(&own, NULL);
    if (!sharpness_settle(&own.sharp, PITCH_FOR_COC, NULL, error) ||
        !tilt_row_solve(input, &camera, error)) {
        return false;
    }
    if (isnan(camera.N)) {
        return fail(error, ERROR_USAGE, "{--wedge} needs the f-number: give {--aperture}");
    }
    double height = input->sharp.sensor.size.height;
    struct wedge wedge = {
        .f = camera.f,
        .tilt = camera.tilt,
        .image = camera.image,
        .hinge = camera.hinge,
        .scheimpflug = camera.scheimpflug,
        .A = camera.A,
        .A_near = camera.A_near,
        .A_far = camera.A_far,
        .B = camera.B,
        .sensor_height = height,
        .sensor_centre = -input->rise,
        .lens_diameter = fmax(camera.f / camera.N, 0.8 * height),
        .depth = isnan(input->depth) ? 0 : input->depth,
    };
    wedge.title = arena_printf(svg.arena, "Wedge of sharpness, %.4g mm lens", camera.f);
    wedge.subtitle =
        arena_printf(svg.arena,
                     "f/%.4g, circle of confusion %.4g mm (%s), sensor %s; distances along the "
                     "sensor's normal",
                     camera.N, camera.c, input->sharp.coc.criterion, input->sharp.sensor.name);
    return wedge_draw(&wedge, &svg, error) && drawing_write(job, &svg, sink, error);
}

static const struct explanation explanations[] = {
    {"coc", "c = {criterion}", "criterion of sharpness, see --coc",
     "what counts as sharp is a convention"},
    {"hinge", "J = {f}/sin({a})", "[Merklinger96] hinge rule", "thin lens"},
    {"angle", "psi = atan2(sin({a}), cos({a}) - {f}/{v})", "[Merklinger96]; [Scheimpflug04]", NULL},
    {"scheimpflug", "S = {v}/tan({a})", "[Scheimpflug04]", NULL},
    {"hyperfocal", "H = {f}^2/({N} {c})", "[Merklinger96]", "here without + f, exactly"},
    {"half_height", "q = ({J}/{H})({f}/{v})", "[Merklinger96]", "J on both sides at H"},
    {"distance", "u = {f}/(cos({a}) - {f}/{v})", "[Merklinger96]", NULL},
    {"near_angle", "psin = acot(cot({psi}) + {q})", "[Merklinger96] through the same hinge line",
     "blur c measured along the tilt axis; P = 1"},
    {"far_angle", "psif = acot(cot({psi}) - {q})", "[Merklinger96] through the same hinge line",
     NULL},
    {"needed_circle", "D = 2 {f} tan({w})", "worst corner of the frame, from the lens axis",
     "compare with the maker's circle at infinity and this f-number"},
    {NULL, NULL, NULL, NULL},
};

static const struct artifact artifacts[] = {
    {ARTIFACT_OPTION("wedge", drawing_types, "draw the side view with the wedge of sharpness"),
     .scope = ARTIFACT_OF_ROW, .make = draw_wedge},
};

static const struct example examples[] = {
    {"tilt -f 150 -N 22 --hinge 1.6m --angle 90deg --sensor 4x5", "a meadow, camera 1.6 m up"},
    {"tilt -f 90 -N 8 --tilt 5deg -s 0.6m", "a product on a table"},
    {"tilt -f 90 -N 16 --through 2m:-1.5m,30m:0m", "two points that must be sharp"},
    {"tilt -f 24 -N 8 --tilt 1..8 --angle 90deg", "what each degree does"},
    {"tilt -f 90 -N 11 --tilt 8 -s 1.2m --sight -20..20:5", "line of sight by line of sight"},
    {"tilt -f 150 -N 22 --tilt 5 --angle 90 --sensor 4x5 --wedge wedge.svg", "a drawing"},
    {NULL, NULL},
};

const struct command command_tilt = {
    .name = "tilt",
    COMMAND_OF("photography",
               "tilted lens: Scheimpflug, hinge rule, wedge of sharpness, image circle"),
    .run = tilt_run,
    COMMAND_MAKES(artifacts),
    .plot = "angle_deg,near_angle_deg,far_angle_deg",
    .plot_titles = "Plane of sharp focus",
    .zone = "near_angle far_angle",
    .cell = "near_m+far_m",
};
