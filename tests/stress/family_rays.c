/* tests/stress/family_rays.c - exact rays, their derivatives and optical paths in 113 bits. */
/* SPDX-License-Identifier: MIT */
#include "quad_ray.h"

#include "analysis/waves/opd.h"
#include "base/constants.h"
#include "file/lens_file.h"
#include "trace/aim/beam.h"
#include "trace/derivative.h"
#include "trace/dispatch.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* A lens and one ray of it, on both sides. */
struct ray_trial {
    struct drawn_lens drawn;
    struct quad_lens numbers; /* with the image plane as a last surface, if there is one */
    struct lens lens;
    struct system system;
    double height; /* of what is about the axis, mm */
};

enum { KINDS = 9, BENT = 9 };
static struct drawn_scale scale_of_kind(struct trial *trial, int kind)
{
    const double size = trial_chance(trial, 0.4) ? trial_magnitude(trial, 1e-6, 1e6) : 1;
    struct drawn_scale scale = {.least = 1,
                                .most = 10,
                                .radius = {20 * size, 1000 * size},
                                .thickness = {0.1 * size, 20 * size},
                                .index = {1, 2.2},
                                .object = {30 * size, 1e5 * size},
                                .planes = 0.1,
                                .air = 0.4,
                                .far = 0.4,
                                .height = 10 * size,
                                .folds = true};
    switch (kind) {
    case 0: /* all sizes */
        scale.most = 4;
        scale.radius[0] = 1e-3;
        scale.radius[1] = 1e9;
        scale.thickness[0] = 1e-6;
        scale.thickness[1] = 1e4;
        scale.index[1] = 4;
        scale.object[0] = 1e-3;
        scale.object[1] = 1e15;
        scale.conics = 0.3;
        scale.height = trial_magnitude(trial, 1e-4, 1e2);
        break;
    case 1: /* flat */
        scale.radius[0] = 1e5 * size;
        scale.radius[1] = 1e9 * size;
        break;
    case 2: /* far away */
        scale.object[0] = 1e9 * size;
        scale.object[1] = 1e15;
        scale.far = 0;
        break;
    case 3:
        scale.is_concentric = true;
        scale.most = 5;
        break;
    case 4:
        scale.aspheres = 0.5;
        scale.conics = 0.5;
        break;
    case 5:
        scale.tilts = 0.4;
        scale.mirrors = 0.1;
        scale.aspheres = 0.1;
        break;
    case 6:
        scale.mirrors = 0.5;
        scale.conics = 0.5;
        break;
    case 7: /* strong and wide: grazing */
        scale.radius[0] = 10 * size;
        scale.radius[1] = 20 * size;
        scale.height = 30 * size;
        scale.most = 3;
        break;
    case BENT: /* breaks of the axis, cylinders, odd aspheres */
        scale.breaks = 0.3;
        scale.cylinders = 0.3;
        scale.odd = 0.3;
        scale.conics = 0.3;
        scale.aspheres = 0.1;
        scale.tilts = 0.1;
        scale.mirrors = 0.1;
        break;
    default:
        scale.conics = 0.1;
        scale.index[1] = 4;
        break;
    }
    return scale;
}

/* Draw a lens, compile it, and write it down in numbers; false: it cannot be, which is said. */
static bool ray_trial_open(struct trial *trial, struct ray_trial *one, bool is_bent,
                           bool wants_image)
{
    const struct drawn_scale scale =
        scale_of_kind(trial, is_bent ? BENT : trial_whole(trial, 0, KINDS - 1));
    struct error error = {0};
    struct system_options options = system_options_default();
    drawn_lens_draw(trial, &scale, &one->drawn);
    if (scale.is_concentric && trial_chance(trial, 0.2)) {
        drawn_lens_make_afocal(trial, &one->drawn);
    }
    one->height = scale.height;
    trial->about = drawn_lens_write(&one->drawn, &trial->arena);
    quad_lens_of(&one->drawn, &one->numbers);
    options.path = true;
    const struct quad_surface *last = &one->numbers.surfaces[one->drawn.count - 1];
    if (wants_image) {
        options.image = (double)last->t;
        one->numbers.surfaces[one->drawn.count - 1].t = (quad)options.image;
        one->numbers.surfaces[one->drawn.count] =
            (struct quad_surface){.n = last->n, .weight = {1, 1}};
        one->numbers.count++;
    }
    return trial_verdict(
        trial,
        lens_read("stress", text_of(trial->about), NULL, &trial->arena, &one->lens, &error) &&
            system_compile(&one->lens, 0.55, &options, &trial->arena, &one->system, &error),
        "%s", error.message);
}

