/* exchange/zemax/zemax_parse.c - a .zmx file as it stands, line by line, before it is a lens. */
/* SPDX-License-Identifier: MIT */
#include "exchange/zemax/zemax.h"

#include <math.h>
#include <string.h>

static struct zemax_surface *last_zmx_surface(struct zemax_file *file)
{
    return &file->surfaces[file->surface_count - 1];
}

static bool read_surf(struct zemax_file *file, const struct zemax_line *line)
{
    size_t expected = file->surface_count > 0 ? last_zmx_surface(file)->number + 1 : 0;
    double number = zemax_number(line, 0);
    bool is_next = number == (double)expected;
    bool is_later =
        expected > 0 && number > (double)expected && number < 1e6 && number == floor(number);
    if (!(is_next || is_later) || line->count == 0) {
        return zemax_fail(line, line->keyword, "SURF %zu is expected here", expected);
    }
    if (file->surface_count == FOREIGN_MOST_SURFACES) {
        return zemax_fail(line, line->keyword, "more than %d surfaces", LENS_MOST_SURFACES);
    }
    file->surfaces = arena_grow(file->job->arena, file->surfaces, file->surface_count,
                                &file->surface_room, sizeof file->surfaces[0]);
    file->has_gaps = file->has_gaps || is_later;
    file->surfaces[file->surface_count++] =
        (struct zemax_surface){.surf = line, .number = (size_t)number};
    return true;
}

/* What no lens of lenscalc can be is said before all else. */
static bool read_type(struct zemax_file *file, const struct zemax_line *line)
{
    (void)file;
    if (text_same(line->first, "NONSEQCO")) {
        return zemax_fail(line, line->first,
                          "a non-sequential group: lenscalc has lenses whose surfaces follow "
                          "each other");
    }
    return !text_same(line->first, "USERSURF") ||
           zemax_fail(line, line->first,
                      "a surface computed by a program (DLL) of the user's, which the file "
                      "does not hold");
}

static bool zmx_thickness(struct zemax_file *file, const struct zemax_line *line)
{
    (void)file;
    return line->infinite || zemax_has_number(line);
}

/* CLAP, SQAP ..: two numbers, of which zemax_aperture.c knows the meaning. */
static bool zmx_aperture(struct zemax_file *file, const struct zemax_line *line)
{
    if (line->count < 2) {
        return zemax_loss(file, line, LOSS_OF_VIGNETTING, "left out", "%.4s with one number",
                          line->keyword.start);
    }
    if (text_same(line->keyword, "CLAP")) {
        last_zmx_surface(file)->clear = line;
    }
    last_zmx_surface(file)->aperture = line;
    return true;
}

/* A floating aperture is as large as the semi-diameter. */
static bool read_floating(struct zemax_file *file, const struct zemax_line *line)
{
    return line->count < 2 || line->numbers[0].value.hi == 0 ||
           zemax_loss(file, line, LOSS_OF_VIGNETTING, "the hole is left out",
                      "a floating aperture with a hole");
}

static bool read_aperture_shift(struct zemax_file *file, const struct zemax_line *line)
{
    if (zemax_number(line, 0) != 0 || zemax_number(line, 1) != 0) {
        last_zmx_surface(file)->aperture_shift = line;
    }
    return true;
}

/*
 * USAP passes, USOB blocks; they or UDAD have the name of the file, among numbers of which one may
 * be a scale: others than 0 and 1 are not known.
 */
static bool read_user_aperture(struct zemax_file *file, const struct zemax_line *line)
{
    struct zemax_surface *surface = last_zmx_surface(file);
    if (text_same(line->keyword, "UDAD") && zemax_number(line, 0) != 0) {
        /* UDAD 1 x y 0: the file that UDAD 0 names, row by row, as the lens was saved */
        if (!surface->has_lost_aperture) { /* else its numbers would be scaled */
            *ARENA_ADD(file->job->arena, surface->user_rows, surface->user_row_count,
                       surface->user_row_room) = line;
            if (surface->user_aperture == NULL) {
                surface->user_aperture = line;
            }
        }
        return true;
    }
    bool known = true;
    surface->user_aperture = line;
    surface->user_blocks = surface->user_blocks || text_same(line->keyword, "USOB");
    for (struct text word = file_words_next(&file->words); word.length > 0;
         word = file_words_next(&file->words)) {
        double value;
        const char *end = word.start + word.length;
        if (number_read(word.start, end, NUMBER_UNSCALED, &value) == end) {
            known = known && (value == 0 || value == 1);
        } else if (!text_equal(word, "\"\"")) {
            surface->user_file = word;
        }
    }
    if (known) {
        return true;
    }
    surface->user_aperture = NULL;
    surface->user_row_count = 0;
    surface->has_lost_aperture = true;
    return zemax_loss(file, line, LOSS_OF_VIGNETTING, "left out",
                      "%.4s: an aperture of a file with numbers beside its name",
                      line->keyword.start);
}

