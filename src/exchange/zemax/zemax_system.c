/* exchange/zemax/zemax_system.c - what a .zmx file says of the whole lens, before and behind the surfaces. */
/* SPDX-License-Identifier: MIT */
#include "exchange/zemax/zemax.h"
#include "file/lens_unit.h"
#include "optics/wavelength.h"

#include <math.h>
#include <string.h>

const struct foreign_unit zemax_units[] = {
    {"MM", "mm"}, {"CM", "cm"}, {"IN", "in"}, {"METER", "m"}, {"M", "m"}, {NULL, NULL},
};

static bool zmx_unit(struct zemax_file *file, const struct zemax_line *line)
{
    struct text word = file_words_next(&file->words);
    const char *unit = foreign_unit_named(zemax_units, word);
    (void)line;
    if (unit == NULL) {
        return file_words_fail(&file->words, word, "the unit is one of MM, CM, IN, METER");
    }
    file->build.lens->unit = unit;
    file->words.scale = lens_unit_scale(unit);
    return true;
}

static bool read_mode(struct zemax_file *file, const struct zemax_line *line)
{
    struct text word = file_words_next(&file->words);
    (void)line;
    return text_same(word, "SEQ") ||
           file_words_fail(&file->words, word,
                           "a non-sequential system: lenscalc has lenses whose surfaces follow "
                           "each other");
}

static bool zmx_name(struct zemax_file *file, const struct zemax_line *line)
{
    struct text rest = file_words_rest(&file->words);
    (void)line;
    if (rest.length > 0) {
        file->build.lens->title = lens_build_string(&file->build, rest);
    }
    return true;
}

/* NOTE 0 has the text; other numbers are breaks of its lines. */
static bool zmx_note(struct zemax_file *file, const struct zemax_line *line)
{
    struct text number = file_words_next(&file->words), rest = file_words_rest(&file->words);
    struct text note = text_behind(rest, ZEMAX_KEEP_NOTE),
                names = text_behind(note, ZEMAX_POSITIONS);
    (void)line;
    if (!text_equal(number, "0") || rest.length == 0) {
        return true;
    }
    if (text_equal(note, ZEMAX_OTHER_DISTANCE)) {
        file->has_other_distance = true;
    } else if (names.start != NULL) {
        file->position_names = names;
    } else if (note.start == NULL || !keep_notes_take(&file->notes, note)) {
        lens_build_note(&file->build, rest);
    }
    return true;
}

static bool read_version(struct zemax_file *file, const struct zemax_line *line)
{
    (void)line;
    file->version = file_words_rest(&file->words);
    return true;
}

static bool zmx_catalogs(struct zemax_file *file, const struct zemax_line *line)
{
    (void)line;
    for (struct text word = file_words_next(&file->words);
         word.length > 0 && file->catalog_count < ZEMAX_CATALOGS;
         word = file_words_next(&file->words)) {
        file->catalogs[file->catalog_count++] = word;
    }
    return true;
}

static bool zemax_check_wave(const struct zemax_line *line, size_t at)
{
    double wavelength = zemax_number(line, at);
    return (wavelength >= WAVELENGTH_SHORTEST && wavelength <= WAVELENGTH_LONGEST) ||
           zemax_fail(line, line->numbers[at].typed,
                      "the wavelength is not within 0.001 to 100000 um");
}

/* WAVM number wavelength weight */
static bool zmx_wave(struct zemax_file *file, const struct zemax_line *line)
{
    double number = zemax_number(line, 0);
    if (!(number >= 1 && number < ZEMAX_WAVES) || line->count < 2) {
        return zemax_fail(line, line->keyword,
                          "WAVM needs the number, the wavelength and its weight");
    }
    if (!zemax_check_wave(line, 1)) {
        return false;
    }
    size_t at = (size_t)number - 1;
    const struct figure one = {.value = {1, 0}, .variable = LENS_NONE};
    file->waves[at] = line->numbers[1];
    file->weights[at] = line->count > 2 ? line->numbers[2] : one;
    file->wave_count = file->wave_count > at + 1 ? file->wave_count : at + 1;
    return true;
}

