/* commands/lens/lens_options.c - the cases a lens command is asked for. */
/* SPDX-License-Identifier: MIT */
#include "commands/lens/lens_options.h"

#include "base/quantity.h"

#include <math.h>
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

bool lens_brings(const struct lens *lens, const char *option)
{
    return lens != NULL && lens_has_fields_beside(lens) &&
           strcmp(option, lens->field_kind == FIELD_ANGLE ? "field-x" : "height-x") == 0;
}

bool lens_makes_many(const struct lens_question *question, const struct lens_policy *policy)
{
    const struct lens *lens = question->lens.lens;
    bool all = question->wavelength.name == NULL && policy->wavelengths == WAVELENGTHS_ALL;
    return lens != NULL && ((all && lens->wavelength_count > 1) ||
                            lens_positions_several(lens, question->position));
}

const char *lens_warnings_join(const char *first, const char *second, struct arena *arena)
{
    if (first == NULL) {
        return second;
    }
    return second == NULL ? first : arena_printf(arena, "%s; %s", first, second);
}

const char *lens_island_warning(const struct pupil_islands *islands, struct arena *arena)
{
    return !(islands->share > 0)
               ? NULL
               : arena_printf(arena,
                              "light passes beyond a gap too, about %.2g %% of the area of all: "
                              "not counted",
                              100 * islands->share);
}

/* What is doubtful about the lens, and what its first-order data leave out. */
static const char *lens_options_warning_of(const struct lens_question *question, size_t position,
                                           const struct setup *setup)
{
    struct arena *arena = setup->arena;
    struct first_order stated = setup->first;
    stated.fnumber = isnan(question->fnumber) ? stated.fnumber : NAN;
    /* sources state the figures of the y-z section */
    const char *differs = setup->section == SECTION_Y
                              ? lens_stated_warning(question->lens.lens, position, &stated, arena)
                              : NULL;
    const char *both = lens_warnings_join(question->lens.warning, differs, arena);
    both = lens_warnings_join(both, first_order_warning(setup->lens, arena), arena);
    both = lens_warnings_join(both, setup->warning, arena);
    return lens_warnings_join(both, setup_width_warning(setup, question->fnumber, arena), arena);
}

bool lens_place_image(struct setup *setup, const struct plane_value *focus, struct error *error)
{
    static const char *const words[] = {[PLANE_PARAXIAL] = "paraxial",
                                        [PLANE_TABLE] = "table",
                                        [PLANE_BEST] = "best",
                                        [PLANE_AT] = NULL};
    return setup_place_image(setup, focus, error) ||
           (words[focus->kind] != NULL &&
            error_prefix(error, "{--focus} %s: ", words[focus->kind]));
}

struct setup_field lens_field(enum field_kind kind, double x, double y, int section)
{
    struct setup_field field = {.point = {.kind = kind}, .weight = 1};
    if (isnan(x)) {
        field.point.value[section == SECTION_X ? 0 : 1] = y;
    } else {
        field.point.value[0] = x;
        field.point.value[1] = isnan(y) ? 0 : y;
    }
    return field;
}

const char *lens_field_words(const struct field_point *field, struct arena *arena)
{
    const struct unit *degree = unit_find(&dimension_angle, text_of("deg"));
    const bool angle = field->kind == FIELD_ANGLE;
    double at[2];
    for (int i = 0; i < 2; i++) {
        at[i] = angle ? unit_from_own(degree, field->value[i]) : field->value[i];
    }
    const char *unit = angle ? "deg" : "mm";
    if (field->kind == FIELD_NONE) {
        return "on the axis";
    }
    return at[0] != 0 ? arena_printf(arena, "field x %.6g %s, y %.6g %s", at[0], unit, at[1], unit)
                      : arena_printf(arena, "field %.6g %s", at[1], unit);
}

bool lens_fields_asked(const struct lens_question *question, size_t position,
                       struct setup_field *list, struct error *error)
{
    const struct lens *lens = question->lens.lens;
    bool far =
        lens->objects != NULL ? isinf(lens->objects[position].value.hi) : lens->object_is_infinite;
    for (size_t i = 0; i < question->fields.count; i++) {
        const struct field_item *item = &question->fields.items[i];
        bool is_angle = far || isnan(item->height);
        list[i] = lens_field(is_angle ? FIELD_ANGLE : FIELD_HEIGHT, NAN,
                             is_angle ? item->angle : item->height, question->section);
        list[i].weight = item->weight;
        if (isnan(list[i].point.value[question->section == SECTION_X ? 0 : 1])) {
            return fail(error, ERROR_USAGE,
                        "{--field} %s: an object at infinity has no height, but an angle",
                        question->fields.text);
        }
    }
    return true;
}

/* The focal length of each position at the primary wavelength, mm; NaN where it has none. */
static const double *focal_lengths(const struct lens *lens, struct arena *arena)
{
    double *focals = ARENA_ARRAY(arena, lens->position_count + 1, double);
    for (size_t i = 0; i < lens->position_count; i++) {
        struct first_order first;
        struct error ignored;
        bool known =
            first_order_of_lens(lens_at_position(lens, i, arena), lens_primary_wavelength(lens),
                                SECTION_Y, arena, &first, &ignored);
        focals[i] = known && isfinite(first.efl) ? fabs(first.efl) : (double)NAN;
    }
    return focals;
}

/*
 * A position by focal length, "135mm": the nearest by ratio. LENS_NONE where the name is none, or
 * one that is more than 5 % beyond the ends of the zoom.
 */
