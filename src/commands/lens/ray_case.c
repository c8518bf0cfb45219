/* commands/lens/ray_case.c - a lens made ready for exact rays. */
/* SPDX-License-Identifier: MIT */
#include "commands/lens/ray_case.h"

const struct system *ray_case_system(const struct ray_case *one, struct error *error)
{
    unsigned which = SETUP_PATH;
    which |= one->clip ? SETUP_CLIPPED : 0;
    which |= one->to_image ? SETUP_IMAGE : 0;
    return setup_system(&one->setup, 0, which, error);
}

static bool set_target(const struct target_value *to, struct ray_case *one, struct arena *arena,
                       struct error *error)
{
    size_t count = one->setup.lens->surface_count;
    one->surfaces = count;
    one->to_image =
        to->kind == TARGET_IMAGE || (to->kind == TARGET_USUAL && !isnan(one->setup.image));
    if (to->kind == TARGET_IMAGE && isnan(one->setup.image)) {
        fail(error, ERROR_DOMAIN, "{--to} image: the image is infinitely far away");
        return error_hint(error, "{--to} last, or {--focus} with a number of mm");
    }
    if (to->kind == TARGET_USUAL && isnan(one->setup.image)) {
        one->warning = lens_warnings_join(
            one->warning, "the image is infinitely far away: rays end at the last surface", arena);
    }
    if (to->kind == TARGET_SURFACE) {
        one->surfaces = (size_t)to->surface;
    }
    return one->surfaces <= count ||
           fail(error, ERROR_USAGE, "{--to} %ld: the lens has %zu surfaces", to->surface, count);
}

bool ray_case_open(const struct ray_question *question, const struct ray_choice *choice,
                   struct arena *arena, struct ray_case *one, struct error *error)
{
    const struct setup_question asked = {
        .lens = question->lens.lens,
        .position = choice->position,
        .wavelength = choice->wavelength,
        .wavelengths = WAVELENGTHS_PRIMARY,
        .fnumber = question->fnumber,
        .fields = choice->field,
        .field_count = choice->field != NULL ? 1 : 0,
        .field_policy = FIELDS_ALL,
        .takes_telecentric = true,
    };
    if (question->clip && question->no_clip) {
        return fail(error, ERROR_USAGE, "{--clip} and {--no-clip} exclude each other");
    }
    if (!isnan(question->fnumber) && question->lens.lens->stop == LENS_NONE) {
        fail(error, ERROR_DOMAIN, "{--aperture}: the lens has no stop");
        return lens_hint_stop(error);
    }
    *one = (struct ray_case){.clip = !question->no_clip};
    if (!setup_open(&asked, arena, &one->setup, error) ||
        !lens_place_image(&one->setup, &question->focus, error)) {
        return false;
    }
    one->warning = lens_warnings_join(question->lens.warning, one->setup.warning, arena);
    if (one->clip) {
        one->warning = lens_warnings_join(
            one->warning, setup_width_warning(&one->setup, question->fnumber, arena), arena);
    }
    return set_target(&question->to, one, arena, error);
}
