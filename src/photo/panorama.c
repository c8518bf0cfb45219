/* photo/panorama.c - how many frames a panorama takes, its size, and parallax. */
/* SPDX-License-Identifier: MIT */
#include "photo/panorama.h"

#include "base/constants.h"
#include "photo/given.h"

#include <math.h>

static const double most_frames = 1e6;

/* Above 0 (or from 0 on) up to `most`, with the slack of degrees turned into radians. */
static bool panorama_check_angle(double angle, bool zero, double most, const char *name,
                                 struct error *error)
{
    return ((angle > 0 || (zero && angle >= 0)) && angle <= most * (1 + 1e-12)) ||
           fail(error, ERROR_DOMAIN, "{%s} %g degrees is out of range (%s 0, up to %g)", name,
                degrees_from_radians(angle), zero ? "from" : "above", degrees_from_radians(most));
}

static bool panorama_check_flat(const struct panorama_frame *frame, struct error *error)
{
    return (frame->horizontal > 0 && frame->horizontal < PI && frame->vertical > 0 &&
            frame->vertical < PI) ||
           fail(error, ERROR_DOMAIN,
                "a flat frame of %g x %g degrees is out of range (above 0, below 180)",
                degrees_from_radians(frame->horizontal), degrees_from_radians(frame->vertical));
}

static bool panorama_check_lens(double m, double P, struct error *error)
{
    return check_not_negative("magnification", "", m, error) &&
           check_positive("pupil magnification", "", P, error);
}

static bool is_closed(double arc)
{
    return arc > 2 * PI * (1 - 1e-12); /* 360 degrees after conversion */
}

bool panorama_frame(double f, double m, double P, double width, double height,
                    struct panorama_frame *frame, struct error *error)
{
    if (!check_positive("focal length", " mm", f, error) || !panorama_check_lens(m, P, error) ||
        !check_positive("sensor width", " mm", width, error) ||
        !check_positive("sensor height", " mm", height, error)) {
        return false;
    }
    double reach = 2 * f * (1 + m / P);
    *frame = (struct panorama_frame){.horizontal = 2 * atan(width / reach),
                                     .vertical = 2 * atan(height / reach)};
    return true;
}

/* How many frames of an angle cover a total, and their even step. */
static bool count_frames(double angle, double total, double overlap, bool closed, int *count,
                         double *step, struct error *error)
{
    double advance = angle * (1 - overlap);
    double exact = closed ? total / advance : (total - angle * overlap) / advance;
    double n = fmax(1, ceil(exact - 1e-9)); /* rounding must not cost a frame */
    if (!(n <= most_frames)) {
        return fail(error, ERROR_DOMAIN,
                    "%g frames a row are out of range (up to %g: a wider frame, less overlap)", n,
                    most_frames);
    }
    *count = (int)n;
    if (closed) {
        *step = total / n;
    } else if (n > 1) {
        *step = (total - angle) / (n - 1);
    } else {
        *step = 0;
    }
    return true;
}

static bool panorama_check_goal(const struct panorama_frame *frame,
                                const struct panorama_goal *goal, struct error *error)
{
    return (panorama_check_angle(frame->horizontal, false, 2 * PI, "horizontal angle of view",
                                 error) &&
            panorama_check_angle(frame->vertical, false, 2 * PI, "vertical angle of view", error) &&
            panorama_check_angle(goal->arc, false, 2 * PI, "arc", error) &&
            panorama_check_angle(goal->span, true, PI, "span", error)) &&
           ((goal->overlap >= 0 && goal->overlap < 1) ||
            fail(error, ERROR_DOMAIN, "{overlap} %g is out of range (0 up to below 1)",
                 goal->overlap));
}

