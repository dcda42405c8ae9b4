"""A comparison as text, as JSON and as a plot."""
COLOURS = {"real": "#1b6ca8", "simulated": "#c8553d"}
MOST_STANDARDISED = 10.0
RECEIVER, BEAM, PULSE = "instrument.receiver.", "instrument.beam.", "instrument.pulse.resolution_m, range_bins"
LOOKS = RECEIVER + "looks, samples, combine, companding; instrument.speckle.clutter_shape, per_cell"
# The begin of a figure's name, a text in it, the keys that it follows. The first rule that matches applies.
RULES = (
    ("points", "side lobes", BEAM + "side_lobe_db, elements"),
    ("shadows", "depth", f"{RECEIVER}noise_db; {BEAM}side_lobe_db, elements; water.content"),
    ("shadows", "share", "the scene's objects, the altitude"),
    ("", "spread of ranges", f"the bed's roughness; {PULSE}; {BEAM}width_deg"),
    ("", "degrees: level", f"the material's scattering; {BEAM}width_deg; instrument.source_level_db"),
    ("", "degrees: variation", LOOKS),
    ("", "next ping", "instrument.speckle.mode, the trajectory's motion, " + RECEIVER + "noise_db"),
    ("", " pings", f"{BEAM}width_deg, the speed of the trajectory"),
    ("", "ranges", PULSE),
    ("", "beams", BEAM + "width_deg, side_lobe_db, aberration_rad; azimuth_bins"),
    ("", "zeros", RECEIVER + "noise_db, offset, bits, blanking_m"),
    ("", "clipped", RECEIVER + "full_scale_db"),
    ("ring", "level", RECEIVER + "ring_down_db, ring_down_m, blanking_m"),
    ("water", "level, dB", RECEIVER + "noise_db, common_mode_db, tvg_log, tvg_from_m, full_scale_db"),
    ("tail", "level, dB", f"{BEAM}elevation_side_lobe_db; {RECEIVER}noise_db, tvg_log"),
    ("bottom", "level at", BEAM + "elevation_width_deg, the mount's attitude, the material's scattering"),
    ("level at", "", RECEIVER + "tvg_log, noise_db, full_scale_db, ring_down_db; the scene's distance"),
    ("", "level, dB", f"instrument.source_level_db, {RECEIVER}full_scale_db, the material's lambert_db"),
    ("level of", "", f"instrument.source_level_db, {RECEIVER}full_scale_db, the material's lambert_db"),
    ("", "", LOOKS))
WORDS = {   # by (differs, agrees)
    (True, True): "agrees, measurably different", (True, False): "DIFFERS", (False, True): "agrees",
    (False, False): "off, perhaps by chance"}


def keys_behind(name):
    """The keys of a mission that a figure depends on."""
    return next(keys for begin, part, keys in RULES if name.startswith(begin) and part in name)


def interval(value, half):
    return f"{value:.4g} +- {half:.2g}" if half > 0.0 else f"{value:.4g}"


def comparison_text(c):
    width = max(6, *(len(figure.name) for figure in c.figures))
    lines = [f"{'figure':{width}}  {'real':>19}  {'simulated':>19}  {'difference':>19}"]
    for figure in c.figures:
        values = zip((figure.real, figure.simulated, figure.difference), figure.halves)
        columns = "  ".join(f"{interval(*one):>19}" for one in values)
        lines.append(f"{figure.name:{width}}  {columns}  {WORDS[figure.differs, figure.agrees]}")
    if c.is_relative:
        lines.append("Levels are relative to the mean of each recording: one has no full_value.")
    lines.append(f"{c.agreeing} of {len(c.figures)} figures agree ({100.0 * c.agreeing / len(c.figures):.0f} %): their "
                 "difference is within the tolerance or within its 95 % interval.")
    lines.append("Same: no figure differs significantly (5 % for all figures together)." if c.is_same else
                 f"Not the same: {c.differing} figures differ significantly (5 % for all figures together).")
    if c.first_change:
        lines.append(f"Change first: {c.first_change.name} ({c.first_change.standardised:.4g} standard errors off). It "
                     f"follows {keys_behind(c.first_change.name)}.")
    return "\n".join(lines) + "\n"


def comparison_json(c):
    """The comparison as a dict for JSON."""
    first = c.first_change
    return {
        "format": "sonarsim comparison", "format_version": 1, "real": {"name": c.real.name, "pings": len(c.real)},
        "simulated": {"name": c.simulated.name, "pings": len(c.simulated)}, "one_grid": c.has_one_grid,
        "relative_levels": c.is_relative, "figures_agreeing": c.agreeing, "figures_differing": c.differing,
        "agreement": c.agreeing / len(c.figures), "same": c.is_same,
        "change_first": first and {"figure": first.name, "standardised": first.standardised,
                                   "keys": keys_behind(first.name)},
        "figures": [{"name": f.name, "real": f.real, "real_half_interval": f.halves[0], "simulated": f.simulated,
                     "simulated_half_interval": f.halves[1], "difference": f.difference,
                     "difference_half_interval": f.halves[2], "tolerance": f.tolerance, "standardised": f.standardised,
                     "p": f.p, "adjusted_p": f.adjusted_p, "agrees": f.agrees, "differs": f.differs} for f in c.figures]}


def plot(c, path):
    """Draws levels by range and the difference of each figure into an SVG."""
    import matplotlib       # pylint: disable=import-outside-toplevel
    matplotlib.use("Agg")
    matplotlib.rcParams["svg.hashsalt"] = "sonarsim"
    from matplotlib import pyplot   # pylint: disable=import-outside-toplevel
    rows = len(c.figures)
    heights = [3.0] * bool(c.levels) + [0.18 * rows + 0.5]
    drawing, panels = pyplot.subplots(len(heights), 1, figsize=(10.0, sum(heights) + 1.0), squeeze=False,
                                      gridspec_kw={"height_ratios": heights}, layout="constrained")
    for name, (ranges, levels) in zip(COLOURS, c.levels):
        panels[0, 0].plot(ranges, levels, color=COLOURS[name], label=name, linewidth=1.0)
    if c.levels:
        panels[0, 0].set(xlabel="range, m", ylabel="level, dB")
        panels[0, 0].legend()
    panel = panels[-1, 0]
    panel.axvspan(-1.96, 1.96, color="#eeeeee")
    panel.scatter([max(-MOST_STANDARDISED, min(MOST_STANDARDISED, figure.standardised)) for figure in c.figures],
                  range(rows), c=[COLOURS["real" if figure.agrees else "simulated"] for figure in c.figures], zorder=2)
    panel.set_yticks(range(rows), [figure.name for figure in c.figures], fontsize=7)
    panel.set(xlim=(-MOST_STANDARDISED - 0.5, MOST_STANDARDISED + 0.5), ylim=(rows, -1),
              xlabel="difference in standard errors, cut at 10; grey: 1.96 of them; blue: agrees")
    drawing.savefig(path, format="svg", metadata={"Date": None})
    pyplot.close(drawing)
