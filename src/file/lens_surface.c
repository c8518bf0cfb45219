/* file/lens_surface.c - one surface line of a .lens file. */
/* SPDX-License-Identifier: MIT */
#include "file/lens_surface.h"

#include <string.h>

static const double radians = 0.017453292519943295;

enum { MOST_VARIES = 16 };

/* A surface being read: the displacement and the marks live in the arena once there is one. */
struct reading {
    struct lens_words *words;
    struct surface *surface;
    struct displacement *moved;
    struct vary *varies;
    lens_variable_function *variable;
    void *context;
};

static bool is_name(struct text text)
{
    char c = text.length > 0 ? text.start[0] : '\0';
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

static bool is_flat(struct text text)
{
    return text_equal(text, "-") || text_equal(text, "inf") || text_equal(text, "-inf");
}

static bool read_radius(struct lens_words *words, struct surface *surface, struct error *error)
{
    struct text word = lens_words_next(words);
    surface->is_plane = is_flat(word);
    surface->radius = (struct figure){.typed = word, .variable = LENS_NONE};
    if (surface->is_plane) {
        return true;
    }
    if (!lens_words_figure(words, word, words->scale, "radius", &surface->radius, error)) {
        return false;
    }
    if (surface->radius.value.hi == 0) {
        return lens_words_fail(words, word, error, "the radius is 0: a plane is '-' or 'inf'");
    }
    return true;
}

/* A length, or the name of a variable, or '-' for none. */
static bool read_cell(struct lens_words *words, const char *what, lens_variable_function *variable,
                      void *context, struct figure *figure, bool *is_given, struct error *error)
{
    struct text word = lens_words_next(words);
    *figure = (struct figure){.typed = word, .variable = LENS_NONE};
    *is_given = !text_equal(word, "-");
    if (!*is_given) {
        return true;
    }
    if (is_name(word) && !text_equal(word, "inf")) {
        figure->variable = variable(context, word);
        return true;
    }
    return lens_words_figure(words, word, words->scale, what, figure, error) ||
           (word.length == 0 &&
            error_hint(error, "a surface is: radius thickness medium diameter; '-' where there is "
                              "none"));
}

/* A curvature or a coefficient was read as a plain number. */
static bool rescale(const struct lens_words *words, int power, struct figure *figure)
{
    figure->value = lens_words_per_length(figure->value, words->scale, power);
    return true;
}

static bool read_curvature(struct reading *reading, struct text value, struct error *error)
{
    struct surface *surface = reading->surface;
    if (!surface->is_plane) {
        return lens_words_fail(reading->words, value, error,
                               "a curvature beside a radius: the radius must be '-'");
    }
    surface->has_curvature = true;
    return lens_words_figure(reading->words, value, NUMBER_UNSCALED, "curvature",
                             &surface->curvature, error) &&
           rescale(reading->words, 1, &surface->curvature);
}

static bool read_conic(struct reading *reading, struct text value, struct error *error)
{
    return lens_words_figure(reading->words, value, NUMBER_UNSCALED, "conic",
                             &reading->surface->conic, error);
}

static struct displacement *displacement_of(struct reading *reading)
{
    if (reading->moved == NULL) {
        reading->moved = ARENA_NEW(reading->words->arena, struct displacement);
        reading->surface->moved = reading->moved;
    }
    return reading->moved;
}

static bool read_decenter(struct reading *reading, struct text value, struct error *error)
{
    return lens_words_vector(reading->words, value, reading->words->scale, 1, "decentre",
                             displacement_of(reading)->decenter, 2, error);
}

static bool read_tilt(struct reading *reading, struct text value, struct error *error)
{
    return lens_words_vector(reading->words, value, NUMBER_UNSCALED, radians, "tilt",
                             displacement_of(reading)->tilt, 2, error);
}

static bool read_cylinder(struct reading *reading, struct text value, struct error *error)
{
    bool x = text_equal(value, "x");
    if (!x && !text_equal(value, "y")) {
        return lens_words_fail(reading->words, value, error, "a cylinder is cyl=x or cyl=y");
    }
    reading->surface->curved = x ? CURVED_X : CURVED_Y;
    return true;
}

static bool read_name(struct reading *reading, struct text value, struct error *error)
{
    bool quoted = value.length >= 2 && value.start[0] == '"';
    if (quoted && value.start[value.length - 1] != '"') {
        return lens_words_fail(reading->words, value, error, "the name does not end with '\"'");
    }
    size_t cut = quoted ? 1 : 0;
    reading->surface->name =
        arena_string(reading->words->arena, value.start + cut, value.length - 2 * cut);
    return true;
}

static bool read_hiatus(struct reading *reading, struct text value, struct error *error)
{
    struct surface *surface = reading->surface;
    if (is_name(value)) {
        surface->hiatus =
            (struct figure){.typed = value, .variable = reading->variable(reading->context, value)};
        return true;
    }
    return lens_words_figure(reading->words, value, reading->words->scale, "hiatus",
                             &surface->hiatus, error);
}

static bool read_distortion(struct reading *reading, struct text value, struct error *error)
{
    return lens_words_vector(reading->words, value, NUMBER_UNSCALED, 1, "distortion",
                             reading->surface->distortion, 3, error);
}

/* What may stand behind the diameter; of a thick lens only what is `thick`. */
static const struct {
    const char *key;
    bool (*read)(struct reading *reading, struct text value, struct error *error);
    enum { OF_SURFACE = 1, OF_THICK = 2 } of;
} extras[] = {{"c", read_curvature, OF_SURFACE},
              {"k", read_conic, OF_SURFACE},
              {"decenter", read_decenter, OF_SURFACE | OF_THICK},
              {"tilt", read_tilt, OF_SURFACE | OF_THICK},
              {"cyl", read_cylinder, OF_SURFACE},
              {"name", read_name, OF_SURFACE | OF_THICK},
              {"hiatus", read_hiatus, OF_THICK},
              {"distortion", read_distortion, OF_THICK}};

/* A2 .. A20: the index of the coefficient, -1 for other words. */
static int coefficient_of(struct text key)
{
    int order = 0;
    for (size_t i = 1; i < key.length && i < 3; i++) {
        order = key.start[i] >= '0' && key.start[i] <= '9' ? 10 * order + key.start[i] - '0' : 99;
    }
    bool sound = key.length >= 2 && key.length <= 3 && key.start[0] == 'A' && key.start[1] != '0';
    return sound && order % 2 == 0 && order >= 2 && order <= 20 ? order / 2 - 1 : -1;
}

static bool read_coefficient(struct reading *reading, int at, struct text value,
                             struct error *error)
{
    struct figure *figure = &reading->surface->coefficient[at];
    reading->surface->coefficients |= 1u << at;
    return lens_words_figure(reading->words, value, NUMBER_UNSCALED, "coefficient", figure,
                             error) &&
           rescale(reading->words, 2 * at + 1, figure);
}

/* R~, t~[2,10], glass~ */
static bool read_vary(struct reading *reading, struct text what, struct text bounds,
                      struct error *error)
{
    struct surface *surface = reading->surface;
    struct lens_words *words = reading->words;
    bool is_thick = surface->kind == SURFACE_THICK;
    bool known = is_thick ? text_equal(what, "f") || text_equal(what, "t")
                          : text_equal(what, "R") || text_equal(what, "t") ||
                                text_equal(what, "c") || text_equal(what, "k") ||
                                text_equal(what, "glass") || coefficient_of(what) >= 0;
    if (!known) {
        return lens_words_fail(words, what, error, "'%.*s~' cannot vary: R, c, t, k, A4 or glass",
                               (int)(what.length < 20 ? what.length : 20), what.start);
    }
    if (surface->vary_count == MOST_VARIES) {
        return lens_words_fail(words, what, error, "more than %d marks", MOST_VARIES);
    }
    if (reading->varies == NULL) {
        reading->varies = ARENA_ARRAY(words->arena, MOST_VARIES, struct vary);
        surface->varies = reading->varies;
    }
    struct vary *vary = &reading->varies[surface->vary_count++];
    *vary = (struct vary){.what = what};
    if (bounds.length == 0) {
        return true;
    }
    struct figure both[2] = {{.variable = LENS_NONE}, {.variable = LENS_NONE}};
    struct text inside = {bounds.start + 1, bounds.length >= 2 ? bounds.length - 2 : 0};
    if (bounds.start[0] != '[' || bounds.start[bounds.length - 1] != ']' ||
        memchr(bounds.start, ',', bounds.length) == NULL) {
        return lens_words_fail(words, bounds, error, "bounds are written [low,high]");
    }
    bool is_length = text_equal(what, "R") || text_equal(what, "t") || text_equal(what, "f");
    if (!lens_words_vector(words, inside, is_length ? words->scale : NUMBER_UNSCALED, 1, "bounds",
                           both, 2, error)) {
        return false;
    }
    vary->has_bounds = true;
    vary->low = both[0];
    vary->high = both[1];
    return true;
}

static bool read_extra(struct reading *reading, struct text word, struct error *error)
{
    struct lens_words *words = reading->words;
    struct text value = word, key = text_cut(&value, '=');
    const char *tilde = memchr(word.start, '~', word.length);
    if (value.start == NULL && text_equal(word, "stop")) {
        reading->surface->is_stop = true;
        return true;
    }
    if (tilde != NULL && (value.start == NULL || tilde < value.start)) {
        return read_vary(reading, text_between(word.start, tilde),
                         text_between(tilde + 1, word.start + word.length), error);
    }
    struct nearest nearest = {.typed = key};
    bool is_thick = reading->surface->kind == SURFACE_THICK;
    for (size_t i = 0; i < sizeof extras / sizeof extras[0]; i++) {
        if ((extras[i].of & (is_thick ? OF_THICK : OF_SURFACE)) == 0) {
            continue;
        }
        if (value.start != NULL && text_equal(key, extras[i].key)) {
            return extras[i].read(reading, value, error);
        }
        nearest_offer(&nearest, text_of(extras[i].key));
    }
    if (value.start != NULL && coefficient_of(key) >= 0 && !is_thick) {
        return read_coefficient(reading, coefficient_of(key), value, error);
    }
    lens_words_fail(words, word, error, "unknown word '%.*s' after the diameter",
                    (int)(word.length < 40 ? word.length : 40), word.start);
    if (nearest.best.start != NULL) {
        error_hint(error, "did you mean '%.*s='?", (int)nearest.best.length, nearest.best.start);
    }
    return false;
}

static bool read_medium(struct lens_words *words, const struct medium *before,
                        struct surface *surface, struct error *error)
{
    struct text word = lens_words_next(words);
    if (!text_equal(word, "mirror")) {
        return lens_words_medium(words, word, &surface->medium, error);
    }
    if (surface->kind == SURFACE_STOP || surface->kind == SURFACE_THICK) {
        return lens_words_fail(words, word, error,
                               surface->kind == SURFACE_STOP
                                   ? "a stop that is a mirror: write it as a surface "
                                     "with the word stop behind its diameter"
                                   : "a thick lens is no mirror");
    }
    surface->kind = SURFACE_REFLECT;
    surface->medium = *before;
    return true;
}

/* The cell in place of the radius: a number or a variable, not 0. */
static bool read_focal(struct lens_words *words, lens_variable_function *variable, void *context,
                       struct surface *surface, struct error *error)
{
    bool is_given;
    surface->is_plane = true;
    surface->radius = (struct figure){.variable = LENS_NONE};
    if (!read_cell(words, "focal length", variable, context, &surface->focal, &is_given, error)) {
        return false;
    }
    bool is_number = surface->focal.variable == LENS_NONE;
    return (is_given && !(is_number && surface->focal.value.hi == 0)) ||
           lens_words_fail(words, surface->focal.typed, error,
                           "a thick lens has a focal length other than 0");
}

bool lens_surface_read(struct lens_words *words, enum surface_kind kind,
                       const struct medium *before, lens_variable_function *variable, void *context,
                       struct surface *surface, struct error *error)
{
    struct reading reading = {words, surface, NULL, NULL, variable, context};
    bool is_stop = kind == SURFACE_STOP;
    *surface = (struct surface){.kind = kind, .is_stop = is_stop};
    surface->curvature.variable = surface->conic.variable = LENS_NONE;
    surface->focal.variable = surface->hiatus.variable = LENS_NONE;
    for (int i = 0; i < LENS_COEFFICIENTS; i++) {
        surface->coefficient[i].variable = LENS_NONE;
    }
    if (kind == SURFACE_THICK ? !read_focal(words, variable, context, surface, error)
                              : !read_radius(words, surface, error)) {
        return false;
    }
    if (is_stop && !surface->is_plane) {
        return lens_words_fail(words, surface->radius.typed, error,
                               "a stop is a plane: for a stop on glass put the word stop behind "
                               "the diameter of its surface");
    }
    if (!read_cell(words, "thickness", variable, context, &surface->thickness,
                   &surface->has_thickness, error) ||
        !read_medium(words, before, surface, error) ||
        !read_cell(words, "diameter", variable, context, &surface->diameter, &surface->has_diameter,
                   error)) {
        return false;
    }
    if (surface->has_diameter && surface->diameter.variable == LENS_NONE &&
        !(surface->diameter.value.hi > 0)) {
        return lens_words_fail(words, surface->diameter.typed, error,
                               "the diameter must be above 0");
    }
    for (struct text word = lens_words_next(words); word.length > 0;
         word = lens_words_next(words)) {
        if (!read_extra(&reading, word, error)) {
            return false;
        }
    }
    return true;
}

bool lens_bend_read(struct lens_words *words, const struct displacement **bend, struct error *error)
{
    struct displacement *all = ARENA_NEW(words->arena, struct displacement);
    for (struct text word = lens_words_next(words); word.length > 0;
         word = lens_words_next(words)) {
        struct text value = word, key = text_cut(&value, '=');
        bool decenter = text_equal(key, "decenter"), tilt = text_equal(key, "tilt");
        if (value.start == NULL || (!decenter && !tilt)) {
            return lens_words_fail(words, word, error, "a bend has decenter=x,y and tilt=ax,ay,az");
        }
        bool read = decenter ? lens_words_vector(words, value, words->scale, 1, "decentre",
                                                 all->decenter, 2, error)
                             : lens_words_vector(words, value, NUMBER_UNSCALED, radians, "tilt",
                                                 all->tilt, 3, error);
        if (!read) {
            return false;
        }
    }
    *bend = all;
    return true;
}
