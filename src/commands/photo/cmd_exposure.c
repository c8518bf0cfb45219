/* commands/photo/cmd_exposure.c - lenscalc exposure: aperture, time, speed and light. */
/* SPDX-License-Identifier: MIT */
#include "analysis/real/real_light.h"
#include "commands/photo/by_rays.h"
#include "commands/photo/exposure_answer.h"
#include "commands/photo/sharpness.h"
#include "commands/tables.h"

#include "base/constants.h"
#include "report/spoken.h"

#include <math.h>
#include <string.h>

#define INPUT struct exposure_input

#define OPTION_KELVIN(member, option_name, words)                                                  \
    ENTRY(MEASURE(member, colour, NULL, "KELVIN"), REPEATED(option_name),                          \
          .quantity = "colour temperature", .lowest = 500, .highest = 100000, .help = (words))

static const struct option options[] = {
    PHOTO_LENS_OPTIONS(lens),
    OPTION_WAVELENGTH_OF_LENS(lens.wavelength, "lens"),
    OPTION_APERTURE(lens.fnumber, 0),
    OPTION_TIME(given.t, 0),
    OPTION_ISO(given.S, "film or sensor speed (100 unless it is solved for)"),
    OPTION_EV(given.ev100, "light as exposure value at ISO 100"),
    {MEASURE(given.ev, ev, NULL, "EV"), .name = "ev-at-iso",
     .quantity = "exposure value at the ISO speed", .column = "ev_at_iso", .lowest = -100,
     .highest = 100, .help = "light as exposure value at the speed of --iso"},
    {MEASURE(given.L, luminance, "cd_m2", "LUMINANCE"), REPEATED("luminance"), ABOVE_0,
     .help = "light as luminance of the subject, from a reflected-light meter"},
    {MEASURE(given.E, illuminance, "lx", "ILLUMINANCE"), REPEATED("illuminance"), ABOVE_0,
     .help = "light as illuminance on the subject, from an incident-light meter"},
    {ASKED(scene), REPEATED("scene"), .value = "NAME",
     .help = "light as a typical scene: sunny-16, home-interior; see 'list scenes'"},
    {MEASURE(given.compensation, stops, NULL, "STOPS"), REPEATED("compensation"),
     .quantity = "exposure compensation", .lowest = -100, .highest = 100,
     .help = "stops to expose more (+) or less (-) than metered"},
    OPTION_FILTER(filter, "loss"),
    {MEASURE(transmittance, ratio, NULL, "RATIO"), REPEATED("transmittance"), .lowest = 0,
     .highest = 1, .flags = OPTION_ABOVE_LOWEST, .help = "transmittance of the lens: 0.8 or 80%"},
    OPTION_T_NUMBER(t_stop, "T-stop of the lens; without -N it serves as f-number too"),
    {MEASURE(magnification, ratio, NULL, "RATIO"), REPEATED("magnification"), .letter = 'm', FROM_0,
     .help = "magnification of a close-up, whose extension costs light: 1:2 or 0.5"},
    OPTION_PUPIL_OF_LENS(lens.pupil, "magnification"),
    {MEASURE(shutter_angle, angle, "deg", "ANGLE"), .name = "shutter-angle",
     .column = "shutter_angle", .lowest = 0, .highest = 2 * PI, .flags = OPTION_ABOVE_LOWEST,
     .help = "shutter angle of a film or video camera"},
    {MEASURE(frame_rate, rate, NULL, "RATE"), .name = "frame-rate", .column = "frame_rate", ABOVE_0,
     .help = "frames per second"},
    {MEASURE(metered, time, "s", "TIME"), REPEATED("metered"), .quantity = "metered time", ABOVE_0,
     .help = "time metered without the --filter: gives the time to set with it"},
    {ASKED(propose), .name = "propose", .wants = "time",
     .excludes = "equivalent shutter-angle corrected-time",
     .help = "which filters, up to three stacked, make --time of a shorter one: one row each"},
    {ASKED(own), .name = "own", .value = "FILTERS", .wants = "propose",
     .help = "the filters you own, for --propose: ND8,ND64,ND1000 (otherwise the usual ones)"},
    {ASKED(film), REPEATED("film"), .value = "NAME",
     .help = "corrects long times for reciprocity failure; see 'list films'"},
    {MEASURE(corrected_time, time, "s", "TIME"), .name = "corrected-time",
     .column = "corrected_time", ABOVE_0,
     .help = "time on the --film, in place of the metered --time"},
    {ASKED(focal_plane), .name = "focal-plane",
     .help = "add the luminous exposure of film or sensor"},
    {MEASURE(vignetting, ratio, NULL, "RATIO"), REPEATED("vignetting"), .lowest = 0, .highest = 1,
     .flags = OPTION_ABOVE_LOWEST, .fallback = "0.98", .wants = "focal-plane",
     .help = "fraction of light that passes off axis, for --focal-plane"},
    {MEASURE(off_axis, angle, "deg", "ANGLE"), .name = "off-axis", .quantity = "field angle",
     .column = "off_axis", .lowest = 0, .highest = 1.5533430342749532, .fallback = "10",
     .wants = "focal-plane", .help = "field angle, for --focal-plane"},
    {MEASURE(given.K, number, NULL, "K"), .name = "meter-k", .quantity = "meter constant K",
     .column = "meter_k", ABOVE_0, .fallback = "12.5",
     .help = "constant of the reflected-light meter: 12.5, some meters 14"},
    {MEASURE(given.C, number, NULL, "C"), .name = "meter-c", .quantity = "meter constant C",
     .column = "meter_c", ABOVE_0, .fallback = "250",
     .help = "constant of the incident-light meter: 250 flat, 340 with a dome"},
    BY_RAYS_EXACT_OPTION(lens.rays,
                         "the T-stop of --lens from its exact rays, in place of the f-number"),
    {ASKED(fresnel), .name = "fresnel", .wants = "exact",
     .help = "include reflection losses of uncoated surfaces"},
    OPTION_KELVIN(lamps.kelvin, "kelvin",
                  "colour temperature of the light: 3200K; shows what filters make of it"),
    OPTION_KELVIN(lamps.balance, "balance",
                  "colour temperature that the film or white balance is made for: finds the "
                  "conversion filter"),
    {MEASURE(lamps.mains, rate, "Hz", "50|60"), REPEATED("mains"), .quantity = "mains frequency",
     ABOVE_0,
     .help = "mains frequency of flickering lamps: finds times and shutter angles without flicker"},
    OPTION_SERIES(series),
    {ASKED(equivalent), .name = "equivalent",
     .help = "all equivalent exposures of the series, one row per f-number"},
};

