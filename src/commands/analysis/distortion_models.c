/* commands/analysis/distortion_models.c - distortion --fit: coefficients, and files of them. */
/* SPDX-License-Identifier: MIT */
#include "commands/analysis/distortion_models.h"

#include "report/row.h"

#include <string.h>

/* -------- the lens beside the projection that is asked for -------- */

const struct analysis_policy distortion_by_field = {.wavelengths = WAVELENGTHS_PRIMARY,
                                                    .fields = FIELDS_ALL,
                                                    .one_wavelength = true,
                                                    .is_narrow = true};
const struct analysis_policy distortion_as_whole = {.wavelengths = WAVELENGTHS_PRIMARY,
                                                    .fields = FIELDS_EDGE,
                                                    .one_wavelength = true,
                                                    .is_narrow = true};

enum { KEPT = 16 };

/* What a calibrated scale depends on. */
struct calibrated_case {
    size_t lens; /* its serial number: another one may come to lie in the same place */
    const char *position;
    enum projection projection;
    enum field_kind edge_kind;
    double numbers[7];
};

struct distortion_memo {
    struct calibrated_case cases[KEPT];
    double scales[KEPT];
    size_t count; /* of all that were kept; the oldest give way */
};

struct distortion_memo *distortion_memo_new(struct arena *arena)
{
    return ARENA_NEW(arena, struct distortion_memo);
}

/* The field that is balanced: as far as the lens says it goes, whatever is asked for. */
static struct field_point distortion_asked_edge_of(const struct setup *setup)
{
    const struct lens *lens = setup->lens;
    struct field_point edge = {.kind = lens->field_kind, .value = {0, lens_field_extent(lens)}};
    return lens->field_count > 0 && edge.value[1] > 0 ? edge : setup->edge;
}

/* From which field angle on a lens may be made for another image than the rectilinear. */
static const double WIDE = 60 * PI / 180;

/* Of all projections the one that the lens images a field most nearly by; `otherwise`: none. */
static enum projection projection_nearest(const struct setup *setup, const struct field_point *edge,
                                          enum projection otherwise)
{
    enum projection nearest = otherwise;
    double least = INFINITY;
    for (int p = 0; p < PROJECTIONS; p++) {
        struct distortion_map map;
        struct distortion_point point;
        struct error ignored;
        if (distortion_open(setup, 0, (enum projection)p, setup->arena, &map, &ignored) &&
            distortion_at(&map, edge, &point, &ignored) && fabs(point.percent) < least) {
            least = fabs(point.percent);
            nearest = (enum projection)p;
        }
    }
    return nearest;
}

static enum projection projection_of(const struct distortion_input *input,
                                     const struct setup *setup)
{
    if (input->projection > 0) {
        return (enum projection)(input->projection - 1);
    }
    if (input->fit > 0) {
        return input->fit == 1 + MODEL_FISHEYE ? EQUIDISTANT : RECTILINEAR;
    }
    /* is there a field that no plane shows: of those asked for, or of the lens? */
    struct field_point edge = distortion_asked_edge_of(setup);
    double widest = edge.kind == FIELD_ANGLE ? edge.value[1] : 0;
    for (size_t i = 0; i < setup->field_count; i++) {
        const struct field_point *field = &setup->fields[i].point;
        const double angle = fmax(fabs(field->value[0]), fabs(field->value[1]));
        if (field->kind == FIELD_ANGLE && angle > widest) {
            widest = angle;
            edge = *field;
        }
    }
    const enum projection usual = widest >= PI / 2 ? EQUIDISTANT : RECTILINEAR;
    return widest >= WIDE ? projection_nearest(setup, &edge, usual) : usual;
}

/* Where a case is kept, or room for it. True: it was there. */
static bool recall_case(struct distortion_memo *memo, const struct calibrated_case *one,
                        double **scale)
{
    for (size_t i = 0; i < KEPT && i < memo->count; i++) {
        const struct calibrated_case *other = &memo->cases[i];
        bool same = one->lens == other->lens && one->position == other->position &&
                    one->projection == other->projection && one->edge_kind == other->edge_kind;
        for (size_t k = 0; k < sizeof one->numbers / sizeof one->numbers[0]; k++) {
            /* NaN, where there is no such number, is the same as no other */
            same = same && one->numbers[k] == other->numbers[k];
        }
        if (same) {
            *scale = &memo->scales[i];
            return true;
        }
    }
    *scale = &memo->scales[memo->count % KEPT];
    return false;
}

