/* cli/options/vary.c - what of a lens may change: --vary, --hold, or the marks of its file. */
/* SPDX-License-Identifier: MIT */
#include "cli/options/vary.h"

#include "base/quantity.h"
#include "file/lens_glass.h"

#include <math.h>
#include <string.h>

/* What the items have come to so far. */
struct vary_parser {
    const struct vary_reader *reader;
    const char *option; /* "vary"; null: these are the marks of the lens */
    struct vary_entry {
        struct variable variable;
        bool is_group; /* it came with a range, and an item of its own takes its place */
    } * entries;
    size_t count, room;
    struct text item; /* the present one */
    struct text bounds;
    bool is_group;
};

static bool bad_part(const struct vary_parser *naming, struct error *error)
{
    return error_prefix(error, "bad part in {--%s}: ", naming->option);
}

/* One that is there already gives way, or stays; by name it is there once. */
static bool vary_add(struct vary_parser *naming, struct variable variable, struct error *error)
{
    struct arena *arena = naming->reader->arena;
    const struct vary_entry entry = {variable, naming->is_group};
    for (size_t i = 0; i < naming->count; i++) {
        struct vary_entry *old = &naming->entries[i];
        if (old->variable.position != variable.position ||
            !parameter_is_same(old->variable.what, variable.what)) {
            continue;
        }
        if (naming->option == NULL) {
            return fail(error, ERROR_DOMAIN,
                        "the lens has marks of %s and %s, which are one number", old->variable.name,
                        variable.name);
        }
        if (!naming->is_group && !old->is_group) {
            bool same = strcmp(old->variable.name, variable.name) == 0;
            return fail(error, ERROR_USAGE,
                        same ? "{--%s} names %s twice" : "{--%s} names %s as %s too",
                        naming->option, old->variable.name, variable.name);
        }
        *old = old->is_group && !naming->is_group ? entry : *old;
        return true;
    }
    naming->entries =
        arena_grow(arena, naming->entries, naming->count, &naming->room, sizeof entry);
    naming->entries[naming->count++] = entry;
    return true;
}

/* In mm or degrees unless it has a unit. */
static bool vary_read_bound(struct text text, struct parameter what, double *value,
                            struct error *error)
{
    bool angle = (parameter_type(what.kind)->is & PARAMETER_IS_ANGLE) != 0;
    const bool length = parameter_length(what.kind, what.order) == 1;
    const struct dimension *dimension = length ? &dimension_length : &dimension_number;
    const char *unit = "mm";
    if (angle) {
        dimension = &dimension_angle;
        unit = "deg";
    }
    if (text_equal(text, "inf") || text_equal(text, "-inf")) {
        *value = *text.start == '-' ? -INFINITY : INFINITY;
        return true;
    }
    return quantity_read(text, dimension,
                         dimension != &dimension_number ? unit_find(dimension, text_of(unit))
                                                        : NULL,
                         value, NULL, error);
}

static bool vary_read_bounds(const struct vary_parser *naming, struct variable *variable,
                             struct error *error)
{
    struct text high = naming->bounds;
    variable->low = -INFINITY;
    variable->high = INFINITY;
    if (high.start == NULL) {
        return true;
    }
    bool closed = high.length > 0 && high.start[high.length - 1] == ']';
    high.length -= closed ? 1 : 0;
    const struct text low = text_trim(text_cut(&high, ','));
    if (!closed || high.start == NULL) {
        fail(error, ERROR_USAGE, "bad part '%.*s' in {--%s}", text_shown(naming->item),
             naming->item.start, naming->option);
        return error_hint(error, "parts are R1 (radius), t3[2,10] (gap, with bounds), n2 (index)");
    }
    return (vary_read_bound(low, variable->what, &variable->low, error) &&
            vary_read_bound(text_trim(high), variable->what, &variable->high, error)) ||
           bad_part(naming, error);
}

/* A model glass that varies has nd and Vd. */
static bool vary_check_glass(const struct lens *lens, size_t surface, struct error *error)
{
    const struct medium *medium = &lens->surfaces[surface].medium;
    if (medium->kind == MEDIUM_MODEL) {
        return true;
    }
    fail(error, ERROR_DOMAIN,
         "the medium %.*s after surface %zu is no model glass: only one of nd/Vd varies as a glass",
         text_shown(medium->written), medium->written.start, surface + 1);
    const struct glass_abbe printed = lens_glass_printed(medium);
    if (isfinite(printed.nd) && isfinite(printed.Vd)) {
        return error_hint(error, "write %.6g/%.6g in its place", printed.nd, printed.Vd);
    }
    return medium->kind == MEDIUM_CONSTANT && !medium_is_air(medium) &&
           error_hint(error, "n%zu varies its index", surface + 1);
}

