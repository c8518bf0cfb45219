/* exchange/oslo/oslo_read.c - read an OSLO lens file. */
/* SPDX-License-Identifier: MIT */
#include "exchange/merge_positions.h"
#include "exchange/oslo/oslo.h"
#include "exchange/sequence.h"

#include <math.h>
#include <string.h>

static const struct command_grammar grammar = {
    .comment = "//", .quotes = "\"", .separator = ';', .continuation = '\0', .infinity = 1e8};

/* The surface being read. */
static struct sequence_surface *oslo_present_surface(struct oslo *oslo)
{
    return &oslo->sequence.surfaces[oslo->surface];
}

/* The one value behind the command's name. */
static bool oslo_value(struct oslo *oslo, bool is_length, const char *what, struct figure *figure)
{
    return commands_value(&oslo->commands, 1, is_length, what, figure);
}

static bool oslo_begin(struct oslo *oslo)
{
    const struct command_word mode = commands_word(&oslo->commands, 1);
    const struct text title = commands_word(&oslo->commands, 2).text;
    if (!text_same(mode.text, "NEW")) {
        return commands_fail(&oslo->commands, &mode, "a lens begins with LEN NEW");
    }
    if (oslo->has_begun) {
        return commands_fail(&oslo->commands, &oslo->commands.words[0],
                             "a second lens in the file");
    }
    oslo->has_begun = true;
    if (title.length > 0) {
        oslo->build.lens->title = lens_build_string(&oslo->build, title);
    }
    return true;
}

/* EBR (radius of the beam), NAO, FNO */
static bool oslo_beam(struct oslo *oslo)
{
    const bool is_radius = oslo->what == APERTURE_EPD;
    struct lens *lens = oslo->build.lens;
    struct figure figure;
    if (!oslo_value(oslo, is_radius, "aperture", &figure)) {
        return false;
    }
    if (!(figure.value.hi > 0)) {
        return commands_fail(&oslo->commands, &oslo->commands.words[1],
                             "the aperture must be above 0");
    }
    lens->aperture_kind = (enum aperture_kind)oslo->what;
    lens->aperture = is_radius ? sequence_diameter(&figure, oslo->job->arena) : figure;
    oslo->aperture = oslo->commands.words[0];
    return true;
}

/* ANG, OBH, GIH: the field's edge; what it means depends on the object, so it is kept. */
static bool oslo_field_edge(struct oslo *oslo)
{
    const int what = oslo->what;
    oslo->field_is = (enum oslo_field)what;
    oslo->field_at = oslo->commands.words[0];
    return oslo_value(oslo, what != OSLO_ANGLE, "field", &oslo->field) &&
           (what != OSLO_ANGLE || fabs(oslo->field.value.hi) <= 180 ||
            commands_fail(&oslo->commands, &oslo->commands.words[1],
                          "a field angle is not beyond 180 degrees"));
}

static bool oslo_note(struct oslo *oslo)
{
    const struct text note = commands_word(&oslo->commands, 1).text;
    if (note.length > 0) {
        lens_build_note(&oslo->build, note);
    }
    return true;
}

static bool oslo_next_surface(struct oslo *oslo)
{
    const struct command_word at = oslo->commands.words[0];
    if (oslo->sequence.count == FOREIGN_MOST_SURFACES) {
        return commands_fail(&oslo->commands, &at, "more than %d surfaces", LENS_MOST_SURFACES);
    }
    oslo->surface = oslo->sequence.count;
    sequence_add(&oslo->sequence, at);
    return true;
}

/* AIR, RFL, RFH and the glass are the last that was said. */
static bool oslo_medium(struct oslo *oslo)
{
    struct sequence_surface *surface = oslo_present_surface(oslo);
    surface->reflects = oslo->what != 0;
    surface->medium = medium_air;
    surface->glass = (struct command_word){{"", 0}, {"", 0}, 0, false};
    return commands_end(&oslo->commands, 1);
}

static bool oslo_curve(struct oslo *oslo)
{
    const int what = oslo->what;
    struct sequence_surface *surface = oslo_present_surface(oslo);
    surface->is_radius = what == 0;
    if (!oslo_value(oslo, what == 0, what == 0 ? "radius" : "curvature", &surface->curve)) {
        return false;
    }
    if (what != 0) {
        sequence_per_length(&oslo->commands, 1, &surface->curve);
    }
    return true;
}

static bool oslo_thickness(struct oslo *oslo)
{
    if (oslo->surface == 0) {
        return commands_object(&oslo->commands, 1, &oslo_present_surface(oslo)->thickness) &&
               commands_end(&oslo->commands, 2);
    }
    return oslo_value(oslo, true, "thickness", &oslo_present_surface(oslo)->thickness);
}

