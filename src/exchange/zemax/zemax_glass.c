/* exchange/zemax/zemax_glass.c - the materials of a .zmx file: names of glasses, and numbers. */
/* SPDX-License-Identifier: MIT */
#include "exchange/own_glass.h"
#include "exchange/zemax/zemax.h"

#include <math.h>
#include <string.h>

/* The types of a glass: GLAS NAME type .. */
enum { GLASS_NAMED = 0, GLASS_MODEL = 1, GLASS_OFFSET = 4 }; /* 2: picked up, 3: may be replaced */

/* nd/Vd, of a model glass or one of which only they are known. */
static struct medium medium_of_model(struct zemax_file *file, struct figure nd, struct figure Vd)
{
    return (struct medium){
        .kind = MEDIUM_MODEL,
        .written = text_of(arena_printf(file->job->arena, "%.*s/%.*s", (int)nd.typed.length,
                                        nd.typed.start, (int)Vd.typed.length, Vd.typed.start)),
        .index = nd.value,
        .abbe = Vd.value};
}

static struct figure figure_text(const char *typed)
{
    struct figure figure = {.typed = text_of(typed), .variable = LENS_NONE};
    pair_read(typed, typed + strlen(typed), NUMBER_UNSCALED, &figure.value);
    return figure;
}

/* "517642" is nd = 1.517, Vd = 64.2. */
static bool is_code(struct text name)
{
    bool digits = name.length == 6;
    for (size_t i = 0; i < name.length; i++) {
        digits = digits && name.start[i] >= '0' && name.start[i] <= '9';
    }
    return digits;
}

static struct medium code_medium(struct zemax_file *file, struct text name)
{
    struct arena *arena = file->job->arena;
    struct figure nd = figure_text(arena_printf(arena, "1.%.3s", name.start));
    struct figure Vd =
        figure_text(arena_printf(arena, "%.2s.%.1s", name.start + 3, name.start + 5));
    return Vd.value.hi > 0
               ? medium_of_model(file, nd, Vd)
               : (struct medium){.kind = MEDIUM_CONSTANT, .written = nd.typed, .index = nd.value};
}

/* GLAS name mode pick-up nd Vd dPgF .. */
static bool model_medium(struct zemax_file *file, const struct zemax_line *line,
                         struct medium *medium)
{
    if (!(zemax_number(line, 2) > 0 && zemax_number(line, 2) < 100)) {
        return zemax_fail(line, line->keyword, "a model glass without an index");
    }
    bool constant = zemax_number(line, 3) == 0;
    *medium = constant ? (struct medium){.kind = MEDIUM_CONSTANT,
                                         .written = line->numbers[2].typed,
                                         .index = line->numbers[2].value}
                       : medium_of_model(file, line->numbers[2], line->numbers[3]);
    if (!constant && zemax_number(line, 3) < 0) {
        return zemax_fail(line, line->numbers[3].typed, "the Abbe number is below 0");
    }
    return zemax_number(line, 4) == 0 ||
           zemax_loss(file, line, LOSS_OF_RAYS, NULL,
                      "the deviation %g of the partial dispersion PgF", zemax_number(line, 4));
}

/* Catalogues as the file names them: "SCHOTT, OHARA"; "none" where it names none. */
static const char *catalog_list(const struct zemax_file *file)
{
    struct arena *arena = file->job->arena;
    const char *list = file->catalog_count > 0 ? "" : "no catalogue";
    for (size_t i = 0; i < file->catalog_count && strlen(list) < 200; i++) {
        list = arena_printf(arena, "%s%s%.*s", list, i > 0 ? ", " : "",
                            text_shown(file->catalogs[i]), file->catalogs[i].start);
    }
    return file->catalog_count > 0 ? arena_printf(arena, "none of the file's catalogues (%s)", list)
                                   : list;
}

/* nd and Vd beside the name of a glass; a program that does not know them writes 1.5 and 40. */
static bool has_nd_beside(const struct zemax_line *line)
{
    double nd = zemax_number(line, 2), Vd = zemax_number(line, 3);
    return nd > 1 && nd < 100 && Vd > 0 && !(nd == 1.5 && Vd == 40);
}

