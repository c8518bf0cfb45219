/* commands/photo/cmd_bracket.c - lenscalc bracket: a series of exposure times. */
/* SPDX-License-Identifier: MIT */
#include "cli/question/command.h"
#include "commands/photo/photo_options.h"
#include "commands/tables.h"
#include "photo/bracket.h"
#include "photo/given.h"

#include <math.h>

struct bracket_input {
    struct bracket_given given;
    double time, scene_range, range;
    struct series_value series;
};

#define INPUT struct bracket_input

static const struct option options[] = {
    {MEASURE(given.from, time, "s", "TIME"), .name = "from", .quantity = "time at one end", ABOVE_0,
     .help = "time at one end: 30s"},
    {MEASURE(given.to, time, "s", "TIME"), .name = "to", .quantity = "time at the other end",
     ABOVE_0, .help = "time at the other end: 1/1000s"},
    OPTION_TIME(time, 0),
    {MEASURE(given.step, stops, NULL, "STOPS"), REPEATED("step"), ABOVE_0,
     .help = "stops between shots (1 unless --shots divides the span)"},
    {MEASURE(given.shots, number, NULL, "N"), REPEATED("shots"), .quantity = "number of shots",
     .lowest = 1, .highest = BRACKET_SHOTS, .help = "number of shots"},
    {MEASURE(range, stops, NULL, "STOPS"), REPEATED("range"), .quantity = "range of a shot",
     ABOVE_0, .help = "dynamic range of one shot: shows what the bracket covers"},
    {MEASURE(scene_range, stops, NULL, "STOPS"), .name = "scene-range", .column = "scene_range",
     ABOVE_0, .help = "dynamic range of the scene: with --range gives the number of shots"},
    OPTION_SERIES(series),
};

struct bracket_row {
    long shot, shots;
    double time, offset, elapsed, step, span, residual, total, covered, overlap;
    const char *nominal_time;
};

#define ROW struct bracket_row

static const struct column columns[] = {
    {SHOWN(shot), .name = "shot", BRIEF, .help = "number of the shot, the longest first"},
    {TIME(time), .name = "time", BRIEF, .symbol = "t",
     .help = "exposure time, an exact step from the longest"},
    COLUMN_NOMINAL_TIME(nominal_time),
    {STOPS(offset), .name = "offset", BRIEF, .symbol = "d",
     .help = "stops above (+) or below (-) the middle given by --time, else the longest shot"},
    {TIME(elapsed), .name = "elapsed", BRIEF | COLUMN_SPAN,
     .help = "exposure times so far, this one included"},
    {SHOWN(shots), .name = "shots", .symbol = "n", .help = "number of shots"},
    {STOPS(step), .name = "step", .symbol = "step", .help = "stops between two shots"},
    {STOPS(span), .name = "span", .symbol = "span", .help = "stops from first to last shot"},
    {STOPS(residual), .name = "residual", .symbol = "r", .label = "residual of the last shot",
     .help = "stops by which the last shot exposes more (+) or less (-) than the end asked for"},
    {TIME(total), .name = "total", .flags = COLUMN_SPAN, .symbol = "total", .label = "total time",
     .help = "sum of all times"},
    {STOPS(covered), .name = "covered", BRIEF_WITH("range"), .symbol = "covered",
     .help = "contrast of the scene that is recorded"},
    {STOPS(overlap), .name = "overlap", WITH("range"), .symbol = "overlap",
     .help = "shared by neighbours; below 0: a gap"},
};

/* The number of shots that the scene's contrast asks for. */
static bool count_shots(const struct bracket_input *input, struct bracket_given *given,
                        struct error *error)
{
    int shots = 0;
    if (!is_given(input->scene_range)) {
        return true;
    }
    if (is_given(given->shots) || (is_given(given->from) && is_given(given->to))) {
        return fail(error, ERROR_USAGE,
                    "{--scene-range} counts the shots: leave out {--shots}, and "
                    "one of {--from} and {--to}");
    }
    given->step = is_given(given->step) ? given->step : 1;
    if (!bracket_shots_needed(input->scene_range, input->range, given->step, &shots, error)) {
        return false;
    }
    given->shots = shots;
    return true;
}

