/* commands/lens/cmd_matrix.c - lenscalc matrix: refractions and transfers and their product. */
/* SPDX-License-Identifier: MIT */
#include "commands/lens/lens_options.h"
#include "commands/tables.h"

struct matrix_input {
    struct lens_question question;
    bool perspective;
};

static const struct lens_policy policy = {.wavelengths = WAVELENGTHS_ALL,
                                          .fields = FIELDS_LARGEST,
                                          .telecentric = true,
                                          .is_narrow = true};

#define INPUT struct matrix_input

static const struct option options[] = {
    LENS_OPTION(INPUT, question),
    LENS_WAVELENGTH_OPTION(INPUT, question, LENS_ALL_WAVELENGTHS),
    LENS_POSITION_OPTION(INPUT, question),
    LENS_SECTION_OPTION(INPUT, question),
    {ASKED(perspective), .name = "perspective",
     .help = "the 4x4 matrix of the equivalent thick lens instead"},
};

struct matrix_command_row {
    double wavelength; /* um */
    const char *position, *factor, *lens, *warning;
    double a, b, c, d, determinant;
};

#define ROW struct matrix_command_row

#define PLAIN(member_name) SHOWN(member_name), .flags = COLUMN_BRIEF

static const struct column columns[] = {
    LENS_WAVELENGTH_COLUMN(ROW, wavelength),
    LENS_POSITION_COLUMN(ROW, position, 0),
    {PLAIN(factor), .name = "factor",
     .help = "R1 refraction at surface 1, T1 transfer from it to the next; system, their product"},
    {PLAIN(a), .name = "a", .help = "[y'; v'] = [[a, b], [c, d]] [y; v], v = n u"},
    {LENGTH(b, "mm"), .name = "b", BRIEF, .help = "of a transfer t/n"},
    {MEASURED(c, vergence, "per_mm"), .name = "c", BRIEF,
     .help = "of a refraction -P; of the system -power"},
    {PLAIN(d), .name = "d", .help = "the fourth"},
    {PLAIN(determinant), .name = "determinant", .help = "a d - b c: 1"},
    LENS_TITLE_COLUMN(ROW, lens),
    LENS_WARNING_COLUMN(ROW, warning),
};

struct perspective_row {
    double wavelength; /* um */
    const char *position, *row, *lens, *warning;
    double x, y, z, w;
};

#define CELL(member_name)                                                                          \
    COLUMN(struct perspective_row, member_name), .name = #member_name, .flags = COLUMN_BRIEF

static const struct column perspective_columns[] = {
    LENS_WAVELENGTH_COLUMN(struct perspective_row, wavelength),
    LENS_POSITION_COLUMN(struct perspective_row, position, 0),
    {COLUMN(struct perspective_row, row), .name = "row", BRIEF, .help = "row of the matrix"},
    {CELL(x), .label = "x", .help = "times x of the object point"},
    {CELL(y), .label = "y", .help = "times y"},
    {CELL(z), .label = "z",
     .help = "times z in mm from the front principal point, negative "
             "in front of it"},
    {CELL(w), .label = "w", .help = "times 1"},
    LENS_TITLE_COLUMN(struct perspective_row, lens),
    LENS_WARNING_COLUMN(struct perspective_row, warning),
};

static const struct sheet matrix_sheet = SHEET(columns, ROW);
static const struct sheet perspective_sheet = SHEET(perspective_columns, struct perspective_row);
static const struct sheet *const sheets[] = {&matrix_sheet, &perspective_sheet, NULL};

static bool emit_matrix(const struct lens_case *one, struct run *run, const char *factor,
                        const struct paraxial_matrix *m)
{
    const struct pair determinant =
        pair_subtract(pair_multiply(m->a, m->d), pair_multiply(m->b, m->c));
    const struct matrix_command_row row = {one->light.wavelength,
                                           one->setup->position,
                                           factor,
                                           one->setup->lens->title,
                                           one->warning,
                                           m->a.hi,
                                           m->b.hi,
                                           m->c.hi + 0.0,
                                           m->d.hi,
                                           determinant.hi};
    return run_emit(run, &row);
}

static void emit_factors(const struct lens_case *one, struct run *run)
{
    const struct pair unity = {1, 0}, zero = {0, 0};
    for (size_t i = 0; i < one->light.system.count; i++) {
        const struct paraxial_surface *surface = &one->light.system.surfaces[i];
        const struct paraxial_matrix refraction = {unity, zero, pair_negate(surface->power), unity};
        const struct paraxial_matrix transfer = {unity, surface->reduced, zero, unity};
        if (!emit_matrix(one, run, arena_printf(run->arena, "R%zu", i + 1), &refraction) ||
            (i + 1 < one->light.system.count &&
             !emit_matrix(one, run, arena_printf(run->arena, "T%zu", i + 1), &transfer))) {
            return;
        }
    }
    emit_matrix(one, run, "system", &one->light.first.matrix);
}

/* x' = x/(1 + P z/n), z' = t + (n'/n) z/(1 + P z/n), both z from the front principal point. */
static bool emit_perspective(const struct lens_case *one, struct run *run, struct error *error)
{
    const struct first_order *first = &one->light.first;
    if (first->is_afocal) {
        return fail(error, ERROR_DOMAIN, "an afocal system has no principal planes");
    }
    double n = first->index_object, power = first->power;
    double t = first->length + first->rear_principal - first->front_principal;
    const struct perspective_row rows[] = {
        {.row = "x", .x = 1},
        {.row = "y", .y = 1},
        {.row = "z", .z = first->index_image / n + t * power / n, .w = t},
        {.row = "w", .z = power / n, .w = 1},
    };
    for (size_t i = 0; i < 4; i++) {
        struct perspective_row row = rows[i];
        row.wavelength = one->light.wavelength;
        row.position = one->setup->position;
        row.lens = one->setup->lens->title;
        row.warning = one->warning;
        if (!run_emit(run, &row)) {
            break;
        }
    }
    return true;
}

static bool matrix_run(const void *data, struct run *run, struct error *error)
{
    const struct matrix_input *input = data;
    struct lens_question question = input->question;
    question.fnumber = question.field = question.field_x = NAN;
    struct lens_cursor at = lens_begin(&question, &policy, run->arena);
    while (lens_next(&at, error)) {
        if (!input->perspective) {
            emit_factors(&at.one, run);
        } else if (!emit_perspective(&at.one, run, error)) {
            return false;
        }
    }
    return error->code == ERROR_NONE;
}

static const struct sheet *matrix_choose_sheet(const void *data, const struct option_query *asking)
{
    (void)asking;
    return ((const struct matrix_input *)data)->perspective ? &perspective_sheet : &matrix_sheet;
}

static const struct explanation explanations[] = {
    {"c", "R = [[1, 0], [-P, 1]], T = [[1, t/n], [0, 1]], system = R_k T_(k-1) ... T1 R1",
     "[Smith05]; v = n u", "paraxial"},
    {NULL, NULL, NULL, NULL},
};

static const struct example examples[] = {
    {"matrix double-gauss -w d", "all factors and their product"},
    {"matrix double-gauss --perspective -w d", "the lens as a projective transformation"},
    {NULL, NULL},
};

const struct command command_matrix = {
    .name = "matrix",
    .stop_size_wants = "",
    COMMAND_OF("a lens", "refraction and transfer matrices, and the 4x4 of the thick lens"),
    .run = matrix_run,
    .choose_sheet = matrix_choose_sheet,
    .sheets = sheets,
    .makes_many = command_always_many,
};
