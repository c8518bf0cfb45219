/* photo/dof_problem.c - what is known, unknown and asked for when a depth of field is solved. */
/* SPDX-License-Identifier: MIT */
#include "photo/dof_problem.h"

#include <math.h>

#include "photo/given.h"

/* The bits of a set by the names of their quantities. */
struct bit_word {
    unsigned bit;
    const char *word;
};

static const struct bit_word unknown_words[] = {{FOCAL, "focal length"},
                                                {FNUMBER, "f-number"},
                                                {DISTANCE, "distance"},
                                                {COC, "circle of confusion"}};

static const struct bit_word target_words[] = {{NEAR, "near limit"},
                                               {FAR, "far limit"},
                                               {TOTAL, "depth of field"},
                                               {HYPERFOCAL, "hyperfocal distance"},
                                               {MAGNIFICATION, "magnification"}};

enum { UNKNOWN_WORDS = 4, TARGET_WORDS = 5 };

unsigned problem_count(unsigned set)
{
    unsigned count = 0;
    for (; set; set &= set - 1) {
        count++;
    }
    return count;
}

/* Put the names of a set before the message, "near limit, far limit"; "nothing" for no name. */
static void prefix_list(struct error *error, const struct bit_word *words, int count, unsigned set)
{
    const char *behind = "";
    if (set == 0) {
        error_prefix(error, "nothing");
    }
    for (int i = count - 1; i >= 0; i--) {
        if (set & words[i].bit) {
            error_prefix(error, "{%s}%s", words[i].word, behind);
            behind = ", ";
        }
    }
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
    unsigned wanted = problem_count(p->unknown), have = problem_count(p->open);
    if (wanted == have) {
        return true;
    }
    if (have > wanted) {
        fail(error, ERROR_USAGE, ", or a setting that shall be found");
        prefix_list(error, target_words, TARGET_WORDS, p->open);
        return error_prefix(error, "nothing is left to solve for: leave out ");
    }
    if (have > 0) {
        fail(error, ERROR_USAGE, " alone: give %u of them, or more that is wanted", wanted - have);
        prefix_list(error, target_words, TARGET_WORDS, p->open);
        error_prefix(error, " cannot be found from ");
        prefix_list(error, unknown_words, UNKNOWN_WORDS, p->unknown);
        return false;
    }
    fail(error, ERROR_USAGE,
         " missing: give %s, or say what is wanted by {near limit}, {far limit}, {depth of field}, "
         "{hyperfocal distance} or {magnification}",
         problem_count(p->unknown) > 1 ? "them" : "it");
    prefix_list(error, unknown_words, UNKNOWN_WORDS, p->unknown);
    return false;
}

bool problem_undetermined(const struct problem *p, struct error *error)
{
    if ((p->unknown & PRODUCT) == PRODUCT) {
        return fail(error, ERROR_USAGE,
                    "{f-number} and {circle of confusion} act as a product only: give one of them");
    }
    fail(error, ERROR_USAGE, " and the other settings");
    prefix_list(error, target_words, TARGET_WORDS, p->open);
    error_prefix(error, " cannot be found from ");
    prefix_list(error, unknown_words, UNKNOWN_WORDS, p->unknown);
    return false;
}

bool problem_check_targets(const struct dof_targets *t, struct error *error)
{
    if (t->near >= t->far) {
        return fail(error, ERROR_DOMAIN,
                    "{near limit} %.15g mm must lie before {the far limit} %.15g mm", t->near,
                    t->far);
    }
    const struct given finite[] = {{"near limit", " mm", t->near},
                                   {"hyperfocal distance", " mm", t->hyperfocal}};
    const struct given others[] = {{"far limit", " mm", t->far},
                                   {"depth of field", " mm", t->total}};
    return given_above_0(others, 2, error) && given_positive(finite, 2, error) &&
           (isnan(t->magnification) ||
            check_not_negative("magnification", "", t->magnification, error));
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
        return fail(error, ERROR_DOMAIN, "{distance} %.15g mm must be above 0 mm", a.s);
    }
    if (!(a.c > 0) && ((p->unknown & FNUMBER) || problem_has(p, HYPERFOCAL))) {
        return fail(error, ERROR_DOMAIN,
                    "{circle of confusion} %.15g mm must be above 0 mm to have a depth of field",
                    a.c);
    }
    if (a.s == INFINITY && !(p->unknown & DISTANCE) && problem_has(p, MAGNIFICATION)) {
        return fail(error, ERROR_DOMAIN,
                    "{distance} inf has magnification 0 with every lens: it must be finite");
    }
    return dof_check(&a, error);
}

/* A limit of the depth of field that has no real image, or lies on the wrong side. */
bool problem_check_limits(const struct problem *p, struct error *error)
{
    if (!(p->unknown & FOCAL) && p->t.near <= p->a.f) {
        return fail(error, ERROR_DOMAIN,
                    "{near limit} %.15g mm lies within {the focal length} %.15g mm: no real image",
                    p->t.near, p->a.f);
    }
    if (!(p->unknown & DISTANCE) && p->t.near >= p->a.s) {
        return fail(error, ERROR_DOMAIN,
                    "{near limit} %.15g mm must lie before {the distance} %.15g mm", p->t.near,
                    p->a.s);
    }
    if (!(p->unknown & DISTANCE) && p->t.far <= p->a.s && p->a.s < INFINITY) {
        return fail(error, ERROR_DOMAIN,
                    "{far limit} %.15g mm must lie behind {the distance} %.15g mm", p->t.far,
                    p->a.s);
    }
    if (!(p->unknown & FOCAL) && p->t.far <= p->a.f) {
        return fail(error, ERROR_DOMAIN,
                    "{far limit} %.15g mm lies within {the focal length} %.15g mm: no real image",
                    p->t.far, p->a.f);
    }
    return (p->unknown & FOCAL) || !(p->t.hyperfocal <= p->a.f) ||
           fail(error, ERROR_DOMAIN,
                "{hyperfocal distance} %.15g mm must be above {the focal length} %.15g mm",
                p->t.hyperfocal, p->a.f);
}
