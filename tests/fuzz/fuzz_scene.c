/* tests/fuzz/fuzz_scene.c - .scene files: read, check, make ready for rays, look. */
/* SPDX-License-Identifier: MIT */
/*
 * The input up to its first NUL byte is the scene; what stands behind it is what every file holds
 * that the scene names: a mesh, a table or a picture.
 */
#include "file/scene_file.h"
#include "fuzz.h"
#include "scene/scene.h"
#include "scene/world.h"

#include <math.h>

static bool read_rest(void *context, const char *path, struct arena *arena, struct text *content,
                      struct error *error)
{
    (void)path;
    (void)arena;
    (void)error;
    *content = *(const struct text *)context;
    return true;
}

static void require_unit(struct vector a)
{
    REQUIRE(fabs(vector_length(a) - 1) < 1e-12);
}

static void require_place(const struct scene_place *place)
{
    const struct frame *own = &place->turned;
    REQUIRE(isfinite(vector_length(place->at)) && isfinite(vector_length(place->velocity)));
    REQUIRE(isfinite(place->spin));
    require_unit(place->axis);
    require_unit(own->x);
    require_unit(own->y);
    require_unit(own->z);
    REQUIRE(vector_length(vector_minus(vector_cross(own->x, own->y), own->z)) < 1e-12);
}

static void require_mesh(const struct scene_mesh *mesh)
{
    REQUIRE(mesh->triangle_count > 0 && mesh->triangle_count <= SCENE_TRIANGLES_MOST);
    for (size_t i = 0; i < mesh->triangle_count; i++) {
        for (int k = 0; k < 3; k++) {
            REQUIRE(mesh->triangles[i][k] < mesh->corner_count);
        }
    }
    for (size_t i = 0; i < mesh->corner_count; i++) {
        REQUIRE(isfinite(vector_length(mesh->corners[i])));
        REQUIRE(mesh->places == NULL ||
                (isfinite(mesh->places[i][0]) && isfinite(mesh->places[i][1])));
        if (mesh->normals != NULL) {
            require_unit(mesh->normals[i]);
        }
    }
}

static void require_scene(const struct scene *scene)
{
    require_place(&scene->camera.where);
    for (size_t i = 0; i < scene->material_count; i++) {
        const struct scene_material *material = &scene->materials[i];
        REQUIRE(material->kind != MATERIAL_GLOSSY ||
                (material->roughness >= 0.001 && material->roughness <= 1));
        REQUIRE((material->emission.kind != SPECTRUM_NONE) == (material->luminance > 0));
    }
    for (size_t i = 0; i < scene->thing_count; i++) {
        const struct scene_thing *thing = &scene->things[i];
        require_place(&thing->where);
        REQUIRE((thing->picture != NULL) == (thing->material == SCENE_NONE));
        REQUIRE(thing->material == SCENE_NONE || thing->material < scene->material_count);
        REQUIRE((thing->shape == SHAPE_MESH) == (thing->mesh != NULL));
        if (thing->mesh != NULL) {
            require_mesh(thing->mesh);
        }
    }
    for (size_t i = 0; i < scene->light_count; i++) {
        REQUIRE(scene->lights[i].amount > 0 && isfinite(scene->lights[i].amount));
    }
    REQUIRE(strlen(scene->digest.text) == DIGEST_LENGTH);
}

/* A few rays from the camera. */
static void look(const struct scene *scene, struct arena *arena)
{
    const double span[2] = {-0.01, 0.01};
    struct world world;
    struct error error = {0};
    if (!world_open(scene, span, arena, &world, &error)) {
        fuzz_require_error(&error);
        return;
    }
    for (int i = 0; i < 16; i++) {
        const struct vector way = {0.1 * (i % 4 - 1.5), 0.1 * (i / 4 - 1.5), -1};
        const struct world_ray ray = {
            .origin = scene->camera.where.at,
            .direction = vector_unit(frame_out(&scene->camera.where.turned, way)),
            .time = 0.01 * (i % 3 - 1),
            .farthest = INFINITY,
        };
        struct world_hit hit;
        if (world_intersect(&world, &ray, &hit)) {
            REQUIRE(hit.distance > 0 && isfinite(hit.distance) && hit.thing < scene->thing_count);
            REQUIRE(fabs(vector_length(hit.normal) - 1) < 1e-6);
        }
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    char *content = fuzz_copy(data, size);
    const char *end = size > 0 ? memchr(content, '\0', size) : NULL;
    const size_t length = end != NULL ? (size_t)(end - content) : size;
    struct text rest = {content + length + (end != NULL), size - length - (end != NULL)};
    const struct scene_files files = {read_rest, &rest};
    struct arena arena = {0};
    struct scene scene;
    struct error error = {0};
    if (scene_file_read("fuzz.scene", (struct text){content, length}, &files, &arena, &scene,
                        &error)) {
        require_scene(&scene);
        if (!scene_check(&scene, size % 2, &error)) {
            fuzz_require_error(&error);
        }
        look(&scene, &arena);
    } else {
        fuzz_require_error(&error);
        REQUIRE(error.code == ERROR_DATA);
    }
    arena_free(&arena);
    free(content);
    return 0;
}
