/* commands/photo/cmd_panorama.c - lenscalc panorama: frames, steps, size and parallax. */
/* SPDX-License-Identifier: MIT */
#include "cli/question/command.h"
#include "commands/photo/photo_options.h"
#include "commands/tables.h"
#include "photo/conjugate.h"
#include "photo/panorama.h"

#include "base/constants.h"

#include <math.h>

struct panorama_input {
    struct focal_value focal;
    double distance, pupil, hiatus;
    struct sensor_value sensor;
    bool portrait;
    double horizontal, vertical; /* of a frame, in place of the lens */
    double arc, span, elevation, overlap;
    long per_row; /* 0 = as many as the overlap asks for */
    long rows;    /* 0 = likewise */
    bool each_row;
    long pixels;                         /* 0 = from the camera */
    double offset, near, far, tolerance; /* parallax */
    struct size_value print;             /* mm; NaN = not given */
    double dpi;
};

#define INPUT struct panorama_input

static const struct option options[] = {
    OPTION_FOCAL_LENGTH(focal, OPTION_SETTING),
    OPTION_SENSOR(sensor),
    {ASKED(portrait), .name = "portrait", .help = "the camera is held upright"},
    {MEASURE(distance, length, "m", "LENGTH"), REPEATED("distance"), .letter = 's',
     ABOVE_0_OR_INFINITE, .fallback = "inf", .help = "distance the lens is focused at"},
    OPTION_PUPIL(pupil),
    {MEASURE(hiatus, length, "mm", "LENGTH"), .name = "hiatus", .flags = OPTION_NO_INFINITY,
     .fallback = "0", .excludes = "each-row", .help = "distance between the principal planes"},
    {MEASURE(horizontal, angle, "deg", "ANGLE"), REPEATED("horizontal"), .lowest = 0,
     .highest = 2 * PI, .flags = OPTION_ABOVE_LOWEST | OPTION_GOAL,
     .help = "horizontal angle of one frame as held, in place of -f (a fisheye)"},
    {MEASURE(vertical, angle, "deg", "ANGLE"), REPEATED("vertical"), .lowest = 0, .highest = 2 * PI,
     .flags = OPTION_ABOVE_LOWEST | OPTION_GOAL, .help = "vertical angle of one frame as held"},
    {MEASURE(arc, angle, "deg", "ANGLE"), .name = "arc", .lowest = 0, .highest = 2 * PI,
     .flags = OPTION_ABOVE_LOWEST, .fallback = "360",
     .help = "horizontal angle of the panorama; 360 closes on itself"},
    {MEASURE(span, angle, "deg", "ANGLE"), .name = "span", .lowest = 0, .highest = PI,
     .fallback = "0", .help = "vertical angle of the panorama; up to that of a frame: one row"},
    {MEASURE(elevation, angle, "deg", "ANGLE"), .name = "elevation", .lowest = -PI / 2,
     .highest = PI / 2, .fallback = "0", .wants = "each-row",
     .help = "elevation of the panorama's centre, for --each-row"},
    {MEASURE(overlap, ratio, NULL, "FRACTION"), .name = "overlap", .lowest = 0, .highest = 0.95,
     .fallback = "30%", .help = "least overlap of neighbouring frames: 30% or 0.3"},
    {ASKED(per_row), .name = "per-row", .lowest = 1, .highest = 1e6, .value = "NUMBER",
     .help = "frames per row, in place of the number that --overlap gives"},
    {ASKED(rows), .name = "rows", .quantity = "number of rows", .lowest = 1, .highest = 1e6,
     .value = "NUMBER", .help = "number of rows, in place of that from --span and --overlap"},
    {ASKED(each_row), .name = "each-row", .excludes = "offset near pixels",
     .help = "one line per row: its elevation, and the fewest frames it needs"},
    {ASKED(pixels), .name = "pixels", .lowest = 1, .highest = 1e6, .value = "NUMBER",
     .help = "frame width in pixels, as held (default: from the camera's pitch)"},
    {MEASURE(offset, length, "mm", "LENGTH"), .name = "offset", .flags = OPTION_NO_INFINITY,
     .help =
         "offset of the entrance pupil from the axis of rotation, along the lens: causes parallax"},
    {MEASURE(near, length, "m", "LENGTH"), .name = "near", .quantity = "nearest point", ABOVE_0,
     .help = "nearest object where frames overlap, for parallax"},
    {MEASURE(far, length, "m", "LENGTH"), .name = "far", .quantity = "farthest point",
     ABOVE_0_OR_INFINITE, .fallback = "inf", .wants = "near", .help = "farthest object there"},
    {MEASURE(tolerance, number, NULL, "NUMBER"), .name = "tolerance", ABOVE_0, .fallback = "1",
     .wants = "near", .help = "allowed parallax in pixels"},
    {ASKED(print), .name = "print", .value = "WxH", .excludes = "arc span rows per-row",
     .help = "size of a print of it, 3x2m: arc and span follow from its pixels, as a cylinder"},
    {MEASURE(dpi, number, NULL, "NUMBER"), .name = "dpi", ABOVE_0, .fallback = "300",
     .wants = "print", .help = "pixels an inch of the print"},
};