#define ROW struct exposure_row

static const struct column columns[] = {
    PHOTO_LENS_COLUMNS(real),
    PHOTO_LENS_WAVELENGTH_COLUMN(real),
    {SHOWN(proposed), .name = "filters", BRIEF_WITH("propose"), .label = "filters to put on",
     .help = "neutral-density filters that come near the wanted time"},
    {TIME(wanted), .name = "wanted", WITH("propose") | COLUMN_ECHO, .label = "wanted time",
     .help = "as --time has it"},
    {STOPS(stops_wanted), .name = "stops_wanted", BRIEF_WITH("propose"), .symbol = "sw",
     .label = "stops wanted", .help = "from the time without these filters to the wanted one"},
    {STOPS(longer), .name = "longer", BRIEF_WITH("propose"), .symbol = "dt",
     .label = "longer (+) or shorter (-) than wanted",
     .help = "the time with these filters over the wanted one, in stops"},
    {TIME(metered), .name = "metered", ECHO_WITH("metered filter") | COLUMN_BRIEF | COLUMN_SPARSE,
     .symbol = "tm", .label = "metered time", .help = "as metered without filter"},
    {SHOWN(x.N), .name = "fnumber", BRIEF | COLUMN_ECHO | COLUMN_SPARSE, .symbol = "N",
     .label = "f-number", .help = "f-number"},
    COLUMN_NOMINAL_FNUMBER(nominal_fnumber),
    {TIME(x.t), .name = "time", BRIEF | COLUMN_SPARSE, .symbol = "t",
     .help = "exposure time, metered"},
    COLUMN_NOMINAL_TIME(nominal_time),
    {STOPS(residual), .name = "residual", BRIEF | COLUMN_SPARSE, .symbol = "r",
     .label = "nearest camera settings: over (+) or under (-)",
     .help = "stops by which the nearest steps of the series expose over (+) or under (-)"},
    {STOPS(label_residual), .name = "label_residual", BRIEF_WITH("equivalent"),
     .label = "the same by their labels",
     .help = "as residual, with labels taken at face value: 1/125 for 1/128"},
    {TIME(corrected_time), .name = "corrected_time", BRIEF_WITH("film"), .symbol = "Tc",
     .label = "time on this film", .help = "time corrected for reciprocity failure"},
    {STOPS(reciprocity_stops), .name = "reciprocity", WITH("film"), .label = "reciprocity failure",
     .help = "corrected over metered time, in stops"},
    {TIME(time_to_set), .name = "time_to_set", BRIEF_WITH("metered filter") | COLUMN_SPARSE,
     .symbol = "ts", .label = "time to set",
     .help = "through the filter, and corrected for the --film"},
    {SHOWN(timer), .name = "timer", WITH("metered") | COLUMN_HIDDEN,
     .help = "time to set in words: 2 min 30 s"},
    {SHOWN(x.S), .name = "iso", BRIEF | COLUMN_ECHO | COLUMN_SPARSE, .symbol = "S",
     .label = "ISO speed", .help = "film or sensor speed"},
    {SHOWN(nominal_iso), .name = "nominal_iso", BRIEF | COLUMN_SPARSE, .label = "nearest ISO speed",
     .help = "nearest speed of cameras, where it is solved for"},
    {SHOWN(x.ev100), .name = "ev100", BRIEF | COLUMN_SPARSE, .symbol = "EV100",
     .label = "EV at ISO 100", .help = "light as exposure value at ISO 100"},
    {SHOWN(x.ev), .name = "ev_at_iso", .symbol = "EV", .label = "EV at this ISO",
     .help = "light as exposure value at this speed"},
    {STOPS(deviation), .name = "deviation", BRIEF_WITH("iso"), .symbol = "d",
     .label = "deviation from the metered exposure",
     .help = "where everything is given: stops over (+) or under (-) the light"},
    {MEASURED(x.L, luminance, "cd_m2"), .name = "luminance", .symbol = "L",
     .help = "of the subject"},
    {MEASURED(x.E, illuminance, "lx"), .name = "illuminance", .symbol = "E",
     .help = "on the subject"},
    {STOPS(loss), .name = "loss", .symbol = "loss", .label = "light loss",
     .help = "by filters, glass and extension together"},
    {STOPS(compensation), .name = "compensation", ECHO_WITH("compensation"), .symbol = "more",
     .help = "exposed more than metered"},
    {SHOWN(transmittance), .name = "transmittance", WITH("t-stop lens"), .help = "of the lens"},
    {SHOWN(t_stop), .name = "t_stop", WITH("transmittance lens"), .symbol = "T", .label = "T-stop",
     .help = "f-number of a lens without loss"},
    {SHOWN(magnification), .name = "magnification", ECHO_WITH("magnification"),
     .help = "size on the sensor over size"},
    {ANGLE(shutter_angle), .name = "shutter_angle", WITH("frame-rate"), .symbol = "a",
     .label = "shutter angle", .help = "of a film camera at that time"},
    {MEASURED(frame_rate, rate, "fps"), .name = "frame_rate", ECHO_WITH("shutter-angle mains"),
     .symbol = "rate", .label = "frame rate", .help = "frames per second"},
    {MEASURED(lamps.kelvin, colour, "K"), .name = "kelvin", ECHO_WITH("kelvin"), .symbol = "K1",
     .label = "colour temperature", .help = "of the light"},
    {MEASURED(lamps.balance, colour, "K"), .name = "balance", ECHO_WITH("balance"), .symbol = "K2",
     .label = "balanced for", .help = "colour temperature of film or white balance"},
    {SHOWN(lamps.shift), .name = "mired_shift", WITH("filter"), .symbol = "M",
     .label = "mired shift of the filter", .help = "of the filters that are on: + amber, - blue"},
    {MEASURED(lamps.filtered, colour, "K"), .name = "filtered", BRIEF_WITH("filter"),
     .symbol = "K3", .label = "behind the filter",
     .help = "colour temperature behind the filters that are on"},
    {SHOWN(lamps.wanted), .name = "mired_wanted", BRIEF_WITH("balance"), .symbol = "Mw",
     .label = "mired shift wanted", .help = "beside the filters that are on"},
    {SHOWN(lamps.conversion), .name = "conversion_filter", BRIEF_WITH("balance"),
     .label = "nearest filter", .help = "conversion filter with the nearest shift"},
    {SHOWN(lamps.conversion_shift), .name = "conversion_shift", WITH("balance"),
     .label = "its mired shift", .help = "of the nearest filter"},
    {SHOWN(lamps.flicker), .name = "flicker", BRIEF_WITH("mains"),
     .help = "of this exposure under lamps on the mains"},
    {TIME(lamps.free_time), .name = "flicker_free_time", BRIEF_WITH("mains"), .symbol = "tf",
     .label = "nearest time without flicker", .help = "whole pulses of the lamps, within a frame"},
    {SHOWN(lamps.free_times), .name = "flicker_free_times", WITH("mains"),
     .label = "times without flicker", .help = "the first of them, in s"},
    {SHOWN(lamps.free_angles), .name = "flicker_free_angles", WITH("mains"),
     .label = "shutter angles without flicker", .help = "at the frame rate, in degrees"},
    {MEASURED(lamps.mains, rate, "Hz"), .name = "mains",
     ASSUMED_WITH("mains", "mains") | COLUMN_ECHO, .symbol = "mains",
     .label = "lamps on a mains of", .help = "frequency of the mains"},
    {MEASURED(focal_plane, exposure, "lx_s"), .name = "exposure", BRIEF_WITH("focal-plane"),
     .symbol = "H", .label = "exposure of the film", .help = "luminous exposure of film or sensor"},
    {SHOWN(q), .name = "lens_q", WITH("focal-plane"), .symbol = "q", .label = "lens constant q",
     .help = "from luminance and f-number to illuminance"},
    {SHOWN(glass), .name = "glass_transmittance", WITH("focal-plane"), .symbol = "tau",
     .label = "transmittance of the glass", .help = "as given, else 0.9; in q"},
    {ANGLE(off_axis), .name = "off_axis", ECHO_WITH("focal-plane"), .symbol = "theta",
     .label = "off axis", .help = "field angle"},
    {SHOWN(vignetting), .name = "vignetting", ECHO_WITH("focal-plane"), .symbol = "v",
     .help = "light that passes"},
    {SHOWN(x.ev_set), .name = "ev_set", .flags = COLUMN_EXTRA, .label = "EV of the camera",
     .help = "log2(N^2/t)"},
    {SHOWN(x.Av), .name = "av", .flags = COLUMN_EXTRA, .label = "Av", .help = "APEX aperture"},
    {SHOWN(x.Tv), .name = "tv", .flags = COLUMN_EXTRA, .label = "Tv", .help = "APEX time"},
    {SHOWN(x.Sv), .name = "sv", .flags = COLUMN_EXTRA, .label = "Sv", .help = "APEX speed"},
    {SHOWN(x.Bv), .name = "bv", .flags = COLUMN_EXTRA, .label = "Bv", .help = "APEX brightness"},
    {SHOWN(pupil), .name = "pupil_magnification",
     ASSUMED_WITH("lens", "pupil lens position section wavelength") | COLUMN_ECHO, .symbol = "P",
     .label = "pupil magnification", .help = "diameter of the exit over the entrance pupil"},
    {SHOWN(traced), .name = "t_stop_by", ASSUMED_WITH("exact", "exact fresnel"),
     .label = "T-stop by", .help = "what the ray-traced T-stop takes into account"},
    {SHOWN(spectrum), .name = "spectrum", ASSUMED_WITH("exact", "lens wavelength"),
     .label = "wavelengths", .help = "of the rays, each with its weight"},
    {SHOWN(speed), .name = "speed", ASSUMED_BY("iso film"),
     .help = "what was taken where no ISO is given"},
    {SHOWN(scene), .name = "scene", ASSUMED_BY("scene"), .help = "scene of the light"},
    {SHOWN(scene_source), .name = "scene_source", ASSUMED_BY("scene"), .label = "scene source",
     .help = "confidence and source of the scene's light"},
    {SHOWN(filter), .name = "filter", ASSUMED_BY("filter"),
     .help = "filters and the stops they take"},
    {SHOWN(film), .name = "film", ASSUMED_BY("film"), .help = "film of the corrected time"},
    {SHOWN(film_source), .name = "film_source", ASSUMED_BY("film"), .label = "film source",
     .help = "status and source of the film's correction"},
    {SHOWN(K), .name = "meter_k", ASSUMED_BY("meter-k") | COLUMN_ECHO, .symbol = "K",
     .label = "meter constant K", .help = "of the reflected-light meter"},
    {SHOWN(C), .name = "meter_c", ASSUMED_BY("meter-c") | COLUMN_ECHO, .symbol = "C",
     .label = "meter constant C", .help = "of the incident-light meter"},
    PHOTO_LENS_WARNING_COLUMN(real),
};

