/* exchange/oslo/oslo_read.c - read an OSLO lens file. */
/* SPDX-License-Identifier: MIT */
#include "exchange/merge_positions.h"
#include "exchange/oslo/oslo.h"
#include "exchange/oslo/oslo_reading.h"
#include "exchange/sequence.h"

#include <math.h>
#include <string.h>

static const struct command_grammar grammar = {
    .comment = "//", .quotes = "\"", .separator = ';', .continuation = '\0', .infinity = 1e8};
static const struct number_scale plain = {1, 0};

/* The surface being read, and the words behind the command's name are what they should be. */
static struct sequence_surface *present(struct oslo *oslo)
{
    return &oslo->sequence.surfaces[oslo->surface];
}

static bool oslo_read_one(struct oslo *oslo, struct number_scale scale, const char *what,
                          struct figure *figure, struct error *error)
{
    return commands_figure(&oslo->commands, 1, scale, what, figure, error) &&
           commands_end(&oslo->commands, 2, error);
}

static bool read_len(struct oslo *oslo, int what, struct error *error)
{
    (void)what;
    const struct command_word mode = commands_word(&oslo->commands, 1);
    const struct text title = commands_word(&oslo->commands, 2).text;
    if (!text_same(mode.text, "NEW")) {
        return commands_fail(&oslo->commands, &mode, error, "a lens begins with LEN NEW");
    }
    if (oslo->has_begun) {
        return commands_fail(&oslo->commands, &oslo->commands.words[0], error,
                             "a second lens in the file");
    }
    oslo->has_begun = true;
    if (title.length > 0) {
        oslo->build.lens->title = lens_build_string(&oslo->build, title);
    }
    return true;
}

/* EBR (radius of the beam), NAO, FNO */
static bool oslo_read_aperture(struct oslo *oslo, int what, struct error *error)
{
    static const enum aperture_kind kinds[] = {APERTURE_EPD, APERTURE_NA, APERTURE_FNUMBER};
    struct lens *lens = oslo->build.lens;
    struct figure figure;
    if (!oslo_read_one(oslo, what == 0 ? oslo->commands.scale : plain, "aperture", &figure,
                       error)) {
        return false;
    }
    if (!(figure.value.hi > 0)) {
        return commands_fail(&oslo->commands, &oslo->commands.words[1], error,
                             "the aperture must be above 0");
    }
    lens->aperture_kind = kinds[what];
    lens->aperture = what == 0 ? sequence_diameter(&figure, oslo->job->arena) : figure;
    oslo->aperture = oslo->commands.words[0];
    return true;
}

/* ANG, OBH, GIH: the field's edge; what it means depends on the object, so it is kept. */
static bool oslo_read_field(struct oslo *oslo, int what, struct error *error)
{
    oslo->field_is = (enum oslo_field)what;
    oslo->field_at = oslo->commands.words[0];
    return oslo_read_one(oslo, what == OSLO_ANGLE ? plain : oslo->commands.scale, "field",
                         &oslo->field, error) &&
           (what != OSLO_ANGLE || fabs(oslo->field.value.hi) <= 180 ||
            commands_fail(&oslo->commands, &oslo->commands.words[1], error,
                          "a field angle is not beyond 180 degrees"));
}

static bool oslo_read_note(struct oslo *oslo, int what, struct error *error)
{
    (void)what, (void)error;
    const struct text note = commands_word(&oslo->commands, 1).text;
    if (note.length > 0) {
        lens_build_note(&oslo->build, note);
    }
    return true;
}

static bool next_surface(struct oslo *oslo, int what, struct error *error)
{
    (void)what;
    const struct command_word at = oslo->commands.words[0];
    if (oslo->sequence.count == FOREIGN_MOST_SURFACES) {
        return commands_fail(&oslo->commands, &at, error, "more than %d surfaces",
                             LENS_MOST_SURFACES);
    }
    oslo->surface = oslo->sequence.count;
    sequence_add(&oslo->sequence, at);
    return true;
}

