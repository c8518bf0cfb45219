/* tests/fuzz/replay.c - the fuzz targets on the inputs that are kept: replay tests/fuzz. */
/* SPDX-License-Identifier: MIT */
#define _GNU_SOURCE /* scandir of the BSDs */
#include "fuzz.h"

#include <dirent.h>
#include <sys/wait.h>
#include <unistd.h>

/* Each target's LLVMFuzzerTestOneInput is compiled by a name of its own. */
#define TARGETS(X)                                                                                 \
    X(agf)                                                                                         \
    X(batch)                                                                                       \
    X(command)                                                                                     \
    X(config)                                                                                      \
    X(exif)                                                                                        \
    X(glass) X(image) X(import) X(lens) X(odd) X(part) X(quantity) X(range) X(scene) X(tsv)
#define DECLARE(name) int replay_##name(const uint8_t *data, size_t size);
#define ENTER(name)   {#name, replay_##name},

TARGETS(DECLARE)

static const struct target {
    const char *name;
    int (*run)(const uint8_t *data, size_t size);
} targets[] = {TARGETS(ENTER)};

static const char *const folders[] = {"corpus", "crashers"};

enum { MOST_SECONDS = 60, MOST_BYTES = 1 << 20 };

/* Where there is no sanitizer that reports. */
__attribute__((weak)) void __sanitizer_set_report_fd(void *file);
__attribute__((weak)) void __sanitizer_set_report_fd(void *file)
{
    (void)file;
}

static _Noreturn void run(const struct target *target, const char *path)
{
    FILE *file = fopen(path, "rb");
    uint8_t *data = malloc(MOST_BYTES);
    REQUIRE(file != NULL && data != NULL);
    const size_t size = fread(data, 1, MOST_BYTES, file);
    fclose(file);
    alarm(MOST_SECONDS);
    target->run(data, size);
    free(data);
    _exit(0);
}

/* In a process of its own, which may crash. */
static bool stands(const struct target *target, const char *path)
{
    int status = -1;
    fflush(stdout);
    const pid_t child = fork();
    if (child == 0) {
        run(target, path);
    }
    return child > 0 && waitpid(child, &status, 0) == child && status == 0;
}

static int is_shown(const struct dirent *entry)
{
    return entry->d_name[0] != '.';
}

int main(int argc, char **argv)
{
    int passed = 0, failed = 0;
    for (size_t i = 0; argc == 2 && i < sizeof targets / sizeof targets[0]; i++) {
        for (size_t k = 0; k < sizeof folders / sizeof folders[0]; k++) {
            char folder[1024], path[2048];
            struct dirent **entries = NULL;
            snprintf(folder, sizeof folder, "%s/%s/%s", argv[1], folders[k], targets[i].name);
            const int count = scandir(folder, &entries, is_shown, alphasort);
            for (int n = 0; n < count; n++) {
                snprintf(path, sizeof path, "%s/%s", folder, entries[n]->d_name);
                const bool good = stands(&targets[i], path);
                passed += good;
                failed += !good;
                printf("%s%s%s", good ? "" : "FAILED fuzz_", good ? "" : targets[i].name,
                       good ? "" : ": ");
                printf("%s%s", good ? "" : path, good ? "" : "\n");
                free(entries[n]);
            }
            free(entries);
        }
    }
    failed += passed == 0; /* there are no inputs */
    printf("%d passed, %d failed\n", passed, failed);
    return failed != 0;
}
