/* analysis/model/lens_model.c - thick and thin lenses with the first-order data of a real one. */
/* SPDX-License-Identifier: MIT */
#include "analysis/model/lens_model.h"

#include <math.h>

const struct word lens_models[RAY_MODELS] = {
    [MODEL_EXACT] = {"exact", "all surfaces as they are"},
    [MODEL_PARAXIAL] = {"paraxial", "all surfaces as they are near the axis"},
    [MODEL_FITTED] = {"fitted", "the thick lens that best matches the exact rays"},
    [MODEL_THICK] = {"thick", "focal length, principal planes and pupils"},
    [MODEL_THIN] = {"thin", "focal length, the stop in the lens"},
    [MODEL_PINHOLE] = {"pinhole", "a hole that passes as much light"},
    [LENS_MODELS] = {NULL, NULL},
    [MODEL_SEIDEL] = {"seidel", "the paraxial ray and its aberrations of the third order"},
    [MODEL_POLYNOMIAL] = {"polynomial", "sparse polynomials fitted to exact rays"},
    [MODEL_EXACT_64] = {"exact-64", "all surfaces as they are, in numbers of 64 bits"},
    [MODEL_EXACT_113] = {"exact-113", "the same in numbers of 113 bits"},
};

static const char no_model[] = "no model stands for this lens";

bool lens_model_check_rays(const struct lens *lens, const struct first_order *first,
                           struct error *error)
{
    const char *why = NULL;
    bool is = true;
    for (size_t i = 0; i < lens->surface_count; i++) {
        const struct surface *surface = &lens->surfaces[i];
        is = is && surface_is_round(surface) && surface->decentre == NULL &&
             surface->coordinate_break == NULL;
    }
    if (!is) {
        why = "it is not the same all around one axis";
    } else if (first->is_afocal) {
        why = "it is afocal and has no principal planes";
    } else if (first->index_image * first->index_object < 0) {
        why = "its light comes back to the side it came from";
    }
    return why == NULL || fail(error, ERROR_DOMAIN, "%s: %s", no_model, why);
}

bool lens_model_check(const struct lens *lens, const struct first_order *first, struct error *error)
{
    const char *why = NULL;
    if (!lens_model_check_rays(lens, first, error)) {
        return false;
    }
    if (lens->stop == LENS_NONE) {
        why = "it has no stop";
    } else if (!isfinite(first->entrance_pupil)) {
        why = "its entrance pupil lies at infinity";
    } else if (!(fabs(first->entrance_diameter) > 0)) {
        why = "how wide its entrance pupil is is not known";
    }
    return why == NULL || fail(error, ERROR_DOMAIN, "%s: %s", no_model, why);
}

struct thick_lens lens_model_thick(enum lens_model model, const struct first_order *first,
                                   double object)
{
    return (struct thick_lens){.focal = first->efl,
                               .front = model == MODEL_THIN ? first->length + first->rear_principal
                                                            : first->front_principal,
                               .rear = first->rear_principal,
                               .index_object = first->index_object,
                               .index_image = first->index_image,
                               .object = object};
}

struct lens lens_model_lens(enum lens_model model, const struct lens *lens,
                            const struct first_order *first, struct arena *arena)
{
    const double front = first->front_principal, rear = first->rear_principal;
    const bool is_thick = model == MODEL_THICK;
    const struct thick_stand_in all = {
        .thick = lens_model_thick(MODEL_THICK, first, INFINITY),
        .length = is_thick ? first->length : front - rear, /* H' in H */
        .pupil = is_thick ? first->entrance_pupil : front,
        .pupil_diameter = fabs(first->entrance_diameter),
        .image = first->image,
        .title = arena_printf(arena, "%s, as a %s%s", lens->title != NULL ? lens->title : "a lens",
                              lens_models[model].word, model == MODEL_PINHOLE ? "" : " lens")};
    return thick_element_lens(lens, &all, arena);
}
