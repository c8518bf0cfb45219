/* analysis/rays/relative_illumination.c - light over the image, from both sides. */
/* SPDX-License-Identifier: MIT */
#include "analysis/rays/relative_illumination.h"

#include "analysis/pupil/quadrature.h"
#include "base/constants.h"
#include "trace/dispatch.h"

#include <math.h>

static bool relative_illumination_check(const struct relative_illumination_question *question,
                                        struct error *error)
{
    const struct setup *setup = question->setup;
    const struct lens *lens = setup->lens;
    const double wanted = question->stop_diameter;
    if (lens->stop == LENS_NONE) {
        return fail(error, ERROR_DOMAIN, "the lens has no stop: what limits its light is unknown");
    }
    if (setup->first.is_telecentric) {
        return fail(error, ERROR_DOMAIN,
                    "the object space of the lens is telecentric, and what is asked here is of "
                    "beams that the stop limits");
    }
    const struct surface *stop = &lens->surfaces[lens->stop];
    if (stop->has_diameter && wanted > stop->diameter.value.hi * (1 + 1e-12)) {
        return fail(error, ERROR_DOMAIN,
                    "{stop diameter} %.6g mm: the lens has room for %.6g mm at most", wanted,
                    stop->diameter.value.hi);
    }
    if (isnan(wanted) && !(setup->first.stop_radius > 0)) {
        fail(error, ERROR_DOMAIN, "the stop has no diameter: the amount of light is unknown");
        return error_hint(error, "give an f-number, or a diameter in the file");
    }
    if (isnan(setup->image) || setup->image == 0) {
        fail(error, ERROR_DOMAIN, "the image plane lies %s",
             setup->image == 0 ? "in the last vertex" : "at infinity");
        return error_hint(error, "say with {focus} how far behind the last vertex it is");
    }
    return true;
}

static bool illumination_open_systems(struct relative_illumination *falloff, struct error *error)
{
    const struct setup *setup = &falloff->setup;
    const struct lens *bare = illumination_stop_only(setup->lens, setup->arena);
    struct system *stop[2];
    for (unsigned back = 0; back < 2; back++) {
        stop[back] = ARENA_NEW(setup->arena, struct system);
        const unsigned way = back == 1 ? SETUP_REVERSED : 0;
        if (!setup_compile(setup, bare, 0, SETUP_CLIPPED | way, stop[back], error)) {
            return false;
        }
    }
    falloff->film_stop = stop[1];
    falloff->film = falloff->film_stop;
    falloff->field = stop[0];
    falloff->film_open = setup_system(setup, 0, SETUP_REVERSED, error);
    falloff->field_open = setup_system(setup, 0, SETUP_OPEN, error);
    if (falloff->clip) {
        falloff->film = setup_system(setup, 0, SETUP_CLIPPED | SETUP_REVERSED, error);
        falloff->field = setup_system(setup, 0, SETUP_CLIPPED, error);
    }
    return falloff->film_open != NULL && falloff->field_open != NULL && falloff->film != NULL &&
           falloff->field != NULL;
}

/* -------- both sides of one point -------- */

/* The beam of an object point and its chief ray; false: there is none. */
static bool relative_illumination_find_chief(const struct relative_illumination *falloff,
                                             const struct field_point *field, struct beam *beam,
                                             double chief[2], struct error *error)
{
    struct setup_near *near = falloff->near;
    struct aim aim;
    if (!setup_beam_near(&falloff->setup, field, near, beam, error)) {
        return false;
    }
    struct aim_near from = near->chief;
    from.is_known = from.is_known && field->kind == FIELD_REAL;
    if (!aim_open_near(falloff->field_open, beam, &from, falloff->setup.arena, &aim, error)) {
        return false;
    }
    chief[0] = aim.chief[0];
    chief[1] = aim.chief[1];
    return true;
}

/* The chief ray behind the lens. */
static struct ray chief_behind(const struct relative_illumination *falloff, const struct beam *beam,
                               const double chief[2])
{
    const struct rays rays = rays_new(falloff->setup.arena, 1);
    const struct ray start = beam_ray(beam, chief[0], chief[1]);
    rays_set(&rays, 0, beam->n, &start);
    rays_trace(falloff->field_open, &rays, NULL);
    return rays_get(&rays, 0, falloff->field_open->index_last);
}

