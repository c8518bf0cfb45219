/* commands/photo/fov_answer.c - answers of lenscalc fov. */
/* SPDX-License-Identifier: MIT */
#include "analysis/rays/angle_of_view.h"
#include "commands/lens/focus_gaps.h"
#include "commands/photo/attachments.h"
#include "commands/photo/crop.h"
#include "commands/photo/fov_question.h"
#include "photo/pixel_density.h"

#include "base/constants.h"

#include <math.h>

const struct word fov_ways[] = {
    [VIEW_AUTO] = {"auto", "chief-rays with --lens, unless --pupil or --converter is given; else "
                           "rectilinear"},
    [VIEW_RAYS] = {"chief-rays", "the exact chief rays of --lens"},
    {"rectilinear", "f tan t: straight lines stay straight"},
    {"equidistant", "f t: image height in proportion to the angle"},
    {"equisolid", "2 f sin(t/2): image area in proportion to the solid angle"},
    {"stereographic", "2 f tan(t/2): small shapes stay true"},
    {"orthographic", "f sin t: at most a half sphere"},
    {NULL, NULL},
};

/* What a problem was solved for; null: nothing. */
static const char *const unknowns[] = {
    [FOV_FOCAL_LENGTH] = "focal length", [FOV_DISTANCE] = "distance", [FOV_SENSOR] = "sensor"};

static void fov_warn(struct fov_row *row, const char *warning, struct arena *arena)
{
    row->real.warning = lens_warnings_join(row->real.warning, warning, arena);
}

