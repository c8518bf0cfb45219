/* cli/options/option.h - what a command accepts: options as const descriptions of a struct. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CLI_OPTIONS_OPTION_H
#define LENSCALC_CLI_OPTIONS_OPTION_H

#include "analysis/setup/setup.h"
#include "analysis/setup/setup_question.h"
#include "base/arena.h"
#include "base/error.h"
#include "base/file_type.h"
#include "base/quantity.h"
#include "base/text.h"
#include "cli/options/option_glass.h"
#include "cli/options/option_light.h"
#include "data/lensdb.h"
#include "file/part.h"
#include "optics/first_order.h"
#include "optics/lens.h"
#include "photo/format.h"
#include "report/warnings.h"

#include <math.h>
#include <stdbool.h>
#include <stddef.h>

struct option;

/* What reading a value may need. */
struct reader {
    struct lensdb *db;
    struct arena *arena;       /* for what the value points to */
    bool nominal;              /* labels of stop series stand for their exact values */
    bool fallback;             /* the text is what the program assumes, not what the user typed */
    bool gives_way;            /* it is a default of the user's: what is asked for comes first */
    struct lens_cache *lenses; /* null = every lens is read anew */
    bool recalls; /* of a list of values that are large, names may do: see option_kind.recall */
    struct warnings *doubts; /* of values that are legal but odd; null = nobody listens */
};

/* What was found of a lens in one position, for the rows that ask again. */
struct lens_memo {
    bool is_known;
    double wavelength; /* um, that it was found for */
    int section;
    struct first_order first;
    struct setup_width width;
    const char *warning; /* null = all is well */
};

/* A lens as the user named it. */
struct lens_value {
    const struct lens *lens; /* null = not given */
    const char *name;        /* as typed */
    const char *warning;     /* what lens_check doubts; null = nothing */
    struct arena *arena;     /* where it lives */
    struct lens_memo *memo;  /* one a position */
    size_t serial; /* which of the lenses that were read: what is known of it; 0 = nobody counts */
};

/* A lens that is read again when it is wanted. */
struct lens_slot {
    struct arena arena;
    struct lens_value value;
    size_t used; /* when it was wanted last */
};

/*
 * The lenses of a run. The first ones stay, which rows name again and again; of those of a longer
 * list only the names stay, beside the lenses that were wanted last.
 */
struct lens_cache {
    struct arena *arena;       /* lives as long as the run */
    struct lens_value *lenses; /* null = none yet */
    size_t count;
    struct lens_slot *slots; /* null = none yet */
    size_t slot_count;
    size_t read, wanted; /* how often, up to now */
};

/* Make a lens known that was read elsewhere, and may be used there by another thread meanwhile. */
void option_lens_lend(struct lens_cache *cache, const struct lens_value *value);

/* So many lenses of a list are wanted at once, where that is more than one. */
void option_lens_at_once(struct lens_cache *cache, size_t count);

/* A lens that is still text: it is read by the command. */
struct lens_text_value {
    const char *source; /* what to call it in messages; null = not given */
    struct text content;
    bool is_file; /* the source is its path */
    struct lensdb *db;
    struct arena *arena; /* that of the value */
};

/* A wavelength: a number with a unit (nm), or the name of a spectral line. */
struct wavelength_value {
    double wavelength; /* um; 0 = not given */
    const char *name;  /* as typed */
};

/* mm to um by way of the digits: 0.55um and 550 are the same, and print so. */
double wavelength_micrometres(double millimetres);

/* And back: um as columns of lengths have it, in mm, so that it prints in nm as typed. */
double wavelength_millimetres(double micrometres);

/* One of a set. A number without a unit is both: degrees of a far object, mm of a near one. */
struct field_item {
    double angle;  /* rad; NaN: a length was typed */
    double height; /* mm; NaN: an angle was typed */
    double weight; /* 1 unless typed */
};

/* A set that is judged as a whole: 0,10:2,14deg. */
struct fields_value {
    const char *text; /* as typed; null = not given */
    const struct field_item *items;
    size_t count;
};

enum { MOST_FIELDS = 64 };

