/* commands/analysis/cmd_color.c - lenscalc color: what wavelengths do to focus and image. */
/* SPDX-License-Identifier: MIT */
#include "commands/analysis/analysis_fields.h"
#include "commands/analysis/color_case.h"
#include "commands/analysis/color_view.h"

static const struct word shows[] = {
    [COLOR_BY_WAVELENGTH] = {"wavelength", "axial and lateral colour of each wavelength"},
    [COLOR_BY_ZONE] = {"zone", "the focus of real rays by zone: spherochromatism"},
    [COLOR_BY_FIELD] = {"field", "lateral colour from the axis to the edge of the field"},
    {NULL, NULL},
};

/* Zones are of the axis, where their rays cross it; a plot has fields too. */
#define FOR_FIELDS "show!=zone|plot"

static const struct option options[] = {
    ANALYSIS_OPTIONS_FOR(struct color_input, question, "all of the lens", "", FOR_FIELDS),
    ANALYSIS_EDGE_OPTIONS(struct color_input, question, FOR_FIELDS),
    ANALYSIS_REAL(struct color_input, question),
    ANALYSIS_SPECTRUM_OPTION(struct color_input, question),
    {OPTION(struct color_input, show), .name = "show", .words = shows, .fallback = "wavelength",
     .value = "WHAT", .help = "what each row stands for"},
    {OPTION(struct color_input, steps), .name = "steps", .lowest = 1, .highest = 1000,
     .fallback = "10", .value = "COUNT", .wants = "show=zone|show=field",
     .help = "number of steps of zones or fields"},
    {OPTION(struct color_input, question.aim), .name = "aim", .words = analysis_aims,
     .fallback = "stop", .value = "WHERE", .wants = "show=zone",
     .help = "pupil that the zones lie in"},
};

struct color_row {
    struct analysis_point point;
    double zone;
    double axial, vergence; /* mm; 1/mm */
    double lateral, angle;  /* mm; rad */
    double chief_x, chief_y;
    double primary, secondary;
    const char *status, *summary;
};

#define PLACE(member_name, more)                                                                   \
    COLUMN(struct color_row, member_name), .dimension = &dimension_length, .unit = "mm",           \
                                           .flags = (more)
#define AXIAL_COLUMNS                                                                              \
    {PLACE(axial, COLUMN_BRIEF | COLUMN_SPARSE), .name = "axial", .label = "axial shift",          \
     .help = "of the focus from the paraxial one of the primary wavelength, with the light; "      \
             "absent if afocal"},                                                                  \
    {                                                                                              \
        COLUMN(struct color_row, vergence),                                                        \
            .name = "axial", .dimension = &dimension_vergence, .unit = "per_m",                    \
            .flags = COLUMN_BRIEF | COLUMN_SPARSE, .label = "axial shift",                         \
            .help = "of an afocal lens: vergence behind the last "                                 \
                    "vertex less that of the primary wavelength"                                   \
    }
#define LATERAL_COLUMNS                                                                            \
    {COLUMN(struct color_row, lateral),                                                            \
     .name = "lateral",                                                                            \
     .dimension = &dimension_length,                                                               \
     .unit = "um",                                                                                 \
     .flags = COLUMN_BRIEF | COLUMN_SPARSE,                                                        \
     .label = "lateral shift",                                                                     \
     .help = "of the chief ray on the image plane from that of the primary wavelength, upwards"},  \
        {COLUMN(struct color_row, angle),                                                          \
         .name = "lateral",                                                                        \
         .dimension = &dimension_angle,                                                            \
         .unit = "mrad",                                                                           \
         .flags = COLUMN_BRIEF | COLUMN_SPARSE,                                                    \
         .label = "lateral shift",                                                                 \
         .help = "the same of an image at infinity, as an angle"},                                 \
        {PLACE(chief_x, COLUMN_HIDDEN), .name = "chief_x", .label = "chief ray x",                 \
         .help = "where the chief ray meets the image plane"},                                     \
    {                                                                                              \
        PLACE(chief_y, COLUMN_HIDDEN), .name = "chief_y", .label = "chief ray y",                  \
                                       .help = "upwards"                                           \
    }