/* AIR, RFL, RFH and the glass are the last that was said. */
static bool oslo_read_medium(struct oslo *oslo, int what, struct error *error)
{
    struct sequence_surface *surface = present(oslo);
    surface->reflects = what != 0;
    surface->medium = medium_air;
    surface->glass = (struct command_word){{"", 0}, {"", 0}, 0, false};
    return commands_end(&oslo->commands, 1, error);
}

static bool oslo_read_curve(struct oslo *oslo, int what, struct error *error)
{
    struct sequence_surface *surface = present(oslo);
    surface->is_radius = what == 0;
    if (!oslo_read_one(oslo, what == 0 ? oslo->commands.scale : plain,
                       what == 0 ? "radius" : "curvature", &surface->curve, error)) {
        return false;
    }
    if (what != 0) {
        sequence_per_length(&oslo->commands, 1, &surface->curve);
    }
    return true;
}

static bool oslo_read_thickness(struct oslo *oslo, int what, struct error *error)
{
    (void)what;
    if (oslo->surface == 0) {
        return commands_object(&oslo->commands, 1, &present(oslo)->thickness, error) &&
               commands_end(&oslo->commands, 2, error);
    }
    return oslo_read_one(oslo, oslo->commands.scale, "thickness", &present(oslo)->thickness, error);
}

/* AP 5, AP CHK 5; an aperture of the size of the sky is none. */
static bool oslo_read_diameter(struct oslo *oslo, int what, struct error *error)
{
    (void)what;
    const struct command_word word = commands_word(&oslo->commands, 1);
    size_t at =
        text_same(word.text, "CHK") || text_same(word.text, "UNC") || text_same(word.text, "NOT")
            ? 2
            : 1;
    struct figure radius;
    if (!commands_figure(&oslo->commands, at, oslo->commands.scale, "radius of the aperture",
                         &radius, error) ||
        !commands_end(&oslo->commands, at + 1, error)) {
        return false;
    }
    if (!(radius.value.hi >= 0)) {
        return commands_fail(&oslo->commands, &oslo->commands.words[at], error,
                             "the radius of an aperture is not below 0");
    }
    if (oslo->surface > 0) {
        present(oslo)->diameter = sequence_diameter(&radius, oslo->job->arena);
    }
    return true;
}

static bool oslo_read_stop(struct oslo *oslo, int what, struct error *error)
{
    (void)what;
    for (size_t i = 0; i < oslo->sequence.count; i++) {
        oslo->sequence.surfaces[i].is_stop = i == oslo->surface;
    }
    oslo->has_stop = true;
    return commands_end(&oslo->commands, 1, error);
}

/* The conic, of order 0, or the coefficient of r^order. */
static bool oslo_read_constant(struct oslo *oslo, int order, struct error *error)
{
    struct figure figure;
    if (!oslo_read_one(oslo, plain, order == 0 ? "conic" : "coefficient", &figure, error)) {
        return false;
    }
    sequence_set_constant(&oslo->sequence, present(oslo), order, figure);
    return true;
}

static bool read_general(struct oslo *oslo, int what, struct error *error)
{
    (void)what, (void)error;
    const struct command_word word = commands_word(&oslo->commands, 1);
    if (text_same(word.text, "ASR")) {
        oslo->asphere_step = 2;
    } else if (text_same(word.text, "ARA")) {
        oslo->asphere_step = 1;
    } else {
        oslo->asphere_step = 0;
    }
    return oslo->asphere_step > 0 || text_same(word.text, "ADO") ||
           commands_lose(&oslo->commands, LOSS_OF_RAYS, NULL,
                         "an asphere that is not a polynomial of r");
}

