/* data/lensdb_facts.h - films, scenes, filters and grades of tolerances of lensdb. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DATA_LENSDB_FACTS_H
#define LENSCALC_DATA_LENSDB_FACTS_H

#include "data/lensdb.h"
#include "photo/reciprocity.h"

/* One source on the reciprocity failure of a film. Texts point into the database. */
struct lensdb_film {
    struct text maker, name;
    struct text aliases;           /* other names, with commas between */
    struct text model, parameters; /* as photo/reciprocity.h reads them, and "step" */
    double onset, valid_to;        /* s; valid_to is NaN where none is stated */
    struct text status, source, note;
    struct text speeds; /* ISO, of the box; several with blanks between; empty where not stated */
    struct text type;   /* "panchromatic", "colour negative"; empty where not stated */
    enum lensdb_place place;
    const char *file; /* where it stands, for messages */
    long line;
};

/* A typical scene and the light in it. */
struct lensdb_scene {
    struct text name, aliases, scene, confidence, source;
    double ev100;
    enum lensdb_place place;
};

/* A filter and the light it takes. */
struct lensdb_filter {
    struct text name, aliases, kind, confidence, source;
    double factor, stops; /* as published; NaN where not, but not both */
    double mired;         /* shift of the colour temperature; NaN = a colour none of light */
    enum lensdb_place place;
};

/* A row of tolerances.tsv. Texts point into the database. */
struct lensdb_tolerance {
    struct text grade;
    struct text quantity;     /* "radius", "element tilt": words of .lens files */
    struct text amount, unit; /* as they stand in the table; unit empty where there is none */
    struct text distribution; /* empty: not said */
    struct text confidence, source;
    double value; /* the amount as a number */
    enum lensdb_place place;
    const char *file; /* where it stands, for messages */
    long line;
};

/*
 * Begin to read a table, and read its rows one by one.
 *
 * Result    open: false with ERROR_NONE if that place has no such table; next: false at the end
 *           with ERROR_NONE
 * Errors    ERROR_DATA with line and column: a bad row; as lensdb_open
 */
bool lensdb_films_open(struct lensdb_table *facts, struct lensdb *db, enum lensdb_place place,
                       struct error *error);
bool lensdb_films_next(struct lensdb_table *facts, struct lensdb_film *film, struct error *error);
bool lensdb_scenes_open(struct lensdb_table *facts, struct lensdb *db, enum lensdb_place place,
                        struct error *error);
bool lensdb_scenes_next(struct lensdb_table *facts, struct lensdb_scene *scene,
                        struct error *error);
bool lensdb_filters_open(struct lensdb_table *facts, struct lensdb *db, enum lensdb_place place,
                         struct error *error);
bool lensdb_filters_next(struct lensdb_table *facts, struct lensdb_filter *filter,
                         struct error *error);
bool lensdb_grades_open(struct lensdb_table *grades, struct lensdb *db, enum lensdb_place place,
                        struct error *error);
bool lensdb_grades_next(struct lensdb_table *grades, struct lensdb_tolerance *row,
                        struct error *error);

/*
 * Find a film: by maker and name, name or alias, the user's films first; else by words of its name
 * ("Portra 400" is in "Portra 160/400, Ektar 100").
 *
 * Errors    ERROR_USAGE: no such film, with a suggestion; several films or sources of that name,
 *           which are listed: nothing decides between conflicting sources but the user
 */
bool lensdb_find_film(struct lensdb *db, struct text name, struct lensdb_film *film,
                      struct error *error);

/*
 * The speed a film is sold with.
 *
 * Given     typed  as the user named it: of several speeds the one that stands in it counts
 * Result    ISO; NaN: not stated, or several
 */
double lensdb_film_speed(const struct lensdb_film *film, struct text typed);

/* The film's correction as numbers. ERROR_DATA with file and line if the table cannot be read. */
bool lensdb_film_model(const struct lensdb_film *film, struct reciprocity *model,
                       struct error *error);

/* Find by name or alias, the user's own first. ERROR_USAGE with a suggestion if there is none. */
bool lensdb_find_scene(struct lensdb *db, struct text name, struct lensdb_scene *scene,
                       struct error *error);
bool lensdb_find_filter(struct lensdb *db, struct text name, struct lensdb_filter *filter,
                        struct error *error);

/*
 * The conversion filter with the shift nearest to a wanted one, the user's own first.
 *
 * Given     mired  wanted;  arena  for the name
 * Result    name and shift of it; null and NaN where the tables have none
 * Errors    as lensdb_filters_next
 */
bool lensdb_nearest_conversion(struct lensdb *db, double mired, struct arena *arena,
                               const char **name, double *shift, struct error *error);

/* Stops of light that a filter takes: by its factor where one is published. */
double lensdb_filter_stops(const struct lensdb_filter *filter);

#endif
