/* exchange/sequence.c - a lens as CODE V and OSLO have it: surfaces, pick-ups, tilts, solves. */
/* SPDX-License-Identifier: MIT */
#include "exchange/sequence.h"

#include "base/constants.h"
#include "exchange/entrance_pupil.h"
#include "file/decimal.h"
#include "file/lens_words.h"

#include <math.h>
#include <string.h>

struct figure sequence_diameter(const struct figure *radius, struct arena *arena)
{
    return (struct figure){.value = {2 * radius->value.hi, 2 * radius->value.lo},
                           .typed = decimal_double(radius->typed, arena),
                           .variable = LENS_NONE};
}

struct sequence_surface *sequence_add(struct sequence *sequence, struct command_word at)
{
    struct sequence_surface *surface =
        ARENA_ADD(sequence->job->arena, sequence->surfaces, sequence->count, sequence->room);
    *surface = (struct sequence_surface){.at = at,
                                         .curve = sequence_nothing,
                                         .is_radius = true,
                                         .thickness = sequence_nothing,
                                         .medium = medium_air,
                                         .diameter = sequence_nothing,
                                         .conic = sequence_nothing};
    for (int i = 0; i < LENS_COEFFICIENTS; i++) {
        surface->coefficient[i] = sequence_nothing;
    }
    for (int i = 0; i < 3; i++) {
        surface->shift[i] = surface->turn[i] = sequence_nothing;
    }
    return surface;
}

const char *sequence_indices(struct arena *arena, const struct text *waves, const char *unit,
                             const struct command_word *indices, size_t count)
{
    struct text_buffer table = {.arena = arena};
    bool same = true;
    for (size_t i = 0; i < count; i++) {
        const struct text wave = waves[i], index = indices[i].text;
        same = same && text_identical(index, indices[0].text);
        growing_format(&table, "%s%.*s%s %.*s", i == 0 ? "{" : ", ", (int)wave.length, wave.start,
                       unit, (int)index.length, index.start);
    }
    growing_put(&table, "}", sizeof "}");
    return same ? arena_string(arena, indices[0].text.start, indices[0].text.length) : table.data;
}

bool sequence_medium(const struct commands *commands, const struct command_word *at,
                     const char *written, struct medium *medium)
{
    struct file_words words = commands_place(commands, at);
    words.line = text_of(written);
    return lens_words_medium(&words, words.line, medium);
}

void sequence_set_constant(const struct sequence *sequence, struct sequence_surface *surface,
                           int order, struct figure figure)
{
    if (order == 0) {
        surface->conic = figure;
        return;
    }
    const int at = surface_term(order);
    const unsigned is_some = figure.value.hi != 0;
    sequence_per_length(sequence->commands, order - 1, &figure);
    surface->coefficient[at] = figure;
    surface->coefficients = (surface->coefficients & ~(1u << at)) | (is_some << at);
}

bool sequence_read_constant(const struct sequence *sequence, size_t word,
                            struct sequence_surface *surface, int order)
{
    struct figure figure;
    if (!commands_value(sequence->commands, word, false, order == 0 ? "conic" : "coefficient",
                        &figure)) {
        return false;
    }
    sequence_set_constant(sequence, surface, order, figure);
    return true;
}

bool sequence_read_shift(const struct sequence *sequence, size_t word,
                         struct sequence_surface *surface, int what)
{
    const struct commands *commands = sequence->commands;
    bool is_turn = what < 'X';
    struct figure figure;
    if (!commands_value(commands, word, !is_turn, is_turn ? "tilt" : "decentre", &figure)) {
        return false;
    }
    surface->decentred_at = sequence->commands->words[0];
    if (!is_turn) {
        surface->shift[what - 'X'] = figure;
        return true;
    }
    figure.value = pair_multiply(figure.value, pair_of(RADIANS_PER_DEGREE));
    surface->turn[what - 'A'] = what == 'C' ? figure : figure_negate(figure, sequence->job->arena);
    return true;
}

void sequence_add_wave(const struct sequence *sequence, struct text wave, const char *unit,
                       struct text weight)
{
    const struct number_scale scale = {1, strcmp(unit, "nm") == 0 ? -3 : 0};
    double micrometres = 0, counts = 1;
    text_number(wave, scale, &micrometres);
    text_number(weight, NUMBER_UNSCALED, &counts);
    struct lens_wavelength *one = lens_build_wavelength(sequence->build, micrometres, counts);
    one->typed =
        text_of(arena_printf(sequence->job->arena, "%.*s%s", (int)wave.length, wave.start, unit));
    if (counts != 1) {
        one->weight_typed = weight;
    }
}

/* A thickness with what shifts along z add to it. */
static struct figure with_extra(const struct sequence *sequence, const struct figure *one,
                                struct pair extra)
{
    return extra.hi == 0 ? *one
                         : figure_computed(pair_add(one->value, extra), sequence->commands->scale,
                                           sequence->job->arena);
}

