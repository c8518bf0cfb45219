/* exchange/zemax/zemax_parse.c - a .zmx file as it stands, line by line, before it is a lens. */
/* SPDX-License-Identifier: MIT */
#include "exchange/zemax/zemax_keyword.h"

#include <math.h>
#include <string.h>

static struct zemax_surface *surface_of(struct zemax_file *file)
{
    return &file->surfaces[file->surface_count - 1];
}

static bool read_surf(struct zemax_file *file, struct text keyword, struct error *error)
{
    const struct zemax_line *line = zemax_line_of(file, keyword, NUMBER_UNSCALED);
    if (zemax_number(line, 0) != (double)file->surface_count || line->count == 0) {
        return lens_words_fail(&line->words, keyword, error, "SURF %zu is expected here",
                               file->surface_count);
    }
    if (file->surface_count == ZEMAX_SURFACES) {
        return lens_words_fail(&line->words, keyword, error, "more than %d surfaces",
                               ZEMAX_SURFACES);
    }
    file->surfaces = arena_grow(file->job->arena, file->surfaces, file->surface_count,
                                &file->surface_room, sizeof file->surfaces[0]);
    file->surfaces[file->surface_count++] = (struct zemax_surface){.surf = line};
    return true;
}

static bool read_type(struct zemax_file *file, struct text keyword, struct error *error)
{
    (void)error;
    surface_of(file)->type = zemax_line_of(file, keyword, NUMBER_UNSCALED);
    return true;
}

static bool read_curvature(struct zemax_file *file, struct text keyword, struct error *error)
{
    surface_of(file)->curvature = zemax_line_of(file, keyword, NUMBER_UNSCALED);
    return zemax_has_number(surface_of(file)->curvature, error);
}

static bool read_thickness(struct zemax_file *file, struct text keyword, struct error *error)
{
    const struct zemax_line *line = zemax_line_of(file, keyword, file->words.scale);
    surface_of(file)->thickness = line;
    return line->infinite || zemax_has_number(line, error);
}

static bool read_conic(struct zemax_file *file, struct text keyword, struct error *error)
{
    surface_of(file)->conic = zemax_line_of(file, keyword, NUMBER_UNSCALED);
    return zemax_has_number(surface_of(file)->conic, error);
}

static bool read_diameter(struct zemax_file *file, struct text keyword, struct error *error)
{
    surface_of(file)->diameter = zemax_line_of(file, keyword, file->words.scale);
    return zemax_has_number(surface_of(file)->diameter, error);
}

static bool read_clear(struct zemax_file *file, struct text keyword, struct error *error)
{
    const struct zemax_line *line = zemax_line_of(file, keyword, file->words.scale);
    if (line->count < 2) {
        return zemax_has_number(line, error);
    }
    if (text_same(keyword, "CLAP")) {
        surface_of(file)->clear = line;
    }
    return line->numbers[0].value.hi == 0 ||
           zemax_loss(file, line, error,
                      "an aperture with a hole" LOSS_INSTEAD "the hole is left out");
}

