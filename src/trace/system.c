/* trace/system.c - from a lens to the steps of the kernels. */
/* SPDX-License-Identifier: MIT */
#include "trace/system.h"
#include "trace/kernel/search.h"

#include "optics/first_order.h"
#include "optics/lens_indices.h"
#include "trace/frames.h"
#include "trace/kernel/clip.h"
#include "trace/kernel/step.h"

#include <assert.h>
#include <math.h>
#include <stdint.h>
#include <string.h>

/* Rays aimed at the edge of the stop pass, in spite of rounding. */
static const double stop_slack = 1 + 1e-13;

struct system_options system_options_default(void)
{
    return (struct system_options){.image = NAN, .stop_radius = NAN};
}

size_t system_place(const struct system *system, size_t surface)
{
    size_t count = system->lens->surface_count;
    return system->options.reverse && surface < count ? count - 1 - surface : surface;
}

size_t system_surface(const struct system *system, size_t place)
{
    return system_place(system, place);
}

/* Index before a place, in the order of light. */
static double index_before(const struct system *system, size_t place)
{
    size_t count = system->lens->surface_count;
    return system->n[system->options.reverse ? count - place : place].hi;
}

double system_index_after(const struct system *system, size_t place)
{
    size_t count = system->lens->surface_count;
    return place < count ? index_before(system, place + 1) : index_before(system, count);
}

/* Those of the options, or what the media say. */
static bool find_indices(struct system *system, struct arena *arena, struct error *error)
{
    system->n = system->options.indices;
    if (system->n != NULL) {
        return true;
    }
    struct pair *n = ARENA_ARRAY(arena, system->lens->surface_count + 1, struct pair);
    system->n = n;
    return lens_indices(system->lens, system->wavelength, NULL, n, error);
}

static bool find_stop_radius(const struct lens *lens, struct arena *arena, struct system *system,
                             struct error *error)
{
    system->stop_radius = system->options.stop_radius;
    if (!isnan(system->stop_radius) || lens->stop == LENS_NONE) {
        return true;
    }
    const struct surface *stop = &lens->surfaces[lens->stop];
    if (lens->aperture_kind == APERTURE_NONE || lens->aperture_kind == APERTURE_STOP) {
        system->stop_radius = stop->has_diameter ? stop->diameter.value.hi / 2 : NAN;
        return true;
    }
    struct first_order first;
    const struct conjugate_object object = lens_object(lens);
    const struct aperture_setting aperture = lens_aperture(lens);
    if (!first_order_of_lens(lens, lens_primary_wavelength(lens), SECTION_Y, arena, &first,
                             error) ||
        !first_order_aperture(&first, &object, &aperture, FIELD_NONE, NAN, error)) {
        return false;
    }
    system->stop_radius = fabs(first.stop_radius);
    return true;
}

double system_clear_radius(const struct system *system, size_t i)
{
    const struct surface *surface = &system->lens->surfaces[i];
    double clear = surface->has_diameter ? surface->diameter.value.hi / 2 : (double)INFINITY;
    if (i == system->stop && system->stop_radius < clear) {
        clear = system->stop_radius * stop_slack;
    }
    return system->options.clip ? clear : (double)INFINITY;
}

/* The step of each kind of curve, round or curved in one section only. */
static const enum step_kind steps_of[PROFILE_KINDS][2] = {
    [PROFILE_PLANE] = {STEP_PLANE, STEP_PLANE},
    [PROFILE_SPHERE] = {STEP_SPHERE, STEP_CYLINDER},
    [PROFILE_CONIC] = {STEP_CONIC, STEP_CYLINDER},
    [PROFILE_EVEN] = {STEP_ASPHERE, STEP_TROUGH},
    [PROFILE_ODD] = {STEP_ODD, STEP_ODD}};

static void set_shape(struct step *step, const struct surface *surface)
{
    struct pair k = surface->conic.value;
    const double *weight = surface_section(surface)->weight;
    step->c = surface_base_curvature(surface).hi;
    step->kind = steps_of[surface_profile(surface)][surface_is_round(surface) ? 0 : 1];
    step->k = k.hi;
    step->one_k = pair_add(pair_of(1), k).hi;
    step->weight_x = weight[0];
    step->weight_y = weight[1];
    for (int i = 0; i < LENS_ODD; i++) {
        step->odd[i] = surface->coefficient[LENS_EVEN + i].value.hi;
        step->odd_slope[i] = (i + 0.5) * step->odd[i];
    }
    for (int i = 0; i < LENS_EVEN; i++) {
        step->coefficient[i] = surface->coefficient[i].value.hi;
        step->slope[i] = (i + 1) * step->coefficient[i];
        if (step->coefficient[i] != 0) {
            step->terms = i + 1;
        }
    }
}

