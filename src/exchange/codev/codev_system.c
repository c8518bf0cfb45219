/* exchange/codev/codev_system.c - the whole lens of a .seq: light, fields, positions. */
/* SPDX-License-Identifier: MIT */
#include "exchange/codev/codev.h"

#include "exchange/codev/codev_system.h"
#include "file/decimal.h"

#include "file/lens_unit.h"

#include <math.h>
#include <string.h>

static const struct number_scale plain = {1, 0};

static struct text without_quotes(struct text text)
{
    bool is_quoted = text.length > 1 && text.start[0] == '"' && text.start[text.length - 1] == '"';
    return is_quoted ? (struct text){text.start + 1, text.length - 2} : text;
}

/* A title as the name of a position, which is one word; one that cannot be a name is left out. */
static void name_position(struct codev *codev, size_t position, struct text title)
{
    struct lens *lens = codev->build.lens;
    char *name = arena_string(codev->job->arena, title.start, title.length);
    for (char *at = name; *at != '\0'; at++) {
        *at = strchr(" \t#\"", *at) != NULL ? '-' : *at;
    }
    if (name[0] != '\0' && !text_same(text_of(name), "all") &&
        lens_position_find(lens, text_of(name)) == LENS_NONE) {
        lens->positions[position] = name;
    }
}

bool codev_title(struct codev *codev, int what, struct error *error)
{
    (void)what;
    struct codev_qualifiers qualifiers;
    struct lens *lens = codev->build.lens;
    if (!codev_qualifiers(codev, 1, &qualifiers, error)) {
        return false;
    }
    struct text title = without_quotes(commands_word(&codev->commands, qualifiers.next).text);
    if (qualifiers.zoom == 0 || (qualifiers.zoom == 1 && lens->position_count == 0)) {
        lens->title = title.length > 0 ? arena_string(codev->job->arena, title.start, title.length)
                                       : lens->title;
        return true;
    }
    if (qualifiers.zoom > lens->position_count) {
        return commands_fail(&codev->commands, &codev->commands.words[0], error,
                             "position %zu of %zu", qualifiers.zoom, lens->position_count);
    }
    name_position(codev, qualifiers.zoom - 1, title);
    return true;
}

bool codev_radius_mode(struct codev *codev, int what, struct error *error)
{
    (void)what;
    const struct text word = commands_word(&codev->commands, 1).text;
    codev->radius_mode = word.length == 0 || (word.start[0] | 32) != 'n';
    codev->mode_is_given = true;
    return commands_end(&codev->commands, 2, error);
}

/* Only the first letter of a word counts. */
const struct foreign_unit codev_units[] = {{"M", "mm"}, {"C", "cm"}, {"I", "in"}, {NULL, NULL}};

bool codev_unit(struct codev *codev, int what, struct error *error)
{
    (void)what;
    const struct command_word word = commands_word(&codev->commands, 1);
    const struct text letter = {word.text.start, word.text.length > 0 ? 1 : 0};
    const char *unit = foreign_unit_named(codev_units, letter);
    if (unit == NULL) {
        return commands_fail(&codev->commands, &word, error, "the unit is one of M, C, I");
    }
    codev->build.lens->unit = unit;
    codev->commands.scale = lens_unit_scale(unit);
    return commands_end(&codev->commands, 2, error);
}

/* WL, WTW: kept until REF is known. */
bool codev_waves(struct codev *codev, int what, struct error *error)
{
    struct commands *commands = &codev->commands;
    struct codev_qualifiers qualifiers;
    if (!codev_qualifiers(codev, 1, &qualifiers, error)) {
        return false;
    }
    size_t count = commands->count - qualifiers.next;
    struct command_word *words = ARENA_ARRAY(commands->job->arena, count + 1, struct command_word);
    for (size_t i = 0; i < count; i++) {
        struct figure figure;
        words[i] = commands->words[qualifiers.next + i];
        if (!commands_figure(commands, qualifiers.next + i, plain,
                             what == 'L' ? "wavelength" : "weight", &figure, error)) {
            return false;
        }
        if (!(figure.value.hi >= (what == 'L' ? 1 : 0) &&
              figure.value.hi <= (what == 'L' ? 1e8 : 1e6))) {
            return commands_fail(commands, &words[i], error,
                                 what == 'L' ? "the wavelength is not within 1 nm to 100 mm"
                                             : "a weight is not below 0");
        }
    }
    *(what == 'L' ? &codev->wavelengths : &codev->weights) = words;
    *(what == 'L' ? &codev->wavelength_count : &codev->weight_count) = count;
    return true;
}