static bool zemax_check_wave_count(const struct zemax_line *line)
{
    return line->count <= ZEMAX_WAVES || zemax_fail(line, line->numbers[ZEMAX_WAVES].typed,
                                                    "more than %d wavelengths", ZEMAX_WAVES);
}

/* WAVL and WAVN have all wavelengths in a row. */
static bool zmx_waves(struct zemax_file *file, const struct zemax_line *line)
{
    if (!zemax_check_wave_count(line)) {
        return false;
    }
    for (size_t i = 0; i < line->count; i++) {
        if (!zemax_check_wave(line, i)) {
            return false;
        }
        file->waves[i] = line->numbers[i];
        if (file->weights[i].typed.start == NULL) {
            file->weights[i].value = pair_of(1);
        }
    }
    file->wave_count = line->count > file->wave_count ? line->count : file->wave_count;
    return true;
}

/* WWGT and WWGN have their weights. */
static bool zmx_weights(struct zemax_file *file, const struct zemax_line *line)
{
    if (!zemax_check_wave_count(line)) {
        return false;
    }
    memcpy(file->weights, line->numbers, line->count * sizeof line->numbers[0]);
    return true;
}

static bool read_primary(struct zemax_file *file, const struct zemax_line *line)
{
    double number = zemax_number(line, 0);
    if (!(number >= 1 && number < ZEMAX_WAVES)) {
        return file_words_fail(&file->words, line->keyword, "PWAV needs a wavelength's number");
    }
    file->primary = (size_t)number - 1;
    return zemax_all_numbers(line);
}

/* VDYN 0 0.1 0.2: how the pupil of each field is shifted, scaled and turned. */
static bool zmx_vignetting(struct zemax_file *file, const struct zemax_line *line)
{
    for (size_t i = 0; i < line->count && file->vignetting == NULL; i++) {
        file->vignetting = line->numbers[i].value.hi != 0 ? line : NULL;
    }
    return true;
}

/*
 * GFAC type factor: 0 is an even pupil, as is a Gaussian, 1, of the factor 0. Another one moves no
 * ray and stops none: a note keeps the weights that the rays have there.
 */
static bool read_apodisation(struct zemax_file *file, const struct zemax_line *line)
{
    double type = zemax_number(line, 0);
    if (type != 0 && !(type == 1 && zemax_number(line, 1) == 0)) {
        zemax_remark(file, "apodisation of the pupil, GFAC %g %g: here its rays weigh the same",
                     type, zemax_number(line, 1));
    }
    return true;
}

/* ENVD temperature pressure adjust */
static bool zmx_environment(struct zemax_file *file, const struct zemax_line *line)
{
    (void)file;
    return zemax_number(line, 2) == 0 ||
           (zemax_number(line, 0) > -273.15 && zemax_number(line, 1) >= 0) ||
           zemax_fail(line, line->keyword,
                      "ENVD needs a temperature above -273.15 C and a pressure of 0 or more "
                      "atmospheres");
}

