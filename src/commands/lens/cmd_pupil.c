/* commands/lens/cmd_pupil.c - lenscalc pupil: shapes of the entrance and exit pupil. */
/* SPDX-License-Identifier: MIT */
#include "commands/lens/pupil_cases.h"
#include "commands/tables.h"
#include "draw/outlines.h"
#include "report/row.h"

#include <string.h>

enum side { SIDE_BOTH, SIDE_ENTRANCE, SIDE_EXIT };

static const struct word sides[] = {
    [SIDE_BOTH] = {"both", "a row for each"},
    [SIDE_ENTRANCE] = {"entrance", "the entrance pupil"},
    [SIDE_EXIT] = {"exit", "the exit pupil"},
    {NULL, NULL},
};

#define INPUT struct pupil_input

static const struct option options[] = {
    LENS_OPTION(INPUT, question),
    LENS_WAVELENGTH_OPTION(INPUT, question, LENS_PRIMARY_WAVELENGTH),
    LENS_FNUMBER_OPTION(INPUT, question),
    {MEASURE(question.field, angle, "deg", "ANGLE"), REPEATED("field"), .lowest = -PI,
     .highest = PI, .flags = OPTION_FIELD | OPTION_ABOVE_LOWEST | OPTION_BELOW_HIGHEST,
     .help = "field angle in object space, of 90 deg and more too, a list is swept; default those "
             "of the lens"},
    LENS_FIELD_X_OPTION(INPUT, question.field_x),
    {MEASURE(height, length, "mm", "LENGTH"), REPEATED("height"), .lowest = -INFINITY,
     .highest = INFINITY, .flags = OPTION_NO_INFINITY,
     .help = "a point on the film instead, at this distance from the axis"},
    {MEASURE(height_x, length, "mm", "LENGTH"), .name = "height-x", .column = "height_x",
     .flags = OPTION_NO_INFINITY, .help = "its offset in x"},
    {MEASURE(focus, length, "mm", "PLANE"), .name = "focus", .wants = "height|height-x",
     .help = "position of the film: paraxial, table, best, or a distance behind the last vertex"},
    LENS_POSITION_OPTION(INPUT, question),
    {ASKED(side), .name = "side", .column = "side_wanted", .words = sides, .fallback = "both",
     .value = "SIDE", .help = "which pupil"},
    {ASKED(outline), .name = "outline", .lowest = 3, .highest = PUPIL_EDGES, .value = "COUNT",
     .help = "print this many points of the edge instead"},
};

struct pupil_row {
    const char *pupil, *position, *status, *warning, *lens;
    double wavelength; /* um */
    struct pupil_case at;
    double z;
    struct pupil_side side;
    double projected, obstruction, fraction, projected_fraction, irradiance, illumination;
    double vignetting[PUPIL_ENDS];
    long limit[PUPIL_ENDS], lost;
    long point, rays;
    double edge_x, edge_y, edge_vertex_x, edge_vertex_y, stop_x, stop_y;
};

#define ROW struct pupil_row

