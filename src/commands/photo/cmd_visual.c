/* commands/photo/cmd_visual.c - lenscalc visual: telescopes and binoculars before an eye. */
/* SPDX-License-Identifier: MIT */
#include "commands/photo/photo_lens.h"
#include "commands/tables.h"
#include "photo/given.h"
#include "photo/visual.h"

#include <math.h>

struct visual_input {
    struct marking_value binoculars;
    struct eyepiece_value eyepiece;
    struct photo_lens_question lens; /* a real one by the usual option */
    struct visual_setting setting;
    double barlow, reducer; /* NaN = none */
    double field_stop, apparent_field, field, field_width, at;
    double obstruction, secondary; /* of the diameter; mm */
    double eye_pupil, naked_eye, wavelength;
    double back_focus, filter, filter_index; /* mm */
    double projection, afocal;               /* of a camera behind the eyepiece, mm */
};

#define INPUT struct visual_input

/* What one of them makes, the others follow from. */
#define LENGTH_GIVEN(member, words) MEASURE(member, length, "mm", "LENGTH"), ABOVE_0, .help = words

static const struct option options[] = {
    {ASKED(binoculars), .name = "binoculars", .column = "binoculars", .value = "POWERxDIAMETER",
     .flags = OPTION_OPERAND | OPTION_REST,
     .excludes = "telescope diameter aperture eyepiece lens barlow reducer power",
     .no_number = "of a telescope: --telescope 1200mm --diameter 200mm --eyepiece 25mm",
     .help = "binoculars or a spotting scope by what is marked on them: 10x42, 10x42 6.5deg, "
             "8x42 330ft/1000yd"},
    {MEASURE(setting.focal, length, "mm", "LENGTH"), REPEATED("telescope"), .letter = 'f', ABOVE_0,
     .help = "focal length of the telescope"},
    {MEASURE(setting.diameter, length, "mm", "LENGTH"), REPEATED("diameter"), ABOVE_0,
     .help = "diameter of its objective or mirror"},
    {MEASURE(setting.fnumber, fnumber, NULL, "NUMBER"), .name = "aperture", .letter = 'N',
     .quantity = "f-number", .column = "fnumber", ABOVE_0,
     .no_number = "the diameter is --diameter 200mm", .help = "f-number of the telescope: f/6"},
    {MEASURE(eyepiece, length, "mm", "LENGTH|LENS"), REPEATED("eyepiece"),
     .flags = OPTION_NO_INFINITY,
     .help = "focal length of the eyepiece, or several: 25,10,5; below 0 of a Galilean telescope, "
             "an opera glass; or a real one as --lens has it"},
    {ASKED(lens.lens), .name = "lens", .letter = 'l', .value = "LENS", .column = "lens_name",
     .flags = OPTION_FILE, .types = lens_types, .excludes = "eyepiece exit-pupil power",
     .help = "a real eyepiece, from the eye to its field stop: a name (list lenses), a file, or -"},
    LENS_POSITION_OPTION(INPUT, lens),
    {MEASURE(barlow, ratio, NULL, "FACTOR"), REPEATED("barlow"), ABOVE_0,
     .wants = "telescope|aperture", .help = "factor of a Barlow lens: 2x"},
    {MEASURE(reducer, ratio, NULL, "FACTOR"), REPEATED("reducer"), ABOVE_0,
     .wants = "telescope|aperture", .help = "factor of a focal reducer: 0.63x"},
    {MEASURE(setting.power, ratio, NULL, "FACTOR"), REPEATED("power"), ABOVE_0,
     .help = "wanted magnification: solves for the eyepiece"},
    {MEASURE(setting.exit_pupil, length, "mm", "LENGTH"), .name = "exit-pupil",
     .column = "exit_pupil", ABOVE_0, .help = "wanted exit pupil: solves for the eyepiece"},
    {MEASURE(field_stop, length, "mm", "LENGTH"), .name = "field-stop", .column = "field_stop",
     ABOVE_0, .wants = "telescope|aperture",
     .help = "diameter of the eyepiece's field stop: gives the true field"},
    {MEASURE(apparent_field, angle, "deg", "ANGLE"), .name = "apparent-field",
     .column = "apparent_field", .lowest = 0, .highest = PI,
     .flags = OPTION_ABOVE_LOWEST | OPTION_BELOW_HIGHEST, .help = "field of the eyepiece: 68deg"},
    {MEASURE(field, angle, "deg", "ANGLE"), .name = "field", .column = "true_field", .lowest = 0,
     .highest = PI, .flags = OPTION_ABOVE_LOWEST | OPTION_BELOW_HIGHEST,
     .excludes = "field-width field-stop",
     .no_number = "a width in the landscape is --field-width 330ft --at 1000yd",
     .help = "true field, full angle: 6.5deg"},
    {MEASURE(field_width, length, "m", "LENGTH"), .name = "field-width", .column = "field_width",
     ABOVE_0, .excludes = "field-stop",
     .help = "the same as a width at --at: --field-width 330ft --at 1000yd"},
    {MEASURE(at, length, "m", "LENGTH"), REPEATED("at"), ABOVE_0,
     .help = "distance of the width of the field; default 1000"},
    {MEASURE(obstruction, ratio, NULL, "RATIO"), REPEATED("obstruction"), .lowest = 0, .highest = 1,
     .flags = OPTION_BELOW_HIGHEST, .excludes = "secondary", .wants = "diameter|telescope|aperture",
     .help = "diameter of the secondary mirror over that of the telescope: 34%"},
    {MEASURE(secondary, length, "mm", "LENGTH"), REPEATED("secondary"), FROM_0,
     .wants = "diameter|telescope|aperture", .help = "diameter of the secondary mirror"},
    {MEASURE(eye_pupil, length, "mm", "LENGTH"), .name = "eye-pupil", .column = "eye_pupil",
     ABOVE_0, .fallback = "7", .usual = {1, 9}, .unusual = "pupils of eyes are 2 to 8 mm wide",
     .help = "pupil of the eye: 7 mm in the dark when young, 5 mm at sixty, 2 to 3 mm by day"},
    {MEASURE(naked_eye, number, NULL, "MAGNITUDE"), .name = "naked-eye", .column = "naked_eye",
     .lowest = -5, .highest = 9, .fallback = "6.5",
     .help = "magnitude of the faintest star seen without a telescope"},
    OPTION_WAVELENGTH(wavelength, NULL),
    {MEASURE(back_focus, length, "mm", "LENGTH"), .name = "back-focus", .column = "back_focus",
     ABOVE_0, .wants = "filter-thickness",
     .help = "distance to the sensor that a reducer or corrector asks for: 55mm"},
    {MEASURE(filter, length, "mm", "LENGTH"), .name = "filter-thickness",
     .column = "filter_thickness", ABOVE_0, .wants = "back-focus",
     .help = "thickness of the filters and windows in between, all together"},
    {MEASURE(filter_index, number, NULL, "INDEX"), .name = "filter-index", .column = "filter_index",
     .lowest = 1, .highest = 5, .fallback = "1.52", .wants = "back-focus",
     .help = "refractive index of the filters"},
    {MEASURE(projection, length, "mm", "LENGTH"), REPEATED("projection"), ABOVE_0,
     .wants = "eyepiece|lens|power|exit-pupil", .excludes = "afocal binoculars",
     .help = "eyepiece projection: from the eyepiece to the sensor of a camera without a lens"},
    {MEASURE(afocal, length, "mm", "LENGTH"), REPEATED("afocal"), ABOVE_0,
     .wants = "eyepiece|lens|power|exit-pupil|binoculars",
     .help = "focal length of a camera's or phone's lens held behind the eyepiece"},
};

