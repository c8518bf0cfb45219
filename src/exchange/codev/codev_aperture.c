/* exchange/codev/codev_aperture.c - CIR, REX, REY, ELX, ELY and what shifts or turns them. */
/* SPDX-License-Identifier: MIT */
#include "exchange/codev/codev.h"

#include <string.h>

/* What an aperture is, by the words before its size. */
enum aperture_word {
    APERTURE_SIZE,
    APERTURE_CLEAR,
    APERTURE_EDGE,
    APERTURE_BLOCKS,
    APERTURE_LABEL
};

struct aperture_words {
    bool is_edge, blocks;
    struct text label;
    size_t next; /* the word with the size */
};

static enum aperture_word aperture_word(struct text word)
{
    static const struct {
        const char *word;
        enum aperture_word kind;
    } words[] = {{"CLR", APERTURE_CLEAR},
                 {"EDG", APERTURE_EDGE},
                 {"OBS", APERTURE_BLOCKS},
                 {"HOL", APERTURE_BLOCKS}};
    for (size_t i = 0; i < sizeof words / sizeof words[0]; i++) {
        if (text_same(word, words[i].word)) {
            return words[i].kind;
        }
    }
    bool is_label = word.length > 1 && (word.start[0] | 32) == 'l' &&
                    (word.start[1] == '\'' || word.start[1] == '"');
    return is_label ? APERTURE_LABEL : APERTURE_SIZE;
}

/* CLR, EDG, OBS, HOL and a label, from word `first` on. */
static struct aperture_words codev_aperture_read_words(const struct commands *commands,
                                                       size_t first)
{
    struct aperture_words words = {.label = {NULL, 0}, .next = first};
    for (; words.next < commands->count; words.next++) {
        const struct text word = commands->words[words.next].text;
        enum aperture_word kind = aperture_word(word);
        if (kind == APERTURE_SIZE) {
            break;
        }
        words.is_edge = words.is_edge || kind == APERTURE_EDGE;
        words.blocks = words.blocks || kind == APERTURE_BLOCKS;
        words.label = kind == APERTURE_LABEL ? word : words.label;
    }
    return words;
}

static bool is_same_label(struct text a, struct text b)
{
    return a.length == b.length && (a.length == 0 || memcmp(a.start, b.start, a.length) == 0);
}

/*
 * The aperture of these words, made if there is none.
 *
 * Given     shape  APERTURE_SHAPES: any, the last one
 */
static struct sequence_aperture *find_aperture(struct codev *codev,
                                               struct sequence_surface *surface,
                                               const struct aperture_words *words,
                                               enum aperture_shape shape)
{
    for (size_t i = surface->aperture_count; i-- > 0;) {
        struct sequence_aperture *one = &surface->apertures[i];
        bool suits = shape == APERTURE_SHAPES || one->aperture.shape == shape;
        if (suits && one->aperture.blocks == words->blocks &&
            is_same_label(one->label, words->label)) {
            return one;
        }
    }
    surface->apertures = arena_grow(codev->job->arena, surface->apertures, surface->aperture_count,
                                    &surface->aperture_room, sizeof *surface->apertures);
    struct sequence_aperture *one = &surface->apertures[surface->aperture_count++];
    shape = shape == APERTURE_SHAPES ? SHAPE_CIRCLE : shape;
    *one = (struct sequence_aperture){.at = codev->commands.words[0],
                                      .label = words->label,
                                      .aperture = aperture_of(shape, words->blocks)};
    return one;
}

/* Half a size along x or y of what is no clear circle. */
static void put_half(struct codev *codev, const struct aperture_words *words, int what,
                     const struct figure *half)
{
    enum aperture_shape shape = SHAPE_CIRCLE;
    if (what != 'C') {
        shape = what == 'X' || what == 'Y' ? SHAPE_ELLIPSE : SHAPE_RECTANGLE;
    }
    struct sequence_surface *surface = &codev->sequence.surfaces[codev->here.surface];
    struct sequence_aperture *one = find_aperture(codev, surface, words, shape);
    one->aperture.size[what == 'Y' || what == 'y'] = sequence_diameter(half, codev->job->arena);
}

bool codev_aperture(struct codev *codev, int what, struct error *error)
{
    struct commands *commands = &codev->commands;
    struct figure half;
    const struct aperture_words words = codev_aperture_read_words(commands, codev->here.next);
    const bool is_clear_circle = what == 'C' && !words.blocks;
    if (!commands_figure(commands, words.next, commands->scale, "radius of the aperture", &half,
                         error) ||
        !commands_end(commands, words.next + 1, error)) {
        return false;
    }
    if (!(half.value.hi >= 0)) {
        return commands_fail(commands, &commands->words[words.next], error,
                             "the radius of an aperture is not below 0");
    }
    if (words.is_edge || (half.value.hi == 0 && !is_clear_circle)) {
        return true; /* the rim of the glass, for drawings; none */
    }
    if (is_clear_circle) {
        codev->sequence.surfaces[codev->here.surface].diameter =
            sequence_diameter(&half, codev->job->arena);
    } else {
        put_half(codev, &words, what, &half);
    }
    return true;
}

bool codev_aperture_shift(struct codev *codev, int what, struct error *error)
{
    struct commands *commands = &codev->commands;
    struct figure shift;
    const struct aperture_words words = codev_aperture_read_words(commands, codev->here.next);
    if (!commands_figure(commands, words.next, commands->scale, "decentre of the aperture", &shift,
                         error) ||
        !commands_end(commands, words.next + 1, error)) {
        return false;
    }
    if (shift.value.hi == 0 || words.is_edge) {
        return true;
    }
    struct sequence_surface *surface = &codev->sequence.surfaces[codev->here.surface];
    find_aperture(codev, surface, &words, APERTURE_SHAPES)->aperture.decenter[what == 'Y'] = shift;
    return true;
}
