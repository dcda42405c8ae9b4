'use strict';
// The page that shows a dataset. What it knows stands in the element #dataset, made by gallery.cpp;
// pictures are loaded by their relative paths, which file:// permits.

const $ = id => document.getElementById(id);
const data = JSON.parse($('dataset').textContent);
const colours = ['#ffc454', '#78cdeb', '#f278a0', '#a0e26e', '#c4a0fa', '#fa965a', '#e8e080', '#70e0c0'];

// Poses are stored as differences of whole numbers: mm, ms and hundredths of a degree.
function summed(differences, unit) {
  let sum = 0;
  return differences.map(d => (sum += d) * unit);
}
const track = {};
for (const [name, unit] of [['t', 1e-3], ['x', 1e-3], ['y', 1e-3], ['z', 1e-3],
                            ['roll', 1e-2], ['pitch', 1e-2], ['yaw', 1e-2]])
  track[name] = summed(data.track[name], unit);

const state = {sensor: 0, ping: 0, view: 0, playing: 0};
const sensor = () => data.sensors[state.sensor];
const view = () => sensor().views[state.view];
const pose = () => state.ping * sensor().every;

// --- Pictures --------------------------------------------------------------------------------

const images = new Map();  // the pictures loaded last, the oldest first
const most_images = 48;

function image_of(url) {
  let image = images.get(url);
  if (image) {
    images.delete(url);
  } else {
    image = new Image();
    image.onload = image.onerror = () => {
      image.done = true;
      if (view() && url === url_of(view(), state.ping)) draw_picture();
    };
    image.src = url;
  }
  images.set(url, image);
  if (images.size > most_images) {
    const [oldest, left] = images.entries().next().value;
    images.delete(oldest);
    if (!left.done) left.src = '';  // nobody waits for it any more
  }
  return image;
}

function numbered(pattern, number) {
  return pattern.replace(/%0(\d)d/, (_, digits) => String(number).padStart(Number(digits), '0'));
}

// The file that a view shows at a ping.
function url_of(shown, ping) {
  if (shown.per === 'ping') return numbered(shown.file, ping * sensor().every);
  if (shown.per === 'sweep') return numbered(shown.file, Math.floor(ping / shown.pings));
  return shown.file;
}

// Once the steps pause: who drags the slider over a thousand pings wants none of their neighbours.
let preloading = 0;
function preload() {
  clearTimeout(preloading);
  preloading = setTimeout(load_neighbours, 40);
}

function load_neighbours() {
  const shown = view();
  if (!shown || shown.per !== 'ping') return;
  for (const step of [1, -1, 2, 3, 4, 5, -2]) {
    const ping = state.ping + step;
    if (ping >= 0 && ping < sensor().pings) image_of(url_of(shown, ping));
  }
}

// --- Canvases that zoom and move ----------------------------------------------------------------

// `zoom` times the size at which all of it fits; x and y are what lies in the middle, as shares.
function movable(canvas, redraw) {
  const area = {canvas, zoom: 1, x: 0.5, y: 0.5, span: [1, 1]};
  area.reset = () => { area.zoom = 1; area.x = area.y = 0.5; };
  area.fit = () => {
    const ratio = window.devicePixelRatio || 1;
    const width = Math.max(1, Math.round(canvas.clientWidth * ratio));
    const height = Math.max(1, Math.round(canvas.clientHeight * ratio));
    if (canvas.width !== width || canvas.height !== height) {
      canvas.width = width;
      canvas.height = height;
    }
    const context = canvas.getContext('2d');
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.filter = 'none';
    context.clearRect(0, 0, width, height);
    return context;
  };
  canvas.addEventListener('wheel', event => {
    event.preventDefault();
    const box = canvas.getBoundingClientRect();
    const by = Math.exp(-event.deltaY * 0.0015);
    const zoom = Math.min(80, Math.max(1, area.zoom * by));
    const grown = 1 / area.zoom - 1 / zoom;
    area.x += ((event.clientX - box.left) / box.width - 0.5) * area.span[0] * grown;
    area.y += ((event.clientY - box.top) / box.height - 0.5) * area.span[1] * grown;
    area.zoom = zoom;
    if (zoom === 1) area.reset();
    redraw();
  }, {passive: false});
  canvas.addEventListener('pointerdown', event => canvas.setPointerCapture(event.pointerId));
  canvas.addEventListener('pointermove', event => {
    if (!event.buttons) return;
    const box = canvas.getBoundingClientRect();
    area.x -= event.movementX / box.width * area.span[0] / area.zoom;
    area.y -= event.movementY / box.height * area.span[1] / area.zoom;
    redraw();
  });
  canvas.addEventListener('dblclick', () => { area.reset(); redraw(); });
  return area;
}