/*
 * The T-stop of the real lens as the transmittance that gives it: of its f-number and extension,
 * which count too, whatever the rays make of these.
 */
static bool light_by_rays(const struct photo_lens *lens, struct run *run,
                          struct exposure_input *own, struct by_rays_row *row, struct error *error)
{
    const double m = own->magnification, near = isnan(m) ? 0 : m;
    const double distance = near > 0 ? lens->f * (1 + 1 / near) : INFINITY;
    const double object = isinf(distance) ? distance : distance - lens->measuring.front;
    struct real_focus focus;
    struct real_point point;
    struct real_light light;
    if (isnan(lens->N)) {
        return fail(
            error, ERROR_USAGE,
            "{--exact} finds the T-stop of an f-number: give {--aperture}, and leave one of "
            "{--time}, {--iso} and the light to be found");
    }
    if (own->equivalent) {
        return fail(error, ERROR_USAGE,
                    "{--exact} finds the T-stop of one f-number: it excludes {--equivalent}");
    }
    if (!isnan(own->t_stop) || !isnan(own->transmittance)) {
        return fail(error, ERROR_USAGE, "{--exact} finds the T-stop: it excludes {--%s}",
                    !isnan(own->t_stop) ? "t-stop" : "transmittance");
    }
    if (!by_rays_open(&own->lens, lens, distance, 0, run, &focus, row, error) ||
        !real_focus_point(&focus, object, &point, error)) {
        return false;
    }
    const struct real_light_question seen = {focus.asked, object, point.sharpest, own->fresnel};
    if (!real_light_find(&seen, run->arena, &light, error)) {
        return false;
    }
    const double working = diffracting_fnumber(lens->N, near, lens->P);
    own->transmittance = working / light.t_stop * (working / light.t_stop);
    return true;
}

