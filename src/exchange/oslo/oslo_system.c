/* exchange/oslo/oslo_system.c - what an OSLO file says of the whole lens, and its glasses. */
/* SPDX-License-Identifier: MIT */
#include "exchange/keep_notes.h"
#include "exchange/oslo/oslo.h"
#include "exchange/own_glass.h"
#include "file/decimal.h"
#include "file/lens_words.h"
#include "optics/wavelength.h"

#include "base/constants.h"
#include "file/lens_unit.h"

#include <math.h>
#include <string.h>

bool oslo_unit(struct oslo *oslo)
{
    struct figure figure;
    if (!commands_figure(&oslo->commands, 1, false, "unit in mm", &figure)) {
        return false;
    }
    const char *legal = "";
    for (size_t i = 0; i < LENS_UNITS; i++) {
        const char *unit = lens_units[i].word;
        if (figure.value.hi == lens_unit_mm(unit)) {
            oslo->build.lens->unit = unit;
            oslo->commands.scale = lens_unit_scale(unit);
            return true;
        }
        legal =
            arena_printf(oslo->job->arena, "%s%s%g", legal, i > 0 ? ", " : "", lens_unit_mm(unit));
    }
    return commands_fail(&oslo->commands, &oslo->commands.words[1],
                         "a unit of %g mm: it is one of %s", figure.value.hi, legal);
}

static bool oslo_check_wave(struct oslo *oslo, size_t word, bool is_weight)
{
    struct figure figure;
    if (!commands_figure(&oslo->commands, word, false, is_weight ? "weight" : "wavelength",
                         &figure)) {
        return false;
    }
    if (is_weight
            ? figure.value.hi >= 0
            : figure.value.hi >= WAVELENGTH_SHORTEST && figure.value.hi <= WAVELENGTH_LONGEST) {
        return true;
    }
    const struct command_word at = commands_word(&oslo->commands, word);
    return commands_fail(&oslo->commands, &at,
                         is_weight ? "a weight is not below 0"
                                   : "the wavelength is not within 1 nm to 100 mm");
}

/* WV a b c, WW 1 1 1 */
bool oslo_waves(struct oslo *oslo)
{
    struct commands *commands = &oslo->commands;
    const bool is_weight = oslo->what != 0;
    size_t count = commands->count - 1;
    if (count > OSLO_MOST_WAVES) {
        return commands_fail(commands, &commands->words[0], "more than %d wavelengths",
                             OSLO_MOST_WAVES);
    }
    struct text *all = is_weight ? oslo->weights : oslo->waves;
    for (size_t i = 0; i < count; i++) {
        all[i] = commands->words[i + 1].text;
        if (!oslo_check_wave(oslo, i + 1, is_weight)) {
            return false;
        }
    }
    size_t *known = is_weight ? &oslo->weight_count : &oslo->wave_count;
    *known = count;
    return true;
}

/* WV2 and WW2: one more, or another one in place of what there is. */
bool oslo_one_wave(struct oslo *oslo)
{
    const bool is_weight = oslo->what != 0;
    const struct command_word *word = &oslo->commands.words[0];
    const struct text digits = {word->text.start + 2, word->text.length - 2};
    size_t *count = is_weight ? &oslo->weight_count : &oslo->wave_count, number;
    if (!commands_count(&oslo->commands, word, digits, "number of the wavelength", 1, &number) ||
        !oslo_check_wave(oslo, 1, is_weight) || !commands_end(&oslo->commands, 2)) {
        return false;
    }
    if (number > *count + 1 || number > OSLO_MOST_WAVES) {
        return commands_fail(&oslo->commands, word, "number %zu behind %zu wavelengths", number,
                             *count);
    }
    struct text *all = is_weight ? oslo->weights : oslo->waves;
    all[number - 1] = oslo->commands.words[1].text;
    *count = number > *count ? number : *count;
    return true;
}

/* May it be the name of a glass before its indices, rather than a number gone wrong? */
static bool names_glass(const struct command_word *word)
{
    const struct text text = word->text;
    return word->is_quoted ||
           (strchr("0123456789+-.", text.start[0]) == NULL && !text_same(text, "nan") &&
            !text_same(text, "inf") && !text_same(text, "infinity"));
}

/* Is it Vd rather than a second index? */
static bool is_abbe(struct text text)
{
    double value = 0;
    text_number(text, NUMBER_UNSCALED, &value);
    return value >= 10;
}

