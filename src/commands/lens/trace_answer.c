/* commands/lens/trace_answer.c - the rays that lenscalc trace is asked for. */
/* SPDX-License-Identifier: MIT */
#include "commands/lens/trace_answer.h"

#include "trace/aim/aim.h"
#include "trace/dispatch.h"
#include "trace/follow.h"
#include "trace/pupil/clear_cross.h"
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

bool trace_job_open(const struct trace_input *input, const struct ray_case *one,
                    struct trace_job *job, struct error *error)
{
    double wavelength = one->setup.wavelengths[0].wavelength;
    *job = (struct trace_job){.input = input, .one = one, .wavelength = wavelength};
    job->system = ray_case_system(one, error);
    if (job->system == NULL) {
        return false;
    }
    job->to = one->to_image ? job->system->places : one->surfaces;
    job->blank = (struct trace_row){
        .position = one->setup.position,
        .focus = one->to_image ? one->setup.focus : NULL,
        .image = one->to_image ? one->setup.image : (double)NAN,
        .lens = one->setup.lens->title,
        .warning = one->warning,
        .wavelength = wavelength,
        .field = NAN,
        .field_x = NAN,
        .height = NAN,
        .height_x = NAN,
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
    return true;
}

/* Where a ray is, or that it is lost. */
static void trace_answer_set_end(const struct trace_job *job, const struct ray *ray, bool at_image,
                                 struct trace_row *row)
{
    bool arrived = ray->status == RAY_OK;
    for (int i = 0; i < 3; i++) {
        row->point[i] = arrived ? ray->point[i] : (double)NAN;
        row->cosine[i] = arrived ? ray->cosine[i] : (double)NAN;
    }
    if (at_image && arrived) {
        row->point[2] += job->one->setup.image; /* in the frame of the last vertex */
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
        job->to > 0 ? system_index_after(job->system, job->to - 1) : job->system->index_first;
    struct ray ray = rays_get(&rays, lane, n);
    trace_answer_set_end(job, &ray, job->one->to_image, row);
}

/* The paraxial ray where the row is. */
static bool trace_answer_set_paraxial(const struct trace_job *job, const struct ray *start,
                                      size_t place, struct arena *arena, struct trace_row *row,
                                      struct error *error)
{
    const struct lens *lens = job->one->setup.lens;
    struct paraxial_intersection *meetings =
        ARENA_ARRAY(arena, lens->surface_count, struct paraxial_intersection);
    if (!ray_follow_paraxially(lens, job->wavelength, start, arena, meetings, error)) {
        return false;
    }
    bool at_image = place >= lens->surface_count;
    const struct paraxial_intersection *here =
        &meetings[at_image ? lens->surface_count - 1 : place];
    double distance = at_image ? job->one->setup.image : 0;
    row->slope[0] = here->slope_x;
    row->slope[1] = here->slope_y;
    row->paraxial[0] = here->x + distance * here->slope_x;
    row->paraxial[1] = here->y + distance * here->slope_y;
    return true;
}

/* Only rays that go all the way can be verified. */
static void trace_answer_set_errors(const struct trace_job *job, const struct ray *start,
                                    size_t place, struct trace_row *row)
{
    if (place + 1 != job->system->places) {
        return;
    }
    struct ray tested = {.path = row->path, .status = isnan(row->path) ? RAY_MISS : RAY_OK};
    for (int i = 0; i < 3; i++) {
        tested.point[i] = row->point[i];
        tested.cosine[i] = row->cosine[i];
    }
    if (job->one->to_image) {
        tested.point[2] -= job->one->setup.image;
    }
    struct verification check = verify_ray(job->system, start, &tested);
    row->point_error = check.point_error;
    row->cosine_error = check.cosine_error;
    row->path_error = check.path_error;
}

bool trace_row_extras(const struct trace_job *job, const struct ray *start, size_t place,
                      struct arena *arena, struct trace_row *row, struct error *error)
{
    if (job->input->verify) {
        trace_answer_set_errors(job, start, place, row);
    }
    return !job->input->paraxial || trace_answer_set_paraxial(job, start, place, arena, row, error);
}

/* One row a surface. False with `error` set, or if no more rows are wanted. */
static bool emit_all(const struct trace_job *job, const struct ray *start, struct trace_row *row,
                     struct run *run, struct error *error)
{
    struct ray_intersection *meetings =
        ARENA_ARRAY(run->arena, job->system->places, struct ray_intersection);
    ray_follow(job->system, start, run->arena, meetings);
    for (size_t place = 0; place < job->to; place++) {
        trace_answer_set_end(job, &meetings[place].ray,
                             place >= job->one->setup.lens->surface_count, row);
        row->surface = (long)place + 1;
        row->incidence = meetings[place].angles.incidence;
        row->refraction = meetings[place].angles.refraction;
        if (!trace_row_extras(job, start, place, run->arena, row, error) || !run_emit(run, row)) {
            return false;
        }
    }
    return true;
}

/* Rays that share everything but their start. */
struct trace_answer_bundle {
    const struct trace_job *job;
    double field, field_x, height, height_x;
    const struct pupil_point *points; /* null: a ray as given */
    bool is_named;                    /* the rays of `few` */
    bool folds;                       /* points of the stop are met by several rays */
};

/* Which ray of the bundle it is, and what is doubtful of it. */
static void label_row(const struct trace_answer_bundle *bundle, size_t i, bool lost,
                      struct arena *arena, struct trace_row *row)
{
    /* Of two rays through one point of the stop, the one aimed is joined to the chief ray. */
    static const char folds[] =
        "the pupil folds inside the stop: near its edge a point is met by two rays, and the one "
        "that was aimed may be the wrong one: clipped where the other passes";
    /* The weights of a quadrature are those of the whole pupil. */
    static const char weights[] =
        "the weights of gauss do not integrate over a pupil of which rays are lost";
    const struct trace_input *input = bundle->job->input;
    const bool weighs = bundle->points != NULL && !input->pupil.is_given &&
                        input->pattern == TRACE_FEW + 1 + PATTERN_GAUSS;
    row->field = bundle->field;
    row->field_x = bundle->field_x;
    row->height = bundle->height;
    row->height_x = bundle->height_x;
    if (bundle->points != NULL) {
        row->pupil[0] = bundle->points[i].x;
        row->pupil[1] = bundle->points[i].y;
        row->weight = bundle->points[i].weight;
        row->ray = bundle->is_named ? few[i].name : NULL;
    } else {
        /* of a row that another trace has written */
        row->pupil[0] = input->pupil_at[0];
        row->pupil[1] = input->pupil_at[1];
    }
    row->warning = lens_warnings_join(row->warning, bundle->folds ? folds : NULL, arena);
    row->warning = lens_warnings_join(row->warning, lost && weighs ? weights : NULL, arena);
}

static bool emit_bundle(const struct trace_answer_bundle *bundle, const struct ray *starts,
                        size_t first, size_t count, struct run *run, struct error *error)
{
    const struct trace_job *job = bundle->job;
    struct rays rays = rays_new(run->arena, count);
    for (size_t i = 0; i < count; i++) {
        rays_set(&rays, i, job->system->index_first, &starts[i]);
    }
    rays_trace_part(job->system, 0, job->to, &rays, NULL);
    for (size_t i = 0; i < count; i++) {
        const struct arena_mark mark = arena_mark(run->arena);
        struct trace_row row;
        bool going;
        trace_row_begin(job, &starts[i], &row);
        bool lost = starts[i].status != RAY_OK ||
                    ray_block_status(&rays.blocks[i / RAYS_BLOCK], i % RAYS_BLOCK) != RAY_OK;
        label_row(bundle, first + i, lost, run->arena, &row);
        if (starts[i].status != RAY_OK) {
            /* A ray that never started: the search for it was lost there. */
            for (int k = 0; k < 3; k++) {
                row.start[k] = row.start_cosine[k] = NAN;
            }
            trace_answer_set_end(job, &starts[i], false, &row);
            going = run_emit(run, &row);
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

/* A telecentric object space has its pupil where it says, not where the stop is seen. */
static int trace_answer_aim_of(const struct trace_job *job)
{
    return job->one->setup.first.is_telecentric ? AIM_ENTRANCE : job->input->aim;
}

/* The points of the pupil that the input asks for. */
static bool choose_points(const struct trace_input *input, struct arena *arena,
                          struct sample *sample, struct error *error)
{
    if (trace_has_pupil(input)) {
        const double *at = input->pupil.is_given ? input->pupil.at : input->pupil_at;
        sample->count = 1;
        sample->points = ARENA_NEW(arena, struct pupil_point);
        *sample->points = (struct pupil_point){at[0], at[1], 1};
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
    if (trace_answer_aim_of(job) == AIM_STOP) {
        struct rays rays = rays_new(arena, count);
        aim_rays(aim, points, count, &rays);
        for (size_t i = 0; i < count; i++) {
            starts[i] = rays_get(&rays, i, beam->n);
        }
        return true;
    }
    for (size_t i = 0; i < count; i++) {
        if (!aim_at_entrance(beam, &job->one->setup.first, points[i].x, points[i].y, &starts[i],
                             error)) {
            return false;
        }
    }
    return true;
}

/* Where rays cross the stop, in units of its radius; NaN where they do not, or it has none. */
static void trace_answer_find_pupil(const struct system *open, const struct ray *starts,
                                    size_t count, struct arena *arena, struct pupil_point *points)
{
    const struct rays work = rays_new(arena, count);
    bool has_stop = open->stop != LENS_NONE && !isnan(open->stop_radius);
    for (size_t i = 0; i < count; i++) {
        points[i] = (struct pupil_point){NAN, NAN, NAN};
        rays_set(&work, i, open->index_first, &starts[i]);
    }
    if (!has_stop) {
        return;
    }
    rays_trace_part(open, 0, system_place(open, open->stop) + 1, &work, NULL);
    for (size_t i = 0; i < count; i++) {
        struct ray ray = rays_get(&work, i, 1);
        if (ray.status == RAY_OK) {
            points[i].x = ray.point[0] / open->stop_radius;
            points[i].y = ray.point[1] / open->stop_radius;
        }
    }
}

/* The clear aperture of the beam of one field, about the chief ray if that is known. */
static void find_cross(const struct trace_job *job, const struct beam *beam, const struct aim *aim,
                       struct arena *arena, struct clear_cross *cross)
{
    struct clear_guess guess = clear_guess_of(job->clipped, beam, &job->one->setup.first);
    if (aim != NULL && aim->has_chief) {
        guess.centre[0] = aim->chief[0];
        guess.centre[1] = aim->chief[1];
    }
    clear_across(job->clipped, beam, &guess, lens_is_round(job->one->setup.lens), arena, cross);
}

/*
 * Is what passes the lens, or some of it, on the other side of a fold than the chief ray: does the
 * map of the beam to the stop have another sign there?
 */
static bool is_folded(const struct trace_job *job, const struct beam *beam, const struct aim *aim,
                      struct arena *arena)
{
    struct clear_cross cross;
    struct aim other = *aim;
    double sign = aim->slope[0] * aim->slope[3] - aim->slope[1] * aim->slope[2];
    find_cross(job, beam, NULL, arena, &cross);
    for (size_t i = 0; i < 5 && !cross.is_empty; i++) {
        const double *at = i < 4 ? cross.ends[i].at : cross.centre;
        if (aim_open_at(&other, at) &&
            sign * (other.slope[0] * other.slope[3] - other.slope[1] * other.slope[2]) < 0) {
            return true;
        }
    }
    return false;
}

static bool emit_sample(struct trace_answer_bundle *bundle, const struct beam *beam,
                        const struct aim *aim, struct run *run, struct error *error)
{
    const struct trace_job *job = bundle->job;
    struct sample sample;
    if (!choose_points(job->input, run->arena, &sample, error)) {
        return false;
    }
    struct ray *starts = ARENA_ARRAY(run->arena, CHUNK, struct ray);
    bundle->points = sample.points;
    bundle->folds = trace_answer_aim_of(job) == AIM_STOP && is_folded(job, beam, aim, run->arena);
    bundle->is_named = job->input->pattern == TRACE_FEW && !trace_has_pupil(job->input);
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
 * The few rays of a beam that passes all clear apertures: its chief ray and its edges. A lens
 * without a stop has no chief ray: the middle of the beam stands for it.
 */
static bool emit_edges(struct trace_answer_bundle *bundle, const struct beam *beam,
                       const struct clear_cross *cross, const struct aim *aim, struct run *run,
                       struct error *error)
{
    struct pupil_point points[FEW];
    struct ray starts[FEW];
    const double *places[FEW] = {cross->centre, cross->ends[1].at, cross->ends[3].at,
                                 cross->ends[0].at};
    if (aim != NULL && aim->has_chief) {
        places[0] = aim->chief;
    }
    for (size_t i = 0; i < FEW; i++) {
        starts[i] = beam_ray(beam, places[i][0], places[i][1]);
    }
    trace_answer_find_pupil(bundle->job->open, starts, FEW, run->arena, points);
    if (aim != NULL && !aim->has_chief) {
        points[0].x = points[0].y = 0;
        starts[0].status = aim->lost;
        starts[0].surface = aim->lost_surface;
    }
    bundle->points = points;
    bundle->is_named = true;
    return emit_bundle(bundle, starts, 0, FEW, run, error);
}

/*
 * Without a chief ray others may still pass: they are aimed from the middle of what does. Where
 * nothing does, `error` stays as it is, that of aim_open.
 */
static bool aim_without_chief(const struct trace_job *job, const struct beam *beam, struct aim *aim,
                              struct arena *arena, struct error *error)
{
    struct clear_cross cross;
    if (job->open->stop == LENS_NONE || !(job->open->stop_radius > 0)) {
        return false;
    }
    find_cross(job, beam, NULL, arena, &cross);
    if (cross.is_empty || !aim_open_at(aim, cross.centre)) {
        return false;
    }
    error->code = ERROR_NONE;
    return true;
}

static bool emit_field(struct trace_answer_bundle *bundle, const struct field_point *field,
                       struct run *run, struct error *error)
{
    const struct trace_job *job = bundle->job;
    const struct setup *setup = &job->one->setup;
    struct clear_cross cross = {.is_empty = true};
    struct beam beam;
    struct aim aim;
    bool edges = job->input->pattern == TRACE_FEW && !trace_has_pupil(job->input) &&
                 job->one->clip && trace_answer_aim_of(job) == AIM_STOP;
    bool aims = trace_answer_aim_of(job) == AIM_STOP && !(edges && setup->lens->stop == LENS_NONE);
    if (!setup_beam(setup, field, &beam, error) ||
        (aims && !aim_open(job->open, &beam, run->arena, &aim, error) &&
         !aim_without_chief(job, &beam, &aim, run->arena, error))) {
        return false;
    }
    const struct aim *by_stop = aims ? &aim : NULL;
    if (edges) {
        find_cross(job, &beam, by_stop, run->arena, &cross);
    }
    if (edges && !aims && cross.is_empty) {
        return fail(error, ERROR_DOMAIN, "no ray passes all clear apertures");
    }
    /* where nothing passes the full pupil shows where the rays are lost */
    return cross.is_empty ? emit_sample(bundle, &beam, &aim, run, error)
                          : emit_edges(bundle, &beam, &cross, by_stop, run, error);
}

static bool emit_fields(const struct trace_job *plain, struct run *run, struct error *error)
{
    const struct setup *setup = &plain->one->setup;
    struct trace_job with = *plain;
    const struct trace_job *job = &with;
    /* with the path, so that they give the same bits as the rays themselves */
    with.open = setup_system(setup, 0, SETUP_OPEN | SETUP_PATH, error);
    with.clipped =
        job->one->clip ? job->system : setup_system(setup, 0, SETUP_CLIPPED | SETUP_PATH, error);
    if (with.open == NULL || with.clipped == NULL) {
        return false;
    }
    for (size_t i = 0; i < setup->field_count; i++) {
        const struct arena_mark mark = arena_mark(run->arena);
        const struct field_point *field = &setup->fields[i].point;
        bool angle = field->kind == FIELD_ANGLE || field->kind == FIELD_NONE;
        struct trace_answer_bundle bundle = {.job = job,
                                             .field = angle ? field->value[1] : (double)NAN,
                                             .field_x = angle ? field->value[0] : (double)NAN,
                                             .height = angle ? (double)NAN : field->value[1],
                                             .height_x = angle ? (double)NAN : field->value[0]};
        error->code = ERROR_NONE;
        if (!emit_field(&bundle, field, run, error)) {
            return error->code == ERROR_NONE ||
                   error_prefix(error, "%s: ", lens_field_words(field, run->arena));
        }
        arena_reset(run->arena, mark);
    }
    return true;
}

static bool emit_explicit(const struct trace_job *job, struct run *run, struct error *error)
{
    struct ray start;
    struct trace_answer_bundle bundle = {
        .job = job, .field = NAN, .field_x = NAN, .height = NAN, .height_x = NAN};
    error->code = ERROR_NONE;
    return trace_start(job->input, &start, error) &&
           (emit_bundle(&bundle, &start, 0, 1, run, error) || error->code == ERROR_NONE);
}

/* What cannot go together, whatever the lens. */
static bool trace_answer_check(const struct trace_input *input, struct error *error)
{
    bool ray = trace_is_explicit(input);
    bool x = !isnan(input->pupil_at[0]), y = !isnan(input->pupil_at[1]);
    if (x != y && !ray) {
        return fail(error, ERROR_USAGE,
                    "pupil_x and pupil_y belong together: one of them is missing");
    }
    if (x && input->pupil.is_given) {
        return fail(error, ERROR_USAGE, "{--pupil-point} and pupil_x, pupil_y exclude each other");
    }
    if (ray && (input->pupil.is_given || input->pattern != TRACE_FEW)) {
        return fail(
            error, ERROR_USAGE,
            "a ray that starts at a point goes its way: no {--pupil-point}, no {--pattern}");
    }
    if (ray && input->question.no_clip && !isnan(input->question.fnumber)) {
        return fail(error, ERROR_USAGE,
                    "a ray that starts at a point meets no stop with {--no-clip}: no {--aperture}");
    }
    if (trace_has_pupil(input) && input->pattern != TRACE_FEW) {
        return fail(error, ERROR_USAGE, "{--pupil-point} is one ray, {--pattern} many");
    }
    const bool angle = !isnan(input->field) || !isnan(input->field_x);
    if (angle && (!isnan(input->height) || !isnan(input->height_x))) {
        return fail(error, ERROR_USAGE, "{--field} and {--height} exclude each other");
    }
    return !input->verify || input->question.to.kind != TARGET_SURFACE ||
           fail(error, ERROR_USAGE, "{--verify} works with rays that pass the whole lens");
}

bool trace_answer(const void *data, struct run *run, struct error *error)
{
    const struct trace_input *input = data;
    const struct ray_question *question = &input->question;
    struct setup_field named;
    /* The field that the options name; null: those of the lens. */
    const enum field_kind of_image = input->real ? FIELD_REAL : FIELD_IMAGE;
    const bool is_height = !isnan(input->height) || !isnan(input->height_x);
    named = is_height ? lens_field(of_image, input->height_x, input->height, SECTION_Y)
                      : lens_field(FIELD_ANGLE, input->field_x, input->field, SECTION_Y);
    const struct setup_field *field = trace_has_field(input) ? &named : NULL;
    const size_t *positions;
    size_t count;
    if (!lens_positions(question->lens.lens, question->position, run->arena, &positions, &count,
                        error) ||
        !trace_answer_check(input, error)) {
        return false;
    }
    for (size_t i = 0; i < count; i++) {
        struct ray_case one;
        struct trace_job job;
        if (!ray_case_open(question, positions[i], input->wavelength, field, run->arena, &one,
                           error) ||
            !trace_job_open(input, &one, &job, error)) {
            return false;
        }
        const bool done = trace_is_explicit(input) ? emit_explicit(&job, run, error)
                                                   : emit_fields(&job, run, error);
        if (!done) {
            return false;
        }
    }
    return true;
}
