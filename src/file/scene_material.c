/* file/scene_material.c - what things of a scene are made of. */
/* SPDX-License-Identifier: MIT */
#include "file/scene_reader.h"

#include <math.h>

#define USUAL_INDEX 1.5 /* of a varnish: that of most plastics and glasses */

#define SHINES  (SCENE_BIT(KEY_EMISSION) | SCENE_BIT(KEY_LUMINANCE))
#define COLOURS (SCENE_BIT(KEY_COLOUR) | SCENE_BIT(KEY_TEXTURE))

static const struct {
    const char *word;
    enum scene_material_kind kind;
    struct scene_keys keys;
} kinds[] = {
    {"lambert", MATERIAL_LAMBERT, {COLOURS | SHINES, 0}},
    {"mirror", MATERIAL_MIRROR, {COLOURS | SHINES, 0}},
    {"glossy",
     MATERIAL_GLOSSY,
     {COLOURS | SHINES | SCENE_BIT(KEY_ROUGHNESS) | SCENE_BIT(KEY_INDEX),
      SCENE_BIT(KEY_ROUGHNESS)}},
    {"black", MATERIAL_BLACK, {SHINES, 0}},
};
enum { KINDS = sizeof kinds / sizeof kinds[0] };

static bool read_material_kind(struct scene_reader *reader, size_t *kind)
{
    const struct text word = file_words_next(&reader->words);
    struct nearest nearest = {.typed = word};
    for (*kind = 0; *kind < KINDS && !text_equal(word, kinds[*kind].word); ++*kind) {
        nearest_offer(&nearest, text_of(kinds[*kind].word));
    }
    if (*kind < KINDS) {
        return true;
    }
    return word.length == 0
               ? file_words_fail(&reader->words, word,
                                 "a material is lambert, mirror, glossy or black")
               : scene_word_fail(&reader->words, word, &nearest,
                                 "a material is lambert, mirror, glossy or black, not");
}

static bool read_look(struct scene_reader *reader, const struct scene_line *line,
                      struct scene_material *material)
{
    const bool scatters = material->kind == MATERIAL_LAMBERT || material->kind == MATERIAL_GLOSSY;
    if (scatters && (line->given & COLOURS) == 0) {
        return file_words_fail(line->words, line->head,
                               "a material that scatters light needs colour= or texture=");
    }
    if (scene_line_has(line, KEY_EMISSION) && !scene_line_has(line, KEY_LUMINANCE)) {
        return scene_line_fail(line, KEY_EMISSION,
                               "emission= is the colour of what shines, which needs luminance=");
    }
    if (material->kind == MATERIAL_BLACK) {
        return true;
    }
    struct scene_loaded texture = {.image = NULL};
    if (!scene_colour_of(reader, line, KEY_COLOUR, COLOUR_OF_SURFACE, &material->colour) ||
        (scene_line_has(line, KEY_TEXTURE) &&
         !scene_load_picture(reader, line, KEY_TEXTURE, PICTURE_OF_SURFACE, &texture))) {
        return false;
    }
    material->texture = texture.image;
    return true;
}

bool scene_material_read(struct scene_reader *reader, struct text head)
{
    struct scene *scene = reader->scene;
    struct file_words *words = &reader->words;
    const struct text name = file_words_next(words);
    struct scene_line line;
    size_t kind;
    if (scene->material_count == SCENE_MATERIALS_MOST) {
        return file_words_fail(words, head, "more than %d materials", SCENE_MATERIALS_MOST);
    }
    if (!scene_name_check(words, &reader->materials, name, "a material") ||
        !read_material_kind(reader, &kind) ||
        !scene_line_read(words, &reader->units, text_between(head.start, words->at),
                         kinds[kind].keys, &line)) {
        return false;
    }
    struct scene_material material = {
        .name = arena_string(words->arena, name.start, name.length),
        .kind = kinds[kind].kind,
        .roughness = line.number[KEY_ROUGHNESS][0],
        .index = scene_line_has(&line, KEY_INDEX) ? line.number[KEY_INDEX][0] : USUAL_INDEX,
        .luminance = line.number[KEY_LUMINANCE][0],
        .place = file_words_place(words, head),
    };
    if (!read_look(reader, &line, &material) ||
        (scene_line_has(&line, KEY_LUMINANCE) &&
         !scene_colour_of(reader, &line, KEY_EMISSION, COLOUR_OF_LIGHT, &material.emission))) {
        return false;
    }
    *ARENA_ADD(words->arena, scene->materials, scene->material_count, reader->material_room) =
        material;
    name_table_add(&reader->materials, name, words->arena);
    return true;
}
