/* scene/rectangle.c - rectangles sampled evenly in solid angle. */
/* SPDX-License-Identifier: MIT */
#include "scene/rectangle.h"

#include "base/constants.h"

/*
 * From here on by the solid angle: sums of angles lose digits in smaller ones, in which the area
 * does as well.
 */
#define LEAST_SOLID_ANGLE 1e-3

/* As a point sees it: edges in the rectangle's own axes; z of its plane, 0 or less. */
struct aspect {
    double x[2], y[2], z;
};

static struct aspect aspect_of(const struct rectangle *rectangle, struct vector from)
{
    const struct vector to = vector_minus(rectangle->at, from);
    const struct vector own = frame_in(&rectangle->axes, to);
    return (struct aspect){{own.x - rectangle->half[0], own.x + rectangle->half[0]},
                           {own.y - rectangle->half[1], own.y + rectangle->half[1]},
                           -fabs(own.z)};
}

/* Of the corner between two edges, from the foot of the perpendicular on. */
static double corner_angle(double x, double y, double z)
{
    return atan2(x * y, -z * sqrt(x * x + y * y + z * z));
}

static double solid_angle(const struct aspect *aspect)
{
    return corner_angle(aspect->x[1], aspect->y[1], aspect->z) -
           corner_angle(aspect->x[0], aspect->y[1], aspect->z) -
           corner_angle(aspect->x[1], aspect->y[0], aspect->z) +
           corner_angle(aspect->x[0], aspect->y[0], aspect->z);
}

/* Is it seen large enough for angles, and from beside its plane? */
static bool is_large(const struct aspect *aspect, double solid)
{
    return solid >= LEAST_SOLID_ANGLE && aspect->z < 0;
}

double rectangle_solid_angle(const struct rectangle *rectangle, struct vector from)
{
    const struct aspect aspect = aspect_of(rectangle, from);
    const double solid = solid_angle(&aspect);
    if (is_large(&aspect, solid)) {
        return solid;
    }
    const struct vector to = vector_minus(rectangle->at, from);
    const double square = vector_dot(to, to);
    const double area = 4 * rectangle->half[0] * rectangle->half[1];
    return square > 0 ? area * -aspect.z / (square * sqrt(square)) : 0;
}

static double rectangle_within(double value, const double limits[2])
{
    if (value < limits[0]) {
        return limits[0];
    }
    if (value > limits[1]) {
        return limits[1];
    }
    return value;
}

/* Cosine between the plane through the point and an edge, and the rectangle. */
static double edge_cosine(double edge, double z)
{
    return edge / sqrt(edge * edge + z * z);
}

/* Where the part of the rectangle left of x has the share u of its solid angle. */
static double x_of_share(const struct aspect *aspect, double u)
{
    const double below = -edge_cosine(aspect->y[0], aspect->z);
    const double above = edge_cosine(aspect->y[1], aspect->z);
    const double left = -edge_cosine(aspect->x[0], aspect->z);
    const double right = edge_cosine(aspect->x[1], aspect->z);
    const double known = 2 * PI - acos(-above * left) - acos(-left * below);
    const double solid = acos(-below * right) + acos(-right * above) - known;
    const double angle = u * solid + known;
    const double slope = (cos(angle) * below - above) / sin(angle);
    const double cosine = fmin(1, 1 / sqrt(slope * slope + below * below));
    const double x = -aspect->z * cosine / sqrt(fmax(1 - cosine * cosine, 1e-30));
    return rectangle_within(copysign(x, slope), aspect->x);
}

/* On the line at this x, even in the solid angle: sines of its angle are even. */
static double y_of_share(const struct aspect *aspect, double x, double u)
{
    const double far = sqrt(x * x + aspect->z * aspect->z);
    const double low = aspect->y[0] / sqrt(far * far + aspect->y[0] * aspect->y[0]);
    const double high = aspect->y[1] / sqrt(far * far + aspect->y[1] * aspect->y[1]);
    const double sine = low + u * (high - low);
    return rectangle_within(far * sine / sqrt(fmax(1 - sine * sine, 1e-30)), aspect->y);
}

struct vector rectangle_sample(const struct rectangle *rectangle, struct vector from,
                               const double u[2], double shares[2])
{
    const struct aspect aspect = aspect_of(rectangle, from);
    const double *half = rectangle->half;
    shares[0] = 2 * u[0] - 1;
    shares[1] = 2 * u[1] - 1;
    if (is_large(&aspect, solid_angle(&aspect))) {
        const double x = x_of_share(&aspect, u[0]), y = y_of_share(&aspect, x, u[1]);
        shares[0] = (x - (aspect.x[0] + aspect.x[1]) / 2) / half[0];
        shares[1] = (y - (aspect.y[0] + aspect.y[1]) / 2) / half[1];
    }
    const struct vector own = {shares[0] * half[0], shares[1] * half[1], 0};
    return vector_along(rectangle->at, 1, frame_out(&rectangle->axes, own));
}

double rectangle_pdf(const struct rectangle *rectangle, struct vector from, struct vector direction,
                     double distance)
{
    const struct aspect aspect = aspect_of(rectangle, from);
    const double solid = solid_angle(&aspect);
    if (is_large(&aspect, solid)) {
        return 1 / solid;
    }
    const double area = 4 * rectangle->half[0] * rectangle->half[1];
    const double seen = area * fabs(vector_dot(rectangle->axes.z, direction));
    return seen > 0 ? distance * distance / seen : 0;
}
