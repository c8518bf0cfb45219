/* scene/material.c - materials in bands: reflectance and emission. */
/* SPDX-License-Identifier: MIT */
#include "scene/material.h"

#include "scene/texture.h"

#include <math.h>
#include <stdlib.h>

/* -------- coats -------- */

static int compare_coats(const void *first, const void *second)
{
    const struct scene_material *a = *(const struct scene_material *const *)first;
    const struct scene_material *b = *(const struct scene_material *const *)second;
    const int by_roughness = (a->roughness > b->roughness) - (a->roughness < b->roughness);
    return by_roughness != 0 ? by_roughness : (a->index > b->index) - (a->index < b->index);
}

/* -------- materials -------- */

static bool open_material(const struct scene_material *written, struct spectra *spectra,
                          struct material *material, struct error *error)
{
    const bool shines = written->emission.kind != SPECTRUM_NONE && written->luminance > 0;
    *material = (struct material){
        .kind = written->kind, .texture = written->texture, .luminance = written->luminance};
    if (written->kind != MATERIAL_BLACK) {
        material->colour = spectra_surface(spectra, &written->colour, &written->place, error);
        if (material->colour == NULL) {
            return false;
        }
        for (size_t k = 0; k < spectra->bands->count; k++) {
            material->ground = fmax(material->ground, material->colour->of[k]);
        }
    }
    material->light =
        shines ? spectra_light(spectra, &written->emission, &written->place, error) : NULL;
    return !shines || material->light != NULL;
}

bool materials_open(const struct scene *scene, struct spectra *spectra, struct materials *materials,
                    struct error *error)
{
    struct arena *arena = spectra->arena;
    struct material *of = ARENA_ARRAY(arena, scene->material_count, struct material);
    for (size_t i = 0; i < scene->material_count; i++) {
        const struct scene_material *material = &scene->materials[i];
        if (!open_material(material, spectra, &of[i], error)) {
            error_prefix(error, "material '%s': ", material->name);
            return false;
        }
    }
    /* A coat takes a while: none for what is not used, one for all that are alike. */
    struct arena spare = arena_within(arena);
    const struct scene_material **list =
        ARENA_ARRAY(&spare, scene->material_count, const struct scene_material *);
    /* the glossy materials that things are made of, alike ones side by side */
    bool *is_listed = ARENA_ARRAY(&spare, scene->material_count, bool);
    size_t count = 0;
    for (size_t i = 0; i < scene->thing_count; i++) {
        const size_t number = scene->things[i].material;
        if (number != SCENE_NONE && scene->materials[number].kind == MATERIAL_GLOSSY &&
            !is_listed[number]) {
            is_listed[number] = true;
            list[count++] = &scene->materials[number];
        }
    }
    qsort(list, count, sizeof *list, compare_coats);
    struct microfacets *coat = NULL;
    for (size_t i = 0; i < count; i++) {
        if (i == 0 || compare_coats(&list[i - 1], &list[i]) != 0) {
            coat = ARENA_NEW(arena, struct microfacets);
            microfacets_open(list[i]->roughness, list[i]->index, coat);
        }
        of[list[i] - scene->materials].microfacets = coat;
    }
    arena_free(&spare);
    *materials = (struct materials){.scene = scene, .bands = spectra->bands, .of = of};
    return true;
}

/* Pictures go around spheres, and on beside themselves where places have no end. */
static const enum texture_edges edges[] = {
    [SHAPE_PLANE] = TEXTURE_REPEATS, [SHAPE_DISC] = TEXTURE_ENDS, [SHAPE_CARD] = TEXTURE_ENDS,
    [SHAPE_SPHERE] = TEXTURE_ROUND,  [SHAPE_BOX] = TEXTURE_ENDS,  [SHAPE_MESH] = TEXTURE_REPEATS};

/* What a picture on a thing has at a place: shares of the lanes, and the mean of its colours. */
static struct radiance texture_reflectance(const struct materials *materials,
                                           const struct scene_thing *thing,
                                           const struct image *picture, const double place[2],
                                           const struct lanes *lanes, double *mean)
{
    double rgb[TEXTURE_CHANNELS];
    struct radiance of = {{0}};
    texture_lookup(picture, place, edges[thing->shape], rgb);
    for (size_t k = 0; k < lanes->count; k++) {
        const double *basis = materials->bands->basis[lanes->band[k]];
        of.of[k] = rgb[0] * basis[0] + rgb[1] * basis[1] + rgb[2] * basis[2];
    }
    *mean = (rgb[0] + rgb[1] + rgb[2]) / 3;
    return of;
}

bool materials_bsdf(const struct materials *materials, size_t thing, const double place[2],
                    const struct lanes *lanes, struct bsdf *scatter)
{
    const struct scene_thing *of = &materials->scene->things[thing];
    scatter->lanes = lanes->count;
    if (of->picture != NULL) {
        scatter->kind = MATERIAL_LAMBERT;
        scatter->colour =
            texture_reflectance(materials, of, of->picture, place, lanes, &scatter->ground);
        return !of->shines;
    }
    const struct material *material = &materials->of[of->material];
    if (material->colour == NULL) {
        return false;
    }
    scatter->kind = material->kind;
    scatter->microfacets = material->microfacets;
    scatter->ground = material->ground;
    for (size_t k = 0; k < lanes->count; k++) {
        scatter->colour.of[k] = material->colour->of[lanes->band[k]];
    }
    if (material->texture != NULL) {
        double mean;
        const struct radiance by =
            texture_reflectance(materials, of, material->texture, place, lanes, &mean);
        for (size_t k = 0; k < lanes->count; k++) {
            scatter->colour.of[k] *= by.of[k];
        }
        scatter->ground *= mean;
    }
    return true;
}

bool materials_shines(const struct materials *materials, size_t thing)
{
    const struct scene_thing *of = &materials->scene->things[thing];
    return of->picture != NULL ? of->shines && of->luminance > 0
                               : materials->of[of->material].light != NULL;
}

void materials_shine(const struct materials *materials, size_t thing, const double place[2],
                     const struct lanes *lanes, struct radiance *light)
{
    const struct scene_thing *of = &materials->scene->things[thing];
    if (of->picture != NULL) {
        double mean;
        *light = texture_reflectance(materials, of, of->picture, place, lanes, &mean);
        for (size_t k = 0; k < lanes->count; k++) {
            light->of[k] *= of->luminance;
        }
        return;
    }
    const struct material *material = &materials->of[of->material];
    for (size_t k = 0; k < lanes->count; k++) {
        light->of[k] = material->light->of[lanes->band[k]] * material->luminance;
    }
}
