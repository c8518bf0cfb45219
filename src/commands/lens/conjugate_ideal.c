/* commands/lens/conjugate_ideal.c - conjugate of thin lenses and mirrors by their numbers. */
/* SPDX-License-Identifier: MIT */
#include "commands/lens/conjugate_ideal.h"

#include "commands/tables.h"
#include "draw/ray_diagram.h"

/* Indexed by enum conjugate_from. */
const struct word conjugate_froms[] = {
    [CONJUGATE_FROM_PRINCIPAL] = {"principal", "the object from H, the image from H'"},
    [CONJUGATE_FROM_FRONT] = {"front", "from the first vertex, from the last"},
    [CONJUGATE_FROM_FOCAL] = {"focal", "from F, from F' (Newton)"},
    [CONJUGATE_FROM_ENTRANCE] = {"entrance", "from the entrance pupil, from the exit pupil"},
    [CONJUGATE_FROM_SENSOR] = {"sensor", "the object from the image plane"},
    [FROM_LENS] = {"lens", "principal; of --focal-length and --mirror front"},
    {NULL, NULL},
};

#define ROW struct conjugate_row

#define MM(member, more)    LENGTH(member, "mm"), .flags = (more)
#define PLAIN(member, more) SHOWN(member), .flags = (more)

static const struct column ideal_columns[] = {
    {PLAIN(step, COLUMN_BRIEF | COLUMN_EXTRA), .name = "step", .with = "steps",
     .help = "which lens the row is about; its object is the image of the one before"},
    {PLAIN(mirror, COLUMN_ECHO | COLUMN_EXTRA), .name = "mirror", .with = "mirror",
     .help = "concave, convex or plane"},
    {MM(focal, COLUMN_BRIEF | COLUMN_INFINITE), .name = "focal", .repeats = "focal-length",
     .symbol = "f", .label = "focal length",
     .help = "of the lens or mirror, the first one; below 0 diverging"},
    {MM(efl, COLUMN_SPARSE | COLUMN_INFINITE), .name = "efl", .label = "combined focal length",
     .when = "of several lenses", .help = "focal length of all lenses together"},
    {MEASURED(power, vergence, "diopter"), .name = "power", .symbol = "P", .repeats = "power",
     .help = "power of all of it, 1/f"},
    {MM(radius, COLUMN_EXTRA | COLUMN_INFINITE), .name = "radius", .with = "mirror",
     .help = "radius of the mirror, a size"},
    {MM(object, COLUMN_BRIEF | COLUMN_INFINITE), .name = "object_distance", .symbol = "s",
     .label = "object distance", .repeats = "object",
     .help = "the object in front of the lens or mirror; negative behind it, virtual"},
    {MM(image, COLUMN_BRIEF | COLUMN_INFINITE), .name = "image_distance", .symbol = "s'",
     .label = "image distance", .repeats = "image",
     .help = "the image behind the lens, or in front of the mirror; negative on the other side, "
             "virtual"},
    {PLAIN(object_kind, 0), .name = "object_kind", .label = "object is",
     .help = "real, virtual or at infinity"},
    {PLAIN(image_kind, COLUMN_BRIEF), .name = "image_kind", .label = "image is",
     .help = "real, virtual or at infinity"},
    {PLAIN(orientation, COLUMN_BRIEF), .name = "orientation", .help = "upright or inverted"},
    {PLAIN(all.magnification, COLUMN_BRIEF | COLUMN_INFINITE), .name = "magnification",
     .symbol = "m", .repeats = "magnification",
     .help = "image over object height, negative upside down"},
    OBJECT_HEIGHT_COLUMN,
    IMAGE_HEIGHT_COLUMN,
    {PLAIN(magnifier, COLUMN_SPARSE), .name = "magnifying_power", .symbol = "M",
     .label = "magnifying power", .when = "of one lens whose image is virtual or at infinity",
     .help = "how much larger it looks through the lens before the eye than from the near point"},
    {PLAIN(all.longitudinal, COLUMN_INFINITE | COLUMN_HIDDEN), .name = "longitudinal_magnification",
     .label = "longitudinal magnification", .help = "dz'/dz of small depths"},
    {MM(all.total, COLUMN_INFINITE), .name = "total", .symbol = "T",
     .label = "total, object to image", .help = "from the object to the image, + to the right"},
    {MM(all.object_focal, COLUMN_INFINITE | COLUMN_HIDDEN), .name = "object_focal", .symbol = "x",
     .label = "object from F", .help = "to the left of the focal point F"},
    {MM(all.image_focal, COLUMN_INFINITE | COLUMN_HIDDEN), .name = "image_focal", .symbol = "x'",
     .label = "image from F'", .help = "beyond the focal point F'"},
    {PLAIN(from, COLUMN_EXTRA | COLUMN_ASSUMED), .name = "distance_from", .depends = "from",
     .label = "distances from", .help = "where the distances are measured from"},
    {PLAIN(signs, COLUMN_EXTRA | COLUMN_ASSUMED), .name = "signs",
     .help = "the sign convention: distances of real objects and images are positive"},
    {MM(near_point, COLUMN_EXTRA | COLUMN_ASSUMED), .name = "near_point", .depends = "near-point",
     .symbol = "near point", .label = "near point",
     .help = "of the naked eye, for the magnifying power"},
    LENS_TITLE_COLUMN(ROW, lens),
};

