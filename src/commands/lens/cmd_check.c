/* commands/lens/cmd_check.c - lenscalc check: paraxial results against exact rays. */
/* SPDX-License-Identifier: MIT */
#include "analysis/rays/paraxial_check.h"
#include "commands/lens/lens_options.h"
#include "commands/tables.h"
#include "draw/plot.h"
#include "draw/plot_sample.h"

#include <string.h>

#include "base/constants.h"

struct check_input {
    struct lens_question question;
    double tolerance;
    long steps;
};

#define INPUT struct check_input

static const struct option options[] = {
    LENS_OPTION(INPUT, question),
    LENS_WAVELENGTH_OPTION(INPUT, question, LENS_PRIMARY_WAVELENGTH),
    LENS_FNUMBER_OPTION(INPUT, question),
    {MEASURE(question.field, angle, "deg", "ANGLE"), .name = "field", .lowest = -PI, .highest = PI,
     .flags = OPTION_FIELD | OPTION_ABOVE_LOWEST | OPTION_BELOW_HIGHEST,
     .help = "largest field angle, in object space, a list is swept; without it that of the lens, "
             "else 5 deg"},
    LENS_FIELD_X_OPTION(INPUT, question.field_x),
    LENS_POSITION_OPTION(INPUT, question),
    LENS_SECTION_OPTION(INPUT, question),
    {MEASURE(tolerance, ratio, NULL, "RATIO"), REPEATED("tolerance"), .lowest = 0, .highest = 1,
     .flags = OPTION_ABOVE_LOWEST, .fallback = "1%", .help = "tolerance for the verdict 'trusted'"},
    {ASKED(steps), .name = "steps", .lowest = 1, .highest = 100, .fallback = "3", .value = "COUNT",
     .help = "number of apertures, each a stop smaller, and of fields, evenly spaced"},
};

struct check_row {
    const char *quantity, *unit, *position, *status, *verdict, *warning, *lens;
    double wavelength; /* um */
    double fraction, fnumber, height, field;
    double paraxial, exact, difference, relative;
    double order, local_order, rounding, trusted, trusted_fnumber, trusted_field, tolerance;
    long lost;
};

#define ROW struct check_row

#define MM(member, more)      LENGTH(member, "mm"), .flags = (more)
#define DEGREES(member, more) ANGLE(member), .flags = (more)
#define PLAIN(member, more)   SHOWN(member), .flags = (more)

static const struct column columns[] = {
    {COLUMN_OF_WAVELENGTH(ROW, wavelength), .flags = COLUMN_ECHO, .name = "wavelength",
     .with = "wavelength", .help = "wavelength"},
    LENS_POSITION_COLUMN(ROW, position, 0),
    {PLAIN(quantity, COLUMN_BRIEF), .name = "quantity", .help = "what is compared"},
    {PLAIN(unit, COLUMN_BRIEF), .name = "unit",
     .help = "of paraxial, exact and difference: mm, deg, or 1"},
    {PLAIN(fraction, COLUMN_HIDDEN | COLUMN_ECHO), .name = "fraction",
     .help = "of the aperture's radius, or of the largest field"},
    {PLAIN(fnumber, COLUMN_BRIEF | COLUMN_SPARSE), .name = "fnumber", .symbol = "N",
     .label = "f-number",
     .help = "of the ray's height: paraxial, near objects: working; absent where a field is"},
    {MM(height, COLUMN_HIDDEN), .name = "height", .symbol = "h",
     .help = "of the ray in the paraxial entrance pupil"},
    {DEGREES(field, COLUMN_BRIEF | COLUMN_ECHO | COLUMN_SPARSE), .name = "field", .symbol = "t",
     .help = "of the chief ray as seen from the first vertex; else absent"},
    {PLAIN(paraxial, COLUMN_BRIEF | COLUMN_INFINITE), .name = "paraxial",
     .help = "without aberrations"},
    {PLAIN(exact, COLUMN_BRIEF), .name = "exact",
     .help = "by the exact ray; absent where it is lost"},
    {PLAIN(difference, COLUMN_BRIEF), .name = "difference", .symbol = "d",
     .help = "exact - paraxial"},
    {MEASURED(relative, ratio, "percent"), BRIEF, .name = "relative",
     .help = "difference over the paraxial value, of places over the focal length"},
    {PLAIN(local_order, COLUMN_BRIEF), .name = "local_order", .label = "order here", .digits = 3,
     .help = "log2 of the difference here over that at half the aperture or field"},
    {PLAIN(order, COLUMN_BRIEF), .name = "order", .digits = 3,
     .help = "of the difference as aperture or field goes to 0: 2 for places, 3 for heights, more "
             "where the lens is corrected"},
    {PLAIN(rounding, COLUMN_HIDDEN | COLUMN_ECHO), .name = "rounding", .label = "rounding from",
     .help = "the fraction from which on the difference is rounding; 0 if never to 2^-16"},
    {PLAIN(trusted, COLUMN_HIDDEN), .name = "trusted", .label = "trusted to",
     .help = "fraction up to which the relative difference keeps within the tolerance"},
    {PLAIN(trusted_fnumber, COLUMN_HIDDEN | COLUMN_INFINITE), .name = "trusted_fnumber",
     .label = "trusted from", .help = "the same as an f-number"},
    {DEGREES(trusted_field, COLUMN_HIDDEN), .name = "trusted_field", .label = "trusted to field",
     .help = "the same as a field angle"},
    {MEASURED(tolerance, ratio, "percent"), .name = "tolerance",
     .flags = COLUMN_ECHO | COLUMN_HIDDEN, .with = "tolerance", .help = "of the verdict"},
    {PLAIN(status, COLUMN_HIDDEN), .name = "status",
     .help = "of the exact ray: ok miss total_reflection not_converged; clear apertures are not "
             "looked at"},
    {PLAIN(lost, COLUMN_SPARSE | COLUMN_BRIEF), .name = "surface", .label = "lost at surface",
     .help = "where the exact ray is lost"},
    {PLAIN(verdict, COLUMN_NOTE), .name = "verdict",
     .help = "how far the paraxial value may be trusted, in words"},
    LENS_TITLE_COLUMN(ROW, lens),
    LENS_WARNING_COLUMN(ROW, warning),
};

