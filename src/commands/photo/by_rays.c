/* commands/photo/by_rays.c - answers of photographic commands by the rays of a real lens. */
/* SPDX-License-Identifier: MIT */
#include "commands/photo/by_rays.h"

#include "analysis/setup/setup.h"
#include "base/number.h"
#include "commands/analysis/analysis_cursor.h"

#include <math.h>
#include <string.h>

const struct by_rays_row by_rays_none = {NAN, NULL, NULL};

/* A number behind a word, with what may follow it. */
static bool by_rays_read_number(const char *text, const char *word, const char *unit, double *value)
{
    const size_t length = strlen(word);
    if (strncmp(text, word, length) != 0) {
        return false;
    }
    const char *behind = number_read(text + length, text + strlen(text), NUMBER_UNSCALED, value);
    return behind != NULL && (*behind == '\0' || strcmp(behind, unit) == 0);
}

static bool read_rule(const char *text, struct blur_rule *rule, struct error *error)
{
    double value;
    if (text == NULL || strcmp(text, "rms") == 0) {
        *rule = (struct blur_rule){BLUR_RMS, 0};
        return true;
    }
    if (by_rays_read_number(text, "energy", "%", &value) && value >= 1 && value <= 99) {
        *rule = (struct blur_rule){BLUR_ENERGY, value / 100};
        return true;
    }
    if (by_rays_read_number(text, "mtf@", "/mm", &value) && value >= 1e-3 && value <= 1e4) {
        *rule = (struct blur_rule){BLUR_MTF, value};
        return true;
    }
    fail(error, ERROR_USAGE, "unknown rule '%.40s'", text);
    return error_hint(error, "rms, energy1 to energy99 (the share of the light in %%), or "
                             "mtf@40/mm (a frequency above 0)");
}

bool by_rays_accepts(const char *criterion, struct error *error)
{
    struct blur_rule rule;
    return read_rule(criterion, &rule, error);
}

static const char *by_rays_words_of(struct blur_rule rule, struct arena *arena)
{
    switch (rule.measure) {
    case BLUR_ENERGY:
        return arena_printf(arena, "the disc that holds %.6g %% of the light", 100 * rule.at);
    case BLUR_MTF:
        return arena_printf(arena, "the geometric contrast at %.6g/mm", rule.at);
    case BLUR_RMS:
        break;
    }
    return "root mean square";
}

bool by_rays_open(const struct photo_lens_question *question, const struct photo_lens *lens,
                  double distance, double c, struct run *run, struct real_focus *focus,
                  struct by_rays_row *row, struct error *error)
{
    struct setup setup;
    struct real_focus_question seen = {.c = c};
    /* What may not be asked together with rays. */
    if (lens->lens == NULL) {
        return fail(error, ERROR_USAGE, "{--exact} traces rays: it needs {--lens}");
    }
    /* of a lens without a stop it says what nothing else can */
    if (question->pupil > 0 && !isnan(lens->first->pupil_magnification)) {
        return fail(error, ERROR_USAGE,
                    "{--exact} goes by the lens's own pupils: it excludes {--pupil}");
    }
    if (!read_rule(question->rays.criterion, &seen.rule, error)) {
        return false;
    }
    seen.lens = (struct setup_question){
        .lens = lens->lens,
        .position = lens->position,
        .section = (enum lens_section)question->section,
        .wavelength =
            question->wavelength > 0 ? wavelength_micrometres(question->wavelength) : (double)NAN,
        .wavelengths = WAVELENGTHS_ALL,
        .fnumber = question->fnumber > 0 ? question->fnumber : (double)NAN,
    };
    seen.object = isinf(distance) ? distance : distance - lens->measuring.front;
    if (!setup_open(&seen.lens, run->arena, &setup, error)) {
        return false;
    }
    row->rule = by_rays_words_of(seen.rule, run->arena);
    row->spectrum = analysis_spectrum_words(&setup);
    if (!real_focus_open(&seen, run->arena, focus, error)) {
        return false;
    }
    const char *width =
        lens_warnings_join(setup_width_warning(&setup, seen.lens.fnumber, run->arena),
                           setup_stop_warning(&setup, run->arena), run->arena);
    const char *said = lens->real->warning;
    if (width != NULL && (said == NULL || strstr(said, width) == NULL)) {
        warnings_add(run->doubts, "%s", width);
    }
    if (focus->error > 2e-3) {
        warnings_add(run->doubts, "blurs have not converged: twice the rays change them by more "
                                  "than 0.2 %%");
    }
    return true;
}

bool by_rays_image(const struct real_focus *focus, const struct photo_lens *lens, double distance,
                   double *image, double *blur, struct error *error)
{
    const double object = isinf(distance) ? distance : distance - lens->measuring.front;
    const struct arena_mark mark = arena_mark(focus->arena);
    struct real_point point;
    if (!real_focus_point(focus, object, &point, error)) {
        return false;
    }
    *image = point.sharpest - lens->real->rear;
    *blur = real_focus_blur(focus, &point, point.sharpest);
    arena_reset(focus->arena, mark);
    return true;
}

bool by_rays_distance(const struct real_focus *focus, const struct photo_lens *lens, double start,
                      double total, double *distance, struct error *error)
{
    enum { TURNS = 50 };
    *distance = start;
    for (int turn = 0; turn < TURNS && isfinite(total); turn++) {
        double image, blur;
        if (!by_rays_image(focus, lens, *distance, &image, &blur, error)) {
            return false;
        }
        const double m = lens->f / (*distance - lens->f);
        const double step = (*distance + image + lens->measuring.hiatus - total) / (1 - m * m);
        *distance -= step;
        if (fabs(step) <= 1e-14 * *distance) {
            return true;
        }
    }
    return isinf(total) ||
           fail(error, ERROR_DOMAIN, "no distance from the sensor agrees with the sharpest image");
}
