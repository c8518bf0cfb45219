/* exchange/zemax/zemax_positions.c - the configurations of a .zmx file as positions of a lens. */
/* SPDX-License-Identifier: MIT */
#include "exchange/zemax/zemax.h"
#include "file/lens_unit.h"

#include <math.h>
#include <string.h>

/* The value of an operand as the first number of a line, with what another line has behind it. */
static struct zemax_line *line_of_setting(struct zemax_file *file,
                                          const struct zemax_setting *setting,
                                          const struct zemax_line *old, size_t before)
{
    struct arena *arena = file->job->arena;
    const struct zemax_line *own = setting->line;
    size_t count = old != NULL && old->count > before ? old->count : before + 1;
    struct zemax_line *line = ARENA_COPY(arena, own, 1, 0);
    line->count = count;
    line->numbers = ARENA_ARRAY(arena, count, struct figure);
    for (size_t i = 0; i < count; i++) {
        line->numbers[i] = old != NULL && i < old->count ? old->numbers[i] : figure_zero();
    }
    line->numbers[before] = own->numbers[2];
    line->first = line->numbers[0].typed;
    return line;
}

static bool place_thickness(struct zemax_file *file, const struct zemax_setting *setting)
{
    struct zemax_surface *surface = &file->surfaces[setting->surface];
    const double far = 1e10; /* what the program writes for infinity where it wants a number */
    struct zemax_line *line = line_of_setting(file, setting, NULL, 0);
    line->infinite = setting->surface == 0 && fabs(line->numbers[0].value.hi) >= far;
    surface->thickness = line;
    return true;
}

/* SDIA */
static bool check_place_diameter(struct zemax_file *file, const struct zemax_setting *setting)
{
    (void)file;
    return setting->line->numbers[2].value.hi >= 0 || /* 0 is none */
           zemax_fail(setting->line, setting->line->numbers[2].typed,
                      "a semi-diameter is not below 0");
}

/* GLSS surface configuration NAME */
static bool place_glass(struct zemax_file *file, const struct zemax_setting *setting)
{
    struct zemax_surface *surface = &file->surfaces[setting->surface];
    const struct zemax_line *own = setting->line;
    struct file_words words = own->words;
    struct text name = {NULL, 0};
    for (int i = 0; i < 3; i++) {
        name = file_words_next(&words);
    }
    if (name.length >= 2 && name.start[0] == '"' && name.start[name.length - 1] == '"') {
        name = (struct text){name.start + 1, name.length - 2};
    }
    struct zemax_line *line = ARENA_NEW(file->job->arena, struct zemax_line);
    *line = (struct zemax_line){.words = own->words, .keyword = name};
    surface->glass = name.length > 0 ? line : NULL;
    return true;
}

/* PAR1 .. PAR8 */
static bool place_parameter(struct zemax_file *file, const struct zemax_setting *setting)
{
    struct zemax_surface *surface = &file->surfaces[setting->surface];
    size_t number = (size_t)(setting->line->keyword.start[3] - '0');
    surface->parameters[number] = line_of_setting(file, setting, surface->parameters[number], 1);
    return true;
}

/*
 * PRAM surface configuration value status NUMBER .., EDVA the same for extra data: behind the value
 * and its status the number of the parameter.
 */
static bool place_numbered(struct zemax_file *file, const struct zemax_setting *setting)
{
    struct zemax_surface *surface = &file->surfaces[setting->surface];
    const struct zemax_line *own = setting->line;
    const bool extra = text_same(own->keyword, "EDVA");
    const double number = zemax_number(own, 4);
    const size_t most = extra ? ZEMAX_EXTRAS : ZEMAX_PARAMETERS;
    if (own->count < 5 || !(number >= 0 && number < 1e6 && number == floor(number))) {
        return zemax_fail(own, own->keyword,
                          "%.4s needs a surface, a configuration, its value and behind a "
                          "status the number of the parameter",
                          own->keyword.start);
    }
    if (number >= (double)most) {
        return own->numbers[2].value.hi == 0 ||
               zemax_loss(file, own, LOSS_OF_RAYS, NULL,
                          "a parameter that no surface of lenscalc has");
    }
    const struct zemax_line **place =
        extra ? &surface->extras[(size_t)number] : &surface->parameters[(size_t)number];
    *place = line_of_setting(file, setting, *place, 1);
    return true;
}

