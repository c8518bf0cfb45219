/* design/variable.c - what of a lens a design varies: checked, and set up. */
/* SPDX-License-Identifier: MIT */
#include "design/variable.h"

#include "base/constants.h"
#include "design/glass_map.h"
#include "optics/first_order.h"

#include <float.h>
#include <math.h>
#include <string.h>

/* Is it varied by its reciprocal, so that it passes through infinity? */
static bool is_inverse(enum parameter_kind kind)
{
    return kind == PARAMETER_RADIUS || kind == PARAMETER_FOCAL;
}

static bool is_cell(const struct figure *figure, size_t word)
{
    return figure != NULL && figure->variable == word;
}

/* The word of the positions that stands in the cell; LENS_NONE: none. */
static size_t variable_word_of(const struct lens *lens, struct parameter what)
{
    const struct figure *figure =
        what.surface < lens->surface_count
            ? parameter_figure(&lens->surfaces[what.surface], what.kind, what.order)
            : NULL;
    return figure != NULL ? figure->variable : LENS_NONE;
}

/* Are there derivatives by it, and a place in a file? */
static bool check_what(const struct lens *lens, const struct variable *one, struct error *error)
{
    const struct parameter_type *type = parameter_type(one->what.kind);
    const bool is_derived = type->basis != PARAMETER_KINDS || one->what.kind == PARAMETER_FOCAL;
    if (!is_derived || one->what.kind == PARAMETER_TILT_Z) {
        return fail(error, ERROR_DOMAIN, "the %s of a surface does not vary", type->words);
    }
    if (one->position == LENS_NONE) {
        return parameter_check(lens, one->what, error);
    }
    size_t word = variable_word_of(lens, one->what);
    bool known = one->position < lens->position_count && word != LENS_NONE &&
                 (one->what.kind == PARAMETER_THICKNESS || one->what.kind == PARAMETER_FOCAL);
    for (size_t i = 0; known && i < lens->surface_count; i++) {
        const struct surface *surface = &lens->surfaces[i];
        const struct figure *cells[] = {&surface->diameter, &surface->hiatus};
        bool other = one->what.kind == PARAMETER_FOCAL
                         ? is_cell(parameter_figure(surface, PARAMETER_THICKNESS, 0), word)
                         : is_cell(parameter_figure(surface, PARAMETER_FOCAL, 0), word);
        known = !other && !(surface->has_diameter && is_cell(cells[0], word)) &&
                !(surface_has(surface, SURFACE_HAS_FOCAL) && is_cell(cells[1], word));
    }
    return known || fail(error, ERROR_DOMAIN,
                         "%s: only a word that stands for thicknesses, or for focal lengths, is "
                         "varied in one position",
                         one->name);
}

static bool check_alone(const struct variables *variables, size_t at, struct error *error)
{
    const struct variable *one = &variables->list[at];
    const struct lens *lens = variables->lens;
    for (size_t i = 0; i < at; i++) {
        const struct variable *other = &variables->list[i];
        bool word = one->position != LENS_NONE &&
                    variable_word_of(lens, one->what) == variable_word_of(lens, other->what);
        if (one->position == other->position &&
            (word || parameter_is_same(one->what, other->what))) {
            return fail(error, ERROR_DOMAIN, "%s and %s are the same number, which varies once",
                        other->name, one->name);
        }
    }
    for (size_t i = 0; i < lens->pickup_count; i++) {
        const struct lens_pickup *pickup = &lens->pickups[i];
        bool of_medium = parameter_is_of_medium(one->what.kind) &&
                         pickup->what.kind == PARAMETER_GLASS &&
                         pickup->what.surface == one->what.surface;
        if (of_medium || parameter_is_same(pickup->what, one->what)) {
            return fail(error, ERROR_DOMAIN,
                        "%s follows surface %zu by a pick-up: vary that, or leave the pick-up out",
                        one->name, pickup->from.surface + 1);
        }
    }
    return true;
}

/* Which number something of the lens is; as many as there are: none. */
static size_t variable_find_number(const struct variables *variables, struct parameter what)
{
    size_t i = 0;
    what.kind = what.kind == PARAMETER_RADIUS ? PARAMETER_CURVATURE : what.kind;
    while (i < variables->number_count &&
           !parameter_is_identical(variables->numbers[i].what, what)) {
        i++;
    }
    return i;
}

