/* commands/data/cmd_convert.c - lenscalc convert: lens files of other programs, changed lenses. */
/* SPDX-License-Identifier: MIT */
#include "analysis/rays/clear_diameters.h"
#include "commands/data/check_files.h"
#include "commands/lens/lens_options.h"
#include "commands/tables.h"
#include "exchange/lens_formats.h"
#include "exchange/lens_open.h"
#include "file/lens_change.h"
#include "file/lens_glass.h"
#include "file/lens_unit.h"
#include "optics/growing.h"

#include <math.h>
#include <string.h>

struct convert_input {
    struct lens_text_value lens;
    int to, unit;
    bool reverse;
    double scale, focal_length;
    double margin; /* of --set-diameters; NaN: they stay */
    const char *position;
};

/* "auto", then what a lens may be written as. */
static const struct word *format_word_at(size_t i)
{
    static const struct word automatic = {"auto",
                                          "by the extension of the output file; .lens without one"};
    const struct file_type *type = i > 0 ? lens_types(i - 1) : NULL;
    if (i == 0) {
        return &automatic;
    }
    return type != NULL ? &type->word : NULL;
}

/* "keep", then what a lens may be typed in. */
static const struct word *unit_word_at(size_t i)
{
    static const struct word keep = {"keep", "that of the lens"};
    if (i == 0) {
        return &keep;
    }
    return lens_units[i - 1].word != NULL ? &lens_units[i - 1] : NULL;
}

#define INPUT struct convert_input

static const struct option options[] = {
    {ASKED(lens), .name = "lens", .letter = 'l', .value = "LENS",
     .flags = OPTION_OPERAND | OPTION_FILE, .types = lens_types,
     .help = "a lens of lensdb (list lenses), a file, or - for standard input"},
    {ASKED(to), .name = "to", .word_at = format_word_at, .fallback = "auto", .value = "FORMAT",
     .help = "what to write"},
    {ASKED(position), .name = "position", .value = "NAME|LENGTH",
     .help = "only this zoom or focus position, or the one nearest to a focal length: 135mm; "
             "without it all"},
    {ASKED(reverse), .name = "reverse", .help = "turn the lens around"},
    {MEASURE(scale, number, NULL, "FACTOR"), .name = "scale", .lowest = 0, .highest = 1e6,
     .flags = OPTION_ABOVE_LOWEST, .excludes = "focal-length",
     .help = "all lengths times a factor"},
    {MEASURE(focal_length, length, "mm", "LENGTH"), .name = "focal-length", .letter = 'f',
     .lowest = 0, .highest = 1e9, .flags = OPTION_ABOVE_LOWEST | OPTION_NO_INFINITY,
     .help = "scale to this focal length at the primary wavelength, in the first position"},
    {ASKED(margin), LENS_DIAMETERS_OPTION},
    {ASKED(unit), .name = "unit", .word_at = unit_word_at, .fallback = "keep", .value = "UNIT",
     .help = "unit of the lengths in the file"},
};

/* What is done, step by step. */
struct conversion {
    const struct convert_input *input;
    struct arena *arena;
    struct lens_glasses place;
    struct glass_source glasses;
    struct foreign_job job;
    const struct lens *lens;
    const char *position; /* that stands for a focal length; null = none does */
    const char *left_out; /* marks and pick-ups that --reverse leaves out; null = none */
    size_t goals;         /* that a lens turned around or scaled has no more */
    const char *margins;  /* that --set-diameters could not give; null = all are there */
};

static bool choose_position(struct conversion *conversion, struct error *error)
{
    const char *name = conversion->input->position;
    const struct lens *lens = conversion->lens;
    if (name == NULL || text_same(text_of(name), "all")) {
        return true;
    }
    if (lens->position_count == 0) {
        return fail(error, ERROR_USAGE, "{--position} '%s': the lens has only one position", name);
    }
    size_t position;
    if (!lens_position_named(lens, text_of(name), conversion->arena, &position, error)) {
        return error_prefix(error, "{--position}: ");
    }
    conversion->position =
        text_same(text_of(name), lens->positions[position]) ? NULL : lens->positions[position];
    conversion->lens = lens_one_position(lens, position, conversion->arena);
    return true;
}