static bool read_other_aperture(struct zemax_file *file, struct text keyword, struct error *error)
{
    const struct zemax_line *line = zemax_line_of(file, keyword, NUMBER_UNSCALED);
    bool decentre = text_same(keyword, "OBDC");
    if (decentre && zemax_number(line, 0) == 0 && zemax_number(line, 1) == 0) {
        return true;
    }
    bool blocks = text_same(keyword, "OBSC") || text_same(keyword, "SQOB") ||
                  text_same(keyword, "ELOB") || text_same(keyword, "SPID");
    surface_of(file)->has_lost_aperture = surface_of(file)->has_lost_aperture || !blocks;
    return zemax_loss(
        file, line, error,
        "%.4s: apertures are round and centred here, and nothing is obscured" LOSS_INSTEAD
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
    struct zemax_line *line = zemax_line_of(file, name, NUMBER_UNSCALED);
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
    const struct zemax_line *line = zemax_line_of(file, keyword, NUMBER_UNSCALED);
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
    surface_of(file)->solve = zemax_line_of(file, keyword, NUMBER_UNSCALED);
    return true;
}

static const struct zemax_keyword surface_keywords[] = {
    {"TYPE", read_type},
    {"CURV", read_curvature},
    {"DISZ", read_thickness},
    {"CONI", read_conic},
    {"DIAM", read_diameter},
    {"GLAS", read_glass},
    {"STOP", read_stop},
    {"COMM", read_comment},
    {"COAT", read_coating},
    {"PARM", read_numbered},
    {"XDAT", read_numbered},
    {"PPAR", read_numbered},
    {"MAZH", read_solve},
    {"PZUP", read_solve},
    {"TCOM", read_solve},
    {"TOLE", read_solve},
    {"EDGE", read_solve},
    {"CLAP", read_clear},
    {"FLAP", read_clear},
    {"SQAP", read_other_aperture},
    {"ELAP", read_other_aperture},
    {"OBSC", read_other_aperture},
    {"SQOB", read_other_aperture},
    {"ELOB", read_other_aperture},
    {"SPID", read_other_aperture},
    {"USAP", read_other_aperture},
    {"UDAD", read_other_aperture},
    {"OBDC", read_other_aperture},
    {NULL, NULL},
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

static const struct zemax_keyword *find(const struct zemax_keyword *table, struct text word)
{
    for (; table->word != NULL; table++) {
        if (text_same(word, table->word)) {
            return table;
        }
    }
    return NULL;
}

/* Lines of the system and those behind the surfaces begin the line, those of a surface do not. */
static const struct zemax_keyword *find_keyword(const struct zemax_file *file, struct text word,
                                                bool indented)
{
    const struct zemax_keyword *keyword = find(zemax_system_keywords, word);
    if (keyword == NULL && file->surface_count > 0 && !indented) {
        keyword = find(zemax_tail_keywords, word);
    }
    if (keyword == NULL && (!file->in_tail || indented)) {
        keyword = find(surface_keywords, word);
    }
    return keyword;
}

static bool read_line(struct zemax_file *file, struct error *error)
{
    struct text word = lens_words_next(&file->words);
    bool indented = word.start > file->words.line.start, in_surface = file->surface_count > 0;
    const struct zemax_keyword *keyword = find_keyword(file, word, indented);
    if (text_same(word, "SURF")) {
        return read_surf(file, word, error);
    }
    if (keyword != NULL && !in_surface && find(surface_keywords, word) != NULL) {
        return lens_words_fail(&file->words, word, error, "'%s' stands before any surface",
                               keyword->word);
    }
    if (keyword != NULL) {
        return keyword->read(file, word, error);
    }
    bool behind = in_surface && !indented;
    if (is_no_lens(word) || (behind && zemax_is_operand(word))) {
        file->in_tail = file->in_tail || behind;
        return true;
    }
    return foreign_loss(file->job, &file->words, word, error, "unknown word '%.*s'",
                        (int)(word.length < 40 ? word.length : 40), word.start);
}

/* A picked-up glass is that of an earlier surface: GLAS name 2 surface .. */
static bool pick_up_glasses(struct zemax_file *file, struct error *error)
{
    for (size_t i = 0; i < file->surface_count; i++) {
        const struct zemax_line *line = file->surfaces[i].glass;
        double from = zemax_number(line, 1);
        if (zemax_number(line, 0) != 2) {
            continue;
        }
        if (!(from >= 0 && from < (double)i)) {
            if (!zemax_loss(file, line, error,
                            "a glass that follows no earlier surface" LOSS_INSTEAD
                            "the file's glass stands")) {
                return false;
            }
            continue;
        }
        const struct zemax_line *source = file->surfaces[(size_t)from].glass;
        struct text name = source != NULL ? source->keyword : text_of("air");
        if (source == NULL || name.length != line->keyword.length ||
            memcmp(name.start, line->keyword.start, name.length) != 0) {
            zemax_remark(file, "the glass of surface %zu follows surface %.0f, the file had %.*s",
                         i, from, text_shown(line->keyword), line->keyword.start);
        }
        file->surfaces[i].glass = source;
    }
    return true;
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
    return pick_up_glasses(file, error);
}
