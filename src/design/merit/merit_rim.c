/* design/merit/merit_rim.c - the stop as wide as the exact marginal ray, where a lens asks for that. */
/* SPDX-License-Identifier: MIT */
#include "design/merit/merit_rim.h"

#include "design/merit/merit_ray.h"

#include <math.h>

/* The beams of a place's marginal ray, as if they were those of an operand. */
static struct merit_slot rim_slot(const struct merit *merit, size_t place)
{
    return (struct merit_slot){.operand = &merit->question.operands[0], .place = place};
}

bool merit_rim_open(struct merit *merit, size_t at, struct arena *arena, struct error *error)
{
    struct merit_place *place = &merit->places[at];
    const struct lens *lens = place->setup.lens;
    const struct merit_slot slot = rim_slot(merit, at);
    const size_t axis = setup_axis(&place->setup);
    if (!lens->stop_is_real || place->aperture.kind <= APERTURE_STOP || lens->stop == LENS_NONE ||
        merit->question.operand_count == 0) {
        return true;
    }
    if (!merit_ray_check(place, &(struct field_point){.kind = FIELD_NONE}, error)) {
        return error_prefix(error, "the stop is sized by a real ray: ");
    }
    struct setup_field *field = ARENA_NEW(arena, struct setup_field);
    struct pupil_point *edge = ARENA_NEW(arena, struct pupil_point);
    struct setup_wavelength *light = ARENA_NEW(arena, struct setup_wavelength);
    *field = (struct setup_field){{.kind = FIELD_NONE}, 1};
    *edge = (struct pupil_point){axis == 0 ? 1 : 0, axis == 0 ? 0 : 1, 1};
    *light = (struct setup_wavelength){place->lights[0].wavelength, 1};
    struct bundle_wish wish = {.setup = &place->setup,
                               .fields = field,
                               .field_count = 1,
                               .wavelengths = light,
                               .wavelength_count = 1,
                               .points = edge,
                               .point_count = 1,
                               .from_entrance = true,
                               .is_apart = true,
                               .whole = true,
                               .is_bare = true};
    struct merit_beams *rim = ARENA_NEW(arena, struct merit_beams);
    place->rim_radius = ARENA_ARRAY(arena, merit->variable_count + 1, struct dual);
    if (!merit_beams_begin(merit, &slot, &wish, arena, rim, error)) {
        return false;
    }
    place->rim = rim;
    return true;
}

void merit_rim_find(struct merit *merit, size_t at)
{
    struct merit_place *place = &merit->places[at];
    const struct merit_slot slot = rim_slot(merit, at);
    const size_t behind = place->rim != NULL ? place->lens->stop + 1 : 0;
    const size_t columns = merit_columns(merit);
    struct merit_ray *end = ARENA_ARRAY(merit->arena, columns + 1, struct merit_ray);
    place->stop = NULL;
    if (place->rim == NULL || !merit_beams_aim(merit, &slot, place->rim) ||
        !merit_ray_trace(merit, place->rim, 0) || !merit_ray_at(place->rim, 0, behind, end)) {
        return;
    }
    const double height = hypot(end[0].at[0].value, end[0].at[1].value);
    if (!(height > 0) || (merit->derives && !merit_ray_derive(merit, place->rim, 0, behind, end))) {
        return;
    }
    for (size_t j = 0; j < columns; j++) {
        const struct dual *xy = end[merit->derives ? j : 0].at;
        place->rim_radius[j] =
            (struct dual){height, (xy[0].value * xy[0].slope + xy[1].value * xy[1].slope) / height};
    }
    place->stop = place->rim_radius;
}