bool panorama_plan(const struct panorama_frame *frame, const struct panorama_goal *goal,
                   struct panorama *plan, struct error *error)
{
    bool closed = is_closed(goal->arc);
    struct panorama p = {0};
    if (!panorama_check_goal(frame, goal, error) ||
        !count_frames(frame->horizontal, closed ? 2 * PI : goal->arc, goal->overlap, closed,
                      &p.columns, &p.step, error) ||
        !count_frames(frame->vertical, goal->span, goal->overlap, false, &p.rows, &p.row_step,
                      error)) {
        return false;
    }
    if (!((double)p.columns * p.rows <= most_frames)) {
        return fail(error, ERROR_DOMAIN, "%d x %d frames are out of range (up to %g)", p.columns,
                    p.rows, most_frames);
    }
    p.shots = p.columns * p.rows;
    p.overlap = closed || p.columns > 1 ? 1 - p.step / frame->horizontal : (double)NAN;
    p.row_overlap = p.rows > 1 ? 1 - p.row_step / frame->vertical : (double)NAN;
    *plan = p;
    return true;
}

bool panorama_set_rows(const struct panorama_frame *frame, struct panorama_goal *goal, int rows,
                       struct panorama *plan, struct error *error)
{
    double v = frame->vertical;
    if (rows < 1 || !((double)plan->columns * rows <= most_frames)) {
        return fail(error, ERROR_DOMAIN,
                    "%d rows of %d frames are out of range (1 row or more, up to %g frames)", rows,
                    plan->columns, most_frames);
    }
    if (!(goal->span > 0) && rows > 1) {
        goal->span = fmin(PI, v * (1 + (rows - 1) * (1 - goal->overlap)));
    }
    double beyond = fmax(goal->span - v, 0);
    plan->rows = rows;
    plan->shots = plan->columns * rows;
    plan->row_step = rows > 1 ? beyond / (rows - 1) : 0;
    plan->row_overlap = rows > 1 ? 1 - plan->row_step / v : (double)NAN;
    return goal->span <= rows * v * (1 + 1e-12) ||
           fail(error, ERROR_DOMAIN,
                "{number of rows} %d leaves gaps: at least %g for {span} %g degrees", rows,
                ceil(goal->span / v - 1e-9), degrees_from_radians(goal->span));
}

bool panorama_overlap(const struct panorama_frame *frame, double arc, int columns, double *overlap,
                      struct error *error)
{
    if (!panorama_check_angle(frame->horizontal, false, 2 * PI, "horizontal angle of view",
                              error) ||
        !panorama_check_angle(arc, false, 2 * PI, "arc", error)) {
        return false;
    }
    if (columns < 1) {
        return fail(error, ERROR_DOMAIN, "number of columns %d is out of range (1 or more)",
                    columns);
    }
    double h = frame->horizontal;
    double step = columns > 1 ? (arc - h) / (columns - 1) : (double)NAN;
    step = is_closed(arc) ? 2 * PI / columns : step;
    *overlap = 1 - step / h;
    return true;
}

bool panorama_row_at(const struct panorama_frame *frame, const struct panorama_goal *goal,
                     const struct panorama *plan, double middle, int index,
                     struct panorama_row *row, struct error *error)
{
    if (!panorama_check_flat(frame, error) || !panorama_check_goal(frame, goal, error)) {
        return false;
    }
    if (index < 0 || index >= plan->rows) {
        return fail(error, ERROR_DOMAIN, "row %d is out of range (0 to %d)", index, plan->rows - 1);
    }
    double elevation = middle + (index - (plan->rows - 1) / 2.0) * plan->row_step;
    if (!(fabs(elevation) <= PI / 2 + 1e-9)) {
        return fail(error, ERROR_DOMAIN, "row at %g degrees is out of range (-90 to 90)",
                    degrees_from_radians(elevation));
    }
    row->elevation = elevation;
    if (fabs(elevation) > PI / 2 - 1e-9) { /* the pole in the middle of the frame */
        row->columns = 1;
        row->step = 0;
        return true;
    }
    double half = plan->row_step / 2;
    double forward = cos(fabs(elevation) - half) / cos(half);
    double angle = 2 * atan(tan(frame->horizontal / 2) / forward);
    bool closed = is_closed(goal->arc);
    return count_frames(angle, closed ? 2 * PI : goal->arc, goal->overlap, closed, &row->columns,
                        &row->step, error);
}

