/* commands/design/fit_lens.c - the thick lens that equals a lens over exact rays of many fields. */
/* SPDX-License-Identifier: MIT */
#include "analysis/model/lens_model.h"
#include "base/constants.h"
#include "commands/design/fit.h"

static struct thick_lens fit_model(enum lens_model model, const struct first_order *first,
                                   const struct lens *lens)
{
    return lens_model_thick(model, first,
                            lens->object_is_infinite ? INFINITY : lens->object.value.hi);
}

/* The fields of which no ray came through, as a sentence; null = none. */
static const char *fit_missing_fields(const struct fit_job *job)
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
    if (list == NULL) {
        return NULL;
    }
    return arena_printf(arena, "no ray of the field %s %s came through the clear apertures", list,
                        job->setup->lens->object_is_infinite ? "deg" : "mm");
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

/* Trace so many rays a field and add them up; also for the pupils unless that is null. */
static bool fit_job_add_rays(const struct fit_job *job, size_t rays, struct ray_data *ray_data,
                             struct thick_sums *sums, struct thick_pupil_sums *pupils,
                             struct error *error)
{
    const struct setup *setup = job->setup;
    const struct ray_data_request request = {.setup = setup,
                                             .pattern = (enum pattern)job->input->pattern,
                                             .ray_count = rays,
                                             .seed = (uint64_t)job->input->seed,
                                             .no_clip = job->input->no_clip};
    const struct ray_part *part;
    if (!ray_data_open(&request, job->run->arena, ray_data, error)) {
        return false;
    }
    *sums = thick_sums_open(setup->field_count, setup->wavelength_count,
                            fit_model(MODEL_THICK, &job->light.first, setup->lens).object,
                            job->run->arena);
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
    bool found =
        fit_job_add_rays(job, 2 * (size_t)job->input->rays, &ray_data, &sums, NULL, &ignored) &&
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
    const struct fit_input *input = job->input;
    const struct setup *setup = job->setup;
    const struct first_order *first = &job->light.first;
    struct arena *arena = job->run->arena;
    const size_t count = setup->wavelength_count;
    const bool is_image = input->match == FIT_IMAGE;
    if (count > MOST_WAVELENGTHS) {
        return fail(error, ERROR_DOMAIN, "the lens has more than %d wavelengths", MOST_WAVELENGTHS);
    }
    if (first->is_afocal) {
        return fail(error, ERROR_DOMAIN,
                    "an afocal lens has no principal planes: no thick lens equals it");
    }
    if (!fit_job_add_rays(job, (size_t)input->rays, &job->ray_data, &job->sums, job->pupils,
                          error)) {
        return false;
    }
    job->task = (struct thick_task){
        .sums = &job->sums,
        .group_count = count,
        .index_object = job->ray_data.index_object,
        .index_image = job->ray_data.index_image,
        .separate = input->chromatic,
        .planes = {setup_paraxial_image(setup->lens, first).hi,
                   isfinite(first->exit_pupil) ? first->exit_pupil : first->rear_principal},
        .plane_weights = {1, is_image ? THICK_PUPIL_WEIGHT : 1},
        .focus_weight = is_image ? THICK_FOCUS_WEIGHT : 0,
        .distortions = distortion_terms(job),
        .options = {.progress = fit_goes_on, .progress_context = job->run->watch},
        .start = fit_model(MODEL_THICK, first, setup->lens)};
    job->task.object = job->task.start.object;
    watch_begin(job->run->watch, "iterations", 0);
    /* What the fitted lens is compared with: the paraxial lens, and the thin one. */
    job->paraxial = ARENA_ARRAY(arena, count, struct thick_lens);
    job->thin = ARENA_ARRAY(arena, count, struct thick_lens);
    for (size_t g = 0; g < count; g++) {
        job->paraxial[g] = job->task.start; /* MODEL_THICK */
        job->paraxial[g].index_object = job->ray_data.index_object[g];
        job->paraxial[g].index_image = job->ray_data.index_image[g];
        job->thin[g] = fit_model(MODEL_THIN, first, setup->lens);
        job->thin[g].index_object = job->ray_data.index_object[g];
        job->thin[g].index_image = job->ray_data.index_image[g];
    }
    for (int k = 0; k < 2; k++) {
        struct thick_pupil *pupil = k == 0 ? &job->entrance : &job->exit;
        struct error ignored;
        if (setup->lens->stop == LENS_NONE ||
            !thick_fit_pupil(&job->pupils[k], k == 1, true, arena, pupil, &ignored)) {
            *pupil = (struct thick_pupil){NAN, NAN, NAN, NAN, NAN, NAN, NAN};
        }
    }
    if (!thick_fit(&job->task, arena, &job->fit, error)) {
        const char *missing = fit_missing_fields(job);
        return missing == NULL ? false : error_hint(error, "%s", missing);
    }
    if (input->show == FIT_ANSWER) {
        set_sampling(job);
    }
    return true;
}

