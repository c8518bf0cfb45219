/* file/scene_file.h - read .scene files; the format is described in lenscalc-scene.5. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_FILE_SCENE_FILE_H
#define LENSCALC_FILE_SCENE_FILE_H

#include "base/arena.h"
#include "base/error.h"
#include "base/text.h"
#include "scene/scene.h"

#include <stdbool.h>

enum {
    SCENE_THINGS_MOST = 1000000,
    SCENE_LIGHTS_MOST = 100000,
    SCENE_MATERIALS_MOST = 100000,
    SCENE_COLOURS_MOST = 100000,
    SCENE_TRIANGLES_MOST = 5000000 /* of all meshes */
};

/* Who opens the pictures, meshes and tables that a scene names. */
struct scene_files {
    /* All that a file holds; a path from where the program runs */
    bool (*read)(void *context, const char *path, struct arena *arena, struct text *content,
                 struct error *error);
    void *context;
};

/* Files as they lie on the disk. */
extern const struct scene_files scene_files_there;

/*
 * Read a scene.
 *
 * Given     path     of the file, for messages and for what lies beside it
 *           content  the file; the scene points into it
 *           files    null: whatever it names is refused
 *           scene    receives the scene; what it points to lies in the arena
 * Errors    ERROR_DATA with line, column and caret: an unknown word, a number beyond its range, a
 *           material or a colour that no line above has, a file that is missing or bad, no camera;
 *           scene_check has not run. Of a mesh or a table file, line and column are its own
 */
bool scene_file_read(const char *path, struct text content, const struct scene_files *files,
                     struct arena *arena, struct scene *scene, struct error *error);

#endif