struct panorama_command_row {
    double focal, distance;
    struct panorama_frame frame;
    double step, row_step, overlap, row_overlap, arc, span;
    long columns, rows, shots, row, pixels;
    struct panorama_size size;
    double elevation, parallax, parallax_pixels, most_offset, nearest, pupil_distance, offset;
    double pupil, dpi;
    const char *sensor, *held, *cylinder;
};

#define ROW struct panorama_command_row

#define COLUMNS_ASSUMED                                                                            \
    COLUMN_SENSOR(sensor),                                                                         \
        ENTRY(SHOWN(held), .name = "held", .flags = COLUMN_ASSUMED | COLUMN_EXTRA,                 \
              .help = "landscape or portrait"),                                                    \
        ENTRY(ANGLE(arc), .name = "arc", ASSUMED_BY("arc") | COLUMN_ECHO, .symbol = "A",           \
              .help = "horizontal angle of the panorama"),                                         \
        ENTRY(ANGLE(span), .name = "span", ASSUMED_BY("span") | COLUMN_ECHO, .symbol = "B",        \
              .help = "vertical angle of the panorama")

#define PRINT_COLUMNS                                                                              \
    ENTRY(SHOWN(dpi), .name = "dpi", ASSUMED_WITH("print", "dpi") | COLUMN_ECHO, .symbol = "Q",    \
          .label = "pixels an inch", .help = "of the print"),                                      \
        ENTRY(SHOWN(cylinder), .name = "shape", ASSUMED_WITH("print", "print"),                    \
              .help = "how the panorama is laid flat for the print")

#define WITH_PIXELS .when = "with --pixels, or a camera of known pixels"

static const struct column columns[] = {
    COLUMN_FOCAL(focal, 0),
    {LENGTH(distance, "m"), .name = "distance", ECHO_WITH("distance") | COLUMN_INFINITE,
     .symbol = "s", .label = "focused at", .help = "distance the lens is focused at"},
    {ANGLE(frame.horizontal), .name = "horizontal", .symbol = "h", .label = "horizontal angle",
     .help = "of one frame as held"},
    {ANGLE(frame.vertical), .name = "vertical", .symbol = "v", .label = "vertical angle",
     .help = "of one frame as held"},
    {SHOWN(columns), .name = "columns", BRIEF, .repeats = "per-row", .symbol = "n",
     .label = "columns, frames a row", .help = "frames a row at the horizon"},
    {SHOWN(rows), .name = "rows", BRIEF, .help = "rows"},
    {SHOWN(shots), .name = "shots", BRIEF, .label = "shots in total", .help = "columns times rows"},
    {ANGLE(step), .name = "step", BRIEF, .symbol = "d", .help = "from frame to frame"},
    {ANGLE(row_step), .name = "row_step", .when = "where there are several rows",
     .label = "step between rows", .help = "from row to row"},
    {MEASURED(overlap, ratio, "percent"), .name = "overlap", BRIEF, .symbol = "o",
     .help = "of neighbouring frames, achieved"},
    {MEASURED(row_overlap, ratio, "percent"), .name = "row_overlap",
     .when = "where there are several rows", .label = "overlap of rows",
     .help = "of neighbouring rows, achieved"},
    {SHOWN(size.per_degree), .name = "pixels_per_degree", .label = "pixels per degree", WITH_PIXELS,
     .help = "in the middle of a frame"},
    {SHOWN(size.width), .name = "width_px", .label = "width, pixels", WITH_PIXELS,
     .help = "of the stitched picture, cylinder or sphere"},
    {SHOWN(size.sphere_height), .name = "sphere_height_px", .label = "height as a sphere, pixels",
     WITH_PIXELS, .help = "equirectangular"},
    {SHOWN(size.cylinder_height), .name = "cylinder_height_px",
     .flags = COLUMN_INFINITE | COLUMN_HIDDEN, .label = "height as a cylinder, pixels", WITH_PIXELS,
     .help = "infinite from 180 degrees on"},
    {SHOWN(size.flat_width), .name = "flat_width_px", .flags = COLUMN_INFINITE | COLUMN_HIDDEN,
     .label = "width laid flat, pixels", WITH_PIXELS,
     .help = "rectilinear; infinite from 180 degrees on"},
    {LENGTH(offset, "mm"), .name = "offset", ECHO_WITH("offset"), .symbol = "e",
     .label = "offset of the pupil", .help = "entrance pupil off the axis"},
    {ANGLE(parallax), .name = "parallax", BRIEF_WITH("offset"), .symbol = "p",
     .help = "of near against far between two frames"},
    {SHOWN(parallax_pixels), .name = "parallax_px", BRIEF_WITH("offset"),
     .label = "parallax, pixels", .help = "the same in pixels"},
    {LENGTH(most_offset, "mm"), .name = "max_offset", BRIEF_WITH("near"), .label = "largest offset",
     .help = "offset that stays within --tolerance"},
    {LENGTH(nearest, "m"), .name = "nearest", BRIEF_WITH("offset"),
     .label = "nearest allowed object", .help = "nearest object that stays within --tolerance"},
    {LENGTH(pupil_distance, "mm"), .name = "pupil_from_sensor", .symbol = "D",
     .label = "pupil before the sensor",
     .help = "thin-lens estimate of what to put between the axis and the sensor mark"},
    COLUMNS_ASSUMED,
    PRINT_COLUMNS,
    COLUMN_PUPIL(pupil),
};

