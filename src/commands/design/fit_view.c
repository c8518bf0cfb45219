/* commands/design/fit_view.c - what a fit found, as rows and files. */
/* SPDX-License-Identifier: MIT */
#include "analysis/model/lens_model.h"
#include "base/constants.h"
#include "base/watch.h"
#include "commands/design/fit.h"
#include "draw/ray_map.h"
#include "draw/svg.h"
#include "file/lens_file.h"
#include "optics/thick_lens.h"

/* One row of parameters or correlations, whatever was fitted. */
struct fit_row {
    const char *position, *parameter, *with;
    double value, error, correlation;
    const char *note; /* "at its bound", "not determined"; null = nothing */
};

static const struct column parameter_columns[] = {
    {COLUMN_NAMED(struct fit_row, position, COLUMN_BRIEF | COLUMN_SPARSE),
     .help = "zoom or focus position"},
    {COLUMN_NAMED(struct fit_row, parameter, COLUMN_BRIEF), .help = "what was fitted"},
    {COLUMN_NAMED(struct fit_row, value, COLUMN_BRIEF), .digits = 9,
     .help = "its value; lengths in mm"},
    {COLUMN(struct fit_row, error), .flags = COLUMN_BRIEF, .name = "stderr",
     .label = "standard error",
     .help = "standard error; absent at a bound and where the data leave it open"},
    {COLUMN_NAMED(struct fit_row, note, 0),
     .help = "at its bound, or not determined; absent if neither"},
};

static const struct column correlation_columns[] = {
    {COLUMN_NAMED(struct fit_row, position, COLUMN_BRIEF | COLUMN_SPARSE),
     .help = "zoom or focus position"},
    {COLUMN_NAMED(struct fit_row, parameter, COLUMN_BRIEF), .help = "one parameter"},
    {COLUMN_NAMED(struct fit_row, with, COLUMN_BRIEF), .help = "another"},
    {COLUMN_NAMED(struct fit_row, correlation, COLUMN_BRIEF),
     .help = "covariance over the product of the standard errors, -1 to 1"},
};

const struct sheet fit_parameter_sheet = SHEET(parameter_columns, struct fit_row);
const struct sheet fit_correlation_sheet = SHEET(correlation_columns, struct fit_row);

void fit_emit(const char *position, size_t count, const char *const *names, const double *values,
              const struct solver_summary *summary, enum fit_show show, struct run *run)
{
    const double *errors = summary->standard_error;
    bool goes_on = true;
    for (size_t i = 0; i < count && goes_on; i++) {
        if (show != FIT_CORRELATIONS) {
            const char *undetermined = summary->undetermined[i] ? "not determined" : NULL;
            const struct fit_row row = {.position = position,
                                        .parameter = names[i],
                                        .value = values[i],
                                        .error = errors[i],
                                        .note =
                                            summary->at_bound[i] ? "at its bound" : undetermined};
            goes_on = run_emit(run, &row);
            continue;
        }
        for (size_t j = i + 1; j < count && goes_on; j++) {
            const struct fit_row row = {.position = position,
                                        .parameter = names[i],
                                        .with = names[j],
                                        .correlation = summary->covariance[i * count + j] /
                                                       (errors[i] * errors[j])};
            goes_on = run_emit(run, &row);
        }
    }
}

const char *fit_status(const struct solver_summary *summary)
{
    static const char *const words[] = {
        [SOLVER_CONVERGED] = "converged",
        [SOLVER_LIMIT] = "not converged: as many iterations as allowed",
        [SOLVER_STOPPED] = "stopped",
        [SOLVER_STUCK] = "not converged: no step lowers the residual",
    };
    return words[summary->status];
}

bool fit_goes_on(void *watch, const struct solver_progress *progress)
{
    (void)progress;
    return watch_add(watch, 1);
}

/* One ray: where in field and pupil the equivalent fails. */
struct ray_row {
    const char *position;
    double wavelength; /* um */
    double field;      /* rad, or mm */
    double object_height, stop_x, stop_y, dx, dy, distance;
};

#define RAY(member_name, more) COLUMN(struct ray_row, member_name), .flags = (more)