/* A focal length as the user wrote it, mm. */
struct focal_value {
    double length;     /* NaN: not given, or an equivalent one that is not settled */
    double equivalent; /* "26mm-eq": 26; else NaN */
    bool of_camera;    /* the length is that of the lens of --sensor: nobody gave one */
    double fnumber;    /* then that of this lens, where nobody gave one either; else NaN */
};

/* The options of a command that take such values, and the one that names the sensor. */
struct focal_options {
    const struct option *focal[2], *sensor;
    size_t count;
    const struct option *lens, *fnumber; /* --lens, --aperture; null = there is none */
    const struct option *all;            /* of the command */
    size_t all_count;
};

struct focal_options focal_options_of(const struct option *options, size_t count);

/* Refuse a list in which some are equivalent ones and some are not: one axis has one measure. */
bool focal_check_alike(const struct focal_value *values, size_t count, const struct option *option,
                       struct error *error);

/* Is it, in this input, given as an equivalent one? */
bool focal_is_equivalent(const struct option *option, const void *input);

/*
 * The real length of focal lengths that are equivalent ones; that of the camera's own lens, and its
 * f-number, where neither a focal length nor --lens nor a goal is given, which the sensor's name
 * says then; and a doubt about those of phones,
 * drones and action cameras that no main lens of them has.
 *
 * Given     input   the command's struct with all of its options
 *           doubts  null: nobody listens
 * Formula   f = equivalent x diagonal/sqrt(36^2 + 24^2)
 * Source    [Ray02]; makers state equivalents by the diagonal
 * Errors    ERROR_USAGE: nobody named a sensor, or the command has no option for one
 * Limits    The main lenses of such cameras are 15 to 35 mm equivalent, as their makers state them:
 *           what is longer than 40 is doubted where the sensor is smaller than 4/3. Drones with
 *           larger ones change lenses; compact cameras zoom to 3000 mm equivalent, so that no
 *           length is implausible there
 */
bool focal_settle(const struct focal_options *options, void *input, struct warnings *doubts,
                  struct error *error);

/* A point or a direction: x:y:z. */
struct vector_value {
    bool is_given;
    double at[3]; /* mm, or plain numbers */
};

/* A point of the pupil: x:y, in units of its radius. */
struct pupil_value {
    bool is_given;
    double at[2];
};

/* Where rays end. */
enum target_kind { TARGET_USUAL, TARGET_IMAGE, TARGET_LAST, TARGET_SURFACE };

struct target_value {
    enum target_kind kind; /* TARGET_USUAL: not given */
    long surface;          /* TARGET_SURFACE: from 1 */
};

/* Several wavelengths at once: d:1,F:0.5; or photopic. */
struct spectrum_value {
    const char *text; /* as typed; null = not given */
    const struct setup_wavelength *items;
    size_t count;
};

enum { MOST_SPECTRUM = 64 };

/*
 * Read a wavelength, um: a number with a unit, or the name of a spectral line.
 *
 * Errors    ERROR_USAGE, ERROR_DOMAIN, the message naming the option; as lines_find
 */
bool wavelength_read(const struct reader *reader, const struct option *option, struct text text,
                     double *wavelength, struct error *error);

/* Data that an answer may depend on, which the user may add to. */
enum reads {
    READS_LENSDB = 1,  /* tables of --lensdb */
    READS_GLASSES = 2, /* catalogues of --lensdb and --agf */
    READS_LENSES = 4,  /* lenses of --lensdb, and files of other programs */
};

/* A kind of value. `read` fills a member of the input struct. */
struct option_kind {
    const char *name;
    size_t size;
    bool is_list; /* may be swept */
    bool (*read)(const struct reader *reader, const struct option *option, struct text text,
                 void *member, struct error *error);
    /* Read again, for the present row, a value of which a list has the name only; null: lists have
       values whole. */
    bool (*recall)(const struct reader *reader, void *member, struct error *error);
    /* The value's name, where it has one ("exact", "35mm (36 x 24 mm)"): a member of it, or what
       the function finds; neither: it has none. */
    bool is_named;
    size_t name_at;
    const char *(*name_of)(const struct option *option, const void *member);
    /* A value without a name in words that read back; null for one that is absent, and where names
       or numbers say all. */
    const char *(*words_of)(const struct option *option, const void *member, struct arena *arena);
    /* Its number in its own unit, where ranges of them may be swept; null: it has none. */
    double (*number_of)(const void *member);
    /* Set it to such a number, typed in this unit; null: it is read from text. */
    void (*set_number)(void *member, double number, const struct unit *unit);
    unsigned reads;           /* enum reads: where its values come from */
    size_t nan_at, nan_count; /* numbers of a member that is absent: NaN, all else is zero */
};
#define OPTION_NAMED(S, member) .is_named = true, .name_at = offsetof(S, member)

