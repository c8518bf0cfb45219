/* commands/lens/cmd_conjugate.c - lenscalc conjugate: object and image of a lens, and focusing. */
/* SPDX-License-Identifier: MIT */
#include "commands/lens/conjugate_ideal.h"
#include "commands/lens/focus_gaps.h"
#include "commands/lens/lens_options.h"
#include "commands/tables.h"
#include "data/glass_catalog.h"
#include "file/lens_glass.h"
#include "optics/conjugates.h"
#include "optics/focusing.h"

static const struct word focusings[] = {
    [FOCUS_BY_NOTHING] = {"nothing", "the image falls where it falls"},
    [FOCUS_BY_LENS] = {"lens", "the whole lens moves relative to its image plane"},
    {NULL, NULL},
};

static const struct lens_policy policy = {
    .wavelengths = WAVELENGTHS_PRIMARY, .fields = FIELDS_LARGEST, .is_narrow = true};

#define INPUT struct conjugate_input

static const struct option options[] = {
    LENS_OPTION(INPUT, question),
    {MEASURE(object, length, "mm", "LENGTH"), .name = "object",
     .help = "distance of the object in front of the lens; negative: a virtual object behind it"},
    {MEASURE(image, length, "mm", "LENGTH"), .name = "image",
     .help = "distance of the image behind the lens; negative: a virtual image"},
    {MEASURE(magnification, ratio, NULL, "RATIO"), .name = "magnification", .letter = 'm',
     .help = "lateral magnification; negative: upside down, as a camera's"},
    {MEASURE(ideal.focal, length, "mm", "LENGTH"), .name = "focal-length", .letter = 'f',
     .column = "focal", .excludes = "lens",
     .help = "an ideal thin lens in place of a real one; below 0 diverging. Without it two of "
             "--object, --image and --magnification give it"},
    {MEASURE(ideal.power, vergence, "dpt", "DIOPTRES"), .name = "power", .excludes = "lens",
     .help = "its power 1/f in place of --focal-length"},
    {ASKED(ideal.then), .name = "then", .excludes = "lens", .accepts = ideal_lens_accepts,
     .value = "LENSES", .help = "thin lenses behind it: \"gap 14cm, f -9.5cm\""},
    {ASKED(ideal.lenses), .name = "lenses",
     .excludes = "lens focal-length power then mirror radius", .accepts = ideal_lenses_accept,
     .value = "LIST", .help = "thin lenses and the gaps between them in turn: 25cm,16.5cm,25cm"},
    {ASKED(ideal.mirror), .name = "mirror", .words = ideal_mirrors, .fallback = "no",
     .excludes = "lens then", .value = "KIND",
     .no_number = "of its radius: --mirror concave --radius 12cm; of its focal length: --mirror "
                  "concave -f 6cm; or convex",
     .help = "a mirror in place of a lens"},
    {MEASURE(ideal.radius, length, "mm", "LENGTH"), .name = "radius", .letter = 'R',
     .column = "radius", .wants = "mirror=concave|mirror=convex",
     .help = "radius of the mirror, without a sign: twice the focal length"},
    {MEASURE(height, length, "mm", "LENGTH"), .name = "height", .letter = 'y',
     .column = "object_height", .flags = OPTION_NO_INFINITY,
     .help = "height of the object: brings that of the image"},
    {MEASURE(image_height, length, "mm", "LENGTH"), .name = "image-height",
     .column = "image_height", ABOVE_0, .excludes = "height steps",
     .help = "size of the image, in place of --height: gives that of the object"},
    {MEASURE(near_point, length, "mm", "LENGTH"), .name = "near-point", .fallback = "250", ABOVE_0,
     .excludes = "lens then mirror",
     .help = "distance at which the naked eye looks, for the power of a magnifier"},
    {ASKED(steps), .name = "steps", .wants = "then|lenses",
     .help = "a row for each lens before that of all of them"},
    {ASKED(from), .name = "from", .quantity = "distance origin", .column = "distance_from",
     .words = conjugate_froms, .fallback = "lens", .value = "PLACE",
     .help = "where distances are measured from"},
    {ASKED(focus_by), .name = "focus-by", .column = "focus_by", .words = focusings,
     .fallback = "nothing", .value = "HOW", .help = "bring the image to the image plane"},
    {ASKED(gap), .name = "gap", .value = "GAPS",
     .help = "focus by these gaps: variables or surface numbers, each with a weight: d5,10:-1"},
    {ASKED(object_medium), .name = "object-medium", .value = "MEDIUM",
     .help = "medium in front of the lens: a glass, nd/Vd or an index"},
    {ASKED(image_medium), .name = "image-medium", .value = "MEDIUM",
     .help = "medium behind the lens"},
    LENS_WAVELENGTH_OPTION(INPUT, question, LENS_PRIMARY_WAVELENGTH),
    LENS_FNUMBER_OPTION(INPUT, question),
    LENS_POSITION_OPTION(INPUT, question),
    LENS_SECTION_OPTION(INPUT, question),
};