struct visual_row {
    const char *binoculars;
    struct visual_setting setting;
    double barlow, reducer;
    double whole, whole_fnumber; /* with them */
    struct visual_field field;
    double width, at;
    struct visual_light light;
    double obstruction, eye_relief, wavelength;
    struct visual_eye eye;
    double lowest_eyepiece, highest_eyepiece;
    double back_focus, filter, filter_index, spacing;
    double separation, pupil_place;
    const char *image;
    double projection, afocal;
    struct visual_camera camera;
    struct photo_real real;
};

#define ROW struct visual_row

/* Where a figure is not known, people do not read of it. */
#define KNOWN       .flags = COLUMN_SPARSE
#define KNOWN_BRIEF .flags = COLUMN_SPARSE | COLUMN_BRIEF
#define KNOWN_ECHO  .flags = COLUMN_SPARSE | COLUMN_ECHO

static const struct column columns[] = {
    {SHOWN(real.title), .name = "lens", ASSUMED_WITH("lens eyepiece", "lens eyepiece"),
     .help = "title of the real eyepiece"},
    {SHOWN(real.position), .name = "position", ASSUMED_WITH("lens", "position lens"),
     .help = "its position; absent where there is only one"},
    {SHOWN(binoculars), .name = "binoculars", KNOWN_ECHO, .with = "binoculars",
     .help = "as marked"},
    {LENGTH(setting.focal, "mm"), .name = "telescope", KNOWN, .symbol = "f", .repeats = "telescope",
     .label = "focal length", .help = "focal length of the telescope"},
    {LENGTH(setting.diameter, "mm"), .name = "diameter", KNOWN, .symbol = "D",
     .repeats = "diameter", .help = "diameter of the objective or mirror"},
    {SHOWN(setting.fnumber), .name = "fnumber", KNOWN, .symbol = "N", .repeats = "aperture",
     .label = "f-number", .help = "of the telescope"},
    {LENGTH(setting.eyepiece, "mm"), .name = "eyepiece", KNOWN_BRIEF, .symbol = "fe",
     .repeats = "eyepiece", .help = "focal length of the eyepiece"},
    {SHOWN(setting.barlow), .name = "barlow_and_reducer", .flags = COLUMN_EXTRA, .symbol = "B",
     .label = "factor of Barlow lens and reducer", .help = "their product, 1 without"},
    {SHOWN(barlow), .name = "barlow", ECHO_WITH("barlow"), .label = "Barlow lens",
     .help = "its factor"},
    {SHOWN(reducer), .name = "reducer", ECHO_WITH("reducer"), .help = "its factor"},
    {LENGTH(whole, "mm"), .name = "combined_focal", WITH("barlow reducer"),
     .label = "combined focal length", .help = "focal length of telescope and Barlow lens"},
    {SHOWN(whole_fnumber), .name = "combined_fnumber", WITH("barlow reducer"),
     .label = "combined f-number", .help = "f-number of telescope and Barlow lens"},
    {SHOWN(setting.power), .name = "power", KNOWN_BRIEF, .symbol = "M", .repeats = "power",
     .label = "magnification", .help = "angular magnification"},
    {LENGTH(setting.exit_pupil, "mm"), .name = "exit_pupil", KNOWN_BRIEF, .symbol = "ep",
     .repeats = "exit-pupil", .label = "exit pupil", .help = "diameter of the beam into the eye"},
    {LENGTH(eye_relief, "mm"), .name = "eye_relief", WITH("lens eyepiece") | COLUMN_SPARSE,
     .symbol = "er", .label = "eye relief",
     .help = "exit pupil behind the last surface of the real eyepiece"},
    {LENGTH(separation, "mm"), .name = "separation", KNOWN, .symbol = "L",
     .label = "from objective to eyepiece", .help = "of thin lenses, focused on the far"},
    {LENGTH(pupil_place, "mm"), .name = "exit_pupil_place", KNOWN, .symbol = "x",
     .label = "exit pupil behind the eyepiece",
     .help = "of a thin eyepiece; below 0 it lies inside, as in a Galilean telescope"},
    {SHOWN(image), .name = "image", KNOWN, .label = "image is",
     .help = "upright or inverted, without a prism or diagonal mirror"},
    {LENGTH(afocal, "mm"), .name = "afocal", ECHO_WITH("afocal"), .symbol = "fc",
     .label = "lens of the camera", .help = "its focal length"},
    {LENGTH(projection, "mm"), .name = "projection", ECHO_WITH("projection"), .symbol = "v",
     .label = "eyepiece to sensor", .help = "from the eyepiece to the sensor"},
    {SHOWN(camera.factor), .name = "projection_factor", BRIEF_WITH("projection afocal"),
     .symbol = "k", .label = "projection factor",
     .help = "focal length with the camera over that of telescope and Barlow lens"},
    {LENGTH(camera.focal, "mm"), .name = "photo_focal",
     BRIEF_WITH("projection afocal") | COLUMN_SPARSE, .symbol = "F",
     .label = "focal length for photographs", .help = "of telescope, eyepiece and camera together"},
    {SHOWN(camera.fnumber), .name = "photo_fnumber",
     BRIEF_WITH("projection afocal") | COLUMN_SPARSE, .symbol = "Np",
     .label = "f-number for photographs", .help = "of all of it, no pupil cut"},
    {ANGLE(field.true_field), .name = "true_field", KNOWN_BRIEF, .symbol = "tf",
     .label = "true field", .help = "full angle that is seen; by which rule is said below"},
    {ANGLE(field.true_by_ratio), .name = "true_field_ratio", KNOWN, .symbol = "tfr",
     .label = "true field by apparent/power", .help = "the rule of the makers of eyepieces"},
    {ANGLE(field.true_by_tangent), .name = "true_field_tangent", KNOWN, .symbol = "tft",
     .label = "true field by tangents", .help = "ISO 14132-1, of an eyepiece without distortion"},
    {LENGTH(width, "m"), .name = "field_width", KNOWN, .symbol = "W", .label = "width of the field",
     .help = "at the distance of --at"},
    {ANGLE(field.apparent), .name = "apparent_field", KNOWN_BRIEF, .symbol = "af",
     .label = "apparent field", .help = "full angle that the eye sees filled"},
    {ANGLE(field.apparent_by_ratio), .name = "apparent_field_ratio", KNOWN, .symbol = "afr",
     .label = "apparent field by true x power", .help = "the rule before ISO 14132-1"},
    {LENGTH(light.used_diameter, "mm"), .name = "used_diameter", KNOWN, .symbol = "Du",
     .label = "diameter that is used",
     .help = "of the aperture, where the pupil of the eye is smaller than the exit pupil"},
    {SHOWN(light.gain), .name = "light_gain", KNOWN, .symbol = "G", .label = "light gathered",
     .help = "light of a star over that of the eye alone"},
    {SHOWN(light.magnitude), .name = "limiting_magnitude", KNOWN_BRIEF, .symbol = "ml",
     .label = "limiting magnitude", .help = "of the faintest star that is seen"},
    {MEASURED(light.rayleigh, angle, "arcsec"), .name = "rayleigh", KNOWN, .symbol = "th",
     .label = "Rayleigh limit", .help = "of the diameter that is used"},
    {MEASURED(light.dawes, angle, "arcsec"), .name = "dawes", KNOWN, .symbol = "da",
     .label = "Dawes' limit", .help = "of the diameter that is used, an empirical rule"},
    {SHOWN(light.lowest), .name = "lowest_power", KNOWN, .symbol = "Ml",
     .label = "lowest useful power", .help = "at which the exit pupil fills the eye's"},
    {SHOWN(light.matched), .name = "matched_power", KNOWN, .symbol = "Mm",
     .label = "power of the resolution", .help = "at which the Rayleigh limit appears as 1 arcmin"},
    {SHOWN(light.highest), .name = "highest_power", KNOWN, .symbol = "Mh",
     .label = "highest useful power", .help = "2 for each mm of diameter, 50 an inch"},
    {LENGTH(lowest_eyepiece, "mm"), .name = "longest_eyepiece", KNOWN,
     .label = "longest useful eyepiece", .help = "that of the lowest power"},
    {LENGTH(highest_eyepiece, "mm"), .name = "shortest_eyepiece", KNOWN,
     .label = "shortest useful eyepiece", .help = "that of the highest power"},
    {SHOWN(light.brightness), .name = "relative_brightness", KNOWN, .symbol = "rb",
     .label = "relative brightness", .help = "square of the exit pupil in mm"},
    {SHOWN(light.twilight), .name = "twilight_factor", KNOWN, .symbol = "tw",
     .label = "twilight factor", .help = "root of power times diameter in mm"},
    {LENGTH(back_focus, "mm"), .name = "back_focus", ECHO_WITH("back-focus"), .symbol = "b",
     .label = "back focus", .help = "as asked for, in air"},
    {LENGTH(spacing, "mm"), .name = "back_focus_filtered", BRIEF_WITH("back-focus"), .symbol = "bf",
     .label = "back focus with filters",
     .help = "distance to the sensor with the filters in between"},
    {LENGTH(filter, "mm"), .name = "filter_thickness", ECHO_WITH("back-focus"), .symbol = "t",
     .label = "thickness of the filters", .help = "all together"},
    {SHOWN(filter_index), .name = "filter_index",
     ASSUMED_WITH("back-focus", "filter-index") | COLUMN_ECHO, .symbol = "n",
     .label = "index of the filters", .help = "refractive index"},
    {SHOWN(field.true_from), .name = "true_field_from", ASSUMED_BY("field field-width field-stop"),
     .label = "true field from", .help = "what it follows from"},
    {SHOWN(field.apparent_from), .name = "apparent_field_from", ASSUMED_BY("apparent-field"),
     .label = "apparent field from", .help = "what it follows from"},
    {LENGTH(field.stop, "mm"), .name = "field_stop", ECHO_WITH("field-stop"), .symbol = "s",
     .label = "field stop", .help = "its diameter"},
    {LENGTH(at, "m"), .name = "at", ASSUMED_BY("at") | COLUMN_ECHO, .symbol = "A",
     .label = "width of the field at", .help = "distance of the width of the field"},
    {LENGTH(eye.pupil, "mm"), .name = "eye_pupil", ASSUMED_BY("eye-pupil") | COLUMN_ECHO,
     .symbol = "d", .label = "pupil of the eye", .help = "its diameter"},
    {SHOWN(eye.magnitude), .name = "naked_eye", ASSUMED_BY("naked-eye") | COLUMN_ECHO,
     .symbol = "me", .label = "limit of the naked eye", .help = "its faintest star, magnitude"},
    {SHOWN(obstruction), .name = "obstruction", ASSUMED_BY("obstruction secondary") | COLUMN_ECHO,
     .symbol = "o", .help = "diameter of the secondary mirror over that of the telescope"},
    {LENGTH(wavelength, "nm"), .name = "wavelength", ASSUMED_BY("wavelength") | COLUMN_ECHO,
     .symbol = "w", .help = "of the Rayleigh limit"},
};

