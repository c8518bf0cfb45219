/* analysis/setup/setup.c - one lens in one position made ready to be asked. */
/* SPDX-License-Identifier: MIT */
#include "analysis/setup/setup.h"

#include "optics/aperture.h"
#include "optics/wavelength.h"
#include "trace/pupil/focus.h"

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
        .image = NAN,
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
           setup_set_aperture(question, setup, error);
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

struct setup setup_apart(const struct setup *setup, struct arena *arena)
{
    struct setup other = *setup;
    other.arena = arena;
    other.systems =
        ARENA_ARRAY(arena, setup->wavelength_count * SETUP_SYSTEMS, const struct system *);
    return other;
}

struct setup setup_at_wavelength(const struct setup *setup, double wavelength, struct arena *arena)
{
    struct setup other = *setup;
    struct setup_wavelength *one = ARENA_NEW(arena, struct setup_wavelength);
    *one = (struct setup_wavelength){wavelength, 1};
    other.wavelengths = one;
    other.wavelength_count = 1;
    return setup_apart(&other, arena);
}

/* -------- exact rays -------- */

/* Every system of lenscalc's commands: the stop is as wide as at the primary wavelength. */
static bool systems_compile(const struct setup *setup, const struct lens *lens, double wavelength,
                            unsigned which, struct system *system, struct error *error)
{
    struct system_options options = system_options_default();
    options.clip = (which & SETUP_CLIPPED) != 0;
    options.reverse = (which & SETUP_REVERSED) != 0;
    options.path = (which & SETUP_PATH) != 0;
    options.image = (which & SETUP_IMAGE) != 0 ? setup->image : (double)NAN;
    options.paraxial = (which & SETUP_PARAXIAL) != 0;
    options.stop_radius = setup->first.stop_radius;
    return system_compile(lens, wavelength, &options, setup->arena, system, error);
}

bool setup_compile(const struct setup *setup, const struct lens *lens, size_t wavelength,
                   unsigned which, struct system *system, struct error *error)
{
    return systems_compile(setup, lens, setup->wavelengths[wavelength].wavelength, which, system,
                           error);
}

const struct system *setup_system(const struct setup *setup, size_t wavelength, unsigned which,
                                  struct error *error)
{
    const struct system **kept = &setup->systems[wavelength * SETUP_SYSTEMS + which];
    if (*kept == NULL) {
        struct system *system = ARENA_NEW(setup->arena, struct system);
        if (!setup_compile(setup, setup->lens, wavelength, which, system, error)) {
            return NULL;
        }
        *kept = system;
    }
    return *kept;
}

/* -------- the image plane -------- */

struct pair setup_paraxial_image(const struct lens *lens, const struct first_order *first)
{
    const struct surface *last = &lens->surfaces[lens->surface_count - 1];
    return lens->focus == FOCUS_TABLE && last->has_thickness ? last->thickness.value
                                                             : pair_of(first->image);
}

bool setup_place_image(struct setup *setup, const struct plane_value *asked, struct error *error)
{
    static const enum plane_kind kinds[] = {[FOCUS_PARAXIAL] = PLANE_PARAXIAL,
                                            [FOCUS_TABLE] = PLANE_TABLE,
                                            [FOCUS_BEST] = PLANE_BEST,
                                            [FOCUS_AFOCAL] = PLANE_PARAXIAL};
    bool is_asked = asked->kind != PLANE_OF_LENS;
    enum plane_kind kind = is_asked ? asked->kind : kinds[setup->lens->focus];
    double best;
    setup->image = setup->first.image;
    setup->focus = "paraxial";
    const struct surface *last = &setup->lens->surfaces[setup->lens->surface_count - 1];
    if (kind == PLANE_TABLE && last->has_thickness) {
        setup->image = last->thickness.value.hi;
        setup->focus = "table";
    } else if (kind == PLANE_TABLE && is_asked) {
        return fail(error, ERROR_DOMAIN, "the lens states no distance behind its last surface");
    } else if (kind == PLANE_TABLE) {
        setup->warning =
            "the lens states no distance behind its last surface: paraxial focus instead";
    }
    if (kind == PLANE_AT) {
        setup->image = asked->distance;
        setup->focus = "given";
    }
    struct system system;
    if (kind == PLANE_BEST &&
        systems_compile(setup, setup->lens, lens_primary_wavelength(setup->lens), SETUP_OPEN,
                        &system, error) &&
        lens_best_focus(&system, &setup->object, &setup->first, setup->arena, &best, error)) {
        setup->image = best;
        setup->focus = "best";
    } else if (kind == PLANE_BEST && is_asked) {
        return false;
    } else if (kind == PLANE_BEST) {
        setup->warning = arena_printf(setup->arena, "%s: paraxial focus instead", error->message);
    }
    if (isfinite(setup->image)) {
        return true;
    }
    setup->image = NAN;
    setup->focus = NULL;
    return !is_asked || fail(error, ERROR_DOMAIN,
                             "the image is infinitely far away: its distance must be given");
}

/* How far the marginal ray goes beyond the clear apertures: the largest of height over reach. */
static double excess(const struct setup *setup, struct arena *arena)
{
    const struct lens *lens = setup->lens;
    const struct first_order *first = &setup->first;
    struct paraxial_system system;
    struct error ignored;
    double most = 0;
    if (isnan(first->marginal_y) || !paraxial_compile(lens, lens_primary_wavelength(lens),
                                                      setup->section, arena, &system, &ignored)) {
        return 0;
    }
    struct paraxial_ray *rays = ARENA_ARRAY(arena, system.count + 1, struct paraxial_ray);
    paraxial_follow(&system, pair_of(first->marginal_y), pair_of(first->marginal_v), rays);
    for (size_t i = 0; i < system.count; i++) {
        /* the stop is as wide as the beam has it */
        if (i != system.stop) {
            most = fmax(most, fabs(rays[i].y) / aperture_reach(&lens->surfaces[i]));
        }
    }
    return most;
}

struct setup_width setup_width(const struct setup *setup, double fnumber, struct arena *arena)
{
    /* The f-number of the beam that the lens states; NaN where it states none. */
    const struct aperture_setting own = lens_aperture(setup->lens);
    struct first_order first = setup->first;
    struct error ignored;
    const double passing = fnumber * excess(setup, arena),
                 stated =
                     first_order_aperture(&first, &setup->object, &own, FIELD_NONE, NAN, &ignored)
                         ? first.fnumber
                         : (double)NAN;
    return (struct setup_width){isfinite(stated) ? stated : passing, passing};
}

const char *setup_width_text(const struct setup_width *width, double fnumber, struct arena *arena)
{
    const bool is_wider =
        fnumber < SETUP_WIDTH_SLACK * width->own && fnumber < SETUP_WIDTH_SLACK * width->passing;
    return is_wider ? arena_printf(arena,
                                   "the lens is f/%.4g wide open: rays of f/%.4g pass only where "
                                   "its clear apertures let them",
                                   width->own, fnumber)
                    : NULL;
}

const char *setup_width_warning(const struct setup *setup, double fnumber, struct arena *arena)
{
    if (!(fnumber > 0)) {
        return NULL;
    }
    const struct setup_width width = setup_width(setup, fnumber, arena);
    return setup_width_text(&width, fnumber, arena);
}