/*
 * The conic that fits an asphere at its vertex to r^4: Newton's method needs one or two steps less
 * from there. Within the clear aperture it must not come near its rim nor bend away.
 */
static void step_set_start_conic(struct step *step, const struct surface *surface)
{
    double c = step->c + 2 * step->coefficient[0], r = surface->diameter.value.hi / 2;
    double fourth = step->c * step->c * step->c * step->one_k + 8 * step->coefficient[1];
    double fit = c == 0 ? 0 : fourth / (c * c * c);
    double most = surface->has_diameter && r > 0 ? 0.5 / (c * c * r * r) : 1;
    step->inner = surface->has_diameter ? r : 0;
    step->start_c = c;
    step->start_k = fmax(fmin(fit, most), -8 * most);
}

static void set_media(struct step *step, struct pair before, struct pair after)
{
    step->n11 = pair_multiply(before, before).hi;
    step->n22 = pair_multiply(after, after).hi;
    step->dn = pair_multiply(pair_subtract(after, before), pair_add(after, before)).hi;
    step->cn = step->c * step->n11;
}

static void set_codes(struct step *step, size_t place, size_t surface)
{
    step->surface = surface;
    step->miss = RAY_LOST_AT(place, surface + 1, RAY_MISS);
    step->clipped = RAY_LOST_AT(place, surface + 1, RAY_CLIPPED);
    step->reflected = RAY_LOST_AT(place, surface + 1, RAY_TOTAL_REFLECTION);
    step->unconverged = RAY_LOST_AT(place, surface + 1, RAY_NOT_CONVERGED);
}

static enum step_action action_of(const struct surface *surface, const struct step *step)
{
    if (surface_reflects(surface)) {
        return ACTION_REFLECT;
    }
    return step->kind == STEP_PLANE && step->dn == 0 ? ACTION_PASS : ACTION_REFRACT;
}

/* Steps being written. */
struct step_writer {
    struct system *system;
    struct step *steps;
    size_t count;
};

static void put_move(struct step_writer *writing, const struct surface_frame *frame, size_t place)
{
    struct step *step = &writing->steps[writing->count++];
    *step = (struct step){.kind = STEP_MOVE};
    set_codes(step, place, system_surface(writing->system, place));
    for (int i = 0; i < 9; i++) {
        step->turn[i] = frame->turn[i];
    }
    for (int i = 0; i < 3; i++) {
        step->shift[i] = frame->shift[i];
    }
}

/* Into the frame of the surface at `place`; returns the way along z that is left to the surface. */
static double put_transfer(struct step_writer *writing, size_t place)
{
    const struct system *system = writing->system;
    const struct lens *lens = system->lens;
    bool reverse = system->options.reverse;
    if (place == 0) {
        const struct displacement *coordinate_break =
            reverse ? NULL : lens->surfaces[0].coordinate_break;
        if (coordinate_break != NULL) {
            struct surface_frame frame = frame_of(coordinate_break, 0);
            put_move(writing, &frame, 0);
        }
        return 0;
    }
    size_t left = reverse ? lens->surface_count - 1 - place : place - 1;
    double t = surface_advance(&lens->surfaces[left]).hi;
    const struct displacement *coordinate_break = lens->surfaces[left + 1].coordinate_break;
    if (coordinate_break == NULL) {
        return reverse ? -t : t;
    }
    struct surface_frame frame = frame_of(coordinate_break, t);
    if (reverse) {
        frame = frame_inverse(&frame);
    }
    put_move(writing, &frame, place);
    return 0;
}

/* How far the object is from H along the axis; infinite for a distant one. */
static double object_to(const struct lens *lens, size_t surface)
{
    double distance = lens->object.value.hi;
    for (size_t i = 0; i < surface; i++) {
        distance += surface_advance(&lens->surfaces[i]).hi;
    }
    return lens->object_is_infinite ? (double)INFINITY : distance;
}