/* AP 5, AP CHK 5; an aperture of the size of the sky is none. */
static bool oslo_diameter(struct oslo *oslo)
{
    const struct command_word word = commands_word(&oslo->commands, 1);
    size_t at =
        text_same(word.text, "CHK") || text_same(word.text, "UNC") || text_same(word.text, "NOT")
            ? 2
            : 1;
    struct figure radius;
    if (!commands_value(&oslo->commands, at, true, "radius of the aperture", &radius)) {
        return false;
    }
    if (!(radius.value.hi >= 0)) {
        return commands_fail(&oslo->commands, &oslo->commands.words[at],
                             "the radius of an aperture is not below 0");
    }
    if (oslo->surface > 0) {
        oslo_present_surface(oslo)->diameter = sequence_diameter(&radius, oslo->job->arena);
    }
    return true;
}

static bool oslo_stop(struct oslo *oslo)
{
    for (size_t i = 0; i < oslo->sequence.count; i++) {
        oslo->sequence.surfaces[i].is_stop = i == oslo->surface;
    }
    oslo->has_stop = true;
    return commands_end(&oslo->commands, 1);
}

static bool oslo_constant(struct oslo *oslo)
{
    return sequence_read_constant(&oslo->sequence, 1, oslo_present_surface(oslo), oslo->what);
}

/* ASP ASR: even powers of r; ASP ARA: all. */
static bool oslo_asphere(struct oslo *oslo)
{
    const struct command_word word = commands_word(&oslo->commands, 1);
    oslo->asphere_step = 2 * text_same(word.text, "ASR") + text_same(word.text, "ARA");
    return oslo->asphere_step > 0 || text_same(word.text, "ADO") ||
           commands_lose(&oslo->commands, LOSS_OF_RAYS, NULL,
                         "an asphere that is not a polynomial of r");
}

