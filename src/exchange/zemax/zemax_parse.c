/* exchange/zemax/zemax_parse.c - a .zmx file as it stands, line by line, before it is a lens. */
/* SPDX-License-Identifier: MIT */
#include "exchange/zemax/zemax_keyword.h"

#include <math.h>
#include <string.h>

static struct zemax_surface *parse_surface_of(struct zemax_file *file)
{
    return &file->surfaces[file->surface_count - 1];
}

static bool read_surf(struct zemax_file *file, struct text keyword, struct error *error)
{
    const struct zemax_line *line = zemax_line_of(file, keyword, NUMBER_UNSCALED);
    size_t expected = file->surface_count > 0 ? parse_surface_of(file)->number + 1 : 0;
    double number = zemax_number(line, 0);
    bool is_next = number == (double)expected;
    bool is_later =
        expected > 0 && number > (double)expected && number < 1e6 && number == floor(number);
    if (!(is_next || is_later) || line->count == 0) {
        return file_words_fail(&line->words, keyword, error, "SURF %zu is expected here", expected);
    }
    if (file->surface_count == FOREIGN_MOST_SURFACES) {
        return file_words_fail(&line->words, keyword, error, "more than %d surfaces",
                               LENS_MOST_SURFACES);
    }
    file->surfaces = arena_grow(file->job->arena, file->surfaces, file->surface_count,
                                &file->surface_room, sizeof file->surfaces[0]);
    file->has_gaps = file->has_gaps || is_later;
    file->surfaces[file->surface_count++] =
        (struct zemax_surface){.surf = line, .number = (size_t)number};
    return true;
}

/* What no lens of lenscalc can be is said before all else. */
static bool read_type(struct zemax_file *file, struct text keyword, struct error *error)
{
    const struct zemax_line *line = zemax_line_of(file, keyword, NUMBER_UNSCALED);
    parse_surface_of(file)->type = line;
    if (text_same(line->first, "NONSEQCO")) {
        return file_words_fail(&line->words, line->first, error,
                               "a non-sequential group: lenscalc has lenses whose surfaces follow "
                               "each other");
    }
    return !text_same(line->first, "USERSURF") ||
           file_words_fail(&line->words, line->first, error,
                           "a surface computed by a program (DLL) of the user's, which the file "
                           "does not hold");
}

static bool parse_read_curvature(struct zemax_file *file, struct text keyword, struct error *error)
{
    parse_surface_of(file)->curvature = zemax_line_of(file, keyword, NUMBER_UNSCALED);
    return zemax_has_number(parse_surface_of(file)->curvature, error);
}

static bool parse_read_thickness(struct zemax_file *file, struct text keyword, struct error *error)
{
    const struct zemax_line *line = zemax_line_of(file, keyword, file->words.scale);
    parse_surface_of(file)->thickness = line;
    return line->infinite || zemax_has_number(line, error);
}

static bool parse_read_conic(struct zemax_file *file, struct text keyword, struct error *error)
{
    parse_surface_of(file)->conic = zemax_line_of(file, keyword, NUMBER_UNSCALED);
    return zemax_has_number(parse_surface_of(file)->conic, error);
}

static bool parse_read_diameter(struct zemax_file *file, struct text keyword, struct error *error)
{
    parse_surface_of(file)->diameter = zemax_line_of(file, keyword, file->words.scale);
    return zemax_has_number(parse_surface_of(file)->diameter, error);
}

/* CLAP, SQAP ..: two numbers, of which zemax_aperture.c knows the meaning. */
static bool parse_read_aperture(struct zemax_file *file, struct text keyword, struct error *error)
{
    const struct zemax_line *line = zemax_line_of(file, keyword, file->words.scale);
    if (!zemax_has_number(line, error)) {
        return false;
    }
    if (line->count < 2) {
        return zemax_loss(file, line, error,
                          "%.4s with one number" LOSS_VIGNETTES LOSS_INSTEAD "left out",
                          keyword.start);
    }
    if (text_same(keyword, "CLAP")) {
        parse_surface_of(file)->clear = line;
    }
    parse_surface_of(file)->aperture = line;
    return true;
}

/* A floating aperture is as large as the semi-diameter. */
static bool read_floating(struct zemax_file *file, struct text keyword, struct error *error)
{
    const struct zemax_line *line = zemax_line_of(file, keyword, file->words.scale);
    return zemax_has_number(line, error) &&
           (line->count < 2 || line->numbers[0].value.hi == 0 ||
            zemax_loss(file, line, error,
                       "a floating aperture with a hole" LOSS_VIGNETTES LOSS_INSTEAD
                       "the hole is left out"));
}

