"""The plots of the page of performance, each from reports of `tilelight bench --json`."""
from gnuplot import COLORS, block, draw

SERIES = (("held", "blue", "range held"), ("shrinking", "orange", "lights per tile held"))


def median(summary):
    return summary["median"]


def ratios(report, order, path):
    """How many times our frame's time the others take, with intervals, on a logarithmic axis."""
    rows = []
    for at, name in enumerate(reversed(order)):
        ratio = report["ratios"][name]
        low, high = ratio["interval"] or (ratio["median"],) * 2
        rows.append((at, 1 / ratio["median"], 1 / high, 1 / low, name.replace("_", " ")))
    most = max(row[1] for row in rows)
    draw(path, (760, 60 + 44 * len(rows)), block("data", rows) + """
set logscale x
set xrange [0.5:%g]
set lmargin 14
set yrange [-0.6:%g]
set xlabel 'time of a frame, ours = 1'
unset key
set grid noy
set ytics () nomirror
set arrow from 1, graph 0 to 1, graph 1 nohead lc rgb '#444444' dt 2
plot $data using 2:1:(0.5):2:($1-0.28):($1+0.28):yticlabels(5) with boxxyerror fs solid 0.85 noborder lc rgb '%s', \\
     $data using 2:1:3:4 with xerrorbars pt 7 ps 0.3 lc rgb '#222222', \\
     $data using ($4*1.08):1:(sprintf('%%.3g', $2)) with labels left
""" % (most * 2.2, len(rows) - 0.4, COLORS["blue"]))


STAGES = (("prepare", "grey"), ("upload", "pink"), ("cull", "orange"), ("shade", "blue"),
          ("readback", "green"), ("other", "yellow"), ("post", "sky"))


def stages_of(record):
    """Medians in ms of the stages of a frame; what none of them has is `other`."""
    times = record["times_ms"]
    found = {name: median(summary) for name, summary in times["stages"].items()}
    known = {name: found.pop(name, 0.0) for name, _ in STAGES if name not in ("other", "post")}
    known["other"] = max(0.0, median(times["frame"]) - sum(known.values()))
    known["post"] = median(times["post"])
    return known


def stages(records, path):
    rows = [(record["case"]["scene"], *(stages_of(record)[name] for name, _ in STAGES))
            for record in records]
    plots = ", ".join("$data using %d%s title '%s' lc rgb '%s'"
                      % (i + 2, ":xtic(1)" if i == 0 else "", name, COLORS[color])
                      for i, (name, color) in enumerate(STAGES))
    draw(path, (760, 380), block("data", rows) + """
set style data histograms
set style histogram rowstacked
set style fill solid 0.9 noborder
set boxwidth 0.55
set grid nox
set yrange [0:*]
set ylabel 'ms'
set key outside right top vertical invert samplen 1
plot %s
""" % plots)


def roofline(records, path):
    """Every case of one device below what the device does at most."""
    peaks = records[0]["peaks"]
    bandwidth = max(peaks["read_gbyte_per_s"], peaks["copy_gbyte_per_s"])
    rows = [(r["figures"]["flops_per_byte"], r["figures"]["gflop_per_s"]) for r in records
            if r["peaks"] and r["case"]["precision"] == "float"]
    least = min(row[0] for row in rows)
    draw(path, (760, 420), block("data", rows) + """
set logscale xy
set xrange [%g:%g]
set yrange [%g:%g]
set xlabel 'operations per byte of planes, lists and picture'
set ylabel 'GFLOP/s'
set key bottom right
roof(x) = x * %g < %g ? x * %g : %g
set samples 500
plot roof(x) lw 2 lc rgb '%s' title 'roof, measured: %.0f GFLOP/s, %.1f GB/s', \\
     $data pt 7 ps 0.7 lc rgb '%s' title 'shading, a point per case'
""" % (min(1.0, least / 2), max(row[0] for row in rows) * 2, min(row[1] for row in rows) / 2,
       peaks["gflop_per_s"] * 1.6, bandwidth, peaks["gflop_per_s"], bandwidth,
       peaks["gflop_per_s"], COLORS["grey"], peaks["gflop_per_s"], bandwidth, COLORS["blue"]))


