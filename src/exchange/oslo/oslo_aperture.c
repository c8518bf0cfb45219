/* exchange/oslo/oslo_aperture.c - special apertures of OSLO files: what is no circle. */
/* SPDX-License-Identifier: MIT */
#include "exchange/oslo/oslo.h"

#include "base/constants.h"

#include <math.h>
#include <string.h>

/* ATP, AAC */
enum { TYPE_ELLIPSE = 1, TYPE_RECTANGLE, TYPE_TRIANGLE, TYPE_QUADRANGLE };
enum { ACTION_HOLE = 1, ACTION_OBSTRUCT = 2, ACTION_TRANSMIT = 4 };

/* The special aperture of a letter, made if there is none. */
static struct oslo_special *oslo_special_of(struct oslo *oslo, size_t surface, struct text letter)
{
    for (size_t i = 0; i < oslo->special_count; i++) {
        struct oslo_special *one = &oslo->specials[i];
        if (one->surface == surface && text_identical(one->letter, letter)) {
            return one;
        }
    }
    struct oslo_special *one =
        ARENA_ADD(oslo->job->arena, oslo->specials, oslo->special_count, oslo->special_room);
    *one =
        (struct oslo_special){.surface = surface, .letter = letter, .at = oslo->commands.words[0]};
    for (int i = 0; i < OSLO_EDGES; i++) {
        one->edge[i] = figure_zero();
    }
    return one;
}

/* ATP A 2: the letter, and the number. */
bool oslo_special_number(struct oslo *oslo)
{
    struct figure figure;
    if (!commands_value(&oslo->commands, 2, false, "number", &figure)) {
        return false;
    }
    oslo_special_of(oslo, oslo->surface, commands_word(&oslo->commands, 1).text)
        ->number[oslo->what] = figure.value.hi;
    return true;
}

/* AX1 A -2 */
bool oslo_special_edge(struct oslo *oslo)
{
    struct figure figure;
    if (!commands_value(&oslo->commands, 2, true, "edge of an aperture", &figure)) {
        return false;
    }
    oslo_special_of(oslo, oslo->surface, commands_word(&oslo->commands, 1).text)->edge[oslo->what] =
        figure;
    return true;
}

/* APK A surface B: aperture A is as B of another surface. */
bool oslo_special_pickup(struct oslo *oslo)
{
    const struct text letter = commands_word(&oslo->commands, 1).text,
                      other = commands_word(&oslo->commands, 3).text;
    size_t surface;
    if (!oslo_reference(oslo, 2, &surface) || !commands_end(&oslo->commands, 4)) {
        return false;
    }
    const struct oslo_special source = *oslo_special_of(oslo, surface, other);
    struct oslo_special *one = oslo_special_of(oslo, oslo->surface, letter);
    *one = source;
    one->surface = oslo->surface;
    one->letter = letter;
    one->at = oslo->commands.words[0];
    return true;
}

/* Two edges as a size and a centre. */
static void oslo_put_extent(struct oslo *oslo, const struct figure *edges, struct figure *size,
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
    const double turn = one->number[OSLO_TURN];
    bool centred = aperture->decenter[0].value.hi == 0 && aperture->decenter[1].value.hi == 0;
    return turn == 0 ||
           (centred && fmod(turn, 90) == 0 && one->number[OSLO_TYPE] <= TYPE_RECTANGLE);
}

/* The aperture; why a lens cannot hold it, or null. */
static const char *oslo_shape(struct oslo *oslo, const struct oslo_special *one,
                              struct aperture *aperture)
{
    const double type = one->number[OSLO_TYPE], action = one->number[OSLO_ACTION];
    const bool blocks = action == ACTION_OBSTRUCT;
    if (!(blocks || action == ACTION_TRANSMIT)) {
        return action == ACTION_HOLE ? "a special aperture that is a hole"
                                     : "a special aperture that neither obstructs nor transmits";
    }
    if (type == TYPE_ELLIPSE || type == TYPE_RECTANGLE) {
        *aperture = aperture_of(type == TYPE_ELLIPSE ? SHAPE_ELLIPSE : SHAPE_RECTANGLE, blocks);
        oslo_put_extent(oslo, one->edge, &aperture->size[0], &aperture->decenter[0]);
        oslo_put_extent(oslo, one->edge + 2, &aperture->size[1], &aperture->decenter[1]);
        if (fmod(one->number[OSLO_TURN], 180) != 0) { /* by 90 degrees */
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
static bool has_other_group(const struct oslo *oslo, const struct oslo_special *one)
{
    bool several = false;
    for (size_t i = 0; i < oslo->special_count; i++) {
        several = several || (oslo->specials[i].surface == one->surface &&
                              oslo->specials[i].number[OSLO_GROUP] != one->number[OSLO_GROUP]);
    }
    return several;
}

void oslo_put_apertures(struct oslo *oslo)
{
    for (size_t i = 0; i < oslo->special_count; i++) {
        const struct oslo_special *one = &oslo->specials[i];
        struct sequence_surface *surface = &oslo->sequence.surfaces[one->surface];
        struct sequence_aperture to = {.at = one->at, .label = one->letter};
        const char *wrong = has_other_group(oslo, one)
                                ? "one of several groups of special apertures"
                                : oslo_shape(oslo, one, &to.aperture);
        const struct file_words place = commands_place(&oslo->commands, &one->at);
        if (wrong != NULL) {
            foreign_loss(oslo->job, &place, one->at.text, LOSS_OF_VIGNETTING, "left out", "%s",
                         wrong);
            continue;
        }
        *ARENA_ADD(oslo->job->arena, surface->apertures, surface->aperture_count,
                   surface->aperture_room) = to;
    }
}
