/* commands/photo/cmd_flash.c - lenscalc flash: guide numbers, and flash beside other light. */
/* SPDX-License-Identifier: MIT */
#include "cli/question/command.h"
#include "commands/photo/photo_options.h"
#include "commands/tables.h"
#include "photo/flash.h"
#include "photo/given.h"

#include <math.h>

struct flash_input {
    const char *zoom; /* guide numbers by reflector position */
    double at;
    double guide_number, second, fnumber, distance, iso, power, flashes;
    struct loss_value loss, filter;
    double ceiling, ceiling_subject, background;
    double time, sync, ev;
    double key_to_fill, ratio;
    struct series_value series;
};

#define INPUT struct flash_input

static const struct option options[] = {
    {MEASURE(guide_number, length, "m", "LENGTH"), .name = "guide-number", .letter = 'g',
     .column = "guide_number", ABOVE_0,
     .help = "guide number of one flash at ISO 100 and full power, in m (or ft)"},
    {ASKED(zoom), .name = "zoom", .value = "F:GN,F:GN...", .wants = "at",
     .excludes = "guide-number",
     .help = "guide numbers by reflector position, as the manual lists them: 35mm:36m,105mm:58m"},
    {MEASURE(at, length, "mm", "LENGTH"), REPEATED("at"), .quantity = "reflector position", ABOVE_0,
     .wants = "zoom", .help = "focal length the reflector is set for"},
    {MEASURE(second, length, "m", "LENGTH"), REPEATED("second"), ABOVE_0,
     .help = "guide number of another flash beside it"},
    OPTION_APERTURE(fnumber, 0),
    OPTION_DISTANCE(distance, OPTION_NO_INFINITY, "distance from the flash to the subject"),
    OPTION_ISO(iso, "film or sensor speed (100 unless it is solved for)"),
    {MEASURE(power, ratio, NULL, "FRACTION"), REPEATED("power"), .quantity = "flash power",
     .lowest = 0, .highest = 1, .flags = OPTION_ABOVE_LOWEST,
     .help = "fraction of full power: 1/16 (solved for if all else is given)"},
    {MEASURE(flashes, number, NULL, "N"), REPEATED("flashes"), .quantity = "number of flashes",
     ABOVE_0, .help = "number of equal flashes side by side (1)"},
    {MEASURE(loss, stops, NULL, "LOSS"), REPEATED("loss"), .quantity = "light loss",
     .help = "light lost at the flash, by umbrella, bounce or gel: 1.5stops, ND8, 2x"},
    OPTION_FILTER(filter, "filter"),
    {MEASURE(ceiling, length, "m", "LENGTH"), REPEATED("ceiling"),
     .quantity = "ceiling over the flash", ABOVE_0,
     .help = "bounce: from the flash up to the ceiling"},
    {MEASURE(ceiling_subject, length, "m", "LENGTH"), .name = "ceiling-subject",
     .quantity = "ceiling over the subject", .column = "ceiling_subject", ABOVE_0,
     .help = "bounce: from the subject up to the ceiling (as --ceiling)"},
    {MEASURE(background, length, "m", "LENGTH"), REPEATED("background"), ABOVE_0,
     .help = "distance from the flash to the background: shows how much darker it gets"},
    OPTION_TIME(time, 0),
    {MEASURE(sync, time, "s", "TIME"), .name = "sync", .quantity = "flash sync time", ABOVE_0,
     .wants = "time", .help = "shortest time with flash; a shorter --time is refused"},
    OPTION_EV(ev, "ambient light as exposure value at ISO 100: balance with --time"),
    {MEASURE(key_to_fill, stops, NULL, "STOPS"), .name = "key-to-fill", .column = "key_to_fill",
     .lowest = -100, .highest = 100,
     .help = "key light above fill light: gives the lighting ratio"},
    {MEASURE(ratio, ratio, NULL, "RATIO"), .name = "ratio", .quantity = "lighting ratio",
     .column = "lighting_ratio", .lowest = 1, .highest = INFINITY,
     .flags = OPTION_ABOVE_LOWEST | OPTION_NO_INFINITY,
     .help = "wanted lighting ratio, lit to shadow side: 3:1"},
    OPTION_SERIES(series),
};

struct flash_row {
    struct flash_setting setting;
    double guide_number; /* of one flash */
    double distance, path, second, background, background_stops;
    struct flash_balance balance;
    double time, ev;
    double key_to_fill, ratio;
    double at;
    const char *nominal_fnumber, *filter, *zoom;
};

