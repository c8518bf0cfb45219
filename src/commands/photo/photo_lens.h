/* commands/photo/photo_lens.h - the lens of a photographic command: thin, or a real one. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_COMMANDS_PHOTO_PHOTO_LENS_H
#define LENSCALC_COMMANDS_PHOTO_PHOTO_LENS_H

#include "cli/question/command.h"
#include "commands/lens/lens_options.h"
#include "commands/photo/photo_options.h"
#include "commands/tables.h"
#include "exchange/lens_formats.h"
#include "photo/conjugate.h"
#include "photo/distance_from.h"

#include <math.h>

/* Whether an answer by rays is wanted, and what counts as sharp. */
struct by_rays {
    bool exact;
    const char *criterion; /* "rms", "energy80", "mtf@40/mm" */
};

/*
 * Which lens is asked for: a thin one, or a real one and how it is set. The options of a command
 * fill it. A number that is not given is NaN, or 0 where the command has no option for it.
 */
struct photo_lens_question {
    struct lens_value lens; /* lens.lens is null: a thin one */
    const char *position;
    int section;
    struct focal_value focal;
    double wavelength;     /* mm */
    double fnumber, pupil; /* in place of those of a real lens */
    int from;              /* enum distance_from */
    struct by_rays rays;
};

/* What the answer makes of it; added up. */
enum photo_lens_use {
    PHOTO_LENS_SOLVES_FNUMBER = 1, /* it is asked for: the lens's own does not count */
    PHOTO_LENS_WITHOUT_PUPILS = 2, /* the answer needs no pupils */
    PHOTO_LENS_OWN_PUPILS = 4      /* the command has no option that says other ones */
};

#define PHOTO_LENS_OPTIONS(member)                                                                 \
    ENTRY(                                                                                         \
        ASKED(member.lens), .name = "lens", .letter = 'l', .value = "LENS", .column = "lens_name", \
        .flags = OPTION_FILE, .types = lens_types,                                                 \
        .help =                                                                                    \
            "a real lens in place of -f: a name (list lenses), a file, or - for standard input"),  \
        LENS_POSITION_OPTION(INPUT, member), LENS_SECTION_OPTION(INPUT, member)

/* What a row says of a real lens; of a thin one nothing. Lengths in mm. */
struct photo_real {
    const char *title, *kind, *position, *warning;
    double focal, hiatus, wavelength;
    double rear; /* H' seen from the last vertex, + to the right */
};

/* The lens of one answer; lengths in mm, N is NaN where it is not known. */
struct photo_lens {
    double f, N, P;
    double wavelength;
    struct distance_reference measuring;
    const struct photo_real *real;
    double t_ratio; /* T-stop over f-number, of a real lens whose source states it; else NaN */
    const struct lens *lens;         /* in all its positions; null: a thin one */
    size_t position;                 /* which of them */
    const struct first_order *first; /* of the real lens; null: a thin one */
};

/* Of a thin lens. */
extern const struct photo_real photo_real_none;

/* What is said of a real lens among the assumptions; `member` is a struct photo_real. */
#define PHOTO_LENS_COLUMNS(member)                                                                 \
    ENTRY(SHOWN(member.title), .name = "lens", ASSUMED_WITH("lens", "lens"),                       \
          .help = "title of the real lens"),                                                       \
        ENTRY(SHOWN(member.position), .name = "position", ASSUMED_WITH("lens", "position lens"),   \
              .help = "zoom or focus position; absent where there is only one"),                   \
        ENTRY(LENGTH(member.focal, "mm"), .name = "lens_focal",                                    \
              ASSUMED_WITH("lens", "position lens section wavelength"),                            \
              .label = "its focal length",                                                         \
              .help = "focal length of the real lens at its wavelength")

/* What is doubtful about it. */
#define PHOTO_LENS_WARNING_COLUMN(member)                                                          \
    ENTRY(SHOWN(member.warning), .name = "warning", WITH("lens") | COLUMN_NOTE,                    \
          .help = "what is doubtful about the lens")

/* For a command that has no wavelength of its own. */
#define PHOTO_LENS_WAVELENGTH_COLUMN(member)                                                       \
    ENTRY(LENGTH(member.wavelength, "nm"), .name = "wavelength",                                   \
          ASSUMED_WITH("lens", "wavelength lens") | COLUMN_ECHO,                                   \
          .help = "of the light in the lens")