/* AS1 is the coefficient of r^2, AS2 of r^4 .. of ASP ASR; of r, r^2 .. of ASP ARA. */
static bool read_general_coefficient(struct oslo *oslo, struct error *error)
{
    const struct command_word *word = &oslo->commands.words[0];
    const struct text digits = {word->text.start + 2, word->text.length - 2};
    struct figure figure;
    size_t index;
    if (!commands_count(&oslo->commands, word, digits, "number of the coefficient", 0, &index,
                        error) ||
        !oslo_read_one(oslo, plain, "coefficient", &figure, error)) {
        return false;
    }
    if (figure.value.hi == 0) {
        return true;
    }
    int order = index <= LENS_COEFFICIENTS ? oslo->asphere_step * (int)index : 0;
    if (surface_term(order) < 0) {
        return commands_lose(
            &oslo->commands, LOSS_OF_RAYS, NULL,
            "a coefficient of another asphere than ASP ASR and ASP ARA, of order 1 to 20");
    }
    return oslo_read_constant(oslo, order, error);
}

static bool oslo_read_shift(struct oslo *oslo, int what, struct error *error)
{
    bool is_turn = what >= 'A' && what <= 'C';
    struct figure figure;
    if (!oslo_read_one(oslo, is_turn ? plain : oslo->commands.scale, is_turn ? "tilt" : "decentre",
                       &figure, error)) {
        return false;
    }
    sequence_set_shift(&oslo->sequence, present(oslo), what, figure);
    return true;
}

/* DT 1: first shifted, then turned. DT -1 is the same where there is one shift or turn alone. */
static bool read_order(struct oslo *oslo, int what, struct error *error)
{
    (void)what;
    struct figure figure;
    if (!oslo_read_one(oslo, plain, "order of shift and turn", &figure, error)) {
        return false;
    }
    present(oslo)->turns_first = figure.value.hi < 0;
    return true;
}

static bool read_move(struct oslo *oslo, int what, struct error *error)
{
    struct sequence_surface *surface = present(oslo);
    const struct command_word word = commands_word(&oslo->commands, 1);
    size_t to = oslo->surface;
    if (word.text.length > 0 && !commands_count(&oslo->commands, &word, word.text,
                                                "number of the surface", 0, &to, error)) {
        return false;
    }
    surface->move = (enum sequence_move)what;
    surface->decentred_at = oslo->commands.words[0];
    bool is_own = to == oslo->surface || to == 0; /* RCO 0: its own */
    return is_own || what != SEQUENCE_BACK ||
           commands_lose(&oslo->commands, LOSS_OF_RAYS, NULL, "coordinates of another surface");
}

static const struct {
    const char *name;
    bool is_thickness, of_angle;
    enum solve_ray ray;
} solves[] = {{"PY", true, false, SOLVE_MARGINAL},
              {"PYC", true, false, SOLVE_CHIEF},
              {"PU", false, true, SOLVE_MARGINAL},
              {"PUC", false, true, SOLVE_CHIEF}};

static bool oslo_read_solve(struct oslo *oslo, int what, struct error *error)
{
    struct sequence_surface *surface = present(oslo);
    struct sequence_solve *solve =
        solves[what].is_thickness ? &surface->thickness_solve : &surface->curvature_solve;
    *solve = (struct sequence_solve){.is_set = true,
                                     .of_angle = solves[what].of_angle,
                                     .ray = solves[what].ray,
                                     .at = oslo->commands.words[0]};
    return oslo_read_one(oslo, solves[what].is_thickness ? oslo->commands.scale : plain,
                         "target of the solve", &solve->target, error);
}

/* Angles of incidence and aplanatic: curvatures; contact at the edge: a thickness. */
static bool read_other_solve(struct oslo *oslo, int is_thickness, struct error *error)
{
    struct sequence_surface *surface = present(oslo);
    (void)error;
    *(is_thickness ? &surface->thickness_solve : &surface->curvature_solve) =
        (struct sequence_solve){.is_set = true, .is_unknown = true, .at = oslo->commands.words[0]};
    return true;
}