#define MM(member, more)    LENGTH(member, "mm"), .flags = (more)
#define PLAIN(member, more) SHOWN(member), .flags = (more)
/* What both sheets begin with. */
#define CASE_COLUMNS                                                                               \
    ENTRY(COLUMN_OF_WAVELENGTH(ROW, wavelength), .name = "wavelength", .flags = COLUMN_ECHO,       \
          .with = "wavelength", .help = "wavelength"),                                             \
        LENS_POSITION_COLUMN(ROW, position, COLUMN_BRIEF),                                         \
        ENTRY(COLUMN_OF_ANGLE(ROW, at.angle, "deg"), .name = "field",                              \
              .flags = COLUMN_BRIEF | COLUMN_ECHO | COLUMN_SPARSE,                                 \
              .help =                                                                              \
                  "angle of the chief ray as seen from the first vertex; absent from the film"),   \
        ENTRY(MM(at.object, COLUMN_BRIEF | COLUMN_ECHO | COLUMN_SPARSE), .name = "object",         \
              .help = "height of the object point; absent at infinity"),                           \
        ENTRY(MM(at.height, COLUMN_BRIEF | COLUMN_ECHO | COLUMN_SPARSE), .name = "height",         \
              .help = "of the point in the film; absent from the object"),                         \
        ENTRY(COLUMN_OF_ANGLE(ROW, at.angle_x, "deg"),                                             \
              .flags = COLUMN_EXTRA | COLUMN_BRIEF | COLUMN_ECHO, .with = "field-x",               \
              .name = "field_x", .label = "field x",                                               \
              .help = "angle in the x-z plane; on request, and where some is not 0"),              \
        ENTRY(MM(at.object_x, COLUMN_EXTRA | COLUMN_BRIEF), .with = "field-x", .name = "object_x", \
              .label = "object x", .help = "of the object point; absent at infinity"),             \
        ENTRY(MM(at.height_x, COLUMN_EXTRA | COLUMN_BRIEF | COLUMN_ECHO), .with = "height-x",      \
              .name = "height_x", .label = "height x", .help = "of the point in the film"),        \
        ENTRY(PLAIN(pupil, COLUMN_BRIEF), .name = "pupil", .help = "entrance or exit")

