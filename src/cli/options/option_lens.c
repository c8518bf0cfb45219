/* cli/options/option_lens.c - read the values of lens commands. */
/* SPDX-License-Identifier: MIT */
#include "cli/options/option.h"

#include "data/lines.h"
#include "exchange/lens_open.h"
#include "optics/wavelength.h"

#include <sys/stat.h>

/* One of each position. */
static struct lens_memo *lens_memo_new(const struct lens *lens, struct arena *arena)
{
    const size_t positions = lens->position_count > 0 ? lens->position_count : 1;
    return ARENA_ARRAY(arena, positions, struct lens_memo);
}

static bool lens_value_find(const struct reader *reader, struct text name, struct arena *arena,
                            struct lens_value *value, struct error *error)
{
    struct lens *lens = ARENA_NEW(arena, struct lens);
    struct lens_warnings warnings;
    const char *warning = NULL;
    if (!lens_open(reader->db, name, arena, lens, error)) {
        return false;
    }
    if (!lens_check(lens, arena, &warnings, error)) {
        return error_prefix(error, "%.*s: ", text_shown(name), name.start);
    }
    for (size_t i = 0; i < warnings.count; i++) {
        warning =
            i == 0 ? warnings.texts[i] : arena_printf(arena, "%s; %s", warning, warnings.texts[i]);
    }
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
        .memo = lens_memo_new(lens, arena),
        .serial = reader->lenses != NULL ? ++reader->lenses->read : 0,
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

/* Keep one more, as long as there is room; `value` and all it points to live as long. */
static void option_lens_keep(struct lens_cache *cache, const struct lens_value *value)
{
    if (cache->lenses == NULL) {
        cache->lenses = ARENA_ARRAY(cache->arena, MOST_KEPT, struct lens_value);
    }
    if (cache->count < MOST_KEPT && known_lens(cache, text_of(value->name)) == NULL) {
        cache->lenses[cache->count++] = *value;
    }
}

void option_lens_lend(struct lens_cache *cache, const struct lens_value *value)
{
    struct lens_value lent = *value;
    lent.arena = cache->arena;
    lent.memo = lens_memo_new(value->lens, cache->arena);
    lent.serial = ++cache->read;
    option_lens_keep(cache, &lent);
}

/* The first lenses of a batch are kept; of more, each row reads its own. */
static bool read_lens_of_row(const struct reader *reader, struct text name,
                             struct lens_value *value, struct error *error)
{
    struct lens_cache *cache = reader->lenses;
    if (text_equal(name, "-")) {
        return fail(error, ERROR_USAGE, "a row cannot read its lens from standard input");
    }
    if (!lens_value_find(reader, name, reader->arena, value, error)) {
        return false;
    }
    if (cache->count == MOST_KEPT) {
        return true;
    }
    /* once more, now that it is good, to stay */
    if (!lens_value_find(reader, name, cache->arena, value, error)) {
        return false;
    }
    option_lens_keep(cache, value);
    return true;
}

void option_lens_at_once(struct lens_cache *cache, size_t count)
{
    if (count > cache->slot_count) {
        struct lens_slot *slots = ARENA_ARRAY(cache->arena, count, struct lens_slot);
        for (size_t i = 0; i < count; i++) {
            if (i < cache->slot_count) {
                slots[i] = cache->slots[i];
            } else {
                slots[i].arena = arena_within(cache->arena);
            }
        }
        cache->slots = slots;
        cache->slot_count = count;
    }
}

/* The slot that has this lens, else the one whose lens was wanted longest ago. */
static struct lens_slot *slot_of_lens(struct lens_cache *cache, struct text name)
{
    option_lens_at_once(cache, 1);
    struct lens_slot *oldest = &cache->slots[0];
    for (size_t i = 0; i < cache->slot_count; i++) {
        struct lens_slot *slot = &cache->slots[i];
        if (slot->value.lens != NULL && text_identical(name, text_of(slot->value.name))) {
            return slot;
        }
        oldest = slot->used < oldest->used ? slot : oldest;
    }
    arena_reset(&oldest->arena, (struct arena_mark){NULL, 0});
    oldest->value = (struct lens_value){.lens = NULL};
    return oldest;
}

static bool read_into_slot(const struct reader *reader, struct text name, struct lens_value *value,
                           struct error *error)
{
    struct lens_slot *slot = slot_of_lens(reader->lenses, name);
    slot->used = ++reader->lenses->wanted;
    if (slot->value.lens == NULL &&
        !lens_value_find(reader, name, &slot->arena, &slot->value, error)) {
        return false;
    }
    *value = slot->value;
    return true;
}

/* Does it say the same when it is read again, as a pipe does not? */
static bool is_lasting(struct text name, struct arena *arena)
{
    struct stat found;
    return !text_equal(name, "-") &&
           (stat(arena_string(arena, name.start, name.length), &found) != 0 ||
            S_ISREG(found.st_mode));
}

/* Of a list: beyond the first ones only the name stays. */
static bool read_lens_of_list(const struct reader *reader, struct text name,
                              struct lens_value *value, struct error *error)
{
    struct lens_cache *cache = reader->lenses;
    if (cache->count < MOST_KEPT || !is_lasting(name, reader->arena)) {
        if (!lens_value_find(reader, name, reader->arena, value, error)) {
            return false;
        }
        option_lens_keep(cache, value);
        return true;
    }
    if (!read_into_slot(reader, name, value, error)) {
        return false;
    }
    *value = (struct lens_value){.name = arena_string(reader->arena, name.start, name.length)};
    return true;
}

static bool read_lens(const struct reader *reader, const struct option *option, struct text text,
                      void *member, struct error *error)
{
    struct text name = text_trim(text);
    struct lens_cache *cache = reader->lenses;
    const bool is_of_row = cache != NULL && cache->arena != reader->arena;
    if (!is_of_row && (!reader->recalls || (option->flags & OPTION_MANY) == 0)) {
        return lens_value_find(reader, name, reader->arena, member, error);
    }
    const struct lens_value *known = known_lens(cache, name);
    if (known != NULL) {
        *(struct lens_value *)member = *known;
        return true;
    }
    return is_of_row ? read_lens_of_row(reader, name, member, error)
                     : read_lens_of_list(reader, name, member, error);
}

static bool recall_lens(const struct reader *reader, void *member, struct error *error)
{
    struct lens_value *value = member;
    return value->lens != NULL || value->name == NULL ||
           read_into_slot(reader, text_of(value->name), value, error);
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
                TYPED(option, name));
}

static bool wavelength_value_read(const struct reader *reader, const struct option *option,
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

const struct option_kind kind_lens = {
    .name = "lens",
    .size = sizeof(struct lens_value),
    .read = read_lens,
    .recall = recall_lens,
    OPTION_NAMED(struct lens_value, name),
    .reads = READS_LENSDB | READS_GLASSES | READS_LENSES,
};

const struct option_kind kind_wavelength = {
    .name = "wavelength",
    .size = sizeof(struct wavelength_value),
    .is_list = true,
    .read = wavelength_value_read,
    OPTION_NAMED(struct wavelength_value, name),
    .number_of = option_first_number,
    .reads = READS_LENSDB,
};

const struct option_kind kind_lens_text = {
    .name = "lens_text",
    .size = sizeof(struct lens_text_value),
    .read = read_lens_text,
    OPTION_NAMED(struct lens_text_value, source),
    .reads = READS_LENSDB | READS_GLASSES | READS_LENSES,
};
