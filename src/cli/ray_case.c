/* cli/ray_case.c - a lens made ready for exact rays. */
/* SPDX-License-Identifier: MIT */
#include "commands/lens/ray_case.h"

#include "cli/image_plane.h"

bool ray_case_compile(const struct ray_case *one, double wavelength, bool clip, bool image,
                      struct arena *arena, struct system *system, struct error *error)
{
    struct system_options options = system_options_default();
    options.clip = clip;
    options.path = true;
    options.stop_radius = one->stop_radius;
    options.image = image ? one->image : (double)NAN;
    return system_compile(one->lens, wavelength, &options, arena, system, error);
}

static bool set_plane(const struct plane_value *focus, struct ray_case *one, struct arena *arena,
                      struct error *error)
{
    struct image_plane plane;
    if (!image_plane_find(focus, one->lens, &one->first, one->stop_radius, arena, &plane, error)) {
        return false;
    }
    one->image = plane.z;
    one->focus = plane.focus;
    one->warning = lens_warnings_join(one->warning, plane.warning, arena);
    return true;
}

static bool set_target(const struct target_value *to, struct ray_case *one, struct arena *arena,
                       struct error *error)
{
    size_t count = one->lens->surface_count;
    one->surfaces = count;
    one->to_image = to->kind == TARGET_IMAGE || (to->kind == TARGET_USUAL && !isnan(one->image));
    if (to->kind == TARGET_IMAGE && isnan(one->image)) {
        fail(error, ERROR_DOMAIN, "--to image: the image is infinitely far away");
        return error_hint(error, "--to last, or --focus with a number of mm");
    }
    if (to->kind == TARGET_USUAL && isnan(one->image)) {
        one->warning = lens_warnings_join(
            one->warning, "the image is infinitely far away: rays end at the last surface", arena);
    }
    if (to->kind == TARGET_SURFACE) {
        one->surfaces = (size_t)to->surface;
    }
    return one->surfaces <= count ||
           fail(error, ERROR_USAGE, "--to %ld: the lens has %zu surfaces", to->surface, count);
}

/* The f-number that is asked for makes a stop of its own. */
static bool set_stop(const struct ray_question *question, struct ray_case *one, struct error *error)
{
    struct aperture_setting aperture = lens_aperture(one->lens);
    bool asked = !isnan(question->fnumber);
    one->stop_radius = NAN;
    if (asked) {
        aperture = (struct aperture_setting){APERTURE_FNUMBER, question->fnumber};
    }
    if (asked && one->lens->stop == LENS_NONE) {
        return fail(error, ERROR_DOMAIN, "--aperture: the lens has no stop");
    }
    if (!first_order_aperture(&one->first, &one->object, &aperture, FIELD_NONE, NAN, error)) {
        return false;
    }
    one->stop_radius = asked ? fabs(one->first.stop_radius) : (double)NAN;
    return true;
}

bool ray_positions(const struct ray_question *question, struct arena *arena,
                   const size_t **positions, size_t *count, struct error *error)
{
    if (question->lens.lens == NULL) {
        fail(error, ERROR_USAGE, "no lens is given");
        return error_hint(error, "a name of 'lenscalc list lenses', or a .lens file");
    }
    return lens_positions(question->lens.lens, question->position, arena, positions, count, error);
}

bool ray_case_open(const struct ray_question *question, size_t position, struct arena *arena,
                   struct ray_case *one, struct error *error)
{
    const struct lens *all = question->lens.lens;
    if (question->clip && question->no_clip) {
        return fail(error, ERROR_USAGE, "--clip and --no-clip exclude each other");
    }
    *one = (struct ray_case){
        .lens = lens_at_position(all, position, arena),
        .position = all->position_count > 0 ? all->positions[position] : NULL,
        .warning = question->lens.warning,
        .clip = !question->no_clip,
    };
    one->object = lens_object(one->lens);
    return first_order_of_lens(one->lens, lens_primary_wavelength(one->lens), SECTION_Y, arena,
                               &one->first, error) &&
           set_stop(question, one, error) && set_plane(&question->focus, one, arena, error) &&
           set_target(&question->to, one, arena, error);
}