/* What of the light the lens lets pass: by its rays, or as its source states it. */
static bool take_lens_light(const struct photo_lens *lens, struct run *run,
                            struct exposure_input *own, struct by_rays_row *row,
                            struct error *error)
{
    if (own->lens.rays.exact) {
        return light_by_rays(lens, run, own, row, error);
    }
    if (isnan(own->t_stop) && isnan(own->transmittance) && !isnan(lens->t_ratio)) {
        own->transmittance = 1 / (lens->t_ratio * lens->t_ratio);
    }
    return true;
}

/* Of a million rows most of the time went into labels that few ask for. */
static bool shows_labels(const struct run *run)
{
    return run_shows(run, offsetof(struct exposure_row, nominal_fnumber)) ||
           run_shows(run, offsetof(struct exposure_row, nominal_time)) ||
           run_shows(run, offsetof(struct exposure_row, nominal_iso)) ||
           run_shows(run, offsetof(struct exposure_row, residual));
}

/* --propose, or a metered time beside a wanted one: what asks for filters, said or not. */
static bool exposure_proposes(const struct exposure_input *input)
{
    const struct exposure_given *g = &input->given;
    return input->propose ||
           (!isnan(input->metered) && !isnan(g->t) && isnan(g->ev100) && isnan(g->ev) &&
            isnan(g->L) && isnan(g->E) && input->scene.name == NULL &&
            isnan(input->corrected_time) && isnan(input->shutter_angle) && !input->equivalent);
}

