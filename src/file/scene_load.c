/* file/scene_load.c - what a scene names beside it: pictures, tables, meshes. */
/* SPDX-License-Identifier: MIT */
#include "file/scene_reader.h"

#include "data/number_table.h"
#include "data/whole_file.h"
#include "file/image_file.h"
#include "file/obj_file.h"
#include "light/spectrum.h"
#include "scene/texture.h"

#include <math.h>
#include <string.h>

enum { COLOURS = 3 };

static bool read_there(void *context, const char *path, struct arena *arena, struct text *content,
                       struct error *error)
{
    (void)context;
    return regular_file(path, IMAGE_FILE_MOST, arena, content, error) ||
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

/* Where it is wanted, and in whose memory. */
struct scene_load_wanted {
    const struct scene_line *line;
    enum scene_key key;
    const char *path;
    struct arena *arena;
};

/* Read it, and let it count in the scene's digest. */
static bool read_path_beside(struct scene_reader *reader, const struct scene_load_wanted *wanted,
                             struct text *content)
{
    struct error found;
    if (reader->files == NULL) {
        return scene_line_fail(wanted->line, wanted->key, "no file may be named here");
    }
    if (!reader->files->read(reader->files->context, wanted->path, wanted->arena, content,
                             &found)) {
        return scene_line_fail(wanted->line, wanted->key, "%s", found.message);
    }
    digest_item(&reader->digest, *content);
    return true;
}

/* -------- notes -------- */

static void take_load_note(struct scene_reader *reader, const char *note)
{
    struct scene *scene = reader->scene;
    *ARENA_ADD(reader->words.arena, scene->notes, scene->note_count, reader->note_room) = note;
}

/* -------- pictures -------- */

/* Grey becomes three equal colours; what lies behind colours and alpha is left. */
static bool take_colours(const struct image *from, bool has_alpha, struct arena *arena,
                         struct image *to, struct error *error)
{
    const size_t colours = from->channels < COLOURS ? 1 : COLOURS;
    *to = (struct image){.width = from->width,
                         .height = from->height,
                         .channels = COLOURS + (has_alpha ? 1 : 0),
                         .aspect = from->aspect};
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

static bool check_picture_rows(const struct image *image, bool with_alpha, enum scene_picture kind,
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

/* The picture lies in `arena`, what is given up in that of what is wanted. */
static bool parse_picture(const struct scene_load_wanted *wanted, struct text content,
                          enum scene_picture kind, struct arena *arena, struct image *image,
                          struct error *error)
{
    struct arena *own = wanted->arena;
    const struct image_wish wish = {IMAGE_LIGHT, IMAGE_SEEN_MOST};
    struct image whole;
    if (!image_file_parse(wanted->path, content, &wish, own, &whole, error)) {
        return false;
    }
    const bool with_alpha = has_alpha(&whole, own);
    if (strcmp(image_channel(&whole, 0, own), "X") == 0) {
        return fail(error, ERROR_DATA, "it has X, Y and Z, not red, green and blue");
    }
    if (!take_colours(&whole, with_alpha, arena, image, error)) {
        return false;
    }
    image->beyond_srgb = whole.beyond_srgb;
    return check_picture_rows(image, with_alpha, kind, error);
}

/* What the file holds is given up, and what it becomes at first: both are as large as pictures. */
static bool read_picture(struct scene_reader *reader, struct scene_load_wanted *wanted,
                         enum scene_picture kind, struct image *image)
{
    struct arena own = {0};
    struct text content;
    struct error found;
    wanted->arena = &own;
    bool is_read = read_path_beside(reader, wanted, &content);
    if (is_read && !parse_picture(wanted, content, kind, reader->words.arena, image, &found)) {
        is_read =
            scene_line_fail(wanted->line, wanted->key, "%.200s: %s", wanted->path, found.message);
    }
    arena_free(&own);
    return is_read;
}

bool scene_load_picture(struct scene_reader *reader, const struct scene_line *line,
                        enum scene_key key, enum scene_picture kind, struct scene_loaded *loaded)
{
    struct arena *arena = reader->words.arena;
    const char *path = path_beside(reader, line->value[key]);
    const char *name = arena_printf(arena, "%d %s", (int)kind, path);
    const size_t known = name_table_find(&reader->images, text_of(name));
    if (known != NAME_NONE) {
        *loaded = reader->loaded[known];
        return true;
    }
    struct image *read = ARENA_NEW(arena, struct image);
    if (!read_picture(reader, &(struct scene_load_wanted){line, key, path, arena}, kind, read)) {
        return false;
    }
    const char *remark = image_file_remark(path, read, arena);
    if (remark != NULL) {
        take_load_note(reader, remark);
    }
    reader->loaded = arena_grow(arena, reader->loaded, reader->images.count, &reader->image_room,
                                sizeof reader->loaded[0]);
    *loaded = (struct scene_loaded){read, texture_luminance(read)};
    reader->loaded[reader->images.count] = *loaded;
    name_table_add(&reader->images, text_of(name), arena);
    return true;
}

/* -------- tables -------- */

#define UM_PER_NM        1e-3
#define LEAST_WAVELENGTH 0.39
#define MOST_WAVELENGTH  0.71
#define MOST_VALUE       1e9

/* Are wavelengths above 0 and rise, and are values light or shares of it? */
static bool check_spectrum_row(const struct number_table *table, size_t row, struct error *error)
{
    const double nm = table->column[0][row], value = table->column[1][row];
    if (!(nm > 0 && nm < (double)INFINITY)) {
        return fail(error, ERROR_DATA, "the wavelength %.6g nm is not a number above 0", nm);
    }
    if (row > 0 && !(nm > table->column[0][row - 1])) {
        return fail(error, ERROR_DATA,
                    "the wavelength %.6g nm is not above %.6g, the one before it", nm,
                    table->column[0][row - 1]);
    }
    return (value >= 0 && value <= MOST_VALUE) ||
           fail(error, ERROR_DATA, "the value %.6g is not within 0 to %g", value, MOST_VALUE);
}

/* Wavelengths become um. */
static bool take_spectrum(const char *path, const struct number_table *table,
                          struct spectrum *spectrum, struct error *error)
{
    if (table->columns != 2) {
        return fail_in(error, path, 0, 0, "a spectrum has two columns, and this file %zu",
                       table->columns);
    }
    for (size_t i = 0; i < table->rows; i++) {
        if (!check_spectrum_row(table, i, error)) {
            return error_locate(error, path, table->line[i], 0);
        }
    }
    for (size_t i = 0; i < table->rows; i++) {
        table->column[0][i] *= UM_PER_NM;
    }
    *spectrum = (struct spectrum){.kind = SPECTRUM_TABLE,
                                  .count = table->rows,
                                  .wavelength = table->column[0],
                                  .value = table->column[1]};
    if (!spectrum_check(spectrum, error)) {
        error->code = ERROR_DATA;
        return error_locate(error, path, 0, 0);
    }
    return true;
}

bool scene_load_table(struct scene_reader *reader, const struct scene_line *line,
                      struct spectrum *spectrum)
{
    struct arena *arena = reader->words.arena;
    const struct scene_load_wanted wanted = {line, KEY_TABLE,
                                             path_beside(reader, line->value[KEY_TABLE]), arena};
    const size_t known = name_table_find(&reader->tables, text_of(wanted.path));
    struct number_table table;
    struct text content;
    if (known != NAME_NONE) {
        *spectrum = reader->tabled[known];
        return true;
    }
    if (!read_path_beside(reader, &wanted, &content) ||
        !number_table_parse(wanted.path, content, "wavelength_nm", arena, &table,
                            reader->words.error) ||
        !take_spectrum(wanted.path, &table, spectrum, reader->words.error)) {
        return false;
    }
    const double first = spectrum->wavelength[0], last = spectrum->wavelength[spectrum->count - 1];
    if (first > LEAST_WAVELENGTH || last < MOST_WAVELENGTH) {
        take_load_note(reader,
                       arena_printf(reader->words.arena, "%s: from %g to %g nm, and 0 beside that",
                                    wanted.path, first / UM_PER_NM, last / UM_PER_NM));
    }
    reader->tabled = arena_grow(arena, reader->tabled, reader->tables.count, &reader->table_room,
                                sizeof reader->tabled[0]);
    reader->tabled[reader->tables.count] = *spectrum;
    name_table_add(&reader->tables, text_of(wanted.path), arena);
    return true;
}

/* -------- meshes -------- */

static void note_passed(struct scene_reader *reader, const char *path,
                        const struct obj_passed *passed)
{
    struct arena *arena = reader->words.arena;
    const char *const words[] = {passed->materials ? ", materials" : "",
                                 passed->lines ? ", lines and points" : "",
                                 passed->colours ? ", colours of corners" : ""};
    const char *all = ARENA_JOIN(arena, words[0], words[1], words[2]);
    if (all[0] != '\0') {
        take_load_note(reader, arena_printf(arena, "%s: passed over: %s", path, all + 2));
    }
    if (passed->crossed > 0) {
        take_load_note(reader,
                       arena_printf(arena, "%s: %zu face%s no area: %s about the first corner",
                                    path, passed->crossed,
                                    passed->crossed == 1 ? " crosses itself or has"
                                                         : "s cross themselves or have",
                                    passed->crossed == 1 ? "a fan" : "fans"));
    }
    if (passed->twice > 0) {
        take_load_note(reader,
                       arena_printf(arena, "%s: %zu triangle%s where another does, and %s left out",
                                    path, passed->twice, passed->twice == 1 ? " lies" : "s lie",
                                    passed->twice == 1 ? "is" : "are"));
    }
}

/* What the file holds is given up: it is as large as the mesh. */
static bool load_mesh(struct scene_reader *reader, struct scene_load_wanted *wanted, double scale,
                      struct scene_model *model)
{
    struct scene_mesh *mesh = ARENA_NEW(reader->words.arena, struct scene_mesh);
    const struct obj_question question = {
        .source = wanted->path,
        .scale = scale,
        .farthest = 1e12,
        .most = SCENE_TRIANGLES_MOST - reader->triangles,
    };
    struct arena own = {0};
    struct text content;
    struct obj_passed passed;
    wanted->arena = &own;
    const bool is_read =
        read_path_beside(reader, wanted, &content) &&
        obj_read(&question, content, reader->words.arena, mesh, &passed, reader->words.error);
    arena_free(&own);
    if (is_read) {
        reader->triangles += mesh->triangle_count;
        note_passed(reader, wanted->path, &passed);
        *model = (struct scene_model){mesh, passed.unplaced};
    }
    return is_read;
}

bool scene_load_mesh(struct scene_reader *reader, const struct scene_line *line, bool has_texture,
                     const struct scene_mesh **mesh)
{
    struct arena *arena = reader->words.arena;
    struct scene_load_wanted wanted = {line, KEY_FILE, path_beside(reader, line->value[KEY_FILE]),
                                       arena};
    const double scale = unit_to_own(&reader->units.length, 1) *
                         (scene_line_has(line, KEY_SCALE) ? line->number[KEY_SCALE][0] : 1);
    const char *name = arena_printf(arena, "%.17g %s", scale, wanted.path);
    size_t which = name_table_find(&reader->meshes, text_of(name));
    if (which == NAME_NONE) {
        struct scene_model read;
        if (!load_mesh(reader, &wanted, scale, &read)) {
            return false;
        }
        reader->models = arena_grow(arena, reader->models, reader->meshes.count, &reader->mesh_room,
                                    sizeof read);
        reader->models[reader->meshes.count] = read;
        which = name_table_add(&reader->meshes, text_of(name), arena);
    }
    if (has_texture) {
        /* Once, of what is seen with a texture. */
        struct scene_model *model = &reader->models[which];
        if (model->unplaced > 0) {
            take_load_note(reader,
                           arena_printf(reader->words.arena,
                                        "%s: %zu triangle%s no places in a texture, and take%s "
                                        "its lower left corner",
                                        model->mesh->file, model->unplaced,
                                        model->unplaced == 1 ? " has" : "s have",
                                        model->unplaced == 1 ? "s" : ""));
        }
        model->unplaced = 0;
    }
    *mesh = reader->models[which].mesh;
    return true;
}