bool panorama_size(const struct panorama_frame *frame, const struct panorama_goal *goal,
                   double pixels, struct panorama_size *size, struct error *error)
{
    if (!panorama_check_flat(frame, error) || !panorama_check_goal(frame, goal, error) ||
        !check_positive("pixels of a frame", "", pixels, error)) {
        return false;
    }
    double per_radian = pixels / (2 * tan(frame->horizontal / 2));
    double arc = fmax(goal->arc, fmin(frame->horizontal, 2 * PI));
    double span = fmax(goal->span, frame->vertical);
    *size = (struct panorama_size){
        .per_degree = per_radian * RADIANS_PER_DEGREE,
        .width = arc * per_radian,
        .sphere_height = span * per_radian,
        .cylinder_height = span < PI ? 2 * tan(span / 2) * per_radian : (double)INFINITY,
        .flat_width = arc < PI ? 2 * tan(arc / 2) * per_radian : (double)INFINITY};
    return true;
}

bool panorama_goal_of_size(const struct panorama_frame *frame, double pixels, double width,
                           double height, struct panorama_goal *goal, struct error *error)
{
    if (!panorama_check_flat(frame, error) ||
        !check_positive("pixels of a frame", "", pixels, error) ||
        !check_positive("width of the print", " pixels", width, error) ||
        !check_positive("height of the print", " pixels", height, error)) {
        return false;
    }
    const double per_radian = pixels / (2 * tan(frame->horizontal / 2));
    goal->arc = width / per_radian;
    goal->span = 2 * atan(height / (2 * per_radian));
    return goal->arc <= 2 * PI ||
           fail(error, ERROR_DOMAIN,
                "a print %.0f pixels wide is more than a full turn, which has %.0f: a longer "
                "{focal length}, or fewer pixels an inch by {dpi}",
                width, 2 * PI * per_radian);
}

/* How far a thing at distance D seems turned, seen from the pupil, rad. */
static double apparent_turn(double e, double half, double D)
{
    return isinf(D) ? 0 : atan2(e * sin(half), D - e * cos(half));
}

bool panorama_parallax(double offset, double step, double near, double far, double *parallax,
                       struct error *error)
{
    double e = fabs(offset);
    if (!panorama_check_angle(step, false, PI, "step", error)) {
        return false;
    }
    if (!(near > e && isfinite(near))) {
        return fail(
            error, ERROR_DOMAIN,
            "{nearest point} %g mm lies within the circle of the entrance pupil (more than the "
            "offset %g mm)",
            near, e);
    }
    if (!(far >= near)) {
        return fail(error, ERROR_DOMAIN,
                    "{farthest point} %g mm lies before {the nearest point} %g mm (%g mm or more)",
                    far, near, near);
    }
    *parallax = 2 * (apparent_turn(e, step / 2, near) - apparent_turn(e, step / 2, far));
    return true;
}

static bool check_parallax(double parallax, double step, struct error *error)
{
    return panorama_check_angle(step, false, PI, "step", error) &&
           ((parallax > 0 && parallax < PI - step) ||
            fail(error, ERROR_DOMAIN, "parallax of %g degrees is out of range (above 0, below %g)",
                 degrees_from_radians(parallax), degrees_from_radians(PI - step)));
}

bool panorama_offset(double parallax, double step, double near, double *offset, struct error *error)
{
    if (!check_parallax(parallax, step, error) ||
        !check_positive("nearest point", " mm", near, error)) {
        return false;
    }
    *offset = near * sin(parallax / 2) / sin(step / 2 + parallax / 2); /* law of sines */
    return true;
}

bool panorama_nearest(double offset, double parallax, double step, double *near,
                      struct error *error)
{
    *near = fabs(offset) * sin(step / 2 + parallax / 2) / sin(parallax / 2);
    return check_parallax(parallax, step, error) &&
           check_positive("offset", " mm", fabs(offset), error);
}

bool panorama_pupil(double f, double m, double P, double hiatus, double *distance,
                    struct error *error)
{
    *distance = f * (1 + m) + hiatus + f * (1 - 1 / P);
    return check_positive("focal length", " mm", f, error) && panorama_check_lens(m, P, error) &&
           check_finite("hiatus", " mm", hiatus, error);
}
