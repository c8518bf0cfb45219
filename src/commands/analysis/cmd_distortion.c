/* commands/analysis/cmd_distortion.c - lenscalc distortion: image heights against a projection. */
/* SPDX-License-Identifier: MIT */
#include "commands/analysis/distortion_models.h"

#include "draw/grid_image.h"
#include "draw/panels.h"

#include <string.h>

/* The farthest field of the lens, but the one that is asked for. */
static const struct analysis_policy *distortion_view_policy_of(const struct distortion_input *input)
{
    const struct analysis_question *question = &input->question;
    const bool asked = analysis_is_given(question->field, question->field_x) ||
                       analysis_is_given(question->height, question->height_x);
    return asked ? &distortion_by_field : &distortion_as_whole;
}

/* -------- curves -------- */

enum { POINTS = 65, MOST_PANELS = 60, MOST_KEYS = 24 };

/* Distortion over the field, of one lens in one position at one wavelength. */
struct distortion_view_curve {
    size_t panel, key;
    double edge; /* rad or mm */
    double *x, *y;
};

struct distortion_view_curves {
    const struct distortion_input *input; /* the one at work */
    struct arena *arena;
    const char *panels[MOST_PANELS], *keys[MOST_KEYS];
    size_t panel_count, key_count, count, room;
    struct distortion_view_curve *all;
    const char *subtitle;
    bool is_far;
};

/* The place of a text in a list, to which it is added; `most` where there is no room. */
static size_t view_place_of(const char **list, size_t *count, size_t most, const char *text)
{
    size_t i = 0;
    while (i < *count && strcmp(list[i], text) != 0) {
        i++;
    }
    if (i == *count && i < most) {
        list[(*count)++] = text;
    }
    return i;
}

static const char *panel_words(const struct setup *setup)
{
    const char *title = setup->lens->title != NULL ? setup->lens->title : "lens";
    return setup->position != NULL ? arena_printf(setup->arena, "%s, %s", title, setup->position)
                                   : title;
}

/* The light, and what else may be asked for in lists. */
static const char *key_words(const struct distortion_input *input, const struct analysis_case *one)
{
    const double defocus = one->question->defocus, object = one->question->object;
    struct arena *arena = one->setup->arena;
    const char *words =
        arena_printf(arena, "%.5g nm", 1000 * one->setup->wavelengths[0].wavelength);
    if (input->projection > 0) {
        words = ARENA_JOIN(arena, words, ", ", projections[input->projection - 1].word);
    }
    if (!isnan(object)) {
        words = arena_printf(arena, "%s, object at %.4g mm", words, object);
    }
    return isnan(defocus) ? words : arena_printf(arena, "%s, defocus %.4g mm", words, defocus);
}

/* "rectilinear, f 100.7 mm at 587.56 nm": what the distortion is the difference from. */
static const char *ideal_words(const struct distortion_case *ready, struct arena *arena)
{
    const char *how = isnan(ready->calibrated) ? "" : "calibrated ";
    return isnan(ready->focal)
               ? arena_printf(arena, "against %smagnification %.6g", how, ready->map.scale)
               : arena_printf(arena, "against the %s image of %sfocal length %.6g mm",
                              ready->projection, how, ready->map.scale);
}

/* Of curves of the same place and light the longest one. */
static struct distortion_view_curve *room_for(struct distortion_view_curves *curves, size_t panel,
                                              size_t key, double edge)
{
    for (size_t i = 0; i < curves->count; i++) {
        struct distortion_view_curve *old = &curves->all[i];
        if (old->panel == panel && old->key == key) {
            return old->edge < edge ? old : NULL;
        }
    }
    curves->all =
        arena_grow(curves->arena, curves->all, curves->count, &curves->room, sizeof *curves->all);
    struct distortion_view_curve *curve = &curves->all[curves->count++];
    *curve = (struct distortion_view_curve){.panel = panel,
                                            .key = key,
                                            .x = ARENA_ARRAY(curves->arena, POINTS, double),
                                            .y = ARENA_ARRAY(curves->arena, POINTS, double)};
    return curve;
}

