/* tests/scene/night.c - a room at night, of make demo: seven decades of light. */
/* SPDX-License-Identifier: MIT */
/*
 * night COLUMNS PICTURE.pfm: a room that a wall divides. A naked bulb lights its left half; the
 * right one has what the night sends through a window. The same balls lie in both, and the same
 * bars hang on the wall behind. Luminance in cd/m2, 3:2, seen at 40 degrees across.
 */
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>

enum { BALLS = 6, SUBPIXELS = 4 };

struct vector {
    double x, y, z; /* to the right, up, away from the camera; m */
};

static const double FLOOR = -1.1, CEILING = 1.7, SIDE = 2.3, BACK = 6, WALL = 0.25, WALL_FROM = 3.2;
static const struct vector bulb = {-1.0, 0.95, 4.6};
static const double BULB_RADIUS = 0.05, BULB_LIGHT = 8000, BULB_CANDELA = 60, NIGHT = 0.003;
static const struct {
    struct vector middle;
    double radius;
    struct vector colour;
} balls[BALLS] = {
    {{-1.45, -0.85, 5.1}, 0.25, {0.70, 0.05, 0.04}},
    {{-0.85, -0.88, 4.6}, 0.22, {0.75, 0.55, 0.05}},
    {{-0.30, -0.85, 5.3}, 0.25, {0.05, 0.15, 0.60}},
    {{0.70, -0.85, 5.1}, 0.25, {0.70, 0.05, 0.04}},
    {{1.15, -0.88, 4.6}, 0.22, {0.75, 0.55, 0.05}},
    {{1.70, -0.85, 5.3}, 0.25, {0.05, 0.15, 0.60}},
};

static struct vector add(struct vector a, double t, struct vector b)
{
    return (struct vector){a.x + t * b.x, a.y + t * b.y, a.z + t * b.z};
}

