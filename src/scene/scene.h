/* scene/scene.h - what is photographed, as it is written: things, colours, light, a camera. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_SCENE_SCENE_H
#define LENSCALC_SCENE_SCENE_H

#include "base/digest.h"
#include "base/error.h"
#include "base/image/image.h"
#include "base/text.h"
#include "light/spectrum.h"
#include "scene/vector.h"

#include <stdbool.h>
#include <stddef.h>

/* -------- where things are -------- */

/*
 * A place at the time 0, in the middle of the exposure, and how it changes: at the time t, s, the
 * thing is turned by `spin` t about `axis` through `at`, and then moved by velocity t.
 */
struct scene_place {
    struct vector at;       /* of its own origin, mm */
    struct frame turned;    /* its own axes */
    struct vector velocity; /* mm/s */
    struct vector axis;     /* of length 1, right-handed, in the scene's coordinates */
    double spin;            /* rad/s */
};

/* Where something is at one time. */
struct scene_pose {
    struct vector at;
    struct frame turned;
};

/*
 * Given     time  s
 * Formula   turned by the angle spin t about the axis by Rodrigues' formula, then moved
 */
struct scene_pose scene_pose_at(const struct scene_place *place, double time);

static inline bool scene_place_moves(const struct scene_place *place)
{
    const struct vector v = place->velocity;
    return v.x != 0 || v.y != 0 || v.z != 0 || place->spin != 0;
}

/* -------- what they are made of -------- */

enum scene_material_kind {
    MATERIAL_LAMBERT, /* scatters alike in all directions */
    MATERIAL_MIRROR,
    MATERIAL_GLOSSY, /* a coat of roughness over a Lambertian ground */
    MATERIAL_BLACK   /* reflects nothing: what shines only */
};

struct scene_material {
    const char *name;
    enum scene_material_kind kind;
    struct spectrum colour;      /* share that is reflected, in all directions together */
    const struct image *texture; /* times it, linear sRGB, 0 to 1, three channels; null: none */
    double roughness;            /* of a glossy one: alpha of GGX, 0.001 to 1 */
    double index;                /* refractive index of its coat; 1 to 3 */
    struct spectrum emission;    /* kind SPECTRUM_NONE: it does not shine */
    double luminance;            /* of what shines, towards both sides of flat things, cd/m^2 */
    struct typed_place place;    /* where it is written, for messages */
};

/* -------- things -------- */

enum scene_shape {
    SHAPE_PLANE,  /* z = 0 of its own frame, without end */
    SHAPE_DISC,   /* within `radius` of it */
    SHAPE_CARD,   /* within size.x x size.y of it, about its middle; may have alpha */
    SHAPE_SPHERE, /* of `radius` */
    SHAPE_BOX,    /* of `size`, about its middle */
    SHAPE_MESH
};

/* Triangles; corners are numbered from 0. */
struct scene_mesh {
    const char *file;
    size_t corner_count, triangle_count;
    const struct vector *corners; /* mm, in the frame of the thing */
    const struct vector *normals; /* of the corners, of length 1; null: each triangle has its own */
    const double (*places)[2];    /* of the corners in the texture, which
                                     goes on beyond 0 to 1 anew; null: none */
    const size_t (*triangles)[3];
};

struct scene_thing {
    enum scene_shape shape;
    struct scene_place where;
    double radius;               /* mm, > 0 */
    struct vector size;          /* mm, > 0 */
    double repeat[2];            /* of a plane: width and height of a texture on it, mm; 0: none */
    const struct image *picture; /* of a card: its light, with white 1, in place of a material;
                                    three channels, or four: the last is alpha, its share of what
                                    is there */
    bool shines;                 /* a card whose picture is light, of white `luminance`; else it is
                                    a Lambertian surface of that colour */
    double luminance;            /* cd/m^2 */
    double mean;                 /* of the picture: luminance over that of white */
    const struct scene_mesh *mesh;
    size_t material; /* in the scene's list; of cards with a picture none: SCENE_NONE */
    struct typed_place place;
};

#define SCENE_NONE ((size_t)-1)

/* -------- light -------- */

enum scene_light_kind {
    LIGHT_SUN,         /* a disc infinitely far away */
    LIGHT_SKY,         /* as bright as `sky` has it, above the horizon */
    LIGHT_POINT,       /* alike in all directions */
    LIGHT_ENVIRONMENT, /* a picture all around: longitude from left to right, z = -1 in its middle,
                          latitude from top (y = 1) to bottom */
    LIGHT_STAR         /* a disc infinitely far away, as wide as rays can find it */
};

enum scene_sky {
    SKY_UNIFORM,
    SKY_OVERCAST, /* three times as bright in the zenith as at the horizon */
    SKY_CLEAR     /* brighter about the sun, darkest away from it */
};

struct scene_light {
    enum scene_light_kind kind;
    struct spectrum spectrum;
    enum scene_sky sky;
    struct vector direction; /* towards it, of length 1 */
    struct vector at;        /* of a point, mm */
    struct vector velocity;  /* mm/s */
    double diameter;         /* of a sun or star, rad, > 0; NaN: a star does not say, and has none
                                until somebody looks */
    double amount; /* sun and star: illuminance of a plane that faces it, lx; sky: luminance in the
                      zenith, cd/m^2; environment: of its white; point: intensity, cd */
    const struct image *picture; /* of an environment: linear sRGB, three channels */
    double mean;                 /* its mean luminance over that of white */
    double turn;                 /* of it about y, rad */
    struct typed_place place;
};

/* -------- the camera -------- */

/* Places of a camera that distances are counted from; the first is where it stands. */
enum scene_from {
    SCENE_FROM_ENTRANCE, /* the entrance pupil, `at` */
    SCENE_FROM_PRINCIPAL,
    SCENE_FROM_SENSOR,
    SCENE_FROM_FRONT, /* the first vertex */
    SCENE_FROMS
};

/*
 * The camera's own axes are x to the right, y up and z backwards; `at` is the centre of its
 * entrance pupil, about which the picture's perspective is.
 */
struct scene_camera {
    struct scene_place where;
    double distance;      /* on which it is focused, mm; NaN: not said */
    enum scene_from from; /* where that is counted from */
};

struct scene {
    const char *source; /* name of the file */
    const char *title;  /* null: none */
    struct scene_camera camera;
    struct scene_material *materials;
    size_t material_count;
    struct scene_thing *things;
    size_t thing_count;
    struct scene_light *lights;
    size_t light_count;
    const char **notes; /* what of its files is passed over, a line each */
    size_t note_count;
    struct digest_name digest; /* of the file and of all that it names */
};

/* Does anything move: a thing, a light, the camera? */
bool scene_moves(const struct scene *scene);

/* -------- what a scene lacks where nothing of it can be seen -------- */

/* Does a thing send on light that it receives? */
bool scene_reflects(const struct scene *scene, const struct scene_thing *thing);

/*
 * Refuse a scene whose every picture would be black.
 *
 * Given     bounces  how often light may be scattered: 0 is what shines, seen by itself
 * Errors    ERROR_DATA with the scene's file: nothing shines, pictures that would
 *           are black, or nothing is there that light which
 *           cannot be seen by itself, a point's, may fall on
 */
bool scene_check(const struct scene *scene, int bounces, struct error *error);

#endif