/* A curvature becomes a radius where figure_radius_of finds one, else it stays. */
static void sequence_put_curve(const struct sequence *sequence, const struct sequence_surface *from,
                               struct surface *surface)
{
    const char *unit = sequence->build->lens->unit;
    if (!sequence_is_some(&from->curve)) {
        return;
    }
    if (from->is_radius) {
        surface->is_plane = false;
        surface->radius = from->curve;
    } else if (figure_radius_of(&from->curve, unit, sequence->job->arena, &surface->radius)) {
        surface->is_plane = false;
    } else {
        surface->has_curvature = true;
        surface->curvature = from->curve;
    }
}

/* One that passes as a circle about the vertex is the diameter, and another takes it along. */
static void sequence_put_aperture(const struct sequence *sequence, struct sequence_aperture *one,
                                  struct surface *surface, struct aperture *to)
{
    struct error wrong;
    *to = one->aperture;
    if (!to->blocks && to->shape == SHAPE_CIRCLE && surface->has_diameter) {
        to->size[0] = surface->diameter;
        surface->has_diameter = false;
    }
    if (aperture_check(to, &wrong)) {
        surface->aperture_count++;
        return;
    }
    commands_loss(sequence->commands, &one->at, LOSS_OF_VIGNETTING, "left out",
                  "%.*s: an aperture that is not stated whole", text_shown(one->at.text),
                  one->at.text.start);
}

static void sequence_put_apertures(const struct sequence *sequence,
                                   const struct sequence_surface *from, struct surface *surface)
{
    struct aperture *all = ARENA_ARRAY(sequence->job->arena, from->aperture_count, struct aperture);
    surface->apertures = all;
    for (size_t i = 0; i < from->aperture_count; i++) {
        sequence_put_aperture(sequence, &from->apertures[i], surface,
                              &all[surface->aperture_count]);
    }
}

/* The surface, and behind a bend a plane that turns the axis. */
static void sequence_put_surface(const struct sequence *sequence, size_t index, size_t *lens_index)
{
    struct sequence_surface *from = &sequence->surfaces[index];
    struct lens_build *build = sequence->build;
    struct arena *arena = sequence->job->arena;
    struct lens *lens = build->lens;
    if (sequence_is_decentred(from)) {
        sequence_check_move(sequence, from);
    }
    sequence_turn_first(sequence, from);
    struct surface *surface = lens_build_surface(build);
    *lens_index = from->place = lens->surface_count - 1;
    sequence_put_curve(sequence, from, surface);
    const struct medium *before = *lens_index > 0 ? &surface[-1].medium : &lens->object_medium;
    surface->kind = from->reflects ? SURFACE_REFLECT : SURFACE_REFRACT;
    surface->medium = from->reflects ? *before : from->medium;
    surface->conic = from->conic;
    surface->coefficients = from->coefficients;
    memcpy(surface->coefficient, from->coefficient, sizeof surface->coefficient);
    surface->curved = from->curved;
    surface->name = from->name;
    struct figure zero = figure_of(0, arena);
    if (from->thickness.typed.start != NULL) {
        zero = from->thickness;
    }
    const struct figure thickness = with_extra(sequence, &zero, from->extra);
    /* A decentred one is none, where its decentre is lost. */
    surface->has_diameter = from->diameter.typed.start != NULL && from->diameter.value.hi != 0 &&
                            !from->has_lost_aperture;
    if (surface->has_diameter) {
        surface->diameter = from->diameter;
    }
    sequence_put_apertures(sequence, from, surface);
    if (from->is_stop) {
        lens_build_stop(build, *lens_index);
    }
    surface = sequence_move_surface(sequence, from, surface);
    surface->thickness = thickness;
}

/* Is the object so far away that its program takes it as infinitely far? */
static bool is_distance_infinite(const struct sequence *sequence, const struct figure *distance)
{
    const struct commands *commands = sequence->commands;
    const struct pair per_unit = lens_words_per_length(pair_of(1), commands->scale, 1);
    return fabs(pair_multiply(distance->value, per_unit).hi) >= commands->grammar->infinity;
}

bool sequence_is_near(const struct sequence *sequence)
{
    return sequence->count > 0 && !is_distance_infinite(sequence, &sequence->surfaces[0].thickness);
}

static void sequence_put_object(const struct sequence *sequence)
{
    struct lens *lens = sequence->build->lens;
    struct sequence_surface *object = &sequence->surfaces[0];
    if (sequence_is_some(&object->curve) || sequence_is_decentred(object) ||
        sequence_is_some(&object->shift[2])) {
        commands_loss(sequence->commands, &object->at, LOSS_OF_RAYS, "taken as a plane",
                      "a curved or tilted object");
    }
    lens->object_medium = object->medium;
    const struct figure infinite = {{INFINITY, 0}, text_of("inf"), LENS_NONE};
    lens->object_is_infinite = is_distance_infinite(sequence, &object->thickness);
    lens->object = lens->object_is_infinite
                       ? infinite
                       : with_extra(sequence, &object->thickness, object->extra);
    if (!lens->object_is_infinite && !(lens->object.value.hi > 0)) {
        virtual_object_put(sequence->build, lens->object.value);
    }
}