#define ROW struct conjugate_row

#define MM(member, more)    LENGTH(member, "mm"), .flags = (more)
#define PLAIN(member, more) SHOWN(member), .flags = (more)

static const struct column columns[] = {
    {COLUMN_OF_WAVELENGTH(ROW, wavelength), .flags = COLUMN_ECHO, .name = "wavelength",
     .with = "wavelength", .help = "wavelength"},
    LENS_POSITION_COLUMN(ROW, position, COLUMN_BRIEF),
    {MM(movement, COLUMN_BRIEF | COLUMN_SPARSE), .name = "movement",
     .when = "with --focus-by lens, or --gap",
     .help = "by how much the gaps grow, times their weights; the extension of the whole lens"},
    {PLAIN(gaps, COLUMN_BRIEF | COLUMN_SPARSE), .name = "gaps",
     .when = "with --focus-by lens, or --gap", .label = "gaps after it",
     .help = "the moved gaps in mm"},
    {MM(object, COLUMN_BRIEF | COLUMN_INFINITE), .name = "object_distance", .label = "object",
     .repeats = "object", .help = "the object, to the left of where --from says"},
    {MM(image, COLUMN_BRIEF | COLUMN_INFINITE), .name = "image_distance", .label = "image",
     .repeats = "image", .help = "the image, to the right of the point that belongs to --from"},
    {PLAIN(all.magnification, COLUMN_BRIEF | COLUMN_INFINITE), .name = "magnification",
     .symbol = "m", .help = "image over object height, n u/(n' u'); negative upside down"},
    OBJECT_HEIGHT_COLUMN,
    IMAGE_HEIGHT_COLUMN,
    {PLAIN(orientation, 0), .name = "orientation", .help = "upright or inverted"},
    {PLAIN(object_kind, 0), .name = "object_kind", .label = "object is",
     .help = "real, virtual or at infinity"},
    {PLAIN(image_kind, COLUMN_BRIEF), .name = "image_kind", .label = "image is",
     .help = "real, virtual or at infinity"},
    {PLAIN(all.angular, COLUMN_INFINITE), .name = "angular_magnification",
     .label = "angular magnification", .help = "u'/u of a ray through object and image point"},
    {PLAIN(all.longitudinal, COLUMN_INFINITE), .name = "longitudinal_magnification",
     .label = "longitudinal magnification", .help = "dz'/dz of small depths, (n'/n) m^2"},
    {PLAIN(working_fnumber, COLUMN_BRIEF | COLUMN_INFINITE), .name = "working_fnumber",
     .label = "working f-number",
     .help = "1/(2 n' |u'|) of the marginal ray, the stop as wide as the file or -N has it; absent "
             "without a stop"},
    {PLAIN(na_object, 0), .name = "na_object", .label = "aperture of the object",
     .help = "numerical aperture n sin u"},
    {PLAIN(na_image, 0), .name = "na_image", .label = "aperture of the image",
     .help = "numerical aperture n' sin u'"},
    {MM(efl, COLUMN_INFINITE), .name = "efl", .symbol = "f", .label = "focal length",
     .help = "effective focal length, after focusing"},
    {MM(all.object, COLUMN_INFINITE), .name = "object_front", .label = "object from vertex 1",
     .help = "the object, to the left of the first vertex"},
    {MM(all.object_principal, COLUMN_INFINITE), .name = "object_principal", .symbol = "s",
     .label = "object from H", .help = "to the left of the principal point H"},
    {MM(all.object_focal, COLUMN_INFINITE), .name = "object_focal", .symbol = "x",
     .label = "object from F", .help = "to the left of the focal point F"},
    {MM(all.object_pupil, COLUMN_INFINITE), .name = "object_pupil",
     .label = "object from entrance pupil", .help = "to the left of the entrance pupil"},
    {MM(all.image, COLUMN_INFINITE), .name = "image_rear", .label = "image from last vertex",
     .help = "the image, to the right of the last vertex"},
    {MM(all.image_principal, COLUMN_INFINITE), .name = "image_principal", .symbol = "s'",
     .label = "image from H'", .help = "to the right of the principal point H'"},
    {MM(all.image_focal, COLUMN_INFINITE), .name = "image_focal", .symbol = "x'",
     .label = "image from F'", .help = "to the right of the focal point F'"},
    {MM(all.image_pupil, COLUMN_INFINITE), .name = "image_pupil", .label = "image from exit pupil",
     .help = "to the right of the exit pupil"},
    {MM(all.total, COLUMN_INFINITE), .name = "total", .symbol = "T",
     .label = "total, object to image", .help = "from the object to the image"},
    {PLAIN(from, COLUMN_EXTRA | COLUMN_ASSUMED), .name = "distance_from", .depends = "from",
     .label = "distances from", .help = "where the first two distances are measured from"},
    {PLAIN(focus_by, COLUMN_EXTRA | COLUMN_ASSUMED), .name = "focus_by", .depends = "focus-by",
     .label = "focused by", .help = "what moves; absent where nothing does"},
    LENS_TITLE_COLUMN(ROW, lens),
    LENS_WARNING_COLUMN(ROW, warning),
};