static bool oslo_read_end(struct oslo *oslo, int what, struct error *error)
{
    (void)what, (void)error;
    oslo->has_ended = true;
    return true;
}

static bool oslo_read_nothing(struct oslo *oslo, int what, struct error *error)
{
    (void)oslo, (void)what, (void)error;
    return true;
}

/* A command that is lost by its group, but where its only number is 0. */
static bool oslo_read_lose(struct oslo *oslo, const struct word_group *group, struct error *error)
{
    struct figure figure;
    bool checked = (group->flags & WORD_COUNTS_AT_0) == 0;
    if (checked && !oslo_read_one(oslo, plain, "value", &figure, error)) {
        return false;
    }
    return (checked && figure.value.hi == 0) ||
           commands_lose(&oslo->commands, word_group_effect(group), NULL, group->what);
}

/* TEM in C, PRE in atmospheres. */
static bool oslo_read_environment(struct oslo *oslo, int what, struct error *error)
{
    return sequence_environment(&oslo->sequence, what == 'T', 1, error);
}

static const struct {
    const char *name;
    bool (*run)(struct oslo *oslo, int what, struct error *error);
    int what;
} keywords[] = {
    {"LEN", read_len, 0},
    {"EBR", oslo_read_aperture, 0},
    {"NAO", oslo_read_aperture, 1},
    {"FNO", oslo_read_aperture, 2},
    {"FNB", oslo_read_aperture, 2},
    {"ANG", oslo_read_field, OSLO_ANGLE},
    {"OBH", oslo_read_field, OSLO_OBJECT},
    {"GIH", oslo_read_field, OSLO_IMAGE},
    {"UNI", oslo_read_nothing, 0}, /* read before all others */
    {"NXT", next_surface, 0},
    {"SEF", next_surface, 0}, /* of old files */
    {"AIR", oslo_read_medium, 0},
    {"AIF", oslo_read_medium, 0},
    {"RFL", oslo_read_medium, 1},
    {"RFH", oslo_read_medium, 1},
    {"GLA", oslo_glass, 0},
    {"GLF", oslo_glass, 0},
    {"RD", oslo_read_curve, 0},
    {"RDF", oslo_read_curve, 0},
    {"CV", oslo_read_curve, 1},
    {"CVF", oslo_read_curve, 1},
    {"TH", oslo_read_thickness, 0},
    {"THF", oslo_read_thickness, 0},
    {"AP", oslo_read_diameter, 0},
    {"APF", oslo_read_diameter, 0},
    {"AST", oslo_read_stop, 0},
    {"CC", oslo_read_constant, 0},
    {"AD", oslo_read_constant, 4},
    {"AE", oslo_read_constant, 6},
    {"AF", oslo_read_constant, 8},
    {"AG", oslo_read_constant, 10},
    {"ASP", read_general, 0},
    {"DCX", oslo_read_shift, 'X'},
    {"DCY", oslo_read_shift, 'Y'},
    {"DCZ", oslo_read_shift, 'Z'},
    {"TLA", oslo_read_shift, 'A'},
    {"TLB", oslo_read_shift, 'B'},
    {"TLC", oslo_read_shift, 'C'},
    {"DT", read_order, 0},
    {"BEN", read_move, SEQUENCE_BEND},
    {"RCO", read_move, SEQUENCE_BACK},
    {"PY", oslo_read_solve, 0},
    {"PYC", oslo_read_solve, 1},
    {"PU", oslo_read_solve, 2},
    {"PUC", oslo_read_solve, 3},
    {"PI", read_other_solve, 0},
    {"PIC", read_other_solve, 0},
    {"APA", read_other_solve, 0},
    {"EC", read_other_solve, 1},
    {"PK", oslo_pickup, 0},
    {"WV", oslo_waves, 0},
    {"WW", oslo_weights, 0},
    {"END", oslo_read_end, 0},
    {"F", oslo_point, 0},
    {"TEM", oslo_read_environment, 'T'},
    {"PRE", oslo_read_environment, 'P'},
    {"TELE", oslo_telecentric, 0},
    {"AMO", oslo_mode, 0},
};

