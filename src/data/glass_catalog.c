/* data/glass_catalog.c - glasses by name: the embedded catalogues and the user's own. */
/* SPDX-License-Identifier: MIT */
#include "data/glass_catalog.h"

#include "base/number.h"
#include "data/agf.h"
#include "data/embedded.h"
#include "data/glass_alias.h"
#include "data/glass_table.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

static const char FOLDER[] = "glass/", ENDING[] = ".tsv";

/* "SCHOTT" of "glass/SCHOTT.tsv"; empty for another file. */
static struct text catalog_of(const char *file)
{
    size_t length = strlen(file), around = strlen(FOLDER) + strlen(ENDING);
    if (length <= around || strncmp(file, FOLDER, strlen(FOLDER)) != 0 ||
        !text_same(text_of(file + length - strlen(ENDING)), ENDING)) {
        return (struct text){"", 0};
    }
    return (struct text){file + strlen(FOLDER), length - around};
}

/* Go to the catalogues of one place. */
static bool enter_place(struct glass_catalogs *catalogs, enum lensdb_place place,
                        struct error *error)
{
    catalogs->place = place;
    catalogs->is_open = false;
    if (place == LENSDB_EMBEDDED) {
        /* The embedded catalogues. */
        size_t count = 0;
        for (const struct embedded_file *at = embedded_files; at->name != NULL; at++) {
            count += catalog_of(at->name).length > 0;
        }
        const char **names = ARENA_ARRAY(catalogs->arena, count + 1, const char *);
        count = 0;
        for (const struct embedded_file *at = embedded_files; at->name != NULL; at++) {
            if (catalog_of(at->name).length > 0) {
                names[count++] = at->name;
            }
        }
        catalogs->names = names;
        return true;
    }
    return lensdb_list(catalogs->db, "glass", ENDING, false, &catalogs->names, error);
}

bool glass_catalogs_open(struct glass_catalogs *catalogs, struct lensdb *db, struct arena *arena,
                         bool complete, struct error *error)
{
    *catalogs = (struct glass_catalogs){.db = db, .arena = arena, .complete = complete};
    error->code = ERROR_NONE;
    return agf_catalogs(db, &catalogs->agf, error) && enter_place(catalogs, LENSDB_USER, error);
}

/* Step to the next row that has a glass; false at the end of all. */
static bool next_row(struct glass_catalogs *catalogs, struct error *error)
{
    for (;;) {
        if (catalogs->is_open) {
            if (tsv_next(&catalogs->table.rows.tsv, error)) {
                return true;
            }
            if (error->code != ERROR_NONE) {
                return false;
            }
            catalogs->is_open = false;
            catalogs->names++;
        } else if (*catalogs->names != NULL) {
            if (!lensdb_open(catalogs->db, catalogs->place, *catalogs->names,
                             &catalogs->table.rows.tsv, error)) {
                return error->code == ERROR_NONE &&
                       fail(error, ERROR_IO, "cannot read %s", *catalogs->names);
            }
            if (!glass_table_open(&catalogs->table, catalog_of(*catalogs->names), catalogs->place,
                                  error)) {
                return false;
            }
            catalogs->is_open = true;
        } else if (catalogs->place == LENSDB_EMBEDDED) {
            error->code = ERROR_NONE;
            return false;
        } else if (!enter_place(catalogs, catalogs->place + 1, error)) {
            return false;
        }
    }
}

bool glass_catalogs_next(struct glass_catalogs *catalogs, struct glass_record *record,
                         struct error *error)
{
    while (catalogs->agf != NULL) {
        if (catalogs->agf_next < catalogs->agf->count) {
            *record = catalogs->agf->glasses[catalogs->agf_next++];
            return true;
        }
        catalogs->agf = catalogs->agf->next;
        catalogs->agf_next = 0;
    }
    return next_row(catalogs, error) &&
           glass_table_read(&catalogs->table, catalogs->complete, catalogs->arena, record, error);
}

enum { MOST_HOMONYMS = 24 };

/* A name being looked for. */
struct glass_catalog_search {
    struct lensdb *db;
    struct arena *arena;
    struct text typed, catalog, name; /* catalog is empty if none was typed */
    struct glass_record found[MOST_HOMONYMS];
    size_t count;
};

/* Keep the glass in the present row of a table if it answers to the name. */
static bool weigh_glass(struct glass_catalog_search *search, const struct glass_table *table,
                        struct error *error)
{
    if ((search->catalog.length > 0 && !text_same_name(search->catalog, table->catalog)) ||
        !text_same_name(search->name, glass_table_name(table)) || search->count == MOST_HOMONYMS) {
        return true;
    }
    return glass_table_read(table, true, search->arena, &search->found[search->count++], error);
}