/* The same, made where it is not there yet. */
static size_t variable_number_of(struct variables *variables, struct parameter what)
{
    const size_t i = variable_find_number(variables, what);
    if (i == variables->number_count) {
        struct variable_number *number = &variables->numbers[variables->number_count++];
        *number = (struct variable_number){what, what.kind == PARAMETER_FOCAL};
        number->what.kind = what.kind == PARAMETER_RADIUS ? PARAMETER_CURVATURE : what.kind;
    }
    return i;
}

/* Of a word all cells that it stands in. */
static void add_drives(struct variables *variables, size_t at)
{
    const struct lens *lens = variables->lens;
    const struct variable *one = &variables->list[at];
    const bool is_word = one->position != LENS_NONE;
    const size_t word = variable_word_of(lens, one->what);
    for (size_t i = 0; i < (is_word ? lens->surface_count : 1); i++) {
        const struct parameter cell = {i, one->what.kind, 0};
        if (!is_word || is_cell(parameter_figure(&lens->surfaces[i], cell.kind, 0), word)) {
            variables->drives[variables->drive_count++] = (struct variable_drive){
                .variable = at,
                .number = variable_number_of(variables, is_word ? cell : one->what),
                .position = one->position,
                .share = LENS_NONE};
        }
    }
}

static bool variable_is_free(const struct variable *one)
{
    return isinf(one->low) && isinf(one->high);
}

/* Those pick-ups that follow a number which a variable reaches, itself or by pick-ups before; of
   glasses their numbers. */
static void add_rules(struct variables *variables)
{
    static const enum parameter_kind both[] = {PARAMETER_INDEX, PARAMETER_ABBE};
    for (size_t i = 0; i < variables->lens->pickup_count; i++) {
        const struct lens_pickup *pickup = &variables->lens->pickups[i];
        const bool is_glass = pickup->what.kind == PARAMETER_GLASS;
        for (size_t k = 0; k < (is_glass ? 2 : 1); k++) {
            struct parameter to = pickup->what, from = pickup->from;
            if (is_glass) {
                to.kind = from.kind = both[k];
            }
            if (variable_find_number(variables, from) == variables->number_count) {
                continue;
            }
            variables->rules[variables->rule_count++] =
                (struct variable_rule){.from = variable_number_of(variables, from),
                                       .to = variable_number_of(variables, to),
                                       .from_inverse = is_inverse(from.kind),
                                       .to_inverse = is_inverse(to.kind),
                                       .factor = is_glass ? 1 : pickup->factor.value.hi,
                                       .offset = is_glass ? 0 : pickup->offset.value.hi};
        }
    }
}

/* The length that natural scales are counted in: 1, 2 or 5 times a power of ten. */
static double variable_size_of(const struct lens *lens, struct arena *arena)
{
    struct first_order first;
    struct error none;
    double track = 0;
    for (size_t i = 0; i < lens->surface_count; i++) {
        track += fabs(surface_advance(&lens->surfaces[i]).hi);
    }
    bool known =
        first_order_of_lens(lens, lens_primary_wavelength(lens), SECTION_Y, arena, &first, &none);
    double efl = known ? fabs(first.efl) : NAN;
    double size = track > 0 ? track : 100;
    if (efl > track / 10 && efl < 10 * track) {
        size = efl;
    }
    double decade = 1e-9;
    while (decade * 10 <= size && decade < 1e9) {
        decade *= 10;
    }
    static const double below[] = {1.4142, 3.1623, 7.0711}, round[] = {1, 2, 5, 10};
    const double steps = size / decade; /* 1 .. 10, between the steps by ratio */
    size_t i = 0;
    while (i < sizeof below / sizeof below[0] && !(steps < below[i])) {
        i++;
    }
    return decade * round[i];
}

