'use strict';
// The data: the element #page, and files that are loaded when they are needed, index_files/K.js of dataset K and
// K_S_C.js of the C-th part of its sensor S; see gallery/__main__.py.

const $ = id => document.getElementById(id);
const page = JSON.parse($('page').textContent);
const colours = ['#ffc454', '#78cdeb', '#f278a0', '#a0e26e', '#c4a0fa', '#fa965a', '#e8e080', '#70e0c0'];

// `hidden` has the numbers of the classes that are off, `known` of those that were switched off as background;
// `selected` is the number of an object, or -1.
const state = {dataset: 0, sensor: 0, ping: 0, view: 0, playing: 0, hidden: new Set(), known: new Set(), selected: -1};
const chunks = new Map();  // by the names of their files, those loaded last at the end
const most_chunks = 60;
let data = null;  // the chosen dataset

function load(key) {
  if (chunks.has(key)) return chunks.get(key);
  chunks.set(key, null);
  if (chunks.size > most_chunks) chunks.delete(chunks.keys().next().value);
  const script = element('script', '');
  script.src = `index_files/${key}.js`;
  script.onerror = () => {
    $('note').textContent = `${script.src} is not there: write the page again`;
    document.body.hidden = false;
  };
  document.head.append(script);
  return null;
}

// Called by the files.
function take(key, text) {
  chunks.set(key, JSON.parse(text));
  if (!key.includes('_')) chunks.get(key).sensors.forEach(note_pings_of_pictures);
  if (key === `${$('datasets').selectedIndex}`) show_dataset();
  else if (data) show();
}

// Objects of sweeps are seen at the first ping of their picture, those of other records in the middle of their box.
function note_pings_of_pictures(one) {
  const shown = one.views.find(view => view.per === 'sweep' || 'pings_along' in view);
  for (const [number, entries] of Object.entries(one.pictures)) {
    for (const [label, , box] of entries) {
      const k = shown.pings_along === 'y' ? 1 : 0;
      const along = shown.per === 'sweep' ? 0 : (box[k] + box[k + 2]) / 2 * (shown.pings_per_pixel || 1);
      const ping = Math.min(number * (shown.pings || one.pings) + Math.floor(along), one.pings - 1);
      one.seen[label] = [...new Set([...one.seen[label] || [], ping])].sort((a, b) => a - b);
    }
  }
}

const sensor = () => data.sensors[state.sensor];
const view = () => sensor().views[state.view];
const pose = () => state.ping * sensor().every;
const class_of = label => data.labels[label][1];
const colour_of = label => colours[class_of(label) % colours.length];
const label_text = (label, [name, number] = data.labels[label]) =>
  name === page.classes[number] ? name : `${name} (${page.classes[number]})`;

// The facts and the objects of a ping, once its chunk is there.
function known_of(ping) {
  const number = Math.floor(ping / page.chunk);
  if (!sensor().chunks.includes(number)) return {};
  const chunk = load(`${state.dataset}_${state.sensor}_${number}`);
  return chunk && chunk[ping] || {};
}

// The number of a ping's picture.
const number_of = (shown, ping) => shown.per === 'ping' ? ping * sensor().every :
  shown.per === 'sweep' ? Math.floor(ping / shown.pings) : 0;

// The entries over a view at a ping: [label, facts, shape, shape in the fan], a shape being [left, top, right,
// bottom, mask, shadow or 0] in pixels of the picture that was labelled.
function entries_of(shown, ping) {
  if (!shown || !shown.width) return [];
  const own = shown.per === 'ping' ? known_of(ping).objects : sensor().pictures[number_of(shown, ping)];
  return (own || []).filter(entry => entry[shown.part] && !state.hidden.has(class_of(entry[0])));
}

// The pings of the sensor that show an object.
const pings_of = label => sensor().seen[label] || [];

// A path from the folder of the page; names may have any letters.
function url_of(pattern, number) {
  const file = pattern.replace(/%0(\d)d/, (_, digits) => String(number).padStart(Number(digits), '0'));
  const folder = page.datasets[state.dataset][0];
  return (folder ? `${folder}/${file}` : file).split('/').map(encodeURIComponent).join('/');
}

const element = (kind, text, name = '') =>
  Object.assign(document.createElement(kind), {textContent: text, className: name});

function swatch(colour, name = 'swatch') {
  const made = element('span', '', name);
  made.style.background = colour;
  return made;
}
