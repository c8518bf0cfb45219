/* cli/fit_lens.c - the thick lens that equals a lens over a bundle of exact rays. */
/* SPDX-License-Identifier: MIT */
#include "cli/fit.h"
#include "design/bundle.h"
#include "design/thick.h"
#include "design/thick_element.h"
#include "file/lens_file.h"
#include "optics/wavelength.h"
#include "report/output.h"

#include <string.h>

enum { MOST_WAVELENGTHS = THICK_GROUPS };

/* The answer for one position, and for one wavelength where each has its own lens. */
struct lens_row {
    const char *position, *lens, *fields, *status, *warning;
    double wavelength; /* mm; NaN = all of them */
    double fnumber;
    double efl, front, rear, efl_error, front_error, rear_error;
    double rms, largest, rms_pupil, rms_paraxial, rms_thin;
    double paraxial_efl, paraxial_front, paraxial_rear;
    double d[THICK_DISTORTIONS];
    struct thick_pupil entrance, exit;
    double entrance_diameter, exit_diameter;
    double object; /* mm */
    long rays, lost, iterations;
};

#define LENGTH(member_name, in_unit, more)                                                         \
    COLUMN(struct lens_row, member_name), .dimension = &dimension_length, .unit = in_unit,         \
                                          .flags = (more)
#define NUMBER(member_name, more) COLUMN(struct lens_row, member_name), .flags = (more)

static const struct column columns[] = {
    {NUMBER(position, COLUMN_BRIEF), .name = "position", .label = "position",
     .help = "zoom or focus position; absent where there is only one"},
    {LENGTH(wavelength, "nm", COLUMN_ECHO), .name = "wavelength", .label = "wavelength",
     .help = "wavelength, with --chromatic or --wavelength; absent where all are fitted together"},
    {NUMBER(fnumber, COLUMN_ECHO), .name = "fnumber", .with = "aperture", .label = "f-number",
     .help = "f-number of the bundle"},
    {LENGTH(object, "mm", COLUMN_ECHO | COLUMN_INFINITE), .name = "object", .with = "object",
     .label = "object", .help = "distance of the object from the first vertex"},
    {LENGTH(efl, "mm", COLUMN_BRIEF), .name = "efl", .symbol = "f", .digits = 7,
     .label = "focal length f", .help = "focal length of the thick lens that equals the rays best"},
    {LENGTH(front, "mm", COLUMN_BRIEF), .name = "front_principal", .symbol = "H", .digits = 6,
     .label = "principal point H", .help = "its front principal point, from the first vertex"},
    {LENGTH(rear, "mm", COLUMN_BRIEF), .name = "rear_principal", .symbol = "H'", .digits = 6,
     .label = "principal point H'", .help = "its rear principal point, from the last vertex"},
    {LENGTH(efl_error, "mm", 0), .name = "efl_stderr", .label = "standard error of f",
     .help = "standard error of the focal length"},
    {LENGTH(front_error, "mm", 0), .name = "front_principal_stderr", .label = "of H",
     .help = "standard error of H"},
    {LENGTH(rear_error, "mm", 0), .name = "rear_principal_stderr", .label = "of H'",
     .help = "standard error of H'"},
    {NUMBER(d[0], 0), .name = "d1", .label = "distortion d1",
     .help = "image height times 1 + d1 s + d2 s^2 + d3 s^3, s = tan^2 of the field"},
    {NUMBER(d[1], 0), .name = "d2", .label = "d2", .help = "second term of the distortion"},
    {NUMBER(d[2], 0), .name = "d3", .label = "d3", .help = "third term"},
    {LENGTH(rms, "um", COLUMN_BRIEF), .name = "rms", .label = "error in the image, rms",
     .help = "distance in the image between exact rays and this lens's, root mean square"},
    {LENGTH(largest, "um", 0), .name = "largest", .label = "largest error",
     .help = "largest of these distances"},
    {LENGTH(rms_paraxial, "um", COLUMN_BRIEF), .name = "rms_paraxial",
     .label = "of the paraxial thick lens", .help = "the same for the paraxial f, H and H'"},
    {LENGTH(rms_thin, "um", COLUMN_BRIEF), .name = "rms_thin", .label = "of the thin lens",
     .help = "the same for a thin lens of that f at H', where it focuses alike"},
    {LENGTH(rms_pupil, "um", 0), .name = "rms_pupil", .label = "error in the exit pupil",
     .help = "distance between exact rays and this lens's in the exit pupil, root mean square"},
    {LENGTH(paraxial_efl, "mm", 0), .name = "paraxial_efl", .digits = 7, .label = "paraxial f",
     .help = "focal length in the paraxial limit, at the primary wavelength"},
    {LENGTH(paraxial_front, "mm", 0), .name = "paraxial_front_principal", .digits = 6,
     .label = "paraxial H", .help = "H in the paraxial limit"},
    {LENGTH(paraxial_rear, "mm", 0), .name = "paraxial_rear_principal", .digits = 6,
     .label = "paraxial H'", .help = "H' in the paraxial limit"},
    {LENGTH(entrance.place, "mm", 0), .name = "entrance_pupil", .label = "entrance pupil",
     .help = "where the rays put the entrance pupil, from the first vertex; absent without a stop"},
    {LENGTH(entrance_diameter, "mm", 0), .name = "entrance_pupil_diameter", .label = "its diameter",
     .help = "its diameter on the axis"},
    {NUMBER(entrance.growth, 0), .name = "entrance_pupil_growth", .label = "its growth",
     .help = "diameter times 1 + growth s, s = tan^2 of the field"},
    {LENGTH(entrance.rms, "um", 0), .name = "rms_entrance_pupil", .label = "its error",
     .help = "distance of the rays from their place in it, root mean square"},
    {LENGTH(exit.place, "mm", 0), .name = "exit_pupil", .label = "exit pupil",
     .help = "where the rays put the exit pupil, from the last vertex"},
    {LENGTH(exit_diameter, "mm", 0), .name = "exit_pupil_diameter", .label = "its diameter",
     .help = "its diameter on the axis"},
    {NUMBER(exit.growth, 0), .name = "exit_pupil_growth", .label = "its growth",
     .help = "diameter times 1 + growth s, s = tan^2 of the ray behind"},
    {LENGTH(exit.rms, "um", 0), .name = "rms_exit_pupil", .label = "its error",
     .help = "distance of the rays from their place in it, root mean square"},
    {NUMBER(rays, 0), .name = "rays", .label = "rays", .help = "rays that came through"},
    {NUMBER(lost, 0), .name = "lost", .label = "rays lost",
     .help = "rays stopped by rims, and points of the stop that no ray reaches"},
    {NUMBER(iterations, 0), .name = "iterations", .label = "iterations", .help = "of the solver"},
    {NUMBER(status, 0), .name = "status", .label = "status",
     .help = "converged, or why the fit ended otherwise"},
    {NUMBER(lens, COLUMN_EXTRA | COLUMN_ASSUMED), .name = "lens", .depends = "lens",
     .label = "lens", .help = "title of the lens"},
    {NUMBER(fields, COLUMN_EXTRA | COLUMN_ASSUMED), .name = "fields", .depends = "lens field",
     .label = "fields", .help = "fields of the bundle"},
    {NUMBER(warning, 0), .name = "warning", .label = "warning",
     .help = "what is doubtful; absent if nothing is"},
};

