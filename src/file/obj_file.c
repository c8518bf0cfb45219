/* file/obj_file.c - triangles out of Wavefront's .obj files. */
/* SPDX-License-Identifier: MIT */
#include "file/obj_file.h"

#include "file/file_words.h"
#include "file/polygon.h"

#include <math.h>
#include <stdint.h>
#include <string.h>

#define NONE ((size_t)-1)

/* What faces count: positions, places in a texture, normals. */
enum obj_file_part { PART_POSITION, PART_PLACE, PART_NORMAL, PARTS };
static const char *const part_words[PARTS] = {"v", "vt", "vn"};

/* Position, place and normal, from 0; NONE: it has none. */
struct corner {
    size_t of[PARTS];
};

/* A face of more than three corners: a fan, until all corners are known. */
struct obj_file_fan {
    size_t first, corner_count; /* of its triangles */
};

struct obj {
    struct file_words words;
    const struct obj_question *question;
    struct obj_passed *passed;
    struct arena *arena;       /* of what is given up in the end */
    struct vector *all[PARTS]; /* as they are written; places in x and y */
    size_t count[PARTS], room[PARTS];
    size_t total[PARTS]; /* in the whole file: faces may stand before their corners */
    struct corner *corners;
    size_t corner_count, corner_room;
    size_t *slots, slot_count; /* of the corners, by what they are; one more than the number */
    size_t (*triangles)[3];
    size_t triangle_count, triangle_room;
    struct obj_file_fan *fans;
    size_t fan_count, fan_room;
};

static uint64_t mixed(uint64_t hash, uint64_t word)
{
    hash = (hash ^ word) * 0x9e3779b97f4a7c15;
    return hash ^ (hash >> 32);
}

/* -------- corners of which no two are alike -------- */

static size_t obj_file_slot_of(const struct obj *obj, const struct corner *corner)
{
    uint64_t hash = 0;
    for (size_t i = 0; i < PARTS; i++) {
        hash = mixed(hash, corner->of[i]);
    }
    size_t slot = (size_t)hash & (obj->slot_count - 1);
    while (obj->slots[slot] != 0 &&
           memcmp(&obj->corners[obj->slots[slot] - 1], corner, sizeof *corner) != 0) {
        slot = (slot + 1) & (obj->slot_count - 1);
    }
    return slot;
}

static size_t append_corner(struct obj *obj, const struct corner *corner)
{
    *ARENA_ADD(obj->arena, obj->corners, obj->corner_count, obj->corner_room) = *corner;
    return obj->corner_count - 1;
}

/* -------- words -------- */

/* The next word of a line, which goes on behind a backslash; a comment ends it. */
static struct text obj_file_next_word(struct obj *obj)
{
    struct text word = file_words_next(&obj->words);
    while (text_equal(word, "\\") && file_words_line(&obj->words)) {
        word = file_words_next(&obj->words);
    }
    if (word.length > 0 && word.start[0] == '#') {
        file_words_rest(&obj->words);
        word.length = 0;
    }
    return word;
}

/* v x y z, with a weight or a colour behind; vt u, with v, and a depth; vn x y z. */
static bool obj_file_read_part(struct obj *obj, enum obj_file_part part)
{
    static const size_t least[PARTS] = {3, 1, 3}, most[PARTS] = {7, 3, 3};
    const double farthest =
        part == PART_POSITION ? obj->question->farthest / obj->question->scale : 1e9;
    double number[7] = {0};
    size_t count = 0;
    struct text word = obj_file_next_word(obj);
    for (; count < least[part] || (word.length > 0 && count < most[part]); count++) {
        const char *end = word.start + word.length;
        const char *behind =
            word.length > 0 ? number_read(word.start, end, NUMBER_UNSCALED, &number[count]) : NULL;
        if (word.length == 0) {
            return file_words_fail(&obj->words, word, "a number is missing");
        }
        if (behind != end) {
            return file_words_fail(&obj->words, word, "'%.*s' is not a number", text_shown(word),
                                   word.start);
        }
        if (!(fabs(number[count]) <= farthest)) {
            return file_words_fail(&obj->words, word, "%.*s is not within -%.4g to %.4g",
                                   text_shown(word), word.start, farthest, farthest);
        }
        word = obj_file_next_word(obj);
    }
    if (word.length > 0) {
        return file_words_fail(&obj->words, word, "'%.*s' does not belong here", text_shown(word),
                               word.start);
    }
    obj->passed->colours = obj->passed->colours || (part == PART_POSITION && count >= 6);
    *ARENA_ADD(obj->arena, obj->all[part], obj->count[part], obj->room[part]) =
        (struct vector){number[0], number[1], number[2]};
    return true;
}