static bool distortion_view_add_curve(struct distortion_view_curves *curves,
                                      const struct analysis_case *one, struct error *error)
{
    const struct setup *setup = one->setup;
    struct distortion_case ready;
    double towards[2], edge;
    if (!distortion_ready(curves->input, one, NULL, &ready, error) ||
        !distortion_direction(&ready.map, &setup->fields[0].point, towards, &edge, error)) {
        return false;
    }
    const size_t panel =
        view_place_of(curves->panels, &curves->panel_count, MOST_PANELS, panel_words(setup));
    const size_t key =
        view_place_of(curves->keys, &curves->key_count, MOST_KEYS, key_words(curves->input, one));
    if (panel == MOST_PANELS || key == MOST_KEYS) {
        return fail(error, ERROR_USAGE, "{--plot} has room for %d lenses and %d kinds of light",
                    MOST_PANELS, MOST_KEYS);
    }
    const bool far = setup->object.is_infinite;
    if (curves->count > 0 && far != curves->is_far) {
        return fail(error, ERROR_USAGE,
                    "{--plot}: fields of near objects and of those at infinity share no axis");
    }
    struct distortion_view_curve *curve = edge > 0 ? room_for(curves, panel, key, edge) : NULL;
    if (curve == NULL) {
        return true;
    }
    curve->edge = edge;
    curves->is_far = far;
    /* of several lenses or projections the curves name themselves */
    const char *which = isnan(ready.calibrated) ? "paraxial" : "calibrated";
    if (curves->count == 1) {
        curves->subtitle = ARENA_JOIN(curves->arena, ideal_words(&ready, curves->arena), "; ",
                                      analysis_figure_words(one, FIGURE_PLANE, curves->arena));
    } else if (curves->input->projection > 0) {
        curves->subtitle =
            arena_printf(curves->arena, "against ideal images of the %s focal length", which);
    } else {
        curves->subtitle = arena_printf(
            curves->arena, "against the %s image of the %s focal length", ready.projection, which);
    }
    /* Fields whose chief ray is lost are gaps; false with the reason where that are all. */
    bool any = false;
    for (size_t i = 0; i < POINTS; i++) {
        const double share = i > 0 ? (double)i / (POINTS - 1) : 1e-4;
        struct distortion_point point;
        const double amount = share * curve->edge;
        bool found = distortion_towards(&ready.map, towards, amount, &point, error);
        curve->x[i] = found ? point.percent : (double)NAN;
        curve->y[i] = ready.map.setup.object.is_infinite ? amount * DEGREES_PER_RADIAN : amount;
        any = any || found;
    }
    return any;
}

static bool distortion_plot(const struct artifact_job *job, struct output *sink,
                            struct error *error)
{
    struct svg svg = {.arena = job->run->arena};
    struct distortion_view_curves curves = {.arena = job->run->arena};
    for (size_t i = 0; i < job->count; i++) {
        curves.input = job->inputs[i];
        struct analysis_cursor at =
            analysis_begin(curves.input, distortion_view_policy_of(curves.input), job->run);
        while (analysis_next_case(&at, error)) {
            if (!distortion_view_add_curve(&curves, at.one, error)) {
                return false;
            }
        }
        if (error->code != ERROR_NONE) {
            return false;
        }
    }
    if (curves.count == 0) {
        return fail(error, ERROR_DOMAIN, "{--plot}: no field lies off the axis");
    }
    struct arena *arena = curves.arena;
    struct panel *panels = ARENA_ARRAY(arena, curves.panel_count, struct panel);
    for (size_t p = 0; p < curves.panel_count; p++) {
        struct panel_series *series = ARENA_ARRAY(arena, curves.count, struct panel_series);
        const bool is_one = curves.panel_count == 1; /* the title of the page names it */
        panels[p] = (struct panel){.title = is_one ? NULL : curves.panels[p], .series = series};
        for (size_t i = 0; i < curves.count; i++) {
            const struct distortion_view_curve *curve = &curves.all[i];
            if (curve->panel == p) {
                series[panels[p].count++] = (struct panel_series){
                    .x = curve->x, .y = curve->y, .count = POINTS, .key = curve->key};
            }
        }
    }
    const size_t count = curves.panel_count;
    const bool one = curves.panel_count == 1;
    const struct panels page = {
        .title = one ? ARENA_JOIN(curves.arena, "Distortion of ", curves.panels[0]) : "Distortion",
        .subtitle = curves.key_count > 1
                        ? curves.subtitle
                        : ARENA_JOIN(curves.arena, curves.keys[0], "; ", curves.subtitle),
        .x_label = "distortion (%)",
        .y_label = curves.is_far ? "field (deg)" : "object height (mm)",
        .keys = curves.key_count > 1 ? curves.keys : NULL,
        .key_count = curves.key_count,
        .columns = count < 4 ? count : 4,
        .panels = panels,
        .count = count};
    return panels_draw(&page, &svg, error) && drawing_write(job, &svg, sink, error);
}