const picture = movable($('picture'), draw_picture);
const plan = movable($('plan'), draw_plan);

function draw_boxes(context, boxes, shown, pixel) {
  const names = [];
  context.lineWidth = 2 * pixel;
  context.font = `${13 * pixel}px system-ui, sans-serif`;
  for (const [label, x, y, width, height] of boxes) {
    context.strokeStyle = context.fillStyle = colours[label % colours.length];
    context.strokeRect(x, y, width, height);
    context.save();
    // A turned picture has its lower right corner at the upper left.
    context.translate(shown.turned ? x + width : x, shown.turned ? y + height : y);
    if (shown.turned) context.rotate(Math.PI);
    context.fillText(data.labels[label], 0, -4 * pixel);
    context.restore();
    names.push(data.labels[label]);
  }
  return names;
}

function boxes_of(shown) {
  if (!shown.boxes) return [];
  return shown.per === 'ping' ? shown.boxes[state.ping] || [] : shown.boxes;
}

// Where the ping is in a picture of many.
function draw_mark(context, shown, image, pixel) {
  context.strokeStyle = '#78cdeb';
  context.lineWidth = pixel;
  context.beginPath();
  if (shown.per === 'sweep') {
    const angle = (sensor().columns.head_angle_rad || [])[state.ping];
    if (angle === undefined || angle === null) return;
    const radius = shown.radius * image.naturalWidth;
    const [x, y] = [0.5 * image.naturalWidth, radius];
    context.moveTo(x, y);
    context.lineTo(x - radius * Math.sin(angle), y - radius * Math.cos(angle));
  } else if (shown.along === 'y') {
    const y = shown.origin[1] + (state.ping + 0.5) * shown.step[1];
    context.moveTo(0, y);
    context.lineTo(image.naturalWidth, y);
  } else if (shown.along === 'x') {
    const x = shown.origin[0] + (state.ping + 0.5) * shown.step[0];
    context.moveTo(x, 0);
    context.lineTo(x, image.naturalHeight);
  }
  context.stroke();
}

function draw_picture() {
  const shown = view();
  const image = shown && image_of(url_of(shown, state.ping));
  if (image && !image.done) return;  // until then the last picture stays
  const context = picture.fit();
  $('seen').textContent = '';
  if (!shown) return;
  const {width, height} = picture.canvas;
  if (!image.naturalWidth) {
    context.fillStyle = '#f0c060';
    context.font = '16px system-ui, sans-serif';
    context.fillText(`${url_of(shown, state.ping)} is not there: not rendered yet, or removed`, 20, 40);
    return;
  }
  const fit = Math.min(width / image.naturalWidth, height / image.naturalHeight);
  const scale = fit * picture.zoom;
  picture.span = [width / (fit * image.naturalWidth), height / (fit * image.naturalHeight)];
  context.translate(width / 2, height / 2);
  context.scale(scale, scale);
  context.translate(-picture.x * image.naturalWidth, -picture.y * image.naturalHeight);
  if (shown.turned) {
    context.translate(image.naturalWidth, image.naturalHeight);
    context.rotate(Math.PI);
  }
  context.imageSmoothingEnabled = scale < 2;
  context.filter = $('bright').value === '1' ? 'none' : `brightness(${$('bright').value})`;
  context.drawImage(image, 0, 0);
  context.filter = 'none';
  draw_mark(context, shown, image, 1 / scale);
  if ($('boxes').checked && shown.boxes) {
    const names = draw_boxes(context, boxes_of(shown), shown, 1 / scale);
    const word = names.length === 1 ? 'box' : 'boxes';
    $('seen').textContent = `${names.length} ${word}${names.length ? ': ' : ''}${names.join(', ')}`;
  }
}

// --- The plan ---------------------------------------------------------------------------------

// R = Rz(yaw) Ry(pitch) Rx(roll), degrees.
function rotation(roll, pitch, yaw) {
  const [a, b, c] = [roll, pitch, yaw].map(angle => angle * Math.PI / 180);
  const [sa, ca, sb, cb, sc, cc] = [Math.sin(a), Math.cos(a), Math.sin(b), Math.cos(b), Math.sin(c), Math.cos(c)];
  return [[cc * cb, cc * sb * sa - sc * ca, cc * sb * ca + sc * sa],
          [sc * cb, sc * sb * sa + cc * ca, sc * sb * ca - cc * sa],
          [-sb, cb * sa, cb * ca]];
}
const turn = (matrix, v) => matrix.map(row => row[0] * v[0] + row[1] * v[1] + row[2] * v[2]);