static const struct sheet real_sheet = SHEET(columns, ROW);
static const struct sheet *const sheets[] = {&real_sheet, &conjugate_ideal_sheet, NULL};

static const struct sheet *conjugate_choose_sheet(const void *data,
                                                  const struct option_query *asking)
{
    (void)data;
    return asking_given(asking, "lens") ? &real_sheet : &conjugate_ideal_sheet;
}

/* What is asked of one lens, wavelength after wavelength. */
struct task {
    const struct conjugate_input *input;
    struct run *run;
    struct lens_value typed; /* the lens as the file has it, its media too */
    struct named_gap gaps[FOCUS_GAPS];
    size_t gap_count; /* 0: nothing moves */
    bool is_ideal;
    const char *step; /* which of several lenses it is; null: it is all of them */
    double height;    /* of the object, mm; NaN = not asked for */
};

static enum conjugate_from conjugate_from_of(const struct task *task)
{
    if (task->input->from == FROM_LENS) {
        return task->is_ideal ? CONJUGATE_FROM_FRONT : CONJUGATE_FROM_PRINCIPAL;
    }
    return (enum conjugate_from)task->input->from;
}

static struct conjugate_question conjugate_question_of(const struct task *task,
                                                       const struct lens *lens)
{
    const struct conjugate_input *input = task->input;
    const enum conjugate_from from = conjugate_from_of(task);
    if (!isnan(input->magnification)) {
        return (struct conjugate_question){CONJUGATE_MAGNIFICATION, from, 0, input->magnification};
    }
    if (!isnan(input->image)) {
        const bool turns = input->ideal.mirror != MIRROR_NONE;
        return (struct conjugate_question){CONJUGATE_IMAGE, from,
                                           turns ? -input->image : input->image, 0};
    }
    if (!isnan(input->object)) {
        return (struct conjugate_question){CONJUGATE_OBJECT, from, input->object, 0};
    }
    double own = lens->object_is_infinite ? INFINITY : lens->object.value.hi;
    return (struct conjugate_question){CONJUGATE_OBJECT, CONJUGATE_FROM_FRONT, own, 0};
}

static const char *conjugate_kind_of(double distance, bool is_virtual)
{
    if (isinf(distance)) {
        return "at infinity";
    }
    return is_virtual ? "virtual" : "real";
}

/* Far objects have the magnification 0, but their images still stand on their heads or not. */
static const char *orientation_of(const struct conjugate_points *all, double power)
{
    double sign = all->magnification != 0 ? all->magnification : -power;
    if (isinf(sign) || sign == 0) {
        return NULL;
    }
    return sign > 0 ? "upright" : "inverted";
}