/* How a quantity is called, and its unit. */
static const struct {
    const char *name, *words, *unit;
} names[CHECK_QUANTITIES] = {
    [CHECK_EFL] = {"efl", "focal length", "mm"},
    [CHECK_BFL] = {"bfl", "back focal length", "mm"},
    [CHECK_REAR_PRINCIPAL] = {"rear_principal", "rear principal surface", "mm"},
    [CHECK_FFL] = {"ffl", "front focal point", "mm"},
    [CHECK_FRONT_PRINCIPAL] = {"front_principal", "front principal surface", "mm"},
    [CHECK_IMAGE] = {"image", "image distance", "mm"},
    [CHECK_MAGNIFICATION] = {"magnification", "magnification", "1"},
    [CHECK_EXIT_ANGLE] = {"exit_angle", "angle of the leaving ray", "deg"},
    [CHECK_FNUMBER] = {"working_fnumber", "working f-number", "1"},
    [CHECK_TRANSVERSE] = {"transverse", "height of the axial ray in the image", "mm"},
    [CHECK_IMAGE_HEIGHT] = {"image_height", "image height", "mm"},
    [CHECK_ANGULAR_MAGNIFICATION] = {"angular_magnification", "angular magnification", "1"},
    [CHECK_ENTRANCE_PUPIL] = {"entrance_pupil", "entrance pupil's place", "mm"},
    [CHECK_EXIT_PUPIL] = {"exit_pupil", "exit pupil's place", "mm"},
};

static const struct lens_policy policy = {.wavelengths = WAVELENGTHS_PRIMARY,
                                          .fields = FIELDS_EDGE};

/* The lens in one case, ready for comparison. */
struct check_job {
    const struct check_input *input;
    const struct lens_case *one;
    struct check_problem problem;
};

static bool check_set_up(const struct check_input *input, const struct lens_case *one,
                         struct check_job *check, struct error *error)
{
    const struct lens *lens = one->setup->lens;
    for (size_t i = 0; i < lens->surface_count; i++) {
        if (lens->surfaces[i].decentre != NULL || lens->surfaces[i].coordinate_break != NULL) {
            return fail(
                error, ERROR_DOMAIN,
                "surface %zu is decentred, tilted or behind a coordinate break, and paraxial "
                "results are those of the centred lens: there is nothing to compare",
                i + 1);
        }
    }
    if (isnan(one->light.first.entrance_diameter) || isnan(one->light.first.marginal_y)) {
        fail(error, ERROR_DOMAIN, "the lens has no aperture: the height of its rays is not known");
        return error_hint(error, "give an f-number with -N, or an aperture in the file");
    }
    const struct setup *setup = one->setup;
    const struct system *forward = setup_system(setup, one->index, SETUP_OPEN, error);
    const struct system *backward =
        forward != NULL ? setup_system(setup, one->index, SETUP_REVERSED, error) : NULL;
    *check = (struct check_job){.input = input, .one = one};
    check->problem = (struct check_problem){
        .forward = forward,
        .backward = backward,
        .first = &one->light.first,
        .object = setup->object,
        .section = setup->section,
        .plane = isfinite(setup->first.image) ? setup->first.image : (double)NAN,
        .field = setup->fields[0].point,
        .chiefs = ARENA_ARRAY(setup->arena, CHECK_CHIEFS, struct check_chief),
    };
    return backward != NULL && setup_real_in_object(setup, &check->problem.field, error);
}