extern const struct option_kind kind_quantity, kind_focal, kind_choice, kind_flag, kind_text,
    kind_count, kind_sensor, kind_coc, kind_loss, kind_filters, kind_film, kind_scene, kind_series,
    kind_glass, kind_interval, kind_lens, kind_lens_text, kind_wavelength, kind_vector, kind_pupil,
    kind_plane, kind_target, kind_fields, kind_spectrum, kind_print, kind_pixels, kind_marking,
    kind_eyepiece, kind_size, kind_part;

/* A sensor as the user named it. */
struct sensor_value {
    struct sensor size;     /* mm */
    const char *name;       /* as printed: "35mm (36 x 24 mm)" */
    const char *pitch_note; /* what to know of the pixel pitch; null = nothing */
    double focal;           /* of a camera whose lens is fixed, mm; else NaN */
    bool is_fallback;       /* nobody named it */
    bool is_wide;           /* of a camera whose lens is fixed and wide: phone, drone, action */
    double fnumber;         /* of a fixed lens; else, and where it is not known, NaN */
    const char *bare_name;  /* of such a camera: its name; else null */
    const char *with_lens;  /* of such a camera: the name with what its lens is; else null */
    bool is_optical;        /* an optical format, "1/2.8in": its shape is not sure */
};

/* Two sides as the user wrote them, "100x75mm", mm; NaN = not given. */
struct size_value {
    double width, height;
};

/* Numbers of pixels as the user wrote them; NaN = not given. */
struct pixels_value {
    double wide, high; /* "2448x2048", "4096" */
    double total;      /* of "4Mpx" alone */
};

/* A format or camera of lensdb; the name lies in the reader's arena. */
void option_sensor_of(const struct reader *reader, const struct lensdb_sensor *found,
                      struct sensor_value *sensor);

/* A print as the user wrote it, mm; NaN = not given. */
struct print_value {
    double longer, shorter; /* sides of the paper; of a length alone the longer one */
    double viewing;         /* distance it is looked at from */
    double acuity;          /* of the eye, line pairs per mm at 25 cm */
    const char *criterion;  /* "print A2@1m", as typed */
};

/* An eyepiece: its focal length, or a real one as kind_lens reads it. */
struct eyepiece_value {
    double focal; /* mm; NaN: a real one, or not given */
    struct lens_value lens;
};

/*
 * What is marked on an optical instrument: a power and a second number, "10x42" on binoculars,
 * "40x/0.65" on an objective, "10x/22" on an eyepiece, which may have the power alone.
 */
struct marking_value {
    double power, number; /* NaN = not given */
    const char *behind;   /* what stands behind them: "oil"; "" = nothing */
    const char *name;     /* as typed; null = not given */
};

/*
 * Read "36x24mm" or "36 x 24 in": two lengths with one unit, mm where none stands there.
 *
 * Given     sides  receives width and height, mm, not checked;  has_unit  is there a unit?
 * Errors    ERROR_USAGE: a bad length; code ERROR_NONE: it is no size
 */
bool option_read_size(const struct option *option, struct text text, double sides[2],
                      bool *has_unit, struct error *error);

/* The criterion of a circle of confusion that is a length. */
#define COC_GIVEN "given"

/* A circle of confusion as the user wrote it. */
struct coc_value {
    struct coc coc;
    const char *criterion; /* "d/1500"; "given" for a length */
    bool is_fallback;      /* nobody asked for it: it may be solved for instead */
};

