/* commands/analysis/wavefront_map.c - wave fronts over the pupil, drawn and as numbers. */
/* SPDX-License-Identifier: MIT */
#include "commands/analysis/analysis_map.h"
#include "commands/analysis/analysis_words.h"
#include "commands/analysis/wavefront_input.h"

static const char *wavefront_map_note_of(const double *values, size_t count, struct arena *arena)
{
    double low = INFINITY, high = -INFINITY;
    for (size_t i = 0; i < count; i++) {
        low = fmin(low, values[i]);
        high = fmax(high, values[i]);
    }
    return high >= low ? ARENA_JOIN(arena, "lowest to highest ", analysis_number(high - low, arena),
                                    " waves")
                       : "no ray arrives";
}

/* Without the piston: about the mean of the map. */
static const double *level(const double *values, size_t count, struct arena *arena)
{
    double sum = 0, some = 0, *levelled = ARENA_ARRAY(arena, count, double);
    for (size_t i = 0; i < count; i++) {
        sum += isnan(values[i]) ? 0 : values[i];
        some += isnan(values[i]) ? 0 : 1;
    }
    for (size_t i = 0; i < count; i++) {
        levelled[i] = values[i] - sum / some;
    }
    return levelled;
}

/* Room for the values of a map. */
struct wavefront_map_found {
    const double *values;
};

static bool wavefront_map_find(const struct analysis_case *one, size_t field, const void *context,
                               void *found, struct error *error)
{
    const struct map_page *page = context;
    const struct wavefront_input *input = page->input;
    struct arena *arena = one->setup->arena;
    struct wavefront_source source;
    const size_t size = (size_t)input->size;
    if (!wavefront_of_case(one, field, input, arena, &source, error)) {
        return false;
    }
    ((struct wavefront_map_found *)found)->values =
        level(wavefront_map(&source, size, arena), size * size, arena);
    return true;
}

static bool wavefront_map_add(const struct analysis_case *one, size_t field, const void *found,
                              void *context, struct error *error)
{
    struct map_page *page = context;
    const struct wavefront_input *input = page->input;
    struct arena *arena = page->job->run->arena;
    const size_t size = (size_t)input->size;
    const double *values = ((const struct wavefront_map_found *)found)->values;
    const struct raster_map map = {.title = analysis_map_title(one, field, arena),
                                   .note = wavefront_map_note_of(values, size * size, arena),
                                   .size = size,
                                   .values = values,
                                   .half = 1};
    map_page_subtitle(
        page, arena_printf(arena, "against %s; %s",
                           wave_reference_words(one, (enum wave_about)input->reference, arena),
                           analysis_case_words(one, true, arena)));
    return map_page_add(page, one, &map, error);
}

/* The maps of all inputs of a job. */
static bool wavefront_map_collect(const struct artifact_job *job, struct map_page *page,
                                  struct error *error)
{
    static const struct analysis_answers answers = {.find = wavefront_map_find,
                                                    .found_size =
                                                        sizeof(struct wavefront_map_found),
                                                    .take = wavefront_map_add,
                                                    .lost = analysis_skip};
    const struct wavefront_input *first = job->inputs[0];
    const bool entrance = first->question.aim == ANALYSIS_AIM_ENTRANCE;
    page->rasters = (struct rasters){
        .x_label = entrance ? "x in the entrance pupil" : "x in the stop",
        .y_label = entrance ? "y in the entrance pupil" : "y in the stop",
        .scale_label = "W - mean (waves)",
        .colours = RASTER_SIGNED,
        .columns = 3,
    };
    return map_page_collect(page, job, &wavefront_policy, &answers, "Wave fronts", error);
}

bool wavefront_page(const struct artifact_job *job, struct output *sink, struct error *error)
{
    struct map_page page = {.input = NULL};
    return wavefront_map_collect(job, &page, error) && map_page_draw(&page, sink, error);
}

bool wavefront_file(const struct artifact_job *job, struct output *sink, struct error *error)
{
    struct map_page page = {.input = NULL};
    return wavefront_map_collect(job, &page, error) && map_page_write(&page, sink, error);
}