static bool find_calibrated(const struct distortion_input *input, const struct setup *setup,
                            struct distortion_memo *memo, struct distortion_case *ready,
                            struct error *error)
{
    const struct field_point edge = distortion_asked_edge_of(setup);
    const struct calibrated_case one = {
        .lens = input->question.lens.serial,
        .position = setup->position,
        .projection = projection_of(input, setup),
        .edge_kind = edge.kind,
        .numbers = {edge.value[0], edge.value[1], setup->wavelengths[0].wavelength, setup->image,
                    setup->object.is_infinite ? INFINITY : setup->object.distance.hi,
                    setup->first.stop_radius, setup->section},
    };
    double *kept = NULL;
    if (edge.kind == FIELD_NONE) {
        return fail(error, ERROR_DOMAIN,
                    "{--calibrated}: the lens states no field whose distortion could be balanced");
    }
    if (memo != NULL && recall_case(memo, &one, &kept)) {
        ready->calibrated = *kept;
    } else if (!distortion_calibrate(&ready->map, &edge, &ready->calibrated, error)) {
        return error_prefix(error, "{--calibrated}: ");
    } else if (memo != NULL) {
        memo->cases[memo->count++ % KEPT] = one;
        *kept = ready->calibrated;
    }
    ready->map.scale = ready->calibrated;
    return true;
}

bool distortion_ready(const struct distortion_input *input, const struct analysis_case *one,
                      struct distortion_memo *memo, struct distortion_case *ready,
                      struct error *error)
{
    const struct setup *setup = one->setup;
    const enum projection projection = projection_of(input, setup);
    *ready = (struct distortion_case){.focal = NAN,
                                      .magnification = NAN,
                                      .calibrated = NAN,
                                      .projection = projections[projection].word};
    if (!distortion_open(setup, 0, projection, setup->arena, &ready->map, error)) {
        return false;
    }
    if (setup->object.is_infinite) {
        ready->focal = ready->map.scale;
    } else {
        ready->magnification = ready->map.scale;
    }
    return !input->calibrated || input->fit > 0 ||
           find_calibrated(input, setup, memo, ready, error);
}

/* -------- rows -------- */

struct models_row {
    struct analysis_point point;
    const char *model, *direction, *form, *projection, *sensor, *resolution;
    double coefficients[9];
    double rms_pixels, max_pixels, rms, max; /* the last two in mm */
    double unit, focal, radius, pitch;       /* mm */
};

/* What the coefficients of all models are called. */
static const char *const coefficient_names[] = {"k1", "k2", "k3", "k4", "k5", "k6", "a", "b", "c"};

#define COEFFICIENT(i, called)                                                                     \
    ENTRY(COLUMN(struct models_row, coefficients[i]), .name = (called),                            \
          .flags = COLUMN_BRIEF | COLUMN_SPARSE, .label = (called), .help = "coefficient",         \
          .digits = 7)
#define LENGTH(member_name, in_unit, more)                                                         \
    COLUMN_OF_LENGTH(struct models_row, member_name, in_unit), .flags = (more)

static const struct column columns[] = {
    LENS_POSITION_COLUMN(struct models_row, point.position, COLUMN_BRIEF),
    ANALYSIS_DEFOCUS_COLUMN,
    ANALYSIS_WAVELENGTH_COLUMN,
    {COLUMN(struct models_row, model), .name = "model", .flags = COLUMN_BRIEF, .repeats = "fit",
     .help = "whose coefficients they are"},
    {COLUMN(struct models_row, direction), .name = "direction", .flags = COLUMN_BRIEF,
     .help = "distort: from the ideal image to the real one; undistort: back"},
    {COLUMN(struct models_row, form), .name = "form", .flags = COLUMN_BRIEF,
     .help = "published: as the model is defined; inverse: a polynomial of the same kind for the "
             "other direction"},
    COEFFICIENT(0, "k1"),
    COEFFICIENT(1, "k2"),
    COEFFICIENT(2, "k3"),
    COEFFICIENT(3, "k4"),
    COEFFICIENT(4, "k5"),
    COEFFICIENT(5, "k6"),
    COEFFICIENT(6, "a"),
    COEFFICIENT(7, "b"),
    COEFFICIENT(8, "c"),
    {COLUMN(struct models_row, rms_pixels), .name = "rms_pixels", .flags = COLUMN_BRIEF,
     .label = "RMS residual in pixels", .help = "what is left, over the radius of the picture"},
    {COLUMN(struct models_row, max_pixels), .name = "max_pixels", .flags = COLUMN_BRIEF,
     .label = "largest residual in pixels", .help = "the most that is left"},
    {LENGTH(rms, "um", 0), .name = "rms", .label = "RMS residual", .help = "the same in um"},
    {LENGTH(max, "um", 0), .name = "max", .label = "largest residual", .help = "the same in um"},
    {LENGTH(unit, "mm", 0), .name = "unit", .label = "r = 1 is",
     .help = "the length that the model's radius counts by"},
    {LENGTH(focal, "mm", 0), .name = "focal", .label = "focal length",
     .help = "of the ideal image: that of chief rays next to the axis; with --calibrated the one "
             "that fits best"},
    {LENGTH(radius, "mm", 0), .name = "radius", .label = "fitted radius",
     .help = "as far from the middle as the fit goes"},
    {COLUMN(struct models_row, projection), .name = "projection", .flags = COLUMN_ASSUMED,
     .depends = "projection fit", .help = "of the ideal image"},
    {COLUMN(struct models_row, sensor), .name = "sensor", .flags = COLUMN_ASSUMED,
     .depends = "sensor", .help = "format or camera"},
    {LENGTH(pitch, "um", COLUMN_ASSUMED), .name = "pitch", .depends = "pitch sensor",
     .label = "pixel pitch", .help = "spacing of the pixels"},
    {COLUMN(struct models_row, resolution), .name = "resolution", .flags = COLUMN_ASSUMED,
     .depends = "pitch sensor", .label = "pixels", .help = "of the picture"},
    ANALYSIS_TAIL_COLUMNS,
};