/* One number of all positions, or the two of a glass. */
static bool add_parameter(struct vary_parser *naming, struct parameter what, struct error *error)
{
    static const enum parameter_kind numbers[] = {PARAMETER_INDEX, PARAMETER_ABBE};
    const struct lens *lens = naming->reader->lens;
    struct variable variable = {.what = what, .position = LENS_NONE};
    if (what.kind != PARAMETER_GLASS) {
        variable.name = parameter_mark_write(what, naming->reader->arena);
        return vary_read_bounds(naming, &variable, error) && vary_add(naming, variable, error);
    }
    if (what.surface >= lens->surface_count) {
        return parameter_check(lens, what, error);
    }
    if (naming->bounds.start != NULL) {
        return fail(error, ERROR_USAGE,
                    "a glass has no bounds in {--%s}: give those of n%zu and V%zu", naming->option,
                    what.surface + 1, what.surface + 1);
    }
    if (!vary_check_glass(lens, what.surface, error)) {
        return false;
    }
    for (size_t i = 0; i < 2; i++) {
        what.kind = numbers[i];
        if (!add_parameter(naming, what, error)) {
            return false;
        }
    }
    return true;
}

bool vary_find_cell(const struct lens *lens, size_t word, struct parameter *what)
{
    static const enum parameter_kind kinds[] = {PARAMETER_THICKNESS, PARAMETER_FOCAL};
    for (size_t i = 0; i < 2 * lens->surface_count; i++) {
        *what = (struct parameter){i / 2, kinds[i % 2], 0};
        const struct figure *cell =
            parameter_figure(&lens->surfaces[what->surface], what->kind, what->order);
        if (cell != NULL && cell->variable == word) {
            return true;
        }
    }
    return false;
}

/* A word of the positions, in one of them or (LENS_NONE) in each. */
static bool vary_add_word(struct vary_parser *naming, size_t word, size_t position,
                          struct error *error)
{
    const struct lens *lens = naming->reader->lens;
    const struct text name = lens->variables[word].name;
    struct variable variable = {.position = 0};
    if (!vary_find_cell(lens, word, &variable.what)) {
        return fail(error, ERROR_DOMAIN,
                    "%.*s stands for no thickness and no focal length: it cannot vary",
                    text_shown(name), name.start);
    }
    for (size_t p = 0; p < lens->position_count; p++) {
        variable.position = p;
        variable.name = arena_printf(naming->reader->arena, "%.*s@%s", (int)name.length, name.start,
                                     lens->positions[p]);
        if ((position == LENS_NONE || position == p) &&
            (!vary_read_bounds(naming, &variable, error) || !vary_add(naming, variable, error))) {
            return false;
        }
    }
    return true;
}

static bool vary_takes(const struct vary_reader *reader, enum parameter_kind kind)
{
    return reader->takes == NULL || reader->takes(kind);
}

/* What has a name, but the command does not vary it. */
static bool vary_check_kind(const struct vary_parser *naming, struct parameter what,
                            struct error *error)
{
    const struct vary_reader *reader = naming->reader;
    if (vary_takes(reader, what.kind)) {
        return true;
    }
    const char *words =
        what.kind >= PARAMETER_DECENTER_X ? "displacement" : parameter_type(what.kind)->words;
    bool hisses = words[strlen(words) - 1] == 's';
    fail(error, ERROR_USAGE, "bad part '%.*s' in {--%s}: %s, not %s%s", text_shown(naming->item),
         naming->item.start, naming->option, reader->only, words, hisses ? "es" : "s");
    return what.kind == PARAMETER_CURVATURE && vary_takes(reader, PARAMETER_RADIUS) &&
           error_hint(error, "R%zu varies the curvature", what.surface + 1);
}

