/* exchange/zemax/zemax.h - Zemax sequential lens files, .zmx, while they are read. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_EXCHANGE_ZEMAX_ZEMAX_H
#define LENSCALC_EXCHANGE_ZEMAX_ZEMAX_H

#include "exchange/foreign.h"
#include "exchange/keep_notes.h"
#include "exchange/word_table.h"
#include "file/lens_build.h"
#include "optics/aperture.h"

enum { ZEMAX_TERMS = 8 }; /* of an asphere, among its parameters */

/*
 * .zmx as OpticStudio and its forerunners write it.
 *
 * Source    the format is not published; what is known comes from public files and from readers
 *           such as ray-optics (zmxread.py) and optiland (zemax_handler). [OpticStudio25] says what
 *           the surface types mean
 * Limits    which surfaces, apertures and solves there are is told in lenscalc-convert.1
 */
extern const struct foreign_format zemax_format;

/*
 * The types that hold aspheric terms: term i is the coefficient of r^(step i), in PARM i, or as
 * extra data behind the number of terms and the radius that r is a part of.
 */
struct zemax_asphere {
    const char *name;
    int step, terms;
    bool extra;
};
enum { ZEMAX_ASPHERES = 4 };
extern const struct zemax_asphere zemax_aspheres[ZEMAX_ASPHERES];

/* The words of UNIT. */
extern const struct foreign_unit zemax_units[];

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
    struct error *error; /* receives what is wrong */
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
    struct zemax_setting *settings, **settings_end; /* a list, and where it ends */
    struct keep_notes notes;
    struct text position_names;
    bool has_other_distance;                     /* by such a note */
    const struct displacement *coordinate_break; /* of the next surface */
};

/* Read all lines. Errors as foreign_format.read */
bool zemax_parse(struct zemax_file *file, struct text content);

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

/* Report something wrong with a word of a line. False */
#define zemax_fail(line, word, ...) file_words_fail(&(line)->words, (word), __VA_ARGS__)
/* Record a loss at a line. */
#define zemax_loss(file, line, effect, instead, ...)                                               \
    foreign_loss((file)->job, &(line)->words, (line)->keyword, (effect), (instead), __VA_ARGS__)

/* -------- keywords, each with its reader -------- */

/* What stands behind a keyword: text in quotes may follow numbers. */
enum zemax_wants { ZEMAX_ANY_WORDS, ZEMAX_ALL_NUMBERS, ZEMAX_A_NUMBER };

/* Reads a line; what the keyword wants is there. The file stands behind the keyword. */
typedef bool zemax_read_function(struct zemax_file *file, const struct zemax_line *line);

struct zemax_keyword {
    const char *words; /* separated by blanks; null ends a table */
    enum zemax_wants wants;
    bool is_length;            /* its numbers are in the file's unit */
    size_t kept;               /* where the file, or its surface, keeps the line; 0: nowhere */
    zemax_read_function *read; /* null: it is only kept */
};

#define ZEMAX_KEPT(owner, member) offsetof(struct owner, member)

/* Where words stand, as the table of them has it. */
#define ZEMAX_IN_SYSTEM         "system"
#define ZEMAX_IN_SURFACE        "surface"
#define ZEMAX_IN_CONFIGURATIONS "configurations"
#define ZEMAX_IN_TAIL           "behind"

/* Every word that is known. What is kept has a reader; what is lost may have one. */
extern const struct word_group zemax_words[];

/* Lines before the surfaces, which begin the line. */
extern const struct zemax_keyword zemax_system_keywords[];

/* MNUM, behind the surfaces: how many configurations there are. */
bool zemax_read_configurations(struct zemax_file *file, const struct zemax_line *line);

/* A line of the multiple configurations; what the table has not is lost where it changes. */
bool zemax_read_setting(struct zemax_file *file, struct text keyword);

/* The present line with its numbers, in the unit `scale`. */
struct zemax_line *zemax_line_of(struct zemax_file *file, struct text keyword,
                                 struct number_scale scale);

/*
 * Is every word of the line a number, up to text in quotes?
 *
 * Errors    ERROR_DATA at the first that is none, or is beyond 1e100
 */
bool zemax_all_numbers(const struct zemax_line *line);

/* The same, and there is one. */
bool zemax_has_number(const struct zemax_line *line);

/* -------- a file as a lens -------- */

/*
 * The material of a line GLAS NAME type surface nd Vd ..
 *
 * Which counts, name or numbers, is decided by the type: 1 is a model glass, its numbers count,
 * also beside the name of a catalogue's glass. Of 0, and of 3, a glass that may be substituted, the
 * catalogue's glass counts: the numbers may be left-overs of a model glass that was there before,
 * which the program ignores. A converter that is known to write the numbers of a patent there means
 * those. job->glass_numbers overrules all that. Where the two differ, the medium has a warning with
 * both.
 *
 * Given     line  not AIR, MIRROR or a pick-up
 * Errors    as foreign_glass; losses: a glass that neither a catalogue nor the line has
 */
bool zemax_glass(struct zemax_file *file, const struct zemax_line *line, struct medium *medium);

/* The medium before the next surface to add. */
struct medium zemax_medium_before(const struct lens *lens);