static bool exposure_brings(const void *data, const char *option)
{
    return strcmp(option, "propose") == 0 && exposure_proposes(data);
}

/* A time and what takes light of it, and no f-number, speed or light: it was metered without. */
static void exposure_take_metered(struct exposure_input *own, struct run *run)
{
    const struct exposure_given *g = &own->given;
    const bool has_light = !isnan(g->ev100) || !isnan(g->ev) || !isnan(g->L) || !isnan(g->E) ||
                           own->scene.name != NULL;
    if (own->filter.name == NULL || isnan(g->t) || !isnan(g->N) || !isnan(g->S) || has_light ||
        !isnan(own->metered) || !isnan(own->corrected_time) || !isnan(own->t_stop) ||
        own->equivalent || own->focal_plane) {
        return;
    }
    own->metered = g->t;
    own->given.t = NAN;
    warnings_add(run->doubts,
                 "beside --filter alone --time is taken as metered without it: --metered has that");
}

/* Answer one question, its lens and light taken. */
static bool exposure_fill_row(const struct exposure_input *input, const struct photo_lens *lens,
                              const struct by_rays_row *rays, struct run *run,
                              struct exposure_row *row, struct error *error)
{
    const struct lamps *lamps = &input->lamps;
    bool blank = !(isnan(lamps->kelvin) && isnan(lamps->balance) && isnan(lamps->mains)) &&
                 !exposure_is_asked(input);
    if (!(blank ? exposure_blank(input, row, error) : exposure_answer(input, row, error)) ||
        !lamps_answer(lamps, input->filter.mired, row->x.t, input->frame_rate, run, &row->lamps,
                      error)) {
        return false;
    }
    if (!blank && shows_labels(run)) {
        exposure_label(input, row);
    }
    row->real = *lens->real;
    row->pupil = lens->P;
    row->spectrum = rays->spectrum;
    const char *traced = input->fresnel ? "rays of the lens, its faces uncoated"
                                        : "rays of the lens, without loss in glass and faces";
    row->traced = input->lens.rays.exact ? traced : NULL;
    if (!isnan(row->time_to_set)) {
        char words[SPOKEN_LENGTH];
        spoken_time(words, row->time_to_set, 3);
        row->timer = arena_string(run->arena, words, strlen(words));
    }
    return true;
}

