/* data/glass_alias.c - what materials are called elsewhere. */
/* SPDX-License-Identifier: MIT */
#include "data/glass_alias.h"

static const char FILE_NAME[] = "glass_aliases.tsv";

/* A name being looked for; what stays empty was not typed, or is not found. */
struct glass_alias_search {
    struct text catalog, name;
    struct text real_catalog, material;
    bool of_homonyms; /* its material is that of a row CATALOG:NAME */
};

/* "MISC" of "MISC:NACL" or "MISC:"; empty where no catalogue stands. The rest is behind the ':'. */
static struct text cut_catalog(struct text *text)
{
    struct text rest = *text, first = text_cut(&rest, ':');
    if (rest.start == NULL) {
        return (struct text){"", 0};
    }
    *text = rest;
    return first;
}

/* A row of a table; the first one that is meant counts. */
static void weigh_alias(struct glass_alias_search *search, struct text typed, struct text real)
{
    struct text name = real, own = cut_catalog(&typed), catalog = cut_catalog(&name);
    bool is_own = own.length > 0 && text_same_name(own, search->catalog);
    bool is_name = typed.length > 0 && text_same_name(typed, search->name);
    bool is_wanted = search->of_homonyms ? is_own && is_name : own.length == 0 && is_name;
    if (is_wanted && search->material.length == 0) {
        search->material = real;
    } else if (!search->of_homonyms && is_own && typed.length == 0 &&
               search->real_catalog.length == 0) {
        search->real_catalog = catalog;
    }
}

static bool each_alias(struct glass_alias_search *search, struct tsv *tsv, struct error *error)
{
    static const char *const names[] = {"alias", "material"};
    size_t columns[2];
    if (!tsv_columns(tsv, names, 2, 2, columns, error)) {
        return false;
    }
    while (tsv_next(tsv, error)) {
        weigh_alias(search, tsv->cells[columns[0]], tsv->cells[columns[1]]);
    }
    return error->code == ERROR_NONE;
}

/* Look through the user's table and the embedded one. */
static bool glass_alias_look(struct lensdb *db, struct glass_alias_search *search,
                             struct error *error)
{
    error->code = ERROR_NONE;
    for (enum lensdb_place place = LENSDB_USER; place < LENSDB_PLACES; place++) {
        struct tsv tsv;
        const bool open = lensdb_open(db, place, FILE_NAME, &tsv, error);
        if (open ? !each_alias(search, &tsv, error) : error->code != ERROR_NONE) {
            return false;
        }
    }
    return true;
}

bool glass_homonym(struct lensdb *db, struct text name, struct arena *arena, struct text *material,
                   struct error *error)
{
    struct glass_alias_search search = {.name = text_trim(name), .of_homonyms = true};
    search.catalog = cut_catalog(&search.name);
    if (!glass_alias_look(db, &search, error) || search.material.length == 0) {
        return false;
    }
    *material = text_of(arena_string(arena, search.material.start, search.material.length));
    return true;
}

bool glass_alias(struct lensdb *db, struct text name, struct arena *arena, struct text *material,
                 struct error *error)
{
    struct glass_alias_search search = {.name = text_trim(name)};
    search.catalog = cut_catalog(&search.name);
    if (!glass_alias_look(db, &search, error)) {
        return false;
    }
    struct text wanted = search.real_catalog.length > 0 ? search.real_catalog : search.catalog;
    struct text rest = search.material, catalog = cut_catalog(&rest);
    if (search.material.length > 0 && (wanted.length == 0 || text_same_name(wanted, catalog))) {
        *material = text_of(arena_string(arena, search.material.start, search.material.length));
        return true;
    }
    if (search.real_catalog.length > 0) {
        *material = text_of(arena_printf(arena, "%.*s:%.*s", (int)wanted.length, wanted.start,
                                         (int)search.name.length, search.name.start));
        return true;
    }
    return false;
}
