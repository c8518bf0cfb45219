/* scene/mesh.c - intersections of rays with triangle meshes. */
/* SPDX-License-Identifier: MIT */
#include "scene/mesh.h"

#include "scene/bvh_traversal.h"

enum { MOST_TRIANGLES = 4 }; /* in a leaf */

/* Twice its area, along its normal. */
static struct vector triangle_normal(const struct scene_mesh *mesh, size_t triangle)
{
    const size_t *of = mesh->triangles[triangle];
    const struct vector a = mesh->corners[of[0]];
    return vector_cross(vector_minus(mesh->corners[of[1]], a),
                        vector_minus(mesh->corners[of[2]], a));
}

/* -------- made ready -------- */

static void box_extend(struct shape_box *box, struct vector at)
{
    struct vector *low = &box->low, *high = &box->high;
    low->x = at.x < low->x ? at.x : low->x;
    low->y = at.y < low->y ? at.y : low->y;
    low->z = at.z < low->z ? at.z : low->z;
    high->x = at.x > high->x ? at.x : high->x;
    high->y = at.y > high->y ? at.y : high->y;
    high->z = at.z > high->z ? at.z : high->z;
}

static const struct shape_box nothing = {{INFINITY, INFINITY, INFINITY},
                                         {-INFINITY, -INFINITY, -INFINITY}};

/* About all corners of a triangle. */
static struct shape_box triangle_box(const struct scene_mesh *mesh, size_t triangle)
{
    struct shape_box box = nothing;
    for (size_t k = 0; k < 3; k++) {
        box_extend(&box, mesh->corners[mesh->triangles[triangle][k]]);
    }
    return box;
}

void mesh_open(const struct scene_mesh *triangles, struct arena *arena, struct mesh *mesh)
{
    *mesh = (struct mesh){.triangles = triangles};
    struct arena work = {0};
    const size_t most = triangles->triangle_count;
    /* of the triangles that have an area */
    struct bvh_box *boxes = arena_buffer_array(&work, most, sizeof(struct bvh_box));
    uint32_t *numbers = arena_buffer_array(&work, most, sizeof(uint32_t));
    size_t count = 0;
    mesh->box = nothing;
    for (size_t i = 0; i < triangles->triangle_count; i++) {
        const struct shape_box box = triangle_box(triangles, i);
        box_extend(&mesh->box, box.low);
        box_extend(&mesh->box, box.high);
    }
    /* corners are sheared along the ray with errors that are shares of the whole triangle */
    const double size = vector_taxi(vector_minus(mesh->box.high, mesh->box.low));
    for (size_t i = 0; i < triangles->triangle_count; i++) {
        const struct vector n = triangle_normal(triangles, i);
        if (vector_dot(n, n) > 0) {
            const struct shape_box box = triangle_box(triangles, i);
            boxes[count] = bvh_box_of(box.low, box.high, size * 0x1p-44);
            numbers[count++] = (uint32_t)i;
        }
    }
    mesh->degenerate = triangles->triangle_count - count;
    bvh_open(boxes, count, MOST_TRIANGLES, arena, &mesh->tree);
    struct mesh_triangle *leaves = arena_buffer_array(arena, count, sizeof *leaves);
    for (size_t i = 0; i < count; i++) {
        const uint32_t which = numbers[mesh->tree.items[i]];
        const size_t *of = triangles->triangles[which];
        leaves[i] =
            (struct mesh_triangle){{(uint32_t)of[0], (uint32_t)of[1], (uint32_t)of[2]}, which};
    }
    mesh->leaves = leaves;
    arena_free(&work);
}

/* -------- rays -------- */

/* The axes of a ray, the steepest last, and how space is sheared to make it the last of them. */
struct sheared {
    size_t axis[3];
    double from[3]; /* by these axes */
    double shear[3];
};

/* A corner in sheared coordinates; z is still along the steepest axis of the ray, in mm. */
struct sheared_corner {
    double x, y, z;
};

static inline struct sheared_corner sheared_corner_of(const struct sheared *sheared,
                                                      const struct vector *at)
{
    const double of[] = {at->x, at->y, at->z};
    const double z = of[sheared->axis[2]] - sheared->from[2];
    return (struct sheared_corner){of[sheared->axis[0]] - sheared->from[0] - sheared->shear[0] * z,
                                   of[sheared->axis[1]] - sheared->from[1] - sheared->shear[1] * z,
                                   z};
}

static inline double largest_of_three(double a, double b, double c)
{
    const double ab = fabs(a) > fabs(b) ? fabs(a) : fabs(b);
    return ab > fabs(c) ? ab : fabs(c);
}

/*
 * By how much u a.z + v b.z + w c.z may be wrong.
 *
 * Formula   with e = 2^-53 and X, Y, Z the largest parts: x is wrong by less than 5 e (X + Z), so
 *           are y and z by less, an edge u by 2 (5 e (X + Z) Y + 5 e (Y + Z) X) + 4 e X Y, and the
 *           sum of three products, each at most 2 X Y Z, by three times this times Z and 8 e X Y Z
 */
