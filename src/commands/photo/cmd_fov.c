/* commands/photo/cmd_fov.c - lenscalc fov: field of view. */
/* SPDX-License-Identifier: MIT */
#include "analysis/rays/angle_of_view.h"
#include "commands/lens/focus_gaps.h"
#include "commands/photo/by_rays.h"
#include "commands/photo/photo_lens.h"
#include "commands/photo/sharpness.h"
#include "commands/tables.h"
#include "photo/fov.h"

#include "base/constants.h"

#include <math.h>

/* How angles are found: by the lens's rays, or a projection of photo/fov.h behind them. */
enum view_way { VIEW_AUTO, VIEW_RAYS, VIEW_PROJECTIONS };

static const struct word ways[] = {
    [VIEW_AUTO] = {"auto", "chief-rays with --lens, unless --pupil is given; else rectilinear"},
    [VIEW_RAYS] = {"chief-rays", "the exact chief rays of --lens"},
    {"rectilinear", "f tan t: straight lines stay straight"},
    {"equidistant", "f t: image height in proportion to the angle"},
    {"equisolid", "2 f sin(t/2): image area in proportion to the solid angle"},
    {"stereographic", "2 f tan(t/2): small shapes stay true"},
    {"orthographic", "f sin t: at most a half sphere"},
    {NULL, NULL},
};

struct fov_input {
    double distance, magnification, squeeze;
    struct photo_lens_question lens;
    struct sensor_value sensor;
    int projection;
    double horizontal, vertical, diagonal;            /* wanted angles, rad */
    double field_width, field_height, field_diagonal; /* wanted fields, mm */
    double altitude, gsd, pitch;                      /* of a camera in the air, mm */
    int focus_by;
    const char *gap;
    /* of a lens that is focused by its gaps, as it stands for infinity, and its position */
    const struct photo_lens *at_infinity;
    const char *position;
};

static const struct word focusings[] = {
    {"lens", "the whole lens moves before the sensor"},
    {NULL, NULL},
};

#define INPUT struct fov_input

