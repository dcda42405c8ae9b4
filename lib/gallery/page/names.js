// Names in a picture that do not lie over one another.

const gap = 3;

// Places names, the most important first. Each has its text and its box on the canvas, [left, top,
// right, bottom]. It gets the first free place around its box or in it; a name that finds none is
// left out, and the list of objects has it. Returns {x, y, width, text, colour, box}, x and y at the lower left of the text.
function place_names(context, names, line_px, right, bottom) {
  const placed = [];
  const meets = (a, b) => a[0] < b[2] && b[0] < a[2] && a[1] < b[3] && b[1] < a[3];
  for (const name of names) {
    const [x0, y0, x1, y1] = name.box;
    const width = context.measureText(name.text).width;
    const spots = [
      [x0, y0 - gap], [x0, y1 + gap + line_px], [x1 - width, y0 - gap], [x1 - width, y1 + gap + line_px],
      [x1 + gap, y0 + line_px], [x0 - width - gap, y0 + line_px], [x1 + gap, y1], [x0 - width - gap, y1],
      [x0 + gap, y0 + gap + line_px], [x0 + gap, y1 - gap],
    ];
    for (const [x, y] of spots) {
      const own = [x, y - line_px, x + width, y + gap];
      const is_inside = own[0] >= 0 && own[1] >= 0 && own[2] <= right && own[3] <= bottom;
      if (!is_inside || placed.some(other => meets(own, other.area))) continue;
      placed.push({x, y, width, area: own, text: name.text, colour: name.colour});
      break;
    }
  }
  return placed;
}

// Letters with a dark edge, which can be read over light ground, too.
function write_names(context, placed) {
  context.save();
  context.lineJoin = 'round';
  for (const {x, y, text, colour} of placed) {
    context.strokeStyle = '#000c';
    context.lineWidth = 3;
    context.strokeText(text, x, y);
    context.fillStyle = colour;
    context.fillText(text, x, y);
  }
  context.restore();
}
