/* exchange/zemax/zemax_tail.c - what stands behind the surfaces of a .zmx. */
/* SPDX-License-Identifier: MIT */
#include "exchange/zemax/zemax_keyword.h"

static bool read_configurations(struct zemax_file *file, struct text keyword, struct error *error)
{
    const struct zemax_line *line = zemax_line_of(file, keyword, NUMBER_UNSCALED);
    double count = zemax_number(line, 0);
    if (!(count >= 1 && count <= ZEMAX_CONFIGURATIONS)) {
        return lens_words_fail(&file->words, keyword, error,
                               "MNUM wants the number of configurations, 1 to %d",
                               ZEMAX_CONFIGURATIONS);
    }
    file->configurations = (size_t)count;
    file->in_tail = true;
    return true;
}

static bool read_setting(struct zemax_file *file, struct text keyword, struct error *error)
{
    struct number_scale unit = text_same(keyword, "THIC") || text_same(keyword, "SDIA")
                                   ? file->words.scale
                                   : NUMBER_UNSCALED;
    const struct zemax_line *line = zemax_line_of(file, keyword, NUMBER_UNSCALED);
    if (file->configurations < 2) {
        return true; /* the only configuration has these values already */
    }
    double surface = zemax_number(line, 0), configuration = zemax_number(line, 1);
    if (line->count < 2 || !(surface >= 0 && surface <= ZEMAX_SURFACES) ||
        !(configuration >= 1 && configuration <= (double)file->configurations)) {
        return lens_words_fail(&file->words, keyword, error,
                               "%.4s wants a surface, a configuration and its value",
                               keyword.start);
    }
    struct zemax_line *own = zemax_line_of(file, keyword, unit);
    struct zemax_setting *setting = ARENA_NEW(file->job->arena, struct zemax_setting);
    *setting = (struct zemax_setting){own, (long)surface, (long)configuration, NULL};
    if (file->last_setting != NULL) {
        file->last_setting->next = setting;
    } else {
        file->settings = setting;
    }
    file->last_setting = setting;
    return true;
}

