/* exchange/codev/codev_aperture.c - CIR, REX, REY, ELX, ELY and what shifts or turns them. */
/* SPDX-License-Identifier: MIT */
#include "exchange/codev/codev.h"

/* What stands before the size of an aperture: CLR, EDG, OBS, HOL and a label. */
struct aperture_words {
    bool is_edge, blocks;
    struct text label;
    size_t next; /* the word with the size */
};

static struct aperture_words aperture_words(const struct codev *codev)
{
    const struct commands *commands = &codev->commands;
    struct aperture_words words = {.label = {"", 0}, .next = codev->here.next};
    for (; words.next < commands->count; words.next++) {
        const struct text word = commands->words[words.next].text;
        bool is_edge = text_same(word, "EDG");
        bool blocks = text_same(word, "OBS") || text_same(word, "HOL");
        bool is_label = word.length > 1 && (word.start[0] | 32) == 'l' &&
                        (word.start[1] == '\'' || word.start[1] == '"');
        if (!is_edge && !blocks && !is_label && !text_same(word, "CLR")) {
            break;
        }
        words.is_edge = words.is_edge || is_edge;
        words.blocks = words.blocks || blocks;
        words.label = is_label ? word : words.label;
    }
    return words;
}

/*
 * The aperture of these words, made if there is none.
 *
 * Given     shape  APERTURE_SHAPES: any, the last one
 */
static struct aperture *find_aperture(struct codev *codev, const struct aperture_words *words,
                                      enum aperture_shape shape)
{
    struct sequence_surface *surface = &codev->sequence.surfaces[codev->here.surface];
    for (size_t i = surface->aperture_count; i-- > 0;) {
        struct sequence_aperture *one = &surface->apertures[i];
        bool suits = shape == APERTURE_SHAPES || one->aperture.shape == shape;
        if (suits && one->aperture.blocks == words->blocks &&
            text_identical(one->label, words->label)) {
            return &one->aperture;
        }
    }
    surface->apertures = arena_grow(codev->job->arena, surface->apertures, surface->aperture_count,
                                    &surface->aperture_room, sizeof *surface->apertures);
    struct sequence_aperture *one = &surface->apertures[surface->aperture_count++];
    shape = shape == APERTURE_SHAPES ? SHAPE_CIRCLE : shape;
    *one = (struct sequence_aperture){.at = codev->commands.words[0],
                                      .label = words->label,
                                      .aperture = aperture_of(shape, words->blocks)};
    return &one->aperture;
}

bool codev_aperture(struct codev *codev)
{
    struct commands *commands = &codev->commands;
    struct figure half;
    const struct aperture_words words = aperture_words(codev);
    const bool is_clear_circle = codev->what == 'C' && !words.blocks;
    if (!commands_value(commands, words.next, commands->scale, "radius of the aperture", &half)) {
        return false;
    }
    if (!(half.value.hi >= 0)) {
        return commands_fail(commands, &commands->words[words.next],
                             "the radius of an aperture is not below 0");
    }
    if (words.is_edge || (half.value.hi == 0 && !is_clear_circle)) {
        return true; /* the rim of the glass, for drawings; none */
    }
    if (is_clear_circle) {
        codev->sequence.surfaces[codev->here.surface].diameter =
            sequence_diameter(&half, codev->job->arena);
        return true;
    }
    enum aperture_shape shape = SHAPE_CIRCLE;
    if (codev->what != 'C') {
        shape = codev->what < 'a' ? SHAPE_ELLIPSE : SHAPE_RECTANGLE;
    }
    find_aperture(codev, &words, shape)->size[(codev->what | 32) == 'y'] =
        sequence_diameter(&half, codev->job->arena);
    return true;
}

bool codev_aperture_shift(struct codev *codev)
{
    struct commands *commands = &codev->commands;
    struct figure shift;
    const struct aperture_words words = aperture_words(codev);
    if (!commands_value(commands, words.next, commands->scale, "decentre of the aperture",
                        &shift)) {
        return false;
    }
    if (shift.value.hi != 0 && !words.is_edge) {
        find_aperture(codev, &words, APERTURE_SHAPES)->decenter[codev->what == 'Y'] = shift;
    }
    return true;
}
