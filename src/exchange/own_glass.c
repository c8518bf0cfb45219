/* exchange/own_glass.c - glasses as a lens file has them: its own indices, in its own air. */
/* SPDX-License-Identifier: MIT */
#include "exchange/own_glass.h"
#include "file/lens_glass.h"
#include "file/lens_words.h"
#include "optics/air.h"
#include "optics/growing.h"
#include "optics/wavelength.h"

#include <math.h>
#include <stdlib.h>

static const double printed = 5.5e-6; /* half of the last digit of a catalogue */

double own_glass_rounding(const struct figure *index)
{
    const double coarsest = 5e-5; /* fewer digits are numbers whose last ones are 0 */
    return fmin(figure_rounding(index), coarsest);
}

void own_glass_compare(const struct own_glass *own, const struct medium *found,
                       struct medium *medium)
{
    const bool of_catalog = own->job->glass_numbers == GLASS_NUMBERS_CATALOG;
    double most = own->rounding + printed, at = 0, is = 0, was = 0;
    for (size_t i = 0; i < own->count; i++) {
        struct pair here, there;
        struct error unknown;
        if (medium_index(found, own->wavelengths[i], &here, &unknown) &&
            medium_index(medium, own->wavelengths[i], &there, &unknown) &&
            fabs(pair_subtract(here, there).hi) > most) {
            most = fabs(pair_subtract(here, there).hi);
            at = own->wavelengths[i];
            is = here.hi;
            was = there.hi;
        }
    }
    if (!(at > 0)) {
        return;
    }
    char *warning = arena_printf(
        own->job->arena,
        "the glass '%.*s' is %.*s of the index %.7g at %g um, beside which "
        "the file has %.7g: %s",
        text_shown(own->name), own->name.start, text_shown(found->written), found->written.start,
        is, at, was, of_catalog ? "the catalogue's glass is used" : "the file's indices are used");
    text_make_printable(warning, "");
    lens_build_note(own->build, text_of(warning));
    if (of_catalog) {
        *medium = *found;
    }
    foreign_warn(own->job, medium, warning);
}

/* Of nd, Vd and Ve; steps are so small that a parabola goes between them to 1e-7. */
static const double lines[] = {WAVELENGTH_G, WAVELENGTH_F_PRIME, WAVELENGTH_F, WAVELENGTH_E,
                               WAVELENGTH_D, WAVELENGTH_C_PRIME, WAVELENGTH_C};
static const double step = 1.04;
enum { LINES = sizeof lines / sizeof lines[0], MOST = ENVIRONMENT_WAVES + LINES + 500 };

/* The index relative to the file's air; false: the catalogue lacks what it wants. */
static bool index_in_air(const struct glass *glass, const struct air *air, double wavelength,
                         double *index, struct error *error)
{
    const struct air usual = {AIR_KOHLRAUSCH, glass->thermal.reference, AIR_STANDARD_PRESSURE};
    const double here = air_refractivity(air, wavelength);
    double catalogued = wavelength * (1 + (here - air_refractivity(&usual, wavelength)) /
                                              (1 + air_refractivity(&usual, wavelength)));
    struct glass_state state;
    catalogued = isnan(catalogued) ? wavelength : catalogued; /* glass_in_air says why */
    if (!glass_check_range(glass, catalogued, error) ||
        !glass_in_air(glass, catalogued, air, &state, error)) {
        return false;
    }
    *index = state.n;
    return true;
}

static int by_rising_value(const void *a, const void *b)
{
    double left = *(const double *)a, right = *(const double *)b;
    return (left > right) - (left < right);
}

static size_t add_wavelength(double *all, size_t count, double value)
{
    bool is_new = value > 0 && count < MOST;
    for (size_t i = 0; i < count; i++) {
        is_new = is_new && fabs(all[i] - value) > 1e-4;
    }
    if (is_new) {
        all[count++] = value;
    }
    return count;
}

/* The file's wavelengths, the lines, and steps from the shortest to the longest of them; rising. */
static size_t environment_wavelengths(const struct environment *environment, double *all)
{
    size_t count = 0;
    for (size_t i = 0; i < environment->wave_count; i++) {
        count = add_wavelength(all, count, environment->waves[i]);
    }
    for (size_t i = 0; i < LINES; i++) {
        count = add_wavelength(all, count, lines[i]);
    }
    qsort(all, count, sizeof all[0], by_rising_value);
    const double longest = all[count - 1];
    for (double value = all[0]; value < longest; value *= step) {
        count = add_wavelength(all, count, round(1e4 * value) / 1e4);
    }
    qsort(all, count, sizeof all[0], by_rising_value);
    return count;
}

/* "{0.55um 1.5, ..}"; null where a wavelength of the file has no index. */
static const char *table_in_air(const struct environment *environment, const struct glass *glass,
                                struct arena *arena, struct error *error)
{
    const struct air air = {AIR_KOHLRAUSCH, environment->temperature,
                            environment->pressure * AIR_STANDARD_PRESSURE};
    double all[MOST];
    struct text_buffer text = {.arena = arena};
    const size_t count = environment_wavelengths(environment, all);
    bool any = false;
    for (size_t i = 0; i < count; i++) {
        double index;
        bool own = false;
        for (size_t k = 0; k < environment->wave_count; k++) {
            own = own || environment->waves[k] == all[i];
        }
        if (index_in_air(glass, &air, all[i], &index, error)) {
            growing_string(&text, any ? ", " : "{");
            growing_number(&text, all[i]);
            growing_string(&text, "um ");
            growing_number(&text, index);
            any = true;
        } else if (own || isnan(glass->thermal.reference)) {
            return NULL;
        }
    }
    growing_string(&text, any ? "}" : "");
    const struct text done = growing_done(&text);
    return any ? arena_string(arena, done.start, done.length) : NULL;
}

bool environment_apply(const struct environment *environment, const struct file_words *words,
                       struct text word, struct medium *medium)
{
    const struct glass *glass = lens_glass_of(medium);
    const double temperature = environment->temperature, pressure = environment->pressure;
    struct foreign_job *job = environment->job;
    if ((temperature == 20 && pressure == 1) || glass == NULL) {
        return true;
    }
    struct error why = {.code = ERROR_NONE};
    const char *written = table_in_air(environment, glass, job->arena, &why);
    if (written == NULL) {
        return foreign_loss(job, words, word, LOSS_OF_POWER, "that of the catalogue is kept",
                            "the index at %.6g C and %.6g atmospheres (%s)", temperature, pressure,
                            why.message);
    }
    const char *warning = medium->warning;
    lens_build_note(environment->build,
                    text_of(arena_printf(
                        job->arena, "line %ld: the indices of %.*s at %.6g C and %.6g atmospheres",
                        words->number, text_shown(medium->written), medium->written.start,
                        temperature, pressure)));
    if (!lens_words_medium(words, text_of(written), medium)) {
        return false;
    }
    medium->warning = warning;
    return true;
}
