/* analysis/waves/wave_reference.c - the wave fronts of a field, and what they are compared with. */
/* SPDX-License-Identifier: MIT */
#include "analysis/waves/wave_reference.h"

#include "analysis/pupil/quadrature.h"
#include "analysis/rays/spot.h"
#include "base/linear.h"
#include "trace/dispatch.h"

#include <math.h>
#include <string.h>

enum { FIRST_RAYS = 300, MOST_RAYS = 1 << 15, STEPS = 50, UNKNOWNS = 3 };

/*
 * Root mean squares of what changes of the wave front, wavelengths: a step that changes less is the
 * last one, for which rounding of long ways may leave too much; so much the last of all steps, and
 * twice the rays, may change.
 */
static const double still = 1e-9, settled = 1e-6, alike = 1e-6;

/* Rays that arrive, and what each counts. */
struct sheaf {
    struct ray *rays;
    double *weights; /* their roots, over the wavelength */
    size_t *lights;
    size_t count;
    double total; /* sum of the weights themselves */
};

double wave_light_weight(const struct wave_light *light)
{
    const struct stop_beam *beam = &light->source.pupil;
    const double *axes = beam->axes;
    return light->weight * (beam->has_disc ? 1 : fabs(axes[0] * axes[3] - axes[1] * axes[2]));
}

struct ray wave_light_trace(const struct system *system, const struct ray *start,
                            struct arena *arena)
{
    const struct arena_mark mark = arena_mark(arena);
    struct rays one = rays_new(arena, 1);
    rays_set(&one, 0, system->index_first, start);
    rays_trace(system, &one, NULL);
    const struct ray end = rays_get(&one, 0, system->index_last);
    arena_reset(arena, mark);
    return end;
}

static bool sheaf_fill(const struct wave_lights *lights, struct quadrature_region *regions,
                       size_t rays, struct arena *arena, struct sheaf *sheaf, struct error *error)
{
    struct quadrature *all = ARENA_ARRAY(arena, lights->count, struct quadrature);
    size_t room = 1;
    for (size_t g = 0; g < lights->count; g++) {
        all[g] = quadrature_fill(&regions[g], rays, arena);
        room += all[g].is_empty ? 0 : all[g].sample.count;
    }
    *sheaf = (struct sheaf){.rays = ARENA_ARRAY(arena, room, struct ray),
                            .weights = ARENA_ARRAY(arena, room, double),
                            .lights = ARENA_ARRAY(arena, room, size_t)};
    for (size_t g = 0; g < lights->count; g++) {
        if (!all[g].is_empty) {
            const struct wave_light *light = &lights->list[g];
            rays_trace(light->system, &all[g].rays, NULL);
            for (size_t i = 0; i < all[g].sample.count; i++) {
                struct ray ray = rays_get(&all[g].rays, i, light->system->index_last);
                double weight = light->weight * all[g].sample.points[i].weight;
                if (ray.status == RAY_OK && weight > 0) {
                    sheaf->rays[sheaf->count] = ray;
                    sheaf->weights[sheaf->count] = sqrt(weight) / light->wavelength;
                    sheaf->lights[sheaf->count++] = g;
                    sheaf->total += weight;
                }
            }
        }
    }
    return sheaf->count > UNKNOWNS + lights->count ||
           fail(error, ERROR_DOMAIN, "no ray arrives: there is no wave front to fit");
}

/*
 * What a step changes of the wave fronts, root mean square in wavelengths: about what it changes of
 * the chief ray's, which is no less than about their means.
 */
static double sheaf_change(const struct sheaf *sheaf, const struct ray *chief,
                           const struct opd_reference *reference, const double move[3])
{
    double sum = 0, middle[3];
    opd_path_by_centre(reference, chief, middle);
    for (size_t i = 0; i < sheaf->count; i++) {
        double slope[3], off = 0;
        opd_path_by_centre(reference, &sheaf->rays[i], slope);
        for (int k = 0; k < UNKNOWNS; k++) {
            off += (slope[k] - middle[k]) * move[k];
        }
        sum += pow(sheaf->weights[i] * off, 2);
    }
    return sqrt(sum / sheaf->total);
}

/*
 * W = W0 - C.(slope of the path), and a piston for each wavelength, in wavelengths and by the roots
 * of the weights: the least squares of a row [slope, pistons] = W0 for each ray.
 */