/* The answer for one position, and for one wavelength where each has its own lens. */
struct fit_lens_row {
    const char *position, *lens, *fields, *status, *warning;
    double wavelength; /* um; NaN = all of them */
    double fnumber;
    struct thick_lens found, paraxial;
    double efl_error, front_error, rear_error;
    struct fit_sampling_change sampling;
    double rms, rms_percent, largest, rms_pupil, rms_paraxial, rms_thin;
    struct thick_pupil entrance, exit;
    double entrance_diameter, exit_diameter;
    double object; /* mm */
    double clear_percent;
    long rays, lost, iterations, terms;
};

#define LENGTH(member_name, in_unit, more)                                                         \
    COLUMN(struct fit_lens_row, member_name), .dimension = &dimension_length, .unit = in_unit,     \
                                              .flags = (more)
#define NUMBER(member_name, more) COLUMN(struct fit_lens_row, member_name), .flags = (more)

static const struct column columns[] = {
    {COLUMN_NAMED(struct fit_lens_row, position, COLUMN_BRIEF | COLUMN_SPARSE),
     .help = "zoom or focus position; absent where there is only one"},
    {COLUMN_NAMED(struct fit_lens_row, wavelength, COLUMN_ECHO | COLUMN_BRIEF | COLUMN_SPARSE),
     .dimension = &dimension_wavelength_um, .unit = "nm",
     .help = "wavelength, with --chromatic or --wavelength; absent where all are fitted together"},
    {NUMBER(fnumber, COLUMN_ECHO), .name = "fnumber", .with = "aperture", .label = "f-number",
     .help = "f-number of the rays"},
    {LENGTH(object, "mm", COLUMN_ECHO | COLUMN_INFINITE), .name = "object", .with = "object",
     .label = "object", .help = "distance of the object from the first vertex"},
    {LENGTH(found.focal, "mm", COLUMN_BRIEF), .name = "efl", .symbol = "f", .digits = 7,
     .label = "focal length f", .help = "focal length of the thick lens that equals the rays best"},
    {LENGTH(found.front, "mm", COLUMN_BRIEF), .name = "front_principal", .symbol = "H", .digits = 6,
     .label = "principal point H", .help = "its front principal point, from the first vertex"},
    {LENGTH(found.rear, "mm", COLUMN_BRIEF), .name = "rear_principal", .symbol = "H'", .digits = 6,
     .label = "principal point H'", .help = "its rear principal point, from the last vertex"},
    {LENGTH(efl_error, "mm", 0), .name = "efl_stderr", .label = "standard error of f",
     .help = "standard error of the focal length, by leaving out one field at a time"},
    {LENGTH(front_error, "mm", 0), .name = "front_principal_stderr", .label = "standard error of H",
     .help = "standard error of H"},
    {LENGTH(rear_error, "mm", 0), .name = "rear_principal_stderr", .label = "standard error of H'",
     .help = "standard error of H'"},
    {LENGTH(sampling.efl, "mm", 0), .name = "efl_sampling", .digits = 1,
     .label = "sampling error of f",
     .help = "change of the focal length when the rays per field are doubled"},
    {LENGTH(sampling.front, "mm", 0), .name = "front_principal_sampling", .digits = 1,
     .label = "sampling error of H", .help = "the same for H"},
    {LENGTH(sampling.rear, "mm", 0), .name = "rear_principal_sampling", .digits = 1,
     .label = "sampling error of H'", .help = "the same for H'"},
    {LENGTH(sampling.rms, "um", 0), .name = "rms_sampling", .digits = 1,
     .label = "sampling error of the rms", .help = "the same for rms_um"},
    {NUMBER(found.distortion[0], 0), .name = "d1", .label = "distortion d1",
     .help = "image height times 1 + d1 s + d2 s^2 + d3 s^3, s = tan^2 of the field"},
    {NUMBER(found.distortion[1], 0), .name = "d2", .label = "d2",
     .help = "second term of the distortion"},
    {NUMBER(found.distortion[2], 0), .name = "d3", .label = "d3", .help = "third term"},
    {LENGTH(rms, "um", COLUMN_BRIEF), .name = "rms", .label = "error in the image, rms",
     .help = "distance in the image between exact rays and this lens's, root mean square"},
    {NUMBER(rms_percent, 0), .name = "rms_percent", .label = "error, rms, % of the image height",
     .help = "that in percent of the height of the image"},
    {LENGTH(largest, "um", 0), .name = "largest", .label = "largest error",
     .help = "largest of these distances"},
    {LENGTH(rms_paraxial, "um", COLUMN_BRIEF), .name = "rms_paraxial",
     .label = "rms of the paraxial thick lens", .help = "the same for the paraxial f, H and H'"},
    {LENGTH(rms_thin, "um", COLUMN_BRIEF), .name = "rms_thin", .label = "rms of the thin lens",
     .help = "the same for a thin lens of that f at H', where it focuses alike"},
    {LENGTH(rms_pupil, "um", 0), .name = "rms_pupil", .label = "error in the exit pupil",
     .help = "distance between exact rays and this lens's in the exit pupil, root mean square"},
    {LENGTH(paraxial.focal, "mm", 0), .name = "paraxial_efl", .digits = 7, .label = "paraxial f",
     .help = "focal length in the paraxial limit, at the primary wavelength"},
    {LENGTH(paraxial.front, "mm", 0), .name = "paraxial_front_principal", .digits = 6,
     .label = "paraxial H", .help = "H in the paraxial limit"},
    {LENGTH(paraxial.rear, "mm", 0), .name = "paraxial_rear_principal", .digits = 6,
     .label = "paraxial H'", .help = "H' in the paraxial limit"},
    {LENGTH(entrance.place, "mm", 0), .name = "entrance_pupil", .label = "entrance pupil",
     .help = "where the rays put the entrance pupil, from the first vertex; absent without a stop"},
    {LENGTH(entrance_diameter, "mm", 0), .name = "entrance_pupil_diameter",
     .label = "entrance pupil, diameter", .help = "its diameter on the axis"},
    {NUMBER(entrance.spherical_aberration, 0), .name = "entrance_pupil_growth",
     .label = "entrance pupil, aberration",
     .help = "pupil spherical aberration a: diameter times 1 + a s, s = tan^2 of the field"},
    {LENGTH(entrance.rms, "um", 0), .name = "rms_entrance_pupil",
     .label = "entrance pupil, rms error",
     .help = "distance of the rays from their place in it, root mean square"},
    {LENGTH(exit.place, "mm", 0), .name = "exit_pupil", .label = "exit pupil",
     .help = "where the rays put the exit pupil, from the last vertex"},
    {LENGTH(exit_diameter, "mm", 0), .name = "exit_pupil_diameter", .label = "exit pupil, diameter",
     .help = "its diameter on the axis"},
    {NUMBER(exit.spherical_aberration, 0), .name = "exit_pupil_growth",
     .label = "exit pupil, aberration",
     .help = "pupil spherical aberration a: diameter times 1 + a s, s = tan^2 of the ray behind"},
    {LENGTH(exit.rms, "um", 0), .name = "rms_exit_pupil", .label = "exit pupil, rms error",
     .help = "distance of the rays from their place in it, root mean square"},
    {COLUMN_NAMED(struct fit_lens_row, rays, 0), .help = "rays that came through"},
    {NUMBER(lost, 0), .name = "lost", .label = "rays lost",
     .help = "rays stopped by clear apertures, and points of the stop that no ray reaches; the "
             "rays of gauss "
             "lie where the stop is clear"},
    {NUMBER(clear_percent, 0), .name = "clear_percent", .label = "clear share of the stop, %",
     .help = "what clear apertures leave of the stop's area, mean of the fields"},
    {COLUMN_NAMED(struct fit_lens_row, iterations, 0), .help = "of the solver"},
    {COLUMN_NAMED(struct fit_lens_row, status, 0),
     .help = "converged, or why the fit ended otherwise"},
    {COLUMN_NAMED(struct fit_lens_row, lens, COLUMN_EXTRA | COLUMN_ASSUMED), .depends = "lens",
     .help = "title of the lens"},
    {NUMBER(terms, COLUMN_EXTRA | COLUMN_ASSUMED), .name = "distortion_terms",
     .depends = "lens field distortion", .label = "terms of distortion",
     .help = "how many terms of distortion were fitted"},
    {COLUMN_NAMED(struct fit_lens_row, fields, COLUMN_EXTRA | COLUMN_ASSUMED),
     .depends = "lens field", .help = "fields of the rays"},
    {COLUMN_NAMED(struct fit_lens_row, warning, COLUMN_NOTE),
     .help = "what is doubtful; absent if nothing is"},
};