/* Angles by the lens's own rays? Not where the user puts another pupil in place of its own. */
static bool wants_rays(const struct fov_input *input, const struct photo_lens *lens)
{
    return input->projection == VIEW_RAYS ||
           (input->projection == VIEW_AUTO && lens->lens != NULL && isnan(input->lens.pupil) &&
            isnan(input->converter));
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
    if (!isnan(input->lens.pupil) || !isnan(input->converter)) {
        return fail(error, ERROR_USAGE,
                    "{--projection} chief-rays goes by the lens's own rays: it excludes {--%s}",
                    isnan(input->converter) ? "pupil" : "converter");
    }
    if (!trace_view(input, lens, row->setting.s, row->image, arena, &view, error)) {
        return false;
    }
    row->fov = (struct fov){view.horizontal.angle,        view.vertical.angle, view.diagonal.angle,
                            view.horizontal.size,         view.vertical.size,  view.diagonal.size,
                            fov_kind(view.diagonal.angle)};
    row->projection = fov_ways[VIEW_RAYS].word;
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

/* How far the subject is from the front principal plane, and a thin lens's f if that settles it. */
static bool find_subject(const struct fov_input *input, const struct photo_lens *lens,
                         struct fov_problem *problem, struct error *error)
{
    const bool both = !isnan(input->magnification) && !isinf(input->distance);
    const bool near = !isnan(input->magnification) && !both;
    bool elsewhere = input->lens.from != FROM_PRINCIPAL && !isinf(input->distance);
    double *s = &problem->setting.s, goal;
    *s = input->distance;
    if (elsewhere && isnan(lens->f) && input->lens.from == FROM_SENSOR &&
        fov_goals_fields(&problem->goals) > 0) {
        problem->unknown = FOV_FOCAL_LENGTH;
        return fov_goal_magnification(problem, &goal, &problem->by, error) &&
               fov_focal_length_from_sensor(goal, input->distance, &problem->setting.f, s, error);
    }
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
    row->ground = (struct fov_ground){input->altitude, input->gsd, NAN, NAN};
    if (isnan(input->altitude) && isnan(input->gsd) && isfinite(row->setting.s)) {
        row->ground.sample = row->pitch * input->squeeze / row->magnification; /* straight ahead */
    }
    if (run_shows(run, offsetof(struct fov_row, sky.scale)) ||
        run_shows(run, offsetof(struct fov_row, density)) ||
        run_shows(run, offsetof(struct fov_row, object_pixel)) ||
        run_shows(run, offsetof(struct fov_row, ground.sample))) {
        sharpness_doubt_pitch(&(struct sharpness){.sensor = input->sensor, .pitch = NAN},
                              run->doubts);
    }
    if (isnan(input->altitude) && isnan(input->gsd)) {
        return true;
    }
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

/* The sensor with its pixels; one that is open has the shape of its pixels, or of 35 mm film. */
static bool settle_sensor(struct fov_input *input, bool is_open, struct run *run,
                          struct error *error)
{
    const struct pixels_question pixels = {input->pixels, input->pitch, input->line_scan};
    struct sensor_value *sensor = &input->sensor;
    if (!is_open || !isnan(input->pitch) || input->line_scan || !pixels_given(&input->pixels)) {
        if (!pixels_settle(&pixels, sensor, run->arena, run->doubts, error)) {
            return false;
        }
        const struct sensor_value whole = *sensor;
        return crop_sensor(&whole, input->crop, run->arena, sensor, error);
    }
    if (isnan(input->pixels.high)) {
        return fail(error, ERROR_USAGE,
                    "{--pixels} of a sensor that is solved for needs both numbers, as in "
                    "2448x2048");
    }
    sensor->size.width = sensor->size.height * (input->pixels.wide / input->pixels.high);
    return true;
}

/* A sensor that is found by both sides of a field has their shape. */
static bool fov_check_portrait(const struct fov_input *input, bool is_open,
                               const struct fov_goals *goals, struct error *error)
{
    const bool is_shaped = is_open && !isnan(goals->field_width) && !isnan(goals->field_height);
    return !input->portrait || !is_shaped ||
           fail(error, ERROR_USAGE,
                "{--portrait} says nothing here: the sensor that is found has the shape of the "
                "field");
}

/* Who asks for an angle may mean that of the view. */
static bool fov_hint(const struct fov_input *input, const struct photo_lens *lens,
                     const struct fov_row *row, struct error *error)
{
    if (isnan(lens->f) && !isnan(input->sky.angle)) {
        return error_hint(error, "an angle of view is {--horizontal}, {--vertical} or "
                                 "{--diagonal}; {--subject-angle} with {--subject-size} gives a "
                                 "distance");
    }
    return photo_lens_hint_virtual(lens, row->setting.s, error);
}

/* Of pixels of no known size no length is known. */
static void fov_forget_lengths(const struct fov_input *input, struct fov_row *row,
                               struct arena *arena)
{
    if (input->is_bare) {
        row->focal = row->setting.f = row->width = row->height = row->pitch = row->image = NAN;
        row->magnification = row->crop = row->setting.P = row->sky.image = NAN;
        row->sensor = arena_printf(arena, "%.15g x %.15g pixels of any size", input->pixels.wide,
                                   input->pixels.high);
    }
}

/* What is open of lens, distance and sensor, by the goals that are given. */
static bool solve_view(struct fov_input *input, const struct photo_lens *lens, struct run *run,
                       struct fov_row *row, struct error *error)
{
    struct fov_problem problem = {
        .setting = row->setting,
        .goals = fov_input_goals(input),
        .sensor_is_open = input->sensor.is_fallback && isnan(input->pitch) && !input->line_scan &&
                          isnan(input->crop),
    };
    const bool is_open = problem.sensor_is_open && !isnan(lens->f) && !isnan(row->setting.s) &&
                         (!isinf(input->distance) || !isnan(input->magnification)) &&
                         fov_goals_fields(&problem.goals) > 0;
    if (!fov_check_portrait(input, is_open, &problem.goals, error) ||
        !settle_sensor(input, is_open, run, error)) {
        return false;
    }
    problem.sensor = input->sensor.size;
    const struct sharpness pixels = {.sensor = input->sensor, .pitch = input->pitch};
    if (!sky_focal_length(&input->sky, sharpness_pitch(&pixels), &problem.setting, error) ||
        !find_subject(input, lens, &problem, error)) {
        return false;
    }
    if (problem.unknown == FOV_GIVEN && !fov_solve(&problem, error)) {
        return false;
    }
    row->setting = problem.setting;
    row->solved_for = unknowns[problem.unknown];
    row->solved_by = fov_goals_fields(&problem.goals) > 1 ? problem.by : NULL;
    if (problem.unknown == FOV_SENSOR) {
        const bool is_shaped = !pixels_given(&input->pixels) && (isnan(problem.goals.field_width) ||
                                                                 isnan(problem.goals.field_height));
        input->sensor.size = problem.sensor;
        input->sensor.size.pitch = problem.sensor.width / input->pixels.wide;
        input->sensor.name =
            arena_printf(run->arena, "%.6g x %.6g mm%s", problem.sensor.width,
                         problem.sensor.height, is_shaped ? " (its shape, 3:2, assumed)" : "");
    }
    return true;
}

static bool fov_answer(const void *data, const struct photo_lens *bare, struct run *run,
                       struct error *error)
{
    struct fov_input own = *(const struct fov_input *)data;
    const struct fov_input *input = &own;
    const struct attachments attachments = {NAN, NAN, input->converter};
    struct photo_lens room;
    struct attached_lens attached;
    if (!attachments_apply(&attachments, bare, &room, &attached, error)) {
        return false;
    }
    const struct photo_lens *lens = attached.lens;
    bool chosen = input->projection >= VIEW_PROJECTIONS;
    struct fov_row row = fov_row_none;
    row.setting = (struct fov_setting){
        (enum projection)(chosen ? input->projection - VIEW_PROJECTIONS : RECTILINEAR), lens->f,
        input->distance, lens->P, input->squeeze};
    row.projection = fov_ways[chosen ? input->projection : VIEW_PROJECTIONS].word;
    row.from = isinf(input->distance) ? NULL : distances_from[input->lens.from].word;
    row.task = input->task > 0 ? fov_tasks[input->task].word : NULL;
    row.real = *lens->real;
    row.rays = by_rays_none;
    row.converter = input->converter;
    row.real.hiatus = lens->measuring.hiatus;
    if (input->task > 0) {
        own.density = viewing_tasks[input->task - 1].density;
    }
    if (!solve_view(&own, lens, run, &row, error) ||
        !photo_lens_check_subject(lens, row.setting.s, error) ||
        !fov_compute(&row.setting, &input->sensor.size, &row.fov, error)) {
        return fov_hint(input, lens, &row, error);
    }
    if (input->is_pair) {
        row.solved_for = "distance and focal length";
    }
    row.focal = isnan(input->converter) ? row.setting.f : attached.focal;
    row.width = input->sensor.size.width;
    row.height = input->sensor.size.height;
    row.pitch = input->sensor.size.pitch;
    row.sensor = input->sensor.name;
    row.image = distance_image(row.setting.f, row.setting.s);
    if (input->position != NULL) {
        row.real.position = input->position;
    }
    row.magnification = row.setting.f / (row.setting.s - row.setting.f);
    if ((input->lens.rays.exact &&
         !place_film(input, lens, &row.setting.s, run, &row.image, &row.rays, error)) ||
        (wants_rays(input, lens) && !look_by_rays(input, lens, run, &row, error)) ||
        !fill_ground(input, &row, run, error) || !fov_fill_pixels(input, &row, error) ||
        !sky_fill(&input->sky, &row.setting, &input->sensor.size, row.pitch, &row.sky, error)) {
        return false;
    }
    row.magnification = row.setting.f / (row.setting.s - row.setting.f);
    row.crop = sensor_crop(&input->sensor.size);
    row.fx = fov_scale(&row.setting) / (row.pitch * input->squeeze);
    row.per_degree = row.fx * RADIANS_PER_DEGREE;
    fov_forget_lengths(input, &row, run->arena);
    row.sensor_distance = row.setting.s + row.image + lens->measuring.hiatus;
    run_emit(run, &row);
    return true;
}

/* One answer, or one for each task. */
static bool fov_tasks_answer(const void *data, const struct photo_lens *lens, struct run *run,
                             struct error *error)
{
    const struct fov_input *input = data;
    if (!input->dori) {
        return fov_answer(input, lens, run, error);
    }
    for (int task = 1; task <= DORI_TASKS; task++) {
        struct fov_input own = *input;
        own.task = task;
        if (!fov_answer(&own, lens, run, error)) {
            return false;
        }
    }
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

/* Does the camera's own lens settle the focal length, as nothing else does? */
static bool has_camera_lens(const struct fov_input *input)
{
    const struct fov_goals goals = fov_input_goals(input);
    const bool is_angle = !isnan(goals.horizontal) || !isnan(goals.vertical) ||
                          !isnan(goals.diagonal) || !isnan(input->sky.scale);
    const bool is_field = fov_goals_fields(&goals) > 0 || input->task > 0 || input->dori;
    return !isnan(input->sensor.focal) && isnan(input->lens.focal.length) &&
           input->lens.lens.lens == NULL && !is_angle && (!is_field || isinf(input->distance));
}

bool fov_run(const void *data, struct run *run, struct error *error)
{
    struct fov_input own = *(const struct fov_input *)data;
    const struct fov_input *input = &own;
    const size_t *positions;
    size_t count;
    if (input->telecentric) {
        return fov_telecentric(input, run, error);
    }
    if (fov_is_bare(input)) {
        fov_hold_upright(&own, run->arena);
        return fov_bare(input, run, error);
    }
    const bool is_pair = fov_take_pair(&own);
    fov_hold_upright(&own, run->arena);
    if (!fov_take_pixels(&own, error)) {
        return false;
    }
    if (!is_pair && has_camera_lens(input)) {
        own.lens.focal.length = input->sensor.focal;
    }
    if (input->gap == NULL || input->lens.lens.lens == NULL) {
        return photo_lens_each(&input->lens, 0, run, fov_tasks_answer, input, error);
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