static const struct column columns[] = {
    CASE_COLUMNS,
    {MM(z, COLUMN_BRIEF | COLUMN_INFINITE), .name = "z",
     .help = "the paraxial pupil's place, from the first (last) vertex"},
    {MM(side.pupil.low[0], COLUMN_HIDDEN), .name = "x_min", .label = "x min",
     .help = "bounds in that plane; absent where the rays do not cross it"},
    {MM(side.pupil.high[0], COLUMN_BRIEF), .name = "x_max", .label = "x max", .help = "the same"},
    {MM(side.pupil.low[1], COLUMN_BRIEF), .name = "y_min", .label = "y min", .help = "the same"},
    {MM(side.pupil.high[1], COLUMN_BRIEF), .name = "y_max", .label = "y max", .help = "the same"},
    {MM(side.pupil.centre[0], COLUMN_HIDDEN), .name = "x", .help = "centroid there"},
    {MM(side.pupil.centre[1], COLUMN_HIDDEN), .name = "y", .help = "centroid there"},
    {PLAIN(side.pupil.area, COLUMN_HIDDEN), .name = "area_mm2", .label = "area",
     .help = "area there, mm^2; absent where the bundle folds over itself"},
    {MM(side.vertex.low[0], COLUMN_HIDDEN), .name = "vertex_x_min", .label = "vertex x min",
     .help = "bounds in the plane of the first (last) vertex"},
    {MM(side.vertex.high[0], COLUMN_HIDDEN), .name = "vertex_x_max", .label = "vertex x max",
     .help = "the same"},
    {MM(side.vertex.low[1], COLUMN_HIDDEN), .name = "vertex_y_min", .label = "vertex y min",
     .help = "the same"},
    {MM(side.vertex.high[1], COLUMN_HIDDEN), .name = "vertex_y_max", .label = "vertex y max",
     .help = "the same"},
    {PLAIN(side.vertex.area, COLUMN_HIDDEN), .name = "vertex_area_mm2", .label = "vertex area",
     .help = "area there, mm^2"},
    {PLAIN(projected, COLUMN_HIDDEN), .name = "projected_mm2", .label = "projected",
     .help = "area across the beam at the vertex, mm^2: of fields of 90 deg and more too"},
    {PLAIN(obstruction, COLUMN_SPARSE), .name = "obstruction", .label = "obstructed",
     .help = "share of that area within the edge that apertures block; absent where nothing may"},
    {PLAIN(fraction, COLUMN_BRIEF), .name = "fraction",
     .help = "area over that of the point on the axis"},
    {PLAIN(projected_fraction, COLUMN_HIDDEN), .name = "projected_fraction",
     .label = "projected fraction", .help = "projected area over that of the point on the axis"},
    {PLAIN(irradiance, COLUMN_SPARSE), .name = "irradiance_per_radiance", .label = "E/L",
     .help = "irradiance of the film per radiance of a uniform scene: integral of cos over the "
             "exit pupil's solid angle; absent for fields"},
    {PLAIN(illumination, COLUMN_BRIEF | COLUMN_SPARSE), .name = "illumination", .label = "E/E axis",
     .help = "irradiance over that on the axis"},
    {PLAIN(vignetting[PUPIL_UPPER], 0), .name = "vignetting_upper", .label = "upper",
     .help = "1 - y/radius of the uppermost ray in the stop: what vignetting takes there"},
    {PLAIN(vignetting[PUPIL_LOWER], 0), .name = "vignetting_lower", .label = "lower",
     .help = "the same below"},
    {PLAIN(vignetting[PUPIL_LEFT], COLUMN_HIDDEN), .name = "vignetting_left", .label = "left",
     .help = "the same to -x"},
    {PLAIN(vignetting[PUPIL_RIGHT], COLUMN_HIDDEN), .name = "vignetting_right", .label = "side",
     .help = "the same to +x"},
    {PLAIN(limit[PUPIL_UPPER], COLUMN_BRIEF), .name = "upper_surface", .label = "upper by",
     .help = "number of the surface that ends the pupil at y_max, the stop counted"},
    {PLAIN(limit[PUPIL_LOWER], COLUMN_BRIEF), .name = "lower_surface", .label = "lower by",
     .help = "at y_min"},
    {PLAIN(limit[PUPIL_LEFT], COLUMN_HIDDEN), .name = "left_surface", .label = "left by",
     .help = "at x_min"},
    {PLAIN(limit[PUPIL_RIGHT], COLUMN_HIDDEN), .name = "right_surface", .label = "right by",
     .help = "at x_max"},
    {MM(side.chief.point[0], COLUMN_HIDDEN), .name = "chief_x", .label = "chief x",
     .help = "chief ray, through the middle of the stop: a point, where it can in the plane of "
             "the first (last) vertex"},
    {MM(side.chief.point[1], COLUMN_HIDDEN), .name = "chief_y", .label = "chief y",
     .help = "the same"},
    {MM(side.chief.point[2], COLUMN_HIDDEN), .name = "chief_z", .label = "chief z",
     .help = "the same"},
    {PLAIN(side.chief.cosine[0], COLUMN_HIDDEN), .name = "chief_cos_x", .label = "chief cos x",
     .help = "its direction cosines, as light goes (from the film: backwards)"},
    {PLAIN(side.chief.cosine[1], COLUMN_HIDDEN), .name = "chief_cos_y", .label = "chief cos y",
     .help = "the same"},
    {PLAIN(side.chief.cosine[2], COLUMN_HIDDEN), .name = "chief_cos_z", .label = "chief cos z",
     .help = "the same"},
    {PLAIN(status, COLUMN_BRIEF), .name = "status",
     .help = "ok; chief_lost: rays arrive, not the chief ray; clipped, miss, total_reflection: "
             "nothing arrives"},
    {PLAIN(lost, COLUMN_SPARSE | COLUMN_BRIEF), .name = "surface", .label = "lost at surface",
     .help = "where the chief ray or all rays are lost"},
    {MM(at.film, COLUMN_HIDDEN | COLUMN_ECHO), .name = "film",
     .help = "where the film stands, from the last vertex; absent for fields"},
    {PLAIN(rays, COLUMN_EXTRA), .name = "rays", .help = "about how many were traced"},
    LENS_TITLE_COLUMN(ROW, lens),
    LENS_WARNING_COLUMN(ROW, warning),
};