/* APMN, APMX: the two sizes of an aperture, APDX, APDY: its decentre; of none they say nothing. */
static bool place_size(struct zemax_file *file, const struct zemax_setting *setting)
{
    struct zemax_surface *surface = &file->surfaces[setting->surface];
    const struct zemax_line *own = setting->line;
    const bool shifts = text_same(own->keyword, "APDX") || text_same(own->keyword, "APDY");
    const bool second = text_same(own->keyword, "APMX") || text_same(own->keyword, "APDY");
    const struct zemax_line **place = shifts ? &surface->aperture_shift : &surface->aperture;
    const struct zemax_line *old = *place;
    if (surface->aperture == NULL) {
        return own->numbers[2].value.hi == 0 ||
               zemax_loss(file, own, LOSS_OF_VIGNETTING, "left out",
                          "%.4s of an aperture that is not stated", own->keyword.start);
    }
    struct zemax_line *line = line_of_setting(file, setting, old, second);
    if (!shifts) {
        line->keyword = old->keyword;
        line->words = old->words;
        surface->clear = surface->clear == old ? line : surface->clear;
    }
    const bool none = shifts && zemax_number(line, 0) == 0 && zemax_number(line, 1) == 0;
    *place = none ? NULL : line;
    return true;
}

/* STPS: the number of the surface that is the stop is the value. */
static bool place_stop(struct zemax_file *file, const struct zemax_setting *setting)
{
    const struct zemax_line *line = setting->line;
    double stop = zemax_number(line, 2);
    if (!(stop >= 1 && stop + 1 < (double)file->surface_count && stop == floor(stop))) {
        return zemax_fail(line, line->numbers[2].typed, "the stop is one of the surfaces 1 to %zu",
                          file->surface_count - 2);
    }
    for (size_t i = 0; i < file->surface_count; i++) {
        file->surfaces[i].is_stop = i == (size_t)stop;
    }
    return true;
}

/* WAVE and WLWT: `surface` is the number of the wavelength. */
static bool place_wave(struct zemax_file *file, const struct zemax_setting *setting)
{
    const struct zemax_line *line = setting->line;
    long number = setting->surface;
    if (!(number >= 1 && (size_t)number <= file->wave_count)) {
        return true; /* of a wavelength that is gone */
    }
    struct figure *all = text_same(line->keyword, "WAVE") ? file->waves : file->weights;
    all[number - 1] = line->numbers[2];
    return true;
}

/* PRWV: the number of the primary wavelength is the value. */
static bool place_primary(struct zemax_file *file, const struct zemax_setting *setting)
{
    const struct zemax_line *line = setting->line;
    double number = zemax_number(line, 2);
    if (!(number >= 1 && number <= (double)file->wave_count && number == floor(number))) {
        return zemax_fail(line, line->numbers[2].typed, "wavelengths have the numbers 1 to %zu",
                          file->wave_count);
    }
    file->primary = (size_t)number - 1;
    return true;
}

/* The aperture, in the unit that its kind has. */
static bool place_aperture(struct zemax_file *file, const struct zemax_setting *setting)
{
    if (file->aperture == NULL || text_same(file->aperture->keyword, "FLOA")) {
        return true; /* the stop's diameter says it */
    }
    struct zemax_line *line = line_of_setting(file, setting, file->aperture, 0);
    struct figure *value = &line->numbers[0];
    line->keyword = file->aperture->keyword;
    if (text_same(line->keyword, "ENPD")) {
        text_pair(value->typed, lens_unit_scale(file->build.lens->unit), &value->value);
    }
    file->aperture = line;
    return true;
}

/* XFIE, YFIE, FLWT: `surface` is the number of the field. */
static bool place_field(struct zemax_file *file, const struct zemax_setting *setting)
{
    const struct zemax_line *own = setting->line;
    const struct zemax_line **place = &file->field_weights;
    if (!text_same(own->keyword, "FLWT")) {
        place = text_same(own->keyword, "XFIE") ? &file->x : &file->y;
    }
    const struct zemax_line *old = *place;
    const long number = setting->surface;
    if (!(number >= 1 && number <= ZEMAX_WAVES)) {
        return zemax_fail(own, own->first, "fields have the numbers 1 to %d", ZEMAX_WAVES);
    }
    struct zemax_line *line = line_of_setting(file, setting, old, (size_t)number - 1);
    for (size_t i = old != NULL ? old->count : 0; old != NULL && i + 1 < (size_t)number; i++) {
        line->numbers[i] = figure_zero();
    }
    *place = line;
    return true;
}

/* TEMP, PRES: they act where ENVD says that indices follow them. */
static bool check_place_environment(struct zemax_file *file, const struct zemax_setting *setting)
{
    return (zemax_number(file->environment, 0) > -273.15 &&
            zemax_number(file->environment, 1) >= 0) ||
           zemax_fail(setting->line, setting->line->keyword,
                      "a temperature is above -273.15 C, a pressure 0 or more atmospheres");
}

#define OF_SURFACE(member) true, ZEMAX_KEPT(zemax_surface, member)
#define OF_FILE(member)    false, ZEMAX_KEPT(zemax_file, member)

