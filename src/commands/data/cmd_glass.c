/* commands/data/cmd_glass.c - lenscalc glass: indices of glasses, and glasses by their indices. */
/* SPDX-License-Identifier: MIT */
#include "cli/question/command.h"
#include "commands/data/glass_search.h"
#include "commands/tables.h"
#include "data/lines.h"
#include "optics/air.h"
#include "optics/wavelength.h"

#include <math.h>

#define INPUT struct glass_input

static const struct option options[] = {
    {ASKED(glass), REPEATED("glass"), .value = "NAME", .flags = OPTION_OPERAND | OPTION_CURRENT,
     .help = "NAME or CATALOG:NAME, or nd/Vd, or a number; without it all glasses are searched"},
    {MEASURE(wavelength, wavelength, "nm", "LENGTH"), REPEATED("wavelength"), .letter = 'w',
     ABOVE_0,
     .help = "wavelength, or a line by name (d F C e g ..); otherwise d, F and C, in a search d"},
    {MEASURE(thickness, length, "mm", "LENGTH"), REPEATED("thickness"), FROM_0,
     .help = "thickness for the internal transmittance"},
    {MEASURE(temperature, temperature, "C", "DEGREES"), REPEATED("temperature"), .lowest = -100,
     .highest = 140, .help = "temperature of glass and air; otherwise that of the catalogue"},
    {MEASURE(pressure, pressure, "hPa", "PRESSURE"), REPEATED("pressure"), .lowest = 0,
     .highest = 1e6, .help = "pressure of the air, 0 for vacuum; otherwise 1013.25 hPa"},
    {ASKED(air), .name = "air", .words = air_models, .fallback = "edlen", .value = "MODEL",
     .wants = "temperature|pressure", .help = "formula for air, with --temperature or --pressure"},
    {ASKED(nd), .name = "nd", .lowest = 1, .highest = 5, .value = "NUMBER",
     .help = "search by index at the d line: the nearest, or LOW..HIGH"},
    {ASKED(Vd), .name = "vd", .lowest = 1, .highest = 1000, .value = "NUMBER",
     .help = "search by Abbe number: the nearest, or LOW..HIGH"},
    {ASKED(PgF), .name = "pgf", .column = "pgf_wanted", .value = "LOW..HIGH",
     .help = "search by partial dispersion (ng - nF)/(nF - nC)"},
    {ASKED(catalog), .name = "catalog", .value = "NAME", .help = "search in one catalogue"},
    {ASKED(status), .name = "status", .value = "WORD",
     .help = "search by status: current, obsolete, .."},
    {ASKED(like), .name = "like", .value = "NAME", .flags = OPTION_CURRENT,
     .help = "the nearest equivalents of this glass in g F e d C, nearest first"},
    {MEASURE(count, number, NULL, "NUMBER"), .name = "count", .lowest = 1, .highest = 1000,
     .wants = "like|nd|vd",
     .help = "number of nearest glasses, with --like or a single --nd or --vd (10)"},
    {ASKED(label), .name = "label", .value = "NAMES", .wants = "abbe",
     .help = "glasses to emphasise in the Abbe diagram, separated by commas"},
};

struct glass_command_row {
    const char *glass, *catalog, *line, *status, *source, *licence, *formula, *relative_to;
    const char *taken_as, *warning;
    double wavelength, thickness, temperature, pressure;
    double n, slope, group, dn_dT, transmittance, difference;
    double nd_wanted, Vd_wanted, nd_difference, Vd_difference, distance;
    struct glass_summary summary;
    double from, to, density, price, expansion;
};

#define ROW struct glass_command_row

