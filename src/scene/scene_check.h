/* scene/scene_check.h - what a scene lacks where nothing of it can be seen. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_SCENE_SCENE_CHECK_H
#define LENSCALC_SCENE_SCENE_CHECK_H

#include "base/error.h"
#include "scene/scene.h"

#include <stdbool.h>

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
