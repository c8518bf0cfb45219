/* analysis/setup/setup.c - one lens in one position made ready to be asked. */
/* SPDX-License-Identifier: MIT */
#include "analysis/setup/setup.h"

#include "optics/wavelength.h"

#include <math.h>

static void keep_wavelengths(const struct setup_wavelength *list, size_t count, struct setup *setup)
{
    setup->wavelengths = list;
    setup->wavelength_count = count;
    setup->systems =
        ARENA_ARRAY(setup->arena, count * (size_t)SETUP_SYSTEMS, const struct system *);
}

/* A spectrum that was asked for, a list of one, or that of the lens. */
static void choose_wavelengths(const struct setup_question *question, struct setup *setup)
{
    const struct lens *lens = setup->lens;
    if (question->spectrum_count > 0) {
        keep_wavelengths(question->spectrum, question->spectrum_count, setup);
        return;
    }
    bool all = isnan(question->wavelength) && question->wavelengths == WAVELENGTHS_ALL &&
               lens->wavelength_count > 0;
    size_t count = all ? lens->wavelength_count : 1;
    struct setup_wavelength *list = ARENA_ARRAY(setup->arena, count, struct setup_wavelength);
    list[0] = (struct setup_wavelength){
        isnan(question->wavelength) ? lens_primary_wavelength(lens) : question->wavelength, 1};
    for (size_t i = 0; all && i < count; i++) {
        list[i] =
            (struct setup_wavelength){lens->wavelengths[i].wavelength, lens->wavelengths[i].weight};
    }
    keep_wavelengths(list, count, setup);
}

/* Without fields at first: a real image may be in the best focus, which depends on the aperture. */
static bool setup_set_aperture(const struct setup_question *question, struct setup *setup,
                               struct error *error)
{
    struct aperture_setting aperture = lens_aperture(setup->lens);
    if (!isnan(question->fnumber)) {
        aperture = (struct aperture_setting){APERTURE_FNUMBER, question->fnumber};
    }
    const struct field_point edge = setup_in_section(setup, &setup->edge);
    setup->aperture = aperture.kind;
    return first_order_aperture(&setup->first, &setup->object, &aperture, edge.kind,
                                edge.value[setup_axis(setup)], error);
}

bool setup_open(const struct setup_question *question, struct arena *arena, struct setup *setup,
                struct error *error)
{
    const struct lens *all = question->lens;
    const struct lens *placed = lens_at_position(all, question->position, arena);
    const struct lens *lens = placed;
    if (question->object != NULL) {
        struct lens *moved = ARENA_NEW(arena, struct lens);
        const double distance = *question->object;
        *moved = *placed;
        moved->object_is_infinite = isinf(distance);
        moved->object.value = pair_of(isinf(distance) ? 0 : distance);
        moved->objects = NULL;
        lens = moved;
    }
    *setup = (struct setup){
        .lens = lens,
        .position = all->position_count > 0 ? all->positions[question->position] : NULL,
        .section = question->section,
        .object = lens_object(lens),
        .edge = {.kind = FIELD_NONE},
        .real_stop = NAN,
        .image = NAN,
        .aperture = APERTURE_NONE,
        .arena = arena,
    };
    if (lens->is_telecentric && !question->takes_telecentric) {
        return fail(error, ERROR_DOMAIN,
                    "the object space of the lens is telecentric, and what is asked here is of "
                    "beams that the stop limits");
    }
    if (lens->is_telecentric && lens->object_is_infinite) {
        return fail(error, ERROR_DOMAIN,
                    "the object space of the lens is telecentric: {object} must be at a finite "
                    "distance");
    }
    choose_wavelengths(question, setup);
    return first_order_of_lens(lens, lens_primary_wavelength(lens), setup->section, arena,
                               &setup->first, error) &&
           setup_set_aperture(question, setup, error) &&
           setup_choose_fields(question, setup, error) &&
           setup_set_aperture(question, setup, error) &&
           (!lens->stop_is_real || question->leaves_stop || lens->stop == LENS_NONE ||
            setup_marginal_stop(setup, &setup->real_stop, error) ||
            error_prefix(error, "the stop has no size of a real ray: "));
}

bool setup_light(const struct setup *setup, size_t wavelength, struct setup_light *light,
                 struct error *error)
{
    const struct conjugate_object *object = &setup->object;
    const struct first_order *primary = &setup->first;
    const struct field_point edge = setup_edge_in_object(setup);
    enum field_kind kind = edge.kind;
    double field = edge.value[setup_axis(setup)];
    struct paraxial_trace trace;
    light->wavelength = setup->wavelengths[wavelength].wavelength;
    if (!paraxial_compile(setup->lens, light->wavelength, setup->section, setup->arena,
                          &light->system, error)) {
        return false;
    }
    if (light->wavelength == lens_primary_wavelength(setup->lens)) {
        light->first = *primary;
        return true;
    }
    paraxial_trace(&light->system, &trace);
    first_order_compute(&light->system, &trace, object, &light->first);
    if (primary->is_telecentric) {
        const struct aperture_setting aperture = lens_aperture(setup->lens);
        return first_order_aperture(&light->first, object, &aperture, kind, field, error);
    }
    if (!isnan(primary->stop_radius)) {
        first_order_use_stop(&light->first, object, primary->stop_radius, kind, field);
        return true;
    }
    /* no stop: the same entrance beam */
    const struct aperture_setting beam = {APERTURE_EPD, primary->entrance_diameter};
    return isnan(beam.value) ||
           first_order_aperture(&light->first, object, &beam, kind, field, error);
}