/* Operands of the merit function: what the optimiser wants says nothing about the lens. */
static const char *const operands[] = {
    "ABCD", "ABGT", "ABLT", "ABSO", "ACOS", "AMAG", "ANAC", "ANAR", "ANAX", "ANAY", "ANCX", "ANCY",
    "ASIN", "ASTI", "ATAN", "AXCL", "BFSD", "BIOC", "BIOD", "BLNK", "BLTH", "BSER", "CEGT", "CEHX",
    "CEHY", "CELT", "CENX", "CENY", "CEVA", "CIGT", "CILT", "CIVA", "CMFV", "CMGT", "CMLT", "CMVA",
    "CNAX", "CNAY", "CNPX", "CNPY", "CODA", "COGT", "COLT", "COMA", "CONF", "CONS", "COSI", "COVA",
    "CTGT", "CTLT", "CTVA", "CVGT", "CVIG", "CVLT", "CVOL", "CVVA", "DENC", "DENF", "DIFF", "DIMX",
    "DISA", "DISC", "DISG", "DIST", "DIVB", "DIVI", "DLTN", "DMFS", "DMGT", "DMLT", "DMVA", "DXDX",
    "DXDY", "DYDX", "DYDY", "EFFL", "EFLX", "EFLY", "EFNO", "ENDX", "ENPP", "EPDI", "EQUA", "ERFP",
    "ETGT", "ETLT", "ETVA", "EXPD", "EXPP", "FCGS", "FCGT", "FCUR", "FDMO", "FDRE", "FICL", "FICP",
    "FOUC", "FREZ", "FTGT", "FTLT", "GBPD", "GBPP", "GBPR", "GBPS", "GBPW", "GBPZ", "GBSD", "GBSP",
    "GBSR", "GBSS", "GBSW", "GCOS", "GENC", "GENF", "GLCA", "GLCB", "GLCC", "GLCR", "GLCX", "GLCY",
    "GLCZ", "GMTA", "GMTS", "GMTT", "GOTO", "GPIM", "GPRT", "GPRX", "GPRY", "GPSX", "GPSY", "GRMN",
    "GRMX", "GTCE", "HHCN", "I1GT", "I1LT", "I1VA", "I2GT", "I2LT", "I2VA", "I3GT", "I3LT", "I3VA",
    "I4GT", "I4LT", "I4VA", "I5GT", "I5LT", "I5VA", "I6GT", "I6LT", "I6VA", "IMAE", "IMSF", "INDX",
    "ISFN", "ISNA", "LACL", "LINV", "LOGE", "LOGT", "LONA", "LPTD", "MAXX", "MCOG", "MCOL", "MCOV",
    "MECA", "MECS", "MECT", "MINN", "MNAB", "MNCA", "MNCG", "MNCT", "MNCV", "MNDT", "MNEA", "MNEG",
    "MNET", "MNIN", "MNPD", "MNRE", "MNRI", "MNSD", "MSWA", "MSWS", "MSWT", "MTFA", "MTFS", "MTFT",
    "MTHA", "MTHS", "MTHT", "MXAB", "MXCA", "MXCG", "MXCT", "MXCV", "MXDT", "MXEA", "MXEG", "MXET",
    "MXIN", "MXPD", "MXRE", "MXRI", "MXSD", "NORD", "NORX", "NORY", "NORZ", "NPGT", "NPLT", "NPVA",
    "NPXG", "NPXL", "NPXV", "NPYG", "NPYL", "NPYV", "NPZG", "NPZL", "NPZV", "NSDC", "NSDD", "NSDE",
    "NSDP", "NSLT", "NSRA", "NSRD", "NSRM", "NSRW", "NSST", "NSTR", "NSTW", "NTXG", "NTXL", "NTXV",
    "NTYG", "NTYL", "NTYV", "NTZG", "NTZL", "NTZV", "OBSN", "OMMI", "OMMX", "OMSD", "OOFF", "OPDC",
    "OPDM", "OPDX", "OPGT", "OPLT", "OPTH", "OPVA", "OSCD", "OSUM", "P1GT", "P1LT", "P1VA", "P2GT",
    "P2LT", "P2VA", "P3GT", "P3LT", "P3VA", "P4GT", "P4LT", "P4VA", "P5GT", "P5LT", "P5VA", "P6GT",
    "P6LT", "P6VA", "P7GT", "P7LT", "P7VA", "P8GT", "P8LT", "P8VA", "PANA", "PANB", "PANC", "PARA",
    "PARB", "PARC", "PARR", "PARX", "PARY", "PARZ", "PATX", "PATY", "PETC", "PETZ", "PIMH", "PLEN",
    "PMAG", "PMGT", "PMLT", "PMVA", "POPD", "POPI", "POWF", "POWP", "POWR", "PRIM", "PROB", "PROD",
    "QSUM", "RAED", "RAEN", "RAGA", "RAGB", "RAGC", "RAGX", "RAGY", "RAGZ", "RAID", "RAIN", "RANG",
    "REAA", "REAB", "REAC", "REAR", "REAX", "REAY", "REAZ", "RECI", "RELI", "RENA", "RENB", "RENC",
    "RETX", "RETY", "REVR", "RGLA", "RSCE", "RSCH", "RSRE", "RSRH", "RWCE", "RWCH", "RWRE", "RWRH",
    "SAGX", "SAGY", "SCUR", "SDRV", "SFNO", "SINE", "SKIN", "SKIS", "SMIA", "SPCH", "SPHA", "SQRT",
    "SSAG", "STHI", "STRH", "SUMM", "SVIG", "TANG", "TCGT", "TCLT", "TCVA", "TFNO", "TGTH", "TMAS",
    "TOLR", "TOTR", "TRAC", "TRAD", "TRAE", "TRAI", "TRAR", "TRAX", "TRAY", "TRCX", "TRCY", "TTGT",
    "TTHI", "TTLT", "TTVA", "UDOC", "UDOP", "USYM", "VOLU", "WFNO", "WLEN", "XDGT", "XDLT", "XDVA",
    "XENC", "XENF", "XNEA", "XNEG", "XNET", "XXEA", "XXEG", "XXET", "YNIP", "ZERN", "ZPLM", "ZTHI"};

bool zemax_is_operand(struct text word)
{
    for (size_t i = 0; i < sizeof operands / sizeof operands[0]; i++) {
        if (text_same(word, operands[i])) {
            return true;
        }
    }
    return false;
}

const struct zemax_keyword zemax_tail_keywords[] = {
    {"MNUM", read_configurations}, {"THIC", read_setting}, {"CRVT", read_setting},
    {"CONN", read_setting},        {"GLSS", read_setting}, {"APER", read_setting},
    {"SDIA", read_setting},        {"WAVE", read_setting}, {"YFIE", read_setting},
    {"XFIE", read_setting},        {"PRAM", read_setting}, {"PAR1", read_setting},
    {"PAR2", read_setting},        {"PAR3", read_setting}, {"PAR4", read_setting},
    {"PAR5", read_setting},        {"PAR6", read_setting}, {"IGNR", read_setting},
    {"STPS", read_setting},        {"PAR7", read_setting}, {"PAR8", read_setting},
    {"FLTP", read_setting},        {"FLWT", read_setting}, {"WLWT", read_setting},
    {"PRWV", read_setting},        {"TEMP", read_setting}, {"PRES", read_setting},
    {"MIND", read_setting},        {"MABB", read_setting}, {"MDPG", read_setting},
    {"CWGT", read_setting},        {NULL, NULL},
};
