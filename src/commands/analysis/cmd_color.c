/* commands/analysis/cmd_color.c - lenscalc color: what wavelengths do to focus and image. */
/* SPDX-License-Identifier: MIT */
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
    ANALYSIS_OPTIONS_FOR("all of the lens", "", FOR_FIELDS),
    ANALYSIS_EDGE_OPTIONS(FOR_FIELDS),
    ANALYSIS_REAL,
    ANALYSIS_SPECTRUM_OPTION(struct color_input, question),
    {OPTION(struct color_input, show), .name = "show", .words = shows, .fallback = "wavelength",
     .value = "WHAT", .help = "what each row stands for"},
    {OPTION(struct color_input, steps), .name = "steps", .lowest = 1, .highest = 1000,
     .fallback = "10", .value = "COUNT", .wants = "show=zone|show=field",
     .help = "number of steps of zones or fields"},
    ANALYSIS_AIM_OPTION("show=zone", "pupil that the zones lie in"),
};

struct color_row {
    struct analysis_point point;
    double zone;
    bool is_afocal, is_angular; /* axial is a vergence, lateral an angle */
    double axial;               /* mm or 1/mm */
    double lateral, total;      /* mm or rad */
    double chief_x, chief_y;
    double primary, secondary;
    const char *status, *summary;
};

static const struct column_form vergence = {
    &dimension_vergence, "per_m",
    "of an afocal lens the vergence behind the last vertex less that of the primary wavelength"};
static const struct column_form angle = {&dimension_angle, "mrad",
                                         "of an image at infinity, as an angle"};

#define PLACE(member_name, more)                                                                   \
    COLUMN_OF_LENGTH(struct color_row, member_name, "mm"), .flags = (more)
#define AXIAL_COLUMN                                                                               \
    ENTRY(COLUMN_OR(struct color_row, axial, is_afocal, &vergence), .name = "axial",               \
          .dimension = &dimension_length, .unit = "mm", .flags = COLUMN_BRIEF | COLUMN_SPARSE,     \
          .label = "axial shift",                                                                  \
          .help = "shift of the focus from the paraxial one of the primary wavelength, positive "  \
                  "with the light")
#define LATERAL_COLUMNS                                                                            \
    ENTRY(COLUMN_OR(struct color_row, lateral, is_angular, &angle), .name = "lateral",             \
          .dimension = &dimension_length, .unit = "um", .flags = COLUMN_BRIEF | COLUMN_SPARSE,     \
          .label = "lateral shift",                                                                \
          .help =                                                                                  \
              "of the chief ray on the image plane from that of the primary wavelength, upwards"), \
        ENTRY(COLUMN_OR(struct color_row, total, is_angular, &angle), .name = "total_lateral",     \
              .dimension = &dimension_length, .unit = "um", .flags = COLUMN_SPARSE,                \
              .label = "total lateral colour",                                                     \
              .help = "largest less smallest lateral shift of all wavelengths at the field; "      \
                      "absent where these are swept"),                                             \
        ENTRY(PLACE(chief_x, COLUMN_HIDDEN), .name = "chief_x", .label = "chief ray x",            \
              .help = "where the chief ray meets the image plane"),                                \
        ENTRY(PLACE(chief_y, COLUMN_HIDDEN), .name = "chief_y", .label = "chief ray y",            \
              .help = "upwards")
#define STATUS_COLUMN                                                                              \
    ENTRY(COLUMN(struct color_row, status), .name = "status", .flags = COLUMN_HIDDEN,              \
          .help = "of the exact ray: ok miss total_reflection "                                    \
                  "not_converged")

static const struct column columns[] = {
    ANALYSIS_ROW_COLUMNS,
    AXIAL_COLUMN,
    LATERAL_COLUMNS,
    STATUS_COLUMN,
    {PLACE(primary, COLUMN_HIDDEN), .name = "axial_color", .label = "axial colour",
     .help = "focus of the shortest less that of the longest wavelength"},
    {PLACE(secondary, COLUMN_HIDDEN), .name = "secondary", .label = "secondary spectrum",
     .help = "their mean less the focus of the primary wavelength, where that lies between"},
    {COLUMN(struct color_row, summary), .name = "summary", .flags = COLUMN_NOTE,
     .help = "both in words"},
    ANALYSIS_TAIL_COLUMNS,
};