static const char *ray_trial_say(struct trial *trial, const struct ray *ray)
{
    char *text = arena_array(&trial->arena, strlen(trial->about) + 300, 1);
    sprintf(text, "%sray %.17g %.17g %.17g cosines %.17g %.17g %.17g\n", trial->about,
            ray->point[0], ray->point[1], ray->point[2], ray->cosine[0], ray->cosine[1],
            ray->cosine[2]);
    return text;
}

static struct quad_ray quad_ray_of(const struct ray *ray)
{
    struct quad_ray start = {.path = (quad)ray->path, .n = 1, .way = 1, .margin = 1};
    quad square = 0;
    for (int i = 0; i < 3; i++) {
        start.x[i] = (quad)ray->point[i];
        start.d[i] = (quad)ray->cosine[i];
        square += start.d[i] * start.d[i];
    }
    for (int i = 0; i < 3; i++) {
        start.d[i] /= quad_root(square);
    }
    return start;
}

/* From the object, or from far away, to a place near the first vertex. */
static struct ray draw_ray(struct trial *trial, const struct ray_trial *one, double height)
{
    const double object = (double)one->numbers.object;
    const double tilt = trial_between(trial, 0, 0.4) * height / one->height;
    struct ray ray = {.point = {0}};
    double to[3] = {height * trial_between(trial, -1, 1), height * trial_between(trial, -1, 1), 0};
    double way[3] = {tilt * trial_between(trial, -1, 1), tilt * trial_between(trial, -1, 1), 1};
    if (object != 0) {
        for (int i = 0; i < 3; i++) {
            ray.point[i] = -object * way[i];
            way[i] = to[i] - ray.point[i];
        }
    } else {
        for (int i = 0; i < 3; i++) {
            ray.point[i] = to[i] - trial_between(trial, 0, 3) * height * way[2] * (i == 2);
        }
    }
    const double length = sqrt(way[0] * way[0] + way[1] * way[1] + way[2] * way[2]);
    for (int i = 0; i < 3; i++) {
        ray.cosine[i] = way[i] / length;
    }
    return ray;
}

/* -------- rays -------- */

enum { RAY_FIGURES = 8 };
static const char *const ray_names[RAY_FIGURES] = {"x", "y", "z", "L", "M", "N", "path", "margin"};

static bool ray_find(const struct quad_lens *lens, const struct quad_nudge *nudge,
                     const void *context, quad *figures)
{
    struct quad_ray ray = quad_ray_of(context);
    if (!quad_ray_trace(lens, nudge, &ray)) {
        return false;
    }
    for (int i = 0; i < 3; i++) {
        figures[i] = ray.x[i];
        figures[3 + i] = ray.d[i];
    }
    figures[6] = ray.path;
    figures[7] = (quad)ray.margin;
    return true;
}

/* One that arrives, or after some turns one that does not; false: lost. */
static bool draw_arriving(struct trial *trial, const struct ray_trial *one, struct ray *ray,
                          struct quad_ray *end)
{
    double height = one->height;
    for (int turn = 0; turn < 12; turn++) {
        *ray = draw_ray(trial, one, height);
        *end = quad_ray_of(ray);
        if (quad_ray_trace(&one->numbers, NULL, end)) {
            return true;
        }
        height *= 0.4;
    }
    return false;
}

/* How far a value is from lost, in what rounding may move it by; the size of it is a share of 1. */
static bool is_at_border(const struct quad_lens *lens, const struct quad_question *question,
                         double margin)
{
    double sums[RAY_FIGURES];
    return !quad_sensitivity(lens, question, sums) || margin < 64 * 0x1p-53 * (1 + sums[7]);
}