// What the sonar looks at, at its greatest range: points of the world's x and y, the sonar first.
function footprint(one, index) {
  const vehicle = rotation(track.roll[index], track.pitch[index], track.yaw[index]);
  const at = turn(vehicle, one.mount.position).map((d, k) => d + [track.x, track.y, track.z][k][index]);
  const head = (one.columns.head_angle_rad || [])[index / one.every] || 0;
  const points = [[at[0], at[1]]];
  for (let k = -16; k <= 16; ++k) {
    let ray;
    if (one.is_cone) {
      const around = Math.PI * k / 16;
      const [sine, cosine] = [Math.sin(one.azimuth / 2), Math.cos(one.azimuth / 2)];
      ray = [cosine, sine * Math.cos(around), sine * Math.sin(around)];
    } else {
      const angle = head + one.azimuth / 2 * k / 16;
      ray = [Math.cos(angle), Math.sin(angle), 0];
    }
    const [x, y] = turn(vehicle, turn(one.mount.rotation, ray.map(d => d * one.range)));
    points.push([at[0] + x, at[1] + y]);
  }
  return points;
}

const bounds = (() => {
  const box = [Infinity, Infinity, -Infinity, -Infinity];
  const add = (x, y) => {
    box[0] = Math.min(box[0], x); box[1] = Math.min(box[1], y);
    box[2] = Math.max(box[2], x); box[3] = Math.max(box[3], y);
  };
  track.x.forEach((x, k) => add(x, track.y[k]));
  for (const one of data.sensors) {
    const stride = Math.max(1, Math.floor(one.pings / 50));
    for (let ping = 0; ping < one.pings; ping += stride)
      footprint(one, ping * one.every).forEach(([x, y]) => add(x, y));
  }
  return box;
})();

function draw_plan() {
  const context = plan.fit();
  const {width, height} = plan.canvas;
  const [low_x, low_y, high_x, high_y] = bounds;
  const size = Math.max(1e-3, (high_x - low_x) / width, (high_y - low_y) / height) * 1.1;
  const index = pose();
  plan.span = [1, 1];
  const scale = plan.zoom / size;
  if ($('follow').checked && plan.zoom > 1) {
    plan.x = 0.5 + (track.x[index] - (low_x + high_x) / 2) / (size * width);
    plan.y = 0.5 - (track.y[index] - (low_y + high_y) / 2) / (size * height);
  }
  const mid_x = (low_x + high_x) / 2 + (plan.x - 0.5) * size * width;
  const mid_y = (low_y + high_y) / 2 - (plan.y - 0.5) * size * height;
  const px = (x, y) => [width / 2 + (x - mid_x) * scale, height / 2 - (y - mid_y) * scale];
  const line = points => {
    context.beginPath();
    points.forEach(([x, y], k) => context[k ? 'lineTo' : 'moveTo'](...px(x, y)));
  };
  context.font = '11px system-ui, sans-serif';
  context.lineWidth = 1;
  for (const {name, min, max} of data.objects) {
    if (max[0] - min[0] > high_x - low_x && max[1] - min[1] > high_y - low_y) continue;  // the ground
    context.strokeStyle = context.fillStyle = '#7a7a50';
    line([[min[0], min[1]], [max[0], min[1]], [max[0], max[1]], [min[0], max[1]], [min[0], min[1]]]);
    context.stroke();
    if (data.objects.length <= 20 || plan.zoom > 3) context.fillText(name, ...px(min[0], min[1]));
  }
  context.strokeStyle = '#9a9aa4';
  const stride = Math.max(1, Math.floor(track.x.length / 20000));
  const path = [];
  for (let k = 0; k < track.x.length; k += stride) path.push([track.x[k], track.y[k]]);
  line(path);
  context.stroke();
  context.strokeStyle = context.fillStyle = colours[state.sensor % colours.length];
  line(footprint(sensor(), index));
  context.closePath();
  context.globalAlpha = 0.2;
  context.fill();
  context.globalAlpha = 1;
  context.stroke();
  context.fillStyle = '#fff';
  const [x, y] = px(track.x[index], track.y[index]);
  context.fillRect(x - 3, y - 3, 6, 6);
  const bar = 10 ** Math.floor(Math.log10(size * width / plan.zoom / 2));
  context.fillRect(10, height - 12, bar * scale, 3);
  context.fillText(`${bar} m`, 14 + bar * scale, height - 8);
}

