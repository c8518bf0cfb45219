/* commands/analysis/seidel_view.c - the bar diagram of lenscalc seidel. */
/* SPDX-License-Identifier: MIT */
#include "commands/analysis/seidel_view.h"

#include "commands/analysis/seidel_case.h"
#include "draw/bars.h"

/* Bars in the making. */
struct seidel_view_painter {
    const struct seidel_input *input;
    struct arena *arena;
    struct bars bars;
};

/* What the bars are called, in each form. */
static const char *const names[][SEIDEL_TERMS] = {
    [FORM_WELFORD] = {"S1 spherical", "S2 coma", "S3 astigmatism", "S4 Petzval", "S5 distortion",
                      "C1 axial colour", "C2 lateral colour"},
    [FORM_TRANSVERSE] = {"TSC spherical", "CC_s sagittal coma", "TAC astigmatism", "TPC Petzval",
                         "DC distortion", "TAchC axial colour", "TchC lateral colour"},
    [FORM_WAVES] = {"W040 spherical", "W131 coma", "W222 astigmatism", "W220 field curvature",
                    "W311 distortion", "W020c axial colour", "W111c lateral colour"},
};

static const double THOUSAND = 1000;

/* In thousandths of the unit where all bars are below a tenth of it. */
static const char *choose_unit(const struct seidel_case *one, int form, double *const *values,
                               size_t count)
{
    double largest = 0;
    for (size_t g = 0; g < count; g++) {
        for (size_t k = 0; k < SEIDEL_TERMS; k++) {
            largest = fmax(largest, fabs(values[g][k]));
        }
    }
    const bool angular = form == FORM_TRANSVERSE && seidel_is_angular(one);
    if (form == FORM_WAVES || (largest >= 0.1 && !angular)) {
        return form == FORM_WAVES ? "waves" : "mm";
    }
    for (size_t g = 0; g < count; g++) {
        for (size_t k = 0; k < SEIDEL_TERMS; k++) {
            values[g][k] *= THOUSAND;
        }
    }
    return angular ? "mrad" : "\xc2\xb5m";
}

static const char *seidel_view_subtitle_of(const struct seidel_case *one, struct arena *arena)
{
    const struct setup *setup = one->setup;
    const struct first_order *first = &one->light.first;
    const double value = one->field.value[setup_axis(setup)];
    const char *field = one->field.kind == FIELD_ANGLE
                            ? arena_printf(arena, "field %.5g deg", value * DEGREES_PER_RADIAN)
                        : one->field.kind == FIELD_HEIGHT
                            ? arena_printf(arena, "object height %.5g mm", value)
                            : "no field";
    const char *aperture = isfinite(first->fnumber)
                               ? arena_printf(arena, "f/%.4g", first->fnumber)
                               : arena_printf(arena, "stop radius %.4g mm", first->stop_radius);
    const char *colours = isnan(one->blue)
                              ? ""
                              : arena_printf(arena, ", colour %.5g to %.5g nm",
                                             THOUSAND * one->blue, THOUSAND * one->red);
    const char *from =
        setup->fields_from == NULL ? "" : arena_printf(arena, " (%s)", setup->fields_from);
    return arena_printf(arena, "%s%s%s, %s%s, at %.5g nm%s",
                        setup->position != NULL ? setup->position : "",
                        setup->position != NULL ? ", " : "", aperture, field, from,
                        THOUSAND * one->light.wavelength, colours);
}

static bool add_groups(const struct seidel_case *one, void *context, struct error *error)
{
    struct seidel_view_painter *painter = context;
    struct arena *arena = painter->arena;
    const int form = painter->input->form;
    const size_t count = one->light.system.count;
    struct bar_group *groups = ARENA_ARRAY(arena, count + 1, struct bar_group);
    double **values = ARENA_ARRAY(arena, count + 1, double *);
    (void)error;
    for (size_t i = 0; i <= count; i++) {
        values[i] = ARENA_ARRAY(arena, SEIDEL_TERMS, double);
        seidel_in_form(one, i < count ? &one->seidel.parts[i] : &one->seidel.total, form,
                       values[i]);
        groups[i] =
            (struct bar_group){.label = i < count ? arena_printf(arena, "%zu", i + 1) : "sum",
                               .values = values[i],
                               .apart = i == count};
    }
    static const char *const what[] = {[FORM_WELFORD] = "Seidel sums",
                                       [FORM_TRANSVERSE] = "Transverse third-order aberrations",
                                       [FORM_WAVES] = "Third-order wavefront"};
    const char *unit = choose_unit(one, form, values, count + 1);
    painter->bars = (struct bars){
        .title = arena_printf(arena, "%s of %s", what[form], one->setup->lens->title),
        .subtitle = seidel_view_subtitle_of(one, arena),
        .x_label = "surface",
        .y_label = arena_printf(arena, "contribution (%s)", unit),
        .kinds = names[form],
        .kind_count = SEIDEL_TERMS,
        .groups = groups,
        .group_count = count + 1,
    };
    return true;
}

bool seidel_view_check(const struct artifact_job *job, struct error *error)
{
    const struct seidel_input *input = job->inputs[0];
    return !lens_positions_several(input->question.lens.lens, input->question.position) ||
           fail(error, ERROR_USAGE, "{--plot} shows one position: name it with {--position}");
}

bool seidel_view_draw(const struct artifact_job *job, struct output *sink, struct error *error)
{
    struct svg svg = {.arena = job->run->arena};
    struct seidel_view_painter painter = {.input = job->inputs[0], .arena = svg.arena};
    return seidel_each(painter.input, job->run, add_groups, &painter, error) &&
           bars_draw(&painter.bars, &svg, error) && drawing_write(job, &svg, sink, error);
}