static void rays_try(struct trial *trial, bool is_bent)
{
    static struct ray_trial one;
    struct ray start;
    struct quad_ray end;
    if (!ray_trial_open(trial, &one, is_bent, trial_chance(trial, 0.5))) {
        return;
    }
    const bool arrives = draw_arriving(trial, &one, &start, &end);
    trial->about = ray_trial_say(trial, &start);
    const struct rays rays = rays_new(&trial->arena, 1);
    rays_set(&rays, 0, one.system.index_first, &start);
    rays_trace(&one.system, &rays, NULL);
    const struct ray actual = rays_get(&rays, 0, one.system.index_last);
    const struct quad_question question = {ray_find, &start, RAY_FIGURES, (quad)1e-17};
    if ((actual.status == RAY_OK) != arrives) {
        const bool is_open =
            arrives ? is_at_border(&one.numbers, &question, end.margin) : end.margin < 1e-6;
        trial_verdict(trial, is_open, "%s, margin %g", ray_status_name(actual.status), end.margin);
        return;
    }
    if (!arrives) {
        trial_verdict(trial, true, "lost");
        return;
    }
    quad truth[RAY_FIGURES];
    double sums[RAY_FIGURES];
    ray_find(&one.numbers, NULL, &start, truth);
    if (!quad_sensitivity(&one.numbers, &question, sums)) {
        trial_skip(trial); /* at the border */
        return;
    }
    const double values[7] = {actual.point[0],  actual.point[1],  actual.point[2], actual.cosine[0],
                              actual.cosine[1], actual.cosine[2], actual.path};
    for (int k = 0; k < 7; k++) {
        const double off = (double)quad_size((quad)values[k] - truth[k]);
        trial_figure(trial, ray_names[k], off, (double)quad_size(truth[k]), sums[k]);
    }
}

void try_rays(struct trial *trial)
{
    rays_try(trial, false);
}

void try_bent_rays(struct trial *trial)
{
    rays_try(trial, true);
}

/* -------- derivatives -------- */

enum { OUTPUTS = 5 };
static const char *const output_names[OUTPUTS] = {"x", "y", "p", "q", "path"};
struct derivative_of {
    const struct ray *start;
    size_t number; /* of the lens */
    quad step;
};

static bool derivative_find(const struct quad_lens *lens, const struct quad_nudge *nudge,
                            const void *context, quad *figures)
{
    static struct quad_lens moved;
    const struct derivative_of *by = context;
    moved.count = lens->count;
    memcpy(moved.surfaces, lens->surfaces, lens->count * sizeof lens->surfaces[0]);
    for (int side = 1; side >= -1; side -= 2) {
        struct quad_ray ray = quad_ray_of(by->start);
        *quad_lens_number(&moved, by->number) =
            lens->surfaces[by->number / QUAD_NUMBERS].number[by->number % QUAD_NUMBERS] +
            side * by->step;
        if (!quad_ray_trace(&moved, nudge, &ray)) {
            return false;
        }
        const quad ends[OUTPUTS] = {ray.x[0], ray.x[1], ray.n * ray.d[0], ray.n * ray.d[1],
                                    ray.path};
        for (int k = 0; k < OUTPUTS; k++) {
            figures[k] = side > 0 ? ends[k] : (figures[k] - ends[k]) / (2 * by->step);
        }
    }
    return true;
}

/* Each number of a quad_surface that derivatives are taken by, the first of which round lenses and
   tilted ones have: as the program knows it, and a size it is moved in parts of. */
enum { PLAIN_PARAMETERS = 10, ALL_PARAMETERS = 12, NUMBER_A3 = 10, NUMBER_A5 = 11 };
static struct parameter parameter_of(size_t number, double height, quad *size)
{
    static const enum parameter_kind kinds[ALL_PARAMETERS] = {
        PARAMETER_CURVATURE,   PARAMETER_THICKNESS,   PARAMETER_INDEX,       PARAMETER_CONIC,
        PARAMETER_COEFFICIENT, PARAMETER_COEFFICIENT, PARAMETER_DECENTER_X,  PARAMETER_DECENTER_Y,
        PARAMETER_TILT_X,      PARAMETER_TILT_Y,      PARAMETER_COEFFICIENT, PARAMETER_COEFFICIENT};
    static const int orders[ALL_PARAMETERS] = {[4] = 4, [5] = 6, [NUMBER_A3] = 3, [NUMBER_A5] = 5};
    const size_t which = number % QUAD_NUMBERS;
    const quad h = (quad)height;
    const quad sizes[ALL_PARAMETERS] = {1 / h, h, 1, 1, 1 / (h * h * h), 1 / (h * h * h * h * h),
                                        h,     h, 1, 1, 1 / (h * h),     1 / (h * h * h * h)};
    *size = sizes[which];
    return (struct parameter){number / QUAD_NUMBERS, kinds[which], orders[which]};
}