bool codev_reference(struct codev *codev, int what, struct error *error)
{
    (void)what;
    const struct command_word word = commands_word(&codev->commands, 1);
    return commands_count(&codev->commands, &word,
                          &(struct command_count){word.text, "number of the wavelength", 1},
                          &codev->primary, error) &&
           commands_end(&codev->commands, 2, error);
}

static void put_wavelength(struct codev *codev, size_t index)
{
    const struct text nm = codev->wavelengths[index].text;
    struct arena *arena = codev->job->arena;
    double wavelength = 0, weight = 1;
    number_read(nm.start, nm.start + nm.length, (struct number_scale){1, -3}, &wavelength);
    const struct text heavy =
        index < codev->weight_count ? codev->weights[index].text : text_of("1");
    number_read(heavy.start, heavy.start + heavy.length, plain, &weight);
    struct lens_wavelength *one = lens_build_wavelength(&codev->build, wavelength, weight);
    one->typed = text_of(arena_printf(arena, "%.*snm", (int)nm.length, nm.start));
    if (weight != 1) {
        one->weight_typed = heavy;
    }
}

static bool finish_waves(struct codev *codev, struct error *error)
{
    size_t primary = codev->primary > 0 ? codev->primary - 1 : (codev->wavelength_count - 1) / 2;
    if (codev->wavelength_count == 0) {
        return true;
    }
    if (primary >= codev->wavelength_count) {
        fail(error, ERROR_DATA, "REF names wavelength %zu of %zu", primary + 1,
             codev->wavelength_count);
        return error_locate(error, codev->job->source, codev->wavelengths[0].number, 0);
    }
    put_wavelength(codev, primary);
    for (size_t i = 0; i < codev->wavelength_count; i++) {
        if (i != primary) {
            put_wavelength(codev, i);
        }
    }
    return true;
}

static const struct {
    char letter;
    enum aperture_kind kind;
} apertures[] = {{'E', APERTURE_EPD}, {'F', APERTURE_FNUMBER}, {'O', APERTURE_NA}};

/* EPD, FNO, NAO; NA in the image is the f-number 1/(2 NA). */
static bool read_aperture(struct codev *codev, int what, size_t word, struct figure *figure,
                          struct error *error)
{
    struct commands *commands = &codev->commands;
    if (!commands_figure(commands, word, what == 'E' ? commands->scale : plain, "aperture", figure,
                         error)) {
        return false;
    }
    if (!(figure->value.hi > 0)) {
        return commands_fail(commands, &commands->words[word], error,
                             "the aperture must be above 0");
    }
    if (what == 'N') {
        struct pair twice = {2 * figure->value.hi, 2 * figure->value.lo};
        *figure = figure_computed(pair_divide(pair_of(1), twice), plain, codev->job->arena);
    }
    return true;
}

bool codev_aperture_of_lens(struct codev *codev, int what, struct error *error)
{
    struct lens *lens = codev->build.lens;
    struct codev_qualifiers qualifiers;
    struct figure figure;
    if (!codev_qualifiers(codev, 1, &qualifiers, error) ||
        !read_aperture(codev, what, qualifiers.next, &figure, error) ||
        !commands_end(&codev->commands, qualifiers.next + 1, error)) {
        return false;
    }
    if (qualifiers.zoom > 1) {
        return commands_lose(&codev->commands, error,
                             "an aperture of position %zu alone: write ZOO EPD", qualifiers.zoom);
    }
    lens->aperture = figure;
    lens->aperture_kind = APERTURE_FNUMBER;
    for (size_t i = 0; i < sizeof apertures / sizeof apertures[0]; i++) {
        lens->aperture_kind = what == apertures[i].letter ? apertures[i].kind : lens->aperture_kind;
    }
    return true;
}