/* R1, or another name of a gap, with a suggestion also from the words of the lens. */
static bool read_parameter(const struct vary_parser *naming, struct text name,
                           struct parameter *parameter, struct error *error)
{
    const struct lens *lens = naming->reader->lens;
    const struct parameter gap = {parameter_gap_find(lens, name), PARAMETER_THICKNESS, 0};
    if (gap.surface != LENS_NONE) {
        *parameter = gap;
        return true;
    }
    if (name.length > 0 && char_is_digit(*name.start)) { /* of no surface that there is */
        name = text_of(arena_printf(naming->reader->arena, "t%.*s", (int)name.length, name.start));
    }
    if (parameter_read(name, naming->reader->takes, parameter, error)) {
        return true;
    }
    bad_part(naming, error);
    struct nearest nearest = {.typed = name};
    for (size_t i = 0; i < lens->variable_count; i++) {
        nearest_offer(&nearest, lens->variables[i].name);
    }
    if (nearest.best.start != NULL && error->hint[0] == '\0') {
        return error_hint(error, "did you mean '%.*s'?", (int)nearest.best.length,
                          nearest.best.start);
    }
    return error->hint[0] == '\0' &&
           error_hint(error, "parts are R1 (radius), t3[2,10] (gap, with bounds), n2 (index)");
}

/* Has the surface this to vary, so that a range takes it? */
static bool vary_is_there(const struct lens *lens, struct parameter what)
{
    const struct surface *surface = &lens->surfaces[what.surface];
    const struct medium *medium = &surface->medium;
    struct error none;
    if (!parameter_suits(what.kind, surface)) {
        return false;
    }
    for (size_t i = 0; i < lens->pickup_count; i++) {
        const struct parameter follows = lens->pickups[i].what;
        bool glass = follows.kind == PARAMETER_GLASS && follows.surface == what.surface &&
                     (what.kind == PARAMETER_INDEX || what.kind == PARAMETER_ABBE);
        if (glass || parameter_is_same(follows, what)) {
            return false;
        }
    }
    switch (what.kind) {
    case PARAMETER_RADIUS:
    case PARAMETER_CONIC:
    case PARAMETER_COEFFICIENT:
        return isfinite(
                   parameter_get(lens, (struct parameter){what.surface, PARAMETER_RADIUS, 0})) &&
               parameter_check(lens, what, &none);
    case PARAMETER_INDEX:
        return !medium_is_air(medium) && parameter_check(lens, what, &none);
    case PARAMETER_GLASS:
        return medium->kind == MEDIUM_MODEL && parameter_check(lens, what, &none);
    default:
        return parameter_check(lens, what, &none);
    }
}

/* Those from one surface up to before another. */
static bool vary_add_range(struct vary_parser *naming, struct parameter what, size_t end,
                           struct error *error)
{
    const struct lens *lens = naming->reader->lens;
    size_t before = naming->count;
    bool found = false;
    naming->is_group = true;
    for (; what.surface < end; what.surface++) {
        const struct figure *cell =
            parameter_figure(&lens->surfaces[what.surface], what.kind, what.order);
        struct parameter first;
        bool word = cell != NULL && cell->variable != LENS_NONE;
        bool once =
            word && vary_find_cell(lens, cell->variable, &first) && first.surface == what.surface;
        bool there = word ? once : vary_is_there(lens, what);
        if (there && !(word ? vary_add_word(naming, cell->variable, LENS_NONE, error)
                            : add_parameter(naming, what, error))) {
            return false;
        }
        found = found || there;
    }
    return found || naming->count > before ||
           fail(error, ERROR_USAGE, "'%.*s' in {--%s} holds no %s that may vary",
                text_shown(naming->item), naming->item.start, naming->option,
                parameter_type(what.kind)->words);
}

/* R1..R11 or R1..11: `dots` is where the two ends meet. */
static bool vary_read_range(struct vary_parser *naming, struct text name, const char *dots,
                            struct error *error)
{
    const struct lens *lens = naming->reader->lens;
    const struct text from = text_between(name.start, dots);
    struct text to = text_between(dots + 2, name.start + name.length);
    struct parameter first, last;
    if (to.length > 0 && char_is_digit(*to.start)) { /* with the name of the first */
        size_t length = from.length;
        while (length > 0 && char_is_digit(from.start[length - 1])) {
            length--;
        }
        to = text_of(arena_printf(naming->reader->arena, "%.*s%.*s", (int)length, from.start,
                                  (int)to.length, to.start));
    }
    if (!read_parameter(naming, from, &first, error) || !read_parameter(naming, to, &last, error)) {
        return false;
    }
    if (first.kind != last.kind || first.order != last.order || first.surface > last.surface) {
        return fail(error, ERROR_USAGE,
                    "bad part '%.*s' in {--%s}: a range goes from a surface to a later one, as "
                    "R1..R11",
                    text_shown(naming->item), naming->item.start, naming->option);
    }
    if (last.surface >= lens->surface_count) {
        return parameter_check(lens, last, error);
    }
    return vary_check_kind(naming, first, error) &&
           vary_add_range(naming, first, last.surface + 1, error);
}

