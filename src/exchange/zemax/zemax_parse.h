/* exchange/zemax/zemax_parse.h - a .zmx file as it stands, line by line, before it is a lens. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_EXCHANGE_ZEMAX_ZEMAX_PARSE_H
#define LENSCALC_EXCHANGE_ZEMAX_ZEMAX_PARSE_H

#include "exchange/foreign.h"
#include "exchange/keep_notes.h"
#include "exchange/zemax/zemax.h"
#include "file/lens_build.h"

enum {
    ZEMAX_PARAMETERS = 13, /* PARM 1 .. 12 */
    ZEMAX_EXTRAS = 24,     /* XDAT 1 .. 23 */
    ZEMAX_WAVES = 64,
    ZEMAX_CATALOGS = 64,
    ZEMAX_CONFIGURATIONS = 100
};

/* One line: its keyword, where it stands, and the numbers after the keyword. */
struct zemax_line {
    struct file_words words; /* for messages */
    struct text keyword;     /* of a glass its name */
    struct text begin;       /* the word that begins the line, for messages */
    struct text first;       /* the first word after the keyword */
    size_t count;            /* numbers before the first word that is none */
    struct figure *numbers;
    struct text stray; /* that word, where it is not text in quotes, which may follow numbers */
    bool infinite;     /* the first word is INFINITY */
};

/* A surface. A line that the file does not have is null. */
struct zemax_surface {
    size_t number; /* SURF */
    const struct zemax_line *surf, *type, *curvature, *thickness, *conic, *diameter, *glass;
    const struct zemax_line *clear;                     /* CLAP */
    const struct zemax_line *aperture, *aperture_shift; /* CLAP, SQAP ..; OBDC */
    const struct zemax_line *solve;                     /* of the thickness */
    const struct zemax_line *parameters[ZEMAX_PARAMETERS];
    const struct zemax_line *pickups[ZEMAX_PARAMETERS]; /* PPAR */
    const struct zemax_line *extras[ZEMAX_EXTRAS];
    const struct zemax_line *shift_before, *shift_behind; /* SCBD 1, SCBD 2 */
    const struct zemax_line *user_aperture;               /* USAP, USOB, UDAD; it names the file */
    struct text user_file;
    const struct zemax_line **user_rows; /* UDAD 1 .. in the order of the file: its shapes inline */
    size_t user_row_count, user_row_room;
    bool user_blocks;
    struct text comment;
    size_t planes_behind; /* in the lens, for SCBD 2; the last has the distance of the surface */
    bool is_stop;
    bool has_free_curvature; /* its solve is lost, the file's number stands */
    bool has_lost_aperture;  /* no clear one may stand for it */
};

/* An operand of the multiple configurations: THIC 4 2 1.5 */
struct zemax_setting {
    const struct zemax_line *line;
    long surface, configuration; /* 1-based configuration */
    struct zemax_setting *next;
};

/* Begins the notes in which lenscalc keeps what a .zmx file has no words for. */
#define ZEMAX_KEEP_NOTE "lenscalc "
#define ZEMAX_POSITIONS "positions " /* their names follow */
/* the last distance is not what the solve beside it gives */
#define ZEMAX_OTHER_DISTANCE "distance as typed, beside its solve"

/* What speaks against the lens as it is read, over all configurations. */
struct zemax_doubts {
    size_t disputed;     /* lines whose numbers are not those of the catalogue's glass */
    size_t contradicted; /* solves that do not give the file's number */
};

struct zemax_file {
    struct foreign_job *job;
    struct lens_build build;
    struct file_words words;
    struct zemax_surface *surfaces;
    size_t surface_count, surface_room;
    size_t passed; /* surfaces behind the object that the lens does not have */
    bool has_gaps; /* some numbers of surfaces are left out */
    bool has_tail; /* a line of the whole lens stands behind the surfaces */
    struct text last_word;
    bool in_tail; /* behind the surfaces: merit function, tolerances, configurations */
    const struct zemax_line **zeros; /* unknown words whose numbers are all 0 */
    size_t zero_count, zero_room;
    bool has_configurations; /* MNUM has been */
    struct text catalogs[ZEMAX_CATALOGS];
    size_t catalog_count;
    struct text version; /* VERS: what has written the file */
    bool takes_numbers;  /* of lines whose glass differs: told by the solves */
    struct zemax_doubts *doubts;
    const struct zemax_line *aperture, *fields;     /* ENPD .., FTYP */
    const struct zemax_line *x, *y, *field_weights; /* XFLN, YFLN, FWGN */
    const struct zemax_line *environment;           /* ENVD */
    const struct zemax_line *vignetting;            /* the first factor that is not 0 */
    struct figure waves[ZEMAX_WAVES], weights[ZEMAX_WAVES];
    size_t wave_count, primary;
    const struct zemax_line *primary_line;
    size_t configurations;
    size_t shown;         /* the configuration whose solves the file has stored, 1-based */
    size_t configuration; /* being read */
    struct zemax_setting *settings, *last_setting;
    struct keep_notes notes;
    struct text position_names;
    bool has_other_distance;                     /* by such a note */
    const struct displacement *coordinate_break; /* of the next surface */
};

/* Read all lines. Errors as foreign_format.read */
bool zemax_parse(struct zemax_file *file, struct text content, struct error *error);

/* A number of a line, 0 where it is absent. */
double zemax_number(const struct zemax_line *line, size_t at);

/*
 * How many of the wavelengths listed are in use. Without a count, the repeated default at the end
 * is passed over.
 */
size_t zemax_wave_count(const struct zemax_file *file);

/* A parameter after its pick-up: scale x (that of an earlier surface) + offset. */
struct figure zemax_parameter(const struct zemax_file *file, size_t at, size_t number);

/* Is a plane tilted or shifted: TILTSURF with a slope, SCBD with a number? */
bool zemax_is_tilted(const struct zemax_file *file, size_t at);

/*
 * The surface of the lens that has the distance of a surface of the file.
 *
 * Given     places  of the surfaces of the file in the lens
 */
static inline size_t zemax_gap_place(const struct zemax_file *file, const size_t *places, size_t at)
{
    return places[at] + file->surfaces[at].planes_behind;
}

/* A note of the lens: what of the file has given way to something else in it. */
void zemax_remark(struct zemax_file *file, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/*
 * What a number follows is not evaluated: the number of the file stands. Of one configuration it is
 * what the program solved, and a note says so; of several it is that of one of them: a loss.
 */
bool zemax_stands(struct zemax_file *file, const struct zemax_line *line, const char *what);

/* Record a loss at a line. */
#define zemax_loss(file, line, effect, instead, ...)                                               \
    foreign_loss((file)->job, &(line)->words, (line)->keyword, (effect), (instead), __VA_ARGS__)

#endif