static bool read_aperture_shift(struct zemax_file *file, struct text keyword, struct error *error)
{
    const struct zemax_line *line = zemax_line_of(file, keyword, file->words.scale);
    if (zemax_number(line, 0) != 0 || zemax_number(line, 1) != 0) {
        parse_surface_of(file)->aperture_shift = line;
    }
    return zemax_all_numbers(line, error);
}

/* UDAD 1 x y 0: the file that UDAD 0 names, row by row, as it was when the lens was saved. */
static void add_user_row(struct zemax_file *file, const struct zemax_line *line)
{
    struct zemax_surface *surface = parse_surface_of(file);
    if (surface->has_lost_aperture) {
        return; /* its numbers would be scaled */
    }
    surface->user_rows = arena_grow(file->job->arena, surface->user_rows, surface->user_row_count,
                                    &surface->user_row_room, sizeof surface->user_rows[0]);
    surface->user_rows[surface->user_row_count++] = line;
    if (surface->user_aperture == NULL) {
        surface->user_aperture = line;
    }
}

/*
 * USAP passes, USOB blocks; they or UDAD have the name of the file, among numbers of which one may
 * be a scale: others than 0 and 1 are not known.
 */
static bool read_user_aperture(struct zemax_file *file, struct text keyword, struct error *error)
{
    struct zemax_surface *surface = parse_surface_of(file);
    const struct zemax_line *line = zemax_line_of(file, keyword, file->words.scale);
    if (text_same(keyword, "UDAD") && zemax_number(line, 0) != 0) {
        add_user_row(file, line);
        return true;
    }
    bool known = true;
    surface->user_aperture = line;
    surface->user_blocks = surface->user_blocks || text_same(keyword, "USOB");
    for (struct text word = file_words_next(&file->words); word.length > 0;
         word = file_words_next(&file->words)) {
        double value;
        bool number = number_read(word.start, word.start + word.length, NUMBER_UNSCALED, &value) ==
                      word.start + word.length;
        bool named = !number && !text_equal(word, "\"\"");
        known = known && (!number || value == 0 || value == 1);
        surface->user_file = named ? word : surface->user_file;
    }
    if (known) {
        return true;
    }
    surface->user_aperture = NULL;
    surface->user_row_count = 0;
    surface->has_lost_aperture = true;
    return zemax_loss(
        file, line, error,
        "%.4s: an aperture of a file with numbers beside its name" LOSS_VIGNETTES LOSS_INSTEAD
        "left out",
        keyword.start);
}

static bool parse_read_glass(struct zemax_file *file, struct text keyword, struct error *error)
{
    struct file_words words = file->words;
    struct text name = file_words_next(&file->words);
    if (name.length == 0) {
        return file_words_fail(&file->words, name, error, "the glass is missing");
    }
    struct zemax_line *line = zemax_line_of(file, name, NUMBER_UNSCALED);
    line->words = words;
    line->begin = keyword;
    parse_surface_of(file)->glass = line;
    return zemax_all_numbers(line, error);
}

static bool parse_read_stop(struct zemax_file *file, struct text keyword, struct error *error)
{
    (void)keyword;
    (void)error;
    parse_surface_of(file)->is_stop = true;
    return true;
}

static bool read_comment(struct zemax_file *file, struct text keyword, struct error *error)
{
    (void)keyword;
    (void)error;
    parse_surface_of(file)->comment = file_words_rest(&file->words);
    return true;
}

/* A coating is kept as a note. */
static bool read_coating(struct zemax_file *file, struct text keyword, struct error *error)
{
    struct text rest = file_words_rest(&file->words);
    (void)keyword;
    (void)error;
    lens_build_note(
        &file->build,
        text_of(arena_printf(file->job->arena, "coating of surface %zu: %.*s",
                             file->surface_count - 1, text_shown_up_to(rest, 200), rest.start)));
    return true;
}

/* The place of a numbered line: 1 .. most - 1. */
static const struct zemax_line **parse_place_of(struct zemax_file *file,
                                                const struct zemax_line *line,
                                                const struct zemax_line **places, size_t most,
                                                struct error *error)
{
    double number = zemax_number(line, 0);
    if (!zemax_all_numbers(line, error)) {
        return NULL;
    }
    if (line->count < 2 || !(number >= 0 && number < 1e6)) {
        file_words_fail(&file->words, line->keyword, error, "%.4s needs a number and a value",
                        line->keyword.start);
        return NULL;
    }
    return number < (double)most ? &places[(size_t)number] : &places[0];
}