static const struct column ray_columns[] = {
    {COLUMN_NAMED(struct ray_row, position, COLUMN_BRIEF | COLUMN_SPARSE),
     .help = "zoom or focus position"},
    {COLUMN_NAMED(struct ray_row, wavelength, COLUMN_ECHO | COLUMN_BRIEF),
     .dimension = &dimension_wavelength_um, .unit = "nm", .help = "wavelength"},
    {COLUMN_NAMED(struct ray_row, field, COLUMN_BRIEF), .dimension = &dimension_angle,
     .unit = "deg", .help = "field angle; absent for an object nearby"},
    {RAY(object_height, 0), .dimension = &dimension_length, .unit = "mm", .name = "object_height",
     .label = "object height", .help = "height of the object point; absent for a distant object"},
    {RAY(stop_x, COLUMN_BRIEF), .name = "stop_x", .label = "stop x",
     .help = "where the ray crosses the stop, in shares of its radius"},
    {RAY(stop_y, COLUMN_BRIEF), .name = "stop_y", .label = "stop y", .help = "the same"},
    {COLUMN_NAMED(struct ray_row, dx, COLUMN_BRIEF), .dimension = &dimension_length, .unit = "um",
     .help = "the thick lens's ray less the exact one, in the image"},
    {COLUMN_NAMED(struct ray_row, dy, COLUMN_BRIEF), .dimension = &dimension_length, .unit = "um",
     .help = "the same along y"},
    {COLUMN_NAMED(struct ray_row, distance, COLUMN_BRIEF), .dimension = &dimension_length,
     .unit = "um", .help = "length of (dx, dy)"},
};

const struct sheet fit_ray_sheet = SHEET(ray_columns, struct ray_row);

/* A model beside its rivals. */
struct model_row {
    const char *position, *model;
    double efl, front, rear, rms, largest, rms_pupil; /* mm */
    double rms_direction;                             /* rad */
};

#define MODEL(member_name, in_unit)                                                                \
    COLUMN(struct model_row, member_name), .dimension = &dimension_length, .unit = in_unit,        \
                                           .flags = COLUMN_BRIEF

static const struct column model_columns[] = {
    {COLUMN_NAMED(struct model_row, position, COLUMN_BRIEF | COLUMN_SPARSE),
     .help = "zoom or focus position"},
    {COLUMN_NAMED(struct model_row, model, COLUMN_BRIEF),
     .help =
         "fitted; paraxial, at each wavelength; thick, the same at the primary one; thin, its f "
         "at H', where it focuses alike; pinhole, in its H"},
    {MODEL(efl, "mm"), .name = "efl", .label = "f", .digits = 7, .help = "its focal length"},
    {MODEL(front, "mm"), .name = "front_principal", .label = "H", .digits = 6,
     .help = "its H, from the first vertex"},
    {MODEL(rear, "mm"), .name = "rear_principal", .label = "H'", .digits = 6,
     .help = "its H', from the last vertex"},
    {MODEL(rms, "um"), .name = "rms", .label = "image rms",
     .help = "distance of its rays from the exact ones in the image, root mean square"},
    {MODEL(largest, "um"), .name = "largest", .label = "largest",
     .help = "largest of these distances"},
    {MODEL(rms_pupil, "um"), .name = "rms_pupil", .label = "exit pupil rms",
     .help = "the same in the exit pupil"},
    {COLUMN(struct model_row, rms_direction), .dimension = &dimension_angle, .unit = "deg",
     .flags = COLUMN_BRIEF, .name = "rms_direction", .label = "direction rms",
     .help = "angle between its rays and the exact ones behind the lens, root mean square"},
};

const struct sheet fit_model_sheet = SHEET(model_columns, struct model_row);

struct matrix_row {
    const char *position, *row;
    double x, y, z, w;
};

#define CELL(member_name)                                                                          \
    COLUMN(struct matrix_row, member_name), .name = #member_name, .flags = COLUMN_BRIEF,           \
                                            .label = #member_name

static const struct column matrix_columns[] = {
    {COLUMN_NAMED(struct matrix_row, position, COLUMN_BRIEF | COLUMN_SPARSE),
     .help = "zoom or focus position"},
    {CELL(row), .help = "row of the matrix, from H to H'"},
    {CELL(x), .help = "times x of the object point"},
    {CELL(y), .help = "times y"},
    {CELL(z), .help = "times z in mm from H, negative in front of it"},
    {CELL(w), .help = "times 1; the image point's z is from H too"},
};

const struct sheet fit_matrix_sheet = SHEET(matrix_columns, struct matrix_row);
struct ray_model *fit_models(const struct fit_job *job, enum lens_model kind,
                             const struct thick_lens *lenses)
{
    const size_t count = job->setup->wavelength_count;
    struct ray_model *models = ARENA_ARRAY(job->run->arena, count, struct ray_model);
    for (size_t g = 0; g < count; g++) {
        models[g] = ray_model_of_thick(kind, lenses[g], job->task.planes[0]);
    }
    return models;
}