/* How far from the axis the ray meets a surface; across: by what a cylinder is curved along. */
static double radius_at(const struct ray_trial *one, const struct ray *start, size_t surface,
                        double *across)
{
    static struct quad_lens front;
    struct quad_ray ray = quad_ray_of(start);
    const quad *w = one->numbers.surfaces[surface].weight;
    front = one->numbers;
    front.count = surface + 1;
    (void)quad_ray_trace(&front, NULL, &ray);
    *across = hypot((double)(w[0] * ray.x[0]), (double)(w[1] * ray.x[1]));
    return hypot((double)ray.x[0], (double)ray.x[1]);
}

/* All outputs by one parameter; NaN where there is no such derivative. */
static bool derive(struct trial *trial, const struct ray_trial *one, const struct ray *start,
                   struct parameter parameter, double values[OUTPUTS])
{
    struct derivative_layout layout;
    struct derivative_tape tape = derivative_tape_new(&one->system, &trial->arena);
    const struct rays rays = rays_new(&trial->arena, 1);
    derivative_layout(&one->system, DERIVE_CONIC | DERIVE_SERIES | DERIVE_DISPLACEMENT,
                      &trial->arena, &layout);
    rays_set(&rays, 0, one->system.index_first, start);
    const enum instruction_set set = (enum instruction_set)trial_whole(trial, 0, 2);
    const enum instruction_set best = instruction_set_works(set) ? set : SET_SSE2;
    const struct ray_block *end = derivative_trace(&one->system, rays.blocks, best, &tape);
    const size_t row = derivative_row(&layout, parameter);
    double *gradient = ARENA_ARRAY(&trial->arena, layout.rows * RAYS_BLOCK, double);
    const struct rays adjoints = rays_new(&trial->arena, 1);
    struct ray_block *adjoint = adjoints.blocks;
    if (end->lost[0] != 0 || row == LENS_NONE) {
        return false;
    }
    for (int k = 0; k < OUTPUTS; k++) {
        memset(adjoint, 0, sizeof *adjoint);
        double *members[OUTPUTS] = {adjoint->x, adjoint->y, adjoint->p, adjoint->q, adjoint->path};
        for (int i = 0; i < RAYS_BLOCK; i++) {
            members[k][i] = 1;
        }
        derivative_sweep(&one->system, &layout, best, &tape, adjoint, gradient);
        values[k] = gradient[row * RAYS_BLOCK];
    }
    return true;
}

/*
 * How the normal (-G x, -G y, f) moves that a sweep writes down, times what it is bent by. A path
 * says nothing of the lengths of directions and normals, but is swept back through them.
 */
static double sweep_share(const struct ray_trial *one, size_t number, double r)
{
    const struct quad_lens *front = &one->numbers;
    const size_t i = number / QUAD_NUMBERS;
    const double before = i > 0 ? (double)front->surfaces[i - 1].n : 1;
    const double by[QUAD_NUMBERS] = {[3] = pow((double)front->surfaces[i].c * r, 2),
                                     [4] = 4 * pow(r, 3),
                                     [5] = 6 * pow(r, 5),
                                     [NUMBER_A3] = 3 * pow(r, 2),
                                     [NUMBER_A5] = 5 * pow(r, 4)};
    const double bend = front->surfaces[i].reflects ? 2 : (double)front->surfaces[i].n - before;
    return fabs(bend) * by[number % QUAD_NUMBERS];
}

