/* data/lensdb.h - the program's data, and the user's own in front of it. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DATA_LENSDB_H
#define LENSCALC_DATA_LENSDB_H

#include "base/arena.h"
#include "base/error.h"
#include "base/text.h"
#include "data/tsv.h"
#include "optics/growing.h"
#include "photo/format.h"

#include <stdbool.h>
#include <stddef.h>

enum lensdb_place { LENSDB_USER, LENSDB_EMBEDDED, LENSDB_PLACES };

/* Of a lens file that has indices beside the name of a glass: what counts where the two differ. */
enum glass_numbers {
    GLASS_NUMBERS_OF_FILE, /* as the program that wrote the file means it */
    GLASS_NUMBERS_LINE,    /* the indices */
    GLASS_NUMBERS_CATALOG  /* the name */
};

/* Of a lens whose aperture is no diameter of the stop: the marginal ray that gives it its size. */
enum stop_size {
    STOP_SIZE_OF_LENS, /* as its file says */
    STOP_SIZE_PARAXIAL,
    STOP_SIZE_REAL
};

/* Where data comes from. Files of the user's folder are read once, when first asked for. */
struct lensdb {
    struct arena *arena;
    const char *agf;       /* --agf: glass catalogues, separated by commas; null = none */
    const char *directory; /* --lensdb or LENSCALC_DB; null = embedded data only */
    struct lensdb_file *loaded;
    struct lensdb_folder *folders; /* read so far */
    struct lensdb_series *series;  /* stop series read so far */
    bool agf_is_read;
    bool lossy; /* --lossy: files of other programs are read without what is lost */
    enum glass_numbers glass_numbers; /* --glass-numbers */
    enum stop_size stop_size;         /* --stop-size */
    struct text_buffer losses; /* what that was, and damaged glasses: a line each, each file once */
    struct lensdb_told *told_of;            /* those files */
    const struct agf_catalog *agf_catalogs; /* the user's, once they are read */
};

/*
 * The files in a folder of the user's folder, which is read once.
 *
 * Given     folder  "lenses"; ending  of their names, without regard to case
 *           all     false: what is no regular file, or may not be read, is left out, and db->losses
 *                   says so
 *           names   receives them as "lenses/x.lens", sorted; an array that ends with null and
 *                   lives as long as the database
 * Result    no names where there is no such folder, or --lensdb is not given
 * Errors    ERROR_IO: the user's folder or this one cannot be read
 */
bool lensdb_list(struct lensdb *db, const char *folder, const char *ending, bool all,
                 const char *const **names, struct error *error);

/*
 * One of all these by its name without folder and ending: as it is typed, or else by the rules of
 * text_same_name.
 *
 * Given     file  receives it; null: there is none
 */
bool lensdb_find(struct lensdb *db, const char *folder, const char *ending, struct text name,
                 const char **file, struct error *error);

/*
 * Begin to read a table from the user's folder or from the embedded data.
 *
 * Result    false with error->code ERROR_NONE if that place has no such file
 * Errors    ERROR_IO: the user's file or folder cannot be read; ERROR_DATA as tsv_open
 */
bool lensdb_open(struct lensdb *db, enum lensdb_place place, const char *file, struct tsv *tsv,
                 struct error *error);

enum { LENSDB_MOST_COLUMNS = 23 };

/* Such a table being read, whose columns have known names. */
struct lensdb_table {
    struct tsv tsv;
    enum lensdb_place place;
    size_t columns[LENSDB_MOST_COLUMNS]; /* TSV_MOST_COLUMNS where a user's table has none */
};

/* Begin to read one, as lensdb_open and tsv_columns do; rows are read by tsv_next. */
bool lensdb_table_open(struct lensdb_table *table, struct lensdb *db, enum lensdb_place place,
                       const char *file, const char *const *names, size_t count, size_t needed,
                       struct error *error);

/* A cell of the present row; empty where the table has no such column. */
struct text lensdb_table_cell(const struct lensdb_table *table, int column);

/* A number from `low` to `high`; NaN where there is none. ERROR_DATA with its place: another. */
bool lensdb_table_number(const struct lensdb_table *table, int column, double low, double high,
                         double *value, struct error *error);

/* A format or camera. Texts point into the database. */
struct lensdb_sensor {
    struct text maker; /* empty for a format */
    struct text name;  /* of the format, or the camera's model */
    struct text aliases;
    struct text class, pitch_from, confidence, source;
    struct text focal, equivalent, fnumber; /* of a fixed lens, mm; of a zoom both ends: "24-70" */
    struct sensor size;                     /* pitch in mm, NaN if unknown */
    double pixels_wide, pixels_high;        /* NaN if unknown */
    enum lensdb_place place;
};

/* Begin to read formats.tsv or cameras.tsv. */
bool lensdb_sensors_open(struct lensdb_table *sensors, struct lensdb *db, enum lensdb_place place,
                         bool cameras, struct error *error);

/* The words of the next one; false at the end with error->code ERROR_NONE, or for a bad row. */
bool lensdb_sensors_words(struct lensdb_table *sensors, struct lensdb_sensor *sensor,
                          struct error *error);

/* The numbers of the row whose words were read last. */
bool lensdb_sensors_numbers(struct lensdb_table *sensors, struct lensdb_sensor *sensor,
                            struct error *error);

/* The next one, words and numbers; as lensdb_sensors_words. */
bool lensdb_sensors_next(struct lensdb_table *sensors, struct lensdb_sensor *sensor,
                         struct error *error);

/*
 * Find a format or camera by name: the user's formats, the user's cameras, then the embedded ones.
 * Case, blanks, '-' and '_' do not count; a camera is known by maker and model, by its model, by an
 * alias, or by one of the models that stand in its row between " / "; where nothing has the name,
 * by its short form (camera_name_fold): "5D4", "Canon R6 II".
 *
 * Errors    ERROR_USAGE with what is near, of cameras the family with its formats: no such name, or
 *           a model that two makers have
 */
bool lensdb_find_sensor(struct lensdb *db, struct text name, struct lensdb_sensor *sensor,
                        struct error *error);

/* One label of a stop series and its exact value. */
struct lensdb_stop {
    struct text label; /* ends with NUL */
    struct text note;
    double value;      /* the label as a number, in the program's own unit */
    double exact;      /* 2^(step/2d), 2^(-step/d) s or 3.125 x 2^(step/d) */
    int step, divisor; /* d: 1 full, 2 half, 3 third stops */
};

/*
 * The labels of one series of fstops.tsv, shutters.tsv or iso.tsv, in the file's order.
 *
 * Given     file     which; series "full", "half" or "third"
 *           stops    receives an array in the database's arena; empty if there is no such series
 */
bool lensdb_stops(struct lensdb *db, const char *file, const char *series,
                  struct lensdb_stop **stops, size_t *count, struct error *error);

#endif