/* The next surface has the break; one that waits already goes to a plane. */
void zemax_hold_break(struct zemax_file *file, const struct displacement *coordinate_break);

/* A plane that does nothing but carry the break that waits, if one does. */
void zemax_add_plane(struct zemax_file *file);

/* COORDBRK: shift, then turn about x, y, z; with PARM 6 turn about z, y, x, then shift. */
void zemax_add_break(struct zemax_file *file, size_t at);

/* Does the break do nothing else, and a surface follow? Then it needs no plane of its own. */
bool zemax_is_bare(const struct zemax_file *file, size_t at);

/*
 * SCBD: the axis shifted and turned before a surface, and behind it before its distance, as
 * coordinate breaks there would do.
 *
 * Given     behind  the second of them: a plane has it, whose distance is that of the surface
 * Source    DDE codes 51 to 66 of surface data: order 0 shifts first, 1 turns first; status behind
 *           the surface 0 its own numbers, 1 those before it, 2 those before it undone
 * Errors    a loss: numbers that follow another surface
 */
void zemax_add_shift(struct zemax_file *file, size_t at, bool behind);

/*
 * A surface of a file has one aperture or none: a circle or ring (CLAP), a rectangle (SQAP), an
 * ellipse (ELAP), or what blocks: OBSC, SQOB, ELOB, a spider (SPID); decentred by OBDC. Polygons
 * stand in files of their own.
 *
 * Given     to  its diameter and whether it is the stop are set: of a surface with an aperture that
 *               passes only a diameter about all of it stays, or the stop's
 */
bool zemax_set_aperture(struct zemax_file *file, const struct zemax_surface *from,
                        struct surface *to);

/*
 * The shapes of the file that USAP, USOB or UDAD name, as UDAD has them row by row (UDAD 1 x y 0,
 * where 0 0 ends a polygon), else from the folder of the lens file: polygons (LIN x y, or x y, up
 * to BRK, or in old files to 0 0) and circles (CIR x y r).
 *
 * Given     apertures, count  receive them, in the frame of the surface
 * Source    rows of UDAD in sample files of the program (a slit, a grating); public readers and
 *           writers of such files (acorn, kgpy); that a circle may have a number of sides behind
 *           its radius, of which it is drawn
 * Result    false without an error: they are lost, which is said
 * Errors    a loss: no such file, a row of another form, other words, several shapes of which one
 *           is to pass light, but polygons apart in x or y, which become one
 */
bool zemax_user_apertures(struct zemax_file *file, const struct zemax_surface *from,
                          struct aperture **apertures, size_t *count);

/* The thicknesses, by the file's surface numbers. */
struct solver_state {
    struct zemax_file *file;
    const size_t *places;
    struct lens lens;
    struct figure *thickness;
    struct figure *curvature; /* solved ones; else typed.start is null */
    struct number_scale unit;
};

/*
 * Solve the curvature and the thickness of a surface.
 *
 * Result    in solving->thickness, curvature and lens. Of a solve that lenscalc does not know, or
 *           that has no answer, the file's number stands: zemax_stands
 */
void zemax_solve_surface(struct solver_state *solving, size_t at);

/*
 * What a solve that follows a ray gives in some lens.
 *
 * Given     is_curvature  the curvature's, else that of the thickness
 * Result    false: it follows none, or has no answer
 */
bool zemax_solve_in(const struct solver_state *solving, size_t at, bool is_curvature,
                    const struct lens *lens, struct arena *arena, struct pair *value);

/* Pick-ups of curvatures and thicknesses become those of the lens, whose numbers are all set. */
void zemax_keep_pickups(const struct solver_state *solving);

/* A curvature of a surface, 1/mm: as a radius where a short one has it as its reciprocal. */
void zemax_set_curvature(struct zemax_file *file, struct figure curvature, struct surface *to);

/* The medium behind a surface; that before it where it is a mirror (which *medium becomes). */
bool zemax_medium(struct zemax_file *file, const struct zemax_surface *surface,
                  const struct medium *before, struct medium *medium);

/* Is the image plane set by the solve that brings the marginal ray to height 0 there? */
bool zemax_focuses(const struct zemax_file *file);

/*
 * All surfaces between object and image, with their solves.
 *
 * Given     file  parsed; object, aperture, fields and wavelengths of the lens are set
 */
bool zemax_surfaces(struct zemax_file *file);

/*
 * What the operands of one configuration put in the place of the lines of the file.
 *
 * Given     file           parsed; a copy for this configuration alone
 *           configuration  from 0 on
 */
bool zemax_place_settings(struct zemax_file *file, size_t configuration);

/*
 * The thicknesses of all surfaces, solved.
 *
 * Given     places  index in the lens of each surface of the file; LENS_NONE = it has none
 */
bool zemax_thicknesses(struct zemax_file *file, const size_t *places);

/*
 * Are the pick-ups without circles: thicknesses, curvatures, semi-diameters, parameters?
 *
 * Given     file  parsed, its numbers of surfaces without gaps
 * Errors    ERROR_DATA at a pick-up that follows itself, through however many others
 */
bool zemax_check_circles(const struct zemax_file *file);

bool zemax_write(struct foreign_job *job, const struct lens *lens, struct text *text,
                 struct error *error);

#endif
