/* commands/design/fit_job.c - trace the rays that were asked for, and fit a thick lens to it. */
/* SPDX-License-Identifier: MIT */
#include "commands/design/fit_job.h"

#include "base/constants.h"

static struct thick_lens thick_of(const struct first_order *first, const struct lens *lens)
{
    return (struct thick_lens){.focal = first->efl,
                               .front = first->front_principal,
                               .rear = first->rear_principal,
                               .index_object = first->index_object,
                               .index_image = first->index_image,
                               .object =
                                   lens->object_is_infinite ? INFINITY : lens->object.value.hi};
}

static void fit_job_set_pupils(struct fit_job *job)
{
    const struct thick_pupil none = {NAN, NAN, NAN, NAN, NAN, NAN, NAN};
    struct thick_pupil *const pupils[2] = {&job->entrance, &job->exit};
    struct error ignored;
    for (int k = 0; k < 2; k++) {
        if (job->setup->lens->stop == LENS_NONE ||
            !thick_fit_pupil(&job->pupils[k], k == 1, true, job->run->arena, pupils[k], &ignored)) {
            *pupils[k] = none;
        }
    }
}

const char *fit_missing_fields(const struct fit_job *job)
{
    struct arena *arena = job->run->arena;
    const char *list = NULL;
    for (size_t f = 0; f < job->setup->field_count; f++) {
        double field = fit_field(job, f);
        double shown = job->setup->object.is_infinite ? field * DEGREES_PER_RADIAN : field;
        if (job->ray_data.through[f] == 0) {
            list = arena_printf(arena, "%s%s%.6g", list != NULL ? list : "",
                                list != NULL ? ", " : "", shown);
        }
    }
    return list == NULL
               ? NULL
               : arena_printf(arena, "no ray of the field %s %s came through the clear apertures",
                              list, job->setup->lens->object_is_infinite ? "deg" : "mm");
}

/* Half as many as there are different fields off the axis whose rays come through, at most 3. */
static size_t distortion_terms(const struct fit_job *job)
{
    const struct ray_data *ray_data = &job->ray_data;
    size_t off_axis = 0;
    if (!isnan(job->input->distortion)) {
        return (size_t)job->input->distortion;
    }
    for (size_t i = 0; i < job->setup->field_count; i++) {
        bool counts = fabs(fit_field(job, i)) > 0 && ray_data->clear[i] > 0;
        for (size_t k = 0; k < i && counts; k++) {
            counts = fabs(fabs(fit_field(job, k)) - fabs(fit_field(job, i))) > 0;
        }
        off_axis += counts;
    }
    return off_axis / 2 < THICK_DISTORTIONS ? off_axis / 2 : THICK_DISTORTIONS;
}

static bool open_rays(const struct fit_job *job, size_t rays, struct ray_data *ray_data,
                      struct error *error)
{
    const struct fit_input *input = job->input;
    const struct ray_data_request request = {.setup = job->setup,
                                             .pattern = (enum pattern)input->pattern,
                                             .ray_count = rays,
                                             .seed = (uint64_t)input->seed,
                                             .no_clip = input->no_clip};
    return ray_data_open(&request, job->run->arena, ray_data, error);
}

/* Trace all rays and add them up; also for the pupils unless that is null. */
static bool fit_job_add_rays(const struct fit_job *job, struct ray_data *ray_data,
                             struct thick_sums *sums, struct thick_pupil_sums *pupils,
                             struct error *error)
{
    const struct setup *setup = job->setup;
    const struct ray_part *part;
    *sums = thick_sums_open(setup->field_count, setup->wavelength_count,
                            thick_of(&job->light.first, setup->lens).object, job->run->arena);
    while ((part = ray_data_next(ray_data)) != NULL) {
        if (!thick_sums_add(sums, &part->rays, error)) {
            ray_data_rewind(ray_data);
            return false;
        }
        for (int k = 0; k < 2 && pupils != NULL; k++) {
            thick_pupil_add(&part->rays, k == 1, &pupils[k]);
        }
    }
    return ray_data_check(ray_data, error);
}