/* With --each-row. */
static const struct column row_columns[] = {
    {SHOWN(row), .name = "row", BRIEF | COLUMN_ECHO, .help = "lowest first"},
    {ANGLE(elevation), .name = "elevation", BRIEF, .help = "of the frames' middle"},
    {SHOWN(columns), .name = "columns", BRIEF, .label = "frames in this row",
     .help = "enough at this elevation"},
    {ANGLE(step), .name = "step", BRIEF, .help = "from frame to frame"},
    COLUMN_FOCAL(focal, 0),
    {ANGLE(frame.horizontal), .name = "horizontal", .label = "horizontal angle",
     .help = "of one frame as held"},
    {ANGLE(frame.vertical), .name = "vertical", .label = "vertical angle",
     .help = "of one frame as held"},
    COLUMNS_ASSUMED,
};

static const struct sheet whole = SHEET(columns, struct panorama_command_row);
static const struct sheet by_row = SHEET(row_columns, struct panorama_command_row);
static const struct sheet *const sheets[] = {&whole, &by_row, NULL};

static bool panorama_makes_many(const void *data)
{
    return ((const struct panorama_input *)data)->each_row;
}

static const struct sheet *panorama_choose_sheet(const void *data,
                                                 const struct option_query *asking)
{
    (void)asking;
    return panorama_makes_many(data) ? &by_row : &whole;
}

/* The sides of the sensor as the camera is held. */
static struct sensor held_sensor(const struct panorama_input *input)
{
    struct sensor sensor = input->sensor.size;
    if (input->portrait) {
        sensor.width = input->sensor.size.height;
        sensor.height = input->sensor.size.width;
    }
    return sensor;
}

/* The angles of a frame: given, or from lens and sensor. */
static bool find_frame(const struct panorama_input *input, struct panorama_command_row *row,
                       struct error *error)
{
    struct sensor sensor = held_sensor(input);
    struct conjugates_given given = {input->focal.length, input->distance, NAN, NAN, NAN, 0, 0};
    struct conjugates c;
    if (isnan(input->focal.length)) {
        if (isnan(input->horizontal) || isnan(input->vertical)) {
            return fail(
                error, ERROR_USAGE,
                "give {--focal-length}, or the frame's {--horizontal} and {--vertical} angle");
        }
        row->frame = (struct panorama_frame){input->horizontal, input->vertical};
        return true;
    }
    if (!isnan(input->horizontal) || !isnan(input->vertical)) {
        return fail(error, ERROR_USAGE,
                    "{--focal-length} gives the frame's angles already: no "
                    "{--horizontal} or {--vertical} with it");
    }
    return conjugates_solve(&given, &c, error) &&
           panorama_frame(c.f, c.m, input->pupil, sensor.width, sensor.height, &row->frame,
                          error) &&
           panorama_pupil(c.f, c.m, input->pupil, input->hiatus, &row->pupil_distance, error);
}

