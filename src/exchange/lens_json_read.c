/* exchange/lens_json_read.c - a lens from the JSON that lenscalc writes. */
/* SPDX-License-Identifier: MIT */
#include "exchange/lens_json.h"

#include "base/constants.h"
#include "file/lens_unit.h"
#include "file/lens_words.h"

#include <math.h>

static bool json_wave(struct json_reader *reading, const struct json_value *item)
{
    const struct json_value *name = json_item(item, "name"),
                            *wave = json_item(item, "wavelength_nm"),
                            *weight = json_item(item, "weight");
    struct figure figure = {.value = {1, 0}}, length;
    if (json_is_null(wave)) {
        return json_wrong(reading, item, "a wavelength without its nm");
    }
    if (!json_check_keys(reading, item, "name wavelength_nm weight") ||
        !json_read_figure(reading, wave, JSON_PLAIN, &length) ||
        (!json_is_null(weight) && !json_read_figure(reading, weight, JSON_PLAIN, &figure))) {
        return false;
    }
    double micrometres = 0;
    text_number(wave->text, (struct number_scale){1, -3}, &micrometres);
    if (!(micrometres >= 0.001 && micrometres <= 1000) || !(figure.value.hi >= 0)) {
        return json_wrong(reading, item,
                          "a wavelength is within 1 to 1e6 nm, a weight is not below 0");
    }
    struct lens_wavelength *one =
        lens_build_wavelength(&reading->build, micrometres, figure.value.hi);
    double named = 0;
    struct file_words words = json_place(reading, item);
    struct error ignored;
    words.error = &ignored;
    if (!json_is_null(name) && name->kind == JSON_STRING &&
        lens_words_wavelength(&words, name->text, &named) && named == micrometres) {
        one->typed = name->text; /* as it was typed, if it is this one */
    }
    return true;
}

static bool json_waves(struct json_reader *reading, const struct json_value *value)
{
    if (!json_check_array(reading, value, "wavelengths")) {
        return false;
    }
    for (const struct json_value *item = json_first(value); item != NULL; item = item->next) {
        if (!json_wave(reading, item)) {
            return false;
        }
    }
    return true;
}

/* The object's distance: null is infinite. */
static bool json_distance(struct json_reader *reading, const struct json_value *value,
                          struct figure *figure)
{
    if (json_is_null(value)) {
        *figure = (struct figure){{INFINITY, 0}, text_of("inf"), LENS_NONE};
        return true;
    }
    return json_read_figure(reading, value, JSON_LENGTH, figure) &&
           (figure->value.hi > 0 || json_wrong(reading, value, "the object's distance is above 0"));
}

static bool json_object(struct json_reader *reading, const struct json_value *value)
{
    struct lens *lens = reading->build.lens;
    if (json_is_null(value) || value->kind != JSON_ARRAY) {
        bool done = json_distance(reading, value, &lens->object);
        lens->object_is_infinite = done && isinf(lens->object.value.hi);
        return done;
    }
    struct figure *objects = ARENA_ARRAY(reading->job->arena, value->count, struct figure);
    size_t i = 0;
    for (const struct json_value *item = value->first; item != NULL; item = item->next) {
        if (!json_distance(reading, item, &objects[i++])) {
            return false;
        }
    }
    if (!json_check_count(reading, value)) {
        return false;
    }
    lens->objects = objects;
    lens->object = objects[0];
    lens->object_is_infinite = isinf(objects[0].value.hi);
    return true;
}

/* Whether the object is infinite: one truth, or one for each position. */
static bool json_check_infinite(struct json_reader *reading, const struct json_value *value)
{
    static const char key[] = "object_is_infinite", other[] = "object_mm";
    const struct lens *lens = reading->build.lens;
    size_t i = 0;
    if (json_is_null(value) || value->kind != JSON_ARRAY) {
        return json_check_truth(reading, value, lens->object_is_infinite, key, other);
    }
    if (!json_check_count(reading, value)) {
        return false;
    }
    for (const struct json_value *item = value->first; item != NULL; item = item->next) {
        const struct figure *object = lens->objects != NULL ? &lens->objects[i++] : &lens->object;
        if (!json_check_truth(reading, item, isinf(object->value.hi), key, other)) {
            return false;
        }
    }
    return true;
}

