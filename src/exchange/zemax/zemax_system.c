/* exchange/zemax/zemax_system.c - the system of a .zmx file: units, aperture, light. */
/* SPDX-License-Identifier: MIT */
#include "exchange/zemax/zemax_keyword.h"
#include "file/lens_unit.h"

#include "optics/wavelength.h"

#include <math.h>

const struct foreign_unit zemax_units[] = {
    {"MM", "mm"}, {"CM", "cm"}, {"IN", "in"}, {"METER", "m"}, {"M", "m"}, {NULL, NULL},
};

static bool zemax_system_read_unit(struct zemax_file *file, struct text keyword,
                                   struct error *error)
{
    struct text word = file_words_next(&file->words);
    const char *unit = foreign_unit_named(zemax_units, word);
    (void)keyword;
    if (unit == NULL) {
        return file_words_fail(&file->words, word, error, "the unit is one of MM, CM, IN, METER");
    }
    file->build.lens->unit = unit;
    file->words.scale = lens_unit_scale(unit);
    return true;
}

static bool read_mode(struct zemax_file *file, struct text keyword, struct error *error)
{
    struct text word = file_words_next(&file->words);
    (void)keyword;
    return text_same(word, "SEQ") ||
           file_words_fail(&file->words, word, error,
                           "a non-sequential system: lenscalc has lenses whose surfaces follow "
                           "each other");
}

static bool zemax_system_read_name(struct zemax_file *file, struct text keyword,
                                   struct error *error)
{
    struct text rest = file_words_rest(&file->words);
    (void)keyword;
    (void)error;
    if (rest.length > 0) {
        file->build.lens->title = lens_build_string(&file->build, rest);
    }
    return true;
}

/* NOTE 0 has the text; other numbers are breaks of its lines. */
static bool zemax_system_read_note(struct zemax_file *file, struct text keyword,
                                   struct error *error)
{
    struct text number = file_words_next(&file->words), rest = file_words_rest(&file->words);
    (void)keyword;
    (void)error;
    if (!text_equal(number, "0") || rest.length == 0) {
        return true;
    }
    struct text note = text_behind(rest, ZEMAX_KEEP_NOTE),
                names = text_behind(note, ZEMAX_POSITIONS);
    if (text_equal(note, ZEMAX_OTHER_DISTANCE)) {
        file->has_other_distance = true;
        return true;
    }
    if (names.start != NULL) {
        file->position_names = names;
        return true;
    }
    if (note.start != NULL && keep_notes_take(&file->notes, note)) {
        return true;
    }
    lens_build_note(&file->build, rest);
    return true;
}

static bool read_version(struct zemax_file *file, struct text keyword, struct error *error)
{
    (void)keyword;
    (void)error;
    file->version = file_words_rest(&file->words);
    return true;
}

static bool zemax_system_read_catalogs(struct zemax_file *file, struct text keyword,
                                       struct error *error)
{
    (void)keyword;
    (void)error;
    for (struct text word = file_words_next(&file->words);
         word.length > 0 && file->catalog_count < ZEMAX_CATALOGS;
         word = file_words_next(&file->words)) {
        file->catalogs[file->catalog_count++] = word;
    }
    return true;
}

static bool zemax_system_read_aperture(struct zemax_file *file, struct text keyword,
                                       struct error *error)
{
    bool length = text_same(keyword, "ENPD"), none = text_same(keyword, "FLOA");
    file->aperture = zemax_line_of(file, keyword, length ? file->words.scale : NUMBER_UNSCALED);
    return none ? zemax_all_numbers(file->aperture, error)
                : zemax_has_number(file->aperture, error);
}

static bool zemax_system_read_fields(struct zemax_file *file, struct text keyword,
                                     struct error *error)
{
    file->fields = zemax_line_of(file, keyword, NUMBER_UNSCALED);
    return zemax_has_number(file->fields, error);
}

static bool read_x(struct zemax_file *file, struct text keyword, struct error *error)
{
    file->x = zemax_line_of(file, keyword, NUMBER_UNSCALED);
    return zemax_all_numbers(file->x, error);
}

