/* data/embed.c - build-time program: files into a C source of const arrays. */
/* SPDX-License-Identifier: MIT */
#include "data/embedded.h"

#include <ctype.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_FILES = 1000, MOST_GLASSES = 100000 };

struct source {
    const char *path, *name;
    char *data;
    size_t length, rows;
    long line;
};

static bool embed_read_file(struct source *source)
{
    FILE *file = fopen(source->path, "rb");
    if (file == NULL) {
        perror(source->path);
        return false;
    }
    size_t capacity = 1 << 16;
    source->data = malloc(capacity + 1);
    while (source->data != NULL) {
        source->length += fread(source->data + source->length, 1, capacity - source->length, file);
        if (source->length < capacity) {
            break;
        }
        capacity *= 2;
        source->data = realloc(source->data, capacity + 1);
    }
    bool good = source->data != NULL && !ferror(file);
    fclose(file);
    if (good) {
        source->data[source->length] = '\0';
    }
    return good;
}

/* The path inside lensdb. */
static const char *inner_name(const char *path)
{
    const char *folder = strstr(path, "lensdb/");
    const char *slash = strrchr(path, '/');
    if (folder != NULL) {
        return folder + strlen("lensdb/");
    }
    if (slash != NULL) {
        return slash + 1;
    }
    return path;
}

/* The name in the first cell without what does not count in names. */
static bool embed_make_key(const char *row, char *key)
{
    size_t used = 0;
    for (; *row != '\t' && *row != '\n' && *row != '\0'; row++) {
        if (strchr(" -_", *row) == NULL) {
            if (used + 1 >= EMBEDDED_KEY) {
                return false;
            }
            key[used++] = (char)tolower((unsigned char)*row);
        }
    }
    return used > 0;
}

static int embed_by_key(const void *left, const void *right)
{
    const struct embedded_glass *a = left, *b = right;
    int order = strcmp(a->key, b->key);
    if (order == 0) {
        order = a->file != b->file ? (a->file > b->file) - (a->file < b->file)
                                   : (a->offset > b->offset) - (a->offset < b->offset);
    }
    return order;
}

/* Index the rows of one catalogue of glasses. */
static bool index_glasses(const struct source *source, unsigned file, struct embedded_glass *all,
                          size_t *count)
{
    long line = source->line;
    for (const char *at = source->data + source->rows; *at != '\0';) {
        struct embedded_glass *glass = &all[*count];
        const char *stop = strchr(at, '\n');
        line++;
        if (*at != '#' && *at != '\n') {
            glass->file = file;
            glass->offset = (unsigned)(at - source->data);
            glass->line = (unsigned)line;
            if (*count + 1 >= MOST_GLASSES || !embed_make_key(at, glass->key)) {
                fprintf(stderr, "%s:%ld: bad name of a glass\n", source->path, line);
                return false;
            }
            ++*count;
        }
        at = stop != NULL ? stop + 1 : at + strlen(at);
    }
    return true;
}

int main(int argc, char **argv)
{
    static struct source sources[MOST_FILES];
    static struct embedded_glass glasses[MOST_GLASSES];
    size_t glass_count = 0;
    if (argc > MOST_FILES) {
        fprintf(stderr, "embed: more than %d files\n", MOST_FILES - 1);
        return 1;
    }
    printf("/* Made from lensdb by data/embed.c. */\n#include \"data/embedded.h\"\n\n");
    for (int i = 1; i < argc; i++) {
        struct source *source = &sources[i];
        source->path = argv[i];
        source->name = inner_name(argv[i]);
        if (!embed_read_file(source)) {
            return 1;
        }
        /* Where the rows begin: behind the first line that is neither blank nor a comment. */
        const char *at = source->data, *end = at + source->length;
        for (bool names = false; at < end && !names;) {
            names = *at != '#' && *at != '\n';
            source->line++;
            const char *stop = memchr(at, '\n', (size_t)(end - at));
            at = stop != NULL ? stop + 1 : end;
        }
        source->rows = (size_t)(at - source->data);
        printf("static const char file_%d[] = {", i);
        for (size_t k = 0; k < source->length; k++) {
            unsigned byte = (unsigned char)source->data[k];
            /* beyond ASCII a character constant, which fits a char with a sign or without */
            printf(byte < 128 ? "%s%u," : "%s'\\%o',", k % 24 == 0 ? "\n" : "", byte);
        }
        printf("0};\n\n");
        if (strncmp(source->name, "glass/", 6) == 0 &&
            !index_glasses(source, (unsigned)(i - 1), glasses, &glass_count)) {
            return 1;
        }
    }
    printf("const struct embedded_file embedded_files[] = {\n");
    for (int i = 1; i < argc; i++) {
        const struct source *source = &sources[i];
        printf("    {\"%s\", file_%d, %zu, %zu, %ld},\n", source->name, i, source->length,
               source->rows, source->line);
    }
    printf("    {0, 0, 0, 0, 0},\n};\n\n");
    qsort(glasses, glass_count, sizeof glasses[0], embed_by_key);
    printf("const size_t embedded_glass_count = %zu;\n", glass_count);
    printf("const struct embedded_glass embedded_glasses[] = {\n");
    for (size_t i = 0; i < glass_count; i++) {
        printf("    {\"%s\", %u, %u, %u},\n", glasses[i].key, glasses[i].file, glasses[i].offset,
               glasses[i].line);
    }
    printf("    {\"\", 0, 0, 0},\n};\n");
    return fflush(stdout) == 0 && !ferror(stdout) ? 0 : 1;
}