#define KEPT(member) ZEMAX_KEPT(zemax_file, member)
const struct zemax_keyword zemax_system_keywords[] = {
    {"MODE", ZEMAX_ANY_WORDS, false, 0, read_mode},
    {"UNIT", ZEMAX_ANY_WORDS, false, 0, zmx_unit},
    {"NAME", ZEMAX_ANY_WORDS, false, 0, zmx_name},
    {"NOTE", ZEMAX_ANY_WORDS, false, 0, zmx_note},
    {"GCAT", ZEMAX_ANY_WORDS, false, 0, zmx_catalogs},
    {"ENPD", ZEMAX_A_NUMBER, true, KEPT(aperture), NULL},
    {"FNUM OBNA", ZEMAX_A_NUMBER, false, KEPT(aperture), NULL},
    {"FLOA", ZEMAX_ALL_NUMBERS, false, KEPT(aperture), NULL},
    {"FTYP", ZEMAX_A_NUMBER, false, KEPT(fields), NULL},
    {"XFLN XFLD", ZEMAX_ALL_NUMBERS, false, KEPT(x), NULL},
    {"YFLN YFLD", ZEMAX_ALL_NUMBERS, false, KEPT(y), NULL},
    {"WAVM", ZEMAX_ALL_NUMBERS, false, 0, zmx_wave},
    {"WAVL WAVN", ZEMAX_ALL_NUMBERS, false, 0, zmx_waves},
    {"WWGT WWGN", ZEMAX_ALL_NUMBERS, false, 0, zmx_weights},
    {"PWAV", ZEMAX_ANY_WORDS, false, KEPT(primary_line), read_primary},
    {"FWGN", ZEMAX_ALL_NUMBERS, false, KEPT(field_weights), NULL},
    {"GFAC", ZEMAX_ALL_NUMBERS, false, 0, read_apodisation},
    {"ENVD", ZEMAX_ALL_NUMBERS, false, KEPT(environment), zmx_environment},
    {"VDXN VDYN VCXN VCYN VANN VDSX VDSY VCSX VCSY VANS ZVDX ZVDY ZVCX ZVCY ZVAN",
     ZEMAX_ALL_NUMBERS, false, 0, zmx_vignetting},
    {"VERS", ZEMAX_ANY_WORDS, false, 0, read_version},
    {NULL, ZEMAX_ANY_WORDS, false, 0, NULL},
};

/* -------- behind the surfaces -------- */

bool zemax_read_configurations(struct zemax_file *file, const struct zemax_line *line)
{
    double count = zemax_number(line, 0);
    if (!zemax_all_numbers(line)) {
        return false;
    }
    if (!(count >= 1 && count <= ZEMAX_CONFIGURATIONS)) {
        return file_words_fail(&file->words, line->keyword,
                               "MNUM needs the number of configurations, 1 to %d",
                               ZEMAX_CONFIGURATIONS);
    }
    file->configurations = (size_t)count;
    file->shown = (size_t)fmax(0, fmin(zemax_number(line, 1), ZEMAX_CONFIGURATIONS));
    file->in_tail = file->has_configurations = true;
    return true;
}

bool zemax_read_setting(struct zemax_file *file, struct text keyword)
{
    const bool is_length = word_list_find("THIC SDIA APMN APMX APDX APDY", keyword) != NULL;
    const struct zemax_line *line = zemax_line_of(file, keyword, NUMBER_UNSCALED);
    if (text_same(keyword, "IGNR") && zemax_number(line, 2) != 0) {
        return zemax_loss(file, line, LOSS_OF_POWER, NULL, "IGNR: a surface that is left out");
    }
    if (text_behind(keyword, "FV").start != NULL) { /* a vignetting factor */
        file->vignetting =
            zemax_number(line, 2) != 0 && file->vignetting == NULL ? line : file->vignetting;
        return true;
    }
    if (file->configurations < 2) {
        return true; /* the only configuration has these values already */
    }
    double surface = zemax_number(line, 0), configuration = zemax_number(line, 1);
    if (line->count < 2 || !(surface >= 0 && surface < FOREIGN_MOST_SURFACES) ||
        !(configuration >= 1 && configuration <= (double)file->configurations)) {
        return file_words_fail(&file->words, keyword,
                               "%.4s needs a surface, a configuration and its value",
                               keyword.start);
    }
    struct zemax_line *own =
        zemax_line_of(file, keyword, is_length ? file->words.scale : NUMBER_UNSCALED);
    struct zemax_setting *setting = ARENA_NEW(file->job->arena, struct zemax_setting);
    *setting = (struct zemax_setting){own, (long)surface, (long)configuration, NULL};
    *file->settings_end = setting;
    file->settings_end = &setting->next;
    return true;
}
