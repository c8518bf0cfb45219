/* exchange/zemax/zemax_read.c - a .zmx file as a lens: system data, positions, solves. */
/* SPDX-License-Identifier: MIT */
#include "exchange/entrance_pupil.h"
#include "exchange/merge_positions.h"
#include "exchange/zemax/zemax.h"

#include "base/constants.h"
#include "file/lens_unit.h"
#include "optics/wavelength.h"

#include <math.h>
#include <string.h>

/* OBNA degrees 1: the marginal ray's angle at the object, n sin u. */
static bool set_zmx_cone(struct zemax_file *file, const struct zemax_line *line)
{
    struct lens *lens = file->build.lens;
    struct pair index = {1, 0};
    const double angle = zemax_number(line, 0);
    const double primary = file->wave_count > 0 ? file->waves[file->primary].value.hi : 0;
    if (!(angle < 90)) {
        return zemax_fail(line, line->numbers[0].typed,
                          "the angle of the cone must be below 90 degrees");
    }
    if (!medium_index(&lens->object_medium, primary > 0 ? primary : WAVELENGTH_D, &index,
                      file->error)) {
        file->error->code = ERROR_NONE;
        lens->aperture_kind = APERTURE_NONE;
        return zemax_loss(file, line, LOSS_OF_RAYS, "the lens gets no aperture",
                          "the angle of a cone in a medium of unknown index");
    }
    lens->aperture = figure_of(index.hi * sin(angle * RADIANS_PER_DEGREE), file->job->arena);
    return true;
}

static bool set_zmx_aperture(struct zemax_file *file)
{
    const struct zemax_line *line = file->aperture;
    struct lens *lens = file->build.lens;
    if (line == NULL) {
        return true;
    }
    if (text_same(line->keyword, "FLOA")) {
        lens->aperture_kind = APERTURE_STOP;
        lens->aperture = (struct figure){.typed = text_of("stop"), .variable = LENS_NONE};
        return true;
    }
    if (!(line->numbers[0].value.hi > 0)) {
        return zemax_fail(line, line->numbers[0].typed, "the aperture must be above 0");
    }
    lens->aperture = line->numbers[0];
    if (text_same(line->keyword, "ENPD")) {
        lens->aperture_kind = APERTURE_EPD;
    } else if (text_same(line->keyword, "FNUM")) {
        lens->aperture_kind = APERTURE_FNUMBER;
    } else {
        lens->aperture_kind = APERTURE_NA;
    }
    bool special = zemax_number(line, 1) != 0;
    if (lens->aperture_kind == APERTURE_NA && special) {
        return set_zmx_cone(file, line);
    }
    if (lens->aperture_kind == APERTURE_FNUMBER && special && !lens->object_is_infinite) {
        lens->aperture_kind = APERTURE_NONE; /* until its surfaces are known */
    }
    return true;
}

/* Field number `at`, from 0: its place in XFLN and YFLN, its weight in FWGN. */
static bool add_zmx_field(struct zemax_file *file, size_t at, bool angle)
{
    struct number_scale scale = angle ? NUMBER_UNSCALED : lens_unit_scale(file->build.lens->unit);
    const struct zemax_line *lines[2] = {file->x, file->y}, *weights = file->field_weights;
    struct lens_field *field = lens_build_field(&file->build);
    for (int i = 0; i < 2; i++) {
        bool has = lines[i] != NULL && at < lines[i]->count;
        field->at[i].typed = text_of("0");
        if (has) { /* read again, in the unit */
            field->at[i] = lines[i]->numbers[at];
            text_pair(field->at[i].typed, scale, &field->at[i].value);
        }
    }
    if (angle) {
        const char *wrong = lens_field_from_degrees(field);
        const struct zemax_line *line = field->at[1].value.hi != 0 ? file->y : file->x;
        if (wrong != NULL) {
            return zemax_fail(line, line->numbers[at].typed, "%s", wrong);
        }
    }
    if (weights != NULL && at < weights->count && weights->numbers[at].value.hi != 1) {
        field->weight = weights->numbers[at].value.hi;
        field->weight_typed = weights->numbers[at].typed;
    }
    return field->weight >= 0 ||
           zemax_fail(weights, field->weight_typed, "a weight is not below 0");
}