/* -------- the verdict -------- */

static const char *order_words(const struct check_order *order, struct arena *arena)
{
    if (order->is_equal) {
        return "equal to rounding";
    }
    const char *words =
        isnan(order->order) ? "no order found" : arena_printf(arena, "order %.3g", order->order);
    return order->rounding > 0
               ? arena_printf(arena, "%s down to %.2g %% of it, where rounding begins", words,
                              100 * order->rounding)
               : words;
}

/* Of a quantity by field; `largest` in degrees, NaN for a field that no beam has. */
static const char *field_words(const struct check_row *row, double largest, bool arrives,
                               struct arena *arena)
{
    const double whole = 1 - 1e-9;
    if (row->trusted >= whole) {
        return isnan(largest) ? "over the whole field"
                              : arena_printf(arena, "over the whole field, %.4g deg", largest);
    }
    const char *words = isnan(largest) || isnan(row->trusted_field)
                            ? arena_printf(arena, "up to %.3g %% of the field", 100 * row->trusted)
                            : arena_printf(arena, "up to %.4g deg of %.4g deg",
                                           row->trusted_field * DEGREES_PER_RADIAN, largest);
    return arrives ? words
                   : arena_printf(arena, "%s, from where no chief ray reaches the stop", words);
}

static const char *extent_words(const struct check_row *row, enum check_quantity quantity,
                                const struct check_value *edge, struct arena *arena)
{
    const double whole = 1 - 1e-9;
    bool field = paraxial_check_is_of_field(quantity);
    if (!(row->trusted > 0)) {
        return arena_printf(arena, "at no %s", field ? "field" : "aperture");
    }
    if (field) {
        return field_words(row, edge->angle * DEGREES_PER_RADIAN, !isnan(edge->exact), arena);
    }
    if (isnan(row->trusted_fnumber)) {
        return arena_printf(arena, "up to %.3g %% of the aperture", 100 * row->trusted);
    }
    return arena_printf(arena,
                        row->trusted >= whole ? "over the whole aperture, f/%.4g" : "up to f/%.4g",
                        row->trusted_fnumber);
}

static void check_judge(const struct check_job *check, enum check_quantity quantity,
                        struct arena *arena, struct check_row *row)
{
    const struct check_problem *problem = &check->problem;
    const struct check_order order = paraxial_check_order(problem, quantity, arena);
    struct check_value edge = paraxial_check_at(problem, quantity, 1, arena);
    double tolerance = check->input->tolerance;
    row->order = order.order;
    row->rounding = order.rounding;
    row->tolerance = tolerance;
    row->trusted = paraxial_check_trusted(problem, quantity, tolerance, arena);
    row->trusted_fnumber = row->trusted > 0 ? edge.fnumber / row->trusted : (double)NAN;
    row->trusted_field = edge.angle * row->trusted;
    if (row->trusted > 0 && problem->field.kind != FIELD_ANGLE &&
        paraxial_check_is_of_field(quantity)) {
        row->trusted_field = paraxial_check_at(problem, quantity, row->trusted, arena).angle;
    }
    if (isnan(row->trusted)) {
        row->verdict =
            arena_printf(arena, "%s: %s", names[quantity].words, order_words(&order, arena));
        return;
    }
    /* where the quantity exists: it need not at the edge */
    const struct check_value inside =
        row->trusted > 0 ? paraxial_check_at(problem, quantity, row->trusted, arena) : edge;
    bool of_itself = inside.scale == fabs(inside.paraxial) || isnan(inside.scale);
    row->verdict =
        arena_printf(arena, "%s: within %.3g %%%s %s (%s)", names[quantity].words, 100 * tolerance,
                     of_itself ? "" : " of the focal length",
                     extent_words(row, quantity, &edge, arena), order_words(&order, arena));
}

/* -------- rows -------- */

