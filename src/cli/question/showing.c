/* cli/question/showing.c - drawings and pictures on the terminal; drawings as PNG and PDF. */
/* SPDX-License-Identifier: MIT */
#include "cli/question/showing.h"

#include "base/image/png.h"
#include "cli/child.h"
#include "cli/question/command.h"
#include "draw/terminal/page.h"
#include "draw/terminal/picture.h"
#include "report/terminal.h"
#include "report/terminal_query.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

bool showing_is_possible(file_types *types)
{
    return types != NULL && (file_type_of(types, text_of("x.svg")) != NULL ||
                             file_type_of(types, text_of("x.png")) != NULL);
}

/* -------- another program -------- */

enum { CONVERTED_MOST = 1 << 28 }; /* bytes of a file that it makes */
static const double PATIENCE = 60; /* s */

static bool converter_fail(const char *what, struct error *error)
{
    fail(error, ERROR_IO, "%s of a drawing needs rsvg-convert, which is not installed", what);
    return error_hint(error, "Debian: librsvg2-bin; .svg needs no other program");
}

/* Run rsvg-convert: its words end with null. `what`, "PNG", is for messages. */
static bool converter_run(char *const *words, const char *what, struct text drawing,
                          struct arena *arena, struct text *file, struct error *error)
{
    const struct child child = {.words = words,
                                .is_read = true,
                                .input = drawing,
                                .seconds = PATIENCE,
                                .most = CONVERTED_MOST};
    struct child_end end;
    if (!child_run(&child, &end, arena, error)) {
        return false;
    }
    if (end.is_missing) {
        return converter_fail(what, error);
    }
    if (end.is_late || end.is_long) {
        return fail(error, ERROR_IO, "rsvg-convert was ended: %s",
                    end.is_late ? "it took more than a minute" : "it made too large a file");
    }
    if (end.status != 0) {
        const struct text why = end.said.length > 0 ? end.said : text_of(child_status(&end, arena));
        return fail(error, ERROR_IO, "rsvg-convert failed: %.*s", text_shown_up_to(why, 200),
                    why.start);
    }
    *file = end.output;
    return true;
}

static const char *form_name(enum artifact_form form)
{
    return form == ARTIFACT_AS_PDF ? "a PDF" : "a PNG";
}

bool showing_check_converter(const struct artifact_job *job, struct arena *arena,
                             struct error *error)
{
    char program[] = "rsvg-convert", version[] = "--version";
    char *const words[] = {program, version, NULL};
    struct text said;
    return converter_run(words, form_name(job->form), (struct text){NULL, 0}, arena, &said,
                         error) ||
           error_prefix(error, "--%s: ", job->artifact->option.name);
}

/* A PDF of the drawing's size; a PNG of two pixels for one of the drawing's. */
static bool convert_file(const struct artifact_job *job, struct text drawing, struct arena *arena,
                         struct text *file, struct error *error)
{
    char program[] = "rsvg-convert", format[] = "--format", pdf[] = "pdf", png[] = "png";
    char zoom[] = "--zoom", twice[] = "2";
    char *const as_pdf[] = {program, format, pdf, NULL};
    char *const as_png[] = {program, format, png, zoom, twice, NULL};
    return converter_run(job->form == ARTIFACT_AS_PDF ? as_pdf : as_png, form_name(job->form),
                         drawing, arena, file, error);
}

/* -------- the terminal -------- */

/* How large pixels of graphics are beside its characters. */
struct showing_screen {
    struct page_view view;
    enum terminal_graphics graphics;
    double cell_width, cell_height; /* px */
};

static struct showing_screen screen_find(const struct common *common)
{
    enum { USUAL = 80, LEAST = 20, MOST = 1000, CELL_WIDE = 10, CELL_HIGH = 20 };
    const bool is_terminal = isatty(STDOUT_FILENO);
    const char *columns = getenv("COLUMNS");
    const long asked = !is_terminal && columns != NULL ? strtol(columns, NULL, 10) : 0;
    const long width = is_terminal ? (long)terminal_width(STDOUT_FILENO) : asked;
    struct showing_screen screen = {.graphics = (enum terminal_graphics)common->terminal,
                                    .cell_width = CELL_WIDE,
                                    .cell_height = CELL_HIGH};
    const size_t some = width > 0 ? (size_t)width : USUAL;
    screen.view.columns = some < LEAST ? LEAST : some;
    screen.view.columns = some > MOST ? MOST : screen.view.columns;
    screen.view.rows = terminal_rows(STDOUT_FILENO);
    if (terminal_has_color(STDOUT_FILENO, (enum color_when)common->color)) {
        screen.view.colours = terminal_has_true_color() ? CELL_TRUE : CELL_256;
    }
    if (screen.graphics == GRAPHICS_BLOCKS ||
        (screen.graphics == GRAPHICS_AUTO && screen.view.colours == CELL_PLAIN)) {
        screen.graphics = GRAPHICS_BLOCKS;
        return screen;
    }
    struct terminal_answer answer = {.has_sixel = false};
    if (is_terminal) {
        answer = terminal_ask(STDOUT_FILENO);
    }
    if (answer.cell_width > 0 && answer.cell_height > 0) {
        screen.cell_width = (double)answer.cell_width;
        screen.cell_height = (double)answer.cell_height;
    }
    if (screen.graphics == GRAPHICS_AUTO) {
        screen.graphics = answer.has_sixel ? GRAPHICS_SIXEL : GRAPHICS_BLOCKS;
        screen.graphics = answer.has_kitty ? GRAPHICS_KITTY : screen.graphics;
    }
    return screen;
}

