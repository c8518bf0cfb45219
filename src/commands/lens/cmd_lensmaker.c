/* commands/lens/cmd_lensmaker.c - lenscalc lensmaker: one lens, thin or thick. */
/* SPDX-License-Identifier: MIT */
#include "base/arena.h"
#include "cli/question/command.h"
#include "commands/tables.h"
#include "draw/svg.h"
#include "file/lens_file.h"
#include "optics/lensmaker.h"

#include <math.h>
#include <string.h>

struct lensmaker_input {
    struct lensmaker lens;
    double medium; /* index on both sides; NaN = not given */
    bool ball;
    int solution;
};

/* Indexed by the member `solution`. */
static const struct word solutions[] = {
    {"first", "the one that corresponds to the thin lens"},
    {"second", "the other one"},
    {NULL, NULL},
};

#define INDEX(member_name) MEASURE(lens.member_name, number, NULL, "INDEX"), OPTION_POSITIVE
#define PLACE(member_name) MEASURE(lens.member_name, length, "mm", "LENGTH")

#define INPUT struct lensmaker_input

static const struct option options[] = {
    {PLACE(f), .name = "focal-length", .letter = 'f', .column = "focal", .flags = OPTION_GOAL,
     .help = "wanted focal length, 1/power; below 0 for a negative, inf for an afocal lens"},
    {PLACE(R1), .name = "r1", .column = "radius_1", .flags = OPTION_SETTING,
     .help = "first radius, + with the centre to the right; inf for a plane"},
    {PLACE(R2), .name = "r2", .column = "radius_2", .flags = OPTION_SETTING,
     .help = "second radius: of a biconvex lens it is negative"},
    {INDEX(n), .name = "index", .letter = 'n', .column = "index",
     .flags = OPTION_ABOVE_LOWEST | OPTION_NO_INFINITY | OPTION_SETTING,
     .help = "index of the lens"},
    {PLACE(d), .name = "thickness", .letter = 'd', .column = "thickness", .lowest = 0,
     .highest = INFINITY, .flags = OPTION_NO_INFINITY | OPTION_SETTING,
     .help = "thickness at the vertices, of a ball its diameter; 0 (thin) unless solved for"},
    {MEASURE(lens.q, number, NULL, "NUMBER"), REPEATED("shape"), .letter = 'q',
     .flags = OPTION_GOAL,
     .help = "shape factor (R2 + R1)/(R2 - R1): 0 equiconvex, 1 and -1 with a plane, beyond a "
             "meniscus"},
    {INDEX(n0), .name = "before", .column = "index_before", .fallback = "1",
     .flags = OPTION_ABOVE_LOWEST | OPTION_NO_INFINITY, .help = "index of the medium in front"},
    {INDEX(n1), .name = "after", .column = "index_after", .fallback = "1",
     .flags = OPTION_ABOVE_LOWEST | OPTION_NO_INFINITY, .help = "index of the medium behind"},
    {MEASURE(medium, number, NULL, "INDEX"), OPTION_POSITIVE, .name = "medium",
     .flags = OPTION_ABOVE_LOWEST | OPTION_NO_INFINITY, .excludes = "before after",
     .no_number = INDEX_WORDS, .help = "index of the medium on both sides: 1.333 under water"},
    {ASKED(ball), .name = "ball", .help = "a ball lens of diameter --thickness"},
    {ASKED(solution), REPEATED("solution"), .words = solutions, .fallback = "first",
     .value = "WHICH", .help = "which solution, where there are two"},
};

struct lensmaker_row {
    struct lensmaker lens;
    struct lensmaker_facts facts;
    long solutions;
    const char *solution;
};

#define ROW struct lensmaker_row

#define MM(member)         LENGTH(member, "mm")
#define POWER(member_name) MEASURED(facts.member_name, vergence, "diopter")
#define SURE               .condition = offsetof(ROW, facts.condition)

