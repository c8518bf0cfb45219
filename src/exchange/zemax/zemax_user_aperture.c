/* exchange/zemax/zemax_user_aperture.c - polygons and circles of .zmx and .uda files. */
/* SPDX-License-Identifier: MIT */
#include "exchange/zemax/zemax.h"

#include "base/number.h"
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

static struct aperture *add_uda_shape(struct shapes *shapes, enum aperture_shape shape)
{
    struct aperture *one = ARENA_ADD(shapes->arena, shapes->all, shapes->count, shapes->room);
    *one = aperture_of(shape, shapes->blocks);
    return one;
}

/* The corners that have been are a polygon. */
static void end_polygon(struct shapes *shapes)
{
    size_t count = shapes->corner_count;
    const struct figure(*corners)[2] = (const struct figure(*)[2])shapes->corners;
    if (count > 1 && corners[0][0].value.hi == corners[count - 1][0].value.hi &&
        corners[0][1].value.hi == corners[count - 1][1].value.hi) {
        count--;
    }
    if (count > 0) {
        struct aperture *polygon = add_uda_shape(shapes, SHAPE_POLYGON);
        polygon->points = corners;
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
    memcpy(*ARENA_ADD(shapes->arena, shapes->corners, shapes->corner_count, shapes->corner_room),
           numbers, sizeof *shapes->corners);
}

static void add_uda_circle(struct shapes *shapes, const struct figure *numbers, size_t count)
{
    if (count < 3) {
        shapes->wrong = "a circle needs x, y and a radius";
        return;
    }
    end_polygon(shapes);
    struct aperture *circle = add_uda_shape(shapes, SHAPE_CIRCLE);
    const struct pair twice = {2 * numbers[2].value.hi, 2 * numbers[2].value.lo};
    circle->size[0] = figure_computed(twice, shapes->unit, shapes->arena);
    for (int i = 0; i < 2; i++) {
        circle->decenter[i] = numbers[i].value.hi != 0 ? numbers[i] : circle->decenter[i];
    }
}

/* The next word up to a blank or a comma. */
static struct text uda_word(struct text *rest)
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
static size_t uda_numbers(struct shapes *shapes, struct text rest, struct figure numbers[4])
{
    size_t count = 0;
    for (struct text word = uda_word(&rest); word.length > 0 && count < 4; word = uda_word(&rest)) {
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

/* x and y without a word: a corner, or 0 0 behind the last one of a polygon. */
static void add_plain_corner(struct shapes *shapes, const struct figure *numbers, size_t count)
{
    if (count == 2 && numbers[0].value.hi == 0 && numbers[1].value.hi == 0) {
        end_polygon(shapes);
    } else {
        add_corner(shapes, numbers, count);
    }
}

static void uda_line(struct shapes *shapes, struct text line)
{
    struct text rest = line;
    const struct text word = uda_word(&rest);
    struct figure numbers[4];
    if (word.length == 0 || word.start[0] == '!') {
        return;
    }
    if (text_same(word, "LIN")) {
        add_corner(shapes, numbers, uda_numbers(shapes, rest, numbers));
    } else if (text_same(word, "CIR")) {
        add_uda_circle(shapes, numbers, uda_numbers(shapes, rest, numbers));
    } else if (text_same(word, "BRK")) {
        end_polygon(shapes);
    } else {
        size_t count = uda_numbers(shapes, line, numbers);
        if (count > 0) {
            add_plain_corner(shapes, numbers, count); /* of old files */
        } else {
            shapes->wrong = arena_printf(shapes->arena, "'%.*s' is neither LIN, CIR nor BRK",
                                         text_shown(word), word.start);
        }
    }
}

/* The last part of a path of any system, without quotes. */
static struct text uda_name(struct text path)
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
static bool uda_content(const struct foreign_job *job, struct text name, struct text *content,
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
            if (attempt == 1 ? large : small) {
                *c = (char)(*c ^ ('a' - 'A'));
            }
        }
        if (whole_file(arena_printf(job->arena, "%.*s%s", folder, job->source, file), job->arena,
                       content, error)) {
            return true;
        }
    }
    return false;
}

static void check_room(struct shapes *shapes)
{
    if (shapes->count > MOST_SHAPES || shapes->corner_count > MOST_CORNERS) {
        shapes->wrong = "more shapes or corners than lenscalc reads";
    }
}

/* Rows 1, 2 .. of number, x, y and a 0, whose meaning otherwise is not known. */
static void read_rows(struct shapes *shapes, const struct zemax_surface *from)
{
    for (size_t i = 0; i < from->user_row_count && shapes->wrong == NULL; i++) {
        const struct zemax_line *row = from->user_rows[i];
        const struct text number = row->first;
        double value = 0;
        text_number(number, NUMBER_UNSCALED, &value);
        if (value != (double)(i + 1)) {
            shapes->wrong = arena_printf(shapes->arena, "row %zu of it is missing", i + 1);
        } else if (row->count != 4 || row->stray.start != NULL || row->numbers[3].value.hi != 0) {
            shapes->wrong = arena_printf(shapes->arena, "row %zu is not x, y and 0", i + 1);
        } else {
            add_plain_corner(shapes, &row->numbers[1], 2);
            check_room(shapes);
        }
    }
}

/* From where to where a polygon reaches along an axis. */
static void uda_range(const struct aperture *polygon, int axis, double range[2])
{
    range[0] = INFINITY;
    range[1] = -INFINITY;
    for (size_t i = 0; i < polygon->point_count; i++) {
        range[0] = fmin(range[0], polygon->points[i][axis].value.hi);
        range[1] = fmax(range[1], polygon->points[i][axis].value.hi);
    }
}

/* Does a line along x or y lie between them? */
static bool has_line_between(const struct aperture *a, const struct aperture *b)
{
    bool apart = false;
    for (int axis = 0; axis < 2; axis++) {
        double one[2], other[2];
        uda_range(a, axis, one);
        uda_range(b, axis, other);
        apart = apart || one[1] <= other[0] || other[1] <= one[0];
    }
    return apart;
}

static bool are_polygons_apart(const struct shapes *shapes)
{
    for (size_t i = 0; i < shapes->count; i++) {
        if (shapes->all[i].shape != SHAPE_POLYGON) {
            return false;
        }
        for (size_t k = 0; k < i; k++) {
            if (!has_line_between(&shapes->all[i], &shapes->all[k])) {
                return false;
            }
        }
    }
    return true;
}

/* By the sign of its area. */
static bool is_clockwise(const struct aperture *polygon)
{
    double sum = 0;
    for (size_t i = 0; i < polygon->point_count; i++) {
        const struct figure *p = polygon->points[i];
        const struct figure *q = polygon->points[(i + 1) % polygon->point_count];
        sum += p[0].value.hi * q[1].value.hi - q[0].value.hi * p[1].value.hi;
    }
    return sum < 0;
}

/*
 * Light passes within any of several polygons that are apart: one that goes round each of them, and
 * between them there and back along sides that are no edge. All are gone round the same way, as the
 * area of the whole has to be theirs.
 */
static void join_polygons(struct shapes *shapes)
{
    size_t room = 2 * shapes->count, used = 0;
    for (size_t k = 0; k < shapes->count; k++) {
        room += shapes->all[k].point_count;
    }
    struct figure(*corners)[2] = arena_array(shapes->arena, room, sizeof corners[0]);
    for (size_t k = 0; k < shapes->count; k++) {
        const struct aperture *polygon = &shapes->all[k];
        const size_t count = polygon->point_count;
        const bool backwards = is_clockwise(polygon);
        for (size_t i = 0; i <= count; i++, used++) {
            const struct figure *corner = polygon->points[(backwards ? count - i : i) % count];
            corners[used][0] = corner[0];
            corners[used][1] = corner[1];
        }
    }
    for (size_t k = shapes->count - 1; k-- > 1; used++) {
        corners[used][0] = shapes->all[k].points[0][0];
        corners[used][1] = shapes->all[k].points[0][1];
    }
    shapes->all[0].points = (const struct figure(*)[2])corners;
    shapes->all[0].point_count = used;
    shapes->count = 1;
}

/* All have been read: are they shapes that a surface of a lens can have? */
static void check_shapes(struct shapes *shapes)
{
    end_polygon(shapes);
    if (shapes->wrong == NULL && shapes->count == 0) {
        shapes->wrong = "it has no shape";
    }
    const bool is_joined = shapes->wrong == NULL && shapes->count > 1 && !shapes->blocks;
    if (is_joined && !are_polygons_apart(shapes)) {
        shapes->wrong = "light passes several shapes, which are not polygons apart in x or y";
    }
    for (size_t i = 0; i < shapes->count && shapes->wrong == NULL; i++) {
        struct error wrong;
        if (!aperture_check(&shapes->all[i], &wrong)) {
            shapes->wrong = arena_printf(shapes->arena, "%s", wrong.message);
        }
    }
    if (is_joined && shapes->wrong == NULL) {
        join_polygons(shapes);
        struct error wrong;
        if (!aperture_check(&shapes->all[0], &wrong)) {
            shapes->wrong = arena_printf(shapes->arena, "%s", wrong.message);
        }
    }
}

bool zemax_user_apertures(struct zemax_file *file, const struct zemax_surface *from,
                          struct aperture **apertures, size_t *count)
{
    const struct zemax_line *line = from->user_aperture;
    const bool is_inline = from->user_row_count > 0;
    const struct text name = is_inline ? text_of("") : uda_name(from->user_file);
    struct shapes shapes = {.arena = file->job->arena,
                            .unit = lens_unit_scale(file->build.lens->unit),
                            .blocks = from->user_blocks};
    struct text content;
    struct error why = {.code = ERROR_NONE};
    if (is_inline) {
        read_rows(&shapes, from);
    } else if (name.length == 0) {
        return !zemax_loss(file, line, LOSS_OF_VIGNETTING, "left out",
                           "%.4s: an aperture of a file that is not named", line->keyword.start);
    } else if (!uda_content(file->job, name, &content, &why)) {
        if (why.code != ERROR_NONE) {
            shapes.wrong = why.message;
        } else if (file->job->reads_beside) {
            shapes.wrong = "there is no such file beside the lens file";
        } else {
            shapes.wrong = "files beside it are not read";
        }
    } else if (!encoding_to_utf8(file->job->source, content, file->job->arena, &content, &why)) {
        shapes.wrong = why.message;
    } else {
        for (struct text rest = content; rest.start != NULL && shapes.wrong == NULL;) {
            uda_line(&shapes, text_cut(&rest, '\n'));
            check_room(&shapes);
        }
    }
    if (shapes.wrong == NULL) {
        check_shapes(&shapes);
    }
    *apertures = shapes.all;
    *count = shapes.count;
    if (shapes.wrong == NULL) {
        return true;
    }
    file->error->code = ERROR_NONE;
    if (is_inline) {
        return !zemax_loss(file, line, LOSS_OF_VIGNETTING, "left out",
                           "%.4s: a user-defined aperture (%s)", line->keyword.start, shapes.wrong);
    }
    return !zemax_loss(file, line, LOSS_OF_VIGNETTING, "left out",
                       "%.4s: the aperture of the file '%.*s' (%s)", line->keyword.start,
                       text_shown(name), name.start, shapes.wrong);
}