const struct sheet distortion_fit_sheet = SHEET(columns, struct models_row);

/* -------- one lens in one position -------- */

struct picture {
    struct sensor size;   /* with its pitch */
    double width, height; /* pixels */
};

static bool find_picture(const struct distortion_input *input, struct picture *picture,
                         struct error *error)
{
    enum { LONGER_SIDE = 6000 };
    const struct sensor *size = &input->sensor.size;
    picture->size = *size;
    if (!sensor_check(size, error)) {
        return false;
    }
    if (!isnan(input->pitch)) {
        picture->size.pitch = input->pitch;
    } else if (isnan(size->pitch)) {
        picture->size.pitch = fmax(size->width, size->height) / LONGER_SIDE;
    }
    picture->width = round(size->width / picture->size.pitch);
    picture->height = round(size->height / picture->size.pitch);
    return (picture->width >= 2 && picture->height >= 2) ||
           fail(error, ERROR_DOMAIN, "{pixel pitch} %.6g mm leaves no picture of %.6g x %.6g mm",
                picture->size.pitch, size->width, size->height);
}

struct distortion_models_found {
    struct picture picture;
    struct distortion_case ready;
    struct distortion_profile profile;
    struct distortion_fit fit;
};

static bool distortion_find(const struct distortion_input *input, const struct analysis_case *one,
                            struct distortion_models_found *found, struct error *error)
{
    struct arena *arena = one->setup->arena;
    const struct model_facts *facts = &distortion_models[input->fit - 1];
    const int wanted = input->projection - 1;
    if (wanted >= 0 && facts->projection != PROJECTIONS && wanted != (int)facts->projection) {
        return fail(error, ERROR_USAGE, "{--fit} %s is of %s images, not {--projection} %s",
                    facts->word.word, projections[facts->projection].word,
                    projections[wanted].word);
    }
    if (!find_picture(input, &found->picture, error) ||
        !distortion_ready(input, one, NULL, &found->ready, error)) {
        return false;
    }
    const double radius = sensor_diagonal(&found->picture.size) / 2;
    if (!distortion_trace(&found->ready.map, radius, arena, &found->profile, error)) {
        return false;
    }
    const struct distortion_question question = {.model = (enum distortion_model)(input->fit - 1),
                                                 .sensor = found->picture.size,
                                                 .focal = input->calibrated ? (double)NAN
                                                                            : found->profile.focal};
    if (distortion_fit(&found->profile, &question, arena, &found->fit, error)) {
        return true;
    }
    return found->profile.reached < 0.9 * radius
               ? error_hint(error,
                            "the image ends %.4g mm from its middle: {--sensor} may be of "
                            "a smaller one",
                            found->profile.reached)
               : false;
}