/* The row of one object, which lies on `place` (mm to the left of the first vertex). */
static bool conjugate_emit_row(const struct lens_case *one, const struct task *task,
                               const struct lens *lens, const struct conjugate_ray *ray,
                               const char *gaps, double movement, struct error *error)
{
    struct run *run = task->run;
    struct paraxial_system system;
    struct paraxial_trace trace;
    struct conjugate_row row = {.wavelength = one->light.wavelength,
                                .position = one->setup->position,
                                .from = conjugate_froms[conjugate_from_of(task)].word,
                                .focus_by = task->input->gap,
                                .gaps = gaps,
                                .movement = movement,
                                .lens = one->setup->lens->title,
                                .warning = one->warning,
                                .object_height = task->height,
                                .focal = NAN,
                                .power = NAN,
                                .radius = NAN,
                                .magnifier = NAN,
                                .near_point = NAN};
    const enum conjugate_from from = conjugate_from_of(task);
    if (task->input->gap == NULL && task->input->focus_by != 0) {
        row.focus_by = "the whole lens";
    }
    if (!paraxial_compile(lens, one->light.wavelength, one->setup->section, run->arena, &system,
                          error)) {
        return false;
    }
    paraxial_trace(&system, &trace);
    bool far = ray->v.hi == 0;
    /* the same place, whatever the index there is at this wavelength */
    const struct conjugate_object object = {
        .is_infinite = far, .distance = far ? pair_of(0) : pair_divide(ray->y, ray->v)};
    const struct conjugate_ray here = {
        far ? pair_of(1) : pair_divide(object.distance, system.index[0]), pair_of(far ? 0 : 1)};
    conjugate_compute(&system, &trace, &here, &row.all);
    /* The first of the two distances, as --from has them. */
    const double pairs[CONJUGATE_FROMS][2] = {
        [CONJUGATE_FROM_PRINCIPAL] = {row.all.object_principal, row.all.image_principal},
        [CONJUGATE_FROM_FRONT] = {row.all.object, row.all.image},
        [CONJUGATE_FROM_FOCAL] = {row.all.object_focal, row.all.image_focal},
        [CONJUGATE_FROM_ENTRANCE] = {row.all.object_pupil, row.all.image_pupil},
        [CONJUGATE_FROM_SENSOR] = {row.all.total, row.all.image},
    };
    row.object = pairs[from][0];
    row.image = pairs[from][1];
    if (!isnan(task->input->image_height)) { /* a size, the orientation says the rest */
        row.object_height = task->input->image_height / fabs(row.all.magnification);
    }
    row.image_height = row.object_height * row.all.magnification;
    /* Brightness with the stop as wide as it is, for the object of the row. */
    struct first_order first;
    first_order_compute(&system, &trace, &object, &first);
    first_order_use_stop(&first, &object, one->light.first.stop_radius, FIELD_NONE, NAN);
    row.efl = first.efl;
    row.working_fnumber = first.working_fnumber;
    row.na_image = first.na_image;
    double slope = first.marginal_v / first.index_object;
    row.na_object = first.index_object * fabs(slope) / sqrt(1 + slope * slope);
    if (isinf(row.all.image) && !isnan(first.working_fnumber)) {
        row.working_fnumber = INFINITY;
        row.na_image = 0;
    }
    row.object_kind = conjugate_kind_of(row.all.object, row.all.object_is_virtual);
    row.image_kind = conjugate_kind_of(row.all.image, row.all.image_is_virtual);
    row.orientation = orientation_of(&row.all, trace.whole.c.hi == 0 ? 0 : -trace.whole.c.hi);
    if (task->is_ideal) {
        conjugate_fill_ideal(task->input, lens, task->step, &row);
    }
    run_emit(run, &row);
    return true;
}

/* y and v = n u become y and u: the ray is that of a place, not of a reduced distance. */
static struct conjugate_ray conjugate_place_of(const struct conjugate_ray *ray, struct pair index)
{
    return (struct conjugate_ray){pair_multiply(ray->y, index), ray->v};
}

