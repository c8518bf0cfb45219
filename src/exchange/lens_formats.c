/* exchange/lens_formats.c - the table of other programs' lens files, and any file as a lens. */
/* SPDX-License-Identifier: MIT */
#include "exchange/lens_formats.h"

#include "data/encoding.h"
#include "exchange/codev/codev.h"
#include "exchange/lens_json.h"
#include "exchange/oslo/oslo.h"
#include "exchange/pbrt.h"
#include "exchange/zemax/zemax.h"
#include "optics/medium.h"

const struct foreign_format *const foreign_formats[] = {
    &zemax_format, &codev_format, &oslo_format, &pbrt_format, &lens_json_format, NULL,
};

const struct foreign_format *foreign_by_name(struct text name)
{
    for (const struct foreign_format *const *one = foreign_formats; *one != NULL; one++) {
        if (text_same(name, (*one)->type.word.word)) {
            return *one;
        }
    }
    return NULL;
}

const struct file_type *lens_types(size_t i)
{
    if (i == 0) {
        return &lens_file_type;
    }
    return foreign_formats[i - 1] != NULL ? &foreign_formats[i - 1]->type : NULL;
}

static const struct foreign_format *format_by_ending(struct text path)
{
    for (const struct foreign_format *const *one = foreign_formats; *one != NULL; one++) {
        if (file_type_ends(path, (*one)->type.ending)) {
            return *one;
        }
    }
    return NULL;
}

/*
 * The format of a file: what its content looks like, else its ending; null for a .lens file.
 *
 * Given     source   its name; one that ends in .lens is never foreign
 *           content  UTF-8
 */
static const struct foreign_format *format_by_look(struct text source, struct text content)
{
    if (file_type_ends(source, lens_file_type.ending)) {
        return NULL;
    }
    for (const struct foreign_format *const *one = foreign_formats; *one != NULL; one++) {
        if ((*one)->is_like(content)) {
            return *one;
        }
    }
    return format_by_ending(source);
}

/* Files of which another program knows more than a text: what is to be done with them. */
static const struct closed {
    const char *ending, *what, *advice;
} closed[] = {
    {".zar", "an archive of OpticStudio holds a lens and what it needs, packed",
     "unpack it, in OpticStudio or with zmxtools, and read the .zmx file in it"},
    {".zos", "an OpticStudio project is not a text file",
     "save the lens as .zmx in OpticStudio and read that"},
};

static const struct closed *closed_format_of(struct text path)
{
    for (size_t i = 0; i < sizeof closed / sizeof closed[0]; i++) {
        if (file_type_ends(path, closed[i].ending)) {
            return &closed[i];
        }
    }
    return NULL;
}

bool foreign_ends_as_lens(struct text path)
{
    return file_type_ends(path, lens_file_type.ending) || format_by_ending(path) != NULL ||
           closed_format_of(path) != NULL;
}

const char *foreign_format_name(const char *source, struct text content, struct arena *arena)
{
    const struct closed *other = closed_format_of(text_of(source));
    struct text text = content;
    struct error error;
    if (other != NULL) {
        return other->ending + 1;
    }
    if (!encoding_to_utf8(source, content, arena, &text, &error)) {
        text = content;
    }
    const struct foreign_format *format = format_by_look(text_of(source), text);
    return format != NULL ? format->type.word.word : lens_file_type.word.word;
}

/* --glass-numbers does nothing in a format whose glasses are names or numbers, never both. */
static bool check_glass_numbers(const struct foreign_job *job, const struct foreign_format *format,
                                struct error *error)
{
    const char *endings = "";
    if (job->glass_numbers == GLASS_NUMBERS_OF_FILE ||
        (format != NULL && (format->has_glass_numbers || format->read == NULL))) {
        return true;
    }
    for (const struct foreign_format *const *one = foreign_formats; *one != NULL; one++) {
        if ((*one)->has_glass_numbers) {
            endings = arena_printf(job->arena, "%s%s%s", endings, endings[0] != '\0' ? ", " : "",
                                   (*one)->type.ending);
        }
    }
    foreign_fail(job, error, "a file without indices beside the names of its glasses");
    return error_hint(error, "leave {glass numbers} out: it is for files as %s", endings);
}

static bool has_last_end(struct text content)
{
    const char last = content.length > 0 ? content.start[content.length - 1] : '\n';
    return last == '\n' || last == '\r';
}

/* What the end of a file that was read says of its being whole. */
static void check_file_is_whole(struct foreign_job *job, struct text content, struct lens *lens)
{
    if (!job->has_end && !has_last_end(content)) {
        foreign_cut_short(job, "its last line has no end");
    }
    lens->cut_short = job->cut_short;
}

/*
 * Does a glass lie before the image? Bare indices may be a single surface to be reckoned with, and
 * one as low as that of water an eye, or a camera under water.
 */
static bool ends_in_glass(const struct lens *lens)
{
    const double lowest = 1.4;
    struct pair index;
    struct error ignored;
    if (lens->surface_count == 0) {
        return false;
    }
    const struct medium *last = &lens->surfaces[lens->surface_count - 1].medium;
    return (last->kind == MEDIUM_GLASS || last->kind == MEDIUM_MODEL) &&
           !(medium_index(last, lens_primary_wavelength(lens), &index, &ignored) &&
             index.hi < lowest);
}