/* Backwards the same lens takes light from H' to H: the other sign of the power. */
static void set_thick(struct step *step, const struct system *system, size_t i)
{
    const struct surface *surface = &system->lens->surfaces[i];
    bool reverse = system->options.reverse;
    double hiatus = surface->hiatus.value.hi, before = system->n[i].hi, after = system->n[i + 1].hi;
    double behind = reverse ? before : after;
    step->kind = STEP_THICK;
    step->action = ACTION_PASS;
    step->ratio = (reverse ? after : before) / behind;
    step->bend = (reverse ? -1 : 1) * system->direction[i] / (surface->focal.value.hi * behind);
    step->near_object = 1 / object_to(system->lens, i);
    step->leave = reverse ? 0 : hiatus;
    step->t += reverse ? hiatus : 0;
    for (int k = 0; k < 3; k++) {
        step->coefficient[k] = surface->distortion[k].value.hi;
    }
}

/* As the matrix [1 0; -P 1] has it, for heights and slopes of any size; a mirror turns slopes. */
static void step_set_paraxial(struct step *step, const struct system *system, size_t i)
{
    const bool reverse = system->options.reverse, reflects = step->action == ACTION_REFLECT;
    const double c = surface_curvature(&system->lens->surfaces[i], SECTION_Y).hi;
    const double before = system->n[i].hi, after = system->n[i + 1].hi;
    const double ahead = reverse ? after : before, behind = reverse ? before : after;
    const double power = (reverse ? -1 : 1) * ((after - before) * c);
    step->kind = STEP_THICK;
    step->ratio = reflects ? -1 : ahead / behind;
    step->bend = reflects ? 2 * c : power / behind;
    memset(step->coefficient, 0, sizeof step->coefficient);
}

static void writer_put_surface(struct step_writer *writing, size_t place)
{
    const struct system *system = writing->system;
    size_t i = system_surface(system, place);
    const struct surface *surface = &system->lens->surfaces[i];
    bool reverse = system->options.reverse;
    double t = put_transfer(writing, place);
    size_t before = writing->count;
    struct surface_frame back;
    if (surface->decentre != NULL) {
        struct surface_frame frame = frame_of(surface->decentre, 0);
        back = frame_inverse(&frame);
        frame.shift[2] += t;
        put_move(writing, &frame, place);
        t = 0;
    }
    struct step *step = &writing->steps[writing->count++];
    double clear = system_clear_radius(system, i);
    *step = (struct step){.t = t, .clear2 = clear * clear};
    set_shape(step, surface);
    step_set_start_conic(step, surface);
    set_media(step, system->n[reverse ? i + 1 : i], system->n[reverse ? i : i + 1]);
    set_codes(step, place, i);
    step->clip = system->clips != NULL ? system->clips[i] : NULL;
    step->action = action_of(surface, step);
    step->direction = system->direction[i];
    if (reverse && !surface_reflects(surface)) {
        step->direction = -step->direction;
    }
    if (surface_has(surface, SURFACE_HAS_FOCAL)) {
        set_thick(step, system, i);
    } else if (system->options.paraxial && step->action != ACTION_PASS) {
        step_set_paraxial(step, system, i);
    }
    if (step->kind == STEP_ASPHERE || step->kind == STEP_TROUGH || step->kind == STEP_ODD) {
        search_prepare(step);
    }
    step->hop = place == 0 || writing->count - before > 1 || !(fabs(step->c * t) <= 1);
    if (surface->decentre != NULL) {
        put_move(writing, &back, place);
    }
}

static void writer_put_image(struct step_writer *writing)
{
    const struct system *system = writing->system;
    size_t last = system->lens->surface_count;
    bool reverse = system->options.reverse;
    const struct surface *end = &system->lens->surfaces[last - 1];
    double behind = reverse ? 0 : surface_hiatus(end).hi;
    struct step *step = &writing->steps[writing->count++];
    *step = (struct step){.kind = STEP_PLANE,
                          .action = ACTION_PASS,
                          .t = system->options.image + behind,
                          .hop = true,
                          .clear2 = (double)INFINITY};
    set_media(step, system->n[reverse ? 0 : last], system->n[reverse ? 0 : last]);
    set_codes(step, last, last);
    step->direction = reverse ? -1 : system->direction[last];
}

/* The apertures of all surfaces, and the system without those that cut within. */
static bool add_clips(struct arena *arena, struct system *system, struct error *error)
{
    const struct lens *lens = system->lens;
    struct system_options options = system->options;
    enum clip_way way = options.unobstructed ? CLIP_HULLS : CLIP_ALL;
    const struct clip **clips = NULL;
    bool cuts = false;
    for (size_t i = 0; i < lens->surface_count && options.clip; i++) {
        if (lens->surfaces[i].aperture_count == 0) {
            continue;
        }
        if (clips == NULL) {
            clips = ARENA_ARRAY(arena, lens->surface_count, const struct clip *);
        }
        clips[i] = clip_of(&lens->surfaces[i], way, arena);
        cuts = cuts || (way == CLIP_ALL && clip_cuts(&lens->surfaces[i], arena));
    }
    system->clips = clips;
    if (!cuts) {
        return true;
    }
    struct system *outer = ARENA_NEW(arena, struct system);
    options.unobstructed = true;
    system->outer = outer;
    return system_compile(lens, system->wavelength, &options, arena, outer, error);
}

