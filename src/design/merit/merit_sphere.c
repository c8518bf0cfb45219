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
    static const struct pupil_point middle = {0};
    struct merit_spheres *spheres = ARENA_NEW(arena, struct merit_spheres);
    struct bundle_wish one = *wish;
    one.wavelength_count = 1;
    one.points = &middle;
    one.point_count = 1;
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
        merit_bundle_sweep(&spheres->chief, which, LENS_NONE, links, spheres->variable_count,
                           &adjoint, spheres->columns);
        /*
         * dR from that of e_z, which is r/n, and of the planes; the columns hold one part of all
         * rays
         */
        const struct merit_bundle *chief = &spheres->chief;
        const double n = chief->lights[0].system.index_last;
        for (int i = 0; i < block->aimed.count; i++) {
            struct merit_sphere *sphere = &spheres->list[block->lanes[i].field];
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
        for (int i = 0; i < block->aimed.count; i++) {
            if (!set_sphere(spheres, n, &end, i, &spheres->list[block->lanes[i].field], error)) {
                return false;
            }
        }
        if (derives) {
            merit_sphere_derive(spheres, k, links, &end);
        }
    }
    return true;
}

/* A ray and its sphere. */
struct sphere_crossing {
    double n, R, side;
    double D[2], e[2], m[2]; /* from the centre, whose z is 0; direction; D across it */
    double along, q;         /* D.e; m^2 */
    double chord;            /* sqrt(R^2 - q); infinite */
    double over, root;       /* s/R; sqrt(1 - q/R^2) */
};

static struct sphere_crossing sphere_crossing_of(const struct merit_spheres *spheres,
                                                 const struct merit_bundle *bundle,
                                                 const struct bundle_block *block,
                                                 const struct ray_block *end, int i)
{
    const struct opd_reference *sphere = &spheres->list[block->lanes[i].field].sphere;
    const double n = bundle->lights[block->light].system.index_last, R = sphere->radius;
    struct sphere_crossing at = {
        .n = n,
        .R = R,
        .side = sphere->side,
        .D = {end->x[i] - sphere->centre[0], end->y[i] - sphere->centre[1]},
        .e = {end->p[i] / n, end->q[i] / n},
        .over = sphere->side / R};
    const double lift = end->r[i] / n, turn = at.D[0] * at.e[1] - at.D[1] * at.e[0];
    at.along = at.D[0] * at.e[0] + at.D[1] * at.e[1];
    at.q = turn * turn + (at.D[0] * at.D[0] + at.D[1] * at.D[1]) * lift * lift; /* |D x e|^2 */
    at.chord = sqrt((R - sqrt(at.q)) * (R + sqrt(at.q)));
    at.root = sqrt(1 - at.q * at.over * at.over);
    for (int k = 0; k < 2; k++) {
        at.m[k] = at.D[k] - at.along * at.e[k];
    }
    return at;
}

void merit_spheres_meet(const struct merit_spheres *spheres, const struct merit_bundle *bundle,
                        const struct bundle_block *block, const struct ray_block *end, double *path,
                        double *const to[2])
{
    for (int i = 0; i < block->aimed.count; i++) {
        const struct sphere_crossing at = sphere_crossing_of(spheres, bundle, block, end, i);
        const double bulge = isinf(at.R) ? 0 : at.q / (at.R + at.chord);
        path[i] = end->path[i] - at.n * (at.along - at.side * bulge);
        for (int k = 0; k < 2 && to != NULL; k++) {
            to[k][i] = at.root * at.e[k] - at.over * at.m[k];
        }
    }
}

void merit_spheres_back(const struct merit_spheres *spheres, const struct merit_bundle *bundle,
                        const struct bundle_block *block, const struct ray_block *end,
                        struct merit_spheres_by *by, struct ray_block *adjoint)
{
    for (int i = 0; i < block->aimed.count; i++) {
        const struct sphere_crossing at = sphere_crossing_of(spheres, bundle, block, end, i);
        const bool is_far = isinf(at.R);
        const double path = by->path[i], G[2] = {by->to[0][i], by->to[1][i]};
        const double bends = is_far ? 0 : at.side / at.chord; /* 2 s dB/dq */
        /* through the direction to the centre: by q, by D.e */
        const double G_e = G[0] * at.e[0] + G[1] * at.e[1];
        const double G_m = G[0] * at.m[0] + G[1] * at.m[1];
        const double by_q = -G_e * at.over * at.over / (2 * at.root);
        const double by_along = at.over * G_e - 2 * at.along * by_q;
        double by_D[2], by_e[2];
        for (int k = 0; k < 2; k++) {
            by_D[k] = -at.n * path * (at.e[k] - bends * at.m[k]) + 2 * by_q * at.D[k] -
                      at.over * G[k] + by_along * at.e[k];
            by_e[k] = -at.n * path * at.D[k] * (1 + bends * at.along) +
                      (at.root + at.over * at.along) * G[k] + by_along * at.D[k];
            by->centre[k][i] = -by_D[k];
        }
        by->radius[i] = is_far ? 0
                               : -at.n * at.side * path * at.q / (at.chord * (at.chord + at.R)) +
                                     (at.over * G_m - 2 * at.q * by_q) / at.R;
        adjoint->path[i] = path;
        adjoint->x[i] = by_D[0];
        adjoint->y[i] = by_D[1];
        adjoint->p[i] = by_e[0] / at.n;
        adjoint->q[i] = by_e[1] / at.n;
    }
}

void merit_spheres_move(const struct merit_spheres *spheres, const struct bundle_block *block,
                        const struct merit_spheres_by *by, double *columns)
{
    for (size_t j = 0; j < spheres->variable_count; j++) {
        for (int i = 0; i < block->aimed.count; i++) {
            const struct merit_sphere *sphere = &spheres->list[block->lanes[i].field];
            columns[j * RAYS_BLOCK + (size_t)i] += by->radius[i] * sphere->radius[j] +
                                                   by->centre[0][i] * sphere->centre[0][j] +
                                                   by->centre[1][i] * sphere->centre[1][j];
        }
    }
}