static bool check_compare(const struct check_input *input, const struct lens_case *one,
                          struct run *run, struct error *error)
{
    struct check_job check;
    if (!check_set_up(input, one, &check, error)) {
        return false;
    }
    for (int quantity = 0; quantity < CHECK_QUANTITIES; quantity++) {
        const enum check_quantity what = (enum check_quantity)quantity;
        struct check_row row = {
            .quantity = names[quantity].name,
            .unit = names[quantity].unit,
            .position = one->setup->position,
            .lens = one->setup->lens->title,
            .warning = one->warning,
            .wavelength = one->light.wavelength,
        };
        if (!paraxial_check_applies(&check.problem, what)) {
            continue;
        }
        check_judge(&check, what, run->arena, &row);
        for (long step = 0; step < input->steps; step++) {
            /* each aperture a stop smaller; fields evenly spaced; from the edge inwards */
            double fraction = paraxial_check_is_of_field(what)
                                  ? (double)(input->steps - step) / (double)input->steps
                                  : exp2(-0.5 * (double)step);
            struct check_value here = paraxial_check_at(&check.problem, what, fraction, run->arena);
            struct check_value inner =
                paraxial_check_at(&check.problem, what, fraction / 2, run->arena);
            double unit = what == CHECK_EXIT_ANGLE ? DEGREES_PER_RADIAN : 1;
            row.fraction = fraction;
            row.fnumber = here.fnumber;
            row.height = here.height;
            row.field = here.angle;
            row.paraxial = unit * here.paraxial + 0.0;
            row.exact = unit * here.exact + 0.0;
            row.difference = isfinite(here.paraxial) ? row.exact - row.paraxial : (double)NAN;
            row.relative = row.difference / here.scale;
            double before = fabs(inner.exact - inner.paraxial),
                   now = fabs(here.exact - here.paraxial);
            bool rounded = fraction / 2 <= row.rounding || isnan(row.order);
            if (what == CHECK_FNUMBER) {
                before /= inner.scale;
                now /= here.scale;
            }
            row.local_order = rounded || !isfinite(now) ? (double)NAN : log2(now / before);
            row.local_order = isfinite(row.local_order) ? row.local_order : (double)NAN;
            row.status = ray_status_name(here.status);
            row.lost = here.surface > 0 ? (long)here.surface : NO_INTEGER;
            if (!run_emit(run, &row)) {
                return true;
            }
        }
    }
    return true;
}

static bool check_command_run(const void *data, struct run *run, struct error *error)
{
    const struct check_input *input = data;
    struct lens_cursor at = lens_begin(&input->question, &policy, run->arena);
    while (lens_next(&at, error)) {
        if (!check_compare(input, &at.one, run, error)) {
            return false;
        }
    }
    return error->code == ERROR_NONE;
}

/* -------- the plot -------- */

enum { POINTS = 41, BETWEEN = 600 };

static const char *check_subtitle(const struct check_job *check, struct arena *arena)
{
    const struct lens_case *one = check->one;
    const struct first_order *first = &one->light.first;
    const struct field_point *field = &check->problem.field;
    const char *position = one->setup->position;
    const char *words =
        arena_printf(arena, "at %.5g nm%s%s; aperture f/%.3g", 1000 * one->light.wavelength,
                     position != NULL ? ", position " : "", position != NULL ? position : "",
                     isfinite(first->fnumber) ? first->fnumber : first->working_fnumber);
    if (field->kind != FIELD_ANGLE) {
        return words;
    }
    const double largest = atan2(sin(field->value[1]), cos(field->value[1]));
    return arena_printf(arena, "%s, field %.4g deg", words, largest * DEGREES_PER_RADIAN);
}

static bool check_plot(const struct artifact_job *job, struct error *error)
{
    const struct check_input *input = job->inputs[0];
    return !lens_positions_several(input->question.lens.lens, input->question.position) ||
           fail(error, ERROR_USAGE, "{--plot} shows one position: name it with {--position}");
}

/* The quantities of a plot, to be compared anywhere. */
struct check_curves {
    const struct check_problem *problem;
    enum check_quantity quantity[CHECK_QUANTITIES];
    size_t count;
    struct arena *arena;
};

static bool check_curves_at(void *context, double x, double *y)
{
    const struct check_curves *curves = context;
    for (size_t k = 0; k < curves->count; k++) {
        const struct check_value value =
            paraxial_check_at(curves->problem, curves->quantity[k], x, curves->arena);
        const double relative = fabs(value.exact - value.paraxial) / value.scale;
        y[k] = relative > 1e-13 ? 100 * relative : (double)NAN;
    }
    return true;
}