/* "330ft/1000yd", "330ft@1000yd" and "330 ft at 1000 yd": cut it there. */
static struct text visual_cut_width(struct text *rest)
{
    static const char *const between[] = {"/", "@", " at "};
    const struct text whole = *rest;
    for (size_t i = 0; i < whole.length; i++) {
        const struct text here = {whole.start + i, whole.length - i};
        for (size_t k = 0; k < sizeof between / sizeof between[0]; k++) {
            *rest = text_behind(here, between[k]);
            if (rest->start != NULL) {
                return (struct text){whole.start, i};
            }
        }
    }
    return whole;
}

/* The true field behind the marking of binoculars, "6.5deg" or "330ft/1000yd"; NaN: none. */
static bool visual_read_field(const struct marking_value *marking, double *field,
                              struct error *error)
{
    const struct unit *degrees = unit_find(&dimension_angle, text_of("deg"));
    struct text rest = text_of(marking->name != NULL ? marking->behind : "");
    const struct text first = visual_cut_width(&rest);
    double width, distance;
    *field = NAN;
    if (first.length == 0) {
        return true;
    }
    if (rest.start == NULL) {
        return quantity_read(first, &dimension_angle, degrees, field, NULL, error) ||
               (error_prefix(error, "%.60s: ", marking->name),
                error_hint(error, "a field is written as 6.5deg or as 330ft/1000yd"));
    }
    if (!quantity_read(first, &dimension_length, NULL, &width, NULL, error) ||
        !quantity_read(rest, &dimension_length, NULL, &distance, NULL, error)) {
        return error_prefix(error, "%.60s: ", marking->name);
    }
    *field = 2 * atan(width / (2 * distance));
    return true;
}