static bool convert_scale(struct conversion *conversion, struct error *error)
{
    const struct convert_input *input = conversion->input;
    struct arena *arena = conversion->arena;
    const struct lens *lens = conversion->lens;
    if (!isnan(input->scale)) {
        /* The factor as the decimal that was typed. */
        char text[NUMBER_LENGTH];
        struct pair decimal = {input->scale, 0};
        pair_read(text, number_write_shortest(text, input->scale), (struct number_scale){1, 0},
                  &decimal);
        conversion->lens = lens_scaled(lens, decimal, false, arena);
    }
    if (isnan(input->focal_length)) {
        return true;
    }
    struct first_order first;
    if (!first_order_of_lens(lens_at_position(lens, 0, arena), lens_primary_wavelength(lens),
                             SECTION_Y, arena, &first, error)) {
        return false;
    }
    if (first.is_afocal) {
        return fail(error, ERROR_DOMAIN, "{--focal-length}: the lens is afocal");
    }
    struct pair factor = pair_divide(pair_of(input->focal_length), pair_of(fabs(first.efl)));
    conversion->lens = lens_scaled(lens, factor, true, arena);
    return true;
}

static bool convert_set_diameters(struct conversion *conversion, struct error *error)
{
    const struct clear_diameters_question question = {
        .lens = conversion->lens, .fnumber = NAN, .margin = conversion->input->margin};
    return clear_diameters_find(&question, conversion->arena, &conversion->lens,
                                &conversion->margins, error) ||
           error_prefix(error, "{--set-diameters}: ");
}

static bool convert_change(struct conversion *conversion, struct error *error)
{
    const struct convert_input *input = conversion->input;
    if (!choose_position(conversion, error)) {
        return false;
    }
    conversion->goals = conversion->lens->goal_count;
    if (input->reverse) {
        conversion->left_out = lens_marks_left_out(conversion->lens, conversion->arena);
        conversion->lens = lens_reversed(conversion->lens, conversion->arena, error);
        if (conversion->lens == NULL) {
            return false;
        }
    }
    if (!convert_scale(conversion, error)) {
        return false;
    }
    conversion->goals -= conversion->lens->goal_count;
    if (input->unit > 0) {
        conversion->lens =
            lens_in_unit(conversion->lens, lens_units[input->unit - 1].word, conversion->arena);
    }
    return isnan(input->margin) || convert_set_diameters(conversion, error);
}

/* What --to says. */
static const struct file_type *convert_choose_type(const void *data)
{
    const struct convert_input *input = data;
    return input->to > 0 ? lens_types((size_t)input->to - 1) : NULL;
}

static bool convert_check(const struct artifact_job *job, struct error *error)
{
    const struct convert_input *input = job->inputs[0];
    const struct foreign_format *format = foreign_by_name(text_of(job->type->word.word));
    if (format != NULL && format->write == NULL) {
        return fail(error, ERROR_USAGE, "lenscalc does not write files of the format '%s'",
                    job->type->word.word);
    }
    return input->lens.source != NULL ||
           fail(error, ERROR_USAGE, "which lens? Give a name, a file or -");
}