#define STATUS_COLUMN                                                                              \
    {                                                                                              \
        COLUMN(struct color_row, status), .name = "status", .flags = COLUMN_HIDDEN,                \
                                          .label = "status",                                       \
                                          .help = "of the exact ray: ok miss total_reflection "    \
                                                  "not_converged"                                  \
    }

static const struct column columns[] = {
    ANALYSIS_POINT_COLUMNS(struct color_row, point),
    ANALYSIS_DEFOCUS_COLUMN(struct color_row, point),
    ANALYSIS_WAVELENGTH_COLUMN(struct color_row, point),
    AXIAL_COLUMNS,
    LATERAL_COLUMNS,
    STATUS_COLUMN,
    {PLACE(primary, COLUMN_HIDDEN), .name = "axial_color", .label = "axial colour",
     .help = "focus of the shortest less that of the longest wavelength"},
    {PLACE(secondary, COLUMN_HIDDEN), .name = "secondary", .label = "secondary spectrum",
     .help = "their mean less the focus of the primary wavelength, where that lies between"},
    {COLUMN(struct color_row, summary), .name = "summary", .flags = COLUMN_NOTE, .label = "summary",
     .help = "both in words"},
    ANALYSIS_TAIL_COLUMNS(struct color_row, point),
};

static const struct column zone_columns[] = {
    LENS_POSITION_COLUMN(struct color_row, point.position, COLUMN_BRIEF),
    ANALYSIS_WAVELENGTH_COLUMN(struct color_row, point),
    {COLUMN(struct color_row, zone), .name = "zone", .flags = COLUMN_BRIEF | COLUMN_ECHO,
     .label = "zone", .help = "height in the pupil over its radius; 0: paraxial"},
    AXIAL_COLUMNS,
    STATUS_COLUMN,
    LENS_TITLE_COLUMN(struct color_row, point.lens),
    LENS_WARNING_COLUMN(struct color_row, point.warning),
};

static const struct column field_columns[] = {
    ANALYSIS_POINT_COLUMNS(struct color_row, point),
    ANALYSIS_DEFOCUS_COLUMN(struct color_row, point),
    ANALYSIS_WAVELENGTH_COLUMN(struct color_row, point),
    LATERAL_COLUMNS,
    STATUS_COLUMN,
    ANALYSIS_TAIL_COLUMNS(struct color_row, point),
};

static const struct sheet sheets[] = {
    [COLOR_BY_WAVELENGTH] = SHEET(columns, struct color_row),
    [COLOR_BY_ZONE] = SHEET(zone_columns, struct color_row),
    [COLOR_BY_FIELD] = SHEET(field_columns, struct color_row),
};

static const struct sheet *const all_sheets[] = {
    &sheets[COLOR_BY_WAVELENGTH], &sheets[COLOR_BY_ZONE], &sheets[COLOR_BY_FIELD], NULL};

static const struct sheet *color_choose_sheet(const void *data, const struct option_query *asking)
{
    (void)asking;
    return &sheets[((const struct color_input *)data)->show];
}

/* -------- rows -------- */

static struct color_row color_row_of(const struct analysis_asked *asked,
                                     const struct analysis_case *one, size_t field,
                                     double wavelength)
{
    struct color_row row;
    analysis_begin_row(asked, one, field, &row);
    analysis_warn(asked, &row.point, color_doubt(one->setup->lens));
    row.point.wavelength = wavelength;
    return row;
}

static void put_axial(const struct setup *setup, const struct chromatic_focus *primary,
                      const struct chromatic_focus *focus, struct color_row *row)
{
    if (color_is_afocal(setup)) {
        row->vergence = focus->vergence - primary->vergence;
    } else {
        row->axial = focus->image - primary->image;
    }
}