/* An array of as many numbers as there are fields, or nothing: `figures` becomes null. */
static bool json_per_field(struct json_reader *reading, const struct json_value *numbers, int power,
                           struct figure **figures)
{
    *figures = NULL;
    if (json_is_null(numbers)) {
        return true;
    }
    if (!json_check_array(reading, numbers, "numbers")) {
        return false;
    }
    if (numbers->count != reading->build.lens->field_count) {
        return json_wrong(reading, numbers, "%zu numbers for %zu fields", numbers->count,
                          reading->build.lens->field_count);
    }
    return json_read_figures(reading, numbers, power, figures);
}

/* x, and the weights. */
static bool json_complete_fields(struct json_reader *reading, const struct json_value *root,
                                 int power)
{
    struct lens *lens = reading->build.lens;
    const struct json_value *weights = json_item(root, "field_weights"),
                            *beside = json_item(root, "fields_x");
    struct figure *all, *weight;
    if (!json_per_field(reading, beside, power, &all) ||
        !json_per_field(reading, weights, JSON_PLAIN, &weight)) {
        return false;
    }
    for (size_t i = 0; i < lens->field_count; i++) {
        struct lens_field *field = &lens->fields[i];
        field->at[0] = all != NULL ? all[i] : field->at[0];
        if (weight != NULL && weight[i].value.hi != 1) {
            field->weight = weight[i].value.hi;
            field->weight_typed = weight[i].typed;
        }
        if (!(field->weight >= 0)) {
            return json_wrong(reading, weights, "a weight is not below 0");
        }
    }
    return true;
}

static bool json_fields(struct json_reader *reading, const struct json_value *root)
{
    static const char *const kinds[] = {"none", "angle_deg", "height_mm", "image_mm", "real_mm"};
    struct lens *lens = reading->build.lens;
    const struct json_value *kind = json_item(root, "field_kind"),
                            *fields = json_item(root, "fields");
    struct figure *figures;
    int choice = 0;
    if (!json_check_array(reading, fields, "numbers") ||
        !json_read_choice(reading, kind, kinds, FIELD_KINDS, &choice)) {
        return false;
    }
    if (json_is_null(fields) || fields->count == 0) {
        return true;
    }
    if (choice == FIELD_NONE) {
        return json_wrong(reading, fields, "fields without their kind");
    }
    const int power = choice == FIELD_ANGLE ? JSON_ANGLE : JSON_LENGTH;
    if (!json_read_figures(reading, fields, power, &figures)) {
        return false;
    }
    lens->field_kind = (enum field_kind)choice;
    for (size_t i = 0; i < fields->count; i++) {
        lens_build_field(&reading->build)->at[1] = figures[i];
    }
    if (!json_complete_fields(reading, root, power)) {
        return false;
    }
    for (size_t i = 0; choice == FIELD_ANGLE && i < fields->count; i++) {
        const char *wrong = lens_field_wrong(&lens->fields[i], 180 * RADIANS_PER_DEGREE);
        if (wrong != NULL) {
            return json_wrong(reading, fields, "%s", wrong);
        }
    }
    return true;
}

static bool json_system_aperture(struct json_reader *reading, const struct json_value *root)
{
    static const char *const kinds[] = {"none", "stop", "fnumber", "epd_mm", "na"};
    struct lens *lens = reading->build.lens;
    const struct json_value *kind = json_item(root, "aperture_kind"),
                            *value = json_item(root, "aperture");
    int choice = 0;
    if (!json_read_choice(reading, kind, kinds, 5, &choice)) {
        return false;
    }
    lens->aperture_kind = (enum aperture_kind)choice;
    if (choice <= APERTURE_STOP) {
        lens->aperture.typed = text_of("stop");
        return json_is_null(value) ||
               json_wrong(reading, value,
                          choice == APERTURE_STOP ? "the stop's diameter is that of its surface"
                                                  : "an aperture without its kind");
    }
    if (json_is_null(value)) {
        return json_wrong(reading, kind, "an aperture without its value");
    }
    int power = choice == APERTURE_EPD ? JSON_LENGTH : JSON_PLAIN;
    struct figure *values = &lens->aperture;
    size_t count = 1;
    if (value->kind == JSON_ARRAY) {
        if (!json_check_count(reading, value) ||
            !json_read_figures(reading, value, power, &values)) {
            return false;
        }
        lens->apertures = values;
        lens->aperture = values[0];
        count = value->count;
    } else if (!json_read_figure(reading, value, power, &lens->aperture)) {
        return false;
    }
    for (size_t i = 0; i < count; i++) {
        if (!(values[i].value.hi > 0)) {
            return json_wrong(reading, value, "the aperture must be above 0");
        }
    }
    return true;
}

