/* design/merit/merit_sphere.c - reference spheres, and paths to them, with derivatives. */
/* SPDX-License-Identifier: MIT */
#include "design/merit/merit_sphere.h"

#include <math.h>
#include <string.h>

/* What is wanted of a chief ray. */
enum { OF_X, OF_Y, OF_R, PARTS };

struct merit_spheres *merit_spheres_open(const struct bundle_wish *wish,
                                         const struct bundle_links *links, size_t variable_count,
                                         struct arena *arena, struct error *error)
{
    struct merit_spheres *spheres = ARENA_NEW(arena, struct merit_spheres);
    struct bundle_wish one = *wish;
    one.wavelength_count = 1;
    one.is_chief = true;
    one.path = false;
    one.clip = false;
    one.from_entrance = wish->setup->first.is_telecentric;
    spheres->variable_count = variable_count;
    spheres->pupil = ARENA_ARRAY(arena, variable_count + 1, struct dual);
    spheres->columns = ARENA_ARRAY(arena, (variable_count + 1) * RAYS_BLOCK, double);
    spheres->list = ARENA_ARRAY(arena, wish->field_count, struct merit_sphere);
    for (size_t i = 0; i < wish->field_count; i++) {
        double *numbers = ARENA_ARRAY(arena, PARTS * (variable_count + 1), double);
        spheres->list[i].centre[0] = numbers;
        spheres->list[i].centre[1] = numbers + variable_count;
        spheres->list[i].radius = numbers + 2 * variable_count;
    }
    return merit_bundle_open(&one, links, variable_count, arena, &spheres->chief, error) ? spheres
                                                                                         : NULL;
}

/* The sphere of one chief ray. */
static bool set_sphere(const struct merit_spheres *spheres, double n, const struct ray_block *end,
                       int i, struct merit_sphere *sphere, struct error *error)
{
    const double image = spheres->chief.image;
    struct ray chief = {.point = {end->x[i], end->y[i], 0},
                        .cosine = {end->p[i] / n, end->q[i] / n, end->r[i] / n},
                        .status = RAY_OK};
    return opd_sphere(&chief, spheres->pupil[0].value - image, n, NULL, &sphere->sphere, error);
}

/* dR from that of e_z, which is r/n, and of the planes; the columns hold one part of all rays. */
static void merit_sphere_put_part(struct merit_spheres *spheres, const struct bundle_block *block,
                                  const struct bundle_links *links, int part,
                                  const struct ray_block *end)
{
    const struct merit_bundle *chief = &spheres->chief;
    const double n = chief->lights[0].system.index_last;
    for (size_t g = 0; g < block->aimed.beam_count; g++) {
        const size_t field = chief->groups[block->shares[g].group].field;
        struct merit_sphere *sphere = &spheres->list[field];
        const int i = block->aimed.beams[g].first;
        for (size_t j = 0; j < spheres->variable_count; j++) {
            const double slope = spheres->columns[j * RAYS_BLOCK + (size_t)i];
            if (part != OF_R) {
                sphere->centre[part][j] = slope;
                continue;
            }
            const double cosine = end->r[i] / n;
            const double way = (spheres->pupil[0].value - chief->image) / cosine;
            const double moves =
                spheres->pupil[j].slope - merit_bundle_image_slope(chief, links, j);
            sphere->radius[j] = (way < 0 ? -1 : 1) * (moves - way * slope / n) / cosine;
            if (isinf(sphere->sphere.radius)) {
                sphere->radius[j] = 0;
            }
        }
    }
}

static void merit_sphere_derive(struct merit_spheres *spheres, size_t which,
                                const struct bundle_links *links, const struct ray_block *end)
{
    const struct bundle_block *block = &spheres->chief.blocks[which];
    for (int part = 0; part < PARTS; part++) {
        struct ray_block adjoint;
        memset(&adjoint, 0, sizeof adjoint);
        double *const of[PARTS] = {adjoint.x, adjoint.y, adjoint.r};
        for (int i = 0; i < block->aimed.lanes; i++) {
            of[part][i] = 1;
        }
        merit_bundle_sweep(&spheres->chief, which, links, spheres->variable_count, &adjoint,
                           spheres->columns);
        merit_sphere_put_part(spheres, block, links, part, end);
    }
}

