/* commands/lens/pupil_cases.c - from the options of lenscalc pupil to shapes. */
/* SPDX-License-Identifier: MIT */
#include "commands/lens/pupil_cases.h"

#include "base/constants.h"
#include "trace/aim/aim.h"

#include <string.h>

static bool check_film(double film, struct error *error)
{
    if (isnan(film) || film == 0) {
        fail(error, ERROR_DOMAIN, "the film lies %s",
             film == 0 ? "in the last vertex" : "at infinity");
        return error_hint(error, "say where the film is: {--focus} MM, from the last vertex");
    }
    return true;
}

static bool pupil_cases_shape_of(const struct pupil_cursor *at, const struct beam *beam,
                                 struct pupil_shape *shape, struct error *error)
{
    const struct pupil_question question = {.clipped = at->clipped,
                                            .open = at->open,
                                            .beam = beam,
                                            .first = &at->lens.one.light.first,
                                            .directions = at->edges};
    return pupil_shape(&question, at->lens.arena, shape, error);
}

static struct beam film_beam(const struct pupil_cursor *at, double x, double y)
{
    return beam_to_pupil((double[3]){x, y, at->film}, at->lens.one.light.first.exit_pupil,
                         at->open->index_first);
}

/* The shape of the present point, which is filled but for it. */
static bool pupil_cases_show(struct pupil_cursor *at, const struct beam *beam, struct error *error)
{
    /* the point on the axis itself: compared byte by byte, as a beam has no gaps */
    const bool is_axis = memcmp(beam, &at->axis_beam, sizeof *beam) == 0;
    at->shape = at->axis;
    at->point.shape = &at->shape;
    at->point.axis = &at->axis;
    at->point.one = &at->lens.one;
    return (is_axis && at->shape.count == at->edges) ||
           pupil_cases_shape_of(at, beam, &at->shape, error);
}

/* -------- the point on the axis, once for all points of a sweep -------- */

/* What the shape on the axis depends on. Compared byte by byte: filled with zeros first. */
struct axis_key {
    size_t lens; /* its serial number: another one may come to lie in the same place */
    const char *position;
    double wavelength, fnumber, film;
};

enum { AXES = 64 };

struct pupil_memo {
    size_t count;
    struct axis_key keys[AXES];
    struct pupil_shape shapes[AXES]; /* their numbers only: outlines end with their row */
};

static struct axis_key pupil_cases_key_of(const struct pupil_cursor *at)
{
    struct axis_key key;
    memset(&key, 0, sizeof key); /* gaps too */
    key.lens = at->input->question.lens.serial;
    key.position = at->lens.one.setup->position;
    key.wavelength = at->lens.one.light.wavelength;
    key.fnumber = at->input->question.fnumber;
    key.film = at->film;
    return key;
}

struct pupil_memo *pupil_memo_new(struct arena *arena)
{
    return ARENA_NEW(arena, struct pupil_memo);
}

static bool pupil_cases_find_axis(struct pupil_cursor *at, const struct beam *beam,
                                  struct error *error)
{
    struct pupil_memo *memo = at->memo;
    const struct axis_key key = pupil_cases_key_of(at);
    for (size_t i = 0; memo != NULL && i < memo->count; i++) {
        if (memcmp(&memo->keys[i], &key, sizeof key) == 0) {
            at->axis = memo->shapes[i];
            return true;
        }
    }
    if (!pupil_cases_shape_of(at, beam, &at->axis, error)) {
        return false;
    }
    if (memo != NULL) {
        size_t place = memo->count < AXES ? memo->count++ : 0;
        struct pupil_shape *kept = &memo->shapes[place];
        memo->keys[place] = key;
        *kept = at->axis;
        kept->count = 0;
        kept->stop = kept->across = NULL;
        kept->entrance.pupil.outline = kept->entrance.vertex.outline = NULL;
        kept->exit.pupil.outline = kept->exit.vertex.outline = NULL;
    }
    return true;
}

static double or_zero(double given)
{
    return isnan(given) ? 0 : given;
}