const struct sheet fit_lens_sheet = {columns, sizeof columns / sizeof columns[0],
                                     sizeof(struct lens_row)};

/* One ray: where in field and pupil the equivalent fails. */
struct ray_row {
    const char *position;
    double wavelength; /* mm */
    double field;      /* rad, or mm */
    double object_height, stop_x, stop_y, dx, dy, distance;
};

#define RAY(member_name, more) COLUMN(struct ray_row, member_name), .flags = (more)

static const struct column ray_columns[] = {
    {RAY(position, 0), .name = "position", .label = "position", .help = "zoom or focus position"},
    {RAY(wavelength, COLUMN_ECHO | COLUMN_BRIEF), .dimension = &dimension_length, .unit = "nm",
     .name = "wavelength", .label = "wavelength", .help = "wavelength"},
    {RAY(field, COLUMN_BRIEF), .dimension = &dimension_angle, .unit = "deg", .name = "field",
     .label = "field", .help = "field angle; absent for an object nearby"},
    {RAY(object_height, 0), .dimension = &dimension_length, .unit = "mm", .name = "object_height",
     .label = "object height", .help = "height of the object point; absent for a distant object"},
    {RAY(stop_x, COLUMN_BRIEF), .name = "stop_x", .label = "stop x",
     .help = "where the ray crosses the stop, in shares of its radius"},
    {RAY(stop_y, COLUMN_BRIEF), .name = "stop_y", .label = "stop y", .help = "the same"},
    {RAY(dx, COLUMN_BRIEF), .dimension = &dimension_length, .unit = "um", .name = "dx",
     .label = "dx", .help = "the thick lens's ray less the exact one, in the image"},
    {RAY(dy, COLUMN_BRIEF), .dimension = &dimension_length, .unit = "um", .name = "dy",
     .label = "dy", .help = "the same along y"},
    {RAY(distance, COLUMN_BRIEF), .dimension = &dimension_length, .unit = "um", .name = "distance",
     .label = "distance", .help = "length of (dx, dy)"},
};