/* -------- a grid -------- */

enum { LINES = 11, PIECES = 4, LINE_POINTS = (LINES - 1) * PIECES + 1 };

static bool distortion_grid_check(const struct artifact_job *job, struct error *error)
{
    const struct distortion_input *input = job->inputs[0];
    return !lens_positions_several(input->question.lens.lens, input->question.position) ||
           fail(error, ERROR_USAGE, "{--grid} shows one position: name it with {--position}");
}

static bool distortion_grid(const struct artifact_job *job, struct output *sink,
                            struct error *error)
{
    struct svg svg = {.arena = job->run->arena};
    const struct distortion_input *input = job->inputs[0];
    struct analysis_cursor at = analysis_begin(input, distortion_view_policy_of(input), job->run);
    if (!analysis_next_case(&at, error)) {
        return false;
    }
    const struct setup *setup = at.one->setup;
    struct arena *arena = setup->arena;
    struct distortion_case ready;
    struct distortion_point corner;
    const size_t count = 2 * (size_t)LINES * LINE_POINTS;
    double *x = ARENA_ARRAY(arena, count, double), *y = ARENA_ARRAY(arena, count, double);
    if (!distortion_ready(input, at.one, NULL, &ready, error) ||
        !distortion_at(&ready.map, &setup->fields[0].point, &corner, error)) {
        return false;
    }
    if (!(corner.field > 0)) {
        return fail(error, ERROR_DOMAIN, "{--grid}: the field lies on the axis");
    }
    const bool far = setup->object.is_infinite;
    const struct grid_image grid = {
        .title = arena_printf(arena, "Distortion of %s", panel_words(setup)),
        .subtitle = arena_printf(arena, "a square grid %s", ideal_words(&ready, arena)),
        .note = arena_printf(arena, "%s; corners at a field of %.4g %s, distortion %+.3g %%",
                             key_words(input, at.one),
                             far ? corner.field * DEGREES_PER_RADIAN : corner.field,
                             far ? "deg" : "mm", corner.percent),
        .ideal_label = "ideal image",
        .image_label = "exact chief rays",
        .lines = LINES,
        .points = LINE_POINTS,
        .half = fabs(corner.ideal) / sqrt(2),
        .x = x,
        .y = y,
    };
    /* Every point of the grid; lost ones are gaps. */
    for (size_t i = 0; i < 2 * (size_t)LINES * LINE_POINTS; i++) {
        const size_t line = i / LINE_POINTS % LINES;
        const double along = grid.half * (2 * (double)(i % LINE_POINTS) / (LINE_POINTS - 1) - 1);
        const double across = grid.half * (2 * (double)line / (LINES - 1) - 1);
        const bool is_upright = i < (size_t)LINES * LINE_POINTS;
        const double ideal[2] = {is_upright ? across : along, is_upright ? along : across};
        double image[2];
        bool found = distortion_of_ideal(&ready.map, ideal, image, error);
        x[i] = found ? image[0] : (double)NAN;
        y[i] = found ? image[1] : (double)NAN;
    }
    return grid_image_draw(&grid, &svg, error) && drawing_write(job, &svg, sink, error);
}