/* Between the principal planes of a real lens. */
#define PHOTO_LENS_HIATUS_COLUMN(member)                                                           \
    ENTRY(LENGTH(member, "mm"), .name = "hiatus", WITH("lens") | COLUMN_HIDDEN, .symbol = "HH'",   \
          .label = "between the principal planes",                                                 \
          .help = "from the front to the rear principal plane")

/* Green, where no lens says what its light is, mm. */
#define PHOTO_WAVELENGTH 0.00055

/* The thin lens that is asked for. */
static inline struct photo_lens photo_lens_thin(const struct photo_lens_question *question)
{
    return (struct photo_lens){
        .f = question->focal.length,
        .N = question->fnumber,
        .P = question->pupil > 0 ? question->pupil : 1,
        .wavelength = question->wavelength > 0 ? question->wavelength : PHOTO_WAVELENGTH,
        .measuring = {(enum distance_from)question->from, 0, NAN},
        .t_ratio = NAN,
        .real = &photo_real_none,
    };
}

/* Is a thin lens meant, without anything that only a real one has? */
static inline bool photo_lens_is_thin(const struct photo_lens_question *question)
{
    return question->lens.lens == NULL && question->position == NULL && question->section == 0;
}

/*
 * The lens of the only position that is asked for, as a drawing has it: thin, or a real one with
 * its focal length, own f-number, pupil magnification and the places of its principal planes, at
 * the wavelength given, else its primary one. What is given of f-number and pupils overrides
 * the lens.
 *
 * Given     use    enum photo_lens_use
 *           arena  for working
 * Formula   f = n'/power, hiatus = length + H' - H, front = H: with the same medium on both sides
 *           all thin-lens formulas hold for distances from H and H'
 * Source    [Gauss41]
 * Errors    ERROR_USAGE: no lens, also a focal length, no stop and no P, several positions;
 *           ERROR_DOMAIN: afocal, f < 0, different media, an image on the subject's side, P < 0;
 *           as lens_next
 */
bool photo_lens_single(const struct photo_lens_question *question, int use, struct arena *arena,
                       struct photo_lens *lens, struct error *error);

/* One answer with a lens. */
typedef bool photo_lens_answer(const void *input, const struct photo_lens *lens, struct run *run,
                               struct error *error);

/* As photo_lens_each, of a real lens. Errors as photo_lens_single, but for several positions. */
bool photo_lens_visit(const struct photo_lens_question *question, int use, struct run *run,
                      photo_lens_answer *answer, const void *input, struct error *error);

/* Answer with the thin lens, or with the real one in each position that is asked for. */
static inline bool photo_lens_each(const struct photo_lens_question *question, int use,
                                   struct run *run, photo_lens_answer *answer, const void *input,
                                   struct error *error)
{
    if (photo_lens_is_thin(question)) {
        const struct photo_lens thin = photo_lens_thin(question);
        return answer(input, &thin, run, error);
    }
    return photo_lens_visit(question, use, run, answer, input, error);
}

/* Does one question have several answers, as --position all? */
bool photo_lens_makes_many(const struct photo_lens_question *question);

/* Do they differ in this option? */
bool photo_lens_varies(const struct photo_lens_question *question, const char *option);

/* `varies` of a command with --lens; `member` is the question in its input. */
#define PHOTO_LENS_VARIES(member)                                                                  \
    static bool varies(const void *input, const char *option)                                      \
    {                                                                                              \
        return photo_lens_varies(&((const INPUT *)input)->member, option);                         \
    }

/* And `makes_many` too, where nothing else makes several rows. */
#define PHOTO_LENS_MAKES_MANY(member)                                                              \
    PHOTO_LENS_VARIES(member) static bool makes_many(const void *input)                            \
    {                                                                                              \
        return photo_lens_makes_many(&((const INPUT *)input)->member);                             \
    }

/* Refuse a subject at s from the front principal plane, mm, that would lie inside a real lens. */
static inline bool photo_lens_check_subject(const struct photo_lens *lens, double s,
                                            struct error *error)
{
    double distance;
    return isnan(lens->measuring.front) ||
           conjugates_working_distance(s, lens->measuring.front, &distance, error);
}

/* The wavelength to print: that of a real lens, or of a thin one where it matters; else NaN. */
static inline double photo_lens_light(const struct photo_lens *lens, bool matters)
{
    return matters ? lens->wavelength : lens->real->wavelength;
}

/*
 * After a refusal: of a subject within the focal length the command that finds its image is named.
 *
 * Given     s  the subject from the front principal plane, mm
 * Result    false
 */
bool photo_lens_hint_virtual(const struct photo_lens *lens, double s, struct error *error);

#endif