/* XAN YAN XOB YOB XIM YIM XRI YRI: x in the kind's capital, y in its small letter; WTF: w */
bool codev_fields(struct codev *codev, int what, struct error *error)
{
    struct commands *commands = &codev->commands;
    struct lens *lens = codev->build.lens;
    struct codev_qualifiers qualifiers;
    char kind = (char)(what | 32);
    int row = kind == 'w' ? CODEV_FIELD_WEIGHTS : what >= 'a';
    if (!codev_qualifiers(codev, 1, &qualifiers, error)) {
        return false;
    }
    size_t count = commands->count - qualifiers.next;
    struct figure *fields = ARENA_ARRAY(commands->job->arena, count + 1, struct figure);
    const struct number_scale scale = kind == 'a' || kind == 'w' ? plain : commands->scale;
    for (size_t i = 0; i < count; i++) {
        if (!commands_figure(commands, qualifiers.next + i, scale,
                             kind == 'w' ? "field's weight" : "field", &fields[i], error)) {
            return false;
        }
    }
    if (qualifiers.zoom > 1 || qualifiers.field > 0) {
        return commands_lose(&codev->commands, error,
                             "a field of one position or of one number alone");
    }
    if (kind != 'w') {
        lens->field_kind = kind == 'a'   ? FIELD_ANGLE
                           : kind == 'o' ? FIELD_HEIGHT
                           : kind == 'i' ? FIELD_IMAGE
                                         : FIELD_REAL;
    }
    codev->fields[row] = fields;
    codev->field_count[row] = count;
    codev->fields_at[row] = commands->words[0];
    return true;
}

/* One point of the field from its place in each of the lists. */
static bool finish_field(struct codev *codev, size_t at, struct error *error)
{
    struct lens_field *field = lens_build_field(&codev->build);
    for (int row = 0; row < CODEV_FIELD_WEIGHTS; row++) {
        field->at[row] = at < codev->field_count[row] ? codev->fields[row][at] : field->at[row];
    }
    const char *wrong =
        codev->build.lens->field_kind == FIELD_ANGLE ? lens_field_from_degrees(field) : NULL;
    if (wrong != NULL) {
        const int row = at < codev->field_count[1];
        return commands_fail(&codev->commands, &codev->fields_at[row], error, "field %zu: %s",
                             at + 1, wrong);
    }
    if (at < codev->field_count[CODEV_FIELD_WEIGHTS]) {
        const struct figure *weight = &codev->fields[CODEV_FIELD_WEIGHTS][at];
        field->weight = weight->value.hi;
        field->weight_typed = field->weight != 1 ? weight->typed : field->weight_typed;
    }
    return field->weight >= 0 ||
           commands_fail(&codev->commands, &codev->fields_at[CODEV_FIELD_WEIGHTS], error,
                         "a weight is not below 0");
}

static bool finish_fields(struct codev *codev, struct error *error)
{
    const size_t x = codev->field_count[0], y = codev->field_count[1];
    for (size_t i = 0; i < x || i < y; i++) {
        if (!finish_field(codev, i, error)) {
            return false;
        }
    }
    return true;
}

static bool set_positions(struct codev *codev, struct error *error)
{
    struct lens *lens = codev->build.lens;
    const struct command_word word = codev->commands.words[1];
    size_t count;
    if (!commands_count(&codev->commands, &word,
                        &(struct command_count){word.text, "number of positions", 1}, &count,
                        error) ||
        !commands_end(&codev->commands, 2, error)) {
        return false;
    }
    if (lens->position_count > 0 || count > CODEV_MOST_VALUES) {
        return commands_fail(&codev->commands, &word, error,
                             lens->position_count > 0 ? "ZOO stands here twice"
                                                      : "more than 100 positions");
    }
    lens->position_count = count > 1 ? count : 0;
    lens->positions = ARENA_ARRAY(codev->job->arena, count, const char *);
    for (size_t i = 0; i < count; i++) {
        lens->positions[i] = arena_printf(codev->job->arena, "z%zu", i + 1);
    }
    return true;
}

