/* commands/photo/cmd_focus.c - lenscalc focus: conjugates, attachments, exposure factor. */
/* SPDX-License-Identifier: MIT */
#include "commands/photo/attachments.h"
#include "commands/photo/by_rays.h"
#include "commands/photo/photo_lens.h"
#include "commands/tables.h"
#include "photo/attach.h"
#include "photo/conjugate.h"

#include <math.h>

struct focus_input {
    double distance, image, magnification, sensor_distance; /* two of these and the focal length */
    struct photo_lens_question lens;
    bool enlarged;
    double hiatus, front; /* NaN = those of the lens, else none */
    bool reversed;
    struct attachments attached;
    double stacked, stacked_aperture, gap, converter_length;
    int order;
};

/* Indexed by the member `order`. */
static const struct word orders[] = {
    {"tube-converter", "the tube at the lens, the converter at the camera"},
    {"converter-tube", "the converter at the lens, the tube at the camera"},
    {NULL, NULL},
};

#define INPUT struct focus_input

static const struct option options[] = {
    OPTION_FOCAL_LENGTH(lens.focal, OPTION_SETTING),
    PHOTO_LENS_OPTIONS(lens),
    OPTION_WAVELENGTH_OF_LENS(lens.wavelength, "lens"),
    OPTION_DISTANCE(distance, OPTION_SETTING, "distance of the subject; inf for infinity"),
    {MEASURE(image, length, "mm", "LENGTH"), REPEATED("image"), .quantity = "image distance",
     ABOVE_0 | OPTION_GOAL,
     .outside = "a virtual image: lenscalc conjugate -f LENGTH --image LENGTH",
     .help = "distance of the sensor from the rear principal plane"},
    {MEASURE(magnification, ratio, NULL, "RATIO"), REPEATED("magnification"), .letter = 'm',
     FROM_0 | OPTION_GOAL, .help = "magnification: 1:2 or 0.5"},
    {MEASURE(sensor_distance, length, "m", "LENGTH"), .name = "sensor-distance",
     .column = "sensor_distance", ABOVE_0_OR_INFINITE | OPTION_GOAL,
     .help = "distance from subject to sensor, as on lens scales"},
    {ASKED(enlarged), .name = "enlarged", .wants = "sensor-distance|from=sensor",
     .help = "of the two solutions for --sensor-distance, the one with m above 1"},
    OPTION_APERTURE(lens.fnumber, 0),
    OPTION_PUPIL_OF_LENS(lens.pupil, NULL),
    OPTION_FROM(lens.from, distances_from),
    {MEASURE(hiatus, length, "mm", "LENGTH"), .name = "hiatus", .flags = OPTION_NO_INFINITY,
     .help = "distance between the principal planes; default that of --lens, else 0"},
    {MEASURE(front, length, "mm", "LENGTH"), .name = "front", .quantity = "front principal plane",
     .flags = OPTION_NO_INFINITY,
     .help = "front principal plane from the front of the lens, + towards the sensor; adds the "
             "working distance"},
    {ASKED(reversed), .name = "reversed", .help = "the lens is mounted back to front"},
    OPTION_CLOSE_UP(attached.close_up),
    {MEASURE(stacked, length, "mm", "LENGTH"), REPEATED("stacked"), .quantity = "stacked lens",
     ABOVE_0, .help = "focal length of a lens mounted in reverse in front of the lens"},
    {MEASURE(stacked_aperture, fnumber, NULL, "NUMBER"), .name = "stacked-aperture",
     .quantity = "f-number of the stacked lens", ABOVE_0, .wants = "stacked", OPTION_USUAL_FNUMBER,
     .help = "f-number of the stacked lens, where it limits the beam"},
    {MEASURE(gap, length, "mm", "LENGTH"), .name = "gap", FROM_0, .fallback = "0",
     .wants = "stacked|close-up", .help = "distance from the front of the lens to the attachment"},
    OPTION_TUBE(attached.tube),
    OPTION_CONVERTER(attached.converter),
    {MEASURE(converter_length, length, "mm", "LENGTH"), .name = "converter-length",
     .quantity = "length of the converter", FROM_0, .fallback = "0", .wants = "converter",
     .help = "how much longer the converter makes the lens"},
    {ASKED(order), REPEATED("order"), .words = orders, .fallback = "tube-converter",
     .value = "ORDER", .help = "which of tube and converter is nearer to the lens"},
    BY_RAYS_EXACT_OPTION(lens.rays, "put the sensor at the best focus of the exact rays of --lens"),
    BY_RAYS_CRITERION_OPTION(lens.rays),
};

