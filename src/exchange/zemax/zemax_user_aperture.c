/* exchange/zemax/zemax_user_aperture.c - apertures of .zmx files that stand in .uda files. */
/* SPDX-License-Identifier: MIT */
#include "exchange/zemax/zemax_user_aperture.h"

#include "data/encoding.h"
#include "data/whole_file.h"
#include "file/lens_unit.h"

#include <math.h>
#include <string.h>

enum { MOST_SHAPES = 1000, MOST_CORNERS = 100000 };

/* The shapes while they are read. */
struct shapes {
    struct arena *arena;
    struct number_scale unit;
    bool blocks;
    struct aperture *all;
    size_t count, room;
    struct figure (*corners)[2]; /* of the polygon that is begun */
    size_t corner_count, corner_room;
    const char *wrong; /* what cannot be kept; null = nothing */
};

static bool is_same_point(const struct figure *a, const struct figure *b)
{
    return a[0].value.hi == b[0].value.hi && a[1].value.hi == b[1].value.hi;
}

static struct aperture *add_shape(struct shapes *shapes, enum aperture_shape shape)
{
    shapes->all =
        arena_grow(shapes->arena, shapes->all, shapes->count, &shapes->room, sizeof shapes->all[0]);
    shapes->all[shapes->count] = aperture_of(shape, shapes->blocks);
    return &shapes->all[shapes->count++];
}

/* The corners that have been are a polygon. */
static void end_polygon(struct shapes *shapes)
{
    size_t count = shapes->corner_count;
    if (count > 1 && is_same_point(shapes->corners[0], shapes->corners[count - 1])) {
        count--;
    }
    if (count > 0) {
        struct aperture *polygon = add_shape(shapes, SHAPE_POLYGON);
        polygon->points = (const struct figure(*)[2])shapes->corners;
        polygon->point_count = count;
    }
    shapes->corners = NULL;
    shapes->corner_count = shapes->corner_room = 0;
}

static void add_corner(struct shapes *shapes, const struct figure *numbers, size_t count)
{
    if (count < 2) {
        shapes->wrong = "a corner needs x and y";
        return;
    }
    shapes->corners = arena_grow(shapes->arena, shapes->corners, shapes->corner_count,
                                 &shapes->corner_room, sizeof shapes->corners[0]);
    shapes->corners[shapes->corner_count][0] = numbers[0];
    shapes->corners[shapes->corner_count++][1] = numbers[1];
}

static void add_circle(struct shapes *shapes, const struct figure *numbers, size_t count)
{
    if (count < 3) {
        shapes->wrong = "a circle needs x, y and a radius";
        return;
    }
    end_polygon(shapes);
    struct aperture *circle = add_shape(shapes, SHAPE_CIRCLE);
    const struct pair twice = {2 * numbers[2].value.hi, 2 * numbers[2].value.lo};
    circle->size[0] = figure_computed(twice, shapes->unit, shapes->arena);
    for (int i = 0; i < 2; i++) {
        circle->decenter[i] = numbers[i].value.hi != 0 ? numbers[i] : circle->decenter[i];
    }
}

/* The next word up to a blank or a comma. */
static struct text next_word(struct text *rest)
{
    size_t from = 0;
    while (from < rest->length && strchr(" \t,\r", rest->start[from]) != NULL) {
        from++;
    }
    size_t to = from;
    while (to < rest->length && strchr(" \t,\r", rest->start[to]) == NULL) {
        to++;
    }
    const struct text word = {rest->start + from, to - from};
    *rest = (struct text){rest->start + to, rest->length - to};
    return word;
}

/* The numbers of a line, up to what is none. */
static size_t read_numbers(struct shapes *shapes, struct text rest, struct figure numbers[4])
{
    size_t count = 0;
    for (struct text word = next_word(&rest); word.length > 0 && count < 4;
         word = next_word(&rest)) {
        struct figure figure = {.typed = word, .variable = LENS_NONE};
        const char *end = word.start + word.length;
        if (pair_read(word.start, end, shapes->unit, &figure.value) != end ||
            !(fabs(figure.value.hi) < 1e100)) {
            break;
        }
        numbers[count++] = figure;
    }
    return count;
}