const struct sheet fit_ray_sheet = {ray_columns, sizeof ray_columns / sizeof ray_columns[0],
                                    sizeof(struct ray_row)};

struct matrix_row {
    const char *position, *row;
    double x, y, z, w;
};

#define CELL(member_name)                                                                          \
    COLUMN(struct matrix_row, member_name), .name = #member_name, .flags = COLUMN_BRIEF,           \
                                            .label = #member_name

static const struct column matrix_columns[] = {
    {COLUMN(struct matrix_row, position), .name = "position", .label = "position",
     .help = "zoom or focus position"},
    {CELL(row), .help = "row of the matrix, from H to H'"},
    {CELL(x), .help = "times x of the object point"},
    {CELL(y), .help = "times y"},
    {CELL(z), .help = "times z in mm from H, negative in front of it"},
    {CELL(w), .help = "times 1; the image point's z is from H too"},
};

const struct sheet fit_matrix_sheet = {
    matrix_columns, sizeof matrix_columns / sizeof matrix_columns[0], sizeof(struct matrix_row)};

/* A fit at work. */
struct job {
    const struct fit_input *input;
    struct run *run;
    struct lens_question question;
    const struct lens *lens; /* in this position */
    const char *position, *fields, *warning;
    struct first_order first;
    double wavelengths[MOST_WAVELENGTHS], weights[MOST_WAVELENGTHS];
    size_t wavelength_count;
    double field[BUNDLE_FIELDS], field_weights[BUNDLE_FIELDS];
    size_t field_count;
    struct bundle bundle;
    struct thick_task task;
    struct thick_fit fit;
    struct thick_lens *paraxial, *thin; /* one a wavelength */
    double *dx, *dy;
};

/* `0,10:2,14deg`: fields with weights. */
static bool read_fields(struct job *job, struct error *error)
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

/* Up to the corner of 35 mm film, if a lens of straight lines would reach it below 60 degrees. */
static bool assume_fields(struct job *job, struct error *error)
{
    static const double shares[] = {0, 0.5, 0.75, 1};
    double tangent = 21.633 / fabs(job->first.efl);
    if (!job->lens->object_is_infinite || !(tangent < 1.732)) {
        return fail(error, ERROR_DOMAIN, "the lens states no fields: give --field");
    }
    for (size_t i = 0; i < sizeof shares / sizeof shares[0]; i++) {
        job->field[i] = atan(shares[i] * tangent);
        job->field_weights[i] = 1;
    }
    job->field_count = sizeof shares / sizeof shares[0];
    job->fields = "0, 1/2, 3/4 and 1 of the half diagonal of 35 mm film, as the lens states none";
    return true;
}

/* The fields of the file, as angles or heights of the object. */
static bool take_fields(struct job *job, struct error *error)
{
    const struct lens *lens = job->lens;
    const struct first_order *first = &job->first;
    if (job->input->fields != NULL) {
        return read_fields(job, error);
    }
    if (lens->field_count == 0) {
        return assume_fields(job, error);
    }
    if (lens->field_count > BUNDLE_FIELDS) {
        return fail(error, ERROR_DOMAIN, "the lens has more than %d fields", BUNDLE_FIELDS);
    }
    for (size_t i = 0; i < lens->field_count; i++) {
        double value = lens->fields[i].value.hi;
        if (lens->field_kind == FIELD_IMAGE) {
            value = lens->object_is_infinite ? atan(value * first->power / first->index_object)
                                             : value / first->magnification;
        } else if (lens->field_kind == FIELD_ANGLE && !lens->object_is_infinite) {
            value = -tan(value) * (lens->object.value.hi + first->entrance_pupil);
        } else if (lens->field_kind == FIELD_HEIGHT && lens->object_is_infinite) {
            return fail(error, ERROR_DOMAIN, "an object at infinity has no height: give --field");
        }
        job->field[i] = value;
        job->field_weights[i] = 1;
    }
    job->field_count = lens->field_count;
    job->fields = "of the lens";
    return true;
}

static bool take_wavelengths(struct job *job, struct error *error)
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
static void set_rivals(struct job *job)
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
static double image_place(const struct job *job)
{
    const struct surface *last = &job->lens->surfaces[job->lens->surface_count - 1];
    bool table = job->lens->focus == FOCUS_TABLE && last->has_thickness;
    return table ? surface_advance(last).hi : job->first.image;
}

