/* file/lens_file.c - the lines of a .lens file. */
/* SPDX-License-Identifier: MIT */
#include "file/lens_file.h"

#include "file/lens_mark.h"
#include "file/lens_pickup.h"
#include "file/lens_setting.h"
#include "file/lens_surface.h"
#include "file/lens_tolerance.h"
#include "file/lens_unit.h"
#include "file/lens_words.h"

#include <math.h>

const struct file_type lens_file_type = {{"lens", "lenscalc's own"}, ".lens"};

/* Lines that are read when all surfaces are there, in this order. */
enum lens_file_kept { KEPT_SETTING, KEPT_PICKUP, KEPT_TOLERANCE, KEPT_KINDS };

/* A file being read. Arrays grow by doubling in the arena. */
struct parser {
    struct file_words words;
    int what; /* of the present keyword, which tells relatives apart */
    struct lens *lens;
    const struct glass_source *glasses;
    size_t surface_room, note_room, aperture_room;
    struct lens_variables variables;
    const struct displacement *coordinate_break; /* of the next surface */
    struct text aperture_word;                   /* where it was named, and in which line */
    struct file_words aperture_line;
    struct lines {
        struct file_words *all;
        size_t count, room;
    } kept[KEPT_KINDS]; /* lines, from behind their first word on */
    unsigned given;     /* keywords that may stand once */
};

/* Report something wrong with a word of the present line. False */
#define parser_fail(parser, word, ...) file_words_fail(&(parser)->words, (word), __VA_ARGS__)

static const char *rest_string(struct parser *parser)
{
    struct text rest = file_words_rest(&parser->words);
    return arena_string(parser->words.arena, rest.start, rest.length);
}

enum lens_file_text { TEXT_TITLE, TEXT_SOURCE, TEXT_KIND };

static bool lens_file_read_text(struct parser *parser)
{
    const char **const texts[] = {[TEXT_TITLE] = &parser->lens->title,
                                  [TEXT_SOURCE] = &parser->lens->source,
                                  [TEXT_KIND] = &parser->lens->kind};
    *texts[parser->what] = rest_string(parser);
    return true;
}

static bool lens_file_read_note(struct parser *parser)
{
    struct lens *lens = parser->lens;
    *ARENA_ADD(parser->words.arena, lens->notes, lens->note_count, parser->note_room) =
        rest_string(parser);
    return true;
}

static bool lens_file_read_unit(struct parser *parser)
{
    struct text word = file_words_next(&parser->words);
    const char *unit = lens_unit_named(word);
    if (parser->lens->surface_count > 0 || parser->given > 1) {
        return parser_fail(parser, word, "the unit must come before all lengths");
    }
    if (unit == NULL) {
        return parser_fail(parser, word, "the unit is one of mm, cm, m, in");
    }
    parser->words.scale = lens_unit_scale(unit);
    parser->lens->unit = unit;
    return file_words_end(&parser->words);
}

static bool read_wavelengths(struct parser *parser)
{
    struct lens *lens = parser->lens;
    struct file_words *words = &parser->words;
    size_t room = 0;
    for (struct text word = file_words_next(words); word.length > 0 || lens->wavelength_count == 0;
         word = file_words_next(words)) {
        if (!lens_words_light(
                words, word,
                ARENA_ADD(words->arena, lens->wavelengths, lens->wavelength_count, room))) {
            return false;
        }
    }
    return true;
}

/* A distance of the object: positive, or inf. */
static bool read_object_gap(struct parser *parser, struct text word, struct figure *figure)
{
    if (text_equal(word, "inf")) {
        *figure = (struct figure){{INFINITY, 0}, word, LENS_NONE};
        return true;
    }
    if (!lens_words_figure(&parser->words, word, parser->words.scale, "object's distance",
                           figure)) {
        return false;
    }
    return figure->value.hi > 0 ||
           parser_fail(parser, word,
                       "the object's distance is counted to the left: it is above 0, or inf");
}

/* `object 100 telecentric`, `let object telecentric 100 200`. */
static void take_telecentric(struct parser *parser)
{
    const struct file_words before = parser->words;
    if (text_equal(file_words_next(&parser->words), "telecentric")) {
        parser->lens->is_telecentric = true;
    } else {
        parser->words = before;
    }
}