struct focus_row {
    struct photo_real real;
    struct by_rays_row rays;
    double shift; /* of the sharpest image, mm; NaN: no rays were asked */
    const char *lens_focus, *order, *from;
    struct conjugates c; /* of lens and attachments together */
    double focal, distance, fnumber, pupil, stacked;
    struct attachments attached;
    double working_fnumber, factor, stops;
    double pupil_distance, working_distance;
};

/* The first columns are only there with attachments. */
enum { ATTACHED_COLUMNS = 2 };

#define ROW struct focus_row

static const struct column columns[] = {
    {SHOWN(lens_focus), .name = "lens_focus", BRIEF, .label = "lens itself focused",
     .help = "at infinity, or as given"},
    {LENGTH(c.f, "mm"), .name = "combined_focal", .symbol = "f", .label = "combined focal length",
     .help = "focal length of lens and attachments"},
    PHOTO_LENS_COLUMNS(real),
    PHOTO_LENS_WAVELENGTH_COLUMN(real),
    COLUMN_FOCAL(focal, 0),
    COLUMN_FNUMBER(fnumber, 0),
    COLUMN_CLOSE_UP(attached.close_up),
    {LENGTH(stacked, "mm"), .name = "stacked", ECHO_WITH("stacked"), .label = "stacked lens",
     .help = "focal length of the lens in front"},
    COLUMN_TUBE(attached.tube),
    COLUMN_CONVERTER(attached.converter),
    {SHOWN(order), .name = "order", WITH("order"),
     .help = "which of tube and converter is nearer to the lens"},
    {LENGTH(distance, "m"), .name = "distance", BRIEF | COLUMN_ECHO | COLUMN_INFINITE,
     .with = "distance", .help = "distance of the subject"},
    {LENGTH(c.v, "mm"), .name = "image", BRIEF, .symbol = "v", .label = "image distance",
     .help = "sensor from the rear principal plane"},
    COLUMN_MAGNIFICATION(c.m, COLUMN_BRIEF),
    {LENGTH(c.T, "m"), .name = "sensor_distance", BRIEF | COLUMN_INFINITE, .symbol = "T",
     .label = "subject to sensor", .help = "distance from subject to sensor"},
    {LENGTH(c.extension, "mm"), .name = "extension", .symbol = "x",
     .help = "how far the lens is from its place for infinity: f m"},
    {SHOWN(c.twin_magnification), .name = "twin_magnification",
     .flags = COLUMN_INFINITE | COLUMN_HIDDEN, .label = "magnification of the other focusing",
     .help = "1/m: the other focusing between the same subject and sensor"},
    {SHOWN(working_fnumber), .name = "working_fnumber", .symbol = "Nw", .label = "working f-number",
     .help = "f-number that exposes"},
    {SHOWN(factor), .name = "exposure_factor", .symbol = "E", .label = "exposure factor",
     .help = "times the exposure at the marked f-number"},
    {STOPS(stops), .name = "exposure", BRIEF, .label = "exposure factor, stops",
     .help = "the same in stops"},
    {LENGTH(working_distance, "m"), .name = "working_distance", .flags = COLUMN_INFINITE,
     .with = "front lens", .label = "working distance",
     .help = "from the subject to the lens's front"},
    {LENGTH(pupil_distance, "m"), .name = "pupil_distance",
     .flags = COLUMN_INFINITE | COLUMN_HIDDEN, .symbol = "X", .label = "subject to entrance pupil",
     .help = "distance of the subject from the centre of perspective"},
    {LENGTH(shift, "mm"), .name = "focus_shift", WITH("exact"), .label = "focus shift",
     .help = "of the sharpest image from where the lens has it wide open, + away from the lens; "
             "null where the lens states no aperture"},
    BY_RAYS_COLUMNS(rays),
    PHOTO_LENS_HIATUS_COLUMN(real.hiatus),
    COLUMN_PUPIL(pupil),
    COLUMN_FROM(from),
    {LENGTH(c.s, "m"), .name = "principal_distance", .flags = COLUMN_EXTRA | COLUMN_INFINITE,
     .symbol = "s", .label = "distance from the principal plane",
     .help = "distance of the subject from the front principal plane"},
    PHOTO_LENS_WARNING_COLUMN(real),
};