// --- What stands beside -------------------------------------------------------------------------

function show_meta() {
  const index = pose();
  const rows = [['ping', index], ['time', `${track.t[index].toFixed(3)} s`]];
  for (const name of ['x', 'y', 'z']) rows.push([name, `${track[name][index].toFixed(3)} m`]);
  for (const name of ['roll', 'pitch', 'yaw']) rows.push([name, `${track[name][index].toFixed(2)}°`]);
  for (const [name, values] of Object.entries(sensor().columns))
    rows.push([name, values[state.ping] === null ? 'none' : values[state.ping]]);
  const table = $('meta');
  table.textContent = '';
  for (const [name, value] of rows) {
    const row = table.insertRow();
    row.insertCell().textContent = name;
    row.insertCell().textContent = value;
  }
  if (!sensor().meta) return;
  const link = document.createElement('a');
  link.href = numbered(sensor().meta, index);
  link.textContent = link.getAttribute('href');
  table.insertRow().insertCell().append(link);
}

function show() {
  $('slider').value = state.ping;
  $('number').value = pose();
  draw_picture();
  draw_plan();
  show_meta();
  preload();
}

function buttons(parent, titles, chosen, choose) {
  parent.textContent = '';
  titles.forEach((title, k) => {
    const button = document.createElement('button');
    button.textContent = title;
    button.className = k === chosen ? 'on' : '';
    button.onclick = () => { choose(k); button.blur(); };
    parent.append(button);
  });
}

function choose_view(k) {
  state.view = Math.max(0, Math.min(k, sensor().views.length - 1));
  picture.reset();
  buttons($('views'), sensor().views.map(one => one.title), state.view, choose_view);
  show();
}

function choose_sensor(k) {
  const index = pose();
  state.sensor = (k + data.sensors.length) % data.sensors.length;
  state.ping = Math.min(sensor().pings - 1, Math.round(index / sensor().every));
  $('slider').max = sensor().pings - 1;
  $('number').step = sensor().every;
  $('number').max = (sensor().pings - 1) * sensor().every;
  $('note').textContent = sensor().note;
  buttons($('sensors'), data.sensors.map(one => `${one.name} (${one.kind})`), state.sensor, choose_sensor);
  choose_view(0);
}

function go(ping) {
  const to = Math.max(0, Math.min(sensor().pings - 1, Math.round(ping) || 0));
  if (to === state.ping) return;
  state.ping = to;
  show();
}

function play() {
  $('play').textContent = state.playing ? 'play' : 'pause';
  if (state.playing) {
    clearTimeout(state.playing);
    state.playing = 0;
    return;
  }
  const step = () => {
    go(state.ping + 1 < sensor().pings ? state.ping + 1 : 0);
    state.playing = setTimeout(step, 1000 / Math.max(1, Number($('speed').value) || 10));
  };
  state.playing = setTimeout(step, 0);
}

const keys = {
  ArrowRight: event => go(state.ping + (event.shiftKey ? 10 : 1)),
  ArrowLeft: event => go(state.ping - (event.shiftKey ? 10 : 1)),
  PageDown: () => go(state.ping + 100),
  PageUp: () => go(state.ping - 100),
  Home: () => go(0),
  End: () => go(sensor().pings - 1),
  ArrowDown: () => choose_sensor(state.sensor + 1),
  ArrowUp: () => choose_sensor(state.sensor - 1),
  ' ': play,
  v: () => choose_view((state.view + 1) % Math.max(1, sensor().views.length)),
  b: () => { $('boxes').checked = !$('boxes').checked; draw_picture(); },
};

document.addEventListener('keydown', event => {
  const typing = event.target.type === 'number';
  if (typing || event.ctrlKey || event.altKey || event.metaKey || !keys[event.key]) return;
  event.preventDefault();
  keys[event.key](event);
});
$('slider').oninput = () => go(Number($('slider').value));
$('number').onchange = () => go(Number($('number').value) / sensor().every);
$('play').onclick = () => { play(); $('play').blur(); };
$('bright').oninput = $('boxes').onchange = draw_picture;
$('follow').onchange = draw_plan;
window.onresize = () => { draw_picture(); draw_plan(); };

document.title = `${data.mission} - sonarsim`;
$('mission').textContent = data.mission;
$('facts').textContent = `${data.poses} poses, seed ${data.seed}, sonarsim ${data.program}` +
                         (data.complete ? '' : ', not complete when this page was made');
choose_sensor(0);