static bool make_plan(const struct bracket_input *input, struct bracket *plan, struct error *error)
{
    struct bracket_given given = input->given;
    if (!count_shots(input, &given, error)) {
        return false;
    }
    bool ends = is_given(given.from) && is_given(given.to);
    if (!is_given(given.step) && !(ends && is_given(given.shots))) {
        given.step = 1;
    }
    if (!is_given(input->time) && !is_given(given.from) && !is_given(given.to)) {
        return fail(error, ERROR_USAGE,
                    "a bracket needs an exposure to start from: give {--time}, its middle, or "
                    "{--from} or {--to}, its ends");
    }
    if (!is_given(input->time)) {
        /* From one end alone there is no telling how far. */
        bool from = is_given(given.from), to = is_given(given.to);
        if (from != to && !is_given(given.shots)) {
            return fail(error, ERROR_USAGE, "{--%s} needs {--%s} too, or {--shots}",
                        from ? "from" : "to", from ? "to" : "from");
        }
        return bracket_plan(&given, plan, error);
    }
    if (is_given(given.from) || is_given(given.to) || !is_given(given.shots)) {
        return fail(error, ERROR_USAGE,
                    "{--time} is the middle of a bracket: it works with {--shots}, "
                    "without {--from} and {--to}");
    }
    return bracket_around(input->time, given.step, given.shots, plan, error);
}

static bool bracket_run(const void *data, struct run *run, struct error *error)
{
    const struct bracket_input *input = data;
    const struct series_value *series = &input->series;
    struct bracket plan;
    struct bracket_range range = {NAN, NAN};
    if (!make_plan(input, &plan, error) ||
        (is_given(input->range) && !bracket_covers(&plan, input->range, &range, error))) {
        return false;
    }
    struct bracket_row row = {.shots = plan.shots,
                              .step = plan.step,
                              .span = plan.span,
                              .residual = plan.residual,
                              .total = plan.total,
                              .covered = range.covered,
                              .overlap = range.overlap};
    double base = is_given(input->time) ? input->time : plan.longest;
    for (int i = 0; i < plan.shots; i++) {
        row.shot = i + 1;
        row.time = bracket_time(&plan, i);
        row.offset = bracket_offset(&plan, i, base);
        row.elapsed += row.time;
        row.nominal_time = stop_label(series->times, rint(-log2(row.time) * series->per_stop));
        if (!run_emit(run, &row)) {
            break;
        }
    }
    return true;
}

static const struct explanation explanations[] = {
    {"shots", "n = round({span}/{step}) + 1",
     "definition; the span is |log2(from/to)| rounded to whole steps", NULL},
    {"time", "t = longest 2^-(i {step})", "[Apex60]: a stop is a factor of two in time",
     "a camera's 30 s is 32 s and its 1/1000 s is 1/1024 s: say --nominal for them"},
    {"covered", "covered = range + {span}", "each shot moves the same window by one step",
     "without gaps as long as the overlap is not below 0"},
    {"total", "total = longest (1 - 2^-({n} {step}))/(1 - 2^-{step})", "geometric series", NULL},
    {NULL, NULL, NULL, NULL},
};

static const struct example examples[] = {
    {"bracket --from 30s --to 1/1000s", "sixteen shots for a high dynamic range"},
    {"bracket -t 1/60 --shots 5 --step 2/3", "around a metered time"},
    {"bracket -t 1/60 --scene-range 18 --range 10 --step 2", "as many as the scene needs"},
    {"bracket --from 30s --to 1/1000s --nominal", "with the exact times of the camera"},
    {NULL, NULL},
};

const struct command command_bracket = {
    .name = "bracket",
    COMMAND_OF("photography", "plan of an exposure bracket for high dynamic range"),
    .run = bracket_run,
    .makes_many = command_always_many,
};