/* Operands of a surface, and those of the system. */
static const struct setting_place {
    const char *words;
    bool of_surface;
    size_t kept, at; /* the line of which it is number `at`; 0: not one alone */
    bool (*place)(struct zemax_file *file, const struct zemax_setting *setting);
} places[] = {{"THIC", true, 0, 0, place_thickness},
              {"CRVT", OF_SURFACE(curvature), 0, NULL},
              {"CONN", OF_SURFACE(conic), 0, NULL},
              {"SDIA", OF_SURFACE(diameter), 0, check_place_diameter},
              {"APMN APMX APDX APDY", true, 0, 0, place_size},
              {"GLSS", true, 0, 0, place_glass},
              {"PRAM EDVA", true, 0, 0, place_numbered},
              {"PAR1 PAR2 PAR3 PAR4 PAR5 PAR6 PAR7 PAR8", true, 0, 0, place_parameter},
              /* before the surface and behind it: numbers of SCBD */
              {"CBOR", OF_SURFACE(shift_before), 1, NULL},
              {"CBDX", OF_SURFACE(shift_before), 3, NULL},
              {"CBDY", OF_SURFACE(shift_before), 4, NULL},
              {"CBTX", OF_SURFACE(shift_before), 5, NULL},
              {"CBTY", OF_SURFACE(shift_before), 6, NULL},
              {"CBTZ", OF_SURFACE(shift_before), 7, NULL},
              {"CAOR", OF_SURFACE(shift_behind), 1, NULL},
              {"CADX", OF_SURFACE(shift_behind), 3, NULL},
              {"CADY", OF_SURFACE(shift_behind), 4, NULL},
              {"CATX", OF_SURFACE(shift_behind), 5, NULL},
              {"CATY", OF_SURFACE(shift_behind), 6, NULL},
              {"CATZ", OF_SURFACE(shift_behind), 7, NULL},
              {"STPS", false, 0, 0, place_stop},
              {"WAVE WLWT", false, 0, 0, place_wave},
              {"PRWV", false, 0, 0, place_primary},
              {"APER", false, 0, 0, place_aperture},
              {"XFIE YFIE FLWT", false, 0, 0, place_field},
              {"FLTP", OF_FILE(fields), 0, NULL},
              {"TELE", OF_FILE(fields), 1, NULL},
              {"AFOC", OF_FILE(fields), 6, NULL},
              {"TEMP", OF_FILE(environment), 0, check_place_environment},
              {"PRES", OF_FILE(environment), 1, check_place_environment}};

/* Null: it is none of those that may differ between the configurations. */
static const struct setting_place *setting_place_of(struct text keyword)
{
    for (size_t i = 0; i < sizeof places / sizeof places[0]; i++) {
        if (word_list_find(places[i].words, keyword) != NULL) {
            return &places[i];
        }
    }
    return NULL;
}

/* One operand of this configuration; false without an error: it has no value. */
static bool place_setting(struct zemax_file *file, const struct zemax_setting *setting)
{
    const struct zemax_line *line = setting->line;
    const struct setting_place *place = setting_place_of(line->keyword);
    if (place == NULL || (place->of_surface && (size_t)setting->surface >= file->surface_count)) {
        return true; /* of a surface that is gone */
    }
    if (place->place != place_glass && !(zemax_all_numbers(line) && line->count > 2)) {
        return false;
    }
    if (place->kept > 0) {
        void *owner = place->of_surface ? (void *)&file->surfaces[setting->surface] : (void *)file;
        const struct zemax_line **kept = (void *)((char *)owner + place->kept);
        *kept = line_of_setting(file, setting, *kept, place->at);
    }
    return place->place == NULL || place->place(file, setting);
}

/* The file as it is in one configuration. */
bool zemax_place_settings(struct zemax_file *file, size_t configuration)
{
    const struct zemax_setting *before = NULL;
    for (const struct zemax_setting *one = file->settings; one != NULL; one = one->next) {
        if (one->configuration == (long)configuration + 1 && !place_setting(file, one)) {
            return file->error->code == ERROR_NONE &&
                   zemax_fail(one->line, one->line->keyword,
                              "%.4s needs a surface, a configuration and its value",
                              one->line->keyword.start);
        }
        if (configuration == 0 && setting_place_of(one->line->keyword) == NULL) {
            /* lenscalc has no positions of it: its words must be the same in all of them */
            struct file_words a = one->line->words, b = before != NULL ? before->line->words : a;
            bool same_operand =
                before != NULL && before->surface == one->surface &&
                memcmp(before->line->keyword.start, one->line->keyword.start, 4) == 0;
            struct text left = {NULL, 0}, right = {NULL, 0};
            for (int i = 0; i < 3; i++) {
                left = file_words_next(&a);
                right = file_words_next(&b);
            }
            if (same_operand && !text_identical(left, right)) {
                zemax_loss(file, one->line, LOSS_OF_RAYS,
                           "what the surfaces and the system of the file say is kept",
                           "%.4s %ld changes between the configurations", one->line->keyword.start,
                           one->surface);
            }
        }
        before = one;
    }
    return true;
}
