/* exchange/codev/codev_surface.c - the surfaces of a CODE V file, and their apertures. */
/* SPDX-License-Identifier: MIT */
#include "exchange/codev/codev.h"

#include "base/constants.h"

#include <string.h>

/* The surface a command is about. */
static struct sequence_surface *codev_surface_here(struct codev *codev)
{
    return &codev->sequence.surfaces[codev->here.surface];
}

static void codev_set_curve(struct codev *codev, struct figure figure, bool is_radius)
{
    struct sequence_surface *surface = codev_surface_here(codev);
    surface->curve = figure;
    surface->is_radius = is_radius;
    if (!is_radius) {
        sequence_per_length(&codev->commands, 1, &surface->curve);
    }
}

/* REFL and REFR are no glasses; the rest is looked up in the end. */
static void codev_set_glass(struct codev *codev, const struct command_word *word)
{
    struct sequence_surface *surface = codev_surface_here(codev);
    if (!word->is_quoted && text_same(word->text, "REFL")) {
        surface->reflects = true;
    } else if (word->is_quoted || !text_same(word->text, "REFR")) {
        surface->glass = *word;
    }
}

/* SO must be the first and SI the last; a number after S must be that of the surface. */
static bool codev_check_surface(struct codev *codev)
{
    struct commands *commands = &codev->commands;
    const struct command_word *word = &commands->words[0];
    const struct text text = word->text;
    size_t next = codev->sequence.count, number = 0;
    bool is_object = text_same(text, "SO") || text_same(text, "S0");
    if (codev->has_image) {
        return commands_fail(commands, word, "a surface behind the image SI");
    }
    if (next == FOREIGN_MOST_SURFACES) {
        return commands_fail(commands, word, "more than %d surfaces", LENS_MOST_SURFACES);
    }
    if (is_object != (next == 0)) {
        return commands_fail(commands, word,
                             is_object ? "the object SO is not the first surface"
                                       : "a surface before the object SO");
    }
    codev->has_image = text_same(text, "SI");
    if (text.length == 1 || is_object || codev->has_image) {
        return true;
    }
    const struct text digits = {text.start + 1, text.length - 1};
    return commands_count(commands, word, digits, "number of the surface", 1, &number) &&
           (number == next ||
            commands_fail(commands, word, "surface %zu, where surface %zu is expected", number,
                          next));
}

bool codev_surface(struct codev *codev)
{
    struct commands *commands = &codev->commands;
    struct figure curve, thickness;
    if (!codev_check_surface(codev) ||
        !commands_figure(commands, 1, codev->radius_mode,
                         codev->radius_mode ? "radius" : "curvature", &curve) ||
        !(codev->sequence.count == 0
              ? commands_object(commands, 2, &thickness)
              : commands_figure(commands, 2, true, "thickness", &thickness))) {
        return false;
    }
    codev->here.surface = codev->surface = codev->sequence.count;
    sequence_add(&codev->sequence, commands->words[0])->thickness = thickness;
    codev_set_curve(codev, curve, codev->radius_mode);
    for (size_t i = 3; i < commands->count && i < 5; i++) {
        codev_set_glass(codev, &commands->words[i]);
    }
    return commands_end(commands, 5);
}

