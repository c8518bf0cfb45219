/* tests/unit/all.c - the tests of a folder in one program, which runs the one it is called by. */
/* SPDX-License-Identifier: MIT */
#include <stdio.h>
#include <string.h>

/* make lists TEST(name) for each, and calls their mains main_of_NAME. */
#define TEST(name) int main_of_##name(void);
#include "tests.list"
#undef TEST
#define TEST(name) {#name, main_of_##name},

static const struct {
    const char *name;
    int (*run)(void);
} tests[] = {
#include "tests.list"
};

int main(int count, char **words)
{
    const char *const slash = count > 0 ? strrchr(words[0], '/') : NULL;
    const char *const name = slash != NULL ? slash + 1 : count > 0 ? words[0] : "";
    for (size_t i = 0; i < sizeof tests / sizeof *tests; i++) {
        if (strcmp(tests[i].name, name) == 0) {
            return tests[i].run();
        }
    }
    printf("no test goes by the name '%s'\n0 passed, 1 failed\n", name);
    return 2;
}