/*
 * The word that a name stands for: itself, or that in the cell of the gap that it names. LENS_NONE:
 * none.
 */
static bool vary_find_word(const struct vary_parser *naming, struct text name, size_t *word,
                           struct error *error)
{
    const struct lens *lens = naming->reader->lens;
    for (*word = 0; *word < lens->variable_count; *word += 1) {
        if (text_identical(lens->variables[*word].name, name)) {
            return true;
        }
    }
    const size_t gap = parameter_gap_find(lens, name);
    *word = gap != LENS_NONE ? lens->surfaces[gap].thickness.variable : LENS_NONE;
    for (size_t i = 0; i < lens->surface_count && *word != LENS_NONE; i++) {
        if (i != gap && lens->surfaces[i].thickness.variable == *word) {
            const struct text is = lens->variables[*word].name;
            return fail(error, ERROR_USAGE,
                        "bad part '%.*s' in {--%s}: it is %.*s, as the gap after surface %zu is: "
                        "name that, which is all of them",
                        text_shown(naming->item), naming->item.start, naming->option,
                        text_shown(is), is.start, i + 1);
        }
    }
    return true;
}

static bool vary_read_item(struct vary_parser *naming, struct text item, struct error *error)
{
    struct text bounds = item, name = text_trim(text_cut(&bounds, '['));
    struct text position = name, word = text_cut(&position, '@');
    const struct text all = text_behind(name, "all-");
    struct parameter what;
    const struct lens *lens = naming->reader->lens;
    naming->item = item;
    naming->bounds = bounds;
    naming->is_group = false;
    size_t known;
    if (!vary_find_word(naming, word, &known, error)) {
        return false;
    }
    if (known != LENS_NONE) {
        /* d5@tele */
        size_t at = position.start != NULL ? lens_position_find(lens, position) : LENS_NONE;
        if (position.start != NULL && at == LENS_NONE) {
            fail(error, ERROR_USAGE, "bad part '%.*s' in {--%s}: the lens has no position '%.*s'",
                 text_shown(naming->item), naming->item.start, naming->option, text_shown(position),
                 position.start);
            return error_hint(error, "it has %s and others", lens->positions[0]);
        }
        return vary_add_word(naming, known, at, error);
    }
    for (size_t i = 0; i + 1 < name.length; i++) {
        if (name.start[i] == '.' && name.start[i + 1] == '.') {
            return vary_read_range(naming, name, name.start + i, error);
        }
    }
    if (all.start != NULL) {
        /* all-R, all-t */
        what = (struct parameter){0};
        if (!parameter_name_read(all, &what.kind, &what.order)) {
            fail(error, ERROR_USAGE, "bad part '%.*s' in {--%s}: '%.*s' names nothing of a surface",
                 text_shown(naming->item), naming->item.start, naming->option, text_shown(all),
                 all.start);
            return error_hint(error, "all-R varies all radii, all-t all gaps between surfaces");
        }
        size_t end = lens->surface_count - (what.kind == PARAMETER_THICKNESS ? 1 : 0);
        return vary_check_kind(naming, what, error) && vary_add_range(naming, what, end, error);
    }
    return read_parameter(naming, name, &what, error) && vary_check_kind(naming, what, error) &&
           add_parameter(naming, what, error);
}

static bool vary_read_items(struct vary_parser *naming, const char *list, struct error *error)
{
    struct text rest = text_of(list);
    while (rest.start != NULL) {
        /* the next item of a list: commas inside of brackets belong to it */
        size_t length = 0;
        int depth = 0;
        while (length < rest.length && (rest.start[length] != ',' || depth > 0)) {
            depth += (rest.start[length] == '[') - (rest.start[length] == ']');
            length++;
        }
        const struct text item = {rest.start, length};
        rest = length < rest.length
                   ? (struct text){rest.start + length + 1, rest.length - length - 1}
                   : (struct text){NULL, 0};
        if (!vary_read_item(naming, text_trim(item), error)) {
            return false;
        }
    }
    return true;
}

