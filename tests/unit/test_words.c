/* tests/unit/test_words.c - every word of other programs' files does what its table says. */
/* SPDX-License-Identifier: MIT */
#include "exchange/word_table.h"
#include "foreign_cases.h"

/* A file of each format, with the line behind which a word of this place stands. */
static const struct place {
    const char *format, *place, *source, *good, *before, *indent;
} places[] = {
#define ZEMAX                                                                                      \
    "MODE SEQ\nUNIT MM\nENPD 10\nSURF 0\n  DISZ INFINITY\nSURF 1\n  STOP\n  CURV 0.02\n  DISZ 4\n" \
    "  GLAS ___BLANK 1 0 1.5 0\nSURF 2\n  DISZ 90\nSURF 3\n  DISZ 0\nMNUM 2 1\nTHIC 2 1 90\n"      \
    "THIC 2 2 90\n"
    {"zmx", "system", "w.zmx", ZEMAX, "UNIT MM\n", ""},
    {"zmx", "surface", "w.zmx", ZEMAX, "  CURV 0.02\n", "  "},
    {"zmx", "configurations", "w.zmx", ZEMAX, "THIC 2 2 90\n", ""},
    {"zmx", "behind", "w.zmx", ZEMAX, "SURF 3\n  DISZ 0\n", ""},
#define CODEV                                                                                      \
    "RDM\nLEN\nDIM M\nEPD 10\nWL 587.6\nSO 0 1e20\nS 50 4 1.5:60\nSTO\nS 0 90\nSI 0 0\nGO\n"
    {"seq", "system", "w.seq", CODEV, "DIM M\n", ""},
    {"seq", "surface", "w.seq", CODEV, "STO\n", ""},
#define OSLO                                                                                       \
    "LEN NEW \"w\"\nEBR 5\nUNI 1\nAIR\nTH 1e20\nAP 1e3\nNXT\nGLA MOD 1.5 60\nRD 50\nTH 4\nAST\n"   \
    "NXT\nAIR\nTH 90\nNXT\nAIR\nWV 0.5876\nEND\n"
    {"len", "system", "w.len", OSLO, "EBR 5\n", ""},
    {"len", "surface", "w.len", OSLO, "RD 50\n", ""},
    {"len", "behind", "w.len", OSLO, "END\n", ""},
};

static const struct place *place_of(const char *format, const char *name)
{
    for (size_t i = 0; i < sizeof places / sizeof places[0]; i++) {
        if (strcmp(places[i].format, format) == 0 && strcmp(places[i].place, name) == 0) {
            return &places[i];
        }
    }
    return NULL;
}

/* The lens with a line behind `before`, as a .lens file; empty where it is refused. */
static struct text read_with(struct fixture *fixture, const struct place *place, const char *line,
                             bool lossy)
{
    long number;
    int column;
    fixture_open(fixture, place->source);
    fixture->job.lossy = lossy;
    const char *now = arena_printf(&fixture->arena, "%s%s", place->before, line);
    struct text file = case_file(fixture, place->good, place->before, now, &number, &column);
    return foreign_read(&fixture->job, file, &fixture->lens, &fixture->error)
               ? lens_write(&fixture->lens, &fixture->arena)
               : text_of("");
}

static bool is_same(struct text a, struct text b)
{
    return a.length == b.length && a.length > 0 && memcmp(a.start, b.start, a.length) == 0;
}

/* What a harmless word says changes no lens, and nobody hears of it. */
static void check_harmless(const struct place *place, struct text word, struct text plain)
{
    static const char *const values[] = {"", " 1", " 1 2 3", " 2 1 0.5", " 0 0", " text"};
    for (size_t i = 0; i < sizeof values / sizeof values[0]; i++) {
        struct fixture fixture;
        char line[100];
        snprintf(line, sizeof line, "%s%.*s%s\n", place->indent, (int)word.length, word.start,
                 values[i]);
        struct text lens = read_with(&fixture, place, line, false);
        if (!is_same(lens, plain)) {
            printf("%s: %s    %s\n%.*s\n", place->source, line, fixture.error.message,
                   (int)lens.length, lens.start);
        }
        CHECK(is_same(lens, plain) && fixture.job.loss_count == 0);
        arena_free(&fixture.arena);
    }
}

