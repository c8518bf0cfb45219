/* file/zemax_parse.c - a .zmx file as it stands, line by line, before it is a lens. */
/* SPDX-License-Identifier: MIT */
#include "file/zemax_parse.h"

#include <math.h>
#include <string.h>

double zemax_number(const struct zemax_line *line, size_t at)
{
    return line != NULL && at < line->count ? line->numbers[at].value.hi : 0;
}

/* The present line with its numbers, in the unit `scale`. */
static struct zemax_line *line_of(struct zemax_file *file, struct text keyword,
                                  struct number_scale scale)
{
    struct zemax_line *line = ARENA_NEW(file->job->arena, struct zemax_line);
    struct lens_words words = file->words;
    line->words = words;
    line->keyword = keyword;
    for (struct text word = lens_words_next(&words); word.length > 0;
         word = lens_words_next(&words)) {
        struct figure figure = {.typed = word, .variable = LENS_NONE};
        const char *end = word.start + word.length;
        if (line->first.start == NULL) {
            line->first = word;
            line->infinite = text_same(word, "INFINITY");
        }
        bool number = pair_read(word.start, end, scale, &figure.value) == end &&
                      fabs(figure.value.hi) < 1e100;
        if (!number || line->count == ZEMAX_NUMBERS) {
            break;
        }
        line->numbers[line->count++] = figure;
    }
    return line;
}

static bool has_number(const struct zemax_line *line, struct error *error)
{
    if (line->count > 0) {
        return true;
    }
    struct text word = line->first.start != NULL ? line->first : line->keyword;
    return lens_words_fail(&line->words, word, error, "%.*s wants a number", 4,
                           line->keyword.start);
}

static struct zemax_surface *surface_of(struct zemax_file *file)
{
    return &file->surfaces[file->surface_count - 1];
}

/* Each keyword has a function; `keyword` is the word itself. */
typedef bool read_function(struct zemax_file *file, struct text keyword, struct error *error);

static bool read_unit(struct zemax_file *file, struct text keyword, struct error *error)
{
    static const struct {
        const char *word, *unit;
    } units[] = {{"MM", "mm"}, {"CM", "cm"}, {"IN", "in"}, {"METER", "m"}, {"M", "m"}};
    struct text word = lens_words_next(&file->words);
    (void)keyword;
    for (size_t i = 0; i < sizeof units / sizeof units[0]; i++) {
        if (text_same(word, units[i].word)) {
            file->build.lens->unit = units[i].unit;
            file->words.scale = lens_unit_scale(units[i].unit);
            return true;
        }
    }
    return lens_words_fail(&file->words, word, error, "the unit is one of MM, CM, IN, METER");
}

static bool read_mode(struct zemax_file *file, struct text keyword, struct error *error)
{
    struct text word = lens_words_next(&file->words);
    (void)keyword;
    return text_same(word, "SEQ") ||
           lens_words_fail(&file->words, word, error,
                           "a non-sequential system: lenscalc has lenses whose surfaces follow "
                           "each other");
}

static bool read_name(struct zemax_file *file, struct text keyword, struct error *error)
{
    struct text rest = lens_words_rest(&file->words);
    (void)keyword;
    (void)error;
    if (rest.length > 0) {
        file->build.lens->title = lens_build_string(&file->build, rest);
    }
    return true;
}

/* NOTE 0 has the text; other numbers are breaks of its lines. */
static bool read_note(struct zemax_file *file, struct text keyword, struct error *error)
{
    struct text number = lens_words_next(&file->words), rest = lens_words_rest(&file->words);
    (void)keyword;
    (void)error;
    if (!text_equal(number, "0") || rest.length == 0) {
        return true;
    }
    struct text remark = text_behind(rest, ZEMAX_REMARK),
                names = text_behind(remark, ZEMAX_POSITIONS);
    if (names.start != NULL) {
        file->position_names = names;
        return true;
    }
    if (remark.start != NULL && remarks_take(&file->remarks, remark)) {
        return true;
    }
    lens_build_note(&file->build, rest);
    return true;
}