/* A number from 1, or from -1 for the last one so far. */
static bool obj_file_read_index(const struct obj *obj, struct text text, enum obj_file_part part,
                                size_t *index)
{
    const bool is_behind = text.length > 0 && text.start[0] == '-';
    size_t value = 0, i = is_behind ? 1 : 0;
    for (; i < text.length && char_is_digit(text.start[i]) && value < SIZE_MAX / 16; i++) {
        value = 10 * value + (size_t)(text.start[i] - '0');
    }
    if (i < text.length || text.length == (is_behind ? 1 : 0)) {
        return file_words_fail(&obj->words, text, "'%.*s' is not the number of a '%s'",
                               text_shown(text), text.start, part_words[part]);
    }
    const size_t have = is_behind ? obj->count[part] : obj->total[part];
    if (value == 0 || value > have) {
        return file_words_fail(&obj->words, text, "there is no '%s' %.*s: %s has %zu",
                               part_words[part], text_shown(text), text.start,
                               is_behind ? "up to here the file" : "the file", have);
    }
    *index = is_behind ? have - value : value - 1;
    return true;
}

/* 3, 3/4, 3//5 or 3/4/5 */
static bool read_corner(struct obj *obj, struct text word, size_t *number)
{
    struct corner corner = {{NONE, NONE, NONE}};
    struct text rest = word;
    for (int part = 0; part < PARTS && rest.start != NULL; part++) {
        const struct text text = text_cut(&rest, '/');
        if ((part == PART_POSITION || text.length > 0) &&
            !obj_file_read_index(obj, text, (enum obj_file_part)part, &corner.of[part])) {
            return false;
        }
    }
    if (rest.start != NULL) {
        return file_words_fail(&obj->words, rest,
                               "a corner is position/place/normal: three numbers at most");
    }
    if (2 * (obj->corner_count + 1) > obj->slot_count) {
        obj->slot_count = obj->slot_count > 0 ? 2 * obj->slot_count : 1024;
        obj->slots = ARENA_ARRAY(obj->arena, obj->slot_count, size_t);
        for (size_t i = 0; i < obj->corner_count; i++) {
            obj->slots[obj_file_slot_of(obj, &obj->corners[i])] = i + 1;
        }
    }
    const size_t slot = obj_file_slot_of(obj, &corner);
    if (obj->slots[slot] == 0) {
        obj->slots[slot] = append_corner(obj, &corner) + 1;
    }
    *number = obj->slots[slot] - 1;
    return true;
}

static bool read_face(struct obj *obj)
{
    size_t corner[3], count = 0;
    for (struct text word = obj_file_next_word(obj); word.length > 0;
         word = obj_file_next_word(obj)) {
        if (!read_corner(obj, word, &corner[count < 2 ? count : 2])) {
            return false;
        }
        if (++count < 3) {
            continue;
        }
        if (obj->triangle_count == obj->question->most) {
            return file_words_fail(&obj->words, word, "more than %zu triangles",
                                   obj->question->most);
        }
        memcpy(*ARENA_ADD(obj->arena, obj->triangles, obj->triangle_count, obj->triangle_room),
               corner, sizeof corner);
        corner[1] = corner[2];
    }
    if (count > 3) {
        *ARENA_ADD(obj->arena, obj->fans, obj->fan_count, obj->fan_room) =
            (struct obj_file_fan){obj->triangle_count - (count - 2), count};
    }
    const struct text end = {obj->words.line.start + obj->words.line.length, 0};
    return count >= 3 ||
           file_words_fail(&obj->words, end, "a face needs three corners, and has %zu", count);
}

