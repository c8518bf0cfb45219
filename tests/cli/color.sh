# colour by wavelength, zone and field; afocal lenses; what is refused
lenscalc color double-gauss
lenscalc color double-gauss --spectrum photopic --height 20 --csv --digits 5 --columns wavelength_nm,axial_um,lateral_um,chief_y_mm
lenscalc color double-gauss -w 400..700:100 --field 5,10deg --csv --digits 5
lenscalc color double-gauss --show zone --steps 4 -w F,C
lenscalc color double-gauss --show zone --steps 2 --aim entrance --json --digits 5
lenscalc color double-gauss --show field --steps 2
lenscalc color canon-nfd-70-210 --position all --columns position,wavelength_nm,axial_mm,lateral_um
lenscalc color double-gauss --object 1000 --focus best --defocus 0.1 --columns wavelength_nm,axial_mm,lateral_um,secondary_mm
lenscalc color fisheye-16 -w F,C --field 50deg
printf 'lens telescope\naperture epd 20\nfield angle 1\nwavelength d F C\nsurface 75 0 1.5/60 - stop\nsurface - 100 air -\nsurface -25 0 1.5/60 -\nsurface - 0 air -\n' > telescope.lens
lenscalc color ./telescope.lens
lenscalc color ./telescope.lens --show zone --steps 2 -w F
printf 'lens stopless\nwavelength d F C\nsurface 60 5 1.5/60 -\nsurface - 0 air -\n' > stopless.lens
lenscalc color ./stopless.lens
lenscalc color ./stopless.lens --show zone
lenscalc color ./stopless.lens --plot stopless.svg > /dev/null && grep -c '<poly\|<path' stopless.svg
lenscalc color fisheye-16
lenscalc color fisheye-16 --spectrum d
lenscalc color double-gauss --field 60deg
lenscalc color double-gauss --show field --field 60deg --steps 2 -w F --csv --columns field_deg,lateral_um,status,warning; echo $?
lenscalc color double-gauss --steps 3
lenscalc color double-gauss --show field --aim entrance
lenscalc color laikin54-ir -w 20um
lenscalc color
lenscalc color canon-nfd-70-210 --position all --plot x.svg
lenscalc color double-gauss --field 5,10deg --plot x.svg
lenscalc color double-gauss -w 400..700:10 --plot x.svg > /dev/null && grep -c '<poly\|<path' x.svg
lenscalc color double-gauss -w F --explain --columns axial_mm,lateral_um | tail -n 12
