// Red, green and blue along the scale of grey.
const maps = {
  'as in the file': [],
  copper: ['0 .31 .62 .94 1', '0 .2 .39 .59 .78', '0 .12 .25 .37 .5'],
  viridis: ['.27 .23 .13 .37 .99', '0 .32 .57 .79 .91', '.33 .55 .55 .38 .14'],
  inverted: ['1 0', '1 0', '1 0'],
};

function show() {
  [$('slider').value, $('number').value] = [state.ping, pose()];
  show_picture();
  show_chosen();
  show_facts();
  clearTimeout(preloading);
  preloading = setTimeout(load_neighbours, 40);
}

function buttons(parent, titles, chosen, choose) {
  parent.replaceChildren(...titles.map((title, k) => {
    const button = element('button', title, k === chosen ? 'on' : '');
    button.onclick = () => { button.blur(); choose(k); };
    return button;
  }));
}

function choose_view(k) {
  state.view = Math.max(0, Math.min(k, sensor().views.length - 1));
  Object.assign(area, whole);
  buttons($('views'), sensor().views.map(one => one.title), state.view, choose_view);
  show();
}

function choose_sensor(k) {
  const index = pose();
  state.sensor = (k + data.sensors.length) % data.sensors.length;
  const {pings, every, views, name} = sensor();
  state.ping = Math.max(0, Math.min(pings - 1, Math.round(index / every)));
  [$('slider').max, $('number').step, $('number').max] = [pings - 1, every, (pings - 1) * every];
  $('note').textContent = views.length ? '' :
    `There are no pictures of ${name} that a browser can open: render with output.fan or output.image set to true.`;
  buttons($('sensors'), data.sensors.map(one => `${one.name} (${one.kind})`), state.sensor, choose_sensor);
  choose_view(0);
  show_objects();
}

function choose_dataset(k) {
  if (!page.datasets[k]) return;
  $('datasets').selectedIndex = k;
  if (load(`${k}`)) show_dataset();
}

// The data of the dataset are there. Sensor and ping stay as they are if the dataset has them; background is off.
function show_dataset() {
  [state.dataset, state.selected] = [$('datasets').selectedIndex, -1];
  data = load(`${state.dataset}`);
  data.background.filter(number => !state.known.has(number)).forEach(number => state.hidden.add(number));
  data.background.forEach(number => state.known.add(number));
  document.body.hidden = false;
  $('about').textContent = `${data.poses} poses, seed ${data.seed}, sonarsim ${data.program_version}` +
    (data.complete ? '' : ', not complete when this page was made');
  state.sensor = Math.min(state.sensor, data.sensors.length - 1);
  show_legend();
  choose_sensor(state.sensor);
}

function go(ping) {
  state.ping = Math.max(0, Math.min(sensor().pings - 1, Math.round(ping) || 0));
  show();
}

function play() {
  clearTimeout(state.playing);
  $('play').textContent = state.playing ? 'play' : 'pause';
  const step = () => {
    go(state.ping + 1 < sensor().pings ? state.ping + 1 : 0);
    state.playing = setTimeout(step, 1000 / Math.max(1, Number($('speed').value) || 10));
  };
  state.playing = state.playing ? 0 : setTimeout(step, 0);
}

function choose_map() {
  const tables = Object.values(maps)[$('map').selectedIndex];
  ['R', 'G', 'B'].forEach((name, k) =>
    document.querySelector(`feFunc${name}`).setAttribute('tableValues', tables[k] || '0 1'));
  show_picture();
}

const steps = {ArrowRight: 1, ArrowLeft: -1, PageDown: 100, PageUp: -100, Home: -Infinity, End: Infinity};
const keys = {
  ArrowDown: () => choose_sensor(state.sensor + 1),
  ArrowUp: () => choose_sensor(state.sensor - 1),
  ' ': play,
  v: () => choose_view((state.view + 1) % Math.max(1, sensor().views.length)),
  b: () => $('boxes').click(),
  m: () => $('masks').click(),
  c: () => { $('map').selectedIndex = ($('map').selectedIndex + 1) % $('map').length; choose_map(); },
  n: () => step_object(1),
  p: () => step_object(-1),
  Escape: () => select(-1),
  ']': () => choose_dataset(state.dataset + 1),
  '[': () => choose_dataset(state.dataset - 1),
};

document.addEventListener('keydown', event => {
  const is_typing = event.target.type === 'number' || event.target.tagName === 'SELECT';
  const is_known = event.key in steps || event.key in keys;
  if (!data || !is_known || is_typing || event.ctrlKey || event.altKey || event.metaKey) return;
  event.preventDefault();
  if (event.key in keys) keys[event.key]();
  else go(state.ping + steps[event.key] * (event.shiftKey ? 10 : 1));
});
$('slider').oninput = () => go(Number($('slider').value));
$('number').onchange = () => go(Number($('number').value) / sensor().every);
for (const id of ['bright', 'boxes', 'masks']) $(id).oninput = () => show_picture();
for (const [id, key] of [['play', ' '], ['next', 'n'], ['previous', 'p'], ['none', 'Escape']])
  $(id).onclick = () => { $(id).blur(); keys[key](); };
$('map').onchange = () => { $('map').blur(); choose_map(); };
$('datasets').onchange = () => { $('datasets').blur(); choose_dataset($('datasets').selectedIndex); };
window.onresize = () => data && show();
make_movable($('frame'));
$('map').append(...Object.keys(maps).map(name => element('option', name)));
$('datasets').append(...page.datasets.map(([folder]) => element('option', folder)));
$('datasets').hidden = page.datasets.length < 2;
[$('name').textContent, document.title] = [page.name, `${page.name} - sonarsim`];
choose_dataset(0);
