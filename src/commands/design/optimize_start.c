/* commands/design/optimize_start.c - optimize --start: lenses from nothing, to search from. */
/* SPDX-License-Identifier: MIT */
#include "base/choice.h"
#include "base/constants.h"
#include "base/quantity.h"
#include "commands/design/optimize_job.h"
#include "design/predesign.h"
#include "file/lens_file.h"
#include "optics/growing.h"

#include <math.h>
#include <string.h>

/* -------- what is asked -------- */

/* The words of --start, mm and rad; NaN: not given. */
struct start_words {
    double elements, efl, fnumber, field, image, object, stop, bfl, track;
};

struct optimize_start {
    struct start_words words;
    struct predesign_wish wish; /* in focal lengths */
    size_t stops[PREDESIGN_MOST + 1];
    size_t layouts;
    const char *title, *head;             /* lines of the lens file before its surfaces */
    double center[2], gap[2], bend, back; /* bounds, mm and 1/mm */
};

/* A word, and the values that it may have; of lengths without a limit of its own any above 0. */
struct start_word {
    const char *name;
    const struct dimension *dimension;
    const char *unit; /* of a bare number; null: none */
    size_t offset;
    double low, high;
    bool is_whole;
};

#define START_WORD(member) #member, .offset = offsetof(struct start_words, member)
static const double steepest = 75 * RADIANS_PER_DEGREE, longest = 1e6;
static const struct start_word start_words[] = {
    {START_WORD(elements), .dimension = &dimension_number, .low = 1, .high = PREDESIGN_MOST,
     .is_whole = true},
    {START_WORD(efl), .dimension = &dimension_length, .unit = "mm", .low = 0.01, .high = longest},
    {START_WORD(fnumber), .dimension = &dimension_fnumber, .low = 0.5, .high = 1000},
    {START_WORD(field), .dimension = &dimension_angle, .unit = "deg", .low = 0, .high = steepest},
    {START_WORD(image), .dimension = &dimension_length, .unit = "mm", .low = 0, .high = longest},
    {START_WORD(object), .dimension = &dimension_length, .unit = "mm", .low = 0.01,
     .high = INFINITY},
    {START_WORD(stop), .dimension = &dimension_number, .low = 0, .high = PREDESIGN_MOST,
     .is_whole = true},
    {START_WORD(bfl), .dimension = &dimension_length, .unit = "mm", .low = 0, .high = longest},
    {START_WORD(track), .dimension = &dimension_length, .unit = "mm", .low = 0.01, .high = longest},
};
enum { START_WORDS = sizeof start_words / sizeof start_words[0] };

static double *start_member(struct start_words *words, const struct start_word *word)
{
    return (double *)(void *)((char *)words + word->offset);
}

/* "0.5 to 1000", in the unit that a bare number has. */
static bool start_refuse_range(const struct start_word *word, double low, double high,
                               struct text item, struct error *error)
{
    const struct unit *unit =
        word->unit != NULL ? unit_find(word->dimension, text_of(word->unit)) : NULL;
    const char *called = word->unit != NULL ? word->unit : "";
    const double scale = unit != NULL ? unit_to_own(unit, 1) : 1;
    return fail(error, ERROR_USAGE, "{--start} '%.*s' is out of range: %s is %.4g%s to %.4g%s",
                text_shown(item), item.start, word->name, low / scale, called, high / scale,
                called);
}

static bool start_read_word(struct start_words *words, struct text item, struct error *error)
{
    struct text value = item;
    const struct text name = text_trim(text_cut(&value, '='));
    struct choice choice = {.typed = name};
    const struct start_word *word = NULL;
    for (size_t i = 0; i < START_WORDS; i++) {
        choice_offer(&choice, start_words[i].name);
        word = text_equal(name, start_words[i].name) ? &start_words[i] : word;
    }
    if (word == NULL) {
        choice_refuse(&choice, error);
        return error_prefix(error, "bad word in {--start}: ");
    }
    double *member = start_member(words, word), read;
    if (!isnan(*member)) {
        return fail(error, ERROR_USAGE, "{--start} has %s twice", word->name);
    }
    const struct unit *unit =
        word->unit != NULL ? unit_find(word->dimension, text_of(word->unit)) : NULL;
    if (!quantity_read(text_trim(value), word->dimension, unit, &read, NULL, error)) {
        return error_prefix(error, "bad %s in {--start}: ", word->name);
    }
    if (!(read >= word->low && read <= word->high)) {
        return start_refuse_range(word, word->low, word->high, text_trim(item), error);
    }
    if (word->is_whole && read != floor(read)) {
        return fail(error, ERROR_USAGE, "{--start} '%.*s': %s is a whole number", text_shown(item),
                    item.start, word->name);
    }
    *member = read;
    return true;
}

