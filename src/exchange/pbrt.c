/* exchange/pbrt.c - read and write lens tables of the realistic camera of pbrt. */
/* SPDX-License-Identifier: MIT */
#include "exchange/pbrt.h"
#include "exchange/writing.h"
#include "optics/wavelength.h"

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
                           const struct pbrt_row *row, struct surface *surface)
{
    size_t at = build->lens->surface_count - 1;
    const struct medium *before = at > 0 ? &surface[-1].medium : &medium_air;
    surface->is_plane = true;
    if (!(row->figures[INDEX].value.hi > 0)) {
        surface->medium = *before;
    } else if (!is_same_index(before, &surface->medium)) {
        file_words_fail(words, row->words[RADIUS],
                        "radius 0 is the stop, which does not refract, but the index changes here");
        return error_hint(words->error, "write a plane as a very long radius");
    }
    if (build->lens->stop != LENS_NONE) {
        return file_words_fail(words, row->words[RADIUS],
                               "a second stop: surface %zu is one already", build->lens->stop + 1);
    }
    lens_build_stop(build, at);
    build->lens->aperture_kind = APERTURE_STOP;
    return true;
}

static bool pbrt_add_surface(struct lens_build *build, const struct file_words *words,
                             const struct pbrt_row *row)
{
    for (int i = INDEX; i < CELLS; i++) {
        if (!(row->figures[i].value.hi >= 0)) {
            return file_words_fail(words, row->words[i], "a negative %s", names[i]);
        }
    }
    if (!(row->figures[DIAMETER].value.hi > 0)) {
        return file_words_fail(words, row->words[DIAMETER], "a surface without diameter");
    }
    if (build->lens->surface_count == LENS_MOST_SURFACES) {
        return file_words_fail(words, row->words[RADIUS], "more than %d surfaces",
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
    return pbrt_read_stop(build, words, row, surface);
}

static bool pbrt_read_words(struct lens_build *build, struct file_words *words)
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
            if (!lens_words_figure(words, word, NUMBER_UNSCALED, names[cell], &row.figures[cell])) {
                return false;
            }
            if (++cell == CELLS) {
                cell = RADIUS;
                if (!pbrt_add_surface(build, words, &row)) {
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
        return file_words_fail(&there, last, "the last surface has no %s", names[cell]);
    }
    return build->lens->surface_count > 0 ||
           fail_in(words->error, words->source, 0, 0,
                   "no surface: a line is radius, thickness, index, diameter");
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
        !pbrt_read_words(&build, &words)) {
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

/* What stands for a plane that refracts, mm; see pbrt.h. */
#define LONG_RADIUS "100000"

static bool pbrt_refuse(const struct foreign_job *job, size_t number, const char *what,
                        struct error *error)
{
    return foreign_fail(job, error, "surface %zu %s: a .dat file cannot hold it", number, what);
}

static bool pbrt_lose_header(struct foreign_job *job, const struct lens *lens, struct error *error)
{
    bool only_d = lens->wavelength_count == 0 ||
                  (lens->wavelength_count == 1 &&
                   !(fabs(lens->wavelengths[0].wavelength - WAVELENGTH_D) > 0));
    if (!medium_is_air(&lens->object_medium)) {
        return foreign_fail(job, error, "a .dat file has air in front of the lens");
    }
    if (!only_d) {
        foreign_lose(
            job, LOSS_OF_RAYS,
            arena_printf(job->arena, "%.10g nm counts", 1000 * lens_primary_wavelength(lens)),
            "a .dat file has no wavelengths");
    }
    const struct {
        bool has;
        const char *what;
    } all[] = {{!lens->object_is_infinite, "object distance"},
               {lens->field_count > 0, "fields"},
               {lens->aperture_kind > APERTURE_STOP, "aperture but the stop's diameter"},
               {lens->focus != FOCUS_PARAXIAL, "choice of focus"}};
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++) {
        if (all[i].has) {
            foreign_lose(job, LOSS_OF_RAYS, NULL, "a .dat file has no %s", all[i].what);
        }
    }
    return true;
}

static bool pbrt_lose_shape(struct foreign_job *job, const struct surface *surface, size_t number,
                            struct error *error)
{
    if (surface_reflects(surface)) {
        return pbrt_refuse(job, number, "is a mirror", error);
    }
    if (!surface_is_round(surface)) {
        return pbrt_refuse(job, number, "is a cylinder", error);
    }
    if (!surface->has_diameter) {
        return pbrt_refuse(job, number, "has no diameter", error);
    }
    if (surface->decentre != NULL || surface->coordinate_break != NULL) {
        foreign_lose(job, LOSS_OF_RAYS, "left out", "surface %zu: its decentre or tilt", number);
    }
    if (fabs(surface->conic.value.hi) > 0 || surface->coefficients != 0) {
        foreign_lose(job, LOSS_OF_RAYS, "a sphere is used instead", "surface %zu: an asphere",
                     number);
    }
    if (surface->vary_count > 0) {
        foreign_lose(job, LOSS_OF_RAYS, "left out", "surface %zu: its marks for the designer",
                     number);
    }
    if (surface->name != NULL) {
        foreign_lose(job, LOSS_OF_RAYS, "left out", "surface %zu: its name", number);
    }
    return true;
}

/* Digits of a length in mm. */
static const char *pbrt_length(const struct lens_writer *writing, const struct figure *figure)
{
    struct figure in_mm = *figure;
    in_mm.variable = LENS_NONE;
    if (strcmp(writing->lens->unit, "mm") != 0) {
        in_mm = figure_computed(figure->value, NUMBER_UNSCALED, writing->arena);
    }
    return writing_length(writing, &in_mm, 0);
}

static const char *pbrt_radius(struct lens_writer *writing, const struct surface *surface,
                               size_t number)
{
    if (surface->kind == SURFACE_STOP) {
        if (!surface->is_stop) {
            foreign_lose(writing->job, LOSS_OF_RAYS, NULL, "surface %zu: pbrt takes it for a stop",
                         number);
        }
        return "0";
    }
    if (surface->is_stop) {
        foreign_lose(writing->job, LOSS_OF_RAYS, NULL,
                     "surface %zu: a .dat file has no stop on a surface", number);
    }
    const struct figure reciprocal = {.value = pair_divide(pair_of(1), surface->curvature.value),
                                      .variable = LENS_NONE};
    if (surface->has_curvature && fabs(reciprocal.value.hi) < 1e100) {
        return pbrt_length(writing, &reciprocal);
    }
    if (!surface->is_plane && !surface->has_curvature) {
        return pbrt_length(writing, &surface->radius);
    }
    foreign_lose(writing->job, LOSS_OF_RAYS, "a radius of " LONG_RADIUS " mm is used instead",
                 "surface %zu: a plane is pbrt's stop", number);
    return LONG_RADIUS;
}

/* The index behind a surface, at the primary wavelength; null with an error where there is none. */
static const char *pbrt_index(struct lens_writer *writing, const struct surface *surface,
                              size_t number, struct error *error)
{
    const struct medium *medium = &surface->medium;
    const double wavelength = lens_primary_wavelength(writing->lens);
    struct figure index = {.variable = LENS_NONE};
    if (medium_is_air(medium)) {
        return "1";
    }
    if (!medium_index(medium, wavelength, &index.value, error)) {
        error_prefix(error, "surface %zu: ", number);
        return NULL;
    }
    if (medium->kind == MEDIUM_CONSTANT) {
        index.typed = medium->written;
    } else {
        foreign_lose(writing->job, LOSS_OF_RAYS, NULL,
                     "surface %zu: of %.*s the index at %.10g nm is kept, no dispersion", number,
                     text_shown(medium->written), medium->written.start, 1000 * wavelength);
    }
    return writing_length(writing, &index, 0);
}

static bool pbrt_put_surface(struct lens_writer *writing, size_t i, struct error *error)
{
    const struct lens *lens = writing->lens;
    const struct surface *surface = &lens->surfaces[i];
    const struct medium *before = i > 0 ? &surface[-1].medium : &lens->object_medium;
    const bool is_stop = surface->kind == SURFACE_STOP;
    if (!pbrt_lose_shape(writing->job, surface, i + 1, error)) {
        return false;
    }
    const char *index = pbrt_index(writing, surface, i + 1, error);
    if (index == NULL) {
        return false;
    }
    const char *diameter = pbrt_length(writing, &surface->diameter);
    if (is_stop && !medium_is_same(before, &surface->medium)) { /* it stands before the plane */
        writing_put(writing, LONG_RADIUS "\t0\t%s\t%s\n", index, diameter);
        foreign_lose(writing->job, LOSS_OF_RAYS,
                     "a radius of " LONG_RADIUS " mm stands before the stop",
                     "surface %zu: a stop that refracts", i + 1);
    }
    writing_put(writing, "%s\t%s\t%s\t%s\n", pbrt_radius(writing, surface, i + 1),
                surface->has_thickness ? pbrt_length(writing, &surface->thickness) : "0",
                is_stop && medium_is_air(&surface->medium) ? "0" : index, diameter);
    return true;
}

static void pbrt_put_comment(struct lens_writer *writing, const char *word, const char *text)
{
    if (text != NULL) {
        writing_put(writing, "# %s%s\n", word, text);
    }
}

static bool pbrt_write(struct foreign_job *job, const struct lens *lens, struct text *text,
                       struct error *error)
{
    struct lens_writer writing;
    writing_begin(&writing, job, lens_at_position(lens, 0, job->arena), false);
    if (lens->position_count > 1) {
        foreign_lose(job, LOSS_OF_RAYS, NULL, "a .dat file has one position: the first, '%s'",
                     lens->positions[0]);
    }
    if (!pbrt_lose_header(job, writing.lens, error)) {
        return false;
    }
    pbrt_put_comment(&writing, "", lens->title != NULL ? lens->title : "lens");
    pbrt_put_comment(&writing, "source ", lens->source);
    pbrt_put_comment(&writing, "kind ", lens->kind);
    for (size_t i = 0; i < lens->note_count; i++) {
        pbrt_put_comment(&writing, "", lens->notes[i]);
    }
    writing_put(&writing, "# radius\tthickness\tindex\tdiameter\n");
    for (size_t i = 0; i < lens->surface_count; i++) {
        if (!pbrt_put_surface(&writing, i, error)) {
            return false;
        }
    }
    *text = growing_done(&writing.text);
    return true;
}

const struct foreign_format pbrt_format = {
    .type = {{"dat", "pbrt"}, ".dat"},
    .is_like = pbrt_is_like,
    .read = pbrt_read,
    .write = pbrt_write,
};
