/* commands/analysis/wavefront_curves.c - the RMS against field, focus or wavelength. */
/* SPDX-License-Identifier: MIT */
#include "commands/analysis/wavefront_curves.h"

#include "draw/plot.h"

#include <stdlib.h>
#include <string.h>

const struct analysis_policy wavefront_policy = {.wavelengths = WAVELENGTHS_PRIMARY,
                                                 .fields = FIELDS_ALL};

bool wavefront_field_open(const struct analysis_cursor *at, const struct analysis_case *one,
                          size_t field, bool is_polychromatic, struct wavefront_source *source,
                          struct error *error)
{
    const struct wavefront_input *input = at->input;
    struct arena *arena = one->setup->arena;
    if (one->setup->wavelength_count > 1 && !is_polychromatic) {
        return fail(error, ERROR_USAGE,
                    "{--spectrum}: polynomials and maps are those of one wavelength");
    }
    struct wavefront_question *made = ARENA_NEW(arena, struct wavefront_question);
    const long rays = input->question.rays;
    *made = (struct wavefront_question){.bundle = analysis_bundle(one, field),
                                        .about = (enum wave_about)input->reference,
                                        .rays = rays != NO_INTEGER && rays > 0 ? (size_t)rays : 0,
                                        .error = input->question.error};
    return wavefront_open(made, arena, source, error);
}

enum { CURVES_MOST = 14 };
enum rms_axis { RMS_BY_FIELD, RMS_BY_FOCUS, RMS_BY_WAVELENGTH };

/* A point of the drawing, on one of its curves. */
struct rms_point {
    size_t curve;
    double x, rms;
};

struct rms_drawing {
    struct arena *arena;
    enum rms_axis axis;
    unsigned hidden;                 /* parts of its case that curves differ in */
    const char *labels[CURVES_MOST]; /* of the curves, in the order they come */
    size_t curve_count, count, room;
    struct rms_point *points;
    const char *lens, *words, *field;
};

#define VALUES(member) ANALYSIS_VALUES_OF(job, struct wavefront_input, member)

static int rms_point_order(const void *first, const void *second)
{
    const struct rms_point *a = first, *b = second;
    const int by_curve = (a->curve > b->curve) - (a->curve < b->curve);
    return by_curve != 0 ? by_curve : (a->x > b->x) - (a->x < b->x);
}

static bool rms_find(const struct analysis_cursor *at, const struct analysis_case *one,
                     size_t field, void *found, struct error *error)
{
    struct wavefront_source source;
    return wavefront_field_open(at, one, field, true, &source, error) &&
           wavefront_find(&source, false, one->setup->arena, found, error);
}

static bool rms_drawing_add(struct rms_drawing *drawing, const struct analysis_cursor *at,
                            struct error *error)
{
    const struct analysis_point point = analysis_point_of(at->one, at->field);
    struct analysis_question question = *at->one->question;
    struct analysis_case named = *at->one;
    double x = isnan(point.field) ? point.height : point.field * DEGREES_PER_RADIAN;
    named.question = &question;
    if (drawing->axis == RMS_BY_FOCUS) {
        question.defocus = NAN;
        x = point.defocus;
    } else if (drawing->axis == RMS_BY_WAVELENGTH) {
        question.wavelength.name = NULL;
        x = 1000 * at->one->setup->wavelengths[0].wavelength;
    }
    const char *label = drawing->axis == RMS_BY_FIELD
                            ? analysis_case_words(&named, drawing->arena)
                            : analysis_field_words(&named, at->field, true, drawing->arena);
    label = label != NULL ? label : "";
    size_t curve = 0;
    while (curve < drawing->curve_count && strcmp(label, drawing->labels[curve]) != 0) {
        curve++;
    }
    if (curve == CURVES_MOST) {
        return fail(error, ERROR_USAGE, "{--curve} would draw more than %d curves", CURVES_MOST);
    }
    drawing->labels[curve] = label;
    drawing->curve_count += curve == drawing->curve_count;
    drawing->points = arena_grow(drawing->arena, drawing->points, drawing->count, &drawing->room,
                                 sizeof *drawing->points);
    drawing->points[drawing->count++] =
        (struct rms_point){curve, x, ((const struct wavefront *)at->found)->rms};
    drawing->field = isnan(point.field) ? "field (mm)" : "field (\xc2\xb0)";
    drawing->lens = at->one->setup->lens->title;
    drawing->words = analysis_figure_words(at->one, FIGURE_ALL & ~drawing->hidden, drawing->arena);
    return true;
}