static bool read_y(struct zemax_file *file, struct text keyword, struct error *error)
{
    file->y = zemax_line_of(file, keyword, NUMBER_UNSCALED);
    return zemax_all_numbers(file->y, error);
}

static bool read_field_weights(struct zemax_file *file, struct text keyword, struct error *error)
{
    file->field_weights = zemax_line_of(file, keyword, NUMBER_UNSCALED);
    return zemax_all_numbers(file->field_weights, error);
}

/* WAVM number wavelength weight */
static bool zemax_system_read_wave(struct zemax_file *file, struct text keyword,
                                   struct error *error)
{
    const struct zemax_line *line = zemax_line_of(file, keyword, NUMBER_UNSCALED);
    double number = zemax_number(line, 0), wavelength = zemax_number(line, 1);
    if (!zemax_all_numbers(line, error)) {
        return false;
    }
    if (!(number >= 1 && number < ZEMAX_WAVES) || line->count < 2) {
        return file_words_fail(&line->words, line->keyword, error,
                               "WAVM needs the number, the wavelength and its weight");
    }
    if (!(wavelength >= WAVELENGTH_SHORTEST && wavelength <= WAVELENGTH_LONGEST)) {
        return file_words_fail(&line->words, line->numbers[1].typed, error,
                               "the wavelength is not within 0.001 to 100000 um");
    }
    size_t at = (size_t)number - 1;
    const struct figure one = {.value = {1, 0}, .variable = LENS_NONE};
    file->waves[at] = line->numbers[1];
    file->weights[at] = line->count > 2 ? line->numbers[2] : one;
    file->wave_count = file->wave_count > at + 1 ? file->wave_count : at + 1;
    return true;
}

/* WAVL and WAVN have all wavelengths in a row, WWGT and WWGN their weights. */
static bool zemax_system_read_waves(struct zemax_file *file, struct text keyword,
                                    struct error *error)
{
    const struct zemax_line *line = zemax_line_of(file, keyword, NUMBER_UNSCALED);
    bool weights = text_same(keyword, "WWGT") || text_same(keyword, "WWGN");
    if (!zemax_all_numbers(line, error)) {
        return false;
    }
    if (line->count > ZEMAX_WAVES) {
        return file_words_fail(&line->words, line->numbers[ZEMAX_WAVES].typed, error,
                               "more than %d wavelengths", ZEMAX_WAVES);
    }
    for (size_t i = 0; i < line->count; i++) {
        double value = line->numbers[i].value.hi;
        if (!weights && !(value >= WAVELENGTH_SHORTEST && value <= WAVELENGTH_LONGEST)) {
            return file_words_fail(&line->words, line->numbers[i].typed, error,
                                   "the wavelength is not within 0.001 to 100000 um");
        }
        *(weights ? &file->weights[i] : &file->waves[i]) = line->numbers[i];
        if (!weights && file->weights[i].typed.start == NULL) {
            file->weights[i].value = pair_of(1);
        }
    }
    file->wave_count = !weights && line->count > file->wave_count ? line->count : file->wave_count;
    return true;
}

static bool read_primary(struct zemax_file *file, struct text keyword, struct error *error)
{
    file->primary_line = zemax_line_of(file, keyword, NUMBER_UNSCALED);
    double number = zemax_number(file->primary_line, 0);
    if (!(number >= 1 && number < ZEMAX_WAVES)) {
        return file_words_fail(&file->words, keyword, error, "PWAV needs a wavelength's number");
    }
    file->primary = (size_t)number - 1;
    return zemax_all_numbers(file->primary_line, error);
}

/* VDYN 0 0.1 0.2: how the pupil of each field is shifted, scaled and turned. */
static bool zemax_system_read_vignetting(struct zemax_file *file, struct text keyword,
                                         struct error *error)
{
    const struct zemax_line *line = zemax_line_of(file, keyword, NUMBER_UNSCALED);
    for (size_t i = 0; i < line->count && file->vignetting == NULL; i++) {
        file->vignetting = line->numbers[i].value.hi != 0 ? line : NULL;
    }
    return zemax_all_numbers(line, error);
}