/* A glass of the user's that is damaged hides those of its name in the program. */
static bool is_damaged(const struct glass_catalog_search *search, const struct agf_catalog *catalog,
                       struct error *error)
{
    for (; catalog != NULL; catalog = catalog->next) {
        bool meant = search->catalog.length == 0 || text_same_name(search->catalog, catalog->name);
        for (size_t i = 0; meant && i < catalog->damaged_count; i++) {
            if (text_same_name(search->name, catalog->damaged[i].name)) {
                *error = catalog->damaged[i].error;
                return true;
            }
        }
    }
    return false;
}

static bool search_user(struct glass_catalog_search *search, struct error *error)
{
    struct glass_catalogs catalogs;
    const struct agf_catalog *agf;
    if (search->db->directory == NULL && search->db->agf == NULL) {
        return true;
    }
    if (!agf_catalogs(search->db, &agf, error)) {
        return false;
    }
    for (const struct agf_catalog *catalog = agf; catalog != NULL; catalog = catalog->next) {
        if (search->catalog.length > 0 && !text_same_name(search->catalog, catalog->name)) {
            continue;
        }
        for (size_t i = 0; i < catalog->count && search->count < MOST_HOMONYMS; i++) {
            if (text_same_name(search->name, catalog->glasses[i].glass.name)) {
                search->found[search->count++] = catalog->glasses[i];
            }
        }
    }
    if (!glass_catalogs_open(&catalogs, search->db, search->arena, true, error)) {
        return false;
    }
    while (catalogs.place == LENSDB_USER && next_row(&catalogs, error)) {
        if (catalogs.place == LENSDB_USER && !weigh_glass(search, &catalogs.table, error)) {
            return false;
        }
    }
    return error->code == ERROR_NONE && (search->count > 0 || !is_damaged(search, agf, error));
}

/* The name as the index has it; false if it is too long for any. */
static bool make_glass_key(struct text name, char key[EMBEDDED_KEY])
{
    size_t used = 0;
    for (size_t i = 0; i < name.length; i++) {
        char c = name.start[i];
        if (c != ' ' && c != '-' && c != '_') {
            if (used + 1 >= EMBEDDED_KEY) {
                return false;
            }
            key[used++] = c >= 'A' && c <= 'Z' ? (char)(c - 'A' + 'a') : c;
        }
    }
    key[used] = '\0';
    return used > 0;
}

