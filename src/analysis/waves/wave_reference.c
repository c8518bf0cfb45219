/* analysis/waves/wave_reference.c - the wave fronts of a field, and what they are compared with. */
/* SPDX-License-Identifier: MIT */
#include "analysis/waves/wave_reference.h"

#include "analysis/rays/spot.h"

#include <math.h>
#include <string.h>

static const double centroid_error = 1e-7;

bool wave_open(const struct bundle_question *bundle, struct arena *arena,
               struct wave_lights *lights, struct error *error)
{
    const struct setup *setup = bundle->setup;
    *lights = (struct wave_lights){.count = setup->wavelength_count};
    lights->list = ARENA_ARRAY(arena, lights->count, struct wave_light);
    struct aim_near *near = ARENA_NEW(arena, struct aim_near);
    for (size_t g = 0; g < lights->count; g++) {
        struct wave_light *light = &lights->list[g];
        const unsigned which = SETUP_PATH | SETUP_IMAGE;
        *light = (struct wave_light){.question = *bundle};
        light->question.wavelength = g;
        light->question.near = near;
        light->weight = setup->wavelengths[g].weight;
        light->wavelength = setup->wavelengths[g].wavelength;
        if (!bundle_open(&light->question, arena, &light->source, error)) {
            return false;
        }
        light->open = setup_system(setup, g, which, error);
        light->system =
            bundle->clip ? setup_system(setup, g, which | SETUP_CLIPPED, error) : light->open;
        if (light->open == NULL || light->system == NULL) {
            return false;
        }
        light->source.through = light->system;
        light->chief = wave_light_trace(light->open, &light->source.chief, arena);
        if (light->chief.status != RAY_OK) {
            return fail(error, ERROR_DOMAIN, "the chief ray is lost at surface %zu (%s)",
                        light->chief.surface, ray_status_name(light->chief.status));
        }
    }
    return true;
}

/* From the chief ray to the centroid, mm or sines. */
static bool wave_reference_find_centroid(const struct wave_lights *lights, struct arena *arena,
                                         struct wave_reference *reference, struct error *error)
{
    const struct wave_light *first = &lights->list[0];
    struct spot_question asked = {
        .bundle = first->question, .error = centroid_error, .no_radius = true, .energy = NAN};
    struct spot spot;
    asked.bundle.pattern = PATTERN_GAUSS;
    if (!spot_find(&asked, arena, &spot, error)) {
        return false;
    }
    for (int i = 0; i < 2; i++) {
        reference->at[i] = spot.centroid[i] - (spot.is_angular ? 0 : first->chief.point[i]);
    }
    /* tilt by the sine of a ray's angle, whose root mean square is half of the widest */
    const double wavelength = first->wavelength / 1000;
    reference->doubt =
        spot.is_angular ? 0 : 0.5 * first->open->index_last * spot.error / wavelength;
    return true;
}

/* The plane wave across the direction that is `off` from the chief ray. */
static bool set_plane(const struct wave_light *light, double pupil,
                      struct wave_reference *reference, struct error *error)
{
    struct ray towards = light->chief;
    const double *off = reference->at;
    double rest = sqrt(1 - off[0] * off[0] - off[1] * off[1]);
    spot_axes(light->chief.cosine, reference->across);
    for (int i = 0; i < 3; i++) {
        towards.cosine[i] = rest * light->chief.cosine[i] + off[0] * reference->across[0][i] +
                            off[1] * reference->across[1][i];
    }
    return opd_plane(&towards, pupil, light->open->index_last, &reference->opd, error);
}

/* Where the exit pupil of the first wavelength lies, in the frame of the image plane. */
static bool wave_reference_find_pupil(const struct setup *setup, double *pupil, struct error *error)
{
    struct setup_light light;
    if (!setup_light(setup, 0, &light, error)) {
        return false;
    }
    *pupil = light.first.exit_pupil - (isnan(setup->image) ? 0 : setup->image);
    return true;
}

/* Its equation says where rays go, but not how long their way is. */
static bool has_thick(const struct lens *lens)
{
    bool found = false;
    for (size_t i = 0; i < lens->surface_count; i++) {
        found = found || lens->surfaces[i].kind == SURFACE_THICK;
    }
    return found;
}

bool wave_reference_find(const struct wave_lights *lights, enum wave_about about,
                         struct arena *arena, struct wave_reference *reference, struct error *error)
{
    const struct wave_light *first = &lights->list[0];
    const struct setup *setup = first->question.setup;
    const double n = first->open->index_last;
    double pupil;
    *reference = (struct wave_reference){.is_angular = isnan(setup->image)};
    if (reference->is_angular && about == WAVE_BEST) {
        return fail(error, ERROR_DOMAIN,
                    "the image lies infinitely far away: no sphere fits its wave front, but the "
                    "chief ray and the centroid are references");
    }
    if (!wave_reference_find_pupil(setup, &pupil, error) ||
        (about == WAVE_CENTROID &&
         !wave_reference_find_centroid(lights, arena, reference, error))) {
        return false;
    }
    reference->centre[0] = first->chief.point[0] + reference->at[0];
    reference->centre[1] = first->chief.point[1] + reference->at[1];
    if (has_thick(setup->lens)) {
        reference->no_opd = "an ideal thick lens has no optical path";
        return about != WAVE_BEST || fail(error, ERROR_DOMAIN, "%s", reference->no_opd);
    }
    bool found = reference->is_angular ? set_plane(first, pupil, reference, error)
                                       : opd_sphere(&first->chief, pupil, n, reference->centre,
                                                    &reference->opd, error);
    if (about == WAVE_BEST) {
        if (!found ||
            !wave_sphere_fit(lights, pupil, arena, &reference->opd, &reference->doubt, error)) {
            return false;
        }
        memcpy(reference->centre, reference->opd.centre, sizeof reference->centre);
    }
    if (!found) { /* that there is none is no error, but said */
        reference->no_opd = arena_printf(arena, "%s", error->message);
        error->code = ERROR_NONE;
    }
    return true;
}

/* The direction from the axis to the field point, as the pupil has it. */
void wave_section(const struct field_point *field, double along[2])
{
    double x = field->value[0], y = field->value[1];
    if (field->kind == FIELD_ANGLE && x != 0 && y != 0) {
        x = tan(x);
        y = tan(y);
    }
    double size = hypot(x, y);
    bool axis = field->kind == FIELD_NONE || !(size > 0);
    double sign = y < 0 || (!(y > 0) && x < 0) ? -1 : 1;
    along[0] = axis ? 0 : sign * x / size;
    along[1] = axis ? 1 : sign * y / size;
}
