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
    const char *plain_title = lens_build_string(&codev->build, title);
    char *name = arena_string(codev->job->arena, plain_title, strlen(plain_title));
    bool is_new = name[0] != '\0';
    for (char *at = name; *at != '\0'; at++) {
        *at = strchr(" \t#\"", *at) != NULL ? '-' : *at;
    }
    for (size_t i = 0; i < codev->positions; i++) {
        is_new = is_new && !text_same(text_of(name), codev->names[i]);
    }
    if (is_new && !text_same(text_of(name), "all")) {
        codev->names[position] = name;
    }
}

bool codev_title(struct codev *codev, int what, struct error *error)
{
    (void)what;
    struct lens *lens = codev->build.lens;
    struct text title = without_quotes(commands_word(&codev->commands, codev->here.next).text);
    if (codev->here.zoom == 0 || (codev->here.zoom == 1 && codev->positions == 0)) {
        lens->title = title.length > 0 ? lens_build_string(&codev->build, title) : lens->title;
        return true;
    }
    if (codev->here.zoom > codev->positions) {
        return commands_fail(&codev->commands, &codev->commands.words[0], error,
                             "position %zu of %zu", codev->here.zoom, codev->positions);
    }
    name_position(codev, codev->here.zoom - 1, title);
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

/* WTW W2 0.5: one of the list. */
static bool put_wave(struct codev *codev, bool is_length, size_t number, struct command_word one,
                     struct error *error)
{
    static const char usual[] = "1";
    while (codev->wavelength_count > codev->weight_count && !is_length) { /* not given: 1 */
        codev->weights = arena_grow(codev->job->arena, codev->weights, codev->weight_count,
                                    &codev->weight_room, sizeof codev->weights[0]);
        codev->weights[codev->weight_count++] = (struct command_word){.text = text_of(usual)};
    }
    struct command_word *all = is_length ? codev->wavelengths : codev->weights;
    const size_t count = is_length ? codev->wavelength_count : codev->weight_count;
    if (number > count || codev->commands.count != 3) {
        return commands_fail(&codev->commands, &codev->commands.words[0], error,
                             "wavelength %zu of %zu", number, count);
    }
    all[number - 1] = one;
    return true;
}

/* WL, WTW: kept until REF is known. */
bool codev_waves(struct codev *codev, int what, struct error *error)
{
    struct commands *commands = &codev->commands;
    size_t count = commands->count - codev->here.next;
    struct command_word *words = ARENA_ARRAY(commands->job->arena, count + 1, struct command_word);
    for (size_t i = 0; i < count; i++) {
        struct figure figure;
        words[i] = commands->words[codev->here.next + i];
        if (!commands_figure(commands, codev->here.next + i, plain,
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
    if (codev->here.wave > 0) {
        return put_wave(codev, what == 'L', codev->here.wave, words[0], error);
    }
    if (what == 'L') {
        codev->wavelengths = words;
        codev->wavelength_count = count;
    } else {
        codev->weights = words;
        codev->weight_count = count;
        codev->weight_room = 0;
    }
    return true;
}

bool codev_reference(struct codev *codev, int what, struct error *error)
{
    (void)what;
    const struct command_word word = commands_word(&codev->commands, 1);
    return commands_count(&codev->commands, &word, word.text, "number of the wavelength", 1,
                          &codev->primary, error) &&
           commands_end(&codev->commands, 2, error);
}

static void codev_system_put_wavelength(struct codev *codev, size_t index)
{
    sequence_add_wave(&codev->sequence, codev->wavelengths[index].text, "nm",
                      index < codev->weight_count ? codev->weights[index].text : text_of("1"));
}

static bool codev_system_finish_waves(struct codev *codev, struct error *error)
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
    codev_system_put_wavelength(codev, primary);
    for (size_t i = 0; i < codev->wavelength_count; i++) {
        if (i != primary) {
            codev_system_put_wavelength(codev, i);
        }
    }
    return true;
}

static const struct {
    char letter;
    enum aperture_kind kind;
} apertures[] = {{'E', APERTURE_EPD}, {'F', APERTURE_FNUMBER}, {'O', APERTURE_NA}};

/* EPD, FNO, NAO; NA in the image is the f-number 1/(2 NA). */
static bool codev_system_read_aperture(struct codev *codev, int what, size_t word,
                                       struct figure *figure, struct error *error)
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
    struct figure figure;
    if (!codev_system_read_aperture(codev, what, codev->here.next, &figure, error) ||
        !commands_end(&codev->commands, codev->here.next + 1, error)) {
        return false;
    }
    lens->aperture = figure;
    lens->aperture_kind = APERTURE_FNUMBER;
    for (size_t i = 0; i < sizeof apertures / sizeof apertures[0]; i++) {
        lens->aperture_kind = what == apertures[i].letter ? apertures[i].kind : lens->aperture_kind;
    }
    return true;
}

/* YAN F2 8: one of a list, or one more. */
static bool codev_system_put_field(struct codev *codev, int row, size_t number,
                                   const struct figure *field, struct error *error)
{
    const struct command_word *word = &codev->commands.words[0];
    const size_t count = codev->field_count[row], next = count + 1;
    if (codev->commands.count < 3 || number > next || number > CODEV_MOST_VALUES) {
        return commands_fail(&codev->commands, word, error, "field %zu, where %zu are listed",
                             number, count);
    }
    struct figure *all = ARENA_ARRAY(codev->job->arena, next, struct figure);
    for (size_t i = 0; i < count; i++) {
        all[i] = codev->fields[row][i];
    }
    all[number - 1] = *field;
    codev->fields[row] = all;
    codev->field_count[row] = number > count ? number : count;
    codev->fields_at[row] = *word;
    return true;
}

/* XAN YAN XOB YOB XIM YIM XRI YRI: x in the kind's capital, y in its small letter; WTF: w */
bool codev_fields(struct codev *codev, int what, struct error *error)
{
    struct commands *commands = &codev->commands;
    struct lens *lens = codev->build.lens;
    char kind = (char)(what | 32);
    int row = kind == 'w' ? CODEV_FIELD_WEIGHTS : what >= 'a';
    size_t count = commands->count - codev->here.next;
    struct figure *fields = ARENA_ARRAY(commands->job->arena, count + 1, struct figure);
    const struct number_scale scale = kind == 'a' || kind == 'w' ? plain : commands->scale;
    for (size_t i = 0; i < count || i == 0; i++) {
        if (!commands_figure(commands, codev->here.next + i, scale,
                             kind == 'w' ? "field's weight" : "field", &fields[i], error)) {
            return false;
        }
    }
    if (codev->here.field > 0) {
        return codev_system_put_field(codev, row, codev->here.field, &fields[0], error) &&
               commands_end(commands, codev->here.next + 1, error);
    }
    if (kind != 'w') {
        if (kind == 'a') {
            lens->field_kind = FIELD_ANGLE;
        } else if (kind == 'o') {
            lens->field_kind = FIELD_HEIGHT;
        } else if (kind == 'i') {
            lens->field_kind = FIELD_IMAGE;
        } else {
            lens->field_kind = FIELD_REAL;
        }
    }
    codev->fields[row] = fields;
    codev->field_count[row] = count;
    codev->fields_at[row] = commands->words[0];
    return true;
}

/* One point of the field from its place in each of the lists. */
static bool codev_system_finish_field(struct codev *codev, size_t at, struct error *error)
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
        if (!codev_system_finish_field(codev, i, error)) {
            return false;
        }
    }
    return true;
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
        return commands_lose(&codev->commands, LOSS_OF_RAYS, "the number in the file is kept",
                             "a pick-up that is not known");
    }
    if (!codev_qualifiers(codev, 2, &to, error) ||
        !codev_qualifiers(codev, to.next + 1, &from, error)) {
        return false;
    }
    if (to.zoom > 0 && codev->positions > 0 && to.zoom != codev->position) {
        return true;
    }
    const size_t here = codev->positions > 0 ? codev->position : 1;
    if (!text_same(commands_word(commands, to.next).text, name->name) || to.surface != to.end ||
        from.surface != from.end || (to.zoom > 0 && to.zoom != here) ||
        (from.zoom > 0 && from.zoom != here)) {
        return commands_lose(&codev->commands, LOSS_OF_RAYS, NULL,
                             "a pick-up between unlike numbers, ranges or positions");
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
    return codev_system_finish_waves(codev, error) && finish_fields(codev, error);
}
