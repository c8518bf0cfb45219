/* exchange/sequence.h - a lens as CODE V and OSLO have it: commands, surfaces, solves. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_EXCHANGE_SEQUENCE_H
#define LENSCALC_EXCHANGE_SEQUENCE_H

#include "base/arena.h"
#include "base/error.h"
#include "base/text.h"
#include "exchange/foreign.h"
#include "exchange/own_glass.h"
#include "file/lens_build.h"
#include "file/lens_solve.h"
#include "file/lens_words.h"
#include "optics/aperture.h"
#include "optics/lens.h"

#include <stdbool.h>
#include <stddef.h>

/* What separates the commands of a program's files. */
struct command_grammar {
    const char *comment; /* from here to the end of the line, outside of quotes */
    const char *quotes;  /* characters that enclose a word with blanks */
    char separator;      /* between two commands of one line */
    char continuation;   /* at the end of a line: the command goes on; 0 = there is none */
    double infinity;     /* distances of the object of this many units and more are infinite */
};

/* A word and where it stands. */
struct command_word {
    struct text text; /* without its quotes */
    struct text line; /* the physical line */
    long number;      /* of that line, 1-based */
    bool is_quoted;
};

enum { COMMAND_MOST_WORDS = 4096 };

/* A file being read, command by command. Texts point into the content. */
struct commands {
    struct foreign_job *job;
    struct error *error; /* receives what is wrong */
    const struct command_grammar *grammar;
    struct text rest; /* what is still to read */
    struct text line; /* the present line, without its comment */
    const char *at;   /* where its next word begins */
    bool goes_on;     /* a mark of continuation has ended it */
    long number;
    struct number_scale scale; /* unit of a length in mm */
    struct command_word *words;
    size_t count, room;
};

void commands_open(struct commands *commands, struct foreign_job *job, struct text content,
                   const struct command_grammar *grammar, struct error *error);

/*
 * Go to the next command.
 *
 * Result    false at the end of the file with error->code ERROR_NONE
 * Errors    ERROR_DATA with line and column: a quote that does not end in its line, a command of
 *           more than COMMAND_MOST_WORDS words
 */
bool commands_next(struct commands *commands);

/* The word of this number, or an empty one where the command has ended. */
struct command_word commands_word(const struct commands *commands, size_t word);

/* The line of a word, for foreign_loss and file_words_fail. */
struct file_words commands_place(const struct commands *commands, const struct command_word *word);

/* Report something wrong with a word. Returns false. */
#define commands_fail(commands, word, ...)                                                         \
    file_words_fail((const struct file_words[1]){commands_place((commands), (word))},              \
                    (word)->text, __VA_ARGS__)

/* A loss at a word: see foreign_loss. Returns true. */
#define commands_loss(commands, word, effect, instead, ...)                                        \
    foreign_loss((commands)->job,                                                                  \
                 (const struct file_words[1]){commands_place((commands), (word))}, (word)->text,   \
                 (effect), (instead), __VA_ARGS__)

/* Leave out the present command, as a loss: "NAME: WHAT". Returns true. */
bool commands_lose(const struct commands *commands, enum loss_effect effect, const char *instead,
                   const char *what);

/* A number in a word of the command, as lens_words_figure reads it: a length in the unit. */
bool commands_figure(const struct commands *commands, size_t word, bool is_length, const char *what,
                     struct figure *figure);

/* The same, and nothing stands behind it. */
bool commands_value(const struct commands *commands, size_t word, bool is_length, const char *what,
                    struct figure *figure);

/*
 * The distance of an object: `inf` and `infinity` too, which become as far as the grammar's
 * infinity. Errors as commands_figure
 */
bool commands_object(const struct commands *commands, size_t word, struct figure *figure);

/* A curvature that was computed, 1/mm, with the digits of the file's unit. */
struct figure commands_curvature(const struct commands *commands, struct pair curvature);

/* Nothing may follow from this word on. */
bool commands_end(const struct commands *commands, size_t word);

