/* file/scene_load.c - what a scene names beside it: pictures, tables, meshes. */
/* SPDX-License-Identifier: MIT */
#include "file/scene_load.h"

#include "data/whole_file.h"
#include "file/image_file.h"

#include <string.h>

enum { COLOURS = 3 };

static bool read_there(void *context, const char *path, struct arena *arena, struct text *content,
                       struct error *error)
{
    (void)context;
    return large_file(path, IMAGE_FILE_MOST, arena, content, error) ||
           (error->code == ERROR_NONE && fail(error, ERROR_IO, "there is no file %.200s", path));
}

const struct scene_files scene_files_there = {read_there, NULL};

/* A name is looked for beside the scene's own file. */
static const char *path_beside(const struct scene_reader *reader, struct text name)
{
    const char *source = reader->words.source, *slash = strrchr(source, '/');
    const int folder = slash != NULL && name.start[0] != '/' ? (int)(slash + 1 - source) : 0;
    return arena_printf(reader->words.arena, "%.*s%.*s", folder, source, (int)name.length,
                        name.start);
}

/* Read it, and let it count in the scene's digest. */
static bool read_file(struct scene_reader *reader, const struct scene_line *line,
                      enum scene_key key, const char *path, struct text *content,
                      struct error *error)
{
    struct error found;
    if (reader->files == NULL) {
        return scene_line_fail(line, key, error, "no file may be named here");
    }
    if (!reader->files->read(reader->files->context, path, reader->words.arena, content, &found)) {
        return scene_line_fail(line, key, error, "%s", found.message);
    }
    digest_item(&reader->digest, *content);
    return true;
}

/* -------- pictures -------- */

/* Grey becomes three equal colours; what lies behind colours and alpha is left. */
static bool take_colours(const struct image *from, bool has_alpha, struct arena *arena,
                         struct image *to, struct error *error)
{
    const size_t colours = from->channels < COLOURS ? 1 : COLOURS;
    *to = (struct image){
        .width = from->width, .height = from->height, .channels = COLOURS + (has_alpha ? 1 : 0)};
    if (!image_new(to, arena, error)) {
        return false;
    }
    for (size_t i = 0; i < from->width * from->height; i++) {
        const float *pixel = from->pixels + i * from->channels;
        float *made = to->pixels + i * to->channels;
        for (size_t k = 0; k < COLOURS; k++) {
            made[k] = pixel[colours == 1 ? 0 : k];
        }
        if (has_alpha) {
            made[COLOURS] = pixel[colours];
        }
    }
    return true;
}

/* Is the channel behind grey or colours alpha? */
static bool has_alpha(const struct image *image, struct arena *arena)
{
    const size_t behind = image->channels < COLOURS ? 1 : COLOURS;
    return image->channels > behind && strcmp(image_channel(image, behind, arena), "A") == 0;
}

/* The first pixel of which a channel is above 1, or below it. */
static bool find_beyond(const struct image *image, size_t first, size_t last, bool above,
                        size_t *found)
{
    for (size_t i = 0; i < image->width * image->height; i++) {
        for (size_t k = first; k < last; k++) {
            const float value = image->pixels[i * image->channels + k];
            if (above ? value > 1 : value < 1) {
                *found = i;
                return true;
            }
        }
    }
    return false;
}

static bool check_picture(const struct image *image, bool with_alpha, enum scene_picture kind,
                          struct error *error)
{
    const bool may_have_alpha = kind == PICTURE_OF_CARD || kind == PICTURE_THAT_SHINES;
    const bool reflects = kind == PICTURE_OF_CARD || kind == PICTURE_OF_SURFACE;
    size_t at;
    if (!image_check(image, IMAGE_POSITIVE, error)) {
        return false;
    }
    if (reflects && find_beyond(image, 0, COLOURS, true, &at)) {
        return fail(error, ERROR_DATA,
                    "column %zu, row %zu is brighter than 1: a surface reflects at most all",
                    at % image->width + 1, at / image->width + 1);
    }
    if (with_alpha && !may_have_alpha && find_beyond(image, COLOURS, COLOURS + 1, false, &at)) {
        return fail(error, ERROR_DATA,
                    "column %zu, row %zu is transparent, which only the picture of a card may be",
                    at % image->width + 1, at / image->width + 1);
    }
    return !with_alpha || !find_beyond(image, COLOURS, COLOURS + 1, true, &at) ||
           fail(error, ERROR_DATA, "column %zu, row %zu has an alpha above 1",
                at % image->width + 1, at / image->width + 1);
}

static bool parse_picture(const char *path, struct text content, enum scene_picture kind,
                          struct arena *arena, struct image *image, struct error *error)
{
    struct image whole;
    if (!image_file_parse(path, content, IMAGE_LIGHT, arena, &whole, error)) {
        return false;
    }
    const bool with_alpha = has_alpha(&whole, arena);
    if (strcmp(image_channel(&whole, 0, arena), "X") == 0) {
        return fail(error, ERROR_DATA, "it has X, Y and Z, not red, green and blue");
    }
    return take_colours(&whole, with_alpha, arena, image, error) &&
           check_picture(image, with_alpha, kind, error);
}

bool scene_load_picture(struct scene_reader *reader, const struct scene_line *line,
                        enum scene_key key, enum scene_picture kind, const struct image **image,
                        struct error *error)
{
    struct arena *arena = reader->words.arena;
    const char *path = path_beside(reader, line->value[key]);
    const char *name = arena_printf(arena, "%d %s", (int)kind, path);
    const size_t known = name_index_find(&reader->images, text_of(name));
    struct image *read = ARENA_NEW(arena, struct image);
    struct text content;
    struct error found;
    if (known != NAME_NONE) {
        *image = reader->loaded[known];
        return true;
    }
    if (!read_file(reader, line, key, path, &content, error)) {
        return false;
    }
    if (!parse_picture(path, content, kind, arena, read, &found)) {
        return scene_line_fail(line, key, error, "%.200s: %s", path, found.message);
    }
    reader->loaded = arena_grow(arena, reader->loaded, reader->images.count, &reader->image_room,
                                sizeof reader->loaded[0]);
    reader->loaded[reader->images.count] = read;
    name_index_add(&reader->images, text_of(name), arena);
    *image = read;
    return true;
}