static double edge_rounding_error(const struct sheared_corner *a, const struct sheared_corner *b,
                                  const struct sheared_corner *c)
{
    const double x = largest_of_three(a->x, b->x, c->x), y = largest_of_three(a->y, b->y, c->y);
    const double z = largest_of_three(a->z, b->z, c->z);
    return 3 * 0x1p-53 * z * (10 * ((x + z) * y + (y + z) * x) + 12 * x * y);
}

static inline bool triangle_intersect(const struct mesh *mesh, const struct mesh_triangle *triangle,
                                      const struct sheared *sheared, double farthest,
                                      struct shape_hit *meeting)
{
    const struct vector *corners = mesh->triangles->corners;
    const struct sheared_corner a = sheared_corner_of(sheared, &corners[triangle->corner[0]]);
    const struct sheared_corner b = sheared_corner_of(sheared, &corners[triangle->corner[1]]);
    const struct sheared_corner c = sheared_corner_of(sheared, &corners[triangle->corner[2]]);
    const double u = c.x * b.y - c.y * b.x, v = a.x * c.y - a.y * c.x, w = b.x * a.y - b.y * a.x;
    if ((u < 0 || v < 0 || w < 0) && (u > 0 || v > 0 || w > 0)) {
        return false;
    }
    const double whole = u + v + w, sum = u * a.z + v * b.z + w * c.z;
    const double distance = sum / whole * sheared->shear[2];
    if (!(distance > 0 && distance < farthest && fabs(sum) > edge_rounding_error(&a, &b, &c))) {
        return false;
    }
    *meeting = (struct shape_hit){distance, triangle->number, {v / whole, w / whole}};
    return true;
}

bool mesh_intersect(const struct mesh *mesh, const struct shape_ray *ray, bool is_any,
                    struct shape_hit *meeting)
{
    const double from[] = {ray->origin.x, ray->origin.y, ray->origin.z};
    const double direction[] = {ray->direction.x, ray->direction.y, ray->direction.z};
    size_t steep = 0; /* the axis that it goes along most */
    for (size_t i = 1; i < 3; i++) {
        steep = fabs(direction[steep]) > fabs(direction[i]) ? steep : i;
    }
    const size_t first = steep < 2 ? steep + 1 : 0, second = first < 2 ? first + 1 : 0;
    const double over = 1 / direction[steep];
    const struct sheared sheared = {
        .axis = {first, second, steep},
        .from = {from[first], from[second], from[steep]},
        .shear = {direction[first] * over, direction[second] * over, over}};
    double farthest = ray->farthest;
    bool met = false;
    struct bvh_traversal walk;
    struct bvh_pending leaf;
    bvh_traversal_start(&walk, &mesh->tree, ray->origin, ray->direction);
    while (!(met && is_any) && bvh_traversal_next(&walk, farthest, &leaf)) {
        for (uint32_t i = 0; i < leaf.count; i++) {
            if (triangle_intersect(mesh, &mesh->leaves[leaf.child + i], &sheared, farthest,
                                   meeting)) {
                met = true;
                farthest = meeting->distance;
            }
        }
    }
    return met;
}

/* -------- what is there -------- */

static struct vector interpolated(const struct vector *of, const size_t corner[3],
                                  const double share[3])
{
    return vector_along(
        vector_along(vector_times(share[0], of[corner[0]]), share[1], of[corner[1]]), share[2],
        of[corner[2]]);
}

struct shape_surface mesh_surface(const struct mesh *mesh, const struct shape_hit *meeting)
{
    const struct scene_mesh *of = mesh->triangles;
    const size_t *corner = of->triangles[meeting->part];
    const double b = meeting->share[0], c = meeting->share[1], share[3] = {1 - b - c, b, c};
    struct shape_surface spot = {.at = interpolated(of->corners, corner, share),
                                 .face = vector_unit(triangle_normal(of, meeting->part))};
    spot.normal = spot.face;
    for (size_t k = 0; k < 3; k++) {
        spot.size += fabs(share[k]) * vector_taxi(of->corners[corner[k]]);
    }
    if (of->normals != NULL) {
        const struct vector smooth = interpolated(of->normals, corner, share);
        /* files go round their corners one way and turn normals the other */
        const double length = copysign(vector_length(smooth), vector_dot(smooth, spot.face));
        spot.normal = length != 0 ? vector_times(1 / length, smooth) : spot.face;
    }
    for (size_t k = 0; k < 2 && of->places != NULL; k++) {
        const double *place[3] = {of->places[corner[0]], of->places[corner[1]],
                                  of->places[corner[2]]};
        const double at = share[0] * place[0][k] + b * place[1][k] + c * place[2][k];
        /* pictures beside pictures, where places go on beyond them */
        spot.place[k] = at >= 0 && at <= 1 ? at : at - floor(at);
    }
    return spot;
}