static double variable_scale_of(const struct lens *lens, struct parameter what, double size)
{
    switch (what.kind) {
    case PARAMETER_RADIUS:
    case PARAMETER_CURVATURE:
    case PARAMETER_FOCAL:
        return 1 / size;
    case PARAMETER_THICKNESS:
        return size / 10;
    case PARAMETER_COEFFICIENT: {
        const struct surface *surface = &lens->surfaces[what.surface];
        double r = surface->has_diameter ? surface->diameter.value.hi / 2 : size / 10;
        return pow(r, 2 - what.order) / (2 * size);
    }
    case PARAMETER_INDEX:
        return 0.1;
    case PARAMETER_ABBE:
        return 10;
    case PARAMETER_DECENTER_X:
    case PARAMETER_DECENTER_Y:
    case PARAMETER_BREAK_DECENTER_X:
    case PARAMETER_BREAK_DECENTER_Y:
        return size / 100;
    case PARAMETER_TILT_X:
    case PARAMETER_TILT_Y:
    case PARAMETER_TILT_Z:
    case PARAMETER_BREAK_TILT_X:
    case PARAMETER_BREAK_TILT_Y:
    case PARAMETER_BREAK_TILT_Z:
        return 0.01;
    case PARAMETER_CONIC:
    case PARAMETER_HIATUS:
    case PARAMETER_GLASS:
    case PARAMETER_KINDS:
        break;
    }
    return 1;
}

/* What was named lies between these bounds: a radius through a plane outside of them. A number that
   was written with fewer digits lies on its bound still. */
static bool variable_is_within(double value, double low, double high)
{
    const double slack = 1e-12; /* of a finite one */
    low -= slack * fmin(fabs(low), DBL_MAX);
    high += slack * fmin(fabs(high), DBL_MAX);
    return low <= high ? low <= value && value <= high : value >= low || value <= high;
}

/* The unit that a value is shown in, and what it is multiplied by for that. */
static const char *variable_unit(const struct variable *one, double *factor)
{
    const int length = parameter_length(one->what.kind, one->what.order);
    const bool is_angle = (parameter_type(one->what.kind)->is & PARAMETER_IS_ANGLE) != 0;
    *factor = is_angle ? 1 / RADIANS_PER_DEGREE : 1;
    if (is_angle) {
        return " deg";
    }
    if (length == 1) {
        return " mm";
    }
    return length == -1 ? " /mm" : "";
}

static bool variable_check_bounds(const struct variable *one, struct error *error)
{
    double factor;
    const char *unit = variable_unit(one, &factor);
    double low = factor * one->low, high = factor * one->high;
    bool inverse = is_inverse(one->what.kind), turned = inverse && one->low > 0 && one->high < 0;
    if (isnan(low) || isnan(high) || (!(low < high) && !turned)) {
        fail(error, ERROR_DOMAIN, "%s: the bounds %.10g to %.10g%s leave nothing to vary",
             one->name, low, high, unit);
        return error_hint(error, "the lower one comes first; what is to stay is held, not varied");
    }
    if (inverse && low < 0 && high > 0 && !variable_is_free(one)) {
        fail(error, ERROR_DOMAIN, "%s: between the bounds %.10g and %.10g%s lies 0, which is no %s",
             one->name, low, high, unit, parameter_type(one->what.kind)->words);
        return isfinite(low) && isfinite(high) &&
               error_hint(error, "through a plane it is %s[%.10g,%.10g]", one->name, high, low);
    }
    return true;
}

const char *variables_moved(const struct variables *variables, struct arena *arena)
{
    const char *words = NULL;
    for (size_t i = 0; i < variables->count; i++) {
        const struct variable *one = &variables->list[i];
        const bool inverse = is_inverse(one->what.kind);
        double factor;
        const char *unit = variable_unit(one, &factor);
        const double own = inverse ? 1 / variables->own[i] : variables->own[i];
        const double start = inverse ? 1 / variables->start[i] : variables->start[i];
        if (variable_is_within(own, one->low, one->high) || start == own) {
            continue;
        }
        const char *is = isinf(own) && inverse ? "that of a plane"
                                               : arena_printf(arena, "%.10g%s", factor * own, unit);
        words = arena_printf(
            arena, "%s%s%s is %s, outside of its bounds %.10g to %.10g%s: it begins at %.10g%s",
            words != NULL ? words : "", words != NULL ? "; " : "", one->name, is, factor * one->low,
            factor * one->high, unit, factor * start, unit);
    }
    return words;
}

/* Of a glass within the map; one that was written with fewer digits lies on its border still. */
static double variable_share_within(double nd, double Vd)
{
    if (variable_is_within(nd, GLASS_MAP_LOWEST, GLASS_MAP_HIGHEST)) {
        nd = fmin(fmax(nd, GLASS_MAP_LOWEST), GLASS_MAP_HIGHEST);
    }
    const double share = glass_map_share(nd, Vd);
    return variable_is_within(1 + share, 1, 2) ? fmin(fmax(share, 0), 1) : NAN;
}