static bool read_object_line(struct parser *parser)
{
    struct lens *lens = parser->lens;
    if (!read_object_gap(parser, file_words_next(&parser->words), &lens->object)) {
        return false;
    }
    lens->object_is_infinite = isinf(lens->object.value.hi);
    take_telecentric(parser);
    return file_words_end(&parser->words);
}

static bool read_object_glass(struct parser *parser)
{
    if (parser->lens->surface_count > 0) {
        return parser_fail(parser, parser->words.line,
                           "the object's medium must come before the surfaces");
    }
    struct medium *medium = &parser->lens->object_medium;
    return lens_words_medium(&parser->words, file_words_next(&parser->words), medium) &&
           lens_words_glass(&parser->words, parser->glasses, medium) &&
           file_words_end(&parser->words);
}

static bool read_fields_line(struct parser *parser)
{
    static const struct {
        const char *name;
        enum field_kind kind;
    } kinds[] = {{"angle", FIELD_ANGLE},
                 {"height", FIELD_HEIGHT},
                 {"image", FIELD_IMAGE},
                 {"real", FIELD_REAL}};
    struct lens *lens = parser->lens;
    struct text word = file_words_next(&parser->words);
    for (size_t i = 0; i < sizeof kinds / sizeof kinds[0]; i++) {
        if (text_equal(word, kinds[i].name)) {
            lens->field_kind = kinds[i].kind;
        }
    }
    if (lens->field_kind == FIELD_NONE) {
        return parser_fail(parser, word,
                           "a field is an angle, an object's height, or that of its paraxial "
                           "or real image: angle, height, image or real");
    }
    return lens_words_fields(&parser->words, lens->field_kind, &lens->fields, &lens->field_count);
}

static const struct {
    const char *name;
    enum aperture_kind kind;
} aperture_words[] = {{"stop", APERTURE_STOP}, {"epd", APERTURE_EPD}, {"na", APERTURE_NA}};

/* `f/2`, or `epd`, `na`, `stop` with what follows them. */
static bool read_aperture_value(struct parser *parser, struct text word, struct figure *figure,
                                enum aperture_kind *kind)
{
    struct file_words *words = &parser->words;
    for (size_t i = 0; i < sizeof aperture_words / sizeof aperture_words[0]; i++) {
        if (text_equal(word, aperture_words[i].name)) {
            *kind = aperture_words[i].kind;
            word = *kind != APERTURE_STOP ? file_words_next(words) : word;
        }
    }
    if (*kind == APERTURE_STOP) {
        *figure = (struct figure){.typed = word, .variable = LENS_NONE};
        return true;
    }
    if (word.length > 2 && word.start[0] == 'f' && word.start[1] == '/' &&
        (*kind == APERTURE_NONE || *kind == APERTURE_FNUMBER)) {
        *kind = APERTURE_FNUMBER;
        word = (struct text){word.start + 2, word.length - 2};
    } else if (*kind == APERTURE_NONE || *kind == APERTURE_FNUMBER) {
        return parser_fail(parser, word, "an aperture is stop, f/2, epd 50 or na 0.25");
    }
    if (!lens_words_figure(words, word, *kind == APERTURE_EPD ? words->scale : NUMBER_UNSCALED,
                           "aperture", figure)) {
        return false;
    }
    return figure->value.hi > 0 || parser_fail(parser, word, "the aperture must be above 0");
}

static bool read_lens_aperture(struct parser *parser)
{
    parser->aperture_word = file_words_next(&parser->words);
    parser->aperture_line = parser->words;
    if (!read_aperture_value(parser, parser->aperture_word, &parser->lens->aperture,
                             &parser->lens->aperture_kind)) {
        return false;
    }
    struct file_words behind = parser->words;
    if (parser->lens->aperture_kind != APERTURE_STOP &&
        text_equal(file_words_next(&behind), "real")) {
        parser->lens->stop_is_real = true;
        parser->words = behind;
    }
    return file_words_end(&parser->words);
}