static size_t nearest_focal(const struct lens *lens, struct text name, const double *focals)
{
    enum { PERCENT_BEYOND = 5 };
    const struct unit *typed = NULL;
    struct error ignored;
    double wanted, least = INFINITY, most = 0, best = INFINITY;
    size_t nearest = LENS_NONE;
    if (!quantity_read(name, &dimension_length, NULL, &wanted, &typed, &ignored) || typed == NULL ||
        !(wanted > 0)) {
        return LENS_NONE;
    }
    for (size_t i = 0; i < lens->position_count; i++) {
        double off = fabs(log(wanted / focals[i]));
        if (off < best) {
            best = off;
            nearest = i;
        }
        least = fmin(least, focals[i]);
        most = fmax(most, focals[i]);
    }
    const double beyond = 1 + PERCENT_BEYOND / 100.0;
    return wanted * beyond >= least && wanted <= most * beyond ? nearest : LENS_NONE;
}

bool lens_position_named(const struct lens *lens, struct text name, struct arena *arena,
                         size_t *position, struct error *error)
{
    *position = lens_position_find(lens, name);
    if (*position != LENS_NONE) {
        return true;
    }
    const double *focals = focal_lengths(lens, arena);
    *position = nearest_focal(lens, name, focals);
    if (*position != LENS_NONE) {
        return true;
    }
    struct nearest nearest = {.typed = name};
    for (size_t i = 0; i < lens->position_count; i++) {
        nearest_offer(&nearest, text_of(lens->positions[i]));
    }
    /* "wide (70.55 mm), mid (137.0 mm), tele (205.3 mm)" */
    const char *words = "";
    for (size_t k = 0; k < lens->position_count; k++) {
        words = arena_printf(arena, "%s%s%s", words, k > 0 ? ", " : "", lens->positions[k]);
        words = isnan(focals[k]) ? words : arena_printf(arena, "%s (%.4g mm)", words, focals[k]);
    }
    fail(error, ERROR_USAGE, "the lens has no position '%.*s'%s%s", text_shown(name), name.start,
         lens->position_count > 0 ? ": it has " : "", words);
    return nearest.best.start != NULL &&
           error_hint(error, "did you mean '%.*s'?", (int)nearest.best.length, nearest.best.start);
}

bool lens_positions(const struct lens *lens, const char *names, struct arena *arena,
                    const size_t **positions, size_t *count, struct error *error)
{
    if (lens == NULL) {
        fail(error, ERROR_USAGE, "no lens is given");
        return error_hint(error, "a name of 'lenscalc list lenses', or a file");
    }
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
        if (!lens_position_named(lens, text_trim(text_cut(&rest, ',')), arena, &found[*count],
                                 error)) {
            return false;
        }
        ++*count;
    }
    return true;
}

/* The lens of a cursor in a position. */
static bool lens_cursor_open(struct lens_cursor *at, size_t position, struct error *error)
{
    const struct lens_question *question = at->question;
    const struct lens_policy *policy = at->policy;
    struct arena *arena = at->arena;
    const bool one = !isnan(question->field) || !isnan(question->field_x);
    size_t count = one ? 1 : question->fields.count;
    struct setup_field *fields = ARENA_ARRAY(arena, count + 1, struct setup_field);
    struct setup *setup = ARENA_NEW(arena, struct setup);
    const struct setup_question asked = {
        .lens = question->lens.lens,
        .position = position,
        .section = (enum lens_section)question->section,
        .wavelength =
            question->wavelength.name != NULL ? question->wavelength.wavelength : (double)NAN,
        .wavelengths = policy->wavelengths,
        .fnumber = question->fnumber,
        .fields = fields,
        .field_count = count,
        .field_policy = policy->fields,
        .takes_telecentric = policy->telecentric,
        .leaves_stop = policy->is_narrow,
    };
    fields[0] = lens_field(FIELD_ANGLE, question->field_x, question->field, question->section);
    /* Two angles have tangents only below 90 degrees. */
    const double quarter = PI / 2, x = fabs(question->field_x);
    const double y = fabs(question->field);
    if (x > 0 && y > 0 && (!(x < quarter) || !(y < quarter))) {
        return fail(error, ERROR_DOMAIN,
                    "{--field} and {--field-x}: where neither is 0 both must be below 90 degrees");
    }
    if (!lens_fields_asked(question, position, fields, error) ||
        !setup_open(&asked, arena, setup, error) ||
        (policy->focus != NULL && !lens_place_image(setup, policy->focus, error))) {
        return false;
    }
    const char *stop = policy->is_narrow ? NULL : setup_stop_warning(setup, arena);
    at->one =
        (struct lens_case){.setup = setup,
                           .warning = lens_warnings_join(
                               lens_options_warning_of(question, position, setup), stop, arena)};
    return true;
}

struct lens_cursor lens_begin(const struct lens_question *question,
                              const struct lens_policy *policy, struct arena *arena)
{
    return (struct lens_cursor){.question = question, .policy = policy, .arena = arena};
}

bool lens_next_setup(struct lens_cursor *at, struct error *error)
{
    error->code = ERROR_NONE;
    return (at->positions != NULL ||
            lens_positions(at->question->lens.lens, at->question->position, at->arena,
                           &at->positions, &at->position_count, error)) &&
           at->next_position < at->position_count &&
           lens_cursor_open(at, at->positions[at->next_position++], error);
}

bool lens_next(struct lens_cursor *at, struct error *error)
{
    error->code = ERROR_NONE;
    if (at->one.setup != NULL && at->one.index + 1 < at->one.setup->wavelength_count) {
        at->one.index++;
    } else if (!lens_next_setup(at, error)) {
        return false;
    }
    return setup_light(at->one.setup, at->one.index, &at->one.light, error);
}