static bool read_catalogs(struct zemax_file *file, struct text keyword, struct error *error)
{
    (void)keyword;
    (void)error;
    for (struct text word = lens_words_next(&file->words);
         word.length > 0 && file->catalog_count < ZEMAX_CATALOGS;
         word = lens_words_next(&file->words)) {
        file->catalogs[file->catalog_count++] = word;
    }
    return true;
}

static bool read_aperture(struct zemax_file *file, struct text keyword, struct error *error)
{
    bool length = text_same(keyword, "ENPD"), none = text_same(keyword, "FLOA");
    file->aperture = line_of(file, keyword, length ? file->words.scale : NUMBER_UNSCALED);
    return none || has_number(file->aperture, error);
}

static bool read_fields(struct zemax_file *file, struct text keyword, struct error *error)
{
    file->fields = line_of(file, keyword, NUMBER_UNSCALED);
    return has_number(file->fields, error);
}

static bool read_x(struct zemax_file *file, struct text keyword, struct error *error)
{
    (void)error;
    file->x = line_of(file, keyword, NUMBER_UNSCALED);
    return true;
}

static bool read_y(struct zemax_file *file, struct text keyword, struct error *error)
{
    (void)error;
    file->y = line_of(file, keyword, NUMBER_UNSCALED);
    return true;
}

/* WAVM number wavelength weight */
static bool read_wave(struct zemax_file *file, struct text keyword, struct error *error)
{
    const struct zemax_line *line = line_of(file, keyword, NUMBER_UNSCALED);
    double number = zemax_number(line, 0), wavelength = zemax_number(line, 1);
    if (!(number >= 1 && number < ZEMAX_WAVES) || line->count < 2) {
        return lens_words_fail(&line->words, line->keyword, error,
                               "WAVM wants the number, the wavelength and its weight");
    }
    if (!(wavelength >= 0.001 && wavelength <= 1000)) {
        return lens_words_fail(&line->words, line->numbers[1].typed, error,
                               "the wavelength is not within 0.001 to 1000 um");
    }
    size_t at = (size_t)number - 1;
    const struct figure one = {.value = {1, 0}, .variable = LENS_NONE};
    file->waves[at] = line->numbers[1];
    file->weights[at] = line->count > 2 ? line->numbers[2] : one;
    file->wave_count = file->wave_count > at + 1 ? file->wave_count : at + 1;
    return true;
}

