/* scene/rectangle.c - rectangles by their solid angle. */
/* SPDX-License-Identifier: MIT */
#include "scene/rectangle.h"

#include "base/constants.h"

/*
 * From here on by the solid angle: sums of angles lose digits in smaller ones, in which the area
 * does as well.
 */
#define LEAST_SOLID_ANGLE 1e-3

/* As a point sees it: edges in the rectangle's own axes; z of its plane, 0 or less. */
struct view {
    double x[2], y[2], z;
};

static struct view view_of(const struct rectangle *rectangle, struct vector from)
{
    const struct vector to = vector_minus(rectangle->at, from);
    const struct vector own = frame_in(&rectangle->axes, to);
    return (struct view){{own.x - rectangle->half[0], own.x + rectangle->half[0]},
                         {own.y - rectangle->half[1], own.y + rectangle->half[1]},
                         -fabs(own.z)};
}

/* Of the corner between two edges, from the foot of the perpendicular on. */
static double corner_angle(double x, double y, double z)
{
    return atan2(x * y, -z * sqrt(x * x + y * y + z * z));
}

static double solid_angle(const struct view *view)
{
    return corner_angle(view->x[1], view->y[1], view->z) -
           corner_angle(view->x[0], view->y[1], view->z) -
           corner_angle(view->x[1], view->y[0], view->z) +
           corner_angle(view->x[0], view->y[0], view->z);
}

/* Is it seen large enough for angles, and from beside its plane? */
static bool is_large(const struct view *view, double solid)
{
    return solid >= LEAST_SOLID_ANGLE && view->z < 0;
}

double rectangle_seen(const struct rectangle *rectangle, struct vector from)
{
    const struct view view = view_of(rectangle, from);
    const double solid = solid_angle(&view);
    if (is_large(&view, solid)) {
        return solid;
    }
    const struct vector to = vector_minus(rectangle->at, from);
    const double square = vector_dot(to, to);
    const double area = 4 * rectangle->half[0] * rectangle->half[1];
    return square > 0 ? area * -view.z / (square * sqrt(square)) : 0;
}

static double within(double value, const double limits[2])
{
    return value < limits[0] ? limits[0] : value > limits[1] ? limits[1] : value;
}

/* Cosine between the plane through the point and an edge, and the rectangle. */
static double edge_cosine(double edge, double z)
{
    return edge / sqrt(edge * edge + z * z);
}

/* Where the part of the rectangle left of x has the share u of its solid angle. */
static double x_of_share(const struct view *view, double u)
{
    const double below = -edge_cosine(view->y[0], view->z);
    const double above = edge_cosine(view->y[1], view->z);
    const double left = -edge_cosine(view->x[0], view->z);
    const double right = edge_cosine(view->x[1], view->z);
    const double known = 2 * PI - acos(-above * left) - acos(-left * below);
    const double solid = acos(-below * right) + acos(-right * above) - known;
    const double angle = u * solid + known;
    const double slope = (cos(angle) * below - above) / sin(angle);
    const double cosine = fmin(1, 1 / sqrt(slope * slope + below * below));
    const double x = -view->z * cosine / sqrt(fmax(1 - cosine * cosine, 1e-30));
    return within(copysign(x, slope), view->x);
}

/* On the line at this x, even in the solid angle: sines of its angle are even. */
static double y_of_share(const struct view *view, double x, double u)
{
    const double far = sqrt(x * x + view->z * view->z);
    const double low = view->y[0] / sqrt(far * far + view->y[0] * view->y[0]);
    const double high = view->y[1] / sqrt(far * far + view->y[1] * view->y[1]);
    const double sine = low + u * (high - low);
    return within(far * sine / sqrt(fmax(1 - sine * sine, 1e-30)), view->y);
}

struct vector rectangle_sample(const struct rectangle *rectangle, struct vector from,
                               const double u[2], double shares[2])
{
    const struct view view = view_of(rectangle, from);
    const double *half = rectangle->half;
    shares[0] = 2 * u[0] - 1;
    shares[1] = 2 * u[1] - 1;
    if (is_large(&view, solid_angle(&view))) {
        const double x = x_of_share(&view, u[0]), y = y_of_share(&view, x, u[1]);
        shares[0] = (x - (view.x[0] + view.x[1]) / 2) / half[0];
        shares[1] = (y - (view.y[0] + view.y[1]) / 2) / half[1];
    }
    const struct vector own = {shares[0] * half[0], shares[1] * half[1], 0};
    return vector_along(rectangle->at, 1, frame_out(&rectangle->axes, own));
}

double rectangle_density(const struct rectangle *rectangle, struct vector from, struct vector way,
                         double distance)
{
    const struct view view = view_of(rectangle, from);
    const double solid = solid_angle(&view);
    if (is_large(&view, solid)) {
        return 1 / solid;
    }
    const double area = 4 * rectangle->half[0] * rectangle->half[1];
    const double seen = area * fabs(vector_dot(rectangle->axes.z, way));
    return seen > 0 ? distance * distance / seen : 0;
}