static const struct option options[] = {
    OPTION_FOCAL_LENGTH(lens.focal, OPTION_SETTING),
    PHOTO_LENS_OPTIONS(lens),
    OPTION_WAVELENGTH_OF_LENS(lens.wavelength, "lens"),
    OPTION_SENSOR(sensor),
    {MEASURE(distance, length, "m", "LENGTH"), REPEATED("distance"), .letter = 's',
     ABOVE_0_OR_INFINITE, .fallback = "inf",
     .help = "distance the lens is focused at; the field there is reported"},
    OPTION_FROM(lens.from, distances_from),
    {MEASURE(magnification, ratio, NULL, "RATIO"), REPEATED("magnification"), .letter = 'm', FROM_0,
     .excludes = "distance from", .help = "in place of the distance: 1:2 or 0.5"},
    {ASKED(projection), REPEATED("projection"), .words = ways, .fallback = "auto", .value = "KIND",
     .help = "how the lens maps angles"},
    OPTION_PUPIL_OF_LENS(lens.pupil, "distance|magnification|lens"),
    OPTION_SQUEEZE(squeeze, "1", "anamorphic squeeze: 2 doubles the width that is seen"),
    {MEASURE(horizontal, angle, "deg", "ANGLE"), REPEATED("horizontal"),
     .quantity = "horizontal angle of view", .lowest = 0, .highest = 2 * PI,
     .flags = OPTION_ABOVE_LOWEST | OPTION_GOAL,
     .help = "wanted horizontal angle: solves for the focal length"},
    {MEASURE(vertical, angle, "deg", "ANGLE"), REPEATED("vertical"),
     .quantity = "vertical angle of view", .lowest = 0, .highest = 2 * PI,
     .flags = OPTION_ABOVE_LOWEST | OPTION_GOAL, .help = "wanted vertical angle"},
    {MEASURE(diagonal, angle, "deg", "ANGLE"), REPEATED("diagonal"),
     .quantity = "diagonal angle of view", .lowest = 0, .highest = 2 * PI,
     .flags = OPTION_ABOVE_LOWEST | OPTION_GOAL, .help = "wanted diagonal angle"},
    {MEASURE(field_width, length, "m", "LENGTH"), .name = "field-width",
     .quantity = "width of the field", .column = "field_width", ABOVE_0 | OPTION_GOAL,
     .help = "wanted width of the field at --distance: solves for the focal length"},
    {MEASURE(field_height, length, "m", "LENGTH"), .name = "field-height",
     .quantity = "height of the field", .column = "field_height", ABOVE_0 | OPTION_GOAL,
     .help = "wanted height of the field"},
    {MEASURE(field_diagonal, length, "m", "LENGTH"), .name = "field-diagonal",
     .quantity = "diagonal of the field", .column = "field_diagonal", ABOVE_0 | OPTION_GOAL,
     .help = "wanted diagonal of the field"},
    {MEASURE(altitude, length, "m", "LENGTH"), REPEATED("altitude"), ABOVE_0,
     .help = "of a drone looking straight down: adds the ground coverage of pixel and picture"},
    {MEASURE(gsd, length, "cm", "LENGTH"), REPEATED("gsd"), .quantity = "ground sample", ABOVE_0,
     .help = "wanted ground sampling distance, in place of --altitude: solves for it"},
    OPTION_PITCH_ALONE(pitch, "altitude|gsd", "pixel pitch (otherwise that of the camera)"),
    BY_RAYS_EXACT_OPTION(lens.rays, "put the sensor where the rays of --lens are sharpest"),
    BY_RAYS_CRITERION_OPTION(lens.rays),
    {ASKED(focus_by), .name = "focus-by", .words = focusings, .fallback = "lens", .wants = "lens",
     .excludes = "gap", .value = "HOW", .help = "how --lens is focused; adds how much it breathes"},
    {ASKED(gap), .name = "gap", .wants = "lens", .value = "GAPS",
     .help = "focus by these gaps before a sensor that stays, as 'conjugate' does: d5,10:-1"},
};

struct fov_row {
    struct fov_setting setting;
    struct fov fov;
    double magnification, width, height, crop, image, sensor_distance, circle, pitch;
    struct fov_ground ground;
    double breathing; /* NaN: not asked for */
    struct photo_real real;
    struct by_rays_row rays;
    const char *sensor, *projection, *from;
};

#define ROW struct fov_row