/* A solve behind the qualifiers: CUY UMY u, THI HMY h. */
static bool codev_solve(struct codev *codev, bool is_thickness, bool *is_solve)
{
    static const struct {
        const char *name;
        bool of_angle;
        enum solve_ray ray;
    } solves[] = {{"HMY", false, SOLVE_MARGINAL},
                  {"HCY", false, SOLVE_CHIEF},
                  {"UMY", true, SOLVE_MARGINAL},
                  {"UCY", true, SOLVE_CHIEF}};
    struct commands *commands = &codev->commands;
    const struct command_word word = commands_word(commands, codev->here.next);
    struct sequence_surface *surface = codev_surface_here(codev);
    char c = word.text.length > 0 ? word.text.start[0] : '0';
    *is_solve = (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z');
    if (!*is_solve) {
        return true;
    }
    struct sequence_solve *solve =
        is_thickness ? &surface->thickness_solve : &surface->curvature_solve;
    for (size_t i = 0; i < sizeof solves / sizeof solves[0]; i++) {
        if (!text_same(word.text, solves[i].name) || solves[i].of_angle == is_thickness) {
            continue;
        }
        *solve = (struct sequence_solve){
            .is_set = true, .of_angle = solves[i].of_angle, .ray = solves[i].ray, .at = word};
        return commands_value(commands, codev->here.next + 1, is_thickness, "target of the solve",
                              &solve->target);
    }
    *solve = (struct sequence_solve){.is_set = true, .is_unknown = true, .at = word};
    return true;
}

bool codev_curve(struct codev *codev)
{
    bool is_radius = (codev->what | 32) == 'r', is_x = codev->what >= 'a', is_solve = false;
    struct figure figure;
    if (!is_x && !codev_solve(codev, false, &is_solve)) {
        return false;
    }
    if (is_solve) {
        return true;
    }
    if (!commands_value(&codev->commands, codev->here.next, is_radius,
                        is_radius ? "radius" : "curvature", &figure)) {
        return false;
    }
    if (is_x) {
        /* A curvature in x: that of a cylinder, the other way. */
        struct sequence_surface *surface = codev_surface_here(codev);
        if (surface->curved == CURVED_BOTH) {
            commands_lose(&codev->commands, LOSS_OF_RAYS, NULL,
                          "a curvature in x of a surface that is no cylinder");
        } else if (figure.value.hi != 0 && surface->curved == CURVED_Y &&
                   sequence_is_some(&surface->curve)) {
            commands_lose(&codev->commands, LOSS_OF_RAYS, NULL,
                          "a surface that is curved in x and in y");
        } else if (figure.value.hi != 0) {
            surface->curved = CURVED_X;
            codev_set_curve(codev, figure, is_radius);
        }
    } else {
        codev_set_curve(codev, figure, is_radius);
    }
    return true;
}

bool codev_thickness(struct codev *codev)
{
    struct sequence_surface *surface = codev_surface_here(codev);
    bool is_solve;
    if (surface == &codev->sequence.surfaces[0]) {
        return commands_object(&codev->commands, codev->here.next, &surface->thickness) &&
               commands_end(&codev->commands, codev->here.next + 1);
    }
    return codev_solve(codev, true, &is_solve) &&
           (is_solve || commands_value(&codev->commands, codev->here.next, true, "thickness",
                                       &surface->thickness));
}

bool codev_glass(struct codev *codev)
{
    if (codev->here.next >= codev->commands.count) {
        const struct command_word word = commands_word(&codev->commands, codev->here.next);
        return commands_fail(&codev->commands, &word, "the glass is missing");
    }
    codev_set_glass(codev, &codev->commands.words[codev->here.next]);
    return commands_end(&codev->commands, codev->here.next + 1);
}

bool codev_shape(struct codev *codev)
{
    codev_surface_here(codev)->curved = CURVED_Y;
    return commands_end(&codev->commands, codev->here.next);
}

bool codev_constant(struct codev *codev)
{
    return sequence_read_constant(&codev->sequence, codev->here.next, codev_surface_here(codev),
                                  codev->what);
}

/* SPS ODD: a conic and powers of r, odd ones too; the number behind it is a normal radius. */
bool codev_special(struct codev *codev)
{
    const struct command_word kind = commands_word(&codev->commands, codev->here.next);
    struct figure radius = sequence_nothing;
    struct sequence_surface *surface = codev_surface_here(codev);
    surface->is_special = text_same(kind.text, "ODD");
    if (!surface->is_special) {
        return commands_lose(&codev->commands, LOSS_OF_POWER, NULL,
                             "a surface of a shape that lenscalc has not");
    }
    if (codev->here.next + 1 < codev->commands.count &&
        !commands_figure(&codev->commands, codev->here.next + 1, false, "radius", &radius)) {
        return false;
    }
    return radius.value.hi == 0 || radius.value.hi == 1 ||
           commands_lose(&codev->commands, LOSS_OF_RAYS, NULL, "a radius that r is divided by");
}

/* The order that ARn, or C(n + 1), of SPS ODD is of; 0 is the conic, -1 is neither. */
static int codev_special_order(struct text name)
{
    size_t letters = name.length > 1 && (name.start[1] | 32) == 'r' ? 2 : 1;
    const struct text letter = {name.start, letters};
    long number = 0;
    if (text_same(name, "K")) {
        return 0;
    }
    for (size_t i = letters; i < name.length; i++) {
        bool digit = name.start[i] >= '0' && name.start[i] <= '9' && number < 1000;
        number = digit ? 10 * number + (name.start[i] - '0') : 10000;
    }
    bool sound = number > 0 && number < 1000;
    if (sound && text_same(letter, "AR")) {
        return (int)number;
    }
    return sound && text_same(letter, "C") ? (int)number - 1 : -1;
}

bool codev_special_constant(struct codev *codev)
{
    struct figure figure;
    struct commands *commands = &codev->commands;
    struct sequence_surface *surface = codev_surface_here(codev);
    const struct command_word name = commands_word(commands, codev->here.next);
    int order = name.text.length > 0 ? codev_special_order(name.text) : -1;
    if (!commands_value(commands, codev->here.next + 1, false, "coefficient", &figure)) {
        return false;
    }
    bool is_known = surface->is_special && (order == 0 || surface_term(order) >= 0);
    if (!is_known) {
        return figure.value.hi == 0 || commands_lose(&codev->commands, LOSS_OF_RAYS, NULL,
                                                     "a constant of a shape that lenscalc has not");
    }
    sequence_set_constant(&codev->sequence, surface, order, figure);
    return true;
}

bool codev_stop(struct codev *codev)
{
    if (codev->here.surface == 0) {
        return commands_fail(&codev->commands, &codev->commands.words[0],
                             "the object cannot be the stop");
    }
    if (codev->here.surface != codev->here.end) {
        return commands_fail(&codev->commands, &codev->commands.words[0],
                             "one surface is the stop, not a range");
    }
    for (size_t i = 0; i < codev->sequence.count; i++) {
        codev->sequence.surfaces[i].is_stop = i == codev->here.surface;
    }
    return commands_end(&codev->commands, codev->here.next);
}

bool codev_label(struct codev *codev)
{
    const struct text label = commands_word(&codev->commands, codev->here.next).text;
    if (label.length > 0 && memchr(label.start, '"', label.length) == NULL) {
        codev_surface_here(codev)->name = lens_build_string(&codev->build, label);
    }
    return commands_end(&codev->commands, codev->here.next + 1);
}

bool codev_shift(struct codev *codev)
{
    return sequence_read_shift(&codev->sequence, codev->here.next, codev_surface_here(codev),
                               codev->what);
}

bool codev_move(struct codev *codev)
{
    struct sequence_surface *surface = codev_surface_here(codev);
    surface->move = (enum sequence_move)codev->what;
    surface->decentred_at = codev->commands.words[0];
    return commands_end(&codev->commands, codev->here.next);
}

/* What stands before the size of an aperture: CLR, EDG, OBS, HOL and a label. */
struct aperture_words {
    bool is_edge, blocks;
    struct text label;
    size_t next; /* the word with the size */
};

static struct aperture_words aperture_words(const struct codev *codev)
{
    const struct commands *commands = &codev->commands;
    struct aperture_words words = {.label = {"", 0}, .next = codev->here.next};
    for (; words.next < commands->count; words.next++) {
        const struct text word = commands->words[words.next].text;
        bool is_edge = text_same(word, "EDG");
        bool blocks = text_same(word, "OBS") || text_same(word, "HOL");
        bool is_label = word.length > 1 && (word.start[0] | 32) == 'l' &&
                        (word.start[1] == '\'' || word.start[1] == '"');
        if (!is_edge && !blocks && !is_label && !text_same(word, "CLR")) {
            break;
        }
        words.is_edge = words.is_edge || is_edge;
        words.blocks = words.blocks || blocks;
        words.label = is_label ? word : words.label;
    }
    return words;
}

/*
 * The aperture of these words, made if there is none.
 *
 * Given     shape  APERTURE_SHAPES: any, the last one
 */
static struct aperture *codev_find_aperture(struct codev *codev, const struct aperture_words *words,
                                            enum aperture_shape shape)
{
    struct sequence_surface *surface = codev_surface_here(codev);
    for (size_t i = surface->aperture_count; i-- > 0;) {
        struct sequence_aperture *one = &surface->apertures[i];
        bool suits = shape == APERTURE_SHAPES || one->aperture.shape == shape;
        if (suits && one->aperture.blocks == words->blocks &&
            text_identical(one->label, words->label)) {
            return &one->aperture;
        }
    }
    struct sequence_aperture *one = ARENA_ADD(codev->job->arena, surface->apertures,
                                              surface->aperture_count, surface->aperture_room);
    shape = shape == APERTURE_SHAPES ? SHAPE_CIRCLE : shape;
    *one = (struct sequence_aperture){.at = codev->commands.words[0],
                                      .label = words->label,
                                      .aperture = aperture_of(shape, words->blocks)};
    return &one->aperture;
}

bool codev_aperture(struct codev *codev)
{
    struct commands *commands = &codev->commands;
    struct figure half;
    const struct aperture_words words = aperture_words(codev);
    const bool is_clear_circle = codev->what == 'C' && !words.blocks;
    if (!commands_value(commands, words.next, true, "radius of the aperture", &half)) {
        return false;
    }
    if (!(half.value.hi >= 0)) {
        return commands_fail(commands, &commands->words[words.next],
                             "the radius of an aperture is not below 0");
    }
    if (words.is_edge || (half.value.hi == 0 && !is_clear_circle)) {
        return true; /* the rim of the glass, for drawings; none */
    }
    if (is_clear_circle) {
        codev_surface_here(codev)->diameter = sequence_diameter(&half, codev->job->arena);
        return true;
    }
    enum aperture_shape shape = SHAPE_CIRCLE;
    if (codev->what != 'C') {
        shape = codev->what < 'a' ? SHAPE_ELLIPSE : SHAPE_RECTANGLE;
    }
    codev_find_aperture(codev, &words, shape)->size[(codev->what | 32) == 'y'] =
        sequence_diameter(&half, codev->job->arena);
    return true;
}

bool codev_aperture_shift(struct codev *codev)
{
    struct commands *commands = &codev->commands;
    struct figure shift;
    const struct aperture_words words = aperture_words(codev);
    if (!commands_value(commands, words.next, true, "decentre of the aperture", &shift)) {
        return false;
    }
    if (shift.value.hi != 0 && !words.is_edge) {
        codev_find_aperture(codev, &words, APERTURE_SHAPES)->decenter[codev->what == 'Y'] = shift;
    }
    return true;
}
