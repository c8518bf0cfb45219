/* cli/fit_job.c - trace the bundle that was asked for, and fit a thick lens to it. */
/* SPDX-License-Identifier: MIT */
#include "commands/design/fit_job.h"

#include "optics/wavelength.h"

/* `0,10:2,14deg`: fields with weights. */
static bool read_fields(struct fit_job *job, struct error *error)
{
    struct text rest = text_of(job->input->fields);
    bool angle = job->lens->object_is_infinite;
    const struct dimension *dimension = angle ? &dimension_angle : &dimension_length;
    const struct unit *unit = unit_find(dimension, text_of(angle ? "deg" : "mm"));
    while (rest.start != NULL) {
        struct text weight = text_cut(&rest, ','), value = text_cut(&weight, ':');
        double *field = &job->field[job->field_count];
        double *share = &job->field_weights[job->field_count];
        if (job->field_count == BUNDLE_FIELDS) {
            return fail(error, ERROR_USAGE, "--field has more than %d fields", BUNDLE_FIELDS);
        }
        *share = 1;
        if (!quantity_read(value, dimension, unit, field, NULL, error) ||
            (weight.start != NULL &&
             !quantity_read(weight, &dimension_number, NULL, share, NULL, error))) {
            return error_prefix(error, "bad --field: ");
        }
        if (!isfinite(*field) || !(*share >= 0 && isfinite(*share))) {
            return fail(error, ERROR_USAGE, "--field has a field or weight that is not finite");
        }
        job->field_count++;
    }
    job->fields = job->input->fields;
    return true;
}

/* From the axis to the largest field: with two or three a thick lens may agree by chance. */
static void spread_fields(struct fit_job *job, double largest)
{
    static const double shares[] = {0, 0.25, 0.5, 0.75, 1};
    job->field_count = sizeof shares / sizeof shares[0];
    for (size_t i = 0; i < job->field_count; i++) {
        job->field[i] = shares[i] * largest;
        job->field_weights[i] = 1;
    }
}

/* Up to the corner of 35 mm film, if a lens of straight lines would reach it below 60 degrees. */
static bool assume_fields(struct fit_job *job, struct error *error)
{
    double tangent = 21.633 / fabs(job->first.efl);
    if (!job->lens->object_is_infinite || !(tangent < 1.732)) {
        return fail(error, ERROR_DOMAIN, "the lens states no fields: give --field");
    }
    spread_fields(job, atan(tangent));
    job->fields = "to the half diagonal of 35 mm film, as the lens states none";
    return true;
}

/* A field of the file as angle or height of the object; angles are seen from the first vertex. */
static double field_of(const struct fit_job *job, double value)
{
    const struct lens *lens = job->lens;
    const struct first_order *first = &job->first;
    if (lens->field_kind == FIELD_IMAGE) {
        return lens->object_is_infinite ? atan(value * first->power / first->index_object)
                                        : value / first->magnification;
    }
    if (lens->field_kind == FIELD_ANGLE && !lens->object_is_infinite) {
        return -tan(value) * lens->object.value.hi;
    }
    return value;
}

/* Up to the largest field of the file. */
static bool take_fields(struct fit_job *job, struct error *error)
{
    const struct lens *lens = job->lens;
    double largest = 0;
    if (job->input->fields != NULL) {
        return read_fields(job, error);
    }
    if (lens->field_count == 0) {
        return assume_fields(job, error);
    }
    if (lens->field_kind == FIELD_HEIGHT && lens->object_is_infinite) {
        return fail(error, ERROR_DOMAIN, "an object at infinity has no height: give --field");
    }
    for (size_t i = 0; i < lens->field_count; i++) {
        double field = field_of(job, lens->fields[i].value.hi);
        largest = fabs(field) > fabs(largest) ? field : largest;
    }
    spread_fields(job, largest);
    job->fields = "0, 1/4, 1/2, 3/4 and 1 of the largest of the lens";
    return true;
}

static bool take_wavelengths(struct fit_job *job, struct error *error)
{
    const struct lens *lens = job->lens;
    const struct wavelength_value *given = &job->input->question.wavelength;
    if (given->name != NULL || lens->wavelength_count == 0) {
        job->wavelengths[0] = given->name != NULL ? given->wavelength : WAVELENGTH_D;
        job->weights[0] = 1;
        job->wavelength_count = 1;
        return true;
    }
    if (lens->wavelength_count > MOST_WAVELENGTHS) {
        return fail(error, ERROR_DOMAIN, "the lens has more than %d wavelengths", MOST_WAVELENGTHS);
    }
    for (size_t i = 0; i < lens->wavelength_count; i++) {
        job->wavelengths[i] = lens->wavelengths[i].wavelength;
        job->weights[i] = lens->wavelengths[i].weight;
    }
    job->wavelength_count = lens->wavelength_count;
    return true;
}

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

