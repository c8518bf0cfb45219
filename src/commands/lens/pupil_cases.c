/* commands/lens/pupil_cases.c - from the options of lenscalc pupil to shapes. */
/* SPDX-License-Identifier: MIT */
#include "commands/lens/pupil_cases.h"

#include "base/constants.h"
#include "trace/aim/aim.h"

#include <string.h>

/* What is asked, and who gets the answers. */
struct pupil_cases_asked {
    const struct pupil_input *input;
    struct arena *arena;
    struct pupil_memo *memo; /* null = none */
    const struct pupil_visitor *visitor;
};

/* What one lens at one wavelength needs for all its points. */
struct pupil_job {
    const struct pupil_cases_asked *asked;
    const struct lens_case *one;
    const struct system *clipped, *open;
    double film; /* from the last vertex, mm; NaN for fields */
    struct beam axis_beam;
    struct pupil_shape axis;
};

/* Both systems go the way the light of the points does. */
static bool pupil_cases_open_systems(struct pupil_job *job, unsigned way, struct error *error)
{
    const struct lens_case *one = job->one;
    job->open = setup_system(one->setup, one->index, SETUP_OPEN | way, error);
    job->clipped =
        job->open != NULL ? setup_system(one->setup, one->index, SETUP_CLIPPED | way, error) : NULL;
    return job->clipped != NULL;
}

static bool check_film(double film, struct error *error)
{
    if (isnan(film) || film == 0) {
        fail(error, ERROR_DOMAIN, "the film lies %s",
             film == 0 ? "in the last vertex" : "at infinity");
        return error_hint(error, "say where the film is: {--focus} MM, from the last vertex");
    }
    return true;
}

static bool pupil_cases_shape_of(const struct pupil_job *job, const struct beam *beam,
                                 struct arena *arena, struct pupil_shape *shape,
                                 struct error *error)
{
    const struct pupil_question question = {.clipped = job->clipped,
                                            .open = job->open,
                                            .beam = beam,
                                            .first = &job->one->light.first,
                                            .directions = job->asked->visitor->edges};
    return pupil_shape(&question, arena, shape, error);
}

static struct beam film_beam(const struct pupil_job *job, double x, double y)
{
    return beam_to_pupil((double[3]){x, y, job->film}, job->one->light.first.exit_pupil,
                         job->open->index_first);
}

static bool pupil_cases_show(const struct pupil_job *job, const struct beam *beam,
                             struct pupil_case *point, struct error *error)
{
    const struct pupil_visitor *visitor = job->asked->visitor;
    /* the point on the axis itself: compared byte by byte, as a beam has no gaps */
    const bool is_axis = memcmp(beam, &job->axis_beam, sizeof *beam) == 0;
    struct pupil_shape shape = job->axis;
    if (!(is_axis && shape.count == visitor->edges) &&
        !pupil_cases_shape_of(job, beam, job->asked->arena, &shape, error)) {
        return false;
    }
    point->shape = &shape;
    point->axis = &job->axis;
    point->one = job->one;
    return visitor->visit(point, visitor->context, error);
}

static bool show_field(const struct pupil_job *job, const struct field_point *field,
                       struct error *error)
{
    const struct setup *setup = job->one->setup;
    struct beam beam;
    if (!setup_beam(setup, field, &beam, error)) {
        return false;
    }
    struct pupil_case point = {
        .height = NAN, .height_x = NAN, .film = NAN, .object = NAN, .object_x = NAN};
    /* as it was asked for, to the last digit */
    const bool angle = field->kind == FIELD_ANGLE;
    point.angle = angle ? field->value[1] : atan2(beam.axis[1], beam.axis[2]);
    point.angle_x = angle ? field->value[0] : atan2(beam.axis[0], beam.axis[2]);
    if (!setup->object.is_infinite) {
        point.object = -beam.axis[1] * beam.distance + 0.0;
        point.object_x = -beam.axis[0] * beam.distance + 0.0;
    }
    return pupil_cases_show(job, &beam, &point, error);
}

