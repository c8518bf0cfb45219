/* commands/photo/cmd_fov.c - lenscalc fov: field of view. */
/* SPDX-License-Identifier: MIT */
#include "commands/photo/attachments.h"
#include "commands/photo/crop.h"
#include "commands/photo/fov_question.h"
#include "commands/tables.h"

#include "base/constants.h"

#include <math.h>

static const struct word focusings[] = {
    {"lens", "the whole lens moves relative to the sensor"},
    {NULL, NULL},
};

/* What puts the subject at a finite distance, and what asks for pixels on it. */
#define FIELDS "field field-width field-height field-diagonal density task dori"
#define NEAR   "distance magnification " FIELDS

#define INPUT struct fov_input

static const struct option options[] = {
    OPTION_FOCAL_LENGTH(lens.focal, OPTION_SETTING),
    PHOTO_LENS_OPTIONS(lens),
    OPTION_WAVELENGTH_OF_LENS(lens.wavelength, "lens"),
    OPTION_SENSOR(sensor),
    {MEASURE(distance, length, "m", "LENGTH"), REPEATED("distance"), .letter = 's',
     ABOVE_0_OR_INFINITE | OPTION_SETTING, .fallback = "inf",
     .help = "distance the lens is focused at; the field there is reported"},
    OPTION_FROM(lens.from, distances_from),
    {MEASURE(magnification, ratio, NULL, "RATIO"), REPEATED("magnification"), .letter = 'm', FROM_0,
     .excludes = "distance from", .help = "in place of the distance: 1:2 or 0.5"},
    {ASKED(projection), REPEATED("projection"), .words = fov_ways, .fallback = "auto",
     .value = "KIND", .help = "how the lens maps angles"},
    OPTION_PUPIL_OF_LENS(lens.pupil, "distance|magnification|lens"),
    OPTION_CONVERTER_ALONE(converter, "exact focus-by gap"),
    OPTION_CROP(crop),
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
    {ASKED(field), .name = "field", .excludes = "field-width field-height", .value = "WxH",
     .help = "wanted field, 100x75mm: its width and height at once"},
    {MEASURE(field_width, length, "m", "LENGTH"), .name = "field-width",
     .quantity = "width of the field", .column = "field_width", ABOVE_0 | OPTION_GOAL,
     .help = "wanted width of the field: with -s solves for the focal length, with -f for the "
             "distance, with both for the sensor"},
    {MEASURE(field_height, length, "m", "LENGTH"), .name = "field-height",
     .quantity = "height of the field", .column = "field_height", ABOVE_0 | OPTION_GOAL,
     .help = "wanted height of the field; with the width both shall be in the picture"},
    {MEASURE(field_diagonal, length, "m", "LENGTH"), .name = "field-diagonal",
     .quantity = "diagonal of the field", .column = "field_diagonal", ABOVE_0 | OPTION_GOAL,
     .help = "wanted diagonal of the field"},
    {MEASURE(density, pixel_density, "px_m", "DENSITY"), REPEATED("density"),
     .quantity = "pixel density", ABOVE_0 | OPTION_GOAL,
     .help = "wanted pixels along the subject: 250px/m, 10px/mm, 76px/ft; solves as a field does"},
    {ASKED(task), REPEATED("task"), .words = fov_tasks, .fallback = "none", .value = "TASK",
     .excludes = "density dori field field-width field-height field-diagonal",
     .help = "the same by what is to be seen, as IEC 62676-4 has it: identify is 250 px/m"},
    {ASKED(dori), .name = "dori",
     .excludes = "density field field-width field-height field-diagonal",
     .help = "all six tasks of IEC 62676-4:2014, from monitor to inspect"},
    OPTION_PIXELS(pixels,
                  "pixels of --sensor, or with --pitch in its place: 2448x2048, 4Mpx, 1080p"),
    OPTION_PITCH_ALONE(pitch, NULL,
                       "pixel pitch (otherwise that of the camera): adds the angle of a pixel"),
    {ASKED(line_scan), .name = "line-scan",
     .help = "the sensor is one line of pixels, the width its length"},
    {MEASURE(speed, speed, "m_s", "SPEED"), REPEATED("speed"), .letter = 'v', ABOVE_0,
     .wants = "line-scan",
     .help = "speed of what passes the line: adds the line rate for square pixels"},
    {MEASURE(line_rate, rate, "Hz", "RATE"), .name = "line-rate", .quantity = "line rate",
     .column = "line_rate", ABOVE_0, .wants = "line-scan", .excludes = "speed",
     .help = "line rate of the camera: adds the speed at which pixels are square"},
    {ASKED(telecentric), .name = "telecentric",
     .excludes = "focal-length lens distance from projection pupil horizontal vertical diagonal "
                 "altitude gsd subject subject-angle converter crop task dori",
     .why = "its field is the sensor over the magnification, at one distance",
     .help = "a telecentric lens: -m gives the field, or a field the magnification"},
    {MEASURE(na, number, NULL, "NUMBER"), .name = "na", .quantity = "numerical aperture",
     .lowest = 0, .highest = 1, .flags = OPTION_ABOVE_LOWEST, .wants = "telecentric",
     .excludes = "aperture",
     .help = "its numerical aperture at the subject: adds the depth of field"},
    {MEASURE(fnumber, fnumber, NULL, "NUMBER"), .name = "aperture", .letter = 'N',
     .quantity = "working f-number", .column = "working_fnumber", ABOVE_0, OPTION_USUAL_FNUMBER,
     .wants = "telecentric", .help = "or its working f-number, at the sensor"},
    {MEASURE(blur, pixels, NULL, "PIXELS"), REPEATED("blur"), ABOVE_0, .fallback = "1",
     .wants = "na|aperture", .help = "pixels that a point may be blurred to within its depth"},
    {MEASURE(altitude, length, "m", "LENGTH"), REPEATED("altitude"), ABOVE_0,
     .help = "altitude of a drone that looks straight down: adds the ground coverage of a pixel "
             "and of the picture"},
    {MEASURE(gsd, length, "cm", "LENGTH"), REPEATED("gsd"), .quantity = "ground sample", ABOVE_0,
     .help = "wanted ground sampling distance, in place of --altitude: solves for it"},
    SKY_OPTIONS(sky),
    BY_RAYS_EXACT_OPTION(lens.rays, "put the sensor at the best focus of the exact rays of --lens"),
    BY_RAYS_CRITERION_OPTION(lens.rays),
    {ASKED(focus_by), .name = "focus-by", .words = focusings, .fallback = "lens", .wants = "lens",
     .excludes = "gap", .value = "HOW", .help = "how --lens is focused; adds its breathing"},
    {ASKED(gap), .name = "gap", .wants = "lens", .value = "GAPS", .excludes = FIELDS,
     .help = "focus by these gaps, the sensor staying fixed, as 'conjugate' does: d5,10:-1"},
};