static bool json_stated(struct json_reader *reading, const struct json_value *root)
{
    static const char *const keys[] = {"stated_efl_mm", "stated_bfl_mm", "stated_fnumber",
                                       "stated_tstop"};
    struct lens *lens = reading->build.lens;
    for (int i = 0; i < STATED_COUNT; i++) {
        const struct json_value *value = json_item(root, keys[i]);
        struct figure *figures = NULL;
        if (!json_check_array(reading, value, "numbers")) {
            return false;
        }
        if (json_is_null(value) || value->count == 0) {
            continue;
        }
        if (value->count != 1 && !json_check_count(reading, value)) {
            return false;
        }
        if (!json_read_figures(reading, value, stated_is_length(i) ? JSON_LENGTH : JSON_PLAIN,
                               &figures)) {
            return false;
        }
        lens->stated[i] = figures;
        lens->stated_count[i] = value->count;
    }
    return true;
}

static bool json_notes(struct json_reader *reading, const struct json_value *value)
{
    if (!json_check_array(reading, value, "texts")) {
        return false;
    }
    for (const struct json_value *item = json_first(value); item != NULL; item = item->next) {
        if (item->kind != JSON_STRING) {
            return json_wrong(reading, item, "a note is a text");
        }
        lens_build_note(&reading->build, item->text);
    }
    return true;
}

static bool json_names_position(struct text name)
{
    for (size_t i = 0; i < name.length; i++) {
        unsigned char c = (unsigned char)name.start[i];
        if (c <= ' ' || c == '"' || c == '#' || c == '{') {
            return false;
        }
    }
    return name.length > 0 && !text_equal(name, "all");
}

static bool json_positions(struct json_reader *reading, const struct json_value *value)
{
    enum { MOST = 1000 };
    struct lens *lens = reading->build.lens;
    if (!json_check_array(reading, value, "names")) {
        return false;
    }
    if (json_is_null(value)) {
        return true;
    }
    if (value->count > MOST) {
        return json_wrong(reading, value, "more than %d positions", MOST);
    }
    lens->positions = ARENA_ARRAY(reading->job->arena, value->count, const char *);
    for (const struct json_value *item = value->first; item != NULL; item = item->next) {
        if (item->kind != JSON_STRING || !json_names_position(item->text) ||
            lens_position_find(lens, item->text) != LENS_NONE) {
            return json_wrong(reading, item,
                              "a position's name is a word, not 'all', and appears once");
        }
        lens->positions[lens->position_count++] =
            arena_string(reading->job->arena, item->text.start, item->text.length);
    }
    return true;
}

static bool json_unit(struct json_reader *reading, const struct json_value *value)
{
    const char *units[LENS_UNITS];
    int choice = 0;
    for (size_t i = 0; i < LENS_UNITS; i++) {
        units[i] = lens_units[i].word;
    }
    if (!json_read_choice(reading, value, units, LENS_UNITS, &choice)) {
        return false;
    }
    reading->build.lens->unit = units[choice];
    return true;
}

static bool json_focus(struct json_reader *reading, const struct json_value *value)
{
    static const char *const words[] = {"paraxial", "table", "best", "afocal"};
    int choice = 0;
    bool done = json_read_choice(reading, value, words, FOCUS_KINDS, &choice);
    reading->build.lens->focus = (enum focus_kind)choice;
    return done;
}

static bool json_surfaces(struct json_reader *reading, const struct json_value *value)
{
    for (const struct json_value *item = value->first; item != NULL; item = item->next) {
        if (!json_read_surface(reading, item)) {
            return false;
        }
        const struct lens *lens = reading->build.lens;
        const struct surface *surface = &lens->surfaces[lens->surface_count - 1];
        if (!surface->has_thickness && item->next != NULL) {
            return json_wrong(reading, item, "the thickness is missing");
        }
        if (surface->has_diameter && surface->diameter.variable == LENS_NONE &&
            !(surface->diameter.value.hi > 0)) {
            return json_wrong(reading, item, "the diameter must be above 0");
        }
    }
    return value->count > 0 || json_wrong(reading, value, "the lens has no surface");
}

/* The number of the surface that says it is the stop. */
static bool json_check_stop(struct json_reader *reading, const struct json_value *value)
{
    const struct lens *lens = reading->build.lens;
    struct figure number = {.value = {0, 0}};
    if (value == NULL) {
        return true;
    }
    if (value->kind != JSON_NULL && !json_read_figure(reading, value, JSON_PLAIN, &number)) {
        return false;
    }
    double stop = lens->stop == LENS_NONE ? 0 : (double)lens->stop + 1;
    return number.value.hi == stop ||
           json_wrong(reading, value, "stop_surface contradicts is_stop");
}