const struct sheet conjugate_ideal_sheet = SHEET(ideal_columns, ROW);

/* Textbooks measure images where the light goes: those of a mirror in front of it. */
static double conjugate_turned(double image)
{
    return isinf(image) ? image : -image; /* at infinity it is on no side */
}

/* What is said of thin lenses and mirrors alone. */
void conjugate_fill_ideal(const struct conjugate_input *input, const struct lens *lens,
                          const char *step, struct conjugate_row *row)
{
    const struct ideal_question *ideal = &input->ideal;
    const bool is_one = lens->surface_count == 1, is_mirror = ideal->mirror != MIRROR_NONE;
    row->wavelength = NAN;
    row->signs = "real is positive";
    row->mirror = is_mirror ? ideal_mirrors[ideal->mirror].word : NULL;
    row->power = 1 / row->efl;
    row->focal = is_one ? row->efl : lens->surfaces[0].focal.value.hi;
    row->radius = is_mirror ? 2 * fabs(row->efl) : NAN;
    row->efl = is_one ? NAN : row->efl;
    if (input->from == FROM_LENS || input->from == CONJUGATE_FROM_SENSOR) {
        /* the total stands in a column of its own */
        row->from = is_one ? "the lens" : "the first lens, the last lens";
        row->object = row->all.object;
        row->image = row->all.image;
    }
    row->step = step != NULL ? step : "all";
    if (is_mirror) {
        row->image = conjugate_turned(row->image);
        row->all.image_focal = conjugate_turned(row->all.image_focal);
        row->from = "the mirror";
    }
    const double s = row->all.object;
    row->magnifier = is_one && !is_mirror && s > 0 && row->focal > 0 &&
                             (row->all.image_is_virtual || isinf(row->all.image))
                         ? thin_lens_magnifier(s, input->near_point)
                         : NAN;
    row->near_point = isnan(row->magnifier) ? NAN : input->near_point;
}