static const struct column columns[] = {
    PHOTO_LENS_COLUMNS(real),
    PHOTO_LENS_WAVELENGTH_COLUMN(real),
    COLUMN_FOCAL(setting.f, COLUMN_BRIEF),
    {LENGTH(setting.s, "m"), .name = "distance", .flags = COLUMN_ECHO | COLUMN_INFINITE,
     .symbol = "s", .with = "distance", .label = "focused at",
     .help = "distance the lens is focused at, from the front principal plane"},
    {ANGLE(fov.horizontal), .name = "horizontal", BRIEF, .symbol = "hfov",
     .label = "horizontal angle", .help = "full horizontal angle of view"},
    {ANGLE(fov.vertical), .name = "vertical", BRIEF, .symbol = "vfov", .label = "vertical angle",
     .help = "full vertical angle of view"},
    {ANGLE(fov.diagonal), .name = "diagonal", BRIEF, .symbol = "dfov", .label = "diagonal angle",
     .help = "full diagonal angle of view"},
    {LENGTH(fov.width_at_s, "m"), .name = "field_width", .flags = COLUMN_INFINITE, .symbol = "W",
     .with = "distance magnification", .label = "field width",
     .help = "width seen in the plane of focus"},
    {LENGTH(fov.height_at_s, "m"), .name = "field_height", .flags = COLUMN_INFINITE,
     .with = "distance magnification", .label = "field height",
     .help = "height seen in the plane of focus"},
    {LENGTH(fov.diagonal_at_s, "m"), .name = "field_diagonal", .flags = COLUMN_INFINITE,
     .with = "distance magnification", .label = "field diagonal",
     .help = "diagonal seen in the plane of focus"},
    COLUMN_MAGNIFICATION(magnification, 0),
    {MEASURED(breathing, ratio, "percent"), .name = "breathing", BRIEF_WITH("exact focus-by gap"),
     .symbol = "b",
     .help = "how much wider the diagonal angle is than of the lens focused at infinity"},
    {SHOWN(fov.kind), .name = "class", BRIEF, .label = "class of lens",
     .help = "narrow, medium, normal, wide or ultra-wide, by the diagonal angle"},
    {LENGTH(ground.altitude, "m"), .name = "altitude", BRIEF_WITH("altitude gsd"), .symbol = "A",
     .help = "of the entrance pupil above level ground, camera straight down"},
    {LENGTH(ground.sample, "cm"), .name = "gsd", BRIEF_WITH("altitude gsd"), .symbol = "g",
     .label = "ground sampling distance", .help = "of one pixel, in the middle of the picture"},
    {LENGTH(ground.width, "m"), .name = "ground_width",
     BRIEF_WITH("altitude gsd") | COLUMN_INFINITE, .label = "ground width",
     .help = "of the ground in the picture"},
    {LENGTH(ground.height, "m"), .name = "ground_height",
     BRIEF_WITH("altitude gsd") | COLUMN_INFINITE, .label = "ground height",
     .help = "of the ground in the picture"},
    {LENGTH(width, "mm"), .name = "sensor_width", .flags = COLUMN_HIDDEN, .symbol = "w",
     .label = "sensor width", .help = "width of the sensor"},
    {LENGTH(height, "mm"), .name = "sensor_height", .flags = COLUMN_HIDDEN, .symbol = "h",
     .label = "sensor height", .help = "height of the sensor"},
    {SHOWN(crop), .name = "crop_factor", .label = "crop factor",
     .help = "43.27 mm over the sensor's diagonal"},
    {LENGTH(sensor_distance, "m"), .name = "distance_sensor", WITH("lens") | COLUMN_INFINITE,
     .symbol = "Ds", .label = "distance from the sensor",
     .help = "distance the lens is focused at, from the sensor"},
    {LENGTH(image, "mm"), .name = "image", .flags = COLUMN_EXTRA | COLUMN_INFINITE, .symbol = "v",
     .label = "image distance", .help = "sensor from the rear principal plane"},
    {LENGTH(circle, "mm"), .name = "image_circle", WITH("lens"), .label = "image circle",
     .help =
         "its diameter, by chief rays, where it does not cover the sensor; absent where it does"},
    BY_RAYS_COLUMNS(rays),
    PHOTO_LENS_HIATUS_COLUMN(real.hiatus),
    COLUMN_SENSOR(sensor),
    {SHOWN(projection), .name = "projection",
     .flags = COLUMN_ASSUMED | COLUMN_EXTRA | COLUMN_HIDDEN, .with = "lens projection",
     .depends = "projection lens pupil", .help = "how the lens maps angles"},
    {LENGTH(pitch, "um"), .name = "pitch", ASSUMED_WITH("altitude gsd", "pitch sensor"),
     .symbol = "p", .label = "pixel pitch", .help = "spacing of the pixels"},
    COLUMN_FROM(from),
    COLUMN_PUPIL(setting.P),
    {SHOWN(setting.squeeze), .name = "squeeze", ASSUMED_BY("squeeze") | COLUMN_ECHO, .symbol = "q",
     .help = "anamorphic squeeze"},
    PHOTO_LENS_WARNING_COLUMN(real),
};

static void fov_warn(struct fov_row *row, const char *warning, struct arena *arena)
{
    row->real.warning = lens_warnings_join(row->real.warning, warning, arena);
}