static void derivatives_try(struct trial *trial, bool is_bent)
{
    static struct ray_trial one;
    struct ray start;
    struct quad_ray end;
    quad size;
    if (!ray_trial_open(trial, &one, is_bent, true)) {
        return;
    }
    if (!draw_arriving(trial, &one, &start, &end)) {
        trial_skip(trial);
        return;
    }
    const int each = is_bent ? ALL_PARAMETERS : PLAIN_PARAMETERS;
    const int drawn = trial_whole(trial, 0, each * (int)one.drawn.count - 1);
    const size_t number = (size_t)(QUAD_NUMBERS * (drawn / each) + drawn % each);
    double across;
    const double r = radius_at(&one, &start, number / QUAD_NUMBERS, &across);
    const struct parameter parameter = parameter_of(number, fmax(r, one.height), &size);
    const struct quad_surface *surface = &one.numbers.surfaces[parameter.surface];
    const bool is_mirrored = surface->reflects || surface[1].reflects;
    const bool is_odd = parameter.order % 2 != 0; /* only of surfaces that have such */
    if ((parameter.kind == PARAMETER_INDEX && is_mirrored) ||
        (is_odd && surface->number[number % QUAD_NUMBERS] == 0)) {
        trial_skip(trial); /* mirrors take the index before them along */
        return;
    }
    const char *about = ray_trial_say(trial, &start);
    char *text = arena_array(&trial->arena, strlen(about) + 60, 1);
    sprintf(text, "%sby %s\n", about, parameter_write(parameter, &trial->arena));
    trial->about = text;
    const struct derivative_of by = {&start, number, size * (quad)1e-10};
    const struct derivative_of other = {&start, number, size * (quad)3e-10};
    const bool is_far = one.numbers.object > (quad)1e8; /* and moves by as much */
    const quad step = is_far ? (quad)1e-14 : (quad)1e-9;
    const struct quad_question question = {derivative_find, &by, OUTPUTS, step};
    quad truth[OUTPUTS], again[OUTPUTS];
    double values[OUTPUTS], sums[OUTPUTS];
    if (!derivative_find(&one.numbers, NULL, &by, truth) ||
        !derivative_find(&one.numbers, NULL, &other, again) ||
        !quad_sensitivity(&one.numbers, &question, sums)) {
        trial_skip(trial); /* at the border */
        return;
    }
    if (!trial_verdict(trial, derive(trial, &one, &start, parameter, values), "no derivative")) {
        return;
    }
    sums[4] += sweep_share(&one, number, r) * (double)end.length;
    if (parameter.kind == PARAMETER_CONIC && across < r) {
        /* goes by the square of a sag, which a cylinder's ray has beside a way along it */
        const double sag = (double)quad_size(surface->c) * across * across / 2;
        for (int k = 0; k < OUTPUTS; k++) {
            sums[k] += 2 * r / sag * (double)quad_size(truth[k]);
        }
    }
    for (int k = 0; k < OUTPUTS; k++) {
        const double off = (double)quad_size((quad)values[k] - truth[k]);
        const quad end_size = k == 2 || k == 3 ? 1 : end.length + (quad)one.height;
        const quad known = 4 * quad_size(truth[k] - again[k]) + end_size / by.step * (quad)1e-32;
        if (off <= (double)known) { /* nobody knows better */
            trial_skip(trial);
            continue;
        }
        trial_figure(trial, output_names[k], off, (double)quad_size(truth[k]), sums[k]);
    }
}

void try_derivatives(struct trial *trial)
{
    derivatives_try(trial, false);
}

void try_bent_derivatives(struct trial *trial)
{
    derivatives_try(trial, true);
}

/* -------- optical path differences -------- */

/* Two rays of a beam, and the exit pupil as the plane at z of the image's frame. */
struct path_pair {
    const struct beam *beam;
    double at[2][2], pupil;
    int nudged; /* this ray */
};

/* W = path of the chief ray to the sphere through its crossing of the pupil, less the ray's. */
static bool path_find(const struct quad_lens *lens, const struct quad_nudge *nudge,
                      const void *context, quad *figures)
{
    const struct path_pair *pair = context;
    struct quad_ray rays[2];
    for (int k = 0; k < 2; k++) {
        rays[k] = quad_ray_of_beam(pair->beam, pair->at[k]);
        if (!quad_ray_trace(lens, pair->nudged == k ? nudge : NULL, &rays[k])) {
            return false;
        }
    }
    const struct quad_ray *chief = &rays[0], *ray = &rays[1];
    quad D[3], along = 0, square = 0, R2 = 0, cross = 0;
    for (int i = 0; i < 3; i++) {
        D[i] = ray->x[i] - chief->x[i];
        along += D[i] * ray->d[i];
        square += D[i] * D[i];
    }
    if (isinf(pair->pupil)) {
        figures[0] = chief->path - (ray->path - ray->n * along);
        return true;
    }
    const quad t = ((quad)pair->pupil - chief->x[2]) / chief->d[2];
    R2 = t * t;
    cross = R2 - (square - along * along);
    if (!(cross >= 0)) {
        return false;
    }
    const quad to = -along + (t < 0 ? -1 : 1) * quad_root(cross);
    figures[0] = chief->path + chief->n * t - (ray->path + ray->n * to);
    return true;
}