/* A lost word is refused, at its line; with --lossy it is one loss. Of two positions it differs. */
static void check_lost(const struct place *place, const struct word_entry *entry)
{
    struct fixture strict, lossy;
    bool in_positions = strcmp(place->place, "configurations") == 0;
    char line[200];
    int length = (int)entry->word.length;
    const char *word = entry->word.start;
    bool has_many = strcmp(place->format, "zmx") == 0;
    snprintf(line, sizeof line,
             in_positions ? "%s%.*s 1 1 2\n%.*s 1 2 3\n"
             : has_many   ? "%s%.*s 1.5 2\n"
                          : "%s%.*s 1.5\n",
             place->indent, length, word, length, word);
    struct text refused = read_with(&strict, place, line, false);
    struct text read = read_with(&lossy, place, line, true);
    bool good = refused.length == 0 && strict.error.code == ERROR_DATA && strict.error.line > 0 &&
                strstr(strict.error.message, "cannot be kept") != NULL && read.length > 0 &&
                lossy.job.loss_count > 0;
    bool vignettes = (entry->group->flags & WORD_VIGNETTES) != 0;
    good = good && (in_positions || vignettes == (lossy.job.losses[0].effect != LOSS_OF_RAYS));
    if (!good) {
        printf("%s: %s    strict: %s\n    lossy: %s, %zu losses\n", place->source, line,
               strict.error.message, lossy.error.message, lossy.job.loss_count);
    }
    CHECK(good);
    arena_free(&strict.arena);
    arena_free(&lossy.arena);
}

static void check_refused(const struct place *place, struct text word)
{
    struct fixture fixture;
    char line[100];
    snprintf(line, sizeof line, "%.*s 1\n", (int)word.length, word.start);
    struct text lens = read_with(&fixture, place, line, true);
    CHECK(lens.length == 0 && fixture.error.code == ERROR_DATA);
    arena_free(&fixture.arena);
}

/* A word that is kept is read: it is neither unknown nor lost by its name. */
static void check_kept(const struct place *place, struct text word)
{
    struct fixture fixture;
    char line[100];
    snprintf(line, sizeof line, "%s%.*s 1\n", place->indent, (int)word.length, word.start);
    read_with(&fixture, place, line, true);
    for (size_t i = 0; i < fixture.job.loss_count; i++) {
        bool unknown = strstr(fixture.job.losses[i].what, "unknown") != NULL;
        if (unknown) {
            printf("%s: %s    %s\n", place->source, line, fixture.job.losses[i].what);
        }
        CHECK(!unknown);
    }
    CHECK(strstr(fixture.error.message, "unknown") == NULL);
    arena_free(&fixture.arena);
}

static void check_table(const struct foreign_format *format)
{
    size_t count = 0;
    struct word_entry entry = {format->words, {NULL, 0}};
    for (; word_table_next(&entry); count++) {
        const struct place *place = place_of(format->type.word.word, entry.group->place);
        struct fixture fixture;
        CHECK(place != NULL && entry.word.length > 0);
        if (place == NULL) {
            continue;
        }
        struct text plain = read_with(&fixture, place, "", false);
        CHECK(plain.length > 0);
        switch (entry.group->fate) {
        case WORD_HARMLESS:
            check_harmless(place, entry.word, plain);
            break;
        case WORD_LOST:
            check_lost(place, &entry);
            break;
        case WORD_REFUSED:
            check_refused(place, entry.word);
            break;
        default:
            check_kept(place, entry.word);
        }
        arena_free(&fixture.arena);
    }
    CHECK(count > 50);
}

/* No word stands twice in one place with two fates. */
static void check_once(const struct foreign_format *format)
{
    struct word_entry entry = {format->words, {NULL, 0}};
    while (word_table_next(&entry)) {
        CHECK(word_group_of(format->words, entry.group->place, entry.word) == entry.group);
    }
}

int main(void)
{
    size_t tables = 0;
    for (const struct foreign_format *const *one = foreign_formats; *one != NULL; one++) {
        if ((*one)->words != NULL) {
            check_table(*one);
            check_once(*one);
            tables++;
        }
    }
    CHECK(tables == 3);
    return check_report();
}
