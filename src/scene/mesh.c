/* scene/mesh.c - where rays meet triangles. */
/* SPDX-License-Identifier: MIT */
#include "scene/mesh.h"

#include <float.h>

/* -------- a triangle -------- */

/* Twice its area, along its normal. */
static struct vector across(const struct scene_mesh *mesh, size_t triangle)
{
    const size_t *of = mesh->triangles[triangle];
    const struct vector a = mesh->corners[of[0]];
    return vector_cross(vector_minus(mesh->corners[of[1]], a),
                        vector_minus(mesh->corners[of[2]], a));
}

static bool has_area(const struct scene_mesh *mesh, size_t triangle)
{
    const struct vector n = across(mesh, triangle);
    return vector_dot(n, n) > 0;
}

static double part_of(struct vector a, int axis)
{
    return axis == 0 ? a.x : axis == 1 ? a.y : a.z;
}

/* The axes of a ray, the steepest last, and how it is sheared to go along that. */
struct sheared {
    int axis[3];
    double shear[3];
};

static struct sheared shear_along(struct vector way)
{
    const double x = fabs(way.x), y = fabs(way.y), z = fabs(way.z);
    const int steep = x > y ? (x > z ? 0 : 2) : (y > z ? 1 : 2);
    struct sheared sheared = {.axis = {(steep + 1) % 3, (steep + 2) % 3, steep}};
    const double along = part_of(way, steep);
    sheared.shear[0] = part_of(way, sheared.axis[0]) / along;
    sheared.shear[1] = part_of(way, sheared.axis[1]) / along;
    sheared.shear[2] = 1 / along;
    return sheared;
}

static struct vector sheared_corner(const struct sheared *sheared, struct vector corner,
                                    struct vector from)
{
    const struct vector a = vector_minus(corner, from);
    const double z = part_of(a, sheared->axis[2]);
    return (struct vector){part_of(a, sheared->axis[0]) - sheared->shear[0] * z,
                           part_of(a, sheared->axis[1]) - sheared->shear[1] * z,
                           sheared->shear[2] * z};
}

static bool meet_triangle(const struct scene_mesh *mesh, size_t triangle,
                          const struct sheared *sheared, const struct shape_ray *ray,
                          struct shape_meeting *meeting)
{
    const size_t *of = mesh->triangles[triangle];
    const struct vector a = sheared_corner(sheared, mesh->corners[of[0]], ray->from);
    const struct vector b = sheared_corner(sheared, mesh->corners[of[1]], ray->from);
    const struct vector c = sheared_corner(sheared, mesh->corners[of[2]], ray->from);
    const double u = c.x * b.y - c.y * b.x, v = a.x * c.y - a.y * c.x, w = b.x * a.y - b.y * a.x;
    const double whole = u + v + w, distance = (u * a.z + v * b.z + w * c.z) / whole;
    if ((fmin(u, fmin(v, w)) < 0 && fmax(u, fmax(v, w)) > 0) ||
        !(distance > 0 && distance < ray->farthest)) {
        return false;
    }
    *meeting = (struct shape_meeting){distance, triangle, {v / whole, w / whole}};
    return true;
}

/* -------- a mesh -------- */

void mesh_open(const struct scene_mesh *triangles, struct arena *arena, struct mesh *mesh)
{
    (void)arena;
    *mesh =
        (struct mesh){.triangles = triangles,
                      .box = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}}};
    struct vector *low = &mesh->box.low, *high = &mesh->box.high;
    for (size_t i = 0; i < triangles->triangle_count; i++) {
        for (size_t k = 0; k < 3; k++) {
            const struct vector at = triangles->corners[triangles->triangles[i][k]];
            *low = (struct vector){fmin(low->x, at.x), fmin(low->y, at.y), fmin(low->z, at.z)};
            *high = (struct vector){fmax(high->x, at.x), fmax(high->y, at.y), fmax(high->z, at.z)};
        }
        mesh->degenerate += has_area(triangles, i) ? 0 : 1;
    }
}

bool mesh_meet(const struct mesh *mesh, const struct shape_ray *ray, struct shape_meeting *meeting)
{
    const struct sheared sheared = shear_along(ray->way);
    struct shape_ray rest = *ray;
    for (size_t i = 0; i < mesh->triangles->triangle_count; i++) {
        if (has_area(mesh->triangles, i) &&
            meet_triangle(mesh->triangles, i, &sheared, &rest, meeting)) {
            rest.farthest = meeting->distance;
        }
    }
    return rest.farthest < ray->farthest;
}

static struct vector mixed(const struct vector *of, const size_t corner[3], const double share[3])
{
    return vector_along(
        vector_along(vector_times(share[0], of[corner[0]]), share[1], of[corner[1]]), share[2],
        of[corner[2]]);
}

struct shape_spot mesh_spot(const struct mesh *mesh, const struct shape_meeting *meeting)
{
    const struct scene_mesh *of = mesh->triangles;
    const size_t *corner = of->triangles[meeting->part];
    const double b = meeting->share[0], c = meeting->share[1], share[3] = {1 - b - c, b, c};
    struct shape_spot spot = {.at = mixed(of->corners, corner, share),
                              .face = vector_unit(across(of, meeting->part))};
    spot.normal = spot.face;
    for (size_t k = 0; k < 3; k++) {
        spot.size += fabs(share[k]) * vector_taxi(of->corners[corner[k]]);
    }
    if (of->normals != NULL) {
        const struct vector smooth = mixed(of->normals, corner, share);
        const double length = vector_length(smooth);
        spot.normal = length > 0 ? vector_times(1 / length, smooth) : spot.face;
    }
    for (size_t k = 0; k < 2 && of->places != NULL; k++) {
        const double *place[3] = {of->places[corner[0]], of->places[corner[1]],
                                  of->places[corner[2]]};
        spot.place[k] = share[0] * place[0][k] + b * place[1][k] + c * place[2][k];
    }
    return spot;
}