static void set_mark(struct variable *variable, const struct vary *mark)
{
    variable->place = mark->place;
    if (mark->has_bounds) {
        variable->low = mark->low.value.hi;
        variable->high = mark->high.value.hi;
    }
}

static void hand_out(const struct vary_parser *naming, struct variable **list, size_t *count)
{
    *list = ARENA_ARRAY(naming->reader->arena, naming->count + 1, struct variable);
    *count = naming->count;
    for (size_t i = 0; i < naming->count; i++) {
        (*list)[i] = naming->entries[i].variable;
    }
}

static bool vary_add_marks(struct vary_parser *naming, const char **ignored, struct error *error)
{
    const struct vary_reader *reader = naming->reader;
    const struct lens *lens = reader->lens;
    *ignored = NULL;
    for (size_t i = 0; i < lens->surface_count; i++) {
        for (size_t j = 0; j < lens->surfaces[i].vary_count; j++) {
            const struct vary *mark = &lens->surfaces[i].varies[j];
            const struct parameter what = {i, mark->kind, mark->order};
            if (!vary_takes(reader, mark->kind)) {
                *ignored = arena_printf(
                    reader->arena, "%s%s%s~ of surface %zu", *ignored != NULL ? *ignored : "",
                    *ignored != NULL ? ", " : "",
                    parameter_mark_name(what.kind, what.order, reader->arena), what.surface + 1);
                continue;
            }
            const size_t before = naming->count;
            if (!add_parameter(naming, what, error)) {
                return false;
            }
            for (size_t k = before; k < naming->count; k++) { /* of a glass two numbers */
                set_mark(&naming->entries[k].variable, mark);
            }
        }
    }
    for (size_t i = 0; i < lens->variable_count; i++) {
        const struct vary *const *marks = lens->variables[i].varies;
        for (size_t p = 0; p < lens->position_count && marks != NULL; p++) {
            size_t before = naming->count;
            if (marks[p] != NULL && !vary_add_word(naming, i, p, error)) {
                return false;
            }
            if (marks[p] != NULL) {
                set_mark(&naming->entries[before].variable, marks[p]);
            }
        }
    }
    return true;
}

bool vary_marks(const struct vary_reader *reader, struct variable **list, size_t *count,
                const char **ignored, struct error *error)
{
    struct vary_parser naming = {.reader = reader};
    if (!vary_add_marks(&naming, ignored, error)) {
        return false;
    }
    hand_out(&naming, list, count);
    return true;
}

/* Take what is held out of the list. */
static bool hold_items(struct vary_parser *naming, const char *hold, struct error *error)
{
    struct vary_parser held = {.reader = naming->reader, .option = "hold"};
    if (!vary_read_items(&held, hold, error)) {
        return false;
    }
    for (size_t i = 0; i < held.count; i++) {
        const struct vary_entry *entry = &held.entries[i];
        size_t kept = 0;
        for (size_t j = 0; j < naming->count; j++) {
            const struct variable *is = &naming->entries[j].variable;
            bool same = is->position == entry->variable.position &&
                        parameter_is_same(is->what, entry->variable.what);
            if (!same) {
                naming->entries[kept++] = naming->entries[j];
            }
        }
        if (kept == naming->count && !entry->is_group) {
            return fail(error, ERROR_USAGE, "{--hold} names %s, which does not vary",
                        entry->variable.name);
        }
        naming->count = kept;
    }
    return true;
}

bool vary_list(const struct vary_reader *reader, const char *vary, const char *hold,
               struct variable **list, size_t *count, struct error *error)
{
    const char *option = reader->option != NULL ? reader->option : "vary";
    struct vary_parser naming = {.reader = reader, .option = vary != NULL ? option : NULL};
    const char *ignored;
    if (!(vary != NULL ? vary_read_items(&naming, vary, error)
                       : vary_add_marks(&naming, &ignored, error))) {
        return false;
    }
    if (naming.count == 0) {
        return fail(error, ERROR_DOMAIN,
                    "nothing may change: give {--vary}, or mark R~ and t~ in the lens");
    }
    if (hold != NULL && !hold_items(&naming, hold, error)) {
        return false;
    }
    if (naming.count == 0) {
        return fail(error, ERROR_DOMAIN, "nothing may change: {--hold} holds all that varies");
    }
    hand_out(&naming, list, count);
    return true;
}