/* One row for each stack of filters but those whose time nobody knows on the film. */
static bool propose_filters(const struct exposure_input *input, const struct photo_lens *lens,
                            const struct by_rays_row *rays, struct run *run, struct error *error)
{
    struct exposure_input questions[NEUTRAL_STACKS];
    const char *proposed[NEUTRAL_STACKS];
    size_t count, answered = 0;
    double stops = NAN;
    if (!exposure_propose(input, run->arena, questions, proposed, &count, &stops, error)) {
        return false;
    }
    for (size_t i = 0; i < count; i++) {
        struct exposure_row row;
        if (!exposure_fill_row(&questions[i], lens, rays, run, &row, error)) {
            if (input->film.model == NULL || error->code != ERROR_DOMAIN) {
                return false;
            }
            warnings_add(run->doubts, "filters %s are left out: %s", proposed[i], error->message);
            continue;
        }
        answered++;
        const double time = isnan(row.corrected_time) ? row.x.t : row.corrected_time;
        row.proposed = proposed[i];
        row.filter = input->filter.name; /* that was on already */
        row.wanted = input->given.t;
        row.stops_wanted = stops;
        row.longer = log2(time / row.wanted);
        if (!run_emit(run, &row)) {
            break;
        }
    }
    if (answered > 0) {
        error->code = ERROR_NONE;
    }
    return answered > 0;
}

