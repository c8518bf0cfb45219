/* report/output.c - buffered writing to standard output or to a file that appears whole. */
/* SPDX-License-Identifier: MIT */
#ifdef __linux__
#define _GNU_SOURCE /* O_TMPFILE */
#endif
#include "report/output.h"

#include "report/place.h"

#include <errno.h>
#include <fcntl.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { BUFFER_SIZE = 64 * 1024 };

/*
 * A file without a name in the folder of `path`: whatever ends the program, nothing of it is left.
 * -1 where the system knows no such files.
 */
static int open_nameless(const char *path, struct arena *arena)
{
#ifdef O_TMPFILE
    if (access("/proc/self/fd", F_OK) == 0) {
        return open(place_folder(path, arena), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0600);
    }
#else
    (void)path;
    (void)arena;
#endif
    return -1;
}

enum { ATTEMPTS = 100 }; /* to find a name that nobody has */

/* Give the nameless file a name beside its path, so that it can be renamed to that. */
static bool name_nameless(struct output *output)
{
    char link[64];
    bool named = false;
    snprintf(link, sizeof link, "/proc/self/fd/%d", output->descriptor);
    errno = EEXIST;
    for (unsigned i = 0; i < ATTEMPTS && !named && errno == EEXIST; i++) {
        output->beside = place_beside(output->path, i, output->arena);
        named = linkat(AT_FDCWD, link, AT_FDCWD, output->beside, AT_SYMLINK_FOLLOW) == 0;
    }
    return named;
}