/* Angles by the lens's own rays? Not where the user puts another pupil in place of its own. */
static bool wants_rays(const struct fov_input *input, const struct photo_lens *lens)
{
    return input->projection == VIEW_RAYS ||
           (input->projection == VIEW_AUTO && lens->lens != NULL && isnan(input->lens.pupil));
}

/* What the exact chief rays of the real lens make of it, the film so far behind H'. */
static bool trace_view(const struct fov_input *input, const struct photo_lens *lens,
                       double distance, double image, struct arena *arena, struct view *view,
                       struct error *error)
{
    const struct setup_question asked = {.lens = lens->lens,
                                         .position = lens->position,
                                         .wavelength = wavelength_micrometres(lens->wavelength),
                                         .fnumber = NAN};
    struct setup setup;
    const struct view_question question = {
        .setup = &setup,
        .film = lens->real->rear + image,
        .subject = lens->measuring.front - distance,
        .first = lens->first,
        .squeeze = input->squeeze,
        .sensor = input->sensor.size,
    };
    return setup_open(&asked, arena, &setup, error) && view_of_lens(&question, arena, view, error);
}

/* The film behind H' where an image is sharpest; the distance is met again from the sensor. */
static bool place_film(const struct fov_input *input, const struct photo_lens *lens,
                       double *distance, struct run *run, double *image, struct by_rays_row *row,
                       struct error *error)
{
    struct real_focus focus;
    if (input->gap != NULL) {
        return fail(error, ERROR_USAGE,
                    "{--exact} moves the whole lens to where it is sharpest: it excludes {--gap}");
    }
    return by_rays_open(&input->lens, lens, *distance, 0, run, &focus, row, error) &&
           (input->lens.from != FROM_SENSOR || isinf(*distance) ||
            by_rays_distance(&focus, lens, *distance, input->distance, distance, error)) &&
           by_rays_image(&focus, lens, *distance, image, &row->blur, error);
}

/* How much wider the angle is than at infinity. */
static bool find_breathing(const struct fov_input *input, const struct photo_lens *lens,
                           struct run *run, struct fov_row *row, struct error *error)
{
    const struct photo_lens *far = input->at_infinity != NULL ? input->at_infinity : lens;
    double image = far->f, distance = INFINITY;
    struct by_rays_row ignored;
    struct view view;
    if ((input->lens.rays.exact &&
         !place_film(input, far, &distance, run, &image, &ignored, error)) ||
        !trace_view(input, far, INFINITY, image, run->arena, &view, error)) {
        return false;
    }
    row->breathing = row->fov.diagonal / view.diagonal.angle - 1;
    return true;
}

/* In place of what the projection says, which has checked the setting. */
static bool view_by_rays(const struct fov_input *input, const struct photo_lens *lens,
                         struct fov_row *row, struct arena *arena, struct error *error)
{
    struct view view;
    if (lens->lens == NULL) {
        return fail(error, ERROR_USAGE, "{--projection} chief-rays needs {--lens}");
    }
    if (!isnan(input->lens.pupil)) {
        return fail(
            error, ERROR_USAGE,
            "{--projection} chief-rays goes by the lens's own pupils: it excludes {--pupil}");
    }
    if (!trace_view(input, lens, row->setting.s, row->image, arena, &view, error)) {
        return false;
    }
    row->fov = (struct fov){view.horizontal.angle,        view.vertical.angle, view.diagonal.angle,
                            view.horizontal.size,         view.vertical.size,  view.diagonal.size,
                            fov_kind(view.diagonal.angle)};
    row->projection = ways[VIEW_RAYS].word;
    row->circle = view.circle;
    if (!isnan(view.circle)) {
        fov_warn(
            row,
            arena_printf(arena,
                         "the image circle, %.4g mm across, does not cover the sensor, %.4g mm: "
                         "angles and fields end at its edge",
                         view.circle, sensor_diagonal(&input->sensor.size)),
            arena);
    }
    if (!isnan(view.clear)) {
        fov_warn(row,
                 arena_printf(
                     arena,
                     "the chief rays are stopped by clear apertures outside a circle of %.4g mm: "
                     "the corners are strongly vignetted",
                     view.clear),
                 arena);
    }
    return true;
}

