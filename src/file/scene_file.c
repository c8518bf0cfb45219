/* file/scene_file.c - the lines of a .scene file. */
/* SPDX-License-Identifier: MIT */
#include "file/scene_file.h"

#include "file/scene_reader.h"

#include <math.h>

static bool read_scene_title(struct scene_reader *reader, struct text head)
{
    const struct text rest = file_words_rest(&reader->words);
    if (reader->scene->title != NULL) {
        return file_words_fail(&reader->words, head, "'scene' stands here twice");
    }
    reader->scene->title = arena_string(reader->words.arena, rest.start, rest.length);
    return true;
}

/* Who made the scene, and from what: for those who read the file. */
static bool read_scene_source(struct scene_reader *reader, struct text head)
{
    (void)head;
    file_words_rest(&reader->words);
    return true;
}

static struct scene_units units_of(const struct unit *length)
{
    struct unit speed = *unit_find(&dimension_speed, text_of("m/s"));
    speed.scale = length->scale;
    return (struct scene_units){*length, speed};
}

static bool read_scene_unit(struct scene_reader *reader, struct text head)
{
    const struct scene *scene = reader->scene;
    const struct text word = file_words_next(&reader->words);
    const struct unit *unit = unit_find(&dimension_length, word);
    if (reader->has_unit || reader->has_camera || scene->thing_count > 0 ||
        scene->light_count > 0) {
        return file_words_fail(&reader->words, head, "the unit must come before all lengths, once");
    }
    if (unit == NULL) {
        return file_words_fail(&reader->words, word,
                               "the unit is one of length: mm, cm, m, km, in, ft ...");
    }
    reader->has_unit = true;
    reader->units = units_of(unit);
    return file_words_end(&reader->words);
}

/* The words of --from, as lenscalc render has them; without one the camera's place. */
static bool read_from(struct scene_reader *reader, const struct scene_line *line,
                      enum scene_from *from)
{
    static const char *const words[SCENE_FROMS] = {[SCENE_FROM_ENTRANCE] = "entrance",
                                                   [SCENE_FROM_PRINCIPAL] = "principal",
                                                   [SCENE_FROM_SENSOR] = "sensor",
                                                   [SCENE_FROM_FRONT] = "front"};
    struct nearest nearest = {.typed = line->value[KEY_FROM]};
    *from = SCENE_FROM_ENTRANCE;
    if (!scene_line_has(line, KEY_FROM)) {
        return true;
    }
    if (!scene_line_has(line, KEY_FOCUS)) {
        return scene_line_fail(line, KEY_FROM, "from= needs focus=, which it counts");
    }
    for (int i = 0; i < SCENE_FROMS; i++) {
        if (text_same(line->value[KEY_FROM], words[i])) {
            *from = (enum scene_from)i;
            return true;
        }
        nearest_offer(&nearest, text_of(words[i]));
    }
    return scene_word_fail(&reader->words, line->value[KEY_FROM], &nearest,
                           "from= is entrance, principal, sensor or front, not");
}

static bool read_camera(struct scene_reader *reader, struct text head)
{
    const struct scene_keys keys = {SCENE_MOTION_KEYS | SCENE_BIT(KEY_LOOK) | SCENE_BIT(KEY_FOCUS) |
                                        SCENE_BIT(KEY_FROM),
                                    SCENE_BIT(KEY_AT)};
    struct scene_camera *camera = &reader->scene->camera;
    struct scene_line line;
    if (reader->has_camera) {
        return file_words_fail(&reader->words, head, "'camera' stands here twice");
    }
    reader->has_camera = true;
    if (!scene_line_read(&reader->words, &reader->units, head, keys, &line) ||
        !scene_place_read(&line, &camera->where)) {
        return false;
    }
    camera->distance = scene_line_has(&line, KEY_FOCUS) ? line.number[KEY_FOCUS][0] : NAN;
    return read_from(reader, &line, &camera->from);
}

/* Things have words of their own, those of scene_shape_word. */
static const struct {
    const char *word;
    bool (*read)(struct scene_reader *reader, struct text head);
} keywords[] = {
    {"scene", read_scene_title}, {"source", read_scene_source}, {"unit", read_scene_unit},
    {"camera", read_camera},     {"colour", scene_colour_read}, {"material", scene_material_read},
    {"light", scene_light_read},
};
enum { KEYWORDS = sizeof keywords / sizeof keywords[0] };

static bool read_scene_line(struct scene_reader *reader)
{
    const struct text word = file_words_next(&reader->words);
    struct nearest nearest = {.typed = word};
    for (size_t i = 0; i < KEYWORDS; i++) {
        if (text_equal(word, keywords[i].word)) {
            return keywords[i].read(reader, word);
        }
        nearest_offer(&nearest, text_of(keywords[i].word));
    }
    for (size_t i = 0; scene_shape_word(i) != NULL; i++) {
        if (text_equal(word, scene_shape_word(i))) {
            return scene_thing_read(reader, word);
        }
        nearest_offer(&nearest, text_of(scene_shape_word(i)));
    }
    return scene_word_fail(&reader->words, word, &nearest, "unknown word");
}

bool scene_file_read(const char *path, struct text content, const struct scene_files *files,
                     struct arena *arena, struct scene *scene, struct error *error)
{
    struct scene_reader reader = {.scene = scene, .files = files};
    reader.units = units_of(unit_find(&dimension_length, text_of("m")));
    *scene = (struct scene){.source = path};
    digest_begin(&reader.digest);
    digest_item(&reader.digest, content);
    if (!file_words_open(&reader.words, path, content, arena, error) ||
        !file_words_plain(path, content, error)) {
        return false;
    }
    reader.words.has_quotes = true;
    while (file_words_line(&reader.words)) {
        if (!read_scene_line(&reader)) {
            return false;
        }
    }
    if (!reader.has_camera) {
        return fail_in(error, path, 0, 0,
                       "the scene has no camera: a line 'camera at=0,1.5,4 look=0,1,0'");
    }
    scene->digest = digest_end(&reader.digest);
    return scene_lights_finish(&reader);
}