bool codev_values(struct codev *codev, const struct codev_qualifiers *qualifiers,
                  const struct figure *usual, const struct figure **values, bool double_them,
                  struct error *error)
{
    struct commands *commands = &codev->commands;
    struct arena *arena = codev->job->arena;
    size_t positions = codev->build.lens->position_count;
    size_t given = commands->count - qualifiers->next;
    struct figure *all = ARENA_ARRAY(arena, positions + 1, struct figure);
    if (positions == 0 || qualifiers->zoom > positions ||
        (given != (qualifiers->zoom > 0 ? 1 : positions))) {
        return commands_fail(commands, &commands->words[0], error, "%zu numbers for %zu positions",
                             given, positions);
    }
    for (size_t i = 0; i < positions; i++) {
        bool is_read = qualifiers->zoom == 0 || qualifiers->zoom == i + 1;
        size_t word = qualifiers->next + (qualifiers->zoom == 0 ? i : 0);
        if (is_read && !commands_figure(commands, word, commands->scale, "value", &all[i], error)) {
            return false;
        }
        if (is_read && double_them) {
            all[i] = sequence_diameter(&all[i], arena);
        } else if (!is_read) {
            all[i] = *values != NULL ? (*values)[i] : *usual;
        }
    }
    *values = all;
    return true;
}

static bool zoom_aperture(struct codev *codev, int what, struct error *error)
{
    struct lens *lens = codev->build.lens;
    struct commands *commands = &codev->commands;
    size_t count = commands->count - 2;
    if (count == 0) {
        return true;
    }
    if (count != lens->position_count) {
        return commands_fail(commands, &commands->words[1], error, "%zu numbers for %zu positions",
                             count, lens->position_count);
    }
    struct figure *all = ARENA_ARRAY(codev->job->arena, count, struct figure);
    for (size_t i = 0; i < count; i++) {
        if (!read_aperture(codev, what, i + 2, &all[i], error)) {
            return false;
        }
    }
    lens->apertures = all;
    return true;
}

/* Numbers of a surface in positions: of a thickness or a diameter, or none that differs. */
static bool zoom_surface(struct codev *codev, char kind, struct error *error)
{
    struct codev_qualifiers qualifiers;
    struct commands *commands = &codev->commands;
    if (!codev_qualifiers(codev, 2, &qualifiers, error)) {
        return false;
    }
    if (codev->sequence.count == 0) {
        return commands_fail(commands, &commands->words[0], error,
                             "positions of a surface before the first surface");
    }
    bool is_list = qualifiers.next < commands->count;
    struct sequence_surface *surface = &codev->sequence.surfaces[qualifiers.surface];
    if (kind != 0) {
        return !is_list || codev_values(codev, &qualifiers,
                                        kind == 't' ? &surface->thickness : &surface->diameter,
                                        kind == 't' ? &surface->thicknesses : &surface->diameters,
                                        kind == 'c', error);
    }
    const struct text word = commands_word(commands, 1).text;
    return (is_list && codev_is_zero(codev, qualifiers.next)) ||
           commands_lose(&codev->commands, error,
                         "'%.*s' in positions: only thicknesses, diameters and "
                         "apertures change with them",
                         (int)(word.length < 20 ? word.length : 20), word.start);
}

