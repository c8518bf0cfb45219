/* commands/photo/exposure_answer.c - one question about exposure, answered; and about lamps. */
/* SPDX-License-Identifier: MIT */
#include "commands/photo/exposure_answer.h"

#include "base/arena.h"
#include "base/constants.h"
#include "base/quantity.h"
#include "data/lensdb_facts.h"
#include "photo/flicker.h"
#include "photo/mired.h"
#include "photo/sensitometry.h"
#include "photo/stops.h"

#include <math.h>

/* Of the glass of a usual lens, as [IsoSpeed06] has it. */
static const double LENS_TRANSMITTANCE = 0.9;

/* Absent is what nothing below fills in. */
static void exposure_answer_begin_row(const struct exposure_input *input,
                                      struct exposure_row *restrict row)
{
    *row = (struct exposure_row){
        .deviation = NAN,
        .compensation = !isnan(input->given.compensation) ? input->given.compensation : 0,
        .t_stop = NAN,
        .magnification = input->magnification,
        .corrected_time = NAN,
        .reciprocity_stops = NAN,
        .metered = input->metered,
        .time_to_set = NAN,
        .q = NAN,
        .focal_plane = NAN,
        .glass = NAN,
        .off_axis = NAN,
        .vignetting = NAN,
        .label_residual = NAN,
        .shutter_angle = NAN,
        .frame_rate = NAN,
        .K = input->given.K,
        .C = input->given.C,
        .filter = input->filter.name,
        .film = input->film.name,
        .film_source = input->film.source,
        .scene = input->scene.name,
        .scene_source = input->scene.source,
        .real = photo_real_none,
        .pupil = NAN,
        .wanted = NAN,
        .longer = NAN,
        .stops_wanted = NAN,
    };
}

static int exposure_answer_count_lights(const struct exposure_given *g)
{
    return !isnan(g->ev100) + !isnan(g->ev) + !isnan(g->L) + !isnan(g->E);
}

/* A scene is a light like any other. */
static bool exposure_answer_take_scene(const struct exposure_input *input, struct exposure_given *g,
                                       struct error *error)
{
    if (input->scene.name == NULL) {
        return true;
    }
    if (exposure_answer_count_lights(g) > 0) {
        return fail(error, ERROR_USAGE,
                    "give only one of {--scene}, {--ev}, {--ev-at-iso}, {--luminance} and "
                    "{--illuminance}");
    }
    g->ev100 = input->scene.ev100;
    return true;
}

/* The time by the shutter's angle, or by what the film needs. */
static bool exposure_answer_take_time(const struct exposure_input *input, struct exposure_given *g,
                                      struct exposure_row *row, struct error *error)
{
    if (!isnan(input->corrected_time)) {
        if (input->film.model == NULL || !isnan(g->t)) {
            return fail(error, ERROR_USAGE,
                        "{--corrected-time} needs {--film}, and stands in place of {--time}");
        }
        return reciprocity_metered(input->film.model, input->corrected_time, &g->t, error) ||
               error_prefix(error, "%s: ", input->film.name);
    }
    struct shutter shutter = {input->shutter_angle, input->frame_rate, g->t};
    if (!isnan(shutter.angle)) {
        if (!shutter_solve(&shutter, error)) {
            return false;
        }
        g->t = shutter.t;
    }
    row->shutter_angle = shutter.angle;
    row->frame_rate = shutter.rate;
    return true;
}

/* The transmittance from the T-stop, which stands for the f-number where there is none. */
static bool take_t_stop(const struct exposure_input *input, struct exposure_given *g,
                        struct exposure_row *row, struct error *error)
{
    row->transmittance = input->transmittance;
    if (isnan(input->t_stop)) {
        return true;
    }
    if (!isnan(input->transmittance)) {
        return fail(error, ERROR_USAGE, "give only one of {--transmittance} and {--t-stop}");
    }
    if (isnan(g->N)) {
        g->N = input->t_stop;
        return true;
    }
    return transmittance_from_t_stop(g->N, input->t_stop, &row->transmittance, error);
}

/* A film and a time are a question of their own. */
static void take_time_only(const struct exposure_given *g, struct exposure_row *row)
{
    row->x = (struct exposure){NAN, g->t, NAN, NAN, NAN, NAN,        NAN,
                               NAN, NAN,  NAN, NAN, NAN, EXPOSURE_T, false};
    row->x.Tv = -log2(g->t);
    row->loss = row->K = row->C = NAN;
}

