/* cli/trace_answer.c - the rays that lenscalc trace is asked for. */
/* SPDX-License-Identifier: MIT */
#include "commands/lens/trace_answer.h"

#include "trace/aim.h"
#include "trace/clear.h"
#include "trace/dispatch.h"
#include "trace/follow.h"
#include "trace/verify.h"

#include <string.h>

enum { CHUNK = 8 * RAYS_BLOCK };

/* The rays of a field point that are traced unless a pattern is asked for. */
static const struct {
    const char *name;
    struct pupil_point point;
} few[] = {
    {"chief", {0, 0, 1}}, {"upper", {0, 1, 1}}, {"lower", {0, -1, 1}}, {"sagittal", {1, 0, 1}}};

enum { FEW = sizeof few / sizeof few[0] };

static struct trace_row blank_row(const struct ray_case *one, double wavelength)
{
    return (struct trace_row){
        .position = one->position,
        .focus = one->to_image ? one->focus : NULL,
        .image = one->to_image ? one->image : (double)NAN,
        .lens = one->lens->title,
        .warning = one->warning,
        .wavelength = lens_wavelength_own(wavelength),
        .field = NAN,
        .height = NAN,
        .pupil = {NAN, NAN},
        .weight = NAN,
        .incidence = NAN,
        .refraction = NAN,
        .paraxial = {NAN, NAN},
        .slope = {NAN, NAN},
        .point_error = NAN,
        .cosine_error = NAN,
        .path_error = NAN,
        .surface = NO_INTEGER,
    };
}

bool trace_job_open(const struct trace_input *input, const struct ray_case *one, double wavelength,
                    struct arena *arena, struct trace_job *job, struct error *error)
{
    *job = (struct trace_job){.input = input, .one = one, .wavelength = wavelength};
    if (!ray_case_compile(one, wavelength, one->clip, one->to_image, arena, &job->system, error)) {
        return false;
    }
    job->to = one->to_image ? job->system.places : one->surfaces;
    job->n_end = system_index_after(&job->system, job->to - 1);
    job->blank = blank_row(one, wavelength);
    return true;
}

/* Where a ray is, or that it is lost. */
static void set_end(const struct trace_job *job, const struct ray *ray, bool at_image,
                    struct trace_row *row)
{
    bool arrived = ray->status == RAY_OK;
    for (int i = 0; i < 3; i++) {
        row->point[i] = arrived ? ray->point[i] : (double)NAN;
        row->cosine[i] = arrived ? ray->cosine[i] : (double)NAN;
    }
    if (at_image && arrived) {
        row->point[2] += job->one->image; /* in the frame of the last vertex */
    }
    row->path = arrived ? ray->path : (double)NAN;
    row->status = ray_status_name(ray->status);
    row->surface = arrived ? NO_INTEGER : (long)ray->surface;
}

void trace_row_end(const struct trace_job *job, const struct ray_block *block, size_t lane,
                   struct trace_row *row)
{
    const struct rays rays = {(struct ray_block *)(uintptr_t)block, RAYS_BLOCK};
    double n =
        job->to > 0 ? system_index_after(&job->system, job->to - 1) : job->system.index_first;
    struct ray ray = rays_get(&rays, lane, n);
    set_end(job, &ray, job->one->to_image, row);
}

/* The paraxial ray where the row is. */
static bool set_paraxial(const struct trace_job *job, const struct ray *start, size_t place,
                         struct arena *arena, struct trace_row *row, struct error *error)
{
    const struct lens *lens = job->one->lens;
    struct paraxial_meeting *meetings =
        ARENA_ARRAY(arena, lens->surface_count, struct paraxial_meeting);
    if (!ray_follow_paraxially(lens, job->wavelength, start, arena, meetings, error)) {
        return false;
    }
    bool at_image = place >= lens->surface_count;
    const struct paraxial_meeting *here = &meetings[at_image ? lens->surface_count - 1 : place];
    double distance = at_image ? job->one->image : 0;
    row->slope[0] = here->slope_x;
    row->slope[1] = here->slope_y;
    row->paraxial[0] = here->x + distance * here->slope_x;
    row->paraxial[1] = here->y + distance * here->slope_y;
    return true;
}

/* Only rays that go all the way can be verified. */
static void set_errors(const struct trace_job *job, const struct ray *start, size_t place,
                       struct trace_row *row)
{
    if (place + 1 != job->system.places) {
        return;
    }
    struct ray tested = {.path = row->path, .status = isnan(row->path) ? RAY_MISS : RAY_OK};
    for (int i = 0; i < 3; i++) {
        tested.point[i] = row->point[i];
        tested.cosine[i] = row->cosine[i];
    }
    if (job->one->to_image) {
        tested.point[2] -= job->one->image;
    }
    struct verification check = verify_ray(&job->system, start, &tested);
    row->point_error = check.point_error;
    row->cosine_error = check.cosine_error;
    row->path_error = check.path_error;
}