/* The true field as given, as an angle or a width, or as it is marked; NaN: none is. */
static bool visual_true_field(const struct visual_input *input, double at, double *field,
                              struct error *error)
{
    static const double ROUNDED = 0.02; /* markings are */
    const bool is_width = is_given(input->field_width);
    double marked;
    if (!visual_read_field(&input->binoculars, &marked, error)) {
        return false;
    }
    *field = is_width ? 2 * atan(input->field_width / (2 * at)) : input->field;
    if (!is_given(*field)) {
        *field = marked;
    }
    return !(fabs(*field / marked - 1) > ROUNDED) ||
           fail(error, ERROR_USAGE, "binoculars '%s' and {--%s} contradict each other: give one",
                input->binoculars.name, is_width ? "field-width" : "field");
}

/* The widths and angles of the field, as far as they are known. */
static bool visual_fill_field(const struct visual_input *input, const struct photo_lens *eyepiece,
                              struct visual_row *row, struct error *error)
{
    row->field =
        (struct visual_field){.stop = input->field_stop, .apparent = input->apparent_field};
    row->at = input->at;
    const bool is_at = is_given(input->at);
    if (!is_at) {
        row->at = 1e6;
    }
    if (!visual_true_field(input, row->at, &row->field.true_field, error)) {
        return false;
    }
    const struct lens *lens = eyepiece->lens;
    const bool is_own = lens != NULL && isnan(input->apparent_field) &&
                        lens->field_kind == FIELD_ANGLE && lens_field_extent(lens) > 0;
    if (is_own) {
        row->field.apparent = 2 * lens_field_extent(lens);
    }
    if (!visual_see(row->whole, row->setting.power, &row->field, error)) {
        return false;
    }
    if (is_own) {
        row->field.apparent_from = "lens";
    }
    row->width = 2 * row->at * tan(row->field.true_field / 2);
    if (is_given(row->width)) {
        return true;
    }
    row->at = NAN;
    return !is_at || fail(error, ERROR_USAGE,
                          "{--at} needs a field: give {--field}, or an eyepiece "
                          "and its {--apparent-field}");
}