static const struct column zone_columns[] = {
    LENS_POSITION_COLUMN(struct color_row, point.position, COLUMN_BRIEF),
    ANALYSIS_WAVELENGTH_COLUMN,
    {COLUMN(struct color_row, zone), .name = "zone", .flags = COLUMN_BRIEF | COLUMN_ECHO,
     .help = "height in the pupil over its radius; 0: paraxial"},
    AXIAL_COLUMN,
    STATUS_COLUMN,
    LENS_TITLE_COLUMN(struct color_row, point.lens),
    LENS_WARNING_COLUMN(struct color_row, point.warning),
};

static const struct column field_columns[] = {
    ANALYSIS_ROW_COLUMNS,
    LATERAL_COLUMNS,
    STATUS_COLUMN,
    ANALYSIS_TAIL_COLUMNS,
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

/* Are there wavelengths to compare? */
static bool color_check(const struct analysis_question *question, struct error *error)
{
    const struct lens *lens = question->lens.lens;
    const bool spectrum = question->spectrum.text != NULL;
    if (lens == NULL || question->wavelength.name != NULL || question->spectrum.count > 1 ||
        (!spectrum && (lens->wavelength_count > 1 || lens->lights != NULL))) {
        return true;
    }
    const double only =
        spectrum ? question->spectrum.items[0].wavelength : lens_primary_wavelength(lens);
    fail(error, ERROR_DOMAIN, "there is one wavelength only, %.7g nm: colour is a difference",
         1000 * only);
    return error_hint(error, "give others with -w F,d,C or -w 400..700:10");
}

/* Are the glasses of the lens without dispersion, which no glass is? In words; null = no. */
static const char *color_doubt(const struct lens *lens)
{
    bool glass = false;
    for (size_t i = 0; i < lens->surface_count; i++) {
        const struct medium *medium = &lens->surfaces[i].medium;
        if (surface_reflects(&lens->surfaces[i]) || medium_is_air(medium)) {
            continue;
        }
        if (medium->kind != MEDIUM_CONSTANT) {
            return NULL;
        }
        glass = true;
    }
    return glass ? "every glass of the lens is stated by one index: it has no colour" : NULL;
}

/* -------- rows -------- */

static struct color_row color_row_of(const struct analysis_cursor *at, double wavelength)
{
    const struct setup *setup = at->one->setup;
    struct color_row row;
    analysis_begin_row(at, &sheets[((const struct color_input *)at->input)->show], &row);
    analysis_warn(at, &row.point, color_doubt(setup->lens));
    row.point.wavelength = wavelength;
    row.is_afocal = isinf(setup->first.image);
    row.is_angular = isnan(setup->image);
    return row;
}

static double color_axial(const struct chromatic_focus *primary,
                          const struct chromatic_focus *focus, bool is_afocal)
{
    return is_afocal ? focus->vergence - primary->vergence : focus->image - primary->image;
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
    row->chief_x = chief.height[0];
    row->chief_y = chief.height[1];
    row->lateral = row->is_angular ? lateral.angle : lateral.height;
    row->status = ray_status_name(primary.status != RAY_OK ? primary.status : chief.status);
    return true;
}

/* Hand out the rows of one field, which say how far all lie apart; false: no more are wanted. */
static bool color_emit_field(const struct analysis_cursor *at, struct color_row *rows)
{
    const size_t count = at->one->setup->wavelength_count;
    double low = INFINITY, high = -INFINITY;
    for (size_t i = 0; i < count; i++) {
        low = fmin(low, rows[i].lateral);
        high = fmax(high, rows[i].lateral);
    }
    for (size_t i = 0; i < count; i++) {
        rows[i].total = count > 1 && high >= low ? high - low : (double)NAN;
        if (!run_emit(at->run, &rows[i])) {
            return false;
        }
    }
    return true;
}

/* The rows of a field; false, and no error: no more are wanted. */
static bool color_list_wavelengths(const struct analysis_cursor *at, struct error *error)
{
    const struct analysis_case *one = at->one;
    const struct setup *setup = one->setup;
    struct chromatic_focus primary, focus;
    struct color_summary summary;
    if (!color_summarize(one, &summary, error) ||
        !chromatic_focus(setup, lens_primary_wavelength(setup->lens), &primary, error)) {
        return false;
    }
    struct color_row *rows = ARENA_ARRAY(setup->arena, setup->wavelength_count, struct color_row);
    for (size_t i = 0; i < setup->wavelength_count; i++) {
        struct color_row *row = &rows[i];
        *row = color_row_of(at, setup->wavelengths[i].wavelength);
        if (!chromatic_focus(setup, row->point.wavelength, &focus, error) ||
            !color_find_lateral(one, &setup->fields[at->field].point, row, error)) {
            return false;
        }
        row->axial = color_axial(&primary, &focus, row->is_afocal);
        row->primary = summary.axial.primary;
        row->secondary = summary.axial.secondary;
        row->summary = summary.words;
    }
    return color_emit_field(at, rows);
}

static bool color_list_zones(const struct analysis_cursor *at, struct error *error)
{
    const struct setup *setup = at->one->setup;
    const struct color_input *input = at->input;
    const bool entrance = input->question.aim == ANALYSIS_AIM_ENTRANCE;
    struct chromatic_focus primary, focus;
    if (!chromatic_focus(setup, lens_primary_wavelength(setup->lens), &primary, error)) {
        return false;
    }
    for (size_t i = 0; i < setup->wavelength_count; i++) {
        for (long k = 0; k <= input->steps; k++) {
            struct color_row row = color_row_of(at, setup->wavelengths[i].wavelength);
            row.zone = (double)k / (double)input->steps;
            if (!chromatic_zone(setup, row.point.wavelength, row.zone, entrance, &focus, error)) {
                return false;
            }
            row.axial = color_axial(&primary, &focus, row.is_afocal);
            row.status = ray_status_name(focus.status);
            if (!run_emit(at->run, &row)) {
                return false;
            }
        }
    }
    return true;
}

static bool color_list_fields(const struct analysis_cursor *at, struct error *error)
{
    const struct setup *setup = at->one->setup;
    const long steps = ((const struct color_input *)at->input)->steps;
    struct color_row *rows = ARENA_ARRAY(setup->arena, setup->wavelength_count, struct color_row);
    for (long k = 0; k <= steps; k++) {
        const struct field_point point = color_field(&setup->fields[at->field].point, k, steps);
        for (size_t i = 0; i < setup->wavelength_count; i++) {
            struct color_row *row = &rows[i];
            *row = color_row_of(at, setup->wavelengths[i].wavelength);
            double *parts[] = {&row->point.field, &row->point.field_x, &row->point.height,
                               &row->point.height_x};
            for (size_t j = 0; j < sizeof parts / sizeof parts[0]; j++) {
                *parts[j] *= (double)k / (double)steps;
            }
            if (!color_find_lateral(at->one, &point, row, error)) {
                /* it has a row that says so, and the question has failed */
                at->run->shortfall = *error;
                error_prefix(&at->run->shortfall, "%s: ", lens_field_words(&point, at->run->arena));
                row->point.warning = arena_printf(at->run->arena, "%s", at->run->shortfall.message);
                error->code = ERROR_NONE;
            }
        }
        if (!color_emit_field(at, rows)) {
            return false;
        }
    }
    return true;
}

static bool color_run(const void *data, struct run *run, struct error *error)
{
    static bool (*const lists[])(const struct analysis_cursor *at, struct error *error) = {
        [COLOR_BY_WAVELENGTH] = color_list_wavelengths,
        [COLOR_BY_ZONE] = color_list_zones,
        [COLOR_BY_FIELD] = color_list_fields,
    };
    const struct color_input *input = data;
    const struct lens *lens = input->question.lens.lens;
    struct analysis_policy policy = color_policy;
    policy.is_narrow = input->show != COLOR_BY_ZONE;
    struct analysis_cursor at = analysis_begin(input, &policy, run);
    if (input->show == COLOR_BY_ZONE && lens != NULL && lens->stop == LENS_NONE &&
        !lens->is_telecentric) {
        return fail(error, ERROR_DOMAIN, "the lens has no stop: its pupil has no zones");
    }
    if (!color_check(&input->question, error)) {
        return false;
    }
    while (analysis_next(&at, error)) {
        struct color_row row;
        if (lists[input->show](&at, error)) {
            continue;
        }
        if (error->code == ERROR_NONE) {
            return true;
        }
        if (!analysis_keep_lost(&at, error)) {
            return false;
        }
        analysis_begin_row(&at, &sheets[input->show], &row);
        if (!run_emit(run, &row)) {
            return true;
        }
    }
    return error->code == ERROR_NONE;
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
    .stop_size_wants = "show=zone|plot",
    .summary = "axial and lateral colour, secondary spectrum, spherochromatism",
    COMMAND_ASKS(struct color_input),
    COMMAND_ANSWERS(struct color_row),
    .run = color_run,
    .choose_sheet = color_choose_sheet,
    .sheets = all_sheets,
    .makes_many = command_always_many,
    ANALYSIS_COMMAND,
    COMMAND_MAKES(artifacts),
    .most_answers = 100000,
};
