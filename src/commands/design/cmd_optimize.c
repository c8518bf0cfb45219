/* commands/design/cmd_optimize.c - lenscalc optimize: a lens made better. */
/* SPDX-License-Identifier: MIT */
#include "base/parallel.h"
#include "cli/question/division.h"
#include "commands/analysis/analysis_options.h"
#include "commands/analysis/report_page.h"
#include "commands/design/optimize_job.h"
#include "file/lens_file.h"
#include "trace/aim/sample.h"

static const struct word shows[] = {
    [OPTIMIZE_ANSWER] = {"answer", "the merit before and after, one row"},
    [OPTIMIZE_MERIT] = {"merit", "each goal before and after, with its share"},
    [OPTIMIZE_VARIABLES] = {"variables", "each variable before and after"},
    [OPTIMIZE_SPOTS] = {"spots", "converged spots of each field and wavelength, as spot has them"},
    [OPTIMIZE_GLASSES] = {"glasses", "each glass that replaced a model glass, and the loss"},
    [OPTIMIZE_PLATES] = {"plates", "each radius replaced by that of a test plate, and the loss"},
    {NULL, NULL},
};

static const struct word solvers[] = {
    [SOLVER_DLS] = {"dls", "damped least squares"},
    [SOLVER_CERES] = {"ceres", "the solver of that name, in a program of its own"},
    {NULL, NULL},
};