static const struct sheet plain = {columns + ATTACHED_COLUMNS,
                                   sizeof columns / sizeof columns[0] - ATTACHED_COLUMNS,
                                   sizeof(struct focus_row)};
static const struct sheet attached = SHEET(columns, struct focus_row);
static const struct sheet *const sheets[] = {&attached, NULL};

static bool has_attachments(const void *data)
{
    const struct focus_input *input = data;
    return input->reversed || !isnan(input->stacked) || attachments_any(&input->attached);
}

static const struct sheet *focus_choose_sheet(const void *data, const struct option_query *asking)
{
    (void)data;
    bool any = asking_given(asking, "reversed") || asking_given(asking, "stacked") ||
               attachments_asked(asking);
    return any ? &attached : &plain;
}

/* --distance from wherever it is measured, as one of the conjugates. */
static bool place_subject(const struct focus_input *input, const struct photo_lens *lens,
                          struct conjugates_given *given, struct error *error)
{
    if (input->lens.from == FROM_PRINCIPAL || isnan(input->distance)) {
        given->s = input->distance;
        return true;
    }
    if (input->lens.from == FROM_SENSOR) {
        if (!isnan(input->sensor_distance)) {
            return fail(error, ERROR_USAGE,
                        "{--distance} from the sensor and {--sensor-distance} are the same thing");
        }
        given->T = input->distance;
        return true;
    }
    if (isnan(lens->f) && input->lens.from == FROM_ENTRANCE) {
        return fail(error, ERROR_USAGE,
                    "{--from} entrance needs {--focal-length}: the pupil's place "
                    "follows from it");
    }
    return distance_to_principal(lens->f, lens->P, input->distance, &lens->measuring, &given->s,
                                 error);
}

/* The bare lens. With attachments a focal length alone means a lens that stays at infinity. */
static bool focus_row_solve(const struct focus_input *input, const struct photo_lens *lens,
                            bool attaches, struct conjugates *c, struct error *error)
{
    struct conjugates_given given = {
        .f = lens->f,
        .s = NAN,
        .v = input->image,
        .m = input->magnification,
        .T = input->sensor_distance,
        .hiatus = lens->measuring.hiatus,
        .choice = input->enlarged ? CONJUGATES_ENLARGED : CONJUGATES_REDUCED,
    };
    if (!place_subject(input, lens, &given, error)) {
        return false;
    }
    if (attaches && isnan(given.s) && isnan(given.v) && isnan(given.m) && isnan(given.T)) {
        given.m = 0;
    }
    if (conjugates_solve(&given, c, error)) {
        return true;
    }
    if (input->reversed && error->code == ERROR_DOMAIN && given.s <= lens->f) {
        return error_hint(error,
                          "a lens of %.6gmm in reverse in front of this one is {--stacked} %.6gmm",
                          given.s, given.s);
    }
    if (error->code == ERROR_DOMAIN && !isnan(given.T) && given.T < 4 * lens->f + given.hiatus) {
        return error_hint(error,
                          "lenses for close-ups shorten as they focus: without {--focal-length} "
                          "the magnification there, {--magnification} 1, says to which one");
    }
    return photo_lens_hint_virtual(lens, given.s, error);
}

