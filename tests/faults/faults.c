/* tests/faults/faults.c - preloaded: the n-th call of a kind fails, as LENSCALC_FAULT says. */
/* SPDX-License-Identifier: MIT */
#define _GNU_SOURCE
#include <errno.h>
#include <fcntl.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/syscall.h>
#include <unistd.h>

/*
 * LENSCALC_FAULT=write:3 makes the third write fail. LENSCALC_FAULT_MARK names a file that is made
 * when it does, so that the caller knows when there are no more calls. System calls are made
 * directly, and memory is glibc's own: nothing here looks symbols up, which would allocate.
 */
enum call { MEMORY, OPEN, READ, WRITE, FSYNC, LINKAT, RENAME, CALLS };

static const struct {
    const char *name;
    int reason;
} calls[CALLS] = {
    [MEMORY] = {"memory", ENOMEM}, [OPEN] = {"open", EMFILE}, [READ] = {"read", EIO},
    [WRITE] = {"write", ENOSPC},   [FSYNC] = {"fsync", EIO},  [LINKAT] = {"linkat", EIO},
    [RENAME] = {"rename", EACCES},
};

static atomic_long counts[CALLS];
static long wanted[CALLS]; /* 0: none fails */

__attribute__((constructor)) static void begin(void)
{
    const char *fault = getenv("LENSCALC_FAULT");
    for (int i = 0; fault != NULL && i < CALLS; i++) {
        const size_t length = strlen(calls[i].name);
        if (strncmp(fault, calls[i].name, length) == 0 && fault[length] == ':') {
            wanted[i] = strtol(fault + length + 1, NULL, 10);
        }
    }
}

/* Is this the one? Then errno is set. */
static bool fails(enum call call)
{
    if (wanted[call] == 0 || atomic_fetch_add(&counts[call], 1) + 1 != wanted[call]) {
        return false;
    }
    const char *mark = getenv("LENSCALC_FAULT_MARK");
    if (mark != NULL) {
        const long file = syscall(SYS_openat, AT_FDCWD, mark, O_WRONLY | O_CREAT, 0600);
        if (file >= 0) {
            syscall(SYS_close, (int)file);
        }
    }
    errno = calls[call].reason;
    return true;
}

extern void *__libc_malloc(size_t size);
extern void *__libc_calloc(size_t count, size_t size);
extern void *__libc_realloc(void *memory, size_t size);

void *malloc(size_t size)
{
    return fails(MEMORY) ? NULL : __libc_malloc(size);
}

void *calloc(size_t count, size_t size)
{
    return fails(MEMORY) ? NULL : __libc_calloc(count, size);
}

void *realloc(void *memory, size_t size)
{
    return fails(MEMORY) ? NULL : __libc_realloc(memory, size);
}

static int open_from(int folder, const char *path, int flags, mode_t mode)
{
    return fails(OPEN) ? -1 : (int)syscall(SYS_openat, folder, path, flags, mode);
}

#define MODE_OF(flags, mode)                                                                       \
    va_list arguments;                                                                             \
    va_start(arguments, flags);                                                                    \
    const mode_t mode =                                                                            \
        ((flags) & (O_CREAT | O_TMPFILE)) != 0 ? (mode_t)va_arg(arguments, unsigned) : 0;          \
    va_end(arguments)

int open(const char *path, int flags, ...)
{
    MODE_OF(flags, mode);
    return open_from(AT_FDCWD, path, flags, mode);
}

int open64(const char *path, int flags, ...) __attribute__((alias("open")));

int openat(int folder, const char *path, int flags, ...)
{
    MODE_OF(flags, mode);
    return open_from(folder, path, flags, mode);
}

int openat64(int folder, const char *path, int flags, ...) __attribute__((alias("openat")));

ssize_t read(int file, void *to, size_t length)
{
    return fails(READ) ? -1 : syscall(SYS_read, file, to, length);
}

ssize_t pread(int file, void *to, size_t length, off_t at)
{
    return fails(READ) ? -1 : syscall(SYS_pread64, file, to, length, at);
}

ssize_t pread64(int file, void *to, size_t length, off_t at) __attribute__((alias("pread")));

ssize_t write(int file, const void *from, size_t length)
{
    return fails(WRITE) ? -1 : syscall(SYS_write, file, from, length);
}

int fsync(int file)
{
    return fails(FSYNC) ? -1 : (int)syscall(SYS_fsync, file);
}

int linkat(int from_folder, const char *from, int to_folder, const char *to, int flags)
{
    return fails(LINKAT) ? -1 : (int)syscall(SYS_linkat, from_folder, from, to_folder, to, flags);
}

int rename(const char *from, const char *to)
{
    return fails(RENAME) ? -1 : (int)syscall(SYS_renameat2, AT_FDCWD, from, AT_FDCWD, to, 0);
}