/* A time metered without the filter, and what it becomes: f-number and speed stay as they are. */
static bool solve_metered(const struct exposure_input *input, struct exposure_given *g,
                          struct exposure_row *row, struct error *error)
{
    bool corrects = !isnan(input->corrected_time) || !isnan(input->shutter_angle);
    if (exposure_answer_count_lights(g) > 0 || !isnan(g->t) || corrects || input->equivalent) {
        return fail(error, ERROR_USAGE,
                    "{--metered} stands in place of {--time}, {--corrected-time}, "
                    "{--shutter-angle}, {--equivalent} and of the light");
    }
    g->t = input->metered * exp2(row->loss + row->compensation);
    if (!(g->t > 0) || isinf(g->t)) {
        return fail(error, ERROR_DOMAIN, "the time to set is beyond all numbers");
    }
    if (!isnan(g->N) && !isnan(g->S)) {
        struct exposure_given light = *g;
        light.ev100 = log2(g->N * g->N / input->metered) - log2(g->S / 100);
        light.t = NAN;
        return exposure_solve(&light, &row->x, error);
    }
    double loss = row->loss;
    take_time_only(g, row);
    row->loss = loss;
    row->x.N = g->N;
    row->x.Av = 2 * log2(g->N);
    row->x.S = g->S;
    return true;
}

/* With a film whose speed is known: in place of the usual speed, where one is assumed. */
static bool take_box_speed(const struct exposure_input *input, struct exposure_given *g,
                           struct exposure_row *row, struct error *error)
{
    const struct film_value *film = &input->film;
    row->speed = "ISO 100 (default)";
    if (film->speed_note == NULL) {
        return true;
    }
    if (isnan(film->speed)) {
        return fail(error, ERROR_USAGE, "%s comes in several speeds, ISO %s: give {--iso}",
                    film->name, film->speed_note);
    }
    g->S = film->speed;
    row->speed = film->speed_note;
    return exposure_solve(g, &row->x, error);
}

static bool exposure_answer_solve(const struct exposure_input *input, struct exposure_given *g,
                                  struct exposure_row *row, struct error *error)
{
    int lights = exposure_answer_count_lights(g);
    if (input->equivalent && lights > 0 && isnan(g->N) && isnan(g->t)) {
        g->N = 1; /* any will do: all of them are asked for */
    }
    if (lights > 0 && !isnan(g->N) && !isnan(g->t) && !isnan(g->S)) {
        /* Everything is given: the light asks for one exposure, the camera makes another. */
        struct exposure_given light = *g;
        light.t = NAN;
        if (!exposure_deviation(g, &row->deviation, error) ||
            !exposure_solve(&light, &row->x, error)) {
            return false;
        }
        row->x.t = g->t;
        row->x.ev_set -= row->deviation;
        row->x.Tv = row->x.ev_set - row->x.Av;
        return true;
    }
    if (input->film.model != NULL && lights == 0 && isnan(g->N) && !isnan(g->t)) {
        take_time_only(g, row);
        return true;
    }
    return exposure_solve(g, &row->x, error) &&
           (!row->x.speed_assumed || take_box_speed(input, g, row, error));
}

static bool exposure_answer_correct(const struct exposure_input *input, struct exposure_row *row,
                                    struct error *error)
{
    bool asks = !isnan(input->metered);
    row->time_to_set = asks ? row->x.t : NAN;
    if (input->film.model == NULL) {
        return true;
    }
    if (!reciprocity_corrected(input->film.model, row->x.t, &row->corrected_time, error)) {
        return error_prefix(error, "%s: ", input->film.name);
    }
    row->reciprocity_stops = reciprocity_stops(row->x.t, row->corrected_time);
    row->time_to_set = asks ? row->corrected_time : NAN;
    return true;
}

static bool fill_shutter(const struct exposure_input *input, struct exposure_row *row,
                         struct error *error)
{
    struct shutter shutter = {NAN, input->frame_rate, row->x.t};
    if (isnan(input->frame_rate) || !isnan(row->shutter_angle)) {
        return true;
    }
    if (!shutter_solve(&shutter, error)) {
        return false;
    }
    row->shutter_angle = shutter.angle;
    return true;
}

static bool fill_focal_plane(const struct exposure_input *input, struct exposure_row *row,
                             struct error *error)
{
    bool given = !isnan(row->transmittance);
    double glass = given ? row->transmittance : LENS_TRANSMITTANCE;
    double counted = given ? stops_from_transmittance(glass) : 0; /* in loss and in q */
    if (!input->focal_plane) {
        return true;
    }
    row->glass = glass;
    row->vignetting = input->vignetting;
    row->off_axis = input->off_axis;
    return lens_q(glass, input->vignetting, input->off_axis, &row->q, error) &&
           focal_plane_exposure(row->q, row->x.L, row->x.N, row->x.t, row->loss - counted,
                                &row->focal_plane, error);
}