/* What is the same for lenses with and without attachments. */
static void focus_fill_row(const struct focus_input *input, const struct photo_lens *lens, double P,
                           struct focus_row *row)
{
    row->real = *lens->real;
    row->pupil_distance = conjugates_pupil_distance(row->c.f, row->c.m, P);
    const double distances[] = {[FROM_PRINCIPAL] = row->c.s,
                                [FROM_SENSOR] = row->c.T,
                                [FROM_ENTRANCE] = row->pupil_distance,
                                [FROM_FRONT] = row->working_distance};
    row->distance = distances[input->lens.from];
    row->fnumber = lens->N;
    row->order = orders[input->order].word;
    row->attached = input->attached;
    row->stacked = input->stacked;
    row->pupil = lens->P;
    row->from = distances_from[input->lens.from].word;
}

static bool focus_check_rays(const struct focus_input *input, struct error *error)
{
    const char *other = SAID_FIRST(
        {!isnan(input->image), "image"}, {!isnan(input->hiatus), "hiatus"},
        {!isnan(input->front), "front"}, {input->enlarged, "enlarged"},
        {has_attachments(input), "reversed, --close-up, --stacked, --tube, --converter"});
    return other == NULL || fail(error, ERROR_USAGE,
                                 "{--exact} goes by the lens as it is, and finds its image: it "
                                 "excludes {--%s}",
                                 other);
}

/* The image by rays, and its shift against that of the lens wide open. */
static bool focus_find_by_rays(const struct focus_input *input, const struct photo_lens *lens,
                               struct run *run, struct focus_row *row, struct error *error)
{
    struct conjugates *c = &row->c;
    struct real_focus focus, open;
    struct photo_lens_question wide = input->lens;
    double infinity, wide_image, ignored;
    wide.fnumber = NAN;
    if (!by_rays_open(&input->lens, lens, c->s, 0, run, &focus, &row->rays, error) ||
        ((input->lens.from == FROM_SENSOR || !isnan(input->sensor_distance)) &&
         !by_rays_distance(&focus, lens, c->s, c->T, &c->s, error)) ||
        !by_rays_image(&focus, lens, c->s, &c->v, &row->rays.blur, error) ||
        !by_rays_image(&focus, lens, INFINITY, &infinity, &ignored, error)) {
        return false;
    }
    c->T = c->s + c->v + lens->measuring.hiatus;
    c->extension = c->v - infinity;
    if (isnan(lens->first->entrance_diameter)) {
        return true; /* how wide it opens is not known: neither is the shift */
    }
    if (!by_rays_open(&wide, lens, c->s, 0, run, &open, &row->rays, error) ||
        !by_rays_image(&open, lens, c->s, &wide_image, &ignored, error)) {
        return false;
    }
    /* where both are one lens, by rounding alone */
    const double noise = 1e-14 * (fabs(c->v) + lens->first->length);
    row->shift = fabs(c->v - wide_image) < noise ? 0 : c->v - wide_image;
    return true;
}

static bool run_plain(const struct focus_input *input, const struct photo_lens *lens,
                      struct run *run, struct error *error)
{
    struct focus_row row = {.working_distance = NAN, .shift = NAN, .rays = by_rays_none};
    struct conjugates_exposure exposure;
    double front = lens->measuring.front;
    if (!focus_row_solve(input, lens, false, &row.c, error) ||
        (input->lens.rays.exact && !focus_find_by_rays(input, lens, run, &row, error)) ||
        !conjugates_exposure(isnan(lens->N) ? 1 : lens->N, row.c.m, lens->P, &exposure, error) ||
        (!isnan(front) &&
         !conjugates_working_distance(row.c.s, front, &row.working_distance, error))) {
        return false;
    }
    row.focal = row.c.f;
    row.working_fnumber = isnan(lens->N) ? NAN : exposure.working_fnumber;
    row.factor = exposure.factor;
    row.stops = exposure.stops;
    focus_fill_row(input, lens, lens->P, &row);
    run_emit(run, &row);
    return true;
}

