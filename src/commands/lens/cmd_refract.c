/* commands/lens/cmd_refract.c - lenscalc refract: one surface, exactly and paraxially. */
/* SPDX-License-Identifier: MIT */
#include "cli/question/command.h"
#include "commands/tables.h"
#include "optics/refract.h"

#include "base/constants.h"

#include <math.h>

struct refract_input {
    double n, n_after, radius, object, image;
    bool mirror;
    struct refract_aim aim;
    double refracted;
    int height_at;
};

/* Indexed by the member `height_at`. */
static const struct word planes[] = {
    {"surface", "where the ray meets the surface"},
    {"vertex", "where it crosses the plane through the vertex"},
    {NULL, NULL},
};

#define INDEX(member_name) MEASURE(member_name, number, NULL, "INDEX"), OPTION_POSITIVE
#define PLACE(member_name) MEASURE(member_name, length, "mm", "LENGTH")

#define INPUT struct refract_input

static const struct option options[] = {
    {INDEX(n), .name = "before", .column = "index_before",
     .flags = OPTION_ABOVE_LOWEST | OPTION_NO_INFINITY | OPTION_SETTING, .no_number = INDEX_WORDS,
     .help = "index n before the surface; 1 unless solved for"},
    {INDEX(n_after), .name = "after", .column = "index_after",
     .flags = OPTION_ABOVE_LOWEST | OPTION_NO_INFINITY | OPTION_SETTING, .no_number = INDEX_WORDS,
     .help = "index n' after the surface"},
    {PLACE(radius), .name = "radius", .letter = 'R', .column = "radius", .flags = OPTION_SETTING,
     .help = "radius, + with the centre to the right; without it a plane, or solved for"},
    {PLACE(object), .name = "object", .letter = 'z', .column = "object", .flags = OPTION_SETTING,
     .help = "object point on the axis from the vertex, + to the right: -200mm is in front of it; "
             "default inf. Without --radius its sign says nothing: it is in front"},
    {PLACE(image), .name = "image", .column = "image", .flags = OPTION_GOAL,
     .help = "wanted Gaussian image, + to the right: solves for what is not given"},
    {PLACE(aim.height), .name = "height", .letter = 'y', .column = "height",
     .flags = OPTION_NO_INFINITY, .help = "height of the ray: adds the exact results"},
    {MEASURE(aim.angle, angle, "deg", "ANGLE"), .name = "angle", .letter = 'u', .lowest = -PI / 2,
     .highest = PI / 2,
     .help = "slope angle U of the ray, + rising to the right; instead of --height or --object. "
             "Alone it is the angle of incidence on a plane"},
    {MEASURE(refracted, angle, "deg", "ANGLE"), .name = "refracted", .lowest = -PI / 2,
     .highest = PI / 2, .wants = "angle", .excludes = "after height object image radius mirror",
     .help = "angle of refraction: gives the index after the surface"},
    {ASKED(height_at), .name = "height-at", .words = planes, .fallback = "surface",
     .value = "PLACE", .help = "where --height is measured"},
    {ASKED(mirror), .name = "mirror", .help = "a mirror: n' = -n"},
};

struct refract_row {
    struct refract_surface surface;
    struct refract_ray ray;
    double index_after; /* -n of a mirror */
    double power, object_vergence, image_vergence, magnification;
    double condition;
    double critical, brewster, deviation;
    const char *object_kind, *image_kind;
};

#define ROW struct refract_row

#define MM(member)            LENGTH(member, "mm")
#define RAY_ANGLE(member)     ANGLE(ray.member)
#define VERGENCE(member_name) MEASURED(member_name, vergence, "diopter")

/* Of the exact ray. */
#define WITH_RAY .when = "with --height or --angle"