const struct sheet fit_lens_sheet = SHEET(columns, struct fit_lens_row);

static void show_answers(struct fit_job *job)
{
    const struct thick_fit *fit = &job->fit;
    const struct setup *setup = job->setup;
    const struct solver_summary *summary = &fit->summary;
    struct arena *arena = job->run->arena;
    const struct ray_model *models = fit_models(job, MODEL_FITTED, fit->lenses);
    struct thick_score score = {.largest = 0};
    const double z = job->task.planes[0];
    double height = 0, clear = 0;
    const struct ray_part *part;
    while ((part = ray_data_next(&job->ray_data)) != NULL) {
        const struct thick_rays *rays = &part->rays;
        thick_score_add(rays, models, job->task.planes[1], &score);
        for (size_t i = 0; i < rays->count; i++) {
            height = fmax(height, hypot(rays->x_out[i] + z * rays->p_out[i],
                                        rays->y_out[i] + z * rays->q_out[i]));
        }
    }
    for (size_t f = 0; f < setup->field_count; f++) {
        clear += job->ray_data.clear[f];
    }
    const char *warning = lens_warnings_join(job->warning, fit_missing_fields(job), arena);
    /* where a user must not trust the equivalent; the scale is that of a picture, not of a point */
    if (fit->rms > 0.01 * fmax(height, fabs(job->light.first.efl) / 5)) {
        const char *misfit = arena_printf(
            arena,
            "no thick lens equals these rays: they are off by %.3g %% of the image height, rms",
            100 * fit->rms / height);
        warning = lens_warnings_join(warning, misfit, arena);
    }
    for (size_t g = 0; g < (job->input->chromatic ? setup->wavelength_count : 1); g++) {
        const double *errors = &summary->standard_error[job->task.separate ? 3 * g : 0];
        const bool is_one = job->task.separate || job->input->question.wavelength.name != NULL;
        struct fit_lens_row row = {
            .position = setup->position,
            .lens = setup->lens->title,
            .fields =
                setup->fields_from != NULL ? setup->fields_from : job->input->question.fields.text,
            .status = fit_status(summary),
            .warning = warning,
            .wavelength = is_one ? setup->wavelengths[g].wavelength : NAN,
            .fnumber = job->light.first.fnumber,
            .object = job->task.object,
            .found = fit->lenses[g],
            .efl_error = errors[0],
            .front_error = errors[1],
            .rear_error = errors[2],
            .rms = fit->rms,
            .largest = score.largest,
            .rms_percent = 100 * fit->rms / height,
            .rms_pupil = fit->rms_second,
            .rms_paraxial = thick_sums_rms(&job->sums, job->paraxial, z),
            .rms_thin = thick_sums_rms(&job->sums, job->thin, z),
            .paraxial = job->paraxial[g],
            .rays = (long)job->ray_data.count,
            .lost = (long)(job->ray_data.wanted - job->ray_data.count),
            .clear_percent = 100 * clear / (double)setup->field_count,
            .terms = (long)job->task.distortions,
            .sampling = job->sampling[g],
            .iterations = summary->iterations,
            .entrance = job->entrance,
            .exit = job->exit,
            .entrance_diameter = 2 * fabs(job->entrance.radius),
            .exit_diameter = 2 * fabs(job->exit.radius),
        };
        for (size_t j = job->task.distortions; j < THICK_DISTORTIONS; j++) {
            row.found.distortion[j] = NAN;
        }
        run_emit(job->run, &row);
    }
}