#define ROW struct flash_row

static const struct column columns[] = {
    {LENGTH(guide_number, "m"), .name = "guide_number", BRIEF | COLUMN_ECHO,
     .label = "guide number", .help = "at ISO 100, full power, one flash"},
    {LENGTH(at, "mm"), .name = "at", ECHO_WITH("zoom"), .symbol = "z",
     .label = "reflector position", .help = "focal length the reflector is set for"},
    {LENGTH(second, "m"), .name = "second", ECHO_WITH("second"), .symbol = "GN2",
     .label = "guide number of the second flash", .help = "at ISO 100, full power"},
    {LENGTH(setting.GN, "m"), .name = "joint_guide_number", BRIEF_WITH("second"), .symbol = "GN",
     .label = "combined guide number", .help = "what is reckoned with: that of all flashes joined"},
    {SHOWN(setting.N), .name = "fnumber", BRIEF | COLUMN_ECHO, .symbol = "N", .label = "f-number",
     .help = "f-number"},
    COLUMN_NOMINAL_FNUMBER(nominal_fnumber),
    {LENGTH(distance, "m"), .name = "distance", BRIEF, .symbol = "s",
     .help = "distance from the flash to the subject"},
    {LENGTH(path, "m"), .name = "path", BRIEF_WITH("ceiling"), .symbol = "d",
     .label = "path via the ceiling", .help = "length of the bounced light's path"},
    {SHOWN(setting.S), .name = "iso", BRIEF | COLUMN_ECHO, .symbol = "S", .label = "ISO speed",
     .help = "film or sensor speed"},
    {SHOWN(setting.power), .name = "power", BRIEF | COLUMN_PART, .symbol = "power",
     .help = "fraction of full power"},
    {SHOWN(setting.flashes), .name = "flashes", .flags = COLUMN_ECHO, .symbol = "n",
     .help = "number of equal flashes"},
    {STOPS(setting.loss), .name = "loss", .symbol = "loss", .label = "light loss",
     .help = "at the flash and by filters together"},
    {LENGTH(background, "m"), .name = "background", ECHO_WITH("background"), .symbol = "b",
     .help = "from the flash to the background"},
    {STOPS(background_stops), .name = "background_below", BRIEF_WITH("background"), .symbol = "r",
     .label = "background is darker by",
     .help = "stops that the background gets less than the subject"},
    {SHOWN(ev), .name = "ev100", ECHO_WITH("ev"), .symbol = "EV100", .label = "EV at ISO 100",
     .help = "of the other light"},
    {TIME(time), .name = "time", ECHO_WITH("time"), .symbol = "t", .help = "exposure time"},
    {STOPS(balance.flash), .name = "flash", WITH("ev"), .symbol = "F", .label = "flash alone",
     .help = "stops above (+) or below (-) correct"},
    {STOPS(balance.ambient), .name = "ambient", BRIEF_WITH("ev"), .symbol = "A",
     .label = "ambient light alone", .help = "stops above (+) or below (-) correct"},
    {STOPS(balance.total), .name = "total", BRIEF_WITH("ev"), .symbol = "B",
     .label = "total, flash and ambient", .help = "stops above (+) or below (-) correct"},
    {STOPS(balance.flash_to_ambient), .name = "flash_to_ambient", WITH("ev"), .symbol = "D",
     .label = "flash over ambient light", .help = "+ the flash leads, - it fills"},
    {SHOWN(balance.ratio), .name = "balance_ratio", WITH("ev"), .symbol = "R",
     .label = "lit to unlit side", .help = "lit by both over lit by the other light alone"},
    {STOPS(key_to_fill), .name = "key_to_fill", ECHO_WITH("ratio") | COLUMN_BRIEF, .symbol = "k",
     .label = "key above fill", .help = "key light alone over fill light alone"},
    {SHOWN(ratio), .name = "lighting_ratio", BRIEF_WITH("key-to-fill"), .symbol = "q",
     .label = "lighting ratio", .help = "lit to shadow side, as N to 1"},
    {SHOWN(filter), .name = "filter", ASSUMED_BY("filter"), .help = "filters on the lens"},
    {SHOWN(zoom), .name = "zoom", ASSUMED_BY("zoom"), .label = "guide number",
     .help = "how it follows from --zoom"},
};

