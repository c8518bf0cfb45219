/* exchange/foreign.h - lens files of other programs: a format, its glasses, and what is lost. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_EXCHANGE_FOREIGN_H
#define LENSCALC_EXCHANGE_FOREIGN_H

#include "base/arena.h"
#include "base/error.h"
#include "base/file_type.h"
#include "base/text.h"
#include "data/lensdb.h"
#include "file/file_words.h"
#include "file/lens_build.h"
#include "file/lens_file.h"
#include "optics/growing.h"
#include "optics/lens.h"

#include <stdbool.h>
#include <stddef.h>

/* Of other programs' lists, where the object and the image count. */
enum { FOREIGN_MOST_SURFACES = LENS_MOST_SURFACES + 2 };

/* What is not as the file means it where a loss is left out, the worst first. */
enum loss_effect {
    LOSS_OF_LENS, /* all: there is no lens without it, whatever is allowed */
    /*
     * Where rays go, and how strongly they are bent: the focal length may not be that of the file,
     * and no solve follows rays; the numbers that the file has for them stand.
     */
    LOSS_OF_POWER,
    LOSS_OF_RAYS,       /* where rays go */
    LOSS_OF_VIGNETTING, /* which of them pass, and their weights */
    LOSS_OF_NOTHING,    /* no number */
    LOSS_EFFECTS
};

/* Something that a lens of lenscalc, or the other program's file, cannot hold. */
struct foreign_loss {
    long line;        /* in the file read; 0 = written, or not of one line */
    const char *what; /* one line, in the arena */
    enum loss_effect effect;
    const char *message;       /* without what is done instead */
    struct file_words line_of; /* for messages, where `line` is not 0 */
    struct text word;
};

/* One file being read or written. */
struct foreign_job {
    const char *source; /* for messages */
    struct arena *arena;
    const struct glass_source *glasses; /* null: named glasses stay unresolved */
    bool reads_beside; /* the source is a path: files of its folder that it names are read */
    bool lossy;        /* losses are listed; else they are an error together */
    enum glass_numbers glass_numbers; /* of formats that have indices beside names of glasses */
    struct foreign_loss *losses;
    size_t loss_count, loss_room;
    const char *lost_power; /* the first loss that bends light; null = none */
    bool lacks_glass;       /* of some loss: a further catalogue may have it */
    const char *cut_short;  /* why the end of the file may be missing; null = it is whole */
    bool has_end;           /* the file ends as its format does, with or without an end of line */
};

/* What a program calls a unit of length: of several words for one, it writes the first. */
struct foreign_unit {
    const char *word, *unit; /* "METER", "m"; the last of a table is null */
};

/* The unit of a word, as lens.unit has it, without regard to case; null: there is no such word. */
const char *foreign_unit_named(const struct foreign_unit *units, struct text word);

/* The word for a unit; null: the program has none. */
const char *foreign_unit_word(const struct foreign_unit *units, const char *unit);

struct word_group;

/* A kind of file. `read` or `write` is null where it does not exist. */
struct foreign_format {
    struct file_type type; /* "zmx", "Zemax OpticStudio", ".zmx" */
    /* Does the text look like one? Content decides before the name's ending does. */
    bool (*is_like)(struct text content);
    /*
     * Read a lens.
     *
     * Given     content  UTF-8 with \n line ends; the lens may point into it
     * Errors    ERROR_DATA with line, column and caret; what a lens cannot hold, unless lossy
     */
    bool (*read)(struct foreign_job *job, struct text content, struct lens *lens,
                 struct error *error);
    /*
     * Write a lens of one position (or of all, where the format has them) into the arena.
     *
     * Errors    ERROR_DATA: what the format cannot hold, unless lossy
     */
    bool (*write)(struct foreign_job *job, const struct lens *lens, struct text *text,
                  struct error *error);
    bool has_thick;     /* it can hold a thick lens among the surfaces */
    bool has_settings;  /* and what the positions set anew: struct lens_setting, stops, lights */
    bool has_design;    /* marks of positions, pick-ups, goals, tolerances */
    bool has_apertures; /* `write` keeps the apertures of surfaces, or says which it cannot */
    bool has_glass_numbers;         /* indices may stand beside the name of a glass */
    const struct word_group *words; /* what becomes of each word when it is read; null: not told */
};