static bool zmx_glass(struct zemax_file *file, const struct zemax_line *whole)
{
    struct file_words words = file->words;
    struct text name = file_words_next(&file->words);
    if (name.length == 0) {
        return file_words_fail(&file->words, name, "the glass is missing");
    }
    struct zemax_line *line = zemax_line_of(file, name, NUMBER_UNSCALED);
    line->words = words;
    line->begin = whole->keyword;
    last_zmx_surface(file)->glass = line;
    return zemax_all_numbers(line);
}

static bool zmx_stop(struct zemax_file *file, const struct zemax_line *line)
{
    (void)line;
    last_zmx_surface(file)->is_stop = true;
    return true;
}

static bool read_comment(struct zemax_file *file, const struct zemax_line *line)
{
    (void)line;
    last_zmx_surface(file)->comment = file_words_rest(&file->words);
    return true;
}

/* A coating is kept as a note. */
static bool read_coating(struct zemax_file *file, const struct zemax_line *line)
{
    struct text rest = file_words_rest(&file->words);
    (void)line;
    lens_build_note(
        &file->build,
        text_of(arena_printf(file->job->arena, "coating of surface %zu: %.*s",
                             file->surface_count - 1, text_shown_up_to(rest, 200), rest.start)));
    return true;
}

/* PARM 1 .., XDAT 1 .., PPAR 1 ..: those beyond the last matter only where they are not 0. */
static bool read_numbered(struct zemax_file *file, const struct zemax_line *line)
{
    struct zemax_surface *surface = last_zmx_surface(file);
    const struct zemax_line **places = surface->parameters;
    double number = zemax_number(line, 0), most = ZEMAX_PARAMETERS;
    if (text_same(line->keyword, "XDAT")) {
        places = surface->extras;
        most = ZEMAX_EXTRAS;
    } else if (text_same(line->keyword, "PPAR")) {
        places = surface->pickups;
    }
    if (line->count < 2 || !(number >= 0 && number < 1e6)) {
        return file_words_fail(&file->words, line->keyword, "%.4s needs a number and a value",
                               line->keyword.start);
    }
    if (number >= most && zemax_number(line, 1) != 0) {
        return zemax_loss(file, line, LOSS_OF_RAYS, NULL,
                          "a parameter that no surface of lenscalc has");
    }
    places[number < most ? (size_t)number : 0] = line;
    return true;
}

/* SCBD which .. : what is shifted and turned before the surface (1) or behind it (2). */
static bool zmx_shift(struct zemax_file *file, const struct zemax_line *line)
{
    struct zemax_surface *surface = last_zmx_surface(file);
    const double which = zemax_number(line, 0);
    if (which == 1) {
        surface->shift_before = line;
    } else if (which == 2) {
        surface->shift_behind = line;
    } else {
        zemax_loss(file, line, LOSS_OF_RAYS, NULL,
                   "SCBD is of 1, before the surface, or of 2, behind it");
    }
    return true;
}

#define KEPT(member) ZEMAX_KEPT(zemax_surface, member)
static const struct zemax_keyword surface_keywords[] = {
    {"TYPE", ZEMAX_ANY_WORDS, false, KEPT(type), read_type},
    {"CURV", ZEMAX_A_NUMBER, false, KEPT(curvature), NULL},
    {"DISZ", ZEMAX_ANY_WORDS, true, KEPT(thickness), zmx_thickness},
    {"CONI", ZEMAX_A_NUMBER, false, KEPT(conic), NULL},
    {"DIAM", ZEMAX_A_NUMBER, true, KEPT(diameter), NULL},
    {"GLAS", ZEMAX_ANY_WORDS, false, 0, zmx_glass},
    {"STOP", ZEMAX_ANY_WORDS, false, 0, zmx_stop},
    {"COMM", ZEMAX_ANY_WORDS, false, 0, read_comment},
    {"COAT", ZEMAX_ANY_WORDS, false, 0, read_coating},
    {"PARM XDAT PPAR", ZEMAX_ALL_NUMBERS, false, 0, read_numbered},
    {"MAZH CHZH PZUP TCOM TOLE EDGE", ZEMAX_ALL_NUMBERS, false, KEPT(solve), NULL},
    {"CLAP SQAP ELAP OBSC SQOB ELOB SPID", ZEMAX_A_NUMBER, true, 0, zmx_aperture},
    {"FLAP", ZEMAX_A_NUMBER, true, 0, read_floating},
    {"USAP USOB UDAD", ZEMAX_ANY_WORDS, true, 0, read_user_aperture},
    {"OBDC", ZEMAX_ALL_NUMBERS, true, 0, read_aperture_shift},
    {"SCBD", ZEMAX_ALL_NUMBERS, false, 0, zmx_shift},
    {NULL, ZEMAX_ANY_WORDS, false, 0, NULL},
};

