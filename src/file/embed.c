/* file/embed.c - build-time program: files into a C source of const arrays. */
/* SPDX-License-Identifier: MIT */
#include <stdio.h>
#include <string.h>

/* The file's bytes as the initialiser of one array; returns their number, -1 on failure. */
static long write_array(const char *path, int index)
{
    FILE *file = fopen(path, "rb");
    if (file == NULL) {
        perror(path);
        return -1;
    }
    printf("static const char file_%d[] = {", index);
    long length = 0;
    for (int c = getc(file); c != EOF; c = getc(file)) {
        printf("%s%d,", length++ % 24 == 0 ? "\n" : "", c < 128 ? c : c - 256);
    }
    printf("0};\n\n");
    fclose(file);
    return length;
}

static const char *base_name(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash != NULL ? slash + 1 : path;
}

int main(int argc, char **argv)
{
    enum { MOST = 1000 };
    long lengths[MOST];
    if (argc > MOST) {
        fprintf(stderr, "embed: more than %d files\n", MOST - 1);
        return 1;
    }
    printf("/* Made from lensdb by file/embed.c. */\n#include \"file/embedded.h\"\n\n");
    for (int i = 1; i < argc; i++) {
        lengths[i] = write_array(argv[i], i);
        if (lengths[i] < 0) {
            return 1;
        }
    }
    printf("const struct embedded_file embedded_files[] = {\n");
    for (int i = 1; i < argc; i++) {
        printf("    {\"%s\", file_%d, %ld},\n", base_name(argv[i]), i, lengths[i]);
    }
    printf("    {0, 0, 0},\n};\n");
    return fflush(stdout) == 0 && !ferror(stdout) ? 0 : 1;
}