static bool fail_outside(const struct lens *lens, size_t surface, struct error *error)
{
    const struct parameter nd = {surface, PARAMETER_INDEX, 0}, Vd = {surface, PARAMETER_ABBE, 0};
    return fail(error, ERROR_DOMAIN,
                "surface %zu: %.6g/%.6g lies outside of the map of optical "
                "glasses, within which a model glass varies",
                surface + 1, parameter_get(lens, nd), parameter_get(lens, Vd));
}

/* One number of a model glass without bounds stays within the map too: where the other stands, or
   as far as its bounds let it go. */
static bool open_lone(struct variables *variables, size_t at, struct error *error)
{
    const struct variable *one = &variables->list[at], *other = NULL;
    const struct lens *lens = &variables->lenses[0].lens;
    const bool is_index = one->what.kind == PARAMETER_INDEX;
    for (size_t i = 0; i < variables->count && other == NULL; i++) {
        const struct parameter *what = &variables->list[i].what;
        if (parameter_is_of_medium(what->kind) && what->surface == one->what.surface &&
            what->kind != one->what.kind) {
            other = &variables->list[i];
        }
    }
    if (!parameter_is_of_medium(one->what.kind) || !variable_is_free(one) ||
        (other != NULL && variable_is_free(other)) || one->what.surface >= lens->surface_count ||
        lens->surfaces[one->what.surface].medium.kind != MEDIUM_MODEL) {
        return true;
    }
    struct parameter what = one->what;
    what.kind = is_index ? PARAMETER_ABBE : PARAMETER_INDEX;
    const double beside = parameter_get(lens, what);
    const double low = other != NULL ? other->low : beside;
    const double high = other != NULL ? other->high : beside;
    const struct glass_map_range range =
        is_index ? glass_map_indices(low, high) : glass_map_abbes(low, high);
    const double value = parameter_get(lens, one->what);
    if (!(range.low < range.high) || !variable_is_within(value, range.low, range.high)) {
        fail_outside(lens, what.surface, error);
        return error_hint(error, "hold it, or give %s bounds of its own", one->name);
    }
    variables->low[at] = range.low;
    variables->high[at] = range.high;
    return true;
}

/* nd and Vd of one medium without bounds, within the map: Vd becomes the share of it. */
static bool pair_glasses(struct variables *variables, struct error *error)
{
    const struct lens *lens = &variables->lenses[0].lens;
    for (size_t i = 0; i < variables->drive_count; i++) {
        struct variable_drive *abbe = &variables->drives[i];
        const struct variable *of = &variables->list[abbe->variable];
        if (of->what.kind != PARAMETER_ABBE || !variable_is_free(of)) {
            continue;
        }
        for (size_t j = 0; j < variables->drive_count; j++) {
            const size_t n = variables->drives[j].variable, share = abbe->variable;
            const struct variable *index = &variables->list[n];
            if (index->what.kind != PARAMETER_INDEX || index->what.surface != of->what.surface ||
                !variable_is_free(index)) {
                continue;
            }
            if (isnan(variable_share_within(parameter_get(lens, index->what),
                                            parameter_get(lens, of->what)))) {
                fail_outside(lens, of->what.surface, error);
                return error_hint(error, "hold it, or give n%zu and V%zu bounds of their own",
                                  of->what.surface + 1, of->what.surface + 1);
            }
            abbe->share = share;
            abbe->variable = n;
            variables->low[n] = GLASS_MAP_LOWEST;
            variables->high[n] = GLASS_MAP_HIGHEST;
            variables->low[share] = 0;
            variables->high[share] = 1;
            variables->scale[share] = of->scale > 0 ? of->scale : 0.5;
            break;
        }
    }
    return true;
}

/* Room for all, and the lens in every position. */
static void open_room(struct variables *variables, struct arena *arena)
{
    const struct lens *lens = variables->lens;
    const size_t count = variables->count, cells = lens->surface_count, rules = lens->pickup_count;
    const size_t most = count * (1 + cells) + 4 * rules;
    variables->position_count = lens->position_count > 0 ? lens->position_count : 1;
    variables->own = ARENA_ARRAY(arena, count + 1, double);
    variables->start = ARENA_ARRAY(arena, count + 1, double);
    variables->low = ARENA_ARRAY(arena, count + 1, double);
    variables->high = ARENA_ARRAY(arena, count + 1, double);
    variables->scale = ARENA_ARRAY(arena, count + 1, double);
    variables->numbers = ARENA_ARRAY(arena, most + 1, struct variable_number);
    variables->drives = ARENA_ARRAY(arena, count * (1 + cells) + 1, struct variable_drive);
    variables->rules = ARENA_ARRAY(arena, 2 * rules + 1, struct variable_rule);
    variables->lenses = ARENA_ARRAY(arena, variables->position_count, struct lens_numbers);
    for (size_t p = 0; p < variables->position_count; p++) {
        lens_numbers_open(lens_at_position(lens, p, arena), arena, &variables->lenses[p]);
    }
}

