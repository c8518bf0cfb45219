/* exchange/oslo/oslo_reading.h - an OSLO lens file while it is read. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_EXCHANGE_OSLO_OSLO_READING_H
#define LENSCALC_EXCHANGE_OSLO_OSLO_READING_H

#include "exchange/sequence.h"
#include "exchange/word_table.h"

enum { OSLO_MOST_WAVES = 100 };

enum oslo_field { OSLO_NO_FIELD, OSLO_ANGLE, OSLO_OBJECT, OSLO_IMAGE };

/* A point of the field: fractions of the largest, of an angle those of its tangent. */
struct oslo_point {
    struct figure at[2], weight; /* x, y */
};

/* A .len file being read. */
struct oslo {
    struct foreign_job *job;
    struct commands commands;
    struct sequence sequence;
    struct lens_build build;
    size_t surface; /* the present one */
    bool has_begun, has_ended, has_stop, in_points;
    int asphere_step;             /* ASi is the coefficient of r^(step i); 0 = of no such asphere */
    struct command_word aperture; /* where it stands */
    enum oslo_field field_is;
    struct figure field;
    struct command_word field_at;
    struct oslo_point points[OSLO_MOST_WAVES];
    size_t point_count;
    struct text waves[OSLO_MOST_WAVES], weights[OSLO_MOST_WAVES]; /* um */
    size_t wave_count, weight_count;
    struct text glasses[SEQUENCE_MOST]; /* CATALOG:NAME that lenscalc has kept, or empty */
};

/* Every command and what becomes of it. */
extern const struct word_group oslo_words[];

/* GLA NAME, GLA MOD NAME n n n, GLA 1.5, GLA MOD 1.5 60 */
bool oslo_glass(struct oslo *oslo, int what, struct error *error);

/* WV a b c; WV2 b; WW 1 1 1; WW2 1 */
bool oslo_waves(struct oslo *oslo, int what, struct error *error);
bool oslo_weights(struct oslo *oslo, int what, struct error *error);
bool oslo_wave(struct oslo *oslo, struct error *error);
bool oslo_weight(struct oslo *oslo, struct error *error);

/* PK TH 3 0.5 */
bool oslo_pickup(struct oslo *oslo, int what, struct error *error);

/* F n y x ..: a point of the field */
bool oslo_point(struct oslo *oslo, int what, struct error *error);

/* TELE ON: a telecentric object space; AMO AFO: an afocal image space */
bool oslo_telecentric(struct oslo *oslo, int what, struct error *error);
bool oslo_mode(struct oslo *oslo, int what, struct error *error);

/* The fields of a kept note that lenscalc wrote. */
bool oslo_fields(struct oslo *oslo, struct text line, struct error *error);

/* The unit of all lengths, wherever it stands. */
bool oslo_unit(struct oslo *oslo, struct error *error);

/* Wavelengths, aperture and fields, when all of the file is read. */
bool oslo_finish_system(struct oslo *oslo, struct error *error);

#endif