static bool read_focus_line(struct parser *parser)
{
    static const char *const names[] = {"paraxial", "table", "best", "afocal"};
    struct text word = file_words_next(&parser->words);
    for (int i = 0; i < FOCUS_KINDS; i++) {
        if (text_equal(word, names[i])) {
            parser->lens->focus = (enum focus_kind)i;
            return file_words_end(&parser->words);
        }
    }
    return parser_fail(parser, word, "the focus is paraxial, table, best or afocal");
}

static bool read_position_names(struct parser *parser)
{
    struct lens *lens = parser->lens;
    struct file_words *words = &parser->words;
    size_t room = 0;
    for (struct text word = file_words_next(words); word.length > 0 || lens->position_count == 0;
         word = file_words_next(words)) {
        if (word.length == 0 || text_equal(word, "all") ||
            lens_position_find(lens, word) != LENS_NONE) {
            return parser_fail(parser, word, "%s",
                               word.length == 0
                                   ? "the positions have no names"
                                   : "a position's name that cannot be used: twice, or 'all'");
        }
        *ARENA_ADD(words->arena, lens->positions, lens->position_count, room) =
            arena_string(words->arena, word.start, word.length);
    }
    return true;
}

static bool line_count_check(struct parser *parser, struct text name, size_t count)
{
    return count == parser->lens->position_count ||
           parser_fail(parser, name, "%zu numbers for %zu positions", count,
                       parser->lens->position_count);
}

static bool let_apertures(struct parser *parser, struct text name)
{
    struct lens *lens = parser->lens;
    struct figure *values = ARENA_ARRAY(parser->words.arena, lens->position_count, struct figure);
    struct text word = file_words_next(&parser->words);
    size_t count = 0;
    lens->aperture_kind = APERTURE_NONE;
    for (; word.length > 0 && count < lens->position_count; count++) {
        if (text_equal(word, "stop") ||
            !read_aperture_value(parser, word, &values[count], &lens->aperture_kind)) {
            return text_equal(word, "stop")
                       ? parser_fail(parser, word,
                                     "give the stop's diameter in every position by a "
                                     "variable in its line")
                       : false;
        }
        word = file_words_next(&parser->words);
    }
    lens->apertures = values;
    if (count == lens->position_count && text_equal(word, "real")) {
        lens->stop_is_real = true;
        word = file_words_next(&parser->words);
    }
    return line_count_check(parser, name, count + (word.length > 0));
}

static bool read_let(struct parser *parser)
{
    struct lens *lens = parser->lens;
    struct text name = file_words_next(&parser->words);
    if (lens->position_count == 0) {
        return parser_fail(parser, name, "'let' needs a line with 'position' before it");
    }
    if (text_equal(name, "object")) {
        struct figure *values =
            ARENA_ARRAY(parser->words.arena, lens->position_count, struct figure);
        size_t given = 0;
        take_telecentric(parser);
        struct text word = file_words_next(&parser->words);
        for (; word.length > 0 && given < lens->position_count; given++) {
            if (!read_object_gap(parser, word, &values[given])) {
                return false;
            }
            word = file_words_next(&parser->words);
        }
        lens->objects = values;
        return line_count_check(parser, name, given + (word.length > 0));
    }
    if (text_equal(name, "aperture")) {
        return let_apertures(parser, name);
    }
    if (name.length == 0 || (name.start[0] | 32) < 'a' || (name.start[0] | 32) > 'z') {
        return parser_fail(parser, name, "the name of a variable is missing");
    }
    size_t index = lens_variable_find(&parser->variables, &parser->words, name), count;
    struct lens_variable *variable = &lens->variables[index];
    if (variable->values != NULL) {
        return parser_fail(parser, name, "'%.*s' has its numbers already", text_shown(name),
                           name.start);
    }
    return lens_let_read(&parser->words, lens->position_count, variable, &count) &&
           line_count_check(parser, name, count);
}

static bool keep_line(struct parser *parser)
{
    struct lines *lines = &parser->kept[parser->what];
    *ARENA_ADD(parser->words.arena, lines->all, lines->count, lines->room) = parser->words;
    return true;
}

static bool lens_file_read_goal(struct parser *parser)
{
    return lens_goal_read(&parser->words, parser->lens);
}