/* What a label says, as a number. */
static double exposure_answer_label_value(const char *label, const struct dimension *dimension)
{
    double value;
    struct error ignored;
    return quantity_read(text_of(label), dimension, NULL, &value, NULL, &ignored) ? value : NAN;
}

static bool exposure_answer_is_label(const char *label, const struct dimension *dimension,
                                     double value)
{
    return label != NULL &&
           fabs(exposure_answer_label_value(label, dimension) - value) <= 1e-12 * value;
}

void exposure_label(const struct exposure_input *input, struct exposure_row *row)
{
    const struct series_value *series = &input->series;
    bool asks = !isnan(input->metered), time_alone = asks && isnan(row->x.N);
    double Av = time_alone ? 0 : row->x.Av, time = asks ? row->time_to_set : row->x.t;
    double Tv = asks ? -log2(time) : row->x.Tv;
    double N = rint(Av * series->per_stop);
    double t = rint(Tv * series->per_stop);
    double S = row->x.S;
    bool solved_speed = row->x.unknown == EXPOSURE_S;
    row->nominal_fnumber = time_alone ? NULL : stop_label(series->fnumbers, N);
    row->nominal_time = stop_label(series->times, t);
    row->nominal_iso = solved_speed ? series_speed(series, row->x.S, &S) : NULL;
    /* settings that are on the dial are set, whatever their labels are rounded from */
    bool is_set = (time_alone ||
                   exposure_answer_is_label(row->nominal_fnumber, &dimension_fnumber, row->x.N)) &&
                  exposure_answer_is_label(row->nominal_time, &dimension_time, time);
    row->residual = is_set ? 0 : Av + Tv - (N + t) / series->per_stop;
    if (asks && row->nominal_time == NULL) {
        row->residual = NAN; /* for a timer, not for a shutter */
    }
    row->residual += solved_speed ? log2(S / row->x.S) : 0;
}

/* -------- lamps -------- */

static bool answer_colour(const struct lamps *lamps, double filter, struct run *run,
                          struct lamp_row *row, struct error *error)
{
    double behind = lamps->kelvin;
    if (isnan(lamps->kelvin)) {
        return isnan(lamps->balance) || fail(error, ERROR_USAGE, "{--balance} wants {--kelvin}");
    }
    if (!isnan(filter)) {
        if (!mired_filtered(lamps->kelvin, filter, &behind, error)) {
            return false;
        }
        row->filtered = behind;
    }
    if (isnan(lamps->balance)) {
        return true;
    }
    if (isnan(filter)) {
        return fail(error, ERROR_USAGE,
                    "{--filter} has a colour that is none of light: leave it out to find the "
                    "conversion filter");
    }
    return mired_shift(behind, lamps->balance, &row->wanted, error) &&
           lensdb_nearest_conversion(run->db, row->wanted, run->arena, &row->conversion,
                                     &row->conversion_shift, error);
}

/* "1/50": a number of pulses in seconds. */
static const char *time_words(double mains, long pulses, struct arena *arena)
{
    double per_second = 2 * mains;
    if (per_second != floor(per_second) || per_second > 1e6) {
        return arena_printf(arena, "%.4g", flicker_time(mains, pulses));
    }
    long below = (long)per_second, above = pulses, divisor = below, rest = above;
    while (rest > 0) { /* Euclid */
        long next = divisor % rest;
        divisor = rest;
        rest = next;
    }
    return below == divisor ? arena_printf(arena, "%ld", above / divisor)
                            : arena_printf(arena, "%ld/%ld", above / divisor, below / divisor);
}

static const char *flicker_words(const struct flicker *flicker, double rate, struct arena *arena)
{
    bool film = !isnan(rate);
    if (film && flicker->longest == 0) {
        return "cannot be avoided: a frame is shorter than a pulse of the lamps";
    }
    if (isnan(flicker->pulses)) {
        return flicker->is_steady ? "none between frames at any shutter angle" : NULL;
    }
    if (flicker->is_free) {
        return "none";
    }
    if (flicker->is_steady) {
        return "none between frames; bands with a rolling shutter";
    }
    return arena_printf(arena, "%s: %.4g pulses of the lamps",
                        film ? "visible" : "uneven, or bands", flicker->pulses);
}