static const struct column columns[] = {
    {SHOWN(glass), .name = "glass", BRIEF, .help = "name, as the catalogue spells it"},
    {LENGTH(wavelength, "nm"), .name = "wavelength", BRIEF | COLUMN_ECHO, .symbol = "l",
     .with = "wavelength", .help = "wavelength in air at the catalogue's temperature"},
    {SHOWN(n), .name = "index", BRIEF, .digits = 7, .symbol = "n", .help = "refractive index"},
    {SHOWN(line), .name = "line", BRIEF, .help = "name of the spectral line of this wavelength"},
    {SHOWN(slope), .name = "dn_dl_per_um", .label = "dn/dl, 1/um",
     .help = "slope of the index over the wavelength in um"},
    {SHOWN(group), .name = "group_index", .digits = 7, .label = "group index",
     .help = "n - l dn/dl"},
    {SHOWN(dn_dT), .name = "dn_dt_vacuum_per_k", .label = "dn/dT in vacuum, 1/K",
     .help = "change of the index in vacuum with the temperature"},
    {SHOWN(transmittance), .name = "transmittance", .with = "thickness",
     .label = "internal transmittance", .help = "of --thickness, without reflection"},
    {SHOWN(difference), .name = "difference", BRIEF_WITH("like"),
     .help = "from --like, rms of the index in g F e d C"},
    {SHOWN(nd_wanted), .name = "nd_wanted", ECHO_WITH("nd") | COLUMN_HIDDEN, .symbol = "nd0",
     .label = "wanted nd", .help = "nd to be near to"},
    {SHOWN(Vd_wanted), .name = "vd_wanted", ECHO_WITH("vd") | COLUMN_HIDDEN, .symbol = "Vd0",
     .label = "wanted Vd", .help = "Abbe number to be near to"},
    {SHOWN(distance), .name = "distance", BRIEF_WITH("nd vd"), .symbol = "D",
     .help = "from a single --nd and --vd, in standard tolerances: 0.0005 and 0.8 %"},
    {SHOWN(nd_difference), .name = "nd_difference", BRIEF_WITH("nd"), .label = "nd - wanted",
     .help = "nd minus a single --nd"},
    {SHOWN(Vd_difference), .name = "vd_difference", BRIEF_WITH("vd"), .label = "Vd - wanted",
     .help = "Abbe number minus a single --vd"},
    {SHOWN(summary.nd), .name = "nd", BRIEF, .digits = 7, .symbol = "nd",
     .help = "index at the d line"},
    {SHOWN(summary.Vd), .name = "vd", BRIEF, .symbol = "Vd", .label = "Vd", .help = "Abbe number"},
    {SHOWN(summary.ne), .name = "ne", .digits = 7, .symbol = "ne", .help = "index at the e line"},
    {SHOWN(summary.Ve), .name = "ve", .label = "Ve", .help = "(ne - 1)/(nF' - nC')"},
    {SHOWN(summary.PgF), .name = "pgf", .symbol = "PgF", .label = "PgF",
     .help = "partial dispersion (ng - nF)/(nF - nC)"},
    {SHOWN(summary.PdC), .name = "pdc", .label = "PdC",
     .help = "partial dispersion (nd - nC)/(nF - nC)"},
    {SHOWN(summary.deviation), .name = "dpgf", .label = "PgF off the normal line",
     .help = "PgF - (0.6438 - 0.001682 Vd)"},
    {LENGTH(from, "nm"), .name = "from", .flags = COLUMN_ECHO,
     .help = "shortest wavelength of the formula"},
    {LENGTH(to, "nm"), .name = "to", .flags = COLUMN_ECHO,
     .help = "longest wavelength of the formula"},
    {SHOWN(density), .name = "density_g_cm3", .flags = COLUMN_ECHO, .label = "density, g/cm3",
     .help = "density"},
    {SHOWN(price), .name = "relative_price", .flags = COLUMN_HIDDEN, .label = "relative price",
     .help = "of a mass of it, as its catalogue has it beside a usual crown"},
    {SHOWN(expansion), .name = "expansion_1e6_k", .flags = COLUMN_ECHO,
     .label = "expansion, 1e-6/K", .help = "linear thermal expansion from -30 to 70 C"},
    {SHOWN(catalog), .name = "catalog", BRIEF, .label = "catalogue", .help = "maker's catalogue"},
    {SHOWN(status), .name = "status", BRIEF, .help = "current, obsolete, or as the source says"},
    {SHOWN(formula), .name = "formula", .help = "form of the dispersion"},
    {SHOWN(source), .name = "source", .help = "where the data are from"},
    {SHOWN(licence), .name = "licence", .flags = COLUMN_HIDDEN,
     .help = "CC0, or facts (published constants)"},
    {LENGTH(thickness, "mm"), .name = "thickness", ECHO_WITH("thickness"),
     .help = "for the transmittance"},
    {MEASURED(temperature, temperature, "C"), .name = "temperature", ECHO_WITH("temperature"),
     .help = "of glass and air"},
    {MEASURED(pressure, pressure, "hPa"), .name = "pressure", ECHO_WITH("pressure"),
     .help = "of the air"},
    {SHOWN(relative_to), .name = "index_relative_to", ASSUMED_BY("temperature pressure air"),
     .label = "index relative to", .help = "what the index is relative to"},
    {SHOWN(taken_as), .name = "taken_as", .flags = COLUMN_NOTE | COLUMN_SPARSE, .label = "taken as",
     .help = "which glass it is, where the name is another program's or that of several glasses"},
    {SHOWN(warning), .name = "warning", .flags = COLUMN_NOTE | COLUMN_SPARSE,
     .help = "what is doubtful in the data, with file and line"},
};