static bool read_stated(struct parser *parser)
{
    static const char *const names[STATED_COUNT] = {"efl", "bfl", "fnumber", "tstop"};
    struct lens *lens = parser->lens;
    struct file_words *words = &parser->words;
    struct text word = file_words_next(words);
    for (int i = 0; i < STATED_COUNT; i++) {
        if (!text_equal(word, names[i])) {
            continue;
        }
        struct figure *values;
        if (!lens_words_figures(words, stated_is_length(i) ? words->scale : NUMBER_UNSCALED,
                                names[i], &values, &lens->stated_count[i])) {
            return false;
        }
        lens->stated[i] = values;
        size_t count = lens->stated_count[i];
        return count == 1 || line_count_check(parser, word, count);
    }
    return parser_fail(parser, word, "what is stated is efl, bfl, fnumber or tstop");
}

/* One surface more, with the coordinate break before it. */
static bool read_surface_line(struct parser *parser)
{
    struct lens *lens = parser->lens;
    struct text word = {parser->words.line.start, 0};
    size_t last = lens->surface_count;
    if (last > 0 && !lens->surfaces[last - 1].has_thickness) {
        return parser_fail(parser, word, "a surface after one without a thickness");
    }
    if (last == LENS_MOST_SURFACES) {
        return parser_fail(parser, word, "more than %d surfaces", LENS_MOST_SURFACES);
    }
    lens->surfaces = arena_grow(parser->words.arena, lens->surfaces, last, &parser->surface_room,
                                sizeof lens->surfaces[0]);
    struct surface *surface = &lens->surfaces[last];
    if (!lens_surface_read(&parser->words, (enum surface_kind)parser->what,
                           last > 0 ? &surface[-1].medium : &lens->object_medium,
                           &parser->variables, surface) ||
        !lens_words_glass(&parser->words, parser->glasses, &surface->medium)) {
        return false;
    }
    surface->coordinate_break = parser->coordinate_break;
    parser->coordinate_break = NULL;
    parser->aperture_room = 0;
    lens->surface_count++;
    if (surface->is_stop) {
        if (lens->stop != LENS_NONE) {
            return parser_fail(parser, word, "a second stop: surface %zu is one already",
                               lens->stop + 1);
        }
        lens->stop = last;
    }
    return true;
}

/* `thin`: the two principal planes are one. */
static bool read_thin_line(struct parser *parser)
{
    if (!read_surface_line(parser)) {
        return false;
    }
    const struct surface *surface = &parser->lens->surfaces[parser->lens->surface_count - 1];
    const struct text hiatus = surface->hiatus.typed;
    if (hiatus.start != NULL) {
        parser_fail(parser, hiatus, "a thin lens has no hiatus");
        return error_hint(parser->words.error, "a lens with one is 'thick'");
    }
    return true;
}

/* `pass` and `block` */
static bool read_aperture_line(struct parser *parser)
{
    struct lens *lens = parser->lens;
    bool is_below = lens->surface_count > 0 && parser->coordinate_break == NULL;
    return lens_aperture_read(&parser->words, parser->what != 0,
                              is_below ? &lens->surfaces[lens->surface_count - 1] : NULL,
                              &parser->aperture_room);
}

static bool read_coordinate_break(struct parser *parser)
{
    if (parser->coordinate_break != NULL) {
        return parser_fail(parser, parser->words.line, "two coordinate breaks before one surface");
    }
    return lens_coordinate_break_read(&parser->words, &parser->coordinate_break);
}

/* The bits of those that may stand once; unit is the first, so that it sees what came before. */
static const struct {
    const char *word;
    unsigned once;
    bool (*read)(struct parser *parser);
    int what; /* tells relatives apart */
} keywords[] = {
    {"unit", 1, lens_file_read_unit, 0},
    {"object", 2, read_object_line, 0},
    {"field", 4, read_fields_line, 0},
    {"aperture", 8, read_lens_aperture, 0},
    {"lens", 0, lens_file_read_text, TEXT_TITLE},
    {"source", 0, lens_file_read_text, TEXT_SOURCE},
    {"kind", 0, lens_file_read_text, TEXT_KIND},
    {"note", 0, lens_file_read_note, 0},
    {"wavelength", 0, read_wavelengths, 0},
    {"focus", 0, read_focus_line, 0},
    {"medium", 0, read_object_glass, 0},
    {"position", 0, read_position_names, 0},
    {"let", 0, read_let, 0},
    {"set", 0, keep_line, KEPT_SETTING},
    {"pickup", 0, keep_line, KEPT_PICKUP},
    {"goal", 0, lens_file_read_goal, 0},
    {"tolerance", 0, keep_line, KEPT_TOLERANCE},
    {"stated", 16, read_stated, 0},
    {"surface", 0, read_surface_line, SURFACE_REFRACT},
    {"stop", 0, read_surface_line, SURFACE_STOP},
    {"thick", 0, read_surface_line, SURFACE_THICK},
    {LENS_THIN_WORD, 0, read_thin_line, SURFACE_THICK},
    {"bend", 0, read_coordinate_break, 0},
    {"pass", 0, read_aperture_line, false},
    {"block", 0, read_aperture_line, true},
};