/* The present lens at its wavelength: its systems, and the point on the axis. */
static bool pupil_cases_open(struct pupil_cursor *at, struct error *error)
{
    const struct setup *setup = at->lens.one.setup;
    const bool from_film = pupil_is_from_film(at->input);
    const struct field_point centre = {FIELD_NONE, {0, 0}};
    at->film = from_film ? setup->image : (double)NAN;
    at->next = 0;
    at->count = from_film ? 1 : setup->field_count;
    /* Both systems go the way the light of the points does. */
    unsigned way = from_film ? SETUP_REVERSED : 0;
    const struct lens_case *one = &at->lens.one;
    at->open = setup_system(one->setup, one->index, SETUP_OPEN | way, error);
    at->clipped =
        at->open != NULL ? setup_system(one->setup, one->index, SETUP_CLIPPED | way, error) : NULL;
    if (at->clipped == NULL || (from_film && !check_film(setup->image, error))) {
        return false;
    }
    if (from_film) {
        at->axis_beam = film_beam(at, 0, 0);
    } else if (!beam_of_field(&centre, &setup->object, &setup->first, &at->axis_beam, error)) {
        return false;
    }
    const struct beam beam = at->axis_beam;
    return pupil_cases_find_axis(at, &beam, error);
}

void pupil_begin(struct pupil_cursor *at, const struct pupil_input *input, struct pupil_memo *memo,
                 size_t edges, struct arena *arena)
{
    *at = (struct pupil_cursor){
        .input = input,
        .memo = memo,
        .edges = edges,
        .policy = {.wavelengths = WAVELENGTHS_PRIMARY,
                   .fields = FIELDS_ALL,
                   .focus = pupil_is_from_film(input) ? &input->focus : NULL}};
    at->lens = lens_begin(&input->question, &at->policy, arena);
}

bool pupil_next(struct pupil_cursor *at, struct error *error)
{
    const struct pupil_input *input = at->input;
    const bool from_film = pupil_is_from_film(input);
    if (from_film && (!isnan(input->question.field) || !isnan(input->question.field_x))) {
        return fail(
            error, ERROR_USAGE,
            "{--field} is a point in front of the lens and {--height} one in the film: give "
            "one of them");
    }
    error->code = ERROR_NONE;
    while (at->next == at->count) {
        if (!lens_next(&at->lens, error) || !pupil_cases_open(at, error)) {
            return false;
        }
    }
    if (!from_film) {
        const struct field_point *field = &at->lens.one.setup->fields[at->next++].point;
        const struct setup *setup = at->lens.one.setup;
        struct beam lit;
        if (!setup_beam(setup, field, &lit, error)) {
            return false;
        }
        at->point = (struct pupil_case){
            .height = NAN, .height_x = NAN, .film = NAN, .object = NAN, .object_x = NAN};
        /* as it was asked for, to the last digit */
        const bool angle = field->kind == FIELD_ANGLE;
        at->point.angle = angle ? field->value[1] : atan2(lit.axis[1], lit.axis[2]);
        at->point.angle_x = angle ? field->value[0] : atan2(lit.axis[0], lit.axis[2]);
        if (!setup->object.is_infinite) {
            at->point.object = -lit.axis[1] * lit.distance + 0.0;
            at->point.object_x = -lit.axis[0] * lit.distance + 0.0;
        }
        return pupil_cases_show(at, &lit, error);
    }
    at->next++;
    at->point = (struct pupil_case){.from_film = true,
                                    .angle = NAN,
                                    .object = NAN,
                                    .angle_x = NAN,
                                    .object_x = NAN,
                                    .height = or_zero(input->height),
                                    .height_x = or_zero(input->height_x),
                                    .film = at->film};
    const struct beam beam = film_beam(at, at->point.height_x, at->point.height);
    return pupil_cases_show(at, &beam, error);
}

const char *pupil_point_words(const struct pupil_case *point, struct arena *arena)
{
    const struct {
        bool is;
        const char *what, *unit;
        double x, y;
    } kinds[] = {
        {point->from_film, "film ", "mm", point->height_x, point->height},
        {!isnan(point->object), "object ", "mm", point->object_x, point->object},
        {true, "", "deg", point->angle_x * DEGREES_PER_RADIAN, point->angle * DEGREES_PER_RADIAN}};
    size_t i = 0;
    while (!kinds[i].is) {
        i++;
    }
    return kinds[i].x == 0
               ? arena_printf(arena, "%s%.4g %s", kinds[i].what, kinds[i].y, kinds[i].unit)
               : arena_printf(arena, "%s%.4g, %.4g %s", kinds[i].what, kinds[i].x, kinds[i].y,
                              kinds[i].unit);
}