void fit_show_rays(struct fit_job *job)
{
    const struct setup *setup = job->setup;
    const bool is_angle = setup->lens->object_is_infinite;
    const struct ray_model *models = fit_models(job, MODEL_FITTED, job->fit.lenses);
    const struct ray_part *part;
    double dx[RAY_PART], dy[RAY_PART];
    while ((part = ray_data_next(&job->ray_data)) != NULL) {
        const struct thick_rays *rays = &part->rays;
        thick_errors(rays, models, dx, dy);
        for (size_t i = 0; i < rays->count; i++) {
            const double field = fit_field(job, rays->field[i]);
            const struct ray_row row = {.position = setup->position,
                                        .wavelength = setup->wavelengths[rays->group[i]].wavelength,
                                        .field = is_angle ? field : NAN,
                                        .object_height = is_angle ? NAN : field,
                                        .stop_x = rays->stop_x[i],
                                        .stop_y = rays->stop_y[i],
                                        .dx = dx[i],
                                        .dy = dy[i],
                                        .distance = hypot(dx[i], dy[i])};
            if (!run_emit(job->run, &row)) {
                ray_data_rewind(&job->ray_data);
                return;
            }
        }
    }
}

/* What each surface does near the axis, at each wavelength, is a thick lens. */
static bool fit_paraxial_models(const struct fit_job *job, struct thick_lens *lenses,
                                struct error *error)
{
    for (size_t g = 0; g < job->setup->wavelength_count; g++) {
        struct setup_light light;
        if (!setup_light(job->setup, g, &light, error)) {
            return false;
        }
        lenses[g] = lens_model_thick(MODEL_PARAXIAL, &light.first, job->task.object);
    }
    return true;
}

/* The models of lenscalc bench and render beside each other. */
bool fit_show_models(struct fit_job *job, struct error *error)
{
    struct thick_lens *paraxial =
        ARENA_ARRAY(job->run->arena, job->setup->wavelength_count, struct thick_lens);
    if (!fit_paraxial_models(job, paraxial, error)) {
        return false;
    }
    const struct {
        enum lens_model word;
        const struct ray_model *lenses;
    } models[] = {{MODEL_FITTED, fit_models(job, MODEL_FITTED, job->fit.lenses)},
                  {MODEL_PARAXIAL, fit_models(job, MODEL_THICK, paraxial)},
                  {MODEL_THICK, fit_models(job, MODEL_THICK, job->paraxial)},
                  {MODEL_THIN, fit_models(job, MODEL_THIN, job->thin)},
                  {MODEL_PINHOLE, fit_models(job, MODEL_PINHOLE, job->paraxial)}};
    enum { MODELS = sizeof models / sizeof models[0] };
    struct thick_score scores[MODELS] = {{.largest = 0}};
    const struct ray_part *part;
    while ((part = ray_data_next(&job->ray_data)) != NULL) {
        for (size_t i = 0; i < MODELS; i++) {
            thick_score_add(&part->rays, models[i].lenses, job->task.planes[1], &scores[i]);
        }
    }
    for (size_t i = 0; i < MODELS; i++) {
        const struct thick_lens *lens = &models[i].lenses[0].thick;
        const struct model_row row = {.position = job->setup->position,
                                      .model = lens_models[models[i].word].word,
                                      .efl = lens->focal,
                                      .front = lens->front,
                                      .rear = lens->rear,
                                      .rms = scores[i].rms[0],
                                      .largest = scores[i].largest,
                                      .rms_pupil = scores[i].rms[1],
                                      .rms_direction = scores[i].direction};
        if (!run_emit(job->run, &row)) {
            return true;
        }
    }
    return true;
}

/* As of lenscalc matrix --perspective: z from H before and behind. */
void fit_show_matrix(struct fit_job *job)
{
    const struct thick_lens *lens = &job->fit.lenses[0];
    double n = lens->index_object, m = lens->index_image, power = 1 / lens->focal;
    double t = job->light.first.length + lens->rear - lens->front;
    const struct matrix_row rows[4] = {
        {job->setup->position, "x", 1, 0, 0, 0},
        {job->setup->position, "y", 0, 1, 0, 0},
        {job->setup->position, "z", 0, 0, m / n + t * power / n, t},
        {job->setup->position, "w", 0, 0, power / n, 1},
    };
    for (int i = 0; i < 4 && run_emit(job->run, &rows[i]); i++) {
    }
}

