/* report/place.c - where a file lies that is to be written. */
/* SPDX-License-Identifier: MIT */
#ifdef __linux__
#define _XOPEN_SOURCE 700 /* realpath, in POSIX but not in glibc's narrowest */
#endif
#include "report/place.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

enum { MOST_LINKS = 40, LONGEST = 4096 }; /* as Linux has it */

const char *place_folder(const char *path, struct arena *arena)
{
    const char *slash = strrchr(path, '/');
    if (slash == NULL) {
        return ".";
    }
    return slash == path ? "/" : arena_string(arena, path, (size_t)(slash - path));
}

static const char *last_name(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash != NULL ? slash + 1 : path;
}

/* Names that all mean one folder, as that of the descriptors, made one. */
static const char *real_folder(const char *folder, struct arena *arena)
{
    char *real = realpath(folder, NULL);
    const char *kept = real != NULL ? arena_string(arena, real, strlen(real)) : "";
    free(real);
    return kept;
}

int place_descriptor(const char *path, struct arena *arena)
{
    static const char own[] = "/dev/fd"; /* on Linux a link to /proc/self/fd */
    const char *number = last_name(path);
    const size_t length = strspn(number, "0123456789");
    if (length == 0 || number[length] != '\0' || length > 9) {
        return PLACE_CLOSED; /* as most names, at no cost */
    }
    const char *folder = real_folder(place_folder(path, arena), arena);
    if (folder[0] == '\0') {
        return PLACE_CLOSED; /* nowhere */
    }
    if (strcmp(folder, own) == 0 || strcmp(folder, real_folder(own, arena)) == 0) {
        return (int)strtol(number, NULL, 10);
    }
    const bool is_open = strncmp(folder, "/proc/", 6) == 0 && strcmp(last_name(folder), "fd") == 0;
    return is_open ? PLACE_FOREIGN : PLACE_CLOSED;
}

const char *place_of(const char *path, struct arena *arena)
{
    char target[LONGEST];
    for (int links = 0; links <= MOST_LINKS; links++) {
        ssize_t length = readlink(path, target, sizeof target - 1);
        if (length <= 0 || place_descriptor(path, arena) != PLACE_CLOSED) {
            return path; /* no link, or nothing there; or open */
        }
        target[length] = '\0';
        path = target[0] == '/' || strchr(path, '/') == NULL
                   ? arena_string(arena, target, (size_t)length)
                   : arena_printf(arena, "%s/%s", place_folder(path, arena), target);
    }
    return NULL;
}

static bool is_one(const struct stat *a, const struct stat *b)
{
    return a->st_dev == b->st_dev && a->st_ino == b->st_ino;
}

bool place_is_standard(const char *path, struct arena *arena)
{
    if (path == NULL || strcmp(path, "-") == 0) {
        return true;
    }
    const char *place = place_of(path, arena);
    return place != NULL && place_descriptor(place, arena) == STDOUT_FILENO;
}

/* The descriptor that a name stands for, standard output's "-" among them. */
static int open_as(const char *path, struct arena *arena)
{
    const char *place = place_of(path, arena);
    if (place_is_standard(path, arena)) {
        return STDOUT_FILENO;
    }
    if (place != NULL) {
        return place_descriptor(place, arena);
    }
    return PLACE_CLOSED;
}

bool place_is_file(const char *path, struct arena *arena)
{
    struct stat found;
    const char *place = place_of(path, arena);
    return place != NULL && place_descriptor(place, arena) == PLACE_CLOSED &&
           stat(place, &found) == 0 && S_ISREG(found.st_mode);
}

bool place_is_same(const char *a, const char *b, struct arena *arena)
{
    struct stat first, second;
    const int open_a = open_as(a, arena);
    if (strcmp(a, b) == 0 || (open_a >= 0 && open_a == open_as(b, arena))) {
        return true;
    }
    if (stat(a, &first) == 0 && stat(b, &second) == 0) {
        return S_ISREG(first.st_mode) && is_one(&first, &second);
    }
    a = place_of(a, arena);
    b = place_of(b, arena);
    return a != NULL && b != NULL && strcmp(last_name(a), last_name(b)) == 0 &&
           stat(place_folder(a, arena), &first) == 0 &&
           stat(place_folder(b, arena), &second) == 0 && is_one(&first, &second);
}

const char *place_beside(const char *path, unsigned attempt, struct arena *arena)
{
    struct timespec now = {0};
    clock_gettime(CLOCK_MONOTONIC, &now);
    uint64_t chance = (uint64_t)now.tv_nsec + ((uint64_t)getpid() << 32) + attempt;
    /* SplitMix64's finisher: neighbouring times and processes have names far apart */
    chance = (chance ^ (chance >> 30)) * 0xbf58476d1ce4e5b9u;
    chance = (chance ^ (chance >> 27)) * 0x94d049bb133111ebu;
    chance ^= chance >> 31;
    return arena_printf(arena, "%s/.lenscalc-%012llx", place_folder(path, arena),
                        (unsigned long long)(chance & 0xffffffffffffu));
}