bool lamps_answer(const struct lamps *lamps, double filter, double t, double rate, struct run *run,
                  struct lamp_row *row, struct error *error)
{
    *row = (struct lamp_row){.kelvin = lamps->kelvin,
                             .balance = lamps->balance,
                             .shift = fabs(filter) > 0 || !isnan(lamps->kelvin) ? filter : NAN,
                             .filtered = NAN,
                             .wanted = NAN,
                             .conversion_shift = NAN,
                             .mains = lamps->mains,
                             .free_time = NAN};
    if (!answer_colour(lamps, filter, run, row, error)) {
        return false;
    }
    struct flicker flicker;
    if (isnan(lamps->mains)) {
        return true;
    }
    if (!flicker_check(lamps->mains, t, rate, &flicker, error)) {
        return false;
    }
    row->free_time = flicker.nearest;
    row->flicker = flicker_words(&flicker, rate, run->arena);
    /* The times without flicker and their angles, the first of them. */
    struct arena *arena = run->arena;
    enum { FOR_A_PICTURE = 6, MOST = 12 };
    bool film = !isnan(rate);
    const long longest = flicker.longest < MOST ? flicker.longest : MOST;
    const long count = film ? longest : FOR_A_PICTURE;
    for (long i = 1; i <= count; i++) {
        const char *comma = i > 1 ? ", " : "";
        row->free_times = arena_printf(arena, "%s%s%s", i > 1 ? row->free_times : "", comma,
                                       time_words(lamps->mains, i, arena));
        if (film) {
            double angle = degrees_from_radians(flicker_angle(lamps->mains, rate, i));
            row->free_angles =
                arena_printf(arena, "%s%s%.5g", i > 1 ? row->free_angles : "", comma, angle);
        }
    }
    return true;
}

bool exposure_is_asked(const struct exposure_input *input)
{
    const struct exposure_given *g = &input->given;
    return exposure_answer_count_lights(g) > 0 || !isnan(g->N) || !isnan(g->S) ||
           !isnan(input->metered) || !isnan(input->corrected_time) || !isnan(input->t_stop) ||
           input->scene.name != NULL || input->film.name != NULL || input->focal_plane ||
           input->equivalent;
}

bool exposure_blank(const struct exposure_input *input, struct exposure_row *row,
                    struct error *error)
{
    struct exposure_given given = input->given;
    exposure_answer_begin_row(input, row);
    if (!exposure_answer_take_time(input, &given, row, error)) {
        return false;
    }
    take_time_only(&given, row);
    row->residual = row->compensation = NAN;
    row->transmittance = input->transmittance;
    row->frame_rate = input->frame_rate;
    return isnan(row->x.t) || fill_shutter(input, row, error);
}

bool exposure_answer(const struct exposure_input *input, struct exposure_row *row,
                     struct error *error)
{
    struct exposure_given given = input->given;
    exposure_answer_begin_row(input, row);
    if (!exposure_answer_take_scene(input, &given, error) ||
        !exposure_answer_take_time(input, &given, row, error) ||
        !take_t_stop(input, &given, row, error)) {
        return false;
    }
    const struct light_loss loss = {
        NAN, NAN, input->filter.stops, row->transmittance, input->magnification, input->lens.pupil};
    bool any =
        input->filter.name != NULL || !isnan(row->transmittance) || !isnan(input->magnification);
    if (any && !light_loss(&loss, &row->loss, error)) {
        return false;
    }
    given.loss = row->loss;
    return (isnan(input->metered) ? exposure_answer_solve(input, &given, row, error)
                                  : solve_metered(input, &given, row, error)) &&
           (isnan(row->transmittance) || isnan(row->x.N) ||
            t_stop(row->x.N, row->transmittance, &row->t_stop, error)) &&
           fill_shutter(input, row, error) && fill_focal_plane(input, row, error) &&
           (input->equivalent || exposure_answer_correct(input, row, error));
}

bool exposure_equivalent_row(const struct exposure_input *input, const struct exposure_row *answer,
                             int step, struct exposure_row *line)
{
    int k = input->series.per_stop;
    struct equivalent_exposure equal;
    struct error ignored;
    double N = exp2((double)step / (2 * k));
    if (!exposure_equivalent(answer->x.ev_set, N, k, &equal, &ignored)) {
        return false;
    }
    *line = *answer;
    line->x.N = N;
    line->x.t = equal.t;
    line->x.Av = 2 * log2(N);
    line->x.Tv = answer->x.ev_set - line->x.Av;
    exposure_label(input, line);
    if (line->nominal_fnumber == NULL || line->nominal_time == NULL) {
        return false;
    }
    const struct camera_setting exact = {N, equal.t, 100};
    const struct camera_setting label = {
        exposure_answer_label_value(line->nominal_fnumber, &dimension_fnumber),
        exposure_answer_label_value(line->nominal_time, &dimension_time), 100};
    exposure_stops(&exact, &label, &line->label_residual, &ignored);
    /* a time that the film's source does not cover stays without correction */
    exposure_answer_correct(input, line, &ignored);
    return true;
}