static const struct zemax_keyword *keyword_in(const struct zemax_keyword *table, struct text word)
{
    for (; table->words != NULL; table++) {
        if (word_list_find(table->words, word) != NULL) {
            return table;
        }
    }
    return NULL;
}

/*
 * The reader of the present line, of one of `in_surface` where it is of a surface. Lines of the
 * system begin the line, those of a surface do not.
 */
static const struct zemax_keyword *find_keyword(const struct zemax_file *file, struct text word,
                                                bool indented, bool *in_surface)
{
    const struct zemax_keyword *keyword = keyword_in(zemax_system_keywords, word);
    *in_surface = false;
    if (keyword == NULL && (!file->in_tail || indented)) {
        keyword = keyword_in(surface_keywords, word);
        *in_surface = keyword != NULL;
    }
    return keyword;
}

/* Read the present line; `owner`, the file or a surface, keeps it where the keyword says. */
static bool read_known_line(struct zemax_file *file, const struct zemax_keyword *keyword,
                            struct text word, void *owner)
{
    const struct zemax_line *line =
        zemax_line_of(file, word, keyword->is_length ? file->words.scale : NUMBER_UNSCALED);
    if (keyword->kept > 0) {
        *(const struct zemax_line **)((char *)owner + keyword->kept) = line;
    }
    if (keyword->wants != ZEMAX_ANY_WORDS &&
        !(keyword->wants == ZEMAX_A_NUMBER ? zemax_has_number(line) : zemax_all_numbers(line))) {
        return false;
    }
    return keyword->read == NULL || keyword->read(file, line);
}

/* Are there numbers on the line, and all of them 0? `first` receives the first that is not. */
static bool is_zero_line(const struct zemax_line *line, struct text *first)
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

/* A word that is not in the table. Where all its numbers are 0, it says that something is off. */
static bool read_unknown_line(struct zemax_file *file, struct text word, bool behind)
{
    const struct zemax_line *line = zemax_line_of(file, word, NUMBER_UNSCALED);
    int length = text_shown_up_to(word, 40);
    struct text at;
    double surface = zemax_number(line, 0), configuration = zemax_number(line, 1);
    const bool is_like_setting = file->has_configurations && line->count >= 2 && surface >= 0 &&
                                 surface < FOREIGN_MOST_SURFACES && configuration >= 1 &&
                                 configuration <= (double)file->configurations;
    if (behind && is_like_setting) {
        return zemax_read_setting(file, word);
    }
    /* Every line of the merit function is a word, two integers and six numbers. */
    if (behind && !file->has_configurations && line->keyword.length == 4 && line->count >= 8) {
        file->in_tail = true;
        return true;
    }
    if (!behind && is_zero_line(line, &at)) {
        *ARENA_ADD(file->job->arena, file->zeros, file->zero_count, file->zero_room) = line;
        return true;
    }
    return zemax_loss(file, line, LOSS_OF_RAYS, NULL, "unknown word '%.*s'", length, word.start);
}

/*
 * Unknown words whose numbers are all 0: flags that are off. If it were a solve, the file has its
 * answer as a number, but for one configuration only.
 */
static void pass_zeros(struct zemax_file *file)
{
    for (size_t i = 0; i < file->zero_count; i++) {
        const struct zemax_line *line = file->zeros[i];
        struct text word = line->keyword;
        int length = text_shown_up_to(word, 40);
        if (file->configurations > 1) {
            zemax_loss(file, line, LOSS_OF_RAYS, NULL, "unknown word '%.*s'", length, word.start);
        } else {
            zemax_remark(file, "line %ld: %.*s is unknown; its numbers are 0, it was passed over",
                         line->words.number, length, word.start);
        }
    }
}

/* What stands behind the surfaces and has no reader. */
static const struct word_group *group_behind(struct text word)
{
    const struct word_group *group = word_group_of(zemax_words, ZEMAX_IN_CONFIGURATIONS, word);
    return group != NULL ? group : word_group_of(zemax_words, ZEMAX_IN_TAIL, word);
}