/* The light's path, over the ceiling if it is bounced. */
static bool find_path(const struct flash_input *input, double *path, struct error *error)
{
    double subject_gap = is_given(input->ceiling_subject) ? input->ceiling_subject : input->ceiling;
    *path = input->distance;
    if (!is_given(input->ceiling)) {
        return !is_given(input->ceiling_subject) ||
               fail(error, ERROR_USAGE, "{--ceiling-subject} needs {--ceiling}");
    }
    if (!is_given(input->distance)) {
        return fail(error, ERROR_USAGE, "{--ceiling} needs {--distance}");
    }
    return flash_bounce(input->distance, input->ceiling, subject_gap, path, error);
}

/* One mark of the reflector, "35mm:36m". */
static bool read_mark(struct text text, struct flash_mark *mark, struct error *error)
{
    const struct unit *metre = unit_find(&dimension_length, text_of("m"));
    struct text guide = text;
    struct text focal = text_cut(&guide, ':');
    if (guide.start == NULL) {
        fail(error, ERROR_USAGE, "{--zoom} '%.*s' has no guide number", text_shown(text),
             text.start);
        return error_hint(error, "write focal length and guide number: 35mm:36m,105mm:58m");
    }
    return (quantity_read(focal, &dimension_length, NULL, &mark->f, NULL, error) &&
            quantity_read(guide, &dimension_length, metre, &mark->GN, NULL, error)) ||
           error_prefix(error, "bad value in {--zoom}: ");
}

/* The guide number at --at, and how it was found. */
static bool zoomed_guide_number(const struct flash_input *input, struct run *run, double *GN,
                                const char **words, struct error *error)
{
    enum { MOST_MARKS = 32 };
    struct flash_mark marks[MOST_MARKS];
    int count = 0;
    struct text rest = text_of(input->zoom);
    while (rest.start != NULL) {
        if (count == MOST_MARKS) {
            return fail(error, ERROR_USAGE, "{--zoom} has more than %d marks", (int)MOST_MARKS);
        }
        if (!read_mark(text_trim(text_cut(&rest, ',')), &marks[count++], error)) {
            return false;
        }
    }
    if (!flash_zoomed(marks, count, input->at, GN, error)) {
        return false;
    }
    bool is_mark = false;
    for (int i = 0; i < count; i++) {
        is_mark = is_mark || !(fabs(marks[i].f - input->at) > 0);
    }
    *words = arena_printf(run->arena,
                          is_mark ? "as marked at %.6g mm" : "interpolated in stops to %.6g mm",
                          input->at);
    return true;
}

/* Two flashes beside each other are one of their joint guide number. */
static bool flash_join(const struct flash_input *input, double one, double *joint,
                       struct error *error)
{
    const double both[] = {one, input->second};
    *joint = one;
    return !is_given(input->second) || flash_sum(both, 2, joint, error);
}

static bool flash_row_solve(const struct flash_input *input, double one, struct flash_row *row,
                            struct error *error)
{
    enum flash_unknown unknown;
    struct flash_setting *setting = &row->setting;
    *setting = (struct flash_setting){.N = input->fnumber,
                                      .S = input->iso,
                                      .power = input->power,
                                      .flashes = input->flashes,
                                      .loss = input->loss.stops + input->filter.stops};
    if (!find_path(input, &row->path, error) || !flash_join(input, one, &setting->GN, error)) {
        return false;
    }
    setting->d = row->path;
    /* beside other light a flash of given power may expose too much or little: nothing is solved */
    if (is_given(input->ev) && is_given(setting->GN) && is_given(setting->N) &&
        is_given(setting->d) && is_given(setting->power)) {
        setting->S = is_given(setting->S) ? setting->S : 100;
        setting->flashes = is_given(setting->flashes) ? setting->flashes : 1;
    } else if (!flash_solve(setting, &unknown, error)) {
        return false;
    }
    row->guide_number = is_given(input->second) ? one : setting->GN;
    row->path = setting->d;
    row->distance = is_given(input->distance) ? input->distance : setting->d;
    return true;
}

static bool fill_ratio(const struct flash_input *input, struct flash_row *row, struct error *error)
{
    row->key_to_fill = input->key_to_fill;
    row->ratio = input->ratio;
    if (is_given(input->ratio) && is_given(input->key_to_fill)) {
        return fail(error, ERROR_USAGE, "give only one of {--key-to-fill} and {--ratio}");
    }
    if (is_given(input->ratio)) {
        return lighting_stops(input->ratio, &row->key_to_fill, error);
    }
    return !is_given(input->key_to_fill) || lighting_ratio(input->key_to_fill, &row->ratio, error);
}