static double dot(struct vector a, struct vector b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static struct vector scaled(double by, struct vector a)
{
    return (struct vector){by * a.x, by * a.y, by * a.z};
}

/* How far a ray goes to a sphere; infinite: it passes. */
static double to_sphere(struct vector from, struct vector along, struct vector middle,
                        double radius)
{
    const struct vector to = add(middle, -1, from);
    const double a = dot(along, along), b = dot(to, along),
                 d = b * b - a * (dot(to, to) - radius * radius);
    const double t = d > 0 ? (b - sqrt(d)) / a : -1;
    return t > 1e-6 ? t : INFINITY;
}

/* To a plane at right angles to an axis. */
static double to_plane(double from, double along, double place)
{
    const double t = (place - from) / along;
    return t > 1e-6 ? t : INFINITY;
}

/* To the wall in the middle, which begins some way off. */
static double to_wall(struct vector from, struct vector along)
{
    const double t = to_plane(from.x, along.x, WALL);
    return from.z + t * along.z > WALL_FROM ? t : INFINITY;
}

/* What does a point see of the bulb, and of a ball? */
static bool is_free(struct vector at, struct vector to)
{
    bool is = to_wall(at, to) >= 1;
    for (int i = 0; i < BALLS && is; i++) {
        is = to_sphere(at, to, balls[i].middle, balls[i].radius) >= 1;
    }
    return is;
}

/* Luminance of a matt surface: the bulb, its light from the walls, the night by the window. */
static struct vector shade(struct vector at, struct vector normal, struct vector colour)
{
    static const struct vector warm = {1.25, 0.97, 0.55}, cold = {0.7, 1.0, 1.6};
    const struct vector to = add(bulb, -1, at);
    const double away = dot(to, to), facing = fmax(0, dot(normal, to)) / sqrt(away);
    const bool is_left = at.x < WALL || at.z < WALL_FROM;
    const double direct = is_free(add(at, 1e-4, normal), to) ? facing * BULB_CANDELA / away : 0;
    const double bounced = is_left ? 1.5 : 0.003 * exp(-1.5 * (at.z - WALL_FROM));
    const double night = NIGHT * (1 + normal.y) * (is_left ? 1 : 1 + 2 * exp(-pow(at.x - 1.4, 2)));
    const struct vector light = add(scaled((direct + bounced) / 3.14159, warm), night, cold);
    return (struct vector){colour.x * light.x, colour.y * light.y, colour.z * light.z};
}

/* Bars of three widths, one group below the other. */
static bool is_bar(double x, double y)
{
    const double cycles = 8 * exp2(floor((0.5 - y) * 3));
    return fabs(x) < 0.45 && fabs(y) < 0.5 && sin(2 * 3.14159265 * cycles * x) > 0;
}

static struct vector back(struct vector at)
{
    static const struct vector plaster = {0.5, 0.5, 0.48}, paper = {0.8, 0.8, 0.8},
                               ink = {0.05, 0.05, 0.05};
    static const struct vector normal = {0, 0, -1}, sky = {0.25, 0.4, 0.75};
    const double x = at.x - 1.72, y = at.y - 0.95, left = at.x + 1.45, right = at.x - 0.85;
    if (fabs(x) < 0.35 && fabs(y) < 0.45 && fabs(x) > 0.02 && fabs(y) > 0.02) {
        return scaled(0.10 + 0.05 * y, sky);
    }
    const double bar = fabs(left) < 0.5 ? left : right;
    const bool is_paper = fabs(bar) < 0.5 && fabs(at.y - 0.1) < 0.55;
    return shade(at, normal, is_paper ? is_bar(bar, at.y - 0.1) ? ink : paper : plaster);
}

static struct vector room(struct vector along)
{
    static const struct vector from = {0, 0, 0}, wood = {0.40, 0.26, 0.14},
                               dark = {0.16, 0.10, 0.06};
    static const struct vector plaster = {0.55, 0.53, 0.5};
    const double side = along.x > 0 ? 1 : -1, up = along.y > 0 ? 1 : -1;
    const double t[] = {to_plane(0, along.z, BACK), to_plane(0, along.y, up > 0 ? CEILING : FLOOR),
                        to_plane(0, along.x, side * SIDE), to_wall(from, along)};
    int first = 0;
    for (int i = 1; i < 4; i++) {
        first = t[i] < t[first] ? i : first;
    }
    const struct vector at = scaled(t[first], along);
    const bool is_wood = fmod(floor(at.x / 0.4) + floor(at.z / 0.4) + 1000, 2) == 0;
    switch (first) {
    case 0:
        return back(at);
    case 1:
        return shade(at, (struct vector){0, -up, 0}, up > 0 ? plaster : is_wood ? wood : dark);
    case 2:
        return shade(at, (struct vector){-side, 0, 0}, plaster);
    default:
        return shade(at, (struct vector){along.x > 0 ? -1 : 1, 0, 0}, plaster);
    }
}

static struct vector look(struct vector along)
{
    const double wall = to_wall((struct vector){0, 0, 0}, along);
    double nearest = to_sphere((struct vector){0, 0, 0}, along, bulb, BULB_RADIUS);
    int which = -1;
    for (int i = 0; i < BALLS; i++) {
        const double t =
            to_sphere((struct vector){0, 0, 0}, along, balls[i].middle, balls[i].radius);
        which = t < nearest ? i : which;
        nearest = fmin(t, nearest);
    }
    if (!(nearest < wall)) {
        return room(along);
    }
    const struct vector at = scaled(nearest, along);
    return which < 0 ? (struct vector){1.2 * BULB_LIGHT, 0.97 * BULB_LIGHT, 0.7 * BULB_LIGHT}
                     : shade(at, scaled(1 / balls[which].radius, add(at, -1, balls[which].middle)),
                             balls[which].colour);
}

int main(int count, char **words)
{
    const int columns = count == 3 ? atoi(words[1]) : 0, rows = columns * 2 / 3;
    FILE *file = rows > 0 ? fopen(words[2], "wb") : NULL;
    if (file == NULL) {
        fprintf(stderr, "usage: night COLUMNS PICTURE.pfm\n");
        return 2;
    }
    fprintf(file, "PF\n%d %d\n-1.0\n", columns, rows);
    const double wide = 2 * tan(20 * 3.14159265358979 / 180);
    for (int row = rows - 1; row >= 0; row--) {
        for (int column = 0; column < columns; column++) {
            struct vector sum = {0, 0, 0};
            for (int i = 0; i < SUBPIXELS * SUBPIXELS; i++) {
                const double x = column + (i % SUBPIXELS + 0.5) / SUBPIXELS;
                const double y = row + (i / SUBPIXELS + 0.5) / SUBPIXELS;
                sum = add(sum, 1.0 / (SUBPIXELS * SUBPIXELS),
                          look((struct vector){(x / columns - 0.5) * wide,
                                               (0.5 - y / rows) * wide * 2 / 3, 1}));
            }
            const float colour[3] = {(float)sum.x, (float)sum.y, (float)sum.z};
            fwrite(colour, sizeof colour, 1, file);
        }
    }
    return fclose(file) == 0 ? 0 : 1;
}