static const struct column outline_columns[] = {
    CASE_COLUMNS,
    {PLAIN(point, COLUMN_BRIEF), .name = "point", .help = "number of the edge point, from 1"},
    {MM(z, COLUMN_HIDDEN | COLUMN_INFINITE), .name = "z",
     .help = "the paraxial pupil's place, from the first (last) vertex"},
    {MM(edge_x, COLUMN_BRIEF), .name = "x", .help = "in that plane"},
    {MM(edge_y, COLUMN_BRIEF), .name = "y", .help = "in that plane"},
    {MM(edge_vertex_x, COLUMN_BRIEF), .name = "vertex_x", .label = "vertex x",
     .help = "in the plane of the first (last) vertex"},
    {MM(edge_vertex_y, COLUMN_BRIEF), .name = "vertex_y", .label = "vertex y", .help = "the same"},
    {PLAIN(stop_x, COLUMN_BRIEF), .name = "stop_x", .label = "stop x",
     .help = "in the stop, in units of its radius"},
    {PLAIN(stop_y, COLUMN_BRIEF), .name = "stop_y", .label = "stop y", .help = "the same"},
    LENS_TITLE_COLUMN(ROW, lens),
    LENS_WARNING_COLUMN(ROW, warning),
};

static const struct sheet outline_sheet = SHEET(outline_columns, struct pupil_row);
static const struct sheet bounds_sheet = SHEET(columns, struct pupil_row);
static const struct sheet *const sheets[] = {&bounds_sheet, &outline_sheet, NULL};

static const struct sheet *pupil_choose_sheet(const void *data, const struct option_query *asking)
{
    (void)asking;
    return ((const struct pupil_input *)data)->outline > 0 ? &outline_sheet : &bounds_sheet;
}

/* What a row says of its point and its pupil, with everything else absent. */
static struct pupil_row pupil_row_of(const struct pupil_case *point, bool exit)
{
    const struct pupil_shape *shape = point->shape;
    const struct lens_case *one = point->one;
    struct pupil_row row;
    row_clear(&bounds_sheet, &row);
    row.pupil = exit ? "exit" : "entrance";
    row.position = one->setup->position;
    row.lens = one->setup->lens->title;
    row.warning = one->warning;
    row.wavelength = one->light.wavelength;
    row.at = *point;
    row.z = exit ? one->light.first.exit_pupil : one->light.first.entrance_pupil;
    row.obstruction = shape->is_empty ? (double)NAN : shape->obstruction;
    row.status = shape->status == RAY_OK && shape->has_chief ? "ok" : "chief_lost";
    row.status = shape->is_empty ? ray_status_name(shape->status) : row.status;
    row.lost = shape->surface > 0 ? (long)shape->surface : NO_INTEGER;
    row.rays = (long)shape->rays;
    row.side.pupil.area = 0; /* where nothing arrives */
    for (size_t i = 0; i < PUPIL_ENDS; i++) {
        row.vignetting[i] = shape->is_empty ? 1 : shape->vignetting[i];
    }
    return row;
}

static double ratio(double here, double axis, bool is_empty)
{
    return is_empty ? 0 : here / axis;
}

/* That the bundle folds, which leaves numbers absent, beside what else there is to say. */
static const char *pupil_fold_warning(const struct pupil_side *side, bool exit, const char *other,
                                      struct arena *arena)
{
    if (!side->pupil.folds && !side->vertex.folds) {
        return other;
    }
    const char *pupil = exit ? "the exit pupil" : "the entrance pupil";
    const char *vertex = exit ? "the last vertex" : "the first vertex";
    const char *text = arena_printf(
        arena,
        "the bundle folds over itself in the plane of %s%s%s: its area and centroid there are "
        "absent, as are bounds that a fold makes",
        side->pupil.folds ? pupil : "", side->pupil.folds && side->vertex.folds ? " and of " : "",
        side->vertex.folds ? vertex : "");
    return lens_warnings_join(other, text, arena);
}