static bool flash_run(const void *data, struct run *run, struct error *error)
{
    const struct flash_input *input = data;
    struct flash_row row = {.setting = {NAN, NAN, NAN, NAN, NAN, NAN, NAN},
                            .distance = NAN,
                            .path = NAN,
                            .guide_number = NAN,
                            .second = input->second,
                            .background = NAN,
                            .background_stops = NAN,
                            .balance = {NAN, NAN, NAN, NAN, NAN},
                            .time = NAN,
                            .ev = NAN,
                            .at = input->at,
                            .filter = input->filter.name};
    double one = input->guide_number;
    if ((input->zoom != NULL && !zoomed_guide_number(input, run, &one, &row.zoom, error)) ||
        !fill_ratio(input, &row, error)) {
        return false;
    }
    /* A lighting ratio may be asked for by itself. */
    bool ratio = is_given(input->ratio) || is_given(input->key_to_fill);
    const bool flashes = is_given(input->guide_number) || input->zoom != NULL ||
                         is_given(input->fnumber) || is_given(input->distance);
    if (!ratio || flashes) {
        row.background = input->background;
        row.time = input->time;
        row.ev = input->ev;
        if (!flash_row_solve(input, one, &row, error) ||
            (is_given(row.background) &&
             !flash_falloff(row.path, row.background, &row.background_stops, error))) {
            return false;
        }
        /* a filter takes from flash and other light, and is in the flash's loss already */
        const struct flash_ambient light = {row.setting, row.time, input->sync,
                                            row.ev - input->filter.stops};
        if (is_given(row.ev) && !flash_against_ambient(&light, &row.balance, error)) {
            return false;
        }
    }
    const struct series_value *series = &input->series;
    row.nominal_fnumber =
        stop_label(series->fnumbers, rint(2 * log2(row.setting.N) * series->per_stop));
    run_emit(run, &row);
    return true;
}

static const struct explanation explanations[] = {
    {"guide_number", "GN = {N} {d}/sqrt({n} {S}/100 {power} 2^-{loss})",
     "[IsoFlash07]; the same equation gives N, d, S, the power or the number of flashes",
     "a point source in a normal room; outdoors 0.5 to 1 stop less"},
    {"path", "d = sqrt({s}^2 + (up + down)^2)", "mirror image of the flash in the ceiling",
     "a white ceiling scatters: add its --loss"},
    {"background_below", "r = 2 log2({b}/{d})", "inverse square law", NULL},
    {"flash", "F = 2 log2({GN} sqrt({n} {S}/100 {power} 2^-{loss})/({N} {d}))", "[IsoFlash07]",
     NULL},
    {"ambient", "A = {EV100} + log2({S}/100) - log2({N}^2/{t})",
     "[Apex60]; less what the lens's filter takes", NULL},
    {"total", "B = log2(2^{F} + 2^{A})", "light adds", NULL},
    {"lighting_ratio", "q = 2^{k} + 1", "(key + fill)/fill, as cinematographers count it",
     "others print key to fill, one less"},
    {NULL, NULL, NULL, NULL},
};

static const struct example examples[] = {
    {"flash --guide-number 36m -s 4.5m", "the f-number for a flash"},
    {"flash -g 36 -N 8 -s 1m", "the power to set"},
    {"flash --zoom 35mm:36m,105mm:58m --at 70mm -s 6m", "a reflector that zooms"},
    {"flash -g 118ft -N 2.8..16 --iso 100,200,400,800 --table N,iso:distance",
     "how far it reaches"},
    {"flash -g 43 -N 4 --ceiling 1.5m -s 3m --loss 1.5stops", "bounced off the ceiling"},
    {"flash -g 36 -N 8 -s 4.5m --ev 12 -t 1/125 --sync 1/200", "mixed with daylight"},
    {"flash --ratio 3:1", "key and fill for a lighting ratio"},
    {NULL, NULL},
};

const struct command command_flash = {
    .name = "flash",
    .no_operand = "flashes have no names here: the guide number of the manual, at ISO 100, is "
                  "--guide-number 38m",
    COMMAND_OF("photography", "guide number, f-number, distance and power of flashes"),
    .run = flash_run,
    .plot = "distance_m|fnumber",
    .plot_titles = "Flash range|Aperture for a flash",
    .cell = "fnumber",
};
