/* data/glass_catalog.h - glasses by name: the embedded catalogues and the user's own. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DATA_GLASS_CATALOG_H
#define LENSCALC_DATA_GLASS_CATALOG_H

#include "data/lensdb.h"
#include "optics/glass.h"

/* A glass as its catalogue has it. Texts point into the database. */
struct glass_record {
    struct glass glass;
    struct text status; /* "current", "obsolete", .. */
    struct text source, licence;
    double nd, Vd;                   /* as printed; NaN where not stated */
    double density;                  /* g/cm^3 */
    double price;                    /* of a mass, as a share of the maker's usual crown */
    double expansion, expansion_hot; /* 1e-6/K, -30 to 70 and 20 (or 100) to 300 C */
    enum lensdb_place place;
    long line;            /* in an AGF file; else 0 */
    const char *taken_as; /* what a name was taken as that is not its own; null = as typed */
    const char *warning;  /* what is doubtful in its data, and where; null = nothing */
};

/* A catalogue being read. */
struct glass_table {
    struct lensdb_table rows;
    struct text catalog;
};

struct agf_catalog;

/* All catalogues being read, the user's first. */
struct glass_catalogs {
    struct lensdb *db;
    struct arena *arena;           /* for what glasses point to */
    bool complete;                 /* with transmittances, which cost most of the time */
    const struct agf_catalog *agf; /* being read; its glasses come first */
    size_t agf_next;
    enum lensdb_place place;
    const char *const *names; /* of this place: "glass/SCHOTT.tsv", ends with null */
    bool is_open;
    struct glass_table table;
};

/*
 * Go through all glasses: the user's AGF files (--agf, in the order given, then glass/NAME.agf of
 * the user's folder, by name), the tables glass/NAME.tsv of that folder, then the embedded ones.
 *
 * Result    next: false at the end with error->code ERROR_NONE
 * Errors    ERROR_DATA with line and column: a bad row; ERROR_IO
 */
bool glass_catalogs_open(struct glass_catalogs *catalogs, struct lensdb *db, struct arena *arena,
                         bool complete, struct error *error);
bool glass_catalogs_next(struct glass_catalogs *catalogs, struct glass_record *record,
                         struct error *error);

/* How far a name may be from that of one glass. */
enum glass_naming {
    GLASS_OWN_NAMES, /* it is the name of one glass, as in a lens file */
    GLASS_ALIASES,   /* what other programs call it, where no catalogue has the name */
    GLASS_HOMONYMS,  /* that, also where an embedded catalogue has it for another material */
    GLASS_CURRENT    /* that, and of several glasses the one that is current: for a question only */
};

/*
 * Find a glass by NAME or CATALOG:NAME. Case, blanks, '-' and '_' do not count, unless two glasses
 * differ by nothing else. The user's glasses come before the embedded ones.
 *
 * Given     arena   for what the glass points to
 * Result    record->taken_as says which glass it is where naming decided
 * Errors    ERROR_USAGE with a suggestion: there is none; or several catalogues have the name with
 *           different data (the message names them). GLASS_CURRENT takes the only one of status
 *           "current"; where none is, the only one that is not "obsolete". ERROR_DATA with its
 *           place: a user's AGF file has the name, but the glass is damaged
 */
bool glass_find(struct lensdb *db, struct text name, enum glass_naming naming, struct arena *arena,
                struct glass_record *record, struct error *error);

/*
 * A medium as it is typed: a number (one index for all light), nd/Vd ("1.5168/64.17"), or the name
 * of a glass.
 *
 * Errors    as glass_find; ERROR_DOMAIN: an index not above 0, Vd 0
 * Limits    a number above 100 is no index but a name
 */
bool glass_find_medium(struct lensdb *db, struct text text, enum glass_naming naming,
                       struct arena *arena, struct glass_record *record, struct error *error);

#endif
