"""A comparison as text and as JSON."""
WORDS = {   # by (differs, agrees)
    (True, True): "agrees, measurably different", (True, False): "DIFFERS", (False, True): "agrees",
    (False, False): "off, perhaps by chance"}


def interval(value, half):
    return f"{value:.4g} +- {half:.2g}" if half > 0.0 else f"{value:.4g}"


def comparison_text(c):
    width = max(6, *(len(figure.name) for figure in c.figures))
    lines, group = [f"{'figure':{width}}  {'real':>19}  {'simulated':>19}  {'difference':>19}"], None
    for figure in c.figures:
        if figure.group != group:
            group, own = figure.group, [one for one in c.figures if one.group == figure.group]
            lines.append(f"-- {group}: {sum(one.agrees for one in own)} of {len(own)} agree")
        values = zip((figure.real, figure.simulated, figure.difference), figure.halves)
        columns = "  ".join(f"{interval(*one):>19}" for one in values)
        lines.append(f"{figure.name:{width}}  {columns}  {WORDS[figure.differs, figure.agrees]}")
    if c.is_relative:
        lines.append("The gain is not compared: one recording has no full_value.")
    lines.append(f"{c.agreeing} of {len(c.figures)} figures agree ({100.0 * c.agreeing / len(c.figures):.0f} %): their "
                 "difference is within the tolerance or within its 95 % interval.")
    lines.append("Same: no figure differs significantly (5 % for all figures together)." if c.is_same else
                 f"Not the same: {c.differing} figures differ significantly (5 % for all figures together).")
    if c.first_change:
        lines.append(f"Change first: {c.first_change.name} ({c.first_change.tolerances_off:.3g} tolerances off).")
    return "\n".join(lines) + "\n"


def comparison_json(c):
    first = c.first_change
    return {"format": "sonarsim comparison", "format_version": 3, "real": {"name": c.real.name, "pings": len(c.real)},
        "simulated": {"name": c.simulated.name, "pings": len(c.simulated)}, "one_grid": c.has_one_grid,
        "relative_levels": c.is_relative, "figures_agreeing": c.agreeing, "figures_differing": c.differing,
        "agreement": c.agreeing / len(c.figures), "same": c.is_same,
        "change_first": first and {"figure": first.name, "tolerances": first.tolerances_off},
        "figures": [{"name": f.name, "group": f.group, "real": f.real, "real_half_interval": f.halves[0], "simulated": f.simulated,
                     "simulated_half_interval": f.halves[1], "difference": f.difference,
                     "difference_half_interval": f.halves[2], "tolerance": f.tolerance, "standardised": f.standardised,
                     "p": f.p, "adjusted_p": f.adjusted_p, "agrees": f.agrees, "differs": f.differs} for f in c.figures]}