/*
 * A whole number in a word, or in the part of it that is no letter.
 *
 * Given     digits  that part; what  "number of the surface"; least  the smallest that is one
 */
bool commands_count(const struct commands *commands, const struct command_word *word,
                    struct text digits, const char *what, size_t least, size_t *value);

/* How a shifted and turned surface moves what comes after it. */
enum sequence_move {
    SEQUENCE_ALONG, /* the axis goes on in the turned system */
    SEQUENCE_BACK,  /* the axis goes on unbent */
    SEQUENCE_BEND,  /* the axis is turned once more behind it, as a mirror turns it */
    SEQUENCE_RETURN /* the surface stays; behind it the axis is turned and shifted back */
};

/* A thickness or curvature that follows from a ray. */
struct sequence_solve {
    bool is_set, of_angle; /* else of a height, mm */
    bool is_unknown;       /* of something else: the number of the file stands */
    enum solve_ray ray;
    struct figure target;
    struct command_word at;
};

/* A number that follows another surface's: scale * its + offset. */
enum sequence_what {
    SEQUENCE_RADIUS,
    SEQUENCE_CURVATURE,
    SEQUENCE_THICKNESS,
    SEQUENCE_DIAMETER,
    SEQUENCE_CONIC,
    SEQUENCE_MEDIUM,
    SEQUENCE_PROFILE, /* curvature, conic and coefficients */
    SEQUENCE_TURNS,   /* shifts and turns; of a scale below 0 undone: in the other order too */
    SEQUENCE_LENGTH   /* a thickness: the sum of those from `source` up to before `end` */
};

struct sequence_pickup {
    enum sequence_what what;
    size_t target, source, end;
    struct pair scale, offset; /* offset in mm, 1/mm, or 1 */
    struct command_word at;
};

/*
 * An aperture while it is read. A clear circle of which only the decentre is known has the
 * diameter of the surface.
 */
struct sequence_aperture {
    struct command_word at;
    struct text label; /* by which later commands name it */
    struct aperture aperture;
};

/* A surface as the file has it. Tilts are right-handed, as in a lens. */
struct sequence_surface {
    struct command_word at; /* where it begins */
    struct figure curve;    /* radius in mm, or curvature in 1/mm; not given: typed.start is null */
    bool is_radius;
    struct figure thickness;
    struct pair extra; /* mm, added to every thickness in the end */
    struct medium medium;
    bool reflects;
    struct figure diameter, conic; /* not given: typed.start is null */
    unsigned coefficients;
    struct figure coefficient[LENS_COEFFICIENTS];
    enum curved curved;
    bool is_special; /* its coefficients are those of CODE V's SPS ODD */
    bool is_stop;
    struct sequence_aperture *apertures;
    size_t aperture_count, aperture_room;
    bool has_lost_aperture; /* its decentre is lost: no centred one may stand for it */
    const char *name;
    enum sequence_move move;
    bool turns_first;                /* before it is shifted, and about z first */
    struct figure shift[3], turn[3]; /* x, y, z */
    struct command_word decentred_at;
    size_t place;              /* in the lens */
    size_t planes_behind;      /* in the lens, that turn and shift the axis */
    struct command_word glass; /* what is still to be looked up; empty = medium is known */
    struct sequence_solve thickness_solve, curvature_solve;
};

/* A file's surfaces, the object first, the image last. */
struct sequence {
    bool is_afocal;     /* the image is given by angles */
    bool has_positions; /* it is that of one of them: bends have their planes in all */
    bool is_open;       /* the size of the marginal ray is one that only the whole lens gives */
    struct foreign_job *job;
    const struct commands *commands;
    struct lens_build *build;
    struct sequence_surface *surfaces;
    size_t count, room;
    struct sequence_pickup *pickups;
    size_t pickup_count, pickup_room;
    struct environment environment;
};

/* A number that was not given. */
static const struct figure sequence_nothing = {{0, 0}, {NULL, 0}, LENS_NONE};

/* One more surface, a plane in air; valid until the next one is added. */
struct sequence_surface *sequence_add(struct sequence *sequence, struct command_word at);