static bool visual_fill_light(const struct visual_input *input, struct visual_row *row,
                              struct run *run, struct error *error)
{
    const double D = row->setting.diameter;
    row->eye = (struct visual_eye){input->eye_pupil, input->naked_eye};
    row->obstruction = is_given(input->secondary) ? input->secondary / D : input->obstruction;
    if (!is_given(row->obstruction)) {
        row->obstruction = 0;
    }
    row->wavelength = input->wavelength;
    row->lowest_eyepiece = row->highest_eyepiece = NAN;
    if (!is_given(D) && is_given(row->setting.power) && !is_given(input->secondary)) {
        row->light = (struct visual_light){NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN};
        return true; /* magnification and field alone */
    }
    if (!visual_gather(&row->setting, &row->eye, row->obstruction, 1000 * input->wavelength,
                       &row->light, error)) {
        return false;
    }
    row->lowest_eyepiece = row->whole / row->light.lowest;
    row->highest_eyepiece = row->whole / row->light.highest;
    if (row->setting.exit_pupil > input->eye_pupil) {
        warnings_add(run->doubts,
                     "the exit pupil, %.4g mm, is wider than that of the eye, %.4g mm: of the "
                     "diameter %.4g mm are used",
                     row->setting.exit_pupil, input->eye_pupil, row->light.used_diameter);
    }
    if (row->setting.power > row->light.highest) {
        warnings_add(
            run->doubts,
            "the power %.4g is above the highest useful one, %.4g: it shows no more detail",
            row->setting.power, row->light.highest);
    }
    return true;
}