/* The kind of an option is that of its member, so that table and struct cannot disagree. */
#define OPTION_KIND(S, member)                                                                     \
    _Generic(((S *)0)->member,                                                                     \
        double: &kind_quantity,                                                                    \
        struct focal_value: &kind_focal,                                                           \
        int: &kind_choice,                                                                         \
        long: &kind_count,                                                                         \
        bool: &kind_flag,                                                                          \
        const char *: &kind_text,                                                                  \
        struct sensor_value: &kind_sensor,                                                         \
        struct coc_value: &kind_coc,                                                               \
        struct loss_value: &kind_loss,                                                             \
        struct filters_value: &kind_filters,                                                       \
        struct film_value: &kind_film,                                                             \
        struct scene_value: &kind_scene,                                                           \
        struct series_value: &kind_series,                                                         \
        struct glass_value: &kind_glass,                                                           \
        struct interval_value: &kind_interval,  \
        struct lens_value: &kind_lens, \
        struct lens_text_value: &kind_lens_text, \
        struct wavelength_value: &kind_wavelength, \
        struct vector_value: &kind_vector, \
        struct pupil_value: &kind_pupil, \
        struct plane_value: &kind_plane, \
        struct target_value: &kind_target, \
        struct fields_value: &kind_fields, \
        struct spectrum_value: &kind_spectrum, \
        struct print_value: &kind_print, \
        struct pixels_value: &kind_pixels, \
        struct marking_value: &kind_marking, \
        struct eyepiece_value: &kind_eyepiece, \
        struct size_value: &kind_size, \
        struct part: &kind_part)

#define OPTION(S, member) .kind = OPTION_KIND(S, member), .offset = offsetof(S, member)

/* Above 0, or from 0 on, as flags have it. */
#define OPTION_POSITIVE .lowest = 0, .highest = INFINITY

/* Of f-numbers: sin theta' is 1 at most, and twice it 1/N. */
#define OPTION_USUAL_FNUMBER                                                                       \
    .usual = {0.5, INFINITY}, .unusual = "no lens in air can be faster than f/0.5"

enum option_flag {
    OPTION_ABOVE_LOWEST = 1, /* the lowest value itself is not allowed */
    OPTION_NO_INFINITY = 2,
    OPTION_OPERAND = 4,  /* may stand without its name */
    OPTION_REST = 8,     /* an operand that takes all words that are left, joined by blanks */
    OPTION_COMMON = 16,  /* of every command */
    OPTION_FILE = 32,    /* names a file */
    OPTION_SETTING = 64, /* goals are solved for the settings that are not given */
    OPTION_GOAL = 128,
    OPTION_MANY = 256,    /* an operand that all words go to that are left: a list of values */
    OPTION_CURRENT = 512, /* of several glasses of a name the current one */
    OPTION_FIELD = 1024,  /* of a lens, answered one by one: no weights */
    OPTION_BELOW_HIGHEST = 2048, /* the highest value itself is not allowed */
    OPTION_T_STOP = 4096,        /* an f-number that is a T-stop: T2.2 says nothing odd */
    OPTION_TOGETHER = 8192,      /* an operand that is all words that are left, as one value */
    OPTION_NO_SERIES = 16384,    /* no setting of a camera: it has no labels of a stop series */
    OPTION_SEVERAL = 65536,      /* may be given several times: its values are one list */
    OPTION_EMPTY = 131072,       /* a text that may be empty */
    OPTION_SETTING_TOO = 262144, /* a setting that only goals of two are solved for */
    OPTION_GOAL_OF_TWO = 524288, /* a goal that is open while one of these is not given */
    OPTION_OF_CAMERA = 1048576,  /* a focal length: else that of the lens of a --sensor */
    OPTION_ASIDE = 32768 /* says how work is done, not what comes of it: threads, a part of it */
};

