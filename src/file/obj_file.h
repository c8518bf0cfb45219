/* file/obj_file.h - triangles out of Wavefront's .obj files. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_FILE_OBJ_FILE_H
#define LENSCALC_FILE_OBJ_FILE_H

#include "base/arena.h"
#include "base/error.h"
#include "base/text.h"
#include "scene/scene.h"

#include <stdbool.h>

struct obj_question {
    const char *source; /* for messages */
    double scale;       /* mm, of 1 in the file */
    double farthest;    /* mm: corners lie within it */
    size_t most;        /* triangles */
};

/* What a file has that is passed over. */
struct obj_passed {
    bool materials, lines, colours;
    size_t unplaced; /* triangles with a corner that has no place in a texture, where others have */
    size_t crossed;  /* faces that cross themselves, or have no area: fans about their first */
    size_t twice;    /* triangles whose corners lie where those of another one do */
};

/*
 * Read the faces of a file: v, vt, vn and f; names, groups and materials are passed over.
 *
 * Given     content  the file; nothing points into it afterwards
 *           arena    receives what the mesh points to
 * Result    faces of more than three corners are cut by polygon_triangles. A corner is one set of
 *           position, place and normal. Where faces lack normals that others have, or have one
 *           without length, their corners have that of the face. Of triangles whose corners lie
 *           at the same three places, in any order, the first one is left
 * Source    [Wavefront92] appendix B1
 * Errors    ERROR_DATA with line and column: an unknown word, no number, a corner that is not
 *           there, a face of less than three, free-form surfaces, no face at all, too many
 */
bool obj_read(const struct obj_question *question, struct text content, struct arena *arena,
              struct scene_mesh *mesh, struct obj_passed *passed, struct error *error);

#endif