/* Pixels across that a picture may have, so that all of it is seen at once. */
static double screen_width(const struct showing_screen *screen, double proportion)
{
    enum { AROUND = 2, LEAST = 10 };
    const double across = (double)screen->view.columns * screen->cell_width;
    const double high = (double)(screen->view.rows - AROUND) * screen->cell_height;
    return screen->view.rows < LEAST || across < high * proportion ? across : high * proportion;
}

/* A picture whose file is there. */
static bool show_picture(const struct showing_screen *screen, struct text png, struct arena *arena,
                         struct text_buffer *lines, struct error *error)
{
    const struct image_wish wish = {.values = IMAGE_LIGHT};
    struct image image;
    if (!png_read(png, &wish, arena, &image, error)) {
        return false;
    }
    if (screen->graphics == GRAPHICS_BLOCKS) {
        return picture_blocks(&image, &screen->view, arena, lines, error);
    }
    const double most = screen_width(screen, image_proportion(&image));
    const bool is_small = (double)image.width <= most;
    if (screen->graphics == GRAPHICS_SIXEL) {
        return picture_sixel(&image, is_small ? image.width : (size_t)most, arena, lines, error);
    }
    picture_kitty(png, is_small ? 0 : (size_t)(most / screen->cell_width), lines);
    return true;
}

/* As many pixels of a drawing as the screen has. */
static bool draw_pixels(const struct showing_screen *screen, struct text drawing,
                        struct arena *arena, struct text *png, struct error *error)
{
    enum { MOST = 1600 }; /* px: beyond that lines are only finer */
    char program[] = "rsvg-convert", format[] = "--format=png";
    const double across = (double)screen->view.columns * screen->cell_width;
    char *width = arena_printf(arena, "--width=%.0f", across < MOST ? across : MOST);
    char *const words[] = {program, format, width, NULL};
    return converter_run(words, "a picture", drawing, arena, png, error);
}

static bool show_made(const struct showing_screen *screen, bool is_drawing, struct text made,
                      struct arena *arena, struct text_buffer *lines, struct error *error)
{
    struct text png = made;
    if (!is_drawing) {
        return show_picture(screen, made, arena, lines, error);
    }
    if (screen->graphics == GRAPHICS_BLOCKS) {
        page_draw(made, &screen->view, arena, lines);
        return true;
    }
    return draw_pixels(screen, made, arena, &png, error) &&
           show_picture(screen, png, arena, lines, error);
}

bool showing_convert(const struct artifacts *artifacts, const struct artifact_job *job,
                     struct text made, struct output *sink, struct error *error)
{
    struct arena *arena = artifacts->arena;
    struct text file;
    if (job->form != ARTIFACT_SHOWN) {
        if (!convert_file(job, made, arena, &file, error)) {
            return false;
        }
        output_text(sink, file.start, file.length);
        return true;
    }
    const bool is_drawing = strcmp(job->type->ending, ".svg") == 0;
    struct showing_screen screen = screen_find(artifacts->common);
    struct text_buffer lines = {.arena = arena};
    if (artifacts->has_rows) {
        growing_string(&lines, "\n");
    }
    bool done = show_made(&screen, is_drawing, made, arena, &lines, error);
    if (!done && is_drawing && artifacts->common->terminal == GRAPHICS_AUTO) {
        /* nobody asked for pixels that another program makes */
        screen.graphics = GRAPHICS_BLOCKS;
        done = show_made(&screen, is_drawing, made, arena, &lines, error);
    }
    struct output *kept = &artifacts->inner[sink - artifacts->sinks];
    const struct text shown = growing_done(&lines);
    output_inside(kept, arena);
    output_text(kept, shown.start, shown.length);
    return done;
}