/* What is said beside the lens: of numbers that are others now, and of all that is lost. */
static struct text remarks_of(struct conversion *conversion, const struct lens *read,
                              const struct foreign_format *format)
{
    const struct convert_input *input = conversion->input;
    struct text_buffer lost = {.arena = input->lens.arena};
    if (read->cut_short != NULL) {
        growing_format(&lost, "%s: %s\n", input->lens.source, read->cut_short);
    }
    for (size_t i = 0; i < read->pickup_count; i++) {
        if (read->pickups[i].warning != NULL) {
            growing_format(&lost, "%s: %s\n", input->lens.source, read->pickups[i].warning);
        }
    }
    foreign_losses(&conversion->job, &lost);
    if (conversion->margins != NULL) {
        growing_format(&lost, "%s: %s\n", input->lens.source, conversion->margins);
    }
    struct lens_warnings warnings = {.count = 0};
    struct error ignored;
    if (!isnan(input->margin)) {
        lens_check(conversion->lens, conversion->arena, &warnings, &ignored);
    }
    for (size_t i = 0; i < warnings.count; i++) {
        growing_format(&lost, "%s: %s\n", input->lens.source, warnings.texts[i]);
    }
    if (conversion->position != NULL) {
        growing_format(&lost, "%s: position '%s' is the nearest to %s\n", input->lens.source,
                       conversion->position, input->position);
    }
    if (conversion->left_out != NULL) {
        growing_format(&lost, "%s: lost: %s: --reverse has no mark for what lies before the lens\n",
                       input->lens.source, conversion->left_out);
    }
    if (format != NULL && !format->has_design && conversion->lens->pickup_count > 0) {
        growing_format(&lost, "%s: lost: pick-ups: their numbers are kept\n", input->lens.source);
    }
    if (conversion->goals > 0) {
        growing_format(&lost, "%s: lost: %zu goals: they are of the lens as it was\n",
                       input->lens.source, conversion->goals);
    }
    return growing_done(&lost);
}

static bool convert(struct conversion *conversion, const struct foreign_format *format,
                    struct output *output, struct error *error)
{
    const struct convert_input *input = conversion->input;
    struct arena *arena = conversion->arena;
    struct lens *lens = ARENA_NEW(arena, struct lens);
    struct lens_warnings warnings;
    struct text text;
    if (!foreign_read(&conversion->job, input->lens.content, lens, error)) {
        return false;
    }
    conversion->lens = lens;
    if (!lens_check(lens, arena, &warnings, error)) {
        return error_prefix(error, "%s: ", input->lens.source);
    }
    lens_set_stop_size(lens, input->lens.db->stop_size);
    if (!convert_change(conversion, error)) {
        return false;
    }
    if (format == NULL) {
        text = lens_write(conversion->lens, arena);
    } else if (!foreign_write(&conversion->job, format, conversion->lens, &text, error)) {
        return false;
    }
    output_text(output, text.start, text.length);
    output->remarks = remarks_of(conversion, lens, format);
    return true;
}

static bool convert_write(const struct artifact_job *job, struct output *sink, struct error *error)
{
    const struct convert_input *input = job->inputs[0];
    struct conversion conversion = {.input = input, .arena = job->run->arena};
    conversion.place = (struct lens_glasses){input->lens.db, conversion.arena};
    conversion.glasses = lens_glass_source(&conversion.place);
    conversion.job = (struct foreign_job){.source = input->lens.source,
                                          .arena = conversion.arena,
                                          .glasses = &conversion.glasses,
                                          .reads_beside = input->lens.is_file,
                                          .lossy = input->lens.db->lossy,
                                          .glass_numbers = input->lens.db->glass_numbers};
    return convert(&conversion, foreign_by_name(text_of(job->type->word.word)), sink, error);
}

static const struct artifact artifacts[] = {
    {ARTIFACT_ANSWER(lens_types), .choose = convert_choose_type, .chooser = "to",
     .check = convert_check, .make = convert_write},
};

static const struct example examples[] = {
    {"convert double-gauss --to zmx", "a lens for Zemax (to a file: -o FILE.zmx)"},
    {"convert double-gauss --focal-length 50mm", "the same lens, scaled to half the focal length"},
    {"convert double-gauss --scale 0.1 --unit cm", "scaled exactly, written in centimetres"},
    {"convert double-gauss --reverse", "turned around"},
    {"convert nikkor-z-14-24 --position tele", "one position of a zoom"},
    {"convert cooke-triplet-50 --set-diameters", "surfaces as large as its beams, and 2 % more"},
    {NULL, NULL},
};

const struct command command_convert = {
    .name = "convert",
    .group = "data",
    .summary = "read and write lens files of other programs; scale and reverse a lens",
    COMMAND_ASKS(struct convert_input),
    COMMAND_MAKES(artifacts),
    .other = &command_convert_check,
};
