/* file/scene_thing.c - things of a scene: planes, discs, cards, spheres, boxes, meshes. */
/* SPDX-License-Identifier: MIT */
#include "file/scene_reader.h"

#define PLACED (SCENE_MOTION_KEYS | SCENE_BIT(KEY_NORMAL))
#define MADE   SCENE_BIT(KEY_MATERIAL)

static const struct shape {
    const char *word;
    enum scene_shape shape;
    struct scene_keys keys;
    size_t sizes; /* numbers of size= */
} shapes[] = {
    {"plane", SHAPE_PLANE, {PLACED | MADE | SCENE_BIT(KEY_REPEAT), MADE}, 0},
    {"disc", SHAPE_DISC, {PLACED | MADE | SCENE_BIT(KEY_RADIUS), MADE | SCENE_BIT(KEY_RADIUS)}, 0},
    {"card",
     SHAPE_CARD,
     {PLACED | MADE | SCENE_BIT(KEY_SIZE) | SCENE_BIT(KEY_FILE) | SCENE_BIT(KEY_LUMINANCE),
      SCENE_BIT(KEY_SIZE)},
     2},
    {"sphere",
     SHAPE_SPHERE,
     {PLACED | MADE | SCENE_BIT(KEY_RADIUS), MADE | SCENE_BIT(KEY_RADIUS)},
     0},
    {"box", SHAPE_BOX, {PLACED | MADE | SCENE_BIT(KEY_SIZE), MADE | SCENE_BIT(KEY_SIZE)}, 3},
    {"mesh",
     SHAPE_MESH,
     {PLACED | MADE | SCENE_BIT(KEY_FILE) | SCENE_BIT(KEY_SCALE), MADE | SCENE_BIT(KEY_FILE)},
     0},
};
enum { SHAPES = sizeof shapes / sizeof shapes[0] };

const char *scene_shape_word(size_t i)
{
    return i < SHAPES ? shapes[i].word : NULL;
}

static bool find_material(const struct scene_reader *reader, const struct scene_line *line,
                          size_t *material)
{
    const struct text name = line->value[KEY_MATERIAL];
    struct nearest nearest = {.typed = name};
    *material = SCENE_NONE;
    if (!scene_line_has(line, KEY_MATERIAL)) {
        return true;
    }
    *material = name_table_find(&reader->materials, name);
    if (*material != NAME_NONE) {
        return true;
    }
    for (size_t i = 0; i < reader->materials.count; i++) {
        nearest_offer(&nearest, reader->materials.names[i]);
    }
    return scene_word_fail(line->words, name, &nearest, "no line above has the material");
}

static bool read_mesh(struct scene_reader *reader, const struct scene_line *line, bool has_texture,
                      struct scene_thing *thing)
{
    if (!scene_load_mesh(reader, line, has_texture, &thing->mesh)) {
        return false;
    }
    return !has_texture || thing->mesh->places != NULL ||
           scene_line_fail(line, KEY_FILE,
                           "the mesh has no places in a texture, vt, and its material has one");
}

/* A picture with its light, or something of one material. */
static bool read_card(struct scene_reader *reader, const struct scene_line *line,
                      struct scene_thing *thing)
{
    const bool has_picture = scene_line_has(line, KEY_FILE);
    thing->shines = scene_line_has(line, KEY_LUMINANCE);
    thing->luminance = line->number[KEY_LUMINANCE][0];
    if (has_picture == scene_line_has(line, KEY_MATERIAL)) {
        return file_words_fail(line->words, line->head,
                               "a card has a picture, file=, or a material=: one of them");
    }
    if (!has_picture && thing->shines) {
        return scene_line_fail(line, KEY_LUMINANCE,
                               "luminance= is that of a picture: a material has its own");
    }
    struct scene_loaded picture = {.image = NULL};
    if (has_picture &&
        !scene_load_picture(reader, line, KEY_FILE,
                            thing->shines ? PICTURE_THAT_SHINES : PICTURE_OF_CARD, &picture)) {
        return false;
    }
    thing->picture = picture.image;
    thing->mean = picture.mean;
    if (has_picture && line->count[KEY_SIZE] == 1) {
        thing->size.y = thing->size.x / image_proportion(thing->picture);
    }
    return true;
}

/* A texture has the proportions of its picture. */
static bool read_plane(const struct scene_line *line, const struct image *texture,
                       struct scene_thing *thing)
{
    if ((texture != NULL) != scene_line_has(line, KEY_REPEAT)) {
        return scene_line_fail(line, KEY_REPEAT, "%s",
                               texture != NULL
                                   ? "a plane with a texture needs repeat=, its width on the plane"
                                   : "repeat= is the width of a texture, and the material has "
                                     "none");
    }
    if (texture != NULL) {
        const double width = line->number[KEY_REPEAT][0];
        thing->repeat[0] = width;
        thing->repeat[1] = width / image_proportion(texture);
    }
    return true;
}

static bool check_thing_size(const struct scene_line *line, const struct shape *shape,
                             bool has_picture)
{
    const size_t count = line->count[KEY_SIZE];
    if (count == shape->sizes || (has_picture && count == 1)) {
        return true;
    }
    return scene_line_fail(line, KEY_SIZE, "size= of a %s has %zu numbers%s, not %zu", shape->word,
                           shape->sizes, has_picture ? ", or the width of its picture" : "", count);
}

static bool read_thing_shape(struct scene_reader *reader, const struct scene_line *line,
                             const struct shape *shape, struct scene_thing *thing)
{
    const struct image *texture =
        thing->material != SCENE_NONE ? reader->scene->materials[thing->material].texture : NULL;
    if (!check_thing_size(line, shape, scene_line_has(line, KEY_FILE))) {
        return false;
    }
    switch (shape->shape) {
    case SHAPE_CARD:
        return read_card(reader, line, thing);
    case SHAPE_MESH:
        return read_mesh(reader, line, texture != NULL, thing);
    case SHAPE_PLANE:
        return read_plane(line, texture, thing);
    default:
        return true;
    }
}

bool scene_thing_read(struct scene_reader *reader, struct text head)
{
    struct scene *scene = reader->scene;
    struct file_words *words = &reader->words;
    size_t i = 0;
    while (i < SHAPES - 1 && !text_equal(head, shapes[i].word)) {
        i++;
    }
    struct scene_line line;
    if (scene->thing_count == SCENE_THINGS_MOST) {
        return file_words_fail(words, head, "more than %d things", SCENE_THINGS_MOST);
    }
    if (!scene_line_read(words, &reader->units, head, shapes[i].keys, &line)) {
        return false;
    }
    struct scene_thing thing = {
        .shape = shapes[i].shape,
        .radius = line.number[KEY_RADIUS][0],
        .size = scene_line_vector(&line, KEY_SIZE),
        .place = file_words_place(words, head),
    };
    if (!scene_place_read(&line, &thing.where) || !find_material(reader, &line, &thing.material) ||
        !read_thing_shape(reader, &line, &shapes[i], &thing)) {
        return false;
    }
    *ARENA_ADD(words->arena, scene->things, scene->thing_count, reader->thing_room) = thing;
    return true;
}
