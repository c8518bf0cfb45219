/* exchange/zemax/zemax_aperture.c - CLAP, SQAP, ELAP, OBSC, SQOB, ELOB, SPID and OBDC. */
/* SPDX-License-Identifier: MIT */
#include "exchange/zemax/zemax.h"
#include "exchange/zemax/zemax_writer.h"

#include "file/lens_unit.h"
#include "optics/aperture.h"

#include <math.h>

/* Half sizes stand behind each word; of a ring the radii, of which the first may be 0: a circle. */
static const struct {
    const char *word;
    enum aperture_shape shape;
    bool blocks;
} words[] = {{"CLAP", SHAPE_RING, false},      {"OBSC", SHAPE_RING, true},
             {"SQAP", SHAPE_RECTANGLE, false}, {"SQOB", SHAPE_RECTANGLE, true},
             {"ELAP", SHAPE_ELLIPSE, false},   {"ELOB", SHAPE_ELLIPSE, true},
             {"SPID", SHAPE_SPIDER, true}};
enum { WORDS = sizeof words / sizeof words[0] };

static struct figure figure_twice(struct zemax_file *file, const struct figure *half)
{
    struct pair value = {2 * half->value.hi, 2 * half->value.lo};
    return figure_computed(value, lens_unit_scale(file->build.lens->unit), file->job->arena);
}

static bool set_aperture_sizes(struct zemax_file *file, const struct zemax_line *line,
                               struct aperture *aperture)
{
    if (aperture->shape == SHAPE_SPIDER) {
        /* Width of an arm, and how many. */
        double count = 0;
        const struct figure *arms = &line->numbers[1];
        text_number(arms->typed, NUMBER_UNSCALED, &count);
        aperture->size[0] = line->numbers[0];
        aperture->arms = count >= 1 && count <= APERTURE_MOST_ARMS ? (unsigned)count : 0;
        return aperture->arms == count;
    }
    aperture->size[0] = figure_twice(file, &line->numbers[0]);
    aperture->size[1] = figure_twice(file, &line->numbers[1]);
    if (aperture->shape == SHAPE_RING && line->numbers[0].value.hi == 0) {
        aperture->shape = SHAPE_CIRCLE;
        aperture->size[0] = aperture->size[1];
    }
    return true;
}

/* Where a diameter stands beside apertures that pass, it is one about all of them. */
static void give_apertures(struct surface *to, const struct aperture *apertures, size_t count)
{
    const struct surface alone = {.apertures = apertures, .aperture_count = count};
    to->apertures = apertures;
    to->aperture_count = count;
    to->has_diameter = to->has_diameter && (apertures[0].blocks || to->is_stop ||
                                            to->diameter.value.hi / 2 >= aperture_reach(&alone));
}

/* OBDC shifts what it is of. */
static void shift_aperture(struct zemax_file *file, const struct zemax_line *shift,
                           struct aperture *aperture)
{
    for (size_t k = 0; k < 2 && shift != NULL; k++) {
        if (zemax_number(shift, k) != 0) {
            struct figure *centre = &aperture->decenter[k];
            *centre =
                centre->value.hi == 0
                    ? shift->numbers[k]
                    : figure_computed(pair_add(centre->value, shift->numbers[k].value),
                                      lens_unit_scale(file->build.lens->unit), file->job->arena);
        }
    }
}