#define ROW struct fov_row

static const struct column columns[] = {
    PHOTO_LENS_COLUMNS(real),
    PHOTO_LENS_WAVELENGTH_COLUMN(real),
    {LENGTH(setting.f, "mm"), .name = "combined_focal", BRIEF_WITH("converter"), .symbol = "f",
     .label = "combined focal length", .help = "focal length of lens and converter"},
    COLUMN_FOCAL(focal, COLUMN_BRIEF),
    COLUMN_CONVERTER(converter),
    {LENGTH(setting.s, "m"), .name = "distance",
     .flags = COLUMN_ECHO | COLUMN_INFINITE | COLUMN_WITH, .symbol = "s", .with = FIELDS,
     .repeats = "distance", .label = "focused at",
     .help = "distance the lens is focused at, from the front principal plane"},
    {ANGLE(fov.horizontal), .name = "horizontal", BRIEF, .symbol = "hfov",
     .label = "horizontal angle", .help = "full horizontal angle of view"},
    {ANGLE(fov.vertical), .name = "vertical", BRIEF, .symbol = "vfov", .label = "vertical angle",
     .help = "full vertical angle of view"},
    {ANGLE(fov.diagonal), .name = "diagonal", BRIEF, .symbol = "dfov", .label = "diagonal angle",
     .help = "full diagonal angle of view"},
    {LENGTH(fov.width_at_s, "m"), .name = "field_width", .flags = COLUMN_INFINITE, .symbol = "W",
     .with = NEAR, .label = "field width", .help = "width seen in the plane of focus"},
    {LENGTH(fov.height_at_s, "m"), .name = "field_height", .flags = COLUMN_INFINITE, .with = NEAR,
     .label = "field height", .help = "height seen in the plane of focus"},
    {LENGTH(fov.diagonal_at_s, "m"), .name = "field_diagonal", .flags = COLUMN_INFINITE,
     .with = NEAR, .label = "field diagonal", .help = "diagonal seen in the plane of focus"},
    COLUMN_MAGNIFICATION(magnification, 0),
    {SHOWN(solved_for), .name = "solved_for", BRIEF_WITH(FIELDS) | COLUMN_SPARSE,
     .label = "solved for", .help = "what was open: focal length, distance or sensor"},
    {SHOWN(solved_by), .name = "solved_by", WITH(FIELDS) | COLUMN_SPARSE, .label = "by its",
     .help = "of several fields the one that is harder to get into the picture"},
    {SHOWN(task), .name = "task", BRIEF_WITH("task dori"), .label = "task",
     .help = "of an operator, IEC 62676-4"},
    {MEASURED(density, pixel_density, "px_m"), .name = "density", .with = NEAR,
     .flags = COLUMN_EXTRA | COLUMN_SPARSE, .when = "with pixels known", .label = "pixel density",
     .symbol = "D", .help = "along the width of the subject"},
    {LENGTH(object_pixel, "mm"), .name = "object_pixel", .with = NEAR,
     .flags = COLUMN_EXTRA | COLUMN_SPARSE, .when = "with pixels known",
     .label = "pixel on the subject", .help = "its width there"},
    {MEASURED(speed, speed, "m_s"), .name = "speed", BRIEF_WITH("speed line-rate"), .symbol = "V",
     .help = "of what passes the line"},
    {MEASURED(line_rate, rate, "Hz"), .name = "line_rate", BRIEF_WITH("speed line-rate"),
     .label = "line rate", .help = "for square pixels"},
    {SHOWN(fnumber), .name = "working_fnumber", WITH("na aperture"), .symbol = "N",
     .label = "working f-number", .help = "of the cone at the sensor"},
    {LENGTH(depth, "mm"), .name = "depth", BRIEF_WITH("na aperture"), .symbol = "T",
     .label = "depth of field", .help = "of a telecentric lens, from near to far limit"},
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
    SKY_COLUMNS(sky),
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
    {LENGTH(pitch, "um"), .name = "pitch",
     ASSUMED_WITH("altitude gsd pixels pitch " NEAR " " SKY_NAMES, "pitch sensor pixels"),
     .symbol = "p", .label = "pixel pitch", .help = "spacing of the pixels"},
    {MEASURED(blur, pixels, "px"), .name = "blur",
     ASSUMED_WITH("na aperture", "blur") | COLUMN_ECHO, .symbol = "bp", .label = "blur at most",
     .help = "within the depth of field"},
    COLUMN_FROM(from),
    COLUMN_PUPIL(setting.P),
    {SHOWN(setting.squeeze), .name = "squeeze", ASSUMED_BY("squeeze") | COLUMN_ECHO, .symbol = "q",
     .help = "anamorphic squeeze"},
    PHOTO_LENS_WARNING_COLUMN(real),
};

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
    {"magnification class", "m = {f}/({s} - {f})", "thin lens 1/f = 1/s + 1/v", NULL},
    {"focal solved_for=focal length", "f = {s} {m}/(1 + {m})", "thin lens 1/f = 1/s + 1/v, v = m s",
     "exact near 1:1 too, where s w/W is too long by 1 + m"},
    {"distance solved_for=distance", "s = {f} (1 + 1/{m})", "thin lens 1/f = 1/s + 1/v, v = m s",
     "exact near 1:1 too, where f W/w is too short by f"},
    {"sensor_width solved_for=sensor", "w = {m} {W}/{q}", "similar triangles", NULL},
    {"density", "D = {m}/({p} {q})", "similar triangles", "in the middle of the picture"},
    {"field_width projection=telecentric", "W = {q} {w}/{m}", "constant magnification", NULL},
    {"depth", "T = 2 {bp} {p} {N}/{m}^2", "[Pomeas23]", "geometric, half on each side"},
    {"line_rate", "{V} {D}", "one line a pixel of the way", NULL},
    {"distance_sensor", "Ds = {s} + {v} + {HH'}",
     "[Gauss41] HH' from the front to the rear principal plane", NULL},
    {"gsd", "g = {p} {A}/({f} (1 + {m}/{P}))", "similar triangles at the entrance pupil",
     "level ground, the camera straight down"},
    {"ground_width", "2 {A} tan({hfov}/2)", "similar triangles", NULL},
    SKY_EXPLANATIONS,
    {"field_width projection=rectilinear", "W = {q} {w}/{m}", "similar triangles", NULL},
    {"field_width projection=chief-rays",
     "W = distance of the points where those rays meet the plane at {s}", "[Welford86]", NULL},
    {NULL, NULL, NULL, NULL},
};

