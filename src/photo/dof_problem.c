/* photo/dof_problem.c - what is known, unknown and asked for when a depth of field is solved. */
/* SPDX-License-Identifier: MIT */
#include "photo/dof_problem.h"

#include <math.h>
#include <string.h>

/* The bits of a set, as the options that a user knows. */
struct bit_word {
    unsigned bit;
    const char *word;
};

static const struct bit_word unknown_words[] = {
    {FOCAL, "--focal-length"}, {FNUMBER, "--aperture"}, {DISTANCE, "--distance"}, {COC, "--coc"}};

static const struct bit_word target_words[] = {{NEAR, "--near"},
                                               {FAR, "--far"},
                                               {TOTAL, "--dof"},
                                               {HYPERFOCAL, "--hyperfocal"},
                                               {MAGNIFICATION, "--magnification"}};

enum { UNKNOWN_WORDS = 4, TARGET_WORDS = 5, LIST_LENGTH = 96 };

unsigned problem_count(unsigned set)
{
    unsigned count = 0;
    for (; set; set &= set - 1) {
        count++;
    }
    return count;
}

/* Write the words of a set, "--near, --far"; "nothing" for the empty one. */
static const char *list(char to[LIST_LENGTH], const struct bit_word *words, int count, unsigned set)
{
    to[0] = '\0';
    for (int i = 0; i < count; i++) {
        if (!(set & words[i].bit)) {
            continue;
        }
        if (to[0]) {
            strncat(to, ", ", LIST_LENGTH - strlen(to) - 1);
        }
        strncat(to, words[i].word, LIST_LENGTH - strlen(to) - 1);
    }
    return to[0] ? to : "nothing";
}

bool problem_has(const struct problem *p, unsigned targets)
{
    return (p->open & targets) == targets;
}

void problem_collect(struct problem *p)
{
    const double setting[UNKNOWN_WORDS] = {p->a.f, p->a.N, p->a.s, p->a.c};
    const double target[TARGET_WORDS] = {p->t.near, p->t.far, p->t.total, p->t.hyperfocal,
                                         p->t.magnification};
    for (int i = 0; i < UNKNOWN_WORDS; i++) {
        p->unknown |= isnan(setting[i]) ? unknown_words[i].bit : 0;
    }
    for (int i = 0; i < TARGET_WORDS; i++) {
        p->open |= isnan(target[i]) ? 0 : target_words[i].bit;
    }
}

/* Too many or too few targets for the unknowns. */
bool problem_check_count(const struct problem *p, struct error *error)
{
    char unknown[LIST_LENGTH], given[LIST_LENGTH];
    unsigned wanted = problem_count(p->unknown), have = problem_count(p->open);
    if (wanted == have) {
        return true;
    }
    list(unknown, unknown_words, UNKNOWN_WORDS, p->unknown);
    list(given, target_words, TARGET_WORDS, p->open);
    if (have > wanted) {
        return fail(error, ERROR_USAGE,
                    "nothing is left to solve for: leave out %s, or a setting that shall be "
                    "found",
                    given);
    }
    return fail(error, ERROR_USAGE,
                "%s missing: give %s, or say what is wanted by --near, --far, --dof, --hyperfocal "
                "or --magnification",
                unknown, problem_count(p->unknown) > 1 ? "them" : "it");
}

bool problem_undetermined(const struct problem *p, struct error *error)
{
    char unknown[LIST_LENGTH], given[LIST_LENGTH];
    if ((p->unknown & PRODUCT) == PRODUCT) {
        return fail(error, ERROR_USAGE,
                    "--aperture and --coc act as a product only: give one of them");
    }
    list(unknown, unknown_words, UNKNOWN_WORDS, p->unknown);
    list(given, target_words, TARGET_WORDS, p->open);
    return fail(error, ERROR_USAGE, "%s cannot be found from %s and the other settings", unknown,
                given);
}