/* -------- lines -------- */

enum action {
    ACTION_PASS,
    ACTION_MATERIAL,
    ACTION_LINE,
    ACTION_REFUSE /* free-form geometry: leaving it out would change what is there */
};

static const struct {
    const char *word;
    enum action action;
} others[] = {
    {"o", ACTION_PASS},          {"g", ACTION_PASS},          {"s", ACTION_PASS},
    {"mg", ACTION_PASS},         {"usemtl", ACTION_MATERIAL}, {"mtllib", ACTION_MATERIAL},
    {"usemap", ACTION_MATERIAL}, {"maplib", ACTION_MATERIAL}, {"bevel", ACTION_PASS},
    {"c_interp", ACTION_PASS},   {"d_interp", ACTION_PASS},   {"lod", ACTION_PASS},
    {"shadow_obj", ACTION_PASS}, {"trace_obj", ACTION_PASS},  {"l", ACTION_LINE},
    {"p", ACTION_LINE},          {"vp", ACTION_REFUSE},       {"cstype", ACTION_REFUSE},
    {"deg", ACTION_REFUSE},      {"bmat", ACTION_REFUSE},     {"step", ACTION_REFUSE},
    {"curv", ACTION_REFUSE},     {"curv2", ACTION_REFUSE},    {"surf", ACTION_REFUSE},
};

static bool read_other(struct obj *obj, struct text head)
{
    for (size_t i = 0; i < sizeof others / sizeof others[0]; i++) {
        if (!text_equal(head, others[i].word)) {
            continue;
        }
        if (others[i].action == ACTION_REFUSE) {
            return file_words_fail(&obj->words, head,
                                   "'%s': free-form curves and surfaces are not read",
                                   others[i].word);
        }
        obj->passed->materials = obj->passed->materials || others[i].action == ACTION_MATERIAL;
        obj->passed->lines = obj->passed->lines || others[i].action == ACTION_LINE;
        while (obj_file_next_word(obj).length > 0) {
        }
        return true;
    }
    return file_words_fail(&obj->words, head, "unknown word '%.*s'", text_shown(head), head.start);
}

static bool obj_file_read_line(struct obj *obj)
{
    const struct text head = obj_file_next_word(obj);
    if (head.length == 0) {
        return true;
    }
    if (text_equal(head, "f")) {
        return read_face(obj);
    }
    for (int part = 0; part < PARTS; part++) {
        if (text_equal(head, part_words[part])) {
            return obj_file_read_part(obj, (enum obj_file_part)part);
        }
    }
    return read_other(obj, head);
}

/* -------- the mesh -------- */

static struct vector obj_file_position(const struct obj *obj, size_t corner)
{
    return obj->all[PART_POSITION][obj->corners[corner].of[PART_POSITION]];
}

/* Into other triangles, as many. */
static void cut_face(struct obj *obj, const struct obj_file_fan *fan)
{
    size_t(*triangles)[3] = &obj->triangles[fan->first];
    size_t(*cut)[3] = arena_array(obj->arena, fan->corner_count - 2, sizeof cut[0]);
    size_t *corners = ARENA_ARRAY(obj->arena, fan->corner_count, size_t);
    struct vector *at = ARENA_ARRAY(obj->arena, fan->corner_count, struct vector);
    for (size_t i = 0; i < fan->corner_count; i++) {
        corners[i] = i < 2 ? triangles[0][i] : triangles[i - 2][2];
        at[i] = obj_file_position(obj, corners[i]);
    }
    const enum polygon_cut way = polygon_triangles(at, fan->corner_count, cut, obj->arena);
    obj->passed->crossed += way == POLYGON_CROSSED ? 1 : 0;
    for (size_t i = 0; i < fan->corner_count - 2; i++) {
        for (int k = 0; k < 3; k++) {
            triangles[i][k] = corners[cut[i][k]];
        }
    }
}

/* Where its corners lie, whichever comes first; bytes are equal where numbers are. */
struct places {
    struct vector at[3];
};