static bool set_fields(struct zemax_file *file)
{
    static const enum field_kind kinds[] = {FIELD_ANGLE, FIELD_HEIGHT, FIELD_IMAGE, FIELD_REAL};
    double type = zemax_number(file->fields, 0), stated = zemax_number(file->fields, 2);
    size_t x = file->x != NULL ? file->x->count : 0, y = file->y != NULL ? file->y->count : 0;
    size_t listed = x > y ? x : y;
    if (listed == 0) {
        return true;
    }
    size_t count = stated >= 1 && stated < (double)listed ? (size_t)stated : listed;
    if (!(type >= 0 && type <= 3)) {
        return zemax_loss(file, file->fields, LOSS_OF_RAYS, "left out", "fields of the kind %g",
                          type);
    }
    file->build.lens->field_kind = kinds[(int)type];
    for (size_t i = 0; i < count; i++) {
        if (!add_zmx_field(file, i, type == 0)) {
            return false;
        }
    }
    /* some versions list twelve, and have the others in lines of another form */
    return !(stated > (double)listed && stated > 12) ||
           zemax_loss(file, file->fields, LOSS_OF_RAYS, "the others are left out",
                      "FTYP counts %g fields, XFLN and YFLN have %zu", stated, listed);
}

/* Points at PWAV where the file has it. */
static bool fail_waves(const struct zemax_file *file, const char *message)
{
    if (file->primary_line != NULL) {
        return zemax_fail(file->primary_line, file->primary_line->keyword, "%s", message);
    }
    return foreign_fail(file->job, file->error, "%s", message);
}

/* The primary one first. */
static bool set_waves(struct zemax_file *file)
{
    const size_t count = zemax_wave_count(file);
    if (count > 0 && file->primary >= count) {
        return fail_waves(file, arena_printf(file->job->arena,
                                             "the primary wavelength is number %zu of %zu",
                                             file->primary + 1, count));
    }
    for (size_t i = 0; i < count; i++) {
        size_t at = i == 0 ? file->primary : i - (i <= file->primary);
        double wavelength = file->waves[at].value.hi, weight = file->weights[at].value.hi;
        if (!(wavelength > 0) || !(weight >= 0)) {
            return fail_waves(
                file, arena_printf(file->job->arena,
                                   "wavelength %zu is missing, or its weight is below 0", at + 1));
        }
        struct lens_wavelength *one = lens_build_wavelength(&file->build, wavelength, weight);
        bool is_line = one->typed.start[one->typed.length - 1] != 'm';
        one->typed = is_line ? one->typed
                             : text_of(arena_printf(file->job->arena, "%.*sum",
                                                    (int)file->waves[at].typed.length,
                                                    file->waves[at].typed.start));
    }
    return true;
}

/* A plane in air that does nothing but stand at its place. */
static bool is_plain_plane(const struct zemax_surface *surface)
{
    const struct zemax_line *thickness = surface->thickness;
    bool standard = surface->type == NULL || text_same(surface->type->first, "STANDARD");
    return standard && zemax_number(surface->curvature, 0) == 0 &&
           zemax_number(surface->curvature, 1) < 2 && surface->glass == NULL &&
           surface->clear == NULL && surface->solve == NULL && !surface->is_stop &&
           surface->shift_before == NULL && surface->shift_behind == NULL && thickness != NULL &&
           thickness->count > 0;
}

/*
 * An object in or behind the first surface, where that is nothing: it lies before the first surface
 * that is something. The planes between are passed over, with a note.
 */
static bool pass_planes(struct zemax_file *file, struct pair *distance)
{
    size_t at = 1;
    while (!(distance->hi > 0) && file->configurations < 2 && at + 2 < file->surface_count &&
           file->surfaces[0].glass == NULL && is_plain_plane(&file->surfaces[at])) {
        *distance = pair_add(*distance, file->surfaces[at++].thickness->numbers[0].value);
    }
    if (!(distance->hi > 0)) {
        return false;
    }
    file->passed = at - 1;
    zemax_remark(file, "surfaces 1 to %zu are planes in air at or before the object, passed over",
                 at - 1);
    return true;
}

/* Has a surface of a type with a shape of its own numbers that give it one? */
static bool has_shape_numbers(const struct zemax_surface *surface)
{
    bool shaped = false;
    for (size_t i = 1; i < ZEMAX_PARAMETERS; i++) {
        shaped = shaped || zemax_number(surface->parameters[i], 1) != 0;
    }
    return shaped && surface->type != NULL && !text_same(surface->type->first, "STANDARD");
}

