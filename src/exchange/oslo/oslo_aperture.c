/* exchange/oslo/oslo_aperture.c - special apertures of OSLO files: what is no circle. */
/* SPDX-License-Identifier: MIT */
#include "exchange/oslo/oslo_reading.h"

#include "base/constants.h"

#include <math.h>
#include <string.h>

static const struct number_scale plain = {1, 0};

/* ATP, AAC */
enum { TYPE_ELLIPSE = 1, TYPE_RECTANGLE, TYPE_TRIANGLE, TYPE_QUADRANGLE };
enum { ACTION_HOLE = 1, ACTION_OBSTRUCT = 2, ACTION_TRANSMIT = 4 };
enum { TYPE, ACTION, GROUP, TURN }; /* oslo_special.number */

static bool is_same_letter(struct text a, struct text b)
{
    return a.length == b.length && memcmp(a.start, b.start, a.length) == 0;
}

/* The special aperture of a letter, made if there is none. */
static struct oslo_special *oslo_aperture_find(struct oslo *oslo, size_t surface,
                                               struct text letter)
{
    for (size_t i = 0; i < oslo->special_count; i++) {
        struct oslo_special *one = &oslo->specials[i];
        if (one->surface == surface && is_same_letter(one->letter, letter)) {
            return one;
        }
    }
    oslo->specials = arena_grow(oslo->job->arena, oslo->specials, oslo->special_count,
                                &oslo->special_room, sizeof oslo->specials[0]);
    struct oslo_special *one = &oslo->specials[oslo->special_count++];
    *one =
        (struct oslo_special){.surface = surface, .letter = letter, .at = oslo->commands.words[0]};
    for (int i = 0; i < OSLO_EDGES; i++) {
        one->edge[i] = figure_zero();
    }
    return one;
}

/* AX1 A -2: the letter, and the number. */
static bool read_special(struct oslo *oslo, struct number_scale scale, const char *what,
                         struct oslo_special **one, struct figure *figure, struct error *error)
{
    if (!commands_figure(&oslo->commands, 2, scale, what, figure, error) ||
        !commands_end(&oslo->commands, 3, error)) {
        return false;
    }
    *one = oslo_aperture_find(oslo, oslo->surface, commands_word(&oslo->commands, 1).text);
    return true;
}

static bool oslo_aperture_read_number(struct oslo *oslo, int what, struct error *error)
{
    struct oslo_special *one;
    struct figure figure;
    if (!read_special(oslo, plain, "number", &one, &figure, error)) {
        return false;
    }
    one->number[what] = figure.value.hi;
    return true;
}

static bool read_edge(struct oslo *oslo, int what, struct error *error)
{
    struct oslo_special *one;
    return read_special(oslo, oslo->commands.scale, "edge of an aperture", &one,
                        &(struct figure){.variable = LENS_NONE}, error) &&
           commands_figure(&oslo->commands, 2, oslo->commands.scale, "edge of an aperture",
                           &one->edge[what], error);
}

/* APK A surface B: aperture A is as B of another surface. */
static bool read_pickup(struct oslo *oslo, int what, struct error *error)
{
    const struct text letter = commands_word(&oslo->commands, 1).text,
                      other = commands_word(&oslo->commands, 3).text;
    size_t surface;
    (void)what;
    if (!oslo_reference(oslo, 2, &surface, error) || !commands_end(&oslo->commands, 4, error)) {
        return false;
    }
    const struct oslo_special source = *oslo_aperture_find(oslo, surface, other);
    struct oslo_special *one = oslo_aperture_find(oslo, oslo->surface, letter);
    *one = source;
    one->surface = oslo->surface;
    one->letter = letter;
    one->at = oslo->commands.words[0];
    return true;
}

static bool oslo_aperture_read_count(struct oslo *oslo, int what, struct error *error)
{
    (void)oslo, (void)what, (void)error;
    return true;
}

static const struct {
    const char *name;
    bool (*run)(struct oslo *oslo, int what, struct error *error);
    int what;
} keywords[] = {{"APN", oslo_aperture_read_count, 0},
                {"ATP", oslo_aperture_read_number, TYPE},
                {"AAC", oslo_aperture_read_number, ACTION},
                {"AGN", oslo_aperture_read_number, GROUP},
                {"AAN", oslo_aperture_read_number, TURN},
                {"AX1", read_edge, 0},
                {"AX2", read_edge, 1},
                {"AY1", read_edge, 2},
                {"AY2", read_edge, 3},
                {"AVX1", read_edge, OSLO_CORNERS},
                {"AVY1", read_edge, OSLO_CORNERS + 1},
                {"AVX2", read_edge, OSLO_CORNERS + 2},
                {"AVY2", read_edge, OSLO_CORNERS + 3},
                {"AVX3", read_edge, OSLO_CORNERS + 4},
                {"AVY3", read_edge, OSLO_CORNERS + 5},
                {"AVX4", read_edge, OSLO_CORNERS + 6},
                {"AVY4", read_edge, OSLO_CORNERS + 7},
                {"APK", read_pickup, 0}};