/* The row of one direction. */
static struct models_row models_row_of(const struct analysis_case *one,
                                       const struct distortion_models_found *found,
                                       enum distortion_way way)
{
    const struct model_facts *facts = &distortion_models[found->fit.model];
    const struct distortion_polynomial *polynomial = &found->fit.ways[way];
    const double pitch = found->picture.size.pitch;
    const double corner = sensor_diagonal(&found->picture.size) / 2;
    struct arena *arena = one->setup->arena;
    struct models_row row;
    row_clear(&distortion_fit_sheet, &row);
    row.point = analysis_point_of(one, 0);
    if (!(found->profile.reached >= corner * (1 - 1e-9))) {
        row.point.warning = lens_warnings_join(
            one->warning,
            arena_printf(arena,
                         "the image ends %.4g mm from its middle, the corner of the sensor is at "
                         "%.4g mm: the coefficients hold as far as the image goes",
                         found->profile.reached, corner),
            arena);
    }
    row.model = facts->word.word;
    row.direction = way == WAY_DISTORT ? "distort" : "undistort";
    row.form = way == facts->way ? "published" : "inverse";
    row.projection = found->ready.projection;
    row.rms = polynomial->rms;
    row.max = polynomial->largest;
    row.rms_pixels = polynomial->rms / pitch;
    row.max_pixels = polynomial->largest / pitch;
    row.unit = found->fit.unit;
    row.focal = found->fit.focal;
    row.radius = found->profile.reached;
    row.pitch = pitch;
    row.resolution =
        arena_printf(arena, "%.0f x %.0f", found->picture.width, found->picture.height);
    for (size_t j = 0; j < facts->terms; j++) {
        size_t k = 0;
        while (strcmp(coefficient_names[k], facts->names[j]) != 0) {
            k++;
        }
        row.coefficients[k] = polynomial->published[j];
    }
    return row;
}

bool distortion_fit_run(const struct distortion_input *input, struct run *run, struct error *error)
{
    struct analysis_cursor at = analysis_begin(input, &distortion_as_whole, run);
    while (analysis_next_case(&at, error)) {
        struct distortion_models_found found;
        if (!distortion_find(input, at.one, &found, error)) {
            return false;
        }
        const enum distortion_way first = distortion_models[found.fit.model].way;
        const enum distortion_way ways[] = {first,
                                            first == WAY_DISTORT ? WAY_UNDISTORT : WAY_DISTORT};
        for (size_t i = 0; i < sizeof ways / sizeof ways[0]; i++) {
            struct models_row row = models_row_of(at.one, &found, ways[i]);
            row.sensor = input->sensor.name;
            if (!run_emit(run, &row)) {
                return true;
            }
        }
    }
    return error->code == ERROR_NONE;
}

/* -------- files -------- */

static const struct file_type lensfun_type = {{"lensfun", "lens profile"}, ".xml"};
static const struct file_type opencv_types[] = {{{"opencv", "camera calibration"}, ".yml"},
                                                {{"opencv", "camera calibration"}, ".yaml"}};

const struct file_type *distortion_file_types(size_t i)
{
    if (i == 0) {
        return &lensfun_type;
    }
    if (i < 3) {
        return &opencv_types[i - 1];
    }
    return NULL;
}

static bool is_for_lensfun(const struct distortion_input *input)
{
    return distortion_models[input->fit - 1].unit == UNIT_HALF_SIDE;
}

bool distortion_fit_check(const struct artifact_job *job, struct error *error)
{
    const struct distortion_input *input = job->inputs[0];
    const char *model = distortion_models[input->fit - 1].word.word;
    if (input->fit - 1 == MODEL_BROWN) {
        fail(error, ERROR_USAGE, "{--output}: no file of another program has {--fit} %s", model);
        return error_hint(error, "opencv is the same polynomial, of the other direction");
    }
    if (is_for_lensfun(input) != (job->type == &lensfun_type)) {
        return fail(error, ERROR_USAGE,
                    "{--output} '%s': {--fit} %s goes into files that end in %s", job->path, model,
                    is_for_lensfun(input) ? ".xml" : ".yml or .yaml");
    }
    return is_for_lensfun(input) ||
           !lens_positions_several(input->question.lens.lens, input->question.position) ||
           fail(error, ERROR_USAGE, "{--output} '%s' holds one position: name it with {--position}",
                job->path);
}