struct option {
    const char *name; /* "focal-length" */
    char letter;      /* 'f', or 0 */
    const struct option_kind *kind;
    size_t offset;
    const char *quantity; /* what formulas call it; null = its name with blanks, "focal length" */
    const char *called;   /* how it was given, where not by its name: "column 's_m'"; else null */
    const char *column;   /* the output column that repeats it: "focal"; null = as its own name */
    const struct dimension *dimension; /* of a quantity */
    const char *unit;                  /* of a bare number; null = the dimension's own */
    double lowest, highest;            /* in the program's own unit; both 0 = any value */
    double usual[2];                   /* values outside are doubted; both 0 = none is */
    const char *unusual;               /* in which words: "no lens in air is faster than f/0.5" */
    const char *most;      /* of a count: a word for its highest value, "many"; null = none */
    const char *outside;   /* said of values out of range, what has an answer to them; or null */
    const char *no_number; /* said to who types another thing than its number, or than one of its
                              words; null = nothing */
    unsigned flags;
    /* It says something only beside a value of a circle of confusion for which this holds. */
    bool (*serves)(const struct coc_value *coc);
    const char *served; /* such a value in words: "print" */
    /* What this one says nothing without, one of several: "lens|coc=airy", "pattern!=few". */
    const char *wants;
    const char *excludes; /* options beside which one of both says nothing: "coc trail" */
    const char *why;      /* they do: "raw numbers have no white balance"; null = plainly */
    const char *fallback; /* what it is if not given, as it would be typed; null = absent */
    const char *bare; /* what it is if given without a number behind it; null: it needs a value */
    const struct word *words;                /* of a choice: the place in the list is the value */
    const struct word *(*word_at)(size_t i); /* the same from a list that is kept elsewhere */
    file_types *types; /* how the name of a file may end; null = as it likes */
    /* Is a text what it may be? Its message names no option. Null: any is. */
    bool (*accepts)(const char *text, struct error *error);
    const char *value; /* how help names the value: "LENGTH"; null = nothing to name */
    const char *help;  /* one line */
};

/* Are its values the labels of a stop series? */
static inline bool option_has_series(const struct option *option)
{
    return option->dimension != NULL && option->dimension->series != NULL &&
           (option->flags & OPTION_NO_SERIES) == 0;
}

/* How it was given, in the words of a message: "--focal-length", "column 's_m'". */
struct called {
    char text[80];
};

const char *option_called(const struct option *option, struct called *room);

#define CALLED(option) option_called((option), &(struct called){{0}})
/* And what was typed for it, for "%s '%.*s'". */
#define TYPED(option, text) CALLED(option), text_shown(text), (text).start

/* Is it the option's name, where '_' may stand for '-', as people write it? */
bool option_is_named(const struct option *option, struct text name);

/* Is it what the formulas call by this name? */
bool option_is_quantity(const struct option *option, struct text quantity);

/* What stands between the values of an OPTION_MANY: no comma, since names of files may have one. */
#define OPTION_MANY_SEPARATOR '\n'

/* Word i that the option may have; null behind the last, and where it takes any value. */
const struct word *option_word(const struct option *option, size_t i);

/* The unit in which a bare number is read; null = none. */
static inline const struct unit *option_unit(const struct option *option)
{
    if (option->dimension == NULL || option->unit == NULL) {
        return option->dimension != NULL ? &option->dimension->units[0] : NULL;
    }
    return unit_find(option->dimension, text_of(option->unit));
}

/*
 * Read one value of an option into its member.
 *
 * Given     text    as typed, without list or range
 *           member  option->kind->size bytes
 * Errors    as the kind's reader, the message naming the option and the legal range
 */
bool option_read(const struct reader *reader, const struct option *option, struct text text,
                 void *member, struct error *error);

/*
 * Make a member whole of which only the name was kept, as its kind does; others are.
 *
 * Errors    as option_read
 */
bool option_recall(const struct reader *reader, const struct option *option, void *member,
                   struct error *error);

/* Say whose text was wrong, before what was wrong with it. Returns false. */
bool option_blame(const struct option *option, struct text text, struct error *error);

/* Refuse a number outside the option's range; `value` in the program's own unit. */
bool option_check_range(const struct option *option, double value, struct error *error);

/* Add to the reader's doubts what is unusual about a legal value, in the program's own unit. */
void option_doubt(const struct reader *reader, const struct option *option, double value);

/* The legal range in words: "above 0 mm", "0 to 90 deg", ".svg or .png"; "" if there is none. */
const char *option_range(const struct option *option, struct arena *arena);

/* Have its values names? */
static inline bool option_has_names(const struct option *option)
{
    return option->kind->is_named || option->kind->name_of != NULL;
}

/* The value's name; null: it has none. */
const char *option_value_name(const struct option *option, const void *member);

/* For number_of, of values that begin with their number. */
double option_first_number(const void *member);

/* Make a member absent: NaN, null, false, or the first choice. */
void option_clear(const struct option *option, void *member);

#endif