bool zemax_set_aperture(struct zemax_file *file, const struct zemax_surface *from,
                        struct surface *to)
{
    const struct zemax_line *line = from->aperture, *shift = from->aperture_shift;
    size_t word = line != NULL ? 0 : WORDS;
    while (word < WORDS && !text_same(line->keyword, words[word].word)) {
        word++;
    }
    struct error wrong;
    if (from->user_aperture != NULL) {
        struct aperture *apertures;
        size_t count;
        if (!zemax_user_apertures(file, from, &apertures, &count)) {
            to->has_diameter = to->has_diameter && zemax_number(from->diameter, 1) == 0;
            return file->error->code == ERROR_NONE;
        }
        for (size_t i = 0; i < count; i++) {
            shift_aperture(file, from->aperture_shift, &apertures[i]);
        }
        give_apertures(to, apertures, count);
        return true;
    }
    if (word == WORDS) {
        return shift == NULL || zemax_loss(file, shift, LOSS_OF_VIGNETTING, "left out",
                                           "a decentre of an aperture that is not stated");
    }
    struct aperture *aperture = ARENA_NEW(file->job->arena, struct aperture);
    *aperture = aperture_of(words[word].shape, words[word].blocks);
    bool sound = set_aperture_sizes(file, line, aperture);
    if (sound && aperture->blocks && aperture->shape != SHAPE_SPIDER &&
        line->numbers[0].value.hi == 0 && line->numbers[1].value.hi == 0) {
        return true; /* it blocks nothing */
    }
    shift_aperture(file, shift, aperture);
    if (!sound || !aperture_check(aperture, &wrong)) {
        return zemax_loss(file, line, LOSS_OF_VIGNETTING, "left out",
                          "%.4s: an aperture that is none", line->keyword.start);
    }
    /* a centred circle is the diameter */
    if (!aperture->blocks && aperture->shape == SHAPE_CIRCLE && aperture_is_round(aperture)) {
        return true;
    }
    give_apertures(to, aperture, 1);
    return true;
}

/* -------- writing -------- */

/* Why the format cannot have it; null: it can. */
static const char *aperture_refusal(const struct aperture *aperture)
{
    bool quarter = aperture->shape == SHAPE_CIRCLE || aperture->shape == SHAPE_RING;
    if (aperture->shape == SHAPE_POLYGON) {
        return "a polygon stands in another file";
    }
    if (!quarter && aperture->turn.value.hi != 0) {
        return "apertures are not turned there";
    }
    return NULL;
}

const char *zemax_half(const struct lens_writer *writing, const struct figure *figure)
{
    if (figure->variable != LENS_NONE) {
        figure = &writing->lens->variables[figure->variable].values[0];
    }
    const struct figure half = {.value = {figure->value.hi / 2, figure->value.lo / 2},
                                .variable = LENS_NONE};
    return writing_length(writing, &half, 1);
}

void zemax_put_aperture(struct lens_writer *writing, const struct surface *surface, size_t number)
{
    const struct aperture *kept = NULL;
    for (size_t i = 0; i < surface->aperture_count; i++) {
        const struct aperture *aperture = &surface->apertures[i];
        const char *refusal =
            kept != NULL ? "a surface has one aperture there" : aperture_refusal(aperture);
        if (refusal == NULL) {
            bool circle = aperture->shape == SHAPE_CIRCLE;
            size_t row = 0;
            while (words[row].shape != (circle ? SHAPE_RING : aperture->shape) ||
                   words[row].blocks != aperture->blocks) {
                row++;
            }
            if (aperture->shape == SHAPE_SPIDER) {
                writing_put(writing, "  %s %s %u 0\r\n", words[row].word,
                            writing_length(writing, &aperture->size[0], 1), aperture->arms);
            } else {
                writing_put(writing, "  %s %s %s 0\r\n", words[row].word,
                            circle ? "0" : zemax_half(writing, &aperture->size[0]),
                            zemax_half(writing, &aperture->size[circle ? 0 : 1]));
            }
            if (aperture->decenter[0].value.hi != 0 || aperture->decenter[1].value.hi != 0) {
                writing_put(writing, "  OBDC %s %s\r\n",
                            writing_length(writing, &aperture->decenter[0], 1),
                            writing_length(writing, &aperture->decenter[1], 1));
            }
            kept = aperture;
        } else {
            writing_lose_aperture(writing, surface, aperture, refusal);
        }
    }
    struct surface alone = {.apertures = kept, .aperture_count = 1};
    if (kept != NULL && !kept->blocks && surface->has_diameter && !surface->is_stop &&
        surface->diameter.value.hi / 2 < aperture_reach(&alone)) {
        foreign_lose(writing->job, LOSS_OF_VIGNETTING, "left out",
                     "surface %zu: its diameter beside a %s", number,
                     aperture_shapes[kept->shape].word);
    }
}
