/* cli/option_lens.c - read the values of lens commands. */
/* SPDX-License-Identifier: MIT */
#include "cli/option_lens.h"

#include "cli/option.h"
#include "file/lens_db.h"
#include "optics/wavelength.h"

static bool read_lens(const struct reader *reader, const struct option *option, struct text text,
                      void *member, struct error *error)
{
    struct lens *lens = ARENA_NEW(reader->arena, struct lens);
    struct lens_warnings warnings;
    struct text name = text_trim(text);
    (void)option;
    if (!lens_db_find(reader->db, name, reader->arena, lens, error)) {
        return false;
    }
    if (!lens_check(lens, reader->arena, &warnings, error)) {
        return error_prefix(error, "%.*s: ", (int)(name.length < 60 ? name.length : 60),
                            name.start);
    }
    const char *warning = NULL;
    for (size_t i = 0; i < warnings.count; i++) {
        warning = i == 0 ? warnings.texts[i]
                         : arena_printf(reader->arena, "%s; %s", warning, warnings.texts[i]);
    }
    *(struct lens_value *)member =
        (struct lens_value){lens, arena_string(reader->arena, name.start, name.length), warning};
    return true;
}

static const char *lens_name(const struct option *option, const void *member)
{
    (void)option;
    return ((const struct lens_value *)member)->name;
}

/* 1 nm to 1 mm, in um: what is beyond is a mistake of the unit. */
static const double shortest_wave = 0.001, longest_wave = 1000;

static bool read_wavelength(const struct reader *reader, const struct option *option,
                            struct text text, void *member, struct error *error)
{
    struct text name = text_trim(text);
    struct wavelength_value value = {.name = arena_string(reader->arena, name.start, name.length)};
    const struct spectral_line *line = spectral_line_find(name);
    double millimetres;
    if (line != NULL) {
        value.wavelength = line->wavelength;
    } else if (quantity_read(text, &dimension_length, unit_find(&dimension_length, text_of("nm")),
                             &millimetres, NULL, error)) {
        value.wavelength = unit_from_own(unit_find(&dimension_length, text_of("um")), millimetres);
    } else {
        error_prefix(error, "bad wavelength in --%s: ", option->name);
        return error_hint(error, "a wavelength is 550, 550nm, 0.55um, or a line: d F C e g ...");
    }
    if (!(value.wavelength >= shortest_wave && value.wavelength <= longest_wave)) {
        return fail(error, ERROR_DOMAIN, "--%s %s is out of range: it must be 1 nm to 1 mm",
                    option->name, value.name);
    }
    *(struct wavelength_value *)member = value;
    return true;
}

static const char *wavelength_name(const struct option *option, const void *member)
{
    (void)option;
    return ((const struct wavelength_value *)member)->name;
}

const struct option_kind kind_lens = {"lens", sizeof(struct lens_value), false, read_lens,
                                      lens_name};
const struct option_kind kind_wavelength = {"wavelength", sizeof(struct wavelength_value), true,
                                            read_wavelength, wavelength_name};