/* A profile without its coefficients. */
static void begin_lensfun(const struct analysis_case *one,
                          const struct distortion_models_found *found, struct output *sink)
{
    static const char *const types[] = {[RECTILINEAR] = "rectilinear",
                                        [EQUIDISTANT] = "fisheye",
                                        [EQUISOLID] = "equisolid",
                                        [STEREOGRAPHIC] = "stereographic",
                                        [ORTHOGRAPHIC] = "orthographic"};
    const struct sensor *size = &found->picture.size;
    const double longer = fmax(size->width, size->height);
    const char *title = one->setup->lens->title;
    output_string(sink, "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
                        "<!-- Made by lenscalc distortion from the exact chief rays of a design.\n"
                        "     Maker, model and mount are to be set as cameras call them. -->\n"
                        "<lensdatabase version=\"1\">\n"
                        "    <lens>\n"
                        "        <maker>lenscalc</maker>\n"
                        "        <model>");
    output_escaped(sink, text_of(title != NULL ? title : "lens"));
    output_printf(sink,
                  "</model>\n"
                  "        <mount>Generic</mount>\n"
                  "        <cropfactor>%.6g</cropfactor>\n"
                  "        <aspect-ratio>%.6g</aspect-ratio>\n"
                  "        <type>%s</type>\n"
                  "        <calibration>\n",
                  sensor_crop(size), longer / fmin(size->width, size->height),
                  types[found->ready.map.projection]);
}

static void write_lensfun(const struct distortion_models_found *found, struct output *sink)
{
    const struct model_facts *facts = &distortion_models[found->fit.model];
    output_printf(sink, "            <distortion model=\"%s\" focal=\"%.4g\"", facts->word.word,
                  found->fit.focal);
    for (size_t j = 0; j < facts->terms; j++) {
        output_printf(sink, " %s=\"%.9g\"", facts->names[j],
                      found->fit.ways[WAY_DISTORT].published[j]);
    }
    output_printf(sink,
                  "/>\n"
                  "            <real-focal-length focal=\"%.4g\" real-focal=\"%.9g\"/>\n",
                  found->fit.focal, found->fit.focal);
}

/* Pixel centres have whole coordinates, from 0. */
static void write_opencv(const struct distortion_models_found *found, struct output *sink)
{
    const struct picture *picture = &found->picture;
    const double f = found->fit.focal / picture->size.pitch;
    const double *k = found->fit.ways[WAY_DISTORT].published;
    const bool is_fisheye = found->fit.model == MODEL_FISHEYE;
    const bool is_rational = found->fit.model == MODEL_RATIONAL;
    static const int counts[2][2] = {{5, 4}, {8, 8}};
    output_printf(sink,
                  "%%YAML:1.0\n---\n"
                  "# made by lenscalc distortion from the exact chief rays of a design\n"
                  "image_width: %.0f\nimage_height: %.0f\n"
                  "fisheye_model: %d\n"
                  "camera_matrix: !!opencv-matrix\n"
                  "   rows: 3\n   cols: 3\n   dt: d\n"
                  "   data: [ %.16e, 0., %.16e,\n"
                  "       0., %.16e, %.16e,\n"
                  "       0., 0., 1. ]\n",
                  picture->width, picture->height, is_fisheye, f, (picture->width - 1) / 2, f,
                  (picture->height - 1) / 2);
    output_printf(sink,
                  "distortion_coefficients: !!opencv-matrix\n"
                  "   rows: %d\n   cols: 1\n   dt: d\n",
                  counts[is_rational][is_fisheye]);
    if (is_rational) {
        output_printf(sink, "   data: [ %.16e, %.16e, 0., 0.,\n       %.16e, %.16e, %.16e,\n", k[0],
                      k[1], k[2], k[3], k[4]);
        output_printf(sink, "       %.16e ]\n", k[5]);
    } else if (is_fisheye) {
        output_printf(sink, "   data: [ %.16e, %.16e,\n       %.16e, %.16e ]\n", k[0], k[1], k[2],
                      k[3]);
    } else {
        output_printf(sink, "   data: [ %.16e, %.16e, 0., 0.,\n       %.16e ]\n", k[0], k[1], k[2]);
    }
}

bool distortion_fit_save(const struct artifact_job *job, struct output *sink, struct error *error)
{
    const struct distortion_input *input = job->inputs[0];
    const bool lensfun = is_for_lensfun(input);
    struct analysis_cursor at = analysis_begin(input, &distortion_as_whole, job->run);
    for (bool first = true; analysis_next_case(&at, error); first = false) {
        struct distortion_models_found found;
        if (!distortion_find(input, at.one, &found, error)) {
            return false;
        }
        if (!lensfun) {
            write_opencv(&found, sink);
            continue;
        }
        if (first) {
            begin_lensfun(at.one, &found, sink);
        }
        write_lensfun(&found, sink);
    }
    if (error->code == ERROR_NONE && lensfun) {
        output_string(sink, "        </calibration>\n    </lens>\n</lensdatabase>\n");
    }
    return error->code == ERROR_NONE;
}