/* A text that lives as long as the row; null where it is empty. */
static const char *glass_string(struct arena *arena, struct text text)
{
    return text.length == 0 ? NULL : arena_string(arena, text.start, text.length);
}

/* What was asked, at work. */
struct question {
    const struct glass_input *input;
    struct run *run;
    double wavelength; /* mm, of what follows, found once for all rows */
    struct pair um;    /* as the decimal that was typed */
    const char *line;  /* the name of the spectral line */
};

/* Index and slope at the row's wavelength, in the state of air that is asked for. */
static bool glass_set_index(const struct question *question, const struct glass *glass,
                            struct glass_command_row *row, struct error *error)
{
    const struct glass_input *input = question->input;
    double um = question->um.hi;
    struct glass_index index = glass_index(glass, question->um);
    const struct glass_thermal *thermal = &glass->thermal;
    row->n = index.n.hi;
    row->slope = index.slope;
    row->dn_dT = glass_dn_dT(glass, um, thermal->reference);
    row->relative_to = "air at the catalogue's temperature and 1013.25 hPa";
    if (!isnan(input->temperature) || !isnan(input->pressure)) {
        const struct air air = {
            (enum air_model)input->air,
            !isnan(input->temperature) ? input->temperature : thermal->reference,
            !isnan(input->pressure) ? input->pressure : AIR_STANDARD_PRESSURE,
        };
        struct glass_state state;
        if (!glass_in_air(glass, um, &air, &state, error)) {
            return false;
        }
        row->n = state.n;
        row->slope = state.slope;
        row->dn_dT = state.dn_dT;
        row->temperature = air.temperature;
        row->pressure = air.pressure;
        row->relative_to = air.pressure > 0 ? air_models[input->air].help : "vacuum";
    }
    row->group = row->n - um * row->slope;
    return true;
}