static const struct column columns[] = {
    {SHOWN(surface.n), .name = "index_before", .flags = COLUMN_ECHO, .with = "before",
     .symbol = "n", .label = "index before", .help = "index before the surface"},
    {SHOWN(index_after), .name = "index_after", .flags = COLUMN_ECHO, .with = "after",
     .symbol = "n'", .label = "index after", .help = "index after the surface; -n of a mirror"},
    {MM(surface.R), .name = "radius", .flags = COLUMN_ECHO | COLUMN_INFINITE, .with = "radius",
     .symbol = "R", .help = "radius, + with the centre to the right"},
    {MM(surface.z), .name = "object",
     .flags = COLUMN_ECHO | COLUMN_INFINITE | COLUMN_BRIEF | COLUMN_SPARSE, .with = "object",
     .symbol = "z", .help = "object point from the vertex, + to the right"},
    {MM(surface.z_image), .name = "image", .flags = COLUMN_INFINITE | COLUMN_BRIEF | COLUMN_SPARSE,
     .symbol = "z'", .label = "image, paraxial",
     .condition = offsetof(struct refract_row, condition),
     .help = "Gaussian image from the vertex, + to the right"},
    {SHOWN(object_kind), .name = "object_kind", .label = "object is",
     .help = "real before the surface, virtual behind it"},
    {SHOWN(image_kind), .name = "image_kind", .label = "image is",
     .help = "real where the light goes, else virtual"},
    {VERGENCE(power), .name = "power", .symbol = "P", .label = "power of the surface",
     .help = "(n' - n)/R"},
    {VERGENCE(object_vergence), .name = "object_vergence", .symbol = "V",
     .label = "vergence before", .help = "n/z, of the light that arrives"},
    {VERGENCE(image_vergence), .name = "image_vergence", .symbol = "V'", .label = "vergence after",
     .help = "n'/z', of the light that leaves"},
    {SHOWN(magnification), .name = "magnification", .flags = COLUMN_INFINITE, .symbol = "m",
     .help = "n z'/(n' z); negative is upside down"},
    {MM(ray.height), .name = "height", .flags = COLUMN_ECHO, .with = "height", .symbol = "h",
     .help = "of the point where the ray meets the surface"},
    {MM(ray.sag), .name = "sag", WITH_RAY, .symbol = "x",
     .help = "that point from the plane through the vertex"},
    {RAY_ANGLE(slope), .name = "slope", WITH_RAY, .symbol = "U", .label = "slope before, U",
     .help = "angle of the ray with the axis, + rising"},
    {RAY_ANGLE(normal), .name = "normal", WITH_RAY, .symbol = "phi", .label = "normal, phi",
     .help = "angle of the surface's radius with the axis"},
    {RAY_ANGLE(incidence), .name = "incidence", WITH_RAY, .flags = COLUMN_BRIEF, .symbol = "I",
     .label = "incidence, I", .help = "angle of incidence, U + phi"},
    {RAY_ANGLE(refraction), .name = "refraction", WITH_RAY, .flags = COLUMN_BRIEF, .symbol = "I'",
     .label = "refraction, I'", .help = "angle of refraction (of reflection: -I)"},
    {ANGLE(critical), .name = "critical_angle", .flags = COLUMN_SPARSE, .symbol = "Ic",
     .label = "critical angle", .when = "where the index falls",
     .help = "incidence from which on all light is reflected"},
    {ANGLE(brewster), .name = "brewster_angle", WITH_RAY, .flags = COLUMN_SPARSE, .symbol = "IB",
     .label = "Brewster's angle", .help = "incidence at which reflected light is polarised"},
    {ANGLE(deviation), .name = "deviation", WITH_RAY, .flags = COLUMN_SPARSE, .symbol = "D",
     .help = "by how much refraction turns the ray, U - U'"},
    {RAY_ANGLE(slope_after), .name = "slope_after", WITH_RAY, .symbol = "U'",
     .label = "slope after, U'", .help = "angle of the refracted ray with the axis"},
    {MM(ray.crossing), .name = "crossing", WITH_RAY,
     .flags = COLUMN_INFINITE | COLUMN_BRIEF | COLUMN_SPARSE, .symbol = "z'(h)",
     .label = "crosses the axis at",
     .help = "where the exact ray crosses the axis, from the vertex"},
    {MM(ray.difference), .name = "difference", WITH_RAY, .flags = COLUMN_BRIEF | COLUMN_SPARSE,
     .symbol = "dz'", .label = "difference, exact - paraxial",
     .help = "longitudinal aberration: crossing - image"},
    {MM(ray.transverse), .name = "transverse", WITH_RAY, .symbol = "dy'",
     .label = "transverse aberration",
     .help = "transverse aberration: height of the exact ray in the Gaussian image plane"},
    {RAY_ANGLE(paraxial_slope), .name = "paraxial_slope", WITH_RAY, .symbol = "u",
     .label = "u, paraxial", .help = "-h/z"},
    {RAY_ANGLE(paraxial_incidence), .name = "paraxial_incidence", WITH_RAY, .symbol = "i",
     .label = "i, paraxial", .help = "u + h/R"},
    {RAY_ANGLE(paraxial_refraction), .name = "paraxial_refraction", WITH_RAY, .symbol = "i'",
     .label = "i', paraxial", .help = "n i/n'"},
    {RAY_ANGLE(paraxial_slope_after), .name = "paraxial_slope_after", WITH_RAY, .symbol = "u'",
     .label = "u', paraxial", .help = "(n u - h P)/n'"},
};