static bool run_numbered(struct oslo *oslo, struct text name, bool *known, struct error *error)
{
    bool digit =
        name.length > 2 && name.start[name.length - 1] >= '0' && name.start[name.length - 1] <= '9';
    struct text first = {name.start, 2};
    *known = true;
    if (digit && text_same(first, "WV")) {
        return oslo_wave(oslo, error);
    }
    if (digit && text_same(first, "WW")) {
        return oslo_weight(oslo, error);
    }
    if (digit && text_same(first, "AS")) {
        return read_general_coefficient(oslo, error);
    }
    first.length = 3;
    if (digit && name.length > 3 && text_same(first, "SNO")) {
        return oslo_read_note(oslo, 0, error);
    }
    *known = false;
    return true;
}

static bool run_keyword(struct oslo *oslo, struct error *error)
{
    const struct command_word *word = &oslo->commands.words[0];
    bool known;
    for (size_t i = 0; i < sizeof keywords / sizeof keywords[0]; i++) {
        if (!word->is_quoted && text_same(word->text, keywords[i].name)) {
            return keywords[i].run(oslo, keywords[i].what, error);
        }
    }
    if (!run_numbered(oslo, word->text, &known, error) ||
        (!known && !oslo_special(oslo, &known, error))) {
        return false;
    }
    if (known) {
        return true;
    }
    const struct word_group *group = word_group_of(oslo_words, NULL, word->text);
    return group == NULL ? commands_lose(&oslo->commands, LOSS_OF_RAYS, NULL, "an unknown command")
                         : group->fate == WORD_HARMLESS || oslo_read_lose(oslo, group, error);
}

/* Behind END stand blocks and single commands. */
static bool run_behind(struct oslo *oslo, struct error *error)
{
    const struct text word = oslo->commands.words[0].text;
    const struct word_group *group = word_group_of(oslo_words, NULL, word);
    bool is_here = false;
    if (oslo_enter(oslo, word) || oslo->block == OSLO_PASSED_OVER ||
        (group != NULL && group->fate == WORD_HARMLESS)) {
        return true;
    }
    if (oslo->block == OSLO_POINTS && text_same(word, "R")) {
        return true; /* a ray to be traced by operands */
    }
    if (oslo->block == OSLO_POINTS && text_same(word, "F")) {
        return oslo_point(oslo, 0, error);
    }
    if (oslo->block == OSLO_CONFIGURATIONS) {
        return oslo_place(oslo, &is_here, error) && (!is_here || run_keyword(oslo, error));
    }
    return commands_lose(&oslo->commands, LOSS_OF_RAYS, NULL,
                         "a command behind END: further data of the lens");
}

/* END, or that of a block, is the last command; before it the image has no glass. */
static bool oslo_read_check_end(struct oslo *oslo, struct error *error)
{
    const size_t image = oslo->sequence.count - 1;
    const struct sequence_surface *last = &oslo->sequence.surfaces[image];
    if (oslo->has_ended) {
        if (oslo->block != OSLO_NO_BLOCK) {
            foreign_cut_short(oslo->job, "no END stands behind its last block");
        }
        return true;
    }
    foreign_cut_short(oslo->job, "no END stands behind its surfaces");
    return (medium_is_air(&last->medium) && !last->reflects) ||
           commands_fail(&oslo->commands, &last->at, error,
                         "the file ends inside surface %zu: it was cut short", image);
}

static bool oslo_read_run_command(struct oslo *oslo, struct error *error)
{
    const struct command_word *word = &oslo->commands.words[0];
    if (!oslo->has_begun && !text_same(word->text, "LEN")) {
        return commands_fail(&oslo->commands, word, error, "the file does not begin with LEN NEW");
    }
    return oslo->has_ended ? run_behind(oslo, error) : run_keyword(oslo, error);
}