static bool exposure_row_answer(const void *data, const struct photo_lens *lens, struct run *run,
                                struct error *error)
{
    struct exposure_input own = *(const struct exposure_input *)data;
    const struct exposure_input *input = &own;
    struct by_rays_row rays = by_rays_none;
    struct exposure_row row;
    own.given.N = lens->N;
    if (!take_lens_light(lens, run, &own, &rays, error)) {
        return false;
    }
    own.lens.pupil = lens->P;
    if (exposure_proposes(input)) {
        own.propose = true;
        return propose_filters(input, lens, &rays, run, error);
    }
    exposure_take_metered(&own, run);
    if (!exposure_fill_row(input, lens, &rays, run, &row, error)) {
        return false;
    }
    if (!input->equivalent) {
        run_emit(run, &row);
        return true;
    }
    struct exposure_row line;
    int lines = 0;
    for (int step = 0; step <= 12 * input->series.per_stop; step++) { /* f/1 to f/64 */
        if (exposure_equivalent_row(input, &row, step, &line)) {
            lines++;
            if (!run_emit(run, &line)) {
                return true;
            }
        }
    }
    return lines > 0 || fail(error, ERROR_DOMAIN, "no f-number and time of the series make EV %.4g",
                             row.x.ev_set);
}

static bool exposure_run(const void *data, struct run *run, struct error *error)
{
    const struct exposure_input *input = data;
    /* The f-number is found where all the rest is given; else that of a real lens counts. */
    const struct exposure_given *g = &input->given;
    bool time = !isnan(g->t) || !isnan(input->shutter_angle) || !isnan(input->corrected_time);
    bool light = !isnan(g->ev100) || !isnan(g->ev) || !isnan(g->L) || !isnan(g->E) ||
                 input->scene.name != NULL;
    int use = ((time && light && !isnan(g->S)) ? PHOTO_LENS_SOLVES_FNUMBER : 0) |
              (isnan(input->magnification) ? PHOTO_LENS_WITHOUT_PUPILS : 0);
    return photo_lens_each(&input->lens, use, run, exposure_row_answer, input, error);
}

static bool exposure_makes_many(const void *data)
{
    const struct exposure_input *input = data;
    return input->equivalent || exposure_proposes(input) || photo_lens_makes_many(&input->lens);
}

PHOTO_LENS_VARIES(lens)