/* A new file that becomes `path` at the end. What may not be written is not replaced either. */
static int open_beside(struct output *output, const char *path)
{
    if (access(path, W_OK) != 0 && errno != ENOENT) {
        return -1;
    }
    int descriptor = open_nameless(path, output->arena);
    output->is_nameless = descriptor >= 0;
    errno = output->is_nameless ? 0 : EEXIST;
    for (unsigned i = 0; i < ATTEMPTS && descriptor < 0 && errno == EEXIST; i++) {
        output->beside = place_beside(path, i, output->arena);
        descriptor = open(output->beside, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
    }
    if (descriptor >= 0) {
        /* The permissions that the file of this name has or would get, and its owner where that may
           be given; what lets a program run as its owner was said of the old content. */
        struct stat old = {0};
        const mode_t mask = umask(0);
        umask(mask);
        const bool is_there = stat(path, &old) == 0;
        /* a file system without owners or permissions is no reason to fail */
        if (is_there && fchown(descriptor, old.st_uid, old.st_gid) != 0) {
            /* a member of the group may give that alone */
            (void)!fchown(descriptor, (uid_t)-1, old.st_gid);
        }
        (void)!fchmod(descriptor, is_there ? old.st_mode & 0777 : 0666 & ~mask);
    }
    return descriptor;
}

/* What is open already is written to where it stands, another process's at its end. */
static int open_again(const char *path, int descriptor)
{
    if (descriptor >= 0) {
        return fcntl(descriptor, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
    }
    if (descriptor == PLACE_FOREIGN) {
        return open(path, O_WRONLY | O_APPEND | O_CLOEXEC);
    }
    return open(path, O_WRONLY | O_CLOEXEC);
}

void output_begin(struct output *output, int descriptor, struct arena *arena)
{
    *output = (struct output){.descriptor = descriptor, .size = BUFFER_SIZE};
    output->buffer = arena_buffer(arena, BUFFER_SIZE);
}

bool output_open(struct output *output, const char *path, struct arena *arena, struct error *error)
{
    output_begin(output, STDOUT_FILENO, arena);
    if (place_is_standard(path, arena)) {
        return true;
    }
    /* what a link points to is written, not the link replaced */
    const char *place = place_of(path, arena);
    output->path = place != NULL ? place : path;
    output->arena = arena;
    const int descriptor = place_descriptor(output->path, arena);
    /* a device or pipe is written to directly: there is nothing to rename */
    struct stat status;
    output->is_renamed = place != NULL && descriptor == PLACE_CLOSED &&
                         (stat(place, &status) != 0 || S_ISREG(status.st_mode));
    output->descriptor =
        output->is_renamed ? open_beside(output, place) : open_again(output->path, descriptor);
    if (output->descriptor < 0) {
        return fail(error, ERROR_IO, "cannot write %s: %s", output->path, strerror(errno));
    }
    return true;
}

enum { NOWHERE = -1 }; /* the descriptor of what stays in memory */

void output_inside(struct output *output, struct arena *arena)
{
    output_begin(output, NOWHERE, arena);
    output->arena = arena;
}

struct text output_kept(struct output *output)
{
    output_flush(output);
    return (struct text){output->kept, output->kept_length};
}

static void write_all(struct output *output, const char *start, size_t length)
{
    if (output->descriptor == NOWHERE) {
        if (length > 0) {
            if (output->kept_room - output->kept_length < length) {
                const size_t room = 2 * (output->kept_length + length);
                char *more = arena_buffer(output->arena, room);
                if (output->kept_length > 0) {
                    memcpy(more, output->kept, output->kept_length);
                }
                output->kept = more;
                output->kept_room = room;
            }
            memcpy(output->kept + output->kept_length, start, length);
            output->kept_length += length;
        }
        return;
    }
    if (output->before_write != NULL && length > 0) {
        output->before_write(output->context);
    }
    while (length > 0 && output->failure == 0) {
        ssize_t written = write(output->descriptor, start, length);
        if (written > 0) {
            start += written;
            length -= (size_t)written;
        } else if (written < 0 && errno != EINTR) {
            output->failure = errno;
        }
    }
}

static void write_guarded(struct output *output, const char *start, size_t length)
{
    size_t good = 0;
    while (good < length) {
        const char *at = start + good;
        const size_t room = length - good;
        /* what begins here and no terminal shall see; lines end as files have them end */
        const bool ends_line = *at == '\n' || (*at == '\r' && room > 1 && at[1] == '\n');
        const size_t bad = ends_line || *at == '\t' ? 0 : text_unprintable(at, room);
        if (bad == 0) {
            const size_t whole = text_utf8_length(at, room);
            good += whole > 0 ? whole : 1;
            continue;
        }
        write_all(output, start, good);
        write_all(output, "?", 1);
        start += good + bad;
        length -= good + bad;
        good = 0;
    }
    write_all(output, start, length);
}

/* Bytes at the end of the buffer that wait for the rest of their character or line end. */
static size_t unfinished(const struct output *output)
{
    const size_t length = output->used;
    const unsigned char *bytes = (const unsigned char *)output->buffer;
    for (size_t back = 1; back <= 3 && back <= length; back++) {
        const unsigned char byte = bytes[length - back];
        const size_t whole =
            (size_t)(1 + (byte >= 0xc0 || byte == '\r') + (byte >= 0xe0) + (byte >= 0xf0));
        if (whole > back) {
            return back;
        }
    }
    return 0;
}

void output_flush(struct output *output)
{
    const size_t waiting = output->is_guarded ? unfinished(output) : 0;
    const size_t length = output->used - waiting;
    if (output->is_guarded) {
        write_guarded(output, output->buffer, length);
    } else {
        write_all(output, output->buffer, length);
    }
    if (waiting > 0) {
        memmove(output->buffer, output->buffer + length, waiting);
    }
    output->used = waiting;
}

char *output_reserve(struct output *output, size_t length)
{
    if (output->size - output->used < length) {
        output_flush(output);
    }
    return output->buffer + output->used;
}

void output_advance(struct output *output, const char *end)
{
    output->used = (size_t)(end - output->buffer);
}

void output_text(struct output *output, const char *start, size_t length)
{
    for (; output->is_guarded && length > OUTPUT_RESERVE; length -= OUTPUT_RESERVE) {
        output_text(output, start, OUTPUT_RESERVE);
        start += OUTPUT_RESERVE;
    }
    if (length > OUTPUT_RESERVE) {
        output_flush(output);
        write_all(output, start, length);
    } else if (length > 0) {
        char *to = output_reserve(output, length);
        memcpy(to, start, length);
        output_advance(output, to + length);
    }
}

void output_string(struct output *output, const char *string)
{
    output_text(output, string, strlen(string));
}

void output_character(struct output *output, char c)
{
    output_text(output, &c, 1);
}

void output_escaped(struct output *output, struct text text)
{
    for (size_t i = 0, step; i < text.length; i += step) {
        const struct text shown = text_xml((struct text){text.start + i, text.length - i}, &step);
        output_text(output, shown.start, shown.length);
    }
}

void output_spaces(struct output *output, size_t count)
{
    while (count-- > 0) {
        output_character(output, ' ');
    }
}

void output_style(struct output *output, enum style style)
{
    static const char *const codes[] = {[STYLE_PLAIN] = "\033[0m",
                                        [STYLE_HEAD] = "\033[1m",
                                        [STYLE_WARNING] = "\033[33m",
                                        [STYLE_ERROR] = "\033[1;31m"};
    if (output->has_color) {
        output_string(output, codes[style]);
    }
}

void output_styled(struct output *output, enum style style, const char *string)
{
    output_style(output, style);
    output_string(output, string);
    output_style(output, STYLE_PLAIN);
}

/* Characters up to the next blank or the end of the line; bytes that continue one do not count. */
static size_t word_width(const char *text)
{
    size_t width = 0;
    for (; *text != '\0' && *text != ' ' && *text != '\n'; text++) {
        width += ((unsigned char)*text & 0xc0) != 0x80;
    }
    return width;
}

void output_paragraph(struct output *output, const char *text, size_t at, size_t indent,
                      size_t width)
{
    for (; *text != '\0'; text++) {
        bool ends = *text == ' ' && at + 1 + word_width(text + 1) > width;
        if (ends || *text == '\n') {
            output_character(output, '\n');
            output_spaces(output, indent);
            at = indent;
        } else {
            output_character(output, *text);
            at += ((unsigned char)*text & 0xc0) != 0x80;
        }
    }
    output_character(output, '\n');
}

void output_wrapped(struct output *output, const char *text, size_t width)
{
    output_paragraph(output, text, 0, 0, width);
}

void output_printf(struct output *output, const char *format, ...)
{
    va_list arguments;
    char *to = output_reserve(output, OUTPUT_RESERVE);
    va_start(arguments, format);
    int length = vsnprintf(to, OUTPUT_RESERVE, format, arguments);
    va_end(arguments);
    if (length > 0) {
        output->used += length < OUTPUT_RESERVE ? (size_t)length : OUTPUT_RESERVE - 1;
    }
}

void output_abandon(const struct output *output)
{
    if (output->is_renamed && !output->is_nameless) {
        unlink(output->beside);
    }
}

const char *output_set_aside(struct output *output)
{
    if (!output->is_renamed) {
        return NULL;
    }
    const char *name = strrchr(output->path, '/'), *ending = strrchr(output->path, '.');
    name = name != NULL ? name + 1 : output->path;
    ending = ending != NULL && ending > name ? ending : output->path + strlen(output->path);
    output->path = arena_printf(output->arena, "%.*s-incomplete%s", (int)(ending - output->path),
                                output->path, ending);
    return output->path;
}

/* Put the whole file in its place; take one away that is not to be kept. */
static void output_settle(struct output *output, bool keep)
{
    bool whole = keep && output->failure == 0;
    if (whole && rename(output->beside, output->path) != 0) {
        output->failure = errno;
        whole = false;
    }
    if (!whole && !output->is_nameless) {
        unlink(output->beside);
    }
}

static bool fail_written(const struct output *output, struct error *error)
{
    if (output->path != NULL) {
        return fail(error, ERROR_IO, "cannot write %s: %s", output->path,
                    strerror(output->failure));
    }
    return fail(error, output->failure == EPIPE ? ERROR_PIPE : ERROR_IO,
                "cannot write to standard output: %s", strerror(output->failure));
}

bool output_close(struct output *output, bool keep, struct error *error)
{
    keep = keep && !output->is_unused;
    output_flush(output);
    if (output->used > 0) {
        write_guarded(output, output->buffer, output->used); /* half a character */
    }
    bool whole = output->is_renamed && keep && output->failure == 0;
    if (whole) {
        /* it is on the disk: after a power failure there is the old file or the new one */
        if (fsync(output->descriptor) != 0 && errno != EINVAL && errno != ENOSYS) {
            output->failure = errno; /* neither: a file system that stores nothing by itself */
        }
    }
    if (whole && output->is_nameless && output->failure == 0) {
        output->is_nameless = !name_nameless(output);
        output->failure = output->is_nameless ? errno : 0;
    }
    /* close reports what a network file system could not store */
    if (output->path != NULL && close(output->descriptor) != 0 && output->failure == 0) {
        output->failure = errno;
    }
    if (output->is_renamed) {
        output_settle(output, keep);
    }
    return output->failure == 0 || fail_written(output, error);
}
