/* design/merit/merit_ray.c - single real rays, chief and edge rays, with their derivatives. */
/* SPDX-License-Identifier: MIT */
#include "design/merit/merit_ray.h"

#include <math.h>
#include <string.h>

bool merit_ray_open(struct merit *merit, const struct merit_slot *slot, struct bundle_wish *wish,
                    struct arena *arena, struct merit_beams *beams, struct error *error)
{
    const struct merit_question *question = &merit->question;
    wish->setup = &merit->places[slot->place].setup;
    wish->from_entrance = wish->setup->first.is_telecentric;
    wish->is_apart = wish->whole = true;
    wish->vignetting = question->vignetting;
    wish->irregularities = question->irregularities;
    wish->irregularity_count = question->irregularity_count;
    wish->irregularity_amounts = question->irregularity_amounts;
    return merit_beams_begin(merit, slot, wish, arena, beams, error);
}

bool merit_ray_trace(struct merit *merit, struct merit_beams *beams, size_t ray)
{
    struct bundle_block *block = &beams->bundle.blocks[ray];
    struct ray_block end;
    block->aimed.keeps = true;
    if (!block->is_lost) {
        aimed_trace(&block->aimed, merit->derives || merit->question.irregularity_amounts != NULL,
                    &end);
    }
    return !block->is_lost;
}

/* Rays there, all lanes alike. */
static const struct ray_block *ray_before(const struct merit_beams *beams, size_t ray, size_t place)
{
    const struct merit_bundle *bundle = &beams->bundle;
    const struct system *system = &bundle->lights[bundle->blocks[ray].light].system;
    return &bundle->work.tape.blocks[system->begin[place != LENS_NONE ? place : system->places]];
}

bool merit_ray_at(const struct merit_beams *beams, size_t ray, size_t place, struct merit_ray *at)
{
    const struct ray_block *rays = ray_before(beams, ray, place);
    *at = (struct merit_ray){
        .at = {dual_of(rays->x[0]), dual_of(rays->y[0]), dual_of(rays->z[0])},
        .along = {dual_of(rays->p[0]), dual_of(rays->q[0]), dual_of(rays->r[0])}};
    return rays->lost[0] == 0;
}

/* Each lane asks for another number of the ray. */
static struct ray_block adjoint_of_numbers(void)
{
    struct ray_block adjoint = {.lost = {0}};
    adjoint.x[0] = adjoint.y[1] = adjoint.z[2] = 1;
    adjoint.p[3] = adjoint.q[4] = adjoint.r[5] = 1;
    return adjoint;
}

/* Irregularities move it there; it starts where it does without them. */
static void bend_ray(struct merit *merit, const struct merit_beams *beams, size_t ray, size_t place,
                     struct merit_ray *at)
{
    const struct merit_bundle *bundle = &beams->bundle;
    const struct bundle_wish *wish = &bundle->wish;
    const struct bundle_light *light = &bundle->lights[bundle->blocks[ray].light];
    const struct irregularity_sweep sweep = {&light->system, &light->layout, &bundle->work.tape,
                                             bundle->gradient};
    struct ray_block adjoint = adjoint_of_numbers();
    const struct derivative_pass pass = {.system = &light->system,
                                         .layout = &light->layout,
                                         .set = bundle->blocks[ray].aimed.set,
                                         .tape = &bundle->work.tape,
                                         .adjoint = &adjoint,
                                         .gradient = bundle->gradient};
    const size_t from = place != LENS_NONE ? place : light->system.places;
    derivative_pass_begin(&pass, from);
    derivative_pass_part(&pass, from, 0);
    for (size_t i = 0; i < wish->irregularity_count; i++) {
        double column[RAYS_BLOCK];
        if (wish->irregularities[i].surface < from) {
            irregularity_column(&wish->irregularities[i], &sweep, column);
            for (int k = 0; k < 3; k++) {
                at->at[k].value += merit->question.irregularity_amounts[i] * column[k];
                at->along[k].value += merit->question.irregularity_amounts[i] * column[3 + k];
            }
        }
    }
}

bool merit_ray_derive(struct merit *merit, const struct merit_beams *beams, size_t ray,
                      size_t place, struct merit_ray *end)
{
    const size_t light = beams->bundle.blocks[ray].light, count = merit->variable_count;
    if (!merit_ray_at(beams, ray, place, end)) {
        return fail(&merit->why, ERROR_DOMAIN, "a ray is lost at surface %zu",
                    ray_block_surface(ray_before(beams, ray, place), 0));
    }
    if (merit->question.irregularity_amounts != NULL) {
        bend_ray(merit, beams, ray, place, end);
    }
    if (merit->derives) {
        const struct arena_mark mark = arena_mark(merit->arena);
        double *columns = ARENA_ARRAY(merit->arena, (count + 1) * RAYS_BLOCK, double);
        struct ray_block adjoint = adjoint_of_numbers();
        const struct merit_ray first = end[0];
        merit_bundle_sweep(&beams->bundle, ray, place, &beams->links[light], count, &adjoint,
                           columns);
        for (size_t j = 0; j < count; j++) {
            end[j] = first;
            for (int k = 0; k < 3; k++) {
                end[j].at[k].slope = columns[j * RAYS_BLOCK + (size_t)k];
                end[j].along[k].slope = columns[j * RAYS_BLOCK + (size_t)k + 3];
            }
        }
        arena_reset(merit->arena, mark);
    }
    return true;
}

bool merit_ray_check(const struct merit_place *place, const struct field_point *field,
                     struct error *error)
{
    const struct lens *lens = place->setup.lens;
    for (size_t i = 0; i < lens->surface_count; i++) {
        if (surface_has(&lens->surfaces[i], SURFACE_HAS_FOCAL)) {
            return fail(error, ERROR_DOMAIN,
                        "surface %zu is an ideal lens, and its real rays have no derivatives",
                        i + 1);
        }
    }
    if (lens->stop == LENS_NONE && !place->setup.first.is_telecentric) {
        return fail(error, ERROR_DOMAIN, "the lens has no stop: it has no chief rays");
    }
    if (field->kind == FIELD_REAL) {
        return fail(error, ERROR_DOMAIN,
                    "its field is a height of the real image, which stays where it is: give "
                    "an angle, or the height of the object");
    }
    return field->kind != FIELD_HEIGHT || !place->setup.object.is_infinite ||
           fail(error, ERROR_DOMAIN, "an object at infinity has no height: give an angle");
}
