/* exchange/pbrt.c - read lens tables of the realistic camera of pbrt. */
/* SPDX-License-Identifier: MIT */
#include "exchange/pbrt.h"

#include "base/number.h"
#include "file/lens_build.h"
#include "file/lens_words.h"

#include <math.h>
#include <string.h>

enum pbrt_cell { RADIUS, THICKNESS, INDEX, DIAMETER, CELLS };

static const char *const names[CELLS] = {"radius", "thickness", "index", "diameter"};

/* The next line without its comment; false at the end. */
static bool pbrt_next_line(struct text *rest, struct text *line, struct text *comment)
{
    if (rest->start == NULL || rest->length == 0) {
        return false;
    }
    struct text after = text_cut(rest, '\n');
    *line = text_cut(&after, '#');
    *comment = after.start != NULL ? text_trim(after) : (struct text){"", 0};
    return true;
}

/* Numbers in fours and comments, and nothing else. */
static bool pbrt_is_like(struct text content)
{
    struct text rest = content, line, comment;
    size_t numbers = 0;
    while (pbrt_next_line(&rest, &line, &comment)) {
        const char *at = line.start, *end = line.start + line.length;
        while (at < end) {
            double value;
            if (*at == ' ' || *at == '\t') {
                at++;
                continue;
            }
            at = number_read(at, end, NUMBER_UNSCALED, &value);
            if (at == NULL || (at < end && *at != ' ' && *at != '\t')) {
                return false;
            }
            numbers++;
        }
    }
    return numbers > 0 && numbers % CELLS == 0;
}

/* A surface being read: its numbers, and the word that says each. */
struct pbrt_row {
    struct figure figures[CELLS];
    struct text words[CELLS];
};

static struct medium pbrt_medium_of(const struct figure *index)
{
    if (!(index->value.hi > 0) ||
        (!(fabs(index->value.hi - 1) > 0) && !(fabs(index->value.lo) > 0))) {
        return medium_air;
    }
    return (struct medium){.kind = MEDIUM_CONSTANT, .written = index->typed, .index = index->value};
}

static bool is_same_index(const struct medium *a, const struct medium *b)
{
    return !(fabs(a->index.hi - b->index.hi) > 0) && !(fabs(a->index.lo - b->index.lo) > 0);
}

/* Radius 0: a stop, unless it is between two media. */
static bool pbrt_read_stop(struct lens_build *build, const struct file_words *words,
                           const struct pbrt_row *row, struct surface *surface, struct error *error)
{
    size_t at = build->lens->surface_count - 1;
    const struct medium *before = at > 0 ? &surface[-1].medium : &medium_air;
    surface->is_plane = true;
    if (!(row->figures[INDEX].value.hi > 0)) {
        surface->medium = *before;
    } else if (!is_same_index(before, &surface->medium)) {
        file_words_fail(words, row->words[RADIUS], error,
                        "radius 0 is the stop, which does not refract, but the index changes here");
        return error_hint(error, "write a plane as a very long radius");
    }
    if (build->lens->stop != LENS_NONE) {
        return file_words_fail(words, row->words[RADIUS], error,
                               "a second stop: surface %zu is one already", build->lens->stop + 1);
    }
    lens_build_stop(build, at);
    build->lens->aperture_kind = APERTURE_STOP;
    return true;
}

static bool pbrt_add_surface(struct lens_build *build, const struct file_words *words,
                             const struct pbrt_row *row, struct error *error)
{
    for (int i = INDEX; i < CELLS; i++) {
        if (!(row->figures[i].value.hi >= 0)) {
            return file_words_fail(words, row->words[i], error, "a negative %s", names[i]);
        }
    }
    if (!(row->figures[DIAMETER].value.hi > 0)) {
        return file_words_fail(words, row->words[DIAMETER], error, "a surface without diameter");
    }
    if (build->lens->surface_count == LENS_MOST_SURFACES) {
        return file_words_fail(words, row->words[RADIUS], error, "more than %d surfaces",
                               LENS_MOST_SURFACES);
    }
    struct surface *surface = lens_build_surface(build);
    surface->thickness = row->figures[THICKNESS];
    surface->has_thickness = true;
    surface->diameter = row->figures[DIAMETER];
    surface->has_diameter = true;
    surface->medium = pbrt_medium_of(&row->figures[INDEX]);
    if (fabs(row->figures[RADIUS].value.hi) > 0) {
        surface->is_plane = false;
        surface->radius = row->figures[RADIUS];
        return true;
    }
    return pbrt_read_stop(build, words, row, surface, error);
}

static bool pbrt_read_words(struct lens_build *build, struct file_words *words, struct error *error)
{
    struct pbrt_row row;
    int cell = RADIUS;
    struct text last = {words->rest.start, 0};
    struct file_words there = *words; /* in the line of the last word */
    while (file_words_line(words)) {
        for (struct text word = file_words_next(words); word.length > 0;
             word = file_words_next(words)) {
            row.words[cell] = last = word;
            there = *words;
            if (!lens_words_figure(words, word, NUMBER_UNSCALED, names[cell], &row.figures[cell],
                                   error)) {
                return false;
            }
            if (++cell == CELLS) {
                cell = RADIUS;
                if (!pbrt_add_surface(build, words, &row, error)) {
                    return false;
                }
            }
        }
        /* a surface may go over several lines: then messages point at the last */
        for (int i = 0; i < cell; i++) {
            row.words[i] = (struct text){words->line.start, 0};
        }
    }
    if (cell != RADIUS) {
        return file_words_fail(&there, last, error, "the last surface has no %s", names[cell]);
    }
    return build->lens->surface_count > 0 ||
           (fail(error, ERROR_DATA, "no surface: a line is radius, thickness, index, diameter") ||
            error_locate(error, words->source, 0, 0));
}

static bool pbrt_read(struct foreign_job *job, struct text content, struct lens *lens,
                      struct error *error)
{
    struct file_words words;
    struct lens_build build;
    lens_build_begin(&build, lens, job->arena);
    /* The title, from the first comment, and notes from the others. */
    struct text rest = content, line, comment;
    while (pbrt_next_line(&rest, &line, &comment)) {
        if (comment.length > 0 && build.lens->title == NULL) {
            build.lens->title = lens_build_string(&build, comment);
        } else if (comment.length > 0) {
            lens_build_note(&build, comment);
        }
    }
    if (!file_words_open(&words, job->source, content, job->arena, error) ||
        !pbrt_read_words(&build, &words, error)) {
        return false;
    }
    /* The camera has air before its film, and its lens a stop. */
    const struct surface *last = &lens->surfaces[lens->surface_count - 1];
    if (!medium_is_air(&last->medium)) {
        foreign_cut_short(job, "behind its last surface is glass");
    } else if (lens->stop == LENS_NONE) {
        foreign_cut_short(job, "it has no stop, a surface of radius 0");
    }
    return true;
}

const struct foreign_format pbrt_format = {
    .type = {{"dat", "pbrt"}, ".dat"},
    .is_like = pbrt_is_like,
    .read = pbrt_read,
    .write = pbrt_write,
};