/* "auto", then those of photo/fov.h. */
static const struct word *projection_word_at(size_t i)
{
    static const struct word automatic = {
        "auto", "that of the lens: of fields from 60 degrees the nearest, else rectilinear"};
    if (i == 0) {
        return &automatic;
    }
    if (i <= PROJECTIONS) {
        return &projections[i - 1];
    }
    return NULL;
}

/* "none", then the models. */
static const struct word *fit_word_at(size_t i)
{
    static const struct word none = {"none", "field by field, no model"};
    if (i == 0) {
        return &none;
    }
    if (i <= DISTORTION_MODELS) {
        return &distortion_models[i - 1].word;
    }
    return NULL;
}

static const struct option options[] = {
    ANALYSIS_OPTIONS(LENS_PRIMARY_WAVELENGTH, ""),
    ANALYSIS_FIELD_OPTIONS,
    {OPTION(struct distortion_input, projection), .name = "projection",
     .word_at = projection_word_at, .fallback = "auto", .value = "KIND",
     .help = "the ideal image that distortion is measured against"},
    {OPTION(struct distortion_input, calibrated), .name = "calibrated",
     .help = "compare with the focal length that makes the largest and the smallest distortion "
             "over the field of the lens equal and opposite; with --fit, with the one that fits "
             "best"},
    {OPTION(struct distortion_input, aspect), .name = "aspect", .column = "aspect",
     .quantity = "aspect ratio", .dimension = &dimension_ratio, OPTION_POSITIVE,
     .flags = OPTION_ABOVE_LOWEST | OPTION_NO_INFINITY, .value = "RATIO", .excludes = "fit",
     .help = "TV distortion of a picture whose corners lie at the field: its width over its "
             "height, 3:2"},
    {OPTION(struct distortion_input, fit), .name = "fit", .word_at = fit_word_at,
     .fallback = "none", .value = "MODEL", .excludes = "field field-x height height-x",
     .help = "fit the coefficients with which other programs correct distortion, over the diagonal "
             "of the "
             "sensor"},
    {OPTION(struct distortion_input, sensor), .name = "sensor", .column = "sensor",
     .fallback = "35mm", .value = "NAME|WxH", .wants = "fit!=none",
     .help = "format or camera by name, or a size: 36x24mm"},
    {OPTION(struct distortion_input, pitch), .name = "pitch", .quantity = "pixel pitch",
     .column = "pitch", .dimension = &dimension_length, .unit = "um", OPTION_POSITIVE,
     .flags = OPTION_ABOVE_LOWEST | OPTION_NO_INFINITY, .value = "LENGTH", .wants = "fit!=none",
     .usual = {0.3e-3, 30e-3}, .unusual = "pixels are 0.3 to 30 um wide: is the unit right?",
     .help = "pixel pitch (otherwise that of the camera, else 6000 pixels along the longer side)"},
};

struct distortion_row {
    struct analysis_point point;
    double angle, object;        /* rad, mm: of the field; the one it has */
    double ideal, image, x, y;   /* mm */
    double distortion;           /* of 1 */
    double focal, magnification; /* paraxial */
    double calibrated_focal, calibrated_magnification;
    double aspect;
    struct tv_distortion tv;
    const char *projection;
};

#define LENGTH(member_name, more)                                                                  \
    COLUMN_OF_LENGTH(struct distortion_row, member_name, "mm"), .flags = (more)

