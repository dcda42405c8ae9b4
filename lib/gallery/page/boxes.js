// The boxes of labels, the pings that show an object, and its masks.

// The boxes of a view at a ping: [label, x, y, width, height, details].
function boxes_of(shown, ping) {
  if (!shown || !shown.boxes) return [];
  if (shown.per === 'ping') return shown.boxes[ping] || [];
  if (shown.per === 'sweep') return shown.boxes[Math.floor(ping / shown.pings)] || [];
  return shown.boxes;
}

function shown_boxes() {
  return boxes_of(view(), state.ping).filter(box => !state.hidden.has(class_of(box[0])));
}

// Calls add(label, ping) for each box of a view and each ping that has it.
function for_each_box(one, shown, add) {
  if (shown.per === 'ping') {
    shown.boxes.forEach((boxes, ping) => (boxes || []).forEach(box => add(box[0], ping)));
  } else if (shown.per === 'sweep') {
    shown.boxes.forEach((boxes, sweep) => boxes.forEach(box => add(box[0], sweep * shown.pings)));
  } else if (shown.along) {
    const axis = shown.along === 'x' ? 0 : 1;
    for (const box of shown.boxes) {
      const middle = (box[1 + axis] + box[3 + axis] / 2 - shown.origin[axis]) / shown.step[axis];
      add(box[0], Math.max(0, Math.min(one.pings - 1, Math.floor(middle))));
    }
  }
}

// The pings of a sensor that show an object, by label. They are counted in the chosen view if it has
// boxes, else in the first view that has some.
let sightings_by_view = new Map();  // of the dataset
function sightings(k) {
  const one = data.sensors[k];
  const has_boxes = k === state.sensor && view() && view().boxes;
  const index = has_boxes ? state.view : one.views.findIndex(shown => shown.boxes);
  const key = `${k} ${index}`;
  if (sightings_by_view.has(key)) return sightings_by_view.get(key);
  const pings = new Map();
  if (index >= 0) {
    for_each_box(one, one.views[index], (label, ping) => {
      if (!pings.has(label)) pings.set(label, new Set());
      pings.get(label).add(ping);
    });
  }
  for (const [label, own] of pings) pings.set(label, [...own].sort((a, b) => a - b));
  const found = {view: index, pings};
  sightings_by_view.set(key, found);
  return found;
}

// The lengths of runs of pixels without and with the object, column by column, from the text that
// COCO's tools call compressed RLE.
function runs_of(text) {
  const runs = [];
  for (let at = 0; at < text.length;) {
    let value = 0, shift = 0, code;
    do {
      code = text.charCodeAt(at++) - 48;
      value |= (code & 31) << shift;
      shift += 5;
    } while (code & 32 && at < text.length);
    if (code & 16) value |= -1 << shift;
    runs.push(value + (runs.length > 2 ? runs[runs.length - 2] : 0));
  }
  return runs;
}

// The strips of a mask in its columns: [x, y, height].
function strips_of(text, height) {
  const strips = [];
  let at = 0;
  runs_of(text).forEach((run, k) => {
    for (let begin = at, end = at + run; k % 2 && begin < end;) {
      const x = Math.floor(begin / height);
      const length = Math.min(end, (x + 1) * height) - begin;
      strips.push([x, begin - x * height, length]);
      begin += length;
    }
    at += run;
  });
  return strips;
}

// A canvas with a mask, and its place in the labelled picture.
const masks = new WeakMap();
function mask_of(box, shown) {
  if (masks.has(box)) return masks.get(box);
  const strips = strips_of(box[5].mask, shown.mask_height);
  let [left, top, right, bottom] = [Infinity, Infinity, 0, 0];
  for (const [x, y, length] of strips) {
    left = Math.min(left, x); right = Math.max(right, x + 1);
    top = Math.min(top, y); bottom = Math.max(bottom, y + length);
  }
  const canvas = document.createElement('canvas');
  if (strips.length) {
    canvas.width = right - left;
    canvas.height = bottom - top;
    const context = canvas.getContext('2d');
    context.fillStyle = colour_of(box[0]);
    for (const [x, y, length] of strips) context.fillRect(x - left, y - top, 1, length);
  }
  const mask = {canvas, left, top, is_empty: !strips.length};
  masks.set(box, mask);
  return mask;
}