static bool zmx_line(struct zemax_file *file)
{
    struct text word = file_words_next(&file->words);
    bool indented = word.start > file->words.line.start, in_surface = file->surface_count > 0;
    bool behind = in_surface && !indented;
    bool is_of_surface;
    const struct zemax_keyword *keyword = find_keyword(file, word, indented, &is_of_surface);
    const struct word_group *group = behind ? group_behind(word) : NULL;
    file->last_word = word;
    if (text_same(word, "SURF")) {
        return read_surf(file, zemax_line_of(file, word, NUMBER_UNSCALED));
    }
    if (is_of_surface && !in_surface) {
        return file_words_fail(&file->words, word, "'%.4s' stands before any surface",
                               word_list_find(keyword->words, word));
    }
    file->has_tail =
        file->has_tail || (behind && word_group_of(zemax_words, ZEMAX_IN_SURFACE, word) == NULL);
    if (behind && text_same(word, "MNUM")) {
        return zemax_read_configurations(file, zemax_line_of(file, word, NUMBER_UNSCALED));
    }
    if (keyword != NULL) {
        return read_known_line(file, keyword, word,
                               is_of_surface ? (void *)last_zmx_surface(file) : (void *)file);
    }
    if (group != NULL) {
        file->in_tail = true;
        return group->fate == WORD_HARMLESS || zemax_read_setting(file, word);
    }
    group = word_group_of(zemax_words, NULL, word);
    if (group != NULL) {
        /* A word of the table that has no reader. */
        const struct zemax_line *line = zemax_line_of(file, word, NUMBER_UNSCALED);
        struct text at;
        bool is_off = is_zero_line(line, &at) && (group->flags & WORD_COUNTS_AT_0) == 0;
        if (group->fate != WORD_HARMLESS && !is_off) {
            foreign_loss(file->job, &line->words, at, word_group_effect(group), NULL, "%.4s: %s",
                         word.start, group->what);
        }
        return true;
    }
    return read_unknown_line(file, word, behind);
}

/* What follows another surface, by its number in the file. */
static void lose_reference(struct zemax_file *file, const struct zemax_line **line)
{
    const struct zemax_line *lost = *line;
    *line = NULL;
    zemax_stands(file, lost,
                 "what follows another surface, in a file whose surface numbers have gaps");
}

/* Numbers of surfaces where some are left out: the places of the surfaces, or a loss. */
static void close_number_gaps(struct zemax_file *file)
{
    for (size_t i = 0; i < file->surface_count; i++) {
        /* Solves and pick-ups of a surface, in a file whose surface numbers have gaps. */
        struct zemax_surface *surface = &file->surfaces[i];
        bool follows = surface->solve != NULL && !text_same(surface->solve->keyword, "MAZH") &&
                       !text_same(surface->solve->keyword, "EDGE");
        if (follows) {
            lose_reference(file, &surface->solve);
        }
        for (size_t k = 0; k < ZEMAX_PARAMETERS; k++) {
            if (surface->pickups[k] != NULL) {
                lose_reference(file, &surface->pickups[k]);
            }
        }
        const struct zemax_line *curvature = surface->curvature;
        surface->has_free_curvature = zemax_number(curvature, 1) >= 2;
        if (surface->has_free_curvature) {
            lose_reference(file, &curvature);
        }
    }
    for (struct zemax_setting *one = file->settings; one != NULL; one = one->next) {
        size_t at = 0;
        while (at < file->surface_count && (long)file->surfaces[at].number != one->surface) {
            at++;
        }
        one->surface = (long)at;
    }
}

/* A picked-up glass is that of an earlier surface: GLAS name 2 surface .. */
static void pick_up_glasses(struct zemax_file *file)
{
    for (size_t i = 0; i < file->surface_count; i++) {
        const struct zemax_line *line = file->surfaces[i].glass;
        double from = file->has_gaps ? -1 : zemax_number(line, 1);
        if (zemax_number(line, 0) != 2) {
            continue;
        }
        if (!(from >= 0 && from < (double)i)) {
            zemax_loss(file, line, LOSS_OF_NOTHING, "the file's glass is kept",
                       "a glass that follows no earlier surface");
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
}

/*
 * A file of the program goes on behind its surfaces, and behind several configurations too. One
 * that does not may be whole: then its last surface, the image, has no glass.
 */
static bool check_zmx_end(struct zemax_file *file)
{
    const struct zemax_surface *image = last_zmx_surface(file);
    const bool has_last = text_same(file->last_word, "CSUM") || text_same(file->last_word, "MOFF");
    if (!file->has_tail && image->glass != NULL) {
        return zemax_fail(image->surf, image->surf->keyword,
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

bool zemax_parse(struct zemax_file *file, struct text content)
{
    if (!file_words_open(&file->words, file->job->source, content, file->job->arena, file->error)) {
        return false;
    }
    file->words.comment = NULL;
    file->configurations = 1;
    while (file_words_line(&file->words)) {
        struct file_words start = file->words;
        if (file_words_next(&start).length > 0 && !zmx_line(file)) {
            return false;
        }
    }
    if (file->surface_count < 3) {
        return foreign_fail(file->job, file->error,
                            "the file has no surface between object and image");
    }
    if (!check_zmx_end(file)) {
        return false;
    }
    pass_zeros(file);
    if (file->has_gaps) {
        close_number_gaps(file);
    }
    pick_up_glasses(file);
    return true;
}