/* A .lens file is a list of surfaces without a last word. */
static bool read_list_file(struct foreign_job *job, struct text content, struct lens *lens,
                           struct error *error)
{
    if (!lens_read(job->source, content, job->glasses, job->arena, lens, error)) {
        return false;
    }
    if (ends_in_glass(lens)) {
        const struct text glass = lens->surfaces[lens->surface_count - 1].medium.written;
        foreign_cut_short(job, arena_printf(job->arena, "the glass %.*s lies before the image",
                                            text_shown(glass), glass.start));
    }
    check_file_is_whole(job, content, lens);
    return true;
}

bool foreign_read(struct foreign_job *job, struct text content, struct lens *lens,
                  struct error *error)
{
    struct text source = text_of(job->source), text = content;
    if (file_type_ends(source, lens_file_type.ending)) {
        return check_glass_numbers(job, NULL, error) && read_list_file(job, content, lens, error);
    }
    if (file_type_ends(source, ".agf")) {
        foreign_fail(job, error, "an AGF file is a catalogue of glasses, not a lens");
        return error_hint(error, "{agf} FILE adds its glasses");
    }
    const struct closed *other = closed_format_of(source);
    if (other != NULL) {
        foreign_fail(job, error, "%s", other->what);
        return error_hint(error, "%s", other->advice);
    }
    bool is_text = encoding_to_utf8(job->source, content, job->arena, &text, error);
    const struct foreign_format *format = format_by_look(source, is_text ? text : content);
    if (!check_glass_numbers(job, format, error)) {
        return false;
    }
    if (format == NULL) {
        return read_list_file(job, is_text ? text : content, lens, error);
    }
    if (!is_text) {
        return false;
    }
    if (format->read == NULL) {
        return foreign_fail(job, error,
                            "lenscalc writes files of the format '%s' but does not read them",
                            format->type.word.word);
    }
    const bool done = format->read(job, text, lens, error);
    check_file_is_whole(job, text, lens);
    return foreign_settle(job, done, error);
}

static const char *endings_with_thick(struct arena *arena)
{
    const char *endings = lens_file_type.ending, *last = NULL;
    for (const struct foreign_format *const *one = foreign_formats; *one != NULL; one++) {
        if (!(*one)->has_thick) {
            continue;
        }
        endings = last != NULL ? arena_printf(arena, "%s, %s", endings, last) : endings;
        last = (*one)->type.ending;
    }
    return last != NULL ? arena_printf(arena, "%s and %s", endings, last) : endings;
}

static void foreign_lose_design(struct foreign_job *job, const char *ending,
                                const struct lens *lens)
{
    /* What is wanted, allowed, and varies in a position, where the file has no words for it. */
    bool is_marked = false;
    for (size_t j = 0; j < lens->variable_count; j++) {
        is_marked = is_marked || lens->variables[j].varies != NULL;
    }
    if (lens->goal_count > 0) {
        foreign_lose(job, LOSS_OF_NOTHING, "left out", "goals in a %s file", ending);
    }
    if (lens->tolerance_count > 0) {
        foreign_lose(job, LOSS_OF_NOTHING, "left out", "tolerances in a %s file", ending);
    }
    if (lens->stop_is_real && lens->aperture_kind > APERTURE_STOP) {
        foreign_lose(job, LOSS_OF_VIGNETTING, "left out",
                     "the word 'real' of the aperture: a %s file does not say which marginal "
                     "ray sizes the stop",
                     ending);
    }
    if (is_marked) {
        foreign_lose(job, LOSS_OF_NOTHING, "left out",
                     "marks of what varies in a position in a %s file", ending);
    }
}

bool foreign_write(struct foreign_job *job, const struct foreign_format *format,
                   const struct lens *lens, struct text *text, struct error *error)
{
    for (size_t i = 0; i < lens->surface_count && !format->has_thick; i++) {
        if (surface_has(&lens->surfaces[i], SURFACE_HAS_FOCAL)) {
            return fail(error, ERROR_DATA,
                        "surface %zu is a thick lens: a %s file has none, only %s", i + 1,
                        format->type.ending, endings_with_thick(job->arena));
        }
    }
    for (size_t i = 0; i < lens->surface_count && !format->has_apertures; i++) {
        if (lens->surfaces[i].aperture_count > 0) {
            foreign_lose(job, LOSS_OF_VIGNETTING, NULL,
                         "surface %zu: what passes or is blocked beside its diameter", i + 1);
        }
    }
    if (!format->has_settings) {
        /* What the positions set anew, where the file has no words for it. */
        struct arena *arena = job->arena;
        const char *all = lens->stops != NULL ? " stop" : "";
        all = lens->lights != NULL ? arena_printf(arena, "%s wavelength", all) : all;
        all = lens->points != NULL ? arena_printf(arena, "%s field", all) : all;
        for (size_t k = 0; k < lens->setting_count; k++) {
            all = arena_printf(arena, "%s %s", all,
                               parameter_write(lens->settings[k].parameter, arena));
        }
        if (all[0] != '\0') {
            foreign_lose(job, LOSS_OF_RAYS, "the first position's is kept",
                         "what the positions set anew in a %s file:%s", format->type.ending, all);
        }
    }
    if (!format->has_design) {
        foreign_lose_design(job, format->type.ending, lens);
    }
    return foreign_settle(job, format->write(job, lens, text, error), error);
}