/* The indices at the wavelengths in force; a number before them is the glass's name. */
static bool oslo_indices(struct oslo *oslo, size_t first, bool is_model)
{
    static const struct text usual[] = {{"0.58756", 7}, {"0.48613", 7}, {"0.65627", 7}};
    struct commands *commands = &oslo->commands;
    size_t waves = oslo->wave_count > 0 ? oslo->wave_count : 3;
    size_t count = commands->count - first;
    const struct command_word *word = &commands->words[first];
    const char *written;
    for (size_t i = 0; i < count; i++) {
        struct figure index;
        if (!commands_figure(commands, first + i, false, "index", &index)) {
            return false;
        }
    }
    if (count == waves + 1 && count > 2) {
        first++;
        count--;
    }
    if (count == 1) {
        written = arena_string(oslo->job->arena, word->text.start, word->text.length);
    } else if (is_model && count == 2 && waves != 2 && is_abbe(word[1].text)) {
        written = arena_printf(oslo->job->arena, "%.*s/%.*s", (int)word->text.length,
                               word->text.start, (int)word[1].text.length, word[1].text.start);
    } else if (count != waves) {
        return commands_fail(commands, word, "%zu indices for %zu wavelengths", count, waves);
    } else {
        written = sequence_indices(oslo->job->arena, oslo->wave_count > 0 ? oslo->waves : usual,
                                   "um", &commands->words[first], count);
    }
    return sequence_medium(commands, word, written, &oslo->sequence.surfaces[oslo->surface].medium);
}

/* The glass that lenscalc has kept for this surface, if the file still has its name. */
static bool oslo_kept_glass(const struct oslo *oslo, struct text word, struct foreign_name *named,
                            struct text *catalog)
{
    struct text name = oslo->glasses[oslo->surface], whole = name, rest = word;
    *catalog = text_cut(&name, ':');
    if (name.start == NULL) {
        return false;
    }
    const struct text prefix = text_cut(&rest, '_'); /* of a name that would be a number */
    *named = (struct foreign_name){.name = name, .catalogs = catalog, .catalog_count = 1};
    return whole.length > 0 &&
           (text_same_name(word, name) ||
            (rest.start != NULL && text_same_name(prefix, *catalog) && text_same_name(rest, name)));
}

/*
 * A glass by name; those of Ohara and Hoya have a letter in front, those of Schott have none. False
 * with ERROR_NONE where there is none.
 */
static bool oslo_named_glass(struct oslo *oslo, const struct command_word *word,
                             struct medium *medium)
{
    struct error *error = oslo->commands.error;
    static const struct {
        const char *prefix, *catalog;
    } makers[] = {{"O_", "OHARA"}, {"H_", "HOYA"}, {"", "SCHOTT"}, {"", NULL}};
    const struct file_words place = commands_place(&oslo->commands, word);
    struct foreign_name named;
    struct text catalog;
    bool kept = oslo_kept_glass(oslo, word->text, &named, &catalog);
    if (kept && foreign_glass(oslo->job, &place, &named, medium, error)) {
        return true;
    }
    for (size_t i = 0; i < sizeof makers / sizeof makers[0] && !kept; i++) {
        size_t length = strlen(makers[i].prefix);
        struct text first = {word->text.start, length};
        if (word->text.length <= length || !text_same(first, makers[i].prefix)) {
            continue;
        }
        catalog = text_of(makers[i].catalog != NULL ? makers[i].catalog : "");
        named =
            (struct foreign_name){.name = {word->text.start + length, word->text.length - length},
                                  .catalogs = &catalog,
                                  .catalog_count = makers[i].catalog != NULL};
        if (foreign_glass(oslo->job, &place, &named, medium, error)) {
            return true;
        }
        if (error->code != ERROR_NONE) {
            return false;
        }
    }
    return false;
}

static bool oslo_find_glass(struct oslo *oslo, const struct command_word *word)
{
    const struct file_words place = commands_place(&oslo->commands, word);
    struct medium *medium = &oslo->sequence.surfaces[oslo->surface].medium;
    oslo->commands.error->code = ERROR_NONE;
    if (oslo_named_glass(oslo, word, medium)) {
        return true;
    }
    return oslo->commands.error->code == ERROR_NONE &&
           foreign_lack(oslo->job, &place, word->text, medium,
                        arena_printf(oslo->job->arena, "glass '%.*s' is in no catalogue",
                                     (int)(word->text.length < 60 ? word->text.length : 60),
                                     word->text.start));
}