bool trace_row_extras(const struct trace_job *job, const struct ray *start, size_t place,
                      struct arena *arena, struct trace_row *row, struct error *error)
{
    if (job->input->verify) {
        set_errors(job, start, place, row);
    }
    return !job->input->paraxial || set_paraxial(job, start, place, arena, row, error);
}

/* One row a surface. False with `error` set, or if no more rows are wanted. */
static bool emit_all(const struct trace_job *job, const struct ray *start, struct trace_row *row,
                     struct run *run, struct error *error)
{
    struct ray_meeting *meetings = ARENA_ARRAY(run->arena, job->system.places, struct ray_meeting);
    ray_follow(&job->system, start, run->arena, meetings);
    for (size_t place = 0; place < job->to; place++) {
        set_end(job, &meetings[place].ray, place >= job->one->lens->surface_count, row);
        row->surface = (long)place + 1;
        row->incidence = meetings[place].angles.incidence;
        row->refraction = meetings[place].angles.refraction;
        if (!trace_row_extras(job, start, place, run->arena, row, error) || !run_emit(run, row)) {
            return false;
        }
    }
    return true;
}

/* A ray that never started: the search for it was lost there. */
static bool emit_lost(const struct trace_job *job, const struct ray *start, struct trace_row *row,
                      struct run *run)
{
    for (int i = 0; i < 3; i++) {
        row->start[i] = row->start_cosine[i] = NAN;
    }
    set_end(job, start, false, row);
    return run_emit(run, row);
}

/* Rays that share everything but their start. */
struct bundle {
    const struct trace_job *job;
    double field, height;
    const struct pupil_point *points; /* null: a ray as given */
    bool is_named;                    /* the rays of `few` */
};

static void label_row(const struct bundle *bundle, size_t i, struct trace_row *row)
{
    row->field = bundle->field;
    row->height = bundle->height;
    if (bundle->points != NULL) {
        row->pupil[0] = bundle->points[i].x;
        row->pupil[1] = bundle->points[i].y;
        row->weight = bundle->points[i].weight;
        row->ray = bundle->is_named ? few[i].name : NULL;
    }
}

static bool emit_bundle(const struct bundle *bundle, const struct ray *starts, size_t first,
                        size_t count, struct run *run, struct error *error)
{
    const struct trace_job *job = bundle->job;
    struct rays rays = rays_new(run->arena, count);
    for (size_t i = 0; i < count; i++) {
        rays_set(&rays, i, job->system.index_first, &starts[i]);
    }
    rays_trace_part(&job->system, 0, job->to, &rays, NULL);
    for (size_t i = 0; i < count; i++) {
        const struct arena_mark mark = arena_mark(run->arena);
        struct trace_row row;
        bool going;
        trace_row_begin(job, &starts[i], &row);
        label_row(bundle, first + i, &row);
        if (starts[i].status != RAY_OK) {
            going = emit_lost(job, &starts[i], &row, run);
        } else if (job->input->all) {
            going = emit_all(job, &starts[i], &row, run, error);
        } else {
            trace_row_end(job, &rays.blocks[i / RAYS_BLOCK], i % RAYS_BLOCK, &row);
            going = trace_row_extras(job, &starts[i], job->to - 1, run->arena, &row, error) &&
                    run_emit(run, &row);
        }
        if (!going) {
            return false;
        }
        arena_reset(run->arena, mark);
    }
    return true;
}

/* The points of the pupil that the input asks for. */
static bool choose_points(const struct trace_input *input, struct arena *arena,
                          struct sample *sample, struct error *error)
{
    if (input->pupil.is_given) {
        sample->count = 1;
        sample->points = ARENA_NEW(arena, struct pupil_point);
        *sample->points = (struct pupil_point){input->pupil.at[0], input->pupil.at[1], 1};
        return true;
    }
    if (input->pattern != TRACE_FEW) {
        return sample_make((enum pattern)(input->pattern - 1), (size_t)input->rays,
                           (uint64_t)input->seed, arena, sample, error);
    }
    sample->count = FEW;
    sample->points = ARENA_ARRAY(arena, FEW, struct pupil_point);
    for (size_t i = 0; i < FEW; i++) {
        sample->points[i] = few[i].point;
    }
    return true;
}