/* All surfaces, with the moves to and from those that are moved, and the image plane. */
static size_t most_steps(const struct lens *lens)
{
    size_t count = lens->surface_count + 1;
    for (size_t i = 0; i < lens->surface_count; i++) {
        count += lens->surfaces[i].decentre != NULL ? 2 : 0;
        count += lens->surfaces[i].coordinate_break != NULL ? 1 : 0;
    }
    return count;
}

static bool has_distortion(const struct surface *surface)
{
    bool has = false;
    for (int k = 0; k < 3; k++) {
        has = has || surface->distortion[k].value.hi != 0;
    }
    return has && surface_has(surface, SURFACE_HAS_FOCAL);
}

/* Can all surfaces be traced in the way that is asked for? */
static bool check_way(const struct lens *lens, const struct system_options *options,
                      struct error *error)
{
    for (size_t i = 0; i < lens->surface_count; i++) {
        const struct surface *surface = &lens->surfaces[i];
        if (options->reverse && has_distortion(surface)) {
            return fail(error, ERROR_DOMAIN,
                        "surface %zu: a thick lens with distortion cannot be traced backwards",
                        i + 1);
        }
        if (options->paraxial && !surface_is_round(surface)) {
            return fail(error, ERROR_DOMAIN,
                        "surface %zu is not the same all around: it has paraxial rays in its two "
                        "sections only",
                        i + 1);
        }
    }
    return true;
}

/* Aligned to 64 bytes. */
static struct step *steps_new(size_t count, struct arena *arena)
{
    char *memory = arena_buffer_array(arena, count + 1, sizeof(struct step));
    return (struct step *)(void *)(memory + (64 - (uintptr_t)memory % 64) % 64);
}

void system_recolour(const struct system *from, double wavelength, const struct pair *indices,
                     struct arena *arena, struct system *system)
{
    const size_t count = from->begin[from->places], last = from->lens->surface_count;
    struct step *steps = steps_new(count, arena);
    assert(!from->options.clip && !from->options.reverse && !from->options.paraxial);
    memcpy(steps, from->steps, count * sizeof *steps);
    *system = *from;
    system->options.indices = indices;
    system->wavelength = wavelength;
    system->n = indices;
    system->index_first = indices[0].hi;
    system->index_last = indices[last].hi;
    system->steps = steps;
    for (size_t i = 0; i < count; i++) {
        const size_t surface = steps[i].surface;
        if (steps[i].kind == STEP_MOVE) {
            continue;
        }
        set_media(&steps[i], indices[surface], indices[surface < last ? surface + 1 : last]);
        if (surface < last) {
            steps[i].action = action_of(&from->lens->surfaces[surface], &steps[i]);
        }
    }
}

bool system_compile(const struct lens *lens, double wavelength,
                    const struct system_options *options, struct arena *arena,
                    struct system *system, struct error *error)
{
    size_t count = lens->surface_count;
    *system = (struct system){
        .lens = lens, .options = *options, .stop = lens->stop, .wavelength = wavelength};
    if (!find_indices(system, arena, error) || !find_stop_radius(lens, arena, system, error) ||
        !add_clips(arena, system, error)) {
        return false;
    }
    if (!check_way(lens, options, error)) {
        return false;
    }
    system->index_first = system->n[options->reverse ? count : 0].hi;
    system->index_last = system->n[options->reverse ? 0 : count].hi;
    double *direction = ARENA_ARRAY(arena, count + 1, double);
    frame_directions(lens, direction);
    system->direction = direction;
    struct step_writer writing = {.system = system, .steps = steps_new(most_steps(lens), arena)};
    size_t *begin = ARENA_ARRAY(arena, count + 2, size_t);
    for (size_t place = 0; place < count; place++) {
        begin[place] = writing.count;
        writer_put_surface(&writing, place);
    }
    system->places = count;
    if (!isnan(options->image)) {
        begin[system->places++] = writing.count;
        writer_put_image(&writing);
    }
    begin[system->places] = writing.count;
    system->steps = writing.steps;
    system->begin = begin;
    return true;
}