/* Where all numbers start. */
static void open_values(struct variables *variables, struct arena *arena)
{
    const size_t numbers = variables->number_count;
    variables->values = ARENA_ARRAY(arena, variables->position_count * numbers + 1, double);
    variables->slopes = ARENA_ARRAY(arena, numbers + 1, double);
    for (size_t p = 0; p < variables->position_count; p++) {
        for (size_t i = 0; i < numbers; i++) {
            const struct variable_number *number = &variables->numbers[i];
            double value = parameter_get(&variables->lenses[p].lens, number->what);
            variables->values[p * numbers + i] = number->is_inverse ? 1 / value : value;
        }
    }
    for (size_t i = 0; i < variables->drive_count; i++) {
        const struct variable_drive *drive = &variables->drives[i];
        size_t position = drive->position == LENS_NONE ? 0 : drive->position;
        double value = variables->values[position * numbers + drive->number];
        if (drive->share == LENS_NONE) {
            const size_t at = drive->variable;
            variables->own[at] = value;
            variables->start[at] = fmin(fmax(value, variables->low[at]), variables->high[at]);
        } else {
            struct parameter index = variables->numbers[drive->number].what;
            index.kind = PARAMETER_INDEX;
            double nd = parameter_get(&variables->lenses[0].lens, index);
            variables->start[drive->share] = variable_share_within(nd, value);
            variables->own[drive->share] = variables->start[drive->share];
        }
    }
}

bool variables_open(const struct lens *lens, const struct variable *list, size_t count,
                    struct arena *arena, struct variables *variables, struct error *error)
{
    *variables = (struct variables){.lens = lens, .count = count};
    variables->list = ARENA_ARRAY(arena, count + 1, struct variable);
    if (count > 0) {
        memcpy(variables->list, list, count * sizeof list[0]);
    }
    open_room(variables, arena);
    const struct lens *first = &variables->lenses[0].lens;
    double size = variable_size_of(first, arena);
    for (size_t i = 0; i < count; i++) {
        variables->scale[i] =
            list[i].scale > 0 ? list[i].scale : variable_scale_of(first, list[i].what, size);
    }
    for (size_t i = 0; i < count; i++) {
        const struct variable *one = &variables->list[i];
        if (!check_what(lens, one, error) || !check_alone(variables, i, error)) {
            return false;
        }
        if (!variable_check_bounds(one, error)) {
            return one->place.source != NULL &&
                   error_locate(error, one->place.source, one->place.line, one->place.column);
        }
        variables->low[i] = one->low;
        variables->high[i] = one->high;
        /* the bounds of a radius as those of the curvature; an infinite one is that of a plane */
        if (is_inverse(one->what.kind) && !variable_is_free(one)) {
            variables->low[i] = isinf(one->high) ? 0 : 1 / one->high;
            variables->high[i] = isinf(one->low) ? 0 : 1 / one->low;
        }
        add_drives(variables, i);
    }
    for (size_t i = 0; i < count; i++) {
        if (!open_lone(variables, i, error)) {
            return false;
        }
    }
    if (!pair_glasses(variables, error)) {
        return false;
    }
    add_rules(variables);
    open_values(variables, arena);
    /* Do the pick-ups give numbers? */
    for (size_t p = 0; p < variables->position_count; p++) {
        for (size_t i = 0; i < variables->rule_count; i++) {
            const struct variable_number *to = &variables->numbers[variables->rules[i].to];
            if (!isfinite(
                    variables->values[p * variables->number_count + variables->rules[i].to])) {
                return fail(error, ERROR_DOMAIN,
                            "the pick-up of the %s of surface %zu gives no finite number",
                            parameter_type(to->what.kind)->words, to->what.surface + 1);
            }
        }
    }
    return true;
}