static bool lens_file_read_line(struct parser *parser)
{
    const struct text word = file_words_next(&parser->words);
    size_t i = 0, count = sizeof keywords / sizeof keywords[0];
    while (i < count && !text_equal(word, keywords[i].word)) {
        i++;
    }
    if (i == count) {
        /* Not the beginning of a line: one of the table may have been meant. */
        struct nearest nearest = {.typed = word};
        for (size_t k = 0; k < count; k++) {
            nearest_offer(&nearest, text_of(keywords[k].word));
        }
        parser_fail(parser, word, "unknown word '%.*s'", text_shown(word), word.start);
        return nearest.best.start != NULL &&
               error_hint(parser->words.error, "did you mean '%.*s'?", (int)nearest.best.length,
                          nearest.best.start);
    }
    bool twice = (keywords[i].once & parser->given) != 0 && keywords[i].once != 16;
    twice = twice || (text_equal(word, "lens") && parser->lens->title != NULL) ||
            (keywords[i].read == read_wavelengths && parser->lens->wavelength_count > 0) ||
            (keywords[i].read == read_position_names && parser->lens->position_count > 0);
    if (twice) {
        return parser_fail(parser, word, "'%s' stands here twice", keywords[i].word);
    }
    parser->given |= keywords[i].once;
    parser->what = keywords[i].what;
    return keywords[i].read(parser);
}

/* What only the whole file shows. */
static bool lens_file_finish(struct parser *parser)
{
    struct lens *lens = parser->lens;
    if (lens->surface_count == 0) {
        return fail_in(parser->words.error, parser->words.source, 0, 0, "the file has no surface");
    }
    for (size_t i = 0; i < lens->variable_count; i++) {
        if (!lens_let_check(&parser->variables.lines[i], lens, i)) {
            return false;
        }
    }
    if (lens->aperture_kind == APERTURE_STOP && lens->stop == LENS_NONE) {
        return file_words_fail(&parser->aperture_line, parser->aperture_word,
                               "'aperture stop' needs a stop, and the lens has none");
    }
    for (int kind = 0; kind < KEPT_KINDS; kind++) {
        for (size_t i = 0; i < parser->kept[kind].count; i++) {
            struct file_words *line = &parser->kept[kind].all[i];
            if ((kind == KEPT_SETTING && !lens_setting_read(line, parser->glasses, lens)) ||
                (kind == KEPT_PICKUP && !lens_pickup_read(line, lens)) ||
                (kind == KEPT_TOLERANCE && !lens_tolerance_read(line, lens))) {
                return false;
            }
        }
    }
    lens_pickups_begin(lens, parser->words.arena);
    return true;
}

bool lens_read(const char *source, struct text content, const struct glass_source *glasses,
               struct arena *arena, struct lens *lens, struct error *error)
{
    struct parser parser = {.lens = lens, .glasses = glasses, .variables.lens = lens};
    *lens = (struct lens){.unit = lens_units[0].word,
                          .object_is_infinite = true,
                          .object = {{INFINITY, 0}, {NULL, 0}, LENS_NONE},
                          .object_medium = medium_air,
                          .stop = LENS_NONE};
    if (!file_words_open(&parser.words, source, content, arena, error) ||
        !file_words_plain(source, content, error)) {
        return false;
    }
    while (file_words_line(&parser.words)) {
        if (!lens_file_read_line(&parser)) {
            return false;
        }
    }
    return lens_file_finish(&parser);
}