/*
 * Record that something is lost; never drop or replace anything without it.
 *
 * Given     words, word  where it stands (a line's words, and the word); words null: nowhere
 *           effect       what is not as the file means it then
 *           instead      what is done instead, which lists say and errors do not; null = nothing
 *           format       what is lost
 * Result    true, for readers to return: the loss is in the list, and reading goes on so that all
 *           are found. foreign_settle says what becomes of them
 */
bool foreign_loss(struct foreign_job *job, const struct file_words *words, struct text word,
                  enum loss_effect effect, const char *instead, const char *format, ...)
    __attribute__((format(printf, 6, 7)));

/* Take those losses from number `from` on out of the list that stand before it already. */
void foreign_forget_repeated(struct foreign_job *job, size_t from);

/* The same of a file that is being written: it cannot hold something of the lens. */
#define foreign_lose(job, effect, instead, ...)                                                    \
    ((void)foreign_loss((job), NULL, (struct text){NULL, 0}, (effect), (instead), __VA_ARGS__))

/* Report something wrong with the whole file, as ERROR_DATA. False */
#define foreign_fail(job, error, ...) fail_in((error), (job)->source, 0, 0, __VA_ARGS__)

/* Where what is lost bends light: a warning of the lens, and a note that files keep. */
void foreign_mark_power(const struct foreign_job *job, struct lens_build *build);

/*
 * The end of the file may be missing, as of a download that broke: a warning of the lens. Where
 * there is no lens without what is missing the reader refuses the file instead.
 *
 * Given     what  "its last line has no end"; of several the first counts
 */
void foreign_cut_short(struct foreign_job *job, const char *what);

/*
 * The end of reading or writing a file.
 *
 * Given     done  it has gone well but for what is lost
 * Result    done, where nothing is lost, or the job is lossy and the lens is not lost
 * Errors    ERROR_DATA: the loss that changes most, at its place, and all others in error->more;
 *           these too where it has not gone well
 */
bool foreign_settle(const struct foreign_job *job, bool done, struct error *error);

/*
 * List the losses as "FILE:LINE: lost: WHAT", one a line, in the order of the file; those of
 * writing come last.
 */
void foreign_losses(const struct foreign_job *job, struct text_buffer *list);

/* The same in one line: "rays: 16: WHAT; vignetting: 12,20: WHAT", those that change most first. */
void foreign_summary(const struct foreign_job *job, struct text_buffer *line);

/*
 * Record that neither a catalogue nor the file has a glass: the lens is refused, when all is read.
 *
 * Given     medium  receives one with which reading goes on
 * Result    true
 */
bool foreign_lack(struct foreign_job *job, const struct file_words *words, struct text word,
                  struct medium *medium, const char *message);

/* A glass as a file has it. */
struct foreign_name {
    struct text name;
    const struct text *catalogs; /* names in the order of the file */
    size_t catalog_count;        /* 0: the file names none, and all are looked through */
    double nd, Vd;               /* that stand beside the name; 0 = none */
    double nd_rounding, Vd_rounding;
    bool has_homonyms; /* the program's names come before lenscalc's own */
    bool is_by_name;   /* nd and Vd only decide between several glasses of the name */
};

/*
 * Find a glass as the file's catalogues have it: in no other than those, so that homonyms are
 * decided by their order, and by nd and Vd where the file has them.
 *
 * Given     medium  receives it, written CATALOG:NAME as the catalogue spells it
 * Result    the first with this nd and Vd; where is_by_name and there is none, the first of the
 *           name. False with ERROR_NONE where no catalogue has it so: the reader may know an index
 * Errors    ERROR_DATA with the place: several catalogues have the name with different data, and
 *           the file names none; the glass of a user's AGF file is damaged
 * Note      a name is never changed but by glass_alias and glass_homonym, and then the medium has a
 *           warning
 */
bool foreign_glass(struct foreign_job *job, const struct file_words *words,
                   const struct foreign_name *named, struct medium *medium, struct error *error);

/*
 * Has a glass the nd and Vd that stand beside its name, within the rounding of the file and of the
 * catalogue's own figures? True too where they are not known, or the glass is not for the d line.
 */
bool foreign_is_rounded(const struct medium *medium, const struct foreign_name *named);

/* One more warning of a medium. */
void foreign_warn(const struct foreign_job *job, struct medium *medium, const char *warning);

/* "the glass 'SK2' is SCHOTT:SK2 of nd .. and Vd .., beside which the file has nd .. and Vd .." */
char *foreign_difference(const struct foreign_job *job, const struct foreign_name *named,
                         const struct medium *medium);

#endif
