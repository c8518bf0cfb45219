/* cli/option_lens.c - read the values of lens commands. */
/* SPDX-License-Identifier: MIT */
#include "cli/option_lens.h"

#include "cli/option.h"
#include "cli/option_spectrum.h"
#include "data/lines.h"
#include "exchange/lens_open.h"
#include "optics/wavelength.h"

static bool find_lens(struct lensdb *db, struct text name, struct arena *arena,
                      struct lens_value *value, struct error *error)
{
    struct lens *lens = ARENA_NEW(arena, struct lens);
    struct lens_warnings warnings;
    const char *warning = NULL;
    if (!lens_open(db, name, arena, lens, error)) {
        return false;
    }
    if (!lens_check(lens, arena, &warnings, error)) {
        return error_prefix(error, "%.*s: ", text_shown(name), name.start);
    }
    for (size_t i = 0; i < warnings.count; i++) {
        warning =
            i == 0 ? warnings.texts[i] : arena_printf(arena, "%s; %s", warning, warnings.texts[i]);
    }
    size_t positions = lens->position_count > 0 ? lens->position_count : 1;
    const char *called =
        text_equal(name, "-") ? "standard input" : arena_string(arena, name.start, name.length);
    if (lens->title == NULL) {
        lens->title = called; /* drawings and answers call every lens by a title */
    }
    *value = (struct lens_value){
        .lens = lens,
        .name = called,
        .warning = warning,
        .arena = arena,
        .memo = ARENA_ARRAY(arena, positions, struct lens_memo),
    };
    return true;
}

static const struct lens_value *known_lens(const struct lens_cache *cache, struct text name)
{
    for (size_t i = 0; i < cache->count; i++) {
        if (text_equal(name, cache->lenses[i].name)) {
            return &cache->lenses[i];
        }
    }
    return NULL;
}

enum { MOST_KEPT = 64 };

void option_lens_keep(struct lens_cache *cache, const struct lens_value *value)
{
    if (cache->lenses == NULL) {
        cache->lenses = ARENA_ARRAY(cache->arena, MOST_KEPT, struct lens_value);
    }
    if (cache->count < MOST_KEPT && known_lens(cache, text_of(value->name)) == NULL) {
        cache->lenses[cache->count++] = *value;
    }
}

/* The first lenses of a batch are kept; of more, each row reads its own. */
static bool read_lens_of_row(struct lensdb *db, struct lens_cache *cache, struct text name,
                             struct arena *arena, struct lens_value *value, struct error *error)
{
    const struct lens_value *known = known_lens(cache, name);
    if (known != NULL) {
        *value = *known;
        return true;
    }
    if (text_equal(name, "-")) {
        return fail(error, ERROR_USAGE, "a row cannot read its lens from standard input");
    }
    if (!find_lens(db, name, arena, value, error)) {
        return false;
    }
    if (cache->count == MOST_KEPT) {
        return true;
    }
    /* once more, now that it is good, to stay */
    if (!find_lens(db, name, cache->arena, value, error)) {
        return false;
    }
    option_lens_keep(cache, value);
    return true;
}

static bool read_lens(const struct reader *reader, const struct option *option, struct text text,
                      void *member, struct error *error)
{
    struct text name = text_trim(text);
    struct lens_cache *cache = reader->lenses;
    (void)option;
    return cache != NULL && cache->arena != reader->arena
               ? read_lens_of_row(reader->db, cache, name, reader->arena, member, error)
               : find_lens(reader->db, name, reader->arena, member, error);
}

static bool read_lens_text(const struct reader *reader, const struct option *option,
                           struct text text, void *member, struct error *error)
{
    struct lens_text_value value = {.db = reader->db, .arena = reader->arena};
    (void)option;
    if (!lens_open_text(reader->db, text_trim(text), reader->arena, &value.source, &value.content,
                        error)) {
        return false;
    }
    value.is_file = text_equal(text_trim(text), value.source);
    *(struct lens_text_value *)member = value;
    return true;
}

static const char *lens_text_name(const struct option *option, const void *member)
{
    (void)option;
    return ((const struct lens_text_value *)member)->source;
}

static const char *lens_name(const struct option *option, const void *member)
{
    (void)option;
    return ((const struct lens_value *)member)->name;
}

double wavelength_micrometres(double millimetres)
{
    char text[NUMBER_LENGTH];
    double wavelength;
    const char *end =
        quantity_write(text, millimetres, unit_find(&dimension_length, text_of("nm")));
    number_read(text, end, (struct number_scale){1, -3}, &wavelength);
    return wavelength;
}

double wavelength_millimetres(double micrometres)
{
    char text[NUMBER_LENGTH];
    double wavelength;
    const char *end = number_write_shortest(text, micrometres);
    number_read(text, end, (struct number_scale){1, -3}, &wavelength);
    return wavelength;
}

bool wavelength_read(const struct reader *reader, const struct option *option, struct text text,
                     double *wavelength, struct error *error)
{
    struct text name = text_trim(text);
    bool is_line;
    if (!lines_find(reader->db, name, (struct number_scale){1, -3}, &is_line, wavelength, error)) {
        return false;
    }
    if (!is_line &&
        !quantity_read(text, option->dimension, option_unit(option), wavelength, NULL, error)) {
        error_prefix(error, "bad wavelength in %s: ", CALLED(option));
        return error_hint(error, "a wavelength is 550, 550nm, 0.55um, or a line: d F C e g ...");
    }
    return (*wavelength >= WAVELENGTH_SHORTEST && *wavelength <= WAVELENGTH_LONGEST) ||
           fail(error, ERROR_DOMAIN, "%s %.*s is out of range: it must be 1 nm to 100 mm",
                CALLED(option), text_shown(name), name.start);
}

static bool read_wavelength(const struct reader *reader, const struct option *option,
                            struct text text, void *member, struct error *error)
{
    struct text name = text_trim(text);
    struct wavelength_value value = {.name = arena_string(reader->arena, name.start, name.length)};
    if (!wavelength_read(reader, option, text, &value.wavelength, error)) {
        return false;
    }
    *(struct wavelength_value *)member = value;
    return true;
}

static double wavelength_number(const void *member)
{
    return ((const struct wavelength_value *)member)->wavelength;
}

static const char *wavelength_name(const struct option *option, const void *member)
{
    (void)option;
    return ((const struct wavelength_value *)member)->name;
}

const struct option_kind kind_lens = {
    .name = "lens",
    .size = sizeof(struct lens_value),
    .read = read_lens,
    .name_of = lens_name,
    .reads = READS_LENSDB | READS_GLASSES | READS_LENSES,
};

const struct option_kind kind_wavelength = {
    .name = "wavelength",
    .size = sizeof(struct wavelength_value),
    .is_list = true,
    .read = read_wavelength,
    .name_of = wavelength_name,
    .number_of = wavelength_number,
    .reads = READS_LENSDB,
};

const struct option_kind kind_lens_text = {
    .name = "lens_text",
    .size = sizeof(struct lens_text_value),
    .read = read_lens_text,
    .name_of = lens_text_name,
    .reads = READS_LENSDB | READS_GLASSES | READS_LENSES,
};