static const struct column columns[] = {
    ANALYSIS_ROW_COLUMNS,
    {COLUMN_OF_ANGLE(struct distortion_row, angle, "deg"), .name = "angle", .flags = COLUMN_SPARSE,
     .symbol = "t", .label = "angle from the axis",
     .help = "field angle in object space; absent for a near object"},
    {LENGTH(object, COLUMN_SPARSE), .name = "object_height", .symbol = "h",
     .label = "object height", .help = "height of the object point; absent at infinity"},
    {LENGTH(ideal, COLUMN_BRIEF), .name = "ideal_height", .symbol = "yp", .label = "ideal height",
     .help = "image height of the ideal projection"},
    {LENGTH(image, COLUMN_BRIEF), .name = "image_height", .symbol = "y", .label = "image height",
     .help = "where the chief ray meets the image plane"},
    {COLUMN(struct distortion_row, distortion), .dimension = &dimension_ratio, .unit = "percent",
     .flags = COLUMN_BRIEF, .name = "distortion", .symbol = "D",
     .help = "image height less ideal height, over that; absent on the axis"},
    {COLUMN(struct distortion_row, aspect), .name = "aspect", .with = "aspect",
     .flags = COLUMN_ECHO | COLUMN_EXTRA, .help = "width over height of the picture"},
    {COLUMN(struct distortion_row, tv.smia), .dimension = &dimension_ratio, .unit = "percent",
     .flags = COLUMN_EXTRA | COLUMN_BRIEF, .with = "aspect", .name = "tv_smia",
     .label = "TV distortion (SMIA)",
     .help = "how much higher the sides of that picture are than its middle"},
    {COLUMN(struct distortion_row, tv.traditional), .dimension = &dimension_ratio,
     .unit = "percent", .flags = COLUMN_EXTRA | COLUMN_BRIEF, .with = "aspect", .name = "tv",
     .label = "TV distortion", .help = "how far its long edges are bent, over its height: half"},
    {LENGTH(x, COLUMN_HIDDEN), .name = "image_x", .label = "image x",
     .help = "of the chief ray in the image plane"},
    {LENGTH(y, COLUMN_HIDDEN), .name = "image_y", .label = "image y", .help = "upwards"},
    {COLUMN(struct distortion_row, projection), .name = "projection", .flags = COLUMN_ASSUMED,
     .depends = "projection", .help = "of the ideal image"},
    {LENGTH(focal, COLUMN_ASSUMED), .name = "focal", .symbol = "f", .depends = "lens position",
     .label = "focal length",
     .help = "paraxial, at the primary wavelength; absent for a near object"},
    {COLUMN(struct distortion_row, magnification), .flags = COLUMN_ASSUMED, .name = "magnification",
     .symbol = "m", .depends = "lens position object",
     .help = "paraxial, at the primary wavelength; absent for an object at infinity"},
    {LENGTH(calibrated_focal, COLUMN_ASSUMED | COLUMN_EXTRA), .with = "calibrated",
     .name = "calibrated_focal", .depends = "calibrated", .label = "calibrated focal length",
     .help = "that of the ideal heights: its largest and smallest distortion over the field of "
             "the lens are equal and opposite"},
    {COLUMN(struct distortion_row, calibrated_magnification),
     .flags = COLUMN_ASSUMED | COLUMN_EXTRA, .with = "calibrated",
     .name = "calibrated_magnification", .depends = "calibrated",
     .label = "calibrated magnification", .help = "the same for a near object"},
    ANALYSIS_TAIL_COLUMNS,
};

static const struct sheet field_sheet = SHEET(columns, struct distortion_row);
static const struct sheet *const sheets[] = {&field_sheet, &distortion_fit_sheet, NULL};

/* TV distortion of the picture whose corners lie at the ideal height of the row. */
static bool distortion_row_frame(const struct distortion_case *ready, double aspect,
                                 struct distortion_row *row)
{
    struct error ignored = {0};
    const double half = fabs(row->ideal) / hypot(1, aspect);
    const double sides[2] = {aspect * half, half};
    row->aspect = aspect;
    return !(half > 0) || tv_distortion_find(&ready->map, sides, &row->tv, &ignored);
}