/* A number of frames a row that is given, and the overlap it leaves. */
static bool set_columns(const struct panorama_input *input, const struct panorama_frame *frame,
                        struct panorama *plan, struct error *error)
{
    int count = (int)input->per_row;
    if (count == 0) {
        return true;
    }
    if (!panorama_overlap(frame, input->arc, count, &plan->overlap, error)) {
        return false;
    }
    if (plan->overlap < 0 || (isnan(plan->overlap) && frame->horizontal < input->arc)) {
        return fail(error, ERROR_DOMAIN, "{--per-row} %d leaves gaps: at least %d without overlap",
                    count, (int)ceil(input->arc / frame->horizontal - 1e-9));
    }
    plan->columns = count;
    plan->shots = count * plan->rows;
    plan->step = count > 1 ? (1 - plan->overlap) * frame->horizontal : 0;
    return true;
}

/* Pixels along the width of a frame, 0 = unknown. */
static double frame_pixels(const struct panorama_input *input)
{
    struct sensor sensor = held_sensor(input);
    if (input->pixels > 0) {
        return (double)input->pixels;
    }
    return isnan(sensor.pitch) || isnan(input->focal.length) ? 0
                                                             : round(sensor.width / sensor.pitch);
}

/* The arc and span of a print, of its pixels on a cylinder. */
static bool panorama_take_print(const struct panorama_input *input,
                                const struct panorama_command_row *row, double pixels,
                                struct panorama_goal *goal, struct error *error)
{
    const double per_mm = input->dpi / 25.4;
    if (isnan(input->print.width)) {
        return true;
    }
    if (!(pixels > 0)) {
        return fail(error, ERROR_USAGE,
                    "{--print} needs the pixels of a frame: give {--pixels}, or a camera as "
                    "{--sensor}");
    }
    return panorama_goal_of_size(&row->frame, pixels, input->print.width * per_mm,
                                 input->print.height * per_mm, goal, error);
}

/* Parallax needs a size in pixels only where it is told in pixels. */
static bool find_parallax(const struct panorama_input *input, struct panorama_command_row *row,
                          struct error *error)
{
    double per_radian = row->size.per_degree / RADIANS_PER_DEGREE;
    bool has_offset = !isnan(input->offset), has_near = !isnan(input->near);
    bool moves = row->step > 0;
    if (isfinite(input->far) && !has_offset) {
        return fail(error, ERROR_USAGE, "{--far} needs {--offset}: parallax is against it");
    }
    if (has_offset && has_near && moves) {
        if (!panorama_parallax(input->offset, row->step, input->near, input->far, &row->parallax,
                               error)) {
            return false;
        }
        row->parallax_pixels = row->parallax * per_radian;
    }
    if (isnan(per_radian) && has_offset != has_near) {
        return fail(error, ERROR_USAGE,
                    "{--%s} alone asks for what stays within {--tolerance}, in pixels: give "
                    "{--pixels}, or a camera as {--sensor}",
                    has_near ? "near" : "offset");
    }
    double allowed = input->tolerance / per_radian;
    if (isnan(allowed) || !moves) {
        return true;
    }
    return (!has_near ||
            panorama_offset(allowed, row->step, input->near, &row->most_offset, error)) &&
           (!has_offset || !(fabs(input->offset) > 0) ||
            panorama_nearest(input->offset, allowed, row->step, &row->nearest, error));
}

static bool panorama_emit_rows(const struct panorama_input *input, const struct panorama_goal *goal,
                               const struct panorama *plan, struct panorama_command_row *row,
                               struct run *run, struct error *error)
{
    for (int i = 0; i < plan->rows; i++) {
        struct panorama_row one;
        if (!panorama_row_at(&row->frame, goal, plan, input->elevation, i, &one, error)) {
            return false;
        }
        row->row = i + 1;
        row->elevation = one.elevation;
        row->columns = one.columns;
        row->step = one.step;
        if (!run_emit(run, row)) {
            return true;
        }
    }
    return true;
}

