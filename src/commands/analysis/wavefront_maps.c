/* commands/analysis/wavefront_maps.c - wave fronts over the pupil, their figures over the image. */
/* SPDX-License-Identifier: MIT */
#include "commands/analysis/wavefront_maps.h"

#include "commands/analysis/field_map.h"
#include "draw/ticks.h"

#include <math.h>
#include <string.h>

enum { MAP_SIZE = 128, DRAWN_SIZE = 256 };

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

/* -------- maps -------- */

static const double FAR_WORSE = 4; /* peak to valley of maps on one page that share no scale */

/* The values of a map, and of a drawing the figures that its rows have. */
struct wavefront_map_found {
    struct wavefront_source source;
    const double *values;
    struct wavefront figures;
    size_t size;
};

static bool wavefront_values_find(const struct analysis_cursor *at, const struct analysis_case *one,
                                  size_t field, void *room, struct error *error)
{
    const struct wavefront_input *input = at->input;
    struct arena *arena = one->setup->arena;
    struct wavefront_map_found *found = room;
    *found = (struct wavefront_map_found){.size = (size_t)input->size, .figures.pv = NAN};
    if (!wavefront_field_open(at, one, field, false, &found->source, error)) {
        return false;
    }
    const double *values = wavefront_map(&found->source, found->size, arena);
    if (input->fringes) {
        found->values = values;
        return true;
    }
    /* Without the piston: about the mean of the map. */
    const size_t count = found->size * found->size;
    double sum = 0, some = 0, *levelled = ARENA_ARRAY(arena, count, double);
    for (size_t i = 0; i < count; i++) {
        sum += isnan(values[i]) ? 0 : values[i];
        some += isnan(values[i]) ? 0 : 1;
    }
    for (size_t i = 0; i < count; i++) {
        levelled[i] = values[i] - sum / some;
    }
    found->values = levelled;
    return true;
}

static bool wavefront_map_find(const struct analysis_cursor *at, const struct analysis_case *one,
                               size_t field, void *room, struct error *error)
{
    struct wavefront_map_found *found = room;
    return wavefront_values_find(at, one, field, room, error) &&
           wavefront_find(&found->source, true, one->setup->arena, &found->figures, error);
}

static bool wavefront_map_add(struct map_page *page, const struct analysis_cursor *at,
                              struct error *error)
{
    enum { LINES = 5 };
    const struct wavefront_input *input = at->input;
    const struct wavefront_map_found *found = at->found;
    struct arena *arena = page->job->run->arena;
    const double pv = found->figures.pv;
    struct raster_map map = {
        .title = analysis_field_words(at->one, at->field, page->job->count > 1, arena),
        .note = "no ray arrives",
        .size = found->size,
        .values = found->values,
        .half = 1};
    if (isfinite(pv)) {
        map.note = ARENA_JOIN(arena, "peak to valley ", analysis_number(pv, arena), " waves");
        map.step = pv > 0 && !input->fringes ? ticks_round_below(pv / LINES) : 0;
    }
    if (map.step > 0) {
        map.note =
            ARENA_JOIN(arena, map.note, ", contours every ", analysis_number(map.step, arena));
    }
    const char *reference = wave_reference_words(at->one, (enum wave_about)input->reference, arena);
    const char *words = analysis_figure_words(at->one, FIGURE_ALL, arena);
    return map_page_add(page, at->one, &map, ARENA_JOIN(arena, "against ", reference, "; ", words),
                        error);
}

/* The maps of all inputs of a job. */
bool wavefront_maps(const struct artifact_job *job, struct output *sink, struct error *error)
{
    const struct wavefront_input *first = job->inputs[0];
    const bool entrance = first->question.aim == ANALYSIS_AIM_ENTRANCE;
    struct map_page page = {
        .job = job,
        .rasters = {.x_label = entrance ? "x in the entrance pupil" : "x in the stop",
                    .y_label = entrance ? "y in the entrance pupil" : "y in the stop",
                    .scale_label = "W - mean (waves)",
                    .colours = first->fringes ? RASTER_FRINGES : RASTER_SIGNED,
                    .columns = 3}};
    double least = INFINITY, most = 0;
    for (size_t i = 0; i < job->count; i++) {
        struct wavefront_input input = *(const struct wavefront_input *)job->inputs[i];
        const bool drawn = map_is_drawing(job);
        if (!(input.size > 0)) {
            input.size = drawn ? DRAWN_SIZE : MAP_SIZE;
        }
        struct analysis_cursor at = analysis_begin_finding(
            &input, &wavefront_policy, job->run, drawn ? wavefront_map_find : wavefront_values_find,
            sizeof(struct wavefront_map_found));
        at.keeps_lost = true;
        while (analysis_next(&at, error)) {
            if (at.lost != NULL) {
                continue;
            }
            const struct wavefront_map_found *found = at.found;
            least = fmin(least, found->figures.pv);
            most = fmax(most, found->figures.pv);
            if (!wavefront_map_add(&page, &at, error)) {
                return false;
            }
        }
        if (error->code != ERROR_NONE) {
            return false;
        }
    }
    /* beside one that is far worse the others would have no colour */
    if (most > FAR_WORSE * least) {
        page.rasters.own_scale = true;
        page.rasters.scale_label = "W - mean, share of the largest of the map";
    }
    return map_page_make(&page, first->fringes ? "Interferograms" : "Wave fronts", sink, error);
}

bool wavefront_check_map(const struct artifact_job *job, struct error *error)
{
    const struct wavefront_input *input = job->inputs[0];
    const bool numbers = job->type != NULL && strcmp(job->type->ending, ".pfm") == 0;
    return !(numbers && input->fringes) || asking_given(job->asking, "plot") ||
           fail(error, ERROR_USAGE, "{--fringes} is a picture, and .pfm has numbers");
}

/* -------- over the image -------- */

static bool wavefront_map_figures(const struct analysis_cursor *at, const struct analysis_case *one,
                                  size_t field, void *found, struct error *error)
{
    const struct wavefront_input *input = at->input;
    struct arena *arena = one->setup->arena;
    struct wavefront_source *source = ARENA_NEW(arena, struct wavefront_source);
    struct wavefront figures;
    double *value = found;
    if (!wavefront_field_open(at, one, field, true, source, error) ||
        !wavefront_find(source, false, arena, &figures, error)) {
        return false;
    }
    *value = input->mapped == MAPPED_STREHL ? figures.strehl : figures.rms;
    return true;
}

bool wavefront_over_field(const struct artifact_job *job, struct output *sink, struct error *error)
{
    static const struct field_map_kind kinds[] = {
        [MAPPED_RMS] = {.policy = &wavefront_policy,
                        .find = wavefront_map_figures,
                        .values = 1,
                        .what = "RMS wave front over the image",
                        .scale = "RMS (waves)",
                        .angular = "RMS (waves)"},
        [MAPPED_STREHL] = {.policy = &wavefront_policy,
                           .find = wavefront_map_figures,
                           .values = 1,
                           .what = "Strehl ratio over the image",
                           .scale = "Strehl ratio",
                           .angular = "Strehl ratio",
                           .highest = 1},
    };
    const struct wavefront_input *input = job->inputs[0];
    return field_map_make(job, &kinds[input->mapped], sink, error);
}

bool wavefront_check_over_field(const struct artifact_job *job, struct error *error)
{
    return ((const struct wavefront_input *)job->inputs[0])->zernike == NO_ZERNIKE ||
           fail(error, ERROR_USAGE,
                "{--over-field} maps the whole wave front: not with {--zernike}");
}
