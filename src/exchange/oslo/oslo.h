/* exchange/oslo/oslo.h - OSLO lens files, .len, while they are read and written. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_EXCHANGE_OSLO_OSLO_H
#define LENSCALC_EXCHANGE_OSLO_OSLO_H

#include "exchange/entrance_pupil.h"
#include "exchange/sequence.h"
#include "exchange/word_table.h"

/*
 * .len as OSLO writes it, text of commands.
 *
 * Source    public files; optiland's reader and its notes of the OSLO Program Reference (units,
 *           pick-ups, the infinite object, defaults); sinopt.com and lambdares.com on the signs of
 *           tilts
 * Limits    what is understood and what is refused is told in lenscalc-convert.1
 */
extern const struct foreign_format oslo_format;

/* Begins the comments in which lenscalc keeps what OSLO has no words for. */
#define OSLO_KEEP_NOTE "// lenscalc: "
/* Beside the EBR of a lens whose stop rules the aperture. */
#define OSLO_STOP_RULES "the stop's diameter rules, not EBR"
/* The fields as a .lens file has them, which OSLO keeps as fractions of the largest. */
#define OSLO_FIELDS "fields "
/* The name of a surface: its number, and the name */
#define OSLO_NAME "name "
/* The glass of a surface whose maker OSLO has no prefix for: its number, and CATALOG:NAME */
#define OSLO_GLASS "glass "

enum { OSLO_MOST_WAVES = 100 };

enum oslo_field { OSLO_NO_FIELD, OSLO_ANGLE, OSLO_OBJECT, OSLO_IMAGE };

/* What a block behind END, up to the next END, is about. */
enum oslo_block {
    OSLO_NO_BLOCK,
    OSLO_POINTS,         /* RST: points of the field */
    OSLO_CONFIGURATIONS, /* CFG */
    OSLO_PASSED_OVER     /* VAR, OPE: variables and operands of the optimiser */
};

/* A point of the field: fractions of the largest, of an angle those of its tangent. */
struct oslo_point {
    struct figure at[2], weight; /* x, y */
};

/* The edges along x and y, and the corners x, y of triangles and quadrangles. */
enum { OSLO_CORNERS = 4, OSLO_EDGES = 12 };

/* ATP, AAC, AGN; AAN, degrees */
enum { OSLO_TYPE, OSLO_ACTION, OSLO_GROUP, OSLO_TURN, OSLO_NUMBERS };

/* A special aperture: its numbers, by the letter that names it. */
struct oslo_special {
    size_t surface;
    struct text letter;
    struct command_word at;
    double number[OSLO_NUMBERS];
    struct figure edge[OSLO_EDGES];
};

/* A .len file being read. */
struct oslo {
    struct foreign_job *job;
    struct commands commands;
    struct sequence sequence;
    struct lens_build build;
    int what;                   /* of the present command, as its keyword has it */
    size_t surface;             /* the present one */
    size_t positions, position; /* configurations: how many, 0 = one; the present, from 1 on */
    bool has_begun, has_ended, has_stop;
    enum oslo_block block;
    int asphere_step;             /* ASi is the coefficient of r^(step i); 0 = of no such asphere */
    struct command_word aperture; /* where it stands */
    enum pupil_stated near_aperture;
    double near_value; /* of an aperture that waits for the surfaces; 0 = none does */
    enum oslo_field field_is;
    struct figure field;
    struct command_word field_at;
    struct oslo_point points[OSLO_MOST_WAVES];
    size_t point_count;
    struct text waves[OSLO_MOST_WAVES], weights[OSLO_MOST_WAVES]; /* um */
    size_t wave_count, weight_count;
    struct oslo_special *specials;
    size_t special_count, special_room;
    struct text glasses[FOREIGN_MOST_SURFACES]; /* CATALOG:NAME that lenscalc has kept, or empty */
};

/* Every command and what becomes of it. */
extern const struct word_group oslo_words[];

/* A command; oslo->what tells relatives apart. */
typedef bool oslo_command(struct oslo *oslo);

oslo_command oslo_glass;       /* GLA NAME, GLA MOD NAME n n n, GLA 1.5, GLA MOD 1.5 60 */
oslo_command oslo_waves;       /* WV a b c; WW 1 1 1, whose `what` is 1 */
oslo_command oslo_one_wave;    /* WV2 b; WW2 1 */
oslo_command oslo_point;       /* F n y x ..: a point of the field */
oslo_command oslo_telecentric; /* TELE ON: a telecentric object space */
oslo_command oslo_mode;        /* AMO AFO: an afocal image space */
oslo_command oslo_pickup;      /* PK TH 3 0.5 */

/*
 * Special apertures, by their letters: ATP A 2 and the like, edges and corners, and as one of an
 * earlier surface, APK A 3 B.
 *
 * Source    optiland's reader of OSLO files and its tests: types, actions, groups, edges of 0 that
 *           are left out
 */
oslo_command oslo_special_number, oslo_special_edge, oslo_special_pickup;

/* An earlier surface by its number, or that many before the present one: -2. */
bool oslo_reference(struct oslo *oslo, size_t word, size_t *surface);

/* The special apertures go to their surfaces, when all of the file is read. */
void oslo_put_apertures(struct oslo *oslo);

/* What lenscalc has kept in comments: glasses, ahead; all else, when the surfaces are there. */
void oslo_kept_glasses(struct oslo *oslo, struct text content);
bool oslo_keep_notes(struct oslo *oslo, struct text content);

/* The unit of all lengths, wherever it stands. */
bool oslo_unit(struct oslo *oslo);

/* The command of a block that begins or ends here; false: it does neither. */
bool oslo_enter(struct oslo *oslo, struct text word);

/* Ahead of all else: the number of configurations, from each command of the file. */
bool oslo_count_positions(struct oslo *oslo);

/*
 * A command of the block CFG: `TH surface configuration value`, `EBR configuration value`. It
 * becomes one of the lens, without these numbers.
 *
 * Result    is_here  it is of the present configuration
 */
bool oslo_place(struct oslo *oslo, bool *is_here);

/* Solves of several configurations, which may be solved in the first alone, are lost. */
void oslo_check_solves(const struct oslo *oslo);

/* Wavelengths, aperture and fields, when all of the file is read. */
void oslo_finish_system(struct oslo *oslo);

/* EBR and FNO of a near object, when the surfaces are there. */
void oslo_finish_aperture(struct oslo *oslo);

bool oslo_write(struct foreign_job *job, const struct lens *lens, struct text *text,
                struct error *error);

#endif