/* Four of five, named as they are typed. */
static bool refract_check_count(const struct refract_surface *s, struct error *error)
{
    bool after = s->mirror || !isnan(s->n_after);
    int unknown = isnan(s->n) + !after + isnan(s->R) + isnan(s->z) + isnan(s->z_image);
    if (unknown == 0) {
        return fail(error, ERROR_USAGE,
                    "{--before}, {--after}, {--radius}, {--object} and {--image} are all given: "
                    "leave one out and it is found");
    }
    return unknown == 1 ||
           fail(error, ERROR_USAGE, "too little is given:%s%s%s wanted, or {--image}%s",
                after ? "" : " --after", !after && isnan(s->R) ? " and" : "",
                isnan(s->R) ? " --radius" : "",
                isnan(s->z_image) ? " in the place of one" : " and what is left of the rest");
}

static void refract_fill_row(struct refract_row *row)
{
    const struct refract_surface *s = &row->surface;
    row->index_after = s->mirror ? -s->n : s->n_after;
    row->power = refract_power(s);
    row->object_vergence = isinf(s->z) ? 0 : s->n / s->z;
    row->image_vergence = row->object_vergence + row->power;
    row->condition = refract_condition(s);
    if (s->z == 0) {
        row->image_vergence = row->object_vergence = NAN;
        row->magnification = 1;
    } else {
        row->magnification = isinf(s->z) ? 0 : row->object_vergence / row->image_vergence;
    }
    if (isinf(s->z)) {
        row->object_kind = "at infinity";
    } else if (s->z > 0) {
        row->object_kind = "virtual";
    } else {
        row->object_kind = "real";
    }
    bool right = s->z_image > 0;
    if (isinf(s->z_image)) {
        row->image_kind = "at infinity";
    } else if (right != s->mirror) {
        row->image_kind = "real";
    } else {
        row->image_kind = "virtual";
    }
    if (s->z == 0) {
        row->object_kind = row->image_kind = "in the vertex";
    }
    row->critical = s->mirror ? NAN : refract_critical_angle(s->n, s->n_after);
    row->brewster =
        s->mirror || isnan(row->ray.slope) ? NAN : refract_brewster_angle(s->n, s->n_after);
    row->deviation = s->mirror ? NAN : row->ray.slope - row->ray.slope_after;
}

/* Of a ray that meets a plane somewhere there is no object, and no point where it crosses. */
static void refract_forget_points(struct refract_row *row)
{
    row->surface.z = row->surface.z_image = NAN;
    row->object_vergence = row->image_vergence = row->magnification = NAN;
    row->object_kind = row->image_kind = NULL;
    row->ray.height = row->ray.sag = row->ray.crossing = NAN;
    row->ray.difference = row->ray.transverse = row->ray.paraxial_slope = NAN;
    row->ray.paraxial_incidence = row->ray.paraxial_refraction = NAN;
    row->ray.paraxial_slope_after = NAN;
}

static const struct refract_ray no_ray = {NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN,
                                          NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN};

/* The surface and the ray that meets it: height and angle together say where the object is. */
static bool refract_row_solve(const struct refract_aim *aim, struct refract_row *row,
                              struct error *error)
{
    struct refract_surface *s = &row->surface;
    bool line = !isnan(aim->height) && !isnan(aim->angle);
    if (line && (!isnan(s->z) || isnan(s->R))) {
        return fail(
            error, ERROR_USAGE,
            "{--height} and {--angle} make the ray and its object: they want {--radius} and no "
            "{--object}");
    }
    if (line && !refract_place(s, aim, &row->ray, error)) {
        return false;
    }
    s->z = line ? row->ray.z : s->z;
    if (!refract_check_count(s, error) || !refract_solve(s, error)) {
        return false;
    }
    if (isnan(aim->height) && isnan(aim->angle)) {
        row->ray = no_ray;
        return true;
    }
    return (line || refract_place(s, aim, &row->ray, error)) &&
           refract_through(s, &row->ray, error);
}

/*
 * What is not said: air before, a plane, an object at infinity; never what is asked for. Who names
 * no radius has a plane, and an object in front of it by its bare distance.
 */
static void refract_assume(struct refract_surface *s, bool has_angle, struct warnings *doubts)
{
    if (isnan(s->R) && isnan(s->z_image)) {
        s->R = INFINITY;
        if (s->z > 0 && isfinite(s->z)) {
            s->z = -s->z;
            warnings_add(doubts,
                         "without --radius the object is taken %.6g mm in front of the plane, as "
                         "--object -%.6gmm says; with --radius inf signs count as they are typed",
                         -s->z, -s->z);
        }
    }
    const bool after = s->mirror || !isnan(s->n_after);
    const int unknown = !after + isnan(s->R) + isnan(s->z) + isnan(s->z_image);
    if (isnan(s->n) && (unknown > 0 || s->mirror)) {
        s->n = 1;
    }
    if (isnan(s->z) && unknown > 1 && !has_angle) {
        s->z = -INFINITY;
    }
}