static bool panorama_run(const void *data, struct run *run, struct error *error)
{
    const struct panorama_input *input = data;
    struct panorama_goal goal = {input->arc, input->span, input->overlap};
    double pixels = frame_pixels(input);
    struct panorama plan;
    struct panorama_command_row row = {
        .focal = input->focal.length,
        .distance = input->distance,
        .size = {NAN, NAN, NAN, NAN, NAN},
        .arc = input->arc,
        .offset = input->offset,
        .parallax = NAN,
        .parallax_pixels = NAN,
        .most_offset = NAN,
        .nearest = NAN,
        .pupil_distance = NAN,
        .pupil = input->pupil,
        .sensor = isnan(input->focal.length) ? NULL : input->sensor.name,
        .held = input->portrait ? "portrait" : "landscape",
        .dpi = input->dpi,
        .cylinder = "a cylinder",
    };
    if (!find_frame(input, &row, error) ||
        !panorama_take_print(input, &row, pixels, &goal, error) ||
        !panorama_plan(&row.frame, &goal, &plan, error) ||
        (input->rows > 0 &&
         !panorama_set_rows(&row.frame, &goal, (int)input->rows, &plan, error))) {
        return false;
    }
    row.arc = goal.arc;
    row.span = goal.span;
    if (input->each_row) {
        if (input->per_row > 0) {
            return fail(error, ERROR_USAGE,
                        "{--each-row} chooses the frames of each row itself: no "
                        "{--per-row} with it");
        }
        return panorama_emit_rows(input, &goal, &plan, &row, run, error);
    }
    if (!set_columns(input, &row.frame, &plan, error) ||
        (pixels > 0 && !panorama_size(&row.frame, &goal, pixels, &row.size, error))) {
        return false;
    }
    row.columns = plan.columns;
    row.rows = plan.rows;
    row.shots = plan.shots;
    row.step = plan.step > 0 ? plan.step : NAN;
    row.row_step = plan.rows > 1 ? plan.row_step : NAN;
    row.overlap = plan.overlap;
    row.row_overlap = plan.row_overlap;
    if (!find_parallax(input, &row, error)) {
        return false;
    }
    run_emit(run, &row);
    return true;
}

static const struct explanation explanations[] = {
    {"horizontal", "h = 2 atan(w/(2 {f} (1 + m/{P})))", "[Ray02] ch. 24; rectilinear", NULL},
    {"columns", "n = ceil({A}/({h} (1 - overlap)))", "a closed turn; an arc needs one overlap less",
     "of the overlap that is asked for"},
    {"step", "d = {A}/{n}", "a closed turn; (A - h)/(n - 1) for an arc", NULL},
    {"overlap", "o = 1 - {d}/{h}", "what the even steps achieve", NULL},
    {"parallax", "p = 2 (b(near) - b(far)), tan b(x) = {e} sin({d}/2)/(x - {e} cos({d}/2))",
     "[Littlefield06]", "for things in the middle of the overlap"},
    {"pupil_from_sensor", "D = {f} (1 + m) + hiatus + {f} (1 - 1/{P})", "[Littlefield06] thin lens",
     "a start: real lenses want a test with two rods"},
    {NULL, NULL, NULL, NULL},
};

static const struct example examples[] = {
    {"panorama -f 24 --portrait", "a full turn with a 24 mm lens on 35 mm film"},
    {"panorama -f 50 --portrait --arc 120deg --sensor \"Nikon D1\"", "an arc, with pixels"},
    {"panorama -f 20 --portrait --span 180deg --each-row", "the whole sphere, row by row"},
    {"panorama 50mm --sensor \"Canon 5D Mark II\" --print 3x2m",
     "how many frames a print of 300 dpi takes"},
    {"panorama -f 100 --arc 60deg --rows 3", "three rows: how high they reach"},
    {"panorama -f 35 --offset 10mm --near 1m --pixels 6000", "off the no-parallax point"},
    {"panorama --horizontal 100deg --vertical 140deg", "a fisheye held upright"},
    {"panorama -f 14,20,24,35,50 --portrait --overlap 20%,30%,50% --table f,overlap:columns",
     "a table to print"},
    {NULL, NULL},
};

const struct command command_panorama = {
    .name = "panorama",
    COMMAND_OF("photography", "frames, steps and size of a panorama, and parallax"),
    .run = panorama_run,
    .choose_sheet = panorama_choose_sheet,
    .sheets = sheets,
    .makes_many = panorama_makes_many,
    .plot = "shots|columns",
    .plot_titles = "Exposures of a panorama|Exposures in a row",
    .cell = "shots",
};