/* Image distance of a thin lens, mm. */
static double start_image_distance(const struct start_words *words)
{
    return isinf(words->object) ? words->efl
                                : words->efl * words->object / (words->object - words->efl);
}

/* What does not go together, or lacks. */
static bool start_check(const struct start_words *words, struct error *error)
{
    static const char *const needed[] = {"elements", "efl", "fnumber"};
    const double values[] = {words->elements, words->efl, words->fnumber};
    for (size_t i = 0; i < sizeof needed / sizeof needed[0]; i++) {
        if (isnan(values[i])) {
            fail(error, ERROR_USAGE, "{--start} lacks %s", needed[i]);
            return error_hint(error, "elements=5,efl=50mm,fnumber=2,field=22deg");
        }
    }
    const double f = words->efl, distance = start_image_distance(words);
    if (isnan(words->field) && isnan(words->image)) {
        return fail(error, ERROR_USAGE,
                    "{--start} lacks field, or image, the diameter of the "
                    "image circle");
    }
    if (!isnan(words->field) && !isnan(words->image)) {
        fail(error, ERROR_USAGE,
             "{--start} has field and image, of which one follows from the "
             "other");
        return error_hint(error, "a field of %.4gdeg and efl=%.4gmm are an image circle of %.4gmm",
                          words->field / RADIANS_PER_DEGREE, f, 2 * f * tan(words->field));
    }
    if (words->object <= f) {
        return fail(error, ERROR_USAGE,
                    "{--start} object=%.4gmm lies within the focal length "
                    "%.4g mm: no real image",
                    words->object, f);
    }
    if (isfinite(words->object) && !isnan(words->field)) {
        return fail(error, ERROR_USAGE,
                    "{--start} has the field of a far object and a near "
                    "object: image gives the image circle");
    }
    const double widest = 2 * distance * tan(steepest);
    if (words->image > widest) {
        return fail(error, ERROR_USAGE,
                    "{--start} image=%.4gmm is out of range: with efl=%.4gmm "
                    "it is 0 to %.4gmm",
                    words->image, f, widest);
    }
    if (words->stop > words->elements) {
        return fail(error, ERROR_USAGE,
                    "{--start} stop=%.0f is out of range: it lies behind 0 to "
                    "%.0f elements",
                    words->stop, words->elements);
    }
    const double shortest = 0.2 * distance, most = 20 * distance;
    if (words->track < shortest || words->track > most) {
        return fail(error, ERROR_USAGE,
                    "{--start} track=%.4gmm is out of range: with efl=%.4gmm "
                    "it is %.4gmm to %.4gmm",
                    words->track, f, shortest, most);
    }
    const double room = isnan(words->track) ? most : words->track;
    return !(words->bfl >= 0.95 * room) ||
           fail(error, ERROR_USAGE,
                "{--start} bfl=%.4gmm is out of range: with a track of %.4g mm "
                "it is less than %.4gmm",
                words->bfl, room, 0.95 * room);
}

/* Two digits of it, as a designer writes a bound. */
static double start_rounded(double value)
{
    const double step = pow(10, floor(log10(value)) - 1);
    return round(value / step) * step;
}

/* -------- how many -------- */

enum { USUAL_STARTS = 100, USUAL_KEPT = 10 /* of --start */ };

size_t optimize_start_count(const struct optimize_input *input)
{
    if (input->global > 0 || input->start == NULL) {
        return (size_t)input->global;
    }
    return isnan(input->seconds) ? USUAL_STARTS : OPTIMIZE_MOST_STARTS;
}

size_t optimize_keep_count(const void *data)
{
    const struct optimize_input *input = data;
    if (input->keep > 0) {
        return (size_t)input->keep;
    }
    if (input->start == NULL) {
        return 1;
    }
    const size_t starts = optimize_start_count(input);
    return starts < USUAL_KEPT ? starts : USUAL_KEPT;
}

/* -------- a lens file -------- */

static void start_put_wavelengths(const struct optimize_job *job, struct text_buffer *head)
{
    const struct spectrum_value *waves = &job->input->waves;
    growing_string(head, "wavelength ");
    for (size_t i = 0; i < waves->count; i++) {
        growing_format(head, " %.10gnm", waves->items[i].wavelength * 1000);
        if (waves->items[i].weight != 1) {
            growing_format(head, ":%.10g", waves->items[i].weight);
        }
    }
    growing_string(head, waves->count == 0 ? " d F C\n" : "\n");
}

/* Fields with larger tangents have one more between. */
static const double wide = 0.3;

