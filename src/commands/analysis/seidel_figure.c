/* commands/analysis/seidel_figure.c - the aberrations of surfaces as bars. */
/* SPDX-License-Identifier: MIT */
#include "commands/analysis/seidel_case.h"
#include "draw/bars.h"

#include <math.h>

/* What the bars are called, in each form. */
static const char *const names[][SEIDEL_TERMS] = {
    [FORM_WELFORD] = {"S1 spherical", "S2 coma", "S3 astigmatism", "S4 Petzval", "S5 distortion",
                      "C1 axial colour", "C2 lateral colour"},
    [FORM_TRANSVERSE] = {"TSC spherical", "CC_s sagittal coma", "TAC astigmatism", "TPC Petzval",
                         "DC distortion", "TAchC axial colour", "TchC lateral colour"},
    [FORM_WAVES] = {"W040 spherical", "W131 coma", "W222 astigmatism", "W220 field curvature",
                    "W311 distortion", "W020c axial colour", "W111c lateral colour"},
};

static const char *const fifth_names[FIFTH_TERMS] = {
    "B5 spherical",
    "F1 linear coma, tangential",
    "F2 linear coma",
    "M1 oblique spherical, tangential",
    "M2 oblique spherical, sagittal",
    "M3 oblique spherical, cos\xc2\xb2 \xce\xb8",
    "N1 elliptical coma, tangential",
    "N2 elliptical coma, cos 2\xce\xb8",
    "N3 elliptical coma, sagittal",
    "C5 astigmatism",
    "PI5 Petzval",
    "E5 distortion",
};

static const double THOUSAND = 1000;
static const double DROWNS = 5; /* sums that differ more have scales of their own */

static const char *seidel_figure_subtitle_of(const struct seidel_case *one, struct arena *arena)
{
    const struct setup *setup = one->setup;
    const struct first_order *first = &one->light.first;
    const double value = one->field.value[setup_axis(setup)];
    const char *field = "no field";
    if (one->field.kind == FIELD_ANGLE) {
        field = arena_printf(arena, "field %.5g deg", value * DEGREES_PER_RADIAN);
    } else if (one->field.kind == FIELD_HEIGHT) {
        field = arena_printf(arena, "object height %.5g mm", value);
    }
    const char *aperture = analysis_aperture_words(first, arena);
    const char *colours = isnan(one->blue)
                              ? ""
                              : arena_printf(arena, ", colour %.5g to %.5g nm",
                                             THOUSAND * one->blue, THOUSAND * one->red);
    const char *from =
        setup->fields_from == NULL ? "" : arena_printf(arena, " (%s)", setup->fields_from);
    return arena_printf(
        arena, "%s%s%s, %s%s, at %.5g nm%s", setup->position != NULL ? setup->position : "",
        setup->position != NULL ? ", " : "", aperture != NULL ? aperture : "no aperture", field,
        from, THOUSAND * one->light.wavelength, colours);
}

bool seidel_figure_check(const struct artifact_job *job, struct error *error)
{
    const struct seidel_input *input = job->inputs[0];
    return !lens_positions_several(input->question.lens.lens, input->question.position) ||
           fail(error, ERROR_USAGE, "{--plot} shows one position: name it with {--position}");
}

/* Is one sum so much larger than another that this would not be seen beside it? */
static bool seidel_one_drowns(const double *values, size_t count)
{
    double least = INFINITY, most = 0;
    for (size_t k = 0; k < SEIDEL_TERMS; k++) {
        double kind = 0; /* of NaN fmax takes the other */
        for (size_t i = 0; i < count; i++) {
            kind = fmax(kind, fabs(values[i * SEIDEL_TERMS + k]));
        }
        least = kind > 0 ? fmin(least, kind) : least;
        most = fmax(most, kind);
    }
    return most > DROWNS * least;
}

