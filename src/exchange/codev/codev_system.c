/* exchange/codev/codev_system.c - the whole lens of a .seq: light, fields, positions. */
/* SPDX-License-Identifier: MIT */
#include "exchange/codev/codev.h"

#include "file/decimal.h"

#include "file/lens_unit.h"

#include <math.h>
#include <string.h>

bool codev_title(struct codev *codev)
{
    struct lens *lens = codev->build.lens;
    struct text title = commands_word(&codev->commands, codev->here.next).text;
    if (title.length > 1 && title.start[0] == '"' && title.start[title.length - 1] == '"') {
        title = (struct text){title.start + 1, title.length - 2};
    }
    if (codev->here.zoom == 0 || (codev->here.zoom == 1 && codev->positions == 0)) {
        lens->title = title.length > 0 ? lens_build_string(&codev->build, title) : lens->title;
        return true;
    }
    if (codev->here.zoom > codev->positions) {
        return commands_fail(&codev->commands, &codev->commands.words[0], "position %zu of %zu",
                             codev->here.zoom, codev->positions);
    }
    /* the name of a position is one word: a title that cannot be made one is left out */
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
        codev->names[codev->here.zoom - 1] = name;
    }
    return true;
}

bool codev_radius_mode(struct codev *codev)
{
    const struct text word = commands_word(&codev->commands, 1).text;
    codev->radius_mode = word.length == 0 || (word.start[0] | 32) != 'n';
    codev->mode_is_given = true;
    return commands_end(&codev->commands, 2);
}

/* Only the first letter of a word counts. */
const struct foreign_unit codev_units[] = {{"M", "mm"}, {"C", "cm"}, {"I", "in"}, {NULL, NULL}};

bool codev_unit(struct codev *codev)
{
    const struct command_word word = commands_word(&codev->commands, 1);
    const struct text letter = {word.text.start, word.text.length > 0 ? 1 : 0};
    const char *unit = foreign_unit_named(codev_units, letter);
    if (unit == NULL) {
        return commands_fail(&codev->commands, &word, "the unit is one of M, C, I");
    }
    codev->build.lens->unit = unit;
    codev->commands.scale = lens_unit_scale(unit);
    return commands_end(&codev->commands, 2);
}

/* WTW W2 0.5: one of the list. */
static bool codev_set_wave(struct codev *codev, bool is_length, struct command_word one)
{
    static const char usual[] = "1";
    while (codev->wavelength_count > codev->weight_count && !is_length) { /* not given: 1 */
        *ARENA_ADD(codev->job->arena, codev->weights, codev->weight_count, codev->weight_room) =
            (struct command_word){.text = text_of(usual)};
    }
    struct command_word *all = is_length ? codev->wavelengths : codev->weights;
    const size_t known = is_length ? codev->wavelength_count : codev->weight_count;
    if (codev->here.wave > known || codev->commands.count != 3) {
        return commands_fail(&codev->commands, &codev->commands.words[0], "wavelength %zu of %zu",
                             codev->here.wave, known);
    }
    all[codev->here.wave - 1] = one;
    return true;
}

/* WL, WTW: kept until REF is known. */
bool codev_waves(struct codev *codev)
{
    const bool is_length = codev->what == 'L';
    const double least = is_length ? 1 : 0, most = is_length ? 1e8 : 1e6;
    struct commands *commands = &codev->commands;
    size_t count = commands->count - codev->here.next;
    struct command_word *words = ARENA_ARRAY(commands->job->arena, count + 1, struct command_word);
    for (size_t i = 0; i < count; i++) {
        struct figure figure;
        words[i] = commands->words[codev->here.next + i];
        if (!commands_figure(commands, codev->here.next + i, false,
                             is_length ? "wavelength" : "weight", &figure)) {
            return false;
        }
        if (!(figure.value.hi >= least && figure.value.hi <= most)) {
            return commands_fail(commands, &words[i],
                                 is_length ? "the wavelength is not within 1 nm to 100 mm"
                                           : "a weight is not below 0");
        }
    }
    if (codev->here.wave > 0) {
        return codev_set_wave(codev, is_length, words[0]);
    }
    if (is_length) {
        codev->wavelengths = words;
        codev->wavelength_count = count;
    } else {
        codev->weights = words;
        codev->weight_count = count;
        codev->weight_room = 0;
    }
    return true;
}

