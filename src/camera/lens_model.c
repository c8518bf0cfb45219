/* camera/lens_model.c - thick and thin lenses with the first-order data of a real one. */
/* SPDX-License-Identifier: MIT */
#include "camera/lens_model.h"

#include "optics/thick_element.h"

#include <math.h>

const struct word lens_models[] = {
    [MODEL_EXACT] = {"exact", "all surfaces as they are"},
    [MODEL_PARAXIAL] = {"paraxial", "all surfaces as they are near the axis"},
    [MODEL_FITTED] = {"fitted", "the thick lens that equals the exact rays best"},
    [MODEL_THICK] = {"thick", "focal length, principal planes and pupils"},
    [MODEL_THIN] = {"thin", "focal length, the stop in the lens"},
    [MODEL_PINHOLE] = {"pinhole", "a hole that lets as much light through"},
    [LENS_MODELS] = {NULL, NULL},
};

static bool check(const struct first_order *first, struct error *error)
{
    if (first->is_afocal) {
        return fail(error, ERROR_DOMAIN,
                    "an afocal lens has no principal planes: no model but "
                    "exact and paraxial can be had of it");
    }
    if (first->index_image * first->index_object < 0) {
        return fail(error, ERROR_DOMAIN,
                    "the light of this lens comes back to the side it came "
                    "from: no model but exact and paraxial can be had of it");
    }
    return (isfinite(first->entrance_pupil) && fabs(first->entrance_diameter) > 0) ||
           fail(error, ERROR_DOMAIN, "%s: no model but exact and paraxial can be had of the lens",
                isfinite(first->entrance_pupil) ? "how wide the entrance pupil is is not known"
                                                : "the entrance pupil lies at infinity");
}

bool lens_model_lens(enum lens_model model, const struct lens *lens,
                     const struct first_order *first, struct arena *arena, struct lens *stand_in,
                     struct error *error)
{
    const double front = first->front_principal, rear = first->rear_principal;
    const bool is_thick = model == MODEL_THICK;
    if (!check(first, error)) {
        return false;
    }
    const struct thick_stand_in all = {
        .thick = {.focal = first->efl,
                  .front = front,
                  .rear = rear,
                  .index_object = first->index_object,
                  .index_image = first->index_image,
                  .object = INFINITY},
        .length = is_thick ? first->length : front - rear, /* H' in H */
        .pupil = is_thick ? first->entrance_pupil : front,
        .pupil_diameter = fabs(first->entrance_diameter),
        .image = first->image,
        .title = arena_printf(arena, "%s, as a %s%s", lens->title != NULL ? lens->title : "a lens",
                              lens_models[model].word, model == MODEL_PINHOLE ? "" : " lens")};
    *stand_in = thick_element_lens(lens, &all, arena);
    return true;
}