static const struct column columns[] = {
    {MM(lens.f), .name = "focal", .flags = COLUMN_ECHO | COLUMN_INFINITE | COLUMN_BRIEF,
     .with = "focal-length", .symbol = "f", .label = "focal length", SURE,
     .help = "1/power, in every medium"},
    {MM(lens.R1), .name = "radius_1", .flags = COLUMN_ECHO | COLUMN_INFINITE | COLUMN_BRIEF,
     .with = "r1", .symbol = "R1", .label = "first radius", .help = "radius of the first surface"},
    {MM(lens.R2), .name = "radius_2", .flags = COLUMN_ECHO | COLUMN_INFINITE | COLUMN_BRIEF,
     .with = "r2", .symbol = "R2", .label = "second radius",
     .help = "radius of the second surface"},
    {SHOWN(lens.n), .name = "index", .flags = COLUMN_ECHO | COLUMN_BRIEF, .with = "index",
     .symbol = "n", .help = "index of the lens"},
    {MM(lens.d), .name = "thickness", .flags = COLUMN_ECHO | COLUMN_BRIEF, .with = "thickness",
     .symbol = "d", .help = "between the vertices"},
    {SHOWN(lens.q), .name = "shape", .flags = COLUMN_ECHO | COLUMN_INFINITE, .with = "shape",
     .symbol = "q", .label = "shape factor", .help = "(R2 + R1)/(R2 - R1)"},
    {POWER(power), .name = "power", .symbol = "P", .flags = COLUMN_BRIEF,
     .help = "power of the lens", SURE},
    {POWER(P1), .name = "power_1", .symbol = "P1", .label = "power of the first surface",
     .help = "(n - n0)/R1"},
    {POWER(P2), .name = "power_2", .symbol = "P2", .label = "power of the second surface",
     .help = "(n1 - n)/R2"},
    {MM(facts.bfl), .name = "bfl", .symbol = "bfl", .flags = COLUMN_INFINITE | COLUMN_BRIEF,
     .label = "back focal length", SURE,
     .help = "rear focus F' from the last vertex, + to the right"},
    {MM(facts.ffl), .name = "ffl", .symbol = "ffl", .flags = COLUMN_INFINITE, SURE,
     .label = "front focal length", .help = "front focus F from the first vertex"},
    {MM(facts.front_focal), .name = "front_focal", .flags = COLUMN_INFINITE | COLUMN_HIDDEN,
     .label = "principal to front focus", SURE, .help = "from H to F, -n0/P"},
    {MM(facts.rear_focal), .name = "rear_focal", .flags = COLUMN_INFINITE | COLUMN_HIDDEN,
     .label = "principal to rear focus", SURE, .help = "from H' to F', n1/P"},
    {MM(facts.H), .name = "front_principal", .symbol = "H", .flags = COLUMN_INFINITE,
     .label = "front principal plane", SURE, .help = "H from the first vertex, + to the right"},
    {MM(facts.H_rear), .name = "rear_principal", .symbol = "H'", .flags = COLUMN_INFINITE,
     .label = "rear principal plane", SURE, .help = "H' from the last vertex, + to the right"},
    {MM(facts.N), .name = "front_nodal", .flags = COLUMN_INFINITE | COLUMN_HIDDEN,
     .label = "front nodal point", SURE, .help = "N from the first vertex"},
    {MM(facts.N_rear), .name = "rear_nodal", .flags = COLUMN_INFINITE | COLUMN_HIDDEN,
     .label = "rear nodal point", SURE, .help = "N' from the last vertex"},
    {SHOWN(solutions), .name = "solutions",
     .help = "how many lenses answer the question: see --solution"},
    {SHOWN(solution), .name = "solution", WITH("solution"), .help = "which of them this is"},
    {SHOWN(lens.n0), .name = "index_before", .symbol = "n0",
     ASSUMED_BY("before medium") | COLUMN_ECHO, .label = "index before",
     .help = "index of the medium in front of the lens"},
    {SHOWN(lens.n1), .name = "index_after", .symbol = "n1",
     ASSUMED_BY("after medium") | COLUMN_ECHO, .label = "index after",
     .help = "index of the medium behind the lens"},
};

static bool lensmaker_row_solve(const struct lensmaker_input *input, struct lensmaker *lens,
                                int *count, struct error *error)
{
    struct lensmaker_choice choice = {.second = input->solution != 0};
    *lens = input->lens;
    if (!isnan(input->medium)) {
        lens->n0 = lens->n1 = input->medium;
    }
    bool done = input->ball ? lensmaker_solve_ball(lens, &choice, error)
                            : lensmaker_solve(lens, &choice, error);
    *count = choice.count;
    return done;
}

static bool lensmaker_run(const void *data, struct run *run, struct error *error)
{
    const struct lensmaker_input *input = data;
    struct lensmaker_row row = {0};
    int count;
    if (!lensmaker_row_solve(input, &row.lens, &count, error)) {
        return false;
    }
    row.solutions = count;
    row.solution = solutions[input->solution].word;
    lensmaker_facts(&row.lens, &row.facts);
    if (row.lens.n1 != 1 && isfinite(row.facts.rear_focal)) {
        warnings_add(run->doubts,
                     "the focal length is 1/power in every medium; light from afar meets %.6g mm "
                     "from the rear principal plane, n' times as far (column rear_focal)",
                     row.facts.rear_focal);
    }
    run_emit(run, &row);
    return true;
}

/* A length or index of a prescription: as many digits as the double needs, `-` for a plane. */
static const char *lensmaker_cell(struct arena *arena, double value)
{
    char number[NUMBER_LENGTH + 1];
    if (isinf(value)) {
        return "-";
    }
    *number_write_shortest(number, value) = '\0';
    return arena_printf(arena, "%s", number);
}