static bool emit_focus(const struct focus_input *input, const struct photo_lens *bare,
                       double bare_focal, const struct attach_lens *lens, bool near,
                       struct run *run, struct error *error)
{
    struct attach_focus focus;
    if (!attach_focused(lens, near, &focus, error)) {
        return false;
    }
    double ratio = focus.working_fnumber / (isnan(bare->N) ? 1 : bare->N);
    struct focus_row row = {
        .lens_focus = near ? "as given" : "infinity",
        .c = {.f = lens->f,
              .s = focus.distance,
              .v = lens->f * (1 + focus.m),
              .m = focus.m,
              .T = focus.sensor_distance,
              .extension = lens->f * focus.m,
              .twin_magnification = NAN},
        .focal = bare_focal,
        .shift = NAN,
        .rays = by_rays_none,
        .working_fnumber = isnan(bare->N) ? NAN : focus.working_fnumber,
        .factor = ratio * ratio,
        .stops = 2 * log2(ratio),
        .working_distance = isnan(bare->measuring.front) ? NAN : focus.working_distance,
    };
    focus_fill_row(input, bare, lens->P, &row);
    run_emit(run, &row);
    return true;
}

/* A row for the lens at infinity and one for its own focusing as given, where these differ. */
static bool run_attached(const struct focus_input *input, const struct photo_lens *real,
                         struct run *run, struct error *error)
{
    struct conjugates bare;
    struct attach_lens lens;
    double front = isnan(real->measuring.front) ? 0 : real->measuring.front;
    if (!isnan(input->stacked_aperture) && isnan(real->N)) {
        return fail(error, ERROR_USAGE,
                    "{--stacked-aperture} needs {--aperture}: the narrower counts");
    }
    if (!focus_row_solve(input, real, true, &bare, error)) {
        return false;
    }
    const struct attach_bare sold = {.f = bare.f,
                                     .N = isnan(real->N) ? 1 : real->N,
                                     .P = real->P,
                                     .m_near = bare.m,
                                     .front = front,
                                     .hiatus = real->measuring.hiatus};
    if (!attach_bare(&sold, &lens, error)) {
        return false;
    }
    /* Put on what is attached, in its order: see --order and the manual. */
    const struct attach_step tube = {ATTACH_TUBE, input->attached.tube, 0, 0};
    const struct attach_step converter = {ATTACH_CONVERTER, input->attached.converter,
                                          input->converter_length, 0};
    bool tube_first = input->order == 0;
    const struct attach_step steps[] = {
        {ATTACH_REVERSED, input->reversed ? bare.v : NAN, real->measuring.hiatus,
         -real->real->rear},
        {ATTACH_CLOSE_UP, 1000 * input->attached.close_up, input->gap, 0},
        {ATTACH_STACKED, input->stacked, input->gap,
         isnan(input->stacked_aperture) ? 0 : input->stacked_aperture},
        tube_first ? tube : converter,
        tube_first ? converter : tube,
    };
    if (!attach_apply(&lens, steps, sizeof steps / sizeof steps[0], error)) {
        return false;
    }
    bool moves = lens.m_near > lens.m_far;
    bool at_infinity = !input->reversed && (moves || !(bare.m > 0));
    return (!at_infinity || emit_focus(input, real, bare.f, &lens, false, run, error)) &&
           ((at_infinity && !moves) || emit_focus(input, real, bare.f, &lens, true, run, error));
}

static bool focus_answer(const void *data, const struct photo_lens *lens, struct run *run,
                         struct error *error)
{
    const struct focus_input *input = data;
    struct photo_lens own = *lens;
    if (input->reversed && lens->lens != NULL && !isnan(input->front)) {
        return fail(error, ERROR_USAGE,
                    "{--front} is known of {--lens}, which is {--reversed}: leave it out");
    }
    /* what is given overrides the lens */
    own.measuring.hiatus = isnan(input->hiatus) ? own.measuring.hiatus : input->hiatus;
    own.measuring.front = isnan(input->front) ? own.measuring.front : input->front;
    struct photo_real said = *lens->real;
    said.hiatus = own.measuring.hiatus;
    own.real = &said;
    return (!input->lens.rays.exact || focus_check_rays(input, error)) &&
           (has_attachments(input) ? run_attached(input, &own, run, error)
                                   : run_plain(input, &own, run, error));
}

