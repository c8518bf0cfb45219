/* file/scene_place.c - where things and cameras of a scene are, and how they move. */
/* SPDX-License-Identifier: MIT */
#include "base/turns.h"
#include "file/scene_reader.h"

/* Two directions lie along one line where the sine between them is less. */
#define LEAST_SINE 1e-6

static const struct frame upright = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

/*
 * Axes with this z, and y as near to `up` as can be. Without up=, y is near to the scene's y, and
 * what lies flat has its y away from who stands before it, as a sheet of paper on a table has.
 */
static bool face(const struct scene_line *line, struct vector z, struct frame *frame)
{
    const bool is_camera = scene_line_has(line, KEY_LOOK);
    struct vector up = {0, 1, 0};
    if (scene_line_has(line, KEY_UP) && !scene_line_direction(line, KEY_UP, &up)) {
        return false;
    }
    struct vector x = vector_cross(up, z);
    if (!(vector_length(x) >= LEAST_SINE)) {
        if (scene_line_has(line, KEY_UP) || is_camera) {
            scene_line_fail(line, scene_line_has(line, KEY_UP) ? KEY_UP : KEY_LOOK,
                            is_camera ? "the camera looks along its up=, so that no side is up"
                                      : "up= goes along the normal, so that no side is up");
            return !scene_line_has(line, KEY_UP) &&
                   error_hint(line->words->error, "up=0,0,-1 is one");
        }
        x = vector_cross((struct vector){0, 0, z.y > 0 ? -1 : 1}, z);
    }
    x = vector_unit(x);
    *frame = (struct frame){x, vector_cross(z, x), z};
    return true;
}

/* Turned about its own axis from y to z, z to x, x to y: the axis is the first of the three. */
static void scene_place_turn(struct vector *y, struct vector *z, double angle)
{
    double cosine, sine;
    turns_of(angle / (2 * PI), &cosine, &sine);
    const struct vector from = *y;
    *y = vector_along(vector_times(cosine, from), sine, *z);
    *z = vector_along(vector_times(cosine, *z), -sine, from);
}

static bool read_frame(const struct scene_line *line, struct scene_place *place)
{
    struct vector z = {0, 0, 1};
    if (scene_line_has(line, KEY_LOOK)) {
        z = vector_minus(place->at, scene_line_vector(line, KEY_LOOK));
        const double distance = vector_length(z);
        if (!(distance > 0)) {
            return scene_line_fail(line, KEY_LOOK, "the camera looks at its own place");
        }
        z = vector_times(1 / distance, z);
    }
    if (scene_line_has(line, KEY_NORMAL) && !scene_line_direction(line, KEY_NORMAL, &z)) {
        return false;
    }
    const uint64_t facing = SCENE_BIT(KEY_LOOK) | SCENE_BIT(KEY_NORMAL) | SCENE_BIT(KEY_UP);
    if ((line->given & facing) != 0 && !face(line, z, &place->turned)) {
        return false;
    }
    /* about x, then about the new y, then about the new z */
    struct frame *own = &place->turned;
    const double *angle = line->number[KEY_TURN];
    if (scene_line_has(line, KEY_TURN)) {
        scene_place_turn(&own->y, &own->z, angle[0]);
        scene_place_turn(&own->z, &own->x, angle[1]);
        scene_place_turn(&own->x, &own->y, angle[2]);
    }
    return true;
}

bool scene_place_read(const struct scene_line *line, struct scene_place *place)
{
    *place = (struct scene_place){.at = scene_line_vector(line, KEY_AT),
                                  .turned = upright,
                                  .velocity = scene_line_vector(line, KEY_MOVE),
                                  .axis = {0, 1, 0},
                                  .spin = line->number[KEY_SPIN][0]};
    if (scene_line_has(line, KEY_AXIS) && !scene_line_has(line, KEY_SPIN)) {
        return scene_line_fail(line, KEY_AXIS,
                               "axis= is of what spins, and there is no "
                               "spin=");
    }
    return read_frame(line, place) &&
           (!scene_line_has(line, KEY_AXIS) || scene_line_direction(line, KEY_AXIS, &place->axis));
}