bool codev_zoom(struct codev *codev, int what, struct error *error)
{
    (void)what;
    static const struct {
        const char *name;
        char what;
    } names[] = {{"TIT", ' '}, {"EPD", 'E'}, {"FNO", 'F'}, {"NAO", 'O'},
                 {"NA", 'N'},  {"THI", 't'}, {"CIR", 'c'}};
    const struct text word = commands_word(&codev->commands, 1).text;
    char kind = 0;
    if (word.length > 0 && word.start[0] >= '0' && word.start[0] <= '9') {
        return set_positions(codev, error);
    }
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        kind = text_same(word, names[i].name) ? names[i].what : kind;
    }
    if (kind == ' ' || (kind == 0 && codev_is_harmless(word))) {
        return true;
    }
    return kind >= 'A' && kind <= 'Z' ? zoom_aperture(codev, kind, error)
                                      : zoom_surface(codev, kind, error);
}

static const struct pickup_name {
    const char *name;
    enum sequence_what what;
} pickup_names[] = {{"RDY", SEQUENCE_RADIUS},    {"CUY", SEQUENCE_CURVATURE},
                    {"THI", SEQUENCE_THICKNESS}, {"CIR", SEQUENCE_DIAMETER},
                    {"K", SEQUENCE_CONIC},       {"GLA", SEQUENCE_MEDIUM}};

static const struct pickup_name *pickup_named(struct text word)
{
    for (size_t i = 0; i < sizeof pickup_names / sizeof pickup_names[0]; i++) {
        if (text_same(word, pickup_names[i].name)) {
            return &pickup_names[i];
        }
    }
    return NULL;
}

/* The scale and offset behind a pick-up, where there are any. */
static bool read_change(struct codev *codev, size_t first, struct sequence_pickup *pickup,
                        struct error *error)
{
    struct commands *commands = &codev->commands;
    struct figure numbers[2] = {{.value = {1, 0}}, {.value = {0, 0}}};
    bool is_length = pickup->what == SEQUENCE_RADIUS || pickup->what == SEQUENCE_THICKNESS;
    for (size_t i = 0; i < 2 && first + i < commands->count; i++) {
        if (!commands_figure(commands, first + i, i == 1 && is_length ? commands->scale : plain,
                             i == 0 ? "scale" : "offset", &numbers[i], error)) {
            return false;
        }
    }
    if (pickup->what == SEQUENCE_CURVATURE) {
        sequence_per_length(commands, 1, &numbers[1]);
    }
    pickup->scale = numbers[0].value;
    pickup->offset = numbers[1].value;
    return true;
}

/* PIK RDY S4 Z1 RDY S2 Z1 -1.0 0.5 */
bool codev_pickup(struct codev *codev, int what, struct error *error)
{
    (void)what;
    struct commands *commands = &codev->commands;
    const struct pickup_name *name = pickup_named(commands_word(commands, 1).text);
    struct codev_qualifiers to, from;
    if (name == NULL) {
        return commands_lose(&codev->commands, error,
                             "a pick-up that is not known" LOSS_INSTEAD
                             "the number of the file stands");
    }
    if (!codev_qualifiers(codev, 2, &to, error) ||
        !codev_qualifiers(codev, to.next + 1, &from, error)) {
        return false;
    }
    if (!text_same(commands_word(commands, to.next).text, name->name) || to.zoom > 1 ||
        from.zoom > 1) {
        return commands_lose(&codev->commands, error,
                             "a pick-up between unlike numbers or positions");
    }
    struct sequence_pickup pickup = {
        .what = name->what, .target = to.surface, .source = from.surface, .at = commands->words[0]};
    if (!read_change(codev, from.next, &pickup, error)) {
        return false;
    }
    sequence_pick_up(&codev->sequence, pickup);
    return commands_end(commands, from.next + 2, error);
}

bool codev_finish_system(struct codev *codev, struct error *error)
{
    struct lens *lens = codev->build.lens;
    if (!finish_waves(codev, error) || !finish_fields(codev, error)) {
        return false;
    }
    if (lens->apertures != NULL && lens->aperture_kind == APERTURE_NONE) {
        fail(error, ERROR_DATA, "an aperture in positions, but none of the lens itself");
        return error_locate(error, codev->job->source, 0, 0);
    }
    return true;
}