static bool rms_curves_draw(const struct rms_drawing *drawing, struct svg *svg, struct error *error)
{
    const char *const axes[] = {drawing->field, "defocus (mm)", "wavelength (nm)"};
    struct plot_series series[CURVES_MOST] = {{0}};
    double *x = ARENA_ARRAY(svg->arena, 2 * drawing->count, double), *y = x + drawing->count;
    qsort(drawing->points, drawing->count, sizeof *drawing->points, rms_point_order);
    for (size_t i = 0; i < drawing->count; i++) {
        const struct rms_point *point = &drawing->points[i];
        struct plot_series *one = &series[point->curve];
        x[i] = point->x;
        y[i] = point->rms;
        if (one->count++ == 0) {
            one->label = drawing->curve_count > 1 ? drawing->labels[point->curve] : NULL;
            one->x = &x[i];
            one->y = &y[i];
            one->style = point->curve;
        }
    }
    const struct plot plot = {.title =
                                  arena_printf(svg->arena, "RMS wave front of %s", drawing->lens),
                              .subtitle = drawing->words,
                              .x_label = axes[drawing->axis],
                              .y_label = "RMS (waves)",
                              .series = series,
                              .series_count = drawing->curve_count};
    return plot_draw(&plot, svg, error);
}

bool wavefront_curves(const struct artifact_job *job, struct output *sink, struct error *error)
{
    struct svg svg = {.arena = job->run->arena};
    struct rms_drawing drawing = {.arena = svg.arena, .hidden = FIGURE_DEFOCUS};
    const size_t focus = VALUES(question.defocus), fields = VALUES(question.field);
    const size_t waves = VALUES(question.wavelength.wavelength);
    if (VALUES(question.lens.lens) * VALUES(reference) * VALUES(question.aim) > 1 ||
        VALUES(question.field_x) > 1) {
        return fail(error, ERROR_USAGE,
                    "{--curve} draws one lens, reference and aim, not fields x");
    }
    if (focus > 1 && focus >= waves && focus >= fields) {
        drawing.axis = RMS_BY_FOCUS;
    } else if (waves > 1 && waves >= fields) {
        drawing.axis = RMS_BY_WAVELENGTH;
    }
    drawing.hidden |= (waves > 1) * (unsigned)FIGURE_WAVELENGTHS;
    drawing.hidden |= (VALUES(question.fnumber) > 1) * (unsigned)FIGURE_APERTURE;
    for (size_t i = 0; i < job->count; i++) {
        struct analysis_cursor at = analysis_begin_finding(
            job->inputs[i], &wavefront_policy, job->run, rms_find, sizeof(struct wavefront));
        at.keeps_lost = true;
        while (analysis_next(&at, error)) {
            if (at.lost == NULL && !rms_drawing_add(&drawing, &at, error)) {
                return false;
            }
        }
        if (error->code != ERROR_NONE) {
            return false;
        }
    }
    if (drawing.count == 0) {
        return fail(error, ERROR_DOMAIN, "there is no wave front to draw");
    }
    if (drawing.count == drawing.curve_count) {
        return fail(error, ERROR_USAGE,
                    "{--curve} needs an option with several values, such as a range");
    }
    return rms_curves_draw(&drawing, &svg, error) && drawing_write(job, &svg, sink, error);
}
