// The buttons and keys next to the picture.

// The values of the selected object's label at this ping: [name, value].
function details_of_selected() {
  const own = boxes_of(view(), state.ping).find(box => box[0] === state.selected);
  return Object.entries(own ? own[5] : {}).filter(([name]) => name !== 'mask' && name !== 'shadow_bbox')
    .map(([name, value]) => [`${data.labels[state.selected].name}: ${name}`, value]);
}

function show_meta() {
  const index = pose();
  const rows = details_of_selected();
  rows.push(['ping', index], ['time', `${track.t[index].toFixed(3)} s`]);
  for (const name of ['x', 'y', 'z']) rows.push([name, `${track[name][index].toFixed(3)} m`]);
  for (const name of ['roll', 'pitch', 'yaw']) rows.push([name, `${track[name][index].toFixed(2)}°`]);
  for (const [name, values] of Object.entries(sensor().columns))
    rows.push([name, values[state.ping] === null ? 'none' : values[state.ping]]);
  for (const [name, value] of Object.entries(page.datasets[state.dataset].facts)) rows.push([name, value]);
  const table = $('meta');
  table.textContent = '';
  for (const [name, value] of rows) {
    const row = table.insertRow();
    row.insertCell().textContent = name;
    row.insertCell().textContent = value;
  }
  if (!sensor().meta) return;
  const link = document.createElement('a');
  link.href = path_of(numbered(sensor().meta, index));
  link.textContent = link.getAttribute('href');
  table.insertRow().insertCell().append(link);
}

function show() {
  $('slider').value = state.ping;
  $('number').value = pose();
  draw_picture();
  draw_plan();
  show_chosen();
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
  show_objects();
}

// Sensor, view, ping and brightness stay as they are if the dataset has them.
function choose_dataset(k) {
  if (k < 0 || k >= page.datasets.length) return;
  const [name, title, ping] = data ? [sensor().name, (view() || {}).title, state.ping] : ['', '', 0];
  read_dataset(k);
  state.dataset = k;
  state.selected = -1;
  sightings_by_view = new Map();
  plan.bounds = bounds_of_dataset();
  plan.reset();
  $('datasets').value = k;
  $('facts').textContent = `${data.poses} poses, seed ${data.seed}, sonarsim ${data.program}` +
                           (data.complete ? '' : ', not complete when this page was made');
  state.sensor = Math.max(0, data.sensors.findIndex(one => one.name === name));
  state.ping = Math.min(sensor().pings - 1, ping);
  show_legend();
  choose_sensor(state.sensor);
  choose_view(Math.max(0, sensor().views.findIndex(one => one.title === title)));
  if (!$('statistics').hidden) show_statistics();
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
  m: () => { $('masks').checked = !$('masks').checked; draw_picture(); },
  s: toggle_statistics,
  n: () => step_object(1),
  p: () => step_object(-1),
  Escape: () => select(-1),
  ']': () => choose_dataset(state.dataset + 1),
  '[': () => choose_dataset(state.dataset - 1),
};

document.addEventListener('keydown', event => {
  const typing = event.target.type === 'number' || event.target === $('datasets');
  if (typing || event.ctrlKey || event.altKey || event.metaKey || !keys[event.key]) return;
  event.preventDefault();
  keys[event.key](event);
});
$('slider').oninput = () => go(Number($('slider').value));
$('number').onchange = () => go(Number($('number').value) / sensor().every);
$('play').onclick = () => { play(); $('play').blur(); };
$('bright').oninput = $('boxes').onchange = $('masks').onchange = draw_picture;
$('follow').onchange = draw_plan;
window.onresize = () => { draw_picture(); draw_plan(); };

$('switch').onclick = () => { toggle_statistics(); $('switch').blur(); };
$('next').onclick = () => step_object(1);
$('previous').onclick = () => step_object(-1);
$('none').onclick = () => select(-1);

// The list of the datasets, where there are several.
page.datasets.forEach(({folder}, k) => {
  const option = element('option', folder);
  option.value = k;
  $('datasets').append(option);
});
$('datasets').hidden = page.datasets.length < 2;
$('datasets').onchange = () => { choose_dataset(Number($('datasets').value)); $('datasets').blur(); };

document.title = `${page.name} - sonarsim`;
$('mission').textContent = page.name;
chosen.whole = page.datasets.length > 1;
if (page.missing) $('missing').textContent = `${page.missing} variants were not begun when this page was made`;
choose_dataset(0);