static bool distortion_run(const void *data, struct run *run, struct error *error)
{
    const struct distortion_input *input = data;
    analysis_doubt_aperture(&input->question, run->doubts);
    if (input->fit > 0) {
        return distortion_fit_run(input, run, error);
    }
    if (run->state == NULL) {
        run->state = distortion_memo_new(run->kept);
    }
    struct analysis_cursor at = analysis_begin(input, &distortion_by_field, run);
    while (analysis_next(&at, error)) {
        struct distortion_case ready;
        struct distortion_point found;
        struct distortion_row row;
        const bool is_there =
            distortion_ready(input, at.one, run->state, &ready, error) &&
            distortion_at(&ready.map, &at.one->setup->fields[at.field].point, &found, error);
        if (!is_there && !analysis_keep_lost(&at, error)) {
            return false;
        }
        analysis_begin_row(&at, &field_sheet, &row);
        if (is_there) {
            const bool far = ready.map.setup.object.is_infinite;
            if (far) {
                row.angle = found.field;
                row.calibrated_focal = ready.calibrated;
            } else {
                row.object = found.field;
                row.calibrated_magnification = ready.calibrated;
            }
            row.ideal = found.ideal;
            row.image = found.height;
            row.x = found.image[0] + 0.0;
            row.y = found.image[1] + 0.0;
            row.distortion = found.percent / 100;
            row.focal = ready.focal;
            row.magnification = ready.magnification;
            row.projection = ready.projection;
            if (!isnan(input->aspect) && input->projection == 0 &&
                strcmp(ready.projection, projections[0].word) != 0) {
                return fail(error, ERROR_USAGE,
                            "{--aspect} measures straight edges, and auto is %s here: say which "
                            "by {--projection}",
                            ready.projection);
            }
            if (!isnan(input->aspect) && !distortion_row_frame(&ready, input->aspect, &row)) {
                analysis_warn(&at, &row.point, "some of the picture has no chief ray");
            }
            analysis_warn(&at, &row.point,
                          found.is_lit ? NULL
                                       : "clear apertures stop the chief ray of some field: what "
                                         "light there is lies beside it");
        }
        if (!run_emit(run, &row)) {
            return true;
        }
    }
    return error->code == ERROR_NONE;
}

static const struct sheet *distortion_choose_sheet(const void *data,
                                                   const struct option_query *asking)
{
    const struct distortion_input *input = data;
    (void)asking;
    return input->fit > 0 ? &distortion_fit_sheet : &field_sheet;
}

static bool distortion_makes_many(const void *data)
{
    const struct distortion_input *input = data;
    return input->fit > 0 || analysis_several(input);
}

static bool distortion_brings(const void *data, const char *option)
{
    const struct distortion_input *input = data;
    return input->fit == 0 && analysis_brings(&input->question, option);
}

static const struct artifact artifacts[] = {
    {.option = {.kind = &kind_text,
                .name = "output",
                .letter = 'o',
                .value = "FILE",
                .flags = OPTION_FILE,
                .types = distortion_file_types,
                .wants = "fit!=none",
                .help = "write what --fit found: for lensfun (.xml) poly3, poly5 or ptlens, for "
                        "OpenCV (.yml) opencv, opencv-rational or fisheye; rows go to standard "
                        "output"},
     .is_kept = true,
     .check = distortion_fit_check,
     .make = distortion_fit_save},
    {ARTIFACT_OPTION("grid", drawing_types,
                     "draw a square grid as the lens images it, its corners at the largest field"),
     .scope = ARTIFACT_OF_ANSWER, .check = distortion_grid_check, .make = distortion_grid},
    {ARTIFACT_OPTION("plot", drawing_types, "draw the distortion against the field"),
     .scope = ARTIFACT_OF_SWEEP, .make = distortion_plot},
};

#define FITTED    "; least squares over the radius"
#define HALF_SIDE ", r = 1 at half the shorter side"