static bool check_draw(const struct artifact_job *job, struct output *sink, struct error *error)
{
    const struct check_input *input = job->inputs[0];
    struct svg svg = {.arena = job->run->arena};
    struct lens_cursor at = lens_begin(&input->question, &policy, svg.arena);
    struct check_job check;
    if (!lens_next(&at, error) || !check_set_up(input, &at.one, &check, error)) {
        return false;
    }
    double x[POINTS];
    struct plot_series series[CHECK_QUANTITIES];
    struct plot plot = {.title = arena_printf(svg.arena, "Exact against paraxial rays of %s",
                                              at.one.setup->lens->title),
                        .subtitle = check_subtitle(&check, svg.arena),
                        .x_label = "fraction of the aperture, or of the field",
                        .y_label = "difference (% of the value or focal length)",
                        .x = x,
                        .count = POINTS,
                        .series = series,
                        .log_x = true,
                        .log_y = true};
    for (size_t i = 0; i < POINTS; i++) {
        x[i] = pow(10, -1.5 * (1 - (double)i / (POINTS - 1)));
    }
    /* The curves of a case, which fill a page. */
    struct arena *arena = svg.arena;
    struct check_curves compared = {.problem = &check.problem, .arena = arena};
    for (int quantity = 0; quantity < CHECK_QUANTITIES; quantity++) {
        const struct check_problem *problem = &check.problem;
        enum check_quantity what = (enum check_quantity)quantity;
        if (!paraxial_check_applies(problem, what) ||
            isnan(paraxial_check_at(problem, what, 0.5, arena).scale)) {
            continue;
        }
        compared.quantity[compared.count++] = what;
        series[plot.series_count] =
            (struct plot_series){.label = names[quantity].words, .style = plot.series_count};
        plot.series_count++;
    }
    double *samples[CHECK_QUANTITIES];
    for (size_t k = 0; k < compared.count; k++) {
        samples[k] = ARENA_ARRAY(arena, POINTS, double);
        series[k].y = samples[k];
    }
    for (size_t i = 0; i < POINTS; i++) {
        double y[CHECK_QUANTITIES];
        check_curves_at(&compared, x[i], y);
        for (size_t k = 0; k < compared.count; k++) {
            samples[k][i] = y[k];
        }
    }
    const struct plot_source source = {
        .curves = compared.count, .at = check_curves_at, .context = &compared, .most = BETWEEN};
    struct plot_curves curves;
    plot_sample(&plot, x, (const double *const *)samples, POINTS, &source, &curves, arena);
    /* where a difference changes its sign it runs off the page */
    for (size_t i = 0; i < curves.count; i++) {
        curves.places[i] = curves.places[i] == PLOT_SAMPLE ? PLOT_SAMPLE : PLOT_BEYOND;
    }
    for (size_t k = 0; k < compared.count; k++) {
        series[k].y = curves.y[k];
        series[k].x = curves.x;
        series[k].count = curves.count;
        series[k].places = curves.places;
    }
    return plot_draw(&plot, &svg, error) && drawing_write(job, &svg, sink, error);
}

static const struct artifact artifacts[] = {
    {ARTIFACT_OPTION("plot", drawing_types, "draw the differences over aperture and field"),
     .scope = ARTIFACT_OF_ANSWER, .check = check_plot, .make = check_draw},
};

static const struct explanation explanations[] = {
    {"exact",
     "by the exact ray: efl = -h/(n' sin U'); places where rays cross the axis; principal surfaces "
     "where entering and leaving ray meet; f-number 1/(2 n' sin U')",
     "[Welford86]", "clear apertures do not stop these rays"},
    {"relative", "{relative} = (exact - paraxial)/paraxial, for places over the focal length",
     "of the image height: distortion", NULL},
    {"order", "slope of log {d} against log h over the four smallest sound h = 2^-k",
     "aberration theory: 2 along the axis, 3 across", NULL},
    {NULL, NULL, NULL, NULL},
};

static const struct example examples[] = {
    {"check double-gauss", "how far paraxial results may be trusted for this lens"},
    {"check double-gauss --tolerance 0.1% -w d,F,C --csv", "by wavelength, for a spreadsheet"},
    {"check fisheye-16 --field 60deg --steps 6", "a fisheye: no paraxial image height"},
    {"check double-gauss --plot check.svg", "the differences, drawn"},
    {NULL, NULL},
};

const struct command command_check = {
    .name = "check",
    COMMAND_OF("a lens", "paraxial results compared with exact rays, and how far to trust them"),
    .run = check_command_run,
    .makes_many = command_always_many,
    COMMAND_MAKES(artifacts),
    .most_answers = 100000,
};