/* Lens after lens: what one makes of the ray is the object of the next. */
static bool emit_steps(const struct lens_case *one, const struct task *task,
                       struct conjugate_ray ray, struct error *error)
{
    const struct lens *lens = one->setup->lens;
    const struct paraxial_system *system = &one->light.system;
    struct arena *arena = task->run->arena;
    struct task step = *task;
    for (size_t i = 0; i < system->count; i++) {
        const struct conjugate_ray place = conjugate_place_of(&ray, system->index[i]);
        const struct pair before = ray.v;
        step.step = arena_printf(arena, "lens %zu", i + 1);
        if (!conjugate_emit_row(one, &step, ideal_lens_alone(lens, i, arena), &place, NULL, NAN,
                                error)) {
            return false;
        }
        ray.v = pair_subtract(ray.v, pair_multiply(ray.y, system->surfaces[i].power));
        ray.y = pair_add(ray.y, pair_multiply(ray.v, system->surfaces[i].reduced));
        step.height *= before.hi / ray.v.hi;
    }
    return true;
}

static bool emit_unmoved(const struct lens_case *one, const struct task *task, struct error *error)
{
    const struct conjugate_question question = conjugate_question_of(task, one->setup->lens);
    struct conjugate_ray rays[2];
    struct paraxial_trace trace;
    paraxial_trace(&one->light.system, &trace);
    size_t count = conjugate_find(&one->light.system, &trace, &question, rays, error);
    for (size_t i = 0; i < count; i++) {
        const struct conjugate_ray place = conjugate_place_of(&rays[i], one->light.system.index[0]);
        if ((task->input->steps && !emit_steps(one, task, rays[i], error)) ||
            !conjugate_emit_row(one, task, one->setup->lens, &place, NULL, NAN, error)) {
            return false;
        }
    }
    return count > 0;
}

/* Focused at the primary wavelength; at the others the same lens looks at the same object. */
static bool emit_focused(const struct lens_case *one, const struct task *task, struct error *error)
{
    struct arena *arena = task->run->arena;
    const struct conjugate_question question = conjugate_question_of(task, one->setup->lens);
    struct focused *solutions = ARENA_ARRAY(arena, FOCUS_SOLUTIONS, struct focused);
    struct focus_gap gaps[FOCUS_GAPS];
    for (size_t i = 0; i < task->gap_count; i++) {
        gaps[i] = task->gaps[i].gap;
    }
    struct focus_mechanism focusing = {.lens = one->setup->lens,
                                       .wavelength = lens_primary_wavelength(one->setup->lens),
                                       .section = one->setup->section,
                                       .gaps = gaps,
                                       .gap_count = task->gap_count};
    /* Where the file has its image plane, in its own media, at the wavelength it is focused at. */
    const struct lens *typed = task->typed.lens;
    size_t position = 0;
    while (position + 1 < typed->position_count &&
           typed->positions[position] != one->setup->position) {
        position++;
    }
    const struct lens *placed = lens_at_position(typed, position, task->run->arena);
    struct first_order first;
    if (!first_order_of_lens(placed, lens_primary_wavelength(placed), one->setup->section,
                             task->run->arena, &first, error)) {
        return false;
    }
    focusing.image_plane = setup_paraxial_image(placed, &first);
    size_t count = focus_solve(&focusing, &question, arena, solutions, error);
    for (size_t i = 0; i < count; i++) {
        struct paraxial_system system;
        struct paraxial_trace trace;
        struct conjugate_ray ray;
        if (!paraxial_compile(solutions[i].lens, focusing.wavelength, one->setup->section, arena,
                              &system, error)) {
            return false;
        }
        paraxial_trace(&system, &trace);
        if (!focus_object(&solutions[i], &system, &trace, &question, &ray, error)) {
            return false;
        }
        const struct conjugate_ray place = conjugate_place_of(&ray, system.index[0]);
        const char *moved = NULL;
        for (size_t k = 0; k < task->gap_count; k++) {
            const struct named_gap *named = &task->gaps[k];
            double t = solutions[i].lens->surfaces[named->gap.surface].thickness.value.hi;
            const char *text =
                arena_printf(arena, "%.*s %.6g", (int)named->name.length, named->name.start, t);
            moved = moved == NULL ? text : arena_printf(arena, "%s, %s", moved, text);
        }
        if (!conjugate_emit_row(one, task, solutions[i].lens, &place, moved,
                                solutions[i].movement.hi, error)) {
            return false;
        }
    }
    return count > 0;
}

