# beams wider than a lens in air has them, and stops wider than numbers go
lenscalc trace hubble-rc -N 1e-9 --columns ray,status
lenscalc draw hubble-rc -N 0.4 -o /dev/null
lenscalc trace double-gauss -N 1e-99
lenscalc trace double-gauss -N 1e-99 --pattern gauss --no-clip