/* nd and Vd instead of the glass, of which `what` tells; behind visible light they are a loss. */
static void numbers_instead(struct zemax_file *file, const struct zemax_line *line,
                            struct medium *medium, const char *what)
{
    *medium = medium_of_model(file, line->numbers[2], line->numbers[3]);
    /* nd and Vd describe a glass where all of the file's light is visible. */
    const double shortest = 0.4, longest = 0.8; /* um */
    bool is_visible = true;
    const size_t count = zemax_wave_count(file);
    for (size_t i = 0; i < count; i++) {
        is_visible =
            is_visible && file->waves[i].value.hi >= shortest && file->waves[i].value.hi <= longest;
    }
    if (is_visible) {
        medium->warning = arena_printf(file->job->arena, "%s: nd and Vd are used instead", what);
        lens_build_note(&file->build, text_of(medium->warning));
        return;
    }
    file->job->lacks_glass = true;
    zemax_loss(file, line, LOSS_OF_POWER, "nd and Vd are used instead", "%s", what);
}

/* No catalogue has it so: the indices beside its name. */
static void unknown_glass(struct zemax_file *file, const struct zemax_line *line,
                          struct medium *medium)
{
    int length = (int)(line->keyword.length < 40 ? line->keyword.length : 40);
    if (!has_nd_beside(line)) {
        foreign_lack(file->job, &line->words, line->keyword, medium,
                     arena_printf(file->job->arena,
                                  "the glass '%.*s' is in %s, and the file has no index of it",
                                  length, line->keyword.start, catalog_list(file)));
        return;
    }
    char *what = arena_printf(file->job->arena, "the glass '%.*s' of nd %g and Vd %g is in %s",
                              length, line->keyword.start, zemax_number(line, 2),
                              zemax_number(line, 3), catalog_list(file));
    text_make_printable(what, "");
    numbers_instead(file, line, medium, what);
}

/* Programs that write a line VERS of their own, and which numbers they put beside names. */
static const struct {
    const char *version, *name;
} converters[] = {
    /* a constant of the exporters of github.com/redukti: names are those of the nearest glass */
    {"161019 507 33785", "redukti's converter"},
};

static const char *converter_of_file(const struct zemax_file *file)
{
    for (size_t i = 0; i < sizeof converters / sizeof converters[0]; i++) {
        if (text_equal(file->version, converters[i].version)) {
            return converters[i].name;
        }
    }
    return NULL;
}

/* What counts where the name of a glass and the numbers beside it differ. */
static enum glass_numbers which_numbers_count(const struct zemax_file *file,
                                              const struct zemax_line *line)
{
    if (file->job->glass_numbers != GLASS_NUMBERS_OF_FILE) {
        return file->job->glass_numbers;
    }
    bool of_line = zemax_number(line, 0) == GLASS_MODEL || zemax_number(line, 0) == GLASS_OFFSET ||
                   converter_of_file(file) != NULL;
    return of_line || file->takes_numbers ? GLASS_NUMBERS_LINE : GLASS_NUMBERS_CATALOG;
}

/* A glass of a catalogue beside which the line has other numbers: the one or the others. */
static void settle_glass_numbers(struct zemax_file *file, const struct zemax_line *line,
                                 const struct foreign_name *named, struct medium *medium)
{
    const bool model = zemax_number(line, 0) == GLASS_MODEL;
    const bool of_line = which_numbers_count(file, line) == GLASS_NUMBERS_LINE;
    char *what = foreign_difference(file->job, named, medium);
    file->doubts->disputed += !model && zemax_number(line, 0) != GLASS_OFFSET;
    if (file->takes_numbers) {
        what = arena_printf(file->job->arena, "%s, which the solves of the file confirm", what);
    } else if (of_line && converter_of_file(file) != NULL && !model) {
        what = arena_printf(file->job->arena, "%s, where %s writes those of a patent", what,
                            converter_of_file(file));
    }
    if (of_line) {
        numbers_instead(file, line, medium, what);
        return;
    }
    const char *warning = arena_printf(file->job->arena, "%s: the catalogue's glass is used", what);
    lens_build_note(&file->build, text_of(warning));
    foreign_warn(file->job, medium, warning);
}

/* The name of a line, and what it says of the glass. */
static struct foreign_name zmx_glass_name(const struct zemax_file *file,
                                          const struct zemax_line *line)
{
    /* as patents print them at the least; fewer digits are numbers whose last ones are 0 */
    const double coarsest_nd = 5e-5, coarsest_Vd = 0.05;
    struct foreign_name named = {.name = line->keyword,
                                 .catalogs = file->catalogs,
                                 .catalog_count = file->catalog_count,
                                 .has_homonyms = true,
                                 .is_by_name = true};
    if (has_nd_beside(line) || zemax_number(line, 0) == GLASS_MODEL) {
        named.nd = zemax_number(line, 2);
        named.Vd = zemax_number(line, 3);
        named.nd_rounding = fmin(figure_rounding(&line->numbers[2]), coarsest_nd);
        named.Vd_rounding =
            named.Vd != 0 ? fmin(figure_rounding(&line->numbers[3]), coarsest_Vd) : 0;
    }
    return named;
}