static void put_lateral(const struct setup *setup, const struct chromatic_chief *chief,
                        const struct chromatic_lateral *lateral, struct color_row *row)
{
    row->chief_x = chief->height[0];
    row->chief_y = chief->height[1];
    if (isnan(setup->image)) {
        row->angle = lateral->angle;
    } else {
        row->lateral = lateral->height;
    }
}

/* The chief rays of a field at one wavelength; without a stop there are none, which is said. */
static bool color_find_lateral(const struct analysis_case *one, const struct field_point *field,
                               struct color_row *row, struct error *error)
{
    const struct setup *setup = one->setup;
    struct chromatic_chief primary, chief;
    if (setup->lens->stop == LENS_NONE && !setup->first.is_telecentric) {
        row->point.warning = lens_warnings_join(
            row->point.warning, "lateral colour is absent: the lens has no stop", setup->arena);
        return true;
    }
    if (!chromatic_chief(setup, field, lens_primary_wavelength(setup->lens), &primary, error) ||
        !chromatic_chief(setup, field, row->point.wavelength, &chief, error)) {
        return false;
    }
    double along[2];
    color_direction(setup, field, along);
    const struct chromatic_lateral lateral = chromatic_lateral(&primary, &chief, along);
    put_lateral(setup, &chief, &lateral, row);
    row->status = ray_status_name(primary.status != RAY_OK ? primary.status : chief.status);
    return true;
}

static bool color_list_wavelengths(const struct analysis_case *one, size_t field,
                                   const struct analysis_asked *asked, struct error *error)
{
    const struct setup *setup = one->setup;
    struct chromatic_focus primary, focus;
    struct color_summary summary;
    if (!color_summarize(one, &summary, error) ||
        !chromatic_focus(setup, lens_primary_wavelength(setup->lens), &primary, error)) {
        return false;
    }
    for (size_t i = 0; i < setup->wavelength_count; i++) {
        struct color_row row = color_row_of(asked, one, field, setup->wavelengths[i].wavelength);
        if (!chromatic_focus(setup, row.point.wavelength, &focus, error) ||
            !color_find_lateral(one, &setup->fields[field].point, &row, error)) {
            return false;
        }
        put_axial(setup, &primary, &focus, &row);
        row.primary = summary.axial.primary;
        row.secondary = summary.axial.secondary;
        row.summary = summary.words;
        if (!run_emit(asked->run, &row)) {
            return false;
        }
    }
    return true;
}

static bool list_zones(const struct analysis_case *one, size_t field,
                       const struct analysis_asked *asked, struct error *error)
{
    const struct setup *setup = one->setup;
    const struct color_input *input = asked->input;
    const bool entrance = input->question.aim == ANALYSIS_AIM_ENTRANCE;
    struct chromatic_focus primary, focus;
    if (!chromatic_focus(setup, lens_primary_wavelength(setup->lens), &primary, error)) {
        return false;
    }
    for (size_t i = 0; i < setup->wavelength_count; i++) {
        for (long k = 0; k <= input->steps; k++) {
            struct color_row row =
                color_row_of(asked, one, field, setup->wavelengths[i].wavelength);
            row.zone = (double)k / (double)input->steps;
            if (!chromatic_zone(setup, row.point.wavelength, row.zone, entrance, &focus, error)) {
                return false;
            }
            put_axial(setup, &primary, &focus, &row);
            row.status = ray_status_name(focus.status);
            if (!run_emit(asked->run, &row)) {
                return false;
            }
        }
    }
    return true;
}

/* A field that no chief ray comes from has a row that says so; the question has failed. */
static void color_keep_place(const struct field_point *at, struct run *run, struct error *error,
                             struct color_row *row)
{
    run->shortfall = *error;
    error_prefix(&run->shortfall, "%s: ", lens_field_words(at, run->arena));
    row->point.warning = arena_printf(run->arena, "%s", run->shortfall.message);
    error->code = ERROR_NONE;
}