static bool sheaf_step(const struct sheaf *sheaf, size_t lights,
                       const struct opd_reference *reference, struct arena *arena, double move[3])
{
    const struct arena_mark mark = arena_mark(arena);
    size_t columns = UNKNOWNS + lights;
    double *a = ARENA_ARRAY(arena, sheaf->count * columns, double);
    double *b = ARENA_ARRAY(arena, sheaf->count, double);
    double *x = ARENA_ARRAY(arena, columns, double);
    bool found = true;
    for (size_t i = 0; i < sheaf->count; i++) {
        double *row = a + i * columns, weight = sheaf->weights[i], slope[UNKNOWNS];
        opd_path_by_centre(reference, &sheaf->rays[i], slope);
        for (size_t k = 0; k < columns; k++) {
            row[k] = k < UNKNOWNS ? weight * slope[k] : 0;
        }
        row[UNKNOWNS + sheaf->lights[i]] = weight;
        b[i] = -weight * opd_path(reference, &sheaf->rays[i]);
        found = found && isfinite(b[i]) && isfinite(slope[0] + slope[1] + slope[2]);
    }
    if (found) {
        const struct linear_factors factors = linear_factor(a, sheaf->count, columns, 1e-12, arena);
        linear_solve(&factors, b, x);
        for (size_t k = 0; k < UNKNOWNS; k++) {
            move[k] = x[k];
        }
    }
    arena_reset(arena, mark);
    return found;
}

/* Gauss's and Newton's steps to the sphere that fits these rays; gives what the first changed. */
static bool sheaf_fit(const struct sheaf *sheaf, const struct wave_lights *lights, double pupil,
                      struct arena *arena, struct opd_reference *reference, double *changed,
                      struct error *error)
{
    const struct wave_light *first = &lights->list[0];
    double change = INFINITY;
    for (int i = 0; i < STEPS && change > still; i++) {
        double move[UNKNOWNS];
        if (!sheaf_step(sheaf, lights->count, reference, arena, move)) {
            return fail(error, ERROR_DOMAIN, "no sphere fits the wave front");
        }
        change = sheaf_change(sheaf, &first->chief, reference, move);
        *changed = i == 0 ? change : *changed;
        double centre[3];
        for (int k = 0; k < UNKNOWNS; k++) {
            centre[k] = reference->centre[k] + move[k];
            /* what rounding leaves of a symmetry */
            centre[k] = fabs(centre[k]) < 1e-15 * fmin(reference->radius, 1e6) ? 0 : centre[k];
        }
        if (!opd_sphere(&first->chief, pupil, reference->n, centre, reference, error)) {
            return false;
        }
    }
    return change <= settled ||
           fail(error, ERROR_DOMAIN,
                "the sphere that fits the wave front best is not found in %d steps", STEPS);
}

/*
 * The reference sphere that fits the wave fronts best.
 *
 * Given     pupil      z of the exit pupil, as opd_sphere has it
 *           reference  a sphere about the chief ray; receives the best
 *           doubt      receives what the last doubling of rays changes of W (root mean square,
 *                      wavelengths)
 * Formula   the centre C that makes sum w ((W - mean W)/wavelength)^2 smallest, the mean that of
 *           each wavelength: steps of Gauss and Newton, dW/dC by opd_path_by_centre, until one
 *           changes W by less than 1e-9 wavelengths (root mean square); rays are doubled until that
 *           changes less than 1e-6
 * Errors    ERROR_DOMAIN: no ray arrives; 50 steps do not get to a change of 1e-6 wavelengths
 * Limits    2^15 rays of a wavelength
 */
static bool wave_sphere_fit(const struct wave_lights *lights, double pupil, struct arena *arena,
                            struct opd_reference *reference, double *doubt, struct error *error)
{
    /* the clear parts of all wavelengths, found once */
    struct quadrature_region *regions = ARENA_ARRAY(arena, lights->count, struct quadrature_region);
    for (size_t g = 0; g < lights->count; g++) {
        regions[g] = quadrature_open(&lights->list[g].source.pupil, arena);
    }
    *doubt = INFINITY;
    for (size_t rays = FIRST_RAYS; rays <= MOST_RAYS && *doubt > alike; rays *= 2) {
        const struct arena_mark mark = arena_mark(arena);
        struct sheaf sheaf;
        if (!sheaf_fill(lights, regions, rays, arena, &sheaf, error) ||
            !sheaf_fit(&sheaf, lights, pupil, arena, reference, doubt, error)) {
            return false;
        }
        arena_reset(arena, mark);
    }
    return true;
}

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
static bool find_centroid(const struct wave_lights *lights, struct arena *arena,
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
    /* where the exit pupil of the first wavelength lies, in the frame of the image plane */
    struct setup_light light;
    if (!setup_light(setup, 0, &light, error)) {
        return false;
    }
    pupil = light.first.exit_pupil - (isnan(setup->image) ? 0 : setup->image);
    if (about == WAVE_CENTROID && !find_centroid(lights, arena, reference, error)) {
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