static const struct example examples[] = {
    {"fov -f 24mm --sensor aps-c", "a lens on a crop sensor"},
    {"fov -f 300mm --converter 2x --crop 1.5", "a long lens with a teleconverter on it"},
    {"fov -f 14,20,24,28,35,50,85,135,200", "the classes of lenses on 35 mm film"},
    {"fov -f 100mm -s 40cm", "how much is in the picture close up"},
    {"fov -f 100mm -m 1:2", "or at half life size"},
    {"fov --horizontal 90deg", "the focal length for an angle"},
    {"fov --field-width 400mm -s 600mm --sensor imx264", "or for a field at a distance"},
    {"fov -f 16mm --field 100x75mm --sensor 2/3in",
     "the distance at which both are in the picture"},
    {"fov -f 2.8mm --sensor 1/2.8in --pixels 2688x1520 --dori", "how far a camera identifies"},
    {"fov --line-scan --pixels 4096 --pitch 7um --field-width 0.5m -s 1m -v 2m/s",
     "a line-scan camera above a belt"},
    {"fov --telecentric -m 0.5 --sensor imx264 --na 0.05", "a telecentric lens"},
    {"fov -f 8mm --projection equisolid --sensor mft", "a fisheye"},
    {"fov --lens double-gauss -s 0.5m", "a real lens, close up, by its rays"},
    {"fov --lens fisheye-16", "and a fisheye"},
    {"fov --lens double-gauss -s 1m,2m,4m,inf --exact", "the breathing of a lens"},
    {"fov -f 50mm --squeeze 2 --sensor scope", "anamorphic cinema"},
    {"fov -f 1200mm --sensor \"ZWO ASI2600MC Pro\" --subject moon", "a camera on a telescope"},
    {"fov -f 8.8mm --sensor 13.2x8.8mm --pitch 2.41um --altitude 60m,120m", "from a drone"},
    {NULL, NULL},
};

PHOTO_LENS_VARIES(lens)

static bool makes_many(const void *data)
{
    const struct fov_input *input = data;
    return input->dori || photo_lens_makes_many(&input->lens);
}

BY_RAYS_WEIGHT(lens.rays)

const struct command command_fov = {
    .name = "fov",
    .stop_size_wants = "exact",
    COMMAND_OF("photography", "field of view, and the lens, distance or sensor for a wanted one"),
    .run = fov_run,
    .makes_many = makes_many,
    .varies = varies,
    .weight = weight,
    .plot = "horizontal_deg,vertical_deg,diagonal_deg",
    .cell = "horizontal_deg",
};