static bool refract_run(const void *data, struct run *run, struct error *error)
{
    const struct refract_input *input = data;
    struct refract_row row = {.surface = {input->n, input->n_after, input->radius, input->object,
                                          input->image, input->mirror}};
    struct refract_surface *s = &row.surface;
    struct refract_aim aim = input->aim;
    aim.at_vertex = input->height_at != 0;
    if (s->mirror && !isnan(s->n_after)) {
        return fail(error, ERROR_USAGE, "{--mirror} has no {--after}: the light stays before it");
    }
    const bool alone = isnan(aim.height) && !isnan(aim.angle) && isnan(s->z) && isnan(s->z_image);
    if (alone && isfinite(s->R)) {
        return fail(error, ERROR_USAGE,
                    "{--angle} needs {--height} or {--object} beside {--radius}");
    }
    if (alone) {
        aim.height = 0;
    }
    refract_assume(s, !isnan(aim.angle), run->doubts);
    if (!isnan(input->refracted) &&
        !refract_index_of(s->n, aim.angle, input->refracted, &s->n_after, error)) {
        return false;
    }
    if (!refract_row_solve(&aim, &row, error)) {
        return false;
    }
    refract_fill_row(&row);
    if (alone) {
        refract_forget_points(&row);
    }
    run_emit(run, &row);
    return true;
}

static const struct explanation explanations[] = {
    {"power", "P = ({n'} - {n})/{R}", "[Welford86] ch. 3; a mirror has n' = -n", NULL},
    {"image", "z' = {n'}/({n}/{z} + {P})",
     "Gauss' formula, [Hanrahan04], signed coordinates; the same as v' = v - y P",
     "paraxial: true as the ray's height goes to 0"},
    {"magnification", "m = {V}/{V'}", "[Welford86] ch. 3; V = n/z, V' = n'/z'", NULL},
    {"normal", "phi = asin({h}/{R})", "geometry of the sphere", NULL},
    {"incidence", "I = {U} + {phi}", "the radius is the normal", NULL},
    {"refraction", "I' = asin({n}/{n'} sin({I}))", "Snell's law",
     "total reflection where sin I' would be beyond 1"},
    {"critical_angle", "Ic = asin({n'}/{n})", "[OpenStax16] ch. 1.4", NULL},
    {"brewster_angle", "IB = atan({n'}/{n})", "[OpenStax16] ch. 1.7", NULL},
    {"slope_after", "U' = {I'} - {phi}", "the radius is the normal", NULL},
    {"crossing", "z'(h) = {x} - {h}/tan({U'})", "similar triangles",
     "computed as n'/s' = n/s + (n' cos I' - n cos I)/R, which subtracts no large numbers"},
    {"difference", "dz' = {z'(h)} - {z'}", "longitudinal spherical aberration of the ray",
     "computed from terms of the order h^2, so that it keeps its digits for small h"},
    {"paraxial_incidence", "i = {u} + {h}/{R}", "[Hanrahan04], sin replaced by the angle", NULL},
    {"paraxial_slope_after", "u' = ({n} {u} - {h} {P})/{n'}", "v' = v - y P with v = n u", NULL},
    {NULL, NULL, NULL, NULL},
};

static const struct example examples[] = {
    {"refract -u 30deg --after 1.5", "a ray into glass"},
    {"refract --before 1.33 --after 1 -z -2m", "how deep a coin under 2 m of water seems"},
    {"refract --after 1.5168 -R 50mm -z -200mm", "the image of a point through one surface"},
    {"refract --after 1.5168 -R 50mm -y 20mm", "a parallel ray, exact and paraxial"},
    {"refract --after 1.5 -R 50 -y 1..40 --plot aberration.svg", "spherical aberration by height"},
    {"refract --before 1.5 --after 1 -R inf -z -30 -u 10deg", "out of a block of glass"},
    {"refract --after 1.336 -z inf --image 24mm", "the radius of an eye of one surface"},
    {"refract --mirror -R -100mm -z -150mm -y 10mm", "a concave mirror"},
    {NULL, NULL},
};

const struct command command_refract = {
    .name = "refract",
    COMMAND_OF("one surface, one lens",
               "one surface or mirror: conjugate points, a ray traced exactly and paraxially"),
    .run = refract_run,
    .plot = "crossing_mm,image_mm",
    .plot_titles = "Spherical aberration of one surface",
    .cell = "image_mm",
};