static struct pupil_row bounds_row(const struct pupil_case *point, bool exit, struct arena *arena)
{
    const struct pupil_shape *shape = point->shape, *axis = point->axis;
    const struct pupil_side *side = exit ? &shape->exit : &shape->entrance;
    const struct pupil_side *middle = exit ? &axis->exit : &axis->entrance;
    const struct first_order *first = &point->one->light.first;
    struct pupil_row row = pupil_row_of(point, exit);
    if (!shape->is_empty) {
        row.side = *side;
        for (size_t i = 0; i < PUPIL_ENDS; i++) {
            row.limit[i] = side->limit[i] > 0 ? (long)side->limit[i] : NO_INTEGER;
        }
        row.warning = pupil_fold_warning(side, exit, row.warning, arena);
        row.warning =
            lens_warnings_join(row.warning, lens_island_warning(&shape->islands, arena), arena);
    }
    if (!axis->is_empty) {
        /* of a telecentric side the plane of the vertex */
        bool far = isnan(middle->pupil.area) && !middle->pupil.folds;
        row.fraction = far ? ratio(row.side.vertex.area, middle->vertex.area, shape->is_empty)
                           : ratio(row.side.pupil.area, middle->pupil.area, shape->is_empty);
        row.projected_fraction = ratio(shape->projected, axis->projected, shape->is_empty);
    }
    row.projected = shape->projected;
    if (point->from_film) {
        double n = first->index_image / first->index_object;
        row.irradiance = shape->is_empty ? 0 : n * n * shape->cosine_area;
        row.illumination = axis->is_empty ? (double)NAN : shape->cosine_area / axis->cosine_area;
    }
    return row;
}

static bool emit_outline(const struct pupil_case *point, bool exit, long count, struct run *run)
{
    const struct pupil_shape *shape = point->shape;
    const struct pupil_side *side = exit ? &shape->exit : &shape->entrance;
    struct pupil_row row = pupil_row_of(point, exit);
    for (long i = 0; i < count && !shape->is_empty; i++) {
        size_t edge = (size_t)i * shape->count / (size_t)count;
        const double(*pupil)[2] = side->pupil.outline, (*vertex)[2] = side->vertex.outline;
        row.point = i + 1;
        row.edge_x = pupil != NULL ? pupil[edge][0] : (double)NAN;
        row.edge_y = pupil != NULL ? pupil[edge][1] : (double)NAN;
        row.edge_vertex_x = vertex != NULL ? vertex[edge][0] : (double)NAN;
        row.edge_vertex_y = vertex != NULL ? vertex[edge][1] : (double)NAN;
        row.stop_x = shape->stop[edge][0];
        row.stop_y = shape->stop[edge][1];
        if (!run_emit(run, &row)) {
            return false;
        }
    }
    return true;
}

static bool pupil_run(const void *data, struct run *run, struct error *error)
{
    const struct pupil_input *input = data;
    struct pupil_cursor at;
    if (run->state == NULL) {
        run->state = pupil_memo_new(run->kept);
    }
    pupil_begin(&at, input, run->state, input->outline > 0 ? PUPIL_EDGES : 0, run->arena);
    while (pupil_next(&at, error)) {
        for (int exit = 0; exit < 2; exit++) {
            if (input->side == (exit ? SIDE_ENTRANCE : SIDE_EXIT)) {
                continue;
            }
            if (input->outline > 0) {
                if (!emit_outline(&at.point, exit, input->outline, run)) {
                    return true;
                }
                continue;
            }
            const struct pupil_row row = bounds_row(&at.point, exit, run->arena);
            if (!run_emit(run, &row)) {
                return true;
            }
        }
    }
    return error->code == ERROR_NONE;
}

static bool pupil_brings(const void *data, const char *option)
{
    const struct pupil_input *input = data;
    const struct lens *lens = input->question.lens.lens;
    return !pupil_is_from_film(input) && isnan(input->question.field) &&
           strcmp(option, "field-x") == 0 && lens != NULL && lens_has_fields_beside(lens);
}

/* -------- the drawing -------- */