bool fit_lens(const struct fit_input *input, struct run *run, struct error *error)
{
    /* the wavelengths are fitted together */
    static const struct lens_policy policy = {.wavelengths = WAVELENGTHS_ALL,
                                              .fields = FIELDS_SPREAD};
    struct lens_question question = input->question;
    struct lens *lens;
    question.field = question.field_x = NAN; /* a set of fields has an option of its own */
    if (question.lens.lens == NULL) {
        fail(error, ERROR_USAGE, "no lens is given, and no {--glass}");
        return error_hint(error, "a name of 'lenscalc list lenses', or a .lens file");
    }
    if (!isnan(input->object)) {
        lens = ARENA_NEW(run->arena, struct lens);
        *lens = *question.lens.lens;
        lens->object = (struct figure){{input->object, 0}, {NULL, 0}, LENS_NONE};
        lens->object_is_infinite = isinf(input->object);
        lens->objects = NULL;
        question.lens.lens = lens;
    }
    struct lens_cursor at = lens_begin(&question, &policy, run->arena);
    while (lens_next_setup(&at, error)) {
        struct fit_job *job = ARENA_NEW(run->arena, struct fit_job);
        *job = (struct fit_job){
            .input = input, .run = run, .setup = at.one.setup, .warning = at.one.warning};
        if (!setup_light(job->setup, 0, &job->light, error) || !fit_job_run(job, error)) {
            return false;
        }
        run->state = job;
        switch ((enum fit_show)input->show) {
        case FIT_ANSWER:
            show_answers(job);
            break;
        case FIT_RESIDUALS:
            fit_show_rays(job);
            break;
        case FIT_MODELS:
            if (!fit_show_models(job, error)) {
                return false;
            }
            break;
        case FIT_MATRIX:
            fit_show_matrix(job);
            break;
        default:
            fit_emit(job->setup->position, job->fit.parameter_count, job->fit.names,
                     job->fit.parameters, &job->fit.summary, (enum fit_show)input->show, run);
        }
    }
    return error->code == ERROR_NONE;
}