static bool check_target(double x, bool legal, const char *name, const char *range,
                         struct error *error)
{
    if (isnan(x) || legal) {
        return true;
    }
    return fail(error, ERROR_DOMAIN, "%s %.15g must be %s", name, x, range);
}

bool problem_check_targets(const struct dof_targets *t, struct error *error)
{
    if (t->near >= t->far) {
        return fail(error, ERROR_DOMAIN,
                    "near limit %.15g mm must lie before the far limit %.15g mm", t->near, t->far);
    }
    return check_target(t->near, t->near > 0 && t->near < INFINITY, "near limit, mm,",
                        "above 0 and finite", error) &&
           check_target(t->far, t->far > 0, "far limit, mm,", "above 0", error) &&
           check_target(t->total, t->total > 0, "depth of field, mm,", "above 0", error) &&
           check_target(t->hyperfocal, t->hyperfocal > 0 && t->hyperfocal < INFINITY,
                        "hyperfocal distance, mm,", "above 0 and finite", error) &&
           check_target(t->magnification, t->magnification >= 0 && t->magnification < INFINITY,
                        "magnification", "0 or more and finite", error);
}

/* The unknown settings replaced by something legal. */
static struct dof_setting made_legal(const struct problem *p)
{
    struct dof_setting a = p->a;
    if (p->unknown & FOCAL) {
        a.f = a.s < INFINITY && a.s > 0 ? a.s / 2 : 1;
    }
    if (p->unknown & FNUMBER) {
        a.N = 1;
    }
    if (p->unknown & DISTANCE) {
        a.s = INFINITY;
    }
    if (p->unknown & COC) {
        a.c = 1;
    }
    return a;
}

bool problem_check_known(const struct problem *p, struct error *error)
{
    const struct dof_setting a = made_legal(p);
    if (!(p->unknown & DISTANCE) && (p->unknown & FOCAL) && !(a.s > 0)) {
        return fail(error, ERROR_DOMAIN, "distance %.15g mm must be above 0 mm", a.s);
    }
    if (!(a.c > 0) && ((p->unknown & FNUMBER) || problem_has(p, HYPERFOCAL))) {
        return fail(error, ERROR_DOMAIN,
                    "circle of confusion %.15g mm must be above 0 mm to have a depth of field",
                    a.c);
    }
    if (a.s == INFINITY && !(p->unknown & DISTANCE) && problem_has(p, MAGNIFICATION)) {
        return fail(error, ERROR_DOMAIN,
                    "distance inf has magnification 0 with every lens: it must be finite");
    }
    return dof_check(&a, error);
}

/* A limit of the depth of field that has no real image, or lies on the wrong side. */
bool problem_check_limits(const struct problem *p, struct error *error)
{
    if (!(p->unknown & FOCAL) && p->t.near <= p->a.f) {
        return fail(error, ERROR_DOMAIN,
                    "near limit %.15g mm lies within the focal length %.15g mm: no real image",
                    p->t.near, p->a.f);
    }
    if (!(p->unknown & DISTANCE) && p->t.near >= p->a.s) {
        return fail(error, ERROR_DOMAIN,
                    "near limit %.15g mm must lie before the distance %.15g mm", p->t.near, p->a.s);
    }
    if (!(p->unknown & DISTANCE) && p->t.far <= p->a.s && p->a.s < INFINITY) {
        return fail(error, ERROR_DOMAIN, "far limit %.15g mm must lie behind the distance %.15g mm",
                    p->t.far, p->a.s);
    }
    if (!(p->unknown & FOCAL) && p->t.far <= p->a.f) {
        return fail(error, ERROR_DOMAIN,
                    "far limit %.15g mm lies within the focal length %.15g mm: no real image",
                    p->t.far, p->a.f);
    }
    if (!(p->unknown & FOCAL) && p->t.hyperfocal <= p->a.f) {
        return fail(error, ERROR_DOMAIN,
                    "hyperfocal distance %.15g mm must be above the focal length %.15g mm",
                    p->t.hyperfocal, p->a.f);
    }
    return true;
}
