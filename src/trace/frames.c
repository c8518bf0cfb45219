/* trace/frames.c - turning and shifting, and the normals of surfaces. */
/* SPDX-License-Identifier: MIT */
#include "trace/frames.h"

#include <math.h>

static void matrix_turn(const double m[9], const double v[3], double result[3])
{
    double x = v[0], y = v[1], z = v[2];
    for (int i = 0; i < 3; i++) {
        result[i] = m[3 * i] * x + m[3 * i + 1] * y + m[3 * i + 2] * z;
    }
}

static void turn_back(const double m[9], const double v[3], double result[3])
{
    double x = v[0], y = v[1], z = v[2];
    for (int i = 0; i < 3; i++) {
        result[i] = m[i] * x + m[3 + i] * y + m[6 + i] * z;
    }
}

struct surface_frame frame_of(const struct displacement *displacement, double z)
{
    struct surface_frame frame = {
        {1, 0, 0, 0, 1, 0, 0, 0, 1},
        {displacement->decenter[0].value.hi, displacement->decenter[1].value.hi, z}};
    for (int axis = 0; axis < 3; axis++) {
        double angle = displacement->tilt[axis].value.hi;
        if (angle != 0) {
            /*
             * one axis after the other: new axes as rows. About x first, then the new y, then the
             * new z.
             */
            double *m = frame.turn;
            int a = (axis + 1) % 3, b = (axis + 2) % 3;
            double cosine = cos(angle), sine = sin(angle);
            for (int i = 0; i < 3; i++) {
                double u = m[3 * a + i], v = m[3 * b + i];
                m[3 * a + i] = cosine * u + sine * v;
                m[3 * b + i] = cosine * v - sine * u;
            }
        }
    }
    return frame;
}

struct surface_frame frame_inverse(const struct surface_frame *frame)
{
    struct surface_frame inverse;
    for (int i = 0; i < 9; i++) {
        inverse.turn[i] = frame->turn[3 * (i % 3) + i / 3];
    }
    matrix_turn(frame->turn, frame->shift, inverse.shift);
    for (int i = 0; i < 3; i++) {
        inverse.shift[i] = -inverse.shift[i];
    }
    return inverse;
}

/* A ray along the axis at a place, in the frame of a vertex. */
struct along_axis {
    double point[3], axis[3];
};

static void go_to(struct along_axis *ray, const struct surface_frame *frame)
{
    for (int i = 0; i < 3; i++) {
        ray->point[i] -= frame->shift[i];
    }
    matrix_turn(frame->turn, ray->point, ray->point);
    matrix_turn(frame->turn, ray->axis, ray->axis);
}

static void axis_leave_frame(struct along_axis *ray, const struct surface_frame *frame)
{
    turn_back(frame->turn, ray->point, ray->point);
    turn_back(frame->turn, ray->axis, ray->axis);
    for (int i = 0; i < 3; i++) {
        ray->point[i] += frame->shift[i];
    }
}

/* Reflected where it meets the plane of the vertex, as the conic stands there. */
static void axis_reflect(struct along_axis *ray, const struct surface *surface)
{
    const double least = 1e-9; /* of the slope across the plane */
    double way = fabs(ray->axis[2]) > least ? -ray->point[2] / ray->axis[2] : 0;
    for (int i = 0; i < 3; i++) {
        ray->point[i] += way * ray->axis[i];
    }
    const double x = ray->point[0], y = ray->point[1];
    const double c = surface_curvature(surface, SECTION_Y).hi, r2 = x * x + y * y;
    const double within = 1 - (1 + surface->conic.value.hi) * c * c * r2;
    const double slope = within > 0 && surface->curved == CURVED_BOTH ? c / sqrt(within) : 0;
    double normal[3] = {0, 0, 1};
    if (slope != 0) {
        const double length = sqrt(1 + slope * slope * r2);
        normal[0] = -slope * x / length;
        normal[1] = -slope * y / length;
        normal[2] = 1 / length;
    }
    double along = 0;
    for (int i = 0; i < 3; i++) {
        along += ray->axis[i] * normal[i];
    }
    for (int i = 0; i < 3; i++) {
        ray->axis[i] -= 2 * along * normal[i];
    }
    ray->point[2] = slope != 0 ? c * r2 / (1 + sqrt(within)) : 0;
}

void frame_directions(const struct lens *lens, double *direction)
{
    struct along_axis ray = {{0, 0, 0}, {0, 0, 1}};
    for (size_t i = 0; i < lens->surface_count; i++) {
        const struct surface *surface = &lens->surfaces[i];
        const double way = i > 0 ? surface_advance(&lens->surfaces[i - 1]).hi : 0;
        struct surface_frame frame = {{1, 0, 0, 0, 1, 0, 0, 0, 1}, {0, 0, way}};
        if (surface->coordinate_break != NULL) {
            frame = frame_of(surface->coordinate_break, way);
        }
        go_to(&ray, &frame);
        struct surface_frame own = {{1, 0, 0, 0, 1, 0, 0, 0, 1}, {0, 0, 0}};
        if (surface->decentre != NULL) {
            own = frame_of(surface->decentre, 0);
        }
        go_to(&ray, &own);
        direction[i] = ray.axis[2] < 0 ? -1 : 1;
        if (surface_reflects(surface)) {
            axis_reflect(&ray, surface);
        }
        axis_leave_frame(&ray, &own);
    }
    direction[lens->surface_count] = ray.axis[2] < 0 ? -1 : 1;
}