/* The unit may stand behind lengths, the configurations stand behind END. */
static bool oslo_read_ahead(struct oslo *oslo, struct text content, struct error *error)
{
    commands_open(&oslo->commands, oslo->job, content, &grammar);
    while (commands_next(&oslo->commands, error)) {
        if (text_same(oslo->commands.words[0].text, "UNI") && !oslo_unit(oslo, error)) {
            return false;
        }
        if (!oslo_count_positions(oslo, error)) {
            return false;
        }
    }
    return error->code == ERROR_NONE;
}

/* The lens of the present configuration. */
static bool oslo_read_position(void *state, size_t position, struct text content, struct lens *lens,
                               struct error *error)
{
    struct oslo *oslo = state;
    struct foreign_job *job = oslo->job;
    const struct number_scale scale = oslo->commands.scale;
    const char *unit = oslo->build.lens->unit;
    oslo->position = position;
    lens_build_begin(&oslo->build, lens, job->arena);
    lens->unit = unit;
    oslo->has_ended = false;
    oslo->specials = NULL;
    oslo->special_count = oslo->special_room = 0;
    oslo->block = OSLO_NO_BLOCK;
    oslo_kept_glasses(oslo, content);
    commands_open(&oslo->commands, job, content, &grammar);
    oslo->commands.scale = scale;
    oslo->sequence = (struct sequence){.job = job,
                                       .commands = &oslo->commands,
                                       .build = &oslo->build,
                                       .has_positions = oslo->positions > 0,
                                       .environment = {.temperature = 20, .pressure = 1}};
    struct command_word start = {{content.start, 0}, {content.start, 0}, 1, false};
    struct sequence_surface *object = sequence_add(&oslo->sequence, start);
    object->thickness = figure_computed(pair_of(1e20), scale, job->arena); /* if none is given */
    while (commands_next(&oslo->commands, error)) {
        if (!oslo_read_run_command(oslo, error)) {
            return false;
        }
    }
    if (error->code != ERROR_NONE) {
        return false;
    }
    if (!oslo_read_check_end(oslo, error)) {
        return false;
    }
    if (!oslo->has_stop && oslo->sequence.count > 2) { /* OSLO's stop, where none is named */
        oslo->sequence.surfaces[1].is_stop = true;
    }
    oslo_check_solves(oslo);
    oslo_put_apertures(oslo);
    oslo_finish_system(oslo);
    if (!oslo_keep_notes(oslo, content, error) || !sequence_finish(&oslo->sequence, error)) {
        return false;
    }
    oslo_finish_aperture(oslo);
    return true;
}

/* A file with configurations is read once for each of them. */
static bool oslo_read(struct foreign_job *job, struct text content, struct lens *lens,
                      struct error *error)
{
    struct oslo *first = ARENA_NEW(job->arena, struct oslo);
    first->job = job;
    lens_build_begin(&first->build, lens, job->arena);
    if (!oslo_read_ahead(first, content, error)) {
        return false;
    }
    const struct merge_file file = {content, NULL,          first->positions,
                                    first,   sizeof *first, oslo_read_position};
    return merge_read(&first->build, job, &file, error);
}

/* Some line begins with LEN NEW. */
static bool oslo_is_like(struct text content)
{
    for (struct text rest = content; rest.start != NULL;) {
        struct text line = text_trim(text_cut(&rest, '\n')), word = text_cut(&line, ' ');
        struct text next = line.start != NULL ? text_trim(line) : line,
                    second = text_cut(&next, ' ');
        if (text_same(word, "LEN") && text_same(second, "NEW")) {
            return true;
        }
    }
    return false;
}

const struct foreign_format oslo_format = {.type = {{"len", "OSLO"}, ".len"},
                                           .is_like = oslo_is_like,
                                           .read = oslo_read,
                                           .write = oslo_write,
                                           .has_apertures = true,
                                           .has_glass_numbers = true,
                                           .words = oslo_words};
