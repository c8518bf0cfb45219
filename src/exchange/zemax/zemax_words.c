/* exchange/zemax/zemax_words.c - every word of a .zmx file, and what becomes of it. */
/* SPDX-License-Identifier: MIT */
#include "exchange/zemax/zemax.h"

const struct word_group zemax_words[] = {
    {WORD_KEPT, ZEMAX_IN_SYSTEM, "sequential or not; the unit of lengths", "MODE UNIT", 0},
    {WORD_KEPT, ZEMAX_IN_SYSTEM, "title and notes", "NAME NOTE", 0},
    {WORD_KEPT, ZEMAX_IN_SYSTEM, "catalogues of glasses", "GCAT", 0},
    {WORD_KEPT, ZEMAX_IN_SYSTEM, "the program that has written the file", "VERS", 0},
    {WORD_KEPT, ZEMAX_IN_SYSTEM, "aperture", "ENPD FNUM OBNA FLOA", 0},
    {WORD_KEPT, ZEMAX_IN_SYSTEM, "fields and their weights", "FTYP XFLN YFLN XFLD YFLD FWGN", 0},
    {WORD_LOST, ZEMAX_IN_SYSTEM, "fields beyond the twelfth", "FENF FEFD", 0},
    {WORD_KEPT, ZEMAX_IN_SYSTEM, "wavelengths, their weights and the primary one",
     "WAVM WAVL WAVN WWGT WWGN PWAV", 0},
    {WORD_KEPT, ZEMAX_IN_SYSTEM, "temperature and pressure", "ENVD", 0},
    {WORD_KEPT, ZEMAX_IN_SYSTEM,
     "vignetting factors of the fields, where the clear diameters limit the beams",
     "VDXN VDYN VCXN VCYN VANN VDSX VDSY VCSX VCSY VANS ZVDX ZVDY ZVCX ZVCY ZVAN", 0},
    {WORD_KEPT, ZEMAX_IN_SYSTEM, "apodisation of the pupil, as a note", "GFAC", 0},
    {WORD_HARMLESS, ZEMAX_IN_SYSTEM,
     "the language and licence of the program, the author, checksums",
     "LANG PFIL AUTH LUID STUD IWDP EERA CSUM CHKS HASH", 0},
    {WORD_HARMLESS, ZEMAX_IN_SYSTEM, "comments of the fields; settings of displays", "FCOM RCMF",
     0},
    {WORD_HARMLESS, ZEMAX_IN_SYSTEM,
     "the search for rays through the stop, which lenscalc always aims at", "RAIM PUSH", 0},
    {WORD_HARMLESS, ZEMAX_IN_SYSTEM,
     "margins of automatic semi-diameters, which the file has as numbers", "SDMA OMMA", 0},
    {WORD_HARMLESS, ZEMAX_IN_SYSTEM, "weights of the fields of old files", "FWGT", 0},
    {WORD_HARMLESS, ZEMAX_IN_SYSTEM, "the entrance pupil as the program had computed it", "PUPD",
     0},
    {WORD_HARMLESS, ZEMAX_IN_SYSTEM, "the reference of optical path differences; polarised light",
     "ROPD POLS", 0},
    {WORD_HARMLESS, ZEMAX_IN_SYSTEM,
     "rays beyond the rim, the surface of global coordinates, settings of dialogues",
     "HYPR PICB GLRS GSTD DBDT", 0},
    {WORD_HARMLESS, ZEMAX_IN_SYSTEM,
     "non-sequential settings, which a sequential lens does not use", "NSCD", 0},
    {WORD_HARMLESS, ZEMAX_IN_SYSTEM, "files of coatings, scatter and pictures", "COFN", 0},
    {WORD_KEPT, ZEMAX_IN_SURFACE, "number, type, and the stop", "SURF TYPE STOP", 0},
    {WORD_KEPT, ZEMAX_IN_SURFACE, "curvature, conic, distance and material", "CURV CONI DISZ GLAS",
     0},
    {WORD_KEPT, ZEMAX_IN_SURFACE, "parameters and extra data", "PARM XDAT", 0},
    {WORD_KEPT, ZEMAX_IN_SURFACE, "pick-ups of parameters", "PPAR", 0},
    {WORD_KEPT, ZEMAX_IN_SURFACE, "solves of the distance", "MAZH CHZH PZUP TCOM TOLE EDGE", 0},
    {WORD_KEPT, ZEMAX_IN_SURFACE, "semi-diameter, circular and floating aperture", "DIAM CLAP FLAP",
     0},
    {WORD_KEPT, ZEMAX_IN_SURFACE, "comment and coating", "COMM COAT", 0},
    {WORD_KEPT, ZEMAX_IN_SURFACE,
     "rectangles and ellipses, obscurations, spiders, and the decentre of an aperture",
     "SQAP ELAP OBSC SQOB ELOB SPID OBDC", 0},
    {WORD_KEPT, ZEMAX_IN_SURFACE,
     "polygons and circles in a .uda file beside the lens file, polygons inline", "USAP USOB UDAD",
     0},
    {WORD_KEPT, ZEMAX_IN_SURFACE, "shifts and turns before and behind a surface", "SCBD", 0},
    {WORD_LOST, ZEMAX_IN_SURFACE, "a surface that is left out", "IGNR", 0},
    {WORD_LOST, ZEMAX_IN_SURFACE, "extra data of toroids and pick-ups of old files", "YDAT PKUP",
     0},
    {WORD_HARMLESS, ZEMAX_IN_SURFACE,
     "objects and settings of a non-sequential group, for which a file is refused",
     "NSCS NSOA NSOD NSOH NSOO NSOP NSOQ NSOS NSOU NSOV NSOW", 0},
    {WORD_HARMLESS, ZEMAX_IN_SURFACE, "drawing, and the colours of the editor",
     "HIDE SCOL SCLR COLR", 0},
    {WORD_HARMLESS, ZEMAX_IN_SURFACE, "the blank of a mirror, the rim of the glass",
     "MIRR MEMA OEMA CHZN", 0},
    {WORD_HARMLESS, ZEMAX_IN_SURFACE, "labels by which the program knows the surface", "SLAB SSID",
     0},
    {WORD_HARMLESS, ZEMAX_IN_SURFACE, "physical optics; data imported into the numbers given here",
     "POPS FIMP", 0},
    {WORD_HARMLESS, ZEMAX_IN_SURFACE, "thermal expansion, which acts at other temperatures only",
     "TCED TCMM TCEX", 0},
    {WORD_HARMLESS, ZEMAX_IN_SURFACE, "marks of what the optimiser may vary",
     "VPAR VCON VDSZ VDAT VXDT", 0},
    {WORD_KEPT, ZEMAX_IN_CONFIGURATIONS, "the number of configurations", "MNUM", 0},
    {WORD_KEPT, ZEMAX_IN_CONFIGURATIONS, "distances, semi-diameters and the aperture",
     "THIC SDIA APER", 0},
    {WORD_KEPT, ZEMAX_IN_CONFIGURATIONS, "shape, material and parameters of a surface",
     "CRVT CONN GLSS PRAM EDVA PAR1 PAR2 PAR3 PAR4 PAR5 PAR6 PAR7 PAR8", 0},
    {WORD_KEPT, ZEMAX_IN_CONFIGURATIONS, "the stop; wavelengths, weights and the primary one",
     "STPS WAVE WLWT PRWV", 0},
    {WORD_LOST, ZEMAX_IN_CONFIGURATIONS, "shape and material in other words, where they change",
     "MIND MABB MDPG CSP1 CSP2 "
     "TSP1 TSP2 TSP3 PSP1 PSP2 PSP3 PUCN HOLD",
     0},
    {WORD_LOST, ZEMAX_IN_CONFIGURATIONS, "surfaces that are left out", "IGNR", 0},
    {WORD_KEPT, ZEMAX_IN_CONFIGURATIONS, "shifts and turns before and behind a surface",
     "CBDX CBDY CBTX CBTY CBTZ CBOR CADX CADY CATX CATY CATZ CAOR", 0},
    {WORD_LOST, ZEMAX_IN_CONFIGURATIONS, "coordinates of another surface, where they change",
     "CADZ CROR CRSR", 0},
    {WORD_KEPT, ZEMAX_IN_CONFIGURATIONS, "fields", "FLTP XFIE YFIE FLWT AFOC TELE", 0},
    {WORD_KEPT, ZEMAX_IN_CONFIGURATIONS, "temperature and pressure", "TEMP PRES", 0},
    {WORD_LOST, ZEMAX_IN_CONFIGURATIONS, "expansion, where it changes", "TCEX", 0},
    {WORD_KEPT, ZEMAX_IN_CONFIGURATIONS, "sizes and decentres of apertures", "APMN APMX APDX APDY",
     0},
    {WORD_LOST, ZEMAX_IN_CONFIGURATIONS, "non-sequential objects, where they change",
     "NPOS NPAR NPRO NGLS NCOT IGNM", 0},
    {WORD_LOST, ZEMAX_IN_CONFIGURATIONS, "apertures, apodisation and weights, where they change",
     "APTP UDAF SATP APDF APDT MCSD MXSD", WORD_VIGNETTES},
    {WORD_KEPT, ZEMAX_IN_CONFIGURATIONS,
     "vignetting factors, where the clear diameters limit the beams", "FVDX FVDY FVCX FVCY FVAN",
     0},
    {WORD_HARMLESS, ZEMAX_IN_CONFIGURATIONS, "titles, comments and lines left free",
     "MOFF MCOM LTTL NCOM", 0},
    {WORD_HARMLESS, ZEMAX_IN_CONFIGURATIONS, "weights of the configurations, units of the MTF",
     "CWGT MTFU", 0},
    {WORD_HARMLESS, ZEMAX_IN_CONFIGURATIONS, "coatings, aiming, drawing, global coordinates",
     "COTN RAIM SDRW GCRS", 0},
    {WORD_HARMLESS, ZEMAX_IN_CONFIGURATIONS, "polarised light and physical optics",
     "GPIU GPJX GPJY GPPX GPPY GPEX GPEY GQPO PSHX PSHY PSHZ PSCX PSCY PXAR CPCN SWCN SRTS AICN",
     0},
    {WORD_HARMLESS, ZEMAX_IN_TAIL, "tolerances", "TOL", 0},
    {WORD_HARMLESS, ZEMAX_IN_TAIL,
     "operands of the merit function; another word with at least eight numbers is one too",
     "ABCD ABGT ABLT ABSO ACOS AMAG ANAC ANAR ANAX ANAY ANCX ANCY ASIN ASTI ATAN AXCL BFSD BIOC "
     "BIOD BIPF BLNK BLTH BSER CEGT CEHX CEHY CELT CENX CENY CEVA CIGT CILT CIVA CMFV CMGT CMLT "
     "CMVA CNAX CNAY CNPX CNPY CODA COGT COLT COMA CONF CONS COSI COVA CPGT CPLT CPVA CTGT CTLT "
     "CTVA CVGT CVIG CVLT CVOL CVVA DENC DENF DIFF DIMX DISA DISC DISG DIST DIVB DIVI DLTN DMFS "
     "DMGT DMLT DMVA DPHS DXDX DXDY DYDX DYDY EFFL EFLA EFLX EFLY EFNO ENDX ENPP EPDI EQUA ERFP "
     "ETGT ETLT ETVA EXPD EXPP FCGS FCGT FCUR FDMO FDRE FICL FICP FOUC FREZ FTGT FTLT FTPV FTVA "
     "GBPD GBPP GBPR GBPS GBPW GBPZ GBSD GBSP GBSR GBSS GBSW GCOS GENC GENF GLCA GLCB GLCC GLCR "
     "GLCX GLCY GLCZ GMTA GMTN GMTS GMTT GMTX GMTY GOTO GPIM GPRT GPRX GPRY GPSX GPSY GRMN GRMX "
     "GTCE HACG HHCN HYLD I1GT I1LT I1VA I2GT I2LT I2VA I3GT I3LT I3VA I4GT I4LT I4VA I5GT I5LT "
     "I5VA I6GT I6LT I6VA IMAE IMSF INDX ISFN ISNA JMTA LACL LINV LOGE LOGT LONA LPTD MAXX MCOG "
     "MCOL MCOV MECA MECS MECT MINN MNAB MNAI MNCA MNCG MNCT MNCV MNDT MNEA MNEG MNET MNIN MNPD "
     "MNRE MNRI MNSD MSWA MSWN MSWS MSWT MTFA MTFN MTFS MTFT MTFX MTFY MTHA MTHN MTHS MTHT MTHX "
     "MTHY MXAB MXAI MXCA MXCG MXCT MXCV MXDT MXEA MXEG MXET MXIN MXPD MXRE MXRI MXSD NORD NORX "
     "NORY NORZ NPGT NPLT NPVA NPXG NPXL NPXV NPYG NPYL NPYV NPZG NPZL NPZV NSDC NSDD NSDE NSDP "
     "NSLT NSRA NSRD NSRM NSRW NSST NSTR NSTW NTXG NTXL NTXV NTYG NTYL NTYV NTZG NTZL NTZV OBSN "
     "OMMI OMMX OMSD OOFF OPDC OPDM OPDX OPGT OPLT OPTH OPVA OSCD OSGT OSLT OSUM P1GT P1LT P1VA "
     "P2GT P2LT P2VA P3GT P3LT P3VA P4GT P4LT P4VA P5GT P5LT P5VA P6GT P6LT P6VA P7GT P7LT P7VA "
     "P8GT P8LT P8VA PANA PANB PANC PARA PARB PARC PARR PARX PARY PARZ PATX PATY PETC PETZ PIMH "
     "PLEN PMAG PMGT PMLT PMVA POPD POPI POPX POWF POWP POWR PRIM PROB PROD QOAC QSUM RAED RAEN "
     "RAGA RAGB RAGC RAGX RAGY RAGZ RAID RAIN RANG REAA REAB REAC REAR REAX REAY REAZ RECI RELI "
     "RENA RENB RENC RETX RETY REVR RGLA RSCE RSCH RSRE RSRH RWCE RWCH RWRE RWRH SAGX SAGY SCRV "
     "SCUR SDRV SFNO SINE SKIN SKIS SMIA SPCD SPCH SPHA SPHD SPHS SQRT SSAG SSLP SSTI STHI STRH "
     "SUMM SVIG SZGT SZLT TANG TCGT TCLT TCVA TFNO TGTH TMAS TOLR TOTR TRAC TRAD TRAE TRAI TRAN "
     "TRAR TRAX TRAY TRCX TRCY TTGT TTHI TTLT TTVA UDOC UDOP UDOX USYM VOLU WFNO WLEN XDGT XDLT "
     "XDVA XENC XENF XNEA XNEG XNET XXEA XXEG XXET YNIP ZERN ZPLM ZTHI",
     0},
    {WORD_KEPT, NULL, NULL, NULL, 0},
};