static const struct option options[] = {
    LENS_OPTION(struct optimize_input, question),
    {OPTION(struct optimize_input, start), .name = "start", .value = "WORDS",
     .excludes = "lens vary hold field aperture position",
     .why = "--start describes the lens itself",
     .help = "design from scratch: elements=5,efl=50mm,fnumber=2,field=22deg; or image=40mm, the "
             "diameter of the image circle; also object=1m, stop=2 (behind so many elements), "
             "bfl=20mm at least, track=60mm at most"},
    {OPTION(struct optimize_input, vary), .name = "vary", .value = "PARTS",
     .help = "variables: R1,c2[-0.04,0.04],t3[2,10],k4,A4_4,glass6 (radius, curvature, thickness, "
             "conic, coefficient, glass, each with bounds), R1..R11, all-R, all-t; otherwise the "
             "marks R~ and t~ in the lens"},
    {OPTION(struct optimize_input, hold), .name = "hold", .value = "PARTS",
     .help = "variables that are held: R3,t5"},
    {OPTION(struct optimize_input, goals), .name = "goals", .value = "GOALS",
     .help = "goals: spot, poly, efl=100, 'bfl@F>38:0.02', 'edge 1..11 > 1', mtf@40/mm=1, "
             "'length + bfl < 60'; == for exact constraints; otherwise the goals in the lens, or "
             "defaults"},
    {OPTION(struct optimize_input, no_goal), .name = "no-goal", .value = "NAMES",
     .help = "default goals to leave out: poly, efl, fnumber, bfl, center, edge, air, grazing"},
    {OPTION(struct optimize_input, grade), .name = "grade", .value = "NAME",
     .help = "tolerance grade for the goal asbuilt: commercial, precision or high ('list "
             "tolerances'); without it the marks of the lens, without any precision"},
    {OPTION(struct optimize_input, tolerances), .name = "tolerances", .value = "FILE",
     .flags = OPTION_FILE,
     .help = "tolerances for the goal asbuilt, lines as in a lens, replacing those in the lens"},
    {OPTION(struct optimize_input, glasses), .name = "glasses", .value = "GLASSES",
     .help = "catalogues and glasses that replace the variable model glasses: "
             "SCHOTT,OHARA or N-BK7,N-SF5"},
    {OPTION(struct optimize_input, plates), .name = "test-plates", .value = "FILE",
     .flags = OPTION_FILE,
     .help = "a maker's list of test plates, columns radius_mm and diameter_mm: their radii "
             "replace the variable ones"},
    DESIGN_VIEW_OPTIONS(struct optimize_input, "the positions that are optimised together"),
    {OPTION(struct optimize_input, aim), .name = "aim", .words = analysis_aims, .fallback = "stop",
     .value = "WHERE", .help = "pupil that the ray points lie in"},
    DESIGN_RAYS_OPTIONS(struct optimize_input,
                        .help = "approximate number of rays per field and wavelength; default 36, "
                                "and more if these prove too few"),
    {OPTION(struct optimize_input, seed), .name = "seed", .lowest = 0, .highest = 1e9,
     .fallback = "0", .value = "NUMBER", .wants = "global|start|pattern=sobol",
     .help = "seed of the starts of --global and of the sobol pattern"},
    {OPTION(struct optimize_input, clip), .name = "clip", .excludes = "no-clip",
     .help = "clip rays at apertures and stop"},
    {OPTION(struct optimize_input, no_clip), .name = "no-clip",
     .help = "do not clip rays at clear apertures (default)"},
    {OPTION(struct optimize_input, solver), .name = "solver", .words = solvers, .fallback = "dls",
     .value = "SOLVER", .help = "solver that makes the steps"},
    {OPTION(struct optimize_input, iterations), .name = "iterations", .lowest = 1, .highest = 1e6,
     .column = "iterations_wanted", .value = "COUNT",
     .help = "limit of iterations; default 200, up to 1000 while 20 of them gain 1 %"},
    {OPTION(struct optimize_input, seconds), .name = "seconds", .dimension = &dimension_time,
     .unit = "s", .lowest = 0, .highest = INFINITY, .flags = OPTION_ABOVE_LOWEST, .value = "TIME",
     .help = "the best of so long, which depends on the machine"},
    {OPTION(struct optimize_input, threads), .name = "threads", .lowest = 0,
     .highest = PARALLEL_MOST, .value = "N", .fallback = "1", .flags = OPTION_ASIDE,
     .wants = "glasses|global|start",
     .help = "threads that try glasses, or search from starts; 0 = one per core"},
    {OPTION(struct optimize_input, global), .name = "global", .lowest = 1,
     .highest = OPTIMIZE_MOST_STARTS, .most = "many", .value = "COUNT",
     .help = "search from so many starts between the bounds of what varies: the lens itself, and "
             "others all over; many: until --seconds are over, or it is interrupted"},
    {OPTION(struct optimize_input, keep), .name = "keep", .lowest = 1, .highest = 1000,
     .value = "COUNT", .wants = "global|start",
     .help = "the best different lenses that are kept: NEW-1.lens, NEW-2.lens, ...; default 1, "
             "with --start 10"},
    {OPTION(struct optimize_input, escapes), .name = "escapes", .lowest = 0, .highest = 1000,
     .fallback = "2", .value = "COUNT", .wants = "global|start",
     .help = "escapes from each minimum that are tried per start"},
    {OPTION(struct optimize_input, relocate), .name = "relocate", .lowest = 0, .highest = 1000,
     .fallback = "0", .value = "COUNT", .wants = "global|start", .excludes = "part",
     .help = "also relocate each element of so many of the best lenses as a null element, and "
             "descend to both sides of the saddle point"},
    {OPTION(struct optimize_input, spread), .name = "spread", .dimension = &dimension_number,
     .lowest = 0, .highest = 1000, .fallback = "1", .flags = OPTION_ABOVE_LOWEST, .value = "NUMBER",
     .wants = "global|start",
     .help =
         "range of the starts of variables without two bounds, in natural scales about the lens"},
    {OPTION(struct optimize_input, part), .name = "part", .value = "I/N", .flags = OPTION_ASIDE,
     .wants = "global|start", .excludes = "seconds",
     .help = "only part I of N of the starts, into a .part for 'lenscalc merge'"},
    {OPTION(struct optimize_input, margin), LENS_DIAMETERS_OPTION, .wants = "output"},
    {OPTION(struct optimize_input, show), .name = "show", .words = shows, .fallback = "answer",
     .value = "WHAT", .help = "which rows"},
};

static const struct sheet *optimize_choose_sheet(const void *data,
                                                 const struct option_query *asking)
{
    (void)asking;
    return optimize_sheets[((const struct optimize_input *)data)->show];
}

static bool optimize_makes_many(const void *data)
{
    return ((const struct optimize_input *)data)->show != OPTIMIZE_ANSWER ||
           optimize_keep_count(data) > 1;
}

static bool optimize_command_run(const void *data, struct run *run, struct error *error)
{
    struct optimize_job *job = ARENA_NEW(run->arena, struct optimize_job);
    struct optimize_input *input = ARENA_NEW(run->arena, struct optimize_input);
    *input = *(const struct optimize_input *)data; /* a sweep changes it */
    job->earlier = run->state;
    job->input = input;
    job->run = run;
    run->state = job;
    return optimize_job_run(job, error) && optimize_emit(job, error);
}