static bool path_of(const struct ray_trial *one, const struct path_pair *pair,
                    const struct rays *rays, double *W, struct error *error)
{
    struct opd_reference reference;
    struct ray ends[2];
    for (int k = 0; k < 2; k++) {
        const struct ray start = beam_ray(pair->beam, pair->at[k][0], pair->at[k][1]);
        rays_set(rays, (size_t)k, one->system.index_first, &start);
    }
    rays_trace(&one->system, rays, NULL);
    for (int k = 0; k < 2; k++) {
        ends[k] = rays_get(rays, (size_t)k, one->system.index_last);
    }
    if (!opd_sphere(&ends[0], pair->pupil, one->system.index_last, NULL, &reference, error)) {
        return false;
    }
    *W = opd_path(&reference, &ends[0]) - opd_path(&reference, &ends[1]);
    return true;
}

static void paths_try(struct trial *trial, bool is_bent)
{
    static struct ray_trial one;
    struct beam beam;
    struct error error = {0};
    if (!ray_trial_open(trial, &one, is_bent, true)) {
        return;
    }
    double height = one.height, W = NAN, sums[2][QUAD_FIGURES];
    quad truth[1];
    struct path_pair pair = {.beam = &beam};
    bool found = false;
    for (int turn = 0; turn < 12 && !found; turn++, height *= 0.4) {
        const double tilt = 0.4 * height / one.height, d = (double)one.numbers.object;
        double field[2] = {tilt * trial_between(trial, -1, 1), tilt * trial_between(trial, -1, 1)};
        const double point[3] = {d * field[0], d * field[1], -d};
        beam = beam_from_infinity(field, 1);
        if (d != 0 && !beam_from_point(point, 1, &beam, &error)) {
            break;
        }
        for (int i = 0; i < 4; i++) {
            pair.at[i / 2][i % 2] = height * trial_between(trial, -1, 1);
        }
        const double pupil = -one.height * trial_between(trial, 3, 20) * trial_sign(trial);
        pair.pupil = trial_chance(trial, 0.2) ? INFINITY : pupil;
        /* against the light a surface is met with fewer digits than there are: C/(B + s D) */
        const bool is_forward = quad_ray_of_beam(&beam, pair.at[0]).d[2] > 0 &&
                                quad_ray_of_beam(&beam, pair.at[1]).d[2] > 0;
        found = is_forward && path_find(&one.numbers, NULL, &pair, truth);
    }
    if (!found) {
        trial_skip(trial);
        return;
    }
    char *text = arena_array(&trial->arena, strlen(trial->about) + 400, 1);
    sprintf(text,
            "%sbeam %.17g %.17g %.17g at %.17g, chief %.17g %.17g ray %.17g %.17g pupil %.17g\n",
            trial->about, beam.axis[0], beam.axis[1], beam.axis[2], beam.distance, pair.at[0][0],
            pair.at[0][1], pair.at[1][0], pair.at[1][1], pair.pupil);
    trial->about = text;
    for (int k = 0; k < 2; k++) {
        pair.nudged = k;
        const struct quad_question question = {path_find, &pair, 1, (quad)1e-17};
        if (!quad_sensitivity(&one.numbers, &question, sums[k])) {
            trial_skip(trial);
            return;
        }
    }
    const struct rays rays = rays_new(&trial->arena, 2);
    if (trial_verdict(trial, path_of(&one, &pair, &rays, &W, &error), "%s", error.message)) {
        trial_figure(trial, "W", (double)quad_size((quad)W - truth[0]), (double)quad_size(truth[0]),
                     sums[0][0] + sums[1][0]);
    }
}

void try_paths(struct trial *trial)
{
    paths_try(trial, false);
}

void try_bent_paths(struct trial *trial)
{
    paths_try(trial, true);
}
