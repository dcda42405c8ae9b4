// The picture of a view, and over it a canvas with masks, boxes, names and a mark where the ping is.

const images = new Map();  // the pictures loaded last, the oldest first
const most_images = 48;
const whole = {zoom: 1, x: 0.5, y: 0.5};  // x, y: what lies in the middle of the frame, as shares
const area = {...whole, boxes: [], share: [1, 1]};

function image_of(url) {
  const image = images.get(url) || Object.assign(new Image(), {src: url});
  image.onload = image.onerror = () => image === shown_image() && show_picture();
  images.delete(url);
  images.set(url, image);
  if (images.size > most_images) images.delete(images.keys().next().value);
  return image;
}

const shown_image = () => view() && image_of(url_of(view().file, number_of(view(), state.ping)));

// The strips of a mask, [x, y, length], from COCO's compressed text: lengths of runs of pixels without and with the
// object, column by column. None if the runs do not fill the picture.
function strips_of(text, {width, height}) {
  const [runs, strips] = [[], []];
  for (let at = 0; at < text.length;) {
    let [value, shift, code] = [0, 0, 32];
    for (; code & 32 && at < text.length; shift += 5) {
      code = text.charCodeAt(at++) - 48;
      value |= (code & 31) << shift;
    }
    if (code & 16) value |= -1 << shift;
    runs.push(value + (runs.length > 2 ? runs[runs.length - 2] : 0));
  }
  if (runs.some(run => run < 0) || runs.reduce((sum, run) => sum + run, 0) !== width * height) return [];
  let end = 0;
  runs.forEach((run, k) => {
    end += run;
    for (let at = end - run, length; k % 2 && at < end; at += length) {
      length = Math.min(end - at, height - at % height);
      strips.push([Math.floor(at / height), at % height, length]);
    }
  });
  return strips;
}

// Takes a box in pixels of the labelled picture to [x, y, width, height] in the one that is shown.
const placed = ({origin_px: [x, y] = [0, 0], pixel_px: [w, h] = [1, 1]}, [left, top, right, bottom]) =>
  [x + left * w, y + top * h, (right - left) * w, (bottom - top) * h];

const line_colour = label => label === state.selected ? '#fff' : colour_of(label);

function draw_entry(context, shown, entry, line) {
  const shape = entry[shown.part];
  context.fillStyle = colour_of(entry[0]);
  context.strokeStyle = line_colour(entry[0]);
  if ($('masks').checked) {
    context.globalAlpha = 0.4;
    context.beginPath();
    for (const [x, y, length] of strips_of(shape[4], shown)) context.rect(...placed(shown, [x, y, x + 1, y + length]));
    context.fill();
    context.globalAlpha = 1;
  }
  if (!$('boxes').checked) return;
  context.lineWidth = (entry[0] === state.selected ? 3 : 1.5) * line;
  context.strokeRect(...placed(shown, shape));
  context.setLineDash([4 * line, 4 * line]);  // the box of a shadow
  if (shape[5]) context.strokeRect(...placed(shown, shape[5]));
  context.setLineDash([]);
}

// Names in the first free place around their boxes, small boxes first; the list has those that find none.
function write_names(context, areas, size) {
  const [taken, {width, height}] = [[], context.canvas];
  Object.assign(context, {font: `${size}px system-ui, sans-serif`, strokeStyle: '#000c', lineWidth: 3});
  for (const [left, top, right, bottom, label] of areas) {
    const text = label_text(label);
    const wide = context.measureText(text).width;
    const spots = [[left, top - 3], [left, bottom + size], [right + 3, top + size], [left - wide - 3, top + size]];
    const spot = spots.find(([x, y]) => x >= 0 && y >= size && x + wide <= width && y + 3 <= height &&
      taken.every(([u, v, w]) => x > u + w || u > x + wide || Math.abs(y - v) > size + 3));
    if (!spot) continue;
    taken.push([...spot, wide]);
    context.strokeText(text, ...spot);
    context.fillStyle = line_colour(label);
    context.fillText(text, ...spot);
  }
}

// Marks the ping in a picture of many.
function draw_mark(context, shown, image) {
  context.strokeStyle = '#78cdeb';
  context.beginPath();
  if (shown.per === 'sweep') {
    const angle = (known_of(state.ping).meta || {}).head_angle_rad;
    if (angle === undefined) return;
    const [x, y] = [image.naturalWidth / 2, shown.radius_px / shown.width_px * image.naturalWidth];
    context.moveTo(x, y);
    context.lineTo(x - y * Math.sin(angle), y - y * Math.cos(angle));
  } else if ('pings_along' in shown) {
    const along = 'xy'.indexOf(shown.pings_along);
    const way = shown.origin_px[along] + (state.ping + 0.5) / shown.pings_per_pixel * shown.pixel_px[along];
    context.moveTo(along ? 0 : way, along ? way : 0);
    context.lineTo(along ? image.naturalWidth : way, along ? way : image.naturalHeight);
  }
  context.stroke();
}