/* What the lens is called and what is said of it. */
static bool json_titles(struct json_reader *reading, const struct json_value *root)
{
    struct lens *lens = reading->build.lens;
    return json_read_text(reading, json_item(root, "lens"), &lens->title) &&
           json_read_text(reading, json_item(root, "source"), &lens->source) &&
           json_read_text(reading, json_item(root, "kind"), &lens->kind) &&
           json_notes(reading, json_item(root, "notes"));
}

static bool json_object_space(struct json_reader *reading, const struct json_value *root)
{
    const struct json_value *value = json_item(root, "object_is_telecentric");
    return json_check_infinite(reading, json_item(root, "object_is_infinite")) &&
           (json_is_null(value) ||
            json_read_truth(reading, value, &reading->build.lens->is_telecentric)) &&
           json_read_medium(reading, json_item(root, "object_medium"),
                            &reading->build.lens->object_medium);
}

static bool json_stop_size(struct json_reader *reading, const struct json_value *value)
{
    struct lens *lens = reading->build.lens;
    if (json_is_null(value)) {
        return true;
    }
    return json_read_truth(reading, value, &lens->stop_is_real) &&
           (!lens->stop_is_real || lens->aperture_kind > APERTURE_STOP ||
            json_wrong(reading, value, "no aperture sizes the stop"));
}

static bool json_lens(struct json_reader *reading, const struct json_value *root)
{
    static const char keys[] =
        "lens source kind notes positions unit wavelengths object_mm fields object_medium "
        "field_kind object_is_infinite aperture aperture_kind focus stop_surface stated_efl_mm "
        "stated_bfl_mm stated_fnumber stated_tstop surfaces fields_x field_weights settings "
        "object_is_telecentric pickups goals tolerances stop_is_real";
    return json_check_keys(reading, root, keys) && json_titles(reading, root) &&
           json_unit(reading, json_item(root, "unit")) &&
           json_positions(reading, json_item(root, "positions")) &&
           json_waves(reading, json_item(root, "wavelengths")) &&
           json_object(reading, json_item(root, "object_mm")) && json_object_space(reading, root) &&
           json_fields(reading, root) && json_system_aperture(reading, root) &&
           json_stop_size(reading, json_item(root, "stop_is_real")) &&
           json_focus(reading, json_item(root, "focus")) && json_stated(reading, root) &&
           json_surfaces(reading, json_item(root, "surfaces")) &&
           json_check_stop(reading, json_item(root, "stop_surface")) &&
           json_read_settings(reading, json_item(root, "settings")) &&
           json_read_design(reading, json_item(root, "pickups"), json_item(root, "goals"),
                            json_item(root, "tolerances"));
}

static bool json_refuse(struct json_reader *reading)
{
    const struct json_value start = {.at = 1};
    json_wrong(reading, &start,
               "no JSON of lenscalc, which begins with \"lens\" and has \"surfaces\"; that of "
               "other programs (ray-optics) is not read");
    return error_hint(reading->error, "lenscalc-convert(1) tells which files a lens is read from");
}

bool lens_json_read(struct foreign_job *job, struct text content, struct lens *lens,
                    struct error *error)
{
    struct json_reader reading = {.job = job, .content = content, .error = error, .line = 1};
    struct json json = json_open(content, job->arena, error);
    struct json_value root;
    if (!json_tree(&json, &root)) {
        /* Why there is no tree: JSON of another program may hold what JSON has no words for. */
        const struct error found = *reading.error;
        const struct json_value at = {.at = (size_t)(json.at - reading.content.start) + 1};
        struct json first = json_open(reading.content, reading.job->arena, reading.error);
        struct text key = {NULL, 0};
        if (!json_take(&first, '{') || !json_string(&first, &key) || !text_equal(key, "lens")) {
            return json_refuse(&reading);
        }
        return json_wrong(&reading, &at, "%s", found.message);
    }
    job->has_end = true; /* all that was opened is closed */
    const struct json_value *surfaces = json_item(&root, "surfaces");
    if (root.kind != JSON_OBJECT || surfaces == NULL || surfaces->kind != JSON_ARRAY ||
        json_item(&root, "lens") == NULL) {
        return json_refuse(&reading);
    }
    lens_build_begin(&reading.build, lens, job->arena);
    return json_lens(&reading, &root);
}
