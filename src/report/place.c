/* report/place.c - where a file lies that is to be written. */
/* SPDX-License-Identifier: MIT */
#include "report/place.h"

#include <errno.h>
#include <limits.h>
#include <stdint.h>
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

const char *place_of(const char *path, struct arena *arena)
{
    char target[LONGEST];
    for (int links = 0; links <= MOST_LINKS; links++) {
        ssize_t length = readlink(path, target, sizeof target - 1);
        if (length <= 0) {
            return path; /* no link, or nothing there */
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

static const char *last_name(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash != NULL ? slash + 1 : path;
}

bool place_is_same(const char *a, const char *b, struct arena *arena)
{
    struct stat first, second;
    if (strcmp(a, b) == 0) {
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
