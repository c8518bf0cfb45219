/* commands/lens/cmd_surfaces.c - lenscalc surfaces: a lens surface by surface. */
/* SPDX-License-Identifier: MIT */
#include "commands/lens/surface_footprints.h"
#include "commands/tables.h"
#include "draw/plot.h"
#include "optics/surface_shape.h"

static const struct lens_policy policy = {.wavelengths = WAVELENGTHS_PRIMARY,
                                          .fields = FIELDS_LARGEST,
                                          .telecentric = true,
                                          .is_narrow = true};

#define INPUT struct surfaces_input

static const struct word shows[] = {
    [SURFACES_PARAXIAL] = {"paraxial", "powers, vergences and paraxial rays"},
    [SURFACES_FOOTPRINTS] = {"footprints", "where the beams of all fields cross each surface"},
    {NULL, NULL},
};

static const struct option options[] = {
    LENS_OPTION(INPUT, question),
    LENS_WAVELENGTH_OPTION(INPUT, question, LENS_PRIMARY_WAVELENGTH),
    LENS_FNUMBER_OPTION(INPUT, question),
    LENS_FIELD_OPTIONS(INPUT, question),
    LENS_POSITION_OPTION(INPUT, question),
    LENS_SECTION_OPTION(INPUT, question),
    {OPTION(INPUT, show), .name = "show", .words = shows, .fallback = "paraxial", .value = "WHAT",
     .help = "what rows and --plot are of"},
    {OPTION(INPUT, clip), .name = "clip", .wants = "show=footprints",
     .help = "clip rays at apertures and stop (default)"},
    {OPTION(INPUT, no_clip), .name = "no-clip", .wants = "show=footprints", .excludes = "clip",
     .help = "do not clip rays at clear apertures"},
};

struct surfaces_row {
    long surface;
    const char *kind, *name, *medium, *position, *warning, *lens;
    double wavelength, field, field_x; /* um; rad */
    double radius, thickness, index, diameter, conic, power;
    double vergence_before, vergence_after;
    struct paraxial_ray marginal, chief;
    double edge_thickness, volume, mass; /* of the glass behind it; mm, mm^3, g */
};

#define ROW struct surfaces_row

#define MM(member, more)              LENGTH(member, "mm"), .flags = (more)
#define PER_LENGTH(member_name, more) MEASURED(member_name, vergence, "per_m"), .flags = (more)
#define PLAIN(member, more)           SHOWN(member), .flags = (more)