/* Object and image are planes across the axis; what the file says of them beyond that is lost. */
static void check_flat_end(struct zemax_file *file, const struct zemax_surface *surface,
                           const char *curved, const char *tilted)
{
    if (zemax_number(surface->curvature, 0) != 0) {
        zemax_loss(file, surface->curvature, LOSS_OF_RAYS, "taken for a plane", "%s", curved);
    }
    if (has_shape_numbers(surface)) {
        bool tilt = text_same(surface->type->first, "TILTSURF");
        zemax_loss(file, surface->type, LOSS_OF_RAYS,
                   tilt ? "taken across the axis" : "taken for a plane", "%s",
                   tilt ? tilted : curved);
        return;
    }
}

/* Does the object lie in or behind the first surface, in any of the configurations? */
static bool is_virtual(const struct zemax_file *file)
{
    const struct zemax_line *own = file->surfaces[0].thickness;
    bool is = own != NULL && !own->infinite && !(zemax_number(own, 0) > 0);
    for (const struct zemax_setting *one = file->settings; one != NULL; one = one->next) {
        bool of_object = one->surface == 0 && text_same(one->line->keyword, "THIC");
        is = is || (of_object && one->line->count > 2 && !(zemax_number(one->line, 2) > 0));
    }
    return is;
}

/* The object's distance, and what lies before the first surface. */
static bool set_object(struct zemax_file *file)
{
    const double far = 1e10; /* what the program writes for infinity where it wants a number */
    struct lens *lens = file->build.lens;
    struct zemax_surface *object = &file->surfaces[0];
    const struct zemax_line *line = object->thickness;
    bool finite = line != NULL && !line->infinite && fabs(line->numbers[0].value.hi) < far;
    check_flat_end(file, object, "a curved object", "a tilted object");
    bool shifts = zemax_is_tilted(file, 0) || zemax_number(object->shift_behind, 2) != 0;
    for (size_t i = 3; i < 8; i++) {
        shifts = shifts || zemax_number(object->shift_behind, i) != 0;
    }
    if (shifts && !has_shape_numbers(object)) {
        zemax_loss(file, object->surf, LOSS_OF_RAYS, "taken across the axis",
                   "SCBD: a shifted or tilted object");
    }
    if (object->is_stop) {
        return zemax_fail(object->surf, object->surf->keyword, "the object is the stop");
    }
    if (object->glass != NULL && !zemax_medium(file, object, &medium_air, &lens->object_medium)) {
        return false;
    }
    if (finite) {
        /* The distance of an object that is not far. */
        const struct figure *figure = &line->numbers[0];
        struct pair distance = figure->value;
        lens->object_is_infinite = false;
        lens->object = *figure;
        if (is_virtual(file)) {
            if (pass_planes(file, &distance)) {
                lens->object =
                    figure_computed(distance, lens_unit_scale(lens->unit), file->job->arena);
            } else {
                virtual_object_put(&file->build, figure->value);
            }
        }
    } else if (is_virtual(file)) { /* in another configuration, which has this plane */
        lens_build_surface(&file->build)->medium = lens->object_medium;
    }
    return true;
}

/* A word of a .lens file that is no word of another meaning. */
static bool is_zmx_position(struct text name)
{
    for (size_t i = 0; i < name.length; i++) {
        char c = name.start[i], lower = (char)(c | 32);
        if (!((lower >= 'a' && lower <= 'z') || (c >= '0' && c <= '9') || c == '-' || c == '_' ||
              c == '.' || c == '+')) {
            return false;
        }
    }
    return name.length > 0 && !text_same(name, "all");
}

/* The names of the positions, if lenscalc wrote as many as there are. */
static void name_positions(struct zemax_file *file)
{
    struct lens *lens = file->build.lens;
    struct text rest = file->position_names;
    size_t count = 1;
    for (size_t i = 0; i < rest.length; i++) {
        count += rest.start[i] == ' ';
    }
    if (rest.length == 0 || count != lens->position_count) {
        return;
    }
    for (size_t i = 0; i < count; i++) {
        struct text name = text_cut(&rest, ' ');
        if (!is_zmx_position(name) || lens_position_find(lens, name) != LENS_NONE) {
            return;
        }
        lens->positions[i] = arena_string(file->job->arena, name.start, name.length);
    }
}