/* The first entry of the index that does not come before the key. */
static size_t first_listed(const char *key)
{
    size_t low = 0, high = embedded_glass_count;
    while (low < high) {
        size_t middle = low + (high - low) / 2;
        if (strcmp(embedded_glasses[middle].key, key) < 0) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    return low;
}

/* Only the names and this one row are read of the catalogue. */
static bool open_row(const struct embedded_glass *entry, struct glass_table *table,
                     struct error *error)
{
    const struct embedded_file *file = &embedded_files[entry->file];
    if (!tsv_open(&table->rows.tsv, file->name, (struct text){file->data, file->rows}, error) ||
        !glass_table_open(table, catalog_of(file->name), LENSDB_EMBEDDED, error)) {
        return false;
    }
    table->rows.tsv.rest = (struct text){file->data + entry->offset, file->length - entry->offset};
    table->rows.tsv.line = (long)entry->line - 1;
    return tsv_next(&table->rows.tsv, error);
}

static bool search_embedded(struct glass_catalog_search *search, struct error *error)
{
    char key[EMBEDDED_KEY];
    struct glass_table table;
    if (!make_glass_key(search->name, key)) {
        return true;
    }
    for (size_t i = first_listed(key);
         i < embedded_glass_count && strcmp(embedded_glasses[i].key, key) == 0; i++) {
        if (!open_row(&embedded_glasses[i], &table, error) || !weigh_glass(search, &table, error)) {
            return false;
        }
    }
    return true;
}

/* Of glasses that differ by '-' and the like only, the one that was typed. */
static void keep_exact(struct glass_catalog_search *search)
{
    size_t exact = 0;
    for (size_t i = 0; i < search->count; i++) {
        const struct text name = search->found[i].glass.name;
        if (name.length == search->name.length && /* equal but for case */
            strncasecmp(name.start, search->name.start, name.length) == 0) {
            search->found[exact++] = search->found[i];
        }
    }
    search->count = exact > 0 ? exact : search->count;
}

static bool is_same_glass(const struct glass *a, const struct glass *b)
{
    return a->formula == b->formula && a->count == b->count && a->table_count == 0 &&
           b->table_count == 0 &&
           memcmp(a->coefficients, b->coefficients, a->count * sizeof a->coefficients[0]) == 0;
}

/* The glasses that were found but for one (null: all), as they have to be typed. */
static const char *list_found(const struct glass_catalog_search *search,
                              const struct glass_record *but, bool current_only,
                              const char *separator)
{
    struct text_buffer list = {.arena = search->arena};
    for (size_t i = 0; i < search->count; i++) {
        const struct glass_record *one = &search->found[i];
        if (one == but || (current_only && !text_equal(one->status, "current"))) {
            continue;
        }
        growing_format(&list, "%s%.*s:%.*s", list.length > 0 ? separator : "",
                       (int)one->glass.catalog.length, one->glass.catalog.start,
                       (int)one->glass.name.length, one->glass.name.start);
        if (one->line > 0) {
            growing_format(&list, " (line %ld)", one->line);
        }
        growing_string(&list, text_equal(one->status, "obsolete") ? " (obsolete)" : "");
    }
    growing_put(&list, "", 1);
    return growing_done(&list).start;
}

/* The only one that is current, or else that is not obsolete; null if there is none. */
static const struct glass_record *current_of(const struct glass_catalog_search *search)
{
    const struct glass_record *current = NULL, *alive = NULL;
    size_t current_count = 0, alive_count = 0;
    for (size_t i = 0; i < search->count; i++) {
        const struct glass_record *one = &search->found[i];
        if (text_equal(one->status, "current")) {
            current = one;
            current_count++;
        }
        if (!text_equal(one->status, "obsolete")) {
            alive = one;
            alive_count++;
        }
    }
    if (current_count == 1) {
        return current;
    }
    return current_count == 0 && alive_count == 1 ? alive : NULL;
}

/* The first of the same glasses, but rather a current one; false if they are not the same. */
static bool glasses_agree(const struct glass_catalog_search *search, struct glass_record *record)
{
    *record = search->found[0];
    for (size_t i = 1; i < search->count; i++) {
        const struct glass_record *one = &search->found[i];
        if (!is_same_glass(&one->glass, &search->found[0].glass)) {
            return false;
        }
        if (text_equal(one->status, "current") && !text_equal(record->status, "current")) {
            *record = *one;
        }
    }
    return true;
}

/* One name, several glasses: refuse, naming them, unless the current one may be taken. */
static bool choose_listed(const struct glass_catalog_search *search, enum glass_naming naming,
                          struct glass_record *record, struct error *error)
{
    if (glasses_agree(search, record)) {
        return true;
    }
    const struct glass_record *one = current_of(search);
    if (naming == GLASS_CURRENT && one != NULL) {
        *record = *one;
        record->taken_as = arena_printf(
            search->arena, "%.*s:%.*s, the %s; others of that name: %s",
            (int)one->glass.catalog.length, one->glass.catalog.start, (int)one->glass.name.length,
            one->glass.name.start,
            text_equal(one->status, "current") ? "current one" : "only one not obsolete",
            list_found(search, one, false, ", "));
        return true;
    }
    fail(error, ERROR_USAGE, "several glasses are called '%.*s': %s", (int)search->name.length,
         search->name.start, list_found(search, NULL, false, ", "));
    const char *current = list_found(search, NULL, true, " or ");
    return current[0] != '\0' ? error_hint(error, "say %s", current) : false;
}

/* The nearest name among all glasses, with its catalogue if one was typed. */
static void suggest_glass(struct glass_catalog_search *search, struct error *error)
{
    struct nearest nearest = {.typed = search->name}, other = {.typed = search->catalog};
    for (size_t i = 0; i < embedded_glass_count; i++) {
        const struct embedded_glass *entry = &embedded_glasses[i];
        const struct embedded_file *file = &embedded_files[entry->file];
        struct text catalog = catalog_of(file->name), name = {file->data + entry->offset, 0};
        while (name.start[name.length] != '\t') {
            name.length++;
        }
        nearest_offer(&other, catalog);
        if (search->catalog.length == 0 || text_same_name(catalog, search->catalog)) {
            nearest_offer(&nearest, name);
        }
    }
    for (const struct agf_catalog *agf = search->db->agf_catalogs; agf != NULL; agf = agf->next) {
        nearest_offer(&other, agf->name);
        for (size_t i = 0; i < agf->count; i++) {
            if (search->catalog.length == 0 || text_same_name(agf->name, search->catalog)) {
                nearest_offer(&nearest, agf->glasses[i].glass.name);
            }
        }
    }
    bool prefixed = search->catalog.length > 0 && nearest.best.start != NULL;
    if (nearest.best.start != NULL) {
        error_hint(error, "did you mean '%.*s%s%.*s'?", prefixed ? (int)search->catalog.length : 0,
                   search->catalog.start, prefixed ? ":" : "", (int)nearest.best.length,
                   nearest.best.start);
    } else if (other.best.start != NULL && search->catalog.length > 0 &&
               !text_same_name(other.best, search->catalog)) {
        error_hint(error, "did you mean '%.*s:%.*s'?", (int)other.best.length, other.best.start,
                   (int)search->name.length, search->name.start);
    }
}

/* Find all glasses that answer to a name. */
static bool search_for(struct glass_catalog_search *search, struct text name, struct error *error)
{
    struct text rest = text_trim(name);
    search->typed = rest;
    search->catalog = text_cut(&rest, ':');
    search->name = rest;
    if (rest.start == NULL) {
        search->name = search->catalog;
        search->catalog = (struct text){"", 0};
    }
    search->count = 0;
    error->code = ERROR_NONE;
    if (!search_user(search, error) || (search->count == 0 && !search_embedded(search, error))) {
        return false;
    }
    keep_exact(search);
    return true;
}

static bool is_unknown(struct text name, struct error *error)
{
    fail(error, ERROR_USAGE, "glass '%.*s' is in no catalogue", text_shown(name), name.start);
    return name.length < 60;
}

/* The glass that a name stands for, said. */
static bool find_meant(struct glass_catalog_search *search, struct text material,
                       struct glass_record *record, struct error *error)
{
    const struct text typed = search->typed;
    if (!search_for(search, material, error)) {
        return false;
    }
    if (search->count == 0) {
        return is_unknown(typed, error) && false;
    }
    if (!choose_listed(search, GLASS_ALIASES, record, error)) {
        return false;
    }
    const struct glass *glass = &record->glass;
    record->taken_as =
        arena_printf(search->arena, "%.*s:%.*s, which '%.*s' stands for",
                     (int)glass->catalog.length, glass->catalog.start, (int)glass->name.length,
                     glass->name.start, (int)typed.length, typed.start);
    return true;
}

/* No catalogue has the name: it may be that of another program. */
static bool find_alias(struct glass_catalog_search *search, enum glass_naming naming,
                       struct glass_record *record, struct error *error)
{
    struct text typed = search->typed, material;
    if (!glass_alias(search->db, typed, search->arena, &material, error)) {
        if (error->code == ERROR_NONE && is_unknown(typed, error)) {
            suggest_glass(search, error);
        }
        return false;
    }
    if (naming != GLASS_OWN_NAMES) {
        return find_meant(search, material, record, error);
    }
    return search_for(search, material, error) && is_unknown(typed, error) && search->count > 0 &&
           error_hint(error, "did you mean '%.*s'?", (int)material.length, material.start);
}

bool glass_find(struct lensdb *db, struct text name, enum glass_naming naming, struct arena *arena,
                struct glass_record *record, struct error *error)
{
    struct glass_catalog_search room,
        *search = &room; /* large, and of no use when the glass is found */
    search->db = db;
    search->arena = arena;
    if (!search_for(search, name, error)) {
        return false;
    }
    struct text material;
    bool own = search->count > 0 && search->found[0].place == LENSDB_USER;
    if (naming == GLASS_HOMONYMS && !own &&
        glass_homonym(db, search->typed, arena, &material, error)) {
        return find_meant(search, material, record, error);
    }
    if (naming == GLASS_HOMONYMS && !own && error->code != ERROR_NONE) {
        return false;
    }
    return search->count > 0 ? choose_listed(search, naming, record, error)
                             : find_alias(search, naming, record, error);
}

/* What is made of numbers alone has no facts beside them. */
static struct glass_record made(struct glass glass, struct text name)
{
    glass.name = name;
    glass.catalog = (struct text){"", 0};
    return (struct glass_record){.glass = glass,
                                 .status = {"", 0},
                                 .source = {"", 0},
                                 .licence = {"", 0},
                                 .nd = NAN,
                                 .Vd = NAN,
                                 .density = NAN,
                                 .price = NAN,
                                 .expansion = NAN,
                                 .expansion_hot = NAN};
}

bool glass_find_medium(struct lensdb *db, struct text text, enum glass_naming naming,
                       struct arena *arena, struct glass_record *record, struct error *error)
{
    struct text rest = text_trim(text), name = rest;
    struct text first = text_cut(&rest, '/');
    struct pair nd, Vd;
    const double highest = 100; /* above that a number is the name of a glass, as 4786 */
    if (!text_pair(first, NUMBER_UNSCALED, &nd) ||
        (rest.start != NULL && !text_pair(rest, NUMBER_UNSCALED, &Vd)) || nd.hi > highest) {
        return glass_find(db, text, naming, arena, record, error);
    }
    if (!(nd.hi > 0)) {
        return fail(error, ERROR_DOMAIN, "an index is above 0");
    }
    if (rest.start != NULL && !(fabs(Vd.hi) > 0)) {
        return fail(error, ERROR_DOMAIN, "Vd is a number other than 0");
    }
    *record = made(rest.start != NULL ? glass_nd_vd(nd, Vd) : glass_constant(nd),
                   text_of(arena_string(arena, name.start, name.length)));
    return true;
}