static const struct surface_frame unmoved = {{1, 0, 0, 0, 1, 0, 0, 0, 1}, {0, 0, 0}};

static struct surface_frame turned_back(const struct surface_frame *all)
{
    struct surface_frame result = *all;
    for (int i = 0; i < 9; i++) {
        result.turn[i] = all->turn[3 * (i % 3) + i / 3];
    }
    return result;
}

struct surface_frame *system_frames(const struct system *system, struct arena *arena)
{
    const struct lens *lens = system->lens;
    const size_t count = lens->surface_count;
    struct surface_frame *frames = ARENA_ARRAY(arena, count + 1, struct surface_frame);
    struct surface_frame all = unmoved;
    for (size_t i = 0; i < count; i++) {
        /*
         * On to the vertex of a surface from the one before: of X in its frame all->turn^-1 X +
         * all->shift, with turn the rows of its axes.
         */
        const struct displacement *coordinate_break = lens->surfaces[i].coordinate_break;
        double way[3] = {0, 0, i > 0 ? surface_advance(&lens->surfaces[i - 1]).hi : 0};
        double moved[3];
        struct surface_frame frame;
        if (coordinate_break != NULL) {
            frame = frame_of(coordinate_break, way[2]);
            way[0] = frame.shift[0];
            way[1] = frame.shift[1];
        }
        turn_back(all.turn, way, moved);
        for (int j = 0; j < 3; j++) {
            all.shift[j] += moved[j];
        }
        for (int column = 0; column < 3 && coordinate_break != NULL; column++) {
            double v[3] = {all.turn[column], all.turn[3 + column], all.turn[6 + column]};
            matrix_turn(frame.turn, v, v);
            for (int row = 0; row < 3; row++) {
                all.turn[3 * row + column] = v[row];
            }
        }
        frames[i] = turned_back(&all);
    }
    /* counted from the last vertex, of a thick lens from H' */
    const double behind = surface_hiatus(&lens->surfaces[count - 1]).hi;
    double way[3] = {0, 0, system->options.image + behind}, moved[3];
    turn_back(all.turn, way, moved);
    for (int j = 0; j < 3 && !isnan(way[2]) && !system->options.reverse; j++) {
        all.shift[j] += moved[j];
    }
    frames[count] = turned_back(&all);
    return frames;
}

void system_to_own(const struct system *system, size_t surface, double point[3])
{
    const struct displacement *decentre =
        surface < system->lens->surface_count ? system->lens->surfaces[surface].decentre : NULL;
    if (decentre != NULL) {
        struct surface_frame frame = frame_of(decentre, 0);
        for (int i = 0; i < 3; i++) {
            point[i] -= frame.shift[i];
        }
        matrix_turn(frame.turn, point, point);
    }
}

void system_normal(const struct system *system, size_t surface, const double point[3],
                   double normal[3])
{
    normal[0] = normal[1] = 0;
    normal[2] = 1;
    if (surface >= system->lens->surface_count) {
        return;
    }
    const struct surface *s = &system->lens->surfaces[surface];
    struct surface_frame frame;
    double at[3] = {point[0], point[1], point[2]};
    if (s->decentre != NULL) {
        frame = frame_of(s->decentre, 0);
        system_to_own(system, surface, at);
    }
    if (surface_has(s, SURFACE_HAS_CURVE)) {
        double c = surface_base_curvature(s).hi, k = s->conic.value.hi;
        double wx = surface_section(s)->weight[0], wy = surface_section(s)->weight[1];
        struct departure S = surface_departure(s, wx * at[0] * at[0] + wy * at[1] * at[1]);
        double f = 1 - c * (1 + k) * (at[2] - S.value), g = c + 2 * f * S.slope;
        double nx = -wx * g * at[0], ny = -wy * g * at[1];
        double length = sqrt(nx * nx + ny * ny + f * f);
        normal[0] = nx / length;
        normal[1] = ny / length;
        normal[2] = f / length;
    }
    if (s->decentre != NULL) {
        turn_back(frame.turn, normal, normal);
    }
}

struct ray_angles ray_angles(const double normal[3], const double before[3], const double after[3])
{
    const double *rays[2] = {before, after};
    double angles[2];
    for (int i = 0; i < 2; i++) {
        const double *p = rays[i];
        double x = normal[1] * p[2] - normal[2] * p[1], y = normal[2] * p[0] - normal[0] * p[2];
        double z = normal[0] * p[1] - normal[1] * p[0];
        double along = normal[0] * p[0] + normal[1] * p[1] + normal[2] * p[2];
        angles[i] = atan2(sqrt(x * x + y * y + z * z), fabs(along));
    }
    return (struct ray_angles){angles[0], angles[1]};
}