static bool focus_run(const void *data, struct run *run, struct error *error)
{
    const struct focus_input *input = data;
    return photo_lens_each(&input->lens, 0, run, focus_answer, input, error);
}

static bool focus_makes_many(const void *data)
{
    return has_attachments(data) ||
           photo_lens_makes_many(&((const struct focus_input *)data)->lens);
}

PHOTO_LENS_VARIES(lens)

static const struct explanation explanations[] = {
    {"image !blur_rule", "v = {f} (1 + {m})", "[Gauss41] thin lens 1/f = 1/s + 1/v",
     "paraxial; a lens with internal focusing changes f on the way"},
    {"magnification", "m = {f}/({s} - {f})", "[Gauss41] m = v/s", NULL},
    {"sensor_distance", "T = {s} + {v} + {HH'}", "[Gauss41] at least 4 f + HH', at 1:1",
     "HH': from the front to the rear principal plane"},
    {"extension !blur_rule", "x = {f} {m}", "[Gauss41] Newton's form", NULL},
    {"image blur_rule", "v = place where the rays of the subject blur least", "exact rays", NULL},
    {"extension blur_rule", "x = {v} less that of infinity", "exact rays", NULL},
    {"working_fnumber", "Nw = {N} (1 + {m}/{P})", "[Kingslake92]; of the lens without attachments",
     "with attachments f', N', m' and P' of the combination: see lenscalc-focus(1)"},
    {"exposure_factor", "E = (1 + {m}/{P})^2", "[Kingslake92]; (Nw/N)^2 with attachments",
     "a meter behind the lens has it in its reading already"},
    {"pupil_distance", "X = {f} (1/{m} + 1/{P})", "[Kingslake92]", NULL},
    {NULL, NULL, NULL, NULL},
};

static const struct example examples[] = {
    {"focus -f 50mm -s 3m -N 2.8", "where a 50 mm lens puts the image of a subject at 3 m"},
    {"focus -f 100mm -m 1:1 -N 8", "life size: distances, extension, exposure"},
    {"focus -m 1:4 --sensor-distance 0.45m",
     "the focal length of a macro lens at its closest focus"},
    {"focus -f 50 -s 45cm --from sensor --tube 12,20,36", "extension tubes"},
    {"focus -f 100 -m 1:2 -N 4 --converter 2x --close-up 3", "converter and close-up lens"},
    {"focus --lens double-gauss -m 1:4", "a real lens: working distance from its first surface"},
    {"focus --lens double-gauss -s 2m -N 2,2.8,4,5.6,8 --exact", "how its focus shifts with N"},
    {"focus -f 35,50,85,135 -m 1:10,1:5,1:2,1:1 --table f,m:distance", "a table to print"},
    {NULL, NULL},
};

BY_RAYS_WEIGHT(lens.rays)

const struct command command_focus = {
    .name = "focus",
    .stop_size_wants = "exact",
    .group = "photography",
    .summary = "conjugate distances, magnification, close-up attachments, exposure factor",
    COMMAND_ASKS(struct focus_input),
    .sheet = {columns + ATTACHED_COLUMNS, sizeof columns / sizeof columns[0] - ATTACHED_COLUMNS,
              sizeof(struct focus_row)},
    .choose_sheet = focus_choose_sheet,
    .sheets = sheets,
    .makes_many = focus_makes_many,
    .run = focus_run,
    .explanations = explanations,
    .varies = varies,
    .weight = weight,
    .plot = "magnification|image_mm",
    .plot_titles = "Magnification|Image distance",
    .cell = "magnification",
};