/* Indices behind a name, which may be that of a catalogue's glass. */
static bool oslo_compare_glass(struct oslo *oslo, const struct command_word *word)
{
    struct error *error = oslo->commands.error;
    static const double usual[] = {WAVELENGTH_D, 0.48613, 0.65627};
    const size_t count = oslo->wave_count > 0 ? oslo->wave_count : 3;
    double *wavelengths = ARENA_ARRAY(oslo->job->arena, count, double);
    struct own_glass own = {.job = oslo->job,
                            .build = &oslo->build,
                            .name = word->text,
                            .wavelengths = wavelengths,
                            .count = count};
    struct figure index;
    struct medium found;
    if (oslo->job->glasses == NULL) {
        return true;
    }
    for (size_t i = 0; i < count; i++) {
        wavelengths[i] = usual[i < 3 ? i : 0];
        if (oslo->wave_count > 0) {
            const struct text um = oslo->waves[i];
            text_number(um, NUMBER_UNSCALED, &wavelengths[i]);
        }
    }
    for (const struct command_word *one = word + 1;
         one < oslo->commands.words + oslo->commands.count; one++) {
        if (!commands_figure(&oslo->commands, (size_t)(one - oslo->commands.words), false, "index",
                             &index)) {
            return false;
        }
        own.rounding = fmax(own.rounding, own_glass_rounding(&index));
    }
    error->code = ERROR_NONE;
    if (oslo_named_glass(oslo, word, &found)) {
        own_glass_compare(&own, &found, &oslo->sequence.surfaces[oslo->surface].medium);
        return true;
    }
    error->code = oslo->job->glass_numbers == GLASS_NUMBERS_CATALOG ? error->code : ERROR_NONE;
    return error->code == ERROR_NONE;
}

bool oslo_glass(struct oslo *oslo)
{
    struct sequence_surface *surface = &oslo->sequence.surfaces[oslo->surface];
    bool is_model = text_same(commands_word(&oslo->commands, 1).text, "MOD");
    size_t first = is_model ? 2 : 1;
    const struct command_word word = commands_word(&oslo->commands, first);
    surface->reflects = false;
    if (word.text.length == 0) {
        return commands_fail(&oslo->commands, &word, "the glass is missing");
    }
    const bool has_indices = first + 1 < oslo->commands.count;
    double number;
    if (text_number(word.text, NUMBER_UNSCALED, &number) || (has_indices && !names_glass(&word))) {
        return oslo_indices(oslo, first, is_model);
    }
    if (has_indices) {
        return oslo_indices(oslo, first + 1, is_model) &&
               oslo_compare_glass(oslo, &oslo->commands.words[first]);
    }
    return oslo_find_glass(oslo, &oslo->commands.words[first]);
}

/* F n y x z yr xr y1 y2 x1 x2 weight: fractions of the field, and limits of the pupil. */
bool oslo_point(struct oslo *oslo)
{
    static const double usual[] = {0, 0, 0, 0, 0, -1, 1, -1, 1};
    struct oslo_point point = {.weight = {.value = {1, 0}}};
    struct figure figure;
    if (oslo->point_count == OSLO_MOST_WAVES) {
        return commands_fail(&oslo->commands, &oslo->commands.words[0],
                             "more than %d points of the field", OSLO_MOST_WAVES);
    }
    if (!commands_figure(&oslo->commands, 2, false, "point of the field", &point.at[1])) {
        return false;
    }
    for (size_t i = 3; i < oslo->commands.count && i < 12; i++) {
        if (!commands_figure(&oslo->commands, i, false, "point of the field", &figure)) {
            return false;
        }
        point.at[0] = i == 3 ? figure : point.at[0];
        point.weight = i == 11 ? figure : point.weight;
        if (i > 3 && i < 11 && figure.value.hi != usual[i - 2]) {
            commands_lose(&oslo->commands, LOSS_OF_RAYS, NULL,
                          "a point of the field with a place or a pupil of its own");
        }
    }
    oslo->points[oslo->point_count++] = point;
    return point.weight.value.hi >= 0 ||
           commands_fail(&oslo->commands, &oslo->commands.words[0], "a weight is not below 0");
}

