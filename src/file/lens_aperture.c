/* file/lens_aperture.c - `pass rectangle 20 10 decenter=0,1 turn=30`. */
/* SPDX-License-Identifier: MIT */
#include "file/lens_surface.h"

#include "base/constants.h"
#include "file/lens_words.h"

#include <string.h>

static bool read_sizes(struct file_words *words, const char *what, struct figure *size)
{
    struct text word = file_words_next(words);
    return lens_words_figure(words, word, words->scale, what, size) &&
           (size->value.hi > 0 || file_words_fail(words, word, "the %s must be above 0", what));
}

static bool read_arms(struct file_words *words, unsigned *arms)
{
    struct text word = file_words_next(words);
    struct figure figure;
    if (!lens_words_figure(words, word, NUMBER_UNSCALED, "number of arms", &figure)) {
        return false;
    }
    double count = figure.value.hi;
    *arms = count >= 1 && count <= APERTURE_MOST_ARMS ? (unsigned)count : 0;
    return (*arms > 0 && *arms == count) ||
           file_words_fail(words, word, "a spider has 1 to %d arms", APERTURE_MOST_ARMS);
}

/* x,y as far as words have no '='. */
static bool read_corners(struct file_words *words, struct aperture *aperture)
{
    const struct vector_form form = {"corner", 2, words->scale, 0};
    struct figure(*points)[2] = NULL;
    size_t room = 0, count = 0;
    for (struct file_words ahead = *words;; *words = ahead) {
        struct text word = file_words_next(&ahead);
        if (word.length == 0 || memchr(word.start, '=', word.length) != NULL) {
            break;
        }
        points = arena_grow(words->arena, points, count, &room, sizeof *points);
        points[count][0] = points[count][1] = (struct figure){.variable = LENS_NONE};
        if (memchr(word.start, ',', word.length) == NULL) {
            return file_words_fail(words, word, "a corner of a polygon is written x,y");
        }
        if (!lens_words_vector(words, word, &form, points[count])) {
            return false;
        }
        count++;
    }
    aperture->points = (const struct figure(*)[2])points;
    aperture->point_count = count;
    return true;
}

/* decenter=x,y and turn=a, each once. */
static bool read_shift_and_turn(struct file_words *words, struct aperture *aperture)
{
    const struct vector_form shift = {"decentre", 2, words->scale, 0};
    const struct vector_form turn = {"turn", 1, NUMBER_UNSCALED, RADIANS_PER_DEGREE};
    unsigned seen = 0;
    for (struct text word = file_words_next(words); word.length > 0;
         word = file_words_next(words)) {
        struct text value = word, key = text_cut(&value, '=');
        bool decenter = text_equal(key, "decenter"), turned = text_equal(key, "turn");
        unsigned bit = decenter ? 1 : 2;
        if (value.start == NULL || (!decenter && !turned)) {
            return file_words_fail(
                words, word, "behind the sizes an aperture has decenter=x,y and turn=degrees");
        }
        if ((seen & bit) != 0) {
            return file_words_fail(words, word, "'%.*s=' is there twice", text_shown(key),
                                   key.start);
        }
        seen |= bit;
        if (decenter ? !lens_words_vector(words, value, &shift, aperture->decenter)
                     : !lens_words_vector(words, value, &turn, &aperture->turn)) {
            return false;
        }
    }
    return true;
}

static bool read_shape(struct file_words *words, bool blocks, struct aperture *aperture)
{
    struct text word = file_words_next(words);
    size_t shape = 0;
    while (shape < APERTURE_SHAPES && !text_equal(word, aperture_shapes[shape].word)) {
        shape++;
    }
    if (shape == APERTURE_SHAPES) {
        struct nearest nearest = {.typed = word};
        for (size_t i = 0; i < APERTURE_SHAPES; i++) {
            nearest_offer(&nearest, text_of(aperture_shapes[i].word));
        }
        file_words_fail(words, word,
                        "the shape is circle, ring, rectangle, ellipse, polygon or spider");
        return nearest.best.start != NULL &&
               error_hint(words->error, "did you mean '%.*s'?", (int)nearest.best.length,
                          nearest.best.start);
    }
    const struct aperture_traits *traits = &aperture_shapes[shape];
    *aperture = aperture_of((enum aperture_shape)shape, blocks);
    for (int i = 0; i < aperture_sizes(aperture->shape); i++) {
        if (!read_sizes(words, traits->sizes[i], &aperture->size[i])) {
            return false;
        }
    }
    if ((traits->has_arms && !read_arms(words, &aperture->arms)) ||
        (traits->has_points && !read_corners(words, aperture)) ||
        !read_shift_and_turn(words, aperture)) {
        return false;
    }
    struct error wrong = {.code = ERROR_NONE};
    return aperture_check(aperture, &wrong) || file_words_fail(words, word, "%s", wrong.message);
}

bool lens_aperture_read(struct file_words *words, bool blocks, struct surface *surface,
                        size_t *room)
{
    if (surface == NULL) {
        return file_words_fail(words, words->line,
                               "an aperture stands below the line of its surface");
    }
    struct aperture *all = arena_grow(words->arena, (void *)surface->apertures,
                                      surface->aperture_count, room, sizeof *all);
    surface->apertures = all;
    return read_shape(words, blocks, &all[surface->aperture_count++]);
}

static void put_place(struct text_buffer *text, const char *before, const struct figure *figures,
                      size_t count, struct number_scale unit)
{
    for (size_t i = 0; i < count; i++) {
        growing_string(text, i == 0 ? before : ",");
        growing_figure(text, &figures[i], unit);
    }
}

static bool is_zero_figure(const struct figure *figure)
{
    return figure->value.hi == 0;
}

void lens_aperture_write(const struct aperture *aperture, struct number_scale unit,
                         struct text_buffer *text)
{
    static const double degree = RADIANS_PER_DEGREE;
    growing_format(text, "%-12s%s", aperture->blocks ? "block" : "pass",
                   aperture_shapes[aperture->shape].word);
    put_place(text, " ", aperture->size, aperture_sizes(aperture->shape) > 0, unit);
    put_place(text, " ", aperture->size + 1, aperture_sizes(aperture->shape) > 1, unit);
    if (aperture_shapes[aperture->shape].has_arms) {
        growing_format(text, " %u", aperture->arms);
    }
    for (size_t i = 0; i < aperture->point_count; i++) {
        put_place(text, " ", aperture->points[i], 2, unit);
    }
    if (!is_zero_figure(&aperture->decenter[0]) || !is_zero_figure(&aperture->decenter[1])) {
        put_place(text, " decenter=", aperture->decenter, 2, unit);
    }
    if (!is_zero_figure(&aperture->turn)) {
        growing_string(text, " turn=");
        if (aperture->turn.typed.start != NULL) {
            growing_text(text, aperture->turn.typed);
        } else {
            growing_number(text, aperture->turn.value.hi / degree);
        }
    }
    growing_string(text, "\n");
}