/* In the file's catalogues, else as the file describes it. */
static bool named_glass(struct zemax_file *file, const struct zemax_line *line,
                        struct medium *medium)
{
    struct error *error = file->error;
    const struct foreign_name named = zmx_glass_name(file, line);
    if (!foreign_glass(file->job, &line->words, &named, medium, error)) {
        if (error->code == ERROR_NONE) {
            unknown_glass(file, line, medium);
        }
        return error->code == ERROR_NONE;
    }
    if (!foreign_is_rounded(medium, &named)) {
        settle_glass_numbers(file, line, &named, medium);
    }
    return true;
}

/* A model glass that has a name: of a catalogue's it is said where that one is another. */
static bool named_model(struct zemax_file *file, const struct zemax_line *line,
                        struct medium *medium)
{
    const struct foreign_name named = zmx_glass_name(file, line);
    struct medium found;
    struct error ignored;
    if (!model_medium(file, line, medium)) {
        return false;
    }
    if (file->job->glasses == NULL ||
        !foreign_glass(file->job, &line->words, &named, &found, &ignored)) {
        return true;
    }
    if (which_numbers_count(file, line) == GLASS_NUMBERS_CATALOG) {
        *medium = found;
        if (!foreign_is_rounded(medium, &named)) {
            settle_glass_numbers(file, line, &named, medium);
        }
    } else if (!foreign_is_rounded(&found, &named)) {
        medium->warning =
            arena_printf(file->job->arena, "%s: it is a model glass, whose numbers are used",
                         foreign_difference(file->job, &named, &found));
        lens_build_note(&file->build, text_of(medium->warning));
    }
    return true;
}

/*
 * A glass of a catalogue as it is in the file's air, where ENVD says that indices follow it; else,
 * and at 20 C and 1 atmosphere, as it is. Radii and distances of a file are those at its
 * temperature already.
 *
 * Given     line    GLAS
 *           medium  of a catalogue; receives a table at the file's wavelengths, at
 *                   spectral lines, and at steps between them, in the range of the glass
 * Formula   the wavelength l of the file is one in its air, of T and p: the catalogue's is
 *           l n_air(T, p)/n_air(T0, 1 atmosphere); then glass_in_air, with AIR_KOHLRAUSCH
 * Source    [OpticStudio25], temperature and pressure
 * Errors    ERROR_DATA: a glass without the data for it, unless lossy
 */
static bool zmx_glass_in_air(struct zemax_file *file, const struct zemax_line *line,
                             struct medium *medium)
{
    /* ENVD temperature pressure adjust */
    const struct zemax_line *stated = file->environment;
    struct environment environment = {.job = file->job,
                                      .build = &file->build,
                                      .temperature = zemax_number(stated, 0),
                                      .pressure = zemax_number(stated, 1)};
    if (zemax_number(stated, 2) == 0) {
        return true;
    }
    const size_t count = zemax_wave_count(file);
    while (environment.wave_count < count) {
        environment.waves[environment.wave_count] = file->waves[environment.wave_count].value.hi;
        environment.wave_count++;
    }
    return environment_apply(&environment, &line->words, line->keyword, medium);
}

bool zemax_glass(struct zemax_file *file, const struct zemax_line *line, struct medium *medium)
{
    const double type = zemax_number(line, 0);
    if (text_same(line->keyword, "___BLANK")) {
        return model_medium(file, line, medium);
    }
    if (!(type >= GLASS_NAMED && type <= GLASS_OFFSET && type == rint(type))) {
        zemax_loss(file, line, LOSS_OF_POWER, "its name is looked up", "a glass of the type %g",
                   type);
    }
    for (size_t i = 8; type == GLASS_OFFSET && i < line->count; i++) {
        if (line->numbers[i].value.hi != 0) {
            zemax_loss(file, line, LOSS_OF_POWER, NULL,
                       "a glass with an offset of its index or dispersion");
        }
    }
    if (type == GLASS_MODEL && zemax_number(line, 2) > 0) {
        return named_model(file, line, medium);
    }
    if (is_code(line->keyword)) {
        *medium = code_medium(file, line->keyword);
        return true;
    }
    return named_glass(file, line, medium) && zmx_glass_in_air(file, line, medium);
}
