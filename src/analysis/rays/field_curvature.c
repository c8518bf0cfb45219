/* analysis/rays/field_curvature.c - foci along the chief ray of a field. */
/* SPDX-License-Identifier: MIT */
#include "analysis/rays/field_curvature.h"

#include "trace/aim/aim.h"
#include "trace/dispatch.h"

#include <float.h>
#include <math.h>

/* What is nothing but rounding in a lens of that size is 0. */
static double field_rounded(double value, double size)
{
    return fabs(value) <= 16 * DBL_EPSILON * size ? 0 : value;
}

static void field_curvature_measure(const struct setup *setup, const struct setup_light *light,
                                    double n, struct field_curvature *curvature)
{
    const struct narrow_beam *beam = &curvature->beam;
    const struct ray *chief = &beam->chief;
    const double image = setup->image, to_image = (image - chief->point[2]) / chief->cosine[2];
    const double size = fabs(image) + fabs(light->first.length);
    double sum = 0;
    for (int i = 0; i < 2; i++) {
        curvature->height[i] = field_rounded(chief->point[i] + to_image * chief->cosine[i], size);
        sum += curvature->height[i] * curvature->height[i];
    }
    curvature->tangential = field_rounded(beam->tangential_z - image, size);
    curvature->sagittal = field_rounded(beam->sagittal_z - image, size);
    const bool both = isfinite(curvature->tangential) && isfinite(curvature->sagittal);
    curvature->medial = both ? (curvature->tangential + curvature->sagittal) / 2 : (double)NAN;
    curvature->astigmatism = both ? curvature->tangential - curvature->sagittal : (double)NAN;
    curvature->petzval = light->first.image - image + sum / (2 * light->first.petzval_radius);
    curvature->petzval = isfinite(curvature->petzval) ? curvature->petzval : (double)NAN;
    /* as an eye sees it behind an eyepiece */
    const double pupil = light->first.exit_pupil, plane = isfinite(pupil) ? pupil : 0;
    const double from = (plane - chief->point[2]) / chief->cosine[2];
    curvature->tangential_power = 1000 * n / (beam->tangential - from);
    curvature->sagittal_power = 1000 * n / (beam->sagittal - from);
}

static bool field_curvature_look(const struct setup *setup, size_t wavelength,
                                 const struct field_point *field, struct field_curvature *curvature,
                                 struct error *error)
{
    /* a chief ray goes through the centre of the stop, however wide that is */
    struct setup own =
        setup_at_wavelength(setup, setup->wavelengths[wavelength].wavelength, setup->arena);
    struct setup_light light;
    struct beam beam;
    double at[2];
    own.first.stop_radius = own.first.stop_radius > 0 ? own.first.stop_radius : 1;
    const struct system *open = setup_system(&own, 0, SETUP_OPEN, error);
    const struct system *clipped =
        open != NULL ? setup_system(&own, 0, SETUP_CLIPPED, error) : NULL;
    *curvature = (struct field_curvature){.status = RAY_OK};
    const bool has_stop = !own.first.is_telecentric;
    struct aim aim;
    struct ray start;
    if (clipped == NULL || !setup_light(setup, wavelength, &light, error) ||
        !setup_beam(setup, field, &beam, error) ||
        !(has_stop ? aim_open(open, &beam, setup->arena, &aim, error)
                   : aim_at_entrance(&beam, &own.first, 0, 0, &start, error))) {
        return false;
    }
    if (has_stop) {
        at[0] = aim.chief[0];
        at[1] = aim.chief[1];
    } else {
        beam_place(&beam, start.point, at);
    }
    if (!coddington_foci(open, &beam, at, setup->arena, &curvature->beam)) {
        const struct ray *chief = &curvature->beam.chief;
        return fail(error, ERROR_DOMAIN, "the chief ray is lost at surface %zu: %s", chief->surface,
                    ray_status_name(chief->status));
    }
    /* What apertures say to the ray, which goes on all the same. */
    const struct rays rays = rays_new(own.arena, 1);
    start = beam_ray(&beam, at[0], at[1]);
    rays_set(&rays, 0, beam.n, &start);
    rays_trace(clipped, &rays, NULL);
    curvature->status = ray_block_status(rays.blocks, 0);
    curvature->surface = ray_block_surface(rays.blocks, 0);
    field_curvature_measure(setup, &light, open->index_last, curvature);
    return true;
}

bool field_curvature(const struct setup *setup, size_t wavelength, const struct field_point *field,
                     struct field_curvature *curvature, struct error *error)
{
    const struct arena_mark mark = arena_mark(setup->arena);
    const bool found = field_curvature_look(setup, wavelength, field, curvature, error);
    arena_reset(setup->arena, mark);
    return found;
}
