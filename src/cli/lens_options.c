/* cli/lens_options.c - the cases a lens command is asked for. */
/* SPDX-License-Identifier: MIT */
#include "commands/lens/lens_options.h"

#include "optics/wavelength.h"

#include <string.h>

const struct word section_words[] = {
    {"y", "the y-z section"},
    {"x", "the x-z section"},
    {NULL, NULL},
};

static bool wants_all(const char *names)
{
    return names != NULL && text_same(text_of(names), "all");
}

bool lens_positions_several(const struct lens *lens, const char *names)
{
    return lens != NULL && names != NULL && lens->position_count > 1 &&
           (wants_all(names) || strchr(names, ',') != NULL);
}

bool lens_makes_many(const struct lens_question *question)
{
    const struct lens *lens = question->lens.lens;
    return lens != NULL && ((question->wavelength.name == NULL && lens->wavelength_count > 1) ||
                            lens_positions_several(lens, question->position));
}

double lens_wavelength_own(double wavelength)
{
    char text[NUMBER_LENGTH];
    const char *end = number_write_shortest(text, wavelength);
    double own; /* by way of the digits: um to mm */
    number_read(text, end, (struct number_scale){1, -3}, &own);
    return own;
}

/* The field that counts: the one asked for, else the largest of the lens. */
static double choose_field(const struct lens_question *question, const struct lens *lens,
                           enum field_kind *kind)
{
    double largest = NAN;
    *kind = FIELD_ANGLE;
    if (!isnan(question->field)) {
        return question->field;
    }
    *kind = lens->field_kind;
    for (size_t i = 0; i < lens->field_count; i++) {
        double field = lens->fields[i].value.hi;
        largest = !(fabs(field) <= fabs(largest)) ? field : largest;
    }
    return largest;
}

/* The radius of the beam is fixed at the primary wavelength. */
static bool solve_primary(const struct lens_question *question, const struct lens *lens,
                          struct arena *arena, struct first_order *primary, struct error *error)
{
    const struct conjugate_object object = lens_object(lens);
    struct aperture_setting aperture = lens_aperture(lens);
    enum field_kind kind;
    double field = choose_field(question, lens, &kind);
    if (!isnan(question->fnumber)) {
        aperture = (struct aperture_setting){APERTURE_FNUMBER, question->fnumber};
    }
    return first_order_of_lens(lens, lens_primary_wavelength(lens),
                               (enum lens_section)question->section, arena, primary, error) &&
           first_order_aperture(primary, &object, &aperture, kind, field, error);
}

static bool solve_case(const struct lens_question *question, const struct first_order *primary,
                       struct lens_case *one, struct arena *arena, struct error *error)
{
    const struct conjugate_object object = lens_object(one->lens);
    struct paraxial_trace trace;
    enum field_kind kind;
    double field = choose_field(question, one->lens, &kind);
    if (!paraxial_compile(one->lens, one->wavelength, one->section, arena, &one->system, error)) {
        return false;
    }
    if (one->wavelength == lens_primary_wavelength(one->lens)) {
        one->first = *primary;
        return true;
    }
    paraxial_trace(&one->system, &trace);
    first_order_compute(&one->system, &trace, &object, &one->first);
    if (!isnan(primary->stop_radius)) {
        first_order_use_stop(&one->first, &object, primary->stop_radius, kind, field);
        return true;
    }
    /* no stop: the same entrance beam */
    const struct aperture_setting beam = {APERTURE_EPD, primary->entrance_diameter};
    return isnan(beam.value) ||
           first_order_aperture(&one->first, &object, &beam, kind, field, error);
}

const char *lens_warnings_join(const char *first, const char *second, struct arena *arena)
{
    return first == NULL    ? second
           : second == NULL ? first
                            : arena_printf(arena, "%s; %s", first, second);
}