static bool list_fields(const struct analysis_case *one, size_t field,
                        const struct analysis_asked *asked, struct error *error)
{
    const struct setup *setup = one->setup;
    const long steps = ((const struct color_input *)asked->input)->steps;
    for (long k = 0; k <= steps; k++) {
        const struct field_point at = color_field(&setup->fields[field].point, k, steps);
        for (size_t i = 0; i < setup->wavelength_count; i++) {
            struct color_row row =
                color_row_of(asked, one, field, setup->wavelengths[i].wavelength);
            double *parts[] = {&row.point.field, &row.point.field_x, &row.point.height,
                               &row.point.height_x};
            for (size_t j = 0; j < sizeof parts / sizeof parts[0]; j++) {
                *parts[j] *= (double)k / (double)steps;
            }
            if (!color_find_lateral(one, &at, &row, error)) {
                color_keep_place(&at, asked->run, error, &row);
            }
            if (!run_emit(asked->run, &row)) {
                return false;
            }
        }
    }
    return true;
}

static bool color_answer(const struct analysis_case *one, size_t field, void *context,
                         struct error *error)
{
    static bool (*const lists[])(const struct analysis_case *one, size_t field,
                                 const struct analysis_asked *asked, struct error *error) = {
        [COLOR_BY_WAVELENGTH] = color_list_wavelengths,
        [COLOR_BY_ZONE] = list_zones,
        [COLOR_BY_FIELD] = list_fields,
    };
    const struct analysis_asked *asked = context;
    return lists[((const struct color_input *)asked->input)->show](one, field, asked, error);
}

static bool color_run(const void *data, struct run *run, struct error *error)
{
    const struct color_input *input = data;
    const struct lens *lens = input->question.lens.lens;
    const struct analysis_rows rows = {
        &color_policy, color_choose_sheet(data, NULL), NULL, {.answer = color_answer}};
    if (input->show == COLOR_BY_ZONE && lens != NULL && lens->stop == LENS_NONE &&
        !lens->is_telecentric) {
        return fail(error, ERROR_DOMAIN, "the lens has no stop: its pupil has no zones");
    }
    return color_check(&input->question, error) && analysis_answer_rows(data, &rows, run, error);
}

static const struct artifact artifacts[] = {
    {ARTIFACT_OPTION("plot", drawing_types,
                     "draw focal shift, spherochromatism and lateral colour"),
     .scope = ARTIFACT_OF_SWEEP, .check = color_view_check, .make = color_view_draw},
};

static const struct explanation explanations[] = {
    {"axial",
     "axial = z(wavelength) - z(primary), z of the paraxial focus; with {zone} of the "
     "real ray",
     "[Smith05]", "of a thin singlet f/V from F to C"},
    {"lateral", "lateral = y(wavelength) - y(primary) of the exact chief rays on the image plane",
     "[Welford86]", "each aimed at the centre of the stop; vignetting is left out"},
    {"secondary", "secondary = (z(shortest) + z(longest))/2 - z(primary)", "[Smith05]", NULL},
    {NULL, NULL, NULL, NULL},
};

static const struct example examples[] = {
    {"color double-gauss", "axial and lateral colour at its wavelengths"},
    {"color double-gauss -w 400..700:50 --field 10deg --csv", "by wavelength, for a spreadsheet"},
    {"color double-gauss --show zone --steps 4", "spherochromatism"},
    {"color double-gauss --show field --steps 7 -w F", "lateral colour over the field"},
    {"color double-gauss --plot color.svg", "all three, drawn"},
    {NULL, NULL},
};

const struct command command_color = {
    .name = "color",
    .group = "analyses",
    .summary = "axial and lateral colour, secondary spectrum, spherochromatism",
    COMMAND_ASKS(struct color_input),
    COMMAND_ANSWERS(struct color_row),
    .run = color_run,
    .choose_sheet = color_choose_sheet,
    .sheets = all_sheets,
    .makes_many = command_always_many,
    .varies = analysis_varies,
    .brings = analysis_brings,
    .threads = analysis_threads,
    COMMAND_MAKES(artifacts),
    .most_answers = 100000,
};