bool oslo_telecentric(struct oslo *oslo)
{
    const struct command_word word = commands_word(&oslo->commands, 1);
    const bool on = text_same(word.text, "ON") || text_equal(word.text, "1");
    oslo->build.lens->is_telecentric = on;
    return on || text_same(word.text, "OFF") || text_equal(word.text, "0") ||
           commands_fail(&oslo->commands, &word, "expected ON or OFF here");
}

/* The mode of aberrations: AFO of an afocal image, by angles; FOC of one in a plane. */
bool oslo_mode(struct oslo *oslo)
{
    const struct command_word word = commands_word(&oslo->commands, 1);
    oslo->sequence.is_afocal = text_same(word.text, "AFO");
    return oslo->sequence.is_afocal || text_same(word.text, "FOC") || text_same(word.text, "TRA") ||
           commands_lose(&oslo->commands, LOSS_OF_RAYS, NULL,
                         "a mode of aberrations that is not known");
}

/* The fields of a kept note that lenscalc wrote. */
static bool oslo_fields(struct oslo *oslo, struct text line)
{
    struct lens *lens = oslo->build.lens;
    struct file_words words = {.source = oslo->job->source,
                               .error = oslo->commands.error,
                               .line = line,
                               .at = line.start,
                               .scale = oslo->commands.scale,
                               .arena = oslo->job->arena};
    return lens->field_kind == FIELD_NONE ||
           lens_words_fields(&words, lens->field_kind, &lens->fields, &lens->field_count);
}

/* A fraction of the largest field; of an angle that of its tangent. */
static struct figure part_of_field(const struct oslo *oslo, enum field_kind kind,
                                   const struct figure *edge, double fraction)
{
    struct arena *arena = oslo->job->arena;
    if (fraction == 0) {
        return figure_of(0, arena);
    }
    if (fraction == 1) {
        return *edge;
    }
    if (kind == FIELD_ANGLE) {
        struct figure part =
            figure_of(atan(fraction * tan(edge->value.hi)) / RADIANS_PER_DEGREE, arena);
        part.value = pair_multiply(part.value, pair_of(RADIANS_PER_DEGREE));
        return part;
    }
    return figure_computed(pair_multiply(edge->value, pair_of(fraction)), oslo->commands.scale,
                           arena);
}

/* The points of the field; without any its axis and its edge. */
static void oslo_put_fields(struct oslo *oslo, enum field_kind kind, struct figure edge)
{
    oslo->build.lens->field_kind = kind;
    for (size_t i = 0; i < oslo->point_count; i++) {
        const struct oslo_point *point = &oslo->points[i];
        struct lens_field *field = lens_build_field(&oslo->build);
        for (int axis = 0; axis < 2; axis++) {
            field->at[axis] = part_of_field(oslo, kind, &edge, point->at[axis].value.hi);
        }
        if (point->weight.value.hi != 1) {
            field->weight = point->weight.value.hi;
            field->weight_typed = point->weight.typed;
        }
    }
    if (oslo->point_count > 0) {
        return;
    }
    lens_build_field(&oslo->build)->at[1] = figure_of(0, oslo->job->arena);
    if (edge.value.hi != 0) {
        lens_build_field(&oslo->build)->at[1] = edge;
    }
}

void oslo_finish_system(struct oslo *oslo)
{
    struct lens *lens = oslo->build.lens;
    const struct figure *distance = &oslo->sequence.surfaces[0].thickness;
    struct pair units =
        pair_multiply(distance->value, lens_words_per_length(pair_of(1), oslo->commands.scale, 1));
    bool is_infinite = fabs(units.hi) >= oslo->commands.grammar->infinity;
    const bool is_beam = lens->aperture_kind == APERTURE_EPD;
    for (size_t i = 0; i < oslo->wave_count; i++) {
        sequence_add_wave(&oslo->sequence, oslo->waves[i], "um",
                          i < oslo->weight_count ? oslo->weights[i] : text_of("1"));
    }
    /* An object's height at infinity is an angle: tan w = -height/distance. */
    struct figure edge = oslo->field;
    if (oslo->field_is == OSLO_IMAGE) {
        oslo_put_fields(oslo, FIELD_IMAGE, edge);
    } else if (oslo->field_is == OSLO_OBJECT && !is_infinite) {
        oslo_put_fields(oslo, FIELD_HEIGHT, edge);
    } else if (oslo->field_is != OSLO_NO_FIELD) {
        if (oslo->field_is == OSLO_OBJECT) {
            edge = figure_of(atan(-edge.value.hi / oslo->sequence.surfaces[0].thickness.value.hi) /
                                 RADIANS_PER_DEGREE,
                             oslo->job->arena);
        }
        edge.value = pair_multiply(edge.value, pair_of(RADIANS_PER_DEGREE));
        oslo_put_fields(oslo, FIELD_ANGLE, edge);
    }
    if (!is_infinite && (is_beam || lens->aperture_kind == APERTURE_FNUMBER)) {
        oslo->near_aperture = is_beam ? PUPIL_BEAM_RADIUS : PUPIL_WORKING_FNUMBER;
        oslo->near_value = is_beam ? lens->aperture.value.hi / 2 : lens->aperture.value.hi;
        lens->aperture_kind = APERTURE_NONE;
        oslo->sequence.is_open = true;
    } else if (lens->aperture_kind == APERTURE_NA && is_infinite) {
        lens->aperture_kind = APERTURE_NONE;
        commands_loss(&oslo->commands, &oslo->aperture, LOSS_OF_RAYS, NULL,
                      "NAO: a numerical aperture of an object at infinity");
    }
}

