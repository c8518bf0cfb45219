"""tests/bench/lenses.py - lenses that optimisation starts from, and what is asked of them."""
# SPDX-License-Identifier: MIT

GAUSS = """lens Double Gauss 100 mm f/2
wavelength d F C
field angle 0 10 14
aperture epd 50
focus table
surface 58.950 7.520 1.670/47.1 50.4
surface 169.660 0.240 air 50.4
surface 38.550 8.050 1.670/47.1 46.0
surface 81.540 6.550 1.699/30.1 46.0
surface 25.500 11.410 air 36.0
stop - 9.000 air 34.2
surface -28.990 2.360 1.603/38.0 34.0
surface 81.540 12.130 1.658/57.3 40.0
surface -40.770 0.380 air 40.0
surface 874.130 6.440 1.717/48.0 40.0
surface -79.460 72.228 air 40.0
"""
TRIPLET = """lens Triplet from plates
wavelength d F C
field angle 0 10 14
aperture epd 12
focus table
surface - 4 1.6204/60.3 20
surface - 6 air 20
surface - 1.5 1.6200/36.4 14
surface - 0.5 air 14
stop - 5.5 air 12
surface - 4 1.6204/60.3 18
surface - 42 air 18
"""
ACHROMAT = """lens Achromat from plates
wavelength d F C
field angle 0 1
aperture epd 20
focus table
surface - 6 SCHOTT:N-BK7 22 stop
surface - 3 SCHOTT:N-SF5 22
surface - 96 air 22
"""
APOCHROMAT = """lens Apochromat from plates
wavelength e F C g
field angle 0 0.5
aperture epd 50
focus table
surface - 10 SCHOTT:N-FK51A 54 stop
surface - 1 air 54
surface - 6 SCHOTT:N-KZFS4 54
surface - 1 air 54
surface - 8 SCHOTT:N-BAK1 54
surface - 480 air 54
"""
CASSEGRAIN = """lens Cassegrain from spheres
wavelength d
field angle 0 0.1 0.2
aperture epd 200
focus table
surface -1200 -440 mirror 200 stop
surface -420 600 mirror 60
"""
RELAY = """lens Relay 1:1
wavelength d F C
object 200
field height 0 5 8
aperture na 0.08
focus table
surface 120 6 SCHOTT:N-BK7 36
surface -60 3 SCHOTT:N-SF2 36
surface -300 20 air 36
stop - 20 air 24
surface 300 3 SCHOTT:N-SF2 36
surface 60 6 SCHOTT:N-BK7 36
surface -120 200 air 36
"""
# Named: the lens, a file's text or one of lensdb, and the question.
STARTS = {
    "triplet from plates": (TRIPLET, "--vary c1,c2,c3,c4,c6,c7,t7 --goals poly,efl=50"),
    "achromat from plates": (ACHROMAT, "--vary c1,c2,c3,t3 --goals poly,efl=100"),
    "apochromat from plates": (APOCHROMAT, "--vary c1,c2,c3,c4,c5,c6,t6 --goals poly,efl=500"),
    "double Gauss, scaled wrong": (GAUSS, "--vary R1..R11,t11 --goals poly,efl=140"),
    # its own fields, and none between, where its spots are worse
    "phone lens with aspheres": ("phone-80deg", "--vary all-R --goals poly,efl=5.164 "
                                 "--field 0,28,40"),
    "zoom in three positions": ("itoh-zoom-100-146", 
                                "--vary all-R --goals poly,efl@wide=99.9,efl@tele=145.7"),
    "telephoto": ("cs348b-telephoto-250", "--vary all-R --goals poly,efl=250 -N 4"),
    "Cassegrain": (CASSEGRAIN, "--vary R1,R2,k1,k2,t2 --goals poly,efl=2000:10"),
    "fisheye": ("fisheye-16", "--vary all-R --goals poly,efl=16"),
    "relay": (RELAY, "--vary all-R,t7 --goals poly,magnification=-1" ),
}