/* The lens as a .lens file. */
static bool write_lens(const struct artifact_job *job, struct output *sink, struct error *error)
{
    const struct lensmaker_input *input = job->inputs[0];
    struct arena *arena = job->run->arena;
    struct lensmaker lens;
    struct lensmaker_facts facts;
    int count;
    if (!lensmaker_row_solve(input, &lens, &count, error)) {
        return false;
    }
    lensmaker_facts(&lens, &facts);
    double back = isfinite(facts.bfl) && facts.bfl > 0 ? facts.bfl : 0;
    const char *medium =
        lens.n0 == 1 ? "" : arena_printf(arena, "medium      %s\n", lensmaker_cell(arena, lens.n0));
    output_string(sink, arena_printf(arena,
                                     "lens        %s, f = %.6g mm\n"
                                     "source      lenscalc lensmaker\n"
                                     "unit        mm\n"
                                     "wavelength  d\n"
                                     "%sobject      inf\n"
                                     "focus       paraxial\n"
                                     "#           radius              thickness           "
                                     "medium    diameter\n"
                                     "surface     %-19s %-19s %-9s -\n"
                                     "surface     %-19s %-19s %-9s -\n",
                                     input->ball ? "Ball lens" : "Single lens", lens.f, medium,
                                     lensmaker_cell(arena, lens.R1), lensmaker_cell(arena, lens.d),
                                     lensmaker_cell(arena, lens.n), lensmaker_cell(arena, lens.R2),
                                     lensmaker_cell(arena, back),
                                     lens.n1 == 1 ? "air" : lensmaker_cell(arena, lens.n1)));
    return true;
}

static const struct explanation explanations[] = {
    {"focal", "f = 1/{P}", "[Welford86] ch. 3; the same in every medium",
     "the distances from the principal planes to the foci are -n0 f and n1 f"},
    {"shape", "q = ({R2} + {R1})/({R2} - {R1})", "[Jenkins76]", NULL},
    {"power", "P = {P1} + {P2} - {d}/{n} {P1} {P2}",
     "lens-maker's formula, [Hanrahan04], with thickness [Welford86] ch. 3", "paraxial"},
    {"power_1", "P1 = ({n} - {n0})/{R1}", "[Welford86] ch. 3", NULL},
    {"power_2", "P2 = ({n1} - {n})/{R2}", "[Welford86] ch. 3", NULL},
    {"bfl", "bfl = {n1} (1 - {d} {P1}/{n})/{P}", "[Welford86] ch. 3", NULL},
    {"ffl", "ffl = -{n0} (1 - {d} {P2}/{n})/{P}", "[Welford86] ch. 3", NULL},
    {"front_principal", "H = {n0} {d} {P2}/({n} {P})", "[Welford86] ch. 3", NULL},
    {"rear_principal", "H' = -{n1} {d} {P1}/({n} {P})", "[Welford86] ch. 3", NULL},
    {"front_nodal", "N = {H} + ({n1} - {n0})/{P}", "[Welford86] ch. 3", NULL},
    {"rear_nodal", "N' = {H'} + ({n1} - {n0})/{P}", "[Welford86] ch. 3", NULL},
    {NULL, NULL, NULL, NULL},
};

static const struct file_type *prescription_types(size_t i)
{
    return i == 0 ? &lens_file_type : NULL;
}

static const struct artifact artifacts[] = {
    {ARTIFACT_OPTION("lens-file", prescription_types, "write the lens as a prescription"),
     .scope = ARTIFACT_OF_ROW, .make = write_lens},
};

static const struct example examples[] = {
    {"lensmaker --r1 50 --r2 -50 -n 1.5168 -d 5mm", "a biconvex lens"},
    {"lensmaker -f 100mm --shape 1 -n 1.5168", "the radii of a plano-convex lens"},
    {"lensmaker -f 100mm --shape -1..1:0.5 -n 1.5168 -d 8", "bending"},
    {"lensmaker --r1 50 --r2 -50 -n 1.5168 --medium 1.333", "under water"},
    {"lensmaker --ball -d 10mm -n 1.5168", "a ball lens"},
    {"lensmaker --r1 60 --r2 40 -n 1.5 -f inf", "how thick an afocal lens must be"},
    {"lensmaker -f 100 --r1 60 -n 1.5168 -d 6 --lens-file single.lens", "a prescription"},
    {NULL, NULL},
};

const struct command command_lensmaker = {
    .name = "lensmaker",
    COMMAND_OF("one surface, one lens",
               "one lens, thin or thick: focal length, or the radii, index or thickness for one"),
    .run = lensmaker_run,
    COMMAND_MAKES(artifacts),
    .plot = "focal_mm,bfl_mm",
    .plot_titles = "Focal length of a lens in air",
    .cell = "focal_mm",
};