static bool fit_position(struct job *job, struct error *error)
{
    const struct fit_input *input = job->input;
    struct arena *arena = job->run->arena;
    const struct bundle_request request = {.lens = job->lens,
                                           .first = &job->first,
                                           .wavelengths = job->wavelengths,
                                           .wavelength_weights = job->weights,
                                           .wavelength_count = job->wavelength_count,
                                           .fields = job->field,
                                           .field_weights = job->field_weights,
                                           .field_count = job->field_count,
                                           .rings = (size_t)input->rings,
                                           .arms = (size_t)input->arms};
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
        .plane_weights = {1, THICK_PUPIL_WEIGHT},
        .distortions = (size_t)input->distortion,
        .start = thick_of(&job->first, job->lens)};
    job->task.object = job->task.start.object;
    set_rivals(job);
    job->dx = ARENA_ARRAY(arena, job->bundle.wanted, double);
    job->dy = ARENA_ARRAY(arena, job->bundle.wanted, double);
    return thick_fit(&job->task, arena, &job->fit, error);
}

static void set_pupils(const struct job *job, struct lens_row *row)
{
    const struct thick_pupil none = {NAN, NAN, NAN, NAN, NAN, NAN, NAN};
    struct error ignored;
    row->entrance = row->exit = none;
    if (job->lens->stop == LENS_NONE ||
        !thick_fit_pupil(&job->bundle.rays, false, true, job->run->arena, &row->entrance,
                         &ignored)) {
        row->entrance = none;
    }
    if (job->lens->stop == LENS_NONE ||
        !thick_fit_pupil(&job->bundle.rays, true, true, job->run->arena, &row->exit, &ignored)) {
        row->exit = none;
    }
    row->entrance_diameter = 2 * fabs(row->entrance.radius);
    row->exit_diameter = 2 * fabs(row->exit.radius);
}

/* Fields of which no ray came through. */
static const char *missing_fields(const struct job *job)
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
    if (list == NULL) {
        return job->warning;
    }
    const char *text = arena_printf(arena, "no ray of the field %s %s came through the rims", list,
                                    job->lens->object_is_infinite ? "deg" : "mm");
    return job->warning == NULL ? text : arena_printf(arena, "%s; %s", job->warning, text);
}

/* Of group g, or of all rays. */
static void emit_answer(struct job *job, size_t g)
{
    const struct thick_fit *fit = &job->fit;
    const struct solver_summary *summary = &fit->summary;
    size_t base = job->task.separate ? 3 * g : 0;
    double plane = job->task.planes[0];
    const struct thick_rays *rays = &job->bundle.rays;
    bool one = job->task.separate || job->input->question.wavelength.name != NULL;
    struct lens_row row = {
        .position = job->position,
        .lens = job->lens->title,
        .fields = job->fields,
        .status = fit_status(summary),
        .warning = missing_fields(job),
        .wavelength = one ? lens_wavelength_own(job->wavelengths[g]) : NAN,
        .fnumber = job->first.fnumber,
        .object = job->task.object,
        .efl = fit->lenses[g].focal,
        .front = fit->lenses[g].front,
        .rear = fit->lenses[g].rear,
        .efl_error = summary->standard_error[base],
        .front_error = summary->standard_error[base + 1],
        .rear_error = summary->standard_error[base + 2],
        .rms = fit->rms,
        .largest = fit->largest,
        .rms_pupil = fit->rms_second,
        .rms_paraxial = thick_errors(rays, job->paraxial, plane, job->dx, job->dy),
        .rms_thin = thick_errors(rays, job->thin, plane, job->dx, job->dy),
        .paraxial_efl = job->first.efl,
        .paraxial_front = job->first.front_principal,
        .paraxial_rear = job->first.rear_principal,
        .rays = (long)rays->count,
        .lost = (long)(job->bundle.wanted - rays->count),
        .iterations = summary->iterations,
    };
    for (size_t j = 0; j < THICK_DISTORTIONS; j++) {
        row.d[j] = j < job->task.distortions ? fit->lenses[g].distortion[j] : NAN;
    }
    set_pupils(job, &row);
    run_emit(job->run, &row);
}