static bool look_by_rays(const struct fov_input *input, const struct photo_lens *lens,
                         struct run *run, struct fov_row *row, struct error *error)
{
    return view_by_rays(input, lens, row, run->arena, error) &&
           (!run_shows(run, offsetof(struct fov_row, breathing)) ||
            find_breathing(input, lens, run, row, error));
}

/* How far the subject is from the front principal plane. */
static bool find_subject(const struct fov_input *input, const struct photo_lens *lens, double *s,
                         struct error *error)
{
    const bool both = !isnan(input->magnification) && !isinf(input->distance);
    const bool near = !isnan(input->magnification) && !both;
    bool elsewhere = input->lens.from != FROM_PRINCIPAL && !isinf(input->distance);
    *s = input->distance;
    if ((near || elsewhere) && isnan(lens->f)) {
        return fail(error, ERROR_USAGE, "{--%s} needs {--focal-length} or {--lens}",
                    near ? "magnification" : "from");
    }
    if (near) {
        *s = lens->f * (1 + 1 / input->magnification);
        return true;
    }
    if (elsewhere &&
        !distance_to_principal(lens->f, lens->P, input->distance, &lens->measuring, s, error)) {
        return false;
    }
    /* rows of other commands bring both, which then say the same */
    const double m = lens->f / (*s - lens->f), rough = 1e-4;
    return !both || fabs(input->magnification - m) <= rough * fabs(m) ||
           fail(error, ERROR_USAGE, "{--magnification} %.6g is not that of the distance: %.6g",
                input->magnification, m);
}

/* What a camera in the air sees of the ground, if that is asked for. */
static bool fill_ground(const struct fov_input *input, struct fov_row *row, struct run *run,
                        struct error *error)
{
    const struct sharpness pixels = {.sensor = input->sensor, .pitch = input->pitch};
    row->ground = (struct fov_ground){input->altitude, input->gsd, NAN, NAN};
    row->pitch = NAN;
    if (isnan(input->altitude) && isnan(input->gsd)) {
        return true;
    }
    row->pitch = sharpness_pitch(&pixels);
    sharpness_doubt_pitch(&pixels, run->doubts);
    if (isnan(row->pitch) && !isnan(input->gsd)) {
        return fail(error, ERROR_USAGE,
                    "{--gsd} needs the pixel pitch: give {--pitch}, or a camera as {--sensor}");
    }
    if (isnan(row->pitch)) {
        warnings_add(run->doubts, "the ground sample needs the pixel pitch (--pitch, or --sensor "
                                  "with a camera): it is left out");
    }
    return fov_ground(&row->setting, &row->fov, row->pitch, &row->ground, error);
}

static bool fov_answer(const void *data, const struct photo_lens *lens, struct run *run,
                       struct error *error)
{
    const struct fov_input *input = data;
    bool chosen = input->projection >= VIEW_PROJECTIONS;
    struct fov_row row = {
        .setting = {(enum projection)(chosen ? input->projection - VIEW_PROJECTIONS : RECTILINEAR),
                    lens->f, input->distance, lens->P, input->squeeze},
        .width = input->sensor.size.width,
        .height = input->sensor.size.height,
        .sensor = input->sensor.name,
        .projection = ways[chosen ? input->projection : VIEW_PROJECTIONS].word,
        .from = isinf(input->distance) ? NULL : distances_from[input->lens.from].word,
        .circle = NAN,
        .breathing = NAN,
        .real = *lens->real,
        .rays = by_rays_none,
    };
    if (!find_subject(input, lens, &row.setting.s, error) ||
        !photo_lens_check_subject(lens, row.setting.s, error)) {
        return false;
    }
    /* The focal length from the one goal that is given. */
    const struct fov_goals goals = {input->horizontal,  input->vertical,     input->diagonal,
                                    input->field_width, input->field_height, input->field_diagonal};
    if (!fov_solve(&row.setting, &input->sensor.size, &goals, &row.setting.f, error) ||
        !fov_compute(&row.setting, &input->sensor.size, &row.fov, error)) {
        return false;
    }
    row.image = distance_image(row.setting.f, row.setting.s);
    if (input->position != NULL) {
        row.real.position = input->position;
    }
    if ((input->lens.rays.exact &&
         !place_film(input, lens, &row.setting.s, run, &row.image, &row.rays, error)) ||
        (wants_rays(input, lens) && !look_by_rays(input, lens, run, &row, error)) ||
        !fill_ground(input, &row, run, error)) {
        return false;
    }
    row.magnification = row.setting.f / (row.setting.s - row.setting.f);
    row.crop = sensor_crop(&input->sensor.size);
    row.sensor_distance = row.setting.s + row.image + lens->measuring.hiatus;
    run_emit(run, &row);
    return true;
}