static bool read_numbered(struct zemax_file *file, struct text keyword, struct error *error)
{
    struct zemax_surface *surface = parse_surface_of(file);
    bool extra = text_same(keyword, "XDAT"), pickup = text_same(keyword, "PPAR");
    const struct zemax_line *line = zemax_line_of(file, keyword, NUMBER_UNSCALED);
    const struct zemax_line **place =
        parse_place_of(file, line,
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

static bool parse_read_solve(struct zemax_file *file, struct text keyword, struct error *error)
{
    parse_surface_of(file)->solve = zemax_line_of(file, keyword, NUMBER_UNSCALED);
    return zemax_all_numbers(parse_surface_of(file)->solve, error);
}

/* SCBD which .. : what is shifted and turned before the surface (1) or behind it (2). */
static bool parse_read_shift(struct zemax_file *file, struct text keyword, struct error *error)
{
    const struct zemax_line *line = zemax_line_of(file, keyword, NUMBER_UNSCALED);
    const double which = zemax_number(line, 0);
    if (!zemax_all_numbers(line, error)) {
        return false;
    }
    if (which == 1 || which == 2) {
        *(which == 1 ? &parse_surface_of(file)->shift_before
                     : &parse_surface_of(file)->shift_behind) = line;
        return true;
    }
    return zemax_loss(file, line, error, "SCBD is of 1, before the surface, or of 2, behind it");
}

static const struct zemax_keyword surface_keywords[] = {
    {"TYPE", read_type},
    {"CURV", parse_read_curvature},
    {"DISZ", parse_read_thickness},
    {"CONI", parse_read_conic},
    {"DIAM", parse_read_diameter},
    {"GLAS", parse_read_glass},
    {"STOP", parse_read_stop},
    {"COMM", read_comment},
    {"COAT", read_coating},
    {"PARM", read_numbered},
    {"XDAT", read_numbered},
    {"PPAR", read_numbered},
    {"MAZH", parse_read_solve},
    {"CHZH", parse_read_solve},
    {"PZUP", parse_read_solve},
    {"TCOM", parse_read_solve},
    {"TOLE", parse_read_solve},
    {"EDGE", parse_read_solve},
    {"CLAP", parse_read_aperture},
    {"FLAP", read_floating},
    {"SQAP", parse_read_aperture},
    {"ELAP", parse_read_aperture},
    {"OBSC", parse_read_aperture},
    {"SQOB", parse_read_aperture},
    {"ELOB", parse_read_aperture},
    {"SPID", parse_read_aperture},
    {"USAP", read_user_aperture},
    {"USOB", read_user_aperture},
    {"UDAD", read_user_aperture},
    {"OBDC", read_aperture_shift},
    {"SCBD", parse_read_shift},
    {NULL, NULL},
};

static const struct zemax_keyword *parse_find(const struct zemax_keyword *table, struct text word)
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
    const struct zemax_keyword *keyword = parse_find(zemax_system_keywords, word);
    if (keyword == NULL && file->surface_count > 0 && !indented) {
        keyword = parse_find(zemax_tail_keywords, word);
    }
    if (keyword == NULL && (!file->in_tail || indented)) {
        keyword = parse_find(surface_keywords, word);
    }
    return keyword;
}

/* Are there numbers on the line, and all of them 0? `first` receives the first that is not. */
static bool parse_is_zero(const struct zemax_line *line, struct text *first)
{
    *first = line->stray.start != NULL ? line->stray : line->keyword;
    for (size_t i = 0; i < line->count; i++) {
        if (line->numbers[i].value.hi != 0) {
            *first = line->numbers[i].typed;
            return false;
        }
    }
    return line->count > 0 && line->stray.start == NULL;
}

/* A word of the table that has no reader. */
static bool parse_pass_over(struct zemax_file *file, const struct word_group *group,
                            struct text word, struct error *error)
{
    const struct zemax_line *line = zemax_line_of(file, word, NUMBER_UNSCALED);
    struct text at;
    return group->fate == WORD_HARMLESS ||
           (parse_is_zero(line, &at) && (group->flags & WORD_COUNTS_AT_0) == 0) ||
           foreign_loss(file->job, &line->words, at, error, "%.4s: %s%s", word.start, group->what,
                        (group->flags & WORD_VIGNETTES) != 0 ? LOSS_VIGNETTES : "");
}

/* Every line of the merit function has the same form: a word, two integers and six numbers. */
static bool is_like_operand(const struct zemax_line *line)
{
    return line->keyword.length == 4 && line->count >= 8;
}

static bool is_like_setting(const struct zemax_file *file, const struct zemax_line *line)
{
    double surface = zemax_number(line, 0), configuration = zemax_number(line, 1);
    return file->has_configurations && line->count >= 2 && surface >= 0 &&
           surface < FOREIGN_MOST_SURFACES && configuration >= 1 &&
           configuration <= (double)file->configurations;
}

/* A word that is not in the table. Where all its numbers are 0, it says that something is off. */
static bool read_unknown(struct zemax_file *file, struct text word, bool behind,
                         struct error *error)
{
    const struct zemax_line *line = zemax_line_of(file, word, NUMBER_UNSCALED);
    int length = text_shown_up_to(word, 40);
    struct text at;
    if (behind && is_like_setting(file, line)) {
        return zemax_read_setting(file, word, error);
    }
    if (behind && !file->has_configurations && is_like_operand(line)) {
        file->in_tail = true;
        return true;
    }
    if (!behind && parse_is_zero(line, &at)) {
        file->zeros = arena_grow(file->job->arena, file->zeros, file->zero_count, &file->zero_room,
                                 sizeof file->zeros[0]);
        file->zeros[file->zero_count++] = line;
        return true;
    }
    return zemax_loss(file, line, error, "unknown word '%.*s'", length, word.start);
}

/*
 * Unknown words whose numbers are all 0: flags that are off. If it were a solve, the file has its
 * answer as a number, but for one configuration only.
 */
static bool pass_zeros(struct zemax_file *file, struct error *error)
{
    bool done = true;
    for (size_t i = 0; i < file->zero_count && done; i++) {
        const struct zemax_line *line = file->zeros[i];
        struct text word = line->keyword;
        int length = text_shown_up_to(word, 40);
        if (file->configurations > 1) {
            done = zemax_loss(file, line, error, "unknown word '%.*s'", length, word.start);
        } else {
            zemax_remark(file, "line %ld: %.*s is unknown; its numbers are 0, it was passed over",
                         line->words.number, length, word.start);
        }
    }
    return done;
}

/* What stands behind the surfaces and has no reader. */
static const struct word_group *group_behind(struct text word)
{
    const struct word_group *group = word_group_of(zemax_words, ZEMAX_IN_CONFIGURATIONS, word);
    return group != NULL ? group : word_group_of(zemax_words, ZEMAX_IN_TAIL, word);
}

static bool parse_read_line(struct zemax_file *file, struct error *error)
{
    struct text word = file_words_next(&file->words);
    bool indented = word.start > file->words.line.start, in_surface = file->surface_count > 0;
    bool behind = in_surface && !indented;
    const struct zemax_keyword *keyword = find_keyword(file, word, indented);
    const struct word_group *group = behind ? group_behind(word) : NULL;
    file->last_word = word;
    if (text_same(word, "SURF")) {
        return read_surf(file, word, error);
    }
    if (keyword != NULL && !in_surface && parse_find(surface_keywords, word) != NULL) {
        return file_words_fail(&file->words, word, error, "'%s' stands before any surface",
                               keyword->word);
    }
    file->has_tail =
        file->has_tail || (behind && word_group_of(zemax_words, ZEMAX_IN_SURFACE, word) == NULL);
    if (keyword != NULL) {
        return keyword->read(file, word, error);
    }
    if (group != NULL) {
        file->in_tail = true;
        return group->fate == WORD_HARMLESS || zemax_read_setting(file, word, error);
    }
    group = word_group_of(zemax_words, NULL, word);
    return group != NULL ? parse_pass_over(file, group, word, error)
                         : read_unknown(file, word, behind, error);
}

/* What follows another surface, by its number in the file. */
static bool lose_reference(struct zemax_file *file, const struct zemax_line **line,
                           struct error *error)
{
    const struct zemax_line *lost = *line;
    *line = NULL;
    return zemax_stands(file, lost, error,
                        "what follows another surface, in a file whose surface numbers have gaps");
}

/* Solves and pick-ups of a surface, in a file whose surface numbers have gaps. */
static bool lose_references(struct zemax_file *file, struct zemax_surface *surface,
                            struct error *error)
{
    bool follows = surface->solve != NULL && !text_same(surface->solve->keyword, "MAZH") &&
                   !text_same(surface->solve->keyword, "EDGE");
    if (follows && !lose_reference(file, &surface->solve, error)) {
        return false;
    }
    for (size_t i = 0; i < ZEMAX_PARAMETERS; i++) {
        if (surface->pickups[i] != NULL && !lose_reference(file, &surface->pickups[i], error)) {
            return false;
        }
    }
    const struct zemax_line *curvature = surface->curvature;
    surface->has_free_curvature = zemax_number(curvature, 1) >= 2;
    return !surface->has_free_curvature || lose_reference(file, &curvature, error);
}

/* Numbers of surfaces where some are left out: the places of the surfaces, or a loss. */
static bool parse_close_gaps(struct zemax_file *file, struct error *error)
{
    for (size_t i = 0; i < file->surface_count; i++) {
        if (!lose_references(file, &file->surfaces[i], error)) {
            return false;
        }
    }
    for (struct zemax_setting *one = file->settings; one != NULL; one = one->next) {
        size_t at = 0;
        while (at < file->surface_count && (long)file->surfaces[at].number != one->surface) {
            at++;
        }
        one->surface = (long)at;
    }
    return true;
}

/* A picked-up glass is that of an earlier surface: GLAS name 2 surface .. */
static bool pick_up_glasses(struct zemax_file *file, struct error *error)
{
    for (size_t i = 0; i < file->surface_count; i++) {
        const struct zemax_line *line = file->surfaces[i].glass;
        double from = file->has_gaps ? -1 : zemax_number(line, 1);
        if (zemax_number(line, 0) != 2) {
            continue;
        }
        if (!(from >= 0 && from < (double)i)) {
            if (!zemax_loss(file, line, error,
                            "a glass that follows no earlier surface" LOSS_IS_MUTE LOSS_INSTEAD
                            "the file's glass is kept")) {
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

/*
 * A file of the program goes on behind its surfaces, and behind several configurations too. One
 * that does not may be whole: then its last surface, the image, has no glass.
 */
static bool parse_check_end(struct zemax_file *file, struct error *error)
{
    const struct zemax_surface *image = parse_surface_of(file);
    const bool has_last = text_same(file->last_word, "CSUM") || text_same(file->last_word, "MOFF");
    if (!file->has_tail && image->glass != NULL) {
        return file_words_fail(&image->surf->words, image->surf->keyword, error,
                               "the file ends inside surface %zu: it was cut short", image->number);
    }
    if (image->thickness == NULL) {
        foreign_cut_short(file->job, "its last surface has no distance DISZ");
    } else if (!file->has_tail) {
        foreign_cut_short(file->job, "nothing stands behind its surfaces");
    } else if (file->configurations > 1 && !has_last) {
        foreign_cut_short(file->job, "neither CSUM nor MOFF stands behind its configurations");
    }
    return true;
}

bool zemax_parse(struct zemax_file *file, struct text content, struct error *error)
{
    if (!file_words_open(&file->words, file->job->source, content, file->job->arena, error)) {
        return false;
    }
    file->words.comment = NULL;
    file->configurations = 1;
    while (file_words_line(&file->words)) {
        struct file_words start = file->words;
        if (file_words_next(&start).length > 0 && !parse_read_line(file, error)) {
            return false;
        }
    }
    if (file->surface_count < 3) {
        fail(error, ERROR_DATA, "the file has no surface between object and image");
        return error_locate(error, file->job->source, 0, 0);
    }
    return parse_check_end(file, error) && pass_zeros(file, error) &&
           (!file->has_gaps || parse_close_gaps(file, error)) && pick_up_glasses(file, error);
}

bool zemax_is_tilted(const struct zemax_file *file, size_t at)
{
    const struct zemax_surface *surface = &file->surfaces[at];
    bool shifted = false;
    for (size_t i = 3; i < 8; i++) {
        shifted = shifted || zemax_number(surface->shift_before, i) != 0;
    }
    return shifted || (surface->type != NULL && text_same(surface->type->first, "TILTSURF") &&
                       (zemax_number(surface->parameters[1], 1) != 0 ||
                        zemax_number(surface->parameters[2], 1) != 0));
}

struct figure zemax_parameter(const struct zemax_file *file, size_t at, size_t number)
{
    const struct zemax_surface *surface = &file->surfaces[at];
    const struct zemax_line *pickup = surface->pickups[number];
    const struct figure none = {.typed = text_of("0"), .variable = LENS_NONE};
    double from = zemax_number(pickup, 1);
    if (pickup != NULL && pickup->count >= 3 && from >= 0 && from < (double)at &&
        zemax_number(pickup, 4) == 0) {
        struct pair value = zemax_parameter(file, (size_t)from, number).value;
        struct pair offset = pickup->count > 3 ? pickup->numbers[3].value : pair_of(0);
        value = pair_add(pair_multiply(value, pickup->numbers[2].value), offset);
        return figure_computed(value, NUMBER_UNSCALED, file->job->arena);
    }
    return surface->parameters[number] != NULL ? surface->parameters[number]->numbers[1] : none;
}