static bool visit_position(const struct lens_question *question, size_t position, struct run *run,
                           bool (*visit)(const struct lens_case *one, struct run *run,
                                         const void *context, struct error *error),
                           const void *context, struct error *error)
{
    const struct lens *all = question->lens.lens;
    const struct lens *lens = lens_at_position(all, position, run->arena);
    struct first_order primary, stated;
    if (!solve_primary(question, lens, run->arena, &primary, error)) {
        return false;
    }
    stated = primary;
    stated.fnumber = isnan(question->fnumber) ? primary.fnumber : NAN;
    struct lens_case one = {
        .lens = lens,
        .position = all->position_count > 0 ? all->positions[position] : NULL,
        .section = (enum lens_section)question->section,
    };
    one.field = choose_field(question, lens, &one.field_kind);
    /* sources state the figures of the y-z section */
    const char *differs =
        one.section == SECTION_Y ? lens_stated_warning(all, position, &stated, run->arena) : NULL;
    one.warning = lens_warnings_join(question->lens.warning, differs, run->arena);
    one.warning =
        lens_warnings_join(one.warning, first_order_warning(lens, run->arena), run->arena);
    bool given = question->wavelength.name != NULL;
    size_t count = given || lens->wavelength_count == 0 ? 1 : lens->wavelength_count;
    for (size_t i = 0; i < count; i++) {
        one.wavelength = given                        ? question->wavelength.wavelength
                         : lens->wavelength_count > 0 ? lens->wavelengths[i].wavelength
                                                      : WAVELENGTH_D;
        if (!solve_case(question, &primary, &one, run->arena, error) ||
            !visit(&one, run, context, error)) {
            return false;
        }
    }
    return true;
}

static bool find_position(const struct lens *lens, struct text name, size_t *position,
                          struct error *error)
{
    *position = lens_position_find(lens, name);
    if (*position != LENS_NONE) {
        return true;
    }
    struct nearest nearest = {.typed = name};
    for (size_t i = 0; i < lens->position_count; i++) {
        nearest_offer(&nearest, text_of(lens->positions[i]));
    }
    fail(error, ERROR_USAGE, "the lens has no position '%.*s'%s%s", text_shown(name), name.start,
         lens->position_count > 0 ? ": its first is " : "",
         lens->position_count > 0 ? lens->positions[0] : "");
    return nearest.best.start != NULL &&
           error_hint(error, "did you mean '%.*s'?", (int)nearest.best.length, nearest.best.start);
}

bool lens_positions(const struct lens *lens, const char *names, struct arena *arena,
                    const size_t **positions, size_t *count, struct error *error)
{
    bool all = wants_all(names) && lens->position_count > 0;
    size_t most = all ? lens->position_count : 1;
    for (const char *at = names; at != NULL && *at != '\0'; at++) {
        most += *at == ',';
    }
    size_t *found = ARENA_ARRAY(arena, most, size_t);
    *positions = found;
    *count = all ? most : 0;
    for (size_t i = 0; i < *count; i++) {
        found[i] = i;
    }
    struct text rest = text_of(names != NULL ? names : "");
    if (names == NULL || wants_all(names)) {
        *count = most; /* the first, if there is nothing else */
        return true;
    }
    while (rest.start != NULL) {
        if (!find_position(lens, text_trim(text_cut(&rest, ',')), &found[*count], error)) {
            return false;
        }
        ++*count;
    }
    return true;
}

bool lens_each(const struct lens_question *question, struct run *run,
               bool (*visit)(const struct lens_case *one, struct run *run, const void *context,
                             struct error *error),
               const void *context, struct error *error)
{
    const struct lens *lens = question->lens.lens;
    if (lens == NULL) {
        fail(error, ERROR_USAGE, "no lens is given");
        return error_hint(error, "a name of 'lenscalc list lenses', or a file");
    }
    const size_t *positions;
    size_t count;
    if (!lens_positions(lens, question->position, run->arena, &positions, &count, error)) {
        return false;
    }
    for (size_t i = 0; i < count; i++) {
        if (!visit_position(question, positions[i], run, visit, context, error)) {
            return false;
        }
    }
    return true;
}
