/* exchange/codev/codev.h - CODE V sequence files (.seq) while they are read. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_EXCHANGE_CODEV_CODEV_H
#define LENSCALC_EXCHANGE_CODEV_CODEV_H

#include "exchange/foreign.h"
#include "exchange/sequence.h"
#include "exchange/word_table.h"
#include "exchange/writing.h"

extern const struct foreign_format codev_format;

enum { CODEV_MOST_VALUES = 100 }; /* fields, wavelengths or positions */

/* Begins the comments in which lenscalc keeps what CODE V has no words for. */
#define CODEV_KEEP_NOTE "! lenscalc: "
#define CODEV_NOTE      "note "
/* Beside the EPD of a lens whose stop rules the aperture. */
#define CODEV_STOP_RULES "the stop's diameter rules, not EPD"

/* A glass of the file's own catalogue, PRV .. END, and where its indices are. */
struct codev_private {
    struct command_word name;
    const char *medium;        /* as a .lens file has it; null = a formula that is not known */
    const double *wavelengths; /* um */
    size_t count;
    double rounding; /* of the indices */
};

/* What XAN, YAN and WTF list of the fields. */
enum { CODEV_FIELD_WEIGHTS = 2, CODEV_FIELD_ROWS };

/* What stands between the name of a command and its values. */
struct codev_qualifiers {
    size_t surface, end;      /* Sk or Sk..m; the present surface if there is none */
    size_t zoom, field, wave; /* Zk, Fk, Wk; 0 = none */
    size_t next;              /* the first word behind them */
};

/* A .seq file being read. */
struct codev {
    struct foreign_job *job;
    struct commands commands;
    int what;                     /* of the present command, as its keyword has it */
    struct codev_qualifiers here; /* and its qualifiers */
    struct sequence sequence;
    struct lens_build build;
    size_t positions;   /* of ZOO; 0 = the file has no positions */
    size_t position;    /* the present one, from 1 on */
    const char **names; /* of the positions */
    size_t surface;     /* the present one */
    bool radius_mode;   /* RDM: else the numbers of a surface are curvatures */
    bool mode_is_given;
    bool has_image;
    struct command_word image_solve; /* PIM */
    struct command_word vignetting;  /* the first factor that is not 0 */
    struct command_word *wavelengths, *weights;
    size_t wavelength_count, weight_count, weight_room, primary;
    struct figure *fields[CODEV_FIELD_ROWS]; /* x, y, weight */
    size_t field_count[CODEV_FIELD_ROWS];
    struct command_word fields_at[CODEV_FIELD_ROWS];
    bool in_catalog;            /* between PRV and END */
    struct text *catalog_waves; /* PWL, nm */
    size_t catalog_wave_count;
    struct codev_private *privates;
    size_t private_count, private_room;
};

/* Read the qualifiers from word `first` on; before it stands the name that they narrow. */
bool codev_qualifiers(struct codev *codev, size_t first, struct codev_qualifiers *qualifiers);

/* Are all numbers from word `first` on 0? */
bool codev_is_zero(const struct codev *codev, size_t first);

/* Commands of a surface; codev->what tells relatives apart. */
typedef bool codev_command(struct codev *codev);

codev_command codev_surface;          /* S, SO, SI */
codev_command codev_curve;            /* RDY CUY RDX CUX */
codev_command codev_thickness;        /* THI */
codev_command codev_glass;            /* GLA RMD */
codev_command codev_shape;            /* CYL */
codev_command codev_constant;         /* K A B C D .. */
codev_command codev_special;          /* SPS */
codev_command codev_special_constant; /* SCO */
codev_command codev_stop;
codev_command codev_label;
codev_command codev_aperture;       /* CIR is 'C', REX 'x', REY 'y', ELX 'X', ELY 'Y' */
codev_command codev_aperture_shift; /* ADX, ADY; 'X', 'Y' */
codev_command codev_shift;          /* XDE .. CDE */
codev_command codev_move;           /* DAR BEN */
codev_command codev_pickup;
codev_command codev_catalog; /* PRV PWL END */

/* A glass inside PRV .. END. */
bool codev_private_glass(struct codev *codev);

/* The medium of a surface, from its word. */
bool codev_find_glass(struct codev *codev, struct sequence_surface *surface);

/* The letters of a keyword that count: three, in capitals. */
struct codev_key {
    char letters[4];
};
struct codev_key codev_key(struct text word);

/* Every command, by its first three letters, and what becomes of it. */
extern const struct word_group codev_words[];

/* The group of a command; null: it is unknown. */
const struct word_group *codev_group(struct text word);

/* ZOO n: how many positions there are. */
bool codev_set_positions(struct codev *codev);

/*
 * `ZOO NAME .. v1 .. vn` becomes `NAME .. vi` in position i, and a command with Zk is one of
 * position k alone, where it loses this word.
 *
 * Result    is_here  is there something to do in the present position?
 * Errors    ERROR_DATA: not as many values as positions, a position that is not there
 */
bool codev_place(struct codev *codev, bool *is_here);

/*
 * The letter of a word that narrows a command: 's' surfaces; 'z', 'f', 'w' with a number; or 0. No
 * field or wavelength narrows a command whose value is a name: GLA F2 has a glass.
 */
char codev_qualifier_kind(const struct command_word *command, const struct command_word *word);

/*
 * The number of the first word behind the qualifiers.
 *
 * Given     first   the word behind the command's name
 *           values  how many the command has: where these are names, and others stand before them,
 *                   they are no qualifiers whatever they look like
 */
size_t codev_qualifiers_end(const struct commands *commands, size_t first, size_t values);

/* The words of DIM: millimetres, centimetres, inches. */
extern const struct foreign_unit codev_units[];

/*
 * Without RDM the numbers of a surface are curvatures; a file in which they cannot be is refused,
 * when the lens is complete.
 */
bool codev_check_mode(struct codev *codev);

/* Write a lens. */
bool codev_write(struct foreign_job *job, const struct lens *lens, struct text *text,
                 struct error *error);

/* NA, beside the kinds of aperture that codev_aperture_of_lens knows by their numbers. */
enum { CODEV_IMAGE_NA = -1 };

codev_command codev_title;
codev_command codev_radius_mode; /* RDM */
codev_command codev_unit;        /* DIM */
codev_command codev_waves;       /* WL WTW */
codev_command codev_reference;   /* REF */
codev_command codev_aperture_of_lens;
codev_command codev_fields;

/* Does this word only matter to displays, tolerances or optimisers? */
bool codev_is_harmless(struct text word);

/* Wavelengths and fields, when all of the file is read. */
bool codev_finish_system(struct codev *codev);

#endif