static void emit_rays(struct job *job)
{
    const struct thick_rays *rays = &job->bundle.rays;
    thick_errors(rays, job->fit.lenses, job->task.planes[0], job->dx, job->dy);
    for (size_t i = 0; i < rays->count; i++) {
        double field = job->field[job->bundle.field[i]];
        bool angle = job->lens->object_is_infinite;
        const struct ray_row row = {.position = job->position,
                                    .wavelength =
                                        lens_wavelength_own(job->wavelengths[rays->group[i]]),
                                    .field = angle ? field : NAN,
                                    .object_height = angle ? NAN : field,
                                    .stop_x = rays->stop_x[i],
                                    .stop_y = rays->stop_y[i],
                                    .dx = job->dx[i],
                                    .dy = job->dy[i],
                                    .distance = hypot(job->dx[i], job->dy[i])};
        if (!run_emit(job->run, &row)) {
            return;
        }
    }
}

/* As of lenscalc matrix --perspective: z from H before and behind. */
static void emit_matrix(struct job *job)
{
    const struct thick_lens *lens = &job->fit.lenses[0];
    double n = lens->index_object, m = lens->index_image, power = 1 / lens->focal;
    double t = job->first.length + lens->rear - lens->front;
    const struct matrix_row rows[4] = {
        {job->position, "x", 1, 0, 0, 0},
        {job->position, "y", 0, 1, 0, 0},
        {job->position, "z", 0, 0, m / n + t * power / n, t},
        {job->position, "w", 0, 0, power / n, 1},
    };
    for (int i = 0; i < 4 && run_emit(job->run, &rows[i]); i++) {
    }
}

static bool save_lens(struct job *job, struct error *error)
{
    struct arena *arena = job->run->arena;
    struct lens_row row;
    set_pupils(job, &row);
    const struct thick_stand_in stand_in = {
        .thick = job->fit.lenses[0],
        .length = job->first.length,
        .pupil = row.entrance.place,
        .pupil_diameter = row.entrance_diameter,
        .fnumber = job->first.fnumber,
        .image = job->task.planes[0],
        .title = arena_printf(arena, "thick lens that equals %s%s%s",
                              job->lens->title != NULL ? job->lens->title : "a lens",
                              job->position != NULL ? " at " : "",
                              job->position != NULL ? job->position : ""),
        .note =
            arena_printf(arena, "fitted by lenscalc to %zu exact rays, rms %.4g um in the image",
                         job->bundle.rays.count, 1000 * job->fit.rms),
    };
    const struct lens lens = thick_element_lens(job->lens, &stand_in, arena);
    struct text text = lens_write(&lens, arena);
    return output_file(job->input->output, text.start, text.length, arena, error);
}

static bool visit(const struct lens_case *one, struct run *run, const void *context,
                  struct error *error)
{
    const struct fit_input *input = context;
    struct job job = {.input = input,
                      .run = run,
                      .lens = one->lens,
                      .position = one->position,
                      .warning = one->warning,
                      .first = one->first};
    if (!take_wavelengths(&job, error) || !take_fields(&job, error) || !fit_position(&job, error)) {
        return false;
    }
    const struct fit_found found = {job.position, job.fit.parameter_count, job.fit.names,
                                    job.fit.parameters, &job.fit.summary};
    if (input->show == FIT_ANSWER) {
        for (size_t g = 0; g < (input->chromatic ? job.wavelength_count : 1); g++) {
            emit_answer(&job, g);
        }
    } else if (input->show == FIT_RESIDUALS) {
        emit_rays(&job);
    } else if (input->show == FIT_MATRIX) {
        emit_matrix(&job);
    } else {
        fit_emit(&found, (enum fit_show)input->show, run);
    }
    return input->output == NULL || save_lens(&job, error);
}

bool fit_lens(const struct fit_input *input, struct run *run, struct error *error)
{
    struct lens_question question = input->question;
    struct lens *lens;
    if (question.lens.lens == NULL) {
        fail(error, ERROR_USAGE, "no lens is given, and no --glass");
        return error_hint(error, "a name of 'lenscalc list lenses', or a .lens file");
    }
    bool all = question.position != NULL && text_same(text_of(question.position), "all");
    if (input->output != NULL && all && question.lens.lens->position_count > 1) {
        return fail(error, ERROR_USAGE, "--output holds one position: name it with --position");
    }
    if (!isnan(input->object)) {
        lens = ARENA_NEW(run->arena, struct lens);
        *lens = *question.lens.lens;
        lens->object = (struct figure){{input->object, 0}, {NULL, 0}, LENS_NONE};
        lens->object_is_infinite = isinf(input->object);
        lens->objects = NULL;
        question.lens.lens = lens;
    }
    /* one case a position: the wavelengths are fitted together */
    if (question.wavelength.name == NULL) {
        question.wavelength.wavelength = lens_primary_wavelength(question.lens.lens);
        question.wavelength.name = "primary";
    }
    return lens_each(&question, run, visit, input, error);
}