/* AS1 is the coefficient of r^2, AS2 of r^4 .. of ASP ASR; of r, r^2 .. of ASP ARA. */
static bool oslo_general_term(struct oslo *oslo)
{
    const struct command_word *word = &oslo->commands.words[0];
    const struct text digits = {word->text.start + 2, word->text.length - 2};
    struct figure figure;
    size_t index;
    if (!commands_count(&oslo->commands, word, digits, "number of the coefficient", 0, &index) ||
        !oslo_value(oslo, false, "coefficient", &figure)) {
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
    sequence_set_constant(&oslo->sequence, oslo_present_surface(oslo), order, figure);
    return true;
}

static bool oslo_shift(struct oslo *oslo)
{
    return sequence_read_shift(&oslo->sequence, 1, oslo_present_surface(oslo), oslo->what);
}

/* DT 1: first shifted, then turned. DT -1 is the same where there is one shift or turn alone. */
static bool oslo_order(struct oslo *oslo)
{
    struct figure figure;
    if (!oslo_value(oslo, false, "order of shift and turn", &figure)) {
        return false;
    }
    oslo_present_surface(oslo)->turns_first = figure.value.hi < 0;
    return true;
}

static bool oslo_move(struct oslo *oslo)
{
    struct sequence_surface *surface = oslo_present_surface(oslo);
    const struct command_word word = commands_word(&oslo->commands, 1);
    size_t to = oslo->surface;
    if (word.text.length > 0 &&
        !commands_count(&oslo->commands, &word, word.text, "number of the surface", 0, &to)) {
        return false;
    }
    surface->move = (enum sequence_move)oslo->what;
    surface->decentred_at = oslo->commands.words[0];
    bool is_own = to == oslo->surface || to == 0; /* RCO 0: its own */
    return is_own || oslo->what != SEQUENCE_BACK ||
           commands_lose(&oslo->commands, LOSS_OF_RAYS, NULL, "coordinates of another surface");
}

enum { SOLVE_OF_CHIEF = 1, SOLVE_OF_ANGLE = 2 };

/* PY, PYC: the height of a ray; PU, PUC: its angle. */
static bool oslo_solve(struct oslo *oslo)
{
    struct sequence_surface *surface = oslo_present_surface(oslo);
    const bool of_angle = (oslo->what & SOLVE_OF_ANGLE) != 0;
    struct sequence_solve *solve = of_angle ? &surface->curvature_solve : &surface->thickness_solve;
    *solve = (struct sequence_solve){.is_set = true,
                                     .of_angle = of_angle,
                                     .ray = (oslo->what & SOLVE_OF_CHIEF) != 0 ? SOLVE_CHIEF
                                                                               : SOLVE_MARGINAL,
                                     .at = oslo->commands.words[0]};
    return oslo_value(oslo, !of_angle, "target of the solve", &solve->target);
}

/* Angles of incidence and aplanatic: curvatures; contact at the edge: a thickness. */
static bool oslo_other_solve(struct oslo *oslo)
{
    struct sequence_surface *surface = oslo_present_surface(oslo);
    struct sequence_solve *solve =
        oslo->what ? &surface->thickness_solve : &surface->curvature_solve;
    *solve =
        (struct sequence_solve){.is_set = true, .is_unknown = true, .at = oslo->commands.words[0]};
    return true;
}

static bool oslo_end(struct oslo *oslo)
{
    oslo->has_ended = true;
    return true;
}

/* A command that is lost by its group, but where its only number is 0. */
static bool oslo_lose(struct oslo *oslo, const struct word_group *group)
{
    struct figure figure;
    bool checked = (group->flags & WORD_COUNTS_AT_0) == 0;
    if (checked && !oslo_value(oslo, false, "value", &figure)) {
        return false;
    }
    return (checked && figure.value.hi == 0) ||
           commands_lose(&oslo->commands, word_group_effect(group), NULL, group->what);
}

/* TEM in C, PRE in atmospheres. */
static bool oslo_environment(struct oslo *oslo)
{
    return sequence_environment(&oslo->sequence, oslo->what == 'T', 1);
}

struct oslo_keyword {
    const char *name;
    oslo_command *run; /* null: nothing becomes of it */
    int what;
};

static const struct oslo_keyword keywords[] = {
    {"LEN", oslo_begin, 0},
    {"EBR", oslo_beam, APERTURE_EPD},
    {"NAO", oslo_beam, APERTURE_NA},
    {"FNO", oslo_beam, APERTURE_FNUMBER},
    {"FNB", oslo_beam, APERTURE_FNUMBER},
    {"ANG", oslo_field_edge, OSLO_ANGLE},
    {"OBH", oslo_field_edge, OSLO_OBJECT},
    {"GIH", oslo_field_edge, OSLO_IMAGE},
    {"UNI", NULL, 0}, /* read before all others */
    {"NXT", oslo_next_surface, 0},
    {"SEF", oslo_next_surface, 0}, /* of old files */
    {"AIR", oslo_medium, 0},
    {"AIF", oslo_medium, 0},
    {"RFL", oslo_medium, 1},
    {"RFH", oslo_medium, 1},
    {"GLA", oslo_glass, 0},
    {"GLF", oslo_glass, 0},
    {"RD", oslo_curve, 0},
    {"RDF", oslo_curve, 0},
    {"CV", oslo_curve, 1},
    {"CVF", oslo_curve, 1},
    {"TH", oslo_thickness, 0},
    {"THF", oslo_thickness, 0},
    {"AP", oslo_diameter, 0},
    {"APF", oslo_diameter, 0},
    {"AST", oslo_stop, 0},
    {"CC", oslo_constant, 0},
    {"AD", oslo_constant, 4},
    {"AE", oslo_constant, 6},
    {"AF", oslo_constant, 8},
    {"AG", oslo_constant, 10},
    {"ASP", oslo_asphere, 0},
    {"DCX", oslo_shift, 'X'},
    {"DCY", oslo_shift, 'Y'},
    {"DCZ", oslo_shift, 'Z'},
    {"TLA", oslo_shift, 'A'},
    {"TLB", oslo_shift, 'B'},
    {"TLC", oslo_shift, 'C'},
    {"DT", oslo_order, 0},
    {"BEN", oslo_move, SEQUENCE_BEND},
    {"RCO", oslo_move, SEQUENCE_BACK},
    {"PY", oslo_solve, 0},
    {"PYC", oslo_solve, SOLVE_OF_CHIEF},
    {"PU", oslo_solve, SOLVE_OF_ANGLE},
    {"PUC", oslo_solve, SOLVE_OF_ANGLE | SOLVE_OF_CHIEF},
    {"PI", oslo_other_solve, 0},
    {"PIC", oslo_other_solve, 0},
    {"APA", oslo_other_solve, 0},
    {"EC", oslo_other_solve, 1},
    {"PK", oslo_pickup, 0},
    {"APN", NULL, 0},
    {"ATP", oslo_special_number, OSLO_TYPE},
    {"AAC", oslo_special_number, OSLO_ACTION},
    {"AGN", oslo_special_number, OSLO_GROUP},
    {"AAN", oslo_special_number, OSLO_TURN},
    {"AX1", oslo_special_edge, 0},
    {"AX2", oslo_special_edge, 1},
    {"AY1", oslo_special_edge, 2},
    {"AY2", oslo_special_edge, 3},
    {"AVX1", oslo_special_edge, OSLO_CORNERS},
    {"AVY1", oslo_special_edge, OSLO_CORNERS + 1},
    {"AVX2", oslo_special_edge, OSLO_CORNERS + 2},
    {"AVY2", oslo_special_edge, OSLO_CORNERS + 3},
    {"AVX3", oslo_special_edge, OSLO_CORNERS + 4},
    {"AVY3", oslo_special_edge, OSLO_CORNERS + 5},
    {"AVX4", oslo_special_edge, OSLO_CORNERS + 6},
    {"AVY4", oslo_special_edge, OSLO_CORNERS + 7},
    {"APK", oslo_special_pickup, 0},
    {"WV", oslo_waves, 0},
    {"WW", oslo_waves, 1},
    {"END", oslo_end, 0},
    {"F", oslo_point, 0},
    {"TEM", oslo_environment, 'T'},
    {"PRE", oslo_environment, 'P'},
    {"TELE", oslo_telecentric, 0},
    {"AMO", oslo_mode, 0},
};

/* Those with a number behind them: WV2, SNO1. */
static const struct oslo_keyword numbered[] = {{"WV", oslo_one_wave, 0},
                                               {"WW", oslo_one_wave, 1},
                                               {"AS", oslo_general_term, 0},
                                               {"SNO", oslo_note, 0}};

static const struct oslo_keyword *oslo_keyword_of(struct text name)
{
    for (size_t i = 0; i < sizeof keywords / sizeof keywords[0]; i++) {
        if (text_same(name, keywords[i].name)) {
            return &keywords[i];
        }
    }
    for (size_t i = 0; i < sizeof numbered / sizeof numbered[0]; i++) {
        const struct text first = {name.start, strlen(numbered[i].name)};
        if (name.length > first.length && char_is_digit(name.start[name.length - 1]) &&
            text_same(first, numbered[i].name)) {
            return &numbered[i];
        }
    }
    return NULL;
}

static bool oslo_run_command(struct oslo *oslo)
{
    const struct command_word *word = &oslo->commands.words[0];
    if (word->is_quoted) {
        return commands_lose(&oslo->commands, LOSS_OF_RAYS, NULL,
                             "text where a command is expected");
    }
    const struct oslo_keyword *keyword = oslo_keyword_of(word->text);
    if (keyword != NULL) {
        oslo->what = keyword->what;
        return keyword->run == NULL || keyword->run(oslo);
    }
    const struct word_group *group = word_group_of(oslo_words, NULL, word->text);
    return group == NULL ? commands_lose(&oslo->commands, LOSS_OF_RAYS, NULL, "an unknown command")
                         : group->fate == WORD_HARMLESS || oslo_lose(oslo, group);
}

/* Behind END stand blocks and single commands. */
static bool oslo_run_behind_end(struct oslo *oslo)
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
        return oslo_point(oslo);
    }
    if (oslo->block == OSLO_CONFIGURATIONS) {
        return oslo_place(oslo, &is_here) && (!is_here || oslo_run_command(oslo));
    }
    return commands_lose(&oslo->commands, LOSS_OF_RAYS, NULL,
                         "a command behind END: further data of the lens");
}

