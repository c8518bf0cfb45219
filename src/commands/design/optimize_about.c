/* commands/design/optimize_about.c - what rows of every sheet of optimize have: how it was seen. */
/* SPDX-License-Identifier: MIT */
#include "base/constants.h"
#include "commands/analysis/analysis_options.h"
#include "commands/design/optimize_job.h"

#include <string.h>

/* "0, 10, 14 x 0.5 deg"; of a lens that states none that this is the axis. */
static const char *optimize_fields_words(const struct optimize_job *job)
{
    static const char *const units[FIELD_KINDS] = {[FIELD_ANGLE] = "deg",
                                                   [FIELD_HEIGHT] = "mm of the object",
                                                   [FIELD_IMAGE] = "mm of the image",
                                                   [FIELD_REAL] = "mm of the real image"};
    const struct setup *setup = &job->merit.places[0].setup;
    struct arena *arena = job->run->arena;
    const char *words = "";
    if (setup->field_count == 0 || setup->fields[0].point.kind == FIELD_NONE) {
        return "the axis alone, as the lens states none";
    }
    const enum field_kind kind = setup->fields[0].point.kind;
    const double scale = kind == FIELD_ANGLE ? DEGREES_PER_RADIAN : 1;
    for (size_t i = 0; i < setup->field_count; i++) {
        const double *at = setup->fields[i].point.value, weight = setup->fields[i].weight;
        const char *beside = at[0] != 0 ? arena_printf(arena, "%.6g:", scale * at[0]) : "";
        const char *counts = weight != 1 ? arena_printf(arena, " x %.6g", weight) : "";
        words = arena_printf(arena, "%s%s%s%.6g%s", words, i > 0 ? ", " : "", beside, scale * at[1],
                             counts);
    }
    return arena_printf(arena, "%s %s", words, units[kind]);
}

/* "587.5618, 486.1327 x 0.5 nm". */
static const char *optimize_wavelengths_words(const struct optimize_job *job)
{
    const struct setup *setup = &job->merit.places[0].setup;
    const bool is_stated = job->lens->wavelength_count > 0 || job->input->waves.count > 0;
    struct arena *arena = job->run->arena;
    const char *words = "";
    for (size_t i = 0; i < setup->wavelength_count; i++) {
        const struct setup_wavelength *one = &setup->wavelengths[i];
        const char *counts = one->weight != 1 ? arena_printf(arena, " x %.6g", one->weight) : "";
        words = arena_printf(arena, "%s%s%.7g%s", words, i > 0 ? ", " : "", 1000 * one->wavelength,
                             counts);
    }
    return arena_printf(arena, "%s nm%s", words,
                        is_stated ? "" : " alone, as the lens states none");
}

struct optimize_about optimize_about_of(const struct optimize_job *job, bool is_first)
{
    const struct optimize_input *input = job->input;
    return (struct optimize_about){
        .fnumber = input->question.fnumber,
        .seed = input->seed,
        .rank = job->rank,
        .fields = optimize_fields_words(job),
        .wavelengths = optimize_wavelengths_words(job),
        .rays = arena_printf(job->run->arena, "%zu %s, in the %s, %s", job->merit.question.rays,
                             patterns[input->pattern].word,
                             input->aim == ANALYSIS_AIM_ENTRANCE ? "entrance pupil" : "stop",
                             input->clip ? "clipped" : "not clipped"),
        .lens = job->lens->title,
        .warning = is_first ? job->warning : NULL};
}