/* How many positions, and their names: "1", "2" .. */
static void set_positions(struct zemax_file *file)
{
    struct lens *lens = file->build.lens;
    if (file->configurations < 2) {
        keep_notes_apply(&file->notes, &file->build);
        return;
    }
    lens->positions = ARENA_ARRAY(file->job->arena, file->configurations, const char *);
    lens->position_count = file->configurations;
    for (size_t i = 0; i < file->configurations; i++) {
        lens->positions[i] = arena_printf(file->job->arena, "%zu", i + 1);
    }
    name_positions(file);
    keep_notes_apply(&file->notes, &file->build);
}

/* The image is a plane, that may be tilted. */
static bool check_image(struct zemax_file *file)
{
    const struct zemax_surface *image = &file->surfaces[file->surface_count - 1];
    bool turns = image->type != NULL && text_same(image->type->first, "TILTSURF") &&
                 zemax_is_tilted(file, file->surface_count - 1);
    if (!turns) {
        check_flat_end(file, image, "a curved image", "");
    }
    if (image->is_stop) {
        return zemax_fail(image->surf, image->surf->keyword, "the image is the stop");
    }
    return true;
}

/*
 * Vignetting factors narrow the beams of the fields as the rims of the surfaces do. Here the clear
 * diameters do it, if all surfaces that bend light have one; else the factors are lost.
 */
static void settle_vignetting(struct zemax_file *file)
{
    bool all = true;
    if (file->vignetting == NULL) {
        return;
    }
    for (size_t i = 1; i + 1 < file->surface_count; i++) {
        const struct zemax_surface *one = &file->surfaces[i];
        bool bends = one->glass != NULL || zemax_number(one->curvature, 0) != 0;
        all = all && (!bends || zemax_number(one->diameter, 0) > 0 || one->clear != NULL);
    }
    if (all) {
        zemax_remark(file, "vignetting factors of the fields: the clear diameters limit the beams");
        return;
    }
    const struct zemax_line *line = file->vignetting;
    size_t first = 0;
    while (line->numbers[first].value.hi == 0) {
        first++;
    }
    foreign_loss(file->job, &line->words, line->numbers[first].typed, LOSS_OF_VIGNETTING, NULL,
                 "%.4s: vignetting factors of the fields", line->keyword.start);
}

/* The lens of a file, or of one of its configurations. */
static bool build_zmx_lens(struct zemax_file *file)
{
    if (!set_object(file)) {
        return false;
    }
    /* FTYP says it of an object at infinity too, which has no such space. */
    struct lens *lens = file->build.lens;
    const bool stated = zemax_number(file->fields, 1) != 0;
    lens->is_telecentric = stated && !lens->object_is_infinite;
    if (lens->is_telecentric != stated) {
        zemax_loss(file, file->fields, LOSS_OF_RAYS, "an ordinary one",
                   "a telecentric object space of an object at infinity");
    }
    if (!check_image(file) || !set_zmx_aperture(file) || !set_fields(file) || !set_waves(file) ||
        !zemax_surfaces(file)) {
        return false;
    }
    /* FNUM N 1 of a near object. */
    const struct zemax_line *line = file->aperture;
    if (line != NULL && text_same(line->keyword, "FNUM") && zemax_number(line, 1) != 0 &&
        !lens->object_is_infinite &&
        !entrance_pupil_set(lens, PUPIL_WORKING_FNUMBER, zemax_number(line, 0), file->job->arena)) {
        zemax_loss(file, line, LOSS_OF_RAYS, "the lens gets no aperture",
                   "a working f-number that no entrance pupil gives");
    }
    /* An aperture at a stop wants the stop's diameter. */
    if (lens->aperture_kind == APERTURE_STOP &&
        (lens->stop == LENS_NONE || !lens->surfaces[lens->stop].has_diameter)) {
        lens->aperture_kind = APERTURE_NONE;
        zemax_loss(file, file->aperture, LOSS_OF_RAYS, "the lens gets none",
                   "the aperture is that of the stop, which has no diameter");
    }
    /* The image plane lies where the marginal ray meets the axis, if the file says so. */
    lens->focus = zemax_focuses(file) ? FOCUS_PARAXIAL : FOCUS_TABLE;
    if (zemax_number(file->fields, 6) != 0) {
        lens->focus = FOCUS_AFOCAL;
    }
    return true;
}