static const struct column columns[] = {
    {COLUMN_OF_WAVELENGTH(ROW, wavelength), .name = "wavelength", .flags = COLUMN_ECHO,
     .with = "wavelength", .help = "wavelength"},
    {ANGLE(field), .name = "field", ECHO_WITH("field"),
     .help = "field angle of the chief ray, as --field says it"},
    {ANGLE(field_x), .name = "field_x", ECHO_WITH("field-x"), .label = "field x",
     .help = "that in the x-z plane, as --field-x says it"},
    LENS_POSITION_COLUMN(ROW, position, 0),
    {PLAIN(surface, COLUMN_BRIEF), .name = "surface", .head = "surf",
     .help = "number of the surface, from 1, the stop counted"},
    {PLAIN(kind, COLUMN_BRIEF), .name = "kind",
     .help = "plane, sphere, conic, asphere, odd asphere, cylinder, mirror, thick or stop"},
    {PLAIN(name, 0), .name = "name", .help = "its name in the file"},
    {MM(radius, COLUMN_BRIEF | COLUMN_INFINITE), .name = "radius", .symbol = "R",
     .help = "radius of curvature at the vertex, A2 included; infinite for a "
             "plane"},
    {MM(thickness, COLUMN_BRIEF | COLUMN_ECHO), .name = "thickness", .symbol = "t", .head = "thick",
     .help = "to the next vertex; after the last surface as the file has it"},
    {PLAIN(medium, COLUMN_BRIEF), .name = "medium", .help = "what follows the surface"},
    {PLAIN(index, COLUMN_BRIEF), .name = "index", .symbol = "n",
     .help = "index of refraction after the surface; negative after a mirror"},
    {MM(diameter, COLUMN_BRIEF | COLUMN_ECHO), .name = "diameter", .head = "diam",
     .help = "full clear aperture"},
    {PLAIN(conic, COLUMN_ECHO), .name = "conic", .symbol = "k",
     .help = "conic constant; absent for a sphere or plane"},
    {PER_LENGTH(power, COLUMN_BRIEF), .name = "power", .symbol = "P",
     .help = "surface power (n' - n)/R in dioptres; of a thick lens 1/f"},
    {PER_LENGTH(vergence_before, COLUMN_INFINITE), .name = "vergence_before", .symbol = "V",
     .label = "vergence before the surface",
     .help = "n over the distance to where the axial beam meets, before the surface"},
    {PER_LENGTH(vergence_after, COLUMN_BRIEF | COLUMN_INFINITE), .name = "vergence_after",
     .symbol = "V'", .head = "V'", .label = "vergence after the surface",
     .help = "the same after it"},
    {MM(marginal.y, COLUMN_BRIEF | COLUMN_SPARSE), .name = "marginal_y", .symbol = "y", .head = "y",
     .label = "height of the marginal ray",
     .help = "height of the marginal ray; absent without an aperture"},
    {PLAIN(marginal.after, COLUMN_BRIEF | COLUMN_SPARSE), .name = "marginal_v", .symbol = "v",
     .head = "v", .label = "n u of the marginal ray",
     .help = "n u of the marginal ray after the surface; absent without an aperture"},
    {MM(chief.y, COLUMN_BRIEF | COLUMN_SPARSE), .name = "chief_y", .symbol = "ybar", .head = "ybar",
     .label = "height of the chief ray",
     .help = "height of the chief ray; absent without a stop or a field"},
    {PLAIN(chief.after, COLUMN_BRIEF | COLUMN_SPARSE), .name = "chief_v", .symbol = "vbar",
     .head = "vbar", .label = "n u of the chief ray",
     .help = "n u of the chief ray after the surface; absent without a stop or a field"},
    {MM(edge_thickness, 0), .name = "edge_thickness", .label = "edge thickness",
     .help = "of the glass behind it, at the rim of the larger diameter; absent where a diameter "
             "is not stated or a surface is a cylinder"},
    {MEASURED(volume, volume, "mm3"), .flags = 0, .name = "volume",
     .help = "of that glass, a cylinder between both surfaces; absent without an edge, and where "
             "that is negative"},
    {MEASURED(mass, mass, "g"), .flags = 0, .name = "mass",
     .help = "of that glass; absent without a volume, and where no catalogue states its density"},
    LENS_TITLE_COLUMN(ROW, lens),
    LENS_WARNING_COLUMN(ROW, warning),
};

static const char *surfaces_kind_of(const struct surface *surface)
{
    const char *name = surface_traits(surface)->name;
    if (name != NULL) {
        return surface_is_thin(surface) ? "thin" : name;
    }
    return !surface_is_round(surface) ? "cylinder"
                                      : surface_profiles[surface_profile(surface)].name;
}

/* Of the beam that starts on the axis: v over -y, whatever its size. */
static double surfaces_vergence(double y, double v)
{
    return y == 0 ? INFINITY : -v / y + 0.0;
}

/* Rays at every surface; NaN where there is none. */
static struct paraxial_ray *surfaces_follow(const struct lens_case *one, double y, double v,
                                            struct arena *arena)
{
    struct paraxial_ray *rays = ARENA_ARRAY(arena, one->light.system.count, struct paraxial_ray);
    paraxial_follow(&one->light.system, pair_of(y), pair_of(v), rays);
    return rays;
}

/* The glass behind a surface. */
static void surfaces_weigh(const struct lens *lens, size_t i, struct surfaces_row *row)
{
    const struct surface *surface = &lens->surfaces[i];
    row->edge_thickness = row->volume = row->mass = NAN;
    if (i + 1 < lens->surface_count && surface_has(surface, SURFACE_HAS_MEDIUM) &&
        surface_has(surface, SURFACE_HAS_CURVE) && !surface_reflects(surface) &&
        !medium_is_air(&surface->medium)) {
        const struct glass_shape shape = glass_shape_behind(lens, i);
        row->edge_thickness = shape.edge_thickness;
        row->volume = shape.volume;
        row->mass = surface->medium.density > 0 ? shape.volume * surface->medium.density / 1000
                                                : (double)NAN;
    }
}

static const struct sheet paraxial_sheet = SHEET(columns, struct surfaces_row);
static const struct sheet *const sheets[] = {&paraxial_sheet, &footprint_sheet, NULL};