/* The lens with other media around it. */
static bool put_into_media(const struct conjugate_input *input, struct lens_value *value,
                           struct arena *arena, struct error *error)
{
    const struct glass_record *before = input->object_medium.record;
    const struct glass_record *behind = input->image_medium.record;
    if (before == NULL && behind == NULL) {
        return true;
    }
    const struct lens *lens = value->lens;
    struct lens *copy = lens_copy(lens, arena);
    struct surface *last = &copy->surfaces[lens->surface_count - 1];
    if (behind != NULL && surface_reflects(last)) {
        return fail(error, ERROR_USAGE,
                    "{--image-medium}: the last surface is a mirror, which leaves the medium as it "
                    "is");
    }
    if (before != NULL) {
        copy->object_medium = lens_glass_medium(&before->glass);
    }
    for (size_t i = 0; i < STATED_COUNT; i++) {
        copy->stated[i] = NULL; /* the source states it for other media */
    }
    if (behind != NULL) {
        last->medium = lens_glass_medium(&behind->glass);
    }
    value->lens = copy;
    return true;
}

static bool conjugate_check_given(const struct conjugate_input *input, struct error *error)
{
    int given = !isnan(input->object) + !isnan(input->image) + !isnan(input->magnification);
    if (given > 1) {
        return fail(error, ERROR_USAGE,
                    "{--object}, {--image} and {--magnification} exclude each other beside a lens "
                    "or its focal length");
    }
    if (input->from == CONJUGATE_FROM_SENSOR && !isnan(input->image)) {
        return fail(error, ERROR_USAGE,
                    "{--from} sensor measures the object from the image: give {--object}");
    }
    return input->gap == NULL || input->focus_by == FOCUS_BY_NOTHING ||
           fail(error, ERROR_USAGE,
                "{--gap} and {--focus-by} exclude each other: the gap of the whole lens is 'last'");
}

static bool conjugate_run(const void *data, struct run *run, struct error *error)
{
    struct conjugate_input asked = *(const struct conjugate_input *)data;
    const bool is_ideal = asked.question.lens.lens == NULL;
    if (is_ideal && !conjugate_make_ideal(data, &asked, run->arena, error)) {
        return false;
    }
    struct lens_question question = asked.question;
    struct task task = {.input = &asked,
                        .run = run,
                        .typed = asked.question.lens,
                        .is_ideal = is_ideal,
                        .height = asked.height};
    const char *gap = asked.focus_by == FOCUS_BY_LENS ? "last" : asked.gap;
    question.field = question.field_x = NAN;
    if (!conjugate_check_given(&asked, error) ||
        (gap != NULL &&
         !focus_gaps_read(text_of(gap), question.lens.lens, task.gaps, &task.gap_count, error)) ||
        !put_into_media(&asked, &question.lens, run->arena, error)) {
        return false;
    }
    struct lens_cursor at = lens_begin(&question, &policy, run->arena);
    while (lens_next(&at, error)) {
        if (!(task.gap_count > 0 ? emit_focused(&at.one, &task, error)
                                 : emit_unmoved(&at.one, &task, error))) {
            return false;
        }
    }
    return error->code == ERROR_NONE;
}

static bool diagram_check(const struct artifact_job *job, struct error *error)
{
    const struct conjugate_input *input = job->inputs[0];
    if (input->question.lens.lens != NULL) {
        return fail(error, ERROR_USAGE,
                    "{--diagram} draws thin lenses and mirrors; of other lenses "
                    "lenscalc draw --construction does");
    }
    return (input->object_medium.record == NULL && input->image_medium.record == NULL) ||
           fail(error, ERROR_USAGE, "{--diagram} draws lenses in air");
}

/* The construction of the image; of two solutions the first. */
static bool diagram_make(const struct artifact_job *job, struct output *sink, struct error *error)
{
    struct arena *arena = job->run->arena;
    struct conjugate_input asked;
    struct paraxial_system system;
    struct paraxial_trace trace;
    struct conjugate_ray rays[2];
    struct svg svg = {.arena = arena};
    if (!conjugate_make_ideal(job->inputs[0], &asked, arena, error)) {
        return false;
    }
    const struct lens *lens = asked.question.lens.lens;
    const struct task task = {.input = &asked, .run = job->run, .is_ideal = true};
    const struct conjugate_question question = conjugate_question_of(&task, lens);
    if (!paraxial_compile(lens, lens_primary_wavelength(lens), SECTION_Y, arena, &system, error)) {
        return false;
    }
    paraxial_trace(&system, &trace);
    if (conjugate_find(&system, &trace, &question, rays, error) == 0) {
        return false;
    }
    const double object = rays[0].v.hi == 0 ? INFINITY : pair_divide(rays[0].y, rays[0].v).hi;
    return conjugate_diagram(&asked, &system, object, &svg, error) &&
           drawing_write(job, &svg, sink, error);
}