bool fit_draw_map(const struct artifact_job *wanted, struct output *sink, struct error *error)
{
    struct fit_job *job = wanted->run->state;
    struct arena *arena = job->run->arena;
    const struct thick_lens *lens = &job->fit.lenses[0];
    const char *title = job->setup->lens->title != NULL ? job->setup->lens->title : "lens";
    struct ray_map map = {.unit = "um"};
    struct svg svg = {.arena = arena};
    /* Labels of the columns and rows of the map. */
    bool angle = job->setup->lens->object_is_infinite;
    const char **columns = ARENA_ARRAY(arena, job->setup->field_count, const char *);
    const char **rows = ARENA_ARRAY(arena, job->setup->wavelength_count, const char *);
    for (size_t i = 0; i < job->setup->field_count; i++) {
        columns[i] = angle ? arena_printf(arena, "%.4g°", fit_field(job, i) * DEGREES_PER_RADIAN)
                           : arena_printf(arena, "%.4g mm", fit_field(job, i));
    }
    for (size_t i = 0; i < job->setup->wavelength_count; i++) {
        rows[i] = arena_printf(arena, "%.4g nm", 1000 * job->setup->wavelengths[i].wavelength);
    }
    map.columns = columns;
    map.column_count = job->setup->field_count;
    map.rows = rows;
    map.row_count = job->setup->wavelength_count;
    /* the points of all rays; those that came through first */
    const struct ray_data *ray_data = &job->ray_data;
    const struct ray_model *models = fit_models(job, MODEL_FITTED, job->fit.lenses);
    const struct ray_part *part;
    struct ray_map_point *points =
        ARENA_ARRAY(job->run->arena, ray_data->wanted, struct ray_map_point);
    double dx[RAY_PART], dy[RAY_PART], largest = 0;
    size_t count = 0, lost = ray_data->count;
    while ((part = ray_data_next(&job->ray_data)) != NULL) {
        const struct thick_rays *rays = &part->rays;
        thick_errors(rays, models, dx, dy);
        for (size_t i = 0; i < rays->count; i++) {
            points[count++] =
                (struct ray_map_point){rays->field[i],  rays->group[i], rays->stop_x[i],
                                       rays->stop_y[i], 1000 * dx[i],   1000 * dy[i]};
            largest = fmax(largest, hypot(dx[i], dy[i]));
        }
        for (size_t i = 0; i < part->lost_count; i++) {
            const struct ray_data_loss *at = &part->lost[i];
            points[lost++] =
                (struct ray_map_point){at->field, at->group, at->stop_x, at->stop_y, NAN, NAN};
        }
    }
    map.points = points;
    map.count = lost;
    map.title = arena_printf(arena, "Exact rays against the fitted thick lens of %s%s%s", title,
                             job->setup->position != NULL ? ", " : "",
                             job->setup->position != NULL ? job->setup->position : "");
    map.subtitle = job->task.separate
                       ? arena_printf(arena,
                                      "a thick lens for each wavelength; rms %.4g um, "
                                      "largest %.4g um",
                                      1000 * job->fit.rms, 1000 * largest)
                       : arena_printf(arena,
                                      "f %.7g mm, H %.6g mm, H' %.6g mm; rms %.4g um, "
                                      "largest %.4g um",
                                      lens->focal, lens->front, lens->rear, 1000 * job->fit.rms,
                                      1000 * largest);
    return ray_map_draw(&map, &svg, error) && drawing_write(wanted, &svg, sink, error);
}

struct lens fit_equal_lens(const struct fit_job *job)
{
    struct arena *arena = job->run->arena;
    const struct thick_stand_in stand_in = {
        .thick = job->fit.lenses[0],
        .length = job->light.first.length,
        .pupil = job->entrance.place,
        .pupil_diameter = 2 * fabs(job->entrance.radius),
        .fnumber = job->light.first.fnumber,
        .image = job->task.planes[0],
        .title = arena_printf(arena, "thick lens that equals %s%s%s",
                              job->setup->lens->title != NULL ? job->setup->lens->title : "a lens",
                              job->setup->position != NULL ? " at " : "",
                              job->setup->position != NULL ? job->setup->position : ""),
        .note =
            arena_printf(arena, "fitted by lenscalc to %zu exact rays, rms %.4g um in the image",
                         job->ray_data.count, 1000 * job->fit.rms),
    };
    return thick_element_lens(job->setup->lens, &stand_in, arena);
}

bool fit_save_lens(const struct artifact_job *wanted, struct output *sink, struct error *error)
{
    const struct lens lens = fit_equal_lens(wanted->run->state);
    (void)error;
    const struct text text = lens_write(&lens, wanted->run->arena);
    output_text(sink, text.start, text.length);
    return true;
}