static const struct sheet *surfaces_choose_sheet(const void *data,
                                                 const struct option_query *asking)
{
    (void)asking;
    return sheets[((const struct surfaces_input *)data)->show];
}

static bool surfaces_run(const void *data, struct run *run, struct error *error)
{
    const struct surfaces_input *input = data;
    if (input->show == SURFACES_FOOTPRINTS) {
        return footprint_rows(input, run, error);
    }
    struct lens_cursor at = lens_begin(&input->question, &policy, run->arena);
    while (lens_next(&at, error)) {
        const struct first_order *first = &at.one.light.first;
        const struct lens *lens = at.one.setup->lens;
        /* the beam from the object point on the axis, of any size */
        const bool far = lens->object_is_infinite;
        const struct paraxial_ray *axial = surfaces_follow(
            &at.one, far ? 1 : lens->object.value.hi, far ? 0 : first->index_object, run->arena);
        const struct paraxial_ray *marginal =
            surfaces_follow(&at.one, first->marginal_y, first->marginal_v, run->arena);
        const struct paraxial_ray *chief =
            surfaces_follow(&at.one, first->chief_y, first->chief_v, run->arena);
        for (size_t i = 0; i < at.one.light.system.count; i++) {
            const struct surface *surface = &lens->surfaces[i];
            double curvature = at.one.light.system.curvature[i].hi;
            struct text medium = surface->medium.written;
            struct surfaces_row row = {
                .surface = (long)i + 1,
                .kind = surfaces_kind_of(surface),
                .name = surface->name,
                .medium = arena_string(run->arena, medium.start, medium.length),
                .position = at.one.setup->position,
                .lens = lens->title,
                .warning = at.one.warning,
                .wavelength = at.one.light.wavelength,
                .field = input->question.field,
                .field_x = input->question.field_x,
                .radius = curvature != 0 ? 1 / curvature : INFINITY,
                .thickness = surface->has_thickness ? surface->thickness.value.hi : NAN,
                .index = at.one.light.system.index[i + 1].hi,
                .diameter = surface->has_diameter ? surface->diameter.value.hi : NAN,
                .conic = surface->conic.value.hi != 0 ? surface->conic.value.hi : NAN,
                .power = at.one.light.system.surfaces[i].power.hi + 0.0,
                .vergence_before = surfaces_vergence(axial[i].y, axial[i].before),
                .vergence_after = surfaces_vergence(axial[i].y, axial[i].after),
                .marginal = marginal[i],
                .chief = chief[i],
            };
            surfaces_weigh(lens, i, &row);
            if (i == at.one.light.system.stop && !isnan(row.chief.y)) {
                row.chief.y = 0; /* by definition, where the trace leaves 1e-16 */
            }
            bool plain = !surface_reflects(surface) && !surface->is_plane &&
                         surface->coefficients == 0 && surface_is_round(surface);
            row.radius = plain ? surface->radius.value.hi : row.radius;
            if (!run_emit(run, &row)) {
                break;
            }
        }
    }
    return error->code == ERROR_NONE;
}

/* -------- the y-ybar diagram -------- */

enum { CURVES_MOST = 7 };

/* Heights of the chief and the marginal ray at each surface, a curve a lens and position. */
struct ybar_drawing {
    struct arena *arena;
    struct plot_series series[CURVES_MOST];
    size_t count;
    const char *lens;
};