void oslo_finish_aperture(struct oslo *oslo)
{
    struct lens *lens = oslo->build.lens;
    if (oslo->near_value > 0 && lens->aperture_kind != APERTURE_STOP &&
        !entrance_pupil_set(lens, oslo->near_aperture, oslo->near_value, oslo->job->arena)) {
        commands_loss(&oslo->commands, &oslo->aperture, LOSS_OF_RAYS, NULL,
                      "%.*s: an aperture that no entrance pupil gives",
                      text_shown(oslo->aperture.text), oslo->aperture.text.start);
    }
}

/* Cut off the number of a surface; FOREIGN_MOST_SURFACES where there is none. */
static size_t cut_surface_number(struct text *rest)
{
    size_t number = 0;
    for (struct text digits = text_cut(rest, ' '); digits.length > 0; digits.length--) {
        bool is_digit = digits.start[0] >= '0' && digits.start[0] <= '9';
        number = is_digit && number < FOREIGN_MOST_SURFACES
                     ? 10 * number + (size_t)(digits.start[0] - '0')
                     : FOREIGN_MOST_SURFACES;
        digits.start++;
    }
    return number < FOREIGN_MOST_SURFACES ? number : FOREIGN_MOST_SURFACES;
}

/* 3 CDGM:H-K9L */
void oslo_kept_glasses(struct oslo *oslo, struct text content)
{
    for (struct text rest = content; rest.start != NULL;) {
        struct text glass =
            text_behind(text_trim(text_cut(&rest, '\n')), OSLO_KEEP_NOTE OSLO_GLASS);
        size_t number = glass.start != NULL ? cut_surface_number(&glass) : FOREIGN_MOST_SURFACES;
        if (number < FOREIGN_MOST_SURFACES && glass.start != NULL) {
            oslo->glasses[number] = glass;
        }
    }
}

/* 3 front: the name of surface 3 */
static void oslo_name_surface(struct oslo *oslo, struct text rest)
{
    size_t number = cut_surface_number(&rest);
    if (number < oslo->sequence.count && rest.length > 0) {
        oslo->sequence.surfaces[number].name = lens_build_string(&oslo->build, rest);
    }
}

bool oslo_keep_notes(struct oslo *oslo, struct text content)
{
    struct lens *lens = oslo->build.lens;
    struct keep_notes notes = {0};
    for (struct text rest = content; rest.start != NULL;) {
        const struct text kept = text_behind(text_trim(text_cut(&rest, '\n')), OSLO_KEEP_NOTE);
        const struct text fields = text_behind(kept, OSLO_FIELDS);
        const struct text name = text_behind(kept, OSLO_NAME);
        if (fields.start != NULL && !oslo_fields(oslo, fields)) {
            return false;
        }
        if (text_equal(kept, OSLO_STOP_RULES)) {
            lens->aperture_kind = APERTURE_STOP;
            lens->aperture = (struct figure){.typed = text_of("stop"), .variable = LENS_NONE};
        } else if (name.start != NULL) {
            oslo_name_surface(oslo, name);
        } else if (kept.start != NULL) {
            keep_notes_take(&notes, kept);
        }
    }
    keep_notes_apply(&notes, &oslo->build);
    return true;
}
