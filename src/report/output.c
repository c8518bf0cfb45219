/* report/output.c - buffered writing to standard output or to a file that appears whole. */
/* SPDX-License-Identifier: MIT */
#ifdef __linux__
#define _GNU_SOURCE /* O_TMPFILE */
#endif
#include "report/output.h"

#include <errno.h>
#include <fcntl.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { BUFFER_SIZE = 64 * 1024 };

/* Write to a device or pipe directly: there is nothing to rename. */
static bool is_plain_or_new(const char *path)
{
    struct stat status;
    return stat(path, &status) != 0 || S_ISREG(status.st_mode);
}

/* The permissions that a file of this name has or would get. */
static mode_t mode_of(const char *path)
{
    struct stat status;
    mode_t mask = umask(0);
    umask(mask);
    return stat(path, &status) == 0 ? status.st_mode & 07777 : 0666 & ~mask;
}

/*
 * A file without a name in the folder of `path`: whatever ends the program, nothing of it is left.
 * -1 where the system knows no such files.
 */
static int open_nameless(const char *path, struct arena *arena)
{
#ifdef O_TMPFILE
    const char *slash = strrchr(path, '/');
    const char *folder = slash == NULL   ? "."
                         : slash == path ? "/"
                                         : arena_string(arena, path, (size_t)(slash - path));
    if (access("/proc/self/fd", F_OK) == 0) {
        return open(folder, O_TMPFILE | O_WRONLY | O_CLOEXEC, 0600);
    }
#else
    (void)path;
    (void)arena;
#endif
    return -1;
}

/* Give the nameless file the name `beside`, so that it can be renamed to its path. */
static bool name_nameless(const struct output *output)
{
    char link[64];
    snprintf(link, sizeof link, "/proc/self/fd/%d", output->descriptor);
    return linkat(AT_FDCWD, link, AT_FDCWD, output->beside, AT_SYMLINK_FOLLOW) == 0;
}

/* A new file that becomes `path` at the end. */
static int open_beside(struct output *output, const char *path, struct arena *arena)
{
    int descriptor = open_nameless(path, arena);
    output->is_nameless = descriptor >= 0;
    if (output->is_nameless) {
        output->beside = arena_printf(arena, "%s.%ld", path, (long)getpid());
    } else {
        output->beside = arena_printf(arena, "%s.XXXXXX", path);
        descriptor = mkstemp(output->beside);
    }
    if (descriptor >= 0) {
        /* a file system without permissions is no reason to fail */
        (void)!fchmod(descriptor, mode_of(path));
    }
    return descriptor;
}

void output_begin(struct output *output, int descriptor, struct arena *arena)
{
    *output = (struct output){.descriptor = descriptor, .size = BUFFER_SIZE};
    output->buffer = arena_buffer(arena, BUFFER_SIZE);
}

bool output_open(struct output *output, const char *path, struct arena *arena, struct error *error)
{
    output_begin(output, STDOUT_FILENO, arena);
    if (path == NULL || strcmp(path, "-") == 0) {
        return true;
    }
    output->path = path;
    /* what a link points to is written, not the link replaced */
    char *target = realpath(path, NULL);
    if (target != NULL) {
        output->path = path = arena_string(arena, target, strlen(target));
        free(target);
    }
    output->descriptor =
        is_plain_or_new(path) ? open_beside(output, path, arena) : open(path, O_WRONLY | O_CLOEXEC);
    if (output->descriptor < 0) {
        return fail(error, ERROR_IO, "cannot write %s: %s", path, strerror(errno));
    }
    return true;
}

static void write_all(struct output *output, const char *start, size_t length)
{
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

void output_flush(struct output *output)
{
    write_all(output, output->buffer, output->used);
    output->used = 0;
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

void output_spaces(struct output *output, size_t count)
{
    while (count-- > 0) {
        output_character(output, ' ');
    }
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

/* Put the whole file in its place; take one away that is not to be kept. */
static void settle(struct output *output, bool keep)
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

bool output_close(struct output *output, bool keep, struct error *error)
{
    output_flush(output);
    if (output->is_nameless && keep && output->failure == 0) {
        output->is_nameless = !name_nameless(output);
        output->failure = output->is_nameless ? errno : 0;
    }
    /* close reports what a network file system could not store */
    if (output->path != NULL && close(output->descriptor) != 0 && output->failure == 0) {
        output->failure = errno;
    }
    if (output->beside != NULL) {
        settle(output, keep);
    }
    if (output->failure != 0) {
        return fail(error, ERROR_IO, "cannot write %s: %s",
                    output->path != NULL ? output->path : "to standard output",
                    strerror(output->failure));
    }
    return true;
}