/* WAVL and WAVN have all wavelengths in a row, WWGT and WWGN their weights. */
static bool read_waves(struct zemax_file *file, struct text keyword, struct error *error)
{
    const struct zemax_line *line = line_of(file, keyword, NUMBER_UNSCALED);
    bool weights = text_same(keyword, "WWGT") || text_same(keyword, "WWGN");
    for (size_t i = 0; i < line->count; i++) {
        double value = line->numbers[i].value.hi;
        if (!weights && !(value >= 0.001 && value <= 1000)) {
            return lens_words_fail(&line->words, line->numbers[i].typed, error,
                                   "the wavelength is not within 0.001 to 1000 um");
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
    file->primary_line = line_of(file, keyword, NUMBER_UNSCALED);
    double number = zemax_number(file->primary_line, 0);
    if (!(number >= 1 && number < ZEMAX_WAVES)) {
        return lens_words_fail(&file->words, keyword, error, "PWAV wants a wavelength's number");
    }
    file->primary = (size_t)number - 1;
    return true;
}

/* Numbers that change nothing where they are 0. */
static bool read_zeros(struct zemax_file *file, struct text keyword, struct error *error)
{
    const struct zemax_line *line = line_of(file, keyword, NUMBER_UNSCALED);
    for (size_t i = 0; i < line->count; i++) {
        if (line->numbers[i].value.hi != 0) {
            return foreign_loss(file->job, &line->words, line->numbers[i].typed, error,
                                "%.4s: lenscalc has no vignetting factors and no apodised pupil",
                                keyword.start);
        }
    }
    return true;
}

/* ENVD temperature pressure adjust */
static bool read_environment(struct zemax_file *file, struct text keyword, struct error *error)
{
    const struct zemax_line *line = line_of(file, keyword, NUMBER_UNSCALED);
    bool usual = zemax_number(line, 0) == 20 && zemax_number(line, 1) == 1;
    return zemax_number(line, 2) == 0 || usual ||
           zemax_loss(file, line, error,
                      "indices at %.6g C and %.6g atmospheres: those of 20 C and 1 atmosphere "
                      "stand for them",
                      zemax_number(line, 0), zemax_number(line, 1));
}

static bool read_configurations(struct zemax_file *file, struct text keyword, struct error *error)
{
    const struct zemax_line *line = line_of(file, keyword, NUMBER_UNSCALED);
    double count = zemax_number(line, 0);
    if (!(count >= 1 && count <= ZEMAX_CONFIGURATIONS)) {
        return lens_words_fail(&file->words, keyword, error,
                               "MNUM wants the number of configurations, 1 to %d",
                               ZEMAX_CONFIGURATIONS);
    }
    file->configurations = (size_t)count;
    file->in_tail = true;
    return true;
}

static bool read_setting(struct zemax_file *file, struct text keyword, struct error *error)
{
    struct number_scale unit = text_same(keyword, "THIC") || text_same(keyword, "SDIA")
                                   ? file->words.scale
                                   : NUMBER_UNSCALED;
    const struct zemax_line *line = line_of(file, keyword, NUMBER_UNSCALED);
    if (file->configurations < 2) {
        return true; /* the only configuration has these values already */
    }
    double surface = zemax_number(line, 0), configuration = zemax_number(line, 1);
    if (line->count < 2 || !(surface >= 0 && surface <= ZEMAX_SURFACES) ||
        !(configuration >= 1 && configuration <= (double)file->configurations)) {
        return lens_words_fail(&file->words, keyword, error,
                               "%.4s wants a surface, a configuration and its value",
                               keyword.start);
    }
    struct zemax_line *own = line_of(file, keyword, unit);
    struct zemax_setting *setting = ARENA_NEW(file->job->arena, struct zemax_setting);
    *setting = (struct zemax_setting){own, (long)surface, (long)configuration, NULL};
    if (file->last_setting != NULL) {
        file->last_setting->next = setting;
    } else {
        file->settings = setting;
    }
    file->last_setting = setting;
    return true;
}

static bool read_surf(struct zemax_file *file, struct text keyword, struct error *error)
{
    const struct zemax_line *line = line_of(file, keyword, NUMBER_UNSCALED);
    if (zemax_number(line, 0) != (double)file->surface_count || line->count == 0) {
        return lens_words_fail(&line->words, keyword, error, "SURF %zu is expected here",
                               file->surface_count);
    }
    if (file->surface_count == ZEMAX_SURFACES) {
        return lens_words_fail(&line->words, keyword, error, "more than %d surfaces",
                               ZEMAX_SURFACES);
    }
    if (file->surface_count == file->surface_room) {
        size_t room = 2 * file->surface_room + 16;
        struct zemax_surface *more = ARENA_ARRAY(file->job->arena, room, struct zemax_surface);
        if (file->surface_count > 0) {
            memcpy(more, file->surfaces, file->surface_count * sizeof *more);
        }
        file->surfaces = more;
        file->surface_room = room;
    }
    file->surfaces[file->surface_count++] = (struct zemax_surface){.surf = line};
    return true;
}

static bool read_type(struct zemax_file *file, struct text keyword, struct error *error)
{
    (void)error;
    surface_of(file)->type = line_of(file, keyword, NUMBER_UNSCALED);
    return true;
}

static bool read_curvature(struct zemax_file *file, struct text keyword, struct error *error)
{
    surface_of(file)->curvature = line_of(file, keyword, NUMBER_UNSCALED);
    return has_number(surface_of(file)->curvature, error);
}

static bool read_thickness(struct zemax_file *file, struct text keyword, struct error *error)
{
    const struct zemax_line *line = line_of(file, keyword, file->words.scale);
    surface_of(file)->thickness = line;
    return line->infinite || has_number(line, error);
}

static bool read_conic(struct zemax_file *file, struct text keyword, struct error *error)
{
    surface_of(file)->conic = line_of(file, keyword, NUMBER_UNSCALED);
    return has_number(surface_of(file)->conic, error);
}

static bool read_diameter(struct zemax_file *file, struct text keyword, struct error *error)
{
    surface_of(file)->diameter = line_of(file, keyword, file->words.scale);
    return has_number(surface_of(file)->diameter, error);
}

static bool read_clear(struct zemax_file *file, struct text keyword, struct error *error)
{
    const struct zemax_line *line = line_of(file, keyword, file->words.scale);
    if (line->count < 2) {
        return has_number(line, error);
    }
    if (text_same(keyword, "CLAP")) {
        surface_of(file)->clear = line;
    }
    return line->numbers[0].value.hi == 0 ||
           zemax_loss(file, line, error, "an aperture with a hole: the hole is left out");
}

static bool read_other_aperture(struct zemax_file *file, struct text keyword, struct error *error)
{
    const struct zemax_line *line = line_of(file, keyword, NUMBER_UNSCALED);
    bool decentre = text_same(keyword, "OBDC");
    if (decentre && zemax_number(line, 0) == 0 && zemax_number(line, 1) == 0) {
        return true;
    }
    return zemax_loss(file, line, error,
                      "%.4s: apertures are round and centred here, and nothing is obscured; it is "
                      "left out",
                      keyword.start);
}

static bool read_glass(struct zemax_file *file, struct text keyword, struct error *error)
{
    struct lens_words words = file->words;
    struct text name = lens_words_next(&file->words);
    if (name.length == 0) {
        return lens_words_fail(&file->words, name, error, "the glass is missing");
    }
    struct zemax_line *line = line_of(file, name, NUMBER_UNSCALED);
    line->words = words;
    (void)keyword;
    surface_of(file)->glass = line;
    return true;
}

static bool read_stop(struct zemax_file *file, struct text keyword, struct error *error)
{
    (void)keyword;
    (void)error;
    surface_of(file)->is_stop = true;
    return true;
}

static bool read_comment(struct zemax_file *file, struct text keyword, struct error *error)
{
    (void)keyword;
    (void)error;
    surface_of(file)->comment = lens_words_rest(&file->words);
    return true;
}

/* A coating is kept as a note. */
static bool read_coating(struct zemax_file *file, struct text keyword, struct error *error)
{
    struct text rest = lens_words_rest(&file->words);
    (void)keyword;
    (void)error;
    lens_build_note(&file->build,
                    text_of(arena_printf(
                        file->job->arena, "coating of surface %zu: %.*s", file->surface_count - 1,
                        (int)(rest.length < 200 ? rest.length : 200), rest.start)));
    return true;
}

/* The place of a numbered line: 1 .. most - 1. */
static const struct zemax_line **place_of(struct zemax_file *file, const struct zemax_line *line,
                                          const struct zemax_line **places, size_t most,
                                          struct error *error)
{
    double number = zemax_number(line, 0);
    if (line->count < 2 || !(number >= 0 && number < 1e6)) {
        lens_words_fail(&file->words, line->keyword, error, "%.4s wants a number and a value",
                        line->keyword.start);
        return NULL;
    }
    return number < (double)most ? &places[(size_t)number] : &places[0];
}

static bool read_numbered(struct zemax_file *file, struct text keyword, struct error *error)
{
    struct zemax_surface *surface = surface_of(file);
    bool extra = text_same(keyword, "XDAT"), pickup = text_same(keyword, "PPAR");
    const struct zemax_line *line = line_of(file, keyword, NUMBER_UNSCALED);
    const struct zemax_line **place = place_of(file, line,
                                               extra    ? surface->extras
                                               : pickup ? surface->pickups
                                                        : surface->parameters,
                                               extra ? ZEMAX_EXTRAS : ZEMAX_PARAMETERS, error);
    if (place == NULL) {
        return false;
    }
    bool beyond = zemax_number(line, 0) >= (extra ? ZEMAX_EXTRAS : ZEMAX_PARAMETERS);
    if (beyond && zemax_number(line, 1) != 0) {
        return zemax_loss(file, line, error, "a parameter that no surface of lenscalc has");
    }
    *place = line;
    return true;
}

static bool read_solve(struct zemax_file *file, struct text keyword, struct error *error)
{
    (void)error;
    surface_of(file)->solve = line_of(file, keyword, NUMBER_UNSCALED);
    return true;
}

enum place { SYSTEM = 1, SURFACE = 2, TAIL = 4 };

static const struct {
    const char *word;
    enum place place;
    read_function *read;
} keywords[] = {
    {"MODE", SYSTEM, read_mode},
    {"UNIT", SYSTEM, read_unit},
    {"NAME", SYSTEM, read_name},
    {"NOTE", SYSTEM, read_note},
    {"GCAT", SYSTEM, read_catalogs},
    {"ENPD", SYSTEM, read_aperture},
    {"FNUM", SYSTEM, read_aperture},
    {"OBNA", SYSTEM, read_aperture},
    {"FLOA", SYSTEM, read_aperture},
    {"FTYP", SYSTEM, read_fields},
    {"XFLN", SYSTEM, read_x},
    {"XFLD", SYSTEM, read_x},
    {"YFLN", SYSTEM, read_y},
    {"YFLD", SYSTEM, read_y},
    {"WAVM", SYSTEM, read_wave},
    {"WAVL", SYSTEM, read_waves},
    {"WAVN", SYSTEM, read_waves},
    {"WWGT", SYSTEM, read_waves},
    {"WWGN", SYSTEM, read_waves},
    {"PWAV", SYSTEM, read_primary},
    {"VDXN", SYSTEM, read_zeros},
    {"VDYN", SYSTEM, read_zeros},
    {"VCXN", SYSTEM, read_zeros},
    {"VCYN", SYSTEM, read_zeros},
    {"VANN", SYSTEM, read_zeros},
    {"GFAC", SYSTEM, read_zeros},
    {"ENVD", SYSTEM, read_environment},
    {"SURF", SYSTEM, read_surf},
    {"TYPE", SURFACE, read_type},
    {"CURV", SURFACE, read_curvature},
    {"DISZ", SURFACE, read_thickness},
    {"CONI", SURFACE, read_conic},
    {"DIAM", SURFACE, read_diameter},
    {"GLAS", SURFACE, read_glass},
    {"STOP", SURFACE, read_stop},
    {"COMM", SURFACE, read_comment},
    {"COAT", SURFACE, read_coating},
    {"PARM", SURFACE, read_numbered},
    {"XDAT", SURFACE, read_numbered},
    {"PPAR", SURFACE, read_numbered},
    {"MAZH", SURFACE, read_solve},
    {"PZUP", SURFACE, read_solve},
    {"TCOM", SURFACE, read_solve},
    {"TOLE", SURFACE, read_solve},
    {"EDGE", SURFACE, read_solve},
    {"CLAP", SURFACE, read_clear},
    {"FLAP", SURFACE, read_clear},
    {"SQAP", SURFACE, read_other_aperture},
    {"ELAP", SURFACE, read_other_aperture},
    {"OBSC", SURFACE, read_other_aperture},
    {"SQOB", SURFACE, read_other_aperture},
    {"ELOB", SURFACE, read_other_aperture},
    {"SPID", SURFACE, read_other_aperture},
    {"USAP", SURFACE, read_other_aperture},
    {"UDAD", SURFACE, read_other_aperture},
    {"OBDC", SURFACE, read_other_aperture},
    {"MNUM", TAIL, read_configurations},
    {"THIC", TAIL, read_setting},
    {"CRVT", TAIL, read_setting},
    {"CONN", TAIL, read_setting},
    {"GLSS", TAIL, read_setting},
    {"APER", TAIL, read_setting},
    {"SDIA", TAIL, read_setting},
    {"WAVE", TAIL, read_setting},
    {"YFIE", TAIL, read_setting},
    {"XFIE", TAIL, read_setting},
    {"PRAM", TAIL, read_setting},
    {"PAR1", TAIL, read_setting},
    {"PAR2", TAIL, read_setting},
    {"PAR3", TAIL, read_setting},
    {"PAR4", TAIL, read_setting},
    {"PAR5", TAIL, read_setting},
    {"PAR6", TAIL, read_setting},
    {"IGNR", TAIL, read_setting},
    {"STPS", TAIL, read_setting},
};

/*
 * What says nothing about the lens: versions, drawing, ray aiming, polarisation, the editor's
 * colours, mechanical edges, marks of the optimiser, tolerances and file names.
 */
static const char *const no_lens[] = {
    "VERS", "PFIL", "LANG", "RAIM", "PUSH", "SDMA", "OMMA", "ROPD", "HYPR", "PICB", "FWGN",
    "FWGT", "POLS", "GLRS", "GSTD", "NSCD", "COFN", "LUID", "AUTH", "IWDP", "DBDT", "STUD",
    "EFFL", "OPDX", "EERA", "FIMP", "HIDE", "MIRR", "SLAB", "SSID", "POPS", "MEMA", "OEMA",
    "VDSZ", "VCON", "VPAR", "TOL",  "MOFF", "BLNK", "DMFS", "CONF", "PUPD", "ISNA", "ZVDX",
    "ZVDY", "ZVCX", "ZVCY", "ZVAN", "FVDX", "FVDY", "FVCX", "FVCY", "FVAN"};

static bool is_no_lens(struct text word)
{
    for (size_t i = 0; i < sizeof no_lens / sizeof no_lens[0]; i++) {
        if (text_same(word, no_lens[i])) {
            return true;
        }
    }
    return false;
}

/* Lines of the system and those behind the surfaces begin the line, those of a surface do not. */
static bool read_line(struct zemax_file *file, struct error *error)
{
    struct text word = lens_words_next(&file->words);
    bool indented = word.start > file->words.line.start, in_surface = file->surface_count > 0;
    for (size_t i = 0; i < sizeof keywords / sizeof keywords[0]; i++) {
        if (!text_same(word, keywords[i].word) ||
            (file->in_tail && keywords[i].place == SURFACE && !indented) ||
            (keywords[i].place == TAIL && (indented || !in_surface))) {
            continue;
        }
        if (keywords[i].place == SURFACE && !in_surface) {
            return lens_words_fail(&file->words, word, error, "'%s' stands before any surface",
                                   keywords[i].word);
        }
        return keywords[i].read(file, word, error);
    }
    if (is_no_lens(word)) {
        file->in_tail = file->in_tail || (in_surface && !indented);
        return true;
    }
    bool operand = in_surface && !indented && word.length == 4;
    if (operand) { /* of the merit function */
        file->in_tail = true;
        return true;
    }
    return foreign_loss(file->job, &file->words, word, error, "unknown word '%.*s'",
                        (int)(word.length < 40 ? word.length : 40), word.start);
}

bool zemax_parse(struct zemax_file *file, struct text content, struct error *error)
{
    if (!lens_words_open(&file->words, file->job->source, content, file->job->arena, error)) {
        return false;
    }
    file->words.comment = NULL;
    file->configurations = 1;
    while (lens_words_line(&file->words)) {
        struct lens_words start = file->words;
        if (lens_words_next(&start).length > 0 && !read_line(file, error)) {
            return false;
        }
    }
    if (file->surface_count < 3) {
        fail(error, ERROR_DATA, "the file has no surface between object and image");
        return error_locate(error, file->job->source, 0, 0);
    }
    return true;
}