/* One row: a glass at a wavelength (mm). */
static bool glass_fill_row(struct question *question, const struct glass_record *record,
                           const struct glass_summary *summary, double wavelength,
                           struct glass_command_row *row, struct error *error)
{
    const struct glass_input *input = question->input;
    struct arena *arena = question->run->arena;
    const struct glass *glass = &record->glass;
    const struct glass_record *asked =
        input->glass.record != NULL ? input->glass.record : input->like.record;
    if (!(fabs(wavelength - question->wavelength) <= 0)) {
        question->wavelength = wavelength;
        /* The wavelength as the decimal that was typed, um: its rounding shows near a resonance. */
        char text[NUMBER_LENGTH];
        const struct unit *nm = unit_find(&dimension_length, text_of("nm"));
        struct pair typed = pair_of(1e6 * wavelength);
        pair_read(text, quantity_write(text, wavelength, nm), NUMBER_UNSCALED, &typed);
        question->um = pair_divide(typed, pair_of(1000));
        question->line = glass_string(arena, lines_name(question->run->db, wavelength));
    }
    *row = (struct glass_command_row){
        .wavelength = wavelength,
        .line = question->line,
        .taken_as = asked != NULL ? asked->taken_as : NULL,
        .glass = glass_string(arena, glass->name),
        .catalog = glass_string(arena, glass->catalog),
        .status = glass_string(arena, record->status),
        .source = glass_string(arena, record->source),
        .licence = glass_string(arena, record->licence),
        .warning = record->warning,
        .formula = glass_formula_name(glass->formula),
        .from = glass->shortest / 1000,
        .to = glass->longest / 1000,
        .density = record->density,
        .price = record->price,
        .expansion = record->expansion,
        .thickness = input->thickness,
        .temperature = input->temperature,
        .pressure = input->pressure,
        .n = NAN,
        .slope = NAN,
        .group = NAN,
        .dn_dT = NAN,
        .transmittance = NAN,
        .difference = NAN,
        .nd_wanted = input->nd.near,
        .Vd_wanted = input->Vd.near,
        .nd_difference = summary->nd - input->nd.near,
        .Vd_difference = summary->Vd - input->Vd.near,
        .distance = NAN,
        .summary = *summary,
    };
    if (!glass_check_range(glass, question->um.hi, error) ||
        !glass_set_index(question, glass, row, error)) {
        return false;
    }
    if (!isnan(input->thickness)) {
        row->transmittance = glass_transmittance(glass, question->um.hi, input->thickness);
    }
    return true;
}

/* A glass that was asked for by name has to have an index. */
static bool show_named(struct question *question, struct error *error)
{
    const double lines[] = {wavelength_millimetres(WAVELENGTH_D),
                            wavelength_millimetres(WAVELENGTH_F),
                            wavelength_millimetres(WAVELENGTH_C)};
    const struct glass_input *input = question->input;
    const struct glass_record *record = input->glass.record;
    struct glass_summary summary = glass_summary(&record->glass);
    bool given = !isnan(input->wavelength);
    for (size_t i = 0; i < (given ? 1 : 3); i++) {
        struct glass_command_row row;
        if (!glass_fill_row(question, record, &summary, given ? input->wavelength : lines[i], &row,
                            error)) {
            return false;
        }
        if (!run_emit(question->run, &row)) {
            break;
        }
    }
    return true;
}

/* A glass that was found; it may have no index at this wavelength, or no known dn/dT. */
static bool glass_show_found(const struct glass_match *match, void *context)
{
    struct question *question = context;
    const struct glass_input *input = question->input;
    double wavelength =
        !isnan(input->wavelength) ? input->wavelength : wavelength_millimetres(WAVELENGTH_D);
    struct glass_command_row row;
    struct error no_index;
    if (!glass_fill_row(question, &match->record, &match->summary, wavelength, &row, &no_index)) {
        row.n = row.slope = row.group = row.dn_dT = NAN;
    }
    if (input->like.record != NULL) {
        row.difference = match->away;
    } else {
        row.distance = match->away;
    }
    return run_emit(question->run, &row);
}

static bool is_interval(struct interval_value interval)
{
    return !isnan(interval.low) || !isnan(interval.high) || !isnan(interval.near);
}