/* The image plane: its distance is the last thickness; a tilted or bent one stays as a surface. */
static void sequence_put_image(const struct sequence *sequence, bool is_solved)
{
    struct sequence_surface *image = &sequence->surfaces[sequence->count - 1];
    struct lens *lens = sequence->build->lens;
    size_t last = lens->surface_count;
    if (sequence->is_afocal) {
        lens->focus = FOCUS_AFOCAL;
    } else if (is_solved) {
        lens->focus = FOCUS_PARAXIAL;
    } else {
        lens->focus = FOCUS_TABLE;
    }
    if (sequence_is_some(&image->curve)) {
        commands_loss(sequence->commands, &image->at, LOSS_OF_RAYS, "taken as a plane",
                      "a curved image");
    }
    if (sequence_is_decentred(image) && image->move != SEQUENCE_RETURN) {
        image->thickness = sequence_nothing;
        image->extra = pair_of(0);
        image->medium = lens->surfaces[last - 1].medium;
        lens->focus = FOCUS_TABLE;
        sequence_put_surface(sequence, sequence->count - 1, &last);
    }
}

bool sequence_environment(struct sequence *sequence, bool is_temperature, double per_atmosphere)
{
    const struct commands *commands = sequence->commands;
    struct figure figure;
    if (!commands_value(commands, 1, false, is_temperature ? "temperature" : "pressure", &figure)) {
        return false;
    }
    if (is_temperature) {
        sequence->environment.temperature = figure.value.hi;
        return figure.value.hi > -273.15 ||
               commands_fail(commands, &commands->words[1], "a temperature is above -273.15 C");
    }
    sequence->environment.pressure = figure.value.hi / per_atmosphere;
    return figure.value.hi >= 0 ||
           commands_fail(commands, &commands->words[1], "a pressure is not below 0");
}

/* The glasses in the air of the file. */
static bool sequence_glasses_in_air(struct sequence *sequence)
{
    struct environment *environment = &sequence->environment;
    const struct lens *lens = sequence->build->lens;
    environment->job = sequence->job;
    environment->build = sequence->build;
    environment->wave_count = 0;
    for (size_t i = 0; i < lens->wavelength_count && i < ENVIRONMENT_WAVES; i++) {
        environment->waves[environment->wave_count++] = lens->wavelengths[i].wavelength;
    }
    for (size_t i = 0; i < sequence->count; i++) {
        struct sequence_surface *surface = &sequence->surfaces[i];
        const struct command_word *at =
            surface->glass.text.length > 0 ? &surface->glass : &surface->at;
        const struct file_words place = commands_place(sequence->commands, at);
        if (!environment_apply(environment, &place, at->text, &surface->medium)) {
            return false;
        }
    }
    return true;
}

bool sequence_finish(struct sequence *sequence)
{
    if (sequence->count < 3) {
        return foreign_fail(sequence->commands->job, sequence->commands->error,
                            "the file has no surface between object and image");
    }
    if (!sequence_apply_pickups(sequence) || !sequence_glasses_in_air(sequence)) {
        return false;
    }
    struct sequence_surface *image = &sequence->surfaces[sequence->count - 1], *last = image - 1;
    if (image->thickness.typed.start != NULL) { /* the defocus */
        last->extra = pair_add(last->extra, image->thickness.value);
    }
    sequence_spread_z(sequence);
    size_t *indices = ARENA_ARRAY(sequence->job->arena, sequence->count, size_t);
    sequence_put_object(sequence);
    /* The files say it of an object at infinity too, which has no such space. */
    struct lens *lens = sequence->build->lens;
    if (lens->is_telecentric && lens->object_is_infinite) {
        lens->is_telecentric = false;
        commands_loss(sequence->commands, &sequence->surfaces[0].at, LOSS_OF_RAYS,
                      "an ordinary one", "a telecentric object space of an object at infinity");
    }
    for (size_t i = 1; i + 1 < sequence->count; i++) {
        sequence_put_surface(sequence, i, &indices[i]);
    }
    struct sequence_solve *solve = &last->thickness_solve;
    /* Does the last solve bring the marginal ray to the axis, with no light lost on its way? */
    bool is_kept = sequence->job->lost_power != NULL && last->thickness.typed.start != NULL;
    bool is_solved = !is_kept && solve->is_set && !solve->is_unknown && !solve->of_angle &&
                     solve->ray == SOLVE_MARGINAL && solve->target.value.hi == 0 &&
                     last->extra.hi == 0;
    if (is_solved && last->thickness.typed.start != NULL) {
        solve->is_set = false; /* 'focus paraxial' solves it whenever it is asked for */
    }
    foreign_mark_power(sequence->job, sequence->build);
    sequence_put_image(sequence, is_solved);
    if (!sequence_solve_all(sequence, indices)) {
        return false;
    }
    sequence_keep_pickups(sequence);
    return true;
}