/* What thin lenses and mirrors have not. */
static bool conjugate_check_ideal(const struct conjugate_input *input, struct error *error)
{
    const struct lens_question *question = &input->question;
    const char *other = SAID_FIRST(
        {question->position != NULL, "position"}, {!isnan(question->fnumber), "aperture"},
        {question->wavelength.wavelength != 0, "wavelength"},
        {question->section == SECTION_X, "section"}, {input->gap != NULL, "gap"},
        {input->focus_by != FOCUS_BY_NOTHING, "focus-by"});
    if (other != NULL) {
        fail(error, ERROR_USAGE, "{--%s} is for {--lens}: an ideal lens has no such thing", other);
        return input->gap != NULL &&
               error_hint(error, "the gap to a lens behind it: {--then} \"gap 14cm, f -9.5cm\"");
    }
    if (input->ideal.mirror == MIRROR_NONE) {
        return true;
    }
    const struct ideal_question *ideal = &input->ideal;
    const bool is_total = input->from == CONJUGATE_FROM_SENSOR && !isnan(input->object) &&
                          !isnan(input->magnification) && isnan(ideal->focal) &&
                          isnan(ideal->power) && isnan(ideal->radius);
    if (input->from != FROM_LENS && !is_total) {
        fail(error, ERROR_USAGE, "distances of a mirror are measured from it: no {--from} %s",
             conjugate_froms[input->from].word);
        return input->from == CONJUGATE_FROM_SENSOR &&
               error_hint(error, "from the object to a screen, {--object} needs {--magnification}, "
                                 "and no focal length or radius");
    }
    return (input->object_medium.record == NULL && input->image_medium.record == NULL) ||
           fail(error, ERROR_USAGE, "a mirror is the same in every medium: no {--%s}",
                input->object_medium.record != NULL ? "object-medium" : "image-medium");
}

/* Where two of the three are given beside no focal length, which then follows from them. */
bool conjugate_make_ideal(const struct conjugate_input *input, struct conjugate_input *asked,
                          struct arena *arena, struct error *error)
{
    const bool is_mirror = input->ideal.mirror != MIRROR_NONE;
    const bool is_total = input->from == CONJUGATE_FROM_SENSOR && !is_mirror;
    const bool is_reflected = input->from == CONJUGATE_FROM_SENSOR && is_mirror;
    const double object =
        is_reflected ? mirror_object(input->object, input->magnification) : input->object;
    const struct thin_lens_given given = {.object = is_total ? NAN : object,
                                          .image = input->image,
                                          .magnification = input->magnification,
                                          .total = is_total ? input->object : NAN};
    const struct ideal_question *ideal = &input->ideal;
    const bool finds = isnan(ideal->focal) && isnan(ideal->power) && isnan(ideal->radius) &&
                       ideal->mirror != MIRROR_PLANE;
    *asked = *input;
    if (!conjugate_check_ideal(input, error) ||
        !ideal_lens_make(ideal, &given, arena, &asked->question.lens.lens, error)) {
        return false;
    }
    if (!finds) {
        return true;
    }
    if (is_reflected) {
        asked->from = FROM_LENS;
    } else if (input->from != FROM_LENS && input->from != CONJUGATE_FROM_FRONT && !is_total) {
        return fail(error, ERROR_USAGE,
                    "the focal length follows from distances from the lens: no {--from} %s",
                    conjugate_froms[input->from].word);
    }
    /* one of them says where the object is, now that the lens is known */
    asked->object = object;
    if (is_total) {
        asked->object = NAN;
    } else if (!isnan(input->object)) {
        asked->image = asked->magnification = NAN;
    } else {
        asked->magnification = NAN;
    }
    return true;
}

bool conjugate_diagram(const struct conjugate_input *input, const struct paraxial_system *system,
                       double object, struct svg *svg, struct error *error)
{
    struct ray_diagram_element elements[RAY_DIAGRAM_MOST];
    double z = 0;
    for (size_t i = 0; i < system->count; i++) {
        elements[i] = (struct ray_diagram_element){z, system->surfaces[i].power.hi};
        z += system->surfaces[i].reduced.hi;
    }
    const bool is_mirror = input->ideal.mirror != MIRROR_NONE;
    const char *title = input->question.lens.lens->title;
    const struct ray_diagram diagram = {.title = title,
                                        .elements = elements,
                                        .count = system->count,
                                        .is_mirror = is_mirror,
                                        .object = object,
                                        .height = isnan(input->height) ? 1 : input->height,
                                        .has_height = !isnan(input->height)};
    return ray_diagram_draw(&diagram, svg, error);
}