static bool pupil_draw(const struct artifact_job *job, struct output *sink, struct error *error)
{
    struct svg svg = {.arena = job->run->arena};
    struct arena *arena = svg.arena;
    struct pupil_outline *shapes = NULL;
    size_t count = 0, room = 0;
    const char *title = NULL;
    for (size_t i = 0; i < job->count; i++) {
        const struct pupil_input *input = job->inputs[i];
        /* cases of one input: each says which it is */
        const bool several =
            lens_positions_several(input->question.lens.lens, input->question.position);
        struct pupil_cursor at;
        pupil_begin(&at, input, NULL, PUPIL_EDGES, arena);
        while (pupil_next(&at, error)) {
            /* The point on the axis, for comparison, then each point. */
            const struct pupil_shape *shape = at.point.shape;
            const struct lens_case *one = at.point.one;
            shapes = arena_grow(arena, shapes, count, &room, sizeof *shapes);
            const char *words = pupil_point_words(&at.point, arena);
            struct pupil_outline outline = {.label = words,
                                            .dashed = at.point.axis->across,
                                            .dashed_count =
                                                at.point.axis->is_empty ? 0 : at.point.axis->count};
            if (several) {
                outline.label = arena_printf(
                    arena, "%s%s%.4g nm, %s",
                    one->setup->position != NULL ? one->setup->position : "",
                    one->setup->position != NULL ? ", " : "", 1000 * one->light.wavelength, words);
            }
            if (shape->is_empty) {
                outline.note = arena_printf(arena, "nothing: %s at %zu",
                                            ray_status_name(shape->status), shape->surface);
            } else {
                outline.points = shape->across;
                outline.count = shape->count;
                outline.note = arena_printf(arena, "%.4g mm\xc2\xb2, %.3g %%", shape->projected,
                                            100 * shape->projected / at.point.axis->projected);
            }
            title = one->setup->lens->title;
            shapes[count++] = outline;
        }
        if (error->code != ERROR_NONE) {
            return false;
        }
    }
    const struct pupil_input *first = job->inputs[0];
    bool film = pupil_is_from_film(first);
    const struct outlines outlines = {
        .title = arena_printf(arena, "Pupils of %s", title),
        .subtitle = film ? "exit pupil as points of the film see it, across the way to its middle; "
                           "origin: the chief ray"
                         : "entrance pupil as field points see it, across the ray to the first "
                           "vertex; origin: the chief ray",
        .unit = "mm",
        .legend = {"what arrives", "from the axis: 100 %"},
        .shapes = shapes,
        .count = count,
    };
    return outlines_draw(&outlines, &svg, error) && drawing_write(job, &svg, sink, error);
}

static const struct artifact artifacts[] = {
    {ARTIFACT_OPTION("plot", drawing_types, "draw the pupils as the points see them"),
     .scope = ARTIFACT_OF_SWEEP, .make = pupil_draw},
};

static const struct explanation explanations[] = {
    {"fraction", "{fraction} = area/area on the axis, in the plane of the paraxial pupil",
     "exact rays at the corners of the edge and at Gauss points between them",
     "what blocks light within the edge is taken out of areas, not of bounds"},
    {"irradiance_per_radiance", "E/L = integral of cos(theta) dw over the clear exit pupil",
     "[Welford86]", "a uniform scene; no loss in glass"},
    {NULL, NULL, NULL, NULL},
};

static const struct example examples[] = {
    {"pupil double-gauss", "both pupils for the fields of the lens"},
    {"pupil fisheye-16 --field 75deg", "a fisheye near the edge of its field"},
    {"pupil double-gauss --height 0..21.6:7.2 --side exit --csv",
     "bounds of the exit pupil by film radius, for a renderer"},
    {"pupil nikkor-z-14-24 --position all --plot pupils.svg", "cat's eyes, drawn"},
    {NULL, NULL},
};

const struct command command_pupil = {
    .name = "pupil",
    COMMAND_OF("a lens", "shapes and bounds of the entrance and exit pupil"),
    .run = pupil_run,
    .choose_sheet = pupil_choose_sheet,
    .sheets = sheets,
    .makes_many = command_always_many,
    .brings = pupil_brings,
    COMMAND_MAKES(artifacts),
    .most_answers = 100000,
};