/* The lens of a file with configurations: built once for each of them, then put together. */
static bool build_positions(struct zemax_file *file)
{
    struct arena *arena = file->job->arena;
    const struct lens named = *file->build.lens;
    struct lens *lenses = ARENA_ARRAY(arena, file->configurations, struct lens);
    for (size_t p = 0; p < file->configurations; p++) {
        struct zemax_file one = *file;
        one.configuration = p + 1;
        size_t losses = file->job->loss_count;
        lenses[p] = named;
        lenses[p].position_count = 0;
        one.build =
            (struct lens_build){.lens = &lenses[p], .arena = arena, .note_room = named.note_count};
        one.surfaces = ARENA_COPY(arena, file->surfaces, file->surface_count, 0);
        if (!zemax_place_settings(&one, p) || !build_zmx_lens(&one)) {
            return false;
        }
        foreign_forget_repeated(file->job, p > 0 ? losses : file->job->loss_count);
    }
    merge_positions(&file->build, lenses, file->job);
    return true;
}

/* The lens of a file, where name and numbers of a glass differ with the one or the other. */
static bool read_zmx_file(struct foreign_job *job, struct text content, bool takes_numbers,
                          struct zemax_doubts *doubts, struct lens *lens, struct error *error)
{
    struct zemax_file file = {
        .job = job, .error = error, .takes_numbers = takes_numbers, .doubts = doubts};
    *doubts = (struct zemax_doubts){0, 0};
    file.settings_end = &file.settings;
    lens_build_begin(&file.build, lens, job->arena);
    if (!zemax_parse(&file, content)) {
        return false;
    }
    settle_vignetting(&file);
    if (!file.has_gaps && !zemax_check_circles(&file)) {
        return false;
    }
    set_positions(&file);
    if (!(file.configurations < 2 ? build_zmx_lens(&file) : build_positions(&file))) {
        return false;
    }
    foreign_mark_power(job, &file.build);
    return true;
}

/*
 * Where the solves contradict the lens with the catalogue's glasses, and confirm the one with the
 * numbers beside their names, the program that has written the file means these.
 */
static bool zemax_read_file(struct foreign_job *job, struct text content, struct lens *lens,
                            struct error *error)
{
    const struct foreign_job unread = *job;
    struct zemax_doubts doubts, others;
    struct lens other;
    bool done = read_zmx_file(job, content, false, &doubts, lens, error);
    if (!done || doubts.contradicted == 0 || doubts.disputed == 0 ||
        job->glass_numbers != GLASS_NUMBERS_OF_FILE) {
        return done;
    }
    struct foreign_job again = unread;
    struct error unused;
    if (read_zmx_file(&again, content, true, &others, &other, &unused) &&
        others.contradicted == 0) {
        *job = again;
        *lens = other;
    }
    return true;
}

/* "MODE", "VERS" or "UNIT" begins a line, and "SURF 0" another. */
static bool zemax_is_like(struct text content)
{
    static const char *const words[] = {"VERS", "MODE", "NAME", "UNIT", "NOTE", "ENPD", "FNUM"};
    struct text rest = content, line = text_trim(text_cut(&rest, '\n'));
    while (rest.start != NULL && line.length == 0) {
        line = text_trim(text_cut(&rest, '\n'));
    }
    bool begins = false;
    for (size_t i = 0; i < sizeof words / sizeof words[0]; i++) {
        size_t length = strlen(words[i]);
        begins = begins || (line.length >= length && memcmp(line.start, words[i], length) == 0 &&
                            (line.length == length || line.start[length] == ' '));
    }
    while (begins && rest.start != NULL) {
        line = text_trim(text_cut(&rest, '\n'));
        if (text_equal(line, "SURF 0")) {
            return true;
        }
    }
    return false;
}

const struct foreign_format zemax_format = {
    .type = {{"zmx", "Zemax OpticStudio"}, ".zmx"},
    .is_like = zemax_is_like,
    .read = zemax_read_file,
    .write = zemax_write,
    .has_settings = true,
    .words = zemax_words,
    .has_thick = true,
    .has_apertures = true,
    .has_glass_numbers = true,
};