static const struct explanation explanations[] = {
    {"ev100", "EV100 = log2({N}^2/{t}) - log2({S}/100) + {loss} + {more}",
     "[IsoMeter74] and [Apex60]; the same equation gives N, t or S from the light",
     "without reciprocity failure, see --film"},
    {"luminance", "L = {K} 2^{EV100}/100", "[IsoMeter74], reflected light",
     "meters differ in K by 0.16 stop"},
    {"illuminance", "E = {C} 2^{EV100}/100", "[IsoMeter74], incident light",
     "C depends on the receptor: 250 flat, 340 dome"},
    {"deviation", "d = EV100 + log2({S}/100) - {loss} - {more} - log2({N}^2/{t})", "[Apex60]",
     NULL},
    {"time_to_set", "ts = {tm} 2^({loss} + {more})", "definition of a stop",
     "and corrected for the film, where one is given"},
    {"corrected_time", "Tc = t_film({t})",
     "as the film's source gives it: Tm^p, points joined in log-log, or Tm + a Tm^1.62",
     "one emulsion and developer; sources differ by 0.6 stop"},
    {"shutter_angle", "a = 360 {rate} {t}", "definition of the rotating shutter", NULL},
    {"t_stop !t_stop_by", "T = {N}/sqrt(tau)", "[IsoAperture08]", NULL},
    {"t_stop t_stop_by", "T = (N/Nw) sqrt(pi/(4 tau E/L))",
     "[IsoAperture08], exact rays; E/L in sr, tau of the faces, Nw = N (1 + m/P)", NULL},
    {"transmittance", "tau = ({N}/{T})^2", "[IsoAperture08]", NULL},
    {"filtered", "K3 = 10^6/(10^6/{K1} + {M})", "[Priest33]; M in mired",
     "light near that of a black body"},
    {"mired_wanted", "Mw = 10^6/{K2} - 10^6/{K1} - {M}", "[Priest33]", NULL},
    {"flicker_free_time", "tf = n/(2 {mains})", "n whole pulses of the lamps",
     "lamps that follow the mains"},
    {"lens_q", "q = pi/4 {tau} {v} cos^4({theta})",
     "[IsoSpeed06]; transmittance 0.9 where none is given", "cos^4 is that of a thin lens"},
    {"exposure", "H = {q} {L} {t}/{N}^2 2^-{loss}", "[IsoSpeed06]",
     "loss without that of the glass, which q holds"},
    {NULL, NULL, NULL, NULL},
};

static const struct example examples[] = {
    {"exposure --scene sunny-16 -N 8 --iso 200", "the time in bright sun"},
    {"exposure -N 16 -t 1/8 --equivalent --series full",
     "equivalent exposures, and how far they are from equal"},
    {"exposure -N 5.6 --ev 12 --filter ND3.0+polarizer", "through two filters"},
    {"exposure --lens cooke-triplet-50 --ev 12 -m 1:2", "a real lens wide open, close up"},
    {"exposure --metered 1/125 --filter ND1000", "the time to set behind a ten-stop filter"},
    {"exposure --metered 1/125 -t 30s --propose", "the filters that make 30 s of 1/125 s"},
    {"exposure --metered 1/4 --filter 10stops --film \"HP5 Plus\"",
     "corrected for reciprocity failure, for a timer"},
    {"exposure -N 22 --ev 5 --film \"HP5 Plus\"",
     "a long exposure, corrected for reciprocity failure"},
    {"exposure -N 8 -t 1/125 --iso 400 --ev 12", "how far off these settings are"},
    {"exposure -N 1.4..16 -t 1/500..1/15 --table N,t:ev100", "a table of exposure values"},
    {"exposure --ev 9 -N 1.4..8 --iso 100..3200 --table N,iso:nominal_time", "times to print"},
    {"exposure -t 180deg@24fps --frame-rate 24 --ev 10 --iso 800",
     "the f-number for a film camera"},
    {"exposure --kelvin 3200 --balance 5500", "the conversion filter for tungsten light"},
    {"exposure --mains 50 --frame-rate 24", "shutter angles without flicker"},
    {NULL, NULL},
};

BY_RAYS_WEIGHT(lens.rays)

const struct command command_exposure = {
    .name = "exposure",
    .stop_size_wants = "exact",
    COMMAND_OF("photography", "aperture, time, speed and light, each from the others"),
    .run = exposure_run,
    .makes_many = exposure_makes_many,
    .varies = varies,
    .brings = exposure_brings,
    .weight = weight,
    .plot = "time_s|ev100|iso",
    .plot_titles = "Exposure time|Exposure value|Film speed",
    .cell = "ev100",
};