bool oslo_special(struct oslo *oslo, bool *known, struct error *error)
{
    const struct text word = oslo->commands.words[0].text;
    for (size_t i = 0; i < sizeof keywords / sizeof keywords[0]; i++) {
        if (text_same(word, keywords[i].name)) {
            *known = true;
            return keywords[i].run(oslo, keywords[i].what, error);
        }
    }
    *known = false;
    return true;
}

/* Two edges as a size and a centre. */
static void put_extent(struct oslo *oslo, const struct figure *edges, struct figure *size,
                       struct figure *centre)
{
    const struct pair sum = pair_add(edges[0].value, edges[1].value);
    *size = figure_computed(pair_subtract(edges[1].value, edges[0].value), oslo->commands.scale,
                            oslo->job->arena);
    if (sum.hi != 0) {
        *centre = figure_computed((struct pair){sum.hi / 2, sum.lo / 2}, oslo->commands.scale,
                                  oslo->job->arena);
    }
}

/* A shape between edges may be turned where it is known about what, and which way it turns. */
static bool is_turned_soundly(const struct oslo_special *one, const struct aperture *aperture)
{
    const double turn = one->number[TURN];
    bool centred = aperture->decenter[0].value.hi == 0 && aperture->decenter[1].value.hi == 0;
    return turn == 0 || (centred && fmod(turn, 90) == 0 && one->number[TYPE] <= TYPE_RECTANGLE);
}

/* The aperture; why a lens cannot hold it, or null. */
static const char *oslo_aperture_shape_of(struct oslo *oslo, const struct oslo_special *one,
                                          struct aperture *aperture)
{
    const double type = one->number[TYPE], action = one->number[ACTION];
    const bool blocks = action == ACTION_OBSTRUCT;
    if (!(blocks || action == ACTION_TRANSMIT)) {
        return action == ACTION_HOLE ? "a special aperture that is a hole"
                                     : "a special aperture that neither obstructs nor transmits";
    }
    if (type == TYPE_ELLIPSE || type == TYPE_RECTANGLE) {
        *aperture = aperture_of(type == TYPE_ELLIPSE ? SHAPE_ELLIPSE : SHAPE_RECTANGLE, blocks);
        put_extent(oslo, one->edge, &aperture->size[0], &aperture->decenter[0]);
        put_extent(oslo, one->edge + 2, &aperture->size[1], &aperture->decenter[1]);
        if (fmod(one->number[TURN], 180) != 0) { /* by 90 degrees */
            const struct figure width = aperture->size[0];
            aperture->size[0] = aperture->size[1];
            aperture->size[1] = width;
        }
    } else if (type == TYPE_TRIANGLE || type == TYPE_QUADRANGLE) {
        size_t count = type == TYPE_TRIANGLE ? 3 : 4;
        struct figure(*points)[2] = arena_array(oslo->job->arena, count, sizeof *points);
        for (size_t i = 0; i < count; i++) {
            points[i][0] = one->edge[OSLO_CORNERS + 2 * i];
            points[i][1] = one->edge[OSLO_CORNERS + 2 * i + 1];
        }
        *aperture = aperture_of(SHAPE_POLYGON, blocks);
        aperture->points = (const struct figure(*)[2])points;
        aperture->point_count = count;
    } else {
        return "a special aperture of an unknown shape";
    }
    return is_turned_soundly(one, aperture) ? NULL : "a special aperture that is turned";
}

/* Light passes a surface through any group of its apertures; a lens has one. */
static bool is_of_several(const struct oslo *oslo, const struct oslo_special *one)
{
    bool several = false;
    for (size_t i = 0; i < oslo->special_count; i++) {
        several = several || (oslo->specials[i].surface == one->surface &&
                              oslo->specials[i].number[GROUP] != one->number[GROUP]);
    }
    return several;
}

void oslo_put_apertures(struct oslo *oslo)
{
    for (size_t i = 0; i < oslo->special_count; i++) {
        const struct oslo_special *one = &oslo->specials[i];
        struct sequence_surface *surface = &oslo->sequence.surfaces[one->surface];
        struct sequence_aperture to = {.at = one->at, .label = one->letter};
        const char *wrong = is_of_several(oslo, one)
                                ? "one of several groups of special apertures"
                                : oslo_aperture_shape_of(oslo, one, &to.aperture);
        const struct file_words place = commands_place(&oslo->commands, &one->at);
        if (wrong != NULL) {
            foreign_loss(oslo->job, &place, one->at.text, LOSS_OF_VIGNETTING, "left out", "%s",
                         wrong);
            continue;
        }
        surface->apertures =
            arena_grow(oslo->job->arena, surface->apertures, surface->aperture_count,
                       &surface->aperture_room, sizeof *surface->apertures);
        surface->apertures[surface->aperture_count++] = to;
    }
}