static void read_line(struct shapes *shapes, struct text line)
{
    struct text rest = line;
    const struct text word = next_word(&rest);
    struct figure numbers[4];
    if (word.length == 0 || word.start[0] == '!') {
        return;
    }
    if (text_same(word, "LIN")) {
        add_corner(shapes, numbers, read_numbers(shapes, rest, numbers));
    } else if (text_same(word, "CIR")) {
        add_circle(shapes, numbers, read_numbers(shapes, rest, numbers));
    } else if (text_same(word, "BRK")) {
        end_polygon(shapes);
    } else {
        size_t count = read_numbers(shapes, line, numbers);
        if (count == 2 && numbers[0].value.hi == 0 && numbers[1].value.hi == 0) {
            end_polygon(shapes); /* of old files */
        } else if (count > 0) {
            add_corner(shapes, numbers, count);
        } else {
            shapes->wrong = arena_printf(shapes->arena, "'%.*s' is neither LIN, CIR nor BRK",
                                         text_shown(word), word.start);
        }
    }
}

/* The last part of a path of any system, without quotes. */
static struct text name_of(struct text path)
{
    while (path.length > 0 && path.start[0] == '"') {
        path = (struct text){path.start + 1, path.length - 1};
    }
    while (path.length > 0 && path.start[path.length - 1] == '"') {
        path.length--;
    }
    for (size_t i = path.length; i-- > 0;) {
        if (path.start[i] == '/' || path.start[i] == '\\') {
            return (struct text){path.start + i + 1, path.length - i - 1};
        }
    }
    return path;
}

/* Names of files differ in no letter's case where the program runs: as written, small, large. */
static bool read_beside(const struct foreign_job *job, struct text name, struct text *content,
                        struct error *error)
{
    const char *slash = strrchr(job->source, '/');
    int folder = slash != NULL ? (int)(slash + 1 - job->source) : 0;
    error->code = ERROR_NONE;
    for (int attempt = 0; attempt < 3 && job->reads_beside && error->code == ERROR_NONE;
         attempt++) {
        char *file = arena_string(job->arena, name.start, name.length);
        for (char *c = file; *c != '\0' && attempt > 0; c++) {
            bool small = *c >= 'a' && *c <= 'z', large = *c >= 'A' && *c <= 'Z';
            *c = (char)(attempt == 1 && large   ? *c + ('a' - 'A')
                        : attempt == 2 && small ? *c - ('a' - 'A')
                                                : *c);
        }
        if (whole_file(arena_printf(job->arena, "%.*s%s", folder, job->source, file), job->arena,
                       content, error)) {
            return true;
        }
    }
    return false;
}

static void read_shapes(struct shapes *shapes, struct text content)
{
    for (struct text rest = content; rest.start != NULL && shapes->wrong == NULL;) {
        read_line(shapes, text_cut(&rest, '\n'));
        if (shapes->count > MOST_SHAPES || shapes->corner_count > MOST_CORNERS) {
            shapes->wrong = "more shapes or corners than lenscalc reads";
        }
    }
    end_polygon(shapes);
    if (shapes->wrong == NULL && shapes->count == 0) {
        shapes->wrong = "it has no shape";
    }
    if (shapes->wrong == NULL && shapes->count > 1 && !shapes->blocks) {
        shapes->wrong = "light passes several shapes";
    }
    for (size_t i = 0; i < shapes->count && shapes->wrong == NULL; i++) {
        struct error wrong;
        if (!aperture_check(&shapes->all[i], &wrong)) {
            shapes->wrong = arena_printf(shapes->arena, "%s", wrong.message);
        }
    }
}

bool zemax_user_apertures(struct zemax_file *file, const struct zemax_surface *from,
                          struct aperture **apertures, size_t *count, struct error *error)
{
    const struct zemax_line *line = from->user_aperture;
    const struct text name = name_of(from->user_file);
    struct shapes shapes = {.arena = file->job->arena,
                            .unit = lens_unit_scale(file->build.lens->unit),
                            .blocks = from->user_blocks};
    struct text content;
    struct error why = {.code = ERROR_NONE};
    if (name.length == 0) {
        return !zemax_loss(
            file, line, error,
            "%.4s: an aperture of a file that is not named" LOSS_VIGNETTES LOSS_INSTEAD "left out",
            line->keyword.start);
    }
    if (!read_beside(file->job, name, &content, &why)) {
        shapes.wrong = why.code != ERROR_NONE    ? why.message
                       : file->job->reads_beside ? "there is no such file beside the lens file"
                                                 : "files beside it are not read";
    } else if (!encoding_to_utf8(file->job->source, content, file->job->arena, &content, &why)) {
        shapes.wrong = why.message;
    } else {
        read_shapes(&shapes, content);
    }
    *apertures = shapes.all;
    *count = shapes.count;
    if (shapes.wrong == NULL) {
        return true;
    }
    error->code = ERROR_NONE;
    return !zemax_loss(file, line, error,
                       "%.4s: the aperture of the file '%.*s' (%s)" LOSS_VIGNETTES LOSS_INSTEAD
                       "left out",
                       line->keyword.start, text_shown(name), name.start, shapes.wrong);
}