static const struct artifact artifacts[] = {
    {ARTIFACT_OPTION("diagram", drawing_types,
                     "draw the construction of the image by thin lenses or a mirror"),
     .scope = ARTIFACT_OF_ANSWER, .check = diagram_check, .make = diagram_make},
};

static bool conjugate_makes_many(const void *data)
{
    const struct conjugate_input *input = data;
    return lens_makes_many(&input->question, &policy) || input->gap != NULL ||
           input->focus_by != FOCUS_BY_NOTHING || input->steps ||
           (input->from == CONJUGATE_FROM_SENSOR && !isnan(input->object));
}

/* Those of one lens or mirror by its numbers, by its title; in which chapter. */
#define IDEAL_EXPLANATIONS(title, chapter)                                                         \
    {"image_distance lens=" title, "{s'} = 1/(1/{f} - 1/{s})", "[OpenStax16] ch. " chapter,        \
     "paraxial; distances of real objects and images are positive"},                               \
    {                                                                                              \
        "magnification lens=" title, "m = -{s'}/{s}", "[OpenStax16] ch. " chapter, NULL            \
    }

static const struct explanation explanations[] = {
    IDEAL_EXPLANATIONS("ideal thin lens", "2.4"),
    IDEAL_EXPLANATIONS("concave mirror", "2.2"),
    IDEAL_EXPLANATIONS("convex mirror", "2.2"),
    {"efl signs", "f = -1/c of the product of all matrices", "[Smith05]",
     "the image of each lens is the object of the next: --steps shows them"},
    {"magnifying_power", "M = {near point}/{s}", "[OpenStax16] ch. 2.7",
     "the eye at the lens; near point/f for an image at infinity, 1 more for one at the near "
     "point"},
    {"magnification !signs", "m = -n {f}/{x}", "[Smith05] Newton's form",
     "paraxial; n, n' are the indices in front of and behind the lens, 1 in air"},
    {"image_focal", "x' = n n' {f}^2/{x}", "[Smith05] Newton's form", NULL},
    {"total !signs", "T = {s} + {s'} + HH'", "[Smith05]; HH' from H to H'", NULL},
    {"movement", "e where the ray from the axial object point has the height 0 at the image plane",
     "y and v are linear in every surface and gap", "every root that leaves no gap negative"},
    {NULL, NULL, NULL, NULL},
};

static const struct example examples[] = {
    {"conjugate -f -15cm --object 10cm --height 3cm", "a diverging thin lens"},
    {"conjugate --object 5cm --image 12cm", "the focal length that makes this image"},
    {"conjugate -f 8cm --then \"gap 14cm, f -9.5cm\" --object 12cm --steps", "two thin lenses"},
    {"conjugate --mirror concave -R 30cm --object 20cm", "a mirror"},
    {"conjugate -f 10cm --image -25cm", "a magnifier"},
    {"conjugate -f 10cm --object 15cm --diagram rays.svg", "the construction as a drawing"},
    {"conjugate double-gauss --object 1m", "where the image is, and how large"},
    {"conjugate double-gauss --object 0.5m,1m,2m,inf --from front", "for several distances"},
    {"conjugate double-gauss -m -0.5 -N 4", "half life size, upside down as in a camera"},
    {"conjugate double-gauss --object 1m --from sensor --focus-by lens",
     "both positions of the lens between a subject and a sensor"},
    {"conjugate us8427765-35 --object 1m --from sensor --gap last", "the extension of a lens"},
    {"conjugate double-gauss --object 2m --object-medium water", "a subject in water"},
    {NULL, NULL},
};

const struct command command_conjugate = {
    .name = "conjugate",
    .stop_size_wants = "",
    COMMAND_OF(
        "a lens",
        "object and image anywhere, in any medium; focusing by moving the lens or changing gaps"),
    .run = conjugate_run,
    .makes_many = conjugate_makes_many,
    COMMAND_MAKES(artifacts),
    .choose_sheet = conjugate_choose_sheet,
    .sheets = sheets,
    .plot = "magnification|image_principal_mm",
    .plot_titles = "Magnification|Image distance",
    .cell = "magnification",
};