bool codev_reference(struct codev *codev)
{
    const struct command_word word = commands_word(&codev->commands, 1);
    return commands_count(&codev->commands, &word, word.text, "number of the wavelength", 1,
                          &codev->primary) &&
           commands_end(&codev->commands, 2);
}

static bool codev_put_light(struct codev *codev)
{
    size_t primary = codev->primary > 0 ? codev->primary - 1 : (codev->wavelength_count - 1) / 2;
    if (codev->wavelength_count == 0) {
        return true;
    }
    if (primary >= codev->wavelength_count) {
        struct error *error = codev->commands.error;
        return fail_in(error, codev->job->source, codev->wavelengths[0].number, 0,
                       "REF names wavelength %zu of %zu", primary + 1, codev->wavelength_count);
    }
    for (size_t i = 0; i < codev->wavelength_count; i++) {
        const size_t at = i == 0 ? primary : i - (i <= primary);
        sequence_add_wave(&codev->sequence, codev->wavelengths[at].text, "nm",
                          at < codev->weight_count ? codev->weights[at].text : text_of("1"));
    }
    return true;
}

/* EPD, FNO, NAO; NA in the image is the f-number 1/(2 NA). */
bool codev_aperture_of_lens(struct codev *codev)
{
    struct lens *lens = codev->build.lens;
    struct commands *commands = &codev->commands;
    const size_t word = codev->here.next;
    struct figure figure;
    if (!commands_figure(commands, word, codev->what == APERTURE_EPD, "aperture", &figure)) {
        return false;
    }
    if (!(figure.value.hi > 0)) {
        return commands_fail(commands, &commands->words[word], "the aperture must be above 0");
    }
    if (codev->what == CODEV_IMAGE_NA) {
        struct pair twice = {2 * figure.value.hi, 2 * figure.value.lo};
        lens->aperture_kind = APERTURE_FNUMBER;
        lens->aperture =
            figure_computed(pair_divide(pair_of(1), twice), NUMBER_UNSCALED, codev->job->arena);
    } else {
        lens->aperture_kind = (enum aperture_kind)codev->what;
        lens->aperture = figure;
    }
    return commands_end(commands, word + 1);
}

/* YAN F2 8: one of a list, or one more. */
static bool codev_set_field(struct codev *codev, int row, size_t number, const struct figure *field)
{
    const struct command_word *word = &codev->commands.words[0];
    const size_t count = codev->field_count[row], next = count + 1;
    if (codev->commands.count < 3 || number > next || number > CODEV_MOST_VALUES) {
        return commands_fail(&codev->commands, word, "field %zu, where %zu are listed", number,
                             count);
    }
    struct figure *all = ARENA_COPY(codev->job->arena, codev->fields[row], count, 1);
    all[number - 1] = *field;
    codev->fields[row] = all;
    codev->field_count[row] = number > count ? number : count;
    codev->fields_at[row] = *word;
    return true;
}

/* XAN YAN XOB YOB XIM YIM XRI YRI: x in the kind's capital, y in its small letter; WTF: w */
bool codev_fields(struct codev *codev)
{
    static const char kinds[] = {
        [FIELD_ANGLE] = 'a', [FIELD_HEIGHT] = 'o', [FIELD_IMAGE] = 'i', [FIELD_REAL] = 'r'};
    struct commands *commands = &codev->commands;
    struct lens *lens = codev->build.lens;
    char kind = (char)(codev->what | 32);
    int row = kind == 'w' ? CODEV_FIELD_WEIGHTS : codev->what >= 'a';
    size_t count = commands->count - codev->here.next;
    struct figure *fields = ARENA_ARRAY(commands->job->arena, count + 1, struct figure);
    const bool is_length = kind != 'a' && kind != 'w';
    for (size_t i = 0; i < count || i == 0; i++) {
        if (!commands_figure(commands, codev->here.next + i, is_length,
                             kind == 'w' ? "field's weight" : "field", &fields[i])) {
            return false;
        }
    }
    if (codev->here.field > 0) {
        return codev_set_field(codev, row, codev->here.field, &fields[0]) &&
               commands_end(commands, codev->here.next + 1);
    }
    for (int i = 0; i < FIELD_KINDS; i++) {
        lens->field_kind = kind == kinds[i] ? (enum field_kind)i : lens->field_kind;
    }
    codev->fields[row] = fields;
    codev->field_count[row] = count;
    codev->fields_at[row] = commands->words[0];
    return true;
}