static int in_order(struct vector a, struct vector b)
{
    if (a.x != b.x) {
        return (a.x > b.x) - (a.x < b.x);
    }
    if (a.y != b.y) {
        return (a.y > b.y) - (a.y < b.y);
    }
    return (a.z > b.z) - (a.z < b.z);
}

static struct places places_of(const struct obj *obj, const size_t triangle[3])
{
    struct places places;
    for (size_t k = 0; k < 3; k++) {
        const struct vector own = obj_file_position(obj, triangle[k]);
        const struct vector at = {own.x + 0, own.y + 0, own.z + 0}; /* of which -0 becomes 0 */
        size_t to = k;
        for (; to > 0 && in_order(places.at[to - 1], at) > 0; to--) {
            places.at[to] = places.at[to - 1];
        }
        places.at[to] = at;
    }
    return places;
}

/* Triangles that lie on each other would all be looked at by each ray, and shine each. */
static void leave_out_twice(struct obj *obj)
{
    size_t slots = 2, kept = 0;
    while (slots < 2 * obj->triangle_count) {
        slots *= 2;
    }
    size_t *first = ARENA_ARRAY(obj->arena, slots, size_t); /* one more than its number */
    for (size_t i = 0; i < obj->triangle_count; i++) {
        const struct places here = places_of(obj, obj->triangles[i]);
        uint64_t words[sizeof here / sizeof(uint64_t)], hash = 0;
        memcpy(words, &here, sizeof words);
        for (size_t k = 0; k < sizeof words / sizeof words[0]; k++) {
            hash = mixed(hash, words[k]);
        }
        size_t slot = (size_t)hash & (slots - 1);
        bool is_there = false;
        for (; first[slot] != 0 && !is_there; slot = (slot + 1) & (slots - 1)) {
            const struct places other = places_of(obj, obj->triangles[first[slot] - 1]);
            is_there = memcmp(&other, &here, sizeof here) == 0;
        }
        if (!is_there) {
            memmove(obj->triangles[kept++], obj->triangles[i], sizeof obj->triangles[0]);
            first[slot] = kept;
        }
    }
    obj->passed->twice = obj->triangle_count - kept;
    obj->triangle_count = kept;
}

/* Any direction for a triangle without area, which nothing meets. */
static struct vector face_normal(const struct obj *obj, const size_t triangle[3])
{
    const struct vector a = obj_file_position(obj, triangle[0]);
    const struct vector across = vector_cross(vector_minus(obj_file_position(obj, triangle[1]), a),
                                              vector_minus(obj_file_position(obj, triangle[2]), a));
    const double length = vector_length(across);
    return length > 0 && isfinite(length) ? vector_times(1 / length, across)
                                          : (struct vector){0, 0, 1};
}

static bool has_normal(const struct obj *obj, size_t corner)
{
    const size_t normal = obj->corners[corner].of[PART_NORMAL];
    return normal != NONE && vector_length(obj->all[PART_NORMAL][normal]) > 0;
}

/* Corners without a normal of their own get that of their face, each face its own corner. */
static void give_normals(struct obj *obj)
{
    for (size_t i = 0; i < obj->triangle_count; i++) {
        size_t *triangle = obj->triangles[i];
        struct corner flat = {{0, 0, NONE}};
        for (int k = 0; k < 3; k++) {
            if (has_normal(obj, triangle[k])) {
                continue;
            }
            if (flat.of[PART_NORMAL] == NONE) {
                flat.of[PART_NORMAL] = obj->count[PART_NORMAL];
                *ARENA_ADD(obj->arena, obj->all[PART_NORMAL], obj->count[PART_NORMAL],
                           obj->room[PART_NORMAL]) = face_normal(obj, triangle);
            }
            flat.of[PART_POSITION] = obj->corners[triangle[k]].of[PART_POSITION];
            flat.of[PART_PLACE] = obj->corners[triangle[k]].of[PART_PLACE];
            triangle[k] = append_corner(obj, &flat);
        }
    }
}

/* Have some corners this part? */
static bool has_part(const struct obj *obj, enum obj_file_part part)
{
    for (size_t i = 0; i < obj->corner_count; i++) {
        if (part == PART_NORMAL ? has_normal(obj, i) : obj->corners[i].of[part] != NONE) {
            return true;
        }
    }
    return false;
}

