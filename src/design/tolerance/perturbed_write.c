/* design/tolerance/perturbed_write.c - a lens as it was made, as a file holds it. */
/* SPDX-License-Identifier: MIT */
#include "design/tolerance/perturbed.h"

/* A lens to be written. */
struct writing_lens {
    struct perturbed *perturbed;
    const double *wavelengths;
    size_t wavelength_count;
    struct lens *to;
    struct arena *arena;
};

/* The values of the positions, those that did not change as they were typed; are they all alike? */
static struct figure *written_figures(const struct writing_lens *writing, struct parameter what,
                                      const struct figure *was, bool *alike)
{
    const struct perturbed *perturbed = writing->perturbed;
    struct figure *values = ARENA_ARRAY(writing->arena, perturbed->position_count, struct figure);
    *alike = true;
    for (size_t p = 0; p < perturbed->position_count; p++) {
        const double value = parameter_get(&perturbed->lenses[p].lens, what);
        values[p] = figure_number(pair_of(value));
        if (was != NULL && was[p].value.hi == value) {
            values[p] = was[p];
        }
        *alike = *alike && value == values[0].value.hi;
    }
    return values;
}

/* A word of its own for a cell whose numbers are no longer those of its word, or differ. */
static void written_put_word(const struct writing_lens *writing, size_t i)
{
    const struct perturbed *perturbed = writing->perturbed;
    struct lens *to = writing->to;
    const size_t word = perturbed->lens->surfaces[i].thickness.variable;
    const struct lens_variable *from = word != LENS_NONE ? &perturbed->lens->variables[word] : NULL;
    bool alike, is_same = from != NULL;
    struct figure *values = written_figures(writing, (struct parameter){i, PARAMETER_THICKNESS, 0},
                                            from != NULL ? from->values : NULL, &alike);
    for (size_t p = 0; p < perturbed->position_count; p++) {
        is_same = is_same && values[p].value.hi == from->values[p].value.hi;
    }
    if (is_same) {
        to->surfaces[i].thickness = perturbed->lens->surfaces[i].thickness;
    } else if (from != NULL || !alike) {
        const struct text name = from != NULL ? from->name : text_of("thickness");
        struct lens_variable *made = &to->variables[to->variable_count];
        *made = from != NULL ? *from : (struct lens_variable){.name = name};
        made->name =
            text_of(arena_printf(writing->arena, "%.*s_%zu", (int)name.length, name.start, i + 1));
        made->values = values;
        to->surfaces[i].thickness.variable = to->variable_count++;
    }
}

static struct medium written(const struct writing_lens *writing, size_t position, size_t space)
{
    const struct perturbed *perturbed = writing->perturbed;
    const struct lens *lens = &perturbed->lenses[position].lens;
    struct medium medium = space == 0 ? lens->object_medium : lens->surfaces[space - 1].medium;
    struct melt *melt = perturbed_melt(perturbed, position, space);
    if (perturbed->is_melted[space] && medium.glass == melt) {
        medium.written =
            melt_written(melt, writing->wavelengths, writing->wavelength_count, writing->arena);
    }
    return medium;
}

/* What the positions set, as it was made. */
static void written_put_settings(const struct writing_lens *writing)
{
    enum { POSES = PARAMETER_TILT_Z - PARAMETER_DECENTER_X + 1 };
    const struct lens *from = writing->perturbed->lens;
    struct lens *to = writing->to;
    bool alike;
    to->settings = ARENA_ARRAY(writing->arena, from->setting_count + POSES * from->surface_count,
                               struct lens_setting);
    for (size_t i = 0; i < from->setting_count; i++) {
        struct lens_setting *setting = &to->settings[i];
        const struct parameter what = from->settings[i].parameter;
        *setting = from->settings[i];
        if (setting->media == NULL) {
            setting->figures = written_figures(writing, what, setting->figures, &alike);
            continue;
        }
        struct medium *media = ARENA_ARRAY(writing->arena, from->position_count, struct medium);
        for (size_t p = 0; p < from->position_count; p++) {
            media[p] = written(writing, p, what.surface == LENS_NONE ? 0 : what.surface + 1);
        }
        setting->media = media;
    }
    /* displacements that have become others in each position */
    for (size_t i = 0; i < from->surface_count && from->position_count > 0; i++) {
        for (int kind = PARAMETER_DECENTER_X;
             kind <= PARAMETER_TILT_Z && writing->perturbed->is_posed[i]; kind++) {
            const struct parameter what = {i, (enum parameter_kind)kind, 0};
            bool is_set = false;
            const struct figure *values = written_figures(writing, what, NULL, &alike);
            for (size_t k = 0; k < to->setting_count; k++) {
                is_set = is_set || parameter_is_same(to->settings[k].parameter, what);
            }
            if (!alike && !is_set) {
                to->settings[to->setting_count++] = (struct lens_setting){what, values, NULL};
            }
        }
    }
}

struct lens *perturbed_lens(struct perturbed *perturbed, const double *wavelengths,
                            size_t wavelength_count, struct arena *arena)
{
    const struct lens *from = perturbed->lens;
    struct lens *to = parameter_apply(from, NULL, NULL, 0, arena);
    const struct writing_lens writing = {perturbed, wavelengths, wavelength_count, to, arena};
    to->variables =
        ARENA_ARRAY(arena, from->variable_count + from->surface_count + 1, struct lens_variable);
    for (size_t i = 0; i < from->variable_count; i++) {
        to->variables[i] = from->variables[i];
    }
    to->pickup_count = 0; /* what was made follows nothing */
    for (size_t i = 0; i < from->surface_count; i++) {
        struct surface *surface = &to->surfaces[i];
        const struct figure diameter = surface->diameter; /* may be a word */
        *surface = perturbed->lenses[0].lens.surfaces[i];
        surface->diameter = diameter;
        if (surface->decentre != NULL) {
            struct displacement *own = ARENA_NEW(arena, struct displacement);
            *own = *surface->decentre;
            surface->decentre = own;
        }
        surface->medium = written(&writing, 0, i + 1);
        if (from->position_count > 0) {
            written_put_word(&writing, i);
        }
    }
    if (perturbed->is_melted[0]) {
        to->object_medium = written(&writing, 0, 0);
    }
    written_put_settings(&writing);
    return to;
}