static struct illumination from_film(const struct relative_illumination *falloff,
                                     const struct system *clipped, const struct beam *beam,
                                     const double *inside, struct pupil_islands *islands)
{
    const struct illumination_question question = {.clipped = clipped,
                                                   .open = falloff->film_open,
                                                   .beam = beam,
                                                   .first = &falloff->first,
                                                   .inside = inside,
                                                   .error = falloff->error,
                                                   .islands = islands};
    return illumination_of_film(&question, falloff->setup.arena);
}

/* One light over another, and what that may be off; NaN where the other is none. */
static double quotient_of(const struct illumination *light, const struct illumination *whole,
                          double *error)
{
    const bool is_dark = !(whole->value > 0);
    const double quotient = is_dark ? (double)NAN : light->value / whole->value;
    *error = is_dark ? (double)NAN : (light->error + quotient * whole->error) / whole->value;
    return quotient;
}

/* Without ratios to the axis; is_row: with islands, and what is vignetted. */
static struct relative_illumination_point relative_look(const struct relative_illumination *falloff,
                                                        const double height[2], bool is_row,
                                                        struct illumination *field)
{
    static const struct illumination no_light = {NAN, NAN, true};
    const struct setup *setup = &falloff->setup;
    const struct field_point at = {FIELD_REAL, {height[0], height[1]}};
    const struct beam film =
        beam_to_pupil((double[3]){height[0], height[1], setup->image}, falloff->first.exit_pupil,
                      falloff->film_open->index_first);
    struct relative_illumination_point point = {
        .height = {height[0], height[1]}, .angle = NAN, .cos4 = NAN};
    struct beam beam;
    double chief[2], inside[2];
    struct error ignored;
    bool found = !(hypot(height[0], height[1]) > falloff->chief_end) &&
                 relative_illumination_find_chief(falloff, &at, &beam, chief, &ignored);
    *field = no_light;
    if (found) {
        const struct ray behind = chief_behind(falloff, &beam, chief);
        beam_place(&film, behind.point, inside);
        point.angle = atan2(hypot(beam.axis[0], beam.axis[1]), beam.axis[2]);
        point.cos4 = point.angle < PI / 2 ? pow(beam.axis[2], 4) : 0;
        const struct illumination_question question = {.clipped = falloff->field,
                                                       .open = falloff->field_open,
                                                       .beam = &beam,
                                                       .first = &falloff->first,
                                                       .inside = chief,
                                                       .error = falloff->error};
        *field = falloff->no_field ? no_light : illumination_of_field(&question, setup->arena);
        found = behind.status == RAY_OK;
    }
    point.light =
        from_film(falloff, falloff->film, &film, found ? inside : NULL,
                  falloff->clip && is_row && !falloff->no_islands ? &point.islands : NULL);
    point.vignetted = point.vignetted_error = falloff->no_vignetting ? (double)NAN : 0;
    if (falloff->clip && is_row && !falloff->no_vignetting) {
        const struct illumination stop =
            from_film(falloff, falloff->film_stop, &film, found ? inside : NULL, NULL);
        /* 1 - E/E of the stop alone; what is less than the errors of the two is 0. */
        const double taken = 1 - quotient_of(&point.light, &stop, &point.vignetted_error);
        point.vignetted = fabs(taken) <= point.vignetted_error ? 0 : taken;
    }
    return point;
}

void relative_illumination_begin(const struct relative_illumination *falloff,
                                 const double height[2])
{
    const struct field_point at = {FIELD_REAL, {height[0], height[1]}};
    struct beam beam;
    struct error ignored;
    if (!setup_beam_near(&falloff->setup, &at, falloff->near, &beam, &ignored)) {
        falloff->near->is_known = false;
    }
}

struct relative_illumination
relative_illumination_apart(const struct relative_illumination *falloff, struct arena *arena)
{
    struct relative_illumination apart = *falloff;
    apart.setup = setup_apart(&falloff->setup, arena);
    apart.near = ARENA_NEW(arena, struct setup_near);
    *apart.near = *falloff->near;
    return apart;
}