/* END, or that of a block, is the last command; before it the image has no glass. */
static bool oslo_check_end(struct oslo *oslo)
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
           commands_fail(&oslo->commands, &last->at,
                         "the file ends inside surface %zu: it was cut short", image);
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
    commands_open(&oslo->commands, job, content, &grammar, error);
    oslo->commands.scale = scale;
    oslo->sequence = (struct sequence){.job = job,
                                       .commands = &oslo->commands,
                                       .build = &oslo->build,
                                       .has_positions = oslo->positions > 0,
                                       .environment = {.temperature = 20, .pressure = 1}};
    struct command_word start = {{content.start, 0}, {content.start, 0}, 1, false};
    sequence_add(&oslo->sequence, start)->thickness =
        figure_computed(pair_of(1e20), scale, job->arena); /* if none is given */
    while (commands_next(&oslo->commands)) {
        const struct command_word *word = &oslo->commands.words[0];
        if (!oslo->has_begun && !text_same(word->text, "LEN")) {
            return commands_fail(&oslo->commands, word, "the file does not begin with LEN NEW");
        }
        if (!(oslo->has_ended ? oslo_run_behind_end(oslo) : oslo_run_command(oslo))) {
            return false;
        }
    }
    if (error->code != ERROR_NONE || !oslo_check_end(oslo)) {
        return false;
    }
    if (!oslo->has_stop && oslo->sequence.count > 2) { /* OSLO's stop, where none is named */
        oslo->sequence.surfaces[1].is_stop = true;
    }
    oslo_check_solves(oslo);
    oslo_put_apertures(oslo);
    oslo_finish_system(oslo);
    if (!oslo_keep_notes(oslo, content) || !sequence_finish(&oslo->sequence)) {
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
    commands_open(&first->commands, job, content, &grammar, error);
    while (commands_next(&first->commands)) { /* the unit stands anywhere, CFG behind END */
        if ((text_same(first->commands.words[0].text, "UNI") && !oslo_unit(first)) ||
            !oslo_count_positions(first)) {
            return false;
        }
    }
    if (error->code != ERROR_NONE) {
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