/* One point of the field from its place in each of the lists. */
static bool codev_put_field(struct codev *codev, size_t at)
{
    struct lens_field *field = lens_build_field(&codev->build);
    for (int row = 0; row < CODEV_FIELD_WEIGHTS; row++) {
        field->at[row] = at < codev->field_count[row] ? codev->fields[row][at] : field->at[row];
    }
    const char *wrong =
        codev->build.lens->field_kind == FIELD_ANGLE ? lens_field_from_degrees(field) : NULL;
    if (wrong != NULL) {
        return commands_fail(&codev->commands, &codev->fields_at[at < codev->field_count[1]],
                             "field %zu: %s", at + 1, wrong);
    }
    if (at < codev->field_count[CODEV_FIELD_WEIGHTS]) {
        const struct figure *weight = &codev->fields[CODEV_FIELD_WEIGHTS][at];
        field->weight = weight->value.hi;
        field->weight_typed = field->weight != 1 ? weight->typed : field->weight_typed;
    }
    return field->weight >= 0 ||
           commands_fail(&codev->commands, &codev->fields_at[CODEV_FIELD_WEIGHTS],
                         "a weight is not below 0");
}

/* The scale and offset behind a pick-up, where there are any. */
static bool codev_pickup_change(struct codev *codev, size_t first, struct sequence_pickup *pickup)
{
    struct commands *commands = &codev->commands;
    struct figure numbers[2] = {{.value = {1, 0}}, {.value = {0, 0}}};
    bool is_length = pickup->what == SEQUENCE_RADIUS || pickup->what == SEQUENCE_THICKNESS;
    for (size_t i = 0; i < 2 && first + i < commands->count; i++) {
        if (!commands_figure(commands, first + i, i == 1 && is_length, i == 0 ? "scale" : "offset",
                             &numbers[i])) {
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
bool codev_pickup(struct codev *codev)
{
    static const struct {
        const char *name;
        enum sequence_what what;
    } names[] = {{"RDY", SEQUENCE_RADIUS},    {"CUY", SEQUENCE_CURVATURE},
                 {"THI", SEQUENCE_THICKNESS}, {"CIR", SEQUENCE_DIAMETER},
                 {"K", SEQUENCE_CONIC},       {"GLA", SEQUENCE_MEDIUM}};
    enum { NAMES = sizeof names / sizeof names[0] };
    struct commands *commands = &codev->commands;
    const struct text word = commands_word(commands, 1).text;
    size_t at = 0;
    while (at < NAMES && !text_same(word, names[at].name)) {
        at++;
    }
    struct codev_qualifiers to, from;
    if (at == NAMES) {
        return commands_lose(&codev->commands, LOSS_OF_RAYS, "the number in the file is kept",
                             "a pick-up that is not known");
    }
    if (!codev_qualifiers(codev, 2, &to) || !codev_qualifiers(codev, to.next + 1, &from)) {
        return false;
    }
    if (to.zoom > 0 && codev->positions > 0 && to.zoom != codev->position) {
        return true;
    }
    const size_t here = codev->positions > 0 ? codev->position : 1;
    if (!text_same(commands_word(commands, to.next).text, names[at].name) || to.surface != to.end ||
        from.surface != from.end || (to.zoom > 0 && to.zoom != here) ||
        (from.zoom > 0 && from.zoom != here)) {
        return commands_lose(&codev->commands, LOSS_OF_RAYS, NULL,
                             "a pick-up between unlike numbers, ranges or positions");
    }
    struct sequence_pickup pickup = {.what = names[at].what,
                                     .target = to.surface,
                                     .source = from.surface,
                                     .at = commands->words[0]};
    if (!codev_pickup_change(codev, from.next, &pickup)) {
        return false;
    }
    sequence_pick_up(&codev->sequence, pickup);
    return commands_end(commands, from.next + 2);
}

bool codev_finish_system(struct codev *codev)
{
    if (!codev_put_light(codev)) {
        return false;
    }
    for (size_t i = 0; i < codev->field_count[0] || i < codev->field_count[1]; i++) {
        if (!codev_put_field(codev, i)) {
            return false;
        }
    }
    return true;
}