void sequence_pick_up(struct sequence *sequence, struct sequence_pickup pickup);

/* Is the figure given and other than 0? */
static inline bool sequence_is_some(const struct figure *figure)
{
    return figure->typed.start != NULL && figure->value.hi != 0;
}

/*
 * The present command is a temperature in C, or a pressure.
 *
 * Given     per_atmosphere  the pressure of one standard atmosphere in the command's unit
 */
bool sequence_environment(struct sequence *sequence, bool is_temperature, double per_atmosphere);

/* A figure of 1/length^power that was read as a plain number. */
static inline void sequence_per_length(const struct commands *commands, int power,
                                       struct figure *figure)
{
    figure->value = lens_words_per_length(figure->value, commands->scale, power);
}

/* A full diameter from the radius that was read. */
struct figure sequence_diameter(const struct figure *radius, struct arena *arena);

/* The conic (order 0) or the coefficient of r^order, from a number in the file's unit. */
void sequence_set_constant(const struct sequence *sequence, struct sequence_surface *surface,
                           int order, struct figure figure);

/* The same, from a word of the present command, which is the last. */
bool sequence_read_constant(const struct sequence *sequence, size_t word,
                            struct sequence_surface *surface, int order);

/*
 * A shift in mm or a turn in degrees of a surface, from such a word: 'X' 'Y' 'Z',
 * 'A' 'B' 'C' about them, of which both programs have those about x and y left-handed.
 */
bool sequence_read_shift(const struct sequence *sequence, size_t word,
                         struct sequence_surface *surface, int what);

/* A wavelength, in the words of the file and its `unit`, "nm" or "um", with its weight. */
void sequence_add_wave(const struct sequence *sequence, struct text wave, const char *unit,
                       struct text weight);

/*
 * Indices as a .lens file has them: {486.1nm 1.5224, 587.6nm 1.5168}, or the one number where all
 * are the same.
 *
 * Given     unit  of the wavelengths, "nm" or "um"
 */
const char *sequence_indices(struct arena *arena, const struct text *waves, const char *unit,
                             const struct command_word *indices, size_t count);

/* A medium from what a .lens file would have for it. */
bool sequence_medium(const struct commands *commands, const struct command_word *at,
                     const char *written, struct medium *medium);

/* Is there an object, at a finite distance? */
bool sequence_is_near(const struct sequence *sequence);

/*
 * Make the lens: pick-ups, surfaces, solves; the header of the lens is there already.
 *
 * Errors    ERROR_DATA: no surface, a pick-up of a surface that is not there, a solve without an
 *           answer; what a lens cannot hold, unless lossy
 */
bool sequence_finish(struct sequence *sequence);

/*
 * The pick-ups, each behind those that it follows. A part of sequence_finish.
 *
 * Errors    ERROR_DATA: a surface that is not there, pick-ups that go in a circle
 */
bool sequence_apply_pickups(const struct sequence *sequence);

/* What of them says the same of the lens, which is whole, becomes its own. */
void sequence_keep_pickups(const struct sequence *sequence);

/* The solves; `indices` are those of the lens's surfaces. A part of sequence_finish. */
bool sequence_solve_all(const struct sequence *sequence, const size_t *indices);

/* -------- parts of sequence_finish: shifts and turns -------- */

/* Beside a shift along the axis, which goes into the thicknesses. */
bool sequence_is_decentred(const struct sequence_surface *surface);

/* What the surfaces' shifts along z do to the thicknesses around them. */
void sequence_spread_z(const struct sequence *sequence);

/* Errors    losses: turns whose order a lens does not have */
void sequence_check_move(const struct sequence *sequence, const struct sequence_surface *from);

/* Planes before a surface that is turned about z, y and x before it is shifted. */
void sequence_turn_first(const struct sequence *sequence, const struct sequence_surface *from);

/* Shift and turn a surface. Result: the one whose distance is that to the next. */
struct surface *sequence_move_surface(const struct sequence *sequence,
                                      struct sequence_surface *from, struct surface *surface);

#endif