static void make_mesh(struct obj *obj, struct arena *arena, struct scene_mesh *mesh)
{
    const bool has_normals = has_part(obj, PART_NORMAL), has_places = has_part(obj, PART_PLACE);
    if (has_normals) {
        give_normals(obj);
    }
    if (has_places) {
        for (size_t i = 0; i < obj->triangle_count; i++) {
            const size_t *triangle = obj->triangles[i];
            bool lacks = false;
            for (int k = 0; k < 3; k++) {
                lacks = lacks || obj->corners[triangle[k]].of[PART_PLACE] == NONE;
            }
            obj->passed->unplaced += lacks ? 1 : 0;
        }
    }
    struct vector *corners = ARENA_ARRAY(arena, obj->corner_count, struct vector);
    struct vector *normals =
        has_normals ? ARENA_ARRAY(arena, obj->corner_count, struct vector) : NULL;
    double(*places)[2] =
        has_places ? arena_array(arena, obj->corner_count, sizeof places[0]) : NULL;
    size_t(*triangles)[3] = arena_array(arena, obj->triangle_count, sizeof triangles[0]);
    memcpy(triangles, obj->triangles, obj->triangle_count * sizeof triangles[0]);
    for (size_t i = 0; i < obj->corner_count; i++) {
        const size_t *of = obj->corners[i].of;
        corners[i] = vector_times(obj->question->scale, obj->all[PART_POSITION][of[PART_POSITION]]);
        if (normals != NULL) { /* of those without one no triangle is left */
            normals[i] = has_normal(obj, i) ? vector_unit(obj->all[PART_NORMAL][of[PART_NORMAL]])
                                            : (struct vector){0, 0, 1};
        }
        if (places != NULL && of[PART_PLACE] != NONE) {
            places[i][0] = obj->all[PART_PLACE][of[PART_PLACE]].x;
            places[i][1] = obj->all[PART_PLACE][of[PART_PLACE]].y;
        }
    }
    *mesh = (struct scene_mesh){
        .file = arena_string(arena, obj->question->source, strlen(obj->question->source)),
        .corner_count = obj->corner_count,
        .triangle_count = obj->triangle_count,
        .corners = corners,
        .normals = normals,
        .places = (const double(*)[2])places,
        .triangles = (const size_t(*)[3])triangles,
    };
}

static bool obj_file_read_lines(struct obj *obj)
{
    /* How many parts of each kind there are. */
    const struct file_words begin = obj->words;
    while (file_words_line(&obj->words)) {
        const struct text head = obj_file_next_word(obj);
        for (int part = 0; part < PARTS; part++) {
            obj->total[part] += text_equal(head, part_words[part]) ? 1 : 0;
        }
        while (obj_file_next_word(obj).length > 0) {
        }
    }
    obj->words = begin;
    while (file_words_line(&obj->words)) {
        if (!obj_file_read_line(obj)) {
            return false;
        }
    }
    if (obj->triangle_count == 0) {
        return fail_in(obj->words.error, obj->question->source, 0, 0, "the mesh has no face");
    }
    return true;
}

bool obj_read(const struct obj_question *question, struct text content, struct arena *arena,
              struct scene_mesh *mesh, struct obj_passed *passed, struct error *error)
{
    struct arena own = {0};
    struct obj obj = {.question = question, .passed = passed, .arena = &own};
    *passed = (struct obj_passed){.unplaced = 0};
    bool is_read = file_words_open(&obj.words, question->source, content, &own, error);
    obj.words.comment = NULL;
    is_read = is_read && obj_file_read_lines(&obj);
    if (is_read) {
        for (size_t i = 0; i < obj.fan_count; i++) {
            const struct arena_mark mark = arena_mark(obj.arena);
            cut_face(&obj, &obj.fans[i]);
            arena_reset(obj.arena, mark);
        }
        leave_out_twice(&obj);
        make_mesh(&obj, arena, mesh);
    }
    arena_free(&own);
    return is_read;
}