/* The exit pupil behind the eyepiece's glass, whose file begins at the eye with its stop. */
static void visual_fill_relief(const struct photo_lens *eyepiece, bool is_changed,
                               struct visual_row *row, struct run *run)
{
    const struct lens *lens = lens_at_position(eyepiece->lens, eyepiece->position, run->arena);
    double before = 0; /* from the first vertex to the first of glass */
    size_t first = 0;
    while (first < lens->surface_count && lens->surfaces[first].kind == SURFACE_STOP) {
        before += pair_double(lens->surfaces[first].thickness.value);
        first++;
    }
    if (lens->stop != LENS_NONE && lens->stop >= first) {
        warnings_add(run->doubts,
                     "the stop of %.60s, the pupil of the eye, is not before its glass: is it an "
                     "eyepiece, from the eye on ('convert --reverse')?",
                     eyepiece->real->title);
    }
    if (is_changed) {
        warnings_add(run->doubts, "a Barlow lens or reducer moves the exit pupil by as much as its "
                                  "own focal length says: no eye relief");
    } else {
        row->eye_relief =
            visual_eye_relief(row->setting.focal, eyepiece->f, before - eyepiece->first->ffl);
    }
}

/* Where its lenses and its exit pupil are, and what a camera behind it makes of them. */
static bool visual_fill_camera(const struct visual_input *input, bool is_galilean,
                               struct visual_row *row, struct run *run, struct error *error)
{
    const bool is_changed = is_given(input->barlow) || is_given(input->reducer);
    struct visual_setting *setting = &row->setting;
    if (row->binoculars == NULL && is_given(setting->power)) {
        row->image = is_galilean ? "upright" : "inverted";
    }
    if (is_galilean) {
        setting->eyepiece = -setting->eyepiece;
        warnings_add(run->doubts,
                     "a diverging eyepiece: the exit pupil lies inside the telescope, where no eye "
                     "can be; the objective bounds the field, softly");
    }
    if (!is_changed) { /* a Barlow lens stands between them */
        row->separation = setting->focal + setting->eyepiece;
        row->pupil_place = visual_pupil_place(setting->focal, setting->eyepiece);
    }
    if (!is_given(input->projection) && !is_given(input->afocal)) {
        return true;
    }
    if (is_galilean && is_given(input->projection)) {
        return fail(error, ERROR_DOMAIN,
                    "a diverging {--eyepiece} projects no image: {--barlow} takes its factor");
    }
    const struct visual_camera_given given = {.focal = row->whole,
                                              .diameter = setting->diameter,
                                              .eyepiece = setting->eyepiece,
                                              .power = setting->power,
                                              .projection = input->projection,
                                              .afocal = input->afocal};
    return visual_photograph(&given, &row->camera, error);
}