static const struct explanation explanations[] = {
    {"ideal_height projection=rectilinear",
     "yp = n {f} tan {t}; of a near object m h; calibrated: with that focal length",
     "the definition of the projection", NULL},
    {"ideal_height projection=equidistant", "yp = n {f} {t}", "the definition of the projection",
     NULL},
    {"ideal_height projection=equisolid", "yp = 2 n {f} sin({t}/2)",
     "the definition of the projection", NULL},
    {"ideal_height projection=stereographic", "yp = 2 n {f} tan({t}/2)",
     "the definition of the projection", NULL},
    {"ideal_height projection=orthographic", "yp = n {f} sin {t}",
     "the definition of the projection", NULL},
    {"image_height", "y = where the ray through the centre of the stop meets the image plane",
     "Snell's law in vectors, [Welford86]", "clear apertures do not stop it"},
    {"distortion", "D = ({y} - {yp})/{yp}", "[Welford86]", NULL},
    {"tv_smia", "TV = ((A1 + A2)/2 - B)/B, A1 and A2 heights of the sides, B of the middle",
     "[Imatest22], SMIA's TV distortion",
     "of the picture whose corners the projection images at {yp}"},
    {"rms_pixels model=brown", "of r_u = r_d (1 + k1 r_d^2 + k2 r_d^4 + k3 r_d^6), r in mm" FITTED,
     "[Brown71]", "the inverse is another polynomial of the same kind"},
    {"rms_pixels model=opencv",
     "of r_d = r_u (1 + k1 r_u^2 + k2 r_u^4 + k3 r_u^6), r over f" FITTED, "[OpenCV], p1 = p2 = 0",
     "the inverse is another polynomial of the same kind"},
    {"rms_pixels model=opencv-rational",
     "of r_d = r_u (1 + k1 r_u^2 + k2 r_u^4 + k3 r_u^6)/(1 + k4 r_u^2 + k5 r_u^4 + k6 r_u^6), r "
     "over f" FITTED,
     "[OpenCV], p1 = p2 = 0", "the inverse is another quotient of the same kind"},
    {"rms_pixels model=fisheye",
     "of t_d = t (1 + k1 t^2 + k2 t^4 + k3 t^6 + k4 t^8), r_d = f t_d" FITTED, "[OpenCV]",
     "the inverse is another polynomial of the same kind"},
    {"rms_pixels model=poly3", "of r_d = r_u (1 - k1 + k1 r_u^2)" HALF_SIDE FITTED, "[Lensfun]",
     "the inverse is another polynomial of the same kind"},
    {"rms_pixels model=poly5", "of r_d = r_u (1 + k1 r_u^2 + k2 r_u^4)" HALF_SIDE FITTED,
     "[Lensfun]", "the inverse is another polynomial of the same kind"},
    {"rms_pixels model=ptlens",
     "of r_d = r_u (a r_u^3 + b r_u^2 + c r_u + 1 - a - b - c)" HALF_SIDE FITTED, "[Lensfun]",
     "the inverse is another polynomial of the same kind"},
    {NULL, NULL, NULL, NULL},
};

static const struct example examples[] = {
    {"distortion double-gauss", "the distortion at each field of the lens"},
    {"distortion double-gauss --field 0..14#8 -w d,F,C", "a sweep, at three wavelengths"},
    {"distortion fisheye-16 --field 20,40,60,80deg --projection equidistant --calibrated",
     "a fisheye against f t, with the focal length that balances it"},
    {"distortion canon-nfd-70-210 --position all --plot zoom.svg", "a zoom, drawn"},
    {"distortion wide-35 --grid grid.svg", "a square grid through the lens"},
    {"distortion wide-35 --fit ptlens -o wide-35.xml", "a profile for lensfun"},
    {"distortion double-gauss-50 --fit opencv --pitch 4um", "coefficients for OpenCV"},
    {NULL, NULL},
};

const struct command command_distortion = {
    .name = "distortion",
    .stop_size_wants = "",
    .summary = "distortion of exact chief rays against an ideal projection",
    COMMAND_ASKS(struct distortion_input),
    .choose_sheet = distortion_choose_sheet,
    .sheets = sheets,
    .run = distortion_run,
    .explanations = explanations,
    COMMAND_MAKES(artifacts),
    .makes_many = distortion_makes_many,
    .group = "analyses",
    .brings = distortion_brings,
    .threads = analysis_threads,
    .varies = analysis_varies,
    .cell = "distortion_percent",
    .most_answers = 100000,
};