/*
 * The lens in a position as it stands when its gaps are focused on a distance, at the question's
 * wavelength, else the primary one; of several solutions the one that moves least.
 */
static bool focus_by_gaps(const struct fov_input *input, size_t position, double distance,
                          struct arena *arena, struct photo_lens_question *focused,
                          struct error *error)
{
    const struct photo_lens_question *question = &input->lens;
    const struct lens *typed = question->lens.lens;
    const struct lens *lens = lens_at_position(typed, position, arena);
    struct focused *solutions = ARENA_ARRAY(arena, FOCUS_SOLUTIONS, struct focused);
    struct focus_mechanism focusing = {
        .wavelength = question->wavelength > 0 ? wavelength_micrometres(question->wavelength)
                                               : lens_primary_wavelength(typed),
        .section = (enum lens_section)question->section,
    };
    const struct conjugate_question object = {
        CONJUGATE_OBJECT, focus_from((enum distance_from)question->from), distance, 0};
    if (!focus_gaps_open(text_of(input->gap), typed, lens, arena, &focusing, error) ||
        focus_solve(&focusing, &object, arena, solutions, error) == 0) {
        return false;
    }
    *focused = *question;
    focused->position = NULL;
    focused->lens.lens = solutions[0].lens;
    focused->lens.memo = ARENA_NEW(arena, struct lens_memo);
    *focused->lens.memo = (struct lens_memo){.is_known = false};
    focused->lens.arena = arena;
    return true;
}

/* The lens in a position, focused by its gaps. */
static bool answer_focused(const struct fov_input *input, size_t position, struct run *run,
                           struct error *error)
{
    const struct lens *lens = input->lens.lens.lens;
    struct fov_input own = *input;
    struct photo_lens_question far;
    struct photo_lens near, infinity;
    if (!isnan(input->magnification)) {
        return fail(error, ERROR_USAGE, "{--gap} focuses on a {--distance}, not a magnification");
    }
    if (!focus_by_gaps(input, position, input->distance, run->arena, &own.lens, error) ||
        !photo_lens_single(&own.lens, 0, run->arena, &near, error) ||
        !focus_by_gaps(input, position, INFINITY, run->arena, &far, error) ||
        !photo_lens_single(&far, 0, run->arena, &infinity, error)) {
        return false;
    }
    own.at_infinity = &infinity;
    own.position = lens->position_count > 0 ? lens->positions[position] : NULL;
    return fov_answer(&own, &near, run, error);
}

static bool fov_run(const void *data, struct run *run, struct error *error)
{
    const struct fov_input *input = data;
    const size_t *positions;
    size_t count;
    if (input->gap == NULL || input->lens.lens.lens == NULL) {
        return photo_lens_each(&input->lens, 0, run, fov_answer, input, error);
    }
    if (!lens_positions(input->lens.lens.lens, input->lens.position, run->arena, &positions, &count,
                        error)) {
        return false;
    }
    for (size_t i = 0; i < count; i++) {
        if (!answer_focused(input, positions[i], run, error)) {
            return false;
        }
    }
    return true;
}