bool merit_spheres_find(struct merit_spheres *spheres, const struct bundle_links *links,
                        bool derives, struct error *error)
{
    struct merit_bundle *chief = &spheres->chief;
    const double n = chief->lights[0].system.index_last;
    for (size_t k = 0; k < chief->block_count; k++) {
        const struct bundle_block *block = &chief->blocks[k];
        struct ray_block end;
        if (!merit_bundle_trace(chief, k, derives, &end, error)) {
            return error_prefix(error, "the chief ray: ");
        }
        for (size_t g = 0; g < block->aimed.beam_count; g++) {
            struct merit_sphere *sphere =
                &spheres->list[chief->groups[block->shares[g].group].field];
            if (!set_sphere(spheres, n, &end, block->aimed.beams[g].first, sphere, error)) {
                return false;
            }
        }
        if (derives) {
            merit_sphere_derive(spheres, k, links, &end);
        }
    }
    return true;
}

/* Where a ray is beside its sphere: what paths and their derivatives are made of. */
struct beside {
    double x, y;     /* D, whose z is 0 */
    double along, q; /* D.e; q */
    double root;     /* sqrt(R^2 - q); infinite */
};

static struct beside beside_of(const struct opd_reference *sphere, const struct ray_block *end,
                               int i)
{
    const double x = end->x[i] - sphere->centre[0], y = end->y[i] - sphere->centre[1];
    const double along = (x * end->p[i] + y * end->q[i]) / sphere->n;
    const double turn = (x * end->q[i] - y * end->p[i]) / sphere->n;
    const double lift2 = (x * x + y * y) * (end->r[i] / sphere->n) * (end->r[i] / sphere->n);
    const double q = turn * turn + lift2, R = sphere->radius; /* |D x e|^2, as z of D is 0 */
    return (struct beside){x, y, along, q, sqrt((R - sqrt(q)) * (R + sqrt(q)))};
}

/* Of a path: by the final ray, and by the radius; by the centre it is less that by x and y. */
struct path_slopes {
    double x, y, p, q, radius;
};

static struct path_slopes path_slopes_of(const struct opd_reference *sphere,
                                         const struct ray_block *end, int i)
{
    const struct beside at = beside_of(sphere, end, i);
    const bool is_far = isinf(sphere->radius);
    const double n = sphere->n, p = end->p[i] / n, q = end->q[i] / n;
    const double bends = is_far ? 0 : sphere->side / at.root; /* 2 s dB/dq */
    return (struct path_slopes){
        .x = -n * (p - bends * (at.x - at.along * p)),
        .y = -n * (q - bends * (at.y - at.along * q)),
        .p = -at.x * (1 + bends * at.along),
        .q = -at.y * (1 + bends * at.along),
        .radius = is_far ? 0 : -n * sphere->side * at.q / (at.root * (at.root + sphere->radius))};
}

void merit_spheres_path(const struct merit_spheres *spheres, const struct merit_bundle *bundle,
                        const struct bundle_block *block, const struct ray_block *end, double *path,
                        struct ray_block *adjoint)
{
    for (size_t g = 0; g < block->aimed.beam_count; g++) {
        const struct aimed_beam *beam = &block->aimed.beams[g];
        const size_t field = bundle->groups[block->shares[g].group].field;
        struct opd_reference sphere = spheres->list[field].sphere;
        const double n = bundle->lights[block->light].system.index_last;
        sphere.n = n;
        for (int i = beam->first; i < beam->first + beam->count; i++) {
            const struct beside at = beside_of(&sphere, end, i);
            const struct path_slopes slopes = path_slopes_of(&sphere, end, i);
            const double bulge = isinf(sphere.radius) ? 0 : at.q / (sphere.radius + at.root);
            path[i] = end->path[i] - n * (at.along - sphere.side * bulge);
            adjoint->path[i] = 1;
            adjoint->x[i] = slopes.x;
            adjoint->y[i] = slopes.y;
            adjoint->p[i] = slopes.p;
            adjoint->q[i] = slopes.q;
        }
    }
}

void merit_spheres_move(const struct merit_spheres *spheres, const struct merit_bundle *bundle,
                        const struct bundle_block *block, const struct ray_block *end,
                        double *columns)
{
    for (size_t g = 0; g < block->aimed.beam_count; g++) {
        const struct aimed_beam *beam = &block->aimed.beams[g];
        const struct merit_sphere *from =
            &spheres->list[bundle->groups[block->shares[g].group].field];
        struct opd_reference sphere = from->sphere;
        sphere.n = bundle->lights[block->light].system.index_last;
        for (int i = beam->first; i < beam->first + beam->count; i++) {
            const struct path_slopes slopes = path_slopes_of(&sphere, end, i);
            for (size_t j = 0; j < spheres->variable_count; j++) {
                columns[j * RAYS_BLOCK + (size_t)i] += slopes.radius * from->radius[j] -
                                                       slopes.x * from->centre[0][j] -
                                                       slopes.y * from->centre[1][j];
            }
        }
    }
}