static bool visual_answer(const void *data, const struct photo_lens *eyepiece, struct run *run,
                          struct error *error)
{
    const struct visual_input *input = data;
    struct visual_row row = {
        .binoculars = input->binoculars.name,
        .setting = input->setting,
        .eye_relief = NAN,
        .barlow = input->barlow,
        .reducer = input->reducer,
        .back_focus = input->back_focus,
        .filter = input->filter,
        .filter_index = input->filter_index,
        .separation = NAN,
        .pupil_place = NAN,
        .projection = input->projection,
        .afocal = input->afocal,
        .camera = {NAN, NAN, NAN},
        .real = *eyepiece->real,
    };
    struct visual_setting *setting = &row.setting;
    setting->barlow = (is_given(input->barlow) ? input->barlow : 1) *
                      (is_given(input->reducer) ? input->reducer : 1);
    const bool is_changed = is_given(input->barlow) || is_given(input->reducer);
    if (row.binoculars != NULL) {
        setting->power = input->binoculars.power;
        setting->diameter = input->binoculars.number;
    }
    const double fe = eyepiece->lens != NULL ? eyepiece->f : input->eyepiece.focal;
    setting->eyepiece = fabs(fe); /* the power is a size */
    if (!visual_solve(setting, error)) {
        return false;
    }
    row.whole = setting->focal * setting->barlow;
    if (setting->power < 1) {
        warnings_add(run->doubts,
                     "the power is below 1: the eyepiece, %.4g mm, is longer than the telescope, "
                     "%.4g mm",
                     setting->eyepiece, row.whole);
    }
    row.whole_fnumber = setting->fnumber * setting->barlow;
    if (eyepiece->lens != NULL) {
        visual_fill_relief(eyepiece, is_changed, &row, run);
    }
    if (!visual_fill_camera(input, fe < 0, &row, run, error)) {
        return false;
    }
    row.spacing = input->back_focus + visual_filter_shift(input->filter, input->filter_index);
    if (!visual_fill_field(input, eyepiece, &row, error) ||
        !visual_fill_light(input, &row, run, error)) {
        return false;
    }
    run_emit(run, &row);
    return true;
}

static bool visual_run(const void *data, struct run *run, struct error *error)
{
    const struct visual_input *input = data;
    struct photo_lens_question question = input->lens;
    if (input->eyepiece.lens.lens != NULL) {
        question.lens = input->eyepiece.lens;
    }
    question.focal = (struct focal_value){.length = NAN, .equivalent = NAN};
    if (input->binoculars.name != NULL && !is_given(input->binoculars.number)) {
        return fail(error, ERROR_USAGE, "{binoculars} '%s' lack the diameter: 10x42",
                    input->binoculars.name);
    }
    return photo_lens_each(&question, PHOTO_LENS_WITHOUT_PUPILS, run, visual_answer, input, error);
}