static const struct file_type *optimize_saved_types(size_t i)
{
    return i == 0 ? &lens_file_type : NULL;
}

/* A part, whatever it is called; lenses by their name. */
static const struct file_type *choose_part(const void *data)
{
    return ((const struct optimize_input *)data)->part.count > 0 ? division_types(0) : NULL;
}

static size_t count_saved(const void *data)
{
    return choose_part(data) != NULL ? 1 : optimize_keep_count(data);
}

static const struct artifact artifacts[] = {
    {.option = {.kind = &kind_text,
                .name = "output",
                .letter = 'o',
                .value = "NEW.lens",
                .flags = OPTION_FILE,
                .types = optimize_saved_types,
                .help = "write the lens that was found; rows go to standard output"},
     .is_kept = true,
     .choose = choose_part,
     .count = count_saved,
     .check = optimize_check_saved,
     .make = optimize_save},
    {.option = {.kind = &kind_text,
                .name = "state",
                .value = "FILE",
                .flags = OPTION_FILE,
                .wants = "global|start",
                .help = "what the starts led to so far: goes on from it if it is there, and is "
                        "written now and then"},
     .make = optimize_save_state},
    {ARTIFACT_OPTION("report", page_types,
                     "a page with the lens before and after side by side: drawings, spots, the "
                     "variables that moved most, the goals, what binds"),
     .is_kept = true, .make = optimize_report},
    {ARTIFACT_OPTION("plot", drawing_types,
                     "draw the merit against the iteration, or where the starts ended"),
     .scope = ARTIFACT_OF_SWEEP, .is_kept = true, .make = optimize_plot},
};

static const struct explanation explanations[] = {
    {"merit_after",
     "sum ((value - target)/deviation)^2 over all goals, fields, wavelengths, positions and rays; "
     "steps -(J^T J + l D)^-1 J^T r, bounds by an active set, conditions by multipliers, D after "
     "the "
     "second derivatives",
     "[Levenberg44]; [Spencer63]; [Dilworth78]; of a search [Isshiki95]",
     "a local minimum: the one downhill from the start, of a search the best that was found"},
    {"loss",
     "merit after the exchange less that before; of the 8 glasses nearest by sqrt((dnd/0.1)^2 + "
     "(dVd/10)^2 + (dP/0.02)^2), P of PgF from the normal line, the one that loses least; the last "
     "three by branch and bound",
     "[Schott16], of the normal line", "each time all else is optimised again, to a local minimum"},
    {NULL, NULL, NULL, NULL},
};

static const struct example examples[] = {
    {"optimize double-gauss --vary all-R --goals spot,efl=100",
     "all radii, for small spots of each wavelength"},
    {"optimize double-gauss --vary all-R --goals spot,efl=100 --report page.html",
     "with a page that shows start and end side by side"},
    {"optimize double-gauss --vary all-R --goals spot,efl==100 --show merit",
     "goal by goal, the focal length exactly"},
    {"optimize cooke-triplet-50 --vary all-R,t2,t4 --goals poly,efl=50 --rays 12 --global 4",
     "the best of what four starts lead to"},
    {"optimize --start elements=2,efl=100mm,fnumber=8,field=2deg --global 4 --rays 12",
     "two-element lenses, from scratch"},
    {"optimize double-gauss --vary all-R,glass1,glass10 --goals poly,efl=100 --glasses SCHOTT "
     "--show glasses",
     "the first and the last glass become real ones"},
    {NULL, NULL},
};

const struct command command_optimize = {
    .name = "optimize",
    .group = "design",
    .summary = "optimize a lens: the nearest local minimum, or the best of many",
    COMMAND_ASKS(struct optimize_input),
    .choose_sheet = optimize_choose_sheet,
    .sheets = optimize_sheets,
    .makes_many = optimize_makes_many,
    .run = optimize_command_run,
    COMMAND_MAKES(artifacts),
    .explanations = explanations,
    .cell = "merit_after",
    .needs_ceres = "solver=ceres",
    .keeps_best = true,
    .is_divided = true,
    .most_answers = 10000,
};