// Places the picture in the frame. A picture whose first row is nearest is turned, as fans lie.
function place_picture(image, shown, frame) {
  const [width, height] = [image.naturalWidth, image.naturalHeight];
  const fit = Math.min(frame.clientWidth / width, frame.clientHeight / height);
  area.share = [frame.clientWidth / (fit * width), frame.clientHeight / (fit * height)];
  area.scale = fit * area.zoom;
  area.matrix = new DOMMatrix().translate(frame.clientWidth / 2, frame.clientHeight / 2).scale(area.scale)
    .translate(-area.x * width, -area.y * height);
  if (shown.ahead === 'down') area.matrix = area.matrix.translate(width, height).scale(-1, -1);
  image.style.transform = area.matrix.toString();
  image.style.imageRendering = area.scale < 2 ? 'auto' : 'pixelated';
}

function show_picture() {
  const [shown, image, frame, canvas] = [view(), shown_image(), $('frame'), $('overlay')];
  if (image && !image.complete) return;  // until then the last picture stays
  const ratio = window.devicePixelRatio;
  [canvas.width, canvas.height] = [frame.clientWidth * ratio, frame.clientHeight * ratio];
  const context = canvas.getContext('2d');
  const entries = entries_of(shown, state.ping);
  area.boxes = [];
  $('seen').textContent = !image || image.naturalWidth ? entries.map(entry => label_text(entry[0])).join(', ') :
    `${image.src} is not there: not rendered yet, or removed`;
  $('picture').replaceChildren(...image && image.naturalWidth ? [image] : []);
  if (!$('picture').firstChild) return;
  $('picture').style.filter = `brightness(${$('bright').value})${$('map').selectedIndex ? ' url(#colours)' : ''}`;
  place_picture(image, shown, frame);
  context.setTransform(new DOMMatrix().scale(ratio).multiply(area.matrix));
  context.lineWidth = 1 / area.scale;
  draw_mark(context, shown, image);
  for (const entry of entries) {
    draw_entry(context, shown, entry, 1 / area.scale);
    const [x, y, w, h] = placed(shown, entry[shown.part]);
    const [a, b] = [[x, y], [x + w, y + h]].map(([u, v]) => context.getTransform().transformPoint({x: u, y: v}));
    area.boxes.push([Math.min(a.x, b.x), Math.min(a.y, b.y), Math.max(a.x, b.x), Math.max(a.y, b.y), entry[0]]);
  }
  area.boxes.sort((a, b) => (a[2] - a[0]) * (a[3] - a[1]) - (b[2] - b[0]) * (b[3] - b[1]));
  context.setTransform(1, 0, 0, 1, 0, 0);
  if ($('boxes').checked) write_names(context, area.boxes, 13 * ratio);
}

// A click selects the smallest box around it; the wheel zooms, dragging moves.
function make_movable(frame) {
  let way = 0;  // that the pointer has moved since it went down, px
  const move = (x, y) => { area.x += x * area.share[0]; area.y += y * area.share[1]; show_picture(); };
  frame.onwheel = event => {
    event.preventDefault();
    const zoom = Math.min(80, Math.max(1, area.zoom * Math.exp(-event.deltaY * 0.0015)));
    const grown = 1 / area.zoom - 1 / zoom;
    area.zoom = zoom;
    move((event.offsetX / frame.clientWidth - 0.5) * grown, (event.offsetY / frame.clientHeight - 0.5) * grown);
  };
  frame.onpointerdown = () => { way = 0; };
  frame.onpointermove = event => {
    if (!event.buttons) return;
    way += Math.abs(event.movementX) + Math.abs(event.movementY);
    const [x, y] = [event.movementX / frame.clientWidth, event.movementY / frame.clientHeight];
    if (way > 4) move(-x / area.zoom, -y / area.zoom);
  };
  frame.onclick = event => {
    if (way > 4) return;
    const [x, y] = [event.offsetX, event.offsetY].map(px => px * window.devicePixelRatio);
    const found = area.boxes.find(([left, top, right, bottom]) =>
      x >= left - 4 && x <= right + 4 && y >= top - 4 && y <= bottom + 4);
    select(found ? found[4] : -1);
  };
  frame.ondblclick = () => { Object.assign(area, whole); show_picture(); };
}

let preloading = 0;  // the neighbours load once the steps pause: who drags the slider wants none of them
function load_neighbours() {
  if (!view() || view().per !== 'ping') return;
  for (const ping of [1, -1, 2, 3, 4, 5, -2].map(step => state.ping + step))
    if (ping >= 0 && ping < sensor().pings && known_of(ping)) image_of(url_of(view().file, number_of(view(), ping)));
}