/* Title, object, fields, aperture, goals. */
static const char *start_head(const struct optimize_job *job, const struct optimize_start *start)
{
    const struct start_words *words = &start->words;
    const struct predesign_wish *wish = &start->wish;
    struct text_buffer head = {.arena = job->run->arena};
    const double f = words->efl;
    const bool is_far = isinf(words->object);
    const double field = is_far ? atan(wish->field) / RADIANS_PER_DEGREE : words->image / 2;
    const char *goals = job->input->goals;
    growing_format(&head, "lens %.0f element%s, %.6g mm f/%.4g, %.4g %s\n", words->elements,
                   words->elements == 1 ? "" : "s", f, words->fnumber, field,
                   is_far ? "deg" : "mm image height");
    start_put_wavelengths(job, &head);
    if (!is_far) {
        growing_format(&head, "object %.9g\n", words->object);
    }
    growing_format(&head, "field %s 0", is_far ? "angle" : "image");
    if (field > 0) {
        if (wish->field > wide) {
            growing_format(&head, " %.4g", 0.4 * field);
        }
        growing_format(&head, " %.4g %.9g", 0.7 * field, field);
    }
    growing_format(&head, "\naperture f/%.9g\nfocus table\n", words->fnumber);
    if (goals != NULL) {
        growing_format(&head, "goal %s\n", goals);
        return growing_done(&head).start;
    }
    growing_format(&head, "goal poly, efl = %.9g : %.2g, bfl > %.6g, track < %.6g\n", f, f / 200,
                   start->back, wish->track * f);
    growing_format(&head, "goal center > %.6g, edge > %.6g\n", start->center[0],
                   start_rounded(0.6 * start->center[0]));
    if (wish->elements > 1) {
        growing_format(&head, "goal air > %.6g\n", start->gap[0]);
    }
    if (field > 0) {
        growing_string(&head, "goal distortion < 3, distortion > -3\n");
    }
    return growing_done(&head).start;
}

/* A surface; `medium` behind it. */
static void start_put_surface(const struct optimize_start *start, struct text_buffer *text,
                              const char *medium, double c, double thickness, const double *bounds)
{
    growing_format(text, "surface - %.9g %s - c=%.9g c~[%.9g,%.9g] t~[%.9g,%.9g]%s\n", thickness,
                   medium, c, -start->bend, start->bend, bounds[0], bounds[1],
                   strcmp(medium, "air") != 0 ? " glass~" : "");
}

/* Elements, and the stop in its gap. */
static struct text start_write(const struct optimize_start *start, const struct predesign *design,
                               struct arena *arena)
{
    const double f = start->words.efl, stopped[] = {0, start->gap[1]};
    const double last[] = {start->back, start->wish.track * f};
    struct text_buffer text = {.arena = arena};
    growing_string(&text, start->head);
    if (design->stop == 0) {
        growing_format(&text, "stop - %.9g air - t~[%.9g,%.9g]\n", design->before * f, stopped[0],
                       stopped[1]);
    }
    for (size_t i = 0; i < design->elements; i++) {
        const bool is_last = i + 1 == design->elements, has_stop = design->stop == i + 1;
        const double bend = start->bend, *bounds = is_last ? last : start->gap;
        const char *glass = arena_printf(arena, "%.14g/%.14g", design->index[i], design->abbe[i]);
        const double front = fmax(-bend, fmin(bend, design->curvature[2 * i] / f));
        const double rear = fmax(-bend, fmin(bend, design->curvature[2 * i + 1] / f));
        const double gap = fmax(bounds[0], fmin(bounds[1], design->gap[i] * f));
        start_put_surface(start, &text, glass, front,
                          fmax(start->center[0], fmin(start->center[1], design->center[i] * f)),
                          start->center);
        if (!has_stop) {
            start_put_surface(start, &text, "air", rear, gap, bounds);
            continue;
        }
        const double before = fmin(fmin(design->before * f, gap), stopped[1]);
        start_put_surface(start, &text, "air", rear, before, stopped);
        growing_format(&text, "stop - %.9g air - t~[0,%.9g]\n",
                       fmin(gap - before, is_last ? last[1] : stopped[1]),
                       is_last ? last[1] : stopped[1]);
    }
    return growing_done(&text);
}

static bool start_read(const struct optimize_start *start, const struct predesign *design,
                       struct arena *arena, struct lens *lens, struct error *error)
{
    return lens_read("--start", start_write(start, design, arena), NULL, arena, lens, error);
}

/* -------- layouts -------- */

