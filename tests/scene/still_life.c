/* tests/scene/still_life.c - the still life of make demo: a picture with its depths. */
/* SPDX-License-Identifier: MIT */
/*
 * still_life COLUMNS PICTURE.pfm DEPTHS.pfm: spheres on a chequered table before lights far away,
 * seen from the entrance pupil of a camera, 3:2, 1.5 as wide as it is far. Light is linear, white
 * paper about 1; depths are in m from a sensor 75 mm behind the pupil.
 */
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>

enum { SHADOW_RAYS = 16, SPHERES = 9, LAMPS = 70 };
static const double WIDTH = 1.5, TABLE = -0.16, WALL = 7, SENSOR = 0.075;

struct vector {
    double x, y, z; /* to the right, up, away from the camera; m */
};

static struct vector add(struct vector a, double t, struct vector b)
{
    return (struct vector){a.x + t * b.x, a.y + t * b.y, a.z + t * b.z};
}

static double dot(struct vector a, struct vector b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static struct vector unit(struct vector a)
{
    return add((struct vector){0, 0, 0}, 1 / sqrt(dot(a, a)), a);
}

static struct vector times(struct vector a, struct vector b)
{
    return (struct vector){a.x * b.x, a.y * b.y, a.z * b.z};
}

/* -------- what stands there -------- */

struct sphere {
    struct vector middle;
    double radius;
    struct vector colour;
    double polish; /* reflected at right angles */
    bool shines;
};

static struct sphere things[SPHERES + LAMPS];

/* A number of 0 to 1 that looks like chance. */
static double chance(int i, int j)
{
    const double x = sin(i * 12.9898 + j * 78.233) * 43758.5453;
    return x - floor(x);
}

static void place_things(void)
{
    static const struct sphere on_table[SPHERES] = {
        {{-0.24, 0, 0.72}, 0.07, {0.72, 0.06, 0.05}, 0.05, false},
        {{0.015, 0, 1.00}, 0.10, {0.85, 0.55, 0.14}, 0.10, false},
        {{0.30, 0, 1.28}, 0.11, {0.06, 0.22, 0.62}, 0.06, false},
        {{-0.28, 0, 1.55}, 0.12, {0.10, 0.45, 0.16}, 0.06, false},
        {{0.17, 0, 0.60}, 0.035, {0.80, 0.80, 0.78}, 0.30, false},
        {{0.03, 0, 2.10}, 0.13, {0.70, 0.68, 0.66}, 0.05, false},
        {{0.66, 0, 2.00}, 0.14, {0.60, 0.12, 0.32}, 0.05, false},
        {{-0.85, 0, 2.30}, 0.16, {0.75, 0.35, 0.08}, 0.05, false},
        {{-0.05, 0, 0.74}, 0.028, {0.10, 0.45, 0.50}, 0.08, false},
    };
    for (int i = 0; i < SPHERES; i++) {
        things[i] = on_table[i];
        things[i].middle.y = TABLE + things[i].radius;
    }
    for (int i = 0; i < LAMPS; i++) {
        const double warm = chance(i, 3);
        things[SPHERES + i] = (struct sphere){
            {7.6 * (chance(i, 1) - 0.5), 0.15 + 1.9 * chance(i, 2), 4.6 + 1.8 * chance(i, 4)},
            0.011,
            {14 + 10 * warm, 10 + 4 * warm, 14 - 11 * warm},
            0,
            true};
    }
}

/* -------- what a ray meets -------- */

struct meeting {
    double t; /* as many directions away; infinite: nothing */
    const struct sphere *sphere;
    bool is_table;
};

static struct meeting meet(struct vector from, struct vector along)
{
    struct meeting first = {INFINITY, NULL, false};
    const double down = (TABLE - from.y) / along.y;
    if (down > 1e-6 && from.z + down * along.z < 3.2) {
        first = (struct meeting){down, NULL, true};
    }
    for (int i = 0; i < SPHERES + LAMPS; i++) {
        const struct vector to = add(things[i].middle, -1, from);
        const double a = dot(along, along), b = dot(to, along);
        const double c = dot(to, to) - things[i].radius * things[i].radius, d = b * b - a * c;
        const double t = d > 0 ? (b - sqrt(d)) / a : -1;
        if (t > 1e-6 && t < first.t) {
            first = (struct meeting){t, &things[i], false};
        }
    }
    return first;
}

/* -------- light -------- */

/* What lies behind everything: a wall at dusk, brighter where a window throws light on it. */
static struct vector wall(struct vector along)
{
    const double up = along.y / along.z, side = along.x / along.z + 0.3;
    const double glow = exp(-6 * (up - 0.12) * (up - 0.12) - 1.5 * side * side);
    return (struct vector){0.014 + 0.13 * glow, 0.014 + 0.08 * glow, 0.030 + 0.06 * glow};
}

/* Of a large lamp up on the left before the things, seen from a point: how much of it is free. */
static double free_of_shadow(struct vector at, struct vector lamp, int seed)
{
    double share = 0;
    for (int i = 0; i < SHADOW_RAYS; i++) {
        const struct vector to = {lamp.x + 0.5 * ((i % 4 + chance(seed, i)) / 4 - 0.5), lamp.y,
                                  lamp.z + 0.5 * ((i / 4 + chance(i, seed)) / 4 - 0.5)};
        const struct meeting met = meet(at, add(to, -1, at));
        share += met.t >= 1 ? 1.0 / SHADOW_RAYS : 0;
    }
    return share;
}

static struct vector look(struct vector from, struct vector along, int seed, int depth,
                          double *distance);

static struct vector surface(struct vector at, struct vector normal, struct vector colour, int seed)
{
    static const struct vector lamp = {-1.1, 1.5, 0.3};
    const struct vector to = add(lamp, -1, at), towards = unit(to);
    const double facing = fmax(0, dot(normal, towards)) * 2.6 / dot(to, to);
    const double direct = facing > 0 ? facing * free_of_shadow(at, lamp, seed) : 0;
    const double sky = 0.12 + 0.10 * normal.y;
    return times(colour,
                 (struct vector){1.06 * direct + sky, direct + sky, 0.88 * direct + 1.15 * sky});
}

static struct vector table(struct vector at, int seed)
{
    const bool is_light = fmod(floor(at.x / 0.08) + floor(at.z / 0.08) + 1000, 2) == 0;
    const struct vector light = {0.70, 0.62, 0.50}, dark = {0.20, 0.12, 0.08};
    return surface(at, (struct vector){0, 1, 0}, is_light ? light : dark, seed);
}

static struct vector ball(const struct sphere *sphere, struct vector at, struct vector along,
                          int seed, int depth)
{
    const struct vector normal = unit(add(at, -1, sphere->middle));
    const struct vector inward = unit(along);
    const double grazing = 1 + dot(inward, normal);
    const double mirror = sphere->polish + (1 - sphere->polish) * pow(fmax(0, grazing), 5);
    struct vector seen = surface(at, normal, sphere->colour, seed);
    if (depth > 0) {
        double ignored;
        const struct vector back = add(inward, -2 * dot(inward, normal), normal);
        seen = add(seen, mirror, look(at, back, seed, depth - 1, &ignored));
        /* the large lamp, mirrored */
        const struct vector towards = unit(add((struct vector){-1.1, 1.5, 0.3}, -1, at));
        const double shine = 9 * exp(-90 * (1 - dot(back, towards)));
        seen = add(seen, shine * mirror, (struct vector){1.1, 1, 0.9});
    }
    return seen;
}

static struct vector look(struct vector from, struct vector along, int seed, int depth,
                          double *distance)
{
    const struct meeting met = meet(from, along);
    const struct vector at = add(from, met.t, along);
    *distance = met.t;
    if (met.is_table) {
        return table(at, seed);
    }
    if (met.sphere != NULL) {
        return met.sphere->shines ? met.sphere->colour : ball(met.sphere, at, along, seed, depth);
    }
    *distance = WALL;
    return wall(along.z > 0 ? along : (struct vector){along.x, along.y, 0.5});
}

/* -------- files -------- */

static FILE *begin(const char *path, const char *kind, int columns, int rows)
{
    FILE *file = fopen(path, "wb");
    if (file == NULL) {
        perror(path);
        exit(1);
    }
    fprintf(file, "%s\n%d %d\n-1.0\n", kind, columns, rows);
    return file;
}

static void end(FILE *file, const char *path)
{
    if (fclose(file) != 0) {
        perror(path);
        exit(1);
    }
}

int main(int count, char **words)
{
    const int columns = count == 4 ? atoi(words[1]) : 0, rows = columns * 2 / 3;
    if (rows < 1) {
        fprintf(stderr, "usage: still_life COLUMNS PICTURE.pfm DEPTHS.pfm\n");
        return 2;
    }
    place_things();
    FILE *picture = begin(words[2], "PF", columns, rows);
    FILE *depths = begin(words[3], "Pf", columns, rows);
    for (int row = rows - 1; row >= 0; row--) {
        for (int column = 0; column < columns; column++) {
            const struct vector along = {((column + 0.5) / columns - 0.5) * WIDTH,
                                         (0.5 - (row + 0.5) / rows) * WIDTH * 2 / 3, 1};
            double distance;
            const struct vector light =
                look((struct vector){0, 0, 0}, along, row * columns + column, 2, &distance);
            const float colour[3] = {(float)light.x, (float)light.y, (float)light.z};
            const float depth = (float)(distance + SENSOR);
            fwrite(colour, sizeof colour, 1, picture);
            fwrite(&depth, sizeof depth, 1, depths);
        }
    }
    end(picture, words[2]);
    end(depths, words[3]);
    return 0;
}