/* Where the rays to some points of the pupil start. */
static bool aim_starts(const struct trace_job *job, const struct beam *beam, const struct aim *aim,
                       const struct pupil_point *points, size_t count, struct ray *starts,
                       struct arena *arena, struct error *error)
{
    if (job->input->aim == AIM_STOP) {
        struct rays rays = rays_new(arena, count);
        aim_rays(aim, points, count, &rays);
        for (size_t i = 0; i < count; i++) {
            starts[i] = rays_get(&rays, i, beam->n);
        }
        return true;
    }
    for (size_t i = 0; i < count; i++) {
        if (!aim_at_entrance(beam, &job->one->first, points[i].x, points[i].y, &starts[i], error)) {
            return false;
        }
    }
    return true;
}

/* Where a ray crosses the stop, in units of its radius; NaN if it does not, or has none. */
static void find_pupil(const struct system *open, const struct ray *start, struct rays *work,
                       struct pupil_point *point)
{
    point->x = point->y = NAN;
    if (open->stop == LENS_NONE || isnan(open->stop_radius)) {
        return;
    }
    rays_set(work, 0, open->index_first, start);
    rays_trace_part(open, 0, system_place(open, open->stop) + 1, work, NULL);
    if (ray_block_status(work->blocks, 0) == RAY_OK) {
        point->x = work->blocks->x[0] / open->stop_radius;
        point->y = work->blocks->y[0] / open->stop_radius;
    }
}

static bool emit_sample(struct bundle *bundle, const struct beam *beam, const struct aim *aim,
                        struct run *run, struct error *error)
{
    const struct trace_job *job = bundle->job;
    struct sample sample;
    if (!choose_points(job->input, run->arena, &sample, error)) {
        return false;
    }
    struct ray *starts = ARENA_ARRAY(run->arena, CHUNK, struct ray);
    bundle->points = sample.points;
    bundle->is_named = job->input->pattern == TRACE_FEW && !job->input->pupil.is_given;
    for (size_t done = 0; done < sample.count; done += CHUNK) {
        struct arena_mark mark = arena_mark(run->arena);
        size_t here = sample.count - done < CHUNK ? sample.count - done : CHUNK;
        if (!aim_starts(job, beam, aim, sample.points + done, here, starts, run->arena, error) ||
            !emit_bundle(bundle, starts, done, here, run, error)) {
            return false;
        }
        arena_reset(run->arena, mark);
    }
    return true;
}

/*
 * The few rays of a beam that passes all rims: its chief ray and its edges. A lens without a stop
 * has no chief ray: the middle of the beam stands for it.
 */
static bool emit_edges(struct bundle *bundle, const struct beam *beam, const struct system *open,
                       const struct aim *aim, struct run *run, struct error *error)
{
    enum { DIRECTIONS = 64 };
    const struct trace_job *job = bundle->job;
    struct pupil_point points[FEW];
    struct ray starts[FEW];
    struct clear_pupil clear;
    struct rays work = rays_new(run->arena, 1);
    struct clear_guess guess = clear_guess_of(&job->system, beam, &job->one->first);
    clear_find(&job->system, beam, &guess, DIRECTIONS, run->arena, &clear);
    if (clear.is_empty) {
        /* nothing passes: the full pupil shows where the rays are lost */
        return aim != NULL ? emit_sample(bundle, beam, aim, run, error)
                           : fail(error, ERROR_DOMAIN, "no ray passes all clear apertures");
    }
    double a = clear.centre[0], b = clear.centre[1];
    a = lens_is_round(job->one->lens) ? 0 : a; /* by symmetry: nothing but rounding */
    b = fabs(b) > 1e-12 * (clear.high[1] - clear.low[1]) ? b : 0;
    const double places[FEW][2] = {
        {aim != NULL ? aim->chief[0] : a, aim != NULL ? aim->chief[1] : b},
        {a, clear.edges[DIRECTIONS / 2].at[1]},
        {a, clear.edges[0].at[1]},
        {clear.edges[DIRECTIONS / 4].at[0], b}};
    for (size_t i = 0; i < FEW; i++) {
        starts[i] = beam_ray(beam, places[i][0], places[i][1]);
        points[i] = (struct pupil_point){.weight = NAN};
        find_pupil(open, &starts[i], &work, &points[i]);
    }
    bundle->points = points;
    bundle->is_named = true;
    return emit_bundle(bundle, starts, 0, FEW, run, error);
}