static void start_open_wish(struct optimize_start *start, size_t colours)
{
    const struct start_words *words = &start->words;
    struct predesign_wish *wish = &start->wish;
    const double f = words->efl, distance = start_image_distance(words);
    const double field = isnan(words->field) ? words->image / 2 / distance : tan(words->field);
    const double clear = start_rounded(f / words->fnumber + 0.3 * f * field);
    const double track = isnan(words->track) ? start_rounded(2 * distance) : words->track;
    start->back = isnan(words->bfl) ? start_rounded(0.1 * distance) : words->bfl;
    start->center[0] = start_rounded(0.05 * clear);
    start->center[1] = start_rounded(0.35 * clear);
    start->gap[0] = start_rounded(0.01 * clear);
    start->gap[1] = start_rounded(fmin(0.5 * f, 0.6 * track));
    start->bend = start_rounded(fmin(6, fmax(2, 1.8 * words->fnumber)) / f);
    *wish = (struct predesign_wish){.elements = (size_t)words->elements,
                                    .fnumber = words->fnumber,
                                    .field = field,
                                    .vergence = f / words->object,
                                    .is_achromatic = colours != 1,
                                    .back = start->back / f,
                                    .track = track / f,
                                    .clear = clear / f,
                                    .curvature = start->bend * f,
                                    .center = {start->center[0] / f, start->center[1] / f},
                                    .gap = {start->gap[0] / f, start->gap[1] / f}};
    if (!isnan(words->stop)) {
        start->stops[start->layouts++] = (size_t)words->stop;
        return;
    }
    /* between elements; of one alone beside it */
    const size_t first = wish->elements > 1 ? 1 : 0;
    const size_t last = wish->elements > 1 ? wish->elements - 1 : 1;
    for (size_t stop = first; stop <= last; stop++) {
        start->stops[start->layouts++] = stop;
    }
}

/* A layout that theory finds; of some numbers the first. */
static bool start_first(const struct optimize_start *start, size_t stop, uint64_t seed,
                        struct arena *arena, struct predesign *design)
{
    enum { MOST = 20 };
    bool found = false;
    for (uint32_t number = 0; number < MOST && !found; number++) {
        found = predesign_find(&start->wish, stop, seed, number, arena, design);
    }
    return found;
}

bool optimize_start_open(struct optimize_job *job, struct error *error)
{
    struct arena *arena = job->run->arena;
    struct optimize_start *start = ARENA_NEW(arena, struct optimize_start);
    struct text rest = text_of(job->input->start);
    for (size_t i = 0; i < START_WORDS; i++) {
        *start_member(&start->words, &start_words[i]) = NAN;
    }
    while (rest.length > 0) {
        if (!start_read_word(&start->words, text_cut(&rest, ','), error)) {
            return false;
        }
    }
    start->words.object = isnan(start->words.object) ? INFINITY : start->words.object;
    if (!start_check(&start->words, error)) {
        return false;
    }
    start_open_wish(start, job->input->waves.count);
    start->head = start_head(job, start);
    job->start = start;
    job->layouts = ARENA_ARRAY(arena, start->layouts, struct optimize_job);
    for (size_t i = 0; i < start->layouts; i++) {
        struct optimize_input *input = ARENA_NEW(arena, struct optimize_input);
        struct lens *lens = ARENA_NEW(arena, struct lens);
        struct predesign design;
        *input = *job->input;
        if (!start_first(start, start->stops[i], (uint64_t)input->seed, arena, &design)) {
            return fail(error, ERROR_DOMAIN, "third-order theory finds no such lens");
        }
        if (!start_read(start, &design, arena, lens, error)) {
            return false;
        }
        input->question.lens.lens = lens;
        job->layouts[job->layout_count] = *job;
        job->layouts[job->layout_count++].input = input;
    }
    return true;
}

void optimize_start_layout(struct optimize_job *one, size_t start)
{
    if (one->start == NULL) {
        return;
    }
    const struct optimize_job *layout = &one->layouts[start % one->layout_count];
    one->input = layout->input;
    one->lens = layout->lens;
    one->variables = layout->variables;
    one->goals = layout->goals;
    one->merit = layout->merit;
}

bool optimize_start_place(void *context, size_t number, struct arena *arena, double *numbers)
{
    const struct optimize_job *job = context;
    const struct optimize_start *start = job->start;
    const size_t layout = number % start->layouts;
    const struct variables *variables = &job->layouts[layout].variables;
    struct predesign design;
    struct lens lens;
    struct variables own;
    struct error ignored;
    if (!predesign_find(&start->wish, start->stops[layout], (uint64_t)job->input->seed,
                        (uint32_t)(number / start->layouts), arena, &design) ||
        !start_read(start, &design, arena, &lens, &ignored) ||
        !variables_open(&lens, variables->list, variables->count, arena, &own, &ignored)) {
        return false;
    }
    memcpy(numbers, own.start, own.count * sizeof *numbers);
    return true;
}
