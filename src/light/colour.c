/* light/colour.c - sRGB, XYZ, whites and Bradford's adaptation. */
/* SPDX-License-Identifier: MIT */
#include "light/colour.h"

#include <math.h>

const struct colour_matrix colour_xyz_of_srgb = {
    {{0.4124, 0.3576, 0.1805}, {0.2126, 0.7152, 0.0722}, {0.0193, 0.1192, 0.9505}}};

/* To cone responses, sharpened: [Finlayson00]. */
static const struct colour_matrix bradford = {
    {{0.8951, 0.2664, -0.1614}, {-0.7502, 1.7135, 0.0367}, {0.0389, -0.0685, 1.0296}}};

double colour_share_within(const double rgb[3], double grey, double most)
{
    double share = 1;
    for (int i = 0; i < 3; i++) {
        const double room = rgb[i] < grey ? grey : most - grey;
        const double way = fabs(rgb[i] - grey);
        share = way * share > room ? room / way : share;
    }
    return share;
}

void colour_move_from_grey(double rgb[3], double grey, double share)
{
    for (int i = 0; i < 3; i++) {
        const double moved = grey + share * (rgb[i] - grey);
        rgb[i] = moved > 0 ? moved : 0;
    }
}

struct colour colour_turned(const struct colour_matrix *matrix, struct colour colour)
{
    struct colour turned = {{0}};
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            turned.part[i] += matrix->at[i][j] * colour.part[j];
        }
    }
    return turned;
}

struct colour_matrix colour_product(const struct colour_matrix *second,
                                    const struct colour_matrix *first)
{
    struct colour_matrix product = {{{0}}};
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            for (int k = 0; k < 3; k++) {
                product.at[i][j] += second->at[i][k] * first->at[k][j];
            }
        }
    }
    return product;
}

/* The minor without row i, column j, with its sign: indices go round. */
static double matrix_cofactor(const struct colour_matrix *m, int i, int j)
{
    const int a = (i + 1) % 3, b = (i + 2) % 3, c = (j + 1) % 3, d = (j + 2) % 3;
    return m->at[a][c] * m->at[b][d] - m->at[a][d] * m->at[b][c];
}

struct colour_matrix colour_inverse(const struct colour_matrix *matrix)
{
    double determinant = 0;
    for (int j = 0; j < 3; j++) {
        determinant += matrix->at[0][j] * matrix_cofactor(matrix, 0, j);
    }
    struct colour_matrix inverse;
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            inverse.at[i][j] = matrix_cofactor(matrix, j, i) / determinant;
        }
    }
    return inverse;
}

/* -------- whites -------- */

static double cubic_polynomial(const double c[4], double x)
{
    return c[0] + x * (c[1] + x * (c[2] + x * c[3]));
}

static struct colour white_at(double x, double y)
{
    return (struct colour){{x / y, 1, (1 - x - y) / y}};
}

static struct colour daylight_xyz(double kelvin)
{
    static const double cool[4] = {0.244063, 0.09911, 2.9678, -4.6070};
    static const double blue[4] = {0.237040, 0.24748, 1.9018, -2.0064}; /* above 7000 K */
    const double x = cubic_polynomial(kelvin <= 7000 ? cool : blue, 1000 / kelvin);
    return white_at(x, x * (2.870 - 3.000 * x) - 0.275);
}

static struct colour black_body_xyz(double kelvin)
{
    static const double by_kelvin[4] = {0.179910, 0.8776956, -0.2343589, -0.2661239};
    static const double low[4] = {-0.20219683, 2.18555832, -1.34811020, -1.1063814};
    static const double high[4] = {-0.16748867, 2.09137015, -1.37418593, -0.9549476};
    const double x = cubic_polynomial(by_kelvin, 1000 / kelvin);
    return white_at(x, cubic_polynomial(kelvin <= 2222 ? low : high, x));
}

bool colour_white(double kelvin, struct colour *white, struct error *error)
{
    if (!(kelvin >= WHITE_LEAST && kelvin <= WHITE_MOST)) {
        return fail(error, ERROR_DOMAIN,
                    "the colour temperature %.6g K of white is not from %d to %d K", kelvin,
                    WHITE_LEAST, WHITE_MOST);
    }
    *white = kelvin < WHITE_DAYLIGHT ? black_body_xyz(kelvin) : daylight_xyz(kelvin);
    return true;
}

struct colour colour_tungsten(void)
{
    return white_at(0.44757, 0.40745);
}

struct colour colour_daylight(void)
{
    return colour_turned(&colour_xyz_of_srgb, (struct colour){{1, 1, 1}});
}

bool colour_balance(struct colour white, struct colour_matrix *matrix, struct error *error)
{
    const struct colour from = colour_turned(&bradford, white);
    const struct colour to = colour_turned(&bradford, colour_daylight());
    struct colour_matrix scaled = bradford;
    for (int i = 0; i < 3; i++) {
        if (!(from.part[i] > 0 && white.part[1] > 0 && from.part[i] < (double)INFINITY)) {
            return fail(error, ERROR_DOMAIN,
                        "nothing white has the colour X, Y, Z = %.6g, %.6g, %.6g", white.part[0],
                        white.part[1], white.part[2]);
        }
        for (int j = 0; j < 3; j++) {
            scaled.at[i][j] *= to.part[i] / from.part[i] * white.part[1];
        }
    }
    const struct colour_matrix back = colour_inverse(&bradford);
    const struct colour_matrix to_srgb = colour_inverse(&colour_xyz_of_srgb);
    const struct colour_matrix in_xyz = colour_product(&back, &scaled);
    const struct colour_matrix of_srgb = colour_product(&in_xyz, &colour_xyz_of_srgb);
    *matrix = colour_product(&to_srgb, &of_srgb);
    return true;
}

/* -------- other primaries -------- */

bool colour_of_primaries(const double (*primaries)[2], struct colour_matrix *matrix,
                         struct error *error)
{
    *matrix = (struct colour_matrix){{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    static const double srgb[4][2] = {{0.64, 0.33}, {0.3, 0.6}, {0.15, 0.06}, {0.3127, 0.329}};
    bool is_same = true;
    for (int i = 0; i < 8; i++) {
        is_same = is_same && fabs(primaries[i / 2][i % 2] - srgb[i / 2][i % 2]) <= 5e-4;
    }
    if (is_same) {
        return true;
    }
    struct colour_matrix xyz, balance;
    for (int j = 0; j < 3; j++) {
        const double x = primaries[j][0], y = primaries[j][1];
        const double column[3] = {x, y, 1 - x - y};
        for (int i = 0; i < 3; i++) {
            xyz.at[i][j] = column[i];
        }
    }
    const struct colour white = white_at(primaries[3][0], primaries[3][1]);
    const struct colour_matrix inverse = colour_inverse(&xyz);
    const struct colour amounts = colour_turned(&inverse, white);
    for (int j = 0; j < 3; j++) {
        if (!(amounts.part[j] > 0 && amounts.part[j] < 1e6)) {
            return fail(error, ERROR_DOMAIN,
                        "the primaries cannot make the white x, y = %.6g, %.6g", primaries[3][0],
                        primaries[3][1]);
        }
        for (int i = 0; i < 3; i++) {
            xyz.at[i][j] *= amounts.part[j];
        }
    }
    if (!colour_balance(white, &balance, error)) {
        return false;
    }
    const struct colour_matrix to_srgb = colour_inverse(&colour_xyz_of_srgb);
    const struct colour_matrix as_srgb = colour_product(&to_srgb, &xyz);
    *matrix = colour_product(&balance, &as_srgb);
    return true;
}
