/* analysis/setup/setup_fields.c - the fields at which a lens is looked at. */
/* SPDX-License-Identifier: MIT */
#include "analysis/setup/setup.h"

#include "base/constants.h"

#include <math.h>

static const double FIVE_DEGREES = 5 * RADIANS_PER_DEGREE;
static const double HALF_DIAGONAL = 21.633; /* of 35 mm film, mm */
static const double STEEPEST = 1.732;       /* tan 60 deg: lenses beyond it distort */

static struct setup_field setup_field_at(const struct setup *setup, enum field_kind kind,
                                         double value)
{
    struct setup_field field = {.point = {.kind = kind}, .weight = 1};
    field.point.value[setup_axis(setup)] = value;
    return field;
}

/* Fields that all lie on y are those of the section asked for; others are where they are. */
static struct setup_field field_of_lens(const struct setup *setup, size_t i)
{
    const struct lens_field *from = &setup->lens->fields[i];
    struct setup_field field = setup_field_at(setup, setup->lens->field_kind, from->at[1].value.hi);
    if (lens_has_fields_beside(setup->lens)) {
        field.point.value[0] = from->at[0].value.hi;
        field.point.value[1] = from->at[1].value.hi;
    }
    field.weight = from->weight;
    return field;
}

/* The first of those that are farthest from the axis; FIELD_NONE if there are none. */
static struct field_point setup_fields_farthest(const struct setup_field *fields, size_t count)
{
    struct field_point edge = {.kind = FIELD_NONE};
    double largest = NAN;
    for (size_t i = 0; i < count; i++) {
        double distance = field_extent(fields[i].point.kind, fields[i].point.value);
        if (!(distance <= largest)) {
            largest = distance;
            edge = fields[i].point;
        }
    }
    return edge;
}

/* As the angle of a distant object point, or as the height of a near one; from the first vertex. */
static bool in_object(const struct setup *setup, const struct field_point *point, double *to,
                      struct error *error)
{
    const struct first_order *first = &setup->first;
    bool far = setup->object.is_infinite;
    struct field_point seen = *point;
    if (!setup_real_in_object(setup, &seen, error)) {
        return false;
    }
    double value = seen.value[setup_axis(setup)];
    if (seen.kind == FIELD_IMAGE) {
        value =
            far ? atan(value * first->power / first->index_object) : value / first->magnification;
    } else if (seen.kind == FIELD_ANGLE && !far) {
        value = -tan(value) * setup->object.distance.hi;
    }
    *to = value;
    return true;
}

static enum field_kind kind_in_object(const struct setup *setup)
{
    return setup->object.is_infinite ? FIELD_ANGLE : FIELD_HEIGHT;
}

struct field_point setup_edge_in_object(const struct setup *setup)
{
    struct field_point edge = setup_in_section(setup, &setup->edge);
    struct error none;
    edge.kind = edge.kind == FIELD_REAL ? FIELD_IMAGE : edge.kind;
    if (edge.kind == FIELD_IMAGE &&
        in_object(setup, &edge, &edge.value[setup_axis(setup)], &none)) {
        edge.kind = kind_in_object(setup);
    }
    return edge;
}

static bool check_height(const struct setup *setup, enum field_kind kind, struct error *error)
{
    return kind != FIELD_HEIGHT || !setup->object.is_infinite ||
           fail(error, ERROR_DOMAIN, "an object at infinity has no height");
}

static bool take_in_object(const struct setup_question *question, struct setup *setup,
                           struct error *error)
{
    size_t count = question->field_count;
    struct setup_field *fields = ARENA_ARRAY(setup->arena, count, struct setup_field);
    for (size_t i = 0; i < count; i++) {
        const struct setup_field *asked = &question->fields[i];
        double value;
        if (!check_height(setup, asked->point.kind, error) ||
            !in_object(setup, &asked->point, &value, error)) {
            return false;
        }
        fields[i] = setup_field_at(setup, kind_in_object(setup), value);
        fields[i].weight = asked->weight;
    }
    setup->fields = fields;
    setup->field_count = count;
    return true;
}

/* With two or three fields a thick lens may agree by chance: nine, from the axis to the edge. */
static bool setup_fields_spread(struct setup *setup, struct error *error)
{
    enum { COUNT = 9 };
    const struct lens *lens = setup->lens;
    bool far = setup->object.is_infinite;
    double largest = 0, tangent = HALF_DIAGONAL / fabs(setup->first.efl);
    if (lens->field_count == 0 && (!far || !(tangent < STEEPEST))) {
        return fail(error, ERROR_DOMAIN, "the lens states no fields: they must be given");
    }
    if (lens->field_count > 0 && !check_height(setup, lens->field_kind, error)) {
        return false;
    }
    for (size_t i = 0; i < lens->field_count; i++) {
        const struct setup_field field = field_of_lens(setup, i);
        double here;
        if (!in_object(setup, &field.point, &here, error)) {
            return false;
        }
        largest = fabs(here) > fabs(largest) ? here : largest;
    }
    if (lens->field_count == 0) {
        largest = atan(tangent);
    }
    struct setup_field *fields = ARENA_ARRAY(setup->arena, COUNT, struct setup_field);
    for (size_t i = 0; i < COUNT; i++) {
        fields[i] = setup_field_at(setup, kind_in_object(setup), largest * (double)i / (COUNT - 1));
    }
    setup->fields = fields;
    setup->field_count = COUNT;
    setup->fields_from = lens->field_count > 0
                             ? "from 0 by eighths to the largest of the lens"
                             : "to the half diagonal of 35 mm film, as the lens states none";
    return true;
}

bool setup_choose_fields(const struct setup_question *question, struct setup *setup,
                         struct error *error)
{
    bool asked = question->field_count > 0;
    enum field_policy policy = question->field_policy;
    if (policy == FIELDS_SPREAD) {
        if (!(asked ? take_in_object(question, setup, error) : setup_fields_spread(setup, error))) {
            return false;
        }
    } else if (asked) {
        setup->fields = question->fields;
        setup->field_count = question->field_count;
    } else {
        /* all fields of the lens; of a lens without any the axis */
        const size_t count = setup->lens->field_count;
        struct setup_field *fields = ARENA_ARRAY(setup->arena, count + 1, struct setup_field);
        fields[0] = setup_field_at(setup, FIELD_NONE, 0);
        for (size_t i = 0; i < count; i++) {
            fields[i] = field_of_lens(setup, i);
        }
        setup->fields = fields;
        setup->field_count = count > 0 ? count : 1;
    }
    if (policy == FIELDS_LARGEST || policy == FIELDS_EDGE) {
        /* The largest of those asked for, else of the lens. */
        struct setup_field *one = ARENA_NEW(setup->arena, struct setup_field);
        bool five = question->field_policy == FIELDS_EDGE;
        one->point = setup_fields_farthest(setup->fields, setup->field_count);
        one->weight = 1;
        if (five && one->point.value[0] == 0 && one->point.value[1] == 0) {
            *one = setup_field_at(setup, FIELD_ANGLE, FIVE_DEGREES);
            setup->fields_from = "the lens states none";
        }
        setup->fields = one;
        setup->field_count = one->point.kind != FIELD_NONE;
    }
    setup->edge = setup_fields_farthest(setup->fields, setup->field_count);
    return true;
}