static bool emit_field(struct bundle *bundle, const struct field_point *field, struct run *run,
                       struct error *error)
{
    const struct trace_job *job = bundle->job;
    const struct trace_input *input = job->input;
    struct system open;
    struct beam beam;
    struct aim aim;
    bool edges = input->pattern == TRACE_FEW && !input->pupil.is_given && job->one->clip &&
                 input->aim == AIM_STOP;
    bool aims = input->aim == AIM_STOP && !(edges && job->one->lens->stop == LENS_NONE);
    if (!ray_case_compile(job->one, job->wavelength, false, false, run->arena, &open, error) ||
        !beam_of_field(field, &job->one->object, &job->one->first, &beam, error) ||
        (aims && !aim_open(&open, &beam, run->arena, &aim, error))) {
        return false;
    }
    return edges ? emit_edges(bundle, &beam, &open, aims ? &aim : NULL, run, error)
                 : emit_sample(bundle, &beam, &aim, run, error);
}

/* The field that the options name; else false. */
static bool field_given(const struct trace_job *job, struct field_point *field)
{
    const struct trace_input *input = job->input;
    bool is_height = !isnan(input->height);
    *field = (struct field_point){.kind = is_height ? FIELD_IMAGE : FIELD_ANGLE,
                                  .value = {0, is_height ? input->height : input->field}};
    return is_height || !isnan(input->field);
}

static const char *field_words(const struct field_point *field, struct arena *arena)
{
    double degrees = unit_from_own(unit_find(&dimension_angle, text_of("deg")), field->value[1]);
    return field->kind == FIELD_ANGLE  ? arena_printf(arena, "field %.6g deg", degrees)
           : field->kind == FIELD_NONE ? "on the axis"
                                       : arena_printf(arena, "field %.6g mm", field->value[1]);
}

/* All fields of the lens, or the one that is asked for. */
static bool emit_fields(const struct trace_job *job, struct run *run, struct error *error)
{
    const struct lens *lens = job->one->lens;
    struct field_point field;
    bool given = field_given(job, &field);
    size_t count = given || lens->field_count == 0 ? 1 : lens->field_count;
    for (size_t i = 0; i < count; i++) {
        if (!given) {
            field = (struct field_point){
                .kind = lens->field_count > 0 ? lens->field_kind : FIELD_NONE,
                .value = {0, lens->field_count > 0 ? lens->fields[i].value.hi : 0}};
        }
        bool angle = field.kind == FIELD_ANGLE || field.kind == FIELD_NONE;
        struct bundle bundle = {.job = job,
                                .field = angle ? field.value[1] : (double)NAN,
                                .height = angle ? (double)NAN : field.value[1]};
        error->code = ERROR_NONE;
        if (!emit_field(&bundle, &field, run, error)) {
            return error->code == ERROR_NONE ||
                   error_prefix(error, "%s: ", field_words(&field, run->arena));
        }
    }
    return true;
}

static bool emit_explicit(const struct trace_job *job, struct run *run, struct error *error)
{
    struct ray start;
    struct bundle bundle = {.job = job, .field = NAN, .height = NAN};
    error->code = ERROR_NONE;
    return trace_start(job->input, &start, error) &&
           (emit_bundle(&bundle, &start, 0, 1, run, error) || error->code == ERROR_NONE);
}

/* What cannot go together, whatever the lens. */
static bool check(const struct trace_input *input, struct error *error)
{
    bool ray = trace_is_explicit(input);
    if (ray && (input->pupil.is_given || input->pattern != TRACE_FEW)) {
        return fail(error, ERROR_USAGE,
                    "a ray that starts at a point goes its way: no --pupil-point, no --pattern");
    }
    if (input->pupil.is_given && input->pattern != TRACE_FEW) {
        return fail(error, ERROR_USAGE, "--pupil-point is one ray, --pattern many");
    }
    if (!isnan(input->field) && !isnan(input->height)) {
        return fail(error, ERROR_USAGE, "--field and --height exclude each other");
    }
    if (input->verify && input->question.to.kind == TARGET_SURFACE) {
        return fail(error, ERROR_USAGE, "--verify goes with rays that pass the whole lens");
    }
    return true;
}

bool trace_answer(const struct trace_input *input, struct run *run, struct error *error)
{
    const size_t *positions;
    size_t count;
    if (!ray_positions(&input->question, run->arena, &positions, &count, error) ||
        !check(input, error)) {
        return false;
    }
    for (size_t i = 0; i < count; i++) {
        struct ray_case one;
        struct trace_job job;
        if (!ray_case_open(&input->question, positions[i], run->arena, &one, error)) {
            return false;
        }
        double wavelength = isnan(input->wavelength) ? lens_primary_wavelength(one.lens)
                                                     : wavelength_micrometres(input->wavelength);
        if (!trace_job_open(input, &one, wavelength, run->arena, &job, error) ||
            !(trace_is_explicit(input) ? emit_explicit(&job, run, error)
                                       : emit_fields(&job, run, error))) {
            return false;
        }
    }
    return true;
}