/*
 * GFAC type factor: 0 is an even pupil, as is a Gaussian, 1, of the factor 0. Another one moves no
 * ray and stops none: a note keeps the weights that the rays have there.
 */
static bool read_apodisation(struct zemax_file *file, struct text keyword, struct error *error)
{
    const struct zemax_line *line = zemax_line_of(file, keyword, NUMBER_UNSCALED);
    double type = zemax_number(line, 0);
    if (!zemax_all_numbers(line, error)) {
        return false;
    }
    if (type != 0 && !(type == 1 && zemax_number(line, 1) == 0)) {
        zemax_remark(file, "apodisation of the pupil, GFAC %g %g: here its rays weigh the same",
                     type, zemax_number(line, 1));
    }
    return true;
}

/* ENVD temperature pressure adjust */
static bool zemax_system_read_environment(struct zemax_file *file, struct text keyword,
                                          struct error *error)
{
    const struct zemax_line *line = zemax_line_of(file, keyword, NUMBER_UNSCALED);
    file->environment = line;
    if (!zemax_all_numbers(line, error)) {
        return false;
    }
    return zemax_number(line, 2) == 0 ||
           (zemax_number(line, 0) > -273.15 && zemax_number(line, 1) >= 0) ||
           file_words_fail(&line->words, keyword, error,
                           "ENVD needs a temperature above -273.15 C and a pressure of 0 or more "
                           "atmospheres");
}

const struct zemax_keyword zemax_system_keywords[] = {
    {"MODE", read_mode},
    {"UNIT", zemax_system_read_unit},
    {"NAME", zemax_system_read_name},
    {"NOTE", zemax_system_read_note},
    {"GCAT", zemax_system_read_catalogs},
    {"ENPD", zemax_system_read_aperture},
    {"FNUM", zemax_system_read_aperture},
    {"OBNA", zemax_system_read_aperture},
    {"FLOA", zemax_system_read_aperture},
    {"FTYP", zemax_system_read_fields},
    {"XFLN", read_x},
    {"XFLD", read_x},
    {"YFLN", read_y},
    {"YFLD", read_y},
    {"WAVM", zemax_system_read_wave},
    {"WAVL", zemax_system_read_waves},
    {"WAVN", zemax_system_read_waves},
    {"WWGT", zemax_system_read_waves},
    {"WWGN", zemax_system_read_waves},
    {"PWAV", read_primary},
    {"FWGN", read_field_weights},
    {"GFAC", read_apodisation},
    {"ENVD", zemax_system_read_environment},
    {"VDXN", zemax_system_read_vignetting},
    {"VDYN", zemax_system_read_vignetting},
    {"VCXN", zemax_system_read_vignetting},
    {"VCYN", zemax_system_read_vignetting},
    {"VANN", zemax_system_read_vignetting},
    {"VDSX", zemax_system_read_vignetting},
    {"VDSY", zemax_system_read_vignetting},
    {"VCSX", zemax_system_read_vignetting},
    {"VCSY", zemax_system_read_vignetting},
    {"VANS", zemax_system_read_vignetting},
    {"ZVDX", zemax_system_read_vignetting},
    {"ZVDY", zemax_system_read_vignetting},
    {"ZVCX", zemax_system_read_vignetting},
    {"ZVCY", zemax_system_read_vignetting},
    {"ZVAN", zemax_system_read_vignetting},
    {"VERS", read_version},
    {"VDYN", zemax_system_read_vignetting},
    {"VCXN", zemax_system_read_vignetting},
    {"VCYN", zemax_system_read_vignetting},
    {"VANN", zemax_system_read_vignetting},
    {"VDSX", zemax_system_read_vignetting},
    {"VDSY", zemax_system_read_vignetting},
    {"VCSX", zemax_system_read_vignetting},
    {"VCSY", zemax_system_read_vignetting},
    {"VANS", zemax_system_read_vignetting},
    {"ZVDX", zemax_system_read_vignetting},
    {"ZVDY", zemax_system_read_vignetting},
    {"ZVCX", zemax_system_read_vignetting},
    {"ZVCY", zemax_system_read_vignetting},
    {"ZVAN", zemax_system_read_vignetting},
    {NULL, NULL},
};