/* The bars of surface i, or behind them of the sum; `marks` of the fifth order alone. */
static void seidel_figure_values(const struct seidel_case *one, const struct seidel_input *input,
                                 size_t i, double *values, double *marks)
{
    const bool is_sum = i == one->light.system.count;
    if (input->order == ORDER_FIFTH) {
        const struct fifth_order_part *part = is_sum ? &one->fifth.total : &one->fifth.parts[i];
        seidel_case_fifth(one, part->sum, values);
        seidel_case_fifth(one, part->intrinsic, marks);
    } else {
        seidel_case_in_form(one, is_sum ? &one->seidel.total : &one->seidel.parts[i], input->form,
                            values);
    }
}

/* The unit of the bars, which are in thousandths of it where all are below a tenth. */
static const char *seidel_figure_unit(const struct seidel_case *one,
                                      const struct seidel_input *input, double *values,
                                      double *marks, size_t count)
{
    const bool is_fifth = input->order == ORDER_FIFTH;
    const bool waves = !is_fifth && input->form == FORM_WAVES;
    const bool angular =
        (is_fifth || input->form == FORM_TRANSVERSE) && seidel_case_is_angular(one);
    double largest = 0;
    for (size_t i = 0; i < count; i++) {
        largest = fmax(largest, fabs(values[i]));
    }
    const bool small = !waves && (largest < 0.1 || angular);
    for (size_t i = 0; i < count && small; i++) {
        values[i] *= THOUSAND;
        marks[i] *= THOUSAND;
    }
    if (waves) {
        return "waves";
    }
    const char *length = small ? "\xc2\xb5m" : "mm";
    return angular ? "mrad" : length;
}

bool seidel_figure_draw(const struct artifact_job *job, struct output *sink, struct error *error)
{
    const struct seidel_input *input = job->inputs[0];
    struct svg svg = {.arena = job->run->arena};
    struct analysis_cursor at = analysis_begin(input, &seidel_policy, job->run);
    struct seidel_case one;
    if (!analysis_next(&at, error) || !seidel_case_make(&at, &one, error)) {
        return false;
    }
    const bool is_fifth = input->order == ORDER_FIFTH;
    const size_t count = one.light.system.count, kinds = is_fifth ? FIFTH_TERMS : SEIDEL_TERMS;
    const size_t bar_count = (count + 1) * kinds;
    struct bar_group *groups = ARENA_ARRAY(svg.arena, count + 1, struct bar_group);
    double *values = ARENA_ARRAY(svg.arena, bar_count, double);
    double *marks = ARENA_ARRAY(svg.arena, bar_count, double);
    for (size_t i = 0; i <= count; i++) {
        seidel_figure_values(&one, input, i, values + i * kinds, marks + i * kinds);
        groups[i] =
            (struct bar_group){.label = i < count ? arena_printf(svg.arena, "%zu", i + 1) : "sum",
                               .values = values + i * kinds,
                               .marks = is_fifth ? marks + i * kinds : NULL,
                               .apart = i == count};
    }
    static const char *const what[] = {[FORM_WELFORD] = "Seidel sums",
                                       [FORM_TRANSVERSE] = "Transverse third-order aberrations",
                                       [FORM_WAVES] = "Third-order wavefront"};
    const char *title = is_fifth ? "Transverse fifth-order aberrations" : what[input->form];
    const char *unit = seidel_figure_unit(&one, input, values, marks, bar_count);
    const struct bars bars = (struct bars){
        .own_scales = is_fifth || seidel_one_drowns(values, count + 1),
        .title = arena_printf(svg.arena, "%s of %s", title, one.setup->lens->title),
        .subtitle = arena_printf(svg.arena, "%s%s", seidel_figure_subtitle_of(&one, svg.arena),
                                 is_fifth ? "; lines: intrinsic parts" : ""),
        .x_label = "surface",
        .y_label = arena_printf(svg.arena, "contribution (%s)", unit),
        .kinds = is_fifth ? fifth_names : names[input->form],
        .kind_count = kinds,
        .groups = groups,
        .group_count = count + 1,
    };
    return bars_draw(&bars, &svg, error) && drawing_write(job, &svg, sink, error);
}