static bool glass_run(const void *data, struct run *run, struct error *error)
{
    const struct glass_input *input = data;
    struct question question = {.input = input, .run = run, .wavelength = NAN};
    const char *option =
        SAID_FIRST({is_interval(input->nd), "nd"}, {is_interval(input->Vd), "vd"},
                   {is_interval(input->PgF), "pgf"}, {input->catalog != NULL, "catalog"},
                   {input->status != NULL, "status"}, {input->like.record != NULL, "like"});
    if (input->glass.record != NULL && option != NULL) {
        return fail(error, ERROR_USAGE,
                    "{--%s} searches all glasses: it cannot be combined with a name", option);
    }
    if (input->glass.record != NULL) {
        return show_named(&question, error);
    }
    if (input->like.record != NULL && (!isnan(input->nd.near) || !isnan(input->Vd.near))) {
        fail(error, ERROR_USAGE, "{--like} and a single {--%s} both say what is nearest",
             !isnan(input->nd.near) ? "nd" : "vd");
        return error_hint(error, "with {--like} give LOW..HIGH");
    }
    if (input->count > 0 && input->like.record == NULL && isnan(input->nd.near) &&
        isnan(input->Vd.near)) {
        return fail(error, ERROR_USAGE,
                    "{--count} is of the nearest glasses: it needs {--like}, or a single {--nd} or "
                    "{--vd}");
    }
    return glass_search(input, run->db, run->arena, glass_show_found, &question, error);
}

/* A glass that is named is none that was found. */
static bool check_diagram(const struct artifact_job *job, struct error *error)
{
    const struct glass_input *input = job->inputs[0];
    if (input->glass.record == NULL) {
        return true;
    }
    fail(error, ERROR_USAGE, "{--abbe} searches all glasses: it cannot be combined with a name");
    return error_hint(error, "{--label} %s shows it", input->glass.name);
}

static bool draw_diagram(const struct artifact_job *job, struct output *sink, struct error *error)
{
    const struct glass_input *input = job->inputs[0];
    struct svg svg = {.arena = job->run->arena};
    return glass_diagram(input, job->run->db, &svg, error) && drawing_write(job, &svg, sink, error);
}

static const struct artifact artifacts[] = {
    {ARTIFACT_OPTION("abbe", drawing_types, "draw the Abbe diagram of the glasses that are found"),
     .scope = ARTIFACT_OF_ANSWER, .check = check_diagram, .make = draw_diagram},
};

static bool glass_makes_many(const void *data)
{
    const struct glass_input *input = data;
    return input->glass.record == NULL || isnan(input->wavelength);
}

static const struct explanation explanations[] = {
    {"index", "{n} at {l}, by the catalogue's formula",
     "[Schott16]; coefficients and source in the row",
     "from the shortest to the longest wavelength of the formula"},
    {"vd", "Vd = ({nd} - 1)/(nF - nC)", "[Schott16]", NULL},
    {"pgf", "PgF = (ng - nF)/(nF - nC)", "[Schott16]", NULL},
    {"distance", "{D} = sqrt((({nd} - {nd0})/0.0005)^2 + (({Vd} - {Vd0})/(0.008 {Vd0}))^2)",
     "in the makers' standard tolerances; one term where one of the two is wanted",
     "a ranking: no measure of how a lens would change"},
    {"transmittance", "tau = tau10^(d/10 mm), tau10 linear between the catalogue's points",
     "Beer and Lambert", "inside of the glass only; no reflection"},
    {NULL, NULL, NULL, NULL},
};

static const struct example examples[] = {
    {"glass N-BK7", "index at d, F and C, and what is known of it"},
    {"glass n-bk7,n-sf6 -w d,F,0.55um", "lines by name and wavelengths"},
    {"glass N-BK7 -w 400..700:50", "over the spectrum"},
    {"glass --nd 1.5..1.52 --vd 60..70 --status current", "search by index and Abbe number"},
    {"glass --nd 1.517 --vd 64", "what is nearest to both"},
    {"glass --like N-BK7", "the nearest equivalents of other makers"},
    {"glass N-BK7 -w d --temperature 60 --pressure 0", "warm, in vacuum"},
    {"glass --catalog SCHOTT --status current --abbe abbe.svg", "the Abbe diagram"},
    {NULL, NULL},
};

const struct command command_glass = {
    .name = "glass",
    .group = "data",
    .summary = "indices of optical glasses, and glasses by their indices",
    COMMAND_ASKS(struct glass_input),
    COMMAND_ANSWERS(struct glass_command_row),
    .run = glass_run,
    COMMAND_MAKES(artifacts),
    .makes_many = glass_makes_many,
    .plot = "index",
    .plot_titles = "Refractive index",
    .cell = "index",
};