static bool show_fields(const struct pupil_job *job, struct error *error)
{
    const struct setup *setup = job->one->setup;
    for (size_t i = 0; i < setup->field_count; i++) {
        if (!show_field(job, &setup->fields[i].point, error)) {
            return false;
        }
    }
    return true;
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

static struct axis_key pupil_cases_key_of(const struct pupil_job *job)
{
    struct axis_key key;
    memset(&key, 0, sizeof key);
    key.lens = job->asked->input->question.lens.serial;
    key.position = job->one->setup->position;
    key.wavelength = job->one->light.wavelength;
    key.fnumber = job->asked->input->question.fnumber;
    key.film = job->film;
    return key;
}

struct pupil_memo *pupil_memo_new(struct arena *arena)
{
    return ARENA_NEW(arena, struct pupil_memo);
}

static bool pupil_cases_find_axis(struct pupil_job *job, const struct beam *beam,
                                  struct error *error)
{
    struct pupil_memo *memo = job->asked->memo;
    const struct axis_key key = pupil_cases_key_of(job);
    for (size_t i = 0; memo != NULL && i < memo->count; i++) {
        if (memcmp(&memo->keys[i], &key, sizeof key) == 0) {
            job->axis = memo->shapes[i];
            return true;
        }
    }
    if (!pupil_cases_shape_of(job, beam, job->asked->arena, &job->axis, error)) {
        return false;
    }
    if (memo != NULL) {
        size_t at = memo->count < AXES ? memo->count++ : 0;
        struct pupil_shape *kept = &memo->shapes[at];
        memo->keys[at] = key;
        *kept = job->axis;
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

static bool visit_lens(const struct lens_case *one, void *context, struct error *error)
{
    const struct pupil_cases_asked *asked = context;
    const struct setup *setup = one->setup;
    struct pupil_job job = {.asked = asked, .one = one, .film = NAN};
    bool from_film = pupil_is_from_film(asked->input);
    const struct field_point centre = {FIELD_NONE, {0, 0}};
    struct beam beam;
    if (!pupil_cases_open_systems(&job, from_film ? SETUP_REVERSED : 0, error) ||
        (from_film && !check_film(setup->image, error))) {
        return false;
    }
    if (from_film) {
        job.film = setup->image;
        beam = film_beam(&job, 0, 0);
    } else if (!beam_of_field(&centre, &setup->object, &setup->first, &beam, error)) {
        return false;
    }
    job.axis_beam = beam;
    if (!pupil_cases_find_axis(&job, &beam, error)) {
        return false;
    }
    if (!from_film) {
        return show_fields(&job, error);
    }
    struct pupil_case point = {.from_film = true,
                               .angle = NAN,
                               .object = NAN,
                               .angle_x = NAN,
                               .object_x = NAN,
                               .height = or_zero(asked->input->height),
                               .height_x = or_zero(asked->input->height_x),
                               .film = job.film};
    beam = film_beam(&job, point.height_x, point.height);
    return pupil_cases_show(&job, &beam, &point, error);
}

bool pupil_each(const struct pupil_input *input, struct arena *arena, struct pupil_memo *memo,
                const struct pupil_visitor *visitor, struct error *error)
{
    struct pupil_cases_asked asked = {input, arena, memo, visitor};
    const struct lens_policy policy = {.wavelengths = WAVELENGTHS_PRIMARY,
                                       .fields = FIELDS_ALL,
                                       .focus = pupil_is_from_film(input) ? &input->focus : NULL};
    if (pupil_is_from_film(input) &&
        (!isnan(input->question.field) || !isnan(input->question.field_x))) {
        return fail(
            error, ERROR_USAGE,
            "{--field} is a point in front of the lens and {--height} one in the film: give "
            "one of them");
    }
    return lens_each(&input->question, &policy, arena, visit_lens, &asked, error);
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