/* What the fitted lens is compared with: the paraxial lens, and the thin one. */
static void set_rivals(struct fit_job *job)
{
    size_t count = job->wavelength_count;
    job->paraxial = ARENA_ARRAY(job->run->arena, count, struct thick_lens);
    job->thin = ARENA_ARRAY(job->run->arena, count, struct thick_lens);
    for (size_t g = 0; g < count; g++) {
        job->paraxial[g] = thick_of(&job->first, job->lens);
        job->paraxial[g].index_object = job->bundle.index_object[g];
        job->paraxial[g].index_image = job->bundle.index_image[g];
        job->thin[g] = job->paraxial[g];
        job->thin[g].front = job->first.length + job->thin[g].rear;
    }
}

/* Where the image is, from the last vertex. */
static double image_place(const struct fit_job *job)
{
    const struct surface *last = &job->lens->surfaces[job->lens->surface_count - 1];
    bool table = job->lens->focus == FOCUS_TABLE && last->has_thickness;
    return table ? surface_advance(last).hi : job->first.image;
}

static void set_pupils(struct fit_job *job)
{
    const struct thick_pupil none = {NAN, NAN, NAN, NAN, NAN, NAN, NAN};
    struct error ignored;
    job->entrance = job->exit = none;
    if (job->lens->stop == LENS_NONE ||
        !thick_fit_pupil(&job->bundle.rays, false, true, job->run->arena, &job->entrance,
                         &ignored)) {
        job->entrance = none;
    }
    if (job->lens->stop == LENS_NONE ||
        !thick_fit_pupil(&job->bundle.rays, true, true, job->run->arena, &job->exit, &ignored)) {
        job->exit = none;
    }
}
const char *fit_missing_fields(const struct fit_job *job)
{
    struct arena *arena = job->run->arena;
    const char *list = NULL;
    for (size_t f = 0; f < job->field_count; f++) {
        bool found = false;
        for (size_t i = 0; i < job->bundle.rays.count && !found; i++) {
            found = job->bundle.field[i] == f;
        }
        double shown =
            job->lens->object_is_infinite ? job->field[f] * 57.29577951308232 : job->field[f];
        if (!found) {
            list = arena_printf(arena, "%s%s%.6g", list != NULL ? list : "",
                                list != NULL ? ", " : "", shown);
        }
    }
    return list == NULL ? NULL
                        : arena_printf(arena, "no ray of the field %s %s came through the rims",
                                       list, job->lens->object_is_infinite ? "deg" : "mm");
}

bool fit_job_run(struct fit_job *job, struct error *error)
{
    const struct fit_input *input = job->input;
    struct arena *arena = job->run->arena;
    if (!take_wavelengths(job, error) || !take_fields(job, error)) {
        return false;
    }
    const struct bundle_request request = {.lens = job->lens,
                                           .first = &job->first,
                                           .wavelengths = job->wavelengths,
                                           .wavelength_weights = job->weights,
                                           .wavelength_count = job->wavelength_count,
                                           .fields = job->field,
                                           .field_weights = job->field_weights,
                                           .field_count = job->field_count,
                                           .pattern = (enum pattern)input->pattern,
                                           .ray_count = (size_t)input->rays,
                                           .seed = (uint64_t)input->seed,
                                           .no_clip = input->no_clip};
    if (job->first.is_afocal) {
        return fail(error, ERROR_DOMAIN,
                    "an afocal lens has no principal planes: no thick lens equals it");
    }
    if (!bundle_trace(&request, arena, &job->bundle, error)) {
        return false;
    }
    bool has_pupil = isfinite(job->first.exit_pupil);
    job->task = (struct thick_task){
        .rays = job->bundle.rays,
        .group_count = job->wavelength_count,
        .index_object = job->bundle.index_object,
        .index_image = job->bundle.index_image,
        .separate = input->chromatic,
        .planes = {image_place(job), has_pupil ? job->first.exit_pupil : job->first.rear_principal},
        .plane_weights = {1, input->match == FIT_IMAGE ? THICK_PUPIL_WEIGHT : 1},
        .distortions = (size_t)input->distortion,
        .start = thick_of(&job->first, job->lens)};
    job->task.object = job->task.start.object;
    set_rivals(job);
    set_pupils(job);
    if (!thick_fit(&job->task, arena, &job->fit, error)) {
        const char *missing = fit_missing_fields(job);
        return missing == NULL ? false : error_hint(error, "%s", missing);
    }
    return true;
}
