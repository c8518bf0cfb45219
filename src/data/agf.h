/* data/agf.h - glass catalogues in the AGF format, as makers of glass publish them. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DATA_AGF_H
#define LENSCALC_DATA_AGF_H

#include "base/error.h"
#include "base/text.h"
#include "data/glass_catalog.h"
#include "optics/glass.h"
#include <stdbool.h>

/* A glass that is left out, and what is wrong with it. */
struct agf_damage {
    struct text name; /* may be empty */
    struct error error;
};

/* A catalogue that has been read. */
struct agf_catalog {
    const char *source; /* the file, for messages */
    struct text name;   /* of the catalogue: "SCHOTT" */
    const struct glass_record *glasses;
    size_t count;
    const struct agf_damage *damaged;
    size_t damaged_count;
    const struct agf_catalog *next; /* of the user's catalogues */
};

/*
 * Read an AGF file.
 *
 * Given     source   name of the file, for messages; its folders and ending cut off and in upper
 *                    case it is the name of the catalogue
 *           content  the file in any encoding (encoding_to_utf8)
 *           catalog  receives the glasses in the order of the file; what they point to lies in the
 *                    arena, which the content must outlive. A glass has a warning where the stated
 *                    nd or Vd is not that of its formula (by more than 3e-5 or 0.12 %, at least
 *                    0.06, and half a unit of the last digit stated), where its name stands twice,
 *                    or where something in its lines was not used
 * Formula   l = wavelength in um, c0 c1 .. the numbers behind CD
 *           1 Schott       n^2 = c0 + c1 l^2 + c2 l^-2 + c3 l^-4 + c4 l^-6 + c5 l^-8
 *           2 6 11 Sellmeier 1, 3, 5: n^2 = 1 + sum ci l^2/(l^2 - cj), 3, 4 or 5 terms
 *           3 Herzberger   n = c0 + c1 z + c2 z^2 + c3 l^2 + c4 l^4 + c5 l^6, z = 1/(l^2 - 0.028)
 *           4 Sellmeier 2  n^2 = 1 + c0 + c1 l^2/(l^2 - c2^2) + c3/(l^2 - c4^2)
 *           5 Conrady      n = c0 + c1/l + c2/l^3.5
 *           7 Handbook 1   n^2 = c0 + c1/(l^2 - c2) - c3 l^2
 *           8 Handbook 2   n^2 = c0 + c1 l^2/(l^2 - c2) - c3 l^2
 *           9 Sellmeier 4  n^2 = c0 + c1 l^2/(l^2 - c2) + c3 l^2/(l^2 - c4)
 *           10 Extended    n^2 = c0 + c1 l^2 + c2 l^-2 + c3 l^-4 + .. + c7 l^-12
 *           12 Extended 2  n^2 = Schott + c6 l^4 + c7 l^6
 *           13 Extended 3  n^2 = c0 + c1 l^2 + c2 l^4 + c3 l^-2 + c4 l^-4 + .. + c8 l^-12
 *           internal transmittance at 10 mm: tau^(10 mm/thickness)
 * Source    [OpticStudio25] "The Glass Dispersion Formulas"
 *           A line that begins with a number goes on with the one before it. Where the end of a
 *           line may have cut a number in two, so that both parts are numbers, it is one only where
 *           that alone has the stated nd
 * Errors    of one glass, which is left out with ERROR_DATA, line, column and caret: a formula that
 *           is none of 1 to 13, no CD line, what is no number, a range that ends before it begins.
 *           Of the file: no glass, or more than 1000 that are damaged
 * Limits    an nd of 1 or 0, a Vd, density or expansion of 0, D0 .. E1 that are all 0 and a price
 *           that is not above 0 mean that it is not known
 */
bool agf_read(const char *source, struct text content, struct arena *arena,
              struct agf_catalog *catalog, struct error *error);

enum { AGF_FORMULAS = 13, AGF_COEFFICIENTS = 10 };

/* How many numbers behind CD formula 1 .. 13 uses. */
size_t agf_formula_count(int number);

/*
 * Give a glass one of the formulas that agf_read lists.
 *
 * Given     number        1 .. 13
 *           coefficients  AGF_COEFFICIENTS numbers
 *           glass         receives formula, count and coefficients
 */
void agf_formula_set(int number, const struct pair *coefficients, struct glass *glass);

/* A file while it is read. */
struct agf_words {
    const char *source;
    struct text rest, line, at; /* lines to come, the present one, what is left of that */
    long number;                /* of the line, 1-based */
    bool touches;               /* only the end of a line parts the last word from the one before */
};

/* Go to the next line; false at the end. */
bool agf_words_line(struct agf_words *words);

/*
 * The next word. A line that begins with a number goes on with the one before it, for no keyword
 * does: so editors and mail wrap long lines.
 *
 * Result    empty at the end of the line, or of the last one that goes on with it
 */
struct text agf_words_next(struct agf_words *words);

/* A bad word, or a bad line: ERROR_DATA with its place. Returns false. */
bool agf_words_fail(const struct agf_words *words, struct text word, struct error *error,
                    const char *what);
bool agf_words_fail_line(const struct agf_words *words, struct error *error, const char *what);

/*
 * The user's AGF files, read once: those of db->agf in their order, then glass/NAME.agf of the
 * user's folder, by name.
 *
 * Given     first  receives the first; null if there is none
 * Errors    ERROR_IO: a file of db->agf that is not there, a file that cannot be read; ERROR_USAGE:
 *           two of db->agf make catalogues of one name; ERROR_DATA as agf_read
 */
bool agf_catalogs(struct lensdb *db, const struct agf_catalog **first, struct error *error);

#endif