def growth(report, path):
    """Time against pairs and pixels, what the fit leaves, and memory."""
    data, points = "", {}
    for name, _, _ in SERIES:
        points[name], at_1080p = [], []
        for p in report["growth"][name]["points"]:
            amounts = p["amounts"]
            points[name].append((amounts["pixels"], amounts["pairs"], amounts["lights"],
                                 median(p["record"]["times_ms"]["frame"]), p["fitted_ms"],
                                 100 * p["residual"], 1e-6 * p["output_and_list_bytes"],
                                 1e-6 * p["device_bytes"]))
            case = p["record"]["case"]
            if case["size"] == "1920x1080" and case["per-tile"] == "27":
                at_1080p.append(points[name][-1])
        data += block(name, points[name])
        data += block(name + "_1080p", sorted(at_1080p, key=lambda row: row[2]))

    worst = max(20.0, *(abs(row[5]) * 1.1 for rows in points.values() for row in rows))

    def each(using, style, block_name="", titled=True):
        return ", ".join("$%s%s using %s %s lc rgb '%s' title '%s'"
                         % (name, block_name, using, style, COLORS[color], title if titled else "")
                         for name, color, title in SERIES)
    draw(path, (900, 760), data + """
set multiplot layout 2,2 margins 0.10,0.98,0.08,0.95 spacing 0.11,0.14
set logscale xy
set format x '10^{%%T}'
set xlabel 'pairs'
set ylabel 'ms of a frame'
set title 'time against pairs of a pixel and a listed light'
plot %s
set xlabel 'lights, 1920x1080'
set title 'time against lights: measured, and as fitted'
set format x '%%g'
set xtics (64, 256, 1024, 4096, 16384, 65536)
plot %s, %s
unset logscale y
set xtics autofreq
set format x '10^{%%T}'
set xlabel 'pixels'
set ylabel 'measured over fitted, %%'
set title 'what the fit leaves; wanted: within 15 %%'
set yrange [%g:%g]
set arrow 1 from graph 0, first 15 to graph 1, first 15 nohead dt 2 lc rgb '#888888'
set arrow 2 from graph 0, first -15 to graph 1, first -15 nohead dt 2 lc rgb '#888888'
plot %s
unset arrow
set autoscale y
set logscale xy
set xlabel 'MB of picture and lists'
set ylabel 'MB of device memory'
set format x '%%g'
set title 'memory of the device, beside the frame itself'
plot %s, x lc rgb '#888888' dt 2 title 'as much'
unset multiplot
""" % (each("2:4", "with points pt 7 ps 0.6"), each("3:4", "with points pt 7 ps 0.7", "_1080p"),
       each("3:5", "with lines lw 1.5", "_1080p", False), -worst, worst,
       each("1:6", "with points pt 7 ps 0.6"),
       each("7:8", "with points pt 7 ps 0.6")))


LOAD_COLORS = (("1024 lights", "blue"), ("8 over all", "orange"), ("none", "green"))


def layouts(records, path):
    """Bytes of each layout, times by load over full float's, and errors; records: dicts by load."""
    rows = []
    ordered = sorted(records, key=lambda loads: -loads["none"]["frame"]["pixel_bytes"])
    for at, loads in enumerate(ordered):
        error, row = loads["1024 lights"]["error"], []
        for name, _ in LOAD_COLORS:
            ratio = loads[name]["against"]["frame"]
            row += [ratio["median"], *ratio["interval"]]
        rows.append((at, loads["none"]["case"]["layout"], loads["none"]["frame"]["pixel_bytes"],
                     *row, error["rms"], error["max"]))
    times = ", ".join("$data using %d:($1+%g):%d:%d with xerrorbars pt 7 ps 0.5 lc rgb '%s' title '%s'"
                      % (4 + 3 * i, 0.22 * (1 - i), 5 + 3 * i, 6 + 3 * i, COLORS[color], name)
                      for i, (name, color) in enumerate(LOAD_COLORS))
    draw(path, (980, 110 + 30 * len(rows)), block("data", rows) + """
set multiplot
set yrange [-0.7:%g]
set tmargin at screen 0.86
set bmargin at screen 0.13
set key above center horizontal samplen 1
set lmargin at screen 0.15
set rmargin at screen 0.36
set ytics () nomirror
set xrange [0:*]
set xlabel 'bytes per pixel'
plot $data using (0.5*$3):1:(0.5*$3):(0.3):yticlabels(2) with boxxyerror fs solid 0.85 noborder lc rgb '%s' notitle, \\
     $data using ($3+1):1:(sprintf('%%d', $3)) with labels left notitle
set lmargin at screen 0.40
set rmargin at screen 0.68
set format y ''
set ytics 1
unset ytics
set xrange [*:*]
set xlabel 'time of a frame, full float = 1'
set arrow from 1, graph 0 to 1, graph 1 nohead lc rgb '#444444' dt 2
plot %s
unset arrow
set lmargin at screen 0.72
set rmargin at screen 0.97
set logscale x
set xtics 100
set format x '10^{%%T}'
set xlabel 'error of the picture, its mean = 1'
plot $data using 13:1 with points pt 7 ps 0.7 lc rgb '%s' title 'RMS', \\
     $data using 14:1 with points pt 6 ps 0.7 lc rgb '%s' title 'most'
unset multiplot
""" % (len(rows) - 0.3, COLORS["grey"], times, COLORS["blue"], COLORS["orange"]))