/* A ray beside its sphere, as its direction to the centre is made of it. */
struct sphere_crossing {
    double D[2], e[2], m[2];
    double along, over, root, q; /* over: s/R */
};

static struct sphere_crossing merit_sphere_meet(const struct opd_reference *sphere,
                                                const struct ray_block *end, int i)
{
    struct sphere_crossing at = {
        .D = {end->x[i] - sphere->centre[0], end->y[i] - sphere->centre[1]},
        .e = {end->p[i] / sphere->n, end->q[i] / sphere->n},
        .over = sphere->side / sphere->radius};
    at.q = beside_of(sphere, end, i).q;
    at.along = at.D[0] * at.e[0] + at.D[1] * at.e[1];
    at.root = sqrt(1 - at.q * at.over * at.over);
    for (int k = 0; k < 2; k++) {
        at.m[k] = at.D[k] - at.along * at.e[k];
    }
    return at;
}

void merit_spheres_meet(const struct merit_spheres *spheres, const struct merit_bundle *bundle,
                        const struct bundle_block *block, const struct ray_block *end,
                        double *const to[2])
{
    for (size_t g = 0; g < block->aimed.beam_count; g++) {
        const struct aimed_beam *beam = &block->aimed.beams[g];
        const size_t field = bundle->groups[block->shares[g].group].field;
        struct opd_reference sphere = spheres->list[field].sphere;
        sphere.n = bundle->lights[block->light].system.index_last;
        for (int i = beam->first; i < beam->first + beam->count; i++) {
            const struct sphere_crossing at = merit_sphere_meet(&sphere, end, i);
            for (int k = 0; k < 2; k++) {
                to[k][i] = at.root * at.e[k] - at.over * at.m[k];
            }
        }
    }
}

/* By D and e, of one ray, through its direction to the centre. */
static void meet_back(const struct opd_reference *sphere, const struct sphere_crossing *at,
                      struct merit_spheres_by *by, int i, double by_e[2])
{
    const double G[2] = {by->to[0][i], by->to[1][i]};
    const double G_e = G[0] * at->e[0] + G[1] * at->e[1];
    const double G_m = G[0] * at->m[0] + G[1] * at->m[1];
    const double by_q = -G_e * at->over * at->over / (2 * at->root);
    const double by_along = at->over * G_e - 2 * at->along * by_q;
    for (int k = 0; k < 2; k++) {
        by->centre[k][i] -= 2 * by_q * at->D[k] - at->over * G[k] + by_along * at->e[k];
        by_e[k] += (at->root + at->over * at->along) * G[k] + by_along * at->D[k];
    }
    if (!isinf(sphere->radius)) {
        by->radius[i] += (at->over * G_m - 2 * at->q * by_q) / sphere->radius;
    }
}

void merit_spheres_back(const struct merit_spheres *spheres, const struct merit_bundle *bundle,
                        const struct bundle_block *block, const struct ray_block *end,
                        struct merit_spheres_by *by, struct ray_block *adjoint)
{
    for (size_t g = 0; g < block->aimed.beam_count; g++) {
        const struct aimed_beam *beam = &block->aimed.beams[g];
        const size_t field = bundle->groups[block->shares[g].group].field;
        struct opd_reference sphere = spheres->list[field].sphere;
        sphere.n = bundle->lights[block->light].system.index_last;
        for (int i = beam->first; i < beam->first + beam->count; i++) {
            const struct path_slopes path = path_slopes_of(&sphere, end, i);
            const struct sphere_crossing at = merit_sphere_meet(&sphere, end, i);
            double by_e[2] = {sphere.n * by->path[i] * path.p, sphere.n * by->path[i] * path.q};
            by->centre[0][i] = -by->path[i] * path.x;
            by->centre[1][i] = -by->path[i] * path.y;
            by->radius[i] = by->path[i] * path.radius;
            meet_back(&sphere, &at, by, i, by_e);
            adjoint->path[i] = by->path[i];
            adjoint->x[i] = -by->centre[0][i];
            adjoint->y[i] = -by->centre[1][i];
            adjoint->p[i] = by_e[0] / sphere.n;
            adjoint->q[i] = by_e[1] / sphere.n;
        }
    }
}