/* Does a chief ray come to a height? What is remembered of the last is left alone. */
static bool chief_comes(const struct relative_illumination *falloff, const double height[2])
{
    const struct arena_mark mark = arena_mark(falloff->setup.arena);
    const struct field_point at = {FIELD_REAL, {height[0], height[1]}};
    struct relative_illumination apart = *falloff;
    struct setup_near near = *falloff->near;
    struct beam beam;
    double chief[2];
    struct error ignored;
    apart.near = &near;
    const bool comes = relative_illumination_find_chief(&apart, &at, &beam, chief, &ignored);
    arena_reset(falloff->setup.arena, mark);
    return comes;
}

double relative_illumination_chief_end(const struct relative_illumination *falloff,
                                       const double end[2], size_t count)
{
    if (chief_comes(falloff, end)) {
        return INFINITY;
    }
    size_t comes = 0, fails = count;
    while (fails - comes > 1) {
        const size_t middle = (comes + fails) / 2;
        const double share = (double)middle / (double)count;
        if (chief_comes(falloff, (double[2]){share * end[0], share * end[1]})) {
            comes = middle;
        } else {
            fails = middle;
        }
    }
    return comes == 0 ? 0 : ((double)comes + 0.5) / (double)count * hypot(end[0], end[1]);
}

struct relative_illumination_point
relative_illumination_at(const struct relative_illumination *falloff, const double height[2])
{
    const struct arena_mark mark = arena_mark(falloff->setup.arena);
    struct illumination field;
    struct relative_illumination_point point = relative_look(falloff, height, true, &field);
    arena_reset(falloff->setup.arena, mark);
    point.relative_point = quotient_of(&point.light, &falloff->axis, &point.point_error);
    point.relative_field = quotient_of(&field, &falloff->axis_field, &point.field_error);
    point.is_field_met = field.is_met && falloff->axis_field.is_met;
    return point;
}

bool relative_illumination_height(const struct relative_illumination *falloff,
                                  const struct field_point *field, double height[2],
                                  struct error *error)
{
    struct beam beam;
    double chief[2];
    if (!relative_illumination_find_chief(falloff, field, &beam, chief, error)) {
        return false;
    }
    const struct ray behind = chief_behind(falloff, &beam, chief);
    if (behind.status != RAY_OK) {
        return fail(error, ERROR_DOMAIN, "the chief ray is lost at surface %zu: %s", behind.surface,
                    ray_status_name(behind.status));
    }
    const double t = (falloff->setup.image - behind.point[2]) / behind.cosine[2];
    for (int i = 0; i < 2; i++) {
        height[i] = behind.point[i] + t * behind.cosine[i];
    }
    for (int i = 0; i < 2; i++) {
        /* what symmetry makes 0 */
        height[i] = fabs(height[i]) < 1e-15 * fabs(height[1 - i]) ? 0 : height[i];
    }
    return true;
}

bool relative_illumination_open(const struct relative_illumination_question *question,
                                struct relative_illumination *falloff, struct error *error)
{
    const struct setup *setup = question->setup;
    struct setup_light light;
    if (!relative_illumination_check(question, error)) {
        return false;
    }
    *falloff = (struct relative_illumination){
        .setup = setup_at_wavelength(setup, setup->wavelengths[question->wavelength].wavelength,
                                     setup->arena),
        .near = ARENA_NEW(setup->arena, struct setup_near),
        .error = question->error,
        .clip = question->clip,
        .chief_end = INFINITY,
        .no_field = question->no_field,
        .no_vignetting = question->no_vignetting,
        .no_islands = question->no_islands,
    };
    struct setup *own = &falloff->setup;
    if (!isnan(question->stop_diameter)) {
        const struct field_point edge = setup_edge_in_object(setup);
        first_order_use_stop(&own->first, &own->object, question->stop_diameter / 2, edge.kind,
                             edge.value[setup_axis(setup)]);
    }
    if (!setup_light(own, 0, &light, error)) {
        return false;
    }
    falloff->first = light.first;
    if (!illumination_open_systems(falloff, error)) {
        return false;
    }
    falloff->axis = relative_look(falloff, (double[2]){0, 0}, false, &falloff->axis_field).light;
    const double behind = copysign(own->image, own->image * falloff->first.index_image);
    if (!(falloff->axis.value > 0) && behind < 0) {
        fail(error, ERROR_DOMAIN,
             "the image plane lies %.4g mm before the last vertex: no light gets there",
             fabs(own->image));
        return error_hint(error, "say with {focus} how far behind the last vertex it is");
    }
    return true;
}