static void set_task(struct fit_job *job)
{
    const struct fit_input *input = job->input;
    const struct first_order *first = &job->light.first;
    bool image = input->match == FIT_IMAGE;
    job->task = (struct thick_task){
        .sums = &job->sums,
        .group_count = job->setup->wavelength_count,
        .index_object = job->ray_data.index_object,
        .index_image = job->ray_data.index_image,
        .separate = input->chromatic,
        .planes = {setup_paraxial_image(job->setup->lens, first).hi,
                   isfinite(first->exit_pupil) ? first->exit_pupil : first->rear_principal},
        .plane_weights = {1, image ? THICK_PUPIL_WEIGHT : 1},
        .focus_weight = image ? THICK_FOCUS_WEIGHT : 0,
        .distortions = distortion_terms(job),
        .options = {.progress = fit_goes_on, .progress_context = job->run->watch},
        .start = thick_of(first, job->setup->lens)};
    job->task.object = job->task.start.object;
}

/* What the sample of the pupil costs: all once more with twice the rays. */
static void set_sampling(struct fit_job *job)
{
    struct arena *arena = job->run->arena;
    struct thick_task task = job->task;
    struct ray_data ray_data;
    struct thick_sums sums;
    struct thick_fit fit;
    struct error ignored;
    job->sampling = ARENA_ARRAY(arena, job->setup->wavelength_count, struct fit_sampling_change);
    struct arena_mark mark = arena_mark(arena);
    task.sums = &sums;
    task.start = job->fit.lenses[0];
    bool found = open_rays(job, 2 * (size_t)job->input->rays, &ray_data, &ignored) &&
                 fit_job_add_rays(job, &ray_data, &sums, NULL, &ignored) &&
                 thick_fit(&task, arena, &fit, &ignored);
    for (size_t g = 0; g < job->setup->wavelength_count; g++) {
        const struct thick_lens *one = &job->fit.lenses[g], *other = found ? &fit.lenses[g] : one;
        job->sampling[g] = (struct fit_sampling_change){NAN, NAN, NAN, NAN};
        if (found) {
            job->sampling[g] = (struct fit_sampling_change){
                fabs(other->focal - one->focal), fabs(other->front - one->front),
                fabs(other->rear - one->rear), fabs(fit.rms - job->fit.rms)};
        }
    }
    arena_reset(arena, mark);
}

bool fit_job_run(struct fit_job *job, struct error *error)
{
    if (job->setup->wavelength_count > MOST_WAVELENGTHS) {
        return fail(error, ERROR_DOMAIN, "the lens has more than %d wavelengths", MOST_WAVELENGTHS);
    }
    if (job->light.first.is_afocal) {
        return fail(error, ERROR_DOMAIN,
                    "an afocal lens has no principal planes: no thick lens equals it");
    }
    if (!open_rays(job, (size_t)job->input->rays, &job->ray_data, error) ||
        !fit_job_add_rays(job, &job->ray_data, &job->sums, job->pupils, error)) {
        return false;
    }
    set_task(job);
    watch_begin(job->run->watch, "iterations", 0);
    /* What the fitted lens is compared with: the paraxial lens, and the thin one. */
    size_t count = job->setup->wavelength_count;
    job->paraxial = ARENA_ARRAY(job->run->arena, count, struct thick_lens);
    job->thin = ARENA_ARRAY(job->run->arena, count, struct thick_lens);
    for (size_t g = 0; g < count; g++) {
        job->paraxial[g] = thick_of(&job->light.first, job->setup->lens);
        job->paraxial[g].index_object = job->ray_data.index_object[g];
        job->paraxial[g].index_image = job->ray_data.index_image[g];
        job->thin[g] = job->paraxial[g];
        job->thin[g].front = job->light.first.length + job->thin[g].rear;
    }
    fit_job_set_pupils(job);
    if (!thick_fit(&job->task, job->run->arena, &job->fit, error)) {
        const char *missing = fit_missing_fields(job);
        return missing == NULL ? false : error_hint(error, "%s", missing);
    }
    if (job->input->show == FIT_ANSWER) {
        set_sampling(job);
    }
    return true;
}