static const struct explanation explanations[] = {
    {"power eyepiece", "M = {f} {B}/{fe}", "[Smith08]", NULL},
    {"exit_pupil", "ep = {D}/{M}", "[Smith08]", NULL},
    {"separation", "L = {f} + {fe}", "[Smith08]", "thin lenses, focused on the far"},
    {"exit_pupil_place", "x = {fe} ({f} + {fe})/{f}", "[Smith08], the image of the objective",
     "thin lenses"},
    {"projection_factor projection", "k = {v}/{fe} - 1", "thin lens 1/fe = 1/u + 1/v, k = v/u",
     "thin lens"},
    {"projection_factor !projection", "k = {fc}/{fe}", "two lenses with parallel light between",
     "the camera's lens focused at infinity"},
    {"true_field true_field_from=field-stop", "tf = 2 atan({s}/(2 {f} {B}))",
     "geometry; makers write s/f x 57.3 deg", "an image without distortion"},
    {"true_field_ratio", "tfr = {af}/{M}", "rule of the makers of eyepieces",
     "to some 10 %: eyepieces distort"},
    {"true_field_tangent", "tft = 2 atan(tan({af}/2)/{M})", "[IsoBinoculars02]",
     "eyepieces without distortion"},
    {"field_width", "W = 2 {A} tan({tf}/2)", "geometry", NULL},
    {"apparent_field apparent_field_from=tangents", "af = 2 atan({M} tan({tf}/2))",
     "[IsoBinoculars02]", NULL},
    {"apparent_field_ratio", "afr = {M} {tf}", "the rule before [IsoBinoculars02]", NULL},
    {"eye_relief", "er = back focus of the eyepiece on the eye's side + {fe}^2/{f}", "[Smith08]",
     NULL},
    {"used_diameter", "Du = min({D}, {M} {d})", "[Smith08]", NULL},
    {"light_gain", "G = ({Du}^2 - ({o} {D})^2)/{d}^2", "areas of the pupils",
     "glass that loses nothing"},
    {"limiting_magnitude", "ml = {me} + 2.5 log10({G})", "definition of magnitudes",
     "stars are points; the sky darkens with power, which helps"},
    {"rayleigh", "th = 1.21967 {w}/{Du}", "[BornWolf99] 8.5.2", NULL},
    {"dawes", "da = 116 arcsec/{Du}", "Dawes 1867, empirical; the diameter in mm", NULL},
    {"lowest_power", "Ml = {D}/{d}", "[Smith08]", NULL},
    {"matched_power", "Mm = 1 arcmin {D}/(1.21967 {w})", "[Smith08]: the eye resolves 1 arcmin",
     NULL},
    {"highest_power", "Mh = 2 {D}", "rule of thumb, 50 an inch; the diameter in mm",
     "the air seldom bears more than 300"},
    {"relative_brightness", "rb = {ep}^2", "makers of binoculars", NULL},
    {"twilight_factor", "tw = sqrt({M} {D})", "makers of binoculars", NULL},
    {"back_focus_filtered", "bf = {b} + {t} (1 - 1/{n})", "[Smith08], plane parallel plate",
     "paraxial"},
    {NULL, NULL, NULL, NULL},
};

static const struct example examples[] = {
    {"visual 1200mm f/6 --eyepiece 25mm --barlow 2x",
     "a telescope with an eyepiece and a Barlow lens"},
    {"visual --telescope 1200 --diameter 200 --eyepiece 32,25,10,5 --apparent-field 52deg",
     "a box of eyepieces"},
    {"visual --telescope 1200 -N 6 --eyepiece 24 --apparent-field 68deg --field-stop 27mm",
     "the true field by three rules"},
    {"visual --telescope 2032 -N 10 --obstruction 34% --exit-pupil 2mm",
     "the eyepiece for an exit pupil of 2 mm"},
    {"visual 10x42 --field 6.5deg", "binoculars"},
    {"visual 8x42 --field-width 330ft --at 1000yd --eye-pupil 3mm", "and by day"},
    {"visual --telescope 1000 --diameter 100 --eyepiece erfle-eyepiece", "a real eyepiece"},
    {"visual 30cm --eyepiece -5cm", "a Galilean telescope"},
    {"visual 1000mm f/8 --eyepiece 10mm --projection 100mm", "a camera behind the eyepiece"},
    {"visual 1000mm f/8 --eyepiece 25mm --afocal 6.9mm", "or a phone, with its own lens"},
    {"visual --diameter 150 --back-focus 55mm --filter-thickness 3mm", "where a camera stands"},
    {NULL, NULL},
};

PHOTO_LENS_MAKES_MANY(lens)

const struct command command_visual = {
    .name = "visual",
    .stop_size_wants = "",
    COMMAND_OF("photography", "telescopes, eyepieces and binoculars: power, field, limits"),
    .run = visual_run,
    .makes_many = makes_many,
    .varies = varies,
    .plot = "power|exit_pupil_mm",
    .plot_titles = "Magnification of a telescope|Exit pupil of a telescope",
    .cell = "power",
};