#define ANGLES(kind, horizontal, vertical, source)                                                 \
    {"horizontal projection=" kind, "hfov = " horizontal, source, NULL},                           \
    {                                                                                              \
        "vertical projection=" kind, "vfov = " vertical, source, NULL                              \
    }
#define OVER_SCALE  "/(2 {f} (1 + {m}/{P}))"
#define OVER_DOUBLE "/(4 {f} (1 + {m}/{P}))"

static const struct explanation explanations[] = {
    ANGLES("chief-rays", "angle between the rays from both ends of {w} through the stop's centre",
           "angle between the rays from both ends of {h} through the stop's centre",
           "Snell's law in vectors, [Welford86]"),
    ANGLES("rectilinear", "2 atan({q} {w}" OVER_SCALE ")", "2 atan({h}" OVER_SCALE ")",
           "[Ray02]; rectilinear, breathing included"),
    ANGLES("equidistant", "2 {q} {w}" OVER_SCALE, "2 {h}" OVER_SCALE, "r = f t, in radians"),
    ANGLES("equisolid", "4 asin({q} {w}" OVER_DOUBLE ")", "4 asin({h}" OVER_DOUBLE ")",
           "r = 2 f sin(t/2)"),
    ANGLES("stereographic", "4 atan({q} {w}" OVER_DOUBLE ")", "4 atan({h}" OVER_DOUBLE ")",
           "r = 2 f tan(t/2)"),
    ANGLES("orthographic", "2 asin({q} {w}" OVER_SCALE ")", "2 asin({h}" OVER_SCALE ")",
           "r = f sin t"),
    {"magnification", "m = {f}/({s} - {f})", "thin lens 1/f = 1/s + 1/v", NULL},
    {"distance_sensor", "Ds = {s} + {v} + {HH'}",
     "[Gauss41] HH' from the front to the rear principal plane", NULL},
    {"gsd", "g = {p} {A}/({f} (1 + {m}/{P}))", "similar triangles at the entrance pupil",
     "level ground, the camera straight down"},
    {"ground_width", "2 {A} tan({hfov}/2)", "similar triangles", NULL},
    {"field_width projection=rectilinear", "W = {q} {w}/{m}", "similar triangles", NULL},
    {"field_width projection=chief-rays",
     "W = distance of the points where those rays meet the plane at {s}", "[Welford86]", NULL},
    {NULL, NULL, NULL, NULL},
};

static const struct example examples[] = {
    {"fov -f 24mm --sensor aps-c", "a lens on a crop sensor"},
    {"fov -f 14,20,24,28,35,50,85,135,200", "the classes of lenses on 35 mm film"},
    {"fov -f 100mm -s 40cm", "how much is in the picture close up"},
    {"fov -f 100mm -m 1:2", "or at half life size"},
    {"fov --horizontal 90deg", "the focal length for an angle"},
    {"fov -f 8mm --projection equisolid --sensor mft", "a fisheye"},
    {"fov --lens double-gauss -s 0.5m", "a real lens, close up, by its rays"},
    {"fov --lens fisheye-16", "and a fisheye"},
    {"fov --lens double-gauss -s 1m,2m,4m,inf --exact", "how much a lens breathes"},
    {"fov -f 50mm --squeeze 2 --sensor scope", "anamorphic cinema"},
    {"fov -f 8.8mm --sensor 13.2x8.8mm --pitch 2.41um --altitude 60m,120m", "from a drone"},
    {NULL, NULL},
};

PHOTO_LENS_MAKES_MANY(lens)

BY_RAYS_WEIGHT(lens.rays)

const struct command command_fov = {
    .name = "fov",
    .stop_size_wants = "exact",
    COMMAND_OF("photography", "field of view, and the focal length for a wanted one"),
    .run = fov_run,
    .makes_many = makes_many,
    .varies = varies,
    .weight = weight,
    .plot = "horizontal_deg,vertical_deg,diagonal_deg",
    .cell = "horizontal_deg",
};