static bool ybar_drawing_add(struct ybar_drawing *drawing, const struct lens_case *one,
                             struct error *error)
{
    const struct first_order *first = &one->light.first;
    const size_t count = one->light.system.count;
    struct arena *arena = drawing->arena;
    const struct paraxial_ray *marginal =
        surfaces_follow(one, first->marginal_y, first->marginal_v, arena);
    const struct paraxial_ray *chief = surfaces_follow(one, first->chief_y, first->chief_v, arena);
    double *x = ARENA_ARRAY(arena, 2 * count + 2, double), *y = x + count + 1;
    if (drawing->count == CURVES_MOST) {
        return fail(error, ERROR_USAGE, "{--plot} would draw more than %d diagrams", CURVES_MOST);
    }
    for (size_t i = 0; i < count; i++) {
        x[i] = i == one->light.system.stop ? 0 : chief[i].y;
        y[i] = marginal[i].y;
    }
    if (!isfinite(x[0]) || !isfinite(y[0])) {
        return fail(error, ERROR_DOMAIN,
                    "{--plot}: the lens has no marginal and chief ray: it states no aperture, "
                    "no stop or no field");
    }
    /* last where the marginal ray meets the axis: the image, unless it is infinitely far away */
    const struct paraxial_ray *last = &marginal[count - 1];
    const bool is_far = !(fabs(last->after) > 0) || isinf(first->image);
    x[count] = chief[count - 1].y - last->y * (chief[count - 1].after / last->after);
    const char *title = one->setup->lens->title, *position = one->setup->position;
    drawing->lens = title;
    drawing->series[drawing->count] =
        (struct plot_series){.label = position != NULL ? position : title,
                             .x = x,
                             .y = y,
                             .count = is_far ? count : count + 1,
                             .style = drawing->count};
    drawing->count++;
    return true;
}

static bool surfaces_figure(const struct artifact_job *job, struct output *sink,
                            struct error *error)
{
    if (((const struct surfaces_input *)job->inputs[0])->show == SURFACES_FOOTPRINTS) {
        return footprint_figure(job, sink, error);
    }
    struct svg svg = {.arena = job->run->arena};
    struct ybar_drawing drawing = {.arena = svg.arena};
    for (size_t i = 0; i < job->count; i++) {
        const struct surfaces_input *input = job->inputs[i];
        struct lens_cursor at = lens_begin(&input->question, &policy, svg.arena);
        while (lens_next(&at, error)) {
            if (!ybar_drawing_add(&drawing, &at.one, error)) {
                return false;
            }
        }
        if (error->code != ERROR_NONE) {
            return false;
        }
    }
    drawing.series[0].label = drawing.count > 1 ? drawing.series[0].label : NULL;
    const struct plot plot = {
        .title = drawing.count > 1 ? "y-ybar diagrams"
                                   : arena_printf(svg.arena, "y-ybar diagram of %s", drawing.lens),
        .subtitle = "paraxial rays at each surface, and at the image last",
        .x_label = "height of the chief ray, ybar (mm)",
        .y_label = "height of the marginal ray, y (mm)",
        .series = drawing.series,
        .series_count = drawing.count};
    return plot_draw(&plot, &svg, error) && drawing_write(job, &svg, sink, error);
}

static const struct artifact artifacts[] = {
    {ARTIFACT_OPTION("plot", drawing_types,
                     "draw the y-ybar diagram, or with --show footprints the beams on surfaces"),
     .scope = ARTIFACT_OF_SWEEP, .make = surfaces_figure},
};

static const struct explanation explanations[] = {
    {"power", "P = (n' - n)/R", "[Smith05]", "paraxial"},
    {"beam_radius",
     "largest distance from the vertex of the rays of the clear pupil, with --show "
     "footprints",
     "exact rays on the edge of the pupil, its corners, and rings within",
     "what blocks light within the edge is not cut out"},
    {"marginal_v", "v' = {v} before - {y} {P}", "[Smith05]; v = n u", NULL},
    {NULL, NULL, NULL, NULL},
};

static const struct example examples[] = {
    {"surfaces double-gauss", "the table of the lens, with powers and paraxial rays"},
    {"surfaces double-gauss -N 4 --field 10deg -w F --csv", "for a spreadsheet"},
    {"surfaces double-gauss --plot ybar.svg", "its y-ybar diagram"},
    {"surfaces double-gauss --show footprints --plot beams.svg", "how large the beams are on each"},
    {"surfaces double-gauss --columns surface,power_diopter,vergence_after_diopter",
     "vergences in dioptres"},
    {NULL, NULL},
};

static double surfaces_weight(const void *data)
{
    const struct lens *lens = ((const struct surfaces_input *)data)->question.lens.lens;
    return lens != NULL ? (double)lens->surface_count : 1;
}

const struct command command_surfaces = {
    .name = "surfaces",
    .stop_size_wants = "show=footprints",
    COMMAND_OF("a lens", "a lens surface by surface: powers, vergences, paraxial rays"),
    .run = surfaces_run,
    .choose_sheet = surfaces_choose_sheet,
    .sheets = sheets,
    .makes_many = command_always_many,
    COMMAND_MAKES(artifacts),
    .weight = surfaces_weight,
};
